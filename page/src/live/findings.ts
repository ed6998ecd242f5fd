// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What tenon check finds; a finding selects its prim.
import { h, nameOf } from "../panel/dom";
import type { Finding, SceneNotice } from "./connection";
import { type Session, attempt } from "./session";

/** What is worst comes first. */
const rank = (finding: Finding): number => ["error", "warning", "info"].indexOf(finding.severity);

const count = (findings: Finding[], severity: string): string => {
  const found = findings.filter((one) => one.severity === severity).length;
  return `${found} ${severity}${found === 1 ? "" : "s"}`;
};

export class Findings {
  private readonly page: HTMLElement;
  private readonly list = h("div");

  constructor(private readonly session: Session) {
    this.page = session.panel.addTab("Findings");
    const look = h("button", { type: "button", onclick: () => void this.look() }, "Check the asset");
    this.page.append(look, this.list);
    session.connection.on<SceneNotice>("scene", (scene) => {
      if (scene.why !== "reset" && scene.why !== "engine") {
        this.show(scene.opening, "While it was opened:");
      }
    });
  }

  private async look(): Promise<void> {
    this.list.replaceChildren(h("p", { role: "status" }, "Looking..."));
    const answer = await attempt<{ diagnostics: Finding[] }>(this.session, "findings");
    const found = answer?.diagnostics ?? [];
    const counts = ["error", "warning", "info"].map((severity) => count(found, severity)).join(", ");
    this.show(found, answer ? `Found: ${counts}.` : "It could not be checked.", answer !== null);
  }

  private show(findings: Finding[], title: string, looked = false): void {
    const sorted = [...findings].sort((a, b) => rank(a) - rank(b));
    const items = sorted.map((finding) => this.item(finding));
    const none = looked && items.length === 0 ? [h("p", {}, "Nothing to find fault with.")] : [];
    const head = title && (items.length > 0 || looked) ? [h("p", {}, title)] : [];
    this.list.replaceChildren(...head, ...none, h("ul", { class: "findings" }, ...items));
  }

  private item(finding: Finding): HTMLElement {
    const item = h(
      "li",
      { class: `finding ${finding.severity}` },
      h("strong", {}, finding.severity),
      ` ${finding.message} `,
      h("code", {}, finding.rule ?? ""),
    );
    const prim = finding.prim;
    if (prim) {
      item.append(
        " ",
        h(
          "button",
          { type: "button", class: "link", title: prim, onclick: () => this.select(prim) },
          nameOf(prim),
        ),
      );
    }
    if (finding.file) {
      const line = finding.line ? `:${finding.line}` : "";
      item.append(h("div", {}, h("small", {}, `${finding.file}${line}`)));
    }
    if (finding.fix) {
      item.append(h("div", {}, `To mend it: ${finding.fix}.`));
    }
    return item;
  }

  private select(prim: string): void {
    this.session.panel.viewer.select(prim);
    this.session.panel.openTab("Selection");
  }
}
