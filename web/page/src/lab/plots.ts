// Curves side by side, drawn by uPlot, with marks for the current values and a band.
import uPlot from "uplot";
import { color, el } from "../ui.js";

interface Mark {
  x: number;
  y: number;
}
export type Column = (number | null)[];
/**
 * What a plot shows: its words, the label and the range of x, the label of y, its curves, and a
 * band of |y|.
 */
interface Shows {
  id: string;
  title: string;
  note: string;
  x: readonly [string, number, number];
  y: string;
  series: readonly { label: string; color: string; dash?: number[]; points?: boolean }[];
  band?: readonly [number, number];
}

function drawBand(u: uPlot, [low, high]: readonly [number, number]): void {
  const height = (y: number): number => u.valToPos(y, "y", true);
  u.ctx.fillStyle = color("band");
  for (const top of [high, -low])
    u.ctx.fillRect(u.bbox.left, height(top), u.bbox.width, Math.abs(height(low) - height(high)));
}
function drawMarks(u: uPlot, marks: readonly Mark[]): void {
  for (const mark of marks) {
    u.ctx.fillStyle = color("warm");
    u.ctx.beginPath();
    u.ctx.arc(
      u.valToPos(mark.x, "x", true),
      u.valToPos(mark.y, "y", true),
      5 * devicePixelRatio,
      0,
      7,
    );
    u.ctx.fill();
  }
}

export function plot(
  into: HTMLElement,
  { id, title, note, x, y, series, band }: Shows,
): { set(data: Column[], marks: Mark[]): void; theme(): void } {
  const place = el("div");
  into.append(
    el("section.panel.plot", { id, "aria-label": title }, el("h2", title), place, el("p", note)),
  );
  const wide = (): number => Math.max(place.clientWidth, 240);
  let marks: Mark[] = [];
  let last: Column[] = [[], ...series.map(() => [])];
  const build = (): uPlot => {
    const axis = {
      stroke: color("quiet"),
      grid: { stroke: color("line"), width: 1 },
      ticks: { stroke: color("line") },
    };
    const curves = series.map(({ label, color: name, dash, points }) => ({
      label,
      stroke: color(name),
      width: points ? 0 : 2,
      dash,
      points: { show: points === true, size: 8, fill: color(name) },
    }));
    const options: uPlot.Options = {
      width: wide(),
      height: 230,
      legend: { live: false },
      cursor: { drag: { x: false, y: false } },
      scales: {
        x: { time: false, ...(x[2] > x[1] ? { range: [x[1], x[2]] as [number, number] } : {}) },
      },
      axes: [
        { ...axis, label: x[0], labelSize: 20 },
        { ...axis, label: y, labelSize: 20, size: 48 },
      ],
      series: [{ label: x[0] }, ...curves],
      hooks: { drawClear: [(u) => band && drawBand(u, band)], draw: [(u) => drawMarks(u, marks)] },
    };
    return new uPlot(options, last as uPlot.AlignedData, place);
  };
  let plot = build();
  return {
    set(data, places) {
      last = data;
      marks = places;
      plot.setData(data as uPlot.AlignedData);
      if (Math.abs(plot.width - wide()) > 2) plot.setSize({ width: wide(), height: 230 });
    },
    theme() {
      plot.destroy();
      plot = build();
    },
  };
}

/** A curve, and points at other values of x, on one ascending axis. */
export const merged = (x: number[], y: Column, marks: readonly Mark[]): Column[] =>
  uPlot.join([
    [x, y],
    [marks.map((mark) => mark.x), marks.map((mark) => mark.y)],
  ]) as Column[];
