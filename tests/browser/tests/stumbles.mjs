// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What people stumbled over: keys after a click on a switch, prims that were not found, pictures
// that went away with a simulation, and changed files that do not open.
import { readFileSync, writeFileSync } from "node:fs";
import { connect } from "node:net";
import { join } from "node:path";
import { ask, button, drawn, hold, listen, openTab, sceneOf, settled, until } from "../harness.mjs";
import { differing, pixels } from "../silhouette.mjs";

const fast = (name, x, speed) => `
    def Cube "${name}" (prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsCollisionAPI"])
    {
        double size = 1
        vector3f physics:velocity = (${speed}, 0, 0)
        double3 xformOp:translate = (${x}, 0, 1)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }`;

const others = `
    def Xform "plain"
    {
        def Scope "deep_below"
        {
        }
    }
    def Material "Paint"
    {
    }${fast("box", 0, 0)}`;

function written(stage, text, name = "scene.usda") {
  const asset = join(stage.folder(), name);
  writeFileSync(asset, text);
  return asset;
}

/** Boxes that PhysX cannot keep together. */
export const failing = (stage) =>
  written(stage, sceneOf(fast("a", 0, "1e12") + fast("b", 0.2, 0) + fast("c", 0.1, 0)));

const failed = (page) => page.evaluate(() => window.tenonPage.viewer.failed);
const places = (page) =>
  page.evaluate(() => window.tenonPage.viewer.bodies.map((one) => one.position.toArray()));
const wrong = (page) => page.locator(".messages .wrong");

async function searchRows(page, text) {
  await page.getByRole("searchbox").fill(text);
  const found = page.getByRole("treeitem");
  return found.evaluateAll((all) => all.map((item) => item.dataset.path));
}

