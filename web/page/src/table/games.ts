// The games of the page: their tables, racks and names of balls.
import {
  byNumber,
  type Cue,
  type Game,
  games,
  type GameState,
  type Line,
  type Measures,
  type RackName,
  type TableName,
  words,
} from "carom";
import { texts, translate } from "../texts/texts.js";

export interface GameOf {
  text: string;
  table: TableName;
  rack: RackName;
  game: Game;
  names: (k: number) => string;
}

const COLOURS = ["yellow", "green", "brown", "blue", "pink", "black"];
const pool = (k: number): string => (k === 0 ? "cue" : String(k));
function snookerName(k: number): string {
  if (k === 0) return "white";
  return k < 16 ? `red ${k}` : COLOURS[k - 16]!;
}
/** Blackball has seven reds, the black 8, and seven yellows. */
function blackballName(k: number): string {
  if (k === 0) return "cue";
  if (k === 8) return "black";
  return k < 8 ? `red ${k}` : `yellow ${k}`;
}
/** The name of a game in its text: "Blackball" of "blackball by the WPA". */
const titleOf = (text: string): string =>
  text[0]!.toUpperCase() + text.slice(1).split(/ by |, /)[0]!;
export const GAMES: Record<string, GameOf> = {
  nineball: { text: texts.nineBall, table: "9ft", rack: "nineball", game: "pool", names: pool },
  tenball: { text: texts.tenBall, table: "9ft", rack: "tenball", game: "pool", names: pool },
  eightball: { text: texts.eightBall, table: "9ft", rack: "eightball", game: "pool", names: pool },
  snooker: {
    text: texts.snooker,
    table: "snooker",
    rack: "snooker",
    game: "snooker",
    names: snookerName,
  },
  threecushion: {
    text: texts.threeCushion,
    table: "threecushion",
    rack: "threecushion",
    game: "billiard",
    names: (k) => ["white", "yellow", "red"][k] ?? String(k),
  },
};
/** The drill. */
const LEFT_OUT: readonly string[] = ["potting"];
/** The games that each seat plays for itself, with the numbers of seats that the page offers. */
export const SEATS: Readonly<Record<string, readonly number[]>> = {
  killer: [2, 3, 4, 5],
  cutthroat: [3, 5],
};
for (const [name, text] of words.rules) {
  const { balls, rack, table } = games[name];
  if (GAMES[rack]?.table === table) continue;
  const fourball = ["white", "yellow", "red", "maroon"];
  const namesOf: Record<string, (k: number) => string> = {
    fourball: (k) => fourball[k] ?? String(k),
    blackball: blackballName,
    billiards: (k) => ["white", "yellow", "red"][k] ?? String(k),
    pyramid: (k) => (k === 0 ? "yellow" : String(k)),
    cowboy: (k) => ["cue", "1", "3", "5"][k] ?? String(k),
  };
  const names = namesOf[rack] ?? pool;
  GAMES[name] = { text: translate(titleOf(text)), table, rack, game: balls, names };
}
/** The pool tables, by the key in a game's setup; the default is nine feet. */
export const POOL_TABLES: Record<
  string,
  readonly [text: string, table: TableName, measures?: Partial<Measures>]
> = {
  "9ft": [texts.nineFeet, "9ft"],
  "8ft": [texts.eightFeet, "8ft"],
  "7ft": [texts.sevenFeet, "7ft"],
  tight: [texts.nineFeetCornersOf, "9ft", { cornerMouth: 0.10795 }],
};
export const POOL_TABLE_NAMES = Object.entries(POOL_TABLES).map(
  ([key, [text]]) => [key, text] as const,
);
export const TABLES: readonly TableName[] = words.table.map(([word]) => word);

/** A line that was read, and its game, in which ball k of the list is ball k. */
export interface Read<L> {
  name: string;
  line: L;
  /** Which other game the balls fit. */
  also: string | undefined;
}

