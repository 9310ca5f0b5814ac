import { defineConfig } from "vitest/config";

export default defineConfig({
  test: {
    include: ["{npm,page}/test/**/*.test.ts"],
    // Limits of what hangs, which nothing reaches on a busy machine: no test is judged by a clock.
    testTimeout: 600_000,
    hookTimeout: 600_000,
    expect: { poll: { timeout: 300_000 } },
    // Tests of the page mostly wait for films.
    maxWorkers: 3,
    minWorkers: 1,
  },
});
