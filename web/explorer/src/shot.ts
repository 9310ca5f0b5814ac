// The view Table: shots are aimed on it and played while one aims; their film, their events, and a fan of shots with a player's error.
import { type BallState, type Carom, CaromError, type Cue, fromLine, type Line, type Replayed, type Shot, type ShotBall, type ShotOptions, type Table, toLine, words } from "carom";
import { colourOf, player, pocketName, wordsOf } from "../../../cli/player.js";
import { gamePanel } from "./game.js";
import { GAMES, gameOf, type GameOf, type Read, TABLES } from "./games.js";
import { reel } from "./reel.js";
import { button, check, choice, color, eachFrame, el, fit, pad, parameters, slider, type Slider } from "./ui.js";

const FAN = 500;
const FAN_CHUNK = 20;
const FAN_ROOM = 400;
const DEFAULTS: Record<string, number> = { speed: 8, phi: 90, right: 0, up: 0.25, theta: 0, error: 0.3 };
const DEGREES = 180 / Math.PI;
/** How far the stick is drawn back for each m/s, m. */
const PULL = 0.04;
/** How long a ball falls in a pocket, about, s. */
const FALL = 0.16;
/** How long the film of a shot is: a ball that was pocketed at the end falls after it. */
const lasts = ({ time, status, events }: Shot): number => (status === "ok" && events.at(-1)?.type === "ball_pocket" ? time + FALL : time);
/** Models of the cushion, the page's own choice first. */
const about: ReadonlyMap<string, string> = new Map(words.cushionModel);
const CUSHIONS = ["han", ...[...about.keys()].filter((word) => word !== "han")];
const onTable = ({ label }: Pick<BallState, "label">): boolean => label !== "pocketed" && label !== "off";

