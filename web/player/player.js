// The film player: a table seen from above, and a clock that plays shots. The page and the output
// of `carom shoot --animate` both contain it.
import { drawBall } from "./ball.js";
import { drawBalls, drawTrails } from "./film.js";
import { clothFor, fitTable, viewOf } from "./table.js";
import { translate } from "./words.js";

/** @import { Film, Hooks, Point, Pose } from "./words.js" */
/** @typedef {ReturnType<typeof parts>} Parts */
/**
 * What a player shows, and when of it, s; `frameTime` is when the last frame was drawn, ms, and
 * `allEvents` has the events of all shots.
 * @typedef {{ film: Film | undefined, time: number, end: number, playing: boolean, frameTime: number,
 *   listing: number,
 *   allEvents: { time: number, text: string }[] }} Clock */

/**
 * The element of a selector such as "p#said.note". @template {string} S
 * @typedef {S extends `${infer T}#${string}` ? T : S extends `${infer T}.${string}` ? T : S} TagOf */

/**
 * An element by its name, id and classes, as a selector has them; then its attributes and its
 * children. @template {string} S @param {S} selector
 * @param {(Record<string, string> | Node | string | undefined)[]} parts
 * @returns {HTMLElementTagNameMap[TagOf<S> & keyof HTMLElementTagNameMap]}
 */
export function make(selector, ...parts) {
  const [name, ...classes] = selector.split(".");
  const [tag, id] = name.split("#");
  const element = document.createElement(
    /** @type {TagOf<S> & keyof HTMLElementTagNameMap} */ (tag),
  );
  if (id) element.id = id;
  if (classes.length > 0) element.className = classes.join(" ");
  for (const part of parts)
    if (typeof part === "string" || part instanceof Node) element.append(part);
    else for (const [key, value] of Object.entries(part ?? {})) element.setAttribute(key, value);
  return element;
}

/** The elements of a player. */
function parts() {
  const canvas = make("canvas#table-scene.scene", {
    role: "img",
    tabindex: "0",
    "aria-label": translate("A billiard table from above"),
  });
  const play = make("button#play", { type: "button" }, translate("Play"));
  const back = make(
    "button#back",
    { type: "button", "aria-label": translate("Previous event") },
    "◀",
  );
  const forward = make(
    "button#forward",
    { type: "button", "aria-label": translate("Next event") },
    "▶",
  );
  const paces = /** @type {const} */ ([
    ["1", "1 ×"],
    ["0.25", "1/4 ×"],
    ["0.1", "1/10 ×"],
    ["4", "4 ×"],
    ["1000", translate("at once")],
  ]);
  const pace = make(
    "select#rate",
    { "aria-label": translate("Playback speed") },
    ...paces.map(([value, text]) => make("option", { value }, text)),
  );
  const slider = make("input#time", {
    type: "range",
    min: "0",
    step: "0.001",
    "aria-label": translate("Playback time"),
  });
  const output = make("output#time-value", { for: "time" });
  const controls = make("div.row.film", play, back, forward, pace, slider, output);
  const list = make("ol");
  const events = make(
    "div.events",
    { tabindex: "0", role: "region", "aria-label": translate("Events") },
    list,
  );
  return { canvas, play, back, forward, pace, slider, output, controls, list, events };
}

/** Shows the time, and marks the last event. @param {Parts} of @param {Clock} clock */
function tellTime({ slider, output, list, events }, { time, allEvents }) {
  slider.value = String(time);
  output.textContent = `${time.toFixed(2)} s`;
  slider.setAttribute("aria-valuetext", output.textContent);
  const current = list.children[allEvents.findLastIndex((event) => event.time <= time + 1e-9)];
  const old = list.querySelector('[aria-current="true"]');
  if (old === current) return;
  old?.removeAttribute("aria-current");
  current?.setAttribute("aria-current", "true");
  if (current instanceof HTMLElement) events.scrollTop = current.offsetTop - events.offsetTop - 60;
}

/**
 * Lists the events; one that is pressed goes to its time. @param {Parts} widgets @param {Clock} clock
 * @param {(to: number) => void} go
 */
function listEvents(widgets, clock, go) {
  widgets.list.replaceChildren(
    ...clock.allEvents.map((event) => {
      const row = make(
        "button",
        { type: "button" },
        make("span", `${event.time.toFixed(3)} s`),
        make("span", event.text),
      );
      row.addEventListener("click", () => go(event.time));
      return make("li", row);
    }),
  );
  tellTime(widgets, clock);
}

/**
 * What draws the film at the time of its clock. @param {Parts} widgets @param {Clock} clock @param
 * {ReturnType<typeof viewOf>} view @param {Hooks} hooks
 */
