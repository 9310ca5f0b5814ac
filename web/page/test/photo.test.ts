// Places of balls from a photo, beside cameras that are known: pinhole pictures of the table, with corners and balls marked to a pixel.
import { expect, test } from "vitest";
import { cameraOf, type Pixel, suggest } from "../src/play/photo.js";
import { pinhole as camera } from "./camera.js";
import { Draws } from "../../test/support.js";

const [W, L, NOSE, R] = [1.27, 2.54, 0.0366, 0.028575];
const SIZE: Pixel = [4032, 3024];

const pinhole = (from: number[], to: number[], focal: number): ReturnType<typeof camera> => camera(SIZE, from, to, focal);
const corners = (see: ReturnType<typeof pinhole>): Pixel[] => [see(0, 0, NOSE), see(W, 0, NOSE), see(W, L, NOSE), see(0, L, NOSE)];

test.each([
  ["from the head, standing", [0.5, -1.0, 1.3], [0.635, 1.1, 0], 3000],
  ["from a corner", [2.1, -0.7, 1.4], [0.6, 1.2, 0], 2800],
  ["from the side, a tele lens", [3.6, 1.6, 2.2], [0.6, 1.25, 0], 5200],
  ["from the foot", [0.7, 3.5, 1.5], [0.6, 1.2, 0], 3100],
] as const)("balls are within 1 cm with marks that are off by a pixel: %s", (_, from, to, focal) => {
  const see = pinhole([...from], [...to], focal);
  const draws = new Draws(7n);
  const off = ([u, v]: Pixel): Pixel => [u + draws.between(-1, 1), v + draws.between(-1, 1)];
  let worst = 0;
  for (let picture = 0; picture < 20; picture++) {
    const camera = cameraOf(SIZE, corners(see).map(off), [W, L], NOSE - R);
    for (let k = 0; k < 16; k++) {
      const [x, y] = [draws.between(R, W - R), draws.between(R, L - R)];
      const [px, py] = camera.place(off(see(x, y, R)));
      worst = Math.max(worst, Math.hypot(px - x, py - y));
    }
  }
  console.log(`places from a photo: off by at most ${(1000 * worst).toFixed(1)} mm`);
  expect(worst).toBeLessThan(0.01);
});

test("exact marks give the focal length, and places to a tenth of a millimetre; the height of balls counts", () => {
  const see = pinhole([0.5, -1.0, 1.3], [0.635, 1.1, 0], 3000);
  const camera = cameraOf(SIZE, corners(see), [W, L], NOSE - R);
  expect(camera.focal).toBeCloseTo(3000, 3);
  const flat = cameraOf(SIZE, corners(see), [W, L], 0);
  let [worst, without] = [0, 0];
  for (const [x, y] of [[0.1, 0.2], [1.2, 0.4], [0.6, 1.3], [0.05, 2.4], [1.2, 2.5]] as const) {
    const [[px, py], [fx, fy]] = [camera.place(see(x, y, R)), flat.place(see(x, y, R))];
    worst = Math.max(worst, Math.hypot(px - x, py - y));
    without = Math.max(without, Math.hypot(fx - x, fy - y));
    const [u, v] = camera.pixel([x, y]);
    expect(Math.hypot(u - see(x, y, R)[0], v - see(x, y, R)[1])).toBeLessThan(0.01);
  }
  expect(worst).toBeLessThan(1e-4);
  expect(without).toBeGreaterThan(0.01);
});

test("from right above the focal length stays unknown, and places are within 1 cm", () => {
  const see = pinhole([0.635, 1.27, 3], [0.635, 1.27, 0], 3000);
  const camera = cameraOf(SIZE, corners(see), [W, L], NOSE - R);
  const [x, y] = camera.place(see(1.2, 2.4, R));
  expect(Math.hypot(x - 1.2, y - 2.4)).toBeLessThan(0.01);
});

test("corners that are no table are refused", () => {
  const see = pinhole([0.5, -1.0, 1.3], [0.635, 1.1, 0], 3000);
  const [a, b, c, d] = corners(see) as [Pixel, Pixel, Pixel, Pixel];
  for (const bad of [[a, d, c, b], [a, c, b, d], [a, b, b, d]]) expect(() => cameraOf(SIZE, bad, [W, L])).toThrow("corners: ");
});

test("a patch suggests its ball", () => {
  const colours = ["#e3b505", "#1446a0", "#c8102e", "#5b2a86", "#e8702a", "#12664f", "#7a1f2b", "#16181b"];
  const patch = (white: number, hex: string, light: number): number[] =>
    Array.from({ length: 100 }, (_, k) => (k < 100 * white ? [235, 232, 225, 255] : [...[1, 3, 5].map((c) => parseInt(hex.slice(c, c + 2), 16) * light), 255])).flat();
  for (const light of [0.8, 1, 1.15]) {
    expect(suggest(patch(0.95, colours[0]!, light), colours)).toBe(0);
    colours.forEach((hex, k) => {
      expect(suggest(patch(0.1, hex, light), colours)).toBe(k + 1);
      if (k < 7) expect(suggest(patch(0.5, hex, light), colours)).toBe(k + 9);
    });
  }
});
