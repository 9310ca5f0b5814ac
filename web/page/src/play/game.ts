// A game on its way: who is at the table, the rulings of the library, and the strokes so far. Each
// stroke is a line of a recording, which another page reads, plays and compares bit by bit. A game
// is kept and sent as text: what it begins with, and its strokes.
import {
  type BallKind,
  type Call,
  type Carom,
  type Condition,
  type Cue,
  type Game,
  games,
  type GameState,
  type Recording,
  type Ruling,
  type Shot,
  type ShotBall,
  type ShotOptions,
  type Table,
  type Vec2,
} from "carom";
import { onTable } from "../table/filmed.js";
import { GAMES, PLAYED, type Played, POOL_TABLES } from "../table/games.js";
import { atHead, mayLie } from "../table/head.js";
import { placesOf, placesText, pocketed } from "../table/places.js";
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
}
/**
 * A stroke: where the cue ball was put, what was called, and the line of the recording; of a pass
 * there is none.
 */
export interface Entry {
  place?: Vec2;
  call?: Call;
  line: string;
}
/** What was played, for its film. */
export interface Stroke {
  who: 0 | 1;
  balls: ShotBall[];
  cue: Cue;
  call: Call | undefined;
  state: GameState;
  shot: Shot | undefined;
  ruling: Ruling | undefined;
}

export const OPTIONS: ShotOptions = {};

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
  const numbers = cushion?.includes(",") ? cushion.split(",").map(Number) : undefined;
  const named = [cloth, numbers ? undefined : cushion].filter((one) => one !== undefined);
  if (game !== "pool" && (named.length > 0 || numbers)) throw new TypeError(texts.onlyTablesOfPool);
  const kind = carom.kind(game, OPTIONS.cushionModel, named as Condition[]);
  if (!numbers) return kind;
  const [restitutionCushion, muCushion] = numbers as [number, number];
  if (!(numbers.length === 2 && restitutionCushion <= 1 && muCushion <= 1 && muCushion >= 0))
    throw new TypeError(texts.twoNumbersAreNeeded(cushion!));
  return { ...kind, restitutionCushion, muCushion };
}
const same = (a: readonly ShotBall[], b: readonly ShotBall[]): boolean =>
  a.every(
    ({ state }, k) =>
      state.label === b[k]!.state.label && state.r.every((x, c) => Object.is(x, b[k]!.state.r[c])),
  );

export class Play {
  readonly played: Played | undefined;
  readonly table: Table;
  readonly names: string[];
  readonly entries: Entry[] = [];
  readonly practice: boolean;
  balls: ShotBall[];
  state: GameState;
  /** Who is at the table, and who has won. */
  turn: 0 | 1 = 0;
  winner: 0 | 1 | undefined;
  hand: Ruling["hand"];
  points: [number, number] = [0, 0];
  last: Stroke | undefined;
  /** Layouts of practice before each stroke and move, to undo. */
  readonly past: ShotBall[][] = [];
  readonly #recording: Recording;

  constructor(
    readonly carom: Carom,
    readonly setup: Setup,
  ) {
    this.practice = setup.against === "practice";
    this.played = PLAYED[setup.game];
    const of = GAMES[this.played?.of ?? setup.game];
    if (!of || (!this.practice && !this.played))
      throw new TypeError(texts.gameThereIsNo(setup.game));
    const chosen = POOL_TABLES[setup.table ?? "9ft"];
    const isPool = of.table === "9ft";
    if (!chosen || (setup.table !== undefined && !isPool))
      throw new TypeError(texts.tableThereIsNo(setup.table!));
    this.table = isPool ? carom.table(chosen[1], chosen[2]) : carom.table(of.table);
    const kind = kindOf(carom, of.game, setup);
    this.balls = carom
      .rack(of.rack, this.table, { seed: setup.seed })
      .map(({ state }) => ({ kind, state }));
    this.names = this.balls.map((_, k) => of.names(k));
    if (setup.at !== undefined) this.balls = placesOf(setup.at, this.table, this.balls).balls;
    // Practice has no rules: every ball counts.
    const isPotting = this.practice && this.hasPockets;
    const rules = isPotting ? "potting" : this.played!.rules;
    const opens =
      (games[rules].members as readonly string[]).includes("opening") && setup.at === undefined;
    const own = isPotting ? {} : this.played!.state;
    this.state = { rules, group: "open", opening: opens, ...own };
    this.hand = this.practice || !this.hasPockets ? "no" : (this.played!.opening as Ruling["hand"]);
    // Racks put the cue ball on the head spot, which is beyond a baulk line.
    if (this.hand !== "no" && !mayLie(this.table, this.hand, this.balls[0]!.state.r))
      this.balls = atHead(this.carom, this.table, this.balls, this.hand);
    this.#recording = carom.record(this.table, this.balls, OPTIONS);
  }

  /**
   * Whether the next stroke is the first of a rack, whether or not the rules tell it from others.
   */
  get breaks(): boolean {
    return (
      this.state.opening === true ||
      (this.setup.at === undefined && this.entries.length === 0 && this.last === undefined)
    );
  }
  /** Whether the rules let the player pass. */
  get mayPass(): boolean {
    return this.state.may?.includes("pass") ?? false;
  }
  get hasPockets(): boolean {
    return this.table.pockets.length > 0;
  }
  /**
   * Gives the memory of the recording back; no stroke follows. The text is a recording by itself.
   */
  end(): string {
    return this.#recording.end();
  }

