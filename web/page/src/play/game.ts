// A game in progress: a match of the library, and what the page shows with it. The match applies
// the rules, reports whose turn it is and what is allowed, and writes the lines of a recording.
// Another page reads these lines, plays their strokes and checks the rulings. A game is saved and
// sent as text: its setup and its lines. Practice has no match, because it has no rules.
import {
  type BallKind,
  type Bounds,
  type Call,
  type Carom,
  type Condition,
  type Cue,
  type Game,
  type GameState,
  type Match,
  type Choice,
  choices,
  type Ruling,
  type Shot,
  type ShotBall,
  type ShotOptions,
  type Table,
} from "carom";
import { onTable } from "../table/filmed.js";
import {
  GAMES,
  type GameOf,
  hasMember,
  PLAYED,
  type Played,
  POOL_TABLES,
  SEATS,
} from "../table/games.js";
import { atHead, isWithin } from "../table/head.js";
import { placesOf, placesText, pocketed } from "../table/places.js";
import { wrong } from "../ui.js";
import { type Act, actsOf, type Line, perform } from "./acts.js";
import { membersOf } from "./schema.js";
import { texts } from "../texts/texts.js";

/** Whom one plays against: a Fargo rating, a person at this page, one by link, or nobody. */
export type Against = "practice" | "person" | "link" | `${number}`;
/** Whether one plays against the computer, which has a rating. */
export const isComputer = (against: Against): boolean => Number(against) > 0;
export interface Setup {
  /** A key of PLAYED; of practice also one of GAMES. */
  game: string;
  against: Against;
  /** The rating whose errors my strokes have; "0": none. */
  own: string;
  /** Of the rack and of errors. */
  seed: number;
  /** Of pool, a key of POOL_TABLES. */
  table?: string;
  /** Of pool, a condition of the cloth, and one of the cushions or their two numbers, "e,mu". */
  cloth?: string;
  cushion?: string;
  /** Of practice: where balls lie, "x,y" or "in" of each. */
  at?: string;
  /** The name of the drill that the layout is of. */
  drill?: string;
  /** Of a race: how many racks win it, and how many each has won before this one. */
  race?: number;
  racks?: readonly [number, number];
  /** Whether the player who does not begin has an equalizing inning, so that games may be drawn. */
  equalInnings?: boolean;
  /** How many seats play, each for itself. */
  seats?: number;
  /** How long a stroke may take, s. */
  clock?: number;
}
/**
 * Who aimed a stroke: whoever sits there, a hint, the line of a recording, or the page's player. A
 * text has the first letter of each.
 */
const AIMERS = ["player", "hint", "line", "opponent"] as const;
export type Aimer = (typeof AIMERS)[number];

/** A stroke that was played, for its film; or a choice or a late clock, which has no shot. */
export interface Stroke {
  player: number;
  aimer: Aimer;
  /** Whether the time for the stroke was over. */
  isLate?: boolean;
  balls: ShotBall[];
  cue: Cue;
  call: Call | undefined;
  /** The choice that was taken instead of a stroke. */
  choice?: Choice | undefined;
  state: GameState;
  shot: Shot | undefined;
  ruling: Ruling | undefined;
}
/** A stroke that kept the turn, as a look back at the game needs it. */
export interface Deed {
  player: number;
  balls: ShotBall[];
  cue: Cue;
  /** The ball that was met first, and those that fell, each with its pocket. */
  hitBall: number;
  pots: { ball: number; pocket: number }[];
  /** How many cushions the struck ball met. */
  cushions: number;
}
function deedOf({ player, balls, cue, shot }: Stroke): Deed {
  const { events = [], firstContact } = shot ?? {};
  const { a = -1, b = -1 } = firstContact?.event ?? {};
  return {
    player,
    balls,
    cue,
    hitBall: a === cue.ball ? b : a,
    pots: events.flatMap(({ type, a, b }) =>
      type === "ball_pocket" && a !== cue.ball ? [{ ball: a, pocket: b }] : [],
    ),
    cushions: events.filter(({ type, a }) => type === "ball_linear_cushion" && a === cue.ball)
      .length,
  };
}
/** The content of a text after its setup: lines, or an older page's strokes without rulings. */
interface Kept {
  lines?: Line[];
  aims?: string;
  entries?: unknown[];
}

