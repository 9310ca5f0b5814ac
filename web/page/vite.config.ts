import { spawnSync } from "node:child_process";
import { readdirSync, readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";
import { defineConfig, type Plugin, type Rollup } from "vite";

const pathOf = (path: string): string => fileURLToPath(new URL(path, import.meta.url));

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

/** The file of a package with its licence, in either spelling. */
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

/** The parts of the page, and the first one, whose names are those of their sources. */
const FIRST = "first";
/** What hands names over: `export{a as b}` and `import{b as c}from"./part.js"`, as esbuild shortens them. */
const EXPORTS = /export\s*\{([^}]*)\};?\s*$/;
const IMPORTS = /import\s*\{([^}]*)\}\s*from\s*"\.\/([\w-]+)\.js";?/g;
/** Names as properties: "a as b" with `pair(a, b)`. */
const properties = (names: string, pair: (from: string, to: string) => string): string =>
  names
    .split(",")
    .filter((name) => name.trim() !== "")
    .map((name) =>
      pair(
        ...(name
          .trim()
          .split(/\s+as\s+/)
          .slice(0, 2) as [string, string]),
      ),
    )
    .join(",");

/**
 * A part as text. Browsers load no modules from file: addresses, so a part finds the names of others
 * in `caromParts`, where src/behind.ts and the first part put them.
 */
function partOf(chunk: Rollup.OutputChunk): string {
  const code = chunk.code
    .replaceAll("import.meta.url", '""')
    .replaceAll(
      IMPORTS,
      (_, names: string, from: string) =>
        `const{${properties(names, (name, own = name) => `${name}:${own}`)}}=caromParts["${from}"];`,
    )
    .replaceAll(/\bimport\((["'`])\.\/([\w-]+)\.js\1\)/g, 'caromPart("$2")');
  if (chunk.name !== FIRST) return code;
  const names = EXPORTS.exec(code)?.[1] ?? "";
  return code.replace(
    EXPORTS,
    () =>
      `Object.assign(caromParts,{${FIRST}:{${properties(names, (own, name = own) => `${name}:${own}`)}}});`,
  );
}

// The page is one file, so that it works from a folder. Its first part runs as soon as it has come,
// also in workers (src/far.ts), and so is a classic script; the others are compressed text behind it,
// until they are asked for.
function oneFile(): Plugin {
  return {
    name: "one-file",
    // After Vite's own plugins, which still change the code.
    generateBundle: {
      order: "post",
      handler(_, bundle) {
        const html = bundle["index.html"];
        if (html?.type !== "asset") throw new Error("one-file: there is no index.html");
        let text = String(html.source);
        const put = (mark: string, words: string): void => {
          if (!text.includes(mark)) throw new Error(`one-file: index.html has no ${mark}`);
          text = text.replace(mark, () => words);
        };
        const parts: string[] = [];
        for (const [name, part] of Object.entries(bundle)) {
          if (part === html) continue;
          delete bundle[name];
          const link = new RegExp(
            `<(script|link)[^>]*${name.replaceAll(/[.*+?^$()|[\]\\]/g, "\\$&")}[^>]*>(</script>)?`,
          );
          if (part.type === "asset") {
            if (!link.test(text)) throw new Error(`one-file: index.html does not refer to ${name}`);
            text = text.replace(link, () => `<style>${String(part.source)}</style>`);
          } else if (part.name === FIRST) {
            text = text.replace(link, "");
            const code = partOf(part).replaceAll("</script", "<\\/script");
            put("<!-- first -->", `<script id="first">"use strict";(()=>{${code}})()</script>`);
          } else {
            const needs = part.imports.map((file) => file.replace(/\.js$/, ""));
            const packed = gzip(partOf(part)).toString("base64");
            parts.push(
              `<script type="text/plain" id="part-${part.name}" data-needs="${needs.join(" ")}">${packed}</script>`,
            );
          }
        }
        put("<!-- licences -->", licences([...this.getModuleIds()]));
        put("<!-- parts -->", parts.join("\n"));
        html.source = text;
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

/** The library is in the first part, which calls it at once. */
const manualChunks = (id: string): string | undefined =>
  /\/src\/main\.ts$|\/generated\/(simd|plain)\.js$/.test(id) ? FIRST : undefined;

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
    rollupOptions: {
      output: { entryFileNames: "[name].js", chunkFileNames: "[name].js", manualChunks },
    },
  },
  plugins: [moduleOfPage(), oneFile(), compressed()],
});
