// Games of two pages, in a browser: by a channel between two tabs, and by the link that one page
// makes and the other one verifies.
import { readFileSync } from "node:fs";
import { createServer, type Server } from "node:http";
import type { AddressInfo } from "node:net";
import { deflateRawSync, inflateRawSync } from "node:zlib";
import { afterAll, beforeAll, describe, expect, test } from "vitest";
import type { BrowserContext, Page } from "playwright-core";
import { browserPath, keptGame, linesOf, page, pages, sizes } from "./page.js";

const packed = (text: string): string => deflateRawSync(text).toString("base64url");
const unpacked = (url: string): string =>
  inflateRawSync(
    Buffer.from(new URLSearchParams(new URL(url).hash.slice(1)).get("g")!, "base64url"),
  ).toString();

describe.runIf(browserPath !== undefined)("a game by link", () => {
  const { browser, text, said } = pages();
  const turn = (one: Page): Promise<string> => text(one, "turn");
  let server: Server;
  let address = "";
  // Pages of one origin hear each other, which files are not.
  beforeAll(async () => {
    server = createServer((request, response) => {
      response.writeHead(request.url === "/" ? 200 : 404, { "content-type": "text/html" });
      response.end(request.url === "/" ? readFileSync(page) : "");
    });
    await new Promise<void>((listens) => server.listen(0, "127.0.0.1", listens));
    address = `http://127.0.0.1:${(server.address() as AddressInfo).port}/`;
  });
  afterAll(() => {
    server.close();
    server.closeAllConnections();
  });
  const contextOf = (how: {
    width: number;
    height: number;
    touch?: boolean;
  }): Promise<BrowserContext> =>
    browser().newContext({
      viewport: { width: how.width, height: how.height },
      hasTouch: how.touch ?? false,
      serviceWorkers: "block",
      permissions: ["clipboard-read", "clipboard-write"],
    });
  async function open(context: BrowserContext, hash = ""): Promise<Page> {
    const one = await context.newPage();
    one.on(
      "console",
      (message) =>
        ["error", "warning"].includes(message.type()) &&
        !/404|Service Worker registration blocked/.test(message.text()) &&
        said.push(message.text()),
    );
    one.on("pageerror", (error) => said.push(error.message));
    await one.goto(`${address}${hash}`);
    await one.waitForSelector("main[aria-busy=false]");
    return one;
  }
  async function begin(one: Page, game: string): Promise<void> {
    await one.locator("#new-game").click();
    await one.locator("#new-which").selectOption(game);
    await one.locator("#new-against").selectOption("link");
    await one.locator("#new-own").selectOption("500");
    await one.locator("#rate").selectOption("1000");
    await one.locator("#start").click();
    await one.waitForURL(/g=/);
  }
  /** The link that a page makes. */
  async function link(one: Page): Promise<string> {
    await one.locator("#send").click();
    await expect.poll(() => text(one, "said")).toMatch(/copied/);
    return one.evaluate(() => navigator.clipboard.readText());
  }

  test("two tabs, a wide one and one as of a phone, play a whole game, each stroke compared bit by bit", async () => {
    const context = await contextOf(sizes[0][1]);
    const one = await open(context);
    await begin(one, "eightball");
    const other = await open(context, new URL(await link(one)).hash);
    await other.setViewportSize({ width: 390, height: 844 });
    await other.locator("#new-game").click();
    await other.locator("#rate").selectOption("1000");
    await other.locator(".close").first().click();
    expect(await turn(other)).toMatch(/^The other player/);
    expect(await other.locator("#shoot").isEnabled()).toBe(false);
    let strokes = 0;
    let heard = 0;
    for (; strokes < 150; strokes++) {
      if (/won/.test(await turn(one))) break;
      // Whoever may shoot does; the other one's page hears of it.
      const [plays, hears] =
        (await one.locator("#shoot[aria-disabled=false]").count()) > 0
          ? [one, other]
          : [other, one];
      await plays.bringToFront();
      if (strokes > 0) {
        await plays.locator("#hint").click();
        await expect.poll(() => text(plays, "said")).toMatch(/^Hint: /);
      }
      await plays.locator("#shoot").click();
      await hears.bringToFront();
      await expect
        .poll(() => text(hears, "said"))
        .toBe(`Stroke ${strokes + 1} was repeated; every bit agrees.`);
      heard++;
      // Then somebody may play, or has won.
      await expect
        .poll(
          async () =>
            /won/.test(await turn(one)) ||
            (await one.locator("#shoot[aria-disabled=false]").count()) +
              (await other.locator("#shoot[aria-disabled=false]").count()) ===
              1,
        )
        .toBe(true);
    }
    expect(heard).toBe(strokes);
    const mine = await turn(one);
    const yours = await turn(other);
    expect(
      [mine, yours].map((told) => told.match(/(You have|The other player has) won/)![1]).sort(),
    ).toEqual(["The other player has", "You have"]);
    // Both have the same game, which a reload keeps.
    expect(unpacked(one.url())).toBe(unpacked(other.url()));
    await other.reload();
    await other.waitForSelector("main[aria-busy=false]");
    await expect.poll(() => turn(other)).toBe(yours);
    console.log(`two tabs: ${strokes} strokes; ${mine}; the link has ${one.url().length} letters`);
    await context.close();
  }, 300_000);

  test("whoever keeps the turn is told that the other one waits, who knows for what", async () => {
    const here = await contextOf(sizes[1][1]);
    const there = await contextOf(sizes[0][1]);
    const one = await open(
      here,
      `#view=play&seat=0&g=${packed(JSON.stringify({ game: "nineball", against: "link", own: "0", seed: 7, at: "0.3,0.3 0.1,0.1 in in in in in in in 0.9,1.9" }))}`,
    );
    for (const [id, value] of [
      ["phi", "225"],
      ["up", "-0.35"],
      ["power", "1.2"],
    ] as const)
      await one.locator(`#${id}`).evaluate((input: HTMLInputElement, value) => {
        input.value = value;
        input.dispatchEvent(new Event("input"));
      }, value);
    await one.locator("#shoot").click();
    await one.locator("#skip").click();
    await expect.poll(() => turn(one)).toMatch(/^Your turn/);
    const other = await open(there, new URL(await link(one)).hash);
    expect(await text(one, "said")).toMatch(
      /You are still at the table: send it again after your turn/,
    );
    expect(await turn(other)).toBe(
      "The other player plays: wait for the link that comes after this turn.",
    );
    await other.locator("#shoot").evaluate((button: HTMLElement) => button.click());
    expect(await text(other, "said")).toBe(
      "The other player is at the table: open the link that comes after his turn.",
    );
    await here.close();
    await there.close();
  });

  test("a link to another machine plays the strokes, and one that was changed is refused", async () => {
    const here = await contextOf(sizes[0][1]);
    const there = await contextOf(sizes[1][1]);
    const one = await open(here);
    await begin(one, "eightball");
    await one.locator("#shoot").click();
    await expect.poll(() => one.locator("#skip").isVisible()).toBe(false);
    const url = await link(one);
    const other = await open(there, new URL(url).hash);
    expect(await text(other, "said")).toBe("1 stroke was repeated; every bit agrees.");
    // It shows the last stroke before it tells whose turn it is.
    await expect.poll(() => turn(other)).not.toContain("plays …");
    const game = JSON.parse(unpacked(url)) as { lines: string[] };
    expect(linesOf(unpacked(url), "shot")).toHaveLength(1);
    // The speed; a hash; a missing line; a link that was cut off.
    const forged = (change: (line: string) => string | []): string => {
      const lines = game.lines.flatMap((line) =>
        line.startsWith('{"shot"') ? change(line) : line,
      );
      return packed(JSON.stringify({ ...game, lines }));
    };
    for (const [g, why] of [
      [
        forged((line) => line.replace(/"speed":("[^"]*"|[\d.]+)/, '"speed":7.5')),
        "stroke 1 is not as it was played",
      ],
      [
        forged((line) =>
          line.replace(/"hash":"(.)/, (_, first: string) => `"hash":"${first === "a" ? "b" : "a"}`),
        ),
        "stroke 1 is not as it was played",
      ],
      [forged(() => []), "stroke 1 is not as it was played"],
      [packed(JSON.stringify(game)).slice(0, -40), "the link is cut off or damaged"],
      [
        packed(JSON.stringify({ game: "eightball", against: "link", entries: [{ line: "" }] })),
        "an older version of this page has kept it",
      ],
    ] as const) {
      const bad = await open(there, `#view=play&seat=1&g=${g}`);
      expect(await text(bad, "said")).toContain(`The game was not opened: ${why}`);
      // What this browser keeps is opened in its place, as it was.
      expect(await turn(bad)).toBe(await turn(other));
      expect(unpacked(bad.url())).toBe(unpacked(other.url()));
      await bad.close();
    }
    // A game against the page goes on elsewhere, too.
    const own = await open(here, "#view=play");
    await own.locator("#new-game").click();
    await own.locator("#new-which").selectOption("nineball");
    await own.locator("#new-against").selectOption("person");
    await own.locator("#rate").selectOption("1000");
    await own.locator("#start").click();
    await own.locator("#shoot").click();
    await expect.poll(() => own.locator("#skip").isVisible()).toBe(false);
    await own.locator("#new-game").click();
    await own.locator("#copy-game").click();
    await expect.poll(() => text(own, "said")).toBe("The link to this game is copied.");
    const again = await open(
      there,
      new URL(await own.evaluate(() => navigator.clipboard.readText())).hash,
    );
    expect(await keptGame(again)).toBe(await keptGame(own));
    await here.close();
    await there.close();
  });
});
