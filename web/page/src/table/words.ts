// Plans as sentences: the chosen stroke, and its chances.
import type { PlanStroke, Table } from "carom";
import { pocketName } from "../../../player/words.js";
import { texts, translate } from "../texts/texts.js";

/** Fargo ratings that one can choose. */
export const RATINGS = ["200", "300", "400", "500", "600", "700", "800"];
export const percent = (x: number): string => `${(100 * x).toFixed(0)} %`;

const BY: Partial<Record<PlanStroke["kind"], string>> = {
  bank: texts.byABank,
  kick: texts.byAKick,
  rail_first: texts.offACushionFirst,
  combination: texts.byACombination,
  carom: texts.byACarom,
  kiss: texts.byAKiss,
};
/** Choices in which no ball is named, whatever their tries did. */
const WITHOUT: Partial<Record<PlanStroke["kind"], string>> = {
  foul: texts.aFoulBecauseNo,
  break: texts.aBreak,
  push: texts.aPushOut,
  pass: texts.aPassTheOther,
};
/** A stroke that names no ball, by what its tries did. */
function wordsWithoutBall(table: Table, choice: PlanStroke): string {
  if (table.pockets.length === 0) return texts.aStrokeAfterWhich;
  if (isSafe(table, choice)) return texts.aSafety;
  return choice.keep < LUCK ? texts.aRiskyStroke : texts.aStrokeWithoutA;
}

/**
 * How often a stroke keeps the turn, wins the game, and is a foul. Where it is `alone`, the chance
 * to win is not known.
 */
export function wordsOfChances(
  { keep, value, foul }: Pick<PlanStroke, "keep" | "value" | "foul">,
  alone: boolean,
): string {
  return alone
    ? texts.chancesAlone(percent(keep), percent(foul))
    : texts.chancesOf(percent(keep), percent(value), percent(foul));
}

/** A ball that keeps the turn less often falls by luck, as carom_names_ball() has it. */
const LUCK = 0.1;
/** A stroke without a pot that is a foul as often is no safety, as \`carom plan\` has it. */
const RISKY = 0.15;
/** Whether a stroke is meant to make the ball that it names: its tries did, or a caller named it. */
export const namesBall = (
  { pockets }: Pick<Table, "pockets">,
  { kind, ball, keep }: PlanStroke,
): boolean => ball >= 0 && (pockets.length === 0 || kind === "given" || keep >= LUCK);
/** Whether a stroke passes the turn, and seldom by a foul. */
export const isSafe = (table: Pick<Table, "pockets">, choice: PlanStroke): boolean =>
  !namesBall(table, choice) && choice.keep < LUCK && choice.foul < RISKY;
/** A longer table, m, is snooker's, whose pockets have names of their own. */
const SNOOKER_LENGTH = 3.5;
/** The pockets of snooker, by the end of the table: from baulk to the black spot. */
const SNOOKER_POCKETS = [
  [texts.yellowPocket, texts.greenPocket],
  [texts.rightCentre, texts.leftCentre],
  [texts.rightBlack, texts.leftBlack],
] as const;
/** The name of a pocket: on a table of snooker "green pocket", else "head-left pocket". */
export function wordsOfPocket(table: Table, pocket: number): string {
  const { width, length, pockets } = table;
  const [x, y] = pockets[pocket]!.centre;
  if (length <= SNOOKER_LENGTH) return translate(pocketName(table, pocket));
  const [right, left] = SNOOKER_POCKETS[Math.max(0, Math.min(2, Math.floor((3 * y) / length)))]!;
  return x > width / 2 ? right : left;
}
/** The name of a ball as players say it: nobody sees the numbers of reds and yellows. */
export const spoken = (name: string): string => translate(name.replace(/^(red|yellow) \d+$/, "$1"));
/** The name of a pot: "ball 7 into the side-left pocket". */
export function wordsOfPot(
  table: Table,
  names: readonly string[],
  { ball, pocket }: Pick<PlanStroke, "ball" | "pocket">,
  how = "",
): string {
  const name = names[ball]!;
  const into = wordsOfPocket(table, pocket);
  return Number(name) > 0
    ? texts.ballNumberInto(name, into, how)
    : texts.intoThe(spoken(name), into, how);
}
interface WhatMayBeStruck {
  table: Table;
  names: readonly string[];
  strikable: readonly number[];
}
/** What a choice is, with the ball that it strikes where the player has chosen it. */
export function wordsOfPlan(
  { table, names, strikable }: WhatMayBeStruck,
  choice: PlanStroke,
  cushionFirst = false,
): string {
  const words = wordsOfChoice(table, names, choice, cushionFirst);
  if (strikable.length < 2) return words;
  return texts.withTheBall(ballOf(names, choice.cue.ball), words);
}
/** The name of a ball: "ball 7", "the yellow". */
export function ballOf(names: readonly string[], ball: number): string {
  const name = names[ball]!;
  return Number(name) > 0 ? texts.ballNumber(name) : texts.theBallNamed(spoken(name));
}
/** What a choice is, by which the cue ball may be known to meet a cushion first. */
function wordsOfChoice(
  table: Table,
  names: readonly string[],
  choice: PlanStroke,
  cushionFirst = false,
): string {
  const { kind, ball } = choice;
  if (!namesBall(table, choice)) return WITHOUT[kind] ?? wordsWithoutBall(table, choice);
  // A cannon names the ball that is met first.
  if (choice.pocket < 0) return texts.theBallFirst(spoken(names[ball]!));
  const isNamed = kind === "kick" || kind === "rail_first";
  const first = cushionFirst && !isNamed ? texts.offACushionFirst : "";
  return wordsOfPot(table, names, choice, `${BY[kind] ?? ""}${first}`);
}
