// The dialog of a table from a photo: a picture, four corners, and the balls by taps; the layout lies on the table for practice.
import { colourOf } from "../../../player/words.js";
import { ARROWS, pixelsOf } from "../table/grip.js";
import { button, choice, dialog, drags, el, wrong } from "../ui.js";
import { type Camera, cameraOf, type Pixel, suggest } from "./photo.js";

const CORNERS = ["head left", "head right", "foot right", "foot left"];
/** The noses of cushions, above the middles of balls, m. */
const LOWER = 0.008;
/** How near a mark is taken hold of, and how near a tap means it, CSS pixels. */
const [REACH, TAP] = [18, 8];

export interface Host {
  /** Names of the balls that may lie there, and the size of their table, m. */
  names: readonly string[];
  size: readonly [number, number];
  /** Where balls lie, by their numbers. */
  use(balls: Map<number, readonly [number, number]>): void;
}

/** The picture with its marks: corners, and balls by their numbers; where the cross of the keys is, and the mark that is held. */
interface Photo {
  readonly host: Host;
  readonly canvas: HTMLCanvasElement;
  readonly inputs: Record<"wide" | "long", HTMLInputElement>;
  readonly ball: HTMLSelectElement;
  readonly done: HTMLButtonElement;
  readonly said: HTMLElement;
  picture: ImageBitmap | undefined;
  corners: Pixel[];
  balls: { ball: number; at: Pixel }[];
  cross: Pixel;
  held: ((at: Pixel) => void) | undefined;
}

/** Pixels of the picture for a pixel of the page. */
const scaleOf = ({ picture, canvas }: Photo): number => (picture ? picture.width / Math.max(canvas.clientWidth, 1) : 1);
/** Width and length of the table of the photo, m. */
const sizeOf = ({ inputs }: Photo): Pixel => [inputs.wide.valueAsNumber, inputs.long.valueAsNumber];
const cameraOn = (p: Photo): Camera | undefined => (p.picture && p.corners.length === 4 ? cameraOf([p.picture.width, p.picture.height], p.corners, sizeOf(p), LOWER) : undefined);

function draw(p: Photo): void {
  const { corners, balls, said } = p;
  p.done.disabled = balls.length === 0;
  if (!p.picture) return void (said.textContent = "Choose or take a photo in which all four corners are seen.");
  const g = p.canvas.getContext("2d")!;
  g.drawImage(p.picture, 0, 0);
  const unit = scaleOf(p);
  g.lineWidth = 2 * unit;
  g.strokeStyle = g.fillStyle = "#ffe28a";
  g.font = `bold ${15 * unit}px sans-serif`;
  const mark = ([x, y]: Pixel, text: string): void => {
    g.beginPath();
    g.arc(x, y, 7 * unit, 0, 7);
    g.moveTo(x - 11 * unit, y);
    g.lineTo(x + 11 * unit, y);
    g.moveTo(x, y - 11 * unit);
    g.lineTo(x, y + 11 * unit);
    g.stroke();
    g.fillText(text, x + 10 * unit, y - 8 * unit);
  };
  corners.forEach((at, k) => mark(at, CORNERS[k]!));
  try {
    const of = cameraOn(p);
    const [w, l] = sizeOf(p);
    // The table as it was found, with its middle line.
    for (const line of of ? [[[0, 0], [w, 0], [w, l], [0, l], [0, 0]], [[0, l / 2], [w, l / 2]], [[w / 2, 0], [w / 2, l]]] as const : []) {
      g.beginPath();
      line.forEach(([x, y], k) => g[k === 0 ? "moveTo" : "lineTo"](...(of!.pixel([x, y]) as [number, number])));
      g.stroke();
    }
    said.textContent = corners.length < 4 ? `Mark the corner ${CORNERS[corners.length]}, where the noses of the cushions would meet. The head is where one breaks.` : balls.length === 0 ? "Tap the middle of each ball. Marks can be dragged." : `${balls.length} ${balls.length === 1 ? "ball" : "balls"}. Another tap on a mark of a ball takes the next number.`;
  } catch (error) {
    said.textContent = wrong(error);
  }
  for (const one of balls) mark(one.at, p.host.names[one.ball]!);
}

/** The ball of a tap: the one that was chosen, or the free one that its colour suggests. */
function ballAt(p: Photo, [x, y]: Pixel): number {
  const { names } = p.host;
  const free = names.map((_, k) => k).filter((k) => !p.balls.some((one) => one.ball === k));
  const asked = Number(p.ball.value);
  if (p.ball.value !== "auto" && free.includes(asked)) {
    p.ball.value = "auto";
    return asked;
  }
  // Half of the ball's radius: around it is cloth.
  const of = cameraOn(p)!;
  const [px, py] = of.place([x, y]);
  const edge = of.pixel([px + 0.014, py]);
  const reach = Math.max(Math.round(0.7 * Math.hypot(edge[0] - x, edge[1] - y)), 2);
  const copy = document.createElement("canvas").getContext("2d")!;
  copy.drawImage(p.picture!, -x + reach, -y + reach);
  const first = suggest(copy.getImageData(0, 0, 2 * reach, 2 * reach).data, names.slice(1, 9).map((name, k) => colourOf(name, k + 1)));
  // Stripe for solid, else the next that is free.
  return [first, first > 8 ? first - 8 : first + 8, ...free].find((one) => free.includes(one)) ?? -1;
}
function tap(p: Photo, at: Pixel): void {
  if (!p.picture) return;
  if (p.corners.length < 4) p.corners.push(at);
  else {
    const which = ballAt(p, at);
    if (which >= 0) p.balls.push({ ball: which, at });
  }
  draw(p);
}
/** Gives the places of the balls, where all lie on the table; tells whether they do. */
function finish(p: Photo): boolean {
  const { size, names, use } = p.host;
  const of = cameraOn(p);
  if (!of) return false;
  // A table of another size: the same shares of width and length.
  const [sx, sy] = [0, 1].map((k) => size[k]! / sizeOf(p)[k]!) as [number, number];
  const places = p.balls.map((one) => {
    const [x, y] = of.place(one.at);
    return [one.ball, [x * sx, y * sy] as const] as const;
  });
  const out = places.find(([, [x, y]]) => !(x > -0.03 && x < size[0] + 0.03 && y > -0.03 && y < size[1] + 0.03));
  if (out) p.said.textContent = `Ball ${names[out[0]]} lies outside of the table: drag its mark, or those of the corners.`;
  else use(new Map(places));
  return !out;
}

