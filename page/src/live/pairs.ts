// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Which bodies touch over the postures of the joints, as `tenon pairs` tells. A row selects both
// bodies; a tick keeps them apart once it is saved.
import { figure, h, nameOf } from "../panel/dom";
import { restWhileClosed, whenOpen, writer } from "./pages";
import type { FoundPair, FoundPairs, PairFilter } from "./protocol";
import { review } from "./review";
import type { Session } from "./session";
import { Task } from "./task";

const mostRows = 500;
const mostChanges = 256; // of one request
/** Why two bodies are kept apart, in few words. */
const reasonOf = ({ why, property }: PairFilter): string =>
  property === "physics:filteredPairs" ? "filtered pair" : property === "physics:collisionEnabled" ? "kept apart by a joint" : why;
const millimetres = (depth: number | null): string => (depth === null ? "-" : figure(depth * 1000, 3));

export class Pairs {
  private readonly task: Task<"pairs">;
  private readonly postures: HTMLInputElement;
  private readonly environment = h("input", { type: "checkbox" });
  private readonly all = h("input", { type: "checkbox" });
  private readonly filter: HTMLInputElement;
  private readonly place = h("div");
  private readonly save: HTMLButtonElement;
  private found: FoundPairs | null = null;
  /** Ticks that differ from what the asset says. */
  private readonly ticks = new Map<FoundPair, boolean>();

  constructor(private readonly session: Session) {
    this.task = new Task(session, "pairs");
    this.postures = h("input", { type: "number", min: 0, max: 10000, value: 1000, "aria-label": "Postures to look at" });
    this.filter = h("input", {
      type: "search",
      placeholder: "Filter by body or how often",
      "aria-label": "Filter pairs",
      oninput: () => this.update(),
    });
    const look = h("button", { type: "button", onclick: () => void this.look() }, "Look for contacts");
    const always = h("button", { type: "button", onclick: () => this.tickAlways() }, "Tick what always touches");
    this.save = writer(session, "Save pairs...", () => void this.write());
    const page = session.panel.addTab(
      "Pairs",
      h("p", {}, "Which bodies touch when the joints move, whatever filters say. A tick keeps two apart."),
      h("div", { class: "choices" }, look, h("label", {}, this.postures, " postures")),
      h("div", { class: "choices" },
        h("label", {}, this.environment, " what stands still, too"),
        h("label", {}, this.all, " pairs that never touch, too")),
      this.task.element,
      this.filter,
      this.place,
      h("div", { class: "buttons" }, this.save, always),
    );
    restWhileClosed(session, page);
    // Names may be others, and what was found is older than the asset.
    whenOpen(session, "Pairs", (why) => (this.found && why !== "engine" ? void this.look() : this.update()));
    this.update();
  }

  private async look(): Promise<void> {
    const answer = await this.task.run({
      postures: Math.min(Math.max(Math.round(Number(this.postures.value)) || 0, 0), 10000),
      environment: this.environment.checked,
      all: this.all.checked,
    });
    if (answer) {
      this.found = answer;
      this.ticks.clear();
      this.update();
    }
  }

  private update(): void {
    this.save.disabled = this.ticks.size === 0;
    if (!this.found) {
      this.place.replaceChildren();
      return;
    }
    const { postures, never, pairCount, pairs } = this.found;
    const words = this.filter.value.trim().toLowerCase().split(/\s+/).filter(Boolean);
    const matching = pairs.filter((pair) => {
      const text = `${pair.bodyA} ${pair.bodyB} ${pair.class ?? ""} ${pair.adjacent ? "adjacent" : ""}`.toLowerCase();
      return words.every((word) => text.includes(word));
    });
    const rows = matching.slice(0, mostRows).map((pair) => this.row(pair));
    const heads = ["Apart", "Bodies", "Touch", "Depth [mm]"].map((head) => h("th", { scope: "col" }, head));
    const left = matching.length - rows.length;
    this.place.replaceChildren(
      h("p", { role: "status" }, `${postures} postures: ${never} of ${pairCount} pairs never touch.`),
      h("table", { class: "pairs" }, h("thead", {}, h("tr", {}, ...heads)), h("tbody", {}, ...rows)),
      ...(left > 0 ? [h("p", {}, `${left} more are not listed: filter them.`)] : []),
    );
  }

  /** A filtered pair of the asset, which can be taken away; what joints and groups filter cannot. */
  private isOwn(pair: FoundPair): boolean {
    return pair.filters.some((one) => one.property === "physics:filteredPairs");
  }

  private row(pair: FoundPair): HTMLElement {
    const { viewer } = this.session.panel;
    const names = `${nameOf(pair.bodyA)} and ${nameOf(pair.bodyB)}`;
    const kept = pair.filtered === "yes";
    const byOthers = kept && !this.isOwn(pair);
    const box: HTMLInputElement = h("input", {
      type: "checkbox",
      checked: this.ticks.get(pair) ?? kept,
      disabled: byOthers,
      "aria-label": `Keep ${names} apart`,
      onchange: () => {
        box.checked === kept ? this.ticks.delete(pair) : this.ticks.set(pair, box.checked);
        this.save.disabled = this.ticks.size === 0;
      },
    });
    const show = () => {
      viewer.select(pair.bodyA);
      viewer.selectAlso(pair.bodyB);
      this.session.panel.openTab("Pairs");
    };
    const share = pair.share === null || pair.class === "never" ? "" : ` ${figure(pair.share * 100, 3)} %`;
    const notes = [
      pair.adjacent ? "adjacent" : "",
      ...(pair.filtered === "no" ? [] : new Set(pair.filters.map(reasonOf))),
      pair.overFiltered ? "over-filtered" : "",
    ].filter(Boolean);
    return h(
      "tr",
      {},
      h("td", {}, box),
      h("td", {}, h("button", { type: "button", class: "link", title: `${pair.bodyA}\n${pair.bodyB}`, "aria-label": `Select ${names}`, onclick: show },
        nameOf(pair.bodyA), h("br"), nameOf(pair.bodyB))),
      h("td", {}, `${pair.class ?? (pair.startDepth === null ? "not at the start" : "at the start")}${share}`,
        ...notes.map((note) => h("div", {}, h("small", {}, note)))),
      h("td", { class: "number" }, millimetres(pair.depth),
        pair.startDepth === null ? null : h("div", {}, h("small", {}, `${millimetres(pair.startDepth)} at the start`))),
    );
  }

  private tickAlways(): void {
    for (const pair of this.found?.pairs ?? []) {
      if (pair.class === "always" && pair.filtered !== "yes") {
        this.ticks.set(pair, true);
      }
    }
    this.update();
  }

  private async write(): Promise<void> {
    if (this.ticks.size > mostChanges) {
      this.session.messages.complain(`At most ${mostChanges} pairs are saved at once; here are ${this.ticks.size}.`);
      return;
    }
    const rows = (wanted: boolean) =>
      [...this.ticks].filter(([, on]) => on === wanted).map(([{ bodyA, bodyB }]) => ({ bodyA, bodyB }));
    await review(this.session, "filterPairs", { filter: rows(true), unfilter: rows(false) });
  }
}
