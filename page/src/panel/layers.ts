// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What is shown: a switch for each kind of thing, with a key.
import type { NoteInfo } from "../scene/info";
import type { OverlayName } from "../scene/overlays";
import type { Viewer } from "../scene/viewer";
import { h } from "./dom";
import type { Shortcut } from "./keys";

interface Layer {
  name: string;
  label: string;
  key: string;
  shown: boolean;
  /** Not in every page: `offer` shows its switch. */
  special?: boolean;
  set: (viewer: Viewer, visible: boolean) => void;
}

const overlay = (name: OverlayName, label: string, key: string): Layer => ({
  name,
  label,
  key,
  shown: false,
  set: (viewer, visible) => viewer.showOverlay(name, visible),
});

const layers: Layer[] = [
  {
    name: "visuals",
    label: "What is seen",
    key: "v",
    shown: true,
    set: (viewer, visible) => viewer.show("visual", visible),
  },
  {
    name: "colliders",
    label: "Colliders",
    key: "c",
    shown: false,
    set: (viewer, visible) => viewer.show("collider", visible),
  },
  overlay("joints", "Joint axes", "j"),
  overlay("limits", "Joint limits", "l"),
  overlay("masses", "Centres of mass", "m"),
  overlay("inertia", "Inertia boxes", "i"),
  overlay("frames", "Frames of bodies", "x"),
  overlay("tree", "Articulation tree", "t"),
  overlay("filtered", "Pairs of the selection that do not touch", "p"),
  { ...overlay("contacts", "Contacts and their forces", "o"), special: true },
  {
    name: "grid",
    label: "Ground grid and shadow",
    key: "g",
    shown: true,
    set: (viewer, visible) => viewer.showGrid(visible),
  },
];

/** What is not drawn, and why; equal reasons together. */
function notDrawn(notes: readonly NoteInfo[]): HTMLElement {
  const prims = new Map<string, string[]>();
  notes.forEach(({ prim, what }) => prims.set(what, [...(prims.get(what) ?? []), prim]));
  const rows = [...prims].map(([what, of]) => {
    const more = of.length > 1 ? ` and ${of.length - 1} more` : "";
    return h("li", {}, `${what}: `, h("code", {}, of[0] || "the asset"), more);
  });
  return h("details", {}, h("summary", {}, `Not drawn as the asset says (${notes.length})`), h("ul", {}, ...rows));
}

export class Layers {
  readonly element = h("fieldset", { class: "layers" }, h("legend", {}, "What is shown"));
  private readonly boxes = new Map<string, HTMLInputElement>();
  /** Called after a switch. */
  onChange: () => void = () => {};
  private begun = false;
  /** What is not drawn. */
  private readonly left = h("div");
  private readonly rows = new Map<string, HTMLElement>();

  constructor(private readonly viewer: Viewer) {
    for (const layer of layers) {
      const box = h("input", {
        type: "checkbox",
        name: layer.name,
        checked: layer.shown,
        onchange: () => this.set(layer.name, box.checked),
      });
      this.boxes.set(layer.name, box);
      const row = h(
        "label",
        { hidden: layer.special },
        box,
        ` ${layer.label} `,
        h("kbd", {}, layer.key),
      );
      this.rows.set(layer.name, row);
      this.element.append(row);
    }
    this.element.append(this.left);
    viewer.addEventListener("load", () => this.begin());
  }

  /** At first what nobody would see otherwise is shown: an asset may have no visuals. */
  private begin(): void {
    if (!this.begun && this.viewer.info.bodies.length > 0 && !this.viewer.has("visual")) {
      for (const name of ["colliders", "masses", "tree"]) {
        this.boxes.get(name)!.checked = true;
      }
    }
    this.begun = true;
    const { notes } = this.viewer.info;
    this.left.replaceChildren(...(notes.length > 0 ? [notDrawn(notes)] : []));
    this.applyAll();
  }

  has(name: string): boolean {
    return this.boxes.has(name);
  }

  /** Shows the switch of something that only this page has. */
  offer(name: string): void {
    const row = this.rows.get(name);
    if (row) {
      row.hidden = false;
    }
  }

  set(name: string, visible: boolean): void {
    const layer = layers.find((one) => one.name === name);
    const box = this.boxes.get(name);
    if (layer && box) {
      box.checked = visible;
      layer.set(this.viewer, visible);
      this.onChange();
    }
  }

  /** Names of those that are shown and of those that are not, where it is otherwise at first. */
  changed(): { more: string[]; less: string[] } {
    const others = layers.filter(({ name, shown }) => this.boxes.get(name)!.checked !== shown);
    const names = (shown: boolean) => others.filter((one) => one.shown !== shown).map((one) => one.name);
    return { more: names(true), less: names(false) };
  }

  /** A key for each switch that this page has. */
  shortcuts(): Shortcut[] {
    return layers.map(({ name, label, key }) => ({
      key,
      label: `Show or hide: ${label}`,
      act: () => this.set(name, !this.boxes.get(name)!.checked),
      there: () => !this.rows.get(name)!.hidden,
    }));
  }

  private applyAll(): void {
    for (const layer of layers) {
      layer.set(this.viewer, this.boxes.get(layer.name)!.checked);
    }
  }
}
