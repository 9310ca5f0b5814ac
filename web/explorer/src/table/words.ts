// Plans in words: what a choice is, and chances.
import type { Choice, Table } from "carom";
import { pocketName } from "../../../../cli/player.js";

/** Fargo ratings that one can choose. */
export const RATINGS = ["300", "400", "500", "600", "700", "800"];
export const percent = (x: number): string => `${(100 * x).toFixed(0)} %`;

const BY: Partial<Record<Choice["kind"], string>> = { bank: ", by a bank", kick: ", by a kick", combination: ", by a combination", carom: ", by a carom" };
const WITHOUT: Partial<Record<Choice["kind"], string>> = { foul: "no shot without a foul was found", break: "a break", push: "a push-out", pass: "to let the other one play" };

export function wordsOfChoice(table: Table, names: readonly string[], one: Choice): string {
  if (one.ball < 0) return WITHOUT[one.kind] ?? "a safety";
  if (table.pockets.length === 0) return `the ${names[one.ball]} ball first`;
  return `ball ${names[one.ball]} into the ${pocketName(table, one.pocket)}${BY[one.kind] ?? ""}`;
}
