// The laboratory by pointer and keys: what lies under a pointer, balls that are moved and turned, the aim, and what is drawn for it.
import { type BallState, type Carom, CaromError, type Contact, type Cue, type ShotBall, type Table } from "carom";
import type { player } from "../../../player/player.js";
import { drawContact, drawStick, PULL, ring, stickEnd } from "../table/drawing.js";
import { onTable } from "../table/filmed.js";

const DEGREES = 180 / Math.PI;

/** The layout and the aim, which the view has. */
export interface Desk {
  readonly table: Table;
  balls: ShotBall[];
  readonly faces: number[];
  /** The object ball that was picked, for pockets; -1: none. */
  chosen: number;
  readonly cue: Cue;
  readonly contact: Contact | undefined;
  value(key: "speed" | "phi"): number;
  set(key: "speed" | "phi", value: number): void;
  /** Something has changed: the shot is played again, at once or before the next frame. */
  aimed(): void;
  soon(): void;
  undo(): void;
  aimAt(pocket: number): void;
}

/** A ball that waits in the first pocket. */
export function pocketed(table: Table, from: BallState): BallState {
  const [pocket] = table.pockets;
  return pocket ? { r: [...pocket.centre, -pocket.depth], v: [0, 0, 0], w: [0, 0, 0], label: "pocketed" } : from;
}

/** Where a ball of a radius lies that is put at x, y: inside the cushions, and beside another ball where one is in the way. */
export function beside(table: Table, balls: readonly ShotBall[], ball: number, [x, y]: readonly [number, number], highest = table.length): [number, number] {
  const R = balls[ball]!.kind.radius;
  const inside = (v: number, most: number): number => Math.min(Math.max(v, R + 1e-4), most - R - 1e-4);
  const [px, py] = [inside(x, table.width), inside(y, highest)];
  const other = balls.find(({ state }, k) => k !== ball && onTable(state) && Math.hypot(state.r[0] - px, state.r[1] - py) < 2 * R + 1e-5);
  if (!other) return [px, py];
  const [ox, oy] = other.state.r;
  const far = Math.hypot(px - ox, py - oy) || 1;
  return [ox + ((px - ox) / far) * (2 * R + 2e-5), oy + ((py - oy) / far) * (2 * R + 2e-5)];
}

