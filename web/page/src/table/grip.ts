// What a pointer grips on a table, and where a drag moves it: the same in a game and in the
// laboratory.
import { type Carom, CaromError, type Cue, type ShotBall, type Table } from "carom";
import type { player } from "../../../player/player.js";
import { DEGREES, PULL, stickEnd } from "./drawing.js";
import { onTable } from "./filmed.js";

export type Point = [number, number];
export type Film = ReturnType<typeof player>;
export type Grip =
  | { kind: "ball"; ball: number }
  | { kind: "pocket"; pocket: number }
  | { kind: "stick" | "line" | "cloth" | "turn" };
export const ARROWS: Record<string, Point> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, -1],
  ArrowDown: [0, 1],
};

/** Where a pointer is on a canvas, pixels. */
export function pixelsOf(
  canvas: HTMLCanvasElement,
  event: { clientX: number; clientY: number },
): Point {
  const box = canvas.getBoundingClientRect();
  return [event.clientX - box.left, event.clientY - box.top];
}

/**
 * What lies at a place of a table, for a pointer that reaches so far, m: the nearest of the balls,
 * each of which has its place; a pocket, which has a reach of
 * its own; the stick, or the line of aim in front of it.
 */
export function gripAt(
  [x, y]: Point,
  reach: number,
  { pockets }: Table,
  balls: readonly ShotBall[],
  places: readonly (readonly number[] | undefined)[],
  cue: Cue,
  ofPocket: number,
): Grip {
  const distance = ([px, py]: readonly number[]): number => Math.hypot(px! - x, py! - y);
  let ball = -1;
  places.forEach((place, k) => {
    if (
      place &&
      distance(place) < Math.max(1.2 * balls[k]!.kind.radius, reach) &&
      (ball < 0 || distance(place) < distance(places[ball]!))
    )
      ball = k;
  });
  if (ball >= 0) return { kind: "ball", ball };
  const pocket = pockets.findIndex(
    ({ centre, radius }) => distance(centre) < Math.max(radius + 0.01, ofPocket),
  );
  if (pocket >= 0) return { kind: "pocket", pocket };
  const cueBall = balls[cue.ball]!;
  const { r } = cueBall.state;
  const dx = Math.cos(cue.phi / DEGREES);
  const dy = Math.sin(cue.phi / DEGREES);
  const along = (x - r[0]) * dx + (y - r[1]) * dy;
  if (Math.abs((y - r[1]) * dx - (x - r[0]) * dy) >= reach) return { kind: "cloth" };
  const end = stickEnd(cueBall.kind.radius, cue.speed);
  if (along < 0 && -along > end - reach && -along < end + 1.3) return { kind: "stick" };
  return { kind: along > 0 ? "line" : "cloth" };
}

/** The direction from a ball to a point, degrees. */
export const angleFrom = ({ state: { r } }: ShotBall, [x, y]: Point): number =>
  Math.atan2(y - r[1], x - r[0]) * DEGREES;
/** A direction in steps of 0.01 degrees, from 0 on. */
export const direction = (phi: number): number =>
  Math.round((((phi % 360) + 360) % 360) * 100) / 100;
export const within = (speed: number, steps = 100): number =>
  Math.round(Math.min(Math.max(speed, 0.1), 10) * steps) / steps;
/** The speed of a stick that is pulled back from one point to another. */
export function drawnTo(
  { state: { r } }: ShotBall,
  speed: number,
  start: Point,
  place: Point,
): number {
  const back = ([x, y]: Point): number => Math.hypot(x - r[0], y - r[1]);
  return within(speed + (back(place) - back(start)) / PULL);
}
/** The position of a ball that is moved by so many pixels. */
export function movedBy(
  film: Film,
  { state: { r } }: ShotBall,
  [dx, dy]: Point,
  pixels: number,
): Point {
  const [px, py] = film.place(r[0], r[1]);
  return film.unplace(px + dx * pixels, py + dy * pixels);
}

/**
 * The layout with a ball at x, y: inside the cushions, and beside another ball where one is in the
 * way. Undefined where there is no room.
 */
export function put(
  carom: Carom,
  table: Table,
  balls: readonly ShotBall[],
  ball: number,
  [x, y]: readonly [number, number],
  highest = Infinity,
): ShotBall[] | undefined {
  const R = balls[ball]!.kind.radius;
  const inside = (v: number, most: number): number =>
    Math.min(Math.max(v, R + 1e-4), most - R - 1e-4);
  let px = inside(x, table.width);
  let py = Math.min(inside(y, table.length), highest);
  const neighbor = balls.find(
    ({ state }, k) =>
      k !== ball && onTable(state) && Math.hypot(state.r[0] - px, state.r[1] - py) < 2 * R + 1e-5,
  );
  if (neighbor) {
    const [ox, oy] = neighbor.state.r;
    const far = (2 * R + 2e-5) / (Math.hypot(px - ox, py - oy) || 1);
    [px, py] = [ox + (px - ox) * far, oy + (py - oy) * far];
  }
  try {
    return carom.placeBall(table, balls, ball, px, py);
  } catch (error) {
    if (error instanceof CaromError) return undefined;
    throw error;
  }
}
