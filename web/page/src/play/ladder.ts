// One's own rating on the scale of Fargo ratings by what was won and lost, as carom_rating_of() has
// it. A drill is a game against the rating whose errors make it, by the best stroke that a search
// found, in half of the tries: a convention.
import type { Carom, Score } from "carom";
import type { Drill } from "./drills.js";
import { isComputer, type Setup } from "./game.js";
import { count, tally } from "./keep.js";
import { RATINGS } from "../table/words.js";
import { texts } from "../texts/texts.js";

/**
 * Where the browser keeps games won and lost against each rating, and how often each drill was
 * made, of how many tries.
 */
const GAMES = "carom-ladder";
export const DRILLS_MADE = "carom-drills";

/** Whether a game counts: against the page's player, with errors of one's own. */
export const isRated = ({ against, own }: Setup): boolean => isComputer(against) && own !== "0";
export const countGame = (setup: Setup, winner: 0 | 1): unknown =>
  isRated(setup) && count(GAMES, setup.against, winner === 0 ? [1, 0] : [0, 1]);

/** So many games won against a rating climb its level of the ladder. */
const CLIMBED = 3;
export interface Level {
  rating: string;
  won: number;
  lost: number;
  needed: number;
}
/** The levels of the ladder, the lowest first. */
export function levels(): Level[] {
  const games = tally(GAMES);
  return RATINGS.map((rating) => {
    const [won, lost] = games[rating] ?? [0, 0];
    return { rating, won, lost, needed: Math.max(CLIMBED - won, 0) };
  });
}
/** The stars of a drill: for one try that made it, for half of six, and for four fifths of ten. */
export function starsOf(made: number, tries: number): number {
  const share = made / Math.max(tries, 1);
  const earned = [made >= 1, made >= 3 && share >= 0.5, made >= 8 && share >= 0.8];
  return earned.filter(Boolean).length;
}

/** What is kept in this browser: games, and tries of drills. */
function results(drills: readonly Drill[]): { games: Score[]; tries: Score[] } {
  const games = tally(GAMES);
  const made = tally(DRILLS_MADE);
  return {
    games: Object.entries(games).map(([against, [won, lost]]) => ({
      against: Number(against),
      won,
      lost,
    })),
    tries: drills.flatMap(({ name, rating }) =>
      made[name]
        ? { against: rating, won: made[name][0], lost: made[name][1] - made[name][0] }
        : [],
    ),
  };
}
export interface OwnRating {
  rating: number;
  /** Whether it is a guess, before the first game and drill. */
  isGuess: boolean;
  words: string;
}
export function ownRating(carom: Carom, drills: readonly Drill[]): OwnRating {
  const { games, tries } = results(drills);
  const own = carom.rating([...games, ...tries]);
  const rating = Math.round(own.mean);
  const low = Math.round(own.low);
  const high = Math.round(own.high);
  const made = tries.reduce((sum, { won }) => sum + won, 0);
  const missed = tries.reduce((sum, { lost }) => sum + lost, 0);
  const isGuess = [...games, ...tries].every(({ won, lost }) => won + lost === 0);
  const from = [
    ...games.map((one) => texts.wonAgainst(one.won, one.lost, one.against)),
    ...(made + missed > 0 ? [texts.ofTriesOfDrills(made, made + missed)] : []),
  ];
  const words = isGuess
    ? texts.youAreUnratedUntil(rating)
    : texts.yourRatingIsAbout(rating, low, high, from.join(", "));
  return { rating, isGuess, words };
}
