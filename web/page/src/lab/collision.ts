// The view Collision: the cue ball meets a ball at rest.
import type { Carom, CollideOptions, Impact, Motion, Vec3 } from "carom";
import uPlot from "uplot";
import { arrow, check, color, eachFrame, el, fit, keep, parameters, slider, type Slider } from "../ui.js";

declare const MEASURED: string;

const R = 0.028575;
const MASS = 0.170097;
const DEGREES = 180 / Math.PI;
const CURVE = 121;

interface Setting {
  speed: number;
  cut: number;
  side: number;
  tip: number;
  muBall: number | undefined;
  muCloth: number;
  restitution: number;
}

/** The cue ball moves along x; the object ball is to the left at cut angles above 0. Spins are those of a level strike at the tip. */
function impactOf(s: Setting, over: Partial<Setting> = {}): Impact {
  const { speed, cut, side, tip, muBall, muCloth, restitution } = { ...s, ...over };
  const angle = cut / DEGREES;
  const kind = { radius: R, mass: MASS, muCloth };
  return {
    a: { v: [speed, 0, 0], w: [0, (2.5 * speed * tip) / R, (2.5 * speed * side) / R], ...kind },
    b: { r: [2 * R * Math.cos(angle), 2 * R * Math.sin(angle), 0], ...kind },
    muBall,
    restitution,
  };
}

const norm = (v: readonly number[]): number => Math.hypot(...v);
const direction = (v: Vec3): number => Math.atan2(v[1], v[0]) * DEGREES;
const energy = (m: Motion): number => 0.5 * MASS * norm(m.v) ** 2 + 0.2 * MASS * R * R * norm(m.w) ** 2;
const turn = (degrees: number): number => ((((degrees + 180) % 360) + 360) % 360) - 180;
const sided = (degrees: number): string => (Math.abs(degrees) < 0.005 ? "0.00°" : `${Math.abs(degrees).toFixed(2)}° ${degrees > 0 ? "left" : "right"}`);

/** Measured by Mathavan and others, 2014: rolling cue balls of snooker. Directions are those after the balls roll. */
const experiments = MEASURED.trim()
  .split("\n")
  .slice(1)
  .map((line) => line.split(",").map(Number))
  .map((row) => ({ cut: row[3]!, deflection: row[8]! }));
/** Throw of a stun shot at 45 degrees, as D. Alciatore reports it for four surfaces of balls (data/measured.csv). */
const throws = [3.6, 4.9, 11, 11.6];

interface PlotOf {
  plot: uPlot;
  marks: { x: number; y: number }[];
  set(data: (number | null)[][], marks: { x: number; y: number }[]): void;
}

