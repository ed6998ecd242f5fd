// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What the page shows, in the part of its address behind #: selection, tab, camera, moment, what is
// laid over the picture, hidden parts, plotted signals. A link with it opens the same view. The token
// of the server stands before # and is no part of it.
import * as THREE from "three";
import type { History } from "./history";
import type { Plots } from "./plots";
import { type Session, attempt } from "./session";

const longest = 4000; // characters that are read
const mostPrims = 100;
const mostSteps = 20_000; // that an address may ask for
const stepsAtOnce = 50; // so that what comes between is kept
const digits = (x: number) => Number(x.toPrecision(6));

/** Fields of the part behind #. */
export function readHash(hash: string): Map<string, string> {
  const text = hash.replace(/^#/, "").slice(0, longest);
  return new Map([...new URLSearchParams(text)].filter(([, value]) => value !== ""));
}

function momentOf(fields: Map<string, string>): number | null {
  const time = Number(fields.get("time") ?? NaN);
  return Number.isFinite(time) && time > 0 ? time : null;
}

const listOf = (text: string | undefined): string[] => (text ? text.split(",").slice(0, mostPrims) : []);

export class Address {
  private timer = 0;
  private begun = false;
  private readonly wanted = readHash(location.hash);
  /** The moment that the address names, until it is known whether it can be shown [s]. */
  private moment: number | null = momentOf(this.wanted);
  private timeStep: number | null = null;
  private playing = false;

  constructor(
    private readonly session: Session,
    private readonly history: History,
    private readonly plots: Plots,
  ) {
    const { viewer } = session.panel;
    viewer.addEventListener("load", () => this.begin());
    for (const event of ["select", "camera", "visibility"]) {
      viewer.addEventListener(event, () => this.writeSoon());
    }
    history.addEventListener("shown", () => this.writeSoon());
    for (const event of ["tenon-tab", "tenon-signals"]) {
      document.body.addEventListener(event, () => this.writeSoon());
    }
    session.panel.layers.onChange = () => this.writeSoon();
    const { connection } = session;
    connection.on("scene", (scene) => (this.timeStep = scene.timeStep));
    connection.on("state", (state) => {
      this.playing = state.playing;
      void this.reach(state.time);
      state.playing || this.writeSoon();
    });
    window.addEventListener("hashchange", () => this.apply(readHash(location.hash)));
  }

  /** With the first picture, the view that the address names. */
  private begin(): void {
    if (!this.begun) {
      this.begun = true;
      this.apply(this.wanted);
    }
  }

  private apply(fields: Map<string, string>): void {
    const { panel } = this.session;
    const { viewer } = panel;
    const numbers = listOf(fields.get("camera")).map(Number);
    listOf(fields.get("prim"))
      .reverse()
      .forEach((path, i) => (i === 0 ? viewer.select(path) : viewer.selectAlso(path)));
    for (const name of listOf(fields.get("show"))) {
      panel.layers.set(name, true);
    }
    for (const name of listOf(fields.get("hide"))) {
      panel.layers.set(name, false);
    }
    viewer.change(() => {
      const { visibility } = viewer;
      visibility.reset();
      listOf(fields.get("hidden")).forEach((path) => visibility.hidden.add(path));
      listOf(fields.get("alone")).forEach((path) => visibility.alone.add(path));
      listOf(fields.get("clear")).forEach((path) => visibility.clear.add(path));
      visibility.apply();
    });
    if (numbers.length === 6 && numbers.every(Number.isFinite)) {
      viewer.lookAs(new THREE.Vector3(...numbers.slice(0, 3)), new THREE.Vector3(...numbers.slice(3)));
    }
    viewer.setOrthographic(fields.get("projection") === "orthographic");
    const through = viewer.info.cameras.find((one) => one.path === fields.get("through"));
    through && viewer.lookThrough(through);
    if (fields.has("plots")) {
      this.plots.choose(listOf(fields.get("plots")));
    }
    const time = momentOf(fields);
    if (time !== null && this.history.frames.length > 1) {
      this.history.show(time);
    }
    if (fields.has("tab")) {
      panel.openTab(fields.get("tab")!);
    }
  }

  /** Simulates to the moment that the address names, where the simulation stands at its start. */
  private async reach(now: number): Promise<void> {
    const { moment, timeStep } = this;
    this.moment = null;
    if (moment === null || timeStep === null || Math.abs(now - moment) <= timeStep) {
      return;
    }
    const steps = Math.round((moment - now) / timeStep);
    if (now > 0 || this.playing || steps > mostSteps) {
      this.session.messages.say(`This page does not know the moment ${moment} s that its address names.`);
      return;
    }
    for (let left = steps; left > 0; left -= stepsAtOnce) {
      if ((await attempt(this.session, "step", { count: Math.min(left, stepsAtOnce) })) === null) {
        return;
      }
    }
    this.session.messages.say(`Simulated to ${moment} s, as the address says.`);
  }

  /** A while after the last change, so that turning the camera costs nothing. */
  private writeSoon(): void {
    if (this.begun) {
      window.clearTimeout(this.timer);
      this.timer = window.setTimeout(() => this.write(), 250);
    }
  }

  private write(): void {
    const { panel } = this.session;
    const { camera, controls, eye, visibility } = panel.viewer;
    const fields = new URLSearchParams();
    const put = (name: string, list: Iterable<string | number>) => {
      const text = [...list].slice(0, mostPrims).join(",");
      text && fields.set(name, text);
    };
    const { more, less } = panel.layers.changed();
    put("prim", panel.viewer.selection());
    put("tab", [panel.tab]);
    put("camera", [...camera.position.toArray(), ...controls.target.toArray()].map(digits));
    put("projection", eye.orthographic ? ["orthographic"] : []);
    put("through", eye.through ? [eye.through.path] : []);
    const time = this.history.shown ?? (this.playing ? 0 : this.history.last);
    put("time", time > 0 ? [digits(time)] : []);
    put("show", more);
    put("hide", less);
    put("hidden", visibility.hidden);
    put("alone", visibility.alone);
    put("clear", visibility.clear);
    put("plots", this.plots.choice ?? []);
    const text = fields.toString().replaceAll("%2F", "/").replaceAll("%2C", ",").replaceAll("%3A", ":");
    window.history.replaceState(null, "", `#${text}`);
  }
}
