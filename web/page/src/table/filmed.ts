// What the film player shows of a shot: the positions and orientations of its balls at a time, and
// their paths.
import type { BallState, Shot, ShotBall, Table } from "carom";
import { type Film, type Pose, product, wordsOf } from "../../../player/words.js";

/** How long a ball falls in a pocket, about, s. */
const FALL = 0.16;

export type Path = Film["shots"][number]["paths"][number];

export const onTable = ({ label }: Pick<BallState, "label">): boolean =>
  label !== "pocketed" && label !== "off";
/** The length of the film of a shot, including the fall of a ball that was potted at its end. */
export const lasts = ({ time, status, events }: Shot): number =>
  status === "ok" && events.at(-1)?.type === "ball_pocket" ? time + FALL : time;

/** The path of each ball that moves: at every event, and so often a second between. */
export function pathsOf(shot: Shot, often = 25, most = 500): Path[] {
  const times = shot.events.map((event) => event.time);
  const count = Math.min(Math.ceil(shot.time * often), most);
  for (let k = 0; k <= count; k++) times.push((shot.time * k) / Math.max(count, 1));
  for (const event of shot.events)
    if (event.type === "ball_pocket")
      for (let k = 1; k <= 8; k++) times.push(event.time + (FALL * k) / 8);
  times.sort((a, b) => a - b);
  const moving = new Set(
    shot.events.flatMap((event) => (event.type === "ball_ball" ? [event.a, event.b] : [event.a])),
  );
  const found = [...moving].map((ball) => ({ ball, xyz: new Float64Array(3 * times.length) }));
  const end = lasts(shot);
  const coordinates = shot.positionsAt(
    times.map((t) => Math.min(t, end)),
    true,
  );
  times.forEach((_, k) => {
    for (const path of found)
      for (let c = 0; c < 3; c++)
        path.xyz[3 * k + c] = coordinates[3 * (k * shot.balls.length + path.ball) + c]!;
  });
  return found;
}

interface Layout {
  table: Table;
  balls: readonly ShotBall[];
  names: readonly string[];
  /** How each ball is turned at the start. */
  turned: readonly Quaternion[];
}
/** w, x, y, z of a rotation. */
export type Quaternion = readonly [number, number, number, number];
/** The rotation about the vertical by an angle, degrees. */
export const facing = (degrees: number): Quaternion => [
  Math.cos((degrees * Math.PI) / 360),
  0,
  0,
  Math.sin((degrees * Math.PI) / 360),
];

/** The film of a shot, or the balls at rest. */
export function filmOf(
  { table, balls, names, turned }: Layout,
  shot: Shot | undefined,
  paths: Path[],
) {
  let last: { time: number; poses: Pose[] } | undefined;
  return {
    table,
    balls: balls.map(({ kind }, k) => ({ name: names[k]!, radius: kind.radius })),
    shots: [
      {
        time: shot ? lasts(shot) : 0,
        poses(time: number): Pose[] {
          if (last?.time === time) return last.poses;
          // Balls that fall in their pockets lie elsewhere than in the frame.
          const places = shot?.positionsAt([time], true);
          const frame = shot?.frame(time);
          const poses = balls.map(({ state }, k) => {
            const r = places ? [...places.subarray(3 * k, 3 * k + 3)] : state.r;
            const label = frame?.label(k) ?? state.label;
            const seen =
              onTable({ label }) ||
              (shot !== undefined && r[2]! > shot.final[k]!.r[2] && label === "pocketed");
            return {
              r,
              q: frame ? product(frame.turned.subarray(4 * k, 4 * k + 4), turned[k]!) : turned[k]!,
              seen,
            };
          });
          last = { time, poses };
          return poses;
        },
        paths,
        events: (shot?.events ?? []).map(({ time, type, a, b }) => ({
          time,
          text: wordsOf(table, names as string[], type, a, b),
        })),
      },
    ],
  };
}
