// Small helpers for the page: elements, sliders, canvases, the state in the address.

import { make as el } from "../../player/player.js";
import { texts } from "./texts/texts.js";

export { el };

/** The message of an error. */
export const wrong = (error: unknown): string =>
  error instanceof Error ? error.message : String(error);

export type Slider = ReturnType<typeof slider>;
/** A labelled slider with its value and unit. */
export function slider(
  id: string,
  text: string,
  min: number,
  max: number,
  step: number,
  unit: string,
  onInput: () => void,
  show = (x: number) => String(x),
) {
  const input = el("input", {
    type: "range",
    id,
    min: String(min),
    max: String(max),
    step: String(step),
  });
  const output = el("output", { for: id, id: `${id}-value` });
  // A value that was set is kept as it is; the slider itself rounds to its steps.
  let exact: number | undefined;
  const tell = (): void => {
    output.textContent = `${show(exact ?? input.valueAsNumber)}${unit}`;
    input.setAttribute("aria-valuetext", output.textContent);
  };
  input.addEventListener("input", () => {
    exact = undefined;
    tell();
    onInput();
  });
  return {
    root: el("div.field", el("label", { for: id }, text), output, input),
    input,
    get value() {
      return exact ?? input.valueAsNumber;
    },
    set value(x: number) {
      exact = x;
      input.value = String(x);
      tell();
    },
  };
}

/**
 * Follows a pointer that is held on an element: calls for where it goes down, which comes first,
 * and where it moves to.
 */
export function drags(
  element: HTMLElement,
  over: (event: PointerEvent, first: boolean) => void,
): void {
  element.addEventListener("pointerdown", (event) => {
    element.setPointerCapture(event.pointerId);
    over(event, true);
  });
  element.addEventListener(
    "pointermove",
    (event) => element.hasPointerCapture(event.pointerId) && over(event, false),
  );
}

/** Rows of a table of numbers: their ids behind a prefix, names and texts. */
export const numberRows = (prefix: string, rows: readonly (readonly string[])[]) =>
  rows.map(([id, name, text]) =>
    el("tr", el("th", { scope: "row" }, name), el("td", { id: `${prefix}-${id}` }, text)),
  );

/** What sliders are set to. */
export const valuesOf = <K extends string>(sliders: Record<K, Slider>): Record<K, number> =>
  Object.fromEntries(
    Object.entries<Slider>(sliders).map(([key, control]) => [key, control.value]),
  ) as Record<K, number>;

/**
 * A ball as whoever strikes sees it, with the tip on it: right and up in radii, at most 0.7 from
 * the middle. The sliders do the same by keys.
 */
export function pad(
  id: string,
  text: string,
  onInput: (right: number, up: number) => void,
): { root: HTMLElement; set(right: number, up: number): void } {
  const root = el("div.pad", { id, role: "img", "aria-label": text });
  root.innerHTML =
    '<svg viewBox="-1.05 -1.05 2.1 2.1"><circle r="1" fill="#fbfaf5" stroke="#000a" stroke-width="0.03"/><circle r="0.5" fill="none" stroke="#0006" stroke-width="0.02" stroke-dasharray="0.06 0.05"/>' +
    '<path d="M-1 0H1M0-1V1" stroke="#0003" stroke-width="0.02"/><circle class="tip" r="0.15" fill="#3f7fbf" stroke="#000a" stroke-width="0.02"/></svg>';
  // The place on the ball, and where the pointer was when it was there. A pad may grow while it is
  // held, within the page and not around the finger, so moves count and not places.
  let place: [number, number] = [0, 0];
  let pointer: [number, number] = [0, 0];
  drags(root, (event, first) => {
    const box = root.getBoundingClientRect();
    const start = first ? [(box.left + box.right) / 2, (box.top + box.bottom) / 2] : pointer;
    const [x, y] = first ? [0, 0] : place;
    place = [
      x + (2.1 * (event.clientX - start[0]!)) / box.width,
      y - (2.1 * (event.clientY - start[1]!)) / box.height,
    ];
    pointer = [event.clientX, event.clientY];
    const most = Math.min(1, 0.7 / Math.hypot(...place));
    onInput(Math.round(100 * most * place[0]) / 100, Math.round(100 * most * place[1]) / 100);
    if (first) root.classList.add("held");
  });
  for (const type of ["pointerup", "pointercancel"])
    root.addEventListener(type, () => root.classList.remove("held"));
  return {
    root,
    set: (right, up) =>
      root.querySelector(".tip")!.setAttribute("transform", `translate(${right} ${-up})`),
  };
}

