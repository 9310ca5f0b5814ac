// The table without balls, and where it lies on its canvas.
import { PALETTE } from "./palette.js";

/** @import { Point, Table } from "./words.js" */
/** @typedef {ReturnType<typeof viewOf>} View */

/** How wide a cushion is from its nose to the wood, and how far the wood reaches, m. */
export const CUSHION = 0.05;
export const WOOD = CUSHION + 0.127;
/** Rails longer than this are cushions, the others facings of pockets, m. */
export const FACING = 0.3;

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
    /** Its height for its width, as its canvas has it. */
    ratio: 0,
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
  // It is set where it changes: a page that is laid out anew in each frame of a film is slow.
  if (view.ratio !== ratio) {
    view.ratio = ratio;
    // A browser that does not know dvh keeps vh.
    for (const unit of ["vh", "dvh"])
      canvas.style.maxWidth = `calc((100${unit} - var(--beside, 9rem)) * ${1 / ratio})`;
  }
  const [width, height, dpr] = fit(canvas, ratio, sharp);
  view.scale = width / (upright ? w : l);
  view.offset = [WOOD * view.scale, upright ? height - WOOD * view.scale : WOOD * view.scale];
  const { zoom, middle } = view;
  if (zoom > 1 && middle) {
    // No further than the wood.
    const centre = view.place(...middle);
    view.scale *= zoom;
    view.offset = /** @type {[number, number]} */ (
      [width, height].map(
        (size, k) =>
          size / 2 -
          Math.min(Math.max(zoom * centre[k], size / 2), (zoom - 0.5) * size) +
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
 * The outline of a rectangle around the noses, farther out by `more`, m.
 * @param {CanvasRenderingContext2D} g @param {View} view @param {Table} table @param {number} more
 */
function rectangle(g, view, { width, length }, more) {
  const [x0, y0] = view.place(-more, -more);
  const [x1, y1] = view.place(width + more, length + more);
  g.rect(Math.min(x0, x1), Math.min(y0, y1), Math.abs(x1 - x0), Math.abs(y1 - y0));
}

/**
 * The arc of a jaw between the ends of the rails that it joins; none where it joins none.
 * @param {Table} table @param {Table["jaws"][number]} jaw @returns {Point[]}
 */
export function arcOf(table, { centre, radius }) {
  const ends = table.rails
    .flatMap(({ p, q }) => [p, q])
    .filter(([x, y]) => Math.abs(Math.hypot(x - centre[0], y - centre[1]) - radius) < 1e-3);
  if (ends.length !== 2) return [];
  const [start, end] = ends.map(([x, y]) => Math.atan2(y - centre[1], x - centre[0]));
  const turned = Math.atan2(Math.sin(end - start), Math.cos(end - start));
  return Array.from({ length: 9 }, (_, k) => [
    centre[0] + radius * Math.cos(start + (turned * k) / 8),
    centre[1] + radius * Math.sin(start + (turned * k) / 8),
  ]);
}

/**
 * The mouths of the pockets, as cloth between their facings, their liners, and their holes.
 * @param {CanvasRenderingContext2D} g @param {View} view @param {Table} table @param {string} bed
 */
function drawPockets(g, view, table, bed) {
  const facings = table.rails
    .filter(({ p, q }) => Math.hypot(q[0] - p[0], q[1] - p[1]) < FACING)
    .flatMap(({ p, q }) => [p, q])
    .concat(...table.jaws.map((jaw) => arcOf(table, jaw)));
  for (const { centre, radius } of table.pockets) {
    const mouth = facings.filter(([x, y]) => Math.hypot(x - centre[0], y - centre[1]) < 3 * radius);
    const middle = [0, 1].map(
      (c) => mouth.reduce((sum, point) => sum + point[c], 0) / mouth.length,
    );
    const angle = (/** @type {Point} */ [x, y]) => Math.atan2(y - middle[1], x - middle[0]);
    g.beginPath();
    for (const point of mouth.sort((a, b) => angle(a) - angle(b)))
      g.lineTo(...view.place(point[0], point[1]));
    g.fillStyle = bed;
    g.fill();
    g.fillStyle = "#241811"; // the leather around the hole
    disc(g, view, centre, (radius + 0.011) * view.scale);
    const [x, y] = view.place(centre[0], centre[1]);
    const hole = g.createRadialGradient(x, y, 0, x, y, radius * view.scale);
    hole.addColorStop(0, "#000");
    hole.addColorStop(0.75, "#060808");
    hole.addColorStop(1, "#14100d");
    g.fillStyle = hole;
    disc(g, view, centre, radius * view.scale);
  }
}

/**
 * The light of a lamp above the middle, and the shadow of the cushions on the cloth.
 * @param {CanvasRenderingContext2D} g @param {View} view @param {Table} table
 */
function drawLight(g, view, table) {
  const [x, y] = view.place(table.width / 2, table.length / 2);
  const far = 0.62 * table.length * view.scale;
  const lamp = g.createRadialGradient(x, y, 0.1 * far, x, y, far);
  lamp.addColorStop(0, "#00000000"); // paths need the cloth as dark as PALETTE has it
  lamp.addColorStop(0.6, "#00000010");
  lamp.addColorStop(1, "#00000058");
  g.fillStyle = lamp;
  g.beginPath();
  rectangle(g, view, table, CUSHION);
  g.fill();
  for (const [wide, shade] of /** @type {const} */ ([
    [0.03, "#00000018"],
    [0.014, "#00000026"],
  ])) {
    g.strokeStyle = shade;
    g.lineWidth = wide * view.scale;
    for (const { p, q } of table.rails) line(g, view, [p, q]);
  }
}

/** How far the spots beside the head spot are from it, of the width of a table of carom. */
const BESIDE = 0.1825 / 1.42;
/** The length of the table of pyramid, m, which is hardly shorter than that of snooker. */
const PYRAMID_LENGTH = 3.55;
/**
 * Where lines and spots are drawn on the cloth, m. Snooker's are those of the WPBSA's rules: the
 * baulk line 29 in from the baulk cushion, a D of 11 1/2 in, the pyramid spot halfway from the
 * middle to the top cushion, the black one 12 3/4 in from it. Pool has a head and a foot spot,
 * pyramid also its middle and a head string, carom also its middle and two beside the head spot.
 * @param {Table} table
 * @returns {{ lines: Point[][], spots: Point[] }}
 */
export function markingsOf({ width, length, pockets }) {
  const middle = width / 2;
  const pointsOf = (/** @type {number[]} */ ...heights) =>
    heights.map((y) => /** @type {Point} */ ([middle, y]));
  if (pockets.length === 0) {
    const head = length / 4;
    /** @type {Point[]} */
    const beside = [
      [middle - BESIDE * width, head],
      [middle + BESIDE * width, head],
    ];
    return { lines: [], spots: [...beside, ...pointsOf(head, length / 2, 3 * head)] };
  }
  if (length < 3) return { lines: [], spots: pointsOf(length / 4, (3 * length) / 4) };
  if (length === PYRAMID_LENGTH) {
    const head = length / 4;
    const string = /** @type {Point[]} */ ([
      [0, head],
      [width, head],
    ]);
    return { lines: [string], spots: pointsOf(head, length / 2, 3 * head) };
  }
  const baulk = 0.7366;
  const radius = 0.2921;
  const d = Array.from({ length: 49 }, (_, k) => {
    const turn = Math.PI * (1 + k / 48);
    return /** @type {Point} */ ([
      middle + radius * Math.cos(turn),
      baulk + radius * Math.sin(turn),
    ]);
  });
  /** @type {Point[]} */
  const line = [
    [0, baulk],
    [width, baulk],
  ];
  /** @type {Point[]} */
  const corners = [
    [middle - radius, baulk],
    [middle + radius, baulk],
  ];
  const spots = pointsOf(baulk, length / 2, (3 * length) / 4, length - 0.32385);
  return { lines: [line, d], spots: [...corners, ...spots] };
}

/**
 * Draws cloth, cushions, pockets, noses, lines, spots and diamonds on the wood.
 * @param {CanvasRenderingContext2D} g @param {View} view @param {Table} table @param {string} bed
 */
function drawCloth(g, view, table, bed) {
  g.fillStyle = "#0005"; // the edge of the wood
  g.beginPath();
  rectangle(g, view, table, CUSHION + 0.004);
  g.fill();
  g.fillStyle = bed;
  g.beginPath();
  rectangle(g, view, table, CUSHION);
  g.fill();
  // Cushions have the cloth of the bed, and less light.
  g.fillStyle = "#00000030";
  g.beginPath();
  rectangle(g, view, table, CUSHION);
  rectangle(g, view, table, 0);
  g.fill("evenodd");
  g.lineCap = "round";
  drawPockets(g, view, table, bed);
  drawLight(g, view, table);
  g.strokeStyle = PALETTE.part.nose;
  g.lineWidth = Math.max(2, 0.006 * view.scale);
  for (const { p, q } of table.rails) line(g, view, [p, q]);
  for (const jaw of table.jaws) line(g, view, arcOf(table, jaw));
  const { lines, spots } = markingsOf(table);
  g.strokeStyle = "#ffffff66";
  g.lineWidth = Math.max(1, 0.003 * view.scale);
  for (const points of lines) line(g, view, points);
  g.fillStyle = "#ffffff88";
  for (const spot of spots) disc(g, view, spot, Math.max(1.2, 0.006 * view.scale));
  drawDiamonds(g, view, table);
}

/**
 * Diamonds: the long cushions in eight parts, the short ones in four. None where a pocket is, none
 * in snooker.
 * @param {CanvasRenderingContext2D} g @param {View} view @param {Table} table
 */
function drawDiamonds(g, view, table) {
  if (table.length > 3) return;
  g.fillStyle = PALETTE.part.mark;
  for (const side of [0, 1]) {
    const out = ((side === 0 ? -1 : 1) * (CUSHION + WOOD)) / 2;
    for (let k = 1; k < 8; k++)
      if (k !== 4 || table.pockets.length === 0)
        disc(g, view, [side * table.width + out, (table.length * k) / 8], 0.008 * view.scale);
    for (let k = 1; k < 4; k++)
      disc(g, view, [(table.width * k) / 4, side * table.length + out], 0.008 * view.scale);
  }
}

/**
 * Wood around the table: darker towards its outer edge, with a bright line where it is rounded.
 * @param {CanvasRenderingContext2D} g @param {number} width @param {number} height pixels @param
 * {string} wood @param {number} scale
 */
function drawWood(g, width, height, wood, scale) {
  g.fillStyle = wood;
  g.fillRect(0, 0, width, height);
  const wide = WOOD * scale;
  for (const [share, shade] of /** @type {const} */ ([
    [0.12, "#00000055"],
    [0.3, "#00000022"],
    [0.55, "#ffffff12"],
  ])) {
    g.strokeStyle = shade;
    g.lineWidth = share * wide;
    g.strokeRect(0, 0, width, height);
  }
}

/** The colours of cloth and wood by discipline: as they are drawn, and the dye below the lamp. */
const STYLES = {
  pool: { cloth: PALETTE.cloth.pool, dye: "#1391b6", wood: PALETTE.wood.pool },
  snooker: { cloth: PALETTE.cloth.snooker, dye: "#129c50", wood: PALETTE.wood.snooker },
  carom: { cloth: PALETTE.cloth.carom, dye: "#1472c8", wood: PALETTE.wood.carom },
};
/** The discipline that a table is of. @param {Table} table @returns {keyof typeof STYLES} */
export function disciplineOf({ length, pockets }) {
  if (pockets.length === 0) return "carom";
  return length > 3 ? "snooker" : "pool";
}
/** @param {Table} table */
export const coloursOf = (table) => STYLES[disciplineOf(table)];

/**
 * The picture of a table without balls, which is drawn once for each size. @param {View} view
 * @param {HTMLCanvasElement} canvas
 */
export function clothFor(view, canvas) {
  const cloth = document.createElement("canvas");
  let drawn = "";
  /** @param {Table} table @param {readonly [number, number, number]} size */
  return (table, [width, height, dpr]) => {
    const colours = coloursOf(table);
    const state = [
      width,
      height,
      dpr,
      colours.cloth,
      table.width,
      table.length,
      table.pockets.length,
      view.scale,
      ...view.offset,
    ].join();
    if (state === drawn) return cloth;
    drawn = state;
    [cloth.width, cloth.height] = [canvas.width, canvas.height];
    const g = /** @type {CanvasRenderingContext2D} */ (cloth.getContext("2d", { alpha: false }));
    g.setTransform(dpr, 0, 0, dpr, 0, 0);
    drawWood(g, width, height, colours.wood, view.scale);
    drawCloth(g, view, table, colours.cloth);
    return cloth;
  };
}
