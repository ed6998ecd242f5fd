#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Files with macros of xacro: what becomes of them, and what they may not do.

    xacro_files.py ROOT TENON

Skipped (77) where this Python lacks the package xacro, or the kernel has no Landlock.
"""

import importlib.util
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT, TENON = pathlib.Path(sys.argv[1]).resolve(), os.path.abspath(sys.argv[2])
HEAD = '<robot name="{0}" xmlns:xacro="xacro">\n'
MACROS = """<xacro:macro name="part" params="name mass:=1 *more">
  <link name="${prefix}${name}">
    <inertial><mass value="${mass * scale}"/>
      <inertia ixx="${mass * 0.01}" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial>
    <xacro:insert_block name="more"/>
  </link>
</xacro:macro>
"""
ARM = HEAD.format("arm") + """<xacro:include filename="parts/macros.xacro"/>
<xacro:arg name="prefix" default="r_"/>
<xacro:arg name="gripper" default="false"/>
<xacro:property name="prefix" value="$(arg prefix)"/>
<xacro:property name="scale" value="${2 * 0.25}"/>
<xacro:part name="base" mass="4">
  <visual><geometry><box size="1 1 1"/></geometry></visual></xacro:part>
<xacro:part name="upper">
  <visual><geometry><sphere radius="0.1"/></geometry></visual></xacro:part>
<joint name="${prefix}turn" type="revolute">
  <parent link="${prefix}base"/><child link="${prefix}upper"/><axis xyz="0 0 1"/>
  <limit lower="${-pi / 2}" upper="${radians(45)}" effort="5" velocity="2"/>
</joint>
<xacro:if value="$(arg gripper)">
  <xacro:part name="hand">
    <visual><geometry><sphere radius="0.1"/></geometry></visual></xacro:part>
  <joint name="grip" type="fixed">
    <parent link="${prefix}upper"/><child link="${prefix}hand"/></joint>
