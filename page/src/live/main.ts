// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The page of `tenon view`: shows the scene of the server beside this page.
import { Panel } from "../panel/panel";
import { Viewer } from "../scene/viewer";

async function main(): Promise<void> {
  const panel = new Panel(document.body, (place) => new Viewer(place));
  const answer = await fetch("scene.glb");
  if (!answer.ok) {
    throw new Error(`the server has no scene (${answer.status})`);
  }
  await panel.viewer.load(await answer.arrayBuffer());
}

void main();
