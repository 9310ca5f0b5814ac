// What a stroke is set by, beside the table: the tip on a ball that one touches, the power, small turns, and Shoot. A tap of Shoot plays; held, it draws the
// stick, and plays when it is let go. A second finger, Escape, or the field that appears above it calls the stroke off.
import { strokeControls } from "../table/stroke.js";
import { button, el, slider, type Slider } from "../ui.js";
import { free, says, type Session } from "./session.js";
import { shoot as play } from "./turns.js";

const FASTEST = 10;
/** A tap of Shoot is shorter than TAP; the stick is drawn from HELD on, and takes DRAWN to its end, ms. Between TAP and HELD nothing is played. */
const [TAP, HELD, DRAWN] = [280, 600, 1600];

interface Hold {
  id: number;
  since: number;
  /** The power that was set. */
  speed: number;
  drawn: boolean;
  over: AbortController;
}
/** The power of a stick that is drawn for a time: up, and down again. */
function power(ms: number): number {
  const x = (ms / DRAWN) % 2;
  return Math.round(100 * (0.3 + (FASTEST - 0.3) * (x < 1 ? x : 2 - x) ** 1.5)) / 100;
}

/** The button Shoot, and the field above it by which a stroke is called off. */
function shootButton(s: Session, slider: Slider): { shoot: HTMLButtonElement; zone: HTMLElement } {
  const shoot = button("Shoot", () => undefined, { id: "shoot", class: "main", title: "Tap: the stroke has the power that is set. Hold: the stick is drawn until you let go." });
  const zone = el("span", { id: "call-off", hidden: "" }, "Slide here to cancel");
  let hold: Hold | undefined;
  /** Whether the click that follows a press plays nothing. */
  let spent = false;
  function release(): void {
    hold!.over.abort();
    hold = undefined;
    zone.hidden = true;
    shoot.textContent = "Shoot";
  }
  function callOff(): void {
    spent = true;
    if (hold!.drawn) slider.value = hold!.speed;
    release();
    s.changed();
    says(s, "The stroke was called off.");
  }
  /** Draws the stick while it is held. */
  function grow(mine: Hold): void {
    if (hold !== mine) return;
    const ms = performance.now() - mine.since - HELD;
    if (ms > 0) {
      mine.drawn = true;
      zone.hidden = false;
      shoot.textContent = "Let go to play";
      slider.value = power(ms);
      s.changed();
    }
    requestAnimationFrame(() => grow(mine));
  }
  shoot.addEventListener("pointerdown", (event) => {
    if (event.button > 0 || hold || !free(s)) return;
    const mine: Hold = (hold = { id: event.pointerId, since: event.timeStamp, speed: slider.value, drawn: false, over: new AbortController() });
    spent = false;
    shoot.setPointerCapture(event.pointerId);
    requestAnimationFrame(() => grow(mine));
    // A second finger, wherever it is, or Escape calls the stroke off and does nothing else.
    const stop = (event: Event): void => {
      if (event instanceof KeyboardEvent ? event.key !== "Escape" : (event as PointerEvent).pointerId === mine.id) return;
      event.preventDefault();
      event.stopImmediatePropagation();
      callOff();
    };
    for (const type of ["pointerdown", "keydown"]) window.addEventListener(type, stop, { capture: true, signal: mine.over.signal });
  });
  shoot.addEventListener("pointerup", (event) => {
    if (event.pointerId !== hold?.id) return;
    const { drawn, since } = hold;
    const { left, right, top, bottom } = shoot.getBoundingClientRect();
    const { clientX: x, clientY: y } = event;
    if (drawn && (x < left - 30 || x > right + 30 || y < top || y > bottom + 30)) return callOff();
    release();
    spent = drawn || event.timeStamp - since > TAP;
    if (drawn) play(s);
    else if (spent) says(s, "Nothing was played. Tap Shoot shortly, or hold it until the stick is drawn.");
  });
  shoot.addEventListener("pointercancel", (event) => event.pointerId === hold?.id && callOff());
  // Such a finger clicks nothing: Skip is there by now.
  shoot.addEventListener("touchend", (event) => spent && event.cancelable && event.preventDefault());
  shoot.addEventListener("contextmenu", (event) => event.preventDefault());
  // A click without a press is one of the keyboard.
  shoot.addEventListener("click", (event) => {
    if (!(spent && event.detail > 0)) play(s);
    spent = false;
  });
  return { shoot, zone };
}

/** Turns the aim by a little, and on while it is held. */
function turns(text: string, label: string, turn: () => void): HTMLElement {
  const one = button(text, () => undefined, { "aria-label": label, class: "turn" });
  let holding = 0;
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

export function controls(s: Session) {
  const { sliders, tip, set, value } = strokeControls(slider("power", "Power", 0.1, FASTEST, 0.05, "", s.changed, (x) => `${x.toFixed(1)} m/s`), "tip-ball", s.changed);
  tip.classList.add("grows");
  const turnBy = (by: number) => (): void => {
    set({ phi: Math.round((sliders.phi.value + by + 360) * 1000) / 1000 % 360 });
    s.changed();
  };
  const { shoot, zone } = shootButton(s, sliders.speed);

  return {
    side: el("section", { class: "side", "aria-label": "The stroke" }, sliders.speed.root, tip),
    shoot,
    row: [turns("↺", "Turn the aim to the left by 0.05 degrees", turnBy(0.05)), zone, shoot, turns("↻", "Turn the aim to the right by 0.05 degrees", turnBy(-0.05))],
    numbers: el("details", { class: "numbers-of" }, el("summary", {}, "Stroke in numbers"), ...(["phi", "right", "up", "theta"] as const).map((key) => sliders[key].root)),
    ...{ set, value },
  };
}
