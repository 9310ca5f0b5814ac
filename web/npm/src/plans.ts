// Which shot to play, players with errors, and the rules of games: the calls of carom_plan.h.
import { games, layout, names, values } from "./generated/layout.js";
import type * as C from "./generated/structs.js";
import { KEYS, refuseUnknown } from "./keys.js";
import { LAST, refuseOrder } from "./lines.js";
import type { Memory, Pointer } from "./memory.js";
import { OwnRules } from "./own.js";
import {
  indexOf,
  members,
  readBalls,
  readFacts,
  readStruct,
  setStruct,
  value,
  whole,
  writeOptions,
  writeStruct,
} from "./structs.js";
import type {
  Aim,
  AimOf,
  BreakChoice,
  BreakOptions,
  Call,
  PlanStroke,
  Cue,
  Drill,
  EventType,
  GameState,
  Hit,
  Odds,
  PlanOptions,
  Player,
  RackName,
  Rating,
  Review,
  Ruling,
  Score,
  Sequence,
  SequenceOptions,
  SequenceStroke,
  Series,
  ShotBall,
  ShotOptions,
  Skill,
  Table,
  Vec2,
} from "./types.js";

const PLAYER = layout.carom_player;
const RULES = layout.carom_plan_rules;
const OPTIONS = layout.carom_plan_options;
const JOB = layout.carom_plan_job;
const CHOICE = layout.carom_plan_stroke;
const GOAL = layout.carom_plan_goal;
const STEP = layout.carom_sequence_stroke;
const COUNTS = layout.carom_sequence_counts;
const RULING = layout.carom_ruling.offset;
const POT = layout.carom_pot;
/** Room for the text of carom_plan_fault(). */
const FAULT_SIZE = 200;
const PART = layout.carom_part;

const MAY = names.carom_choice;
/** Where the cue ball may be put, by carom_leave. */
export const HANDS = ["no", "no", "anywhere", "kitchen", "d", "baulk"] as const;
/** The leave within whose bounds the cue ball is put, by the word of `inHand`; 0: none. */
const leaveOf = (inHand: PlanOptions["inHand"]): number =>
  typeof inHand === "string" && inHand !== "no" ? HANDS.lastIndexOf(inHand) : 0;
/** The members of a state that are numbers here, too. */
const MEMBERS = [
  "fouls",
  "score",
  "lost",
  "pocket",
  "on",
  "freeBall",
  "target",
  "innings",
] as const;
const fieldsOf = (state: object, keys: readonly string[]): object =>
  Object.fromEntries(
    Object.entries(state).filter(([key, value]) => keys.includes(key) && value !== undefined),
  );
/** The result of a search without slices. */
export function resultOf<T>(search: Generator<undefined, T>): T {
  const { done, value } = search.next();
  if (!done) throw new RangeError("carom: a plan without slices has not ended");
  return value;
}
const SCORE = layout.carom_score;
const BREAK = layout.carom_break_choice;
const BREAK_JOB = layout.carom_break_job;
const SERIES = layout.carom_series;
const BOUNDS = {
  speedShare: 0,
  speedLeast: 0,
  speedMost: 0,
  tipMost: 0,
  growth: 0,
  onlyPots: 0,
  shots: 0,
  eye: 0,
};

/** The functions of the library that this file uses. */
export interface Host {
  readonly memory: Memory;
  readonly addresses: Record<"table" | "balls" | "cue" | "shot" | "final", Pointer>;
  cue(fields: Partial<Cue>): Cue;
  writeLayout(table: Table, balls: readonly ShotBall[]): void;
  writeShotOptions(options: ShotOptions): Pointer;
  writeShot(): void;
  refuse(code: number, field?: string): void;
}

/** The game of a state. */
export type Rules = Partial<Pick<GameState, "rules" | "own">>;
type Method = (...numbers: Pointer[]) => number;

/** Rejects a layout that is not valid for a game, for a plan. */
function refuseLayout({ pockets }: Table, balls: readonly ShotBall[], rules: string): void {
  const needed = { billiard: 3, fourball: 4 }[games[rules as C.RulesKind].balls as string];
  const pool = needed === undefined;
  if (pool && pockets.length === 0)
    throw new TypeError(`table: it has no pockets, but ${rules} needs them`);
  if (!pool && pockets.length > 0)
    throw new TypeError(`table: it has pockets, but ${rules} is played without`);
  if (!pool && balls.length < needed)
    throw new TypeError(`balls: ${rules} needs ${needed === 3 ? "three" : "four"}`);
  const last = LAST[rules as C.RulesKind] ?? balls.length;
  const beyond = balls.findIndex(
    ({ state }, k) => k > last && state.label !== "pocketed" && state.label !== "off",
  );
  if (beyond >= 0)
    throw new TypeError(
      `balls: the balls of ${rules} are the cue ball and 1 to ${last}, not ${beyond}`,
    );
}

