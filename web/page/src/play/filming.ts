// What the player sees of a game: the balls at rest with the aimed stroke, the film of a played
// stroke, and the messages that go with both.
import { CaromError } from "carom";
import { product } from "../../../player/words.js";
import { filmOf, lasts, onTable, type Path, pathsOf } from "../table/filmed.js";
import { GAMES } from "../table/games.js";
import { spoken, wordsOfPocket } from "../table/words.js";
import { OPTIONS, type Stroke } from "./game.js";
import { racksOf } from "./keep.js";
import { wordsOfChoice } from "./named.js";
import type { Session, Showing } from "./parts.js";
import {
  aimed,
  called,
  cueOf,
  free,
  isHinted,
  isSafety,
  linesOf,
  look,
  needsCall,
  says,
  stateOf,
  why,
} from "./session.js";
import { nameOf, wordsOfScore, wordsOfTurn } from "./state.js";
import { texts } from "../texts/texts.js";

type Film = NonNullable<Session["filmed"]>;
function show(s: Pick<Session, "filmed" | "film" | "space">, film: Film): void {
  s.filmed = film;
  s.film.show(film);
  s.space.draw();
}
/** The playback time has changed. */
export function moved(s: Session): void {
  const { film, shown, sound, space } = s;
  space.draw();
  if (shown?.shot && film.playing) sound.play(shown.shot, s.sounded, film.time, space.sideOf);
  s.sounded = film.time;
}

/** The paths of the balls in free practice, where everything may be seen. */
function pathsOfPractice(s: Session): Path[] {
  const { carom, play } = s;
  if (!play.practice || play.setup.drill) return [];
  return pathsOf(carom.simulate(play.table, play.balls, cueOf(s), OPTIONS));
}

/**
 * The balls as they lie, with what may be seen of the stroke: in a game the line to the first
 * contact.
 */
function rest(s: Session): void {
  const { table, balls, cueBall, names } = s.play;
  s.first = undefined;
  let paths: Path[] = [];
  if (aimed(s) && onTable(balls[cueBall]!.state))
    try {
      paths = pathsOfPractice(s);
      look(s);
    } catch (error) {
      if (!(error instanceof CaromError)) throw error;
      says(s, texts.thisStrokeCannotBe(error.message));
    }
  s.shown = undefined;
  show(s, filmOf({ table, balls, names, turned: s.turned }, undefined, paths));
  update(s);
}

// ---- Words and buttons --------------------------------------------------------------------------

/** Updates the messages, the controls and the buttons. */
function update(s: Session): void {
  showWords(s);
  showContact(s);
  showButtons(s);
  const { play, film, words } = s;
  const { text } = GAMES[play.played?.base ?? play.setup.game]!;
  film.canvas.setAttribute("aria-label", texts.tableFromAbove(text, words.turn.textContent));
}

/** The player of the stroke in the film; its result is shown after the film. */
function playerOnFilm({ play, seat, shown, continuation }: Session): string | undefined {
  const isFilmed = continuation !== undefined && shown && !play.practice;
  return isFilmed ? nameOf(play, shown.player, seat) : undefined;
}
/** What is called for the stroke that is aimed. */
function wordsOfCall(s: Session): string {
  const { names, table } = s.play;
  if (!free(s) || !needsCall(s.play)) return "";
  const call = called(s);
  if (call) return texts.callThe(spoken(names[call.ball]!), wordsOfPocket(table, call.pocket));
  if (isSafety(s)) return texts.callASafety;
  return texts.nothingIsCalledAim;
}
/** Whose turn it is, the call and the score. */
function showWords(s: Session): void {
  const { play, seat, words } = s;
  const player = playerOnFilm(s);
  const turn = player
    ? texts.playing(player, player === texts.you)
    : wordsOfTurn(play, seat, s.thinks, isHinted(s)) + wordsOfCall(s);
  // A screen reader announces each change, even to an identical text.
  if (words.turn.textContent !== turn) words.turn.textContent = turn;
  if (!player) words.score.textContent = wordsOfScore(play, seat, racksOf(play));
  s.plates.update();
}

/** An overlap from which a picture would show one disc. */
const FULL = 0.97;
/** The overlap of the balls along the aim, where the setting of lines allows it. */
function showContact(s: Session): void {
  const { play, first, stroke } = s;
  // A stroke may hit only a cushion.
  const meetsBall = free(s) && first !== undefined && first.ball >= 0;
  // At a break, and where the balls overlap completely, the picture says nothing.
  const isPlain = play.breaks || (first?.share ?? 0) > FULL;
  if (!meetsBall || isPlain || (!play.practice && linesOf(s) === "none"))
    return stroke.showContact(undefined);
  stroke.showContact(first, spoken(play.names[first.ball]!));
}

