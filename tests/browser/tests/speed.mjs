// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// How fast pages are on this machine, with the browser running and drawing by software: figures of
// the judge, to be taken while nothing else runs.
import { readFileSync, readdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { hold, sleep } from "../harness.mjs";

/** Processor time [s] of all processes below this one whose name begins with chrom. */
function browserSeconds() {
  const all = new Map();
  for (const pid of readdirSync("/proc").filter((name) => /^\d+$/.test(name))) {
    try {
      const stat = readFileSync(`/proc/${pid}/stat`, "utf8");
      const rest = stat.slice(stat.lastIndexOf(")") + 2).split(" ");
      all.set(Number(pid), {
        parent: Number(rest[1]),
        seconds: (Number(rest[11]) + Number(rest[12])) / 100,
        chromium: stat.includes("(chrom"),
      });
    } catch {
      // it has ended meanwhile
    }
  }
  const isBelow = (pid) => {
    for (let at = pid; all.has(at); at = all.get(at).parent) {
      if (at === process.pid) {
        return true;
      }
    }
    return false;
  };
  return [...all]
    .filter(([pid, one]) => one.chromium && isBelow(pid))
    .reduce((sum, [, one]) => sum + one.seconds, 0);
}

/** A wavy sheet of at least a million triangles, as text. */
function sheet() {
  const side = 708;
  const points = [];
  const corners = [];
  for (let y = 0; y <= side; ++y) {
    for (let x = 0; x <= side; ++x) {
      const z = 0.05 * Math.sin(x / 20) * Math.cos(y / 25);
      points.push(`(${(x / side).toFixed(4)},${(y / side).toFixed(4)},${z.toFixed(4)})`);
      if (x < side && y < side) {
        const at = y * (side + 1) + x;
        corners.push(`${at},${at + 1},${at + side + 2},${at + side + 1}`);
      }
    }
  }
  return `#usda 1.0
(
    defaultPrim = "World"
    metersPerUnit = 1
    upAxis = "Z"
)
def Xform "World"
{
    def Mesh "sheet"
    {
        int[] faceVertexCounts = [${"4,".repeat(side * side - 1)}4]
        int[] faceVertexIndices = [${corners.join(",")}]
        point3f[] points = [${points.join(",")}]
    }
}
`;
}

/** Equal boxes that fall onto a ground and each other. */
function pile(count) {
  const rows = Array.from({ length: count }, (_, i) => {
    const at = `(${(i % 6) * 0.22}, ${(Math.floor(i / 6) % 5) * 0.22}, ${0.15 + Math.floor(i / 30) * 0.22})`;
    return `    def Cube "box_${i}" (prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsCollisionAPI"])
    {
        double size = 0.2
        double3 xformOp:translate = ${at}
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
`;
  });
  return `#usda 1.0
(
    defaultPrim = "World"
    metersPerUnit = 1
    upAxis = "Z"
)
def Xform "World"
{
    def PhysicsScene "scene"
    {
    }
    def Cube "ground" (prepend apiSchemas = ["PhysicsCollisionAPI"])
    {
        double size = 1
        float3 xformOp:scale = (6, 6, 0.1)
        double3 xformOp:translate = (0, 0, -0.05)
        uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:scale"]
    }
${rows.join("")}}
`;
}

export const tests = {
  async first_picture(stage) {
    const viewer = await stage.view(stage.path("examples/inspire_hand/inspire_hand.usda"));
    const measured = [];
    for (let i = 0; i < 5; ++i) {
      const page = await stage.page();
      await page.goto("about:blank");
      await sleep(500);
      const before = browserSeconds();
      const begin = Date.now();
      await page.goto(viewer.url);
      await page.waitForFunction(() => {
        const viewer = window.tenonPage?.viewer;
        return viewer?.shown > 0 && !viewer.dirty;
      });
      measured.push([browserSeconds() - before, (Date.now() - begin) / 1000]);
      await page.context().close();
    }
    measured.sort((a, b) => a[0] - b[0]);
    const [seconds, wall] = measured[0]; // what else runs only adds to it
    hold(seconds < 1, `the first picture of the hand costs ${seconds.toFixed(2)} s, at most 1`);
    return `first picture of the hand ${seconds.toFixed(2)} s of processor, ${wall.toFixed(2)} s`;
  },

  async a_million_triangles(stage) {
    const asset = join(stage.folder(), "sheet.usda");
    writeFileSync(asset, sheet());
    const page = await stage.live(await stage.view(asset));
    const before = browserSeconds();
    const { triangles, rate, count } = await page.evaluate(async () => {
      const { viewer } = window.tenonPage;
      viewer.container.style.cssText = "position:fixed;left:0;top:0;width:960px;height:600px";
      await new Promise((go) => new ResizeObserver(go).observe(viewer.container));
      viewer.frame();
      const begin = performance.now();
      const first = viewer.drawn;
      while (performance.now() < begin + 5000) {
        const turn = (performance.now() - begin) / 1000;
        viewer.camera.position.applyAxisAngle(viewer.camera.up, 0.01 * Math.sin(turn));
        viewer.camera.lookAt(viewer.controls.target);
        viewer.invalidate();
        await new Promise((go) => requestAnimationFrame(go));
        // What is drawn has to be there, not only asked for.
        viewer.renderer.getContext().finish();
      }
      return {
        triangles: viewer.renderer.info.render.triangles,
        count: viewer.drawn - first,
        rate: ((viewer.drawn - first) * 1000) / (performance.now() - begin),
      };
    });
    const each = (browserSeconds() - before) / count;
    hold(triangles > 50_000 && triangles <= 300_000, `${triangles} triangles are drawn`);
    // Ten pictures a second on two processors, whoever else uses them meanwhile.
    hold(each <= 0.2, `a picture costs ${each.toFixed(3)} s of processor, at most 0.2`);
    const figures = `${each.toFixed(3)} s of processor each, ${rate.toFixed(1)} pictures/s`;
    return `a million triangles, thinned to ${triangles}: ${figures}`;
  },

  async equal_boxes_are_drawn_together(stage) {
    const asset = join(stage.folder(), "pile.usda");
    writeFileSync(asset, pile(300));
    const page = await stage.live(await stage.view(asset));
    const { viewer } = { viewer: "window.tenonPage.viewer" };
    const calls = () => page.evaluate(`(${viewer}.draw(), ${viewer}.renderer.info.render.calls)`);
    const still = await calls();
    hold(still <= 10, `300 equal boxes are drawn in ${still} calls, at most 10`);
    await page.evaluate(() => window.tenonPage.panel.layers.set("contacts", true));
    const begin = browserSeconds();
    const rate = await page.evaluate(async () => {
      const { session, viewer } = window.tenonPage;
      await session.connection.ask("play");
      await new Promise((go) => setTimeout(go, 1000));
      const [first, at] = [viewer.drawn, performance.now()];
      await new Promise((go) => setTimeout(go, 5000));
      const pictures = ((viewer.drawn - first) * 1000) / (performance.now() - at);
      await session.connection.ask("pause");
      return pictures;
    });
    const each = (browserSeconds() - begin) / (6 * rate);
    const moving = await calls();
    const contacts = await page.evaluate(() => window.tenonPage.viewer.overlays.drawnContacts);
    hold(contacts > 300 && moving <= 12, `${contacts} contacts and 300 boxes in ${moving} calls`);
    // What is picked and marked is the box, as before.
    await page.evaluate(() => window.tenonPage.viewer.select("/World/box_299"));
    hold((await calls()) <= moving + 2, "a selection takes the boxes apart");
    return `300 boxes: ${still} draw calls, ${rate.toFixed(1)} pictures/s with ${contacts} contacts, ${each.toFixed(3)} s of processor each`;
  },
};
