// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What the live page steers: joints by sliders, against the forward kinematics of the neutral
// description; time; what is pulled; engines and variants; plots.
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { ask, button, drawn, hold, listen, near, openTab, sceneOf, settled, sleep, until } from "../harness.mjs";
import { apart, held, inverse, product } from "../poses.mjs";
import { pixels } from "../silhouette.mjs";

const hand = (stage) => stage.path("examples/inspire_hand/inspire_hand.usda");

/** Poses of all bodies as they are drawn, in the world's axes of the asset, by path. */
export const poses = (page) =>
  page.evaluate(() => {
    const { viewer } = window.tenonPage;
    viewer.scene.updateMatrixWorld(true);
    const back = viewer.root.matrixWorld.clone().invert();
    return Object.fromEntries(
      viewer.bodies.map((body, i) => {
        const p = body.position.clone();
        const q = body.quaternion.clone();
        back.clone().multiply(body.matrixWorld).decompose(p, q, body.scale.clone());
        return [viewer.info.bodies[i].path, { p: p.toArray(), q: q.toArray() }];
      }),
    );
  });

const slider = (page, joint, what) =>
  page
    .locator(`.mover[data-joint="${joint}"] .slider`)
    .filter({ hasText: what })
    .locator("input[type=range]")
    .first();

/** The field beside a slider. */
const field = (input) => input.locator("xpath=../..").locator("input[type=number]");

/** Bodies that hang on a joint. */
function hanging(joints, joint) {
  const below = new Set([joint.body1]);
  for (let count = 0; count !== below.size; ) {
    count = below.size;
    joints.filter((one) => below.has(one.body0)).forEach((one) => below.add(one.body1));
  }
  return below;
}

const far = ([metres, radians]) => metres > 1e-5 || radians > 1e-4;

/** Sets the slider of a joint, and holds what is drawn then. */
async function moveJoint(page, joints, joint, part) {
  const input = slider(page, joint.path, "position");
  const [lower, upper] = [Number(await input.getAttribute("min")), Number(await input.getAttribute("max"))];
  const value = lower + part * (upper - lower);
  const before = await poses(page);
  await input.fill(String(value));
  const here = () => poses(page).then((all) => product(inverse(all[joint.body0]), all[joint.body1]));
  const wanted = held(joint, value);
  const error = async () => apart(await here(), wanted);
  await until(async () => !far(await error()), `${joint.path} at ${value}`, 5000).catch(async () => {
    throw new Error(`${joint.path} at ${value} is off by ${await error()} (m, rad)`);
  });
  const after = await poses(page);
  const below = hanging(joints, joint);
  for (const path of Object.keys(before)) {
    const moved = far(apart(before[path], after[path]));
    hold(!moved || below.has(path), `${joint.path} moves ${path}`);
    hold(moved || !below.has(path), `${joint.path} leaves ${path} where it was`);
  }
  const text = await field(input).inputValue();
  const shown = joint.type === "revolute" ? (value * 180) / Math.PI : value * 1000;
  near(parseFloat(text), shown, Math.abs(shown) * 1e-3 + 1e-3, `what the slider of ${joint.path} says`);
}

/** Where the middle of a body is seen: its path, and x and y in the window. */
const seen = (page, name) =>
  page.evaluate((wanted) => {
    const { viewer } = window.tenonPage;
    const body = viewer.info.bodies.findIndex((one) => one.path.endsWith(`/${wanted}`));
    const box = viewer.renderer.domElement.getBoundingClientRect();
    const at = viewer.bodies[body].position.clone().fromArray(viewer.info.bodies[body].centerOfMass);
    viewer.bodies[body].localToWorld(at).project(viewer.camera);
    return [
      viewer.info.bodies[body].path,
      box.left + ((at.x + 1) / 2) * box.width,
      box.top + ((1 - at.y) / 2) * box.height,
    ];
  }, name);

const pulled = (page, count) =>
  until(() => page.evaluate((n) => window.heard.state.pulled === n, count), `${count} are pulled`);

