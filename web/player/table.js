// The table without balls, and where it lies on its canvas.

/** @import { Point, Table } from "./words.js" */
/** @typedef {ReturnType<typeof viewOf>} View */

/** Wood around the noses of the cushions, m. */
export const WOOD = 0.1;

/**
 * Where a table lies on a canvas: pixels for each m, where its corner is, and whether it stands. A
 * table that lies has its length along the canvas'
 * width. The table may be larger than its place on the page by `zoom`; then `middle` of it is in
 * the middle, m; undefined: its own middle.
 */
export function viewOf() {
  return {
    scale: 1,
    upright: false,
    /** @type {[number, number]} */
    offset: [0, 0],
    zoom: 1,
    /** @type {Point | undefined} */
    middle: undefined,
    /**
     * From the table, m, to the canvas. @param {number} x @param {number} y @returns {[number,
     * number]}
     */
    place(x, y) {
      const { scale, offset } = this;
      return this.upright
        ? [offset[0] + x * scale, offset[1] - y * scale]
        : [offset[0] + y * scale, offset[1] + x * scale];
    },
    /**
     * From the canvas to the table. @param {number} px @param {number} py @returns {[number,
     * number]}
     */
    unplace(px, py) {
      const { scale, offset } = this;
      return this.upright
        ? [(px - offset[0]) / scale, (offset[1] - py) / scale]
        : [(py - offset[1]) / scale, (px - offset[0]) / scale];
    },
  };
}

/**
 * Makes a canvas as wide as its place is, and so much higher; returns its width and height, and
 * pixels of the picture for one of the page.
 * @param {HTMLCanvasElement} canvas @param {number} ratio @param {number} [sharp] @returns
 *   {[number, number, number]}
 */
export function fit(canvas, ratio, sharp = 1) {
  const width = Math.max(canvas.clientWidth, 50);
  const height = Math.round(width * ratio);
  const dpr = Math.max(window.devicePixelRatio || 1, sharp);
  if (canvas.width !== Math.round(width * dpr) || canvas.height !== Math.round(height * dpr)) {
    canvas.style.height = `${height}px`;
    [canvas.width, canvas.height] = [Math.round(width * dpr), Math.round(height * dpr)];
  }
  return [width, height, dpr];
}

/**
 * Fits a canvas with a table, no larger than the window is high. @param {View} view @param
 * {HTMLCanvasElement} canvas @param {Table} table
 * @param {number} sharp */
export function fitTable(view, canvas, table, sharp) {
  const w = table.width + 2 * WOOD;
  const l = table.length + 2 * WOOD;
  const upright = document.documentElement.clientWidth < 480;
  view.upright = upright;
  const ratio = upright ? l / w : w / l;
  // A browser that does not know dvh keeps vh.
  for (const unit of ["vh", "dvh"])
    canvas.style.maxWidth = `calc((100${unit} - var(--beside, 9rem)) * ${1 / ratio})`;
  const [width, height, dpr] = fit(canvas, ratio, sharp);
  view.scale = width / (upright ? w : l);
  view.offset = [WOOD * view.scale, upright ? height - WOOD * view.scale : WOOD * view.scale];
  const { zoom, middle } = view;
  if (zoom > 1 && middle) {
    // No further than the wood.
    const at = view.place(...middle);
    view.scale *= zoom;
    view.offset = /** @type {[number, number]} */ (
      [width, height].map(
        (size, k) =>
          size / 2 -
          Math.min(Math.max(zoom * at[k], size / 2), (zoom - 0.5) * size) +
          zoom * view.offset[k],
      )
    );
  }
  return /** @type {const} */ ([width, height, dpr]);
}

/**
 * @param {CanvasRenderingContext2D} g @param {Pick<View, "place">} view @param {readonly (readonly
 * number[])[]} points
 */
