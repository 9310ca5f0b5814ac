// The dialog that reads a table from a photo: the player marks four corners and the balls, and the
// layout is set up for practice.
import { colourOf } from "../../../player/words.js";
import { ARROWS, pixelsOf } from "../table/grip.js";
import { button, choice, dialog, drags, el, wrong } from "../ui.js";
import { type Camera, cameraOf, type Pixel, suggest } from "./photo.js";
import { pinches } from "./pinch.js";
import { ballsSeen, discOf, snapDisc, snapTable } from "./snap.js";
import { texts, translate } from "../texts/texts.js";

const CORNERS = [texts.headLeft, texts.headRight, texts.footRight, texts.footLeft];
/** The noses of cushions, above the middles of balls, m. */
const LOWER = 0.008;
/** How near a mark is taken hold of, and how near a tap means it, CSS pixels. */
const REACH = 18;
const TAP = 8;
/** How far a finger may be off, and the radius of the magnifier, CSS pixels. */
const OFF = 3;
const LENS = 50;
/** Wider pictures become so wide, pixels: edges are looked for within some pixels. */
const WIDE = 1600;
/** The radius of the balls that may lie there, m. */
const POOL_BALL = 0.028575;

interface Host {
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
  readonly message: HTMLElement;
  readonly ask: HTMLElement;
  picture: ImageBitmap | undefined;
  /** Its pixels, for what marks snap to. */
  pixels: ImageData | undefined;
  corners: Pixel[];
  /** From the lines of the table near the corners, or only from the corners if none are seen. */
  camera: Camera | undefined;
  /** Where balls seem to lie that have no mark. */
  unmarked: Pixel[];
  /** Marks of balls; where the colour is ambiguous, the candidates. */
  balls: { ball: number; pixel: Pixel; candidates?: number[] | undefined }[];
  cross: Pixel;
  held: ((pixel: Pixel) => void) | undefined;
}

/** Pixels of the photo per pixel of the page. */
const scaleOf = ({ picture, canvas }: Photo): number =>
  picture ? picture.width / Math.max(canvas.getBoundingClientRect().width, 1) : 1;
/** Width and length of the table of the photo, m. */
const sizeOf = ({ inputs }: Photo): Pixel => [inputs.wide.valueAsNumber, inputs.long.valueAsNumber];
const cameraOn = (p: Photo): Camera | undefined =>
  p.camera ??
  (p.picture && p.corners.length === 4
    ? cameraOf([p.picture.width, p.picture.height], p.corners, sizeOf(p), LOWER)
    : undefined);

/** What is to be marked next. */
function wordsOfMarks({ corners, balls, camera, unmarked }: Photo): string {
  if (corners.length < 4) return texts.markTheCornerWhere(CORNERS[corners.length]);
  const { length } = balls;
  const words =
    length === 0 ? texts.tapTheMiddleOf : texts.anotherTapOnA(texts.ballsCounted(length));
  if (!camera) return `${texts.noLinesOfThe} ${words}`;
  return unmarked.length > 0 ? `${words} ${texts.moreBallsSeem(unmarked.length)}` : words;
}

