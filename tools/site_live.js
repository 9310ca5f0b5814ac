/*
 * Runs the program of an example's page in that page, by the npm package of web/ as WebAssembly. A
 * reader may change the text before.
 * `carom` is the package in one file, so pages run from a folder of files as from a server. */
const AsyncFunction = (async () => {}).constructor;
const code = document.querySelector(".language-js code");
const output = document.querySelector("#live-output");

/** A picture that a program writes is shown below what it prints. */
function writeFileSync(name, text) {
  const picture = new Image();
  picture.alt = name;
  picture.src = `data:image/svg+xml,${encodeURIComponent(text)}`;
  output.after(picture);
}

const modules = { carom, "node:fs": { writeFileSync } };
function need(name) {
  if (!(name in modules))
    throw new Error(`a page has no module "${name}", but ${Object.keys(modules).join(" and ")}`);
  return modules[name];
}

code.contentEditable = "plaintext-only";
code.spellcheck = false;
document.querySelector("#live-run").addEventListener("click", async () => {
  output.textContent = "";
  output.parentElement
    .querySelectorAll("#live-output ~ img")
    .forEach((picture) => picture.remove());
  output.dataset.state = "running";
  const print = (...all) => output.append(`${all.join(" ")}\n`);
  // A function has no import lines: each becomes a destructuring of the module.
  const body = code.textContent.replace(
    /^import \{ (.*) \} from "(.*)";$/gm,
    (_, names, from) => `const { ${names.replaceAll(" as ", ": ")} } = need("${from}");`,
  );
  try {
    await new AsyncFunction("need", "console", "process", body)(
      need,
      { ...console, log: print },
      { argv: [] },
    );
    output.dataset.state = "done";
  } catch (error) {
    print(`${error.name}: ${error.message}`);
    output.dataset.state = "failed";
  }
});
