// The view Collision: the cue ball hits a ball at rest.
import type { Carom, Impact, Motion, Vec3 } from "carom";
import { fit } from "../../../player/table.js";
import { DEGREES } from "../table/drawing.js";
import { pixelsOf } from "../table/grip.js";
import {
  arrow,
  check,
  color,
  drags,
  eachFrame,
  el,
  keep,
  numberRows,
  parameters,
  slider,
  type Slider,
  valuesOf,
} from "../ui.js";
import { type Column, merged, plot } from "./plots.js";
import { texts } from "../texts/texts.js";

declare const MEASURED: string;

const R = 0.028575;
const MASS = 0.170097;
const CURVE = 121;

const DEFAULTS: Record<string, number> = {
  speed: 1.5,
  cut: 30,
  side: 0,
  tip: 0.4,
  mu: 0.06,
  cloth: 0.2,
  e: 0.95,
};
/** The values of the sliders, and whether friction between the balls follows Alciatore's law. */
type Setting = Record<"speed" | "cut" | "side" | "tip" | "mu" | "cloth" | "e", number> & {
  law: boolean;
};

/**
 * The cue ball moves along x; the object ball is to the left at cut angles above 0. Spins are those
 * of a level strike at the tip.
 */
function impactOf(s: Setting, over: Partial<Setting> = {}): Impact {
  const { speed, cut, side, tip, mu, cloth, e, law } = { ...s, ...over };
  const angle = cut / DEGREES;
  const kind = { radius: R, mass: MASS, muSlide: cloth };
  return {
    a: { v: [speed, 0, 0], w: [0, (2.5 * speed * tip) / R, (2.5 * speed * side) / R], ...kind },
    b: { r: [2 * R * Math.cos(angle), 2 * R * Math.sin(angle), 0], ...kind },
    muBall: law ? undefined : mu,
    restitution: e,
  };
}

const norm = (v: readonly number[]): number => Math.hypot(...v);
const direction = (v: Vec3): number => Math.atan2(v[1], v[0]) * DEGREES;
const energy = (m: Motion): number =>
  0.5 * MASS * norm(m.v) ** 2 + 0.2 * MASS * R * R * norm(m.w) ** 2;
const turn = (degrees: number): number => ((((degrees + 180) % 360) + 360) % 360) - 180;
const sided = (degrees: number): string =>
  Math.abs(degrees) < 0.005
    ? "0.00°"
    : `${Math.abs(degrees).toFixed(2)}° ${degrees > 0 ? texts.toTheLeft : texts.toTheRight}`;

/**
 * Measured by Mathavan and others, 2014: rolling cue balls of snooker. Directions are those after
 * the balls roll.
 */
const experiments = MEASURED.trim()
  .split("\n")
  .slice(1)
  .map((line) => line.split(",").map(Number))
  .map((row) => ({ cut: row[3]!, deflection: row[8]! }));
/**
 * Throw of a stun shot at 45 degrees, as D. Alciatore reports it for four surfaces of balls
 * (data/measured.csv).
 */
const throws = [3.6, 4.9, 11, 11.6];

/**
 * The setting, the canvas and what is written; how large a ball is on the canvas, pixels, and where
 * the object ball is.
 */
interface View {
  readonly carom: Carom;
  readonly solver: () => "exact" | "euler";
  readonly controls: ReturnType<typeof controlsOf>;
  readonly canvas: HTMLCanvasElement;
  readonly numbers: HTMLElement;
  readonly plots: ReturnType<typeof plotsOf>;
  readonly curve: ReturnType<Carom["collisions"]>;
  scale: number;
  origin: readonly [number, number];
}

function controlsOf(update: () => void) {
  const query = parameters();
  const two = (x: number): string => x.toFixed(2);
  const sliders: Record<Exclude<keyof Setting, "law">, Slider> = {
    speed: slider("speed", texts.speedAtTheContact, 0.1, 8, 0.1, " m/s", update, (x) =>
      x.toFixed(1),
    ),
    cut: slider("cut", texts.cutAngle, -85, 85, 0.5, "°", update, (x) => x.toFixed(1)),
    side: slider("side", texts.tipToTheRight, -0.7, 0.7, 0.01, " R", update, two),
    tip: slider("tip", texts.tipAboveRolls, -0.7, 0.7, 0.01, " R", update, two),
    mu: slider("mu", texts.frictionBetweenTheBalls, 0, 0.2, 0.001, "", update, (x) => x.toFixed(3)),
    cloth: slider("cloth", texts.frictionWithTheCloth, 0, 0.5, 0.01, "", update, two),
    e: slider("e", texts.restitution, 0.5, 1, 0.01, "", update, two),
  };
  for (const [key, control] of Object.entries(sliders)) {
    const x = query.has(key) ? Number(query.get(key)) : NaN;
    control.value = Number.isFinite(x) ? x : DEFAULTS[key]!;
  }
  const law = check("law", texts.byAlciatoreSLaw, update);
  law.input.checked = query.get("law") !== "0";
  return { sliders, law };
}

