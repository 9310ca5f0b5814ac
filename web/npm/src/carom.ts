// The library: every call of C that the package offers.
import { Advice, type Host as AdviceHost } from "./advice.js";
import { Collisions, type Library, Shots, indexed } from "./batches.js";
import { CaromError } from "./error.js";
import { layout, names, values } from "./generated/layout.js";
import type * as C from "./generated/structs.js";
import { KEYS, refuseUnknown, stopsOf } from "./keys.js";
import { type Host as MatchHost, Match } from "./match.js";
import type { Build, Memory, Pointer } from "./memory.js";
import { Plans, resultOf } from "./plans.js";
import { type Replayed, replayed } from "./recording.js";
import { type Host as SavedHost, isMatch, recordingOf, shotsOf } from "./saved.js";
import { type Kept, type Reader, Shot } from "./shot.js";
import {
  readBalls,
  readEvent,
  readMotion,
  readOptions,
  readState,
  readStruct,
  readSynonymsOf,
  readTable,
  refuseUnknownOf,
  setStruct,
  value,
  vec3,
  whole,
  writeBalls,
  writeOptions,
  writeStates,
  writeStruct,
  writeTable,
} from "./structs.js";
import type {
  Aim,
  AimOf,
  BallKind,
  BallState,
  Bank,
  BreakChoice,
  BreakOptions,
  Breaks,
  BreaksOptions,
  Calibration,
  Call,
  PlanStroke,
  Collided,
  CollideOptions,
  Condition,
  Contact,
  Cue,
  CushionImpact,
  CushionOptions,
  CutOf,
  Detail,
  Frame,
  Game,
  Hit,
} from "./types.js";
import type {
  GameState,
  OwnGame,
  Impact,
  MatchOptions,
  Measures,
  Motion,
  PlanOptions,
  Sequence,
  SequenceOptions,
  Player,
  Practice,
  PracticeOptions,
  RackName,
  RackOptions,
  Odds,
  Rating,
  Review,
  Ruling,
  Score,
  Series,
  ShotBall,
  ShotOptions,
  Skill,
  StopOptions,
  Table,
  TableName,
  TracePoint,
  Vec2,
  Ways,
  WaysOptions,
  Why,
} from "./types.js";

/** The number of events of a slice. */
function sliceOf(slice: number): number {
  if (whole(slice, "slice") < 1) throw new RangeError("slice: at least 1 event is needed, not 0");
  return slice;
}

const IMPACT = layout.carom_impact;
const RESULT = layout.carom_result;
const POINT = layout.carom_trace_point;
const OPTIONS = layout.carom_options;
const CUSHION = layout.carom_cushion_impact;
const CUSHION_OPTIONS = layout.carom_cushion_options;
const SHOT = layout.carom_shot;
const SHOT_OPTIONS = layout.carom_shot_options;
const EVENT = layout.carom_event;
const STATE = layout.carom_ball_state;
const MEASURES = Object.keys(layout.carom_measures.offset) as (keyof Measures)[];
const FAULT = layout.carom_fault;
const BALLS_MOST = values.CAROM_BALLS_MOST;

const STICK = ["never", "in compression", "in restitution"] as const;
const BALL = {
  r: [0, 0, 0],
  v: [0, 0, 0],
  w: [0, 0, 0],
  radius: 0.028575,
  mass: 0.17,
  muSlide: 0.2,
} as const;

/** The errors with which continue() rejects arguments, with nothing played. */
const REFUSED: readonly number[] = [
  values.CAROM_ERROR_STATE,
  values.CAROM_ERROR_STATE_TABLE,
  values.CAROM_ERROR_STATE_BALLS,
  values.CAROM_ERROR_STATE_OPTIONS,
  values.CAROM_ERROR_TIME_MOST,
  values.CAROM_ERROR_STOP_AT,
  values.CAROM_ERROR_EVENTS_MOST,
];

/** Consecutive blocks of memory that every call reuses. */
function arena(memory: Memory): (bytes: number) => Pointer {
  let next = memory.allocate(65536);
  const end = next + 65536;
  return (bytes) => {
    const pointer = next;
    next += (bytes + 15) & ~15;
    if (next > end) throw new RangeError("carom: the memory for arguments is too small");
    return pointer;
  };
}

/**
 * The library carom, loaded. Calls may be made from any thread that has loaded it; each thread has
 * its own memory.
 */
