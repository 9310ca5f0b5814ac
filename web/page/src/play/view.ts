// The view Play: the table fills the window; around it are both seats, the controls of a stroke,
// and a drawer for the rest.
import type { Carom } from "carom";
import { player as filmPlayer } from "../../../player/player.js";
import { drop } from "../far.js";
import { button, eachFrame, el, parameters, wrong } from "../ui.js";
import { aiming, drawAim } from "./aim.js";
import { shotClock } from "./clock.js";
import { coachPage } from "./coach_page.js";
import { coaching } from "./coaching.js";
import { controls } from "./controls.js";
import { diagramPage, type Source } from "./diagram.js";
import { finish, moved, showing } from "./filming.js";
import { endView } from "./end.js";
import { Play } from "./game.js";
import { isRaceOver, racksOf } from "./keep.js";
import { byLink } from "./link.js";
import { logPage } from "./log.js";
import { keepSettings, menu, settingsOf } from "./menu.js";
import { BUTTONS } from "./named.js";
import { practice } from "./practice.js";
import type { Session } from "./parts.js";
import { plates } from "./plates.js";
import { cueOf, progressOf, says } from "./session.js";
import { onTable } from "../table/filmed.js";
import { Sound } from "./sound.js";
import { Space } from "./space.js";
import { begin, FIRST, resume, start } from "./opening.js";
import { watching } from "./watch.js";
import { choose, concede, mayConcede, togglePush, undo } from "./turns.js";
import { texts, translate } from "../texts/texts.js";

const wordsOf = (): Session["words"] => ({
  turn: el("p#turn", { role: "status" }),
  score: el("p#score.heard"),
  message: el("p#said", { role: "status" }),
});
/** A list of the balls on the table, for people who do not see them; updated at each opening. */
function listOfBalls(s: Session): HTMLDetailsElement {
  const list = el("ul#ball-list");
  const root = el("details", el("summary", texts.whereBallsLie), list);
  root.addEventListener("toggle", () => {
    const { balls, names } = s.play;
    const rows = balls.flatMap(({ state }, k) => {
      if (!onTable(state)) return [];
      const [across, up] = [state.r[0], state.r[1]].map((x) => (100 * x).toFixed(0));
      return el("li", texts.ballLiesAt(translate(names[k]!), across!, up!));
    });
    list.replaceChildren(...rows);
  });
  return root;
}
/** Another rack: the next one of a race, or the first of a new one. */
function beginAgain(s: Session): void {
  const { setup } = s.play;
  const racks = isRaceOver(s.play) ? ([0, 0] as const) : racksOf(s.play);
  const rematch = { ...setup, seed: setup.seed + 1, ...(setup.race !== undefined && { racks }) };
  delete rematch.at; // the balls lie as in a rack
  begin(s, rematch);
}
/** The buttons of the bar; `session` is complete before the first of them is pressed. */
function buttonsOf(session: () => Session): Session["buttons"] {
  const named = (
    id: string,
    text: string,
    press: (s: Session) => unknown,
    more: Record<string, string> = {},
  ): HTMLButtonElement => button(text, () => void press(session()), `#${id}`, { ...more });
  return {
    menu: named("new-game", texts.newGame, () => undefined),
    hint: named("hint", texts.hint, (s) => s.coach.advise()),
    coach: named("coach-menu", texts.coach, () => undefined),
    replay: named("replay", texts.replay, (s) => s.showing.replay()),
    undo: named("undo-stroke", texts.undo, undo),
    rack: named("rack-up", texts.newRack, beginAgain),
    push: named("push", texts.pushOut, togglePush, { "aria-pressed": "false" }),
    skip: named("skip", texts.skip, (s) => s.showing.skip()),
    link: named("send", texts.sendLink, (s) => s.link.send()),
    sound: named("sound", "♪", toggleSound, {
      "aria-label": texts.sound,
      "aria-pressed": "true",
      title: texts.soundOnOrOff,
    }),
    space: named("space", "3D", toggle, {
      "aria-pressed": "false",
      title: texts.theViewFromBehind,
    }),
  };
}

