// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Accessibility by axe-core: no serious violation on either page, in light and dark, with every tab
// open, with a selection, an opened property, findings and messages.
import { axeSource, button, hold, openTab, settled } from "../harness.mjs";
import { property } from "./editing.mjs";

async function check(stage, page, where) {
  await settled(page);
  const found = await page.evaluate(async () => {
    const result = await window.axe.run(document, { resultTypes: ["violations"] });
    if (result.passes.length < 10) {
      throw new Error("axe has looked at next to nothing");
    }
    return result.violations.map((one) => ({
      id: one.id,
      impact: one.impact,
      nodes: one.nodes.map((node) => `${node.target.join(" ")}: ${node.failureSummary}`).slice(0, 3),
    }));
  });
  const bad = found.filter((one) => one.impact === "serious" || one.impact === "critical");
  hold(bad.length === 0, `${where}: ${bad.map((one) => `${one.id}: ${one.nodes.join("; ")}`).join("\n")}`);
  return found.length;
}

async function walk(stage, page, where) {
  await page.evaluate(axeSource(stage.packages));
  await page.evaluate(() => {
    const { viewer } = window.tenonPage;
    viewer.select(viewer.info.joints.find((one) => one.path.includes("thumb_2")).path);
  });
  const tabs = await page.getByRole("tab").allTextContents();
  for (const tab of tabs) {
    await openTab(page, tab);
    await check(stage, page, `${where}, ${tab}`);
  }
  return tabs.length;
}

export const tests = {
  async view(stage) {
    const asset = stage.hand("grasp.usda");
    const viewer = await stage.view(asset);
    let count = 0;
    for (const theme of ["light", "dark"]) {
      const page = await stage.live(viewer, { theme });
      await openTab(page, "Findings");
      await button(page, "Check the asset").click();
      await page.locator(".finding").first().waitFor();
      count = await walk(stage, page, theme);
      await openTab(page, "Selection");
      const row = await property(page, "physics:upperLimit");
      await row.getByRole("textbox").fill("[");
      await row.getByRole("button", { name: "Set" }).click();
      await page.locator(".messages .wrong").waitFor();
      await check(stage, page, `${theme}, a refused edit`);
      await row.getByRole("textbox").fill(theme === "light" ? "30" : "31");
      await row.getByRole("button", { name: "Set" }).click();
      await page.locator(".effect").waitFor();
      await check(stage, page, `${theme}, an edit`);
      await page.getByRole("searchbox").fill("thumb");
      await check(stage, page, `${theme}, a search`);
    }
    return `${count} tabs of view`;
  },

  async report(stage) {
    const file = stage.report(stage.path("examples/inspire_hand/grasp.usda"), "--duration", "0.2");
    let count = 0;
    for (const theme of ["light", "dark"]) {
      count = await walk(stage, await stage.opened(file, { theme }), theme);
    }
    return `${count} tabs of report`;
  },

  /** A small window: nothing is cut off at its right, and all is reached. */
  async small_windows(stage) {
    const viewer = await stage.view(stage.path("examples/inspire_hand/inspire_hand.usda"));
    for (const viewport of [
      { width: 1024, height: 640 },
      { width: 800, height: 600 },
      { width: 390, height: 800 },
    ]) {
      const page = await stage.live(viewer, { viewport });
      const over = await page.evaluate(() => {
        const wide = document.documentElement.clientWidth;
        return [...document.querySelectorAll("button, select, input, [role=tab], h1")]
          .filter((one) => one.offsetParent !== null && one.getBoundingClientRect().right > wide + 1)
          .map((one) => one.textContent || one.tagName);
      });
      hold(over.length === 0, `at ${viewport.width} px these are cut off: ${over}`);
      const picture = await page.locator("canvas").first().boundingBox();
      hold(picture.width > 250 && picture.height > 200, `the picture has ${picture.width} px`);
    }
  },
};
