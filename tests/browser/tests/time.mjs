// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What was simulated is kept: scrubbed, stepped back, replayed, looped, plotted and exported, within the
// memory that it may have; events are on its time line.
import { readFileSync } from "node:fs";
import { ask, button, hold, listen, near, openTab, settled, sleep, until } from "../harness.mjs";
import { poses } from "./steering.mjs";
import { failing } from "./stumbles.mjs";

const grasp = (stage) => stage.path("examples/inspire_hand/grasp.usda");
const falling = (stage) => stage.path("examples/scenes/box_on_box.usda");
const bar = (page) => page.getByRole("group", { name: "What was simulated" });
const kept = (page) =>
  page.evaluate(() => {
    const { frames, samples, bytes, first, last, shown } = window.tenonPage.history;
    return { frames: frames.length, samples: samples.length, bytes, first, last, shown };
  });

const height = async (page, path) => (await poses(page))[path].p[2];

/** Single steps, each of which is a moment. */
async function stepTimes(page, times, count = 5) {
  for (let i = 0; i < times; ++i) {
    await ask(page, "step", { count });
  }
  await settled(page);
}

/** What a command of the menu Save writes; -> its name and text or bytes. */
async function saved(page, command) {
  await page.locator("summary", { hasText: "Save" }).click();
  const coming = page.waitForEvent("download");
  await page.getByRole("button", { name: command }).click();
  const download = await coming;
  return { name: download.suggestedFilename(), data: readFileSync(await download.path()) };
}

