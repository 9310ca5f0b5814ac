// The table of the laboratory from the side: height over length, of paths of balls that leave the cloth, and of the balls now.
import type { Shot, ShotBall, Table } from "carom";
import { colourOf } from "../../../player/words.js";
import { onTable, type Path } from "../table/filmed.js";
import { color, fit } from "../ui.js";

/** Whether a ball leaves the cloth. */
export function flies(paths: readonly Path[], balls: readonly ShotBall[]): boolean {
  return paths.some(({ xyz, ball }) => xyz.some((z, k) => k % 3 === 2 && z > balls[ball]!.kind.radius + 1e-6));
}

export function drawSide(canvas: HTMLCanvasElement, of: { table: Table; balls: readonly ShotBall[]; names: readonly string[] }, paths: readonly Path[], shot: Shot | undefined, time: number): void {
  const { table, balls, names } = of;
  const { g, width, height } = fit(canvas, 0.18);
  const across = width / (table.length + 0.2);
  let highest = 0;
  for (const { xyz, ball } of paths) for (let k = 2; k < xyz.length; k += 3) highest = Math.max(highest, xyz[k]! + balls[ball]!.kind.radius);
  const up = Math.min(3 * across, (height - 14) / highest);
  const at = (y: number, z: number): [number, number] => [(y + 0.1) * across, height - 8 - z * up];
  g.fillStyle = color("back");
  g.fillRect(0, 0, width, height);
  g.fillStyle = color("cloth");
  g.fillRect(0, height - 8, width, 8);
  for (const { ball, xyz } of paths) {
    g.strokeStyle = ball === 0 ? color("text") : colourOf(names[ball]!, ball);
    g.lineWidth = 1.5;
    g.beginPath();
    for (let k = 0; k < xyz.length; k += 3) {
      if (xyz[k + 2]! < 0) break;
      g[k === 0 ? "moveTo" : "lineTo"](...at(xyz[k + 1]!, xyz[k + 2]!));
    }
    g.stroke();
  }
  shot?.states(time).forEach((state, k) => {
    if (!onTable(state)) return;
    g.beginPath();
    g.ellipse(...at(state.r[1], state.r[2]), balls[k]!.kind.radius * across, balls[k]!.kind.radius * up, 0, 0, 7);
    g.fillStyle = colourOf(names[k]!, k);
    g.fill();
    g.strokeStyle = "#000a";
    g.stroke();
  });
}
