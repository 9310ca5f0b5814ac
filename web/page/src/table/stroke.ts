// The controls of a stroke, in a game and in the laboratory: sliders, and a ball to touch for the
// tip.
import type { Cue } from "carom";
import { pad, slider, type Slider, valuesOf } from "../ui.js";
import { texts } from "../texts/texts.js";

export type Stroke = Record<"speed" | "phi" | "right" | "up" | "theta", number>;
/** The cue with a stroke, and the stroke of a cue: a tip to the right has a negative a. */
export const cueWith = (cue: Cue, { speed, phi, right, up, theta }: Stroke): Cue => ({
  ...cue,
  speed,
  phi,
  a: -right || 0,
  b: up,
  theta,
});
export const strokeOf = ({ speed, phi, a, b, theta }: Cue): Stroke => ({
  speed,
  phi,
  right: -a || 0,
  up: b,
  theta,
});

export function strokeControls(speed: Slider, padId: string, changed: () => void) {
  const two = (x: number): string => x.toFixed(2);
  const tipped = (): void => {
    tip.set(sliders.right.value, sliders.up.value);
    changed();
  };
  const sliders: Record<keyof Stroke, Slider> = {
    speed,
    phi: slider("phi", texts.direction, 0, 360, 0.05, "°", changed, two),
    right: slider("right", texts.tipToTheRight, -0.7, 0.7, 0.01, " R", tipped, two),
    up: slider("up", texts.tipAbove, -0.7, 0.7, 0.01, " R", tipped, two),
    theta: slider("theta", texts.buttRaised, 0, 80, 1, "°", changed, (x) => x.toFixed(0)),
  };
  const tip = pad(padId, texts.whereTheTipTouches, (right, up) => {
    set({ right, up });
    changed();
  });
  function set(values: Partial<Stroke>): void {
    for (const [key, x] of Object.entries(values)) sliders[key as keyof Stroke].value = x;
    tip.set(sliders.right.value, sliders.up.value);
  }
  return { sliders, tip: tip.root, set, value: (): Stroke => valuesOf(sliders) };
}
