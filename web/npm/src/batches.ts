// Many collisions, or many shots, in the module's memory: the library reads what is written here
// without a copy.
import { layout } from "./generated/layout.js";
import type { Memory, Pointer } from "./memory.js";
import { chosenOf, firstOf, pottedOf, type Shot } from "./shot.js";
import { readMotion, readState, writeBalls, writeStruct, writeTable } from "./structs.js";
import type {
  BallState,
  Collided,
  Cue,
  EventType,
  FirstEvent,
  FirstOptions,
  Impact,
  ShotBall,
  ShotOptions,
  Table,
} from "./types.js";

const IMPACT = layout.carom_impact;
const RESULT = layout.carom_result;
const CUE = layout.carom_cue;
const STATE = layout.carom_ball_state;

/** The functions of the library that batches use. */
export interface Library {
  readonly memory: Memory;
  statusName(code: number): string;
  writeImpact(pointer: Pointer, impact: Impact): void;
  /** Shot k with the events that were kept. */
  shotOf(shots: Shots, k: number): Shot;
  save(shots: Shots): string;
}

/** Memory of the module that is freed by free(), or when nothing refers to it any more. */
const owned = new FinalizationRegistry<{ memory: Memory; pointers: Pointer[] }>(
  ({ memory, pointers }) => pointers.forEach((pointer) => memory.free(pointer)),
);

/** An object that owns memory of the module, and frees it. */
export class Owner<L extends { memory: Memory } = Library> {
  readonly #held: { memory: Memory; pointers: Pointer[] };

  constructor(
    protected readonly library: L,
    sizes: number[],
  ) {
    this.#held = {
      memory: library.memory,
      pointers: sizes.map((bytes) => library.memory.allocate(bytes)),
    };
    owned.register(this, this.#held, this.#held);
  }
  /** @internal */
  pointer(k: number): Pointer {
    const pointer = this.#held.pointers[k];
    if (pointer === undefined) throw new Error("carom: this memory has been freed");
    return pointer;
  }
  /** A section of it as numbers. */
  protected numbers(k: number, bytes: number): Float64Array {
    return new Float64Array(this.library.memory.buffer, this.pointer(k), bytes / 8);
  }
  /**
   * Frees the memory. Views of it are no longer valid. Without this call the garbage collector
   * frees it later.
   */
  free(): void {
    owned.unregister(this.#held);
    this.#held.pointers.splice(0).forEach((pointer) => this.#held.memory.free(pointer));
  }
}

/** Checks an index below `count`. */
export function indexed(k: number, count: number, name = "k"): number {
  if (!Number.isInteger(k) || k < 0 || k >= count)
    throw new RangeError(`${name}: it must be 0 to ${count - 1}, not ${k}`);
  return k;
}
function rows(n: number, name: string): number {
  if (!Number.isInteger(n) || n < 0)
    throw new RangeError(`${name}: it must be a whole number, 0 or more, not ${n}`);
  return n;
}

/**
 * Many collisions for `collideBatch`. `in`, `out` and `status` are views of WebAssembly memory. Get
 * them again after you have created other batches or played shots: the memory may have grown, and
 * older views are then empty.
 */
export class Collisions extends Owner {
  /** Number of collisions. */
  readonly n: number;

  /** @internal */
  constructor(library: Library, n: number) {
    super(library, [rows(n, "n") * IMPACT.size, n * RESULT.size, n]);
    this.n = n;
  }
  /**
   * 26 doubles for each collision, as in carom_impact: r, v, w, radius, mass, mu_slide of both
   * balls; mu_ball, restitution.
   */
  get in(): Float64Array {
    return this.numbers(0, this.n * IMPACT.size);
  }
  /**
   * 12 doubles for each collision, as in carom_result: v and w of both balls. NaN where the status
   * is an error.
   */
  get out(): Float64Array {
    return this.numbers(1, this.n * RESULT.size);
  }
  /** One status for each collision: 0 resolved, 1 separating, negative an error of carom.h. */
  get status(): Int8Array {
    return new Int8Array(this.library.memory.buffer, this.pointer(2), this.n);
  }
  /** Writes collision k from an object. */
  set(k: number, impact: Impact): void {
    this.library.writeImpact(this.pointer(0) + indexed(k, this.n) * IMPACT.size, impact);
  }
  /** Collision k as an object. */
  get(k: number): Collided {
    const f64 = this.library.memory.f64;
    const pointer = this.pointer(1) + indexed(k, this.n) * RESULT.size;
    return {
      status: this.library.statusName(this.status[k]!),
      a: readMotion(f64, pointer + RESULT.offset.a),
      b: readMotion(f64, pointer + RESULT.offset.b),
    };
  }
}

/**
 * Where the fields of a cue are among its numbers, `cueSize` for each. The ball's index is set by
 * `setCue`.
 */
export const cueFields = Object.fromEntries(
  Object.entries(CUE.offset)
    .filter(([key]) => key !== "ball")
    .map(([key, offset]) => [key, offset / 8]),
) as Readonly<Record<Exclude<keyof Cue, "ball">, number>>;

/** How many numbers a cue has in `Shots.cues`. */
export const cueSize = CUE.size / 8;

/**
 * Many shots on one table for `simulateBatch`. `cues`, `final` and `status` are views of
 * WebAssembly memory, as in `Collisions`.
 */
export class Shots extends Owner {
  /** Balls of a shot. */
  readonly count: number;
  /** @internal The options with which the shots were played. */
  options: ShotOptions = {};

