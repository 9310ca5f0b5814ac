// What is seen of a game: the balls as they lie, with the stroke that is aimed; the film of a
// stroke that was played; and what is told beside both.
import { CaromError } from "carom";
import { pocketName, product } from "../../../player/words.js";
import { filmOf, lasts, onTable, type Path, pathsOf } from "../table/filmed.js";
import { GAMES } from "../table/games.js";
import { OPTIONS, type Stroke } from "./game.js";
import { racksOf } from "./keep.js";
import {
  aimed,
  called,
  calls,
  cueOf,
  free,
  isSafety,
  linesOf,
  look,
  says,
  type Session,
  stateOf,
  why,
} from "./session.js";
import { nameOf, wordsOfScore, wordsOfTurn } from "./state.js";

function show(s: Session, of: NonNullable<Session["filmed"]>): void {
  s.filmed = of;
  s.film.show(of);
  s.space.draw();
}
/** The time of the film has changed. */
export function moved(s: Session): void {
  s.space.draw();
  if (s.shown?.shot && s.film.playing) s.sound.between(s.shown.shot.events, s.sounded, s.film.time);
  s.sounded = s.film.time;
}

/**
 * The balls as they lie, with what may be seen of the stroke: in a game the line to the first
 * contact.
 */
export function rest(s: Session): void {
  const { carom, play, turned } = s;
  s.first = undefined;
  let paths: Path[] = [];
  if (aimed(s) && onTable(play.balls[0]!.state))
    try {
      if (play.practice && !play.setup.drill)
        paths = pathsOf(carom.simulate(play.table, play.balls, cueOf(s), OPTIONS));
      look(s);
    } catch (error) {
      if (!(error instanceof CaromError)) throw error;
      says(s, `This stroke cannot be played: ${error.message}.`);
    }
  s.shown = undefined;
  show(
    s,
    filmOf({ table: play.table, balls: play.balls, names: play.names, turned }, undefined, paths),
  );
  tell(s);
}

/**
 * Tells whose turn it is, the call and the score, and shows the buttons that have a meaning now.
 */
export function tell(s: Session): void {
  const { play, seat, buttons, words, film } = s;
  const can = free(s);
  const call = can && calls(s) ? called(s) : undefined;
  const safe = can && isSafety(s);
  const pushes = play.state.may?.includes("push") === true;
  // What comes of a stroke is told after its film. What is read aloud changes only where the words
  // do.
  const plays =
    s.then !== undefined && s.shown && !play.practice ? nameOf(play, s.shown.who, seat) : undefined;
  const told = plays
    ? `${plays} ${plays === "You" ? "play" : "plays"} …`
    : `${wordsOfTurn(play, seat, s.thinks, s.hinted)}${call ? ` Call: the ${play.names[call.ball]}, ${pocketName(play.table, call.pocket)}.` : safe ? " Call: a safety." : can && calls(s) ? " Nothing is called: aim at a ball, or tap a pocket." : ""}`;
  if (words.turn.textContent !== told) words.turn.textContent = told;
  if (!plays) words.score.textContent = wordsOfScore(play, seat, racksOf(play.setup));
  const { first } = s;
  s.stroke.met(
    can && first && first.ball > 0 && (play.practice || linesOf(s) !== "none") ? first : undefined,
    play.names[first?.ball ?? 0],
  );
  const laid = play.practice && !play.setup.drill;
  const seen: [HTMLElement, boolean][] = [
    [buttons.hint, play.played !== undefined],
    [buttons.undo, laid],
    [buttons.rack, laid || (play.winner !== undefined && s.then === undefined)],
    [buttons.push, (can && pushes) || (play.played?.calls === true && !play.practice)],
    [buttons.pass, can && play.mayPass],
    [buttons.skip, film.playing],
    [s.stroke.shoot, !film.playing],
    [buttons.link, play.setup.against === "link"],
  ];
  for (const [element, is] of seen) element.hidden = !is;
  // What does nothing now keeps its place, so that the others keep theirs, and says why when it is
  // pressed.
  const able: [HTMLElement, boolean][] = [
    [s.stroke.shoot, can],
    [buttons.hint, can],
    [buttons.push, can && (pushes || calls(s))],
    [buttons.replay, play.last?.shot !== undefined && !["film", "thinking"].includes(stateOf(s))],
    [buttons.undo, play.past.length > 0],
  ];
  for (const [element, is] of able) element.setAttribute("aria-disabled", String(!is));
  buttons.push.textContent = pushes ? "Push out" : "Safety";
  buttons.push.setAttribute("aria-pressed", String(safe || s.special === "push"));
  film.canvas.setAttribute(
    "aria-label",
    `${GAMES[play.played?.of ?? play.setup.game]!.text} table from above. ${words.turn.textContent}`,
  );
}

/** Shows a stroke that was played, and what comes after it. */
export function perform(s: Session, one: Stroke, after: () => void): void {
  s.turnedBefore = s.turned;
  s.then = after;
  s.shown = one;
  s.sounded = -1;
  if (!one.shot) return finish(s);
  s.film.look(1);
  show(
    s,
    filmOf(
      { table: s.play.table, balls: one.balls, names: s.play.names, turned: s.turned },
      one.shot,
      [],
    ),
  );
  s.film.start();
  tell(s);
}
export function finish(s: Session): void {
  const after = s.then;
  if (s.shown?.shot) {
    const end = s.shown.shot.orientations(lasts(s.shown.shot));
    s.turned = s.turned.map((q, k) => product(end.subarray(4 * k, 4 * k + 4), q));
  }
  s.then = undefined;
  after?.();
}
export function skip(s: Session): void {
  if (!s.film.playing) return;
  s.film.stop();
  finish(s);
}
export function replay(s: Session): void {
  const one = s.play.last;
  if (!one?.shot) return says(s, "There is no stroke to show yet.");
  if (["film", "thinking"].includes(stateOf(s))) return says(s, why(s));
  const now = s.turned;
  s.turned = s.turnedBefore;
  perform(s, one, () => {
    s.turned = now;
    rest(s);
  });
}
