// The camera of a photo with its lens. A point P of space is seen at
//     (u, v) = f g (a, b),   (a, b) = (X, Y) / Z,   g = 1 + k (a^2 + b^2),   (X, Y, Z) = T (P - E),
// from the middle of the picture, in units of its width: E is the place of the eye, the rows of T are
// right, down and ahead, f is the focal length, and k bends straight lines as simple lenses do. Space
// has x and y of the table, and z = 0 in the plane of the noses. Edges that are seen near where lines
// of the table should be correct these numbers by least squares (Gauss and Newton, damped as by
// Levenberg and Marquardt), which a distant edge hardly moves (Tukey).
import { type Camera, type Pixel, type Pose, solve } from "./photo.js";

type Vector = readonly [number, number, number];
export interface Lens extends Pose {
  /** How much the lens bends lines. */
  bow: number;
  /** How far the wood is behind the noses, m. */
  rail: number;
}

const dot = (a: readonly number[], b: readonly number[]): number =>
  a[0]! * b[0]! + a[1]! * b[1]! + a[2]! * b[2]!;
const cross = ([a, b, c]: Vector, [x, y, z]: Vector): Vector => [
  b * z - c * y,
  c * x - a * z,
  a * y - b * x,
];
const scaled = (a: Vector, factor: number): Vector => [a[0] * factor, a[1] * factor, a[2] * factor];
const sum = (a: Vector, b: Vector): Vector => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
const unit = (a: Vector): Vector => scaled(a, 1 / Math.hypot(...a));

/** Where a point of space is seen. */
export function project({ focal, bow, turn, eye }: Lens, point: Vector): Pixel {
  const offset = sum(point, scaled(eye, -1));
  const far = dot(turn[2], offset);
  const a = dot(turn[0], offset) / far;
  const b = dot(turn[1], offset) / far;
  const scale = focal * (1 + bow * (a * a + b * b));
  return [scale * a, scale * b];
}
/** The point at a height that is seen at a pixel. */
function placeAt({ focal, bow, turn, eye }: Lens, [u, v]: Pixel, height: number): Pixel {
  let a = u / focal;
  let b = v / focal;
  for (let round = 0; round < 8; round++) {
    const g = 1 + bow * (a * a + b * b);
    [a, b] = [u / focal / g, v / focal / g];
  }
  const ray = sum(sum(scaled(turn[0], a), scaled(turn[1], b)), turn[2]);
  const share = (height - eye[2]) / ray[2];
  return [eye[0] + share * ray[0], eye[1] + share * ray[1]];
}
/** Points of the outline of a ball: where its tangents from the eye touch it. */
function outlineOf({ eye }: Lens, middle: Vector, radius: number): Vector[] {
  const towards = sum(eye, scaled(middle, -1));
  const far = Math.hypot(...towards);
  const axis = unit(towards);
  const first = unit(cross(axis, Math.abs(axis[2]) < 0.9 ? [0, 0, 1] : [1, 0, 0]));
  const second = cross(axis, first);
  const centre = sum(middle, scaled(axis, radius ** 2 / far));
  const wide = radius * Math.sqrt(1 - (radius / far) ** 2);
  return Array.from({ length: 32 }, (_, k) => {
    const turn = (k * Math.PI) / 16;
    const side = sum(scaled(first, Math.cos(turn)), scaled(second, Math.sin(turn)));
    return sum(centre, scaled(side, wide));
  });
}

/** The camera of a lens for a picture of a size; `lower`: how far the middles of balls are below the
 * noses, m.
 */
export function cameraOfLens(lens: Lens, [wide, high]: Pixel, lower: number): Camera {
  const toPixel = ([u, v]: Pixel): Pixel => [u * wide + wide / 2, v * wide + high / 2];
  const pixel = ([x, y]: Pixel): Pixel => toPixel(project(lens, [x, y, -lower]));
  const place = ([u, v]: Pixel): Pixel =>
    placeAt(lens, [(u - wide / 2) / wide, (v - high / 2) / wide], -lower);
  return {
    place,
    pixel,
    focal: lens.focal * wide,
    pose: lens,
    outline(middle, radius) {
      const [x, y] = place(middle);
      const points = outlineOf(lens, [x, y, -lower], radius);
      return points.map((point) => {
        const [u, v] = toPixel(project(lens, point));
        return [u - middle[0], v - middle[1]];
      });
    },
  };
}

