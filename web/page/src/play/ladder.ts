// The player's rating on the Fargo scale, from games won and lost, as carom_rating_of() estimates
// it. A drill counts as a game against the rating that makes it in half of the tries with the best
// stroke that a search found; this is a convention.
import type { Carom, Score } from "carom";
import type { Drill } from "./drills.js";
import { isComputer } from "./game.js";
import { count, tally } from "./keep.js";
import type { SavedGame } from "./saved.js";
import { RATINGS } from "../table/words.js";
import { texts } from "../texts/texts.js";

/**
 * Where the browser keeps games won and lost, by game and rating ("snooker/500"; an older page left
 * out the game), and how often each drill was made, of how many tries.
 */
const GAMES = "carom-ladder";
export const DRILLS_MADE = "carom-drills";

type Counted = Pick<SavedGame, "setup" | "aims">;
/** Whether whoever sits here aimed each own stroke so far. */
export const isOwn = ({ aims = [] }: Pick<Counted, "aims">): boolean =>
  aims.every((aimer) => aimer === "player" || aimer === "opponent");
/** Whether a game is of the kind that counts: against one player of the page, with own errors. */
export const mayCount = ({ against, own, seats = 2 }: Counted["setup"]): boolean =>
  isComputer(against) && own !== "0" && seats === 2;
/** Whether a game counts: it may, and no hint aimed a stroke. */
export const isRated = (played: Counted): boolean => mayCount(played.setup) && isOwn(played);
export function countGame(played: Counted, winner: number): void {
  const { game, against } = played.setup;
  if (isRated(played)) count(GAMES, `${game}/${against}`, winner === 0 ? [1, 0] : [0, 1]);
}
/** Games won and lost against each rating: of one game and of older pages, or of all games. */
function gamesOf(game?: string): Record<string, [number, number]> {
  const sums: Record<string, [number, number]> = {};
  for (const [key, [won, lost]] of Object.entries(tally(GAMES))) {
    const [against = "", kind] = key.split("/").reverse();
    if (game !== undefined && kind !== undefined && kind !== game) continue;
    const [first, second] = sums[against] ?? [0, 0];
    sums[against] = [first + won, second + lost];
  }
  return sums;
}

/** So many games won against a rating climb its level of the ladder. */
const CLIMBED = 3;
interface Level {
  rating: string;
  won: number;
  lost: number;
  needed: number;
}
/** The levels of the ladder of a game, the lowest first. */
export function levels(game: string): Level[] {
  const games = gamesOf(game);
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

/** What is kept in this browser: games, all of them where none is of this game; and drills. */
function results(drills: readonly Drill[], game?: string): { games: Score[]; tries: Score[] } {
  const known = gamesOf(game);
  const games = Object.keys(known).length > 0 ? known : gamesOf();
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
/** One's own rating on the scale of a game, or by all of them. */
export function ownRating(carom: Carom, drills: readonly Drill[], game?: string): OwnRating {
  const { games, tries } = results(drills, game);
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
