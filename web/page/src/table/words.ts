// Plans in words: what a choice is, and chances.
import type { Choice, Table } from "carom";
import { pocketName } from "../../../player/words.js";

/** Fargo ratings that one can choose. */
export const RATINGS = ["200", "300", "400", "500", "600", "700", "800"];
export const percent = (x: number): string => `${(100 * x).toFixed(0)} %`;

const BY: Partial<Record<Choice["kind"], string>> = {
  bank: ", by a bank",
  kick: ", by a kick",
  combination: ", by a combination",
  carom: ", by a carom",
  kiss: ", by a kiss",
};
/** Choices in which no ball is named. */
const WITHOUT: Partial<Record<Choice["kind"], string>> = {
  foul: "a foul, because no stroke without one was found",
  break: "a break",
  push: "a push-out",
  pass: "a pass: the other player goes on",
  safety: "a safety",
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

export const isSafe = ({ kind, ball, keep }: Choice): boolean =>
  ball < 0 && (kind === "safety" || keep < 0.005);
/** What a choice is, by which the cue ball may be known to meet a cushion first. */
export function wordsOfChoice(
  table: Table,
  names: readonly string[],
  choice: Choice,
  cushionFirst = false,
): string {
  const { kind, ball, pocket } = choice;
  const hasPockets = table.pockets.length > 0;
  if (ball < 0) {
    const named = WITHOUT[kind] ?? (isSafe(choice) ? WITHOUT.safety : undefined);
    if (named !== undefined) return named;
    return hasPockets
      ? "a stroke without a sure pot: several balls may fall"
      : "a stroke after which the first ball is not sure";
  }
  const name = names[ball]!;
  if (!hasPockets) return `the ${name} ball first`;
  const article = Number(name) > 0 ? "ball" : "the";
  const first = cushionFirst && kind !== "kick" ? ", off a cushion first" : "";
  return `${article} ${name} into the ${pocketName(table, pocket)}${BY[kind] ?? ""}${first}`;
}
