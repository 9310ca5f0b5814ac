// One's own rating on the scale of Fargo ratings, 300 to 800, by what was won and lost. Of two ratings r and d, the odds that r wins a game are
//     2^((r - d) / 100) : 1.
// A drill is a game against the rating whose errors make it, by the best stroke that a search found, in half of the tries: a convention. Before the first game
// ratings are normal around 400 with a spread of 150, and cut off at the ends of the scale. The estimate is the mean of what is likely then, and its
// interval leaves out 2.5 % on each side.
import type { Drill } from "./drills.js";
import type { Setup } from "./game.js";
import { count, tally } from "./keep.js";

/** Where the browser keeps games won and lost against each rating, and how often each drill was made, of how many tries. */
const GAMES = "carom-ladder";
export const DRILLS_MADE = "carom-drills";

export interface Result {
  against: number;
  won: number;
  lost: number;
}
export interface Rating {
  rating: number;
  low: number;
  high: number;
}

export function ratingOf(results: readonly Result[]): Rating {
  const scale = Array.from({ length: 101 }, (_, k) => 300 + 5 * k);
  const loses = (difference: number): number => Math.log1p(2 ** (difference / 100));
  const logs = scale.map((r) => results.reduce((sum, { against, won, lost }) => sum - won * loses(against - r) - lost * loses(r - against), -0.5 * ((r - 400) / 150) ** 2));
  const most = Math.max(...logs);
  const likely = logs.map((x) => Math.exp(x - most));
  const all = likely.reduce((sum, x) => sum + x, 0);
  let [mean, below, low, high] = [0, 0, 300, 800];
  scale.forEach((r, k) => {
    mean += (r * likely[k]!) / all;
    if (below < 0.025 * all) low = r;
    below += likely[k]!;
    if (below <= 0.975 * all) high = Math.min(r + 5, 800);
  });
  return { rating: Math.round(mean), low, high };
}

/** Whether a game counts: against the page's player, with errors of one's own. */
export const isRated = ({ against, own }: Setup): boolean => /^\d/.test(against) && own !== "0";
export const countGame = (setup: Setup, winner: 0 | 1): unknown => isRated(setup) && count(GAMES, setup.against, winner === 0 ? [1, 0] : [0, 1]);

/** What is kept in this browser: games, and tries of drills. */
function results(drills: readonly Drill[]): { games: Result[]; tries: Result[] } {
  const [games, made] = [tally(GAMES), tally(DRILLS_MADE)];
  return {
    games: Object.entries(games).map(([against, [won, lost]]) => ({ against: Number(against), won, lost })),
    tries: drills.flatMap(({ name, rating }) => (made[name] ? { against: rating, won: made[name][0], lost: made[name][1] - made[name][0] } : [])),
  };
}
export function ownRating(drills: readonly Drill[]): Rating & { words: string } {
  const { games, tries } = results(drills);
  const own = ratingOf([...games, ...tries]);
  const [won, made, lost, missed] = [games.map((one) => one.won), tries.map((one) => one.won), games.map((one) => one.lost), tries.map((one) => one.lost)].map((all) => all.reduce((sum, x) => sum + x, 0)) as [number, number, number, number];
  const from = [...games.map((one) => `${one.won} : ${one.lost} against a ${one.against}`), ...(made + missed > 0 ? [`${made} of ${made + missed} tries of drills`] : [])];
  return { ...own, words: `Your rating is about ${own.rating} (95 %: ${own.low} to ${own.high}), ${won + lost + made + missed === 0 ? "a guess before the first game" : `by ${from.join(", ")}`}.` };
}
