// Finger marks on a photo, moved to what they mean. A finger is off by some pixels of the page,
// which are several pixels of the photo.
//   The table: three lines run along each side: the foot of the cushion, which is visible where the
// cushion shows its face; its nose; and the wood behind it. The face is darker than both the bed
// and the top, and the wood differs from the cloth. First each side moves, at both ends, to where
// edges are found along all its visible lines; the width of the top is the one that suits all
// sides. Then the camera and its lens (lens.ts) are fitted so that their lines are nearest to the
// edges found along them. Many edges make up for noise, balls and pockets.
//   Balls: the point where colours differ most across the outline of a ball.
import { cameraOfLens, type Edge, fitLens, type Lens, project, RAIL } from "./lens.js";
import { type Camera, cameraOf, type Pixel, solve, USUAL_FOCAL } from "./photo.js";

export type Picture = Pick<ImageData, "data" | "width" | "height">;
type Colour = readonly [number, number, number];

/** The colour at a point, interpolated between pixels. */
function colourOf({ data, width, height }: Picture, x: number, y: number): Colour {
  const u = Math.min(Math.max(x - 0.5, 0), width - 1.001);
  const v = Math.min(Math.max(y - 0.5, 0), height - 1.001);
  const i = Math.floor(u);
  const j = Math.floor(v);
  const a = u - i;
  const b = v - j;
  const first = 4 * (width * j + i);
  const below = first + 4 * width;
  const channel = (c: number): number =>
    (1 - b) * ((1 - a) * data[first + c]! + a * data[first + 4 + c]!) +
    b * ((1 - a) * data[below + c]! + a * data[below + 4 + c]!);
  return [channel(0), channel(1), channel(2)];
}
const apart = (a: Colour, b: Colour): number =>
  Math.abs(a[0] - b[0]) + Math.abs(a[1] - b[1]) + Math.abs(a[2] - b[2]);
const lighter = (a: Colour, b: Colour): number => b[0] + b[1] + b[2] - a[0] - a[1] - a[2];

/** How high the noses of the cushions are above the bed, m. */
const NOSE = 0.0366;
/** Widths of the top that are tried, m. */
const RAILS = [0.042, RAIL, 0.058];
/** How little edges far from a mark lose, of which each suits other errors of marks. */
const PULLS = [4, 16];
/** The fraction of a side at its ends, and next to a side pocket, that is not searched for edges. */
const MARGIN = 0.08;
/** Points along a side, for the first search and for the last. */
const FEW = 40;
const MANY = 70;
/** The colours that an edge parts are so far from it, pixels. */
const BESIDE = 2;
/** A change of colour counts at most so much, of three channels of 255, and is none below FAINT. */
const MOST = 60;
const FAINT = 36;
/** A face that appears narrower than this, pixels, is treated as invisible. */
const NARROW = 3;

type Kind = "foot" | "nose" | "wood";
/** How much of an edge of a kind two colours, the inner and the outer one, show. */
function edgeOf(kind: Kind, inner: Colour, outer: Colour): number {
  if (kind === "foot") return -lighter(inner, outer);
  return kind === "nose" ? lighter(inner, outer) : apart(inner, outer);
}

type Place = readonly [number, number, number];
/** A side of the table, from corner to corner, with its points in space. */
interface Side {
  has: (share: number) => boolean;
  point(kind: Kind, share: number, rail: number): Place;
}
/** The four sides in the order of the corners. */
function sidesOf([width, length]: Pixel): Side[] {
  const corners = [
    [0, 0],
    [width, 0],
    [width, length],
    [0, length],
  ] as const;
  return corners.map(([x, y], k) => {
    const [ex, ey] = corners[(k + 1) % 4]!;
    const size = Math.hypot(ex - x, ey - y);
    const out = [(ey - y) / size, (x - ex) / size] as const;
    const isLong = size > 1.5 * Math.min(width, length);
    return {
      has: (share) => !isLong || Math.abs(share - 0.5) > 0.05,
      point(kind, share, rail) {
        const back = kind === "wood" ? rail : 0;
        const height = kind === "foot" ? -NOSE : 0;
        return [x + share * (ex - x) + back * out[0], y + share * (ey - y) + back * out[1], height];
      },
    };
  });
}
const shares = (count: number): number[] =>
  Array.from({ length: count }, (_, k) => MARGIN + ((1 - 2 * MARGIN) * (k + 0.5)) / count);

