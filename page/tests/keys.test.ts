// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Which elements keep keys to themselves, and how combinations are named.
import assert from "node:assert/strict";
import { test } from "node:test";
import { nameOfKey, takesSpace, takesText } from "../src/panel/keys";

const input = (type: string) => ({ tagName: "INPUT", type });

test("keys work on everything that a mouse clicks but text and menus", () => {
  for (const tagName of ["BUTTON", "SUMMARY", "LI", "CANVAS", "BODY", "DIV", "LABEL"]) {
    assert.equal(takesText({ tagName }), false, tagName);
  }
  for (const type of ["checkbox", "radio", "range", "button"]) {
    assert.equal(takesText(input(type)), false, type);
  }
  for (const type of ["text", "search", "number", "password", "email", "url", "unheard"]) {
    assert.equal(takesText(input(type)), true, type);
  }
  assert.equal(takesText({ tagName: "TEXTAREA" }), true);
  assert.equal(takesText({ tagName: "SELECT" }), true);
  assert.equal(takesText({ tagName: "DIV", isContentEditable: true }), true);
});

test("Space belongs to what it presses", () => {
  for (const tagName of ["BUTTON", "SUMMARY"]) {
    assert.equal(takesSpace({ tagName }), true, tagName);
  }
  assert.equal(takesSpace(input("checkbox")), true);
  assert.equal(takesSpace(input("range")), false);
  assert.equal(takesSpace({ tagName: "CANVAS" }), false);
});

test("combinations", () => {
  const press = (key: string, held: Partial<KeyboardEvent> = {}) =>
    nameOfKey({ key, ctrlKey: false, metaKey: false, shiftKey: false, ...held });
  assert.equal(press("?", { shiftKey: true }), "?");
  assert.equal(press("z", { ctrlKey: true }), "ctrl+z");
  assert.equal(press("Z", { ctrlKey: true, shiftKey: true }), "ctrl+shift+z");
  assert.equal(press("z", { metaKey: true }), "ctrl+z");
  assert.equal(press("c", { ctrlKey: true }), "ctrl+c");
});
