// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The page of `tenon report`: everything is in the file that it stands in. What programs that drive
// the page may ask (`tenon record` does) is in `window.tenonPage`.
import { Panel } from "../panel/panel";
import { Viewer } from "../scene/viewer";
import { type ReportData, addReport } from "./report";

declare global {
  interface Window {
    /** The bytes in a slot of the page, which start.js makes. */
    tenonSlot(id: string): Promise<ArrayBuffer>;
  }
}

async function main(): Promise<void> {
  const data = JSON.parse(new TextDecoder().decode(await window.tenonSlot("tenon-data"))) as ReportData;
  const panel = new Panel(document.body, (place) => new Viewer(place));
  panel.setTitle(data.title);
  addReport(panel, data);
  await panel.viewer.load(await window.tenonSlot("tenon-scene"));
  panel.viewer.draw();
  Object.assign(window, { tenonPage: { panel, viewer: panel.viewer, ready: true } });
}

main().catch((fault: unknown) => {
  const note = document.createElement("p");
  note.setAttribute("role", "alert");
  note.textContent = `The report cannot be shown: ${String(fault)}`;
  document.body.prepend(note);
});
