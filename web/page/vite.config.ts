import { spawnSync } from "node:child_process";
import { readdirSync, readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";
import { build, defineConfig, type Plugin, type Rollup, transformWithEsbuild } from "vite";

const pathOf = (path: string): string => fileURLToPath(new URL(path, import.meta.url));

/** The view in three dimensions as a module by itself, and the modules in it. */
async function sceneModule(): Promise<{ code: string; modules: string[] }> {
  const lib = { entry: pathOf("src/play/scene.ts"), formats: ["es" as const] };
  const [output] = (await build({
    configFile: false,
    logLevel: "warn",
    build: {
      lib,
      target: "es2022",
      write: false,
      minify: "esbuild",
      rollupOptions: { output: { inlineDynamicImports: true } },
    },
  })) as Rollup.RollupOutput[];
  const [chunk] = output!.output;
  // Vite leaves the space in modules of libraries.
  return {
    code: (await transformWithEsbuild(chunk.code, "scene.js", { minify: true, target: "es2022" }))
      .code,
    modules: Object.keys(chunk.modules),
  };
}

/**
 * A text by gzip: by Zopfli of npm/build, which makes it 5 % smaller, or by Node's where that could
 * not be had.
 */
function gzip(text: string): Buffer {
  const zopfli = spawnSync(
    pathOf("../../build/web/zopfli/bin/python3"),
    [
      "-c",
      "import sys, zopfli.gzip as z; sys.stdout.buffer.write(z.compress(sys.stdin.buffer.read()))",
    ],
    { input: text },
  );
  return zopfli.status === 0 ? zopfli.stdout : gzipSync(text, { level: 9 });
}

/** The file of a package with its licence, however its author spells the word. */
function licenceFile(folder: string): string {
  const name = readdirSync(folder).find((file) => /^licen[cs]e/i.test(file));
  if (name === undefined) throw new Error(`one-file: ${folder} has no licence`);
  return `${folder}/${name}`;
}
/**
 * The page's licences, without their indents: that of carom, of the libraries in its WebAssembly,
 * and of every package that was bundled.
 */
function licences(modules: string[]): string {
  const packages = new Set(
    modules.flatMap((name) => name.match(/^.*\/node_modules\/(?:@[^/]+\/)?[^/]+/) ?? []),
  );
  const texts = [
    pathOf("../../LICENSE"),
    pathOf("../npm/NOTICES"),
    ...[...packages].map(licenceFile),
  ].map((file) =>
    readFileSync(file, "utf8")
      .trim()
      .replaceAll(/^[ \t]+/gm, ""),
  );
  const named = [
    "carom",
    "In its WebAssembly",
    ...[...packages].map((folder) => folder.replace(/^.*\/node_modules\//, "")),
  ];
  return texts
    .map((text, k) => `${named[k]}\n\n${text}`)
    .join("\n\n\n")
    .replaceAll("&", "&amp;")
    .replaceAll("<", "&lt;");
}

// The page is one file, so that it works from a folder: browsers load neither modules nor
// WebAssembly from file: addresses.
function oneFile(): Plugin {
  return {
    name: "one-file",
    // After Vite's own plugins, which still change the code.
    generateBundle: {
      order: "post",
      async handler(_, bundle) {
        const html = bundle["index.html"];
        if (html?.type !== "asset") throw new Error("one-file: there is no index.html");
        let text = String(html.source);
        for (const [name, part] of Object.entries(bundle)) {
          if (part === html) continue;
          // Vite's import() asks where the script lies, of which there is but one. Without that, a
          // worker runs the script too, as a classic one: a page from a folder may not start
          // others.
          const source =
            part.type === "chunk"
              ? part.code.replaceAll("import.meta.url", '""').replaceAll("</script", "<\\/script")
              : String(part.source);
          const tag =
            part.type === "chunk"
              ? `<script type="module">${source}</script>`
              : `<style>${source}</style>`;
          const link = new RegExp(
            `<(script|link)[^>]*${name.replaceAll(/[.*+?^$()|[\]\\]/g, "\\$&")}[^>]*>(</script>)?`,
          );
          if (!link.test(text)) throw new Error(`one-file: index.html does not refer to ${name}`);
          text = text.replace(link, () => tag);
          delete bundle[name];
        }
        if (!text.includes("<!-- licences -->"))
          throw new Error("one-file: index.html has no place for the licences");
        // It is text until it is asked for.
        const scene = await sceneModule();
        text = text.replace("<!-- scene -->", () => gzip(scene.code).toString("base64"));
        html.source = text.replace("<!-- licences -->", () =>
          licences([...this.getModuleIds(), ...scene.modules]),
        );
      },
    },
  };
}

// The page has the library once: browsers without vectors in WebAssembly are older than 2023, and
// the build for them is a third of the page. It has the module that npm/build links for it, without
// the steps in lanes of batches.
function moduleOfPage(): Plugin {
  return {
    name: "module-of-page",
    load(id) {
      if (id.endsWith("/generated/plain.js")) return 'export default "";';
      if (!id.endsWith("/generated/simd.js")) return undefined;
      const module = readFileSync(pathOf("../../build/web/page.wasm.gz")).toString("base64");
      return `export default "${module}";`;
    },
  };
}

// `npm run serve` sends the page compressed, as a server on the network would.
function compressed(): Plugin {
  return {
    name: "compressed",
    configurePreviewServer(server) {
      server.middlewares.use((request, response, next) => {
        const isPage = ["/", "/index.html"].includes(request.url ?? "");
        const accepts = String(request.headers["accept-encoding"]).includes("gzip");
        if (!isPage || !accepts) return next();
        response.setHeader("content-type", "text/html; charset=utf-8");
        response.setHeader("content-encoding", "gzip");
        response.end(gzipSync(readFileSync(pathOf("dist/index.html")), { level: 9 }));
      });
    },
  };
}

export default defineConfig({
  root: pathOf("."),
  base: "./",
  define: {
    MEASURED: JSON.stringify(readFileSync(pathOf("../../data/experiments.csv"), "utf8")),
    DRILLS: JSON.stringify(readFileSync(pathOf("../../data/drills.csv"), "utf8")),
  },
  build: {
    target: "es2022",
    outDir: pathOf("dist"),
    emptyOutDir: true,
    cssCodeSplit: false,
    modulePreload: false,
    chunkSizeWarningLimit: 4000,
    rollupOptions: { output: { inlineDynamicImports: true } },
  },
  plugins: [moduleOfPage(), oneFile(), compressed()],
});