function drawing({ canvas }, clock, view, { over, hidden, backdrop, sharp = 1 }) {
  const clothOf = clothFor(view, canvas);
  return () => {
    if (!clock.film || hidden?.()) return;
    const [width, height, dpr] = fitTable(view, canvas, clock.film.table, sharp);
    const g = /** @type {CanvasRenderingContext2D} */ (
      canvas.getContext("2d", { alpha: backdrop !== undefined })
    );
    g.setTransform(dpr, 0, 0, dpr, 0, 0);
    const isSeenThrough = backdrop?.(view) ?? false;
    if (isSeenThrough) g.clearRect(0, 0, width, height);
    else {
      g.drawImage(clothOf(clock.film.table, [width, height, dpr]), 0, 0, width, height);
      drawTrails(g, view, clock.film);
      drawBalls(g, view, clock.film, clock.time);
    }
    over?.(g);
  };
}

/**
 * The hands of the clock: to a time, on with each frame, and stopped. @param {Parts} widgets @param
 * {Clock} clock @param {Hooks} hooks @param {() => void} draw
 */
function winding(widgets, clock, { ended, moved, still = () => false }, draw) {
  /** @param {number} time */
  function put(time) {
    clock.time = time;
    tellTime(widgets, clock);
    draw();
    moved?.();
  }
  /** @param {number} time */
  function frame(time) {
    if (!clock.playing) return;
    // the first frame may have begun before the start
    const step =
      Math.max(Math.min((time - clock.frameTime) / 1000, 0.1), 0) * Number(widgets.pace.value);
    clock.frameTime = time;
    put(Math.min(clock.time + step, clock.end));
    if (clock.time < clock.end) return void requestAnimationFrame(frame);
    stop();
    ended?.();
  }
  function start() {
    if (!clock.film) return;
    if (clock.time >= clock.end) clock.time = 0;
    clock.playing = true;
    widgets.play.textContent = translate("Pause");
    clock.frameTime = performance.now();
    requestAnimationFrame(frame);
  }
  function stop() {
    clock.playing = false;
    widgets.play.textContent = translate("Play");
  }
  /** @param {number} time */
  function go(time) {
    if (still()) return tellTime(widgets, clock);
    stop();
    put(time);
  }
  /** To the next event, or the one before. @param {1 | -1} direction */
  function step(direction) {
    const next =
      direction > 0
        ? clock.allEvents.find((event) => event.time > clock.time + 1e-9)
        : clock.allEvents.findLast((event) => event.time < clock.time - 1e-9);
    if (next) go(next.time);
  }
  widgets.play.addEventListener("click", () => {
    if (!clock.playing) start();
    else if (!still()) stop();
  });
  widgets.back.addEventListener("click", () => step(-1));
  widgets.forward.addEventListener("click", () => step(1));
  widgets.slider.addEventListener("input", () => go(widgets.slider.valueAsNumber));
  return { start, stop, go, step };
}

/**
 * @param {Hooks} hooks `hidden` tells that nothing is seen of the table, `still` that the clock is
 * not the reader's now; `backdrop` may draw table and balls below the canvas, and tells whether it
 * has;
 * `sharp` is how many pixels of the picture there are at least for one of the page. */
export function player(hooks = {}) {
  const widgets = parts();
  const view = viewOf();
  /** @type {Clock} */
  const clock = {
    film: undefined,
    time: 0,
    end: 0,
    playing: false,
    frameTime: 0,
    listing: 0,
    allEvents: [],
  };
  const draw = drawing(widgets, clock, view, hooks);
  const hands = winding(widgets, clock, hooks, draw);

  /** Shows the start of a film. @param {Film} next */
  function show(next) {
    hands.stop();
    const end = Math.max(0, ...next.shots.map((shot) => shot.time));
    Object.assign(clock, {
      film: next,
      time: 0,
      end,
      allEvents: next.shots.flatMap((shot) => shot.events).sort((a, b) => a.time - b.time),
    });
    widgets.slider.max = String(Math.max(end, 0.001));
    // The list waits until nothing has changed for a moment: it costs more than a shot.
    window.clearTimeout(clock.listing);
    widgets.list.replaceChildren();
    clock.listing = window.setTimeout(() => listEvents(widgets, clock, hands.go), 100);
    tellTime(widgets, clock);
    draw();
  }
  /**
   * Shows the table so many times larger, with a point of it in the middle, m. 1: all of it. @param
   * {number} times @param {Point} [place]
   */
  function look(times, place) {
    view.zoom = Math.min(Math.max(times, 1), 6);
    if (place) view.middle = place;
    draw();
  }

  return {
    canvas: widgets.canvas,
    controls: widgets.controls,
    events: widgets.events,
    play: widgets.play,
    pace: widgets.pace,
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
