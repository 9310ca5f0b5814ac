// What the laboratory shows of a shot: its film and its results.
import { CaromError, type Cue, type Replayed } from "carom";
import { facing, filmOf, pathsOf } from "../table/filmed.js";
import { numberRows, wrong } from "../ui.js";
import { type Desk, optionsOf, says, suit } from "./desk.js";
import { texts } from "../texts/texts.js";

/** Shows a stroke, which is played, or the shot of a recording. */
export function present(d: Desk, stroke: Cue, played?: Replayed): void {
  const message = played ? "" : suit(d);
  const { controls, table, balls, names } = d;
  d.recorded = played;
  d.recording.shows(played);
  controls.stroke.set({}); // the tip is where its sliders are
  const begun = performance.now();
  says(d, message);
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
  controls.cost.textContent = texts.theShotWasComputed(
    computed.toFixed(1),
    (performance.now() - begun).toFixed(1),
  );
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
      ["status", texts.status, shot.status],
      ["time", texts.lasts, `${shot.time.toFixed(3)} s`],
      ["count", texts.events, String(shot.count)],
    );
    rows.push([
      "contact",
      texts.firstBallHit,
      contact ? texts.afterS(names[contact.ball], contact.time.toFixed(3)) : texts.none,
    ]);
    rows.push(
      ["cushions", texts.contactsWithCushions, String(cushions)],
      ["pocketed", texts.pocketed, fell.join(", ") || texts.none],
    );
    rows.push([
      "cue-ball",
      texts.cueBallAtThe,
      label === "pocketed" ? texts.inAPocket : `${r[0].toFixed(4)}, ${r[1].toFixed(4)} m`,
    ]);
  }
  controls.summary.replaceChildren(...numberRows("s", rows));
  film.canvas.setAttribute(
    "aria-label",
    texts.tableFromAboveThe(
      game.text,
      shot?.time.toFixed(1) ?? 0,
      contact ? texts.ballIsHitFirst(names[contact.ball]) : texts.noBallIsHit,
    ),
  );
}
