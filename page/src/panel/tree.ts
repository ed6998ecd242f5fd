// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The prims as a tree by their paths, with search: those with physics or shapes, and all others that
// a page knows of. Rows below a prim are made when it is opened, so that large scenes cost nothing.
import type { Viewer } from "../scene/viewer";
import { h, nameOf } from "./dom";

interface Entry {
  path: string;
  kinds: Set<string>;
  children: Entry[];
}

const mostFound = 200;
const opened = 3; // levels that are open at the start
const mostOpened = 40; // children, of which a prim with more begins closed

export class Tree {
  readonly element: HTMLElement;
  private readonly search: HTMLInputElement;
  private readonly list = h("ul", { role: "tree", "aria-label": "Prims", "aria-multiselectable": "true" });
  private readonly status = h("p", { role: "status", class: "status" });
  private readonly entries = new Map<string, Entry>();
  private top: Entry[] = [];
  /** What people have opened and closed, by path: it stays when the prims are read anew. */
  private readonly wanted = new Map<string, boolean>();
  /** Types of prims by path, from `addPrims`. */
  private types = new Map<string, string>();
  /** Called when somebody is about to search. */
  onSearch: () => void = () => {};

  constructor(private readonly viewer: Viewer) {
    this.search = h("input", {
      type: "search",
      placeholder: "Find a prim ( / )",
      "aria-label": "Find a prim by a part of its path or kind",
      onfocus: () => this.onSearch(),
      oninput: () => this.update(),
    });
    this.element = h("div", { class: "tree" }, this.search, this.status, this.list);
    this.list.addEventListener("click", (event) => this.click(event));
    this.list.addEventListener("keydown", (event) => this.key(event));
    viewer.addEventListener("load", () => this.read());
    viewer.addEventListener("select", () => this.showSelection());
  }

  /** How many prims it knows. */
  get size(): number {
    return this.entries.size;
  }

  /** All prims of the stage, in its order. */
  addPrims(prims: readonly { path: string; type: string }[]): void {
    this.types = new Map(prims.map(({ path, type }) => [path, type]));
    this.read();
  }

  focusSearch(): void {
    this.search.focus();
  }

  private read(): void {
    this.entries.clear();
    this.top = [];
    const info = this.viewer.info;
    for (const body of info.bodies) {
      this.add(body.path, "body");
    }
    for (const joint of info.joints) {
      this.add(joint.path, `${joint.kind} joint`);
    }
    for (const collider of info.colliders) {
      this.add(collider.path, "collider");
    }
    this.viewer.root.traverse((node) => {
      if (node.userData.kind === "visual") {
        this.add(node.userData.path as string, "visual");
      }
    });
    for (const articulation of info.articulations) {
      this.add(articulation.path, "articulation");
    }
    for (const [path, type] of this.types) {
      const { kinds } = this.entryAt(path);
      if (kinds.size === 0 && type) {
        kinds.add(type);
      }
    }
    this.update();
    this.showSelection();
  }

  private add(path: string, kind: string): void {
    if (path) {
      this.entryAt(path).kinds.add(kind);
    }
  }

  private entryAt(path: string): Entry {
    let entry = this.entries.get(path);
    if (!entry) {
      entry = { path, kinds: new Set(), children: [] };
      this.entries.set(path, entry);
      const cut = path.lastIndexOf("/");
      (cut > 0 ? this.entryAt(path.slice(0, cut)).children : this.top).push(entry);
    }
    return entry;
  }

  private update(): void {
    const words = this.search.value.trim().toLowerCase().split(/\s+/).filter(Boolean);
    if (words.length === 0) {
      this.status.textContent = "";
      this.list.replaceChildren(...this.top.map((entry) => this.row(entry, 1, true)));
    } else {
      const found = [...this.entries.values()].filter((entry) => {
        const text = `${entry.path} ${[...entry.kinds].join(" ")}`.toLowerCase();
        return words.every((word) => text.includes(word));
      });
      const more = found.length > mostFound ? `, the first ${mostFound} are shown` : "";
      this.status.textContent = `${found.length} found${more}`;
      const shown = found.slice(0, mostFound);
      this.list.replaceChildren(...shown.map((entry) => this.row(entry, 1, false)));
    }
    const first = this.list.querySelector<HTMLElement>("[role=treeitem]");
    if (first) {
      first.tabIndex = 0;
    }
    this.markSelected();
  }

