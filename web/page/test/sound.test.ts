// Sounds of the page: louder by a larger impulse, each heard by the small speaker of a phone, and
// from where it is seen, as Chromium renders them.
import { readFileSync } from "node:fs";
import { chromium } from "playwright-core";
import { afterAll, beforeAll, expect, test } from "vitest";
import { transformWithEsbuild } from "vite";
import { loudness, type Mixer, wave } from "../src/play/sound.js";
import { carom } from "../../test/builds.js";
import { root } from "../../test/support.js";
import { browserPath, describePages } from "./page.js";

test("a harder stroke is louder, by the impulses of its events", () => {
  const table = carom.table("9ft");
  const balls = carom.rack("nineball", table);
  const loudest = (speed: number, type: string) =>
    Math.max(
      ...carom
        .simulate(table, balls, { speed, phi: 90 })
        .events.filter((event) => event.type === type)
        .map(loudness),
    );
  for (const type of ["stick_ball", "ball_ball"]) {
    const heard = [0.5, 1, 2, 4].map((speed) => loudest(speed, type));
    for (const [k, loud] of heard.entries())
      if (k > 0) expect(loud).toBeGreaterThanOrEqual(heard[k - 1]!);
    expect(heard[0]).toBeLessThan(0.7 * heard[3]!);
  }
  expect(loudness({ type: "rolling_stationary", impulse: 0 })).toBe(0);
});

test("a wave decays, and has its tone", () => {
  const rate = 48_000;
  const samples = wave({ tones: [[1000, 0.5, 0.02]], noise: [0, 0.001, 0.5], full: 1 }, rate);
  const level = (start: number, end: number) =>
    Math.sqrt(
      samples.slice(start * rate, end * rate).reduce((sum, x) => sum + x * x, 0) /
        ((end - start) * rate),
    );
  expect(level(0.04, 0.05) / level(0, 0.01)).toBeLessThan(0.25);
  let crossings = 0;
  for (let k = 1; k < 0.02 * rate; k++) if (samples[k - 1]! < 0 !== samples[k]! < 0) crossings++;
  expect(crossings).toBeGreaterThanOrEqual(38);
  expect(crossings).toBeLessThanOrEqual(42);
  expect(Math.max(...samples.map(Math.abs))).toBeLessThanOrEqual(1);
});

type Heard = [method: "strike" | "roll" | "end", ...parameters: unknown[]];
/** A second of sound: the energy at the left and right ear, its share above 400 Hz, and its end's. */
interface Measured {
  left: number;
  right: number;
  bright: number;
  late: number;
}
describePages("as Chromium renders it", () => {
  let browser: Awaited<ReturnType<typeof chromium.launch>>;
  let measure: (...heard: Heard) => Promise<Measured>;
  beforeAll(async () => {
    browser = await chromium.launch({ executablePath: browserPath!, args: ["--no-sandbox"] });
    const page = await browser.newPage();
    const source = readFileSync(`${root}web/page/src/play/sound.ts`, "utf8");
    const { code } = await transformWithEsbuild(source, "sound.ts");
    await page.addScriptTag({ type: "module", content: `${code};window.Mixer = Mixer;` });
    measure = (...heard) =>
      page.evaluate(async ([method, ...parameters]) => {
        const { Mixer } = window as unknown as {
          Mixer: new (context: BaseAudioContext) => Mixer;
        };
        const RATE = 44_100;
        const context = new OfflineAudioContext(2, RATE, RATE);
        const mixer = new Mixer(context);
        (mixer[method] as (...values: unknown[]) => void)(...parameters);
        const buffer = await context.startRendering();
        const energy = (samples: Float32Array) => samples.reduce((sum, x) => sum + x * x, 0);
        const ears = [0, 1].map((ear) => buffer.getChannelData(ear));
        const [left, right] = ears.map(energy) as [number, number];

        // The same once more, through filters of the fourth order.
        const filtered = new OfflineAudioContext(2, RATE, RATE);
        const source = new AudioBufferSourceNode(filtered, { buffer });
        const filter = () =>
          new BiquadFilterNode(filtered, { type: "highpass", frequency: 400, Q: 0 });
        source.connect(filter()).connect(filter()).connect(filtered.destination);
        source.start();
        const high = await filtered.startRendering();
        const above = [0, 1].map((ear) => energy(high.getChannelData(ear)));
        return {
          left,
          right,
          bright: (above[0]! + above[1]!) / (left + right),
          late: energy(ears[0]!.subarray(0.8 * RATE)) / left,
        };
      }, heard);
  });
  afterAll(() => browser.close());
  const eventOf = (type: string, impulse = 0.4) => ({ type, impulse, a: 0, b: 1 });

  test.each([
    "stick_ball",
    "ball_ball",
    "ball_linear_cushion",
    "ball_circular_cushion",
    "ball_pocket",
    "slate",
    "rail_top",
  ])("a third of the energy is above 400 Hz: %s", async (type) => {
    const { left, right, bright, late } = await measure("strike", eventOf(type), 0);
    expect(bright).toBeGreaterThan(1 / 3);
    expect(left / right).toBeGreaterThan(0.8);
    expect(left / right).toBeLessThan(1.25);
    expect(late).toBeLessThan(0.01);
  });

  test("what is seen on one side is heard more there", async () => {
    for (const event of ["ball_ball", "ball_pocket"].map((type) => eventOf(type))) {
      const left = await measure("strike", event, -1);
      const right = await measure("strike", event, 1);
      expect(left.left).toBeGreaterThan(3 * left.right);
      expect(right.right).toBeGreaterThan(3 * right.left);
    }
    const rolling = await measure("roll", 2, 0.7);
    expect(rolling.right).toBeGreaterThan(2 * rolling.left);
    // Behind the camera a place has no side.
    const { left, right } = await measure("strike", eventOf("ball_ball"), NaN);
    expect(left / right).toBeCloseTo(1, 0);
  });

  test("faster balls roll louder, and nothing rolls that nobody renews", async () => {
    const heard = [];
    for (const speed of [0, 0.3, 1, 3]) heard.push(await measure("roll", speed, 0));
    expect(heard[0]!.left).toBe(0);
    for (const [k, { left, bright, late }] of heard.slice(1).entries()) {
      expect(left).toBeGreaterThan(2 * heard[k]!.left);
      expect(bright).toBeGreaterThan(1 / 3);
      expect(late).toBeLessThan(1e-3);
    }
  });

  test("a game that is lost sounds lower than one that is won", async () => {
    const won = await measure("end", true);
    const lost = await measure("end", false);
    expect(won.left).toBeGreaterThan(0);
    expect(lost.left).toBeGreaterThan(0);
    expect(lost.bright).toBeLessThan(won.bright);
  });
});
