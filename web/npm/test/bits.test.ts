// The bits of `plain` on every machine: the golden hashes of core/tests/platforms/bits.expected, of
// collisions and of whole shots.
import { describe, expect, test } from "vitest";
import type { BallState, Carom, Game, RackName, ShotOptions, TableName } from "../dist/index.js";
import { builds, Draws, golden, Hash } from "./support.js";

const ROWS = 4000;
const LABELS = ["stationary", "spinning", "sliding", "rolling", "pocketed", "airborne", "off"];

/** draw_collision() of bits.c, in the order of its draws. */
function drawCollision(draws: Draws, k: number): number[] {
  const wild = k % 2 === 1;
  const radius = 0.028575;
  const x = draws.uniform(-1, 1);
  const y = draws.uniform(-1, 1);
  const length = Math.sqrt(x * x + y * y) + 2 ** -60;
  const aCloth = draws.uniform(0, wild ? 1 : 0.4);
  const bCloth = draws.uniform(0, wild ? 1 : 0.4);
  const bMass = wild ? 0.17 * draws.powerOfTwo(-3, 3) : 0.17;
  const r = [(2 * radius * x) / length, (2 * radius * y) / length, 0];
  const av = [0, 0, 0];
  const bv = [0, 0, 0];
  const aw = [0, 0, 0];
  const bw = [0, 0, 0];
  for (let c = 0; c < 2; c++) {
    av[c] = draws.uniform(-2, 2);
    bv[c] = wild ? draws.uniform(-2, 2) : 0;
    if (wild) bv[c]! *= draws.powerOfTwo(-30, 2);
  }
  for (let c = 0; c < 3; c++) {
    aw[c] = draws.uniform(-100, 100);
    if (wild) aw[c]! *= draws.powerOfTwo(-30, 3);
    bw[c] = wild ? draws.uniform(-100, 100) : 0;
  }
  const muBall = draws.uniform(0, wild ? 1 : 0.12);
  let restitution = draws.uniform(wild ? 0 : 0.8, 1);
  if (k % 97 === 50) restitution = 2;
  return [
    0,
    0,
    0,
    ...av,
    ...aw,
    radius,
    0.17,
    aCloth,
    ...r,
    ...bv,
    ...bw,
    radius,
    bMass,
    bCloth,
    muBall,
    restitution,
  ];
}

function collisions(carom: Carom, solver: "exact" | "euler", slip: "paper" | "pooltool"): string {
  const draws = new Draws(1n);
  const batch = carom.collisions(ROWS);
  const rows = batch.in;
  for (let k = 0; k < ROWS; k++) rows.set(drawCollision(draws, k), 26 * k);
  carom.collideBatch(batch, { solver, slip, steps: 100 });
  const hash = new Hash().numbers(batch.out);
  for (const status of batch.status) hash.whole(status & 0xff);
  batch.free();
  return hash.text;
}

const addState = (hash: Hash, s: BallState) =>
  hash.numbers([...s.r, ...s.v, ...s.w]).whole(LABELS.indexOf(s.label));

const TYPES = [
  "stick_ball",
  "ball_ball",
  "ball_linear_cushion",
  "ball_circular_cushion",
  "ball_pocket",
];
const LATER = ["sliding_rolling", "rolling_spinning", "rolling_stationary", "spinning_stationary"];

/** shots() of bits.c, up to and with the combinations asked for. */
function shots(carom: Carom, keys: string[]): Map<string, string> {
  const games: [string, RackName, TableName, Game][] = [
    ["nine-ball", "nineball", "9ft", "pool"],
    ["eight-ball", "eightball", "7ft", "pool"],
    ["snooker", "snooker", "snooker", "pooltool_snooker"],
    ["three-cushion", "threecushion", "threecushion", "pooltool_billiard"],
  ];
  const models: [string, ShotOptions][] = [
    ["default", {}],
    ["stronge", { cushionModel: "stronge" }],
    ["han", { cushionModel: "han", friction: "constant" }],
  ];
  const draws = new Draws(4n);
  const found = new Map<string, string>();
  for (const [modelName, options] of models) {
    for (const [gameName, rackName, tableName, game] of games) {
      const hash = new Hash();
      const table = carom.table(tableName);
      for (let k = 0; k < 4; k++) {
        const balls = carom.rack(rackName, table, { gap: k === 1 ? 0 : 1e-4, seed: k });
        const kind = carom.kind(game);
        for (const ball of balls) {
          ball.kind = kind;
          const [x, y] = ball.state.r;
          ball.state = { ...ball.state, r: [x, y, kind.radius] };
        }
        const speed = draws.uniform(0.5, 8.5);
        const phi = rackName === "threecushion" ? draws.uniform(0, 360) : draws.uniform(80, 100);
        const theta = k === 3 ? draws.uniform(0, 60) : 2;
        const a = draws.uniform(-0.4, 0.4);
        const b = draws.uniform(-0.4, 0.4);
        const shot = carom.simulate(table, balls, carom.cue({ speed, phi, theta, a, b }, game), {
          ...options,
          space: "flat",
        });
        hash.whole(0).whole(shot.count);
        for (const event of shot.events) {
          const type = [...TYPES, ...LATER].indexOf(event.type) + 1;
          if (type === 0) throw new Error(`an event of an unknown type: ${event.type}`);
          hash.number(event.time).whole(type * 10000 + event.a * 100 + event.b);
          event.before.forEach((state, side) =>
            addState(addState(hash, state), event.after[side]!),
          );
        }
        for (const state of shot.final) addState(hash, state);
        hash.number(shot.time);
        for (const state of shot.states(1.25)) addState(hash, state);
      }
      found.set(`shots: ${gameName}, ${modelName}`, hash.text);
      if (keys.every((what) => found.has(what))) return found;
    }
  }
  return found;
}

describe.each(builds)("bits of $name", ({ carom }) => {
  test.each([
    ["exact", "paper"],
    ["exact", "pooltool"],
    ["euler", "paper"],
    ["euler", "pooltool"],
  ] as const)("collisions: %s, slip %s", (solver, slip) => {
    expect(collisions(carom, solver, slip)).toBe(
      golden(`collisions: ${solver}, slip ${slip}, double`),
    );
  });

  test("whole shots: four games by three models of cushions", () => {
    const keys = ["default", "stronge", "han"].flatMap((model) =>
      ["nine-ball", "eight-ball", "snooker", "three-cushion"].map(
        (game) => `shots: ${game}, ${model}`,
      ),
    );
    const found = shots(carom, keys);
    for (const what of keys) expect(`${what} ${found.get(what)}`).toBe(`${what} ${golden(what)}`);
  });
});
