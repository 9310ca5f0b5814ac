// Every row of words, options and numbers, as bindings/rows.py reads them, is one of the package:
// what it takes, and how it refuses the rest.
import { readFileSync } from "node:fs";
import { expect, test } from "vitest";
import { type BallKind, fromLine, toLine, words } from "../dist/index.js";
import { carom, refuses, root } from "./support.js";

interface Row {
  name: string;
  key: string;
  form: string;
  words: string | null;
  range: string;
  of_cushion: boolean;
}
interface Rows {
  numbers: Row[];
  options: Record<string, Row[]>;
  parts: Record<string, Row[]>;
  words: Record<string, [string, string][]>;
}
const rows = JSON.parse(readFileSync(`${root}build/web/rows.json`, "utf8")) as Rows;
const camel = (name: string) =>
  name.replace(/_([a-z0-9])/g, (_, letter: string) => letter.toUpperCase());
const table = carom.table("9ft");
const balls = [carom.ball(0.5, 0.5), carom.ball(0.6, 1.5)];
const impact = { v: [0, 1, 0], normal: [0, 1] } as const;
const calls: Record<string, (options: object) => unknown> = {
  carom_shot_options: (options) => carom.simulate(table, balls, { speed: 1 }, options),
  carom_options: (options) =>
    carom.collide({ a: { v: [1, 0, 0] }, b: { r: [0.057, 0, 0] } }, options),
  carom_cushion_options: (options) => carom.cushion(impact, options),
  carom_plan_options: (options) =>
    carom.plan(table, balls, { rules: "potting", shots: 100, best: 1, ...options }),
};
const options = Object.entries(calls).flatMap(([struct, call]) =>
  rows.options[struct]!.filter(({ name }) => name !== "threads" && name !== "plain").map((row) => ({
    ...row,
    struct,
    call,
    key: camel(row.name),
  })),
);

test.each(options)("option $key of $struct", ({ key, form, words, call }) => {
  const known = words === null ? [] : rows.words[words]!.map(([word]) => word);
  const good: Partial<Record<string, unknown>> = { set: [1], number: 0.5, flag: 1 };
  for (const value of words === null ? [good[form] ?? 100] : known) call({ [key]: value });
  for (const wrong of ["no such word", form === "number" ? NaN : -1.5])
    expect(() => call({ [key]: wrong })).toThrow(
      Number.isNaN(wrong) ? /./ : `${key}: ${words === null ? "it must be" : "unknown name"}`,
    );
  expect(() => call({ [`${key}x`]: 1 })).toThrow("there is no such key; did you mean");
});

test.each(rows.numbers.map((row) => ({ ...row, field: camel(row.name) as keyof BallKind })))(
  "number $name of a ball",
  ({ field, key, of_cushion, range }) => {
    expect(carom.kind("pool")[field]).toBeTypeOf("number");
    expect(() =>
      carom.simulate(table, [{ ...balls[0]!, kind: { ...balls[0]!.kind, [field]: NaN } }]),
    ).toThrow(`balls[0].kind.${field}: it must be ${range}, not NaN`);
    // In a line it is as it was.
    const kind = { ...balls[0]!.kind, [field]: 0.125 };
    const line = toLine({ tableName: "9ft", balls: [{ ...balls[0]!, kind }], cue: carom.cue() });
    expect((JSON.parse(line) as { balls: { params: object }[] }).balls[0]!.params).toHaveProperty(
      [key],
      0.125,
    );
    expect(fromLine(carom, line).balls[0]!.kind).toEqual(kind);
    if (of_cushion) {
      expect(carom.cushion(impact, { model: "han", [field]: 0 })).toEqual(
        carom.cushion(impact, { model: "han" }),
      );
      expect(() => carom.cushion(impact, { [field]: NaN })).toThrow();
    }
  },
);

test.each(
  rows.parts
    .carom_cue!.filter(({ name }) => name !== "ball")
    .map((row) => ({ ...row, field: camel(row.name) })),
)("number $name of a cue", ({ field, key, range }) => {
  // The tip is checked with its place on the ball, and its radius by nobody.
  if (field !== "tipRadius")
    expect(() => carom.simulate(table, balls, { [field]: NaN })).toThrow(
      field.length === 1
        ? /^cue.a, cue.b: the tip misses/
        : `cue.${field}: it must be ${range}, not NaN`,
    );
  const cue = { ...carom.cue(), [field]: 0.25 };
  const line = toLine({ tableName: "9ft", balls, cue });
  expect((JSON.parse(line) as { cue: object }).cue).toHaveProperty([key], 0.25);
  expect(fromLine(carom, line).cue).toEqual(cue);
});

test.each(
  ["rail", "jaw", "pocket"].flatMap((part) =>
    rows.parts[`carom_${part}`]!.map((row) => ({ ...row, part, field: camel(row.name) })),
  ),
)("number $name of a $part", ({ part, field, range }) => {
  const wrong = structuredClone(table) as unknown as Record<
    string,
    Record<string, number | number[]>[]
  >;
  const ball = wrong[`${part}s`]![1]!;
  const invalid = field === "side" ? 7 : NaN;
  ball[field] = Array.isArray(ball[field]) ? ball[field].map(() => invalid) : invalid;
  expect(() => carom.simulate(wrong as never, balls)).toThrow(
    `table.${part}s[1].${field}: it must be ${range}, not ${invalid}`,
  );
});

test("three banks find the cushions of a table, and conditions are named", () => {
  const table = carom.table("9ft");
  const usual = carom.calibrate(undefined, table);
  const [a, b, c] = usual.comesBack as unknown as [number, number, number];
  const found = carom.calibrate([a, b, c], table);
  expect(found.restitution).toBeCloseTo(carom.kind("pool").restitutionCushion, 6);
  expect(found.friction).toBeCloseTo(carom.kind("pool").muCushion, 6);
  expect(found.misfit).toBeLessThan(1e-6);
  expect(carom.bank(0).aim).toBe(2.5);
  refuses(
    [() => carom.bank(3), "bank 3"],
    [() => carom.calibrate([4.7, 5.6, 8.5], table), "below 8, not 4.7, 5.6, 8.5"],
  );
  for (const [condition] of rows.words.CONDITION!)
    expect(carom.kind("pool", "default", [condition as "fast_cloth"]).radius).toBeGreaterThan(0);
  const slow = carom.kind("pool", "default", ["slow_cloth", "old_cushion"]);
  expect([slow.muRoll, slow.restitutionCushion]).toEqual([0.015, 0.75]);
  refuses(
    [() => carom.kind("pool", "default", ["felt" as never]), 'conditions: unknown name "felt"'],
    [() => carom.kind("snooker", "default", ["fast_cloth"]), "pool tables, not to snooker"],
  );
});

test("words of games, tables and racks", () => {
  expect(Object.entries(words)).toEqual(
    Object.entries(rows.words).map(([group, list]) => [camel(group.toLowerCase()), list]),
  );
  for (const [game] of rows.words.GAME!)
    expect(carom.kind(game as "pool").radius).toBeGreaterThan(0);
  for (const [name] of rows.words.TABLE!)
    expect(carom.table(name as "9ft").length).toBeGreaterThan(1);
  for (const [name] of rows.words.RACK!)
    expect(
      carom.rack(
        name as "nineball",
        carom.table(name === "snooker" || name === "threecushion" ? name : "9ft"),
      ).length,
    ).toBeGreaterThan(2);
});
