// The dialog of a table from a photo: a picture, four corners, and the balls by taps; the layout
// lies on the table for practice.
import { colourOf } from "../../../player/words.js";
import { ARROWS, pixelsOf } from "../table/grip.js";
import { button, choice, dialog, drags, el, wrong } from "../ui.js";
import { type Camera, cameraOf, type Pixel, radiusAt, suggest } from "./photo.js";
import { discOf, snapCorners, snapDisc } from "./snap.js";
import { texts, told } from "../texts/texts.js";

const CORNERS = [texts.headLeft, texts.headRight, texts.footRight, texts.footLeft];
/** The noses of cushions, above the middles of balls, m. */
const LOWER = 0.008;
/** How near a mark is taken hold of, and how near a tap means it, CSS pixels. */
const REACH = 18;
const TAP = 8;
/** How far a finger may be off, and the radius of the magnifier, CSS pixels. */
const OFF = 3;
const LENS = 50;
/** The radius of the balls that may lie there, m. */
const POOL_BALL = 0.028575;

export interface Host {
  /** Names of the balls that may lie there, and the size of their table, m. */
  names: readonly string[];
  size: readonly [number, number];
  /** Where balls lie, by their numbers. */
  use(balls: Map<number, readonly [number, number]>): void;
}

/**
 * The picture with its marks: corners, and balls by their numbers; where the cross of the keys is,
 * and the mark that is held.
 */
interface Photo {
  readonly host: Host;
  readonly canvas: HTMLCanvasElement;
  readonly inputs: Record<"wide" | "long", HTMLInputElement>;
  readonly ball: HTMLSelectElement;
  readonly done: HTMLButtonElement;
  readonly said: HTMLElement;
  readonly ask: HTMLElement;
  picture: ImageBitmap | undefined;
  /** Its pixels, for what marks snap to. */
  pixels: ImageData | undefined;
  corners: Pixel[];
  /** Marks of balls; where the colour does not tell which one, those that it may be. */
  balls: { ball: number; at: Pixel; candidates?: number[] | undefined }[];
  cross: Pixel;
  held: ((at: Pixel) => void) | undefined;
}

/** Pixels of the picture for a pixel of the page. */
const scaleOf = ({ picture, canvas }: Photo): number =>
  picture ? picture.width / Math.max(canvas.getBoundingClientRect().width, 1) : 1;
/** Width and length of the table of the photo, m. */
const sizeOf = ({ inputs }: Photo): Pixel => [inputs.wide.valueAsNumber, inputs.long.valueAsNumber];
const cameraOn = (p: Photo): Camera | undefined =>
  p.picture && p.corners.length === 4
    ? cameraOf([p.picture.width, p.picture.height], p.corners, sizeOf(p), LOWER)
    : undefined;

/** What is to be marked next. */
function wordsOfMarks(corners: number, balls: number): string {
  if (corners < 4) return texts.markTheCornerWhere(CORNERS[corners]);
  if (balls === 0) return texts.tapTheMiddleOf;
  return texts.anotherTapOnA(texts.ballsCounted(balls));
}

