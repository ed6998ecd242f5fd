# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""The program with and without an option, and what came of it."""

import json
import os
import pathlib
import shutil
import socket
import subprocess

import viewer
from option_row import Outcome

# What the runs of each verb are given where a row does not say otherwise.
STANDING = {
    "sim": (("--engine", "{engine}"), ("--duration", "0.1"), ("--json",)),
    "bench": (("--engine", "{engine}"), ("--envs", "2"), ("--threads", "1"),
              ("--duration", "0.1"), ("--json",)),
    "compare": (("--engines", "{engine},{other}"), ("--duration", "0.1"), ("--no-reasons",),
                ("--json",)),
    "bake": (("-o", "out.usda"), ("--engine", "{engine}"), ("--duration", "0.1"), ("--json",)),
    "view": (("--engine", "{engine}"), ("--json",)),
    "record": (("-o", "o.png"), ("--time", "0.1"), ("--engine", "{engine}"), ("--json",)),
}
SAME_ENDING = ("-o", "--output")


def free_port():
    with socket.socket() as link:
        link.bind(("127.0.0.1", 0))
        return link.getsockname()[1]


def seen_by(verb, outcome):
    """What any option of a verb may change."""
    if outcome.answer is None:
        return outcome.text
    if verb == "sim":
        return [outcome.answer[key] for key in ("bodies", "joints")]
    if verb == "bench":
        return outcome.answer["digest"]
    if verb == "compare":
        return [outcome.answer["pairs"], [run["energy"] for run in outcome.answer["engines"]]]
    return [data for _, data in sorted(outcome.files.items())]


class Program:
    """The command, beside the assets in `folder`."""

    def __init__(self, root, tenon, folder):
        self.root, self.tenon, self.folder = root, str(tenon), folder
        self.assets = folder / "asset"
        self.known = {}  # outcomes of runs that rows share
        self.engines = [engine["name"] for engine in self.answer("doctor")["engines"]
                        if engine["available"]]
        self.engines.sort(key=["mujoco", "physx", "jolt"].index)
        page = self.answer("record", self.assets / "main.usda", "-o", folder / "x.png",
                           "--browser", "none")
        self.has_page = "view.no-page" not in json.dumps(page)
        self.prepare()

    def answer(self, *words):
        done = subprocess.run([self.tenon, *map(str, words), "--json"], capture_output=True,
                              text=True, check=False)
        return json.loads(done.stdout)

    def prepare(self):
        """Files that options name: states, commands of each kind, settings, browsers."""
        for engine in self.engines:
            self.answer("sim", self.assets / "main.usda", "--engine", engine, "--duration", "0.1",
                        "--state-out", self.folder / f"{engine}.state")
        for name, value in (("target", -60), ("velocityTarget", 100), ("effort", -3)):
            (self.folder / f"{name}.csv").write_text(f"time,/World/Hinge.{name}\n0,{value}\n")
        shutil.copytree(self.assets, self.assets / "settled")
        (self.assets / "settled/tenon.toml").write_text('engine = "jolt"\n')
        fake = self.root / "tests/view/fake_browser.py"
        hanging = self.folder / "hanging_browser"
        hanging.write_text(f'#!/bin/sh\nTENON_FAKE_BROWSER=hangs exec "{fake}" "$@"\n')
        hanging.chmod(0o755)

    def filled(self, words, engine, port=0):
        others = self.engines[self.engines.index(engine) + 1:] + self.engines
        return [word.format(engine=engine, other=others[0], folder=self.folder,
                            assets=self.assets, root=self.root, port=port) for word in words]

    def words(self, verb, row, with_option):
        given = list(row.words) if with_option else []
        given = [*self.less(row.with_, given), *given]
        standing = [part for part in STANDING[verb] if part[0] not in row.leaves_out and
                    part[0] not in given]
        return [word for part in standing for word in part] + given

    @staticmethod
    def less(words, given):
        """The words without options that are given anew, and their values."""
        skipped = {at + i for at, word in enumerate(words) if word.startswith("-") and word in given
                   for i in (0, 1)}
        return [word for at, word in enumerate(words) if at not in skipped]

    def both(self, verb, row, engine):
        """-> the outcomes without and with the option."""
        return [self.outcome(verb, row, engine, with_option) for with_option in (False, True)]

    def outcome(self, verb, row, engine, with_option):
        port = free_port() if "{port}" in row.words else 0
        words = self.filled(self.words(verb, row, with_option), engine, port)
        key = (verb, row.asset, *words)
        if with_option or key not in self.known:
            made = self.run(verb, self.assets / row.asset, words)
            made.port = port
            if with_option:
                return made
            self.known[key] = made
        return self.known[key]

    def run(self, verb, asset, words):
        place = self.folder / "out"
        shutil.rmtree(place, ignore_errors=True)
        place.mkdir()
        if verb == "view" and "--screenshot" not in words and "--json" in words and \
                "--version" not in words:
            return self.served(asset, [word for word in words if word != "--json"])
        if verb == "view" and "--screenshot" not in words:
            words = [*words, "--for", "0.1"]
        log = self.folder / "browser.log"
        log.unlink(missing_ok=True)
        done = subprocess.run(
            [self.tenon, verb, str(asset), *words], capture_output=True, text=True, check=False,
            cwd=place, timeout=120,
            env={**os.environ, "TENON_CHROMIUM": str(self.root / "tests/view/fake_browser.py"),
                 "TENON_FAKE_BROWSER_LOG": str(log)})
        outcome = Outcome(done.returncode, done.stdout, done.stderr)
        if done.stdout.startswith("{"):
            outcome.answer = json.loads(done.stdout)
        outcome.files = {path.name: path.read_bytes() for path in place.iterdir()}
        failed = outcome.answer is not None and done.returncode not in (0, 1)
        if verb in ("view", "record"):
            outcome.seen, outcome.browser = browser_told(log)
        elif not failed:
            outcome.seen = seen_by(verb, outcome)
        return outcome

    def served(self, asset, words):
        """A view, and what one page sees of it in 20 steps; its asset is edited and changed."""
        folder = self.folder / "served"
        shutil.rmtree(folder, ignore_errors=True)
        shutil.copytree(self.assets, folder / "asset")
        asset = folder / "asset" / asset.relative_to(self.assets)
        words = [word.replace(str(self.folder), str(folder)) for word in words]
        for other in ("library", "outside"):
            shutil.copytree(self.folder / other, folder / other)
        with ServedView(self.tenon, asset, *words) as view:
            return view.outcome(asset)