/** A pointer takes hold of a mark, or taps. */
function down(p: Photo, at: Pixel): void {
  const { canvas, host: { names } } = p;
  const near = ([x, y]: Pixel): boolean => Math.hypot(x - at[0], y - at[1]) < REACH * scaleOf(p);
  const [corner, one] = [p.corners.findIndex(near), p.balls.find(({ at }) => near(at))];
  let moved = false;
  p.held = (to) => {
    moved ||= Math.hypot(to[0] - at[0], to[1] - at[1]) > 4 * scaleOf(p);
    if (!moved) return;
    if (one) one.at = to;
    else if (corner >= 0) p.corners[corner] = to;
    draw(p);
  };
  const up = (): void => {
    p.held = undefined;
    if (moved) return;
    // A tap beside a mark is another ball.
    if (!one || Math.hypot(one.at[0] - at[0], one.at[1] - at[1]) >= TAP * scaleOf(p)) return tap(p, at);
    one.ball = names.map((_, k) => (one.ball + 1 + k) % names.length).find((k) => !p.balls.some((other) => other !== one && other.ball === k))!;
    draw(p);
  };
  canvas.addEventListener("pointerup", up, { once: true });
}
function key(p: Photo, event: KeyboardEvent): void {
  const arrow = ARROWS[event.key];
  if (!p.picture || (!arrow && event.key !== "Enter")) return;
  event.preventDefault();
  const unit = scaleOf(p);
  const by = (event.shiftKey ? 20 : 2) * unit;
  if (!arrow) return tap(p, p.cross);
  p.cross = [Math.min(Math.max(p.cross[0] + by * arrow[0], 0), p.picture.width), Math.min(Math.max(p.cross[1] + by * arrow[1], 0), p.picture.height)];
  draw(p);
  const g = p.canvas.getContext("2d")!;
  g.strokeStyle = "#fff";
  g.strokeRect(p.cross[0] - 6 * unit, p.cross[1] - 6 * unit, 12 * unit, 12 * unit);
}
async function open(p: Photo, given: File): Promise<void> {
  try {
    p.picture = await createImageBitmap(given);
  } catch {
    return void (p.said.textContent = `This browser cannot read ${given.name} as a picture.`);
  }
  const { width, height } = p.picture;
  [p.canvas.width, p.canvas.height] = [width, height];
  [p.corners, p.balls, p.cross] = [[], [], [width / 2, height / 2]];
  draw(p);
}

export function photoPage(host: Host): { root: HTMLDialogElement; open(): void } {
  const number = (id: string, text: string, value: number): { root: HTMLElement; input: HTMLInputElement } => {
    const input = el("input", { type: "number", id, min: "1", max: "4", step: "0.01", value: String(value) });
    input.addEventListener("change", () => draw(p));
    return { root: el("label", { class: "inline" }, text, input), input };
  };
  const canvas = el("canvas", { id: "photo", tabindex: "0", role: "img", "aria-label": "The photo. Arrow keys move the cross, Enter marks." });
  const file = el("input", { type: "file", id: "photo-file", accept: "image/*", "aria-label": "A photo of a table" });
  const [wide, long] = [number("photo-width", "Width, m", host.size[0]), number("photo-length", "Length, m", host.size[1])];
  const ball = choice("photo-ball", "Next ball", [["auto", "by its colour"], ...host.names.map((name, k) => [String(k), name === "cue" ? "cue ball" : name] as const)], () => undefined);
  const done = button("Lay the balls", () => finish(p) && root.close(), { id: "photo-use", class: "main" });
  const said = el("p", { id: "photo-said", role: "status" });
  const p: Photo = { ...{ host, canvas, done, said, ball: ball.select, inputs: { wide: wide.input, long: long.input } }, picture: undefined, corners: [], balls: [], cross: [0, 0], held: undefined };
  const back = (): void => {
    (p.balls.length > 0 ? p.balls : p.corners).pop();
    draw(p);
  };
  const root = dialog("photo-page", "A table from a photo", el("div", { class: "row" }, file, wide.root, long.root), said, canvas, el("div", { class: "row" }, ball.root, button("Take back", back, { id: "photo-back" }), done));

  const pixel = (event: PointerEvent): Pixel => pixelsOf(canvas, event).map((x) => x * scaleOf(p)) as [number, number];
  drags(canvas, (event, first) => (first ? down(p, pixel(event)) : p.held?.(pixel(event))));
  canvas.addEventListener("keydown", (event) => key(p, event));
  file.addEventListener("change", () => file.files?.[0] && void open(p, file.files[0]));
  return {
    root,
    open() {
      root.showModal();
      draw(p);
    },
  };
}
