// The turns of a game: the person at the page or the page's player plays a stroke, the page saves
// the game, and the next player comes to the table.
import type { Call, Choice, Cue, May } from "carom";
import { far } from "../far.js";
import { angleFrom, direction } from "../table/grip.js";
import { wordsOfChoice } from "../table/words.js";
import { parameters, wrong } from "../ui.js";
import { isComputer, Play, type Stroke } from "./game.js";
import { countRack, racksOf } from "./keep.js";
import { countGame, isRated } from "./ladder.js";
import type { Session } from "./parts.js";
import { saveGame } from "./saved.js";
import {
  ballsOn,
  callOf,
  cueOf,
  free,
  isSafety,
  levelOf,
  look,
  mine,
  needsCall,
  NONE,
  playerOf,
  SAFETY,
  says,
  wantedOf,
  why,
} from "./session.js";
import { nameOf, wordsOfScore, wordsOfStroke } from "./state.js";
import { texts } from "../texts/texts.js";

/** How long the stroke of the page's player is shown before it is played, ms. */
const SHOWN = 700;
/** The power after the break, m/s. */
export const SPEED = 2.5;

// ---- Strokes ------------------------------------------------------------------------------------

/** The rating by which a stroke errs: after a hint that of the player, even where none was chosen. */
function ratingOfErrors(s: Pick<Session, "play" | "hinted" | "training">): string {
  const { own } = s.play.setup;
  const isWithoutErrors = s.play.practice && own === "0";
  return s.hinted && !isWithoutErrors ? String(levelOf(s)) : own;
}
/** A stroke as a player of a rating plays it; "0" makes no errors. */
function withErrors({ carom, setup }: Play, cue: Cue, rating: string, strokes: number): Cue {
  if (rating === "0") return cue;
  return carom.withErrors(cue, playerOf(carom, rating), setup.seed, strokes);
}

export function shoot(s: Session): void {
  if (!free(s)) return says(s, why(s));
  const { coach, play, settings, sound } = s;
  s.searchGeneration++; // a search for a hint ends here
  sound.wake();
  const strokes = play.strokes + play.past.length;
  const cue = withErrors(play, cueOf(s), ratingOfErrors(s), strokes);
  const review = coach.review();
  try {
    look(s); // the aim may have changed since the last frame
    const call = callOf(s);
    const stroke = play.stroke(cue, call);
    says(s, "");
    const isReviewed = settings.coach && play.played && play.setup.drill === undefined;
    if (isReviewed) void review(cue, call);
    follow(s, stroke);
  } catch (error) {
    says(s, wrong(error));
  }
}
/** Takes a choice of the rules instead of a stroke, such as to pass. */
export function choose(s: Session, what: May): void {
  if (!free(s)) return says(s, why(s));
  s.searchGeneration++; // a search for a hint ends here
  try {
    follow(s, s.play.choose(what));
  } catch (error) {
    says(s, wrong(error));
  }
}
/** Chooses a safety or a push-out, or takes the choice back. */
export function push(s: Session): void {
  if (!free(s)) return says(s, why(s));
  if (needsCall(s.play)) {
    // A safety holds as long as the aim meets the same ball.
    const safety = { ball: -1, pocket: SAFETY, met: s.first?.ball ?? -1 };
    s.chosen = isSafety(s) ? NONE : safety;
  } else if (s.play.breaks) says(s, texts.aBreakCallsNothing);
  else s.special = s.special === "push" ? undefined : "push";
  s.showing.rest();
}
/** Whether a stroke was the first of a rack. */
function wasBreak({ setup, strokes }: Play, stroke: Stroke): boolean {
  const isFirst = setup.at === undefined && strokes === 1;
  return stroke.state.opening === true || isFirst;
}
/** Shows the film of a stroke that was played, then gives the turn to the next player. */
function follow(s: Session, stroke: Stroke): void {
  // Nobody breaks twice: the next stroke begins as one of medium speed.
  if (wasBreak(s.play, stroke) && !s.play.breaks) s.stroke.set({ speed: SPEED });
  s.chosen = NONE;
  s.theirs = undefined;
  s.special = undefined;
  s.hinted = false;
  keep(s);
  s.showing.perform(stroke, () => next(s));
}
export function undo(s: Session): void {
  if (!s.play.practice) return;
  if (!s.play.undo()) return says(s, texts.thereIsNothingTo);
  save(s);
  s.showing.rest();
}
/**
 * Whoever comes to the table finds the tip in the middle of the cue ball, and the aim at the
 * nearest ball that is on.
 */
