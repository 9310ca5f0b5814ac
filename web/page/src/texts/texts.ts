// The texts of the page in its language: the one that was chosen in the settings, or else the
// browser's. A page keeps its language; another choice loads it again.
import { DICTIONARY, translate } from "../../../player/words.js";
import { GERMAN } from "./de.js";
import { ENGLISH } from "./en.js";

/** A language is a file of texts with the keys of the English one. */
export const LANGUAGES = { en: ENGLISH, de: GERMAN } as const;
export type Language = keyof typeof LANGUAGES;
export const LANGUAGE_NAMES: readonly (readonly [Language, string])[] = [
  ["en", "English"],
  ["de", "Deutsch"],
];
const KEY = "carom-language";

function languageOfReader(): Language {
  const preferences = [chosenLanguage() ?? "", ...(globalThis.navigator?.languages ?? [])];
  const known = preferences.map((code) => code.slice(0, 2)).find((code) => code in LANGUAGES);
  return (known as Language | undefined) ?? "en";
}
/** What was chosen; workers, and browsers that keep nothing, know of none. */
function chosenLanguage(): string | undefined {
  try {
    return localStorage.getItem(KEY) ?? undefined;
  } catch {
    return undefined;
  }
}
/** Keeps a choice and loads the page again, whose game is kept. */
export function chooseLanguage(language: string): void {
  localStorage.setItem(KEY, language);
  location.reload();
}

export const language = languageOfReader();
export const texts: typeof ENGLISH = LANGUAGES[language];
Object.assign(DICTIONARY, texts.known);
export { translate };
