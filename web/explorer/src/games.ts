// The games of the page: their tables, racks and names of balls.
import type { Carom, Game, Line, RackName, TableName } from "carom";

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
export const TABLES: readonly TableName[] = ["9ft", "8ft", "7ft", "snooker", "threecushion", "pooltool"];

/** The key of the game whose table and rack a layout may be of. */
export function gameOf(carom: Carom, read: Pick<Line, "id" | "tableName" | "table" | "balls">): string | undefined {
  const fits = ([key, one]: [string, GameOf]): boolean => one.table === read.tableName && (key === read.id || carom.rack(one.rack, read.table).length >= read.balls.length);
  return Object.entries(GAMES).find(fits)?.[0];
}
