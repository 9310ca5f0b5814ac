// Objects to structs in the module's memory, and back.
import {
  layout,
  names as NAMES,
  numbers as NUMBERS,
  options as OPTIONS,
  values,
} from "./generated/layout.js";
import { KEYS, meant, refuseUnknown } from "./keys.js";
import type { Memory, Pointer } from "./memory.js";
import type * as C from "./generated/structs.js";
import type {
  BallState,
  EventType,
  Motion,
  ShotBall,
  ShotEvent,
  ShotFacts,
  Table,
  Vec3,
} from "./types.js";

export type StructName = keyof typeof layout;

/** A library, for its table of synonyms, which is the same in every one. */
let library: Memory | undefined;
export function readSynonymsOf(memory: Memory): void {
  library ??= memory;
}

/** Whether a text is a word as players write it, by carom_word_means(): "9-ball" is "nineball". */
function means(text: string, word: string): boolean {
  if (library === undefined) return false;
  const bytes = [text, word].map((name) => new TextEncoder().encode(`${name}\0`));
  const pointers = bytes.map(({ length }) => library!.allocate(length));
  try {
    pointers.forEach((pointer, k) => library!.u8.set(bytes[k]!, pointer));
    return library.exports.carom_word_means(pointers[0]!, pointers[1]!) !== 0;
  } finally {
    for (const pointer of pointers) library.free(pointer);
  }
}
const lettersOf = (word: string): string => word.toLowerCase().replace(/[-_ ]/g, "");

/**
 * The index of a name in a list: of the name itself, else of its letters, else of a synonym in the
 * library's table.
 */
export function indexOf(
  words: readonly (string | undefined)[],
  word: unknown,
  option: string,
): number {
  if (typeof word === "string" && word !== "") {
    const letters = lettersOf(word);
    const alike = [
      (known: string) => known === word,
      (known: string) => lettersOf(known) === letters,
      (known: string) => means(word, known),
    ];
    for (const isAlike of alike) {
      const found = words.findIndex(
        (known) => known !== undefined && known !== "" && isAlike(known),
      );
      if (found >= 0) return found;
    }
  }
  const known = words.filter((name): name is string => name !== undefined && name !== "");
  return refuseName(option, word as string, [...new Set(known)]);
}

/** The value of a name of an enumeration: value("carom_cushion_model", "han", "model"). */
export function value(enumeration: keyof typeof NAMES, word: unknown, option: string): number {
  return indexOf(NAMES[enumeration], word, option);
}

/** Throws the error of a name that is not in a list. */
export function refuseName(option: string, name: string, names: readonly string[]): never {
  const hint = meant(String(name), names);
  throw new TypeError(
    `${option}: unknown name ${JSON.stringify(name)}${hint ? `${hint} Use` : "; use"} one of ${names.join(", ")}`,
  );
}

type Type = "f64" | "i64" | "i32" | StructName | "";
/** The offset, the type and the number of elements of a field. */
interface Field {
  key: string;
  begin: number;
  type: Type;
  size: number;
}
const BYTES: Record<Exclude<Type, StructName>, number> = { i32: 4, f64: 8, i64: 8, "": 8 };
const bytesOf = (type: Type): number =>
  type in layout ? layout[type as StructName].size : BYTES[type as keyof typeof BYTES];
const FIELDS = Object.fromEntries(
  Object.entries(layout).map(([struct, { offset, bytes, type }]) => [
    struct,
    Object.entries(offset)
      .filter(([key]) => key !== "unused")
      .map(([key, begin]): Field => {
        const fieldType = (type as Record<string, Type>)[key]!;
        const size = (bytes as Record<string, number>)[key]! / bytesOf(fieldType);
        return { key, begin, type: fieldType, size };
      }),
  ]),
) as Record<StructName, Field[]>;
const KEYS_OF = Object.fromEntries(
  Object.entries(FIELDS).map(([struct, fields]) => [struct, fields.map(({ key }) => key)]),
) as Record<StructName, string[]>;

/** Rejects keys that a struct does not have. */
export function refuseUnknownOf(struct: StructName, fields: object, name: string): void {
  refuseUnknown(fields, KEYS_OF[struct], name);
}

/** A description of the values of a field. */
function wordsOf(size: number, whole: boolean): string {
  if (whole) return "a whole number";
  return size === 1 ? "a number" : `${size} numbers`;
}

