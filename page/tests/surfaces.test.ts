// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Materials are drawn with what glTF has no words for, and copies of them as they are.
import assert from "node:assert/strict";
import { test } from "node:test";
import * as THREE from "three";
import { completeSurfaces, copyOf } from "../src/scene/surfaces";

/** A file as the loader hands it over, with one material. */
async function completed(material: THREE.MeshStandardMaterial): Promise<void> {
  const scene = new THREE.Group();
  scene.add(new THREE.Mesh(new THREE.BufferGeometry(), material));
  const parser = {
    assignTexture: async (to: Record<string, unknown>, name: string) => (to[name] = new THREE.Texture()),
  };
  await completeSurfaces({ scene, parser } as never);
}

function fragmentOf(material: THREE.Material): string {
  const shader = { fragmentShader: THREE.ShaderLib.standard!.fragmentShader };
  material.onBeforeCompile(shader as never, null as never);
  return shader.fragmentShader;
}

test("opacity of an image is in the shader of a material and of its copies", async () => {
  const material = new THREE.MeshStandardMaterial({ metalness: 0 });
  material.userData.tenon = { opacity: { index: 0, channel: "r", factor: -1, add: 1, ends: [true, false] } };
  await completed(material);
  assert.ok(material.alphaMap);
  for (const one of [material, copyOf(material)]) {
    const text = fragmentOf(one);
    assert.ok(!text.includes("#include <alphamap_fragment>"), "three.js multiplies the green channel");
    assert.match(text, /texture2D\(alphaMap, vAlphaMapUv\)\.r \* step\(abs\(vAlphaMapUv\.x - 0\.5\), 0\.5\) \* 1\.0/);
    assert.match(text, /\* -1\.0 \+ 1\.0, 0\.0, 1\.0\)/);
  }
  const other = new THREE.MeshStandardMaterial({ metalness: 0 });
  await completed(other);
  assert.notEqual(other.customProgramCacheKey(), material.customProgramCacheKey());
});

test("an image that ends is nothing beyond its edges", async () => {
  const material = new THREE.MeshStandardMaterial({ map: new THREE.Texture(), metalness: 0 });
  material.userData.tenon = { ends: [false, true] };
  await completed(material);
  assert.match(fragmentOf(material), /diffuseColor \*= 1\.0 \* step\(abs\(vMapUv\.y - 0\.5\), 0\.5\)/);
});

test("metals reflect the room, other materials do not", async () => {
  const metal = new THREE.MeshStandardMaterial({ metalness: 1 });
  const paint = new THREE.MeshStandardMaterial({ metalness: 0 });
  await completed(metal);
  await completed(paint);
  assert.ok(fragmentOf(metal).includes("radiance +="));
  assert.ok(!fragmentOf(paint).includes("radiance +="));
});

test("images are scaled first and turned then", async () => {
  const map = new THREE.Texture();
  map.repeat.set(3, 2);
  map.rotation = 0.3;
  map.offset.set(0.25, -0.5);
  await completed(new THREE.MeshStandardMaterial({ map, metalness: 0 }));
  const [c, s] = [Math.cos(0.3), Math.sin(0.3)];
  for (const [u, v] of [[0, 0], [1, 0], [0.2, 0.7]] as const) {
    const at = new THREE.Vector3(u, v, 1).applyMatrix3(map.matrix);
    assert.ok(Math.abs(at.x - (c * 3 * u + s * 2 * v + 0.25)) < 1e-9);
    assert.ok(Math.abs(at.y - (-s * 3 * u + c * 2 * v - 0.5)) < 1e-9);
  }
});
