import { defineConfig } from "vitest/config";

export default defineConfig({
  test: {
    include: ["{npm,page}/test/**/*.test.ts"],
    testTimeout: 60000,
    hookTimeout: 60000,
    // Two at a time: tests of the page mostly wait for films.
    maxWorkers: 2,
    minWorkers: 1,
  },
});
