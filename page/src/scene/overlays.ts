// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What is laid over the picture: each kind is made when it is first shown. What belongs to a body
// hangs below its node and moves with it; what lies between bodies is placed again by `follow`.
import * as THREE from "three";
import type { JointInfo, LimitInfo, Pose } from "./info";
import type { Viewer } from "./viewer";

export const overlayNames = [
  "joints",
  "limits",
  "inertia",
  "masses",
  "frames",
  "tree",
  "filtered",
  "contacts",
] as const;
/** What is laid over the picture without a switch: the mark of a selected joint. */
type Laid = OverlayName | "selection";
export type OverlayName = (typeof overlayNames)[number];

const colors = {
  joints: 0xe0a020,
  limits: 0x3f9fd8,
  inertia: 0x8a63d2,
  masses: 0xd23f5f,
  tree: 0x2c9f6b,
  filtered: 0x888f98,
  contacts: 0xe0533a,
  selection: 0x2f7fe0,
};

const axes = { X: [1, 0, 0], Y: [0, 1, 0], Z: [0, 0, 1] } as const;

function paint(color: number, opacity = 1): THREE.MeshBasicMaterial {
  return new THREE.MeshBasicMaterial({
    color,
    opacity,
    transparent: opacity < 1,
    side: THREE.DoubleSide,
    depthTest: opacity < 1,
  });
}

/** A stick along Y of length 1, its foot at the origin. */
const stick = new THREE.CylinderGeometry(1, 1, 1, 8).translate(0, 0.5, 0);
const tip = new THREE.ConeGeometry(1, 1, 12).translate(0, 0.5, 0);
const ball = new THREE.SphereGeometry(1, 12, 8);

function arrow(length: number, thickness: number, material: THREE.Material): THREE.Group {
  const group = new THREE.Group();
  const shaft = new THREE.Mesh(stick, material);
  shaft.scale.set(thickness, length * 0.82, thickness);
  const head = new THREE.Mesh(tip, material);
  head.scale.set(thickness * 2.6, length * 0.18, thickness * 2.6);
  head.position.y = length * 0.82;
  group.add(shaft, head);
  return group;
}

function between(from: THREE.Vector3, to: THREE.Vector3, mesh: THREE.Object3D, thickness: number) {
  const along = to.clone().sub(from);
  const length = along.length();
  mesh.visible = length > 1e-9;
  mesh.position.copy(from);
  mesh.scale.set(thickness, Math.max(length, 1e-9), thickness);
  mesh.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), along.normalize());
}

function place(object: THREE.Object3D, pose: Pose): THREE.Object3D {
  object.position.set(pose[0], pose[1], pose[2]);
  object.quaternion.set(pose[3], pose[4], pose[5], pose[6]);
  return object;
}

const axisOf = (dof: string): "X" | "Y" | "Z" => dof.slice(-1) as "X" | "Y" | "Z";

/** A fan from `lower` to `upper` about an axis, where zero is the axis after it. */
function limitArc(limit: LimitInfo, radius: number): THREE.Object3D | null {
  const { lower, upper } = limit;
  if (lower === null || upper === null || lower > upper) {
    return null;
  }
  const angle = Math.min(upper - lower, 2 * Math.PI);
  const fan = new THREE.RingGeometry(radius * 0.35, radius, 48, 1, lower, angle);
  const mesh = new THREE.Mesh(fan, paint(colors.limits, 0.4));
  const axis = axisOf(limit.dof);
  // The ring lies in XY and turns about Z: a cyclic turn brings Z to the axis, X to the one after.
  if (axis === "X") {
    mesh.quaternion.set(0.5, 0.5, 0.5, 0.5);
  } else if (axis === "Y") {
    mesh.quaternion.set(-0.5, -0.5, -0.5, 0.5);
  }
  return mesh;
}

