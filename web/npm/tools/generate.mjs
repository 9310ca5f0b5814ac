// generate.mjs MADE OUT: what the build knows, as TypeScript: structs and enumerators of the
// headers, numbers of a ball, both modules. bindings/README.md says what MADE/api.json and
// MADE/rows.json have.
import { readdirSync, readFileSync, writeFileSync } from "node:fs";

const [made, out] = process.argv.slice(2);
const api = JSON.parse(readFileSync(`${made}/api.json`, "utf8"));
const rows = JSON.parse(readFileSync(`${made}/rows.json`, "utf8"));
const camel = (name) => name.replace(/_([a-z0-9])/g, (_, letter) => letter.toUpperCase());
const pascal = (name) => camel(name.replace(/^carom/, ""));
const note = "// Written by tools/generate.mjs from the headers and rows of the C library.\n";

// The package gets the layouts and values that its sources name, and enumerations that it looks
// names up in.
const sources = readdirSync("src")
  .filter((name) => name.endsWith(".ts"))
  .map((name) => readFileSync(`src/${name}`, "utf8"))
  .join("");
const isNamed = (name) => new RegExp(`\\b${name}\\b`).test(sources);
const byName = new Map(api.structs.map((one) => [one.name, one]));

/**
 * What a field is made of: numbers of 64 or 32 bits, another struct, or nothing that is converted.
 */
function kindOf({ name, type, pointer }) {
  if (pointer || /^(reserved|unused|opaque)$/.test(name)) return "";
  if (byName.has(type)) return type;
  if (api.enums.some((one) => one.name === type)) return "i32";
  return { double: "f64", int64_t: "i64", int32_t: "i32", int: "i32" }[type] ?? "";
}
/** The structs that the sources name, and those in them. */
const wanted = new Set();
function want(name) {
  if (wanted.has(name)) return;
  wanted.add(name);
  for (const { type, pointer } of byName.get(name).fields)
    if (byName.has(type) && !pointer) want(type);
}
api.structs.filter(({ name }) => isNamed(name)).forEach(({ name }) => want(name));
const structs = {};
for (const { name, fields, wasm32 } of api.structs.filter(({ name }) => wanted.has(name))) {
  const keys = fields.map((field) => camel(field.name));
  const numbers = (list) => Object.fromEntries(keys.map((key, k) => [key, list[k]]));
  structs[name] = {
    size: wasm32.size,
    offset: numbers(wasm32.offsets),
    bytes: numbers(wasm32.sizes),
    type: numbers(fields.map(kindOf)),
  };
}
const enumerators = [...api.enums.flatMap((one) => one.values), ...api.constants].filter(
  ({ name, value }) => Number.isInteger(value) && isNamed(name),
);
const values = Object.fromEntries(
  enumerators.sort((a, b) => (a.name < b.name ? -1 : 1)).map(({ name, value }) => [name, value]),
);

/** The words of an enumeration, or else the ends of its names: ["stationary", "spinning", ...]. */
const worded = new Map(
  api.enums
    .find(({ name }) => name === "carom_words")
    .values.map(({ name, comment }) => [
      name.replace("CAROM_WORDS_", ""),
      comment.match(/carom_\w+/)[0],
    ]),
);
const words = new Map(
  Object.entries(rows.words).map(([of, list]) => [worded.get(of), list.map(([word]) => word)]),
);
function names({ name, values }) {
  if (words.has(name)) return words.get(name);
  let common = values[0].name;
  while (!values.every(({ name }) => name.startsWith(common))) common = common.slice(0, -1);
  common = common.slice(0, common.lastIndexOf("_") + 1);
  return values.map(({ name }) => name.slice(common.length).toLowerCase());
}
const enums = Object.fromEntries(api.enums.map((one) => [one.name, names(one)]));

/**
 * The options of calls and the numbers of a ball's cushions; the package has neither threads nor
 * instruction sets.
 */
const options = {};
for (const [struct, list] of Object.entries(rows.options)) {
  const numbers = rows.numbers
    .filter(({ of_cushion }) => of_cushion && struct === "carom_cushion_options")
    .map((one) => ({ ...one, form: "number" }));
  options[struct] = [...list, ...numbers]
    .filter(({ name }) => name !== "threads" && name !== "plain")
    .map((one) => ({ ...one, key: camel(one.name), of: one.words ? worded.get(one.words) : "" }));
}

/**
 * The enumerations whose names the package looks up, by their values: "" is none; those of sets, by
 * their bits.
 */
const asked = new Set(
  Object.values(options)
    .flat()
    .map(({ of }) => of),
);
const named = Object.fromEntries(
  api.enums
    .filter(
      ({ name }) => asked.has(name) || new RegExp(`(names\\.|")${name}\\b`, "i").test(sources),
    )
    .map(({ name, values }) => {
      if (values.length > 2 && values.every(({ value }, k) => value === 1 << k))
        return [name, enums[name]];
      const [{ value: first }] = values;
      if (values.some(({ value }, k) => value !== first + k))
        throw new Error(`${name}: its values are not ${first}, ${first + 1}, ...`);
      return [name, [...Array(first).fill(""), ...enums[name]]];
    }),
);

