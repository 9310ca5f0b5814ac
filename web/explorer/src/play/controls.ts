// What a stroke is set by, beside the table: the tip on a ball that one touches, the power, small turns, and Shoot, which draws the stick while it is held.
import { button, el, pad, slider, type Slider } from "../ui.js";

export interface Stroke {
  speed: number;
  phi: number;
  right: number;
  up: number;
  theta: number;
}
export interface Host {
  changed(): void;
  shoot(): void;
  /** Whether a stroke may be played now. */
  free(): boolean;
}

const FASTEST = 10;
/** How long Shoot is held before the stick is drawn, and how long it takes to its end, ms. */
const [HELD, DRAWN] = [280, 1600];
const two = (x: number): string => x.toFixed(2);

export function controls(host: Host): { side: HTMLElement; shoot: HTMLButtonElement; turns: HTMLElement; numbers: HTMLElement; value: Stroke; set(values: Partial<Stroke>): void } {
  const sliders: Record<keyof Stroke, Slider> = {
    speed: slider("power", "Power", 0.1, FASTEST, 0.05, "", host.changed, (x) => `${x.toFixed(1)} m/s`),
    phi: slider("phi", "Direction", 0, 360, 0.05, "°", host.changed, two),
    right: slider("right", "Tip to the right (+) or left", -0.7, 0.7, 0.01, " R", showTip, two),
    up: slider("up", "Tip above (+) or below", -0.7, 0.7, 0.01, " R", showTip, two),
    theta: slider("theta", "Butt raised by", 0, 80, 1, "°", host.changed, (x) => x.toFixed(0)),
  };
  const tip = pad("tip-ball", "Where the tip touches the cue ball", (right, up) => {
    sliders.right.value = right;
    sliders.up.value = up;
    showTip();
  });
  tip.root.classList.add("grows");
  function showTip(): void {
    tip.set(sliders.right.value, sliders.up.value);
    host.changed();
  }
  const value: Stroke = Object.defineProperties({} as Stroke, Object.fromEntries(Object.keys(sliders).map((key) => [key, { enumerable: true, get: () => sliders[key as keyof Stroke].value }])));
  function set(values: Partial<Stroke>): void {
    for (const [key, x] of Object.entries(values)) sliders[key as keyof Stroke].value = x;
    tip.set(sliders.right.value, sliders.up.value);
  }

  // ---- Shoot -------------------------------------------------------------------------------------------------------------------

  const shoot = button("Shoot", () => undefined, { id: "shoot", class: "main", title: "Press it: the power that is set. Hold it: the stick is drawn, and let go plays." });
  let pressed = 0;
  let drawing = false;
  /** The power of a stick that is drawn for a time: up, and down again. */
  const power = (ms: number): number => {
    const x = (ms / DRAWN) % 2;
    return Math.round(100 * (0.3 + (FASTEST - 0.3) * (x < 1 ? x : 2 - x) ** 1.5)) / 100;
  };
  shoot.addEventListener("pointerdown", (event) => {
    if (event.button > 0 || !host.free()) return;
    const mine = (pressed = performance.now());
    drawing = false;
    shoot.setPointerCapture(event.pointerId);
    const grow = (): void => {
      if (pressed !== mine) return;
      const ms = performance.now() - mine - HELD;
      if (ms > 0) {
        drawing = true;
        sliders.speed.value = power(ms);
        host.changed();
      }
      requestAnimationFrame(grow);
    };
    requestAnimationFrame(grow);
  });
  const letGo = (event: PointerEvent): boolean => {
    const was = pressed > 0;
    pressed = 0;
    const box = shoot.getBoundingClientRect();
    // Off the button it is called off.
    return was && drawing && event.type === "pointerup" && event.clientX > box.left - 30 && event.clientX < box.right + 30 && event.clientY > box.top - 30 && event.clientY < box.bottom + 30;
  };
  shoot.addEventListener("pointerup", (event) => letGo(event) && host.free() && host.shoot());
  shoot.addEventListener("pointercancel", letGo);
  // A finger that let go of a drawn stick clicks nothing: Skip is there by now.
  shoot.addEventListener("touchend", (event) => {
    if (!drawing) return;
    drawing = false;
    event.preventDefault();
  });
  shoot.addEventListener("contextmenu", (event) => event.preventDefault());
  shoot.addEventListener("click", () => {
    if (!drawing && host.free()) host.shoot();
    drawing = false;
  });

  /** Turns the aim by a little, and on while it is held. */
  function turns(text: string, label: string, by: number): HTMLElement {
    const one = button(text, () => undefined, { "aria-label": label, class: "turn" });
    let holding = 0;
    const turn = (): void => {
      set({ phi: Math.round((sliders.phi.value + by + 360) * 1000) / 1000 % 360 });
      host.changed();
    };
    one.addEventListener("pointerdown", () => {
      const begun = performance.now();
      const mine = (holding = begun);
      const again = (): void => {
        if (holding !== mine) return;
        if (performance.now() - begun > 350) turn();
        requestAnimationFrame(again);
      };
      requestAnimationFrame(again);
    });
    for (const type of ["pointerup", "pointercancel", "pointerleave"]) one.addEventListener(type, () => (holding = 0));
    one.addEventListener("click", turn);
    return one;
  }

  return {
    side: el("section", { class: "side", "aria-label": "The stroke" }, sliders.speed.root, tip.root),
    shoot,
    turns: el("span", { class: "turns" }, turns("↺", "Turn the aim to the left by 0.05 degrees", 0.05), turns("↻", "Turn the aim to the right by 0.05 degrees", -0.05)),
    numbers: el("details", { class: "numbers-of" }, el("summary", {}, "Stroke in numbers"), ...(["phi", "right", "up", "theta"] as const).map((key) => sliders[key].root)),
    value,
    set,
  };
}
