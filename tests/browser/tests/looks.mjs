// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// How surfaces look: images that cut out, that are scaled, turned, moved and wrapped as USD says; what
// is not drawn; white that keeps its form; the shadow on the ground.
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { drawn, hold, openTab, sceneOf, settled, until } from "../harness.mjs";
import { pixels } from "../silhouette.mjs";
import { rgbaPng } from "../small_png.mjs";

/** A square of 1 m that looks at -Y, with a material whose image has st from 0 to 1 on it. */
const square = (surface, image, transform) => `
    def Material "Look"
    {
        token outputs:surface.connect = </World/Look/S.outputs:surface>
        def Shader "S"
        {
            uniform token info:id = "UsdPreviewSurface"
            float inputs:roughness = 1
            ${surface}
            token outputs:surface
        }
        def Shader "T"
        {
            uniform token info:id = "UsdUVTexture"
            asset inputs:file = @image.png@
            float2 inputs:st.connect = </World/Look/X.outputs:result>
            ${image}
            float3 outputs:rgb
            float outputs:r
            float outputs:a
        }
        def Shader "X"
        {
            uniform token info:id = "UsdTransform2d"
            ${transform}
            float2 outputs:result
        }
    }
    def Mesh "square" (prepend apiSchemas = ["MaterialBindingAPI"])
    {
        rel material:binding = </World/Look>
        uniform bool doubleSided = 1
        int[] faceVertexCounts = [4]
        int[] faceVertexIndices = [0, 1, 2, 3]
        point3f[] points = [(0, 0, 0), (1, 0, 0), (1, 0, 1), (0, 0, 1)]
        texCoord2f[] primvars:st = [(0, 0), (1, 0), (1, 1), (0, 1)] (interpolation = "vertex")
    }`;

/** A page that looks at a square from its front. */
async function shown(stage, image, ...parts) {
  const folder = stage.folder();
  writeFileSync(join(folder, "image.png"), image);
  writeFileSync(join(folder, "square.usda"), sceneOf(square(...parts)));
  const page = await stage.live(await stage.view(join(folder, "square.usda"), "--read-only"));
  await page.evaluate(() => {
    const { viewer } = window.tenonPage;
    viewer.showGrid(false);
    viewer.lookFrom("-Y");
  });
  return page;
}

/** The colours at places in the asset's axes: [red, green, blue] of each. */
async function coloursAt(page, places) {
  await settled(page);
  const { width, height, pixels: data } = await pixels(page);
  const at = await page.evaluate((list) => {
    const { viewer } = window.tenonPage;
    viewer.scene.updateMatrixWorld(true);
    return list.map((place) => {
      const seen = viewer.camera.position.clone().fromArray(place);
      return viewer.root.localToWorld(seen).project(viewer.camera).toArray();
    });
  }, places);
  return at.map(([x, y]) => {
    const column = Math.floor(((x + 1) / 2) * width);
    const row = Math.floor(((1 - y) / 2) * height);
    return [...data.subarray(4 * (row * width + column), 4 * (row * width + column) + 3)];
  });
}

const onSquare = ([s, t]) => [s, 0, t];

/** Which of the colours it is, whatever the light is. */
function nameOf(rgb) {
  const most = Math.max(...rgb);
  const bits = rgb.map((one) => (one > 0.72 * most ? "1" : "0")).join("");
  const names = { 100: "red", "010": "green", "001": "blue", 110: "yellow", 111: "background" };
  return most < 100 ? "black" : (names[bits] ?? `${rgb}`);
}

const [red, green, blue, yellow] = [[255, 0, 0, 255], [0, 200, 0, 255], [0, 0, 255, 255], [220, 220, 0, 255]];
/** Its lower row is red and green, its upper one blue and yellow. */
const quarters = rgbaPng(4, 4, [
  ...Array(2).fill([blue, blue, yellow, yellow]).flat(),
  ...Array(2).fill([red, red, green, green]).flat(),
]);