export const tests = {
  async the_past_is_scrubbed_stepped_and_left(stage) {
    const page = await stage.live(await stage.view(falling(stage)));
    await listen(page);
    hold(await button(page, "Replay").isDisabled(), "there is a replay before anything was simulated");
    await stepTimes(page, 20);
    const path = await page.evaluate(() => window.tenonPage.viewer.info.bodies[0].path);
    const end = await height(page, path);
    const { first, last, frames } = await kept(page);
    hold(frames === 21 && first === 0, `${frames} moments from ${first} s`);
    // What is shown is what was: the body stands higher, and the simulation where it is.
    await bar(page).getByRole("slider").fill("0");
    await settled(page);
    const begin = await height(page, path);
    hold(begin > end + 0.01, `at 0 s the body is at ${begin}, at the end at ${end}`);
    near(await page.evaluate(() => window.heard.state.time), last, 1e-6, "the time of the simulation");
    await page.locator("canvas").first().focus();
    await page.keyboard.press(".");
    await page.keyboard.press(".");
    const step = (await kept(page)).shown;
    near(step, (2 * last) / 20, 1e-5, "two moments on");
    await page.keyboard.press(",");
    near((await kept(page)).shown, last / 20, 1e-5, "a moment back");
    await settled(page);
    const between = await height(page, path);
    hold(between < begin && between > end, `a moment later it is at ${between}`);
    // Step back begins at the newest moment, and Now leads there.
    await button(page, "Now").click();
    hold((await kept(page)).shown === null, "Now leaves the past shown");
    await button(page, "Step back").click();
    near((await kept(page)).shown, (19 * last) / 20, 1e-5, "a step back");
    // Who steers the simulation sees it.
    await button(page, "Step").click();
    await until(async () => (await kept(page)).shown === null, "the simulation after a step");
    await button(page, "Reset").click();
    await until(async () => (await kept(page)).last === 0, "nothing is kept of the run before");
    await settled(page);
    near(await height(page, path), begin, 1e-6, "the start");
    return `${frames} moments`;
  },

  async it_is_replayed_and_looped(stage) {
    const page = await stage.live(await stage.view(falling(stage)));
    await listen(page);
    await stepTimes(page, 30);
    const { last } = await kept(page);
    await page.locator("canvas").first().focus();
    await page.keyboard.press("e");
    await until(async () => (await kept(page)).shown > 0.3 * last, "the replay goes on");
    await until(async () => (await button(page, "Replay").count()) === 1, "the replay ends");
    near((await kept(page)).shown, last, 1e-9, "where it ends");
    await page.getByLabel("Loop").check();
    const rounds = await page.evaluate(async () => {
      const { history } = window.tenonPage;
      let before = -1;
      let count = 0;
      history.addEventListener("shown", () => {
        count += history.shown < before ? 1 : 0;
        before = history.shown;
      });
      document.querySelectorAll(".timeline button")[1].click();
      const end = performance.now() + 20_000;
      while (count < 3 && performance.now() < end) {
        await new Promise((go) => setTimeout(go, 50));
      }
      return count;
    });
    hold(rounds >= 3, `it begins anew ${rounds} times`);
    near(await page.evaluate(() => window.heard.state.time), last, 1e-6, "the time of the simulation");
    await button(page, "Stop").click();
    await until(async () => (await button(page, "Replay").count()) === 1, "the end of the replay");
  },

  async memory_is_bounded_and_the_newest_is_kept(stage) {
    const page = await stage.live(await stage.view(grasp(stage)));
    await listen(page);
    await page.evaluate(() => (window.tenonPage.history.limit = 40_000));
    await ask(page, "speed", { factor: 4 });
    await ask(page, "play");
    await until(() => page.evaluate(() => window.heard.frames > 150), "150 frames");
    await ask(page, "pause");
    await settled(page);
    const { bytes, first, last, frames, samples } = await kept(page);
    hold(bytes <= 40_000 && bytes > 20_000, `${bytes} bytes are kept`);
    hold(first > 0 && frames > 10 && samples > 0, `${frames} moments from ${first} s, ${samples} samples`);
    near(last, await page.evaluate(() => window.heard.state.time), 1e-4, "the newest moment");
    const sum = await page.evaluate(() => {
      const { frames: all, samples: some } = window.tenonPage.history;
      let total = 0;
      for (let i = 0; i < all.length; ++i) {
        total += all.at(i).poses.byteLength + 200;
      }
      for (let i = 0; i < some.length; ++i) {
        total += some.at(i).values.byteLength + some.at(i).contacts.byteLength + 200;
      }
      return total;
    });
    hold(sum === bytes, `it counts ${bytes} bytes of ${sum}`);
    return `${frames} moments in ${bytes} bytes`;
  },

  async every_signal_is_plotted_and_exported(stage) {
    const asset = grasp(stage);
    const page = await stage.live(await stage.view(asset));
    await listen(page);
    const { joints, bodies } = stage.tenon(["physics", "--json", asset]);
    const joint = joints.find((one) => one.path.endsWith("right_index_1_joint")).path;
    const can = bodies.find((one) => one.path.endsWith("/can")).path;
    await ask(page, "setDrive", { joint, position: 0.5 });
    await stepTimes(page, 30, 4);
    await openTab(page, "Plots");
    const prims = page.getByLabel("Prim of a signal");
    const names = page.getByLabel("Signal of the prim");
    const add = async (prim, wanted) => {
      await prims.selectOption(prim);
      const offered = await names.locator("option").allTextContents();
      hold(offered.join() === wanted.join(), `of ${prim} are offered ${offered}, expected ${wanted}`);
      for (const name of wanted) {
        await names.selectOption(name);
        await button(page, "Add").click();
      }
    };
    await add(joint, ["position", "velocity", "driveEffort", "target", "velocityTarget"]);
    await add(can, ["position", "linearVelocity", "angularVelocity", "contactForce"]);
    await add("", ["energy", "contacts"]);
    await settled(page);
    const labels = await page.locator("figure canvas").evaluateAll((all) => all.map((one) => one.getAttribute("aria-label")));
    hold(labels.length >= 8 && labels.every((one) => /from -?[\d.e-]+ to/.test(one)), labels.join("; "));
    // The table beside a run of `tenon sim`: the same columns, and the same numbers.
    const { name, data } = await saved(page, "The plotted signals (CSV)");
    const lines = data.toString().trim().split("\n").map((line) => line.split(","));
    hold(name === "grasp.csv", `it is named ${name}`);
    const heads = lines[0];
    const wanted = [`${joint}.driveEffort [N m]`, `${joint}.velocityTarget [deg/s]`, `${can}.contactForce.z [N]`,
      `${can}.linearVelocity.x [m/s]`, `${can}.position.z [m]`, "energy.total [J]"];
    wanted.forEach((head) => hold(heads.includes(head), `no column ${head}: ${heads}`));
    hold(lines.length === 31 || lines.length === 32, `${lines.length} rows`);
    const last = (head) => Number(lines[lines.length - 1][heads.indexOf(head)]);
    near(last(`${joint}.target [deg]`), (0.5 * 180) / Math.PI, 1e-3, "the target");
    const told = await page.evaluate(() => window.heard.plots);
    const at = await page.evaluate((path) => window.heard.scene.joints.findIndex((one) => one.path === path), joint)
      .catch(() => -1);
    near(last("energy.total [J]"), told.kinetic + told.potential, 1e-4 * Math.abs(told.potential) + 1e-6, "energy");
    if (at >= 0) {
      near(last(`${joint}.position [deg]`), (told.joints[at][0] * 180) / Math.PI, 1e-3, "its position");
    }
    const force = await page.evaluate((path) => {
      let sum = 0;
      for (const row of window.heard.contacts.rows) {
        sum += (row.body1 === path ? 1 : 0) * row.force[2] - (row.body0 === path ? 1 : 0) * row.force[2];
      }
      return sum;
    }, can);
    near(last(`${can}.contactForce.z [N]`), force, 1e-3 * Math.abs(force) + 1e-5, "the force of contacts");
    hold(Math.abs(force) > 0.01, "nothing holds the can");
    hold(Math.abs(last(`${joint}.driveEffort [N m]`)) > 0, "the drive exerts nothing");
    return `${heads.length - 1} columns`;
  },

  async a_picture_and_a_film_are_saved(stage) {
    const page = await stage.live(await stage.view(falling(stage)));
    await stepTimes(page, 30);
    const picture = await saved(page, "The picture (PNG)");
    hold(picture.data.subarray(1, 4).toString() === "PNG" && picture.data.length > 3000, "no picture");
    const film = await saved(page, "A film of what was simulated");
    hold(film.name === "box_on_box.webm" && film.data.length > 2000, `${film.name}: ${film.data.length} bytes`);
    hold(film.data.readUInt32BE(0) === 0x1a45dfa3, "the film is no WebM");
    return `a film of ${film.data.length} bytes`;
  },

  async events_are_on_the_time_line(stage) {
    const page = await stage.live(await stage.view(grasp(stage)));
    await listen(page);
    const joint = await page.evaluate(
      () => window.tenonPage.viewer.info.joints.find((one) => one.path.includes("thumb_2")).path,
    );
    // A drive that pushes against the end of its joint: a limit, and all the force that it has.
    await ask(page, "setDrive", { joint, position: 3 });
    await stepTimes(page, 30, 20);
    await openTab(page, "Events");
    const text = (kind) => page.locator(`.event.${kind}`).allTextContents();
    await until(async () => (await text("limit")).length > 0, "the limit");
    hold((await text("contact")).some((one) => /can touches|touches can/.test(one)), `${await text("contact")}`);
    hold((await text("limit")).some((one) => one.includes("thumb_2")), `${await text("limit")}`);
    const marks = await page.locator(".mark.limit").count();
    hold(marks > 0, "the time line has no mark of a limit");
    const row = page.locator(".event.limit").filter({ hasText: "thumb_2" }).first();
    const time = parseFloat(await row.getByRole("button").textContent());
    await row.getByRole("button").click();
    near((await kept(page)).shown, time, 0.011, "the moment that an event leads to");
    hold((await page.evaluate(() => window.tenonPage.viewer.selected)) === joint, "it selects another prim");
    const contacts = page.locator("h3", { hasText: "What touches now" }).locator("xpath=following-sibling::*[1]");
    hold((await contacts.locator("tbody tr").count()) > 0, "no contact is listed");
    return `${marks} marks of limits`;
  },

  async targets_of_the_asset_move_as_it_says(stage) {
    const page = await stage.live(await stage.view(grasp(stage)));
    await listen(page);
    await stepTimes(page, 10, 30);
    const { time, targets } = await page.evaluate(() => window.heard.plots);
    const joints = await page.evaluate(() => window.tenonPage.viewer.info.joints);
    const index = joints.findIndex((one) => one.path.endsWith("right_thumb_1_joint"));
    const degrees = (targets[index][0][0] * 180) / Math.PI;
    // 0 to 65 degrees in 48 frames of 60 in a second (examples/inspire_hand/grasp.usda).
    hold(time > 0.2, `it stands at ${time} s`);
    near(degrees, Math.min(65, (65 * time * 60) / 48), 0.5, `the target at ${time} s`);
  },

  async a_failure_is_an_event(stage) {
    const page = await stage.live(await stage.view(failing(stage), "--engine", "physx"));
    await listen(page);
    await ask(page, "play");
    await page.locator(".messages .wrong").waitFor();
    await openTab(page, "Events");
    await page.locator(".event.failure").waitFor();
    hold((await page.locator(".event.failure").count()) === 1, "the failure is told more than once");
  },

  async values_of_the_selection_live(stage) {
    const page = await stage.live(await stage.view(grasp(stage)));
    await listen(page);
    const { joints } = await page.evaluate(() => window.tenonPage.viewer.info);
    const joint = joints.find((one) => one.path.endsWith("right_index_1_joint")).path;
    await page.evaluate((path) => window.tenonPage.viewer.select(path), joint);
    await ask(page, "setDrive", { joint, position: 0.5 });
    await stepTimes(page, 10, 10);
    const cell = (name) => page.locator(".values tr").filter({ hasText: name }).first().locator("td");
    const told = await page.evaluate(() => window.heard.plots);
    const number = async (name) => parseFloat(await cell(name).textContent());
    await until(async () => (await number("position [deg]")) > 0.1, "the position");
    hold(told.joints.length === joints.length, "other joints");
    near(await number("target [deg]"), (0.5 * 180) / Math.PI, 0.01, "the target");
    hold(Math.abs(await number("velocity [deg/s]")) > 0, "it stands still");
    hold(Math.abs(await number("effort of the drive [N m]")) > 0, "no effort");
    await openTab(page, "Joints");
    await settled(page);
    const row = page.locator(".joints tr").filter({ hasText: "right_index_1_joint" });
    hold(/-?[\d.]+ deg/.test(await row.locator("td").last().textContent()), "the table has no value");
    hold((await row.textContent()).includes("N m/rad"), "gains have no unit");
    const lines = await row.locator("button").evaluate((one) => one.getClientRects().length);
    const tall = await row.locator("button").evaluate((one) => one.offsetHeight);
    hold(lines === 1 && tall < 30, `the name of a joint is broken: ${tall} px`);
    const body = await page.evaluate(() => window.tenonPage.viewer.info.bodies.find((one) => one.path.endsWith("/can")).path);
    await page.evaluate((path) => window.tenonPage.viewer.select(path), body);
    const pose = (await poses(page))[body];
    await until(async () => (await cell("position [m]").textContent()) !== "", "the pose");
    const shown = (await cell("position [m]").textContent()).split(", ").map(Number);
    shown.forEach((x, k) => near(x, pose.p[k], 1e-3 * Math.abs(pose.p[k]) + 1e-4, `position ${k}`));
    hold((await cell("roll, pitch, yaw [deg]").textContent()).split(",").length === 3, "no orientation");
    hold((await cell("force of contacts [N]").textContent()).split(",").length === 3, "no force");
    // At another moment they are those of it.
    const before = await cell("position [m]").textContent();
    await bar(page).getByRole("slider").fill("0");
    await settled(page);
    await sleep(100);
    hold((await cell("position [m]").textContent()) !== before, "the past has the values of now");
  },
};
