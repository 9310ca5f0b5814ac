// Shoot alone, as the page sets it for a new game, is legal by the referee: in each game, and for
// several racks.
import { load } from "carom";
import { expect, test } from "vitest";
import { firstStroke } from "../src/play/first.js";
import { Play } from "../src/play/game.js";
import { PLAYED } from "../src/table/games.js";

const carom = await load();
const SEEDS = [1, 2, 3, 4, 5];

/** The value that a search returns, and after how many tries. */
function resultOf<T>(search: Generator<undefined, T>): { value: T; tries: number } {
  for (let tries = 0; ; tries++) {
    const { done, value } = search.next();
    if (done) return { value, tries };
  }
}

test.each(Object.keys(PLAYED))("the first stroke is no foul: %s", (game) => {
  for (const seed of SEEDS) {
    const setup = { game, against: "person", own: "0", seed } as const;
    const play = new Play(carom, setup);
    const usual = { ...play.cue, ball: play.cueBall, ...play.played!.begin };
    const { value: cue } = resultOf(firstStroke(play, usual));
    const { ruling } = new Play(carom, setup).stroke(cue);
    expect(ruling!.foul, `seed ${seed}: ${ruling!.why}`).toBe(false);
  }
});
