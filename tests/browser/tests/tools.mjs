// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Tools of the page: parts that are hidden, shown alone and seen through, several selected, measuring,
// a camera that follows a body, one without perspective and those of the asset, fields beside sliders,
// and the address.
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { ask, button, drawn, hold, listen, near, openTab, sceneOf, settled, until } from "../harness.mjs";
import { differing, pixels } from "../silhouette.mjs";

const hand = (stage) => stage.path("examples/inspire_hand/inspire_hand.usda");
const grasp = (stage) => stage.path("examples/inspire_hand/grasp.usda");

const cube = (name, at, more = "", size = 0.1) => `
    def Cube "${name}"${more}
    {
        double size = ${size}
        double3 xformOp:translate = (${at})
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }`;

const rigid = ' (prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsCollisionAPI"])';

/** Two boxes, 0.5 m apart along X. */
const boxes = sceneOf(cube("a", "0, 0, 0", rigid) + cube("b", "0.5, 0, 0", rigid));

/** A wheel without limits that a drive turns by its damping alone, and a slide that gravity lets be. */
const wheel = sceneOf(`
    def Cube "base" (prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsCollisionAPI"])
    {
        double size = 0.1
        bool physics:kinematicEnabled = true
    }
    def Cube "wheel" (prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"])
    {
        double size = 0.1
        float physics:mass = 1
        double3 xformOp:translate = (0, 0, 0.3)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
    def PhysicsRevoluteJoint "axle" (prepend apiSchemas = ["PhysicsDriveAPI:angular"])
    {
        rel physics:body0 = </World/base>
        rel physics:body1 = </World/wheel>
        point3f physics:localPos0 = (0, 0, 0.3)
        uniform token physics:axis = "Z"
        float drive:angular:physics:damping = 10
    }`);

const camera = (name, at, more) => `
        def Camera "${name}"
        {
            float focalLength = 20
            float horizontalAperture = 40
            float verticalAperture = 20
            ${more}
            double3 xformOp:translate = (${at})
            float xformOp:rotateX = 90
            uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateX"]
        }`;

/** A body with a camera 2 m before it, a camera that stands still, and one without perspective. */
const cameras = sceneOf(`
    def Xform "head" (prepend apiSchemas = ["PhysicsRigidBodyAPI"])
    {${cube("shape", "0, 0, 0", ' (prepend apiSchemas = ["PhysicsCollisionAPI"])')}${camera("eye", "0, -2, 0", "")}
    }${camera("still", "1, -3, 0", "")}${camera("flat", "0, 0, 0", 'token projection = "orthographic"')}`);

function written(stage, text) {
  const asset = join(stage.folder(), "scene.usda");
  writeFileSync(asset, text);
  return asset;
}

const view = (page, read) => page.evaluate((code) => new Function("v", `return (${code})`)(window.tenonPage.viewer), read);
const select = (page, path) => page.evaluate((p) => window.tenonPage.viewer.select(p), path);
const key = async (page, name) => {
  await page.locator("canvas").first().focus();
  await page.keyboard.press(name);
  await settled(page);
};
const visible = (page) =>
  page.evaluate(() => window.tenonPage.viewer.kinds.visual.filter((one) => one.visible).map((one) => window.tenonPage.viewer.bodyPathOf(one)));

/** Where a point of the world, in the axes of the asset, is in the window. */
const place = (page, point) =>
  page.evaluate((at) => {
    const { viewer } = window.tenonPage;
    const box = viewer.renderer.domElement.getBoundingClientRect();
    const seen = viewer.camera.position.clone().fromArray(at);
    viewer.root.localToWorld(seen).project(viewer.eye.current(viewer.room));
    return [box.left + ((seen.x + 1) / 2) * box.width, box.top + ((1 - seen.y) / 2) * box.height];
  }, point);

const row = (page, joint, what) =>
  page.locator(`.mover[data-joint="${joint}"] .slider`).filter({ hasText: what }).first();

