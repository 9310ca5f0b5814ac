// The view Play: a game on the table, one bar for all that a stroke needs, and its film where one looks.
import { type Call, type Carom, CaromError, type Cue, type PlanOptions, type Player } from "carom";
import { player as filmPlayer } from "../../../player/player.js";
import { pocketName } from "../../../player/words.js";
import { drop, far } from "../far.js";
import { filmOf, lasts, onTable, type Path, pathsOf, product, type Quaternion } from "../table/filmed.js";
import { GAMES } from "../table/games.js";
import { button, eachFrame, el, parameters } from "../ui.js";
import { aiming } from "./aim.js";
import { logPage } from "./coach.js";
import { coaching } from "./coaching.js";
import { controls } from "./controls.js";
import { diagramPage, type Source } from "./diagram.js";
import { OPTIONS, Play, read, type Setup, type Stroke } from "./game.js";
import { guessOf, lookAlong } from "./look.js";
import { kept, keepText, unpack } from "./keep.js";
import { byLink } from "./link.js";
import { menu, type Settings } from "./menu.js";
import { practice } from "./practice.js";
import { Sound } from "./sound.js";
import { Space } from "./space.js";
import { nameOf, wordsOfScore, wordsOfStroke, wordsOfTurn } from "./state.js";
import { wordsOfChoice } from "../table/words.js";

const REPLY = 400;
/** How long the stroke of the page's player is shown before it is played, ms. */
const SHOWN = 700;
/** The power after the break, m/s. */
const SPEED = 2.5;
const SETTINGS = "carom-settings";
const FIRST: Setup = { game: "eightball", against: "500", own: "0", seed: 1 };

