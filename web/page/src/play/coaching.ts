// The coach at the table: the hint and the chances of the stroke that is aimed, and what a stroke cost once it was played.
import type { Call, Carom, Choice, Cue, PlanOptions, Player } from "carom";
import { onTable } from "../table/filmed.js";
import { percent, wordsOfChances } from "../table/words.js";
import { type Asked, chance, costOf, hint, keepRow, review, why } from "./coach.js";
import { OPTIONS, type Play } from "./game.js";

export interface Host {
  play(): Play;
  free(): boolean;
  cue(): Cue;
  player(rating: string): Player;
  place(): PlanOptions["inHand"];
  told(text: string): void;
  /** Begins a search, and tells whether it still counts. */
  search(): number;
  searches(number: number): boolean;
  /** Aims as a choice says, and calls it. */
  aim(one: Choice): void;
}
const wrong = (error: unknown): string => (error instanceof Error ? error.message : String(error));

export function coaching(carom: Carom, host: Host): { asked(): Asked; advise(): Promise<void>; chances(): Promise<void>; lookBack(of: Asked, made: Cue, calls: Call | undefined): Promise<void> } {
  /** What a plan for whoever sits here begins with. Who does not err is advised as a 600. */
  function asked(): Asked {
    const play = host.play();
    const { own, against, game, seed } = play.setup;
    const rating = own === "0" ? "600" : own;
    const opponent = host.player(/^\d/.test(against) ? against : rating);
    return { game, table: play.table, balls: play.balls, names: play.names, options: { ...play.state, player: host.player(rating), opponent, shot: OPTIONS, seed: seed + play.entries.length } };
  }

  let asking = 0;
  async function advise(): Promise<void> {
    if (!host.free()) return;
    const mine = host.search();
    asking++; // chances that come later do not hide the hint
    host.told("Looking for the best stroke …");
    try {
      const of = asked();
      const one = await hint(of, host.place());
      if (!host.searches(mine)) return;
      host.aim(one);
      host.told(`Hint: ${why(of, one, host.play().setup.game === "threecushion")}`);
    } catch (error) {
      if (host.searches(mine)) host.told(wrong(error));
    }
  }

  /** The chances of the stroke that is aimed, a moment after it was. */
  async function chances(): Promise<void> {
    const mine = ++asking;
    const play = host.play();
    if (!host.free() || !play.played || play.setup.drill !== undefined || !onTable(play.balls[0]!.state)) return;
    await new Promise((later) => window.setTimeout(later, 120));
    if (mine !== asking || !host.free()) return;
    try {
      const one = await chance(asked(), host.cue());
      if (mine === asking && host.free()) host.told(`This stroke ${wordsOfChances(one, play.setup.game === "threecushion")}.`);
    } catch (error) {
      if (mine === asking) host.told(wrong(error));
    }
  }

  async function lookBack(of: Asked, made: Cue, calls: Call | undefined): Promise<void> {
    asking++; // chances of this stroke that come later do not hide its review
    try {
      const row = await review(carom, of, made, calls);
      keepRow(row);
      const cost = costOf(row);
      host.told(`That stroke wins in ${percent(row.value)} of tries; the best one, ${row.best}, in ${percent(row.bestValue)}. ${cost < 0.02 ? "You chose well." : `It cost ${percent(cost)}.`}`);
    } catch (error) {
      host.told(`The review of that stroke failed: ${wrong(error)}`);
    }
  }

  return { asked, advise, chances, lookBack };
}
