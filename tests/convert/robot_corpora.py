#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Published robots, package by package: what becomes of them, as a page.

    robot_corpora.py ROOT TENON ENGINE_PYTHON [PAGE] [--most N]

Each URDF and MJCF file of the packages that ENGINE_PYTHON has (requirements-robots.txt) is
converted, held to the numbers that MuJoCo reads of it, written back as MJCF and URDF, and looked at
by usd-core's validators and NVIDIA's. A choice of them is converted by urdf-usd-converter and
mujoco-usd-converter, too, for the time that this takes. `--most`: files of each package.
Good when nothing is refused that its source's own reader takes, and no number is wrong. PAGE is
written; without it only the table is printed. No file of others is kept.
"""

import argparse
import collections
import concurrent.futures
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

PACKAGES = {
    "example-robot-data": "cmeel.prefix/share/example-robot-data",
    "airo-models": "airo_models",
    "upkie-description": "upkie_description",
    "pybullet": "pybullet_data",
    "mani-skill": "mani_skill/assets",
    "robosuite": "robosuite/models/assets",
    "dm-control": "dm_control",
    "gymnasium-robotics": "gymnasium_robotics/envs/assets",
}
SECONDS = 300  # for one program on one file
TIMED = 12     # files of each format that the other converters convert, too
# What a fault of mujoco_reading.Comparison is about, by the word in it.
ABOUT = (("inertia", ": inertia"), ("mass", ": mass|: centre"),
         ("limits", ": limits|: damping|: friction|: armature|: stiffness"),
         ("kinematics", ""))
COLUMNS = ("files", "converted", "no robot", "refused", "kinematics", "DOF", "mass", "inertia",
           "limits", "effort", "MJCF back", "URDF back", "usd-core", "NVIDIA")
# Findings of a refusal that is the source's fault, whoever reads it: ROS's parser takes neither
# robots without links nor four numbers where there are three.
SOURCE = re.compile(r"\[(urdf\.xacro|urdf\.root|urdf\.number|urdf\.parse|robot\.cycle|"
                    r"robot\.no-links|file\.lfs-pointer)\]")
# What NVIDIA's validator finds in meshes, which are the source's own.
OF_MESHES = ("IndexedPrimvarChecker", "ManifoldChecker", "NormalsValidChecker",
             "NormalsWindingsChecker", "UnusedMeshTopologyChecker", "ZeroAreaFaceChecker",
             "WeldChecker")
USD_CORE = """
import sys
from pxr import Usd, UsdValidation
validators = UsdValidation.ValidationRegistry().GetOrLoadAllValidators()
for path in sys.argv[1:]:
    context = UsdValidation.ValidationContext(validators)
    errors = context.Validate(Usd.Stage.Open(path))
    print(path, "|", "; ".join(sorted({error.GetName() for error in errors})), flush=True)
"""
NVIDIA = """
import sys
from usd_validation_nvidia import ValidationEngine
engine = ValidationEngine()
for path in sys.argv[1:]:
    found = set()
    for issue in engine.validate(path).issues():
        if "INFO" not in str(issue.severity).upper():
            found.add(getattr(issue.rule, "__name__", str(issue.rule)))
    print(path, "|", "; ".join(sorted(found)), flush=True)
