// picture.mjs OUT.png: the picture of the page that README shows; after `npm run page`.
import { fileURLToPath } from "node:url";
import { chromium } from "playwright-core";

const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: ["--no-sandbox"] });
const page = await browser.newPage({ viewport: { width: 1300, height: 800 } });
await page.goto(`file://${fileURLToPath(new URL("../explorer/dist/index.html", import.meta.url))}#view=shot&phi=89.4&right=-0.15&speed=8.5`);
await page.waitForSelector("main[aria-busy=false]");
// The figures below the table are those of code that runs, not of its start.
for (let k = 0; k < 30; k++) await page.locator("#table-scene").press(k % 2 === 0 ? "ArrowLeft" : "ArrowRight");
await page.waitForSelector(".events li");
await page.locator("#time").evaluate((input) => {
  input.value = "0.62";
  input.dispatchEvent(new Event("input"));
});
await page.evaluate(() => document.activeElement?.blur());
await page.waitForTimeout(300);
await page.screenshot({ path: process.argv[2] });
await browser.close();
