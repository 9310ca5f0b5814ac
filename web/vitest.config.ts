import { defineConfig } from "vitest/config";

// The package's tests, those of the page without a browser, and one look at each of its views; with
// CAROM_PAGE=whole all of its tests.
const page = process.env.CAROM_PAGE === "whole" ? "**/*" : "{devices,first,named,schema,smoke}";

export default defineConfig({
  test: {
    include: ["npm/test/**/*.test.ts", `page/test/${page}.test.ts`],
    // Limits of what hangs, which nothing reaches on a busy machine: no test is judged by a clock.
    testTimeout: 600_000,
    hookTimeout: 600_000,
    expect: { poll: { timeout: 300_000 } },
    // Tests of the page mostly wait for films.
    maxWorkers: 3,
    minWorkers: 1,
  },
});
