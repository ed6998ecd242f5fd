// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Play, pause and the time of a baked motion. Not there without a motion.
import type { Viewer } from "../scene/viewer";
import { h, timeSlider } from "./dom";

export class TimeBar {
  readonly element: HTMLElement;
  private readonly button: HTMLButtonElement;
  private readonly slider: HTMLInputElement;
  private readonly clock = h("output", { class: "number" }, "");
  private readonly speed: HTMLSelectElement;

  constructor(private readonly viewer: Viewer) {
    this.button = h("button", { type: "button", title: "Space", onclick: () => this.toggle() }, "Play");
    this.slider = timeSlider("Time of the motion in seconds", (time) => this.seek(time));
    this.speed = h(
      "select",
      {
        "aria-label": "Speed",
        onchange: () => {
          if (this.viewer.motion) {
            this.viewer.motion.speed = Number(this.speed.value);
          }
        },
      },
      ...["0.1", "0.25", "0.5", "1", "2"].map((x) =>
        h("option", { value: x, selected: x === "1" }, `${x} x`),
      ),
    );
    this.element = h(
      "div",
      { class: "time", role: "group", "aria-label": "Motion", hidden: true },
      this.button,
      this.slider,
      this.clock,
      this.speed,
    );
    viewer.addEventListener("load", () => this.begin());
    viewer.addEventListener("time", () => this.update());
  }

  toggle(): void {
    const motion = this.viewer.motion;
    if (motion) {
      motion.playing = !motion.playing;
      this.update();
    }
  }

  step(seconds: number): void {
    this.seek((this.viewer.motion?.time ?? 0) + seconds);
  }

  private seek(time: number): void {
    const motion = this.viewer.motion;
    if (motion) {
      motion.playing = false;
      motion.seek(time);
      this.update();
    }
  }

  private begin(): void {
    const motion = this.viewer.motion;
    this.element.hidden = motion === null;
    if (motion) {
      this.slider.max = String(motion.duration);
      this.update();
    }
  }

  private update(): void {
    const motion = this.viewer.motion;
    if (motion) {
      this.button.textContent = motion.playing ? "Pause" : "Play";
      this.slider.value = String(motion.time);
      this.clock.textContent = `${motion.time.toFixed(2)} / ${motion.duration.toFixed(2)} s`;
    }
  }
}
