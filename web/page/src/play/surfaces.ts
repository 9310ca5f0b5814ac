// Surfaces that are computed, not loaded: weave of cloth, grain of wood, boards, walls, and the
// finish of a cue. Each is drawn once into a canvas, from the same random numbers each time.
import * as THREE from "three";
import { coloursOf, disciplineOf } from "../../../player/table.js";
import type { Table } from "../../../player/words.js";

/** How a discipline looks: its cloth, its wood, and what its pockets have. */
export interface Style {
  cloth: string;
  wood: string;
  /** The colour of castings of metal; a pocket without them has leather around it. */
  metal?: string;
  leather: string;
}
const POCKETS = {
  pool: { metal: "#30333a", leather: "#0b0b0c" },
  snooker: { leather: "#2c170c" },
  carom: { leather: "#0b0b0c" },
} as const;
export function styleOf(table: Table): Style {
  const { dye, wood } = coloursOf(table);
  return { cloth: dye, wood, ...POCKETS[disciplineOf(table)] };
}

/** Random numbers by a fixed rule, 0 to 1. */
function random(seed: number): () => number {
  let state = seed >>> 0;
  return () => (state = (Math.imul(state, 1664525) + 1013904223) >>> 0) / 2 ** 32;
}
export function canvasOf(
  width: number,
  height: number,
): [HTMLCanvasElement, CanvasRenderingContext2D] {
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [width, height];
  return [canvas, canvas.getContext("2d")!];
}
function textureOf(canvas: HTMLCanvasElement, srgb = true): THREE.CanvasTexture {
  const map = new THREE.CanvasTexture(canvas);
  map.wrapS = THREE.RepeatWrapping;
  map.wrapT = THREE.RepeatWrapping;
  map.anisotropy = 4;
  if (srgb) map.colorSpace = THREE.SRGBColorSpace;
  return map;
}

/** Worsted cloth: threads over and under each other, some of them raised; grey, to be tinted. */
export function weave(size = 256): THREE.CanvasTexture {
  const [canvas, g] = canvasOf(size, size);
  const pixels = g.createImageData(size, size);
  const next = random(7);
  const coarse = Array.from({ length: 32 * 32 }, next);
  for (let y = 0; y < size; y++)
    for (let x = 0; x < size; x++) {
      const twill = ((x + 2 * y) & 7) < 4 ? 1 : 0;
      // Clouds of some millimetres, which tile.
      const u = (32 * x) / size;
      const v = (32 * y) / size;
      const i = Math.floor(u);
      const j = Math.floor(v);
      const cloudAt = (a: number, b: number): number => coarse[(b % 32) * 32 + (a % 32)]!;
      const s = u - i;
      const t = v - j;
      const cloud =
        (cloudAt(i, j) * (1 - s) + cloudAt(i + 1, j) * s) * (1 - t) +
        (cloudAt(i, j + 1) * (1 - s) + cloudAt(i + 1, j + 1) * s) * t;
      const grey = 218 + 9 * twill + 9 * (cloud - 0.5) + 24 * (next() - 0.5);
      pixels.data.set([grey, grey, grey, 255], 4 * (size * y + x));
    }
  g.putImageData(pixels, 0, 0);
  return textureOf(canvas);
}

/** Wood whose grain runs along x: bands, fibres and pores; grey-brown, to be tinted. */
export function grain(width = 1024, height = 256, seed = 3): THREE.CanvasTexture {
  const [canvas, g] = canvasOf(width, height);
  const next = random(seed);
  g.fillStyle = "#c9b8a6";
  g.fillRect(0, 0, width, height);
  const wave = (y0: number, lift: number, colour: string, wide: number, turn: number): void => {
    g.strokeStyle = colour;
    g.lineWidth = wide;
    for (const shift of [-height, 0, height]) {
      g.beginPath();
      for (let x = 0; x <= width; x += 16) {
        const w = (2 * Math.PI * x) / width;
        const y =
          y0 + shift + lift * Math.sin(w + turn) + 0.4 * lift * Math.sin(3 * w + 2.3 * turn);
        if (x === 0) g.moveTo(x, y);
        else g.lineTo(x, y);
      }
      g.stroke();
    }
  };
  for (let k = 0; k < 26; k++) {
    const dark = next() < 0.6;
    wave(
      next() * height,
      10 + 14 * next(),
      dark ? "rgba(60,30,14,.16)" : "rgba(255,236,205,.13)",
      3 + 12 * next(),
      6 * next(),
    );
  }
  for (let k = 0; k < 240; k++)
    wave(
      next() * height,
      10 + 8 * next(),
      `rgba(48,24,10,${0.05 + 0.1 * next()})`,
      0.6 + 0.9 * next(),
      6 * next(),
    );
  g.fillStyle = "rgba(28,12,4,.32)";
  for (let k = 0; k < 1500; k++) g.fillRect(next() * width, next() * height, 5 + 22 * next(), 0.9);
  return textureOf(canvas);
}