/** The game before it begins, with all that it is played by. */
function sessionOf(carom: Carom, felt: HTMLElement): Session {
  const coarse = window.matchMedia("(pointer: coarse)").matches;
  const settings = settingsOf();
  const changed = eachFrame(() => {
    if (!s.film.playing && s.continuation === undefined) s.showing.rest();
    if (settings.coach) void s.coach.chances();
  });
  const film = filmPlayer({
    hidden: () => s.space?.isOn,
    backdrop: (view) => s.space?.backdrop(view) ?? false,
    over: (g) => drawAim(s, g),
    moved: () => moved(s),
    ended: () => finish(s),
  });
  // Its parts refer to the session, which is complete once all of them are made.
  const s = progressOf(new Play(carom, FIRST)) as Session;
  Object.assign(s, {
    carom,
    coarse,
    settings,
    film,
    changed,
    sound: new Sound(settings.sound),
    words: wordsOf(),
    buttons: buttonsOf(() => s),
    choices: BUTTONS.map((act) => [act, button("", () => choose(s, act), `#${act}`)]),
  });
  const session = Object.assign(s, {
    showing: showing(s),
    coach: coaching(s),
    end: endView(
      s,
      () => beginAgain(s),
      () => s.buttons.menu.click(),
    ),
    stroke: controls(s),
    link: byLink(s),
    watching: watching(s),
    training: practice(carom, (setup) => begin(s, setup)),
    space: new Space(s, felt),
    plates: plates(s),
  });
  felt.append(film.canvas, session.end.root);
  return session;
}
function toggleSound(s: Session): void {
  const isOn = !s.settings.sound;
  s.settings.sound = isOn;
  s.sound.isOn = isOn;
  s.sound.wake();
  keepSettings(s);
  s.buttons.sound.setAttribute("aria-pressed", String(isOn));
}
async function toggle(s: Session): Promise<void> {
  try {
    await s.space.toggle();
  } catch (error) {
    says(s, texts.thisBrowserDoesNotShow(wrong(error)));
  }
}

/** The dialogs of a game: a new one with its settings, the log of strokes, diagrams. */
function dialogs(s: Session): { overlays: HTMLElement[]; diagram: ReturnType<typeof diagramPage> } {
  const log = logPage(s.training.plan);
  const coach = coachPage(s);
  s.buttons.coach.addEventListener("click", coach.open);
  const diagram = diagramPage(s.carom, s.coarse);
  const shut = (text: string, id: string, action: () => void): HTMLElement => {
    const press = (): void => {
      games.root.close();
      action();
    };
    return button(text, press, `#${id}`);
  };
  const draw = (): void => {
    const { play } = s;
    const sources: Source[] = play.last?.shot
      ? [[texts.theLastStroke, play.last.balls, play.last.cue]]
      : [];
    // In a game nobody sees where the balls would go.
    if (play.practice && !play.setup.drill)
      sources.unshift([texts.theStrokeThatIs, play.balls, cueOf(s)]);
    diagram.open(play.setup, [...sources, [texts.theBallsAsThey, play.balls, undefined]]);
  };
  // The first press shows what the second one does.
  const give = button(
    texts.concede,
    () => {
      if (give.textContent === texts.concede) {
        give.textContent = texts.giveTheGameTo;
        return;
      }
      games.root.close();
      concede(s);
    },
    "#concede",
  );
  const rows = [
    shut(texts.linkToThisGame, "copy-game", () => void s.link.send()),
    shut(texts.watchThisGame, "watch-game", () => s.watching.enter()),
    shut(texts.logOfYourStrokes, "open-log", log.open),
    shut(texts.diagramToPrint, "open-diagram", draw),
    give,
  ];
  const games = menu(s, ...s.training.parts, el("h3", texts.thisGame), el("div.row", ...rows));
  s.buttons.menu.addEventListener("click", () => {
    give.textContent = texts.concede;
    give.hidden = !mayConcede(s.play) || s.watched !== undefined;
    games.open();
  });
  return {
    overlays: [games.root, games.calibration, coach.root, log.root, diagram.root],
    diagram,
  };
}

