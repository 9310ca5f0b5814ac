// Practice in a browser: drills with their counts, and a table from a photo whose camera is known.
import { expect, test } from "vitest";
import { pinhole } from "./camera.js";
import { Draws } from "../../test/support.js";
import {
  act,
  boxOf,
  comesToSay,
  counts,
  describePages,
  fingersOn,
  keptSetup,
  pages,
  PHONE,
  reload,
  says,
  shows,
  sizes,
  violations,
} from "./page.js";

const W = 1.27;
const L = 2.54;
const NOSE = 0.0366;
const R = 0.028575;

describePages("practice", () => {
  const { open, turnTo } = pages();

  test("a drill counts what is made and missed, begins again, and hides the way of the balls", async () => {
    const page = await open("", PHONE);
    await act(page, "#new-game", "#rate=1000", "#drill=Short straight pot", "#start-drill");
    await says(page, "turn", "Short straight pot");
    await turnTo(page, 151.2);
    await act(page, "#shoot");
    await comesToSay(page, "said", "Missed: 0 of 1. The cue ball was potted or left the table.");
    // So little off its pocket that the page tells by how much.
    await turnTo(page, 48);
    await act(page, "#power=1.5", "#shoot");
    await comesToSay(
      page,
      "said",
      /^Missed: 0 of 2\. The 1 was not potted\. Aim [23]\.\d\d° more to the right\.$/,
    );
    await turnTo(page, 45);
    await act(page, "#power=1.5", "#shoot");
    await comesToSay(page, "said", "Made: 1 of 3.");
    await shows(page, "#undo-stroke", false);
    await reload(page);
    await says(page, "turn", "Short straight pot");
    await act(page, "#new-game", "#drill=Stop shot", "#drill=Short straight pot");
    await says(page, "drill-note", /Made 1 of 3\./);
    // What came of a place that was wanted, and all of it in the log.
    await act(page, "#drill=Draw", "#start-drill");
    await turnTo(page, 63.43);
    await act(page, "#power=1.2", "#shoot");
    await comesToSay(
      page,
      "said",
      /The cue ball came back \d+ cm instead of 40 cm: hit it lower or harder\.$/,
    );
    await act(page, "#new-game", "#open-log");
    await counts(page, "#log tbody tr", 4);
    expect(await page.locator("#log tbody tr").nth(2).textContent()).toMatch(
      /Short straight pot.*[23]\.\d\d/,
    );
    await says(page, "log-sum", /Practise next: .*\(/);
    expect(await violations(page)).toEqual([]);
  });

  test.each(sizes)(
    "four corners and taps on a photo that are off by 2 pixels lay the balls within 3 mm: %s",
    async (_, how) => {
      const page = await open("", how);
      const size = [1600, 1200] as const;
      const see = pinhole(size, [0.5, -1.0, 1.3], [0.635, 1.1, 0], 1200);
      const balls: [number, number, number, string][] = [
        [0, 0.4, 0.7, "#f4f2ea"],
        [1, 0.9, 1.6, "#d8aa08"],
        [3, 0.3, 2.1, "#bb1330"],
        [8, 1.1, 1.0, "#191b1e"],
      ];
      // The photo: wood, the tops of cushions, their faces, which are darker, cloth and balls as that
      // camera sees them.
      const corners = (out: number, z: number): [number, number][] =>
        [
          see(-out, -out, z),
          see(W + out, -out, z),
          see(W + out, L + out, z),
          see(-out, L + out, z),
        ].map(([u, v]) => [u, v]);
      const picture = await page.evaluate(
        ({ size, layers, balls }) => {
          const canvas = document.createElement("canvas");
          [canvas.width, canvas.height] = size;
          const g = canvas.getContext("2d")!;
          g.fillStyle = "#443322";
          g.fillRect(0, 0, ...size);
          g.save();
          for (const { hex, pixels } of layers) {
            g.fillStyle = hex;
            g.beginPath();
            for (const pixel of pixels) g.lineTo(...pixel);
            g.fill();
            // What is lower is seen within the noses alone.
            if (hex !== layers[0]!.hex) g.clip();
          }
          g.restore();
          for (const { pixel, radius, hex } of balls) {
            g.fillStyle = hex;
            g.beginPath();
            g.arc(...pixel, radius, 0, 7);
            g.fill();
          }
          return canvas.toDataURL("image/png").split(",")[1]!;
        },
        {
          size: [...size] as [number, number],
          layers: [
            { hex: "#1f6f5c", pixels: corners(0.05, NOSE) },
            { hex: "#144a3d", pixels: corners(0, NOSE) },
            { hex: "#1f6f5d", pixels: corners(0, 0) },
          ],
          balls: balls.map(([, x, y, hex]) => ({
            pixel: [...see(x, y, R)] as [number, number],
            radius: Math.hypot(see(x, y, R)[0] - see(x + R, y, R)[0], 1),
            hex,
          })),
        },
      );
      await act(page, "#new-game", "#open-photo");
      expect(await violations(page)).toEqual([]);
      await page.locator("#photo-file").setInputFiles({
        name: "table.png",
        mimeType: "image/png",
        buffer: Buffer.from(picture, "base64"),
      });
      await comesToSay(page, "photo-said", /Mark the head left corner/);
      const box = await boxOf(page, "#photo");
      const draws = new Draws(5n);
      const tap = async (x: number, y: number, z: number) => {
        const [u, v] = see(x, y, z);
        const pixel = [
          box.x + (u * box.width) / size[0] + draws.uniform(-2, 2),
          box.y + (v * box.height) / size[1] + draws.uniform(-2, 2),
        ] as const;
        await ("touch" in how ? page.touchscreen.tap(...pixel) : page.mouse.click(...pixel));
      };
      for (const [x, y] of [
        [0, 0],
        [W, 0],
        [W, L],
        [0, L],
      ] as const)
        await tap(x, y, NOSE);
      await comesToSay(page, "photo-said", /Tap the centre of each ball/);
      for (const [ball, x, y] of balls) {
        await tap(x, y, R);
        // Where the colour does not tell the ball, the page asks.
        const answer = page.locator("#photo-ask button", { hasText: new RegExp(`^${ball}$`) });
        if ((await answer.count()) > 0) await answer.click();
        await counts(page, "#photo-ask button", 0);
      }
      // A finger that is held sees what is under it, and two fingers a part larger.
      if ("touch" in how) {
        const touch = await fingersOn(page);
        const fingers = (...xs: number[]) => xs.map((x) => [box.x + x, box.y + 100]);
        const seen = () =>
          page.locator("#photo").evaluate((canvas: HTMLCanvasElement) => canvas.toDataURL());
        const initial = await seen();
        await touch("Start", fingers(150));
        await expect.poll(seen).not.toBe(initial);
        await touch("Start", fingers(150, 200));
        await touch("Move", fingers(130, 220));
        await touch("End");
        expect((await boxOf(page, "#photo")).width).toBeGreaterThan(1.5 * box.width);
      }
      await says(page, "photo-said", /4 balls/);
      await act(page, "#photo-use");
      const { at: layout } = await keptSetup<{ at: string }>(page);
      const places = layout.split(" ");
      let worst = 0;
      for (const [ball, x, y] of balls) {
        const [px, py] = places[ball]!.split(",").map(Number) as [number, number];
        worst = Math.max(worst, Math.hypot(px - x, py - y));
      }
      console.log(
        `a photo of ${Math.round(box.width)} pixels on the page: balls off by at most ${(1000 * worst).toFixed(1)} mm`,
      );
      expect(places.filter((place) => place !== "in")).toHaveLength(4);
      expect(worst).toBeLessThan(0.003);
    },
  );
});