function draw(p: Photo): void {
  const { corners, balls, said } = p;
  const asked = balls.find(({ candidates }) => candidates);
  p.done.disabled = balls.length === 0 || asked !== undefined;
  const answers = (asked?.candidates ?? []).map((ball) =>
    button(told(p.host.names[ball]!), () => {
      Object.assign(asked!, { ball, candidates: undefined });
      draw(p);
    }),
  );
  p.ask.replaceChildren(...(asked ? [texts.whichBallHasThe, ...answers] : []));
  if (!p.picture) return void (said.textContent = texts.chooseOrTakeA);
  const g = p.canvas.getContext("2d")!;
  g.drawImage(p.picture, 0, 0);
  const unit = scaleOf(p);
  g.lineWidth = 2 * unit;
  g.strokeStyle = "#ffe28a";
  g.fillStyle = "#ffe28a";
  g.font = `bold ${15 * unit}px sans-serif`;
  const mark = ([x, y]: Pixel, text: string): void => {
    g.beginPath();
    g.arc(x, y, 7 * unit, 0, 7);
    g.moveTo(x - 11 * unit, y);
    g.lineTo(x + 11 * unit, y);
    g.moveTo(x, y - 11 * unit);
    g.lineTo(x, y + 11 * unit);
    g.stroke();
    const left = x > 0.7 * p.picture!.width;
    g.textAlign = left ? "end" : "start";
    g.fillText(text, x + (left ? -10 : 10) * unit, y - 8 * unit);
  };
  corners.forEach((at, k) => mark(at, CORNERS[k]!));
  try {
    const camera = cameraOn(p);
    const [w, l] = sizeOf(p);
    // The table as it was found, with its middle line.
    for (const line of camera
      ? ([
          [
            [0, 0],
            [w, 0],
            [w, l],
            [0, l],
            [0, 0],
          ],
          [
            [0, l / 2],
            [w, l / 2],
          ],
          [
            [w / 2, 0],
            [w / 2, l],
          ],
        ] as const)
      : []) {
      g.beginPath();
      line.forEach(([x, y], k) =>
        g[k === 0 ? "moveTo" : "lineTo"](...(camera!.pixel([x, y]) as [number, number])),
      );
      g.stroke();
    }
    said.textContent = wordsOfMarks(corners.length, balls.length);
  } catch (error) {
    said.textContent = wrong(error);
  }
  for (const one of balls) mark(one.at, one.candidates ? "?" : p.host.names[one.ball]!);
}
/** The picture around a finger, four times as large, above it, or below where there is no room. */
function magnify(p: Photo, [x, y]: Pixel): void {
  const g = p.canvas.getContext("2d")!;
  const unit = scaleOf(p);
  const lens = LENS * unit;
  const u = Math.min(Math.max(x, lens), p.canvas.width - lens);
  const v = y > 2.6 * lens ? y - 1.6 * lens : y + 1.6 * lens;
  g.save();
  g.beginPath();
  g.arc(u, v, lens, 0, 7);
  g.fill();
  g.clip();
  g.drawImage(
    p.picture!,
    x - lens / 4,
    y - lens / 4,
    lens / 2,
    lens / 2,
    u - lens,
    v - lens,
    2 * lens,
    2 * lens,
  );
  g.strokeRect(u - lens, v, 2 * lens, 0);
  g.strokeRect(u, v - lens, 0, 2 * lens);
  g.restore();
  g.stroke();
}

/** The ball of a tap: the one that was chosen, or the free ones that its colour suggests. */
function ballAt(p: Photo, at: Pixel): number[] {
  const { names } = p.host;
  const free = names.map((_, k) => k).filter((k) => !p.balls.some((one) => one.ball === k));
  const asked = Number(p.ball.value);
  if (p.ball.value !== "auto" && free.includes(asked)) {
    p.ball.value = "auto";
    return [asked];
  }
  const candidates = suggest(
    discOf(p.pixels!, at, radiusAt(cameraOn(p)!, at)),
    names.slice(1, 9).map((name, k) => colourOf(name, k + 1, POOL_BALL)),
  );
  const left = candidates.filter((one) => free.includes(one));
  // Stripe for solid, else the next that is free.
  const [first = -1] = candidates;
  return left.length > 0
    ? left
    : [[first > 8 ? first - 8 : first + 8, ...free].find((one) => free.includes(one)) ?? -1];
}
function tap(p: Photo, at: Pixel): void {
  if (!p.picture) return;
  if (p.corners.length < 4) {
    p.corners.push(at);
    if (p.corners.length === 4) snap(p);
  } else {
    const to = snapped(p, at);
    const [ball, ...others] = ballAt(p, to);
    if (ball! >= 0)
      p.balls.push({
        ball: ball!,
        at: to,
        candidates: others.length > 0 ? [ball!, ...others] : undefined,
      });
  }
  draw(p);
}
/** Moves the corners to the edge of the cloth, and a mark to the disc that it is on. */
function snap(p: Photo): void {
  try {
    const to = snapCorners(p.pixels!, p.corners, 1.2 * OFF * scaleOf(p), sizeOf(p));
    cameraOf([p.picture!.width, p.picture!.height], to, sizeOf(p));
    p.corners = to;
  } catch {
    return; // the marks are no table yet: draw() says so
  }
}
const snapped = (p: Photo, at: Pixel): Pixel =>
  snapDisc(p.pixels!, at, radiusAt(cameraOn(p)!, at), OFF * scaleOf(p));
