// The WebAssembly module: which of the two builds, its imports, its memory.

/** Which build runs: with 128-bit vectors for batches, or without. Both have the same bits. */
export type Build = "simd" | "plain";

export type Pointer = number;

/** The functions that the module exports; sizes of 64 bits are BigInt. */
export interface Exports {
  memory: WebAssembly.Memory;
  /** The functions that structs of C refer to, by number. */
  __indirect_function_table: WebAssembly.Table;
  malloc(bytes: number): Pointer;
  free(pointer: Pointer): void;
  [name: `carom_${string}`]: (...numbers: (number | bigint)[]) => number;
}

// A function whose body is one instruction on vectors: v128.const 0, i32x4.extract_lane 0. It
// validates if SIMD128 is supported.
const VECTORS = new Uint8Array([
  0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 127, 3, 2, 1, 0, 10, 25, 1, 23, 0, 253, 12, 0, 0,
  0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 253, 27, 0, 11,
]);

/** Whether this machine runs the build with 128-bit vectors. */
export function simdAvailable(): boolean {
  return WebAssembly.validate(VECTORS);
}

/**
 * The bytes of a module, which are compressed by gzip before they become text: base64 alone
 * compresses badly.
 */
function bytesOf(base64: string): Promise<ArrayBuffer> {
  const compressed = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
  return new Response(
    new Blob([compressed]).stream().pipeThrough(new DecompressionStream("gzip")),
  ).arrayBuffer();
}

/** Memory of the module, with views that are renewed after it has grown. */
export class Memory {
  #f64 = new Float64Array();
  #i32 = new Int32Array();
  #u32 = new Uint32Array();
  #u8 = new Uint8Array();
  #i64 = new BigInt64Array();
  readonly #text = new TextDecoder();
  #isPaused = false;

  /** `own` has the functions of own.c, which the module imports. */
  constructor(
    readonly exports: Exports,
    readonly callbacks: Record<string, (...numbers: number[]) => number> = {},
  ) {}

  /**
   * Marks that functions of the caller run, which the library has called: nothing else may use the
   * memory meanwhile, because the call of the library still reads it. `isPaused` false ends this.
   */
  paused<T>(run: () => T, isPaused = true): T {
    this.#isPaused = isPaused;
    try {
      return run();
    } finally {
      this.#isPaused = !isPaused;
    }
  }

  get buffer(): ArrayBuffer {
    return this.exports.memory.buffer;
  }

  #renew(): void {
    if (this.#isPaused) throw new Error("carom: rules cannot call the library that calls them");
    const buffer = this.buffer;
    if (this.#f64.buffer === buffer) return;
    this.#f64 = new Float64Array(buffer);
    this.#i32 = new Int32Array(buffer);
    this.#u32 = new Uint32Array(buffer);
    this.#u8 = new Uint8Array(buffer);
    this.#i64 = new BigInt64Array(buffer);
  }
  get f64(): Float64Array<ArrayBuffer> {
    this.#renew();
    return this.#f64 as Float64Array<ArrayBuffer>;
  }
  get i32(): Int32Array {
    this.#renew();
    return this.#i32;
  }
  get u32(): Uint32Array {
    this.#renew();
    return this.#u32;
  }
  get u8(): Uint8Array {
    this.#renew();
    return this.#u8;
  }
  get i64(): BigInt64Array {
    this.#renew();
    return this.#i64;
  }

  /** Memory that is all zero. */
  allocate(bytes: number): Pointer {
    const pointer = this.exports.malloc(Math.max(bytes, 8)) >>> 0;
    if (pointer === 0) throw new RangeError(`carom: no memory for ${bytes} bytes`);
    this.u8.fill(0, pointer, pointer + bytes);
    return pointer;
  }
  free(pointer: Pointer): void {
    this.exports.free(pointer);
  }

  /** The text that a function of C returns; undefined for NULL. */
  text(pointer: Pointer): string | undefined {
    if (pointer === 0) return undefined;
    const u8 = this.u8;
    return this.#text.decode(u8.slice(pointer, u8.indexOf(0, pointer)));
  }
}

/** Compiles and starts a build of the library. */
export async function start(build: Build): Promise<Memory> {
  const base64 =
    build === "simd"
      ? (await import("./generated/simd.js")).default
      : (await import("./generated/plain.js")).default;
  const module = await WebAssembly.compile(await bytesOf(base64));
  // The library requests only the time and the environment from the system; the environment is
  // empty.
  let buffer = (): ArrayBufferLike | undefined => undefined; // there is a memory after the start
  const empty = (count: number, size: number): number => {
    const memory = buffer();
    if (memory === undefined) return 0;
    const words = new Uint32Array(memory);
    words[count >>> 2] = 0;
    words[size >>> 2] = 0;
    return 0;
  };
  const clockTime = (_clock: number, _precision: number, pointer: number): number => {
    const nanoseconds = BigInt(Math.round(1e6 * performance.now()));
    new BigUint64Array(buffer()!)[pointer >>> 3] = nanoseconds;
    return 0;
  };
  const known: Record<string, (...numbers: number[]) => number | void> = {
    environ_sizes_get: empty as (...numbers: number[]) => number,
    environ_get: () => 0,
    clock_time_get: clockTime as (...numbers: number[]) => number,
    emscripten_notify_memory_growth: () => undefined,
  };
  const callbacks: Memory["callbacks"] = {};
  const imports: WebAssembly.Imports = {};
  for (const wantedImport of WebAssembly.Module.imports(module)) {
    const { name } = wantedImport;
    if (wantedImport.module === "carom_own")
      known[name] = (...numbers) => callbacks[name]!(...numbers);
    (imports[wantedImport.module] ??= {})[name] =
      known[name] ??
      (() => {
        throw new Error(`carom: the library called ${name}(), which is not available here`);
      });
  }
  const instance = await WebAssembly.instantiate(module, imports);
  const exports = instance.exports as unknown as Exports & { _initialize?: () => void };
  buffer = () => exports.memory.buffer;
  exports._initialize?.();
  return new Memory(exports, callbacks);
}
