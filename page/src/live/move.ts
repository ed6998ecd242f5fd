// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Sliders. While time stands still they move joints by hand; while it goes on, and for joints with
// drives, they say what the drive is to reach: a position, a velocity. Beside each is a field for the
// same number. One request is under way at a time for each slider,
// and the newest value follows it.
import { h } from "../panel/dom";
import { pathButton } from "../panel/joints";
import type { Fields } from "./connection";
import type { LiveDof, LiveJoint, PlotsNotice, SceneNotice } from "./protocol";
import { type Session, attempt } from "./session";

const degrees = 180 / Math.PI;
const mostRows = 200;

/** Sends values one after the other; those that come meanwhile are left out but for the last. */
class Sender {
  private next: number | null = null;
  private busy = false;

  constructor(private readonly send: (value: number) => Promise<unknown>) {}

  put(value: number): void {
    this.next = value;
    if (!this.busy) {
      void this.run();
    }
  }

  private async run(): Promise<void> {
    this.busy = true;
    while (this.next !== null) {
      const value = this.next;
      this.next = null;
      await this.send(value);
    }
    this.busy = false;
  }
}

/** What a slider stands for: the unit that people read, and how many of it are one of SI. */
export interface Scale {
  unit: string;
  factor: number;
}

const lengths: Scale = { unit: "mm", factor: 1000 };
const scaleOf = (dof: LiveDof, what: "position" | "velocity" | "effort"): Scale => {
  if (what === "effort") {
    return { unit: dof.angular ? "N m" : "N", factor: 1 };
  }
  const { unit, factor } = dof.angular ? { unit: "deg", factor: degrees } : lengths;
  return what === "velocity" ? { unit: `${unit}/s`, factor } : { unit, factor };
};

/** Hundredths of a degree or millimetre: what is less is no motion that one sees. */
const rounded = ({ factor }: Scale, value: number): number => {
  const places = factor === 1 ? 1e4 : 100;
  return Math.round(value * factor * places) / places + 0;
};

interface Row {
  what: string;
  scale: Scale;
  value: number;
  lower: number | null;
  upper: number | null;
  /** Half of what is offered where there is no limit. */
  open: number;
  send: (value: number) => Promise<unknown>;
}

/** A slider and a field for the same number. */
export class Slider {
  readonly element: HTMLElement;
  readonly input: HTMLInputElement;
  private readonly field: HTMLInputElement;

  constructor(private readonly row: Row, disabled = false) {
    const { what, scale, value, open } = row;
    const lower = row.lower ?? Math.min(-open, value - open);
    const upper = row.upper ?? Math.max(open, value + open);
    const sender = new Sender(row.send);
    this.input = h("input", {
      type: "range",
      min: Math.min(lower, upper),
      max: Math.max(lower, upper),
      step: "any",
      value,
      disabled,
      oninput: () => {
        this.field.value = String(rounded(scale, Number(this.input.value)));
        sender.put(Number(this.input.value));
      },
    });
    this.field = h("input", {
      type: "number",
      step: "any",
      value: rounded(scale, value),
      disabled,
      "aria-label": scale.unit ? `${what} in ${scale.unit}` : `${what} as a number`,
      onchange: () => {
        const wanted = Number(this.field.value) / scale.factor;
        if (this.field.value !== "" && Number.isFinite(wanted)) {
          this.cover(wanted);
          this.input.value = String(wanted);
          sender.put(wanted);
        }
      },
    });
    // Beside each other: a label names one control alone.
    this.element = h(
      "div",
      { class: "slider" },
      h("label", {}, h("span", {}, what), this.input),
      h("span", { class: "field" }, this.field, h("span", { class: "unit" }, scale.unit)),
    );
  }

  /** A value that came, unless it is being set here. */
  show(value: number): void {
    const { activeElement } = document;
    if (activeElement !== this.input && activeElement !== this.field) {
      this.cover(value);
      this.input.value = String(value);
      this.field.value = String(rounded(this.row.scale, value));
    }
  }

  /** Where there is no limit, the slider reaches as far as what it shows. */
  private cover(value: number): void {
    const { lower, upper } = this.row;
    if (upper === null && value > Number(this.input.max)) {
      this.input.max = String(value);
    }
    if (lower === null && value < Number(this.input.min)) {
      this.input.min = String(value);
    }
  }
}

export class Move {
  private readonly page: HTMLElement;
  private positions: { slider: Slider; at: [number, number] }[] = [];
  private targets: { slider: Slider; at: [number, number, 0 | 1] }[] = [];
  private joints: LiveJoint[] = [];

