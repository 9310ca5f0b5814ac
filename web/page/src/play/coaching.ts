// The coach at the table: the hint and the chances of the stroke that is aimed, and what a stroke
// cost once it was played.
import type { AimOf, Call, Carom, Choice, Cue, PlanOptions, ShotBall, Table } from "carom";
import { drop, far } from "../far.js";
import { onTable } from "../table/filmed.js";
import { isSafe, percent, wordsOfChances, wordsOfChoice } from "../table/words.js";
import { wrong } from "../ui.js";
import { rest } from "./filming.js";
import { OPTIONS } from "./game.js";
import { costOf, keepRow, type Row } from "./log.js";
import {
  aimAt,
  cueOf,
  free,
  levelOf,
  look,
  placeOf,
  playerOf,
  SAFETY,
  says,
  type Session,
  why,
} from "./session.js";

const PLAN = 1000;
const TRY = 200;

/** A stroke that a plan is asked for. */
export interface Asked {
  game: string;
  table: Table;
  balls: readonly ShotBall[];
  names: readonly string[];
  options: PlanOptions;
}

const best = (of: Asked, more: PlanOptions = {}): Promise<Choice> =>
  far("plan", of.table, of.balls, { ...of.options, ...more, best: 1, shots: PLAN }).then(
    ([one]) => one!,
  );
const chance = (of: Asked, cue: Cue): Promise<Choice> =>
  far("chances", of.table, of.balls, [cue], { ...of.options, shots: TRY }).then(([one]) => one!);
const isPot = (call: Call | undefined): call is { ball: number; pocket: number } =>
  typeof call === "object" && call.ball > 0 && call.pocket >= 0;

/** How far a stroke is off the aim at a ball and a pocket. */
export function errors(
  carom: Carom,
  table: Table,
  balls: readonly ShotBall[],
  cue: Cue,
  of: AimOf,
): Pick<Row, "phi" | "speed"> {
  const aim = carom.aim(table, balls, cue, of, OPTIONS);
  if (aim.is === "no_way") return {};
  const phi = ((cue.phi - aim.cue.phi + 540) % 360) - 180;
  // Farther off, something else was meant.
  if (Math.abs(phi) > 10) return {};
  const [low, high] = aim.speed;
  return {
    phi,
    ...(aim.is === "falls"
      ? { speed: cue.speed < low ? cue.speed - low : cue.speed > high ? cue.speed - high : 0 }
      : {}),
  };
}

/** What a plan for whoever sits here begins with: he plays as his rating says. */
export function asked(s: Session): Asked {
  const { play } = s;
  const { against, game, seed } = play.setup;
  const rating = String(levelOf(s));
  const opponent = playerOf(s, /^\d/.test(against) ? against : rating);
  return {
    game,
    table: play.table,
    balls: play.balls,
    names: play.names,
    options: {
      ...play.state,
      player: playerOf(s, rating),
      opponent,
      shot: OPTIONS,
      seed: seed + play.entries.length,
    },
  };
}

export async function advise(s: Session): Promise<void> {
  if (!free(s)) return says(s, why(s));
  const mine = ++s.number;
  s.asking++; // chances that come later do not hide the hint
  says(s, "Looking for the best stroke …");
  try {
    drop("plan"); // what is planned for another stroke
    const one = await best(asked(s), { inHand: placeOf(s) });
    if (mine !== s.number || !free(s)) return;
    if (s.play.hand !== "no") s.play.put(0, ...(one.place as [number, number]));
    aimAt(s, one.cue);
    look(s);
    const [ball, pocket] =
      one.ball > 0 && one.pocket >= 0 ? [one.ball, one.pocket] : [-1, isSafe(one) ? SAFETY : -1];
    s.chosen = { ball, pocket, met: s.first?.ball ?? -1, phi: one.cue.phi };
    s.special = one.kind === "push" ? "push" : undefined;
    s.hinted = true; // what came before makes room for the hint
    rest(s);
    const tip = [
      one.cue.b > 0.1 ? "follow" : one.cue.b < -0.1 ? "draw" : "",
      one.cue.a > 0.1 ? "left side" : one.cue.a < -0.1 ? "right side" : "",
    ]
      .filter(Boolean)
      .join(" and ");
    const words = `${wordsOfChoice(s.play.table, s.play.names, one, s.first?.ball === -1)}${one.kind === "pass" ? "" : `, at ${one.cue.speed.toFixed(1)} m/s${tip && ` with ${tip}`}`}`;
    says(
      s,
      `Hint: ${words}. A ${levelOf(s)}, as you are, ${wordsOfChances(one, s.play.setup.game === "threecushion")}.${s.play.practice ? "" : " This stroke errs like his."}`,
    );
  } catch (error) {
    if (mine === s.number && free(s)) says(s, wrong(error));
  }
}

/** The chances of the stroke that is aimed, a moment after it was. */
export async function chances(s: Session): Promise<void> {
  const mine = ++s.asking;
  const { play } = s;
  if (!free(s) || !play.played || play.setup.drill !== undefined || !onTable(play.balls[0]!.state))
    return;
  await new Promise((later) => window.setTimeout(later, 120));
  if (mine !== s.asking || !free(s)) return;
  try {
    const one = await chance(asked(s), cueOf(s));
    if (mine === s.asking && free(s))
      says(
        s,
        `By this stroke a ${levelOf(s)}, as you are, ${wordsOfChances(one, play.setup.game === "threecushion")}.`,
      );
  } catch (error) {
    if (mine === s.asking) says(s, wrong(error));
  }
}

/** Looks back at a stroke: its chances beside those of the best one. */
export async function lookBack(
  s: Session,
  of: Asked,
  made: Cue,
  calls: Call | undefined,
): Promise<void> {
  s.asking++; // chances of this stroke that come later do not hide its review
  try {
    // Both plans play as the same player.
    const [mine, other] = await Promise.all([chance(of, made), best(of)]);
    const meant = wordsOfChoice(
      of.table,
      of.names,
      isPot(calls)
        ? { ...mine, ...calls }
        : { ...mine, kind: mine.ball < 0 ? "safety" : mine.kind },
    );
    const wins = {
      keep: mine.keep,
      value: mine.value,
      best: wordsOfChoice(of.table, of.names, other),
      bestValue: other.value,
    };
    const row = {
      when: new Date().toISOString().slice(0, 16),
      game: of.game,
      meant,
      ...(isPot(calls) ? errors(s.carom, of.table, of.balls, made, calls) : {}),
      ...wins,
    };
    keepRow(row);
    const cost = costOf(row)!;
    says(
      s,
      `That stroke wins in ${percent(mine.value)} of tries; the best one, ${row.best}, in ${percent(other.value)}. ${cost < 0.02 ? "You chose well." : `It cost ${percent(cost)}.`}`,
    );
  } catch (error) {
    says(s, `The review of that stroke failed: ${wrong(error)}`);
  }
}
