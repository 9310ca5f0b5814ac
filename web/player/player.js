// The film of billiard shots: a table seen from above, balls that turn, trails, and a clock to play them by. The explorer of web/ and the
// pages that `carom shoot --animate` writes both show this player.

/** @typedef {readonly [number, number]} Point */
/** @typedef {{ width: number, length: number, rails: { p: Point, q: Point }[], jaws: { centre: Point, radius: number }[],
 *   pockets: { centre: Point, radius: number }[] }} Table */
/** Where a ball is, m, and how it has turned: a unit quaternion w, x, y, z. It is not seen where it lies in a pocket or on the floor.
 * @typedef {{ r: readonly number[], q: ArrayLike<number>, seen: boolean }} Pose */
/** A shot: its poses at a time, s; x, y, z of the balls that move, point after point; what happens when.
 * @typedef {{ time: number, at(time: number): Pose[], paths: { ball: number, xyz: ArrayLike<number> }[], events: { time: number, text: string }[] }} Shot */
/** Shots that are apart have a colour each: of trails, dashed but for the cue ball, and around balls. */
/** @typedef {{ table: Table, balls: { name: string, radius: number }[], shots: Shot[], apart?: boolean }} Film */
/** @typedef {{ under?(g: CanvasRenderingContext2D): boolean, over?(g: CanvasRenderingContext2D): void, ended?(): void, moved?(): void,
 *   still?(): boolean, sharp?: number }} Hooks */

const IVORY = "#fbfaf5";
const POOL = ["#e3b505", "#1446a0", "#c8102e", "#5b2a86", "#e8702a", "#12664f", "#7a1f2b", "#16181b"];
/** @type {Record<string, string>} */
const NAMED = { cue: IVORY, white: IVORY, yellow: POOL[0], green: POOL[5], brown: "#7b4a21", blue: POOL[1], pink: "#e58fa5", black: POOL[7], red: POOL[2] };
/** Of trails, which have to be bright on the cloth. @type {Record<string, string>} */
const BRIGHT = { [POOL[0]]: "#ffd84a", [POOL[1]]: "#8fc1ff", [POOL[2]]: "#ff8d80", [POOL[3]]: "#d3b3ff", [POOL[4]]: "#ffb466", [POOL[5]]: "#b6f09c", [POOL[6]]: "#f2a0bd", "#7b4a21": "#c9a27a" };
/** Of shots over each other, as in the picture below the film. */
const SHOTS = ["#ffffff", "#ffd84a", "#8fc1ff", "#ff8d80", "#d3b3ff", "#ffb466", "#b6f09c", "#f2a0bd"];
/** Wood around the noses of the cushions, m. */
const WOOD = 0.1;
/** Radii of what is drawn on a ball, as angles seen from its middle: a white end of a striped ball, a number, a dot. */
const [END, NUMBER, DOT] = [0.9, 0.52, 0.2];

/** The colour of a ball, by its name. @param {string} name @param {number} k */
export function colourOf(name, k) {
  return NAMED[name.split(" ")[0]] ?? (k === 0 ? IVORY : POOL[((Number(name) || k) - 1) % 8]);
}

/** Where a pocket of a rectangle is for a player at the head, as carom_pocket_name() says: "foot-left pocket". @param {Table} table @param {number} pocket */
export function pocketName({ width, length, pockets }, pocket) {
  const [x, y] = pockets[pocket].centre;
  return `${y < 0.3 * length ? "head" : y < 0.7 * length ? "side" : "foot"}-${x > width / 2 ? "right" : "left"} pocket`;
}

/** @type {Record<string, string>} */
const EVENTS = {
  ball_linear_cushion: "cushion",
  ball_circular_cushion: "jaw of a pocket",
  sliding_rolling: "begins to roll",
  rolling_spinning: "spins on the spot",
  rolling_stationary: "stops",
  spinning_stationary: "stops spinning",
  slate: "lands",
  rail_top: "falls on a rail",
  left_table: "leaves the table",
};
/** An event in words. @param {Table} table @param {readonly string[]} names @param {string} type @param {number} a @param {number} b */
export function wordsOf(table, names, type, a, b) {
  if (type === "stick_ball") return "the cue strikes";
  if (type === "ball_ball") return `${names[a]} hits ${names[b]}`;
  return `${names[a]}: ${type === "ball_pocket" ? pocketName(table, b) : (EVENTS[type] ?? type)}`;
}

