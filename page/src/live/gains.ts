// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Gains of drives as natural frequency and damping ratio, as `tenon tune` tells. Sliders set them in
// the simulation as it runs; what is set stays until it is saved or forgotten. Tests run beside the
// simulation, one drive after the other, and draw command and response of each.
import { figure, h, nameOf } from "../panel/dom";
import { pathButton } from "../panel/joints";
import type { Fields } from "./connection";
import { Slider } from "./move";
import { restWhileClosed, whenOpen, writer } from "./pages";
import type { TunedDrive } from "./protocol";
import { review } from "./review";
import { type Session, attempt } from "./session";
import { Task } from "./task";
import { TestedDrives } from "./tested";

const cycle = 2 * Math.PI;
const hertz = { unit: "Hz", factor: 1 / cycle };
const plain = { unit: "", factor: 1 };
const mostSliders = 12;

interface Row {
  drive: TunedDrive;
  cells: HTMLElement[];
  note: HTMLElement;
  box: HTMLInputElement;
}

export class Gains {
  private readonly task: Task<"testDrives">;
  private readonly place = h("div");
  private readonly sliders = h("div");
  private readonly save: HTMLButtonElement;
  private readonly forget: HTMLButtonElement;
  private readonly kind: HTMLSelectElement;
  private readonly period: HTMLInputElement;
  private readonly amplitude: HTMLInputElement;
  private readonly tested: TestedDrives;
  private rows: Row[] = [];
  /** Joints whose sliders are there, and which are tested. */
  private readonly chosen = new Set<string>();

  constructor(private readonly session: Session) {
    this.task = new Task(session, "testDrives");
    this.tested = new TestedDrives(session);
    this.save = writer(session, "Save gains...", () => void review(session, "saveGains", {}));
    this.forget = h("button", { type: "button", onclick: () => void this.asInFiles() }, "As in the files");
    const tests = { snap: "snap to limits", step: "step", sine: "sine" };
    this.kind = h("select", { "aria-label": "Test", onchange: () => this.showOptions() },
      ...Object.entries(tests).map(([value, text]) => h("option", { value }, text)));
    this.period = h("input", { type: "number", min: 0.05, max: 60, step: "any", value: 2, "aria-label": "Period in s" });
    this.amplitude = h("input", { type: "number", min: 0.01, max: 100, step: "any", value: 10, "aria-label": "Amplitude in per cent of the range" });
    const test = h("button", { type: "button", onclick: () => void this.test() }, "Test ticked joints");
    const page = session.panel.addTab(
      "Gains",
      this.place,
      this.sliders,
      h("div", { class: "buttons" }, this.save, this.forget),
      h("h3", {}, "Tests"),
      h("div", { class: "choices" }, this.kind, test),
      h("div", { class: "choices" }, h("label", {}, this.period, " s"), h("label", {}, this.amplitude, " % of the range")),
      this.task.element,
      this.tested.element,
    );
    restWhileClosed(session, page);
    whenOpen(session, "Gains", () => void this.load());
    this.showOptions();
  }

  private showOptions(): void {
    for (const field of [this.period, this.amplitude]) {
      field.disabled = this.kind.value === "snap";
    }
  }

  private async load(): Promise<void> {
    const answer = await attempt(this.session, "gains");
    if (!answer) {
      return;
    }
    const drives = answer.drives.filter((one) => one.type !== null);
    this.rows = drives.map((drive) => this.row(drive));
    const tunable = this.rows.filter(({ drive }) => drive.whyNot === null);
    if (![...this.chosen].some((path) => tunable.some(({ drive }) => drive.joint === path))) {
      tunable[0] && this.chosen.add(tunable[0].drive.joint);
    }
    this.rows.forEach((row) => this.show(row));
    const heads = ["Joint", "Hz", "Ratio", "Stiffness, damping"];
    this.place.replaceChildren(
      this.rows.length === 0
        ? h("p", {}, "This asset has no drives.")
        : h("table", { class: "gains" },
            h("thead", {}, h("tr", {}, ...heads.map((head) => h("th", { scope: "col" }, head)))),
            h("tbody", {}, ...this.rows.map((row) => this.line(row)))),
    );
    this.buildSliders();
    this.update();
  }

