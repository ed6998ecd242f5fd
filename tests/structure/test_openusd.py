#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""OpenUSD composes what `tenon structure` writes to what `tenon dump` says, under each variant.

    test_openusd.py ROOT TENON

Exit 77, with the reason, where usd-core is absent.
"""

import pathlib
import sys
import tempfile

from program import EXAMPLE, INCUMBENT, ROOT, TENON, structure

sys.path.insert(0, str(ROOT / "tests/differential"))


def main():
    try:
        import pxr  # noqa: F401  pylint: disable=unused-import,import-outside-toplevel
    except ImportError:
        print("skipped: no OpenUSD modules in this Python")
        return 77
    import dump_stage  # pylint: disable=import-outside-toplevel
    oracle, faults, cases = dump_stage.oracle_module(), 0, 0
    with tempfile.TemporaryDirectory() as folder:
        for asset in (path for path in (EXAMPLE, INCUMBENT) if path.exists()):
            made = structure(asset, pathlib.Path(folder) / asset.parent.name)
            variants = ("none", "physics", "physx", "mujoco")
            for case in dump_stage.variant_cases("made", str(made), made.stem, variants, folder):
                differences = dump_stage.judge(oracle, TENON, case, folder)
                cases += 1
                if differences is None or differences:
                    faults += 1
                    print(f"{case.name}: {(differences or ['OpenUSD fails'])[:3]}")
    print(f"{cases - faults} of {cases} equal")
    return 1 if faults or not cases else 0


if __name__ == "__main__":
    sys.exit(main())
