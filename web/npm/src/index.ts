/**
 * carom: collisions of two billiard balls, impacts on cushions, and complete shots, with the C
 * library of the same name as WebAssembly.
 *
 *     import { load } from "carom";
 *     const carom = await load();
 *     const table = carom.table("9ft");
 *     const shot = carom.simulate(table, carom.rack("nineball", table), { speed: 8 });
 *     console.log(shot.time, shot.firstContact?.ball, shot.positions(1.5));
 *
 * Units are SI; directions of a cue are in degrees. All results have the bits of the C library's
 * instruction set `plain`.
 * @packageDocumentation
 */
import { Carom } from "./carom.js";
import { KEYS, refuseUnknown } from "./keys.js";
import { type Build, simdAvailable, start } from "./memory.js";

export { Collisions, cueFields, cueSize, Shots } from "./batches.js";
export type { Carom } from "./carom.js";
export { CaromError } from "./error.js";
export { byNumber, fromLine, toLine } from "./lines.js";
export {
  type Bounds,
  Match,
  type Choice,
  choices,
  type Phase,
  type StrokeOptions,
} from "./match.js";
export type { Build } from "./memory.js";
export { palette } from "./palette.js";
export { type Replayed, type ShotEnd } from "./recording.js";
export { Shot } from "./shot.js";
export type * from "./types.js";
export { games } from "./generated/layout.js";
export { words } from "./generated/words.js";

/** Options of `load`. */
export interface LoadOptions {
  /**
   * The build to run; by default "simd" if the machine has 128-bit vectors, otherwise "plain". The
   * results have the same bits.
   */
  build?: Build;
}

/**
 * Compiles the WebAssembly module and returns the library. Each call returns a library with its own
 * memory.
 */
export async function load(options: LoadOptions = {}): Promise<Carom> {
  refuseUnknown(options, KEYS.build);
  const { build = simdAvailable() ? "simd" : "plain" } = options;
  return new Carom(await start(build), build);
}