// ---- Curves -------------------------------------------------------------------------------------

function plotsOf(into: HTMLElement) {
  const cut = [texts.cutAngleAxis, -85, 85] as const;
  return {
    throwByCut: plot(into, {
      id: "plot-throw-cut",
      title: texts.throwAgainstCutAngle,
      x: cut,
      y: texts.throwLeft,
      note: texts.orangeThisCollisionGrey,
      series: [
        { label: texts.throwCurve, color: "accent" },
        { label: texts.reportedAt45, color: "quiet", points: true },
      ],
    }),
    throwBySide: plot(into, {
      id: "plot-throw-side",
      title: texts.throwAgainstSideSpin,
      x: [texts.tipToTheRightR, -0.7, 0.7],
      y: texts.throwLeft,
      note: texts.whereTheCurveCrosses,
      series: [{ label: texts.throwCurve, color: "accent" }],
    }),
    deflection: plot(into, {
      id: "plot-deflection",
      title: texts.deflectionOfTheCue,
      x: cut,
      y: texts.deflectionLeft,
      band: [27, 34],
      note: texts.bandThe30Degree,
      series: [
        { label: texts.deflectionCurve, color: "accent" },
        { label: texts.measured, color: "quiet", points: true },
      ],
    }),
    inside: plot(into, {
      id: "plot-inside",
      title: texts.insideTheContact,
      x: [texts.normalImpulseSoFar, 0, 0],
      y: "m/s",
      note: texts.theBallsPressOn,
      series: [
        { label: texts.slipOfTheBalls, color: "accent" },
        { label: texts.ofTheCueBall, color: "quiet", dash: [6, 4] },
        { label: texts.ofTheObjectBall, color: "cloth", dash: [2, 3] },
        { label: texts.partingSpeed, color: "warm" },
      ],
    }),
  };
}

/**
 * Throw, and the deflection of the cue ball once it rolls, degrees, along a range of one setting.
 */
function along(
  { carom, curve, solver }: View,
  s: Setting,
  key: "cut" | "side",
  start: number,
  end: number,
): { x: number[]; thrown: Column; deflected: Column } {
  const x = Array.from({ length: CURVE }, (_, k) => start + ((end - start) * k) / (CURVE - 1));
  x.forEach((value, k) => curve.set(k, impactOf(s, { [key]: value })));
  carom.collideBatch(curve, { solver: solver() });
  const thrown: Column = [];
  const deflected: Column = [];
  x.forEach((value, k) => {
    const ok = curve.status[k] === 0;
    const { a, b } = curve.get(k);
    thrown.push(ok ? turn(direction(b.v) - (key === "cut" ? value : s.cut)) : null);
    const rolls = carom.rollingVelocity(a, R);
    deflected.push(ok && norm(rolls) > 1e-6 ? direction(rolls) : null);
  });
  return { x, thrown, deflected };
}

function drawCurves(view: View, s: Setting, impact: Impact, thrown: number, rolls: Vec3): void {
  const { carom, plots, solver } = view;
  const byCut = along(view, s, "cut", -85, 85);
  plots.throwByCut.set(
    merged(
      byCut.x,
      byCut.thrown,
      throws.map((y, k) => ({ x: 45 + 1e-6 * k, y: -y })),
    ),
    [{ x: s.cut, y: thrown }],
  );
  const bySide = along(view, s, "side", -0.7, 0.7);
  plots.throwBySide.set([bySide.x, bySide.thrown], [{ x: s.side, y: thrown }]);
  plots.deflection.set(
    merged(
      byCut.x,
      byCut.deflected,
      experiments.map((experiment) => ({ x: experiment.cut, y: -experiment.deflection })),
    ),
    norm(rolls) > 1e-6 ? [{ x: s.cut, y: direction(rolls) }] : [],
  );
  const trace = carom.trace(impact, 61, { solver: solver() });
  plots.inside.set(
    [
      trace.map((p) => p.normal),
      trace.map((p) => Math.hypot(p.uX, p.uZ)),
      trace.map((p) => norm(p.d)),
      trace.map((p) => norm(p.b)),
      trace.map((p) => p.vN),
    ],
    [],
  );
}

