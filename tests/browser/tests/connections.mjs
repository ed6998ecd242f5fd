// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The wire: many bodies at full rate, a server that goes and comes, two pages, long checks beside
// motion, and memory over time. The length of the last is TENON_BROWSER_MINUTES, 10 unless set.
import { readFileSync, writeFileSync } from "node:fs";
import { availableParallelism, loadavg } from "node:os";
import { join } from "node:path";
import { ask, button, hold, listen, near, openTab, sleep, until } from "../harness.mjs";

/** A grid of boxes without colliders, that fall freely. */
function boxes(count) {
  const rows = Array.from({ length: count }, (_, i) => {
    const at = `(${i % 20}, ${Math.floor(i / 20) % 20}, ${2 + Math.floor(i / 400)})`;
    return `    def Cube "box_${i}" (prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"])
    {
        double size = 0.5
        float physics:mass = 1
        double3 xformOp:translate = ${at}
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
`;
  });
  return `#usda 1.0
(
    defaultPrim = "World"
    metersPerUnit = 1
    upAxis = "Z"
)
def Xform "World"
{
    def PhysicsScene "scene"
    {
        float physics:gravityMagnitude = 0.01
    }
${rows.join("")}}
`;
}

const clock = (page) => page.evaluate(() => window.heard.state?.time ?? 0);

/** Resident memory of a process [MB]. */
const resident = (pid) =>
  Number(readFileSync(`/proc/${pid}/status`, "utf8").match(/VmRSS:\s*(\d+)/)[1]) / 1024;

const heap = (page) =>
  page.evaluate(() => {
    globalThis.gc?.();
    return performance.memory.usedJSHeapSize / 1e6;
  });

