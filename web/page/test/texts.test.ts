// The texts of the page: each language has each text, with the same parts, and no sentence stands
// outside of the files of texts.
import { words } from "carom";
import { readdirSync, readFileSync } from "node:fs";
import ts from "typescript";
import { describe, expect, test } from "vitest";
import { root } from "../../test/support.js";
import { colourOf } from "../../player/words.js";
import { labelsOf } from "../src/table/drawing.js";
import { GAMES, PLAYED } from "../src/table/games.js";
import { type Language, LANGUAGES, partsOf, textsOf } from "../src/texts/texts.js";

const source = `${root}web/page/src/`;
const ENGLISH = LANGUAGES.en;
const LANGUAGE_CODES = Object.keys(LANGUAGES) as Language[];
const read = (path: string) => readFileSync(path, "utf8");
const files = readdirSync(source, { recursive: true, encoding: "utf8" }).filter(
  (name) => name.endsWith(".ts") && !name.startsWith("texts"),
);

/** Strings that no reader sees: markup, classes, fonts, shaders, names of keys, media queries. */
const TECHNICAL =
  /^(<|bold |700 …px |\s*(attribute|uniform|varying|vec3) |translate|\(pointer|\(prefers|#|\.|(row|panel|numbers|error) [a-z-]+$|carom |(Enter|Escape|Tab|Files|Arrow\w+)$)/;
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
/** A file of the page as a tree, and where a node of it is. */
const treeOf = (name: string) =>
  ts.createSourceFile(name, read(source + name), ts.ScriptTarget.Latest, true);
function placeOf(node: ts.Node): string {
  const tree = node.getSourceFile();
  return `${tree.fileName}:${tree.getLineAndCharacterOfPosition(node.getStart()).line + 1}`;
}
/** The sentences of a file, with their lines. */
function sentencesOf(name: string): string[] {
  const found: string[] = [];
  function visit(node: ts.Node): void {
    if (ts.isImportDeclaration(node) || ts.isTypeNode(node)) return;
    // What a browser's console says is for programmers.
    if (ts.isCallExpression(node) && node.expression.getText().startsWith("console.")) return;
    let parts: string[] = [];
    if (ts.isStringLiteralLike(node)) parts = [node.text];
    if (ts.isTemplateExpression(node))
      parts = [node.head.text, ...node.templateSpans.map(({ literal }) => literal.text)];
    if (parts.length > 0 && isForReaders(parts.join("…")))
      found.push(`${placeOf(node)}: ${parts.join("…")}`);
    ts.forEachChild(node, visit);
  }
  visit(treeOf(name));
  return found;
}
/** The calls of a file that hand over more or fewer parts than the text names. */
function wrongCallsOf(name: string): string[] {
  const found: string[] = [];
  function visit(node: ts.Node): void {
    if (ts.isCallExpression(node) && node.expression.getText().startsWith("texts.")) {
      const key = node.expression.getText().slice("texts.".length);
      const text = (ENGLISH.filled as Record<string, string>)[key]!;
      if (node.arguments.length !== partsOf(text).length)
        found.push(`${placeOf(node)}: ${node.getText()} for "${text}"`);
    }
    ts.forEachChild(node, visit);
  }
  visit(treeOf(name));
  return found;
}

describe("the texts of the page", () => {
  test.each(LANGUAGE_CODES)("each text is there, with the parts of the English one: %s", (code) => {
    for (const section of ["plain", "filled"] as const) {
      const texts: Record<string, string> = LANGUAGES[code][section];
      const english: Record<string, string> = ENGLISH[section];
      expect(Object.keys(texts)).toEqual(Object.keys(english));
      for (const [key, text] of Object.entries(english)) {
        expect(texts[key], key).not.toBe("");
        expect(partsOf(texts[key]!).sort(), key).toEqual(partsOf(text).sort());
        expect(partsOf(text).length > 0, key).toBe(section === "filled");
      }
    }
  });

  test("parts are filled in, and choose words", () => {
    const [english, german] = LANGUAGE_CODES.map(textsOf);
    expect(english!.ballsCounted(1)).toBe("1 ball");
    expect(english!.ballsCounted(2)).toBe("2 balls");
    expect(english!.bestStrokeOf(true, "Ann", "a break")).toBe("Your best shot: a break.");
    expect(english!.bestStrokeOf(false, "Ann", "a {name}")).toBe("Ann's best shot: a {name}.");
    expect(german!.bestStrokeOf(false, "Ann", "ein Anstoß")).toBe(
      "Bester Stoß von Ann: ein Anstoß.",
    );
  });

  test("a call hands over the parts of its text", () => {
    expect(files.flatMap(wrongCallsOf)).toEqual([]);
  });

  test("a text of the files is used", () => {
    const sources = [
      ...files.map((name) => read(source + name)),
      read(`${source}../index.html`),
    ].join();
    const { plain, filled } = ENGLISH;
    const unused = Object.keys({ ...plain, ...filled }).filter(
      (key) => !new RegExp(`texts\\.${key}\\b|data-text="${key}"`).test(sources),
    );
    expect(unused).toEqual([]);
  });

  test("no sentence stands outside of the files of texts", () => {
    expect(isForReaders("The link is copied.")).toBe(true);
    expect(isForReaders("… balls were played")).toBe(true);
    expect(isForReaders("pointerdown")).toBe(false);
    expect(files.flatMap(sentencesOf)).toEqual([]);
  });

  test("texts of the page's frame are those of English", () => {
    const frame = read(`${source}../index.html`);
    const texts: Record<string, string> = ENGLISH.plain;
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

  test("each game of the page has its rules, and a line on its card", () => {
    for (const game of Object.keys(PLAYED))
      for (const texts of Object.values(LANGUAGES))
        for (const [list, least, most] of [
          [texts.rules, 100, 600],
          [texts.cards, 10, 45],
        ] as const) {
          expect(list[game]?.length, game).toBeGreaterThan(least);
          expect(list[game]!.length, game).toBeLessThan(most);
        }
  });

  test("labels tell balls of different colours apart in each game and language", () => {
    for (const [game, { rack, names }] of Object.entries(GAMES))
      for (const { letters } of Object.values(LANGUAGES)) {
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

  test("each foul of the library is told in plain words", () => {
    for (const [foul, text] of words.foul)
      for (const { known } of [LANGUAGES.en, LANGUAGES.de] as { known: Record<string, string> }[])
        if (text !== "") expect(known[text], foul).toMatch(/^\D{5,60}$/);
  });

  test("German has words for all drills", () => {
    const rows = read(`${root}data/drills.csv`).trim().split("\n").slice(1);
    for (const row of rows) {
      const [, name = "", quoted, plain] = /^([^,]*),(?:"([^"]*)"|([^,]*)),/.exec(row)!;
      expect(LANGUAGES.de.known[name], name).toBeDefined();
      expect(LANGUAGES.de.known[quoted ?? plain!], name).toBeDefined();
    }
  });
});
