// Bodies of the scene from points of the plane: prisms with rounded edges, strips between lines,
// and the textures and colours on them. Lengths are in m, z points upwards from the cloth.
import * as THREE from "three";

export type Point = readonly [number, number];
/** A point with its height. */
export type Place = readonly [number, number, number];

export const distance = (a: Point, b: Point): number => Math.hypot(a[0] - b[0], a[1] - b[1]);
export const angleFrom = (centre: Point, point: Point): number =>
  Math.atan2(point[1] - centre[1], point[0] - centre[0]);
export const onCircle = (centre: Point, radius: number, angle: number): Point => [
  centre[0] + radius * Math.cos(angle),
  centre[1] + radius * Math.sin(angle),
];
/** Points of an arc, in so many steps. */
export const arcAround = (
  centre: Point,
  radius: number,
  start: number,
  sweep: number,
  steps: number,
): Point[] =>
  Array.from({ length: steps + 1 }, (_, k) =>
    onCircle(centre, radius, start + (sweep * k) / steps),
  );
/** An angle as it is nearest to 0, radians. */
export const turned = (angle: number): number => Math.atan2(Math.sin(angle), Math.cos(angle));
/** A number no smaller and no larger than two others. */
export const clamp = (x: number, low: number, high: number): number =>
  Math.min(Math.max(x, low), high);

/** Merges parts of one material into one mesh, because each mesh adds to the time of a frame. */
export function joined(geometries: THREE.BufferGeometry[], material: THREE.Material): THREE.Mesh {
  const parts = geometries.map((geometry) => (geometry.index ? geometry.toNonIndexed() : geometry));
  const geometry = new THREE.BufferGeometry();
  for (const [name, size] of Object.entries({ position: 3, normal: 3, uv: 2, color: 4 })) {
    if (!parts.every((part) => part.hasAttribute(name))) continue;
    const values = parts.flatMap((part) => [...part.getAttribute(name)!.array]);
    geometry.setAttribute(name, new THREE.Float32BufferAttribute(values, size));
  }
  return new THREE.Mesh(geometry, material);
}
const vectors = (points: readonly Point[]): THREE.Vector2[] =>
  points.map(([x, y]) => new THREE.Vector2(x, y));
/** A polygon of the plane with holes. */
export function shapeOf(points: readonly Point[], holes: readonly Point[][] = []): THREE.Shape {
  const shape = new THREE.Shape(vectors(points));
  shape.holes.push(...holes.map((hole) => new THREE.Path(vectors(hole))));
  return shape;
}
/** A polygon as a body between two heights, whose edges are rounded by a radius. */
export function bodyOf(
  points: readonly Point[],
  low: number,
  high: number,
  round = 0,
): THREE.BufferGeometry {
  const body = new THREE.ExtrudeGeometry(shapeOf(points), {
    depth: high - low - 2 * round,
    bevelEnabled: round > 0,
    bevelThickness: round,
    bevelSize: round,
    bevelOffset: -round,
    bevelSegments: 3,
  });
  return body.translate(0, 0, low + round);
}
export const box = (
  x: number,
  y: number,
  width: number,
  length: number,
  low: number,
  high: number,
): THREE.BufferGeometry =>
  new THREE.BoxGeometry(width, length, high - low).translate(x, y, (low + high) / 2);
/** A section of a ring around a point, as a body. */
export function ringBody(
  centre: Point,
  [inner, outer]: readonly [number, number],
  [start, sweep]: readonly [number, number],
  [low, high]: readonly [number, number],
  round: number,
): THREE.BufferGeometry {
  const outline = [
    ...arcAround(centre, inner, start, sweep, 28),
    ...arcAround(centre, outer, start + sweep, -sweep, 28),
  ];
  return bodyOf(outline, low, high, round);
}
/** A strip between lines of equally many points, with normals that are smooth across it. */
export function stripOf(rows: readonly (readonly Place[])[]): THREE.BufferGeometry {
  const count = rows[0]!.length;
  const index: number[] = [];
  for (let row = 0; row + 1 < rows.length; row++)
    for (let k = 0; k + 1 < count; k++) {
      const a = row * count + k;
      const b = a + count;
      index.push(a, b, a + 1, a + 1, b, b + 1);
    }
  const strip = new THREE.BufferGeometry();
  const places = rows.flatMap((row) => row.flatMap((place) => [...place]));
  strip.setAttribute("position", new THREE.Float32BufferAttribute(places, 3));
  strip.setIndex(index);
  strip.computeVertexNormals();
  return strip.toNonIndexed();
}
/** Sets a colour (red, green, blue, opacity) at each point of a body, by its position. */
export function painted(
  body: THREE.BufferGeometry,
  colourAt: (place: Place) => readonly number[],
): THREE.BufferGeometry {
  const places = body.getAttribute("position");
  const colours: number[] = [];
  for (let k = 0; k < places.count; k++)
    colours.push(...colourAt([places.getX(k), places.getY(k), places.getZ(k)]));
  body.setAttribute("color", new THREE.Float32BufferAttribute(colours, 4));
  return body;
}
/**
 * Lays a picture on a body by its places: its width along x or y takes so many m, and its height so
 * many across. On a side that stands, its height goes up.
 */
export function laid(
  body: THREE.BufferGeometry,
  along: "x" | "y",
  [long, wide]: readonly [number, number],
  shift = 0,
): THREE.BufferGeometry {
  const flat = body.index ? body.toNonIndexed() : body;
  const places = flat.getAttribute("position");
  const normals = flat.getAttribute("normal");
  const uv = new Float32Array(2 * places.count);
  for (let k = 0; k < places.count; k++) {
    const x = places.getX(k);
    const y = places.getY(k);
    const isSide = Math.abs(normals.getZ(k)) < 0.5;
    const across = along === "x" ? y : x;
    const u = along === "x" ? x : y;
    const v = isSide ? places.getZ(k) : across;
    uv.set([u / long + shift, v / wide + shift], 2 * k);
  }
  flat.setAttribute("uv", new THREE.BufferAttribute(uv, 2));
  return flat;
}
