// Whole games of every rule set by the page's own game, at each number of seats: each stroke has
// words, the game goes on from its text, and its end says what decided it.
import { expect, test } from "vitest";
import { Play, read } from "../src/play/game.js";
import { wantedOf } from "../src/play/session.js";
import { wordsOfEnd, wordsOfScore, wordsOfStroke, wordsOfTurn } from "../src/play/state.js";
import { PLAYED, SEATS } from "../src/table/games.js";
import { wordsOfPlan } from "../src/table/words.js";
import { carom } from "../../test/builds.js";

const STROKES = 1500;
const CASES = Object.keys(PLAYED).flatMap((game) =>
  (SEATS[game]?.filter((count) => count < 4) ?? [2]).map((seats) => [game, seats] as const),
);

/** Plays what a plan proposes, or takes the choice that it does. */
function playPlanned(play: Play): string {
  const player = carom.player({ fargo: 600, rules: play.state.rules });
  const options = { ...wantedOf(play), player, seed: play.strokes, shots: 100, best: 1 };
  const [choice] = carom.plan(play.table, play.balls, options);
  const { kind, ball, pocket, cue, place } = choice!;
  if (kind === "pass") play.choose("pass");
  else {
    if (play.bounds) play.put(play.cueBall, place[0]!, place[1]!);
    play.strike(cue.ball);
    const named = pocket >= 0 ? { ball, pocket } : undefined;
    const call = kind === "push" ? kind : named;
    play.stroke(carom.withErrors(cue, player, 1, play.strokes), call);
  }
  return wordsOfPlan(play, choice!);
}

test.each(CASES)("a whole game has words: %s at %d seats", (game, seats) => {
  const isOwn = game in SEATS;
  const play = new Play(carom, {
    game,
    against: "500",
    own: "800",
    seed: 5,
    ...(isOwn && { seats }),
  });
  expect(play.points).toHaveLength(seats);
  expect(new Set(play.points).size).toBe(1);
  while (!play.isOver && play.strokes < STROKES) {
    for (const words of [playPlanned(play), wordsOfStroke(play, play.last!, 0)])
      expect(words).not.toMatch(/undefined|^$/);
    expect(wordsOfTurn(play, 0, false)).not.toMatch(/undefined|^$/);
  }
  expect(play.isOver).toBe(true);

  // The winner has the most points, and the end says what decided the game.
  const points = play.points[play.winner!]!;
  expect(Math.max(...play.points)).toBe(points);
  expect(wordsOfEnd(play)).not.toBe("");
  const score = wordsOfScore(play, 0, [0, 0]);
  if (isOwn || play.played!.points) expect(score).toContain(String(points).replace("-", "−"));

  // Another page reads the same game.
  const again = read(carom, play.text());
  expect([again.winner, again.points, again.setup]).toEqual([play.winner, play.points, play.setup]);
});
