/*
 * How exactly must one aim? The directions of the cue by which a ball falls into a corner pocket,
 * for three distances.  The ghost ball gives a first direction: the cue ball's centre must arrive
 * one diameter behind the object ball, on the line from the pocket. Throw turns the object ball off
 * that line, so the directions that pot are not centred on it. Bisection finds their ends.  node
 * pot_window.mjs
 */
import { load } from "carom";

const carom = await load();
const table = carom.table("9ft");
const kind = carom.kind("pool");
const DEGREE = Math.PI / 180;
const [px, py] = table.pockets
  .map((pocket) => pocket.centre)
  .reduce((far, corner) => (corner[0] + corner[1] > far[0] + far[1] ? corner : far));

/** Does ball 1 fall, with the cue ball behind it for a cut of 30 degrees? */
function pots(distance, phi) {
  const { balls } = layout(distance);
  return carom.simulate(table, balls, { speed: 2.9, phi }).final[1].label === "pocketed";
}

/**
 * Both balls, and the direction by the ghost ball, degrees. Ball 1 lies on the diagonal of the
 * pocket.
 */
function layout(distance) {
  const dx = Math.SQRT1_2;
  const dy = Math.SQRT1_2; // towards the pocket
  const x = px - distance * dx;
  const y = py - distance * dy;
  const ghost = [x - 2 * kind.radius * dx, y - 2 * kind.radius * dy];
  const phi = 45 + 30;
  const cue = [ghost[0] - 0.4 * Math.cos(phi * DEGREE), ghost[1] - 0.4 * Math.sin(phi * DEGREE)];
  return { balls: [carom.ball(...cue), carom.ball(x, y)], phi };
}

/** The end of the window between a direction that pots and one that does not, to 1e-6 degrees. */
function edge(distance, inside, outside) {
  while (Math.abs(outside - inside) > 1e-6) {
    const middle = (inside + outside) / 2;
    if (pots(distance, middle)) inside = middle;
    else outside = middle;
  }
  return inside;
}

let previous = Infinity;
for (const distance of [0.3, 0.6, 0.9]) {
  const { phi } = layout(distance);
  const inside = Array.from({ length: 401 }, (_, k) => phi - 2 + k / 100).find((direction) =>
    pots(distance, direction),
  );
  if (inside === undefined) throw new Error(`no direction pots from ${distance} m`);
  const low = edge(distance, inside, inside - 0.02);
  const high = edge(distance, inside, inside + 4);
  const middle = (low + high) / 2 - phi;
  console.log(
    `${distance} m: ${(high - low).toFixed(2)} degrees wide, its middle ${middle.toFixed(2)} degrees from the ghost ball's direction`,
  );
  if (!(high - low > 0 && high - low < previous))
    throw new Error("the window should shrink with the distance");
  previous = high - low;
}