</xacro:if>
</robot>
"""
LINK = ('<link name="{0}"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1"/></inertial>'
        "</link>")


class Xacro(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        self.asset = self.folder / "out.usda"
        self.path = os.path.dirname(sys.executable) + os.pathsep + os.environ.get("PATH", "")

    def write(self, name, text):
        file = self.folder / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")
        return file

    def run_tenon(self, *words, path=None, more=None):
        environment = dict(os.environ, PATH=path or self.path, **(more or {}))
        done = subprocess.run([TENON, *map(str, words), "--json"], capture_output=True, text=True,
                              check=False, env=environment, cwd=self.folder)
        return done.returncode, json.loads(done.stdout)

    def convert(self, file, *options, **more):
        code, answer = self.run_tenon("convert", file, self.asset, "--force", *options, **more)
        if code in (0, 1):
            _, self.scene = self.run_tenon("physics", self.asset)
        return code, answer

    def bodies(self):
        return {b["path"].rpartition("/")[2]: b for b in self.scene["bodies"]}


class Expanding(Xacro):
    def setUp(self):
        super().setUp()
        self.write("robot/parts/macros.xacro", HEAD.format("m") + MACROS + "</robot>")
        self.arm = self.write("robot/arm.urdf.xacro", ARM)

    def test_macros_properties_and_includes(self):
        code, answer = self.convert(self.arm)
        self.assertEqual(code, 0, answer)
        self.assertEqual(set(self.bodies()), {"r_base", "r_upper"})
        self.assertAlmostEqual(self.bodies()["r_base"]["mass"], 2, delta=1e-6)
        [joint] = [j for j in self.scene["joints"] if j["path"].endswith("r_turn")]
        self.assertAlmostEqual(joint["lower"], -1.5707963, delta=1e-6)
        self.assertIn("xacro.expanded", [found["rule"] for found in answer["diagnostics"]])

    def test_lines_of_what_xacro_prints_are_not_given_as_places_of_the_file(self):
        fault = '<link name="extra"><inertial><mass value="-1"/></inertial></link>' \
            '<joint name="e" type="fixed"><parent link="r_base"/><child link="extra"/></joint>'
        self.arm.write_text(ARM.replace("</robot>", fault + "</robot>"), encoding="utf-8")
        _, answer = self.convert(self.arm)
        own = [d for d in answer["diagnostics"] if d["file"] == str(self.arm)
               and d["rule"] != "xacro.expanded"]
        self.assertTrue(own, answer)
        self.assertEqual({d["line"] for d in own}, {None}, own)
        named = [d["message"] for d in own if "of the output of xacro)" in d["message"]]
        self.assertTrue(named, own)
        # An error is no different.
        self.arm.write_text(ARM.replace("</robot>", '<link name="lost"/></robot>'),
                            encoding="utf-8")
        code, answer = self.convert(self.arm)
        self.assertEqual(code, 2, answer)
        self.assertIsNone(answer["diagnostics"][-1]["line"], answer)

    def test_arguments(self):
        code, answer = self.convert(self.arm, "--arg", "prefix=left_", "--arg", "gripper=true")
        self.assertEqual(code, 0, answer)
        self.assertEqual(set(self.bodies()), {"left_base", "left_upper", "left_hand"})

    def test_the_input_is_not_written_over(self):
        code, answer = self.run_tenon("convert", self.arm, self.arm, "--force")
        self.assertEqual(code, 2, answer)
        self.assertEqual(self.arm.read_text(encoding="utf-8"), ARM)

    def test_packages_are_found_upward_and_by_option(self):
        text = HEAD.format("p") + '<xacro:include filename="$(find parts_pkg)/m.xacro"/>' + \
            LINK.format("a") + "</robot>"
        file = self.write("ws/robot_pkg/urdf/r.xacro", text)
        part = HEAD.format("m") + LINK.format("b") + \
            '<joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint></robot>'
        self.write("ws/parts_pkg/m.xacro", part)
        code, answer = self.convert(file)
        self.assertEqual((code, answer["diagnostics"][-1]["rule"]), (2, "xacro.package"))
        self.assertIn("--package parts_pkg=DIR", answer["diagnostics"][-1]["fix"])
        code, answer = self.convert(file, "--package", f"parts_pkg={self.folder}/ws/parts_pkg")
        self.assertEqual(code, 0, answer)
        self.write("ws/parts_pkg/package.xml", "<package><name>parts_pkg</name></package>")
        code, answer = self.convert(file)
        self.assertEqual(code, 0, answer)
        self.assertEqual(set(self.bodies()), {"a", "b"})


class Failing(Xacro):
    def broken(self, body, *options):
        file = self.write("bad.urdf.xacro", HEAD.format("bad") + body + "</robot>")
        return self.convert(file, *options)

    def test_xacro_says_what_is_wrong_and_where(self):
        code, answer = self.broken('<link name="${nothing}"/>')
        self.assertEqual((code, answer["diagnostics"][-1]["rule"]), (2, "xacro.failed"))
        self.assertIn("nothing", answer["diagnostics"][-1]["message"])
        self.assertTrue(answer["diagnostics"][-1]["file"].endswith("bad.urdf.xacro"))

    def test_a_fault_in_an_include_names_that_file(self):
        self.write("inner.xacro", HEAD.format("i") + '<link name="${1 +}"/></robot>')
        _, answer = self.broken('<xacro:include filename="inner.xacro"/>')
        self.assertTrue(answer["diagnostics"][-1]["file"].endswith("inner.xacro"), answer)

    def test_a_missing_argument_is_named(self):
        code, answer = self.broken('<link name="$(arg who)"/>')
        self.assertEqual(code, 2)
        self.assertIn("--arg", answer["diagnostics"][-1]["fix"])

    def test_endless_work_ends(self):
        code, answer = self.broken(
            '<xacro:property name="a" value="${[len(str(9**x)) for x in range(10**9)]}"/>'
            '<link name="${a}"/>')
        self.assertEqual((code, answer["diagnostics"][-1]["rule"][:6]), (2, "xacro."), answer)

    def test_without_xacro_it_says_what_to_install(self):
        file = self.write("r.urdf.xacro", HEAD.format("r") + LINK.format("a") + "</robot>")
        code, answer = self.convert(file, path=str(self.folder))
        self.assertEqual((code, answer["diagnostics"][-1]["rule"]), (4, "xacro.missing"))
        self.assertIn("pip install xacro", answer["diagnostics"][-1]["fix"])

    def test_arguments_are_for_xacro(self):
        file = self.write("r.urdf", '<robot name="r">' + LINK.format("a") + "</robot>")
        code, answer = self.convert(file, "--arg", "a=b")
        self.assertEqual((code, answer["diagnostics"][-1]["rule"]), (2, "convert.option"))


class Confined(Xacro):
    """What a hostile file tries, past xacro's own names."""

    def tries(self, include):
        """The names of the links that a file is left with whose include runs as it likes."""
        file = self.write("in/r.xacro", HEAD.format("r") + include + LINK.format("a") + "</robot>")
        return self.convert(file)

    def test_files_elsewhere_cannot_be_included(self):
        self.write("secret.xacro", HEAD.format("s") + LINK.format("s") + "</robot>")
        for name in ("../secret.xacro", str(self.folder / "secret.xacro")):
            code, answer = self.tries(f'<xacro:include filename="{name}"/>')
            self.assertEqual((code, answer["diagnostics"][-1]["rule"]), (2, "xacro.failed"), answer)
            self.assertIn("--allow-read", answer["diagnostics"][-1]["fix"])

    def test_yaml_elsewhere_cannot_be_read(self):
        secret = self.write("secret.yaml", "key: hidden")
        code, answer = self.tries('<xacro:property name="k" value="${load_yaml(\'' + str(secret) +
                                  '\')}"/><link name="${k[\'key\']}"/>')
        self.assertEqual(code, 2, answer)
        self.assertNotIn("hidden", json.dumps(answer))

    def test_code_that_gets_out_of_xacro_reads_writes_and_calls_nothing(self):
        """The package itself is replaced by one that tries everything."""
        secret = self.write("secret.txt", "hidden")
        hostile = self.folder / "site/xacro"
        hostile.mkdir(parents=True)
        (hostile / "__init__.py").write_text(f"""
import os, socket, subprocess
def attempt(name, deed):
    try:
        deed()
        results.append(name)
    except BaseException as error:
        pass
results = []
def process_file(path, mappings=None):
    attempt("read", lambda: open({str(secret)!r}).read())
    attempt("list", lambda: os.listdir({str(self.folder)!r}))
    attempt("write", lambda: open({str(self.folder / 'made')!r}, "w"))
    attempt("beside", lambda: open(os.path.join(os.path.dirname(path), "made"), "w"))
    attempt("remove", lambda: os.remove(path))
    attempt("temporary", lambda: open("/tmp/tenon_xacro_test", "w"))
    attempt("connect", lambda: socket.create_connection(("127.0.0.1", 9), 1))
    attempt("socket", lambda: socket.socket())
    attempt("run", lambda: subprocess.run(["/bin/true"]))
    attempt("fork", os.fork)
    attempt("kill", lambda: os.kill(os.getppid(), 0))
    raise ValueError("could: " + " ".join(results) + ".")
""", encoding="utf-8")
        file = self.write("in/r.xacro", HEAD.format("r") + "</robot>")
        code, answer = self.convert(file, more={"PYTHONPATH": str(self.folder / "site")})
        self.assertEqual(code, 2, answer)
        self.assertIn("could: .", answer["diagnostics"][-1]["message"])


def reason_to_skip():
    if importlib.util.find_spec("xacro") is None:
        return "this Python lacks the package xacro"
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "a.xacro"
        file.write_text(HEAD.format("a") + LINK.format("l") + "</robot>", encoding="utf-8")
        path = os.path.dirname(sys.executable) + os.pathsep + os.environ["PATH"]
        done = subprocess.run([TENON, "convert", file, file.with_suffix(".usda")], text=True,
                              env={**os.environ, "PATH": path}, capture_output=True, check=False)
    return "this kernel has no Landlock" if "[xacro.sandbox]" in done.stderr else None


if __name__ == "__main__":
    if why := reason_to_skip():
        print(why)
        sys.exit(77)
    unittest.main(argv=sys.argv[:1], verbosity=1)
