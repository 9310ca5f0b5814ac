// The view Laboratory: shots are aimed on it and played while one aims; their film, their events, and a fan of shots with a player's error.
import { type Carom, CaromError, type Cue, fromLine, type Line, type Replayed, type Shot, type ShotBall, type ShotOptions, type Table, toLine, words } from "carom";
import { player } from "../../../player/player.js";
import { pocketName } from "../../../player/words.js";
import { facing, filmOf, onTable, type Path, pathsOf } from "../table/filmed.js";
import { GAMES, gameOf, type GameOf, type Read, TABLES } from "../table/games.js";
import { atHead } from "../table/head.js";
import { button, check, choice, eachFrame, el, pad, parameters, slider, type Slider } from "../ui.js";
import { advicePanel } from "./advice.js";
import { FAN, fan } from "./fan.js";
import { hand, pocketed } from "./hand.js";
import { reel } from "./reel.js";
import { drawSide, flies } from "./side.js";

const DEFAULTS: Record<string, number> = { speed: 8, phi: 90, right: 0, up: 0.25, theta: 0, error: 0.3 };
/** Models of the cushion, the page's own choice first. */
const about: ReadonlyMap<string, string> = new Map(words.cushionModel);
const CUSHIONS = ["han", ...[...about.keys()].filter((word) => word !== "han")];

