// Drills: layouts from data/drills.csv with a name and a goal for one stroke, and how often each
// was made in this browser. A goal is a list of
//     pot=N[@POCKET]   ball N falls, in that pocket         bank=N       after it hit a cushion
//     first=N          the cue ball hits ball N first       kick=N       after N or more cushions
//     hit=N            it hits N or more balls              cushions=N   it hits N or more cushions
//     cue=X,Y,R        it stops within R of a point, m
//     clear            each stroke pots a ball, until none is left
// The cue ball must not fall, and no ball may leave the table.
import type { Shot } from "carom";
import { pocketName } from "../../../player/words.js";
import { onTable } from "../table/filmed.js";
import { texts, translate } from "../texts/texts.js";

export interface Drill {
  name: string;
  text: string;
  /** Positions of balls by their numbers, m. */
  balls: Map<number, readonly [number, number]>;
  goal: readonly (readonly [string, string])[];
  /** The rating that makes it in half of the tries. */
  rating: number;
}

/** The fields of a line of CSV, of which some are quoted. */
function fields(line: string): string[] {
  const found = [""];
  let isQuoted = false;
  for (const letter of line) {
    if (letter === '"') isQuoted = !isQuoted;
    else if (letter === "," && !isQuoted) found.push("");
    else found[found.length - 1] += letter;
  }
  return found;
}

export function drillsOf(csv: string): Drill[] {
  return csv
    .trim()
    .split("\n")
    .slice(1)
    .map((line) => {
      const [name, text, balls, goal, rating] = fields(line) as [
        string,
        string,
        string,
        string,
        string,
      ];
      return {
        name,
        text,
        rating: Number(rating),
        balls: new Map(
          balls.split(" ").map((word) => {
            const [ball, x, y] = word.split(/[:,]/).map(Number) as [number, number, number];
            return [ball, [x, y] as const];
          }),
        ),
        goal: goal
          .split(" ")
          .map((part) => [part.split("=")[0]!, part.split("=")[1] ?? ""] as const),
      };
    });
}
/** The layout as the text of a game, for so many balls. */
export const atOf = ({ balls }: Drill, count: number): string =>
  Array.from({ length: count }, (_, k) => balls.get(k)?.join(",") ?? "in").join(" ");

const cm = (x: number): string => `${Math.round(100 * Math.abs(x))} cm`;
/**
 * Where the cue ball came, of a place that is wanted, and what would bring it there: along its aim,
 * on from its first contact or back.
 */
function wordsOfPlace(
  { firstContact, final }: Shot,
  [x, y, far]: readonly [number, number, number],
): string {
  const end = final[0]!.r;
  const incoming = firstContact && firstContact.event.before[firstContact.event.a === 0 ? 0 : 1];
  const [vx, vy] = incoming
    ? ([0, 1].map((c) => incoming.v[c]! / Math.hypot(incoming.v[0], incoming.v[1])) as [
        number,
        number,
      ])
    : [0, 0];
  const along = (place: readonly number[]): number =>
    (place[0]! - incoming!.r[0]) * vx + (place[1]! - incoming!.r[1]) * vy;
  if (!incoming || Math.abs((x - incoming.r[0]) * vy - (y - incoming.r[1]) * vx) > 0.1)
    return texts.theCueBallEnded(cm(Math.hypot(end[0] - x, end[1] - y)), cm(far));
  const goal = along([x, y]);
  const came = along(end);
  if (Math.abs(goal) < 0.1)
    return texts.theCueBallBy(
      came > 0 ? texts.rolledOn : texts.cameBack,
      cm(came),
      came > 0 ? texts.lower : texts.higher,
    );
  const share = came / goal;
  const harder = goal > 0 ? texts.higherOrFaster : texts.lowerOrFaster;
  const way = goal > 0 ? texts.rolledOn : texts.cameBack;
  return texts.theCueBallOf(
    way,
    cm(Math.max(share, 0) * goal),
    cm(goal),
    share > 1 ? texts.softer : harder,
  );
}