  private row(drive: TunedDrive): Row {
    const box: HTMLInputElement = h("input", {
      type: "checkbox",
      disabled: drive.whyNot !== null,
      "aria-label": `Set and test ${nameOf(drive.joint)} ${drive.axis}`,
      onchange: () => {
        box.checked ? this.chosen.add(drive.joint) : this.chosen.delete(drive.joint);
        this.rows.forEach((row) => this.show(row));
        this.buildSliders();
      },
    });
    return { drive, box, cells: [0, 1, 2].map(() => h("td", { class: "number" })), note: h("div") };
  }

  private line({ drive, box, cells, note }: Row): HTMLElement {
    const name = pathButton(this.session.panel.viewer, drive.joint);
    const kind = drive.type === "acceleration" ? ", acceleration" : "";
    return h(
      "tr",
      { "data-joint": drive.joint },
      h("td", {}, box, " ", name, h("div", {}, h("small", {}, `${drive.axis}${kind}`)), note),
      ...cells,
    );
  }

  /** The numbers of a row as they are now. */
  private show({ drive, box, cells, note }: Row): void {
    const now = drive.to ?? drive;
    box.checked = drive.whyNot === null && this.chosen.has(drive.joint);
    const values = [[now.frequencyHz], [now.dampingRatio], [now.stiffness, now.damping]];
    values.forEach((list, i) => {
      cells[i]!.replaceChildren(...list.map((value) => h("div", {}, figure(value, 4))));
      cells[i]!.classList.toggle("set", drive.to !== null);
    });
    const notes = [drive.whyNot, drive.to ? "set here, not saved" : null, now.regime, ...drive.notes];
    note.replaceChildren(...notes.flatMap((one) => (one ? [h("small", {}, one), h("br")] : [])));
  }

  private update(): void {
    const any = this.rows.some(({ drive }) => drive.to !== null);
    this.save.disabled = !any;
    this.forget.disabled = !any;
  }

  private buildSliders(): void {
    const rows = this.rows.filter(({ drive }) => drive.whyNot === null && this.chosen.has(drive.joint));
    const left = rows.length - mostSliders;
    this.sliders.replaceChildren(
      ...rows.slice(0, mostSliders).map((row) => this.slidersOf(row)),
      ...(left > 0 ? [h("p", {}, `${left} more have no sliders here.`)] : []),
    );
  }

  private slidersOf(row: Row): HTMLElement {
    const { drive } = row;
    const now = drive.to ?? drive;
    const { joint, axis: dof } = drive;
    const warning = h("p", { class: "weak", role: "status" });
    const sliders: Slider[] = [];
    const send = (field: keyof Fields<"setGains">) => async (value: number) => {
      const set = await attempt(this.session, "setGains", { joint, dof, [field]: value });
      if (set) {
        drive.to = set;
        this.show(row);
        this.update();
        sliders[0]!.show(set.frequency ?? 0);
        sliders[1]!.show(set.dampingRatio ?? 0);
        const unstable = set.stableUpTo !== null && (set.frequency ?? 0) > set.stableUpTo;
        warning.textContent = unstable ? `Unstable with these time steps, which hold up to ${figure(set.stableUpTo! / cycle, 4)} Hz.` : "";
      }
    };
    sliders.push(
      new Slider({ what: "frequency", scale: hertz, value: now.frequency ?? 0, lower: 0, upper: null, open: 25 * cycle, send: send("frequency") }),
      new Slider({ what: "damping ratio", scale: plain, value: now.dampingRatio ?? 1, lower: 0, upper: null, open: 2, send: send("dampingRatio") }),
    );
    return h(
      "section",
      { class: "mover", "data-joint": joint, "aria-label": `Gains of ${nameOf(joint)} ${dof}` },
      h("h3", {}, `${nameOf(joint)} ${dof}`),
      ...sliders.map((one) => one.element),
      warning,
    );
  }

  private async asInFiles(): Promise<void> {
    await attempt(this.session, "forgetGains");
    await this.load();
  }

  private async test(): Promise<void> {
    const joints = this.rows.filter(({ box }) => box.checked).map(({ drive }) => drive.joint);
    if (joints.length === 0) {
      this.session.messages.complain("No joint is ticked: tick those to test.");
      return;
    }
    const test = this.kind.value;
    const more = test === "snap" ? {} : { period: Number(this.period.value), amplitude: Number(this.amplitude.value) / 100 };
    this.tested.clear();
    const answer = await this.task.run({
      test,
      joints: [...new Set(joints)].slice(0, 256),
      ...more,
    });
    if (answer?.interrupted) {
      this.session.messages.say("Ended before its end: what was tested until then stays.");
    }
    this.tested.finish(answer?.engines.flatMap((one) => one.results) ?? []);
  }
}
