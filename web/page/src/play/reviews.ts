// What the player misses: reviews of strokes, summed by kind of stroke in this browser.
import type { Review, ShotBall } from "carom";
import { placesText } from "../table/places.js";
import { type Setup, tableOf } from "./game.js";
import { keepText, keptValue } from "./keep.js";

const KEY = "carom-reviews";

/** Sums over the strokes of a kind; chances and costs are fractions of a game. */
export interface Reviewed {
  strokes: number;
  successes: number;
  /** Chances of the meant strokes to keep the turn; 0 where no pot was meant. */
  expected: number;
  missCost: number;
  placeCost: number;
  /** The stroke that cost most, as a layout to practise. */
  worst: { cost: number; setup: Setup };
}

/** The kinds of strokes, those first that cost most. */
export function reviewed(): [string, Reviewed][] {
  const rows = Object.entries(keptValue<Record<string, Reviewed>>(KEY, {}));
  const costOf = ({ missCost, placeCost }: Reviewed): number => missCost + placeCost;
  return rows.sort(([, a], [, b]) => costOf(b) - costOf(a));
}

export function countReview(review: Review, setup: Setup, balls: readonly ShotBall[]): void {
  const { group, missCost, placeCost, value, came } = review;
  const rows = keptValue<Record<string, Reviewed>>(KEY, {});
  const sums = rows[group];
  const cost = value - came;
  const layout = {
    game: setup.game,
    ...tableOf(setup),
    against: "practice",
    own: "0",
    seed: 1,
    at: placesText(balls, (x) => Number(x.toFixed(5))),
  } as const;
  rows[group] = {
    strokes: (sums?.strokes ?? 0) + 1,
    successes: (sums?.successes ?? 0) + Number(review.kept),
    expected: (sums?.expected ?? 0) + (review.told || 0),
    missCost: (sums?.missCost ?? 0) + missCost,
    placeCost: (sums?.placeCost ?? 0) + placeCost,
    worst: sums && sums.worst.cost >= cost ? sums.worst : { cost, setup: layout },
  };
  keepText(JSON.stringify(rows), KEY);
}
