// Marks of a finger on a photo, moved to what they mean. A finger errs by some pixels of the page,
// which are several of the photo.
//   Corners: where the sides of the table meet, and a side is a straight edge near its two marks.
// An edge is judged by the mean change of colour across it, along the whole side, because noise and
// balls do not reach this mean. On a side whose cushion shows its face, the nose is the outer edge of
// the dark face, whose width the marks' camera predicts; its inner edge is the bed. On a side whose
// face is hidden, the nose is the only edge within reach, because the wood is farther off. A side
// without such an edge, or with two that compete, stays where the finger put it.
//   Balls: the disc, of a ball's radius there, that differs most from the cloth within it and least
// around it; where both are alike the mark stays.
import { cameraOf, type Pixel } from "./photo.js";

export type Picture = Pick<ImageData, "data" | "width" | "height">;

/** The colour at a place, of the nearest pixel. */
function colourOf(
  { data, width, height }: Picture,
  x: number,
  y: number,
): readonly [number, number, number] {
  const k =
    4 *
    (width * Math.min(Math.max(Math.round(y), 0), height - 1) +
      Math.min(Math.max(Math.round(x), 0), width - 1));
  return [data[k]!, data[k + 1]!, data[k + 2]!];
}
const apart = (a: readonly number[], b: readonly number[]): number =>
  Math.abs(a[0]! - b[0]!) + Math.abs(a[1]! - b[1]!) + Math.abs(a[2]! - b[2]!);

/** How high the noses of the cushions are above the bed, m. */
const NOSE = 0.0366;
/** Places along a side, and the share of the side before the first and behind the last of them. */
const PLACES = 160;
const MARGIN = 0.08;
/** The colours that an edge parts are so far from it, pixels. */
const BESIDE = 2;
/** A change of one place counts at most so much, of three channels of 255: a ball may lie there. */
const MOST = 90;
/** A weaker mean change than this is no edge. */
const FAINT = 4;
/** A face is darker than this on both sides, and its two edges differ by at most this share. */
const DARK = 12;
const BALANCED = 0.3;
/** An edge that has more than this share of the strongest one competes with it. */
const RIVAL = 0.5;
/** Edges farther apart than this, pixels, are two. */
const APART = 5;
/** A face that is seen narrower than this, pixels, is taken for none that is seen. */
const NARROW = 3;

/** A line across the strip of a side: how far it is off the marks at both ends, pixels. */
type Line = readonly [number, number];

/** The strip of a picture along a side, outwards from the table: colours by place and distance. */
class Strip {
  readonly #picture: Picture;
  readonly #start: Pixel;
  readonly #along: Pixel;
  readonly #outward: Pixel;

