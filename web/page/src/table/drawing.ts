// What is drawn over the table during aiming: the stick, the ghost ball, lines, and rings around
// balls.
import type { Contact, Cue, PlanStroke, ShotBall } from "carom";
import { line } from "../../../player/table.js";
import { colourOfShot } from "../../../player/words.js";
import { onTable } from "./filmed.js";

export const DEGREES = 180 / Math.PI;
/** How far the stick is drawn back for each m/s, m. */
export const PULL = 0.04;
export const stickEnd = (radius: number, speed: number): number => radius + PULL * speed;

/** A context with the scale and the position of a table on it. */
export interface Pen {
  g: CanvasRenderingContext2D;
  scale: number;
  place(x: number, y: number): [number, number];
}

export function path(
  pen: Pen,
  points: readonly (readonly number[])[],
  width: number,
  style: string,
): void {
  pen.g.strokeStyle = style;
  pen.g.lineWidth = width;
  line(pen.g, pen, points);
}
export const stroke = (
  pen: Pen,
  start: readonly number[],
  end: readonly number[],
  width: number,
  style: string,
): void => path(pen, [start, end], width, style);

/**
 * A line on the table, m: its colour, its width in pixels, and how high it lies where that counts,
 * m.
 */
export interface Line {
  points: readonly (readonly number[])[];
  colour: string;
  width: number;
  isDashed?: boolean;
  height?: number;
}
export function drawLine(pen: Pen, { points, colour, width, isDashed = false }: Line): void {
  pen.g.setLineDash(isDashed ? [5, 4] : []);
  path(pen, points, width, colour);
  pen.g.setLineDash([]);
}

/** A circle of a radius, m, and some pixels more. */
export function ring(
  { g, scale, place }: Pen,
  centre: readonly number[],
  radius: number,
  more: number,
): void {
  g.beginPath();
  g.arc(...place(centre[0]!, centre[1]!), radius * scale + more, 0, 7);
  g.stroke();
}

/** Points of a circle on the cloth of a radius, m. */
export const circleOf = (place: readonly number[], radius: number): [number, number][] =>
  Array.from({ length: 41 }, (_, k) => (k * Math.PI) / 20).map((turn) => [
    place[0]! + radius * Math.cos(turn),
    place[1]! + radius * Math.sin(turn),
  ]);

/**
 * The ghost ball of a contact, the line of the ball that is met, and the tangent line, to the side
 * where the cue ball goes.
 */
export function drawContact(
  pen: Pen,
  { event, ball }: Contact,
  radius: number,
  [dx, dy]: readonly [number, number],
): void {
  const length = 0.35;
  const [ghost, object] =
    event.a === ball
      ? [event.before[1]!.r, event.before[0]!.r]
      : [event.before[0]!.r, event.before[1]!.r];
  const nx = (object[0] - ghost[0]) / (2 * radius);
  const ny = (object[1] - ghost[1]) / (2 * radius);
  pen.g.setLineDash([5, 4]);
  stroke(pen, object, [object[0] + length * nx, object[1] + length * ny], 1.4, "#ffffffd0");
  const turn = Math.sign(dx * -ny + dy * nx) || 1;
  stroke(
    pen,
    ghost,
    [ghost[0] - length * turn * ny, ghost[1] + length * turn * nx],
    1.4,
    "#ffffffd0",
  );
  ring(pen, ghost, radius, 0);
  pen.g.setLineDash([]);
}

/**
 * A stroke that the coach draws: its lines, the zone where the cue ball may land, and the place of
 * its number; and the stroke itself, where a tap on the number aims it.
 */
export interface Sketch {
  lines: readonly Line[];
  zone: readonly (readonly number[])[];
  place: readonly number[];
  choice?: PlanStroke;
}
/** The colour of a sketch, as dense as it is to be. */
export const colourOfSketch = (k: number, density = 1): string =>
  colourOfShot(k + 1) +
  Math.round(255 * density)
    .toString(16)
    .padStart(2, "0");
/** Draws zones, and the number of each sketch. Its lines are among those of the aim. */
export function drawSketches({ g, place }: Pen, sketches: readonly Sketch[]): void {
  g.save();
  g.font = "bold 13px sans-serif";
  g.textAlign = "center";
  g.textBaseline = "middle";
  for (const [k, sketch] of sketches.entries()) {
    g.beginPath();
    for (const [x, y] of sketch.zone) g.lineTo(...place(x!, y!));
    g.fillStyle = colourOfSketch(k, 0.28);
    g.fill();
    if (sketch.zone.length === 0 && !sketch.choice) continue;
    const [x, y] = place(sketch.place[0]!, sketch.place[1]!);
    g.beginPath();
    g.arc(x, y, 9, 0, 7);
    g.fillStyle = "#000b";
    g.strokeStyle = colourOfSketch(k);
    g.lineWidth = 2;
    g.fill();
    g.stroke();
    g.fillStyle = "#fff";
    g.fillText(String(k + 1), x, y + 0.5);
  }
  g.restore();
}