export class Carom {
  /** The build that runs. */
  readonly build: Build;
  readonly #memory: Memory;
  readonly #library: Library;
  readonly #reader: Reader;
  readonly #plans: Plans;
  readonly #advice: Advice;
  readonly #recordings: MatchHost;
  readonly #addresses: Record<
    | "impact"
    | "options"
    | "result"
    | "detail"
    | "table"
    | "balls"
    | "cue"
    | "shot"
    | "final"
    | "state"
    | "motion"
    | "number"
    | "fault"
    | "text"
    | "frame"
    | "facts",
    Pointer
  >;
  #points: Pointer = 0;
  #pointRoom = 0;
  #events: Pointer = 0;
  #room = 0;
  /** The shot whose balls and events are in the module's memory. */
  #resident: Shot | undefined;
  #frame: Frame = {
    states: new Float64Array(),
    turned: new Float64Array(),
    label: () => "stationary",
  };

  /** @internal */
  constructor(memory: Memory, build: Build) {
    this.build = build;
    this.#memory = memory;
    readSynonymsOf(memory);
    const part = arena(memory);
    this.#addresses = {
      impact: part(Math.max(IMPACT.size, CUSHION.size)),
      options: part(Math.max(OPTIONS.size, CUSHION_OPTIONS.size, SHOT_OPTIONS.size)),
      result: part(RESULT.size),
      // also a kind of ball, a cue, a bank
      detail: part(
        Math.max(layout.carom_detail.size, layout.carom_ball_kind.size, layout.carom_cue.size),
      ),
      table: part(layout.carom_table.size),
      balls: part(BALLS_MOST * layout.carom_shot_ball.size),
      cue: part(layout.carom_cue.size),
      shot: part(SHOT.size),
      final: part(BALLS_MOST * STATE.size),
      facts: part(layout.carom_facts.size),
      state: memory.allocate(layout.carom_shot_state.size),
      motion: part(layout.carom_motion.size),
      // states, turns, and how far the film is
      frame: memory.allocate(BALLS_MOST * (STATE.size + 32) + layout.carom_frames.size),
      number: part(64),
      fault: part(FAULT.size),
      text: part(128),
    };
    this.#library = {
      memory,
      statusName: (code) => this.statusName(code),
      writeImpact: (pointer, impact) => this.#writeImpact(pointer, impact),
      shotOf: (shots, k) => this.#shotOf(shots, k),
      save: (shots) => this.#saved(shots),
    };
    this.#reader = this.#readerOf();
    const host: AdviceHost = {
      memory,
      addresses: this.#addresses,
      cue: (fields) => this.#cue(fields),
      writeLayout: (table, balls) => this.#writeLayout(table, balls),
      writeShotOptions: (options) => this.#writeShotOptions(options),
      writeShot: () => this.#writeShot(0),
      refuse: (code, field) => this.#refuse(code, field),
      refuseShot: (code, balls, options, field) => this.#refuseShot(code, balls, options, field),
      match: () => this.match(),
    };
    this.#plans = new Plans(host);
    this.#advice = new Advice(host, this.#plans);
    this.#recordings = {
      memory,
      statusName: (code) => this.statusName(code),
      cue: (fields) => this.cue(fields),
      writeShotOptions: (options) => this.#writeShotOptions(options),
      played: (...rest) => this.#played(...rest),
      readState: (...rest) => this.#plans.readState(...rest),
      checkOwn: () => this.#plans.customRules.check(),
      writeState: (...rest) => this.#plans.writeState(...rest),
      readRuling: (...rest) => this.#plans.readRuling(...rest),
      think: (table, balls, options, slice, leave) =>
        this.#plans.think(table, balls, undefined, options, slice, leave),
      film: (match, table, balls, cue) => this.#replay(match, table, balls, cue),
      player: (of) => this.#plans.player(of),
      refuse: (code, field) => this.#refuse(code, field),
    };
  }

  /** What shots read of the module's memory. */
  #readerOf(): Reader {
    return {
      events: (shot) => {
        this.#reside(shot);
        return Array.from({ length: shot.count }, (_, k) => {
          const event = this.#events + k * EVENT.size;
          return {
            ...readEvent(this.#memory, event),
            slip: this.#call.carom_event_slip(
              this.#addresses.table,
              this.#addresses.balls,
              shot.balls.length,
              event,
            ),
          };
        });
      },
      states: (shot, time, drawn) => {
        this.#look(shot, time, drawn);
        return shot.balls.map((_, k) =>
          readState(this.#memory, this.#addresses.final + k * STATE.size),
        );
      },
      positions: (shot, time, into) => {
        this.#look(shot, time);
        const f64 = this.#memory.f64;
        for (let k = 0; k < shot.balls.length; k++) {
          const pointer = (this.#addresses.final + k * STATE.size) / 8;
          for (let c = 0; c < 3; c++) into[3 * k + c] = f64[pointer + c]!;
        }
      },
      positionsAt: (shot, times, drawn) => {
        this.#reside(shot);
        const n = times.length;
        const count = shot.balls.length;
        const size = STATE.size;
        const pointer = this.#memory.allocate(8 * n + n * count * size);
        try {
          this.#memory.f64.set(times, pointer / 8);
          const states = pointer + 8 * n;
          this.#statesAt(shot, pointer, n, states, drawn, "times");
          const f64 = this.#memory.f64;
          const into = new Float64Array(3 * n * count);
          for (let k = 0; k < n * count; k++)
            into.set(f64.subarray((states + k * size) / 8, (states + k * size) / 8 + 3), 3 * k);
          return into;
        } finally {
          this.#memory.free(pointer);
        }
      },
      frame: (shot, time) => {
        this.#reside(shot);
        const count = shot.balls.length;
        const { table, balls, shot: pointer, number, frame: states } = this.#addresses;
        const turned = states + BALLS_MOST * STATE.size;
        this.#memory.f64[number / 8] = time;
        this.#refuse(
          this.#call.carom_shot_frames(
            balls,
            count,
            pointer,
            number,
            1,
            turned + BALLS_MOST * 32,
            states,
            turned,
          ),
          `time ${time}`,
        );
        this.#refuse(this.#call.carom_shot_falls(table, balls, count, pointer, number, 1, states));
        const { f64, i32 } = this.#memory;
        if (this.#frame.states.buffer !== f64.buffer || this.#frame.turned.length !== 4 * count)
          this.#frame = {
            states: f64.subarray(states / 8, (states + count * STATE.size) / 8),
            turned: f64.subarray(turned / 8, turned / 8 + 4 * count),
            label: (ball) =>
              names.carom_label[i32[(states + ball * STATE.size + STATE.offset.label) / 4]!]!,
          };
        return this.#frame;
      },
      save: (shot) => recordingOf(this.#savedBy, [shot], ["shot"]),
    };
  }

  get #call(): Memory["exports"] {
    return this.#memory.exports;
  }

  // ---- Texts and errors -------------------------------------------------------------------------

  /** The version of the library, such as "0.3.0". */
  get version(): string {
    return this.#memory.text(this.#call.carom_version())!;
  }

  /**
   * A number that changes whenever the bits of a result change: replays and lockstep need equal
   * numbers.
   */
  get physicsRevision(): number {
    return this.#call.carom_physics_revision();
  }

  /** Bytes of WebAssembly memory in use by the library. */
  get memoryBytes(): number {
    return this.#memory.buffer.byteLength;
  }

  /** The short name of a status: "ok", "separating", "bad_radius". */
  statusName(code: number): string {
    return this.#memory.text(this.#call.carom_status_name(code))!;
  }

  #error(
    code: number,
    field?: string,
    shot?: Shot,
    text = this.#memory.text(this.#call.carom_status_string(code))!,
  ): CaromError {
    // The text of a field's own status begins with the field, by its name in C: "cue.end_mass must
    // be positive and finite".
    const [, object, name, must] =
      (field === undefined && /^(cue\.|options\.)(\w+) (must .*)/.exec(text)) || [];
    if (name === undefined) return new CaromError(code, this.statusName(code), text, field, shot);
    const key = name.replace(/_(.)/g, (_, letter: string) => letter.toUpperCase());
    return new CaromError(
      code,
      this.statusName(code),
      `it ${must}`,
      object === "cue." ? object + key : key,
      shot,
    );
  }

  #refuse(code: number, field?: string): void {
    if (code < 0) throw this.#error(code, field);
  }

  // ---- Two balls --------------------------------------------------------------------------------

  #writeImpact(pointer: Pointer, impact: Impact): void {
    const { a, b } = IMPACT.offset;
    refuseUnknown(impact, KEYS.impact, "impact");
    writeStruct(this.#memory, pointer + a, "carom_ball", impact.a, "a", BALL);
    writeStruct(this.#memory, pointer + b, "carom_ball", impact.b, "b", BALL);
    this.#memory.f64[(pointer + IMPACT.offset.restitution) / 8] = impact.restitution ?? 0.95;
    this.#memory.f64[(pointer + IMPACT.offset.muBall) / 8] =
      impact.muBall ?? this.#alciatore(pointer);
  }

  #alciatore(impact: Pointer): number {
    this.#call.carom_alciatore(this.#addresses.number);
    return this.#call.carom_mu_ball(impact, this.#addresses.number);
  }

  #writeOptions(options: CollideOptions): Pointer {
    refuseUnknown(options, KEYS.collide);
    return writeOptions(this.#memory, this.#addresses.options, "carom_options", options);
  }

  /** The error that carom_check() reports for the impact that a call rejected. */
  #impactError(code: number, options: Pointer): CaromError {
    const { impact, number } = this.#addresses;
    this.#call.carom_check(impact, options, number);
    const field = this.#memory.text(this.#call.carom_field_name(this.#memory.i32[number / 4]!));
    return this.#error(code, field);
  }

  #collided(code: number): Collided {
    const f64 = this.#memory.f64;
    const { result } = this.#addresses;
    return {
      status: this.statusName(code),
      a: readMotion(f64, result + RESULT.offset.a),
      b: readMotion(f64, result + RESULT.offset.b),
    };
  }

  /** Calls a function with an impact and options in the module's memory. Throws its errors. */
  #resolve(
    impact: Impact,
    options: CollideOptions,
    call: (impact: Pointer, options: Pointer) => number,
  ): number {
    const { impact: pointer } = this.#addresses;
    this.#writeImpact(pointer, impact);
    const opt = this.#writeOptions(options);
    const code = call(pointer, opt);
    if (code < 0) throw this.#impactError(code, opt);
    return code;
  }

  /**
   * Resolves one collision of two balls. Throws a CaromError that names the field that is out of
   * range.
   */
  collide(impact: Impact, options: CollideOptions = {}): Collided {
    const { result } = this.#addresses;
    return this.#collided(
      this.#resolve(impact, options, (...both) => this.#call.carom_collide(...both, result)),
    );
  }

  /** The same, with impulses, works, and when the balls stuck. */
  collideDetail(impact: Impact, options: CollideOptions = {}): Collided & { detail: Detail } {
    const { result, detail } = this.#addresses;
    const code = this.#resolve(impact, options, (...both) =>
      this.#call.carom_collide_detail(...both, result, detail),
    );
    const fields = readStruct<Omit<C.Detail, "stick"> & { stick: number }>(
      this.#memory,
      detail,
      "carom_detail",
    );
    return { ...this.#collided(code), detail: { ...fields, stick: STICK[fields.stick]! } };
  }

  /**
   * Follows one collision through n >= 2 points at equal steps of normal impulse. It takes about a
   * millisecond.
   */
  trace(impact: Impact, n: number, options: CollideOptions = {}): TracePoint[] {
    if (whole(n, "n") < 2) throw new RangeError(`n: at least 2 points are needed, not ${n}`);
    if (n > this.#pointRoom) {
      if (this.#points !== 0) this.#memory.free(this.#points);
      this.#points = this.#memory.allocate(n * POINT.size);
      this.#pointRoom = n;
    }
    this.#resolve(impact, options, (...both) => this.#call.carom_trace(...both, n, this.#points));
    return Array.from({ length: n }, (_, k) => {
      const { dX, dY, bX, bY, sticks, ...point } = readStruct<
        Omit<C.TracePoint, "phase"> & { phase: number }
      >(this.#memory, this.#points + k * POINT.size, "carom_trace_point");
      return { ...point, sticks: sticks === 1, d: [dX, dY], b: [bX, bY] };
    });
  }

  /**
   * Friction between pool balls with the slip of the impact, by Alciatore's law.
   */
  muBall(impact: Impact): number {
    this.#writeImpact(this.#addresses.impact, { ...impact, muBall: 0 });
    return this.#alciatore(this.#addresses.impact);
  }

  /** The velocity, m/s, at which a ball begins to roll after sliding. */
  rollingVelocity(motion: Motion, radius: number): [number, number, number] {
    const { motion: pointer } = this.#addresses;
    refuseUnknown(motion, KEYS.motion, "motion");
    const { v, w } = motion;
    writeStruct(this.#memory, pointer, "carom_motion", { v, w }, "motion");
    this.#call.carom_rolling_velocity(
      pointer,
      pointer + layout.carom_motion.offset.w,
      radius,
      pointer,
    );
    return [...vec3(this.#memory.f64, pointer)];
  }

  /** Memory for n collisions. */
  collisions(n: number): Collisions {
    return new Collisions(this.#library, n);
  }

  /**
   * Resolves all collisions of a batch, each with the bits of `collide`. A bad row gets NaN and its
   * status, and does not change the others. Returns "ok", or the name of the first error.
   */
  collideBatch(batch: Collisions, options: CollideOptions = {}): string {
    const opt = this.#writeOptions(options);
    return this.statusName(
      this.#call.carom_collide_batch(
        batch.pointer(0),
        batch.n,
        opt,
        batch.pointer(1),
        batch.pointer(2),
      ),
    );
  }

  // ---- A ball and a cushion ---------------------------------------------------------------------

  /** Defaults of an impact: the ball and the cushion of pool for a model. */
  #rail(model: CushionOptions["model"] = "mathavan"): object {
    const kind = this.kind("pool", model);
    return {
      w: [0, 0, 0],
      height: kind.noseHeight || 0.03629025,
      radius: kind.radius,
      mass: kind.mass,
      muSlide: kind.muSlide,
      muCushion: kind.muCushion,
      restitution: kind.restitutionCushion,
      jawRadius: 0,
    };
  }

  /** Resolves one impact of a ball on a cushion. */
  cushion(impact: CushionImpact, options: CushionOptions = {}): Motion & { status: string } {
    const { impact: pointer, options: opt, motion, number } = this.#addresses;
    refuseUnknown(options, KEYS.cushion);
    writeOptions(this.#memory, opt, "carom_cushion_options", options);
    const rail = this.#rail(options.model);
    writeStruct(this.#memory, pointer, "carom_cushion_impact", impact, "impact", rail);
    const code = this.#call.carom_cushion(pointer, opt, motion);
    if (code < 0) {
      this.#call.carom_cushion_check(pointer, opt, number);
      throw this.#error(
        code,
        this.#memory.text(this.#call.carom_cushion_field_name(this.#memory.i32[number / 4]!)),
      );
    }
    return { status: this.statusName(code), ...readMotion(this.#memory.f64, motion) };
  }

  // ---- Tables, racks, balls, cues ---------------------------------------------------------------

  /**
   * A built-in table, optionally with some other measures, m and degrees: table("9ft", {
   * cornerMouth: 0.108 }).
   */
  table(name: TableName, measures: Partial<Measures> = {}): Table {
    const { table, balls, detail } = this.#addresses;
    const kind = value("carom_table_kind", name, "table");
    this.#refuse(this.#call.carom_table_make(kind, table), "table");
    this.#resident = undefined;
    if (Object.keys(measures).length > 0) {
      this.#call.carom_table_measures(kind, balls);
      const usual = Object.fromEntries(
        MEASURES.map((key, k) => [key, this.#memory.f64[balls / 8 + k]!]),
      );
      writeStruct(this.#memory, balls, "carom_measures", measures, "measures", usual);
      const code = this.#call.carom_table_measured(
        balls,
        name === "snooker" ? 0.02625 : 0.028575,
        table,
        detail,
      );
      this.#refuseTable(code);
    }
    return readTable(this.#memory, table);
  }

  /**
   * A table of any closed shape, from its corners in the order of a walk around it: x, y, and the
   * width of a pocket's mouth there (none: 0), m.
   * A corner on a straight side makes a side pocket. Throws a CaromError that says which part is
   * wrong.
   */
  polygon(
    corners: { x: number; y: number; mouth?: number }[],
    options: { noseHeight?: number; jawRadius?: number; ballRadius?: number } = {},
  ): Table {
    refuseUnknown(options, KEYS.polygon);
    if (corners.length > values.CAROM_RAILS_MOST)
      throw new RangeError(
        `corners: at most ${values.CAROM_RAILS_MOST} are allowed, not ${corners.length}`,
      );
    const { noseHeight = 0.0366, jawRadius = 0.01, ballRadius = 0.028575 } = options;
    const { table, balls, detail } = this.#addresses;
    corners.forEach((corner, k) => {
      refuseUnknown(corner, KEYS.corner, `corners[${k}]`);
      this.#memory.f64.set([corner.x, corner.y, corner.mouth ?? 0], balls / 8 + 3 * k);
    });
    this.#resident = undefined;
    const code = this.#call.carom_table_polygon(
      balls,
      corners.length,
      noseHeight,
      jawRadius,
      ballRadius,
      table,
      detail,
    );
    if (code < 0)
      throw this.#error(code, this.#part(detail + layout.carom_table_fault.offset.part));
    return readTable(this.#memory, table);
  }

  /**
   * Checks a custom table for balls of a radius (m): that each part is in range, and that no ball
   * can leave it. Throws a CaromError that names the invalid part.
   */
  checkTable(table: Table, radius = 0.028575): void {
    writeTable(this.#memory, this.#addresses.table, table);
    const code = this.#call.carom_table_check(
      this.#addresses.table,
      radius,
      this.#addresses.detail,
    );
    this.#refuseTable(code);
  }
  #refuseTable(code: number): void {
    const { part } = layout.carom_table_fault.offset;
    if (code < 0) throw this.#error(code, this.#part(this.#addresses.detail + part));
  }

  /** The name of a carom_part. */
  #part(pointer: Pointer): string {
    const kind = this.#memory.i32[(pointer + layout.carom_part.offset.kind) / 4]!;
    const index = this.#memory.i32[(pointer + layout.carom_part.offset.index) / 4]!;
    const name = names.carom_part_kind[kind]!;
    if (name === "ball" || name === "state") return `balls[${index}]`;
    if (name === "measures") return `measures.${MEASURES[index]}`;
    if (name === "cue") return "cue";
    if (name === "options") return "";
    if (name === "none" || name === "table") return "table";
    return `table.${name}s[${index}]`;
  }

  /**
   * The balls of a rack; the cue ball is the first. Neighbours are `gap` apart, m (default 1e-4; 0
   * is a frozen rack). `seed` draws their displacements within the gap, and `cueBall` is where the
   * cue ball lies. Lists of gaps, seeds or positions result in a list of racks.
   */
  rack(
    name: RackName,
    table: Table,
    options?: { gap?: number; seed?: number | bigint; cueBall?: Vec2 },
  ): ShotBall[];
  rack(name: RackName, table: Table, options: RackOptions): ShotBall[] | ShotBall[][];
  rack(name: RackName, table: Table, options: RackOptions = {}): ShotBall[] | ShotBall[][] {
    refuseUnknown(options, KEYS.rack);
    const { gap = 1e-4, seed = 1, cueBall } = options;
    const isList = (option: unknown): option is readonly unknown[] => Array.isArray(option);
    const arePlaces = isList(cueBall) && isList(cueBall[0] ?? []);
    const lists = Object.entries({ gap, seed, cueBall: arePlaces ? cueBall : undefined }).flatMap(
      ([key, option]) => (isList(option) ? [{ key, length: option.length }] : []),
    );
    const [first, ...others] = lists;
    const unlike = others.find(({ length }) => length !== first!.length);
    if (unlike)
      throw new RangeError(
        `${unlike.key}: its list has ${unlike.length} elements, and that of ${first!.key} ${first!.length}; they must have equally many`,
      );
    const racks = Array.from({ length: first?.length ?? 1 }, (_, k) =>
      this.#rack(
        name,
        table,
        isList(gap) ? (gap[k] as number) : gap,
        isList(seed) ? (seed[k] as number | bigint) : seed,
        (arePlaces ? cueBall[k] : cueBall) as Vec2 | undefined,
      ),
    );
    return first === undefined ? racks[0]! : racks;
  }

  #rack(
    name: RackName,
    table: Table,
    gap: number,
    seed: number | bigint,
    cueBall: Vec2 | undefined,
  ): ShotBall[] {
    const kind = value("carom_rack_kind", name, "rack");
    this.#resident = undefined;
    writeTable(this.#memory, this.#addresses.table, table);
    const { table: tablePointer, balls } = this.#addresses;
    const isWhole = typeof seed === "bigint" || (Number.isSafeInteger(seed) && seed >= 0);
    if (!isWhole) throw new RangeError(`seed: it must be a whole number, 0 or more, not ${seed}`);
    this.#refuse(
      this.#call.carom_rack(kind, tablePointer, gap, BigInt(seed), balls, BALLS_MOST),
      `rack "${name}", gap ${gap}`,
    );
    const rack = readBalls(this.#memory, balls, this.#call.carom_rack_size(kind));
    if (cueBall === undefined) return rack;
    if (cueBall.length !== 2)
      throw new TypeError(`cueBall: it must be [x, y] in m, not ${JSON.stringify(cueBall)}`);
    return this.placeBall(table, rack, 0, ...cueBall);
  }

  /**
   * The constants of a game's balls for a model of the cushion, under conditions of a pool table,
   * such as "fast_cloth". Throws a RangeError if the game has no constants for the model, or if
   * conditions are given for a game that is not played on pool tables.
   */
  kind(
    game: Game,
    cushion: ShotOptions["cushionModel"] = "default",
    conditions: readonly Condition[] = [],
  ): BallKind {
    if (
      conditions.length > 0 &&
      this.kind(game).restitutionCushion !== this.kind("pool").restitutionCushion
    )
      throw new RangeError(`conditions: they apply to pool tables, not to ${game}`);
    if (
      !this.#call.carom_ball_kind_for(
        value("carom_game", game, "game"),
        value("carom_shot_cushion", cushion, "cushion"),
        this.#addresses.detail,
      )
    )
      throw new RangeError(`cushion: ${game} has no constants for "${cushion}"`);
    for (const condition of conditions)
      this.#call.carom_condition_give(
        value("carom_condition", condition, "conditions"),
        this.#addresses.detail,
      );
    return readStruct(this.#memory, this.#addresses.detail, "carom_ball_kind");
  }

  /** Bank number 0, 1 or 2 for the calibration of a table: sight, speed of the ball, m/s, roll. */
  bank(k: number): Bank {
    this.#refuse(this.#call.carom_bank_of(k, this.#addresses.detail), `bank ${k}`);
    return readStruct(this.#memory, this.#addresses.detail, "carom_bank");
  }

  /**
   * The restitution and friction of a table's cushions with their standard deviations, from where
   * the three banks returned, in sights from their corner. Without readings: where they return with
   * the constants of the ball. Throws a RangeError if a reading is not above 0 and below 8, and a
   * CaromError if a bank does not return.
   */
  calibrate(
    readings: readonly [number, number, number] | undefined,
    table: Table,
    game: Game = "pool",
  ): Calibration {
    const { table: tablePointer, detail, number, text } = this.#addresses;
    this.#resident = undefined;
    writeTable(this.#memory, tablePointer, table);
    this.kind(game); // which leaves it at `detail`
    if (readings?.some((reading) => !(reading > 0 && reading < 8)))
      throw new RangeError(
        `readings: each must be above 0 and below 8, not ${readings.join(", ")}`,
      );
    if (readings) this.#memory.f64.set(readings, number / 8);
    this.#refuse(
      this.#call.carom_calibrate(tablePointer, detail, readings ? number : 0, text),
      `readings ${readings?.join(", ")}`,
    );
    return readStruct(this.#memory, text, "carom_calibration");
  }

  /** A ball at rest at x, y (m), of a game or with custom constants. */
  ball(x: number, y: number, kind: Game | BallKind = "pool"): ShotBall {
    const constants = typeof kind === "string" ? this.kind(kind) : kind;
    refuseUnknownOf("carom_ball_kind", constants, "kind");
    return {
      kind: constants,
      state: { r: [x, y, constants.radius], v: [0, 0, 0], w: [0, 0, 0], label: "stationary" },
    };
  }

  /**
   * Ball in hand: the layout with a ball at rest at x, y (m), also one that was pocketed. Throws a
   * CaromError if the position is not free; its `field` is the ball or the part of the table that
   * is in the way.
   */
  placeBall(
    table: Table,
    balls: readonly ShotBall[],
    ball: number,
    x: number,
    y: number,
  ): ShotBall[] {
    indexed(ball, balls.length, "ball");
    this.#writeLayout(table, balls);
    const { table: tablePointer, balls: ballsPointer, detail } = this.#addresses;
    const code = this.#call.carom_place_ball(
      tablePointer,
      ballsPointer,
      balls.length,
      ball,
      x,
      y,
      detail,
    );
    if (code === values.CAROM_ERROR_OVERLAP || code === values.CAROM_ERROR_OFF_TABLE) {
      const part = this.#part(detail);
      throw this.#error(
        code,
        part,
        undefined,
        `${part === "table" ? "outside of it" : "in the way"} at ${x}, ${y} m; a free place is needed`,
      );
    }
    this.#refuse(code, `ball ${ball} at ${x}, ${y}`);
    const placed = readBalls(this.#memory, ballsPointer, balls.length)[ball]!;
    return balls.map((item, k) => (k === ball ? { ...item, state: placed.state } : item));
  }

  /**
   * A cue: the usual cue of the game with the given fields. By default 2 m/s along the table, 0.25
   * radii above the centre, ball 0. `tip` replaces `a` and `b`: to the right and above, as players
   * see it; `ballSpeed` is the speed that a level cue gives a ball of the game, instead of `speed`.
   */
  cue(
    fields: Partial<Cue> & { ballSpeed?: number; tip?: readonly [number, number] } = {},
    game: Game = "pool",
  ): Cue {
    const { ballSpeed, tip, ...rest } = fields;
    if (tip !== undefined && (rest.a !== undefined || rest.b !== undefined))
      throw new TypeError(
        "cue.tip: it replaces a and b, which were given too; give only one of them",
      );
    const cue = this.#cue(tip === undefined ? rest : { ...rest, a: 0 - tip[0], b: tip[1] }, game);
    if (ballSpeed === undefined) return cue;
    if (rest.speed !== undefined)
      throw new TypeError(
        "cue.ballSpeed: it replaces speed, the speed of the cue, which was given too; give only one of them",
      );
    if (cue.theta !== 0)
      throw new RangeError(
        "cue.ballSpeed: it is for a level cue, but theta is not 0; give speed, the speed of the cue, instead",
      );
    // Along x, and by a root, it has the same bits in other languages.
    const [x, y] = this.strike({ ...cue, speed: 1, phi: 0 }, this.kind(game)).v;
    return { ...cue, speed: ballSpeed / Math.sqrt(x * x + y * y) };
  }

  #cue(fields: Partial<Cue> = {}, game: Game = "pool"): Cue {
    this.#call.carom_cue_of(this.#addresses.detail, value("carom_game", game, "game"));
    const cue = readStruct<Cue>(this.#memory, this.#addresses.detail, "carom_cue");
    refuseUnknownOf("carom_cue", fields, "cue");
    return {
      ...cue,
      ...Object.fromEntries(Object.entries(fields).filter(([, value]) => value !== undefined)),
    };
  }

  // ---- Shots ------------------------------------------------------------------------------------

  #writeShotOptions(options: ShotOptions): Pointer {
    refuseUnknown(options, KEYS.shot);
    return writeOptions(this.#memory, this.#addresses.options, "carom_shot_options", options);
  }

  #needRoom(room: number): void {
    if (room <= this.#room) return;
    if (this.#events !== 0) this.#memory.free(this.#events);
    this.#events = this.#memory.allocate(room * EVENT.size);
    this.#room = room;
  }

  #writeShot(count: number): void {
    const { shot: pointer, final, state, facts } = this.#addresses;
    setStruct(this.#memory, pointer, "carom_shot", {
      events: this.#events,
      final,
      state,
      facts,
      room: this.#room,
      count,
    });
  }

  #count(): number {
    return Number(this.#memory.i64[(this.#addresses.shot + SHOT.offset.count) / 8]);
  }

  /** Table and balls into the module's memory. */
  #writeLayout(table: Table, balls: readonly ShotBall[]): void {
    if (balls.length < 1 || balls.length > BALLS_MOST)
      throw new RangeError(`balls: there must be 1 to ${BALLS_MOST}, not ${balls.length}`);
    this.#resident = undefined;
    writeTable(this.#memory, this.#addresses.table, table);
    writeBalls(this.#memory, this.#addresses.balls, balls);
  }

  /**
   * Plays a shot until nothing moves. Without a cue, or if a ball already moves, there is no
   * strike. Throws a CaromError that names the ball if something is out of range; if the shot ends
   * in an error later, its `shot` is the shot up to the error.
   */
  simulate(
    table: Table,
    balls: readonly ShotBall[],
    cue?: Partial<Cue>,
    options: ShotOptions = {},
  ): Shot {
    const struck = cue === undefined ? undefined : this.#cue(cue);
    return this.#shoot(table, balls, struck, this.#writeShotOptions(options));
  }

  /** The last shot of a match, as far as it was played. */
  #replay(match: Pointer, table: Table, balls: readonly ShotBall[], cue: Cue): Shot {
    const { options, state, shot } = this.#addresses;
    const record = match + layout.carom_match.offset.record;
    const take = (target: Pointer, part: "options" | "state", size: number): void => {
      const begin = record + layout.carom_record.offset[part];
      this.#memory.u8.copyWithin(target, begin, begin + size);
    };
    take(options, "options", SHOT_OPTIONS.size);
    return this.#shoot(table, balls, cue, options, () => {
      const code = this.#call.carom_match_replay(match, shot);
      take(state, "state", layout.carom_shot_state.size);
      return code;
    });
  }

  /** Plays a shot with options in the module's memory. */
  #shoot(
    table: Table,
    balls: readonly ShotBall[],
    struck: Cue | undefined,
    opt: Pointer,
    play?: () => number,
  ): Shot {
    const addresses = this.#addresses;
    this.#writeLayout(table, balls);
    if (struck !== undefined) writeStruct(this.#memory, addresses.cue, "carom_cue", struck, "cue");
    const cueAt = struck === undefined ? 0 : addresses.cue;
    this.#needRoom(256);
    let code: number;
    // A shot that has more events than there is room for is played again with enough room; its bits
    // are the same.
    for (;;) {
      this.#writeShot(0);
      code =
        play?.() ??
        this.#call.carom_shoot(
          addresses.table,
          addresses.balls,
          balls.length,
          cueAt,
          opt,
          addresses.shot,
        );
      if (this.#count() <= this.#room) break;
      this.#needRoom(this.#count());
    }
    if (code < 0 && this.#count() === 0)
      throw this.#shotError(addresses.table, addresses.balls, balls.length, cueAt, opt);
    return this.#ended(
      table,
      balls.map((ball) => ({ ...ball, kind: { ...ball.kind }, state: { ...ball.state } })),
      code,
      struck,
    );
  }

  /**
   * Continues a shot that was stopped by `timeMost`, `stopAt` or a bound: every event and state has
   * the bits of the uninterrupted shot, however often it is stopped. The options set when to stop
   * again; table, balls and models are the same as at the beginning of the shot. The given shot
   * does not change; the new one has all events from the beginning. A shot at rest is returned as
   * it is.
   */
  continue(shot: Shot, options: StopOptions = {}): Shot {
    refuseUnknown(options, KEYS.stop);
    if (shot.status === "ok") return shot;
    const retained = shot.retained;
    if (retained === undefined)
      throw new TypeError(
        `shot: a shot with the status "${shot.status}", or of a batch, cannot be continued; only simulate() and continue() stop shots that can`,
      );
    const addresses = this.#addresses;
    let code: number;
    // As in simulate(), if there is too little room, the memory is restored first.
    for (;;) {
      this.#resident = undefined;
      this.#reside(shot);
      this.#resident = undefined;
      for (const part of ["table", "options", "state"] as const)
        this.#memory.u8.set(retained[part], addresses[part]);
      writeOptions(this.#memory, addresses.options, "carom_shot_options", options, true);
      code = this.#call.carom_shot_continue(
        addresses.table,
        addresses.balls,
        shot.balls.length,
        addresses.options,
        addresses.shot,
      );
      if (REFUSED.includes(code)) throw this.#error(code);
      if (this.#count() <= this.#room) break;
      this.#needRoom(this.#count());
    }
    return this.#ended(shot.table, shot.balls, code, shot.cue);
  }

  /**
   * The shot that has just been played or continued in the module's memory. Throws if it ended in
   * an error.
   */
  #ended(table: Table, balls: readonly ShotBall[], code: number, cue: Cue | undefined): Shot {
    const { shot: pointer, final } = this.#addresses;
    let retained: Kept | undefined;
    if (
      code > 0 ||
      code === values.CAROM_ERROR_TOO_MANY_EVENTS ||
      code === values.CAROM_ERROR_TOO_LONG
    ) {
      const copy = (part: keyof Kept, size: number): Uint8Array =>
        this.#memory.u8.slice(this.#addresses[part], this.#addresses[part] + size);
      retained = {
        table: copy("table", layout.carom_table.size),
        options: copy("options", SHOT_OPTIONS.size),
        state: copy("state", layout.carom_shot_state.size),
      };
    }
    const shot = this.#played(table, balls, code, pointer, final, this.#events, {
      facts: this.#addresses.facts,
      retained,
      cue,
      options: readOptions(this.#memory, this.#addresses.options, "carom_shot_options"),
    });
    this.#resident = shot;
    if (code < 0) throw this.#error(code, undefined, shot);
    return shot;
  }

  /**
   * The error that carom_shot_fault() reports for arguments: the invalid number, its value, and its
   * allowed values.
   */
  #shotError(
    ...args: [table: Pointer, balls: Pointer, count: number, cue: Pointer, options: Pointer]
  ): CaromError {
    const { fault, text } = this.#addresses;
    const code = this.#call.carom_shot_fault(...args, fault, text, 128);
    const row = this.#memory.u32[(fault + FAULT.offset.row) / 4]!;
    const part = this.#part(fault + FAULT.offset.part);
    if (code === values.CAROM_ERROR_MISCUE) return this.#error(code, "cue.a, cue.b");
    if (row === 0)
      return this.#error(
        code,
        part === "table" && code !== values.CAROM_ERROR_TABLE ? undefined : part,
      );
    const kind = names.carom_part_kind[this.#memory.i32[(fault + FAULT.offset.part) / 4]!];
    const name = this.#memory
      .text(this.#memory.u32[(row + layout.carom_number.offset.name) / 4]!)!
      .replace(/_(.)/g, (_, letter: string) => letter.toUpperCase());
    // The constants of a ball are in its kind, and its position is in its state.
    const inner = { ball: "kind", state: "state" }[kind as string];
    const field = [part, inner, name].filter(Boolean).join(".");
    const must = this.#memory.text(text);
    if (must)
      return this.#error(
        code,
        field,
        undefined,
        `it must be ${must}, not ${this.#memory.f64[(fault + FAULT.offset.value) / 8]}`,
      );
    return this.#error(
      code,
      field,
      undefined,
      this.#memory.text(this.#call.carom_status_string(code))!.replace(/^\w+\.\w+ must/, "it must"),
    );
  }

  /** Throws the error of a call with the table, balls and cue in the module's memory. */
  #refuseShot(code: number, balls: number, options: Pointer, field: string): void {
    if (code >= 0) return;
    const { table, balls: ballsAt, cue, fault, text } = this.#addresses;
    const args = [table, ballsAt, balls, cue, options] as const;
    const isFault = this.#call.carom_shot_fault(...args, fault, text, 128) < 0;
    throw isFault ? this.#shotError(...args) : this.#error(code, field);
  }

  #played(
    table: Table,
    balls: readonly ShotBall[],
    code: number,
    shot: Pointer,
    final: Pointer,
    events: Pointer,
    more: {
      facts?: Pointer;
      retained?: Kept | undefined;
      cue?: Cue | undefined;
      options?: ShotOptions;
      /** How many events were kept, where not all of them were. */
      most?: number;
    } = {},
  ): Shot {
    const { facts, most = Infinity } = more;
    const count = Math.min(Number(this.#memory.i64[(shot + SHOT.offset.count) / 8]), most);
    const bytes = this.#memory.u8.slice(events, events + count * EVENT.size);
    const states = balls.map((_, k): BallState => readState(this.#memory, final + k * STATE.size));
    return new Shot(
      this.#reader,
      table,
      balls,
      this.statusName(code),
      this.#memory.f64[(shot + SHOT.offset.time) / 8]!,
      states,
      count,
      bytes,
      facts ? this.#memory.u8.slice(facts, facts + layout.carom_facts.size) : undefined,
      more.retained,
      more.cue,
      more.options,
    );
  }

  /**
   * Writes the balls and events of a shot into the module's memory, unless they are already there.
   */
  #reside(shot: Shot): void {
    if (this.#resident === shot) return;
    this.#resident = undefined;
    this.#needRoom(Math.max(shot.count, 256));
    writeTable(this.#memory, this.#addresses.table, shot.table);
    writeBalls(this.#memory, this.#addresses.balls, shot.balls);
    this.#memory.u8.set(shot.bytes, this.#events);
    this.#writeShot(shot.count);
    const { f64 } = this.#memory;
    f64[(this.#addresses.shot + SHOT.offset.time) / 8] = shot.time;
    f64[(this.#addresses.shot + SHOT.offset.slopeX) / 8] = shot.table.slopeX ?? 0;
    f64[(this.#addresses.shot + SHOT.offset.slopeY) / 8] = shot.table.slopeY ?? 0;
    this.#resident = shot;
  }

  #look(shot: Shot, time: number, drawn = false): void {
    this.#reside(shot);
    this.#memory.f64[this.#addresses.number / 8] = time;
    this.#statesAt(shot, this.#addresses.number, 1, this.#addresses.final, drawn, `time ${time}`);
  }
  #statesAt(
    shot: Shot,
    times: Pointer,
    n: number,
    states: Pointer,
    drawn: boolean,
    field: string,
  ): void {
    const { balls, shot: pointer, table } = this.#addresses;
    const rest = [balls, shot.balls.length, pointer, times, n, states];
    this.#refuse(
      drawn
        ? this.#call.carom_shot_drawn(table, ...rest)
        : this.#call.carom_shot_frames(balls, shot.balls.length, pointer, times, n, 0, states, 0),
      field,
    );
  }

  /**
   * Plays a recording again, a text or its lines as they come, and yields each of its shots. Throws
   * a CaromError that names the line if the recording is invalid, is cut off, or was made with
   * another revision of the physics.
   */
  replay(recording: string | Iterable<string>): Generator<Replayed, void> {
    return replayed(this.#recordings, recording);
  }

  /**
   * What the cue ball touches first, or undefined. The shot is only followed up to this contact,
   * but its state is kept, so the call takes as long as `simulate`.
   */
  firstContact(
    table: Table,
    balls: readonly ShotBall[],
    cue?: Partial<Cue>,
    options: Omit<ShotOptions, "stopAt"> = {},
  ): Contact | undefined {
    return this.simulate(table, balls, cue, { ...options, stopAt: "contact" }).firstContact;
  }

  /** The motion of a ball at rest just after a strike. */
  strike(cue: Partial<Cue>, kind: BallKind): Motion {
    const { cue: pointer, detail, motion } = this.#addresses;
    this.#resident = undefined;
    writeStruct(this.#memory, pointer, "carom_cue", this.#cue(cue), "cue");
    writeStruct(this.#memory, detail, "carom_ball_kind", kind, "kind");
    const code = this.#call.carom_strike(pointer, detail, motion);
    if (code < 0)
      throw this.#error(code, code === values.CAROM_ERROR_MISCUE ? "cue.a, cue.b" : undefined);
    return readMotion(this.#memory.f64, motion);
  }

  /**
   * Memory for n shots on a table: of one layout of balls for all, or one for each. `room` is the
   * number of events of each shot that are kept; 0, the default: only final states. At first all
   * cues are `cue()`.
   */
  shots(
    table: Table,
    balls: readonly ShotBall[] | readonly (readonly ShotBall[])[],
    n: number,
    options: { room?: number } = {},
  ): Shots {
    refuseUnknown(options, KEYS.room);
    const layouts = (Array.isArray(balls[0]) ? balls : [balls]) as readonly (readonly ShotBall[])[];
    const shots = new Shots(
      this.#library,
      structuredClone(table),
      structuredClone(layouts),
      n,
      options.room ?? 0,
    );
    const cue = this.#cue();
    for (let k = 0; k < n; k++) shots.setCue(k, cue);
    return shots;
  }

  /**
   * Plays all shots of a batch, each with the bits of `simulate`. Returns "ok", or the name of the
   * first error.
   */
  simulateBatch(shots: Shots, options: ShotOptions = {}): string {
    const opt = this.#writeShotOptions(options);
    shots.options = { ...options };
    const { u32, i64, u8 } = this.#memory;
    for (let k = 0; k < shots.n; k++) {
      const shot = shots.pointer(3) + k * SHOT.size;
      u8.fill(0, shot, shot + SHOT.size);
      u32[(shot + SHOT.offset.events) / 4] =
        shots.room === 0 ? 0 : shots.pointer(6) + k * shots.room * EVENT.size;
      u32[(shot + SHOT.offset.final) / 4] = shots.pointer(4) + k * shots.count * STATE.size;
      i64[(shot + SHOT.offset.room) / 8] = BigInt(shots.room);
    }
    const job = setStruct(this.#memory, shots.pointer(7), "carom_shot_job", {
      table: shots.pointer(0),
      balls: shots.pointer(1),
      cues: shots.pointer(2),
      shots: shots.pointer(3),
      status: shots.pointer(5),
      options: opt,
      count: shots.count,
      ballStride: shots.layouts.length === 1 ? 0 : shots.count,
      cueStride: 1,
      n: shots.n,
    });
    return this.statusName(this.#call.carom_shoot_batch(job));
  }

  /** Shot k of a batch, with the events that were kept. */
  #shotOf(shots: Shots, k: number): Shot {
    const shot = shots.pointer(3) + k * SHOT.size;
    const final = shots.pointer(4) + k * shots.count * STATE.size;
    return this.#played(
      shots.table,
      shots.balls(k),
      shots.status[k]!,
      shot,
      final,
      shots.pointer(6) + k * shots.room * EVENT.size,
      { most: shots.room, options: shots.options },
    );
  }

  #saved(shots: Shots): string {
    const played = Array.from({ length: shots.n }, (_, k) => {
      const { status, final, table, balls } = this.#shotOf(shots, k);
      const cueAt = shots.pointer(2) + k * layout.carom_cue.size;
      const cue = readStruct<Cue>(this.#memory, cueAt, "carom_cue");
      return { status, final, table, balls, cue, options: shots.options, count: shots.events(k) };
    });
    return recordingOf(
      this.#savedBy,
      played,
      played.map((_, k) => `shots[${k}]`),
    );
  }

  get #savedBy(): SavedHost {
    return {
      memory: this.#memory,
      statusName: (code) => this.statusName(code),
      replay: (recording) => this.replay(recording),
      replayed: ({ table, balls, cue, options }, previous) => {
        try {
          if (previous) return this.continue(previous, stopsOf(options));
          return this.simulate(table, balls, cue.speed > 0 ? cue : undefined, options);
        } catch (error) {
          if (error instanceof CaromError && error.shot) return error.shot;
          throw error;
        }
      },
    };
  }

  /**
   * Reads what `save()` of a shot, of a batch or of a match returned, or another recording: its
   * text, or its lines. Every shot is played again, and its bits are compared with the recorded
   * hash. A recording of several shots is a list of them. A match by custom rules needs them as
   * `rules`.
   */
  load(recording: string | Iterable<string>, rules?: OwnGame): Shot | Shot[] | Match {
    const lines = typeof recording === "string" ? recording.split("\n") : [...recording];
    if (!isMatch(lines)) {
      const shots = shotsOf(this.#savedBy, lines);
      return shots.length === 1 ? shots[0]! : shots;
    }
    const match = this.match(rules);
    for (const line of lines) match.read(line);
    return match;
  }

  /**
   * Begins a match of 2 to 8 seats by the rules of a game, or from a state of it; without a table,
   * a match whose lines are read first (for a custom game, give its rules).
   */
  match(game?: OwnGame): Match;
  match(
    rules: GameState["rules"] | GameState | OwnGame,
    table: Table,
    options?: MatchOptions,
  ): Match;
  match(
    rules?: GameState["rules"] | GameState | OwnGame,
    table?: Table,
    options: MatchOptions = {},
  ): Match {
    const match = new Match(this.#recordings);
    const game = typeof rules === "string" ? { rules } : rules;
    if (game && table) match.begin(game, table, options);
    else if (game) match.readBy(game);
    return match;
  }

  // ---- Plans and games --------------------------------------------------------------------------

  /**
   * A player with errors of 0.1 m/s, 0.1 degrees of direction and of elevation and 0.003 radii
   * along a and b for a stroke of 2 m/s, times `errors`; the errors grow with the speed. Or a
   * player with a Fargo rating, 200 to 850, such as 500, whose plans play as rated if `shots` is
   * not given; `onlyPots: 0` makes plans that advise such a player. With `rules`, a player of
   * matches of this game, in which 100 points are odds of 2 to 1.
   */
  player(skill: Skill = {}): Player {
    refuseUnknown(skill, KEYS.player);
    return this.#plans.player(skill);
  }

  /**
   * The Fargo rating of a player by games won and lost, 200 to 850, with its interval of 95 %.
   * Without games it is the prior estimate.
   */
  rating(scores: readonly Score[]): Rating {
    return this.#plans.rating(scores);
  }

  /** The odds of a match by two ratings, and its fairest handicap. */
  odds(series: Series): Odds {
    return this.#plans.odds(series);
  }

  /**
   * The intention of a stroke in a game of two sides with pockets, and the value that it lost; and
   * a drill for it. Balls, options and call are as before the stroke.
   */
  review(
    table: Table,
    balls: readonly ShotBall[],
    cue: Partial<Cue>,
    options: PlanOptions = {},
    call?: Call,
  ): Review {
    this.#resident = undefined;
    return this.#plans.review(table, balls, cue, call, options);
  }

  /**
   * The breaks that win most often for a player: the position of the cue ball behind the head
   * string, the speed, the height of the tip and the cut. `balls` are a rack, with the cue ball as
   * ball 0; each break that is tried has its own rack. A call plays about 12,000 breaks.
   */
  bestBreaks(
    rack: RackName,
    table: Table,
    balls: readonly ShotBall[],
    options: BreakOptions = {},
  ): BreakChoice[] {
    this.#resident = undefined;
    return this.#plans.bestBreaks(rack, table, balls, options);
  }

  /**
   * Plays many breaks of one stroke, each with another rack and errors of the player, as `carom
   * break` does. `balls` are a rack, with the cue ball as ball 0.
   */
  breaks(
    rack: RackName,
    table: Table,
    balls: readonly ShotBall[],
    options: BreaksOptions = {},
  ): Breaks {
    this.#resident = undefined;
    return this.#advice.breaks(rack, table, balls, options);
  }

  /**
   * Every way to pot, to score in three-cushion, or to bring the cue ball to a place, as `carom
   * ways` finds them. `cues` are strokes of one ball, each of which is tried in all directions.
   */
  ways(
    table: Table,
    balls: readonly ShotBall[],
    cues: Partial<Cue> | readonly Partial<Cue>[] = {},
    options: WaysOptions = {},
  ): Ways {
    const strokes = Array.isArray(cues) ? (cues as readonly Partial<Cue>[]) : [cues];
    return this.#advice.ways(table, balls, strokes as readonly Partial<Cue>[], options);
  }

  /**
   * Explains a choice of a plan: what it meets, what it leaves, and what errors cost. The options
   * are those of the plan; a cue ball in hand is put where the choice says.
   */
  why(
    table: Table,
    balls: readonly ShotBall[],
    choice: PlanStroke,
    options: PlanOptions = {},
  ): Why {
    return this.#advice.why(table, balls, choice, options);
  }

  /**
   * What the strokes of recorded matches cost, by kinds of strokes, the most costly kind first.
   * `recording` has matches of two sides with pockets, and `seat` is whose strokes are reviewed: a
   * seat, or the name in it. Default: those of all seats.
   */
  practice(
    recording: string | Iterable<string>,
    seat?: number | string,
    options: PracticeOptions = {},
  ): Practice[] {
    this.#resident = undefined;
    return this.#advice.practice(recording, seat, options);
  }

  /**
   * The stroke of a player who intends `cue`, with errors drawn from a seed and the number of the
   * stroke.
   */
  withErrors(cue: Partial<Cue>, player: Player, seed: number, number = 0): Cue {
    this.#resident = undefined;
    return this.#plans.withErrors(cue, player, seed, number);
  }

  /**
   * Aims a pot: the direction of the cue in which a ball goes to the middle of a pocket's mouth,
   * with a bank, a kick or a combination if `via` lists it, and with squirt, swerve, throw and the
   * model of the cushion. If `is` is "no_way", the direction of the cue does not change.
   */
  aim(
    table: Table,
    balls: readonly ShotBall[],
    cue: Partial<Cue>,
    pot: AimOf,
    options?: ShotOptions,
  ): Aim;
  /**
   * Aims at a ball by its cut, without a pocket and also on a table that has none. A list of cuts
   * results in a list of strokes. Throws, with the reason, where there is no such aim.
   */
  aim(
    table: Table,
    balls: readonly ShotBall[],
    cue: Partial<Cue>,
    aim: CutOf & { cut: readonly number[] },
    options?: ShotOptions,
  ): Hit[];
  aim(
    table: Table,
    balls: readonly ShotBall[],
    cue: Partial<Cue>,
    aim: CutOf & { cut?: number },
    options?: ShotOptions,
  ): Hit;
  aim(
    table: Table,
    balls: readonly ShotBall[],
    cue: Partial<Cue>,
    aim: AimOf | CutOf,
    options: ShotOptions = {},
  ): Aim | Hit | Hit[] {
    refuseUnknown(aim, KEYS.aim, "aim");
    const { ball, pocket, via = [], cut }: Partial<AimOf & CutOf> = aim;
    if (pocket !== undefined) {
      if (cut !== undefined)
        throw new TypeError("pocket, cut: a pocket determines the cut; give only one of both");
      return this.#plans.aim(table, balls, cue, aim as AimOf, options);
    }
    if (via.length > 0) throw new TypeError("via: it needs a pocket; give one, or leave via out");
    const cuts = typeof cut === "object" ? cut : [cut ?? 0];
    const hits = this.#plans.aimByCut(table, balls, cue, ball!, cuts, options);
    return typeof cut === "object" ? hits : hits[0]!;
  }

  /**
   * Where pockets are for a player at the head, y = 0: "head-left", "side-left", "foot-left" and so
   * on; undefined on tables that are not rectangular.
   */
  pocketNames(table: Table): (string | undefined)[] {
    return this.#names(table, "pocket");
  }

  /** The same for rails, "head", "foot", "left" or "right"; undefined for the cut of a pocket. */
  railNames(table: Table): (string | undefined)[] {
    return this.#names(table, "rail");
  }

  #names(table: Table, kind: "rail" | "pocket"): (string | undefined)[] {
    this.#resident = undefined;
    writeTable(this.#memory, this.#addresses.table, table);
    return this.#plans.names(kind, table[`${kind}s`].length);
  }

  /**
   * The shots that win most often from a layout, the best first. It takes about 20 µs per shot, so
   * run large plans in a worker. The choice depends only on the arguments.
   */
  plan(table: Table, balls: readonly ShotBall[], options: PlanOptions = {}): PlanStroke[] {
    return this.#plans.plan(table, balls, undefined, options);
  }

  /**
   * A plan in slices of `slice` events, about 2 µs each, for an opponent who thinks between frames:
   * `next()` plays a slice, and the last one returns the choices of `plan`, bit for bit. Do not
   * change table, balls and options meanwhile.
   */
  think(
    table: Table,
    balls: readonly ShotBall[],
    options: PlanOptions = {},
    slice = 1000,
  ): Generator<undefined, PlanStroke[]> {
    return this.#plans.think(table, balls, undefined, options, sliceOf(slice), 0);
  }

  /**
   * The chances of the given strokes, each played shots / cues.length times with errors, at least
   * 10 times.
   */
  chances(
    table: Table,
    balls: readonly ShotBall[],
    cues: readonly Partial<Cue>[],
    options: PlanOptions = {},
  ): PlanStroke[] {
    return this.#plans.plan(table, balls, cues, options);
  }

  /**
   * A complete run-out: each stroke starts from what the preceding one leaves without errors, with
   * the landing zone of the cue ball; and the chance of the run-out, from run-outs that are played.
   */
  sequence(table: Table, balls: readonly ShotBall[], options: SequenceOptions = {}): Sequence {
    return resultOf(this.#plans.sequence(table, balls, options, 0));
  }

  /** The same in slices, as in `think`. Each played run-out is a slice. */
  thinkSequence(
    table: Table,
    balls: readonly ShotBall[],
    options: SequenceOptions = {},
    slice = 1000,
  ): Generator<undefined, Sequence> {
    return this.#plans.sequence(table, balls, options, sliceOf(slice));
  }

  /** The balls that may be met first, and potted. */
  ballsOn(game: GameState | OwnGame, balls: readonly ShotBall[]): number[] {
    refuseUnknown(game, KEYS.game, "game");
    return this.#plans.targets(game, balls);
  }

  /**
   * Plays a shot as `simulate` does, and judges it by the rules. Eight-ball needs a call, except
   * for the break and a safety.
   */
  referee(
    table: Table,
    balls: readonly ShotBall[],
    cue: Partial<Cue>,
    game: GameState | OwnGame,
    call?: Call,
    options: ShotOptions = {},
  ): Ruling {
    refuseUnknown(game, KEYS.game, "game");
    return this.#plans.referee(table, balls, cue, game, call, options);
  }

  /**
   * Judges a shot that was already played; `cueBall` is the index of the cue ball.
   */
  rule(shot: Shot, game: GameState | OwnGame, call?: Call, cueBall = 0): Ruling {
    refuseUnknown(game, KEYS.game, "game");
    if (shot.facts === undefined) throw new TypeError("shot: a shot of a batch has no facts");
    this.#reside(shot);
    this.#memory.u8.set(shot.facts, this.#addresses.facts);
    writeStates(this.#memory, this.#addresses.final, shot.final);
    return this.#plans.rule(shot.balls, this.#addresses.shot, game, call, cueBall);
  }
}
