// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Five steps around the page for people who open it for the first time. The list of keys starts them
// again. A browser that keeps nothing never shows them by itself.
import { h } from "../panel/dom";
import type { Panel } from "../panel/panel";

const key = "tenon-tour";

const steps = [
  {
    at: ".picture",
    head: "The picture",
    text: "Drag to turn it, scroll to zoom, drag with the right button to move it. A click selects a body, " +
      "Ctrl+click one more. Pull at a body with Shift held.",
  },
  {
    at: ".left",
    head: "What is in the asset",
    text: "All prims. Type a part of a path, a type or a kind to find one; the key / leads there.",
  },
  {
    at: ".right",
    head: "Its values",
    text: "Move has a slider for each joint and drive. Selection says which file each value comes from, and " +
      "changes it. Findings says what is wrong, and corrects it.",
  },
  {
    at: ".foot",
    head: "Time",
    text: "Play simulates. What was simulated is kept: drag the slider to look at it again. Plots draws it.",
  },
  {
    at: "header",
    head: "Views and keys",
    text: "Camera, Parts and Measure change how you look. The key ? lists all keys, and starts these steps " +
      "again. The address of the page keeps what you see.",
  },
] as const;

/**
 * Whether they were dismissed before. The storage of a page belongs to its port, which `tenon view`
 * chooses at each start; a cookie belongs to the machine.
 */
function wasDismissed(): boolean {
  try {
    return localStorage.getItem(key) !== null || document.cookie.includes(`${key}=`);
  } catch {
    return true;
  }
}

function rememberDismissed(): void {
  try {
    localStorage.setItem(key, "dismissed");
    document.cookie = `${key}=dismissed; path=/; max-age=315360000; SameSite=Strict`;
  } catch {
    // Then they are not shown by themselves either.
  }
}

export class Tour {
  private step = 0;
  private readonly head = h("strong");
  private readonly text = h("p");
  private readonly back = h("button", { type: "button", onclick: () => this.show(this.step - 1) }, "Back");
  private readonly next = h("button", { type: "button", onclick: () => this.show(this.step + 1) }, "Next");
  private readonly card = h(
    "section",
    { class: "tour", "aria-label": "First steps", hidden: true },
    h("div", { "aria-live": "polite" }, this.head, this.text),
    h(
      "div",
      { class: "buttons" },
      this.back,
      this.next,
      h("button", { type: "button", onclick: () => this.dismiss() }, "Close"),
    ),
  );

  constructor(panel: Panel) {
    panel.picture.append(this.card);
    this.card.addEventListener("keydown", (event) => {
      if (event.key === "Escape") {
        this.dismiss();
        event.stopPropagation();
      }
    });
    panel.keys.addHelp("First steps", () => {
      this.show(0);
      this.next.focus();
    });
    // An address that names a view is a link to that view.
    if (location.hash.length <= 1 && !wasDismissed()) {
      this.show(0);
    }
  }

  private show(step: number): void {
    if (step >= steps.length) {
      this.dismiss();
      return;
    }
    this.step = Math.max(0, step);
    const { at, head, text } = steps[this.step]!;
    this.card.hidden = false;
    this.head.textContent = `${head} (${this.step + 1} of ${steps.length})`;
    this.text.textContent = text;
    this.back.disabled = this.step === 0;
    this.next.textContent = this.step + 1 === steps.length ? "Done" : "Next";
    this.point(at);
  }

  private dismiss(): void {
    const focused = this.card.contains(document.activeElement);
    this.card.hidden = true;
    this.point(null);
    rememberDismissed();
    focused && document.querySelector<HTMLElement>(".picture canvas")?.focus();
  }

  /** Frames what the step speaks of. */
  private point(at: string | null): void {
    document.querySelector(".toured")?.classList.remove("toured");
    at && document.querySelector(at)?.classList.add("toured");
  }
}
