// Plans in words: what a choice is, and chances.
import type { Choice, Table } from "carom";
import { pocketName } from "../../../player/words.js";

/** Fargo ratings that one can choose. */
export const RATINGS = ["300", "400", "500", "600", "700", "800"];
export const percent = (x: number): string => `${(100 * x).toFixed(0)} %`;

const BY: Partial<Record<Choice["kind"], string>> = {
  bank: ", by a bank",
  kick: ", by a kick",
  combination: ", by a combination",
  carom: ", by a carom",
  kiss: ", by a kiss",
};
const WITHOUT: Partial<Record<Choice["kind"], string>> = {
  foul: "a foul, as no stroke without one was found",
  break: "a break",
  push: "a push-out",
  pass: "a pass, which lets the other player go on",
};

/**
 * How often a stroke keeps the turn, wins the game, and is a foul. Where it is `alone`, the chance
 * to win is not known.
 */
export function wordsOfChances(
  { keep, value, foul }: Pick<Choice, "keep" | "value" | "foul">,
  alone: boolean,
): string {
  return `keeps the turn in ${percent(keep)}, ${alone ? "" : `wins the game in ${percent(value)}, `}fouls in ${percent(foul)} of tries`;
}

export const isSafe = ({ ball, keep }: Choice): boolean => ball < 0 && keep < 0.005;
/** What a choice is, by which the cue ball may be known to meet a cushion first. */
export function wordsOfChoice(
  table: Table,
  names: readonly string[],
  choice: Choice,
  cushionFirst = false,
): string {
  const { kind, ball, pocket } = choice;
  if (ball < 0) {
    const luck = "a stroke without a sure pot: which ball falls is luck";
    return WITHOUT[kind] ?? (isSafe(choice) ? "a safety" : luck);
  }
  const name = names[ball]!;
  if (table.pockets.length === 0) return `the ${name} ball first`;
  const article = Number(name) > 0 ? "ball" : "the";
  const first = cushionFirst && kind !== "kick" ? ", off a cushion first" : "";
  return `${article} ${name} into the ${pocketName(table, pocket)}${BY[kind] ?? ""}${first}`;
}