/** The film of a page that `carom shoot --animate` wrote. Of each ball it has 10 numbers at each time: its place, how it has turned, its spin, rad/s;
 * of one that lies still, once.
 * @param {{ table: Table, balls: [string, number][], shots: { times: number[], poses: number[][], events: [number, string, number, number][] }[] }} page
 * @returns {Film} */
export function recorded({ table, balls, shots }) {
  const names = balls.map(([name]) => name);
  const filmed = shots.map(({ times, poses, events }, index) => ({
    time: times[times.length - 1],
    /** @param {number} time */
    at(time) {
      const k = times.findLastIndex((t) => t <= time);
      const since = time - times[k];
      return poses.map((pose) => {
        const moves = pose.length > 10;
        const [from, to] = moves ? [10 * k, 10 * Math.min(k + 1, times.length - 1)] : [0, 0];
        const share = to > from ? since / (times[k + 1] - times[k]) : 0;
        const r = [0, 1, 2].map((c) => pose[from + c] + share * (pose[to + c] - pose[from + c]));
        // It turns on by its spin.
        const [w, i, j, n, ...spin] = pose.slice(from + 3, from + 10);
        const rate = Math.hypot(...spin);
        const [c, s] = [Math.cos((rate * since) / 2), rate > 0 ? Math.sin((rate * since) / 2) / rate : 0];
        const [x, y, z] = spin.map((part) => part * s);
        const q = [c * w - x * i - y * j - z * n, c * i + x * w + y * n - z * j, c * j + y * w + z * i - x * n, c * n + z * w + x * j - y * i];
        return { r, q, seen: pose[from + 2] >= 0 && (moves || index === 0) };
      });
    },
    paths: poses.flatMap((pose, ball) => (pose.length > 10 ? [{ ball, xyz: pose.filter((_, k) => k % 10 < 3) }] : [])),
    events: events.map(([time, type, a, b]) => ({ time, text: wordsOf(table, names, type, a, b) })),
  }));
  return { table, balls: balls.map(([name, radius]) => ({ name, radius })), shots: filmed, apart: filmed.length > 1 };
}

/** @template {keyof HTMLElementTagNameMap} K @param {K} tag @param {Record<string, string>} attributes @param {(Node | string)[]} children */
function make(tag, attributes, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.append(...children);
  return made;
}

/** @param {Hooks} hooks `under` draws below the trails and tells whether they are dim; `still` tells that the clock is not the reader's now;
 * `sharp` is how many pixels of the picture there are at least for one of the page. */
