// What a stroke is set by, beside the table: the part of the ball that the aim meets, the tip on a
// ball that one touches, the power, a fine wheel for the aim, and Shoot. Slider and stick set the
// power, and a press of Shoot plays it, however long it is; a press that ends beside the button
// plays nothing.
import { strokeControls } from "../table/stroke.js";
import { button, drags, el, slider } from "../ui.js";
import type { Controls, Session } from "./parts.js";
import { shoot as play } from "./turns.js";
import { texts } from "../texts/texts.js";

const FASTEST = 10;
/** The aim turns by so many degrees for each pixel of the wheel. */
const STEP = 0.02;

function shootButton(s: Session): HTMLButtonElement {
  const shoot = button(texts.shoot, () => undefined, "#shoot.main", {
    title: texts.playsTheStrokeWith,
  });
  let down: number | undefined;
  shoot.addEventListener("pointerdown", ({ button, pointerId }) => {
    if (button > 0) return;
    down = pointerId;
    shoot.setPointerCapture(pointerId);
  });
  shoot.addEventListener("pointerup", ({ pointerId, clientX: x, clientY: y }) => {
    if (pointerId !== down) return;
    down = undefined;
    const { left, right, top, bottom } = shoot.getBoundingClientRect();
    if (x >= left && x <= right && y >= top && y <= bottom) play(s);
  });
  shoot.addEventListener("pointercancel", () => (down = undefined));
  // A finger clicks nothing: Skip is there by now.
  shoot.addEventListener("touchend", (event) => event.cancelable && event.preventDefault());
  shoot.addEventListener("contextmenu", (event) => event.preventDefault());
  // A click without a press is one of the keyboard.
  shoot.addEventListener("click", ({ detail }) => detail === 0 && play(s));
  return shoot;
}

/** A wheel that turns the aim as it is dragged; a tap turns it by a step to its side. */
function wheelOf(turn: (steps: number) => void): HTMLElement {
  const wheel = el(
    "div#wheel",
    { role: "slider", tabindex: "0", "aria-label": texts.fineAim, "aria-valuenow": "0" },
    el("span", `↺ ${STEP}° ↻`),
  );
  let start = 0;
  let last = 0;
  let total = 0;
  const roll = (steps: number): void => {
    total += steps;
    wheel.style.backgroundPositionX = `${total}px`;
    wheel.setAttribute("aria-valuenow", String(total));
    wheel.setAttribute("aria-valuetext", texts.degreesToTheRight((total * STEP).toFixed(2)));
    turn(steps);
  };
  drags(wheel, ({ clientX: x }, first) => {
    if (first) start = x;
    else if (x !== last) roll(x - last);
    last = x;
  });
  wheel.addEventListener("pointerup", ({ clientX: x }) => {
    const { left, width } = wheel.getBoundingClientRect();
    if (Math.abs(x - start) < 3) roll(start - x + Math.sign(x - left - width / 2));
  });
  wheel.addEventListener("keydown", (event) => {
    const steps = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1 }[event.key];
    if (steps === undefined) return;
    event.preventDefault();
    roll(steps);
  });
  return wheel;
}

export function controls(s: Session): Controls {
  const { sliders, tip, set, value } = strokeControls(
    slider("power", texts.power, 0.1, FASTEST, 0.05, "", s.changed, (x) => `${x.toFixed(1)} m/s`),
    "tip-ball",
    s.changed,
  );
  tip.classList.add("grows");
  const shoot = shootButton(s);
  const wheel = wheelOf((steps) => {
    set({ phi: (Math.round((sliders.phi.value - STEP * steps + 360) * 1000) / 1000) % 360 });
    s.changed();
  });
  const part = el("div#part", { role: "img", "aria-label": texts.theAimMeetsNo });
  part.innerHTML =
    '<svg viewBox="-3.1 -1.1 6.2 2.2"><circle r="1" fill="#e8702a" stroke="#000a" stroke-width="0.05"/><circle class="over" r="1" fill="#fbfaf5c0" stroke="#000a" stroke-width="0.05"/></svg>';
  const share = el("span");
  part.append(share);

  return {
    side: el("section.side", { "aria-label": texts.theStroke }, sliders.speed.root, part, tip),
    shoot,
    row: [wheel, shoot],
    numbers: el(
      "details.numbers-of",
      el("summary", texts.strokeInNumbers),
      ...(["phi", "right", "up", "theta"] as const).map((key) => sliders[key].root),
    ),
    set,
    value,
    showContact(contact, name = "") {
      part.style.visibility = contact ? "visible" : "hidden";
      if (!contact) return;
      part
        .querySelector(".over")!
        .setAttribute("cx", String(2 * contact.side * (1 - contact.share)));
      share.textContent = `${Math.round(100 * contact.share)} %`;
      part.setAttribute("aria-label", texts.theAimMeetsOf(share.textContent, name));
    },
  };
}