/** What USD says is at a place of `quarters`. */
function wanted([s, t], { scale = [1, 1], degrees = 0, move = [0, 0], wrap = ["repeat", "repeat"] }) {
  const [x, y] = [s * scale[0], t * scale[1]];
  const [c, n] = [Math.cos((degrees * Math.PI) / 180), Math.sin((degrees * Math.PI) / 180)];
  const at = [c * x - n * y + move[0], n * x + c * y + move[1]];
  const wrapped = at.map((one, i) => {
    const inside = one - Math.floor(one);
    const odd = Math.abs(Math.floor(one)) % 2 === 1;
    const { clamp, mirror, black } = {
      clamp: Math.min(0.999, Math.max(0, one)),
      mirror: odd ? 1 - inside : inside,
      black: one === inside ? one : null,
    };
    return { repeat: inside, clamp, mirror, black }[wrap[i]];
  });
  if (wrapped.includes(null)) {
    return "black";
  }
  const blurred = (one, i) =>
    [0.5, ...(wrap[i] === "repeat" ? [0, 1] : [])].some((edge) => Math.abs(one - edge) < 0.13);
  const atEdge = at.some((one) => Math.abs(one - Math.round(one)) < 0.05);
  if (wrapped.some(blurred) || atEdge) {
    return null; // where colours run into each other
  }
  return [["red", "green"], ["blue", "yellow"]][wrapped[1] < 0.5 ? 0 : 1][wrapped[0] < 0.5 ? 0 : 1];
}

const cases = [
  { scale: [2, 2] },
  { degrees: 90 },
  { scale: [3, 1.5], degrees: 30, move: [0.2, 0.1] },
  { scale: [2, 2], wrap: ["mirror", "clamp"] },
  { scale: [2, 2], move: [-0.5, -0.5], wrap: ["black", "repeat"] },
];

const box = (name, size, at, color) => `
    def Cube "${name}" (prepend apiSchemas = ["PhysicsRigidBodyAPI"])
    {
        double size = ${size}
        color3f[] primvars:displayColor = [(${color})]
        double3 xformOp:translate = (${at})
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }`;

