// A ball seen from above: its colour, its stripe, number or dots as it is turned, and the light on
// it.
import { disc } from "./table.js";
import { IVORY, lookOf, POOL } from "./words.js";

/** @import { Point, Pose } from "./words.js" */
/** @import { View } from "./table.js" */

/**
 * Radii of what is drawn on a ball, as angles seen from its middle: a white end of a striped ball,
 * a number, a dot.
 */
const END = 0.9;
const NUMBER = 0.52;
const DOT = 0.2;
/** As deep in a pocket a ball is hardly seen, m. */
const DARK = 0.08;

/**
 * A pixel beside another one, by a way on the table. @param {View} view @param {Point} centre @param
 * {number} x @param {number} y @returns {[number, number]}
 */
const onCanvas = (view, [px, py], x, y) => (view.upright ? [px + x, py - y] : [px + y, py + x]);

/**
 * A cap of a ball, around a direction on it, as it is seen from above. The part beyond the rim lies
 * on the rim.
 * @param {CanvasRenderingContext2D} g @param {View} view @param {Point} centre on the canvas @param
 *   {number} radius pixels
 * @param {readonly number[]} n towards the cap's middle @param {number} angle @param {string} fill
 */
function cap(g, view, centre, radius, n, angle, fill) {
  const flat = Math.hypot(n[0], n[1]);
  if (n[2] <= 0 && flat <= Math.cos(angle)) return;
  const [ux, uy] = flat > 1e-9 ? [n[0] / flat, n[1] / flat] : [1, 0];
  g.beginPath();
  for (let k = 0; k < 28; k++) {
    const c = Math.sin(angle) * Math.cos((k * Math.PI) / 14);
    const s = Math.sin(angle) * Math.sin((k * Math.PI) / 14);
    // On the ball: the middle, and two directions across it, one of them level.
    const along = flat * Math.cos(angle) - n[2] * c;
    const x = ux * along - uy * s;
    const y = uy * along + ux * s;
    const z = n[2] * Math.cos(angle) + flat * c;
    const rim = z < 0 ? Math.hypot(x, y) : 1;
    g[k === 0 ? "moveTo" : "lineTo"](
      ...onCanvas(view, centre, (radius * x) / rim, (radius * y) / rim),
    );
  }
  g.fillStyle = fill;
  g.fill();
}

/**
 * The axes of a ball that has turned, by columns. @param {ArrayLike<number>} q @returns {[number,
 * number, number][]}
 */
function axesOf({ 0: w, 1: i, 2: j, 3: n }) {
  return [
    [1 - 2 * (j * j + n * n), 2 * (i * j + w * n), 2 * (i * n - w * j)],
    [2 * (i * j - w * n), 1 - 2 * (i * i + n * n), 2 * (j * n + w * i)],
    [2 * (i * n + w * j), 2 * (j * n - w * i), 1 - 2 * (i * i + j * j)],
  ];
}

/**
 * The number lies on the ball: its right and its lower side are axes of the ball, as they are seen.
 * @param {CanvasRenderingContext2D} g @param {View} view @param {Point} centre @param {number} radius
 *   @param {string} name
 * @param {readonly number[]} up @param {readonly number[]} right @param {readonly number[]} down */
function drawNumber(g, view, centre, radius, name, up, right, down) {
  g.save();
  g.translate(...onCanvas(view, centre, radius * up[0], radius * up[1]));
  g.transform(
    ...onCanvas(view, [0, 0], right[0], right[1]),
    ...onCanvas(view, [0, 0], down[0], down[1]),
    0,
    0,
  );
  g.fillStyle = "#16181b";
  g.font = `bold ${Math.round(radius * (Number(name) > 9 ? 0.7 : 0.85))}px sans-serif`;
  g.textAlign = "center";
  g.textBaseline = "middle";
  g.fillText(name, 0, 0.5);
  g.restore();
}

/** @type {HTMLCanvasElement | undefined} */
let light;
/** A highlight and a darker rim, for any ball: the light of a lamp above the table. */
function lightOf() {
  if (light) return light;
  light = document.createElement("canvas");
  light.width = 128;
  light.height = 128;
  const g = /** @type {CanvasRenderingContext2D} */ (light.getContext("2d"));
  const rim = g.createRadialGradient(58, 56, 40, 64, 64, 64);
  rim.addColorStop(0, "#0000");
  rim.addColorStop(1, "#0004");
  const spot = g.createRadialGradient(46, 42, 2, 46, 42, 20);
  spot.addColorStop(0, "#fff8");
  spot.addColorStop(1, "#fff0");
  for (const fill of [rim, spot]) {
    g.fillStyle = fill;
    g.beginPath();
    g.arc(64, 64, 64, 0, 7);
    g.fill();
  }
  return light;
}

/**
 * Draws ball k. @param {CanvasRenderingContext2D} g @param {View} view @param {{ name: string,
 * radius: number }} ball @param {number} k @param {Pose} pose
 * @param {number} alpha @param {string} [ring] */
export function drawBall(g, view, { name, radius: R }, k, { r, q }, alpha, ring) {
  const centre = view.place(r[0], r[1]);
  // One that flies looks larger, one that falls in a pocket smaller.
  const radius = Math.max(R * view.scale * (1 + (r[2] > R ? 1 : 3) * (r[2] - R)), 3);
  const { colour, path } = lookOf(name, k, R);
  const number = Number(name);
  const axes = axesOf(q);
  g.globalAlpha = alpha;
  // The shadow lies away from the lamp above the middle, farther off where the ball flies.
  g.fillStyle = "#0000003a";
  const fall = 0.14 * R + 0.6 * Math.max(r[2] - R, 0);
  disc(g, view, [r[0] + fall, r[1] - fall], 1.04 * radius);
  g.fillStyle = colour;
  disc(g, view, r, radius);
  for (const sign of [1, -1]) {
    const [x, y, z] = axes.map((axis) => axis.map((c) => sign * c));
    if (number > 8) cap(g, view, centre, radius, x, END, IVORY);
    if (!(number > 0))
      for (const axis of [x, y, z])
        cap(g, view, centre, radius, axis, DOT, colour === IVORY ? POOL[2] : "#ffffff90");
    else {
      cap(g, view, centre, radius, z, NUMBER, IVORY);
      if (z[2] < 0.2 || radius < 6) continue;
      if (view.upright)
        drawNumber(
          g,
          view,
          centre,
          radius,
          name,
          z,
          x,
          axes[1].map((c) => -c),
        );
      else drawNumber(g, view, centre, radius, name, z, y, axes[0]);
    }
  }
  // Down in a pocket there is no light.
  if (r[2] < 0) {
    g.fillStyle = `rgb(0 0 0 / ${Math.min(-r[2] / DARK, 0.9)})`;
    disc(g, view, r, radius);
  }
  // The light, and the rim, which is bright enough for a dark ball to be seen on the cloth.
  if (radius >= 5)
    g.drawImage(lightOf(), centre[0] - radius, centre[1] - radius, 2 * radius, 2 * radius);
  for (const [colour, beyond] of /** @type {[string, number][]} */ (
    ring
      ? [
          [path, 0],
          [ring, 1.5],
        ]
      : [[path, 0]]
  )) {
    g.strokeStyle = colour;
    g.lineWidth = beyond || 1;
    g.beginPath();
    g.arc(...centre, radius + beyond, 0, 7);
    g.stroke();
  }
  g.globalAlpha = 1;
}
