# SPDX-License-Identifier: LGPL-3.0-or-later
"""Points in, statuses out: delaunay and its result."""
from __future__ import annotations

import dataclasses
import json
import os
from collections.abc import Callable, Iterable, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from . import _dyadel, _geometry
from ._geometry import Floats, Ints, floats, ints
from ._options import engine_options

if TYPE_CHECKING:
    from ._questions import Nearest, Plan, Tolerance
    from ._voronoi import Voronoi

Rect = tuple[Fraction, Fraction, Fraction, Fraction]

STATUS = ('illegal', 'tie', 'indeterminate', 'legal')
TIE, INDETERMINATE, LEGAL = 1, 2, 3


@dataclasses.dataclass(frozen=True)
class Source:
    """n points served by a function.

    narrow(i, bits) gives point i as four exact numbers xlo, xhi, ylo, yhi, aiming at widths of 2^-bits, inside what it
    gave before; a fifth element True says that it can never be narrowed. Two coordinates will do as well: exact numbers,
    or intervals as pairs or as mpmath.iv has them. Where ends are not dyadic they are rounded outward.
    """

    n: int
    narrow: Callable[[int, int], Sequence[Any]]


@dataclasses.dataclass(frozen=True)
class Text:
    """The text of a points file or, with columns="NAME,NAME", of a table with a header, as the command reads them.

    measured: 47.61 is [47.605,47.615]; radius, radius_columns: each point is widened; id: column of names; the others
    as the options of the command (see `dyadel help delaunay`). Packed bytes (gzip, zstd) are read as they are.
    """

    text: str | bytes
    columns: str | None = None
    measured: bool = False
    radius: str | None = None
    radius_columns: str | None = None
    id: str | None = None
    delimiter: str | None = None
    decimal_comma: bool = False
    skip_missing: bool = False
    merge: bool = False

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


def append_points(engine: _dyadel.Engine, points: Any, radius: Any = None) -> bool:
    """Adds points of any kind; False: they are boxes of doubles, which the engine holds, and nobody need remember them."""
    if isinstance(points, (Source, Text)):
        if radius is not None:
            raise ValueError('radius is for arrays and lists of points')
        if isinstance(points, Source):
            engine.append_source(points.n, points.narrow)
        else:
            fields = [getattr(points, field.name) for field in dataclasses.fields(points)]
            engine.append_text(fields[0].encode() if isinstance(fields[0], str) else fields[0], *fields[1:])
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


class Bounds(NamedTuple):
    """Certified upper bounds: area of what may be an edge, and distance between it and the true triangulation."""

    area: Fraction
    hausdorff: Fraction