// ---- Numbers and drawing ------------------------------------------------------------------------

/** The rows of numbers: their ids, names and texts. */
function rowsOf(
  s: Setting,
  impact: Impact,
  { a, b, status, detail }: ReturnType<Carom["collideDetail"]>,
  [rollsA, rollsB]: readonly Vec3[],
  euler: boolean,
): [string, string, string][] {
  const initial = energy({ v: impact.a.v!, w: impact.a.w! });
  const lost = initial - energy(a) - energy(b);
  const gearing = Math.sin(s.cut / DEGREES) / 2.5;
  const way = (v: Vec3, stops = false): string =>
    stops && norm(v) < 1e-9 ? texts.stops : `${sided(direction(v))}, ${norm(v).toFixed(3)} m/s`;
  return [
    ["throw", texts.throwOf, sided(turn(direction(b.v) - s.cut))],
    ["object", texts.objectBall, way(b.v)],
    ["object-rolling", texts.onceItRolls, way(rollsB!)],
    ["deflection", texts.cueBall, way(a.v, true)],
    ["rolling", texts.onceItRolls, way(rollsA!, true)],
    ["spin", texts.sideSpinTransferred, `${b.w[2].toFixed(2)} rad/s`],
    ["vertical", texts.rollTransferred, `${norm([b.w[0], b.w[1]]).toFixed(2)} rad/s`],
    [
      "gearing",
      texts.noThrowWithThe,
      Math.abs(gearing) > 0.7
        ? texts.beyond07R
        : `${Math.abs(gearing).toFixed(3)} R ${gearing > 0 ? texts.toTheRight : texts.toTheLeft}`,
    ],
    [
      "energy",
      texts.energyLost,
      `${(1000 * lost).toFixed(1)} mJ, ${((100 * lost) / initial).toFixed(1)} %`,
    ],
    ["impulse", texts.normalImpulse, `${detail.normal.toFixed(4)} N s`],
    ["friction", texts.impulseOfFriction, `${norm(detail.friction).toFixed(4)} N s`],
    ["stick", texts.theBallsStick, euler ? texts.unknownWithEulerSteps : detail.stick],
    ["status", texts.status, status],
  ];
}

function draw(view: View, s: Setting, a: Motion, b: Motion): void {
  const [width, height, dpr] = fit(view.canvas, 0.66);
  const g = view.canvas.getContext("2d")!;
  g.setTransform(dpr, 0, 0, dpr, 0, 0);
  g.fillStyle = color("cloth");
  g.fillRect(0, 0, width, height);
  // The object ball is in the middle; the cue ball arrives from the left.
  const radius = Math.min(width, height) / 7;
  view.scale = radius;
  view.origin = [width * 0.5, height * 0.5];
  const angle = s.cut / DEGREES;
  const [ox, oy] = view.origin;
  const cx = ox - 2 * radius * Math.cos(angle);
  const cy = oy + 2 * radius * Math.sin(angle);
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
  const toPixels = (v: readonly number[]): [number, number] => [
    (v[0]! / s.speed) * longest,
    (-v[1]! / s.speed) * longest,
  ];
  arrow(g, cx - longest - radius, cy, longest, 0, "#ffffff");
  arrow(g, cx, cy, ...toPixels(view.carom.rollingVelocity(a, R)), "#0b2f4f", true);
  arrow(g, cx, cy, ...toPixels(a.v), "#0b2f4f");
  arrow(g, ox, oy, ...toPixels(view.carom.rollingVelocity(b, R)), "#4a2a00", true);
  arrow(g, ox, oy, ...toPixels(b.v), "#4a2a00");
  // Side spin: an arc around the ball, in the sense in which it turns.
  for (const [x, y, w] of [
    [cx, cy, a.w[2]],
    [ox, oy, b.w[2]],
  ] as const) {
    const size = Math.min(Math.abs(w) / 40, 1) * Math.PI * 1.5;
    if (size < 0.2) continue;
    g.strokeStyle = "#b3261e";
    g.lineWidth = 3;
    g.beginPath();
    g.arc(x, y, radius * 0.72, -Math.PI / 2, -Math.PI / 2 - Math.sign(w) * size, w > 0);
    g.stroke();
  }
}

