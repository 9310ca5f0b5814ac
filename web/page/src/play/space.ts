// The view from behind the cue, over the flat one: its module is in the page as compressed text,
// and starts when it is asked for.
import { colourOf } from "../../../player/words.js";
import type { Pose } from "../../../player/words.js";
import { drawLabels, labelsOf, stickEnd } from "../table/drawing.js";
import { onTable } from "../table/filmed.js";
import { type Grip, pixelsOf, type Point } from "../table/grip.js";
import { color, drags, el } from "../ui.js";
import { drawMarks, drawWays, move, movable, tap } from "./aim.js";
import type { Play } from "./game.js";
import type { Scene } from "./scene.js";
import type { Session, SpaceView } from "./parts.js";
import { aimed, free } from "./session.js";
import { texts } from "../texts/texts.js";

async function load(): Promise<typeof import("./scene.js")> {
  const text = document.getElementById("scene-module")!.textContent!.trim();
  const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  const source = await new Response(
    new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip")),
  ).blob();
  const url = URL.createObjectURL(new Blob([source], { type: "text/javascript" }));
  try {
    return (await import(/* @vite-ignore */ url)) as typeof import("./scene.js");
  } finally {
    URL.revokeObjectURL(url);
  }
}

export class Space implements SpaceView {
  #module: typeof import("./scene.js") | undefined;
  #scene: Scene | undefined;
  #play: Play | undefined;
  /** What is drawn over the scene: lines, and the numbers of balls. */
  readonly #over = el("canvas.over-scene");
  isOn = false;
  /** Whether the cue ball is being moved. */
  #moves = false;

  constructor(
    readonly s: Session,
    readonly felt: HTMLElement,
  ) {}

  /** Rejects where the browser has no WebGL: the flat view stays. */
  async toggle(): Promise<void> {
    if (this.isOn) return this.#hide();
    if (!document.createElement("canvas").getContext("webgl2")) throw new Error(texts.itHasNoWebgl);
    this.#module ??= await load();
    this.#make();
    this.isOn = true;
    this.s.film.canvas.classList.add("behind");
    this.draw();
  }

  #make(): void {
    const play = this.s.play;
    this.close();
    const balls = play.balls.map(({ kind }, k) => ({
      name: play.names[k]!,
      radius: kind.radius,
      colour: colourOf(play.names[k]!, k, kind.radius),
    }));
    const scene = new this.#module!.Scene({
      table: play.table,
      balls,
      cloth: color("cloth"),
      wood: color("rail"),
    });
    this.#scene = scene;
    this.#play = play;
    const { canvas } = scene;
    for (const [name, value] of Object.entries({
      id: "scene",
      role: "img",
      tabindex: "0",
      "aria-label": texts.theTableFromBehind,
    }))
      canvas.setAttribute(name, value);
    this.#handle(scene);
    canvas.addEventListener("keydown", (event) => {
      if (event.key === "Tab") return;
      event.preventDefault();
      const { key, altKey, shiftKey, ctrlKey, metaKey } = event;
      this.s.film.canvas.dispatchEvent(
        new KeyboardEvent("keydown", { key, altKey, shiftKey, ctrlKey, metaKey }),
      );
    });
    this.felt.append(canvas, this.#over);
  }

  /**
   * A drag turns the aim, or moves the cue ball that is in hand; a tap aims at a ball or a place,
   * or calls.
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
        taps = !s.film.playing;
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
    const grips = [
      ...balls.map(({ state: { r } }, ball) => ({
        grip: { kind: "ball", ball } as Grip,
        d: onTable(balls[ball]!.state) ? far(...scene.place(r[0], r[1], r[2])) : 99,
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

  draw(): void {
    if (!this.isOn || !this.#scene) return;
    if (this.#play !== this.s.play) this.#make();
    const { clientWidth, clientHeight } = this.felt;
    const { canvas } = this.#scene;
    if (canvas.clientWidth !== clientWidth || canvas.clientHeight !== clientHeight)
      this.#scene.size(clientWidth, clientHeight);
    const poses = this.s.filmed!.shots[0]!.poses(this.s.film.time);
    const cue = aimed(this.s);
    // The camera stays where it was while the balls roll, or the cue ball is moved.
    if (cue && !this.#moves) this.#scene.look(poses[cue.ball]!.r, cue.phi);
    this.#scene.draw(
      poses,
      cue && {
        cue,
        gap: stickEnd(this.#play!.balls[0]!.kind.radius, cue.speed),
        first: this.s.first?.place,
      },
    );
    this.#label(poses, cue !== undefined);
  }
  /**
   * Draws the way of a ball that is aimed at; and, if the settings ask for it, the label of each
   * ball where it lies over no other one.
   */
  #label(poses: readonly Pose[], aims: boolean): void {
    const over = this.#over;
    const scene = this.#scene!;
    const balls = this.#play!.balls;
    const { clientWidth: width, clientHeight: height } = scene.canvas;
    const sharp = Math.min(window.devicePixelRatio || 1, 2);
    Object.assign(over, { width: width * sharp, height: height * sharp });
    Object.assign(over.style, { width: `${width}px`, height: `${height}px` });
    const g = over.getContext("2d")!;
    g.scale(sharp, sharp);
    const pen = {
      g,
      scale: 1,
      place: (x: number, y: number) => scene.place(x, y, balls[0]!.kind.radius),
    };
    if (aims && this.s.first) drawWays(this.s, pen);
    drawMarks(this.s, pen);
    const seen = poses.map(({ r, seen }, k) => {
      const { kind } = balls[k]!;
      const [x, y] = scene.place(r[0]!, r[1]!, r[2]!);
      const [u, v] = scene.place(r[0]!, r[1]!, r[2]! + kind.radius);
      return {
        kind: { ...kind, radius: 1.1 * Math.hypot(u - x, v - y) },
        state: {
          r: [x, y, 0] as const,
          label: seen && x > 0 && x < width ? ("rolling" as const) : ("pocketed" as const),
        },
      };
    });
    if (!this.s.settings.numbers) return;
    const labels = labelsOf(this.#play!.names, texts.letters);
    drawLabels({ g, scale: 1, place: (x, y) => [x, y] }, seen, labels);
  }

  #hide(): void {
    this.isOn = false;
    this.s.film.canvas.classList.remove("behind");
    this.s.film.draw();
    this.close();
  }
  close(): void {
    this.#scene?.close();
    this.#scene?.canvas.remove();
    this.#over.remove();
    this.#scene = undefined;
  }
}
