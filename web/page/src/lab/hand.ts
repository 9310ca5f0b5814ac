// Pointer and keys in the laboratory: finding what is under a pointer, moving and turning balls,
// aiming, and drawing the aim.
import type { ShotBall } from "carom";
import { DEGREES, drawContact, drawStick, ring } from "../table/drawing.js";
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
import { pocketed } from "../table/places.js";
import { eachFrame } from "../ui.js";
import { cueOf, type Desk } from "./desk.js";
import { aimAt } from "./lines.js";

/**
 * What is held, since where, with what value of what it changes; and the shot that is played again
 * before the next frame.
 */
interface Hand {
  held: { grip: Grip; place: Point; start: Point; value: number; taps: boolean } | undefined;
  readonly soon: () => void;
}

// ---- Drawing ------------------------------------------------------------------------------------

/** Balls that are not on the table wait on the wood at its side, in this order from the head. */
const waits = ({ balls }: Desk): number[] =>
  balls.flatMap(({ state }, k) => (onTable(state) ? [] : [k]));
const waitsAt = ({ table }: Desk, index: number): Point => [
  -0.045,
  0.12 + 0.075 * index + (0.12 + 0.075 * index > table.length / 2 - 0.1 ? 0.2 : 0),
];
/**
 * Whether a ball is picked that lies on the table; the handle that turns it, 36 pixels from its
 * middle.
 */
const canTurn = ({ chosen, balls }: Desk): boolean => chosen > 0 && onTable(balls[chosen]!.state);
function turner({ balls, chosen, faces, film }: Desk): Point {
  const { r } = balls[chosen]!.state;
  const away = 36 / film.scale;
  const face = faces[chosen]! / DEGREES;
  return [r[0] + away * Math.cos(face), r[1] + away * Math.sin(face)];
}

/**
 * Draws, at the start of the film, the ball that is picked, the stick, the ghost ball and the
 * tangent line.
 */
export function drawHand(d: Desk, g: CanvasRenderingContext2D): void {
  const { film, balls } = d;
  const pen = { g, scale: film.scale, place: film.place };
  const cue = cueOf(d);
  waits(d).forEach((k, index) =>
    film.drawBall(g, k, { r: [...waitsAt(d, index), 0], q: [1, 0, 0, 0], seen: true }, 1),
  );
  if (film.time > 0 || film.playing || cue.ball !== 0) return;
  const [cueBall] = balls as [ShotBall];
  const R = cueBall.kind.radius;
  const contact = d.shot?.firstContact;
  if (contact)
    drawContact(pen, contact, R, [Math.cos(cue.phi / DEGREES), Math.sin(cue.phi / DEGREES)]);
  if (canTurn(d)) {
    g.strokeStyle = "#ffe28a";
    g.fillStyle = "#ffe28a";
    g.lineWidth = 2;
    ring(pen, balls[d.chosen]!.state.r, R, 3);
    g.beginPath();
    g.arc(...film.place(...turner(d)), 6, 0, 7);
    g.fill();
  }
  if (onTable(cueBall.state)) drawStick(pen, cueBall, cue);
}

// ---- What a pointer does ------------------------------------------------------------------------

const position = ({ canvas, unplace }: Film, event: { clientX: number; clientY: number }): Point =>
  unplace(...pixelsOf(canvas, event));
/** What is under a pointer. A finger reaches farther. */
function under(d: Desk, place: Point, finger: boolean): Grip {
  const reach = (finger ? 22 : 12) / d.film.scale;
  const distance = ([x, y]: readonly number[]): number => Math.hypot(x! - place[0], y! - place[1]);
  const places: (readonly number[])[] = d.balls.map(({ state }) => state.r);
  waits(d).forEach((k, index) => (places[k] = waitsAt(d, index)));
  if (canTurn(d) && distance(turner(d)) < Math.min(reach, ...places.map(distance)))
    return { kind: "turn" };
  return gripAt(place, reach, d.table, d.balls, places, cueOf(d), 0);
}
function turnTo(d: Desk, { soon }: Hand, phi: number): void {
  d.controls.set("phi", direction(phi));
  soon();
}
function turnBall(d: Desk, { soon }: Hand, ball: number, degrees: number): void {
  d.faces[ball] = (Math.round(d.faces[ball]! + degrees) + 720) % 360;
  soon();
}
/**
 * Puts a ball where there is room, beside another one if need be. Off the table it waits in a
 * pocket; the cue ball does not.
 */
