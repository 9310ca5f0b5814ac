// Drills of the page: each can be made, by a stroke that a search finds, and a stroke that does nothing makes none.
import { readFileSync } from "node:fs";
import { expect, test } from "vitest";
import type { Carom, Cue, ShotBall, Shot } from "carom";
import { type Drill, drillsOf, judge } from "../src/play/drills.js";
import { builds, Draws, root } from "../../test/support.js";

const drills = drillsOf(readFileSync(`${root}data/drills.csv`, "utf8"));
const OPTIONS = { cushionModel: "han" } as const;

function layout(carom: Carom, { balls }: Drill): { table: ReturnType<Carom["table"]>; balls: ShotBall[] } {
  const table = carom.table("9ft");
  let lie = carom.rack("eightball", table).map(({ kind, state }): ShotBall => ({ kind, state: { ...state, r: [0, 0, -0.1], label: "pocketed" } }));
  for (const [ball, [x, y]] of balls) lie = carom.placeBall(table, lie, ball, x, y);
  return { table, balls: lie };
}
/** Strokes that may make a drill: at pockets where a ball is to fall, and in all directions. */
function* strokes(carom: Carom, drill: Drill): Generator<Partial<Cue>> {
  const { table, balls } = layout(carom, drill);
  const draws = new Draws(3n);
  const ways: { ball: number; via?: (string | number)[]; into?: string | undefined }[] = [];
  for (const [word, value] of drill.goal) {
    const ball = parseInt(value);
    const into = value.split("@")[1];
    if (word === "pot") ways.push({ ball, into }, ...[1, 2].filter((one) => one !== ball && drill.balls.has(one)).map((one) => ({ ball, via: [one] })));
    if (word === "bank") for (const rail of ["head", "foot", "left", "right"]) ways.push({ ball, via: [rail] });
    if (word === "clear") ways.push(...[1, 2, 3].map((ball) => ({ ball })));
  }
  for (let k = 0; k < 1_000_000; k++) {
    const stroke = { speed: draws.between(0.5, 5), a: draws.between(-0.3, 0.3), b: draws.between(-0.5, 0.5) };
    if (ways.length === 0) yield { ...stroke, phi: draws.between(0, 360) };
    else
      for (const { into, ...way } of ways)
        for (const pocket of into === undefined ? [0, 1, 2, 3, 4, 5] : [into]) {
          const aim = carom.aim(table, balls, { ...stroke, a: 0 }, { ...way, pocket }, OPTIONS);
          if (aim.is !== "no_way") yield aim.cue;
        }
  }
}

test("there are twenty, with names of their own", () => {
  expect(drills).toHaveLength(20);
  expect(new Set(drills.map(({ name }) => name)).size).toBe(20);
});

test.each(drills.map((drill) => [drill.name, drill] as const))("%s can be made, and is not made by itself", (_, drill) => {
  const { carom } = builds[0]!;
  const { table, balls } = layout(carom, drill);
  const play = (cue: Partial<Cue>): Shot => carom.simulate(table, balls, cue, OPTIONS);
  expect(judge(drill, play({ speed: 0.1, phi: 200, b: 0 }))).toBe("missed");
  let tries = 0;
  for (const cue of strokes(carom, drill)) {
    tries++;
    const is = judge(drill, play(cue));
    if (is === "made" || (is === "on" && drill.goal[0]![0] === "clear")) return;
    if (tries === 1000) break;
  }
  expect.fail(`${drill.name}: no stroke of ${tries} makes it`);
});
