// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Where one looks from: directions along the asset's axes, a projection without perspective, and a
// body that the camera stays beside. The camera with perspective is the one that is moved; the other
// one is placed after it, so that both show what is looked at in the same size.
import * as THREE from "three";
import type { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";

/** Directions from what is looked at to the camera, in the axes of the asset. */
export const sides = {
  "+X": [1, 0, 0],
  "-X": [-1, 0, 0],
  "+Y": [0, 1, 0],
  "-Y": [0, -1, 0],
  "+Z": [0, 0, 1],
  "-Z": [0, 0, -1],
} as const;
export type Side = keyof typeof sides;

export class Eye {
  orthographic = false;
  private readonly flat = new THREE.OrthographicCamera();
  private last: THREE.Vector3 | null = null;

  constructor(
    private readonly camera: THREE.PerspectiveCamera,
    private readonly controls: OrbitControls,
  ) {}

  /** The camera that pictures are drawn with. `room` is how far things may lie before it [m]. */
  current(room: number): THREE.Camera {
    if (!this.orthographic) {
      return this.camera;
    }
    const { camera, flat } = this;
    const distance = camera.position.distanceTo(this.controls.target);
    const half = distance * Math.tan(THREE.MathUtils.degToRad(camera.fov / 2));
    Object.assign(flat, { top: half, bottom: -half, right: half * camera.aspect, left: -half * camera.aspect });
    flat.near = 0;
    flat.far = camera.far + room;
    const away = new THREE.Vector3(0, 0, room).applyQuaternion(camera.quaternion);
    flat.position.copy(camera.position).add(away);
    flat.quaternion.copy(camera.quaternion);
    flat.updateProjectionMatrix();
    flat.updateMatrixWorld();
    return flat;
  }

  /** Keeps its place beside a point that has moved since the last call; null: there is none. */
  moveWith(point: THREE.Vector3 | null): void {
    if (point && this.last) {
      const way = point.clone().sub(this.last);
      this.camera.position.add(way);
      this.controls.target.add(way);
    }
    this.last = point?.clone() ?? null;
  }
}
