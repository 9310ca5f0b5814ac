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
interface Level {
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
/** How far one has climbed. */
export const wordsOfRung = ({ rating, won, needed }: Level): string =>
  needed === 0 ? texts.levelClimbed(rating, won) : texts.levelWon(rating, won);
/** The stars of a drill: for one try that made it, for half of six, and for four fifths of ten. */
export function starsOf(hits: number, tries: number): number {
  const share = hits / Math.max(tries, 1);
  const earned = [hits >= 1, hits >= 3 && share >= 0.5, hits >= 8 && share >= 0.8];
  return earned.filter(Boolean).length;
}

/** What is kept in this browser: games, and tries of drills. */
function results(drills: readonly Drill[]): { games: Score[]; tries: Score[] } {
  const games = tally(GAMES);
  const hits = tally(DRILLS_MADE);
  return {
    games: Object.entries(games).map(([against, [won, lost]]) => ({
      against: Number(against),
      won,
      lost,
    })),
    tries: drills.flatMap(({ name, rating }) =>
      hits[name]
        ? { against: rating, won: hits[name][0], lost: hits[name][1] - hits[name][0] }
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
  const estimate = carom.rating([...games, ...tries]);
  const rating = Math.round(estimate.mean);
  const low = Math.round(estimate.low);
  const high = Math.round(estimate.high);
  const hits = tries.reduce((sum, { won }) => sum + won, 0);
  const missed = tries.reduce((sum, { lost }) => sum + lost, 0);
  const isGuess = [...games, ...tries].every(({ won, lost }) => won + lost === 0);
  const sources = [
    ...games.map((game) => texts.wonAgainst(game.won, game.lost, game.against)),
    ...(hits + missed > 0 ? [texts.ofTriesOfDrills(hits, hits + missed)] : []),
  ];
  const words = isGuess
    ? texts.youAreUnratedUntil(rating)
    : texts.yourRatingIsAbout(rating, low, high, sources.join(", "));
  return { rating, isGuess, words };
}
