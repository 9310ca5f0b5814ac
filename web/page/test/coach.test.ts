// The coach and the view in three dimensions, in a browser.
import { expect, test } from "vitest";
import type { Page } from "playwright-core";
import {
  act,
  boxOf,
  comesToSay,
  counts,
  describePages,
  dragMouse,
  fingersOn,
  gameOf,
  keptGame,
  keptSetup,
  linesOf,
  numberIn,
  pages,
  PHONE,
  pictureOf,
  says,
  shows,
  violations,
} from "./page.js";

/** Hides what lies over the scene, for a picture of the scene alone, or shows it again. */
const hideChrome = (page: Page, isHidden: boolean) =>
  page.evaluate((isHidden) => {
    const parts = document.querySelectorAll<HTMLElement>(".play > :not(.felt)");
    for (const part of Array.from(parts)) part.style.visibility = isHidden ? "hidden" : "";
  }, isHidden);

describePages("beside the game", () => {
  const { open, click, colour, frames, text, turnTo } = pages();

  test("the coach tells chances before a stroke, what it cost after it, and keeps a log to print", async () => {
    // A straight pot, and the nine for the game.
    const page = await open(
      "",
      PHONE,
      gameOf("nineball", "person", "0.635,1.2 0.3,2.2 in in in in in in in 0.9,1.9"),
    );
    await act(page, "#new-game", "#coach=on", "#rate=1000", "#menu .close", "#hint");
    await comesToSay(
      page,
      "said",
      /^Hint: ball [19] into the .*\. An unrated player \(\d+\) keeps the turn \d+ % of the time, wins the game \d+ %, fouls \d+ %\. Played now, it gets the errors of that rating\./,
    );
    // The run-out behind it, whose landing zone is drawn.
    const cloth = async () => (await page.locator("#table-scene").screenshot()).toString("base64");
    const hinted = await cloth();
    await comesToSay(
      page,
      "said",
      /Run-out: ball 1 into the .*, ball 9 into the .*\. It works \d+ % of the time\.$/,
    );
    expect(await cloth()).not.toBe(hinted);
    // A stroke that meets nothing: a foul, which the chances and the review tell.
    await turnTo(page, 200);
    await act(page, "#power=0.6");
    await comesToSay(
      page,
      "said",
      /^This shot: An unrated player \(\d+\) keeps the turn 0 % of the time, wins the game \d+ %, fouls 100 %\.$/,
    );
    await act(page, "#shoot");
    await comesToSay(
      page,
      "said",
      /^Player 1 potted nothing\. That shot wins \d+ % of the time; the best one, .*, \d+ %\. It cost \d+ %\. Your chance to win was \d+ % before that shot, and is \d+ % after it\.( It (cost|gained) \d+ %\.)?$/,
    );
    await act(page, "#new-game", "#open-log");
    await counts(page, "#log tbody tr", 1);
    await says(page, "log-sum", /^1 shot\. A shot cost [1-9]\d* % of a game/);
    expect(await violations(page)).toEqual([]);
    // On paper there is the log alone.
    await page.emulateMedia({ media: "print" });
    await shows(page, "#table-scene", false);
    await shows(page, "#log table");
  });

  test("the coach finds safeties, leaves and breaks, and tells odds and what one misses", async () => {
    const lay = "0.635,1.2 0.3,2.2 in in 0.9,0.6 in in in in 0.9,1.9";
    const page = await open("", PHONE, gameOf("nineball", "person", lay));
    const ask = async (...steps: string[]) => act(page, "#coach-menu", ...steps);
    // A question ends the search of the one before.
    await act(page, "#hint");
    await ask("#ask-safety");
    await comesToSay(
      page,
      "said",
      /^Hint: a safety, .* wins the game \d+ %.* Also shown: 2 wins \d+ %.* Tap a number/,
    );
    await ask("#ask-hidden");
    await comesToSay(
      page,
      "said",
      /^Hint: .* leaves the cue ball hidden \d+ % of the time, fouls \d+ %/,
    );
    await ask("#snooker-on=4", "#ask-snooker");
    await comesToSay(page, "said", /^Hint: .* leaves a snooker on ball 4 \d+ % of the time/);

    // A place is tapped, or aimed at with the keys; a ring shows it.
    const near = /leaves the cue ball within 20 cm of the spot [1-9]\d* %/;
    await ask("#ask-near");
    await says(page, "said", /^Tap the spot/);
    await click(page, 0.635, 1.7, true);
    await comesToSay(page, "said", near);
    const [red, , blue] = await colour(page, 0.835, 1.7, 5);
    expect(red! - blue!).toBeGreaterThan(60);
    await ask("#ask-near");
    await page.keyboard.press("Enter");
    await comesToSay(page, "said", /leaves the cue ball within 20 cm/);
    await says(page, "turn", /^Player 1's turn/);

    // What a stroke cost: an aim at the 1 that is too far off the hint to be the hint's.
    await act(page, "#hint");
    await comesToSay(page, "said", /^Hint: ball 1 into/);
    await turnTo(page, (await numberIn(page, "phi")) + 2.5);
    await act(page, "#shoot", "#skip");
    await comesToSay(page, "turn", /^Player 2's turn/);
    const rows = () => page.evaluate(() => localStorage.getItem("carom-reviews") ?? "");
    await expect.poll(rows).toContain('"strokes":1');
    await act(page, "#coach-menu");
    const [, strokes, kept, , misses] = await page.locator("#reviews td").allTextContents();
    expect([strokes, kept]).toEqual(["1", "0 %"]);
    expect(parseFloat(misses!)).toBeGreaterThan(0);

    // The odds are those of the library.
    await act(page, "#odds-against=400", "#odds-games=1");
    const said = await text(page, "odds-said");
    const [, rating, game, match] =
      /for a (\d+),.* you win (\d+) % of games and (\d+) % of matches/.exec(said)!;
    const chance = 1 / (1 + 2 ** ((400 - Number(rating)) / 100));
    expect([game, match]).toEqual([0, 0].map(() => (100 * chance).toFixed(0)));
    expect(await violations(page)).toEqual([]);
    await act(page, "#reviews button");
    await shows(page, "#undo-stroke");
    const { at } = await keptSetup<{ at: string }>(page);
    expect(at).toBe(lay);
  });

  test("the coach's break is aimed from behind the line, and told with its costs", async () => {
    const page = await open("", {}, gameOf("nineball", "500", undefined, "600"));
    await act(page, "#coach-menu");
    await shows(page, "#ask-safety", false);
    await act(page, "#ask-break");
    await comesToSay(
      page,
      "said",
      /^The best break is aimed, at \d\.\d m\/s.* wins \d+\.\d % of games with it \(± \d\.\d %\), .* in tip position -?\d\.\d %\.$/,
    );
    await act(page, "#shoot", "#skip");
    const places = linesOf<{ at?: [number, number] }>(await keptGame(page), "place");
    // The rules refuse a place beyond the line.
    const at = places.find((row) => row.at !== undefined)!.at;
    expect(at).not.toEqual([0.635, 0.635]);
  });

  test("the view from behind the cue starts when it is asked for, and shows the balls as they roll", async () => {
    const page = await open("");
    await counts(page, "#scene", 0);
    await act(page, "#space");
    await page.locator("#scene").waitFor();
    expect(await violations(page)).toEqual([]);
    // What is seen changes with the aim and with the balls.
    const seen = async () => (await page.locator("#scene").screenshot()).toString("base64");
    const initial = await seen();
    const box = await boxOf(page, "#scene");
    await dragMouse(page, [box.x + 100, box.y + 100], [box.x + 150, box.y + 100]);
    expect(await numberIn(page, "phi")).toBeCloseTo(90 - 4, 0);
    const turned = await seen();
    expect(turned).not.toBe(initial);
    await act(page, "#shoot");
    await expect.poll(seen).not.toBe(turned);
    await act(page, "#space");
    await counts(page, "#scene", 0);
    await shows(page, "#table-scene");
  });

  test("behind the cue the table fills the view of a phone, the aim is on the cloth, and balls have their numbers", async () => {
    // The 1 lies before the camera, its number up.
    const page = await open(
      "",
      PHONE,
      gameOf("nineball", "person", "0.635,0.635 0.75,0.4 in in in in in in in in"),
    );
    await turnTo(page, 90);
    await act(page, "#new-game", "#numbers=on", "#menu .close", "#space");
    await page.locator("#scene").waitFor();
    expect(await violations(page)).toEqual([]);
    await hideChrome(page, true);
    const { width, height, bytes } = await pictureOf(page, "#scene");
    /** The places in a rectangle whose colour is so. */
    const where = (
      [x0, y0, x1, y1]: readonly number[],
      is: (r: number, g: number, b: number) => boolean,
    ) =>
      Array.from(
        { length: (y1! - y0!) * (x1! - x0!) },
        (_, k) => [x0! + (k % (x1! - x0!)), y0! + Math.floor(k / (x1! - x0!))] as [number, number],
      ).filter(([x, y]) =>
        is(
          ...([...bytes.subarray(4 * (width * y + x), 4 * (width * y + x) + 3)] as [
            number,
            number,
            number,
          ]),
        ),
      );
    // Its number is beside it, too.
    expect(
      await page.locator(".over-scene").evaluate(
        (over: HTMLCanvasElement) =>
          over
            .getContext("2d")!
            .getImageData(0, 0, over.width, over.height)
            .data.filter((byte) => byte > 250).length,
      ),
    ).toBeGreaterThan(20);
    // Of the room around the table there is little.
    const room =
      where([0, 0, width, height], (r, g, b) => Math.max(r, g, b) < 34).length / (width * height);
    expect(room).toBeLessThan(0.3);
    // The aim: a light line before the cue ball, which is in the middle, to the far cushion.
    const middle = Math.round(width / 2);
    const line = where(
      [middle - 3, Math.round(0.15 * height), middle + 3, Math.round(0.5 * height)],
      (r, g, b) => Math.min(r, g, b) > 80,
    );
    expect(new Set(line.map(([, y]) => y)).size).toBeGreaterThan(0.2 * height);
    // The number: dark on white in the upper half of the yellow ball; its shadow is below.
    const yellow = where([0, 0, width, height], (r, g, b) => r > 120 && g > 80 && b < 0.3 * g);
    const xs = yellow.map(([x]) => x);
    const ys = yellow.map(([, y]) => y);
    const left = Math.min(...xs);
    const right = Math.max(...xs);
    const bottom = Math.max(...ys);
    // The white around its number is at the upper rim.
    const top = bottom - (right - left);
    console.log(
      `behind the cue: ${(100 * room).toFixed(0)} % of the view is room; the 1 has ${right - left + 1} x ${bottom - top + 1} pixels`,
    );
    const upper = [
      left + Math.round((right - left) / 4),
      top,
      right - Math.round((right - left) / 4),
      Math.round((top + bottom) / 2),
    ];
    expect(where(upper, (r, g, b) => Math.min(r, g, b) > 150).length).toBeGreaterThan(8);
    expect(
      where(
        upper,
        (r, g, b) => Math.max(r, g, b) < 200 && Math.max(r, g, b) - Math.min(r, g, b) < 40,
      ).length,
    ).toBeGreaterThan(3);
  });

  test("behind the cue a finger calls another pocket, and moves the cue ball that is in hand", async () => {
    const page = await open(
      "",
      PHONE,
      gameOf(
        "eightball",
        "person",
        "0.635,0.6 0.635,1.6 in in in in in in 1.0,2.0 0.3,0.5 in in in in in in",
      ),
    );
    await turnTo(page, 88.5);
    await act(page, "#space");
    await page.locator("#scene").waitFor();
    const box = await boxOf(page, "#scene");
    /** Where the view has marks: what is called, or in hand. */
    const marks = async () => {
      await hideChrome(page, true);
      const { width, height, bytes } = await pictureOf(page, "#scene");
      await hideChrome(page, false);
      return Array.from({ length: width * height }, (_, k) => k)
        .filter(
          (k) =>
            bytes[4 * k]! > 247 &&
            Math.abs(bytes[4 * k + 1]! - 226) < 9 &&
            Math.abs(bytes[4 * k + 2]! - 138) < 14,
        )
        .map((k) => `${k % width},${Math.floor(k / width)}`);
    };
    const middle = (marks: string[]) =>
      [0, 1].map(
        (c) => marks.reduce((sum, mark) => sum + Number(mark.split(",")[c]), 0) / marks.length,
      ) as [number, number];
    const next = async (pocket: string) => {
      for (let k = 0; k < 6 && !(await text(page, "turn")).includes(pocket); k++) {
        await page.locator("#scene").press("c");
        await frames(page);
      }
    };
    await comesToSay(page, "turn", /Call: the 1, /);
    await next("foot-right");
    const initial = await marks();
    await next("foot-left");
    const [x, y] = middle((await marks()).filter((mark) => !initial.includes(mark)));
    await next("foot-right");
    await page.touchscreen.tap(box.x + x, box.y + y);
    await comesToSay(page, "turn", /Call: the 1, foot-left pocket\./);
    // A foul, and the cue ball in hand.
    await turnTo(page, 200);
    await act(page, "#power=0.4", "#shoot", "#skip");
    await comesToSay(page, "turn", /Ball in hand: drag the cue ball/);
    // The mark that is nearest to whoever aims.
    const seenMarks = await marks();
    const start = middle(
      seenMarks.filter(
        (place) =>
          Number(place.split(",")[1]) >
          Math.max(...seenMarks.map((place) => Number(place.split(",")[1]))) - 40,
      ),
    );
    const touch = await fingersOn(page);
    const startX = box.x + start[0];
    const startY = box.y + start[1];
    await touch("Start", [[startX, startY]]);
    for (let k = 10; k <= 60; k += 10) await touch("Move", [[startX + k, startY]]);
    await touch("End");
    await act(page, "#shoot");
    const places = linesOf<{ at?: [number, number] }>(await keptGame(page), "place");
    const put = places.filter((row) => row.at !== undefined);
    // It lay on the head spot.
    expect(put).toHaveLength(1);
    expect(put[0]!.at).not.toEqual([0.635, 0.635]);
  });

  test("without WebGL the flat view stays, and the page says why", async () => {
    const page = await open("");
    await page.evaluate(() => {
      const get = HTMLCanvasElement.prototype.getContext as (
        this: HTMLCanvasElement,
        kind: string,
        ...rest: unknown[]
      ) => unknown;
      HTMLCanvasElement.prototype.getContext = function (
        this: HTMLCanvasElement,
        kind: string,
        ...rest: unknown[]
      ) {
        return kind === "webgl2" ? null : get.call(this, kind, ...rest);
      } as typeof HTMLCanvasElement.prototype.getContext;
    });
    await act(page, "#space");
    await comesToSay(page, "said", "This browser cannot show 3D (it has no WebGL 2).");
    await shows(page, "#table-scene");
  });
});
