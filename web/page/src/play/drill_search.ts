// The best stroke of a drill: the search tries strokes at the balls and pockets of the goal, or in
// all directions, and chooses the one with which a player makes the drill most often.
import type { Carom, Cue, Player, ShotBall, ShotOptions, Table } from "carom";
import { type Drill, judge } from "./drills.js";

/** A ball that is to fall, by which other ball or rail, and into which pocket. */
interface Way {
  ball: number;
  via?: (string | number)[];
  into?: string | undefined;
}
const RAILS = ["head", "foot", "left", "right"];

/** The ways by which the balls of a goal may fall; none where no ball is to fall. */
function waysOf({ goal, balls }: Drill): Way[] {
  return goal.flatMap(([word, value]): Way[] => {
    const ball = parseInt(value);
    const into = value.split("@")[1];
    if (word === "bank") return RAILS.map((rail) => ({ ball, via: [rail] }));
    if (word === "clear") return [...balls.keys()].filter((k) => k > 0).map((k) => ({ ball: k }));
    if (word !== "pot") return [];
    const others = [...balls.keys()].filter((k) => k > 0 && k !== ball);
    return [{ ball, into }, ...others.map((stop) => ({ ball, into, via: [stop] }))];
  });
}

/** After so many strokes for which there is no way to a pocket, and none for which there is one. */
const GIVEN_UP = 3;

/** Point k of a sequence that fills the unit cube evenly (Roberts' R3), so that no two runs differ. */
function pointOf(k: number): [number, number, number] {
  const root = 1.2207440846057596; // x^4 = x + 1
  return [1, 2, 3].map((power) => (0.5 + (k + 1) / root ** power) % 1) as [number, number, number];
}

/** Strokes that may make a drill, `most` for each way; more where no ball is to fall. */
export function* strokesFor(
  carom: Carom,
  table: Table,
  balls: readonly ShotBall[],
  drill: Drill,
  most: number,
  options: ShotOptions,
): Generator<Cue> {
  const isOnTable = (ball: number): boolean => balls[ball]!.state.label !== "pocketed";
  const aims = waysOf(drill)
    .filter(({ ball }) => isOnTable(ball))
    .flatMap(({ into, ...way }) => {
      const pockets = into === undefined ? [...table.pockets.keys()] : [into];
      return pockets.map((pocket) => ({ target: { ...way, pocket }, failed: 0 }));
    });
  const isInAllDirections = aims.length === 0;
  // A direction is cheap to try, and the aim at a pocket is not.
  const count = isInAllDirections ? 30 * most : most;
  for (let k = 0; k < count; k++) {
    const [x, y, z] = pointOf(k);
    const cue = carom.cue({ speed: 0.5 + 4.5 * x, b: y - 0.5 });
    if (isInAllDirections) {
      yield { ...cue, phi: 360 * z, a: 0 };
      continue;
    }
    for (const aim of aims) {
      // A way that the first strokes do not find is closed to the others too: to find that out
      // takes longest.
      if (aim.failed >= GIVEN_UP) continue;
      const { outcome, cue: aimed } = carom.aim(table, balls, cue, aim.target, options);
      if (outcome === "no_way") aim.failed++;
      else {
        aim.failed = -Infinity;
        yield aimed;
      }
    }
  }
}

interface DrillStroke {
  cue: Cue;
  /** The fraction of `plays` with the player's errors that made or continued the drill. */
  chance: number;
  plays: number;
}
const SEARCHED = 200;
const CANDIDATES = 60;
const FIRST_PLAYS = 20;
const FINALISTS = 6;
const PLAYS = 200;

/** The stroke that makes a drill most often; undefined where the search finds none that does. */
export function drillStroke(
  carom: Carom,
  table: Table,
  balls: readonly ShotBall[],
  drill: Drill,
  player: Player,
  options: ShotOptions,
): DrillStroke | undefined {
  const isGood = (cue: Cue): boolean =>
    judge(drill, carom.simulate(table, balls, cue, options)).outcome !== "missed";
  const shareOf = (cue: Cue, plays: number, seed: number): number =>
    Array.from({ length: plays }, (_, k) => isGood(carom.withErrors(cue, player, seed, k))).filter(
      Boolean,
    ).length / plays;
  const found: Cue[] = [];
  for (const cue of strokesFor(carom, table, balls, drill, SEARCHED, options)) {
    if (isGood(cue)) found.push(cue);
    if (found.length === CANDIDATES) break;
  }
  // The plays that choose the finalists are not the ones that are reported.
  const finalists = found
    .map((cue) => ({ cue, share: shareOf(cue, FIRST_PLAYS, 1) }))
    .sort((a, b) => b.share - a.share)
    .slice(0, FINALISTS);
  const [best] = finalists
    .map(({ cue }) => ({ cue, share: shareOf(cue, PLAYS, 2) }))
    .sort((a, b) => b.share - a.share);
  if (best === undefined) return undefined;
  return { cue: best.cue, chance: shareOf(best.cue, PLAYS, 3), plays: PLAYS };
}