def browser_told(log):
    """What the browser was told to draw, and its arguments; nothing where none was started."""
    rows = [json.loads(line) for line in log.read_text().splitlines()] if log.exists() else []
    calls = [what for kind, what in rows if kind == "call"]
    methods = sorted({what for kind, what in rows if kind == "method"})
    return [methods, calls], next((what for kind, what in rows if kind == "argv"), [])


class NotServed(Exception):
    """The program ended instead."""


class ServedView:
    """A running `tenon view`, or how it ended before it ran."""

    def __init__(self, tenon, asset, *words):
        self.asset, self.view = asset, None
        self.words = words
        probe = subprocess.run([tenon, "view", str(asset), *words, "--json", "--for", "0.01"]
                               if "--for" not in words and "--port" not in words else ["true"],
                               capture_output=True, text=True, check=False)
        self.ended = None
        if probe.returncode not in (0, 1):
            answer = json.loads(probe.stdout) if probe.stdout.startswith("{") else None
            self.ended = Outcome(probe.returncode, probe.stdout, probe.stderr, answer)
        else:
            self.view = viewer.Viewer(tenon, asset, *words)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.view:
            self.view.__exit__()

    def outcome(self, asset):
        if self.ended:
            return self.ended
        if "--for" in self.words:
            code = self.view.process.wait(30)
            return Outcome(code, answer=self.view.answer, seen={"ended": True})
        with self.view.client() as client:
            seen = client.wait("scene")
            seen = {key: seen[key] for key in ("engine", "timeStep", "bodies", "joints")}
            seen["ended"] = False
            seen["picture"] = len(self.view.get("scene.glb")[2])
            seen["frame"] = self.frame_after(client, 20)
            seen["edit"] = "error" not in client.ask(
                "set", object="/World/Arm.physics:mass", value="3")
            seen["reopened"] = self.reopens(asset, client)
            logs = client.done("identifyLogs")
            seen["logs"] = logs["logs"], logs["commands"]
        return Outcome(0, answer=self.view.answer, seen=seen)

    def frame_after(self, client, steps):
        """Time and poses; None: nothing moves in this asset."""
        if "error" in client.ask("step", count=steps):
            return None
        time, frame = client.last("state")["time"], client.next_frame()
        while abs(frame[0] - time) > 1e-6:
            frame = client.next_frame()
        return frame

    def reopens(self, asset, client):
        """Whether a change of a file is seen."""
        if "--watch" not in self.words:
            return False
        path = pathlib.Path(asset).parent / "parts.usda"
        path.write_text(path.read_text() + "\n# changed\n")
        return client.until(lambda notice: notice["is"] == "scene")["why"] == "watch" or True
