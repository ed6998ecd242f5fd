// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The bar of what was simulated: it is scrubbed, stepped through and replayed, once or in a loop,
// while the simulation stays where it is. Whatever steers the simulation comes back to its moment.
import { h, timeSlider } from "../panel/dom";
import type { RequestName } from "./connection";
import type { Events, RunEvent } from "./events";
import type { History } from "./history";
import type { Session } from "./session";

const steering = new Set<RequestName>(["play", "step", "reset", "setJoint", "drag", "force", "engine", "variant"]);
const mostMarks = 200;
const liveEvery = 250; // ms
const seconds = (time: number) => time.toFixed(2);

export class Timeline {
  private readonly slider: HTMLInputElement;
  private readonly clock = h("output", { class: "number clock" }, "");
  private readonly marks = h("div", { class: "marks" });
  private readonly back: HTMLButtonElement;
  private readonly replay: HTMLButtonElement;
  private readonly now: HTMLButtonElement;
  private readonly loop: HTMLInputElement;
  private readonly bar: HTMLElement;
  private speed = 1;
  /** When the last picture of a replay was, by the page's clock [ms]; null: it does not run. */
  private clockAt: number | null = null;
  private waiting = false;
  private pause = 0;
  /** What marks were made for. */
  private marked = "";

  constructor(
    session: Session,
    private readonly history: History,
    private readonly events: Events,
  ) {
    const button = (text: string, title: string, act: () => void) =>
      h("button", { type: "button", title, onclick: act }, text);
    this.back = button("Step back", "The moment before ( , )", () => this.step(-1));
    this.replay = button("Replay", "What was simulated, again ( e )", () => this.toggle());
    this.now = button("Now", "Back to the simulation ( w )", () => this.leave());
    this.loop = h("input", { type: "checkbox" });
    this.slider = timeSlider("Moment that is shown, in seconds", (time) => this.seek(time));
    this.bar = h(
      "div",
      { class: "timeline", role: "group", "aria-label": "What was simulated", hidden: true },
      this.back,
      this.replay,
      h("label", {}, this.loop, " Loop"),
      h("div", { class: "track" }, this.marks, this.slider),
      this.clock,
      this.now,
    );
    session.panel.foot.append(this.bar);
    history.addEventListener("frame", () => this.updateSoon());
    history.addEventListener("shown", () => {
      this.pause = 0;
      this.updateSoon();
    });
    events.addEventListener("change", () => this.updateSoon());
    const { connection } = session;
    connection.on("asking", (name) => steering.has(name) && this.leave());
    connection.on("scene", ({ simulates }) => (this.bar.hidden = !simulates));
    connection.on("state", (state) => (this.speed = state.speed));
    const past = () => this.history.shown !== null;
    const there = () => this.history.frames.length > 1;
    session.panel.keys.add(
      { key: ",", label: "The moment before", act: () => this.step(-1), there },
      { key: ".", label: "The next moment, of those that were simulated", act: () => this.step(1), there: past },
      { key: "e", label: "Replay what was simulated, or stop", act: () => this.toggle(), there },
      { key: "w", label: "Back to the simulation", act: () => this.leave(), there: past },
    );
  }

  seek(time: number): void {
    this.clockAt = null;
    this.history.show(time);
  }

  /** Shows what is simulated now. */
  leave(): void {
    this.clockAt = null;
    if (this.history.shown !== null) {
      this.history.show(null);
    }
  }

  /** The next moment that is known, or the one before; behind the last one is the simulation. */
  step(by: 1 | -1): void {
    const { frames, shown, last } = this.history;
    const next = frames.indexAt((shown ?? last) + 1e-9) + by;
    const frame = frames.at(next);
    if (frame && next < frames.length - 1) {
      this.seek(frame.time);
    } else if (by > 0) {
      this.leave();
    }
  }

  /** The next replay ends at the end. */
  once(): void {
    this.loop.checked = false;
  }

  get replaying(): boolean {
    return this.clockAt !== null;
  }

  toggle(): void {
    if (this.replaying) {
      this.seek(this.history.shown ?? this.history.last);
      return;
    }
    const { shown, first, last } = this.history;
    this.history.show(shown === null || shown >= last ? first : shown);
    this.clockAt = performance.now();
    requestAnimationFrame(() => this.advance());
  }

  private advance(): void {
    if (this.clockAt === null || this.history.shown === null) {
      return;
    }
    const clock = performance.now();
    const { first, last, shown } = this.history;
    let time = shown + ((clock - this.clockAt) / 1000) * this.speed;
    this.clockAt = clock;
    if (time >= last) {
      if (!this.loop.checked) {
        this.seek(last);
        return;
      }
      time = first;
    }
    this.history.show(time);
    requestAnimationFrame(() => this.advance());
  }

  /** With the next picture; seldom while nobody looks at the past, since it is painted anew. */
  private updateSoon(): void {
    if (!this.waiting) {
      this.waiting = true;
      setTimeout(() => requestAnimationFrame(() => {
        this.waiting = false;
        this.update();
        this.pause = this.history.shown === null ? liveEvery : 0;
      }), this.pause);
    }
  }

  private update(): void {
    const { first, last, shown } = this.history;
    const empty = this.history.frames.length < 2;
    [this.back, this.replay, this.slider].forEach((one) => (one.disabled = empty));
    Object.assign(this.slider, { min: String(first), max: String(last) });
    this.slider.value = String(shown ?? last);
    this.slider.setAttribute("aria-valuetext", `${seconds(shown ?? last)} s`);
    this.clock.textContent = `${seconds(shown ?? last)} / ${seconds(last)} s`;
    this.replay.textContent = this.replaying ? "Stop" : "Replay";
    this.now.disabled = shown === null;
    this.bar.classList.toggle("past", shown !== null);
    this.showMarks(first, last);
  }

  private showMarks(first: number, last: number): void {
    const state = `${first} ${last} ${this.events.list.length}`;
    if (state === this.marked) {
      return;
    }
    this.marked = state;
    const span = last - first || 1;
    const seen = this.events.list.filter((one) => one.time >= first && one.time <= last);
    const step = Math.ceil(seen.length / mostMarks) || 1;
    const wanted = seen.filter((one, i) => one.kind === "failure" || i % step === 0);
    this.marks.replaceChildren(
      ...wanted.map((one: RunEvent) => {
        const mark = h("span", { class: `mark ${one.kind}`, title: `${seconds(one.time)} s: ${one.text}` });
        mark.style.left = `${(100 * (one.time - first)) / span}%`;
        return mark;
      }),
    );
  }
}