/** How long a message is shown, ms: three seconds, or the time to read it. */
const readingTime = (text: string): number => Math.max(3000, 75 * text.length);
/** Messages over the stage, which fade once they were read or the table is touched. */
function fadingWords({ words }: Session, clock: HTMLElement, felt: HTMLElement): HTMLElement {
  let timer = 0;
  const fade = (): void => words.message.classList.add("read");
  const show = (): void => {
    const { message } = words;
    message.classList.remove("read");
    // Only a message that is cut off takes touches; others leave them to the table below.
    message.classList.toggle("cut", message.scrollHeight > message.clientHeight + 1);
    window.clearTimeout(timer);
    timer = window.setTimeout(fade, readingTime(message.textContent!));
  };
  new MutationObserver(show).observe(words.message, { childList: true });
  const root = el("div.words", { tabindex: "0" }, words.turn, words.score, clock, words.message);
  root.addEventListener("pointerdown", show);
  felt.addEventListener("pointerdown", fade);
  return root;
}
/** What is needed now and then, behind one button: numbers, sound, the other views. */
function drawerOf({ buttons, stroke }: Session, list: HTMLElement) {
  const frame = ["header", "footer"].map((tag) => document.querySelector(tag)!);
  const [header, footer] = frame;
  const root = el(
    "aside.drawer",
    { "aria-label": texts.more, hidden: "" },
    el("div.row", buttons.sound, header!),
    stroke.numbers,
    list,
    footer!,
  );
  const toggle = (isOpen: boolean): void => {
    root.hidden = !isOpen;
    opener.setAttribute("aria-expanded", String(isOpen));
  };
  const opener = button("☰", () => toggle(root.hidden), "#more", {
    "aria-label": texts.more,
    "aria-expanded": "false",
  });
  root.addEventListener("keydown", ({ key }) => {
    if (key !== "Escape") return;
    toggle(false);
    opener.focus();
  });
  /** Gives the frame of the page back to the other views. */
  const close = (): void => {
    document.body.prepend(header!);
    document.getElementById("main")!.after(footer!);
  };
  return { root, opener, toggle, close };
}

export function playView(
  carom: Carom,
  main: HTMLElement,
): { update(): void; theme(): void; close(): void } {
  const felt = el("section.felt", { "aria-label": texts.table });
  const s = sessionOf(carom, felt);
  const { buttons, stroke } = s;
  aiming(s);
  const { overlays, diagram } = dialogs(s);
  const clock = shotClock(s);
  const bar = el(
    "section.play-bar",
    { "aria-label": texts.game },
    fadingWords(s, clock.root, felt),
    el(
      "div.row.tools",
      buttons.menu,
      buttons.hint,
      buttons.coach,
      buttons.replay,
      buttons.undo,
      buttons.rack,
      buttons.push,
      ...s.choices.map(([, button]) => button),
      buttons.link,
    ),
    s.watching.root,
    el("div.row.strike", ...stroke.row.slice(0, -1), buttons.skip, ...stroke.row.slice(-1)),
  );
  const drawer = drawerOf(s, listOfBalls(s));
  felt.addEventListener("pointerdown", () => drawer.toggle(false));
  const top = el("div.top", drawer.opener, s.plates.root, buttons.space);
  main.replaceChildren(
    el("div.play", top, drawer.root, felt, stroke.side, stroke.tip, bar, ...overlays),
  );

  start(s, s.play, "");
  buttons.sound.setAttribute("aria-pressed", String(s.settings.sound));
  s.showing.rest();
  // The drawn view appears at once; the scene follows below it.
  void s.space.prepare();
  const packed = parameters().get("d");
  const ready = resume(s)
    .then(() => (packed ? diagram.read(packed) : undefined))
    .catch((error: unknown) => says(s, texts.theDiagramWasNot(wrong(error))));
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
      drawer.close();
      clock.close();
      s.space.close();
      s.searchGeneration++;
      drop("plan");
      s.film.stop();
      s.link.close();
    },
  };
}
