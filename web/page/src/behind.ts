// The parts of the page that follow its first one, loaded by `import()`. The page contains them as
// compressed text (vite.config.ts), so that the first view does not wait for them; a part finds the
// exports of another one in `caromParts`.
import { texts } from "./texts/texts.js";

declare global {
  var caromParts: Record<string, unknown>;
  var caromPart: (name: string) => Promise<unknown>;
}

async function unpack(text: string): Promise<unknown> {
  const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  const source = await new Response(
    new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip")),
  ).blob();
  const url = URL.createObjectURL(new Blob([source], { type: "text/javascript" }));
  try {
    return await import(/* @vite-ignore */ url);
  } finally {
    URL.revokeObjectURL(url);
  }
}
async function load(name: string): Promise<unknown> {
  if (document.readyState === "loading")
    await new Promise((done) =>
      document.addEventListener("DOMContentLoaded", done, { once: true }),
    );
  const place = document.getElementById(`part-${name}`);
  if (!place) throw new Error(texts.thePageLacks(name));
  for (const need of place.dataset.needs!.split(" "))
    if (need !== "" && !(need in caromParts)) await caromPart(need);
  return (caromParts[name] = await unpack(place.textContent!));
}

const loading: Record<string, Promise<unknown>> = {};
globalThis.caromParts = {};
globalThis.caromPart = (name) => (loading[name] ??= load(name));
