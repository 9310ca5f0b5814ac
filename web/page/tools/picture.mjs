// picture.mjs OUT.png [WIDTH HEIGHT]: a picture of the page for docs/figures/, 1300 by 800 or as
// large as a phone; after `npm run page`.
import { fileURLToPath } from "node:url";
import { chromium } from "playwright-core";

const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  args: ["--no-sandbox"],
});
const [out, width = 1300, height = 800] = process.argv.slice(2);
const page = await browser.newPage({ viewport: { width: Number(width), height: Number(height) } });
// A break of eight-ball, some time after it.
await page.addInitScript(() =>
  localStorage.setItem(
    "carom-game",
    JSON.stringify({ game: "eightball", against: "500", own: "0", seed: 4, entries: [] }),
  ),
);
await page.goto(`file://${fileURLToPath(new URL("../dist/index.html", import.meta.url))}`);
await page.waitForSelector("main[aria-busy=false]");
await page.locator("#shoot").click();
await page.locator("#skip").click();
await page.waitForFunction(
  () => /Your turn/.test(document.querySelector("#turn").textContent),
  undefined,
  { timeout: 60000 },
);
await page.locator("#hint").click();
await page.waitForFunction(
  () => document.querySelector("#said").textContent.startsWith("Hint: "),
  undefined,
  { timeout: 60000 },
);
await page.evaluate(() => document.activeElement?.blur());
await page.waitForTimeout(300);
await page.screenshot({ path: out });
await browser.close();
