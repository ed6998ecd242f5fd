// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Equal meshes of one material are drawn in one call. The meshes stay in the scene for everything else
// (picking, marks, sizes) on a layer that no camera draws; one that is marked or lets others show
// through has another material and is drawn by itself.
import * as THREE from "three";

/** What so many meshes share is drawn together. */
const least = 8;
/** Layer of meshes that are drawn by their batch. */
export const batched = 1;

interface Batch {
  drawn: THREE.InstancedMesh;
  material: THREE.Material;
  members: THREE.Mesh[];
}

/** A number for what a geometry holds: equal ones have the same. */
export function digest(geometry: THREE.BufferGeometry): number {
  let sum = 0x811c9dc5;
  const add = (array: ArrayLike<number> & { buffer: ArrayBufferLike; byteOffset: number; byteLength: number }) => {
    const bytes = new Uint8Array(array.buffer, array.byteOffset, array.byteLength);
    for (let i = 0; i < bytes.length; ++i) {
      sum = Math.imul(sum ^ bytes[i]!, 0x01000193) >>> 0;
    }
  };
  for (const name of Object.keys(geometry.attributes).sort()) {
    const { array, count } = geometry.attributes[name]! as THREE.BufferAttribute;
    sum = Math.imul(sum ^ count, 0x01000193) >>> 0;
    add(array as Float32Array);
  }
  geometry.index && add(geometry.index.array as Uint32Array);
  return sum;
}

const size = (geometry: THREE.BufferGeometry): number =>
  (geometry.index?.count ?? 0) + (geometry.attributes.position?.count ?? 0);

function isSeen(mesh: THREE.Object3D): boolean {
  for (let node: THREE.Object3D | null = mesh; node; node = node.parent) {
    if (!node.visible) {
      return false;
    }
  }
  return true;
}

const at = new THREE.Vector3();
const nowhere = new THREE.Matrix4().makeScale(0, 0, 0);

export class Batches {
  private batches: Batch[] = [];

  constructor(private readonly scene: THREE.Scene) {}

  begin(nodes: readonly THREE.Object3D[]): void {
    this.clear();
    const groups = new Map<string, THREE.Mesh[]>();
    for (const node of nodes) {
      node.traverse((mesh) => {
        if (mesh instanceof THREE.Mesh && !(mesh instanceof THREE.SkinnedMesh) && !Array.isArray(mesh.material)) {
          // Digests of the few that may be equal: of one material and size.
          const key = `${mesh.material.uuid} ${size(mesh.geometry)}`;
          const group = groups.get(key);
          group ? group.push(mesh) : groups.set(key, [mesh]);
        }
      });
    }
    for (const group of groups.values()) {
      if (group.length >= least) {
        this.add(group);
      }
    }
  }

  private add(group: THREE.Mesh[]): void {
    const equal = new Map<number, THREE.Mesh[]>();
    for (const mesh of group) {
      const key = digest(mesh.geometry);
      const others = equal.get(key);
      others ? others.push(mesh) : equal.set(key, [mesh]);
    }
    for (const members of equal.values()) {
      const [first] = members;
      if (members.length >= least && first) {
        const material = first.material as THREE.Material;
        const drawn = new THREE.InstancedMesh(first.geometry, material, members.length);
        drawn.frustumCulled = false;
        drawn.userData.ofPage = true;
        drawn.raycast = () => {};
        this.scene.add(drawn);
        this.batches.push({ drawn, material, members });
      }
    }
  }

  /** Before a picture is drawn: places all instances, the nearest first, which hide the others. */
  update(eye: THREE.Vector3): void {
    if (this.batches.length > 0) {
      this.scene.updateMatrixWorld();
    }
    for (const { drawn, material, members } of this.batches) {
      const away = (mesh: THREE.Mesh) => at.setFromMatrixPosition(mesh.matrixWorld).distanceToSquared(eye);
      const sorted = members.map((mesh) => ({ mesh, far: away(mesh) })).sort((a, b) => a.far - b.far);
      sorted.forEach(({ mesh }, i) => {
        const alone = mesh.material !== material;
        mesh.layers.set(alone ? 0 : batched);
        drawn.setMatrixAt(i, alone || !isSeen(mesh) ? nowhere : mesh.matrixWorld);
      });
      drawn.instanceMatrix.needsUpdate = true;
    }
  }

  clear(): void {
    for (const { drawn } of this.batches) {
      this.scene.remove(drawn);
      drawn.dispose();
    }
    this.batches = [];
  }
}
