// The texts of the page: each language has each text, with the same parts, and no sentence stands
// outside of the files of texts.
import { readdirSync, readFileSync } from "node:fs";
import ts from "typescript";
import { words } from "carom";
import { describe, expect, test } from "vitest";
import { root } from "../../test/support.js";
import { colourOf } from "../../player/words.js";
import { labelsOf } from "../src/table/drawing.js";
import { GAMES } from "../src/table/games.js";
import { GERMAN } from "../src/texts/de.js";
import { ENGLISH } from "../src/texts/en.js";

const source = `${root}web/page/src/`;
const read = (path: string): string => readFileSync(path, "utf8");
const files = readdirSync(source, { recursive: true, encoding: "utf8" }).filter(
  (name) => name.endsWith(".ts") && !name.startsWith("texts"),
);

/** What a text is that is given marks as its parts, and which of them it has. */
function shown(text: unknown): string[] {
  if (typeof text !== "function") return [];
  const marks = Array.from({ length: text.length }, (_, k) => `<${k}>`);
  const filled = (text as (...parts: string[]) => string)(...marks);
  return marks.filter((mark) => filled.includes(mark));
}

/** Strings that no reader sees: markup, classes, fonts, names of keys, media queries. */
const TECHNICAL =
  /^(<|bold |translate|\(pointer|\(prefers|#|\.|(row|panel|numbers|error) [a-z-]+$|carom |(Enter|Escape|Tab|Files|Arrow\w+)$)/;
const UNITS = /\b(m\/s|rad\/s|mJ|N s|cm|mm|ms|px|m|s|R)\b/g;
/** Names of the library, which told() translates, and the page's own name. */
const NAMES = ["red …", "… pocket", " carom …."];
/** Whether a string is a word or a sentence for a reader. */
function isForReaders(text: string): boolean {
  if (TECHNICAL.test(text) || NAMES.includes(text) || text.includes("#view=")) return false;
  const bare = text.replaceAll(UNITS, "").replaceAll("…", " ");
  if (/^[A-Z][a-z]+/.test(bare)) return true;
  return /[a-z]{2}/i.test(bare) && /[a-z,:] +[a-z…]/i.test(bare);
}
/** The sentences of a file, with their lines. */
function sentencesOf(name: string): string[] {
  const tree = ts.createSourceFile(name, read(source + name), ts.ScriptTarget.Latest, true);
  const found: string[] = [];
  function visit(node: ts.Node): void {
    if (ts.isImportDeclaration(node) || ts.isTypeNode(node)) return;
    // What a browser's console says is for programmers.
    if (ts.isCallExpression(node) && node.expression.getText().startsWith("console.")) return;
    let parts: string[] = [];
    if (ts.isStringLiteralLike(node)) parts = [node.text];
    if (ts.isTemplateExpression(node))
      parts = [node.head.text, ...node.templateSpans.map(({ literal }) => literal.text)];
    if (parts.length > 0 && isForReaders(parts.join("…"))) {
      const { line } = tree.getLineAndCharacterOfPosition(node.getStart());
      found.push(`${name}:${line + 1}: ${parts.join("…")}`);
    }
    ts.forEachChild(node, visit);
  }
  visit(tree);
  return found;
}

describe("the texts of the page", () => {
  test("each text is there in each language, with the same parts", () => {
    const english = ENGLISH as Record<string, unknown>;
    const german = GERMAN as Record<string, unknown>;
    expect(Object.keys(german).sort()).toEqual(Object.keys(english).sort());
    for (const [key, text] of Object.entries(english)) {
      expect(typeof german[key], key).toBe(typeof text);
      expect(shown(german[key]), key).toEqual(shown(text));
    }
  });

  test("a text of the files is used", () => {
    const sources = [
      ...files.map((name) => read(source + name)),
      read(`${source}../index.html`),
    ].join();
    const unused = Object.keys(ENGLISH).filter(
      (key) => !new RegExp(`texts\\.${key}\\b|data-text="${key}"`).test(sources),
    );
    expect(unused.filter((key) => key !== "known")).toEqual([]);
  });

  test("no sentence stands outside of the files of texts", () => {
    expect(isForReaders("The link is copied.")).toBe(true);
    expect(isForReaders("… balls were played")).toBe(true);
    expect(isForReaders("pointerdown")).toBe(false);
    expect(files.flatMap(sentencesOf)).toEqual([]);
  });

  test("texts of the page's frame are those of English", () => {
    const frame = read(`${source}../index.html`);
    const texts = ENGLISH as unknown as Record<string, string>;
    const named = [...frame.matchAll(/data-text="(\w+)"\s*>([^<]*)</g)];
    expect(named.length).toBeGreaterThan(5);
    for (const [, key = "", text = ""] of named)
      expect(text.trim().replaceAll(/\s+/g, " "), key).toBe(texts[key]);
    const others = [...frame.matchAll(/<(\w+)([^>]*)>\s*(\w[^<]*)</g)].filter(
      ([, tag = "", attributes = ""]) =>
        !attributes.includes("data-text") && tag !== "title" && tag !== "h1",
    );
    expect(others.map(([text]) => text)).toEqual([]);
  });

  test("each game of the library has its rules", () => {
    for (const [game] of words.rules.filter(([rule]) => rule !== "potting"))
      for (const texts of [ENGLISH, GERMAN])
        expect(texts.rules[game]?.length, game).toBeGreaterThan(100);
  });

  test("labels tell balls of different colours apart in each game and language", () => {
    for (const [game, { rack, names }] of Object.entries(GAMES))
      for (const { letters } of [ENGLISH, GERMAN]) {
        const ballNames = Array.from({ length: 22 }, (_, k) => names(k));
        const labels = labelsOf(ballNames, letters);
        const colours = new Map<string, string>();
        labels.forEach((label, k) => {
          const colour = colourOf(ballNames[k]!, k, game === "pyramid" ? 0.034 : 0.03);
          const isNumber = Number(label) > 0;
          if (label !== "" && !isNumber)
            expect(colours.get(label) ?? colour, `${game} (${rack}): ${label}`).toBe(colour);
          colours.set(label, colour);
          // The cue ball of pool is the only one that is white.
          if (label === "") expect(ballNames[k]).toBe("cue");
        });
      }
    expect(labelsOf(["red 3", "7"], {})).toEqual(["", "7"]);
  });

  test("German has words for all drills", () => {
    const rows = read(`${root}data/drills.csv`).trim().split("\n").slice(1);
    for (const row of rows) {
      const [, name = "", quoted, plain] = /^([^,]*),(?:"([^"]*)"|([^,]*)),/.exec(row)!;
      expect(GERMAN.known[name], name).toBeDefined();
      expect(GERMAN.known[quoted ?? plain!], name).toBeDefined();
    }
  });
});
