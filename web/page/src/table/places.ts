// Positions of balls as text: "x,y" for each, or "in" for one that waits in a pocket; in the
// laboratory also how it is turned, in degrees.
import type { BallState, ShotBall, Table } from "carom";
import { onTable } from "./filmed.js";
import { texts } from "../texts/texts.js";

/** A ball that waits in the first pocket. */
export function pocketed({ pockets: [pocket] }: Table, state: BallState): BallState {
  return pocket
    ? { r: [...pocket.centre, -pocket.depth], v: [0, 0, 0], w: [0, 0, 0], label: "pocketed" }
    : state;
}

/** The balls at the positions of a text. */
export function placesOf(
  text: string,
  table: Table,
  balls: readonly ShotBall[],
): { balls: ShotBall[]; faces: number[] } {
  const places = text
    .split(" ")
    .map((place) => (place === "in" ? undefined : place.split(",").map(Number)));
  if (
    places.length !== balls.length ||
    !places.every(
      (place) => place === undefined || (place.length >= 2 && place.every(Number.isFinite)),
    )
  )
    throw new TypeError(texts.atPlacesXY(text, balls.length));
  return {
    balls: balls.map(({ kind, state }, k) => ({
      kind,
      state: places[k]
        ? { ...state, r: [places[k][0]!, places[k][1]!, kind.radius] }
        : pocketed(table, state),
    })),
    faces: places.map((place) => place?.[2] ?? 0),
  };
}
export const placesText = (
  balls: readonly ShotBall[],
  text: (x: number) => string | number = String,
): string =>
  balls
    .map(({ state }) => (onTable(state) ? `${text(state.r[0])},${text(state.r[1])}` : "in"))
    .join(" ");
