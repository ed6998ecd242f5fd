// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What was simulated since the start: poses as they came (60 in a second), and samples of joints,
// bodies, energy and contacts (20 in a second). Both are kept until together they need more memory
// than they may have; the oldest ones go first. `shown` is the moment that the page shows.
import type { ContactsNotice, PlotsNotice, SceneNotice } from "./protocol";

/** Where the values of a sample lie in its array. */
export class Layout {
  readonly positions: number[] = [];
  readonly velocities: number[] = [];
  readonly efforts: number[] = [];
  readonly targets: number[] = [];
  /** Three of each body: the force of all its contacts [N], world axes. */
  readonly forces: number;
  /** Six of each of the first bodies. */
  readonly bodies: number;
  /** Kinetic and potential. */
  readonly energy: number;
  readonly contacts: number;
  readonly size: number;
  readonly bodyOf: Map<string, number>;

  constructor(scene: Pick<SceneNotice, "joints" | "bodies">) {
    let at = 0;
    const take = (count: number) => (at += count) - count;
    for (const joint of scene.joints) {
      this.positions.push(take(joint.position.length));
      this.velocities.push(take(joint.dofs.length));
      this.efforts.push(take(joint.drives.length));
      this.targets.push(take(2 * joint.drives.length));
    }
    this.bodies = take(6 * scene.bodies.length);
    this.forces = take(3 * scene.bodies.length);
    this.energy = take(2);
    this.contacts = take(1);
    this.size = at;
    this.bodyOf = new Map(scene.bodies.map((path, i) => [path, i]));
  }
}

export interface Sample {
  time: number;
  /** As the layout has them; NaN is not known. */
  values: Float32Array;
  /** Of each contact its point [m] and force [N]. */
  contacts: Float32Array;
}

interface Timed {
  time: number;
}

/** A list whose first items go without moving the others. */
export class Queue<T extends Timed> {
  private items: T[] = [];
  private start = 0;

  get length(): number {
    return this.items.length - this.start;
  }

  at(index: number): T | undefined {
    return index < 0 ? undefined : this.items[this.start + index];
  }

  get last(): T | undefined {
    return this.at(this.length - 1);
  }

  push(item: T): void {
    this.items.push(item);
  }

  pop(): T | undefined {
    return this.length > 0 ? this.items.pop() : undefined;
  }

  shift(): T | undefined {
    const first = this.at(0);
    this.start += first ? 1 : 0;
    if (this.start > 1000 && this.start > this.items.length / 2) {
      this.items = this.items.slice(this.start);
      this.start = 0;
    }
    return first;
  }

  clear(): void {
    this.items = [];
    this.start = 0;
  }

  /** The index of the last item that is not after a time; -1: all are. */
  indexAt(time: number): number {
    let [low, high] = [0, this.length];
    while (low < high) {
      const middle = (low + high) >> 1;
      this.at(middle)!.time <= time ? (low = middle + 1) : (high = middle);
    }
    return low - 1;
  }
}

interface Frame extends Timed {
  poses: Float32Array;
}

/** Where poses of a moment are looked up. */
export type Moments = Pick<History, "frameAt">;
/** Samples over time, as charts draw them. */
export type Samples = Moments & Pick<History, "samples" | "sample" | "shown">;

const overhead = 200; // bytes of an item beside its numbers
const slack = 1e-6; // [s] by which times in frames, which have fewer digits, may be off

/** After a moment, by more than frames and samples of one moment are apart. */
const later = (time: number) => time + slack + Math.abs(time) * 1e-6;

export class History extends EventTarget {
  readonly frames = new Queue<Frame>();
  readonly samples = new Queue<Sample>();
  layout = new Layout({ joints: [], bodies: [] });
  /** Bytes that frames and samples may need together. */
  limit = 64 << 20;
  bytes = 0;
  /** The moment that is shown; null: the newest one. */
  private moment: number | null = null;

  /** Forgets everything: another model begins. */
  begin(scene: Pick<SceneNotice, "joints" | "bodies">): void {
    this.layout = new Layout(scene);
    this.clear();
  }

  clear(): void {
    this.frames.clear();
    this.samples.clear();
    this.bytes = 0;
    this.show(null);
  }

  get first(): number {
    return this.frames.at(0)?.time ?? 0;
  }

