# SPDX-License-Identifier: LGPL-3.0-or-later
"""Points of all kinds into an engine: arrays, lists of numbers, functions, texts."""
from __future__ import annotations

import dataclasses
import os
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np

from . import _dyadel
from ._arrays import Floats
from ._inputs import Given, doubles_of, take


@dataclasses.dataclass(frozen=True)
class Source:
    """n points served by a function.

    narrow(i, bits) gives point i as four exact numbers xlo, xhi, ylo, yhi, aiming at widths of 2^-bits, inside its
    earlier answers; a fifth element True says that it can never be narrowed. Two coordinates will do as well, intervals as pairs
    or as mpmath.iv has them; two plain numbers state that the point is exactly there, for good, so never return a pair of
    rounded ones.
    """

    n: int
    narrow: Callable[[int, int], Sequence[Any]]

    def __post_init__(self) -> None:
        if not isinstance(self.n, (int, np.integer)) or not callable(self.narrow):
            raise TypeError(f'Source({self.n!r}, {self.narrow!r}); give the number of points, then the function')


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
            raise TypeError('degrees is not an option of Text; give sphere=True to the call that takes the text')
        object.__setattr__(self, 'text', text)
        object.__setattr__(self, 'options', {'columns': columns, **options})

    @classmethod
    def from_file(cls, path: str | os.PathLike[str], **how: Any) -> Text:
        """The text of a file."""
        with open(path, 'rb') as file:
            return cls(file.read(), **how)


class Confidence(NamedTuple):
    """With at least this probability (a decimal) all n points with errors lie within k standard deviations."""

    probability: str
    k: float
    n: int


def _radius_array(radius: Any, n: int) -> Floats | None:
    """Doubles (n, 2) with the same numbers, or None where there are none."""
    if isinstance(radius, (int, float)) and (isinstance(radius, float) or abs(radius) <= 2**53):
        array = np.asarray(float(radius))
    else:
        found = doubles_of(radius)
        if found is None:
            return None
        array = found
    if array.ndim not in (0, 1, 2) or array.ndim and array.shape not in ((n,), (1,), (n, 1), (n, 2), (1, 2)):
        raise ValueError(f'radius must be one number, or have shape ({n},) or ({n}, 2), not {array.shape}')
    return np.broadcast_to(array[:, np.newaxis] if array.ndim == 1 else array, (n, 2))


def _radius_list(radius: Any, n: int) -> list[Any]:
    """(rx, ry) for each of n points."""
    if isinstance(radius, (list, tuple)) or hasattr(radius, '__array__') and np.ndim(radius):
        radii = list(radius)
        if len(radii) != n:
            raise ValueError(f'radius must be one number, or have {n} values (one for each point), not {len(radii)}')
    else:
        radii = [radius] * n
    return [tuple(r) if isinstance(r, (list, tuple, np.ndarray)) else (r, r) for r in radii]


def _append_boxes(engine: _dyadel.Engine, boxes: Floats) -> None:
    if np.array_equal(boxes[:, 0::2], boxes[:, 1::2]):
        engine.append_array(boxes[:, 0::2], None)
    else:
        engine.append_boxes(*(np.ascontiguousarray(boxes[:, k]) for k in range(4)))


def given_of(points: Any, radius: Any = None, **inputs: Any) -> Given:
    """Points and radius in plain form; inputs: order, skip_missing, ids, crs, sigma, confidence."""
    if isinstance(points, Given):
        return points
    if not isinstance(points, (Source, Text)):
        return take(points, radius, **inputs)
    if radius is not None:
        raise ValueError('radius is for arrays and lists of points' + '; give Text(..., radius=...)' * isinstance(points, Text))
    ids, crs = inputs.pop('ids', None), inputs.pop('crs', None)
    wrong = [name for name, value in inputs.items() if value] + ['ids'] * (ids is not None and isinstance(points, Text))
    if wrong:
        raise ValueError(f'{wrong[0]} is for arrays and lists of points' + ('; a Text has the options id and skip_missing'
                                                                            * isinstance(points, Text)))
    if ids is not None and len(ids) != getattr(points, 'n', 0):
        raise ValueError(f'{len(ids)} ids for {getattr(points, "n", 0)} points')
    return Given(points, None, None, getattr(points, 'n', 0), None if ids is None else [str(name) for name in ids], crs)


def append_given(engine: _dyadel.Engine, given: Given, degrees: bool = False) -> bool:
    """Adds points in plain form, with their names; False: they are boxes of doubles, which the engine holds.

    degrees: a latitude beyond 90 in a text is an error.
    """
    _confide(engine, given)
    kept = _append(engine, given.points, given.radius, degrees)
    if given.ids is not None or given.rows is not None or given.before:
        rows = np.arange(given.count) if given.rows is None else given.rows
        engine.name(np.ascontiguousarray(rows + given.before, np.uintp), given.ids)
    return kept


def _confide(engine: _dyadel.Engine, given: Given) -> None:
    """States the confidence; radii become half-widths, rounded up, of boxes that hold the ellipses of errors."""
    if given.sigma is not None:
        given.uncertain = int(np.count_nonzero(given.sigma[:, :2].any(axis=1)))
    stated = None if given.confidence is None else engine.confidence(given.confidence, given.uncertain)
    if stated and given.sigma is not None:
        of = given.sigma[:, :2]
        given.radius, given.sigma = np.where(of > 0, np.nextafter(of * stated[1], np.inf), 0), None


def append_points(engine: _dyadel.Engine, points: Any, radius: Any = None, **inputs: Any) -> bool:
    """The same from points of any kind."""
    return append_given(engine, given_of(points, radius, **inputs))


def _append(engine: _dyadel.Engine, points: Any, radius: Any, degrees: bool) -> bool:
    if isinstance(points, Source):
        engine.append_source(points.n, points.narrow)
        return True
    if isinstance(points, Text):
        text = points.text.encode() if isinstance(points.text, str) else points.text
        engine.append_text(text, {**points.options, 'degrees': degrees})
        return True
    array = doubles_of(points)
    by = None if array is None or radius is None else _radius_array(radius, len(array))
    if array is not None and (radius is None or by is not None):
        if array.shape[1] == 4 and by is None:
            _append_boxes(engine, array)
        else:
            engine.append_array(array if array.dtype.isnative else array.astype(np.float64), by)
        return False
    rows = list(points)
    engine.append_values([tuple(row) if isinstance(row, np.ndarray) else row for row in rows],
                         None if radius is None else _radius_list(radius, len(rows)))
    return True
