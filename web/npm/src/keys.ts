// The keys of objects that users pass: the error for an unknown key names it, and the key that was
// probably meant.
import { numbers, options } from "./generated/layout.js";
import type { PlanOptions as PlanRows } from "./generated/structs.js";
import type {
  AimOf,
  BreaksOptions,
  CutOf,
  FirstOptions,
  GameState,
  Goal,
  Impact,
  Line,
  MatchOptions,
  Motion,
  OwnTurn,
  PlanOptions,
  PracticeOptions,
  RackOptions,
  ShotBall,
  WaysOptions,
} from "./types.js";

/** The keys of an interface; the compiler rejects a list that lacks one or has another. */
const keysOf = <T>(keys: Record<keyof T, 1>): readonly string[] => Object.keys(keys);

const GAME: Record<keyof GameState, 1> = {
  rules: 1,
  group: 1,
  opening: 1,
  fouls: 1,
  score: 1,
  lost: 1,
  pocket: 1,
  may: 1,
  on: 1,
  freeBall: 1,
  target: 1,
  innings: 1,
  own: 1,
  user: 1,
  seat: 1,
};
const optionKeys = (struct: keyof typeof options): string[] =>
  options[struct].map(({ key }) => key);

/** The keys of plans and of run-outs. */
const PLAN = [
  ...optionKeys("carom_plan_options"),
  ...keysOf<Omit<PlanOptions, keyof PlanRows | "goal" | "best">>({
    player: 1,
    opponent: 1,
    inHand: 1,
    runOut: 1,
    cue: 1,
    shot: 1,
    ...GAME,
  }),
];

/** The keys of the objects that are not structs of C. */
export const KEYS = {
  impact: keysOf<Impact>({ a: 1, b: 1, muBall: 1, restitution: 1 }),
  collide: optionKeys("carom_options"),
  cushion: optionKeys("carom_cushion_options"),
  motion: keysOf<Motion & { status: string }>({ v: 1, w: 1, status: 1 }),
  ball: keysOf<ShotBall>({ kind: 1, state: 1, id: 1 }),
  table: [...numbers.carom_table.map(([, field]) => field), "rails", "jaws", "pockets"],
  stop: options.carom_shot_options.filter(({ stop }) => stop).map(({ key }) => key),
  shot: optionKeys("carom_shot_options"),
  line: keysOf<Line>({ id: 1, tableName: 1, table: 1, names: 1, balls: 1, cue: 1 }),
  game: keysOf<GameState>(GAME),
  turn: keysOf<OwnTurn>({ turn: 1, leave: 1, reason: 1, spot: 1, points: 1 }),
  match: keysOf<MatchOptions>({
    seed: 1,
    side: 1,
    seats: 1,
    alternate: 1,
    limits: 1,
    set: 1,
    balls: 1,
    hand: 1,
    shot: 1,
  }),
  aim: keysOf<AimOf & CutOf>({ ball: 1, pocket: 1, via: 1, cut: 1 }),
  first: keysOf<FirstOptions>({ ball: 1, after: 1 }),
  ways: keysOf<WaysOptions>({
    goal: 1,
    ball: 1,
    pocket: 1,
    rails: 1,
    place: 1,
    radius: 1,
    each: 1,
    player: 1,
    scan: 1,
    most: 1,
    shot: 1,
  }),
  manyBreaks: keysOf<BreaksOptions>({
    aim: 1,
    racks: 1,
    gap: 1,
    seed: 1,
    cue: 1,
    player: 1,
    opponent: 1,
    shot: 1,
  }),
  practice: keysOf<PracticeOptions>({ player: 1, opponent: 1, seed: 1 }),
  goal: keysOf<Goal>({ kind: 1, ball: 1, balls: 1, place: 1, distance: 1 }),
  plan: [...PLAN, "goal", "best"],
  sequence: PLAN.filter((key) => key !== "safeties"),
  breaks: ["breaks", "best", "gap", "seed", "cue", "player", "opponent", "shot"],
  series: ["ratings", "games", "sets", "order", "side", "breakPoints"],
  player: ["errors", "fargo", "rules"],
  rack: keysOf<RackOptions>({ gap: 1, seed: 1, cueBall: 1 }),
  polygon: ["noseHeight", "jawRadius", "ballRadius"],
  corner: ["x", "y", "mouth"],
  room: ["room"],
  build: ["build"],
} as const;

/** The options of a shot that stop it, or those that do not. */
export function stopsOf<T extends object>(options: T, areStops = true): Partial<T> {
  const stops: readonly string[] = KEYS.stop;
  return Object.fromEntries(
    Object.entries(options).filter(([key]) => stops.includes(key) === areStops),
  ) as Partial<T>;
}

/**
 * The number of letters that must be inserted, deleted, replaced or exchanged with the next one to
 * turn one word into the other.
 */
function distance(a: string, b: string): number {
  const rows = [Array.from({ length: b.length + 1 }, (_, k) => k)];
  for (let i = 1; i <= a.length; i++) {
    const row = [i];
    rows[i] = row;
    for (let k = 1; k <= b.length; k++) {
      row[k] = Math.min(
        row[k - 1]! + 1,
        rows[i - 1]![k]! + 1,
        rows[i - 1]![k - 1]! + (a[i - 1] === b[k - 1] ? 0 : 1),
      );
      if (a[i - 1] === b[k - 2] && a[i - 2] === b[k - 1])
        row[k] = Math.min(row[k]!, rows[i - 2]![k - 2]! + 1);
    }
  }
  return rows[a.length]![b.length]!;
}

/**
 * `; did you mean "speed"?` if one of the names resembles the word, otherwise "". Capitals and
 * underscores are ignored.
 */
export function meant(word: string, names: readonly string[]): string {
  const letters = (name: string): string => name.toLowerCase().replaceAll("_", "");
  const letterOrder = letters(word);
  const apart = (name: string): number => {
    const candidate = letters(name);
    const within =
      Math.min(candidate.length, letterOrder.length) > 3 &&
      (candidate.includes(letterOrder) || letterOrder.includes(candidate));
    return within
      ? Math.min(1, distance(candidate, letterOrder))
      : distance(candidate, letterOrder);
  };
  const [nearest] = [...names].sort((a, b) => apart(a) - apart(b));
  const isNear =
    nearest !== undefined &&
    apart(nearest) < letterOrder.length &&
    apart(nearest) <= Math.max(1, letterOrder.length / 3);
  return isNear ? `; did you mean "${nearest}"?` : "";
}

/**
 * Throws if an object has an unknown key. `name` is the name of the object, such as "cue".
 */
export function refuseUnknown(source: object, known: readonly string[], name = ""): void {
  if (typeof source !== "object" || source === null)
    throw new TypeError(`${name || "options"}: an object is needed, not ${String(source)}`);
  for (const key in source)
    if (!known.includes(key))
      throw new TypeError(
        `${name && `${name}.`}${key}: there is no such key${meant(key, known) || `; there are ${known.join(", ")}`}`,
      );
}
