// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Plots of the signals that are chosen, one for each unit. Until somebody chooses, positions of joints
// are drawn, the selected one first, and energy.
import { h, nameOf } from "../panel/dom";
import { Chart, mostLines } from "./chart";
import type { History } from "./history";
import type { Session } from "./session";
import { type Signal, type Signals, grouped } from "./signals";
import type { Timeline } from "./timeline";

const mostChosen = 64;
const mostNames = 500; // in the list of prims

export class Plots {
  private readonly prims = h("select", { "aria-label": "Prim of a signal", onchange: () => this.offer() });
  private readonly quantities = h("select", { "aria-label": "Signal of the prim" });
  private readonly windows: HTMLSelectElement;
  private readonly place = h("div");
  private charts: Chart[] = [];
  private signals: Signals | null = null;
  /** Columns; null: nobody has chosen. */
  private chosen: string[] | null = null;

  constructor(
    private readonly session: Session,
    private readonly history: History,
    private readonly timeline: Timeline,
  ) {
    this.windows = h(
      "select",
      { "aria-label": "Time that is plotted", onchange: () => this.setWindow() },
      ...[["10", "10 s"], ["60", "60 s"], ["0", "all"]].map(([value, text]) => h("option", { value }, text)),
    );
    const button = (text: string, title: string, act: () => void) =>
      h("button", { type: "button", title, onclick: act }, text);
    const bar = h(
      "div",
      { class: "signals", role: "toolbar", "aria-label": "Signals" },
      this.prims,
      this.quantities,
      button("Add", "Plots this signal", () => this.add()),
      button("As at first", "Joint positions and energy", () => this.choose(null)),
      this.windows,
    );
    session.panel.addTab("Plots", bar, this.place);
    for (const event of ["sample", "shown"]) {
      history.addEventListener(event, () => this.charts.forEach((chart) => chart.drawSoon()));
    }
    session.panel.viewer.addEventListener("select", () => {
      this.chosen === null && this.build();
      this.pickSelected();
    });
  }

  /** Another scene. What was chosen stays, where it is still there. */
  begin(signals: Signals): void {
    this.signals = signals;
    const group = (label: string, paths: string[]) =>
      h("optgroup", { label }, ...paths.slice(0, mostNames).map((path) =>
        h("option", { value: path, title: path }, nameOf(path))));
    this.prims.replaceChildren(
      h("option", { value: "" }, "the whole"),
      group("Joints", signals.scene.joints.filter((one) => one.dofs.length > 0).map((one) => one.path)),
      group("Bodies", signals.scene.bodies),
    );
    this.pickSelected();
    this.offer();
    this.build();
  }

  /** Signals that are plotted. */
  shown(): Signal[] {
    return (this.chosen ?? this.atFirst()).flatMap((column) => this.signals?.find(column) ?? []);
  }

  choose(columns: string[] | null): void {
    this.chosen = columns;
    this.build();
    document.body.dispatchEvent(new Event("tenon-signals"));
  }

  get choice(): string[] | null {
    return this.chosen;
  }

  private pickSelected(): void {
    const { selected } = this.session.panel.viewer;
    if (selected && Array.from(this.prims.options).some((one) => one.value === selected)) {
      this.prims.value = selected;
      this.offer();
    }
  }

  /** The signals of the prim that is picked. */
  private offer(): void {
    const groups = grouped(this.signals?.of(this.prims.value) ?? [], (one) => one.quantity);
    this.quantities.replaceChildren(...[...groups.keys()].map((name) => h("option", { value: name }, name)));
  }

  private add(): void {
    const more = (this.signals?.of(this.prims.value) ?? [])
      .filter((one) => one.quantity === this.quantities.value)
      .map((one) => one.column);
    const all = [...new Set([...(this.chosen ?? []), ...more])];
    this.choose(all.slice(0, mostChosen));
  }

  private atFirst(): string[] {
    const { joints } = this.signals?.scene ?? { joints: [] };
    const selected = this.session.panel.viewer.selected;
    const order = [...joints].sort((a, b) => Number(b.path === selected) - Number(a.path === selected));
    const columns: string[] = [];
    for (const joint of order) {
      if (columns.length >= mostLines) {
        break;
      }
      columns.push(...this.signals!.of(joint.path).filter((one) => one.quantity === "position").map((one) => one.column));
    }
    return [...columns.slice(0, mostLines), "energy.kinetic", "energy.potential", "energy.total"];
  }

  private build(): void {
    const titles: Record<string, string> = { J: "Energy" };
    const groups = grouped(this.shown(), (one) => one.unit);
    this.charts = [...groups].flatMap(([unit, signals]) => {
      const charts: Chart[] = [];
      for (let i = 0; i < signals.length; i += mostLines) {
        const part = signals.slice(i, i + mostLines);
        const kinds = new Set(part.map((one) => one.quantity));
        const title = titles[unit] ?? (kinds.size === 1 ? [...kinds][0]! : unit || "Counts");
        charts.push(
          new Chart(this.chosen === null && title === "position" ? "Joint positions" : title, part, this.history, {
            seek: (time) => this.timeline.seek(time),
            remove: (signal) =>
              this.choose(this.shown().map((one) => one.column).filter((one) => one !== signal.column)),
          }),
        );
      }
      return charts;
    });
    this.setWindow();
    this.place.replaceChildren(...this.charts.map((one) => one.element));
  }

  private setWindow(): void {
    for (const chart of this.charts) {
      chart.window = Number(this.windows.value);
      chart.drawSoon();
    }
  }
}
