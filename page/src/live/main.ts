// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The page of `tenon view`: the panel of every page, with what a live session adds. The picture is
// fetched again when its number changes; camera and selection stay. What programs that drive the
// page may ask is in `window.tenonPage`.
import { nameOf } from "../panel/dom";
import { Panel } from "../panel/panel";
import { Viewer } from "../scene/viewer";
import { Connection, type ContactsNotice, type Finding, type HelloNotice, type SceneNotice } from "./connection";
import { Details } from "./details";
import { Findings } from "./findings";
import { Messages } from "./messages";
import { Move } from "./move";
import { Plots } from "./plots";
import { Prims } from "./prims";
import { Pull } from "./pull";
import { type Session, attempt } from "./session";
import { Standing } from "./standing";
import { Tools } from "./tools";

class Picture {
  private revision = 0;
  private wanted = 0;
  private loading = false;
  private frame: Float32Array | null = null;

  constructor(private readonly session: Session) {}

  /** Fetches the picture of this number, unless it is the one that is shown. */
  async want(revision: number): Promise<void> {
    this.wanted = revision;
    if (this.loading) {
      return;
    }
    this.loading = true;
    while (this.wanted !== this.revision) {
      const number = this.wanted;
      const answer = await fetch("scene.glb");
      if (!answer.ok) {
        throw new Error(`the server has no picture (${answer.status})`);
      }
      await this.session.panel.viewer.load(await answer.arrayBuffer(), this.revision > 0);
      this.revision = number;
    }
    this.loading = false;
    if (this.frame) {
      this.pose(this.frame);
    }
  }

  pose(frame: Float32Array): void {
    this.frame = frame;
    const viewer = this.session.panel.viewer;
    if (!this.loading && frame.length === 1 + 7 * viewer.bodies.length) {
      viewer.setPoses(frame);
    }
  }
}

function main(): void {
  const panel = new Panel(document.body, (place) => new Viewer(place));
  const address = new URL("ws", location.href);
  address.protocol = location.protocol.replace("http", "ws");
  const session: Session = { panel, connection: new Connection(address.href), messages: new Messages() };
  const picture = new Picture(session);
  const { connection, messages } = session;
  new Tools(session);
  panel.foot.append(messages.element);
  new Move(session);
  new Findings(session);
  new Plots(session);
  new Details(session);
  new Pull(session);
  new Prims(session);
  new Standing(session);
  panel.layers.offer("contacts");
  panel.openTab("Move");
  panel.viewer.addEventListener("select", () => panel.viewer.selected && panel.openTab("Selection"));
  connection.on<HelloNotice>("hello", (notice) => panel.setTitle(nameOf(notice.asset)));
  connection.on<SceneNotice>("scene", (scene) => {
    picture.want(scene.revision).catch((fault: unknown) => messages.complain(fault));
    if (scene.why === "file") {
      messages.say("A file has changed: opened again.");
    }
    const wrong = [...scene.opening, scene.problem].find((one) => one?.severity === "error");
    if (wrong && scene.why !== "reset" && scene.why !== "engine") {
      messages.complain(wrong);
    }
  });
  connection.on<Float32Array>("frame", (frame) => picture.pose(frame));
  connection.on<ContactsNotice>("contacts", (notice) => panel.viewer.overlays.setContacts(notice.rows));
  connection.on<{ problem: Finding }>("problem", (notice) => messages.complain(notice.problem));
  connection.on("closed", () =>
    messages.complain(
      "tenon view does not answer; it is tried again. One that was started anew has another address.",
    ),
  );
  connection.on("open", () => {
    messages.element.replaceChildren();
    void attempt(session, "observe", { contacts: true, plots: true });
  });
  Object.assign(window, { tenonPage: { panel, viewer: panel.viewer, session } });
}

main();
