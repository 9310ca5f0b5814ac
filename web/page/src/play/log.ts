// The log of strokes: the intention and the cost of each, saved by the browser, and a page to
// print.
import { GAMES, PLAYED } from "../table/games.js";
import { percent } from "../table/words.js";
import { button, dialog, el } from "../ui.js";
import { keepText, keptValue } from "./keep.js";
import { texts, translate } from "../texts/texts.js";

const LOG = "carom-log";
const MOST = 500;

/**
 * A stroke of the log. Errors are those of the aim at the ball that was meant: the direction,
 * degrees, and the speed beyond its range, m/s; and the side of
 * the tip, radii. Of a drill nothing is planned, and `best` is what came and what to change.
 */
export interface Row {
  when: string;
  game: string;
  meant: string;
  phi?: number;
  speed?: number;
  side?: number;
  /** Chances that it keeps the turn and wins, of this stroke and of the best one. */
  keep?: number;
  value?: number;
  best: string;
  bestValue?: number;
}
/**
 * What a stroke cost against the best one: its chance to win less, never below 0 but for the spread
 * of both plans.
 */
export const costOf = ({ value, bestValue }: Row): number | undefined =>
  value === undefined ? undefined : Math.max(bestValue! - value, 0);

/** The game or the drill of a row. */
const nameOfGame = (game: string): string => (PLAYED[game] ?? GAMES[game])?.text ?? translate(game);

const rows = (): Row[] => keptValue<Row[]>(LOG, [], Array.isArray);
export const keepRow = (row: Row): void =>
  keepText(JSON.stringify([...rows(), row].slice(-MOST)), LOG);

/** The log as a page to print. */
export function logPage(plan: () => string): { root: HTMLDialogElement; open(): void } {
  const body = el("tbody");
  const sum = el("p#log-sum");
  const head = [
    texts.when,
    texts.game,
    texts.meant,
    texts.aimOffBy,
    texts.speedOffByM,
    texts.tipRightColumn,
    texts.keepsTheTurn,
    texts.wins,
    texts.bestStrokeOrWhat,
    texts.bestWins,
    texts.cost,
  ];
  const table = el(
    "table.numbers.log",
    el("caption", texts.strokesTheLastOne),
    el("thead", el("tr", ...head.map((text) => el("th", { scope: "col" }, text)))),
    body,
  );
  const clear = button(texts.deleteAll, () => {
    keepText("[]", LOG);
    fill();
  });
  const root = dialog(
    "log",
    texts.whatYourStrokesCost,
    sum,
    el("div.scrolls", { tabindex: "0", role: "region", "aria-label": texts.strokes }, table),
    el(
      "div.row.no-print",
      button(texts.print, () => window.print(), "#print-log"),
      clear,
    ),
  );
  function fill(): void {
    const entries = rows();
    const fixed = (x: number | undefined, places: number): string =>
      x === undefined ? "–" : x.toFixed(places).replace(/^-(?=[0.]*$)/, "");
    const share = (x: number | undefined): string => (x === undefined ? "–" : percent(x));
    body.replaceChildren(
      ...[...entries]
        .reverse()
        .map((row) =>
          el(
            "tr",
            ...[
              row.when.replace("T", " "),
              nameOfGame(row.game),
              translate(row.meant),
              fixed(row.phi, 2),
              fixed(row.speed, 1),
              fixed(row.side, 2),
              share(row.keep),
              share(row.value),
              row.best,
              share(row.bestValue),
              share(costOf(row)),
            ].map((text, k) => el("td", { "data-head": head[k]! }, text)),
          ),
        ),
    );
    /** The mean of what was measured, and of how many strokes; "" where nothing was. */
    const mean = (
      value: (row: Row) => number | undefined,
      words: (mean: number) => string,
    ): string => {
      const known = entries.flatMap((row) => value(row) ?? []);
      if (known.length === 0) return "";
      const sum = known.reduce((total, x) => total + x, 0);
      return texts.meanOf(words(sum / known.length), known.length);
    };
    const cost = mean(costOf, (x) => texts.aStrokeCostOf(percent(x)));
    const aim = mean(
      ({ phi }) => phi && Math.abs(phi),
      (x) => texts.theAimWasOff(x.toFixed(2)),
    );
    sum.textContent =
      entries.length === 0
        ? texts.noStrokeYetThe(plan())
        : `${texts.strokesCounted(entries.length)}.${cost}${aim} ${plan()}`;
  }
  return {
    root,
    open() {
      fill();
      root.showModal();
    },
  };
}
