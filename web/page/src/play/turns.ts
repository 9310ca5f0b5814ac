// The turns of a game: it begins, a stroke is played by whoever sits here or by the page's player,
// and the next one comes to the table.
import { drop, far } from "../far.js";
import { angleFrom, direction } from "../table/grip.js";
import { wordsOfChoice } from "../table/words.js";
import { parameters, wrong } from "../ui.js";
import { asked, chances, lookBack } from "./coaching.js";
import { perform, rest } from "./filming.js";
import { OPTIONS, Play, read, type Setup, type Stroke } from "./game.js";
import { countRack, kept, keepText, unpack } from "./keep.js";
import { countGame, isRated } from "./ladder.js";
import {
  aimAt,
  ballsOn,
  callOf,
  calls,
  cueOf,
  free,
  isSafety,
  levelOf,
  look,
  mine,
  NONE,
  placeOf,
  playerOf,
  SAFETY,
  says,
  type Session,
  why,
} from "./session.js";
import { nameOf, wordsOfStroke } from "./state.js";

const REPLY = 400;
/** How long the stroke of the page's player is shown before it is played, ms. */
const SHOWN = 700;
/** The power after the break, m/s. */
const SPEED = 2.5;
export const FIRST: Setup = { game: "eightball", against: "300", own: "800", seed: 1 };
const computer = ({ play }: Session): boolean => /^\d/.test(play.setup.against);

// ---- Strokes ------------------------------------------------------------------------------------

export function shoot(s: Session): void {
  if (!free(s)) return says(s, why(s));
  const { carom, play, settings, sound } = s;
  s.number++; // a search for a hint ends here
  sound.wake();
  const meant = cueOf(s);
  const { own, seed } = play.setup;
  const rating = s.hinted && !(play.practice && own === "0") ? String(levelOf(s)) : own;
  const made =
    rating === "0"
      ? meant
      : carom.withErrors(meant, playerOf(s, rating), seed, play.entries.length + play.past.length);
  const of = asked(s);
  try {
    look(s); // the aim may have changed since the last frame
    const what = callOf(s);
    const one = play.stroke(made, what);
    says(s, "");
    if (settings.coach && play.played && play.setup.drill === undefined)
      void lookBack(s, of, made, what);
    played(s, one);
  } catch (error) {
    says(s, wrong(error));
  }
}
export function choose(s: Session, what: "push" | "pass"): void {
  if (!free(s)) return says(s, why(s));
  if (what === "pass") return played(s, s.play.stroke(cueOf(s), "pass"));
  // A safety holds as long as the aim meets the same ball.
  if (calls(s))
    s.chosen = isSafety(s) ? NONE : { ball: -1, pocket: SAFETY, met: s.first?.ball ?? -1 };
  else if (s.play.breaks) says(s, "A break calls nothing.");
  else s.special = s.special === "push" ? undefined : "push";
  rest(s);
}
/** A stroke was played: its film, and whoever comes next. */
function played(s: Session, one: Stroke): void {
  // Nobody breaks twice: the next stroke begins as one of medium speed.
  if (
    (one.state.opening || (s.play.setup.at === undefined && s.play.entries.length === 1)) &&
    !s.play.breaks
  )
    s.stroke.set({ speed: SPEED });
  s.chosen = NONE;
  s.theirs = undefined;
  s.special = undefined;
  s.hinted = false;
  keep(s);
  perform(s, one, () => next(s));
}
export function undo(s: Session): void {
  if (!s.play.practice) return;
  if (!s.play.undo()) return says(s, "There is nothing to undo.");
  save(s);
  rest(s);
}
/**
 * Whoever comes to the table finds the tip in the middle of the cue ball, and the aim at the
 * nearest ball that is on.
 */
function address(s: Session): void {
  const r = (ball: number): readonly number[] => s.play.balls[ball]!.state.r;
  const far = (ball: number): number => Math.hypot(r(ball)[0]! - r(0)[0]!, r(ball)[1]! - r(0)[1]!);
  const [near] = ballsOn(s).sort((a, b) => far(a) - far(b));
  s.stroke.set({ right: 0, up: 0, theta: 0 });
  if (near !== undefined)
    s.stroke.set({ phi: direction(angleFrom(s.play.balls[0]!, [r(near)[0]!, r(near)[1]!])) });
}
export function next(s: Session): void {
  const { play } = s;
  const { drill, at } = play.setup;
  if (drill !== undefined && play.last) {
    const { text, again } = s.training.played(drill, play.last);
    says(s, text);
    // The next try begins where this one began.
    if (again) play.lay(new Play(s.carom, { ...play.setup, at }).balls);
  }
  if (s.link.waiting()) return s.link.onward();
  if (play.last && play.hasPockets && computer(s) && play.last.who !== s.seat)
    says(s, wordsOfStroke(play, play.last, s.seat));
  if (play.winner !== undefined && isRated(play.setup)) says(s, s.training.rating().words);
  if (play.winner === undefined && !mine(s) && computer(s)) void reply(s);
  else {
    if (!play.practice && !play.breaks && mine(s)) address(s);
    rest(s);
  }
  // After a stroke its review is read, until the aim changes.
  if (s.settings.coach && !play.last) void chances(s);
}

