// Recordings of games that verify themselves: the calls of carom_record.h. docs/using/games.md has
// the format.
import { CaromError } from "./error.js";
import { layout, names, values } from "./generated/layout.js";
import type { Memory, Pointer } from "./memory.js";
import type { Shot } from "./shot.js";
import {
  readBalls,
  readStruct,
  readTable,
  writeBalls,
  writeStruct,
  writeTable,
} from "./structs.js";
import type {
  BallState,
  Cue,
  GameState,
  Ruling,
  ShotBall,
  ShotOptions,
  StopOptions,
  Table,
} from "./types.js";

const RECORD = layout.carom_record.offset;
const END = layout.carom_record_end.offset;
const OPTIONS = layout.carom_shot_options;
const SHOT = layout.carom_shot;
const EVENT_SIZE = layout.carom_event.size;

/** How a shot ended. */
export interface ShotEnd {
  status: string;
  /** Their number. */
  events: number;
  /** s */
  time: number;
  /** Of these and of all final states: 16 hexadecimal digits. */
  hash: string;
}

/** A shot of a recording that was played again. */
export interface Replayed {
  /** From 1. */
  shot: number;
  /** Of the recording, from 1. */
  line: number;
  /** Whether it goes on with the shot before, which was stopped. */
  continues: boolean;
  table: Table;
  /** The layout at its start; of one that continues, at the start of the shot. */
  balls: ShotBall[];
  cue: Cue;
  recorded: ShotEnd;
  played: ShotEnd;
  /** Whether every bit of its end agrees. */
  same: boolean;
  final: BallState[];
  /**
   * What was played, with its events and places at any time; of one that continues, from the start
   * of the shot.
   */
  film: Shot;
}

const hex = (hash: bigint): string => BigInt.asUintN(64, hash).toString(16).padStart(16, "0");

/** What the calls of this file need of the library. */
export interface Host {
  readonly memory: Memory;
  statusName(code: number): string;
  cue(fields: Partial<Cue>): Cue;
  writeShotOptions(options: ShotOptions): Pointer;
  played(
    table: Table,
    balls: readonly ShotBall[],
    code: number,
    shot: Pointer,
    final: Pointer,
    events: Pointer,
    facts: Pointer,
  ): Shot;
  readState(at: Pointer, rules: GameState["rules"]): GameState;
  writeState(game: Partial<GameState>, balls: readonly ShotBall[]): Pointer;
  refuse(code: number, field?: string): void;
}

/** A carom_record in memory, with room for a line. */
class Game {
  readonly #host: Host;
  readonly at: Pointer;
  readonly text: Pointer;

  constructor(host: Host) {
    this.#host = host;
    this.at = host.memory.allocate(layout.carom_record.size);
    this.text = host.memory.allocate(values.CAROM_RECORD_TEXT);
  }

