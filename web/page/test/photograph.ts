// Photos of a pool table by casting a ray through each pixel, for tests of places from a photo: a
// lens that bends lines, cushions with faces, wood, pockets, balls with stripes and numbers, soft
// shadows, a lamp, dark corners, blur and noise. Nothing of it is shared with the page.
import type { Draws } from "../../test/support.js";

type Vector = [number, number, number];
const W = 1.27;
const L = 2.54;
const R = 0.028575;
const NOSE = 0.0366;
const SIZE = [1600, 1200] as const;
const RGB: Record<number, Vector> = {
  0: [245, 243, 232],
  1: [236, 182, 20],
  2: [24, 60, 150],
  3: [198, 24, 36],
  4: [80, 36, 120],
  5: [232, 112, 30],
  6: [20, 100, 70],
  7: [120, 24, 36],
  8: [22, 22, 24],
};
const WHITE: Vector = [240, 238, 228];

const minus = (a: Vector, b: Vector): Vector => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const dot = (a: Vector, b: Vector) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const times = (a: Vector, x: number): Vector => [a[0] * x, a[1] * x, a[2] * x];
const unit = (a: Vector) => times(a, 1 / Math.sqrt(dot(a, a)));
const cross = (a: Vector, b: Vector): Vector => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];

export interface Phone {
  eye: Vector;
  target: Vector;
  focal: number;
  /** The first coefficient of the lens. */
  bow: number;
  cloth: Vector;
}
/** A photo with what lies on the table, and where points of space are seen. */
export function photograph(
  { eye, target, focal, bow, cloth }: Phone,
  balls: readonly (readonly [number, number, number])[],
  draws: Draws,
) {
  const ahead = unit(minus(target, eye));
  const right = unit(cross(ahead, [0, 0, 1]));
  const up = cross(right, ahead);
  const [width, height] = SIZE;
  function see(x: number, y: number, z: number): [number, number] {
    const offset = minus([x, y, z], eye);
    const far = dot(offset, ahead);
    const a = dot(offset, right) / far;
    const b = dot(offset, up) / far;
    const g = 1 + bow * (a * a + b * b);
    return [width / 2 + focal * a * g, height / 2 - focal * b * g];
  }

  const lamp: Vector = [W / 2, L / 2, 1.8];
  const painted = balls.map(([ball, x, y]) => {
    const random = (): Vector =>
      unit([draws.uniform(-1, 1), draws.uniform(-1, 1), draws.uniform(-1, 1)]);
    return { ball, middle: [x, y, R] as Vector, stripe: random(), cap: random() };
  });
  const pockets = [0, L / 2, L].flatMap((y) =>
    [0, W].map((x) => {
      const more = y === L / 2 ? 0.045 : 0.02;
      const out = y === L / 2 ? 0 : Math.sign(y - 1) * more;
      return [x + (x === 0 ? -more : more), y + out] as const;
    }),
  );
  /** The colour of a ball where a ray meets it; nothing where it passes by. */
  function ofBall(ray: Vector): { far: number; colour: Vector } | undefined {
    let found: { far: number; colour: Vector } | undefined;
    for (const { ball, middle, stripe, cap } of painted) {
      const offset = minus(eye, middle);
      const b = dot(ray, offset);
      const q = b * b - dot(offset, offset) + R * R;
      if (q < 0) continue;
      const far = -b - Math.sqrt(q);
      if (found && found.far < far) continue;
      const normal = times(
        minus([0, 1, 2].map((k) => eye[k]! + far * ray[k]!) as Vector, middle),
        1 / R,
      );
      const isWhite =
        (ball > 8 && Math.abs(dot(normal, stripe)) > 0.55) ||
        (ball > 0 && Math.abs(dot(normal, cap)) > 0.93);
      const base = isWhite ? WHITE : RGB[ball > 8 ? ball - 8 : ball]!;
      const light = unit(minus(lamp, middle));
      const shade = 0.35 + 0.65 * Math.max(dot(normal, light), 0);
      const shine = 200 * Math.max(dot(normal, unit(minus(light, ahead))), 0) ** 90;
      found = { far, colour: base.map((x) => x * shade + shine) as Vector };
    }
    return found;
  }
  /** The colour of the table or of the floor behind it. */
  function ofTable(ray: Vector): { far: number; colour: Vector } {
    const upper = (NOSE - eye[2]) / ray[2];
    const x = eye[0] + upper * ray[0];
    const y = eye[1] + upper * ray[1];
    const isOver = x > 0 && x < W && y > 0 && y < L;
    const outside = Math.max(-x, x - W, -y, y - L);
    if (ray[2] >= 0 || outside > 0.17) return { far: 1e9, colour: [70, 66, 62] };
    const isHole = pockets.some(([px, py]) => (x - px) ** 2 + (y - py) ** 2 < 0.07 ** 2);
    if (isHole) return { far: upper, colour: [14, 14, 15] };
    if (!isOver) return { far: upper, colour: outside > 0.05 ? [92, 56, 34] : times(cloth, 0.95) };
    const far = -eye[2] / ray[2];
    const bx = eye[0] + far * ray[0];
    const by = eye[1] + far * ray[1];
    // Between the plane of the noses and the bed the ray meets the face of a cushion.
    if (!(bx > 0 && bx < W && by > 0 && by < L)) return { far: upper, colour: times(cloth, 0.55) };
    let light = 0.75 + 0.25 * Math.exp(-((bx - W / 2) ** 2 + (by - L / 2) ** 2) / 1.2);
    for (const { middle } of painted) {
      const near = ((bx - middle[0]) ** 2 + (by - middle[1]) ** 2) / (1.25 * R) ** 2;
      if (near < 4) light *= 1 - 0.55 * Math.exp(-near * near);
    }
    return { far, colour: times(cloth, light) };
  }

  const sharp = new Float32Array(3 * width * height);
  for (let j = 0; j < height; j++)
    for (let i = 0; i < width; i++) {
      const u = (i + 0.5 - width / 2) / focal;
      const v = -(j + 0.5 - height / 2) / focal;
      let a = u;
      let b = v;
      for (let round = 0; round < 5; round++) {
        const g = 1 + bow * (a * a + b * b);
        [a, b] = [u / g, v / g];
      }
      const ray = unit([0, 1, 2].map((k) => ahead[k]! + a * right[k]! + b * up[k]!) as Vector);
      const table = ofTable(ray);
      const ball = ofBall(ray);
      const { colour } = ball && ball.far < table.far ? ball : table;
      const dim = 1 - 0.18 * ((u * u + v * v) / (0.64 ** 2 + 0.48 ** 2));
      for (let c = 0; c < 3; c++) sharp[3 * (j * width + i) + c] = colour[c]! * dim;
    }
  // Blur over three by three pixels, and noise.
  const data = new Uint8ClampedArray(4 * width * height);
  let state = draws.uniform(0, 2 ** 31) | 0;
  for (let j = 0; j < height; j++)
    for (let i = 0; i < width; i++)
      for (let c = 0; c < 4; c++) {
        let sum = 0;
        for (let dj = -1; dj <= 1; dj++)
          for (let di = -1; di <= 1; di++) {
            const row = Math.min(Math.max(j + dj, 0), height - 1);
            const column = Math.min(Math.max(i + di, 0), width - 1);
            sum +=
              ((2 - Math.abs(di)) * (2 - Math.abs(dj)) * sharp[3 * (row * width + column) + c]!) /
              16;
          }
        state = Math.imul(state, 1664525) + 1013904223;
        data[4 * (j * width + i) + c] = c === 3 ? 255 : sum + state / 2 ** 28;
      }
  return { picture: { data, width, height }, see };
}
