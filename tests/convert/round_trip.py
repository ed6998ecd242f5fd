# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""What the tests of models that go through USD and back have in common: `test.py ROOT TENON`.

MuJoCo's reader is that of tests/robot_requirements.txt; without it a test that imports this skips.
"""

import json
import pathlib
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
