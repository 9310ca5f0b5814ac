// The table as a scene: below the flat view, or instead of it from behind the cue. It starts after
// the first view. A browser without WebGL, or a device that is too slow, keeps the drawn table.
import type { Cue, Vec3 } from "carom";
import { trailsOf } from "../../../player/film.js";
import { colourOf } from "../../../player/words.js";
import type { FlatView, Pose } from "../../../player/words.js";
import { drawLabels, drawSketches, labelsOf, type Line, stickEnd } from "../table/drawing.js";
import { onTable } from "../table/filmed.js";
import { type Grip, pixelsOf, type Point } from "../table/grip.js";
import { drags, el, wrong } from "../ui.js";
import { linesOfAim, move, movable, READABLE, tap } from "./aim.js";
import { guessOf } from "./look.js";
import type { Scene } from "./scene.js";
import type { Session, SpaceView } from "./parts.js";
import { seenSketches } from "./sketches.js";
import { aimed, free, says } from "./session.js";
import type { Stick } from "./stick.js";
import { texts } from "../texts/texts.js";

const isStill = (): boolean => window.matchMedia("(prefers-reduced-motion: reduce)").matches;
/** How drivers are named that draw by the processor. */
const BY_PROCESSOR = /swiftshader|llvmpipe|software|basic render/i;
/** Whether the device has a graphics processor, by the name of its driver. */
function hasGraphics(): boolean {
  const gl = document.createElement("canvas").getContext("webgl2");
  const names = gl?.getExtension("WEBGL_debug_renderer_info");
  const driver = gl && names ? String(gl.getParameter(names.UNMASKED_RENDERER_WEBGL)) : "";
  gl?.getExtension("WEBGL_lose_context")?.loseContext();
  return gl !== null && !BY_PROCESSOR.test(driver);
}
/** How long a cue is drawn back, how long it then takes to its ball, ms, and how far back it goes, m. */
const BACK = 220;
const FORTH = 130;
const SWING = 0.09;
/** How long it follows the ball, s, and how far, m. */
const FOLLOW = 0.35;
const FOLLOWS = 0.12;
/** If a frame from above takes longer, the table stays drawn, ms. */
const TOO_SLOW = 70;
/** If so many frames of a film take longer than this on average, the scene becomes coarser, ms. */
const PICTURES = 40;
const SLOW = 30;
/** After this many losses the table stays drawn; and how soon after one the scene is made again, ms. */
const MOST_LOSSES = 3;
const AGAIN = 1000;
/** How high the eye may be behind the cue, m. */
const LOW = 0.16;
const HIGH = 1.3;

export class Space implements SpaceView {
  #module: typeof import("./scene.js") | undefined;
  #scene: Scene | undefined;
  /** What the scene was made of. */
  #parts = "";
  /** What is drawn over the scene: zones, and the labels of balls. */
  readonly #over = el("canvas.over-scene");
  isOn = false;
  /** Whether the flat view has the scene below it. */
  #isBelow = false;
  #isClosed = false;
  readonly #hasGraphics = hasGraphics();
  /** How often the browser took the scene away. */
  #losses = 0;
  /** Whether the cue ball is being moved. */
  #moves = false;
  /** The cue that strikes; `next` follows its contact. */
  #strike: (Omit<Stick, "gap"> & { start: number; next?: () => void }) | undefined;
  /** How high the eye is behind the cue, m; 0: as the screen's shape has it. */
  #height = 0;
  #lastPicture = 0;
  #wasAiming = false;
  #isGliding = false;
  #film = { count: 0, sum: 0, last: 0 };

  constructor(
    readonly s: Session,
    readonly felt: HTMLElement,
  ) {}

  get isLive(): boolean {
    return this.#isBelow || this.isOn;
  }
  get isStriking(): boolean {
    return this.#strike?.next !== undefined;
  }

  // ---- Beginning and end

