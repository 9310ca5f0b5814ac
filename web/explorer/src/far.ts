// The library in a worker, for calls that take longer than a frame. The page is one file, so the worker runs the page's own script, which
// serves where there is no document.
import { type Carom, load } from "carom";

type Calls = Pick<Carom, "plan" | "chances">;
type Name = keyof Calls;

/** Answers calls, in the worker. */
export async function serve(): Promise<void> {
  const library = load();
  self.addEventListener("message", async ({ data: [number, name, args] }: MessageEvent<[number, Name, never]>) => {
    try {
      self.postMessage([number, ((await library)[name] as (...args: never) => unknown)(...args)]);
    } catch (error) {
      self.postMessage([number, undefined, error instanceof Error ? error.message : String(error)]);
    }
  });
}

let worker: Worker | undefined;
const waiting = new Map<number, { done(value: never): void; failed(error: Error): void }>();
let count = 0;

/** Calls the library in the worker. */
export function far<K extends Name>(name: K, ...args: Parameters<Calls[K]>): Promise<ReturnType<Calls[K]>> {
  if (worker === undefined) {
    const script = document.querySelector('script[type="module"]')!.textContent!;
    worker = new Worker(URL.createObjectURL(new Blob([script], { type: "text/javascript" })));
    worker.addEventListener("message", ({ data: [number, value, error] }: MessageEvent<[number, never, string?]>) => {
      const { done, failed } = waiting.get(number)!;
      waiting.delete(number);
      if (error === undefined) done(value);
      else failed(new Error(error));
    });
    worker.addEventListener("error", (event) => {
      for (const { failed } of waiting.values()) failed(new Error(`The worker that plans did not start: ${event.message}`));
      waiting.clear();
      worker = undefined;
    });
  }
  return new Promise((done, failed) => {
    waiting.set(count, { done, failed });
    worker!.postMessage([count++, name, args]);
  });
}