export const OPTIONS: ShotOptions = {};
const isAct = (line: Line | undefined): line is Act => typeof line === "object";
/** Whether a line records a clock that ran out, and whether it records a stroke. */
const isLate = (line: Line): boolean =>
  isAct(line) ? line[0] === "clock" : line.startsWith('{"act":{"act":4,');
const isStroke = (line: Line): boolean =>
  isAct(line) ? line[0] === "stroke" : line.startsWith('{"shot"');

/** The choice that a line records, if it records one. */
function choiceOf(line: Line): Choice | undefined {
  if (isAct(line)) return line[0] === "choose" ? line[1] : undefined;
  if (!line.startsWith('{"act":{"act":1,')) return undefined;
  const { act } = JSON.parse(line) as { act: { choice: number } };
  return choices[Math.log2(act.choice)];
}

/** The table of a game: what of it is not usual. */
export function tableOf({
  table,
  cloth,
  cushion,
}: Pick<Setup, "table" | "cloth" | "cushion">): Pick<Setup, "table" | "cloth" | "cushion"> {
  return {
    ...(table !== undefined && { table }),
    ...(cloth !== undefined && { cloth }),
    ...(cushion !== undefined && { cushion }),
  };
}
/** The balls of a game on its cloth, with its cushions. Throws where there are no such ones. */
function kindOf(carom: Carom, game: Game, { cloth, cushion }: Setup): BallKind {
  const isNumber = (part: string): boolean => part.trim() !== "" && Number(part) >= 0;
  const numbers = cushion?.includes(",")
    ? cushion.split(",").map((part) => (isNumber(part) ? Number(part) : NaN))
    : undefined;
  const named = [cloth, numbers ? undefined : cushion].filter((name) => name !== undefined);
  if (game !== "pool" && (named.length > 0 || numbers)) throw new TypeError(texts.onlyTablesOfPool);
  const kind = carom.kind(game, OPTIONS.cushionModel, named as Condition[]);
  if (!numbers) return kind;
  const [restitutionCushion, muCushion] = numbers as [number, number];
  if (!(numbers.length === 2 && restitutionCushion <= 1 && muCushion <= 1))
    throw new TypeError(texts.twoNumbersAreNeeded(cushion!));
  return { ...kind, restitutionCushion, muCushion };
}
/** The table of a game. Throws where there is no such one. */
function tableNamed(carom: Carom, base: GameOf, name: string | undefined): Table {
  const isPool = base.table === "9ft";
  const chosen = POOL_TABLES[name ?? "9ft"];
  if (!chosen || (name !== undefined && !isPool)) throw new TypeError(texts.tableThereIsNo(name!));
  return isPool ? carom.table(chosen[1], chosen[2]) : carom.table(base.table);
}
/** Whether the rules treat the first stroke of a new game differently. */
const isOpening = (rules: GameState["rules"], { at }: Setup): boolean =>
  hasMember(rules, "opening") && at === undefined;
/** The match of a game that begins with these balls. */
function matchOf(play: Play, { rules, opening, state }: Played): Match {
  const { carom, setup, table, balls } = play;
  // Who opens a game of carom strikes the white.
  const group = play.hasPockets ? "open" : "solids";
  const innings = setup.equalInnings ? { innings: 1 } : {};
  const { seats = SEATS[rules]?.[0] } = setup;
  // The initial lives or balls of each seat, from a match with the rack.
  const user = seats === undefined ? {} : { user: carom.match(rules, table, { seats }).game.user };
  const game = {
    rules,
    group,
    opening: isOpening(rules, setup),
    ...state,
    ...innings,
    ...user,
  } as const;
  // The text of a layout places its cue ball.
  const isLaid = setup.at !== undefined && onTable(balls[0]!.state);
  const hand = play.hasPockets && !isLaid ? (opening as Ruling["hand"]) : "no";
  return carom.match(game, table, {
    balls,
    hand,
    shot: OPTIONS,
    ...(seats !== undefined && { seats }),
  });
}
/** The match of saved or sent lines. Removes the lines of its beginning from the list. */
function matchRead(carom: Carom, lines: Line[]): Match {
  const match = carom.match();
  while (match.phase === "none" && typeof lines[0] === "string") {
    match.read(lines[0]);
    lines.shift();
  }
  return match;
}

