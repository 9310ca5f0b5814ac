// The view along the cue before a stroke of a game: where the cue ball first hits something, and
// for which pocket the ball that it hits is heading.
import type { Carom, Cue, EventType, Shot, ShotBall, ShotOptions, Table } from "carom";

export interface Look {
  /** Where the cue ball is then, m; the ball that it meets, or -1, and the way of that ball. */
  place: readonly number[];
  ball: number;
  start: readonly number[];
  way: readonly number[];
  /**
   * The share of its diameter that is met, and on which side as whoever aims sees it, 1: the right
   * one.
   */
  share: number;
  side: number;
  /**
   * Where the ball that is met and the cue ball go until each meets something, where that was asked
   * for.
   */
  ways: (readonly number[])[][];
}

const MEETS: EventType[] = [
  "ball_ball",
  "ball_linear_cushion",
  "ball_circular_cushion",
  "ball_pocket",
];
/** A pocket farther off the way of a ball than this is not meant, degrees. */
const OFF = 25;

/** The way of a ball after an event, to the next thing that it meets, m. */
function wayOf(shot: Shot, ball: number, start: number): (readonly number[])[] {
  const end =
    shot.events.find(
      ({ time, type, a, b }) =>
        time > start &&
        MEETS.includes(type) &&
        (a === ball || (type === "ball_ball" && b === ball)),
    )?.time ?? shot.time;
  const coordinates = shot.positionsAt(
    Array.from({ length: 13 }, (_, k) => start + ((end - start) * k) / 12),
  );
  return Array.from({ length: 13 }, (_, k) => [
    ...coordinates.subarray(3 * (k * shot.balls.length + ball)).subarray(0, 2),
  ]);
}

export function lookAlong(
  carom: Carom,
  table: Table,
  balls: readonly ShotBall[],
  cue: Cue,
  options: ShotOptions,
  full: boolean,
): Look | undefined {
  const shot = carom.simulate(table, balls, cue, full ? options : { ...options, stopAt: MEETS });
  const cueBall = cue.ball;
  const event = shot.events.find(
    ({ type, a, b }) =>
      MEETS.includes(type) && (a === cueBall || (type === "ball_ball" && b === cueBall)),
  );
  if (!event) return undefined;
  const side = event.a === cueBall ? 0 : 1;
  const { r: place, v } = event.before[side]!;
  if (event.type !== "ball_ball")
    return { place, ball: -1, start: [], way: [], share: 0, side: 1, ways: [] };
  const ball = side === 0 ? event.b : event.a;
  const { r: start, v: way } = event.after[1 - side]!;
  // How far the ball is to the left of the aim, in distances between the centres.
  const left =
    (v[0] * (start[1] - place[1]) - v[1] * (start[0] - place[0])) /
    (Math.hypot(v[0], v[1]) * Math.hypot(start[0] - place[0], start[1] - place[1]) || 1);
  return {
    place,
    ball,
    start,
    way,
    share: 1 - Math.abs(left),
    side: Math.sign(left) || 1,
    ways: full ? [ball, cueBall].map((mover) => wayOf(shot, mover, event.time)) : [],
  };
}

/**
 * The ball that is meant, of those that are on, and the pocket that lies most in its way; -1: none.
 * It is the ball that is met, or the only one that is
 * on, whatever is met.
 */
export function guessOf(
  { pockets }: Table,
  look: Look | undefined,
  targets: readonly number[],
): { ball: number; pocket: number } {
  if (!look || !targets.includes(look.ball))
    return { ball: targets.length === 1 ? targets[0]! : -1, pocket: -1 };
  const { start, way } = look;
  let pocket = -1;
  let most = Math.cos((OFF * Math.PI) / 180);
  pockets.forEach(({ centre }, k) => {
    const x = centre[0] - start[0]!;
    const y = centre[1] - start[1]!;
    const cosine =
      (x * way[0]! + y * way[1]!) / (Math.hypot(x, y) * Math.hypot(way[0]!, way[1]!) || 1);
    if (cosine > most) [pocket, most] = [k, cosine];
  });
  return { ball: look.ball, pocket };
}
