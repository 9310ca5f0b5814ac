// Who aimed a stroke is kept with a game, and what a stroke is called is what its tries did.
import { expect, test } from "vitest";
import type { PlanStroke } from "carom";
import { Play, read } from "../src/play/game.js";
import { isRated } from "../src/play/ladder.js";
import { GAMES } from "../src/table/games.js";
import { wordsOfPlan } from "../src/table/words.js";
import { carom } from "../../test/builds.js";

const soft = { speed: 1.5, phi: 90 };
const play = (own = "800") => new Play(carom, { game: "nineball", against: "500", own, seed: 3 });

test.each([
  ["the player's alone", ["player", "opponent"], "800", true],
  ["one of a hint", ["player", "hint"], "800", false],
  ["one of a line", ["line", "player"], "800", false],
  ["without errors", ["player"], "0", false],
] as const)("who aimed is kept with a game, which counts or not: %s", (_, aims, own, counts) => {
  const game = play(own);
  for (const aimer of aims) game.stroke(carom.cue(soft), undefined, aimer);
  expect(isRated(game)).toBe(counts);
  const again = read(carom, game.text());
  expect(again.aims).toEqual(aims);
  expect(isRated(again)).toBe(counts);
  // A recording, and a text of an older page, do not say who aimed.
  const { aims: letters, ...older } = JSON.parse(game.text()) as { aims: string };
  expect(letters).toBe(aims.map(([letter]) => letter).join(""));
  expect(read(carom, JSON.stringify(older)).aims).toEqual(aims.map(() => "line"));
});

const table = carom.table("9ft");
const names = Array.from({ length: 16 }, (_, k) => GAMES.eightball!.names(k));
const words = (choice: Partial<PlanStroke>) =>
  wordsOfPlan({ table, names, strikable: [0] }, {
    kind: "pot",
    ball: 7,
    pocket: 0,
    keep: 0.5,
    foul: 0.05,
    ...choice,
  } as PlanStroke);
test.each([
  ["a pot that falls", {}, /^ball 7 into the/],
  ["one that falls by luck", { keep: 0.04 }, "a safety"],
  ["a safety", { kind: "safety", ball: -1, keep: 0.02 }, "a safety"],
  ["one that fouls", { kind: "safety", ball: -1, keep: 0.02, foul: 0.57 }, /often a foul/],
  ["balls that fall by luck", { kind: "scan", ball: -1, keep: 0.4 }, /several balls may drop/],
  ["a pot that a player called", { kind: "given", keep: 0.04 }, /^ball 7 into the/],
  ["a push-out", { kind: "push", ball: -2, pocket: -1, keep: 0 }, "a push-out"],
] as const)("a stroke is called what its tries did: %s", (_, choice, expected) => {
  expect(words(choice)).toEqual(
    typeof expected === "string" ? expected : expect.stringMatching(expected),
  );
});
