// A game as acts, beside the recordings of matches that the library plays by itself: the same lines
// come back, and a changed number is refused.
import { load } from "carom";
import { expect, test } from "vitest";
import type { Act, Line } from "../src/play/acts.js";
import { Play, read, type Setup } from "../src/play/game.js";

const carom = await load();
const player = carom.player({ fargo: 400 });
type Stroke = Extract<Act, readonly ["stroke", ...unknown[]]>;
const linesOf = (text: string) => (JSON.parse(text) as { lines: Line[] }).lines;

/** Some turns of a game, with all that a page can do in it. */
function played(setup: Setup, strokes: number): Play {
  const play = new Play(carom, setup);
  for (let k = 0; k < strokes && !play.isOver; k++) {
    if (k === 3) play.clock();
    const { cueBall, acts, played: game } = play;
    if (k > 3 && acts.includes("pass")) play.choose("pass");
    const push = acts.includes("push") && k < 3 ? "push" : undefined;
    const call = game?.calls && k > 0 ? { ball: 3, pocket: k % 6 } : push;
    const aimed = { ball: cueBall, speed: 2 + k, phi: 62 + 97 * k, b: k % 2 ? 0.25 : -0.1 };
    const cue = carom.withErrors({ ...play.cue, ...aimed }, player, setup.seed, k);
    play.stroke(cue, call);
  }
  if (!play.isOver) play.concede(1);
  return play;
}

test.each(["eightball", "nineball", "tenball", "snooker", "threecushion", "pyramid"])(
  "acts give the lines of a game again, in a third of the letters: %s",
  (game) => {
    const play = played({ game, against: "person", own: "0", seed: 5 }, 6);
    const short = play.shortText();
    expect(linesOf(short).every((line) => typeof line === "object")).toBe(true);
    const again = read(carom, short);
    expect(again.lines).toEqual(play.lines);
    expect(again.strokes).toBe(play.strokes);
    expect(read(carom, play.text()).shortText()).toBe(short);
    expect(short.length).toBeLessThan(play.text().length / 3);
    // The number that is told of a stroke is the one that is wrong.
    const changed = linesOf(short).map((line) =>
      line[0] === "stroke" && (line as Stroke)[3][0]! > 4.9 ? [...line.slice(0, 3), [4.5]] : line,
    );
    expect(() => read(carom, JSON.stringify({ ...play.setup, lines: changed }))).toThrow(
      /shot \d is not as it was played.*hash/,
    );
  },
);

test("a game whose beginning no setup gives keeps its beginning, and a stick of another mass stays", () => {
  const match = carom.match("nineball", carom.table("8ft"), { seed: 3 });
  match.place(0.5, 0.3);
  match.stroke({ speed: 8, phi: 80, mass: 0.5 });
  const setup: Setup = { game: "nineball", against: "person", own: "0", seed: 0 };
  const { lines } = match;
  const play = read(carom, JSON.stringify({ ...setup, lines }));
  expect(play.lines).toEqual(lines);
  const short = play.shortText();
  expect(linesOf(short).filter((line) => typeof line === "object")).toHaveLength(2);
  expect(read(carom, short).lines).toEqual(lines);
});
