// The blocks of the kind `js` in README and docs: each page is a session that is run; what a line prints is in the comment behind it.
import { spawnSync } from "node:child_process";
import { mkdtempSync, readdirSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { expect, test, vi } from "vitest";
import { root } from "./support.js";

test.each(["README.md", "docs/using/web.md", "web/README.md"])("JavaScript of %s", async (page) => {
  const blocks = [...readFileSync(`${root}${page}`, "utf8").matchAll(/^```js\n(.*?)^```$/gms)].map((match) => match[1]!);
  if (page !== "README.md") expect(blocks.length).toBeGreaterThan(0);
  if (blocks.length === 0) return;
  const text = blocks.join("\n");
  const expected = [...text.matchAll(/^\s*console\.log\(.*\);\s*\/\/ (.*)$/gm)].map((match) => match[1]!);
  const printed: string[] = [];
  const spy = vi.spyOn(console, "log").mockImplementation((...all: unknown[]) => void printed.push(all.join(" ")));
  const session = text.replaceAll('from "carom"', `from ${JSON.stringify(`file://${root}web/dist/index.js`)}`);
  await import(/* @vite-ignore */ `data:text/javascript,${encodeURIComponent(`${session}// ${page}`)}`);
  spy.mockRestore();
  expect(printed).toEqual(expected);
});

// web/examples/: each program checks its own answer. The picture of a break is that of the
// docs: node web/examples/break_paths.mjs docs/figures/example-break-paths.svg
const examples = readdirSync(`${root}web/examples`).filter((name) => name.endsWith(".mjs"));
test.each(examples)("the example %s", (name) => {
  const work = mkdtempSync(`${tmpdir()}/carom-`);
  const { status, stdout, stderr } = spawnSync(process.execPath, [`${root}web/examples/${name}`], { cwd: work, encoding: "utf8" });
  expect(stderr).toBe("");
  expect(status).toBe(0);
  expect(stdout.split("\n").length).toBeGreaterThan(1);
  if (name === "break_paths.mjs") {
    expect(readFileSync(`${work}/break.svg`, "utf8")).toBe(readFileSync(`${root}docs/figures/example-break-paths.svg`, "utf8"));
  }
  rmSync(work, { recursive: true });
});
