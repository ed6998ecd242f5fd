// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The poses that the asset keeps: joints go there, where they are now is kept under a name, and files
// of poses are written and read.
import { h } from "../panel/dom";
import { restWhileClosed, whenOpen, writer } from "./pages";
import type { NamedPose } from "./protocol";
import { review } from "./review";
import { download } from "./save";
import { type Session, attempt } from "./session";

const longestFile = 30_000; // characters: what a request holds

export class Poses {
  private readonly list = h("ul", { class: "poses" });
  private readonly hold = h("input", { type: "checkbox", checked: true });
  private readonly name: HTMLInputElement;
  private file = "";
  private readOnly = false;

  constructor(private readonly session: Session) {
    this.name = h("input", { type: "text", "aria-label": "Name of the pose", placeholder: "Name", spellcheck: "false" });
    const save = writer(session, "Save where joints are now...", () => void this.save());
    const load = writer(session, "Import...", () => picker.click());
    const picker: HTMLInputElement = h("input", {
      type: "file",
      accept: ".json",
      hidden: true,
      "aria-label": "File of poses",
      onchange: () => void this.load(picker),
    });
    const page = session.panel.addTab(
      "Poses",
      h("label", {}, this.hold, " drives hold the pose"),
      this.list,
      h("div", { class: "choices" }, this.name, save),
      h("div", { class: "buttons" }, h("button", { type: "button", onclick: () => this.write() }, "Export"), load, picker),
    );
    session.connection.on("hello", (notice) => (this.readOnly = notice.readOnly));
    restWhileClosed(session, page);
    whenOpen(session, "Poses", () => void this.ask());
  }

  private async ask(): Promise<void> {
    const answer = await attempt(this.session, "poses");
    if (answer) {
      this.file = answer.file;
      const none = h("li", {}, "The asset keeps no poses yet.");
      this.list.replaceChildren(...(answer.poses.length > 0 ? answer.poses.map((pose) => this.item(pose)) : [none]));
    }
  }

  private item(pose: NamedPose): HTMLElement {
    const button = (text: string, act: () => void) =>
      h("button", { type: "button", "aria-label": `${text} ${pose.name}`, onclick: act }, text);
    const go = button("Go to", () => void attempt(this.session, "goToPose", { pose: pose.path, hold: this.hold.checked }));
    const edits = [
      button("Rename", () => void this.rename(pose)),
      button("Remove", () => void review(this.session, "removePose", { pose: pose.path })),
    ];
    const missing = pose.joints.filter((one) => one.problem === "missing").length;
    const outside = pose.joints.filter((one) => one.problem === "outside").length;
    const notes = [
      `${pose.joints.length} joints`,
      missing > 0 ? `${missing} of them are not there` : "",
      outside > 0 ? `${outside} beyond their limits` : "",
      pose.valid ? "" : "marked as not valid",
    ].filter(Boolean);
    return h("li", { "data-pose": pose.path },
      h("strong", {}, pose.name), " ", h("small", {}, notes.join(", ")),
      h("div", { class: "buttons" }, go, ...(this.readOnly ? [] : edits)));
  }

  /** Takes the name from the field. */
  private async rename(pose: NamedPose): Promise<void> {
    const name = this.name.value.trim();
    if (!name) {
      this.session.messages.complain("Write the new name into the field below first.");
      this.name.focus();
      return;
    }
    await review(this.session, "renamePose", { pose: pose.path, name });
  }

  private async save(): Promise<void> {
    const name = this.name.value.trim();
    if (!name) {
      this.session.messages.complain("Write a name for the pose first.");
      this.name.focus();
      return;
    }
    await review(this.session, "savePose", { name });
  }

  private write(): void {
    download(new Blob([this.file], { type: "application/json" }), "poses.json");
  }

  private async load(picker: HTMLInputElement): Promise<void> {
    const text = (await picker.files?.[0]?.text()) ?? "";
    picker.value = "";
    if (text.length > longestFile) {
      this.session.messages.complain("The file is too long for this page: `tenon pose --import` reads it.");
    } else if (text) {
      await review(this.session, "importPoses", { text });
    }
  }
}
