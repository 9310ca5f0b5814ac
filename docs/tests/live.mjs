// live.mjs SITE [PICTURES]: opens the site of `./run --docs` in Chromium, wide and as a phone, and
// prints it. Every example in JavaScript runs in its page, the search finds, and no page is wider
// than the screen. PICTURES is a folder for screenshots and a printed page. Ends with 77 where it
// cannot run.
import { createReadStream, existsSync, readdirSync } from "node:fs";
import { createServer } from "node:http";
import { createRequire } from "node:module";
import { extname, resolve } from "node:path";

const [site, pictures] = process.argv.slice(2).map((path) => resolve(path));
const executablePath =
  process.env.CHROMIUM ??
  ["/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"].find(existsSync);
let chromium;
try {
  ({ chromium } = createRequire(new URL("../../web/package.json", import.meta.url))(
    "playwright-core",
  ));
} catch {
  // told below
}
if (!existsSync(`${site}/live/carom.js`) || !executablePath || !chromium) {
  console.log(
    "skipped: this needs a site with the package of web/ in it, playwright-core in web/node_modules, and Chromium",
  );
  process.exit(77);
}

const check = (holds, what) => {
  if (!holds) throw new Error(what);
};
const PAGES = [
  "index.html",
  "docs/using/python.html",
  "docs/using/shots.html",
  "docs/understanding/method.html",
  "docs/using/command.html",
  "reference/options.html",
  "docs/understanding/physics.html",
  "web/npm/examples/break_paths.mjs.html",
];
const allPrograms = readdirSync(`${site}/web/npm/examples`).filter((name) =>
  name.endsWith(".mjs.html"),
);
check(allPrograms.length >= 6, `${allPrograms.length} programs`);
// lockstep compares both builds of the package, of which ./test makes one.
const thereIsPlain = existsSync(new URL("../../build/web/plain.wasm.gz", import.meta.url));
const programs = allPrograms.filter((name) => thereIsPlain || !name.startsWith("lockstep."));
if (!thereIsPlain)
  console.log("without lockstep.mjs: the package was made without the build plain");

const browser = await chromium.launch({ executablePath, args: ["--no-sandbox"] });
const elsewhere = [];
const open = async (width) => {
  const page = await browser.newPage({ viewport: { width, height: 850 } });
  page.on(
    "request",
    (request) =>
      /^https?:\/\/(?!127\.0\.0\.1[:/])/.test(request.url()) && elsewhere.push(request.url()),
  );
  return page;
};
for (const width of [1300, 390]) {
  const page = await open(width);
  const errors = [];
  page.on("pageerror", (error) => errors.push(error.message));
  for (const name of PAGES) {
    await page.goto(`file://${site}/${name}`);
    const wide = await page.evaluate(() => document.documentElement.scrollWidth);
    check(wide <= width, `${name} is ${wide} pixels wide on a screen of ${width}`);
    if (pictures)
      await page.screenshot({ path: `${pictures}/${name.replaceAll("/", "-")}-${width}.png` });
  }
  check(errors.length === 0, errors.join("\n"));
  await page.close();
}

const page = await open(1300);
for (const name of programs) {
  await page.goto(`file://${site}/web/npm/examples/${name}`);
  await page.click("#live-run");
  const output = page.locator("#live-output:is([data-state=done], [data-state=failed])");
  await output.waitFor({ timeout: 60000 });
  const text = (await output.textContent()).trim();
  check(
    (await output.getAttribute("data-state")) === "done" && text.length > 20,
    `${name}: ${text}`,
  );
  if (name.startsWith("break_paths"))
    check((await page.locator("#live-output ~ img").count()) === 1, `${name} shows no picture`);
  if (pictures) await page.screenshot({ path: `${pictures}/live-${name}.png`, fullPage: true });
}

// A changed program runs as it was changed, and one that fails says so.
const code = page.locator(".language-js code");
await code.evaluate(
  (element) =>
    (element.textContent =
      'import { load } from "carom";\nconsole.log((await load()).table("9ft").width);\nthrow new Error("as asked");'),
);
await page.click("#live-run");
await page.waitForSelector("#live-output[data-state=failed]");
check(
  (await page.textContent("#live-output")) === "1.27\nError: as asked\n",
  await page.textContent("#live-output"),
);

// The search wants a server.
const TYPES = {
  ".html": "text/html",
  ".js": "text/javascript",
  ".css": "text/css",
  ".json": "application/json",
};
const server = createServer((request, answer) => {
  const path = `${site}${new URL(request.url, "http://site").pathname}`;
  answer.writeHead(existsSync(path) ? 200 : 404, {
    "content-type": TYPES[extname(path)] ?? "application/octet-stream",
  });
  if (existsSync(path)) createReadStream(path).pipe(answer);
  else answer.end();
});
await new Promise((listening) => server.listen(0, "127.0.0.1", listening));
const search = async (words) => {
  const [word] = words.split(" ");
  await page.goto(`http://127.0.0.1:${server.address().port}/index.html`);
  await page.locator("input.md-search__input").pressSequentially(words);
  const found = page.locator(`.md-search-result__link[href*="${word}" i]`);
  await found.first().waitFor({ timeout: 30000, state: "attached" });
  return page
    .locator(".md-search-result__link")
    .evaluateAll((links) => links.map((link) => link.getAttribute("href")));
};
check((await search("squirt")).length >= 3, "the search for 'squirt' finds less than three pages");
for (const words of ["ten kernels", "seed paper", "Mathavan"]) {
  const [first] = await search(words);
  check(/docs\/study\/paper/.test(first), `the search for '${words}' finds ${first} first`);
}

// Formulas are typeset.
await page.goto(`http://127.0.0.1:${server.address().port}/docs/understanding/physics.html`);
await page.waitForSelector(".katex", { timeout: 30000 });
check(
  (await page.locator(".arithmatex:not(:has(.katex))").count()) === 0 &&
    (await page.locator(".katex-error").count()) === 0,
  "a formula is not typeset",
);

// On paper: the text only, with lines that fit.
await page.goto(`file://${site}/docs/using/python.html`);
await page.emulateMedia({ media: "print" });
for (const part of [".md-header", ".md-sidebar--primary", ".md-footer"])
  check(!(await page.locator(part).isVisible()), `${part} would be printed`);
const cut = await page.evaluate(
  () =>
    [...document.querySelectorAll("pre code")].filter(
      (block) => block.scrollWidth > block.clientWidth + 1,
    ).length,
);
check(cut === 0, `${cut} blocks of code are cut off on paper`);
if (pictures) await page.pdf({ path: `${pictures}/python.pdf`, format: "A4" });
check(elsewhere.length === 0, `asked from other servers: ${elsewhere.join(" ")}`);
await browser.close();
server.close();
console.log(
  `${PAGES.length} pages at two widths, ${programs.length} programs in their pages, search and paper`,
);
