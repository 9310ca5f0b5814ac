// The blocks of the kind `js` in README and docs: each page is a session that is run; what a line
// prints is in the comment behind it.
import { execFileSync, spawnSync } from "node:child_process";
import { mkdtempSync, readdirSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { expect, test, vi } from "vitest";
import { root, thereIsPlain } from "./support.js";

test.each([
  "README.md",
  "docs/start/javascript.md",
  "docs/using/javascript.md",
  "web/npm/README.md",
])("JavaScript of %s", async (page) => {
  const blocks = [...readFileSync(`${root}${page}`, "utf8").matchAll(/^```js\n(.*?)^```$/gms)].map(
    (match) => match[1]!,
  );
  if (page !== "README.md") expect(blocks.length).toBeGreaterThan(0);
  if (blocks.length === 0) return;
  const text = blocks.join("\n");
  const expected = [...text.matchAll(/^\s*console\.log\(.*\);\s*\/\/ (.*)$/gm)].map(
    (match) => match[1]!,
  );
  const printed: string[] = [];
  const spy = vi
    .spyOn(console, "log")
    .mockImplementation((...values: unknown[]) => void printed.push(values.join(" ")));
  const session = text.replaceAll(
    'from "carom"',
    `from ${JSON.stringify(`file://${root}web/npm/dist/index.js`)}`,
  );
  await import(
    /* @vite-ignore */ `data:text/javascript,${encodeURIComponent(`${session}// ${page}`)}`
  );
  spy.mockRestore();
  expect(printed).toEqual(expected);
});

test("the tarball has its licences, and the WebAssembly once", () => {
  const [packed] = JSON.parse(
    execFileSync("npm", ["pack", "--dry-run", "--json"], {
      cwd: `${root}web/npm`,
      encoding: "utf8",
      stdio: ["ignore", "pipe", "ignore"],
    }),
  ) as [{ size: number; files: { path: string; size: number }[] }];
  expect(packed.files.map(({ path }) => path)).toEqual(
    expect.arrayContaining(["LICENSE", "NOTICES", "README.md", "dist/index.js"]),
  );
  // The declarations of a module would have its text, of more than 400 kB.
  expect(packed.files.filter(({ path, size }) => path.endsWith(".d.ts") && size > 200_000)).toEqual(
    [],
  );
  // Its modules are most of it, compressed, as text.
  const modules = packed.files.filter(({ path }) => /generated\/(plain|simd)\.js$/.test(path));
  expect(modules.length).toBe(2);
  // Without the build plain, the other files of the package weigh more than this allows.
  if (thereIsPlain)
    expect(packed.size).toBeLessThan(0.92 * modules.reduce((sum, { size }) => sum + size, 0));
});

// web/npm/examples/: each program checks its own answer. The picture of a break is that of the
// docs: node web/npm/examples/break_paths.mjs docs/figures/example-break-paths.svg
// lockstep.mjs compares the two builds, so it needs both.
const examples = readdirSync(`${root}web/npm/examples`).filter(
  (name) => name.endsWith(".mjs") && (thereIsPlain || name !== "lockstep.mjs"),
);
test.each(examples)("the example %s", (name) => {
  const work = mkdtempSync(`${tmpdir()}/carom-`);
  const { status, stdout, stderr } = spawnSync(
    process.execPath,
    [`${root}web/npm/examples/${name}`],
    { cwd: work, encoding: "utf8" },
  );
  expect(stderr).toBe("");
  expect(status).toBe(0);
  expect(stdout.split("\n").length).toBeGreaterThan(1);
  if (name === "break_paths.mjs") {
    expect(readFileSync(`${work}/break.svg`, "utf8")).toBe(
      readFileSync(`${root}docs/figures/example-break-paths.svg`, "utf8"),
    );
  }
  rmSync(work, { recursive: true });
});
