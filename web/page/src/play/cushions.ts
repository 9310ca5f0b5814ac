// Cushions: rubber under cloth, with a nose, a top that rises to the wood and a face that recedes
// below it, mitred at the angles of the facings; and how wood and pockets meet them. Lengths in m.
import * as THREE from "three";
import { arcOf, CUSHION, FACING } from "../../../player/table.js";
import type { Table } from "../../../player/words.js";
import {
  angleFrom,
  clamp,
  distance,
  laid,
  painted,
  type Place,
  type Point,
  shapeOf,
  stripOf,
} from "./shapes.js";

export type Pocket = Table["pockets"][number];
/** The height of the wood where a cushion ends; noses are lower. */
export const TOP = 0.045;
const NOSE = 0.0405;
/** Where the profile of a cushion turns: behind the nose, and below the top. Its last is the bed. */
const PROFILE: readonly Point[] = [
  [0.0052, 0],
  [0.0024, 0.0006],
  [0.0006, 0.0024],
  [0, 0.0046],
  [0.0007, 0.0072],
  [0.0105, 0.026],
  [0.013, Infinity],
];
/** How much cloth a texture of its weave covers. */
export const CLOTH_PICTURE: Point = [0.09, 0.09];

/** One end of a cushion: its edge from the nose into the pocket, that pocket, and its wood. */
export interface End {
  edge: Point[];
  pocket: Pocket | undefined;
  /** Where the wood behind the cushion meets the pocket. */
  wood: Point;
  nose: Point;
  /** From the other end of the nose to this one. */
  tangent: Point;
}
/** A long cushion: the ends of its nose, the way outwards, and its edges at both ends. */
export interface Cushion {
  p: Point;
  q: Point;
  outward: Point;
  ends: [End, End];
}

/** The edge of a cushion into a pocket: its jaw, if it has one, and the facing after it. */
function edgeFrom(table: Table, nose: Point): Point[] {
  const edge: Point[] = [];
  let tip = nose;
  const jaw = table.jaws
    .map((jaw) => arcOf(table, jaw))
    .find((arc) => arc.some((point) => distance(point, tip) < 1e-3));
  if (jaw) {
    edge.push(...(distance(jaw[0]!, tip) < 1e-3 ? jaw : [...jaw].reverse()));
    tip = edge.at(-1)!;
  }
  for (const { p, q } of table.rails) {
    if (distance(p, q) > FACING || Math.min(distance(p, tip), distance(q, tip)) > 1e-3) continue;
    edge.push(distance(p, tip) < 1e-3 ? q : p);
  }
  return edge;
}
const depthOf = (nose: Point, point: Point, outward: Point): number =>
  (point[0] - nose[0]) * outward[0] + (point[1] - nose[1]) * outward[1];
/** An edge as far as the back of its cushion: behind that is wood. */
function clipped(nose: Point, edge: readonly Point[], outward: Point): Point[] {
  const clip: Point[] = [];
  let previous = nose;
  for (const point of edge) {
    const low = depthOf(nose, previous, outward);
    const high = depthOf(nose, point, outward);
    if (high > CUSHION) {
      const share = (CUSHION - low) / (high - low);
      clip.push([
        previous[0] + share * (point[0] - previous[0]),
        previous[1] + share * (point[1] - previous[1]),
      ]);
      break;
    }
    clip.push(point);
    previous = point;
  }
  return clip;
}
/** Wood begins below its cushion, so that its rounded edge is hidden there. */
const HIDDEN = 0.009;
const INNER = CUSHION - HIDDEN;
/** How far wood keeps off the middle of a pocket. */
export const woodAround = ({ radius }: Pocket): number => radius + 0.004;
/**
 * Where the back of a cushion, which runs along `tangent`, meets a circle around a pocket's middle.
 */
export function crossing(
  centre: Point,
  radius: number,
  nose: Point,
  outward: Point,
  tangent: Point,
): Point {
  const back: Point = [nose[0] + INNER * outward[0], nose[1] + INNER * outward[1]];
  const x = back[0] - centre[0];
  const y = back[1] - centre[1];
  const ahead = x * tangent[0] + y * tangent[1];
  const root = ahead ** 2 - (x ** 2 + y ** 2 - radius ** 2);
  const way = root > 0 ? -Math.sqrt(root) - ahead : 0;
  return [back[0] + way * tangent[0], back[1] + way * tangent[1]];
}
const onMitre = ([x, y]: Point, outward: Point, tangent: Point): Point => [
  x - HIDDEN * (outward[0] + tangent[0]),
  y - HIDDEN * (outward[1] + tangent[1]),
];
function endOf(table: Table, nose: Point, far: Point, outward: Point): End {
  const long = distance(nose, far);
  const tangent: Point = [(nose[0] - far[0]) / long, (nose[1] - far[1]) / long];
  const pocket = table.pockets.find(({ centre, radius }) => distance(centre, nose) < 3 * radius);
  const edge = clipped(nose, edgeFrom(table, nose), outward);
  const tip = edge.at(-1) ?? nose;
  // The cushion is as deep at its ends as along its back; without a pocket it is mitred.
  const more = CUSHION - depthOf(nose, tip, outward);
  if (more > 1e-3) {
    const slant = pocket ? 0 : CUSHION;
    edge.push([
      tip[0] + more * outward[0] + slant * tangent[0],
      tip[1] + more * outward[1] + slant * tangent[1],
    ]);
  }
  const wood = pocket
    ? crossing(pocket.centre, woodAround(pocket), nose, outward, tangent)
    : onMitre(edge.at(-1)!, outward, tangent);
  return { edge, pocket, wood, nose, tangent };
}
export function cushionsOf(table: Table): Cushion[] {
  const middle: Point = [table.width / 2, table.length / 2];
  return table.rails
    .filter(({ p, q }) => distance(p, q) > FACING)
    .map(({ p, q }) => {
      const long = distance(p, q);
      const normal: Point = [(q[1] - p[1]) / long, (p[0] - q[0]) / long];
      const inside = depthOf(p, middle, normal) > 0;
      const outward: Point = inside ? [-normal[0], -normal[1]] : normal;
      return { p, q, outward, ends: [endOf(table, p, q, outward), endOf(table, q, p, outward)] };
    });
}

