// The turns of a game. The person at the page or the page's player plays a stroke. The page saves
// the game and shows the film of the stroke; then the next player is at the table.
import type { Call, PlanStroke, Choice } from "carom";
import { far } from "../far.js";
import { angleFrom, direction } from "../table/grip.js";
import { namesBall, wordsOfPlan } from "../table/words.js";
import { parameters, wrong } from "../ui.js";
import { isComputer, Play, type Stroke } from "./game.js";
import { countRack, racksOf } from "./keep.js";
import { countGame, isOwn, isRated } from "./ladder.js";
import type { Session } from "./parts.js";
import { saveGame } from "./saved.js";
import {
  ballsOn,
  free,
  isSafety,
  mine,
  needsCall,
  NONE,
  playerOf,
  SAFETY,
  says,
  seatPlayer,
  strokeToPlay,
  wantedOf,
  why,
  wordsOfOutcome,
} from "./session.js";
import { nameOf, wordsOfScore, wordsOfStroke } from "./state.js";
import { texts } from "../texts/texts.js";

/** How long the page shows the stroke of its player before it plays the stroke, ms. */
const ANNOUNCED_MS = 700;
/** The speed of the cue that the page sets for the stroke after the break, m/s. */
export const SPEED_AFTER_BREAK = 2.5;
/** The rating that the page's player assumes for a person who plays without errors. */
const RATING_OF_PERFECT = "700";

// ---- Strokes ------------------------------------------------------------------------------------

/** Plays the stroke that the controls set. */
export function shoot(s: Session): void {
  if (!free(s)) return says(s, why(s));
  const { coach, play, settings } = s;
  s.searchGeneration++; // a search for a hint ends here
  s.sound.wake();
  // The review needs the layout before the stroke.
  const review = coach.review();
  try {
    const { cue, call, aimer } = strokeToPlay(s);
    const stroke = play.stroke(cue, call, aimer);
    const isReviewed = play.played !== undefined && play.setup.drill === undefined;
    s.verdict = isReviewed ? wordsOfStroke(play, stroke, s.seat) : "";
    says(s, "");
    if (isReviewed) void review(cue, call, aimer, settings.coach);
    finishTurn(s, stroke);
  } catch (error) {
    says(s, wrong(error));
  }
}
/** Takes a choice that the rules offer instead of a stroke, such as to pass. */
export function choose(s: Session, what: Choice): void {
  if (!free(s)) return says(s, why(s));
  s.searchGeneration++; // a search for a hint ends here
  try {
    const stroke = s.play.choose(what);
    s.verdict = wordsOfStroke(s.play, stroke, s.seat);
    says(s, "");
    finishTurn(s, stroke);
  } catch (error) {
    says(s, wrong(error));
  }
}
/**
 * Calls a safety or a push-out, or takes this call back. Games whose strokes need a call have
 * safeties; the others have push-outs.
 */
