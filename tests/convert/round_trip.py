# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""What the tests of models that go through USD and back have in common: `test.py ROOT TENON`.

MuJoCo's reader is that of tests/robot_requirements.txt; without it a test that imports this skips.
"""

import json
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT, TENON = pathlib.Path(sys.argv[1]), sys.argv[2]

sys.path.insert(0, str(ROOT / "build/robots"))
try:
    import mujoco
    import numpy
except ImportError as error:
    print(f"skipped: MuJoCo's reader is not there: {error}")
    sys.exit(77)

faults = []


def run(*arguments):
    """A command of ours; -> its JSON."""
    process = subprocess.run([TENON, *map(str, arguments), "--json"], capture_output=True,
                             text=True, check=False)
    if process.returncode != 0:
        faults.append(f"{arguments[0]}: {process.returncode} {process.stdout} {process.stderr}")
    return json.loads(process.stdout)


def without_source(asset):
    """Takes what an asset in one file keeps of its source away; what comes back is made anew."""
    text = asset.read_text()
    text, count = re.subn(r"\n *custom uniform string tenon:mjcf:model = '''.*?'''", "", text,
                          flags=re.DOTALL)
    if count != 1:
        faults.append(f"{asset.name}: it keeps nothing of its source")
    asset.write_text(re.sub(r"\n *custom uniform [^ ]* tenon:mjcf:.*", "", text))


# Where files lie is no part of a model: their paths, and the room that these take.
PLACES = re.compile(r"n?paths|.*_pathadr|nbuffer")
TOLERANCE = 1e-6  # of the largest number of a field


def is_near(found, wanted):
    found, wanted = numpy.asarray(found), numpy.asarray(wanted)
    if found.shape != wanted.shape:
        return False
    if found.dtype.kind != "f":
        return bool((found == wanted).all())
    room = TOLERANCE * max(1e-9, float(numpy.max(numpy.abs(wanted), initial=0)))
    return bool(numpy.allclose(found, wanted, rtol=TOLERANCE, atol=room, equal_nan=True))


def model_differences(before, after, prefix=""):
    """Names of the fields in which two compiled models differ, those of parts included."""
    differences = []
    for name in dir(before):
        wanted = None if name.startswith("_") or PLACES.fullmatch(name) else getattr(before, name)
        if wanted is None or callable(wanted):
            continue
        found = getattr(after, name)
        if isinstance(wanted, (int, float, numpy.ndarray)):
            if not is_near(found, wanted):
                differences.append(prefix + name)
        elif isinstance(wanted, (bytes, str)):
            if found != wanted:
                differences.append(prefix + name)
        else:
            differences += model_differences(wanted, found, f"{prefix}{name}.")
    return differences


def near(what, found, wanted, rounding):
    """Equal but for `rounding`, relative to the largest number wanted or 1."""
    found, wanted = (numpy.ravel(values).astype(float) for values in (found, wanted))
    scale = max(1, float(numpy.max(numpy.abs(wanted), initial=0)))
    if found.shape != wanted.shape or not (numpy.abs(found - wanted) <= rounding * scale).all():
        faults.append(f"{what}: {found.tolist()}, before {wanted.tolist()}")


def main(*checks):
    """Calls all with one folder to work in and prints the faults; -> the exit code."""
    with tempfile.TemporaryDirectory() as folder:
        for check in checks:
            check(pathlib.Path(folder))
    for fault in faults:
        print(fault)
    print(f"{len(faults)} faults")
    return 1 if faults else 0
