// The page in a real browser: Debian's Chromium, opened from the folder as a file. Numbers are compared with the command `carom`.
import { existsSync, readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { afterAll, beforeAll, describe, expect, test } from "vitest";
import { type Browser, chromium, type Page } from "playwright-core";
import { root, run, thereIsACommand } from "./support.js";

const browserPath = process.env.CHROMIUM ?? ["/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"].find(existsSync);
const page = `${root}web/explorer/dist/index.html`;
if (browserPath === undefined) console.log("without the tests of the page: there is no Chromium (Debian: chromium); CHROMIUM may name one");
const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");

describe.runIf(browserPath !== undefined)("the page", () => {
  let browser: Browser;
  const said: string[] = [];
  const asked: string[] = [];
  beforeAll(async () => {
    browser = await chromium.launch({ executablePath: browserPath!, args: ["--no-sandbox"] });
  });
  afterAll(async () => {
    await browser?.close();
    expect(said).toEqual([]);
    // Nothing is loaded from elsewhere, nor anything beside the page itself.
    expect(asked.filter((url) => !url.startsWith("file://") && !url.startsWith("data:") && !url.startsWith("blob:"))).toEqual([]);
  });

  async function open(hash: string, { width = 1300, height = 900, dark = false } = {}): Promise<Page> {
    const one = await browser.newPage({ viewport: { width, height }, colorScheme: dark ? "dark" : "light" });
    one.on("console", (message) => ["error", "warning"].includes(message.type()) && said.push(`${hash}: ${message.text()}`));
    one.on("pageerror", (error) => said.push(`${hash}: ${error.message}`));
    one.on("request", (request) => asked.push(request.url()));
    await one.goto(`file://${page}${hash}`);
    await one.waitForSelector("main[aria-busy=false]");
    return one;
  }
  const text = async (one: Page, id: string): Promise<string> => (await one.locator(`#${id}`).textContent())!;
  const set = (one: Page, id: string, value: number): Promise<void> => one.locator(`#${id}`).fill(String(value));

  test.runIf(thereIsACommand)("sliders of a collision give the command's throw, deflection and speeds", async () => {
    const one = await open("#view=collision");
    for (const [speed, cut, side, tip] of [
      [1.5, 30, 0, 0.4],
      [3.2, -42.5, 0.31, -0.2],
      [0.7, 15, -0.5, 0],
    ] as const) {
      await set(one, "speed", speed);
      await set(one, "cut", cut);
      await set(one, "side", side);
      await set(one, "tip", tip);
      const spin = `${(2.5 * speed * tip) / 0.028575}rad/s`;
      const english = `${(-2.5 * speed * side) / 0.028575}rad/s`;
      const told = run(["hit", "--speed", String(speed), "--cut", String(cut), `--spin=${spin}`, `--side=${english}`, "--friction", "alciatore", "--csv"]);
      const derived = run(["resolve", "--derived", "-"], told).trim().split("\n").map((line) => line.split(","));
      const number = (column: string): number => Number(derived[1]![derived[0]!.indexOf(column)]);
      const v = (ball: number): [number, number] => [number(`v${ball}x`), number(`v${ball}y`)];
      const angle = ([x, y]: [number, number]): string => `${Math.abs((Math.atan2(y, x) * 180) / Math.PI).toFixed(2)}° ${y > 0 ? "left" : "right"}`;
      const speedOf = ([x, y]: [number, number]): string => `${Math.hypot(x, y).toFixed(3)} m/s`;
      expect(await text(one, "n-object")).toBe(`${angle(v(2))}, ${speedOf(v(2))}`);
      expect(await text(one, "n-deflection")).toBe(`${angle(v(1))}, ${speedOf(v(1))}`);
      const thrown = (Math.atan2(v(2)[1], v(2)[0]) * 180) / Math.PI - cut;
      expect(await text(one, "n-throw")).toBe(`${Math.abs(thrown).toFixed(2)}° ${thrown > 0 ? "left" : "right"}`);
      expect(await text(one, "n-spin")).toBe(`${number("w2z").toFixed(2)} rad/s`);
    }
    await one.close();
  });

  test("dragging the cue ball, keys and the address", async () => {
    const one = await open("#view=collision&speed=2&cut=10");
    expect(await one.locator("#speed").inputValue()).toBe("2");
    expect(await one.locator("#cut").inputValue()).toBe("10");
    const scene = one.locator("#collision-scene");
    const box = (await scene.boundingBox())!;
    await one.mouse.move(box.x + box.width * 0.4, box.y + box.height * 0.5);
    await one.mouse.down();
    await one.mouse.move(box.x + box.width * 0.5 - 100, box.y + box.height * 0.5 + 100, { steps: 5 });
    await one.mouse.up();
    expect(await one.locator("#cut").inputValue()).toBe("45");
    await scene.press("ArrowRight");
    expect(await one.locator("#cut").inputValue()).toBe("45.5");
    const exact = await text(one, "n-throw");
    await one.locator("#solver").selectOption("euler");
    expect(await text(one, "n-stick")).toContain("not told");
    expect(parseFloat(await text(one, "n-throw"))).toBeCloseTo(parseFloat(exact), 1);
    await one.waitForURL(/solver=euler/);
    expect(one.url()).toMatch(/view=collision&speed=2&cut=45.5&solver=euler/);
    await one.close();
  });

  test.runIf(thereIsACommand)("a break plays to its end, with the command's final state", async () => {
    const one = await open("#view=shot&phi=89.3&a=0.1");
    await one.locator("summary").click();
    await one.locator("#export").click();
    const line = await one.locator("#line").inputValue();
    const played = JSON.parse(run(["shoot", "-"], line)) as { status: string; events: unknown[][]; final: { t: number; balls: Record<string, number[]> } };
    expect(await text(one, "s-status")).toBe(played.status);
    expect(await text(one, "s-time")).toBe(`${played.final.t.toFixed(3)} s`);
    expect(await text(one, "s-count")).toBe(String(played.events.filter(([, type]) => type !== "none").length));
    const cue = played.final.balls.cue!;
    expect(await text(one, "s-cue-ball")).toBe(cue[0] === 4 ? "in a pocket" : `${cue[1]!.toFixed(4)}, ${cue[2]!.toFixed(4)} m`);
    const fell = Object.entries(played.final.balls).filter(([, state]) => state[0] === 4).map(([name]) => name);
    expect(await text(one, "s-pocketed")).toBe(fell.join(", ") || "none");
    // The film, from shortly before its end.
    await set(one, "time", Math.floor(1000 * (played.final.t - 0.5)) / 1000);
    await one.locator("#play").click();
    expect(await text(one, "play")).toBe("Pause");
    await expect.poll(() => text(one, "play"), { timeout: 20000 }).toBe("Play");
    expect(Number(await one.locator("#time").inputValue())).toBeCloseTo(played.final.t, 2);
    expect(await one.locator('.events li[aria-current="true"] + li').count()).toBe(0);
    // From event to event.
    await one.locator(".events button").first().click();
    await one.locator("#forward").click();
    expect(Number(await one.locator("#time").inputValue())).toBeCloseTo(Number(await text(one, "s-contact").then((t) => t.match(/after ([\d.]+)/)![1])), 2);
    await one.locator("#back").click();
    expect(Number(await one.locator("#time").inputValue())).toBe(0);
    await one.close();
  });

  test("a line is read back, and a bad one is refused with its key", async () => {
    const one = await open("#view=shot");
    await one.locator("summary").click();
    await one.locator("#line").fill(readFileSync(`${root}data/break-nineball.jsonl`, "utf8"));
    await one.locator("#import").click();
    expect(await text(one, "message")).toBe("");
    expect(await one.locator("#speed").inputValue()).toBe("9");
    if (thereIsACommand) {
      const played = JSON.parse(run(["shoot", "--events", "none", `${root}data/break-nineball.jsonl`])) as { final: { t: number; balls: Record<string, number[]> } };
      const [, x, y] = played.final.balls.cue!;
      expect(await text(one, "s-time")).toBe(`${played.final.t.toFixed(3)} s`);
      expect(await text(one, "s-cue-ball")).toBe(`${x!.toFixed(4)}, ${y!.toFixed(4)} m`);
      // The address has the whole shot.
      await one.waitForURL(/line=/);
      const again = await open(new URL(one.url()).hash);
      expect(await text(again, "s-time")).toBe(`${played.final.t.toFixed(3)} s`);
      await again.close();
    }
    await one.locator("#line").fill('{"kind": "shot", "table": "9ft", "balls": []}');
    await one.locator("#import").click();
    expect(await text(one, "message")).toContain("balls: ");
    await one.close();
  });

  test("aiming: the frame rate while one drags, the cue ball moved, every game", async () => {
    const one = await open("#view=shot&game=eightball");
    const box = (await one.locator("#table-scene").boundingBox())!;
    const rate = one.evaluate(
      () =>
        new Promise<number>((done) => {
          let frames = 0;
          const begun = performance.now();
          const count = (): void => {
            frames++;
            if (performance.now() - begun > 1500) done((1000 * frames) / (performance.now() - begun));
            else requestAnimationFrame(count);
          };
          requestAnimationFrame(count);
        }),
    );
    await one.mouse.move(box.x + box.width * 0.7, box.y + box.height * 0.3);
    await one.mouse.down();
    for (let k = 0; k < 60; k++) await one.mouse.move(box.x + box.width * 0.7, box.y + box.height * (0.3 + 0.005 * k));
    console.log(`frames a second while an eight-ball break is aimed: ${(await rate).toFixed(0)}; ${await text(one, "cost")}`);
    await one.mouse.up();
    expect(await one.locator("#phi").inputValue()).not.toBe("90");
    for (const game of ["nineball", "snooker", "threecushion"]) {
      await one.locator("#game").selectOption(game);
      expect(await text(one, "s-status")).toBe("ok");
      expect(Number(await text(one, "s-count"))).toBeGreaterThan(5);
    }
    for (const cushion of ["han", "stronge", "mirror"]) {
      await one.locator("#cushion").selectOption(cushion);
      expect(await text(one, "s-status")).toBe("ok");
    }
    await one.locator("#solver").selectOption("euler");
    expect(await text(one, "s-status")).toBe("ok");
    await one.close();
  });

  test("a fan of 500 shots", async () => {
    const one = await open("#view=shot&game=threecushion&speed=4&phi=62&fan=1");
    await expect.poll(() => text(one, "cost"), { timeout: 50000 }).toContain("500 of 500");
    await one.close();
  });

  test.each([
    ["collision", "#view=collision", {}],
    ["collision, dark, phone", "#view=collision", { dark: true, width: 390, height: 800 }],
    ["shot", "#view=shot", {}],
    ["shot, dark, phone", "#view=shot&game=snooker", { dark: true, width: 390, height: 800 }],
  ] as const)("axe finds nothing: %s", async (_, hash, how) => {
    const one = await open(hash, how);
    if (hash.includes("shot")) await one.locator("summary").click();
    await one.evaluate(axe);
    const found = await one.evaluate(async () => {
      const { violations } = await (window as unknown as { axe: { run(): Promise<{ violations: { id: string; nodes: { html: string }[] }[] }> } }).axe.run();
      return violations.map(({ id, nodes }) => `${id}: ${nodes.map((node) => node.html.slice(0, 120)).join(" | ")}`);
    });
    expect(found).toEqual([]);
    // Nothing is wider than the screen.
    expect(await one.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth)).toBeLessThanOrEqual(0);
    await one.close();
  });

  test.each(["eightball", "nineball"])("a game of %s is played to its end", async (name) => {
    const one = await open(`#view=shot&game=${name}`, { width: 390, height: 844 });
    await one.locator("#opponent").selectOption("400");
    await one.locator("#own").selectOption("0");
    await one.locator("#rate").selectOption("1000");
    await one.locator("#new-game").click();
    await expect.poll(() => text(one, "chance")).toMatch(/plays on \d+ %, wins the game \d+ %, is a foul \d+ %/);
    await one.locator("#shoot").click();
    // Whoever is at the table: I play the best shot, the opponent replies by himself.
    for (let k = 0; k < 100; k++) {
      await expect.poll(() => text(one, "game-state"), { timeout: 60_000 }).toMatch(/Your turn|has won|have won/);
      if (/won/.test(await text(one, "game-state"))) break;
      await one.locator("#best").click();
      await expect.poll(() => text(one, "game-state"), { timeout: 60_000 }).toMatch(/Best of/);
      await one.locator("#shoot").click();
    }
    expect(await text(one, "game-state")).toMatch(/^(The opponent fouls. |You foul. )?(You have|The opponent has) won.$/);
    expect(await one.locator("#shoot").isVisible()).toBe(false);
    await one.close();
  }, 240_000);

  test("in a game the cue ball moves where the rules let it", async () => {
    const one = await open("#view=shot&game=nineball");
    await one.locator("#new-game").click();
    const scene = one.locator("#table-scene");
    const box = (await scene.boundingBox())!;
    const at = async (): Promise<number[]> => {
      await one.locator("summary").click();
      await one.locator("#export").click();
      const line = JSON.parse(await one.locator("#line").inputValue()) as { balls: { state: number[] }[] };
      await one.locator("summary").click();
      return line.balls[0]!.state.slice(1, 3);
    };
    const before = await at();
    // from the head spot towards the foot of the table: it stops at the head string
    await one.mouse.move(box.x + box.width * 0.27, box.y + box.height * 0.5);
    await one.mouse.down();
    await one.mouse.move(box.x + box.width * 0.6, box.y + box.height * 0.3, { steps: 4 });
    await one.mouse.up();
    const after = await at();
    expect(after[0]).not.toBe(before[0]);
    expect(after[1]).toBeCloseTo(2.54 / 4, 3);
    await one.close();
  });
});