export const tests = {
  async many_bodies_at_full_rate(stage) {
    const asset = join(stage.folder(), "boxes.usda");
    writeFileSync(asset, boxes(300));
    const page = await stage.live(await stage.view(asset));
    await listen(page);
    await page.evaluate(() => {
      // The picture is not what is measured here: the frames are, as they come.
      window.tenonPage.viewer.renderer.setAnimationLoop(null);
      window.late = [];
      window.tenonPage.session.connection.addEventListener("frame", (event) => {
        window.late.push([performance.now(), event.detail[0], event.detail.length]);
      });
    });
    await ask(page, "play");
    await sleep(10_000);
    const late = await page.evaluate(() => window.late);
    await ask(page, "pause");
    const span = (late[late.length - 1][0] - late[0][0]) / 1000;
    const rate = (late.length - 1) / span;
    hold(late.every((one) => one[2] === 1 + 7 * 300), "frames of another size");
    // A machine that has more to do than processors may skip some, but not fall behind.
    const least = loadavg()[0] > 2 * availableParallelism() ? 30 : 55;
    hold(rate > least && rate < 62, `${rate.toFixed(1)} frames a second, expected 60`);
    // The time in a frame lags behind the clock; where messages pile up, ever more.
    const lag = late.map(([at, time]) => at / 1000 - time).sort((a, b) => a - b);
    const half = Math.floor(late.length / 2);
    const mean = (list) => list.reduce((sum, [at, time]) => sum + at / 1000 - time, 0) / list.length;
    const grown = mean(late.slice(half)) - mean(late.slice(0, half));
    hold(grown < 0.5, `the frames come ${grown} s later in the second half`);
    const asked = Date.now();
    await ask(page, "messages");
    hold(Date.now() - asked < 2000, "a request waits behind frames");
    return `300 bodies: ${rate.toFixed(1)} frames/s, lag ${((lag[half] - lag[0]) * 1000).toFixed(0)} ms`;
  },

  async it_connects_again(stage) {
    const asset = stage.path("examples/inspire_hand/inspire_hand.usda");
    const first = await stage.view(asset);
    const port = new URL(first.url).port;
    const page = await stage.live(first, { quiet: false });
    await listen(page);
    await ask(page, "step", { count: 20 });
    const time = await clock(page);
    // A connection that breaks: the session goes on.
    await page.evaluate(() => window.tenonPage.session.connection.socket.close());
    await until(() => page.evaluate(() => window.heard.notices.open > 0), "the connection");
    await until(async () => (await clock(page)) === time, "the time of the session");
    await page.locator(".messages .wrong").waitFor({ state: "detached" });
    // A server that ends and comes again has another token: the page says so.
    await first.stop();
    const wrong = page.locator(".messages .wrong");
    await wrong.waitFor();
    hold((await wrong.textContent()).includes("does not answer"), await wrong.textContent());
    hold((await button(page, "Play").isDisabled()) === true, "Play is offered without a server");
    const second = await stage.view(asset, "--port", port);
    await page.goto(second.url);
    await page.waitForFunction(() => window.tenonPage?.viewer.shown > 0);
  },

  async two_pages_see_the_same(stage) {
    const viewer = await stage.view(stage.path("examples/inspire_hand/inspire_hand.usda"));
    const one = await stage.live(viewer);
    const other = await stage.live(viewer);
    await listen(one);
    await listen(other);
    const joint = "/inspire_hand/Physics/right_ring_1_joint";
    await ask(one, "setJoint", { joint, position: [0.7] });
    const at = (page) =>
      page.evaluate(() => {
        const { viewer: v } = window.tenonPage;
        const i = v.info.bodies.findIndex((body) => body.path.endsWith("right_ring_1"));
        return v.bodies[i].quaternion.toArray().join();
      });
    await until(async () => (await at(one)) === (await at(other)), "the same pose in both");
    await button(one, "Play").click();
    await button(other, "Pause").waitFor();
    await button(other, "Pause").click();
    await button(one, "Play").waitFor();
    await one.getByLabel("Engine", { exact: true }).selectOption("jolt");
    await until(
      async () => (await other.getByLabel("Engine", { exact: true }).inputValue()) === "jolt",
      "the engine in the other page",
    );
  },

  async time_goes_on_while_it_checks(stage) {
    const asset = join(stage.folder(), "boxes.usda");
    writeFileSync(asset, boxes(2000));
    const page = await stage.live(await stage.view(asset));
    await listen(page);
    await openTab(page, "Findings");
    const gaps = await page.evaluate(async () => {
      const { connection } = window.tenonPage.session;
      window.tenonPage.viewer.renderer.setAnimationLoop(null);
      await connection.ask("play");
      let last = performance.now();
      let most = 0;
      let done = false;
      connection.addEventListener("frame", () => {
        const now = performance.now();
        most = done ? most : Math.max(most, now - last);
        last = now;
      });
      const begin = performance.now();
      await connection.ask("findings");
      done = true;
      await connection.ask("pause");
      return { most, span: performance.now() - begin };
    });
    hold(gaps.most < Math.max(500, gaps.span / 2), `frames wait ${gaps.most} of ${gaps.span} ms`);
    return `a check of ${gaps.span.toFixed(0)} ms holds frames up ${gaps.most.toFixed(0)} ms`;
  },

  async memory_stays(stage) {
    const minutes = Number(process.env.TENON_BROWSER_MINUTES ?? 10);
    const viewer = await stage.view(stage.hand("grasp.usda"));
    const page = await stage.live(viewer);
    await listen(page);
    await openTab(page, "Show");
    for (const name of ["Joint axes", "Centres of mass", "Contacts"]) {
      await page.getByLabel(name, { exact: false }).first().check();
    }
    await openTab(page, "Plots");
    await ask(page, "play");
    const seen = [];
    const end = Date.now() + minutes * 60_000;
    const graphics = () => page.evaluate(() => window.tenonPage.viewer.renderer.info.memory);
    while (Date.now() < end) {
      // What reads the asset again, among what goes on.
      for (const variant of ["none", "physics"]) {
        const row = await page.evaluate(
          (v) => window.heard.scene?.variants.find((one) => one.options.includes(v)),
          variant,
        );
        if (row) {
          await ask(page, "variant", { prim: row.prim, set: row.set, variant });
        }
      }
      await ask(page, "reset");
      await ask(page, "play");
      await sleep(Math.min(20_000, minutes * 6_000));
      seen.push([await heap(page), resident(viewer.process.pid), (await graphics()).geometries]);
    }
    const part = (from, to, k) => {
      const list = seen.slice(Math.floor(from * seen.length), Math.ceil(to * seen.length));
      return Math.min(...list.map((one) => one[k]));
    };
    const grown = [0, 1, 2].map((k) => part(0.7, 1, k) - part(0.2, 0.5, k));
    hold(grown[0] < 3, `the page's heap grows by ${grown[0]} MB: ${seen.map((one) => one[0])}`);
    hold(grown[1] < 8, `the program grows by ${grown[1]} MB: ${seen.map((one) => one[1])}`);
    hold(grown[2] <= 0, `${grown[2]} geometries more: ${seen.map((one) => one[2])}`);
    near(seen.length > 4 ? 1 : 0, 1, 0, "enough was looked at");
    return `${minutes} minutes: heap ${grown[0].toFixed(1)} MB, program ${grown[1].toFixed(1)} MB more`;
  },
};
