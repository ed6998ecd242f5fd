// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What a report says in words and tables, beside the picture.
import { figure, h, table } from "../panel/dom";
import { pathButton } from "../panel/joints";
import type { Panel } from "../panel/panel";

export interface Finding {
  severity: string;
  rule: string;
  message: string;
  prim?: string;
  file?: string;
  line?: number;
  fix?: string;
}

export interface ReportData {
  title: string;
  version: string;
  /** Names and what they are. */
  facts: [string, string | number][];
  findings: Finding[];
  masses: { path: string; mass: number; source: string }[];
  run?: { engine: string; duration: number; dt: number; events: string[] };
}

function findings(panel: Panel, list: Finding[]): HTMLElement {
  if (list.length === 0) {
    return h("p", {}, "Nothing to find fault with.");
  }
  const items = list.map((finding) => {
    const item = h(
      "li",
      { class: `finding ${finding.severity}` },
      h("strong", {}, finding.severity),
      ` ${finding.message} `,
      h("code", {}, finding.rule),
    );
    if (finding.prim) {
      item.append(" ", pathButton(panel.viewer, finding.prim));
    }
    if (finding.file) {
      item.append(h("div", {}, h("small", {}, `${finding.file}${finding.line ? `:${finding.line}` : ""}`)));
    }
    if (finding.fix) {
      item.append(h("div", {}, `To mend it: ${finding.fix}.`));
    }
    return item;
  });
  return h("ul", { class: "findings" }, ...items);
}

function masses(panel: Panel, data: ReportData): HTMLElement {
  const total = data.masses.reduce((sum, one) => sum + one.mass, 0);
  const sorted = [...data.masses].sort((a, b) => b.mass - a.mass);
  return h(
    "div",
    {},
    table(
      ["Body", "Mass [kg]", "Share [%]", "From"],
      sorted.map((one) => [
        pathButton(panel.viewer, one.path),
        one.mass,
        total > 0 ? Number(((100 * one.mass) / total).toFixed(1)) : 0,
        one.source,
      ]),
    ),
  );
}

export function addReport(panel: Panel, data: ReportData): void {
  const overview = h("div", {}, table(["", ""], data.facts));
  if (data.run) {
    const run = data.run;
    overview.append(
      h("h3", {}, "Motion"),
      h("p", {}, `${figure(run.duration)} s on ${run.engine}, time step ${figure(run.dt * 1000)} ms.`),
      ...run.events.map((event) => h("p", {}, event)),
    );
  }
  const about = document.getElementById("tenon-compared");
  panel.addTab("Asset", overview);
  panel.addTab(`Findings (${data.findings.length})`, findings(panel, data.findings));
  panel.addTab("Masses", masses(panel, data));
  if (about) {
    about.hidden = false;
    panel.addTab("Engines", about);
  }
  panel.openTab("Asset");
}
