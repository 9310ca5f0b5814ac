// Places of balls from a photo, beside cameras that are known: pinhole pictures of the table, with
// corners and balls marked to a pixel.
import { expect, test } from "vitest";
import { cameraOf, type Pixel, radiusAt, suggest } from "../src/play/photo.js";
import { discOf, type Picture, snapCorners, snapDisc } from "../src/play/snap.js";
import { pinhole as camera } from "./camera.js";
import { Draws } from "../../test/support.js";

const W = 1.27;
const L = 2.54;
const NOSE = 0.0366;
const R = 0.028575;
const SIZE: Pixel = [4032, 3024];
const COLOURS = [
  "#e3b505",
  "#1446a0",
  "#c8102e",
  "#5b2a86",
  "#e8702a",
  "#12664f",
  "#7a1f2b",
  "#16181b",
];

const pinhole = (eye: number[], target: number[], focal: number) =>
  camera(SIZE, eye, target, focal);
const corners = (see: ReturnType<typeof pinhole>): Pixel[] => [
  see(0, 0, NOSE),
  see(W, 0, NOSE),
  see(W, L, NOSE),
  see(0, L, NOSE),
];

test.each([
  ["from the head, standing", [0.5, -1.0, 1.3], [0.635, 1.1, 0], 3000],
  ["from a corner", [2.1, -0.7, 1.4], [0.6, 1.2, 0], 2800],
  ["from the side, a tele lens", [3.6, 1.6, 2.2], [0.6, 1.25, 0], 5200],
  ["from the foot", [0.7, 3.5, 1.5], [0.6, 1.2, 0], 3100],
] as const)(
  "balls are within 1 cm with marks that are off by a pixel: %s",
  (_, eye, target, focal) => {
    const see = pinhole([...eye], [...target], focal);
    const draws = new Draws(7n);
    const off = ([u, v]: Pixel): Pixel => [u + draws.uniform(-1, 1), v + draws.uniform(-1, 1)];
    let worst = 0;
    for (let picture = 0; picture < 20; picture++) {
      const camera = cameraOf(SIZE, corners(see).map(off), [W, L], NOSE - R);
      for (let k = 0; k < 16; k++) {
        const x = draws.uniform(R, W - R);
        const y = draws.uniform(R, L - R);
        const [px, py] = camera.place(off(see(x, y, R)));
        worst = Math.max(worst, Math.hypot(px - x, py - y));
      }
    }
    console.log(`places from a photo: off by at most ${(1000 * worst).toFixed(1)} mm`);
    expect(worst).toBeLessThan(0.01);
  },
);