/** The line of a cushion that faces the table, from one pocket over the nose to the other. */
const frontOf = ({ p, q, ends: [first, second] }: Cushion): Point[] => {
  const points = [...[...first.edge].reverse(), p, q, ...second.edge];
  return points.filter((point, k) => k === 0 || distance(point, points[k - 1]!) > 1e-4);
};
/** The line, so far behind the front of a cushion as the table sees it. */
function behind(front: readonly Point[], outward: Point, far: number): Point[] {
  const normals = front.slice(1).map((end, k): Point => {
    const start = front[k]!;
    const long = distance(start, end) || 1;
    return [(end[1] - start[1]) / long, (start[0] - end[0]) / long];
  });
  const nose = normals.reduce((best, normal, k) =>
    distance(front[k]!, front[k + 1]!) > FACING ? normal : best,
  );
  const sign = nose[0] * outward[0] + nose[1] * outward[1] < 0 ? -1 : 1;
  return front.map(([px, py], k): Point => {
    const a = normals[Math.max(k - 1, 0)]!;
    const b = normals[Math.min(k, normals.length - 1)]!;
    const x = a[0] + b[0];
    const y = a[1] + b[1];
    const long = Math.hypot(x, y) || 1;
    // A corner is as far away as its sides.
    const more = Math.min(1 / Math.max((a[0] * x + a[1] * y) / long, 0.5), 1.6);
    const way = (sign * far * more) / long;
    return [px + way * x, py + way * y];
  });
}
/** The rubber under the cloth; dark below the nose, where no light arrives. */
export function cushionBody(cushion: Cushion): THREE.BufferGeometry[] {
  const { p, outward } = cushion;
  const front = frontOf(cushion);
  const topAt = (point: Point): number =>
    NOSE + (TOP - NOSE) * clamp(depthOf(p, point, outward) / CUSHION, 0, 1);
  const rows = PROFILE.map(([far, drop]) =>
    behind(front, outward, far).map(([x, y], k): Place => {
      const top = topAt(drop === 0 ? [x, y] : front[k]!);
      return [x, y, Math.max(top - drop, 0)];
    }),
  );
  const upper = new THREE.ShapeGeometry(shapeOf(behind(front, outward, PROFILE[0]![0])));
  const top = upper.toNonIndexed();
  const places = top.getAttribute("position");
  for (let k = 0; k < places.count; k++) places.setZ(k, topAt([places.getX(k), places.getY(k)]));
  top.computeVertexNormals();
  const grey = (light: number): number[] => [light, light, light, 1];
  const dark = ([, , z]: Place): number[] => grey(clamp((z + 0.006) / 0.034, 0.25, 1.1));
  return [painted(top, () => grey(0.84)), painted(stripOf(rows), dark)].map((part) =>
    laid(part, "x", CLOTH_PICTURE),
  );
}
/** Darkness on the cloth along a cushion, whose nose keeps the light off. */
export function shadeOf(cushion: Cushion): THREE.BufferGeometry {
  const front = frontOf(cushion);
  const rows: readonly (readonly [number, number])[] = [
    [0.012, 0.7],
    [-0.002, 0.5],
    [-0.016, 0.18],
    [-0.05, 0],
  ];
  // The height holds the darkness of a row until the colours are made.
  const strip = stripOf(
    rows.map(([far, dark]) =>
      behind(front, cushion.outward, far).map(([x, y]): Place => [x, y, dark]),
    ),
  );
  painted(strip, ([, , dark]) => [0, 0, 0, dark]);
  const places = strip.getAttribute("position");
  for (let k = 0; k < places.count; k++) places.setZ(k, 0.0007);
  return strip;
}
/** The angle between a direction from a pocket's centre and the nearest cushions, radians. */
export function freeBeside(
  pocket: Pocket,
  radius: number,
  out: number,
  cushions: readonly Cushion[],
): number {
  const angles = cushions.flatMap(({ outward, ends }) =>
    ends
      .filter((end) => end.pocket === pocket)
      .map(({ nose, tangent }) => {
        const point = crossing(pocket.centre, radius, nose, outward, tangent);
        const angle = angleFrom(pocket.centre, point) - out;
        return Math.abs(Math.atan2(Math.sin(angle), Math.cos(angle)));
      }),
  );
  return Math.max(...angles);
}
