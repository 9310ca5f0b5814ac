// Pointer and keys on the table of a game. A drag turns the aim, pulls the stick or moves a ball in
// hand; a tap aims at a point or a ball, calls a pocket, or chooses the ball to strike where the
// rules allow several; two fingers, a double tap or the wheel enlarge the table.
import type { Vec3 } from "carom";
import {
  circleOf,
  drawLabels,
  drawLine,
  drawSketches,
  drawStick,
  labelsOf,
  type Line,
} from "../table/drawing.js";
import { onTable } from "../table/filmed.js";
import {
  angleFrom,
  ARROWS,
  direction,
  drawnTo,
  type Film,
  type Grip,
  gripAt,
  movedBy,
  pixelsOf,
  type Point,
  put,
  within,
} from "../table/grip.js";
import { isWithin } from "../table/head.js";
import { NEAR } from "./coaching.js";
import type { Session } from "./parts.js";
import {
  aimed,
  ballsOn,
  called,
  needsCall,
  cueOf,
  free,
  isHinted,
  linesOf,
  look,
  NONE,
  says,
  valid,
} from "./session.js";
import { seenSketches, sketchedAt } from "./sketches.js";
import { aimAtNearest, shoot, undo } from "./turns.js";
import { texts } from "../texts/texts.js";

/**
 * What the pointers hold: one of them a grip, since it went down; two of them the table; and the
 * tap before.
 */
interface Held {
  grip: Grip;
  start: Point;
  place: Point;
  phi: number;
  speed: number;
  taps: boolean;
}
interface Hand {
  held: Held | undefined;
  readonly pointers: Map<number, Point>;
  pinch: { apart: number; zoom: number; middle: Point } | undefined;
  tapped: { when: number; place: Point; phi: number; struck: number } | undefined;
}

const WHITE = "#ffffff";
const MARK = "#ffe28a";
/** The height of a ring around a pocket, above its castings, m. */
const RIM = 0.057;

/**
 * The way of the ball that is met, and of the cue ball after it, as far as the lines of the game
 * show them.
 */
function waysOf(s: Session): Line[] {
  const { ball, start, way, ways } = s.first!;
  if (
    ball < 0 ||
    s.play.breaks ||
    (s.play.practice && !s.play.setup.drill) ||
    linesOf(s) === "none"
  )
    return [];
  const speed = Math.hypot(way[0]!, way[1]!) || 1;
  const lines =
    ways.length > 0 ? ways : [[start, [0, 1].map((c) => start[c]! + (0.3 * way[c]!) / speed)]];
  return lines.map((points) => ({ points, colour: WHITE, width: 1.4, isDashed: true }));
}
/** Rings around what is called or the player's own pocket, and around the ball in hand; its line. */
function marksOf(s: Session): Line[] {
  const { balls, bounds, cueBall, played, practice, state, table } = s.play;
  if (!free(s)) return [];
  const lines: Line[] = [];
  const call = needsCall(s.play) ? called(s) : undefined;
  const mark = (place: readonly number[], radius: number, width: number, height?: number): void => {
    const line = { points: circleOf(place, radius), colour: MARK, width };
    lines.push(height === undefined ? line : { ...line, height });
  };
  const pocket =
    table.pockets[call?.pocket ?? (played?.pockets && !practice ? (state.pocket?.[0] ?? 5) : -1)];
  if (pocket) mark(pocket.centre, pocket.radius + 0.008, 3, RIM);
  if (call) mark(balls[call.ball]!.state.r, balls[call.ball]!.kind.radius + 0.008, 3);
  if (isHinted(s) && s.place) mark(s.place, NEAR, 2);
  const { kind, state: inHand } = balls[cueBall]!;
  if (!bounds || !onTable(inHand)) return lines;
  mark(inHand.r, kind.radius + 0.02, 2);
  const { low, high } = bounds;
  if (high[1] < table.length / 2)
    lines.push({ points: [[low[0], high[1]], high], colour: MARK, width: 1, isDashed: true });
  return lines;
}
/** All lines of what is aimed, called and in hand. */
export function linesOfAim(s: Session): Line[] {
  const { film, first, play } = s;
  if (film.time > 0 || film.playing) return [];
  const cueBall = play.balls[play.cueBall]!;
  const lines = [...marksOf(s), ...seenSketches(s).flatMap((sketch) => sketch.lines)];
  if (!first || !aimed(s) || !onTable(cueBall.state)) return lines;
  return [
    ...lines,
    { points: [cueBall.state.r, first.place], colour: WHITE, width: 1.4 },
    { points: circleOf(first.place, cueBall.kind.radius), colour: WHITE, width: 1.4 },
    ...waysOf(s),
  ];
}
/** A number on a ball of the scene of this radius can be read, pixels. */
export const READABLE = 10;
/** Draws what is aimed, called and in hand over the table; of the scene, which has that, less. */
export function drawAim(s: Session, g: CanvasRenderingContext2D): void {
  const { film, play, space } = s;
  const pen = { g, scale: film.scale, place: film.place };
  const hasLetters = s.settings.numbers;
  const radius = play.balls[0]!.kind.radius * film.scale;
  // A rack, and balls large enough to read, have labels only if a setting turns them on.
  const isRead = (play.breaks || radius > READABLE) && !hasLetters;
  const letters = hasLetters ? texts.letters : {};
  const labels = isRead ? [] : labelsOf(play.names, letters);
  if (film.time > 0 || film.playing) {
    // Balls that are too small to read while they roll have their labels next to them.
    const poses = radius < 8 || hasLetters ? s.filmed!.shots[0]!.poses(film.time) : [];
    return drawLabels(
      pen,
      poses.map(({ r, seen }, k) => ({
        kind: play.balls[k]!.kind,
        state: { r: r as Vec3, label: seen && r[2]! > 0 ? "rolling" : "pocketed" },
      })),
      labels,
    );
  }
  drawSketches(pen, seenSketches(s));
  if (!space.isLive) {
    for (const line of linesOfAim(s)) drawLine(pen, line);
    const cueBall = play.balls[play.cueBall]!;
    const cue = aimed(s);
    if (cue && onTable(cueBall.state)) drawStick(pen, cueBall, cue);
  }
  drawLabels(pen, play.balls, labels);
}