export const tests = {
  async images_cut_out(stage) {
    const clear = [255, 255, 255, 0];
    const solid = [255, 255, 255, 255];
    const left = rgbaPng(4, 1, [clear, clear, solid, solid]);
    const paint = "color3f inputs:diffuseColor = (0, 0.6, 0)";
    const mask = "float inputs:opacity.connect = </World/Look/T.outputs:a>";
    for (const threshold of ["", "float inputs:opacityThreshold = 0.5"]) {
      const page = await shown(stage, left, `${paint}\n${mask}\n${threshold}`, "", "");
      const [out, inside] = await coloursAt(page, [[0.15, 0.5], [0.85, 0.5]].map(onSquare));
      hold(nameOf(out) === "background", `${threshold}: cut out is ${out}`);
      hold(nameOf(inside) === "green", `${threshold}: the rest is ${inside}`);
      // What is selected stays cut out.
      await page.evaluate(() => window.tenonPage.viewer.select("/World/square"));
      const [still] = await coloursAt(page, [onSquare([0.15, 0.5])]);
      hold(nameOf(still) === "background", `${threshold}: selected, cut out is ${still}`);
      await page.context().close();
    }
    // A red channel turned round by scale and bias.
    const dark = [0, 255, 255, 255];
    const bright = [255, 255, 255, 255];
    const page = await shown(
      stage,
      rgbaPng(4, 1, [bright, bright, dark, dark]),
      `${paint}\nfloat inputs:opacity.connect = </World/Look/T.outputs:r>\nfloat inputs:opacityThreshold = 0.5`,
      "float4 inputs:scale = (-1, 1, 1, 1)\nfloat4 inputs:bias = (1, 0, 0, 0)",
      "",
    );
    const found = (await coloursAt(page, [[0.15, 0.5], [0.85, 0.5]].map(onSquare))).map(nameOf);
    hold(found.join() === "background,green", `turned round: ${found}`);
  },

  async images_are_scaled_turned_moved_and_wrapped(stage) {
    const steps = Array.from({ length: 9 }, (_, i) => (i + 0.5) / 9);
    const places = steps.flatMap((s) => steps.map((t) => [s, t]));
    let count = 0;
    for (const one of cases) {
      const { scale = [1, 1], degrees = 0, move = [0, 0], wrap = ["repeat", "repeat"] } = one;
      const page = await shown(
        stage,
        quarters,
        "color3f inputs:diffuseColor.connect = </World/Look/T.outputs:rgb>",
        `token inputs:wrapS = "${wrap[0]}"\ntoken inputs:wrapT = "${wrap[1]}"`,
        `float2 inputs:scale = (${scale})\nfloat inputs:rotation = ${degrees}\n` +
          `float2 inputs:translation = (${move})`,
      );
      const known = places.filter((place) => wanted(place, one) !== null);
      const found = (await coloursAt(page, known.map(onSquare))).map(nameOf);
      known.forEach((place, i) => {
        const want = wanted(place, one);
        hold(found[i] === want, `${JSON.stringify(one)}: at ${place} it is ${found[i]}, not ${want}`);
      });
      count += known.length;
      hold(known.length >= 12, `${JSON.stringify(one)}: only ${known.length} places are clear`);
      await page.context().close();
    }
    return `${count} places of images`;
  },

  async what_is_not_drawn_is_listed(stage) {
    const asset = join(stage.folder(), "curve.usda");
    const curve = `
    def BasisCurves "curve"
    {
        int[] curveVertexCounts = [2]
        point3f[] points = [(0, 0, 0), (1, 0, 0)]
    }`;
    writeFileSync(asset, sceneOf(curve));
    const page = await stage.live(await stage.view(asset, "--read-only"));
    await openTab(page, "Show");
    await page.getByText("Not drawn as the asset says (1)").click();
    await page.getByText("BasisCurves", { exact: true }).waitFor();
    await page.locator(".layers code", { hasText: "/World/curve" }).waitFor();
  },

  async white_keeps_its_form(stage) {
    const asset = join(stage.folder(), "ball.usda");
    const ball = `
    def Sphere "ball"
    {
        color3f[] primvars:displayColor = [(1, 1, 1)]
    }`;
    writeFileSync(asset, sceneOf(ball));
    const page = await stage.live(await stage.view(asset), { theme: "dark" });
    await page.evaluate(() => window.tenonPage.viewer.showGrid(false));
    const { pixels: data } = await pixels(page);
    let [all, burnt] = [0, 0];
    const shades = new Set();
    for (let i = 0; i < data.length; i += 4) {
      if (data[i] > 90) {
        all += 1;
        burnt += data[i] === 255 ? 1 : 0;
        shades.add(data[i]);
      }
    }
    const share = (100 * burnt) / all;
    hold(share < 1, `${share.toFixed(1)} % of a white ball is burnt out`);
    hold(shades.size > 60, `a white ball has ${shades.size} shades`);
    return `white ball: ${share.toFixed(1)} % burnt out, ${shades.size} shades`;
  },

  async what_stands_has_a_shadow(stage) {
    const asset = join(stage.folder(), "boxes.usda");
    writeFileSync(asset, sceneOf(box("a", 1, "0, 0, 0.5", "0.8, 0.2, 0.1") + box("b", 0.4, "2.5, 0, 3", "1, 1, 1")));
    const page = await stage.live(await stage.view(asset, "--read-only"));
    await page.evaluate(() => {
      const { viewer } = window.tenonPage;
      viewer.grid.children.forEach((one) => (one.type === "LineSegments" ? (one.visible = false) : null));
    });
    // It comes with the first rest.
    await until(() => page.evaluate(() => window.tenonPage.viewer.shadow.mesh.visible), "the shadow");
    const near = [[0.53, 0, 0], [0, -0.53, 0]];
    const far = [[1.5, -0.8, 0], [0.5, -1.3, 0]];
    const shade = async (places) => (await coloursAt(page, places)).map((rgb) => rgb[0] + rgb[1] + rgb[2]);
    const [dark, light] = [await shade(near), await shade(far)];
    hold(Math.max(...dark) < Math.min(...light) - 40, `beside the box ${dark}, away ${light}`);
    // Without the ground there is no shadow on it.
    await page.evaluate(() => window.tenonPage.viewer.showGrid(false));
    const without = await shade(near);
    hold(Math.min(...without) >= Math.min(...light) - 3, `without the ground ${without}`);
    // While pictures come too slowly an old shadow is hidden.
    const old = await page.evaluate(() => {
      const { viewer } = window.tenonPage;
      viewer.showGrid(true);
      viewer.pace.share = 0.5;
      viewer.shadow.stale = true;
      viewer.drawAs(0.5);
      return viewer.shadow.mesh.visible;
    });
    hold(!old, "an old shadow is shown");
    await until(() => page.evaluate(() => window.tenonPage.viewer.shadow.mesh.visible), "the shadow at rest");
    await drawn(page);
  },
};
