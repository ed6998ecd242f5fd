// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Sliders. While time stands still they move joints by hand; while it goes on, and for joints with
// drives, they say what the drive is to reach. One request is under way at a time for each slider,
// and the newest value follows it.
import { h, nameOf } from "../panel/dom";
import type { LiveDof, LiveJoint, PlotsNotice, SceneNotice } from "./connection";
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

/** Hundredths of a degree or millimetre: what is less is no motion that one sees. */
const shown = (dof: LiveDof, value: number): string => {
  const rounded = Math.round(value * (dof.angular ? degrees : 1000) * 100) / 100 + 0;
  return `${rounded} ${dof.angular ? "deg" : "mm"}`;
};

export class Move {
  private readonly page: HTMLElement;
  private sliders: { input: HTMLInputElement; text: HTMLElement; dof: LiveDof; at: [number, number] }[] =
    [];
  private joints: LiveJoint[] = [];

  constructor(private readonly session: Session) {
    this.page = session.panel.addTab("Move");
    session.connection.on<SceneNotice>("scene", (scene) => this.build(scene));
    session.connection.on<PlotsNotice>("plots", (plots) => this.follow(plots));
  }

  private build(scene: SceneNotice): void {
    this.sliders = [];
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
    const title = h(
      "button",
      { type: "button", class: "link", title: joint.path, onclick: () => this.session.panel.viewer.select(joint.path) },
      nameOf(joint.path),
    );
    const row = h("section", { class: "mover", "data-joint": joint.path }, h("h3", {}, title));
    if (joint.follows) {
      row.append(h("p", { class: "status" }, "follows another joint"));
    }
    joint.dofs.forEach((dof, k) => {
      const values = joint.position;
      row.append(
        this.slider("position", dof, joint.position[k] ?? 0, [index, k], (value) => {
          values[k] = value;
          return attempt(this.session, "setJoint", { joint: joint.path, position: values });
        }),
      );
    });
    joint.drives.forEach((drive, k) => {
      const dof = joint.dofs.find((one) => one.dof === drive.dof);
      if (dof && drive.stiffness > 0) {
        row.append(
          this.slider("drive to", dof, drive.position, null, (position) =>
            attempt(this.session, "setDrive", { joint: joint.path, drive: k, position }),
          ),
        );
      }
    });
    return row;
  }

  private slider(
    what: string,
    dof: LiveDof,
    value: number,
    at: [number, number] | null,
    send: (value: number) => Promise<unknown>,
  ): HTMLElement {
    const open = dof.angular ? Math.PI : 0.5;
    const lower = dof.lower ?? Math.min(-open, value - open);
    const upper = dof.upper ?? Math.max(open, value + open);
    const sender = new Sender(send);
    const text = h("output", { class: "number" }, shown(dof, value));
    const input: HTMLInputElement = h("input", {
      type: "range",
      min: Math.min(lower, upper),
      max: Math.max(lower, upper),
      step: "any",
      value,
      oninput: () => {
        text.textContent = shown(dof, Number(input.value));
        sender.put(Number(input.value));
      },
    });
    if (at) {
      this.sliders.push({ input, text, dof, at });
    }
    return h("label", { class: "slider" }, h("span", {}, `${what} ${dof.dof}`), input, text);
  }

  /** Positions as they are while time goes on. */
  private follow(plots: PlotsNotice): void {
    for (const { input, text, dof, at } of this.sliders) {
      const value = plots.joints[at[0]]?.[at[1]];
      if (value !== undefined && document.activeElement !== input) {
        input.value = String(value);
        text.textContent = shown(dof, value);
        const joint = this.joints[at[0]];
        if (joint) {
          joint.position[at[1]] = value;
        }
      }
    }
  }
}
