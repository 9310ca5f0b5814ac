// The laboratory and the view of collisions, in a browser. Numbers are compared with the command
// `carom`.
import { readFileSync } from "node:fs";
import { expect, test } from "vitest";
import { toLine } from "carom";
import { CUSHION, WOOD } from "../../player/table.js";
import {
  act,
  boxOf,
  comesToSay,
  describePages,
  dragMouse,
  numberIn,
  pages,
  PHONE,
  says,
  shows,
  sizes,
  valueOf,
} from "./page.js";
import { carom } from "../../test/builds.js";
import { root, run, thereIsACommand } from "../../test/support.js";

describePages("the laboratory", () => {
  const { open, pixelOf, drag, click, lies, colour, text, set, frames } = pages();

  test.runIf(thereIsACommand)(
    "sliders of a collision give the command's throw, deflection and speeds",
    async () => {
      const page = await open("#view=collision");
      for (const [speed, cut, side, tip] of [
        [1.5, 30, 0, 0.4],
        [3.2, -42.5, 0.31, -0.2],
        [0.7, 15, -0.5, 0],
      ] as const) {
        await act(page, `#speed=${speed}`, `#cut=${cut}`, `#side=${side}`, `#tip=${tip}`);
        const spin = `${(2.5 * speed * tip) / 0.028575}rad/s`;
        const english = `${(2.5 * speed * side) / 0.028575}rad/s`;
        const output = run([
          "hit",
          "--speed",
          String(speed),
          "--cut",
          String(cut),
          `--spin=${spin}`,
          `--side=${english}`,
          "--friction",
          "alciatore",
          "--csv",
        ]);
        const derived = run(["resolve", "--derived", "-"], output)
          .trim()
          .split("\n")
          .map((line) => line.split(","));
        const number = (column: string) => Number(derived[1]![derived[0]!.indexOf(column)]);
        const v = (ball: number): [number, number] => [number(`v${ball}x`), number(`v${ball}y`)];
        const angle = ([x, y]: [number, number]) =>
          `${Math.abs((Math.atan2(y, x) * 180) / Math.PI).toFixed(2)}° ${y > 0 ? "left" : "right"}`;
        const speedOf = ([x, y]: [number, number]) => `${Math.hypot(x, y).toFixed(3)} m/s`;
        await says(page, "n-object", `${angle(v(2))}, ${speedOf(v(2))}`);
        await says(page, "n-deflection", `${angle(v(1))}, ${speedOf(v(1))}`);
        const thrown = (Math.atan2(v(2)[1], v(2)[0]) * 180) / Math.PI - cut;
        await says(
          page,
          "n-throw",
          `${Math.abs(thrown).toFixed(2)}° ${thrown > 0 ? "left" : "right"}`,
        );
        await says(page, "n-spin", `${number("w2z").toFixed(2)} rad/s`);
      }
    },
  );

  test("dragging the cue ball, keys and the address", async () => {
    const page = await open("#view=collision&speed=2&cut=10");
    expect(await valueOf(page, "speed")).toBe("2");
    expect(await valueOf(page, "cut")).toBe("10");
    const scene = page.locator("#collision-scene");
    const box = (await scene.boundingBox())!;
    await dragMouse(
      page,
      [box.x + box.width * 0.4, box.y + box.height * 0.5],
      [box.x + box.width * 0.5 - 100, box.y + box.height * 0.5 + 100],
      5,
    );
    expect(await valueOf(page, "cut")).toBe("45");
    await scene.press("ArrowRight");
    expect(await valueOf(page, "cut")).toBe("45.5");
    const exact = await text(page, "n-throw");
    await act(page, "#solver=euler");
    await says(page, "n-stick", /unknown/);
    expect(parseFloat(await text(page, "n-throw"))).toBeCloseTo(parseFloat(exact), 1);
    await page.waitForURL(/view=collision&speed=2&cut=45.5&solver=euler/);
  });

  test.runIf(thereIsACommand)(
    "a break plays to its end, with the command's final state",
    async () => {
      const page = await open("#view=lab&phi=89.3&right=-0.1");
      await act(page, "main summary", "#export");
      const line = await valueOf(page, "line");
      const played = JSON.parse(run(["shoot", "-"], line)) as {
        status: string;
        events: unknown[][];
        final: { t: number; balls: Record<string, number[]> };
      };
      await says(page, "s-status", played.status);
      await says(page, "s-time", `${played.final.t.toFixed(3)} s`);
      await says(
        page,
        "s-count",
        String(played.events.filter(([, type]) => type !== "none").length),
      );
      const cue = played.final.balls.cue!;
      await says(
        page,
        "s-cue-ball",
        cue[0] === 4 ? "in a pocket" : `${cue[1]!.toFixed(4)}, ${cue[2]!.toFixed(4)} m`,
      );
      const fell = Object.entries(played.final.balls)
        .filter(([, state]) => state[0] === 4)
        .map(([name]) => name);
      await says(page, "s-pocketed", fell.join(", ") || "none");
      // The film, from some time before its end, so that a busy machine does not miss it.
      await set(page, "time", Math.floor(1000 * (played.final.t - 3)) / 1000);
      await act(page, "#play");
      await says(page, "play", "Pause");
      await comesToSay(page, "play", "Play");
      expect(await numberIn(page, "time")).toBeCloseTo(played.final.t, 2);
      expect(await page.locator('.events li[aria-current="true"] + li').count()).toBe(0);
      // From event to event.
      await page.locator(".events button").first().click();
      await act(page, "#forward");
      expect(await numberIn(page, "time")).toBeCloseTo(
        Number(await text(page, "s-contact").then((t) => t.match(/after ([\d.]+)/)![1])),
        2,
      );
      await act(page, "#back");
      expect(await numberIn(page, "time")).toBe(0);
    },
  );

  test("a line is read back, and a bad one is refused with its key", async () => {
    const page = await open("#view=lab");
    await act(page, "main summary");
    await page.locator("#line").fill(readFileSync(`${root}data/break-nineball.jsonl`, "utf8"));
    await act(page, "#import");
    await says(page, "message", "");
    expect(await valueOf(page, "speed")).toBe("9");
    if (thereIsACommand) {
      const played = JSON.parse(
        run(["shoot", "--events", "none", `${root}data/break-nineball.jsonl`]),
      ) as { final: { t: number; balls: Record<string, number[]> } };
      const [, x, y] = played.final.balls.cue!;
      await says(page, "s-time", `${played.final.t.toFixed(3)} s`);
      await says(page, "s-cue-ball", `${x!.toFixed(4)}, ${y!.toFixed(4)} m`);
      // The address has the whole shot.
      await page.waitForURL(/line=/);
      const reopened = await open(new URL(page.url()).hash);
      await says(reopened, "s-time", `${played.final.t.toFixed(3)} s`);
      await reopened.close();
    }
    await page.locator("#line").fill('{"kind": "shot", "table": "9ft", "balls": []}');
    await act(page, "#import");
    await says(page, "message", /balls: /);
  });

  test.runIf(thereIsACommand)(
    "an imported layout has its balls by their numbers, in the game that its file or the page names",
    async () => {
      const places: Record<string, [number, number]> = {
        cue: [0.4, 0.9],
        5: [0.3, 1.9],
        2: [0.9, 1.7],
        9: [0.7, 0.5],
        8: [1.0, 1.1],
        12: [0.2, 0.4],
      };
      const fileOf = (...names: string[]) =>
        toLine({
          id: "a layout",
          tableName: "9ft",
          names,
          balls: names.map((name) => carom.ball(...places[name]!)),
          cue: carom.cue({ speed: 2 }),
        });
      const page = await open("#view=lab");
      await act(page, "main summary");
      const take = async (game: string, line: string) => {
        await act(page, `#game=${game}`);
        await page.locator("#line").fill(line);
        await act(page, "#import");
      };
      const nine = fileOf("cue", "5", "2", "9");
      await take("nineball", nine);
      await says(page, "message", "");
      // Ball 12 is of eight-ball alone, and without ball 9 there is no nine-ball.
      for (const line of [fileOf("cue", "5", "12", "8", "9"), fileOf("cue", "8", "2")]) {
        await take("nineball", line);
        expect(await valueOf(page, "game")).toBe("eightball");
        await says(page, "message", "");
      }
      // Two games fit: the one that was chosen, which the page says, or none.
      const both = fileOf("cue", "8", "9", "2");
      await take("eightball", both);
      await says(
        page,
        "message",
        "Read as Eight-ball. If the balls are for Nine-ball, choose that game and import again.",
      );
      await take("nineball", both);
      await says(page, "message", /^Read as Nine-ball/);
      await take("eightball", both.replace("a layout", "nineball"));
      expect(await valueOf(page, "game")).toBe("nineball");
      await take("snooker", both);
      await says(
        page,
        "message",
        "balls: they fit Nine-ball and Eight-ball; choose one of these games and import again",
      );
      // Neither: it can be played.
      await take("nineball", fileOf("cue", "5", "2"));
      await says(page, "message", "");
    },
  );

  test("aiming: a drag on the cloth, the cue ball moved, every game", async () => {
    const page = await open("#view=lab&game=eightball");
    const box = await boxOf(page, "#table-scene");
    await page.mouse.move(box.x + box.width * 0.7, box.y + box.height * 0.3);
    await page.mouse.down();
    for (let k = 0; k < 60; k++)
      await page.mouse.move(box.x + box.width * 0.7, box.y + box.height * (0.3 + 0.005 * k));
    console.log(`an eight-ball break is aimed: ${await text(page, "cost")}`);
    await page.mouse.up();
    expect(await valueOf(page, "phi")).not.toBe("90");
    for (const game of ["nineball", "snooker", "threecushion"]) {
      await act(page, `#game=${game}`);
      await says(page, "s-status", "ok");
      expect(Number(await text(page, "s-count"))).toBeGreaterThan(5);
    }
    const cushions = (
      JSON.parse(readFileSync(`${root}build/web/rows.json`, "utf8")) as {
        words: Record<string, [string, string][]>;
      }
    ).words.CUSHION_MODEL!;
    expect(await page.locator("#cushion option").allTextContents()).toHaveLength(cushions.length);
    for (const [cushion] of cushions) {
      await act(page, `#cushion=${cushion}`);
      await says(page, "s-status", "ok");
    }
    await act(page, "#solver=euler");
    await says(page, "s-status", "ok");
  });

  test("cushions play the constants that the game has for them, and say so where there are none", async () => {
    const table = carom.table("threecushion");
    const page = await open("#view=lab&game=threecushion&speed=4&phi=62");
    for (const cushionModel of ["han", "smooth", "mathavan"] as const) {
      await act(page, `#cushion=${cushionModel}`);
      const kind = carom.kind("billiard", cushionModel);
      const balls = carom.rack("threecushion", table).map(({ state }) => ({ kind, state }));
      const shot = carom.simulate(
        table,
        balls,
        carom.cue({ speed: 4, phi: 62, b: 0.25 }, "billiard"),
        { cushionModel },
      );
      expect(await text(page, "s-cue-ball"), cushionModel).toBe(
        `${shot.final[0]!.r[0].toFixed(4)}, ${shot.final[0]!.r[1].toFixed(4)} m`,
      );
      await says(page, "message", "");
    }
    await act(page, "#game=snooker", "#cushion=stronge");
    expect(await page.locator("#message").textContent()).toContain(
      'snooker has no constants for "stronge"; the usual cushions of this game are played instead',
    );
  });

  test.each(sizes)(
    "balls are dragged, wait in a pocket, come back, and stay beside each other: %s",
    async (_, how) => {
      const touch = "touch" in how;
      const page = await open("#view=lab", how);
      const initial = await lies(page);
      const [, x, y] = initial["1"]! as [number, number, number];
      await drag(page, [x, y], [0.4, 1.1], touch);
      const moved = await lies(page);
      expect(moved["1"]![1]).toBeCloseTo(0.4, 1);
      expect(moved["1"]![2]).toBeCloseTo(1.1, 1);
      expect({ ...moved, 1: 0 }).toEqual({ ...initial, 1: 0 });
      // onto the place of the cue ball: it lies against it
      const cue = moved.cue!.slice(1) as [number, number];
      await drag(
        page,
        moved["1"]!.slice(1) as [number, number],
        [cue[0] + 0.01, cue[1] + 0.02],
        touch,
      );
      const neighbor = (await lies(page))["1"]!;
      expect(Math.hypot(neighbor[1]! - cue[0], neighbor[2]! - cue[1])).toBeCloseTo(0.05717, 4);
      // off the table, and back from the wood
      await drag(page, neighbor.slice(1) as [number, number], [0.3, -0.09], touch);
      expect((await lies(page))["1"]![0]).toBe(4);
      await drag(page, [-0.045, 0.12], [0.9, 0.5], touch);
      expect((await lies(page))["1"]!.map((x) => Math.round(100 * x) / 100)).toEqual(
        [0, 0.9, 0.5].map((x, k) => (k ? expect.closeTo(x, 1) : x)),
      );
      expect(await page.evaluate(() => scrollY)).toBe(0);
      // turned in place by the wheel, or by the handle of a ball that is picked
      if (!touch) {
        await page.mouse.move(...(await pixelOf(page, initial["9"]![1]!, initial["9"]![2]!)));
        for (let k = 0; k < 9; k++) await page.mouse.wheel(0, 100);
        await expect
          .poll(() => colour(page, initial["9"]![1]! + 0.021, initial["9"]![2]!).then((c) => c[2]))
          .toBeLessThan(80);
        expect(await lies(page)).toMatchObject({ 9: initial["9"]! });
        await page.waitForURL(/%2C90/);
      }
      await click(page, 0.9, 0.5, touch);
      const box = await boxOf(page, "#table-scene");
      const reach = 36 / ((box.height > box.width ? box.width : box.height) / 1.47);
      const [, px, py] = (await lies(page))["1"]! as [number, number, number];
      await drag(page, [px + reach, py], [px, py + reach], touch);
      await page.waitForURL(/%2C(89|90|91)(\+|&|$)/);
      expect((await lies(page))["1"]!.slice(1)).toEqual([px, py]);
      expect(await page.evaluate(() => scrollY)).toBe(0);
    },
  );

  test.each(sizes)(
    "a recording is opened or dropped, verified, and played shot by shot: %s",
    async (_, how) => {
      const table = carom.table("9ft");
      const balls = carom.rack("nineball", table);
      const game = carom.match("nineball", table, { balls, shot: { cushionModel: "stronge" } });
      game.stroke({ speed: 8, phi: 90.2 }, { timeMost: 0.5 });
      game.continue();
      game.stroke({ speed: 2.5, phi: 70 });
      const whole = game.end();
      const lineOf = (part: string) =>
        whole.split("\n").findIndex((line) => line.includes(part)) + 1;
      const ends = [...carom.replay(whole)].map(({ played }) => played);
      const give = (name: string, content: string) =>
        page
          .locator("#recording")
          .setInputFiles({ name, mimeType: "application/jsonl", buffer: Buffer.from(content) });
      const page = await open("#view=lab", how);
      // Waits for the name alone, so that other words fail at once.
      const wordsOf = async (file: string, where = "reel-file") => {
        await expect.poll(() => text(page, where)).toContain(file);
        return text(page, where);
      };
      await give("game.jsonl", whole);
      expect(await wordsOf("game.jsonl")).toBe("game.jsonl: 3 shots, every bit agrees.");
      await says(page, "reel-shot", "Shot 1 of 3: as recorded.");
      await says(page, "s-time", `${ends[0]!.time.toFixed(3)} s`);
      await says(page, "s-status", "stopped_at_time");
      expect(
        await page.evaluate(
          () => document.documentElement.scrollWidth - document.documentElement.clientWidth,
        ),
      ).toBeLessThanOrEqual(0);
      // The film goes on from shot to shot.
      await act(page, "#rate=1000", "#play");
      await comesToSay(page, "reel-shot", "Shot 3 of 3: as recorded.");
      await comesToSay(page, "play", "Play");
      await says(page, "s-count", String(ends[2]!.events));
      // Back to the one that continues: it begins where the other was stopped. What is changed is
      // recorded no longer.
      await act(page, "#reel-back");
      expect(await numberIn(page, "time")).toBe(0.5);
      await says(page, "s-time", `${ends[1]!.time.toFixed(3)} s`);
      await page.locator("#speed").fill("3");
      await says(page, "reel-shot", "Shot 2 of 3 was changed.");
      // A forged stroke, dropped: its shot is shown.
      const dropped = await page.evaluateHandle(
        (content) => {
          const data = new DataTransfer();
          data.items.add(new File([content], "forged.jsonl"));
          return data;
        },
        whole.replace('"speed":2.5', '"speed":2.6'),
      );
      await page.dispatchEvent(".table-view", "drop", { dataTransfer: dropped });
      const forged = lineOf('"speed":2.5');
      expect(await wordsOf("forged.jsonl")).toContain(
        `forged.jsonl: 3 shots, 1 ends differently than recorded, first shot 3 (line ${forged}).`,
      );
      expect(await text(page, "reel-shot")).toContain(
        `Shot 3 of 3, line ${forged}: recorded ok, ${ends[2]!.events} events, ${ends[2]!.time.toFixed(6)} s, hash ${ends[2]!.hash}; played ok, `,
      );
      // Damage is refused by its line; without a shot before it, nothing changes.
      await give("damaged.jsonl", whole.replace('"place"', '"plaice"'));
      expect(await wordsOf("damaged.jsonl")).toContain(
        `damaged.jsonl: 3 shots, every bit agrees. The rest was not read: line ${lineOf('"place"')}: `,
      );
      await give("other.jsonl", whole.replace('"revision":', '"revision":9'));
      expect(await wordsOf("other.jsonl", "message")).toContain(
        "other.jsonl: line 1: the recording is of revision 9",
      );
      await says(page, "reel-file", /damaged\.jsonl/);
      await act(page, "#rack");
      await shows(page, "#reel", false);
    },
  );

  test.each(sizes)(
    "the stick, the drawn ball, a pocket, the next shot, undo, and the link: %s",
    async (_, how) => {
      const touch = "touch" in how;
      const page = await open(
        "#view=lab&game=nineball&speed=3&at=0.635,0.6 0.5,1.6 in in in in in in in 1,2",
        how,
      );
      await says(page, "message", "");
      // the stick is drawn back: 0.04 m for each m/s
      await drag(page, [0.635, 0.6 - 0.35], [0.635, 0.6 - 0.43], touch);
      expect(await numberIn(page, "speed")).toBeCloseTo(5, 0);
      await page.locator("#speed").fill("2.8");
      const ball = await boxOf(page, "#spin");
      const place = [
        ball.x + ball.width * (0.5 + 0.2 / 1.05),
        ball.y + ball.height * (0.5 + 0.1 / 1.05),
      ] as const;
      await (touch ? page.touchscreen.tap(...place) : page.mouse.click(...place));
      expect(await numberIn(page, "right")).toBeCloseTo(0.4, 1);
      expect(await numberIn(page, "up")).toBeCloseTo(-0.2, 1);
      await click(page, 0.5, 1.6, touch);
      const inPocket = async () =>
        Math.max(...(await colour(page, -0.0295, 2.5695, touch ? 11 : 25)));
      expect(await inPocket()).toBeLessThan(60);
      // every corner at the foot takes the ball, with squirt and throw
      for (const [x, y, name] of [
        [1.27, 2.54, "right"],
        [0, 2.54, "left"],
      ] as const) {
        await click(page, x, y, touch);
        expect(await text(page, "message")).toContain(`Aimed: ball 1 into the foot-${name} pocket`);
        await says(page, "s-pocketed", "1");
        await says(page, "s-status", "ok");
      }
      // its trail ends in the pocket, where the ball lies
      expect(await inPocket()).toBeGreaterThan(60);
      // one that is picked, and hidden behind the other
      await click(page, 1, 2, touch);
      await click(page, 0, 0, touch);
      await says(
        page,
        "message",
        /No such aim: no direction sends ball 9 into the head-left pocket\./,
      );
      const phi = await numberIn(page, "phi");
      await page.waitForURL(
        ({ hash }) => Math.abs(Number(new URLSearchParams(hash.slice(1)).get("phi")) - phi) < 0.05,
      ); // the address follows
      const aimed = page.url();
      const shot = await text(page, "s-time");
      await act(page, "#next");
      const lie = await lies(page);
      expect(lie["1"]![0]).toBe(4);
      expect(await text(page, "s-time")).not.toBe(shot);
      await act(page, "#undo");
      await says(page, "s-time", shot);
      await page.waitForURL(({ href }) => href === aimed);
      await act(page, "#copy");
      await comesToSay(page, "message", /copied/);
      const reopened = await open(
        new URL(await page.evaluate(() => navigator.clipboard.readText())).hash,
        how,
      );
      await says(reopened, "s-time", shot);
      await says(reopened, "s-pocketed", "1");
    },
  );

  test("a finger on the cloth scrolls the page, and turns the aim on its line", async () => {
    const page = await open("#view=lab", PHONE);
    const phi = await valueOf(page, "phi");
    await drag(page, [0.2, 1.2], [0.2, 1.9], true);
    await expect.poll(() => page.evaluate(() => scrollY)).toBeGreaterThan(100);
    expect(await valueOf(page, "phi")).toBe(phi);
    // The page glides on.
    const height = () => page.evaluate(() => scrollY);
    await expect.poll(async () => (await height()) - (await frames(page, 10).then(height))).toBe(0);
    await page.evaluate(() => scrollTo(0, 0));
    await drag(page, [0.635, 1.4], [0.7, 1.4], true);
    expect(await page.evaluate(() => scrollY)).toBe(0);
    expect(await numberIn(page, "phi")).toBeCloseTo(90 - 4.8, 0);
    await click(page, 0.2, 1.5, true);
    expect(await numberIn(page, "phi")).toBeCloseTo(116.7, 0);
  });

  test("keys on the table aim, move and turn balls, undo, and play", async () => {
    const page = await open("#view=lab&speed=3&at=0.635,0.6 0.5,1.6 in in in in in in in 1,2");
    const scene = page.locator("#table-scene");
    await scene.press("ArrowLeft");
    await scene.press("Shift+ArrowRight");
    await scene.press("ArrowUp");
    expect(await numberIn(page, "phi")).toBeCloseTo(89.1, 1);
    expect(await numberIn(page, "speed")).toBeCloseTo(3.1, 6);
    await page.waitForURL(/phi=89.1/);
    // The cue ball, and then the one that is picked, by 1 and 10 mm as one sees them: the table
    // lies.
    await scene.press("Alt+ArrowRight");
    const reports = (begins: string) =>
      page.waitForURL(({ hash }) =>
        (new URLSearchParams(hash.slice(1)).get("at") ?? "")
          .replace(/\d+\.\d+/g, (x) => String(Number(Number(x).toFixed(6))))
          .startsWith(`${begins} `),
      );
    await reports("0.635,0.601 0.5,1.6");
    await click(page, 0.5, 1.6);
    await scene.press("Alt+Shift+ArrowDown");
    await reports("0.635,0.601 0.51,1.6");
    await scene.press(".");
    await reports("0.635,0.601 0.51,1.6,10");
    const moved = await lies(page);
    expect([moved.cue, moved["1"]].map((ball) => ball!.map((x) => Number(x.toFixed(6))))).toEqual([
      [0, 0.635, 0.601],
      [0, 0.51, 1.6],
    ]);
    // What has stood in the address is a step back: the turn, then the move.
    for (const x of [0.51, 0.5]) {
      await scene.press("Control+z");
      expect((await lies(page))["1"]!.map((x) => Number(x.toFixed(6)))).toEqual([0, x, 1.6]);
    }
    await scene.press(" ");
    await says(page, "play", "Pause");
  });

  test.each(sizes)("the table of the laboratory is large: %s", async (_, how) => {
    const page = await open("#view=lab", how);
    const box = await boxOf(page, "#table-scene");
    expect((box.width * box.height) / (how.width * how.height)).toBeGreaterThan(0.48);
    expect(box.y + box.height).toBeLessThan(how.height);
    // Diamonds are bright in the middle of the wood, beside a quarter of the head cushion; ball 9
    // is yellow between white ends.
    const wood = -(CUSHION + WOOD) / 2;
    expect(Math.min(...(await colour(page, 1.27 / 4, wood)))).toBeGreaterThan(150);
    const [, x, y] = (await lies(page))["9"]!;
    expect((await colour(page, x! + 0.02, y!))[2]).toBeGreaterThan(200);
    // on the phone it is two pixels wide
    if (how.width > 1000) expect((await colour(page, x!, y! + 0.021))[2]).toBeLessThan(80);
  });
});
