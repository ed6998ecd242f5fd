// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The grid of the ground.
import * as THREE from "three";

/** A grid in the plane of the ground: each square's sides are lines of their own. */
export function gridLines(step: number, colors: { grid: number; axis: number }): THREE.LineSegments {
  const places: number[] = [];
  const shades: number[] = [];
  const half = 20;
  const corner = (a: number, b: number, turned: boolean, color: THREE.Color): void => {
    const fade = Math.max(0, 1 - Math.hypot(a, b) / half) ** 1.5;
    places.push((turned ? b : a) * step, 0, (turned ? a : b) * step);
    shades.push(color.r, color.g, color.b, fade);
  };
  for (const turned of [false, true]) {
    for (let a = -half; a <= half; ++a) {
      const color = new THREE.Color(a === 0 ? colors.axis : colors.grid);
      for (let b = -half; b < half; ++b) {
        if (Math.hypot(a, b) < half && Math.hypot(a, b + 1) < half) {
          corner(a, b, turned, color);
          corner(a, b + 1, turned, color);
        }
      }
    }
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(places, 3));
  geometry.setAttribute("color", new THREE.Float32BufferAttribute(shades, 4));
  const material = new THREE.LineBasicMaterial({
    vertexColors: true,
    transparent: true,
    depthWrite: false,
    toneMapped: false,
  });
  return new THREE.LineSegments(geometry, material);
}
