// What tests of the package share besides: the tree's data, and the hashes of
// core/tests/platforms/bits.c.
import { readFileSync } from "node:fs";
import { expect } from "vitest";
import type { Carom, ShotBall, Table } from "../dist/index.js";
import { root } from "../../test/support.js";

export * from "../../test/builds.js";
export * from "../../test/support.js";

/** Each call throws, with a message that has these words. */
export function refuses(...rows: (readonly [() => unknown, string | RegExp | object])[]): void {
  for (const [call, message] of rows) expect(call).toThrow(message as RegExp);
}
/** What a call throws. */
export function refusal<E = Error>(call: () => unknown): E {
  try {
    call();
  } catch (error) {
    return error as E;
  }
  throw new Error("nothing was refused");
}
/** The table and the balls of a game of nine-ball. */
export function nineball(carom: Carom): { table: Table; balls: ShotBall[] } {
  const table = carom.table("9ft");
  return { table, balls: carom.rack("nineball", table) };
}

/** A CSV file of data/ as rows by column. */
export function csv(name: string): Record<string, string>[] {
  const [head, ...lines] = readFileSync(`${root}data/${name}`, "utf8").trim().split("\n");
  const columns = head!.split(",");
  return lines.map((line) =>
    Object.fromEntries(line.split(",").map((cell, k) => [columns[k]!, cell])),
  );
}

/** FNV-1a over 8 bytes for each number; every NaN counts as 1. */
export class Hash {
  #low = 0x84222325;
  #high = 0xcbf29ce4;
  readonly #f64 = new Float64Array(1);
  readonly #u32 = new Uint32Array(this.#f64.buffer);

  #byte(byte: number): void {
    // times 0x100000001b3, in halves of 32 bits
    const low = (this.#low ^ byte) >>> 0;
    const product = low * 0x1b3;
    this.#high = (Math.imul(this.#high, 0x1b3) + Math.floor(product / 2 ** 32) + (low << 8)) >>> 0;
    this.#low = product >>> 0;
  }
  #words(low: number, high: number): this {
    for (const word of [low, high]) for (let k = 0; k < 32; k += 8) this.#byte((word >>> k) & 0xff);
    return this;
  }
  number(x: number): this {
    if (Number.isNaN(x)) return this.#words(1, 0);
    this.#f64[0] = x;
    return this.#words(this.#u32[0]!, this.#u32[1]!);
  }
  numbers(values: Iterable<number>): this {
    for (const x of values) this.number(x);
    return this;
  }
  /** A whole number of 64 bits, negative ones in two's complement. */
  whole(x: number): this {
    return this.#words(x >>> 0, x < 0 ? 0xffffffff : 0);
  }
  get text(): string {
    return [this.#high, this.#low].map((word) => word.toString(16).padStart(8, "0")).join("");
  }
}

/** The hash that bits.expected has for a line. */
export function golden(what: string): string {
  const line = readFileSync(`${root}core/tests/platforms/bits.expected`, "utf8")
    .split("\n")
    .find((line) => line.startsWith(`${what} `));
  if (line === undefined)
    throw new Error(`core/tests/platforms/bits.expected has no line for: ${what}`);
  return line.slice(what.length + 1);
}

/** The 204 reference collisions, 26 numbers each. */
export function cases(): { ids: string[]; rows: Float64Array } {
  const table = csv("collisions-204.csv");
  const columns = [
    "r1x",
    "r1y",
    "r1z",
    "v1x",
    "v1y",
    "v1z",
    "w1x",
    "w1y",
    "w1z",
    "R",
    "M",
    "u_s1",
    "r2x",
    "r2y",
    "r2z",
    "v2x",
    "v2y",
    "v2z",
    "w2x",
    "w2y",
    "w2z",
    "R",
    "M",
    "u_s2",
    "u_b",
    "e_b",
  ];
  return {
    ids: table.map((row) => row.id!),
    rows: Float64Array.from(table.flatMap((row) => columns.map((column) => Number(row[column])))),
  };
}

/** The results of a reference file, 12 numbers each. */
export function references(name: string): Float64Array {
  const columns = [
    "v1x",
    "v1y",
    "v1z",
    "w1x",
    "w1y",
    "w1z",
    "v2x",
    "v2y",
    "v2z",
    "w2x",
    "w2y",
    "w2z",
  ];
  return Float64Array.from(
    csv(name).flatMap((row) => columns.map((column) => Number(row[column]))),
  );
}