  /** @internal */
  constructor(
    library: Library,
    readonly table: Table,
    /** @internal */
    readonly layouts: readonly (readonly ShotBall[])[],
    /** Number of shots. */
    readonly n: number,
    /** How many events of each shot are kept. */
    readonly room: number,
  ) {
    const count = layouts[0]?.length ?? 0;
    if (layouts.length !== 1 && layouts.length !== n)
      throw new RangeError(`balls: 1 layout or ${n} of them are needed, not ${layouts.length}`);
    if (layouts.some((balls) => balls.length !== count))
      throw new RangeError("balls: all layouts must have the same number of balls");
    const sizes = [
      layout.carom_table.size,
      layouts.length * count * layout.carom_shot_ball.size,
      rows(n, "n") * CUE.size,
      n * layout.carom_shot.size,
      n * count * STATE.size,
      n,
      n * rows(room, "room") * layout.carom_event.size,
      layout.carom_shot_job.size,
    ];
    super(library, sizes);
    this.count = count;
    writeTable(library.memory, this.pointer(0), table);
    layouts.forEach((balls, k) =>
      writeBalls(library.memory, this.pointer(1) + k * count * layout.carom_shot_ball.size, balls),
    );
  }
  /** `cueSize` numbers for each shot, as in carom_cue; `cueFields` has the index of each. */
  get cues(): Float64Array {
    return this.numbers(2, this.n * CUE.size);
  }
  /**
   * 10 numbers for each ball of each shot: r, v, w at the end; the tenth is the label, an integer,
   * for `label()`.
   */
  get final(): Float64Array {
    return this.numbers(4, this.n * this.count * STATE.size);
  }
  /**
   * One status for each shot: 0 all balls rest, positive stopped as requested, negative an error of
   * carom.h.
   */
  get status(): Int8Array {
    return new Int8Array(this.library.memory.buffer, this.pointer(5), this.n);
  }
  /** Sets the cue of shot k. */
  setCue(k: number, cue: Cue): void {
    writeStruct(
      this.library.memory,
      this.pointer(2) + indexed(k, this.n) * CUE.size,
      "carom_cue",
      cue,
      "cue",
    );
  }
  /** The state of a ball at the end of shot k. */
  state(k: number, ball: number): BallState {
    return readState(
      this.library.memory,
      this.pointer(4) +
        (indexed(k, this.n) * this.count + indexed(ball, this.count, "ball")) * STATE.size,
    );
  }
  /** How long shot k lasts, s. */
  time(k: number): number {
    return this.library.memory.f64[
      (this.pointer(3) +
        indexed(k, this.n) * layout.carom_shot.size +
        layout.carom_shot.offset.time) /
        8
    ]!;
  }
  /** How many events shot k has. */
  events(k: number): number {
    return Number(
      this.library.memory.i64[
        (this.pointer(3) +
          indexed(k, this.n) * layout.carom_shot.size +
          layout.carom_shot.offset.count) /
          8
      ],
    );
  }
  /** Shot k with its events, copied. Needs `room` for all of them. */
  shot(k: number): Shot {
    if (this.events(k) > this.room)
      throw new RangeError(
        `room: shot ${k} has ${this.events(k)} events, and there is room for ${this.room} of them`,
      );
    return this.library.shotOf(this, k);
  }
  /** The balls of shot k at its start. */
  balls(k: number): readonly ShotBall[] {
    return this.layouts[this.layouts.length === 1 ? 0 : indexed(k, this.n)]!;
  }
  /**
   * The first event of a kind in each shot, as `Shot.first`. Throws if a shot had more events than
   * room, and those that were kept have none of this kind.
   */
  first(kind: EventType, options: FirstOptions = {}): (FirstEvent | undefined)[] {
    return Array.from({ length: this.n }, (_, k) => {
      const found = firstOf(this.library.shotOf(this, k).events, kind, options, this.count);
      if (found === undefined && this.events(k) > this.room)
        throw new RangeError(
          `room: shot ${k} has ${this.events(k)} events, and there is room for ${this.room} of them; first() needs all`,
        );
      return found;
    });
  }
  /** For each shot, whether a ball was potted, as `Shot.potted`. */
  potted(ball: number): boolean[];
  potted(ball?: readonly number[]): boolean[][];
  potted(ball?: number | readonly number[]): (boolean | boolean[])[] {
    return Array.from({ length: this.n }, (_, k) => {
      const final = Array.from({ length: this.count }, (_, index) => this.state(k, index));
      return chosenOf(pottedOf(this.balls(k), final), ball);
    });
  }
  /** The shots as a recording, as `Shot.save`. */
  save(): string {
    return this.library.save(this);
  }
}