/** Drags a body by so many pixels; it has to go there and the camera to stay. */
async function pull(page, name, [right, down]) {
  const camera = () => page.evaluate(() => window.tenonPage.viewer.camera.position.toArray().join());
  const looked = await camera();
  const [path, x, y] = await seen(page, name);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + right, y + down, { steps: 5 });
  await pulled(page, 1);
  await until(
    async () => {
      const [, newX, newY] = await seen(page, name);
      return (newX - x) * right + (newY - y) * down > 0.15 * (right * right + down * down);
    },
    `${path} follows the mouse`,
    15_000,
  );
  hold((await camera()) === looked, "pulling turns the camera");
  await page.mouse.up();
  await pulled(page, 0);
}

const clock = (page) => page.evaluate(() => window.heard.state?.time ?? 0);

export const tests = {
  async sliders_move_the_right_link(stage) {
    const page = await stage.live(await stage.view(hand(stage)));
    const { joints } = stage.tenon(["physics", "--json", hand(stage)]);
    const free = joints.filter((one) => one.type !== "fixed" && one.mimics.length === 0);
    hold(free.length === 6, `the hand has ${free.length} joints that are not led`);
    // What leads and what follows agree from the first move on.
    await ask(page, "setJoint", { joint: free[0].path, position: [0.1] });
    for (const joint of free) {
      await moveJoint(page, joints, joint, 0.6);
      await moveJoint(page, joints, joint, 0.2);
    }
    return `${free.length} sliders`;
  },

  async drives_reach_what_their_sliders_say(stage) {
    const page = await stage.live(await stage.view(hand(stage)));
    await listen(page);
    const { joints } = stage.tenon(["physics", "--json", hand(stage)]);
    const joint = joints.find((one) => one.path.includes("index_1"));
    const input = slider(page, joint.path, "drive to");
    await input.fill("0.8");
    await ask(page, "step", { count: 1000 });
    await settled(page);
    const all = await poses(page);
    const here = product(inverse(all[joint.body0]), all[joint.body1]);
    const [metres, radians] = apart(here, held(joint, 0.8));
    hold(radians < 0.08 && metres < 0.002, `the drive is off by ${radians} rad and ${metres} m`);
    const shown = await slider(page, joint.path, "position").inputValue();
    near(Number(shown), 0.8, 0.08, "the position that the panel shows after steps");
  },

  async time_goes_on_and_stops(stage) {
    const page = await stage.live(await stage.view(stage.path("examples/scenes/box_on_box.usda")));
    await listen(page);
    const start = await poses(page);
    await button(page, "Step").click();
    await until(async () => (await clock(page)) > 0, "a step");
    const step = await clock(page);
    near(step, (await page.evaluate(() => window.heard.scene?.timeStep)) ?? step, 1e-9, "one step");
    await button(page, "Play").click();
    await until(async () => (await clock(page)) > 0.4, "time goes on");
    await button(page, "Pause").click();
    await until(() => page.evaluate(() => !window.heard.state.playing), "a pause");
    const paused = await clock(page);
    await sleep(600);
    near(await clock(page), paused, 1e-9, "time while it is paused");
    const shown = await page.getByRole("status", { name: "contacts" }).textContent();
    hold(shown.startsWith(paused.toFixed(2)), `the clock says ${shown}, expected ${paused}`);
    const fallen = await poses(page);
    hold(Object.keys(start).some((path) => far(apart(start[path], fallen[path]))), "nothing falls");
    await button(page, "Reset").click();
    await until(async () => (await clock(page)) === 0, "the start");
    await settled(page);
    const again = await poses(page);
    Object.keys(start).forEach((path) =>
      hold(!far(apart(start[path], again[path])), `${path} is elsewhere after a reset`),
    );
    await page.locator("canvas").first().focus();
    await page.keyboard.press(".");
    await until(async () => (await clock(page)) > 0, "a step by key");
    await page.keyboard.press(" ");
    await until(() => page.evaluate(() => window.heard.state.playing), "play by key");
    await page.keyboard.press(" ");
    await until(() => page.evaluate(() => !window.heard.state.playing), "pause by key");
    await page.keyboard.press("r");
    await until(async () => (await clock(page)) === 0, "reset by key");
  },

  async speed_is_kept(stage) {
    const page = await stage.live(await stage.view(stage.path("examples/scenes/joint.usda")));
    await listen(page);
    await page.getByLabel("Speed").last().selectOption("0.25");
    await ask(page, "play");
    await until(async () => (await clock(page)) > 0.3, "time goes on");
    const rate = await page.evaluate(() => window.heard.state.rate);
    hold(rate > 0.1 && rate < 0.4, `at a quarter of the speed time goes on by ${rate}`);
  },

  async plots_show_data(stage) {
    const page = await stage.live(await stage.view(hand(stage)));
    await listen(page);
    await openTab(page, "Plots");
    const { joints } = stage.tenon(["physics", "--json", hand(stage)]);
    const thumb = joints.find((one) => one.path.endsWith("right_thumb_2_joint")).path;
    await page.evaluate((path) => window.tenonPage.viewer.select(path), thumb);
    await openTab(page, "Plots");
    await ask(page, "setDrive", { joint: thumb, position: 0.3 });
    await ask(page, "play");
    await until(async () => (await clock(page)) > 1.5, "time goes on");
    await ask(page, "pause");
    const first = await page.locator(".legend").first().locator("li").first().textContent();
    hold(/right_thumb_2_joint -?[\d.]+ deg/.test(first), `the first line is ${first}`);
    near(parseFloat(first.match(/(-?[\d.]+) deg/)[1]), 0.3 * (180 / Math.PI), 6, "what it shows");
    for (const canvas of await page.locator("figure canvas").all()) {
      const { inked, label } = await canvas.evaluate((one) => {
        const { data } = one.getContext("2d").getImageData(0, 0, one.width, one.height);
        let count = 0;
        for (let i = 3; i < data.length; i += 4) {
          count += data[i] > 0 ? 1 : 0;
        }
        return { inked: count, label: one.getAttribute("aria-label") };
      });
      hold(inked > 60, `${label}: ${inked} pixels are drawn`);
      hold(/from -?[\d.e-]+ to -?[\d.e-]+ in the last/.test(label), `it reads ${label}`);
    }
  },

  async pulling_moves_a_body(stage) {
    const asset = join(stage.folder(), "boxes.usda");
    const cube = (name, size, at, apis) => `
    def Cube "${name}" (prepend apiSchemas = [${apis}"PhysicsCollisionAPI"])
    {
        double size = ${size}
        double3 xformOp:translate = (${at})
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }`;
    const [rigid, on] = ['"PhysicsRigidBodyAPI", ', cube("plate", 1, "0, 0, -0.5", "")];
    writeFileSync(
      asset,
      sceneOf(cube("left", 0.2, "-0.3, 0, 0.1", rigid) + cube("right", 0.2, "0.3, 0, 0.1", rigid) + on),
    );
    const page = await stage.live(await stage.view(asset));
    await listen(page);
    await ask(page, "play");
    await until(async () => (await clock(page)) > 0.5, "all is at rest");
    await button(page, "Pull").click();
    for (const [name, way] of Object.entries({ left: [0, -90], right: [40, -60] })) {
      await pull(page, name, way);
    }
  },

  async engines_and_variants_switch(stage) {
    const page = await stage.live(await stage.view(hand(stage)));
    await listen(page);
    const menu = page.getByLabel("Engine", { exact: true });
    const engines = await menu.locator("option:not([disabled])").allTextContents();
    hold(engines.length === 3, `there are the engines ${engines}; build with every engine`);
    for (const engine of [...engines.slice(1), engines[0]]) {
      await menu.selectOption(engine);
      await until(() => page.evaluate((e) => window.heard.scene?.engine === e, engine), engine);
      await ask(page, "step", { count: 5 });
      hold((await clock(page)) > 0, `${engine} makes no step`);
    }
    const variants = page.getByLabel("Variant of Physics of /inspire_hand");
    const options = await variants.locator("option").allTextContents();
    hold(options.length > 2, `there are the variants ${options}`);
    const counts = {};
    for (const option of options) {
      const before = await page.evaluate(() => window.heard.scene.revision);
      await variants.selectOption(option);
      await until(
        () => page.evaluate((r) => window.heard.scene.revision > r, before),
        `the variant ${option}`,
      );
      await drawn(page);
      hold((await variants.inputValue()) === option, `the menu does not show ${option}`);
      counts[option] = await page.evaluate(() => window.heard.scene.bodies.length);
    }
    hold(new Set(Object.values(counts)).size > 1, `all variants have ${counts[options[0]]} bodies`);
    const picture = await pixels(page);
    hold(picture.width > 100, "no picture");
    return `${engines.length} engines, ${options.length} variants`;
  },
};
