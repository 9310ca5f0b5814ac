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
  one: Choice,
  cushion = false,
): string {
  if (one.ball < 0)
    return (
      WITHOUT[one.kind] ??
      (isSafe(one) ? "a safety" : "a stroke without a sure pot: which ball falls is luck")
    );
  if (table.pockets.length === 0) return `the ${names[one.ball]} ball first`;
  return `${/^\d/.test(names[one.ball]!) ? "ball" : "the"} ${names[one.ball]} into the ${pocketName(table, one.pocket)}${BY[one.kind] ?? ""}${cushion && one.kind !== "kick" ? ", off a cushion first" : ""}`;
}
