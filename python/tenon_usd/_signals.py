# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Where long calls of the library let Python see to its signals (src/interruptions.cpp)."""

from __future__ import annotations

import atexit
import sys


def look() -> None:
    """Does nothing: that it runs is what raises KeyboardInterrupt here, and what other
    threads sent with PyThreadState_SetAsyncExc."""


def _wait() -> None:
    from . import _tenon

    # A program that Ctrl-C ends does not wait, and destroys nothing that calls may still use.
    ended_by = getattr(sys, "last_exc", None) or getattr(sys, "last_value", None)
    if not isinstance(ended_by, KeyboardInterrupt):
        _tenon.wait_for_left_calls()
    _tenon.end_looks()


atexit.register(_wait)
