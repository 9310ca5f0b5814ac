// A diagram to print and to send: the balls before or after a stroke, its path, diamonds, and
// notes. Its link contains everything, and needs no game.
import { type Carom, CaromError, type Cue, type Shot, type ShotBall } from "carom";
import { player } from "../../../player/player.js";
import { drawLabels, drawStick, labelsOf } from "../table/drawing.js";
import { filmOf, onTable, pathsOf } from "../table/filmed.js";
import { GAMES } from "../table/games.js";
import { placesText } from "../table/places.js";
import { button, check, choice, dialog, el } from "../ui.js";
import { OPTIONS, Play, type Setup, tableOf } from "./game.js";
import { pack, send, unpack } from "./keep.js";
import { texts } from "../texts/texts.js";

/** Of the cue, what the page sets: m/s, degrees, radii of the ball. */
const SET = ["speed", "phi", "a", "b", "theta"] as const;
interface Drawn {
  game: string;
  table?: string;
  cloth?: string;
  cushion?: string;
  /** Where balls lie, "x,y" or "in" of each, m. */
  at: string;
  /** The stroke in the order of SET, where there is one. */
  cue?: number[];
  /** The ball that is struck, where it is not ball 0. */
  ball?: number;
  after?: boolean;
  path?: boolean;
  notes: string;
}
/** What can be drawn: its name, the balls, and the stroke. */
export type Source = readonly [name: string, balls: readonly ShotBall[], cue: Cue | undefined];

function wordsOfCue({ speed, phi, a, b, theta }: Cue): string {
  const off = [
    [-a, texts.toTheRight, texts.toTheLeft],
    [b, texts.above, texts.below],
  ] as const;
  const tip = off.flatMap(([x, more, less]) =>
    Math.abs(x) < 0.005 ? [] : `${Math.abs(x).toFixed(2)} R ${x > 0 ? more : less}`,
  );
  return texts.cueMSDirection(
    speed.toFixed(1),
    phi.toFixed(2),
    tip.join(texts.andWord) || texts.inTheMiddle,
    theta > 0 ? texts.buttRaisedBy(theta.toFixed(0)) : "",
  );
}

/** A diagram with the elements of its dialog. */
interface Diagram {
  readonly carom: Carom;
  readonly film: ReturnType<typeof player>;
  readonly parts: ReturnType<typeof partsOf>;
  sources: readonly Source[];
  drawn: Drawn;
  play: Play | undefined;
  shot: Shot | undefined;
}
function partsOf(take: (k: number) => void, changed: () => void) {
  const sourceChoice = choice("diagram-which", texts.draw, [], () =>
    take(Number(sourceChoice.select.value)),
  );
  const notes = el("textarea#notes.no-print", { maxlength: "2000", rows: "3" });
  // A box for text shows on paper only what fits into it.
  const printed = el("p.on-paper");
  notes.addEventListener("input", () => (printed.textContent = notes.value));
  const final = check("diagram-after", texts.afterTheStroke, changed);
  const path = check("diagram-path", texts.withItsPath, changed);
  return {
    sourceChoice,
    final,
    path,
    notes,
    printed,
    words: el("p#diagram-words"),
    message: el("p#diagram-said.error.no-print", { role: "status" }),
  };
}
function dialogOf({ film, parts }: Diagram, link: () => void): HTMLDialogElement {
  const { sourceChoice, final, path, notes, printed, words, message } = parts;
  const root = dialog(
    "diagram",
    texts.diagram,
    el("div.row.no-print", sourceChoice.root, final.root, path.root),
    film.canvas,
    words,
    el("label.no-print", { for: "notes" }, texts.notes),
    notes,
    printed,
    el(
      "div.row.no-print",
      button(texts.print, () => window.print(), "#print-diagram.main"),
      button(texts.linkToThisDiagram, link, "#link-diagram"),
    ),
    message,
  );
  root.addEventListener("close", () => {
    if (location.hash.includes("&d=")) history.replaceState(null, "", "#view=play");
  });
  return root;
}

const cueOf = ({ carom, play, drawn }: Diagram, numbers: readonly number[]): Cue => ({
  ...carom.cue({ ball: drawn.ball ?? 0 }, GAMES[play!.played?.base ?? play!.setup.game]!.game),
  ...Object.fromEntries(SET.map((key, k) => [key, numbers[k]])),
});
const ballsOf = ({ play, drawn, shot }: Diagram): ShotBall[] =>
  play!.balls.map((ball, k) =>
    drawn.after && shot ? { kind: ball.kind, state: shot.final[k]! } : ball,
  );

