// The view Play: a game on the table, one bar for all that a stroke needs, and its film where one
// looks.
import type { Carom } from "carom";
import { player as filmPlayer } from "../../../player/player.js";
import { drop } from "../far.js";
import { button, eachFrame, el, parameters, wrong } from "../ui.js";
import { aiming, drawAim } from "./aim.js";
import { advise, chances } from "./coaching.js";
import { controls } from "./controls.js";
import { diagramPage, type Source } from "./diagram.js";
import { finish, moved, replay, rest, skip } from "./filming.js";
import { Play } from "./game.js";
import { byLink } from "./link.js";
import { logPage } from "./log.js";
import { menu, settingsOf } from "./menu.js";
import { practice } from "./practice.js";
import { cueOf, NONE, says, type Session } from "./session.js";
import { Sound } from "./sound.js";
import { Space } from "./space.js";
import { begin, choose, FIRST, resume, start, undo } from "./turns.js";

/** The game before it begins, with all that it is played by. */
function sessionOf(carom: Carom, felt: HTMLElement): Session {
  const coarse = window.matchMedia("(pointer: coarse)").matches;
  const settings = settingsOf(coarse);
  const changed = eachFrame(() => {
    if (!s.film.playing && s.then === undefined) rest(s);
    if (settings.coach) void chances(s);
  });
  const bare: Omit<Session, "stroke" | "link" | "training" | "space"> = {
    carom,
    coarse,
    settings,
    changed,
    sound: new Sound(settings.sound),
    words: {
      turn: el("p", { id: "turn", role: "status" }),
      score: el("p", { id: "score" }),
      said: el("p", { id: "said", role: "status" }),
    },
    buttons: {
      menu: button("New game", () => undefined, { id: "new-game" }),
      hint: button("Hint", () => void advise(s), { id: "hint" }),
      replay: button("Replay", () => replay(s), { id: "replay" }),
      undo: button("Undo", () => undo(s), { id: "undo-stroke" }),
      rack: button(
        "New rack",
        () => begin(s, { ...s.play.setup, seed: s.play.setup.seed + 1, at: undefined as never }),
        { id: "rack-up" },
      ),
      push: button("Push out", () => choose(s, "push"), { id: "push", "aria-pressed": "false" }),
      pass: button("Pass", () => choose(s, "pass"), { id: "pass" }),
      skip: button("Skip", () => skip(s), { id: "skip" }),
      link: button("Send link", () => void s.link.send(), { id: "send" }),
      space: button("3D", () => void toggle(s), {
        id: "space",
        "aria-pressed": "false",
        title: "The view from behind the cue",
      }),
    },
    film: filmPlayer({
      hidden: () => s.space?.on,
      over: (g) => drawAim(s, g),
      moved: () => moved(s),
      ended: () => finish(s),
    }),
    play: new Play(carom, FIRST),
    seat: 0,
    chosen: NONE,
    special: undefined,
    hinted: false,
    first: undefined,
    turned: [],
    turnedBefore: [],
    thinks: false,
    theirs: undefined,
    then: undefined,
    shown: undefined,
    filmed: undefined,
    sounded: 0,
    number: 0,
    asking: 0,
  };
  const s = bare as Session;
  felt.append(s.film.canvas);
  return Object.assign(s, {
    stroke: controls(s),
    link: byLink(s),
    training: practice(s.carom, (setup) => begin(s, setup)),
    space: new Space(s, felt),
  });
}
async function toggle(s: Session): Promise<void> {
  try {
    await s.space.toggle();
  } catch (error) {
    says(s, `This browser does not show three dimensions (${wrong(error)}).`);
  }
  s.buttons.space.setAttribute("aria-pressed", String(s.space.on));
}

/** The dialogs of a game: a new one with its settings, the log of strokes, diagrams. */
function dialogs(s: Session): { all: HTMLElement[]; diagram: ReturnType<typeof diagramPage> } {
  const log = logPage(s.training.plan);
  const diagram = diagramPage(s.carom, s.coarse);
  const shut = (text: string, id: string, then: () => void): HTMLElement =>
    button(text, () => (games.root.close(), then()), { id });
  const draw = (): void => {
    const { play } = s;
    const sources: Source[] = play.last?.shot
      ? [["the last stroke", play.last.balls, play.last.cue]]
      : [];
    // In a game nobody sees where the balls would go.
    if (play.practice && !play.setup.drill)
      sources.unshift(["the stroke that is aimed", play.balls, cueOf(s)]);
    diagram.open(play.setup, [...sources, ["the balls as they lie", play.balls, undefined]]);
  };
  const rows = [
    shut("Link to this game", "copy-game", () => void s.link.send()),
    shut("Log of your strokes", "open-log", log.open),
    shut("Diagram to print", "open-diagram", draw),
  ];
  const games = menu(
    s,
    ...s.training.parts,
    el("h3", {}, "This game"),
    el("div", { class: "row" }, ...rows),
  );
  s.buttons.menu.addEventListener("click", games.open);
  return { all: [games.root, log.root, diagram.root, s.training.photo], diagram };
}

export function playView(
  carom: Carom,
  main: HTMLElement,
): { update(): void; theme(): void; close(): void } {
  const felt = el("section", { class: "felt", "aria-label": "Table" });
  const s = sessionOf(carom, felt);
  const { words, buttons, stroke } = s;
  aiming(s);
  const { all, diagram } = dialogs(s);
  const bar = el(
    "section",
    { class: "play-bar", "aria-label": "Game" },
    el(
      "div",
      { class: "words" },
      el("div", { class: "row state" }, words.turn, words.score),
      words.said,
    ),
    el(
      "div",
      { class: "row tools" },
      buttons.menu,
      buttons.hint,
      buttons.replay,
      buttons.space,
      buttons.undo,
      buttons.rack,
      buttons.push,
      buttons.pass,
      buttons.link,
    ),
    el(
      "div",
      { class: "row strike" },
      ...stroke.row.slice(0, -1),
      buttons.skip,
      ...stroke.row.slice(-1),
    ),
  );
  main.replaceChildren(
    el("div", { class: "play" }, felt, stroke.side, bar, stroke.numbers, ...all),
  );

  start(s, s.play);
  rest(s);
  const asked = parameters().get("d");
  const ready = resume(s)
    .then(() => (asked ? diagram.read(asked) : undefined))
    .catch((error: unknown) => says(s, `The diagram was not read: ${wrong(error)}.`));
  main.setAttribute("aria-busy", "true");
  void ready.then(() => main.setAttribute("aria-busy", "false"));

  return {
    update: () => undefined,
    theme() {
      s.film.draw();
      diagram.theme();
      s.space.draw();
    },
    close() {
      s.space.close();
      s.number++;
      drop("plan");
      s.film.stop();
      s.link.close();
    },
  };
}
