// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What the view is fitted to. Grounds are drawn, but nobody wants to see all of them: what stands
// on them would be a dot.
import * as THREE from "three";

/** A drawn shape. */
export interface Extent {
  box: THREE.Box3;
  /** It belongs to a body that can move. */
  moves: boolean;
}

/** Larger than so many times the middle one of the shapes that count, a shape is a ground. */
const timesMiddle = 20;
/** Or larger than so many times all that can move together. */
const timesMoving = 4;

const sizeOf = (box: THREE.Box3): number =>
  box.isEmpty() ? 0 : box.getSize(new THREE.Vector3()).length();

/** The middle one; of an even number the smaller one of both, so that of two one can be a ground. */
function middleOf(sizes: number[]): number {
  const sorted = [...sizes].sort((a, b) => a - b);
  return sorted[Math.floor((sorted.length - 1) / 2)] ?? 0;
}

/** For each shape whether the view is fitted to it. What can move always counts. */
export function fitted(shapes: readonly Extent[]): boolean[] {
  const moving = shapes.filter((one) => one.moves);
  const counted = moving.length > 0 ? moving : shapes;
  const together = new THREE.Box3();
  moving.forEach((one) => together.union(one.box));
  const middle = middleOf(counted.map((one) => sizeOf(one.box)));
  const most = Math.min(
    timesMiddle * middle,
    moving.length > 0 ? timesMoving * sizeOf(together) : Infinity,
  );
  return shapes.map((one) => one.moves || shapes.length === 1 || sizeOf(one.box) <= most);
}
