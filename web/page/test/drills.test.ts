// Drills of the page: each can be made, by a stroke that a search finds, and a stroke that does
// nothing makes none.
import { readFileSync } from "node:fs";
import { expect, test } from "vitest";
import type { Carom, Cue } from "carom";
import { drillStroke, strokesFor } from "../src/play/drill_search.js";
import { type Drill, drillsOf, judge } from "../src/play/drills.js";
import { Play } from "../src/play/game.js";
import { allDown, carom, lay } from "../../test/builds.js";
import { root } from "../../test/support.js";

const drills = drillsOf(readFileSync(`${root}data/drills.csv`, "utf8"));
const ROWS = drills.map((drill) => [drill.name, drill] as const);
const OPTIONS = {};

const layout = (carom: Carom, { balls }: Drill) =>
  lay(carom, "eightball", Object.fromEntries(balls));
test("there are twenty, with names of their own", () => {
  expect(drills).toHaveLength(20);
  expect(new Set(drills.map(({ name }) => name)).size).toBe(20);
});

// For new drills: CAROM_DRILLS=1 prints each rating, by the best of 200 strokes; three balls fall by
// three such strokes.
test.runIf(process.env.CAROM_DRILLS)("ratings that make a drill in half of the tries", () => {
  for (const drill of drills) {
    const { table, balls } = layout(carom, drill);
    const good = (cue: Partial<Cue>) =>
      judge(drill, carom.simulate(table, balls, cue, OPTIONS)).outcome !== "missed";
    const strokes: Partial<Cue>[] = [];
    for (const cue of strokesFor(carom, table, balls, drill, 200, OPTIONS))
      if (good(cue) && strokes.push(cue) === 200) break;
    const share = (cue: Partial<Cue>, fargo: number, count: number) =>
      Array.from({ length: count }, (_, k) =>
        good(carom.withErrors(cue, carom.player({ fargo }), count, k)),
      ).filter(Boolean).length / count;
    const best = (fargo: number) =>
      Math.max(
        ...strokes
          .map((cue) => [share(cue, fargo, 25), cue] as const)
          .sort(([a], [b]) => b - a)
          .slice(0, 8)
          .map(([, cue]) => share(cue, fargo, 300)),
      ) ** (drill.name === "Clear the line" ? 3 : 1);
    console.log(
      drill.name,
      drill.rating,
      [300, 400, 500, 600, 700, 800]
        .map((fargo) => `${fargo}: ${best(fargo).toFixed(2)}`)
        .join(", "),
    );
  }
});

test.each(ROWS)("%s can be made, and is not made by itself", (_, drill) => {
  const { table, balls } = layout(carom, drill);
  const play = (cue: Partial<Cue>) => carom.simulate(table, balls, cue, OPTIONS);
  expect(judge(drill, play({ speed: 0.1, phi: 200, b: 0 }))).toMatchObject({ outcome: "missed" });
  // Where three balls are to fall, the stroke goes on.
  for (const cue of strokesFor(carom, table, balls, drill, 200, OPTIONS))
    if (judge(drill, play(cue)).outcome !== "missed") return;
  expect.fail(`${drill.name}: no stroke of 200 for each way makes it`);
});

test.each(ROWS)(
  "the hint of %s makes it, and a player of its rating makes it in about half of the tries",
  (_, drill) => {
    const { table, balls } = layout(carom, drill);
    const player = carom.player({ fargo: drill.rating });
    const { cue, chance } = drillStroke(carom, table, balls, drill, player, OPTIONS)!;
    expect(judge(drill, carom.simulate(table, balls, cue, OPTIONS)).outcome).not.toBe("missed");
    expect(chance).toBeGreaterThan(0.25);
  },
);

test("a game of pool is played on the table that it names, with the pockets of that table", () => {
  const practiceOn = (table?: string, game = "nineball") =>
    new Play(carom, {
      game,
      against: "practice",
      own: "0",
      seed: 1,
      ...(table !== undefined && { table }),
    });
  expect(["9ft", "8ft", "7ft", "tight"].map((name) => practiceOn(name).table.width)).toEqual([
    1.27, 1.1176, 0.9906, 1.27,
  ]);
  expect(practiceOn().table).toEqual(practiceOn("9ft").table);
  // Of balls side by side that run at a corner, fewer fall into the tight one.
  const into = ({ table, balls }: Play) => {
    const line = Array.from({ length: 41 }, (_, k) =>
      carom.placeBall(table, allDown(balls), 0, 0.4, 0.4 + 0.002 * k),
    );
    return line.filter(
      (balls) =>
        carom.simulate(table, balls, carom.cue({ speed: 2, phi: 225 }), OPTIONS).final[0]!.label ===
        "pocketed",
    ).length;
  };
  const usual = into(practiceOn("9ft"));
  const tight = into(practiceOn("tight"));
  expect(tight).toBeGreaterThan(2);
  expect(tight).toBeLessThan(usual);
  expect(() => practiceOn("10ft")).toThrow('table: this game has no table "10ft"');
  expect(() => practiceOn("7ft", "snooker")).toThrow('this game has no table "7ft"');
});
