// A game in this browser, in the address, and on its way to another page: as text, packed for links, and by a channel between pages of one machine.

import type { Setup } from "./game.js";
import { wrong } from "../ui.js";

const KEY = "carom-game";
/** What was kept; undefined where the browser keeps nothing. */
export function kept(key = KEY): string | undefined {
  try {
    return localStorage.getItem(key) ?? undefined;
  } catch {
    return undefined; // the reader has forbidden it
  }
}
export function keepText(text: string, key = KEY): void {
  try {
    localStorage.setItem(key, text);
  } catch (error) {
    console.info("This browser keeps no games:", error);
  }
}

const tally = (): Record<string, [number, number]> => JSON.parse(kept("carom-racks") ?? "{}") as Record<string, [number, number]>;
/** The racks that each has won of a game against the same one. */
export const racksOf = ({ game, against }: Setup): readonly [number, number] => tally()[`${game}/${against}`] ?? [0, 0];
export function countRack({ game, against }: Setup, winner: 0 | 1): void {
  const all = tally();
  (all[`${game}/${against}`] ??= [0, 0])[winner]++;
  keepText(JSON.stringify(all), "carom-racks");
}

async function through(bytes: Uint8Array<ArrayBuffer>, by: ReadableWritablePair<Uint8Array, BufferSource>): Promise<Uint8Array> {
  return new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(by)).arrayBuffer());
}
/** A text for an address: deflated, in the letters of base 64 that addresses leave as they are. */
export async function pack(text: string): Promise<string> {
  const bytes = await through(new TextEncoder().encode(text), new CompressionStream("deflate-raw"));
  return btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join("")).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "");
}
export async function unpack(packed: string): Promise<string> {
  let bytes: Uint8Array<ArrayBuffer>;
  try {
    bytes = Uint8Array.from(atob(packed.replaceAll("-", "+").replaceAll("_", "/")), (letter) => letter.charCodeAt(0));
    return new TextDecoder().decode(await through(bytes, new DecompressionStream("deflate-raw")));
  } catch {
    throw new TypeError("the link is cut off or damaged: ask for it again");
  }
}

/** Sends a link by what the machine has for that, or copies it. Returns what is to be told. */
export async function send(url: string, title: string, share: boolean, copied: string): Promise<string> {
  try {
    if (share && "share" in navigator) await navigator.share({ title, url });
    else await navigator.clipboard.writeText(url);
    return share && "share" in navigator ? "Sent." : copied;
  } catch (error) {
    return `The browser does not let the page send the link (${wrong(error)}).`;
  }
}

/** A game that others of this machine see: they send its text when it has changed, or ask for it. */
export function channel(heard: (text: string) => void, asked: () => string | undefined): { send(text: string): void; ask(): void; close(): void } {
  const one = new BroadcastChannel("carom-games");
  one.addEventListener("message", ({ data }: MessageEvent<{ text?: string }>) => {
    if (data.text !== undefined) return heard(data.text);
    const text = asked();
    if (text !== undefined) one.postMessage({ text });
  });
  return { send: (text) => one.postMessage({ text }), ask: () => one.postMessage({}), close: () => one.close() };
}
