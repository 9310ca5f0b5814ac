// What the tests of package and page share: the command `carom`, and the draws of
// core/tests/platforms/bits.c.
import { execFileSync } from "node:child_process";
import { existsSync } from "node:fs";
import { fileURLToPath } from "node:url";

export const root = fileURLToPath(new URL("../../", import.meta.url));

/** The command of the native build; CAROM in the environment names another. */
const command = process.env.CAROM ?? `${root}build/carom`;
export const thereIsACommand = existsSync(command);
if (!thereIsACommand)
  console.log(`without the tests against the command: there is no ${command} (./run builds it)`);

export function run(args: string[], input = ""): string {
  return execFileSync(command, args, {
    input,
    encoding: "utf8",
    maxBuffer: 1 << 28,
    env: { ...process.env, CAROM_ISA: "plain" },
  });
}

const MASK = (1n << 64n) - 1n;

/** Draws by splitmix64, as in core/tests/platforms/bits.c. */
export class Draws {
  constructor(private state: bigint) {}

  uniform(low: number, high: number): number {
    this.state = (this.state + 0x9e3779b97f4a7c15n) & MASK;
    let z = this.state;
    z = ((z ^ (z >> 30n)) * 0xbf58476d1ce4e5b9n) & MASK;
    z = ((z ^ (z >> 27n)) * 0x94d049bb133111ebn) & MASK;
    z ^= z >> 31n;
    return low + (high - low) * Number(z >> 11n) * 2 ** -53;
  }

  /** A power of two between 2^low and 2^high. */
  powerOfTwo(low: number, high: number): number {
    return 2 ** Math.trunc(this.uniform(low, high));
  }
}
