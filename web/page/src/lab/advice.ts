// Best shot, and the chance of the shot that is aimed: the panel of the laboratory.
import type { GameState, PlanOptions, Player } from "carom";
import { far } from "../far.js";
import { onTable } from "../table/filmed.js";
import { RATINGS, wordsOfChances, wordsOfChoice } from "../table/words.js";
import { button, choice, el, latest } from "../ui.js";
import { aim, cueOf, type Desk, optionsOf } from "./desk.js";

const PLAN = 1000;
const TRY = 100;
const RULED = ["eightball", "nineball", "threecushion"];

export function advicePanel(d: Desk): { root: HTMLElement; aimed(): void } {
  const own = choice("own", "A player", [["0", "without errors"], ...RATINGS.map((r) => [r, `rated ${r}`] as const)], () => void chances());
  own.select.value = "600";
  const chance = el("p", { id: "chance" });
  const said = el("p", { id: "advice", role: "status" });
  const root = el(
    "section",
    { class: "panel", "aria-label": "Best shot", id: "advice-panel" },
    el("h2", {}, "Best shot"),
    el("div", { class: "row" }, button("Best shot", () => void propose(), { id: "best" }), own.root),
    chance,
    said,
  );

  const player = (rating: string): Player => (rating === "0" ? d.carom.player({ errors: 0 }) : d.carom.player({ fargo: Number(rating) }));
  const name = (): string => (d.known ? d.gameName : "");
  /** An open table, and a break from a full rack. */
  function options(): PlanOptions {
    const racked = name() !== "threecushion" && d.balls.every(({ state }, k) => k === 0 || (onTable(state) && state.r[1] > 0.6 * d.table.length));
    const game: GameState = { rules: name() as GameState["rules"], group: "open", opening: racked };
    return { ...game, player: player(own.select.value), shot: optionsOf(d), seed: 1 };
  }

  const advises = latest((text) => (said.textContent = text));
  const propose = (): Promise<void> =>
    advises(async (wanted) => {
      said.textContent = "Looking for the best shot …";
      const [one] = await far("plan", d.table, d.balls, { ...options(), best: 1, shots: PLAN });
      if (wanted()) {
        aim(d, one!.cue);
        d.aimed();
      }
      return `Best of ${PLAN} shots: ${wordsOfChoice(d.table, d.names, one!)}.`;
    });

  const tells = latest((text) => (chance.textContent = text));
  /** The chances of the stroke that is aimed, a moment after it was. */
  const chances = (): Promise<void> =>
    tells(async (wanted) => {
      root.hidden = !RULED.includes(name());
      chance.textContent = "";
      if (root.hidden || !onTable(d.balls[0]!.state)) return "";
      await new Promise((later) => window.setTimeout(later, 60));
      if (!wanted()) return "";
      const [one] = await far("chances", d.table, d.balls, [cueOf(d)], { ...options(), shots: TRY });
      const call = one!.ball > 0 && d.table.pockets.length > 0 ? `pots ball ${d.names[one!.ball]}, ` : "";
      return `This shot ${call}${wordsOfChances(one!, name() === "threecushion")}.`;
    });

  return { root, aimed: () => void chances() };
}