/** The page's player: he plans in a worker, puts the cue ball, and errs. */
async function reply(s: Session): Promise<void> {
  const { carom, play } = s;
  const mine = ++s.number;
  s.thinks = true;
  rest(s);
  const { against, own, seed } = play.setup;
  try {
    const options = {
      ...play.state,
      player: playerOf(s, against),
      opponent: playerOf(s, own === "0" ? "700" : own),
      shot: OPTIONS,
      seed: seed + play.entries.length,
      inHand: placeOf(s)!,
      best: 1,
      shots: REPLY,
    };
    const [one] = await far("plan", play.table, play.balls, options);
    if (mine !== s.number) return;
    if (play.hand !== "no") play.put(0, ...(one!.place as [number, number]));
    s.theirs = one!.cue;
    rest(s);
    says(
      s,
      `${nameOf(play, play.turn, s.seat)} plays ${wordsOfChoice(play.table, play.names, one!, s.first?.ball === -1)}.`,
    );
    await new Promise((later) =>
      window.setTimeout(later, s.film.pace.value === "1000" ? 0 : SHOWN),
    );
    if (mine !== s.number) return;
    const pot =
      one!.ball > 0 && one!.pocket >= 0 ? { ball: one!.ball, pocket: one!.pocket } : undefined;
    const given = one!.kind === "push" || one!.kind === "pass" ? one!.kind : pot;
    s.thinks = false;
    played(
      s,
      play.stroke(
        carom.withErrors(one!.cue, playerOf(s, against), seed, play.entries.length),
        given,
      ),
    );
  } catch (error) {
    if (mine !== s.number) return;
    s.thinks = false;
    says(s, wrong(error));
  }
}

// ---- Games --------------------------------------------------------------------------------------

/** Puts a game on the table. */
export function start(s: Session, play: Play): void {
  drop("plan");
  const turned = play.balls.map(() => [1, 0, 0, 0] as const);
  Object.assign(s, {
    number: s.number + 1,
    then: undefined,
    theirs: undefined,
    thinks: false,
    play,
    turned,
    turnedBefore: turned,
    chosen: NONE,
    special: undefined,
    hinted: false,
  });
  s.film.stop();
  s.film.look(1);
}
export function begin(s: Session, setup: Setup): void {
  s.seat = 0;
  start(s, new Play(s.carom, JSON.parse(JSON.stringify(setup)) as Setup));
  const { play } = s;
  aimAt(s, {
    ...cueOf(s),
    theta: 0,
    ...(play.played?.begin ?? { speed: 4, phi: 62, a: 0, b: 0 }),
    ...(setup.at === undefined ? {} : { speed: 2, phi: 90 }),
  });
  says(
    s,
    setup.drill !== undefined
      ? s.training.told(setup.drill)
      : play.practice
        ? "Drag balls to lay them, drag on the cloth to aim, tap Shoot."
        : "Drag on the table to aim, then tap Shoot.",
  );
  save(s);
  rest(s);
}
/**
 * Keeps the game: in the browser; one by link in the address and on other pages of this machine.
 */
function save({ play, link }: Session): void {
  if (play.setup.against === "link") return link.save();
  keepText(play.text());
  if (location.hash !== "#view=play" && !parameters().has("d"))
    history.replaceState(null, "", "#view=play");
}
/** Keeps the game after a stroke, and who has won it. */
export function keep(s: Session): void {
  const { winner, setup } = s.play;
  if (winner !== undefined) {
    countRack(setup, winner);
    countGame(setup, winner);
  }
  save(s);
}

/** The game of the address, the one that was kept, or a new one. */
export async function resume(s: Session): Promise<void> {
  const given = parameters();
  let told = "";
  try {
    const packed = given.get("g");
    const text = packed ? await unpack(packed) : kept();
    if (text !== undefined) {
      const one = read(s.carom, text);
      start(s, one);
      s.seat = packed && given.get("seat") === "1" ? 1 : 0;
      aimAt(s, {
        ...cueOf(s),
        theta: 0,
        ...(one.breaks || one.practice ? one.played?.begin : { speed: SPEED }),
      });
      if (packed && one.entries.length > 0)
        told = `${one.entries.length} ${one.entries.length === 1 ? "stroke was" : "strokes were"} repeated; every bit agrees.`;
      save(s);
      s.link.ask();
      says(s, told);
      if (packed && one.last?.shot && mine(s)) return perform(s, one.last, () => next(s));
      return next(s);
    }
  } catch (error) {
    told = `The game was not read: ${wrong(error)}.`;
  }
  begin(s, { ...FIRST, seed: Math.floor(Math.random() * 2 ** 31) });
  if (told) says(s, told);
}
