// A game at the page: what its states share, and the stroke that is being aimed. In each state the
// person here aims, the page's player thinks, a film runs, the page waits for the other player, or
// the game is over.
import type { Call, Carom, Cue, PlanOptions, Player } from "carom";
import { onTable } from "../table/filmed.js";
import { GAMES } from "../table/games.js";
import { cueWith, strokeOf } from "../table/stroke.js";
import { type Aimer, isComputer, OPTIONS, type Play } from "./game.js";
import { guessOf, lookAlong } from "./look.js";
import type { Chosen, Lines, Progress, Session } from "./parts.js";
import { wordsOfStroke } from "./state.js";
import { texts } from "../texts/texts.js";

export const NONE: Chosen = { ball: -1, pocket: -1, hitBall: -1 };
export const SAFETY = -2;
/** A stroke within so many degrees of a hint's direction counts as the hint's. */
const CORRECTED = 2;
/** The angle between two directions, degrees. */
const angleBetween = (a: number, b: number): number => Math.abs(((a - b + 540) % 360) - 180);

/** How a game is on its way before anything was played. */
export const progressOf = (play: Play): Progress => ({
  play,
  watched: undefined,
  id: "",
  seat: 0,
  chosen: NONE,
  special: undefined,
  verdict: "",
  hint: undefined,
  sketches: [],
  asksPlace: false,
  place: undefined,
  first: undefined,
  turned: [],
  turnedBefore: [],
  thinks: false,
  theirs: undefined,
  continuation: undefined,
  shown: undefined,
  filmed: undefined,
  sounded: 0,
  searchGeneration: 0,
  chancesGeneration: 0,
});

export const mine = ({ play, seat, watched }: Session): boolean =>
  !watched &&
  !play.isOver &&
  (play.practice || play.setup.against === "person" || play.turn === seat);
export function stateOf(s: Session): "aiming" | "thinking" | "film" | "waiting" | "over" {
  if (s.film.playing || s.continuation !== undefined) return "film";
  if (s.thinks) return "thinking";
  if (mine(s)) return "aiming";
  return s.play.isOver ? "over" : "waiting";
}
/** Whether whoever is at this page may aim now. */
export const free = (s: Session): boolean => stateOf(s) === "aiming";
export const says = (s: Pick<Session, "words">, text: string): void =>
  void (s.words.message.textContent = text);

/**
 * What came of the last own stroke, and of the one that the page's player has played since. Who plays
 * by link has the words of the link.
 */
export function wordsOfOutcome({ play, seat, verdict }: Session): string {
  const { last, setup } = play;
  if (!last || last.player === seat || setup.against === "person") return verdict;
  return isComputer(setup.against) ? `${verdict} ${wordsOfStroke(play, last, seat)}`.trim() : "";
}

/** The stroke that the controls set. */
export function cueOf({ carom, play, stroke }: Pick<Session, "carom" | "play" | "stroke">): Cue {
  const { game } = GAMES[play.played?.base ?? play.setup.game]!;
  return cueWith(carom.cue({ ball: play.cueBall }, game), stroke.value());
}
export const aimAt = ({ stroke }: Pick<Session, "stroke">, cue: Cue): void =>
  stroke.set(strokeOf(cue));
/** The stroke that is shown: of whoever may aim, or of the page's player before it plays. */
export const aimed = (s: Session): Cue | undefined => (free(s) ? cueOf(s) : s.theirs);

/** Whether a stroke needs a call. */
export const needsCall = (play: Play): boolean =>
  play.played?.calls === true && !play.breaks && !play.practice;
export const ballsOn = ({ carom, state, balls, cueBall }: Play): number[] =>
  carom.ballsOn(state, balls).filter((ball) => ball !== cueBall);
/** What was chosen, as far as it holds for the aim. */
export function valid({
  first,
  chosen,
  stroke,
}: Pick<Session, "first" | "chosen" | "stroke">): Chosen {
  const hitBall = first?.ball ?? -1;
  const { phi } = stroke.value();
  const turnedBy = angleBetween(phi, chosen.phi ?? phi);
  const meetsTheSame = hitBall === -1 || hitBall === chosen.hitBall;
  return turnedBy < CORRECTED && meetsTheSame ? chosen : NONE;
}
/** Whether a safety is called: what falls keeps no turn. */
export const isSafety = (s: Session): boolean => needsCall(s.play) && valid(s).pocket === SAFETY;
/**
 * The ball and the pocket that are called. Of banks nothing is guessed, as no ball counts on its
 * way.
 */
