// Rules of TypeScript and JavaScript, for tools/lint: what is unused, a condition within a condition,
// functions of more than 20 branches, and what both projects recommend.
import js from "@eslint/js";
import typescript from "typescript-eslint";

export default [
  { ignores: ["**/generated/**", "**/dist/**", "**/node_modules/**", "build/**"] },
  js.configs.recommended,
  ...typescript.configs.recommended,
  {
    rules: {
      complexity: ["error", 20],
      "max-statements-per-line": ["error", { max: 1 }],
      "no-nested-ternary": "error",
      "no-undef": "off", // the compiler of TypeScript knows what is defined
    },
  },
];
