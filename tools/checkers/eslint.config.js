// Rules of TypeScript and JavaScript, for tools/lint: what is unused, a condition within a condition,
// functions of more than 20 branches, statements packed into one, and what both projects recommend.
import js from "@eslint/js";
import typescript from "typescript-eslint";

/** Statements that are several in one, by the shape of their syntax. */
const packed = [
  {
    selector: "VariableDeclarator[id.type='ArrayPattern'][init.type='ArrayExpression']",
    message: "Declare each of these on a line of its own.",
  },
  {
    selector: "ObjectExpression > SpreadElement > ObjectExpression",
    message: "Write these members into the literal that they are spread into.",
  },
];
/** The npm package has `is` of an aim as a public member. */
const keywords = {
  selector: ":matches(TSPropertySignature, PropertyDefinition, MethodDefinition)[key.name='is']",
  message: "`is` is a keyword of Python and C#. Say what the member is.",
};

export default [
  { ignores: ["**/generated/**", "**/dist/**", "**/node_modules/**", "build/**"] },
  js.configs.recommended,
  ...typescript.configs.recommended,
  {
    rules: {
      complexity: ["error", 20],
      "max-statements-per-line": ["error", { max: 1 }],
      "no-multi-assign": "error",
      "no-nested-ternary": "error",
      "no-restricted-syntax": ["error", ...packed, keywords],
      "no-sequences": "error",
      "no-undef": "off", // the compiler of TypeScript knows what is defined
      "one-var": ["error", { initialized: "never" }],
    },
  },
  { files: ["web/npm/src/**"], rules: { "no-restricted-syntax": ["error", ...packed] } },
];