/** A photo with what is searched for on it. */
class Table {
  readonly sides: Side[];
  constructor(
    readonly picture: Picture,
    readonly size: Pixel,
  ) {
    this.sides = sidesOf(size);
  }
  pixel(lens: Lens, point: Place): Pixel {
    const { width, height } = this.picture;
    const [u, v] = project(lens, point);
    return [u * width + width / 2, v * width + height / 2];
  }
  /** The pixel of a point of a side, and the direction outwards, across the side. */
  seen(lens: Lens, side: Side, kind: Kind, share: number): { middle: Pixel; out: Pixel } {
    const middle = this.pixel(lens, side.point(kind, share, lens.rail));
    const next = this.pixel(lens, side.point(kind, share + 0.01, lens.rail));
    const inside = this.pixel(lens, [this.size[0] / 2, this.size[1] / 2, 0]);
    const far = Math.hypot(next[0] - middle[0], next[1] - middle[1]);
    const normal: Pixel = [(next[1] - middle[1]) / far, (middle[0] - next[0]) / far];
    const isOut = (inside[0] - middle[0]) * normal[0] + (inside[1] - middle[1]) * normal[1] < 0;
    return { middle, out: isOut ? normal : [-normal[0], -normal[1]] };
  }
  /** How wide the face of a side's cushion is seen, pixels; below 0 where the top hides it. */
  face(lens: Lens, side: Side): number {
    const { middle, out } = this.seen(lens, side, "nose", 0.5);
    const foot = this.pixel(lens, side.point("foot", 0.5, 0));
    return (middle[0] - foot[0]) * out[0] + (middle[1] - foot[1]) * out[1];
  }
  /** The strength of an edge at a point. */
  edge(kind: Kind, [x, y]: Pixel, [u, v]: Pixel): number {
    const inner = colourOf(this.picture, x - BESIDE * u, y - BESIDE * v);
    const outer = colourOf(this.picture, x + BESIDE * u, y + BESIDE * v);
    return edgeOf(kind, inner, outer);
  }
}

/** The lines that are seen of a side: a nose without its face is cloth before cloth. */
const kindsOf = (isSeen: boolean): Kind[] => (isSeen ? ["foot", "nose", "wood"] : ["wood"]);

/** How far both ends of a side move to lie on edges, pixels outwards. */
function moveOf(table: Table, lens: Lens, side: Side, reach: number, pull: number): Pixel {
  const isSeen = table.face(lens, side) > NARROW;
  const lines = kindsOf(isSeen).map((kind) => ({
    kind,
    points: shares(FEW)
      .filter(side.has)
      .map((share) => ({ share, ...table.seen(lens, side, kind, share) })),
  }));
  // Edges by point and distance, which all moves read.
  const far = Math.ceil(1.5 * reach);
  const found = lines.map(({ kind, points }) =>
    points.map(({ share, middle, out }) => ({
      share,
      edges: Array.from({ length: 2 * far + 1 }, (_, k) =>
        Math.min(
          table.edge(kind, [middle[0] + (k - far) * out[0], middle[1] + (k - far) * out[1]], out),
          MOST,
        ),
      ),
    })),
  );
  let best: Pixel = [0, 0];
  let most = -Infinity;
  for (let first = -far; first <= far; first++)
    for (let last = -far; last <= far; last++) {
      let score = 0;
      for (const places of found) {
        let sum = 0;
        for (const { share, edges } of places)
          sum += edges[far + Math.round(first + (last - first) * share)]!;
        score += Math.max(sum, 0) / places.length;
      }
      score *= Math.exp(-(first ** 2 + last ** 2) / (pull * reach ** 2));
      if (score > most) [best, most] = [[first, last], score];
    }
  return best;
}
/** Where two lines meet, each through two points. */
function meeting([p, q]: readonly Pixel[], [r, s]: readonly Pixel[]): Pixel {
  const d: Pixel = [q![0] - p![0], q![1] - p![1]];
  const e: Pixel = [s![0] - r![0], s![1] - r![1]];
  const t = ((r![0] - p![0]) * e[1] - (r![1] - p![1]) * e[0]) / (d[0] * e[1] - d[1] * e[0]);
  return [p![0] + t * d[0], p![1] + t * d[1]];
}
/** The corners whose sides lie on edges, for a width of the top. */
function movedCorners(
  table: Table,
  corners: readonly Pixel[],
  reach: number,
  rail: number,
  pull: number,
): Pixel[] {
  const { picture, size } = table;
  const { pose } = cameraOf([picture.width, picture.height], corners, size);
  const lens = { ...pose, bow: 0, rail };
  const lines = table.sides.map((side, k) => {
    const move = moveOf(table, lens, side, reach, pull);
    return [0, 1].map((end): Pixel => {
      const { out } = table.seen(lens, side, "nose", end);
      const [x, y] = corners[(k + end) % 4]!;
      return [x + move[end]! * out[0], y + move[end]! * out[1]];
    });
  });
  return lines.map((line, k) => meeting(line, lines[(k + 3) % 4]!));
}

