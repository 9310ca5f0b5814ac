// What a level is: one's own rating by games and drills, the lines of the table, the part of a ball
// that is met, and the price of a hint.
import { describe, expect, test } from "vitest";
import type { Page } from "playwright-core";
import { browserPath, keptGame, pages, sizes, violations } from "./page.js";

describe.runIf(browserPath !== undefined)("by level", () => {
  const { open, bright, frames, struck, text, turnTo } = pages();
  test.each(sizes)(
    "lines and the part of the ball that is met, by setting and by rating; the wheel turns by its step: %s",
    async (_, how) => {
      const one = await open("", how, {
        game: "nineball",
        against: "300",
        own: "800",
        seed: 7,
        at: "0.635,0.635 0.3,1.9 in in in in in in in 0.9,1.9",
      });
      /**
       * Bright pixels of the way of the 1, after a cut by which it goes to the left, near it and
       * farther on.
       */
      const seen = async (lines: string, games: object): Promise<boolean[]> => {
        await one.evaluate(
          ([lines, games]) => {
            localStorage.setItem("carom-settings", JSON.stringify({ lines }));
            localStorage.setItem("carom-ladder", games!);
          },
          [lines, JSON.stringify(games)] as const,
        );
        await one.reload();
        await one.waitForSelector("main[aria-busy=false]");
        await turnTo(one, (Math.atan2(1.9 - 0.635, 0.318 - 0.635) * 180) / Math.PI);
        await frames(one, 4);
        return [
          (await bright(one, [0.12, 2.03], [0.24, 2.13])) > 4,
          (await bright(one, [0.02, 2.2], [0.12, 2.4])) > 4,
        ];
      };
      for (const [lines, games, near] of [
        ["none", {}, false],
        ["short", {}, true],
        ["full", {}, true],
        ["level", {}, true],
        ["level", { 800: [30, 3] }, false],
      ] as const) {
        const [one_, far] = await seen(lines, games);
        expect([lines, one_]).toEqual([lines, near]);
        if (lines === "short") expect(far).toBe(false);
        expect(await one.locator("#part").isVisible()).toBe(near);
      }
      await seen("full", {});
      expect(Number((await text(one, "part")).split(" ")[0])).toBeGreaterThan(40);
      const before = Number(await one.locator("#phi").inputValue());
      expect(await text(one, "wheel")).toBe("↺ 0.02° ↻");
      const box = (await one.locator("#wheel").boundingBox())!;
      await one.mouse.move(box.x + 20, box.y + 20);
      await one.mouse.down();
      await one.mouse.move(box.x + 70, box.y + 20);
      await one.mouse.up();
      expect(Number(await one.locator("#phi").inputValue())).toBeCloseTo(before - 1, 1);
      await one.mouse.click(box.x + 5, box.y + 20);
      await one.locator("#wheel").press("ArrowLeft");
      expect(Number(await one.locator("#phi").inputValue())).toBeCloseTo(before - 0.95, 1);
      expect(await violations(one)).toEqual([]);
      await one.close();
    },
  );

  test("a game that is won against the page's player counts, and a stroke with a hint errs like one's rating", async () => {
    // The nine hangs in the corner.
    const one = await open(
      "",
      {},
      {
        game: "nineball",
        against: "500",
        own: "800",
        seed: 7,
        at: "0.4,0.4 in in in in in in in in 0.06,0.06",
      },
    );
    await one.locator("#new-game").click();
    expect(await text(one, "new-note")).toMatch(
      /You are unrated until your first game\. Hints are those for a 426, the mean of all players\./,
    );
    await one.locator("#rate").selectOption("1000");
    await one.locator("#menu .close").click();
    await one.locator("#hint").click();
    await expect.poll(() => text(one, "said")).toMatch(/^Hint: .* This stroke errs like his\.$/);
    const meant = Number(await one.locator("#phi").inputValue());
    await one.locator("#shoot").click();
    await expect.poll(() => text(one, "turn")).toMatch(/have won: the 9 fell\.$/);
    // The errors of an 800 are below 0.2 degrees.
    expect(Math.abs((await struck(one, "phi")) - meant)).toBeGreaterThan(0.2);
    // A normal distribution, 400 and 150 wide, from 200 to 850, times 1 / (1 + 2^(5 - r / 100)):
    // summed at 200,000 ratings.
    expect(await text(one, "said")).toBe(
      "Your rating is about 487 (95 %: 250 to 741), by 1 : 0 against a 500.",
    );
    expect(await one.locator("#end").innerText()).toMatch(
      /You have won\s+The 9 fell\.[^]*Your best stroke: ball 9 into the head-left pocket; its aim had a room of \d+\.\d\d°\.\s+Your first rating is 487\.\s+Won at the level 500: 1 of 3\./,
    );
    expect(await violations(one)).toEqual([]);
    await one.locator("#play-again").click();
    expect(await one.locator("#end").isVisible()).toBe(false);
    expect(await text(one, "turn")).toContain("You break");
    await one.close();
  });

  test.each(sizes)("a race ends where one has won its racks: %s", async (_, how) => {
    const HANGS = { game: "nineball", against: "person", own: "0", seed: 7 };
    const win = async (racks: [number, number]): Promise<Page> => {
      const at = "0.4,0.4 in in in in in in in in 0.06,0.06";
      const one = await open("", how, { ...HANGS, at, race: 2, racks });
      await turnTo(one, 225);
      await one.locator("#shoot").click();
      await one.locator("#skip").click();
      await one.locator("#end").waitFor();
      return one;
    };
    const racksOf = async (one: Page): Promise<number[]> =>
      (JSON.parse(await keptGame(one)) as { racks: number[] }).racks;
    const first = await win([0, 1]);
    expect(await first.locator("#end").innerText()).toContain("Race to 2: 1 : 1");
    expect(await text(first, "play-again")).toBe("Next rack");
    await first.locator("#play-again").click();
    expect(await racksOf(first)).toEqual([1, 1]);
    expect(await text(first, "score")).toBe("lowest ball 1 · race to 2: 1 : 1");
    await first.close();
    const last = await win([1, 0]);
    expect(await last.locator("#end").innerText()).toContain("The race is won by 2 : 0.");
    await last.locator("#play-again").click();
    expect(await racksOf(last)).toEqual([0, 0]);
    await last.close();
  });

  test("the ladder and the stars show what was won and made, and a dash where nothing was", async () => {
    const one = await open("");
    await one.evaluate(() => {
      localStorage.setItem("carom-ladder", '{"200":[3,1],"300":[1,2]}');
      localStorage.setItem("carom-drills", '{"Draw":[0,3],"Side pocket":[9,10],"Follow":[1,9]}');
    });
    await one.reload();
    await one.waitForSelector("main[aria-busy=false]");
    await one.locator("#new-game").click();
    const rungs = await one.locator("#ladder button").allTextContents();
    expect(rungs.slice(0, 3)).toEqual(["200★", "3001 : 2", "400–"]);
    await one.locator("#ladder button").nth(3).click();
    expect(await one.locator("#new-against").inputValue()).toBe("500");
    const drills = await one.locator("#drill option").allTextContents();
    for (const drill of ["Draw ☆☆☆", "Side pocket ★★★", "Follow ★☆☆", "Stop shot –"])
      expect(drills).toContain(drill);
    expect(await violations(one)).toEqual([]);
    await one.close();
  });
});
