#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Every verb where the system gives too little: memory, files, threads, stack, no folder for
temporary files, no HOME. It ends with an exit code of the table, and says why where that is not 0.

    test_scarce.py ROOT PROGRAM

PROGRAM is built with the preset `release`: sanitizers reserve terabytes of addresses.
"""

import errno
import os
import pathlib
import resource
import subprocess
import sys
import tempfile

if not os.path.exists(sys.argv[2]):
    print("skipped: no " + sys.argv[2])
    sys.exit(77)

# pylint: disable=wrong-import-position
from program import PRINTING, TENON, make_inputs, verbs

MEGABYTE = 1 << 20
NOBODY = 65534
EXITS = {0, 1, 2, 3, 4, 130}

# Name, resource, the values. Linux ends a program by a signal where not even its own 30 MB fit.
LIMITS = (
    ("addresses", resource.RLIMIT_AS,
     [size * MEGABYTE for size in (45, 60, 75, 90, 105, 120, 140, 160, 220, 300, 400, 600)]),
    ("files", resource.RLIMIT_NOFILE, [3, 4, 5, 6, 7, 8, 10, 12, 16]),
    ("threads", resource.RLIMIT_NPROC, [0, 1]),
    ("stack", resource.RLIMIT_STACK, [64 << 10, 256 << 10]),
)


def many_bodies(count):
    """Enough for the library of an engine to be the one that asks for too much."""
    schemas = '"PhysicsRigidBodyAPI", "PhysicsCollisionAPI"'
    spheres = [f'    def Sphere "b{i}" (prepend apiSchemas = [{schemas}])\n    {{\n'
               f"        double3 xformOp:translate = ({3 * i}, 0, 0)\n"
               '        uniform token[] xformOpOrder = ["xformOp:translate"]\n    }'
               for i in range(count)]
    return ('#usda 1.0\n(\n    defaultPrim = "W"\n    metersPerUnit = 1\n    upAxis = "Z"\n)\n'
            'def Xform "W"\n{\n' + "\n".join(spheres) + "\n}\n")


def limited(limit, value):
    def apply():
        if limit == resource.RLIMIT_NPROC and os.geteuid() == 0:
            os.setgroups([])
            os.setgid(NOBODY)
            os.setuid(NOBODY)
        resource.setrlimit(limit, (value, value))
    return apply


def fault_of(words, folder, environment, apply):
    """-> what is wrong with a run, or nothing."""
    try:
        done = subprocess.run([TENON, *words], cwd=folder, env=environment, preexec_fn=apply,
                              capture_output=True, timeout=60, check=False)
    except subprocess.TimeoutExpired:
        return "does not end"
    except OSError as error:  # not started: no room, or a place that nobody else may enter
        return "" if error.errno in (errno.E2BIG, errno.EAGAIN, errno.ENOMEM, errno.EACCES) else \
            str(error)
    except subprocess.SubprocessError:  # too little for Python itself, before the program
        return ""
    tells_on_output = "--json" in words or words == ["doctor"]
    said = (done.stderr + (done.stdout if tells_on_output else b"")).decode(errors="replace")
    if done.returncode in (-9, 127):  # the kernel or the loader ends it before main()
        return ""
    if done.returncode not in EXITS:
        return f"exit {done.returncode}: {said[-300:]}"
    if done.returncode in (2, 3, 4) and not said.strip():
        return f"exit {done.returncode} without a message"
    return ""


def main():
    faults = []
    count = 0
    with tempfile.TemporaryDirectory() as place:
        clean = pathlib.Path(place, "clean")
        clean.mkdir(mode=0o777)
        os.chmod(place, 0o755)
        make_inputs(clean)
        subprocess.run(["chmod", "-R", "a+rwX", clean], check=True)
        homeless = {name: value for name, value in os.environ.items()
                    if name not in ("HOME", "TMPDIR", "XDG_STATE_HOME", "XDG_CACHE_HOME")}
        cases = [(name, dict(os.environ), limited(limit, value), f"{name} {value:,}")
                 for name, limit, values in LIMITS for value in values]
        cases += [("no HOME", homeless, None, "no HOME"),
                  ("no TMPDIR", {**homeless, "TMPDIR": "/nowhere"}, None, "TMPDIR that is missing")]
        commands = [PRINTING[verb] for verb in verbs() if PRINTING[verb] is not None]
        (clean / "many.usda").write_text(many_bodies(1500), encoding="utf-8")
        commands += [["sim", "many.usda", "--duration", "0"], ["convert", "many.usda", "made.xml"]]
        for words in commands:
            for _, environment, apply, what in cases:
                count += 1
                fault = fault_of(words, clean, environment, apply)
                if fault:
                    faults.append(f"{' '.join(words)}, {what}: {fault}")
    for fault in faults:
        print(fault)
    print(f"{count} runs of {len(commands)} commands, {len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
