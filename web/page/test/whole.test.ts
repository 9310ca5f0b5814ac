// The page as a whole, in a browser: accessibility of every state, the page as it is served, its
// licences, its size, and the film that it shares.
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { createServer } from "node:http";
import type { AddressInfo } from "node:net";
import { tmpdir } from "node:os";
import { gzipSync } from "node:zlib";
import { expect, test } from "vitest";
import type { Page } from "playwright-core";
import {
  act,
  boxOf,
  describePages,
  pageFile,
  pages,
  PHONE,
  reload,
  says,
  violations,
} from "./page.js";
import { LANGUAGES } from "../src/texts/texts.js";
import { root, run, thereIsACommand } from "../../test/support.js";

type State = [name: string, hash: string, how: object, presses: string[]];
const STATES = JSON.parse(readFileSync(`${root}web/page/test/states.json`, "utf8")) as State[];

/**
 * An icon of a page that is served: its size, how many of its pixels differ from icon.svg, and how
 * many beyond the circle that each shape of an icon keeps differ from its corner.
 */
const iconOf = (page: Page, name: string) =>
  page.evaluate(async (name) => {
    const load = async (source: string) => {
      const image = Object.assign(new Image(), { src: source });
      await image.decode();
      return image;
    };
    const icon = await load(name);
    const size = name.endsWith(".svg") ? 512 : icon.naturalWidth;
    const pixelsOf = (image: HTMLImageElement) => {
      const canvas = Object.assign(document.createElement("canvas"), { width: size, height: size });
      const g = canvas.getContext("2d")!;
      g.drawImage(image, 0, 0, size, size);
      return g.getImageData(0, 0, size, size).data;
    };
    const shown = pixelsOf(icon);
    const drawn = pixelsOf(await load("icon.svg"));
    const far = (a: number, b: number) => Math.abs(a - b) > 40;
    const isBeyond = (k: number) => {
      const [x, y] = [k % size, Math.floor(k / size)].map((c) => (c + 0.5) / size - 0.5);
      return Math.hypot(x!, y!) > 0.4;
    };
    let differs = 0;
    let beyond = 0;
    for (let offset = 0; offset < shown.length; offset++) {
      if (far(shown[offset]!, drawn[offset]!)) differs++;
      if (isBeyond(Math.floor(offset / 4)) && far(shown[offset]!, shown[offset % 4]!)) beyond++;
    }
    const sizes = name.endsWith(".svg") ? "any" : `${icon.naturalWidth}x${icon.naturalHeight}`;
    return { sizes, differs, beyond };
  }, name);