export class Play {
  readonly played: Played | undefined;
  readonly table: Table;
  readonly names: string[];
  readonly practice: boolean;
  /** As they lie; a cue ball in hand where it is about to be put. */
  balls: ShotBall[];
  last: Stroke | undefined;
  /** How many strokes were played, and choices taken instead of one. */
  strokes = 0;
  /** Who aimed each of them. */
  readonly aims: Aimer[] = [];
  /** The strokes that kept the turn or won. */
  readonly deeds: Deed[] = [];
  /** Layouts of practice before each stroke and move, to undo. */
  readonly past: ShotBall[][] = [];
  /** None in practice, which has no rules: every ball counts. */
  readonly #match: Match | undefined;
  #practised: GameState;
  /** The ball that the player has chosen to strike. */
  #struck: number | undefined;

  /** A new game, or the game of these lines; the first stroke and all later lines stay in the list. */
  constructor(
    readonly carom: Carom,
    readonly setup: Setup,
    lines: Line[] = [],
  ) {
    this.practice = setup.against === "practice";
    this.played = PLAYED[setup.game];
    const base = GAMES[this.played?.base ?? setup.game];
    if (!base || (!this.practice && !this.played))
      throw new TypeError(texts.gameThereIsNo(setup.game));
    if (typeof lines[0] === "string" && !this.practice) this.#match = matchRead(carom, lines);
    // A table or layout that there is not is refused, even where the lines have another one.
    const named = tableNamed(carom, base, setup.table);
    this.table = this.#match?.table ?? named;
    const laid = this.#laid(base);
    this.balls = this.#match?.balls ?? laid;
    this.names = this.balls.map((_, k) => base.names(k));
    const rules = this.practice && this.hasPockets ? "potting" : this.played!.rules;
    this.#practised = { rules, group: "open", opening: isOpening(rules, setup) };
    if (!this.practice) this.#match ??= matchOf(this, this.played!);
    if (!this.practice && this.state.rules !== rules)
      throw new TypeError(texts.theLinesAreOf(setup.game));
    this.#putInHand();
  }

  // ---- How the game stands

