// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What was simulated is kept within its memory and found by time; signals and events are made of it.
import assert from "node:assert/strict";
import { test } from "node:test";
import type { ContactsNotice, LiveJoint, PlotsNotice, SceneNotice, StateNotice } from "../src/live/protocol";
import { Events } from "../src/live/events";
import { History, Queue } from "../src/live/history";
import { Signals, asCsv } from "../src/live/signals";

const joint: LiveJoint = {
  path: "/r/hinge",
  kind: "revolute",
  enabled: true,
  follows: false,
  leader: null,
  dofs: [{ dof: "rotX", angular: true, lower: -1, upper: 1 }],
  position: [0],
  drives: [{ dof: "rotX", position: 0, velocity: 0, stiffness: 1, damping: 1, maxForce: 2 }],
};
const scene = { joints: [joint], bodies: ["/r/a", "/r/b"] } as SceneNotice;

const frame = (time: number) => Float32Array.from([time, ...Array(14).fill(time)]);
const plots = (time: number, position = 0, effort = 0): PlotsNotice => ({
  time,
  joints: [[position]],
  velocities: [[0.5]],
  efforts: [[effort]],
  targets: [[[0.25, 0]]],
  bodies: [[1, 2, 3, 0, 0, 1], [0, 0, 0, 0, 0, 0]],
  kinetic: 2,
  potential: -1,
});
const touching = (time: number, ...forces: number[]): ContactsNotice => ({
  time,
  count: forces.length,
  rows: forces.map((force) => ({
    collider0: "/ground", collider1: "/r/b/box", body0: null, body1: "/r/b",
    point: [0, 0, 0], normal: [0, 0, 1], depth: 0, force: [0, 0, force],
  })),
});

function filled(count: number, limit = Infinity): History {
  const history = new History();
  history.limit = limit;
  history.begin(scene);
  for (let i = 0; i < count; ++i) {
    history.addPlots(plots(i / 10, i / 100));
    history.addContacts(touching(i / 10, 3, 4));
    history.addFrame(frame(i / 10));
  }
  return history;
}

test("a queue is found by time and gives up its first items", () => {
  const queue = new Queue<{ time: number }>();
  for (let i = 0; i < 5000; ++i) {
    queue.push({ time: i });
  }
  for (let i = 0; i < 4000; ++i) {
    assert.equal(queue.shift()!.time, i);
  }
  assert.equal(queue.length, 1000);
  assert.equal(queue.indexAt(3999), -1);
  assert.equal(queue.at(queue.indexAt(4000.5))!.time, 4000);
  assert.equal(queue.at(queue.indexAt(1e9))!.time, 4999);
});

test("what is kept stays within its memory, and the newest is kept", () => {
  const history = filled(1000, 20_000);
  assert.ok(history.bytes <= 20_000 && history.bytes > 15_000, String(history.bytes));
  assert.ok(history.first > 90 && Math.abs(history.last - 99.9) < 1e-3);
  assert.ok(history.samples.at(0)!.time >= history.first - 1e-3);
});

test("a moment is shown as it was", () => {
  const history = filled(50);
  history.show(2);
  assert.ok(Math.abs(history.frame![0]! - 2) < 1e-6);
  assert.ok(Math.abs(history.sample!.time - 2) < 1e-6);
  history.show(-5);
  assert.equal(history.shown, 0);
  history.show(null);
  assert.ok(Math.abs(history.sample!.time - 4.9) < 1e-6);
});

test("a moment that is told again takes the place of the old one, and what was after it is gone", () => {
  const history = filled(50);
  history.addPlots(plots(2, 0.7));
  history.addContacts(touching(2));
  history.addFrame(frame(2));
  assert.ok(Math.abs(history.last - 2) < 1e-6);
  assert.equal(history.samples.length, 21);
  const bytes = history.bytes;
  history.addPlots(plots(2, 0.8));
  history.addContacts(touching(2));
  history.addFrame(frame(2));
  assert.equal(history.bytes, bytes);
});

test("signals are named and counted as logs have them", () => {
  const history = filled(3);
  const signals = new Signals(scene, history.layout);
  const value = (column: string) => signals.find(column)!.of(history.sample!, history);
  assert.ok(Math.abs(value("/r/hinge.position") - (0.02 * 180) / Math.PI) < 1e-4);
  assert.ok(Math.abs(value("/r/hinge.target") - (0.25 * 180) / Math.PI) < 1e-4);
  assert.equal(value("/r/a.linearVelocity.y"), 2);
  assert.equal(value("/r/b.contactForce.z"), 7);
  assert.equal(value("/r/a.contactForce"), 0);
  assert.equal(value("energy.total"), 1);
  assert.equal(value("contacts.count"), 2);
  assert.equal(signals.find("/r/none.position"), undefined);
  const lines = asCsv([signals.find("/r/hinge.position")!, signals.find("energy.kinetic")!], history).split("\n");
  assert.equal(lines[0], "time [s],/r/hinge.position [deg],energy.kinetic [J]");
  assert.equal(lines[2], "0.1,0.5729578,2");
  assert.equal(lines.length, 5);
});

test("events begin once and again after they have ended", () => {
  const events = new Events(scene);
  const kinds = () => events.list.map((one) => `${one.kind} ${one.time}`).join(", ");
  events.hearPlots(plots(0, 0.5, 1));
  events.hearPlots(plots(0.1, 1, 2));
  events.hearPlots(plots(0.2, 1, 2));
  assert.equal(kinds(), "limit 0.1, saturation 0.1");
  events.hearPlots(plots(0.3, 0.9, 1));
  events.hearPlots(plots(0.4, 1, 1));
  assert.equal(kinds(), "limit 0.1, saturation 0.1, limit 0.4");
  for (const time of [0.5, 0.55, 0.6]) {
    events.hearContacts(touching(time, 1));
  }
  events.hearContacts(touching(0.9, 1));
  assert.equal(events.list.filter((one) => one.kind === "contact").map((one) => one.time).join(), "0.5,0.9");
  const state = (stopped: object | null, ...told: number[]) =>
    ({ time: 1, stopped, events: told.map((time) => ({ time, prim: "/r/hinge", what: "broke" })) }) as unknown as StateNotice;
  events.hearState(state(null, 0.7));
  events.hearState(state({ message: "unstable", prim: "/r/a" }, 0.7));
  events.hearState(state({ message: "unstable", prim: "/r/a" }, 0.7));
  assert.equal(events.list.filter((one) => one.kind === "engine").length, 1);
  assert.equal(events.list.filter((one) => one.kind === "failure").length, 1);
  assert.ok(events.list.every((one, i) => i === 0 || events.list[i - 1]!.time <= one.time), kinds());
});