/**
 * Whether a stroke made the drill, missed it, or continues it; which parts of the goal failed, and
 * what was wanted and what happened, in words.
 */
export function judge(
  { goal }: Drill,
  shot: Shot,
): { outcome: "made" | "missed" | "on"; failed: string[]; why: string[] } {
  const { events, final, table } = shot;
  if (!onTable(final[0]!)) return { outcome: "missed", failed: [], why: [texts.theCueBallFell] };
  if (final.some(({ label }) => label === "off"))
    return { outcome: "missed", failed: [], why: [texts.aBallLeftThe] };
  const meets = events.filter(({ type, a, b }) => type === "ball_ball" && (a === 0 || b === 0));
  const partner = ({ a, b }: (typeof events)[number]): number => (a === 0 ? b : a);
  const isCushion = ({ type }: (typeof events)[number]): boolean =>
    type === "ball_linear_cushion" || type === "ball_circular_cushion";
  const fell = (ball: number): (typeof events)[number] | undefined =>
    events.find(({ type, a }) => type === "ball_pocket" && a === ball);
  const hits = new Set(meets.map(partner)).size;
  const kicks = events.filter(
    (event) => isCushion(event) && event.a === 0 && meets[0] && event.time < meets[0].time,
  ).length;
  const rails = events.filter(
    (event) => event.type === "ball_linear_cushion" && event.a === 0,
  ).length;
  const checks: Record<string, (value: string) => boolean> = {
    pot(value) {
      const [ball, pocket] = value.split("@");
      const event = fell(Number(ball));
      return (
        event !== undefined &&
        (pocket === undefined || pocketName(table, event.b) === `${pocket} pocket`)
      );
    },
    bank(value) {
      const event = fell(Number(value));
      return (
        event !== undefined &&
        events.some(
          (impact) =>
            impact.type === "ball_linear_cushion" &&
            impact.a === Number(value) &&
            impact.time < event.time,
        )
      );
    },
    first: (value) => meets[0] !== undefined && partner(meets[0]) === Number(value),
    kick: (value) => meets[0] !== undefined && kicks >= Number(value),
    hit: (value) => hits >= Number(value),
    cushions: (value) => rails >= Number(value),
    cue(value) {
      const [x, y, far] = value.split(",").map(Number) as [number, number, number];
      return Math.hypot(final[0]!.r[0] - x, final[0]!.r[1] - y) <= far;
    },
  };
  const words: Record<string, (value: string) => string> = {
    pot(value) {
      const [ball = "", pocket] = value.split("@");
      return pocket === undefined
        ? texts.didNotFall(ball)
        : texts.didNotFallIn(ball, translate(pocket));
    },
    bank: (value) =>
      fell(Number(value)) ? texts.fellWithoutCushion(value) : texts.didNotFall(value),
    first: (value) => (meets[0] ? texts.metFirst(partner(meets[0]), value) : texts.metNone(value)),
    kick: (value) => texts.itMetOfCushions(kicks, value),
    hit: (value) => texts.itMetOfBalls(hits, value),
    cushions: (value) => texts.theCueBallMetOf(rails, value),
    cue: (value) => wordsOfPlace(shot, value.split(",").map(Number) as [number, number, number]),
  };
  if (goal[0]![0] === "clear") {
    if (!events.some(({ type }) => type === "ball_pocket"))
      return { outcome: "missed", failed: [], why: [texts.noBallFell] };
    const areLeft = final.some((state, k) => k > 0 && onTable(state));
    return { outcome: areLeft ? "on" : "made", failed: [], why: [] };
  }
  const failed = goal.filter(([word, value]) => !checks[word]!(value));
  return {
    outcome: failed.length === 0 ? "made" : "missed",
    failed: failed.map(([word]) => word),
    why: failed.map(([word, value]) => words[word]!(value)),
  };
}
