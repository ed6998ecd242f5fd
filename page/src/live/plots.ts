// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Joint positions and energy over the last seconds, drawn on a canvas and told as numbers.
import { figure, h, nameOf } from "../panel/dom";
import type { PlotsNotice, SceneNotice } from "./connection";
import { type Session, attempt } from "./session";

const window_ = 10; // s
const colors = ["#175fb8", "#d9822b", "#2c9f6b", "#b3261e", "#7a5fd0", "#2a8fbd", "#8a5300", "#c0486f"];
const mostLines = colors.length;

interface Line {
  name: string;
  unit: string;
  values: number[];
}

class Chart {
  readonly element: HTMLElement;
  private readonly canvas = h("canvas", { width: 340, height: 130, role: "img" });
  private readonly legend = h("ul", { class: "legend" });
  times: number[] = [];
  lines: Line[] = [];
  private waiting = false;

  constructor(private readonly title: string) {
    this.canvas.setAttribute("aria-label", title);
    this.element = h("figure", {}, h("figcaption", {}, title), this.canvas, this.legend);
    new ResizeObserver(() => this.drawSoon()).observe(this.canvas); // it has come to be seen
  }

  begin(lines: Line[]): void {
    this.times = [];
    this.lines = lines;
    this.legend.replaceChildren(
      ...lines.map((line) => h("li", {}, h("span", { class: "swatch" }), h("span", {}, line.name))),
    );
    Array.from(this.legend.querySelectorAll<HTMLElement>(".swatch")).forEach((swatch, i) => {
      swatch.style.background = colors[i % mostLines]!;
    });
    this.drawSoon();
  }

  add(time: number, values: number[]): void {
    if (this.times.length > 0 && time < this.times[this.times.length - 1]!) {
      this.times = [];
      this.lines.forEach((line) => (line.values = []));
    }
    if (time === this.times[this.times.length - 1]) {
      this.times.pop();
      this.lines.forEach((line) => line.values.pop());
    }
    this.times.push(time);
    this.lines.forEach((line, i) => line.values.push(values[i] ?? 0));
    const old = this.times.findIndex((one) => one >= time - window_);
    this.times.splice(0, old);
    this.lines.forEach((line) => line.values.splice(0, old));
    this.drawSoon();
  }

  /** With the next picture, and only where somebody looks. */
  private drawSoon(): void {
    if (!this.waiting) {
      this.waiting = true;
      requestAnimationFrame(() => {
        this.waiting = false;
        if (this.canvas.offsetParent) {
          this.draw();
        }
      });
    }
  }

  private draw(): void {
    const context = this.canvas.getContext("2d");
    if (!context) {
      return;
    }
    const { width, height } = this.canvas;
    context.clearRect(0, 0, width, height);
    const all = this.lines.flatMap((line) => line.values);
    if (all.length === 0) {
      return;
    }
    const low = Math.min(...all);
    const high = Math.max(...all);
    const span = high - low || 1;
    const end = this.times[this.times.length - 1]!;
    context.lineWidth = 1.5;
    this.lines.forEach((line, i) => {
      context.strokeStyle = colors[i % mostLines]!;
      context.beginPath();
      line.values.forEach((value, k) => {
        const x = width * (1 - (end - this.times[k]!) / window_);
        const y = height - 4 - ((height - 8) * (value - low)) / span;
        k === 0 ? context.moveTo(x, y) : context.lineTo(x, y);
      });
      context.stroke();
    });
    context.fillStyle = getComputedStyle(this.canvas).color;
    context.font = "11px system-ui, sans-serif";
    const unit = this.lines[0]?.unit ?? "";
    const text = (value: number) => `${figure(Math.abs(value) < span / 1000 ? 0 : value, 3)} ${unit}`;
    context.fillText(text(high), 4, 12);
    context.fillText(text(low), 4, height - 5);
    this.lines.forEach((line, i) => {
      const item = this.legend.children[i]?.lastElementChild;
      if (item) {
        item.textContent = `${line.name} ${figure(line.values[line.values.length - 1], 4)} ${line.unit}`;
      }
    });
    this.canvas.setAttribute(
      "aria-label",
      `${this.title}: from ${figure(low, 3)} to ${figure(high, 3)} in the last ${window_} s`,
    );
  }
}

export class Plots {
  private readonly joints = new Chart("Joint positions");
  private readonly energy = new Chart("Energy");
  private picked: { joint: number; dof: number; scale: number }[] = [];
  private scene: SceneNotice | null = null;

  constructor(private readonly session: Session) {
    session.panel.addTab("Plots", this.joints.element, this.energy.element);
    session.connection.on<SceneNotice>("scene", (scene) => {
      this.scene = scene;
      this.begin();
      void attempt(session, "observe", { plots: true });
    });
    session.connection.on<PlotsNotice>("plots", (plots) => this.add(plots));
    session.panel.viewer.addEventListener("select", () => this.begin());
  }

  /** The selected joint first, then the others, as many as can be told apart. */
  private begin(): void {
    const joints = this.scene?.joints ?? [];
    const selected = this.session.panel.viewer.selected;
    const order = joints.map((_, i) => i);
    order.sort((a, b) => Number(joints[b]!.path === selected) - Number(joints[a]!.path === selected));
    const lines: Line[] = [];
    this.picked = [];
    for (const joint of order) {
      joints[joint]!.dofs.forEach((dof, k) => {
        if (lines.length < mostLines) {
          const scale = dof.angular ? 180 / Math.PI : 1000;
          this.picked.push({ joint, dof: k, scale });
          lines.push({ name: nameOf(joints[joint]!.path), unit: dof.angular ? "deg" : "mm", values: [] });
        }
      });
    }
    this.joints.begin(lines);
    this.energy.begin(
      ["kinetic", "potential", "sum"].map((name) => ({ name, unit: "J", values: [] })),
    );
  }

  private add(plots: PlotsNotice): void {
    this.joints.add(
      plots.time,
      this.picked.map((one) => (plots.joints[one.joint]?.[one.dof] ?? 0) * one.scale),
    );
    this.energy.add(plots.time, [plots.kinetic, plots.potential, plots.kinetic + plots.potential]);
  }
}
