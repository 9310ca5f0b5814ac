// Games of two pages, in a browser: by a channel between two tabs, and by the link that one page
// makes and the other one verifies.
import { readFileSync } from "node:fs";
import { createServer, type Server } from "node:http";
import type { AddressInfo } from "node:net";
import { deflateRawSync, inflateRawSync } from "node:zlib";
import { afterAll, beforeAll, expect, test } from "vitest";
import type { BrowserContext, Page } from "playwright-core";
import {
  act,
  comesToSay,
  comesToShow,
  describePages,
  gameOf,
  keptGame,
  pageFile,
  pages,
  reload,
  says,
  shows,
  sizes,
} from "./page.js";

const packed = (text: string) => deflateRawSync(text).toString("base64url");
const unpacked = (url: string) =>
  inflateRawSync(
    Buffer.from(new URLSearchParams(new URL(url).hash.slice(1)).get("g")!, "base64url"),
  ).toString();

describePages("a game by link", () => {
  const { browser, text, messages } = pages();
  const turn = (page: Page) => text(page, "turn");
  let server: Server;
  let address = "";
  // Pages of one origin hear each other, which files are not.
  beforeAll(async () => {
    server = createServer((request, response) => {
      response.writeHead(request.url === "/" ? 200 : 404, { "content-type": "text/html" });
      response.end(request.url === "/" ? readFileSync(pageFile) : "");
    });
    await new Promise<void>((listens) => server.listen(0, "127.0.0.1", listens));
    address = `http://127.0.0.1:${(server.address() as AddressInfo).port}/`;
  });
  afterAll(() => {
    server.close();
    server.closeAllConnections();
  });
  const contextOf = (how: { width: number; height: number; touch?: boolean }) =>
    browser().newContext({
      viewport: { width: how.width, height: how.height },
      hasTouch: how.touch ?? false,
      serviceWorkers: "block",
      permissions: ["clipboard-read", "clipboard-write"],
    });
  async function open(context: BrowserContext, hash = ""): Promise<Page> {
    const page = await context.newPage();
    page.on(
      "console",
      (message) =>
        ["error", "warning"].includes(message.type()) &&
        !/404|Service Worker registration blocked/.test(message.text()) &&
        messages.push(message.text()),
    );
    page.on("pageerror", (error) => messages.push(error.message));
    await page.goto(`${address}${hash}`);
    await page.waitForSelector("main[aria-busy=false]");
    return page;
  }
  async function begin(page: Page, game: string): Promise<void> {
    await act(
      page,
      "#new-game",
      `#new-which=${game}`,
      "#new-against=link",
      "#new-own=500",
      "#rate=1000",
      "#start",
    );
    await page.waitForURL(/g=/);
  }
  /** The link that a page makes. */
  async function link(page: Page): Promise<string> {
    await act(page, "#send");
    await comesToSay(page, "said", /copied/);
    return page.evaluate(() => navigator.clipboard.readText());
  }

  test("two tabs, a wide one and one as of a phone, play a whole game, each stroke compared bit by bit", async () => {
    const context = await contextOf(sizes[0][1]);
    const page = await open(context);
    await begin(page, "eightball");
    const secondPage = await open(context, new URL(await link(page)).hash);
    await secondPage.setViewportSize({ width: 390, height: 844 });
    await act(secondPage, "#new-game", "#rate=1000");
    await secondPage.locator(".close").first().click();
    await says(secondPage, "turn", /^The other player/);
    expect(await secondPage.locator("#shoot").isEnabled()).toBe(false);
    let strokes = 0;
    let heard = 0;
    for (; strokes < 150; strokes++) {
      if (/won/.test(await turn(page))) break;
      // Whoever may shoot does; the other one's page hears of it.
      const [plays, hears] =
        (await page.locator("#shoot[aria-disabled=false]").count()) > 0
          ? [page, secondPage]
          : [secondPage, page];
      await plays.bringToFront();
      if (strokes > 0) {
        await act(plays, "#hint");
        await comesToSay(plays, "said", /^Hint: /);
      }
      await act(plays, "#shoot");
      await hears.bringToFront();
      await comesToSay(hears, "said", `Shot ${strokes + 1} replayed: every bit agrees.`);
      heard++;
      // Then somebody may play, or has won.
      await expect
        .poll(
          async () =>
            /won/.test(await turn(page)) ||
            (await page.locator("#shoot[aria-disabled=false]").count()) +
              (await secondPage.locator("#shoot[aria-disabled=false]").count()) ===
              1,
        )
        .toBe(true);
    }
    expect(heard).toBe(strokes);
    const mine = await turn(page);
    const yours = await turn(secondPage);
    expect(
      [mine, yours].map((words) => words.match(/(You have|The other player has) won/)![1]).sort(),
    ).toEqual(["The other player has", "You have"]);
    // Both have the same game, which a reload keeps.
    expect(unpacked(page.url())).toBe(unpacked(secondPage.url()));
    await reload(secondPage);
    await comesToSay(secondPage, "turn", yours);
    console.log(`two tabs: ${strokes} strokes; ${mine}; the link has ${page.url().length} letters`);
    await context.close();
  }, 300_000);

  test("whoever keeps the turn is told that the other one waits, who knows for what", async () => {
    const phone = await contextOf(sizes[1][1]);
    const desk = await contextOf(sizes[0][1]);
    const page = await open(
      phone,
      `#view=play&seat=0&g=${packed(JSON.stringify(gameOf("nineball", "link", "0.3,0.3 0.1,0.1 in in in in in in in 0.9,1.9")))}`,
    );
    for (const [id, value] of [
      ["phi", "225"],
      ["up", "-0.35"],
      ["power", "1.2"],
    ] as const)
      await page.locator(`#${id}`).evaluate((input: HTMLInputElement, value) => {
        input.value = value;
        input.dispatchEvent(new Event("input"));
      }, value);
    // At once: a busy machine presses no Skip within a short film.
    await act(page, "#new-game", "#rate=1000", "#menu .close", "#shoot");
    await comesToSay(page, "turn", /^Your turn/);
    const secondPage = await open(desk, new URL(await link(page)).hash);
    await says(page, "said", /It is still your turn: send the link again after it/);
    await says(secondPage, "turn", "The other player plays: wait for their link.");
    await secondPage.locator("#shoot").evaluate((button: HTMLElement) => button.click());
    await says(
      secondPage,
      "said",
      "It is the other player's turn: open the link that they send after it.",
    );
    await phone.close();
    await desk.close();
  });

  test("a link to another machine plays the strokes, and one that was changed is refused", async () => {
    const desk = await contextOf(sizes[0][1]);
    const phone = await contextOf(sizes[1][1]);
    const page = await open(desk);
    await begin(page, "eightball");
    await act(page, "#shoot");
    await comesToShow(page, "#skip", false);
    const url = await link(page);
    const secondPage = await open(phone, new URL(url).hash);
    await says(secondPage, "said", "1 shot replayed: every bit agrees.");
    // It shows the last stroke before it tells whose turn it is.
    await expect.poll(() => turn(secondPage)).not.toContain("shoots …");
    expect(url.length).toBeLessThan(address.length + 330);
    const game = JSON.parse(unpacked(url)) as { lines: [string, string][] };
    expect(game.lines.filter(([name]) => name === "stroke")).toHaveLength(1);
    // Older pages sent all lines, which are still read.
    const kept = await keptGame(page);
    const older = await open(await contextOf(sizes[0][1]), `#view=play&seat=1&g=${packed(kept)}`);
    await says(older, "said", "1 shot replayed: every bit agrees.");
    expect(unpacked(older.url())).toBe(unpacked(secondPage.url()));
    await older.context().close();
    // The speed; a hash; a missing line; a link that was cut off.
    const forged = (change: (line: string) => string | []) => {
      const game = JSON.parse(kept) as { lines: string[] };
      const lines = game.lines.flatMap((line) =>
        line.startsWith('{"shot"') ? change(line) : line,
      );
      return packed(JSON.stringify({ ...game, lines }));
    };
    const otherHash = game.lines.map(([name, , ...rest]) => [name, "01234567", ...rest]);
    for (const [g, why] of [
      [
        forged((line) => line.replace(/"speed":("[^"]*"|[\d.]+)/, '"speed":7.5')),
        "shot 1 is not as it was played",
      ],
      [
        forged((line) =>
          line.replace(/"hash":"(.)/, (_, first: string) => `"hash":"${first === "a" ? "b" : "a"}`),
        ),
        "shot 1 is not as it was played",
      ],
      [forged(() => []), "shot 1 is not as it was played"],
      [packed(JSON.stringify({ ...game, lines: otherHash })), "shot 1 is not as it was played"],
      [packed(JSON.stringify(game)).slice(0, -40), "the link is incomplete or damaged"],
      [
        packed(JSON.stringify({ game: "eightball", against: "link", entries: [{ line: "" }] })),
        "an older version of this page saved it",
      ],
    ] as const) {
      const damaged = await open(phone, `#view=play&seat=1&g=${g}`);
      expect(await text(damaged, "said")).toContain(`The game was not opened: ${why}`);
      // What this browser keeps is opened in its place, as it was.
      await says(damaged, "turn", await turn(secondPage));
      expect(unpacked(damaged.url())).toBe(unpacked(secondPage.url()));
      await damaged.close();
    }
    // A game against the page goes on elsewhere, too.
    const ownPage = await open(desk, "#view=play");
    await act(
      ownPage,
      "#new-game",
      "#new-which=nineball",
      "#new-against=person",
      "#rate=1000",
      "#start",
      "#shoot",
    );
    await comesToShow(ownPage, "#skip", false);
    await act(ownPage, "#new-game", "#copy-game");
    await comesToSay(ownPage, "said", "Link to this game copied.");
    const reopened = await open(
      phone,
      new URL(await ownPage.evaluate(() => navigator.clipboard.readText())).hash,
    );
    expect(await keptGame(reopened)).toBe(await keptGame(ownPage));
    await desk.close();
    await phone.close();
  });

  test("a game is watched stroke by stroke, here and at a link, and goes on behind the bar", async () => {
    const desk = await contextOf(sizes[0][1]);
    const phone = await contextOf(sizes[1][1]);
    const page = await open(desk);
    await begin(page, "nineball");
    await act(page, "#shoot");
    await comesToShow(page, "#skip", false);
    const before = [await turn(page), await keptGame(page)];
    await act(page, "#new-game", "#watch-game");
    await says(page, "watched", "0 of 1");
    expect(await page.locator("#shoot").getAttribute("aria-disabled")).toBe("true");
    expect(await page.locator("#watch-back").isDisabled()).toBe(true);
    const url = await link(page);
    const other = await open(phone, new URL(url).hash);
    for (const watcher of [page, other]) {
      await act(watcher, "#watch-forth");
      await says(watcher, "watched", "1 of 1");
      await comesToSay(watcher, "said", /potted/);
      expect(await watcher.locator("#watch-forth").isDisabled()).toBe(true);
      await act(watcher, "#watch-back");
      await says(watcher, "watched", "0 of 1");
      await act(watcher, "#watch-close");
      await shows(watcher, "#watch", false);
    }
    // The players go on; who has watched has a game of two players at his page.
    expect([await turn(page), await keptGame(page)]).toEqual(before);
    expect(JSON.parse(await keptGame(other))).toMatchObject({ against: "person" });
    await desk.close();
    await phone.close();
  });
});
