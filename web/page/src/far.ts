// The library in workers, for calls that take longer than a frame. The page is one file, so a
// worker runs the first part of the page, which acts as a server where there is no document. Each
// kind of call has its worker: the chances of a stroke do not wait for a plan. A search runs in
// slices, and can be stopped between two of them.
import { type Carom, load } from "carom";
import { drillStroke } from "./play/drill_search.js";
import { wrong } from "./ui.js";
import { texts } from "./texts/texts.js";

/** What runs in workers, by name. */
const callsOf = (carom: Carom) => ({
  plan: (...[table, balls, options]: Parameters<Carom["plan"]>) =>
    carom.think(table, balls, options, SLICE),
  chances: carom.chances.bind(carom),
  sequence: (...[table, balls, options]: Parameters<Carom["sequence"]>) =>
    carom.thinkSequence(table, balls, options, SLICE),
  bestBreaks: carom.bestBreaks.bind(carom),
  review: carom.review.bind(carom),
  drill: (...args: Parameters<typeof drillStroke> extends [Carom, ...infer R] ? R : never) =>
    drillStroke(carom, ...args),
});
type Calls = ReturnType<typeof callsOf>;
type Name = keyof Calls;
type Search<T> = Generator<undefined, T>;
type Answer<T> = T extends Search<infer R> ? R : T;
/** A call with its number; or the number of one that is to stop. */
type Message = [number, Name, unknown[]] | [number];
/** The calls that run in slices, of so many events each: some 50 ms. */
const SEARCHES: readonly Name[] = ["plan", "sequence"];
const SLICE = 25_000;

/** What a search finds, unless it is stopped between two slices. */
async function resultOf<T>(search: Search<T>, isStopped: () => boolean): Promise<T | undefined> {
  for (;;) {
    const { done, value } = search.next();
    if (done) return value;
    await new Promise((later) => setTimeout(later)); // messages are read here
    if (isStopped()) return void search.return(undefined as never);
  }
}
/** Answers calls, in the worker, one after the other. */
export async function serve(): Promise<void> {
  const calls = load().then(callsOf);
  const stopped = new Set<number>();
  async function answer(number: number, name: Name, args: unknown[]): Promise<void> {
    const isStopped = (): boolean => stopped.has(number);
    try {
      if (isStopped()) return;
      const found = ((await calls)[name] as (...args: unknown[]) => unknown)(...args);
      const value = SEARCHES.includes(name)
        ? await resultOf(found as Search<unknown>, isStopped)
        : found;
      self.postMessage([number, value]);
    } catch (error) {
      self.postMessage([number, undefined, wrong(error)]);
    }
  }
  let last = Promise.resolve();
  self.addEventListener("message", ({ data: [number, name, args] }: MessageEvent<Message>) => {
    if (name === undefined) stopped.add(number);
    else last = last.then(() => answer(number, name, args!));
  });
}

interface Lane {
  worker: Worker;
  waiting: Map<number, { done(value: never): void; failed(error: Error): void }>;
}
const lanes = new Map<Name, Lane>();
let count = 0;

function open(name: Name): Lane {
  const script = document.querySelector("#first")!.textContent!;
  const worker = new Worker(URL.createObjectURL(new Blob([script], { type: "text/javascript" })));
  const lane: Lane = { worker, waiting: new Map() };
  worker.addEventListener(
    "message",
    ({ data: [number, value, error] }: MessageEvent<[number, never, string?]>) => {
      const call = lane.waiting.get(number);
      if (!call) return; // it was stopped
      lane.waiting.delete(number);
      if (error === undefined) call.done(value);
      else call.failed(new Error(error));
    },
  );
  worker.addEventListener("error", (event) => {
    for (const { failed } of lane.waiting.values())
      failed(new Error(texts.theWorkerThatPlans(event.message)));
    lanes.delete(name);
  });
  lanes.set(name, lane);
  return lane;
}

/** Calls the library in a worker. */
export function far<K extends Name>(
  name: K,
  ...args: Parameters<Calls[K]>
): Promise<Answer<ReturnType<Calls[K]>>> {
  const { worker, waiting } = lanes.get(name) ?? open(name);
  return new Promise((done, failed) => {
    waiting.set(count, { done, failed });
    worker.postMessage([count++, name, args]);
  });
}

/**
 * Ends the calls of a kind that are on their way, whose promises never settle: what comes next does
 * not wait for them.
 */
export function drop(name: Name): void {
  const lane = lanes.get(name);
  if (!lane || lane.waiting.size === 0) return;
  if (SEARCHES.includes(name)) {
    for (const number of lane.waiting.keys()) lane.worker.postMessage([number]);
    lane.waiting.clear();
  } else {
    lane.worker.terminate();
    lanes.delete(name);
  }
}
