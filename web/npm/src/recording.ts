// Recordings that are played again: the calls of carom_record.h. docs/reference/files.md has the
// format.
import { CaromError } from "./error.js";
import { layout, values } from "./generated/layout.js";
import type { Memory, Pointer } from "./memory.js";
import type { Shot } from "./shot.js";
import { readBalls, readOptions, readStruct, readTable } from "./structs.js";
import type { BallState, Cue, ShotBall, ShotOptions, Table } from "./types.js";

const RECORD = layout.carom_record.offset;
const END = layout.carom_record_end.offset;
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
  /** Whether it continues the previous shot, which was stopped. */
  continues: boolean;
  table: Table;
  /** The layout at its start; for a continuation, at the start of the shot. */
  balls: ShotBall[];
  cue: Cue;
  /** The models, and when the shot was stopped. */
  options: ShotOptions;
  recorded: ShotEnd;
  played: ShotEnd;
  /** Whether every bit of its end agrees. */
  same: boolean;
  final: BallState[];
  /**
   * The played shot, with its events and its positions at any time; for a continuation, from the
   * start of the shot.
   */
  film: Shot;
}

const hex = (hash: bigint): string => BigInt.asUintN(64, hash).toString(16).padStart(16, "0");

/** The functions of the library that this file uses. */
export interface Host {
  readonly memory: Memory;
  statusName(code: number): string;
  played(
    table: Table,
    balls: readonly ShotBall[],
    code: number,
    shot: Pointer,
    final: Pointer,
    events: Pointer,
    more: { facts: Pointer; cue: Cue; options: ShotOptions },
  ): Shot;
  refuse(code: number, field?: string): void;
}

/** A carom_record in memory. */
class Game {
  readonly #host: Host;
  readonly pointer: Pointer;

  constructor(host: Host) {
    this.#host = host;
    this.pointer = host.memory.allocate(layout.carom_record.size);
  }

  number(offset: number): number {
    return Number(this.#host.memory.i64[(this.pointer + offset) / 8]);
  }

  end(offset: number): ShotEnd {
    return {
      status: this.#host.statusName(this.number(offset + END.status)),
      events: this.number(offset + END.events),
      time: this.#host.memory.f64[(this.pointer + offset + END.time) / 8]!,
      hash: hex(this.#host.memory.i64[(this.pointer + offset + END.hash) / 8]!),
    };
  }

  /** Throws the error of a line. */
  refuse(code: number): void {
    const line = `line ${this.number(RECORD.line)}`;
    if (code === values.CAROM_ERROR_RECORD)
      throw new CaromError(
        code,
        this.#host.statusName(code),
        this.#host.memory.text(this.pointer + RECORD.fault)!,
        line,
      );
    if (code === values.CAROM_ERROR_REVISION) {
      const revision = this.#host.memory.exports.carom_physics_revision();
      const text = `the recording is of revision ${this.number(RECORD.revision)} of the physics, not ${revision}: its shots have other bits here`;
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

  get cue(): Cue {
    return readStruct(this.#host.memory, this.pointer + RECORD.cue, "carom_cue");
  }
  get options(): ShotOptions {
    return readOptions(this.#host.memory, this.pointer + RECORD.options, "carom_shot_options");
  }

  /** The last shot that was played. */
  film: Shot | undefined;

  /**
   * Plays a shot with all of its events. If they need more memory, it is played again, with the
   * same bits.
   */
  play(kind: number): number {
    const { memory } = this.#host;
    if (this.#shot === 0) this.#shot = memory.allocate(SHOT.size);
    const backup = memory.u8.slice(this.pointer, this.pointer + layout.carom_record.size);
    for (;;) {
      memory.u8.fill(0, this.#shot, this.#shot + SHOT.size);
      memory.u32[(this.#shot + SHOT.offset.events) / 4] = this.#events;
      memory.i64[(this.#shot + SHOT.offset.room) / 8] = BigInt(this.#room);
      const code = memory.exports.carom_record_play(this.pointer, kind, this.#shot);
      const count = Number(memory.i64[(this.#shot + SHOT.offset.count) / 8]);
      if (count <= this.#room) {
        const table = readTable(memory, this.pointer + RECORD.table);
        const balls = readBalls(memory, this.pointer + RECORD.balls, this.number(RECORD.count));
        if (this.number(RECORD.pending) === values.CAROM_PENDING_LINE)
          this.film = this.#host.played(
            table,
            balls,
            code,
            this.#shot,
            this.pointer + RECORD.final,
            this.#events,
            { facts: this.pointer + RECORD.facts, cue: this.cue, options: this.options },
          );
        return code;
      }
      // The events of a shot that is continued are kept.
      const events = memory.allocate(2 * count * EVENT_SIZE);
      memory.u8.copyWithin(events, this.#events, this.#events + this.#room * EVENT_SIZE);
      memory.free(this.#events);
      [this.#events, this.#room] = [events, 2 * count];
      memory.u8.set(backup, this.pointer);
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
    // Blank lines count as lines, except at the end of a text.
    this.refuse(
      bytes.length === 0
        ? 0
        : memory.exports.carom_record_read(this.pointer, this.#line, bytes.length),
    );
    if (this.number(RECORD.pending) !== values.CAROM_PENDING_SHOT) return undefined;
    const kind = this.number(RECORD.kind);
    const code = this.play(kind);
    if (this.number(RECORD.pending) === values.CAROM_PENDING_SHOT)
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
      cue: this.cue,
      options: this.options,
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
    for (const pointer of [this.pointer, this.#shot, this.#events, this.#line])
      this.#host.memory.free(pointer);
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
