// Small drawings in SVG: a ball with its colour, stripe and number, and a rack of balls.
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
  const parts = [`<circle r="1" fill="${isStripe ? IVORY : colour}"/>`];
  if (isStripe) {
    const band = "M-0.87-0.5H0.87A1 1 0 0 1 0.87 0.5H-0.87A1 1 0 0 1 -0.87-0.5Z";
    parts.push(`<path d="${band}" fill="${colour}"/>`);
  }
  if (number > 0 && hasNumber) {
    const font = 'text-anchor="middle" font-size="0.68" font-weight="bold" fill="#16181b"';
    parts.push(`<circle r="0.48" fill="${IVORY}"/>`, `<text y="0.25" ${font}>${name}</text>`);
  }
  parts.push(
    '<circle cx="-0.35" cy="-0.4" r="0.22" fill="#fffa"/>',
    '<circle r="0.97" fill="none" stroke="#0005" stroke-width="0.06"/>',
  );
  return parts.join("");
}
/** A drawing of a square around the centre, hidden from screen readers. */
function picture(side: number, markup: string): HTMLElement {
  const root = el("span.picture", { "aria-hidden": "true" });
  root.innerHTML = `<svg viewBox="${-side / 2} ${-side / 2} ${side} ${side}">${markup}</svg>`;
  return root;
}
/** Ball `k` of a layout. */
export const ballPicture = (name: string, k: number, radius: number): HTMLElement =>
  picture(2, ballMarkup(name, colourOf(name, k, radius)));

function rangeOf(values: readonly number[]): { middle: number; extent: number } {
  const low = Math.min(...values);
  const high = Math.max(...values);
  return { middle: (low + high) / 2, extent: high - low };
}
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
  const horizontal = rangeOf(seen.map(({ x }) => x));
  const vertical = rangeOf(seen.map(({ y }) => y));
  const side = 1.25 * Math.max(horizontal.extent, vertical.extent) + 0.08;
  const least = (seen.length > 6 ? 0.035 : 0.09) * side;
  const markup = seen.map(({ name, k, radius, x, y }) => {
    const right = (x - horizontal.middle).toFixed(3);
    const down = (vertical.middle - y).toFixed(3);
    const scale = Math.max(radius, least).toFixed(4);
    const ball = ballMarkup(name, colourOf(name, k, radius), false);
    return `<g transform="translate(${right} ${down}) scale(${scale})">${ball}</g>`;
  });
  return picture(side, markup.join(""));
}