/** Gives the places of the balls, where all lie on the table; tells whether they do. */
function finish(p: Photo): boolean {
  const { size, names, use } = p.host;
  const camera = cameraOn(p);
  if (!camera) return false;
  // A table of another size: the same shares of width and length.
  const [sx, sy] = [0, 1].map((k) => size[k]! / sizeOf(p)[k]!) as [number, number];
  const places = p.balls.map((one) => {
    const [x, y] = camera.place(one.at);
    return [one.ball, [x * sx, y * sy] as const] as const;
  });
  const out = places.find(
    ([, [x, y]]) => !(x > -0.03 && x < size[0] + 0.03 && y > -0.03 && y < size[1] + 0.03),
  );
  if (out) p.said.textContent = texts.ballLiesOutsideOf(told(names[out[0]]!));
  else use(new Map(places));
  return !out;
}

/** A pointer takes hold of a mark, or of a new one, and shows what is under it. */
function down(p: Photo, at: Pixel): void {
  const {
    canvas,
    host: { names },
  } = p;
  const near = ([x, y]: Pixel): boolean => Math.hypot(x - at[0], y - at[1]) < REACH * scaleOf(p);
  const corner = p.corners.findIndex(near);
  const one = p.balls.find(({ at }) => near(at));
  let moved = false;
  let last = at;
  p.held = (to) => {
    moved ||= Math.hypot(to[0] - at[0], to[1] - at[1]) > 4 * scaleOf(p);
    last = to;
    if (moved && one) one.at = to;
    else if (moved && corner >= 0) p.corners[corner] = to;
    draw(p);
    if (p.picture) magnify(p, to);
  };
  p.held(at);
  const up = (): void => {
    const held = p.held;
    p.held = undefined;
    if (!held) return draw(p); // a second finger came
    // What is dragged stays where it was put, which mends what snapped to something else. A tap
    // beside a mark is another ball.
    if (!moved && one && Math.hypot(one.at[0] - at[0], one.at[1] - at[1]) < TAP * scaleOf(p))
      Object.assign(one, {
        candidates: undefined,
        ball: names
          .map((_, k) => (one.ball + 1 + k) % names.length)
          .find((k) => !p.balls.some((other) => other !== one && other.ball === k))!,
      });
    else if (!moved || !(one || corner >= 0)) return tap(p, last);
    draw(p);
  };
  canvas.addEventListener("pointerup", up, { once: true });
}
/** Two fingers show a part of the photo larger, and the place between them stays there. */
function pinches(p: Photo): void {
  const { canvas } = p;
  const fingers = new Map<number, Pixel>();
  let zoom = 1;
  let x = 0;
  let y = 0;
  const both = (): [number, number, number] => {
    const [a, b] = [...fingers.values()] as [Pixel, Pixel];
    return [Math.hypot(a[0] - b[0], a[1] - b[1]), (a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
  };
  canvas.addEventListener(
    "pointerdown",
    ({ pointerId, clientX, clientY }) => {
      fingers.set(pointerId, [clientX, clientY]);
      if (fingers.size > 1) p.held = undefined;
    },
    true,
  );
  canvas.addEventListener("pointermove", ({ pointerId, clientX, clientY }) => {
    if (!fingers.has(pointerId)) return;
    if (fingers.size !== 2) return void fingers.set(pointerId, [clientX, clientY]);
    const [far, ...from] = both();
    fingers.set(pointerId, [clientX, clientY]);
    const [now, ...to] = both();
    const frame = canvas.parentElement!.getBoundingClientRect();
    const more = Math.min(Math.max((zoom * now) / far, 1), 6) / zoom;
    zoom *= more;
    const stay = (at: number, start: number, k: number, size: number): number =>
      Math.min(Math.max(to[k]! - start - (from[k]! - start - at) * more, size * (1 - zoom)), 0);
    [x, y] = [
      stay(x, frame.left, 0, canvas.clientWidth),
      stay(y, frame.top, 1, canvas.clientHeight),
    ];
    canvas.style.transform = `translate(${x}px, ${y}px) scale(${zoom})`;
    draw(p);
  });
  for (const type of ["pointerup", "pointercancel"] as const)
    canvas.addEventListener(type, ({ pointerId }) => fingers.delete(pointerId));
}
function key(p: Photo, event: KeyboardEvent): void {
  const arrow = ARROWS[event.key];
  if (!p.picture || (!arrow && event.key !== "Enter")) return;
  event.preventDefault();
  const unit = scaleOf(p);
  const by = (event.shiftKey ? 20 : 2) * unit;
  if (!arrow) return tap(p, p.cross);
  p.cross = [
    Math.min(Math.max(p.cross[0] + by * arrow[0], 0), p.picture.width),
    Math.min(Math.max(p.cross[1] + by * arrow[1], 0), p.picture.height),
  ];
  draw(p);
  const g = p.canvas.getContext("2d")!;
  g.strokeStyle = "#fff";
  g.strokeRect(p.cross[0] - 6 * unit, p.cross[1] - 6 * unit, 12 * unit, 12 * unit);
}
async function open(p: Photo, given: File): Promise<void> {
  try {
    p.picture = await createImageBitmap(given);
  } catch {
    return void (p.said.textContent = texts.thisBrowserCannotRead(given.name));
  }
  const { width, height } = p.picture;
  [p.canvas.width, p.canvas.height] = [width, height];
  [p.corners, p.balls, p.cross] = [[], [], [width / 2, height / 2]];
  const g = p.canvas.getContext("2d", { willReadFrequently: true })!;
  g.drawImage(p.picture, 0, 0);
  p.pixels = g.getImageData(0, 0, width, height);
  draw(p);
}

export function photoPage(host: Host): { root: HTMLDialogElement; open(): void } {
  const number = (
    id: string,
    text: string,
    value: number,
  ): { root: HTMLElement; input: HTMLInputElement } => {
    const input = el("input", {
      type: "number",
      id,
      min: "1",
      max: "4",
      step: "0.01",
      value: String(value),
    });
    input.addEventListener("change", () => draw(p));
    return { root: el("label", { class: "inline" }, text, input), input };
  };
  const canvas = el("canvas", {
    id: "photo",
    tabindex: "0",
    role: "img",
    "aria-label": texts.thePhotoArrowKeys,
  });
  const file = el("input", {
    type: "file",
    id: "photo-file",
    accept: "image/*",
    "aria-label": texts.aPhotoOfA,
  });
  const wide = number("photo-width", texts.widthM, host.size[0]);
  const long = number("photo-length", texts.lengthM, host.size[1]);
  const ball = choice(
    "photo-ball",
    texts.nextBall,
    [
      ["auto", texts.byItsColour],
      ...host.names.map(
        (name, k) => [String(k), name === "cue" ? texts.cueBallName : told(name)] as const,
      ),
    ],
    () => undefined,
  );
  const done = button(texts.layTheBalls, () => finish(p) && root.close(), {
    id: "photo-use",
    class: "main",
  });
  const said = el("p", { id: "photo-said", role: "status" });
  const ask = el("div", { id: "photo-ask", class: "row", role: "status" });
  const p: Photo = {
    host,
    canvas,
    done,
    said,
    ask,
    pixels: undefined,
    ball: ball.select,
    inputs: { wide: wide.input, long: long.input },
    picture: undefined,
    corners: [],
    balls: [],
    cross: [0, 0],
    held: undefined,
  };
  const back = (): void => {
    (p.balls.length > 0 ? p.balls : p.corners).pop();
    draw(p);
  };
  const root = dialog(
    "photo-page",
    texts.aTableFromA,
    el("div", { class: "row" }, file, wide.root, long.root),
    said,
    el("div", { class: "photo-frame" }, canvas),
    ask,
    el(
      "div",
      { class: "row" },
      ball.root,
      button(texts.takeBack, back, { id: "photo-back" }),
      done,
    ),
  );

  const pixel = (event: PointerEvent): Pixel =>
    pixelsOf(canvas, event).map((x) => x * scaleOf(p)) as [number, number];
  drags(
    canvas,
    (event, first) => event.isPrimary && (first ? down(p, pixel(event)) : p.held?.(pixel(event))),
  );
  pinches(p);
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
