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
 * Key and rim light at the camera, and the sky, which is brighter than the ground. Where they meet
 * white is a little brighter than a screen can show; `keepForm` brings it back.
 */
export function addLights(scene: THREE.Scene, camera: THREE.Camera): THREE.DirectionalLight[] {
  scene.add(new THREE.HemisphereLight(0xffffff, 0x8c929a, 1.6), camera);
  return [fromCamera(camera, 1.8, [-0.6, 1, 1.1]), fromCamera(camera, 0.5, [0.9, 0.2, -0.6])];
}

/** What is not as bright as this is drawn as it is [of the brightest white]. */
const bright = 0.8;

/** What a channel comes to whose colour's brightest channel is `peak`, for each unit of it. */
export function keptShare(peak: number): number {
  const over = Math.max(peak - bright, 0);
  const room = 1 - bright;
  return (peak - over + room * (1 - Math.exp(-over / room))) / Math.max(peak, 1e-4);
}

const noMapping = "vec3 CustomToneMapping( vec3 color ) { return color; }";
/** `keptShare` for all channels, so that hues stay. */
const mapping = `vec3 CustomToneMapping( vec3 color ) {
  const float room = 1.0 - ${bright};
  float peak = max( color.r, max( color.g, color.b ) );
  float over = max( peak - ${bright}, 0.0 );
  return color * ( peak - over + room * ( 1.0 - exp( - over / room ) ) ) / max( peak, 1e-4 );
}`;

/**
 * Bright light is drawn less bright the brighter it is, so that white keeps its form and highlights
 * their edge. Everything else is drawn as it is: mappings of films take the little that dark ones have.
 */
export function keepForm(renderer: Pick<THREE.WebGLRenderer, "toneMapping">): void {
  const chunks = THREE.ShaderChunk as { tonemapping_pars_fragment: string };
  chunks.tonemapping_pars_fragment = chunks.tonemapping_pars_fragment.replace(noMapping, mapping);
  renderer.toneMapping = THREE.CustomToneMapping;
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

/** What lets a metal reflect the room: a place in its shader, and what stands there then. */
export const roomShader: [string, string] = [lightsOfMaps, `${lightsOfMaps}${room}`];
