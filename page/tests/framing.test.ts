// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Which shapes the view is fitted to.
import assert from "node:assert/strict";
import { test } from "node:test";
import * as THREE from "three";
import { type Extent, fitted } from "../src/scene/framing";

const cube = (size: number, moves = false, x = 0): Extent => ({
  box: new THREE.Box3().setFromCenterAndSize(
    new THREE.Vector3(x, 0, 0),
    new THREE.Vector3(size, size, size),
  ),
  moves,
});

const floor = (size: number): Extent => ({
  box: new THREE.Box3(new THREE.Vector3(-size, -0.1, -size), new THREE.Vector3(size, 0, size)),
  moves: false,
});

test("a ground below one shape is excluded, in any order", () => {
  assert.deepEqual(fitted([cube(0.1), floor(10)]), [true, false]);
  assert.deepEqual(fitted([floor(10), cube(0.1)]), [false, true]);
});

test("ground and wall around what moves are excluded", () => {
  assert.deepEqual(fitted([floor(10), floor(8), cube(0.2, true)]), [false, false, true]);
});

test("a ground beside what moves is excluded, where a small part of it is the middle one", () => {
  const robot = [cube(0.9, true), cube(0.8, true), cube(0.7, true)];
  assert.deepEqual(fitted([...robot, floor(5)]), [true, true, true, false]);
});

test("a table stays", () => {
  assert.deepEqual(fitted([cube(0.2, true), cube(0.2, true, 0.4), floor(0.4)]), [true, true, true]);
});

test("small parts of a large whole exclude nothing", () => {
  assert.deepEqual(fitted([cube(1, true), cube(1, true), cube(0.001, true)]), [true, true, true]);
  assert.deepEqual(fitted([cube(1), cube(1), cube(0.001)]), [true, true, true]);
});

test("a shape alone is what is looked at", () => {
  assert.deepEqual(fitted([floor(10)]), [true]);
  assert.deepEqual(fitted([]), []);
});