/** Shows a button or hides it; one that appears is brought into view. */
function put(element: HTMLElement, isVisible: boolean): void {
  const appears = element.hidden && isVisible;
  element.hidden = !isVisible;
  if (appears) element.scrollIntoView({ block: "nearest", inline: "nearest" });
}
/** Shows the buttons that have a meaning now. */
function showButtons(s: Session): void {
  const { play, buttons, choices, film, stroke } = s;
  const mayAim = free(s);
  const mayPush = play.acts.includes("push");
  const isFreePractice = play.practice && !play.setup.drill;
  const isOver = play.isOver && s.continuation === undefined;
  const hasSafety = play.played?.calls === true && !play.practice;
  const isRolling = film.playing || s.space.isStriking;
  for (const [act, button] of choices) {
    const { text } = wordsOfChoice(play, act);
    if (button.textContent !== text) button.textContent = text;
  }
  const visible: (readonly [HTMLElement, boolean])[] = [
    [buttons.hint, play.played !== undefined],
    [buttons.undo, isFreePractice],
    [buttons.rack, isFreePractice || isOver],
    [buttons.push, (mayAim && mayPush) || (hasSafety && !play.breaks)],
    ...choices.map(([act, button]) => [button, mayAim && play.acts.includes(act)] as const),
    [buttons.skip, isRolling],
    [s.watching.root, s.watched !== undefined],
    [stroke.shoot, !isRolling],
    [buttons.link, play.setup.against === "link" || s.watched !== undefined],
  ];
  for (const [element, isVisible] of visible) put(element, isVisible);
  // The button keeps its place before the first stroke, so that the others keep theirs.
  buttons.replay.style.visibility = play.last?.shot ? "visible" : "hidden";
  enableButtons(s, mayAim, mayPush);
}
/**
 * Marks the buttons without an effect: each keeps its place, so that the others keep theirs, and
 * says why when it is pressed.
 */
function enableButtons(s: Session, mayAim: boolean, mayPush: boolean): void {
  const { play, buttons, stroke } = s;
  const isBusy = ["film", "thinking"].includes(stateOf(s));
  const enabled: [HTMLElement, boolean][] = [
    [stroke.shoot, mayAim],
    [buttons.hint, mayAim],
    [buttons.push, mayAim && (mayPush || needsCall(play))],
    [buttons.replay, play.last?.shot !== undefined && !isBusy],
    [buttons.undo, play.past.length > 0],
  ];
  for (const [element, isEnabled] of enabled)
    element.setAttribute("aria-disabled", String(!isEnabled));

  const isPressed = (mayAim && isSafety(s)) || s.special === "push";
  buttons.push.textContent = mayPush ? texts.pushOut : texts.safety;
  buttons.push.setAttribute("aria-pressed", String(isPressed));
}

// ---- Films --------------------------------------------------------------------------------------

/** Shows a stroke that was played, and then calls `next`. */
function perform(s: Session, stroke: Stroke, next: () => void): void {
  s.end.hide();
  s.turnedBefore = s.turned;
  s.continuation = next;
  s.shown = stroke;
  s.sounded = -1;
  if (!stroke.shot) return finish(s);
  s.film.look(1);
  const { table, names } = s.play;
  show(s, filmOf({ table, balls: stroke.balls, names, turned: s.turned }, stroke.shot, []));
  const { cue, balls } = stroke;
  s.space.strike(cue, balls[cue.ball]!.state.r, () => s.film.start());
  update(s);
}
export function finish(s: Pick<Session, "continuation" | "shown" | "turned">): void {
  const next = s.continuation;
  if (s.shown?.shot) {
    const end = s.shown.shot.orientations(lasts(s.shown.shot));
    s.turned = s.turned.map((q, k) => product(end.subarray(4 * k, 4 * k + 4), q));
  }
  s.continuation = undefined;
  next?.();
}
function skip(s: Session): void {
  if (!s.film.playing && !s.space.isStriking) return;
  s.space.putAway();
  s.film.stop();
  finish(s);
}
function replay(s: Session): void {
  const { last } = s.play;
  if (!last?.shot) return says(s, texts.thereIsNoStroke);
  if (["film", "thinking"].includes(stateOf(s))) return says(s, why(s));
  const turnedNow = s.turned;
  s.turned = s.turnedBefore;
  perform(s, last, () => {
    s.turned = turnedNow;
    rest(s);
  });
}

export const showing = (s: Session): Showing => ({
  rest: () => rest(s),
  perform: (stroke, next) => perform(s, stroke, next),
  skip: () => skip(s),
  replay: () => replay(s),
});
