// The cushions of one's own table by three banks, and named conditions: from the dialog to a game
// that keeps them.
import { describe, expect, test } from "vitest";
import { browserPath, keptGame, linesOf, pages, sizes, violations } from "./page.js";

describe.runIf(browserPath !== undefined)("conditions of a table", () => {
  const { open, text, set } = pages();
  type Page = Awaited<ReturnType<typeof open>>;
  async function shoot(one: Page): Promise<{ cloth?: string; cushion?: string }> {
    await set(one, "power", 3);
    await one.locator("#shoot").click();
    const strokes = async (): Promise<number> => linesOf(await keptGame(one), "shot").length;
    await expect.poll(() => strokes().catch(() => 0)).toBeGreaterThan(0);
    return JSON.parse(await keptGame(one)) as { cloth?: string; cushion?: string };
  }

  test.each(sizes)("three readings become a table to play on: %s", async (_, size) => {
    const one = await open("", size);
    await one.locator("#new-game").click();
    await one.locator("#open-calibration").click();
    expect(await one.locator("#calibration path").count()).toBe(3);
    expect(await one.locator("#use-calibration").isDisabled()).toBe(true);
    const read = async (...places: number[]): Promise<void> => {
      for (const [k, place] of places.entries()) await set(one, `bank-${k + 1}`, place);
    };
    await read(3, 6.5, 5.6);
    expect(await text(one, "calibration-said")).toMatch(/miss by 34 cm/);
    await read(4.7, 5.6, 9);
    expect(await text(one, "calibration-said")).toMatch(/above 0 and below 8/);
    await read(4.7, 5.6, 5.6);
    // As carom calibrate says of these readings.
    expect(await text(one, "calibration-said")).toBe(
      "Your cushions: restitution 0.828 ± 0.033, friction 0.306 ± 0.049.",
    );
    expect(await violations(one)).toEqual([]);
    const download = one.waitForEvent("download");
    await one.locator("#save-calibration").click();
    expect((await download).suggestedFilename()).toBe("my.json");
    await one.locator("#use-calibration").click();
    await one.locator("#start").click();
    expect((await shoot(one)).cushion).toBe("0.828,0.306");
    await one.locator("#new-game").click();
    expect(await one.locator("#new-cushion option:checked").textContent()).toMatch(/^mine: /);
    await one.close();
  });

  test("a named cloth and cushion are those of the game; snooker has none", async () => {
    const one = await open("");
    await one.locator("#new-game").click();
    await one.locator("#new-which").selectOption("snooker");
    expect(await one.locator("#new-cloth").isVisible()).toBe(false);
    await one.locator("#new-which").selectOption("eightball");
    await one.locator("#new-cloth").selectOption("slow_cloth");
    await one.locator("#new-cushion").selectOption("old_cushion");
    await one.locator("#start").click();
    const game = await shoot(one);
    expect([game.cloth, game.cushion]).toEqual(["slow_cloth", "old_cushion"]);
    await one.close();
    // The game is read on the balls and the table that its own lines hold.
    const again = await open("", {}, game);
    expect(JSON.parse(await keptGame(again))).toEqual(game);
    await again.close();
  });
});