function limitRail(limit: LimitInfo, thickness: number): THREE.Object3D | null {
  const { lower, upper } = limit;
  if (lower === null || upper === null || lower > upper) {
    return null;
  }
  const direction = new THREE.Vector3(...axes[axisOf(limit.dof)]);
  const mesh = new THREE.Mesh(stick, paint(colors.limits, 0.6));
  between(direction.clone().multiplyScalar(lower), direction.multiplyScalar(upper), mesh, thickness);
  return mesh;
}

export class Overlays {
  /** Of each contact its point [m] and force [N], in the world's axes. */
  contacts: Float32Array = new Float32Array();
  private contactsAreNew = false;
  /** All of them in two draw calls: shafts and heads. */
  private arrows: { shafts: THREE.InstancedMesh; heads: THREE.InstancedMesh } | null = null;

  private readonly shown = new Set<OverlayName>();
  private readonly made = new Map<Laid, THREE.Object3D[]>();
  private readonly moving = new Map<OverlayName, () => void>();

  constructor(private readonly viewer: Viewer) {}

  isShown(name: OverlayName): boolean {
    return this.shown.has(name);
  }

  show(name: OverlayName, visible: boolean): void {
    if (visible) {
      this.shown.add(name);
      this.make(name);
    } else {
      this.shown.delete(name);
      this.drop(name);
    }
  }

  /** After another scene has come. */
  rebuild(): void {
    for (const name of this.shown) {
      this.drop(name);
      this.make(name);
    }
  }

  clear(): void {
    for (const name of [...this.made.keys()]) {
      this.drop(name);
    }
  }

  /** After bodies have moved. */
  follow(): void {
    for (const update of this.moving.values()) {
      update();
    }
  }

  selectionChanged(): void {
    this.drop("selection");
    this.selection();
    if (this.shown.has("filtered")) {
      this.drop("filtered");
      this.make("filtered");
    }
  }

  /** Contacts of this moment: drawn with the next picture, since more of them may come before. */
  setContacts(contacts: Float32Array): void {
    this.contacts = contacts;
    this.contactsAreNew = true;
    if (this.shown.has("contacts")) {
      this.viewer.invalidate();
    }
  }

  /** Before a picture is drawn. */
  refresh(): void {
    if (this.contactsAreNew && this.shown.has("contacts")) {
      this.drawContacts();
    }
    this.contactsAreNew = false;
  }

  private get size(): number {
    return this.viewer.sphere.radius;
  }

  private add(name: Laid, parent: THREE.Object3D, object: THREE.Object3D): void {
    object.traverse((part) => {
      part.userData.ofPage = true;
      part.renderOrder = 10;
      part.raycast = () => {};
    });
    parent.add(object);
    const list = this.made.get(name) ?? [];
    list.push(object);
    this.made.set(name, list);
  }

  private drop(name: Laid): void {
    for (const object of this.made.get(name) ?? []) {
      object.parent?.remove(object);
      object.traverse((part) => {
        if (part instanceof THREE.Mesh) {
          if (![stick, tip, ball].includes(part.geometry)) {
            part.geometry.dispose();
          }
          (part.material as THREE.Material).dispose();
        }
      });
    }
    this.made.delete(name);
    if (name === "selection") {
      return;
    }
    if (name === "contacts") {
      this.arrows?.shafts.dispose();
      this.arrows?.heads.dispose();
      this.arrows = null;
    }
    this.moving.delete(name);
  }

  private make(name: OverlayName): void {
    if (this.made.has(name)) {
      return;
    }
    this.made.set(name, []);
    const makers: Record<OverlayName, () => void> = {
      joints: () => this.joints(),
      limits: () => this.limits(),
      inertia: () => this.inertia(),
      masses: () => this.masses(),
      frames: () => this.frames(),
      tree: () => this.tree(),
      filtered: () => this.filtered(),
      contacts: () => this.drawContacts(),
    };
    makers[name]();
  }

  private nodeOf(body: number | null): THREE.Object3D {
    return body === null || body < 0
      ? this.viewer.root
      : (this.viewer.bodies[body] ?? this.viewer.root);
  }

  /** Where a joint stands in the body that it turns against. */
  private jointFrame(joint: JointInfo): THREE.Group {
    const frame = new THREE.Group();
    place(frame, joint.frame0);
    return frame;
  }