// ---- One pointer --------------------------------------------------------------------------------

/** What is under a pointer. A finger reaches farther. */
function under(s: Session, place: Point, finger: boolean): Grip {
  const { balls, table } = s.play;
  const reach = (finger ? 20 : 10) / s.film.scale;
  const grip = gripAt(
    place,
    reach,
    table,
    balls,
    balls.map(({ state }) => (onTable(state) ? state.r : undefined)),
    cueOf(s),
    reach,
  );
  return grip.kind === "line" ? { kind: "cloth" } : grip;
}
function set(s: Session, stroke: { phi: number } | { speed: number }): void {
  s.stroke.set(stroke);
  s.changed();
}
const turn = (s: Session, phi: number): void => set(s, { phi: direction(phi) });
/** Whether a ball may be moved. */
export const movable = ({ play }: Session, ball: number): boolean =>
  play.practice || (ball === play.cueBall && play.hand !== "no");
export function move(s: Session, ball: number, target: Point): void {
  const { play } = s;
  const { balls, bounds, table } = play;
  const laid = put(s.carom, table, balls, ball, target, bounds?.high[1]);
  // it stays
  if (!laid || (bounds && !isWithin(bounds, laid[ball]!.state))) return;
  play.balls = laid;
  s.changed();
}
function drag(s: Session, { grip, start, phi, speed }: Held, place: Point): void {
  const cueBall = s.play.balls[s.play.cueBall]!;
  if (grip.kind === "ball" && movable(s, grip.ball)) move(s, grip.ball, place);
  else if (grip.kind === "stick") set(s, { speed: drawnTo(cueBall, speed, start, place) });
  else turn(s, phi + angleFrom(cueBall, place) - angleFrom(cueBall, start));
}
/** A ball or a pocket was tapped: it is called. */
function choose(s: Session, target: { ball: number } | { pocket: number }): void {
  look(s);
  const hitBall = s.first?.ball ?? -1;
  if ("pocket" in target) {
    s.chosen = { ...valid(s), pocket: target.pocket, hitBall };
    if (needsCall(s.play) && !called(s)) says(s, texts.whichBallTapIt);
  } else {
    const { ball } = target;
    const mayBeCalled = needsCall(s.play) && ballsOn(s.play).includes(ball);
    s.chosen = mayBeCalled ? { ball, pocket: -1, hitBall } : NONE;
  }
  s.changed();
}
/** Chooses the ball that is struck, and aims it at the nearest one. */
function strike(s: Session, ball: number): void {
  s.play.strike(ball);
  says(s, "");
  aimAtNearest(s);
  s.changed();
}
export function tap(s: Session, grip: Grip, place: Point): void {
  const cueBall = s.play.balls[s.play.cueBall]!;
  if (s.asksPlace) return void s.coach.leaveNear(place);
  const sketched = sketchedAt(s, place);
  if (sketched) return s.coach.take(sketched);
  if (grip.kind === "pocket") return choose(s, { pocket: grip.pocket });
  if (grip.kind === "ball" && grip.ball !== s.play.cueBall) {
    if (s.play.strikable.includes(grip.ball)) return strike(s, grip.ball);
    const { r } = s.play.balls[grip.ball]!.state;
    turn(s, angleFrom(cueBall, [r[0], r[1]]));
    choose(s, { ball: grip.ball });
  } else if (grip.kind === "cloth") turn(s, angleFrom(cueBall, place));
}

