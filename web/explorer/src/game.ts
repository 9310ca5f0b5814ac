// Best shot, chance of this shot, and a game against a player of any strength: the panel of the view Shot.
import type { Call, Carom, Choice, Cue, GameState, PlanOptions, Player, ShotBall, ShotOptions, Table } from "carom";
import { far } from "./far.js";
import { pocketName } from "../../../cli/player.js";
import { button, choice, el } from "./ui.js";

/** What the panel needs of the view, and does with it. */
export interface View {
  name(): string;
  table(): Table;
  balls(): ShotBall[];
  names(): string[];
  cue(): Cue;
  options(): ShotOptions;
  /** Aims as a stroke says. */
  aim(cue: Cue): void;
  /** Lays the balls for the next stroke. */
  lay(balls: ShotBall[]): void;
  /** Plays a stroke and its film, then calls back. */
  perform(cue: Cue, then: () => void): void;
  rackUp(): void;
}

type Hand = "no" | "anywhere" | "kitchen";
interface Match {
  game: GameState;
  mine: boolean;
  hand: Hand;
  over: boolean;
}

const RATINGS = ["400", "500", "600", "700"];
const PLAN = 1000;
const REPLY = 300;
const TRY = 100;
const percent = (x: number): string => `${(100 * x).toFixed(0)} %`;

export interface Panel {
  root: HTMLElement;
  /** The layout with the cue ball at the head spot, or near to it. */
  atHead(balls: readonly ShotBall[]): ShotBall[];
  aimed(): void;
  begin(): void;
  hand(): Hand | undefined;
  busy(): boolean;
}

