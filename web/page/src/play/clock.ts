// The shot clock of a game: how long the person at this page may take for a stroke. It runs while
// that player may aim. When the time is over, the match rules a foul.
import { el } from "../ui.js";
import type { Session } from "./parts.js";
import { free } from "./session.js";
import { runOut } from "./turns.js";
import { texts } from "../texts/texts.js";

/** How many seconds a stroke may take; the first is no clock. */
export const CLOCKS = ["0", "30", "40", "60"];
const TICK_MS = 200;
/** From how many seconds on the clock is marked. */
const WARNED = 10;

export function shotClock(s: Session): { root: HTMLElement; close(): void } {
  const root = el("p#clock", { role: "timer", hidden: "" });
  let stroke = ""; // for which the clock runs
  let begun = 0; // ms
  function tick(): void {
    const { clock } = s.play.setup;
    const runs = clock !== undefined && free(s);
    root.hidden = !runs;
    s.plates.root.style.setProperty("--time-left", "0");
    if (!runs) return;
    const next = `${s.id} ${s.play.strokes}`;
    if (next !== stroke) begun = performance.now();
    stroke = next;
    const rest = Math.max(clock - (performance.now() - begun) / 1000, 0);
    const left = Math.ceil(rest);
    s.plates.root.style.setProperty("--time-left", String(rest / clock));
    root.textContent = texts.secondsLeft(left);
    root.classList.toggle("warned", left <= WARNED);
    if (left === 0) runOut(s);
  }
  const timer = window.setInterval(tick, TICK_MS);
  return { root, close: () => window.clearInterval(timer) };
}