/** Boards of a floor. */
export function boards(): THREE.CanvasTexture {
  const [canvas, g] = canvasOf(512, 512);
  const next = random(11);
  for (let row = 0; row < 8; row++)
    for (let x = -512 * next(); x < 512; x += 300) {
      const light = 20 + 12 * next();
      g.fillStyle = `rgb(${light * 1.5},${light * 1.05},${light * 0.75})`;
      g.fillRect(x, row * 64, 300, 64);
      g.strokeStyle = "rgba(0,0,0,.16)";
      for (let k = 0; k < 14; k++) {
        const y = row * 64 + 64 * next();
        g.beginPath();
        g.moveTo(x, y);
        g.bezierCurveTo(
          x + 100,
          y + 8 * (next() - 0.5),
          x + 200,
          y + 8 * (next() - 0.5),
          x + 300,
          y,
        );
        g.stroke();
      }
      g.fillStyle = "rgba(0,0,0,.65)";
      g.fillRect(x, row * 64, 300, 1.5);
      g.fillRect(x, row * 64, 1.5, 64);
    }
  return textureOf(canvas);
}

/** Where lamps are on the panels of a wall: at eye level behind a cue. */
const LAMPS = 182;
/** A wall behind the dark: panels, and lamps that wash it. */
export function wall(): THREE.CanvasTexture {
  const [canvas, g] = canvasOf(2048, 256);
  const up = g.createLinearGradient(0, 256, 0, 0);
  up.addColorStop(0, "#0f0a07");
  up.addColorStop(0.23, "#170f0a");
  up.addColorStop(0.24, "#0d0a08");
  up.addColorStop(1, "#060505");
  g.fillStyle = up;
  g.fillRect(0, 0, 2048, 256);
  g.globalCompositeOperation = "lighter";
  // One is straight ahead of a player at either end.
  for (let x = 0; x <= 2048; x += 256) {
    const glow = g.createRadialGradient(x, LAMPS, 0, x, LAMPS, 104);
    glow.addColorStop(0, "rgba(255,205,140,.6)");
    glow.addColorStop(0.08, "rgba(240,160,90,.32)");
    glow.addColorStop(0.4, "rgba(160,88,40,.13)");
    glow.addColorStop(1, "rgba(0,0,0,0)");
    g.fillStyle = glow;
    g.fillRect(x - 128, 0, 256, 256);
    // The lamp itself: its shade, and the foot.
    g.fillStyle = "#ffd896";
    g.beginPath();
    for (const [u, v] of [
      [-4, -8],
      [4, -8],
      [8, 5],
      [-8, 5],
    ] as const)
      g.lineTo(x + u, LAMPS + v);
    g.fill();
    g.fillStyle = "#6b4a2c";
    g.fillRect(x - 1, LAMPS + 5, 2, 12);
  }
  return textureOf(canvas);
}

/** A soft round shadow, dark in its middle. */
export function shadowPicture(): THREE.CanvasTexture {
  const [canvas, g] = canvasOf(64, 64);
  const fall = g.createRadialGradient(32, 32, 0, 32, 32, 32);
  fall.addColorStop(0, "rgba(0,0,0,.95)");
  fall.addColorStop(0.35, "rgba(0,0,0,.78)");
  fall.addColorStop(0.65, "rgba(0,0,0,.34)");
  fall.addColorStop(1, "rgba(0,0,0,0)");
  g.fillStyle = fall;
  g.fillRect(0, 0, 64, 64);
  return new THREE.CanvasTexture(canvas);
}

/** How long a cue is, m. */
export const CUE_LENGTH = 1.46;
/** A cue unrolled: u around it, v from the butt to the tip. */
export function cueSkin(): THREE.CanvasTexture {
  const [canvas, g] = canvasOf(128, 1024);
  const next = random(5);
  // From the tip, which is at the top: fraction of the length, colour.
  const rowOf = (m: number): number => (1024 * m) / CUE_LENGTH;
  const band = (start: number, end: number, colour: string): void => {
    g.fillStyle = colour;
    g.fillRect(0, rowOf(start), 128, rowOf(end) - rowOf(start) + 1);
  };
  band(0, 0.74, "#e3bd86");
  g.globalAlpha = 0.14;
  for (let k = 0; k < 130; k++) {
    g.fillStyle = next() < 0.6 ? "#8a5a2a" : "#fff0cf";
    g.fillRect(128 * next(), rowOf(0.03 + 0.3 * next()), 0.8 + next(), rowOf(0.2 + 0.6 * next()));
  }
  g.globalAlpha = 1;
  band(0.74, 1.46, "#1c1210");
  // Four points of light wood, with a veneer, into the dark one.
  for (let k = 0; k < 4; k++)
    for (const [wide, colour, long] of [
      [15, "#b5342a", 1.085],
      [12, "#f0d7a4", 1.08],
      [8, "#e3bd86", 1.075],
    ] as const) {
      g.fillStyle = colour;
      g.beginPath();
      g.moveTo(32 * k + 16 - wide, rowOf(0.76));
      g.lineTo(32 * k + 16 + wide, rowOf(0.76));
      g.lineTo(32 * k + 16, rowOf(long - 0.02 * (15 - wide)));
      g.fill();
    }
  band(0.738, 0.752, "#d8c07a");
  band(0.752, 0.757, "#111");
  // A wrap of linen.
  band(1.1, 1.32, "#23262c");
  for (let k = 0; k < 900; k++) {
    g.fillStyle = `rgba(230,230,225,${0.2 + 0.4 * next()})`;
    g.fillRect(128 * next(), rowOf(1.1 + 0.22 * next()), 5 * next() + 2, 1);
  }
  band(1.095, 1.1, "#d8c07a");
  band(1.32, 1.325, "#d8c07a");
  band(1.41, 1.416, "#d8c07a");
  band(1.43, 1.46, "#08080a");
  band(0, 0.005, "#3f7fc4");
  band(0.005, 0.007, "#20303c");
  band(0.007, 0.026, "#f4efe2");
  return textureOf(canvas);
}
