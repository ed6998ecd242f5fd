# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""What Newton's own importer reads and this one does not: refused by name."""

from __future__ import annotations

from ..errors import UnsupportedError
from .importing import Importing
from .prims import PrimView

#: Types of prims that are refused, and what they are.
TYPES = {
    "TetMesh": "a soft body",
    "PhysicsAttachment": "an attachment of a deformable body",
    "PhysicsElementCollisionFilter": "a filter of elements of deformable bodies",
    "ParticleField3DGaussianSplat": "a field of Gaussians",
    "NewtonActuator": "an actuator of Newton",
}
#: API schemas that are refused, and what they make of a prim.
APIS = {
    "PhysicsDeformableBodyAPI": "a deformable body",
    "PhysicsCurvesDeformableSimAPI": "a cable",
    "PhysicsSurfaceDeformableSimAPI": "a cloth",
    "PhysicsVolumeDeformableSimAPI": "a soft body",
    "NewtonPointsDeformableSimAPI": "particles",
}
#: Types that those schemas are applied to.
APPLIED_TO = ("", "Scope", "Xform", "Mesh", "BasisCurves", "Points")
#: Attributes of a PhysicsScene of Newton that are no declarations of custom attributes.
OF_SCENES = (
    "newton:maxSolverIterations", "newton:timeStepsPerSecond", "newton:gravityEnabled",
    "newton:joint_drive_gains_scaling", "newton:collapse_fixed_joints",
)
#: Beginnings of attributes that Newton's schemas for single solvers have.
OF_SOLVERS = ("newton:mpm:", "newton:kamino:", "newton:xpbd:", "newton:vbd:")
ADVICE = "use builder.add_usd() for it, or leave it out by ignore_paths"


def refuse(importing: Importing) -> None:
    """Raises UnsupportedError for the first prim that is not imported here."""
    for prim in importing.prims:
        what = TYPES.get(prim.type_name) or _by_schema(prim)
        if what and not importing.prims.is_ignored(prim.path):
            raise UnsupportedError(f"{prim.path}: {what} is not imported here; {ADVICE}")
        if prim.type_name == "PhysicsScene":
            _refuse_declarations(prim)


def _by_schema(prim: PrimView) -> str:
    if prim.type_name not in APPLIED_TO:
        return ""
    return next((APIS[name] for name in prim.apis if name in APIS), "")


def _refuse_declarations(prim: PrimView) -> None:
    for name in sorted(prim.names):
        if not name.startswith("newton:") or name in OF_SCENES or name.startswith(OF_SOLVERS):
            continue
        raise UnsupportedError(
            f"{prim.path}.{name}: a custom attribute of Newton that is declared by the stage is "
            "not read here; declare it by builder.add_custom_attribute() and leave it out there"
        )
