// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The walk of docs/first-look.md, as a newcomer does it with mouse and keys: open the hand, find its
// heaviest link, close the thumb, find what is wrong with it, mend it, play. A defect is planted in a
// copy before. --write makes the pictures of the page anew.
import { readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { button, drawn, hold, listen, openTab, settled, sleep, until } from "../harness.mjs";
import { smallPng } from "../small_png.mjs";
import { property } from "./editing.mjs";

const thumb = "/inspire_hand/Physics/right_thumb_2_joint";

/** The limit of the thumb in radians, where degrees are meant. */
function plant(asset) {
  const file = join(dirname(asset), "payloads/Physics/physics.usda");
  const text = readFileSync(file, "utf8");
  hold(text.includes("physics:upperLimit = 34.377"), "the hand has another thumb");
  writeFileSync(file, text.replace("physics:upperLimit = 34.377", "physics:upperLimit = 0.5236"));
}

export const tests = {
  async as_in_the_documentation(stage) {
    const asset = stage.hand();
    plant(asset);
    const page = await stage.live(await stage.view(asset), {
      viewport: { width: 1200, height: 720 },
    });
    await listen(page);
    let step = 0;
    const picture = async (name) => {
      step += 1;
      await settled(page);
      await sleep(100);
      if (stage.write) {
        const file = stage.path("docs/images", `walk-${step}-${name}.png`);
        writeFileSync(file, await smallPng(page, await page.screenshot()));
      }
    };
    await picture("open");

    // The heaviest link: all bodies are in the tree; the sizes of the dots tell.
    await openTab(page, "Show");
    await page.getByLabel("Centres of mass").check();
    await page.getByRole("searchbox").fill("base_link body");
    await page.getByRole("treeitem").first().click();
    const heaviest = await page.evaluate(() => {
      const { bodies } = window.tenonPage.viewer.info;
      return bodies.reduce((one, other) => (other.mass > one.mass ? other : one));
    });
    const shown = page.locator(".inspector");
    await shown.getByText(`${Number(heaviest.mass.toPrecision(5))} kg`).first().waitFor();
    hold((await shown.locator("h2").textContent()) === heaviest.path, "another link is the heaviest");
    await picture("heaviest");
    await page.getByRole("searchbox").fill("");
    await openTab(page, "Show");
    await page.getByLabel("Centres of mass").uncheck();

    // The thumb does not close.
    await openTab(page, "Move");
    const slider = page.locator(`.mover[data-joint="${thumb}"] input[type=range]`).first();
    await slider.scrollIntoViewIfNeeded();
    await slider.focus();
    await page.keyboard.press("End");
    const range = page.locator(`.mover[data-joint="${thumb}"] input[type=number]`).first();
    await until(async () => (await range.inputValue()).startsWith("0.5"), "the end of the range");
    await picture("thumb");

    // Why: the check says so, and leads there.
    await openTab(page, "Findings");
    await button(page, "Check the asset").click();
    const finding = page.locator(".finding").filter({ hasText: "joint.limits-in-radians" });
    await finding.waitFor();
    await finding.scrollIntoViewIfNeeded();
    await picture("finding");
    await finding.getByRole("button").first().click();

    // It is mended where it is written.
    const row = await property(page, "physics:upperLimit");
    await row.scrollIntoViewIfNeeded();
    await row.getByRole("textbox").fill("30");
    await row.getByRole("button", { name: "Set" }).click();
    await page.locator(".effect").waitFor();
    await drawn(page);
    await page.locator(".effect").scrollIntoViewIfNeeded();
    await picture("mended");

    // Now it closes, also with its motor, while time goes on.
    await openTab(page, "Move");
    const drive = page
      .locator(`.mover[data-joint="${thumb}"] .slider`)
      .filter({ hasText: "drive to" })
      .locator("input[type=range]");
    await drive.focus();
    await page.keyboard.press("End");
    await button(page, "Play").click();
    await until(() => page.evaluate(() => window.heard.state?.time > 1.2), "time goes on");
    await button(page, "Pause").click();
    await until(() => page.evaluate(() => !window.heard.state.playing), "a pause");
    const angle = parseFloat(await range.inputValue());
    hold(angle > 15, `the thumb stands at ${angle} degrees after it was mended`);
    await drive.scrollIntoViewIfNeeded();
    await picture("plays");
    return `${step} steps`;
  },
};
