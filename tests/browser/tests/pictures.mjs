// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Every file of examples/ that draws something, as tenon view opens it: the rectangle around its
// subject is a tenth of the picture or more, nothing of it is black, and it is as bright 20 m away from
// the world's origin.
import { readdirSync } from "node:fs";
import { join } from "node:path";
import { hold, near, settled } from "../harness.mjs";
import { pixels } from "../silhouette.mjs";

const moved = 20; // m
const leastShare = 0.1;
const black = 16; // of 255: what a lit surface is brighter than
const mostBlack = 0.02; // of the subject: edges, and what is painted black

/** All layers below examples/, whoever adds one. */
function layers(stage) {
  return readdirSync(stage.path("examples"), { recursive: true, withFileTypes: true })
    .filter((one) => one.isFile() && /\.usd[acz]?$/.test(one.name))
    .map((one) => join(one.parentPath, one.name))
    .sort();
}

/**
 * Shows the subject alone: shapes of bodies that can move, and what is less than ten times as large
 * as the largest of them; all shapes where nothing can move.
 */
const showSubject = (page) =>
  page.evaluate(async () => {
    const { viewer } = window.tenonPage;
    viewer.container.style.cssText = "position:fixed;left:0;top:0;width:640px;height:400px";
    await new Promise((go) => new ResizeObserver(go).observe(viewer.container));
    const carrier = (node) => {
      for (let one = node; one; one = one.parent) {
        if (one.userData.kind === "body") {
          return viewer.info.bodies[one.userData.index];
        }
      }
      return undefined;
    };
    const drawn = viewer.kinds.visual;
    const moving = drawn.filter((node) => carrier(node)?.kinematic === false);
    const sizeOf = (node) => {
      const reach = [[], [], []];
      node.updateWorldMatrix(true, true);
      node.traverse((part) => {
        const places = part.geometry?.attributes.position;
        for (let i = 0; i < (places?.count ?? 0); ++i) {
          const at = part.position.clone().fromBufferAttribute(places, i);
          at.applyMatrix4(part.matrixWorld).toArray().forEach((x, k) => reach[k].push(x));
        }
      });
      const ends = (list, pick) => list.reduce((a, b) => pick(a, b), list[0] ?? 0);
      return Math.hypot(...reach.map((one) => ends(one, Math.max) - ends(one, Math.min)));
    };
    const largest = moving.map(sizeOf).reduce((a, b) => Math.max(a, b), 0);
    for (const node of drawn) {
      node.visible = moving.length === 0 || sizeOf(node) < 10 * largest;
    }
    viewer.showGrid(false);
    viewer.select("");
    return drawn.length;
  });

/** Puts the whole scene somewhere else and looks at it as after opening it. */
const moveBy = (page, metres) =>
  page.evaluate((by) => {
    const { viewer } = window.tenonPage;
    viewer.root.position.x += by;
    viewer.measure();
    viewer.frame();
  }, metres);

/** Of what is not background: its rectangle as a share of the picture, brightness, share of black. */
async function look(page) {
  await settled(page);
  const { width, height, pixels: data } = await pixels(page);
  let [count, sum, dark] = [0, 0, 0];
  const box = [width, height, 0, 0];
  for (let at = 0; at < data.length; at += 4) {
    const apart = Math.max(...[0, 1, 2].map((k) => Math.abs(data[at + k] - data[k])));
    if (apart > 6) {
      const shade = (data[at] + data[at + 1] + data[at + 2]) / 3;
      count += 1;
      const [x, y] = [(at / 4) % width, Math.floor(at / 4 / width)];
      box[0] = Math.min(box[0], x);
      box[1] = Math.min(box[1], y);
      box[2] = Math.max(box[2], x + 1);
      box[3] = Math.max(box[3], y + 1);
      sum += shade;
      dark += shade < black ? 1 : 0;
    }
  }
  const all = Math.max(count, 1);
  const share = Math.max(0, (box[2] - box[0]) * (box[3] - box[1])) / (width * height);
  return { share, mean: sum / all, dark: dark / all };
}

async function holdPicture(page, name) {
  const here = await look(page);
  await moveBy(page, moved);
  const there = await look(page);
  const said = `${(100 * here.share).toFixed(0)} % of the picture, brightness ${here.mean.toFixed(0)}`;
  hold(here.share >= leastShare, `${name}: its subject is ${said}`);
  hold(here.dark <= mostBlack, `${name}: ${(100 * here.dark).toFixed(0)} % of it is black`);
  near(there.mean, here.mean, 1, `${name}: brightness ${moved} m away`);
  near(there.share, here.share, 0.01, `${name}: share of the picture ${moved} m away`);
  return said;
}

export const tests = {
  async examples_are_seen_and_lit_wherever_they_are(stage) {
    const faults = [];
    const empty = [];
    let count = 0;
    for (const asset of layers(stage)) {
      const name = asset.slice(stage.path("examples").length + 1);
      const page = await stage.live(await stage.view(asset, "--read-only"));
      if ((await showSubject(page)) === 0) {
        empty.push(name);
      } else {
        count += 1;
        await moveBy(page, 0);
        await holdPicture(page, name)
          .then((said) => console.log(`    ${name}: ${said}`))
          .catch((fault) => faults.push(fault.message));
      }
      await page.context().close();
    }
    console.log(`    nothing is drawn of ${empty.join(", ")}`);
    hold(faults.length === 0, faults.join("\n"));
    hold(count >= 10, `only ${count} examples draw something`);
    return `${count} examples seen and lit alike ${moved} m away`;
  },
};
