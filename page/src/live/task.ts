// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A long request: a bar of how far it is, and a button that ends it.
import { h } from "../panel/dom";
import { type Answer, type Fields, Refusal, type RequestName } from "./connection";
import { type Session, attempt } from "./session";

export class Task<Name extends RequestName> {
  private readonly bar = h("progress", { max: 1, value: 0, "aria-label": "How far it is" });
  private readonly text = h("span", { role: "status" });
  readonly element: HTMLElement;

  constructor(
    private readonly session: Session,
    private readonly request: Name,
  ) {
    const cancel = h("button", { type: "button", onclick: () => void attempt(session, "cancel") }, "Cancel");
    this.element = h("div", { class: "task", hidden: true }, this.bar, " ", this.text, " ", cancel);
    session.connection.on("progress", ({ of, what, done }) => {
      if (of === request) {
        this.bar.value = done;
        this.text.textContent = what;
      }
    });
  }

  get busy(): boolean {
    return !this.element.hidden;
  }

  /** The answer; null where it was refused, which is told, or ended. */
  async run(fields: Fields<Name>): Promise<Answer<Name> | null> {
    if (this.busy) {
      return null;
    }
    this.bar.value = 0;
    this.text.textContent = "";
    this.element.hidden = false;
    try {
      return await this.session.connection.ask(this.request, fields);
    } catch (fault) {
      const ended = fault instanceof Refusal && /\.ended$/.test(fault.finding.rule ?? "");
      ended ? this.session.messages.say("Ended before its end.") : this.session.messages.complain(fault);
      return null;
    } finally {
      this.element.hidden = true;
    }
  }
}
