// A cue ball in hand: where the rules let it lie, and where it lies before it is put.
import type { Carom, ShotBall, Table } from "carom";

/**
 * The D of a snooker table as carom_rack() has it: its line from the cushion, and its radius, m.
 */
const baulkOf = ({ length }: Table): number => (0.737 / 3.569) * length;
const radiusOf = ({ width }: Table): number => (0.292 / 1.778) * width;

/** The line behind which a cue ball in hand lies; undefined: there is none. */
export const lineOf = ({ length }: Table, hand: string): number | undefined =>
  ({ kitchen: length / 4, baulk: length / 5 })[hand];

/**
 * Whether a cue ball in hand may lie at a place: "anywhere", behind the head string ("kitchen") or
 * the baulk line ("baulk"), in the D ("d").
 */
export function mayLie(
  table: Table,
  hand: string,
  [x, y]: readonly [number, number, ...number[]],
): boolean {
  const baulk = baulkOf(table);
  const line = lineOf(table, hand);
  if (line !== undefined) return y <= line + 1e-6;
  return (
    hand !== "d" ||
    (y <= baulk + 1e-6 && Math.hypot(x - table.width / 2, y - baulk) <= radiusOf(table) + 1e-6)
  );
}

/**
 * The layout with the cue ball at the head spot, or the nearest free place of the head string and
 * the lines behind it; in a D, of its line.
 */
export function atHead(
  carom: Carom,
  table: Table,
  balls: readonly ShotBall[],
  hand = "kitchen",
): ShotBall[] {
  const { width, length } = table;
  const [line, half] =
    hand === "d"
      ? [baulkOf(table), radiusOf(table)]
      : [lineOf(table, hand) ?? length / 4, 0.45 * width];
  for (let k = 0; ; k++) {
    const x = (k / 40) % 1;
    const at = [
      width / 2 + half * (x < 0.5 ? 2 * x : 1 - 2 * x),
      line - 1e-3 * Math.floor(k / 40),
    ] as const;
    if (k < 4000 && !mayLie(table, hand, at)) continue;
    try {
      return carom.placeBall(table, balls, 0, ...at);
    } catch (error) {
      if (k >= 4000) throw error;
    }
  }
}
