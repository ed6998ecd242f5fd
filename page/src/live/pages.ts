// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What tabs with tables of the asset have in common: they ask when somebody opens them, and again
// when the asset has changed meanwhile; what writes is there where files may be edited.
import { h } from "../panel/dom";
import type { Session } from "./session";

/** Calls `load` when the tab is open and its table is older than the asset. */
export function whenOpen(session: Session, name: string, load: (why: string) => void): void {
  let why = "open";
  const look = () => {
    if (why && session.panel.tab === name) {
      const of = why;
      why = "";
      load(of);
    }
  };
  session.connection.on("scene", (scene) => {
    why = scene.why === "reset" ? why : scene.why;
    look();
  });
  document.body.addEventListener("tenon-tab", look);
}

/** A button that writes: only where files may be edited. */
export function writer(session: Session, text: string, act: () => void): HTMLButtonElement {
  const button = h("button", { type: "button", onclick: act }, text);
  session.connection.on("hello", ({ readOnly }) => (button.hidden = readOnly));
  return button;
}

/** Controls of a page rest while there is no server. */
export function restWhileClosed(session: Session, page: HTMLElement): void {
  let resting: (HTMLInputElement | HTMLButtonElement)[] = [];
  session.connection.on("closed", () => {
    const all = page.querySelectorAll<HTMLInputElement | HTMLButtonElement>("input:enabled, button:enabled");
    resting.push(...Array.from(all));
    resting.forEach((one) => (one.disabled = true));
  });
  session.connection.on("open", () => {
    resting.forEach((one) => (one.disabled = false));
    resting = [];
  });
}
