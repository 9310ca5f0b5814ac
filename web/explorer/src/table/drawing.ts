// What is drawn over the table while one aims: the stick, the ghost ball, lines, and rings around balls.
import type { Contact, Cue, ShotBall } from "carom";

const DEGREES = 180 / Math.PI;
/** How far the stick is drawn back for each m/s, m. */
export const PULL = 0.04;
export const stickEnd = (radius: number, speed: number): number => radius + PULL * speed;

/** A context with the scale and the place of a table on it. */
export interface Pen {
  g: CanvasRenderingContext2D;
  scale: number;
  place(x: number, y: number): [number, number];
}

export function stroke({ g, place }: Pen, from: readonly number[], to: readonly number[], width: number, style: string): void {
  g.strokeStyle = style;
  g.lineWidth = width;
  g.beginPath();
  g.moveTo(...place(from[0]!, from[1]!));
  g.lineTo(...place(to[0]!, to[1]!));
  g.stroke();
}

/** A circle of a radius, m, and some pixels more. */
export function ring({ g, scale, place }: Pen, at: readonly number[], radius: number, more: number): void {
  g.beginPath();
  g.arc(...place(at[0]!, at[1]!), radius * scale + more, 0, 7);
  g.stroke();
}

/** The ghost ball of a contact, the line of the ball that is met, and the tangent line, to the side where the cue ball goes. */
export function drawContact(pen: Pen, { event, ball }: Contact, radius: number, [dx, dy]: readonly [number, number], length = 0.35): void {
  const [ghost, object] = event.a === ball ? [event.before[1]!.r, event.before[0]!.r] : [event.before[0]!.r, event.before[1]!.r];
  const [nx, ny] = [(object[0] - ghost[0]) / (2 * radius), (object[1] - ghost[1]) / (2 * radius)];
  pen.g.setLineDash([5, 4]);
  if (length > 0) {
    stroke(pen, object, [object[0] + length * nx, object[1] + length * ny], 1.4, "#ffffffd0");
    const turn = Math.sign(dx * -ny + dy * nx) || 1;
    stroke(pen, ghost, [ghost[0] - length * turn * ny, ghost[1] + length * turn * nx], 1.4, "#ffffffd0");
  }
  pen.g.lineWidth = 1.4;
  pen.g.strokeStyle = "#ffffffd0";
  ring(pen, ghost, radius, 0);
  pen.g.setLineDash([]);
}

/** The stick behind the cue ball, drawn back by its speed. */
export function drawStick(pen: Pen, cueBall: ShotBall, { phi, theta, speed }: Cue): void {
  const { r } = cueBall.state;
  const [dx, dy] = [Math.cos(phi / DEGREES), Math.sin(phi / DEGREES)];
  const at = (s: number): [number, number] => [r[0] - dx * s, r[1] - dy * s];
  const gap = stickEnd(cueBall.kind.radius, speed);
  const thick = Math.max(0.012 * pen.scale, 3);
  pen.g.lineCap = "round";
  stroke(pen, at(gap), at(gap + 1.3 * Math.max(Math.cos(theta / DEGREES), 0.15)), thick, "#d9b077");
  stroke(pen, at(gap), at(gap + 0.017), 0.8 * thick, "#3f7fbf");
}
