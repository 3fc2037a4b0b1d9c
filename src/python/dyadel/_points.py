# SPDX-License-Identifier: LGPL-3.0-or-later
"""Points of all kinds into an engine: arrays, lists of numbers, functions, texts."""
from __future__ import annotations

import dataclasses
import os
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from . import _dyadel
from ._arrays import Floats


@dataclasses.dataclass(frozen=True)
class Source:
    """n points served by a function.

    narrow(i, bits) gives point i as four exact numbers xlo, xhi, ylo, yhi, aiming at widths of 2^-bits, inside what it
    gave before; a fifth element True says that it can never be narrowed. Two coordinates will do as well: exact numbers,
    or intervals as pairs or as mpmath.iv has them. Where ends are not dyadic they are rounded outward.
    """

    n: int
    narrow: Callable[[int, int], Sequence[Any]]


@dataclasses.dataclass(frozen=True, init=False)
class Text:
    """The text of a points file or, with columns='NAME,NAME', of a table with a header, as the command reads them.

    Options are fields of dyd_read_options (dyadel/io.h): measured=True reads 47.61 as [47.605,47.615]; radius and
    radius_columns widen each point; cost_column, sigma_column and id name columns that belong to each point;
    keep_radii=True makes radii in columns the weights of `tolerance`; the others are options of the command (see `dyadel
    help delaunay`). Packed bytes (gzip, zstd) are read as they are.
    """

    text: str | bytes
    options: dict[str, str | bool | None]

    def __init__(self, text: str | bytes, columns: str | None = None, **options: str | bool | None):
        if 'degrees' in options:
            raise TypeError('degrees is no option of Text; give sphere=True to the call that takes the text')
        object.__setattr__(self, 'text', text)
        object.__setattr__(self, 'options', {'columns': columns, **options})

    @classmethod
    def from_file(cls, path: str | os.PathLike[str], **how: Any) -> Text:
        """The text of a file."""
        with open(path, 'rb') as file:
            return cls(file.read(), **how)


def _as_array(points: Any) -> Floats | None:
    """An array of doubles with the same numbers, or None where there is none: lists, objects, integers beyond 2^53."""
    if isinstance(points, (list, tuple)) or not hasattr(points, '__array__'):
        return None
    array = np.asarray(points)
    if array.dtype == np.float64:
        return array
    if array.dtype.kind == 'f' and array.dtype.itemsize < 8:
        return array.astype(np.float64)
    small = array.dtype.kind in 'iu' and (not array.size or (array.max() <= 2**53 and array.min() >= -2**53))
    return array.astype(np.float64) if small else None


def _radius_array(radius: Any, n: int) -> Floats | None:
    """Doubles (n, 2) with the same numbers, or None where there are none."""
    if isinstance(radius, (int, float)) and (isinstance(radius, float) or abs(radius) <= 2**53):
        array = np.asarray(float(radius))
    else:
        found = _as_array(radius)
        if found is None:
            return None
        array = found
    if array.ndim == 1:
        array = array[:, np.newaxis]
    return np.broadcast_to(array, (n, 2))


def _radius_list(radius: Any, n: int) -> list[Any]:
    """(rx, ry) for each of n points."""
    if isinstance(radius, (list, tuple)) or hasattr(radius, '__array__') and np.ndim(radius):
        radii = list(radius)
        if len(radii) != n:
            raise ValueError(f'{len(radii)} radii of {n} points')
    else:
        radii = [radius] * n
    return [tuple(r) if isinstance(r, (list, tuple, np.ndarray)) else (r, r) for r in radii]


def _append_boxes(engine: _dyadel.Engine, boxes: Floats) -> None:
    if np.array_equal(boxes[:, 0::2], boxes[:, 1::2]):
        engine.append_array(boxes[:, 0::2], None)
    else:
        engine.append_boxes(*(np.ascontiguousarray(boxes[:, k]) for k in range(4)))


def append_points(engine: _dyadel.Engine, points: Any, radius: Any = None, degrees: bool = False) -> bool:
    """Adds points of any kind; False: they are boxes of doubles, which the engine holds, and nobody need remember them.

    degrees: a text is told where a latitude is beyond 90.
    """
    if isinstance(points, (Source, Text)):
        if radius is not None:
            raise ValueError('radius is for arrays and lists of points')
        if isinstance(points, Source):
            engine.append_source(points.n, points.narrow)
        else:
            text = points.text.encode() if isinstance(points.text, str) else points.text
            engine.append_text(text, {**points.options, 'degrees': degrees})
        return True
    array = _as_array(points)
    by = None if array is None or radius is None else _radius_array(radius, len(array))
    if array is not None and (radius is None or by is not None):
        if array.ndim == 2 and array.shape[1] == 4 and by is None:
            _append_boxes(engine, array)
        else:
            engine.append_array(array if array.dtype.isnative else array.astype(np.float64), by)
        return False
    rows = list(points)
    engine.append_values([tuple(row) if isinstance(row, np.ndarray) else row for row in rows],
                         None if radius is None else _radius_list(radius, len(rows)))
    return True
