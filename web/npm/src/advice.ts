// Advice for a player, by carom_coach.h: every way to a goal, the reasons for a stroke, the results
// of many breaks, and the strokes of matches that cost a player most. `carom ways`, `carom plan
// --why`, `carom break` and `carom practice` print the same.
import { layout, names, values } from "./generated/layout.js";
import type * as C from "./generated/structs.js";
import { KEYS, refuseUnknown, stopsOf } from "./keys.js";
import type { Match } from "./match.js";
import type { Memory, Pointer } from "./memory.js";
import type { Host as PlanHost, Plans } from "./plans.js";
import { indexOf, readStruct, setStruct, value, whole, writeStruct } from "./structs.js";
import type {
  Breaks,
  BreaksOptions,
  Cue,
  PlanOptions,
  PlanStroke,
  Practice,
  PracticeOptions,
  RackName,
  Reviewed,
  ShotBall,
  Table,
  Way,
  WayGoal,
  Ways,
  WaysOptions,
  Why,
} from "./types.js";

const WAY = layout.carom_shot_way;
const WAYS_JOB = layout.carom_ways_job;
const WAYS = layout.carom_ways_result;
const CUE = layout.carom_cue;
const WHY = layout.carom_why;
const CHOICE = layout.carom_plan_stroke;
const BREAK_JOB = layout.carom_break_job;
const COUNTS = layout.carom_break_counts;

/** Directions of all strokes together, and of each: steps of 0.2 degrees find windows of 0.2. */
const SCANNED = 20_000;
const SCANNED_EACH = 1800;
const SCANNED_TO_SCORE = 100_000;
const WAYS_MOST = 1000;

/** The functions of the library that this file uses. */
export interface Host extends PlanHost {
  /** Throws the error of a shot whose arguments were refused. */
  refuseShot(code: number, balls: number, options: Pointer, field: string): void;
  /** A match whose lines are read. */
  match(): Match;
}

export class Advice {
  readonly #host: Host;
  readonly #plans: Plans;
  readonly #player: Pointer;
  readonly #opponent: Pointer;

  constructor(host: Host, plans: Plans) {
    this.#host = host;
    this.#plans = plans;
    this.#player = host.memory.allocate(layout.carom_player.size);
    this.#opponent = host.memory.allocate(layout.carom_player.size);
  }

