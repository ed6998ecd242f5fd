// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Text of assets is text: whatever it says, no element comes of it, in view and in report, in every
// tab, in findings, refusals and effects of edits.
import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { button, hold, openTab, settled } from "../harness.mjs";

const evil = '<img src=x onerror="window.hurt=1"></script><script>window.hurt=1</script><b class=evil>';
const quoted = evil.replaceAll('"', '\\"');

/** Markup wherever an asset may have text. */
const scene = `#usda 1.0
(
    defaultPrim = "World"
    doc = "${quoted}"
    metersPerUnit = 1
    upAxis = "Z"
)
def Xform "World" (
    displayName = "${quoted}"
    variants = {
        string Look = "plain"
    }
    prepend variantSets = "Look"
    prepend payload = @./<b class=evil>.usda@
)
{
    def Cube "box" (
        displayName = "${quoted}"
        doc = "${quoted}"
        prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI", "PhysicsCollisionAPI", "<b class=evil>API"]
    )
    {
        double size = 0.2
        float physics:mass = -1
        custom string note = "${quoted}"
        custom token kind = "${quoted}"
        custom asset look = @<b class=evil>.png@
    }
    def Cube "base" (prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsCollisionAPI"])
    {
        double3 xformOp:translate = (0, 0, 1)
        uniform token[] xformOpOrder = ["xformOp:translate", "<b class=evil>"]
    }
    def PhysicsRevoluteJoint "hinge"
    {
        rel physics:body0 = </World/base>
        rel physics:body1 = </World/gone>
        uniform token physics:axis = "<b class=evil>"
    }
    def Material "paint" (displayName = "${quoted}")
    {
    }
    variantSet "Look" = {
        "plain" {
        }
    }
}
`;

const noMarkup = (page, where) =>
  page
    .evaluate(() => ({
      hurt: window.hurt ?? 0,
      evil: document.querySelectorAll(".evil").length,
      images: document.querySelectorAll("img").length,
    }))
    .then(({ hurt, evil: made, images }) =>
      hold(!hurt && !made && !images, `${where}: markup of the asset has become elements`),
    );

async function walk(page) {
  for (const tab of await page.getByRole("tab").allTextContents()) {
    await openTab(page, tab);
    await noMarkup(page, tab);
  }
  const paths = await page
    .getByRole("treeitem")
    .evaluateAll((all) => all.map((item) => item.dataset.path));
  for (const path of paths) {
    await page.evaluate((one) => window.tenonPage.viewer.select(one), path);
    await settled(page);
    await noMarkup(page, path);
  }
}

export const tests = {
  async text_of_assets_is_text(stage) {
    const folder = join(stage.folder(), "<b class=evil>");
    mkdirSync(folder);
    const asset = join(folder, '<img src=x onerror="window.hurt=1">.usda');
    writeFileSync(asset, scene);
    const page = await stage.live(await stage.view(asset));
    await walk(page);
    await openTab(page, "Findings");
    await button(page, "Check the asset").click();
    await page.locator(".finding").nth(2).waitFor();
    const text = await page.locator(".findings").filter({ has: page.locator(".finding") }).textContent();
    hold(text.includes("<b class=evil>"), "no finding shows the markup as text");
    await noMarkup(page, "findings");
    await page.evaluate(() => window.tenonPage.viewer.select("/World/box"));
    const row = page.locator('.property[data-property="note"]');
    await row.locator("summary").click();
    hold((await row.locator("summary").textContent()).includes("<img src=x"), "the note is not shown");
    await row.locator("form").waitFor();
    await noMarkup(page, "a property");
    for (const value of [`"${evil.replaceAll('"', "'")}"`, evil]) {
      await row.getByRole("textbox").fill(value);
      await row.getByRole("button", { name: "Set" }).click();
      await page.locator(".messages span").waitFor();
      await noMarkup(page, "an edit");
    }
    hold((await page.title()).includes("<img"), "the title does not show the name");
  },

  async text_of_reports_is_text(stage) {
    const folder = stage.folder();
    const asset = join(folder, "<b class=evil>.usda");
    writeFileSync(asset, scene.replace("physics:mass = -1", "physics:mass = 1"));
    const page = await stage.opened(stage.report(asset, "--duration", "0"));
    await walk(page);
  },
};
