// picture.mjs OUT.png [WIDTH HEIGHT]: a picture of the page for docs/figures/, 1300 by 800 or as large as a phone; after `npm run page`.
import { fileURLToPath } from "node:url";
import { chromium } from "playwright-core";

const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: ["--no-sandbox"] });
const [out, width = 1300, height = 800] = process.argv.slice(2);
const page = await browser.newPage({ viewport: { width: Number(width), height: Number(height) } });
await page.goto(`file://${fileURLToPath(new URL("../explorer/dist/index.html", import.meta.url))}#view=shot&phi=89.4&right=-0.15&speed=8.5`);
await page.waitForSelector("main[aria-busy=false]");
await page.waitForSelector(".events li");
await page.locator("#time").evaluate((input) => {
  input.value = "0.62";
  input.dispatchEvent(new Event("input"));
});
await page.evaluate(() => document.activeElement?.blur());
await page.waitForTimeout(300);
await page.screenshot({ path: out });
await browser.close();