/** The sections of a stick: tip, ferrule, shaft, ring and butt, with the distance of each end from the tip, m. */
const STICK: readonly (readonly [end: number, colour: string])[] = [
  [0.01, "#3f7fbf"],
  [0.035, "#f4efe2"],
  [0.8, "#d9b077"],
  [0.82, "#efe3c4"],
  [1.45, "#3a2015"],
];
/** The stick behind the cue ball, drawn back by its speed; from above a raised one is shorter. */
export function drawStick(pen: Pen, cueBall: ShotBall, { phi, theta, speed }: Cue): void {
  const { g, scale, place } = pen;
  const { r } = cueBall.state;
  const dx = Math.cos(phi / DEGREES);
  const dy = Math.sin(phi / DEGREES);
  const gap = stickEnd(cueBall.kind.radius, speed);
  const seen = Math.max(Math.cos(theta / DEGREES), 0.15);
  /** The outline between two points of the stick, which is 13 mm thick at its tip and 29 at its end. */
  const fill = (start: number, end: number, colour: string): void => {
    g.beginPath();
    for (const [s, side] of [
      [start, 1],
      [end, 1],
      [end, -1],
      [start, -1],
    ] as const) {
      const far = gap + seen * s;
      const half = side * Math.max(0.0065 + 0.0055 * s, (1.4 + s) / scale);
      g.lineTo(...place(r[0] - dx * far - dy * half, r[1] - dy * far + dx * half));
    }
    g.fillStyle = colour;
    g.fill();
  };
  g.save();
  Object.assign(g, { shadowColor: "#0008", shadowBlur: 5, shadowOffsetX: 2, shadowOffsetY: 5 });
  fill(0, 1.45, STICK[2]![1]);
  g.restore();
  STICK.forEach(([end, colour], k) => fill(STICK[k - 1]?.[0] ?? 0, end, colour));
}

/**
 * What stands beside each ball or on it: its number, or else the letters of its colour, for which
 * readers who confuse colours ask.
 */
export const labelsOf = (
  names: readonly string[],
  letters: Readonly<Record<string, string>>,
): string[] =>
  names.map((name) => (Number(name) > 0 ? name : (letters[name.split(" ")[0]!] ?? "")));
/** Letters are drawn on a ball of this many pixels, and next to a smaller one. */
const ROOM = 7;

/** The height of a label, and how far it extends beyond its text, pixels of the page. */
const HIGH = 18;
const BEYOND = 4;
interface LabelPicture {
  canvas: HTMLCanvasElement;
  width: number;
}
const labelPictures = new Map<string, LabelPicture>();
/**
 * A label as a picture, which is drawn once: a letter on its ball has an outline, a label beside its
 * ball a pill behind it.
 */
function labelPicture(text: string, sharp: number, isOnBall = false): LabelPicture {
  const key = [text, sharp, isOnBall].join();
  const drawn = labelPictures.get(key);
  if (drawn) return drawn;
  const canvas = document.createElement("canvas");
  const g = canvas.getContext("2d")!;
  const font = "bold 12px sans-serif";
  g.font = font;
  const width = Math.ceil(g.measureText(text).width) + 2 * BEYOND;
  [canvas.width, canvas.height] = [Math.ceil(width * sharp), Math.ceil(HIGH * sharp)];
  g.scale(sharp, sharp);
  Object.assign(g, { font, textAlign: "center", textBaseline: "middle", lineJoin: "round" });
  const x = width / 2;
  const y = HIGH / 2;
  Object.assign(g, { strokeStyle: "#000c", lineWidth: 3, fillStyle: "#0009" });
  if (isOnBall) g.strokeText(text, x, y);
  else g.roundRect(1, y - 7.5, width - 2, 14, 7);
  g.fill();
  g.fillStyle = "#fff";
  g.fillText(text, x, y);
  const picture = { canvas, width };
  labelPictures.set(key, picture);
  return picture;
}
/**
 * The label of each ball, upright, so that one can name a ball however it has turned and however
 * small it is drawn. A number stands beside its ball, which bears it too; of a ball that has no
 * room for it between others there is none.
 */
export function drawLabels(
  { g, scale, place }: Pen,
  balls: readonly { state: Pick<ShotBall["state"], "r" | "label">; kind: ShotBall["kind"] }[],
  labels: readonly string[],
): void {
  const sharp = g.getTransform().a;
  const write = (text: string, x: number, y: number, isOnBall = false): void => {
    const { canvas, width } = labelPicture(text, sharp, isOnBall);
    const corner = [x - width / 2, y - HIGH / 2].map((c) => Math.round(c * sharp) / sharp);
    g.drawImage(canvas, corner[0]!, corner[1]!, width, HIGH);
  };
  // What a label does not cover: the middle and half the size of each ball, and of the labels
  // that are drawn already.
  const occupied = balls.flatMap(({ state, kind }) =>
    onTable(state)
      ? [[...place(state.r[0], state.r[1]), kind.radius * scale, kind.radius * scale]]
      : [],
  );
  balls.forEach(({ state, kind }, k) => {
    const label = labels[k] ?? "";
    if (label === "" || !onTable(state)) return;
    const [x, y] = place(state.r[0], state.r[1]);
    const radius = kind.radius * scale;
    if (!(Number(label) > 0) && radius >= ROOM) return write(label, x, y + 0.5, true);
    const half = labelPicture(label, sharp).width / 2 - BEYOND;
    const high = 5;
    const away = radius + 2;
    const neighbors = occupied.filter(([u, v]) => Math.abs(u! - x) < 80 && Math.abs(v! - y) < 80);
    // Of twelve positions around the ball, the one that covers least; the first is at the upper right.
    const covers = ([px, py]: readonly [number, number]): number =>
      neighbors.reduce(
        (sum, [u, v, bw, bh]) =>
          sum +
          Math.max(half + bw! - Math.abs(px - u!), 0) * Math.max(high + bh! - Math.abs(py - v!), 0),
        0,
      );
    const around = Array.from({ length: 12 }, (_, k) => ((1.5 + k) * Math.PI) / 6).map(
      (turn) => [x + (away + half) * Math.cos(turn), y - (away + high) * Math.sin(turn)] as const,
    );
    const best = around.reduce((best, candidate) =>
      covers(candidate) < covers(best) - 0.5 ? candidate : best,
    );
    if (covers(best) > 4) return;
    occupied.push([...best, half + 6, high]); // two labels are not read as one
    write(label, ...best);
  });
}
