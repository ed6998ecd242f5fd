# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""The panel "Identify" of `tenon view`: the same numbers as the command, a layer that is shown
before it is written and taken back by Undo, and a fit that ends when somebody says so.

    test_identify_page.py
"""

import json
import os
import signal
import sys
import unittest
import unittest.mock

import support

sys.path.insert(0, str(support.ROOT / "tests/view"))

try:
    import scipy  # noqa: F401

    import test_identify
    import tenon_usd as tenon
    import viewer
except ImportError as reason:
    print(f"skipped: {reason}")
    sys.exit(77)

STEP = test_identify.STEP
WISH = {"parameters": [{"text": "stiffness"}, {"text": "friction"}], "timeStep": STEP}


class Panel(test_identify.Robot):
    def setUp(self):
        super().setUp()
        self.enterContext(unittest.mock.patch.dict(os.environ, {"TENON_PYTHON": sys.executable}))
        log = self.log(duration=2.0)
        self.csv = test_identify.Command.csv(self, log)
        self.layer = self.folder / "pendulum.identified.usda"

    def view(self, *options):
        return self.enterContext(viewer.Viewer(test_identify.PROGRAM, self.asset, *options))

    def test_the_stages_say_what_the_command_says(self):
        with self.view("--log", self.csv).client() as client:
            logs = client.done("identifyLogs")
            self.assertEqual((logs["logs"], logs["whyNot"]), ([str(self.csv)], None))
            self.assertEqual(logs["layer"], str(self.layer))
            self.assertEqual(client.refused("writeIdentified"), "live.refused")
            check = client.done("identify", stage="check", **WISH)
            self.assertTrue(check["ok"], check)
            self.assertEqual([row["told"] for row in check["check"]["parameters"]], [True, True])
            found = client.done("identify", stage="solve", **WISH)
            self.assertNotIn("layer", found)
            self.assertIn("round", client.last("progress")["what"])
            self.assertEqual(client.last("progress")["of"], "identify")
            words = [self.asset, self.csv, "--dt", STEP, "--json"] + [
                f"--identify={each['text']}" for each in WISH["parameters"]]
            code, out, err = test_identify.Command.run_main(self, *words, "--write", self.layer)
            self.assertEqual(code, 0, err)
            said = json.loads(out)
            self.assertEqual(found["parameters"], said["parameters"])
            self.assertEqual(found["heldOut"], said["heldOut"])
            text = self.layer.read_text(encoding="utf-8")
            self.layer.unlink()
            planned = client.done("writeIdentified", dryRun=True)
            self.assertFalse(self.layer.exists())
            self.assertIn("+    subLayers = [@./pendulum.usda@]", planned["files"][0]["diff"])
            client.done("writeIdentified")
            self.assertEqual(self.layer.read_text(encoding="utf-8"), text)
            client.done("undo")
            self.assertFalse(self.layer.exists())
            client.done("redo")
        stiffness = tenon.physics(str(self.layer)).joints[0].drives[0].stiffness
        self.assertAlmostEqual(stiffness, said["parameters"][0]["value"], delta=1e-4 * stiffness)

    def test_known_truth_takes_no_log(self):
        with self.view().client() as client:
            self.assertEqual(client.refused("identify", stage="check"), "live.refused")
            done = client.done("identify", stage="selfTest", parameters=[{"text": "stiffness"}],
                               timeStep=STEP)
            self.assertEqual([row["family"] for row in done["scores"]], ["stiffness"])

    def test_what_cannot_be_is_refused(self):
        with self.view("--log", self.csv, "--read-only").client() as client:
            for wish in ({"stage": "fit"}, {"stage": "check", "logs": [{"text": "/etc/passwd"}]},
                         {"stage": "check", "heldOut": [{"text": str(self.csv)}]}):
                self.assertEqual(client.refused("identify", **wish), "live.refused")
            answer = client.ask("identify", stage="check", parameters=[{"text": "fricton"}])
            self.assertIn("did you mean 'friction'", answer["error"]["message"])
            client.done("identify", stage="solve", **WISH)
            self.assertEqual(client.refused("writeIdentified"), "live.read-only")
        with unittest.mock.patch.dict(os.environ, {"TENON_PYTHON": "/no/python"}):
            with self.view("--log", self.csv).client() as client:
                self.assertEqual(client.refused("identify", stage="check"), "python.missing")

    def test_a_fit_keeps_nobody_waiting_and_ends_when_asked(self):
        wish = {"starts": 64, "timeStep": STEP / 16, "window": 2.0}
        with self.view("--log", self.csv) as view, view.client() as client:
            client.send_frame(json.dumps({"do": "identify", "id": 99, "stage": "solve",
                                          **wish}).encode())
            client.wait("progress", of="identify")
            self.assertEqual(client.refused("identify", stage="check"), "live.busy")
            self.assertIn("diagnostics", client.done("findings"))
            client.done("cancel")
            ended = client.until(lambda notice: notice.get("id") == 99)
            self.assertTrue(ended["is"] == "answer" or
                            ended["error"]["rule"] == "identify.ended", ended)
            client.done("play")
            client.send_frame(json.dumps({"do": "identify", "id": 100, "stage": "solve",
                                          **wish}).encode())
            client.wait("progress", of="identify")
            self.assertEqual(view.end(signal.SIGINT)[0], 0)


if __name__ == "__main__":
    support.main()
