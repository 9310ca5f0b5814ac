// Matches of 2 to 8 seats: the calls of carom_match.h.
import { CaromError } from "./error.js";
import { layout, names, values } from "./generated/layout.js";
import { MatchActs } from "./generated/match.js";
import { HANDS, type Rules } from "./plans.js";
import { KEYS, refuseUnknown } from "./keys.js";
import type { Exports, Pointer } from "./memory.js";
import type { Host as RecordingHost } from "./recording.js";
import type { Shot } from "./shot.js";
import {
  indexOf,
  readBalls,
  readOptions,
  readStruct,
  readTable,
  setStruct,
  type StructName,
  value,
  whole,
  writeBalls,
  writeStruct,
  writeTable,
} from "./structs.js";
import type * as C from "./generated/structs.js";
import type {
  PlanStroke,
  Cue,
  GameState,
  MatchOptions,
  MatchSet,
  Note,
  PlanOptions,
  Player,
  Ruling,
  Seat,
  ShotBall,
  ShotOptions,
  Skill,
  Standing,
  StopOptions,
  Table,
  Vec2,
} from "./types.js";

const MATCH = layout.carom_match.offset;
const SEATING = layout.carom_seating.offset;
const SEAT = layout.carom_seat;
/** When a stroke is stopped, and the seat that plays it: by default the seat at the table. */
export type StrokeOptions = StopOptions & { seat?: number };
/** The number of a custom game in recordings. */
const OWN = 1000;

/** What a match waits for; "over": nothing. */
export type Phase = C.MatchPhase;
/**
 * The choices in addition to a stroke: a line "act" has 2 to the power of the index in this list.
 */
export const choices = names.carom_choice;
export type Choice = (typeof choices)[number];

/** Where a cue ball in hand may be put, m. */
export interface Bounds {
  low: Vec2;
  high: Vec2;
  /** Of the D; `radius` is 0 if there is no D. */
  centre: Vec2;
  radius: number;
}

/** The functions of the library that this file uses. */
export interface Host extends RecordingHost {
  cue(fields: Partial<Cue>): Cue;
  writeShotOptions(options: ShotOptions): Pointer;
  readState(pointer: Pointer, game: Rules): GameState;
  /** Throws the exception that custom rules threw in the last call. */
  checkOwn(): void;
  writeState(game: Partial<GameState>, balls: readonly ShotBall[]): Pointer;
  /** The last shot of a match, with its events. */
  film(match: Pointer, table: Table, balls: readonly ShotBall[], cue: Cue): Shot;
  player(of: Skill): Player;
  readRuling(pointer: Pointer, game: Rules, balls: readonly ShotBall[]): Ruling;
  think(
    table: Table,
    balls: readonly ShotBall[],
    options: PlanOptions,
    slice: number,
    leave: number,
  ): Generator<undefined, PlanStroke[]>;
}

/** A text of C with the names of JavaScript: place() for carom_match_place(). */
function inJavaScript(text: string): string {
  return text
    .replaceAll("carom_record_read()", "replay()")
    .replace(/CAROM_[A-Z]+_(\w+)/g, (_, word: string) => `"${word.toLowerCase()}"`)
    .replace(/carom_(?:match_)?(\w+)/g, "$1")
    .replace(/\b(cue|match|set)\.(\w+)/g, (_, of: string, name: string) => {
      return `${of}.${name.replace(/_(.)/g, (_, letter: string) => letter.toUpperCase())}`;
    });
}

/** The number of a text such as "0x1.8p+1". */
function fromHex(text: string): number {
  const [, sign, whole, digits = "", exponent] = /^(-?)0x([01])(?:\.(\w+))?p([+-]\d+)$/.exec(text)!;
  const size =
    Number.parseInt(`0${whole}${digits}`, 16) * 2 ** (Number(exponent) - 4 * digits.length);
  return sign === "-" ? -size : size;
}

/**
 * A game of 2 to 8 seats: the table, the balls, the rules, the players with their cues, the last
 * shot and the recording in one object, which is changed by acts: `carom.match("eightball",
 * table)`. An act that the rules forbid throws a CaromError, whose text describes what would be
 * right, and changes nothing. By default the seat at the table acts.
 */
