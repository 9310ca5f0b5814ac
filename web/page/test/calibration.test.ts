// The cushions of one's own table by three banks, and named conditions: from the dialog to a game
// that keeps them.
import { describe, expect, test } from "vitest";
import { browserPath, keptGame, linesOf, pages, sizes, violations } from "./page.js";

describe.runIf(browserPath !== undefined)("conditions of a table", () => {
  const { open, text, set } = pages();
  type Page = Awaited<ReturnType<typeof open>>;
  async function shoot(page: Page): Promise<{ cloth?: string; cushion?: string }> {
    await set(page, "power", 3);
    await page.locator("#shoot").click();
    const strokes = async (): Promise<number> => linesOf(await keptGame(page), "shot").length;
    await expect.poll(() => strokes().catch(() => 0)).toBeGreaterThan(0);
    return JSON.parse(await keptGame(page)) as { cloth?: string; cushion?: string };
  }

  test.each(sizes)("three readings become a table to play on: %s", async (_, size) => {
    const page = await open("", size);
    await page.locator("#new-game").click();
    await page.locator("#open-calibration").click();
    expect(await page.locator("#calibration path").count()).toBe(3);
    expect(await page.locator("#use-calibration").isDisabled()).toBe(true);
    const read = async (...places: number[]): Promise<void> => {
      for (const [k, place] of places.entries()) await set(page, `bank-${k + 1}`, place);
    };
    await read(3, 6.5, 5.6);
    expect(await text(page, "calibration-said")).toMatch(/miss by 34 cm/);
    await read(4.7, 5.6, 9);
    expect(await text(page, "calibration-said")).toMatch(/above 0 and below 8/);
    await read(4.7, 5.6, 5.6);
    // As carom calibrate says of these readings.
    expect(await text(page, "calibration-said")).toBe(
      "Your cushions: restitution 0.828 ± 0.033, friction 0.306 ± 0.049.",
    );
    expect(await violations(page)).toEqual([]);
    const download = page.waitForEvent("download");
    await page.locator("#save-calibration").click();
    expect((await download).suggestedFilename()).toBe("my.json");
    await page.locator("#use-calibration").click();
    await page.locator("#start").click();
    expect((await shoot(page)).cushion).toBe("0.828,0.306");
    await page.locator("#new-game").click();
    expect(await page.locator("#new-cushion option:checked").textContent()).toMatch(/^mine: /);
    await page.close();
  });

  test("a named cloth and cushion are those of the game; snooker has none", async () => {
    const page = await open("");
    await page.locator("#new-game").click();
    await page.locator("#new-which").selectOption("snooker");
    expect(await page.locator("#new-cloth").isVisible()).toBe(false);
    await page.locator("#new-which").selectOption("eightball");
    await page.locator("#new-cloth").selectOption("slow_cloth");
    await page.locator("#new-cushion").selectOption("old_cushion");
    await page.locator("#start").click();
    const game = await shoot(page);
    expect([game.cloth, game.cushion]).toEqual(["slow_cloth", "old_cushion"]);
    await page.close();
    // The game is read on the balls and the table that its own lines hold.
    const reopened = await open("", {}, game);
    expect(JSON.parse(await keptGame(reopened))).toEqual(game);
    await reopened.close();
  });
});
