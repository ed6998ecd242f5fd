# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Physics-ready USD assets: open, check, explain, edit, convert and simulate them.

    import tenon_usd as tenon

    stage = tenon.open("hand.usda")
    for body in stage.physics().bodies:
        print(body.path, body.mass)            # kg

    world = tenon.World("grasp.usda", envs=64)
    world.step(100)
    print(world.joint_positions.shape)         # (64, joints)

Physics is in metres, kilograms, seconds and radians; values of prims are in the units of the
stage. Errors are exceptions of tenon_usd.errors, which carry the findings: file, line, prim, fix.
"""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

from . import _tenon
from ._tenon import VERSION as __version__
from ._tenon import AssetPath, Diagnostic, Prim, RelatedPrim, Stage
from .errors import (
    CorruptError,
    Error,
    ExportWarning,
    FileError,
    InvalidError,
    LimitError,
    MissingError,
    MissingFileError,
    NotFoundError,
    ParseError,
    UnstableError,
    UnsupportedError,
)
from .functions import (
    check,
    compare,
    convert,
    diff,
    doctor,
    edit_poses,
    engines,
    explain,
    info,
    new,
    open,
    physics,
    pose,
    poses,
    rule,
    rules,
    structure,
    undo,
    where,
)
from .pages import view
from .tuning import colliders, tune

if TYPE_CHECKING:
    from .dynamics import Dynamics
    from .world import World

__all__ = [
    "AssetPath",
    "CorruptError",
    "Diagnostic",
    "Dynamics",
    "Error",
    "ExportWarning",
    "FileError",
    "InvalidError",
    "LimitError",
    "MissingError",
    "MissingFileError",
    "NotFoundError",
    "ParseError",
    "Prim",
    "RelatedPrim",
    "Stage",
    "UnstableError",
    "UnsupportedError",
    "World",
    "__version__",
    "check",
    "colliders",
    "compare",
    "convert",
    "diff",
    "doctor",
    "edit_poses",
    "engines",
    "explain",
    "info",
    "new",
    "open",
    "physics",
    "pose",
    "poses",
    "rule",
    "rules",
    "structure",
    "tune",
    "undo",
    "view",
    "where",
]

_tenon.set_worker(os.path.join(os.path.dirname(__file__), "libexec", "tenon", "tenon-worker"))


def __getattr__(name: str) -> Any:
    # What needs NumPy is imported when it is asked for.
    if name == "World":
        from .world import World

        return World
    if name == "Dynamics":
        from .dynamics import Dynamics

        return Dynamics
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted(__all__)