/** The numbers of a field that is a number or a list; undefined if it is neither. */
function listOf(value: unknown, size: number): ArrayLike<number> | null | undefined {
  if (size === 1) return [value as number];
  return typeof value === "object" ? (value as ArrayLike<number> | null) : undefined;
}

/**
 * A struct of numbers and arrays of them, from an object whose keys are the fields; `defaults` has
 * the optional ones.
 */
export function writeStruct(
  memory: Memory,
  pointer: Pointer,
  struct: StructName,
  fields: object,
  name: string,
  defaults?: object,
): void {
  refuseUnknownOf(struct, fields, name);
  const { f64, i64, i32 } = memory;
  for (const { key, begin, size, type } of FIELDS[struct]) {
    if (type === "") continue; // it stays 0
    const value =
      (fields as Record<string, unknown>)[key] ??
      (defaults as Record<string, unknown> | undefined)?.[key];
    if (type in layout && typeof value === "object" && value !== null) {
      writeStruct(memory, pointer + begin, type as StructName, value, `${name}.${key}`);
      continue;
    }
    const whole = type === "i64" || type === "i32";
    const list = listOf(value, size);
    if (
      list?.length !== size ||
      ((size === 1 || whole) &&
        !Array.from(list).every((number) =>
          whole ? Number.isSafeInteger(number) : typeof number === "number",
        ))
    )
      throw new TypeError(
        `${name}.${key}: it must be ${wordsOf(size, whole)}, not ${JSON.stringify(value)}`,
      );
    for (let k = 0; k < size; k++)
      if (type === "i64") i64[(pointer + begin) / 8 + k] = BigInt(list[k]!);
      else if (type === "i32") i32[(pointer + begin) / 4 + k] = list[k]!;
      else f64[(pointer + begin) / 8 + k] = list[k]!;
  }
}

/** Sets some fields of a struct, which is cleared before: numbers, enumerators and addresses. */
export function setStruct<S extends StructName>(
  memory: Memory,
  pointer: Pointer,
  struct: S,
  values: { [key in keyof (typeof layout)[S]["offset"]]?: number | bigint },
  clear = true,
): Pointer {
  if (clear) memory.u8.fill(0, pointer, pointer + layout[struct].size);
  const { f64, i64, i32 } = memory;
  for (const { key, begin, type, size } of FIELDS[struct]) {
    const value = (values as Record<string, number | bigint | undefined>)[key];
    if (value === undefined) continue;
    if (type === "f64") f64[(pointer + begin) / 8] = Number(value);
    else if (size * bytesOf(type) === 8) i64[(pointer + begin) / 8] = BigInt(value);
    else i32[(pointer + begin) / 4] = Number(value);
  }
  return pointer;
}

/** A number of a count or a seed. */
export function whole(number: number | undefined, option: string, most = 0x7fffffff): number {
  if (number === undefined) return 0;
  if (!Number.isSafeInteger(number) || number < 0 || number > most)
    throw new RangeError(
      `${option}: it must be a whole number, 0 ${most < 100 ? `to ${most}` : "or more"}, not ${number}`,
    );
  return number;
}

/**
 * Options of a call by their rows; a missing option is 0, its default. With `stops` only the
 * stopping options.
 */
export function writeOptions(
  memory: Memory,
  pointer: Pointer,
  struct: keyof typeof OPTIONS,
  options: object,
  stops = false,
): Pointer {
  const fields: Record<string, number | bigint> = {};
  for (const { key, form, enumeration, stop } of OPTIONS[struct]) {
    if (stops && !stop) continue;
    const given = (options as Record<string, unknown>)[key] ?? 0;
    const supplied = form === "flag" && typeof given === "boolean" ? Number(given) : given;
    const bit = (item: unknown): bigint =>
      1n <<
      BigInt(
        enumeration === ""
          ? whole(item as number, key, 63)
          : indexOf(["contact", ...NAMES[enumeration].slice(1)], item, key),
      );
    if (form === "words")
      fields[key] = supplied === 0 ? 0 : value(enumeration as keyof typeof NAMES, supplied, key);
    else if (form === "set")
      fields[key] =
        supplied === 0
          ? 0n
          : (Array.isArray(supplied) ? supplied : [supplied]).reduce(
              (set: bigint, item) => set | bit(item),
              0n,
            );
    else if (form === "number" && typeof supplied !== "number")
      throw new TypeError(`${key}: it must be a number, not ${JSON.stringify(supplied)}`);
    else
      fields[key] =
        form === "number"
          ? (supplied as number)
          : whole(supplied as number, key, form === "seed" ? Number.MAX_SAFE_INTEGER : undefined);
  }
  return setStruct(memory, pointer, struct, fields, !stops);
}

