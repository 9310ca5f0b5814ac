// The view Shot: a table to aim on, the whole shot while one aims, its film, its events, and a fan of shots with a player's error.
import { type BallState, type Carom, CaromError, type Cue, fromLine, type Game, type RackName, type Shot, type ShotBall, type ShotOptions, type Table, type TableName, toLine } from "carom";
import { gamePanel } from "./game.js";
import { button, check, choice, color, eachFrame, el, fit, keep, parameters, slider, type Slider } from "./ui.js";

interface GameOf {
  text: string;
  table: TableName;
  rack: RackName;
  game: Game;
  colors: (k: number) => string;
  names: (k: number) => string;
}

const POOL = ["#fbfaf5", "#e3b505", "#1446a0", "#c8102e", "#5b2a86", "#e8702a", "#12664f", "#7a1f2b", "#16181b"];
const SNOOKER = ["#e3b505", "#12664f", "#7b4a21", "#1446a0", "#e58fa5", "#16181b"];
const SNOOKER_NAMES = ["yellow", "green", "brown", "blue", "pink", "black"];
const pool = (k: number): string => (k === 0 ? POOL[0]! : POOL[((k - 1) % 8) + 1]!);
const GAMES: Record<string, GameOf> = {
  nineball: { text: "Nine-ball", table: "9ft", rack: "nineball", game: "pool", colors: pool, names: (k) => (k === 0 ? "cue" : String(k)) },
  eightball: { text: "Eight-ball", table: "9ft", rack: "eightball", game: "pool", colors: pool, names: (k) => (k === 0 ? "cue" : String(k)) },
  snooker: { text: "Snooker", table: "snooker", rack: "snooker", game: "snooker", colors: (k) => (k === 0 ? "#fbfaf5" : k < 16 ? "#c8102e" : SNOOKER[k - 16]!), names: (k) => (k === 0 ? "white" : k < 16 ? `red ${k}` : SNOOKER_NAMES[k - 16]!) },
  threecushion: { text: "Three-cushion", table: "threecushion", rack: "threecushion", game: "billiard", colors: (k) => ["#fbfaf5", "#e3b505", "#c8102e"][k] ?? "#888", names: (k) => ["white", "yellow", "red"][k] ?? String(k) },
};
const EVENTS: Record<string, string> = {
  stick_ball: "cue strikes",
  ball_ball: "hits",
  ball_linear_cushion: "cushion",
  ball_circular_cushion: "jaw of a pocket",
  ball_pocket: "pocketed",
  sliding_rolling: "begins to roll",
  rolling_spinning: "spins on the spot",
  rolling_stationary: "stops",
  spinning_stationary: "stops spinning",
  slate: "lands",
  rail_top: "falls on a rail",
  left_table: "leaves the table",
};
const FAN = 500;
const FAN_CHUNK = 20;
const FAN_ROOM = 400;