export const tests = {
  async keys_work_wherever_the_mouse_was(stage) {
    const asset = stage.hand("grasp.usda");
    const page = await stage.live(await stage.view(asset));
    await listen(page);
    const clock = () => page.evaluate(() => window.heard.state?.time ?? 0);
    const colliders = page.getByLabel("Colliders");
    const clicks = {
      "a tab": () => openTab(page, "Show"),
      "a switch": async () => {
        await openTab(page, "Show");
        await page.getByLabel("Joint axes").click();
      },
      "a button of the head": () => button(page, "Look at it").click(),
      "Step": () => button(page, "Step").click(),
      "a menu": () => page.getByLabel("Speed").last().selectOption("0.5"),
      "the tree": () => page.getByRole("treeitem").first().click(),
    };
    for (const [place, click] of Object.entries(clicks)) {
      await click();
      const before = await colliders.isChecked();
      await page.keyboard.press("c");
      hold((await colliders.isChecked()) !== before, `c does nothing after a click on ${place}`);
      await button(page, "Step").click();
      await until(async () => (await clock()) > 0, "a step");
      await click();
      await page.keyboard.press("r");
      await until(async () => (await clock()) === 0, `r after a click on ${place}`);
      await click();
      await page.keyboard.press(".");
      await until(async () => (await clock()) > 0, `. after a click on ${place}`);
      await click();
      await page.keyboard.press(" ");
      await until(() => page.evaluate(() => window.heard.state.playing), `Space after ${place}`);
      await page.keyboard.press(" ");
      await until(() => page.evaluate(() => !window.heard.state.playing), `Space again, ${place}`);
      await page.keyboard.press("r");
    }
    // Text is text, and who came by Tab presses what has the focus.
    const before = await colliders.isChecked();
    await page.getByRole("searchbox").fill("");
    await page.getByRole("searchbox").press("c");
    hold((await page.getByRole("searchbox").inputValue()) === "c", "the search takes no c");
    hold((await colliders.isChecked()) === before, "typing switches the colliders");
    await page.getByRole("searchbox").fill("");
    await openTab(page, "Show");
    await page.keyboard.press("Tab");
    await page.keyboard.press("Shift+Tab");
    await page.getByRole("tab", { name: "Plots" }).focus();
    await page.keyboard.press(" ");
    hold(!(await page.evaluate(() => window.heard.state.playing)), "Space on a focused tab plays");
    return `${Object.keys(clicks).length} places`;
  },

  async help_lists_every_key(stage) {
    const page = await stage.live(await stage.view(stage.path("examples/inspire_hand/grasp.usda")));
    await openTab(page, "Show");
    await page.keyboard.press("?");
    const dialog = page.getByRole("dialog", { name: "Keys" });
    await dialog.waitFor();
    const listed = await dialog.locator("kbd").allTextContents();
    const shown = await page.locator(".layers label:visible kbd").allTextContents();
    for (const key of [...shown, "Space", ".", "r", "f", "a", "/", "Esc", "?"]) {
      hold(listed.filter((one) => one === key).length === 1, `the key ${key} stands ${listed}`);
    }
    await page.keyboard.press("Escape");
    await dialog.waitFor({ state: "hidden" });
    const report = await stage.opened(
      stage.report(stage.path("examples/inspire_hand/grasp.usda"), "--duration", "0.2"),
    );
    await button(report, "Keys").click();
    const keys = await report.getByRole("dialog", { name: "Keys" }).locator("kbd").allTextContents();
    hold(keys.includes(",") && !keys.includes("r"), `the report lists ${keys}`);
    return `${listed.length} keys`;
  },

  async the_first_steps_are_shown_once(stage) {
    const viewer = await stage.view(stage.path("examples/inspire_hand/inspire_hand.usda"));
    const page = await stage.live(viewer, { tour: true });
    const card = page.getByRole("region", { name: "First steps" });
    const next = card.getByRole("button", { name: "Next" });
    await card.getByText("1 of 5").waitFor();
    await next.focus(); // all of it by keyboard
    for (const step of [2, 3, 4, 5]) {
      await page.keyboard.press("Enter");
      await card.getByText(`${step} of 5`).waitFor();
      hold((await page.locator(".toured").count()) === 1, `step ${step} frames nothing`);
    }
    await card.getByRole("button", { name: "Done" }).press("Enter");
    await card.waitFor({ state: "hidden" });
    hold((await page.locator(".toured").count()) === 0, "the frame stays");
    const fresh = await page.context().newPage();
    const hidden = async (where) => {
      await fresh.goto(where);
      await drawn(fresh);
      hold(!(await fresh.getByRole("region", { name: "First steps" }).isVisible()), `shown again: ${where}`);
    };
    await hidden(viewer.url);
    // Another run of the program has another port.
    await hidden((await stage.view(stage.path("examples/inspire_hand/inspire_hand.usda"))).url);
    await page.keyboard.press("?");
    await page.getByRole("button", { name: "First steps" }).click();
    await card.getByText("1 of 5").waitFor();
    await page.keyboard.press("Escape");
    await card.waitFor({ state: "hidden" });
    // A link to a view, and a report, show what they are for.
    const linked = await stage.page({ tour: true });
    await linked.goto(`${viewer.url}#tab=Joints`);
    await drawn(linked);
    hold(!(await linked.getByRole("region", { name: "First steps" }).isVisible()), "shown over a link");
  },

  async undo_and_redo_by_keys(stage) {
    const asset = written(stage, sceneOf(fast("box", 0, 0)));
    const before = readFileSync(asset, "utf8");
    const page = await stage.live(await stage.view(asset));
    await listen(page);
    await ask(page, "set", { object: "/World/box.size", value: "2" });
    const after = readFileSync(asset, "utf8");
    hold(after !== before, "the edit changes nothing");
    await until(() => button(page, "Undo").isEnabled(), "there is something to take back");
    await page.keyboard.press("Control+z");
    await until(() => readFileSync(asset, "utf8") === before, "the bytes come back");
    await until(() => button(page, "Redo").isEnabled(), "there is something to make again");
    await page.keyboard.press("Control+Shift+Z");
    await until(() => readFileSync(asset, "utf8") === after, "the edit comes again");
  },

  async every_prim_is_found(stage) {
    const asset = written(stage, sceneOf(others));
    const page = await stage.live(await stage.view(asset));
    const prims = stage.tenon(["tree", "--json", asset]).prims.map((one) => one.path);
    hold(prims.length === 6, `the scene has the prims ${prims}`);
    await until(
      () => page.evaluate((n) => window.tenonPage.panel.tree.size >= n, prims.length),
      "all prims",
    );
    for (const path of prims) {
      const name = path.slice(path.lastIndexOf("/") + 1);
      const found = await searchRows(page, name);
      hold(found.includes(path), `${path} is not found by ${name}: ${found}`);
    }
    hold((await searchRows(page, "material")).join() === "/World/Paint", "no prim by its type");
    await page.getByRole("treeitem").first().click();
    await page.locator(".inspector h2").filter({ hasText: "/World/Paint" }).waitFor();
    return `${prims.length} prims`;
  },

  async results_are_told_apart(stage) {
    const page = await stage.live(await stage.view(stage.path("examples/inspire_hand/grasp.usda")));
    const paths = await searchRows(page, "thumb");
    hold(paths.length > 10, `${paths.length} are found`);
    const cut = await page.locator(".tree .row bdi:first-child").evaluateAll((all) =>
      all
        .filter((one) => one.parentElement.classList.contains("row"))
        .filter((one) => one.getBoundingClientRect().right > one.parentElement.getBoundingClientRect().right + 1)
        .map((one) => one.textContent),
    );
    hold(cut.length === 0, `these names are cut off: ${cut}`);
    const ends = await page.locator(".tree .above").evaluateAll((all) =>
      all.filter((one) => {
        const text = one.firstElementChild.getBoundingClientRect();
        return Math.abs(text.right - one.getBoundingClientRect().right) > 1 && text.width > one.clientWidth;
      }).length,
    );
    hold(ends === 0, `${ends} paths are cut at their ends`);
  },

  async a_failed_simulation_keeps_its_picture(stage) {
    const asset = failing(stage);
    const page = await stage.live(await stage.view(asset, "--engine", "physx"));
    await listen(page);
    await settled(page);
    const before = await places(page);
    await ask(page, "play");
    await wrong(page).waitFor();
    await settled(page);
    const body = await failed(page);
    hold(/^\/World\/[abc]$/.test(body), `it names ${body}: ${await page.locator(".messages").textContent()}`);
    const said = await page.locator(".messages").textContent();
    hold(said.includes(`<${body}>`), `the message does not name ${body}: ${said}`);
    const [finite, red] = await page.evaluate((path) => {
      const { viewer } = window.tenonPage;
      const mesh = viewer.nodeAt(path).children.find((one) => one.isMesh || one.children.length);
      let emits = false;
      mesh.traverse((one) => (emits ||= one.isMesh && one.material.emissive.r > one.material.emissive.b));
      return [viewer.bodies.every((one) => one.position.toArray().every(Number.isFinite)), emits];
    }, body);
    hold(finite, "bodies are drawn nowhere");
    hold(red, `${body} is not marked`);
    const blank = await pixels(page).then(({ pixels: data, ...rest }) => ({
      ...rest,
      pixels: Buffer.alloc(data.length, data.subarray(0, 4)),
    }));
    hold(differing(await pixels(page), blank) > 1000, "the picture is empty");
    // Who comes later is told the same.
    await page.reload();
    await drawn(page);
    await until(async () => (await failed(page)) === body, "the mark in a page that comes later");
    await page.locator(".messages").getByRole("button", { name: "Reset" }).click();
    await until(async () => (await failed(page)) === "", "the mark goes away");
    hold((await wrong(page).count()) === 0, "the message stays after Reset");
    await settled(page);
    const after = await places(page);
    const off = Math.max(...before.flat().map((x, i) => Math.abs(x - after.flat()[i])));
    hold(off < 1e-5, `Reset leaves bodies ${off} m away from the start`);
  },

  async a_broken_file_is_named_and_the_picture_is_old(stage) {
    const asset = written(stage, sceneOf(fast("box", 0, 0)));
    const good = readFileSync(asset, "utf8");
    const page = await stage.live(await stage.view(asset, "--watch"));
    const note = page.locator(".old");
    hold(!(await note.isVisible()), "the picture is old from the start");
    writeFileSync(asset, good.replace("double size = 1", "double size ="));
    await note.waitFor();
    for (const place of [note, wrong(page)]) {
      const text = await place.textContent();
      hold(/scene\.usda:\d+: /.test(text), `the file is not named: ${text}`);
    }
    writeFileSync(asset, good);
    await note.waitFor({ state: "hidden" });
  },

  async the_tree_stays_open(stage) {
    const asset = stage.hand();
    const page = await stage.live(await stage.view(asset));
    await listen(page);
    const joint = "/inspire_hand/Physics/right_thumb_2_joint";
    await page.evaluate((path) => window.tenonPage.viewer.select(path), joint);
    const row = page.locator(`[role=treeitem][data-path="${joint}"][aria-selected=true]`);
    await row.waitFor();
    await ask(page, "set", { object: `${joint}.physics:upperLimit`, value: "30" });
    await until(() => page.evaluate(() => window.heard.scene?.why === "edit"), "the edit");
    await drawn(page);
    await row.waitFor();
  },

  async without_a_server_nothing_is_offered(stage) {
    const viewer = await stage.view(stage.hand());
    const page = await stage.live(viewer, { quiet: false });
    await page.evaluate((path) => window.tenonPage.viewer.select(path), "/inspire_hand/Physics/right_thumb_2_joint");
    await page.locator('.property[data-property="physics:upperLimit"] summary').click();
    await page.locator(".editor").waitFor();
    await openTab(page, "Move");
    await viewer.stop();
    await page.locator(".old").waitFor();
    const left = () =>
      page.evaluate(() =>
        [...document.querySelectorAll(".mover input, .live-tools button, .live-tools select, .editor input, .editor button")]
          .filter((one) => !one.disabled)
          .map((one) => one.textContent || one.getAttribute("aria-label") || one.type),
      );
    hold((await left()).length === 0, `these can still be used: ${await left()}`);
    // What was simulated and the picture stay.
    await page.locator("canvas").first().focus();
    await page.keyboard.press("1");
  },

  async undo_says_what_it_did(stage) {
    const page = await stage.live(await stage.view(stage.hand()));
    const said = () => page.locator(".messages").textContent();
    const object = "/inspire_hand/Physics/right_thumb_2_joint.physics:upperLimit";
    await page.evaluate((path) => window.tenonPage.viewer.select(path), object.split(".")[0]);
    await page.locator('.property[data-property="physics:upperLimit"] summary').click();
    const form = page.locator(".editor");
    await form.getByRole("textbox").fill("30");
    await form.getByRole("button", { name: "Set" }).click();
    await until(async () => (await said()).includes("-> 30"), "the edit is told");
    await button(page, "Undo").click();
    await until(async () => (await said()).includes("taken back"), "that it was taken back");
    hold(!(await said()).includes("-> 30"), `the bar says ${await said()}`);
    await page.locator(".effect").waitFor({ state: "detached" });
    await page.locator(".inspector h2").filter({ hasText: "right_thumb_2_joint" }).waitFor();
  },

  async a_page_too_many_says_so(stage) {
    const viewer = await stage.view(stage.path("examples/scenes/box_on_box.usda"));
    const sockets = await Promise.all(
      Array.from({ length: 32 }, () =>
        new Promise((go, fail) => {
          const socket = connect(Number(new URL(viewer.url).port), "127.0.0.1", () => go(socket));
          socket.on("error", fail);
        }),
      ),
    );
    const page = await stage.page({ quiet: false });
    const answer = await page.goto(viewer.url);
    hold(answer.status() === 503, `the answer is ${answer.status()}`);
    hold((await page.locator("body").textContent()).includes("Close some of its pages"), "no word about why");
    sockets.forEach((socket) => socket.destroy());
    // A page whose script is refused says the same.
    const empty = await stage.page({ quiet: false });
    await empty.route("**/live.js", (route) => route.fulfill({ status: 503, body: "" }));
    await until(async () => (await empty.goto(viewer.url)).status() === 200, "a free connection");
    hold(await empty.getByText("too many connections").isVisible(), "an empty page without a word");
  },
};
