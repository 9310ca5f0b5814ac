// The saved games: each has an id in IndexedDB. What the list shows of them is kept apart, because
// the games are long. A tab has one game open and holds a lock on its id, so that no other tab plays
// the same game.
import { createStore, del, get, keys, set, values } from "idb-keyval";
import type { Aimer, Setup } from "./game.js";
import { stored, keepText } from "./keep.js";

export interface SavedGame {
  id: string;
  /** The game as text: its setup and its strokes. */
  text: string;
  setup: Setup;
  /** Who aimed each stroke; games of older pages do not have it. */
  aims?: readonly Aimer[];
  score: string;
  strokes: number;
  isOver: boolean;
  /** When it was saved, ms since 1970. */
  when: number;
}

/** A game as the list shows it. */
export type ListedGame = Omit<SavedGame, "text">;

const store = createStore("carom", "games");
const list = createStore("carom-list", "games");
/** The key under which a tab remembers which game it has open. */
const OPEN = "carom-open";
/** Where version 0.3 kept its only game. */
const OLD_KEY = "carom-game";

export const newId = (): string => crypto.randomUUID();
/** The id of a game by link, which both of its players' pages on one machine may have open. */
export const idOfLink = ({ game, seed }: Setup, seat: 0 | 1): string =>
  `link-${game}-${seed}-${seat}`;

const listed = ({ id, setup, aims, score, strokes, isOver, when }: SavedGame): ListedGame => ({
  id,
  setup,
  score,
  strokes,
  isOver,
  when,
  ...(aims && { aims }),
});
export async function saveGame(game: SavedGame): Promise<void> {
  await set(game.id, game, store);
  await set(game.id, listed(game), list);
}
export async function deleteGame(id: string): Promise<void> {
  await del(id, store);
  await del(id, list);
}
export const savedGame = (id: string): Promise<SavedGame | undefined> => get(id, store);
/**
 * All games as the list shows them, the last saved one first. Games that an older page has saved
 * are read whole once.
 */
export async function listedGames(): Promise<ListedGame[]> {
  const ids = new Set<IDBValidKey>(await keys(store));
  const games = await values<ListedGame>(list);
  const known = new Set<IDBValidKey>(games.map(({ id }) => id));
  for (const { id } of games) if (!ids.has(id)) await del(id, list);
  const added: ListedGame[] = [];
  for (const id of ids) {
    const game = known.has(id) ? undefined : await savedGame(id as string);
    if (!game) continue;
    added.push(listed(game));
    await set(id, listed(game), list);
  }
  return [...games.filter(({ id }) => ids.has(id)), ...added].sort((a, b) => b.when - a.when);
}

/** Which game the tab had open before it was loaded again. */
export function idOfTab(): string | undefined {
  try {
    return sessionStorage.getItem(OPEN) ?? undefined;
  } catch {
    return undefined; // the reader has forbidden it
  }
}

/** The game that this tab holds, and how it lets go of it. */
let held: { id: string; release(): void } | undefined;
/**
 * Holds a game for this tab, and lets go of the one before. False where another tab has it open.
 * Browsers without locks (pages that are served without TLS) do not know of other tabs.
 */
export async function holdGame(id: string): Promise<boolean> {
  const isHeld =
    "locks" in navigator && held?.id !== id
      ? await new Promise<boolean>((answer) => {
          void navigator.locks.request(`carom ${id}`, { ifAvailable: true }, (lock) => {
            answer(lock !== null);
            if (lock === null) return undefined;
            held?.release();
            return new Promise<void>((release) => (held = { id, release }));
          });
        })
      : true;
  try {
    if (isHeld) sessionStorage.setItem(OPEN, id);
  } catch (error) {
    console.info("This browser does not remember which game a tab has open:", error);
  }
  return isHeld;
}

/** Takes over the only game that version 0.3 kept. */
export async function takeOver(): Promise<void> {
  const text = stored(OLD_KEY);
  if (text === undefined) return;
  const { entries = [], ...setup } = JSON.parse(text) as Setup & { entries?: unknown[] };
  const strokes = entries.length;
  await saveGame({
    id: newId(),
    text,
    setup,
    score: "",
    strokes,
    isOver: false,
    when: Date.now(),
  });
  keepText(undefined, OLD_KEY);
}