// ---- Two pointers -------------------------------------------------------------------------------

const middle = ([a, b]: Point[]): Point => [(a![0] + b![0]) / 2, (a![1] + b![1]) / 2];
const apart = ([a, b]: Point[]): number => Math.hypot(a![0] - b![0], a![1] - b![1]);
/** Enlarges the table by a factor, with a point of it under a pixel. */
function enlarge(film: Film, times: number, place: Point, under: Point): void {
  film.look(times, place);
  const centre = film.unplace(film.canvas.clientWidth / 2, film.canvas.clientHeight / 2);
  const current = film.unplace(...under);
  film.look(times, [centre[0] + place[0] - current[0], centre[1] + place[1] - current[1]]);
}
/** A second finger is there: the first one has begun to aim, and has not. */
function pinch(s: Session, hand: Hand): void {
  if (hand.held && free(s)) {
    s.stroke.set({ phi: hand.held.phi, speed: hand.held.speed });
    s.changed();
  }
  hand.held = undefined;
  const both = [...hand.pointers.values()];
  hand.pinch = { apart: apart(both), zoom: s.film.zoom, middle: s.film.unplace(...middle(both)) };
}

// ---- Events -------------------------------------------------------------------------------------

function down(s: Session, hand: Hand, event: PointerEvent): void {
  const { film, play } = s;
  if (event.button > 0) return;
  if (film.playing || s.space.isStriking) return s.showing.skip();
  hand.pointers.set(event.pointerId, pixelsOf(film.canvas, event));
  film.canvas.setPointerCapture(event.pointerId);
  if (hand.pointers.size === 2) return pinch(s, hand);
  if (!free(s) || hand.pointers.size > 1) return;
  const place = film.unplace(...pixelsOf(film.canvas, event));
  const { phi, speed } = cueOf(s);
  hand.held = {
    grip: under(s, place, event.pointerType === "touch"),
    start: place,
    place,
    phi,
    speed,
    taps: true,
  };
  if (hand.held.grip.kind === "ball" && play.practice) play.keep();
}
function over(s: Session, { pointers, pinch, held }: Hand, event: PointerEvent): void {
  if (!pointers.has(event.pointerId)) return;
  const pixels = pixelsOf(s.film.canvas, event);
  pointers.set(event.pointerId, pixels);
  if (pinch && pointers.size === 2) {
    const both = [...pointers.values()];
    return enlarge(s.film, (pinch.zoom * apart(both)) / pinch.apart, pinch.middle, middle(both));
  }
  if (!held || !free(s)) return;
  held.place = s.film.unplace(...pixels);
  if (apart([held.place, held.start]) * s.film.scale > 5) held.taps = false;
  if (!held.taps) drag(s, held, held.place);
}
function up(s: Session, hand: Hand, event: PointerEvent): void {
  hand.pointers.delete(event.pointerId);
  if (hand.pointers.size < 2) hand.pinch = undefined;
  const was = hand.held;
  hand.held = undefined;
  if (!was) return;
  if (was.taps && was.grip.kind === "ball" && s.play.practice) s.play.past.pop(); // nothing was moved
  if (event.type !== "pointerup" || !was.taps || !free(s)) return;
  // A second tap at the same place shows it larger, or all of the table; the first one has aimed at
  // nothing.
  const place = pixelsOf(s.film.canvas, event);
  const previous = hand.tapped;
  hand.tapped = { when: event.timeStamp, place, phi: was.phi, struck: s.play.cueBall };
  if (
    event.pointerType !== "touch" ||
    !previous ||
    event.timeStamp - previous.when > 350 ||
    apart([place, previous.place]) > 30
  )
    return tap(s, was.grip, was.place);
  hand.tapped = undefined;
  s.play.strike(previous.struck);
  turn(s, previous.phi);
  if (s.film.zoom > 1) s.film.look(1);
  else enlarge(s.film, 3, was.place, place);
}
/** A key of an arrow: it turns the aim, sets the power, or with Alt moves the cue ball in hand. */
function arrowKey(s: Session, arrow: Point, { altKey, shiftKey }: KeyboardEvent): boolean {
  const { film, play } = s;
  const { phi, speed } = cueOf(s);
  if (altKey) {
    if (!movable(s, play.cueBall)) return false;
    move(
      s,
      play.cueBall,
      movedBy(film, play.balls[play.cueBall]!, arrow, (shiftKey ? 0.05 : 0.005) * film.scale),
    );
  } else if (arrow[0] !== 0) turn(s, phi - arrow[0] * (shiftKey ? 1 : 0.1));
  else set(s, { speed: within(speed - arrow[1] * (shiftKey ? 0.5 : 0.1)) });
  return true;
}
/** Calls the next pocket, which C does. */
function callNext(s: Session): void {
  const current = (needsCall(s.play) ? called(s) : undefined)?.pocket ?? -1;
  choose(s, { pocket: (current + 1) % s.play.table.pockets.length });
}
/** Chooses the next ball to be struck, which B does. */
function strikeNext(s: Session): void {
  const { cueBall, strikable } = s.play;
  strike(s, strikable[(strikable.indexOf(cueBall) + 1) % strikable.length]!);
}
/** Does what a key means now, and returns whether it means anything. */
function pressed(s: Session, event: KeyboardEvent): boolean {
  const ends = event.key === "Enter" || event.key === "Escape";
  if ((s.film.playing || s.space.isStriking) && ends) s.showing.skip();
  else if (event.key === "Enter" && s.asksPlace && s.first)
    void s.coach.leaveNear([s.first.place[0]!, s.first.place[1]!]);
  else if (event.key === "Enter") shoot(s);
  else if (!free(s)) return false;
  else if ((event.ctrlKey || event.metaKey) && event.key === "z") undo(s);
  else if (event.key === "c" && s.play.hasPockets) callNext(s);
  else if (event.key === "b" && s.play.strikable.length > 1) strikeNext(s);
  else {
    const arrow = ARROWS[event.key];
    return arrow !== undefined && arrowKey(s, arrow, event);
  }
  return true;
}

/** Lets pointers and keys handle the table. */
export function aiming(s: Session): void {
  const { canvas } = s.film;
  const hand: Hand = { held: undefined, pointers: new Map(), pinch: undefined, tapped: undefined };
  canvas.addEventListener("pointerdown", (event) => down(s, hand, event));
  canvas.addEventListener("pointermove", (event) => over(s, hand, event));
  for (const type of ["pointerup", "pointercancel"] as const)
    canvas.addEventListener(type, (event) => up(s, hand, event));
  canvas.addEventListener("keydown", (event) => {
    if (pressed(s, event)) event.preventDefault();
  });
  const wheel = (event: WheelEvent): void => {
    event.preventDefault();
    const place = pixelsOf(canvas, event);
    enlarge(s.film, s.film.zoom * Math.exp(-event.deltaY / 400), s.film.unplace(...place), place);
  };
  canvas.addEventListener("wheel", wheel, { passive: false });
}
