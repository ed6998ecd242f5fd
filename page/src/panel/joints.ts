// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// All joints in a table: kind, range and drive of each.
import type { JointInfo, LimitInfo } from "../scene/info";
import type { Viewer } from "../scene/viewer";
import { figure, h, nameOf, table } from "./dom";

const degrees = 180 / Math.PI;

/** "-10 to 95 deg" */
export function rangeText(limit: LimitInfo): string {
  const angular = limit.dof.startsWith("rot");
  const shown = (value: number | null, open: string) =>
    value === null ? open : figure(angular ? value * degrees : value * 1000, 4);
  if (limit.lower !== null && limit.upper !== null && limit.lower > limit.upper) {
    return `${limit.dof} locked`;
  }
  return `${shown(limit.lower, "-inf")} to ${shown(limit.upper, "inf")} ${angular ? "deg" : "mm"}`;
}

/** Gains with their units: angular ones are for radians. */
export function driveText(joint: JointInfo): string {
  return joint.drives
    .map((drive) => {
      const angular = drive.dof.startsWith("rot");
      const [stiffness, damping, force] = angular
        ? ["N m/rad", "N m s/rad", "N m"]
        : ["N/m", "N s/m", "N"];
      const gains = `${figure(drive.stiffness, 4)} ${stiffness}, ${figure(drive.damping, 4)} ${damping}`;
      return drive.maxForce === null ? gains : `${gains}, at most ${figure(drive.maxForce, 4)} ${force}`;
    })
    .join("; ");
}

export function pathButton(viewer: Viewer, path: string): HTMLElement {
  return h(
    "button",
    { type: "button", class: "link", title: path, onclick: () => viewer.select(path) },
    nameOf(path),
  );
}

export function jointTable(viewer: Viewer): HTMLElement {
  const joints = viewer.info.joints;
  if (joints.length === 0) {
    return h("p", {}, "This asset has no joints.");
  }
  const made = table(
    ["Joint", "Range", "Drive: stiffness, damping", "Now"],
    joints.map((joint) => [
      h("div", {}, pathButton(viewer, joint.path), " ", h("small", {}, joint.kind)),
      joint.limits.map(rangeText).join("; ") || "free",
      driveText(joint) || "none",
      "",
    ]),
  );
  made.classList.add("joints");
  joints.forEach((joint, i) => {
    const cell = made.tBodies[0]!.rows[i]!.cells[3]!;
    cell.classList.add("now");
    cell.dataset.joint = joint.path;
  });
  return made;
}
