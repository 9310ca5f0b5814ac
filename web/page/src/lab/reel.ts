// A recording that was opened: its shots are replayed, compared with the recorded ones, and shown
// one after another.
import type { Replayed } from "carom";
import { button, el, wrong } from "../ui.js";
import { type Desk, type Reel, says } from "./desk.js";
import { showRecorded } from "./lines.js";
import { texts } from "../texts/texts.js";

/** Plays the recording of a file again while it is `wanted`. The page lives meanwhile. */
async function replayed(
  d: Desk,
  file: File,
  isWanted: () => boolean,
): Promise<{ found: Replayed[]; refused: string }> {
  const found: Replayed[] = [];
  try {
    let pause = performance.now() + 30;
    for (const shot of d.carom.replay(await file.text())) {
      found.push(shot);
      if (performance.now() < pause) continue;
      says(d, texts.shotsSoFar(file.name, found.length));
      await new Promise(requestAnimationFrame);
      if (!isWanted()) break;
      pause = performance.now() + 30;
    }
    return { found, refused: "" };
  } catch (error) {
    return { found, refused: wrong(error) };
  }
}

export function reel(d: Desk): Reel {
  let shots: Replayed[] = [];
  let shown = -1;
  let opened = 0;
  const file = el("output#reel-file");
  const output = el("output#reel-shot");
  const back = button(texts.shotBack, () => go(shown - 1), "#reel-back", {
    "aria-label": texts.previousShotOfThe,
  });
  const next = button(texts.shotOn, () => go(shown + 1), "#reel-next", {
    "aria-label": texts.nextShotOfThe,
  });
  const bar = el("div#reel.row", { hidden: "" }, back, next, output, file);
  const input = el("input#recording", { type: "file", accept: ".jsonl,.json,.txt", hidden: "" });
  input.addEventListener("change", () => {
    const [file] = input.files ?? [];
    input.value = ""; // the same file may be opened again
    if (file) void read(file);
  });

  async function read(recording: File): Promise<void> {
    const mine = ++opened;
    const { found, refused } = await replayed(d, recording, () => mine === opened);
    if (mine !== opened) return;
    if (found.length === 0) return says(d, `${recording.name}: ${refused || texts.itHasNoShot}`);
    const differ = found.filter(({ same }) => !same);
    const agrees =
      differ.length === 0
        ? texts.everyBitAgrees
        : texts.shotsDiffer(differ.length, differ[0]!.shot, differ[0]!.line);
    file.value = `${recording.name}: ${texts.shotsCounted(found.length)}, ${agrees}.${refused && texts.theRestIsRefused(refused)}`;
    shots = found;
    bar.hidden = false;
    go(Math.max(found.indexOf(differ[0]!), 0));
  }

  function go(index: number): void {
    shown = index;
    const shot = shots[index]!;
    showRecorded(d, shot, shot.continues ? shots[index - 1]!.film.time : 0);
  }

  function shows(shot: Replayed | undefined): void {
    if (bar.hidden) return;
    back.disabled = shown <= 0;
    next.disabled = shown >= shots.length - 1;
    const where = texts.shotOf(shown + 1, shots.length);
    if (shot === undefined) output.value = texts.wasChanged(where);
    else if (shot.same) output.value = texts.asRecorded(where);
    else {
      const end = ({ status, events, time, hash }: Replayed["played"]): string =>
        texts.eventsSHash(status, events, time.toFixed(6), hash);
      output.value = texts.lineRecordedPlayed(
        where,
        shot.line,
        end(shot.recorded),
        end(shot.played),
      );
    }
  }

  return {
    bar,
    shows,
    open: el(
      "span",
      input,
      button(texts.openRecording, () => input.click(), "#open-recording"),
    ),
    accept(target) {
      target.addEventListener(
        "dragover",
        (event) => event.dataTransfer?.types.includes("Files") && event.preventDefault(),
      );
      target.addEventListener("drop", (event) => {
        const [file] = event.dataTransfer?.files ?? [];
        if (!file) return;
        event.preventDefault();
        void read(file);
      });
    },
    advance() {
      if (shown >= shots.length - 1) return;
      go(shown + 1);
      d.film.start();
    },
    close() {
      opened++;
      bar.hidden = true;
      shots = [];
    },
  };
}