  get last(): number {
    return this.frames.last?.time ?? 0;
  }

  get shown(): number | null {
    return this.moment;
  }

  /** Shows a moment; null: what is simulated now. */
  show(time: number | null): void {
    this.moment = time === null ? null : Math.min(Math.max(time, this.first), this.last);
    this.dispatchEvent(new Event("shown"));
  }

  /** The poses that are shown, and what is known of that moment. */
  get frame(): Float32Array | null {
    const at = this.moment === null ? this.frames.length - 1 : this.frames.indexAt(later(this.moment));
    return this.frames.at(Math.max(at, 0))?.poses ?? null;
  }

  get sample(): Sample | null {
    const at = this.moment === null ? this.samples.length - 1 : this.samples.indexAt(later(this.moment));
    return this.samples.at(Math.max(at, 0)) ?? null;
  }

  /** The poses of the moment of a sample. */
  frameAt(time: number): Float32Array | null {
    const at = this.frames.indexAt(later(time));
    return this.frames.at(Math.max(at, 0))?.poses ?? null;
  }

  addFrame(poses: Float32Array): void {
    const time = poses[0] ?? 0;
    this.dropFrames(time);
    this.dropSamples(later(time));
    this.frames.push({ time, poses });
    this.bytes += poses.byteLength + overhead;
    this.shrink();
    this.dispatchEvent(new Event("frame"));
  }

  addPlots(plots: PlotsNotice): void {
    const { layout } = this;
    if (plots.joints.length !== layout.positions.length) {
      return; // of another model
    }
    const values = new Float32Array(layout.size).fill(NaN);
    plots.joints.forEach((list, i) => values.set(list, layout.positions[i]));
    plots.velocities.forEach((list, i) => values.set(list, layout.velocities[i]));
    plots.efforts.forEach((list, i) => list && values.set(list, layout.efforts[i]));
    plots.targets.forEach((list, i) => values.set(list.flat(), layout.targets[i]));
    plots.bodies.forEach((list, i) => values.set(list, layout.bodies + 6 * i));
    values.set([plots.kinetic, plots.potential], layout.energy);
    this.dropSamples(plots.time);
    this.dropFrames(later(plots.time));
    this.samples.push({ time: plots.time, values, contacts: new Float32Array() });
    this.bytes += values.byteLength + overhead;
    this.shrink();
  }

  /** What touches at the moment of the newest sample. */
  addContacts(notice: ContactsNotice): void {
    const { layout, samples } = this;
    const sample = samples.last;
    if (!sample || sample.time !== notice.time) {
      return;
    }
    sample.values.fill(0, layout.forces, layout.forces + 3 * layout.bodyOf.size);
    sample.values[layout.contacts] = notice.count;
    for (const { body0, body1, force } of notice.rows) {
      for (const [body, sign] of [[body0, -1], [body1, 1]] as const) {
        const at = layout.bodyOf.get(body ?? "");
        if (at !== undefined) {
          force.forEach((one, k) => (sample.values[layout.forces + 3 * at + k]! += sign * one));
        }
      }
    }
    this.bytes -= sample.contacts.byteLength;
    sample.contacts = Float32Array.from(notice.rows.flatMap((row) => [...row.point, ...row.force]));
    this.bytes += sample.contacts.byteLength;
    this.dispatchEvent(new Event("sample"));
  }

  /** Forgets what is of a moment or later: it is told again, or time has begun anew. */
  private dropFrames(from: number): void {
    while (this.frames.last && this.frames.last.time >= from) {
      this.bytes -= this.frames.pop()!.poses.byteLength + overhead;
    }
  }

  private dropSamples(from: number): void {
    while (this.samples.last && this.samples.last.time >= from) {
      this.forget(this.samples.pop()!);
    }
  }

  private forget(sample: Sample): void {
    this.bytes -= sample.values.byteLength + sample.contacts.byteLength + overhead;
  }

  private shrink(): void {
    while (this.bytes > this.limit && this.frames.length > 1) {
      this.bytes -= this.frames.shift()!.poses.byteLength + overhead;
      while ((this.samples.at(0)?.time ?? Infinity) < this.first) {
        this.forget(this.samples.shift()!);
      }
    }
  }
}
