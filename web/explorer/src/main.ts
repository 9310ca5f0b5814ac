// The page: the library, the views, the theme.
import "uplot/dist/uPlot.min.css";
import "./style.css";
import { load } from "carom";
import { collisionView } from "./collision.js";
import { serve } from "./far.js";
import { shotView } from "./shot.js";
import { el, parameters } from "./ui.js";

async function begin(main: HTMLElement): Promise<void> {
  const solver = document.getElementById("solver") as HTMLSelectElement;
  const theme = document.getElementById("theme") as HTMLButtonElement;
  const dark = window.matchMedia("(prefers-color-scheme: dark)");
  const dress = (name: "light" | "dark"): void => {
    document.documentElement.dataset.theme = name;
    theme.textContent = name === "dark" ? "Light" : "Dark";
  };
  dress(dark.matches ? "dark" : "light");
  const carom = await load();
  document.getElementById("about")!.append(` carom ${carom.version}, ${carom.build === "simd" ? "with" : "without"} vectors.`);
  solver.value = parameters().get("solver") === "euler" ? "euler" : "exact";
  const chosen = (): "exact" | "euler" => (solver.value === "euler" ? "euler" : "exact");
  let view: { update(): void; theme(): void };
  const show = (): void => {
    const name = parameters().get("view") === "collision" ? "collision" : "shot";
    for (const one of ["shot", "collision"]) {
      const link = document.getElementById(`to-${one}`)!;
      if (one === name) link.setAttribute("aria-current", "page");
      else link.removeAttribute("aria-current");
    }
    view = (name === "shot" ? shotView : collisionView)(carom, chosen, main);
    main.setAttribute("aria-busy", "false");
  };
  show();
  window.addEventListener("hashchange", show);
  solver.addEventListener("change", () => view.update());
  const dressed = (name: "light" | "dark"): void => {
    dress(name);
    view.theme();
  };
  theme.addEventListener("click", () => dressed(document.documentElement.dataset.theme === "dark" ? "light" : "dark"));
  dark.addEventListener("change", () => dressed(dark.matches ? "dark" : "light"));
  let waiting = 0;
  window.addEventListener("resize", () => {
    window.clearTimeout(waiting);
    waiting = window.setTimeout(() => view.theme(), 100);
  });
}

// The same script runs in the worker (far.ts).
if (typeof document === "undefined") void serve();
else {
  // A page that is served can be installed, and then needs no network.
  if (location.protocol !== "file:") {
    document.head.append(el("link", { rel: "manifest", href: "manifest.webmanifest" }));
    navigator.serviceWorker?.register("sw.js").catch((error: unknown) => console.error("sw.js, which keeps the page for use without a network:", error));
  }
  const main = document.getElementById("main")!;
  begin(main).catch((error: unknown) => {
    main.textContent = `The library did not start: ${error instanceof Error ? error.message : String(error)}`;
  });
}
