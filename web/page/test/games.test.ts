// Games that the browser keeps: several at once, each of them through damaged links, new games,
// drills and second tabs; and what happens where something that was kept is damaged.
import { expect, test } from "vitest";
import { run, thereIsACommand } from "../../npm/test/support.js";
import {
  act,
  comesToCount,
  comesToSay,
  comesToShow,
  counts,
  describePages,
  keptGames,
  keptLines,
  linesOf,
  pageFile,
  pages,
  reload,
  says,
  shows,
} from "./page.js";

describePages("kept games", () => {
  const { browser, open, text } = pages();
  type Page = Awaited<ReturnType<typeof open>>;

  /** Begins a game by the menu. */
  async function begin(page: Page, game: string, against: string): Promise<void> {
    await act(
      page,
      "#new-game",
      `#new-which=${game}`,
      `#new-against=${against}`,
      "#rate=1000",
      "#start",
    );
  }
  async function shoot(page: Page, power: number): Promise<void> {
    await act(page, `#power=${power}`);
    const previous = (await keptGames(page)).open;
    await act(page, "#shoot");
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
    await says(page, "said", /not opened: the link is incomplete or damaged/);
    expect((await keptGames(page)).open).toBe(first);
    expect((await keptGames(page)).games[first]).toBe(games[first]);

    await begin(page, "snooker", "person");
    await says(page, "said", /Your previous game is saved under New game\.$/);
    await act(page, "#new-game", "#start-drill");
    const stored = await keptGames(page);
    expect(stored.games[first]).toBe(games[first]);
    // Nobody has played in the game of snooker.
    expect(Object.values(stored.games).some((game) => game.includes("snooker"))).toBe(false);

    await act(page, "#new-game");
    const rows = page.locator("#saved-games li");
    await expect.poll(() => rows.count()).toBe(2);
    await page.getByRole("button", { name: "Resume Nine-ball" }).click();
    await expect.poll(async () => (await keptGames(page)).open).toBe(first);
    expect(await text(page, "turn")).not.toContain("break");
  });

  test("a game is conceded by a second press, and is over", async () => {
    const page = await open("");
    await begin(page, "nineball", "person");
    await shoot(page, 8);
    await comesToShow(page, "#skip", false);
    const { open: id } = await keptGames(page);
    await act(page, "#new-game", "#concede");
    await shows(page, "#end", false);
    await act(page, "#concede");
    await comesToShow(page, "#end");
    expect(await page.locator("#end").textContent()).toContain("The game was conceded.");
    const { lines } = JSON.parse((await keptGames(page)).games[id]!) as { lines: string[] };
    expect(lines.at(-2)).toContain('"act":3');
    expect(lines.at(-1)).toContain('"winner"');
    // It can be given up no more, nor can practice.
    await act(page, "#new-game");
    await shows(page, "#concede", false);
    await act(page, "#menu .close");
  });

  test("a second tab does not play the game that the first one has open", async () => {
    const context = await browser().newContext();
    const visit = async () => {
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
    await says(secondPage, "said", /open in another tab; continue it there/);
    await begin(secondPage, "eightball", "person");
    await shoot(secondPage, 8);
    const both = await keptGames(secondPage);
    expect(both.open).not.toBe(first);
    expect(both.games[first]).toBe(games[first]);
    await reload(page);
    expect((await keptGames(page)).open).toBe(first);
    await context.close();
  });

  test("a rated game that is deleted counts as lost, and its button says so before", async () => {
    const page = await open("");
    await begin(page, "nineball", "300");
    await shoot(page, 8);
    await begin(page, "eightball", "person");
    await act(page, "#new-game");
    const remove = page
      .locator("#saved-games li", { hasText: "Nine-ball" })
      .getByRole("button")
      .last();
    await remove.click();
    expect(await remove.textContent()).toBe("Delete (counts as a loss)");
    const lost = () => page.evaluate(() => localStorage.getItem("carom-ladder"));
    expect(await lost()).toBe(null);
    await remove.click();
    await expect.poll(lost).toBe('{"nineball/300":[0,1]}');
    await comesToCount(page, "#saved-games li", 1);
  });

  test("what is damaged begins anew, is put aside, and is named; the page starts", async () => {
    const page = await open("");
    await page.evaluate(() => {
      localStorage.setItem("carom-settings", "{bad");
      localStorage.setItem("carom-ladder", '{"300":"many"}');
    });
    await reload(page);
    await says(page, "said", /was damaged and has been reset: settings, ladder\./);
    expect(await page.evaluate(() => localStorage.getItem("carom-settings-damaged"))).toBe("{bad");
  });

  test("a file of a game is judged by the command, and another page goes on with it", async () => {
    const page = await open("");
    await begin(page, "nineball", "person");
    await shoot(page, 8);
    await act(page, "#new-game");
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

    const give = (buffer: Buffer) =>
      page
        .locator("#open-game")
        .setInputFiles({ name: "game.jsonl", mimeType: "application/jsonl", buffer });
    const { open: previous } = await keptGames(page);
    await give(Buffer.from(file.toString().replace('"opening":1', '"opening":0')));
    await comesToSay(page, "said", /The game was not opened: /);
    expect((await keptGames(page)).open).toBe(previous);
    await give(file);
    await expect.poll(async () => (await keptGames(page)).open).not.toBe(previous);
    const stored = await keptGames(page);
    expect((JSON.parse(stored.games[stored.open]!) as { lines: string[] }).lines).toEqual(
      lines.slice(0, -1).map((line) => `${line}\n`),
    );
  });

  test("the clock ends a turn by a foul, and stands in the recording", async () => {
    const context = await browser().newContext();
    const page = await context.newPage();
    await page.clock.install();
    await page.goto(`file://${pageFile}`);
    await page.waitForSelector("main[aria-busy=false]");
    await shows(page, "#clock", false);
    await act(page, "#new-game", "#new-which=nineball", "#new-against=practice");
    await shows(page, "#new-clock", false);
    await act(page, "#new-against=person", "#new-clock=30", "#start");
    await page.clock.runFor(1000);
    await says(page, "clock", /^(2[89]|30) s left$/);
    await page.clock.runFor(22_000);
    await counts(page, "#clock.warned", 1);
    // Each of both players has the whole time anew.
    await page.clock.runFor(8_000);
    await says(page, "turn", /^Player 1 fouls: time ran out. Player 2/);
    await says(page, "clock", /^(2[6-9]|30) s left$/);
    const lines = await keptLines(page);
    expect(lines.filter((line) => line.startsWith('{"act":{"act":4,'))).toHaveLength(1);
    await reload(page);
    await says(page, "turn", /^Player 1 fouls: time ran out/);
    // Three fouls in a row lose nine-ball.
    for (let turn = 0; turn < 4; turn++) await page.clock.runFor(31_000);
    expect(await page.locator("#end").textContent()).toContain("Time ran out.");
    await shows(page, "#clock", false);
    await context.close();
  });

  test("the menu begins a game with equal innings, where the game knows them", async () => {
    const page = await open("");
    await act(page, "#new-game", "#new-against=person", "#new-which=nineball");
    await shows(page, "#new-equal", false);
    await act(
      page,
      "#new-which=straightrail",
      "#new-more",
      "#new-equal=on",
      "#rate=1000",
      "#start",
    );
    await shoot(page, 3);
    const lines = await keptLines(page);
    expect(lines.filter((line) => line.startsWith('{"game"')).at(0)).toContain('"innings":1');
  });

  test.runIf(thereIsACommand)("an equalizing inning is told, and a drawn game", async () => {
    const rules = ["match", "--rules", "straightrail", "--target", "1", "--equal-innings"];
    const players = ["--fargo", "800,800", "--shots", "100", "--seed", "6"];
    const lines = run([...rules, ...players], "")
      .trim()
      .split("\n");
    const isGame = (line: string) => line.startsWith('{"game"');
    expect(lines.filter(isGame).at(-1)).toContain('"winner":9');
    const head = lines.slice(0, lines.map((line) => line.startsWith('{"shot"')).lastIndexOf(true));
    const page = await open("");
    const give = (content: readonly string[]) =>
      page.locator("#open-game").setInputFiles({
        name: "game.jsonl",
        mimeType: "application/jsonl",
        buffer: Buffer.from(content.join("\n")),
      });
    await give(head);
    await comesToSay(page, "turn", "Player 2's turn, equalizing inning.");
    await give(lines);
    await comesToSay(page, "turn", "The game is drawn: the score is 1 : 1.");
    await comesToShow(page, "#end");
    expect(await page.locator("#end h2").textContent()).toBe("The game is drawn");
    await shows(page, "#rack-up");
  });

  test("a log of drills alone states neither a cost nor an aim that nobody measured", async () => {
    const page = await open("");
    await act(
      page,
      "#new-game",
      "#drill=Lag",
      "#rate=1000",
      "#start-drill",
      "#power=0.3",
      "#shoot",
    );
    await comesToSay(page, "said", /^Missed: 0 of 1/);
    await act(page, "#new-game", "#open-log");
    await says(page, "log-sum", /^1 shot\. Practise next:/);
    const cells = await page.locator("#log tbody td").allTextContents();
    expect(cells.filter((cell) => cell === "–").length).toBeGreaterThan(5);
  });

  test("Hint in a drill aims a stroke, and tells how often it makes the drill", async () => {
    const page = await open("");
    await act(page, "#new-game", "#drill=Kick by one cushion", "#start-drill", "#hint");
    await comesToSay(
      page,
      "said",
      /^Hint: the shot as aimed, at .* makes it \d+ % of the time, in 200 tries\.$/,
    );
  });

  test.each(["eightball", "snooker", "threecushion"])("Hint in practice: %s", async (game) => {
    const page = await open("");
    await begin(page, game, "practice");
    await act(page, "#hint");
    await comesToSay(page, "said", /^Hint: .* keeps the turn \d+ %/);
  });
});
