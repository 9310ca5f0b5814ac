// What the coach draws behind a hint: each sketch ends where its stroke does, and a tap on its
// number finds the stroke.
import { expect, test } from "vitest";
import type { PlanOptions } from "carom";
import { Play } from "../src/play/game.js";
import type { Session } from "../src/play/parts.js";
import { seatPlayer, wantedOf } from "../src/play/session.js";
import { runOutSketches, safetySketches, sketchedAt } from "../src/play/sketches.js";
import { carom } from "../../test/builds.js";

const play = new Play(carom, {
  game: "nineball",
  against: "person",
  own: "0",
  seed: 7,
  at: "0.635,1.2 0.3,2.2 in in 0.9,0.6 in in in in 0.9,1.9",
});
const player = seatPlayer(play, "500");
const options: PlanOptions = { ...wantedOf(play), player, opponent: player, seed: 7, shots: 1000 };

test("safeties end where their cue balls rest, and a tap there finds their strokes", () => {
  const choices = carom.plan(play.table, play.balls, { ...options, safeties: true, best: 2 });
  const sketches = safetySketches(play, choices);
  expect(sketches).toHaveLength(2);
  const s = { play, sketches, hint: choices[0]!.cue, film: { time: 0 } } as unknown as Session;
  for (const [k, { lines, place, zone }] of sketches.entries()) {
    const { final } = carom.simulate(play.table, play.balls, choices[k]!.cue, { ...options.shot });
    expect(place).toEqual([...final[0]!.r].slice(0, 2));
    expect(lines[0]!.points.at(-1)).toEqual(place);
    expect(zone).toEqual([]);
    expect(sketchedAt(s, place)).toBe(choices[k]);
  }
  expect(sketchedAt(s, [0, 0])).toBeUndefined();
  // What is not hinted is not seen.
  expect(sketchedAt({ ...s, hint: undefined } as Session, sketches[0]!.place)).toBeUndefined();
});

test("a run-out has a zone for each stroke, and a line for each pot behind the first one", () => {
  const { strokes } = carom.sequence(play.table, play.balls, { ...options, plays: 1 });
  const sketches = runOutSketches(play, strokes);
  expect(sketches.map(({ lines }) => lines.length)).toEqual([0, 1, 1]);
  const { choice } = strokes[1]!;
  const [start, end] = sketches[1]!.lines[0]!.points;
  const [x, y] = strokes[0]!.ruling.balls[choice.ball]!.state.r;
  expect(start).toEqual([x, y]);
  expect(end).toEqual([...play.table.pockets[choice.pocket]!.centre]);
  expect(sketches[0]!.zone).toBe(strokes[0]!.zone);
});
