// The coach and the view in three dimensions, in a browser.
import { describe, expect, test } from "vitest";
import { browserPath, pages, sizes, violations } from "./page.js";

describe.runIf(browserPath !== undefined)("beside the game", () => {
  const { open, text, set } = pages();

  test("the coach tells chances before a stroke, what it cost after it, and keeps a log to print", async () => {
    const one = await open("", { width: 390, height: 844, touch: true });
    // A straight pot, and the nine for the game.
    await one.evaluate(() => localStorage.setItem("carom-game", JSON.stringify({ game: "nineball", against: "person", own: "0", seed: 7, at: "0.635,1.2 0.3,2.2 in in in in in in in 0.9,1.9", entries: [] })));
    await one.reload();
    await one.waitForSelector("main[aria-busy=false]");
    await one.locator("#new-game").click();
    await one.locator("#coach").check();
    await one.locator("#rate").selectOption("1000");
    await one.locator("#menu .close").click();
    await one.locator("#hint").click();
    await expect.poll(() => text(one, "said"), { timeout: 30_000 }).toMatch(/^Hint: ball [19] into the .*: plays on \d+ %, wins \d+ %, foul \d+ %\.$/);
    // A stroke that meets nothing: a foul, which the chances and the review tell.
    await one.locator("#phi").evaluate((input: HTMLInputElement) => {
      input.value = "200";
      input.dispatchEvent(new Event("input"));
    });
    await set(one, "power", 0.6);
    await expect.poll(() => text(one, "said"), { timeout: 30_000 }).toMatch(/^This stroke plays on 0 %, wins \d+ %, is a foul 100 %\.$/);
    await one.locator("#shoot").click();
    await expect.poll(() => text(one, "said"), { timeout: 30_000 }).toMatch(/^That stroke: wins \d+ %\. Best: .*, wins \d+ %\. It cost \d+ %\.$/);
    await one.locator("#open-log").click();
    expect(await one.locator("#log tbody tr").count()).toBe(1);
    expect(await text(one, "log-sum")).toMatch(/^1 stroke\. A stroke cost [1-9]\d* % of a game/);
    expect(await violations(one)).toEqual([]);
    // On paper there is the log alone.
    await one.emulateMedia({ media: "print" });
    expect(await one.locator("#table-scene").isVisible()).toBe(false);
    expect(await one.locator("#log table").isVisible()).toBe(true);
    await one.close();
  });

  test.each(sizes)("the view from behind the cue starts when it is asked for, and shows the balls as they roll: %s", async (_, how) => {
    const one = await open("", how);
    expect(await one.locator("#scene").count()).toBe(0);
    await one.locator("#space").click();
    await one.locator("#scene").waitFor({ timeout: 30_000 });
    expect(await violations(one)).toEqual([]);
    // What is seen changes with the aim and with the balls.
    const seen = async (): Promise<string> => (await one.locator("#scene").screenshot()).toString("base64");
    const before = await seen();
    const box = (await one.locator("#scene").boundingBox())!;
    await one.mouse.move(box.x + 100, box.y + 100);
    await one.mouse.down();
    await one.mouse.move(box.x + 150, box.y + 100);
    await one.mouse.up();
    expect(Number(await one.locator("#phi").inputValue())).toBeCloseTo(90 - 4, 0);
    const turned = await seen();
    expect(turned).not.toBe(before);
    await one.locator("#shoot").click();
    await one.waitForTimeout(800);
    expect(await seen()).not.toBe(turned);
    await one.locator("#space").click();
    expect(await one.locator("#scene").count()).toBe(0);
    expect(await one.locator("#table-scene").isVisible()).toBe(true);
    await one.close();
  });

  test("without WebGL the flat view stays, and the page says why", async () => {
    const one = await open("");
    await one.evaluate(() => {
      const get = HTMLCanvasElement.prototype.getContext as (this: HTMLCanvasElement, kind: string, ...rest: unknown[]) => unknown;
      HTMLCanvasElement.prototype.getContext = function (this: HTMLCanvasElement, kind: string, ...rest: unknown[]) {
        return kind === "webgl2" ? null : get.call(this, kind, ...rest);
      } as typeof HTMLCanvasElement.prototype.getContext;
    });
    await one.locator("#space").click();
    await expect.poll(() => text(one, "said")).toBe("This browser does not show three dimensions (it has no WebGL 2).");
    expect(await one.locator("#table-scene").isVisible()).toBe(true);
    await one.close();
  });
});