  get #memory(): Memory {
    return this.#host.memory;
  }

  /** Memory for parts of these sizes, while a function runs. */
  #using<T>(sizes: readonly number[], run: (...pointers: Pointer[]) => T): T {
    const pointers = sizes.map((size) => this.#memory.allocate(size));
    try {
      return run(...pointers);
    } finally {
      for (const pointer of pointers) this.#memory.free(pointer);
    }
  }

  // ---- Ways

  ways(
    table: Table,
    balls: readonly ShotBall[],
    cues: readonly Partial<Cue>[],
    options: WaysOptions,
  ): Ways {
    refuseUnknown(options, KEYS.ways);
    if (cues.length === 0) throw new RangeError("cues: at least one is needed");
    const { rails = 2, place, radius = 0.15, each = false, player, most = 100, shot } = options;
    const goal = value("carom_way_goal", options.goal ?? usualGoal(table, balls), "goal");
    if (goal === values.CAROM_WAY_PLACE && place === undefined)
      throw new TypeError('place: the goal "place" needs where the cue ball is to come to rest');
    const usualScan =
      goal === values.CAROM_WAY_POT
        ? Math.max(SCANNED, SCANNED_EACH * cues.length)
        : SCANNED_TO_SCORE;
    const room = whole(most, "most", WAYS_MOST);
    if (room < 1) throw new RangeError("most: at least 1 is needed, not 0");
    const memory = this.#memory;
    const { addresses } = this.#host;
    this.#host.writeLayout(table, balls);
    const pocketNames = this.#plans.names("pocket", table.pockets.length);
    const railNames = this.#plans.names("rail", table.rails.length);
    const pocket =
      typeof options.pocket === "string"
        ? indexOf(pocketNames, options.pocket, "pocket")
        : options.pocket;
    const memorySize = memory.exports.carom_ways_memory(BigInt(room));
    const sizes = [memorySize, WAYS_JOB.size, cues.length * CUE.size, room * WAY.size, WAYS.size];
    return this.#using(sizes, (search, job, strokes, found, result) => {
      cues.forEach((cue, k) =>
        writeStruct(
          memory,
          strokes! + k * CUE.size,
          "carom_cue",
          this.#host.cue(cue),
          `cues[${k}]`,
        ),
      );
      const shotAt = this.#host.writeShotOptions(shot ?? {});
      setStruct(memory, job!, "carom_ways_job", {
        table: addresses.table,
        balls: addresses.balls,
        count: balls.length,
        cues: strokes,
        strokes: cues.length,
        player: this.#plans.writePlayer(this.#player, player ?? this.#plans.player({}), "player"),
        shot: shotAt,
        scan: options.scan === undefined ? usualScan : whole(options.scan, "scan"),
        goal,
        ball: options.ball === undefined ? -1 : whole(options.ball, "ball", balls.length - 1),
        pocket: pocket === undefined ? -1 : whole(pocket, "pocket", table.pockets.length - 1),
        rails: whole(rails, "rails", values.CAROM_WAY_PARTS),
        each: Number(each),
        radius: place === undefined ? 0 : radius,
        memory: search,
        memorySize,
      });
      if (place) memory.f64.set(place, (job! + WAYS_JOB.offset.place) / 8);
      const code = memory.exports.carom_ways(job!, found!, BigInt(room), result!);
      this.#host.refuseShot(code, balls.length, shotAt, "cues");
      const counts = readStruct<C.WaysResult>(memory, result!, "carom_ways_result");
      const read = Array.from({ length: counts.ways }, (_, k) =>
        readStruct<C.ShotWay>(memory, found! + k * WAY.size, "carom_shot_way"),
      );
      return {
        ways: read.map(wayOf),
        parts: read.map(({ part, parts }) =>
          part
            .slice(0, parts)
            .map(({ kind, index }) =>
              Number(kind) === values.CAROM_PART_BALL
                ? index
                : (railNames[index] ?? `rail ${index}`),
            ),
        ),
        scanned: counts.scanned,
        good: counts.good,
        leftOut: counts.leftOut,
      };
    });
  }

  // ---- Reasons

  why(table: Table, balls: readonly ShotBall[], choice: PlanStroke, options: PlanOptions): Why {
    refuseUnknown(options, KEYS.plan);
    if (choice.kind === "pass")
      throw new RangeError("choice: it is to pass, which has no stroke to explain");
    const memory = this.#memory;
    const { exports } = memory;
    const railNames = (): (string | undefined)[] => this.#plans.names("rail", table.rails.length);
    const job = this.#plans.writeJob(table, balls, { ...options, cue: choice.cue });
    const memorySize = this.#plans.memorySize();
    return this.#using([memorySize, CHOICE.size, WHY.size, 512], (search, stroke, found, text) => {
      setStruct(memory, job, "carom_plan_job", { memory: search, memorySize }, false);
      const kind = value("carom_plan_kind", choice.kind, "choice.kind");
      const numbers = { ...choice, kind };
      writeStruct(memory, stroke!, "carom_plan_stroke", numbers, "choice");
      this.#plans.refuse(exports.carom_why_of(job, stroke!, found!), "choice");
      exports.carom_ruling_string(found! + WHY.offset.ruling, text!, 512);
      const why = readStruct<C.Why>(memory, found!, "carom_why");
      const [aim, speed, tip, eye] = why.cost as [number, number, number, number];
      return {
        rails: why.rail.slice(0, why.rails).map((rail) => railNames()[rail] ?? `rail ${rail}`),
        first: why.first < 0 ? undefined : why.first,
        cut: why.cut,
        part: why.part,
        speed: why.speed,
        words: memory.text(text!)!,
        leave: why.leave,
        next: why.hasNext === 0 ? undefined : this.#plans.readChoice(found! + WHY.offset.next),
        value: why.value,
        misses: why.misses,
        loses: why.loses,
        opponent: why.opponent,
        flawlessValue: why.flawlessValue,
        cost: { aim, speed, tip, eye },
      };
    });
  }

  // ---- Breaks

  breaks(rack: RackName, table: Table, balls: readonly ShotBall[], options: BreaksOptions): Breaks {
    refuseUnknown(options, KEYS.manyBreaks);
    const { aim = "full", racks = 500, gap = 1e-4, seed = 1, player, opponent } = options;
    const many = whole(racks, "racks");
    if (many < 1) throw new RangeError("racks: at least 1 is needed, not 0");
    const kind = value("carom_rack_kind", rack, "rack");
    const memory = this.#memory;
    const { exports } = memory;
    const { addresses } = this.#host;
    this.#host.writeLayout(table, balls);
    this.#plans.writeCue({ speed: 9, ...options.cue });
    const memorySize = exports.carom_break_memory();
    return this.#using(
      [memorySize, BREAK_JOB.size, COUNTS.size, 16],
      (room, job, counts, place) => {
        const shot = this.#host.writeShotOptions(options.shot ?? {});
        setStruct(memory, job!, "carom_break_job", {
          table: addresses.table,
          balls: addresses.balls,
          count: balls.length,
          cue: addresses.cue,
          player: this.#plans.writePlayer(this.#player, player ?? this.#plans.player({}), "player"),
          opponent:
            opponent === undefined
              ? 0
              : this.#plans.writePlayer(this.#opponent, opponent, "opponent"),
          shot,
          rack: kind,
          aim: value("carom_break_aim", aim, "aim"),
          gap,
          seed: whole(seed, "seed", Number.MAX_SAFE_INTEGER),
          memory: room,
          memorySize,
        });
        const code = exports.carom_break_play(job!, 0n, BigInt(many), counts!);
        this.#host.refuseShot(code, balls.length, shot, "rack");
        const spread = exports.carom_break_spread(counts!, place!);
        const hasRules = exports.carom_break_has_rules(kind) !== 0;
        return {
          ...sharesOf(
            readStruct<C.BreakCounts>(memory, counts!, "carom_break_counts"),
            many,
            hasRules,
          ),
          fell: this.#fell(counts! + COUNTS.offset.fell, balls.length, table.pockets.length, many),
          place: [memory.f64[place! / 8]!, memory.f64[place! / 8 + 1]!],
          spread,
        };
      },
    );
  }

  /** How often each ball fell into each pocket. */
  #fell(pointer: Pointer, balls: number, pockets: number, many: number): number[][] {
    const first = pointer / 8;
    return Array.from({ length: balls }, (_, ball) =>
      Array.from(
        { length: pockets },
        (_, pocket) =>
          Number(this.#memory.i64[first + ball * values.CAROM_POCKETS_MOST + pocket]) / many,
      ),
    );
  }

  // ---- Practice

  practice(
    recording: string | Iterable<string>,
    seat: number | string | undefined,
    options: PracticeOptions,
  ): Practice[] {
    refuseUnknown(options, KEYS.practice);
    const groups = new Map<string, Reviewed[]>();
    for (const stroke of this.#strokesOf(recording, seat, options)) {
      const { group } = stroke.review;
      groups.set(group, [...(groups.get(group) ?? []), stroke]);
    }
    return [...groups]
      .map(([group, strokes]) => practiceOf(group, strokes))
      .sort((a, b) => b.missCost + b.placeCost - (a.missCost + a.placeCost));
  }

  /** The reviewed strokes of a seat. */
  #strokesOf(
    recording: string | Iterable<string>,
    seat: number | string | undefined,
    { player, opponent, seed }: PracticeOptions,
  ): Reviewed[] {
    const lines = typeof recording === "string" ? recording.split("\n") : [...recording];
    const match = this.#host.match();
    const known = new Set<string>();
    const found: Reviewed[] = [];
    try {
      lines.forEach((line, k) => {
        const isBegun = match.phase !== "none";
        const strokes = isBegun ? match.shots : 0;
        const earlier = isBegun ? match.copy() : undefined;
        try {
          match.read(line);
          if (match.phase !== "none")
            for (const { name } of match.seats) if (name !== "") known.add(name);
          if (earlier === undefined || match.shots === strokes || earlier.phase === "moving")
            return;
          const mover = earlier.seat;
          if (seat !== undefined && seat !== mover && seat !== earlier.seats[mover]!.name) return;
          found.push(this.#reviewed(k + 1, earlier, match.struck, { player, opponent, seed }));
        } finally {
          earlier?.free();
        }
      });
    } finally {
      match.free();
    }
    if (typeof seat === "string" && !known.has(seat))
      throw new TypeError(
        `seat: unknown name ${JSON.stringify(seat)}; the names of the recording are: ${[...known].sort().join(", ") || "none"}`,
      );
    return found;
  }

  #reviewed(line: number, earlier: Match, cue: Cue, players: PracticeOptions): Reviewed {
    const { balls, table, seat, called } = earlier;
    const options: PlanOptions = { ...earlier.game, shot: stopsOf(earlier.options, false) };
    for (const [key, option] of Object.entries(players))
      if (option !== undefined) Object.assign(options, { [key]: option });
    return {
      line,
      seat,
      balls,
      cue,
      review: this.#plans.review(table, balls, cue, called, options),
    };
  }
}