export function hand(carom: Carom, film: ReturnType<typeof player>, desk: Desk): { draw(g: CanvasRenderingContext2D): void } {
  const { canvas } = film;

  // ---- Drawing -------------------------------------------------------------------------------------------------------------

  /** Balls that are not on the table wait on the wood beside it, in this order from the head. */
  const waits = (): number[] => desk.balls.flatMap(({ state }, k) => (onTable(state) ? [] : [k]));
  const waitsAt = (index: number): [number, number] => [-0.045, 0.12 + 0.075 * index + (0.12 + 0.075 * index > desk.table.length / 2 - 0.1 ? 0.2 : 0)];
  /** Whether a ball is picked that lies on the table; the handle that turns it, 36 pixels from its middle. */
  const canTurn = (): boolean => desk.chosen > 0 && onTable(desk.balls[desk.chosen]!.state);
  function turner(): [number, number] {
    const { r } = desk.balls[desk.chosen]!.state;
    const [away, face] = [36 / film.scale, desk.faces[desk.chosen]! / DEGREES];
    return [r[0] + away * Math.cos(face), r[1] + away * Math.sin(face)];
  }

  /** At the start of the film: the ball that is picked, the stick, the ghost ball and the tangent line. */
  function draw(g: CanvasRenderingContext2D): void {
    const pen = { g, scale: film.scale, place: film.place };
    waits().forEach((k, index) => film.drawBall(g, k, { r: [...waitsAt(index), 0], q: [1, 0, 0, 0], seen: true }, 1));
    if (film.time > 0 || film.playing || desk.cue.ball !== 0) return;
    const [cueBall] = desk.balls as [ShotBall];
    const { phi } = desk.cue;
    const R = cueBall.kind.radius;
    if (desk.contact) drawContact(pen, desk.contact, R, [Math.cos(phi / DEGREES), Math.sin(phi / DEGREES)]);
    if (canTurn()) {
      g.strokeStyle = g.fillStyle = "#ffe28a";
      g.lineWidth = 2;
      ring(pen, desk.balls[desk.chosen]!.state.r, R, 3);
      g.beginPath();
      g.arc(...film.place(...turner()), 6, 0, 7);
      g.fill();
    }
    if (onTable(cueBall.state)) drawStick(pen, cueBall, desk.cue);
  }

  // ---- Pointer and keys ----------------------------------------------------------------------------------------------------

  type Grip = { is: "ball"; ball: number } | { is: "pocket"; pocket: number } | { is: "stick" | "line" | "cloth" | "turn" };
  let held: { grip: Grip; at: [number, number]; from: [number, number]; value: number; taps: boolean } | undefined;
  const position = (event: { clientX: number; clientY: number }): [number, number] => {
    const box = canvas.getBoundingClientRect();
    return film.unplace(event.clientX - box.left, event.clientY - box.top);
  };
  /** What lies under a pointer. A finger reaches farther. */
  function under([x, y]: [number, number], finger: boolean): Grip {
    const reach = (finger ? 22 : 12) / film.scale;
    const near = ([px, py]: readonly number[]): number => Math.hypot(px! - x, py! - y);
    const places = desk.balls.map(({ state }) => (onTable(state) ? state.r : undefined));
    waits().forEach((k, index) => (places[k] = [...waitsAt(index), 0]));
    const nearest = places.reduce((best, place, k) => (near(place!) < near(places[best]!) ? k : best), 0);
    if (canTurn() && near(turner()) < Math.min(reach, near(places[nearest]!))) return { is: "turn" };
    if (near(places[nearest]!) < Math.max(1.2 * desk.balls[nearest]!.kind.radius, reach)) return { is: "ball", ball: nearest };
    const pocket = desk.table.pockets.findIndex(({ centre, radius }) => near(centre) < radius + 0.01);
    if (pocket >= 0) return { is: "pocket", pocket };
    // Along the line of aim, from the cue ball.
    const { phi, speed } = desk.cue;
    const { r } = desk.balls[0]!.state;
    const [dx, dy] = [Math.cos(phi / DEGREES), Math.sin(phi / DEGREES)];
    const along = (x - r[0]) * dx + (y - r[1]) * dy;
    if (Math.abs((y - r[1]) * dx - (x - r[0]) * dy) < reach) {
      if (along < 0 && -along > stickEnd(desk.balls[0]!.kind.radius, speed) - reach && -along < stickEnd(desk.balls[0]!.kind.radius, speed) + 1.3) return { is: "stick" };
      if (along > 0) return { is: "line" };
    }
    return { is: "cloth" };
  }
  const angleOf = ([x, y]: readonly [number, number], ball = 0): number => Math.atan2(y - desk.balls[ball]!.state.r[1], x - desk.balls[ball]!.state.r[0]) * DEGREES;
  function turnTo(phi: number): void {
    desk.set("phi", Math.round((((phi % 360) + 360) % 360) * 100) / 100);
    desk.soon();
  }
  function drag(at: [number, number]): void {
    if (!held) return;
    const { grip, from, value } = held;
    if (grip.is === "ball") moveBall(grip.ball, at);
    else if (grip.is === "turn") turnBall(desk.chosen, value + angleOf(at, desk.chosen) - angleOf(from, desk.chosen) - desk.faces[desk.chosen]!);
    else if (grip.is === "stick") {
      const back = (x: [number, number]): number => Math.hypot(x[0] - desk.balls[0]!.state.r[0], x[1] - desk.balls[0]!.state.r[1]);
      desk.set("speed", Math.round(Math.min(Math.max(value + (back(at) - back(from)) / PULL, 0.1), 10) * 100) / 100);
      desk.soon();
    } else if (grip.is === "line") turnTo(value + angleOf(at) - angleOf(from));
    else if (grip.is === "cloth") turnTo(angleOf(at));
    held.at = at;
  }
  function turnBall(ball: number, degrees: number): void {
    desk.faces[ball] = (Math.round(desk.faces[ball]! + degrees) + 720) % 360;
    desk.soon();
  }
  /** Puts a ball where there is room, beside another one if need be. Off the table it waits in a pocket; the cue ball does not. */
  function moveBall(ball: number, [x, y]: [number, number]): void {
    const { table, balls } = desk;
    const R = balls[ball]!.kind.radius;
    const out = Math.max(-x, x - table.width, -y, y - table.length) > 1.5 * R;
    if (out && ball !== 0 && table.pockets.length > 0) desk.balls = balls.map((one, k) => (k === ball ? { kind: one.kind, state: pocketed(table, one.state) } : one));
    else
      try {
        desk.balls = carom.placeBall(table, balls, ball, ...beside(table, balls, ball, [x, y]));
      } catch (error) {
        if (error instanceof CaromError) return; // no room there: it stays
        throw error;
      }
    desk.soon();
  }
  function clicked(grip: Grip): void {
    if (grip.is === "ball" && grip.ball > 0) {
      desk.chosen = desk.chosen === grip.ball ? -1 : grip.ball;
      film.draw();
    } else if (grip.is === "pocket") desk.aimAt(grip.pocket);
  }

  canvas.addEventListener("pointerdown", (event) => {
    if (film.time > 0 || film.playing) film.go(0);
    const at = position(event);
    const grip = under(at, event.pointerType === "touch");
    held = { grip, at, from: at, value: grip.is === "stick" ? desk.value("speed") : grip.is === "turn" ? desk.faces[desk.chosen]! : desk.value("phi"), taps: true };
    // A finger on the cloth may be about to scroll the page: what it does waits for its end.
    if (event.pointerType === "touch") return;
    canvas.setPointerCapture(event.pointerId);
    if (grip.is === "cloth") drag(at);
  });
  canvas.addEventListener("pointermove", (event) => {
    if (!held) return;
    const at = position(event);
    if (Math.hypot(at[0] - held.from[0], at[1] - held.from[1]) * film.scale > 4) held.taps = false;
    if (!held.taps && !(event.pointerType === "touch" && held.grip.is === "cloth")) drag(at);
  });
  canvas.addEventListener("pointerup", (event) => {
    const was = held;
    if (was?.taps) {
      if (was.grip.is === "cloth") drag(was.at);
      else clicked(was.grip);
    }
    held = undefined;
  });
  canvas.addEventListener("pointercancel", () => (held = undefined));
  canvas.addEventListener(
    "touchstart",
    (event) => {
      const grip = event.touches.length === 1 ? under(position(event.touches[0]!), true).is : "cloth";
      if (grip !== "cloth" && grip !== "pocket" && event.cancelable) event.preventDefault();
    },
    { passive: false },
  );
  canvas.addEventListener(
    "wheel",
    (event) => {
      const grip = under(position(event), false);
      if (grip.is !== "ball" || !onTable(desk.balls[grip.ball]!.state)) return;
      event.preventDefault();
      turnBall(grip.ball, Math.sign(event.deltaY) * 10);
    },
    { passive: false },
  );
  canvas.addEventListener("keydown", (event) => {
    const by = event.shiftKey ? 1 : 0.1;
    const turn = (degrees: number): void => desk.set("phi", Math.round(((desk.value("phi") + degrees + 360) % 360) * 1e6) / 1e6);
    const hasten = (more: number): void => desk.set("speed", Math.round(Math.min(Math.max(desk.value("speed") + more, 0.1), 10) * 1e6) / 1e6);
    const arrows: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
    const arrow = arrows[event.key];
    if (event.key === " ") film.play.click();
    else if ((event.ctrlKey || event.metaKey) && event.key === "z") desk.undo();
    else if (event.key === "," || event.key === ".") turnBall(Math.max(desk.chosen, 0), event.key === "." ? 10 : -10);
    else if (event.altKey && arrow) {
      // The picked ball, or the cue ball, by 1 mm as one sees it.
      const { r } = desk.balls[Math.max(desk.chosen, 0)]!.state;
      const [px, py] = film.place(r[0], r[1]);
      moveBall(Math.max(desk.chosen, 0), film.unplace(px + arrow[0] * by * 0.01 * film.scale, py + arrow[1] * by * 0.01 * film.scale));
    } else if (!arrow) return;
    else if (arrow[0] !== 0) turn(-arrow[0] * by);
    else hasten(-arrow[1] * 0.1);
    event.preventDefault();
    if (arrow && !event.altKey) desk.aimed();
  });

  return { draw };
}
