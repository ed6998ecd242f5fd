// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Events of the run as a list: each leads to its moment and its prim. Beside them what touches at the
// moment that is shown.
import { figure, h, nameOf, table } from "../panel/dom";
import { pathButton } from "../panel/joints";
import type { ContactsNotice } from "./protocol";
import type { EventKind, Events, RunEvent } from "./events";
import type { Session } from "./session";
import type { Timeline } from "./timeline";

const mostRows = 200;
const kinds: Record<EventKind, string> = {
  contact: "contacts that begin",
  limit: "joints at limits",
  saturation: "drives at their most",
  engine: "told by the engine",
  failure: "failures",
};

export class EventList {
  private readonly page: HTMLElement;
  private readonly list = h("ul", { class: "findings" });
  private readonly contacts = h("div");
  private readonly wanted = new Set(Object.keys(kinds) as EventKind[]);
  private newest: ContactsNotice | null = null;
  private waiting = false;

  constructor(
    private readonly session: Session,
    private readonly events: Events,
    private readonly timeline: Timeline,
  ) {
    const boxes = (Object.keys(kinds) as EventKind[]).map((kind) => {
      const box: HTMLInputElement = h("input", {
        type: "checkbox",
        checked: true,
        onchange: () => {
          box.checked ? this.wanted.add(kind) : this.wanted.delete(kind);
          this.update();
        },
      });
      return h("label", {}, box, ` ${kinds[kind]}`);
    });
    this.page = session.panel.addTab(
      "Events",
      h("fieldset", { class: "layers" }, h("legend", {}, "Events"), ...boxes),
      this.list,
      h("h3", {}, "What touches now"),
      this.contacts,
    );
    events.addEventListener("change", () => this.updateSoon());
    session.connection.on("contacts", (notice) => {
      this.newest = notice;
      this.updateSoon();
    });
    document.body.addEventListener("tenon-tab", () => this.updateSoon());
  }

  /** With the next picture, and only where somebody looks. */
  private updateSoon(): void {
    if (!this.waiting) {
      this.waiting = true;
      requestAnimationFrame(() => {
        this.waiting = false;
        this.page.hidden || this.update();
      });
    }
  }

  private update(): void {
    const shown = this.events.list.filter((one) => this.wanted.has(one.kind));
    const rows = shown.slice(-mostRows).map((one) => this.row(one));
    const left = this.events.left + shown.length - rows.length;
    const more = left > 0 ? [h("li", {}, `${left} more are not listed.`)] : [];
    const none = rows.length === 0 ? [h("li", {}, "Nothing has happened yet.")] : [];
    this.list.replaceChildren(...rows, ...more, ...none);
    const { viewer } = this.session.panel;
    const contacts = this.newest?.rows.slice(0, mostRows) ?? [];
    const name = (body: string | null, collider: string) => pathButton(viewer, body ?? collider);
    this.contacts.replaceChildren(
      contacts.length === 0
        ? h("p", {}, "Nothing.")
        : table(
            ["", "", "Force [N]", "Depth [mm]"],
            contacts.map((one) => [
              name(one.body0, one.collider0),
              name(one.body1, one.collider1),
              Number(figure(Math.hypot(...one.force), 4)),
              Number(figure(one.depth * 1000, 3)),
            ]),
          ),
    );
  }

  private row(event: RunEvent): HTMLElement {
    const go = () => {
      this.timeline.seek(event.time);
      event.prim && this.session.panel.viewer.select(event.prim);
      this.session.panel.openTab("Events");
    };
    const time = `${event.time.toFixed(2)} s`;
    return h(
      "li",
      { class: `event ${event.kind}` },
      h("button", { type: "button", class: "link", title: `Show ${time} and ${nameOf(event.prim)}`, onclick: go }, time),
      ` ${event.text}`,
    );
  }
}
