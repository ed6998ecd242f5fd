// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Keys of the page. They work wherever the mouse was last, but where text is typed. Space presses a
// button only for people who came to it by keyboard; for all others it plays and pauses.
import { h } from "./dom";

export interface Shortcut {
  /** As KeyboardEvent.key has it; "ctrl+z" and "ctrl+shift+z" with these held. */
  key: string;
  label: string;
  act: () => void;
  /** Whether it does something now; else it is neither listed nor taken. */
  there?: () => boolean;
}

/** What counts of an element for keys. */
export interface Target {
  tagName: string;
  type?: string;
  isContentEditable?: boolean;
}

const withoutText = /^(?:button|checkbox|color|file|image|radio|range|reset|submit)$/;

/** Whether letters that are typed there become text, or choose a row of a menu. */
export function takesText({ tagName, type, isContentEditable }: Target): boolean {
  return (
    isContentEditable === true ||
    /^(?:TEXTAREA|SELECT)$/.test(tagName) ||
    (tagName === "INPUT" && !withoutText.test(type ?? "text"))
  );
}

/** Whether Space presses or switches it. */
export function takesSpace({ tagName, type }: Target): boolean {
  return (
    /^(?:BUTTON|SUMMARY|A)$/.test(tagName) ||
    (tagName === "INPUT" && /^(?:button|checkbox|radio|submit)$/.test(type ?? ""))
  );
}

/** The name of what was pressed, as shortcuts have it. */
export function nameOfKey(event: Pick<KeyboardEvent, "key" | "ctrlKey" | "metaKey" | "shiftKey">): string {
  const { key, ctrlKey, metaKey, shiftKey } = event;
  return ctrlKey || metaKey ? `ctrl+${shiftKey ? "shift+" : ""}${key.toLowerCase()}` : key;
}

/** Names as they stand on keys. */
function capOf(key: string): string {
  const named: Record<string, string> = { " ": "Space", Escape: "Esc" };
  return named[key] ?? key.replace("ctrl+", "Ctrl+").replace("shift+", "Shift+").replace(/z$/, "Z");
}

export class Keys {
  private readonly shortcuts: Shortcut[] = [];
  private readonly rows = h("tbody");
  private readonly help: HTMLDialogElement;
  private byMouse = true;

  constructor() {
    this.help = h(
      "dialog",
      { class: "help", "aria-label": "Keys" },
      h("table", {}, this.rows),
      h("button", { type: "button", onclick: () => this.help.close() }, "Close"),
    );
    document.body.append(this.help);
    const noteMouse = (by: boolean) => () => (this.byMouse = by);
    document.addEventListener("pointerdown", noteMouse(true), { capture: true });
    document.addEventListener("keydown", (event) => this.press(event));
    // A menu that was chosen from by mouse lets go of the keys.
    document.addEventListener("change", ({ target }) => {
      if (this.byMouse && target instanceof HTMLSelectElement) {
        target.blur();
      }
    });
    this.add({ key: "?", label: "This list", act: () => this.showHelp() });
  }

  add(...shortcuts: Shortcut[]): void {
    this.shortcuts.push(...shortcuts);
  }

  /** A button beside the list of keys. */
  addHelp(label: string, act: () => void): void {
    const begin = () => {
      this.help.close();
      act();
    };
    this.help.lastElementChild!.before(h("button", { type: "button", onclick: begin }, label), " ");
  }

  showHelp(): void {
    const there = this.shortcuts.filter((one) => one.there?.() ?? true);
    this.rows.replaceChildren(
      ...there.map(({ key, label }) =>
        h("tr", {}, h("td", {}, h("kbd", {}, capOf(key))), h("td", {}, label)),
      ),
    );
    this.help.showModal();
  }

  private press(event: KeyboardEvent): void {
    const target = event.target as HTMLElement & { type?: string };
    if (event.key === "Tab" || event.key.startsWith("Arrow")) {
      this.byMouse = false;
    }
    const pressesIt = event.key === " " && !this.byMouse && takesSpace(target);
    if (takesText(target) || pressesIt || event.altKey || this.help.open) {
      return;
    }
    const name = nameOfKey(event);
    const shortcut = this.shortcuts.find((one) => one.key === name && (one.there?.() ?? true));
    if (shortcut) {
      shortcut.act();
      event.preventDefault();
    }
  }
}
