// The keys of objects that users hand in: an unknown one is refused, by its name, with the one that was probably meant.
import type { Line } from "./lines.js";
import type { AimOf, CollideOptions, CushionOptions, GameState, Impact, Motion, PlanOptions, ShotBall, ShotOptions, StopOptions, Table } from "./types.js";

/** The keys of an interface; the compiler refuses a list that lacks one or has another. */
const all = <T>(keys: Record<keyof T, 1>): readonly string[] => Object.keys(keys);

const GAME: Record<keyof GameState, 1> = { rules: 1, group: 1, opening: 1, fouls: 1, may: 1 };
const STOP: Record<keyof StopOptions, 1> = { timeMost: 1, stopAt: 1, eventsMost: 1 };

/** The keys of the objects that are no struct of C. */
export const KEYS = {
  impact: all<Impact>({ a: 1, b: 1, muBall: 1, restitution: 1 }),
  collide: all<CollideOptions>({ solver: 1, slip: 1, steps: 1 }),
  cushion: all<CushionOptions>({ model: 1, convention: 1, law: 1, steps: 1 }),
  motion: all<Motion & { status: string }>({ v: 1, w: 1, status: 1 }),
  ball: all<ShotBall>({ kind: 1, state: 1, id: 1 }),
  table: all<Table>({ width: 1, length: 1, ballRadius: 1, railWidth: 1, pocketBack: 1, rails: 1, jaws: 1, pockets: 1 }),
  stop: all<StopOptions>(STOP),
  shot: all<ShotOptions>({ world: 1, ballModel: 1, cushionModel: 1, space: 1, simultaneous: 1, clusterSteps: 1, friction: 1, steps: 1, ...STOP }),
  line: all<Line>({ id: 1, tableName: 1, table: 1, names: 1, balls: 1, cue: 1 }),
  game: all<GameState>(GAME),
  aim: all<AimOf>({ ball: 1, pocket: 1, via: 1 }),
  plan: all<PlanOptions>({ player: 1, opponent: 1, shots: 1, seed: 1, inHand: 1, best: 1, cue: 1, shot: 1, ...GAME }),
  player: ["errors", "fargo"],
  rack: ["gap", "seed"],
  polygon: ["noseHeight", "jawRadius", "ballRadius"],
  corner: ["x", "y", "mouth"],
  room: ["room"],
  build: ["build"],
} as const;

/** How many letters have to be put in, left out, replaced or exchanged with the next one to make one word of the other. */
function distance(a: string, b: string): number {
  const rows = [Array.from({ length: b.length + 1 }, (_, k) => k)];
  for (let i = 1; i <= a.length; i++) {
    const row = (rows[i] = [i]);
    for (let k = 1; k <= b.length; k++) {
      row[k] = Math.min(row[k - 1]! + 1, rows[i - 1]![k]! + 1, rows[i - 1]![k - 1]! + (a[i - 1] === b[k - 1] ? 0 : 1));
      if (a[i - 1] === b[k - 2] && a[i - 2] === b[k - 1]) row[k] = Math.min(row[k]!, rows[i - 2]![k - 2]! + 1);
    }
  }
  return rows[a.length]![b.length]!;
}

/** `; did you mean "speed"?` where one of the names resembles the word, else nothing. Capitals and underscores do not count. */
export function meant(word: string, names: readonly string[]): string {
  const letters = (name: string): string => name.toLowerCase().replaceAll("_", "");
  const given = letters(word);
  const apart = (name: string): number => {
    const one = letters(name);
    const within = Math.min(one.length, given.length) > 3 && (one.includes(given) || given.includes(one));
    return within ? Math.min(1, distance(one, given)) : distance(one, given);
  };
  const [nearest] = [...names].sort((a, b) => apart(a) - apart(b));
  const near = nearest !== undefined && apart(nearest) < given.length && apart(nearest) <= Math.max(1, given.length / 3);
  return near ? `; did you mean "${nearest}"?` : "";
}

/** Throws where an object has a key that is not among those known. `name` says which object it is, such as "cue". */
export function refuseUnknown(from: object, known: readonly string[], name = ""): void {
  if (typeof from !== "object" || from === null) throw new TypeError(`${name || "options"}: an object is needed, not ${String(from)}`);
  for (const key in from)
    if (!known.includes(key)) throw new TypeError(`${name && `${name}.`}${key}: there is no such key${meant(key, known) || `; there are ${known.join(", ")}`}`);
}
