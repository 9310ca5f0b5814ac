// The package as its users have it: in a worker, by its version, without dependencies.
import { readFileSync } from "node:fs";
import { Worker } from "node:worker_threads";
import { expect, test } from "vitest";
import { builds, carom, root } from "./support.js";

test("a worker computes the same bits", async () => {
  const source = `
    import { parentPort } from "node:worker_threads";
    import { load } from ${JSON.stringify(`file://${root}web/npm/dist/index.js`)};
    const carom = await load();
    const table = carom.table("9ft");
    const shot = carom.simulate(table, carom.rack("nineball", table), { speed: 8 });
    const choices = carom.plan(table, carom.rack("nineball", table), { rules: "nineball", opening: true, shots: 100 });
    parentPort.postMessage([carom.build, shot.time, shot.final, choices]);`;
  const worker = new Worker(new URL(`data:text/javascript,${encodeURIComponent(source)}`));
  const message = await new Promise((resolve, reject) =>
    worker.once("message", resolve).once("error", reject),
  );
  await worker.terminate();
  const table = carom.table("9ft");
  const shot = carom.simulate(table, carom.rack("nineball", table), { speed: 8 });
  const choices = carom.plan(table, carom.rack("nineball", table), {
    rules: "nineball",
    opening: true,
    shots: 100,
  });
  expect(message).toEqual(["simd", shot.time, shot.final, choices]);
});

test("the package has the library's version, and no dependency at run time", () => {
  const described = JSON.parse(readFileSync(`${root}web/npm/package.json`, "utf8")) as Record<
    string,
    unknown
  >;
  expect(described.version).toBe(builds[0]!.carom.version);
  expect(described.dependencies).toBeUndefined();
  const lock = readFileSync(`${root}web/package-lock.json`, "utf8");
  expect(lock).not.toMatch(/"resolved": "(?!https:\/\/registry\.npmjs\.org\/|npm"|page")/);
});

test("the compressed size is at most 400 kB", async () => {
  const { gzipSync } = await import("node:zlib");
  const { readdirSync } = await import("node:fs");
  const size = (names: string[]) =>
    gzipSync(Buffer.concat(names.map((name) => readFileSync(`${root}web/npm/dist/${name}`))), {
      level: 9,
    }).length;
  const common = [
    ...readdirSync(`${root}web/npm/dist`).filter((name) => name.endsWith(".js")),
    "generated/layout.js",
  ];
  for (const { name: build } of builds) {
    const bytes = size([...common, `generated/${build}.js`]);
    console.log(`what a user of the build ${build} loads: ${bytes} bytes compressed`);
    expect(bytes).toBeLessThan(400_000);
  }
});
