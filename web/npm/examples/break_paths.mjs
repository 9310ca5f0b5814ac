/* A nine-ball break, drawn: the path of every ball, as a picture that JavaScript writes.
 *
 * A shot knows where its balls are at every time, so a path needs no simulation in steps:
 * `positionsAt` gives the places at many
 * times at once. A page draws its frames by the same call.
 *
 *     node break_paths.mjs break.svg
 */
import { writeFileSync } from "node:fs";
import { load } from "carom";

const COLOURS = [
  "#777",
  "#e6b800",
  "#1f4fbf",
  "#d62718",
  "#5b2a86",
  "#e8731a",
  "#0c7a43",
  "#7a1f1f",
  "#111",
  "#c9a227",
];
const carom = await load();
const table = carom.table("9ft");
const shot = carom.simulate(table, carom.rack("nineball", table), { speed: 8 });

// The places of all balls every 20 ms: 3 numbers for each ball, time after time.
const times = Array.from({ length: Math.ceil(shot.time / 0.02) }, (_, k) => k * 0.02);
const places = shot.positionsAt(times);
const n = shot.balls.length;
const path = (ball) =>
  times.map((_, k) => [places[3 * (k * n + ball)], places[3 * (k * n + ball) + 1]]);

// The picture lies on its side: the length of the table is its x axis, in mm.
const mm = (metres) => (1000 * metres).toFixed(0);
const points = (ball) =>
  path(ball)
    .map(([x, y]) => `${mm(y)},${mm(x)}`)
    .join(" ");
const pockets = table.pockets.map(
  ({ centre: [x, y], radius }) => `<circle cx="${mm(y)}" cy="${mm(x)}" r="${mm(radius)}"/>`,
);
const paths = COLOURS.map(
  (colour, ball) =>
    `<polyline points="${points(ball)}" fill="none" stroke="${colour}" stroke-width="7"/>`,
);
const svg = `<svg xmlns="http://www.w3.org/2000/svg" viewBox="-130 -130 ${mm(table.length + 0.26)} ${mm(table.width + 0.26)}" width="760">
<rect x="-130" y="-130" width="100%" height="100%" fill="#5a3d28"/><rect width="${mm(table.length)}" height="${mm(table.width)}" fill="#d9e8dc"/>
${[...pockets, ...paths].join("\n")}
</svg>
`;
writeFileSync(process.argv[2] ?? "break.svg", svg);

const down = shot.final.flatMap((state, ball) => (state.label === "pocketed" ? [ball] : []));
console.log(
  `${shot.count} events in ${shot.time.toFixed(2)} s; in pockets: ${down.join(", ") || "none"}`,
);
if (shot.status !== "ok" || shot.firstContact.ball !== 1)
  throw new Error(`the break failed: ${shot.status}`);
