// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The page of `tenon report`: everything is in the file that it stands in. What programs that drive
// the page may ask (`tenon record` does) is in `window.tenonPage`.
import { Panel } from "../panel/panel";
import { Viewer } from "../scene/viewer";
import { type ReportData, addReport } from "./report";

/** The bytes in a slot of the page. */
async function slot(id: string): Promise<ArrayBuffer> {
  const element = document.getElementById(id) as HTMLElement;
  const bytes = Uint8Array.from(atob((element.textContent ?? "").trim()), (c) => c.charCodeAt(0));
  element.remove();
  if (element.dataset.coding !== "gzip") {
    return bytes.buffer;
  }
  const plain = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(plain).arrayBuffer();
}

async function main(): Promise<void> {
  const data = JSON.parse(new TextDecoder().decode(await slot("tenon-data"))) as ReportData;
  const panel = new Panel(document.body, (place) => new Viewer(place));
  panel.setTitle(data.title);
  addReport(panel, data);
  await panel.viewer.load(await slot("tenon-scene"));
  panel.viewer.draw();
  Object.assign(window, { tenonPage: { panel, viewer: panel.viewer, ready: true } });
}

main().catch((fault: unknown) => {
  const note = document.createElement("p");
  note.setAttribute("role", "alert");
  note.textContent = `The report cannot be shown: ${String(fault)}`;
  document.body.prepend(note);
});
