// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The panel of both pages: every switch of "What is shown", the scene tree and its search, tabs, and
// keys. The switches are those that the page has; one without a line in `expected` has a fault.
import { ask, button, hold, listen, openTab, settled, until } from "../harness.mjs";
import { differing, pixels } from "../silhouette.mjs";

/** What a switch draws, counted in the page: [what it has drawn, what there is to draw]. */
const expected = {
  visuals: (v) => [v.kinds.visual.filter((node) => node.visible).length, v.kinds.visual.length],
  colliders: (v) => [
    v.kinds.collider.filter((node) => node.visible).length,
    v.kinds.collider.length,
  ],
  joints: (v, laid) => [laid, v.info.joints.length],
  limits: (v, laid) => [laid, v.info.joints.length],
  masses: (v, laid) => [laid, v.info.bodies.length],
  inertia: (v, laid) => [laid, v.info.bodies.length],
  frames: (v, laid) => [laid, v.info.bodies.length],
  tree: (v, laid) => [
    laid,
    v.info.joints.filter((j) => j.articulation !== null && j.body0 !== null && j.body1 !== null)
      .length,
  ],
  filtered: (v, laid) => [
    laid,
    v.info.filteredPairs.filter(
      (pair) => pair.every((one) => one >= 0) && pair.some((i) => v.info.bodies[i].path === v.selected),
    ).length,
  ],
  contacts: (v, laid) => [laid && v.overlays.drawnContacts, v.overlays.contacts.length / 6],
  grid: (v) => [v.grid.visible ? 1 : 0, 1],
};

const count = (page, name) =>
  page.evaluate(
    ([code, which]) => {
      const viewer = window.tenonPage.viewer;
      const laid = viewer.overlays.made.get(which)?.length ?? 0;
      return new Function(`return (${code})`)()(viewer, laid);
    },
    [expected[name].toString(), name],
  );

async function walkSwitches(page) {
  await openTab(page, "Show");
  const boxes = page.locator(".layers input:visible");
  const names = await boxes.evaluateAll((all) => all.map((box) => box.name));
  hold(names.length > 5, `there are only the switches ${names}`);
  for (const [i, name] of names.entries()) {
    hold(expected[name], `the switch ${name} has no line in this test`);
    const box = boxes.nth(i);
    const shown = await box.isChecked();
    const before = await pixels(page);
    await box.click();
    const after = await pixels(page);
    const [drawn, there] = await count(page, name);
    hold(there > 0, `${name}: this asset has nothing to show`);
    hold(drawn === (shown ? 0 : there), `${name}: ${drawn} of ${there} are drawn`);
    hold(differing(before, after) > 30, `${name} changes nothing that is seen`);
    const key = await box.locator("xpath=..").locator("kbd").textContent();
    await page.locator("canvas").first().focus();
    await page.keyboard.press(key);
    hold((await box.isChecked()) === shown, `the key ${key} does not switch ${name}`);
    hold(differing(before, await pixels(page)) === 0, `${name} leaves something behind`);
  }
  return names;
}

/** Selects a body that does not touch others. */
const selectFiltered = (page) =>
  page.evaluate(() => {
    const { viewer } = window.tenonPage;
    const pair = viewer.info.filteredPairs.find((one) => one.every((body) => body >= 0));
    viewer.select(viewer.info.bodies[pair[0]].path);
  });

async function walkTree(page) {
  const prims = await page.evaluate(() => window.tenonPage.viewer.info.bodies.map((b) => b.path));
  const thumb = prims.filter((path) => path.includes("thumb_2"));
  await page.locator("canvas").first().focus();
  await page.keyboard.press("/");
  await page.keyboard.type("thumb_2 BODY");
  const found = page.getByRole("treeitem");
  const paths = await found.evaluateAll((all) => all.map((item) => item.dataset.path));
  hold(paths.join() === thumb.join(), `found ${paths}, expected ${thumb}`);
  await found.first().click();
  hold((await selected(page)) === thumb[0], "a click in the tree selects another prim");
  await page.getByRole("searchbox").fill("no such prim");
  hold((await page.locator(".tree .status").textContent()) === "0 found", "what is not there is found");
  await page.getByRole("searchbox").fill("");
  await page.getByRole("treeitem").first().focus();
  const walked = [];
  for (const key of ["ArrowDown", "ArrowDown", "End", "Home", "ArrowDown", "ArrowRight"]) {
    await page.keyboard.press(key);
    walked.push(await page.evaluate(() => document.activeElement.dataset.path));
  }
  hold(new Set(walked).size > 3, `keys in the tree walk along ${walked}`);
  const at = walked[walked.length - 1];
  await page.keyboard.press("Enter");
  hold((await selected(page)) === at, "Enter does not select");
  await page.keyboard.press("Escape");
  hold((await selected(page)) === "", "Escape does not take the selection off");
}