test("exact marks give the focal length, and places to a tenth of a millimetre; the height of balls counts", () => {
  const see = pinhole([0.5, -1.0, 1.3], [0.635, 1.1, 0], 3000);
  const camera = cameraOf(SIZE, corners(see), [W, L], NOSE - R);
  expect(camera.focal).toBeCloseTo(3000, 3);
  const flat = cameraOf(SIZE, corners(see), [W, L], 0);
  let worst = 0;
  let without = 0;
  for (const [x, y] of [
    [0.1, 0.2],
    [1.2, 0.4],
    [0.6, 1.3],
    [0.05, 2.4],
    [1.2, 2.5],
  ] as const) {
    const [px, py] = camera.place(see(x, y, R));
    const [fx, fy] = flat.place(see(x, y, R));
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
  for (const corners of [
    [a, d, c, b],
    [a, c, b, d],
    [a, b, b, d],
  ])
    expect(() => cameraOf(SIZE, corners, [W, L])).toThrow("corners: ");
});

test("a patch suggests its ball, or the balls that it may be", () => {
  const patch = (white: number, hex: string, light: number) =>
    Array.from({ length: 100 }, (_, k) =>
      k < 100 * white
        ? [235, 232, 225, 255]
        : [...[1, 3, 5].map((c) => parseInt(hex.slice(c, c + 2), 16) * light), 255],
    ).flat();
  for (const light of [0.8, 1, 1.15]) {
    expect(suggest(patch(0.95, COLOURS[0]!, light), COLOURS)).toEqual([0]);
    COLOURS.forEach((hex, k) => {
      expect(suggest(patch(0.1, hex, light), COLOURS)[0]).toBe(k + 1);
      if (k < 7) expect(suggest(patch(0.5, hex, light), COLOURS)[0]).toBe(k + 9);
    });
  }
  expect(suggest(patch(0.28, COLOURS[1]!, 1), COLOURS)).toEqual([2, 10]);
  // Red in shade is as dark as maroon, and a stripe may show the white of its end.
  expect(suggest(patch(0, "#7d1620", 1), COLOURS)).toEqual(expect.arrayContaining([3, 7]));
  expect(suggest(patch(0.88, COLOURS[3]!, 1), COLOURS)).toEqual(expect.arrayContaining([0, 12]));
});

/** The outline on the picture of a rectangle around the noses, at a height, m. */
function outline(see: ReturnType<typeof camera>, more: number, z: number): number[][] {
  const pixels = [see(-more, -more, z), see(W + more, -more, z), see(W + more, L + more, z)];
  const corners = [...pixels, see(-more, L + more, z)];
  return corners.map(([u, v], k) => [
    u,
    v,
    corners[(k + 1) % 4]![0] - u,
    corners[(k + 1) % 4]![1] - v,
  ]);
}
const isWithin = (edges: number[][], x: number, y: number) =>
  edges.every(([u, v, du, dv]) => du! * (y - v!) < dv! * (x - u!));

/**
 * A photo: wood, cloth, and balls with caps or number, in a light, with noise. With cushions: 5 cm
 * of the same cloth around the noses, and their faces down to the bed in shade.
 */
function photo(
  see: ReturnType<typeof camera>,
  [w, h]: Pixel,
  balls: readonly (readonly [number, number, number])[],
  light: readonly number[],
  draws: Draws,
  hasCushions = false,
): Picture {
  const data = new Uint8ClampedArray(4 * w * h);
  let state = draws.uniform(0, 2 ** 31) | 0;
  const rgb = (hex: string) => [1, 3, 5].map((c) => parseInt(hex.slice(c, c + 2), 16));
  const nose = outline(see, 0, NOSE);
  const back = outline(see, 0.05, NOSE);
  const bed = outline(see, 0, 0);
  const discs = balls.map(([ball, x, y]) => ({
    ball,
    pixel: see(x, y, R),
    r: Math.max(
      ...[see(x + R, y, R), see(x, y + R, R)].map(([u, v]) =>
        Math.hypot(u - see(x, y, R)[0], v - see(x, y, R)[1]),
      ),
    ),
  }));
  const wood = rgb("#5b3a24");
  const cloth = rgb("#1f6f5c");
  const white = rgb("#f4f2ea");
  const paint = (x: number, y: number, colour: number[]) => {
    state = Math.imul(state, 1664525) + 1013904223; // draws of 64 bits would take most of the time
    for (let c = 0; c < 4; c++)
      data[4 * (w * y + x) + c] = c === 3 ? 255 : colour[c]! * light[c]! + state / 2 ** 28;
  };
  const top = cloth.map((part) => 0.95 * part);
  const face = cloth.map((part) => 0.55 * part);
  function colourAt(x: number, y: number): number[] {
    if (!hasCushions) return isWithin(nose, x, y) ? cloth : wood;
    if (!isWithin(back, x, y)) return wood;
    if (!isWithin(nose, x, y)) return top;
    return isWithin(bed, x, y) ? cloth : face;
  }
  for (let y = 0; y < h; y++) for (let x = 0; x < w; x++) paint(x, y, colourAt(x, y));
  for (const {
    ball,
    pixel: [u, v],
    r,
  } of discs)
    for (let y = Math.ceil(v - r); y < v + r; y++)
      for (let x = Math.ceil(u - r); x < u + r; x++) {
        const a = (x - u) / r;
        const b = (y - v) / r;
        if (a * a + b * b < 1)
          paint(
            x,
            y,
            ball === 0 || (ball > 8 && Math.abs(b) > 0.45) || (ball < 9 && a * a + b * b < 0.08)
              ? white
              : rgb(COLOURS[(ball - 1) % 8]!),
          );
      }
  return { data, width: w, height: h };
}

/** Where phones are and what they look at, their focal length in pixels, and the light. */
const PHONES = [
  [[0.5, -1.0, 1.3], [0.635, 1.1, 0], 1200, [1, 1, 1]],
  [[0.5, -1.0, 1.5], [0.635, 1.1, 0], 1250, [0.7, 0.7, 0.7]],
  [[2.1, -0.7, 1.4], [0.6, 1.2, 0], 1100, [1.05, 1, 0.85]],
  [[3.6, 1.6, 2.2], [0.6, 1.25, 0], 1800, [1, 1, 1]],
  [[0.7, 3.5, 1.5], [0.6, 1.2, 0], 1200, [0.85, 0.95, 1]],
  [[-1.2, 1.3, 1.6], [0.6, 1.25, 0], 950, [1.1, 1.1, 1.1]],
  [[0.635, 1.27, 3], [0.635, 1.27, 0], 1000, [1, 0.95, 0.85]],
  [[2.4, 3.1, 1.8], [0.6, 1.2, 0], 1300, [0.6, 0.6, 0.6]],
  [[0.2, -1.4, 1.7], [0.635, 1.1, 0], 1500, [0.9, 0.85, 0.8]],
  [[2.9, 0.4, 1.5], [0.6, 1.2, 0], 1300, [1, 1, 0.95]],
] as const;

test.each(PHONES)(
  "a finger that errs by 2 pixels of a phone lays balls within 1 cm, and no ball gets a wrong number in silence: from %j",
  (eye, target, focal, light) => {
    const size: Pixel = [1600, 1200];
    const draws = new Draws(11n);
    const see = camera(size, [...eye], [...target], focal);
    expect(
      Math.max(...corners(see).flatMap(([u, v]) => [-u, u - size[0], -v, v - size[1]])),
    ).toBeLessThan(0);
    const balls = [0, 1, 2, 3, 4, 5, 8, 9, 13, 15].map(
      (ball, k) => [ball, 0.15 + 0.97 * ((k * 0.37) % 1), 0.2 + 0.22 * k] as const,
    );
    const picture = photo(see, size, balls, light, draws);
    const scale = size[0] / 344; // on a phone of 390 pixels
    const finger = ([u, v]: Pixel): Pixel => [
      u + scale * draws.uniform(-2, 2),
      v + scale * draws.uniform(-2, 2),
    ];
    const view = cameraOf(
      size,
      snapCorners(picture, corners(see).map(finger), 3.6 * scale, [W, L]),
      [W, L],
      NOSE - R,
    );
    let worst = 0;
    let questions = 0;
    for (const [ball, x, y] of balls) {
      const mark = finger(see(x, y, R));
      const radius = radiusAt(view, mark);
      const snapped = snapDisc(picture, mark, radius, 3 * scale);
      const [px, py] = view.place(snapped);
      worst = Math.max(worst, Math.hypot(px - x, py - y));
      const candidates = suggest(discOf(picture, snapped, radius), COLOURS);
      expect(
        candidates.length === 1 ? candidates : [...candidates, ball],
        `${ball}: ${candidates}`,
      ).toContain(ball);
      questions += Number(candidates.length > 1);
    }
    console.log(
      `a finger on a photo: off by at most ${(1000 * worst).toFixed(1)} mm, asked of ${questions} of ${balls.length}`,
    );
    expect(worst).toBeLessThan(0.01);
  },
);

test.each([0, 2, 5, 6].map((k) => PHONES[k]!))(
  "on a table with cushions no corner moves away from the nose, and balls lie within 5 mm in the median and 10 mm at worst, by marks off by 3 pixels: from %j",
  (eye, target, focal) => {
    for (const share of [1, 0.75]) {
      const size: Pixel = [1600 * share, 1200 * share];
      const draws = new Draws(13n);
      const see = camera(size, [...eye], [...target], focal * share);
      const balls = [0, 1, 3, 8, 13].map(
        (ball, k) => [ball, 0.2 + 0.87 * ((k * 0.37) % 1), 0.3 + 0.45 * k] as const,
      );
      const picture = photo(see, size, balls, [1, 1, 1], draws, true);
      const finger = ([u, v]: Pixel): Pixel => {
        const turn = draws.uniform(0, 2 * Math.PI);
        return [u + 3 * Math.cos(turn), v + 3 * Math.sin(turn)];
      };
      const noses = corners(see);
      const marks = noses.map(finger);
      const moved = snapCorners(picture, marks, (3.6 * size[0]) / 344, [W, L]);
      const off = ([u, v]: Pixel, k: number) => Math.hypot(u - noses[k]![0], v - noses[k]![1]);
      moved.forEach((pixel, k) => expect(off(pixel, k)).toBeLessThan(off(marks[k]!, k) + 0.5));
      const view = cameraOf(size, moved, [W, L], NOSE - R);
      const errors = balls.map(([, x, y]) => {
        const mark = finger(see(x, y, R));
        const [px, py] = view.place(
          snapDisc(picture, mark, radiusAt(view, mark), (3 * size[0]) / 344),
        );
        return Math.hypot(px - x, py - y);
      });
      errors.sort((a, b) => a - b);
      console.log(`with cushions: ${errors.map((x) => (1000 * x).toFixed(1)).join(", ")} mm`);
      expect(errors[2]!).toBeLessThan(0.005);
      expect(errors[4]!).toBeLessThan(0.01);
    }
  },
);
