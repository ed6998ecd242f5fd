// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What each motor can do and has to hold, as `tenon drives` tells, and its limits as fields.
import { figure, h, nameOf } from "../panel/dom";
import { pathButton } from "../panel/joints";
import { restWhileClosed, whenOpen, writer } from "./pages";
import type { DriveDemand, DriveLimits } from "./protocol";
import { review } from "./review";
import type { Session } from "./session";
import { Task } from "./task";

const degrees = 180 / Math.PI;

export class Drives {
  private readonly task: Task<"drives">;
  private readonly postures: HTMLInputElement;
  private readonly place = h("div");
  private readonly save: HTMLButtonElement;
  private readonly changes = new Map<string, DriveLimits>();

  constructor(private readonly session: Session) {
    this.task = new Task(session, "drives");
    this.postures = h("input", { type: "number", min: 0, max: 10000, value: 100, "aria-label": "Postures to look at" });
    const look = h("button", { type: "button", onclick: () => void this.look() }, "Look again");
    this.save = writer(session, "Save limits...", () => void this.write());
    const page = session.panel.addTab(
      "Drives",
      h("p", {}, "What each motor can do, and the largest weight that it has to hold over the postures."),
      h("div", { class: "choices" }, look, h("label", {}, this.postures, " postures")),
      this.task.element,
      this.place,
      h("div", { class: "buttons" }, this.save),
    );
    restWhileClosed(session, page);
    whenOpen(session, "Drives", () => void this.look());
  }

  private async look(): Promise<void> {
    const postures = Math.min(Math.max(Math.round(Number(this.postures.value)) || 0, 0), 10000);
    const answer = await this.task.run({ postures });
    if (answer) {
      this.changes.clear();
      this.save.disabled = true;
      const heads = ["Joint, and what it holds", "Most effort", "Most speed"];
      const rows = answer.drives.map((drive) => this.row(drive));
      this.place.replaceChildren(
        rows.length === 0
          ? h("p", {}, "This asset has no drives.")
          : h("table", { class: "drives" },
              h("thead", {}, h("tr", {}, ...heads.map((head) => h("th", { scope: "col" }, head)))),
              h("tbody", {}, ...rows)),
      );
    }
  }

  private row(drive: DriveDemand): HTMLElement {
    const turns = drive.dof.startsWith("rot");
    const unit = turns ? "N m" : "N";
    const [least, most] = drive.inertia.map((one) => figure(one, 3));
    const inertia = `${least === most ? least : `${least} to ${most}`} ${turns ? "kg m2" : "kg"}`;
    const notes = [
      drive.tooWeak ? h("strong", { class: "weak" }, "too weak") : null,
      drive.followers.length > 0 ? h("small", {}, `and ${drive.followers.map(nameOf).join(", ")}`) : null,
    ];
    return h(
      "tr",
      { "data-joint": drive.joint },
      h("td", {}, pathButton(this.session.panel.viewer, drive.joint), h("small", {}, ` ${drive.dof}`),
        h("div", {}, `holds ${drive.weight === null ? "what is not known" : `${figure(drive.weight, 3)} ${unit}`}`),
        h("div", {}, h("small", {}, `moves ${inertia}`)),
        ...notes.map((note) => note && h("div", {}, note))),
      this.field(drive, "maxEffort", drive.maxEffort, 1, unit),
      this.field(drive, "speedLimit", drive.speedLimit, turns ? degrees : 1, turns ? "deg/s" : "m/s"),
    );
  }

  private field(drive: DriveDemand, what: "maxEffort" | "speedLimit", value: number | null, factor: number, unit: string): HTMLElement {
    const { joint, dof } = drive;
    const key = `${joint} ${dof}`;
    const name = what === "maxEffort" ? "Most effort" : "Most speed";
    const field: HTMLInputElement = h("input", {
      type: "number",
      step: "any",
      min: 0,
      value: value === null ? "" : figure(value * factor, 6),
      placeholder: "no limit",
      "aria-label": `${name} of ${nameOf(joint)} in ${unit}`,
      onchange: () => {
        const wanted = Number(field.value) / factor;
        const limits: DriveLimits = this.changes.get(key) ?? { joint, dof };
        delete limits[what];
        if (field.value !== "" && Number.isFinite(wanted)) {
          limits[what] = wanted;
        }
        limits.maxEffort === undefined && limits.speedLimit === undefined ? this.changes.delete(key) : this.changes.set(key, limits);
        this.save.disabled = this.changes.size === 0;
      },
    });
    return h("td", {}, field, h("div", {}, h("small", {}, unit)));
  }

  private async write(): Promise<void> {
    await review(this.session, "setLimits", { limits: [...this.changes.values()] });
  }
}