/** A call as carom_call has it. */
function numbersOf(call: Call | undefined): { ball: number; pocket: number } {
  if (call === undefined) return { ball: -1, pocket: -1 };
  if (call === "push") return { ball: values.CAROM_CALL_PUSH, pocket: -1 };
  if (call === "pass") return { ball: values.CAROM_CALL_PASS, pocket: -1 };
  return { ball: call.ball ?? -1, pocket: call.pocket };
}

/** Why there is no such aim. */
function whyNoAim(pot: C.Pot, cueBall: number): string {
  const { a, b, type } = pot.met;
  const isBall = names.carom_event_type[type] === "ball_ball";
  const obstacle = isBall ? `ball ${a === cueBall ? b : a}` : "a cushion, a jaw or a pocket";
  const reasons: Partial<Record<Aim["outcome"], string>> = {
    no_way: "no direction of the cue makes the cue ball meet it first at this cut",
    barred: `${obstacle} is in the way`,
    short: "the cue ball comes to rest before it; raise the cue's speed",
    stick: `the stick would have to be raised by ${pot.elevation.toFixed(1)} degrees to clear what is behind the cue ball; nobody plays above 60`,
  };
  const word = names.carom_pot_outcome[pot.outcome]!;
  return reasons[word] ?? word;
}

export class Plans {
  readonly #host: Host;
  readonly customRules: OwnRules;
  readonly #addresses: Record<
    | "player"
    | "opponent"
    | "rules"
    | "options"
    | "job"
    | "ruling"
    | "text"
    | "call"
    | "corners"
    | "found"
    | "goal"
    | "counts"
    | "pot",
    Pointer
  >;