const selected = (page) => page.evaluate(() => window.tenonPage.viewer.selected);

async function walkTabs(page) {
  const tabs = page.getByRole("tab");
  const names = await tabs.allTextContents();
  await tabs.first().click();
  for (const [i, name] of names.entries()) {
    const tab = tabs.nth(i);
    hold((await tab.getAttribute("aria-selected")) === "true", `the tab ${name} does not open`);
    const open = await page.getByRole("tabpanel").count();
    hold(open === 1, `${open} pages are open beside the tab ${name}`);
    await page.keyboard.press("ArrowRight");
  }
  const lines = await tabs.evaluateAll((all) => new Set(all.map((tab) => tab.offsetTop)).size);
  hold(lines <= 2, `the tabs ${names} are in ${lines} lines`);
  return names;
}

/** A click on the picture selects what is there, f looks at it, a at everything. */
async function walkPicture(page) {
  const at = await page.evaluate(() => {
    const { viewer } = window.tenonPage;
    const body = viewer.info.bodies.findIndex((one) => one.path.endsWith("r_base_link"));
    const box = viewer.renderer.domElement.getBoundingClientRect();
    const place = viewer.bodies[body].position.clone().fromArray(viewer.info.bodies[body].centerOfMass);
    viewer.bodies[body].localToWorld(place).project(viewer.camera);
    return [
      box.left + ((place.x + 1) / 2) * box.width,
      box.top + ((1 - place.y) / 2) * box.height,
      viewer.info.bodies[body].path,
    ];
  });
  const distance = () =>
    page.evaluate(() => {
      const { camera, controls } = window.tenonPage.viewer;
      return camera.position.distanceTo(controls.target);
    });
  await page.mouse.click(at[0], at[1]);
  hold((await selected(page)) === at[2], `a click selects ${await selected(page)}`);
  await page.evaluate(() => {
    const { viewer } = window.tenonPage;
    viewer.select(viewer.info.bodies.find((one) => one.path.includes("thumb_4")).path);
  });
  const far = await distance();
  await page.locator("canvas").first().focus();
  await page.keyboard.press("f");
  hold((await distance()) < 0.6 * far, "f does not look at the selection");
  await page.keyboard.press("a");
  hold(Math.abs((await distance()) - far) < 1e-6, "a does not look at everything");
  await page.mouse.move(at[0], at[1]);
  await page.mouse.wheel(0, -500);
  await until(async () => (await distance()) < 0.95 * far, "the wheel brings nothing nearer");
  await settled(page);
}

export const tests = {
  async switches_of_view(stage) {
    const viewer = await stage.view(stage.path("examples/inspire_hand/grasp.usda"));
    const page = await stage.live(viewer);
    await listen(page);
    await ask(page, "step", { count: 20 });
    await until(() => page.evaluate(() => window.heard.contacts?.count > 0), "contacts");
    await selectFiltered(page);
    const names = await walkSwitches(page);
    const all = Object.keys(expected);
    hold(names.length === all.length, `the page has the switches ${names}, expected ${all}`);
    return `${names.length} switches`;
  },

  async switches_of_report(stage) {
    const asset = stage.path("examples/inspire_hand/grasp.usda");
    const page = await stage.opened(stage.report(asset, "--duration", "0"));
    await selectFiltered(page);
    await walkSwitches(page);
  },

  async tree_tabs_and_keys(stage) {
    const asset = stage.path("examples/inspire_hand/inspire_hand.usda");
    const view = await stage.live(await stage.view(asset));
    const report = await stage.opened(stage.report(asset, "--duration", "0"));
    for (const page of [view, report]) {
      await walkTree(page);
      await walkTabs(page);
      await walkPicture(page);
    }
  },

  async the_motion_of_a_report_plays(stage) {
    const asset = stage.path("examples/inspire_hand/grasp.usda");
    const page = await stage.opened(stage.report(asset, "--duration", "2"));
    const bar = page.getByRole("group", { name: "Motion" });
    const time = () => page.evaluate(() => window.tenonPage.viewer.motion.time);
    const before = await pixels(page);
    await bar.getByRole("slider").fill("1.5");
    hold(Math.abs((await time()) - 1.5) < 1e-6, "the slider does not set the time");
    hold(differing(before, await pixels(page)) > 100, "nothing moves in the motion");
    await bar.getByRole("slider").fill("0");
    hold(differing(before, await pixels(page)) === 0, "the start looks otherwise than before");
    await button(page, "Play").click();
    await until(async () => (await time()) > 0.3, "the motion goes on");
    await button(page, "Pause").click();
    const stopped = await time();
    await settled(page);
    hold((await time()) === stopped, "Pause does not stop the motion");
    await page.locator("canvas").first().focus();
    await page.keyboard.press(",");
    hold((await time()) < stopped, "the key , does not step back");
  },
};
