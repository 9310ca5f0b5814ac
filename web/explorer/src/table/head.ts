// A cue ball in hand, before it is put: at the head spot, or near to it.
import type { Carom, ShotBall, Table } from "carom";

/** The layout with the cue ball at the head spot, or the nearest free place of the head string and the lines behind it. */
export function atHead(carom: Carom, table: Table, balls: readonly ShotBall[]): ShotBall[] {
  const { width, length } = table;
  for (let k = 0; ; k++) {
    const x = (k / 40) % 1;
    try {
      return carom.placeBall(table, balls, 0, width * (x < 0.5 ? 0.5 + x * 0.9 : 0.5 - (x - 0.5) * 0.9), length / 4 - 1e-3 * Math.floor(k / 40));
    } catch (error) {
      if (k > 4000) throw error;
    }
  }
}
