# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""The command `tenon` of the wheel: becomes the program that lies in the package, without
importing it. `tenon sweep` runs the Python that the package is installed for, unless TENON_PYTHON
names another."""

import os
import sys
from importlib.util import find_spec


def main() -> None:
    package = find_spec("tenon_usd")
    if package is None or package.origin is None:
        sys.exit("tenon: the package tenon_usd is not installed for " + sys.executable)
    program = os.path.join(os.path.dirname(package.origin), "bin", "tenon")
    named = os.environ.get("TENON_PYTHON") or sys.executable
    os.execve(program, sys.argv, {**os.environ, "TENON_PYTHON": named})
