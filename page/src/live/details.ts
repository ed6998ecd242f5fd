// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// All properties of the selected prim: who says what and why it counts, and edits, whose effect is
// told where they were made.
import { figure, h, table } from "../panel/dom";
import type { Edited, Property } from "./protocol";
import { type Session, attempt } from "./session";

function plain(value: unknown): string {
  if (typeof value === "number") {
    return figure(value, 6);
  }
  return typeof value === "string" ? value : value === null ? "none" : JSON.stringify(value);
}

const fileName = (path: string): string => path.slice(path.lastIndexOf("/") + 1);

export class Details {
  private readOnly = false;
  private time = 0;
  /** Properties that people have opened: they stay so when the selection is drawn anew. */
  private readonly opened = new Set<string>();
  /** What the last edit did; shown again when the selection is drawn anew after it. */
  private effect: { object: string; text: HTMLElement } | null = null;

  constructor(private readonly session: Session) {
    session.connection.on("hello", (notice) => {
      this.readOnly = notice.readOnly;
    });
    session.connection.on("state", (notice) => {
      this.time = notice.time;
    });
    session.connection.on("scene", ({ why }) => {
      if (why === "undo" || why === "redo") {
        session.messages.say(why === "undo" ? "The last edit was taken back." : "The edit was made again.");
      }
      if (why !== "edit" && why !== "reset" && why !== "engine" && this.effect) {
        this.effect = null; // it is no longer so
        session.panel.inspector.update();
      }
    });
    session.connection.on("closed", () => {
      const fields = session.panel.inspector.element.querySelectorAll<HTMLInputElement>(".editor input, .editor button");
      fields.forEach((field) => (field.disabled = true));
    });
    session.connection.on("open", () => session.panel.inspector.update());
    session.panel.inspector.addSource((path) => this.properties(path));
  }

  private async properties(prim: string): Promise<Node | null> {
    const answer = await this.session.connection
      .ask("inspect", { prim })
      .catch(() => null);
    if (!answer) {
      return null;
    }
    const authored = answer.all.filter((one) => one.authored);
    const others = answer.all.filter((one) => !one.authored);
    const rows = (list: Property[]) => list.map((one) => this.row(prim, one));
    const apis = answer.apis.length > 0 ? `, ${answer.apis.join(", ")}` : "";
    return h(
      "section",
      { class: "properties" },
      h("h3", {}, "Properties"),
      h("p", {}, `${answer.type || "no type"}${apis}`),
      this.effect?.object.startsWith(`${prim}.`) ? this.effect.text : null,
      ...rows(authored),
      others.length > 0
        ? h(
            "details",
            { open: others.some((one) => this.opened.has(`${prim}.${one.name}`)) },
            h("summary", {}, `${others.length} that nobody has set`),
            ...rows(others),
          )
        : null,
    );
  }

  private row(prim: string, property: Property): HTMLElement {
    const object = `${prim}.${property.name}`;
    const place = h("div");
    const row: HTMLDetailsElement = h(
      "details",
      {
        class: "property",
        "data-property": property.name,
        open: this.opened.has(object),
        ontoggle: () => {
          row.open ? this.opened.add(object) : this.opened.delete(object);
          if (row.open && place.childElementCount === 0) {
            void this.open(object, property, place);
          }
        },
      },
      h(
        "summary",
        {},
        h("code", {}, property.name),
        ` ${property.value ?? ""} `,
        h("small", {}, property.type),
      ),
      place,
    );
    return row;
  }

  private async open(object: string, property: Property, place: HTMLElement): Promise<void> {
    const answer = await attempt(this.session, "where", { object });
    const opinions = answer?.opinions ?? [];
    place.replaceChildren(
      table(
        ["Where", "Says", "Verdict"],
        opinions.map((one) => [
          one.file ? `${one.file}${one.line ? `:${one.line}` : ""}` : "the schema",
          one.value ?? "",
          `${one.verdict}${one.why ? `: ${one.why}` : ""}`,
        ]),
      ),
    );
    if (!this.readOnly) {
      place.append(this.editor(object, property));
    }
  }

  private editor(object: string, property: Property): HTMLElement {
    const input = h("input", {
      type: "text",
      value: property.value ?? "",
      "aria-label": `New value of ${property.name}`,
      spellcheck: "false",
    });
    return h(
      "form",
      {
        class: "editor",
        onsubmit: (event: SubmitEvent) => {
          event.preventDefault();
          void this.tell(object, attempt(this.session, "set", { object, value: input.value }));
        },
      },
      input,
      h("button", { type: "submit" }, "Set"),
      h(
        "button",
        { type: "button", onclick: () => void this.tell(object, attempt(this.session, "clear", { object })) },
        "Clear",
      ),
    );
  }

  /** What an edit did, once it is made. */
  private async tell(object: string, edit: Promise<Edited | null>): Promise<void> {
    const hadPassed = this.time > 0;
    const edited = await edit;
    const place = edited?.edits[0];
    if (!edited || !place) {
      return;
    }
    const line = place.line ? `:${place.line}` : "";
    const change = `${place.before ?? "none"} -> ${place.after ?? "none"}`;
    const title = `${change} in ${place.file}${line} (${place.why})`;
    const differences = edited.physics.flatMap((effect) => effect.differences);
    const rows = differences
      .slice(0, 20)
      .map((one) =>
        one.what === null
          ? `${one.path} ${one.change}`
          : `${one.path} ${one.what}: ${plain(one.before)} -> ${plain(one.after)} ${one.unit ?? ""}`);
    this.effect = {
      object,
      text: h(
        "div",
        { class: "effect", role: "status" },
        h("p", {}, title),
        h("ul", {}, ...[...new Set(rows)].map((row) => h("li", {}, row))),
      ),
    };
    const anew = hadPassed ? "; time begins anew with it" : "";
    this.session.messages.say(`${change} in ${fileName(place.file)}${line}${anew}`);
    this.session.panel.inspector.update();
  }
}