export function gamePanel(carom: Carom, view: View): Panel {
  let match: Match | undefined;
  let busy = false;
  let strokes = 0;
  let number = 0;
  const seed = Math.floor(Math.random() * 2 ** 31);

  const own = choice("own", "You err like", [["0", "nobody: no errors"], ...RATINGS.map((r) => [r, `a ${r}`] as const)], () => void chances());
  own.select.value = "600";
  const other = choice("opponent", "Opponent", RATINGS.map((r) => [r, `a ${r}`] as const), () => undefined);
  other.select.value = "500";
  const advise = button("Best shot", () => void propose(), { id: "best" });
  const start = button("New game", newGame, { id: "new-game" });
  const shoot = button("Shoot", () => stroke(view.cue()), { id: "shoot", hidden: "" });
  const chance = el("p", { id: "chance" });
  const said = el("p", { id: "game-state", role: "status" });
  const root = el(
    "section",
    { class: "panel", "aria-label": "Best shot and game", id: "game-panel" },
    el("h2", {}, "Play"),
    el("div", { class: "row" }, advise, own.root),
    chance,
    el("div", { class: "row" }, start, other.root, shoot),
    said,
  );

  const player = (rating: string): Player => (rating === "0" ? carom.player({ errors: 0 }) : carom.player({ fargo: Number(rating) }));
  const isKnown = (): boolean => view.name() === "eightball" || view.name() === "nineball";
  /** The game as it stands; without a match, an open table, and a break from a full rack. */
  function state(): GameState {
    const racked = view.balls().every(({ state }, k) => k === 0 || (state.label !== "pocketed" && state.r[1] > 0.6 * view.table().length));
    return match?.game ?? { rules: view.name() as GameState["rules"], group: "open", opening: racked };
  }
  const plan = (mine: boolean): PlanOptions => {
    const [me, you] = [player(own.select.value), player(other.select.value)];
    return { ...state(), player: mine ? me : you, opponent: mine ? you : me, shot: view.options(), seed: seed + strokes };
  };
  /** The part of the table in which the cue ball may be put. */
  function place(hand: Hand): PlanOptions["inHand"] {
    const table = view.table();
    return hand === "kitchen" ? [[0, 0], [table.width, table.length / 4]] : hand === "anywhere";
  }
  function tell(text: string): void {
    said.textContent = text;
  }
  /** The best shot, from the worker. Nothing else is done meanwhile, but the page lives. Undefined where another game was begun. */
  async function best(options: PlanOptions): Promise<Choice | undefined> {
    busy = true;
    const mine = ++number;
    try {
      const [one] = await far("plan", view.table(), view.balls(), { ...options, best: 1 });
      return mine === number ? one : undefined;
    } catch (error) {
      if (mine === number) tell(error instanceof Error ? error.message : String(error));
      return undefined;
    } finally {
      if (mine === number) busy = false;
    }
  }
  const BY: Partial<Record<Choice["kind"], string>> = { bank: ", by a bank", kick: ", by a kick", combination: ", by a combination", carom: ", by a carom" };
  function words(one: Choice): string {
    if (one.ball < 0) return one.kind === "foul" ? "no shot without a foul was found" : one.kind === "break" ? "a break" : "a safety";
    return `ball ${view.names()[one.ball]} into the ${pocketName(view.table(), one.pocket)}${BY[one.kind] ?? ""}`;
  }

  // ---- Advice ----------------------------------------------------------------------------------------------------------------

  async function propose(): Promise<void> {
    if (busy || match?.over) return;
    tell("Looking for the best shot …");
    const inHand = match ? place(match.hand)! : false;
    const one = await best({ ...plan(true), shots: PLAN, inHand });
    if (!one) return;
    if (inHand !== false) view.lay(carom.placeBall(view.table(), view.balls(), 0, ...one.place));
    view.aim(one.cue);
    tell(`Best of ${PLAN} shots: ${words(one)}.`);
  }

  let asked = 0;
  /** The chances of the stroke that is aimed, a moment after it was. */
  async function chances(): Promise<void> {
    const mine = ++asked;
    root.hidden = !isKnown();
    if (root.hidden || busy || (match && (!match.mine || match.over))) return void (chance.textContent = "");
    await new Promise((later) => window.setTimeout(later, 60));
    if (mine !== asked) return;
    let text: string;
    try {
      const [one] = await far("chances", view.table(), view.balls(), [view.cue()], { ...plan(true), shots: TRY });
      const call = one!.ball > 0 ? `pots ball ${view.names()[one!.ball]}, ` : "";
      text = `This shot ${call}plays on ${percent(one!.keep)}, wins the game ${percent(one!.value)}, is a foul ${percent(one!.foul)}.`;
    } catch (error) {
      text = error instanceof Error ? error.message : String(error);
    }
    if (mine === asked) chance.textContent = text;
  }

  // ---- The game --------------------------------------------------------------------------------------------------------------

  function newGame(): void {
    if (busy) return;
    match = undefined;
    view.rackUp();
    match = { game: { ...state(), group: "open", opening: true }, mine: true, hand: "kitchen", over: false };
    strokes = 0;
    shoot.hidden = false;
    tell("You break. Drag the cue ball behind the head string, aim, then press Shoot.");
    void chances();
  }

  /** What a shot without errors pots of the balls that are on, which is what it calls. */
  function called(cue: Cue): Call | undefined {
    const on = carom.ballsOn(state(), view.balls());
    const shot = carom.simulate(view.table(), view.balls(), cue, view.options());
    const pot = shot.events.find((event) => event.type === "ball_pocket" && on.includes(event.a));
    return pot && { ball: pot.a, pocket: pot.b };
  }

  /** A stroke of whoever is at the table: the one that is meant, with errors. */
  function stroke(meant: Cue, call = called(meant)): void {
    if (busy || !match || match.over) return;
    const rating = (match.mine ? own : other).select.value;
    const made = rating === "0" && match.mine ? meant : carom.withErrors(meant, player(rating), seed, strokes++);
    const [game, balls] = [match.game, view.balls()];
    busy = true;
    chance.textContent = "";
    view.perform(made, () => {
      busy = false;
      const ruling = carom.referee(view.table(), balls, made, game, call, view.options());
      const { mine } = match!;
      const passes = ruling.turn === "pass" || ruling.turn === "lose";
      match = { game: ruling.game, mine: passes ? !mine : mine, hand: ruling.hand, over: ruling.turn === "win" || ruling.turn === "lose" };
      next(ruling.balls, ruling.foul, mine);
    });
  }

  /** A cue ball in hand waits at the head spot, or near to it. */
  function atHead(balls: readonly ShotBall[]): ShotBall[] {
    const { width, length } = view.table();
    for (let k = 0; ; k++) {
      const x = (k / 40) % 1;
      try {
        return carom.placeBall(view.table(), balls, 0, width * (x < 0.5 ? 0.5 + x * 0.9 : 0.5 - (x - 0.5) * 0.9), length / 4 - 1e-3 * Math.floor(k / 40));
      } catch (error) {
        if (k > 4000) throw error;
      }
    }
  }

  function next(balls: ShotBall[], foul: boolean, wasMine: boolean): void {
    const { game, mine, hand, over } = match!;
    if (hand !== "no" && mine && !over) balls = atHead(balls);
    if (!over && !mine) busy = true; // the view aims nothing of its own meanwhile
    view.lay(balls);
    const fouled = foul ? `${wasMine ? "You foul" : "The opponent fouls"}. ` : "";
    const group = game.rules === "eightball" ? ` on ${game.group === "open" ? "an open table" : game.group}` : "";
    if (over) {
      shoot.hidden = true;
      return tell(`${fouled}${mine ? "You have won." : "The opponent has won."}`);
    }
    if (mine) {
      tell(`${fouled}Your turn${group}.${hand === "no" ? "" : ` The cue ball is in hand${hand === "kitchen" ? " behind the head string" : ""}: drag it.`}`);
      return void chances();
    }
    tell(`${fouled}The opponent, a ${other.select.value}, thinks${group} …`);
    void reply();
  }

  async function reply(): Promise<void> {
    const inHand = place(match!.hand)!;
    const one = await best({ ...plan(false), shots: REPLY, inHand });
    if (!one) return;
    busy = true;
    if (inHand !== false) view.lay(carom.placeBall(view.table(), view.balls(), 0, ...one.place));
    view.aim(one.cue);
    busy = false;
    tell(`The opponent plays ${words(one)}.`);
    stroke(one.cue, one.ball > 0 ? { ball: one.ball, pocket: one.pocket } : undefined);
  }

  return {
    root,
    atHead,
    aimed: () => void chances(),
    begin() {
      match = undefined;
      number++;
      busy = false;
      shoot.hidden = true;
      tell("");
      void chances();
    },
    hand: () => (match && !match.over ? (match.mine ? match.hand : "no") : undefined),
    busy: () => busy,
  };
}