"""


def run(words, **more):
    """-> exit code, output, errors; None and the reason where it takes too long."""
    try:
        process = subprocess.run([str(word) for word in words], capture_output=True, text=True,
                                 check=False, timeout=SECONDS, **more)
    except subprocess.TimeoutExpired:
        return None, "", f"takes more than {SECONDS} s"
    return process.returncode, process.stdout, process.stderr


def cpu_seconds(words):
    """Of a program, its children included; None where it fails."""
    process = subprocess.Popen([str(word) for word in words], stdout=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    return usage.ru_utime + usage.ru_stime if process.returncode in (0, 1) else None


def is_robot(path):
    text = path.read_text(encoding="utf-8", errors="replace")
    return "<robot" in text if path.suffix == ".urdf" else "<mujoco" in text[:20000]


def files_of(folder, most):
    found = [path for ending in ("urdf", "xml") for path in sorted(folder.rglob(f"*.{ending}"))
             if is_robot(path)]
    if most and len(found) > most:
        found = [found[i * len(found) // most] for i in range(most)]
    return found


def efforts_differ(source, scene):
    """Names of joints of a URDF whose effort is another one in the asset."""
    joints = {joint["path"].rsplit("/", 1)[1]: joint for joint in scene["joints"]}
    different = []
    try:
        robot = xml.etree.ElementTree.parse(source).getroot()
    except xml.etree.ElementTree.ParseError:
        return []  # prefixes that nobody declares, which other readers take
    for element in robot.findall("joint"):
        limit, joint = element.find("limit"), joints.get(element.get("name"))
        if limit is None or joint is None or element.get("type") not in ("revolute", "prismatic"):
            continue
        wanted = float(limit.get("effort", "0"))
        found = [drive["maxForce"] for drive in joint["drives"]]
        if wanted > 0 and found and not any(
                isinstance(force, (int, float)) and abs(force - wanted) <= 1e-6 * wanted
                for force in found):
            different.append(element.get("name"))
    return different


EQUAL_BOUNDS = re.compile(r"limits: \[(\S+), \1\], MuJoCo \[-inf, inf\]")
NO_LAW = re.compile(r"(\S+) follows nothing")


def without_excused(faults, source):
    """Without what MuJoCo reads otherwise than ROS: bounds that are equal hold a joint, where
    MuJoCo takes none, and a joint that is fixed follows nobody."""
    text = source.read_text(encoding="utf-8", errors="replace")

    def is_fixed(name):
        return re.search(rf'<joint\s[^>]*name="{re.escape(name)}"[^>]*type="fixed"', text)

    return [fault for fault in faults
            if not EQUAL_BOUNDS.search(fault)
            and not (NO_LAW.search(fault) and is_fixed(NO_LAW.search(fault)[1]))]


def without_balls(faults, scene):
    """Without the hinges that URDF has in the place of each ball of an asset."""
    balls = {joint["path"].rsplit("/", 1)[1] for joint in scene["joints"]
             if joint["type"] == "spherical"}
    return [fault for fault in faults
            if not ((match := re.search(r"no joint (.*)_[xyz]$", fault)) and match[1] in balls)]


def degrees_of_freedom(scene):
    """Of all joints of an asset; what floats has none there."""
    free = {"revolute": 1, "prismatic": 1, "spherical": 3}
    return sum(free.get(joint["type"], 0) for joint in scene["joints"])


def held_degrees_of_freedom(model):
    """Of the joints of a model, but for those of what floats."""
    # pylint: disable-next=import-outside-toplevel
    import mujoco
    floating = int((model.jnt_type == int(mujoco.mjtJoint.mjJNT_FREE)).sum())
    return model.nv - 6 * floating


class Corpus:
    """One package on its way through the programs."""

    def __init__(self, tenon, folder, work):
        self.tenon, self.folder, self.work = tenon, folder, work
        self.rows = collections.Counter()
        self.notes, self.assets = [], []

    def note(self, source, what):
        self.notes.append(f"{source.relative_to(self.folder)}: {what}"[:300])

    def refused(self, source, said):
        """Whether the format's own reader refuses it, too."""
        # pylint: disable-next=import-outside-toplevel
        from mujoco_reading import Reading, mujoco, read_again
        why = said.strip().splitlines()[-1:] or ["it says nothing"]
        if SOURCE.search(said):
            return True, why[0]
        try:
            if source.suffix == ".xml":
                read_again(mujoco.MjModel.from_xml_path, str(source))
            else:
                Reading(source)
        except Exception as error:  # pylint: disable=broad-except
            return True, " ".join(str(error).split())
        return False, why[0]

    def look_at(self, item):
        """-> what became of one file, by column, and notes."""
        number, source = item
        said = collections.Counter(files=1)
        asset = self.work / f"{number}.usdc"
        code, _, errors = run([self.tenon, "convert", source, asset, "--force", "--scene"])
        if not asset.exists() or code not in (0, 1):
            rightly, why = self.refused(source, errors)
            said["no robot" if rightly else "refused"] += 1
            return said, [] if rightly else [f"refused: {why}"], None
        said["converted"] += 1
        notes = self.compare(source, asset, said)
        notes += self.go_back(source, asset, said)
        return said, notes, asset

    def compare(self, source, asset, said):
        # pylint: disable-next=import-outside-toplevel
        from mujoco_reading import Comparison, Reading
        code, out, errors = run([self.tenon, "physics", asset, "--json"])
        if code != 0:
            return [f"physics: {errors[-200:]}"]
        scene, notes = json.loads(out), []
        if source.suffix == ".urdf":
            different = efforts_differ(source, scene)
            said["effort"] += not different
            notes += [f"effort of {', '.join(different[:5])}"] if different else []
        else:
            said["effort"] += 1
        try:
            reading = Reading(source)
            comparison = Comparison("", reading, scene).run()
        except Exception as error:  # pylint: disable=broad-except
            for column in ("kinematics", "DOF", "mass", "inertia", "limits"):
                said["unread " + column] += 1
            return notes + [f"not read by MuJoCo: {' '.join(str(error).split())[:120]}"]
        wrong = collections.Counter()
        faults = without_excused(comparison.faults, source)
        for fault in faults:
            wrong[next(name for name, words in ABOUT if re.search(words, fault))] += 1
        for column in ("kinematics", "mass", "inertia", "limits"):
            said[column] += not wrong[column]
        free, wanted = degrees_of_freedom(scene), held_degrees_of_freedom(reading.model)
        said["DOF"] += free == wanted
        notes += [f"{free} degrees of freedom, MuJoCo {wanted}"] if free != wanted else []
        return notes + [f"{len(faults)} numbers: {fault.strip(': ')}" for fault in faults[:1]]

    def go_back(self, source, asset, said):
        """Of MJCF the compiled model, of URDF the world that MuJoCo makes of it."""
        # pylint: disable=import-outside-toplevel
        import round_trip
        from mujoco_reading import Reading, WorldComparison, mujoco, read_again
        notes = []
        for ending in ("xml", "urdf"):
            back = asset.with_suffix("." + ending)
            code, _, errors = run([self.tenon, "convert", asset, back, "--force"])
            column = "MJCF back" if ending == "xml" else "URDF back"
            if "[urdf.no-robot]" in errors:  # nothing in it moves
                said["unread " + column] += 1
                continue
            if code not in (0, 1) or not back.exists():
                notes.append(f"{column}: {errors.strip().splitlines()[-1:]}")
                continue
            try:
                if ending == "xml" and source.suffix == ".xml":
                    faults = round_trip.model_differences(
                        read_again(mujoco.MjModel.from_xml_path, str(source)),
                        read_again(mujoco.MjModel.from_xml_path, str(back)))
                elif ending == "xml":
                    read_again(mujoco.MjModel.from_xml_path, str(back))
                    faults = []
                else:
                    scene = json.loads(run([self.tenon, "physics", asset, "--json"])[1])
                    faults = without_excused(without_balls(
                        WorldComparison("", Reading(back), scene).run().faults, scene), source)
            except Exception as error:  # pylint: disable=broad-except
                faults = [" ".join(str(error).split())]
            said[column] += not faults
            notes += [f"{column}: {faults[0][:160]}"] if faults else []
        return notes

    def run(self, files, jobs):
        with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
            for source, (said, notes, asset) in zip(
                    files, pool.map(self.look_at, enumerate(files))):
                self.rows += said
                for note in notes:
                    self.note(source, note)
                if asset is not None:
                    self.assets.append((source, asset))

    def validate(self, column, words):
        """`words`: a program that prints PATH | FINDINGS for each file it is given."""
        for start in range(0, len(self.assets), 20):
            part = self.assets[start:start + 20]
            _, out, errors = run([*words, *(asset for _, asset in part)])
            found = dict(line.split(" | ", 1) if " | " in line else (line.rstrip(" |"), "")
                         for line in out.splitlines() if line.startswith(str(self.work)))
            for source, asset in part:
                findings = found.get(str(asset), f"no answer {errors[-80:]}").strip()
                own = {finding for finding in findings.split("; ") if finding not in OF_MESHES}
                self.rows[column] += own <= {""}
                if own - {""}:
                    self.note(source, f"{column}: {'; '.join(sorted(own))}")