export function shotView(carom: Carom, solver: () => "exact" | "euler", main: HTMLElement): { update(): void; theme(): void } {
  const given = parameters();
  let gameName = given.get("game") ?? "nineball";
  if (!(gameName in GAMES)) gameName = "nineball";
  let seed = Number(given.get("seed") ?? 1);
  if (!Number.isSafeInteger(seed) || seed < 0) seed = 1;
  let game = GAMES[gameName]!;
  let table: Table;
  let balls: ShotBall[];
  let names: string[];
  let moved = false;
  let shot: Shot | undefined;
  let time = 0;
  let playing = false;
  let imported: Cue | undefined;

  // ---- Controls ------------------------------------------------------------------------------------------------------------

  const one = (x: number): string => x.toFixed(1);
  const two = (x: number): string => x.toFixed(2);
  const sliders: Record<string, Slider> = {
    speed: slider("speed", "Speed of the cue", 0.1, 10, 0.05, " m/s", aimed, two),
    phi: slider("phi", "Direction", 0, 360, 0.05, "°", aimed, two),
    a: slider("a", "Tip to the left (+) or right", -0.7, 0.7, 0.01, " R", aimed, two),
    b: slider("b", "Tip above (+) or below", -0.7, 0.7, 0.01, " R", aimed, two),
    theta: slider("theta", "Butt raised by", 0, 80, 1, "°", aimed, (x) => x.toFixed(0)),
    error: slider("error", "Player's error of direction", 0.05, 2, 0.05, "°", aimed, two),
  };
  const defaults: Record<string, number> = { speed: 8, phi: 90, a: 0, b: 0.25, theta: 0, error: 0.3 };
  for (const [key, s] of Object.entries(sliders)) {
    const x = given.has(key) ? Number(given.get(key)) : NaN;
    s.value = Number.isFinite(x) ? x : defaults[key]!;
  }
  const games = choice("game", "Game", Object.entries(GAMES).map(([key, { text }]) => [key, text] as const), () => {
    gameName = games.select.value;
    // Three-cushion has no rack to break: a shot of medium speed at an angle shows more.
    Object.assign(sliders.speed!, { value: gameName === "threecushion" ? 4 : 8 });
    Object.assign(sliders.phi!, { value: gameName === "threecushion" ? 62 : 90 });
    setUp();
  });
  const cushion = choice("cushion", "Cushions", [["han", "Han"], ["mathavan", "Mathavan, exact"], ["stronge", "Stronge"], ["mirror", "mirror"]], aimed);
  cushion.select.value = given.get("cushion") ?? "han";
  if (cushion.select.value === "") cushion.select.value = "han";
  const fanned = check("fan", `Fan: ${FAN} shots with a player's error`, aimed);
  fanned.input.checked = given.get("fan") === "1";
  const rate = choice("rate", "Speed", [["1", "real time"], ["0.25", "1/4"], ["0.1", "1/10"], ["4", "4 times"], ["1000", "at once"]], () => undefined);
  const play = button("Play", () => (!playing ? start() : match.busy() ? undefined : stop()), { id: "play" });
  const clock = slider("time", "Time", 0, 1, 0.001, " s", () => go(clock.value), two);
  const canvas = el("canvas", { class: "scene", id: "table-scene", role: "img", tabindex: "0" });
  const side = el("canvas", { class: "scene", id: "side-scene", role: "img", "aria-label": "The table from the side: heights of the balls" });
  const sidePanel = el("div", { id: "side-view", hidden: "" }, el("p", { class: "note" }, "From the side; heights are enlarged."), side);
  const list = el("ol");
  const summary = el("tbody");
  const message = el("p", { class: "error", role: "status", id: "message" });
  const line = el("textarea", { id: "line", spellcheck: "false" });
  const cost = el("p", { class: "note", id: "cost" });
  const match = gamePanel(carom, {
    name: () => gameName,
    table: () => table,
    balls: () => balls,
    names: () => names,
    cue: () => cue(),
    options: () => options(),
    aim(stroke) {
      for (const key of ["speed", "phi", "a", "b", "theta"] as const) sliders[key]!.value = stroke[key];
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
      if (shot) start();
      else then();
    },
    rackUp: () => rackUp(false),
  });

  main.replaceChildren(
    el(
      "div",
      { class: "columns" },
      el(
        "section",
        { class: "panel first", "aria-label": "The shot" },
        el("div", { class: "row" }, games.root, button("New rack", () => { seed += 1; rackUp(); }, { id: "rack" })),
        ...["speed", "phi", "a", "b", "theta"].map((key) => sliders[key]!.root),
        el("div", { class: "row" }, cushion.root),
        fanned.root,
        sliders.error!.root,
        el("details", {}, el("summary", {}, "Export and import"), el("label", { for: "line" }, "The shot as the line that carom shoot reads"), line, el("div", { class: "row" }, button("Export", exportLine, { id: "export" }), button("Import", importLine, { id: "import" }))),
        message,
      ),
      el(
        "div",
        { class: "stack scene-panel" },
        el(
          "section",
          { class: "panel", "aria-label": "Table" },
          canvas,
          sidePanel,
          el("div", { class: "row" }, play, button("◀ event", () => step(-1), { id: "back", "aria-label": "Previous event" }), button("event ▶", () => step(1), { id: "forward", "aria-label": "Next event" }), rate.root),
          clock.root,
          el("p", { class: "note" }, "Drag on the table to aim; drag the cue ball to move it. Keys on the table: ← → turn (with Shift 1°), ↑ ↓ change the speed, space plays."),
          cost,
        ),
        match.root,
      ),
      el("section", { class: "panel stack", "aria-label": "What happens" }, el("table", { class: "numbers", id: "shot-numbers" }, el("caption", {}, "The shot"), summary), el("div", {}, el("h2", {}, "Events"), el("div", { class: "events", tabindex: "0", role: "region", "aria-label": "Events" }, list))),
    ),
  );

  // ---- The shot ------------------------------------------------------------------------------------------------------------

  const cue = (): Cue => {
    const v = (key: string): number => sliders[key]!.value;
    return { ...(imported ?? carom.cue({}, game.game)), speed: v("speed"), phi: v("phi"), a: v("a"), b: v("b"), theta: v("theta") };
  };
  const options = (): ShotOptions => {
    const euler = solver() === "euler";
    const model = cushion.select.value as "mathavan" | "han" | "stronge" | "mirror";
    return { ballModel: euler ? "euler" : "exact", cushionModel: euler && model === "mathavan" ? "euler" : model };
  };

  /** The balls of the game as they begin. It ends a game that is played, unless that begins with it. */
  function rackUp(ends = true): void {
    moved = false;
    imported = undefined;
    setUp(ends);
  }

  function setUp(ends = true): void {
    game = GAMES[gameName]!;
    games.select.value = gameName;
    table = carom.table(game.table);
    if (!moved) {
      balls = carom.rack(game.rack, table, { seed });
      const kind = carom.kind(game.game);
      balls = balls.map(({ state }) => ({ kind, state }));
      names = balls.map((_, k) => game.names(k));
    }
    ended = undefined;
    if (ends) match.begin();
    aimed();
  }

  /** Plays the shot as it is aimed now, from its start. */
  function aimed(): void {
    if (match.busy()) return;
    present(cue());
    match.aimed();
  }

  function present(stroke: Cue): void {
    stop();
    sliders.error!.input.disabled = !fanned.input.checked;
    const begun = performance.now();
    message.textContent = "";
    try {
      shot = carom.simulate(table, balls, stroke, options());
    } catch (error) {
      shot = error instanceof CaromError ? error.shot : undefined;
      message.textContent = error instanceof Error ? error.message : String(error);
    }
    const computed = performance.now() - begun;
    // Flights are short: their paths need more points.
    paths = shot ? sample(shot, shot.events.some((event) => event.type === "slate") ? 150 : 25, 900) : [];
    time = 0;
    const last = shot?.time ?? 1;
    clock.input.max = String(Math.max(last, 0.001));
    clock.value = 0;
    fanLayer = undefined;
    fanNumber++;
    draw();
    cost.textContent = `The shot was computed in ${computed.toFixed(1)} ms, and drawn with its paths in ${(performance.now() - begun).toFixed(1)} ms.`;
    tell();
    if (fanned.input.checked) void fan(fanNumber);
    const kept: Record<string, string> = { view: "shot" };
    if (gameName !== "nineball") kept.game = gameName;
    if (seed !== 1) kept.seed = String(seed);
    for (const [key, s] of Object.entries(sliders)) if (s.value !== defaults[key]) kept[key] = String(s.value);
    if (cushion.select.value !== "han") kept.cushion = cushion.select.value;
    if (fanned.input.checked) kept.fan = "1";
    if (solver() === "euler") kept.solver = "euler";
    if (moved) kept.line = toLine({ tableName: game.table, balls, cue: cue(), names });
    keep(kept);
  }

  interface Path {
    ball: number;
    xyz: Float64Array;
  }
  let paths: Path[] = [];
  /** The path of each ball that moves: at every event, and so often a second between. */
  function sample(shot: Shot, often = 25, most = 500): Path[] {
    const times = shot.events.map((event) => event.time);
    const count = Math.min(Math.ceil(shot.time * often), most);
    for (let k = 0; k <= count; k++) times.push((shot.time * k) / Math.max(count, 1));
    times.sort((a, b) => a - b);
    const moving = new Set(shot.events.flatMap((event) => (event.type === "ball_ball" ? [event.a, event.b] : [event.a])));
    const found = [...moving].map((ball) => ({ ball, xyz: new Float64Array(3 * times.length) }));
    const all = shot.positionsAt(times.map((t) => Math.min(t, shot.time)));
    times.forEach((_, k) => {
      for (const path of found) for (let c = 0; c < 3; c++) path.xyz[3 * k + c] = all[3 * (k * shot.balls.length + path.ball) + c]!;
    });
    return found;
  }

  let listing: number | undefined;
  function tellEvents(): void {
    list.replaceChildren(
      ...(shot?.events ?? []).map((event) => {
        const what = event.type === "ball_ball" ? `${names[event.a]} hits ${names[event.b]}` : event.type === "stick_ball" ? "the cue strikes" : `${names[event.a]}: ${EVENTS[event.type] ?? event.type}`;
        const made = button("", () => go(event.time));
        made.append(el("span", {}, `${event.time.toFixed(3)} s`), el("span", {}, what));
        return el("li", {}, made);
      }),
    );
    markEvent();
  }

  function tell(): void {
    const rows: [string, string, string][] = [];
    if (shot) {
      const contact = shot.firstContact;
      const fell = shot.final.map((state, k) => (state.label === "pocketed" && balls[k]!.state.label !== "pocketed" ? names[k]! : "")).filter((name) => name !== "");
      const cushions = shot.events.filter((event) => event.type === "ball_linear_cushion").length;
      rows.push(["status", "Status", shot.status], ["time", "Lasts", `${shot.time.toFixed(3)} s`], ["count", "Events", String(shot.count)]);
      rows.push(["contact", "First ball hit", contact ? `${names[contact.ball]} after ${contact.time.toFixed(3)} s` : "none"]);
      rows.push(["cushions", "Contacts with cushions", String(cushions)], ["pocketed", "Pocketed", fell.join(", ") || "none"]);
      const { r } = shot.final[0]!;
      rows.push(["cue-ball", "Cue ball at the end", shot.final[0]!.label === "pocketed" ? "in a pocket" : `${r[0].toFixed(4)}, ${r[1].toFixed(4)} m`]);
    }
    summary.replaceChildren(...rows.map(([id, name, text]) => el("tr", {}, el("th", { scope: "row" }, name), el("td", { id: `s-${id}` }, text))));
    // The list waits until nothing has changed for a moment: it costs more than the shot.
    window.clearTimeout(listing);
    list.replaceChildren();
    listing = window.setTimeout(tellEvents, 100);
    const contact = shot?.firstContact;
    canvas.setAttribute("aria-label", `${game.text} table from above. The shot lasts ${shot?.time.toFixed(1) ?? 0} seconds; ${contact ? `ball ${names[contact.ball]} is hit first` : "no ball is hit"}.`);
    const high = paths.some(({ xyz, ball }) => {
      for (let k = 2; k < xyz.length; k += 3) if (xyz[k]! > balls[ball]!.kind.radius + 1e-6) return true;
      return false;
    });
    sidePanel.hidden = !high;
  }

  // ---- Film ----------------------------------------------------------------------------------------------------------------

  let before = 0;
  /** Is called at the end of a film of the game. */
  let ended: (() => void) | undefined;
  function frame(now: number): void {
    if (!playing || !shot) return;
    time = Math.min(time + Math.min((now - before) / 1000, 0.1) * Number(rate.select.value), shot.time);
    before = now;
    clock.value = time;
    draw();
    markEvent();
    if (time < shot.time) return void requestAnimationFrame(frame);
    stop();
    const then = ended;
    ended = undefined;
    then?.();
  }
  function start(): void {
    if (!shot) return;
    if (time >= shot.time) time = 0;
    playing = true;
    play.textContent = "Pause";
    before = performance.now();
    requestAnimationFrame(frame);
  }
  function stop(): void {
    playing = false;
    play.textContent = "Play";
  }
  function go(to: number): void {
    if (match.busy()) return;
    stop();
    time = to;
    clock.value = to;
    draw();
    markEvent();
  }
  function step(by: number): void {
    if (!shot) return;
    const times = shot.events.map((event) => event.time);
    const next = by > 0 ? times.find((t) => t > time + 1e-9) : times.findLast((t) => t < time - 1e-9);
    if (next !== undefined) go(next);
  }
  function markEvent(): void {
    if (!shot) return;
    const k = shot.events.findLastIndex((event) => event.time <= time + 1e-9);
    const old = list.querySelector('[aria-current="true"]');
    const current = list.children[k];
    if (old === current) return;
    old?.removeAttribute("aria-current");
    current?.setAttribute("aria-current", "true");
    if (current instanceof HTMLElement) list.parentElement!.scrollTop = current.offsetTop - list.parentElement!.offsetTop - 60;
  }

  // ---- The fan -------------------------------------------------------------------------------------------------------------

  let fanNumber = 0;
  let fanLayer: HTMLCanvasElement | undefined;
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
          for (let t = 0; t < xyz.length && xyz[t + 2]! > 0; t += 3) g[t === 0 ? "moveTo" : "lineTo"](...place(xyz[t]!, xyz[t + 1]!));
        }
        g.stroke();
        g.globalAlpha = 0.25;
        one.final.forEach((state, ball) => {
          if (state.label === "pocketed" || balls[ball]!.state.label === "pocketed") return;
          g.fillStyle = game.colors(ball);
          g.beginPath();
          g.arc(...place(state.r[0], state.r[1]), 2, 0, 7);
          g.fill();
        });
      }
      fanLayer = layer;
      if (!playing) draw();
      cost.textContent = `${done + FAN_CHUNK} of ${FAN} shots of the fan; the library took ${computed.toFixed(0)} ms for them.`;
    }
    shots.free();
  }

  // ---- Drawing -------------------------------------------------------------------------------------------------------------

  let scale = 1;
  let upright = false;
  let offset: [number, number] = [0, 0];
  /** From the table, m, to the canvas. A table that lies has its length along the canvas' width. */
  function place(x: number, y: number): [number, number] {
    return upright ? [offset[0] + x * scale, offset[1] + (table.length - y) * scale] : [offset[0] + y * scale, offset[1] + x * scale];
  }
  function back(px: number, py: number): [number, number] {
    return upright ? [(px - offset[0]) / scale, table.length - (py - offset[1]) / scale] : [(py - offset[1]) / scale, (px - offset[0]) / scale];
  }

  function draw(): void {
    const margin = 0.1;
    const [w, l] = [table.width + 2 * margin, table.length + 2 * margin];
    upright = canvas.clientWidth < 480;
    const { g, width, height } = fit(canvas, upright ? l / w : w / l);
    scale = width / (upright ? w : l);
    offset = [margin * scale, margin * scale];
    g.fillStyle = color("rail");
    g.fillRect(0, 0, width, height);
    // The bed, as far as the noses of the cushions, then pockets.
    g.fillStyle = color("cloth");
    const [x0, y0] = place(0, 0);
    const [x1, y1] = place(table.width, table.length);
    g.fillRect(Math.min(x0, x1), Math.min(y0, y1), Math.abs(x1 - x0), Math.abs(y1 - y0));
    g.fillStyle = "#0c0f10";
    for (const pocket of table.pockets) {
      g.beginPath();
      g.arc(...place(pocket.centre[0], pocket.centre[1]), pocket.radius * scale, 0, 7);
      g.fill();
    }
    g.lineCap = "round";
    g.strokeStyle = "#0f3b31";
    g.lineWidth = 3;
    for (const rail of table.rails) {
      g.beginPath();
      g.moveTo(...place(rail.p[0], rail.p[1]));
      g.lineTo(...place(rail.q[0], rail.q[1]));
      g.stroke();
    }
    // Of a jaw the part between the ends of the rails that it joins.
    for (const { centre, radius } of table.jaws) {
      const ends = table.rails.flatMap(({ p, q }) => [p, q]).filter(([x, y]) => Math.abs(Math.hypot(x - centre[0], y - centre[1]) - radius) < 1e-3);
      if (ends.length !== 2) continue;
      const [from, to] = ends.map(([x, y]) => Math.atan2(y - centre[1], x - centre[0])) as [number, number];
      const turned = Math.atan2(Math.sin(to - from), Math.cos(to - from));
      g.beginPath();
      for (let k = 0; k <= 8; k++) {
        const angle = from + (turned * k) / 8;
        g[k === 0 ? "moveTo" : "lineTo"](...place(centre[0] + radius * Math.cos(angle), centre[1] + radius * Math.sin(angle)));
      }
      g.stroke();
    }
    if (fanLayer) g.drawImage(fanLayer, 0, 0, width, height);
    // The paths.
    g.lineWidth = 1.6;
    g.lineJoin = "round";
    for (const { ball, xyz } of paths) {
      g.strokeStyle = game.colors(ball) === "#16181b" ? "#000000" : game.colors(ball);
      g.globalAlpha = fanLayer ? 0.5 : 0.8;
      g.beginPath();
      for (let k = 0; k < xyz.length; k += 3) {
        if (xyz[k + 2]! < 0) break;
        g[k === 0 ? "moveTo" : "lineTo"](...place(xyz[k]!, xyz[k + 1]!));
      }
      g.stroke();
    }
    g.globalAlpha = 1;
    // The balls at this time.
    const states: readonly BallState[] = shot ? shot.states(Math.min(time, shot.time)) : balls.map((ball) => ball.state);
    const turned = shot?.orientations(Math.min(time, shot.time));
    states.forEach((state, k) => {
      if (state.label !== "pocketed" && state.label !== "off") drawBall(g, k, state, turned?.subarray(4 * k, 4 * k + 4));
    });
    if (time === 0 && states[0]) drawCue(g, states[0]);
    if (!sidePanel.hidden) drawSide(states);
  }

  function drawBall(g: CanvasRenderingContext2D, k: number, state: BallState, q: Float64Array | undefined): void {
    const [x, y] = place(state.r[0], state.r[1]);
    const radius = Math.max(balls[k]!.kind.radius * scale * (1 + Math.max(0, state.r[2] - balls[k]!.kind.radius)), 3);
    const striped = game.game === "pool" && k > 8;
    g.beginPath();
    g.arc(x, y, radius, 0, 7);
    g.fillStyle = striped ? "#fbfaf5" : game.colors(k);
    g.fill();
    g.strokeStyle = "#000a";
    g.lineWidth = 1;
    g.stroke();
    // A spot that was on top at the start, or the stripe across it, where the ball has turned to.
    if (q === undefined) return;
    const [w, i, j, n] = [q[0]!, q[1]!, q[2]!, q[3]!];
    for (const sign of [1, -1]) {
      const up = sign * (1 - 2 * (i * i + j * j));
      if (up < 0.1) continue;
      const [sx, sy] = [sign * 2 * (i * n + w * j), sign * 2 * (j * n - w * i)];
      const [px, py] = place(state.r[0] + sx * balls[k]!.kind.radius * 0.85, state.r[1] + sy * balls[k]!.kind.radius * 0.85);
      g.beginPath();
      g.arc(px, py, radius * 0.42, 0, 7);
      g.fillStyle = striped ? game.colors(k) : k === 0 ? "#c8102e" : "#fbfaf5";
      g.fill();
      if (k > 0 && game.game === "pool" && radius > 6) {
        g.fillStyle = striped ? "#ffffff" : "#16181b";
        g.font = `bold ${Math.round(radius * 0.75)}px sans-serif`;
        g.textAlign = "center";
        g.textBaseline = "middle";
        g.fillText(names[k]!, px, py + 0.5);
      }
    }
  }

  function drawCue(g: CanvasRenderingContext2D, state: BallState): void {
    const { phi, theta } = cue();
    const [dx, dy] = [Math.cos((phi * Math.PI) / 180), Math.sin((phi * Math.PI) / 180)];
    const seen = Math.max(Math.cos((theta * Math.PI) / 180), 0.15);
    const gap = 0.03 + 0.012 * sliders.speed!.value;
    const at = (s: number): [number, number] => place(state.r[0] - dx * s, state.r[1] - dy * s);
    g.lineCap = "round";
    for (const [from, to, width, stroke] of [[gap + 0.028, gap + 1.3 * seen, 5, "#d9b077"], [gap + 0.028, gap + 0.045, 4, "#3f7fbf"]] as const) {
      g.strokeStyle = stroke;
      g.lineWidth = width;
      g.beginPath();
      g.moveTo(...at(from));
      g.lineTo(...at(to));
      g.stroke();
    }
  }

  /** Height over length: paths of balls that leave the cloth, and the balls now. */
  function drawSide(states: readonly BallState[]): void {
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
      g.strokeStyle = ball === 0 ? color("text") : game.colors(ball);
      g.lineWidth = 1.5;
      g.beginPath();
      for (let k = 0; k < xyz.length; k += 3) {
        if (xyz[k + 2]! < 0) break;
        g[k === 0 ? "moveTo" : "lineTo"](...at(xyz[k + 1]!, xyz[k + 2]!));
      }
      g.stroke();
    }
    states.forEach((state, k) => {
      if (state.label === "pocketed" || state.label === "off") return;
      g.beginPath();
      g.ellipse(...at(state.r[1], state.r[2]), balls[k]!.kind.radius * across, balls[k]!.kind.radius * up, 0, 0, 7);
      g.fillStyle = game.colors(k);
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
      take(line.value);
    } catch (error) {
      message.textContent = error instanceof Error ? error.message : String(error);
    }
  }
  function take(text: string): void {
    const read = fromLine(carom, text);
    const known = Object.entries(GAMES).find(([key, one]) => one.table === read.tableName && (key === read.id || carom.rack(one.rack, read.table).length >= read.balls.length));
    gameName = known?.[0] ?? "nineball";
    game = { ...GAMES[gameName]!, table: read.tableName };
    if (read.cue.ball !== 0) throw new TypeError("cue.ball: this page strikes the first ball; put the cue ball first");
    balls = read.balls;
    names = read.names;
    imported = read.cue;
    moved = true;
    for (const key of ["speed", "phi", "a", "b", "theta"] as const) sliders[key]!.value = read.cue[key];
    games.select.value = gameName;
    table = read.table;
    aimed();
  }

  // ---- Pointer and keys ----------------------------------------------------------------------------------------------------

  const soon = eachFrame(aimed);
  let held: "aim" | "ball" | undefined;
  const position = (event: PointerEvent): [number, number] => {
    const box = canvas.getBoundingClientRect();
    return back(event.clientX - box.left, event.clientY - box.top);
  };
  function drag(event: PointerEvent): void {
    if (match.busy()) return;
    const [x, y] = position(event);
    const { r } = balls[0]!.state;
    if (held === "aim") {
      const angle = (Math.atan2(y - r[1], x - r[0]) * 180) / Math.PI;
      sliders.phi!.value = Math.round(((angle + 360) % 360) * 100) / 100;
      return soon();
    }
    // Ball in hand: within the cushions, and not in another ball.
    const R = balls[0]!.kind.radius;
    const inside = (v: number, most: number): number => Math.min(Math.max(v, R + 1e-4), most - R - 1e-4);
    if (match.hand() === "no") return;
    const [bx, by] = [inside(x, table.width), inside(y, match.hand() === "kitchen" ? table.length / 4 + R : table.length)];
    if (balls.some(({ state }, k) => k > 0 && state.label !== "pocketed" && Math.hypot(state.r[0] - bx, state.r[1] - by) < 2 * R + 1e-5)) return;
    balls = balls.map((ball, k) => (k === 0 ? { kind: ball.kind, state: { ...ball.state, r: [bx, by, R] } } : ball));
    moved = true;
    soon();
  }
  canvas.addEventListener("pointerdown", (event) => {
    const [x, y] = position(event);
    const { r } = balls[0]!.state;
    held = Math.hypot(x - r[0], y - r[1]) < Math.max(1.5 * balls[0]!.kind.radius, 14 / scale) ? "ball" : "aim";
    canvas.setPointerCapture(event.pointerId);
    drag(event);
  });
  canvas.addEventListener("pointermove", (event) => {
    if (canvas.hasPointerCapture(event.pointerId)) drag(event);
  });
  canvas.addEventListener("keydown", (event) => {
    const by = event.shiftKey ? 1 : 0.1;
    const turn = (degrees: number): void => void (sliders.phi!.value = Math.round(((sliders.phi!.value + degrees + 360) % 360) * 1e6) / 1e6);
    const hasten = (more: number): void => void (sliders.speed!.value = Math.round(Math.min(Math.max(sliders.speed!.value + more, 0.1), 10) * 1e6) / 1e6);
    if (event.key === "ArrowLeft") turn(by);
    else if (event.key === "ArrowRight") turn(-by);
    else if (event.key === "ArrowUp") hasten(0.1);
    else if (event.key === "ArrowDown") hasten(-0.1);
    else if (event.key === " ") play.click();
    else return;
    event.preventDefault();
    if (event.key !== " ") aimed();
  });

  const text = given.get("line");
  setUp();
  if (text !== null) {
    line.value = text;
    importLine();
  }
  return { update: aimed, theme: draw };
}
