// Places on a table from a photo. Four corners of the playing surface, marked where the noses of
// the cushions would meet, give the homography from the plane of the noses to the picture:
//     s (u, v, 1) = H (x, y, 1),   H = K (r1, r2, t) up to a factor,
// with columns r1, r2 of the camera's rotation and its place t. The picture's middle is taken for
// the principal point and pixels for square, so that K = diag(f, f, 1), and that r1 and r2 are
// orthogonal and of one length are two equations, linear in 1 / f^2, for one unknown: least
// squares. Balls have their middles below the noses, by `lower`: the homography of that plane has
// the third column h3 - lower K r3, r3 = r1 x r2. Seen from right above, f stays unknown, and the
// plane of the noses is taken: the error is then at most lower / height of the camera, of the
// distance from the middle.
import { texts } from "../texts/texts.js";

export type Pixel = readonly [number, number];
/** Row by row. */
type Matrix = readonly [number, number, number, number, number, number, number, number, number];

/**
 * The solution of a square system by Gauss, with the largest pivots; undefined where there is none.
 */
export function solve(rows: number[][]): number[] | undefined {
  const n = rows.length;
  for (let k = 0; k < n; k++) {
    let best = k;
    for (let i = k + 1; i < n; i++)
      if (Math.abs(rows[i]![k]!) > Math.abs(rows[best]![k]!)) best = i;
    [rows[k], rows[best]] = [rows[best]!, rows[k]!];
    if (Math.abs(rows[k]![k]!) < 1e-12) return undefined;
    for (let i = 0; i < n; i++) {
      if (i === k) continue;
      const factor = rows[i]![k]! / rows[k]![k]!;
      for (let j = k; j <= n; j++) rows[i]![j]! -= factor * rows[k]![j]!;
    }
  }
  return rows.map((row, k) => row[n]! / row[k]!);
}

/** The homography that takes four points to four others. */
function homography(sources: readonly Pixel[], targets: readonly Pixel[]): Matrix | undefined {
  const rows = sources.flatMap(([x, y], k) => {
    const [u, v] = targets[k]!;
    return [
      [x, y, 1, 0, 0, 0, -u * x, -u * y, u],
      [0, 0, 0, x, y, 1, -v * x, -v * y, v],
    ];
  });
  const found = solve(rows);
  return found && ([...found, 1] as unknown as Matrix);
}

function inverse([a, b, c, d, e, f, g, h, i]: Matrix): Matrix {
  return [
    e * i - f * h,
    c * h - b * i,
    b * f - c * e,
    f * g - d * i,
    a * i - c * g,
    c * d - a * f,
    d * h - e * g,
    b * g - a * h,
    a * e - b * d,
  ];
}
function apply(m: Matrix, [x, y]: Pixel): Pixel {
  const w = m[6] * x + m[7] * y + m[8];
  return [(m[0] * x + m[1] * y + m[2]) / w, (m[3] * x + m[4] * y + m[5]) / w];
}

/** A camera without its lens: the focal length in units of the picture's width, and where it is. */
export interface Pose {
  focal: number;
  /** The directions right, down and ahead, and the eye, m; z = 0 is the plane of the noses. */
  turn: readonly Vector[];
  eye: Vector;
}
type Vector = readonly [number, number, number];
export interface Camera {
  /** The position of a ball whose centre is seen at a pixel, m. */
  place(pixel: Pixel): Pixel;
  /** Where the centre of a ball at a position is seen. */
  pixel(place: Pixel): Pixel;
  /** The focal length, pixels; undefined where the photo does not determine it. */
  focal: number | undefined;
  /** The outline of a ball of a radius, m, around its middle, pixels. */
  outline(middle: Pixel, radius: number): Pixel[];
  /** Where it is, whatever its lens. */
  pose: Pose;
}
/** Points of a circle. */
export const circle = (radius: number, points = 32): Pixel[] =>
  Array.from({ length: points }, (_, k) => {
    const turn = (2 * Math.PI * k) / points;
    return [radius * Math.cos(turn), radius * Math.sin(turn)];
  });

/** The focal length of a phone, in units of the picture's width, where a picture does not tell it. */
export const USUAL_FOCAL = 0.8;
/** The pose of a camera that sees the plane of the noses by a homography. */
function poseOf(H: Matrix, focal: number): Pose {
  const columns = [0, 1, 2].map((k) => [H[k]! / focal, H[3 + k]! / focal, H[6 + k]!]);
  const [r1, r2, t] = columns as [number[], number[], number[]];
  const size = Math.sqrt(Math.hypot(...r1) * Math.hypot(...r2));
  const x = r1.map((part) => part / Math.hypot(...r1));
  const along = x.reduce((sum, part, k) => sum + part * r2[k]!, 0);
  const rest = r2.map((part, k) => part - along * x[k]!);
  const y = rest.map((part) => part / Math.hypot(...rest));
  const z = [1, 2, 0].map((k) => x[k]! * y[(k + 1) % 3]! - x[(k + 1) % 3]! * y[k]!);
  const eye = [x, y, z].map((axis) => -axis.reduce((sum, part, k) => sum + part * t[k]!, 0) / size);
  const turn = [0, 1, 2].map((k) => [x[k]!, y[k]!, z[k]!] as const);
  return { focal, turn, eye: eye as unknown as Vector };
}

/**
 * The camera of a photo with a size, pixels, from the corners of a table in the order 0,0; width,0;
 * width,length; 0,length. `lower`: how far the middles of
 * balls are below the noses, m. Throws a TypeError where the corners are no table.
 */
