// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Lights come from the same direction of the picture, wherever the camera is, and white keeps its form.
import assert from "node:assert/strict";
import { test } from "node:test";
import * as THREE from "three";
import { addLights, keepForm, keptShare } from "../src/scene/lights";

/** Directions from lights to their targets in the frame of a camera that looks at `at`. */
function directions(at: THREE.Vector3): THREE.Vector3[] {
  const scene = new THREE.Scene();
  const camera = new THREE.PerspectiveCamera();
  const lights = addLights(scene, camera);
  camera.position.copy(at).add(new THREE.Vector3(1, 2, 3));
  camera.lookAt(at);
  scene.updateMatrixWorld(true);
  return lights.map((light) => {
    const from = light.getWorldPosition(new THREE.Vector3());
    const to = light.target.getWorldPosition(new THREE.Vector3());
    return camera.worldToLocal(to).sub(camera.worldToLocal(from)).normalize();
  });
}

test("lights do not depend on where the scene is", () => {
  const here = directions(new THREE.Vector3());
  assert.equal(here.length, 2);
  for (const place of [[20, 0, 0], [0, 20, 0], [-7, 3, 400]] as const) {
    directions(new THREE.Vector3(...place)).forEach((there, i) => {
      assert.ok(there.distanceTo(here[i]!) < 1e-4, `light ${i} at ${place}`);
    });
  }
});

test("the key light comes from behind the camera, above and to the left", () => {
  const [key] = directions(new THREE.Vector3(20, 0, 0));
  assert.ok(key!.x > 0 && key!.y < 0 && key!.z < 0, key!.toArray().join(" "));
});

test("bright light keeps its form, and nothing else is changed", () => {
  for (const dark of [0, 0.01, 0.2, 0.79]) {
    assert.ok(Math.abs(dark * keptShare(dark) - dark) < 1e-6, `${dark}`);
  }
  let last = 0.79;
  for (let light = 0.8; light < 2; light += 0.1) {
    const shown = light * keptShare(light);
    assert.ok(shown > last + 1e-4 && shown < 1, `${light} is shown as ${shown}`);
    last = shown;
  }
});

test("the shader of three.js takes the mapping", () => {
  const before = THREE.ShaderChunk.tonemapping_pars_fragment;
  const renderer: { toneMapping: THREE.ToneMapping } = { toneMapping: THREE.NoToneMapping };
  keepForm(renderer);
  assert.equal(renderer.toneMapping, THREE.CustomToneMapping);
  assert.notEqual(THREE.ShaderChunk.tonemapping_pars_fragment, before);
});