  get state(): GameState {
    return this.#match?.game ?? this.#practised;
  }
  /** Who is at the table, and who has won. */
  get turn(): number {
    return this.#match?.side ?? 0;
  }
  get winner(): number | undefined {
    return this.#match?.winner;
  }
  /** Whether each seat plays for itself, with separate lives or balls. */
  get isOwn(): boolean {
    return !this.practice && this.setup.game in SEATS;
  }
  /** Whether the game is over, without a winner where it is drawn. */
  get isOver(): boolean {
    return this.winner !== undefined || this.isDrawn;
  }
  get isDrawn(): boolean {
    return this.#match?.drawn ?? false;
  }
  /** The ball that is struck. */
  get cueBall(): number {
    const isChosen = this.#struck !== undefined && this.strikable.includes(this.#struck);
    return (isChosen ? this.#struck : this.#match?.cueBall) ?? this.strikable[0] ?? 0;
  }
  /** The balls of which the player may choose the one that is struck. */
  get strikable(): readonly number[] {
    if (this.#match) return this.#match.strikable;
    if (this.played?.rules !== "pyramid") return [0];
    return [...this.balls.keys()].filter((ball) => onTable(this.balls[ball]!.state));
  }
  /** Where a cue ball in hand may be placed: its name, and the bounds in m. */
  get hand(): Ruling["hand"] {
    return this.#match?.hand ?? "no";
  }
  get bounds(): Bounds | undefined {
    return this.#match?.bounds;
  }
  /** The choices that the rules offer instead of a stroke. */
  get acts(): readonly Choice[] {
    return this.#match?.may ?? [];
  }
  /** The points of each. */
  get points(): readonly number[] {
    return this.#match?.standing.points ?? [0, 0];
  }
  /**
   * Whether the next stroke is the first of a rack, even if the rules treat it like any other.
   */
  get breaks(): boolean {
    return (
      this.state.opening === true ||
      (this.setup.at === undefined && this.strokes === 0 && this.last === undefined)
    );
  }
  get hasPockets(): boolean {
    return this.table.pockets.length > 0;
  }

  // ---- The game as text

  /** The recording so far, a line each. */
  get lines(): string[] {
    return this.#match?.lines ?? [];
  }
  /** The text of `at` for the layout. */
  places(): string {
    return placesText(this.balls, (x) => Number(x.toFixed(5)));
  }
  /** The usual cue of the game. */
  get cue(): Cue {
    return this.carom.cue({}, GAMES[this.played?.base ?? this.setup.game]!.game);
  }
  /** The game as text, of which all pages of a machine compare the lines. */
  text(lines: readonly Line[] = this.lines): string {
    return JSON.stringify({
      ...this.setup,
      ...(this.practice && !this.setup.drill ? { at: this.places() } : {}),
      lines,
      aims: this.practice ? "" : this.aims.map(([letter]) => letter).join(""),
    });
  }
  /** The game as text for a link, as short as it can be. */
  shortText(): string {
    if (this.practice) return this.text();
    const beginning = new Play(this.carom, this.setup).lines;
    return this.text(actsOf(this.lines, beginning, this.cue));
  }

  // ---- Strokes and choices

  /** Chooses the ball that is struck; one that may not be struck changes nothing. */
  strike(ball: number): void {
    if (this.strikable.includes(ball)) this.#struck = ball;
  }
  /** The cue ball in hand, put down; or a ball of practice. Throws where it is not free. */
  put(ball: number, x: number, y: number): void {
    this.balls = this.carom.placeBall(this.table, this.balls, ball, x, y);
  }
  keep(): void {
    this.past.push(this.balls);
  }
  undo(): boolean {
    const previous = this.past.pop();
    if (!previous) return false;
    this.balls = previous;
    this.last = undefined;
    return true;
  }
  /** A layout of practice. */
  lay(balls: ShotBall[]): void {
    this.keep();
    this.balls = balls;
    this.aims.length = 0;
  }

  /** Plays a stroke. In a game, it is ruled. */
  stroke(cue: Cue, call?: Call, aimer: Aimer = "player"): Stroke {
    const match = this.#match;
    if (!match) return this.#practise(cue, aimer);
    const situation = this.#situation(cue, call, aimer);
    if (match.bounds) {
      const [x, y] = this.balls[this.cueBall]!.state.r;
      match.place(x, y);
    }
    if (call === "push") match.choose("push");
    else if (typeof call === "object" && this.played!.calls) match.call(call.ball!, call.pocket);
    match.stroke(cue);
    return this.#ruled(situation, true);
  }
  /** Takes a choice instead of a stroke. */
  choose(what: Choice, aimer: Aimer = "player"): Stroke {
    const situation = this.#situation(this.carom.cue(), what === "pass" ? what : undefined, aimer);
    this.#match!.choose(what);
    return this.#ruled({ ...situation, choice: what }, false);
  }

  /** The time for a stroke is over, which is a foul. */
  clock(): Stroke {
    const situation = this.#situation(this.carom.cue());
    this.#match!.clock();
    return this.#ruled({ ...situation, isLate: true }, false);
  }
  /** A player gives the game to the other. */
  concede(player: number): Stroke {
    const situation = this.#situation(this.carom.cue());
    this.#match!.concede(player);
    return this.#ruled({ ...situation, player }, false);
  }

  /**
   * Reads lines that another page wrote, or does its acts, up to a stroke or a choice with its
   * ruling, and takes them off the list. Undefined where there is none. Throws where a line is not
   * by the rules, or has other bits. `aims` has the letters of who aimed the strokes of the game.
   */
  read(lines: Line[], aims = ""): Stroke | undefined {
    const match = this.#match!;
    const aimer = AIMERS.find(([letter]) => letter === aims[this.strokes]) ?? "line";
    try {
      while (lines.length > 0) {
        const situation = this.#situation(this.carom.cue(), undefined, aimer);
        const known = match.lines.length;
        const line = lines.shift()!;
        if (isAct(line)) perform(match, line, this.cue);
        else match.read(line);
        const ruled = match.lines.length - known - 1;
        // Behind a line those of the ruling follow, which the match has too.
        for (const rest of isAct(line) ? [] : lines.splice(0, ruled)) match.read(rest as string);
        const rest = { isLate: isLate(line), choice: choiceOf(line) };
        if (ruled > 0) return this.#ruled({ ...situation, ...rest }, isStroke(line));
      }
    } catch (error) {
      throw new TypeError(texts.strokeIsNotAs(this.strokes + 1, wrong(error)));
    }
    return undefined;
  }

  /** The balls of a new game on its cloth, with its cushions, or those of `at`. */
  #laid(base: GameOf): ShotBall[] {
    const { carom, setup, table } = this;
    const kind = kindOf(carom, base.game, setup);
    const rack = carom
      .rack(base.rack, table, { seed: setup.seed })
      .map(({ state }) => ({ kind, state }));
    return setup.at === undefined ? rack : placesOf(setup.at, table, rack).balls;
  }
  /** A cue ball in hand is near the head spot until the player moves it. */
  #putInHand(): void {
    const { bounds, cueBall } = this;
    const isPut = bounds && isWithin(bounds, this.balls[cueBall]!.state);
    if (bounds && !isPut) this.balls = atHead(this.carom, this.table, this.balls, bounds, cueBall);
  }
  #situation(cue: Cue, call?: Call, aimer: Aimer = "player"): Omit<Stroke, "shot" | "ruling"> {
    return { player: this.turn, aimer, balls: this.balls, cue, call, state: this.state };
  }
  #ruled(situation: Omit<Stroke, "shot" | "ruling">, isPlayed: boolean): Stroke {
    const match = this.#match!;
    this.#struck = undefined;
    this.strokes++;
    this.aims.push(situation.aimer);
    this.balls = match.balls;
    this.#putInHand();
    const { shot, ruling } = match;
    const cue = shot?.cue;
    // Lines that were read have put a cue ball in hand, and have the cue.
    const played = isPlayed && shot && cue ? { balls: [...shot.balls], cue, shot, ruling } : {};
    this.last = { shot: undefined, ruling: undefined, ...situation, ...played };
    const { player } = situation;
    const isKept = this.isDrawn || (this.winner ?? this.turn) === player;
    if (isPlayed && isKept && !ruling?.foul) this.deeds.push(deedOf(this.last));
    return this.last;
  }
  #practise(cue: Cue, aimer: Aimer): Stroke {
    this.keep();
    this.aims.push(aimer);
    const { balls, state } = this;
    const shot = this.carom.simulate(this.table, balls, cue, OPTIONS);
    this.balls = balls.map(({ kind }, k) => {
      const end = shot.final[k]!;
      return { kind, state: end.label === "off" ? pocketed(this.table, end) : end };
    });
    if (!onTable(this.balls[this.cueBall]!.state))
      this.balls = atHead(this.carom, this.table, this.balls);
    this.#practised = { ...state, opening: false };
    const rest = { call: undefined, ruling: undefined };
    this.last = { player: 0, aimer, balls, cue, state, shot, ...rest };
    return this.last;
  }
}

