// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The panels of pairs, drives, gains and poses, and fixes of findings, on copies of the example hand:
// tables and tests say what the verbs say, what is written is shown before and comes back by Undo.
import { existsSync, readFileSync, readdirSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { ask, button, hold, listen, near, openTab, sceneOf, settled, until } from "../harness.mjs";

const root = "/inspire_hand";
const hinge = `${root}/Physics/right_index_1_joint`;
const nameOf = (path) => path.slice(path.lastIndexOf("/") + 1);

/** All text below a folder, without the files of a save that is on its way. */
function content(folder) {
  const names = readdirSync(folder, { recursive: true, withFileTypes: true }).filter(
    (one) => one.isFile() && !one.name.startsWith(".tenon-"),
  );
  return names
    .map((one) => join(one.parentPath, one.name))
    .sort()
    .map((path) => `${path}\n${readFileSync(path, "latin1")}`)
    .join("\n");
}

/** The page of the tab that is open. */
const shown = (page) => page.locator("[role=tabpanel]:visible");
const dialog = (page) => page.getByRole("dialog", { name: "What will be written" });

/** Opens a tab of a viewer of the hand. */
async function panel(stage, tab, options = [], more = {}) {
  const asset = stage.hand();
  const page = await stage.live(await stage.view(asset, ...options), more);
  await listen(page);
  await ask(page, "reset"); // so that the scene is heard
  await openTab(page, tab);
  return { asset, page, before: content(dirname(asset)) };
}

/** Saves by a button: the difference is shown, is not written when refused, and is written then. */
async function saved(page, asset, press, words) {
  const before = content(dirname(asset));
  await press();
  await dialog(page).waitFor();
  const told = await dialog(page).locator(".diff").allTextContents();
  for (const word of words) {
    hold(told.join("\n").includes(word), `the difference has no ${word}: ${told.join("\n").slice(0, 600)}`);
  }
  hold(/^\+[^+]/m.test(told.join("\n")), "the difference adds no line");
  await dialog(page).getByRole("button", { name: "Do not write" }).click();
  await dialog(page).waitFor({ state: "detached" });
  hold(content(dirname(asset)) === before, "it is written though nobody wants it");
  await press();
  await dialog(page).waitFor();
  await dialog(page).getByRole("button", { name: "Write", exact: true }).click();
  await until(() => content(dirname(asset)) !== before, "the file changes");
  await until(() => page.evaluate(() => window.heard.scene?.why === "edit"), "the edit is told");
}

/** Undo brings the bytes back. */
async function undone(page, asset, before) {
  await until(() => button(page, "Undo").isEnabled(), "there is something to take back");
  await button(page, "Undo").click();
  await until(() => content(dirname(asset)) === before, "the bytes come back");
}

const rowOf = (page, table, joint) => page.locator(`table.${table} tr[data-joint="${joint}"]`);

export const tests = {
  async pairs_are_listed_shown_and_filtered(stage) {
    const { asset, page, before } = await panel(stage, "Pairs");
    await shown(page).getByLabel("Postures to look at").fill("200");
    await button(page, "Look for contacts").click();
    await page.locator("table.pairs").waitFor();
    const told = stage.tenon(["pairs", "--json", asset, "--sample", "200"]);
    const rows = await page.locator("table.pairs tbody tr").count();
    hold(rows === told.pairs.length, `${rows} rows, tenon pairs lists ${told.pairs.length}`);
    const free = told.pairs.find((one) => one.filtered === "no");
    const names = `${nameOf(free.bodyA)} and ${nameOf(free.bodyB)}`;
    await button(page, `Select ${names}`).click();
    const both = await page.evaluate(() => window.tenonPage.viewer.selection());
    hold([free.bodyA, free.bodyB].every((one) => both.includes(one)), `it selects ${both}`);
    hold((await page.evaluate(() => window.tenonPage.panel.tab)) === "Pairs", "the tab changes");
    const joined = told.pairs.find((one) => one.filters.some((why) => why.property === "physics:collisionEnabled"));
    const fixed = page.getByLabel(`Keep ${nameOf(joined.bodyA)} and ${nameOf(joined.bodyB)} apart`);
    hold((await fixed.isChecked()) && (await fixed.isDisabled()), "what a joint keeps apart can be ticked off");
    await page.getByLabel(`Keep ${names} apart`).check();
    await saved(page, asset, () => button(page, "Save pairs...").click(), ["filteredPairs"]);
    const after = stage.tenon(["pairs", "--json", asset, "--sample", "200"]).pairs;
    const now = after.find((one) => one.bodyA === free.bodyA && one.bodyB === free.bodyB);
    hold(now.filtered === "yes", `the pair is ${now.filtered} filtered`);
    await until(() => page.getByLabel(`Keep ${names} apart`).isChecked(), "the table follows");
    await page.getByLabel(`Keep ${names} apart`).uncheck();
    await button(page, "Save pairs...").click();
    await dialog(page).getByRole("button", { name: "Write", exact: true }).click();
    await until(
      () => stage.tenon(["pairs", "--json", asset, "--sample", "0"]).pairs.every((one) => one.bodyA !== free.bodyA || one.bodyB !== free.bodyB || one.filtered === "no"),
      "the filter goes",
    );
    await button(page, "Undo").click();
    await until(() => page.evaluate(() => window.heard.scene.why === "undo"), "the first undo");
    await undone(page, asset, before);
    return `${rows} pairs`;
  },

  async a_search_for_pairs_is_cancelled(stage) {
    const { page } = await panel(stage, "Pairs");
    await page.evaluate(() => {
      window.progress = [];
      window.tenonPage.session.connection.addEventListener("progress", (event) => window.progress.push(event.detail.done));
    });
    await shown(page).getByLabel("Postures to look at").fill("10000");
    await button(page, "Look for contacts").click();
    await until(() => page.evaluate(() => window.progress.length > 1), "progress");
    const busy = await page.evaluate(() => window.tenonPage.session.connection.ask("drives").then(() => "", (fault) => fault.finding.rule));
    hold(busy === "live.busy", `a second long request: ${busy || "is taken"}`);
    await button(page, "Cancel").click();
    await until(async () => (await page.locator(".messages").textContent()).includes("Ended"), "it ends");
    hold((await page.locator("table.pairs").count()) === 0, "a search that was ended has a table");
    const heard = await page.evaluate(() => window.progress);
    hold(heard.every((one, i) => one >= 0 && one <= 1 && (i === 0 || one >= heard[i - 1])), `progress ${heard}`);
    hold(heard.at(-1) < 1, "it was done before it was ended");
    // Then another one may come.
    await shown(page).getByLabel("Postures to look at").fill("10");
    await button(page, "Look for contacts").click();
    await page.locator("table.pairs").waitFor();
  },

  async drives_are_listed_and_limited(stage) {
    const { asset, page, before } = await panel(stage, "Drives");
    await page.locator("table.drives").waitFor();
    const told = stage.tenon(["drives", "--json", asset, "--sample", "100"], { fails: true }).drives;
    hold((await page.locator("table.drives tbody tr").count()) === told.length, `tenon drives lists ${told.length}`);
    const one = told.find((drive) => drive.joint === hinge);
    const row = rowOf(page, "drives", hinge);
    const text = await row.textContent();
    hold(text.includes(`${Number(one.weight.toPrecision(3))} N m`), `the weight is not ${one.weight}: ${text}`);
    const effort = row.getByLabel(`Most effort of ${nameOf(hinge)} in N m`);
    near(Number(await effort.inputValue()), one.maxEffort, 1e-5, "the effort");
    await effort.fill("1.68");
    await row.getByLabel(`Most speed of ${nameOf(hinge)} in deg/s`).fill("200");
    await row.getByLabel(`Most speed of ${nameOf(hinge)} in deg/s`).press("Tab");
    await saved(page, asset, () => button(page, "Save limits...").click(), ["maxForce = 1.68", "elocity"]);
    const now = stage.tenon(["drives", "--json", asset], { fails: true }).drives.find((drive) => drive.joint === hinge);
    near(now.maxEffort, 1.68, 1e-6, "the effort that was written");
    near(now.speedLimit, (200 * Math.PI) / 180, 1e-6, "the speed that was written");
    await undone(page, asset, before);
    return `${told.length} drives`;
  },

  async gains_are_set_live_tested_and_saved(stage) {
    const { asset, page, before } = await panel(stage, "Gains");
    const row = rowOf(page, "gains", hinge);
    await row.waitFor();
    const told = stage.tenon(["tune", "--json", asset]).drives;
    const driven = told.filter((one) => one.type !== null);
    hold((await page.locator("table.gains tbody tr").count()) === driven.length, `tenon tune lists ${driven.length}`);
    const own = told.find((one) => one.joint === hinge);
    const cell = (k) => row.locator("td.number").nth(k).textContent().then(Number);
    near(await cell(0), own.frequencyHz, 1e-3 * own.frequencyHz, "the frequency");
    near(await cell(1), own.dampingRatio, 1e-3 * own.dampingRatio, "the ratio");
    const box = row.getByRole("checkbox");
    (await box.isChecked()) || (await box.check());
    const sliders = page.locator(`section.mover[data-joint="${hinge}"][aria-label^="Gains"]`);
    // The model that runs has them: a step of the drive is slower, and overshoots.
    await sliders.getByLabel("frequency in Hz").fill("3");
    await sliders.getByLabel("frequency in Hz").press("Tab");
    await until(async () => Math.abs((await cell(0)) - 3) < 1e-3, "the frequency that was set");
    await sliders.getByLabel("damping ratio as a number").fill("0.3");
    await sliders.getByLabel("damping ratio as a number").press("Tab");
    await until(async () => Math.abs((await cell(1)) - 0.3) < 1e-3, "the ratio that was set");
    hold(content(dirname(asset)) === before, "a slider writes a file");
    await ask(page, "setDrive", { joint: hinge, position: 0.2 });
    const index = await page.evaluate((path) => window.heard.scene.joints.findIndex((one) => one.path === path), hinge);
    let most = 0;
    for (let i = 0; i < 40; i++) {
      await ask(page, "step", { count: 10 });
      most = Math.max(most, await page.evaluate((k) => window.heard.plots.joints[k][0], index));
    }
    hold(most > 0.2 * 1.15, `the drive does not overshoot with a ratio of 0.3: ${most} rad of 0.2`);
    // Tests say what the verb says with the same gains.
    await page.getByLabel("Test", { exact: true }).selectOption("step");
    await page.getByLabel("Period in s").fill("1.5");
    await button(page, "Test ticked joints").click();
    const result = page.locator(`.tested[data-joint="${hinge}"]`);
    await result.waitFor();
    await page.locator(".task:visible").waitFor({ state: "detached" }).catch(() => {});
    const charts = result.getByRole("img");
    await until(async () => /from .* to .*/.test(await charts.getAttribute("aria-label")), "the chart is drawn");
    const file = join(stage.folder(), "gains.toml");
    writeFileSync(file, `["${nameOf(hinge)}"]\nfrequency = 3\ndamping_ratio = 0.3\n`);
    const tested = stage.tenon(
      ["tune", "--json", asset, "--gains", file, "--joints", nameOf(hinge), "--test", "step", "--period", "1.5"],
      { fails: true },
    ).engines[0].results[0];
    const said = await result.textContent();
    const overshoot = Number(/overshoot ([\d.]+) %/.exec(said)?.[1]);
    near(overshoot, tested.step.overshoot * 100, 0.2, `the overshoot of the test (${said})`);
    // Saved, and taken back.
    await saved(page, asset, () => button(page, "Save gains...").click(), ["physics:stiffness", "physics:damping"]);
    const after = stage.tenon(["tune", "--json", asset]).drives.find((one) => one.joint === hinge);
    near(after.frequencyHz, 3, 0.003, "the frequency in the file");
    near(after.dampingRatio, 0.3, 0.001, "the ratio in the file");
    await until(() => button(page, "Save gains...").isDisabled(), "nothing is left to save");
    await undone(page, asset, before);
    return `overshoot ${overshoot} %`;
  },

  async several_drives_are_tested_with_charts(stage) {
    const { page } = await panel(stage, "Gains");
    await page.locator("table.gains").waitFor();
    const boxes = page.locator("table.gains input[type=checkbox]:enabled");
    const count = Math.min(await boxes.count(), 3);
    for (let i = 0; i < count; i++) {
      await boxes.nth(i).check();
    }
    for (const [test, word] of [["snap", "settles"], ["sine", "lag"]]) {
      await page.getByLabel("Test", { exact: true }).selectOption(test);
      if (test === "sine") {
        await page.getByLabel("Period in s").fill("0.5");
      }
      await button(page, "Test ticked joints").click();
      await until(async () => (await page.locator(".tested figure canvas").count()) === count, `${count} charts of ${test}`);
      await until(async () => !(await page.locator(".task").last().isVisible()), "the test ends");
      const said = await page.locator(".tested").allTextContents();
      hold(said.every((text) => text.includes(word)), `${test} says ${said}`);
    }
    return `${count} drives`;
  },

  async gains_of_the_files_come_again(stage) {
    const { page } = await panel(stage, "Gains");
    const row = rowOf(page, "gains", hinge);
    await row.waitFor();
    const cell = () => row.locator("td.number").first().textContent();
    const before = await cell();
    await ask(page, "setGains", { joint: hinge, dof: "rotZ", frequency: 10, dampingRatio: 1 });
    await ask(page, "reset");
    await ask(page, "engine", { engine: "mujoco" });
    await until(async () => (await cell()) !== before, "gains stay when the model begins again");
    await button(page, "As in the files").click();
    await until(async () => (await cell()) === before, "the gains of the files");
    await until(() => button(page, "Save gains...").isDisabled(), "nothing is left to save");
  },

  async poses_are_kept_reached_renamed_and_removed(stage) {
    const { asset, page, before } = await panel(stage, "Poses");
    await page.getByText("The asset keeps no poses yet.").waitFor();
    const at = () => ask(page, "setJoint", { joint: hinge, position: [0.4] });
    await at();
    await page.getByLabel("Name of the pose").fill("point");
    await saved(page, asset, () => button(page, "Save where joints are now...").click(), ["point"]);
    const kept = stage.tenon(["pose", "--json", asset]).poses;
    hold(kept.length === 1 && kept[0].name === "point", `the asset keeps ${kept.map((one) => one.name)}`);
    near(kept[0].joints.find((one) => one.joint === hinge).value, 0.4, 1e-5, "the joint in the pose");
    const position = () =>
      page.evaluate((path) => {
        const { heard } = window;
        return heard.plots.joints[heard.scene.joints.findIndex((one) => one.path === path)][0];
      }, hinge);
    await ask(page, "setJoint", { joint: hinge, position: [0] });
    await button(page, "Go to point").click();
    await until(async () => Math.abs((await position()) - 0.4) < 1e-5, "the joint goes to the pose");
    await ask(page, "step", { count: 300 });
    near(await position(), 0.4, 0.05, "the joint that the drive holds");
    await page.getByLabel("Name of the pose").fill("there");
    await saved(page, asset, () => button(page, "Rename point").click(), ["there"]);
    await button(page, "Go to there").waitFor();
    const [file] = await Promise.all([page.waitForEvent("download"), button(page, "Export").click()]);
    const written = readFileSync(await file.path(), "utf8");
    hold(Object.keys(JSON.parse(written).poses).join() === "there", `the file has ${written.slice(0, 200)}`);
    await button(page, "Remove there").click();
    await dialog(page).getByRole("button", { name: "Write", exact: true }).click();
    await page.getByText("The asset keeps no poses yet.").waitFor();
    await page.getByLabel("File of poses").setInputFiles({ name: "p.json", mimeType: "application/json", buffer: Buffer.from(written) });
    await dialog(page).getByRole("button", { name: "Write", exact: true }).click();
    await button(page, "Go to there").waitFor();
    for (let i = 0; i < 4; i++) {
      const number = await page.evaluate(() => window.heard.notices.scene);
      await until(() => button(page, "Undo").isEnabled(), "an edit to take back");
      await button(page, "Undo").click();
      await until(() => page.evaluate((n) => window.heard.notices.scene > n, number), `undo ${i}`);
    }
    hold(content(dirname(asset)) === before, "the bytes do not come back");
  },

  async findings_are_corrected(stage) {
    const asset = join(stage.folder(), "scene.usda");
    const box = `
    def Cube "box" (prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsCollisionAPI"])
    {
    }
    def Material "slick" (prepend apiSchemas = ["PhysicsMaterialAPI"])
    {
        float physics:restitution = 1.5
    }
    def Material "bouncy" (prepend apiSchemas = ["PhysicsMaterialAPI"])
    {
        float physics:restitution = 1.7
    }`;
    writeFileSync(asset, sceneOf(box));
    const before = readFileSync(asset, "utf8");
    const fixable = () => stage.tenon(["check", "--json", asset], { fails: true }).diagnostics.filter((one) => one.autofix);
    const known = fixable();
    hold(known.length > 1, `${known.length} findings can be corrected`);
    const page = await stage.live(await stage.view(asset));
    await listen(page);
    await openTab(page, "Findings");
    await page.locator(".finding").first().waitFor();
    await until(async () => (await page.getByRole("button", { name: /^Correct .+ of / }).count()) > 1, "a button for each");
    const one = known.find((finding) => finding.prim?.endsWith("slick")) ?? known[0];
    const press = () => button(page, `Correct ${one.rule}${one.prim ? ` of ${nameOf(one.prim)}` : ""}`).first().click();
    await saved(page, asset, press, ["restitution"]);
    hold(fixable().length === known.length - 1, `${fixable().length} of ${known.length} are left`);
    await until(async () => !(await button(page, "Correct all...").isDisabled()), "the rest");
    await button(page, "Correct all...").click();
    await dialog(page).getByRole("button", { name: "Write", exact: true }).click();
    await until(() => fixable().length === 0, "all are corrected");
    for (let i = 0; i < 2; i++) {
      const number = await page.evaluate(() => window.heard.notices.scene);
      await until(() => button(page, "Undo").isEnabled(), "an edit to take back");
      await button(page, "Undo").click();
      await until(() => page.evaluate((n) => window.heard.notices.scene > n, number), `undo ${i}`);
    }
    hold(readFileSync(asset, "utf8") === before, "the bytes do not come back");
    return `${known.length} findings`;
  },

  async numbers_are_identified_from_a_log(stage) {
    const folder = stage.folder();
    const at = (name) => join(folder, name);
    const arm = stage.path("examples/cpp/robots/arm.urdf");
    stage.tenon(["convert", arm, at("arm.usda"), "--gains", "40,2", "--fix-base", "-q"]);
    stage.tenon(["convert", arm, at("robot.usda"), "--gains", "33,1.6", "--friction", "0.3", "--fix-base", "-q"]);
    stage.tenon(["excite", at("arm.usda"), "-o", at("motion.csv"), "--duration", "4", "--no-collisions", "-q"]);
    stage.tenon(["sim", at("robot.usda"), "--commands", at("motion.csv"), "--duration", "5", "--dt", "0.0005",
      "--integrator", "rk4", "--fps", "100", "--log", "efforts", "-o", at("run.csv"), "-q"]);
    const page = await stage.live(await stage.view(at("arm.usda"), "--dt", "0.005", "--log", at("run.csv"), "--commands", at("motion.csv")));
    await listen(page);
    await openTab(page, "Identify");
    const place = shown(page);
    await place.getByText("run.csv").waitFor();
    await place.getByLabel("Parameters", { exact: true }).fill("gains\nfriction");
    const solve = button(page, "Solve");
    hold(await solve.isDisabled(), "a fit without a check");
    await button(page, "Check").click();
    await until(() => solve.isEnabled(), "the check passes");
    const told = await place.getByRole("region", { name: "4 Check" }).locator("tbody tr").allTextContents();
    hold(told.length === 3 && told.every((row) => row.endsWith("yes")), `the check tells ${told}`);
    await place.getByLabel("Parameters", { exact: true }).fill("gains");
    hold(await solve.isDisabled(), "a fit of what was not checked");
    await place.getByLabel("Parameters", { exact: true }).fill("gains\nfriction");
    await solve.click();
    const rows = place.getByRole("region", { name: "6 Result" }).locator("tbody tr");
    await rows.first().waitFor({ timeout: 60000 });
    const numbers = await rows.first().locator("td").allTextContents();
    hold(Math.abs(Number(numbers[2]) - 33) < 0.2, `the stiffness is ${numbers}`);
    await button(page, "Write the layer...").click();
    await dialog(page).waitFor();
    hold(!existsSync(at("arm.identified.usda")), "it is written though nobody has seen it");
    await dialog(page).getByRole("button", { name: "Write", exact: true }).click();
    await until(() => existsSync(at("arm.identified.usda")), "the layer");
    await button(page, "Undo").click();
    await until(() => !existsSync(at("arm.identified.usda")), "the layer goes");
    return `stiffness ${numbers[2]} of 33`;
  },

  async panels_fit_small_windows_and_write_nothing_where_they_may_not(stage) {
    const viewer = await stage.view(stage.hand(), "--read-only");
    for (const width of [800, 1024]) {
      const page = await stage.live(viewer, { viewport: { width, height: 640 } });
      await openTab(page, "Pairs");
      await page.locator("[role=tabpanel]:visible").getByLabel("Postures to look at").fill("20");
      await button(page, "Look for contacts").click();
      await page.locator("table.pairs").waitFor();
      for (const [tab, there] of [["Pairs", "table.pairs"], ["Drives", "table.drives"], ["Gains", "table.gains"], ["Poses", ".poses li"], ["Identify", "[aria-label='2 Logs'] li"], ["Findings", ".finding"]]) {
        await openTab(page, tab);
        await page.locator(there).first().waitFor();
        await settled(page);
        const over = await page.evaluate(() => {
          const place = document.querySelector(".right");
          const wide = place.getBoundingClientRect().right;
          return [...document.querySelectorAll("[role=tabpanel]:not([hidden]) *")]
            .filter((one) => one.offsetParent !== null && one.getBoundingClientRect().right > wide + 1)
            .map((one) => `${one.tagName} ${one.textContent}`);
        });
        hold(over.length === 0, `${tab}: cut off at ${width} px: ${over.slice(0, 3)}`);
        const writes = page.locator("[role=tabpanel]:visible").getByRole("button", { name: /^(Save|Write|Correct|Rename|Remove|Import)/ });
        hold((await writes.count()) === 0, `${tab} offers to write`);
      }
      const refusal = await page.evaluate((joint) =>
        window.tenonPage.session.connection
          .ask("setLimits", { limits: [{ joint, dof: "rotZ", maxEffort: 2 }] })
          .then(() => "", (fault) => fault.finding.rule), hinge);
      hold(refusal === "live.read-only", `a viewer that only shows says ${refusal || "nothing"}`);
    }
  },
};
