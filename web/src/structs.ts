// Objects to structs in the module's memory, and back.
import { layout, values } from "./generated/layout.js";
import type { Memory, Pointer } from "./memory.js";
import type { BallKind, BallState, Cue, Label, Motion, ShotBall, ShotEvent, Table, Vec3 } from "./types.js";

export type StructName = keyof typeof layout;

/** The value of an enumerator from the end of its name: value("CAROM_CUSHION_", "han", "model"). */
export function value(prefix: string, name: string, option: string): number {
  const found = (values as Record<string, number>)[prefix + name.toUpperCase()];
  if (found !== undefined && name === name.toLowerCase()) return found;
  // CAROM_CUSHION_ is the beginning of other lists too: a name of one's own has one word, but for games.
  const names = Object.keys(values)
    .filter((key) => key.startsWith(prefix) && (prefix === "CAROM_GAME_" || !key.slice(prefix.length).includes("_")))
    .map((key) => key.slice(prefix.length).toLowerCase());
  throw new TypeError(`${option}: it must be one of ${names.join(", ")}, not ${JSON.stringify(name)}`);
}

/** Where the doubles of each struct are: for each field its offset and how many numbers it has. */
const FIELDS = Object.fromEntries(
  Object.entries(layout).map(([struct, { offset, bytes }]) => [
    struct,
    new Map(Object.entries(offset).map(([key, begin]) => [key, { begin, size: (bytes as Record<string, number>)[key]! / 8 }])),
  ]),
) as Record<StructName, Map<string, { begin: number; size: number }>>;

/** A struct of doubles and of arrays of them, from an object whose keys are the fields; what is missing stays. */
export function writeDoubles(memory: Memory, at: Pointer, struct: StructName, from: object): void {
  const fields = FIELDS[struct];
  const f64 = memory.f64;
  for (const key in from) {
    const given = (from as Record<string, unknown>)[key];
    const field = fields.get(key);
    if (field === undefined) throw new TypeError(`${key}: no such field; these are: ${[...fields.keys()].join(", ")}`);
    const index = (at + field.begin) / 8;
    if (typeof given === "number" && field.size === 1) f64[index] = given;
    else if (typeof given === "object" && (given as number[] | null)?.length === field.size)
      for (let k = 0; k < field.size; k++) f64[index + k] = (given as number[])[k]!;
    else if (given !== undefined) throw new TypeError(`${key}: it must be ${field.size === 1 ? "a number" : `${field.size} numbers`}`);
  }
}

export function vec3(f64: Float64Array, at: Pointer): Vec3 {
  const k = at / 8;
  return [f64[k]!, f64[k + 1]!, f64[k + 2]!];
}

export function readMotion(f64: Float64Array, at: Pointer): Motion {
  return { v: vec3(f64, at + layout.carom_motion.offset.v), w: vec3(f64, at + layout.carom_motion.offset.w) };
}

const KIND_FIELDS = Object.entries(layout.carom_ball_kind.offset) as [keyof BallKind, number][];

export function readKind(f64: Float64Array, at: Pointer): BallKind {
  return Object.fromEntries(KIND_FIELDS.map(([key, offset]) => [key, f64[(at + offset) / 8]!])) as unknown as BallKind;
}

/** The labels, by number. */
export const LABELS: readonly Label[] = ["stationary", "spinning", "sliding", "rolling", "pocketed", "airborne", "off"];

const STATE = layout.carom_ball_state.offset;

export function readState(memory: Memory, at: Pointer): BallState {
  const f64 = memory.f64;
  const label = LABELS[memory.i32[(at + STATE.label) / 4]!]!;
  return { r: vec3(f64, at + STATE.r), v: vec3(f64, at + STATE.v), w: vec3(f64, at + STATE.w), label };
}

export function writeBalls(memory: Memory, at: Pointer, balls: readonly ShotBall[]): void {
  const { kind, state } = layout.carom_shot_ball.offset;
  for (const [k, ball] of balls.entries()) {
    const ballAt = at + k * layout.carom_shot_ball.size;
    writeDoubles(memory, ballAt + kind, "carom_ball_kind", ball.kind);
    const { r, v, w, label } = ball.state;
    writeDoubles(memory, ballAt + state, "carom_ball_state", { r, v, w });
    const number = LABELS.indexOf(label ?? "stationary");
    if (number < 0) throw new TypeError(`balls[${k}].state.label: it must be one of ${LABELS.join(", ")}, not ${JSON.stringify(label)}`);
    memory.i64[(ballAt + state + STATE.label) / 8] = BigInt(number);
  }
}

