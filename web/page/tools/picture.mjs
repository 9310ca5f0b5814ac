// picture.mjs OUT.png [WIDTH HEIGHT]: a screenshot of the page for docs/figures/, 1300 by 800
// pixels or the size of a phone; run it after `npm run page`. The default size shows the scene, and
// also writes the visible text to OUT.txt, by which page/test/smoke.test.ts finds old screenshots.
import { writeFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { chromium } from "playwright-core";

/**
 * The page with a game of eight-ball after the break, with a hint, in a view of the settings; its
 * words, line by line.
 */
export async function scene(browser, width, height, view = "device") {
  const page = await browser.newPage({ viewport: { width, height } });
  await page.addInitScript(() => {
    if (localStorage.getItem("carom-settings")) return;
    localStorage.setItem(
      "carom-game",
      JSON.stringify({ game: "eightball", against: "500", own: "0", seed: 4, entries: [] }),
    );
  });
  await page.goto(`file://${fileURLToPath(new URL("../dist/index.html", import.meta.url))}`);
  await page.waitForSelector("main[aria-busy=false]");
  await page.locator("#shoot").click();
  await page.locator("#skip").click();
  const says = (id, start) =>
    page.waitForFunction(
      ([selector, text]) => document.querySelector(selector).textContent.includes(text),
      [id, start],
      { timeout: 60000 },
    );
  await says("#turn", "Your turn");
  // The film was drawn, as the processor draws too few pictures of the scene.
  await page.evaluate(
    (view) => localStorage.setItem("carom-settings", JSON.stringify({ view })),
    view,
  );
  await page.reload();
  await says("#turn", "Your turn");
  await page.locator("#hint").click();
  await says("#said", "Hint: ");
  await page.evaluate(() => document.activeElement?.blur());
  await page.waitForTimeout(300);
  const words = await page.evaluate(() => document.body.innerText);
  // the version does not matter for a screenshot
  return {
    page,
    words: `${words
      .replace(/carom \d+\.\d+\.\d+/, "carom")
      .replace(/\s*\n\s*/g, "\n")
      .trim()}\n`,
  };
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const [out, width = 1300, height = 800] = process.argv.slice(2);
  const browser = await chromium.launch({
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    args: ["--no-sandbox", "--enable-unsafe-swiftshader"],
  });
  const isWide = Number(width) === 1300;
  const view = isWide ? "scene" : "device";
  const { page, words } = await scene(browser, Number(width), Number(height), view);
  if (isWide) await page.waitForTimeout(5000); // the processor draws the scene
  await page.screenshot({ path: out });
  if (isWide) writeFileSync(out.replace(/\.png$/, ".txt"), words);
  await browser.close();
}
