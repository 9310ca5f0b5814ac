// The schema of a game as text: what each setting, and what follows it, may be. A text comes from a
// link, from another page, or from this browser; whatever it says otherwise is refused in words.
import { words } from "carom";
import { SEATS } from "../table/games.js";
import { texts } from "../texts/texts.js";

/** What a value must be, in words, and whether one is. */
interface Kind {
  right: string;
  fits(value: unknown): boolean;
}
const isWhole = (value: unknown, least: number, most: number): boolean =>
  Number.isSafeInteger(value) && (value as number) >= least && (value as number) <= most;
const whole = (least: number, most: number): Kind => ({
  right: texts.aWholeNumber(least, most),
  fits: (value) => isWhole(value, least, most),
});
const text: Kind = { right: texts.aText, fits: (value) => typeof value === "string" };
const flag: Kind = { right: [true, false].join(", "), fits: (value) => typeof value === "boolean" };
const list = (right: string, fits: (value: unknown) => boolean): Kind => ({
  right,
  fits: (value) => Array.isArray(value) && value.every(fits),
});
/** A rating, as text, or one of these words. */
const rating = (least: number, right: string, others: readonly string[] = []): Kind => ({
  right,
  fits: (value) =>
    typeof value === "string" &&
    (others.includes(value) || (/^\d+$/.test(value) && isWhole(Number(value), least, BEST))),
});
/** The conditions of the library whose names end so. */
const conditions = (end: string): string[] =>
  words.condition.map(([word]) => word).filter((word) => word.endsWith(end));
const named = (names: readonly string[]): Kind => ({
  right: names.join(", "),
  fits: (value) => names.includes(value as string),
});

/** The best rating, the longest race, and the times of a clock, s. */
const BEST = 1000;
const LONGEST = 99;
const CLOCK = [5, 600] as const;
const SEATS_OF_ALL = [...new Set(Object.values(SEATS).flat())].sort();

const TEXT: Readonly<Record<string, Kind>> = {
  game: text, // the list of games knows it
  against: rating(1, texts.aRatingOr(BEST), ["person", "link", "practice"]),
  own: rating(0, texts.aRatingOrNone(BEST)),
  seed: whole(0, Number.MAX_SAFE_INTEGER),
  table: text, // the game knows its tables
  cloth: named(conditions("_cloth")),
  cushion: {
    right: texts.twoNumbersOr(conditions("_cushion").join(", ")),
    fits: (value) =>
      typeof value === "string" && (value.includes(",") || conditions("_cushion").includes(value)),
  },
  at: text, // the layout reads it
  drill: text,
  race: whole(1, LONGEST),
  racks: {
    right: texts.twoWholeNumbers(LONGEST),
    fits: (value) =>
      Array.isArray(value) && value.length === 2 && value.every((won) => isWhole(won, 0, LONGEST)),
  },
  equalInnings: flag,
  seats: {
    right: SEATS_OF_ALL.join(", "),
    fits: (value) => SEATS_OF_ALL.includes(value as number),
  },
  clock: whole(...CLOCK),
  lines: list(texts.aListOfLines, (line) => typeof line === "string" || Array.isArray(line)),
  aims: text,
  entries: list(texts.aListOfLines, () => true),
};
const NEEDED = ["game", "against", "own", "seed"];

/** What is shown of a value in an error. */
const shown = (value: unknown): string => {
  const full = JSON.stringify(value) ?? String(value);
  return full.length > 40 ? `${full.slice(0, 40)}…` : full;
};

/** The members of a game as text. Throws where one is unknown, missing or not what it may be. */
export function membersOf(gameText: string): Record<string, unknown> {
  let members: unknown;
  try {
    members = JSON.parse(gameText);
  } catch {
    throw new TypeError(texts.theLinkIsCut);
  }
  if (typeof members !== "object" || members === null || Array.isArray(members))
    throw new TypeError(texts.theLinkIsCut);
  for (const [name, value] of Object.entries(members)) {
    const kind = Object.hasOwn(TEXT, name) ? TEXT[name] : undefined;
    if (!kind) throw new TypeError(texts.settingThereIsNo(name, Object.keys(TEXT).join(", ")));
    if (!kind.fits(value)) throw new TypeError(texts.settingMustBe(name, shown(value), kind.right));
  }
  const missing = NEEDED.find((name) => !Object.hasOwn(members, name));
  if (missing !== undefined)
    throw new TypeError(texts.settingIsMissing(missing, TEXT[missing]!.right));
  return members as Record<string, unknown>;
}
