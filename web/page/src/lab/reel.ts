// A recording that was opened: its shots are played again, compared with what was recorded, and
// shown one after the other.
import type { Replayed } from "carom";
import { button, el, wrong } from "../ui.js";
import { type Desk, type Reel, says } from "./desk.js";
import { showRecorded } from "./lines.js";

/** Plays the recording of a file again while it is `wanted`. The page lives meanwhile. */
async function replayed(
  d: Desk,
  given: File,
  wanted: () => boolean,
): Promise<{ found: Replayed[]; refused: string }> {
  const found: Replayed[] = [];
  try {
    let pause = performance.now() + 30;
    for (const shot of d.carom.replay(await given.text())) {
      found.push(shot);
      if (performance.now() < pause) continue;
      says(d, `${given.name}: ${found.length} shots so far …`);
      await new Promise(requestAnimationFrame);
      if (!wanted()) break;
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
  const file = el("output", { id: "reel-file" });
  const said = el("output", { id: "reel-shot" });
  const back = button("◀ Shot", () => go(shown - 1), {
    id: "reel-back",
    "aria-label": "Previous shot of the recording",
  });
  const next = button("Shot ▶", () => go(shown + 1), {
    id: "reel-next",
    "aria-label": "Next shot of the recording",
  });
  const bar = el("div", { class: "row", id: "reel", hidden: "" }, back, next, said, file);
  const input = el("input", {
    type: "file",
    id: "recording",
    accept: ".jsonl,.json,.txt",
    hidden: "",
  });
  input.addEventListener("change", () => {
    const [given] = input.files ?? [];
    input.value = ""; // the same file may be opened again
    if (given) void read(given);
  });

  async function read(given: File): Promise<void> {
    const mine = ++opened;
    const { found, refused } = await replayed(d, given, () => mine === opened);
    if (mine !== opened) return;
    if (found.length === 0) return says(d, `${given.name}: ${refused || "it has no shot"}`);
    const differ = found.filter(({ same }) => !same);
    const agrees =
      differ.length === 0
        ? "every bit agrees"
        : `${differ.length} ${differ.length === 1 ? "ends" : "end"} otherwise than recorded, first shot ${differ[0]!.shot} (line ${differ[0]!.line})`;
    file.value = `${given.name}: ${found.length} ${found.length === 1 ? "shot" : "shots"}, ${agrees}.${refused && ` The rest is refused: ${refused}`}`;
    shots = found;
    bar.hidden = false;
    go(Math.max(found.indexOf(differ[0]!), 0));
  }

  function go(index: number): void {
    shown = index;
    const one = shots[index]!;
    showRecorded(d, one, one.continues ? shots[index - 1]!.film.time : 0);
  }

  function shows(shot: Replayed | undefined): void {
    if (bar.hidden) return;
    back.disabled = shown <= 0;
    next.disabled = shown >= shots.length - 1;
    const where = `Shot ${shown + 1} of ${shots.length}`;
    if (shot === undefined) said.value = `${where} was changed.`;
    else if (shot.same) said.value = `${where}: as recorded.`;
    else {
      const end = ({ status, events, time, hash }: Replayed["played"]): string =>
        `${status}, ${events} events, ${time.toFixed(6)} s, hash ${hash}`;
      said.value = `${where}, line ${shot.line}: recorded ${end(shot.recorded)}; played ${end(shot.played)}.`;
    }
  }

  return {
    bar,
    shows,
    open: el(
      "span",
      {},
      input,
      button("Open recording", () => input.click(), { id: "open-recording" }),
    ),
    accept(target) {
      target.addEventListener(
        "dragover",
        (event) => event.dataTransfer?.types.includes("Files") && event.preventDefault(),
      );
      target.addEventListener("drop", (event) => {
        const [given] = event.dataTransfer?.files ?? [];
        if (!given) return;
        event.preventDefault();
        void read(given);
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
