// Devices that differ from a desk with a good network: a browser that takes the graphics processor
// away, a network that accepts and never answers, many kept games, a page that is loaded again.
import { readFileSync } from "node:fs";
import { createServer, type Server } from "node:http";
import type { AddressInfo } from "node:net";
import { dirname } from "node:path";
import { afterAll, beforeAll, expect, test } from "vitest";
import type { Page } from "playwright-core";
import {
  act,
  comesToCount,
  comesToShow,
  describePages,
  gameOf,
  keptGames,
  pageFile,
  pages,
  PHONE,
  reload,
} from "./page.js";

const TYPES: Record<string, string> = {
  "/": "text/html",
  "/sw.js": "text/javascript",
  "/icon.svg": "image/svg+xml",
  "/manifest.webmanifest": "application/manifest+json",
};

describePages("a device", () => {
  const { browser, open, frames } = pages();
  let server: Server;
  let address = "";
  let answers = true;
  /** What the network gives for the page instead of the file. */
  let changed: string | undefined;
  beforeAll(async () => {
    server = createServer(({ url = "/" }, response) => {
      if (!answers) return; // accepted, and never answered
      const type = TYPES[url];
      response.writeHead(type ? 200 : 404, { "content-type": type ?? "text/plain" });
      const file = url === "/" ? pageFile : `${dirname(pageFile)}${url}`;
      response.end(type ? ((url === "/" ? changed : undefined) ?? readFileSync(file)) : "");
    });
    await new Promise<void>((listens) => server.listen(0, "127.0.0.1", listens));
    address = `http://127.0.0.1:${(server.address() as AddressInfo).port}/`;
  });
  afterAll(() => {
    server.close();
    server.closeAllConnections();
  });
  const isReady = (page: Page) => page.waitForSelector("main[aria-busy=false]");

  test("a network that never answers: the page that was kept is there, and the next one is newer", async () => {
    const context = await browser().newContext({ viewport: { width: 390, height: 844 } });
    const page = await context.newPage();
    await page.goto(address);
    await isReady(page);
    await page.evaluate(async () => {
      await navigator.serviceWorker.ready;
      if (!navigator.serviceWorker.controller)
        await new Promise((controls) =>
          navigator.serviceWorker.addEventListener("controllerchange", controls),
        );
    });
    await page.reload();
    await isReady(page);
    answers = false;
    await page.goto("about:blank");
    await page.goto(address, { timeout: 60_000 });
    await isReady(page);

    // What the network has by now is asked for, and shown the next time.
    answers = true;
    changed = readFileSync(pageFile, "utf8").replace("<title>", "<title>newer ");
    const title = async (): Promise<string> => {
      await page.goto("about:blank");
      await page.goto(address);
      return page.title();
    };
    expect(await title()).not.toMatch(/^newer/);
    await expect.poll(title).toMatch(/^newer/);
    changed = undefined;
    await context.close();
  });

  test("a scene whose context is lost: the drawn table is there at once, then the scene again", async () => {
    const page = await open("", PHONE, gameOf("nineball", "person"));
    await act(page, "#new-game", "#table-view=scene", "#menu .close");
    await page.locator("#scene").waitFor({ state: "attached" });
    await act(page, "#space");
    await frames(page, 4);
    const lose = () =>
      page.evaluate(() => {
        const scene = document.querySelector<HTMLCanvasElement>("#scene")!;
        scene.dataset.old = "yes";
        scene.getContext("webgl2")!.getExtension("WEBGL_lose_context")!.loseContext();
      });
    for (let loss = 0; loss < 3; loss++) {
      await lose();
      await comesToCount(page, "#scene[data-old]", 0);
      expect(await page.locator("#table-scene.behind").count()).toBe(
        await page.locator("#scene").count(),
      );
      await page.locator("#scene:not([data-old])").waitFor({ state: "attached" });
      await comesToShow(page, "#table-scene.behind", false);
      await expect.poll(() => page.locator("#space").getAttribute("aria-pressed")).toBe("true");
    }
    // One that is lost each time stays away.
    await lose();
    await comesToCount(page, "#scene", 0);
    await comesToShow(page, "#table-scene");
    await page.waitForTimeout(1500);
    await comesToCount(page, "#scene", 0);
  });

  test("a page that is loaded again goes on with the time that is left for a stroke", async () => {
    const page = await open("", PHONE, { ...gameOf("eightball", "person"), clock: 30 });
    const left = async () =>
      Number(/\d+/.exec((await page.locator("#clock").textContent()) ?? "")?.[0] ?? NaN);
    await comesToShow(page, "#clock");
    await expect.poll(left).toBeLessThanOrEqual(27);
    await reload(page);
    await comesToShow(page, "#clock");
    expect(await left()).toBeLessThanOrEqual(27);
    // The next stroke has all of its time.
    await act(page, "#power=2", "#shoot");
    await expect.poll(left).toBeGreaterThanOrEqual(29);
  });

  test("a tab does not read all kept games: it lists them without their lines", async () => {
    const page = await open("", PHONE, gameOf("nineball", "person"));
    await act(page, "#shoot", "#skip");
    await expect.poll(async () => Object.keys((await keptGames(page)).games).length).toBe(1);
    await page.evaluate(async () => {
      const finished = <T>(request: IDBRequest<T>): Promise<T> =>
        new Promise((done) => request.addEventListener("success", () => done(request.result)));
      const database = await finished(indexedDB.open("carom"));
      const store = database.transaction("games", "readwrite").objectStore("games");
      const [game] = (await finished(store.getAll())) as { when: number }[];
      for (let k = 0; k < 200; k++)
        await finished(store.put({ ...game, id: `x${k}`, when: 1000 + k }, `x${k}`));
      database.close();
    });
    // The tab that finds games of an older page lists them once.
    await reload(page);
    await act(page, "#new-game");
    await comesToCount(page, "#saved-games li", 201);
    await page.evaluate(() => sessionStorage.clear());
    await page.addInitScript(() => {
      let bytes = 0;
      const { getAll, get } = IDBObjectStore.prototype;
      const counted = <A extends unknown[]>(read: (...values: A) => IDBRequest) =>
        function (this: IDBObjectStore, ...values: A): IDBRequest {
          const request = read.apply(this, values);
          request.addEventListener("success", () => {
            bytes += JSON.stringify(request.result ?? null).length;
            Object.assign(window, { bytes });
          });
          return request;
        };
      IDBObjectStore.prototype.getAll = counted(getAll);
      IDBObjectStore.prototype.get = counted(get);
    });
    await reload(page);
    await act(page, "#new-game");
    await comesToCount(page, "#saved-games li", 201);
    const { read, whole } = await page.evaluate(async () => {
      const finished = <T>(request: IDBRequest<T>): Promise<T> =>
        new Promise((done) => request.addEventListener("success", () => done(request.result)));
      const read = (window as unknown as { bytes: number }).bytes;
      const database = await finished(indexedDB.open("carom"));
      const all = database.transaction("games").objectStore("games").getAll();
      const whole = JSON.stringify(await finished(all)).length;
      database.close();
      return { read, whole };
    });
    console.log(`a new tab with 201 games reads ${read} of ${whole} letters`);
    expect(read).toBeLessThan(whole / 2);
  });
});