  constructor(picture: Picture, start: Pixel, end: Pixel, inside: Pixel) {
    const length = Math.hypot(end[0] - start[0], end[1] - start[1]);
    const dx = (end[0] - start[0]) / length;
    const dy = (end[1] - start[1]) / length;
    const isInside = (inside[0] - start[0]) * -dy + (inside[1] - start[1]) * dx > 0;
    this.#picture = picture;
    this.#start = start;
    this.#along = [end[0] - start[0], end[1] - start[1]];
    this.#outward = isInside ? [dy, -dx] : [-dy, dx];
  }
  /** A place at a share of the side, and so far outwards. */
  place(share: number, off: number): Pixel {
    return [
      this.#start[0] + share * this.#along[0] + off * this.#outward[0],
      this.#start[1] + share * this.#along[1] + off * this.#outward[1],
    ];
  }
  offOf([x, y]: Pixel): number {
    return (x - this.#start[0]) * this.#outward[0] + (y - this.#start[1]) * this.#outward[1];
  }
  /**
   * The mean change of colour outwards across a line: how much there is, and of the light, whose
   * sign says whether it is brighter outside.
   */
  change([first, last]: Line): { much: number; light: number } {
    const sum = [0, 0, 0];
    for (let k = 0; k < PLACES; k++) {
      const share = MARGIN + ((1 - 2 * MARGIN) * k) / (PLACES - 1);
      const off = first + (last - first) * share;
      const inner = colourOf(this.#picture, ...this.place(share, off - BESIDE));
      const outer = colourOf(this.#picture, ...this.place(share, off + BESIDE));
      const factor = Math.min(1, MOST / (apart(inner, outer) + 1));
      for (let c = 0; c < 3; c++) sum[c]! += (factor * (outer[c]! - inner[c]!)) / PLACES;
    }
    const much = sum.reduce((total, change) => total + Math.abs(change), 0);
    return { much, light: sum[0]! + sum[1]! + sum[2]! };
  }
}

/** The line with the highest score around another one, within a reach, by ever smaller steps. */
function bestLine(score: (line: Line) => number, reach: number): { line: Line; score: number } {
  let best: Line = [0, 0];
  let most = -Infinity;
  let far = reach;
  for (let step = 1; step > 0.2; step /= 2) {
    const [a, b] = best;
    for (let first = a - far; first <= a + far; first += step)
      for (let last = b - far; last <= b + far; last += step) {
        const found = score([first, last]);
        if (found > most) [best, most] = [[first, last], found];
      }
    far = 1.5 * step;
  }
  return { line: best, score: most };
}
/** How far a line is from the marks, as the share of its score that remains. */
const nearness = ([first, last]: Line, reach: number): number =>
  Math.exp(-(first ** 2 + last ** 2) / (2 * reach ** 2));

/** The middle of an edge, which is as wide as the pixels that are compared, at each end in turn. */
function centred(strip: Strip, line: Line): Line {
  const offs = Array.from({ length: 25 }, (_, k) => (k - 12) / 4);
  let [first, last] = line;
  for (let round = 0; round < 2; round++) {
    const mean = (shifted: (off: number) => Line): number => {
      const much = offs.map((off) => strip.change(shifted(off)).much);
      const most = Math.max(...much);
      const plateau = offs.filter((_, k) => much[k]! > 0.8 * most);
      return plateau.reduce((sum, off) => sum + off, 0) / plateau.length;
    };
    const both = mean((off) => [first + off, last + off]);
    [first, last] = [first + both, last + both];
    const tilt = mean((off) => [first + off, last - off]);
    [first, last] = [first + tilt, last - tilt];
  }
  return [first, last];
}
/** The nose of a side, or nothing where no edge is plainly the nose; `face`: its inner edge. */
function noseOf(strip: Strip, face: Line, reach: number): Line | undefined {
  const isSeen = Math.max(...face) < -NARROW;
  const isHidden = Math.min(...face) > NARROW;
  if (isSeen) {
    // The face is dark between bed and top: darker at its inner edge, brighter at the nose.
    const pair = bestLine((line) => {
      const inner = Math.max(
        ...[-1, 0, 1].map(
          (more) => -strip.change([line[0] + face[0] + more, line[1] + face[1] + more]).light,
        ),
      );
      const outer = strip.change(line).light;
      const isFace = Math.min(inner, outer) > BALANCED * Math.max(inner, outer);
      return isFace ? Math.min(inner, outer) * nearness(line, reach) : 0;
    }, reach);
    if (pair.score > DARK) return centred(strip, pair.line);
  }
  const found = bestLine((line) => strip.change(line).much * nearness(line, reach), reach);
  if (found.score < FAINT) return undefined;
  const [first, last] = found.line;
  const strongest = strip.change(found.line).much;
  const rival = bestLine((line) => {
    const more = line[0] - first;
    const others = line[1] - last;
    // A line that crosses the other one shares a part of its edge. Behind a hidden face is wood.
    const isApart = Math.min(Math.abs(more), Math.abs(others)) > APART && more * others > 0;
    const isOther = isApart && !(isHidden && more > 0);
    return isOther ? strip.change(line).much : 0;
  }, reach);
  return rival.score > RIVAL * strongest ? undefined : centred(strip, found.line);
}

/** Where two lines meet, each through two points. */
function meeting([p, q]: readonly Pixel[], [r, s]: readonly Pixel[]): Pixel {
  const d: Pixel = [q![0] - p![0], q![1] - p![1]];
  const e: Pixel = [s![0] - r![0], s![1] - r![1]];
  const t = ((r![0] - p![0]) * e[1] - (r![1] - p![1]) * e[0]) / (d[0] * e[1] - d[1] * e[0]);
  return [p![0] + t * d[0], p![1] + t * d[1]];
}
/**
 * The corners of a table of a size, m, moved to where its noses meet. Throws a TypeError where the
 * marks are no table.
 */
export function snapCorners(
  picture: Picture,
  corners: readonly Pixel[],
  reach: number,
  [width, length]: Pixel,
): Pixel[] {
  const camera = cameraOf([picture.width, picture.height], corners, [width, length], NOSE);
  const bed = (
    [
      [0, 0],
      [width, 0],
      [width, length],
      [0, length],
    ] as const
  ).map(camera.pixel);
  const middle = camera.pixel([width / 2, length / 2]);
  const sides = corners.map((start, k) => {
    const end = corners[(k + 1) % 4]!;
    const strip = new Strip(picture, start, end, middle);
    const face: Line = [strip.offOf(bed[k]!), strip.offOf(bed[(k + 1) % 4]!)];
    const [first, last] = noseOf(strip, face, reach) ?? [0, 0];
    return [strip.place(0, first), strip.place(1, last)];
  });
  return sides.map((side, k) => {
    const corner = meeting(side, sides[(k + 3) % 4]!);
    const isNear = Math.hypot(corner[0] - corners[k]![0], corner[1] - corners[k]![1]) < 2 * reach;
    return isNear ? corner : corners[k]!;
  });
}

/** A disc of points, or a ring: so many circles, to radius 1. */
const circles = (radii: readonly number[]): Pixel[] =>
  radii.flatMap((r) =>
    Array.from(
      { length: 24 },
      (_, k) => [r * Math.cos((k * Math.PI) / 12), r * Math.sin((k * Math.PI) / 12)] as const,
    ),
  );
const WITHIN = circles([0.3, 0.6, 0.85]);
const AROUND = circles([1.2, 1.4]);

export function snapDisc(picture: Picture, mark: Pixel, radius: number, reach: number): Pixel {
  // The cloth: the middle of the colours around.
  const ring = circles([2, 2.6]).map(([x, y]) =>
    colourOf(picture, mark[0] + radius * x, mark[1] + radius * y),
  );
  const cloth = [0, 1, 2].map(
    (c) => ring.map((rgb) => rgb[c]!).sort((a, b) => a - b)[ring.length >> 1]!,
  );
  const differs = (x: number, y: number, points: readonly Pixel[]): number =>
    points.reduce(
      (sum, [u, v]) =>
        sum + Math.min(apart(colourOf(picture, x + radius * u, y + radius * v), cloth) / 60, 1),
      0,
    ) / points.length;
  let best = mark;
  let most = 0.3;
  for (let step = Math.max(radius / 5, 1), far = reach; step > 0.4; far = 2 * step, step /= 3) {
    const [x0, y0] = best;
    for (let x = x0 - far; x <= x0 + far; x += step)
      for (let y = y0 - far; y <= y0 + far; y += step) {
        const score =
          differs(x, y, WITHIN) -
          differs(x, y, AROUND) -
          0.1 * (Math.hypot(x - mark[0], y - mark[1]) / reach) ** 2;
        if (score > most) [best, most] = [[x, y], score];
      }
  }
  // The middle of what differs from the cloth there.
  const [x, y] = best;
  let sum = 0;
  let u = 0;
  let v = 0;
  for (let i = -radius; most > 0.3 && i <= radius; i += 0.5)
    for (let j = -radius; j <= radius; j += 0.5) {
      const weight =
        Math.hypot(i, j) < 1.1 * radius && apart(colourOf(picture, x + i, y + j), cloth) > 60
          ? 1
          : 0;
      [sum, u, v] = [sum + weight, u + weight * i, v + weight * j];
    }
  return sum > 0 ? [x + u / sum, y + v / sum] : best;
}
/** Red, green, blue and alpha of the pixels of a disc. */
export const discOf = (picture: Picture, [x, y]: Pixel, radius: number): number[] =>
  circles([0.3, 0.45, 0.55, 0.65, 0.73, 0.8]).flatMap(([u, v]) => [
    ...colourOf(picture, x + radius * u, y + radius * v),
    255,
  ]);