/** The options in a struct, as they are given: those that differ from the defaults. */
export function readOptions<T>(
  memory: Memory,
  pointer: Pointer,
  struct: keyof typeof OPTIONS,
): Partial<T> {
  const fields = readStruct<Record<string, number>>(memory, pointer, struct);
  const entries = OPTIONS[struct].flatMap(({ key, form, enumeration }): [string, unknown][] => {
    const number = fields[key] ?? 0;
    if (number === 0) return [];
    if (form === "words") return [[key, NAMES[enumeration as keyof typeof NAMES][number]]];
    if (form === "flag") return [[key, true]];
    if (form !== "set") return [[key, number]];
    const names: readonly string[] =
      enumeration === "" ? [] : ["contact", ...NAMES[enumeration].slice(1)];
    return [[key, members(number).map((k) => names[k] ?? k)]];
  });
  return Object.fromEntries(entries) as Partial<T>;
}

/** A struct as an object: numbers, lists of numbers, and structs in it. */
export function readStruct<T>(memory: Memory, pointer: Pointer, struct: StructName): T {
  const { f64, i64, i32 } = memory;
  const readOne = (type: Type, place: Pointer): unknown => {
    if (type === "f64") return f64[place / 8];
    if (type === "i64") return Number(i64[place / 8]);
    if (type === "i32") return i32[place / 4];
    return readStruct(memory, place, type as StructName);
  };
  const read = ({ key, begin, type, size }: Field): [string, unknown] => [
    key,
    size === 1
      ? readOne(type, pointer + begin)
      : Array.from({ length: size }, (_, k) => readOne(type, pointer + begin + k * bytesOf(type))),
  ];
  return Object.fromEntries(FIELDS[struct].filter(({ type }) => type !== "").map(read)) as T;
}

export function vec3(f64: Float64Array, pointer: Pointer): Vec3 {
  const k = pointer / 8;
  return [f64[k]!, f64[k + 1]!, f64[k + 2]!];
}

export function readMotion(f64: Float64Array, pointer: Pointer): Motion {
  return {
    v: vec3(f64, pointer + layout.carom_motion.offset.v),
    w: vec3(f64, pointer + layout.carom_motion.offset.w),
  };
}

const STATE = layout.carom_ball_state.offset;

export function readState(memory: Memory, pointer: Pointer): BallState {
  const f64 = memory.f64;
  const label = NAMES.carom_label[memory.i32[(pointer + STATE.label) / 4]!]!;
  return {
    r: vec3(f64, pointer + STATE.r),
    v: vec3(f64, pointer + STATE.v),
    w: vec3(f64, pointer + STATE.w),
    label,
  };
}

export function writeStates(memory: Memory, pointer: Pointer, states: readonly BallState[]): void {
  for (const [k, state] of states.entries())
    writeStruct(
      memory,
      pointer + k * layout.carom_ball_state.size,
      "carom_ball_state",
      { ...state, label: value("carom_label", state.label, "label") },
      "state",
    );
}

export function writeBalls(memory: Memory, pointer: Pointer, balls: readonly ShotBall[]): void {
  const { kind, state } = layout.carom_shot_ball.offset;
  for (const [k, ball] of balls.entries()) {
    const ballAt = pointer + k * layout.carom_shot_ball.size;
    const name = `balls[${k}]`;
    refuseUnknown(ball, KEYS.ball, name);
    writeStruct(memory, ballAt + kind, "carom_ball_kind", ball.kind, `${name}.kind`);
    const label = value("carom_label", ball.state.label ?? "stationary", `${name}.state.label`);
    writeStruct(
      memory,
      ballAt + state,
      "carom_ball_state",
      { ...ball.state, label },
      `${name}.state`,
    );
  }
}

export function readBalls(memory: Memory, pointer: Pointer, count: number): ShotBall[] {
  const { kind, state } = layout.carom_shot_ball.offset;
  return Array.from({ length: count }, (_, k) => {
    const ball = pointer + k * layout.carom_shot_ball.size;
    return {
      kind: readStruct(memory, ball + kind, "carom_ball_kind"),
      state: readState(memory, ball + state),
    };
  });
}