/** The middle of an edge, which is as wide as the pixels that are compared; nothing of a faint one. */
function middleOf(steps: readonly number[], edges: readonly number[]): number | undefined {
  const most = Math.max(...edges);
  if (most < FAINT) return undefined;
  const top = edges.indexOf(most);
  let weight = 0;
  let sum = 0;
  steps.forEach((off, k) => {
    const more = Math.abs(k - top) <= 6 ? Math.max(edges[k]! - most / 2, 0) : 0;
    weight += more;
    sum += more * off;
  });
  return sum / weight;
}
const stepsTo = (reach: number): number[] =>
  Array.from({ length: 4 * reach + 1 }, (_, k) => (k - 2 * reach) / 2);

/** The edges that are seen near the lines of a lens, within some pixels. */
function edgesOf(table: Table, lens: Lens, places: number, reach: number): Edge[] {
  const { width, height } = table.picture;
  const steps = stepsTo(reach);
  return table.sides.flatMap((side) => {
    const isSeen = table.face(lens, side) > NARROW;
    return kindsOf(isSeen).flatMap((kind) =>
      shares(places)
        .filter(side.has)
        .flatMap((share): Edge[] => {
          const { middle, out } = table.seen(lens, side, kind, share);
          const edges = steps.map((off) =>
            table.edge(kind, [middle[0] + off * out[0], middle[1] + off * out[1]], out),
          );
          const off = middleOf(steps, edges);
          if (off === undefined) return [];
          const seen: Pixel = [
            (middle[0] + off * out[0] - width / 2) / width,
            (middle[1] + off * out[1] - height / 2) / width,
          ];
          return [{ point: (rail) => side.point(kind, share, rail), seen, across: out }];
        }),
    );
  });
}
/** The largest misfit of edges, and one that halves what they count, pixels. */
const MISFIT = 1;
const HALF = 0.3;

/** The lens that fits the edges within windows, pixels, around its lines, with their number. */
function fitted(
  table: Table,
  start: Lens,
  places: number,
  windows: readonly number[],
): { lens: Lens; misfit: number; count: number; score: number } {
  let lens = start;
  let misfit = Infinity;
  let edges: Edge[] = [];
  for (const window of windows) {
    edges = edgesOf(table, lens, places, window);
    ({ lens, misfit } = fitLens(lens, edges, window / table.picture.width, USUAL_FOCAL));
  }
  misfit *= table.picture.width;
  const count = edges.length;
  return { lens, misfit, count, score: count / (HALF + misfit) };
}
/**
 * The camera of a photo by the lines of its table, near marks of a finger that errs by `reach`
 * pixels; nothing where no such lines are seen. Throws a TypeError where the marks are no table.
 */
