// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Numbers of the robot from its logs, in the six stages of `tenon identify`: the robot, logs, what is
// to be found, what the logs can tell, the fit, and what came of it. The fit rests until a check of
// the same choices has passed; the layer is shown before it is written.
import { type Child, figure, h, nameOf, table } from "../panel/dom";
import type { Fields } from "./connection";
import { restWhileClosed, whenOpen, writer } from "./pages";
import type { Identified, IdentifiedParameter, IdentifyCheck, LeftOver, Word } from "./protocol";
import { review } from "./review";
import { type Session, attempt } from "./session";
import { Task } from "./task";

type Wish = Omit<Fields<"identify">, "stage">;

/** friction:/arm/Physics/shoulder -> friction, shoulder. */
function shortName({ name, family }: IdentifiedParameter): string {
  return `${family} ${nameOf(name.slice(name.indexOf(":") + 1))}`;
}

const words = (text: string): Word[] | null => {
  const lines = text.split("\n").map((line) => line.trim()).filter((line) => line !== "");
  return lines.length > 0 ? lines.map((line) => ({ text: line })) : null;
};

const interval = (one: IdentifiedParameter): string =>
  one.low == null || one.high == null ? "-" : `${figure(one.low, 4)} to ${figure(one.high, 4)}`;

const paragraphs = (lines: string[] | undefined, kind = "weak"): HTMLElement[] =>
  (lines ?? []).map((line) => h("p", { class: kind }, line));

export class Identify {
  private readonly task: Task<"identify">;
  private readonly robot = h("p");
  private readonly logs = h("ul", { class: "poses" });
  private readonly told = h("div");
  private readonly result = h("div");
  private readonly names = this.lines("What logs call a joint", "NAME=JOINT, one a line");
  private readonly signs = this.lines("Joints counted the other way", "JOINT=-1, one a line");
  private readonly parameters = this.lines("Parameters", "friction\ngains:.*finger.*\nmass:tool=0..2");
  private readonly priors = this.lines("Priors", "armature:elbow=0.012,0.002");
  private readonly units: HTMLInputElement;
  private readonly training = this.number("Part that is fitted", 0.7, 0.05, 0.95);
  private readonly starts = this.number("Starts", 1, 1, 256);
  private readonly hold = h("input", { type: "checkbox" });
  private readonly force = h("input", { type: "checkbox", onchange: () => this.update() });
  private readonly solve: HTMLButtonElement;
  private readonly write: HTMLButtonElement;
  private heldOut = new Map<string, HTMLInputElement>();
  /** The choices that a check has passed, as text. */
  private checked = "";
  private found: Identified | null = null;
  private asset = "";

  constructor(private readonly session: Session) {
    this.task = new Task(session, "identify");
    this.units = h("input", { type: "text", placeholder: "rad, m", "aria-label": "Units of the logs", spellcheck: "false" });
    const check = this.button("Check", () => void this.check());
    const test = this.button("Test with known truth", () => void this.test());
    this.solve = this.button("Solve", () => void this.fit());
    this.write = writer(session, "Write the layer...", () => void review(session, "writeIdentified", { force: this.force.checked }));
    const page = session.panel.addTab(
      "Identify",
      this.stage("1 Robot", this.robot, h("div", { class: "buttons" }, test)),
      this.stage("2 Logs", this.logs, this.named("Units", this.units), this.names, this.signs),
      this.stage("3 Parameters", this.parameters, this.priors,
        h("label", {}, this.hold, " what the logs do not tell keeps the asset's number")),
      this.stage("4 Check", h("div", { class: "buttons" }, check), this.told),
      this.stage("5 Solve", this.named("Part of each log that is fitted", this.training), this.named("Starts", this.starts),
        h("div", { class: "buttons" }, this.solve), this.task.element),
      this.stage("6 Result", this.result,
        h("label", {}, this.force, " write also what predicts held-out motion no better"),
        h("div", { class: "buttons" }, this.write)),
    );
    page.addEventListener("input", () => this.update());
    session.connection.on("hello", ({ asset }) => (this.asset = asset));
    restWhileClosed(session, page);
    whenOpen(session, "Identify", () => void this.load());
    this.update();
  }

  private stage(title: string, ...parts: Child[]): HTMLElement {
    return h("section", { "aria-label": title }, h("h3", {}, title), ...parts);
  }

  private button(text: string, act: () => void): HTMLButtonElement {
    return h("button", { type: "button", onclick: act }, text);
  }

  private named(text: string, field: HTMLElement): HTMLElement {
    return h("label", {}, `${text} `, field);
  }