/** The parts of a text. Throws where an older page saved it. */
function parsed(text: string): { setup: Setup; lines: Line[]; aims: string } {
  const {
    lines = [],
    aims = "",
    entries = [],
    ...setup
  } = membersOf(text) as unknown as Setup & Kept;
  if (entries.length > 0) throw new TypeError(texts.anOlderPageKept);
  return { setup, lines, aims };
}
/**
 * A game of a text, played to its last stroke, or to so many strokes. Throws where the text or a line
 * of it is wrong.
 */
export function read(carom: Carom, text: string, strokes = Infinity): Play {
  const { setup, lines, aims } = parsed(text);
  const play = new Play(carom, setup, lines);
  while (play.strokes < strokes && play.read(lines, aims));
  return play;
}
/** The game of a recording that `carom verify` takes, which two players at this page go on with. */
export function imported(carom: Carom, recording: string): Play {
  const lines = recording.split("\n").filter((line) => line !== "" && !line.startsWith('{"end"'));
  const { rules } = matchRead(carom, [...lines]).game;
  const play = new Play(carom, { game: rules, against: "person", own: "0", seed: 0 }, lines);
  while (play.read(lines));
  return play;
}
/** The complete recording of the game of a text, with its end. */
export function recordingOf(carom: Carom, text: string): string {
  const match = carom.match();
  for (const line of read(carom, text).lines) match.read(line);
  return match.end();
}
