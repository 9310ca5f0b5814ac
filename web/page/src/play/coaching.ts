// The coach at the table: the hint and the chances of the stroke that is aimed, and what a stroke cost once it was played.
import type { Call, Cue } from "carom";
import { onTable } from "../table/filmed.js";
import { percent, wordsOfChances } from "../table/words.js";
import { wrong } from "../ui.js";
import { type Asked, chance, costOf, hint, keepRow, review, why } from "./coach.js";
import { rest } from "./filming.js";
import { OPTIONS } from "./game.js";
import { aimAt, cueOf, free, look, NONE, placeOf, playerOf, says, type Session } from "./session.js";

/** What a plan for whoever sits here begins with. Who does not err is advised as a 600. */
export function asked(s: Session): Asked {
  const { play } = s;
  const { own, against, game, seed } = play.setup;
  const rating = own === "0" ? "600" : own;
  const opponent = playerOf(s, /^\d/.test(against) ? against : rating);
  return { game, table: play.table, balls: play.balls, names: play.names, options: { ...play.state, player: playerOf(s, rating), opponent, shot: OPTIONS, seed: seed + play.entries.length } };
}

export async function advise(s: Session): Promise<void> {
  if (!free(s)) return;
  const mine = ++s.number;
  s.asking++; // chances that come later do not hide the hint
  says(s, "Looking for the best stroke …");
  try {
    const of = asked(s);
    const one = await hint(of, placeOf(s));
    if (mine !== s.number || !free(s)) return;
    if (s.play.hand !== "no") s.play.put(0, ...(one.place as [number, number]));
    aimAt(s, one.cue);
    look(s);
    s.chosen = one.ball > 0 && one.pocket >= 0 ? { ball: one.ball, pocket: one.pocket, met: s.first?.ball ?? -1, phi: one.cue.phi } : NONE;
    s.special = one.kind === "push" ? "push" : undefined;
    rest(s);
    says(s, `Hint: ${why(of, one, s.play.setup.game === "threecushion")}`);
  } catch (error) {
    if (mine === s.number && free(s)) says(s, wrong(error));
  }
}

/** The chances of the stroke that is aimed, a moment after it was. */
export async function chances(s: Session): Promise<void> {
  const mine = ++s.asking;
  const { play } = s;
  if (!free(s) || !play.played || play.setup.drill !== undefined || !onTable(play.balls[0]!.state)) return;
  await new Promise((later) => window.setTimeout(later, 120));
  if (mine !== s.asking || !free(s)) return;
  try {
    const one = await chance(asked(s), cueOf(s));
    if (mine === s.asking && free(s)) says(s, `This stroke ${wordsOfChances(one, play.setup.game === "threecushion")}.`);
  } catch (error) {
    if (mine === s.asking) says(s, wrong(error));
  }
}

export async function lookBack(s: Session, of: Asked, made: Cue, calls: Call | undefined): Promise<void> {
  s.asking++; // chances of this stroke that come later do not hide its review
  try {
    const row = await review(s.carom, of, made, calls);
    keepRow(row);
    const cost = costOf(row);
    says(s, `That stroke wins in ${percent(row.value)} of tries; the best one, ${row.best}, in ${percent(row.bestValue)}. ${cost < 0.02 ? "You chose well." : `It cost ${percent(cost)}.`}`);
  } catch (error) {
    says(s, `The review of that stroke failed: ${wrong(error)}`);
  }
}
