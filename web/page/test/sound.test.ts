// Sounds of the page: louder by a larger impulse, and each with the tones that it is made of.
import { expect, test } from "vitest";
import { loudness, wave } from "../src/play/sound.js";
import { carom } from "../../test/builds.js";

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
