# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Standard errors of a fit whose residuals are not independent of each other.

Neighbouring samples share what the model lacks and what sensors round, so that N samples tell less
than N independent ones. What each moment moves a parameter by is a series in time, and the variance
of the parameter is that of the sum of the series: its autocovariances are added up with weights
that fall to 0 (Newey and West, 1987), behind a filter of the first order that takes most of the
correlation out first (Andrews and Monahan, 1992).
"""

from __future__ import annotations

import numpy as np

from .log import Array

#: Samples that the filter may remember, as a part of a series: a short one does not tell more.
MOST_MEMORY = 0.1


def sum_deviation(series: Array) -> float:
    """The standard deviation of the sum of a series with mean 0, shape (T,); 1.96 of it are the
    interval of 95 %."""
    count = len(series)
    square = float(series @ series)
    if count < 8 or square <= 0:
        return float(np.sqrt(square))
    slope = float(series[1:] @ series[:-1]) / square
    # A series of this length gives a coefficient that is too small by about (1 + 4 slope) / T.
    most = 1 - 1 / max(MOST_MEMORY * count, 2.0)
    slope = float(np.clip(slope + (1 + 4 * slope) / count, -most, most))
    rest = series[1:] - slope * series[:-1]
    last = max(1, int(4 * (count / 100) ** (2 / 9)))
    whole = float(rest @ rest)
    for lag in range(1, last + 1):
        whole += 2 * (1 - lag / (last + 1)) * float(rest[lag:] @ rest[:-lag])
    whole *= count / (count - 1)
    whole = max(whole, 0.0) / (1 - slope) ** 2
    # As many as say something of their own; of few the deviation is uncertain itself, which makes
    # intervals of 95 % wider as Student's distribution does.
    few = max(count * square / max(whole, square) - 1, 3.0)
    return float(np.sqrt(whole)) * (1 + 1.21 / few)
