// The player of films: a table seen from above, and a clock to play shots by. The page and what
// `carom shoot --animate` writes both show it.
import { drawBall } from "./ball.js";
import { drawBalls, drawTrails } from "./film.js";
import { clothFor, fitTable, viewOf } from "./table.js";
import { told } from "./words.js";

/** @import { Film, Hooks, Point, Pose } from "./words.js" */
/** @typedef {ReturnType<typeof parts>} Parts */
/**
 * What a player shows, and when of it, s; `before` is when the last frame was drawn, ms, and `all`
 * has the events of all shots.
 * @typedef {{ film: Film | undefined, time: number, end: number, playing: boolean, before: number,
 *   listing: number,
 *   all: { time: number, text: string }[] }} Clock */

/**
 * @template {keyof HTMLElementTagNameMap} K @param {K} tag @param {Record<string, string>}
 * attributes @param {(Node | string | undefined)[]} children
 */
export function make(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.append(...children.filter((child) => child !== undefined));
  return made;
}

/** The elements of a player. */
function parts() {
  const canvas = make("canvas", {
    class: "scene",
    id: "table-scene",
    role: "img",
    tabindex: "0",
    "aria-label": told("A billiard table from above"),
  });
  const play = make("button", { type: "button", id: "play" }, told("Play"));
  const back = make(
    "button",
    { type: "button", id: "back", "aria-label": told("Previous event") },
    "◀",
  );
  const forward = make(
    "button",
    { type: "button", id: "forward", "aria-label": told("Next event") },
    "▶",
  );
  const paces = /** @type {const} */ ([
    ["1", "1 ×"],
    ["0.25", "1/4 ×"],
    ["0.1", "1/10 ×"],
    ["4", "4 ×"],
    ["1000", told("at once")],
  ]);
  const pace = make(
    "select",
    { id: "rate", "aria-label": told("Speed of the film") },
    ...paces.map(([value, text]) => make("option", { value }, text)),
  );
  const slider = make("input", {
    type: "range",
    id: "time",
    min: "0",
    step: "0.001",
    "aria-label": told("Time of the film"),
  });
  const said = make("output", { id: "time-value", for: "time" });
  const controls = make("div", { class: "row film" }, play, back, forward, pace, slider, said);
  const list = make("ol", {});
  const events = make(
    "div",
    { class: "events", tabindex: "0", role: "region", "aria-label": told("Events") },
    list,
  );
  return { canvas, play, back, forward, pace, slider, said, controls, list, events };
}

/** Tells the time, and marks the event that was last. @param {Parts} of @param {Clock} clock */
function tellTime({ slider, said, list, events }, { time, all }) {
  slider.value = String(time);
  said.textContent = `${time.toFixed(2)} s`;
  slider.setAttribute("aria-valuetext", said.textContent);
  const current = list.children[all.findLastIndex((event) => event.time <= time + 1e-9)];
  const old = list.querySelector('[aria-current="true"]');
  if (old === current) return;
  old?.removeAttribute("aria-current");
  current?.setAttribute("aria-current", "true");
  if (current instanceof HTMLElement) events.scrollTop = current.offsetTop - events.offsetTop - 60;
}

/**
 * Lists the events; one that is pressed goes to its time. @param {Parts} of @param {Clock} clock
 * @param {(to: number) => void} go
 */
function listEvents(of, clock, go) {
  of.list.replaceChildren(
    ...clock.all.map((event) => {
      const row = make(
        "button",
        { type: "button" },
        make("span", {}, `${event.time.toFixed(3)} s`),
        make("span", {}, event.text),
      );
      row.addEventListener("click", () => go(event.time));
      return make("li", {}, row);
    }),
  );
  tellTime(of, clock);
}

/**
 * What draws the film at the time of its clock. @param {Parts} of @param {Clock} clock @param
 * {ReturnType<typeof viewOf>} view @param {Hooks} hooks
 */
function drawing({ canvas }, clock, view, { over, hidden, sharp = 1 }) {
  const clothOf = clothFor(view, canvas);
  return () => {
    if (!clock.film || hidden?.()) return;
    const [width, height, dpr] = fitTable(view, canvas, clock.film.table, sharp);
    const cloth = clothOf(clock.film.table, [width, height, dpr]);
    const g = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d", { alpha: false }));
    g.setTransform(dpr, 0, 0, dpr, 0, 0);
    g.drawImage(cloth, 0, 0, width, height);
    drawTrails(g, view, clock.film);
    drawBalls(g, view, clock.film, clock.time);
    over?.(g);
  };
}

