# SPDX-License-Identifier: LGPL-3.0-or-later
"""Points as users have them (arrays, masked arrays, DataFrames, geometries) as arrays of doubles or lists of numbers.

Neither pandas, shapely nor geopandas is imported here: their objects bring them.
"""
from __future__ import annotations

import dataclasses
import re
import sys
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._arrays import Floats, Longs
from ._errors import Error

#: Texts that mean a missing coordinate, as in a file of points.
MISSING = ('', 'na', 'n/a', '#n/a', 'nan', 'null', 'none', '-', '<na>')
ORDERS = {'xxyy': [0, 1, 2, 3], 'xyxy': [0, 2, 1, 3]}
masked: Any = np.ma
BOUNDS = ['minx', 'miny', 'maxx', 'maxy']


@dataclasses.dataclass
class Given:
    """points: an array of doubles (N, 2), (N, 4) xlo, xhi, ylo, yhi, a list of pairs, a Source or a Text. rows: the number of
    each point's row among `count`; None: none was skipped. ids: a text for each point, or None. sigma: standard deviations in
    x and y and their correlation, (N, 3), that points are still to be widened by; uncertain: how many it was."""

    points: Any
    radius: Any = None
    rows: Longs | None = None
    count: int = 0
    ids: list[str] | None = None
    crs: Any = None
    sigma: Floats | None = None
    confidence: str | None = None
    uncertain: int = 0
    carry: dict[str, NDArray[Any]] = dataclasses.field(default_factory=dict)  # columns next to the points
    before: int = 0  # rows of the points before
    added: int = 0  # points

    def leave_out(self, missing: NDArray[np.bool_], skip: bool, what: str) -> None:
        """Skips rows that are missing, or raises an Error that names them."""
        gone = np.flatnonzero(missing)
        if gone.size and not skip:
            shown = ', '.join(map(str, gone[:3])) + (f' and {gone.size - 3} more' if gone.size > 3 else '')
            raise Error(f'row{"s" * (gone.size > 1)} {shown} of points: {what} (skip_missing=True leaves such rows out)',
                        point=int(gone[0]))
        if gone.size:
            kept = np.flatnonzero(~missing)
            self.points, self.radius, self.ids, self.sigma = (
                _rows_of(value, kept, len(missing)) for value in (self.points, self.radius, self.ids, self.sigma))
            self.carry = {name: column[kept] for name, column in self.carry.items()}
            self.rows = kept if self.rows is None else self.rows[kept]


def _rows_of(value: Any, kept: Longs, count: int) -> Any:
    """Those rows of a value that has `count`; one for all stays."""
    if isinstance(value, np.ndarray):
        return value[kept] if value.ndim and len(value) == count else value
    return [value[k] for k in kept] if isinstance(value, (list, tuple)) and len(value) == count else value


def doubles_of(value: Any) -> Floats | None:
    """An array of doubles with the same numbers, or None where there is none: lists, objects, integers beyond 2^53."""
    if isinstance(value, (list, tuple)) or not hasattr(value, '__array__'):
        return None
    array = np.asarray(value)
    if array.dtype == np.float64:
        return array
    if array.dtype.kind == 'f' and array.dtype.itemsize < 8:
        return array.astype(np.float64)
    small = array.dtype.kind in 'iu' and (not array.size or (array.max() <= 2**53 and array.min() >= -2**53))
    return array.astype(np.float64) if small else None


# ---- reference systems ----


def epsg_of(crs: Any) -> int:
    """The number of a reference system given as 2056, 'EPSG:2056', or by pyproj; 0: none is known."""
    if isinstance(crs, str) and crs.upper().startswith('EPSG:'):
        return int(crs[5:])
    number = crs if isinstance(crs, int) else crs.to_epsg() if hasattr(crs, 'to_epsg') else None
    return number or 0


def expect_same(crs: Any, other: Any) -> None:
    """ValueError where both reference systems are known and differ."""
    if crs is not None and other is not None and not (epsg_of(crs) == epsg_of(other) if epsg_of(crs) and epsg_of(other) else crs == other):
        raise ValueError(f'these points have the reference system {other}, the others {crs}; pass points.to_crs(d.crs)')


def is_geographic(crs: Any) -> bool:
    """True where coordinates are known to be degrees."""
    return bool(getattr(crs, 'is_geographic', epsg_of(crs) == 4326))


# ---- all kinds ----


def refuse_mirrored(names: list[str]) -> None:
    """Columns that are latitude and longitude by their names, or northing and easting, would be a mirrored map."""
    if len(names) == 2 and any(re.search(y, names[0], re.I) and re.search(x, names[1], re.I) for y, x in
                               ((r'^lat|_lat$|latitude', r'^lon|^lng|_lon$|_lng$|longitude'), (r'^northing|^hochwert', r'^easting|^rechtswert'))):
        raise ValueError(f'by their names the columns are {names[0]} and {names[1]}; x, or longitude, comes first: pass '
                         f'df[[{names[1]!r}, {names[0]!r}]], or df.to_numpy() if this order is meant')