  private joints(): void {
    for (const joint of this.viewer.info.joints) {
      const material = paint(colors.joints);
      const frame = this.jointFrame(joint);
      if (joint.kind === "revolute" || joint.kind === "prismatic") {
        const sign = arrow(this.size * 0.16, this.size * 0.004, material);
        const direction = new THREE.Vector3(...axes[joint.axis]);
        sign.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), direction);
        sign.position.copy(direction).multiplyScalar(-this.size * 0.08);
        frame.add(sign);
      } else {
        const dot = new THREE.Mesh(ball, material);
        dot.scale.setScalar(this.size * (joint.kind === "fixed" ? 0.007 : 0.014));
        frame.add(dot);
      }
      this.add("joints", this.nodeOf(joint.body0), frame);
    }
  }

  private limits(): void {
    for (const joint of this.viewer.info.joints) {
      const frame = this.jointFrame(joint);
      this.addLimits(joint, frame);
      this.add("limits", this.nodeOf(joint.body0), frame);
    }
  }

  private addLimits(joint: JointInfo, frame: THREE.Object3D): void {
    for (const limit of joint.limits) {
      const sign = limit.dof.startsWith("rot")
        ? limitArc(limit, this.size * 0.09)
        : limit.dof.startsWith("trans")
          ? limitRail(limit, this.size * 0.006)
          : null;
      if (sign) {
        frame.add(sign);
      }
    }
  }

  private inertia(): void {
    this.viewer.info.bodies.forEach((body, index) => {
      const half = body.inertiaBox;
      if (!half.every((extent) => Number.isFinite(extent))) {
        return;
      }
      const shape = new THREE.BoxGeometry(2 * half[0], 2 * half[1], 2 * half[2]);
      const box = new THREE.Mesh(shape, paint(colors.inertia, 0.3));
      place(box, [...body.centerOfMass, ...body.principalAxes]);
      this.add("inertia", this.nodeOf(index), box);
    });
  }

  private masses(): void {
    const total = this.viewer.info.bodies.reduce((sum, body) => sum + body.mass, 0);
    this.viewer.info.bodies.forEach((body, index) => {
      const dot = new THREE.Mesh(ball, paint(colors.masses));
      const share = total > 0 ? Math.cbrt(body.mass / total) : 0;
      dot.scale.setScalar(this.size * (0.008 + 0.03 * share));
      dot.position.fromArray(body.centerOfMass);
      this.add("masses", this.nodeOf(index), dot);
    });
  }

  private frames(): void {
    this.viewer.info.bodies.forEach((_, index) => {
      const frame = new THREE.Group();
      const sides: ["X" | "Y" | "Z", number][] = [
        ["X", 0xd9483b],
        ["Y", 0x3fa34d],
        ["Z", 0x3b6fd9],
      ];
      for (const [axis, color] of sides) {
        const sign = arrow(this.size * 0.1, this.size * 0.003, paint(color));
        const direction = new THREE.Vector3(...axes[axis]);
        sign.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), direction);
        frame.add(sign);
      }
      this.add("frames", this.nodeOf(index), frame);
    });
  }

  /** Sticks from the middle of each body's mass to that of its parent, as joints connect them. */
  private tree(): void {
    const info = this.viewer.info;
    const sticks = info.joints
      .filter((joint) => joint.articulation !== null && !joint.closesLoop)
      .filter((joint) => joint.body0 !== null && joint.body1 !== null)
      .map((joint) => ({ joint, mesh: new THREE.Mesh(stick, paint(colors.tree)) }));
    for (const { mesh } of sticks) {
      this.add("tree", this.viewer.root, mesh);
    }
    const update = () => {
      for (const { joint, mesh } of sticks) {
        between(this.middle(joint.body0!), this.middle(joint.body1!), mesh, this.size * 0.006);
      }
    };
    this.moving.set("tree", update);
    update();
  }

  /** Sticks to all bodies that the selected one does not touch. */
  private filtered(): void {
    const info = this.viewer.info;
    const selected = info.bodies.findIndex((body) => body.path === this.viewer.selected);
    const others = info.filteredPairs
      .filter((pair) => selected >= 0 && pair.includes(selected))
      .map((pair) => (pair[0] === selected ? pair[1] : pair[0]))
      .filter((body) => body >= 0);
    const sticks = others.map((body) => ({
      body,
      mesh: new THREE.Mesh(stick, paint(colors.filtered)),
    }));
    for (const { mesh } of sticks) {
      this.add("filtered", this.viewer.root, mesh);
    }
    const update = () => {
      for (const { body, mesh } of sticks) {
        between(this.middle(selected), this.middle(body), mesh, this.size * 0.004);
      }
    };
    this.moving.set("filtered", update);
    update();
  }

  /** How many arrows stand for contacts. */
  get drawnContacts(): number {
    return this.arrows?.shafts.count ?? 0;
  }

  private drawContacts(): void {
    const count = this.contacts.length / 6;
    if (!this.arrows || this.arrows.shafts.instanceMatrix.count < count) {
      this.drop("contacts");
      const room = Math.max(16, 2 ** Math.ceil(Math.log2(count)));
      const material = paint(colors.contacts);
      this.arrows = {
        shafts: new THREE.InstancedMesh(stick, material, room),
        heads: new THREE.InstancedMesh(tip, material, room),
      };
      for (const mesh of Object.values(this.arrows)) {
        mesh.frustumCulled = false;
        this.add("contacts", this.viewer.root, mesh);
      }
    }
    const { shafts, heads } = this.arrows;
    const forces = Array.from({ length: count }, (_, i) => this.vector(6 * i + 3).length());
    const most = forces.reduce((a, b) => Math.max(a, b), 1e-9);
    const turn = new THREE.Quaternion();
    const up = new THREE.Vector3(0, 1, 0);
    const thickness = this.size * 0.005;
    for (let i = 0; i < count; ++i) {
      const length = this.size * (0.04 + 0.26 * (forces[i]! / most));
      const way = forces[i]! > 0 ? this.vector(6 * i + 3).normalize() : up;
      turn.setFromUnitVectors(up, way);
      const at = this.vector(6 * i);
      const put = (mesh: THREE.InstancedMesh, from: THREE.Vector3, wide: number, long: number) =>
        mesh.setMatrixAt(i, new THREE.Matrix4().compose(from, turn, new THREE.Vector3(wide, long, wide)));
      put(shafts, at, thickness, length * 0.82);
      put(heads, at.clone().addScaledVector(way, length * 0.82), thickness * 2.6, length * 0.18);
    }
    for (const mesh of [shafts, heads]) {
      mesh.count = count;
      mesh.instanceMatrix.needsUpdate = true;
    }
  }

  private vector(at: number): THREE.Vector3 {
    return new THREE.Vector3().fromArray(this.contacts, at);
  }

  /** Axis and range of the selected joint, whatever else is shown. */
  private selection(): void {
    const joint = this.viewer.info.joints.find((one) => one.path === this.viewer.selected);
    if (!joint) {
      return;
    }
    const frame = this.jointFrame(joint);
    const dot = new THREE.Mesh(ball, paint(colors.selection));
    dot.scale.setScalar(this.size * 0.016);
    frame.add(dot);
    if (joint.kind === "revolute" || joint.kind === "prismatic") {
      const sign = arrow(this.size * 0.3, this.size * 0.006, paint(colors.selection));
      const direction = new THREE.Vector3(...axes[joint.axis]);
      sign.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), direction);
      sign.position.copy(direction).multiplyScalar(-this.size * 0.15);
      frame.add(sign);
    }
    this.addLimits(joint, frame);
    this.add("selection", this.nodeOf(joint.body0), frame);
  }

  private middle(body: number): THREE.Vector3 {
    const node = this.viewer.bodies[body];
    const at = new THREE.Vector3(...(this.viewer.info.bodies[body]?.centerOfMass ?? [0, 0, 0]));
    return node ? at.applyQuaternion(node.quaternion).add(node.position) : at;
  }
}