function moveBall(d: Desk, { soon }: Hand, ball: number, [x, y]: Point): void {
  const { table, balls } = d;
  const out = Math.max(-x, x - table.width, -y, y - table.length) > 1.5 * balls[ball]!.kind.radius;
  const leaves = out && ball !== 0 && table.pockets.length > 0;
  const laid = leaves
    ? balls.map((each, k) =>
        k === ball ? { kind: each.kind, state: pocketed(table, each.state) } : each,
      )
    : put(d.carom, table, balls, ball, [x, y]);
  if (!laid) return; // it stays
  d.balls = laid;
  d.moved = true;
  soon();
}
function drag(d: Desk, hand: Hand, place: Point): void {
  if (!hand.held) return;
  const { grip, start, value } = hand.held;
  const cueBall = d.balls[0]!;
  const picked = d.balls[d.chosen]!;
  if (grip.kind === "ball") moveBall(d, hand, grip.ball, place);
  else if (grip.kind === "turn")
    turnBall(
      d,
      hand,
      d.chosen,
      value + angleFrom(picked, place) - angleFrom(picked, start) - d.faces[d.chosen]!,
    );
  else if (grip.kind === "stick") {
    d.controls.set("speed", drawnTo(cueBall, value, start, place));
    hand.soon();
  } else if (grip.kind === "line")
    turnTo(d, hand, value + angleFrom(cueBall, place) - angleFrom(cueBall, start));
  else if (grip.kind === "cloth") turnTo(d, hand, angleFrom(cueBall, place));
  hand.held.place = place;
}
function clicked(d: Desk, grip: Grip): void {
  if (grip.kind === "ball" && grip.ball > 0) {
    d.chosen = d.chosen === grip.ball ? -1 : grip.ball;
    d.film.draw();
  } else if (grip.kind === "pocket") aimAt(d, grip.pocket);
}

/** What a drag of a grip changes, as it is before. */
function valueOf({ controls, faces, chosen }: Desk, { kind }: Grip): number {
  if (kind === "stick") return controls.value("speed");
  if (kind === "turn") return faces[chosen]!;
  return controls.value("phi");
}

// ---- Events -------------------------------------------------------------------------------------

function down(d: Desk, hand: Hand, event: PointerEvent): void {
  const { film } = d;
  if (film.time > 0 || film.playing) film.go(0);
  const place = position(film, event);
  const grip = under(d, place, event.pointerType === "touch");
  hand.held = {
    grip,
    place,
    start: place,
    value: valueOf(d, grip),
    taps: true,
  };
  // A finger on the cloth may be about to scroll the page: what it does waits for its end.
  if (event.pointerType === "touch") return;
  film.canvas.setPointerCapture(event.pointerId);
  if (grip.kind === "cloth") drag(d, hand, place);
}
function over(d: Desk, hand: Hand, event: PointerEvent): void {
  if (!hand.held) return;
  const { start, grip } = hand.held;
  const place = position(d.film, event);
  if (Math.hypot(place[0] - start[0], place[1] - start[1]) * d.film.scale > 4)
    hand.held.taps = false;
  if (!hand.held.taps && !(event.pointerType === "touch" && grip.kind === "cloth"))
    drag(d, hand, place);
}
function up(d: Desk, hand: Hand): void {
  const was = hand.held;
  if (was?.taps) {
    if (was.grip.kind === "cloth") drag(d, hand, was.place);
    else clicked(d, was.grip);
  }
  hand.held = undefined;
}
function key(d: Desk, hand: Hand, undo: () => void, event: KeyboardEvent): void {
  const { set, value } = d.controls;
  const arrow = ARROWS[event.key];
  const ball = Math.max(d.chosen, 0);
  const step = event.shiftKey ? 1 : 0.1;
  if (event.key === " ") d.film.play.click();
  else if ((event.ctrlKey || event.metaKey) && event.key === "z") undo();
  else if (event.key === "," || event.key === ".")
    turnBall(d, hand, ball, event.key === "." ? 10 : -10);
  // The picked ball, or the cue ball, by 1 mm as one sees it.
  else if (event.altKey && arrow)
    moveBall(d, hand, ball, movedBy(d.film, d.balls[ball]!, arrow, step * 0.01 * d.film.scale));
  else if (!arrow) return;
  else if (arrow[0] !== 0)
    set("phi", Math.round(((value("phi") - arrow[0] * step + 360) % 360) * 1e6) / 1e6);
  else set("speed", within(value("speed") - arrow[1] * 0.1, 1e6));
  event.preventDefault();
  if (arrow && !event.altKey) d.aimed();
}

/** Lets pointers and keys handle the table. */
export function handle(d: Desk, undo: () => void): void {
  const { canvas } = d.film;
  const hand: Hand = { held: undefined, soon: eachFrame(() => d.aimed()) };
  canvas.addEventListener("pointerdown", (event) => down(d, hand, event));
  canvas.addEventListener("pointermove", (event) => over(d, hand, event));
  canvas.addEventListener("pointerup", () => up(d, hand));
  canvas.addEventListener("pointercancel", () => (hand.held = undefined));
  canvas.addEventListener("keydown", (event) => key(d, hand, undo, event));
  const touch = (event: TouchEvent): void => {
    const grip =
      event.touches.length === 1
        ? under(d, position(d.film, event.touches[0]!), true).kind
        : "cloth";
    if (grip !== "cloth" && grip !== "pocket" && event.cancelable) event.preventDefault();
  };
  const wheel = (event: WheelEvent): void => {
    const grip = under(d, position(d.film, event), false);
    if (grip.kind !== "ball" || !onTable(d.balls[grip.ball]!.state)) return;
    event.preventDefault();
    turnBall(d, hand, grip.ball, Math.sign(event.deltaY) * 10);
  };
  canvas.addEventListener("touchstart", touch, { passive: false });
  canvas.addEventListener("wheel", wheel, { passive: false });
}
