// What one sees along the cue before a stroke of a game: where the cue ball first meets something, and which pocket the ball that it meets heads for.
import type { Carom, Cue, EventType, ShotBall, ShotOptions, Table } from "carom";

export interface Look {
  /** Where the cue ball is then, m; the ball that it meets, or -1, and the way of that ball. */
  at: readonly number[];
  ball: number;
  from: readonly number[];
  way: readonly number[];
}

const MEETS: EventType[] = ["ball_ball", "ball_linear_cushion", "ball_circular_cushion", "ball_pocket"];
/** A pocket farther off the way of a ball than this is not meant, degrees. */
const OFF = 25;

export function lookAlong(carom: Carom, table: Table, balls: readonly ShotBall[], cue: Cue, options: ShotOptions): Look | undefined {
  const shot = carom.simulate(table, balls, cue, { ...options, stopAt: MEETS });
  const event = shot.events.find(({ type, a, b }) => MEETS.includes(type) && (a === 0 || (type === "ball_ball" && b === 0)));
  if (!event) return undefined;
  const own = event.a === 0 ? 0 : 1;
  if (event.type !== "ball_ball") return { at: event.before[own]!.r, ball: -1, from: [], way: [] };
  return { at: event.before[own]!.r, ball: own === 0 ? event.b : event.a, from: event.after[1 - own]!.r, way: event.after[1 - own]!.v };
}

/**
 * The ball that is meant, of those that are on, and the pocket that lies most in its way; -1: none. It is the ball that is met, or the only one that is
 * on, whatever is met.
 */
export function guessOf({ pockets }: Table, look: Look | undefined, on: readonly number[]): { ball: number; pocket: number } {
  if (!look || !on.includes(look.ball)) return { ball: on.length === 1 ? on[0]! : -1, pocket: -1 };
  const { from, way } = look;
  let [pocket, most] = [-1, Math.cos((OFF * Math.PI) / 180)];
  pockets.forEach(({ centre }, k) => {
    const [x, y] = [centre[0] - from[0]!, centre[1] - from[1]!];
    const cosine = (x * way[0]! + y * way[1]!) / (Math.hypot(x, y) * Math.hypot(way[0]!, way[1]!) || 1);
    if (cosine > most) [pocket, most] = [k, cosine];
  });
  return { ball: look.ball, pocket };
}
