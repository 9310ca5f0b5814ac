/* A nine-ball break, drawn: the path of every ball, as a picture that JavaScript writes.
 *
 * A shot knows where its balls are at every time, so a path needs no simulation in steps:
 * `positionsAt` gives the places at many
 * times at once. A page draws its frames by the same call.
 *
 *     node break_paths.mjs break.svg
 */
import { writeFileSync } from "node:fs";
import { load, palette } from "carom";

const carom = await load();
const table = carom.table("9ft");
const shot = carom.simulate(table, carom.rack("nineball", table), { speed: 8 });

// The places of all balls every 20 ms: 3 numbers for each ball, time after time.
const times = Array.from({ length: Math.ceil(shot.time / 0.02) }, (_, k) => k * 0.02);
const places = shot.positionsAt(times);
const n = shot.balls.length;
const path = (ball) =>
  times.map((_, k) => [places[3 * (k * n + ball)], places[3 * (k * n + ball) + 1]]);

// The picture lies on its side: the length of the table is its x axis, in mm. Its colours and sizes
// are those of `carom shoot --plot`.
const mm = (metres) => (1000 * metres).toFixed(0);
const at = ([x, y]) => `${mm(y)},${mm(x)}`;
const { cloth, cushion, wood, part, size, balls } = palette;
const disc = ({ centre: [x, y], radius }, style) =>
  `<circle cx="${mm(y)}" cy="${mm(x)}" r="${mm(radius)}" ${style}/>`;
const frame = (beyond, corner, fill) =>
  `<rect x="${mm(-beyond)}" y="${mm(-beyond)}" width="${mm(table.length + 2 * beyond)}" height="${mm(table.width + 2 * beyond)}" rx="${mm(corner)}" fill="${fill}"/>`;
const line = (points, style) =>
  `<polyline points="${points.map(at).join(" ")}" fill="none" ${style}/>`;

// The wood reaches as far beyond the pockets' facings as they reach beyond the noses.
const ends = table.rails.flatMap(({ p, q }) => [p[1], q[1]]);
const facings = -Math.min(...ends);
const margin = size.margin * (Math.max(...ends) - Math.min(...ends));
const nose = `stroke="${part.nose}" stroke-width="${mm(size.nose)}" stroke-linecap="round"`;
const drawn = [
  frame(facings + margin, size.corner, wood.pool),
  frame(facings + margin / 2, size.bedCorner, cloth.pool),
  ...table.pockets.map((pocket) => disc(pocket, `fill="${part.pocket}"`)),
  ...table.jaws.map((jaw) => disc(jaw, `fill="${cushion.pool}"`)),
  ...table.rails.map(({ p, q }) => line([p, q], nose)),
];
// Ball 9 is striped: it has the colour of ball 1, and dashes.
const styleOf = (ball) =>
  `stroke="${balls[ball > 8 ? ball - 8 : ball].path}" stroke-width="${mm(size.path)}"${ball > 8 ? ' stroke-dasharray="40 8"' : ""}`;
for (let ball = 0; ball < n; ball++) drawn.push(line(path(ball), styleOf(ball)));
shot.final.forEach(({ r }, ball) => {
  const { colour, path } = balls[ball > 8 ? ball - 8 : ball];
  const style = `fill="${colour}" stroke="${path}" stroke-width="4"`;
  drawn.push(disc({ centre: r, radius: shot.balls[ball].kind.radius }, style));
});
const corner = mm(-facings - margin);
const [width, height] = [table.length, table.width].map((side) =>
  mm(side + 2 * (facings + margin)),
);
const svg = `<svg xmlns="http://www.w3.org/2000/svg" viewBox="${corner} ${corner} ${width} ${height}" width="760">
${drawn.join("\n")}
</svg>
`;
writeFileSync(process.argv[2] ?? "break.svg", svg);

const down = shot.final.flatMap((state, ball) => (state.label === "pocketed" ? [ball] : []));
console.log(
  `${shot.count} events in ${shot.time.toFixed(2)} s; in pockets: ${down.join(", ") || "none"}`,
);
if (shot.status !== "ok" || shot.firstContact.ball !== 1)
  throw new Error(`the break failed: ${shot.status}`);