  constructor(private readonly session: Session) {
    this.page = session.panel.addTab("Move");
    session.connection.on("scene", (scene) => this.build(scene));
    session.connection.on("plots", (plots) => this.follow(plots));
    session.connection.on("closed", () =>
      this.page.querySelectorAll("input").forEach((input) => (input.disabled = true)),
    );
  }

  private build(scene: SceneNotice): void {
    this.positions = [];
    this.targets = [];
    this.joints = scene.joints;
    const rows: HTMLElement[] = [];
    scene.joints.forEach((joint, index) => {
      if (rows.length < mostRows && joint.dofs.length > 0 && joint.position.length > 0) {
        rows.push(this.row(joint, index));
      }
    });
    const notes: string[] = [];
    if (scene.problem) {
      notes.push(scene.problem.message, scene.problem.fix ?? "");
    } else if (rows.length === 0) {
      notes.push("This asset has no joints to move.");
    }
    this.page.replaceChildren(...notes.map((note) => h("p", {}, note)), ...rows);
  }

  private row(joint: LiveJoint, index: number): HTMLElement {
    const { viewer } = this.session.panel;
    const row = h(
      "section",
      { class: "mover", "data-joint": joint.path },
      h("h3", {}, pathButton(viewer, joint.path)),
    );
    if (joint.follows) {
      const leader = joint.leader ? pathButton(viewer, joint.leader) : "another joint";
      row.append(h("p", { class: "status" }, "follows ", leader, ", which moves it"));
    }
    joint.dofs.forEach((dof, k) => {
      const values = joint.position;
      const slider = this.slider(dof, "position", "position", joint.position[k] ?? 0, joint.follows, (value) => {
        values[k] = value;
        return attempt(this.session, "setJoint", { joint: joint.path, position: values });
      });
      this.positions.push({ slider, at: [index, k] });
      row.append(slider.element);
    });
    joint.drives.forEach((_, k) => row.append(...this.driveRows(joint, index, k)));
    if (!joint.follows) {
      row.append(this.effortRows(joint));
    }
    return row;
  }

  /** What a drive is to reach: a position where it has stiffness, a velocity where it has damping. */
  private driveRows(joint: LiveJoint, index: number, k: number): HTMLElement[] {
    const drive = joint.drives[k]!;
    const dof = joint.dofs.find((one) => one.dof === drive.dof);
    const rows: HTMLElement[] = [];
    const set = (field: keyof Fields<"setDrive">) => (value: number) =>
      attempt(this.session, "setDrive", { joint: joint.path, drive: k, [field]: value });
    if (dof && drive.stiffness > 0) {
      const slider = this.slider(dof, "position", "drive to", drive.position, false, set("position"));
      this.targets.push({ slider, at: [index, k, 0] });
      rows.push(slider.element);
    }
    if (dof && drive.damping > 0) {
      const slider = this.slider(dof, "velocity", "drive at", drive.velocity, false, set("velocity"));
      this.targets.push({ slider, at: [index, k, 1] });
      rows.push(slider.element);
    }
    return rows;
  }

  /** Efforts on top of drives; closed until somebody wants them. */
  private effortRows(joint: LiveJoint): HTMLElement {
    const efforts = joint.dofs.map(() => 0);
    const rows = joint.dofs.map((dof, k) =>
      this.slider(dof, "effort", "push with", 0, false, (value) => {
        efforts[k] = value;
        return attempt(this.session, "setEffort", { joint: joint.path, effort: efforts });
      }).element,
    );
    return h("details", {}, h("summary", {}, "Effort"), ...rows);
  }

  private slider(
    dof: LiveDof,
    kind: "position" | "velocity" | "effort",
    what: string,
    value: number,
    disabled: boolean,
    send: (value: number) => Promise<unknown>,
  ): Slider {
    const open = { position: dof.angular ? Math.PI : 0.5, velocity: dof.angular ? 2 * Math.PI : 1, effort: 10 }[kind];
    const [lower, upper] = kind === "position" ? [dof.lower, dof.upper] : [null, null];
    const row = { what: `${what} ${dof.dof}`, scale: scaleOf(dof, kind), value, lower, upper, open, send };
    return new Slider(row, disabled);
  }

  /** Positions and targets as they are while time goes on. */
  private follow(plots: PlotsNotice): void {
    for (const { slider, at } of this.positions) {
      const value = plots.joints[at[0]]?.[at[1]];
      const joint = this.joints[at[0]];
      if (value !== undefined && joint) {
        slider.show(value);
        joint.position[at[1]] = value;
      }
    }
    for (const { slider, at } of this.targets) {
      const value = plots.targets[at[0]]?.[at[1]]?.[at[2]];
      value !== undefined && slider.show(value);
    }
  }
}
