// What the coach draws on the table after a hint: a run-out with the zones where the cue ball may
// stop, and safeties with the paths of their balls. Each sketch has a number and a colour.
import type { PlanStroke, SequenceStroke, ShotBall } from "carom";
import { colourOfSketch, type Line, type Sketch } from "../table/drawing.js";
import { pathsOf } from "../table/filmed.js";
import { OPTIONS, type Play } from "./game.js";
import type { Session } from "./parts.js";
import { isHinted } from "./session.js";

/** So near to the number of a sketch a tap chooses its stroke, m. */
const REACH = 0.06;

const placeOn = ({ state: { r } }: ShotBall): [number, number] => [r[0], r[1]];

/** The strokes of a run-out: the pot of each, and where the cue ball may stop after it. */
export function runOutSketches({ table, balls }: Play, strokes: readonly SequenceStroke[]) {
  const sketches: Sketch[] = [];
  let layout: readonly ShotBall[] = balls;
  for (const [k, { choice, zone, ruling }] of strokes.entries()) {
    const pocket = table.pockets[choice.pocket];
    const ball = layout[choice.ball];
    const pot = pocket && ball ? [placeOn(ball), [...pocket.centre]] : [];
    const line: Line = { points: pot, colour: colourOfSketch(k), width: 1.4, isDashed: true };
    layout = ruling.balls;
    // The stroke that is aimed has its own lines.
    const lines = k > 0 && pot.length > 0 ? [line] : [];
    const isKept = ruling.turn === "keep";
    sketches.push({ lines, zone: isKept ? zone : [], place: placeOn(layout[choice.cue.ball]!) });
  }
  return sketches;
}

/** Safeties: the paths of the cue ball and of the other balls until they stop. */
export function safetySketches(play: Play, choices: readonly PlanStroke[]): Sketch[] {
  const { carom, table, balls, bounds } = play;
  return choices.map((choice, k) => {
    const { cue, place } = choice;
    const laid = bounds ? carom.placeBall(table, balls, cue.ball, place[0]!, place[1]!) : balls;
    const shot = carom.simulate(table, laid, cue, OPTIONS);
    const lines = pathsOf(shot).map(({ ball, xyz }): Line => {
      const points = Array.from({ length: xyz.length / 3 }, (_, i) => [
        xyz[3 * i]!,
        xyz[3 * i + 1]!,
      ]);
      return { points, colour: colourOfSketch(k), width: 1.4, isDashed: ball !== cue.ball };
    });
    const { r } = shot.final[cue.ball]!;
    return { lines, zone: [], place: [r[0], r[1]], choice };
  });
}

/** The sketches that are seen: as long as a stroke is hinted and aimed. */
export const seenSketches = (s: Session): readonly Sketch[] =>
  isHinted(s) && s.film.time === 0 && !s.film.playing ? s.sketches : [];

/** The stroke whose number is at a point, if any. */
export function sketchedAt(s: Session, [x, y]: readonly number[]): PlanStroke | undefined {
  const isNear = ({ place }: Sketch): boolean => Math.hypot(place[0]! - x!, place[1]! - y!) < REACH;
  return seenSketches(s).find((sketch) => sketch.choice && isNear(sketch))?.choice;
}
