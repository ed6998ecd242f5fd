// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What happened, and when: contacts that begin, joints at their limits, drives at their maximum
// effort, what the engine tells (a joint that breaks), and a simulation that fails. Contacts and
// joints are looked at twenty times a second; what is shorter may be missed.
import { nameOf } from "../panel/dom";
import type { ContactsNotice, PlotsNotice, SceneNotice, StateNotice } from "./protocol";

export type EventKind = "contact" | "limit" | "saturation" | "engine" | "failure";

export interface RunEvent {
  time: number;
  kind: EventKind;
  prim: string;
  text: string;
}

const most = 1000;
const apart = 0.2; // [s] without contact after which it begins again
const margin = 1e-3; // of a range or of the maximum that a drive exerts

export class Events extends EventTarget {
  list: RunEvent[] = [];
  /** When there are more, they are counted alone. */
  left = 0;
  private touched = new Map<string, number>();
  private standing = new Set<string>();
  private told = 0;
  private failed = false;

  constructor(private scene: Pick<SceneNotice, "joints"> = { joints: [] }) {
    super();
  }

  begin(scene: Pick<SceneNotice, "joints">): void {
    this.scene = scene;
    this.clear();
  }

  clear(): void {
    this.list = [];
    this.left = 0;
    this.touched.clear();
    this.standing.clear();
    this.told = 0;
    this.failed = false;
    this.dispatchEvent(new Event("change"));
  }

  hearPlots({ time, joints, efforts }: PlotsNotice): void {
    this.scene.joints.forEach((joint, i) => {
      const single = joint.position.length === joint.dofs.length;
      joint.dofs.forEach(({ dof, lower, upper }, k) => {
        const value = single ? joints[i]?.[k] : undefined;
        if (value === undefined || (lower !== null && upper !== null && lower >= upper)) {
          return;
        }
        const room = margin * (lower !== null && upper !== null ? upper - lower : 1);
        const say = (end: string) => `${nameOf(joint.path)} reaches its ${end} limit`;
        this.watch(`${joint.path} ${dof} lower`, lower !== null && value <= lower + room, lower !== null && value > lower + 3 * room, {
          time, kind: "limit", prim: joint.path, text: say("lower"),
        });
        this.watch(`${joint.path} ${dof} upper`, upper !== null && value >= upper - room, upper !== null && value < upper - 3 * room, {
          time, kind: "limit", prim: joint.path, text: say("upper"),
        });
      });
      joint.drives.forEach(({ dof, maxForce }, k) => {
        const effort = Math.abs(efforts[i]?.[k] ?? 0);
        const full = maxForce !== null && maxForce > 0;
        this.watch(`${joint.path} ${dof} full`, full && effort >= (1 - margin) * maxForce!, full && effort < 0.95 * maxForce!, {
          time, kind: "saturation", prim: joint.path,
          text: `the drive of ${nameOf(joint.path)} exerts all that it may`,
        });
      });
    });
  }

  hearContacts({ time, rows }: ContactsNotice): void {
    for (const { collider0, collider1, body0, body1 } of rows) {
      const pair = `${collider0} ${collider1}`;
      const last = this.touched.get(pair) ?? -Infinity;
      this.touched.set(pair, time);
      if (time - last > apart) {
        const [one, other] = [body0 ?? collider0, body1 ?? collider1];
        this.add({ time, kind: "contact", prim: body1 ?? body0 ?? collider1, text: `${nameOf(one)} touches ${nameOf(other)}` });
      }
    }
  }

  hearState({ time, events, stopped }: StateNotice): void {
    for (const one of events.slice(this.told)) {
      this.add({ time: one.time, kind: "engine", prim: one.prim, text: `${nameOf(one.prim)} ${one.what}` });
    }
    this.told = Math.max(this.told, events.length);
    if (stopped && !this.failed) {
      this.add({ time, kind: "failure", prim: stopped.prim ?? "", text: stopped.message });
    }
    this.failed = stopped !== null;
  }

  /** Adds an event when something begins to be so, and again only after it has ended. */
  private watch(what: string, begins: boolean, ends: boolean, event: RunEvent): void {
    if (begins && !this.standing.has(what)) {
      this.standing.add(what);
      this.add(event);
    } else if (ends) {
      this.standing.delete(what);
    }
  }

  private add(event: RunEvent): void {
    if (this.list.length >= most) {
      this.left += 1;
      return;
    }
    const before = this.list.findLastIndex((one) => one.time <= event.time);
    this.list.splice(before + 1, 0, event);
    this.dispatchEvent(new Event("change"));
  }
}
