// The cushions of one's own table by three banks, and named conditions: from the dialog to a game
// that keeps them.
import { expect, test } from "vitest";
import {
  act,
  counts,
  describePages,
  keptGame,
  keptSetup,
  linesOf,
  pages,
  says,
  shows,
  sizes,
  violations,
} from "./page.js";

describePages("conditions of a table", () => {
  const { open, set } = pages();
  type Page = Awaited<ReturnType<typeof open>>;
  async function shoot(page: Page): Promise<{ cloth?: string; cushion?: string }> {
    await act(page, "#power=3", "#shoot");
    const strokes = async () => linesOf(await keptGame(page), "shot").length;
    await expect.poll(() => strokes().catch(() => 0)).toBeGreaterThan(0);
    return await keptSetup<{ cloth?: string; cushion?: string }>(page);
  }

  test.each(sizes)("three readings become a table to play on: %s", async (_, size) => {
    const page = await open("", size);
    await act(page, "#new-game", "#new-more", "#open-calibration");
    await counts(page, "#calibration path", 3);
    expect(await page.locator("#use-calibration").isDisabled()).toBe(true);
    const read = async (...places: number[]) => {
      for (const [k, place] of places.entries()) await set(page, `bank-${k + 1}`, place);
    };
    await read(3, 6.5, 5.6);
    await says(page, "calibration-said", /miss by 34 cm/);
    await read(4.7, 5.6, 9);
    await says(page, "calibration-said", /above 0 and below 8/);
    await read(4.7, 5.6, 5.6);
    // As carom calibrate says of these readings.
    await says(
      page,
      "calibration-said",
      "Your cushions: restitution 0.828 ± 0.033, friction 0.306 ± 0.049.",
    );
    expect(await violations(page)).toEqual([]);
    const download = page.waitForEvent("download");
    await act(page, "#save-calibration");
    expect((await download).suggestedFilename()).toBe("my.json");
    await act(page, "#use-calibration", "#start");
    expect((await shoot(page)).cushion).toBe("0.828,0.306");
    await act(page, "#new-game");
    expect(await page.locator("#new-cushion option:checked").textContent()).toMatch(/^mine: /);
  });

  test("a named cloth and cushion are those of the game; snooker has none", async () => {
    const page = await open("");
    await act(page, "#new-game", "#new-which=snooker");
    await shows(page, "#new-cloth", false);
    await act(
      page,
      "#new-which=eightball",
      "#new-cloth=slow_cloth",
      "#new-cushion=old_cushion",
      "#start",
    );
    const game = await shoot(page);
    expect([game.cloth, game.cushion]).toEqual(["slow_cloth", "old_cushion"]);
    await page.close();
    // The game is read on the balls and the table that its own lines hold.
    const reopened = await open("", {}, game);
    expect(JSON.parse(await keptGame(reopened))).toEqual(game);
  });
});
