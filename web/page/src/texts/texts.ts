// The texts of the page in its language: the one chosen in the settings, or else the browser's. The
// language of a loaded page does not change; choosing another one loads the page again.
//
// A language is a file with the same keys as the English one: `plain` contains texts without parts,
// and `filled` texts with parts. A call passes the parts in the order in which the English text
// names them. "{count}" is a part, and "{count:ball|balls}" is the first alternative where the part
// is 1 or true, else the second. `rules` and `cards` describe each game, by the library's name for
// it: in a paragraph, and in a line. `letters` tells the colours of balls apart, and `known`
// translates texts of the library; in English it contains only those that have a shorter form for
// players.
import { DICTIONARY, translate } from "../../../player/words.js";
import german from "./de.json" with { type: "json" };
import english from "./en.json" with { type: "json" };

type Part = string | number | boolean;
type Lists = Record<"rules" | "cards" | "letters" | "known", Record<string, string>>;
type LanguageFile = Pick<typeof english, "plain" | "filled"> & Lists;
type Texts = LanguageFile["plain"] &
  Record<keyof LanguageFile["filled"], (...parts: Part[]) => string> &
  Lists;

const ENGLISH: LanguageFile = english;
const GERMAN: LanguageFile = german;
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

/** The names of a text's parts, in the order of the text. */
export const partsOf = (text: string): string[] => [
  ...new Set(Array.from(text.matchAll(/\{(\w+)/g), ([, name]) => name!)),
];
function fill(text: string, names: readonly string[], parts: readonly Part[]): string {
  const valueOf = (name: string): Part => parts[names.indexOf(name)]!;
  return text
    .replaceAll(
      /\{(\w+):((?:[^{}|]|\{\w+\})*)\|((?:[^{}|]|\{\w+\})*)\}/g,
      (_, name: string, first: string, second: string) =>
        [1, true].includes(valueOf(name) as number) ? first : second,
    )
    .replaceAll(/\{(\w+)\}/g, (_, name: string) => String(valueOf(name)));
}
export function textsOf(language: Language): Texts {
  const { plain, filled, ...lists } = LANGUAGES[language];
  const functions = Object.entries(filled).map(([key, text]) => {
    const names = partsOf(ENGLISH.filled[key as keyof typeof filled]);
    return [key, (...parts: Part[]): string => fill(text, names, parts)];
  });
  return { ...plain, ...lists, ...Object.fromEntries(functions) } as Texts;
}

export const language = languageOfReader();
export const texts = textsOf(language);
Object.assign(DICTIONARY, texts.known);
export { translate };
