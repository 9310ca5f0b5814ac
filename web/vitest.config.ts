import { defineConfig } from "vitest/config";

export default defineConfig({
  test: {
    include: ["{npm,page}/test/**/*.test.ts"],
    testTimeout: 60000,
    hookTimeout: 60000,
    // One at a time: the browser and the million calls would slow each other.
    fileParallelism: false,
  },
});
