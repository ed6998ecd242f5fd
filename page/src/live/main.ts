// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The page of `tenon view`: the panel of every page, with what a live session adds. The picture is
// fetched again when its number changes; camera and selection stay. What programs that drive the
// page may ask is in `window.tenonPage`.
import { nameOf } from "../panel/dom";
import { Panel } from "../panel/panel";
import { Viewer } from "../scene/viewer";
import { Address } from "./address";
import { Connection } from "./connection";
import { Details } from "./details";
import { Drives } from "./drives";
import { EventList } from "./event_list";
import { Events } from "./events";
import { Findings } from "./findings";
import { Gains } from "./gains";
import { History } from "./history";
import { Identify } from "./identify";
import { Messages } from "./messages";
import { Move } from "./move";
import { Pairs } from "./pairs";
import { Plots } from "./plots";
import { Poses } from "./poses";
import { Prims } from "./prims";
import { Pull } from "./pull";
import { Save } from "./save";
import { type Session, attempt } from "./session";
import { Signals } from "./signals";
import { Standing } from "./standing";
import { Timeline } from "./timeline";
import { Tools } from "./tools";
import { Tour } from "./tour";
import { Values } from "./values";

class Picture {
  private revision = 0;
  private wanted = 0;
  private loading = false;

  constructor(
    private readonly session: Session,
    private readonly history: History,
  ) {
    history.addEventListener("frame", () => history.shown === null && this.pose());
    history.addEventListener("shown", () => this.pose());
  }

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
    this.pose();
  }

  /** Places bodies, and draws contacts, as at the moment that is shown. */
  private pose(): void {
    const { viewer } = this.session.panel;
    const { frame, sample, shown } = this.history;
    if (!this.loading && frame?.length === 1 + 7 * viewer.bodies.length) {
      viewer.setPoses(frame);
    }
    if (shown !== null) {
      viewer.overlays.setContacts(sample?.contacts ?? new Float32Array());
    }
  }
}

/** What was simulated, and all that shows it. */
function addTime(session: Session): History {
  const history = new History();
  const events = new Events();
  const timeline = new Timeline(session, history, events);
  const plots = new Plots(session, history, timeline);
  new EventList(session, events, timeline);
  const values = new Values(session, history);
  new Save(session, history, plots, timeline);
  new Address(session, history, plots);
  const { connection, panel } = session;
  let known = "";
  connection.on("scene", (scene) => {
    // A page that has only lost its connection keeps what it knows.
    const now = JSON.stringify([scene.revision, scene.engine, scene.bodies.length, scene.joints.length]);
    if (scene.why !== "open" || now !== known) {
      history.begin(scene);
      events.begin(scene);
      const signals = new Signals(scene, history.layout);
      plots.begin(signals);
      values.begin(signals);
    }
    known = now;
  });
  connection.on("frame", (frame) => history.addFrame(frame));
  connection.on("plots", (notice) => {
    history.addPlots(notice);
    events.hearPlots(notice);
  });
  connection.on("contacts", (notice) => {
    history.addContacts(notice);
    events.hearContacts(notice);
    if (history.shown === null) {
      panel.viewer.overlays.setContacts(history.sample?.contacts ?? new Float32Array());
    }
  });
  connection.on("state", (state) => events.hearState(state));
  return history;
}

function main(): void {
  document.querySelector(".starting")?.remove();
  const panel = new Panel(document.body, (place) => new Viewer(place));
  const address = new URL("ws", location.href);
  address.protocol = location.protocol.replace("http", "ws");
  new Tour(panel);
  const session: Session = { panel, connection: new Connection(address.href), messages: new Messages() };
  const { connection, messages } = session;
  const history = addTime(session);
  const picture = new Picture(session, history);
  new Tools(session);
  panel.foot.append(messages.element);
  new Move(session);
  new Findings(session);
  new Pairs(session);
  new Drives(session);
  new Gains(session);
  new Poses(session);
  new Identify(session);
  new Details(session);
  new Pull(session);
  new Prims(session);
  new Standing(session);
  panel.layers.offer("contacts");
  panel.openTab("Move");
  panel.viewer.addEventListener("select", () => panel.viewer.selected && panel.openTab("Selection"));
  connection.on("hello", (notice) => panel.setTitle(nameOf(notice.asset)));
  connection.on("scene", (scene) => {
    picture.want(scene.revision).catch((fault: unknown) => messages.complain(fault));
    if (scene.why === "file") {
      messages.say("A file has changed: opened again.");
    }
    const wrong = [...scene.opening, scene.problem].find((one) => one?.severity === "error");
    if (wrong && scene.why !== "reset" && scene.why !== "engine") {
      messages.complain(wrong);
    }
  });
  connection.on("problem", (notice) => messages.complain(notice.problem));
  connection.on("closed", () =>
    messages.complain(
      "tenon view does not answer; it is tried again. One that was started anew has another address.",
    ),
  );
  connection.on("open", () => {
    messages.element.replaceChildren();
    void attempt(session, "observe", { contacts: true, plots: true });
  });
  Object.assign(window, { tenonPage: { panel, viewer: panel.viewer, session, history } });
}

main();
