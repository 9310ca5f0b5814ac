// What a level is: one's own rating by games and drills, the lines of the table, the part of a ball
// that is met, and the price of a hint.
import { expect, test } from "vitest";
import type { Page } from "playwright-core";
import {
  act,
  boxOf,
  comesToSay,
  describePages,
  dragMouse,
  gameOf,
  keptSetup,
  numberIn,
  pages,
  reload,
  says,
  shows,
  sizes,
  valueOf,
  violations,
} from "./page.js";

describePages("by level", () => {
  const { open, bright, frames, struck, text, turnTo } = pages();
  test.each(sizes)(
    "lines and the part of the ball that is met, by setting and by rating; the wheel turns by its step: %s",
    async (_, how) => {
      const page = await open(
        "",
        how,
        gameOf("nineball", "300", "0.635,0.635 0.3,1.9 in in in in in in in 0.9,1.9", "800"),
      );
      /**
       * Bright pixels of the way of the 1, after a cut by which it goes to the left, near it and
       * farther on.
       */
      const seen = async (lines: string, games: object) => {
        await page.evaluate(
          ([lines, games]) => {
            localStorage.setItem("carom-settings", JSON.stringify({ lines }));
            localStorage.setItem("carom-ladder", games!);
          },
          [lines, JSON.stringify(games)] as const,
        );
        await reload(page);
        await turnTo(page, (Math.atan2(1.9 - 0.635, 0.318 - 0.635) * 180) / Math.PI);
        await frames(page, 4);
        return [
          (await bright(page, [0.12, 2.03], [0.24, 2.13])) > 4,
          (await bright(page, [0.02, 2.2], [0.12, 2.4])) > 4,
        ];
      };
      for (const [lines, games, isNear] of [
        ["none", {}, false],
        ["short", {}, true],
        ["full", {}, true],
        ["level", {}, true],
        ["level", { 800: [30, 3] }, false],
      ] as const) {
        const [one_, far] = await seen(lines, games);
        expect([lines, one_]).toEqual([lines, isNear]);
        if (lines === "short") expect(far).toBe(false);
        expect(await page.locator("#part").isVisible()).toBe(isNear);
      }
      await seen("full", {});
      // A tap on the picture says what it shows.
      await act(page, "#part");
      const [, share] = /^Your aim covers (\d+) % of the 1\./.exec(await text(page, "said"))!;
      expect(Number(share)).toBeGreaterThan(40);
      const initial = await numberIn(page, "phi");
      const box = await boxOf(page, "#wheel");
      await dragMouse(page, [box.x + 20, box.y + 20], [box.x + 70, box.y + 20]);
      expect(await numberIn(page, "phi")).toBeCloseTo(initial - 1, 1);
      await page.mouse.click(box.x + 5, box.y + 20);
      await page.locator("#wheel").press("ArrowLeft");
      expect(await numberIn(page, "phi")).toBeCloseTo(initial - 0.95, 1);
      expect(await violations(page)).toEqual([]);
    },
  );

  /** The nine hangs in the corner, against a 500. */
  const HANGS = "0.4,0.4 in in in in in in in in 0.06,0.06";
  const ladder = (page: Page) => page.evaluate(() => localStorage.getItem("carom-ladder"));

  test("a game that is won against the page's player counts on the scale of its game", async () => {
    const page = await open("", {}, gameOf("nineball", "500", HANGS, "800"));
    await act(page, "#new-game");
    await says(
      page,
      "new-note",
      /You are unrated until your first game\. Until then, hints are for a 426, the average player\./,
    );
    await act(page, "#rate=1000", "#menu .close");
    await turnTo(page, 225);
    await act(page, "#shoot");
    await comesToSay(page, "turn", /have won: the 9 was potted\.$/);
    // A normal distribution, 400 and 150 wide, from 200 to 850, times 1 / (1 + 2^(5 - r / 100)):
    // summed at 200,000 ratings.
    await says(
      page,
      "said",
      "Your rating is about 487 (95 %: 250 to 741), from 1 : 0 against a 500.",
    );
    expect(await page.locator("#end").innerText()).toMatch(
      /You have won\s+The 9 was potted\.[^]*Your best shot: ball 9 into the head-left pocket, with an aiming window of \d+\.\d\d°\.\s+Your first rating is 487\.\s+Level 500: 1 of 3 games won\./,
    );
    // The other balls roll out, unless motion is to be reduced.
    const rolling = () =>
      page
        .locator("#end .out svg")
        .evaluateAll((balls) => balls.map((ball) => getComputedStyle(ball).animationName));
    expect(await rolling()).toEqual(Array(9).fill("roll-out"));
    await page.emulateMedia({ reducedMotion: "reduce" });
    expect(await rolling()).toEqual(Array(9).fill("none"));
    await page.emulateMedia({ reducedMotion: null });
    expect(await violations(page)).toEqual([]);
    expect(await ladder(page)).toBe('{"nineball/500":[1,0]}');
    await act(page, "#play-again");
    await shows(page, "#end", false);
    await says(page, "turn", /You break/);
    // The ladder of another game has not been climbed.
    for (const [game, stands] of [
      ["nineball", "500★☆☆"],
      ["snooker", "500☆☆☆"],
    ] as const) {
      await act(page, "#new-game", `#new-which=${game}`);
      expect(await page.locator("#ladder button").nth(3).textContent()).toBe(stands);
      await act(page, "#menu .close");
    }
  });

  test.each([
    ["as it is", 0, "hint"],
    ["turned by 1 degree", 1, "hint"],
    ["turned by 3 degrees", 3, "player"],
  ])(
    "a stroke of a hint errs like one's rating and counts for nothing: %s",
    async (_, by, aimer) => {
      const page = await open("", {}, gameOf("nineball", "500", HANGS, "800"));
      await act(page, "#new-game", "#rate=1000", "#coach=on", "#menu .close", "#hint");
      await comesToSay(
        page,
        "said",
        /^Hint: .* Played now, it gets the errors of that rating\. If you play it, this game does not count/,
      );
      const meant = await numberIn(page, "phi");
      await turnTo(page, meant + by);
      await act(page, "#shoot");
      // What misses may be followed by more strokes of both.
      for (;;) {
        await comesToSay(page, "turn", /won: the 9 was potted\.$|Your turn/);
        if (/won: /.test(await text(page, "turn"))) break;
        await act(page, "#shoot");
      }
      const { aims } = await keptSetup<{ aims: string }>(page);
      expect(aims[0]).toBe(aimer[0]);
      const isOwn = aimer === "player";
      // The errors of an 800 are below 0.2 degrees.
      const error = Math.abs((await struck(page, "phi")) - meant - by);
      expect(error > 0.2).toBe(!isOwn);
      expect((await ladder(page)) !== null).toBe(isOwn);
      const words = await page.locator("#end").innerText();
      expect(words.includes("You used 1 hint, so this game")).toBe(!isOwn);
      await act(page, "#end .close");
      if (!isOwn) expect(await page.evaluate(() => localStorage.getItem("carom-log"))).toBeNull();
    },
  );

  test("a drill that a hint makes counts for nothing", async () => {
    const page = await open("", {});
    await act(
      page,
      "#new-game",
      "#rate=1000",
      "#drill=Short straight pot",
      "#start-drill",
      "#hint",
    );
    await comesToSay(page, "said", /^Hint: the shot as aimed/);
    await act(page, "#shoot");
    await comesToSay(page, "said", /You used a hint, so this try does not count\.$/);
    const kept = await page.evaluate(() => [
      localStorage.getItem("carom-drills"),
      localStorage.getItem("carom-log"),
    ]);
    expect(kept).toEqual([null, null]);
    // The next try is one's own.
    await turnTo(page, 45);
    await act(page, "#power=1.5", "#shoot");
    await comesToSay(page, "said", /^Made: 1 of 1\./);
  });

  test.each(sizes)("a race ends where one has won its racks: %s", async (_, how) => {
    const win = async (racks: [number, number]) => {
      const page = await open("", how, { ...gameOf("nineball", "person", HANGS), race: 2, racks });
      await turnTo(page, 225);
      await act(page, "#shoot", "#skip");
      await page.locator("#end").waitFor();
      return page;
    };
    const racksOf = async (page: Page) => (await keptSetup<{ racks: number[] }>(page)).racks;
    const first = await win([0, 1]);
    expect(await first.locator("#end").innerText()).toContain("Race to 2: 1 : 1");
    await says(first, "play-again", "Next rack");
    await act(first, "#play-again");
    expect(await racksOf(first)).toEqual([1, 1]);
    await says(first, "score", "lowest ball 1 · race to 2: 1 : 1");
    await first.close();
    const last = await win([1, 0]);
    expect(await last.locator("#end").innerText()).toContain("The race ends 2 : 0.");
    await act(last, "#play-again");
    expect(await racksOf(last)).toEqual([0, 0]);
  });

  test("the ladder and the drills show by stars what was won and made", async () => {
    const page = await open("");
    await page.evaluate(() => {
      localStorage.setItem("carom-ladder", '{"200":[3,1],"300":[1,2]}');
      localStorage.setItem("carom-drills", '{"Draw":[0,3],"Side pocket":[9,10],"Follow":[1,9]}');
    });
    await reload(page);
    await act(page, "#new-game");
    const rungs = await page.locator("#ladder button").allTextContents();
    expect(rungs.slice(0, 3)).toEqual(["200★★★", "300★☆☆", "400☆☆☆"]);
    await page.locator("#ladder button").nth(3).click();
    expect(await valueOf(page, "new-against")).toBe("500");
    // A card chooses what its select has, and a select marks its card.
    await page.locator(".card[value=nineball]").click();
    expect(await valueOf(page, "new-which")).toBe("nineball");
    await act(page, "#new-which=snooker", "#new-against=person");
    expect(await page.locator("#menu .card[aria-pressed=true] b").allTextContents()).toEqual([
      "A friend on this device",
      "Snooker",
    ]);
    const drills = await page.locator("#drill option").allTextContents();
    for (const drill of ["Draw ☆☆☆", "Side pocket ★★★", "Follow ★☆☆", "Stop shot –"])
      expect(drills).toContain(drill);
    expect(await violations(page)).toEqual([]);
  });
});
