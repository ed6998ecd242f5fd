// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Which parts a prim names, what is measured, which meshes are equal, how fine pictures are, and
// cameras of the asset.
import assert from "node:assert/strict";
import { test } from "node:test";
import * as THREE from "three";
import { readHash } from "../src/live/address";
import { rollPitchYaw } from "../src/live/values";
import { volumeText } from "../src/panel/inspector";
import { measured } from "../src/panel/measure";
import { Batches, digest } from "../src/scene/batches";
import { Eye, usualAngle } from "../src/scene/eye";
import { Pace } from "../src/scene/pace";
import { names } from "../src/scene/visibility";

test("a body names its own parts, another prim what is below it", () => {
  const bodies = new Set(["/r/a", "/r/a/b"]);
  const own = { path: "/r/a/mesh", body: "/r/a" };
  const below = { path: "/r/a/b/mesh", body: "/r/a/b" };
  assert.equal(names("/r/a", own, bodies), true);
  assert.equal(names("/r/a", below, bodies), false);
  assert.equal(names("/r", below, bodies), true);
  assert.equal(names("/r/a/mesh", own, bodies), true);
  assert.equal(names("/r/a/me", own, bodies), false);
});

test("distances and angles", () => {
  const at = (x: number, y: number) => new THREE.Vector3(x, y, 0);
  assert.deepEqual(measured([]), { distances: [], angle: null });
  assert.deepEqual(measured([at(0, 0), at(3, 4)]), { distances: [5], angle: null });
  const { angle } = measured([at(1, 0), at(0, 0), at(0, 2)]);
  assert.ok(Math.abs(angle! - Math.PI / 2) < 1e-12);
});

test("equal meshes are one call, and one with another material is drawn by itself", () => {
  const scene = new THREE.Scene();
  const material = new THREE.MeshStandardMaterial();
  const meshes = Array.from({ length: 10 }, (_, i) => {
    const mesh = new THREE.Mesh(new THREE.BoxGeometry(1, 1, i === 9 ? 2 : 1), material);
    mesh.position.x = i;
    scene.add(mesh);
    return mesh;
  });
  assert.equal(digest(meshes[0]!.geometry), digest(meshes[1]!.geometry));
  assert.notEqual(digest(meshes[0]!.geometry), digest(meshes[9]!.geometry));
  const batches = new Batches(scene);
  batches.begin(meshes);
  const drawn = scene.children.filter((one): one is THREE.InstancedMesh => one instanceof THREE.InstancedMesh);
  assert.equal(drawn.length, 1);
  assert.equal(drawn[0]!.count, 9);
  meshes[3]!.material = material.clone();
  meshes[4]!.visible = false;
  batches.update(new THREE.Vector3(-5, 0, 0));
  const matrix = new THREE.Matrix4();
  const places = Array.from({ length: 9 }, (_, i) => {
    drawn[0]!.getMatrixAt(i, matrix);
    return matrix.elements[0] === 0 ? "-" : matrix.elements[12];
  });
  assert.equal(places.join(), "0,1,2,-,-,5,6,7,8");
  const camera = new THREE.PerspectiveCamera();
  assert.equal(meshes[3]!.layers.test(camera.layers), true);
  assert.equal(meshes[0]!.layers.test(camera.layers), false);
  assert.equal(meshes[9]!.layers.test(camera.layers), true);
  batches.clear();
  assert.ok(!scene.children.includes(drawn[0]!));
});

test("pictures are coarse while they come slowly and fine at rest", () => {
  const pace = new Pace();
  for (let i = 0; i < 20; ++i) {
    pace.drawn(i / 30);
  }
  assert.equal(pace.share, 1);
  for (let i = 0; i < 6; ++i) {
    pace.drawn(1 + i / 5);
  }
  assert.equal(pace.share, 0.5);
  assert.equal(pace.restsAt(2.1), false);
  assert.equal(pace.restsAt(2.5), true);
  pace.fine();
  assert.equal(pace.share, 1);
  assert.equal(pace.restsAt(9), false);
  assert.equal(pace.restsAt(9, true), true); // the shadow is missing
});

test("a camera of the asset is stood at, goes with its body, and is left where one looks", () => {
  const camera = new THREE.PerspectiveCamera(usualAngle, 2);
  const controls = { target: new THREE.Vector3() };
  const eye = new Eye(camera, controls as never);
  const body = new THREE.Group();
  body.position.set(0, 0, 5);
  const scene = new THREE.Sphere(new THREE.Vector3(), 1);
  // It sees 90 degrees sideways; the picture is twice as wide as high.
  eye.through = { path: "/eye", body: 0, pose: [0, 1, 0, 0, 0, 0, 1], halfWidth: 1, halfHeight: 0.25 };
  eye.stand(body, scene);
  assert.deepEqual(camera.position.toArray(), [0, 1, 5]);
  assert.ok(Math.abs(Math.tan((camera.fov * Math.PI) / 360) - 0.5) < 1e-9);
  assert.deepEqual(controls.target.toArray().map((x) => Math.round(x * 1e6) / 1e6), [0, 1, 0]);
  body.position.set(2, 0, 5);
  eye.stand(body, scene);
  assert.deepEqual(camera.position.toArray(), [2, 1, 5]);
  eye.leave();
  assert.equal(camera.fov, usualAngle);
  assert.equal(eye.through, null);
  const seen = camera.position.distanceTo(controls.target) * Math.tan((usualAngle * Math.PI) / 360);
  assert.ok(Math.abs(seen - 5 * 0.5) < 1e-6, "what is ahead keeps its size");
  body.position.set(9, 9, 9);
  eye.stand(body, scene);
  assert.equal(camera.position.x, 2, "a camera that was left is stood at no longer");
});

test("numbers that people read", () => {
  assert.equal(volumeText(1), "1 m3");
  assert.equal(volumeText(2e-6), "2 cm3");
  const half = Math.SQRT1_2;
  const [roll, pitch, yaw] = rollPitchYaw([0, 0, half, half]);
  assert.ok(Math.abs(roll) + Math.abs(pitch) < 1e-9 && Math.abs(yaw - Math.PI / 2) < 1e-9);
});

test("an address is read within bounds", () => {
  assert.equal(readHash("#prim=/a/b&tab=Plots").get("prim"), "/a/b");
  assert.equal(readHash("").size, 0);
  assert.ok(readHash(`#prim=${"x".repeat(100_000)}`).get("prim")!.length < 5000);
});
