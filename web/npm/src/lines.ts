// Shots as the JSON lines that `carom shoot` reads and writes: docs/reference/files.md.
import { games, names as NAMES, numbers as NUMBERS } from "./generated/layout.js";
import { KEYS, refuseUnknown } from "./keys.js";
import type { RulesKind } from "./generated/structs.js";
import type { BallKind, Cue, Game, Line, ShotBall, Table, TableName } from "./types.js";

/** The functions of the library that the reader of a line uses. */
interface Library {
  table(name: TableName): Table;
  kind(game: Game): BallKind;
  cue(fields: Partial<Cue>, game: Game): Cue;
}

/** Keys of lines and fields, in the order of the fields. */
const PARAMS: readonly (readonly [string, keyof BallKind])[] = NUMBERS.carom_ball_kind;
const CUE: readonly (readonly [string, Exclude<keyof Cue, "ball">])[] = NUMBERS.carom_cue;

/**
 * The line of a shot, without a line break. `carom shoot` plays it with the same bits under
 * CAROM_ISA=plain.
 */
export function toLine(
  shot: Pick<Line, "tableName" | "balls" | "cue"> & { id?: string; names?: string[] },
): string {
  refuseUnknown(shot, KEYS.line, "shot");
  const names = shot.names ?? shot.balls.map(({ id }, k) => id ?? (k === 0 ? "cue" : String(k)));
  const cue: Record<string, number | string> = {};
  for (const [key, field] of CUE) cue[key] = shot.cue[field];
  cue.ball = names[shot.cue.ball]!;
  const balls = shot.balls.map(({ kind, state }, k) => ({
    id: names[k],
    state: [NAMES.carom_label.indexOf(state.label), ...state.r, ...state.v, ...state.w],
    params: {
      game: "pool",
      ...Object.fromEntries(PARAMS.map(([key, field]) => [key, kind[field]])),
    },
  }));
  return JSON.stringify({ kind: "shot", id: shot.id ?? "shot", table: shot.tableName, cue, balls });
}

function refuse(key: string, right: string): never {
  throw new TypeError(`${key}: ${right}`);
}

function numbers(source: unknown, key: string, count: number): number[] {
  const good =
    Array.isArray(source) &&
    source.length === count &&
    source.every((x) => typeof x === "number" && Number.isFinite(x));
  return good ? (source as number[]) : refuse(key, `${count} numbers are needed`);
}

/** Numbers by their keys; `other` is the key of a value that is not a number. */
function fill<Key extends string>(
  into: Record<Key, number>,
  keys: readonly (readonly [string, Key])[],
  source: Record<string, unknown>,
  nameKey: string,
  name: string,
): void {
  refuseUnknown(source, [...keys.map(([key]) => key), nameKey], name);
  for (const [key, field] of keys) {
    const value = source[key];
    if (value === undefined) continue;
    into[field] =
      typeof value === "number" && Number.isFinite(value)
        ? value
        : refuse(`${name}.${key}`, "a number is needed");
  }
}

/**
 * Reads a line of `carom shoot`, with a built-in table. `carom` is the library that load() returns.
 * Throws a TypeError that names the invalid key.
 */
