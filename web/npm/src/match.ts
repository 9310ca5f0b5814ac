// Matches between two players: the calls of carom_match.h.
import { Owner } from "./batches.js";
import { CaromError } from "./error.js";
import { layout, names, values } from "./generated/layout.js";
import { HANDS, type Rules } from "./plans.js";
import { KEYS, refuseUnknown } from "./keys.js";
import type { Exports, Pointer } from "./memory.js";
import type { Host as RecordingHost } from "./recording.js";
import type { Shot } from "./shot.js";
import {
  indexOf,
  members,
  readBalls,
  readStruct,
  readTable,
  value,
  whole,
  writeBalls,
  writeStruct,
  writeTable,
} from "./structs.js";
import type {
  PlanStroke,
  Cue,
  GameState,
  MatchOptions,
  PlanOptions,
  Ruling,
  ShotBall,
  ShotOptions,
  StopOptions,
  Table,
  Vec2,
} from "./types.js";

const MATCH = layout.carom_match.offset;
/** The number of a game of the caller's in recordings. */
const OWN = 1000;

/** What a match waits for; "over": nothing. */
export type Phase = "none" | "stroke" | "place" | "moving" | "over";
/** A choice besides a stroke. */
export type Choice = (typeof names.carom_choice)[number];

/** Where a cue ball in hand may be put, m. */
export interface Bounds {
  low: Vec2;
  high: Vec2;
  /** Of the D; `radius` is 0 where there is none. */
  centre: Vec2;
  radius: number;
}

/** What the calls of this file need of the library. */
export interface Host extends RecordingHost {
  cue(fields: Partial<Cue>): Cue;
  writeShotOptions(options: ShotOptions): Pointer;
  readState(at: Pointer, game: Rules): GameState;
  /** Throws what rules of the caller's threw in the last call. */
  checkOwn(): void;
  writeState(game: Partial<GameState>, balls: readonly ShotBall[]): Pointer;
  /** Plays a shot with its events, by options in the module's memory. */
  film(table: Table, balls: readonly ShotBall[], cue: Cue, options: Pointer): Shot;
  readRuling(at: Pointer, game: Rules, balls: readonly ShotBall[]): Ruling;
  think(
    table: Table,
    balls: readonly ShotBall[],
    options: PlanOptions,
    slice: number,
    leave: number,
  ): Generator<undefined, PlanStroke[]>;
}

/**
 * A game between two players: the table, the balls, the rules and the recording in one object,
 * which takes one act after another: `carom.match("eightball", table)`. An act that the rules
 * forbid throws a CaromError, whose text says what would be right, and changes nothing.
 */
export class Match extends Owner<Host> {
  readonly #lines: string[] = [];
  /** The last stroke, for its film. */
  #struck: { balls: ShotBall[]; cue: Cue } | undefined;
  #film: Shot | undefined;
  #own: GameState["own"];

  /** @internal */
  constructor(host: Host) {
    super(host, [layout.carom_match.size]);
  }

