// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What a picture shows, as a few numbers: which pixels are not background, their box, how many they
// are, their mean colour, and how full each cell of a coarse raster is. Goldens keep these.
import { hold, near, settled } from "./harness.mjs";

const columns = 32;
const rows = 20;

/** The picture of the page as it is: {width, height, pixels}, pixels as RGBA in one array. */
export async function pixels(page) {
  await settled(page);
  const { width, height, text } = await page.evaluate(() => {
    const viewer = window.tenonPage.viewer;
    viewer.draw();
    const from = viewer.renderer.domElement;
    const to = new OffscreenCanvas(from.width, from.height).getContext("2d");
    to.drawImage(from, 0, 0);
    const data = to.getImageData(0, 0, from.width, from.height).data;
    let kept = "";
    for (let i = 0; i < data.length; i += 30000) {
      kept += String.fromCharCode(...data.subarray(i, i + 30000));
    }
    return { width: from.width, height: from.height, text: btoa(kept) };
  });
  return { width, height, pixels: Buffer.from(text, "base64") };
}

/** How many pixels of two pictures differ by more than a little. */
export function differing(a, b) {
  hold(a.width === b.width && a.height === b.height, "pictures of different sizes");
  let count = 0;
  for (let i = 0; i < a.pixels.length; i += 4) {
    const far = Math.max(...[0, 1, 2].map((k) => Math.abs(a.pixels[i + k] - b.pixels[i + k])));
    count += far > 8 ? 1 : 0;
  }
  return count;
}

/** The numbers of a picture without its grid, where the corner at the top left is background. */
export function silhouette({ width, height, pixels: data }) {
  const cells = new Float64Array(columns * rows);
  const sum = [0, 0, 0];
  const box = [1, 1, 0, 0];
  let area = 0;
  for (let y = 0; y < height; ++y) {
    for (let x = 0; x < width; ++x) {
      const at = 4 * (y * width + x);
      const far = Math.max(...[0, 1, 2].map((k) => Math.abs(data[at + k] - data[k])));
      if (far <= 6) {
        continue;
      }
      area += 1;
      [0, 1, 2].forEach((k) => (sum[k] += data[at + k]));
      box[0] = Math.min(box[0], x / width);
      box[1] = Math.min(box[1], y / height);
      box[2] = Math.max(box[2], (x + 1) / width);
      box[3] = Math.max(box[3], (y + 1) / height);
      cells[Math.floor((y * rows) / height) * columns + Math.floor((x * columns) / width)] += 1;
    }
  }
  const full = (width / columns) * (height / rows);
  const digit = (count) => Math.min(9, Math.floor((10 * count) / full));
  const lines = Array.from({ length: rows }, (_, row) =>
    Array.from(cells.subarray(row * columns, (row + 1) * columns), digit).join(""),
  );
  return {
    area: Number((area / (width * height)).toFixed(4)),
    box: box.map((side) => Number(side.toFixed(4))),
    colour: sum.map((one) => Math.round(one / Math.max(area, 1))),
    cells: lines,
  };
}

/** Holds a silhouette against its golden: a few pixels and shades may differ between renderers. */
export function compare(found, wanted, what) {
  near(found.area, wanted.area, 0.002 + 0.03 * wanted.area, `${what}: area`);
  found.box.forEach((side, i) => near(side, wanted.box[i], 0.012, `${what}: box[${i}]`));
  found.colour.forEach((shade, i) => near(shade, wanted.colour[i], 12, `${what}: colour[${i}]`));
  let apart = 0;
  found.cells.forEach((line, row) =>
    [...line].forEach((cell, i) => (apart += Math.abs(cell - wanted.cells[row][i]))),
  );
  hold(apart <= 40, `${what}: the cells of the raster are apart by ${apart} tenths, at most 40`);
}
