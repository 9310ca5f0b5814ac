// A diagram to print and to send: balls before a stroke or after it, its path, diamonds, and notes. Its link has all of that, and needs no game.
import { type Carom, CaromError, type Cue, type Shot, type ShotBall } from "carom";
import { player } from "../../../player/player.js";
import { drawNumbers, drawStick } from "../table/drawing.js";
import { filmOf, onTable, pathsOf } from "../table/filmed.js";
import { GAMES } from "../table/games.js";
import { button, check, choice, dialog, el } from "../ui.js";
import { OPTIONS, Play } from "./game.js";
import { pack, send, unpack } from "./keep.js";

/** Of the cue, what the page sets: m/s, degrees, radii of the ball. */
const SET = ["speed", "phi", "a", "b", "theta"] as const;
interface Drawn {
  game: string;
  /** Where balls lie, "x,y" or "in" of each, m. */
  at: string;
  /** The stroke in the order of SET, where there is one. */
  cue?: number[];
  after?: boolean;
  path?: boolean;
  notes: string;
}
/** What can be drawn: its name, the balls, and the stroke. */
export type Source = readonly [name: string, balls: readonly ShotBall[], cue: Cue | undefined];

const atOf = (balls: readonly ShotBall[]): string => balls.map(({ state }) => (onTable(state) ? `${state.r[0]},${state.r[1]}` : "in")).join(" ");

function wordsOfCue({ speed, phi, a, b, theta }: Cue): string {
  const off = [[-a, "right", "left"], [b, "above", "below"]] as const;
  const tip = off.flatMap(([x, more, less]) => (Math.abs(x) < 0.005 ? [] : `${Math.abs(x).toFixed(2)} R ${x > 0 ? more : less}`));
  return `Cue: ${speed.toFixed(1)} m/s, direction ${phi.toFixed(2)}°, tip ${tip.join(" and ") || "in the middle"}${theta > 0 ? `, butt raised by ${theta.toFixed(0)}°` : ""}.`;
}

export function diagramPage(carom: Carom, coarse: boolean): { root: HTMLDialogElement; open(game: string, sources: readonly Source[]): void; read(packed: string): Promise<void>; theme(): void } {
  let sources: readonly Source[] = [];
  let drawn: Drawn = { game: "eightball", at: "", notes: "" };
  let play: Play | undefined;
  let shot: Shot | undefined;

  const film = player({
    sharp: 2, // for paper
    over(g) {
      const pen = { g, scale: film.scale, place: film.place };
      const balls = shownBalls();
      drawNumbers(pen, balls, play!.names);
      if (drawn.cue && !drawn.after && onTable(balls[0]!.state)) drawStick(pen, balls[0]!, cueOf(drawn.cue));
    },
  });
  film.canvas.id = "diagram-scene";
  film.canvas.removeAttribute("tabindex");
  const which = choice("diagram-which", "Draw", [], () => take(Number(which.select.value)));
  const after = check("diagram-after", "after the stroke", changed);
  const path = check("diagram-path", "with its path", changed);
  const words = el("p", { id: "diagram-words" });
  const said = el("p", { class: "error no-print", id: "diagram-said", role: "status" });
  const notes = el("textarea", { id: "notes", class: "no-print", maxlength: "2000", rows: "3" });
  // A box for text shows on paper only what fits into it.
  const printed = el("p", { class: "on-paper" });
  notes.addEventListener("input", () => (printed.textContent = notes.value));
  const root = dialog(
    "diagram",
    "Diagram",
    el("div", { class: "row no-print" }, which.root, after.root, path.root),
    film.canvas,
    words,
    el("label", { for: "notes", class: "no-print" }, "Notes"),
    notes,
    printed,
    el("div", { class: "row no-print" }, button("Print", () => window.print(), { id: "print-diagram", class: "main" }), button("Link to this diagram", () => void link(), { id: "link-diagram" })),
    said,
  );
  root.addEventListener("close", () => {
    if (location.hash.includes("&d=")) history.replaceState(null, "", "#view=play");
  });

  const cueOf = (numbers: readonly number[]): Cue => ({ ...carom.cue({}, GAMES[play!.played?.of ?? play!.setup.game]!.game), ...Object.fromEntries(SET.map((key, k) => [key, numbers[k]])) });
  const shownBalls = (): ShotBall[] => play!.balls.map((ball, k) => (drawn.after && shot ? { kind: ball.kind, state: shot.final[k]! } : ball));

  /** Lays the balls and plays the stroke. Throws where they cannot be. */
  function lay(of: Drawn): void {
    const next = new Play(carom, { game: of.game, against: "practice", own: "0", seed: 1, at: of.at });
    next.end();
    play = next;
    drawn = of;
    shot = of.cue && carom.simulate(next.table, next.balls, cueOf(of.cue), OPTIONS);
    for (const one of [after, path]) one.root.hidden = shot === undefined;
    after.input.checked = of.after === true;
    path.input.checked = of.path === true;
    film.canvas.setAttribute("aria-label", `Diagram of ${next.balls.filter(({ state }) => onTable(state)).length} balls from above`);
    words.textContent = `${(next.played ?? GAMES[of.game]!).text}. ${of.cue ? wordsOfCue(cueOf(of.cue)) : ""}`;
    draw();
  }
  function draw(): void {
    if (!root.open || !play) return;
    const turned = play.balls.map(() => [1, 0, 0, 0] as const);
    film.show(filmOf({ table: play.table, balls: shownBalls(), names: play.names, turned }, undefined, drawn.path && shot ? pathsOf(shot) : []));
  }
  function changed(): void {
    drawn = { ...drawn, after: after.input.checked, path: path.input.checked };
    draw();
  }
  function take(k: number): void {
    const [, balls, cue] = sources[k]!;
    const still = { game: drawn.game, at: atOf(balls), notes: notes.value };
    try {
      lay(cue ? { ...still, cue: SET.map((key) => cue[key]), path: true } : still);
    } catch (error) {
      if (!(error instanceof CaromError)) throw error;
      said.textContent = `This stroke cannot be played: ${error.message}.`;
      lay(still);
    }
  }
  async function link(): Promise<void> {
    const text = JSON.stringify({ ...drawn, notes: notes.value });
    said.textContent = await send(`${location.href.split("#")[0]}#view=play&d=${await pack(text)}`, "A diagram of billiards", coarse, "The link to this diagram is copied.");
  }
  function show(text: string): void {
    said.textContent = "";
    notes.value = printed.textContent = text;
    which.root.hidden = sources.length < 2;
    if (!root.open) root.showModal();
  }

  return {
    root,
    open(game, of) {
      sources = of;
      drawn = { game, at: "", notes: "" };
      which.select.replaceChildren(...of.map(([name], k) => el("option", { value: String(k) }, name)));
      show("");
      take(0);
    },
    async read(packed) {
      const of = JSON.parse(await unpack(packed)) as Drawn;
      if (of.cue !== undefined && !(Array.isArray(of.cue) && of.cue.length === SET.length && of.cue.every(Number.isFinite))) throw new TypeError(`cue: ${SET.length} numbers are needed`);
      if (typeof of.notes !== "string" || typeof of.at !== "string") throw new TypeError("notes and at: texts are needed");
      sources = [];
      try {
        lay(of);
      } catch (error) {
        throw error instanceof CaromError ? new TypeError(`the stroke cannot be played: ${error.message}`) : error;
      }
      show(of.notes);
      draw();
    },
    theme: draw,
  };
}
