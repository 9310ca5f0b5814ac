// One shot that was played: its events, and where the balls are at any time.
import { names } from "./generated/layout.js";
import { KEYS, refuseUnknown } from "./keys.js";
import { value, whole } from "./structs.js";
import type {
  BallState,
  Contact,
  Cue,
  EventType,
  FirstEvent,
  FirstOptions,
  Frame,
  ShotBall,
  ShotEvent,
  ShotOptions,
  Table,
} from "./types.js";

/** The functions of the library that a shot uses. */
export interface Reader {
  events(shot: Shot): ShotEvent[];
  states(shot: Shot, time: number, drawn: boolean): BallState[];
  positions(shot: Shot, time: number, into: Float64Array): void;
  positionsAt(shot: Shot, times: ArrayLike<number>, drawn: boolean): Float64Array;
  frame(shot: Shot, time: number): Frame;
  save(shot: Shot): string;
}

/** The first event of a kind, as `Shot.first` describes it. `count` is the number of balls. */
export function firstOf(
  events: readonly ShotEvent[],
  kind: EventType,
  options: FirstOptions,
  count: number,
): FirstEvent | undefined {
  refuseUnknown(options, KEYS.first);
  const { ball } = options;
  const earliest = options.after ?? -1;
  const type = names.carom_event_type[value("carom_event_type", kind, "kind")]!;
  if (ball !== undefined) whole(ball, "ball", count - 1);
  const index = events.findIndex((event) => {
    const isOfBall =
      ball === undefined || event.a === ball || (type === "ball_ball" && event.b === ball);
    return event.type === type && event.time > earliest && isOfBall;
  });
  const event = events[index];
  if (event === undefined) return undefined;
  // Of a collision of two balls, the given ball is a or b.
  const side = ball !== undefined && type === "ball_ball" && event.b === ball ? 1 : 0;
  return {
    index,
    time: event.time,
    other: side === 1 ? event.a : event.b,
    before: event.before[side]!,
    after: event.after[side]!,
    event,
  };
}

/** Which balls were on the table at the start and are in a pocket at the end. */
export function pottedOf(
  balls: readonly ShotBall[],
  final: readonly Pick<BallState, "label">[],
): boolean[] {
  return balls.map(({ state }, k) => final[k]!.label === "pocketed" && state.label !== "pocketed");
}
/** Those of one ball, of several, or of all. */
export function chosenOf(
  potted: readonly boolean[],
  ball: number | readonly number[] | undefined,
): boolean | boolean[] {
  const potsBall = (k: number): boolean => potted[whole(k, "ball", potted.length - 1)]!;
  if (ball === undefined) return [...potted];
  return typeof ball === "number" ? potsBall(ball) : ball.map(potsBall);
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
    /** The models, and when the shot was stopped. */
    readonly options: ShotOptions = {},
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
   * The first event of a kind, such as "ball_ball" or "sliding_rolling"; undefined if there is
   * none.
   */
  first(kind: EventType, options: FirstOptions = {}): FirstEvent | undefined {
    return firstOf(this.events, kind, options, this.balls.length);
  }

  /**
   * Whether a ball was potted: on the table at the start, in a pocket at the end. Without an
   * argument, or with a list: of each ball.
   */
  potted(ball: number): boolean;
  potted(ball?: readonly number[]): boolean[];
  potted(ball?: number | readonly number[]): boolean | boolean[] {
    return chosenOf(pottedOf(this.balls, this.final), ball);
  }

  /**
   * The shot as a recording, text that `carom.load` reads and `carom verify` checks: the table, the
   * balls, the cue, the options and a hash of the result. Events are computed again. Throws if
   * playing the shot again has other bits, because an object was changed.
   */
  save(): string {
    return this.#reader.save(this);
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
