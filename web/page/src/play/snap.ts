// Marks of a finger on a photo, moved to what they mean. A finger errs by some pixels of the page,
// which are several of the photo.
//   Corners: along each side of the table, the strongest edge across it within reach, weighed by
// how near it is; of the lines through two of such places the
//   one that has most of the others within two pixels. The side stays where less than a third are
// on it, or where another edge is within reach, as on tables with cushions: the face of a cushion
// has two edges, and the wood is behind it. Corners are where sides meet.
//   Balls: the disc, of a ball's radius there, that differs most from the cloth within it and least
// around it; where both are alike the mark stays.
import type { Pixel } from "./photo.js";

export type Picture = Pick<ImageData, "data" | "width" | "height">;

/** The colour at a place, of the nearest pixel. */
function at(
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

/** An edge that differs by more than this share of the strongest one competes with it. */
const RIVAL = 0.5;
/** Edges farther apart than this, pixels, are two. */
const APART = 5;

/** The side between two corners as a point and a direction, moved to an edge. */
function sideOf(picture: Picture, from: Pixel, to: Pixel, reach: number): { p: Pixel; d: Pixel } {
  const length = Math.hypot(to[0] - from[0], to[1] - from[1]);
  const d: Pixel = [(to[0] - from[0]) / length, (to[1] - from[1]) / length];
  const place = (along: number, off: number): Pixel => [
    from[0] + along * d[0] - off * d[1],
    from[1] + along * d[1] + off * d[0],
  ];
  // The strongest edge at each of 60 places: the change of colour over four pixels.
  const seen = Array.from({ length: 60 }, (_, k) => {
    const along = length * (0.06 + (0.88 * k) / 59);
    const edgeAt = (there: number, off: number): number =>
      apart(at(picture, ...place(there, off - 2)), at(picture, ...place(there, off + 2)));
    const edge = (off: number): number => edgeAt(along, off);
    // The mean of three places, which noise does not reach.
    const steady = (off: number): number =>
      (edgeAt(along - 4, off) + edge(off) + edgeAt(along + 4, off)) / 3;
    let best = 0;
    let most = 0;
    for (let off = -reach; off <= reach; off++) {
      const here = edge(off) * Math.exp(-((off / reach) ** 2));
      if (here > most) [best, most] = [off, here];
    }
    let rival = 0;
    for (let off = -2 * reach; off <= 2 * reach; off++)
      if (Math.abs(off - best) > APART) rival = Math.max(rival, steady(off));
    // The middle of the edge, which is as wide as the pixels that are compared.
    const offs = Array.from({ length: 17 }, (_, k) => best + (k - 8) / 2);
    const edges = edge(best);
    const on = offs.filter((off) => edge(off) > 0.7 * edges);
    const middle = on.reduce((sum, off) => sum + off, 0) / on.length;
    return [along, middle, rival > RIVAL * edges] as const;
  });
  let on = 0;
  let line = [0, 0] as readonly [number, number];
  for (const [i, a] of seen.entries())
    for (const b of seen.slice(i + 10)) {
      const slope = (b[1] - a[1]) / (b[0] - a[0]);
      const count = seen.filter(
        ([along, off]) => Math.abs(off - a[1] - slope * (along - a[0])) < 2,
      ).length;
      if (count > on) [on, line] = [count, [a[1] - slope * a[0], slope]];
    }
  const rivals = seen.filter(([, , hasRival]) => hasRival).length;
  if (on < 20 || rivals > 20) return { p: from, d };
  // Least squares of those that are on it.
  const near = seen.filter(([along, off]) => Math.abs(off - line[0] - line[1] * along) < 2);
  const mean = (of: (one: (typeof seen)[number]) => number): number =>
    near.reduce((sum, one) => sum + of(one), 0) / near.length;
  const u = mean(([along]) => along);
  const v = mean(([, off]) => off);
  const slope =
    mean(([along, off]) => (along - u) * (off - v)) / mean(([along]) => (along - u) ** 2);
  return { p: place(u, v), d: [d[0] - slope * d[1], d[1] + slope * d[0]] };
}
export function snapCorners(picture: Picture, corners: readonly Pixel[], reach: number): Pixel[] {
  const sides = corners.map((from, k) => sideOf(picture, from, corners[(k + 1) % 4]!, reach));
  return sides.map(({ p, d }, k) => {
    const { p: q, d: e } = sides[(k + 3) % 4]!;
    const t = ((q[0] - p[0]) * e[1] - (q[1] - p[1]) * e[0]) / (d[0] * e[1] - d[1] * e[0]);
    const to: Pixel = [p[0] + t * d[0], p[1] + t * d[1]];
    return Math.hypot(to[0] - corners[k]![0], to[1] - corners[k]![1]) < 2 * reach
      ? to
      : corners[k]!;
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
    at(picture, mark[0] + radius * x, mark[1] + radius * y),
  );
  const cloth = [0, 1, 2].map(
    (c) => ring.map((rgb) => rgb[c]!).sort((a, b) => a - b)[ring.length >> 1]!,
  );
  const differs = (x: number, y: number, points: readonly Pixel[]): number =>
    points.reduce(
      (sum, [u, v]) =>
        sum + Math.min(apart(at(picture, x + radius * u, y + radius * v), cloth) / 60, 1),
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
        Math.hypot(i, j) < 1.1 * radius && apart(at(picture, x + i, y + j), cloth) > 60 ? 1 : 0;
      [sum, u, v] = [sum + weight, u + weight * i, v + weight * j];
    }
  return sum > 0 ? [x + u / sum, y + v / sum] : best;
}
/** Red, green, blue and alpha of the pixels of a disc. */
export const discOf = (picture: Picture, [x, y]: Pixel, radius: number): number[] =>
  circles([0.3, 0.45, 0.55, 0.65, 0.73, 0.8]).flatMap(([u, v]) => [
    ...at(picture, x + radius * u, y + radius * v),
    255,
  ]);
