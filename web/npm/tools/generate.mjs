// generate.mjs MADE OUT BUILDS...: what the build knows, as TypeScript: structs and enumerators of
// the headers, numbers of a ball, and the modules of BUILDS. bindings/README.md says what
// MADE/api.json and MADE/rows.json have.
import { readdirSync, readFileSync, writeFileSync } from "node:fs";

const [build, out, ...builds] = process.argv.slice(2);
const api = JSON.parse(readFileSync(`${build}/api.json`, "utf8"));
const rows = JSON.parse(readFileSync(`${build}/rows.json`, "utf8"));
const camel = (name) => name.replace(/_([a-z0-9])/g, (_, letter) => letter.toUpperCase());
const pascal = (name) => camel(name.replace(/^carom/, ""));
const note = "// Written by tools/generate.mjs from the headers and rows of the C library.\n";

// The package gets the layouts and values that its sources name, and enumerations that it looks
// names up in.
const sources = [...readdirSync("src"), "generated/match.ts"]
  .filter((name) => name.endsWith(".ts"))
  .map((name) => readFileSync(`src/${name}`, "utf8"))
  .join("");
const isNamed = (name) => new RegExp(`\\b${name}\\b`).test(sources);
const byName = new Map(api.structs.map((struct) => [struct.name, struct]));

/**
 * What a field is made of: numbers of 64 or 32 bits, another struct, or nothing that is converted.
 */
function kindOf({ name, type, pointer }) {
  if (pointer || /^(reserved|unused|opaque)$/.test(name)) return "";
  if (byName.has(type)) return type;
  if (api.enums.some((enumeration) => enumeration.name === type)) return "i32";
  return { double: "f64", int64_t: "i64", int32_t: "i32", int: "i32" }[type] ?? "";
}
/** The structs that the sources name, and those in them. */
const needed = new Set();
function want(name) {
  if (needed.has(name)) return;
  needed.add(name);
  for (const { type, pointer } of byName.get(name).fields)
    if (byName.has(type) && !pointer) want(type);
}
api.structs.filter(({ name }) => isNamed(name)).forEach(({ name }) => want(name));
const structs = {};
for (const { name, fields, wasm32 } of api.structs.filter(({ name }) => needed.has(name))) {
  const keys = fields.map((field) => camel(field.name));
  const numbers = (list) => Object.fromEntries(keys.map((key, k) => [key, list[k]]));
  structs[name] = {
    size: wasm32.size,
    offset: numbers(wasm32.offsets),
    bytes: numbers(wasm32.sizes),
    type: numbers(fields.map(kindOf)),
  };
}
const enumerators = [
  ...api.enums.flatMap((enumeration) => enumeration.values),
  ...api.constants,
].filter(({ name, value }) => Number.isInteger(value) && isNamed(name));
const values = Object.fromEntries(
  enumerators.sort((a, b) => (a.name < b.name ? -1 : 1)).map(({ name, value }) => [name, value]),
);

/** The words of an enumeration, or else the ends of its names: ["stationary", "spinning", ...]. */
const worded = new Map(
  api.enums
    .filter(({ name }) => name === "carom_words")
    .flatMap(({ values }) => values)
    .map(({ name, comment }) => [name.replace("CAROM_WORDS_", ""), comment.match(/carom_\w+/)[0]]),
);
const words = new Map(
  Object.entries(rows.words).map(([group, list]) => [
    worded.get(group),
    list.map(([word]) => word),
  ]),
);
function names({ name, values }) {
  if (words.has(name)) return words.get(name);
  let common = values[0].name;
  while (!values.every(({ name }) => name.startsWith(common))) common = common.slice(0, -1);
  common = common.slice(0, common.lastIndexOf("_") + 1);
  return values.map(({ name }) => name.slice(common.length).toLowerCase());
}
const enums = Object.fromEntries(
  api.enums.map((enumeration) => [enumeration.name, names(enumeration)]),
);

/**
 * The options of calls and the numbers of a ball's cushions; the package has neither threads nor
 * instruction sets.
 */
const options = {};
for (const [struct, list] of Object.entries(rows.options)) {
  const numbers = rows.numbers
    .filter(({ of_cushion }) => of_cushion && struct === "carom_cushion_options")
    .map((number) => ({ ...number, form: "number" }));
  options[struct] = [...list, ...numbers]
    .filter(({ name }) => name !== "threads" && name !== "plain")
    .map((option) => ({
      ...option,
      key: camel(option.name),
      enumeration: option.words ? worded.get(option.words) : "",
    }));
}

/**
 * The enumerations whose names the package looks up, by their values: "" is none; those of sets, by
 * their bits.
 */
const lookups = new Set(
  Object.values(options)
    .flat()
    .map(({ enumeration }) => enumeration),
);
const named = Object.fromEntries(
  api.enums
    .filter(
      ({ name }) => lookups.has(name) || new RegExp(`(names\\.|")${name}\\b`, "i").test(sources),
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
const translated = (comment) =>
  comment
    .replace(/\b[a-z]+(_[a-z]+)+\b/g, (name) => (known.has(name) ? camel(name) : name))
    .replaceAll("*/", "");
const comment = (text, indent) => (text ? `${indent}/** ${translated(text)} */\n` : "");
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
for (const struct of api.structs.filter(({ name }) => !(name in options))) {
  const fields = struct.fields.filter(
    (field) => !/^(reserved|unused|opaque)$/.test(field.name) && typeOf(field),
  );
  const lines = fields.map(
    (field) => `${comment(field.comment, "  ")}  ${camel(field.name)}: ${typeOf(field)};\n`,
  );
  types += `\n${comment(struct.comment, "")}export interface ${pascal(struct.name)} {\n${lines.join("")}}\n`;
}

/** The type of an option by its form. */
function typeOfOption({ form, enumeration }) {
  if (form === "words") return pascal(enumeration);
  if (form === "set")
    return enumeration
      ? `"contact" | ${pascal(enumeration)} | readonly ("contact" | ${pascal(enumeration)})[]`
      : "number | readonly number[]";
  return form === "flag" ? "boolean" : "number";
}
const optionLines = (list) =>
  list
    .map(
      (option) =>
        `${comment(/words|set/.test(option.form) ? option.text : `${option.text}; ${option.range}`, "  ")}  ${option.key}?: ${typeOfOption(option)};\n`,
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
    list.map(({ key, form, enumeration, group }) => ({
      key,
      form,
      enumeration,
      stop: group === "stop",
    })),
  ]),
);
writeFileSync(
  `${out}/words.ts`,
  `${note}/** The words of each enumeration that options and lines take, in the order of its values, with what each is: for choices of a page. */\n` +
    `export const words = ${JSON.stringify(Object.fromEntries(Object.entries(rows.words).map(([group, list]) => [camel(group.toLowerCase()), list])), null, 1)} as const;\n`,
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
  const text = builds.includes(name)
    ? `const module: string = ${JSON.stringify(readFileSync(`${build}/${name}.wasm.gz`).toString("base64"))};\n`
    : `const module: string = "";\nthrow new Error("carom: this package was made without the build '${name}'; web/npm/build makes all builds");\n`;
  writeFileSync(`${out}/${name}.ts`, `${note}${text}export default module;\n`);
}
