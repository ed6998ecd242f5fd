// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Which parts are drawn, and which let others show through. Paths are remembered, so that parts stay
// hidden when the picture is read again.
import * as THREE from "three";
import { copyOf } from "./surfaces";

type Kind = "visual" | "collider";

/** A drawn part: its node, its own path, and that of the body that carries it. */
export interface Part {
  node: THREE.Object3D;
  kind: Kind;
  path: string;
  body: string;
}

const glass = 0.3; // opacity of what lets others show through

/** Whether a prim names a part: the body that carries it, the part itself, or what is above it. */
export function names(prim: string, part: Pick<Part, "path" | "body">, bodies: ReadonlySet<string>): boolean {
  if (bodies.has(prim)) {
    return part.body === prim;
  }
  return part.path === prim || part.path.startsWith(`${prim}/`) || part.body.startsWith(`${prim}/`);
}

export class Visibility {
  readonly hidden = new Set<string>();
  readonly clear = new Set<string>();
  /** Where it has prims, nothing else is drawn. */
  readonly alone = new Set<string>();
  /** Everything of a kind lets others show through. */
  readonly clearKinds = new Set<Kind>();
  private readonly shown: Record<Kind, boolean> = { visual: true, collider: false };
  private parts: Part[] = [];
  private bodies = new Set<string>();
  private readonly solid = new Map<THREE.Mesh, THREE.Material | THREE.Material[]>();

  begin(parts: Part[], bodies: Iterable<string>): void {
    this.solid.clear();
    this.parts = parts;
    this.bodies = new Set(bodies);
    this.apply();
  }

  show(kind: Kind, visible: boolean): void {
    this.shown[kind] = visible;
    this.apply();
  }

  /** Everything is drawn again, and nothing shows through. */
  reset(): void {
    [this.hidden, this.clear, this.alone].forEach((one) => one.clear());
    this.clearKinds.clear();
    this.apply();
  }

  apply(): void {
    for (const part of this.parts) {
      part.node.visible =
        this.shown[part.kind] &&
        (this.alone.size === 0 || this.isOf(part, this.alone)) &&
        !this.isOf(part, this.hidden);
      this.setClear(part, this.clearKinds.has(part.kind) || this.isOf(part, this.clear));
    }
  }

  private isOf(part: Part, prims: ReadonlySet<string>): boolean {
    return [...prims].some((prim) => names(prim, part, this.bodies));
  }

  private setClear(part: Part, clear: boolean): void {
    part.node.traverse((mesh) => {
      if (!(mesh instanceof THREE.Mesh) || mesh.userData.ofPage || this.solid.has(mesh) === clear) {
        return;
      }
      if (clear) {
        this.solid.set(mesh, mesh.material);
        const all = [mesh.material as THREE.Material | THREE.Material[]].flat().map(asGlass);
        mesh.material = Array.isArray(mesh.material) ? all : all[0]!;
      } else {
        [mesh.material as THREE.Material | THREE.Material[]].flat().forEach((one) => one.dispose());
        mesh.material = this.solid.get(mesh)!;
        this.solid.delete(mesh);
      }
    });
  }
}

function asGlass(material: THREE.Material): THREE.Material {
  const copy = copyOf(material);
  copy.transparent = true;
  copy.opacity = material.opacity * glass;
  copy.alphaTest = material.alphaTest * glass;
  copy.depthWrite = false;
  return copy;
}