export const tests = {
  async parts_are_hidden_shown_alone_and_seen_through(stage) {
    const asset = stage.hand();
    const page = await stage.live(await stage.view(asset));
    await listen(page);
    const before = await pixels(page);
    const all = await visible(page);
    const body = all.find((path) => path.endsWith("right_index_1"));
    await select(page, body);
    await key(page, "h");
    hold(!(await visible(page)).includes(body), "h does not hide the selection");
    const left = new Set(all).size - new Set(await visible(page)).size;
    hold(left === 1, `${left} bodies are hidden`);
    hold((await page.locator(".parts-note").textContent()).startsWith("1 hidden"), "it is not said");
    // It stays hidden when the asset is read again.
    await ask(page, "set", { object: "/inspire_hand/Physics/right_thumb_2_joint.physics:upperLimit", value: "30" });
    await until(() => page.evaluate(() => window.heard.scene?.why === "edit"), "the edit");
    await drawn(page);
    hold(!(await visible(page)).includes(body), "an edit shows it again");
    await key(page, "h");
    hold((await visible(page)).includes(body), "h again does not show it");
    await key(page, "b");
    hold([...new Set(await visible(page))].join() === body, `b shows ${await visible(page)}`);
    await key(page, "b");
    hold((await visible(page)).length === all.length, "b again does not show everything");
    await key(page, "k");
    const glass = await view(page, `v.kinds.visual.filter((n) => { let g = false; n.traverse((m) => { g ||= m.isMesh && m.material.transparent && m.material.opacity < 0.5; }); return g; }).map((n) => v.bodyPathOf(n))`);
    hold([...new Set(glass)].join() === body, `k lets one see through ${glass}`);
    await page.locator(".parts-note").getByRole("button", { name: "Show everything" }).click();
    await select(page, "");
    hold(differing(before, await pixels(page)) === 0, "something is left of it");
    // A prim above hides all below it; the menu sees through everything of a kind.
    await select(page, "/inspire_hand");
    await key(page, "h");
    hold((await visible(page)).length === 0, "a prim above hides not all below");
    await key(page, "u");
    await page.locator("summary", { hasText: "Parts" }).click();
    await page.getByLabel("See through visible shapes").check();
    const through = await view(page, "v.visibility.solid.size");
    hold(through >= all.length, `${through} meshes are seen through`);
  },

  async several_are_selected(stage) {
    const page = await stage.live(await stage.view(written(stage, boxes)));
    const rows = page.getByRole("treeitem");
    await rows.filter({ hasText: /^a/ }).last().click();
    await rows.filter({ hasText: /^b/ }).last().click({ modifiers: ["Control"] });
    const selection = () => view(page, "v.selection().join()");
    hold((await selection()) === "/World/b,/World/a", `selected are ${await selection()}`);
    hold((await page.locator('[role=treeitem][aria-selected="true"]').count()) === 2, "the tree marks others");
    const text = await page.locator(".inspector").textContent();
    hold(text.includes("2 selected") && text.includes("500 mm"), `it says ${text.slice(0, 200)}`);
    const marked = await view(page, "new Set([...v.marks.plain.keys()].map((one) => v.bodyPathOf(one))).size");
    hold(marked === 2, `${marked} are marked in the picture`);
    // By mouse in the picture: added and taken off.
    const [x, y] = await place(page, [0, 0, 0]);
    await page.keyboard.down("Control");
    await page.mouse.click(x, y);
    await page.keyboard.up("Control");
    hold((await selection()) === "/World/b", `after Ctrl+click selected are ${await selection()}`);
    await key(page, "Escape");
    hold((await selection()) === "", "Esc leaves something selected");
  },

  async distances_and_angles_are_measured(stage) {
    const page = await stage.live(await stage.view(written(stage, boxes)));
    await page.locator("canvas").first().focus();
    await page.keyboard.press("5"); // from +Z: the tops of both boxes
    await page.keyboard.press("0");
    await settled(page);
    await button(page, "Measure").click();
    const said = () => page.locator(".measured").textContent();
    hold((await said()).includes("first point"), await said());
    const click = async (...points) => {
      for (const point of points) {
        await page.mouse.click(...(await place(page, point)));
      }
    };
    await click([0, 0, 0.05], [0.5, 0, 0.05]);
    const [distance] = (await said()).match(/[\d.]+/);
    near(Number(distance), 500, 4, `the distance that is said: ${await said()}`);
    hold((await view(page, "v.selected")) === "", "measuring selects");
    await click([0.5, 0.04, 0.05]);
    const angle = Number((await said()).match(/angle ([\d.]+) deg/)[1]);
    near(angle, 90, 4, "the angle");
    // Points move with their bodies.
    await click([0, 0, 0.05], [0.5, 0, 0.05]);
    await page.evaluate(() => {
      const { viewer, history } = window.tenonPage;
      const frame = history.frame.slice();
      frame[1 + 7] += 0.5;
      viewer.setPoses(frame);
    });
    near(Number((await said()).match(/[\d.]+/)[0]), 1000, 4, "the distance after a body has moved");
    await button(page, "Measure").click();
    hold(!(await page.locator(".measured").isVisible()), "it goes on measuring");
  },

  async the_camera_has_sides_and_no_perspective(stage) {
    const page = await stage.live(await stage.view(written(stage, boxes)));
    const away = () => view(page, "v.camera.position.clone().sub(v.controls.target).normalize().applyQuaternion(v.root.quaternion.clone().invert()).toArray()");
    const sides = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]];
    for (const [i, side] of sides.entries()) {
      await key(page, String(i + 1));
      (await away()).forEach((x, k) => near(x, side[k], 1e-3, `key ${i + 1}, axis ${k}`));
    }
    // Without perspective, what is farther away is as large.
    await key(page, "1");
    const widths = async () => {
      const width = async (x) => {
        const [a, b] = [await place(page, [x, -0.05, 0]), await place(page, [x, 0.05, 0])];
        return Math.hypot(a[0] - b[0], a[1] - b[1]);
      };
      return (await width(0)) / (await width(0.5));
    };
    const perspective = await widths();
    hold(Math.abs(perspective - 1) > 0.05, `with perspective the widths are as ${perspective}`);
    await key(page, "0");
    near(await widths(), 1, 1e-4, "the widths without perspective");
    const [x, y] = await place(page, [0.5, 0, 0.05]);
    await page.mouse.click(x, y);
    hold((await view(page, "v.selected")) === "/World/b", "a click selects another prim than it shows");
    await page.locator("summary", { hasText: "Camera" }).click();
    hold(await page.getByLabel("Orthographic").isChecked(), "the menu does not say so");
    await page.getByRole("button", { name: "From +X" }).click();
    near((await away())[0], 1, 1e-3, "the menu");
  },

  async the_camera_follows_a_body(stage) {
    const page = await stage.live(await stage.view(written(stage, boxes)));
    await listen(page);
    await select(page, "/World/a");
    await key(page, "n");
    const at = async () => place(page, await view(page, "v.root.worldToLocal(v.bodies[0].getWorldPosition(v.camera.position.clone())).toArray()"));
    const before = await at();
    await ask(page, "step", { count: 200 });
    await settled(page);
    const fallen = await view(page, "v.root.worldToLocal(v.bodies[0].getWorldPosition(v.camera.position.clone())).toArray()");
    hold(fallen[2] < -0.1, `it has fallen to ${fallen[2]}`);
    const after = await at();
    near(after[0], before[0], 0.5, "where it is seen");
    near(after[1], before[1], 0.5, "where it is seen");
    await key(page, "n");
    const camera = await view(page, "v.camera.position.toArray().join()");
    await ask(page, "step", { count: 50 });
    await settled(page);
    hold((await view(page, "v.camera.position.toArray().join()")) === camera, "it goes on following");
  },

  async the_cameras_of_the_asset_are_looked_through(stage) {
    const asset = written(stage, cameras);
    const page = await stage.live(await stage.view(asset));
    await listen(page);
    const at = (where) => view(where, "v.root.worldToLocal(v.camera.position.clone()).toArray()");
    const half = (where) => view(where, "Math.tan(v.camera.fov * Math.PI / 360)");
    await page.locator("summary", { hasText: "Camera" }).click();
    const listed = await page.getByRole("group", { name: "Cameras of the asset" }).getByRole("button").allTextContents();
    hold(listed.join() === "eye,still", `the menu lists ${listed}`);
    await page.getByRole("button", { name: "eye", exact: true }).click();
    (await at(page)).forEach((x, k) => near(x, [0, -2, 0][k], 1e-4, `axis ${k} of its place`));
    // It sees 1 sideways and 0.5 upward, and all of that is in the picture.
    near(await half(page), Math.max(0.5, 1 / (await view(page, "v.camera.aspect"))), 1e-4, "its angle");
    hold(await page.getByText("Seen through eye").isVisible(), "nothing says through which camera");
    await ask(page, "step", { count: 200 });
    await settled(page);
    const body = await view(page, "v.bodies[0].position.toArray()");
    hold(body[2] < -0.1, `it has fallen to ${body[2]}`);
    (await at(page)).forEach((x, k) => near(x, [0, -2, body[2]][k], 1e-4, `axis ${k} as it falls`));
    await until(() => page.evaluate(() => location.hash.includes("through=/World/head/eye")), "the camera in the address");
    const other = await stage.page();
    await other.goto(page.url());
    await drawn(other);
    await until(() => view(other, "v.eye.through?.path === '/World/head/eye'"), "the camera of the address");
    near(await half(other), await half(page), 1e-4, "the angle of the address");
    // The mouse takes over.
    const box = await page.locator(".picture canvas").boundingBox();
    await page.mouse.move(box.x + 200, box.y + 200);
    await page.mouse.down();
    await page.mouse.move(box.x + 260, box.y + 220, { steps: 3 });
    await page.mouse.up();
    hold((await view(page, "v.eye.through")) === null, "it is still looked through");
    near(await view(page, "v.camera.fov"), 35, 1e-6, "the usual angle");
  },

  async a_selected_joint_is_marked(stage) {
    const page = await stage.live(await stage.view(hand(stage)));
    const before = await pixels(page);
    await select(page, "/inspire_hand/Physics/right_index_1_joint");
    hold(differing(before, await pixels(page)) > 30, "nothing marks the joint");
    await select(page, "");
    hold(differing(before, await pixels(page)) === 0, "a mark is left");
  },

  async numbers_velocities_and_efforts_are_set(stage) {
    const page = await stage.live(await stage.view(written(stage, wheel)));
    await listen(page);
    const joint = "/World/axle";
    // 225 degrees by the field: the slider of a joint without limits reaches as far.
    const position = row(page, joint, "position");
    await position.locator("input[type=number]").fill("225");
    await position.locator("input[type=number]").press("Enter");
    const angle = () => page.evaluate(() => (window.heard.plots?.joints[0][0] * 180) / Math.PI);
    await until(async () => Math.abs((await angle()) - 225) < 0.01, "the joint at 225 degrees");
    near(Number(await position.locator("input[type=range]").inputValue()), (225 * Math.PI) / 180, 1e-6, "the slider");
    hold((await row(page, joint, "drive to").count()) === 0, "a drive without stiffness has a position");
    // A drive of damping alone turns it.
    const velocity = row(page, joint, "drive at").locator("input[type=number]");
    await velocity.fill("90");
    await velocity.press("Enter");
    await until(() => page.evaluate(() => window.heard.plots !== undefined), "plots");
    await ask(page, "step", { count: 400 });
    const turning = await page.evaluate(() => (window.heard.plots.velocities[0][0] * 180) / Math.PI);
    near(turning, 90, 0.1, "the velocity that the drive reaches");
    // An effort on top of it.
    await page.locator(`.mover[data-joint="${joint}"] summary`).click();
    const effort = row(page, joint, "push with").locator("input[type=number]");
    await effort.fill("20");
    await effort.press("Enter");
    await ask(page, "step", { count: 400 });
    const pushed = await page.evaluate(() => (window.heard.plots.velocities[0][0] * 180) / Math.PI);
    // Steady: damping * (velocity - target) = effort; 20 N m by 10 N m s/deg are 2 deg/s more.
    near(pushed, 92, 0.05, "the velocity with an effort");
  },

  async a_follower_names_its_leader(stage) {
    const page = await stage.live(await stage.view(hand(stage)));
    const follower = page.locator(".mover").filter({ hasText: "follows" }).first();
    await openTab(page, "Move");
    hold(await follower.locator("input[type=range]").first().isDisabled(), "a follower is moved alone");
    const leader = follower.locator(".status button");
    const path = await leader.getAttribute("title");
    await leader.click();
    hold((await view(page, "v.selected")) === path && path.includes("_joint"), `it leads to ${path}`);
  },

  async the_address_opens_the_same_view(stage) {
    const viewer = await stage.view(grasp(stage));
    const page = await stage.live(viewer);
    await listen(page);
    const joint = await page.evaluate(() => window.tenonPage.viewer.info.joints[3].path);
    const body = await page.evaluate(() => window.tenonPage.viewer.info.bodies[2].path);
    await select(page, body);
    await key(page, "h");
    await key(page, "c");
    await key(page, "g");
    await key(page, "2");
    await key(page, "0");
    await select(page, joint);
    await openTab(page, "Plots");
    await page.getByLabel("Signal of the prim").selectOption("velocity");
    await button(page, "Add").click();
    await ask(page, "step", { count: 50 });
    const state = (where) =>
      where.evaluate(() => {
        const { history, panel, viewer } = window.tenonPage;
        return JSON.stringify([
          viewer.selected,
          viewer.camera.position.toArray().map((x) => x.toFixed(4)),
          viewer.eye.orthographic,
          [...viewer.visibility.hidden],
          panel.layers.changed(),
          panel.tab,
          history.last.toFixed(3),
          [...document.querySelectorAll(".legend li")].map((one) => one.title),
        ]);
      });
    await until(() => page.evaluate(() => location.hash.includes("time=")), "the time in the address");
    await until(() => page.evaluate(() => location.hash.includes("plots=")), "the plots in the address");
    const url = page.url();
    const token = new URL(viewer.url).pathname.split("/")[1];
    hold(token.length >= 16 && !new URL(url).hash.includes(token), "the token is in what is shared");
    const wanted = await state(page);
    hold(JSON.parse(wanted)[0] === joint && JSON.parse(wanted)[3][0] === body, wanted);
    // Another run of the program, another token: what stands behind # shows the same.
    await ask(page, "pause");
    const second = await stage.view(grasp(stage));
    const other = await stage.page();
    await other.goto(second.url + new URL(url).hash);
    await drawn(other);
    const same = async () => (await state(other)) === wanted;
    await until(same, "the same view", 20_000).catch(async () => {
      throw new Error(`it shows ${await state(other)}, expected ${wanted}`);
    });
    // What is no address of a view does no harm.
    const third = await stage.page();
    await third.goto(`${second.url}#camera=a,b&prim=${"/x".repeat(3000)}&tab=none&time=1e99&show=nothing&plots=,,`);
    await drawn(third);
  },
};
