// Draws the frames of a film, with trails and balls at a time, and reads the film of a page that
// the command wrote.
import { drawBall } from "./ball.js";
import { line } from "./table.js";
import { colourOfShot, IVORY, lookOf, product, wordsOf } from "./words.js";

/** @import { Film, Point, Table } from "./words.js" */
/** @import { View } from "./table.js" */

/**
 * The trails, up to the pocket that a ball falls into. @param {Film} film
 */
export const trailsOf = ({ balls, shots, apart = false }) =>
  shots.flatMap(({ paths }, index) =>
    paths.map(({ ball, xyz }) => {
      const { colour, path } = lookOf(balls[ball].name, ball, balls[ball].radius);
      /** @type {Point[]} */
      const points = [];
      for (let k = 0; k < xyz.length; k += 3) {
        points.push([xyz[k], xyz[k + 1]]);
        if (xyz[k + 2] < 0 && xyz[k + 2] === xyz[xyz.length - 1]) break; // where it lies
      }
      return {
        points,
        colour: apart ? colourOfShot(index) : path,
        width: 1.6,
        isDashed: apart && colour !== IVORY,
      };
    }),
  );
/** @param {CanvasRenderingContext2D} g @param {View} view @param {Film} film */
export function drawTrails(g, view, film) {
  g.lineJoin = "round";
  g.lineCap = "round";
  for (const { points, colour, width, isDashed } of trailsOf(film)) {
    g.strokeStyle = colour;
    g.lineWidth = width;
    g.setLineDash(isDashed ? [7, 4] : []);
    line(g, view, points);
  }
  g.setLineDash([]);
}

/** The balls at a time. Shots over each other: the first is plain, the others are seen through.
 * @param {CanvasRenderingContext2D} g @param {View} view @param {Film} film @param {number} time */
export function drawBalls(g, view, { balls, shots, apart = false }, time) {
  shots.forEach((shot, index) => {
    shot
      .poses(Math.min(time, shot.time))
      .forEach(
        (pose, k) =>
          pose.seen &&
          drawBall(
            g,
            view,
            balls[k],
            k,
            pose,
            index === 0 || apart ? 1 : 0.6,
            apart ? colourOfShot(index) : undefined,
          ),
      );
  });
}

/**
 * The film of a page that `carom shoot --animate` wrote. Of each ball it has 10 numbers at each
 * time: its place, how it has turned, its spin, rad/s; of one that lies still, once.
 * @param {{ table: Table, balls: [string, number][], shots: { times: number[], poses: number[][],
 *   events: [number, string, number, number][] }[] }} page
 * @returns {Film} */
export function recorded({ table, balls, shots }) {
  const names = balls.map(([name]) => name);
  const filmed = shots.map(({ times, poses, events }, index) => ({
    time: times[times.length - 1],
    /** @param {number} time */
    poses(time) {
      const k = times.findLastIndex((t) => t <= time);
      const elapsed = time - times[k];
      return poses.map((pose) => {
        const moves = pose.length > 10;
        const [start, end] = moves ? [10 * k, 10 * Math.min(k + 1, times.length - 1)] : [0, 0];
        const share = end > start ? elapsed / (times[k + 1] - times[k]) : 0;
        const r = [0, 1, 2].map((c) => pose[start + c] + share * (pose[end + c] - pose[start + c]));
        // It turns on by its spin.
        const spin = pose.slice(start + 7, start + 10);
        const rate = Math.hypot(...spin);
        const c = Math.cos((rate * elapsed) / 2);
        const s = rate > 0 ? Math.sin((rate * elapsed) / 2) / rate : 0;
        const q = product([c, ...spin.map((part) => part * s)], pose.slice(start + 3, start + 7));
        return { r, q, seen: pose[start + 2] >= 0 && (moves || index === 0) };
      });
    },
    paths: poses.flatMap((pose, ball) =>
      pose.length > 10 ? [{ ball, xyz: pose.filter((_, k) => k % 10 < 3) }] : [],
    ),
    events: events.map(([time, type, a, b]) => ({ time, text: wordsOf(table, names, type, a, b) })),
  }));
  return {
    table,
    balls: balls.map(([name, radius]) => ({ name, radius })),
    shots: filmed,
    apart: filmed.length > 1,
  };
}