  async prepare(): Promise<void> {
    const { film, settings } = this.s;
    const { view } = settings;
    this.#isBelow = false;
    try {
      if (view === "scene" || (view === "device" && this.#hasGraphics)) {
        await this.#start();
        this.#isBelow = settings.view === view && !this.#isClosed;
        film.draw();
        if (view === "device" && this.#scene!.measure() > TOO_SLOW) this.#isBelow = false;
      }
    } catch (error) {
      if (view === "scene") says(this.s, texts.thisBrowserDoesNotShow(wrong(error)));
    }
    if (!this.isLive) this.#end();
    film.draw();
  }
  async toggle(): Promise<void> {
    if (!this.isOn) await this.#start();
    this.isOn = !this.isOn;
    this.#press();
    this.#name();
    if (!this.isLive) this.#end();
    this.draw();
    this.s.film.draw();
  }
  /** The flat view and its button follow whether the scene is on. */
  #press(): void {
    const { film, buttons } = this.s;
    film.canvas.classList.toggle("behind", this.isOn);
    buttons.space.setAttribute("aria-pressed", String(this.isOn));
  }
  /** Rejects where the browser has no WebGL. */
  async #start(): Promise<void> {
    if (this.#scene) return;
    if (!document.createElement("canvas").getContext("webgl2")) throw new Error(texts.itHasNoWebgl);
    this.#module ??= await import("./scene.js");
    if (!this.#isClosed) this.#current();
  }
  #end(): void {
    this.#scene?.close();
    this.#scene?.canvas.remove();
    this.#over.remove();
    this.#scene = undefined;
  }
  close(): void {
    this.#isClosed = true;
    this.#end();
  }
  /**
   * The browser took the graphics processor away, as phones do with pages in the background. The
   * drawn table is there at once; the scene returns when the page is next visible.
   */
  #lose(scene: Scene): void {
    if (this.#scene !== scene) return; // it was ended here
    const wasOn = this.isOn;
    this.isOn = false;
    this.#isBelow = false;
    this.#end();
    this.#press();
    this.s.film.draw();
    if (++this.#losses > MOST_LOSSES || this.#isClosed) return;
    const remake = async (): Promise<void> => {
      await this.prepare();
      if (wasOn && !this.isOn && !this.#isClosed) await this.toggle();
    };
    const whenVisible = (): void => {
      if (document.hidden) return;
      document.removeEventListener("visibilitychange", whenVisible);
      window.setTimeout(() => void remake(), AGAIN);
    };
    document.addEventListener("visibilitychange", whenVisible);
    whenVisible();
  }

  /** The scene of the game that is played. */
  #current(): Scene {
    const { play } = this.s;
    const balls = play.balls.map(({ kind }, k) => ({
      name: play.names[k]!,
      radius: kind.radius,
      colour: colourOf(play.names[k]!, k, kind.radius),
    }));
    const parts = JSON.stringify([play.table, balls]);
    if (this.#scene && parts === this.#parts) return this.#scene;
    this.#end();
    const isFine = this.s.settings.view === "scene" || this.#hasGraphics;
    const scene = new this.#module!.Scene(play.table, balls, isFine);
    this.#scene = scene;
    this.#parts = parts;
    const { canvas } = scene;
    canvas.id = "scene";
    canvas.addEventListener("webglcontextlost", () => this.#lose(scene));
    this.#name();
    this.#handle(scene);
    canvas.addEventListener("keydown", (event) => {
      if (event.key === "Tab") return;
      event.preventDefault();
      const { key, altKey, shiftKey, ctrlKey, metaKey } = event;
      this.s.film.canvas.dispatchEvent(
        new KeyboardEvent("keydown", { key, altKey, shiftKey, ctrlKey, metaKey }),
      );
    });
    this.felt.prepend(canvas);
    this.felt.append(this.#over);
    return scene;
  }
  /** Below the flat view, which has a label, the scene has none. */
  #name(): void {
    const { canvas } = this.#scene!;
    const named = { role: "img", tabindex: "0", "aria-label": texts.theTableFromBehind };
    for (const [name, value] of Object.entries(named))
      if (this.isOn) canvas.setAttribute(name, value);
      else canvas.removeAttribute(name);
    canvas.toggleAttribute("inert", !this.isOn);
    canvas.ariaHidden = String(!this.isOn);
    this.#over.hidden = !this.isOn;
  }

  /**
   * A drag turns the aim and raises the eye, or moves the cue ball that is in hand; a tap aims at a
   * ball or a place, or calls.
   */
  #handle(scene: Scene): void {
    const { s } = this;
    const { canvas } = scene;
    let start: Point = [0, 0];
    let last: Point = [0, 0];
    let taps = false;
    let grip: Grip = { kind: "cloth" };
    const placeOf = ([x, y]: Point): Point | undefined =>
      scene.unplace(x, y, s.play.balls[0]!.kind.radius);
    drags(canvas, (event, first) => {
      const pixel = pixelsOf(canvas, event);
      if (first) {
        taps = !s.film.playing && !this.isStriking;
        if (!taps) s.showing.skip();
        start = pixel;
        grip = this.#under(scene, pixel);
      } else if (free(s)) {
        taps &&= Math.hypot(pixel[0] - start[0], pixel[1] - start[1]) < 6;
        const target = placeOf(pixel);
        this.#moves =
          !taps && grip.kind === "ball" && grip.ball === s.play.cueBall && movable(s, grip.ball);
        if (this.#moves && target) move(s, s.play.cueBall, target);
        else if (!this.#moves && !taps) {
          this.#raise(pixel[1] - last[1]);
          s.stroke.set({ phi: (s.stroke.value().phi + (last[0] - pixel[0]) * 0.08 + 360) % 360 });
          s.changed();
        }
      }
      last = pixel;
    });
    for (const type of ["pointerup", "pointercancel"])
      canvas.addEventListener(type, () => {
        const target = placeOf(start);
        if (type === "pointerup" && taps && target && free(s)) tap(s, grip, target);
        this.#moves = false;
        taps = false;
        s.changed();
      });
  }
  /** What is seen within a finger's reach: the nearest ball or pocket. */
  #under(scene: Scene, [x, y]: Point): Grip {
    const { balls, table } = this.s.play;
    const far = (px: number, py: number): number => Math.hypot(px - x, py - y);
    /** How far off a ball is, beyond its edge: one before the eye is larger than a finger. */
    const farOff = ([u, v, w]: Vec3, radius: number): number => {
      const [px, py] = scene.place(u, v, w);
      const [tx, ty] = scene.place(u, v, w + radius);
      return far(px, py) - Math.hypot(tx - px, ty - py);
    };
    const grips = [
      ...balls.map(({ state: { r }, kind }, ball) => ({
        grip: { kind: "ball", ball } as Grip,
        d: onTable(balls[ball]!.state) ? farOff(r, kind.radius) : 99,
      })),
      ...table.pockets.map(({ centre }, pocket) => ({
        grip: { kind: "pocket", pocket } as Grip,
        d: far(...scene.place(centre[0], centre[1], 0)),
      })),
    ]
      .filter(({ d }) => d < 24)
      .sort((a, b) => a.d - b.d);
    return grips[0]?.grip ?? { kind: "cloth" };
  }

  #raise(pixels: number): void {
    const height = this.#heightOfEye() + 0.002 * pixels;
    this.#height = Math.min(Math.max(height, LOW), HIGH);
  }
  #heightOfEye(): number {
    const { clientWidth, clientHeight } = this.felt;
    return this.#height || (clientWidth < clientHeight ? 0.45 : 0.3);
  }

  // ---- A stroke

  strike(cue: Cue, place: readonly number[], next: () => void): void {
    const isInstant = this.s.film.pace.value === "1000";
    if (!this.isLive || isStill() || isInstant) return next();
    const strike = { cue, place, start: performance.now(), next };
    this.#strike = strike;
    const step = (): void => {
      if (this.#strike !== strike) return;
      if (performance.now() - strike.start < BACK + FORTH) {
        this.#redraw();
        return void requestAnimationFrame(step);
      }
      this.#strike = { cue, place, start: strike.start };
      next();
    };
    requestAnimationFrame(step);
  }
  putAway(): void {
    this.#strike = undefined;
  }
  /** The cue as it is aimed, on its way to its ball, or behind that for a moment. */
  #stick(): Stick | undefined {
    const { film, play } = this.s;
    const R = play.balls[0]!.kind.radius;
    const strike = this.#strike;
    if (strike?.next) {
      const elapsed = performance.now() - strike.start;
      const back = Math.min(elapsed / BACK, 1);
      const forth = Math.max((elapsed - BACK) / FORTH, 0);
      const far = stickEnd(R, strike.cue.speed) + SWING * Math.sin((back * Math.PI) / 2);
      return { ...strike, gap: far + (R - far) * Math.min(forth, 1) ** 2 };
    }
    if (strike && film.playing && film.time < FOLLOW)
      return { ...strike, gap: R - FOLLOWS * (1 - Math.exp(-14 * film.time)) };
    if (strike && film.time > 0) this.#strike = undefined;
    const cue = aimed(this.s);
    const { state } = play.balls[play.cueBall]!;
    if (!cue || !onTable(state)) return undefined;
    return { cue, place: state.r, gap: stickEnd(R, cue.speed) };
  }

  // ---- Pictures

  #redraw(): void {
    this.draw();
    this.s.film.draw();
  }
  #size(scene: Scene): void {
    const { clientWidth, clientHeight } = this.felt;
    const { canvas } = scene;
    if (canvas.clientWidth === clientWidth && canvas.clientHeight === clientHeight) return;
    // The padding keeps free of controls what is between.
    const style = getComputedStyle(this.felt);
    const paddings = ["paddingTop", "paddingRight", "paddingBottom", "paddingLeft"] as const;
    const [top, right, bottom, left] = paddings.map((side) => parseFloat(style[side])) as [
      number,
      number,
      number,
      number,
    ];
    scene.size(clientWidth, clientHeight, {
      left,
      top,
      width: clientWidth - left - right,
      height: clientHeight - top - bottom,
    });
  }
  #lines(): Line[] {
    return [...trailsOf(this.s.filmed!), ...linesOfAim(this.s)];
  }
  #poses(): Pose[] {
    return this.s.filmed!.shots[0]!.poses(this.s.film.time);
  }
  backdrop(view: FlatView): boolean {
    if (!this.#isBelow || this.isOn || !this.s.filmed) return false;
    const scene = this.#current();
    this.#size(scene);
    const felt = this.felt.getBoundingClientRect();
    const flat = this.s.film.canvas.getBoundingClientRect();
    scene.lookDown(view, [flat.left - felt.left, flat.top - felt.top]);
    scene.draw(this.#poses(), this.#stick(), this.#lines());
    this.#time();
    return true;
  }
  draw(): void {
    if (!this.isOn) return;
    const scene = this.#current();
    this.#size(scene);
    const { film, continuation, shown } = this.s;
    const stick = this.#stick();
    const isFilm = film.playing || continuation !== undefined;
    const isAiming = stick !== undefined && !isFilm;
    if (isAiming && !this.#moves) {
      const { cue, place } = stick;
      scene.lookAlong(place, cue.phi, this.#heightOfEye(), this.#pocket());
    } else if (film.playing && shown) scene.lookAcross(shown.cue.phi);
    const time = performance.now();
    const seconds = Math.min((time - this.#lastPicture) / 1000, 0.1);
    this.#lastPicture = time;
    // An aim that turns takes the camera along; other views are glided to.
    const cuts = isStill() || (isAiming && this.#wasAiming && !this.#isGliding);
    const isThere = scene.glide(cuts ? Infinity : seconds);
    this.#isGliding = !isThere;
    this.#wasAiming = isAiming;
    if (!isThere && !film.playing && !this.isStriking) requestAnimationFrame(() => this.draw());
    const poses = this.#poses();
    scene.draw(poses, stick, this.#lines());
    this.#label(scene, poses);
    this.#time();
  }
  /** The pocket that the ball that is met heads for; the view does not turn with what is called. */
  #pocket(): readonly number[] | undefined {
    const { first, play } = this.s;
    if (play.breaks) return undefined;
    return play.table.pockets[guessOf(play.table, first, [first?.ball ?? -1]).pocket]?.centre;
  }
  readonly sideOf = (place: ArrayLike<number>): number => {
    const { film } = this.s;
    const scene = this.isOn ? this.#scene : undefined;
    const { 0: x = 0, 1: y = 0, 2: z = 0 } = place;
    const [px] = scene ? scene.place(x, y, z) : film.place(x, y);
    return (2 * px) / (scene?.canvas ?? film.canvas).clientWidth - 1;
  };
  /** A device that is too slow for a film gets a coarser scene. */
  #time(): void {
    const film = this.#film;
    const time = this.s.film.playing ? performance.now() : 0;
    const elapsed = time - film.last;
    if (film.last > 0 && time > 0 && elapsed < 400) {
      film.sum += elapsed;
      if (++film.count === PICTURES && film.sum > PICTURES * SLOW) this.#scene?.coarsen();
    }
    film.last = time;
  }
  /**
   * Draws the sketches of the coach; and the labels of balls that cannot be read, or of all if the
   * settings ask for it, where they lie over no other one.
   */
  #label(scene: Scene, poses: readonly Pose[]): void {
    const { play, settings, film } = this.s;
    const over = this.#over;
    const { balls, names } = play;
    const { clientWidth: width, clientHeight: height } = scene.canvas;
    const sharp = Math.min(window.devicePixelRatio || 1, 2);
    Object.assign(over, { width: width * sharp, height: height * sharp });
    Object.assign(over.style, { width: `${width}px`, height: `${height}px` });
    const g = over.getContext("2d")!;
    g.scale(sharp, sharp);
    const onCloth = { g, scale: 1, place: (x: number, y: number) => scene.place(x, y, 0.002) };
    drawSketches(onCloth, seenSketches(this.s));
    const seen = poses.map(({ r, seen }, k) => {
      const { kind } = balls[k]!;
      const [x, y] = scene.place(r[0]!, r[1]!, r[2]!);
      const [u, v] = scene.place(r[0]!, r[1]!, r[2]! + kind.radius);
      const radius = Math.hypot(u - x, v - y);
      const isRead = radius > READABLE && (film.playing || scene.isFacing(poses[k]!));
      const isAsked = settings.numbers || !(isRead || play.breaks);
      const isShown = seen && isAsked && r[2]! > 0 && x > 0 && x < width;
      return {
        kind: { ...kind, radius: 1.1 * radius },
        state: {
          r: [x, y, 0] as const,
          label: isShown ? ("rolling" as const) : ("pocketed" as const),
        },
      };
    });
    const labels = labelsOf(names, settings.numbers ? texts.letters : {});
    drawLabels({ g, scale: 1, place: (x, y) => [x, y] }, seen, labels);
  }
}
