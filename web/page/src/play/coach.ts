// The coach: the best stroke and why, the chance of the one that is aimed, and after it what it cost. What was played is kept as a log of errors.
import type { Call, Carom, Choice, Cue, PlanOptions, ShotBall, Table } from "carom";
import { drop, far } from "../far.js";
import { percent, wordsOfChances, wordsOfChoice } from "../table/words.js";
import { button, dialog, el } from "../ui.js";
import { OPTIONS } from "./game.js";
import { kept, keepText } from "./keep.js";

const [PLAN, TRY] = [1000, 200];
const LOG = "carom-log";
const MOST = 500;

/** A stroke of the log. Errors are those of the aim at the ball that was meant: the direction, degrees, and the speed beyond its range, m/s. */
export interface Row {
  when: string;
  game: string;
  meant: string;
  phi?: number;
  speed?: number;
  /** Chances that it keeps the turn and wins, of this stroke and of the best one. */
  keep: number;
  value: number;
  best: string;
  bestValue: number;
}
export interface Asked {
  game: string;
  table: Table;
  balls: readonly ShotBall[];
  names: readonly string[];
  options: PlanOptions;
}

/** Why a stroke is good: what happens, and its chances. */
export function why({ table, names }: Asked, one: Choice, alone: boolean): string {
  const tip = [one.cue.b > 0.1 ? "follow" : one.cue.b < -0.1 ? "draw" : "", one.cue.a > 0.1 ? "left side" : one.cue.a < -0.1 ? "right side" : ""].filter((word) => word !== "").join(" and ");
  return `${wordsOfChoice(table, names, one)}, at ${one.cue.speed.toFixed(1)} m/s${tip && ` with ${tip}`}. It ${wordsOfChances(one, alone)}.`;
}

/** The best stroke; dropped where another one is asked for. */
export async function hint(of: Asked, inHand: PlanOptions["inHand"] = false): Promise<Choice> {
  drop("plan");
  const [one] = await far("plan", of.table, of.balls, { ...of.options, inHand, best: 1, shots: PLAN });
  return one!;
}
export async function chance(of: Asked, cue: Cue): Promise<Choice> {
  const [one] = await far("chances", of.table, of.balls, [cue], { ...of.options, shots: TRY });
  return one!;
}

/** How far a stroke is off the aim at what it called. */
function errors(carom: Carom, { table, balls }: Asked, cue: Cue, call: Call | undefined): Pick<Row, "phi" | "speed"> {
  if (typeof call !== "object" || call.ball <= 0 || call.pocket < 0) return {};
  const aim = carom.aim(table, balls, cue, call, OPTIONS);
  if (aim.is === "no_way") return {};
  const phi = ((cue.phi - aim.cue.phi + 540) % 360) - 180;
  // Farther off, something else was meant.
  if (Math.abs(phi) > 10) return {};
  const [low, high] = aim.speed;
  return { phi, ...(aim.is === "falls" ? { speed: cue.speed < low ? cue.speed - low : cue.speed > high ? cue.speed - high : 0 } : {}) };
}

/** Looks back at a stroke: its chances beside those of the best one. Both plans play as the same player. */
export async function review(carom: Carom, of: Asked, cue: Cue, call: Call | undefined): Promise<Row> {
  const [mine, best] = await Promise.all([chance(of, cue), far("plan", of.table, of.balls, { ...of.options, best: 1, shots: PLAN }).then(([one]) => one!)]);
  const meant = typeof call === "object" && call.ball > 0 && call.pocket >= 0 ? wordsOfChoice(of.table, of.names, { ...mine, ball: call.ball, pocket: call.pocket }) : wordsOfChoice(of.table, of.names, { ...mine, kind: mine.ball < 0 ? "safety" : mine.kind });
  return { when: new Date().toISOString().slice(0, 16), game: of.game, meant, ...errors(carom, of, cue, call), keep: mine.keep, value: mine.value, best: wordsOfChoice(of.table, of.names, best), bestValue: best.value };
}
/** What a stroke cost against the best one: its chance to win less, never below 0 but for the spread of both plans. */
export const costOf = ({ value, bestValue }: Row): number => Math.max(bestValue - value, 0);

export const rows = (): Row[] => JSON.parse(kept(LOG) ?? "[]") as Row[];
export const keepRow = (row: Row): void => keepText(JSON.stringify([...rows(), row].slice(-MOST)), LOG);

/** The log as a page to print. */
export function logPage(): { root: HTMLDialogElement; open(): void } {
  const body = el("tbody");
  const sum = el("p", { id: "log-sum" });
  const head = ["When", "Game", "Meant", "Aim off by, °", "Speed off by, m/s", "Keeps the turn", "Wins", "Best stroke", "Best wins", "Cost"];
  const table = el("table", { class: "numbers log" }, el("caption", {}, "Strokes, the last one first"), el("thead", {}, el("tr", {}, ...head.map((text) => el("th", { scope: "col" }, text)))), body);
  const clear = button("Delete all", () => {
    keepText("[]", LOG);
    fill();
  });
  const root = dialog("log", "What your strokes cost", sum, el("div", { class: "scrolls", tabindex: "0", role: "region", "aria-label": "Strokes" }, table), el("div", { class: "row no-print" }, button("Print", () => window.print(), { id: "print-log" }), clear));
  function fill(): void {
    const all = rows();
    const number = (x: number | undefined, places: number): string => (x === undefined ? "" : x.toFixed(places));
    body.replaceChildren(...[...all].reverse().map((row) => el("tr", {}, ...[row.when.replace("T", " "), row.game, row.meant, number(row.phi, 2), number(row.speed, 1), percent(row.keep), percent(row.value), row.best, percent(row.bestValue), percent(costOf(row))].map((text) => el("td", {}, text)))));
    const mean = (of: (row: Row) => number | undefined): number => {
      const known = all.flatMap((row) => of(row) ?? []);
      return known.reduce((total, x) => total + x, 0) / Math.max(known.length, 1);
    };
    sum.textContent = all.length === 0 ? "No stroke yet: the coach, in New game, writes one line for each." : `${all.length} ${all.length === 1 ? "stroke" : "strokes"}. A stroke cost ${percent(mean(costOf))} of a game on average. The aim was off by ${mean(({ phi }) => phi && Math.abs(phi)).toFixed(2)}°.`;
  }
  return {
    root,
    open() {
      fill();
      root.showModal();
    },
  };
}