class Delaunay:
    """Which pairs of points are edges of the Delaunay triangulation: surely, possibly, by a tie. Made by delaunay().

    Every statement holds for all choices of points in the rectangles reached. Points are numbered from 0. Calls from
    several threads, and from callbacks, are refused while one is at work (RuntimeError), but for cancel().
    """

    def __init__(self) -> None:
        self._engine = _dyadel.Engine()
        self._options: dict[str, Any] = {}
        self._log: list[tuple[int, Any, Any]] = []  # what was given that boxes of doubles do not hold: (count, points, radius)
        self._measured: set[int] = set()
        self._outcome: str | None = None  # of what was pickled
        self._cache: dict[str, Any] = {}

    # ---- runs ----

    def refine(self, **options: Any) -> Delaunay:
        """Runs until a goal is reached; options are those of delaunay, others stay as they were. Returns itself.

        What was stated stays stated. Ctrl-C and exceptions of callbacks leave what is known so far.
        """
        merged = {**self._options, **options}
        if merged.get('until', '').startswith('voronoi') and merged.get('window') is None:
            merged['window'] = self._default_window()
        ready = engine_options(**merged)
        self._options = {name: value for name, value in merged.items() if name != 'timeout'}
        self._cache, self._outcome = {}, None
        self._engine.run(ready)
        return self

    def _default_window(self) -> Rect:
        """The one of diagrams, which is around the rectangles: all have to be known."""
        if self._engine.outcome() == 'none':
            self._engine.run({'max_stages': 1})
        a, b, c, d = (Fraction(*end) for end in self._engine.window())
        return a, b, c, d

    def append(self, points: Any, radius: Any = None, **options: Any) -> Delaunay:
        """Adds points, numbered on, of any kind that delaunay takes, and refines. Returns itself.

        Among more points a legal pair may become illegal.
        """
        self._append(points, radius)
        return self.refine(**options)

    def remeasure(self, i: int, point: Sequence[Any], **options: Any) -> Delaunay:
        """Point i has been measured again: it also lies in (xlo, xhi, ylo, yhi), or in two intervals. Refines.

        Error with code 'contradiction' when both measurements have nothing in common; then nothing changes.
        """
        self._engine.remeasure(i, point)
        self._measured.add(i)
        return self.refine(**options)

    def cancel(self) -> None:
        """Asks a run to end soon, with outcome 'cancelled'; from any thread."""
        self._engine.cancel()

    def _append(self, points: Any, radius: Any = None) -> None:
        before = self._engine.count()
        self._cache = {}
        kept = append_points(self._engine, points, radius)
        count = self._engine.count() - before
        self._log.append((count, points, radius) if kept else (count, None, None))

    # ---- statuses ----

    def _once(self, name: str, make: Callable[[], Any]) -> Any:
        if name not in self._cache:
            self._cache[name] = make()
        return self._cache[name]

    def __len__(self) -> int:
        """How many points."""
        return self._engine.count()

    @property
    def outcome(self) -> str:
        """'decided', 'certified' (the bound asked for holds), 'fixpoint' (no refinement decides what is open), 'budget',
        'cancelled', 'error', or 'none' before the first run."""
        return self._outcome or self._engine.outcome()

    @property
    def pairs(self) -> Ints:
        """All possible pairs, sorted: (M, 3) i, j, status with i < j; LEGAL, INDETERMINATE or TIE."""
        array: Ints = self._once('pairs', lambda: ints(self._engine.pairs(False)).reshape(-1, 3))
        return array

    def _with(self, name: str, status: int) -> Ints:
        array: Ints = self._once(name, lambda: self.pairs[self.pairs[:, 2] == status, :2])
        return array

    @property
    def legal(self) -> Ints:
        """Pairs that are edges whatever the points are: (L, 2)."""
        return self._with('legal', LEGAL)

    @property
    def indeterminate(self) -> Ints:
        """Pairs that are edges for some choice of points; narrower rectangles may decide them: (K, 2)."""
        return self._with('indeterminate', INDETERMINATE)

    @property
    def ties(self) -> Ints:
        """Pairs that are edges for some choice, which no refinement decides: exact or proved ties: (T, 2)."""
        return self._with('ties', TIE)

    def discs(self) -> Ints:
        """Pairs, as `pairs`, when each point lies in the disc inside its square: more are decided than for squares."""
        return ints(self._engine.pairs(True)).reshape(-1, 3)

    def status(self, i: int, j: int) -> str:
        """'legal', 'indeterminate', 'tie' or 'illegal'."""
        return STATUS[self._engine.pair_status(i, j)]

    def _triangles(self) -> tuple[Ints, Ints]:
        def make() -> tuple[Ints, ...]:
            return tuple(ints(b).reshape(-1, 3) for b in self._engine.triangles())
        both: tuple[Ints, Ints] = self._once('triangles', make)
        return both

    @property
    def simplices(self) -> Ints:
        """Triangles that are sure, counter-clockwise, in no particular order: (T, 3)."""
        return self._triangles()[0]

    @property
    def neighbors(self) -> Ints:
        """neighbors[t, k]: the triangle beyond the side opposite to corner k of triangle t; -1 where none is sure: (T, 3)."""
        return self._triangles()[1]

    @property
    def aliases(self) -> Ints:
        """(A, 2): point k is the same place as point j < k, which stands for it."""
        def make() -> Ints:
            alias = ints(self._engine.aliases())
            other = np.flatnonzero(alias != np.arange(len(alias)))
            return np.column_stack((other, alias[other])).astype(np.int32)
        array: Ints = self._once('aliases', make)
        return array

    @property
    def hull(self) -> tuple[Ints, Ints]:
        """Points that are surely corners of the convex hull, and those that possibly are on its boundary."""
        def make() -> tuple[Ints, ...]:
            return tuple(ints(b) for b in self._engine.hull())
        both: tuple[Ints, Ints] = self._once('hull', make)
        return both

    @property
    def boxes(self) -> Floats:
        """Rectangles reached, rounded outward to doubles: (N, 4) xlo, xhi, ylo, yhi."""
        array: Floats = self._once('boxes', lambda: floats(self._engine.boxes()).reshape(-1, 4))
        return array

    def rect(self, i: int) -> Rect:
        """The rectangle reached of point i, exactly: xlo, xhi, ylo, yhi."""
        a, b, c, d = (Fraction(*end) for end in self._engine.rect(i))
        return a, b, c, d

    def rects(self) -> list[str]:
        """All rectangles reached, exactly: texts "XLO XHI YLO YHI", such as "1/3 1/3 5*2^-4 3*2^-3"."""
        return self._engine.rects().decode().splitlines()

    @property
    def bounds(self) -> Bounds:
        """Certified upper bounds on what is open (Fractions; squared units and units of the points)."""
        area, hausdorff = self._engine.bounds()
        return Bounds(Fraction(*area), Fraction(*hausdorff))

    @property
    def counters(self) -> dict[str, Any]:
        """What it took: stages, calls, bits_least, bits_most, bits_total, seconds, spent (which budget), decisions by rung."""
        return self._engine.counters()

    # ---- questions ----

    def nearest(self, x: Any, y: Any, **options: Any) -> Nearest:
        """Which points are possibly nearest to the place (x, y), any coordinates; refines until one surely is."""
        from ._questions import nearest
        return nearest(self, x, y, options)

    def voronoi(self, window: Sequence[Any] | None = None, until: str | None = None, flatten: int | None = None,
                **options: Any) -> Voronoi:
        """The Voronoi diagram on a window (xlo, xhi, ylo, yhi); default: the box of the points enlarged by half.

        flatten: polygons are within 2^-flatten of their cells (default: what suits the mean size of cells);
        until='area:M' or 'hausdorff:M' refines first, until the bound of the diagram is at most 2^-M; options are those of
        delaunay.
        """
        from ._voronoi import Voronoi
        if until is not None:
            usual = self._options
            self.refine(until=until if until == 'decided' else f'voronoi {until}', window=window, **options)
            self._options = usual
        return Voronoi(self, window, flatten)

    def tolerance(self, up_to: Any = None, points: bool = False) -> Tolerance:
        """How far the points, which have to be exact, may move: see dyadel.tolerance."""
        from ._questions import Tolerance
        return Tolerance._of(self, up_to, points)

    def plan(self, accuracy: Any = None, window: Sequence[Any] | None = None, site: int | None = None) -> Plan:
        """Which points to measure next, and how accurately: see dyadel.plan."""
        from ._questions import Plan
        return Plan._of(self, accuracy, window, site)

    def certificate(self, diagram: bool = False, window: Sequence[Any] | None = None) -> bytes:
        """What proves the result, for verify(); diagram: and its Voronoi diagram on the window."""
        return self._engine.certificate(diagram or window is not None, window)

    # ---- formats ----

    def write(self, format: str = 'csv', layer: str | None = None, window: Sequence[Any] | None = None,
              epsg: int = 0) -> str | bytes:
        """The result in a format of the command ('csv', 'json', 'geojson', 'svg', ...); bytes of those that are no text.

        layer: 'pairs', 'points' or 'triangles'; window: what pictures show; epsg: number of the reference system.
        """
        return _geometry.text_of(format, self._engine.write(format, layer, window, epsg))

    @property
    def __geo_interface__(self) -> dict[str, Any]:
        """Pairs as a FeatureCollection of lines with i, j, status and max_coordinate_error."""
        collection: dict[str, Any] = json.loads(self._engine.write('geojson', None, None, 0))
        return collection

    def to_wkb(self, layer: str = 'pairs') -> list[bytes]:
        """Well-known binary, one for each row of `pairs`, `simplices` ('triangles') or point ('points').

        A point stands at the centre of its rectangle, rounded to doubles: `boxes` tells how far it may be from there.
        """
        return _geometry.to_wkb(self, layer)

    def _repr_svg_(self) -> str | None:
        return _geometry.picture(self)

    def _repr_html_(self) -> str | None:
        return _geometry.page(self)

    def __repr__(self) -> str:
        try:
            legal, indeterminate, ties = self._engine.counts()
        except RuntimeError as error:  # no result, or at work
            return f'<dyadel.Delaunay: {len(self)} points, {error}>'
        return (f'<dyadel.Delaunay: {len(self)} points, {self.outcome}: {legal} legal, {indeterminate} indeterminate, '
                f'{ties} ties>')

    # ---- pickling ----

    def __reduce__(self) -> tuple[Any, ...]:
        """What was given, and how far rectangles came: a copy triangulates these, and goes on from there."""
        boxes, rects, first = self.boxes, self.rects(), 0
        log: list[tuple[Any, Any]] = []
        narrowed: dict[int, str] = {}
        for count, points, radius in self._log:
            rows = range(first, first + count)
            narrowed.update((i, rects[i]) for i in rows if points is not None or i in self._measured)
            log.append((boxes[first:first + count].copy() if points is None else points, radius))
            first += count
        options = {name: value for name, value in self._options.items() if name != 'progress'}
        return _restore, (log, narrowed, options, self.outcome)