  /** The text of `at` for the layout. */
  at(): string {
    return placesText(this.balls, (x) => Number(x.toFixed(5)));
  }

  /** The game as text. */
  text(): string {
    return JSON.stringify({
      ...this.setup,
      ...(this.practice && !this.setup.drill ? { at: this.at() } : {}),
      entries: this.entries,
    });
  }

  /** The cue ball in hand, put down; or a ball of practice. Throws where it is not free. */
  put(ball: number, x: number, y: number): void {
    this.balls = this.carom.placeBall(this.table, this.balls, ball, x, y);
  }
  keep(): void {
    this.past.push(this.balls);
  }
  undo(): boolean {
    const before = this.past.pop();
    if (!before) return false;
    this.balls = before;
    this.last = undefined;
    return true;
  }
  /** A layout of practice. */
  lay(balls: ShotBall[]): void {
    this.keep();
    this.balls = balls;
  }

  /** Plays a stroke. Of a game, it is ruled and becomes an entry. */
  stroke(cue: Cue, call?: Call): Stroke {
    if (this.practice) return this.#practised(cue);
    const entry: Entry = { line: "" };
    if (call) entry.call = call;
    if (this.hand !== "no") {
      const [x, y] = this.balls[0]!.state.r;
      entry.place = [x, y];
      this.#recording.place(0, x, y);
    }
    let shot: Shot | undefined;
    if (call !== "pass") {
      shot = this.carom.simulate(this.table, this.balls, cue, OPTIONS);
      this.#recording.shoot(cue);
      entry.line = this.#recording.lines.at(-1)!.trim();
    }
    return this.#ruled(entry, cue, shot);
  }

  /** A stroke that another page played: every bit has to agree. */
  read(entry: Entry): Stroke {
    if (this.winner !== undefined) throw new TypeError(texts.aStrokeFollowsThe);
    if (entry.place) {
      if (this.hand === "no") throw new TypeError(texts.strokeTheCueBall(this.entries.length + 1));
      const [x, y] = entry.place;
      if (!mayLie(this.table, this.hand, [x, y]))
        throw new TypeError(texts.strokeTheCueBallLies(this.entries.length + 1));
      this.put(0, x, y);
      this.#recording.place(0, x, y);
    } else if (this.hand !== "no")
      throw new TypeError(texts.strokeThePlaceOf(this.entries.length + 1));
    if (entry.call === "pass") return this.#ruled(entry, this.carom.cue(), undefined);
    const replayed = this.#recording.read(entry.line);
    if (!replayed) throw new TypeError(texts.strokeItsLineHas(this.entries.length + 1));
    if (!replayed.same) throw new TypeError(texts.strokeEndsOtherwiseThan(this.entries.length + 1));
    return this.#ruled(entry, replayed.cue, replayed.film);
  }

  #practised(cue: Cue): Stroke {
    this.keep();
    const { balls, state } = this;
    const shot = this.carom.simulate(this.table, balls, cue, OPTIONS);
    this.balls = balls.map(({ kind }, k) => {
      const end = shot.final[k]!;
      return { kind, state: end.label === "off" ? pocketed(this.table, end) : end };
    });
    if (!onTable(this.balls[0]!.state)) this.balls = atHead(this.carom, this.table, this.balls);
    this.state = { ...state, opening: false };
    this.last = { who: 0, balls, cue, call: undefined, state, shot, ruling: undefined };
    return this.last;
  }

  #ruled(entry: Entry, cue: Cue, shot: Shot | undefined): Stroke {
    const { balls, state, turn: who } = this;
    const ruling = this.carom.referee(this.table, balls, cue, state, entry.call, OPTIONS);
    this.entries.push(entry);
    this.state = ruling.game;
    this.hand = ruling.hand;
    // Of points, as whoever plays next sees them.
    const { score } = ruling as { score?: readonly [number, number] };
    const target = this.played!.target;
    if (target !== undefined && ruling.turn === "keep" && ++this.points[who] >= target)
      this.winner = who;
    if (ruling.turn === "win") this.winner = who;
    if (ruling.turn === "lose") this.winner = who === 0 ? 1 : 0;
    if (ruling.turn === "pass") this.turn = who === 0 ? 1 : 0;
    if (score && this.played!.points && target === undefined)
      this.points = this.turn === 0 ? [score[0], score[1]] : [score[1], score[0]];
    this.balls = ruling.balls;
    // Balls that came back to a spot, or a cue ball that left the table, are another layout for the
    // recording.
    if (this.winner === undefined) {
      const lie = this.#recording.balls;
      if (!same(lie, this.balls)) this.#recording.setBalls(this.balls);
      if (this.hand !== "no" && this.hasPockets)
        this.balls = atHead(this.carom, this.table, this.balls, this.hand);
    }
    this.last = { who, balls, cue, call: entry.call, state, shot, ruling };
    return this.last;
  }
}

/** A game of a text, played to its last stroke. Throws where the text or a bit of it is wrong. */
export function read(carom: Carom, text: string): Play {
  const { entries, ...setup } = JSON.parse(text) as Setup & { entries: Entry[] };
  const play = new Play(carom, setup);
  for (const entry of entries) play.read(entry);
  return play;
}
