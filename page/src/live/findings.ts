// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What tenon check finds, asked for when the asset was opened or has changed. Findings of one rule
// stand together; a finding selects its prim, and its place can be copied.
import { h, nameOf } from "../panel/dom";
import type { Fields } from "./connection";
import { restWhileClosed, writer } from "./pages";
import type { Finding } from "./protocol";
import { review } from "./review";
import { type Session, attempt } from "./session";
import { grouped } from "./signals";

/** What is worst comes first. */
const rank = (finding: Finding): number => ["error", "warning", "info"].indexOf(finding.severity);

/** Scenes with more prims are checked when somebody asks for it. */
const mostAtOnce = 20_000;
/** More of one rule are folded. */
const mostOfRule = 3;

const count = (findings: Finding[], severity: string): string => {
  const found = findings.filter((one) => one.severity === severity).length;
  return `${found} ${severity}${found === 1 ? "" : "s"}`;
};

export class Findings {
  private readonly page: HTMLElement;
  private readonly list = h("div");
  private readonly filter: HTMLInputElement;
  private readonly correctAll: HTMLButtonElement;
  private readOnly = false;
  private found: Finding[] = [];
  private title = "";
  private looked = false;
  private asked = 0;

  constructor(private readonly session: Session) {
    this.page = session.panel.addTab("Findings");
    const look = h("button", { type: "button", onclick: () => void this.look() }, "Check the asset");
    this.filter = h("input", {
      type: "search",
      placeholder: "Filter by text, rule or severity",
      "aria-label": "Filter findings",
      oninput: () => this.update(),
    });
    this.correctAll = writer(session, "Correct all...", () => void this.correct({}));
    this.correctAll.disabled = true;
    session.connection.on("hello", (notice) => (this.readOnly = notice.readOnly));
    this.page.append(look, " ", this.correctAll, this.filter, this.list);
    restWhileClosed(session, this.page);
    let changed = false;
    session.connection.on("scene", (scene) => {
      if (scene.why !== "reset" && scene.why !== "engine") {
        this.show(scene.opening, "While it was opened:");
        changed = true;
      }
    });
    session.panel.viewer.addEventListener("load", () => {
      if (changed && session.panel.tree.size < mostAtOnce) {
        void this.look();
      }
      changed = false;
    });
  }

  private async look(): Promise<void> {
    const number = ++this.asked;
    this.list.replaceChildren(h("p", { role: "status" }, "Looking..."));
    const answer = await attempt(this.session, "findings");
    if (number !== this.asked) {
      return; // another check has begun
    }
    const found = answer?.diagnostics ?? [];
    const counts = ["error", "warning", "info"].map((severity) => count(found, severity)).join(", ");
    this.show(found, answer ? `Found: ${counts}.` : "It could not be checked.", answer !== null);
  }

  private show(findings: Finding[], title: string, looked = false): void {
    this.found = [...findings].sort((a, b) => rank(a) - rank(b));
    this.title = title;
    this.looked = looked;
    this.update();
  }

  /** Corrects what has a safe fix; of one finding also what is only suggested. */
  private async correct(fields: Fields<"fix">): Promise<void> {
    await review(this.session, "fix", fields);
  }

  private update(): void {
    this.correctAll.disabled = !this.found.some((one) => one.autofix);
    const words = this.filter.value.trim().toLowerCase().split(/\s+/).filter(Boolean);
    const shown = this.found.filter((one) => {
      const text = `${one.severity} ${one.rule ?? ""} ${one.message} ${one.prim ?? ""}`.toLowerCase();
      return words.every((word) => text.includes(word));
    });
    const groups = grouped(shown, (one) => `${one.severity} ${one.rule ?? one.message}`);
    const items = [...groups.values()].flatMap((group) => this.group(group));
    const none = this.looked && this.found.length === 0 ? [h("p", {}, "Nothing to find fault with.")] : [];
    const head = this.title && (this.found.length > 0 || this.looked) ? [h("p", {}, this.title)] : [];
    const left = this.found.length - shown.length;
    const more = left > 0 ? [h("p", {}, `${left} do not match the filter.`)] : [];
    this.list.replaceChildren(...head, ...none, h("ul", { class: "findings" }, ...items), ...more);
  }

  /** Findings of one rule: folded where they are many. */
  private group(findings: Finding[]): HTMLElement[] {
    const [first] = findings;
    if (!first || findings.length <= mostOfRule) {
      return findings.map((one) => this.item(one));
    }
    const title = [h("strong", {}, first.severity), ` ${findings.length} x ${first.message} `, h("code", {}, first.rule ?? "")];
    const all = h("ul", { class: "findings" }, ...findings.map((one) => this.item(one)));
    return [h("li", { class: `finding-group finding-of ${first.severity}` }, h("details", {}, h("summary", {}, ...title), all))];
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
      const place = `${finding.file}${line}`;
      const copy = () => void navigator.clipboard?.writeText(place).then(() => this.session.messages.say(`Copied ${place}.`));
      item.append(
        h("div", {}, h("small", {}, place), " ", h("button", { type: "button", class: "link", onclick: copy, "aria-label": `Copy ${place}` }, "Copy")),
      );
    }
    if (finding.fix) {
      item.append(h("div", {}, `To mend it: ${finding.fix}.`));
    }
    const correction = finding.autofix ?? finding.suggestedFix;
    if (correction && !this.readOnly) {
      const { rule, prim: of, property, file, line } = finding;
      const fields = { rule, prim: of, property, file, line, suggested: !finding.autofix };
      const name = `Correct ${finding.rule ?? ""}${of ? ` of ${nameOf(of)}` : ""}`;
      const act = () => void this.correct(fields);
      item.append(h("div", {}, h("button", { type: "button", title: correction, "aria-label": name, onclick: act }, "Correct...")));
    }
    return item;
  }

  private select(prim: string): void {
    this.session.panel.viewer.select(prim);
    this.session.panel.openTab("Selection");
  }
}
