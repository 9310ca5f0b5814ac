// A game at the page: what its states share, and the stroke that is aimed in it. A stroke is aimed
// by whoever sits here, the page's player thinks of one, a stroke is filmed, the other one is
// waited for, or the game is over.
import type { Call, Carom, Cue, PlanOptions, Player } from "carom";
import type { player as filmPlayer } from "../../../player/player.js";
import { type filmOf, onTable, type Quaternion } from "../table/filmed.js";
import { GAMES } from "../table/games.js";
import { cueWith, strokeOf } from "../table/stroke.js";
import type { controls } from "./controls.js";
import { OPTIONS, type Play, type Stroke } from "./game.js";
import type { byLink } from "./link.js";
import { guessOf, type Look, lookAlong } from "./look.js";
import type { Lines, Settings } from "./menu.js";
import type { practice } from "./practice.js";
import type { Sound } from "./sound.js";
import type { Space } from "./space.js";

/**
 * What was chosen to be called, -1: nothing, pocket -2: a safety, and the ball that the aim met
 * then: the choice does not hold where the aim meets another one. That of a hint,
 * which has a direction, holds near it only.
 */
export interface Chosen {
  ball: number;
  pocket: number;
  met: number;
  phi?: number;
}
export const NONE: Chosen = { ball: -1, pocket: -1, met: -1 };
export const SAFETY = -2;

export interface Session {
  readonly carom: Carom;
  readonly coarse: boolean;
  readonly settings: Settings;
  readonly sound: Sound;
  readonly words: Record<"turn" | "score" | "said", HTMLElement>;
  readonly buttons: Record<
    "menu" | "hint" | "replay" | "undo" | "rack" | "push" | "pass" | "skip" | "link" | "space",
    HTMLButtonElement
  >;
  readonly stroke: ReturnType<typeof controls>;
  readonly film: ReturnType<typeof filmPlayer>;
  readonly space: Space;
  readonly link: ReturnType<typeof byLink>;
  readonly training: ReturnType<typeof practice>;
  /** The aim, the layout or a setting has changed. */
  changed(): void;
  play: Play;
  /** Which of both sits here; of two at this page, whoever is at the table. */
  seat: 0 | 1;
  chosen: Chosen;
  special: "push" | "pass" | undefined;
  /** Whether a hint was asked for at this stroke. */
  hinted: boolean;
  /** What the aim meets first. */
  first: Look | undefined;
  turned: Quaternion[];
  turnedBefore: Quaternion[];
  thinks: boolean;
  /** The stroke of the page's player that is shown before it plays. */
  theirs: Cue | undefined;
  /** What follows the film that is shown. */
  then: (() => void) | undefined;
  shown: Stroke | undefined;
  /** What the player of films shows. */
  filmed: ReturnType<typeof filmOf> | undefined;
  sounded: number;
  /** Raised by what ends a search: another game, a stroke. */
  number: number;
  /** Raised by what ends the search of the coach for chances. */
  asking: number;
}

export const mine = ({ play, seat }: Session): boolean =>
  play.winner === undefined &&
  (play.practice || play.setup.against === "person" || play.turn === seat);
export function stateOf(s: Session): "aiming" | "thinking" | "film" | "waiting" | "over" {
  if (s.film.playing || s.then !== undefined) return "film";
  if (s.thinks) return "thinking";
  return mine(s) ? "aiming" : s.play.winner === undefined ? "waiting" : "over";
}
/** Whether whoever is at this page may aim now. */
export const free = (s: Session): boolean => stateOf(s) === "aiming";
export const says = (s: Session, text: string): void => void (s.words.said.textContent = text);

/** The stroke that the controls set. */
export const cueOf = ({ carom, play, stroke }: Session): Cue =>
  cueWith(carom.cue({}, GAMES[play.played?.of ?? play.setup.game]!.game), stroke.value());
export const aimAt = ({ stroke }: Session, of: Cue): void => stroke.set(strokeOf(of));
/** The stroke that is shown: of whoever may aim, or of the page's player before it plays. */
export const aimed = (s: Session): Cue | undefined => (free(s) ? cueOf(s) : s.theirs);

/** Whether a stroke needs a call. */
export const calls = ({ play }: Session): boolean =>
  play.played?.calls === true && !play.breaks && !play.practice;
export const ballsOn = ({ carom, play }: Session): number[] =>
  carom.ballsOn(play.state, play.balls);
/** What was chosen, as far as it holds for the aim. */
export function valid({ first, chosen, stroke }: Session): Chosen {
  const met = first?.ball ?? -1;
  const off =
    chosen.phi === undefined ? 0 : Math.abs(((stroke.value().phi - chosen.phi + 540) % 360) - 180);
  return off < 2 && (met === -1 || met === chosen.met) ? chosen : NONE;
}
/** Whether a safety is called: what falls keeps no turn. */
export const isSafety = (s: Session): boolean => calls(s) && valid(s).pocket === SAFETY;
/**
 * The ball and the pocket that are called. Of banks nothing is guessed, as no ball counts on its
 * way.
 */
export function called(s: Session): { ball: number; pocket: number } | undefined {
  const of = guessOf(s.play.table, s.first, ballsOn(s));
  const given = valid(s);
  const guess = s.play.setup.game === "bank" ? { ...of, pocket: -1 } : of;
  if (given.pocket === SAFETY) return undefined;
  const ball = given.ball > 0 ? given.ball : guess.ball;
  const pocket = given.pocket >= 0 ? given.pocket : ball === guess.ball ? guess.pocket : -1;
  return ball > 0 && pocket >= 0 && onTable(s.play.balls[ball]!.state)
    ? { ball, pocket }
    : undefined;
}
export const callOf = (s: Session): Call | undefined =>
  s.special ?? (calls(s) ? called(s) : undefined);
/** What the stroke that is shown meets first. */
export function look(s: Session): void {
  const of = aimed(s);
  s.first =
    of && onTable(s.play.balls[0]!.state)
      ? lookAlong(
          s.carom,
          s.play.table,
          s.play.balls,
          of,
          OPTIONS,
          !s.play.breaks && !s.play.setup.drill && linesOf(s) === "full",
        )
      : undefined;
}

/** The rating of whoever sits here: his own one, or that of his errors where they are larger. */
export const levelOf = ({
  play: {
    setup: { own },
  },
  training,
}: Session): number => Math.min(training.rating().rating, own === "0" ? 800 : Number(own));
/** What lines show of the balls: by a setting, or by the rating. */
export function linesOf(s: Session): Lines {
  const { lines } = s.settings;
  const level = lines === "level" ? s.training.rating().rating : 0;
  return lines !== "level" ? lines : level < 500 ? "full" : level < 650 ? "short" : "none";
}
/** Why nothing can be played now. */
export function why({ play, ...s }: Session): string {
  if (s.thinks) return "The other player thinks: your turn comes after his stroke.";
  if (play.winner !== undefined) return "This game is over: begin another one.";
  if (play.setup.against !== "link") return "Not now: a stroke is on its way.";
  return `The other player is at the table: ${play.last?.who === s.seat ? "send the link, and open the one that comes back" : "open the link that comes after his turn"}.`;
}

export const playerOf = ({ carom }: Session, rating: string): Player =>
  carom.player(rating === "0" ? { errors: 0 } : { fargo: Number(rating) });
/** Where the cue ball may be put, for a plan. */
export const placeOf = ({ play }: Session): PlanOptions["inHand"] =>
  play.hand === "kitchen"
    ? [
        [0, 0],
        [play.table.width, play.table.length / 4],
      ]
    : play.hand !== "no";
