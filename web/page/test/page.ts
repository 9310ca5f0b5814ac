// Pages in a real browser, for the tests of the page: Debian's Chromium, opened from the folder as
// a file; places of the table, drags and taps on it.
import { existsSync, readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { afterAll, beforeAll, expect } from "vitest";
import { type Browser, chromium, type Page } from "playwright-core";
import { root } from "../../test/support.js";

export const browserPath =
  process.env.CHROMIUM ??
  ["/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"].find(existsSync);
export const page = `${root}web/page/dist/index.html`;
if (browserPath === undefined)
  console.log(
    "without the tests of the page: there is no Chromium (Debian: chromium); CHROMIUM may name one",
  );
export const axe = readFileSync(
  createRequire(import.meta.url).resolve("axe-core/axe.min.js"),
  "utf8",
);
/** What axe finds wrong with a page. */
export async function violations(one: Page): Promise<string[]> {
  await one.evaluate(axe);
  return one.evaluate(async () => {
    const { violations } = await (
      window as unknown as {
        axe: { run(): Promise<{ violations: { id: string; nodes: { html: string }[] }[] }> };
      }
    ).axe.run();
    return violations.map(
      ({ id, nodes }) => `${id}: ${nodes.map((node) => node.html.slice(0, 120)).join(" | ")}`,
    );
  });
}
export const sizes = [
  ["wide", { width: 1280, height: 800 }],
  ["phone", { width: 390, height: 844, touch: true }],
] as const;

/** The games that a page's browser keeps, as text, by their ids; and which one the tab has open. */
export function keptGames(one: Page): Promise<{ open: string; games: Record<string, string> }> {
  return one.evaluate(async () => {
    const finished = <T>(request: IDBRequest<T>): Promise<T> =>
      new Promise((done, failed) => {
        request.addEventListener("success", () => done(request.result));
        request.addEventListener("error", () => failed(request.error));
      });
    const database = await finished(indexedDB.open("carom"));
    const store = database.transaction("games").objectStore("games");
    const games = (await finished(store.getAll())) as { id: string; text: string }[];
    database.close();
    return {
      open: sessionStorage.getItem("carom-open") ?? "",
      games: Object.fromEntries(games.map(({ id, text }) => [id, text])),
    };
  });
}
/** The text of the game that a page has open, as its browser keeps it. */
export async function keptGame(one: Page): Promise<string> {
  const { open, games } = await keptGames(one);
  return games[open]!;
}

const seed = Number(process.env.CAROM_TEST_SEED ?? 20141);
/**
 * Makes the random numbers of a page those of a seed (T. Ettinger's mulberry32), so that its racks
 * are the same in each run.
 */
function seeded(seed: number): void {
  let state = seed;
  Math.random = (): number => {
    state = (state + 0x6d2b79f5) | 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 2 ** 32;
  };
}

const NINE_FEET = [1.27, 2.54] as const;
/** Where a place of a table, m, is on the page. */
async function on(
  one: Page,
  x: number,
  y: number,
  [w, l]: readonly [number, number] = NINE_FEET,
): Promise<[number, number]> {
  const box = (await one.locator("#table-scene").boundingBox())!;
  const upright = box.height > box.width;
  const scale = box.width / ((upright ? w : l) + 0.2);
  return upright
    ? [box.x + (x + 0.1) * scale, box.y + (l + 0.1 - y) * scale]
    : [box.x + (y + 0.1) * scale, box.y + (x + 0.1) * scale];
}
/**
 * Drags with the mouse, or with a finger where the page has one, from one place of the table to
 * another.
 */
async function drag(
  one: Page,
  from: readonly [number, number],
  to: readonly [number, number],
  touch = false,
): Promise<void> {
  const a = await on(one, ...from);
  const b = await on(one, ...to);
  const steps = Array.from(
    { length: 8 },
    (_, k) => a.map((x, c) => x + ((b[c]! - x) * (k + 1)) / 8) as [number, number],
  );
  if (!touch) {
    await one.mouse.move(...a);
    await one.mouse.down();
    for (const step of steps) await one.mouse.move(...step);
    return one.mouse.up();
  }
  const devtools = await one.context().newCDPSession(one);
  const send = (
    type: "touchStart" | "touchMove" | "touchEnd",
    at?: [number, number],
  ): Promise<unknown> =>
    devtools.send("Input.dispatchTouchEvent", {
      type,
      touchPoints: at ? [{ x: at[0], y: at[1] }] : [],
    });
  await send("touchStart", a);
  for (const step of steps) await send("touchMove", step);
  await send("touchEnd");
}
async function click(one: Page, x: number, y: number, touch = false): Promise<void> {
  const at = await on(one, x, y);
  await (touch ? one.touchscreen.tap(...at) : one.mouse.click(...at));
}
/** Where the balls of the page lie, by the line that it exports: label, x, y. */
async function lies(one: Page): Promise<Record<string, number[]>> {
  const details = one.locator("main details");
  if ((await details.getAttribute("open")) === null) await one.locator("main summary").click();
  await one.locator("#export").click();
  const line = JSON.parse(await one.locator("#line").inputValue()) as {
    balls: { id: string; state: number[] }[];
  };
  await one.evaluate(() => scrollTo(0, 0));
  return Object.fromEntries(line.balls.map(({ id, state }) => [id, state.slice(0, 3)]));
}
/** Pixels of the table's picture in a rectangle of the page: red, green, blue and alpha of each. */
function pixels(one: Page, x: number, y: number, width: number, height: number): Promise<number[]> {
  return one.locator("#table-scene").evaluate(
    (canvas, [x, y, width, height]) => {
      const box = canvas.getBoundingClientRect();
      const ratio = (canvas as HTMLCanvasElement).width / box.width;
      // Of a copy: what is read often is drawn otherwise.
      const copy = document.createElement("canvas").getContext("2d")!;
      copy.drawImage(
        canvas as HTMLCanvasElement,
        -Math.round((x - box.left) * ratio),
        -Math.round((y - box.top) * ratio),
      );
      return [...copy.getImageData(0, 0, width, height).data];
    },
    [x, y, width, height] as const,
  );
}
const pixel = (one: Page, x: number, y: number): Promise<number[]> =>
  pixels(one, x, y, 1, 1).then((all) => all.slice(0, 3));
/**
 * The colour of the table's picture at a place, m; or the brightest of each part in a square of so
 * many pixels around it.
 */
async function colour(one: Page, x: number, y: number, size = 1): Promise<number[]> {
  const [px, py] = await on(one, x, y);
  const data = await pixels(one, px - (size - 1) / 2, py - (size - 1) / 2, size, size);
  return [0, 1, 2].map((part) => Math.max(...data.filter((_, k) => k % 4 === part)));
}
/** How many pixels between two places are bright in each part. */
async function bright(
  one: Page,
  from: readonly [number, number],
  to: readonly [number, number],
): Promise<number> {
  const [ax, ay] = await on(one, ...from);
  const [bx, by] = await on(one, ...to);
  const data = await pixels(
    one,
    Math.min(ax, bx),
    Math.min(ay, by),
    Math.min(Math.abs(ax - bx), 300),
    Math.min(Math.abs(ay - by), 150),
  );
  let count = 0;
  for (let k = 0; k < data.length; k += 4)
    if (Math.min(data[k]!, data[k + 1]!, data[k + 2]!) > 140) count++;
  return count;
}
/** Waits until the page has drawn so many frames: what was asked for before them is seen. */
const frames = (one: Page, count = 2): Promise<void> =>
  one.evaluate(async (count) => {
    for (let k = 0; k < count; k++) await new Promise(requestAnimationFrame);
  }, count);
/** Sets the direction of a stroke, whose slider may be folded away. */
const turnTo = (one: Page, phi: number): Promise<void> =>
  one.locator("#phi").evaluate((input: HTMLInputElement, phi) => {
    input.value = String(phi);
    input.dispatchEvent(new Event("input"));
  }, phi);
const text = async (one: Page, id: string): Promise<string> =>
  (await one.locator(`#${id}`).textContent())!;
const set = (one: Page, id: string, value: number): Promise<void> =>
  one.locator(`#${id}`).fill(String(value));

/** What the lines of a kind hold, of a game that is kept. */
export function linesOf<T = object>(game: string, kind: string): T[] {
  const { lines } = JSON.parse(game) as { lines: string[] };
  return lines.flatMap((line) => (JSON.parse(line) as Record<string, T>)[kind] ?? []);
}

/**
 * A number of the first stroke of the game that is kept, of which a line has some as hexadecimal
 * text.
 */
async function struck(one: Page, key: string): Promise<number> {
  const [shot] = linesOf<Record<string, number | string>>(await keptGame(one), "shot");
  const value = shot![key]!;
  const [, digits = "", power = "0"] = /^0x1\.?([0-9a-f]*)p([+-]\d+)/.exec(String(value)) ?? [];
  return typeof value === "number"
    ? value
    : (1 + (parseInt(digits, 16) || 0) / 16 ** digits.length) * 2 ** Number(power);
}

/**
 * A browser for the tests of a file: they fail where a page complains, or asks for anything
 * elsewhere.
 */
export function pages() {
  let browser: Browser;
  const said: string[] = [];
  const asked: string[] = [];
  beforeAll(async () => {
    console.log(`seed ${seed} (replay with CAROM_TEST_SEED)`);
    browser = await chromium.launch({
      executablePath: browserPath!,
      args: ["--no-sandbox", "--enable-unsafe-swiftshader"],
    });
  });
  afterAll(async () => {
    await browser?.close();
    expect(said).toEqual([]);
    // Nothing is loaded from elsewhere, nor anything beside the page itself.
    expect(
      asked.filter(
        (url) => !url.startsWith("file://") && !url.startsWith("data:") && !url.startsWith("blob:"),
      ),
    ).toEqual([]);
  });

  const free: Record<string, Page[]> = {};
  /**
   * Opens the page, with a game that was kept, in a tab of that kind that a test has closed, or in
   * a new one: a new tab takes a second.
   */
  async function open(
    hash: string,
    { width = 1300, height = 800, dark = false, touch = false } = {},
    game?: object,
  ): Promise<Page> {
    const kind = [width, height, dark, touch].join();
    const one = free[kind]?.pop() ?? (await tab(kind, width, height, dark, touch));
    // A picture of the same origin, where what an earlier game has kept goes.
    await one.goto(`file://${page.replace("index.html", "icon.svg")}`);
    await one.evaluate(
      (text) => {
        localStorage.clear();
        sessionStorage.clear();
        indexedDB.deleteDatabase("carom");
        // As version 0.3 kept a game: the page takes it over.
        if (text) localStorage.setItem("carom-game", text);
      },
      game && JSON.stringify(game),
    );
    await one.goto(`file://${page}${hash}`);
    await one.waitForSelector("main[aria-busy=false]");
    return one;
  }
  async function tab(
    kind: string,
    width: number,
    height: number,
    dark: boolean,
    touch: boolean,
  ): Promise<Page> {
    const one = await browser.newPage({
      viewport: { width, height },
      colorScheme: dark ? "dark" : "light",
      hasTouch: touch,
      permissions: ["clipboard-read", "clipboard-write"],
    });
    one.setDefaultTimeout(300_000);
    one.on(
      "console",
      (message) =>
        ["error", "warning"].includes(message.type()) &&
        !message.text().includes("GPU stall due to ReadPixels") &&
        said.push(`${one.url()}: ${message.text()}`),
    );
    one.on("pageerror", (error) => said.push(`${one.url()}: ${error.message}`));
    one.on("request", (request) => asked.push(request.url()));
    await one.addInitScript(seeded, seed);
    one.close = async () => {
      await one.emulateMedia({ media: null });
      await one.goto("about:blank");
      (free[kind] ??= []).push(one);
    };
    return one;
  }

  return {
    open,
    on,
    drag,
    click,
    lies,
    pixel,
    colour,
    bright,
    frames,
    turnTo,
    text,
    set,
    struck,
    said,
    browser: () => browser,
  };
}