/** A button, with the id and classes of a selector such as "#hint.main". */
export function button(
  text: string,
  onClick: () => void,
  selector = "",
  attributes: Record<string, string> = {},
): HTMLButtonElement {
  const element = el(`button${selector}` as "button", { type: "button", ...attributes }, text);
  element.addEventListener("click", onClick);
  return element;
}

export function choice(
  id: string,
  text: string,
  options: readonly (readonly [string, string])[],
  onChange: () => void,
): { root: HTMLElement; select: HTMLSelectElement } {
  const select = el(
    "select",
    { id },
    ...options.map(([value, label]) => el("option", { value }, label)),
  );
  select.addEventListener("change", onChange);
  return { root: el("label.inline", text, select), select };
}

export function check(
  id: string,
  text: string,
  onChange: () => void,
): { root: HTMLElement; input: HTMLInputElement } {
  const input = el("input", { type: "checkbox", id });
  input.addEventListener("change", onChange);
  return { root: el("label.check", input, text), input };
}

/** Calls `draw` once before the next frame, however often it is requested. */
export function eachFrame(draw: () => void): () => void {
  let isPending = false;
  return () => {
    if (isPending) return;
    isPending = true;
    requestAnimationFrame(() => {
      isPending = false;
      draw();
    });
  };
}

/** A color of the page's theme. */
export function color(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

export function arrow(
  g: CanvasRenderingContext2D,
  x: number,
  y: number,
  dx: number,
  dy: number,
  stroke: string,
  dashed = false,
): void {
  const length = Math.hypot(dx, dy);
  if (length < 2) return;
  const head = Math.min(10, length);
  const ux = dx / length;
  const uy = dy / length;
  g.strokeStyle = stroke;
  g.fillStyle = stroke;
  g.lineWidth = 3;
  g.setLineDash(dashed ? [6, 5] : []);
  g.beginPath();
  g.moveTo(x, y);
  g.lineTo(x + dx - ux * head, y + dy - uy * head);
  g.stroke();
  g.setLineDash([]);
  g.beginPath();
  g.moveTo(x + dx, y + dy);
  g.lineTo(x + dx - head * ux - (head / 2) * uy, y + dy - head * uy + (head / 2) * ux);
  g.lineTo(x + dx - head * ux + (head / 2) * uy, y + dy - head * uy - (head / 2) * ux);
  g.fill();
}

/** The state in the address: what differs from the defaults. */
export function parameters(): URLSearchParams {
  return new URLSearchParams(location.hash.slice(1));
}

let writing: number | undefined;
/** Writes the state behind the # a little later, so that dragging does not flood the history. */
export function keep(state: Record<string, string>): void {
  window.clearTimeout(writing);
  writing = window.setTimeout(
    () => history.replaceState(null, "", `#${new URLSearchParams(state)}`),
    150,
  );
}

/** A dialog with a heading, which closes by its button or Escape. */
export function dialog(
  id: string,
  title: string,
  ...children: (Node | string)[]
): HTMLDialogElement {
  const element = el(
    "dialog",
    { id, "aria-label": title },
    el(
      "div.row.head",
      el("h2", title),
      button(texts.close, () => element.close(), ".close"),
    ),
    ...children,
  );
  return element;
}
