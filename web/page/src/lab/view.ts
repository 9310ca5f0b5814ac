// The view Laboratory: a shot is computed again while the player aims, with its film and its
// events.
import type { Carom } from "carom";
import { player } from "../../../player/player.js";
import { button, el, parameters } from "../ui.js";
import { restore, undoing } from "./address.js";
import { controlsOf, cueOf, type Desk, lay } from "./desk.js";
import { drawHand, handle } from "./hand.js";
import { importLine, lineOf } from "./lines.js";
import { reel } from "./reel.js";
import { present } from "./shown.js";
import { texts } from "../texts/texts.js";

function deskOf(carom: Carom, solver: Desk["solver"]): Desk {
  const controls = controlsOf(
    () => d.aimed(),
    () => {
      d.gameName = controls.games.select.value;
      // Three-cushion has no rack to break: a shot of medium speed at an angle shows more.
      controls.set("speed", d.gameName === "threecushion" ? 4 : 8);
      controls.set("phi", d.gameName === "threecushion" ? 62 : 90);
      rackUp(d);
    },
  );
  const film = player({
    over: (g) => drawHand(d, g),
    ended: () => d.recorded && d.recording.advance(),
  });
  const d = {
    carom,
    solver,
    controls,
    film,
    recorded: undefined,
    imported: undefined,
    shot: undefined,
    writing: undefined,
    aimed: () => present(d, cueOf(d)),
  } as unknown as Desk;
  return Object.assign(d, { recording: reel(d) });
}
/** The balls of the game as they begin. */
function rackUp(d: Desk): void {
  lay(d);
  d.recording.close();
  d.aimed();
}

/** The page of the laboratory around its desk. */
function pageOf(d: Desk, tools: HTMLElement): HTMLElement {
  const { controls, film, recording } = d;
  const roots = (...keys: string[]): HTMLElement[] =>
    keys.map((key) => controls.sliders[key]!.root);
  const row = (...parts: HTMLElement[]): HTMLElement => el("div.row", ...parts);
  const out = button(
    texts.exportWord,
    () => {
      controls.line.value = lineOf(d, d.gameName);
      controls.line.select();
    },
    "#export",
  );
  const lines = el(
    "details",
    el("summary", texts.exportAndImport),
    el("label", { for: "line" }, texts.theShotAsThe),
    controls.line,
    row(
      out,
      button(texts.importWord, () => importLine(d), "#import"),
      recording.open,
    ),
  );
  const numbers = el("table#shot-numbers.numbers", el("caption", texts.theShot), controls.summary);
  return el(
    "div.table-view",
    el(
      "section.stage",
      { "aria-label": texts.table },
      film.canvas,
      ...roots("speed"),
      controls.stroke.tip,
    ),
    el("section.bar", { "aria-label": texts.film }, film.controls, recording.bar, tools),
    el(
      "section.panel.aim",
      { "aria-label": texts.theShot },
      ...roots("right", "up", "phi", "theta"),
      row(controls.games.root, controls.cushion.root),
      lines,
    ),
    el(
      "div.below",
      el(
        "section.panel",
        { "aria-label": texts.how },
        ...HELP.map((text) => el("p.note", text)),
        controls.cost,
      ),
      el("section.panel", { "aria-label": texts.theShotInNumbers }, numbers),
      el("section.panel", { "aria-label": texts.whatHappens }, el("h2", texts.events), film.events),
    ),
  );
}

export function laboratory(
  carom: Carom,
  solver: Desk["solver"],
  main: HTMLElement,
): { update(): void; theme(): void } {
  const d = deskOf(carom, solver);
  const { commit, back, nextShot, copyLink } = undoing(d, (past) => (undo.disabled = !past));
  d.settled = commit;
  const undo = button(texts.undo, back, "#undo");
  const rack = button(
    texts.newRack,
    () => {
      d.seed += 1;
      rackUp(d);
    },
    "#rack",
  );
  const next = button(texts.nextShot, nextShot, "#next", { title: texts.theNextShotFrom });
  const page = pageOf(
    d,
    el(
      "div.row",
      undo,
      next,
      button(texts.copyLink, () => void copyLink(), "#copy"),
      rack,
      d.controls.message,
    ),
  );
  main.replaceChildren(page);
  d.recording.accept(page);
  handle(d, back);

  restore(d, parameters());
  commit();
  return { update: d.aimed, theme: d.film.draw };
}

const HELP = [
  texts.dragOnTheCloth,
  texts.clickABallThen,
  texts.dropARecordingOf,
  texts.keysOnTheTable,
];
