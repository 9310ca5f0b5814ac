// The scene: what a picture of it costs, and what is seen of ways and of balls that fall.
import * as THREE from "three";
import { expect, test } from "vitest";
import { drawBall } from "../../player/ball.js";
import { trailsOf } from "../../player/film.js";
import { viewOf, WOOD } from "../../player/table.js";
import { carom } from "../../test/builds.js";
import { shotAcross } from "../src/play/scene.js";
import { filmOf, pathsOf } from "../src/table/filmed.js";
import { act, describePages, pages, PHONE, says } from "./page.js";

/** A ball that is played straight into the foot-right pocket. */
function potted() {
  const table = carom.table("9ft");
  const balls = carom.rack("nineball", table).slice(0, 2);
  const places = [
    [0.7, 1.9],
    [0.95, 2.18],
  ] as const;
  places.forEach(([x, y], k) => Object.assign(balls[k]!.state, { r: [x, y, 0.028575] }));
  const pocket = table.pockets.findIndex(({ centre: [x, y] }) => x > 1 && y > 2);
  const { phi } = carom.aim(table, balls, { speed: 2 }, { ball: 1, pocket });
  const shot = carom.simulate(table, balls, { speed: 2, phi: (phi[0] + phi[1]) / 2 });
  return { table, balls, shot };
}

test("a ball that falls is seen below the cloth, darker the deeper it is", () => {
  const { table, balls, shot } = potted();
  const fall = shot.events.find(({ type, a }) => type === "ball_pocket" && a === 1)!;
  const turned = balls.map(() => [1, 0, 0, 0] as const);
  const film = filmOf({ table, balls, names: ["cue", "1"], turned }, shot, []);
  /** How dark what is drawn over the ball is, from 0 to 1. */
  const darkness = (time: number): number => {
    const { r, q, seen } = film.shots[0]!.poses(time)[1]!;
    expect(seen).toBe(true);
    const fills: string[] = [];
    const g = new Proxy({} as Record<string, unknown>, {
      get: () => () => undefined,
      set: (_, name, value) => name !== "fillStyle" || fills.push(String(value)) > 0,
    }) as unknown as CanvasRenderingContext2D;
    drawBall(
      g,
      Object.assign(viewOf(), { scale: 100 }),
      { name: "1", radius: 0.0286 },
      1,
      { r, q, seen },
      1,
    );
    return Math.max(
      0,
      ...fills.flatMap((fill) => Number(/^rgb\(0 0 0 \/ (.*)\)$/.exec(fill)?.[1] ?? [])),
    );
  };
  expect(darkness(fall.time - 0.01)).toBe(0);
  const dark = [0.09, 0.11, 0.13].map((after) => darkness(fall.time + after));
  expect(dark[0]).toBeGreaterThan(0.05);
  expect(dark[1]).toBeGreaterThan(dark[0]!);
  expect(dark[2]).toBeGreaterThan(dark[1]!);
});

test("the way of a ball that falls ends in its pocket", () => {
  const { table, balls, shot } = potted();
  const turned = balls.map(() => [1, 0, 0, 0] as const);
  const film = filmOf({ table, balls, names: ["cue", "1"], turned }, shot, pathsOf(shot));
  const way = trailsOf(film).find(({ colour }) => colour === "#ffd84a")!;
  const end = way.points.at(-1)!;
  const far = table.pockets.map(
    ({ centre: [x, y], radius }) => Math.hypot(x - end[0]!, y - end[1]!) / radius,
  );
  expect(Math.min(...far)).toBeLessThan(1);
});

test.each([
  ["a phone that stands", 339, 560],
  ["a phone that lies", 650, 340],
  ["a desk", 1203, 660],
])("a film shows all of the table between the controls of %s", (_, width, height) => {
  for (const name of ["9ft", "snooker"] as const)
    for (const phi of [80, 260]) {
      const table = carom.table(name);
      const { eye, target, angle } = shotAcross(table, phi, { width, height });
      const camera = new THREE.PerspectiveCamera(angle, width / height);
      camera.up.set(0, 0, 1);
      camera.position.copy(eye);
      camera.lookAt(target);
      camera.updateMatrixWorld();
      const seen = [-WOOD, table.width + WOOD].flatMap((x) =>
        [-WOOD, table.length + WOOD].map((y) => new THREE.Vector3(x, y, 0).project(camera)),
      );
      const far = seen.flatMap(({ x, y }) => [Math.abs(x), Math.abs(y)]);
      expect(Math.max(...far)).toBeLessThanOrEqual(1);
      expect(Math.max(...far)).toBeGreaterThan(0.97);
    }
});

describePages("in a browser", () => {
  const { open, turnTo, frames } = pages();

  test("a picture of eight-ball's rack takes at most 25 draw calls, from above and from behind", async () => {
    const page = await open("", PHONE, { game: "eightball", against: "person", own: "0", seed: 7 });
    await page.evaluate(() => {
      const drawn: number[] = [];
      let calls = 0;
      const contexts = WebGL2RenderingContext.prototype as unknown as Record<
        string,
        (...values: unknown[]) => void
      >;
      for (const name of [
        "drawElements",
        "drawArrays",
        "drawElementsInstanced",
        "drawArraysInstanced",
      ]) {
        const draw = contexts[name]!;
        contexts[name] = function (...values) {
          // The calls of one picture follow each other without a pause.
          if (calls++ === 0)
            queueMicrotask(() => {
              drawn.push(calls);
              calls = 0;
            });
          draw.apply(this, values);
        };
      }
      Object.assign(window, { drawn });
    });
    const cost = async (phi: number) => {
      await frames(page, 4);
      await page.evaluate(() => ((window as unknown as { drawn: number[] }).drawn.length = 0));
      await turnTo(page, phi);
      await frames(page, 4);
      const { drawn } = await page.evaluate(() => ({
        drawn: (window as unknown as { drawn: number[] }).drawn,
      }));
      return Math.max(...drawn);
    };
    await act(page, "#new-game", "#table-view=scene", "#menu .close");
    await page.locator("#scene").waitFor({ state: "attached" });
    expect(await cost(80)).toBeLessThanOrEqual(25);
    await act(page, "#space");
    const behind = await cost(100);
    expect(behind).toBeGreaterThan(5);
    expect(behind).toBeLessThanOrEqual(25);
  });

  test("a game with fewer balls begins while a film of the one before is shown", async () => {
    const page = await open("", PHONE, { game: "eightball", against: "person", own: "0", seed: 7 });
    await act(page, "#shoot");
    await page.locator("#skip").waitFor();
    await frames(page, 4);
    await act(page, "#new-game", "#new-against=person", "#new-which=fourball", "#start");
    await says(page, "turn", /^Player 1/);
    expect(await page.locator("#table-scene").getAttribute("aria-label")).toContain("Four-ball");
  });
});