export function laboratory(carom: Carom, solver: () => "exact" | "euler", main: HTMLElement): { update(): void; theme(): void } {
  let gameName: string;
  let seed: number;
  let game: GameOf;
  let table: Table;
  let balls: ShotBall[];
  let names: string[];
  /** Whether balls lie elsewhere than in the rack; the cue of a line that was read; how each ball is turned, degrees. */
  let moved = false;
  let imported: Cue | undefined;
  /** Whether the balls are those of the game by their numbers, so that its rules hold. */
  let known = true;
  /** Whether the address can name the table. */
  let builtIn = true;
  /** The shot of a recording that is shown. */
  let recorded: Replayed | undefined;
  let faces: number[];
  /** The object ball that was picked, for pockets. */
  let chosen = -1;
  let shot: Shot | undefined;

  // ---- Controls ------------------------------------------------------------------------------------------------------------

  const two = (x: number): string => x.toFixed(2);
  const sliders: Record<string, Slider> = {
    speed: slider("speed", "Speed of the cue", 0.1, 10, 0.05, " m/s", aimed, two),
    phi: slider("phi", "Direction", 0, 360, 0.05, "°", aimed, two),
    right: slider("right", "Tip to the right (+) or left", -0.7, 0.7, 0.01, " R", aimed, two),
    up: slider("up", "Tip above (+) or below", -0.7, 0.7, 0.01, " R", aimed, two),
    theta: slider("theta", "Butt raised by", 0, 80, 1, "°", aimed, (x) => x.toFixed(0)),
    error: slider("error", "Player's error of direction", 0.05, 2, 0.05, "°", aimed, two),
  };
  const set = (key: string, value: number): void => void (sliders[key]!.value = value);
  const spin = pad("spin", "Where the tip touches the cue ball", (right, up) => {
    set("right", right);
    set("up", up);
    aimed();
  });
  const games = choice("game", "Game", Object.entries(GAMES).map(([key, { text }]) => [key, text] as const), () => {
    gameName = games.select.value;
    // Three-cushion has no rack to break: a shot of medium speed at an angle shows more.
    set("speed", gameName === "threecushion" ? 4 : 8);
    set("phi", gameName === "threecushion" ? 62 : 90);
    rackUp();
  });
  const cushion = choice("cushion", "Cushions", CUSHIONS.map((word) => [word, `${word}: ${about.get(word)}`] as const), aimed);
  const fanned = check("fan", `Fan: ${FAN} shots with a player's error`, aimed);
  const side = el("canvas", { class: "scene", id: "side-scene", role: "img", "aria-label": "The table from the side: heights of the balls" });
  const sidePanel = el("div", { id: "side-view", hidden: "" }, el("p", { class: "note" }, "From the side; heights are enlarged."), side);
  const summary = el("tbody");
  const message = el("p", { class: "error", role: "status", id: "message" });
  const line = el("textarea", { id: "line", spellcheck: "false" });
  const cost = el("p", { class: "note", id: "cost" });
  let desk: ReturnType<typeof hand> | undefined;
  const film = player({ under: drawFan, over: (g) => desk?.draw(g), moved: () => !sidePanel.hidden && drawHeights(), ended: () => recorded && recording.advance() });
  const { canvas } = film;
  const advice = advicePanel(carom, {
    name: () => (known ? gameName : ""),
    table: () => table,
    balls: () => balls,
    names: () => names,
    cue,
    options,
    aim(stroke) {
      aim(stroke);
      aimed();
    },
  });
  const recording = reel(carom, { show: showRecorded, start: film.start, tell: (text) => (message.textContent = text) });
  const undo = button("Undo", back, { id: "undo" });
  const next = button("Next shot", nextShot, { id: "next", title: "The next shot, from where the balls of this one end" });

  main.replaceChildren(
    el(
      "div",
      { class: "table-view" },
      el(
        "section",
        { class: "stage", "aria-label": "Table" },
        canvas,
        sliders.speed!.root,
        spin.root,
      ),
      el("section", { class: "bar", "aria-label": "Film" }, film.controls, recording.bar, el("div", { class: "row" }, undo, next, button("Copy link", () => void copyLink(), { id: "copy" }), button("New rack", newRack, { id: "rack" }), message)),
      el(
        "section",
        { class: "panel aim", "aria-label": "The shot" },
        ...["right", "up", "phi", "theta"].map((key) => sliders[key]!.root),
        el("div", { class: "row" }, games.root, cushion.root),
        fanned.root,
        sliders.error!.root,
        el("details", {}, el("summary", {}, "Export and import"), el("label", { for: "line" }, "The shot as the line that carom shoot reads"), line, el("div", { class: "row" }, button("Export", exportLine, { id: "export" }), button("Import", importLine, { id: "import" }), recording.open)),
      ),
      el(
        "div",
        { class: "below" },
        el("div", { class: "stack" }, advice.root, el("section", { class: "panel", "aria-label": "How" }, sidePanel, ...HELP.map((text) => el("p", { class: "note" }, text)), cost)),
        el("section", { class: "panel", "aria-label": "The shot in numbers" }, el("table", { class: "numbers", id: "shot-numbers" }, el("caption", {}, "The shot"), summary)),
        el("section", { class: "panel", "aria-label": "What happens" }, el("h2", {}, "Events"), film.events),
      ),
    ),
  );

  recording.accept(main.firstElementChild as HTMLElement);

  // ---- The shot ------------------------------------------------------------------------------------------------------------

  function cue(): Cue {
    const v = (key: string): number => sliders[key]!.value;
    return { ...(imported ?? carom.cue({}, game.game)), speed: v("speed"), phi: v("phi"), a: -v("right") || 0, b: v("up"), theta: v("theta") };
  }
  /** Sets the sliders to a stroke. */
  function aim(stroke: Cue): void {
    for (const key of ["speed", "phi", "theta"] as const) set(key, stroke[key]);
    set("right", -stroke.a || 0);
    set("up", stroke.b);
  }
  function options(): ShotOptions {
    const euler = solver() === "euler";
    const model = cushion.select.value as NonNullable<ShotOptions["cushionModel"]>;
    return { ballModel: euler ? "euler" : "exact", cushionModel: euler && model === "mathavan" ? "euler" : model };
  }

  function lay(): void {
    game = GAMES[gameName]!;
    games.select.value = gameName;
    table = carom.table(game.table);
    const kind = carom.kind(game.game);
    balls = carom.rack(game.rack, table, { seed }).map(({ state }) => ({ kind, state }));
    names = balls.map((_, k) => game.names(k));
    faces = balls.map(() => 0);
    chosen = -1;
    moved = false;
    imported = undefined;
    known = builtIn = true;
  }
  /** The balls of the game as they begin. */
  function rackUp(): void {
    lay();
    recording.close();
    aimed();
  }
  function newRack(): void {
    seed += 1;
    rackUp();
  }

  /** Plays the shot as it is aimed now, from its start. */
  function aimed(): void {
    present(cue());
    advice.aimed();
  }

  function present(stroke: Cue, played?: Replayed): void {
    recorded = played;
    recording.shows(played);
    sliders.error!.input.disabled = !fanned.input.checked;
    spin.set(sliders.right!.value, sliders.up!.value);
    const begun = performance.now();
    message.textContent = "";
    try {
      shot = played?.film ?? carom.simulate(table, balls, stroke, options());
    } catch (error) {
      shot = error instanceof CaromError ? error.shot : undefined;
      message.textContent = error instanceof Error ? error.message : String(error);
    }
    const computed = performance.now() - begun;
    // Flights are short: their paths need more points.
    paths = shot ? pathsOf(shot, shot.events.some((event) => event.type === "slate") ? 150 : 25, 900) : [];
    fanLayer = undefined;
    fanNumber++;
    tell();
    film.show(filmOf({ table, balls, names, turned: faces.map(facing) }, shot, paths));
    if (!sidePanel.hidden) drawHeights();
    cost.textContent = `The shot was computed in ${computed.toFixed(1)} ms, and drawn with its paths in ${(performance.now() - begun).toFixed(1)} ms.`;
    if (fanned.input.checked) void drawnFan();
    window.clearTimeout(writing);
    writing = window.setTimeout(commit, 150);
  }

  let paths: Path[] = [];

  function tell(): void {
    const rows: [string, string, string][] = [];
    const contact = shot?.firstContact;
    if (shot) {
      const fell = shot.final.map((state, k) => (state.label === "pocketed" && balls[k]!.state.label !== "pocketed" ? names[k]! : "")).filter((name) => name !== "");
      const cushions = shot.events.filter((event) => event.type === "ball_linear_cushion").length;
      rows.push(["status", "Status", shot.status], ["time", "Lasts", `${shot.time.toFixed(3)} s`], ["count", "Events", String(shot.count)]);
      rows.push(["contact", "First ball hit", contact ? `${names[contact.ball]} after ${contact.time.toFixed(3)} s` : "none"]);
      rows.push(["cushions", "Contacts with cushions", String(cushions)], ["pocketed", "Pocketed", fell.join(", ") || "none"]);
      const { r } = shot.final[0]!;
      rows.push(["cue-ball", "Cue ball at the end", shot.final[0]!.label === "pocketed" ? "in a pocket" : `${r[0].toFixed(4)}, ${r[1].toFixed(4)} m`]);
    }
    summary.replaceChildren(...rows.map(([id, name, text]) => el("tr", {}, el("th", { scope: "row" }, name), el("td", { id: `s-${id}` }, text))));
    canvas.setAttribute("aria-label", `${game.text} table from above. The shot lasts ${shot?.time.toFixed(1) ?? 0} seconds; ${contact ? `ball ${names[contact.ball]} is hit first` : "no ball is hit"}.`);
    sidePanel.hidden = !flies(paths, balls);
  }

  const drawHeights = (): void => drawSide(side, { table, balls, names }, paths, shot, film.time);

  // ---- The state in the address, undo, the next shot -----------------------------------------------------------------------------

  let writing: number | undefined;
  let committed = "";
  const past: string[] = [];

  /** All that differs from the defaults. */
  function state(): Record<string, string> {
    const kept: Record<string, string> = {};
    if (gameName !== "nineball") kept.game = gameName;
    if (seed !== 1) kept.seed = String(seed);
    for (const [key, s] of Object.entries(sliders)) if (s.value !== DEFAULTS[key]) kept[key] = String(s.value);
    if (cushion.select.value !== "han") kept.cushion = cushion.select.value;
    if (fanned.input.checked) kept.fan = "1";
    if (solver() === "euler") kept.solver = "euler";
    if (imported) kept.line = toLine({ tableName: game.table, balls, cue: cue(), names });
    else if (moved || faces.some((face) => face !== 0)) kept.at = balls.map(({ state: { r, label } }, k) => (label === "pocketed" ? "in" : `${r[0]},${r[1]}${faces[k] ? `,${faces[k]}` : ""}`)).join(" ");
    return kept;
  }
  /** Writes the address once nothing has changed for a moment, and remembers the one before. */
  function commit(): void {
    window.clearTimeout(writing);
    if (!builtIn) return;
    const now = String(new URLSearchParams({ view: "lab", ...state() }));
    if (now !== committed) {
      if (committed !== "") past.push(committed);
      history.replaceState(null, "", `#${now}`);
    }
    committed = now;
    undo.disabled = past.length === 0;
  }
  function restore(given: URLSearchParams): void {
    const known = (key: string, among: readonly string[]): string => (among.includes(given.get(key) ?? "") ? given.get(key)! : among[0]!);
    gameName = known("game", Object.keys(GAMES));
    seed = Number(given.get("seed") ?? 1);
    if (!Number.isSafeInteger(seed) || seed < 0) seed = 1;
    for (const [key, s] of Object.entries(sliders)) {
      const x = given.has(key) ? Number(given.get(key)) : NaN;
      s.value = Number.isFinite(x) ? x : DEFAULTS[key]!;
    }
    cushion.select.value = known("cushion", CUSHIONS);
    fanned.input.checked = given.get("fan") === "1";
    lay();
    let wrong = "";
    try {
      if (given.has("line")) take(given.get("line")!);
      else if (given.has("at")) takePlaces(given.get("at")!);
    } catch (error) {
      wrong = error instanceof Error ? error.message : String(error);
    }
    line.value = given.get("line") ?? "";
    aimed();
    if (wrong) message.textContent = wrong;
  }
  function takePlaces(text: string): void {
    const places = text.split(" ").map((place) => (place === "in" ? undefined : place.split(",").map(Number)));
    if (places.length !== balls.length || !places.every((place) => place === undefined || (place.length >= 2 && place.every(Number.isFinite)))) throw new TypeError(`at: ${balls.length} places x,y are needed, with "in" for a ball in a pocket`);
    balls = balls.map((ball, k) => ({ kind: ball.kind, state: places[k] ? { ...ball.state, r: [places[k][0]!, places[k][1]!, ball.kind.radius] } : pocketed(table, ball.state) }));
    faces = places.map((place) => place?.[2] ?? 0);
    moved = true;
  }

  function back(): void {
    commit();
    const to = past.pop();
    if (to === undefined) return;
    committed = "";
    restore(new URLSearchParams(to));
    commit();
  }
  /** Balls lie where this shot ends. A cue ball that fell comes back to the head string. */
  function nextShot(): void {
    if (!shot) return;
    commit();
    balls = balls.map(({ kind }, k) => {
      const state = shot!.final[k]!;
      return { kind, state: state.label === "off" ? pocketed(table, state) : state };
    });
    if (balls[0]!.state.label === "pocketed") balls = atHead(carom, table, balls);
    moved = true;
    aimed();
    commit();
  }
  async function copyLink(): Promise<void> {
    commit();
    if (!builtIn) return void (message.textContent = "A link names a built-in table; the recording has another one.");
    try {
      await navigator.clipboard.writeText(location.href);
      message.textContent = "The link to this shot is copied.";
    } catch (error) {
      message.textContent = `The browser does not let the page copy (${error instanceof Error ? error.message : String(error)}). The address of the page is the link.`;
    }
  }

  // ---- The fan -------------------------------------------------------------------------------------------------------------

  let fanNumber = 0;
  let fanLayer: HTMLCanvasElement | undefined;
  function drawFan(g: CanvasRenderingContext2D): boolean {
    if (fanLayer) g.drawImage(fanLayer, 0, 0, canvas.clientWidth, canvas.clientHeight);
    return fanLayer !== undefined;
  }
  function drawnFan(): Promise<void> {
    const mine = fanNumber;
    const of = { table, balls, names, cue: cue(), options: options(), sigma: sliders.error!.value, canvas, place: film.place };
    return fan(carom, of, () => mine === fanNumber && canvas.isConnected, (layer, shots, ms) => {
      fanLayer = layer;
      if (!film.playing) film.draw();
      cost.textContent = `The fan shows ${shots} of ${FAN} shots, which the library computed in ${ms.toFixed(0)} ms.`;
    });
  }

  // ---- Lines ---------------------------------------------------------------------------------------------------------------

  function exportLine(): void {
    line.value = toLine({ id: gameName, tableName: game.table, balls, cue: cue(), names });
    line.select();
  }
  function importLine(): void {
    try {
      const { name, also, known } = take(line.value);
      aimed();
      if (also) message.textContent = `The balls are read as those of ${GAMES[name]!.text}. If they are of ${GAMES[also]!.text}, choose this game and import again.`;
      else if (!known) message.textContent = "Best shot needs balls that have the numbers of a game: in nine-ball with ball 9, in eight-ball with ball 8.";
    } catch (error) {
      message.textContent = error instanceof Error ? error.message : String(error);
    }
  }
  function take(text: string): Read<Line> {
    const read = fromLine(carom, text);
    if (read.cue.ball !== 0) throw new TypeError("cue.ball: this page strikes the first ball; put the cue ball first");
    return use(gameOf(read, gameName));
  }
  function use<L extends Line>(read: Read<L>): Read<L> {
    gameName = read.name;
    lay();
    game = { ...GAMES[gameName]!, table: read.line.tableName };
    ({ balls, names, table, cue: imported } = read.line);
    known = read.known;
    faces = balls.map(() => 0);
    moved = true;
    aim(read.line.cue);
    return read;
  }
  /** A shot of a recording, which has neither names of balls nor of the table: they are those of the game that it fits. */
  function showRecorded(one: Replayed, from: number): void {
    const same = JSON.stringify(one.table);
    const tableName = TABLES.find((name) => JSON.stringify(carom.table(name)) === same);
    const name = tableName && tableName in GAMES ? tableName : one.balls.length > 10 ? "eightball" : "nineball";
    use(gameOf({ ...one, id: "", balls: [...one.balls], tableName: tableName ?? "9ft", names: one.balls.map((_, k) => GAMES[name]!.names(k)) }, name));
    builtIn = tableName !== undefined;
    present(cue(), one);
    film.go(from);
  }

  // ---- Pockets ---------------------------------------------------------------------------------------------------------------

  /** Aims so that a ball rolls to a pocket: the one that was picked, or else the one that is hit now. */
  function aimAt(pocket: number): void {
    const ball = chosen > 0 ? chosen : (shot?.firstContact?.ball ?? -1);
    const name = `ball ${names[ball]} into the ${pocketName(table, pocket)}`;
    if (ball < 0) return void (message.textContent = "Which ball? Click it first, then the pocket.");
    const pot = carom.aim(table, balls, cue(), { ball, pocket }, options());
    const { is, met } = pot;
    if (is !== "no_way") {
      set("phi", Math.round(pot.cue.phi * 1e4) / 1e4);
      aimed();
    }
    const [of, other] = [names[met?.a ?? 0], met?.type === "ball_ball" ? names[met.b] : "a cushion"];
    const why = { falls: "", no_way: "", stick: "the stick would have to be raised too far", rejected: "the jaws send it back", short: `ball ${of} comes to rest on its way`, barred: `ball ${of} meets ${other}` }[is];
    const [low, high] = pot.speed.map((speed) => speed.toFixed(1));
    if (is === "no_way") message.textContent = `No such aim: no direction sends ${name}.`;
    else if (is !== "falls") message.textContent = `Aimed, but ${name} does not fall: ${why}.`;
    else message.textContent = `Aimed: ${name}. The cut is ${Math.abs(pot.cut).toFixed(1)}°, its way may turn by ${pot.margin.toFixed(2)}° to either side, and it falls at ${low} to ${high} m/s.`;
  }

  // ---- Pointer and keys ----------------------------------------------------------------------------------------------------

  const soon = eachFrame(aimed);
  desk = hand(carom, film, {
    get table() {
      return table;
    },
    get balls() {
      return balls;
    },
    set balls(layout) {
      balls = layout;
      moved = true;
    },
    get faces() {
      return faces;
    },
    get chosen() {
      return chosen;
    },
    set chosen(ball) {
      chosen = ball;
    },
    get cue() {
      return cue();
    },
    get contact() {
      return shot?.firstContact;
    },
    value: (key) => sliders[key]!.value,
    ...{ set, aimed, soon, aimAt, undo: back },
  });

  restore(parameters());
  commit();
  return { update: aimed, theme: film.draw };
}

const HELP = [
  "Drag on the cloth to aim, drag a ball to move it, and drag the stick to set the speed. A ball on the wood is in a pocket: drag it back onto the table.",
  "Click a ball, then a pocket: the page aims there. The yellow handle of a ball that is picked, or the wheel, turns it in place.",
  "Drop a recording of carom record on the page: it is played again and compared, shot by shot.",
  "Keys on the table: ← → turn the aim (with Shift 1°), ↑ ↓ change the speed, Alt and arrows move the picked ball by 1 mm (with Shift 10), comma and full stop turn it, Ctrl Z undoes, space plays.",
];