// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A finding in one line names its file, its line and its prim.
import assert from "node:assert/strict";
import { test } from "node:test";
import { textOf } from "../src/live/messages";

test("all that helps is in the line", () => {
  const finding = { message: "it fell apart", prim: "/World/a", file: "a.usda", line: 3, fix: "reset" };
  assert.equal(textOf(finding), "a.usda:3: it fell apart </World/a>; reset");
  assert.equal(textOf({ message: "of </World/a>", prim: "/World/a" }), "of </World/a>");
  assert.equal(textOf({ message: "it fell apart", prim: null, file: null, line: null }), "it fell apart");
});
