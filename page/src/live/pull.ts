// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Pulling by mouse: with Shift held, or with the tool "Pull" on, a part that is dragged is drawn to
// the pointer by a spring, in the plane of the picture through the point that was taken.
import * as THREE from "three";
import { h } from "../panel/dom";
import { type Session, attempt } from "./session";

export class Pull {
  private readonly button: HTMLButtonElement;
  private readonly line = new THREE.Line(
    new THREE.BufferGeometry().setFromPoints([new THREE.Vector3(), new THREE.Vector3()]),
    new THREE.LineBasicMaterial({ color: 0xd9822b, depthTest: false }),
  );
  private body: THREE.Object3D | null = null;
  private readonly anchor = new THREE.Vector3();
  private readonly plane = new THREE.Plane();
  private busy = false;
  private next: THREE.Vector3 | null = null;

  constructor(private readonly session: Session) {
    this.button = h(
      "button",
      {
        type: "button",
        "aria-pressed": "false",
        title: "Drag a part to pull at it (or hold Shift)",
        onclick: () => this.setOn(this.button.getAttribute("aria-pressed") !== "true"),
      },
      "Pull",
    );
    session.panel.tools.append(this.button);
    this.line.visible = false;
    this.line.userData.ofPage = true;
    session.panel.viewer.scene.add(this.line);
    const place = session.panel.viewer.container;
    place.addEventListener("pointerdown", (event) => this.begin(event), { capture: true });
    place.addEventListener("pointermove", (event) => this.move(event), { capture: true });
    for (const end of ["pointerup", "pointercancel"] as const) {
      place.addEventListener(end, (event) => this.end(event), { capture: true });
    }
  }

  private setOn(on: boolean): void {
    this.button.setAttribute("aria-pressed", String(on));
  }

  private begin(event: PointerEvent): void {
    const wanted = event.shiftKey || this.button.getAttribute("aria-pressed") === "true";
    const viewer = this.session.panel.viewer;
    const hit = wanted && event.button === 0 ? viewer.pick(event.clientX, event.clientY) : undefined;
    let node: THREE.Object3D | null = hit?.object ?? null;
    while (node && node.userData.kind !== "body") {
      node = node.parent;
    }
    if (!hit || !node) {
      return;
    }
    event.stopPropagation();
    viewer.container.setPointerCapture(event.pointerId);
    this.body = node;
    this.anchor.copy(node.worldToLocal(hit.point.clone()));
    this.plane.setFromNormalAndCoplanarPoint(
      viewer.camera.getWorldDirection(new THREE.Vector3()),
      hit.point,
    );
    this.move(event);
  }

  private move(event: PointerEvent): void {
    if (!this.body) {
      return;
    }
    event.stopPropagation();
    const viewer = this.session.panel.viewer;
    const ray = viewer.rayAt(event.clientX, event.clientY);
    const target = ray.ray.intersectPlane(this.plane, new THREE.Vector3());
    if (target) {
      this.line.geometry.setFromPoints([this.body.localToWorld(this.anchor.clone()), target]);
      this.line.visible = true;
      viewer.invalidate();
      this.next = viewer.root.worldToLocal(target.clone());
      void this.send();
    }
  }

  private async send(): Promise<void> {
    if (this.busy) {
      return;
    }
    this.busy = true;
    while (this.next && this.body) {
      const target = this.next.toArray();
      this.next = null;
      const done = await attempt(this.session, "drag", {
        body: this.body.userData.path as string,
        anchor: this.anchor.toArray(),
        target,
      });
      if (done === null) {
        this.body = null;
      }
    }
    this.busy = false;
    if (!this.body) {
      this.letGo();
    }
  }

  private end(event: PointerEvent): void {
    if (this.body) {
      event.stopPropagation();
      this.body = null;
      this.next = null;
      this.letGo();
    }
  }

  private letGo(): void {
    this.line.visible = false;
    this.session.panel.viewer.invalidate();
    void attempt(this.session, "release");
  }
}