def measure(tenon, converters, files):
    """Lines about the CPU seconds of this program and of another on the same files."""
    lines = []
    for ending, name in ((".urdf", "urdf_usd_converter"), (".xml", "mujoco_usd_converter")):
        program = converters / name
        chosen = [path for path in files if path.suffix == ending]
        chosen = [chosen[i * len(chosen) // TIMED] for i in range(TIMED)] if chosen else []
        ratios, failed, slower = [], 0, 0
        for source in chosen:
            with tempfile.TemporaryDirectory() as folder:
                ours = cpu_seconds([tenon, "convert", source, f"{folder}/ours/", "-q"])
                theirs = cpu_seconds([program, source, f"{folder}/theirs"])
            if ours is None or theirs is None:
                failed += 1
                continue
            ratios.append(theirs / ours)
            slower += ours > theirs
        if ratios:
            ratios.sort()
            lines.append(f"{name.replace('_', '-')}: {ratios[len(ratios) // 2]:.1f} times the CPU "
                         f"seconds of tenon in the median of {len(ratios)} files (from "
                         f"{ratios[0]:.1f} to {ratios[-1]:.1f}); tenon slower on {slower}; "
                         f"{failed} not converted by one of the two")
    return lines


def share(rows, column):
    of = rows["converted"] - rows["unread " + column]
    if column in ("files", "converted", "no robot", "refused"):
        return str(rows[column])
    return f"{rows[column]} of {of}"


def table(results, columns=COLUMNS):
    lines = ["| package | " + " | ".join(columns) + " |", "|---" * (len(columns) + 1) + "|"]
    for name, corpus in results.items():
        cells = [share(corpus.rows, column) for column in columns]
        lines.append(f"| {name} | " + " | ".join(cells) + " |")
    return lines


PAGE = """# Published robots

URDF and MJCF files of these packages (versions in `tests/convert/requirements-robots.txt`),
converted and held to what MuJoCo reads of them. The judge makes this page: `make judge
ONLY=robot_corpora`. Of packages with many files an even choice of {most} is taken.

- **no robot**: its format's own reader refuses the file, too: a macro, a part that others
  include, a file whose meshes the package lacks.
- **DOF**: degrees of freedom of all joints.
- **kinematics**, **mass**, **inertia**, **limits** (with damping, friction and armature): of the
  files that MuJoCo reads, where all numbers are MuJoCo's within rounding; **effort** is that of
  the URDF.
- **MJCF back**: of MJCF, the model that MuJoCo compiles is the source's in every field; of URDF,
  MuJoCo compiles it. **URDF back**: masses, places and limits are the asset's.
- **usd-core**, **NVIDIA**: their validators find nothing, except the shapes of the source's own
  meshes.

{table}

{speed}

What is not equal or not clean:

{notes}
"""


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("root", type=pathlib.Path)
    parser.add_argument("tenon")
    parser.add_argument("python", type=pathlib.Path)
    parser.add_argument("page", nargs="?", type=pathlib.Path)
    parser.add_argument("--most", type=int, default=0)
    options = parser.parse_args()
    sys.argv = [sys.argv[0], str(options.root), options.tenon]  # as round_trip reads them
    sys.path[:0] = [str(options.root / "build/robots"), str(pathlib.Path(__file__).parent)]
    packages = pathlib.Path(run([options.python, "-c", "import sysconfig; "
                                 "print(sysconfig.get_path('purelib'))"])[1].strip())
    results, all_files = {}, []
    with tempfile.TemporaryDirectory() as folder:
        for name, place in PACKAGES.items():
            work = pathlib.Path(folder) / name
            work.mkdir()
            corpus = results[name] = Corpus(options.tenon, packages / place, work)
            files = files_of(packages / place, options.most)
            all_files += files
            corpus.run(files, os.cpu_count())
            corpus.validate("usd-core", [sys.executable, "-B", "-c", USD_CORE])
            corpus.validate("NVIDIA", [options.python, "-B", "-c", NVIDIA])
            print(f"{name}: {dict(corpus.rows)}", flush=True)
            for note in corpus.notes:
                print("  " + note, flush=True)
    speed = measure(options.tenon, options.python.parent, all_files)
    print("\n".join(table(results) + speed))
    if options.page:
        notes = [f"- {name}: {note}" for name, corpus in results.items() for note in corpus.notes]
        options.page.write_text(PAGE.format(
            table="\n".join(table(results)), speed="\n\n".join(speed),
            most=options.most, notes="\n".join(note[:108].rstrip() for note in notes) or "nothing"),
            encoding="utf-8")
    rows = collections.Counter()
    for corpus in results.values():
        rows += corpus.rows
    wrong = sum(rows["converted"] - rows["unread " + column] - rows[column]
                for column in ("kinematics", "DOF", "mass", "inertia", "limits", "effort"))
    print(f"robots of {len(results)} packages: {rows['converted']} of {rows['files']} files "
          f"converted, {rows['no robot']} are no robots, {rows['refused']} refused, {wrong} with a "
          f"wrong number; back to MJCF {rows['MJCF back']}, to URDF {rows['URDF back']}; clean for "
          f"usd-core {rows['usd-core']}, for NVIDIA {rows['NVIDIA']}")
    return 0 if rows["converted"] and not rows["refused"] and not wrong else 1


if __name__ == "__main__":
    sys.exit(main())
