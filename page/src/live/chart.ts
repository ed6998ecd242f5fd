// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Signals of one unit over time, drawn on a canvas and told as numbers. The moment that is shown is a
// line; a click shows another one.
import { figure, h } from "../panel/dom";
import type { Samples } from "./history";
import type { Signal } from "./signals";

const colors = ["#175fb8", "#d9822b", "#2c9f6b", "#b3261e", "#7a5fd0", "#2a8fbd", "#8a5300", "#c0486f"];
export const mostLines = colors.length;
const mostPoints = 1500; // of a line: more are no wider than a pixel

export interface ChartCalls {
  /** A click on a moment; without it nothing happens. */
  seek?: (time: number) => void;
  /** Without it the signals stay. */
  remove?: (signal: Signal) => void;
}

export class Chart {
  readonly element: HTMLElement;
  private readonly canvas = h("canvas", { width: 340, height: 130, role: "img" });
  private readonly legend = h("ul", { class: "legend" });
  /** Seconds that are drawn; 0: all that is kept. */
  window = 10;
  private waiting = false;

  constructor(
    private readonly title: string,
    private readonly signals: Signal[],
    private readonly history: Samples,
    calls: ChartCalls,
  ) {
    this.canvas.setAttribute("aria-label", title);
    this.element = h("figure", {}, h("figcaption", {}, title), this.canvas, this.legend);
    signals.forEach((signal, i) => {
      const swatch = h("span", { class: "swatch" });
      swatch.style.background = colors[i % mostLines]!;
      const remove = calls.remove && h(
        "button",
        { type: "button", class: "link", "aria-label": `Remove ${signal.column}`, onclick: () => calls.remove?.(signal) },
        "\u00d7",
      );
      this.legend.append(h("li", { title: signal.column }, swatch, h("span", {}, signal.label), " ", remove ?? ""));
    });
    this.canvas.addEventListener("click", (event) => {
      const box = this.canvas.getBoundingClientRect();
      const [begin, end] = this.range();
      calls.seek?.(begin + ((event.clientX - box.left) / box.width) * (end - begin));
    });
    new ResizeObserver(() => this.drawSoon()).observe(this.canvas); // it has come to be seen
  }

  /** With the next picture, and only where somebody looks. */
  drawSoon(): void {
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

  private range(): [number, number] {
    const { samples, shown } = this.history;
    const last = samples.last?.time ?? 0;
    if (this.window === 0) {
      return [samples.at(0)?.time ?? 0, last || 1];
    }
    const end = shown === null ? last : Math.min(last, Math.max(shown + this.window / 2, this.window));
    return [end - this.window, end];
  }

  private draw(): void {
    const context = this.canvas.getContext("2d")!;
    const { width, height } = this.canvas;
    context.clearRect(0, 0, width, height);
    const { samples, sample, shown } = this.history;
    if (samples.length === 0 || this.signals.length === 0) {
      return;
    }
    const [begin, end] = this.range();
    const first = Math.max(samples.indexAt(begin), 0);
    const step = Math.ceil((samples.length - first) / mostPoints);
    const lines = this.signals.map((signal) => {
      const points: [number, number][] = [];
      for (let i = first; i < samples.length; i += step) {
        const one = samples.at(i)!;
        if (one.time <= end) {
          points.push([one.time, signal.of(one, this.history)]);
        }
      }
      return points;
    });
    const all = lines.flat().map((point) => point[1]).filter(Number.isFinite);
    const low = all.reduce((a, b) => Math.min(a, b), Infinity);
    const high = all.reduce((a, b) => Math.max(a, b), -Infinity);
    const span = high - low || 1;
    const x = (time: number) => (width * (time - begin)) / (end - begin || 1);
    const y = (value: number) => height - 4 - ((height - 8) * (value - low)) / span;
    context.lineWidth = 1.5;
    lines.forEach((points, i) => {
      context.strokeStyle = colors[i % mostLines]!;
      context.beginPath();
      let drawn = false;
      for (const [time, value] of points) {
        if (Number.isFinite(value)) {
          drawn ? context.lineTo(x(time), y(value)) : context.moveTo(x(time), y(value));
        }
        drawn = Number.isFinite(value);
      }
      context.stroke();
    });
    context.fillStyle = getComputedStyle(this.canvas).color;
    if (shown !== null) {
      context.fillRect(x(shown), 0, 1, height);
    }
    this.label(context, all.length > 0 ? [low, high] : null);
    this.tell(sample ? this.signals.map((one) => one.of(sample, this.history)) : []);
  }

  private label(context: CanvasRenderingContext2D, range: [number, number] | null): void {
    const unit = this.signals[0]!.unit;
    const [low, high] = range ?? [0, 0];
    const text = (value: number) =>
      `${figure(Math.abs(value) < (high - low) / 1000 ? 0 : value, 3)} ${unit}`;
    if (range) {
      context.font = "11px system-ui, sans-serif";
      context.fillText(text(high), 4, 12);
      context.fillText(text(low), 4, this.canvas.height - 5);
    }
    const span = this.window === 0 ? "since the start" : `in the last ${this.window} s`;
    const said = range ? `from ${figure(low, 3)} to ${figure(high, 3)} ${span}` : "not told by this engine";
    this.canvas.setAttribute("aria-label", `${this.title}: ${said}`);
  }

  private tell(values: number[]): void {
    this.signals.forEach((signal, i) => {
      const item = this.legend.children[i]?.children[1];
      const value = values[i] ?? NaN;
      if (item) {
        item.textContent = `${signal.label} ${Number.isFinite(value) ? figure(value, 4) : "-"} ${signal.unit}`;
      }
    });
  }
}
