// Games that the browser keeps: several at once, each of them through damaged links, new games,
// drills and second tabs; and what happens where something that was kept is damaged.
import { describe, expect, test } from "vitest";
import { run, thereIsACommand } from "../../npm/test/support.js";
import { browserPath, keptGames, linesOf, pageFile, pages } from "./page.js";

describe.runIf(browserPath !== undefined)("kept games", () => {
  const { browser, open, set, text } = pages();
  type Page = Awaited<ReturnType<typeof open>>;

  /** Begins a game by the menu. */
  async function begin(page: Page, game: string, against: string): Promise<void> {
    await page.locator("#new-game").click();
    await page.locator("#new-which").selectOption(game);
    await page.locator("#new-against").selectOption(against);
    await page.locator("#rate").selectOption("1000");
    await page.locator("#start").click();
  }
  async function shoot(page: Page, power: number): Promise<void> {
    await set(page, "power", power);
    const previous = (await keptGames(page)).open;
    await page.locator("#shoot").click();
    await expect
      .poll(async () => {
        const { open, games } = await keptGames(page);
        return open === previous && linesOf(games[open]!, "shot").length > 0;
      })
      .toBe(true);
  }
  async function load(page: Page, hash = ""): Promise<void> {
    await page.goto(`${page.url().split("#")[0]!}?again=${Math.random()}${hash}`);
    await page.waitForSelector("main[aria-busy=false]");
  }

  test("a damaged link, a new game and a drill leave the game before in the list", async () => {
    const page = await open("");
    await begin(page, "nineball", "person");
    await shoot(page, 8);
    const { open: first, games } = await keptGames(page);

    await load(page, "#view=play&seat=1&g=bY_damaged");
    expect(await text(page, "said")).toMatch(/not opened: the link is cut off or damaged/);
    expect((await keptGames(page)).open).toBe(first);
    expect((await keptGames(page)).games[first]).toBe(games[first]);

    await begin(page, "snooker", "person");
    expect(await text(page, "said")).toMatch(/The game before is kept under New game\.$/);
    await page.locator("#new-game").click();
    await page.locator("#start-drill").click();
    const stored = await keptGames(page);
    expect(stored.games[first]).toBe(games[first]);
    // Nobody has played in the game of snooker.
    expect(Object.values(stored.games).some((game) => game.includes("snooker"))).toBe(false);

    await page.locator("#new-game").click();
    const rows = page.locator("#saved-games li");
    await expect.poll(() => rows.count()).toBe(2);
    await page.getByRole("button", { name: "Go on with Nine-ball" }).click();
    await expect.poll(async () => (await keptGames(page)).open).toBe(first);
    expect(await text(page, "turn")).not.toContain("break");
    await page.close();
  });

  test("a game is conceded by a second press, and is over", async () => {
    const page = await open("");
    await begin(page, "nineball", "person");
    await shoot(page, 8);
    await expect.poll(() => page.locator("#skip").isVisible()).toBe(false);
    const { open: id } = await keptGames(page);
    await page.locator("#new-game").click();
    await page.locator("#concede").click();
    expect(await page.locator("#end").isVisible()).toBe(false);
    await page.locator("#concede").click();
    await expect.poll(() => page.locator("#end").isVisible()).toBe(true);
    expect(await page.locator("#end").textContent()).toContain("The other player gave up.");
    const { lines } = JSON.parse((await keptGames(page)).games[id]!) as { lines: string[] };
    expect(lines.at(-2)).toContain('"act":3');
    expect(lines.at(-1)).toContain('"winner"');
    // It can be given up no more, nor can practice.
    await page.locator("#new-game").click();
    expect(await page.locator("#concede").isVisible()).toBe(false);
    await page.locator("#menu .close").click();
    await page.close();
  });

  test("a second tab does not play the game that the first one has open", async () => {
    const context = await browser().newContext();
    const visit = async (): Promise<Page> => {
      const tab = await context.newPage();
      await tab.goto(`file://${pageFile}`);
      await tab.waitForSelector("main[aria-busy=false]");
      return tab;
    };
    const page = await visit();
    await begin(page, "nineball", "person");
    await shoot(page, 8);
    const { open: first, games } = await keptGames(page);
    const secondPage = await visit();
    expect(await text(secondPage, "said")).toMatch(/open in another tab: go on there/);
    await begin(secondPage, "eightball", "person");
    await shoot(secondPage, 8);
    const both = await keptGames(secondPage);
    expect(both.open).not.toBe(first);
    expect(both.games[first]).toBe(games[first]);
    await page.reload();
    await page.waitForSelector("main[aria-busy=false]");
    expect((await keptGames(page)).open).toBe(first);
    await context.close();
  });

  test("a rated game that is deleted counts as lost, and its button says so before", async () => {
    const page = await open("");
    await begin(page, "nineball", "300");
    await shoot(page, 8);
    await begin(page, "eightball", "person");
    await page.locator("#new-game").click();
    const remove = page
      .locator("#saved-games li", { hasText: "Nine-ball" })
      .getByRole("button")
      .last();
    await remove.click();
    expect(await remove.textContent()).toBe("Delete: it counts as lost");
    const lost = (): Promise<string | null> =>
      page.evaluate(() => localStorage.getItem("carom-ladder"));
    expect(await lost()).toBe(null);
    await remove.click();
    await expect.poll(lost).toBe('{"300":[0,1]}');
    await expect.poll(() => page.locator("#saved-games li").count()).toBe(1);
    await page.close();
  });

  test("what is damaged begins anew, is put aside, and is named; the page starts", async () => {
    const page = await open("");
    await page.evaluate(() => {
      localStorage.setItem("carom-settings", "{bad");
      localStorage.setItem("carom-ladder", '{"300":"many"}');
    });
    await page.reload();
    await page.waitForSelector("main[aria-busy=false]");
    expect(await text(page, "said")).toMatch(
      /kept as settings, ladder was damaged and begins anew/,
    );
    expect(await page.evaluate(() => localStorage.getItem("carom-settings-damaged"))).toBe("{bad");
    await page.close();
  });

  test("a file of a game is judged by the command, and another page goes on with it", async () => {
    const page = await open("");
    await begin(page, "nineball", "person");
    await shoot(page, 8);
    await page.locator("#new-game").click();
    const waiting = page.waitForEvent("download");
    await page.getByRole("button", { name: "Save file" }).first().click();
    const stream = await (await waiting).createReadStream();
    const chunks: Buffer[] = [];
    for await (const chunk of stream) chunks.push(chunk as Buffer);
    const file = Buffer.concat(chunks);
    const lines = file.toString().trim().split("\n");
    if (thereIsACommand)
      expect(run(["verify", "-"], file.toString())).toMatch(
        /1 shots, every bit agrees.*; 1 rulings by the rules/,
      );

    const give = (buffer: Buffer): Promise<void> =>
      page
        .locator("#open-game")
        .setInputFiles({ name: "game.jsonl", mimeType: "application/jsonl", buffer });
    const { open: previous } = await keptGames(page);
    await give(Buffer.from(file.toString().replace('"opening":1', '"opening":0')));
    await expect.poll(() => text(page, "said")).toMatch(/The game was not opened: /);
    expect((await keptGames(page)).open).toBe(previous);
    await give(file);
    await expect.poll(async () => (await keptGames(page)).open).not.toBe(previous);
    const stored = await keptGames(page);
    expect((JSON.parse(stored.games[stored.open]!) as { lines: string[] }).lines).toEqual(
      lines.slice(0, -1).map((line) => `${line}\n`),
    );
    await page.close();
  });

  test("the clock ends a turn by a foul, and stands in the recording", async () => {
    const context = await browser().newContext();
    const page = await context.newPage();
    await page.clock.install();
    await page.goto(`file://${pageFile}`);
    await page.waitForSelector("main[aria-busy=false]");
    expect(await page.locator("#clock").isVisible()).toBe(false);
    await page.locator("#new-game").click();
    await page.locator("#new-which").selectOption("nineball");
    await page.locator("#new-against").selectOption("practice");
    expect(await page.locator("#new-clock").isVisible()).toBe(false);
    await page.locator("#new-against").selectOption("person");
    await page.locator("#new-clock").selectOption("30");
    await page.locator("#start").click();
    await page.clock.runFor(1000);
    expect(await text(page, "clock")).toMatch(/^(2[89]|30) s left$/);
    await page.clock.runFor(22_000);
    expect(await page.locator("#clock.warned").count()).toBe(1);
    // Each of both players has the whole time anew.
    await page.clock.runFor(8_000);
    expect(await text(page, "turn")).toMatch(
      /^Player 1 fouls: the time for the stroke is over. Player 2/,
    );
    expect(await text(page, "clock")).toMatch(/^(2[6-9]|30) s left$/);
    const { open: id, games } = await keptGames(page);
    const { lines } = JSON.parse(games[id]!) as { lines: string[] };
    expect(lines.filter((line) => line.startsWith('{"act":{"act":4,'))).toHaveLength(1);
    await page.reload();
    await page.waitForSelector("main[aria-busy=false]");
    expect(await text(page, "turn")).toMatch(/^Player 1 fouls: the time/);
    // Three fouls in a row lose nine-ball.
    for (let turn = 0; turn < 4; turn++) await page.clock.runFor(31_000);
    expect(await page.locator("#end").textContent()).toContain("The time for the stroke is over.");
    expect(await page.locator("#clock").isVisible()).toBe(false);
    await context.close();
  });

  test("the menu begins a game with equal innings, where the game knows them", async () => {
    const page = await open("");
    await page.locator("#new-game").click();
    await page.locator("#new-against").selectOption("person");
    await page.locator("#new-which").selectOption("nineball");
    expect(await page.locator("#new-equal").isVisible()).toBe(false);
    await page.locator("#new-which").selectOption("straightrail");
    await page.locator("#new-equal").check();
    await page.locator("#rate").selectOption("1000");
    await page.locator("#start").click();
    await shoot(page, 3);
    const { open: id, games } = await keptGames(page);
    const { lines } = JSON.parse(games[id]!) as { lines: string[] };
    expect(lines.filter((line) => line.startsWith('{"game"')).at(0)).toContain('"innings":1');
    await page.close();
  });

  test.runIf(thereIsACommand)("an equalizing inning is told, and a drawn game", async () => {
    const rules = "match --rules straightrail --target 1 --equal-innings".split(" ");
    const players = "--fargo 800,800 --shots 100 --seed 6".split(" ");
    const lines = run([...rules, ...players], "")
      .trim()
      .split("\n");
    const isGame = (line: string): boolean => line.startsWith('{"game"');
    expect(lines.filter(isGame).at(-1)).toContain('"winner":3');
    const head = lines.slice(0, lines.map((line) => line.startsWith('{"shot"')).lastIndexOf(true));
    const page = await open("");
    const give = (content: readonly string[]): Promise<void> =>
      page.locator("#open-game").setInputFiles({
        name: "game.jsonl",
        mimeType: "application/jsonl",
        buffer: Buffer.from(content.join("\n")),
      });
    await give(head);
    await expect.poll(() => text(page, "turn")).toBe("Player 2's turn, equalizing inning.");
    await give(lines);
    await expect.poll(() => text(page, "turn")).toBe("The game is drawn: the score is 1 : 1.");
    await expect.poll(() => page.locator("#end").isVisible()).toBe(true);
    expect(await page.locator("#end h2").textContent()).toBe("The game is drawn");
    expect(await page.locator("#rack-up").isVisible()).toBe(true);
    await page.close();
  });

  test("a log of drills alone states neither a cost nor an aim that nobody measured", async () => {
    const page = await open("");
    await page.locator("#new-game").click();
    await page.locator("#drill").selectOption("Lag");
    await page.locator("#rate").selectOption("1000");
    await page.locator("#start-drill").click();
    await set(page, "power", 0.3);
    await page.locator("#shoot").click();
    await expect.poll(() => text(page, "said")).toMatch(/^Missed: 0 of 1/);
    await page.locator("#new-game").click();
    await page.locator("#open-log").click();
    expect(await text(page, "log-sum")).toMatch(/^1 stroke\. Practise next:/);
    const cells = await page.locator("#log tbody td").allTextContents();
    expect(cells.filter((cell) => cell === "–").length).toBeGreaterThan(5);
    await page.close();
  });

  test("Hint in a drill aims a stroke, and tells how often it makes the drill", async () => {
    const page = await open("");
    await page.locator("#new-game").click();
    await page.locator("#drill").selectOption("Kick by one cushion");
    await page.locator("#start-drill").click();
    await page.locator("#hint").click();
    await expect
      .poll(() => text(page, "said"))
      .toMatch(/^Hint: the stroke that is aimed, at .* makes it in \d+ % of 200 tries\.$/);
    await page.close();
  });

  test.each(["eightball", "snooker", "threecushion"])("Hint in practice: %s", async (game) => {
    const page = await open("");
    await begin(page, game, "practice");
    await page.locator("#hint").click();
    await expect.poll(() => text(page, "said")).toMatch(/^Hint: .* keeps the turn in \d+ %/);
    await page.close();
  });
});
