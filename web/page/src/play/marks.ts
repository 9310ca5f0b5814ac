// Small pictures, drawn as SVG: a ball with its colour, stripe and number, and a rack of them.
import type { Carom } from "carom";
import { colourOf } from "../../../player/words.js";
import { onTable } from "../table/filmed.js";
import { GAMES, PLAYED } from "../table/games.js";
import { el } from "../ui.js";

const IVORY = "#f7f2e4";
/** A ball of radius 1 as markup; with its number where there is room for one. */
export function ballMarkup(name: string, colour: string, hasNumber = true): string {
  const number = Number(name);
  const isStripe = number > 8;
  const band = `<path d="M-0.87-0.5H0.87A1 1 0 0 1 0.87 0.5H-0.87A1 1 0 0 1 -0.87-0.5Z" fill="${colour}"/>`;
  const label = `<circle r="0.48" fill="${IVORY}"/><text y="0.25" text-anchor="middle" font-size="0.68" font-weight="bold" fill="#16181b">${name}</text>`;
  return `<circle r="1" fill="${isStripe ? IVORY : colour}"/>${isStripe ? band : ""}${
    number > 0 && hasNumber ? label : ""
  }<circle cx="-0.35" cy="-0.4" r="0.22" fill="#fffa"/><circle r="0.97" fill="none" stroke="#0005" stroke-width="0.06"/>`;
}
/** A picture of a square around the middle, hidden from readers of the screen. */
function picture(side: number, markup: string): HTMLElement {
  const root = el("span.picture", { "aria-hidden": "true" });
  root.innerHTML = `<svg viewBox="${-side / 2} ${-side / 2} ${side} ${side}">${markup}</svg>`;
  return root;
}
/** Ball `k` of a layout. */
export const ballPicture = (name: string, k: number, radius: number): HTMLElement =>
  picture(2, ballMarkup(name, colourOf(name, k, radius)));

/** The balls of a game as they are racked: those of a triangle from near, others on the table. */
export function rackPicture(carom: Carom, game: string): HTMLElement {
  const { rack, table, names } = GAMES[PLAYED[game]?.base ?? game]!;
  const balls = carom.rack(rack, carom.table(table), { seed: 1 });
  const racked = balls.flatMap(({ kind, state }, k) =>
    onTable(state)
      ? [{ name: names(k), k, radius: kind.radius, x: state.r[0], y: state.r[1] }]
      : [],
  );
  // Where there are only three or four balls, each of them is seen.
  const seen = racked.length > 4 ? racked.filter(({ k }) => k > 0) : racked;
  const [xs, ys] = [seen.map(({ x }) => x), seen.map(({ y }) => y)];
  const [left, right, low, high] = [
    Math.min(...xs),
    Math.max(...xs),
    Math.min(...ys),
    Math.max(...ys),
  ];
  const extent = Math.max(right - left, high - low);
  const side = 1.25 * extent + 0.08;
  const markup = seen.map(({ name, k, radius, x, y }) => {
    const size = Math.max(radius, (seen.length > 6 ? 0.035 : 0.09) * side);
    const [px, py] = [x - (left + right) / 2, (low + high) / 2 - y];
    const ball = ballMarkup(name, colourOf(name, k, radius), false);
    return `<g transform="translate(${px.toFixed(3)} ${py.toFixed(3)}) scale(${size.toFixed(4)})">${ball}</g>`;
  });
  return picture(side, markup.join(""));
}