describePages("the page", () => {
  const { open, colour, text, set, messages, browser } = pages();

  test("its first view, what comes before the other parts, is at most 420 kB compressed", () => {
    const text = readFileSync(pageFile, "utf8");
    const end = text.indexOf('<details id="licences">');
    expect(end).toBeGreaterThan(0);
    expect(text.indexOf('type="text/plain" id="part-')).toBeGreaterThan(end);
    const { length } = gzipSync(text.slice(0, end), { level: 9 });
    console.log(`the first view has ${length} bytes, compressed`);
    expect(length).toBeLessThanOrEqual(420_000);
  });

  // The states of states.json one after another, by what is pressed; ".close" is none by itself.
  test.each(STATES)("axe finds nothing: %s", async (_, hash, how, presses) => {
    const page = await open(hash, how);
    for (const press of presses) {
      if (press) await page.locator(press).first().click();
      if (press === ".close") continue;
      expect(await violations(page), press).toEqual([]);
      // Nothing is wider than the screen.
      expect(
        await page.evaluate(
          () => document.documentElement.scrollWidth - document.documentElement.clientWidth,
        ),
        press,
      ).toBeLessThanOrEqual(0);
    }
  });

  test.each(Object.keys(LANGUAGES))("on a phone nothing is cut: %s", async (language) => {
    const page = await open("", PHONE);
    await page.evaluate((language) => {
      localStorage.setItem("carom-language", language);
      const row = { when: "2026-11-28T18:00", game: "eightball", meant: "ball 7", best: "ball 3" };
      localStorage.setItem("carom-log", JSON.stringify([{ ...row, phi: 0.3, value: 0.5 }]));
    }, language);
    await reload(page);
    // The tip grows under a finger.
    const tip = await boxOf(page, "#tip-ball");
    await page.mouse.move(tip.x + tip.width / 2, tip.y + tip.height / 2);
    await page.mouse.down();
    const grown = await boxOf(page, "#tip-ball");
    expect(grown.width).toBeGreaterThan(1.5 * tip.width);
    expect(grown.x + grown.width).toBeLessThanOrEqual(390);
    await page.mouse.up();
    await act(page, "#new-game");
    const cut = await page.locator("select:visible").evaluateAll((selects) =>
      selects.flatMap((select) => {
        const { font, paddingLeft, paddingRight } = getComputedStyle(select);
        const arrow = 18;
        const room =
          select.clientWidth - parseFloat(paddingLeft) - parseFloat(paddingRight) - arrow;
        const g = document.createElement("canvas").getContext("2d")!;
        g.font = font;
        return Array.from((select as HTMLSelectElement).options).flatMap(({ text }) =>
          g.measureText(text).width > room ? `${select.id}: ${text}` : [],
        );
      }),
    );
    expect(cut).toEqual([]);
    await act(page, "#open-log");
    const beyond = await page
      .locator("#log, #log .scrolls")
      .evaluateAll((parts) => parts.map((part) => part.scrollWidth - part.clientWidth));
    expect(beyond).toEqual([0, 0]);
  });

  test("a page that is served can be installed, and works without a network", async () => {
    const types: Record<string, string> = {
      html: "text/html",
      js: "text/javascript",
      png: "image/png",
      svg: "image/svg+xml",
      webmanifest: "application/manifest+json",
    };
    const server = createServer((request, response) => {
      const name = request.url === "/" ? "index.html" : request.url!.slice(1);
      response.writeHead(200, { "content-type": types[name.split(".").at(-1)!] ?? "text/plain" });
      response.end(readFileSync(`${root}web/page/dist/${name}`));
    });
    await new Promise<void>((listens) => server.listen(0, "127.0.0.1", listens));
    const context = await browser().newContext({ viewport: { width: 390, height: 844 } });
    const page = await context.newPage();
    page.on(
      "console",
      (message) =>
        ["error", "warning"].includes(message.type()) && messages.push(`served: ${message.text()}`),
    );
    await page.goto(`http://127.0.0.1:${(server.address() as AddressInfo).port}/`);
    await page.waitForSelector("main[aria-busy=false]");
    await page.evaluate(() => navigator.serviceWorker.ready.then(() => undefined));
    const devtools = await context.newCDPSession(page);
    const manifest = await devtools.send("Page.getAppManifest");
    expect(manifest.errors).toEqual([]);
    expect(JSON.parse(manifest.data!)).toMatchObject({
      name: "carom",
      display: "standalone",
    });
    expect(
      (await devtools.send("Page.getInstallabilityErrors")).installabilityErrors.filter(
        ({ errorId }) => errorId !== "in-incognito",
      ),
    ).toEqual([]);
    const { icons } = JSON.parse(manifest.data!) as { icons: { src: string; sizes: string }[] };
    for (const { src, sizes } of icons)
      expect(await iconOf(page, src), src).toEqual({ sizes, differs: 0, beyond: 0 });
    // No network, and no server either.
    await context.setOffline(true);
    await new Promise((closed) => {
      server.close(closed);
      server.closeAllConnections();
    });
    await reload(page);
    await says(page, "turn", /You break/);
    await context.close();
  });

  test.runIf(thereIsACommand)("a page of carom shoot --animate shows the same player", async () => {
    const folder = mkdtempSync(`${tmpdir()}/carom-`);
    const output = JSON.parse(
      run(["shoot", "--animate", `${folder}/break.html`, `${root}data/break-nineball.jsonl`]),
    ) as { final: { t: number; balls: Record<string, number[]> }; events: unknown[][] };
    const firstPage = await open("#view=lab");
    await act(firstPage, "main summary");
    await firstPage.locator("#line").fill(readFileSync(`${root}data/break-nineball.jsonl`, "utf8"));
    await act(firstPage, "#import");
    const secondPage = await browser().newPage({ viewport: { width: 1300, height: 800 } });
    secondPage.on(
      "console",
      (message) =>
        ["error", "warning"].includes(message.type()) &&
        messages.push(`animate: ${message.text()}`),
    );
    secondPage.on("pageerror", (error) => messages.push(`animate: ${error.message}`));
    await secondPage.goto(`file://${folder}/break.html`);
    await says(secondPage, "play", "Pause");
    await act(secondPage, "#play");
    for (const page of [firstPage, secondPage])
      await expect
        .poll(() => page.locator(".events li").count())
        .toBe(output.events.filter(([, type]) => type !== "none").length);
    expect(await secondPage.locator(".events li").allTextContents()).toEqual(
      await firstPage.locator(".events li").allTextContents(),
    );
    // At the end ball 8 lies at the command's place, on both tables, which differ in size.
    const end = Number(await secondPage.locator("#time").getAttribute("max"));
    expect(end).toBeCloseTo(output.final.t, 3);
    for (const page of [firstPage, secondPage])
      await set(page, "time", Math.floor(1000 * end) / 1000);
    const [, x, y] = output.final.balls["8"]!;
    for (const page of [firstPage, secondPage]) {
      await page.evaluate(() => scrollTo(0, 0));
      // the cloth is brighter, and the number
      expect(Math.max(...(await colour(page, x!, y! + 0.0245)))).toBeLessThan(60);
    }
    expect(await violations(secondPage)).toEqual([]);
    await firstPage.close();
    await secondPage.close();
    rmSync(folder, { recursive: true });
  });

  test("the page has the licence of all that is in it", async () => {
    const page = await open("#view=lab");
    await act(page, "#licences summary");
    const words = await text(page, "licences");
    for (const name of [
      "Apache License\n",
      "Copyright (c) 2005-2020 Rich Felker, et al.",
      "The Emscripten Authors",
      "uplot\n\nThe MIT License (MIT)\n\nCopyright (c) 2022 Leon Sorokin",
      "three\n\nThe MIT License\n\nCopyright © 2010-2025 three.js authors",
    ])
      expect(words).toContain(name);
  });
});
