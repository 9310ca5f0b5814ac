// One shot that was played: its events, and where the balls are at any time.
import type { BallState, Contact, Cue, Frame, ShotBall, ShotEvent, Table } from "./types.js";

/** The functions of the library that a shot uses. */
export interface Reader {
  events(shot: Shot): ShotEvent[];
  states(shot: Shot, time: number, drawn: boolean): BallState[];
  positions(shot: Shot, time: number, into: Float64Array): void;
  positionsAt(shot: Shot, times: ArrayLike<number>, drawn: boolean): Float64Array;
  frame(shot: Shot, time: number): Frame;
}

/**
 * What is needed to continue a stopped shot, as bytes of C: the table, the options and the state.
 */
export type Kept = Readonly<Record<"table" | "options" | "state", Uint8Array>>;

/** One shot that was played. It keeps its events in JavaScript's memory and needs no release. */
export class Shot {
  readonly #reader: Reader;
  #events: readonly ShotEvent[] | undefined;

  /** @internal */
  constructor(
    reader: Reader,
    readonly table: Table,
    /** The balls at the start. */
    readonly balls: readonly ShotBall[],
    /**
     * "ok" if all balls rest; "stopped_at_time", "stopped_at_event"; or how it failed.
     */
    readonly status: string,
    /** How long it lasts, s. */
    readonly time: number,
    /** The states at the end. */
    readonly final: readonly BallState[],
    /** The number of events. */
    readonly count: number,
    /** @internal The events as the library wrote them. */
    readonly bytes: Uint8Array,
    /** @internal The facts for rules, as the library wrote them. */
    readonly facts?: Uint8Array,
    /** @internal What `continue` needs. */
    readonly retained?: Kept,
    /** The stroke. */
    readonly cue?: Cue,
  ) {
    this.#reader = reader;
  }

  /** What happened, in order. */
  get events(): readonly ShotEvent[] {
    return (this.#events ??= this.#reader.events(this));
  }

  /**
   * The first contact of the cue ball (the ball that the cue struck, or ball 0) with another ball;
   * or undefined.
   */
  get firstContact(): Contact | undefined {
    const struck = this.events[0]?.type === "stick_ball" ? this.events[0].a : 0;
    const event = this.events.find(
      (event) => event.type === "ball_ball" && (event.a === struck || event.b === struck),
    );
    if (event === undefined) return undefined;
    return { time: event.time, ball: event.a === struck ? event.b : event.a, event };
  }

  /**
   * x, y, z of every ball at a time (s), m: 3 numbers for each ball. Pass an array to use its
   * memory.
   */
  positions(time: number, into = new Float64Array(3 * this.balls.length)): Float64Array {
    this.#reader.positions(this, time, into);
    return into;
  }

  /**
   * x, y, z of every ball at many times (s), m: 3 numbers for each ball, time after time. Ascending
   * times are fastest. `drawn` as for `states`.
   */
  positionsAt(times: ArrayLike<number>, drawn = false): Float64Array {
    return this.#reader.positionsAt(this, times, drawn);
  }

  /**
   * The states of all balls at a time, s. With `drawn` a pocketed ball falls in its pocket until it
   * rests at the bottom, below the cloth.
   */
  states(time: number, drawn = false): BallState[] {
    return this.#reader.states(this, time, drawn);
  }

  /**
   * How each ball has turned since the start, as unit quaternions w, x, y, z: 4 numbers for each
   * ball.
   */
  orientations(time: number, into = new Float64Array(4 * this.balls.length)): Float64Array {
    into.set(this.#reader.frame(this, time).turned);
    return into;
  }

  /**
   * The states of all balls at a time, s, and how they have turned, for drawing. It continues from
   * the previous frame if that was earlier in this shot. Nothing is copied: the next frame uses the
   * same arrays.
   */
  frame(time: number): Frame {
    return this.#reader.frame(this, time);
  }
}