export function snapTable(
  picture: Picture,
  corners: readonly Pixel[],
  reach: number,
  size: Pixel,
  lower: number,
): { camera: Camera; corners: Pixel[] } | undefined {
  const pixels: Pixel = [picture.width, picture.height];
  const table = new Table(picture, size);
  // The width of the top is the one whose lines are on most edges.
  const tries = RAILS.flatMap((rail) =>
    PULLS.map((pull) => {
      let marks = corners;
      for (const far of [reach, reach / 2]) marks = movedCorners(table, marks, far, rail, pull);
      const start = { ...cameraOf(pixels, marks, size).pose, bow: 0, rail };
      return fitted(table, start, FEW, [6, 4]);
    }),
  );
  const best = tries.reduce((best, attempt) => (attempt.score > best.score ? attempt : best));
  const { lens, misfit, count } = fitted(table, best.lens, MANY, [3, 3]);
  if (count < 2 * MANY || misfit > MISFIT) return undefined;
  const noses = table.sides.map((side) => table.pixel(lens, side.point("nose", 0, 0)));
  const isNear = noses.every(
    ([u, v], k) => Math.hypot(u - corners[k]![0], v - corners[k]![1]) < 2 * reach,
  );
  if (!isNear) return undefined;
  return { camera: cameraOfLens(lens, pixels, lower), corners: noses };
}

/** The cloth around a ball: the middle of the colours there. */
function clothAround(picture: Picture, [x, y]: Pixel, outline: readonly Pixel[]): Colour {
  const ring = outline.flatMap(([u, v]) =>
    [2, 2.6].map((far) => colourOf(picture, x + far * u, y + far * v)),
  );
  const middle = (c: number): number =>
    ring.map((rgb) => rgb[c]!).sort((a, b) => a - b)[ring.length >> 1]!;
  return [middle(0), middle(1), middle(2)];
}
/** The light of the cloth in the darkest shadow and in the brightest spot. */
const SHADOW = 0.35;
const BRIGHT = 1.3;
/** A colour this far from the cloth's colours is clearly not cloth. */
const PLAIN = 40;
/** How much of a ball a colour is, from 0 to 1: cloth in any light is none. */
function share(colour: Colour, cloth: Colour): number {
  const product = colour[0] * cloth[0] + colour[1] * cloth[1] + colour[2] * cloth[2];
  const square = cloth[0] ** 2 + cloth[1] ** 2 + cloth[2] ** 2 + 1;
  const light = Math.min(Math.max(product / square, SHADOW), BRIGHT);
  const rest: Colour = [light * cloth[0], light * cloth[1], light * cloth[2]];
  return Math.min(apart(colour, rest) / PLAIN, 1);
}
/** How far inside and outside an outline colours are compared, pixels. */
const ACROSS = 1.6;
/** A point with a lower score than this has no ball. */
const DISC = 0.3;
/** From so many points of an outline on its middle is known. */
const ENOUGH = 12;

