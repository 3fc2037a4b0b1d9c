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


def exact(text: str) -> Fraction:
    """"5*2^-3", "22/7", "4"."""
    mantissa, _, exponent = text.partition('*2^')
    return Fraction(mantissa) * Fraction(2) ** int(exponent or 0)


def rect_of(ends: Any) -> Rect:
    """Four pairs (numerator, denominator)."""
    a, b, c, d = (Fraction(*end) for end in ends)
    return a, b, c, d