/** A way without what it meets. */
function wayOf({ kind, ...fields }: C.ShotWay): Way {
  const way = Object.fromEntries(
    Object.entries(fields).filter(([key]) => key !== "part" && key !== "parts"),
  ) as Omit<Way, "kind">;
  return kind < 0 ? way : { ...way, kind: names.carom_plan_kind[kind]! };
}

function usualGoal({ pockets }: Table, balls: readonly ShotBall[]): WayGoal {
  if (balls.length === 1) return "place";
  return pockets.length === 0 ? "score" : "pot";
}

/** What the counts of breaks say of each break. */
function sharesOf(
  counts: C.BreakCounts,
  many: number,
  hasRules: boolean,
): Omit<Breaks, "fell" | "place" | "spread"> {
  const byRules = (times: number): number => (hasRules ? times / many : NaN);
  const mean = byRules(counts.wins);
  const variance = Math.max(byRules(counts.winSquares) - mean * mean, 0);
  return {
    breaks: many,
    makes: counts.makes / many,
    balls: counts.balls / many,
    playsOn: byRules(counts.playsOn),
    fouls: byRules(counts.fouls),
    wins: mean,
    error: Math.sqrt(variance / many),
    scratches: counts.scratches / many,
    off: counts.off / many,
    wing: counts.wing / many,
  };
}

const costOf = ({ review }: Reviewed): number => review.missCost + review.placeCost;
const sum = (numbers: readonly number[]): number =>
  numbers.reduce((total, number) => total + number, 0);

/** The sums of a group. */
function practiceOf(group: string, strokes: readonly Reviewed[]): Practice {
  const reviews = strokes.map(({ review }) => review);
  const off = reviews.map((review) => review.off).filter(Number.isFinite);
  const mean = off.length > 0 ? sum(off) / off.length : NaN;
  const squares = off.map((error) => (error - mean) ** 2);
  return {
    group,
    strokes: strokes.length,
    kept: reviews.filter((review) => review.kept).length,
    due: sum(reviews.map(({ told }) => told).filter(Number.isFinite)),
    missCost: sum(reviews.map(({ missCost }) => missCost)),
    placeCost: sum(reviews.map(({ placeCost }) => placeCost)),
    off: mean,
    spread: off.length > 0 ? Math.sqrt(sum(squares) / off.length) : NaN,
    reviewed: [...strokes].sort((a, b) => costOf(b) - costOf(a)),
  };
}