export function readBalls(memory: Memory, at: Pointer, count: number): ShotBall[] {
  const { kind, state } = layout.carom_shot_ball.offset;
  return Array.from({ length: count }, (_, k) => {
    const ball = at + k * layout.carom_shot_ball.size;
    return { kind: readKind(memory.f64, ball + kind), state: readState(memory, ball + state) };
  });
}

const TABLE = layout.carom_table.offset;
const TABLE_NUMBERS = ["width", "length", "ballRadius", "railWidth", "pocketBack"] as const;
const PARTS = [
  ["rails", TABLE.rails, "carom_rail", TABLE.rail, values.CAROM_RAILS_MOST],
  ["jaws", TABLE.jaws, "carom_jaw", TABLE.jaw, values.CAROM_JAWS_MOST],
  ["pockets", TABLE.pockets, "carom_pocket", TABLE.pocket, values.CAROM_POCKETS_MOST],
] as const;

export function writeTable(memory: Memory, at: Pointer, table: Table): void {
  memory.u8.fill(0, at, at + layout.carom_table.size);
  for (const key of TABLE_NUMBERS) memory.f64[(at + TABLE[key]) / 8] = table[key] ?? 0;
  for (const [name, count, struct, first, most] of PARTS) {
    const parts = table[name];
    if (parts.length > most) throw new RangeError(`table.${name}: at most ${most}, not ${parts.length}`);
    memory.i64[(at + count) / 8] = BigInt(parts.length);
    for (const [k, part] of parts.entries()) {
      const partAt = at + first + k * layout[struct].size;
      const { side, ...doubles } = part as { side?: number };
      writeDoubles(memory, partAt, struct, doubles);
      if (struct === "carom_rail") memory.i64[(partAt + layout.carom_rail.offset.side) / 8] = BigInt(side ?? 0);
    }
  }
}

export function readTable(memory: Memory, at: Pointer): Table {
  const f64 = memory.f64;
  const parts = PARTS.map(([name, count, struct, first]) => {
    const { offset, bytes, size } = layout[struct] as { offset: Record<string, number>; bytes: Record<string, number>; size: number };
    const read = (partAt: Pointer): object =>
      Object.fromEntries(
        Object.entries(offset).map(([key, begin]) => {
          const index = (partAt + begin) / 8;
          if (key === "side") return [key, Number(memory.i64[index])];
          return [key, bytes[key] === 8 ? f64[index] : Array.from(f64.subarray(index, index + bytes[key]! / 8))];
        }),
      );
    return [name, Array.from({ length: Number(memory.i64[(at + count) / 8]) }, (_, k) => read(at + first + k * size))];
  });
  const numbers = TABLE_NUMBERS.map((key) => [key, f64[(at + TABLE[key]) / 8]!]);
  return { ...Object.fromEntries(numbers), ...Object.fromEntries(parts) } as Table;
}

export function writeCue(memory: Memory, at: Pointer, cue: Cue): void {
  const { ball, ...doubles } = cue;
  writeDoubles(memory, at, "carom_cue", doubles);
  if (!Number.isSafeInteger(ball)) throw new TypeError(`cue.ball: it must be the index of a ball, not ${ball}`);
  memory.i64[(at + layout.carom_cue.offset.ball) / 8] = BigInt(ball);
}

export function readCue(memory: Memory, at: Pointer): Cue {
  const cue = Object.entries(layout.carom_cue.offset).map(([key, offset]) => {
    const index = (at + offset) / 8;
    return [key, key === "ball" ? Number(memory.i64[index]) : memory.f64[index]!];
  });
  return Object.fromEntries(cue) as unknown as Cue;
}

const EVENT = layout.carom_event.offset;

export function readEvent(memory: Memory, at: Pointer, typeName: (type: number) => string): ShotEvent {
  const i32 = memory.i32;
  const type = i32[(at + EVENT.type) / 4]!;
  const sides = type === values.CAROM_EVENT_BALL_BALL ? 2 : 1;
  const states = (begin: number): BallState[] =>
    Array.from({ length: sides }, (_, k) => readState(memory, at + begin + k * layout.carom_ball_state.size));
  return {
    time: memory.f64[(at + EVENT.time) / 8]!,
    type: typeName(type),
    a: i32[(at + EVENT.a) / 4]!,
    b: i32[(at + EVENT.b) / 4]!,
    before: states(EVENT.before),
    after: states(EVENT.after),
  };
}