const TABLE = layout.carom_table.offset;
const TABLE_NUMBERS = NUMBERS.carom_table.map(([, field]) => field);
const PARTS = [
  ["rails", TABLE.rails, "carom_rail", TABLE.rail, values.CAROM_RAILS_MOST],
  ["jaws", TABLE.jaws, "carom_jaw", TABLE.jaw, values.CAROM_JAWS_MOST],
  ["pockets", TABLE.pockets, "carom_pocket", TABLE.pocket, values.CAROM_POCKETS_MOST],
] as const;

/** The optional keys of the parts of a table. */
const PART = { line: [0, 0, 0], muCushion: 0, restitution: 0 };

export function writeTable(memory: Memory, pointer: Pointer, table: Table): void {
  refuseUnknown(table, KEYS.table, "table");
  memory.u8.fill(0, pointer, pointer + layout.carom_table.size);
  for (const key of TABLE_NUMBERS) memory.f64[(pointer + TABLE[key]) / 8] = table[key] ?? 0;
  for (const [name, count, struct, first, most] of PARTS) {
    const parts = table[name];
    if (!Array.isArray(parts))
      throw new TypeError(`table.${name}: a list is needed, not ${JSON.stringify(parts)}`);
    if (parts.length > most)
      throw new RangeError(`table.${name}: at most ${most}, not ${parts.length}`);
    memory.i64[(pointer + count) / 8] = BigInt(parts.length);
    for (const [k, part] of parts.entries())
      writeStruct(
        memory,
        pointer + first + k * layout[struct].size,
        struct,
        part,
        `table.${name}[${k}]`,
        PART,
      );
  }
}

export function readTable(memory: Memory, pointer: Pointer): Table {
  const parts = PARTS.map(([name, count, struct, first]) => [
    name,
    Array.from({ length: Number(memory.i64[(pointer + count) / 8]) }, (_, k) =>
      readStruct(memory, pointer + first + k * layout[struct].size, struct),
    ),
  ]);
  const numbers = TABLE_NUMBERS.map((key) => [key, memory.f64[(pointer + TABLE[key]) / 8]!]);
  return { ...Object.fromEntries(numbers), ...Object.fromEntries(parts) } as Table;
}

const EVENT = layout.carom_event.offset;

export function readEvent(memory: Memory, pointer: Pointer): Omit<ShotEvent, "slip"> {
  const i32 = memory.i32;
  const type = i32[(pointer + EVENT.type) / 4]!;
  const sides = type === values.CAROM_EVENT_BALL_BALL ? 2 : 1;
  const states = (begin: number): BallState[] =>
    Array.from({ length: sides }, (_, k) =>
      readState(memory, pointer + begin + k * layout.carom_ball_state.size),
    );
  return {
    time: memory.f64[(pointer + EVENT.time) / 8]!,
    type: NAMES.carom_event_type[type] as EventType,
    a: i32[(pointer + EVENT.a) / 4]!,
    b: i32[(pointer + EVENT.b) / 4]!,
    before: states(EVENT.before),
    after: states(EVENT.after),
    cluster: i32[(pointer + EVENT.cluster) / 4]!,
    impulse: memory.f64[(pointer + EVENT.impulse) / 8]!,
  };
}

/** The balls of a set. */
export function members(set: number, count = 32): number[] {
  return Array.from({ length: count }, (_, k) => k).filter((k) => (set >>> k) & 1);
}

/** The set of balls, or of other elements with indices below `count`. */
export function setOf(members: readonly number[], name: string, count = 32): number {
  return members.reduce((set, item) => set | (1 << whole(item, name, count - 1)), 0) >>> 0;
}

const FACTS = layout.carom_facts.offset;

/** The facts of a shot with `count` balls. */
export function readFacts(
  memory: Memory,
  pointer: Pointer,
  count: number = values.CAROM_BALLS_MOST,
): ShotFacts {
  const { first, cushionsBefore, cushionsAfter, cushions, pocket, pocketTime, touches } =
    readStruct<C.Facts>(memory, pointer, "carom_facts");
  const ballsWith = (field: "down" | "off" | "frozen" | "pushed" | "jumped"): number[] =>
    members(memory.u32[(pointer + FACTS[field]) / 4]!, count);
  const potted = ballsWith("down").sort((a, b) => pocketTime[a]! - pocketTime[b]!);
  return {
    first,
    cushionsBefore,
    cushionsAfter,
    cushions: cushions.slice(0, count),
    potted: potted.map((ball) => ({ ball, pocket: pocket[ball]!, time: pocketTime[ball]! })),
    off: ballsWith("off"),
    frozen: ballsWith("frozen"),
    pushed: ballsWith("pushed"),
    jumped: ballsWith("jumped"),
    touches,
  };
}
