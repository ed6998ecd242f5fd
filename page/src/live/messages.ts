// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What the page has to say to people: one line below the picture that screen readers read out.
import { h } from "../panel/dom";
import type { Finding } from "./connection";

export class Messages {
  readonly element = h("div", { class: "messages", role: "status", "aria-live": "polite" });
  private timer = 0;

  /** Something that was done; goes away. */
  say(text: string): void {
    this.show(text, "said");
    this.timer = window.setTimeout(() => this.element.replaceChildren(), 8000);
  }

  /** Something that went wrong; stays. */
  complain(fault: unknown): void {
    const finding = fault as Partial<Finding>;
    const text =
      fault instanceof Error
        ? fault.message
        : `${finding.message ?? String(fault)}${finding.fix ? `; ${finding.fix}` : ""}`;
    this.show(text, "wrong");
  }

  private show(text: string, kind: string): void {
    window.clearTimeout(this.timer);
    this.element.replaceChildren(
      h("span", { class: kind }, text),
      h("button", { type: "button", onclick: () => this.element.replaceChildren() }, "Close"),
    );
  }
}
