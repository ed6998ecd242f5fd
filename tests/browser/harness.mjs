// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What the tests in a browser stand on: one Chromium that draws by software, programs `tenon view`
// that they start, and pages that are watched. A page that writes to its console, throws, or asks
// another machine for anything has a fault, which the test it belongs to ends with.
import { spawn, spawnSync } from "node:child_process";
import { cpSync, existsSync, mkdtempSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { pathToFileURL } from "node:url";

export const patience = 60_000; // ms until something that has to come is missed
export const size = { width: 1280, height: 800 };

const flags = [
  "--headless=new",
  "--no-sandbox",
  "--use-angle=swiftshader",
  "--enable-unsafe-swiftshader",
  "--enable-precise-memory-info",
  "--js-flags=--expose-gc",
];

export class Fault extends Error {}

/** Holds what has to be true. */
export function hold(condition, text) {
  if (!condition) {
    throw new Fault(text);
  }
}

export function near(found, wanted, tolerance, what) {
  hold(
    Math.abs(found - wanted) <= tolerance,
    `${what}: ${found}, expected ${wanted} within ${tolerance}`,
  );
}

/** A stage whose "World" has a physics scene and `body`. */
export const sceneOf = (body) => `#usda 1.0
(
    defaultPrim = "World"
    metersPerUnit = 1
    kilogramsPerUnit = 1
    upAxis = "Z"
)
def Xform "World"
{
    def PhysicsScene "Scene"
    {
    }
${body}
}
`;

export const sleep = (milliseconds) => new Promise((go) => setTimeout(go, milliseconds));

/** Asks until the answer is true, and gives it. */
export async function until(ask, what, milliseconds = patience) {
  const end = Date.now() + milliseconds;
  for (;;) {
    const answer = await ask();
    if (answer) {
      return answer;
    }
    hold(Date.now() < end, `it did not come: ${what}`);
    await sleep(30);
  }
}

/** A running `tenon view`. */
export class Viewer {
  constructor(program, asset, options = []) {
    this.process = spawn(program, ["view", "--json", asset, ...options], {
      cwd: dirname(asset), // so that the page names files in few words
      stdio: ["ignore", "pipe", "pipe"],
    });
    this.said = "";
    this.complained = "";
    this.process.stdout.on("data", (data) => (this.said += data));
    this.process.stderr.on("data", (data) => (this.complained += data));
    this.ended = new Promise((go) => this.process.on("exit", go));
  }

  async address() {
    await until(
      () => this.said.endsWith("\n}\n") || this.process.exitCode !== null,
      "the address of tenon view",
    );
    hold(this.said.endsWith("\n}\n"), `tenon view has ended: ${this.complained}`);
    this.url = JSON.parse(this.said).url;
    hold(this.url, `tenon view refuses: ${this.said}`);
    return this;
  }

  async stop(signal = "SIGINT") {
    this.stopped = true;
    if (this.process.exitCode === null && this.process.signalCode === null) {
      this.process.kill(signal);
      await this.ended;
    }
  }
}

/** What one test has: pages, programs and folders, all of which end with it. */
export class Stage {
  constructor(world, name) {
    Object.assign(this, world);
    this.name = name;
    this.ending = [];
    this.faults = [];
  }

  path(...parts) {
    return join(this.root, ...parts);
  }

  folder() {
    const made = mkdtempSync(join(tmpdir(), "tenon-browser-"));
    this.ending.push(() => rmSync(made, { recursive: true, force: true }));
    return made;
  }

  /** A copy of the example hand, that may be edited; -> its file. */
  hand(file = "inspire_hand.usda") {
    const to = join(this.folder(), "hand");
    cpSync(this.path("examples/inspire_hand"), to, { recursive: true });
    return join(to, file);
  }

  /** Runs the program; -> what it says as JSON where `--json` is among the words. */
  tenon(words, { fails = false } = {}) {
    const done = spawnSync(this.program, words, { encoding: "utf8", maxBuffer: 1 << 28 });
    hold(fails || done.status === 0, `tenon ${words.join(" ")}: ${done.stderr}`);
    return words.includes("--json") ? JSON.parse(done.stdout) : done;
  }

  async view(asset, ...options) {
    const viewer = new Viewer(this.program, asset, options);
    this.ending.push(async () => {
      const { exitCode, signalCode } = viewer.process;
      if (!viewer.stopped && (exitCode !== null || signalCode !== null)) {
        this.faults.push(`tenon view has ended (${exitCode ?? signalCode}): ${viewer.complained}`);
      }
      await viewer.stop();
    });
    return viewer.address();
  }

  report(asset, ...options) {
    const file = join(this.folder(), "report.html");
    this.tenon(["report", asset, "-o", file, ...options]);
    return file;
  }

  /**
   * An empty page in a window of its own. `quiet: false` allows it to complain, `tour: true` is a
   * browser that has never seen the page.
   */
  async page({ theme = "light", quiet = true, tour = false, ...more } = {}) {
    const context = await this.browser.newContext({
      viewport: size,
      colorScheme: theme,
      reducedMotion: "reduce",
      ...more,
    });
    this.ending.push(() => context.close());
    context.setDefaultTimeout(patience);
    if (!tour) {
      await context.addInitScript(() => {
        try {
          localStorage.setItem("tenon-tour", "dismissed");
        } catch {
          // about:blank and files have no storage
        }
      });
    }
    const page = await context.newPage();
    page.on("console", (message) => quiet && this.faults.push(`console: ${message.text()}`));
    page.on("pageerror", (error) => this.faults.push(`error: ${error.message}`));
    page.on("request", (request) => this.checkRequest(request.url()));
    return page;
  }

  checkRequest(url) {
    const allowed = /^(?:data|blob|file):|^(?:http|ws):\/\/127\.0\.0\.1[:/]/.test(url);
    if (!allowed) {
      this.faults.push(`asked for ${url}`);
    }
  }

  /** A page of a running viewer, when its first picture is drawn. */
  async live(viewer, options) {
    const page = await this.page(options);
    await page.goto(viewer.url);
    await drawn(page);
    return page;
  }

  /** A report that is opened from its file. */
  async opened(file, options) {
    const page = await this.page(options);
    await page.goto(pathToFileURL(file).href);
    await drawn(page);
    return page;
  }

  async end() {
    for (const act of this.ending.reverse()) {
      await act();
    }
    hold(this.faults.length === 0, [...new Set(this.faults)].slice(0, 5).join("\n"));
  }
}

/** Waits until the page shows a scene. */
export async function drawn(page) {
  await page.waitForFunction(() => window.tenonPage?.viewer.shown > 0, null, { timeout: patience });
  await settled(page);
}

/** Waits until what has been asked for is drawn. */
export async function settled(page) {
  await page.evaluate(async () => {
    const next = () => new Promise((go) => requestAnimationFrame(go));
    await next();
    await next();
  });
}

/** What the session last told, and how many frames came, kept in the page. */
export async function listen(page) {
  await page.evaluate(() => {
    const heard = { frames: 0, notices: {} };
    const connection = window.tenonPage.session.connection;
    connection.addEventListener("frame", () => (heard.frames += 1));
    for (const name of ["scene", "state", "plots", "contacts", "open", "closed", "problem"]) {
      heard.notices[name] = 0;
      connection.addEventListener(name, (event) => {
        heard.notices[name] += 1;
        heard[name] = event.detail;
      });
    }
    window.heard = heard;
  });
}

/** The result of a request of the page. */
export const ask = (page, name, fields = {}) =>
  page.evaluate(([n, f]) => window.tenonPage.session.connection.ask(n, f), [name, fields]);

export const openTab = (page, name) => page.getByRole("tab", { name }).click();

export const button = (page, name) => page.getByRole("button", { name, exact: true });

export async function startBrowser(packages) {
  const program = ["/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"].find(
    existsSync,
  );
  hold(program, "there is no Chromium: apt-get install chromium");
  const { chromium } = createRequire(join(packages, "package.json"))("playwright-core");
  return chromium.launch({ executablePath: program, args: flags, headless: true });
}

export const axeSource = (packages) =>
  createRequire(join(packages, "package.json"))("axe-core").source;
