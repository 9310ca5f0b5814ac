// The table of a game by pointer and keys: a drag turns the aim, draws the stick or moves a ball that may be moved; a tap aims at a place or a ball, or
// calls a pocket; two fingers, a double tap, or the wheel show a part of the table larger.
import { CaromError, type Cue } from "carom";
import type { player } from "../../../player/player.js";
import { beside } from "../lab/hand.js";
import { drawNumbers, drawStick, type Pen, PULL, ring, stickEnd, stroke } from "../table/drawing.js";
import { onTable } from "../table/filmed.js";
import { mayLie } from "../table/head.js";
import type { Play } from "./game.js";

const DEGREES = 180 / Math.PI;
type Point = [number, number];

export interface Host {
  play(): Play;
  /** Whether whoever is at this page may aim now. */
  free(): boolean;
  cue(): Cue;
  /** The stroke that is shown: of whoever may aim, or of the page's player before it plays. */
  aimed(): Cue | undefined;
  set(key: "speed" | "phi", value: number): void;
  /** Where the cue ball first meets something, m, and the ball that it meets, or -1. */
  first(): { at: readonly number[]; ball: number } | undefined;
  /** The ball and the pocket that are called. */
  called(): { ball: number; pocket: number } | undefined;
  /** The aim or the layout has changed. */
  changed(): void;
  tapped(on: { ball: number } | { pocket: number }): void;
  shoot(): void;
  skip(): void;
  undo(): void;
}

