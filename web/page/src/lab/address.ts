// The laboratory in the address: what differs from the defaults, undone strokes, the next shot, and
// a link.
import { GAMES } from "../table/games.js";
import { atHead } from "../table/head.js";
import { wrong } from "../ui.js";
import { CUSHIONS, DEFAULTS, type Desk, lay, says } from "./desk.js";
import { placesOf, pocketed } from "../table/places.js";
import { lineOf, take } from "./lines.js";
import { texts } from "../texts/texts.js";

/** All that differs from the defaults. */
function stateOf(d: Desk): Record<string, string> {
  const { controls } = d;
  const settings: Record<string, string> = {};
  if (d.gameName !== "nineball") settings.game = d.gameName;
  if (d.seed !== 1) settings.seed = String(d.seed);
  for (const [key, s] of Object.entries(controls.sliders))
    if (s.value !== DEFAULTS[key]) settings[key] = String(s.value);
  if (controls.cushion.select.value !== "han") settings.cushion = controls.cushion.select.value;
  if (d.solver() === "euler") settings.solver = "euler";
  if (d.imported) settings.line = lineOf(d);
  else if (d.moved || d.faces.some((face) => face !== 0))
    settings.at = d.balls
      .map(({ state: { r, label } }, k) =>
        label === "pocketed" ? "in" : `${r[0]},${r[1]}${d.faces[k] ? `,${d.faces[k]}` : ""}`,
      )
      .join(" ");
  return settings;
}

/** Sets the desk to the values in an address. */
export function restore(d: Desk, query: URLSearchParams): void {
  const { controls } = d;
  const known = (key: string, among: readonly string[]): string =>
    among.includes(query.get(key) ?? "") ? query.get(key)! : among[0]!;
  d.gameName = known("game", Object.keys(GAMES));
  d.seed = Number(query.get("seed") ?? 1);
  if (!Number.isSafeInteger(d.seed) || d.seed < 0) d.seed = 1;
  for (const [key, s] of Object.entries(controls.sliders)) {
    const x = query.has(key) ? Number(query.get(key)) : NaN;
    s.value = Number.isFinite(x) ? x : DEFAULTS[key]!;
  }
  controls.cushion.select.value = known("cushion", CUSHIONS);
  lay(d);
  let refused = "";
  try {
    if (query.has("line")) take(d, query.get("line")!);
    else if (query.has("at")) {
      const places = placesOf(query.get("at")!, d.table, d.balls);
      Object.assign(d, { balls: places.balls, faces: places.faces, moved: true });
    }
  } catch (error) {
    refused = wrong(error);
  }
  controls.line.value = query.get("line") ?? "";
  d.aimed();
  if (refused) says(d, refused);
}

/** Earlier addresses, to undo shots; `changed` reports whether there are any. */
export function undoing(d: Desk, changed: (past: boolean) => void) {
  let committed = "";
  const past: string[] = [];
  /** Writes the address, and remembers the one before. */
  function commit(): void {
    window.clearTimeout(d.writing);
    if (!d.builtIn) return;
    const address = String(new URLSearchParams({ view: "lab", ...stateOf(d) }));
    if (address !== committed) {
      if (committed !== "") past.push(committed);
      history.replaceState(null, "", `#${address}`);
    }
    committed = address;
    changed(past.length > 0);
  }
  function back(): void {
    commit();
    const previous = past.pop();
    if (previous === undefined) return;
    committed = "";
    restore(d, new URLSearchParams(previous));
    commit();
  }
  /** The balls stay where this shot ends. A potted cue ball returns to the head string. */
  function nextShot(): void {
    const { shot, table, carom } = d;
    if (!shot) return;
    commit();
    d.balls = d.balls.map(({ kind }, k) => ({
      kind,
      state: shot.final[k]!.label === "off" ? pocketed(table, shot.final[k]!) : shot.final[k]!,
    }));
    if (d.balls[0]!.state.label === "pocketed") d.balls = atHead(carom, table, d.balls);
    d.moved = true;
    d.aimed();
    commit();
  }
  async function copyLink(): Promise<void> {
    commit();
    if (!d.builtIn) return says(d, texts.aLinkNamesA);
    try {
      await navigator.clipboard.writeText(location.href);
      says(d, texts.theLinkToThis);
    } catch (error) {
      says(d, texts.theBrowserDoesNot(wrong(error)));
    }
  }
  return { commit, back, nextShot, copyLink };
}
