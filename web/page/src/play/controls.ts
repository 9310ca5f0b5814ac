// The controls of a stroke next to the table: the overlap of the balls along the aim, the tip on
// the cue ball, the power, a fine wheel for the aim, and Shoot. Releasing a pulled cue plays the
// stroke, unless a setting makes the pull set only the power. Shoot plays with the power that is
// set, however long it is pressed; releasing it outside the button plays nothing.
import { colourOf } from "../../../player/words.js";
import { strokeControls } from "../table/stroke.js";
import { button, drags, el, slider } from "../ui.js";
import { ballMarkup } from "./marks.js";
import type { Controls, Session } from "./parts.js";
import { says } from "./session.js";
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
  const wheel = el("div#wheel", {
    role: "slider",
    tabindex: "0",
    "aria-label": texts.fineAim,
    "aria-valuenow": "0",
  });
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

const SLOWEST = 0.1;
/** A pull that ends within this fraction plays nothing: the cue is back at the ball. */
const REST = 0.05;
/** The power of a pull: fine near the ball. */
const powerOf = (share: number): number =>
  Math.max(Math.round(20 * FASTEST * share ** 1.35) / 20, SLOWEST);

/**
 * A cue beside the table: a pull draws it back, the farther the stronger, and letting go plays the
 * stroke; pushed back to the start it plays nothing. A tap sets the power of its place.
 */
function pullOf(s: Session, speed: () => number, set: (speed: number) => void): HTMLElement {
  const root = el("div.pull", { "aria-hidden": "true" }, el("i"));
  let start = 0;
  let initial = 0; // the power before the pull
  let share = 0;
  let isPulled = false;
  const shareOf = (length: number): number =>
    Math.min(Math.max(length / (0.8 * root.clientHeight), 0), 1);
  const draw = (): void => root.style.setProperty("--pull", String(share));
  drags(root, ({ clientY: y }, first) => {
    if (first) {
      start = y;
      initial = speed();
      isPulled = false;
    }
    share = shareOf(y - start);
    isPulled ||= share > REST;
    if (!isPulled) return;
    draw();
    set(powerOf(share));
  });
  const release = ({ type, clientY: y }: PointerEvent): void => {
    const isLong = share > REST;
    share = 0;
    draw();
    if (!isPulled) return set(powerOf(shareOf(y - root.getBoundingClientRect().top)));
    if (type === "pointercancel" || !isLong) return set(initial);
    if (s.settings.pull) play(s);
  };
  root.addEventListener("pointerup", release);
  root.addEventListener("pointercancel", release);
  return root;
}

export function controls(s: Session): Controls {
  const { sliders, tip, set, value } = strokeControls(
    slider(
      "power",
      texts.power,
      SLOWEST,
      FASTEST,
      0.05,
      "",
      s.changed,
      (x) => `${Math.round((100 * x) / FASTEST)} %`,
    ),
    "tip-ball",
    s.changed,
  );
  tip.classList.add("grows");
  const shoot = shootButton(s);
  const wheel = wheelOf((steps) => {
    set({ phi: (Math.round((sliders.phi.value - STEP * steps + 360) * 1000) / 1000) % 360 });
    s.changed();
  });
  const power = sliders.speed.root;
  power.append(
    pullOf(
      s,
      () => sliders.speed.value,
      (speed) => {
        set({ speed });
        s.changed();
      },
    ),
  );
  const part = button("", () => says(s, texts.overlapMeans(part.ariaLabel!)), "#part", {
    "aria-label": texts.theAimMeetsNo,
  });

  const speedValue = el("output#speed-value");
  return {
    side: el("section.side", { "aria-label": texts.theStroke }, power, part),
    tip,
    shoot,
    row: [wheel, shoot],
    numbers: el(
      "details.numbers-of",
      el("summary", texts.strokeInNumbers),
      el("div.field", el("span", texts.speedOfTheCue), speedValue),
      ...(["phi", "right", "up", "theta"] as const).map((key) => sliders[key].root),
    ),
    set,
    value,
    showContact(contact, name = "") {
      speedValue.textContent = `${sliders.speed.value.toFixed(2)} m/s`;
      power.style.setProperty("--power", String(sliders.speed.value / FASTEST));
      part.style.visibility = contact ? "visible" : "hidden";
      if (!contact) return;
      const { names, balls } = s.play;
      const { ball } = s.first!;
      const colour = colourOf(names[ball]!, ball, balls[ball]!.kind.radius);
      // The cue ball covers the ball that it hits, as the player sees both.
      const over = 2 * contact.side * (1 - contact.share);
      const cueBall = `<circle cx="${over}" r="1" fill="#fbfaf570" stroke="#000a" stroke-width="0.06"/>`;
      const target = ballMarkup(names[ball]!, colour, false);
      part.innerHTML = `<svg viewBox="-3.1 -1.1 6.2 2.2">${target}${cueBall}</svg>`;
      const share = `${Math.round(100 * contact.share)} %`;
      part.setAttribute("aria-label", texts.theAimMeetsOf(share, name));
    },
  };
}