/** An edge that is seen: the point of the table that it should be of, for a width of the rail. */
export interface Edge {
  point(rail: number): Vector;
  /** Where it is seen, and the direction across it, in units of the picture's width. */
  seen: Pixel;
  across: Pixel;
}
/** How well the numbers are known before: f as a share, k, and the rail, m. */
const SPREAD = { focal: 0.35, bow: 0.03, rail: 0.008 };
/** The width of a cushion's top where nothing is seen of it, m; and the usual bend of a phone. */
export const RAIL = 0.05;
const BOW = -0.005;
const ROUNDS = 12;

/** A lens whose nine numbers are changed by so much. */
function changed(lens: Lens, [f, k, rx, ry, rz, x, y, z, rail]: readonly number[]): Lens {
  const turned = lens.turn.map((row) => sum(row, cross([rx!, ry!, rz!], row)));
  const right = unit(turned[0]!);
  const ahead = unit(cross(right, turned[1]!));
  return {
    focal: lens.focal * Math.exp(f!),
    bow: lens.bow + k!,
    turn: [right, cross(ahead, right), ahead],
    eye: sum(lens.eye, [x!, y!, z!]),
    rail: lens.rail + rail!,
  };
}
/**
 * The lens whose lines are nearest to the edges. `reach`: from how far an edge does not count, in
 * units of the picture's width; `usual`: the focal length that is likely.
 */
export function fitLens(
  start: Lens,
  edges: readonly Edge[],
  reach: number,
  usual: number,
): { lens: Lens; misfit: number } {
  const sigma = reach / 4;
  const residuals = (lens: Lens): number[] => [
    ...edges.map(({ point, seen, across }) => {
      const [u, v] = project(lens, point(lens.rail));
      return ((u - seen[0]) * across[0] + (v - seen[1]) * across[1]) / sigma;
    }),
    Math.log(lens.focal / usual) / SPREAD.focal,
    (lens.bow - BOW) / SPREAD.bow,
    (lens.rail - RAIL) / SPREAD.rail,
  ];
  const weightOf = (residual: number, k: number): number =>
    k < edges.length ? Math.max(1 - (residual / 4) ** 2, 0) ** 2 : 1;
  const costOf = (values: readonly number[]): number =>
    values.reduce((total, x, k) => {
      const left = k < edges.length ? 1 - Math.max(1 - (x / 4) ** 2, 0) ** 3 : (x * x * 3) / 16;
      return total + left;
    }, 0);
  let lens = start;
  let damping = 1e-3;
  let present = residuals(lens);
  for (let round = 0; round < ROUNDS; round++) {
    const step = 1e-6;
    const slopes = Array.from({ length: 9 }, (_, k) => {
      const moved = residuals(
        changed(
          lens,
          Array.from({ length: 9 }, (_, j) => (j === k ? step : 0)),
        ),
      );
      return moved.map((x, i) => (x - present[i]!) / step);
    });
    const weights = present.map(weightOf);
    const product = (a: readonly number[], b: readonly number[]): number =>
      a.reduce((total, x, i) => total + weights[i]! * x * b[i]!, 0);
    const rows = slopes.map((slope, k) => [
      ...slopes.map((second, j) => product(slope, second) * (j === k ? 1 + damping : 1)),
      -product(slope, present),
    ]);
    const change = solve(rows);
    if (!change) break;
    const next = changed(lens, change);
    const later = residuals(next);
    const isBetter = costOf(later) < costOf(present);
    damping *= isBetter ? 0.2 : 10;
    if (isBetter) [lens, present] = [next, later];
  }
  const good = present.slice(0, edges.length).filter((x) => Math.abs(x) < 4);
  const misfit = sigma * Math.sqrt(good.reduce((total, x) => total + x * x, 0) / good.length);
  return { lens, misfit };
}
