// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Findings and edits in the live page, on copies of the example hand: a finding leads to its prim, an
// edit to one line of the file that owns the value, undo to the bytes that were there; files that
// change are shown while camera, selection and panel stay.
import { copyFileSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { ask, button, drawn, hold, listen, near, openTab, settled, until } from "../harness.mjs";

const joint = "/inspire_hand/Physics/right_thumb_2_joint";
const physics = (asset) => join(dirname(asset), "payloads/Physics/physics.usda");

/** All files below a folder, by name. */
function content(folder) {
  const names = readdirSync(folder, { recursive: true, withFileTypes: true });
  return new Map(
    names
      .filter((one) => one.isFile())
      .map((one) => join(one.parentPath, one.name))
      .map((path) => [path, readFileSync(path, "latin1")]),
  );
}

const changed = (before, now) =>
  [...new Set([...before.keys(), ...now.keys()])].filter((path) => before.get(path) !== now.get(path));

/** Lines that two texts do not share, at their places. */
const changedLines = (a, b) => {
  const [one, other] = [a.split("\n"), b.split("\n")];
  hold(one.length === other.length, "the edit changes the number of lines");
  return one.flatMap((line, i) => (line === other[i] ? [] : [[line.trim(), other[i].trim()]]));
};

/** Plants limits in radians, where degrees are meant. */
function plant(asset) {
  const text = readFileSync(physics(asset), "utf8");
  const at = text.indexOf("physics:upperLimit = 34.377", text.indexOf('"right_thumb_2_joint"'));
  hold(at > 0, "the hand has no limit to plant a defect in");
  writeFileSync(
    physics(asset),
    text.slice(0, at) + "physics:upperLimit = 0.5236" + text.slice(at + "physics:upperLimit = 34.377".length),
  );
}

/** Opens the editor of a property of the selected prim. */
export async function property(page, name) {
  const row = page.locator(`.property[data-property="${name}"]`);
  await row.locator("summary").click();
  await row.locator("form").waitFor();
  return row;
}

const upper = (page) =>
  page.evaluate(
    (path) => window.heard.scene.joints.find((one) => one.path === path).dofs[0].upper,
    joint,
  );

const selected = (page) => page.evaluate(() => window.tenonPage.viewer.selected);
const camera = (page) => page.evaluate(() => window.tenonPage.viewer.camera.position.toArray());

export const tests = {
  async findings_select_their_prim(stage) {
    const asset = stage.hand();
    plant(asset);
    const page = await stage.live(await stage.view(asset));
    await openTab(page, "Findings");
    await button(page, "Check the asset").click();
    const item = page.locator(".finding").filter({ hasText: "joint.limits-in-radians" });
    await item.waitFor();
    const all = stage.tenon(["check", "--json", asset], { fails: true }).diagnostics;
    const shown = await page.locator(".finding").count();
    hold(shown === all.length, `${shown} findings, tenon check has ${all.length}`);
    const text = await item.textContent();
    const wanted = all.find((one) => one.rule === "joint.limits-in-radians");
    for (const part of [wanted.message, wanted.severity, `:${wanted.line}`, wanted.fix]) {
      hold(text.includes(part), `the finding does not say ${part}: ${text}`);
    }
    await item.getByRole("button").first().click();
    hold((await selected(page)) === joint, `it selects ${await selected(page)}`);
    await page.locator(".inspector h2").filter({ hasText: joint }).waitFor();
  },

  async findings_come_by_themselves_grouped_and_filtered(stage) {
    const asset = stage.hand();
    const text = readFileSync(physics(asset), "utf8");
    const many = text.replaceAll(/(physics:upperLimit = )[\d.]+/g, "$10.5236");
    hold(many.split("= 0.5236").length > 5, "the hand has few limits");
    writeFileSync(physics(asset), many);
    const page = await stage.live(await stage.view(asset));
    await openTab(page, "Findings");
    const group = page.locator(".finding-group").filter({ hasText: "joint.limits-in-radians" });
    await group.waitFor();
    const all = stage.tenon(["check", "--json", asset], { fails: true }).diagnostics;
    const ofRule = all.filter((one) => one.rule === "joint.limits-in-radians");
    const title = await group.locator("summary").textContent();
    hold(title.includes(`${ofRule.length} x`), `the group reads ${title}, there are ${ofRule.length}`);
    hold((await page.locator(".finding").count()) === all.length, "some findings are not there");
    await group.locator("summary").click();
    hold(await group.locator(".finding").first().isVisible(), "a group does not open");
    const place = await group.locator(".finding small").first().textContent();
    hold(/physics\.usda:\d+$/.test(place), `the place reads ${place}`);
    await page.context().grantPermissions(["clipboard-read", "clipboard-write"]);
    await group.locator(".finding").first().getByRole("button", { name: "Copy" }).click();
    hold((await page.evaluate(() => navigator.clipboard.readText())) === place, "Copy copies something else");
    await page.getByLabel("Filter findings").fill("radians thumb");
    const left = all.filter((one) => `${one.rule} ${one.message} ${one.prim}`.includes("thumb") && one.rule.includes("radians"));
    hold((await page.locator(".finding").count()) === left.length, "the filter shows others");
    return `${all.length} findings, ${ofRule.length} of one rule`;
  },

  async an_edit_lands_and_comes_back(stage) {
    const asset = stage.hand();
    plant(asset);
    const before = content(dirname(asset));
    const viewer = await stage.view(asset);
    const page = await stage.live(viewer);
    const other = await stage.live(viewer);
    await listen(page);
    await page.evaluate((path) => window.tenonPage.viewer.select(path), joint);
    await ask(page, "step", { count: 10 });
    const looked = await camera(page);
    const row = await property(page, "physics:upperLimit");
    hold((await row.locator("td").first().textContent()).includes("physics.usda:"), "no place is told");
    await row.getByRole("textbox").fill("34.377");
    await row.getByRole("button", { name: "Set" }).click();
    const effect = page.locator(".effect");
    await effect.waitFor();
    const told = await effect.textContent();
    hold(/0\.5236 -> 34\.377 in .*physics\.usda:\d+/.test(told), `the effect reads ${told}`);
    hold(told.includes("limits") || told.includes("upper"), `no effect on engines is told: ${told}`);
    const said = await page.locator(".messages").textContent();
    hold(said.includes("time begins anew"), `that time begins anew is not said: ${said}`);
    await drawn(page);
    near(await upper(page), (34.377 * Math.PI) / 180, 1e-5, "the limit after the edit");
    const now = content(dirname(asset));
    const files = changed(before, now);
    hold(files.join() === physics(asset), `these files have changed: ${files}`);
    const lines = changedLines(before.get(files[0]), now.get(files[0]));
    hold(lines.length === 1, `${lines.length} lines have changed`);
    hold(lines[0].join() === "float physics:upperLimit = 0.5236,float physics:upperLimit = 34.377", lines[0]);
    hold((await camera(page)).join() === looked.join(), "the edit moves the camera");
    hold((await selected(page)) === joint, "the edit takes the selection off");
    hold((await row.getAttribute("open")) !== null, "the edit closes what one has opened");
    // The other page sees it, and takes it back.
    await button(other, "Undo").click();
    await until(() => changed(before, content(dirname(asset))).length === 0, "the bytes come back");
    await until(async () => (await upper(page)) < 0.02, "the limit comes back in the first page");
    await until(() => button(page, "Redo").isEnabled(), "there is something to make again");
    await button(page, "Redo").click();
    await until(() => changed(now, content(dirname(asset))).length === 0, "the edit comes again");
  },

  async a_wrong_value_is_refused_and_told(stage) {
    const asset = stage.hand();
    const before = content(dirname(asset));
    const page = await stage.live(await stage.view(asset));
    await page.evaluate((path) => window.tenonPage.viewer.select(path), joint);
    const row = await property(page, "physics:upperLimit");
    await row.getByRole("textbox").fill("[no number");
    await row.getByRole("button", { name: "Set" }).click();
    const wrong = page.locator(".messages .wrong");
    await wrong.waitFor();
    hold((await wrong.textContent()).length > 10, "nothing is said");
    hold(changed(before, content(dirname(asset))).length === 0, "files have changed");
  },

  async read_only_offers_no_edits(stage) {
    const page = await stage.live(await stage.view(stage.hand(), "--read-only"));
    await page.evaluate((path) => window.tenonPage.viewer.select(path), joint);
    await page.locator('.property[data-property="physics:upperLimit"] summary').click();
    await page.locator(".property td").first().waitFor();
    hold((await page.locator("form").count()) === 0, "there is an editor");
    hold(!(await button(page, "Undo").isVisible()), "there is a button Undo");
  },

  async a_file_that_changes_is_shown(stage) {
    const asset = stage.hand();
    const page = await stage.live(await stage.view(asset, "--watch"));
    await listen(page);
    await page.evaluate((path) => window.tenonPage.viewer.select(path), joint);
    await openTab(page, "Plots");
    await page.mouse.move(600, 300);
    await page.mouse.down();
    await page.mouse.move(700, 320, { steps: 3 });
    await page.mouse.up();
    await page.evaluate((path) => window.tenonPage.viewer.select(path), joint);
    await openTab(page, "Plots");
    await settled(page);
    const looked = await camera(page);
    plant(asset);
    await until(() => page.evaluate(() => window.heard.scene?.why === "file"), "the changed file");
    await settled(page);
    near(await upper(page), (0.5236 * Math.PI) / 180, 1e-6, "the limit in the changed file");
    hold((await selected(page)) === joint, "the selection is another one");
    hold((await camera(page)).join() === looked.join(), "the camera is elsewhere");
    const tab = await page.locator('[role=tab][aria-selected="true"]').textContent();
    hold(tab === "Plots", `the tab ${tab} has opened`);
    // A file that is broken for a while is told.
    const good = readFileSync(physics(asset));
    writeFileSync(physics(asset), "#usda 1.0\nthis is no layer");
    const wrong = page.locator(".messages .wrong");
    await wrong.waitFor();
    hold((await wrong.textContent()).includes("physics.usda"), "the page does not name the file");
    writeFileSync(physics(asset), good);
    await until(() => page.evaluate(() => window.heard.scene.bodies.length > 10), "the mended file");
  },

  async a_missing_file_that_appears_is_shown(stage) {
    const asset = stage.hand();
    const kept = join(stage.folder(), "physics.usda");
    copyFileSync(physics(asset), kept);
    rmSync(physics(asset));
    const page = await stage.live(await stage.view(asset, "--watch"));
    await listen(page);
    const bodies = () => page.evaluate(() => window.heard.scene?.bodies.length ?? 0);
    copyFileSync(kept, physics(asset));
    await until(async () => (await bodies()) > 10, "the bodies of the file that has appeared", 10_000);
    await ask(page, "step", { count: 1 });
  },
};
