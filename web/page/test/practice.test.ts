// Practice in a browser: drills with their counts.
import { describe, expect, test } from "vitest";
import { browserPath, pages } from "./page.js";

describe.runIf(browserPath !== undefined)("practice", () => {
  const { open, text, set } = pages();

  test("a drill counts what is made and missed, begins again, and hides the way of the balls", async () => {
    const one = await open("", { width: 390, height: 844, touch: true });
    await one.locator("#new-game").click();
    await one.locator("#rate").selectOption("1000");
    await one.locator("#drill").selectOption("Short straight pot");
    await one.locator("#start-drill").click();
    expect(await text(one, "turn")).toBe("Short straight pot");
    const turn = (phi: number): Promise<void> =>
      one.locator("#phi").evaluate((input: HTMLInputElement, phi) => {
        input.value = String(phi);
        input.dispatchEvent(new Event("input"));
      }, phi);
    await turn(200);
    await one.locator("#shoot").click();
    await expect.poll(() => text(one, "said")).toBe("Missed: 0 of 1.");
    await turn(45);
    await set(one, "power", 1.5);
    await one.locator("#shoot").click();
    await expect.poll(() => text(one, "said")).toBe("Made: 1 of 2.");
    expect(await one.locator("#undo-stroke").isVisible()).toBe(false);
    await one.reload();
    await one.waitForSelector("main[aria-busy=false]");
    expect(await text(one, "turn")).toBe("Short straight pot");
    await one.locator("#new-game").click();
    await one.locator("#drill").selectOption("Stop shot");
    await one.locator("#drill").selectOption("Short straight pot");
    expect(await text(one, "drill-note")).toContain("Made 1 of 2.");
    await one.close();
  });
});