export function fromLine(carom: Library, text: string): Line {
  let line: Record<string, unknown>;
  try {
    line = JSON.parse(text.trim()) as Record<string, unknown>;
  } catch (error) {
    return refuse("line", `one JSON object is needed (${(error as Error).message})`);
  }
  if (line?.kind !== "shot") return refuse("kind", 'it must be "shot"');
  const tableName = line.table as TableName;
  if (typeof tableName !== "string")
    return refuse("table", "the name of a built-in table is needed");
  const table = carom.table(tableName);
  if (!Array.isArray(line.balls) || line.balls.length < 1 || line.balls.length > 32)
    return refuse("balls", "a list of 1 to 32 balls is needed");
  const names: string[] = [];
  const balls = line.balls.map((ball: Record<string, unknown>, k): ShotBall => {
    const params = (ball.params ?? {}) as Record<string, unknown>;
    names.push(
      typeof ball.id === "string" ? ball.id : refuse(`balls[${k}].id`, "a text is needed"),
    );
    // Missing numbers have the values of the game, or of pooltool, whose friction of spinning
    // depends on the radius.
    const kind = carom.kind((params.game ?? "pooltool_pool") as Game);
    fill(kind as unknown as Record<string, number>, PARAMS, params, "game", `balls[${k}].params`);
    if (params.game === undefined && params.u_sp === undefined)
      kind.muSpin = ((10.0 * 2.0) / 5.0 / 9.0) * kind.radius;
    const [label, x, y, z, ...motion] = numbers(ball.state, `balls[${k}].state`, 10) as [
      number,
      number,
      number,
      number,
      ...number[],
    ];
    return {
      id: names[k]!,
      kind,
      state: {
        label:
          NAMES.carom_label[label] ??
          refuse(`balls[${k}].state`, "the label, its first number, must be 0 to 6"),
        r: [x, y, z],
        v: [motion[0]!, motion[1]!, motion[2]!],
        w: [motion[3]!, motion[4]!, motion[5]!],
      },
    };
  });
  const fields = (line.cue ?? {}) as Record<string, unknown>;
  const ball = fields.ball === undefined ? 0 : names.indexOf(fields.ball as string);
  if (ball < 0)
    return refuse("cue.ball", `it must be the id of a ball, not ${JSON.stringify(fields.ball)}`);
  const cue = carom.cue({ ball, phi: 0 }, "pooltool_pool");
  fill(cue as unknown as Record<string, number>, CUE, fields, "ball", "cue");
  // A strike must specify b, because the cue's default b is not the centre.
  if (fields.b === undefined && Object.keys(fields).some((key) => key !== "ball"))
    return refuse(
      "cue.b",
      "how far above the centre the tip touches, in radii, is missing; 0 is the centre",
    );
  return {
    id: typeof line.id === "string" ? line.id : "shot",
    tableName,
    table,
    names,
    balls,
    cue,
  };
}

/** The highest number of a ball, for the games whose rules identify balls by their numbers. */
export const LAST: Partial<Record<RulesKind, number>> = Object.fromEntries(
  Object.entries(games).flatMap(([name, { last }]) => (last > 0 ? [[name, last]] : [])),
);
const COLOURS = ["yellow", "green", "brown", "blue", "pink", "black"] as const;

/** The number of a ball by its name in a line; 0 for a ball without a number. */
function numberOf(name: string, rules: RulesKind): number {
  const colour = rules === "snooker" ? (COLOURS as readonly string[]).indexOf(name) : -1;
  if (colour >= 0) return 16 + colour;
  const digits = rules === "snooker" ? name.replace(/^red/, "") : name;
  return /^\d+$/.test(digits) ? Number(digits) : 0;
}

/**
 * The layout of a line in the form that plans and rulings require: ball k of the list is ball k of
 * the game, and missing balls are down. Throws a TypeError if the names are not the cue ball and
 * numbers of the game, each once.
 */
export function byNumber(line: Line, rules: RulesKind): Line {
  const last = LAST[rules];
  if (last === undefined) return line;
  const slots = Array<number | undefined>(last + 1);
  for (const [k, name] of line.names.entries()) {
    const number = k === line.cue.ball ? 0 : numberOf(name, rules);
    if ((number === 0 && k !== line.cue.ball) || number > last || slots[number] !== undefined)
      return refuse(
        `balls[${k}].id`,
        `the balls of ${rules} are the cue ball and 1 to ${last}, each once, not ${JSON.stringify(name)}`,
      );
    slots[number] = k;
  }
  const balls = Array.from(slots, (k, number): ShotBall => {
    if (k !== undefined)
      return { ...line.balls[k]!, id: number === 0 ? line.names[k]! : String(number) };
    return {
      id: String(number),
      kind: line.balls[line.cue.ball]!.kind,
      state: { r: [0, 0, -0.1], v: [0, 0, 0], w: [0, 0, 0], label: "pocketed" },
    };
  });
  return { ...line, balls, names: balls.map(({ id }) => id!), cue: { ...line.cue, ball: 0 } };
}

/** Rejects a layout whose named balls are not in the order of the game's numbers. */
export function refuseOrder(balls: readonly ShotBall[], rules: RulesKind): void {
  if (LAST[rules] === undefined) return;
  for (const [k, { id }] of balls.entries())
    if (k > 0 && id !== undefined && numberOf(id, rules) !== k)
      refuse(
        `balls[${k}].id`,
        `ball ${k} of ${rules} belongs here, not ${JSON.stringify(id)}; byNumber(line, "${rules}") puts the balls in order`,
      );
}