function draw(p: Photo): void {
  const { corners, balls, message } = p;
  const unsure = balls.find(({ candidates }) => candidates);
  p.done.disabled = balls.length === 0 || unsure !== undefined;
  const answers = (unsure?.candidates ?? []).map((ball) =>
    button(translate(p.host.names[ball]!), () => {
      Object.assign(unsure!, { ball, candidates: undefined });
      draw(p);
    }),
  );
  p.ask.replaceChildren(...(unsure ? [texts.whichBallHasThe, ...answers] : []));
  if (!p.picture) return void (message.textContent = texts.chooseOrTakeA);
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
  corners.forEach((pixel, k) => mark(pixel, CORNERS[k]!));
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
    message.textContent = wordsOfMarks(p);
  } catch (error) {
    message.textContent = wrong(error);
  }
  g.setLineDash([4 * unit, 4 * unit]);
  for (const [x, y] of p.unmarked) {
    g.beginPath();
    g.arc(x, y, 11 * unit, 0, 7);
    g.stroke();
  }
  g.setLineDash([]);
  for (const ball of balls) mark(ball.pixel, ball.candidates ? "?" : p.host.names[ball.ball]!);
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
function ballAt(p: Photo, pixel: Pixel): number[] {
  const { names } = p.host;
  const free = names.map((_, k) => k).filter((k) => !p.balls.some((placed) => placed.ball === k));
  const choice = Number(p.ball.value);
  if (p.ball.value !== "auto" && free.includes(choice)) {
    p.ball.value = "auto";
    return [choice];
  }
  const candidates = suggest(
    discOf(p.pixels!, pixel, cameraOn(p)!.outline(pixel, POOL_BALL)),
    names.slice(1, 9).map((name, k) => colourOf(name, k + 1, POOL_BALL)),
  );
  const left = candidates.filter((candidate) => free.includes(candidate));
  // Stripe for solid, else the next that is free.
  const [first = -1] = candidates;
  return left.length > 0
    ? left
    : [
        [first > 8 ? first - 8 : first + 8, ...free].find((candidate) =>
          free.includes(candidate),
        ) ?? -1,
      ];
}
function tap(p: Photo, pixel: Pixel): void {
  if (!p.picture) return;
  if (p.corners.length < 4) {
    p.corners.push(pixel);
    if (p.corners.length === 4) snap(p);
  } else {
    const target = snapped(p, pixel);
    const [ball, ...others] = ballAt(p, target);
    if (ball! < 0) return void (p.message.textContent = texts.allBallsAreMarked);
    p.balls.push({
      ball: ball!,
      pixel: target,
      candidates: others.length > 0 ? [ball!, ...others] : undefined,
    });
    look(p);
  }
  draw(p);
}
/** Looks for balls that have no mark. */
function look(p: Photo): void {
  const marks = p.balls.map(({ pixel }) => pixel);
  p.unmarked = p.camera ? ballsSeen(p.pixels!, p.camera, sizeOf(p), POOL_BALL, marks) : [];
}
/** Finds the camera by the lines of the table near the corners, which move to their noses. */
function snap(p: Photo): void {
  try {
    const reach = 1.2 * OFF * scaleOf(p);
    const found = snapTable(p.pixels!, p.corners, reach, sizeOf(p), LOWER);
    p.camera = found?.camera;
    if (found) p.corners = found.corners;
  } catch {
    p.camera = undefined; // the marks do not form a table yet: draw() reports it
  }
  look(p);
}
/** The middle of the ball at a pixel: of the nearest one that was seen, which a finger means. */
function snapped(p: Photo, pixel: Pixel): Pixel {
  const farOf = ([x, y]: Pixel): number => Math.hypot(x - pixel[0], y - pixel[1]);
  const reach = OFF * scaleOf(p);
  const seen = p.unmarked.reduce((best, one) => (farOf(one) < farOf(best) ? one : best), [
    Infinity,
    0,
  ] as Pixel);
  const start = farOf(seen) < 1.5 * reach ? seen : pixel;
  return snapDisc(
    p.pixels!,
    start,
    cameraOn(p)!.outline(start, POOL_BALL),
    start === seen ? reach / 2 : reach,
  );
}
/** Passes on the positions of the balls if all are on the table; returns whether they are. */
function finish(p: Photo): boolean {
  const { size, names, use } = p.host;
  const camera = cameraOn(p);
  if (!camera) return false;
  // A table of another size: the same fractions of width and length.
  const [sx, sy] = [0, 1].map((k) => size[k]! / sizeOf(p)[k]!) as [number, number];
  const places = p.balls.map((ball) => {
    const [x, y] = camera.place(ball.pixel);
    return [ball.ball, [x * sx, y * sy] as const] as const;
  });
  const out = places.find(
    ([, [x, y]]) => !(x > -0.03 && x < size[0] + 0.03 && y > -0.03 && y < size[1] + 0.03),
  );
  if (out) p.message.textContent = texts.ballLiesOutsideOf(translate(names[out[0]]!));
  else use(new Map(places));
  return !out;
}

