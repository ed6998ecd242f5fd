// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Where one looks from: directions along the asset's axes, a projection without perspective, a body
// that the camera stays beside, and cameras of the asset. The camera with perspective is the one that is moved; the other
// one is placed after it, so that both show what is looked at in the same size.
import * as THREE from "three";
import type { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import type { CameraInfo } from "./info";

/** The angle that is seen, upward, unless it is that of a camera of the asset [degrees]. */
export const usualAngle = 35;
const tangent = (angle: number): number => Math.tan(THREE.MathUtils.degToRad(angle / 2));

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
  /** The camera of the asset that is looked through; null: none. */
  through: CameraInfo | null = null;
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
    const half = distance * tangent(camera.fov);
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

  /** Stands where the camera is that is looked through, if any, on what carries it. */
  stand(carrier: THREE.Object3D, scene: THREE.Sphere): void {
    const { camera, through } = this;
    if (!through) {
      return;
    }
    const [x, y, z, qx, qy, qz, qw] = through.pose;
    carrier.updateWorldMatrix(true, false);
    new THREE.Matrix4()
      .compose(new THREE.Vector3(x, y, z), new THREE.Quaternion(qx, qy, qz, qw), new THREE.Vector3(1, 1, 1))
      .premultiply(carrier.matrixWorld)
      .decompose(camera.position, camera.quaternion, new THREE.Vector3());
    // All that the camera sees is in the picture, whatever shape that has.
    const half = Math.max(through.halfHeight, through.halfWidth / camera.aspect);
    camera.fov = THREE.MathUtils.radToDeg(2 * Math.atan(half));
    camera.near = scene.radius / 500;
    camera.far = Math.max(camera.position.distanceTo(scene.center), scene.radius) * 50;
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld();
    // What the mouse turns the picture about: what lies ahead, as far away as the scene is.
    const ahead = new THREE.Vector3(0, 0, -1).applyQuaternion(camera.quaternion);
    const far = Math.max(ahead.dot(scene.center.clone().sub(camera.position)), scene.radius / 5);
    this.controls.target.copy(camera.position).addScaledVector(ahead, far);
  }

  /** Looks through the asset's camera no longer, with what is ahead in the size that it had. */
  leave(): void {
    const { camera, controls } = this;
    if (this.through) {
      this.through = null;
      const away = camera.position.clone().sub(controls.target);
      away.multiplyScalar(tangent(camera.fov) / tangent(usualAngle));
      camera.position.copy(controls.target).add(away);
      camera.fov = usualAngle;
      camera.updateProjectionMatrix();
    }
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