def _restore(log: Iterable[tuple[Any, Any]], narrowed: dict[int, str], options: dict[str, Any], outcome: str) -> Delaunay:
    d = Delaunay()
    for points, radius in log:
        d._append(points, radius)
    for i, rect in narrowed.items():
        d._engine.remeasure(i, rect.split())
    if outcome not in ('none', 'error'):
        d.refine(**{**options, 'max_stages': 1})
    d._options, d._outcome = options, outcome
    return d


def delaunay(points: Any, radius: Any = None, **options: Any) -> Delaunay:
    """Triangulates points that need not be known exactly.

    points   array (N, 2) of floats, taken exactly as they are, without a copy; array (N, 4) of boxes xlo, xhi, ylo, yhi;
             a list of pairs of coordinates: int, float, Fraction, Decimal, a text such as 'sqrt(2)' or '[1.2,1.3]', a
             pair of ends, numbers of numpy, gmpy2, mpmath (mpf, iv.mpf), sympy and python-flint, mixed as need be;
             a Source; a Text
    radius   half-width of the square around each point: a number, N of them, or (N, 2) for x and y; with an array of
             floats the box is rounded outward to doubles, other numbers ('0.01', Fraction, Decimal) are exact, and slow
    options  until, timeout, max_bits, max_pairs, threads, schedule, start_bits, step_bits, max_stages, max_calls, window,
             ties, tie_bits, progress: see below

    What a callback raises comes through unchanged; what fails in the library is an Error with point and stage. Either
    has an attribute `result`: the Delaunay object with all that was known before. So has KeyboardInterrupt: Ctrl-C ends
    a run.

    """
    d = Delaunay()
    try:
        d._append(points, radius)
        return d.refine(**options)
    except BaseException as error:
        _attach(error, d)
        raise


delaunay.__doc__ = f'{delaunay.__doc__}{engine_options.__doc__}'.replace('What Engine.run takes.', 'Options:')


def _attach(error: BaseException, d: Delaunay) -> None:
    """Exceptions with slots have no room for it."""
    try:
        setattr(error, 'result', d)
    except AttributeError:
        pass
