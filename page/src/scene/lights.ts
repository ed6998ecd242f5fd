// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Lights that stand still in the picture: a scene looks the same wherever it is in the world. Metals
// reflect a room; without one they would be black.
import * as THREE from "three";

/** A light from a direction in the frame of the camera. Its target moves with the camera, too. */
function fromCamera(
  camera: THREE.Object3D,
  intensity: number,
  from: [number, number, number],
): THREE.DirectionalLight {
  const light = new THREE.DirectionalLight(0xffffff, intensity);
  light.position.set(...from);
  camera.add(light, light.target);
  return light;
}

/**
 * Key and rim light at the camera, and the sky, which is brighter than the ground. White stays just
 * below the brightest white where the key light and the sky meet, so that its form is seen; colours
 * are drawn as they are, without tone mapping, which would take the little that dark ones have.
 */
export function addLights(scene: THREE.Scene, camera: THREE.Camera): THREE.DirectionalLight[] {
  scene.add(new THREE.HemisphereLight(0xffffff, 0x8c929a, 1.4), camera);
  return [fromCamera(camera, 1.75, [-0.6, 1, 1.1]), fromCamera(camera, 0.5, [0.9, 0.2, -0.6])];
}

/**
 * What metals reflect: a bright upper half, a darker lower one and a window, the softer the rougher
 * the surface. It is computed where it is seen: making a texture of surroundings takes software
 * graphics many seconds.
 */
const room = `
  {
    vec3 seen = inverseTransformDirection(reflect(-geometryViewDir, geometryNormal), viewMatrix);
    float soft = mix(0.06, 1.0, material.roughness);
    float above = smoothstep(-soft, soft, seen.y);
    float window = smoothstep(0.86 - 0.5 * soft, 0.9, dot(seen, normalize(vec3(-0.5, 0.6, 0.6))));
    radiance += vec3(mix(0.3, 0.75, above) + 0.35 * window * (1.0 - 0.6 * soft));
  }
`;
const lightsOfMaps = "#include <lights_fragment_maps>";

/** Lets a metal reflect the room; other materials stay as they are. */
export function reflectRoom(material: THREE.Material): void {
  if (material instanceof THREE.MeshStandardMaterial && material.metalness > 0) {
    material.onBeforeCompile = (shader) => {
      shader.fragmentShader = shader.fragmentShader.replace(lightsOfMaps, `${lightsOfMaps}${room}`);
    };
    material.customProgramCacheKey = () => "room";
  }
}
