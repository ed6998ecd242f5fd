# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Variants of an asset's physics, and which of them Newton is served best by."""

from __future__ import annotations

from .importing import Importing
from .prims import Prims

SET = "Physics"
#: The variant for Newton: what any engine reads, with mimics by Newton's own schema.
NEUTRAL = "physics"


def selections(prims: Prims) -> dict[str, str]:
    """The selected variant of each set "Physics", by prim path."""
    found = {}
    for prim in prims:
        if prim.type_name in ("", "Xform", "Scope"):
            variants = prim.prim.variants.get(SET)
            if variants is not None:
                found[prim.path] = variants[0]
    return found


def advice(importing: Importing, selected_variants: dict[str, str]) -> str:
    """What to select instead; empty where nothing is better."""
    resolvers = [resolver.name for resolver in importing.resolvers.all]
    for path, selected in selected_variants.items():
        choices = importing.prims[path].prim.variants[SET][1]
        if selected == "none" and NEUTRAL in choices:
            return f'{path}: the variant "none" has no physics; physics="{NEUTRAL}" has'
        if selected == "mujoco" and "mjc" not in resolvers:
            return (
                f'{path}: the variant "mujoco" is for SolverMuJoCo, with '
                "schema_resolvers=[SchemaResolverMjc(), SchemaResolverNewton()]; other solvers "
                f'take physics="{NEUTRAL}"'
            )
        if selected == "physx" and "physx" not in resolvers:
            return (
                f'{path}: what the variant "physx" adds is read with schema_resolvers='
                f'[SchemaResolverNewton(), SchemaResolverPhysx()]; else take physics="{NEUTRAL}"'
            )
    return ""
