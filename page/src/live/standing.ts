// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What is wrong as long as it is: a simulation that failed, changed files that cannot be opened, and
// a server that is gone. The picture says so, because it looks as if nothing had happened.
import { h, nameOf } from "../panel/dom";
import type { StateNotice } from "./protocol";
import { textOf } from "./messages";
import { type Session, attempt } from "./session";

export class Standing {
  private readonly note = h("p", { class: "old", role: "status", hidden: true });

  constructor(private readonly session: Session) {
    const { connection, panel } = session;
    panel.picture.append(this.note);
    connection.on("state", (state) => this.show(state));
    connection.on("closed", () => this.say("Not connected: this picture is the last one that came."));
  }

  private show({ stopped, outdated }: StateNotice): void {
    const { panel, messages } = this.session;
    const prim = stopped?.prim ?? "";
    if (panel.viewer.failed !== prim) {
      panel.viewer.markFailed(prim);
    }
    messages.stand(stopped, ...this.buttons(prim));
    if (outdated) {
      this.say(`This picture is older than the files. ${textOf(outdated)}`);
    } else {
      this.say(stopped ? "The last moment before the simulation failed." : "");
    }
  }

  private buttons(prim: string): HTMLElement[] {
    const button = (text: string, title: string, act: () => void) =>
      h("button", { type: "button", title, onclick: act }, text);
    const reset = button("Reset", "Back to the start ( r )", () => void attempt(this.session, "reset"));
    const { viewer } = this.session.panel;
    return prim ? [reset, button(nameOf(prim), prim, () => viewer.select(prim))] : [reset];
  }

  private say(text: string): void {
    this.note.hidden = text === "";
    this.note.textContent = text;
  }
}
