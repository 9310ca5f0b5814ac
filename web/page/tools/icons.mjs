// icons.mjs: the icons of the installed page, public/icon-192.png and icon-512.png, drawn from
// public/icon.svg by Chromium. The drawing is inside the circle of 80 % that every icon shape
// keeps, so the large icon is also the maskable one.
import { readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { chromium } from "playwright-core";

const pathOf = (name) => fileURLToPath(new URL(`../public/${name}`, import.meta.url));
const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  args: ["--no-sandbox"],
});
const svg = readFileSync(pathOf("icon.svg")).toString("base64");
for (const size of [192, 512]) {
  const page = await browser.newPage({ viewport: { width: size, height: size } });
  await page.setContent(
    `<style>body { margin: 0 } img { display: block; width: 100vw }</style>
    <img src="data:image/svg+xml;base64,${svg}">`,
  );
  await page.locator("img").evaluate((image) => image.decode());
  await page.screenshot({ path: pathOf(`icon-${size}.png`) });
}
await browser.close();
