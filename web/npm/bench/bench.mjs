// npm run bench: how long the calls of the package take. Ratios within one run are what counts;
// each figure is the median of interleaved rounds, with the least.
import { readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { load } from "../dist/index.js";

const root = fileURLToPath(new URL("../../../", import.meta.url));
const [head, ...lines] = readFileSync(`${root}data/collisions-204.csv`, "utf8").trim().split("\n");
const names = head.split(",");
const columns = [
  "r1x",
  "r1y",
  "r1z",
  "v1x",
  "v1y",
  "v1z",
  "w1x",
  "w1y",
  "w1z",
  "R",
  "M",
  "u_s1",
  "r2x",
  "r2y",
  "r2z",
  "v2x",
  "v2y",
  "v2z",
  "w2x",
  "w2y",
  "w2z",
  "R",
  "M",
  "u_s2",
  "u_b",
  "e_b",
];
const row = lines.flatMap((line) =>
  columns.map((column) => Number(line.split(",")[names.indexOf(column)])),
);
const N = lines.length;
const TIMES = 20;
const n = N * TIMES;

const tasks = [];
for (const build of ["simd", "plain"]) {
  const carom = await load({ build });
  const batch = carom.collisions(n);
  for (let k = 0; k < TIMES; k++) batch.in.set(row, k * row.length);
  tasks.push({
    what: `WebAssembly ${build}: exact, batch`,
    count: n,
    go: () => carom.collideBatch(batch),
  });
  if (build === "simd") {
    const few = carom.collisions(N);
    few.in.set(row);
    tasks.push({
      what: "WebAssembly: 1000 Euler steps",
      count: N,
      go: () => carom.collideBatch(few, { solver: "euler" }),
    });
    const vector = (k) => [row[k], row[k + 1], row[k + 2]];
    const ball = (k) => ({
      r: vector(k),
      v: vector(k + 3),
      w: vector(k + 6),
      radius: row[k + 9],
      mass: row[k + 10],
      muSlide: row[k + 11],
    });
    const impacts = lines.map((_, k) => ({
      a: ball(26 * k),
      b: ball(26 * k + 12),
      muBall: row[26 * k + 24],
      restitution: row[26 * k + 25],
    }));
    tasks.push({
      what: "WebAssembly: exact, single calls with objects",
      count: N,
      go: () => impacts.forEach((impact) => carom.collide(impact)),
    });
  }
  const table = carom.table("9ft");
  const shots = carom.shots(table, carom.rack("nineball", table), 100);
  for (let k = 0; k < 100; k++) shots.setCue(k, carom.cue({ speed: 8, phi: 85 + k / 10 }));
  for (const cushionModel of ["han", "mathavan"])
    tasks.push({
      what: `WebAssembly ${build}: nine-ball break, ${cushionModel}`,
      count: 100,
      go: () => carom.simulateBatch(shots, { cushionModel }),
    });
}

for (const task of tasks) task.times = [];
for (let round = 0; round < 9; round++) {
  for (const task of tasks) {
    const begun = performance.now();
    let turns = 0;
    do {
      task.go();
      turns++;
    } while (performance.now() - begun < 30);
    task.times.push((performance.now() - begun) / turns / task.count);
  }
}
console.log(
  `# Node ${process.version}, ${process.arch}; 204 reference collisions; ns each, median of 9 rounds (least)`,
);
for (const { what, times } of tasks) {
  times.sort((a, b) => a - b);
  console.log(
    `${what.padEnd(48)} ${(times[4] * 1e6).toFixed(0).padStart(9)} (${(times[0] * 1e6).toFixed(0)})`,
  );
}
