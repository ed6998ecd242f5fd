// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What the page writes into files of the browser: a picture, a film of what was simulated, and the
// signals that are plotted. Nothing goes anywhere else.
import { h } from "../panel/dom";
import { command, menu } from "../panel/menu";
import type { History } from "./history";
import type { Plots } from "./plots";
import type { Session } from "./session";
import { asCsv } from "./signals";
import type { Timeline } from "./timeline";

const framesPerSecond = 30;
const lastFrame = 500; // ms that the last picture stays

export function download(data: Blob, name: string): void {
  const link = h("a", { href: URL.createObjectURL(data), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
}

export class Save {
  private recorder: MediaRecorder | null = null;

  constructor(
    private readonly session: Session,
    private readonly history: History,
    private readonly plots: Plots,
    private readonly timeline: Timeline,
  ) {
    session.panel.tools.prepend(
      menu(
        "Save",
        command("The picture (PNG)", "", () => this.picture()),
        command("A film of what was simulated (WebM)", "", () => this.film()),
        command("The plotted signals (CSV)", "", () => this.signals()),
      ),
    );
  }

  /** The name of the asset without its ending. */
  private get name(): string {
    return document.title.replace(/ - tenon$/, "").replace(/\.\w+$/, "") || "tenon";
  }

  private picture(): void {
    const { viewer } = this.session.panel;
    viewer.draw();
    viewer.renderer.domElement.toBlob((data) => data && download(data, `${this.name}.png`));
  }

  private signals(): void {
    const text = asCsv(this.plots.shown(), this.history);
    download(new Blob([text], { type: "text/csv" }), `${this.name}.csv`);
  }

  private film(): void {
    const { messages, panel } = this.session;
    if (typeof MediaRecorder === "undefined") {
      messages.complain("This browser records no films; `tenon record` does.");
      return;
    }
    if (this.recorder || this.history.frames.length < 2) {
      messages.complain(this.recorder ? "A film is being recorded." : "Nothing was simulated yet: play first.");
      return;
    }
    const stream = panel.viewer.renderer.domElement.captureStream(framesPerSecond);
    const recorder = new MediaRecorder(stream);
    const parts: Blob[] = [];
    recorder.ondataavailable = ({ data }) => parts.push(data);
    recorder.onstop = () => {
      this.recorder = null;
      stream.getTracks().forEach((track) => track.stop());
      download(new Blob(parts, { type: recorder.mimeType }), `${this.name}.${recorder.mimeType.includes("mp4") ? "mp4" : "webm"}`);
      messages.say("The film is done.");
    };
    this.recorder = recorder;
    this.timeline.once();
    this.timeline.seek(this.history.first);
    const look = () => {
      this.timeline.replaying ? requestAnimationFrame(look) : setTimeout(() => recorder.stop(), lastFrame);
    };
    recorder.onstart = () => {
      this.timeline.toggle();
      look();
    };
    recorder.start();
    messages.say("The film is recorded while it is replayed.");
  }
}
