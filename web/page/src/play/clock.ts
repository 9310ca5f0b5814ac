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
/** Where a tab keeps for which stroke the clock runs, and how long it has run, ms: a reload goes on. */
const KEY = "carom-clock";
function usedFor(stroke: string): number {
  try {
    const [of, used] = JSON.parse(sessionStorage.getItem(KEY) ?? "[]") as [string?, number?];
    return of === stroke && Number(used) > 0 ? Number(used) : 0;
  } catch {
    return 0; // the reader has forbidden it
  }
}
function keepUsed(stroke: string, used: number): void {
  try {
    sessionStorage.setItem(KEY, JSON.stringify([stroke, used]));
  } catch {
    // As above: such a browser gives the whole time again.
  }
}

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
    if (next !== stroke) begun = performance.now() - usedFor(next);
    stroke = next;
    const used = performance.now() - begun;
    keepUsed(stroke, used);
    const rest = Math.max(clock - used / 1000, 0);
    const left = Math.ceil(rest);
    s.plates.root.style.setProperty("--time-left", String(rest / clock));
    root.textContent = texts.secondsLeft(left);
    root.classList.toggle("warned", left <= WARNED);
    if (left === 0) runOut(s);
  }
  const timer = window.setInterval(tick, TICK_MS);
  return { root, close: () => window.clearInterval(timer) };
}
