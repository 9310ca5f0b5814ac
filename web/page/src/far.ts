// The library in workers, for calls that take longer than a frame. The page is one file, so a
// worker runs the page's first part, which serves where there is no document. Each kind of call has
// a worker: the chance of a stroke does not wait for a plan.
import { type Carom, load } from "carom";
import { drillStroke } from "./play/drill_search.js";
import { wrong } from "./ui.js";
import { texts } from "./texts/texts.js";

/** What runs in workers, by name. */
const callsOf = (carom: Carom) => ({
  plan: carom.plan.bind(carom),
  chances: carom.chances.bind(carom),
  sequence: carom.sequence.bind(carom),
  bestBreaks: carom.bestBreaks.bind(carom),
  review: carom.review.bind(carom),
  drill: (...args: Rest<typeof drillStroke>) => drillStroke(carom, ...args),
});
type Rest<F> = F extends (first: Carom, ...rest: infer R) => unknown ? R : never;
type Calls = ReturnType<typeof callsOf>;
type Name = keyof Calls;

/** Answers calls, in the worker. */
export async function serve(): Promise<void> {
  const calls = load().then(callsOf);
  self.addEventListener(
    "message",
    async ({ data: [number, name, args] }: MessageEvent<[number, Name, never]>) => {
      try {
        self.postMessage([number, ((await calls)[name] as (...args: never) => unknown)(...args)]);
      } catch (error) {
        self.postMessage([number, undefined, wrong(error)]);
      }
    },
  );
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
      const { done, failed } = lane.waiting.get(number)!;
      lane.waiting.delete(number);
      if (error === undefined) done(value);
      else failed(new Error(error));
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
): Promise<ReturnType<Calls[K]>> {
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
  lane.worker.terminate();
  lanes.delete(name);
}
