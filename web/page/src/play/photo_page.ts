// The dialog of a table from a photo: a picture, four corners, and the balls by taps; the layout lies on the table for practice.
import { colourOf } from "../../../player/words.js";
import { button, choice, dialog, el } from "../ui.js";
import { type Camera, cameraOf, type Pixel, suggest } from "./photo.js";

const CORNERS = ["head left", "head right", "foot right", "foot left"];
/** The noses of cushions, above the middles of balls, m. */
const LOWER = 0.008;
/** How near a mark is taken hold of, and how near a tap means it, CSS pixels. */
const [REACH, TAP] = [18, 8];

export interface Host {
  /** Names of the balls that may lie there, and the size of their table, m. */
  names: readonly string[];
  size: readonly [number, number];
  /** Where balls lie, by their numbers. */
  use(balls: Map<number, readonly [number, number]>): void;
}

export function photoPage({ names, size, use }: Host): { root: HTMLDialogElement; open(): void } {
  const canvas = el("canvas", { id: "photo", tabindex: "0", role: "img", "aria-label": "The photo. Arrow keys move the cross, Enter marks." });
  const file = el("input", { type: "file", id: "photo-file", accept: "image/*", "aria-label": "A photo of a table" });
  const said = el("p", { id: "photo-said", role: "status" });
  const number = (id: string, text: string, value: number): { root: HTMLElement; input: HTMLInputElement } => {
    const input = el("input", { type: "number", id, min: "1", max: "4", step: "0.01", value: String(value) });
    input.addEventListener("change", draw);
    return { root: el("label", { class: "inline" }, text, input), input };
  };
  const [wide, long] = [number("photo-width", "Width, m", size[0]), number("photo-length", "Length, m", size[1])];
  const ball = choice("photo-ball", "Next ball", [["auto", "by its colour"], ...names.map((name, k) => [String(k), name === "cue" ? "cue ball" : name] as const)], () => undefined);
  const done = button("Lay the balls", finish, { id: "photo-use", class: "main" });
  const root = dialog("photo-page", "A table from a photo", el("div", { class: "row" }, file, wide.root, long.root), said, canvas, el("div", { class: "row" }, ball.root, button("Take back", back, { id: "photo-back" }), done));

  let picture: ImageBitmap | undefined;
  let corners: Pixel[] = [];
  let balls: { ball: number; at: Pixel }[] = [];
  let cross: Pixel = [0, 0];
  let held: { set(at: Pixel): void } | undefined;

  /** Pixels of the picture for a pixel of the page. */
  const scale = (): number => (picture ? picture.width / Math.max(canvas.clientWidth, 1) : 1);
  function camera(): Camera | undefined {
    if (!picture || corners.length < 4) return undefined;
    return cameraOf([picture.width, picture.height], corners, [wide.input.valueAsNumber, long.input.valueAsNumber], LOWER);
  }

  function draw(): void {
    done.disabled = balls.length === 0;
    if (!picture) return void (said.textContent = "Choose or take a photo in which all four corners are seen.");
    const g = canvas.getContext("2d")!;
    g.drawImage(picture, 0, 0);
    const unit = scale();
    g.lineWidth = 2 * unit;
    g.strokeStyle = g.fillStyle = "#ffe28a";
    g.font = `bold ${15 * unit}px sans-serif`;
    const mark = ([x, y]: Pixel, text: string): void => {
      g.beginPath();
      g.arc(x, y, 7 * unit, 0, 7);
      g.moveTo(x - 11 * unit, y);
      g.lineTo(x + 11 * unit, y);
      g.moveTo(x, y - 11 * unit);
      g.lineTo(x, y + 11 * unit);
      g.stroke();
      g.fillText(text, x + 10 * unit, y - 8 * unit);
    };
    corners.forEach((at, k) => mark(at, CORNERS[k]!));
    try {
      const of = camera();
      if (of) {
        // The table as it was found, with its middle line.
        const [w, l] = [wide.input.valueAsNumber, long.input.valueAsNumber];
        for (const line of [[[0, 0], [w, 0], [w, l], [0, l], [0, 0]], [[0, l / 2], [w, l / 2]], [[w / 2, 0], [w / 2, l]]] as const) {
          g.beginPath();
          line.forEach(([x, y], k) => g[k === 0 ? "moveTo" : "lineTo"](...(of.pixel([x, y]) as [number, number])));
          g.stroke();
        }
      }
      said.textContent = corners.length < 4 ? `Mark the corner ${CORNERS[corners.length]}, where the noses of the cushions would meet. The head is where one breaks.` : balls.length === 0 ? "Tap the middle of each ball. Marks can be dragged." : `${balls.length} ${balls.length === 1 ? "ball" : "balls"}. Another tap on a mark of a ball takes the next number.`;
    } catch (error) {
      said.textContent = error instanceof Error ? error.message : String(error);
    }
    for (const one of balls) mark(one.at, names[one.ball]!);
  }

  /** The ball of a tap: the one that was chosen, or the free one that its colour suggests. */
  function ballAt([x, y]: Pixel): number {
    const free = names.map((_, k) => k).filter((k) => !balls.some((one) => one.ball === k));
    const asked = Number(ball.select.value);
    if (ball.select.value !== "auto" && free.includes(asked)) {
      ball.select.value = "auto";
      return asked;
    }
    // Half of the ball's radius: around it is cloth.
    const of = camera()!;
    const [px, py] = of.place([x, y]);
    const edge = of.pixel([px + 0.014, py]);
    const reach = Math.max(Math.round(0.7 * Math.hypot(edge[0] - x, edge[1] - y)), 2);
    const copy = document.createElement("canvas").getContext("2d")!;
    copy.drawImage(picture!, -x + reach, -y + reach);
    const first = suggest(copy.getImageData(0, 0, 2 * reach, 2 * reach).data, names.slice(1, 9).map((name, k) => colourOf(name, k + 1)));
    // Stripe for solid, else the next that is free.
    return [first, first > 8 ? first - 8 : first + 8, ...free].find((one) => free.includes(one)) ?? -1;
  }
  function tap(at: Pixel): void {
    if (!picture) return;
    if (corners.length < 4) corners.push(at);
    else {
      const which = ballAt(at);
      if (which >= 0) balls.push({ ball: which, at });
    }
    draw();
  }
  function back(): void {
    if (balls.length > 0) balls.pop();
    else corners.pop();
    draw();
  }
  function finish(): void {
    const of = camera();
    if (!of) return;
    // A table of another size: the same shares of width and length.
    const [sx, sy] = [size[0] / wide.input.valueAsNumber, size[1] / long.input.valueAsNumber];
    const places = balls.map((one) => {
      const [x, y] = of.place(one.at);
      return [one.ball, [x * sx, y * sy] as const] as const;
    });
    const out = places.find(([, [x, y]]) => !(x > -0.03 && x < size[0] + 0.03 && y > -0.03 && y < size[1] + 0.03));
    if (out) return void (said.textContent = `Ball ${names[out[0]]} lies outside of the table: drag its mark, or those of the corners.`);
    root.close();
    use(new Map(places));
  }

  const pixel = (event: PointerEvent): Pixel => {
    const box = canvas.getBoundingClientRect();
    return [(event.clientX - box.left) * scale(), (event.clientY - box.top) * scale()];
  };
  canvas.addEventListener("pointerdown", (event) => {
    const at = pixel(event);
    const near = ([x, y]: Pixel): boolean => Math.hypot(x - at[0], y - at[1]) < REACH * scale();
    const [corner, one] = [corners.findIndex(near), balls.find(({ at }) => near(at))];
    canvas.setPointerCapture(event.pointerId);
    let moved = false;
    held = {
      set(to) {
        moved ||= Math.hypot(to[0] - at[0], to[1] - at[1]) > 4 * scale();
        if (!moved) return;
        if (one) one.at = to;
        else if (corner >= 0) corners[corner] = to;
        draw();
      },
    };
    const up = (): void => {
      held = undefined;
      if (moved) return;
      // A tap beside a mark is another ball.
      if (one && Math.hypot(one.at[0] - at[0], one.at[1] - at[1]) < TAP * scale()) one.ball = names.map((_, k) => (one.ball + 1 + k) % names.length).find((k) => !balls.some((other) => other !== one && other.ball === k))!;
      else return tap(at);
      draw();
    };
    canvas.addEventListener("pointerup", up, { once: true });
  });
  canvas.addEventListener("pointermove", (event) => held?.set(pixel(event)));
  canvas.addEventListener("keydown", (event) => {
    const arrow = ({ ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] } as Record<string, Pixel>)[event.key];
    if (!picture || (!arrow && event.key !== "Enter")) return;
    event.preventDefault();
    const by = (event.shiftKey ? 20 : 2) * scale();
    if (!arrow) return tap(cross);
    cross = [Math.min(Math.max(cross[0] + by * arrow[0], 0), picture.width), Math.min(Math.max(cross[1] + by * arrow[1], 0), picture.height)];
    draw();
    const g = canvas.getContext("2d")!;
    g.strokeStyle = "#fff";
    g.strokeRect(cross[0] - 6 * scale(), cross[1] - 6 * scale(), 12 * scale(), 12 * scale());
  });
  file.addEventListener("change", () => {
    const [given] = file.files ?? [];
    if (given)
      createImageBitmap(given).then((made) => {
        picture = made;
        [canvas.width, canvas.height] = [made.width, made.height];
        [corners, balls, cross] = [[], [], [made.width / 2, made.height / 2]];
        draw();
      }, () => (said.textContent = `This browser cannot read ${given.name} as a picture.`));
  });

  return {
    root,
    open() {
      root.showModal();
      draw();
    },
  };
}
