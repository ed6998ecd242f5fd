# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""The page of `tenon report` in notebooks: the asset to turn, its motion to play, its findings.

    import tenon_usd as tenon

    tenon.view("hand.usda")                    # the last line of a cell shows it
    tenon.view("hand.usda").save("hand.html")  # the same for a web site
"""

from __future__ import annotations

import html
import math
import os
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from . import _tenon
from ._lists import no_such
from ._tenon import Stage
from .errors import InvalidError
from .options import OpenOptions, PathLike, arguments_of, check_positive, list_of, path_of

if TYPE_CHECKING:
    from typing import Unpack

    from .world import World


class Page:
    """A page that needs nothing else, the network included. Notebooks show it in a frame.

    `html` is its text, `height` that of the frame [pixels], `triangles` how many are drawn,
    `frames` how many its motion has, `findings` how many the check has, `diagnostics` what was
    found while it was made.
    """

    def __init__(self, answer: dict[str, Any], height: int) -> None:
        self.html: str = answer["html"]
        self.height = height
        self.triangles: int = answer["triangles"]
        self.frames: int = answer["frames"]
        self.findings: int = answer["findings"]
        self.diagnostics: list[_tenon.Diagnostic] = answer["diagnostics"]

    def save(self, path: PathLike) -> None:
        """Writes the page; a file that is there is replaced, folders are made. Raises OSError."""
        _tenon.write_files(path_of(path), self.html.encode(), {})

    def __repr__(self) -> str:
        return (f"<Page of {len(self.html) // 1000} kB: {self.triangles} triangles, "
                f"{self.frames} frames, {self.findings} findings>")

    def _repr_html_(self) -> str:
        """A frame whose scripts have no access to the notebook."""
        return (f'<iframe srcdoc="{html.escape(self.html)}" sandbox="allow-scripts '
                f'allow-downloads" style="width:100%;height:{self.height}px;border:0"></iframe>')


def view(
    asset: PathLike | Stage | World,
    *,
    engine: str = "",
    pose: Sequence[str] = (),
    duration: float | None = None,
    time_step: float = 0.0,
    fps: float = 30.0,
    triangles: int = 0,
    colliders: bool = True,
    height: int = 600,
    **options: Unpack[OpenOptions],
) -> Page:
    """The page of an asset, with `duration` [s] of motion: 0 for none, None as the stage says.

    Of a World, and of a Stage, the asset is shown as its files have it: save edits first. A World
    gives its engine, time step and reading options. `pose` has texts "JOINT=VALUE" as
    `tenon report --pose`, `fps` is of the motion's frames, `triangles` draws about so many at most,
    and `height` is that of the frame [pixels]. Raises MissingError where the package was built
    without its page.
    """
    for name, value in {"duration": duration, "time_step": time_step}.items():
        if value is not None and not (value >= 0 and math.isfinite(value)):
            raise ValueError(f"{name} is {value!r}; expected seconds, 0 or more")
    check_positive(fps=fps, height=height)
    names = [str(one["name"]) for one in _tenon.engines()]
    if engine and engine not in names:
        raise InvalidError(f"engine: {no_such(engine, names)}")
    source: Any = asset
    if not isinstance(source, (str, os.PathLike, Stage)):
        if options:
            raise TypeError(f"{', '.join(options)}: a world was made with its own options")
        options = source._open_options
        engine = engine or source.engine
        time_step = time_step or source.time_step
        source = source._asset
    if isinstance(source, Stage):
        source = source.path
    if not source:
        raise InvalidError("a stage in memory has no file to show; write it with flatten() first")
    return Page(_tenon.report(path_of(source), arguments_of(options), engine,
                              list_of("pose", pose), duration, time_step, fps, triangles,
                              colliders), height)


__all__ = ["Page", "view"]