def refuse_other_index(points: Any, **columns: Any) -> None:
    """Columns of a frame in another order of rows than the points would give each point the value of another."""
    for name, column in columns.items():
        if hasattr(points, 'iloc') and hasattr(column, 'iloc') and not column.index.equals(points.index):
            raise ValueError(f'{name} has another index than points; pass {name}.reindex(points.index), or {name}.to_numpy() if the '
                             'rows are in the order of points')


def take(points: Any, radius: Any = None, *, order: str | None = None, skip_missing: bool = False, ids: Any = None,
         crs: Any = None, sigma: Any = None, confidence: float | str | None = None, carry: Any = None) -> Given:
    """Points of any kind but Source and Text, and their radius, in plain form."""
    if order not in (None, *ORDERS):
        raise ValueError(f"order={order!r}; give 'xxyy' (xlo, xhi, ylo, yhi) or 'xyxy' (minx, miny, maxx, maxy)")
    if isinstance(points, (dict, str, bytes)) or not hasattr(points, '__iter__') and not hasattr(points, 'geom_type'):
        raise TypeError(f'points is of type {type(points).__name__}; give an array (N, 2) or (N, 4), a list of pairs, a DataFrame, a '
                        f'Source or a Text{", such as numpy.column_stack((xs, ys))" * isinstance(points, dict)}')
    refuse_mirrored([str(name) for name in getattr(points, 'columns', ())])
    refuse_other_index(points, radius=radius, ids=ids, sigma=sigma, carry=carry)
    crs = getattr(points, 'crs', None) if crs is None else crs
    if isinstance(radius, str):
        radius = _radius_named(points, radius)
    if isinstance(ids, str):
        if ids not in getattr(points, 'columns', ()):
            raise ValueError(f'ids={ids!r}: points have no such column; give one text for each point')
        ids = points[ids]
    carried = _carried(points, carry)
    names = [sigma] if isinstance(sigma, str) else sigma if isinstance(sigma, (list, tuple)) else ()
    if names and all(isinstance(name, str) and name in getattr(points, 'columns', ()) for name in names):
        sigma = np.column_stack([np.asarray(_column(points[name]), np.float64) for name in names])
    points = getattr(points, 'geometry', points) if hasattr(points, 'columns') else points
    missing: NDArray[np.bool_] | None = None
    framed = hasattr(points, 'columns')
    if framed:
        points, order = _frame(points, order)
    elif hasattr(points, 'geom_type') or _are_geometries(points):
        points = _places(points)
    elif hasattr(points, 'iloc') or hasattr(points, '__array__') and np.ndim(points) != 2:
        points = _pairs(np.asarray(points))
    if masked.isMaskedArray(points):
        missing = masked.getmaskarray(points).any(axis=1)
        points = masked.getdata(points)
    points = points if hasattr(points, '__len__') else list(points)
    given = Given(_matrix(points), _radii(radius), count=len(points), crs=crs, carry=carried)
    for name, column in carried.items():
        if len(column) != given.count:
            raise ValueError(f'column {name!r} of carry has {len(column)} values for {given.count} points')
    if ids is not None:
        given.ids = [str(name) for name in ids]
        if len(given.ids) != given.count:
            raise ValueError(f'{len(given.ids)} ids for {given.count} points')
    if sigma is not None or confidence is not None:
        given.confidence = str(confidence)
        given.sigma = _sigmas(given, sigma, confidence)
    if missing is not None:
        given.leave_out(missing, skip_missing, 'the coordinates are masked')
    _leave_out_unknown(given, skip_missing, skip_missing or framed)
    if isinstance(given.points, np.ndarray) and given.points.shape[1] == 4:
        given.points = _ordered(given.points, order)
    elif order is not None and not framed:
        raise ValueError(f'order={order!r} is for boxes, points of shape (N, 4)')
    return given


def _radius_named(points: Any, radius: str) -> Any:
    """The column of that name, or the number that the text is."""
    names = list(getattr(points, 'columns', ()))
    if radius in names:
        return points[radius]
    if not any(c.isdigit() for c in radius) and names:
        raise ValueError(f'radius={radius!r}: points have no such column; they have {", ".join(map(str, names))}')
    if re.fullmatch(r'\s*[-+.\d/e*^]*\d\s*[A-Za-z]+\s*', radius):
        raise ValueError(f'the radius {radius!r} has a unit, but radii in the plane are in the unit of the coordinates: give a number')
    return radius


