// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Tests of `tenon view` and `tenon report` in a real browser.
//
//     node run.mjs PACKAGES ROOT TENON [NAME...] [--list] [--write] [--slow]
//
// PACKAGES is a folder with node_modules of package-lock.json; the judge makes it. A NAME is a test,
// or the beginning of names. Each file of tests/ has some of them: name -> function of a stage, which
// throws where something is wrong and returns what is to be said. --write makes goldens, pictures
// and tables anew. Exit 0: all passed.
import { readdirSync } from "node:fs";
import { resolve } from "node:path";
import { Stage, startBrowser } from "./harness.mjs";

const words = process.argv.slice(2);
const options = new Set(words.filter((word) => word.startsWith("--")));
const [packages, root, program, ...names] = words.filter((word) => !word.startsWith("--"));

async function allTests() {
  const folder = new URL("./tests/", import.meta.url);
  const tests = new Map();
  for (const file of readdirSync(folder).sort()) {
    const part = await import(new URL(file, folder));
    for (const [name, run] of Object.entries(part.tests)) {
      tests.set(`${file.replace(/\.mjs$/, "")}.${name}`, run);
    }
  }
  // The one of ten minutes comes last, so that what is timed is over soon.
  const last = ([name]) => Number(name.endsWith(".memory_stays"));
  return new Map([...tests].sort((a, b) => last(a) - last(b)));
}

async function runOne(world, name, run) {
  const stage = new Stage(world, name);
  const begin = Date.now();
  let said = "";
  const faults = [];
  try {
    said = (await run(stage)) ?? "";
  } catch (fault) {
    faults.push(fault.constructor.name === "Fault" ? fault.message : fault.stack);
  }
  try {
    await stage.end();
  } catch (fault) {
    faults.push(fault.message);
  }
  const seconds = ((Date.now() - begin) / 1000).toFixed(1);
  console.log(`${faults.length ? "FAILED" : "passed"} ${name} (${seconds} s) ${said}`);
  for (const fault of faults) {
    console.log(`    ${String(fault).replaceAll("\n", "\n    ")}`);
  }
  return { good: faults.length === 0, said };
}

async function main() {
  const tests = await allTests();
  if (options.has("--list")) {
    console.log([...tests.keys()].join("\n"));
    return 0;
  }
  const wanted = [...tests].filter(
    ([name]) => names.length === 0 || names.some((one) => name.startsWith(one)),
  );
  if (!program || wanted.length === 0) {
    console.log("usage: node run.mjs PACKAGES ROOT TENON [NAME...] [--list] [--write]");
    return 2;
  }
  const world = {
    browser: await startBrowser(resolve(packages)),
    packages: resolve(packages),
    root: resolve(root),
    program: resolve(program),
    write: options.has("--write"),
  };
  let failed = 0;
  const figures = [];
  for (const [name, run] of wanted) {
    const { good, said } = await runOne(world, name, run);
    failed += good ? 0 : 1;
    if (said) {
      figures.push(said);
    }
  }
  await world.browser.close();
  console.log(`${wanted.length - failed} of ${wanted.length} tests in a browser passed; ` + figures.join("; "));
  return failed === 0 ? 0 : 1;
}

process.exit(await main());
