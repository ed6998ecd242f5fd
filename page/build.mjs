// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Bundles the page: node build.mjs FOLDER, where node_modules is beside this file. Writes live.js, page.css and index.html for `tenon
// view`, record.js and record.html for `tenon record`, and report.html, the frame of `tenon report`:
// style and script are in it, the script compressed, and two slots wait for the asset. The policy of the report names its script and style
// by their hashes, so that nothing else in the file can run.
import { createHash } from "node:crypto";
import { mkdir, readFile, writeFile } from "node:fs/promises";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";
import * as esbuild from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));
const folder = process.argv[2];
if (!folder) {
  console.error("usage: node build.mjs FOLDER");
  process.exit(2);
}

async function bundle(entry) {
  const made = await esbuild.build({
    entryPoints: [join(here, entry)],
    bundle: true,
    minify: true,
    format: "iife",
    target: "es2022",
    charset: "utf8",
    legalComments: "none",
    write: false,
    logLevel: "warning",
  });
  return made.outputFiles[0].text;
}

const hash = (text) => `'sha256-${createHash("sha256").update(text).digest("base64")}'`;

/// Text in the place of a slot, whatever dollar signs it has.
const fill = (frame, slot, text) => frame.split(slot).join(text);

/// As tenon/bytes/gzip.h has it.
function sevenBitText(bytes) {
  const codes = [];
  const add = (value) => codes.push([0, 13, 60].includes(value) ? 256 + value : value);
  let held = 0;
  let count = 0;
  for (const byte of bytes) {
    held = ((held << 8) | byte) & 0xffff;
    count += 8;
    while (count >= 7) {
      count -= 7;
      add((held >> count) & 127);
    }
  }
  if (count > 0) {
    add((held << (7 - count)) & 127);
  }
  return codes.map((code) => String.fromCharCode(code)).join("");
}

async function main() {
  const [live, report, record] = await Promise.all(
    ["live", "report", "record"].map((part) => bundle(`src/${part}/main.ts`)));
  const css = async (name) =>
    (await esbuild.transform(await readFile(join(here, name), "utf8"), { loader: "css", minify: true })).code;
  const style = await css("src/page.css");
  const start = (await esbuild.transform(await readFile(join(here, "src/report/start.js"), "utf8"), {
    minify: true,
  })).code;
  const licence = (name) => readFile(join(here, "node_modules", name, "LICENSE"), "utf8");
  let frame = await readFile(join(here, "src/report/report.html"), "utf8");
  frame = fill(frame, "{{POLICY}}",
    `default-src 'none'; script-src ${hash(start)} 'strict-dynamic' 'wasm-unsafe-eval'; ` +
      `style-src ${hash(style)}; img-src data: blob:; connect-src blob: data:; base-uri 'none'; ` +
      "form-action 'none'");
  frame = fill(frame, "{{STYLE}}", style);
  frame = fill(frame, "{{START}}", start);
  frame = fill(frame, "{{SCRIPT}}", sevenBitText(gzipSync(report, { level: 9 })));
  await mkdir(folder, { recursive: true });
  await writeFile(join(folder, "live.js"), live);
  await writeFile(join(folder, "page.css"), style + (await css("src/live/panels.css")));
  await writeFile(join(folder, "index.html"), await readFile(join(here, "src/live/index.html")));
  await writeFile(join(folder, "record.js"), record);
  await writeFile(join(folder, "record.html"), await readFile(join(here, "src/record/record.html")));
  await writeFile(join(folder, "three-LICENSE.txt"), await licence("three"));
  await writeFile(join(folder, "mediabunny-LICENSE.txt"), await licence("mediabunny"));
  await writeFile(join(folder, "report.html"), frame); // last: its presence says that all is there
}

await main();