/**
 * The game of a line: the one that its id names; else one that its balls fit by their numbers, with
 * the ball that decides it on the table. Of two
 * such games it is the one that is asked for, or the one all of whose balls are there; where it is
 * neither, the line is refused.
 */
export function gameOf<L extends Line>(line: L, preferred: string): Read<L> {
  // snooker, threecushion
  if (line.tableName in GAMES) return { name: line.tableName, line, also: undefined };
  const fitting: Record<string, L> = {};
  for (const [name, last] of [
    ["nineball", "9"],
    ["eightball", "8"],
  ] as const)
    try {
      const ordered = { ...line, ...byNumber(line, name) };
      if (line.id === name) return { name, line: ordered, also: undefined };
      if (line.balls.some(({ state }, k) => line.names[k] === last && state.label !== "pocketed"))
        fitting[name] = ordered;
    } catch (error) {
      if (line.id === name) throw error;
    }
  const names = Object.keys(fitting);
  const whole = names.find((name) => fitting[name]!.balls.length === line.balls.length);
  const name = names.includes(preferred) ? preferred : (whole ?? names[0]);
  if (name === undefined) return { name: "nineball", line, also: undefined };
  if (names.length > 1 && name !== preferred && name !== whole)
    throw new TypeError(
      texts.ballsTheyFitChoose(names.map((name) => GAMES[name]!.text).join(texts.andWord)),
    );
  return {
    name,
    line: fitting[name]!,
    also: name === whole ? undefined : names.find((key) => key !== name),
  };
}

/** A game that is played by the library's rules. */
export interface Played {
  text: string;
  /** Its key in GAMES: table, rack, names. */
  base: string;
  rules: GameState["rules"];
  /**
   * Whether ball and pocket are called, the score is points or balls, each has a pocket of his own;
   * and where the cue ball is at first.
   */
  calls: boolean;
  points: boolean;
  pockets: boolean;
  opening: string;
  /** The initial state of a game where it differs from the library's. */
  state?: Partial<GameState>;
  /** The stroke that a game begins with, as one finds it. */
  begin: Partial<Cue>;
}
const BREAK = { speed: 8, phi: 90, a: 0, b: 0 };
const OWN: Record<string, Partial<Played>> = {
  straight: {
    text: texts.straightPoolTo25,
    state: { target: 25 },
    begin: { ...BREAK, speed: 5.2 },
  },
  snooker: { calls: false, begin: { ...BREAK, speed: 2 } },
  threecushion: {
    text: texts.threeCushionTo10,
    state: { target: 10 },
    begin: { speed: 4, phi: 62, a: 0, b: 0.2 },
  },
  fourball: { text: texts.fourBallTo10, begin: { speed: 3, phi: 97, a: 0, b: 0.2 } },
  // The 1 is in front of the 3, which is hit off a rail.
  cowboy: { begin: { ...BREAK, speed: 3, phi: 53.8 } },
  billiards: { state: { group: "solids", target: 50 }, begin: { ...BREAK, speed: 3, phi: 95.16 } },
  straightrail: {
    text: texts.straightRailTo25,
    state: { target: 25 },
    begin: { speed: 3, phi: 97, a: 0, b: 0.2 },
  },
};
/** Whether the state of a game has a member, such as "innings". */
export const hasMember = (rules: GameState["rules"], member: string): boolean =>
  (games[rules].members as readonly string[]).includes(member);
/** The games whose rules the library has, but for those left out. */
export const PLAYED: Record<string, Played> = Object.fromEntries(
  words.rules.flatMap(([name, text]) => {
    const { rack, calls, opening } = games[name];
    const points = hasMember(name, "score");
    const pockets = hasMember(name, "pocket");
    const begin = pockets ? { ...BREAK, speed: 2.5, b: -0.3 } : BREAK;
    return LEFT_OUT.includes(name)
      ? []
      : [
          [
            name,
            {
              text: translate(titleOf(text)),
              base: name in GAMES ? name : rack,
              rules: name,
              calls,
              points,
              pockets,
              opening,
              begin,
              ...OWN[name],
            },
          ],
        ];
  }),
);
