# SPDX-License-Identifier: LGPL-3.0-or-later
"""Memory of the library as arrays, and what arrays and exact numbers are called."""
from __future__ import annotations

from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

Ints = NDArray[np.int32]
Floats = NDArray[np.float64]
Longs = NDArray[np.int64]
#: xlo, xhi, ylo, yhi
Rect = tuple[Fraction, Fraction, Fraction, Fraction]


def ints(buffer: Any) -> Ints:
    """Memory of the library as numbers, without a copy."""
    return np.frombuffer(buffer, np.int32)


def longs(buffer: Any) -> Longs:
    """Memory of the library as numbers, without a copy."""
    return np.frombuffer(buffer, np.int64)


def floats(buffer: Any) -> Floats:
    """Memory of the library as numbers, without a copy."""
    return np.frombuffer(buffer, np.float64)


def records(buffer: Any, kind: np.dtype[Any]) -> NDArray[Any]:
    """Memory of the library as structures, without a copy."""
    return np.frombuffer(buffer, kind)


def offsets_of(counts: NDArray[Any]) -> Longs:
    """Offsets of parts with these numbers of items: where each begins, then where the last one ends."""
    return np.concatenate((np.zeros(1, np.int64), np.cumsum(counts, dtype=np.int64)))


def rect_of(ends: Any) -> Rect:
    """Four pairs (numerator, denominator)."""
    a, b, c, d = (Fraction(*end) for end in ends)
    return a, b, c, d