/**
 * The hands of the clock: to a time, on with each frame, and stopped. @param {Parts} of @param
 * {Clock} clock @param {Hooks} hooks @param {() => void} draw
 */
function winding(of, clock, { ended, moved, still = () => false }, draw) {
  /** @param {number} to */
  function put(to) {
    clock.time = to;
    tellTime(of, clock);
    draw();
    moved?.();
  }
  /** @param {number} now */
  function frame(now) {
    if (!clock.playing) return;
    // the first frame may have begun before the start
    const step = Math.max(Math.min((now - clock.before) / 1000, 0.1), 0) * Number(of.pace.value);
    clock.before = now;
    put(Math.min(clock.time + step, clock.end));
    if (clock.time < clock.end) return void requestAnimationFrame(frame);
    stop();
    ended?.();
  }
  function start() {
    if (!clock.film) return;
    if (clock.time >= clock.end) clock.time = 0;
    clock.playing = true;
    of.play.textContent = told("Pause");
    clock.before = performance.now();
    requestAnimationFrame(frame);
  }
  function stop() {
    clock.playing = false;
    of.play.textContent = told("Play");
  }
  /** @param {number} to */
  function go(to) {
    if (still()) return tellTime(of, clock);
    stop();
    put(to);
  }
  /** To the next event, or the one before. @param {1 | -1} by */
  function step(by) {
    const next =
      by > 0
        ? clock.all.find((event) => event.time > clock.time + 1e-9)
        : clock.all.findLast((event) => event.time < clock.time - 1e-9);
    if (next) go(next.time);
  }
  of.play.addEventListener("click", () => {
    if (!clock.playing) start();
    else if (!still()) stop();
  });
  of.back.addEventListener("click", () => step(-1));
  of.forward.addEventListener("click", () => step(1));
  of.slider.addEventListener("input", () => go(of.slider.valueAsNumber));
  return { start, stop, go, step };
}

/**
 * @param {Hooks} hooks `hidden` tells that nothing is seen of the table, `still` that the clock is
 * not the reader's now;
 * `sharp` is how many pixels of the picture there are at least for one of the page. */
export function player(hooks = {}) {
  const of = parts();
  const view = viewOf();
  /** @type {Clock} */
  const clock = {
    film: undefined,
    time: 0,
    end: 0,
    playing: false,
    before: 0,
    listing: 0,
    all: [],
  };
  const draw = drawing(of, clock, view, hooks);
  const hands = winding(of, clock, hooks, draw);

  /** Shows the start of a film. @param {Film} next */
  function show(next) {
    hands.stop();
    const end = Math.max(0, ...next.shots.map((shot) => shot.time));
    Object.assign(clock, {
      film: next,
      time: 0,
      end,
      all: next.shots.flatMap((shot) => shot.events).sort((a, b) => a.time - b.time),
    });
    of.slider.max = String(Math.max(end, 0.001));
    // The list waits until nothing has changed for a moment: it costs more than a shot.
    window.clearTimeout(clock.listing);
    of.list.replaceChildren();
    clock.listing = window.setTimeout(() => listEvents(of, clock, hands.go), 100);
    tellTime(of, clock);
    draw();
  }
  /**
   * Shows the table so many times larger, with a point of it in the middle, m. 1: all of it. @param
   * {number} times @param {Point} [at]
   */
  function look(times, at) {
    view.zoom = Math.min(Math.max(times, 1), 6);
    if (at) view.middle = at;
    draw();
  }

  return {
    canvas: of.canvas,
    controls: of.controls,
    events: of.events,
    play: of.play,
    pace: of.pace,
    show,
    draw,
    look,
    ...hands,
    /** @param {number} x @param {number} y */
    place: (x, y) => view.place(x, y),
    /** @param {number} px @param {number} py */
    unplace: (px, py) => view.unplace(px, py),
    /**
     * Draws ball k of the film. @param {CanvasRenderingContext2D} g @param {number} k @param {Pose}
     * pose @param {number} alpha
     */
    drawBall: (g, k, pose, alpha) =>
      drawBall(g, view, /** @type {Film} */ (clock.film).balls[k], k, pose, alpha),
    get time() {
      return clock.time;
    },
    get scale() {
      return view.scale;
    },
    get zoom() {
      return view.zoom;
    },
    get playing() {
      return clock.playing;
    },
  };
}
