// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// All prims of the stage in the tree: asked for when there is another picture, of large scenes when
// somebody is about to search.
import { type Session, attempt } from "./session";

/** Scenes with more prims that have physics or shapes wait for a search. */
const mostAtOnce = 20_000;

export class Prims {
  private revision = 0;
  private known = 0;

  constructor(private readonly session: Session) {
    const { connection, panel } = session;
    panel.tree.onSearch = () => void this.ask();
    connection.on("scene", (scene) => (this.revision = scene.revision));
    panel.viewer.addEventListener("load", () => {
      if (panel.tree.size < mostAtOnce) {
        void this.ask();
      }
    });
  }

  private async ask(): Promise<void> {
    if (this.known === this.revision) {
      return;
    }
    this.known = this.revision;
    const answer = await attempt(this.session, "tree");
    if (answer) {
      this.session.panel.tree.addPrims(answer.prims);
    }
  }
}
