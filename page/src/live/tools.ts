// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The bar below the picture: play, pause, step and reset, speed, engine, variants, and undo.
import { figure, h, nameOf } from "../panel/dom";
import type { BareRequest } from "./connection";
import type { SceneNotice, StateNotice } from "./protocol";
import { type Session, attempt } from "./session";

export class Tools {
  private readonly play: HTMLButtonElement;
  private readonly clock = h("output", { class: "number clock" }, "0 s");
  private readonly speed: HTMLSelectElement;
  private readonly engine: HTMLSelectElement;
  private readonly variants = h("span", { class: "variants" });
  private readonly undo: HTMLButtonElement;
  private readonly redo: HTMLButtonElement;
  private readonly movers: HTMLButtonElement[];
  private playing = false;

  constructor(private readonly session: Session) {
    const button = (text: string, title: string, act: () => void) =>
      h("button", { type: "button", title, onclick: act }, text);
    this.play = button("Play", "Space", () => this.toggle());
    const step = button("Step", "One time step ( . )", () => void attempt(session, "step"));
    const reset = button("Reset", "Back to the start ( r )", () => void attempt(session, "reset"));
    this.movers = [this.play, step, reset];
    this.speed = this.menu("Speed", (factor) =>
      attempt(session, "speed", { factor: Number(factor) }),
    );
    for (const factor of ["0.1", "0.25", "0.5", "1", "2"]) {
      this.speed.append(h("option", { value: factor, selected: factor === "1" }, `${factor} x`));
    }
    this.engine = this.menu("Engine", (engine) => attempt(session, "engine", { engine }));
    this.undo = button("Undo", "Takes the last edit back ( Ctrl+Z )", () => void attempt(session, "undo"));
    this.redo = button("Redo", "Makes it again ( Ctrl+Shift+Z )", () => void attempt(session, "redo"));
    const bar = h(
      "div",
      { class: "live-tools", role: "toolbar", "aria-label": "Time, engine and variants" },
      this.play,
      step,
      reset,
      this.clock,
      h("label", {}, "Speed ", this.speed),
      h("label", {}, "Engine ", this.engine),
      this.variants,
    );
    session.panel.foot.append(bar);
    session.panel.tools.append(this.undo, this.redo);
    session.connection.on("hello", (notice) => {
      this.undo.hidden = notice.readOnly;
      this.redo.hidden = notice.readOnly;
    });
    session.connection.on("scene", (notice) => this.showScene(notice));
    session.connection.on("state", (notice) => this.showState(notice));
    session.connection.on("closed", () => {
      const menus = Array.from(this.variants.querySelectorAll("select"));
      [...this.movers, this.undo, this.redo, this.speed, this.engine, ...menus].forEach(
        (control) => (control.disabled = true),
      );
    });
    this.addKeys();
  }

  private menu(label: string, choose: (value: string) => Promise<unknown>): HTMLSelectElement {
    const element: HTMLSelectElement = h("select", {
      "aria-label": label,
      onchange: () => void choose(element.value),
    });
    return element;
  }

  private toggle(): void {
    void attempt(this.session, this.playing ? "pause" : "play");
  }

  private addKeys(): void {
    const ask = (name: BareRequest) => () => void attempt(this.session, name);
    const moves = () => !this.play.disabled;
    this.session.panel.keys.add(
      { key: " ", label: "Play or pause", act: () => this.toggle(), there: moves },
      { key: ".", label: "One time step", act: ask("step"), there: moves },
      { key: "r", label: "Back to the start", act: ask("reset"), there: moves },
      { key: "ctrl+z", label: "Undo the last edit", act: ask("undo"), there: () => this.canEdit(this.undo) },
      { key: "ctrl+shift+z", label: "Redo it", act: ask("redo"), there: () => this.canEdit(this.redo) },
    );
  }

  private canEdit(button: HTMLButtonElement): boolean {
    return !button.hidden && !button.disabled;
  }

  private showScene(scene: SceneNotice): void {
    for (const button of this.movers) {
      button.disabled = !scene.simulates;
    }
    this.speed.disabled = false;
    this.engine.disabled = false;
    this.undo.disabled = !scene.canUndo;
    this.redo.disabled = !scene.canRedo;
    this.engine.replaceChildren(
      ...scene.engines.map((one) =>
        h(
          "option",
          {
            value: one.name,
            selected: one.name === scene.engine,
            disabled: !one.available,
            title: one.howToGet,
          },
          one.name,
        ),
      ),
    );
    this.variants.replaceChildren(
      ...scene.variants.map((row) => {
        const menu = this.menu(`Variant of ${row.set} of ${row.prim}`, (variant) =>
          attempt(this.session, "variant", { prim: row.prim, set: row.set, variant }),
        );
        menu.append(
          ...row.options.map((option) =>
            h("option", { value: option, selected: option === row.selection }, option),
          ),
        );
        return h("label", { title: row.prim }, `${row.set} of ${nameOf(row.prim)} `, menu);
      }),
    );
  }

  private showState(state: StateNotice): void {
    this.playing = state.playing;
    this.play.textContent = state.playing ? "Pause" : "Play";
    const slow = state.playing && state.rate > 0 && state.rate < 0.9 * state.speed;
    this.clock.textContent = `${state.time.toFixed(2)} s${slow ? ` (${figure(state.rate, 2)} x)` : ""}`;
    this.clock.title = `${state.contacts} contacts`;
    if (document.activeElement !== this.speed) {
      this.speed.value = String(state.speed);
    }
  }
}
