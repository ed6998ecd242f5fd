// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What the page has to say to people: one line below the picture that screen readers read out.
import { h } from "../panel/dom";
import type { Finding } from "./protocol";

/** A finding in one line: file and line, what is wrong, of which prim, and what to do. */
export function textOf(finding: Partial<Finding>): string {
  const line = finding.line ? `:${finding.line}` : "";
  const place = finding.file ? `${finding.file}${line}: ` : "";
  const { message = String(finding), prim } = finding;
  const about = prim && !message.includes(`<${prim}>`) ? ` <${prim}>` : "";
  return `${place}${message}${about}${finding.fix ? `; ${finding.fix}` : ""}`;
}

export class Messages {
  readonly element = h("div", { class: "messages", role: "status", "aria-live": "polite" });
  private timer = 0;
  private stands = "";

  /** Something that was done; goes away. */
  say(text: string): void {
    this.show(text, "said");
    this.timer = window.setTimeout(() => this.element.replaceChildren(), 8000);
  }

  /** Something that went wrong; stays. */
  complain(fault: unknown): void {
    const text = fault instanceof Error ? fault.message : textOf(fault as Partial<Finding>);
    this.show(text, "wrong");
  }

  /** What is wrong as long as it is, with buttons beside it; null: it is over. */
  stand(finding: Finding | null, ...buttons: HTMLElement[]): void {
    const text = finding ? textOf(finding) : "";
    if (text === this.stands) {
      return;
    }
    this.stands = text;
    if (text) {
      this.show(text, "wrong", ...buttons);
    } else {
      this.element.replaceChildren();
    }
  }

  private show(text: string, kind: string, ...buttons: HTMLElement[]): void {
    window.clearTimeout(this.timer);
    this.element.replaceChildren(
      h("span", { class: kind }, text),
      ...buttons,
      h("button", { type: "button", onclick: () => this.element.replaceChildren() }, "Close"),
    );
  }
}
