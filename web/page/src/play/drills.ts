// Drills: layouts with a name and what has to happen in one stroke, of data/drills.csv, and how often each was made in this browser. A goal is a list of
//     pot=N[@POCKET]   ball N falls, in that pocket         bank=N       and has met a cushion before
//     first=N          the cue ball meets ball N first       kick=N       after N cushions or more
//     hit=N            it meets N balls or more              cushions=N   it meets N cushions or more
//     cue=X,Y,R        it ends within R of a place, m
//     clear            a ball falls in each stroke, until none is left
// The cue ball never falls, and no ball leaves the table.
import type { Shot } from "carom";
import { pocketName } from "../../../player/words.js";
import { onTable } from "../table/filmed.js";

export interface Drill {
  name: string;
  text: string;
  /** Places of balls by their numbers, m. */
  balls: Map<number, readonly [number, number]>;
  goal: readonly (readonly [string, string])[];
  /** The rating that makes it in half of the tries. */
  rating: number;
}

/** The fields of a line of CSV, of which some are quoted. */
const fields = (line: string): string[] => [...line.matchAll(/(?:^|,)(?:"([^"]*)"|([^,"]*))/g)].map(([, quoted, plain]) => quoted ?? plain ?? "");

export function drillsOf(csv: string): Drill[] {
  return csv.trim().split("\n").slice(1).map((line) => {
    const [name, text, balls, goal, rating] = fields(line) as [string, string, string, string, string];
    return {
      ...{ name, text, rating: Number(rating) },
      balls: new Map(balls.split(" ").map((one) => {
        const [ball, x, y] = one.split(/[:,]/).map(Number) as [number, number, number];
        return [ball, [x, y] as const];
      })),
      goal: goal.split(" ").map((one) => [one.split("=")[0]!, one.split("=")[1] ?? ""] as const),
    };
  });
}
/** The layout as the text of a game, for so many balls. */
export const atOf = ({ balls }: Drill, count: number): string => Array.from({ length: count }, (_, k) => balls.get(k)?.join(",") ?? "in").join(" ");

/** Whether a stroke made it, failed, or goes on. */
export function judge({ goal }: Drill, shot: Shot): "made" | "missed" | "on" {
  const { events, final, table } = shot;
  if (!onTable(final[0]!) || final.some(({ label }) => label === "off")) return "missed";
  const meets = events.filter(({ type, a, b }) => type === "ball_ball" && (a === 0 || b === 0));
  const other = ({ a, b }: (typeof events)[number]): number => (a === 0 ? b : a);
  const isCushion = ({ type }: (typeof events)[number]): boolean => type === "ball_linear_cushion" || type === "ball_circular_cushion";
  const fell = (ball: number): (typeof events)[number] | undefined => events.find(({ type, a }) => type === "ball_pocket" && a === ball);
  const checks: Record<string, (value: string) => boolean> = {
    pot(value) {
      const [ball, pocket] = value.split("@");
      const event = fell(Number(ball));
      return event !== undefined && (pocket === undefined || pocketName(table, event.b) === `${pocket} pocket`);
    },
    bank(value) {
      const event = fell(Number(value));
      return event !== undefined && events.some((one) => one.type === "ball_linear_cushion" && one.a === Number(value) && one.time < event.time);
    },
    first: (value) => meets[0] !== undefined && other(meets[0]) === Number(value),
    kick: (value) => meets[0] !== undefined && events.filter((one) => isCushion(one) && one.a === 0 && one.time < meets[0]!.time).length >= Number(value),
    hit: (value) => new Set(meets.map(other)).size >= Number(value),
    cushions: (value) => events.filter((one) => one.type === "ball_linear_cushion" && one.a === 0).length >= Number(value),
    cue(value) {
      const [x, y, far] = value.split(",").map(Number) as [number, number, number];
      return Math.hypot(final[0]!.r[0] - x, final[0]!.r[1] - y) <= far;
    },
  };
  if (goal[0]![0] === "clear") {
    if (!events.some(({ type }) => type === "ball_pocket")) return "missed";
    return final.some((state, k) => k > 0 && onTable(state)) ? "on" : "made";
  }
  return goal.every(([word, value]) => checks[word]!(value)) ? "made" : "missed";
}
