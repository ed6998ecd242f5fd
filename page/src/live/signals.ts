// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What can be plotted of joints, bodies and the whole: names are those of the columns of a log of
// `tenon sim` (docs/simulation.md), lengths in metres, angles in degrees.
import { nameOf } from "../panel/dom";
import type { LiveDof, SceneNotice } from "./protocol";
import type { History, Layout, Moments, Sample } from "./history";

const degrees = 180 / Math.PI;

export interface Signal {
  /** As a column of a log is named. */
  column: string;
  /** Of a prim; "": of the whole. */
  subject: string;
  /** What of it, without an axis. */
  quantity: string;
  /** In few words. */
  label: string;
  unit: string;
  of: (sample: Sample, history: Moments) => number;
}

const at = (index: number, scale = 1) => (sample: Sample) => (sample.values[index] ?? NaN) * scale;

const unitOf = (dof: Pick<LiveDof, "angular">, of: "position" | "velocity" | "effort"): [string, number] => {
  const units = {
    position: dof.angular ? "deg" : "m",
    velocity: dof.angular ? "deg/s" : "m/s",
    effort: dof.angular ? "N m" : "N",
  };
  return [units[of], dof.angular && of !== "effort" ? degrees : 1];
};

function ofJoint(scene: SceneNotice, layout: Layout, index: number): Signal[] {
  const joint = scene.joints[index]!;
  const make = (quantity: string, part: string, unit: [string, number], place: number): Signal => ({
    column: `${joint.path}.${quantity}${part && `.${part}`}`,
    subject: joint.path,
    quantity,
    label: [nameOf(joint.path), quantity === "position" ? "" : quantity, part].filter(Boolean).join(" "),
    unit: unit[0],
    of: at(place, unit[1]),
  });
  const numbered = (k: number) => (joint.dofs.length > 1 ? String(k) : "");
  // A ball has four numbers as its position and is not plotted by them.
  const positions = joint.position.length === joint.dofs.length ? joint.dofs : [];
  const drives = joint.drives.flatMap((drive, k) => {
    const dof = joint.dofs.find((one) => one.dof === drive.dof) ?? { angular: drive.dof.startsWith("rot") };
    const part = joint.drives.length > 1 ? drive.dof : "";
    return [
      make("driveEffort", part, unitOf(dof, "effort"), layout.efforts[index]! + k),
      make("target", part, unitOf(dof, "position"), layout.targets[index]! + 2 * k),
      make("velocityTarget", part, unitOf(dof, "velocity"), layout.targets[index]! + 2 * k + 1),
    ];
  });
  return [
    ...positions.map((dof, k) =>
      make("position", numbered(k), unitOf(dof, "position"), layout.positions[index]! + k)),
    ...joint.dofs.map((dof, k) =>
      make("velocity", numbered(k), unitOf(dof, "velocity"), layout.velocities[index]! + k)),
    ...drives,
  ];
}

function ofBody(path: string, layout: Layout, index: number): Signal[] {
  const make = (quantity: string, axis: string, unit: string, of: Signal["of"]): Signal => ({
    column: `${path}.${quantity}${axis && `.${axis}`}`,
    subject: path,
    quantity,
    label: [nameOf(path), quantity, axis].filter(Boolean).join(" "),
    unit,
    of,
  });
  const axes = ["x", "y", "z"];
  const first = layout.bodies + 6 * index;
  const force = layout.forces + 3 * index;
  return [
    ...axes.map((axis, k) =>
      make("position", axis, "m", (sample, history) =>
        history.frameAt(sample.time)?.[1 + 7 * index + k] ?? NaN)),
    ...axes.map((axis, k) => make("linearVelocity", axis, "m/s", at(first + k))),
    ...axes.map((axis, k) => make("angularVelocity", axis, "deg/s", at(first + 3 + k, degrees))),
    ...axes.map((axis, k) => make("contactForce", axis, "N", at(force + k))),
    make("contactForce", "", "N", ({ values }) =>
      Math.hypot(values[force]!, values[force + 1]!, values[force + 2]!)),
  ];
}

function ofWhole(layout: Layout): Signal[] {
  const make = (column: string, label: string, unit: string, of: Signal["of"]): Signal => ({
    column,
    subject: "",
    quantity: column.split(".")[0]!,
    label,
    unit,
    of,
  });
  return [
    make("energy.kinetic", "kinetic", "J", at(layout.energy)),
    make("energy.potential", "potential", "J", at(layout.energy + 1)),
    make("energy.total", "sum", "J", ({ values }) => values[layout.energy]! + values[layout.energy + 1]!),
    make("contacts.count", "contacts", "", at(layout.contacts)),
  ];
}

export class Signals {
  private readonly jointAt: Map<string, number>;

  constructor(
    readonly scene: SceneNotice,
    private readonly layout: Layout,
  ) {
    this.jointAt = new Map(scene.joints.map((joint, i) => [joint.path, i]));
  }

  /** All of a joint or body; of "" those of the whole. */
  of(subject: string): Signal[] {
    const joint = this.jointAt.get(subject);
    const body = this.layout.bodyOf.get(subject);
    return [
      ...(subject === "" ? ofWhole(this.layout) : []),
      ...(joint === undefined ? [] : ofJoint(this.scene, this.layout, joint)),
      ...(body === undefined ? [] : ofBody(subject, this.layout, body)),
    ];
  }

  /** By its column; undefined: this asset has none. */
  find(column: string): Signal | undefined {
    const whole = this.of("").find((one) => one.column === column);
    const subject = column.slice(0, column.indexOf("."));
    return whole ?? this.of(subject).find((one) => one.column === column);
  }
}

/** A table of signals as text with commas: a row for each sample that is kept. */
export function asCsv(signals: Signal[], history: History): string {
  const quoted = (text: string) => (/[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);
  const heads = signals.map(({ column, unit }) => quoted(unit ? `${column} [${unit}]` : column));
  const lines = [["time [s]", ...heads].join(",")];
  for (let i = 0; i < history.samples.length; ++i) {
    const sample = history.samples.at(i)!;
    const cells = signals.map((one) => one.of(sample, history));
    lines.push([sample.time, ...cells.map((x) => (Number.isFinite(x) ? Number(x.toPrecision(7)) : ""))].join(","));
  }
  return `${lines.join("\n")}\n`;
}

/** Items by a key, in the order in which keys come. */
export function grouped<T>(items: readonly T[], key: (item: T) => string): Map<string, T[]> {
  const groups = new Map<string, T[]>();
  for (const item of items) {
    const group = groups.get(key(item));
    group ? group.push(item) : groups.set(key(item), [item]);
  }
  return groups;
}
