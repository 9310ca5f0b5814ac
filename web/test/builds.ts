// The builds of the package, which take seconds to load: tests of pages alone do without.
import { existsSync } from "node:fs";
import { afterEach } from "vitest";
import {
  type Carom,
  load,
  type RackName,
  type ShotBall,
  type Table,
  type TableName,
  type Vec2,
} from "carom";
import { root } from "./support.js";

/** Whether there is the build without vectors, which `web/npm/build simd` leaves out. */
export const thereIsPlain = existsSync(`${root}build/web/plain.wasm.gz`);
if (!thereIsPlain) {
  if (process.env.CAROM_PAGE === "whole") throw new Error("web/npm/build has left out a build");
  console.log("without the tests by the build plain, which web/npm/build makes");
}
const names = thereIsPlain ? (["simd", "plain"] as const) : (["simd"] as const);
export const builds = await Promise.all(
  names.map(async (build) => ({
    name: build as string,
    carom: await load({ build }),
  })),
);
/** The build that the page has. */
export const { carom } = builds[0]!;
// The worker answers after each test, so that Vitest does not take a file of long computations for
// one that hangs.
afterEach(() => new Promise<void>((answers) => setImmediate(answers)));

/** The balls of a layout, all of them down. */
export const allDown = (balls: readonly ShotBall[]): ShotBall[] =>
  balls.map(({ kind, state }) => ({
    kind,
    state: { ...state, r: [0, 0, -0.1], label: "pocketed" },
  }));
/** Some balls of a game where they are put; the others are down. */
export function lay(
  carom: Carom,
  rack: RackName,
  places: Record<number, Vec2>,
  name: TableName = "9ft",
): { table: Table; balls: ShotBall[] } {
  const table = carom.table(name);
  let balls = allDown(carom.rack(rack, table));
  for (const [k, [x, y]] of Object.entries(places))
    balls = carom.placeBall(table, balls, Number(k), x, y);
  return { table, balls };
}
