# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Whether prims are drawn, and their colour: of the bound material, else of displayColor."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np

from .importing import Importing, warn
from .prims import Prims, PrimView

Colour = tuple[float, float, float]

#: Newton's colour for what is drawn without a material: diffuseColor's fallback.
UNBOUND: Colour = (0.18, 0.18, 0.18)
DRAWN = ("default", "proxy")
COLOURS = ("inputs:baseColor", "inputs:diffuseColor")
OPACITIES = ("inputs:opacity", "inputs:alpha")


@dataclasses.dataclass(frozen=True)
class Look:
    """Colour as it is displayed (sRGB), opacity, and whether a texture replaces them."""

    colour: Colour | None = None
    opacity: float | None = None
    textured: bool = False
    roughness: float | None = None
    metallic: float | None = None

    def of_mesh(self) -> dict[str, Any]:
        """Keyword arguments of newton.Mesh; what wears a texture that is not read is white."""
        return {
            "color": (1.0, 1.0, 1.0) if self.textured else self.colour,
            "opacity": self.opacity,
            "roughness": self.roughness,
            "metallic": self.metallic,
        }


def displayed(linear: Any) -> Colour:
    """sRGB of linear red, green and blue."""
    rgb = np.clip(np.asarray(linear, dtype=np.float64).reshape(-1)[:3], 0.0, None)
    made = np.where(rgb <= 0.0031308, rgb * 12.92, 1.055 * rgb ** (1 / 2.4) - 0.055)
    r, g, b = made.tolist()
    return r, g, b


class Looks:
    """Looks of prims, each found once."""

    def __init__(self, importing: Importing) -> None:
        self._prims: Prims = importing.prims
        self._found: dict[str, Look] = {}
        self._materials: dict[str, Look] = {}
        self._hidden: dict[str, tuple[bool, str]] = {"": (False, "default")}

    def is_drawn(self, prim: PrimView) -> bool:
        """Visible, and of a purpose that viewports draw."""
        hidden, purpose = self._drawing(prim.path)
        return not hidden and purpose in DRAWN

    def _drawing(self, path: str) -> tuple[bool, str]:
        found = self._hidden.get(path)
        if found is not None:
            return found
        hidden, purpose = self._drawing(path.rpartition("/")[0])
        prim = self._prims.get(path)
        if prim is not None:
            hidden = hidden or prim.authored("visibility") == "invisible"
            purpose = prim.authored("purpose") or purpose
        self._hidden[path] = hidden, purpose
        return hidden, purpose

    def look(self, prim: PrimView) -> Look:
        found = self._found.get(prim.path)
        if found is None:
            found = self._found[prim.path] = self._look(prim)
        return found

    def _look(self, prim: PrimView) -> Look:
        bound = self._bound(prim)
        shown = self._primvars(prim)
        if bound is None:
            return shown
        colour = bound.colour if bound.colour is not None or bound.textured else shown.colour
        opacity = bound.opacity if bound.opacity is not None else shown.opacity
        return dataclasses.replace(bound, colour=colour, opacity=opacity)

    def _bound(self, prim: PrimView) -> Look | None:
        """Of the material that the prim or the nearest prim above it binds."""
        above: PrimView | None = prim
        while above is not None:
            for target in above.targets("material:binding"):
                material = self._prims.get(target)
                return None if material is None else self._material(material)
            above = above.GetParent()
        return None

    def _material(self, material: PrimView) -> Look:
        found = self._materials.get(material.path)
        if found is None:
            found = self._materials[material.path] = self._read(material)
        return found

    def _read(self, material: PrimView) -> Look:
        shaders = [each for each in material.GetChildren() if each.type_name == "Shader"]
        surface = next(
            (each for each in shaders if each.authored("info:id") == "UsdPreviewSurface"), None
        )
        if surface is None:
            surface = next(iter(shaders), material)
        textured = any(each.authored("info:id") == "UsdUVTexture" for each in shaders)
        colour = next(
            (value for name in COLOURS if (value := surface.authored(name)) is not None), None
        )
        if colour is None and textured:
            warn(material.path, "its texture is not read; what it is on is drawn white")
        opacity = next(
            (value for name in OPACITIES if (value := surface.authored(name)) is not None), None
        )
        return Look(
            None if colour is None else displayed(colour),
            None if opacity is None else min(max(float(opacity), 0.0), 1.0),
            colour is None and textured,
            surface.authored("inputs:roughness"),
            surface.authored("inputs:metallic"),
        )

    def _primvars(self, prim: PrimView) -> Look:
        colour = self._inherited(prim, "primvars:displayColor")
        opacity = self._inherited(prim, "primvars:displayOpacity")
        return Look(
            None if colour is None or not len(colour) else displayed(colour[0]),
            None if opacity is None or not len(opacity) else float(opacity[0]),
        )

    def _inherited(self, prim: PrimView, name: str) -> Any:
        above: PrimView | None = prim
        while above is not None:
            value = above.authored(name)
            if value is not None:
                return value
            above = above.GetParent()
        return None