/** Computes what is set, and shows it; the address keeps it. */
function show(view: View): void {
  const { carom, solver, controls, canvas, numbers } = view;
  const { sliders, law } = controls;
  const s = { ...valuesOf(sliders), law: law.input.checked };
  const impact = impactOf(s);
  const euler = solver() === "euler";
  sliders.mu.input.disabled = law.input.checked;
  if (law.input.checked) sliders.mu.value = carom.muBall(impact);
  const result = carom.collideDetail(impact, { solver: solver() });
  const { a, b } = result;
  const rolls = [carom.rollingVelocity(a, R), carom.rollingVelocity(b, R)];
  numbers.replaceChildren(...numberRows("n", rowsOf(s, impact, result, rolls, euler)));
  canvas.setAttribute(
    "aria-label",
    texts.twoBallsFromAbove(
      s.cut.toFixed(1),
      sided(direction(b.v)),
      norm(b.v).toFixed(2),
      sided(direction(a.v)),
      norm(a.v).toFixed(2),
    ),
  );
  draw(view, s, a, b);
  drawCurves(view, s, impact, turn(direction(b.v) - s.cut), rolls[0]!);

  const settings: Record<string, string> = { view: "collision" };
  for (const [key, control] of Object.entries(sliders))
    if ((key !== "mu" || !law.input.checked) && control.value !== DEFAULTS[key])
      settings[key] = String(control.value);
  if (!law.input.checked) settings.law = "0";
  if (euler) settings.solver = "euler";
  keep(settings);
}

/** Lets the cue ball be dragged around the other one, or turned by keys. */
function handle(view: View, update: () => void): void {
  const {
    canvas,
    controls: { sliders },
  } = view;
  const soon = eachFrame(update);
  const cutTo = (cut: number): void => void (sliders.cut.value = Math.max(-85, Math.min(85, cut)));
  drags(canvas, (event) => {
    const [x, y] = pixelsOf(canvas, event).map((coordinate, k) => coordinate - view.origin[k]!) as [
      number,
      number,
    ];
    if (Math.hypot(x, y) < view.scale / 2) return;
    cutTo(Math.round(2 * Math.atan2(y, -x) * DEGREES) / 2);
    soon();
  });
  canvas.addEventListener("keydown", (event) => {
    const step = { ArrowLeft: -0.5, ArrowRight: 0.5, ArrowUp: 5, ArrowDown: -5 }[event.key];
    if (step === undefined) return;
    event.preventDefault();
    cutTo(sliders.cut.value + step);
    update();
  });
}

export function collisionView(
  carom: Carom,
  solver: View["solver"],
  main: HTMLElement,
): { update(): void; theme(): void } {
  const update = (): void => show(view);
  const controls = controlsOf(update);
  const canvas = el("canvas#collision-scene.scene", { role: "img", tabindex: "0" });
  const numbers = el("tbody");
  const curves = el("div.plots");
  const roots = (...keys: Exclude<keyof Setting, "law">[]): HTMLElement[] =>
    keys.map((key) => controls.sliders[key].root);
  main.replaceChildren(
    el(
      "div.columns",
      el(
        "section.panel.first",
        { "aria-label": texts.settings },
        el("h2", texts.twoBallsMeet),
        ...roots("speed", "cut", "side", "tip"),
        controls.law.root,
        ...roots("mu", "cloth", "e"),
      ),
      el(
        "section.panel.scene-panel",
        { "aria-label": texts.seenFromAbove },
        canvas,
        el("p.note", texts.dragTheWhiteBall),
      ),
      el(
        "section.panel",
        { "aria-label": texts.numbers },
        el("table#collision-numbers.numbers", el("caption", texts.justAfterAndOnce), numbers),
      ),
    ),
    curves,
  );
  const view: View = {
    carom,
    solver,
    controls,
    canvas,
    numbers,
    plots: plotsOf(curves),
    curve: carom.collisions(CURVE),
    scale: 1,
    origin: [0, 0],
  };
  handle(view, update);
  update();
  return {
    update,
    theme() {
      for (const plot of Object.values(view.plots)) plot.theme();
      update();
    },
  };
}
