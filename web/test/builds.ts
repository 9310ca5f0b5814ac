// Both builds of the package, which take seconds to load: tests of pages alone do without.
import { afterEach } from "vitest";
import { load } from "carom";

export const builds = await Promise.all(
  (["simd", "plain"] as const).map(async (build) => ({
    name: build as string,
    carom: await load({ build }),
  })),
);
// The worker answers after each test, so that Vitest does not take a file of long computations for
// one that hangs.
afterEach(() => new Promise<void>((answers) => setImmediate(answers)));
