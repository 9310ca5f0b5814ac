// Best shot, and the chance of the shot that is aimed: the panel of the laboratory.
import type { Carom, Cue, GameState, PlanOptions, Player, ShotBall, ShotOptions, Table } from "carom";
import { far } from "../far.js";
import { onTable } from "../table/filmed.js";
import { RATINGS, wordsOfChances, wordsOfChoice } from "../table/words.js";
import { button, choice, el } from "../ui.js";

/** What the panel needs of the view, and does with it. */
export interface View {
  /** The game whose rules hold for the balls, or "". */
  name(): string;
  table(): Table;
  balls(): ShotBall[];
  names(): string[];
  cue(): Cue;
  options(): ShotOptions;
  /** Aims as a stroke says. */
  aim(cue: Cue): void;
}

const PLAN = 1000;
const TRY = 100;
const RULED = ["eightball", "nineball", "threecushion"];

export function advicePanel(carom: Carom, view: View): { root: HTMLElement; aimed(): void } {
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

  const player = (rating: string): Player => (rating === "0" ? carom.player({ errors: 0 }) : carom.player({ fargo: Number(rating) }));
  /** An open table, and a break from a full rack. */
  function options(): PlanOptions {
    const racked = view.name() !== "threecushion" && view.balls().every(({ state }, k) => k === 0 || (onTable(state) && state.r[1] > 0.6 * view.table().length));
    const game: GameState = { rules: view.name() as GameState["rules"], group: "open", opening: racked };
    return { ...game, player: player(own.select.value), shot: view.options(), seed: 1 };
  }

  let number = 0;
  async function propose(): Promise<void> {
    const mine = ++number;
    said.textContent = "Looking for the best shot …";
    let text: string;
    try {
      const [one] = await far("plan", view.table(), view.balls(), { ...options(), best: 1, shots: PLAN });
      if (mine !== number) return;
      view.aim(one!.cue);
      text = `Best of ${PLAN} shots: ${wordsOfChoice(view.table(), view.names(), one!)}.`;
    } catch (error) {
      text = error instanceof Error ? error.message : String(error);
    }
    // Aiming has begun no other search.
    if (mine === number) said.textContent = text;
  }

  let asked = 0;
  /** The chances of the stroke that is aimed, a moment after it was. */
  async function chances(): Promise<void> {
    const mine = ++asked;
    root.hidden = !RULED.includes(view.name());
    chance.textContent = "";
    if (root.hidden || !onTable(view.balls()[0]!.state)) return;
    await new Promise((later) => window.setTimeout(later, 60));
    if (mine !== asked) return;
    let text: string;
    try {
      const [one] = await far("chances", view.table(), view.balls(), [view.cue()], { ...options(), shots: TRY });
      const call = one!.ball > 0 && view.table().pockets.length > 0 ? `pots ball ${view.names()[one!.ball]}, ` : "";
      text = `This shot ${call}${wordsOfChances(one!, view.name() === "threecushion")}.`;
    } catch (error) {
      text = error instanceof Error ? error.message : String(error);
    }
    if (mine === asked) chance.textContent = text;
  }

  return { root, aimed: () => void chances() };
}
