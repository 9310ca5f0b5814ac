// The desk of the laboratory: the positions of the balls, the controls of a stroke, and the current
// shot.
import {
  type Carom,
  type Cue,
  type Replayed,
  type Shot,
  type ShotBall,
  type ShotOptions,
  type Table,
  words,
} from "carom";
import type { player } from "../../../player/player.js";
import { GAMES, type GameOf } from "../table/games.js";
import { cueWith, strokeControls, strokeOf } from "../table/stroke.js";
import { choice, el, slider, type Slider, wrong } from "../ui.js";
import { texts } from "../texts/texts.js";

export const DEFAULTS: Record<string, number> = { speed: 8, phi: 90, right: 0, up: 0.25, theta: 0 };
/** Models of the cushion, the page's own choice first. */
const about: ReadonlyMap<string, string> = new Map(words.cushionModel);
export const CUSHIONS = ["han", ...[...about.keys()].filter((word) => word !== "han")];

/** The recording that is open, of which the laboratory shows one shot after the other. */
export interface Reel {
  /** Its buttons and messages, and the button that opens a file. */
  readonly bar: HTMLElement;
  readonly open: HTMLElement;
  /** Lets files be dropped on an element. */
  accept(target: HTMLElement): void;
  /** The laboratory shows this shot now, or another one that is not recorded. */
  shows(shot: Replayed | undefined): void;
  /** The film of a recorded shot has ended: the next one begins. */
  advance(): void;
  close(): void;
}

export interface Desk {
  readonly carom: Carom;
  readonly solver: () => "exact" | "euler";
  readonly controls: ReturnType<typeof controlsOf>;
  readonly film: ReturnType<typeof player>;
  readonly recording: Reel;
  /** Plays the shot as it is aimed now, from its start. */
  aimed(): void;
  /** Nothing has changed for a moment: the address is written. */
  settled(): void;
  gameName: string;
  seed: number;
  game: GameOf;
  table: Table;
  balls: ShotBall[];
  names: string[];
  /** How each ball is turned, degrees. */
  faces: number[];
  /** Whether balls lie elsewhere than in the rack, and the cue of a line that was read. */
  moved: boolean;
  imported: Cue | undefined;
  /** Whether the address can name the table. */
  builtIn: boolean;
  /** The object ball that was picked, for pockets; -1: none. */
  chosen: number;
  shot: Shot | undefined;
  /** The shot of a recording that is shown. */
  recorded: Replayed | undefined;
  writing: number | undefined;
}

/**
 * The controls of a stroke, and where its words stand; `aimed` follows a change, `racked` another
 * game.
 */
export function controlsOf(aimed: () => void, racked: () => void) {
  const two = (x: number): string => x.toFixed(2);
  const stroke = strokeControls(
    slider("speed", texts.speedOfTheCue, 0.1, 10, 0.05, " m/s", aimed, two),
    "spin",
    aimed,
  );
  const sliders: Record<string, Slider> = stroke.sliders;
  const set = (key: string, value: number): void => void (sliders[key]!.value = value);
  return {
    sliders,
    stroke,
    set,
    value: (key: string): number => sliders[key]!.value,
    games: choice(
      "game",
      texts.game,
      Object.entries(GAMES).map(([key, { text }]) => [key, text] as const),
      racked,
    ),
    cushion: choice(
      "cushion",
      texts.cushions,
      CUSHIONS.map((word) => [word, `${word}: ${about.get(word)}`] as const),
      aimed,
    ),
    summary: el("tbody"),
    message: el("p#message.error", { role: "status" }),
    line: el("textarea#line", { spellcheck: "false" }),
    cost: el("p#cost.note"),
  };
}

export const says = ({ controls }: Desk, text: string): void =>
  void (controls.message.textContent = text);
export const cueOf = ({ carom, controls: { stroke }, imported, game }: Desk): Cue =>
  cueWith(imported ?? carom.cue({}, game.game), stroke.value());
/** Sets the sliders to a stroke. */
export const aim = ({ controls: { stroke } }: Desk, cue: Cue): void => stroke.set(strokeOf(cue));
export function optionsOf({ solver, controls }: Desk): ShotOptions {
  const euler = solver() === "euler";
  const model = controls.cushion.select.value as NonNullable<ShotOptions["cushionModel"]>;
  return {
    ballModel: euler ? "euler" : "exact",
    cushionModel: euler && model === "mathavan" ? "euler" : model,
  };
}

/**
 * Gives the balls the constants of the game for the cushions that are chosen; those of a line keep
 * their own. What it says where there are none.
 */
export function suit(d: Desk): string {
  let message = "";
  if (d.imported) return message;
  let kind = d.carom.kind(d.game.game);
  try {
    kind = d.carom.kind(d.game.game, optionsOf(d).cushionModel);
  } catch (error) {
    message = texts.itPlaysThoseOf(wrong(error));
  }
  d.balls = d.balls.map(({ state }) => ({ kind, state }));
  return message;
}

/** Lays the balls of the game as they begin. */
export function lay(d: Desk): void {
  const { carom, gameName, seed } = d;
  const game = GAMES[gameName]!;
  d.controls.games.select.value = gameName;
  const table = carom.table(game.table);
  const balls = carom.rack(game.rack, table, { seed });
  Object.assign(d, {
    game,
    table,
    balls,
    names: balls.map((_, k) => game.names(k)),
    faces: balls.map(() => 0),
    chosen: -1,
    moved: false,
    imported: undefined,
    builtIn: true,
  });
}