  /** A row, with those below it where `nested`. */
  private row(entry: Entry, level: number, nested: boolean): HTMLElement {
    const below = nested && entry.children.length > 0;
    const atFirst = level < opened && entry.children.length <= mostOpened;
    const open = below && (this.wanted.get(entry.path) ?? atFirst);
    const text = h("span", { class: "row", title: entry.path }, h("bdi", {}, nameOf(entry.path)));
    if (entry.kinds.size > 0) {
      text.append(" ", h("small", {}, [...entry.kinds].join(", ")));
    }
    if (!nested) {
      // Cut at its beginning, where all results are alike.
      const above = entry.path.slice(0, entry.path.lastIndexOf("/")) || "/";
      text.append(h("small", { class: "above" }, h("bdi", {}, above)));
    }
    const item = h(
      "li",
      {
        role: "treeitem",
        "aria-level": level,
        "aria-selected": "false",
        "aria-expanded": below ? String(open) : null,
        "data-path": entry.path,
        tabindex: -1,
      },
      text,
    );
    if (open) {
      this.fill(item, entry, level);
    }
    return item;
  }

  private fill(item: HTMLElement, entry: Entry, level: number): void {
    const rows = entry.children.map((child) => this.row(child, level + 1, true));
    item.append(h("ul", { role: "group" }, ...rows));
  }

  private setOpen(item: HTMLElement, open: boolean): void {
    if (!item.hasAttribute("aria-expanded")) {
      return;
    }
    const entry = this.entries.get(item.dataset.path ?? "");
    if (open && entry && !item.querySelector("ul")) {
      this.fill(item, entry, Number(item.getAttribute("aria-level")));
      this.markSelected();
    }
    item.setAttribute("aria-expanded", String(open));
    this.wanted.set(item.dataset.path ?? "", open);
    const group = item.querySelector("ul");
    if (group) {
      group.hidden = !open;
    }
  }

  private click(event: MouseEvent): void {
    const item = (event.target as HTMLElement).closest<HTMLElement>("[role=treeitem]");
    if (!item) {
      return;
    }
    if (event.ctrlKey || event.metaKey) {
      this.viewer.selectAlso(item.dataset.path ?? "");
      return;
    }
    const was = this.viewer.selected === item.dataset.path;
    this.viewer.select(item.dataset.path ?? "");
    if (was || item.getAttribute("aria-expanded") === "false") {
      this.setOpen(item, item.getAttribute("aria-expanded") === "false");
    }
  }

  private visibleItems(): HTMLElement[] {
    const all = Array.from(this.list.querySelectorAll<HTMLElement>("[role=treeitem]"));
    return all.filter((item) => item.offsetParent !== null);
  }

  private key(event: KeyboardEvent): void {
    const items = this.visibleItems();
    const item = (event.target as HTMLElement).closest<HTMLElement>("[role=treeitem]");
    if (!item) {
      return;
    }
    const at = items.indexOf(item);
    const isOpen = item.getAttribute("aria-expanded") === "true";
    const parent = item.parentElement?.closest<HTMLElement>("[role=treeitem]");
    const go = (to: HTMLElement | null | undefined) => to?.focus();
    const actions: Record<string, () => void> = {
      ArrowDown: () => go(items[at + 1]),
      ArrowUp: () => go(items[at - 1]),
      Home: () => go(items[0]),
      End: () => go(items[items.length - 1]),
      ArrowRight: () => (isOpen ? go(items[at + 1]) : this.setOpen(item, true)),
      ArrowLeft: () => (isOpen ? this.setOpen(item, false) : go(parent)),
      Enter: () =>
        event.ctrlKey || event.metaKey
          ? this.viewer.selectAlso(item.dataset.path ?? "")
          : this.viewer.select(item.dataset.path ?? ""),
    };
    const action = actions[event.key];
    if (action) {
      action();
      event.preventDefault();
      event.stopPropagation();
    }
  }

  private markSelected(): HTMLElement | null {
    let marked: HTMLElement | null = null;
    const all = new Set(this.viewer.selection());
    for (const item of Array.from(this.list.querySelectorAll<HTMLElement>("[role=treeitem]"))) {
      const path = item.dataset.path ?? "";
      item.setAttribute("aria-selected", String(all.has(path)));
      marked = path === this.viewer.selected ? item : marked;
    }
    return marked;
  }

  /** Opens what is above the selection. */
  private showSelection(): void {
    const path = this.viewer.selected;
    if (path && this.search.value === "") {
      for (let cut = path.indexOf("/", 1); cut > 0; cut = path.indexOf("/", cut + 1)) {
        const above = path.slice(0, cut);
        const items = Array.from(this.list.querySelectorAll<HTMLElement>("[role=treeitem]"));
        const item = items.find((one) => one.dataset.path === above);
        if (item) {
          this.setOpen(item, true);
        }
      }
    }
    this.markSelected()?.scrollIntoView({ block: "nearest" });
  }
}