export function collisionView(carom: Carom, solver: () => "exact" | "euler", main: HTMLElement): { update(): void; theme(): void } {
  const options = (): CollideOptions => ({ solver: solver() });
  const given = parameters();
  const start = (key: string, otherwise: number): number => {
    const x = given.has(key) ? Number(given.get(key)) : NaN;
    return Number.isFinite(x) ? x : otherwise;
  };
  const two = (x: number): string => x.toFixed(2);
  const sliders: Record<string, Slider> = {
    speed: slider("speed", "Speed at the contact", 0.1, 8, 0.1, " m/s", update, (x) => x.toFixed(1)),
    cut: slider("cut", "Cut angle", -85, 85, 0.5, "°", update, (x) => x.toFixed(1)),
    side: slider("side", "Tip to the right (+) or left", -0.7, 0.7, 0.01, " R", update, two),
    tip: slider("tip", "Tip above (+) or below; 0.4 rolls", -0.7, 0.7, 0.01, " R", update, two),
    mu: slider("mu", "Friction between the balls", 0, 0.2, 0.001, "", update, (x) => x.toFixed(3)),
    cloth: slider("cloth", "Friction with the cloth", 0, 0.5, 0.01, "", update, two),
    e: slider("e", "Restitution", 0.5, 1, 0.01, "", update, two),
  };
  const defaults: Record<string, number> = { speed: 1.5, cut: 30, side: 0, tip: 0.4, mu: 0.06, cloth: 0.2, e: 0.95 };
  for (const [key, one] of Object.entries(sliders)) one.value = start(key, defaults[key]!);
  const law = check("law", "By Alciatore's law from the slip", () => update());
  law.input.checked = given.get("law") !== "0";

  const canvas = el("canvas", { class: "scene", id: "collision-scene", role: "img", tabindex: "0" });
  const numbers = el("tbody");
  const table = el("table", { class: "numbers", id: "collision-numbers" }, el("caption", {}, "Just after, and once the balls roll"), numbers);
  const plots = el("div", { class: "plots" });
  main.replaceChildren(
    el(
      "div",
      { class: "columns" },
      el("section", { class: "panel first", "aria-label": "Settings" }, el("h2", {}, "Two balls meet"), ...["speed", "cut", "side", "tip"].map((k) => sliders[k]!.root), law.root, ...["mu", "cloth", "e"].map((k) => sliders[k]!.root)),
      el("section", { class: "panel scene-panel", "aria-label": "Seen from above" }, canvas, el("p", { class: "note" }, "Drag the white ball around the other one, or use the arrow keys, to set the cut. Solid arrows: just after the contact. Dashed: once the ball rolls. Red arcs: side spin.")),
      el("section", { class: "panel", "aria-label": "Numbers" }, table),
    ),
    plots,
  );

  function setting(): Setting {
    const v = (key: string): number => sliders[key]!.value;
    return { speed: v("speed"), cut: v("cut"), side: v("side"), tip: v("tip"), muBall: law.input.checked ? undefined : v("mu"), muCloth: v("cloth"), restitution: v("e") };
  }

  // ---- Curves --------------------------------------------------------------------------------------------------------------

  const curve = carom.collisions(CURVE);
  /** Throw, and the deflection of the cue ball once it rolls, degrees, along a range of one setting. */
  function along(s: Setting, key: "cut" | "side", from: number, to: number): { x: number[]; thrown: (number | null)[]; deflected: (number | null)[] } {
    const x = Array.from({ length: CURVE }, (_, k) => from + ((to - from) * k) / (CURVE - 1));
    x.forEach((value, k) => curve.set(k, impactOf(s, { [key]: value })));
    carom.collideBatch(curve, options());
    const thrown: (number | null)[] = [];
    const deflected: (number | null)[] = [];
    x.forEach((value, k) => {
      const ok = curve.status[k] === 0;
      const { a, b } = curve.get(k);
      thrown.push(ok ? turn(direction(b.v) - (key === "cut" ? value : s.cut)) : null);
      const rolls = carom.rollingVelocity(a, R);
      deflected.push(ok && norm(rolls) > 1e-6 ? direction(rolls) : null);
    });
    return { x, thrown, deflected };
  }

  function plot(id: string, title: string, note: string, x: [string, number, number], y: string, series: { label: string; color: string; dash?: number[]; points?: boolean }[], band?: [number, number]): PlotOf {
    const place = el("div");
    plots.append(el("section", { class: "panel plot", id, "aria-label": title }, el("h2", {}, title), place, el("p", {}, note)));
    const marks: { x: number; y: number }[] = [];
    let made: uPlot;
    let last: (number | null)[][] = [[], ...series.map(() => [])];
    const build = (): uPlot => {
      const axis = { stroke: color("quiet"), grid: { stroke: color("line"), width: 1 }, ticks: { stroke: color("line") } };
      return new uPlot(
        {
          width: Math.max(place.clientWidth, 240),
          height: 230,
          legend: { live: false },
          cursor: { drag: { x: false, y: false } },
          scales: { x: { time: false, ...(x[2] > x[1] ? { range: [x[1], x[2]] } : {}) } },
          axes: [{ ...axis, label: x[0], labelSize: 20 }, { ...axis, label: y, labelSize: 20, size: 48 }],
          series: [
            { label: x[0] },
            ...series.map((one) => ({
              label: one.label,
              stroke: color(one.color),
              width: one.points ? 0 : 2,
              dash: one.dash,
              points: { show: one.points === true, size: 8, fill: color(one.color) },
            })),
          ],
          hooks: {
            drawClear: [
              (u) => {
                if (!band) return;
                const [low, high] = band.map((v) => u.valToPos(v, "y", true)) as [number, number];
                u.ctx.fillStyle = color("band");
                for (const side of [1, -1]) {
                  const top = side === 1 ? high : u.valToPos(-band[1], "y", true);
                  u.ctx.fillRect(u.bbox.left, Math.min(top, side === 1 ? low : u.valToPos(-band[0], "y", true)), u.bbox.width, Math.abs(high - low));
                }
              },
            ],
            draw: [
              (u) => {
                for (const mark of marks) {
                  u.ctx.fillStyle = color("warm");
                  u.ctx.beginPath();
                  u.ctx.arc(u.valToPos(mark.x, "x", true), u.valToPos(mark.y, "y", true), 5 * devicePixelRatio, 0, 7);
                  u.ctx.fill();
                }
              },
            ],
          },
        },
        last as uPlot.AlignedData,
        place,
      );
    };
    made = build();
    return {
      get plot() {
        made.destroy();
        made = build();
        return made;
      },
      marks,
      set(data, at) {
        last = data;
        marks.splice(0, marks.length, ...at);
        made.setData(data as uPlot.AlignedData);
        const width = Math.max(place.clientWidth, 240);
        if (Math.abs(made.width - width) > 2) made.setSize({ width, height: 230 });
      },
    };
  }

  const points = (at: { x: number; y: number }[], x: number[]): (number | null)[] => {
    const y: (number | null)[] = x.map(() => null);
    for (const point of at) y[x.findIndex((value) => value === point.x)] = point.y;
    return y;
  };
  /** A curve and points at x of their own, on one ascending axis. */
  const merged = (x: number[], y: (number | null)[], at: { x: number; y: number }[]): (number | null)[][] => {
    const all = [...new Set([...x, ...at.map((point) => point.x)])].sort((a, b) => a - b);
    const line = all.map((value) => {
      const k = x.findIndex((one) => one >= value);
      if (k <= 0 || x[k] === value) return y[Math.max(k, 0)] ?? null;
      const [before, after] = [y[k - 1], y[k]];
      return before == null || after == null ? null : before + ((after - before) * (value - x[k - 1]!)) / (x[k]! - x[k - 1]!);
    });
    return [all, line, points(at, all)];
  };

  const throwByCut = plot("plot-throw-cut", "Throw against cut angle", "Orange: this collision. Grey: throw at 45° without spin, as D. Alciatore reports it for balls cleaned with Aramith (3.6°), used (4.9°), cleaned with alcohol (11°) and chalked at the contact (11.6°).", ["cut angle, °", -85, 85], "throw, ° (+ left)", [
    { label: "throw", color: "accent" },
    { label: "reported at 45°", color: "quiet", points: true },
  ]);
  const throwBySide = plot("plot-throw-side", "Throw against side spin", "Where the curve crosses 0 the balls roll on each other like gears.", ["tip to the right, R", -0.7, 0.7], "throw, ° (+ left)", [{ label: "throw", color: "accent" }]);
  const deflection = plot("plot-deflection", "Deflection of the cue ball, once it rolls", "Band: the 30-degree rule, 27° to 34°. Points: five rolling shots measured by Mathavan and others (2014), on a snooker table.", ["cut angle, °", -85, 85], "deflection, ° (+ left)", [
    { label: "deflection", color: "accent" },
    { label: "measured", color: "quiet", points: true },
  ], [27, 34]);
  const inside = plot("plot-inside", "Inside the contact", "The balls press on each other for about 0.2 ms. Slips are speeds of one surface over the other; approach ends where compression turns into restitution.", ["normal impulse so far, N s", 0, 0], "m/s", [
    { label: "slip of the balls", color: "accent" },
    { label: "of the cue ball on the cloth", color: "quiet", dash: [6, 4] },
    { label: "of the object ball on the cloth", color: "cloth", dash: [2, 3] },
    { label: "parting", color: "warm" },
  ]);
  const all = [throwByCut, throwBySide, deflection, inside];

  // ---- Drawing -------------------------------------------------------------------------------------------------------------

  let scale = 1;
  let origin: [number, number] = [0, 0];
  function draw(s: Setting, a: Motion, b: Motion): void {
    const { g, width, height } = fit(canvas, 0.66);
    g.fillStyle = color("cloth");
    g.fillRect(0, 0, width, height);
    // The object ball is in the middle; the cue ball comes from the left.
    const radius = Math.min(width, height) / 7;
    scale = radius;
    origin = [width * 0.5, height * 0.5];
    const angle = s.cut / DEGREES;
    const [ox, oy] = origin;
    const [cx, cy] = [ox - 2 * radius * Math.cos(angle), oy + 2 * radius * Math.sin(angle)];
    const ball = (x: number, y: number, fill: string): void => {
      g.beginPath();
      g.arc(x, y, radius, 0, 7);
      g.fillStyle = fill;
      g.fill();
      g.strokeStyle = "#0008";
      g.lineWidth = 1;
      g.stroke();
    };
    g.strokeStyle = "#ffffff70";
    g.lineWidth = 1.5;
    g.setLineDash([4, 6]);
    g.beginPath();
    g.moveTo(cx - 3 * radius, cy);
    g.lineTo(cx + 6 * radius, cy);
    g.moveTo(cx, cy);
    g.lineTo(cx + 7 * radius * Math.cos(angle), cy - 7 * radius * Math.sin(angle));
    g.stroke();
    g.setLineDash([]);
    ball(cx, cy, "#fbfaf5");
    ball(ox, oy, "#d8a400");
    const longest = Math.min(width * 0.36, 3.2 * radius);
    const to = (v: readonly number[]): [number, number] => [(v[0]! / s.speed) * longest, (-v[1]! / s.speed) * longest];
    arrow(g, cx - longest - radius, cy, longest, 0, "#ffffff");
    arrow(g, cx, cy, ...to(carom.rollingVelocity(a, R)), "#0b2f4f", true);
    arrow(g, cx, cy, ...to(a.v), "#0b2f4f");
    arrow(g, ox, oy, ...to(carom.rollingVelocity(b, R)), "#4a2a00", true);
    arrow(g, ox, oy, ...to(b.v), "#4a2a00");
    // Side spin: an arc around the ball, in the sense in which it turns.
    for (const [x, y, w] of [[cx, cy, a.w[2]], [ox, oy, b.w[2]]] as const) {
      const size = Math.min(Math.abs(w) / 40, 1) * Math.PI * 1.5;
      if (size < 0.2) continue;
      g.strokeStyle = "#b3261e";
      g.lineWidth = 3;
      g.beginPath();
      g.arc(x, y, radius * 0.72, -Math.PI / 2, -Math.PI / 2 - Math.sign(w) * size, w > 0);
      g.stroke();
    }
  }

  function update(): void {
    const s = setting();
    const impact = impactOf(s);
    sliders.mu!.input.disabled = law.input.checked;
    if (law.input.checked) sliders.mu!.value = carom.muBall(impact);
    const { a, b, status, detail } = carom.collideDetail(impact, options());
    const [rollsA, rollsB] = [carom.rollingVelocity(a, R), carom.rollingVelocity(b, R)];
    const before = energy({ v: impact.a.v!, w: impact.a.w! });
    const lost = before - energy(a) - energy(b);
    const thrown = turn(direction(b.v) - s.cut);
    const gearing = Math.sin(s.cut / DEGREES) / 2.5;
    const rows: [string, string, string][] = [
      ["throw", "Throw", sided(thrown)],
      ["object", "Object ball", `${sided(direction(b.v))}, ${norm(b.v).toFixed(3)} m/s`],
      ["object-rolling", "once it rolls", `${sided(direction(rollsB))}, ${norm(rollsB).toFixed(3)} m/s`],
      ["deflection", "Cue ball", norm(a.v) < 1e-9 ? "stops" : `${sided(direction(a.v))}, ${norm(a.v).toFixed(3)} m/s`],
      ["rolling", "once it rolls", norm(rollsA) < 1e-9 ? "stops" : `${sided(direction(rollsA))}, ${norm(rollsA).toFixed(3)} m/s`],
      ["spin", "Side spin transferred", `${b.w[2].toFixed(2)} rad/s`],
      ["vertical", "Roll transferred", `${norm([b.w[0], b.w[1]]).toFixed(2)} rad/s`],
      ["gearing", "No throw with the tip at", Math.abs(gearing) > 0.7 ? "beyond 0.7 R" : `${Math.abs(gearing).toFixed(3)} R ${gearing > 0 ? "right" : "left"}`],
      ["energy", "Energy lost", `${(1000 * lost).toFixed(1)} mJ, ${((100 * lost) / before).toFixed(1)} %`],
      ["impulse", "Normal impulse", `${detail.normal.toFixed(4)} N s`],
      ["friction", "Impulse of friction", `${norm(detail.friction).toFixed(4)} N s`],
      ["stick", "The balls stick", solver() === "euler" ? "unknown with Euler steps" : detail.stick],
      ["status", "Status", status],
    ];
    numbers.replaceChildren(...rows.map(([id, name, text]) => el("tr", {}, el("th", { scope: "row" }, name), el("td", { id: `n-${id}` }, text))));
    canvas.setAttribute("aria-label", `Two balls from above. Cut ${s.cut.toFixed(1)} degrees; the object ball goes ${sided(direction(b.v))} at ${norm(b.v).toFixed(2)} m/s, the cue ball ${sided(direction(a.v))} at ${norm(a.v).toFixed(2)} m/s.`);
    draw(s, a, b);

    const byCut = along(s, "cut", -85, 85);
    throwByCut.set(merged(byCut.x, byCut.thrown, throws.map((y, k) => ({ x: 45 + 1e-6 * k, y: -y }))), [{ x: s.cut, y: thrown }]);
    const bySide = along(s, "side", -0.7, 0.7);
    throwBySide.set([bySide.x, bySide.thrown], [{ x: s.side, y: thrown }]);
    deflection.set(merged(byCut.x, byCut.deflected, experiments.map((one) => ({ x: one.cut, y: -one.deflection }))), norm(rollsA) > 1e-6 ? [{ x: s.cut, y: direction(rollsA) }] : []);
    const trace = carom.trace(impact, 61, options());
    inside.set([trace.map((p) => p.normal), trace.map((p) => Math.hypot(p.uX, p.uZ)), trace.map((p) => norm(p.d)), trace.map((p) => norm(p.b)), trace.map((p) => p.vN)], []);

    const kept: Record<string, string> = { view: "collision" };
    for (const [key, one] of Object.entries(sliders)) if (key !== "mu" || !law.input.checked) if (one.value !== defaults[key]) kept[key] = String(one.value);
    if (!law.input.checked) kept.law = "0";
    if (solver() === "euler") kept.solver = "euler";
    keep(kept);
  }

  // ---- Dragging ------------------------------------------------------------------------------------------------------------

  const soon = eachFrame(update);
  const aim = (event: PointerEvent): void => {
    const box = canvas.getBoundingClientRect();
    const [x, y] = [event.clientX - box.left - origin[0], event.clientY - box.top - origin[1]];
    if (Math.hypot(x, y) < scale / 2) return;
    sliders.cut!.value = Math.max(-85, Math.min(85, Math.round(2 * Math.atan2(y, -x) * DEGREES) / 2));
    soon();
  };
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    aim(event);
  });
  canvas.addEventListener("pointermove", (event) => {
    if (canvas.hasPointerCapture(event.pointerId)) aim(event);
  });
  canvas.addEventListener("keydown", (event) => {
    const step = { ArrowLeft: -0.5, ArrowRight: 0.5, ArrowUp: 5, ArrowDown: -5 }[event.key];
    if (step === undefined) return;
    event.preventDefault();
    sliders.cut!.value = Math.max(-85, Math.min(85, sliders.cut!.value + step));
    update();
  });

  update();
  return {
    update,
    theme() {
      for (const one of all) void one.plot;
      update();
    },
  };
}
