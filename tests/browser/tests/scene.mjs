// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Each example is drawn as its golden says, in `tenon view` and in `tenon report`, and where its
// corners are projected to; themes change the background and nothing else that counts.
import { existsSync, readFileSync, readdirSync, writeFileSync } from "node:fs";
import { basename, join } from "node:path";
import { hold, near, settled } from "../harness.mjs";
import { compare, differing, pixels, silhouette } from "../silhouette.mjs";

export function examples(stage) {
  const scenes = readdirSync(stage.path("examples/scenes")).filter((name) => name.endsWith(".usda"));
  return [
    ...scenes.sort().map((name) => stage.path("examples/scenes", name)),
    stage.path("examples/inspire_hand/inspire_hand.usda"),
    stage.path("examples/inspire_hand/grasp.usda"),
  ];
}

/** The numbers of the whole scene, whatever stands around the picture, without the grid. */
async function shape(page) {
  await page.evaluate(() => {
    const { viewer } = window.tenonPage;
    viewer.container.style.cssText = "position:fixed;left:0;top:0;width:960px;height:600px";
    return new Promise((go) => new ResizeObserver(go).observe(viewer.container));
  });
  await settled(page);
  await page.evaluate(() => {
    window.tenonPage.viewer.showGrid(false);
    window.tenonPage.viewer.frame();
  });
  return silhouette(await pixels(page));
}

/** The box of what is visible, as its corners are projected, in parts of the picture. */
const projected = (page) =>
  page.evaluate(() => {
    const { viewer } = window.tenonPage;
    const box = [1, 1, 0, 0];
    viewer.scene.updateMatrixWorld(true);
    const seen = (node) => {
      for (let one = node; one; one = one.parent) {
        if (!one.visible) {
          return false;
        }
      }
      return true;
    };
    viewer.root.traverse((node) => {
      const places = node.geometry?.attributes.position;
      if (!places || !seen(node) || node.userData.ofPage) {
        return;
      }
      const at = node.position.clone();
      for (let i = 0; i < places.count; ++i) {
        at.fromBufferAttribute(places, i).applyMatrix4(node.matrixWorld).project(viewer.camera);
        const x = (at.x + 1) / 2;
        const y = (1 - at.y) / 2;
        box[0] = Math.min(box[0], x);
        box[1] = Math.min(box[1], y);
        box[2] = Math.max(box[2], x);
        box[3] = Math.max(box[3], y);
      }
    });
    return box.map((side) => Math.min(1, Math.max(0, side)));
  });

/** Draws every example by `open`, and holds it against the goldens. */
async function drawAll(stage, kind, open) {
  const file = stage.path("tests/browser/goldens/scenes.json");
  const goldens = existsSync(file) ? JSON.parse(readFileSync(file, "utf8")) : {};
  const made = {};
  for (const asset of examples(stage)) {
    const name = basename(asset);
    const page = await open(asset);
    const found = await shape(page);
    hold(found.area > 0.005 && found.area < 0.98, `${name}: ${found.area} of the picture is drawn`);
    const box = await projected(page);
    const flat = box.some((side) => side <= 0 || side >= 1); // cut off at the sides of the picture
    if (!flat) {
      found.box.forEach((side, i) => near(side, box[i], 0.006, `${name}: projected box[${i}]`));
    }
    made[name] = found;
    if (!stage.write) {
      hold(goldens[name], `${name}: it has no golden; --write makes it`);
      compare(found, goldens[name], name);
    }
    await page.context().close();
  }
  if (stage.write) {
    writeFileSync(file, `${JSON.stringify(made, null, 1)}\n`);
  }
  return `${Object.keys(made).length} scenes drawn by ${kind}`;
}

export const tests = {
  view: (stage) =>
    drawAll(stage, "view", async (asset) => stage.live(await stage.view(asset))),
  report: (stage) =>
    drawAll(stage, "report", (asset) =>
      stage.opened(stage.report(asset, "--duration", "0")),
    ),

  async themes(stage) {
    const viewer = await stage.view(stage.path("examples/inspire_hand/inspire_hand.usda"));
    const page = await stage.live(viewer);
    const light = await shape(page);
    const lightPixels = await pixels(page);
    await page.evaluate(() => window.tenonPage.viewer.container.removeAttribute("style"));
    await page.getByRole("button", { name: "Dark or light" }).click();
    const dark = await shape(page);
    const darkPixels = await pixels(page);
    const brightness = (one) => one.pixels[0] + one.pixels[1] + one.pixels[2];
    hold(brightness(lightPixels) > 600 && brightness(darkPixels) < 150, "the background stays");
    near(dark.area, light.area, 0.01, "area in the dark");
    dark.box.forEach((side, i) => near(side, light.box[i], 0.01, `box[${i}] in the dark`));
    const page2 = await stage.live(viewer, { theme: "dark" });
    await shape(page2);
    hold(differing(await pixels(page2), darkPixels) < 50, "what the system wants is another dark");
  },
};
