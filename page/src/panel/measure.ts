// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Distances and angles between points that are clicked on: of two points the distance, of three the
// angle at the second one. A point belongs to the body that it was taken on and moves with it.
import * as THREE from "three";
import type { Viewer } from "../scene/viewer";
import { figure, h } from "./dom";

const most = 3;

interface Point {
  carrier: THREE.Object3D;
  /** In the axes of the carrier [m]. */
  at: THREE.Vector3;
}

/** Of points in the world: distances [m] between neighbours, and the angle at the second [rad]. */
export function measured(points: readonly THREE.Vector3[]): { distances: number[]; angle: number | null } {
  const distances = points.slice(1).map((point, i) => point.distanceTo(points[i]!));
  const [a, b, c] = points;
  const angle = a && b && c ? a.clone().sub(b).angleTo(c.clone().sub(b)) : null;
  return { distances, angle };
}

export class Measure {
  readonly button: HTMLButtonElement;
  /** What is measured; said over the picture. */
  readonly note = h("p", { class: "measured", role: "status", hidden: true });
  private points: Point[] = [];
  private readonly line = new THREE.Line(
    new THREE.BufferGeometry(),
    new THREE.LineBasicMaterial({ color: 0xc0486f, depthTest: false }),
  );
  private readonly dots = new THREE.Points(
    this.line.geometry,
    new THREE.PointsMaterial({ color: 0xc0486f, size: 8, sizeAttenuation: false, depthTest: false }),
  );
  private from: [number, number] = [0, 0];

  constructor(private readonly viewer: Viewer) {
    this.button = h(
      "button",
      {
        type: "button",
        "aria-pressed": "false",
        title: "Click on two points for their distance, on three for an angle ( d )",
        onclick: () => this.toggle(),
      },
      "Measure",
    );
    for (const mark of [this.line, this.dots]) {
      mark.userData.ofPage = true;
      mark.frustumCulled = false;
      mark.renderOrder = 11;
      mark.raycast = () => {};
    }
    viewer.container.addEventListener("pointerdown", (event) => (this.from = [event.clientX, event.clientY]), {
      capture: true,
    });
    viewer.container.addEventListener("pointerup", (event) => this.click(event), { capture: true });
    viewer.addEventListener("poses", () => this.points.length > 0 && this.update());
    viewer.addEventListener("load", () => this.clear());
  }

  toggle(): void {
    const on = !this.viewer.picksPoints;
    this.viewer.picksPoints = on;
    this.button.setAttribute("aria-pressed", String(on));
    this.clear();
  }

  private clear(): void {
    this.points = [];
    this.update();
  }

  private click(event: PointerEvent): void {
    const moved = Math.hypot(event.clientX - this.from[0], event.clientY - this.from[1]);
    if (!this.viewer.picksPoints || event.button !== 0 || moved >= 4 || event.ctrlKey || event.metaKey) {
      return;
    }
    const hit = this.viewer.pick(event.clientX, event.clientY);
    if (hit) {
      const carrier = this.viewer.carrierOf(hit.object) ?? this.viewer.root;
      this.points = this.points.length === most ? [] : this.points;
      this.points.push({ carrier, at: carrier.worldToLocal(hit.point.clone()) });
      this.update();
    }
  }

  private update(): void {
    const on = this.viewer.picksPoints;
    this.note.hidden = !on;
    const { scene } = this.viewer;
    if (!on || this.points.length === 0) {
      scene.remove(this.line, this.dots);
    } else {
      scene.add(this.line, this.dots);
    }
    const places = this.points.map(({ carrier, at }) => carrier.localToWorld(at.clone()));
    if (places.length > 0) {
      this.line.geometry.dispose();
      this.line.geometry = new THREE.BufferGeometry().setFromPoints(places);
      this.dots.geometry = this.line.geometry;
    }
    this.say(places);
    this.viewer.invalidate();
  }

  private say(places: THREE.Vector3[]): void {
    const { distances, angle } = measured(places);
    const said = distances.map((one) => `${figure(one * 1000, 5)} mm`);
    if (angle !== null) {
      said.push(`angle ${figure((angle * 180) / Math.PI, 4)} deg`);
    }
    if (places.length === 2) {
      const back = this.viewer.root.quaternion.clone().invert();
      const way = places[1]!.clone().sub(places[0]!).applyQuaternion(back);
      said.push(`x ${figure(way.x * 1000, 4)}, y ${figure(way.y * 1000, 4)}, z ${figure(way.z * 1000, 4)} mm`);
    }
    const next = ["Click on a first point.", "Click on a second point."][places.length];
    this.note.textContent = next ?? said.join("; ");
  }
}
