// generate.mjs MADE OUT: what the build knows, as TypeScript: the layout of the structs, the values of the enumerators, both modules.
import { readFileSync, writeFileSync } from "node:fs";

const [made, out] = process.argv.slice(2);
const camel = (name) => name.replace(/_([a-z0-9])/g, (_, letter) => letter.toUpperCase());

const structs = {};
const values = {};
let struct;
for (const line of readFileSync(`${made}/abi.txt`, "utf8").split("\n")) {
  let match;
  if ((match = /^(carom_\w+): (\d+) bytes/.exec(line))) {
    struct = structs[match[1]] = { size: Number(match[2]), offset: {}, bytes: {} };
  } else if ((match = /^ +(\d+) (\w+): (\d+)$/.exec(line))) {
    struct.offset[camel(match[2])] = Number(match[1]);
    struct.bytes[camel(match[2])] = Number(match[3]);
  } else if ((match = /^(CAROM_\w+) = (-?\d+)$/.exec(line))) {
    values[match[1]] = Number(match[2]);
  } else if (line !== "") {
    throw new Error(`${made}/abi.txt: a line that is neither a struct, a field nor a value: ${line}`);
  }
}
const note = "// Written by tools/generate.mjs from the headers of the C library.\n";
writeFileSync(
  `${out}/layout.ts`,
  `${note}/** Sizes of the structs in bytes; offsets and sizes of their fields. */\nexport const layout = ${JSON.stringify(structs, null, 1)} as const;\n` +
    `/** Values of the enumerators. */\nexport const values = ${JSON.stringify(values, null, 1)} as const;\n`,
);
for (const name of ["plain", "simd"])
  writeFileSync(`${out}/${name}.ts`, `${note}export default ${JSON.stringify(readFileSync(`${made}/${name}.wasm`).toString("base64"))};\n`);
