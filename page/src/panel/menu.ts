// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Menus in the head of the page: they close with Esc, with a click elsewhere, and after a command.
import { type Child, h } from "./dom";

export function menu(label: string, ...items: Child[]): HTMLDetailsElement {
  const box = h("div", { class: "menu-items", role: "group", "aria-label": label }, ...items);
  const element = h("details", { class: "menu" }, h("summary", {}, label), box);
  const close = () => element.removeAttribute("open");
  box.addEventListener("click", ({ target }) => (target as Element).closest("button") && close());
  element.addEventListener("keydown", (event) => {
    if (event.key === "Escape" && element.open) {
      close();
      element.querySelector("summary")?.focus();
      event.stopPropagation();
    }
  });
  document.addEventListener("pointerdown", (event) => {
    if (!element.contains(event.target as Node)) {
      close();
    }
  });
  return element;
}

/** A row of a menu: what it does, and its key. */
export function command(label: string, key: string, act: () => void): HTMLButtonElement {
  const cap = key ? h("kbd", { "aria-hidden": "true" }, key) : null;
  return h("button", { type: "button", onclick: act }, h("span", {}, label), cap);
}

/** A row of a menu that is on or off. */
export function toggle(label: string, key: string, act: (on: boolean) => void): {
  element: HTMLLabelElement;
  box: HTMLInputElement;
} {
  const box: HTMLInputElement = h("input", { type: "checkbox", onchange: () => act(box.checked) });
  const cap = key ? h("kbd", { "aria-hidden": "true" }, key) : null;
  return { element: h("label", {}, box, h("span", {}, label), cap), box };
}