/** The middle of the ball that is seen best near a mark, for the outline of a ball there. */
export function snapDisc(
  picture: Picture,
  mark: Pixel,
  outline: readonly Pixel[],
  reach: number,
): Pixel {
  const cloth = clothAround(picture, mark, outline);
  const shareAt = (x: number, y: number): number => share(colourOf(picture, x, y), cloth);
  const score = (x: number, y: number): number => {
    let sum = 0;
    for (const [u, v] of outline) {
      const off = ACROSS / Math.hypot(u, v);
      const within = shareAt(x + 0.6 * u, y + 0.6 * v);
      const inner = shareAt(x + (1 - off) * u, y + (1 - off) * v);
      const outer = shareAt(x + (1 + off) * u, y + (1 + off) * v);
      sum += 0.5 * (within + inner) - outer;
    }
    return sum / outline.length;
  };
  let best = mark;
  let most = DISC;
  for (let step = 1.5, far = 1.5 * reach; step > 0.5; far = 2 * step, step /= 2) {
    const [x0, y0] = best;
    for (let x = x0 - far; x <= x0 + far; x += step)
      for (let y = y0 - far; y <= y0 + far; y += step) {
        const distance = Math.hypot(x - mark[0], y - mark[1]) / reach;
        const found = score(x, y) - 0.1 * distance ** 2;
        if (found > most) [best, most] = [[x, y], found];
      }
  }
  // A ball in the cloth's colour has no edge except its highlight.
  const ends = (inner: Pixel, outer: Pixel): number =>
    100 * (shareAt(...inner) - shareAt(...outer));
  const changes = (inner: Pixel, outer: Pixel): number =>
    apart(colourOf(picture, ...inner), colourOf(picture, ...outer));
  const rough = centred(best, outline, ends, [4, 3]) ?? best;
  const fine = centred(rough, outline, changes, [2, 2]);
  const isNear = fine && Math.hypot(fine[0] - rough[0], fine[1] - rough[1]) < ACROSS;
  return isNear ? fine : rough;
}
/** The middle by the edges that are seen across the outline; nothing where they are few. */
function centred(
  start: Pixel,
  outline: readonly Pixel[],
  edge: (inner: Pixel, outer: Pixel) => number,
  windows: readonly number[],
): Pixel | undefined {
  let [x, y] = start;
  for (const reach of windows) {
    const steps = stepsTo(reach);
    const rows = [
      [1e-9, 0, 0],
      [0, 1e-9, 0],
    ];
    let count = 0;
    for (const [u, v] of outline) {
      const far = Math.hypot(u, v);
      const a = u / far;
      const b = v / far;
      const place = (off: number): Pixel => [x + u + off * a, y + v + off * b];
      const off = middleOf(
        steps,
        steps.map((step) => edge(place(step - ACROSS), place(step + ACROSS))),
      );
      if (off === undefined) continue;
      count++;
      const weight = Math.max(1 - (off / reach) ** 2, 0);
      const row = [a, b, off];
      rows[0] = rows[0]!.map((sum, k) => sum + weight * a * row[k]!);
      rows[1] = rows[1]!.map((sum, k) => sum + weight * b * row[k]!);
    }
    const change = solve(rows);
    if (count < ENOUGH || !change) return undefined;
    [x, y] = [x + change[0]!, y + change[1]!];
  }
  return [x, y];
}
/** The distance between points that are searched for a ball, m. */
const GRID = 0.012;
/** How far around a ball there is cloth, of its radius; and from which score on one is seen. */
const AROUND = 1.5;
const SEEN = 0.45;
/** The pixels on a table where a ball seems to lie that nothing of `marked` is on. */
export function ballsSeen(
  picture: Picture,
  camera: Camera,
  [width, length]: Pixel,
  radius: number,
  marked: readonly Pixel[],
): Pixel[] {
  const found: { place: Pixel; score: number }[] = [];
  for (let x = radius; x <= width - radius; x += GRID)
    for (let y = radius; y <= length - radius; y += GRID) {
      const middle = camera.pixel([x, y]);
      const outline = camera.outline(middle, radius).filter((_, k) => k % 3 === 0);
      const cloth = clothAround(picture, middle, outline);
      const mean = (far: number): number =>
        outline.reduce((sum, [u, v]) => {
          const colour = colourOf(picture, middle[0] + far * u, middle[1] + far * v);
          return sum + share(colour, cloth) / outline.length;
        }, 0);
      if (mean(0.4) < SEEN) continue;
      const score = Math.min(mean(0.4), mean(0.75)) - mean(AROUND);
      if (score > SEEN) found.push({ place: [x, y], score });
    }
  found.sort((a, b) => b.score - a.score);
  const occupied = marked.map(camera.place);
  return found.flatMap(({ place }) => {
    const isTaken = occupied.some(([x, y]) => Math.hypot(x - place[0], y - place[1]) < 2 * radius);
    if (isTaken) return [];
    occupied.push(place);
    return [camera.pixel(place)];
  });
}
/** Red, green, blue and alpha of the pixels of a disc. */
export const discOf = (picture: Picture, [x, y]: Pixel, outline: readonly Pixel[]): number[] =>
  [0.3, 0.45, 0.55, 0.65, 0.73, 0.8].flatMap((far) =>
    outline.flatMap(([u, v]) => [...colourOf(picture, x + far * u, y + far * v), 255]),
  );
