import js from "@eslint/js";
import tseslint from "typescript-eslint";

export default tseslint.config(
  { ignores: ["node_modules", "src/generated"] },
  {
    files: ["src/**/*.ts", "tests/**/*.ts", "*.config.ts"],
    extends: [js.configs.recommended, tseslint.configs.strictTypeChecked, tseslint.configs.stylisticTypeChecked],
    languageOptions: { parserOptions: { projectService: true, tsconfigRootDir: import.meta.dirname } },
    rules: {
      "@typescript-eslint/restrict-template-expressions": ["error", { allowNumber: true }],
      "@typescript-eslint/no-confusing-void-expression": ["error", { ignoreArrowShorthand: true }],
      "@typescript-eslint/prefer-nullish-coalescing": "error",
    },
  },
  {
    // The core knows neither the page nor WebGL; three knows no page.
    files: ["src/core/**/*.ts"],
    rules: {
      "no-restricted-imports": ["error", { patterns: ["three", "three/*", "three-*", "lit", "lit/*", "**/three/**", "**/app/**"] }],
      "no-restricted-globals": ["error", "document", "window", "localStorage"],
    },
  },
  {
    files: ["src/three/**/*.ts"],
    rules: { "no-restricted-imports": ["error", { patterns: ["lit", "lit/*", "**/app/**"] }] },
  },
  {
    files: ["**/*.mjs", "public/*.js", "eslint.config.js"],
    extends: [js.configs.recommended],
    languageOptions: {
      globals: { process: "readonly", console: "readonly", Buffer: "readonly", URL: "readonly", document: "readonly", location: "readonly" },
    },
  },
);
