// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What a surface has beyond the materials of glTF: opacity of an image of its own, images that end at
// their edges, and images that are scaled first and turned then. The first two are in `extras.tenon`
// of a material, which tenon/glb/glb_materials.cpp writes.
import * as THREE from "three";
import type { GLTF } from "three/examples/jsm/loaders/GLTFLoader.js";
import { roomShader } from "./lights";

/** Along s and t, whether an image is nothing beyond its edges. */
type Ends = [boolean, boolean] | null;

/** Opacity as factor * channel + add of an image; the rest is a texture of glTF. */
interface OpacityInfo {
  index: number;
  channel: "r" | "g" | "b" | "a";
  factor: number;
  add: number;
  ends: Ends;
}

interface SurfaceInfo {
  opacity?: OpacityInfo;
  ends?: Ends;
}

const number = (value: number): string => {
  const text = String(Number.isFinite(value) ? value : 0);
  return /[.e]/.test(text) ? text : `${text}.0`;
};

/** 1 at a place of an image, 0 beyond an edge where the image ends. */
function inside(place: string, ends: Ends | undefined): string {
  const [s, t] = ends ?? [false, false];
  const of = (axis: string) => `step(abs(${place}.${axis} - 0.5), 0.5)`;
  return [s ? of("x") : "1.0", t ? of("y") : "1.0"].join(" * ");
}

const mapChunk = "#include <map_fragment>";
const opacityChunk = "#include <alphamap_fragment>";

/** Changes of the shader of a material: for what is searched, what is put in its place. */
function changesFor(material: THREE.MeshStandardMaterial): [string, string][] {
  const { opacity, ends } = (material.userData.tenon ?? {}) as SurfaceInfo;
  const changes: [string, string][] = [];
  if (material.map && ends) {
    changes.push([mapChunk, `${mapChunk}\n#ifdef USE_MAP\ndiffuseColor *= ${inside("vMapUv", ends)};\n#endif\n`]);
  }
  if (material.alphaMap && opacity) {
    const channel = /^[rgba]$/.test(opacity.channel) ? opacity.channel : "a";
    const seen = `texture2D(alphaMap, vAlphaMapUv).${channel} * ${inside("vAlphaMapUv", opacity.ends)}`;
    const value = `clamp(${seen} * ${number(opacity.factor)} + ${number(opacity.add)}, 0.0, 1.0)`;
    changes.push([opacityChunk, `\n#ifdef USE_ALPHAMAP\ndiffuseColor.a = opacity * ${value};\n#endif\n`]);
  }
  if (material.metalness > 0) {
    changes.push(roomShader);
  }
  return changes;
}

/** Draws a material with all that it has; copies of it, too, which three.js makes without. */
function completeShader(material: THREE.Material): void {
  const changes = material instanceof THREE.MeshStandardMaterial ? changesFor(material) : [];
  if (changes.length > 0) {
    material.onBeforeCompile = (shader) => {
      for (const [chunk, text] of changes) {
        shader.fragmentShader = shader.fragmentShader.replace(chunk, text);
      }
    };
    material.customProgramCacheKey = () => changes.map(([, text]) => text).join("");
  }
}

/** A copy that is drawn as the material is. */
export function copyOf(material: THREE.Material): THREE.Material {
  const copy = material.clone();
  completeShader(copy);
  return copy;
}

/** glTF scales images first and turns them then; three.js does it the other way round. */
function turnAfterScale(texture: THREE.Texture): void {
  if (texture.rotation !== 0) {
    const [c, s] = [Math.cos(texture.rotation), Math.sin(texture.rotation)];
    const { x, y } = texture.repeat;
    texture.matrixAutoUpdate = false;
    texture.matrix.set(c * x, s * y, texture.offset.x, -s * x, c * y, texture.offset.y, 0, 0, 1);
  }
}

/** Completes the materials of a file that was just read. */
export async function completeSurfaces(file: GLTF): Promise<void> {
  const all = new Set<THREE.Material>();
  file.scene.traverse((node) => {
    if (node instanceof THREE.Mesh) {
      [node.material as THREE.Material | THREE.Material[]].flat().forEach((one) => all.add(one));
    }
  });
  for (const material of all) {
    const { opacity } = (material.userData.tenon ?? {}) as SurfaceInfo;
    if (opacity) {
      await file.parser.assignTexture(material as never, "alphaMap", opacity);
    }
    for (const value of Object.values(material)) {
      value instanceof THREE.Texture && turnAfterScale(value);
    }
    completeShader(material);
  }
}