def _carried(points: Any, carry: Any) -> dict[str, NDArray[Any]]:
    """Columns of the points ('all', a name, or names), or given separately: a DataFrame, or a dict of arrays."""
    if carry is None:
        return {}
    own = [name for name in getattr(points, 'columns', ()) if name != 'geometry']
    names = own if isinstance(carry, str) and carry == 'all' else [carry] if isinstance(carry, str) else carry
    table = carry if hasattr(carry, 'keys') else points
    for name in names:
        if name not in (table.keys() if table is carry else own):
            raise ValueError(f'carry: points have no column {name!r}' + (f'; they have {", ".join(map(str, own))}' if own else ''))
    return {str(name): np.asarray(table[name]) for name in names}


def _leave_out_unknown(given: Given, skip: bool, look: bool) -> None:
    """Rows without a coordinate (of lists if `look`), and those without a radius."""
    if isinstance(given.points, np.ndarray):
        if given.points.size and np.isnan(np.sum(given.points)):
            given.leave_out(np.isnan(given.points).any(axis=1), skip, 'a coordinate is nan, not a finite number')
    elif look:
        given.leave_out(np.array([_is_missing(row) for row in given.points], bool), skip, 'a coordinate is missing')
    if given.sigma is not None:
        given.leave_out(np.isnan(given.sigma).any(axis=1), skip, 'the standard deviation is missing')
        if not ((given.sigma[:, :2] >= 0).all() and np.isfinite(given.sigma).all() and (np.abs(given.sigma[:, 2]) <= 1).all()):
            raise ValueError('sigma: standard deviations are finite numbers >= 0, correlations numbers from -1 to 1')
    hidden = masked.isMaskedArray(given.radius)
    if hidden or isinstance(given.radius, np.ndarray) and given.radius.dtype.kind == 'f':
        unknown = masked.getmaskarray(given.radius) if hidden else np.isnan(given.radius)
        given.radius = masked.getdata(given.radius)
        if unknown.any():
            each = unknown.reshape(len(unknown), -1).any(axis=1) if unknown.ndim else np.full(len(given.points), True)
            if len(each) != len(given.points):
                raise ValueError(f'radius must be one number, or have {len(given.points)} values (one for each point), not {len(each)}')
            given.leave_out(each, skip, 'the radius is missing')


def _is_missing(row: Any) -> bool:
    """True for None, nan or a text such as NA instead of a point or a coordinate."""
    if row is None:
        return True
    return isinstance(row, (list, tuple, np.ndarray)) and any(
        value is None or isinstance(value, str) and value.strip().lower() in MISSING
        or not isinstance(value, (str, list, tuple)) and _is_nan(value) for value in row)


def _is_nan(value: Any) -> bool:
    """For numbers that are not themselves: nan of floats, numpy, Decimal, mpmath."""
    different = value != value  # noqa: PLR0124
    return isinstance(different, (bool, np.bool_)) and bool(different)


def _pairs(array: NDArray[Any]) -> list[Any]:
    """The elements of a Series or an array of objects, such as pairs; numbers in one dimension have to be paired first."""
    if array.ndim == 1 and array.dtype.kind == 'O':
        return list(array)
    hint = ' z pass numpy.column_stack((z.real, z.imag))' if array.dtype.kind == 'c' else ' x and y pass numpy.column_stack((x, y))'
    raise ValueError(f'points must have shape (N, 2) or (N, 4), not {array.shape}{("; of" + hint) * (array.ndim == 1)}')


def _matrix(points: Any) -> Any:
    """An array of doubles (N, 2) or (N, 4), or a list of rows."""
    array = doubles_of(points)
    if array is None:
        return [tuple(row) if isinstance(row, np.ndarray) else row for row in points]
    if array.ndim != 2 or array.shape[1] not in (2, 4):
        hint = '; pass points.T' * (array.shape[0] == 2) or '; pass points[:, :2]' * (array.shape[1:] == (3,))
        raise ValueError(f'points must have shape (N, 2) or (N, 4), not {array.shape}{hint}')
    return array


def _radii(radius: Any) -> Any:
    """A Series as its values."""
    return _column(radius) if hasattr(radius, 'iloc') else radius


def _sigmas(given: Given, sigma: Any, confidence: Any) -> Floats:
    """Standard deviations in x and y and their correlation, (N, 3); nan where they are missing."""
    if sigma is None or confidence is None:
        raise ValueError('sigma and confidence go together; give both, such as sigma=0.5, confidence=0.95')
    if given.radius is not None:
        raise ValueError('radius is a bound, sigma a standard deviation; give one of them')
    array = masked.filled(masked.asarray(_radii(sigma), np.float64), float('nan'))
    n = given.count
    if array.ndim > 2 or array.ndim and array.shape not in ((n,), (n, 1), (n, 2), (n, 3)):
        raise ValueError(f'sigma must be one number, or have shape ({n},), ({n}, 2) for x and y, or ({n}, 3) with their '
                         f'correlation, not {array.shape}')
    out = np.zeros((n, 3))
    array = array[:, np.newaxis] if array.ndim == 1 else array
    out[:, :max(2, array.shape[-1] if array.ndim else 0)] = array
    return out