  constructor(host: Host) {
    this.#host = host;
    this.customRules = new OwnRules(host.memory);
    const room = (bytes: number): Pointer => host.memory.allocate(bytes);
    this.#addresses = {
      player: room(PLAYER.size),
      opponent: room(PLAYER.size),
      rules: room(RULES.size),
      options: room(OPTIONS.size),
      job: room(JOB.size),
      ruling: room(layout.carom_ruling.size),
      text: room(256),
      call: room(8),
      corners: room(layout.carom_bounds.size),
      found: room(8),
      goal: room(GOAL.size),
      counts: room(COUNTS.size),
      pot: room(POT.size),
    };
  }

  get #memory(): Memory {
    return this.#host.memory;
  }

  /** Throws what a plan rejects in the job that was written last: the member, its value and its range. */
  #refuseJob(): never {
    const memory = this.#memory;
    const text = memory.allocate(FAULT_SIZE);
    try {
      memory.exports.carom_plan_fault(this.#addresses.job, text, FAULT_SIZE);
      throw new RangeError(`plan: ${memory.text(text)}`);
    } finally {
      memory.free(text);
    }
  }

  refuse(code: number, field?: string): void {
    this.customRules.check();
    this.#host.refuse(code, field);
  }

  writeCue(cue: Partial<Cue>): Cue {
    const struck = this.#host.cue(cue);
    writeStruct(this.#memory, this.#host.addresses.cue, "carom_cue", struck, "cue");
    return struck;
  }

  player({ errors: scale, fargo, rules }: Skill): Player {
    if (scale !== undefined && fargo !== undefined)
      throw new TypeError("errors, fargo: a player has errors or a rating, not both");
    const errors = scale ?? 1;
    if (!(errors >= 0 && errors < Infinity))
      throw new RangeError(`errors: it must be finite and at least 0, not ${errors}`);
    if (fargo !== undefined && !(fargo >= 200 && fargo <= 850))
      throw new RangeError(`fargo: it must be 200 to 850, not ${fargo}`);
    const { exports } = this.#memory;
    const { player } = this.#addresses;
    if (fargo === undefined && rules !== undefined)
      throw new TypeError("rules: they need a rating, fargo");
    if (fargo === undefined) exports.carom_player_of(player, errors);
    else if (rules === undefined) exports.carom_player_fargo(player, fargo);
    else exports.carom_player_rated(player, fargo, value("carom_rules_kind", rules, "rules"));
    return readStruct<Player>(this.#memory, player, "carom_player");
  }

  rating(scores: readonly Score[]): Rating {
    const memory = this.#memory;
    const rows = memory.allocate(scores.length * SCORE.size + 8);
    const ratingPointer = this.#addresses.corners;
    try {
      for (const [k, score] of scores.entries())
        writeStruct(memory, rows + k * SCORE.size, "carom_score", score, `scores[${k}]`);
      const code = memory.exports.carom_rating_of(rows, BigInt(scores.length), ratingPointer);
      const { row, ...rating } = readStruct<Rating & { row: number }>(
        memory,
        ratingPointer,
        "carom_rating",
      );
      this.refuse(code, `scores[${row}]`);
      return rating;
    } finally {
      memory.free(rows);
    }
  }

  /** The odds of a match, and its fairest handicap. */
  odds(series: Series): Odds {
    refuseUnknown(series, KEYS.series);
    const { ratings, games = 1, sets = 1, order = "alternate", side, breakPoints = 0 } = series;
    const memory = this.#memory;
    const both = (given: number | readonly number[]): readonly number[] =>
      typeof given === "number" ? [given, given] : given;
    const needed = { games: both(games), sets: both(sets) };
    const room = memory.allocate(SERIES.size + layout.carom_odds.size);
    const found = room + SERIES.size;
    try {
      const numbers = {
        rating: ratings,
        breakPoints,
        ...needed,
        order: value("carom_break_order", order, "order"),
        side: side ?? -1,
      };
      writeStruct(memory, room, "carom_series", numbers, "series");
      if (memory.exports.carom_odds_of(room, found) < 0)
        throw new RangeError(
          `series: ratings must be 0 to 1000, breakPoints -1000 to 1000, games and sets 1 to ${values.CAROM_SERIES_MOST}, and side 0 or 1`,
        );
      const odds = readStruct<C.Odds>(memory, found, "carom_odds");
      memory.exports.carom_fair_series(room, room);
      const [first = 0, second = 0] = Math.max(...needed.sets) > 1 ? needed.sets : needed.games;
      const most = values.CAROM_SERIES_MOST;
      return {
        ...odds,
        score: [odds.score.slice(0, second), odds.score.slice(most, most + first)],
        fair: readStruct<C.Series>(memory, room, "carom_series").games,
      };
    } finally {
      memory.free(room);
    }
  }

  /** The intention of a stroke of a game and the value that it lost, and a drill for it. */
  review(
    table: Table,
    balls: readonly ShotBall[],
    cue: Partial<Cue>,
    call: Call | undefined,
    options: PlanOptions,
  ): Review {
    const memory = this.#memory;
    const { call: callAt, job } = this.#addresses;
    const { size } = layout.carom_review;
    this.writeJob(table, balls, { ...options, cue });
    const room = memory.allocate(size + layout.carom_drill.size);
    try {
      const { ball, pocket } = numbersOf(call);
      memory.i32[callAt / 4] = ball;
      memory.i32[callAt / 4 + 1] = pocket;
      const { cue: played } = this.#host.addresses;
      this.refuse(memory.exports.carom_review_of(job, played, callAt, room), "review");
      const isDirect = memory.exports.carom_drill_of(job, room, room + size) === 0;
      const found = readStruct<C.Review>(memory, room, "carom_review");
      return {
        ...found,
        group: memory.text(
          memory.exports.carom_word_text(values.CAROM_WORDS_PRACTICE, found.group),
        )!,
        kept: found.kept !== 0,
        ...(isDirect && { drill: readStruct<Drill>(memory, room + size, "carom_drill") }),
      };
    } finally {
      memory.free(room);
    }
  }

  /** The breaks that win most often, from played breaks of a rack. */
  bestBreaks(
    rack: RackName,
    table: Table,
    balls: readonly ShotBall[],
    options: BreakOptions,
  ): BreakChoice[] {
    refuseUnknown(options, KEYS.breaks);
    const { breaks = 500, best = 3, gap = 1e-4, seed = 1, cue, player, opponent, shot } = options;
    const most = values.CAROM_BREAK_CHOICES;
    const memory = this.#memory;
    const { addresses } = this.#host;
    const { player: playerAt, opponent: opponentAt } = this.#addresses;
    this.#host.writeLayout(table, balls);
    this.writeCue({ speed: 9, ...cue });
    const memorySize = memory.exports.carom_break_memory();
    const room = memory.allocate(memorySize + BREAK_JOB.size + most * BREAK.size);
    const job = room + memorySize;
    const choices = job + BREAK_JOB.size;
    try {
      setStruct(memory, job, "carom_break_job", {
        table: addresses.table,
        balls: addresses.balls,
        count: balls.length,
        cue: addresses.cue,
        player: this.writePlayer(playerAt, player ?? this.player({}), "player"),
        opponent: opponent ? this.writePlayer(opponentAt, opponent, "opponent") : 0,
        shot: this.#host.writeShotOptions(shot ?? {}),
        rack: value("carom_rack_kind", rack, "rack"),
        gap,
        seed: whole(seed, "seed", Number.MAX_SAFE_INTEGER),
        memory: room,
        memorySize,
      });
      const count = whole(best, "best", most);
      const played = BigInt(whole(breaks, "breaks"));
      const code = memory.exports.carom_break_best(job, played, choices, count);
      if (code === values.CAROM_ERROR_OPTIONS)
        throw new RangeError(
          `breaks, best: at least 16 and 1 to ${most} are needed, and the rack of a game with a break, not ${breaks}, ${best} and ${rack}`,
        );
      this.refuse(code, "rack");
      return Array.from({ length: count }, (_, k) => {
        const choice = readStruct<C.BreakChoice>(
          memory,
          choices + k * BREAK.size,
          "carom_break_choice",
        );
        return { ...choice, aim: names.carom_break_aim[choice.aim]! };
      });
    } finally {
      memory.free(room);
    }
  }

  withErrors(cue: Partial<Cue>, player: Player, seed: number, number: number): Cue {
    const { cue: pointer } = this.#host.addresses;
    this.writePlayer(this.#addresses.player, player, "player");
    this.writeCue(cue);
    this.#memory.exports.carom_player_strike(
      this.#addresses.player,
      BigInt(whole(seed, "seed", Number.MAX_SAFE_INTEGER)),
      BigInt(whole(number, "number")),
      pointer,
    );
    return readStruct<Cue>(this.#memory, pointer, "carom_cue");
  }

  /** Bytes that a plan needs with the options that were written last. */
  memorySize(): number {
    const size = this.#memory.exports.carom_plan_memory(this.#addresses.options);
    if (size === 0) this.#refuseJob();
    return size;
  }

  plan(
    table: Table,
    balls: readonly ShotBall[],
    cues: readonly Partial<Cue>[] | undefined,
    options: PlanOptions,
  ): PlanStroke[] {
    return resultOf(this.think(table, balls, cues, options, 0, 0));
  }

  /**
   * A plan in slices of `slice` events; 0: at once. `leave`: the bounds within which the cue ball
   * was placed for this stroke, a carom_leave.
   */
  *think(
    table: Table,
    balls: readonly ShotBall[],
    cues: readonly Partial<Cue>[] | undefined,
    request: PlanOptions,
    slice: number,
    leave: number,
  ): Generator<undefined, PlanStroke[]> {
    refuseUnknown(request, KEYS.plan);
    const { best = 5, inHand = "no" } = request;
    const options = this.#withCueBall(table, balls, cues, request);
    const memory = this.#memory;
    const most = cues?.length ?? best;
    if (!Number.isInteger(most) || most < 1 || most > 1000)
      throw new RangeError(`${cues ? "cues: there" : "best: it"} must be 1 to 1000, not ${most}`);
    this.writeJob(table, balls, options);
    const size = this.memorySize();
    const room = memory.allocate(size);
    const choices = memory.allocate(most * CHOICE.size);
    const strokes = memory.allocate(most * layout.carom_cue.size);
    try {
      const { corners, found } = this.#addresses;
      for (let begun = false; ; begun = true) {
        const job = this.#writeSlice(table, balls, options, slice, {
          memory: room,
          memorySize: size,
          leave: Math.max(leave, leaveOf(inHand)),
        });
        memory.i32[found / 4] = most;
        let code: number;
        if (begun) code = memory.exports.carom_plan_continue(job, choices, best, found);
        else if (cues !== undefined) {
          for (const [k, cue] of cues.entries())
            writeStruct(
              memory,
              strokes + k * layout.carom_cue.size,
              "carom_cue",
              this.#host.cue(cue),
              `cues[${k}]`,
            );
          code = memory.exports.carom_plan_try(job, strokes, most, choices);
        } else if (inHand === "no") code = memory.exports.carom_plan(job, choices, best, found);
        else {
          const radius = balls[options.cue?.ball ?? 0]!.kind.radius;
          this.#writeBounds(inHand, corners, radius);
          const [low, high] = inHand === "anywhere" ? [0, 0] : [corners, corners + 16];
          code = memory.exports.carom_plan_hand(job, low, high, choices, best, found);
        }
        this.refuse(code, "plan");
        const many = memory.i32[found / 4]!;
        if (many > 0)
          return Array.from({ length: many }, (_, k) => this.readChoice(choices + k * CHOICE.size));
        yield undefined;
      }
    } finally {
      for (const pointer of [room, choices, strokes]) memory.free(pointer);
    }
  }

  /**
   * A complete run-out, and the success rate of played run-outs; in slices of `slice` events, and
   * one slice for each played run-out. 0: at once.
   */
  *sequence(
    table: Table,
    balls: readonly ShotBall[],
    { within = 0.03, plays = 100, ...options }: SequenceOptions,
    slice: number,
  ): Generator<undefined, Sequence> {
    refuseUnknown(options, KEYS.sequence);
    const { inHand = "no" } = options;
    const memory = this.#memory;
    const { exports } = memory;
    this.writeJob(table, balls, options);
    const memorySize = exports.carom_sequence_memory(this.#addresses.options);
    if (memorySize === 0) this.#refuseJob();
    const most = values.CAROM_SEQUENCE_MOST;
    const room = memory.allocate(memorySize);
    const steps = memory.allocate(most * STEP.size);
    try {
      const { counts, found } = this.#addresses;
      const hand = Number(inHand !== "no");
      const more = { memory: room, memorySize, leave: leaveOf(inHand) };
      const write = (): Pointer => this.#writeSlice(table, balls, options, slice, more);
      let code = exports.carom_sequence(write(), hand, within, steps, most, found);
      for (;;) {
        this.refuse(code, "sequence");
        if (memory.i32[found / 4]! > 0) break;
        yield undefined;
        code = exports.carom_sequence_continue(write(), found);
      }
      const strokes = Array.from({ length: memory.i32[found / 4]! }, (_, k) =>
        this.#readStep(steps + k * STEP.size, options, balls),
      );

      let all = 0;
      for (let k = 0; k < whole(plays, "plays"); k++) {
        if (slice > 0) yield undefined;
        setStruct(memory, counts, "carom_sequence_counts", {});
        const code = exports.carom_sequence_play(write(), hand, BigInt(k), 1n, counts);
        this.refuse(code, "sequence");
        all += readStruct<C.SequenceCounts>(memory, counts, "carom_sequence_counts").runs;
      }
      return { strokes, chance: all / plays, plays };
    } finally {
      for (const pointer of [room, steps]) memory.free(pointer);
    }
  }

  #readStep(pointer: Pointer, game: Rules, balls: readonly ShotBall[]): SequenceStroke {
    const memory = this.#memory;
    const corners = (pointer + STEP.offset.zone) / 8;
    return {
      ...readStruct<C.SequenceStroke>(memory, pointer, "carom_sequence_stroke"),
      choice: this.readChoice(pointer + STEP.offset.choice),
      ruling: this.readRuling(pointer + STEP.offset.ruling, game, balls),
      zone: Array.from(
        { length: values.CAROM_ZONE_CORNERS },
        (_, k): Vec2 => [memory.f64[corners + 2 * k]!, memory.f64[corners + 2 * k + 1]!],
      ),
    };
  }

  /**
   * The options with the ball to strike. If the rules let a player strike any ball, and neither the
   * options nor the given strokes name one, it is the ball with which the player wins most often,
   * as in carom_match_plan().
   */
  #withCueBall(
    table: Table,
    balls: readonly ShotBall[],
    cues: readonly Partial<Cue>[] | undefined,
    options: PlanOptions,
  ): PlanOptions {
    if (cues !== undefined) return options;
    const memory = this.#memory;
    const job = this.writeJob(table, balls, options);
    const isAny = memory.i32[(this.#addresses.rules + RULES.offset.anyCueBall) / 4] !== 0;
    if (!isAny || options.opening || options.cue?.ball !== undefined) return options;
    const { found } = this.#addresses;
    let most = -1;
    let cue: Partial<Cue> = { ...options.cue };
    for (const ball of members(inPlay(balls), balls.length)) {
      const struck = { ...options.cue, ball };
      this.writeCue(struck);
      const code = memory.exports.carom_plan_value(job, 0, found);
      const value = memory.f64[found / 8]!;
      if (code < 0 || value <= most) continue;
      most = value;
      cue = struck;
    }
    return { ...options, cue };
  }

  /** Where a cue ball in hand may be put on the table in the module's memory. */
  #writeBounds(inHand: NonNullable<PlanOptions["inHand"]>, pointer: Pointer, radius: number): void {
    const memory = this.#memory;
    const { table } = this.#host.addresses;
    if (typeof inHand === "object") return memory.f64.set(inHand.flat(), pointer / 8);
    const leave = HANDS.lastIndexOf(inHand);
    if (leave < 0)
      throw new TypeError(
        `inHand: it must be the hand of a ruling, ${[...new Set(HANDS)].map((word) => `"${word}"`).join(", ")}, or two corners [[x, y], [x, y]], not ${String(inHand)}`,
      );
    this.refuse(memory.exports.carom_hand_bounds(leave, table, radius, pointer), "inHand");
  }

  /** The names of the rails or pockets of the table in the module's memory. */
  names(kind: "rail" | "pocket", count: number): (string | undefined)[] {
    const { exports } = this.#memory;
    const { table } = this.#host.addresses;
    return Array.from({ length: count }, (_, k) =>
      this.#memory.text(
        kind === "rail" ? exports.carom_rail_name(table, k) : exports.carom_pocket_name(table, k),
      ),
    );
  }

  aim(
    table: Table,
    balls: readonly ShotBall[],
    cue: Partial<Cue>,
    { ball, pocket = -1, via = [] }: AimOf,
    options: ShotOptions,
  ): Aim {
    const { addresses } = this.#host;
    const memory = this.#memory;
    const { pot } = this.#addresses;
    this.#host.writeLayout(table, balls);
    this.writeCue(cue);
    const shot = this.#host.writeShotOptions(options);

    // The ball, the pocket and the way, by their names or indices.
    const rails = this.names("rail", table.rails.length);
    const pockets = this.names("pocket", table.pockets.length);
    if (via.length > values.CAROM_VIA_MOST)
      throw new RangeError(`via: at most ${values.CAROM_VIA_MOST}, not ${via.length}`);
    memory.u8.fill(0, pot, pot + POT.size);
    const write = (offset: number, number: number): void =>
      void (memory.i32[(pot + offset) / 4] = number);
    write(POT.offset.ball, ball);
    write(
      POT.offset.pocket,
      typeof pocket === "string" ? indexOf(pockets, pocket, "pocket") : pocket,
    );
    write(POT.offset.vias, via.length);
    for (const [k, stop] of via.entries()) {
      const part = POT.offset.via + k * PART.size;
      write(
        part + PART.offset.kind,
        typeof stop === "string" ? values.CAROM_PART_RAIL : values.CAROM_PART_BALL,
      );
      write(
        part + PART.offset.index,
        typeof stop === "string" ? indexOf(rails, stop, "via") : stop,
      );
    }
    this.refuse(
      memory.exports.carom_aim(
        addresses.table,
        addresses.balls,
        balls.length,
        shot,
        pot,
        addresses.cue,
      ),
      "aim",
    );

    const {
      outcome,
      elevation,
      cut,
      margin,
      phi,
      speed,
      met: contact,
    } = readStruct<C.Pot>(memory, pot, "carom_pot");
    const word = names.carom_pot_outcome[outcome]!;
    const { type, a, b } = contact;
    return {
      outcome: word,
      cue: readStruct<Cue>(memory, addresses.cue, "carom_cue"),
      elevation,
      cut,
      margin,
      phi,
      speed,
      ...(word === "barred" || word === "short"
        ? { met: { type: names.carom_event_type[type] as EventType, a, b } }
        : {}),
    };
  }

  /** Aims at a ball without a pocket, at each of the cuts. */
  aimByCut(
    table: Table,
    balls: readonly ShotBall[],
    cue: Partial<Cue>,
    ball: number,
    cuts: readonly number[],
    options: ShotOptions,
  ): Hit[] {
    const { addresses } = this.#host;
    const memory = this.#memory;
    const { pot } = this.#addresses;
    this.#host.writeLayout(table, balls);
    const struck = this.writeCue(cue);
    const shot = this.#host.writeShotOptions(options);
    whole(ball, "ball", balls.length - 1);
    if (struck.ball === ball)
      throw new RangeError(`ball: ${ball} is the cue ball; it must be another one`);
    if (balls[ball]!.state.label === "pocketed")
      throw new RangeError(`ball: ${ball} is pocketed; it must be on the table`);
    const wrong = cuts.find((cut) => !(Math.abs(cut) < 90));
    if (wrong !== undefined)
      throw new RangeError(`cut: it must be above -90 and below 90 degrees, not ${wrong}`);
    return cuts.map((cut, k) => {
      this.writeCue(struck);
      setStruct(memory, pot, "carom_pot", { ball, pocket: values.CAROM_POT_NO_POCKET, cut });
      const code = memory.exports.carom_aim(
        addresses.table,
        addresses.balls,
        balls.length,
        shot,
        pot,
        addresses.cue,
      );
      this.refuse(code, "aim");
      const found = readStruct<C.Pot>(memory, pot, "carom_pot");
      if (found.outcome !== values.CAROM_POT_FALLS)
        throw new RangeError(
          `cut${cuts.length > 1 ? `[${k}]` : ""}: no aim at ball ${ball} with a cut of ${cut} degrees: ${whyNoAim(found, struck.ball)}`,
        );
      return {
        cue: readStruct<Cue>(memory, addresses.cue, "carom_cue"),
        cut,
        elevation: found.elevation,
      };
    });
  }

  targets(game: Partial<GameState>, balls: readonly ShotBall[]): number[] {
    this.#writeRules(game, balls);
    // A function of the rules, by the module's table of functions.
    const targetsOf = this.#memory.exports.__indirect_function_table.get(
      this.#memory.u32[(this.#addresses.rules + RULES.offset.on) / 4]!,
    ) as Method;
    const set = targetsOf(this.#addresses.rules + RULES.offset.state, inPlay(balls));
    this.customRules.check();
    return members(set, balls.length);
  }

  referee(
    table: Table,
    balls: readonly ShotBall[],
    cue: Partial<Cue>,
    game: Partial<GameState>,
    call: Call | undefined,
    options: ShotOptions,
  ): Ruling {
    const { addresses } = this.#host;
    const memory = this.#memory;
    // The shot once more, with its facts.
    this.#host.writeLayout(table, balls);
    const struck = this.writeCue(cue);
    const optionsAt = this.#host.writeShotOptions(options);
    this.#host.writeShot();
    const code =
      call === "pass"
        ? -1
        : memory.exports.carom_shoot(
            addresses.table,
            addresses.balls,
            balls.length,
            addresses.cue,
            optionsAt,
            addresses.shot,
          );
    return this.rule(balls, code < 0 ? 0 : addresses.shot, game, call, struck.ball);
  }

  /**
   * The ruling of a shot that is in the module's memory with its table, balls, facts and final
   * states; 0: no shot was played.
   */
  rule(
    balls: readonly ShotBall[],
    shot: Pointer,
    game: Partial<GameState>,
    call: Call | undefined,
    cueBall: number,
  ): Ruling {
    const { addresses } = this.#host;
    const memory = this.#memory;
    const { call: callAt, rules, ruling } = this.#addresses;
    this.#writeRules(game, balls);
    const { ball, pocket } = numbersOf(call);
    memory.i32[callAt / 4] = ball;
    memory.i32[callAt / 4 + 1] = pocket;
    this.refuse(
      memory.exports.carom_referee(
        rules,
        addresses.table,
        addresses.balls,
        balls.length,
        cueBall,
        shot,
        callAt,
        ruling,
      ),
      "balls",
    );
    return this.readRuling(ruling, game, balls);
  }

  /** A carom_ruling in the module's memory; `balls` provide the values that it does not change. */
  readRuling(ruling: Pointer, game: Rules, balls: readonly ShotBall[]): Ruling {
    const memory = this.#memory;
    const { text } = this.#addresses;
    memory.exports.carom_ruling_string(ruling, text, 256);
    const turn = readStruct<Omit<C.Turn, "outcome" | "leave"> & { outcome: number; leave: number }>(
      memory,
      ruling + RULING.turn,
      "carom_turn",
    );
    const reason = names.carom_foul[turn.foul]!;
    const state = this.readState(ruling + RULING.state, game);
    const { score, lost } = readStruct<C.RulesState>(
      memory,
      ruling + RULING.state,
      "carom_rules_state",
    );
    return {
      turn: names.carom_turn_outcome[turn.outcome]!,
      foul: reason !== "none",
      reason,
      why: memory.text(memory.exports.carom_word_text(values.CAROM_WORDS_FOUL, turn.foul)) ?? "",
      hand: HANDS[turn.leave]!,
      points: turn.points,
      words: memory.text(text)!,
      score: [score[0] - lost[0], score[1] - lost[1]],
      facts: readFacts(memory, ruling + RULING.facts, balls.length),
      balls: readBalls(memory, ruling + RULING.balls, balls.length).map((ball, k) => ({
        ...balls[k],
        ...ball,
      })),
      put: members(memory.u32[(ruling + RULING.put) / 4]!, balls.length),
      game: state,
    };
  }

  /**
   * A carom_rules_state in the module's memory; or one that is written there after it was checked.
   */
  readState(pointer: Pointer, { rules = "eightball", own: custom }: Rules): GameState {
    const {
      group,
      opening,
      may: permitted,
      ...state
    } = readStruct<C.RulesState & { group: number }>(this.#memory, pointer, "carom_rules_state");
    return {
      rules,
      group: names.carom_group[group]!,
      opening: opening !== 0,
      may: MAY.filter((_, k) => (permitted >> k) & 1),
      ...(custom ? { own: custom } : fieldsOf(state, MEMBERS)),
      ...this.#wordsOf(pointer, custom !== undefined),
    };
  }

  /** The integers of a state and its seat, for built-in games that use them. */
  #wordsOf(pointer: Pointer, isOwn: boolean): Pick<GameState, "user" | "seat"> {
    const user = this.customRules.user(pointer);
    return isOwn || user.some((word) => word > 0) ? { user: [...user], seat: user.seat } : {};
  }

  writeState(game: Partial<GameState>, balls: readonly ShotBall[]): Pointer {
    this.#writeRules(game, balls);
    return this.#addresses.rules + RULES.offset.state;
  }

  // ---- Structs ----------------------------------------------------------------------------------

  /**
   * Whether the rules use the positions of balls for more than spotting; all their balls are in the
   * list then.
   */
  get #settles(): boolean {
    return this.#memory.u32[(this.#addresses.rules + RULES.offset.settle) / 4] !== 0;
  }

  writePlayer(pointer: Pointer, player: Player, name: string): Pointer {
    writeStruct(this.#memory, pointer, "carom_player", player, name, BOUNDS);
    return pointer;
  }

  #writeRules(game: Partial<GameState>, balls: readonly ShotBall[]): void {
    const { rules = "eightball", group = "open", opening = false, may: permitted = [] } = game;
    const { rules: pointer } = this.#addresses;
    const memory = this.#memory;
    if (game.own) return this.customRules.write(pointer, game.own, game.user ?? [], game.seat);
    refuseOrder(balls, rules);
    const kind = value("carom_rules_kind", rules, "rules");
    memory.exports.carom_plan_rules_of(pointer, kind);
    const last = LAST[rules];
    if (this.#settles && last !== undefined && balls.length <= last)
      throw new TypeError(
        `balls: ${rules} has the cue ball and 1 to ${last}, of which some may be down`,
      );
    const stateAt = pointer + RULES.offset.state;
    const { user = [], seat = 0 } = game;
    const words = {
      group: value("carom_group", group, "group"),
      opening: Number(opening),
      may: permitted.reduce((sum, act) => sum | (1 << indexOf(MAY, act, "may")), 0),
    };
    writeStruct(
      memory,
      stateAt,
      "carom_rules_state",
      {
        ...readStruct<object>(memory, stateAt, "carom_rules_state"),
        ...fieldsOf(game, MEMBERS),
        ...words,
        user: Array(8).fill(0),
        context: 0,
      },
      "game",
    );
    this.customRules.writeUser(stateAt, Object.assign([...user], { seat }), "user");
    const wrong = memory.text(
      memory.exports.carom_rules_fault(kind, stateAt, this.#addresses.found),
    );
    if (wrong !== undefined)
      throw new RangeError(
        `${wrong}: by the rules ${rules} it must be ${memory.text(memory.u32[this.#addresses.found / 4]!)}`,
      );
  }

  /** A goal in the module's memory; 0: none. */
  #writeGoal(goal: PlanOptions["goal"]): Pointer {
    if (!goal) return 0;
    refuseUnknown(goal, KEYS.goal, "goal");
    const { kind, ball = 0, balls = [], place = [0, 0], distance = 0 } = goal;
    const { goal: pointer } = this.#addresses;
    setStruct(this.#memory, pointer, "carom_plan_goal", {
      kind: value("carom_goal_kind", kind, "goal.kind"),
      ball,
      balls: balls.reduce((set, k) => set | (1 << k), 0),
      distance,
    });
    this.#memory.f64.set(place, (pointer + GOAL.offset.place) / 8);
    return pointer;
  }

  writeJob(table: Table, balls: readonly ShotBall[], options: PlanOptions): Pointer {
    const memory = this.#memory;
    const { addresses } = this.#host;
    const { player, opponent, rules, options: optionsAt, job } = this.#addresses;
    this.#host.writeLayout(table, balls);
    this.writeCue(options.cue ?? {});
    this.writePlayer(player, options.player ?? this.player({}), "player");
    const shot = this.#host.writeShotOptions(options.shot ?? {});
    this.#writeRules(options, balls);
    if (options.own?.race === "seats" && !options.own.value)
      throw new TypeError("own: a plan in a race of seats needs value()");
    if (!options.own) refuseLayout(table, balls, options.rules ?? "eightball");
    writeOptions(memory, optionsAt, "carom_plan_options", options);
    if (options.runOut)
      setStruct(memory, optionsAt, "carom_plan_options", { chanceOpponent: 1 }, false);
    if (options.opponent)
      setStruct(
        memory,
        optionsAt,
        "carom_plan_options",
        { opponent: this.writePlayer(opponent, options.opponent, "opponent") },
        false,
      );
    return setStruct(memory, job, "carom_plan_job", {
      table: addresses.table,
      balls: addresses.balls,
      cue: addresses.cue,
      player,
      rules,
      shot,
      options: optionsAt,
      count: balls.length,
      goal: this.#writeGoal(options.goal),
    });
  }

  /** The job of a slice: other calls since the last one have used the memory of arguments. */
  #writeSlice(
    table: Table,
    balls: readonly ShotBall[],
    options: PlanOptions,
    slice: number,
    more: { memory: Pointer; memorySize: number; leave: number },
  ): Pointer {
    const job = this.writeJob(table, balls, options);
    setStruct(this.#memory, this.#addresses.options, "carom_plan_options", { slice }, false);
    return setStruct(this.#memory, job, "carom_plan_job", more, false);
  }

  readChoice(pointer: Pointer): PlanStroke {
    const { kind, ...choice } = readStruct<C.PlanStroke>(
      this.#memory,
      pointer,
      "carom_plan_stroke",
    );
    return { ...choice, kind: names.carom_plan_kind[kind]! };
  }
}

function inPlay(balls: readonly ShotBall[]): number {
  return (
    balls.reduce(
      (set, { state }, k) =>
        state.label === "pocketed" || state.label === "off" ? set : set | (1 << k),
      0,
    ) >>> 0
  );
}
