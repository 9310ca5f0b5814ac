// Names of a film: the colour of a ball, a pocket, and an event in words. What a film is made of
// stands here for all modules of the player, which the page imports, and which the command writes
// one behind the other into the pages of `carom shoot --animate`: no two of them have one name for
// two things.
import { PALETTE } from "./palette.js";

/** @typedef {readonly [number, number]} Point */
/**
 * @typedef {{ width: number, length: number, rails: { p: Point, q: Point, height?: number }[],
 * jaws: { centre: Point, radius: number }[],
 *   pockets: { centre: Point, radius: number }[] }} Table */
/**
 * Where a ball is, m, and how it has turned: a unit quaternion w, x, y, z. It is not seen where it
 * lies in a pocket or on the floor.
 * @typedef {{ r: readonly number[], q: ArrayLike<number>, seen: boolean }} Pose */
/**
 * A shot: its poses at a time, s; x, y, z of the balls that move, point after point; what happens
 * when.
 * @typedef {{ time: number, poses(time: number): Pose[], paths: { ball: number, xyz: ArrayLike<number>
 *   }[], events: { time: number, text: string }[] }} Shot
 */
/**
 * Shots that are apart have a colour each: of trails, dashed but for the cue ball, and around
 * balls.
 */
/**
 * @typedef {{ table: Table, balls: { name: string, radius: number }[], shots: Shot[], apart?:
 * boolean }} Film
 */
/** @typedef {{ over?(g: CanvasRenderingContext2D): void, ended?(): void, moved?(): void,
 *   still?(): boolean, hidden?(): boolean, sharp?: number, backdrop?(view: FlatView): boolean }} Hooks */
/**
 * Where a table is seen from above: pixels of a place, pixels for each m, and whether it stands.
 * @typedef {{ place(x: number, y: number): [number, number], scale: number, upright: boolean }} FlatView
 */

/**
 * The product of two rotations, w, x, y, z: first b, then a. @param {ArrayLike<number>} a @param
 * {ArrayLike<number>} b
 * @returns {[number, number, number, number]} */
export const product = ({ 0: w, 1: i, 2: j, 3: n }, { 0: c, 1: x, 2: y, 3: z }) => [
  w * c - i * x - j * y - n * z,
  w * x + i * c + j * z - n * y,
  w * y - i * z + j * c + n * x,
  w * z + i * y - j * x + n * c,
];

/** @typedef {{ name: string, colour: string, path: string }} Look */
/** The cue ball, and then 1 to 8. @type {readonly Look[]} */
const NUMBERED = PALETTE.balls.slice(0, 9);
export const IVORY = NUMBERED[0].colour;
export const POOL = NUMBERED.slice(1).map(({ colour }) => colour);
/** @type {Record<string, Look>} */
const NAMED = Object.fromEntries(PALETTE.balls.map((ball) => [ball.name, ball]));
NAMED.cue = NAMED.white;

/** Balls of this radius, m, and larger are those of pyramid: white ones and a yellow cue ball. */
const PYRAMID = 0.0335;

/**
 * The colours of a ball and of its path, by its name, and of pyramid's balls by their radius, m.
 * @param {string} name @param {number} k @param {number} radius
 */
export function lookOf(name, k, radius) {
  if (radius >= PYRAMID) return k === 0 ? NAMED.yellow : NAMED.white;
  const number = Number(name) || k;
  return NAMED[name.split(" ")[0]] ?? NUMBERED[number > 0 ? 1 + ((number - 1) % 8) : 0];
}
/** The colour of a ball. @param {string} name @param {number} k @param {number} radius */
export const colourOf = (name, k, radius) => lookOf(name, k, radius).colour;
/** The colour of shot k of several that are over each other. @param {number} k */
export const colourOfShot = (k) => NUMBERED[k % 8].path;

/**
 * Where a pocket of a rectangle is for a player at the head, as carom_pocket_name() says:
 * "foot-left pocket". @param {Table} table @param {number} pocket
 */
export function pocketName({ width, length, pockets }, pocket) {
  const [x, y] = pockets[pocket].centre;
  const end = y < 0.3 * length ? "head" : "foot";
  const isSide = y >= 0.3 * length && y < 0.7 * length;
  return `${isSide ? "side" : end}-${x > width / 2 ? "right" : "left"} pocket`;
}

/**
 * Words of another language by the English ones: the page fills it, the pages of the command leave it
 * empty. @type {Record<string, string>}
 */
export const DICTIONARY = {};
/** A text in the reader's language; an unknown one stays English. @param {string} word */
export const translate = (word) =>
  DICTIONARY[word] ?? word.replace(/^\w+(?= \d)/, (colour) => DICTIONARY[colour] ?? colour);

/** @type {Record<string, string>} */
const EVENTS = {
  ball_linear_cushion: "cushion",
  ball_circular_cushion: "jaw of a pocket",
  sliding_rolling: "begins to roll",
  rolling_spinning: "spins on the spot",
  rolling_stationary: "stops",
  spinning_stationary: "stops spinning",
  slate: "lands",
  rail_top: "falls on a rail",
  left_table: "leaves the table",
};
/**
 * An event in words. @param {Table} table @param {readonly string[]} names @param {string} type
 * @param {number} a @param {number} b
 */
export function wordsOf(table, names, type, a, b) {
  if (type === "stick_ball") return translate("the cue strikes");
  if (type === "ball_ball")
    return `${translate(names[a])} ${translate("hits")} ${translate(names[b])}`;
  return `${translate(names[a])}: ${translate(type === "ball_pocket" ? pocketName(table, b) : (EVENTS[type] ?? type))}`;
}
