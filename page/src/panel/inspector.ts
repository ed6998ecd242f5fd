// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What is known of the selected prim. `addSource` lets others say more: what comes of a source is
// shown below, when it comes.
import type { Viewer } from "../scene/viewer";
import { figure, h, table } from "./dom";
import { driveText, pathButton, rangeText } from "./joints";

export type InspectorSource = (path: string) => Node | Promise<Node | null> | null;

/** Of a volume [m3], in a unit in which it is no number of many digits. */
export function volumeText(volume: number): string {
  return volume >= 0.01 ? `${figure(volume, 4)} m3` : `${figure(volume * 1e6, 4)} cm3`;
}

export class Inspector {
  readonly element = h("div", { class: "inspector", "aria-live": "polite" });
  private readonly sources: InspectorSource[] = [];

  constructor(private readonly viewer: Viewer) {
    this.addSource((path) => this.summary(path));
    viewer.addEventListener("select", () => this.update());
    viewer.addEventListener("load", () => this.update());
    this.update();
  }

  addSource(source: InspectorSource): void {
    this.sources.push(source);
  }

  update(): void {
    const path = this.viewer.selected;
    if (!path) {
      this.element.replaceChildren(
        h("p", {}, "Click on a part, or choose a prim in the tree, to see what it is."),
      );
      return;
    }
    this.element.replaceChildren(...[this.several(), h("h2", {}, path)].filter((one) => one !== null));
    for (const source of this.sources) {
      const place = h("div");
      this.element.append(place);
      void Promise.resolve(source(path)).then((node) => {
        if (node) {
          place.append(node);
        }
      });
    }
  }

  private summary(path: string): Node {
    const parts = [this.body(path), this.joint(path), ...this.colliders(path)];
    const known = parts.filter((part): part is HTMLElement => part !== null);
    return h("div", {}, ...(known.length > 0 ? known : [h("p", {}, "A prim without physics.")]));
  }

  /** What is to be said of several prims together; null: one is selected. */
  private several(): HTMLElement | null {
    const all = this.viewer.selection();
    if (all.length < 2) {
      return null;
    }
    const { info, bodies } = this.viewer;
    const chosen = info.bodies.flatMap((body, i) => (all.includes(body.path) ? [{ body, node: bodies[i] }] : []));
    const rows: [string, string | Node][] = all.map((path) => ["", pathButton(this.viewer, path)]);
    if (chosen.length > 0) {
      const mass = chosen.reduce((sum, one) => sum + one.body.mass, 0);
      rows.unshift(["mass together", `${figure(mass)} kg`]);
    }
    if (chosen.length === 2) {
      const [one, other] = chosen.map(({ body, node }) =>
        node!.localToWorld(node!.position.clone().fromArray(body.centerOfMass)),
      );
      rows.unshift(["between centres of mass", `${figure(one!.distanceTo(other!) * 1000)} mm`]);
    }
    return this.facts(`${all.length} selected`, rows);
  }

  private facts(title: string, rows: [string, string | Node][]): HTMLElement {
    return h("section", {}, h("h3", {}, title), table(["", ""], rows));
  }

  private body(path: string): HTMLElement | null {
    const info = this.viewer.info;
    const index = info.bodies.findIndex((one) => one.path === path);
    const body = info.bodies[index];
    if (!body) {
      return null;
    }
    const rows: [string, string | Node][] = [
      ["mass", `${figure(body.mass)} kg`],
      ["centre of mass", `${body.centerOfMass.map((x) => figure(x * 1000, 4)).join(", ")} mm`],
      ["principal moments", `${body.principalMoments.map((x) => figure(x, 4)).join(", ")} kg m2`],
    ];
    if (body.kinematic || !body.enabled) {
      rows.push(["moves", body.enabled ? "by its animation alone" : "not at all"]);
    }
    for (const joint of info.joints) {
      if (joint.body0 === index || joint.body1 === index) {
        rows.push([joint.body1 === index ? "held by" : "holds", pathButton(this.viewer, joint.path)]);
      }
    }
    const apart = info.filteredPairs.filter((pair) => pair.includes(index)).length;
    rows.push(["does not touch", `${apart} ${apart === 1 ? "body" : "bodies"}`]);
    for (const collider of info.colliders) {
      if (collider.body === index && collider.path !== path) {
        rows.push(["collider", pathButton(this.viewer, collider.path)]);
      }
    }
    return this.facts("Body", rows);
  }

  private joint(path: string): HTMLElement | null {
    const info = this.viewer.info;
    const joint = info.joints.find((one) => one.path === path);
    if (!joint) {
      return null;
    }
    const side = (body: number | null) => {
      const known = body === null ? undefined : info.bodies[body];
      return known ? pathButton(this.viewer, known.path) : "the world";
    };
    const rows: [string, string | Node][] = [
      ["kind", joint.kind],
      ["between", side(joint.body0)],
      ["and", side(joint.body1)],
    ];
    if (joint.kind === "revolute" || joint.kind === "prismatic") {
      rows.push(["axis", joint.axis]);
    }
    rows.push(["range", joint.limits.map(rangeText).join("; ") || "free"]);
    rows.push(["drive", driveText(joint) || "none"]);
    if (!joint.enabled) {
      rows.push(["enabled", "no"]);
    }
    if (joint.closesLoop) {
      rows.push(["closes a loop", "yes"]);
    }
    return this.facts("Joint", rows);
  }

  private colliders(path: string): HTMLElement[] {
    const of = this.viewer.info.colliders.filter((one) => one.path === path);
    return of.map((collider) => {
      const rows: [string, string | Node][] = [
        ["shape", collider.kind],
        ["volume", volumeText(collider.volume)],
      ];
      if (collider.approximation) {
        rows.push(["asked for", collider.approximation]);
      }
      if (collider.sourceVolume !== null) {
        rows.push(["volume of the mesh", volumeText(collider.sourceVolume)]);
      }
      if (collider.hullGap !== null) {
        rows.push(["holds more by", `${figure(collider.hullGap * 100, 3)} %`]);
      }
      if (!collider.enabled) {
        rows.push(["enabled", "no"]);
      }
      return this.facts("Collider", rows);
    });
  }
}
