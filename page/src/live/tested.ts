// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What came of a test of drives: verdict and numbers of each, and a chart of its command and response.
import { figure, h, nameOf } from "../panel/dom";
import { Chart } from "./chart";
import { Queue, type Sample, type Samples } from "./history";
import type { TestSignal, Tested } from "./protocol";
import type { Session } from "./session";
import type { Signal } from "./signals";

const degrees = 180 / Math.PI;

/** Numbers of a result in a line. */
export function numbersOf({ axis, limits, step, sine, saturation }: Tested): string {
  const turns = axis.startsWith("rot");
  const [unit, factor] = turns ? ["deg", degrees] : ["mm", 1000];
  const part = (value: number | null | undefined) => (value == null ? "-" : `${figure(value * 100, 3)} %`);
  const time = (value: number | null | undefined) => (value == null ? "-" : `${figure(value, 3)} s`);
  const place = (value: number | null | undefined) => (value == null ? "-" : `${figure(value * factor, 3)} ${unit}`);
  const parts = [
    ...(limits ?? []).map((one) => `to ${place(one.target)}: settles in ${time(one.settlingTime)}, holds within ${place(one.maxHoldError)}`),
    step ? `overshoot ${part(step.overshoot)}, rise ${time(step.riseTime)}, settles in ${time(step.settlingTime)}` : "",
    sine ? `lag ${time(sine.lag)}, gain ${figure(sine.gain, 3)}, error ${place(sine.positionError)}` : "",
    saturation ? `at its most effort ${part(saturation)} of the time` : "",
  ];
  return parts.filter(Boolean).join("; ");
}

/** Command and response as samples over time. */
class Trace implements Samples {
  readonly samples = new Queue<Sample>();
  readonly shown = null;

  constructor({ time, command, position }: TestSignal) {
    time.forEach((moment, i) =>
      this.samples.push({
        time: moment,
        values: Float32Array.of(command[i] ?? NaN, position[i] ?? NaN),
        contacts: new Float32Array(),
      }),
    );
  }

  get sample(): Sample | null {
    return this.samples.last ?? null;
  }

  frameAt(): null {
    return null;
  }
}

function chartOf({ joint, axis, signal }: Tested): HTMLElement | null {
  if (!signal || signal.time.length === 0) {
    return null;
  }
  const turns = axis.startsWith("rot");
  const [unit, factor] = turns ? ["deg", degrees] : ["mm", 1000];
  const lines: Signal[] = ["command", "response"].map((label, k) => ({
    column: `${joint}.${label}`,
    subject: joint,
    quantity: label,
    label,
    unit,
    of: ({ values }) => (values[k] ?? NaN) * factor,
  }));
  const chart = new Chart(`${nameOf(joint)} ${axis}`, lines, new Trace(signal), {});
  chart.window = 0;
  chart.drawSoon();
  return chart.element;
}

export class TestedDrives {
  readonly element = h("div", { "aria-live": "polite" });
  private readonly known = new Set<string>();

  constructor(session: Session) {
    session.connection.on("tested", ({ result }) => this.add(result));
  }

  clear(): void {
    this.known.clear();
    this.element.replaceChildren();
  }

  /** Results that were not told while the test went on: drives that cannot be tested. */
  finish(results: Tested[]): void {
    results.filter((one) => !this.known.has(`${one.joint} ${one.axis}`)).forEach((one) => this.add(one));
  }

  private add(result: Tested): void {
    this.known.add(`${result.joint} ${result.axis}`);
    this.element.append(
      h(
        "section",
        { class: `tested ${result.verdict}`, "data-joint": result.joint },
        h("p", {}, h("strong", {}, result.verdict), ` ${nameOf(result.joint)} ${result.axis}: ${numbersOf(result)}`),
        ...result.reasons.map((reason) => h("p", {}, `${reason}.`)),
        chartOf(result),
      ),
    );
  }
}