/** Draws numbers and the stick over the balls. */
function drawOver(d: Diagram, g: CanvasRenderingContext2D): void {
  const { film, play, drawn } = d;
  const pen = { g, scale: film.scale, place: film.place };
  const balls = ballsOf(d);
  drawLabels(pen, balls, labelsOf(play!.names, texts.letters)); // also on paper without colours
  const struck = balls[drawn.ball ?? 0];
  if (drawn.cue && !drawn.after && struck && onTable(struck.state))
    drawStick(pen, struck, cueOf(d, drawn.cue));
}
function draw(d: Diagram): void {
  const { play, film, drawn, shot } = d;
  if (!play || film.canvas.closest("dialog")?.open !== true) return;
  const turned = play.balls.map(() => [1, 0, 0, 0] as const);
  film.show(
    filmOf(
      { table: play.table, balls: ballsOf(d), names: play.names, turned },
      undefined,
      drawn.path && shot ? pathsOf(shot) : [],
    ),
  );
}
/** Lays the balls and plays the stroke. Throws where they cannot be. */
function lay(d: Diagram, drawn: Drawn): void {
  const { final, path, words } = d.parts;
  const next = new Play(d.carom, {
    game: drawn.game,
    ...tableOf(drawn),
    against: "practice",
    own: "0",
    seed: 1,
    at: drawn.at,
  });
  d.play = next;
  d.drawn = drawn;
  d.shot = drawn.cue && d.carom.simulate(next.table, next.balls, cueOf(d, drawn.cue), OPTIONS);
  for (const part of [final, path]) part.root.hidden = d.shot === undefined;
  final.input.checked = drawn.after === true;
  path.input.checked = drawn.path === true;
  d.film.canvas.setAttribute(
    "aria-label",
    texts.diagramOfBallsFrom(next.balls.filter(({ state }) => onTable(state)).length),
  );
  words.textContent = `${(next.played ?? GAMES[drawn.game]!).text}. ${drawn.cue ? wordsOfCue(cueOf(d, drawn.cue)) : ""}`;
  draw(d);
}
/** Draws a source. */
function take(d: Diagram, k: number): void {
  const [, balls, cue] = d.sources[k]!;
  const still: Drawn = {
    game: d.drawn.game,
    ...tableOf(d.drawn),
    at: placesText(balls),
    notes: d.parts.notes.value,
  };
  try {
    const stroke = cue && { cue: SET.map((key) => cue[key]), ball: cue.ball, path: true };
    lay(d, { ...still, ...stroke });
  } catch (error) {
    if (!(error instanceof CaromError)) throw error;
    d.parts.message.textContent = texts.thisStrokeCannotBe(error.message);
    lay(d, still);
  }
}
function show(
  { parts: { message, notes, printed, sourceChoice }, sources }: Diagram,
  root: HTMLDialogElement,
  text: string,
): void {
  message.textContent = "";
  notes.value = text;
  printed.textContent = text;
  sourceChoice.root.hidden = sources.length < 2;
  if (!root.open) root.showModal();
}
/** The diagram of a link. Throws where it is damaged. */
async function unpacked(packed: string): Promise<Drawn> {
  const drawn = JSON.parse(await unpack(packed)) as Drawn;
  if (
    drawn.cue !== undefined &&
    !(
      Array.isArray(drawn.cue) &&
      drawn.cue.length === SET.length &&
      drawn.cue.every(Number.isFinite)
    )
  )
    throw new TypeError(texts.cueNumbersAreNeeded(JSON.stringify(drawn.cue), SET.length));
  if (drawn.ball !== undefined && !Number.isInteger(drawn.ball))
    throw new TypeError(texts.aBallIsAWholeNumber(JSON.stringify(drawn.ball)));
  if (typeof drawn.notes !== "string" || typeof drawn.at !== "string")
    throw new TypeError(texts.notesAndAtTexts);
  return drawn;
}

export function diagramPage(
  carom: Carom,
  coarse: boolean,
): {
  root: HTMLDialogElement;
  open(setup: Setup, sources: readonly Source[]): void;
  read(packed: string): Promise<void>;
  theme(): void;
} {
  const parts = partsOf(
    (k) => take(d, k),
    () => {
      d.drawn = { ...d.drawn, after: parts.final.input.checked, path: parts.path.input.checked };
      draw(d);
    },
  );
  const film = player({ sharp: 2, over: (g) => drawOver(d, g) }); // for paper
  film.canvas.id = "diagram-scene";
  film.canvas.removeAttribute("tabindex");
  const d: Diagram = {
    carom,
    film,
    parts,
    sources: [],
    drawn: { game: "eightball", at: "", notes: "" },
    play: undefined,
    shot: undefined,
  };
  const link = async (): Promise<void> => {
    const text = JSON.stringify({ ...d.drawn, notes: parts.notes.value });
    parts.message.textContent = await send(
      `${location.href.split("#")[0]}#view=play&d=${await pack(text)}`,
      texts.aDiagramOfBilliards,
      coarse,
      texts.theLinkToThisDiagram,
    );
  };
  const root = dialogOf(d, () => void link());
  return {
    root,
    open(setup, sources) {
      d.sources = sources;
      d.drawn = { game: setup.game, ...tableOf(setup), at: "", notes: "" };
      parts.sourceChoice.select.replaceChildren(
        ...sources.map(([name], k) => el("option", { value: String(k) }, name)),
      );
      show(d, root, "");
      take(d, 0);
    },
    async read(packed) {
      const drawn = await unpacked(packed);
      d.sources = [];
      try {
        lay(d, drawn);
      } catch (error) {
        throw error instanceof CaromError
          ? new TypeError(texts.theStrokeCannotBe(error.message))
          : error;
      }
      show(d, root, drawn.notes);
      draw(d);
    },
    theme: () => draw(d),
  };
}
