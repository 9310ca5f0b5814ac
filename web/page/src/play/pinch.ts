// Two fingers enlarge a photo; the point between them stays where it is.
import type { Pixel } from "./photo.js";

/** `began`: a second finger came; `changed`: the part is another one. */
export function pinches(canvas: HTMLCanvasElement, began: () => void, changed: () => void): void {
  const fingers = new Map<number, Pixel>();
  let zoom = 1;
  let x = 0;
  let y = 0;
  const both = (): [number, number, number] => {
    const [a, b] = [...fingers.values()] as [Pixel, Pixel];
    return [Math.hypot(a[0] - b[0], a[1] - b[1]), (a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
  };
  canvas.addEventListener(
    "pointerdown",
    ({ pointerId, clientX, clientY }) => {
      fingers.set(pointerId, [clientX, clientY]);
      if (fingers.size > 1) began();
    },
    true,
  );
  canvas.addEventListener("pointermove", ({ pointerId, clientX, clientY }) => {
    if (!fingers.has(pointerId)) return;
    if (fingers.size !== 2) return void fingers.set(pointerId, [clientX, clientY]);
    const [far, ...starts] = both();
    fingers.set(pointerId, [clientX, clientY]);
    const [current, ...ends] = both();
    const frame = canvas.parentElement!.getBoundingClientRect();
    const more = Math.min(Math.max((zoom * current) / far, 1), 6) / zoom;
    zoom *= more;
    const stay = (offset: number, start: number, k: number, size: number): number =>
      Math.min(
        Math.max(ends[k]! - start - (starts[k]! - start - offset) * more, size * (1 - zoom)),
        0,
      );
    [x, y] = [
      stay(x, frame.left, 0, canvas.clientWidth),
      stay(y, frame.top, 1, canvas.clientHeight),
    ];
    canvas.style.transform = `translate(${x}px, ${y}px) scale(${zoom})`;
    changed();
  });
  for (const type of ["pointerup", "pointercancel"] as const)
    canvas.addEventListener(type, ({ pointerId }) => fingers.delete(pointerId));
}
