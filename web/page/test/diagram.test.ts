// Diagrams in a browser: what they draw, what is printed, and links that keep all of it.
import { readFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { deflateRawSync, inflateRawSync } from "node:zlib";
import { expect, test } from "vitest";
import type { Page } from "playwright-core";
import { WOOD } from "../../player/table.js";
import {
  act,
  boxOf,
  comesToSay,
  comesToShow,
  describePages,
  gameOf,
  keptGame,
  keptLines,
  pages,
  says,
  shows,
  sizes,
  valueOf,
  violations,
} from "./page.js";

describePages("a diagram", () => {
  const { open, text, turnTo } = pages();
  const picture = (page: Page) =>
    page.locator("#diagram-scene").evaluate((canvas: HTMLCanvasElement) => canvas.toDataURL());
  async function opened(page: Page): Promise<void> {
    await act(page, "#new-game", "#open-diagram");
  }
  const resume = (game: object, how: object) => open("", how, game);
  const PRACTICE = {
    game: "eightball",
    against: "practice",
    own: "0",
    seed: 1,
    at: "0.4,0.6 0.635,1.27 0.9,1.9 in in in in in 1.0,2.2 in in in in in in in",
  };
  const NOTES = "Stop the cue ball.\n<b>Aim</b> at the left half & wait.";

  test.each(sizes)(
    "balls before and after a stroke, its path and notes are printed, and a link keeps them: %s",
    async (_, how) => {
      const page = await resume(PRACTICE, how);
      await turnTo(page, 70);
      await act(page, "#power=3");
      await opened(page);
      expect(await page.locator("#diagram-which option").allTextContents()).toEqual([
        "the shot as aimed",
        "the balls as they lie",
      ]);
      await says(
        page,
        "diagram-words",
        "Eight-ball. Cue: 3.0 m/s, direction 70.00°, tip in the centre.",
      );
      // Each choice draws something else.
      const drawn = [await picture(page)];
      await act(page, "#diagram-path=off");
      drawn.push(await picture(page));
      await act(page, "#diagram-after=on");
      drawn.push(await picture(page));
      await act(page, "#diagram-path=on");
      drawn.push(await picture(page));
      expect(new Set(drawn).size).toBe(4);
      expect(await violations(page)).toEqual([]);
      await page.locator("#notes").fill(NOTES);
      await act(page, "#link-diagram");
      await comesToSay(page, "diagram-said", "Link to this diagram copied.");
      const link = await page.evaluate(() => navigator.clipboard.readText());

      // On paper there are the table as wide as it is on the screen or wider, the words and the
      // notes, and nothing to press.
      await page.emulateMedia({ media: "print" });
      for (const [what, is] of [
        ["#diagram-scene", true],
        ["#diagram-words", true],
        ["#diagram .on-paper", true],
        ["#notes", false],
        ["#print-diagram", false],
        ["#table-scene", false],
        ["header", false],
      ] as const)
        expect(await page.locator(what).isVisible(), what).toBe(is);
      expect(await page.locator("#diagram .on-paper").textContent()).toBe(NOTES);
      const box = await boxOf(page, "#diagram-scene");
      const long = Math.max(box.width, box.height);
      const short = Math.min(box.width, box.height);
      expect(long / short).toBeCloseTo((2.54 + 2 * WOOD) / (1.27 + 2 * WOOD), 1);
      const pdf = `${tmpdir()}/carom-diagram-${process.pid}.pdf`;
      await page.pdf({ path: pdf });
      expect(readFileSync(pdf, "latin1").match(/\/Type \/Page\b/g)).toHaveLength(1);
      await page.emulateMedia({ media: "screen" });

      // Another page shows the same, and keeps the game that it had.
      const secondPage = await open("", how);
      const game = await keptGame(secondPage);
      await secondPage.evaluate((hash) => (location.hash = hash), new URL(link).hash);
      await comesToShow(secondPage, "#diagram");
      expect(await valueOf(secondPage, "notes")).toBe(NOTES);
      await says(secondPage, "diagram-words", await text(page, "diagram-words"));
      expect(await secondPage.locator("#diagram-after").isChecked()).toBe(true);
      await expect.poll(() => picture(secondPage)).toBe(await picture(page));
      await shows(secondPage, "#diagram-which", false);
      await act(secondPage, "#diagram .close");
      await expect.poll(() => secondPage.evaluate(() => location.hash)).toBe("#view=play");
      expect(await keptGame(secondPage)).toBe(game);
    },
  );

  test("in a game it shows the last stroke, and never where the aim leads", async () => {
    const page = await resume(
      gameOf("nineball", "person", "0.635,0.635 0.3,1.9 in in in in in in in 0.9,1.9"),
      {},
    );
    await opened(page);
    await says(page, "diagram-words", "Nine-ball. ");
    await shows(page, "#diagram-path", false);
    const lie = await picture(page);
    await act(page, "#diagram .close", "#new-game", "#rate=1000", "#menu .close", "#shoot");
    await comesToShow(page, "#skip", false);
    await opened(page);
    expect(await page.locator("#diagram-which option").allTextContents()).toEqual([
      "the last shot",
      "the balls as they lie",
    ]);
    await says(page, "diagram-words", /^Nine-ball\. Cue: 2\.5 m\/s/);
    expect(await picture(page)).not.toBe(lie);
  });

  test("it strikes the cue ball of the player, who in games of carom has an own one", async () => {
    const page = await resume({ game: "threecushion", against: "person", own: "0", seed: 1 }, {});
    await act(page, "#new-game", "#rate=1000", "#menu .close");
    const strokes = async () =>
      (await keptLines(page)).filter((line) => line.startsWith('{"shot"'));
    // Soft strokes miss, so that the turn passes.
    for (const [count, ball] of [
      [1, undefined],
      [2, 1],
    ] as const) {
      await act(page, "#power=0.5", "#shoot");
      await expect.poll(async () => (await strokes()).length).toBe(count);
      await comesToShow(page, "#skip", false);
      const [shot] = (await strokes()).slice(-1);
      expect((JSON.parse(shot!) as { shot: { ball?: number } }).shot.ball).toBe(ball);
    }
    await opened(page);
    await act(page, "#link-diagram");
    await comesToSay(page, "diagram-said", "Link to this diagram copied.");
    const drawn = await picture(page);
    const link = new URL(await page.evaluate(() => navigator.clipboard.readText())).hash;
    const secondPage = await open(link);
    await comesToShow(secondPage, "#diagram");
    await expect.poll(() => picture(secondPage)).toBe(drawn);
    // The same stroke of the white is drawn otherwise.
    const packed = new URLSearchParams(link.slice(1)).get("d")!;
    const sent = JSON.parse(inflateRawSync(Buffer.from(packed, "base64url")).toString()) as object;
    expect(sent).toMatchObject({ ball: 1 });
    const white = deflateRawSync(JSON.stringify({ ...sent, ball: 0 })).toString("base64url");
    await secondPage.evaluate((d) => (location.hash = `#view=play&d=${d}`), white);
    await expect.poll(() => picture(secondPage)).not.toBe(drawn);
  });

  test("a link that is damaged or changed is refused, and says why", async () => {
    const page = await open("");
    const packed = (text: string) =>
      page.evaluate(async (text) => {
        const bytes = new Uint8Array(
          await new Response(
            new Blob([text]).stream().pipeThrough(new CompressionStream("deflate-raw")),
          ).arrayBuffer(),
        );
        return btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join(""))
          .replaceAll("+", "-")
          .replaceAll("/", "_")
          .replace(/=+$/, "");
      }, text);
    const good = { game: PRACTICE.game, at: PRACTICE.at, cue: [3, 70, 0, 0, 0], notes: "" };
    for (const [d, why] of [
      [(await packed(JSON.stringify(good))).slice(0, -9), "the link is incomplete or damaged"],
      [
        await packed(JSON.stringify({ ...good, game: "chess" })),
        'game: no such game "chess"; New game lists all games',
      ],
      [
        await packed(JSON.stringify({ ...good, at: "0.5,0.5" })),
        'at: "0.5,0.5" is not 16 positions; give x,y in metres',
      ],
      [
        await packed(JSON.stringify({ ...good, cue: [3, 70] })),
        "cue: [3,70] is not 5 numbers; give speed, direction, ",
      ],
      [await packed(JSON.stringify({ ...good, ball: 0.5 })), "ball: 0.5 is not a whole number"],
      [await packed(JSON.stringify({ ...good, ball: 99 })), "the shot cannot be played: "],
      [
        await packed(JSON.stringify({ ...good, cue: [3, 70, 0, 0, 95] })),
        "the shot cannot be played: ",
      ],
      [
        await packed(JSON.stringify({ ...good, notes: 1 })),
        "notes, at: not text; both must be text in quotes",
      ],
    ] as const) {
      await page.evaluate((d) => (location.hash = `#view=play&d=${d}`), d);
      await expect.poll(() => text(page, "said")).toContain(`The diagram was not opened: ${why}`);
      await shows(page, "#diagram", false);
    }
  });
});