export function player({ under, over, ended, moved, still = () => false, sharp = 1 } = {}) {
  const canvas = make("canvas", { class: "scene", id: "table-scene", role: "img", tabindex: "0", "aria-label": "A billiard table from above" });
  const play = make("button", { type: "button", id: "play" }, "Play");
  const back = make("button", { type: "button", id: "back", "aria-label": "Previous event" }, "◀");
  const forward = make("button", { type: "button", id: "forward", "aria-label": "Next event" }, "▶");
  const paces = /** @type {const} */ ([["1", "1 ×"], ["0.25", "1/4 ×"], ["0.1", "1/10 ×"], ["4", "4 ×"], ["1000", "at once"]]);
  const pace = make("select", { id: "rate", "aria-label": "Speed of the film" }, ...paces.map(([value, text]) => make("option", { value }, text)));
  const slider = make("input", { type: "range", id: "time", min: "0", step: "0.001", "aria-label": "Time of the film" });
  const said = make("output", { id: "time-value", for: "time" });
  const controls = make("div", { class: "row film" }, play, back, forward, pace, slider, said);
  const list = make("ol", {});
  const events = make("div", { class: "events", tabindex: "0", role: "region", "aria-label": "Events" }, list);

  /** @type {Film | undefined} */
  let film;
  let [time, end, playing, before, listing] = [0, 0, false, 0, 0];
  /** @type {{ time: number, text: string }[]} */
  let all = [];

  // ---- The table on the canvas ------------------------------------------------------------------------------------------------

  let [scale, upright] = [1, false];
  /** @type {[number, number]} */
  let offset = [0, 0];
  /** How many times larger the table is than its place on the page, and what of it is in the middle, m; undefined: its own middle. */
  let zoom = 1;
  /** @type {Point | undefined} */
  let middle;
  /** From the table, m, to the canvas. A table that lies has its length along the canvas' width.
   * @param {number} x @param {number} y @returns {[number, number]} */
  const place = (x, y) => (upright ? [offset[0] + x * scale, offset[1] - y * scale] : [offset[0] + y * scale, offset[1] + x * scale]);
  /** From the canvas to the table. @param {number} px @param {number} py @returns {[number, number]} */
  const unplace = (px, py) => (upright ? [(px - offset[0]) / scale, (offset[1] - py) / scale] : [(py - offset[1]) / scale, (px - offset[0]) / scale]);
  /** @param {CanvasRenderingContext2D} g @param {(readonly number[])[]} points */
  const line = (g, points) => {
    g.beginPath();
    points.forEach(([x, y], k) => g[k === 0 ? "moveTo" : "lineTo"](...place(x, y)));
    g.stroke();
  };
  /** @param {CanvasRenderingContext2D} g @param {readonly number[]} centre @param {number} radius in pixels */
  const disc = (g, [x, y], radius) => {
    g.beginPath();
    g.arc(...place(x, y), radius, 0, 7);
    g.fill();
  };

  /** The table without balls is drawn once for each size. */
  const cloth = document.createElement("canvas");
  let drawn = "";
  /** @param {Table} table @param {number} width @param {number} height @param {number} dpr */
  function drawTable(table, width, height, dpr) {
    const [bed, wood] = ["--cloth", "--rail"].map((name) => getComputedStyle(canvas).getPropertyValue(name).trim());
    const now = [width, height, dpr, bed, wood, table.width, table.length, table.pockets.length, scale, ...offset].join();
    if (now === drawn) return;
    drawn = now;
    [cloth.width, cloth.height] = [canvas.width, canvas.height];
    const g = /** @type {CanvasRenderingContext2D} */ (cloth.getContext("2d", { alpha: false }));
    g.setTransform(dpr, 0, 0, dpr, 0, 0);
    g.fillStyle = wood || "#5b3a24";
    g.fillRect(0, 0, width, height);
    g.fillStyle = bed || "#1f6f5c";
    const [[x0, y0], [x1, y1]] = [place(0, 0), place(table.width, table.length)];
    g.fillRect(Math.min(x0, x1), Math.min(y0, y1), Math.abs(x1 - x0), Math.abs(y1 - y0));
    g.fillStyle = "#0c0f10";
    for (const pocket of table.pockets) disc(g, pocket.centre, pocket.radius * scale);
    g.strokeStyle = "#0f3b31";
    g.lineWidth = 3;
    g.lineCap = "round";
    for (const { p, q } of table.rails) line(g, [p, q]);
    // Of a jaw the part between the ends of the rails that it joins.
    for (const { centre, radius } of table.jaws) {
      const ends = table.rails.flatMap(({ p, q }) => [p, q]).filter(([x, y]) => Math.abs(Math.hypot(x - centre[0], y - centre[1]) - radius) < 1e-3);
      if (ends.length !== 2) continue;
      const [from, to] = ends.map(([x, y]) => Math.atan2(y - centre[1], x - centre[0]));
      const turned = Math.atan2(Math.sin(to - from), Math.cos(to - from));
      line(g, Array.from({ length: 9 }, (_, k) => [centre[0] + radius * Math.cos(from + (turned * k) / 8), centre[1] + radius * Math.sin(from + (turned * k) / 8)]));
    }
    // Diamonds: the long cushions in eight parts, the short ones in four. None where a pocket is, none in snooker.
    if (table.length > 3) return;
    g.fillStyle = "#e8dcc0";
    for (const side of [0, 1]) {
      const out = side === 0 ? -0.8 * WOOD : 0.8 * WOOD;
      for (let k = 1; k < 8; k++) if (k !== 4 || table.pockets.length === 0) disc(g, [side * table.width + out, (table.length * k) / 8], 0.008 * scale);
      for (let k = 1; k < 4; k++) disc(g, [(table.width * k) / 4, side * table.length + out], 0.008 * scale);
    }
  }

  /** A cap of a ball, around a direction on it, as it is seen from above. The part beyond the rim lies on the rim.
   * @param {CanvasRenderingContext2D} g @param {Point} at on the canvas @param {number} radius pixels @param {readonly number[]} n towards the cap's middle
   * @param {number} angle @param {string} fill */
  function cap(g, at, radius, n, angle, fill) {
    const flat = Math.hypot(n[0], n[1]);
    if (n[2] <= 0 && flat <= Math.cos(angle)) return;
    const [ux, uy] = flat > 1e-9 ? [n[0] / flat, n[1] / flat] : [1, 0];
    g.beginPath();
    for (let k = 0; k < 28; k++) {
      const [c, s] = [Math.sin(angle) * Math.cos((k * Math.PI) / 14), Math.sin(angle) * Math.sin((k * Math.PI) / 14)];
      // On the ball: the middle, and two directions across it, one of them level.
      const along = flat * Math.cos(angle) - n[2] * c;
      const [x, y, z] = [ux * along - uy * s, uy * along + ux * s, n[2] * Math.cos(angle) + flat * c];
      const rim = z < 0 ? Math.hypot(x, y) : 1;
      g[k === 0 ? "moveTo" : "lineTo"](...onCanvas(at, (radius * x) / rim, (radius * y) / rim));
    }
    g.fillStyle = fill;
    g.fill();
  }
  /** @param {Point} at @param {number} x @param {number} y @returns {[number, number]} */
  const onCanvas = ([px, py], x, y) => (upright ? [px + x, py - y] : [px + y, py + x]);

  /** @param {CanvasRenderingContext2D} g @param {number} k @param {Pose} pose @param {number} alpha @param {string} [ring] */
  function drawBall(g, k, { r, q }, alpha, ring) {
    const { name, radius: R } = /** @type {Film} */ (film).balls[k];
    const at = place(r[0], r[1]);
    // One that flies looks larger, one that falls in a pocket smaller.
    const radius = Math.max(R * scale * (1 + (r[2] > R ? 1 : 3) * (r[2] - R)), 3);
    const [colour, number] = [colourOf(name, k), Number(name)];
    const [w, i, j, n] = [q[0], q[1], q[2], q[3]];
    /** Where a direction on the ball, an axis of it, points now. @param {0 | 1 | 2} axis @param {number} sign */
    const axis = (axis, sign) =>
      [[1 - 2 * (j * j + n * n), 2 * (i * j + w * n), 2 * (i * n - w * j)], [2 * (i * j - w * n), 1 - 2 * (i * i + n * n), 2 * (j * n + w * i)], [2 * (i * n + w * j), 2 * (j * n - w * i), 1 - 2 * (i * i + j * j)]][axis].map((c) => sign * c);
    g.globalAlpha = alpha;
    g.fillStyle = colour;
    disc(g, r, radius);
    for (const sign of [1, -1]) {
      if (number > 8) cap(g, at, radius, axis(0, sign), END, IVORY);
      if (!(number > 0)) for (const side of /** @type {const} */ ([0, 1, 2])) cap(g, at, radius, axis(side, sign), DOT, colour === IVORY ? POOL[2] : "#ffffff90");
      else {
        const up = axis(2, sign);
        cap(g, at, radius, up, NUMBER, IVORY);
        if (up[2] < 0.2 || radius < 6) continue;
        // The number lies on the ball: its right and its lower side are axes of the ball, as they are seen.
        const [right, down] = upright ? [axis(0, sign), axis(1, -1)] : [axis(1, sign), axis(0, 1)];
        g.save();
        g.translate(...onCanvas(at, radius * up[0], radius * up[1]));
        g.transform(...onCanvas([0, 0], right[0], right[1]), ...onCanvas([0, 0], down[0], down[1]), 0, 0);
        g.fillStyle = "#16181b";
        g.font = `bold ${Math.round(radius * (number > 9 ? 0.7 : 0.85))}px sans-serif`;
        g.textAlign = "center";
        g.textBaseline = "middle";
        g.fillText(name, 0, 0.5);
        g.restore();
      }
    }
    // The light of a lamp above the table, and the rim.
    if (radius >= 5) g.drawImage(light, at[0] - radius, at[1] - radius, 2 * radius, 2 * radius);
    for (const [colour, beyond] of /** @type {[string, number][]} */ (ring ? [["#000a", 0], [ring, 1.5]] : [["#000a", 0]])) {
      g.strokeStyle = colour;
      g.lineWidth = beyond || 1;
      g.beginPath();
      g.arc(...at, radius + beyond, 0, 7);
      g.stroke();
    }
    g.globalAlpha = 1;
  }
  /** A highlight and a darker rim, for any ball. */
  const light = document.createElement("canvas");
  light.width = light.height = 128;
  {
    const g = /** @type {CanvasRenderingContext2D} */ (light.getContext("2d"));
    const rim = g.createRadialGradient(58, 56, 40, 64, 64, 64);
    rim.addColorStop(0, "#0000");
    rim.addColorStop(1, "#0004");
    const spot = g.createRadialGradient(46, 42, 2, 46, 42, 20);
    spot.addColorStop(0, "#fff8");
    spot.addColorStop(1, "#fff0");
    for (const fill of [rim, spot]) {
      g.fillStyle = fill;
      g.beginPath();
      g.arc(64, 64, 64, 0, 7);
      g.fill();
    }
  }

  function draw() {
    if (!film) return;
    // As large as its place is, but for its height no larger than the window.
    const { table, shots } = film;
    const [w, l] = [table.width + 2 * WOOD, table.length + 2 * WOOD];
    upright = document.documentElement.clientWidth < 480;
    const ratio = upright ? l / w : w / l;
    // A browser that does not know dvh keeps vh.
    for (const unit of ["vh", "dvh"]) canvas.style.maxWidth = `calc((100${unit} - var(--beside, 9rem)) * ${1 / ratio})`;
    const width = Math.max(canvas.clientWidth, 50);
    const height = Math.round(width * ratio);
    const dpr = Math.max(window.devicePixelRatio || 1, sharp);
    if (canvas.width !== Math.round(width * dpr) || canvas.height !== Math.round(height * dpr)) {
      canvas.style.height = `${height}px`;
      [canvas.width, canvas.height] = [Math.round(width * dpr), Math.round(height * dpr)];
    }
    scale = width / (upright ? w : l);
    offset = [WOOD * scale, upright ? height - WOOD * scale : WOOD * scale];
    if (zoom > 1 && middle) {
      // No further than the wood.
      const at = place(...middle);
      scale *= zoom;
      offset = /** @type {[number, number]} */ ([width, height].map((size, k) => size / 2 - Math.min(Math.max(zoom * at[k], size / 2), (zoom - 0.5) * size) + zoom * offset[k]));
    }
    drawTable(table, width, height, dpr);
    const g = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d", { alpha: false }));
    g.setTransform(dpr, 0, 0, dpr, 0, 0);
    g.drawImage(cloth, 0, 0, width, height);
    const dim = under?.(g) ?? false;

    // Trails, to the pocket that takes the ball.
    g.lineWidth = 1.6;
    g.lineJoin = g.lineCap = "round";
    const { apart = false } = film;
    for (const [index, { paths }] of shots.entries())
      for (const { ball, xyz } of paths) {
        const colour = colourOf(film.balls[ball].name, ball);
        g.strokeStyle = apart ? SHOTS[index % 8] : (BRIGHT[colour] ?? colour);
        g.setLineDash(apart && colour !== IVORY ? [7, 4] : []);
        g.globalAlpha = dim ? 0.5 : 0.8;
        g.beginPath();
        for (let k = 0; k < xyz.length; k += 3) {
          g[k === 0 ? "moveTo" : "lineTo"](...place(xyz[k], xyz[k + 1]));
          if (xyz[k + 2] < 0 && xyz[k + 2] === xyz[xyz.length - 1]) break; // where it lies
        }
        g.stroke();
      }
    g.setLineDash([]);
    g.globalAlpha = 1;
    // The balls at this time. Shots over each other: the first is plain, the others are seen through.
    shots.forEach((shot, index) => {
      shot.at(Math.min(time, shot.time)).forEach((pose, k) => pose.seen && drawBall(g, k, pose, index === 0 || apart ? 1 : 0.6, apart ? SHOTS[index % 8] : undefined));
    });
    over?.(g);
  }

  // ---- The clock ----------------------------------------------------------------------------------------------------------------

  function tell() {
    slider.value = String(time);
    said.textContent = `${time.toFixed(2)} s`;
    slider.setAttribute("aria-valuetext", said.textContent);
    // The event that was last.
    const current = list.children[all.findLastIndex((event) => event.time <= time + 1e-9)];
    const old = list.querySelector('[aria-current="true"]');
    if (old === current) return;
    old?.removeAttribute("aria-current");
    current?.setAttribute("aria-current", "true");
    if (current instanceof HTMLElement) events.scrollTop = current.offsetTop - events.offsetTop - 60;
  }
  /** @param {number} to */
  function put(to) {
    time = to;
    tell();
    draw();
    moved?.();
  }
  /** @param {number} now */
  function frame(now) {
    if (!playing) return;
    const step = Math.min((now - before) / 1000, 0.1) * Number(pace.value);
    before = now;
    put(Math.min(time + step, end));
    if (time < end) return void requestAnimationFrame(frame);
    stop();
    ended?.();
  }
  function start() {
    if (!film) return;
    if (time >= end) time = 0;
    playing = true;
    play.textContent = "Pause";
    before = performance.now();
    requestAnimationFrame(frame);
  }
  function stop() {
    playing = false;
    play.textContent = "Play";
  }
  /** Shows the table so many times larger, with a point of it in the middle, m. 1: all of it. @param {number} times @param {Point} [at] */
  function look(times, at) {
    zoom = Math.min(Math.max(times, 1), 6);
    if (at) middle = at;
    draw();
  }
  /** @param {number} to */
  function go(to) {
    if (still()) return tell();
    stop();
    put(to);
  }
  /** To the next event, or the one before. @param {1 | -1} by */
  function step(by) {
    const next = by > 0 ? all.find((event) => event.time > time + 1e-9) : all.findLast((event) => event.time < time - 1e-9);
    if (next) go(next.time);
  }
  play.addEventListener("click", () => (!playing ? start() : still() ? undefined : stop()));
  back.addEventListener("click", () => step(-1));
  forward.addEventListener("click", () => step(1));
  slider.addEventListener("input", () => go(slider.valueAsNumber));

  function listEvents() {
    list.replaceChildren(
      ...all.map((event) => {
        const row = make("button", { type: "button" }, make("span", {}, `${event.time.toFixed(3)} s`), make("span", {}, event.text));
        row.addEventListener("click", () => go(event.time));
        return make("li", {}, row);
      }),
    );
    tell();
  }

  /** Shows the start of a film. @param {Film} next */
  function show(next) {
    stop();
    film = next;
    time = 0;
    end = Math.max(0, ...next.shots.map((shot) => shot.time));
    slider.max = String(Math.max(end, 0.001));
    all = next.shots.flatMap((shot) => shot.events).sort((a, b) => a.time - b.time);
    // The list waits until nothing has changed for a moment: it costs more than a shot.
    window.clearTimeout(listing);
    list.replaceChildren();
    listing = window.setTimeout(listEvents, 100);
    tell();
    draw();
  }

  return {
    ...{ canvas, controls, events, play, pace, show, draw, go, look, start, stop, step, place, unplace, drawBall },
    get time() {
      return time;
    },
    get scale() {
      return scale;
    },
    get zoom() {
      return zoom;
    },
    get end() {
      return end;
    },
    get playing() {
      return playing;
    },
  };
}
