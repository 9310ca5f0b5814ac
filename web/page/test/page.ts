// Pages in a real browser, for the tests of the page: Debian's Chromium, opened from the folder as
// a file; places of the table, drags and taps on it.
import { existsSync, readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { afterAll, afterEach, beforeAll, describe, expect } from "vitest";
import { type Browser, chromium, type Page } from "playwright-core";
import { WOOD } from "../../player/table.js";
import { root } from "../../test/support.js";

export const browserPath =
  process.env.CHROMIUM ??
  ["/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"].find(existsSync);
export const pageFile = `${root}web/page/dist/index.html`;
if (browserPath === undefined)
  console.log(
    "without the tests of the page: there is no Chromium (Debian: chromium); CHROMIUM may name one",
  );
/** A group of tests that need a browser. */
export const describePages = describe.runIf(browserPath !== undefined);
const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
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
export const PHONE = sizes[1][1];

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

/** What the page's browser keeps of the game that is open. */
export const keptSetup = async <T>(page: Page) => JSON.parse(await keptGame(page)) as T;
export const keptLines = async (page: Page) => (await keptSetup<{ lines: string[] }>(page)).lines;

const seed = Number(process.env.CAROM_TEST_SEED ?? 20141);
/**
 * Makes the random numbers of a page those of a seed (T. Ettinger's mulberry32), so that its racks
 * are the same in each run.
 */
function seeded(seed: number): void {
  let state = seed;
  Math.random = () => {
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
  const box = await boxOf(page, "#table-scene");
  const upright = box.height > box.width;
  const scale = box.width / ((upright ? w : l) + 2 * WOOD);
  return upright
    ? [box.x + (x + WOOD) * scale, box.y + (l + WOOD - y) * scale]
    : [box.x + (y + WOOD) * scale, box.y + (x + WOOD) * scale];
}
/** Fingers on a page: each call is one event, with the places of all and its time where that counts. */
export async function fingersOn(page: Page) {
  const devtools = await page.context().newCDPSession(page);
  return (
    type: "Start" | "Move" | "End",
    places: readonly (readonly number[])[] = [],
    timestamp?: number,
  ) =>
    devtools.send("Input.dispatchTouchEvent", {
      type: `touch${type}`,
      touchPoints: places.map(([x, y], id) => ({ x: x!, y: y!, id })),
      timestamp,
    });
}
/** Where a part of the page is. */
export const boxOf = async (page: Page, selector: string) =>
  (await page.locator(selector).boundingBox())!;
type Place = readonly [number, number];
/** Drags the mouse between two places of the page. */
export async function dragMouse(page: Page, start: Place, end: Place, steps = 1): Promise<void> {
  await page.mouse.move(...start);
  await page.mouse.down();
  await page.mouse.move(...end, { steps });
  await page.mouse.up();
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
  const send = await fingersOn(page);
  await send("Start", [a]);
  for (const step of steps) await send("Move", [step]);
  await send("End");
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
const pixel = (page: Page, x: number, y: number) =>
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
/** What is seen of a part of the page: red, green, blue and opacity of each pixel, row by row. */
export async function pictureOf(
  page: Page,
  selector: string,
): Promise<{ width: number; height: number; bytes: Buffer }> {
  const png = (await page.locator(selector).screenshot()).toString("base64");
  const { width, height, letters } = await page.evaluate(async (png) => {
    const image = new Image();
    image.src = `data:image/png;base64,${png}`;
    await image.decode();
    const copy = document.createElement("canvas");
    [copy.width, copy.height] = [image.width, image.height];
    const g = copy.getContext("2d")!;
    g.drawImage(image, 0, 0);
    const { data } = g.getImageData(0, 0, image.width, image.height);
    const letters = Array.from(data, (byte) => String.fromCharCode(byte)).join("");
    return { width: image.width, height: image.height, letters };
  }, png);
  return { width, height, bytes: Buffer.from(letters, "latin1") };
}
/** Waits until the page has drawn so many frames: what was asked for before them is seen. */
const frames = (page: Page, count = 2) =>
  page.evaluate(async (count) => {
    for (let k = 0; k < count; k++) await new Promise(requestAnimationFrame);
  }, count);
/** Sets the direction of a stroke, whose slider may be folded away. */
const turnTo = (page: Page, phi: number) =>
  page.locator("#phi").evaluate((input: HTMLInputElement, phi) => {
    input.value = String(phi);
    input.dispatchEvent(new Event("input"));
  }, phi);
const text = async (page: Page, id: string) => (await page.locator(`#${id}`).textContent())!;
/**
 * Does what whoever plays does, step by step: "#shoot" is pressed, "#power=3" sets a slider, a choice
 * or, with "on" and "off", a box.
 */
export async function act(page: Page, ...steps: string[]): Promise<void> {
  for (const step of steps) {
    const [, id, value] = /^(#[\w-]+)=(.*)$/.exec(step) ?? [];
    const control = page.locator(id ?? step);
    if (value === undefined) await control.click();
    else if (/^(on|off)$/.test(value)) await control.setChecked(value === "on");
    else if (await control.evaluate((element) => element.tagName === "SELECT"))
      await control.selectOption(value);
    else await control.fill(value);
  }
}
type Words = string | RegExp;
const matching = (words: Words) =>
  typeof words === "string" ? words : expect.stringMatching(words);
/** Checks the words of a part of the page, as they are or as they soon will be. */
export async function says(page: Page, id: string, words: Words): Promise<void> {
  expect(await text(page, id), id).toEqual(matching(words));
}
export async function comesToSay(page: Page, id: string, words: Words): Promise<void> {
  await expect.poll(() => text(page, id), { message: id }).toEqual(matching(words));
}
/** The same of whether a part is seen. */
export async function shows(page: Page, selector: string, isShown = true): Promise<void> {
  expect(await page.locator(selector).isVisible(), selector).toBe(isShown);
}
export async function comesToShow(page: Page, selector: string, isShown = true): Promise<void> {
  const seen = () => page.locator(selector).isVisible();
  await expect.poll(seen, { message: selector }).toBe(isShown);
}
/** The same of how many parts there are. */
export async function counts(page: Page, selector: string, count: number): Promise<void> {
  expect(await page.locator(selector).count(), selector).toBe(count);
}
export async function comesToCount(page: Page, selector: string, count: number): Promise<void> {
  await expect.poll(() => page.locator(selector).count(), { message: selector }).toBe(count);
}
export async function reload(page: Page): Promise<void> {
  await page.reload();
  await page.waitForSelector("main[aria-busy=false]");
}
/** What a control is set to. */
export const valueOf = (page: Page, id: string) => page.locator(`#${id}`).inputValue();
export const numberIn = async (page: Page, id: string) => Number(await valueOf(page, id));
/**
 * A game as a page keeps it, with its balls at places where some are named, and with the errors of
 * a rating, "0" for none.
 */
export const gameOf = (game: string, against: string, at?: string, own = "0") => ({
  game,
  against,
  own,
  seed: 7,
  ...(at !== undefined && { at }),
});
const set = (page: Page, id: string, value: number) => page.locator(`#${id}`).fill(String(value));

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
  const opened = new Set<Page>();
  afterEach(async () => {
    for (const page of opened) await page.close();
  });
  /**
   * Opens the page, with a game that was kept, in a tab of that kind that a test has closed, or in
   * a new one: a new tab takes a second. What a test leaves open is closed after it.
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
    opened.add(page);
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
      opened.delete(page);
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
