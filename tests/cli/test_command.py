#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Holds the command line as a whole: every verb and option of the table that `tenon help --json`
prints, so that a new verb or option is held without a word here.

    test_command.py ROOT TENON
"""

import errno
import json
import os
import pathlib
import pty
import re
import select
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

ROOT, TENON = pathlib.Path(sys.argv[1]).resolve(), str(pathlib.Path(sys.argv[2]).resolve())
os.environ["TENON_CHROMIUM"] = str(ROOT / "tests/view/fake_browser.py")
HAND = ROOT / "examples/inspire_hand/inspire_hand.usda"
NOTHING = ("doctor", "help", "version", "manual", "completion", "test-runner")  # no asset

SCENE = """#usda 1.0
(
    defaultPrim = "World"
    metersPerUnit = 1
    kilogramsPerUnit = 1
    upAxis = "Z"
)
def Xform "World"
{
    def PhysicsScene "scene" {}
    def Sphere "ball" (prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsCollisionAPI"])
    {
        double radius = 0.1
        double3 xformOp:translate = (0, 0, 1)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
%s}
"""


def tenon(*arguments, cwd=None, text=True, **more):
    return subprocess.run([TENON, *map(str, arguments)], capture_output=True, text=text,
                          check=False, cwd=cwd, **more)


def on_terminal(arguments, columns=80, until=None, timeout=60, cwd=None):
    """-> what a terminal shows (both streams) and the exit code; `until(output, pid)` may act."""
    pid, fd = pty.fork()
    if pid == 0:
        if cwd:
            os.chdir(cwd)
        os.environ["COLUMNS"] = ""
        import fcntl
        import struct
        import termios
        fcntl.ioctl(1, termios.TIOCSWINSZ, struct.pack("HHHH", 24, columns, 0, 0))
        os.execv(TENON, [TENON, *map(str, arguments)])
    output, end = b"", time.monotonic() + timeout
    while time.monotonic() < end:
        if select.select([fd], [], [], 0.1)[0]:
            try:
                data = os.read(fd, 65536)
            except OSError as error:
                if error.errno != errno.EIO:
                    raise
                break
            if not data:
                break
            output += data
        if until:
            until(output, pid)
    else:
        os.kill(pid, signal.SIGKILL)
    status = os.waitpid(pid, 0)[1]
    os.close(fd)
    return output, os.waitstatus_to_exitcode(status)


class Command(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        answer = json.loads(tenon("help", "--json").stdout)
        cls.shared = answer["options"]
        cls.verbs = {verb["name"]: verb for verb in answer["verbs"]}

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        self.scene = self.write("scene.usda", SCENE % "")

    def write(self, name, text):
        path = self.folder / name
        path.write_text(text)
        return path

    def options(self):
        """Every option as (verb words, option), also those of test-runner's verbs."""
        for verb in self.verbs.values():
            for option in verb["options"]:
                yield [verb["name"]], option
            for inner in verb["verbs"]:
                for option in inner["options"]:
                    yield [verb["name"], inner["name"]], option

    def usage_error(self, arguments, *words):
        """Exit 2, a message with `words`; with --json the envelope."""
        process = tenon(*arguments)
        self.assertEqual(process.returncode, 2, (arguments, process.stderr))
        self.assertEqual(process.stdout, "", arguments)
        for word in words:
            self.assertIn(word, process.stderr, arguments)
        process = tenon(*arguments, "--json")
        self.assertEqual(process.returncode, 2, arguments)
        answer = json.loads(process.stdout)
        self.assertEqual((answer["tool"], answer["ok"]), ("tenon", False), arguments)
        self.assertEqual(answer["diagnostics"][0]["severity"], "error", arguments)

    def test_verbs_options_and_choices_are_suggested(self):
        self.usage_error(["inof"], 'no verb "inof"', 'did you mean "info"')
        self.usage_error(["qqqqqq"], "no verb", "tenon help")
        self.usage_error([], "no verb is given", "tenon help")
        self.usage_error(["help", "chek"], 'did you mean "check"')
        self.usage_error(["info", HAND, "--jsno"], "no option --jsno", 'did you mean "--json"')
        self.usage_error(["info", "--jsno"], "no option --jsno", 'did you mean "--json"')
        self.usage_error(["sim", HAND, "--engine", "mujco"], 'did you mean "mujoco"')
        self.usage_error(["cat", HAND, "--format", "usdaa"], 'did you mean "usda"')
        self.usage_error(["tree", HAND, "--show", "physic"], 'did you mean "physics"')
        self.usage_error(["test-runner", "layers", HAND], 'did you mean "layer"')
        self.usage_error(["info", HAND, "--color", "blue"], "auto, always, never")

    def test_what_is_missing_is_named(self):
        for verb in self.verbs.values():
            if any(o["positional"] and o["required"] for o in verb["options"]):
                process = tenon(verb["name"])
                self.assertEqual(process.returncode, 2, verb["name"])
                self.assertIn("missing ", process.stderr, verb["name"])
                self.assertIn("--help", process.stderr, verb["name"])
        self.usage_error(["tree"], "missing ASSET")
        self.usage_error(["explain", "no-rule"], "explain")
        self.usage_error(["cat", "a.usda", "b.usda"], '"b.usda" is one argument too many')
        self.usage_error(["info", HAND, "--physics"], "--physics needs a value")
        self.usage_error(["info", "--physics", "-q", HAND], "--physics needs a value")
        self.usage_error(["info", HAND, "--physics", "a", "--physics", "b"], "given twice")

    def test_help_version_and_their_spellings(self):
        everything = tenon("help").stdout
        self.assertEqual(everything, tenon("--help").stdout)
        self.assertEqual(tenon("help", "sim").stdout, tenon("sim", "--help").stdout)
        self.assertEqual(tenon("help", "test-runner", "value").stdout,
                         tenon("test-runner", "value", "-h").stdout)
        for spelling in (["version"], ["--version"], ["-V"], ["info", "-V", HAND]):
            self.assertRegex(tenon(*spelling).stdout, r"^tenon \d+\.\d+\.\d+\n$", spelling)
        for name, verb in self.verbs.items():
            self.assertIn(name, everything)
            self.assertIn("Example", tenon("help", name).stdout, name)
            for option in verb["options"]:
                self.assertIn(option["names"][-1], tenon("help", name).stdout, name)

    def test_help_fits_its_terminal(self):
        for name in ["", *self.verbs]:
            arguments = ["help", name] if name else ["help"]
            for line in tenon(*arguments).stdout.splitlines():
                self.assertLessEqual(len(line), 80, (name, line))
        output = on_terminal(["help", "check"], columns=60)[0].decode()
        longest = max(len(line) for line in output.splitlines())
        self.assertLessEqual(longest, 60)
        output = on_terminal(["help", "check"], columns=140)[0].decode()
        self.assertGreater(max(len(line) for line in output.splitlines()), 90)

    def test_manual_and_completions_name_every_verb_and_option(self):
        texts = {shell: tenon("completion", shell).stdout for shell in ("bash", "zsh", "fish")}
        texts["manual"] = tenon("manual").stdout.replace("\\-", "-")
        for shell, text in texts.items():
            for name in self.verbs:
                self.assertIn(name, text, shell)
            for words, option in [*self.options(), *((["tenon"], o) for o in self.shared)]:
                for name in option["names"]:
                    dashless = name.lstrip("-") if shell == "fish" else name
                    if not option["positional"]:
                        self.assertIn(dashless, text, (shell, words))
        self.assertTrue(texts["manual"].startswith(".TH TENON 1"))

    def test_completions_are_sound_shell(self):
        for shell in ("bash", "zsh", "fish"):
            if shutil.which(shell):
                script = self.write("tenon." + shell, tenon("completion", shell).stdout)
                process = subprocess.run([shell, "-n", script], capture_output=True, check=False)
                self.assertEqual(process.returncode, 0, process.stderr)
        ask = (f"source {self.folder}/tenon.bash; COMP_WORDS=(tenon sim --engine mu); "
               "COMP_CWORD=3; _tenon; echo ${COMPREPLY[@]}; COMP_WORDS=(tenon stru); COMP_CWORD=1; "
               "_tenon; echo ${COMPREPLY[@]}")
        process = subprocess.run(["bash", "-c", ask], capture_output=True, text=True, check=False)
        self.assertEqual(process.stdout.split(), ["mujoco", "structure"], process.stderr)

    def test_completion_finds_the_verb_behind_options_of_the_program(self):
        script = self.write("tenon.bash", tenon("completion", "bash").stdout)
        cases = [("tenon -q stru", "structure"), ("tenon --color never stru", "structure"),
                 ("tenon -q --color never sim --engine mu", "mujoco"),
                 ("tenon --color ne", "never"), ("tenon stru", "structure"),
                 ("tenon sim --color ne", "never")]
        for line, wanted in cases:
            ask = (f"source {script}; COMP_WORDS=({line}); COMP_CWORD={len(line.split()) - 1}; "
                   "_tenon; echo ${COMPREPLY[@]}")
            process = subprocess.run(["bash", "-c", ask], capture_output=True, text=True,
                                     check=False)
            self.assertEqual(process.stdout.split(), [wanted], (line, process.stderr))

    def test_zsh_finds_the_verb_in_the_words_of_its_completion(self):
        # The loop is in the language that bash and zsh share; the arrays of zsh begin with 1.
        script = tenon("completion", "zsh").stdout
        loop = script[script.index("  for (("):script.index("  done\n") + len("  done\n")]
        for shell in filter(shutil.which, ("bash", "zsh")):
            front = "0 " if shell == "bash" else ""
            for line, verb in [("tenon ", ""), ("tenon stru", ""), ("tenon -q ''", ""),
                               ("tenon -q stru", ""), ("tenon -q check ''", "check"),
                               ("tenon --color never ''", ""),
                               ("tenon check hand.usda ''", "check"),
                               ("tenon --color never check --fix ''", "check")]:
                count = len(line.split()) if not line.endswith(" ") else len(line.split()) + 1
                ask = (f"words=({front}{line}); CURRENT={count}; verb= i="
                       f"\n{loop}\necho \"<$verb>\"")
                process = subprocess.run([shell, "-c", ask], capture_output=True, text=True,
                                         check=False)
                self.assertEqual(process.stdout, f"<{verb}>\n", (shell, line, process.stderr))

    def test_manual_is_sound_roff(self):
        if not shutil.which("groff"):
            self.skipTest("groff is not installed")
        process = subprocess.run(["groff", "-man", "-Tutf8", "-ww", "-z"], capture_output=True,
                                 text=True, input=tenon("manual").stdout, check=False)
        self.assertEqual((process.returncode, process.stderr), (0, ""))

    def test_an_option_never_takes_the_asset(self):
        for words, option in self.options():
            verb = self.verbs[words[0]]
            takes_asset = any(o["positional"] for o in verb["options"]) and len(words) == 1
            if not takes_asset or option["positional"] or option["value"] is None:
                continue
            if not option["list"] or words[0] in NOTHING:
                continue
            # The value is wrong for most; that the asset is not missing is the point.
            end = ["--for", "0"] if words[0] == "view" else []  # it would serve on
            process = tenon(*words, option["names"][-1], "x", self.scene, *end)
            self.assertNotIn("missing ASSET", process.stderr, (words, option["names"]))
        self.assertEqual(tenon("check", "--only", "mass", self.scene).returncode, 0)
        self.assertIn("ball", tenon("tree", "--mask", "/World", self.scene).stdout)
        self.assertIn("ball", tenon("tree", "--mask", "/World,/Other", self.scene).stdout)
        self.assertIn("ball", tenon("tree", "--mask", "/A", "--mask", "/World", self.scene).stdout)

    def test_numbers_outside_of_their_range_are_refused_with_the_range(self):
        numeric = [(words, option) for words, option in self.options() if option["range"]]
        self.assertGreater(len(numeric), 5)
        for words, option in numeric:
            least, most = option["range"]["least"], option["range"]["most"]
            for text in ("-1", "nan", "inf", "-inf", "1e300", "0", "", "text", "1e999", "0x10"):
                try:
                    number = float(text)
                except ValueError:
                    number = float("nan")
                inside = least <= number <= most and (number > least or
                                                      not option["range"]["withoutLeast"])
                if inside:
                    continue
                process = tenon(*words, "absent.usda", f"{option['names'][-1]}", text)
                self.assertEqual(process.returncode, 2, (words, option["names"], text))
                self.assertIn("takes a ", process.stderr, (words, option["names"], text))
                self.assertIn(option["names"][-1], process.stderr)

    def test_whole_numbers_may_be_written_with_an_exponent(self):
        for name in ("1e9", "1000000000", "1.0e9"):
            self.assertEqual(tenon("info", self.scene, "--max-work", name).returncode, 0, name)
        self.usage_error(["info", self.scene, "--max-work", "1.5"], "takes a whole number")

    def test_runs_without_a_step_or_without_an_end_are_refused(self):
        process = tenon("sim", self.scene, "--dt", 10, "--duration", 2)
        self.assertEqual(process.returncode, 2)
        self.assertIn("longer than", process.stderr)
        process = tenon("sim", self.scene, "--duration", 1e6, "--fps", 1e5, "-o",
                        self.folder / "run.csv")
        self.assertEqual(process.returncode, 2)
        self.assertIn("the limit is", process.stderr)
        answer = json.loads(tenon("sim", self.scene, "--duration", 0, "--json").stdout)
        self.assertEqual((answer["steps"], answer["time"]), (0, 0))

    def test_standard_input_is_an_asset(self):
        text = self.scene.read_text()
        crate = self.folder / "scene.usdc"
        tenon("cat", self.scene, "-o", crate)
        plain = tenon("cat", self.scene).stdout
        self.assertEqual(tenon("cat", "-", input=text).stdout, plain)
        with open(crate, "rb") as file:
            self.assertEqual(tenon("cat", "-", stdin=file).stdout, plain)
        for verb in ("info", "tree", "physics", "dump", "dump-index"):
            answer = tenon(verb, "-", input=text, cwd=self.folder)
            self.assertEqual(answer.returncode, 0, (verb, answer.stderr))
            self.assertIn("1" if verb == "info" else "ball", answer.stdout, verb)
        self.write("part.usda", '#usda 1.0\ndef Xform "P" {\n def Cube "inner" {}\n}\n')
        over = '#usda 1.0\ndef "A" (references = @./part.usda@</P>) {}\n'
        self.assertIn("inner", tenon("tree", "-", input=over, cwd=self.folder).stdout)
        process = tenon("cat", "-", input="#usda 1.0\ndef {\n")
        self.assertEqual(process.returncode, 2)
        self.assertRegex(process.stderr, r"^-:2:")
        for verb in ("strip", "convert", "zip", "set", "structure", "bake"):
            process = tenon(verb, "-", "-o", "x.usda", input=text)
            self.assertEqual(process.returncode, 2, verb)

    def test_several_assets_are_answered_one_by_one(self):
        other = self.write("other.usda", '#usda 1.0\ndef Cube "C" {}\n')
        for verb in ("info", "tree", "physics"):
            answer = json.loads(tenon(verb, self.scene, other, "--json").stdout)
            self.assertIsNone(answer["asset"])
            self.assertEqual([a["asset"] for a in answer["assets"]],
                             [str(self.scene), str(other)])
            self.assertEqual(answer["assets"][1], json.loads(tenon(verb, other, "--json").stdout))
            text = tenon(verb, self.scene, other).stdout
            self.assertIn(f"==> {self.scene} <==", text)
            gone = tenon(verb, self.scene, "gone.usda", "--json")
            self.assertEqual(gone.returncode, 2)
            self.assertEqual([a["ok"] for a in json.loads(gone.stdout)["assets"]], [True, False])
        answer = json.loads(tenon("check", self.scene, other, "--json").stdout)
        self.assertEqual(len(answer["assets"]), 2)

    def test_many_equal_findings_are_one_line(self):
        prims = "".join(f'    def Cube "c{i}"\n    {{\n        float physics:mass = 1\n    }}\n'
                        for i in range(2000))
        scene = self.write("many.usda", SCENE % prims)
        lines = [line for line in tenon("check", scene).stdout.splitlines()
                 if "PhysicsMassAPI" in line]
        self.assertEqual(len(lines), 1)
        self.assertIn("and 1,999 more like it", lines[0])
        found = json.loads(tenon("check", scene, "--json").stdout)["diagnostics"]
        self.assertEqual(sum("PhysicsMassAPI" in d["message"] for d in found), 2000)

    def test_what_a_description_holds_for_other_programs_is_no_flood(self):
        plugins = "".join(f'<gazebo reference="l{i}"><a{i}/></gazebo>\n' for i in range(500))
        robot = self.write("robot.urdf", f'<robot name="r"><link name="l"/>{plugins}</robot>')
        process = tenon("convert", robot, self.folder / "robot.usda")
        self.assertLess(len(process.stderr.splitlines()), 30)
        self.assertIn("more like it", process.stderr)

    def test_many_bodies_are_not_listed_one_by_one(self):
        bodies = "".join(
            f'    def Sphere "b{i}" (prepend apiSchemas = ["PhysicsRigidBodyAPI"]) {{ \ndouble3 '
            f'xformOp:translate = ({i}, 0, 0)\n uniform token[] xformOpOrder = '
            '["xformOp:translate"]\n}\n' for i in range(60))
        process = tenon("sim", self.write("many.usda", SCENE % bodies), "--duration", 0.01)
        self.assertLess(len(process.stdout.splitlines()), 15)
        self.assertIn("--json", process.stdout)

    def test_a_set_up_that_takes_long_is_announced(self):
        """MuJoCo's grows with the square of the bodies."""
        def said(count):
            bodies = "".join(
                f'    def Sphere "b{i}" (prepend apiSchemas = ["PhysicsRigidBodyAPI"]) {{\n'
                f'double3 xformOp:translate = ({i}, 0, 0)\nuniform token[] xformOpOrder = '
                '["xformOp:translate"]\n}\n' for i in range(count))
            process = tenon("sim", self.write("many.usda", SCENE % bodies), "--duration", 0)
            self.assertEqual(process.returncode, 0, process.stderr)
            return process.stderr

        self.assertRegex(said(7100), r"setting up 7,10\d bodies on mujoco takes about 2 s")
        self.assertNotIn("setting up", said(3700))

    def test_missing_input_is_no_in_every_verb_that_answers(self):
        broken = self.write("broken.usda", SCENE % (
            '    def Xform "mesh" (payload = @./gone.usd@</X>) {}\n'))
        more = {"where": ["/World"], "explain": ["/World"], "bake": ["-o", "m.usda"],
                "zip": ["-o", "p.usdz"], "strip": ["-o", "s.usda"], "sim": ["--duration", "0.01"],
                "cat": ["--flatten"], "diff": [broken, "--composed"], "structure": ["-o", "st"],
                "convert": ["out.xml"], "set": ["/World/ball.radius=2", "--dry-run"],
                "add": ["/World/x=cube", "--dry-run"], "remove": ["/World/mesh", "--dry-run"],
                "rename": ["/World/mesh", "m", "--dry-run"], "variant": [],
                "bench": ["--duration", "0.01"], "benchmark": ["--tests", "ground_drop"],
                "record": ["-o", "r.png"],
                "report": ["-o", "r.html", "--duration", "0.01"], "view": ["--for", "0"],
                "compare": ["--engines", "mujoco,mujoco", "--duration", "0.01"]}
        for name in self.verbs:
            # They read nothing here.
            if name in NOTHING or name in ("new", "sweep", "excite", "identify", "undo"):
                continue
            if name == "check":
                process = tenon(name, broken, cwd=self.folder)
            else:
                process = tenon(name, broken, *more.get(name, []), cwd=self.folder)
            if "view.no-page" in process.stderr:
                continue  # a build without node
            # 2: a verb that refuses to go on.
            refused = (0,) if name == "view" else (1, 2)  # which shows what there is
            self.assertIn(process.returncode, refused, (name, process.stdout, process.stderr))
            self.assertIn("gone.usd", process.stderr + process.stdout, name)
        for name in ("info", "tree", "physics", "sim", "dump", "where", "explain"):
            process = tenon(name, broken, *more.get(name, []), cwd=self.folder)
            self.assertEqual(process.returncode, 1, (name, process.stderr))
        answer = json.loads(tenon("info", broken, "--json").stdout)
        self.assertFalse(answer["ok"])
        robot = self.write("r.urdf", '<robot name="r"><link name="l"><visual><geometry><mesh '
                                     'filename="no.stl"/></geometry></visual></link></robot>')
        self.assertEqual(tenon("convert", robot, self.folder / "r.usda").returncode, 1)

    def test_input_named_by_an_expression_without_a_value_is_no(self):
        arcs = {"reference": ('(references = @`none_such("x")`@</X>)', ""),
                "payload": ('(payload = @`none_such("x")`@</X>)', ""),
                "sublayer": ("", '    subLayers = [@`none_such("x")`@]\n')}
        more = {"where": ["/World"], "explain": ["/World"], "sim": ["--duration", "0.01"]}
        for arc, (of_prim, of_layer) in arcs.items():
            text = SCENE % f'    def Xform "mesh" {of_prim} {{}}\n'
            broken = self.write(f"{arc}.usda", text.replace("(\n", "(\n" + of_layer, 1))
            for name in ("info", "tree", "physics", "sim", "dump", "where", "explain", "check"):
                process = tenon(name, broken, *more.get(name, []), cwd=self.folder)
                self.assertEqual(process.returncode, 1, (arc, name, process.stderr))
                self.assertIn("compose.variable-expression-error",
                              process.stderr + process.stdout, (arc, name))

    def test_what_a_limit_cuts_short_is_no(self):
        for name in ("info", "tree", "physics", "dump", "check"):
            process = tenon(name, self.scene, "--max-work", "1")
            self.assertEqual(process.returncode, 1, (name, process.stderr))
            self.assertIn("compose.work-exceeded", process.stderr + process.stdout)
        for call in (["set", self.scene, "/World/ball.radius=2", "--dry-run"],
                     ["structure", self.scene, "-o", self.folder / "cut"]):
            process = tenon(*call, "--max-work", "1")
            self.assertEqual(process.returncode, 2, (call, process.stderr))
            self.assertIn("compose.work-exceeded", process.stderr)

    def test_nothing_acts_on_the_terminal(self):
        evil = "\033]0;title\a\u202edrow\u009b31m"
        scene = self.write("evil.usda", SCENE % (
            f'    custom string note = """{evil}"""\n    def Xform "x" (payload = @./{evil}.usd@) '
            '{}\n'))
        calls = [[f"v{evil}"], ["info", f"{evil}.usda"], ["info", scene, f"--{evil}"],
                 ["sim", scene, "--engine", evil], ["sim", scene, "--dt", evil],
                 ["info", scene, evil], ["explain", evil], ["check", "--only", evil, scene],
                 ["cat", scene, "--format", evil], ["help", evil], ["set", scene, f"/A.x={evil}"],
                 ["variant", scene, f"S={evil}"], ["where", scene, evil], ["info", scene],
                 ["tree", "-a", "-m", scene], ["check", scene], ["physics", scene],
                 ["sim", scene, "--duration", "0.01"], ["diff", scene, self.scene],
                 ["convert", evil, "x.usda"], ["zip", scene, "-o", evil], ["structure", scene]]
        for call in calls:
            process = tenon(*call, text=False, cwd=self.folder)
            for stream in (process.stdout, process.stderr):
                for sign in (b"\033", b"\a", "\u202e".encode(), "\u009b".encode()):
                    self.assertNotIn(sign, stream, call)
        for call in (["cat", scene], ["dump", scene], ["info", scene, "--json"], *calls[:8]):
            shown = on_terminal(call, cwd=self.folder)[0]
            shown = re.sub(rb"\033\[(3[136]m|0m|K)", b"", shown)  # our own colours
            for sign in (b"\033", b"\a", "\u202e".encode(), "\u009b".encode()):
                self.assertNotIn(sign, shown, call)

    def test_long_work_shows_progress_on_a_terminal_only(self):
        work = ["sim", self.scene, "--duration", "1e6"]
        ended = []

        def interrupt(output, pid):
            if b"s left" in output and not ended:
                ended.append(pid)
                os.kill(pid, signal.SIGINT)

        output, code = on_terminal(work, until=interrupt)
        self.assertEqual(code, 130)
        self.assertRegex(output.decode(), r"simulating: \S+ %, .* s left")
        process = subprocess.Popen([TENON, *map(str, work)], stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE)
        time.sleep(3)
        process.send_signal(signal.SIGINT)
        stdout, stderr = process.communicate()
        self.assertEqual(process.returncode, 130)
        self.assertNotIn(b"left", stdout + stderr)

    def test_interrupted_reading_ends_with_130_and_leaves_nothing(self):
        read, write = os.pipe()
        process = subprocess.Popen([TENON, "cat", "-", "-o", self.folder / "out.usda"], stdin=read)
        time.sleep(0.5)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(timeout=10), 130)
        os.close(read)
        os.close(write)
        self.assertEqual(sorted(p.name for p in self.folder.iterdir()), ["scene.usda"])

    def test_physics_has_one_meaning(self):
        plain = tenon("tree", HAND, "--physics", "physx").stdout
        self.assertTrue(plain.startswith("/\n"), plain[:80])
        kinematic = tenon("tree", HAND, "--show", "physics").stdout
        self.assertTrue(kinematic.startswith("world\n"), kinematic[:80])
        for older in (["tree", HAND, "--physics"], ["tree", "--physics", HAND]):
            self.assertEqual(tenon(*older).stdout, kinematic)
        new = tenon("diff", HAND, HAND, "--show", "physics", "--physics", "physx", "--json")
        self.assertEqual(json.loads(new.stdout)["mode"], "physics")
        for older in (["diff", HAND, HAND, "--physics"], ["diff", "--physics", HAND, HAND]):
            self.assertEqual(json.loads(tenon(*older, "--json").stdout)["mode"], "physics")
        answer = json.loads(tenon("diff", HAND, HAND, "--physics", "physx", "--json").stdout)
        self.assertEqual(answer["mode"], "composed")

    def test_rules_are_explained_by_number_and_name(self):
        self.assertRegex(tenon("explain", "S-83").stdout, r"^S-83: .*anchor")
        self.assertEqual(tenon("explain", "s-83").returncode, 0)
        self.assertEqual(tenon("explain", "S-83000").returncode, 2)
        self.assertIn("# joint.body-missing", tenon("explain", "joint.body-missing").stdout)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]], verbosity=1)
