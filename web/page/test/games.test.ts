// Games that the browser keeps: several at once, each of them through damaged links, new games,
// drills and second tabs; and what happens where something that was kept is damaged.
import { describe, expect, test } from "vitest";
import { run, thereIsACommand } from "../../npm/test/support.js";
import { browserPath, keptGames, linesOf, page, pages } from "./page.js";

describe.runIf(browserPath !== undefined)("kept games", () => {
  const { browser, open, set, text } = pages();
  type Page = Awaited<ReturnType<typeof open>>;

  /** Begins a game by the menu. */
  async function begin(one: Page, game: string, against: string): Promise<void> {
    await one.locator("#new-game").click();
    await one.locator("#new-which").selectOption(game);
    await one.locator("#new-against").selectOption(against);
    await one.locator("#rate").selectOption("1000");
    await one.locator("#start").click();
  }
  async function shoot(one: Page, power: number): Promise<void> {
    await set(one, "power", power);
    const before = (await keptGames(one)).open;
    await one.locator("#shoot").click();
    await expect
      .poll(async () => {
        const { open, games } = await keptGames(one);
        return open === before && linesOf(games[open]!, "shot").length > 0;
      })
      .toBe(true);
  }
  async function load(one: Page, hash = ""): Promise<void> {
    await one.goto(`${one.url().split("#")[0]!}?again=${Math.random()}${hash}`);
    await one.waitForSelector("main[aria-busy=false]");
  }

  test("a damaged link, a new game and a drill leave the game before in the list", async () => {
    const one = await open("");
    await begin(one, "nineball", "person");
    await shoot(one, 8);
    const { open: first, games } = await keptGames(one);

    await load(one, "#view=play&seat=1&g=bY_damaged");
    expect(await text(one, "said")).toMatch(/not opened: the link is cut off or damaged/);
    expect((await keptGames(one)).open).toBe(first);
    expect((await keptGames(one)).games[first]).toBe(games[first]);

    await begin(one, "snooker", "person");
    expect(await text(one, "said")).toMatch(/The game before is kept under New game\.$/);
    await one.locator("#new-game").click();
    await one.locator("#start-drill").click();
    const after = await keptGames(one);
    expect(after.games[first]).toBe(games[first]);
    // Nobody has played in the game of snooker.
    expect(Object.values(after.games).some((game) => game.includes("snooker"))).toBe(false);

    await one.locator("#new-game").click();
    const rows = one.locator("#saved-games li");
    await expect.poll(() => rows.count()).toBe(2);
    await one.getByRole("button", { name: "Go on with Nine-ball" }).click();
    await expect.poll(async () => (await keptGames(one)).open).toBe(first);
    expect(await text(one, "turn")).not.toContain("break");
    await one.close();
  });

  test("a game is conceded by a second press, and is over", async () => {
    const one = await open("");
    await begin(one, "nineball", "person");
    await shoot(one, 8);
    await expect.poll(() => one.locator("#skip").isVisible()).toBe(false);
    const { open: id } = await keptGames(one);
    await one.locator("#new-game").click();
    await one.locator("#concede").click();
    expect(await one.locator("#end").isVisible()).toBe(false);
    await one.locator("#concede").click();
    await expect.poll(() => one.locator("#end").isVisible()).toBe(true);
    expect(await one.locator("#end").textContent()).toContain("The other player gave up.");
    const { lines } = JSON.parse((await keptGames(one)).games[id]!) as { lines: string[] };
    expect(lines.at(-2)).toContain('"act":3');
    expect(lines.at(-1)).toContain('"winner"');
    // It can be given up no more, nor can practice.
    await one.locator("#new-game").click();
    expect(await one.locator("#concede").isVisible()).toBe(false);
    await one.locator("#menu .close").click();
    await one.close();
  });

  test("a second tab does not play the game that the first one has open", async () => {
    const context = await browser().newContext();
    const visit = async (): Promise<Page> => {
      const tab = await context.newPage();
      await tab.goto(`file://${page}`);
      await tab.waitForSelector("main[aria-busy=false]");
      return tab;
    };
    const one = await visit();
    await begin(one, "nineball", "person");
    await shoot(one, 8);
    const { open: first, games } = await keptGames(one);
    const other = await visit();
    expect(await text(other, "said")).toMatch(/open in another tab: go on there/);
    await begin(other, "eightball", "person");
    await shoot(other, 8);
    const both = await keptGames(other);
    expect(both.open).not.toBe(first);
    expect(both.games[first]).toBe(games[first]);
    await one.reload();
    await one.waitForSelector("main[aria-busy=false]");
    expect((await keptGames(one)).open).toBe(first);
    await context.close();
  });

  test("a rated game that is deleted counts as lost, and its button says so before", async () => {
    const one = await open("");
    await begin(one, "nineball", "300");
    await shoot(one, 8);
    await begin(one, "eightball", "person");
    await one.locator("#new-game").click();
    const remove = one
      .locator("#saved-games li", { hasText: "Nine-ball" })
      .getByRole("button")
      .last();
    await remove.click();
    expect(await remove.textContent()).toBe("Delete: it counts as lost");
    const lost = (): Promise<string | null> =>
      one.evaluate(() => localStorage.getItem("carom-ladder"));
    expect(await lost()).toBe(null);
    await remove.click();
    await expect.poll(lost).toBe('{"300":[0,1]}');
    await expect.poll(() => one.locator("#saved-games li").count()).toBe(1);
    await one.close();
  });

  test("what is damaged begins anew, is put aside, and is named; the page starts", async () => {
    const one = await open("");
    await one.evaluate(() => {
      localStorage.setItem("carom-settings", "{bad");
      localStorage.setItem("carom-ladder", '{"300":"many"}');
    });
    await one.reload();
    await one.waitForSelector("main[aria-busy=false]");
    expect(await text(one, "said")).toMatch(/kept as settings, ladder was damaged and begins anew/);
    expect(await one.evaluate(() => localStorage.getItem("carom-settings-damaged"))).toBe("{bad");
    await one.close();
  });

  test("a file of a game is judged by the command, and another page goes on with it", async () => {
    const one = await open("");
    await begin(one, "nineball", "person");
    await shoot(one, 8);
    await one.locator("#new-game").click();
    const waiting = one.waitForEvent("download");
    await one.getByRole("button", { name: "Save file" }).first().click();
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
      one
        .locator("#open-game")
        .setInputFiles({ name: "game.jsonl", mimeType: "application/jsonl", buffer });
    const { open: before } = await keptGames(one);
    await give(Buffer.from(file.toString().replace('"opening":1', '"opening":0')));
    await expect.poll(() => text(one, "said")).toMatch(/The game was not opened: /);
    expect((await keptGames(one)).open).toBe(before);
    await give(file);
    await expect.poll(async () => (await keptGames(one)).open).not.toBe(before);
    const kept = await keptGames(one);
    expect((JSON.parse(kept.games[kept.open]!) as { lines: string[] }).lines).toEqual(
      lines.slice(0, -1).map((line) => `${line}\n`),
    );
    await one.close();
  });

  test("the clock ends a turn by a foul, and stands in the recording", async () => {
    const context = await browser().newContext();
    const one = await context.newPage();
    await one.clock.install();
    await one.goto(`file://${page}`);
    await one.waitForSelector("main[aria-busy=false]");
    expect(await one.locator("#clock").isVisible()).toBe(false);
    await one.locator("#new-game").click();
    await one.locator("#new-which").selectOption("nineball");
    await one.locator("#new-against").selectOption("practice");
    expect(await one.locator("#new-clock").isVisible()).toBe(false);
    await one.locator("#new-against").selectOption("person");
    await one.locator("#new-clock").selectOption("30");
    await one.locator("#start").click();
    await one.clock.runFor(1000);
    expect(await text(one, "clock")).toMatch(/^(2[89]|30) s left$/);
    await one.clock.runFor(22_000);
    expect(await one.locator("#clock.warned").count()).toBe(1);
    // Each of both players has the whole time anew.
    await one.clock.runFor(8_000);
    expect(await text(one, "turn")).toMatch(
      /^Player 1 fouls: the time for the stroke is over. Player 2/,
    );
    expect(await text(one, "clock")).toMatch(/^(2[6-9]|30) s left$/);
    const { open: id, games } = await keptGames(one);
    const { lines } = JSON.parse(games[id]!) as { lines: string[] };
    expect(lines.filter((line) => line.startsWith('{"act":{"act":4,'))).toHaveLength(1);
    await one.reload();
    await one.waitForSelector("main[aria-busy=false]");
    expect(await text(one, "turn")).toMatch(/^Player 1 fouls: the time/);
    // Three fouls in a row lose nine-ball.
    for (let turn = 0; turn < 4; turn++) await one.clock.runFor(31_000);
    expect(await one.locator("#end").textContent()).toContain("The time for the stroke is over.");
    expect(await one.locator("#clock").isVisible()).toBe(false);
    await context.close();
  });

  test("the menu begins a game with equal innings, where the game knows them", async () => {
    const one = await open("");
    await one.locator("#new-game").click();
    await one.locator("#new-against").selectOption("person");
    await one.locator("#new-which").selectOption("nineball");
    expect(await one.locator("#new-equal").isVisible()).toBe(false);
    await one.locator("#new-which").selectOption("straightrail");
    await one.locator("#new-equal").check();
    await one.locator("#rate").selectOption("1000");
    await one.locator("#start").click();
    await shoot(one, 3);
    const { open: id, games } = await keptGames(one);
    const { lines } = JSON.parse(games[id]!) as { lines: string[] };
    expect(lines.filter((line) => line.startsWith('{"game"')).at(0)).toContain('"innings":1');
    await one.close();
  });

  test.runIf(thereIsACommand)("an equalizing inning is told, and a drawn game", async () => {
    const rules = "match --rules straightrail --target 1 --equal-innings".split(" ");
    const players = "--fargo 800,800 --shots 100 --seed 6".split(" ");
    const lines = run([...rules, ...players], "")
      .trim()
      .split("\n");
    const isGame = (line: string): boolean => line.startsWith('{"game"');
    expect(lines.filter(isGame).at(-1)).toContain('"winner":3');
    const before = lines.slice(
      0,
      lines.map((line) => line.startsWith('{"shot"')).lastIndexOf(true),
    );
    const one = await open("");
    const give = (given: readonly string[]): Promise<void> =>
      one.locator("#open-game").setInputFiles({
        name: "game.jsonl",
        mimeType: "application/jsonl",
        buffer: Buffer.from(given.join("\n")),
      });
    await give(before);
    await expect.poll(() => text(one, "turn")).toBe("Player 2's turn, equalizing inning.");
    await give(lines);
    await expect.poll(() => text(one, "turn")).toBe("The game is drawn: the score is 1 : 1.");
    await expect.poll(() => one.locator("#end").isVisible()).toBe(true);
    expect(await one.locator("#end h2").textContent()).toBe("The game is drawn");
    expect(await one.locator("#rack-up").isVisible()).toBe(true);
    await one.close();
  });

  test("a log of drills alone states neither a cost nor an aim that nobody measured", async () => {
    const one = await open("");
    await one.locator("#new-game").click();
    await one.locator("#drill").selectOption("Lag");
    await one.locator("#rate").selectOption("1000");
    await one.locator("#start-drill").click();
    await set(one, "power", 0.3);
    await one.locator("#shoot").click();
    await expect.poll(() => text(one, "said")).toMatch(/^Missed: 0 of 1/);
    await one.locator("#new-game").click();
    await one.locator("#open-log").click();
    expect(await text(one, "log-sum")).toMatch(/^1 stroke\. Practise next:/);
    const cells = await one.locator("#log tbody td").allTextContents();
    expect(cells.filter((cell) => cell === "–").length).toBeGreaterThan(5);
    await one.close();
  });

  test("Hint in a drill aims a stroke, and tells how often it makes the drill", async () => {
    const one = await open("");
    await one.locator("#new-game").click();
    await one.locator("#drill").selectOption("Kick by one cushion");
    await one.locator("#start-drill").click();
    await one.locator("#hint").click();
    await expect
      .poll(() => text(one, "said"))
      .toMatch(/^Hint: the stroke that is aimed, at .* makes it in \d+ % of 200 tries\.$/);
    await one.close();
  });

  test.each(["eightball", "snooker", "threecushion"])("Hint in practice: %s", async (game) => {
    const one = await open("");
    await begin(one, game, "practice");
    await one.locator("#hint").click();
    await expect.poll(() => text(one, "said")).toMatch(/^Hint: .* keeps the turn in \d+ %/);
    await one.close();
  });
});