export function aiming(film: ReturnType<typeof player>, host: Host): { draw(g: CanvasRenderingContext2D): void } {
  const { canvas } = film;

  function draw(g: CanvasRenderingContext2D): void {
    if (film.time > 0 || film.playing) return;
    const play = host.play();
    const pen = { g, scale: film.scale, place: film.place };
    drawAim(pen, play);
    if (!play.state.opening) drawNumbers(pen, play.balls, play.names);
  }
  function drawAim(pen: Pen, play: Play): void {
    const { g } = pen;
    const [cueBall] = play.balls as [(typeof play.balls)[number]];
    const call = host.called();
    g.setLineDash([]);
    if (call && call.pocket >= 0) {
      g.strokeStyle = "#ffe28a";
      g.lineWidth = 3;
      const { centre, radius } = play.table.pockets[call.pocket]!;
      ring(pen, centre, radius, 2);
      if (call.ball > 0) ring(pen, play.balls[call.ball]!.state.r, play.balls[call.ball]!.kind.radius, 2);
    }
    const aimed = host.aimed();
    if (!aimed || !onTable(cueBall.state)) return;
    const first = host.first();
    if (first) {
      stroke(pen, cueBall.state.r, first.at, 1.4, "#ffffffd0");
      ring(pen, first.at, cueBall.kind.radius, 0);
    }
    if (play.hand !== "no" && host.free()) {
      g.strokeStyle = "#ffe28a";
      g.lineWidth = 2;
      ring(pen, cueBall.state.r, cueBall.kind.radius, 5);
      if (play.hand === "kitchen") {
        g.setLineDash([6, 6]);
        stroke(pen, [0, play.table.length / 4], [play.table.width, play.table.length / 4], 1, "#ffe28a");
        g.setLineDash([]);
      }
    }
    drawStick(pen, cueBall, aimed);
  }

  // ---- One pointer -----------------------------------------------------------------------------------------------------------

  type Grip = { is: "ball"; ball: number } | { is: "pocket"; pocket: number } | { is: "stick" | "cloth" };
  let held: { grip: Grip; from: Point; at: Point; phi: number; speed: number; taps: boolean } | undefined;
  const pointers = new Map<number, Point>();
  const pixels = (event: { clientX: number; clientY: number }): Point => {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };

  /** What lies under a pointer. A finger reaches farther. */
  function under([x, y]: Point, finger: boolean): Grip {
    const { balls, table } = host.play();
    const reach = (finger ? 20 : 10) / film.scale;
    const near = ([px, py]: readonly number[]): number => Math.hypot(px! - x, py! - y);
    let ball = -1;
    balls.forEach(({ state, kind }, k) => {
      if (onTable(state) && near(state.r) < Math.max(1.2 * kind.radius, reach) && (ball < 0 || near(state.r) < near(balls[ball]!.state.r))) ball = k;
    });
    if (ball >= 0) return { is: "ball", ball };
    const pocket = table.pockets.findIndex(({ centre, radius }) => near(centre) < Math.max(radius + 0.01, reach));
    if (pocket >= 0) return { is: "pocket", pocket };
    const { phi, speed } = host.cue();
    const { r } = balls[0]!.state;
    const [dx, dy] = [Math.cos(phi / DEGREES), Math.sin(phi / DEGREES)];
    const along = (x - r[0]) * dx + (y - r[1]) * dy;
    const end = stickEnd(balls[0]!.kind.radius, speed);
    if (Math.abs((y - r[1]) * dx - (x - r[0]) * dy) < reach && along < 0 && -along > end - reach && -along < end + 1.3) return { is: "stick" };
    return { is: "cloth" };
  }
  const angle = ([x, y]: Point): number => {
    const { r } = host.play().balls[0]!.state;
    return Math.atan2(y - r[1], x - r[0]) * DEGREES;
  };
  const turn = (phi: number): void => {
    host.set("phi", Math.round((((phi % 360) + 360) % 360) * 100) / 100);
    host.changed();
  };
  /** Whether a ball may be moved. */
  const movable = (ball: number): boolean => host.play().practice || (ball === 0 && host.play().hand !== "no");
  function move(ball: number, to: Point): void {
    const play = host.play();
    const kitchen = play.hand === "kitchen";
    const [x, y] = beside(play.table, play.balls, ball, to, kitchen ? play.table.length / 4 + play.balls[0]!.kind.radius + 1e-4 : play.table.length);
    if (!play.practice && !mayLie(play.table, play.hand, [x, y])) return;
    try {
      play.put(ball, x, y);
    } catch (error) {
      if (error instanceof CaromError) return; // no room there: it stays
      throw error;
    }
    host.changed();
  }
  function drag(at: Point): void {
    if (!held) return;
    const { grip, from, phi, speed } = held;
    if (grip.is === "ball" && movable(grip.ball)) move(grip.ball, at);
    else if (grip.is === "stick") {
      const { r } = host.play().balls[0]!.state;
      const back = ([x, y]: Point): number => Math.hypot(x - r[0], y - r[1]);
      host.set("speed", Math.round(Math.min(Math.max(speed + (back(at) - back(from)) / PULL, 0.1), 10) * 100) / 100);
      host.changed();
    } else turn(phi + angle(at) - angle(from));
  }
  function tap(grip: Grip, at: Point): void {
    if (grip.is === "pocket") return host.tapped({ pocket: grip.pocket });
    if (grip.is === "ball" && grip.ball > 0) {
      const { r } = host.play().balls[grip.ball]!.state;
      turn(angle([r[0], r[1]]));
      host.tapped({ ball: grip.ball });
    } else if (grip.is === "cloth") turn(angle(at));
  }

  // ---- Two pointers ------------------------------------------------------------------------------------------------------------

  let tapped: { when: number; at: Point; phi: number } | undefined;
  let pinch: { apart: number; zoom: number; middle: Point } | undefined;
  const middle = ([a, b]: Point[]): Point => [(a![0] + b![0]) / 2, (a![1] + b![1]) / 2];
  const apart = ([a, b]: Point[]): number => Math.hypot(a![0] - b![0], a![1] - b![1]);
  /** Shows the table so many times larger, with a place of it under a pixel. */
  function look(times: number, place: Point, under: Point): void {
    film.look(times, place);
    const centre = film.unplace(canvas.clientWidth / 2, canvas.clientHeight / 2);
    const now = film.unplace(...under);
    film.look(times, [centre[0] + place[0] - now[0], centre[1] + place[1] - now[1]]);
  }

  canvas.addEventListener("pointerdown", (event) => {
    if (event.button > 0) return;
    if (film.playing) return host.skip();
    pointers.set(event.pointerId, pixels(event));
    canvas.setPointerCapture(event.pointerId);
    if (pointers.size === 2) {
      // The first finger has begun to aim: it has not.
      if (held && host.free()) {
        host.set("phi", held.phi);
        host.set("speed", held.speed);
        host.changed();
      }
      held = undefined;
      const both = [...pointers.values()];
      pinch = { apart: apart(both), zoom: film.zoom, middle: film.unplace(...middle(both)) };
      return;
    }
    if (!host.free() || pointers.size > 1) return;
    const at = film.unplace(...pixels(event));
    held = { grip: under(at, event.pointerType === "touch"), from: at, at, phi: host.cue().phi, speed: host.cue().speed, taps: true };
    if (held.grip.is === "ball" && host.play().practice) host.play().keep();
  });
  canvas.addEventListener("pointermove", (event) => {
    if (!pointers.has(event.pointerId)) return;
    pointers.set(event.pointerId, pixels(event));
    if (pinch && pointers.size === 2) {
      const both = [...pointers.values()];
      return look((pinch.zoom * apart(both)) / pinch.apart, pinch.middle, middle(both));
    }
    if (!held || !host.free()) return;
    const at = film.unplace(...pixels(event));
    if (Math.hypot(at[0] - held.from[0], at[1] - held.from[1]) * film.scale > 5) held.taps = false;
    held.at = at;
    if (!held.taps) drag(at);
  });
  const up = (event: PointerEvent): void => {
    pointers.delete(event.pointerId);
    if (pointers.size < 2) pinch = undefined;
    const was = held;
    held = undefined;
    if (!was) return;
    if (was.taps && was.grip.is === "ball" && host.play().practice) host.play().past.pop(); // nothing was moved
    if (event.type !== "pointerup" || !was.taps || !host.free()) return;
    // A second tap at the same place shows it larger, or all of the table; the first one has aimed at nothing.
    const [at, before] = [pixels(event), tapped];
    tapped = { when: event.timeStamp, at, phi: was.phi };
    if (event.pointerType !== "touch" || !before || event.timeStamp - before.when > 350 || apart([at, before.at]) > 30) return tap(was.grip, was.at);
    tapped = undefined;
    turn(before.phi);
    if (film.zoom > 1) film.look(1);
    else look(3, was.at, at);
  };
  canvas.addEventListener("pointerup", up);
  canvas.addEventListener("pointercancel", up);
  canvas.addEventListener(
    "wheel",
    (event) => {
      event.preventDefault();
      const at = pixels(event);
      look(film.zoom * Math.exp(-event.deltaY / 400), film.unplace(...at), at);
    },
    { passive: false },
  );

  // ---- Keys --------------------------------------------------------------------------------------------------------------------

  const ARROWS: Record<string, Point> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
  canvas.addEventListener("keydown", (event) => {
    const arrow = ARROWS[event.key];
    if (film.playing && (event.key === "Enter" || event.key === "Escape")) host.skip();
    else if (!host.free()) return;
    else if (event.key === "Enter") host.shoot();
    else if ((event.ctrlKey || event.metaKey) && event.key === "z") host.undo();
    else if (event.key === "c" && host.play().hasPockets) host.tapped({ pocket: ((host.called()?.pocket ?? -1) + 1) % host.play().table.pockets.length });
    else if (!arrow) return;
    else if (event.altKey) {
      if (!movable(0)) return;
      const { r } = host.play().balls[0]!.state;
      const [px, py] = film.place(r[0], r[1]);
      const by = (event.shiftKey ? 0.05 : 0.005) * film.scale;
      move(0, film.unplace(px + arrow[0] * by, py + arrow[1] * by));
    } else if (arrow[0] !== 0) turn(host.cue().phi - arrow[0] * (event.shiftKey ? 1 : 0.1));
    else {
      host.set("speed", Math.round(Math.min(Math.max(host.cue().speed - arrow[1] * (event.shiftKey ? 0.5 : 0.1), 0.1), 10) * 100) / 100);
      host.changed();
    }
    event.preventDefault();
  });

  return { draw };
}
