// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Hides parts, shows them alone, and lets others show through. What is not drawn as usual is said,
// with a button that shows everything again.
import type { Viewer } from "../scene/viewer";
import { h } from "./dom";
import type { Shortcut } from "./keys";
import { command, menu, toggle } from "./menu";

export class PartsMenu {
  readonly element: HTMLElement;
  /** Said over the picture. */
  readonly note = h("p", { class: "parts-note", role: "status", hidden: true });
  private readonly visuals = toggle("See through visible shapes", "", (on) => this.setKind("visual", on));
  private readonly colliders = toggle("See through what collides", "", (on) => this.setKind("collider", on));

  constructor(private readonly viewer: Viewer) {
    this.element = menu(
      "Parts",
      ...this.commands().map((one) => command(one.label, one.key, one.act)),
      this.visuals.element,
      this.colliders.element,
    );
    viewer.addEventListener("visibility", () => this.update());
  }

  commands(): Shortcut[] {
    const { visibility } = this.viewer;
    const change = (act: () => void) => () => this.viewer.change(() => (act(), visibility.apply()));
    const selected = () => this.viewer.selection();
    const switched = (set: Set<string>) => () => {
      const add = selected().some((path) => !set.has(path));
      selected().forEach((path) => (add ? set.add(path) : set.delete(path)));
    };
    return [
      { key: "h", label: "Hide the selection", act: change(switched(visibility.hidden)) },
      {
        key: "b",
        label: "The selection alone, or everything",
        act: change(() => {
          const was = visibility.alone.size > 0;
          visibility.alone.clear();
          was || selected().forEach((path) => visibility.alone.add(path));
        }),
      },
      { key: "k", label: "See through the selection", act: change(switched(visibility.clear)) },
      { key: "u", label: "Show everything", act: () => this.viewer.change(() => visibility.reset()) },
    ];
  }

  private setKind(kind: "visual" | "collider", on: boolean): void {
    const { visibility } = this.viewer;
    this.viewer.change(() => {
      on ? visibility.clearKinds.add(kind) : visibility.clearKinds.delete(kind);
      visibility.apply();
    });
  }

  private update(): void {
    const { alone, clear, clearKinds, hidden } = this.viewer.visibility;
    this.visuals.box.checked = clearKinds.has("visual");
    this.colliders.box.checked = clearKinds.has("collider");
    const said = [
      alone.size > 0 ? `${alone.size} shown alone` : "",
      hidden.size > 0 ? `${hidden.size} hidden` : "",
      clear.size > 0 ? `${clear.size} seen through` : "",
    ].filter(Boolean);
    this.note.hidden = said.length === 0;
    const all = h("button", { type: "button", title: "u" }, "Show everything");
    all.addEventListener("click", () => this.viewer.change(() => this.viewer.visibility.reset()));
    this.note.replaceChildren(`${said.join(", ")} `, all);
  }
}
