/* Two players on two machines: only strokes travel, and both see the same game to the last bit.
 *
 * carom computes the same bits in every browser and on every processor, so a client needs the
 * strokes only, not the places of balls.
 * A digest of the states tells whether both still agree. Here the two clients are the two builds of
 * the package, with vectors and
 * without. One of them receives each stroke as text, as over a network.
 *
 *     node lockstep.mjs
 */
import { load } from "carom";

/**
 * A digest of numbers, FNV-1a of their bytes: it tells that states differ, and is no seal against
 * cheats.
 */
function digest(numbers) {
  const bytes = new Uint8Array(Float64Array.from(numbers).buffer);
  return (bytes.reduce((hash, byte) => Math.imul(hash ^ byte, 0x01000193), 0x811c9dc5) >>> 0)
    .toString(16)
    .padStart(8, "0");
}

/** Ball in hand: a free place on the head string of the table, as near its middle as tenths say. */
function placeOnHeadString(table, balls) {
  const y = table.length / 4;
  const isFree = (x) =>
    balls.every(
      ({ kind, state }) =>
        state.label === "pocketed" ||
        Math.hypot(state.r[0] - x, state.r[1] - y) > kind.radius + balls[0].kind.radius,
    );
  return [[5, 4, 6, 3, 7, 2, 8].map((k) => (k * table.width) / 10).find(isFree), y];
}

/** A client: its balls, and what it does with a stroke that arrives as text. */
async function client(build) {
  const carom = await load({ build });
  const table = carom.table("8ft");
  let balls = carom.rack("eightball", table, { seed: 42 });
  return {
    build: carom.build,
    play(text) {
      const shot = carom.simulate(table, balls, JSON.parse(text));
      balls = balls.map(({ kind }, k) => ({ kind, state: shot.final[k] }));
      if (balls[0].state.label === "pocketed")
        balls = carom.placeBall(table, balls, 0, ...placeOnHeadString(table, balls));
      return digest(balls.flatMap(({ state }) => [...state.r, ...state.w]));
    },
  };
}

const home = await client("simd");
const guest = await client("plain");
const strokes = [
  { speed: 8, phi: 90 },
  { speed: 3, phi: 62.5, a: 0.2 },
  { speed: 2.2, phi: 200, b: -0.3 },
  { speed: 4, phi: 310 },
];
for (const stroke of strokes) {
  const text = JSON.stringify(stroke);
  const digests = [home.play(text), guest.play(text)];
  console.log(`${text}: ${digests[0]}`);
  if (digests[0] !== digests[1])
    throw new Error(`${home.build} and ${guest.build} differ after ${text}`);
}
console.log(`${strokes.length} strokes, ${home.build} and ${guest.build} agree`);