export const line = (g, view, points) => {
  g.beginPath();
  points.forEach(([x, y], k) => g[k === 0 ? "moveTo" : "lineTo"](...view.place(x, y)));
  g.stroke();
};
/**
 * @param {CanvasRenderingContext2D} g @param {View} view @param {readonly number[]} centre @param
 * {number} radius in pixels
 */
export const disc = (g, view, [x, y], radius) => {
  g.beginPath();
  g.arc(...view.place(x, y), radius, 0, 7);
  g.fill();
};

/**
 * Draws cloth, wood, pockets, noses and diamonds. @param {CanvasRenderingContext2D} g @param {View}
 * view @param {Table} table @param {string} bed
 */
function drawCloth(g, view, table, bed) {
  g.fillStyle = bed;
  const [x0, y0] = view.place(0, 0);
  const [x1, y1] = view.place(table.width, table.length);
  g.fillRect(Math.min(x0, x1), Math.min(y0, y1), Math.abs(x1 - x0), Math.abs(y1 - y0));
  g.fillStyle = "#0c0f10";
  for (const pocket of table.pockets) disc(g, view, pocket.centre, pocket.radius * view.scale);
  g.strokeStyle = "#0f3b31";
  g.lineWidth = 3;
  g.lineCap = "round";
  for (const { p, q } of table.rails) line(g, view, [p, q]);
  // Of a jaw the part between the ends of the rails that it joins.
  for (const { centre, radius } of table.jaws) {
    const ends = table.rails
      .flatMap(({ p, q }) => [p, q])
      .filter(([x, y]) => Math.abs(Math.hypot(x - centre[0], y - centre[1]) - radius) < 1e-3);
    if (ends.length !== 2) continue;
    const [from, to] = ends.map(([x, y]) => Math.atan2(y - centre[1], x - centre[0]));
    const turned = Math.atan2(Math.sin(to - from), Math.cos(to - from));
    line(
      g,
      view,
      Array.from({ length: 9 }, (_, k) => [
        centre[0] + radius * Math.cos(from + (turned * k) / 8),
        centre[1] + radius * Math.sin(from + (turned * k) / 8),
      ]),
    );
  }
  // Diamonds: the long cushions in eight parts, the short ones in four. None where a pocket is,
  // none in snooker.
  if (table.length > 3) return;
  g.fillStyle = "#e8dcc0";
  for (const side of [0, 1]) {
    const out = side === 0 ? -0.8 * WOOD : 0.8 * WOOD;
    for (let k = 1; k < 8; k++)
      if (k !== 4 || table.pockets.length === 0)
        disc(g, view, [side * table.width + out, (table.length * k) / 8], 0.008 * view.scale);
    for (let k = 1; k < 4; k++)
      disc(g, view, [(table.width * k) / 4, side * table.length + out], 0.008 * view.scale);
  }
}

/**
 * The picture of a table without balls, which is drawn once for each size. @param {View} view
 * @param {HTMLCanvasElement} canvas
 */
export function clothFor(view, canvas) {
  const cloth = document.createElement("canvas");
  let drawn = "";
  /** @param {Table} table @param {readonly [number, number, number]} size */
  return (table, [width, height, dpr]) => {
    const [bed, wood] = ["--cloth", "--rail"].map((name) =>
      getComputedStyle(canvas).getPropertyValue(name).trim(),
    );
    const now = [
      width,
      height,
      dpr,
      bed,
      wood,
      table.width,
      table.length,
      table.pockets.length,
      view.scale,
      ...view.offset,
    ].join();
    if (now === drawn) return cloth;
    drawn = now;
    [cloth.width, cloth.height] = [canvas.width, canvas.height];
    const g = /** @type {CanvasRenderingContext2D} */ (cloth.getContext("2d", { alpha: false }));
    g.setTransform(dpr, 0, 0, dpr, 0, 0);
    g.fillStyle = wood || "#5b3a24";
    g.fillRect(0, 0, width, height);
    drawCloth(g, view, table, bed || "#1f6f5c");
    return cloth;
  };
}
