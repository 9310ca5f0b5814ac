// The first stroke that the page sets for a new game: one that the referee finds no foul in. Shoot
// alone is then a legal break in every game, also with the errors of a newcomer.
import type { Carom, Cue } from "carom";
import { Play } from "./game.js";

/** The speeds that are tried, as parts of the usual one. */
const SPEEDS = [1, 0.75, 1.3, 0.5, 2];
/** The turns of the aim that are tried, degrees. */
const TURNS = [0, 0.4, -0.4, 1.2, -1.2, 2.4, -2.4];
/** The fastest cue of a first stroke, m/s. */
const FASTEST = 9;
/** Whose errors the stroke has to bear, as a Fargo rating, and in how many tries. */
const NEWCOMER = 400;
const TRIES = 2;

/** The direction to the nearest ball that is on, degrees; undefined where no ball is on. */
function directionToNearest({ carom, state, balls, cueBall }: Play): number | undefined {
  const [x, y] = balls[cueBall]!.state.r;
  const ways = carom
    .ballsOn(state, balls)
    .filter((ball) => ball !== cueBall)
    .map((ball) => balls[ball]!.state.r)
    .map((r) => [r[0] - x, r[1] - y] as const)
    .sort((a, b) => Math.hypot(...a) - Math.hypot(...b));
  const [nearest] = ways;
  return nearest && (Math.atan2(nearest[1], nearest[0]) * 180) / Math.PI;
}
/** The strokes that are tried: the usual one first, then those near it, then at the nearest ball. */
function* candidates(play: Play, usual: Cue): Generator<Cue> {
  yield usual;
  const nearest = directionToNearest(play);
  const directions = nearest === undefined ? [usual.phi] : [usual.phi, (nearest + 360) % 360];
  for (const phi of directions)
    for (const turn of TURNS)
      for (const part of SPEEDS)
        yield { ...usual, phi: phi + turn, speed: Math.min(part * usual.speed, FASTEST) };
}
/** Whether the referee finds no foul in a first stroke of this game. */
function isLegal(carom: Carom, { setup }: Play, cue: Cue): boolean {
  return new Play(carom, setup).stroke(cue).ruling?.foul === false;
}

/**
 * The first legal stroke of a new game, searched from the usual one; the usual one where none is
 * found. It yields after each stroke that was tried, so that a page can stop or wait there.
 */
export function* firstStroke(play: Play, usual: Cue): Generator<undefined, Cue> {
  const { carom } = play;
  const player = carom.player({ fargo: NEWCOMER });
  for (const cue of candidates(play, usual)) {
    let isFair = isLegal(carom, play, cue);
    yield;
    for (let k = 1; k <= TRIES && isFair; k++) {
      isFair = isLegal(carom, play, carom.withErrors(cue, player, play.setup.seed, k));
      yield;
    }
    if (isFair) return cue;
  }
  return usual;
}