function address({ play, stroke }: Pick<Session, "play" | "stroke">): void {
  const cueBall = play.balls[play.cueBall]!;
  const placeOfBall = (ball: number): [number, number] => {
    const [x, y] = play.balls[ball]!.state.r;
    return [x, y];
  };
  const distance = (ball: number): number => {
    const [x, y] = placeOfBall(ball);
    return Math.hypot(x - cueBall.state.r[0], y - cueBall.state.r[1]);
  };
  const [nearest] = ballsOn(play).sort((a, b) => distance(a) - distance(b));
  stroke.set({ right: 0, up: 0, theta: 0 });
  if (nearest !== undefined)
    stroke.set({ phi: direction(angleFrom(cueBall, placeOfBall(nearest))) });
}
/** Judges a try of a drill, and lays the balls for the next one. */
function judgeDrill({ play, training, words, carom }: Session): void {
  const { drill, at } = play.setup;
  if (drill === undefined || !play.last) return;
  const { text, again } = training.played(drill, play.last);
  says({ words }, text);
  // The next try begins where this one began.
  if (again) play.lay(new Play(carom, { ...play.setup, at }).balls);
}
/** Whoever is at the table now plays. */
export function next(s: Session): void {
  const { play } = s;
  const isAgainstComputer = isComputer(play.setup.against);
  judgeDrill(s);
  if (s.link.waiting()) return s.link.onward();
  const isTheirs = play.last !== undefined && play.last.who !== s.seat;
  if (isTheirs && play.hasPockets && isAgainstComputer)
    says(s, wordsOfStroke(play, play.last!, s.seat));
  if (play.winner !== undefined && isRated(play.setup)) says(s, s.training.rating().words);
  if (play.winner === undefined && !mine(s) && isAgainstComputer) void reply(s);
  else {
    if (!play.practice && !play.breaks && mine(s)) address(s);
    s.showing.rest();
  }
  // After a stroke its review is read, until the aim changes.
  if (s.settings.coach && !play.last) void s.coach.chances();
}

// ---- The page's player --------------------------------------------------------------------------

/** The stroke that the page's player chooses, by a plan in a worker. */
async function choiceOf(play: Play): Promise<Choice> {
  const { against, own, seed } = play.setup;
  const options = {
    ...wantedOf(play),
    player: playerOf(play.carom, against),
    opponent: playerOf(play.carom, own === "0" ? "700" : own),
    seed: seed + play.strokes,
    best: 1,
  };
  const [choice] = await far("plan", play.table, play.balls, options);
  return choice!;
}
/** What a choice calls. */
function callOfChoice({ kind, ball, pocket }: Choice): Call | undefined {
  if (kind === "push") return kind;
  return ball > 0 && pocket >= 0 ? { ball, pocket } : undefined;
}
/** Shows a choice of the page's player for a moment: the cue ball, the stick, and words. */
async function announce(s: Session, choice: Choice): Promise<void> {
  const { play, seat, film } = s;
  if (play.bounds) play.put(play.cueBall, ...(choice.place as [number, number]));
  s.theirs = choice.cue;
  s.showing.rest();
  const stroke = wordsOfChoice(play.table, play.names, choice, s.first?.ball === -1);
  says(s, texts.playsStroke(nameOf(play, play.turn, seat), stroke));
  const isInstant = film.pace.value === "1000";
  await new Promise((later) => window.setTimeout(later, isInstant ? 0 : SHOWN));
}
/** The page's player: he plans, puts the cue ball, and errs. */
async function reply(s: Session): Promise<void> {
  const { play } = s;
  const generation = ++s.searchGeneration;
  const isOver = (): boolean => generation !== s.searchGeneration;
  s.thinks = true;
  s.showing.rest();
  try {
    const choice = await choiceOf(play);
    if (isOver()) return;
    await announce(s, choice);
    if (isOver()) return;
    s.thinks = false;
    if (choice.kind === "pass") return follow(s, play.choose("pass"));
    const { against } = play.setup;
    const cue = withErrors(play, choice.cue, against, play.strokes);
    follow(s, play.stroke(cue, callOfChoice(choice)));
  } catch (error) {
    if (isOver()) return;
    s.thinks = false;
    says(s, wrong(error));
  }
}

// ---- What is kept of a game ---------------------------------------------------------------------

/**
 * Whether a game is worth a line in the list of games: somebody has played or laid balls. Drills
 * have counts of their own.
 */
export function isWorthKeeping({ setup, practice, strokes, past }: Play): boolean {
  if (setup.drill !== undefined) return false;
  return practice ? past.length > 0 || setup.at !== undefined : strokes > 0;
}
/** Saves the game in this browser; one by link also in the address and on other pages. */
export function save({ play, link, seat, id, words }: Saved): void {
  const { setup, strokes } = play;
  const game = {
    id,
    text: play.text(),
    setup,
    score: wordsOfScore(play, seat, racksOf(setup)),
    strokes,
    isOver: play.winner !== undefined,
    when: Date.now(),
  };
  saveGame(game).catch((error: unknown) => says({ words }, texts.thisBrowserDoesNot(wrong(error))));
  if (setup.against === "link") return link.save();
  if (location.hash !== "#view=play" && !parameters().has("d"))
    history.replaceState(null, "", "#view=play");
}
type Saved = Pick<Session, "play" | "link" | "seat" | "id" | "words">;
/** Saves the game after a stroke, and counts who has won it. */
export function keep(s: Saved): void {
  const { winner, setup } = s.play;
  if (winner !== undefined) {
    countRack(setup, winner);
    countGame(setup, winner);
  }
  save(s);
}
