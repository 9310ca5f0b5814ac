// What the laboratory shows of a shot: its film, its numbers.
import { CaromError, type Cue, type Replayed } from "carom";
import { facing, filmOf, pathsOf } from "../table/filmed.js";
import { el, wrong } from "../ui.js";
import { type Desk, optionsOf, says, suit } from "./desk.js";

/** Shows a stroke, which is played, or the shot of a recording. */
export function present(d: Desk, stroke: Cue, played?: Replayed): void {
  const said = played ? "" : suit(d);
  const { controls, table, balls, names } = d;
  d.recorded = played;
  d.recording.shows(played);
  controls.stroke.set({}); // the tip is where its sliders are
  const begun = performance.now();
  says(d, said);
  try {
    d.shot = played?.film ?? d.carom.simulate(table, balls, stroke, optionsOf(d));
  } catch (error) {
    d.shot = error instanceof CaromError ? error.shot : undefined;
    says(d, wrong(error));
  }
  const computed = performance.now() - begun;
  // Flights are short: their paths need more points.
  const paths = d.shot
    ? pathsOf(d.shot, d.shot.events.some((event) => event.type === "slate") ? 150 : 25, 900)
    : [];
  showNumbers(d);
  d.film.show(filmOf({ table, balls, names, turned: d.faces.map(facing) }, d.shot, paths));
  controls.cost.textContent = `The shot was computed in ${computed.toFixed(1)} ms, and drawn with its paths in ${(performance.now() - begun).toFixed(1)} ms.`;
  window.clearTimeout(d.writing);
  d.writing = window.setTimeout(d.settled, 150);
}

function showNumbers({ controls, shot, balls, names, game, film }: Desk): void {
  const rows: [string, string, string][] = [];
  const contact = shot?.firstContact;
  if (shot) {
    const fell = shot.final
      .map((state, k) =>
        state.label === "pocketed" && balls[k]!.state.label !== "pocketed" ? names[k]! : "",
      )
      .filter((name) => name !== "");
    const cushions = shot.events.filter((event) => event.type === "ball_linear_cushion").length;
    const { r, label } = shot.final[0]!;
    rows.push(
      ["status", "Status", shot.status],
      ["time", "Lasts", `${shot.time.toFixed(3)} s`],
      ["count", "Events", String(shot.count)],
    );
    rows.push([
      "contact",
      "First ball hit",
      contact ? `${names[contact.ball]} after ${contact.time.toFixed(3)} s` : "none",
    ]);
    rows.push(
      ["cushions", "Contacts with cushions", String(cushions)],
      ["pocketed", "Pocketed", fell.join(", ") || "none"],
    );
    rows.push([
      "cue-ball",
      "Cue ball at the end",
      label === "pocketed" ? "in a pocket" : `${r[0].toFixed(4)}, ${r[1].toFixed(4)} m`,
    ]);
  }
  controls.summary.replaceChildren(
    ...rows.map(([id, name, text]) =>
      el("tr", {}, el("th", { scope: "row" }, name), el("td", { id: `s-${id}` }, text)),
    ),
  );
  film.canvas.setAttribute(
    "aria-label",
    `${game.text} table from above. The shot lasts ${shot?.time.toFixed(1) ?? 0} seconds; ${contact ? `ball ${names[contact.ball]} is hit first` : "no ball is hit"}.`,
  );
}