# ---- boxes ----


def _overlap(low: Floats, high: Floats) -> float:
    """The share of pairs of intervals that overlap."""
    count = len(low)
    apart = count * count - np.searchsorted(np.sort(low), high, 'right').sum()
    return 1 - 2 * float(apart) / max(count * (count - 1), 1)


def _looks_like_bounds(boxes: Floats) -> bool:
    """True where all rows are rectangles minx, miny, maxx, maxy, and as xlo, xhi, ylo, yhi one is inverted, or most overlap
    and are the larger ones."""
    a, b, c, d = boxes.T
    if not len(boxes) or (a > c).any() or (b > d).any():
        return False
    if (a > b).any() or (c > d).any():
        return True
    return len(a) > 1 and _overlap(a, b) > 0.5 and _overlap(c, d) > 0.5 and float(np.sum(b - a + d - c)) > float(np.sum(c - a + d - b))


def _ordered(boxes: Floats, order: str | None) -> Floats:
    """As xlo, xhi, ylo, yhi."""
    if order is None and _looks_like_bounds(boxes):
        raise ValueError("every row of points is a rectangle as (minx, miny, maxx, maxy), but not as (xlo, xhi, ylo, yhi): give "
                         "order='xyxy' for the first, as of gdf.bounds, or order='xxyy' for the second")
    return boxes if order is None else boxes[:, np.array(ORDERS[order])]


# ---- pandas ----


def _column(series: Any) -> Any:
    """The values of a column: floats where they are floats, else a list; missing ones are nan."""
    if isinstance(series.dtype, np.dtype) and series.dtype.kind != 'O':
        return series.to_numpy()
    values = [float('nan') if _is_missing([value]) or value is getattr(series.array, 'na_value', None) or str(value) == '<NA>'
              else value for value in series]
    if all(isinstance(value, float) or isinstance(value, int) and abs(value) <= 2**53 for value in values):
        return np.array(values, np.float64)
    return values


def _frame(frame: Any, order: str | None) -> tuple[Any, str | None]:
    """The rows of a DataFrame of two columns, or of four of boxes."""
    names = list(frame.columns)
    if set(BOUNDS) <= set(names):
        frame, order, names = frame[BOUNDS], 'xyxy', BOUNDS
    if len(names) not in (2, 4):
        raise ValueError(f'points is a DataFrame with the columns {", ".join(map(str, names))}; pass the two columns of '
                         "coordinates, such as df[['x', 'y']]")
    columns = [_column(frame.iloc[:, k]) for k in range(len(names))]
    for name, column in zip(names, columns):
        if isinstance(column, np.ndarray) and column.dtype.kind not in 'fiub':
            raise TypeError(f'column {name!r} of points has values of type {column.dtype}, not numbers')
    doubles = [column for column in map(doubles_of, columns) if column is not None]
    if len(doubles) == len(columns):
        return np.column_stack(doubles), order
    lists = [column.tolist() if isinstance(column, np.ndarray) else column for column in columns]
    if len(lists) == 4:
        lists = [list(zip(*(lists[k] for k in ORDERS[order or 'xxyy'][side:side + 2]))) for side in (0, 2)]
    return list(zip(*lists)), order


# ---- geometries ----


def _are_geometries(points: Any) -> bool:
    """A list or an array of objects whose first known one is a geometry of shapely."""
    if not isinstance(points, (list, tuple, np.ndarray)) or isinstance(points, np.ndarray) and points.dtype != object:
        return False
    return hasattr(next((point for point in points if point is not None), None), 'geom_type')


def _places(geometries: Any) -> Floats:
    """The coordinates of points; nan for missing and empty ones."""
    one = not isinstance(geometries, (list, tuple, np.ndarray)) and isinstance(geometries.geom_type, str)
    parts = list(getattr(geometries, 'geoms', [geometries]) if one else geometries)
    for k, point in enumerate(parts):
        if point is not None and not point.is_empty and point.geom_type != 'Point':
            raise TypeError(f'element {k} of points is a {point.geom_type}, not a Point (take points.centroid, or '
                            'points.explode() of a MultiPoint)')
    fast = getattr(sys.modules['shapely'], 'get_x', None)
    if fast is not None:  # shapely 2
        return np.column_stack((fast(parts), sys.modules['shapely'].get_y(parts))).reshape(-1, 2)
    return np.array([(float('nan'),) * 2 if point is None or point.is_empty else (point.x, point.y) for point in parts],
                    np.float64).reshape(-1, 2)
