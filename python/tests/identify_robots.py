# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Known truth of `tenon identify --self-test` on robots: arms, hands, quadrupeds on a stand, loops.

    identify_robots.py ROOT TENON MISSES [--only TEXT] [--seed N] [--duration S] [--joints N]
                       [--patience S] [--jobs N]

The robots are those of ROBOTS, from build/robots (tests/convert/ten_robots.py) and this repository,
with a fixed base and drives of FREQUENCY and RATIO (`tenon tune`). Of each at most JOINTS driven
joints are identified, spread over all, with those that follow them; all drives move. A number that
is further off than its family may be (docs/identify.md), and a robot of which no number comes out,
is a miss. MISSES names the known ones, `ROBOT PARAMETER` a line, and may only shrink. Exit 0: the
misses are those of MISSES, of the robots that were run; 1: not; 77: the robots cannot be fetched.
"""

import argparse
import collections
import json
import multiprocessing.pool
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/convert"))

import ten_robots  # noqa: E402

try:
    import scipy.optimize  # noqa: F401

    import tenon_usd
except ImportError as reason:
    print(f"skipped: {reason}")
    sys.exit(77)

EXAMPLE = ten_robots.ROBOTS
#: Kind, name, and where it is in build/robots; in this repository; or a text below.
ROBOTS = [
    ("arm", "shoulder", ROOT / "examples/cpp/robots/arm.urdf"),
    ("arm", "two-dofs", EXAMPLE + "asr_twodof_description/urdf/TwoDofs.urdf"),
    ("arm", "so101", EXAMPLE + "so_arm_description/urdf/so101.urdf"),
    ("arm", "z1", EXAMPLE + "z1_description/urdf/z1.urdf"),
    ("arm", "ur5", EXAMPLE + "ur_description/urdf/ur5_robot.urdf"),
    ("arm", "kinova", EXAMPLE + "kinova_description/robots/kinova.urdf"),
    ("arm", "xarm7", EXAMPLE + "xarm_description/urdf/xarm7.urdf"),
    ("arm", "panda", EXAMPLE + "panda_description/urdf/panda.urdf"),
    ("hand", "inspire", ROOT / "examples/inspire_hand/inspire_hand.usda"),
    ("hand", "allegro", EXAMPLE + "allegro_hand_description/urdf/allegro_right_hand.urdf"),
    ("hand", "robotiq", "airo_models/grippers/robotiq_2f_85/urdf/robotiq_2f_85.urdf"),
    ("hand", "schunk", "airo_models/grippers/schunk_egk40/urdf/schunk_egk40.urdf"),
    ("hand", "finger-edu", EXAMPLE + "finger_edu_description/robots/finger_edu.urdf"),
    ("quadruped", "solo12", EXAMPLE + "solo_description/robots/solo12.urdf"),
    ("quadruped", "anymal", EXAMPLE + "anymal_c_simple_description/urdf/anymal.urdf"),
    ("quadruped", "a1", EXAMPLE + "a1_description/urdf/a1.urdf"),
    ("quadruped", "go2", EXAMPLE + "go2_description/urdf/go2.urdf"),
    ("quadruped", "hyq", EXAMPLE + "hyq_description/robots/hyq_no_sensors.urdf"),
    ("loop", "four-bar", "four bars"),
    ("loop", "slider-crank", "slider and crank"),
]
FAMILIES = ("friction", "damping", "armature", "stiffness", "driveDamping", "delay")
FREQUENCY, RATIO, GAINS = 4, 0.7, "300,20"
STEP = 0.002
#: Files whose joints are held fast by their own friction and damping, 10 N m and 10 N m s/rad on a
#: finger of 0.1 kg: what of both is taken.
TAKEN = {"allegro": 1e-4, "xarm7": 1e-2}
FRICTION = re.compile(r"^( +float (?:newton:friction|newton:damping|physxJointAxis:angular:"
                      r"(?:staticFrictionEffort|dynamicFrictionEffort|viscousFrictionCoefficient))"
                      r" = )(.+)$", re.M)
COMMAND = "import sys; from tenon_usd.identify.identify_command import main; sys.exit(main())"

HEAD = """#usda 1.0
(
    defaultPrim = "Robot"
    metersPerUnit = 1
    upAxis = "Z"
)
def Xform "Robot" (prepend apiSchemas = ["PhysicsArticulationRootAPI"])
{
    def PhysicsScene "scene"
    {
    }
"""
BODY = """    def Xform "{name}" (prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"])
    {{
        float physics:mass = {mass}
        float3 physics:diagonalInertia = ({small}, {inertia}, {inertia})
        double3 xformOp:translate = ({x}, 0, {z})
        float xformOp:rotateY = {turned}
        uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateY"]
    }}
"""
JOINT = """    def Physics{kind}Joint "{name}" {api}
    {{
        uniform token physics:axis = "{axis}"
        {before}
        rel physics:body1 = </Robot/{after}>
        point3f physics:localPos0 = ({x0}, 0, {z0})
        point3f physics:localPos1 = ({x1}, 0, 0)
        quatf physics:localRot1 = {turn}
        {more}
    }}
"""
DRIVE = """float drive:angular:physics:stiffness = 1
        float drive:angular:physics:damping = 0.02
        float physics:lowerLimit = -50
        float physics:upperLimit = 50"""

HALF = 0.5 ** 0.5  # sine of half of a right angle


def bar(name, length, x, z, turned=0):
    """A bar along its own X, or with `turned` = -90 along the world's Z, with its middle there."""
    inertia = 2 * length * length ** 2 / 12
    return BODY.format(name=name, mass=2 * length, inertia=inertia, small=inertia / 50, x=x, z=z,
                       turned=turned)


def joint(name, before, after, at0, at1, *, kind="Revolute", upright=(False, False), more=""):
    """`before` "" is the world; `upright`: which of the two bars stand, so that it starts at 0."""
    turn = HALF * (upright[1] - upright[0])
    return JOINT.format(
        kind=kind, name=name, after=after, x0=at0[0], z0=at0[1], x1=at1,
        axis="Y" if kind == "Revolute" else "X",
        turn=f"({(1 - turn ** 2) ** 0.5}, 0, {turn}, 0)",
        api='(prepend apiSchemas = ["PhysicsDriveAPI:angular"])' if "drive" in more else "",
        before=f"rel physics:body0 = </Robot/{before}>" if before else "", more=more)


def texts():
    """Loops, one drive each: a parallelogram, and a crank that pushes a slider along X."""
    lone = "bool physics:excludeFromArticulation = 1"
    up = -90
    bars = (bar("crank", 0.3, 0, 0.15, up) + bar("coupler", 0.5, 0.25, 0.3)
            + bar("rocker", 0.3, 0.5, 0.15, up)
            + joint("a", "", "crank", (0, 0), -0.15, upright=(False, True), more=DRIVE)
            + joint("b", "crank", "coupler", (0.15, 0), -0.25, upright=(True, False))
            + joint("c", "", "rocker", (0.5, 0), -0.15, upright=(False, True))
            + joint("d", "coupler", "rocker", (0.25, 0), 0.15, upright=(False, True), more=lone))
    slider = (bar("crank", 0.2, 0, 0.1, up) + bar("rod", 0.6, 0.3, 0.2)
              + bar("slider", 0.2, 0.6, 0.2)
              + joint("a", "", "crank", (0, 0), -0.1, upright=(False, True), more=DRIVE)
              + joint("b", "crank", "rod", (0.1, 0), -0.3, upright=(True, False))
              + joint("c", "rod", "slider", (0.3, 0), 0)
              + joint("d", "", "slider", (0.6, 0.2), 0, kind="Prismatic", more=lone))
    return {"four bars": HEAD + bars + "}\n", "slider and crank": HEAD + slider + "}\n"}


def run(words, patience):
    """-> exit code, None after `patience` seconds of a processor; the answer."""
    done = subprocess.run(["bash", "-c", 'ulimit -t "$0"; exec "$@"', str(int(patience)),
                           *map(str, words)], capture_output=True, text=True, check=False)
    if done.returncode in (-signal.SIGXCPU, -signal.SIGKILL):
        return None, {}
    try:
        return done.returncode, json.loads(done.stdout)
    except json.JSONDecodeError:
        return done.returncode, {"diagnostics": [{"message": done.stderr.strip()[-300:]}]}


def said(answer):
    if answer.get("diagnostics"):
        return answer["diagnostics"][-1]["message"]
    return answer.get("error", "no answer")


class Robot:
    def __init__(self, row, packages, folder, options):
        self.kind, self.name, self.source = row
        self.packages, self.folder, self.options = packages, folder, options
        self.scores, self.refused, self.fault = [], [], ""

    def asset(self):
        """The robot as USD with drives. Raises RuntimeError with the words of the program."""
        known = texts()
        made = self.folder / f"{self.name}.usda"
        if self.source in known:
            made.write_text(known[self.source], encoding="utf-8")
        elif str(self.source).endswith(".usda"):
            return self.source  # it has gains of its own
        else:
            path = self.packages / self.source
            code, answer = run([self.options.tenon, "convert", path, "-o", made, "--fix-base",
                                "--gains", GAINS, "--json"], self.options.patience)
            if code not in (0, 1):
                raise RuntimeError(said(answer))
            part = TAKEN.get(self.name)
            if part:
                made.write_text(FRICTION.sub(
                    lambda each: f"{each[1]}{part * float(each[2]):g}",
                    made.read_text(encoding="utf-8")), encoding="utf-8")
        code, answer = run([self.options.tenon, "tune", made, "--frequency", FREQUENCY,
                            "--damping-ratio", RATIO, "--dt", STEP, "--save", "--json"],
                           self.options.patience)
        if code not in (0, 1):
            raise RuntimeError(said(answer))
        return made

    def rows(self, asset):
        """What --identify gets: driven joints spread over all, and those that follow them."""
        joints = list(tenon_usd.physics(str(asset)).joints)
        driven = [each for each in joints if each.drives and each.drives[0].stiffness > 0
                  and not each.mimics]
        if not driven:
            raise RuntimeError("no drive holds a position")
        count = min(self.options.joints, len(driven))
        leaders = [driven[i * len(driven) // count].path for i in range(count)]
        moved = list(leaders)
        for _ in joints:  # a follower may have followers
            moved += [each.path for each in joints if each.path not in moved and
                      any(joints[mimic.leader].path in moved for mimic in each.mimics)]
        return [f"{family}:{'|'.join(map(re.escape, leaders if family in FAMILIES[3:] else moved))}"
                for family in FAMILIES]

    def run(self):
        try:
            asset = self.asset()
            words = [word for row in self.rows(asset) for word in ("--identify", row)]
        except (RuntimeError, tenon_usd.Error) as reason:
            self.fault = str(reason)
            return self
        code, answer = run(
            [sys.executable, "-c", COMMAND, asset, "--self-test", *words, "--seed",
             self.options.seed, "--duration", self.options.duration, "--dt", STEP, "-j", 1,
             "--json"], self.options.patience)
        if code is None:
            self.fault = f"no end within {self.options.patience:g} s of a processor"
        elif "scores" not in answer:
            self.fault = said(answer)
        else:
            self.scores, self.refused = answer["scores"], answer["refused"]
        print(self.line(), flush=True)
        return self

    def misses(self):
        """Parameter -> how far off; "*" for all of it."""
        if self.fault or not self.scores:
            return {"*": self.fault or "the log tells nothing"}
        return {each["name"]: f"{100 * each['error']:.3g} % of {each['truth']:.4g}"
                for each in self.scores if not each["passed"]}

    def line(self):
        good = sum(each["passed"] for each in self.scores)
        words = f"{self.kind:9}  {self.name:13}  {good} of {len(self.scores)}"
        if self.refused:
            words += f", {len(self.refused)} refused"
        return words + "".join(f"\n    {name}: {how}" for name, how in self.misses().items())


def known_misses(path):
    lines = path.read_text(encoding="utf-8").splitlines() if path.exists() else []
    return {tuple(line.split(" ", 1)) for line in lines if line and not line.startswith("#")}


def result_of(robots, new, gone):
    """The last line: robots, numbers by family, and what is unlike MISSES."""
    scores = [each for robot in robots for each in robot.scores]
    counts = []
    for family in FAMILIES:
        own = [each for each in scores if each["family"] == family]
        counts.append(f"{family} {sum(each['passed'] for each in own)} of {len(own)}")
    held = sum(each["low"] <= each["truth"] <= each["high"] for each in scores)
    whole = sum(not robot.misses() for robot in robots)
    refused = sum(len(robot.refused) for robot in robots)
    return (f"{whole} of {len(robots)} robots whole; {', '.join(counts)}; {held} of {len(scores)} "
            f"within their intervals; {refused} refused; {len(new)} new misses, {len(gone)} gone")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    add = parser.add_argument
    add("root", type=pathlib.Path)
    add("tenon")
    add("misses", type=pathlib.Path)
    add("--only", default="", help="a kind or names with commas between")
    add("--seed", type=int, default=0)
    add("--duration", type=float, default=4.0)
    add("--joints", type=int, default=3)
    add("--patience", type=float, default=900.0,
        help="processor time of one robot [s]")
    add("--jobs", type=int, default=os.cpu_count())
    options = parser.parse_args()
    packages, why = ten_robots.make_packages(options.root)
    if packages is None:
        print(f"skipped: {why}")
        return 77
    only = [word for word in options.only.split(",") if word]
    rows = [row for row in ROBOTS if not only or row[0] in only or row[1] in only]
    with tempfile.TemporaryDirectory(prefix="tenon-identify-") as folder:
        robots = [Robot(row, packages, pathlib.Path(folder), options) for row in rows]
        with multiprocessing.pool.ThreadPool(options.jobs) as pool:
            pool.map(Robot.run, robots, 1)
    names = {robot.name for robot in robots}
    known = {miss for miss in known_misses(options.misses) if miss[0] in names}
    found = {(robot.name, name) for robot in robots for name in robot.misses()}
    new, gone = found - known, known - found
    for robot in robots:
        if robot.fault:
            print(robot.line())
    for what, misses in (("new", new), ("gone", gone)):
        for miss in sorted(misses):
            print(f"{what}: {' '.join(miss)}")
    print(result_of(robots, new, gone))
    return 1 if new or gone else 0


if __name__ == "__main__":
    sys.exit(main())