export function playView(carom: Carom, main: HTMLElement): { update(): void; theme(): void; close(): void } {
  const coarse = window.matchMedia("(pointer: coarse)").matches;
  const settings: Settings = { sound: !coarse, coach: false, ...(JSON.parse(kept(SETTINGS) ?? "{}") as Partial<Settings>) };
  const sound = new Sound(settings.sound);
  let play: Play;
  /** Which of both sits here; of two at this page, whoever is at the table. */
  let seat: 0 | 1 = 0;
  /**
   * What was chosen to be called, -1: nothing, and the ball that the aim met then: the choice does not hold where the aim meets another one. That of a hint,
   * which has a direction, holds near it only.
   */
  interface Chosen {
    ball: number;
    pocket: number;
    met: number;
    phi?: number;
  }
  const NONE: Chosen = { ball: -1, pocket: -1, met: -1 };
  let chosen = NONE;
  let special: "push" | "pass" | undefined;
  let first: ReturnType<typeof lookAlong>;
  let paths: Path[] = [];
  let turned: Quaternion[] = [];
  let turnedBefore: Quaternion[] = [];
  let thinks = false;
  /** The stroke of the page's player that is shown before it plays. */
  let theirs: Cue | undefined;
  /** What follows the film that is shown. */
  let then: (() => void) | undefined;
  let shown: Stroke | undefined;
  let sounded = 0;
  /** Raised by what ends a search: another game, a stroke. */
  let number = 0;

  // ---- The page ------------------------------------------------------------------------------------------------------------

  /** The aim, the layout or a setting has changed. */
  const changed = eachFrame(() => {
    if (!film.playing && then === undefined) rest();
    if (settings.coach) void coach.chances();
  });
  const turn = el("p", { id: "turn", role: "status" });
  const score = el("p", { id: "score" });
  const said = el("p", { id: "said", role: "status" });
  const film = filmPlayer({ over: (g) => hand?.draw(g), moved, ended: () => finish() });
  /** What the player shows. */
  let filmed: ReturnType<typeof filmOf>;
  function show(of: typeof filmed): void {
    filmed = of;
    film.show(of);
    space.draw();
  }
  const stroke = controls({ changed, shoot, free, told: (text) => (said.textContent = text) });
  const hand = aiming(film, {
    ...{ play: () => play, free, cue, aimed, shoot, skip, changed, first: () => first },
    set: (key, value) => stroke.set({ [key]: value }),
    called: () => (free() && calls() ? called() : undefined),
    tapped: (on) => {
      look();
      const met = first?.ball ?? -1;
      if ("pocket" in on) chosen = { ...valid(), pocket: on.pocket, met };
      else chosen = calls() && ballsOn().includes(on.ball) ? { ball: on.ball, pocket: -1, met } : NONE;
      if ("pocket" in on && calls() && !called()) said.textContent = "Which ball? Tap it first, then the pocket.";
      changed();
    },
    undo: () => undo(),
  });
  const coach = coaching(carom, {
    ...{ play: () => play, free, cue, player, place, told: (text) => (said.textContent = text) },
    search: () => ++number,
    searches: (mine) => mine === number && free(),
    aim(one) {
      if (play.hand !== "no") play.put(0, ...(one.place as [number, number]));
      aim(one.cue);
      look();
      chosen = one.ball > 0 && one.pocket >= 0 ? { ball: one.ball, pocket: one.pocket, met: first?.ball ?? -1, phi: one.cue.phi } : NONE;
      special = one.kind === "push" ? "push" : undefined;
      rest();
    },
  });
  const felt = el("section", { class: "felt", "aria-label": "Table" }, film.canvas);
  const space = new Space(film, felt, {
    ...{ play: () => play, poses: () => filmed.shots[0]!.at(film.time), aimed, first: () => first, skip },
    turn(degrees) {
      if (!free()) return;
      stroke.set({ phi: (stroke.value.phi + degrees + 360) % 360 });
      changed();
    },
  });
  const buttons = {
    menu: button("New game", () => games.open(play.setup), { id: "new-game" }),
    hint: button("Hint", () => void coach.advise(), { id: "hint" }),
    replay: button("Replay", () => replay(), { id: "replay" }),
    undo: button("Undo", () => undo(), { id: "undo-stroke" }),
    rack: button("New rack", () => begin({ ...play.setup, seed: play.setup.seed + 1, at: undefined as never }), { id: "rack-up" }),
    push: button("Push out", () => choose("push"), { id: "push", "aria-pressed": "false" }),
    pass: button("Pass", () => choose("pass"), { id: "pass" }),
    skip: button("Skip", () => skip(), { id: "skip" }),
    link: button("Send link", () => void link.send(coarse), { id: "send" }),
    space: button("3D", () => void toggle(), { id: "space", "aria-pressed": "false", title: "The view from behind the cue" }),
  };
  const log = logPage();
  const training = practice({ begin });
  const copy = button("Link to this game", () => {
    games.root.close();
    void link.send(coarse);
  }, { id: "copy-game" });
  const errors = button("Log of your strokes", () => {
    games.root.close();
    log.open();
  }, { id: "open-log" });
  const diagram = diagramPage(carom, coarse);
  const draw = button("Diagram to print", () => {
    games.root.close();
    const { last } = play;
    const sources: Source[] = last?.shot ? [["the last stroke", last.balls, last.cue]] : [];
    // In a game nobody sees where the balls would go.
    if (play.practice && !play.setup.drill) sources.unshift(["the stroke that is aimed", play.balls, cue()]);
    diagram.open(play.setup.game, [...sources, ["the balls as they lie", play.balls, undefined]]);
  }, { id: "open-diagram" });
  const games = menu(carom, settings, film.pace, { begin, changed: setSettings }, ...training.parts, el("h3", {}, "This game"), el("div", { class: "row" }, copy, errors, draw));
  const bar = el(
    "section",
    { class: "play-bar", "aria-label": "Game" },
    el("div", { class: "words" }, el("div", { class: "row state" }, turn, score), said),
    el("div", { class: "row tools" }, buttons.menu, buttons.hint, buttons.replay, buttons.space, buttons.undo, buttons.rack, buttons.push, buttons.pass, buttons.link),
    el("div", { class: "row strike" }, ...stroke.row.slice(0, -1), buttons.skip, ...stroke.row.slice(-1)),
  );
  main.replaceChildren(el("div", { class: "play" }, felt, stroke.side, bar, stroke.numbers, games.root, log.root, diagram.root, training.photo));

  function setSettings(now: Settings): void {
    Object.assign(settings, now);
    sound.on = now.sound;
    sound.wake();
    keepText(JSON.stringify(settings), SETTINGS);
    changed();
  }
  async function toggle(): Promise<void> {
    try {
      await space.toggle();
    } catch (error) {
      said.textContent = `This browser does not show three dimensions (${error instanceof Error ? error.message : String(error)}).`;
    }
    buttons.space.setAttribute("aria-pressed", String(space.on));
  }
  function moved(): void {
    space.draw();
    if (shown?.shot && film.playing) sound.between(shown.shot.events, sounded, film.time);
    sounded = film.time;
  }

  // ---- The stroke that is aimed ------------------------------------------------------------------------------------------------

  function cue(): Cue {
    const { speed, phi, right, up, theta } = stroke.value;
    return { ...carom.cue({}, GAMES[play.played?.of ?? play.setup.game]!.game), speed, phi, a: -right || 0, b: up, theta };
  }
  function aim(of: Cue): void {
    stroke.set({ speed: of.speed, phi: of.phi, right: -of.a || 0, up: of.b, theta: of.theta });
  }
  const mine = (): boolean => play.winner === undefined && (play.practice || play.setup.against === "person" || play.turn === seat);
  function free(): boolean {
    return !film.playing && !thinks && then === undefined && mine();
  }
  function aimed(): Cue | undefined {
    return free() ? cue() : theirs;
  }
  /** Whether a stroke needs a call. */
  function calls(): boolean {
    return play.played?.calls === true && !play.state.opening && !play.practice;
  }
  const ballsOn = (): number[] => carom.ballsOn(play.state, play.balls);
  /** What was chosen, as far as it holds for the aim. */
  function valid(): Chosen {
    const met = first?.ball ?? -1;
    const off = chosen.phi === undefined ? 0 : Math.abs(((stroke.value.phi - chosen.phi + 540) % 360) - 180);
    return off < 2 && (met === -1 || met === chosen.met) ? chosen : NONE;
  }
  function called(): { ball: number; pocket: number } | undefined {
    const [guess, given] = [guessOf(play.table, first, ballsOn()), valid()];
    const ball = given.ball > 0 ? given.ball : guess.ball;
    const pocket = given.pocket >= 0 ? given.pocket : ball === guess.ball ? guess.pocket : -1;
    return ball > 0 && pocket >= 0 && onTable(play.balls[ball]!.state) ? { ball, pocket } : undefined;
  }
  /** What the stroke that is shown meets first. */
  function look(): void {
    const of = aimed();
    first = of && onTable(play.balls[0]!.state) ? lookAlong(carom, play.table, play.balls, of, OPTIONS) : undefined;
  }
  /** The balls as they lie, with what may be seen of the stroke: in a game the line to the first contact. */
  function rest(): void {
    first = undefined;
    paths = [];
    if (aimed() && onTable(play.balls[0]!.state))
      try {
        if (play.practice && !play.setup.drill) paths = pathsOf(carom.simulate(play.table, play.balls, cue(), OPTIONS));
        look();
      } catch (error) {
        if (!(error instanceof CaromError)) throw error;
        said.textContent = `This stroke cannot be played: ${error.message}.`;
      }
    shown = undefined;
    show(filmOf({ table: play.table, balls: play.balls, names: play.names, turned }, undefined, paths));
    tell();
  }
  function tell(): void {
    const can = free();
    const call = can && calls() ? called() : undefined;
    // What comes of a stroke is told after its film. What is read aloud changes only where the words do.
    const plays = then !== undefined && shown && !play.practice ? nameOf(play, shown.who, seat) : undefined;
    const told = plays ? `${plays} ${plays === "You" ? "play" : "plays"} …` : `${wordsOfTurn(play, seat, thinks)}${call ? ` Call: the ${play.names[call.ball]}, ${pocketName(play.table, call.pocket)}.` : can && calls() ? " Nothing is called: aim at a ball, or tap a pocket." : ""}`;
    if (turn.textContent !== told) turn.textContent = told;
    if (!plays) score.textContent = wordsOfScore(play, seat, racks());
    stroke.shoot.disabled = !can;
    const seen: [HTMLElement, boolean][] = [
      [buttons.hint, play.played !== undefined],
      [buttons.undo, play.practice && !play.setup.drill],
      [buttons.rack, (play.practice && !play.setup.drill) || (play.winner !== undefined && then === undefined)],
      [buttons.push, can && play.state.may === "push"],
      [buttons.pass, can && play.mayPass],
      [buttons.skip, film.playing],
      [stroke.shoot, !film.playing],
      [buttons.link, play.setup.against === "link"],
    ];
    for (const [element, is] of seen) element.hidden = !is;
    // What cannot be pressed now keeps its place, so that the others keep theirs.
    buttons.hint.disabled = !can;
    buttons.replay.disabled = !play.last?.shot || film.playing || thinks || then !== undefined;
    buttons.undo.disabled = play.past.length === 0;
    buttons.push.setAttribute("aria-pressed", String(special === "push"));
    film.canvas.setAttribute("aria-label", `${GAMES[play.played?.of ?? play.setup.game]!.text} table from above. ${turn.textContent}`);
  }
  function choose(what: "push" | "pass"): void {
    if (what === "pass") return played(play.stroke(cue(), "pass"));
    special = special === "push" ? undefined : "push";
    tell();
  }

  // ---- Strokes -----------------------------------------------------------------------------------------------------------------

  function player(rating: string): Player {
    return rating === "0" ? carom.player({ errors: 0 }) : carom.player({ fargo: Number(rating) });
  }
  function call(): Call | undefined {
    if (special) return special;
    return calls() ? called() : undefined;
  }
  function shoot(): void {
    if (!free()) return;
    number++; // a search for a hint ends here
    sound.wake();
    const meant = cue();
    const { own, seed } = play.setup;
    const made = own === "0" || play.practice ? meant : carom.withErrors(meant, player(own), seed, play.entries.length);
    const of = coach.asked();
    try {
      look(); // the aim may have changed since the last frame
      const what = call();
      const one = play.stroke(made, what);
      said.textContent = "";
      if (settings.coach && play.played && play.setup.drill === undefined) void coach.lookBack(of, made, what);
      played(one);
    } catch (error) {
      said.textContent = error instanceof Error ? error.message : String(error);
    }
  }
  /** A stroke was played: its film, and whoever comes next. */
  function played(one: Stroke): void {
    // Nobody breaks twice: the next stroke begins as one of medium speed.
    if (one.state.opening && !play.state.opening) stroke.set({ speed: SPEED });
    chosen = NONE;
    theirs = undefined;
    special = undefined;
    if (play.winner !== undefined) count(play.winner);
    save();
    perform(one, next);
  }
  function perform(one: Stroke, after: () => void): void {
    turnedBefore = turned;
    then = after;
    shown = one;
    sounded = -1;
    if (!one.shot) return finish();
    film.look(1);
    show(filmOf({ table: play.table, balls: one.balls, names: play.names, turned }, one.shot, []));
    film.start();
    tell();
  }
  function finish(): void {
    const after = then;
    if (shown?.shot) {
      const end = shown.shot.orientations(lasts(shown.shot));
      turned = turned.map((q, k) => product(end.subarray(4 * k, 4 * k + 4), q));
    }
    then = undefined;
    after?.();
  }
  function skip(): void {
    if (!film.playing) return;
    film.stop();
    finish();
  }
  function replay(): void {
    const one = play.last;
    if (!one?.shot || film.playing || thinks || then !== undefined) return;
    const now = turned;
    turned = turnedBefore;
    perform(one, () => {
      turned = now;
      rest();
    });
  }
  function undo(): void {
    if (!play.practice || !play.undo()) return;
    save();
    rest();
  }
  /** Whoever comes to the table finds the tip in the middle of the cue ball, and the aim at the nearest ball that is on. */
  function address(): void {
    const r = (ball: number): readonly number[] => play.balls[ball]!.state.r;
    const far = (ball: number): number => Math.hypot(r(ball)[0]! - r(0)[0]!, r(ball)[1]! - r(0)[1]!);
    const [near] = ballsOn().sort((a, b) => far(a) - far(b));
    stroke.set({ right: 0, up: 0, theta: 0 });
    if (near !== undefined) stroke.set({ phi: Math.round(((Math.atan2(r(near)[1]! - r(0)[1]!, r(near)[0]! - r(0)[0]!) * 180) / Math.PI + 360) * 100) / 100 % 360 });
  }
  function next(): void {
    const { drill, at } = play.setup;
    if (drill !== undefined && play.last) {
      const { text, again } = training.played(drill, play.last);
      said.textContent = text;
      // The next try begins where this one began.
      if (again) play.lay(new Play(carom, { ...play.setup, at }).balls);
    }
    if (link.waiting()) return link.onward();
    if (play.last && play.hasPockets && /^\d/.test(play.setup.against) && play.last.who !== seat) said.textContent = wordsOfStroke(play, play.last, seat);
    if (play.winner === undefined && !mine() && /^\d/.test(play.setup.against)) void reply();
    else {
      if (!play.practice && !play.state.opening && play.winner === undefined && mine()) address();
      rest();
    }
    // After a stroke its review is read, until the aim changes.
    if (settings.coach && !play.last) void coach.chances();
  }
  /** Where the cue ball may be put, for a plan. */
  function place(): PlanOptions["inHand"] {
    return play.hand === "kitchen" ? [[0, 0], [play.table.width, play.table.length / 4]] : play.hand !== "no";
  }

  /** The page's player: he plans in a worker, puts the cue ball, and errs. */
  async function reply(): Promise<void> {
    const mine = ++number;
    thinks = true;
    rest();
    const { against, own, seed } = play.setup;
    try {
      const options = { ...play.state, player: player(against), opponent: player(own === "0" ? "700" : own), shot: OPTIONS, seed: seed + play.entries.length, inHand: place()!, best: 1, shots: REPLY };
      const [one] = await far("plan", play.table, play.balls, options);
      if (mine !== number) return;
      if (play.hand !== "no") play.put(0, ...(one!.place as [number, number]));
      theirs = one!.cue;
      rest();
      said.textContent = `${nameOf(play, play.turn, seat)} plays ${wordsOfChoice(play.table, play.names, one!)}.`;
      await new Promise((later) => window.setTimeout(later, film.pace.value === "1000" ? 0 : SHOWN));
      if (mine !== number) return;
      const pot = one!.ball > 0 && one!.pocket >= 0 ? { ball: one!.ball, pocket: one!.pocket } : undefined;
      const given = one!.kind === "push" || one!.kind === "pass" ? one!.kind : pot;
      thinks = false;
      played(play.stroke(carom.withErrors(one!.cue, player(against), seed, play.entries.length), given));
    } catch (error) {
      if (mine !== number) return;
      thinks = false;
      said.textContent = error instanceof Error ? error.message : String(error);
    }
  }

  // ---- Games -------------------------------------------------------------------------------------------------------------------

  const tally = (): Record<string, [number, number]> => JSON.parse(kept("carom-racks") ?? "{}") as Record<string, [number, number]>;
  const key = (): string => `${play.setup.game}/${play.setup.against}`;
  const racks = (): readonly [number, number] => tally()[key()] ?? [0, 0];
  function count(winner: 0 | 1): void {
    const all = tally();
    const one = (all[key()] ??= [0, 0]);
    one[winner]++;
    keepText(JSON.stringify(all), "carom-racks");
  }
  function begin(setup: Setup): void {
    seat = 0;
    start(new Play(carom, JSON.parse(JSON.stringify(setup)) as Setup));
    aim({ ...cue(), theta: 0, ...(play.played?.begin ?? { speed: 4, phi: 62, a: 0, b: 0 }), ...(setup.at === undefined ? {} : { speed: 2, phi: 90 }) });
    said.textContent = setup.drill !== undefined ? training.told(setup.drill) : play.practice ? "Drag balls to lay them, drag on the cloth to aim, tap Shoot." : "Drag on the table to aim, then tap Shoot.";
    save();
    rest();
  }
  function start(with_: Play): void {
    number++;
    drop("plan");
    then = undefined;
    theirs = undefined;
    thinks = false;
    play = with_;
    turned = play.balls.map(() => [1, 0, 0, 0] as const);
    turnedBefore = turned;
    chosen = NONE;
    special = undefined;
    film.stop();
    film.look(1);
  }

  /** Keeps the game: in the browser; one by link in the address and on other pages of this machine. */
  function save(): void {
    if (play.setup.against === "link") return link.save();
    keepText(play.text());
    if (location.hash !== "#view=play" && !parameters().has("d")) history.replaceState(null, "", "#view=play");
  }
  const link = byLink({
    ...{ play: () => play, seat: () => seat, perform, next, rest, told: (text) => (said.textContent = text) },
    busy: () => film.playing || then !== undefined,
    keep() {
      if (play.winner !== undefined) count(play.winner);
      save();
    },
  });

  /** The game of the address, the one that was kept, or a new one. */
  async function resume(): Promise<void> {
    const given = parameters();
    let wrong = "";
    try {
      const packed = given.get("g");
      const text = packed ? await unpack(packed) : kept();
      if (text !== undefined) {
        const one = read(carom, text);
        start(one);
        seat = packed && given.get("seat") === "1" ? 1 : 0;
        aim({ ...cue(), theta: 0, ...(play.state.opening || play.practice ? play.played?.begin : { speed: SPEED }) });
        if (packed && one.entries.length > 0) wrong = `${one.entries.length} ${one.entries.length === 1 ? "stroke was" : "strokes were"} repeated; every bit agrees.`;
        save();
        link.ask();
        said.textContent = wrong;
        if (packed && one.last?.shot && mine()) return perform(one.last, next);
        return next();
      }
    } catch (error) {
      wrong = `The game was not read: ${error instanceof Error ? error.message : String(error)}.`;
    }
    begin({ ...FIRST, seed: Math.floor(Math.random() * 2 ** 31) });
    if (wrong) said.textContent = wrong;
  }
  play = new Play(carom, FIRST);
  start(play);
  rest();
  const asked = parameters().get("d");
  const ready = resume().then(async () => {
    if (!asked) return;
    try {
      await diagram.read(asked);
    } catch (error) {
      said.textContent = `The diagram was not read: ${error instanceof Error ? error.message : String(error)}.`;
    }
  });
  main.setAttribute("aria-busy", "true");
  void ready.then(() => main.setAttribute("aria-busy", "false"));

  return {
    update: () => undefined,
    theme() {
      film.draw();
      diagram.theme();
      space.draw();
    },
    close() {
      space.close();
      number++;
      drop("plan");
      film.stop();
      link.close();
    },
  };
}
