// The fan of the laboratory: many shots with a player's errors, drawn under the trails as their paths and places of rest.
import { colourOf } from "../../../player/words.js";
import { onTable, pathsOf } from "../table/filmed.js";
import { cueOf, type Desk, FAN, optionsOf } from "./desk.js";

const CHUNK = 20;
const ROOM = 400;

/** Two draws from a normal distribution, by Box and Muller. */
function normal(): [number, number] {
  const radius = Math.sqrt(-2 * Math.log(1 - Math.random()));
  const angle = 2 * Math.PI * Math.random();
  return [radius * Math.cos(angle), radius * Math.sin(angle)];
}

/** Draws a fan in chunks, one a frame, while `goes` holds; `drawn` gets the layer after each, with the shots so far and the library's time, ms. */
export async function fan(d: Desk, goes: () => boolean, drawn: (layer: HTMLCanvasElement, shots: number, ms: number) => void): Promise<void> {
  const { carom, table, balls, names, film: { canvas, place } } = d;
  const [cue, options, sigma] = [cueOf(d), optionsOf(d), d.controls.value("error")];
  const layer = document.createElement("canvas");
  layer.width = canvas.width;
  layer.height = canvas.height;
  const g = layer.getContext("2d")!;
  g.setTransform(window.devicePixelRatio || 1, 0, 0, window.devicePixelRatio || 1, 0, 0);
  const shots = carom.shots(table, balls, CHUNK, { room: ROOM });
  let computed = 0;
  for (let done = 0; done < FAN; done += CHUNK) {
    await new Promise(requestAnimationFrame);
    if (!goes()) break;
    const begun = performance.now();
    for (let k = 0; k < CHUNK; k++) {
      const [turned, faster] = normal();
      shots.setCue(k, { ...cue, phi: cue.phi + sigma * turned, speed: cue.speed * Math.max(0.1, 1 + 0.03 * faster) });
    }
    carom.simulateBatch(shots, options);
    computed += performance.now() - begun;
    for (let k = 0; k < CHUNK; k++) {
      if (shots.status[k]! < 0 || shots.events(k) > ROOM) continue;
      const one = shots.shot(k);
      // Paths of the cue ball, and where every ball comes to rest.
      g.strokeStyle = "#ffffff";
      g.globalAlpha = 0.045;
      g.lineWidth = 1.4;
      g.beginPath();
      const { xyz = [] } = pathsOf(one, 20, 200).find(({ ball }) => ball === 0) ?? {};
      for (let t = 0; t < xyz.length && xyz[t + 2]! > 0; t += 3) g[t === 0 ? "moveTo" : "lineTo"](...place(xyz[t]!, xyz[t + 1]!));
      g.stroke();
      g.globalAlpha = 0.25;
      one.final.forEach((state, ball) => {
        if (!onTable(state) || !onTable(balls[ball]!.state)) return;
        g.fillStyle = colourOf(names[ball]!, ball);
        g.beginPath();
        g.arc(...place(state.r[0], state.r[1]), 2, 0, 7);
        g.fill();
      });
    }
    drawn(layer, done + CHUNK, computed);
  }
  shots.free();
}