/** A pointer takes hold of a mark, or of a new one, and shows what is under it. */
function down(p: Photo, touched: Pixel): void {
  const {
    canvas,
    host: { names },
  } = p;
  const farOf = ([x, y]: Pixel): number => Math.hypot(x - touched[0], y - touched[1]);
  const isNear = (pixel: Pixel): boolean => farOf(pixel) < REACH * scaleOf(p);
  const corner = p.corners.findIndex(isNear);
  // The nearest one, if no ball without a mark is nearer.
  const [ball] = p.balls
    .filter(({ pixel }) => isNear(pixel) && p.unmarked.every((seen) => farOf(seen) > farOf(pixel)))
    .sort((a, b) => farOf(a.pixel) - farOf(b.pixel));
  let moved = false;
  let last = touched;
  p.held = (target) => {
    moved ||= Math.hypot(target[0] - touched[0], target[1] - touched[1]) > 4 * scaleOf(p);
    last = target;
    if (moved && ball) ball.pixel = target;
    else if (moved && corner >= 0) {
      p.corners[corner] = target;
      p.camera = undefined;
    }
    draw(p);
    if (p.picture) magnify(p, target);
  };
  p.held(touched);
  const up = (): void => {
    const held = p.held;
    p.held = undefined;
    if (!held) return draw(p); // a second finger touched
    // What is dragged stays where it was put, which mends what snapped to something else. A tap
    // beside a mark is another ball.
    if (!moved && ball && farOf(ball.pixel) < TAP * scaleOf(p))
      Object.assign(ball, {
        candidates: undefined,
        ball: names
          .map((_, k) => (ball.ball + 1 + k) % names.length)
          .find((k) => !p.balls.some((second) => second !== ball && second.ball === k))!,
      });
    else if (!moved || !(ball || corner >= 0)) return tap(p, last);
    else if (!ball && p.corners.length === 4) snap(p);
    look(p);
    draw(p);
  };
  canvas.addEventListener("pointerup", up, { once: true });
}
function key(p: Photo, event: KeyboardEvent): void {
  const arrow = ARROWS[event.key];
  if (!p.picture || (!arrow && event.key !== "Enter")) return;
  event.preventDefault();
  const unit = scaleOf(p);
  const step = (event.shiftKey ? 20 : 2) * unit;
  if (!arrow) return tap(p, p.cross);
  p.cross = [
    Math.min(Math.max(p.cross[0] + step * arrow[0], 0), p.picture.width),
    Math.min(Math.max(p.cross[1] + step * arrow[1], 0), p.picture.height),
  ];
  draw(p);
  const g = p.canvas.getContext("2d")!;
  g.strokeStyle = "#fff";
  g.strokeRect(p.cross[0] - 6 * unit, p.cross[1] - 6 * unit, 12 * unit, 12 * unit);
}
async function open(p: Photo, file: File): Promise<void> {
  try {
    const whole = await createImageBitmap(file);
    const size = { resizeWidth: Math.min(whole.width, WIDE), resizeQuality: "high" } as const;
    p.picture = await createImageBitmap(whole, size);
  } catch {
    return void (p.message.textContent = texts.thisBrowserCannotRead(file.name));
  }
  const { width, height } = p.picture;
  [p.canvas.width, p.canvas.height] = [width, height];
  [p.corners, p.balls, p.cross] = [[], [], [width / 2, height / 2]];
  [p.camera, p.unmarked] = [undefined, []];
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
    input.addEventListener("change", () => {
      if (p.corners.length === 4) snap(p);
      draw(p);
    });
    return { root: el("label.inline", text, input), input };
  };
  const canvas = el("canvas#photo", {
    tabindex: "0",
    role: "img",
    "aria-label": texts.thePhotoArrowKeys,
  });
  const file = el("input#photo-file", {
    type: "file",
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
        (name, k) => [String(k), name === "cue" ? texts.cueBallName : translate(name)] as const,
      ),
    ],
    () => undefined,
  );
  const done = button(texts.layTheBalls, () => finish(p) && root.close(), "#photo-use.main");
  const message = el("p#photo-said", { role: "status" });
  const ask = el("div#photo-ask.row", { role: "status" });
  const p: Photo = {
    host,
    canvas,
    done,
    message,
    ask,
    pixels: undefined,
    ball: ball.select,
    inputs: { wide: wide.input, long: long.input },
    picture: undefined,
    corners: [],
    camera: undefined,
    unmarked: [],
    balls: [],
    cross: [0, 0],
    held: undefined,
  };
  const back = (): void => {
    if (p.balls.length === 0) p.camera = undefined;
    (p.balls.length > 0 ? p.balls : p.corners).pop();
    look(p);
    draw(p);
  };
  const root = dialog(
    "photo-page",
    texts.aTableFromA,
    el("div.row", file, wide.root, long.root),
    el("div.photo-frame", canvas),
    message,
    ask,
    el("div.row", ball.root, button(texts.takeBack, back, "#photo-back"), done),
  );

  const pixel = (event: PointerEvent): Pixel =>
    pixelsOf(canvas, event).map((x) => x * scaleOf(p)) as [number, number];
  drags(
    canvas,
    (event, first) => event.isPrimary && (first ? down(p, pixel(event)) : p.held?.(pixel(event))),
  );
  pinches(
    canvas,
    () => (p.held = undefined),
    () => draw(p),
  );
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
