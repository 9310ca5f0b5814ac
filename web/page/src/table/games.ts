// The games of the page: their tables, racks and names of balls.
import { byNumber, type Cue, type Game, type GameState, type Line, type RackName, type TableName, words } from "carom";

export interface GameOf {
  text: string;
  table: TableName;
  rack: RackName;
  game: Game;
  names: (k: number) => string;
}

const COLOURS = ["yellow", "green", "brown", "blue", "pink", "black"];
const pool = (k: number): string => (k === 0 ? "cue" : String(k));
export const GAMES: Record<string, GameOf> = {
  nineball: { text: "Nine-ball", table: "9ft", rack: "nineball", game: "pool", names: pool },
  eightball: { text: "Eight-ball", table: "9ft", rack: "eightball", game: "pool", names: pool },
  snooker: { text: "Snooker", table: "snooker", rack: "snooker", game: "snooker", names: (k) => (k === 0 ? "white" : k < 16 ? `red ${k}` : COLOURS[k - 16]!) },
  threecushion: { text: "Three-cushion", table: "threecushion", rack: "threecushion", game: "billiard", names: (k) => ["white", "yellow", "red"][k] ?? String(k) },
};
export const TABLES: readonly TableName[] = words.table.map(([word]) => word);

/** A line that was read, and its game, in which ball k of the list is ball k. */
export interface Read<L> {
  name: string;
  line: L;
  /** Whether the rules of the game hold for the balls, and which other game they fit. */
  known: boolean;
  also: string | undefined;
}

/**
 * The game of a line: the one that its id names; else one that its balls fit by their numbers, with the ball that decides it on the table. Of two
 * such games it is the one that is asked for, or the one all of whose balls are there; where it is neither, the line is refused.
 */
export function gameOf<L extends Line>(line: L, asked: string): Read<L> {
  if (line.tableName in GAMES) return { name: line.tableName, line, known: true, also: undefined }; // snooker, threecushion
  const fitting: Record<string, L> = {};
  for (const [name, last] of [["nineball", "9"], ["eightball", "8"]] as const)
    try {
      const ordered = { ...line, ...byNumber(line, name) };
      if (line.id === name) return { name, line: ordered, known: true, also: undefined };
      if (line.balls.some(({ state }, k) => line.names[k] === last && state.label !== "pocketed")) fitting[name] = ordered;
    } catch (error) {
      if (line.id === name) throw error;
    }
  const names = Object.keys(fitting);
  const whole = names.find((one) => fitting[one]!.balls.length === line.balls.length);
  const name = names.includes(asked) ? asked : (whole ?? names[0]);
  if (name === undefined) return { name: "nineball", line, known: false, also: undefined };
  if (names.length > 1 && name !== asked && name !== whole) throw new TypeError(`balls: they fit ${names.map((one) => GAMES[one]!.text).join(" and ")}; choose one of these games, then import again`);
  return { name, line: fitting[name]!, known: true, also: name === whole ? undefined : names.find((one) => one !== name) };
}

/** A game that is played by the library's rules. */
export interface Played {
  text: string;
  /** Its key in GAMES: table, rack, names. */
  of: string;
  rules: GameState["rules"];
  /** Whether ball and pocket are called. */
  calls: boolean;
  /** Points that win, of games in which the rules count none. */
  target?: number;
  /** Whether the score is points, and the state that a game begins with where it is not that of the library. */
  points?: boolean;
  state?: Partial<GameState>;
  /** The stroke that a game begins with, as one finds it. */
  begin: Partial<Cue>;
}
const BREAK = { speed: 8, phi: 90, a: 0, b: 0 };
/** The games whose rules the library has. */
export const PLAYED: Record<string, Played> = {
  eightball: { text: "Eight-ball", of: "eightball", rules: "eightball", calls: true, begin: BREAK },
  nineball: { text: "Nine-ball", of: "nineball", rules: "nineball", calls: false, begin: BREAK },
  straight: { text: "Straight pool, to 25 points", of: "eightball", rules: "straight", calls: true, points: true, state: { target: 25 }, begin: { ...BREAK, speed: 4 } },
  onepocket: { text: "One-pocket", of: "eightball", rules: "onepocket", calls: false, points: true, begin: { ...BREAK, speed: 2.5, phi: 79.5, b: -0.3 } },
  snooker: { text: "Snooker", of: "snooker", rules: "snooker", calls: false, points: true, begin: { ...BREAK, speed: 4 } },
  threecushion: { text: "Three-cushion, to 10 points", of: "threecushion", rules: "threecushion", calls: false, points: true, target: 10, begin: { speed: 4, phi: 62, a: 0, b: 0.2 } },
};
