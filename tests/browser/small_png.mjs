// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Pictures of pages for the documentation: PNG with a palette, which is a third of the bytes; and
// small images for surfaces.
import { crc32, deflateSync } from "node:zlib";

const colours = 255;

/** The pixels of a PNG, decoded by the browser. */
async function decoded(page, png) {
  const { width, height, text } = await page.evaluate(async (data) => {
    const bytes = Uint8Array.from(atob(data), (c) => c.charCodeAt(0));
    const bitmap = await createImageBitmap(new Blob([bytes], { type: "image/png" }));
    const to = new OffscreenCanvas(bitmap.width, bitmap.height).getContext("2d");
    to.drawImage(bitmap, 0, 0);
    const all = to.getImageData(0, 0, bitmap.width, bitmap.height).data;
    let kept = "";
    for (let i = 0; i < all.length; i += 30000) {
      kept += String.fromCharCode(...all.subarray(i, i + 30000));
    }
    return { width: bitmap.width, height: bitmap.height, text: btoa(kept) };
  }, png.toString("base64"));
  return { width, height, pixels: Buffer.from(text, "base64") };
}

const key = (r, g, b) => ((r >> 2) << 12) | ((g >> 2) << 6) | (b >> 2);

/** The colours that are there most often, and which of them each pixel is nearest to. */
function quantised({ width, height, pixels }) {
  const counts = new Map();
  for (let i = 0; i < pixels.length; i += 4) {
    const one = key(pixels[i], pixels[i + 1], pixels[i + 2]);
    const seen = counts.get(one);
    seen ? (seen.count += 1) : counts.set(one, { count: 1, rgb: [...pixels.subarray(i, i + 3)] });
  }
  const most = [...counts.values()].sort((a, b) => b.count - a.count);
  const palette = most.slice(0, colours).map((one) => one.rgb);
  const nearest = new Map();
  const find = (rgb) => {
    const far = palette.map((one) => one.reduce((sum, x, k) => sum + (x - rgb[k]) ** 2, 0));
    return far.indexOf(Math.min(...far));
  };
  const rows = Buffer.alloc((width + 1) * height);
  for (let y = 0; y < height; ++y) {
    for (let x = 0; x < width; ++x) {
      const at = 4 * (y * width + x);
      const one = key(pixels[at], pixels[at + 1], pixels[at + 2]);
      nearest.has(one) || nearest.set(one, find(pixels.subarray(at, at + 3)));
      rows[y * (width + 1) + 1 + x] = nearest.get(one);
    }
  }
  return { palette, rows };
}

function chunk(name, data) {
  const body = Buffer.concat([Buffer.from(name, "latin1"), data]);
  const whole = Buffer.alloc(body.length + 8);
  whole.writeUInt32BE(data.length, 0);
  body.copy(whole, 4);
  whole.writeUInt32BE(crc32(body), body.length + 4);
  return whole;
}

const signature = Buffer.from([137, 80, 78, 71, 13, 10, 26, 10]);

/** A PNG of pixels: [red, green, blue, alpha] of each, row by row from the top. */
export function rgbaPng(width, height, pixels) {
  const head = Buffer.alloc(13);
  head.writeUInt32BE(width, 0);
  head.writeUInt32BE(height, 4);
  head.set([8, 6, 0, 0, 0], 8);
  const rows = Array.from({ length: height }, (_, y) => [0, ...pixels.slice(y * width, (y + 1) * width).flat()]);
  return Buffer.concat([
    signature,
    chunk("IHDR", head),
    chunk("IDAT", deflateSync(Buffer.from(rows.flat()))),
    chunk("IEND", Buffer.alloc(0)),
  ]);
}

/** A PNG with few colours of one with many. */
export async function smallPng(page, png) {
  const picture = await decoded(page, png);
  const { palette, rows } = quantised(picture);
  const head = Buffer.alloc(13);
  head.writeUInt32BE(picture.width, 0);
  head.writeUInt32BE(picture.height, 4);
  head.set([8, 3, 0, 0, 0], 8);
  return Buffer.concat([
    signature,
    chunk("IHDR", head),
    chunk("PLTE", Buffer.from(palette.flat())),
    chunk("IDAT", deflateSync(rows, { level: 9 })),
    chunk("IEND", Buffer.alloc(0)),
  ]);
}
