// A cue ball in hand: where it may be placed, and where it is before the player places it.
import type { BallState, Bounds, Carom, ShotBall, Table } from "carom";
import { onTable } from "./filmed.js";

/** Whether a ball is where a cue ball in hand may be placed. */
export function isWithin({ low, high, centre, radius }: Bounds, ball: BallState): boolean {
  const [x, y] = ball.r;
  const isInside = x >= low[0] && x <= high[0] && y >= low[1] && y <= high[1];
  const isInD = radius === 0 || Math.hypot(x - centre[0], y - centre[1]) <= radius;
  return onTable(ball) && isInside && isInD;
}

/**
 * The layout with a cue ball at the head spot, or the nearest free place of the head string and the
 * lines behind it; where there are bounds, of the line that bounds it.
 */
export function atHead(
  carom: Carom,
  table: Table,
  balls: readonly ShotBall[],
  bounds?: Bounds,
  ball = 0,
): ShotBall[] {
  const { width, length } = table;
  const line = Math.min(bounds?.high[1] ?? length, bounds?.radius ? length : length / 4);
  const half = bounds?.radius || 0.45 * width;
  for (let k = 0; ; k++) {
    const x = (k / 40) % 1;
    const place = [
      width / 2 + half * (x < 0.5 ? 2 * x : 1 - 2 * x),
      line - 1e-3 * Math.floor(k / 40),
    ] as const;
    try {
      const laid = carom.placeBall(table, balls, ball, ...place);
      if (k >= 4000 || !bounds || isWithin(bounds, laid[ball]!.state)) return laid;
    } catch (error) {
      if (k >= 4000) throw error;
    }
  }
}