export function cameraOf(
  [wide, high]: Pixel,
  corners: readonly Pixel[],
  [width, length]: Pixel,
  lower = 0.008,
): Camera {
  // Pixels from the middle of the picture, in units of its width: numbers of about 1.
  const unit = ([u, v]: Pixel): Pixel => [(u - wide / 2) / wide, (v - high / 2) / wide];
  const seen = corners.map(unit);
  const turns = seen.map((p, k) => {
    const q = seen[(k + 1) % 4]!;
    const r = seen[(k + 2) % 4]!;
    return Math.sign((q[0] - p[0]) * (r[1] - q[1]) - (q[1] - p[1]) * (r[0] - q[0]));
  });
  // On a picture, whose v points down, a table that is not mirrored is walked around against the
  // clock.
  if (!turns.every((turn) => turn === -1)) throw new TypeError(texts.cornersMarkThemIn);
  const H = homography(
    [
      [0, 0],
      [width, 0],
      [width, length],
      [0, length],
    ],
    seen,
  );
  if (!H) throw new TypeError(texts.cornersThreeOfThem);

  // 1 / f^2 from both equations.
  const a1 = H[0] * H[1] + H[3] * H[4];
  const b1 = H[6] * H[7];
  const a2 = H[0] ** 2 + H[3] ** 2 - H[1] ** 2 - H[4] ** 2;
  const b2 = H[6] ** 2 - H[7] ** 2;
  const inverseSquare = -(a1 * b1 + a2 * b2) / (a1 * a1 + a2 * a2);
  const focal =
    inverseSquare > 0.01 && inverseSquare < 25 ? 1 / Math.sqrt(inverseSquare) : undefined;

  // The third axis, and the plane of the middles of balls.
  let M = H;
  if (focal !== undefined) {
    const { turn } = poseOf(H, focal);
    const size = Math.hypot(H[0] / focal, H[3] / focal, H[6]);
    const down = turn.map((row, k) => lower * size * (k < 2 ? focal : 1) * row[2]);
    M = H.map((x, k) => (k % 3 === 2 ? x - down[(k - 2) / 3]! : x)) as unknown as Matrix;
  }
  const back = inverse(M);
  const place = (pixel: Pixel): Pixel => apply(back, unit(pixel));
  const pixel = (at: Pixel): Pixel => {
    const [u, v] = apply(M, at);
    return [u * wide + wide / 2, v * wide + high / 2];
  };
  return {
    place,
    pixel,
    focal: focal && focal * wide,
    pose: poseOf(H, focal ?? USUAL_FOCAL),
    outline(middle, radius) {
      const [x, y] = place(middle);
      // The largest of both ways: a ball is seen as wide from all sides.
      const ways = [pixel([x + radius, y]), pixel([x, y + radius])];
      const wide = Math.max(...ways.map(([u, v]) => Math.hypot(u - middle[0], v - middle[1])));
      return circle(wide);
    },
  };
}

/** Hues that differ by less are one. */
const SAME_HUE = 0.12;
/**
 * Which balls a patch of a picture may be, the likeliest first, of those that are named: red,
 * green, blue and alpha of its pixels. There is one where its
 * colour is much nearer to that of a ball than to any other, and where it is plainly a stripe or
 * none.
 */
export function suggest(patch: ArrayLike<number>, colours: readonly string[]): number[] {
  // White pixels make a stripe or the cue ball; the others have the colour, whose hue counts more
  // than its light.
  let white = 0;
  let count = 0;
  const sum = [0, 0, 0];
  for (let k = 0; k < patch.length; k += 4) {
    const rgb = [patch[k]!, patch[k + 1]!, patch[k + 2]!];
    count++;
    // White in any light: little colour, and not dark.
    if (Math.max(...rgb) > 100 && Math.max(...rgb) - Math.min(...rgb) < 0.32 * Math.max(...rgb))
      white++;
    else rgb.forEach((x, c) => (sum[c]! += x));
  }
  const share = white / Math.max(count, 1);
  if (share > 0.93) return [0];
  const mean = sum.map((x) => x / Math.max(count - white, 1));
  const chroma = ([r, g, b]: number[]): number[] => {
    const light = r! + g! + b! + 60;
    return [r! / light, g! / light, b! / light, light / 1500];
  };
  const tint = chroma(mean);
  const apart = colours.map((hex) => {
    const reference = chroma([1, 3, 5].map((c) => parseInt(hex.slice(c, c + 2), 16)));
    return tint.map((x, c) => x - reference[c]!);
  });
  const far = apart.map((parts) => Math.hypot(...parts));
  const least = Math.min(...far);
  // Red in shade is as dark as maroon: a ball of the same hue is offered too.
  const hues = apart.map((parts) => Math.hypot(...parts.slice(0, 3)));
  const hue = Math.min(...hues) + SAME_HUE;
  // Ball k + 1 and ball k + 9 have one colour; ball 8 has no stripe.
  const ranked = [...far.keys()]
    .filter((k) => far[k]! < 1.3 * least + 0.01 || hues[k]! < hue)
    .sort((a, b) => far[a]! - far[b]!);
  // A stripe whose white end is up is nearly as white as the cue ball.
  if (share > 0.8) return [0, ...ranked.filter((k) => k < 7).map((k) => k + 9)];
  const balls = ranked.flatMap((k) => {
    const solid = k + 1;
    const stripe = k + 9;
    if (solid === 8) return [8];
    if (share > 0.36) return [stripe];
    if (share > 0.3) return [stripe, solid];
    if (share > 0.15) return [solid, stripe];
    return [solid];
  });
  // The cue ball in the shade of a cushion is half white.
  return share > 0.5 ? [...balls, 0] : balls;
}
