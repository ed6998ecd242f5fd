// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Where one looks from: along the asset's axes, without perspective, beside a body, and through the
// asset's own cameras.
import { type Side, sides } from "../scene/eye";
import type { Viewer } from "../scene/viewer";
import { h, nameOf } from "./dom";
import type { Shortcut } from "./keys";
import { command, menu, toggle } from "./menu";

export class CameraMenu {
  readonly element: HTMLElement;
  /** Said over the picture. */
  readonly note = h("p", { class: "camera-note", role: "status", hidden: true });
  /** The asset's cameras. */
  private readonly own = h("div", { class: "menu-part", role: "group", "aria-label": "Cameras of the asset" });
  private readonly flat = toggle("Orthographic", "0", (on) => this.viewer.setOrthographic(on));
  private readonly follow = toggle("Follow the selected body", "n", (on) => this.setFollowing(on));

  constructor(private readonly viewer: Viewer) {
    const from = (side: Side, at: number) => command(`From ${side}`, String(at + 1), () => viewer.lookFrom(side));
    this.element = menu(
      "Camera",
      command("Look at everything", "a", () => viewer.frame()),
      command("Look at the selection", "f", () => viewer.frame(viewer.selected)),
      ...(Object.keys(sides) as Side[]).map(from),
      this.flat.element,
      this.follow.element,
      this.own,
    );
    viewer.addEventListener("load", () => this.list());
    viewer.addEventListener("camera", () => this.update());
    viewer.addEventListener("select", () => this.update());
    this.update();
  }

  shortcuts(): Shortcut[] {
    const { viewer } = this;
    return [
      ...(Object.keys(sides) as Side[]).map((side, at) => ({
        key: String(at + 1),
        label: `Look from ${side} of the asset's axes`,
        act: () => viewer.lookFrom(side),
      })),
      {
        key: "0",
        label: "Orthographic or with perspective",
        act: () => viewer.setOrthographic(!viewer.eye.orthographic),
      },
      { key: "n", label: "Follow the selected body, or stay", act: () => this.setFollowing(!viewer.followed) },
    ];
  }

  private list(): void {
    const { cameras } = this.viewer.info;
    const rows = cameras.map((camera) => {
      const alike = cameras.filter(({ path }) => nameOf(path) === nameOf(camera.path));
      const row = command(alike.length > 1 ? camera.path : nameOf(camera.path), "", () =>
        this.viewer.lookThrough(camera),
      );
      row.title = camera.path;
      return row;
    });
    this.own.hidden = rows.length === 0;
    this.own.replaceChildren(h("strong", {}, "Cameras of the asset"), ...rows);
    this.update();
  }

  private setFollowing(on: boolean): void {
    const { viewer } = this;
    const body = viewer.info.bodies.find((one) => one.path === viewer.selected);
    viewer.follow(on && body ? body.path : "");
  }

  private update(): void {
    const { eye, followed, info, selected } = this.viewer;
    this.flat.box.checked = eye.orthographic;
    const { through } = eye;
    for (const row of this.own.querySelectorAll("button")) {
      row.setAttribute("aria-pressed", String(row.title === through?.path));
    }
    this.note.hidden = !through;
    const leave = h("button", { type: "button", onclick: () => this.viewer.lookThrough(null) }, "Leave it");
    this.note.replaceChildren(...(through ? [`Seen through ${nameOf(through.path)} `, leave] : []));
    this.follow.box.checked = followed !== "";
    this.follow.box.disabled = followed === "" && !info.bodies.some((one) => one.path === selected);
    this.follow.element.title = followed ? `The camera follows ${nameOf(followed)}` : "";
  }
}
