// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Elements made in code. Text of assets only ever becomes text nodes and attribute values, so names
// with markup in them show as they are.

type Handler = (event: never) => void;
export type Attributes = Record<string, string | number | boolean | null | undefined | Handler>;
export type Child = Node | string | null | undefined;

/** An element. `onclick` and the like take functions; true is an attribute without value. */
export function h<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === "function") {
      element.addEventListener(name.slice(2), value as EventListener);
    } else if (value !== null && value !== undefined && value !== false) {
      element.setAttribute(name, value === true ? "" : String(value));
    }
  }
  element.append(...children.filter((child): child is Node | string => child != null));
  return element;
}

/** A slider for a time in seconds, whose range is set when it is known. */
export function timeSlider(label: string, seek: (time: number) => void): HTMLInputElement {
  const slider = h("input", {
    type: "range",
    min: 0,
    max: 1,
    step: "any",
    value: 0,
    "aria-label": label,
    oninput: () => seek(Number(slider.value)),
  });
  return slider;
}

/** A number as people read it: at most `digits` that count. */
export function figure(value: number | null | undefined, digits = 5): string {
  if (value === null || value === undefined) {
    return "-";
  }
  return Number.isFinite(value) ? String(Number(value.toPrecision(digits))) : String(value);
}

/** A table with a head. Cells that are numbers stand to the right. */
export function table(heads: string[], rows: (string | number | Node | null)[][]): HTMLTableElement {
  return h(
    "table",
    {},
    h("thead", {}, h("tr", {}, ...heads.map((head) => h("th", { scope: "col" }, head)))),
    h(
      "tbody",
      {},
      ...rows.map((row) =>
        h(
          "tr",
          {},
          ...row.map((cell) =>
            typeof cell === "number"
              ? h("td", { class: "number" }, figure(cell))
              : h("td", {}, cell ?? "-"),
          ),
        ),
      ),
    ),
  );
}

/** The last part of a path. */
export const nameOf = (path: string): string => path.slice(path.lastIndexOf("/") + 1) || path;