export class Match extends MatchActs<Host> {
  /** All lines except those of the last act, which are in the text of C. */
  readonly #lines: string[] = [];
  readonly #undone: string[][] = [];
  #film: { hash: bigint; shot: Shot | undefined } | undefined;
  #customRules: GameState["own"];

  /** @internal */
  constructor(host: Host) {
    super(host, [layout.carom_match.size]);
  }

  /** @internal The custom rules for lines that are read. */
  readBy(game: Partial<GameState>): void {
    this.#customRules = game.own;
    const rules = this.#host.writeState(game, []) - layout.carom_plan_rules.offset.state;
    this.#host.memory.u8.copyWithin(
      this.#pointer + MATCH.rules,
      rules,
      rules + layout.carom_plan_rules.size,
    );
  }

  /** @internal */
  begin(game: Partial<GameState>, table: Table, options: MatchOptions): void {
    refuseUnknown(options, KEYS.match, "options");
    const { seed, balls, hand = "no", shot = {} } = options;
    this.#customRules = game.own;
    const rules = game.own ? OWN : value("carom_rules_kind", game.rules ?? "eightball", "rules");
    if (game.own && balls === undefined)
      throw new TypeError("balls: custom rules have no rack; a layout is needed");
    const side = whole(options.side, "side", values.CAROM_SEATS_MOST - 1);
    const draws = whole(seed, "seed", Number.MAX_SAFE_INTEGER);
    this.#using(
      ["carom_match_setup", "carom_table", "carom_seating", "carom_set"],
      ([setup, tableAt, seating, set]) => {
        const { memory } = this.#host;
        const ballsAt = memory.allocate(values.CAROM_BALLS_MOST * layout.carom_shot_ball.size);
        try {
          writeTable(memory, tableAt, table);
          writeBalls(memory, ballsAt, balls ?? []);
          const hasSeats = this.#writeSeats(seating, rules, game, options);
          if (options.set) {
            const order = value("carom_break_order", options.set.order ?? "alternate", "set.order");
            this.#fill(set, "carom_set", { ...options.set, order }, "set");
          }
          const of =
            balls && this.#host.writeState(game, balls) - layout.carom_plan_rules.offset.state;
          setStruct(memory, setup, "carom_match_setup", {
            rules,
            of,
            table: tableAt,
            balls: balls && ballsAt,
            count: balls?.length,
            options: this.#host.writeShotOptions(shot),
            leave: balls && Math.max(indexOf(HANDS, hand, "hand"), 0),
            target: game.target,
            equalInnings: game.innings,
            side,
            seed: draws,
            seating: hasSeats ? seating : 0,
            set: options.set && set,
          });
          this.act((pointer, call) => call.carom_match_begin_with(pointer, setup));
        } finally {
          memory.free(ballsAt);
        }
      },
    );
  }

  /** Writes the seats. Returns whether they differ from the usual two without names. */
  #writeSeats(
    seating: Pointer,
    rules: number,
    { own }: Partial<GameState>,
    { seats, alternate = false, limits }: MatchOptions,
  ): boolean {
    if (seats === undefined && !alternate && limits === undefined) return false;
    const { memory } = this.#host;
    const names = typeof seats === "object" ? seats : Array<string>(seats ?? 0).fill("");
    if (memory.exports.carom_seating_make(rules, names.length, seating) < 0)
      throw new RangeError(`seats: ${names.length} seats cannot play this game`);
    for (const [k, one] of names.entries()) {
      const seat = seating + SEATING.seat + k * SEAT.size;
      const name = `seats[${k}]`;
      const { name: text, cue, ...rest } = typeof one === "string" ? { name: one } : one;
      const side = own && own.race !== "seats" ? { side: k % 2 } : {};
      refuseUnknown(rest, ["name", "side", "handicap", "rating", "cue"], name);
      for (const [key, number] of Object.entries({ ...side, ...rest }))
        if (!Number.isFinite(number))
          throw new TypeError(`${name}.${key}: a number is needed, not ${JSON.stringify(number)}`);
      setStruct(memory, seat, "carom_seat", { ...side, ...rest }, false);
      const bytes = new TextEncoder().encode(text).slice(0, SEAT.bytes.name);
      memory.u8.set(bytes, seat + SEAT.offset.name);
      const stick = { ...cue, speed: 0, phi: 0, theta: 0, a: 0, b: 0, ball: 0 };
      this.#fill(seat + SEAT.offset.cue, "carom_cue", stick, `${name}.cue`);
    }
    setStruct(memory, seating, "carom_seating", { alternate: Number(alternate) }, false);
    this.#fill(seating + SEATING.limits, "carom_stroke_limits", limits ?? {}, "limits");
    return true;
  }

  /** Sets some fields of a struct. */
  #fill(pointer: Pointer, struct: StructName, fields: object, name: string): void {
    const { memory } = this.#host;
    writeStruct(memory, pointer, struct, fields, name, readStruct<object>(memory, pointer, struct));
  }

  /**
   * Reads the next line of a file and judges it: an act, or a line of the ruling of the last act.
   * Throws a CaromError where the line is not by the rules or has other bits; then nothing has
   * changed.
   */
  read(line: string): void {
    const state = (): string => `${this.#record64("line")} ${this.#record64("hash")}`;
    const known = this.#written;
    const isDue = this.#number("due") > 0;
    const size = this.#number("size");
    const previous = state();
    this.#withText(line, (text, bytes) =>
      this.#using(["carom_record"], ([scratch]) =>
        this.#called((pointer, call) => call.carom_match_read(pointer, scratch, text, bytes)),
      ),
    );
    if (isDue && this.#number("size") < size) this.#lines.push(known[0]!);
    // A note, before the lines that are due.
    else if (isDue && state() !== previous) this.#lines.push(`${line.trim()}\n`);
    else if (!isDue && state() !== previous) this.#lines.push(...known, `${line.trim()}\n`);
    this.#undone.length = 0;
  }

  /**
   * Judges a line that a peer has sent, such as a client of a server. `seat` is the seat that sent
   * it; null: a sender that may send every line, such as the server of a client. The lines of the
   * ruling need not follow, because the match makes them, and a line of the last act that comes
   * again changes nothing. Returns whether the match has changed; `lines` then has new ones. Throws
   * a CaromError where the line is not by the rules, has other bits, or is an act of another seat;
   * the match then stays as it was, to the bit.
   */
  receive(line: string, seat: number | null): boolean {
    const known = this.#written;
    const lineCount = this.#record64("line");
    this.#withText(line, (text, bytes) =>
      this.#using(["carom_match"], ([room]) =>
        this.#called((pointer, call) =>
          call.carom_match_receive(pointer, room, text, bytes, seat ?? -1),
        ),
      ),
    );
    if (this.#record64("line") === lineCount) return false;
    this.#lines.push(...known);
    // A line of the beginning is read, and the match makes no lines.
    if (this.#number("size") === 0) this.#lines.push(`${line.trim()}\n`);
    this.#undone.length = 0;
    return true;
  }

  /** A copy of this match, independent of it. */
  copy(): Match {
    const twin = new Match(this.#host);
    twin.#take(this, this.#lines);
    twin.#undone.push(...this.#undone);
    return twin;
  }

  #take(other: Match, lines: readonly string[]): void {
    const pointer = other.#pointer;
    this.#host.memory.u8.copyWithin(this.#pointer, pointer, pointer + layout.carom_match.size);
    this.#customRules = other.#customRules;
    this.#lines.splice(0, Infinity, ...lines);
  }

  /** Undoes the last act, by judging the lines before it again. Returns whether there was one. */
  undo(): boolean {
    const { lines } = this;
    const kept = this.#withText(lines.join(""), (text, bytes) => {
      const { memory } = this.#host;
      const size = memory.exports.carom_match_undone(text, bytes);
      return new TextDecoder().decode(memory.u8.slice(text, text + size)).match(/.*\n/g) ?? [];
    });
    if (kept.length === lines.length) return false;
    const earlier = new Match(this.#host);
    if (this.#customRules) earlier.readBy({ own: this.#customRules });
    try {
      for (const line of kept) earlier.read(line);
      this.#take(earlier, earlier.#lines);
    } finally {
      earlier.free();
    }
    this.#undone.push(lines.slice(kept.length));
    return true;
  }
  /** Repeats the act that was undone last, unless another act followed. */
  redo(): boolean {
    const lines = this.#undone.pop();
    const others = this.#undone.splice(0);
    for (const line of lines ?? []) this.read(line);
    this.#undone.push(...others);
    return lines !== undefined;
  }

  // ---- How the match stands

  /**
   * The lines of the recording so far, which `carom verify` judges again. For a text that was cut
   * off they include the missing lines.
   */
  get lines(): string[] {
    return [...this.#lines, ...this.#written];
  }
  /**
   * The notes of the recording so far. A recording does not seal its notes: anybody who can edit it
   * can change them.
   */
  get notes(): Note[] {
    return this.lines
      .filter((line) => /^\s*\{\s*"note"/.test(line))
      .map((line) => {
        const { note } = JSON.parse(line) as { note: Note & { seconds?: number | string } };
        const { seconds } = note;
        // More digits than a decimal of a recording has.
        return typeof seconds === "string" ? { ...note, seconds: fromHex(seconds) } : note;
      });
  }
  /**
   * The recording so far, text that `carom.load` reads. `carom verify` also demands the last line,
   * which `end()` adds to a match that is over.
   */
  save(): string {
    return this.lines.join("");
  }
  /** The models of all shots, and the stop of the last one. */
  get options(): ShotOptions {
    return readOptions(this.#host.memory, this.#record("options"), "carom_shot_options");
  }
  /** @internal The last stroke. */
  get struck(): Cue {
    return readStruct(this.#host.memory, this.#pointer + MATCH.stroke, "carom_cue");
  }
  /** @internal The call of the next stroke. */
  get called(): C.Call {
    return readStruct(this.#host.memory, this.#pointer + MATCH.call, "carom_call");
  }
  get table(): Table {
    return readTable(this.#host.memory, this.#record("table"));
  }
  /** The layout of the next stroke. */
  get balls(): ShotBall[] {
    const count = this.#recorded("count");
    return readBalls(this.#host.memory, this.#record("balls"), count);
  }
  /** The state of the game for the player at the table. */
  get game(): GameState {
    const state = this.#pointer + MATCH.rules + layout.carom_plan_rules.offset.state;
    return this.#host.readState(state, this.#rules);
  }
  /** Who plays. */
  get seats(): Seat[] {
    const { memory } = this.#host;
    const first = this.#pointer + MATCH.seating + SEATING.seat;
    return Array.from({ length: this.standing.sides.length }, (_, k) => {
      const seat = first + k * SEAT.size;
      const name = memory.text(seat + SEAT.offset.name)!;
      return { name, ...readStruct<Omit<Seat, "name">>(memory, seat, "carom_seat") };
    });
  }
  /** The limits of strokes; 0: no limit. */
  get limits(): C.StrokeLimits {
    const limits = this.#pointer + MATCH.seating + SEATING.limits;
    return readStruct(this.#host.memory, limits, "carom_stroke_limits");
  }
  /** The set that the match belongs to, with its `number` and how many each side had `won`. */
  get set(): MatchSet | undefined {
    const { order, won, ...set } = readStruct<C.Set>(
      this.#host.memory,
      this.#record("set"),
      "carom_set",
    );
    const word = names.carom_break_order[order] as C.BreakOrder;
    const sides = this.standing.won.length;
    return set.race === 0 ? undefined : { ...set, order: word, won: won.slice(0, sides) };
  }
  /** The score of the match, by sides. */
  get standing(): Standing {
    return this.#using(["carom_standing"], ([standing]) => {
      const { memory } = this.#host;
      memory.exports.carom_match_standing(this.#pointer, standing);
      const read = readStruct<C.Standing>(memory, standing, "carom_standing");
      const count = memory.i64[(this.#pointer + MATCH.seating + SEATING.count) / 8];
      return {
        sides: read.sideOf.slice(0, Number(count)),
        points: read.points.slice(0, read.sides),
        won: read.won.slice(0, read.sides),
        setWinner: read.setWinner === 0 ? undefined : read.setWinner - 1,
      };
    });
  }
  /**
   * A text with what the match waits for, or how it ended; `ruling.words` describes the last
   * ruling.
   */
  get words(): string {
    const { memory } = this.#host;
    const text = memory.allocate(1024);
    try {
      memory.exports.carom_match_string(this.#pointer, text, 1024);
      return memory.text(text)!;
    } finally {
      memory.free(text);
    }
  }
  /**
   * The balls that the player at the table may strike: `cueBall`, or any ball if the rules allow
   * it.
   */
  get strikable(): number[] {
    const { anyCueBall } = layout.carom_plan_rules.offset;
    const isAny = this.#host.memory.i32[(this.#pointer + MATCH.rules + anyCueBall) / 4] !== 0;
    if (!isAny || this.game.opening) return [this.cueBall];
    return [...this.balls.entries()].flatMap(([ball, { state }]) =>
      state.label === "pocketed" || state.label === "off" ? [] : [ball],
    );
  }
  /** Where the rules allow a cue ball in hand, until the stroke: the name of `bounds`. */
  get hand(): Ruling["hand"] {
    return this.phase === "over" ? "no" : HANDS[this.#number("leave")]!;
  }
  /** The bounds of a cue ball in hand, until the stroke. */
  get bounds(): Bounds | undefined {
    if (this.hand === "no") return undefined;
    return readStruct(this.#host.memory, this.#pointer + MATCH.bounds, "carom_bounds");
  }
  /** The last ruling. */
  get ruling(): Ruling | undefined {
    if (this.#number("rulings") === 0) return undefined;
    return this.#host.readRuling(this.#pointer + MATCH.ruling, this.#rules, this.balls);
  }
  /** The last shot, as far as it was played, with its events: played here or read. */
  get shot(): Shot | undefined {
    const { memory } = this.#host;
    const cue = readStruct<Cue>(memory, this.#pointer + MATCH.stroke, "carom_cue");
    if (cue.mass === 0) return undefined;
    const end = this.#record("played") + layout.carom_record_end.offset.hash;
    const hash = memory.i64[end / 8]!;
    if (this.#film?.hash !== hash) {
      const before = this.#pointer + MATCH.before;
      const balls = readBalls(memory, before, this.#recorded("count"));
      this.#film = { hash, shot: this.#replay(balls, cue) };
    }
    return this.#film.shot;
  }
  #replay(balls: ShotBall[], cue: Cue): Shot | undefined {
    try {
      return this.#host.film(this.#pointer, this.table, balls, cue);
    } catch (error) {
      if (error instanceof CaromError) return error.shot;
      throw error;
    }
  }

  // ---- Acts

  /** Calls the ball and the pocket of the next stroke; ball -1: a safety. */
  call(ball: number, pocket = -1, seat?: number): void {
    for (const [name, number] of Object.entries({ ball, pocket }))
      if ((number | 0) !== number)
        throw new TypeError(`${name}: it must be a whole number, not ${JSON.stringify(number)}`);
    this.#using(["carom_call"], ([called]) => {
      this.#host.memory.i32.set([ball, pocket], called / 4);
      this.act((pointer, call) => call.carom_match_call(pointer, this.seatOf(seat), called));
    });
  }
  /**
   * Plays a stroke of `cue`, with the given fields replaced, until the options stop it. The ball
   * may be any `strikable` one. Returns whether the shot has ended, and was judged.
   */
  stroke(cue: Partial<Cue>, { seat, ...stop }: StrokeOptions = {}): boolean {
    return this.#using(["carom_cue"], ([struck]) => {
      this.#fillCue(struck, cue);
      const stops = this.#host.writeShotOptions(stop);
      return this.act((pointer, call) =>
        call.carom_match_stroke(pointer, this.seatOf(seat), struck, stops, 0),
      );
    });
  }
  #fillCue(pointer: Pointer, cue: Partial<Cue>): void {
    writeStruct(this.#host.memory, pointer, "carom_cue", cue, "cue", this.cue);
  }
  /** Continues a stopped shot in the same way. */
  continue(stop: StopOptions = {}): boolean {
    const stopOptions = this.#host.writeShotOptions(stop);
    return this.act((pointer, call) => call.carom_match_continue(pointer, stopOptions, 0));
  }
  /**
   * Performs the acts that a choice of a plan requires before its stroke: places, pushes out and
   * calls; or passes, in which case no stroke follows.
   */
  prepare({ kind, place, ball, pocket }: PlanStroke, seat?: number): void {
    this.#using(["carom_plan_stroke"], ([choice]) => {
      const { memory } = this.#host;
      const numbers = { kind: value("carom_plan_kind", kind, "kind"), ball, pocket };
      setStruct(memory, choice, "carom_plan_stroke", numbers);
      memory.f64.set(place, (choice + layout.carom_plan_stroke.offset.place) / 8);
      this.act((pointer, call) => call.carom_match_prepare(pointer, this.seatOf(seat), choice));
    });
  }
  /**
   * Plays a choice of a plan: prepares it, and plays its stroke unless it is a pass. `cue` is the
   * stroke as the player makes it.
   */
  take(choice: PlanStroke, cue: Partial<Cue> = choice.cue, options: StrokeOptions = {}): boolean {
    this.prepare(choice, options.seat);
    return choice.kind === "pass" || this.stroke(cue, options);
  }
  /**
   * Writes words into the recording. They change neither the game nor a hash, and `note.seat` is who
   * says them; without it, nobody in particular. The rules have no draw by agreement and no
   * take-back: after both sides have agreed, `end()` the match, or `undo()` the last act.
   */
  note({ seconds, ...words }: Note): void {
    for (const [key, value] of Object.entries<unknown>(words))
      if (value !== undefined && typeof value !== "string" && !Number.isFinite(value))
        throw new TypeError(`note.${key}: it must be a text or a number, not ${String(value)}`);
    if (seconds !== undefined && !Number.isFinite(seconds))
      throw new TypeError(`note.seconds: it must be a number, not ${String(seconds)}`);
    // The digits that a line may have.
    const rounded = seconds === undefined ? {} : { seconds: Number(seconds.toPrecision(15)) };
    const line = JSON.stringify({ note: { ...words, ...rounded } });
    const { memory } = this.#host;
    this.#withText(line, (text, bytes) =>
      this.#using(["carom_record"], ([scratch]) => {
        const record = this.#pointer + MATCH.record;
        memory.u8.copyWithin(scratch, record, record + layout.carom_record.size);
        const code = memory.exports.carom_record_read(scratch, text, bytes);
        if (code < 0) {
          const fault = memory.text(scratch + layout.carom_record.offset.fault)!;
          throw new CaromError(code, this.#host.statusName(code), fault, "note");
        }
        const note = scratch + layout.carom_record.offset.note;
        const seat = Number(memory.i64[(note + layout.carom_note.offset.by) / 8]) - 1;
        this.act((pointer, call) => call.carom_match_note(pointer, seat, note));
      }),
    );
  }
  /** The complete text, with its last line: nothing follows, and the memory is freed. */
  end(): string {
    this.act((pointer, call) => call.carom_match_end(pointer));
    const text = this.lines.join("");
    this.free();
    return text;
  }

  // ---- Plans

  /**
   * The opponent of the seat at the table, by carom_match_opponent(): by rating, or else `player`
   * with errors estimated from the strokes of the other side.
   */
  opponent(player: Player): Player {
    return this.#using(["carom_player", "carom_player"], ([asks, found]) => {
      const { memory } = this.#host;
      this.#fill(asks, "carom_player", player, "player");
      memory.exports.carom_match_opponent(this.#pointer, asks, found);
      return readStruct<Player>(memory, found, "carom_player");
    });
  }
  /**
   * The best strokes of the seat at the table, with a cue ball in hand within `bounds`. By default
   * the cue is the cue of the seat, the player has its rating, and the opponent is `opponent()`.
   */
  plan(options: PlanOptions = {}): PlanStroke[] {
    return this.think(options, 0).next().value as PlanStroke[];
  }
  /** The same in slices, as `carom.think`. */
  think(options: PlanOptions = {}, slice = 1000): Generator<undefined, PlanStroke[]> {
    if (this.phase === "over") throw new RangeError("plan: the match is over");
    if (this.phase === "moving") throw new RangeError("plan: balls move: continue() the shot");
    const { ball, ...stick } = this.cue;
    const { rating } = this.seats[this.seat]!;
    const skill = rating > 0 ? { fargo: rating, rules: this.#rules.rules } : {};
    const player = options.player ?? this.#host.player(skill);
    const request: PlanOptions = {
      player,
      opponent: this.opponent(player),
      ...options,
      ...this.game,
      cue: { ...stick, ...options.cue, ...(this.strikable.length === 1 && { ball }) },
      inHand: this.phase === "place" ? this.hand : "no",
    };
    return this.#host.think(this.table, this.balls, request, slice, this.#number("leave"));
  }

  // ---- Memory

  get #host(): Host {
    return this.library;
  }
  get #pointer(): Pointer {
    return this.pointer(0);
  }
  #number(field: keyof typeof MATCH): number {
    const pointer = this.#pointer + MATCH[field];
    const isLong = (layout.carom_match.type as Record<string, string>)[field] === "i64";
    return isLong
      ? Number(this.#host.memory.i64[pointer / 8])
      : this.#host.memory.i32[pointer / 4]!;
  }
  #record(field: keyof typeof layout.carom_record.offset): Pointer {
    return this.#pointer + MATCH.record + layout.carom_record.offset[field];
  }
  get #rules(): Rules {
    const rules = names.carom_rules_kind[this.#recorded("rules")] ?? "eightball";
    return { rules, own: this.#customRules };
  }
  #record64(field: keyof typeof layout.carom_record.offset): bigint {
    return this.#host.memory.i64[this.#record(field) / 8]!;
  }
  #recorded(field: "count" | "rules"): number {
    return Number(this.#record64(field));
  }
  protected override seatOf(seat: number | undefined): number {
    return seat === undefined ? this.seat : whole(seat, "seat", values.CAROM_SEATS_MOST - 1);
  }
  /** Room for structs, all zero, while a function runs. */
  #using<const S extends readonly StructName[], T>(
    structs: S,
    run: (pointers: { [K in keyof S]: Pointer }) => T,
  ): T {
    const { memory } = this.#host;
    const pointers = structs.map((struct) => memory.allocate(layout[struct].size));
    try {
      return run(pointers as { [K in keyof S]: Pointer });
    } finally {
      for (const pointer of pointers) memory.free(pointer);
    }
  }
  #withText<T>(text: string, run: (pointer: Pointer, bytes: number) => T): T {
    const { memory } = this.#host;
    const bytes = new TextEncoder().encode(text);
    const pointer = memory.allocate(bytes.length);
    try {
      memory.u8.set(bytes, pointer);
      return run(pointer, bytes.length);
    } finally {
      memory.free(pointer);
    }
  }
  /** The lines of the last act. */
  get #written(): string[] {
    const text = this.#pointer + MATCH.text;
    const bytes = this.#host.memory.u8.slice(text, text + this.#number("size"));
    return new TextDecoder().decode(bytes).match(/.*\n/g) ?? [];
  }
  /** Calls a function of C. Returns whether a shot has ended. */
  protected override act(act: (pointer: Pointer, call: Exports) => number): boolean {
    const known = this.#written;
    const code = this.#called(act);
    this.#lines.push(...known);
    this.#undone.length = 0;
    return code === 0;
  }
  /** Returns the result of C. Errors of C or of custom rules are thrown, and change nothing. */
  #called(act: (pointer: Pointer, call: Exports) => number): number {
    const { memory } = this.#host;
    const pointer = this.#pointer;
    const previous = memory.u8.slice(pointer, pointer + layout.carom_match.size);
    try {
      const code = act(pointer, memory.exports);
      this.#host.checkOwn();
      if (code < 0) this.#refuse(code);
      return code;
    } catch (error) {
      memory.u8.set(previous, pointer);
      throw error;
    }
  }
  #refuse(code: number): void {
    const fault = this.#host.memory.text(this.#pointer + MATCH.fault)!;
    if (fault === "") return this.#host.refuse(code);
    const [act, ...right] = inJavaScript(fault).split(": ");
    throw new CaromError(code, this.#host.statusName(code), right.join(": "), act);
  }
}
