// The page: the library, the views, the theme.
import "uplot/dist/uPlot.min.css";
import "./style.css";
import "./lab/style.css";
import "./play/stage.css";
import "./play/plates.css";
import "./play/dialogs.css";
import "./behind.js";
import { load } from "carom";
import { serve } from "./far.js";
import { playView } from "./play/view.js";
import { el, parameters, wrong } from "./ui.js";
import { language, texts } from "./texts/texts.js";

interface View {
  update(): void;
  theme(): void;
  close?(): void;
}
const VIEWS = ["play", "lab", "collision"] as const;

function name(): void {
  for (const element of document.querySelectorAll<HTMLElement>("[data-text]"))
    element.textContent = texts[element.dataset.text as "play"];
}
async function begin(main: HTMLElement): Promise<void> {
  const solver = document.getElementById("solver") as HTMLSelectElement;
  document.documentElement.lang = language;
  name();
  // The elements after this script have texts too.
  document.addEventListener("DOMContentLoaded", name);
  document.querySelector("nav")!.setAttribute("aria-label", texts.views);
  const theme = document.getElementById("theme") as HTMLButtonElement;
  const dark = window.matchMedia("(prefers-color-scheme: dark)");
  let view: View | undefined;
  const dress = (isDark: boolean): void => {
    document.documentElement.dataset.theme = isDark ? "dark" : "light";
    theme.textContent = isDark ? texts.light : texts.dark;
    view?.theme();
  };
  dress(dark.matches);
  const carom = await load({ build: "simd" }).catch((error: unknown) => {
    throw error instanceof WebAssembly.CompileError
      ? new Error(texts.thisPageNeedsWebassembly)
      : error;
  });
  document.getElementById("about")!.append(` carom ${carom.version}.`);
  solver.value = parameters().get("solver") === "euler" ? "euler" : "exact";
  const chosen = (): "exact" | "euler" => (solver.value === "euler" ? "euler" : "exact");
  const build: Record<(typeof VIEWS)[number], () => Promise<() => View>> = {
    play: async () => () => playView(carom, main),
    lab: async () => {
      const { laboratory } = await import("./lab/views.js");
      return () => laboratory(carom, chosen, main);
    },
    collision: async () => {
      const { collisionView } = await import("./lab/views.js");
      return () => collisionView(carom, chosen, main);
    },
  };
  let latest = "";
  const show = async (): Promise<void> => {
    const request = parameters().get("view") ?? "play";
    // "shot" is what links of version 0.3.0 call the laboratory.
    const name = request === "shot" ? "lab" : (VIEWS.find((view) => view === request) ?? "play");
    latest = name;
    const make = await build[name]();
    if (latest !== name) return;
    document.documentElement.dataset.view = name;
    for (const view of VIEWS) {
      const link = document.getElementById(`to-${view}`)!;
      if (view === name) link.setAttribute("aria-current", "page");
      else link.removeAttribute("aria-current");
    }
    view?.close?.();
    main.setAttribute("aria-busy", "false");
    view = make();
  };
  await show();
  window.addEventListener("hashchange", show);
  solver.addEventListener("change", () => view?.update());
  theme.addEventListener("click", () => dress(document.documentElement.dataset.theme !== "dark"));
  dark.addEventListener("change", () => dress(dark.matches));
  let waiting = 0;
  window.addEventListener("resize", () => {
    window.clearTimeout(waiting);
    waiting = window.setTimeout(() => view?.theme(), 100);
  });
}

// The same script runs in workers (far.ts).
if (typeof document === "undefined") void serve();
else {
  // A page that is served can be installed, and then needs no network.
  if (location.protocol !== "file:") {
    document.head.append(el("link", { rel: "manifest", href: "manifest.webmanifest" }));
    navigator.serviceWorker
      ?.register("sw.js")
      .catch((error: unknown) =>
        console.error("sw.js, which keeps the page for use without a network:", error),
      );
  }
  const main = document.getElementById("main")!;
  begin(main).catch((error: unknown) => {
    main.textContent = texts.theLibraryDidNot(wrong(error));
  });
}