  /** @internal The rules of the caller's for lines that are read. */
  readBy(game: Partial<GameState>): void {
    this.#own = game.own;
    const rules = this.#host.writeState(game, []) - layout.carom_plan_rules.offset.state;
    this.#host.memory.u8.copyWithin(
      this.#at + MATCH.rules,
      rules,
      rules + layout.carom_plan_rules.size,
    );
  }

  /** @internal */
  begin(game: Partial<GameState>, table: Table, options: MatchOptions): void {
    refuseUnknown(options, KEYS.match, "options");
    const { memory } = this.#host;
    const { seed, player, balls, hand = "no", shot = {} } = options;
    this.#own = game.own;
    const rules = game.own ? OWN : value("carom_rules_kind", game.rules ?? "eightball", "rules");
    if (game.own && balls === undefined)
      throw new TypeError("balls: rules of your own have no rack; a layout is needed");
    const who = whole(player, "player", 1);
    const tableAt = memory.allocate(layout.carom_table.size);
    const ballsAt = memory.allocate(values.CAROM_BALLS_MOST * layout.carom_shot_ball.size);
    try {
      writeTable(memory, tableAt, table);
      if (balls === undefined) {
        const from = BigInt(whole(seed, "seed", Number.MAX_SAFE_INTEGER));
        const { target = 0, innings = 0 } = game;
        this.#act((at, call) =>
          call.carom_match_begin_to(at, rules, target, innings, tableAt, from, who),
        );
        return;
      }
      writeBalls(memory, ballsAt, balls);
      const of = this.#host.writeState(game, balls) - layout.carom_plan_rules.offset.state;
      const models = this.#host.writeShotOptions(shot);
      const leave = Math.max(indexOf(HANDS, hand, "hand"), 0);
      const rest = [tableAt, ballsAt, balls.length, models, leave, who];
      this.#act((at, call) => call.carom_match_begin_at(at, rules, of, ...rest));
    } finally {
      memory.free(tableAt);
      memory.free(ballsAt);
    }
  }

  /**
   * Reads a line of a match and judges it again. Throws a CaromError where it is not by the rules,
   * or has other bits; nothing is read behind it.
   */
  read(line: string): void {
    const { memory } = this.#host;
    if (this.#number("due") === 0) this.#lines.push(...this.#written);
    const bytes = new TextEncoder().encode(line);
    const text = memory.allocate(bytes.length);
    const scratch = memory.allocate(layout.carom_record.size);
    const balls = line.startsWith('{"shot"') ? this.balls : undefined;
    try {
      memory.u8.set(bytes, text);
      const code = memory.exports.carom_match_read(this.#at, scratch, text, bytes.length);
      this.#host.checkOwn();
      this.#told(code);
    } finally {
      memory.free(text);
      memory.free(scratch);
    }
    if (balls) this.#keep(balls);
    if (line.trim() !== "") this.#lines.push(`${line.trim()}\n`);
  }

  // ---- How the match stands

  /**
   * The recording so far, a line each, which `carom verify` judges again. Of a text that was read
   * and cut off it has the lines that were missing.
   */
  get lines(): string[] {
    return [...this.#lines, ...this.#written];
  }
  get table(): Table {
    return readTable(this.#host.memory, this.#record("table"));
  }
  /** The layout of the next stroke. */
  get balls(): ShotBall[] {
    const count = this.#recorded("count");
    return readBalls(this.#host.memory, this.#record("balls"), count);
  }
  /** How the game stands for the player at the table. */
  get game(): GameState {
    const state = this.#at + MATCH.rules + layout.carom_plan_rules.offset.state;
    return this.#host.readState(state, this.#rules);
  }
  /** A stroke, a place of the cue ball in hand, the rest of a shot that was stopped, or nothing. */
  get phase(): Phase {
    return names.carom_match_phase[this.#number("phase")] as Phase;
  }
  /** Who is at the table, 0 or 1. */
  get player(): number {
    return this.#recorded("player");
  }
  /** Who has won, 0 or 1. */
  get winner(): number | undefined {
    const winner = this.#number("winner");
    return winner < 0 || this.drawn ? undefined : winner;
  }
  /** Whether the match is over without a winner. */
  get drawn(): boolean {
    return this.#number("winner") === values.CAROM_DRAWN;
  }
  /** How many strokes were played. */
  get shots(): number {
    return this.#recorded("shots");
  }
  /** The choices for `choose`; a "free_ball" is named by a call. */
  get may(): Choice[] {
    const may = this.#number("may");
    return names.carom_choice.filter((_, k) => (may >> k) & 1) as Choice[];
  }
  /** The ball that the player at the table strikes. */
  get cueBall(): number {
    return this.#number("cueBall");
  }
  /** The balls that the player at the table may strike: `cueBall`, or where the rules say so any. */
  get strikable(): number[] {
    const { anyCueBall } = layout.carom_plan_rules.offset;
    const isAny = this.#host.memory.i32[(this.#at + MATCH.rules + anyCueBall) / 4] !== 0;
    if (!isAny || this.game.opening) return [this.cueBall];
    return [...this.balls.entries()].flatMap(([ball, { state }]) =>
      state.label === "pocketed" || state.label === "off" ? [] : [ball],
    );
  }
  /** The balls that may be met first, and those that touch the cue ball. */
  get on(): number[] {
    return members(this.#number("on"));
  }
  get touching(): number[] {
    return members(this.#number("touching"));
  }
  /** Where the rules let a cue ball in hand be put, until the stroke: `bounds` in a word. */
  get hand(): Ruling["hand"] {
    return this.phase === "over" ? "no" : HANDS[this.#number("leave")]!;
  }
  /** Where a cue ball in hand may be put, until the stroke. */
  get bounds(): Bounds | undefined {
    if (this.hand === "no") return undefined;
    return readStruct(this.#host.memory, this.#at + MATCH.bounds, "carom_bounds");
  }
  /** The last ruling. */
  get ruling(): Ruling | undefined {
    if (this.#number("rulings") === 0) return undefined;
    return this.#host.readRuling(this.#at + MATCH.ruling, this.#rules, this.balls);
  }
  /** The cue of the last stroke. */
  get cue(): Cue | undefined {
    return this.#struck?.cue;
  }
  /** The last shot, or what was played of it, with its events. */
  get last(): Shot | undefined {
    if (this.#struck === undefined) return undefined;
    const { balls, cue } = this.#struck;
    return (this.#film ??= this.#host.film(this.table, balls, cue, this.#record("options")));
  }

  // ---- Acts

  /** Takes a choice: "push" for the next stroke, the others instead of it. */
  choose(what: Choice): void {
    const bit = 1 << value("carom_choice", what, "what");
    this.#act((at, call) => call.carom_match_choose(at, this.player, bit));
  }
  /** Puts the cue ball in hand within `bounds`, m; until the stroke it may be put elsewhere. */
  place(x: number, y: number): void {
    this.#act((at, call) => call.carom_match_place(at, this.player, x, y));
  }
  /** Calls the ball and the pocket of the next stroke; ball -1: a safety. */
  call(ball: number, pocket = -1): void {
    for (const [name, given] of Object.entries({ ball, pocket }))
      if ((given | 0) !== given)
        throw new TypeError(`${name}: it must be a whole number, not ${JSON.stringify(given)}`);
    const { memory } = this.#host;
    const called = memory.allocate(8);
    memory.i32.set([ball, pocket], called / 4);
    try {
      this.#act((at, call) => call.carom_match_call(at, this.player, called));
    } finally {
      memory.free(called);
    }
  }
  /**
   * Plays a stroke of `cueBall`, or of another `strikable` ball that the cue names, up to where
   * the options stop it. Returns whether the shot has ended, and is ruled.
   */
  stroke(cue: Partial<Cue>, stop: StopOptions = {}): boolean {
    const { memory } = this.#host;
    const { balls } = this;
    const cueAt = memory.allocate(layout.carom_cue.size);
    const struck = this.#host.cue({ ball: this.cueBall, ...cue });
    try {
      writeStruct(memory, cueAt, "carom_cue", struck, "cue");
      const until = this.#host.writeShotOptions(stop);
      const isEnded = this.#act((at, call) =>
        call.carom_match_stroke(at, this.player, cueAt, until, 0),
      );
      this.#keep(balls);
      return isEnded;
    } finally {
      memory.free(cueAt);
    }
  }
  /** Goes on with a shot that was stopped, likewise. */
  continue(stop: StopOptions = {}): boolean {
    this.#film = undefined;
    const until = this.#host.writeShotOptions(stop);
    return this.#act((at, call) => call.carom_match_continue(at, until, 0));
  }
  /** A player gives the game to the other. */
  concede(player: number): void {
    const who = whole(player, "player", 1);
    this.#act((at, call) => call.carom_match_concede(at, who));
  }
  /** The time of the player at the table is over: a foul. */
  clock(): void {
    this.#act((at, call) => call.carom_match_clock(at, this.player));
  }
  /** The whole text, with its last line: nothing follows, and the memory is given back. */
  end(): string {
    this.#act((at, call) => call.carom_match_end(at));
    const text = this.lines.join("");
    this.free();
    return text;
  }

  // ---- Plans

  /** The best strokes of the player at the table, with a cue ball in hand within `bounds`. */
  plan(options: PlanOptions = {}): PlanStroke[] {
    return this.think(options, 0).next().value as PlanStroke[];
  }
  /** The same in slices, as `carom.think`. */
  think(options: PlanOptions = {}, slice = 1000): Generator<undefined, PlanStroke[]> {
    if (this.phase === "over") throw new RangeError("plan: the match is over");
    if (this.phase === "moving") throw new RangeError("plan: balls move: continue() the shot");
    const wanted: PlanOptions = {
      ...options,
      ...this.game,
      cue: { ...options.cue, ...(this.strikable.length === 1 && { ball: this.cueBall }) },
      inHand: this.phase === "place" ? this.hand : "no",
    };
    return this.#host.think(this.table, this.balls, wanted, slice, this.#number("leave"));
  }
  /**
   * Takes a choice of a plan: places, calls and plays its stroke, or passes. `cue` is the stroke as
   * the player makes it.
   */
  take({ kind, place, ball, pocket, ...best }: PlanStroke, cue: Partial<Cue> = best.cue): void {
    if (kind === "pass") return this.choose("pass");
    if (this.phase === "place") this.place(place[0]!, place[1]!);
    if (kind === "push") this.choose("push");
    const { calls } = layout.carom_plan_rules.offset;
    if (ball >= 0 && this.#host.memory.i32[(this.#at + MATCH.rules + calls) / 4] !== 0)
      this.call(ball, pocket);
    this.stroke(cue);
  }

  // ---- Memory

  get #host(): Host {
    return this.library;
  }
  get #at(): Pointer {
    return this.at(0);
  }
  #number(of: keyof typeof MATCH): number {
    const at = this.#at + MATCH[of];
    const isLong = (layout.carom_match.type as Record<string, string>)[of] === "i64";
    return isLong ? Number(this.#host.memory.i64[at / 8]) : this.#host.memory.i32[at / 4]!;
  }
  #record(of: keyof typeof layout.carom_record.offset): Pointer {
    return this.#at + MATCH.record + layout.carom_record.offset[of];
  }
  get #rules(): Rules {
    const rules = names.carom_rules_kind[this.#recorded("rules")] ?? "eightball";
    return { rules, own: this.#own };
  }
  #recorded(of: "count" | "rules" | "player" | "shots"): number {
    return Number(this.#host.memory.i64[this.#record(of) / 8]);
  }
  /** The lines of the last act. */
  get #written(): string[] {
    const text = this.#at + MATCH.text;
    const bytes = this.#host.memory.u8.slice(text, text + this.#number("size"));
    return new TextDecoder().decode(bytes).match(/.*\n/g) ?? [];
  }
  #act(act: (at: Pointer, call: Exports) => number): boolean {
    const { memory } = this.#host;
    this.#lines.push(...this.#written);
    const at = this.#at;
    const size = layout.carom_match.size;
    const before = this.#own && memory.u8.slice(at, at + size);
    const code = act(at, memory.exports);
    try {
      this.#host.checkOwn();
    } catch (error) {
      memory.u8.set(before!, at); // an act whose rules threw has not been
      memory.i64[(at + MATCH.size) / 8] = 0n;
      throw error;
    }
    return this.#told(code);
  }
  /** Throws what was refused; else whether a shot has ended. */
  #told(code: number): boolean {
    const { memory } = this.#host;
    if (code >= 0) return code === 0;
    const fault = memory.text(this.#at + MATCH.fault)!;
    if (fault === "") this.#host.refuse(code);
    const [act, ...right] = fault.split(": ");
    throw new CaromError(code, this.#host.statusName(code), right.join(": "), act);
  }
  #keep(balls: ShotBall[]): void {
    this.#film = undefined;
    const cue = readStruct<Cue>(this.#host.memory, this.#record("cue"), "carom_cue");
    this.#struck = { balls, cue };
  }
}