// Comments speak of fields; these have their names in TypeScript.
const known = new Set(api.structs.flatMap(({ fields }) => fields.map(({ name }) => name)));
const said = (comment) =>
  comment
    .replace(/\b[a-z]+(_[a-z]+)+\b/g, (name) => (known.has(name) ? camel(name) : name))
    .replaceAll("*/", "");
const comment = (text, indent) => (text ? `${indent}/** ${said(text)} */\n` : "");
const isEnum = new Set(api.enums.map(({ name }) => name));
const isStruct = new Set(api.structs.map(({ name }) => name));

function typeOf({ type, array = [], pointer }) {
  if (pointer) return undefined;
  const [length] = array;
  if (isStruct.has(type)) return length ? `${pascal(type)}[]` : pascal(type);
  if (isEnum.has(type)) return pascal(type);
  if (length === undefined) return "number";
  return length === 2 || length === 3 ? `Vec${length}` : "number[]";
}
let types = `${note}import type { Vec2, Vec3 } from "../types.js";\n`;
for (const [name, ends] of Object.entries(enums))
  types += `\nexport type ${pascal(name)} = ${ends.map((end) => `"${end}"`).join(" | ")};\n`;
for (const one of api.structs.filter(({ name }) => !(name in options))) {
  const fields = one.fields.filter(
    (field) => !/^(reserved|unused|opaque)$/.test(field.name) && typeOf(field),
  );
  const lines = fields.map(
    (field) => `${comment(field.comment, "  ")}  ${camel(field.name)}: ${typeOf(field)};\n`,
  );
  types += `\n${comment(one.comment, "")}export interface ${pascal(one.name)} {\n${lines.join("")}}\n`;
}

/** The type of an option by its form. */
function typeOfOption({ form, of }) {
  if (form === "words") return pascal(of);
  if (form === "set")
    return of
      ? `"contact" | ${pascal(of)} | readonly ("contact" | ${pascal(of)})[]`
      : "number | readonly number[]";
  return form === "flag" ? "boolean" : "number";
}
const optionLines = (list) =>
  list
    .map(
      (one) =>
        `${comment(/words|set/.test(one.form) ? one.text : `${one.text}; ${one.range}`, "  ")}  ${one.key}?: ${typeOfOption(one)};\n`,
    )
    .join("");
const [toStop, others] = [true, false].map((stop) =>
  options.carom_shot_options.filter(({ group }) => (group === "stop") === stop),
);
types += `\n/** When a shot is stopped. */\nexport interface StopOptions {\n${optionLines(toStop)}}\n`;
for (const [struct, list] of Object.entries(options)) {
  const shot = struct === "carom_shot_options";
  types += `\n${comment(byName.get(struct).comment, "")}export interface ${pascal(struct)} ${shot ? "extends StopOptions " : ""}{\n${optionLines(shot ? others : list)}}\n`;
}
writeFileSync(`${out}/structs.ts`, types);

/** Numbers of structs: the key in lines, and the field. */
const numbers = Object.fromEntries(
  ["carom_ball_kind", "carom_cue", "carom_table"].map((struct) => [
    struct,
    (rows.parts[struct] ?? rows.numbers)
      .map(({ key, name }) => [key, camel(name)])
      .filter(([key]) => key),
  ]),
);
const layoutOptions = Object.fromEntries(
  Object.entries(options).map(([struct, list]) => [
    struct,
    list.map(({ key, form, of, group }) => ({ key, form, of, stop: group === "stop" })),
  ]),
);
writeFileSync(
  `${out}/words.ts`,
  `${note}/** The words of each enumeration that options and lines take, in the order of its values, with what each is: for choices of a page. */\n` +
    `export const words = ${JSON.stringify(Object.fromEntries(Object.entries(rows.words).map(([of, list]) => [camel(of.toLowerCase()), list])), null, 1)} as const;\n`,
);
writeFileSync(
  `${out}/layout.ts`,
  `${note}/** Sizes of the structs in bytes; offsets, sizes and types of their fields. */\n` +
    `export const layout = ${JSON.stringify(structs, null, 1)} as const;\n` +
    `/** Values of the enumerators. */\nexport const values = ${JSON.stringify(values, null, 1)} as const;\n` +
    `/** Numbers of a ball, a cue and a table: the key in lines, and the field. */\nexport const numbers = ${JSON.stringify(numbers)} as const;\n` +
    `/** Options of calls: their form, the enumeration of their words, and whether they say when a shot is stopped. */\nexport const options = ${JSON.stringify(layoutOptions)} as const;\n` +
    `/** The games that plans and rulings know. */\nexport const games = ${JSON.stringify(rows.games)} as const;\n` +
    `/** Words or names of enumerators, by their values. */\nexport const names = ${JSON.stringify(named, null, 1)} as const;\n`,
);
for (const name of ["plain", "simd"]) {
  // The type is written out: else the declarations would have the module once more.
  writeFileSync(
    `${out}/${name}.ts`,
    `${note}const module: string = ${JSON.stringify(readFileSync(`${made}/${name}.wasm.gz`).toString("base64"))};\nexport default module;\n`,
  );
}
