# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Assets into Newton without pxr: a drop-in for newton.ModelBuilder.add_usd.

    import newton
    from tenon_usd.newton import add_usd

    builder = newton.ModelBuilder()
    result = add_usd(builder, "hand.usda")             # arguments and answer of builder.add_usd
    print(result["path_body_map"]["/hand/palm"])       # the index of the body
    model = builder.finalize()

Bodies, masses, joints and colliders come from the neutral description (Stage.physics()), in metres,
kilograms, seconds and radians; what Newton reads beside it, schema resolvers and custom attributes
of solvers included, from the composed prims. Made for Newton 1.8. docs/newton.md: what is read,
what is refused, and where models differ from those of Newton's own importer.
"""

from __future__ import annotations

from .importer import add_usd
from .options import ImportedWarning, Result

__all__ = ["ImportedWarning", "Result", "add_usd"]