export function shotView(carom: Carom, solver: () => "exact" | "euler", main: HTMLElement): { update(): void; theme(): void } {
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
  const film = player({ under: drawFan, over: drawAim, moved: () => !sidePanel.hidden && drawSide(), ended: () => finished(), still: () => match.busy() });
  const { canvas } = film;
  const match = gamePanel(carom, {
    name: () => (known ? gameName : ""),
    table: () => table,
    balls: () => balls,
    names: () => names,
    cue,
    options,
    aim(stroke) {
      aim(stroke);
      present(cue());
      match.aimed();
    },
    lay(layout) {
      balls = layout;
      moved = true;
      present(cue());
    },
    perform(stroke, then) {
      present(stroke);
      ended = then;
      if (shot) film.start();
      else finished();
    },
    rackUp: () => rackUp(false),
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
        el("div", { class: "stack" }, match.root, el("section", { class: "panel", "aria-label": "How" }, sidePanel, ...HELP.map((text) => el("p", { class: "note" }, text)), cost)),
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
    ended = undefined;
  }
  /** The balls of the game as they begin. It ends a game that is played, unless that begins with it. */
  function rackUp(ends = true): void {
    lay();
    recording.close();
    if (ends) match.begin();
    aimed();
  }
  function newRack(): void {
    seed += 1;
    rackUp();
  }

  /** Plays the shot as it is aimed now, from its start. */
  function aimed(): void {
    if (match.busy()) return;
    present(cue());
    match.aimed();
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
    paths = shot ? sample(shot, shot.events.some((event) => event.type === "slate") ? 150 : 25, 900) : [];
    fanLayer = undefined;
    fanNumber++;
    tell();
    film.show({ table, balls: balls.map(({ kind }, k) => ({ name: names[k]!, radius: kind.radius })), shots: [filmed()] });
    if (!sidePanel.hidden) drawSide();
    cost.textContent = `The shot was computed in ${computed.toFixed(1)} ms, and drawn with its paths in ${(performance.now() - begun).toFixed(1)} ms.`;
    if (fanned.input.checked) void fan(fanNumber);
    window.clearTimeout(writing);
    writing = window.setTimeout(commit, 150);
  }

  /** What the player shows of the shot: without one, the balls as they lie. */
  function filmed(): Parameters<typeof film.show>[0]["shots"][number] {
    const played = shot;
    // How balls are turned at the start: about the vertical.
    const turned = faces.map((face) => [Math.cos(face / DEGREES / 2), Math.sin(face / DEGREES / 2)] as const);
    return {
      time: played ? lasts(played) : 0,
      at(time) {
        // Balls that fall in their pockets lie elsewhere than in the frame.
        const places = played?.positionsAt([time], true);
        const frame = played?.frame(time);
        return balls.map(({ state }, k) => {
          const [c, s] = turned[k]!;
          const [w, i, j, n] = frame ? frame.turned.subarray(4 * k, 4 * k + 4) : [1, 0, 0, 0];
          const r = places ? [...places.subarray(3 * k, 3 * k + 3)] : state.r;
          const label = frame?.label(k) ?? state.label;
          return { r, q: [w! * c - n! * s, i! * c + j! * s, j! * c - i! * s, n! * c + w! * s], seen: onTable({ label }) || (played !== undefined && r[2]! > played.final[k]!.r[2] && label === "pocketed") };
        });
      },
      paths,
      events: (played?.events ?? []).map(({ time, type, a, b }) => ({ time, text: wordsOf(table, names, type, a, b) })),
    };
  }

  let paths: { ball: number; xyz: Float64Array }[] = [];
  /** The path of each ball that moves: at every event, and so often a second between. */
  function sample(shot: Shot, often = 25, most = 500): typeof paths {
    const times = shot.events.map((event) => event.time);
    const count = Math.min(Math.ceil(shot.time * often), most);
    for (let k = 0; k <= count; k++) times.push((shot.time * k) / Math.max(count, 1));
    for (const event of shot.events) if (event.type === "ball_pocket") for (let k = 1; k <= 8; k++) times.push(event.time + (FALL * k) / 8);
    times.sort((a, b) => a - b);
    const moving = new Set(shot.events.flatMap((event) => (event.type === "ball_ball" ? [event.a, event.b] : [event.a])));
    const found = [...moving].map((ball) => ({ ball, xyz: new Float64Array(3 * times.length) }));
    const all = shot.positionsAt(times.map((t) => Math.min(t, lasts(shot))), true);
    times.forEach((_, k) => {
      for (const path of found) for (let c = 0; c < 3; c++) path.xyz[3 * k + c] = all[3 * (k * shot.balls.length + path.ball) + c]!;
    });
    return found;
  }

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
    sidePanel.hidden = !paths.some(({ xyz, ball }) => xyz.some((z, k) => k % 3 === 2 && z > balls[ball]!.kind.radius + 1e-6));
  }

  /** Is called at the end of a film of the game. */
  let ended: (() => void) | undefined;
  function finished(): void {
    const then = ended;
    ended = undefined;
    if (then) then();
    else if (recorded) recording.advance();
  }

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
    const now = String(new URLSearchParams({ view: "shot", ...state() }));
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
    match.begin();
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
    balls = balls.map((ball, k) => ({ kind: ball.kind, state: places[k] ? { ...ball.state, r: [places[k][0]!, places[k][1]!, ball.kind.radius] } : pocketed(ball.state) }));
    faces = places.map((place) => place?.[2] ?? 0);
    moved = true;
  }
  const pocketed = (from: BallState): BallState => {
    const [pocket] = table.pockets;
    return pocket ? { r: [...pocket.centre, -pocket.depth], v: [0, 0, 0], w: [0, 0, 0], label: "pocketed" } : from;
  };

  /** Whether a game is played, whose balls lie as it left them. It says so. */
  function inGame(): boolean {
    if (match.hand() === undefined) return false;
    message.textContent = "In a game the balls stay where they are. New rack ends it.";
    return true;
  }
  function back(): void {
    if (inGame()) return;
    commit();
    const to = past.pop();
    if (to === undefined) return;
    committed = "";
    restore(new URLSearchParams(to));
    commit();
  }
  /** Balls lie where this shot ends. A cue ball that fell comes back to the head string. */
  function nextShot(): void {
    if (inGame() || !shot) return;
    commit();
    balls = balls.map(({ kind }, k) => {
      const state = shot!.final[k]!;
      return { kind, state: state.label === "off" ? pocketed(state) : state };
    });
    if (balls[0]!.state.label === "pocketed") balls = match.atHead(balls);
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
  /** Two draws from a normal distribution, by Box and Muller. */
  function normal(): [number, number] {
    const radius = Math.sqrt(-2 * Math.log(1 - Math.random()));
    const angle = 2 * Math.PI * Math.random();
    return [radius * Math.cos(angle), radius * Math.sin(angle)];
  }
  async function fan(number: number): Promise<void> {
    const layer = document.createElement("canvas");
    layer.width = canvas.width;
    layer.height = canvas.height;
    const g = layer.getContext("2d")!;
    g.setTransform(window.devicePixelRatio || 1, 0, 0, window.devicePixelRatio || 1, 0, 0);
    const sigma = sliders.error!.value;
    const aim = cue();
    const shots = carom.shots(table, balls, FAN_CHUNK, { room: FAN_ROOM });
    let computed = 0;
    for (let done = 0; done < FAN; done += FAN_CHUNK) {
      await new Promise(requestAnimationFrame);
      if (number !== fanNumber) return shots.free();
      const begun = performance.now();
      for (let k = 0; k < FAN_CHUNK; k++) {
        const [turned, faster] = normal();
        shots.setCue(k, { ...aim, phi: aim.phi + sigma * turned, speed: aim.speed * Math.max(0.1, 1 + 0.03 * faster) });
      }
      carom.simulateBatch(shots, options());
      computed += performance.now() - begun;
      for (let k = 0; k < FAN_CHUNK; k++) {
        if (shots.status[k]! < 0 || shots.events(k) > FAN_ROOM) continue;
        const one = shots.shot(k);
        // Paths of the cue ball, and where every ball comes to rest.
        g.strokeStyle = "#ffffff";
        g.globalAlpha = 0.045;
        g.lineWidth = 1.4;
        g.beginPath();
        for (const { ball, xyz } of sample(one, 20, 200)) {
          if (ball !== 0) continue;
          for (let t = 0; t < xyz.length && xyz[t + 2]! > 0; t += 3) g[t === 0 ? "moveTo" : "lineTo"](...film.place(xyz[t]!, xyz[t + 1]!));
        }
        g.stroke();
        g.globalAlpha = 0.25;
        one.final.forEach((state, ball) => {
          if (!onTable(state) || !onTable(balls[ball]!.state)) return;
          g.fillStyle = colourOf(names[ball]!, ball);
          g.beginPath();
          g.arc(...film.place(state.r[0], state.r[1]), 2, 0, 7);
          g.fill();
        });
      }
      fanLayer = layer;
      if (!film.playing) film.draw();
      cost.textContent = `${done + FAN_CHUNK} of ${FAN} shots of the fan; the library took ${computed.toFixed(0)} ms for them.`;
    }
    shots.free();
  }

  // ---- Drawing -------------------------------------------------------------------------------------------------------------

  /** Balls that are not on the table wait on the wood beside it, in this order from the head. */
  const waits = (): number[] => balls.flatMap(({ state }, k) => (onTable(state) ? [] : [k]));
  const waitsAt = (index: number): [number, number] => [-0.045, 0.12 + 0.075 * index + (0.12 + 0.075 * index > table.length / 2 - 0.1 ? 0.2 : 0)];
  /** Whether a ball is picked that lies on the table; the handle that turns it, 36 pixels from its middle. */
  const canTurn = (): boolean => chosen > 0 && onTable(balls[chosen]!.state);
  function turner(): [number, number] {
    const { r } = balls[chosen]!.state;
    const [away, face] = [36 / film.scale, faces[chosen]! / DEGREES];
    return [r[0] + away * Math.cos(face), r[1] + away * Math.sin(face)];
  }
  const stickEnd = (speed: number): number => balls[0]!.kind.radius + PULL * speed;

  /** At the start of the film: the ball that is picked, the stick, the ghost ball and the tangent line. */
  function drawAim(g: CanvasRenderingContext2D): void {
    waits().forEach((k, index) => film.drawBall(g, k, { r: [...waitsAt(index), 0], q: [1, 0, 0, 0], seen: true }, 1));
    if (film.time > 0 || film.playing) return;
    const { phi, theta, speed, ball: struck } = cue();
    if (struck !== 0) return;
    const R = balls[0]!.kind.radius;
    const { r } = balls[0]!.state;
    const [dx, dy] = [Math.cos(phi / DEGREES), Math.sin(phi / DEGREES)];
    const stroke = (from: readonly number[], to: readonly number[], width: number, style: string): void => {
      g.strokeStyle = style;
      g.lineWidth = width;
      g.beginPath();
      g.moveTo(...film.place(from[0]!, from[1]!));
      g.lineTo(...film.place(to[0]!, to[1]!));
      g.stroke();
    };
    const ring = (at: readonly number[], more: number): void => {
      g.beginPath();
      g.arc(...film.place(at[0]!, at[1]!), R * film.scale + more, 0, 7);
      g.stroke();
    };
    const contact = shot?.firstContact;
    if (contact) {
      const { event, ball } = contact;
      const [ghost, object] = event.a === ball ? [event.before[1]!.r, event.before[0]!.r] : [event.before[0]!.r, event.before[1]!.r];
      const [nx, ny] = [(object[0] - ghost[0]) / (2 * R), (object[1] - ghost[1]) / (2 * R)];
      g.setLineDash([5, 4]);
      stroke(object, [object[0] + 0.35 * nx, object[1] + 0.35 * ny], 1.4, "#ffffffd0");
      // The tangent line, on the side to which the cue ball goes.
      const turn = Math.sign(dx * -ny + dy * nx) || 1;
      stroke(ghost, [ghost[0] - 0.35 * turn * ny, ghost[1] + 0.35 * turn * nx], 1.4, "#ffffffd0");
      g.lineWidth = 1.4;
      ring(ghost, 0);
      g.setLineDash([]);
    }
    if (canTurn()) {
      g.strokeStyle = g.fillStyle = "#ffe28a";
      g.lineWidth = 2;
      ring(balls[chosen]!.state.r, 3);
      g.beginPath();
      g.arc(...film.place(...turner()), 6, 0, 7);
      g.fill();
    }
    if (!onTable(balls[0]!.state)) return;
    const at = (s: number): [number, number] => [r[0] - dx * s, r[1] - dy * s];
    const gap = stickEnd(speed);
    g.lineCap = "round";
    stroke(at(gap), at(gap + 1.3 * Math.max(Math.cos(theta / DEGREES), 0.15)), 5, "#d9b077");
    stroke(at(gap), at(gap + 0.017), 4, "#3f7fbf");
  }

  /** Height over length: paths of balls that leave the cloth, and the balls now. */
  function drawSide(): void {
    const { g, width, height } = fit(side, 0.18);
    const across = width / (table.length + 0.2);
    let highest = 0;
    for (const { xyz, ball } of paths) for (let k = 2; k < xyz.length; k += 3) highest = Math.max(highest, xyz[k]! + balls[ball]!.kind.radius);
    const up = Math.min(3 * across, (height - 14) / highest);
    const at = (y: number, z: number): [number, number] => [(y + 0.1) * across, height - 8 - z * up];
    g.fillStyle = color("back");
    g.fillRect(0, 0, width, height);
    g.fillStyle = color("cloth");
    g.fillRect(0, height - 8, width, 8);
    for (const { ball, xyz } of paths) {
      g.strokeStyle = ball === 0 ? color("text") : colourOf(names[ball]!, ball);
      g.lineWidth = 1.5;
      g.beginPath();
      for (let k = 0; k < xyz.length; k += 3) {
        if (xyz[k + 2]! < 0) break;
        g[k === 0 ? "moveTo" : "lineTo"](...at(xyz[k + 1]!, xyz[k + 2]!));
      }
      g.stroke();
    }
    shot?.states(film.time).forEach((state, k) => {
      if (!onTable(state)) return;
      g.beginPath();
      g.ellipse(...at(state.r[1], state.r[2]), balls[k]!.kind.radius * across, balls[k]!.kind.radius * up, 0, 0, 7);
      g.fillStyle = colourOf(names[k]!, k);
      g.fill();
      g.strokeStyle = "#000a";
      g.stroke();
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
      match.begin();
      aimed();
      if (also) message.textContent = `The balls are read as those of ${GAMES[name]!.text}. If they are of ${GAMES[also]!.text}, choose this game and import again.`;
      else if (!known) message.textContent = "Best shot needs the balls of a game by their numbers, in nine-ball with ball 9, in eight-ball with ball 8.";
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
    match.begin();
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
    const why = { falls: "", no_way: "", rejected: "the jaws send it back", short: `ball ${of} comes to rest on its way`, barred: `ball ${of} meets ${other}` }[is];
    const [low, high] = pot.speed.map((speed) => speed.toFixed(1));
    if (is === "no_way") message.textContent = `No such aim: no direction sends ${name}.`;
    else if (is !== "falls") message.textContent = `Aimed, but ${name} does not fall: ${why}.`;
    else message.textContent = `Aimed: ${name}, a cut of ${Math.abs(pot.cut).toFixed(1)}°, ${pot.margin.toFixed(2)}° to either jaw, falls at ${low} to ${high} m/s.`;
  }

  // ---- Pointer and keys ----------------------------------------------------------------------------------------------------

  const soon = eachFrame(aimed);
  type Grip = { is: "ball"; ball: number } | { is: "pocket"; pocket: number } | { is: "stick" | "line" | "cloth" | "turn" };
  let held: { grip: Grip; at: [number, number]; from: [number, number]; value: number; taps: boolean } | undefined;
  const position = (event: { clientX: number; clientY: number }): [number, number] => {
    const box = canvas.getBoundingClientRect();
    return film.unplace(event.clientX - box.left, event.clientY - box.top);
  };
  /** What lies under a pointer. A finger reaches farther. */
  function under([x, y]: [number, number], finger: boolean): Grip {
    const reach = (finger ? 22 : 12) / film.scale;
    const near = ([px, py]: readonly number[]): number => Math.hypot(px! - x, py! - y);
    const places = balls.map(({ state }) => (onTable(state) ? state.r : undefined));
    waits().forEach((k, index) => (places[k] = [...waitsAt(index), 0]));
    const nearest = places.reduce((best, place, k) => (near(place!) < near(places[best]!) ? k : best), 0);
    if (canTurn() && near(turner()) < Math.min(reach, near(places[nearest]!))) return { is: "turn" };
    if (near(places[nearest]!) < Math.max(1.2 * balls[nearest]!.kind.radius, reach)) return { is: "ball", ball: nearest };
    const pocket = table.pockets.findIndex(({ centre, radius }) => near(centre) < radius + 0.01);
    if (pocket >= 0) return { is: "pocket", pocket };
    // Along the line of aim, from the cue ball.
    const { phi, speed } = cue();
    const { r } = balls[0]!.state;
    const [dx, dy] = [Math.cos(phi / DEGREES), Math.sin(phi / DEGREES)];
    const along = (x - r[0]) * dx + (y - r[1]) * dy;
    if (Math.abs((y - r[1]) * dx - (x - r[0]) * dy) < reach) {
      if (along < 0 && -along > stickEnd(speed) - reach && -along < stickEnd(speed) + 1.3) return { is: "stick" };
      if (along > 0) return { is: "line" };
    }
    return { is: "cloth" };
  }
  const angleOf = ([x, y]: readonly [number, number], ball = 0): number => Math.atan2(y - balls[ball]!.state.r[1], x - balls[ball]!.state.r[0]) * DEGREES;
  function turnTo(phi: number): void {
    set("phi", Math.round((((phi % 360) + 360) % 360) * 100) / 100);
    soon();
  }
  function drag(at: [number, number]): void {
    if (!held || match.busy()) return;
    const { grip, from, value } = held;
    if (grip.is === "ball") moveBall(grip.ball, at);
    else if (grip.is === "turn") turnBall(chosen, value + angleOf(at, chosen) - angleOf(from, chosen) - faces[chosen]!);
    else if (grip.is === "stick") {
      const back = (x: [number, number]): number => Math.hypot(x[0] - balls[0]!.state.r[0], x[1] - balls[0]!.state.r[1]);
      set("speed", Math.round(Math.min(Math.max(value + (back(at) - back(from)) / PULL, 0.1), 10) * 100) / 100);
      soon();
    } else if (grip.is === "line") turnTo(value + angleOf(at) - angleOf(from));
    else if (grip.is === "cloth") turnTo(angleOf(at));
    held.at = at;
  }
  function turnBall(ball: number, degrees: number): void {
    faces[ball] = (Math.round(faces[ball]! + degrees) + 720) % 360;
    soon();
  }
  /** Puts a ball where there is room, beside another one if need be. Off the table it waits in a pocket; the cue ball does not. */
  function moveBall(ball: number, [x, y]: [number, number]): void {
    const hand = match.hand();
    if (hand === "no" || (hand !== undefined && ball !== 0)) return void inGame();
    const R = balls[ball]!.kind.radius;
    const inside = (v: number, most: number): number => Math.min(Math.max(v, R + 1e-4), most - R - 1e-4);
    const out = Math.max(-x, x - table.width, -y, y - table.length) > 1.5 * R;
    if (out && ball !== 0 && table.pockets.length > 0) {
      balls = balls.map((one, k) => (k === ball ? { kind: one.kind, state: pocketed(one.state) } : one));
    } else {
      let [px, py] = [inside(x, table.width), inside(y, hand === "kitchen" ? table.length / 4 + R : table.length)];
      const other = balls.find(({ state }, k) => k !== ball && onTable(state) && Math.hypot(state.r[0] - px, state.r[1] - py) < 2 * R + 1e-5);
      if (other) {
        const [ox, oy] = other.state.r;
        const far = Math.hypot(px - ox, py - oy) || 1;
        [px, py] = [ox + ((px - ox) / far) * (2 * R + 2e-5), oy + ((py - oy) / far) * (2 * R + 2e-5)];
        if (hand === "kitchen" && py > table.length / 4 + 1e-9) return;
      }
      try {
        balls = carom.placeBall(table, balls, ball, px, py);
      } catch (error) {
        if (error instanceof CaromError) return; // no room there: it stays
        throw error;
      }
    }
    moved = true;
    soon();
  }
  function clicked(grip: Grip): void {
    if (grip.is === "ball" && grip.ball > 0) {
      chosen = chosen === grip.ball ? -1 : grip.ball;
      film.draw();
    } else if (grip.is === "pocket" && !match.busy()) aimAt(grip.pocket);
  }

  canvas.addEventListener("pointerdown", (event) => {
    if (film.time > 0 || film.playing) film.go(0);
    const at = position(event);
    const grip = under(at, event.pointerType === "touch");
    held = { grip, at, from: at, value: grip.is === "stick" ? sliders.speed!.value : grip.is === "turn" ? faces[chosen]! : sliders.phi!.value, taps: true };
    // A finger on the cloth may be about to scroll the page: what it does waits for its end.
    if (event.pointerType === "touch") return;
    canvas.setPointerCapture(event.pointerId);
    if (grip.is === "cloth") drag(at);
  });
  canvas.addEventListener("pointermove", (event) => {
    if (!held) return;
    const at = position(event);
    if (Math.hypot(at[0] - held.from[0], at[1] - held.from[1]) * film.scale > 4) held.taps = false;
    if (!held.taps && !(event.pointerType === "touch" && held.grip.is === "cloth")) drag(at);
  });
  canvas.addEventListener("pointerup", (event) => {
    const was = held;
    if (was?.taps) {
      if (was.grip.is === "cloth") drag(was.at);
      else clicked(was.grip);
    }
    held = undefined;
  });
  canvas.addEventListener("pointercancel", () => (held = undefined));
  canvas.addEventListener(
    "touchstart",
    (event) => {
      const grip = event.touches.length === 1 ? under(position(event.touches[0]!), true).is : "cloth";
      if (grip !== "cloth" && grip !== "pocket" && event.cancelable) event.preventDefault();
    },
    { passive: false },
  );
  canvas.addEventListener(
    "wheel",
    (event) => {
      const grip = under(position(event), false);
      if (grip.is !== "ball" || !onTable(balls[grip.ball]!.state)) return;
      event.preventDefault();
      turnBall(grip.ball, Math.sign(event.deltaY) * 10);
    },
    { passive: false },
  );
  canvas.addEventListener("keydown", (event) => {
    const by = event.shiftKey ? 1 : 0.1;
    const turn = (degrees: number): void => set("phi", Math.round(((sliders.phi!.value + degrees + 360) % 360) * 1e6) / 1e6);
    const hasten = (more: number): void => set("speed", Math.round(Math.min(Math.max(sliders.speed!.value + more, 0.1), 10) * 1e6) / 1e6);
    const arrows: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
    const arrow = arrows[event.key];
    if (event.key === " ") film.play.click();
    else if ((event.ctrlKey || event.metaKey) && event.key === "z") back();
    else if (event.key === "," || event.key === ".") turnBall(Math.max(chosen, 0), event.key === "." ? 10 : -10);
    else if (event.altKey && arrow) {
      // The picked ball, or the cue ball, by 1 mm as one sees it.
      const { r } = balls[Math.max(chosen, 0)]!.state;
      const [px, py] = film.place(r[0], r[1]);
      moveBall(Math.max(chosen, 0), film.unplace(px + arrow[0] * by * 0.01 * film.scale, py + arrow[1] * by * 0.01 * film.scale));
    } else if (!arrow) return;
    else if (arrow[0] !== 0) turn(-arrow[0] * by);
    else hasten(-arrow[1] * 0.1);
    event.preventDefault();
    if (arrow && !event.altKey) aimed();
  });

  restore(parameters());
  commit();
  return { update: aimed, theme: film.draw };
}

const HELP = [
  "Drag on the cloth to aim, a ball to move it, the stick to set the speed. A ball on the wood waits in a pocket: drag it back.",
  "Click a ball, then a pocket: the page aims there. The yellow handle of a ball that is picked, or the wheel, turns it in place.",
  "Drop a recording of carom record on the page: it is played again and compared, shot by shot.",
  "Keys on the table: ← → turn the aim (with Shift 1°), ↑ ↓ change the speed, Alt and arrows move the picked ball by 1 mm (with Shift 10), , and . turn it, Ctrl Z undoes, space plays.",
];