  private lines(label: string, placeholder: string): HTMLTextAreaElement {
    const stop = (event: KeyboardEvent) => event.stopPropagation(); // keys of the page rest
    return h("textarea", { rows: 2, "aria-label": label, placeholder: `${label}: ${placeholder}`, spellcheck: "false", onkeydown: stop });
  }

  private number(label: string, value: number, min: number, max: number): HTMLInputElement {
    return h("input", { type: "number", value, min, max, step: "any", "aria-label": label });
  }

  private async load(): Promise<void> {
    const answer = await attempt(this.session, "identifyLogs");
    if (!answer) {
      return;
    }
    this.robot.textContent = answer.whyNot ?? `${nameOf(this.asset)}; numbers go into ${nameOf(answer.layer)}, a layer over it.`;
    this.heldOut = new Map(answer.logs.map((log) => [log, h("input", { type: "checkbox" })]));
    const none = h("li", {}, "No log was given: start tenon view with --log FILE.");
    this.logs.replaceChildren(
      ...(answer.logs.length > 0
        ? [...this.heldOut].map(([log, box]) => h("li", {}, `${log} `, h("label", {}, box, " held out, to prove the result on")))
        : [none]),
      ...(answer.commands ? [h("li", {}, `Commands: ${answer.commands}`)] : []),
    );
  }

  private wish(): Wish {
    const logs = [...this.heldOut].map(([text, box]) => ({ text, out: box.checked }));
    const some = (out: boolean): Word[] | null => {
      const own = logs.filter((one) => one.out === out).map(({ text }) => ({ text }));
      return own.length > 0 ? own : null;
    };
    return {
      logs: some(false),
      heldOut: some(true),
      parameters: words(this.parameters.value),
      priors: words(this.priors.value),
      names: words(this.names.value),
      signs: words(this.signs.value),
      units: this.units.value.trim() || null,
      hold: this.hold.checked,
      training: Number(this.training.value),
      starts: Math.round(Number(this.starts.value)),
    };
  }

  private update(): void {
    this.solve.disabled = this.checked !== JSON.stringify(this.wish());
    const problems = this.found?.problems ?? [];
    this.write.disabled = !this.found?.parameters || (problems.length > 0 && !this.force.checked);
  }

  private async check(): Promise<void> {
    const wish = this.wish();
    const answer = await this.task.run({ stage: "check", ...wish });
    if (answer?.check) {
      this.showCheck(answer.check);
      const passes = answer.ok || (wish.hold && answer.check.parameters.some(({ told }) => told));
      this.checked = passes ? JSON.stringify(wish) : "";
    }
    this.update();
  }

  private showCheck({ parameters, refused }: IdentifyCheck): void {
    const rows = parameters.map((one) => [shortName(one), one.nominal, one.expectedError ?? null, one.unit, one.told ? "yes" : "no"]);
    this.told.replaceChildren(table(["Parameter", "Asset", "Expected error", "", "Told"], rows), ...paragraphs(refused));
  }

  private async fit(): Promise<void> {
    const answer = await this.task.run({ stage: "solve", ...this.wish() });
    if (answer) {
      this.found = answer;
      this.showResult(answer);
    }
    this.update();
  }

  private showResult({ parameters, heldOut, engines, problems }: Identified): void {
    const rows = (parameters ?? []).map((one) => [shortName(one), one.nominal, one.value ?? null, interval(one), one.unit]);
    const left = (heldOut ?? []).map((one: LeftOver) => [nameOf(one.joint), one.channel, one.before, one.after]);
    const replays = (engines ?? []).map((one) => [one.engine, one.before, one.after, one.why]);
    this.result.replaceChildren(
      table(["Parameter", "Asset", "Identified", "95 %", ""], rows),
      h("h4", {}, "Residuals on held-out motion"),
      table(["Joint", "Signal", "Before", "After"], left),
      table(["Engine", "Before", "After", ""], replays),
      ...paragraphs(problems),
    );
  }

  private async test(): Promise<void> {
    const { parameters, priors } = this.wish();
    const answer = await this.task.run({ stage: "selfTest", parameters, priors });
    const scores = answer?.scores;
    if (scores) {
      const rows = scores.map((one) => [shortName(one), one.truth ?? null, one.found ?? null, interval(one), one.passed ? "found" : "off"]);
      this.result.replaceChildren(
        h("p", {}, `${scores.filter(({ passed }) => passed).length} of ${scores.length} numbers of a log that was made here are found.`),
        table(["Parameter", "Truth", "Found", "95 %", ""], rows),
      );
    }
  }
}