export function called(s: Session): { ball: number; pocket: number } | undefined {
  const { play } = s;
  const choice = valid(s);
  if (choice.pocket === SAFETY) return undefined;
  const guess = guessOf(play.table, s.first, ballsOn(play));
  const ball = choice.ball > 0 ? choice.ball : guess.ball;
  const isGuessed = ball === guess.ball && play.setup.game !== "bank";
  const guessedPocket = isGuessed ? guess.pocket : -1;
  const pocket = choice.pocket >= 0 ? choice.pocket : guessedPocket;
  const isThere = ball > 0 && onTable(play.balls[ball]!.state);
  return isThere && pocket >= 0 ? { ball, pocket } : undefined;
}
const callOf = (s: Session): Call | undefined =>
  s.special ?? (needsCall(s.play) ? called(s) : undefined);
/** What the stroke that is shown meets first. */
export function look(s: Session): void {
  const { carom, play } = s;
  const cue = aimed(s);
  if (!cue || !onTable(play.balls[play.cueBall]!.state)) {
    s.first = undefined;
    return;
  }
  const showsWays = !play.breaks && !play.setup.drill && linesOf(s) === "full";
  s.first = lookAlong(carom, play.table, play.balls, cue, OPTIONS, showsWays);
}

/** The player whose chances are shown. */
export function wordsOfLevel(s: Pick<Session, "play" | "training">): string {
  const level = levelOf(s);
  return s.training.rating(s.play.setup.game).isGuess
    ? texts.anUnratedPlayer(level)
    : texts.aAsYouAre(level);
}
/** The rating of the person here, or the rating of their errors where that is lower. */
export function levelOf({ play, training }: Pick<Session, "play" | "training">): number {
  const { own, game } = play.setup;
  return Math.min(training.rating(game).rating, own === "0" ? 800 : Number(own));
}
/** What lines show of the balls: by a setting, or by the rating. */
export function linesOf({
  play,
  settings,
  training,
}: Pick<Session, "play" | "settings" | "training">): Lines {
  if (settings.lines !== "level") return settings.lines;
  const { rating } = training.rating(play.setup.game);
  if (rating < 500) return "full";
  return rating < 650 ? "short" : "none";
}
/** Why nothing can be played now. */
export function why(s: Pick<Session, "play" | "seat" | "thinks" | "watched">): string {
  const { play } = s;
  if (s.watched) return texts.closeTheWatch;
  if (s.thinks) return texts.theOtherPlayerThinks;
  if (play.isOver) return texts.thisGameIsOver;
  if (play.setup.against !== "link") return texts.notNowAStroke;
  if (play.last?.player === s.seat) return texts.theOtherPlayerIs;
  return texts.theOtherPlayerIsAt;
}

/** Whether a hint shows a stroke of the ball that is struck. */
export const isHinted = ({ hint, play }: Pick<Session, "hint" | "play">): boolean =>
  hint !== undefined && hint.ball === play.cueBall;
/** Who aimed the stroke that the controls set. A hint that was turned a little is still a hint. */
export function aimerOf(s: Pick<Session, "hint" | "play" | "stroke">): Aimer {
  const isNear = isHinted(s) && angleBetween(s.stroke.value().phi, s.hint!.phi) < CORRECTED;
  return isNear ? "hint" : "player";
}

/** A player of a rating; "0" makes no errors. */
export const playerOf = (carom: Carom, rating: string): Player =>
  carom.player(rating === "0" ? { errors: 0 } : { fargo: Number(rating) });
/** A player of a rating on the scale of the game that is played, as the seats of a match have it. */
export const seatPlayer = ({ carom, state }: Play, rating: string): Player =>
  carom.player({ fargo: Number(rating), rules: state.rules });
/** Whose errors the next stroke has, if any. A stroke of a hint has those that the hint assumed. */
function erringPlayer(s: Session, aimer: Aimer): Player | undefined {
  const { carom, setup, practice } = s.play;
  if (aimer === "hint" && !practice) return seatPlayer(s.play, String(levelOf(s)));
  if (setup.own === "0") return undefined;
  return playerOf(carom, aimer === "hint" ? String(levelOf(s)) : setup.own);
}
/** The stroke of whoever sits here: the cue with its errors, the call, and who aimed it. */
export function strokeToPlay(s: Session): { cue: Cue; call: Call | undefined; aimer: Aimer } {
  const { play } = s;
  const number = play.strokes + play.past.length;
  const aimer = aimerOf(s);
  const player = erringPlayer(s, aimer);
  const cue = player ? play.carom.withErrors(cueOf(s), player, play.setup.seed, number) : cueOf(s);
  look(s); // the aim may have changed since the last frame
  return { cue, call: callOf(s), aimer };
}
/**
 * What a plan knows of a game: how it stands, which ball is struck, and where it may be put. Of
 * several balls of a match the plan chooses the one to strike.
 */
export const wantedOf = ({ state, cueBall, strikable, hand, practice }: Play): PlanOptions => ({
  ...state,
  cue: strikable.length > 1 && !practice ? {} : { ball: cueBall },
  shot: OPTIONS,
  inHand: hand,
});