  number(offset: number): number {
    return Number(this.#host.memory.i64[(this.at + offset) / 8]);
  }

  end(offset: number): ShotEnd {
    return {
      status: this.#host.statusName(this.number(offset + END.status)),
      events: this.number(offset + END.events),
      time: this.#host.memory.f64[(this.at + offset + END.time) / 8]!,
      hash: hex(this.#host.memory.i64[(this.at + offset + END.hash) / 8]!),
    };
  }

  /** Throws what is wrong with a line. */
  refuse(code: number): void {
    const line = `line ${this.number(RECORD.line)}`;
    if (code === values.CAROM_ERROR_RECORD)
      throw new CaromError(
        code,
        this.#host.statusName(code),
        this.#host.memory.text(this.at + RECORD.fault)!,
        line,
      );
    if (code === values.CAROM_ERROR_REVISION) {
      const own = this.#host.memory.exports.carom_physics_revision();
      const text = `the recording is of revision ${this.number(RECORD.revision)} of the physics, not ${own}: its shots have other bits here`;
      throw new CaromError(code, this.#host.statusName(code), text, line);
    }
  }

  /** A carom_shot, and memory for its events. */
  #shot: Pointer = 0;
  #events: Pointer = 0;
  #room = 0;
  /** Memory for a line. */
  #line: Pointer = 0;
  #lineRoom = 0;

  /** Whether the last line was the end. */
  get ended(): boolean {
    return this.number(RECORD.kind) === values.CAROM_RECORD_END;
  }

  /** The last shot that was played. */
  film: Shot | undefined;

  /**
   * Plays a shot with all of its events. Where they need more memory, it is played again: it has
   * the same bits.
   */
  play(kind: number): number {
    const { memory } = this.#host;
    if (this.#shot === 0) this.#shot = memory.allocate(SHOT.size);
    const before = memory.u8.slice(this.at, this.at + layout.carom_record.size);
    for (;;) {
      memory.u8.fill(0, this.#shot, this.#shot + SHOT.size);
      memory.u32[(this.#shot + SHOT.offset.events) / 4] = this.#events;
      memory.i64[(this.#shot + SHOT.offset.room) / 8] = BigInt(this.#room);
      const code = memory.exports.carom_record_play(this.at, kind, this.#shot);
      const count = Number(memory.i64[(this.#shot + SHOT.offset.count) / 8]);
      if (count <= this.#room) {
        const table = readTable(memory, this.at + RECORD.table);
        const balls = readBalls(memory, this.at + RECORD.balls, this.number(RECORD.count));
        if (this.number(RECORD.pending) === 2)
          this.film = this.#host.played(
            table,
            balls,
            code,
            this.#shot,
            this.at + RECORD.final,
            this.#events,
            this.at + RECORD.facts,
          );
        return code;
      }
      // Those of a shot that goes on stay.
      const events = memory.allocate(2 * count * EVENT_SIZE);
      memory.u8.copyWithin(events, this.#events, this.#events + this.#room * EVENT_SIZE);
      memory.free(this.#events);
      [this.#events, this.#room] = [events, 2 * count];
      memory.u8.set(before, this.at);
    }
  }

  /** Reads a line, and plays its shot if it has one. */
  read(line: string): Replayed | undefined {
    const { memory } = this.#host;
    const bytes = new TextEncoder().encode(line);
    if (bytes.length > this.#lineRoom) {
      memory.free(this.#line);
      this.#line = memory.allocate((this.#lineRoom = 2 * bytes.length));
    }
    memory.u8.set(bytes, this.#line);
    // Blank lines are lines too, but for the end of a text.
    this.refuse(
      bytes.length === 0 ? 0 : memory.exports.carom_record_read(this.at, this.#line, bytes.length),
    );
    if (this.number(RECORD.pending) !== 1) return undefined;
    const kind = this.number(RECORD.kind);
    const code = this.play(kind);
    if (this.number(RECORD.pending) === 1)
      this.#host.refuse(code, `line ${this.number(RECORD.line)}`);
    const recorded = this.end(RECORD.recorded);
    const played = this.end(RECORD.played);
    const film = this.film!;
    return {
      shot: this.number(RECORD.shots),
      line: this.number(RECORD.line),
      continues: kind === values.CAROM_RECORD_CONTINUE,
      table: film.table,
      balls: [...film.balls],
      cue: readStruct<Cue>(memory, this.at + RECORD.cue, "carom_cue"),
      recorded,
      played,
      same: (Object.keys(played) as (keyof ShotEnd)[]).every((key) =>
        Object.is(played[key], recorded[key]),
      ),
      final: [...film.final],
      film,
    };
  }

  free(): void {
    for (const at of [this.at, this.text, this.#shot, this.#events, this.#line])
      this.#host.memory.free(at);
  }
}

/** A game on its way, played, written and read: `carom.record(table, balls)`. */
export class Recording {
  /** The text so far, a line each, with its end of line. */
  readonly lines: string[] = [];
  readonly #host: Host;
  readonly #game: Game;

  /** @internal */
  constructor(host: Host) {
    this.#host = host;
    this.#game = new Game(host);
  }

  /** @internal */
  begin(table: Table, balls: readonly ShotBall[], options: ShotOptions): void {
    const host = this.#host;
    writeTable(host.memory, this.#game.at + RECORD.table, table);
    const given = host.writeShotOptions(options);
    host.memory.u8.copyWithin(this.#game.at + RECORD.options, given, given + OPTIONS.size);
    this.#until({});
    this.#write(values.CAROM_RECORD_HEAD);
    this.#write(values.CAROM_RECORD_TABLE);
    this.#write(values.CAROM_RECORD_OPTIONS);
    this.setBalls(balls);
  }

  /**
   * Reads a line that another program wrote, and plays its shot if it has one: `same` tells whether
   * every bit agrees. Throws a CaromError where the
   * line is wrong.
   */
  read(line: string): Replayed | undefined {
    const shot = this.#game.read(line);
    this.lines.push(`${line.trimEnd()}\n`);
    return shot;
  }

  get table(): Table {
    return readTable(this.#host.memory, this.#game.at + RECORD.table);
  }

  /** Whether the last line was the end. */
  get ended(): boolean {
    return this.#game.ended;
  }

  /** Of all lines so far: 16 hexadecimal digits. */
  get hash(): string {
    return hex(this.#host.memory.i64[(this.#game.at + RECORD.hash) / 8]!);
  }

  /** The layout after the last shot. */
  get balls(): ShotBall[] {
    this.#host.memory.exports.carom_record_settle(this.#game.at);
    return readBalls(
      this.#host.memory,
      this.#game.at + RECORD.balls,
      this.#game.number(RECORD.count),
    );
  }

  /** Another layout, which is recorded. */
  setBalls(balls: readonly ShotBall[]): void {
    if (balls.length < 1 || balls.length > values.CAROM_BALLS_MOST)
      throw new RangeError(
        `balls: 1 to ${values.CAROM_BALLS_MOST} are needed, not ${balls.length}`,
      );
    this.#host.memory.exports.carom_record_settle(this.#game.at);
    writeBalls(this.#host.memory, this.#game.at + RECORD.balls, balls);
    this.#host.memory.i64[(this.#game.at + RECORD.count) / 8] = BigInt(balls.length);
    this.#write(values.CAROM_RECORD_BALLS);
  }

  /** Ball in hand, at x, y (m). A place that is not free is refused, and nothing is recorded. */
  place(ball: number, x: number, y: number): void {
    this.#host.refuse(
      this.#host.memory.exports.carom_record_place(this.#game.at, ball, x, y, 0),
      `ball ${ball} at ${x}, ${y}`,
    );
    this.#write(values.CAROM_RECORD_PLACE);
  }

  /** A ball comes in hand, and is out of play until it is placed. */
  hand(ball: number): void {
    this.#host.refuse(
      this.#host.memory.exports.carom_record_hand(this.#game.at, ball),
      `ball ${ball}`,
    );
    this.#write(values.CAROM_RECORD_PLACE);
  }

  /** The layout of the next stroke as a ruling has it, and the cue ball in hand. */
  settle({ balls, put, hand }: Ruling, cueBall = 0): void {
    if (put.length > 0) this.setBalls(balls);
    if (hand !== "no") this.hand(cueBall);
  }

  /** How a game stands for the player at the table, 0 or 1, which is recorded. */
  stand(game: GameState, player = 0): void {
    const { memory } = this.#host;
    const from = this.#host.writeState(game, this.balls);
    memory.u8.copyWithin(
      this.#game.at + RECORD.standing,
      from,
      from + layout.carom_rules_state.size,
    );
    memory.i64[(this.#game.at + RECORD.rules) / 8] = BigInt(
      names.carom_rules_kind.indexOf(game.rules),
    );
    memory.i64[(this.#game.at + RECORD.player) / 8] = BigInt(player);
    this.#write(values.CAROM_RECORD_GAME);
  }

  /** What \`stand\` recorded last, or was read. */
  get standing(): { game: GameState; player: number } {
    const rules = names.carom_rules_kind[this.#game.number(RECORD.rules)] as GameState["rules"];
    return {
      game: this.#host.readState(this.#game.at + RECORD.standing, rules),
      player: this.#game.number(RECORD.player),
    };
  }

  /** Whether the cue ball is in hand, and not placed yet. */
  get inHand(): boolean {
    return this.#game.number(RECORD.hand) === 1;
  }

  /**
   * The last shot that was played or read, with its events; of one that went on, from its start.
   */
  get last(): Shot | undefined {
    return this.#game.film;
  }

  /** Plays a stroke, up to where the options stop it, and records it. */
  shoot(cue: Partial<Cue>, options: StopOptions = {}): ShotEnd {
    writeStruct(
      this.#host.memory,
      this.#game.at + RECORD.cue,
      "carom_cue",
      this.#host.cue(cue),
      "cue",
    );
    this.#until(options);
    return this.#play(values.CAROM_RECORD_SHOT);
  }

  /** Goes on with the shot that was stopped, and records it. */
  continue(options: StopOptions = {}): ShotEnd {
    this.#until(options);
    return this.#play(values.CAROM_RECORD_CONTINUE);
  }

  /** The whole text, with its last line. Nothing follows, and its memory is given back. */
  end(): string {
    this.#write(values.CAROM_RECORD_END);
    this.#game.free();
    return this.lines.join("");
  }

  #until(options: StopOptions): void {
    const { memory } = this.#host;
    const at = this.#game.at + RECORD.options;
    const { timeMost, stopAt, eventsMost } = OPTIONS.offset;
    const given = this.#host.writeShotOptions(options);
    for (const offset of [timeMost, stopAt])
      memory.i64[(at + offset) / 8] = memory.i64[(given + offset) / 8]!;
    memory.i32[(at + eventsMost) / 4] = memory.i32[(given + eventsMost) / 4]!;
  }

  #play(kind: number): ShotEnd {
    const { memory } = this.#host;
    memory.i64[(this.#game.at + RECORD.pending) / 8] = 0n;
    const code = this.#game.play(kind);
    this.#game.refuse(code);
    if (this.#game.number(RECORD.pending) === 0) this.#host.refuse(code); // Nothing was played.
    this.#write(kind);
    return this.#game.end(RECORD.played);
  }

  #write(kind: number): void {
    const { memory } = this.#host;
    if (
      memory.exports.carom_record_write(
        this.#game.at,
        kind,
        this.#game.text,
        values.CAROM_RECORD_TEXT,
      ) === 0
    )
      throw new RangeError("the recording has ended, or a number in it is not finite");
    this.lines.push(memory.text(this.#game.text)!);
  }
}

/** The shots of a recording, played again. */
export function* replayed(
  host: Host,
  recording: string | Iterable<string>,
): Generator<Replayed, void> {
  const game = new Game(host);
  try {
    for (const line of typeof recording === "string" ? recording.split("\n") : recording) {
      const shot = game.read(line);
      if (shot) yield shot;
    }
    if (!game.ended) {
      const code = values.CAROM_ERROR_RECORD;
      throw new CaromError(
        code,
        host.statusName(code),
        'cut off: there is no line {"end": ...}',
        `line ${game.number(RECORD.line)}`,
      );
    }
  } finally {
    game.free();
  }
}
