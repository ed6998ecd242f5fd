// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Where one looks from: along the asset's axes, without perspective, and beside a body.
import { type Side, sides } from "../scene/eye";
import type { Viewer } from "../scene/viewer";
import { nameOf } from "./dom";
import type { Shortcut } from "./keys";
import { command, menu, toggle } from "./menu";

export class CameraMenu {
  readonly element: HTMLElement;
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
    );
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

  private setFollowing(on: boolean): void {
    const { viewer } = this;
    const body = viewer.info.bodies.find((one) => one.path === viewer.selected);
    viewer.follow(on && body ? body.path : "");
  }

  private update(): void {
    const { eye, followed, info, selected } = this.viewer;
    this.flat.box.checked = eye.orthographic;
    this.follow.box.checked = followed !== "";
    this.follow.box.disabled = followed === "" && !info.bodies.some((one) => one.path === selected);
    this.follow.element.title = followed ? `The camera follows ${nameOf(followed)}` : "";
  }
}
