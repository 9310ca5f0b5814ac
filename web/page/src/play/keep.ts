// What this browser saves in addition to games: settings, counts and the log, as JSON under a key.
// Also packs a text into a link.

import type { Play, Setup } from "./game.js";
import { wrong } from "../ui.js";
import { texts } from "../texts/texts.js";

/** What was kept under a key; undefined where the browser keeps nothing. */
export function stored(key: string): string | undefined {
  try {
    return localStorage.getItem(key) ?? undefined;
  } catch {
    return undefined; // the reader has forbidden it
  }
}
/** Keeps a text under a key, or nothing any more. */
export function keepText(text: string | undefined, key: string): void {
  try {
    if (text === undefined) localStorage.removeItem(key);
    else localStorage.setItem(key, text);
  } catch (error) {
    console.info("This browser keeps nothing:", error);
  }
}

/** The keys whose values were damaged since the page was loaded. */
export const damaged = new Set<string>();
/**
 * The value that was kept as JSON under a key. Where it is damaged, `otherwise` is returned, the
 * damaged text is put aside under another key, and the page says so once.
 */
export function keptValue<T>(
  key: string,
  otherwise: T,
  fits: (value: unknown) => boolean = isObject,
): T {
  const text = stored(key);
  if (text === undefined) return otherwise;
  try {
    const value: unknown = JSON.parse(text);
    if (fits(value)) return value as T;
  } catch {
    // It is no JSON: as damaged as a value of another kind.
  }
  damaged.add(key);
  keepText(text, `${key}-damaged`);
  keepText(undefined, key);
  return otherwise;
}
const isObject = (value: unknown): boolean =>
  typeof value === "object" && value !== null && !Array.isArray(value);

/** Two numbers that are counted under a name. */
type Tally = Record<string, [number, number]>;
const isPair = (value: unknown): boolean =>
  Array.isArray(value) && value.length === 2 && value.every((count) => count >= 0);
const isTally = (value: unknown): boolean =>
  isObject(value) && Object.values(value as object).every(isPair);
export const tally = (key: string): Tally => keptValue(key, {}, isTally);
export const countsOf = (key: string, name: string): [number, number] => tally(key)[name] ?? [0, 0];
/** Counts one more of the first or of the second, or of both. */
export function count(
  key: string,
  name: string,
  more: readonly [number, number],
): [number, number] {
  const [first, second] = countsOf(key, name);
  const sums: [number, number] = [first + more[0], second + more[1]];
  keepText(JSON.stringify({ ...tally(key), [name]: sums }), key);
  return sums;
}
/** The racks that each has won of a race, or of a game against the same one. */
export function racksOf({ setup, winner }: Pick<Play, "setup" | "winner">): [number, number] {
  const { game, against, racks } = setup;
  if (!racks) return countsOf("carom-racks", `${game}/${against}`);
  return [racks[0] + Number(winner === 0), racks[1] + Number(winner === 1)];
}
/** Whether a race is decided. */
export const isRaceOver = (play: Pick<Play, "setup" | "winner">): boolean =>
  Math.max(...racksOf(play)) >= (play.setup.race ?? 1);
export const countRack = ({ game, against }: Setup, winner: number): unknown =>
  count("carom-racks", `${game}/${against}`, winner === 0 ? [1, 0] : [0, 1]);

async function through(
  bytes: Uint8Array<ArrayBuffer>,
  transform: ReadableWritablePair<Uint8Array, BufferSource>,
): Promise<Uint8Array> {
  return new Uint8Array(
    await new Response(new Blob([bytes]).stream().pipeThrough(transform)).arrayBuffer(),
  );
}
/** A text for an address: deflated, in the letters of base 64 that addresses leave as they are. */
export async function pack(text: string): Promise<string> {
  const bytes = await through(new TextEncoder().encode(text), new CompressionStream("deflate-raw"));
  return btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join(""))
    .replaceAll("+", "-")
    .replaceAll("/", "_")
    .replace(/=+$/, "");
}
export async function unpack(packed: string): Promise<string> {
  let bytes: Uint8Array<ArrayBuffer>;
  try {
    bytes = Uint8Array.from(atob(packed.replaceAll("-", "+").replaceAll("_", "/")), (letter) =>
      letter.charCodeAt(0),
    );
    return new TextDecoder().decode(await through(bytes, new DecompressionStream("deflate-raw")));
  } catch {
    throw new TypeError(texts.theLinkIsCut);
  }
}

/** Shares a link with the device's own dialog, or copies it. Returns the message to show. */
export async function send(
  url: string,
  title: string,
  share: boolean,
  copied: string,
): Promise<string> {
  try {
    if (share && "share" in navigator) await navigator.share({ title, url });
    else await navigator.clipboard.writeText(url);
    return share && "share" in navigator ? texts.sent : copied;
  } catch (error) {
    return texts.theBrowserDoesNotLet(wrong(error));
  }
}
