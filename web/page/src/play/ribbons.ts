// Lines on the cloth of the scene: the aim, paths of balls, rings around what is called. They form
// one mesh of ribbons that glow towards their edges, below the balls.
import * as THREE from "three";
import type { Line } from "../table/drawing.js";
import { distance, type Point } from "./shapes.js";

/** How far off the middle of a ribbon, in half widths of its line, it is how dense. */
const PROFILE: readonly Point[] = [
  [-4, 0],
  [-1.1, 0.22],
  [-0.8, 1],
  [0.8, 1],
  [1.1, 0.22],
  [4, 0],
];
const ROWS = PROFILE.length;
/** Dashes and the gaps between them, m. */
const DASH = 0.024;
const GAP = 0.016;

/** The dashes of a line. */
function dashesOf(points: readonly Point[]): Point[][] {
  const dashes: Point[][] = [];
  let dash: Point[] = [];
  let run = 0;
  points.slice(1).forEach((end, k) => {
    const start = points[k]!;
    const long = distance(start, end);
    const pointAt = (way: number): Point => [
      start[0] + ((end[0] - start[0]) * way) / long,
      start[1] + ((end[1] - start[1]) * way) / long,
    ];
    let way = 0;
    while (way < long) {
      const phase = run % (DASH + GAP);
      const isDash = phase < DASH - 1e-9;
      const step = Math.min(isDash ? DASH - phase : DASH + GAP - phase, long - way) + 1e-9;
      if (isDash) {
        if (dash.length === 0) dash.push(pointAt(way));
        dash.push(pointAt(Math.min(way + step, long)));
      } else if (dash.length > 0) {
        dashes.push(dash);
        dash = [];
      }
      way += step;
      run += step;
    }
  });
  return dash.length > 1 ? [...dashes, dash] : dashes;
}
/** The way across a line at each of its points. */
export const acrossOf = (points: readonly Point[]): Point[] =>
  points.map((_, k) => {
    const a = points[Math.max(k - 1, 0)]!;
    const b = points[Math.min(k + 1, points.length - 1)]!;
    const long = distance(a, b) || 1;
    return [(a[1] - b[1]) / long, (b[0] - a[0]) / long];
  });

export class Ribbons {
  readonly mesh: THREE.Mesh;
  #drawn = "";

  constructor() {
    const material = new THREE.MeshBasicMaterial({
      vertexColors: true,
      transparent: true,
      depthWrite: false,
      toneMapped: false,
      side: THREE.DoubleSide,
    });
    this.mesh = new THREE.Mesh(new THREE.BufferGeometry(), material);
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = 3;
  }

  /** Lays lines on the cloth; a pixel of their width is so many m. */
  lay(lines: readonly Line[], pixel: number): void {
    const state = JSON.stringify([lines, pixel]);
    if (state === this.#drawn) return;
    this.#drawn = state;
    const places: number[] = [];
    const colours: number[] = [];
    const index: number[] = [];
    for (const line of lines) {
      const { r, g, b } = new THREE.Color(line.colour);
      const points = line.points.map(([x, y]): Point => [x!, y!]);
      for (const part of line.isDashed ? dashesOf(points) : [points]) {
        const first = places.length / 3;
        const across = acrossOf(part);
        part.forEach(([x, y], k) => {
          const [u, v] = across[k]!;
          for (const [side, opacity] of PROFILE) {
            const far = (side * line.width * pixel) / 2;
            places.push(x + far * u, y + far * v, line.height ?? 0.0022);
            colours.push(r, g, b, opacity);
          }
        });
        for (let k = 0; k + 1 < part.length; k++)
          for (let row = 0; row + 1 < ROWS; row++) {
            const a = first + k * ROWS + row;
            index.push(a, a + ROWS, a + 1, a + 1, a + ROWS, a + ROWS + 1);
          }
      }
    }
    this.mesh.geometry.dispose();
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.Float32BufferAttribute(places, 3));
    geometry.setAttribute("color", new THREE.Float32BufferAttribute(colours, 4));
    geometry.setIndex(index);
    this.mesh.geometry = geometry;
    this.mesh.visible = index.length > 0;
  }
}