export function togglePush(s: Session): void {
  if (!free(s)) return says(s, why(s));
  if (needsCall(s.play)) {
    // A safety holds as long as the aim meets the same ball.
    const safety = { ball: -1, pocket: SAFETY, hitBall: s.first?.ball ?? -1 };
    s.chosen = isSafety(s) ? NONE : safety;
  } else if (s.play.breaks) {
    says(s, texts.aBreakCallsNothing);
  } else {
    s.special = s.special === "push" ? undefined : "push";
  }
  s.showing.rest();
}
/** Whether a stroke that was just played was the first of a rack. */
function wasBreak({ setup, strokes }: Play, stroke: Stroke): boolean {
  const isFirst = setup.at === undefined && strokes === 1;
  return stroke.state.opening === true || isFirst;
}
/** Saves the game after a stroke and shows its film; then the next player is at the table. */
function finishTurn(s: Session, stroke: Stroke): void {
  // The speed of a break does not suit the stroke after it.
  if (wasBreak(s.play, stroke) && !s.play.breaks) s.stroke.set({ speed: SPEED_AFTER_BREAK });
  s.chosen = NONE;
  s.theirs = undefined;
  s.special = undefined;
  s.hint = undefined;
  s.asksPlace = false;
  saveAndCount(s);
  s.showing.perform(stroke, () => next(s));
}
/** Ends the turn of whoever is at the table, because the time for the stroke is over. */
export function runOut(s: Session): void {
  s.searchGeneration++; // a search for a hint ends here
  finishTurn(s, s.play.clock());
}
/** Gives the game to the other player; of two at one page, whoever is at the table gives it. */
export function concede(s: Session): void {
  const { play, seat } = s;
  if (!mayConcede(play)) return says(s, why(s));
  s.showing.skip(); // a film ends here
  s.searchGeneration++; // and so does the thought of the page's player
  s.thinks = false;
  finishTurn(s, play.concede(play.setup.against === "person" ? play.turn : seat));
}
export const mayConcede = (play: Play): boolean => !play.practice && !play.isOver;
/** Takes back the last stroke or move of practice. */
export function undo(s: Session): void {
  if (!s.play.practice) return;
  if (!s.play.undo()) return says(s, texts.thereIsNothingTo);
  save(s);
  s.showing.rest();
}
/** Aims a level cue at the nearest ball that is on, with the tip at the middle of the cue ball. */
export function aimAtNearest({ play, stroke }: Pick<Session, "play" | "stroke">): void {
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
/** Shows the result of a try of a drill, and sets up the balls again if the drill repeats. */
function judgeDrill({ play, training, words, carom }: Session): void {
  const { drill, at } = play.setup;
  if (drill === undefined || !play.last) return;
  const { text, repeats } = training.played(drill, play.last, isOwn(play));
  says({ words }, text);
  // The next try begins where this one began.
  if (repeats) play.lay(new Play(carom, { ...play.setup, at }).balls);
}
/** Begins the turn of the player who is now at the table. */
export function next(s: Session): void {
  const { link, play, training } = s;
  judgeDrill(s);
  if (link.waiting()) return link.onward();
  // The result of the last stroke, and of the game if it ended.
  const { last, setup, isOver } = play;
  const isAgainstComputer = isComputer(setup.against);
  const outcome = wordsOfOutcome(s);
  if (outcome !== "") says(s, outcome);
  if (isOver && isRated(play)) says(s, training.rating(setup.game).words);
  if (isOver) s.end.show();
  // The page's player begins to plan, or the person at the page begins to aim.
  if (!isOver && !mine(s) && isAgainstComputer) {
    void reply(s);
  } else {
    if (!play.practice && !play.breaks && mine(s)) aimAtNearest(s);
    s.showing.rest();
  }
  // The review of a stroke stays until the aim changes, so only the first stroke shows chances here.
  if (s.settings.coach && !last) void s.coach.chances();
}

// ---- The page's player --------------------------------------------------------------------------

/** Plans a stroke for the page's player. A worker computes the plan. */
async function choiceOf(play: Play): Promise<PlanStroke> {
  const { against, own, seed } = play.setup;
  const options = {
    ...wantedOf(play),
    player: seatPlayer(play, against),
    opponent: playerOf(play.carom, own === "0" ? RATING_OF_PERFECT : own),
    seed: seed + play.strokes,
    best: 1,
  };
  const [choice] = await far("plan", play.table, play.balls, options);
  return choice!;
}
/** The call of a planned stroke. */
function callOfChoice({ table }: Play, choice: PlanStroke): Call | undefined {
  const { kind, ball, pocket } = choice;
  if (kind === "push") return kind;
  return pocket >= 0 && namesBall(table, choice) ? { ball, pocket } : undefined;
}
/** Shows for a moment what the page's player will do: the cue ball, the stick, and a message. */
async function announce(s: Session, choice: PlanStroke): Promise<void> {
  const { play, seat, film } = s;
  if (play.bounds) play.put(play.cueBall, ...(choice.place as [number, number]));
  play.strike(choice.cue.ball);
  s.theirs = choice.cue;
  s.showing.rest();
  const stroke = wordsOfPlan(play, choice, s.first?.ball === -1);
  says(s, texts.playsStroke(nameOf(play, play.turn, seat), stroke));
  const isInstant = film.pace.value === "1000"; // the pace "at once"
  await new Promise((later) => window.setTimeout(later, isInstant ? 0 : ANNOUNCED_MS));
}
/** Lets the page's player plan a stroke, announce it, and play it with errors. */
async function reply(s: Session): Promise<void> {
  const { play } = s;
  const generation = ++s.searchGeneration;
  // Opening another game or leaving the view raises the generation.
  const isStale = (): boolean => generation !== s.searchGeneration;
  s.thinks = true;
  s.showing.rest();
  try {
    const choice = await choiceOf(play);
    if (isStale()) return;
    await announce(s, choice);
    if (isStale()) return;
    s.thinks = false;
    if (choice.kind === "pass") return finishTurn(s, play.choose("pass", "opponent"));
    const { against } = play.setup;
    const player = seatPlayer(play, against);
    const cue = play.carom.withErrors(choice.cue, player, play.setup.seed, play.strokes);
    finishTurn(s, play.stroke(cue, callOfChoice(play, choice), "opponent"));
  } catch (error) {
    if (isStale()) return;
    s.thinks = false;
    says(s, wrong(error));
  }
}

// ---- Saving a game ------------------------------------------------------------------------------

type Saved = Pick<Session, "play" | "link" | "seat" | "id" | "words">;

/** Whether a game belongs in the list of games: somebody has played, or laid balls in practice. */
export function isWorthKeeping({ setup, practice, strokes, past }: Play): boolean {
  if (setup.drill !== undefined) return false; // tries of drills are counted in ladder.ts
  return practice ? past.length > 0 || setup.at !== undefined : strokes > 0;
}
/** Saves the game in this browser. A game by link is also saved in the address. */
export function save({ play, link, seat, id, words }: Saved): void {
  const { setup, strokes } = play;
  const game = {
    id,
    text: play.text(),
    setup,
    aims: play.aims,
    score: wordsOfScore(play, seat, racksOf(play)),
    strokes,
    isOver: play.isOver,
    when: Date.now(),
  };
  saveGame(game).catch((error: unknown) => says({ words }, texts.thisBrowserDoesNot(wrong(error))));
  if (setup.against === "link") return link.save();
  // A reload shows this game again, unless the address has a diagram.
  if (location.hash !== "#view=play" && !parameters().has("d"))
    history.replaceState(null, "", "#view=play");
}
/** Saves the game after a stroke. A stroke that won or lost the game also counts in the tallies. */
export function saveAndCount(s: Saved & Pick<Session, "training" | "end">): void {
  const { winner, setup } = s.play;
  if (winner !== undefined) {
    s.end.rated = isRated(s.play) ? s.training.rating(setup.game) : undefined;
    countRack(setup, winner);
    countGame(s.play, winner);
  }
  save(s);
}
