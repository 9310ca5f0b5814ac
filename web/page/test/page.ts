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
export const pageFile = `${root}web/page/dist/index.html`;
if (browserPath === undefined)
  console.log(
    "without the tests of the page: there is no Chromium (Debian: chromium); CHROMIUM may name one",
  );
export const axe = readFileSync(
  createRequire(import.meta.url).resolve("axe-core/axe.min.js"),
  "utf8",
);
/** What axe finds wrong with a page. */
export async function violations(page: Page): Promise<string[]> {
  await page.evaluate(axe);
  return page.evaluate(async () => {
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
export function keptGames(page: Page): Promise<{ open: string; games: Record<string, string> }> {
  return page.evaluate(async () => {
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
export async function keptGame(page: Page): Promise<string> {
  const { open, games } = await keptGames(page);
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
async function pixelOf(
  page: Page,
  x: number,
  y: number,
  [w, l]: readonly [number, number] = NINE_FEET,
): Promise<[number, number]> {
  const box = (await page.locator("#table-scene").boundingBox())!;
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
  page: Page,
  start: readonly [number, number],
  end: readonly [number, number],
  touch = false,
): Promise<void> {
  const a = await pixelOf(page, ...start);
  const b = await pixelOf(page, ...end);
  const steps = Array.from(
    { length: 8 },
    (_, k) => a.map((x, c) => x + ((b[c]! - x) * (k + 1)) / 8) as [number, number],
  );
  if (!touch) {
    await page.mouse.move(...a);
    await page.mouse.down();
    for (const step of steps) await page.mouse.move(...step);
    return page.mouse.up();
  }
  const devtools = await page.context().newCDPSession(page);
  const send = (
    type: "touchStart" | "touchMove" | "touchEnd",
    pixel?: [number, number],
  ): Promise<unknown> =>
    devtools.send("Input.dispatchTouchEvent", {
      type,
      touchPoints: pixel ? [{ x: pixel[0], y: pixel[1] }] : [],
    });
  await send("touchStart", a);
  for (const step of steps) await send("touchMove", step);
  await send("touchEnd");
}
async function click(page: Page, x: number, y: number, touch = false): Promise<void> {
  const pixel = await pixelOf(page, x, y);
  await (touch ? page.touchscreen.tap(...pixel) : page.mouse.click(...pixel));
}
/** Where the balls of the page lie, by the line that it exports: label, x, y. */
async function lies(page: Page): Promise<Record<string, number[]>> {
  const details = page.locator("main details");
  if ((await details.getAttribute("open")) === null) await page.locator("main summary").click();
  await page.locator("#export").click();
  const line = JSON.parse(await page.locator("#line").inputValue()) as {
    balls: { id: string; state: number[] }[];
  };
  await page.evaluate(() => scrollTo(0, 0));
  return Object.fromEntries(line.balls.map(({ id, state }) => [id, state.slice(0, 3)]));
}
/** Pixels of the table's picture in a rectangle of the page: red, green, blue and alpha of each. */
function pixels(
  page: Page,
  x: number,
  y: number,
  width: number,
  height: number,
): Promise<number[]> {
  return page.locator("#table-scene").evaluate(
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
const pixel = (page: Page, x: number, y: number): Promise<number[]> =>
  pixels(page, x, y, 1, 1).then((colours) => colours.slice(0, 3));
/**
 * The colour of the table's picture at a place, m; or the brightest of each part in a square of so
 * many pixels around it.
 */
async function colour(page: Page, x: number, y: number, size = 1): Promise<number[]> {
  const [px, py] = await pixelOf(page, x, y);
  const data = await pixels(page, px - (size - 1) / 2, py - (size - 1) / 2, size, size);
  return [0, 1, 2].map((part) => Math.max(...data.filter((_, k) => k % 4 === part)));
}
/** How many pixels between two places are bright in each part. */
async function bright(
  page: Page,
  start: readonly [number, number],
  end: readonly [number, number],
): Promise<number> {
  const [ax, ay] = await pixelOf(page, ...start);
  const [bx, endY] = await pixelOf(page, ...end);
  const data = await pixels(
    page,
    Math.min(ax, bx),
    Math.min(ay, endY),
    Math.min(Math.abs(ax - bx), 300),
    Math.min(Math.abs(ay - endY), 150),
  );
  let count = 0;
  for (let k = 0; k < data.length; k += 4)
    if (Math.min(data[k]!, data[k + 1]!, data[k + 2]!) > 140) count++;
  return count;
}
/** Waits until the page has drawn so many frames: what was asked for before them is seen. */
const frames = (page: Page, count = 2): Promise<void> =>
  page.evaluate(async (count) => {
    for (let k = 0; k < count; k++) await new Promise(requestAnimationFrame);
  }, count);
/** Sets the direction of a stroke, whose slider may be folded away. */
const turnTo = (page: Page, phi: number): Promise<void> =>
  page.locator("#phi").evaluate((input: HTMLInputElement, phi) => {
    input.value = String(phi);
    input.dispatchEvent(new Event("input"));
  }, phi);
const text = async (page: Page, id: string): Promise<string> =>
  (await page.locator(`#${id}`).textContent())!;
const set = (page: Page, id: string, value: number): Promise<void> =>
  page.locator(`#${id}`).fill(String(value));

/** What the lines of a kind hold, of a game that is kept. */
export function linesOf<T = object>(game: string, kind: string): T[] {
  const { lines } = JSON.parse(game) as { lines: string[] };
  return lines.flatMap((line) => (JSON.parse(line) as Record<string, T>)[kind] ?? []);
}

/**
 * A number of the first stroke of the game that is kept, of which a line has some as hexadecimal
 * text.
 */
async function struck(page: Page, key: string): Promise<number> {
  const [shot] = linesOf<Record<string, number | string>>(await keptGame(page), "shot");
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
  const messages: string[] = [];
  const requests: string[] = [];
  beforeAll(async () => {
    console.log(`seed ${seed} (replay with CAROM_TEST_SEED)`);
    browser = await chromium.launch({
      executablePath: browserPath!,
      args: ["--no-sandbox", "--enable-unsafe-swiftshader"],
    });
  });
  afterAll(async () => {
    await browser?.close();
    expect(messages).toEqual([]);
    // Nothing is loaded from elsewhere, nor anything beside the page itself.
    expect(
      requests.filter(
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
    const page = free[kind]?.pop() ?? (await tab(kind, width, height, dark, touch));
    // A picture of the same origin, where what an earlier game has kept goes.
    await page.goto(`file://${pageFile.replace("index.html", "icon.svg")}`);
    await page.evaluate(
      (text) => {
        localStorage.clear();
        sessionStorage.clear();
        indexedDB.deleteDatabase("carom");
        // As version 0.3 kept a game: the page takes it over.
        if (text) localStorage.setItem("carom-game", text);
      },
      game && JSON.stringify(game),
    );
    await page.goto(`file://${pageFile}${hash}`);
    await page.waitForSelector("main[aria-busy=false]");
    return page;
  }
  async function tab(
    kind: string,
    width: number,
    height: number,
    dark: boolean,
    touch: boolean,
  ): Promise<Page> {
    const page = await browser.newPage({
      viewport: { width, height },
      colorScheme: dark ? "dark" : "light",
      hasTouch: touch,
      permissions: ["clipboard-read", "clipboard-write"],
    });
    page.setDefaultTimeout(300_000);
    page.on(
      "console",
      (message) =>
        ["error", "warning"].includes(message.type()) &&
        !message.text().includes("GPU stall due to ReadPixels") &&
        messages.push(`${page.url()}: ${message.text()}`),
    );
    page.on("pageerror", (error) => messages.push(`${page.url()}: ${error.message}`));
    page.on("request", (request) => requests.push(request.url()));
    await page.addInitScript(seeded, seed);
    page.close = async () => {
      await page.emulateMedia({ media: null });
      await page.goto("about:blank");
      (free[kind] ??= []).push(page);
    };
    return page;
  }

  return {
    open,
    pixelOf,
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
    messages,
    browser: () => browser,
  };
}
