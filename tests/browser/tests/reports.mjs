// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The reports of all examples and of ten robots that were converted open from their files, without a
// word on the console and without asking for anything. --write puts their sizes into docs/viewer.md.
import { spawnSync } from "node:child_process";
import { existsSync, readFileSync, statSync, writeFileSync } from "node:fs";
import { basename, join } from "node:path";
import { hold, settled } from "../harness.mjs";
import { pixels, silhouette } from "../silhouette.mjs";
import { examples } from "./scene.mjs";

const wanted = 10;
const listed = `import json, pathlib, sys
sys.path.insert(0, sys.argv[1] + "/tests/convert")
import ten_robots
root = pathlib.Path(sys.argv[1])
folder, why = ten_robots.make_packages(root)
print(json.dumps([[row[0], str(folder / row[1])] for row in ten_robots.TABLE] if folder else why))`;

/** The robots of tests/convert/ten_robots.py, fetched where they are not there yet. */
function robots(stage) {
  const done = spawnSync("python3", ["-B", "-c", listed, stage.root], { encoding: "utf8" });
  hold(done.status === 0, `no robots: ${done.stderr}`);
  const rows = JSON.parse(done.stdout.trim().split("\n").pop());
  hold(rows[0]?.length === 2, `no robots: ${rows}`);
  return rows;
}

async function open(stage, name, asset, options, rows) {
  const file = stage.report(asset, ...options);
  const requests = [];
  const page = await stage.page();
  page.on("request", (request) => requests.push(request.url()));
  await page.goto(`file://${file}`);
  await page.waitForFunction(() => window.tenonPage?.viewer.shown > 0);
  await settled(page);
  const asked = requests.filter((url) => !/^(?:data|blob):/.test(url));
  hold(asked.length === 1, `${name} asks for ${asked}`);
  hold(stage.faults.length === 0, `${name}: ${stage.faults}`);
  const counts = await page.evaluate(() => {
    const { info, renderer } = window.tenonPage.viewer;
    return [info.bodies.length, info.joints.length, renderer.info.render.triangles];
  });
  await page.evaluate(() => window.tenonPage.viewer.showGrid(false));
  hold(silhouette(await pixels(page)).area > 0.005, `${name}: nothing is drawn`);
  rows.push([name, ...counts, Math.round(statSync(file).size / 1000)]);
  await page.context().close();
}

function writeTable(stage, rows) {
  const file = stage.path("docs/viewer.md");
  const text = readFileSync(file, "utf8");
  const table = [
    "| asset | bodies | joints | triangles | kB |",
    "|---|---|---|---|---|",
    ...rows.map((row) => `| ${row.join(" | ")} |`),
  ].join("\n");
  const made = text.replace(
    /(<!-- sizes -->\n)[^]*?(\n<!-- end of sizes -->)/,
    (_, begin, end) => `${begin}\n${table}\n${end}`,
  );
  hold(made.includes(table), "docs/viewer.md has no part <!-- sizes -->");
  writeFileSync(file, made);
}

export const tests = {
  async open_from_their_files(stage) {
    const rows = [];
    for (const asset of examples(stage)) {
      await open(stage, basename(asset), asset, ["--duration", "2"], rows);
    }
    let converted = 0;
    const refused = [];
    for (const [name, source] of robots(stage)) {
      if (converted === wanted) {
        break;
      }
      const asset = join(stage.folder(), "robot.usda");
      const done = stage.tenon(["convert", source, asset], { fails: true });
      if (done.status !== 0 || !existsSync(asset)) {
        refused.push(`${name}: ${done.stderr.trim().split("\n").pop()}`);
        continue;
      }
      await open(stage, name, asset, ["--duration", "1"], rows);
      converted += 1;
    }
    hold(converted === wanted, `${converted} robots were converted; ${refused.join("\n")}`);
    if (stage.write) {
      writeTable(stage, rows);
    }
    const largest = Math.max(...rows.map((row) => row[4]));
    return `${rows.length} reports, the largest ${largest} kB`;
  },
};
