// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Parts that glow in a colour: what is selected, and what a failed simulation names.
import * as THREE from "three";
import { copyOf } from "./surfaces";

function glowing(material: THREE.Material, color: THREE.Color): THREE.Material {
  const copy = copyOf(material);
  if (copy instanceof THREE.MeshStandardMaterial) {
    copy.emissive.copy(color);
    copy.emissiveIntensity = 0.55;
    copy.emissiveMap = null;
  }
  return copy;
}

export class Marks {
  private readonly plain = new Map<THREE.Mesh, THREE.Material | THREE.Material[]>();

  /** Marks a node and all below it; what is marked already keeps its colour. */
  add(node: THREE.Object3D, color: THREE.Color): void {
    node.traverse((part) => {
      if (part instanceof THREE.Mesh && part.userData.ofPage === undefined && !this.plain.has(part)) {
        const material = part.material as THREE.Material | THREE.Material[];
        this.plain.set(part, material);
        part.material = Array.isArray(material)
          ? material.map((one) => glowing(one, color))
          : glowing(material, color);
      }
    });
  }

  clear(): void {
    for (const [mesh, material] of this.plain) {
      for (const marked of [mesh.material].flat()) {
        marked.dispose();
      }
      mesh.material = material;
    }
    this.plain.clear();
  }
}
