// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What stands around the picture: head, scene tree, tabs, and the bar of time. `live` and `report`
// add tabs of their own.
import type { Viewer } from "../scene/viewer";
import { CameraMenu } from "./camera_menu";
import { h } from "./dom";
import { Inspector } from "./inspector";
import { jointTable } from "./joints";
import { Keys } from "./keys";
import { Layers } from "./layers";
import { Measure } from "./measure";
import { PartsMenu } from "./parts_menu";
import { TimeBar } from "./time_bar";
import { Tree } from "./tree";

export class Panel {
  readonly tree: Tree;
  readonly inspector: Inspector;
  readonly layers: Layers;
  readonly timeBar: TimeBar;
  readonly keys = new Keys();
  readonly camera: CameraMenu;
  readonly parts: PartsMenu;
  readonly measure: Measure;
  /** Left of the buttons in the head: for more of them. */
  readonly tools = h("div", { class: "tools", role: "toolbar", "aria-label": "Tools" });
  /** The picture, and what is said over it. */
  readonly picture = h("div", { class: "picture" });
  /** Below the picture: for bars. */
  readonly foot = h("div", { class: "foot" });

  private readonly title = h("h1", {}, "tenon");
  private readonly tabs = h("div", { class: "tabs", role: "tablist", "aria-label": "Details" });
  private readonly pages = h("div", { class: "pages" });
  private readonly root: HTMLElement;

  /** `picture` makes the viewer in the element that it is handed. */
  constructor(parent: HTMLElement, makeViewer: (place: HTMLElement) => Viewer) {
    const place = this.picture;
    const left = h("nav", { class: "left", "aria-label": "Scene" });
    const right = h("aside", { class: "right", "aria-label": "Details" }, this.tabs, this.pages);
    const theme = h("button", { type: "button", onclick: () => this.switchTheme() }, "Dark or light");
    const frame = h(
      "button",
      { type: "button", title: "f", onclick: () => this.viewer.frame(this.viewer.selected) },
      "Look at it",
    );
    const menus = h("div", { class: "tools", role: "toolbar", "aria-label": "Camera and parts" });
    const help = h("button", { type: "button", title: "?", onclick: () => this.keys.showHelp() }, "Keys");
    this.root = h(
      "div",
      { class: "app" },
      h("header", {}, this.title, menus, this.tools, frame, theme, help),
      left,
      h("main", { class: "middle" }, place, this.foot),
      right,
    );
    parent.append(this.root);
    this.viewer = makeViewer(place);
    this.tree = new Tree(this.viewer);
    left.append(this.tree.element);
    this.inspector = new Inspector(this.viewer);
    this.layers = new Layers(this.viewer);
    this.timeBar = new TimeBar(this.viewer);
    this.camera = new CameraMenu(this.viewer);
    this.parts = new PartsMenu(this.viewer);
    this.measure = new Measure(this.viewer);
    menus.append(this.camera.element, this.parts.element, this.measure.button);
    place.append(h("div", { class: "notes" }, this.camera.note, this.parts.note, this.measure.note));
    this.foot.append(this.timeBar.element);
    this.addTab("Selection", this.inspector.element);
    this.addTab("Show", this.layers.element);
    const joints = this.addTab("Joints");
    this.viewer.addEventListener("load", () => joints.replaceChildren(jointTable(this.viewer)));
    this.setTheme(matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light");
    this.addKeys();
  }

  readonly viewer: Viewer;

  setTitle(text: string): void {
    this.title.textContent = text;
    document.title = `${text} - tenon`;
  }

  /** A page with a name; the first one added is the one that is open. */
  addTab(name: string, ...contents: (Node | string)[]): HTMLElement {
    const id = `tab-${this.tabs.childElementCount}`;
    const first = this.tabs.childElementCount === 0;
    const page = h(
      "div",
      { role: "tabpanel", id: `${id}-page`, "aria-labelledby": id, tabindex: 0, hidden: !first },
      ...contents,
    );
    const tab = h(
      "button",
      {
        type: "button",
        role: "tab",
        id,
        "aria-controls": page.id,
        "aria-selected": String(first),
        tabindex: first ? 0 : -1,
        onclick: () => this.openTab(name),
        onkeydown: (event: KeyboardEvent) => this.tabKey(event),
      },
      name,
    );
    this.tabs.append(tab);
    this.pages.append(page);
    return page;
  }

  /** The name of the page that is open. */
  get tab(): string {
    return this.tabs.querySelector('[aria-selected="true"]')?.textContent ?? "";
  }

  /** Opens the page with a name; where there is none, nothing changes. */
  openTab(name: string): void {
    if (!Array.from(this.tabs.children).some((tab) => tab.textContent === name)) {
      return;
    }
    for (const tab of Array.from(this.tabs.children) as HTMLElement[]) {
      const open = tab.textContent === name;
      tab.setAttribute("aria-selected", String(open));
      tab.tabIndex = open ? 0 : -1;
      document.getElementById(`${tab.id}-page`)!.hidden = !open;
    }
    this.root.dispatchEvent(new CustomEvent("tenon-tab", { bubbles: true, detail: name }));
  }

  setTheme(theme: "light" | "dark"): void {
    document.documentElement.dataset.theme = theme;
    this.viewer.setTheme(theme);
  }

  private switchTheme(): void {
    this.setTheme(document.documentElement.dataset.theme === "dark" ? "light" : "dark");
  }

  private tabKey(event: KeyboardEvent): void {
    const step = event.key === "ArrowRight" ? 1 : event.key === "ArrowLeft" ? -1 : 0;
    if (step === 0) {
      return;
    }
    const tabs = Array.from(this.tabs.children) as HTMLElement[];
    const at = tabs.indexOf(event.currentTarget as HTMLElement);
    const next = tabs[(at + step + tabs.length) % tabs.length]!;
    this.openTab(next.textContent ?? "");
    next.focus();
    event.preventDefault();
  }

  private addKeys(): void {
    const moves = () => this.viewer.motion !== null;
    this.keys.add(
      { key: "f", label: "Look at the selection", act: () => this.viewer.frame(this.viewer.selected) },
      { key: "a", label: "Look at everything", act: () => this.viewer.frame() },
      { key: "/", label: "Find a prim", act: () => this.tree.focusSearch() },
      { key: "Escape", label: "Select nothing", act: () => this.viewer.select("") },
      { key: " ", label: "Play or pause", act: () => this.timeBar.toggle(), there: moves },
      { key: ",", label: "A frame back", act: () => this.timeBar.step(-1 / 30), there: moves },
      { key: ".", label: "A frame forward", act: () => this.timeBar.step(1 / 30), there: moves },
      ...this.layers.shortcuts(),
      ...this.camera.shortcuts(),
      ...this.parts.commands(),
      { key: "d", label: "Measure distances and angles", act: () => this.measure.toggle() },
    );
  }
}
