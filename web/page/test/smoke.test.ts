// One look at each view in a browser: it opens without complaint, does what it is for once, and axe
// finds nothing. ./test runs this file alone of the page's; the others run before a release, or in
// web/ by CAROM_PAGE=whole npm test.
import { readFileSync } from "node:fs";
import { chromium } from "playwright-core";
import { expect, test } from "vitest";
import { root } from "../../test/support.js";
import { scene } from "../tools/picture.mjs";
import {
  act,
  browserPath,
  comesToCount,
  comesToShow,
  describePages,
  keptGame,
  linesOf,
  numberIn,
  pages,
  says,
  shows,
  sizes,
  violations,
} from "./page.js";

describePages("smoke", () => {
  const { open, text } = pages();

  test.each(sizes)("a game: a stroke is played, ruled and kept: %s", async (_, how) => {
    const page = await open("", how);
    await says(page, "turn", /You break/);
    expect(await violations(page)).toEqual([]);
    await act(page, "#power=6", "#shoot", "#skip");
    // The page's player or the one who sits here is next, and the game has the stroke.
    await expect.poll(() => text(page, "turn")).not.toContain("You break");
    const shots = linesOf(await keptGame(page), "shot");
    expect(shots[0]).toHaveProperty("speed");
  });

  test("the pictures of the docs show the words of today", async () => {
    const browser = await chromium.launch({ executablePath: browserPath!, args: ["--no-sandbox"] });
    const { words } = await scene(browser, 1300, 800);
    await browser.close();
    expect(words).toBe(readFileSync(`${root}docs/figures/explorer.txt`, "utf8"));
  });

  test("a hint aims the stroke that it names", async () => {
    const page = await open("");
    const initial = await text(page, "said");
    await act(page, "#power=1", "#hint");
    await expect.poll(() => text(page, "said")).not.toBe(initial);
    // A break is played hard.
    await expect.poll(async () => await numberIn(page, "power")).toBeGreaterThan(5);
  });

  test("a new game shows its power in per cent, and no control that says nothing", async () => {
    const page = await open("");
    await act(page, "#power=5");
    expect(await text(page, "power-value")).toBe("50 %");
    expect(await page.locator("#power").getAttribute("aria-valuetext")).toBe("50 %");
    expect(await text(page, "speed-value")).toBe("5.00 m/s");
    // Nothing was played, and a break is met by a rack, of which no part can be chosen.
    for (const control of ["#replay", "#part", "#push"]) await shows(page, control, false);
    await act(page, "#shoot", "#skip");
    await comesToShow(page, "#replay");
  });

  test("the balls are listed in words", async () => {
    const page = await open("");
    await act(page, "#more", "details:has(#ball-list) summary");
    await comesToCount(page, "#ball-list li", 16);
    expect(await page.locator("#ball-list li").first().textContent()).toMatch(
      /^cue: \d+ cm from the left cushion, \d+ cm from the head cushion$/,
    );
  });

  test("the laboratory: a break is played, and its events are listed", async () => {
    const page = await open("#view=lab");
    // Of the page at rest: what a film lights up changes its colour as it plays.
    expect(await violations(page)).toEqual([]);
    await act(page, "#play");
    await expect.poll(() => page.locator(".events li").count()).toBeGreaterThan(5);
  });

  test("a collision: the numbers follow the cut", async () => {
    const page = await open("#view=collision&speed=2&cut=10");
    const initial = await text(page, "n-object");
    await act(page, "#cut=40");
    await expect.poll(() => text(page, "n-object")).not.toBe(initial);
    expect(await violations(page)).toEqual([]);
  });
});
