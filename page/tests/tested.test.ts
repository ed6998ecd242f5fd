// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What came of a test of a drive, in a line: units of people, and dashes for what is not known.
import assert from "node:assert/strict";
import { test } from "node:test";
import type { Tested } from "../src/live/protocol";
import { numbersOf } from "../src/live/tested";

const result = (more: Partial<Tested>): Tested => ({
  joint: "/r/j",
  axis: "rotZ",
  verdict: "pass",
  reasons: [],
  saturation: 0,
  ...more,
});

test("a step is told in per cent and seconds", () => {
  const step = { overshoot: 0.163, riseTime: 0.05, settlingTime: null, steadyError: 0 };
  assert.equal(numbersOf(result({ step })), "overshoot 16.3 %, rise 0.05 s, settles in -");
});

test("limits of joints that turn are in degrees, of those that slide in millimetres", () => {
  const limits = [{ target: Math.PI / 2, settlingTime: 0.5, maxHoldError: 0, at: 0 }];
  assert.equal(numbersOf(result({ limits })), "to 90 deg: settles in 0.5 s, holds within 0 deg");
  const slide = [{ target: 0.1, settlingTime: 0.5, maxHoldError: 0.001, at: 0 }];
  assert.equal(numbersOf(result({ axis: "transX", limits: slide })), "to 100 mm: settles in 0.5 s, holds within 1 mm");
});

test("a sine and saturation", () => {
  const sine = { positionError: Math.PI / 180, lag: 0.02, gain: 0.9 };
  assert.equal(
    numbersOf(result({ sine, saturation: 0.25 })),
    "lag 0.02 s, gain 0.9, error 1 deg; at its most effort 25 % of the time",
  );
});
