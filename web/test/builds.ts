// Both builds of the package, which take seconds to load: tests of pages alone do without.
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

export const builds = await Promise.all(
  (["simd", "plain"] as const).map(async (build) => ({
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
