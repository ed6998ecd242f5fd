// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Numbers of the selected body or joint at the moment that is shown: pose, velocities, efforts and
// contact force; and the position of each joint in the table of joints.
import { figure, h } from "../panel/dom";
import type { History } from "./history";
import type { Session } from "./session";
import { type Signal, type Signals, grouped } from "./signals";

const quantities: Record<string, string> = {
  position: "position",
  velocity: "velocity",
  driveEffort: "effort of the drive",
  target: "target",
  velocityTarget: "target velocity",
  linearVelocity: "velocity",
  angularVelocity: "angular velocity",
  contactForce: "force of contacts",
};

/** Roll, pitch and yaw of a quaternion x, y, z, w: about fixed axes X, then Y, then Z [rad]. */
export function rollPitchYaw([x, y, z, w]: readonly [number, number, number, number]): [number, number, number] {
  const sine = Math.min(Math.max(2 * (w * y - z * x), -1), 1);
  return [
    Math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y)),
    Math.asin(sine),
    Math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)),
  ];
}

/** As one sees it: hundredths of a degree, hundredths of a millimetre. */
function rounded(value: number, unit: string): string {
  return `${Number(value.toFixed(unit === "deg" ? 2 : 5)) + 0} ${unit}`;
}

export class Values {
  private rows: { cell: HTMLElement; signals: Signal[] }[] = [];
  private orientation: { cell: HTMLElement; body: number } | null = null;
  private signals: Signals | null = null;
  private waiting = false;

  constructor(
    private readonly session: Session,
    private readonly history: History,
  ) {
    session.panel.inspector.addSource((path) => this.section(path));
    for (const event of ["sample", "shown"]) {
      history.addEventListener(event, () => this.updateSoon());
    }
    document.body.addEventListener("tenon-tab", () => this.updateSoon());
  }

  begin(signals: Signals): void {
    this.signals = signals;
    this.session.panel.inspector.update();
  }

  private section(path: string): HTMLElement | null {
    this.rows = [];
    this.orientation = null;
    const all = this.signals?.of(path) ?? [];
    if (all.length === 0) {
      return null;
    }
    const body = h("tbody");
    const row = (name: string, unit: string) => {
      const cell = h("td", { class: "number" });
      body.append(h("tr", {}, h("th", { scope: "row" }, unit ? `${name} [${unit}]` : name), cell));
      return cell;
    };
    const groups = grouped(all, (one) => `${one.quantity} ${one.unit}`);
    for (const signals of groups.values()) {
      const { quantity, unit } = signals[0]!;
      const known = signals.length === 4 ? signals.slice(0, 3) : signals; // without the length of a vector
      this.rows.push({ cell: row(quantities[quantity] ?? quantity, unit), signals: known });
      const index = this.history.layout.bodyOf.get(path);
      if (quantity === "position" && index !== undefined) {
        this.orientation = { cell: row("roll, pitch, yaw", "deg"), body: index };
      }
    }
    this.updateSoon();
    return h("section", { class: "values", "aria-live": "off" }, h("h3", {}, "Now"), h("table", {}, body));
  }

  /** With the next picture. */
  private updateSoon(): void {
    if (!this.waiting) {
      this.waiting = true;
      requestAnimationFrame(() => {
        this.waiting = false;
        this.update();
      });
    }
  }

  private update(): void {
    const { sample, frame } = this.history;
    for (const { cell, signals } of this.rows) {
      const list = signals.map((one) => (sample ? one.of(sample, this.history) : NaN));
      cell.textContent = list.map((x) => (Number.isFinite(x) ? figure(Math.abs(x) < 1e-9 ? 0 : x, 4) : "-")).join(", ");
    }
    if (this.orientation && frame) {
      const at = 1 + 7 * this.orientation.body + 3;
      const [x, y, z, w] = frame.subarray(at, at + 4);
      const angles = rollPitchYaw([x ?? 0, y ?? 0, z ?? 0, w ?? 1]);
      this.orientation.cell.textContent = angles.map((one) => figure((one * 180) / Math.PI, 4)).join(", ");
    }
    this.updateJoints();
  }

  private updateJoints(): void {
    const { sample } = this.history;
    for (const cell of Array.from(document.querySelectorAll<HTMLElement>("td.now"))) {
      if (cell.offsetParent && sample) {
        const of = this.signals?.of(cell.dataset.joint ?? "").filter((one) => one.quantity === "position") ?? [];
        cell.textContent = of.map((one) => rounded(one.of(sample, this.history), one.unit)).join(", ");
      }
    }
  }
}
