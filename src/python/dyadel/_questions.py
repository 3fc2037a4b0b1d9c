# SPDX-License-Identifier: LGPL-3.0-or-later
"""What an engine is asked besides statuses: nearest points, graphs, tolerances, plans, convergence, proofs."""
from __future__ import annotations

import csv
import html
import math
import os
from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from . import _dyadel
from ._arrays import Floats, Ints, Longs, floats, ints, longs, offsets_of, records
from ._options import INPUTS, Path, engine_options, split_inputs, takes_options
from ._points import append_points

EVENTS = np.array(['death', 'birth', 'tie'])


class Nearest(NamedTuple):
    """points: all that may be nearest, ascending; certain: there is one, and it is certainly nearest; outcome: 'decided',
    'fixpoint', 'budget' or 'cancelled'; lo, hi: bounds of the distance of each, rounded outward; tied: all of them are
    equally far, so that no refinement makes one certain."""

    points: Ints
    certain: bool
    outcome: str
    lo: Floats
    hi: Floats
    tied: bool


def _distances(boxes: Floats, at: Sequence[float]) -> tuple[Floats, Floats]:
    """Of a place in the box `at` from each box: below and above, each of the few operations rounded outward."""
    below, above = -np.inf, np.inf
    gaps, spans = [], []
    for k in (0, 2):
        apart = np.maximum(boxes[:, k] - at[k + 1], at[k] - boxes[:, k + 1])
        gaps.append(np.maximum(np.nextafter(apart, below), 0))
        spans.append(np.nextafter(np.maximum(boxes[:, k + 1] - at[k], at[k + 1] - boxes[:, k]), above))
    lo, hi = np.hypot(*gaps), np.hypot(*spans)
    for _ in range(3):  # hypot is within an ulp or two
        lo, hi = np.nextafter(lo, below), np.nextafter(hi, above)
    return np.maximum(lo, 0), hi


def _outward(end: tuple[int, int], up: bool) -> float:
    """An exact end of a box, rounded outward."""
    whole, part = end
    try:
        near = whole / part
    except OverflowError:
        near = math.copysign(math.inf, whole)
    exact = math.isfinite(near) and Fraction(near) == Fraction(whole, part)
    return near if exact else math.nextafter(near, math.inf if up else -math.inf)


def nearest_to(engine: _dyadel.Engine, x: Any, y: Any, options: dict[str, Any]) -> Nearest:
    """See Delaunay.nearest."""
    found, certain, tied, outcome, ends = engine.nearest((x, y), options)
    points = ints(found)
    box, *boxes = ([_outward(end, k % 2 == 1) for k, end in enumerate(rect)] for rect in (ends, *map(engine.rect, points.tolist())))
    return Nearest(points, certain, outcome, *_distances(np.array(boxes).reshape(-1, 4), box), tied)


# ---- many places ----

#: What find_triangle gives where no triangle certainly holds the place.
OUTSIDE, UNDECIDED = -1, -2


class NearestPlaces(NamedTuple):
    """points[offsets[k]:offsets[k + 1]] may be nearest to place k, ascending; certain[k]: there is one, and it is certainly
    nearest. single[k] is that one, or -1."""

    points: Ints
    offsets: Longs
    certain: NDArray[np.bool_]

    @property
    def single(self) -> Ints:
        """The point that is certainly nearest to each place; -1: none is."""
        first = np.append(self.points, np.int32(-1))[self.offsets[:-1]]
        found: Ints = np.where(self.certain, first, np.int32(-1))
        return found


def places_of(xy: Any) -> tuple[Floats, tuple[int, ...]]:
    """Places as contiguous doubles (M, 2), and the shape of the answer. ValueError for what doubles do not hold."""
    given = np.asarray(xy)
    if given.ndim < 1 or given.shape[-1] != 2:
        raise ValueError(f'places must have shape (M, 2), not {given.shape}')
    try:
        places = given.astype(np.float64)
    except (TypeError, ValueError):
        raise TypeError(f'places are numbers, not of type {given.dtype}') from None
    if not np.isfinite(places).all():
        raise ValueError(f'place {int(np.argmin(np.isfinite(places).reshape(-1, 2).all(axis=1)))} is not finite')
    if given.dtype.kind != 'f' and [Fraction(x) for x in given.ravel().tolist()] != [Fraction(x) for x in places.ravel().tolist()]:
        raise ValueError('places have to be doubles; these would be rounded')
    return np.ascontiguousarray(places.reshape(-1, 2)), given.shape[:-1]


def _many(ask: Any, places: Floats) -> NearestPlaces:
    """Lists for places, which are asked in an order in which each is near to the one before."""
    order = _along(places)
    found, ends, sure = ask(places[order])
    points, counts, certain = ints(found), np.diff(longs(ends), prepend=0), np.empty(len(places), np.bool_)
    certain[order] = records(sure, np.dtype(np.bool_))
    count, at = np.empty_like(counts), np.empty_like(counts)
    count[order], at[order] = counts, longs(ends) - counts
    offsets = offsets_of(count)
    if len(points) == len(places) and (count == 1).all():
        return NearestPlaces(points[at], offsets, certain)
    return NearestPlaces(points[np.repeat(at - offsets[:-1], count) + np.arange(len(points))], offsets, certain)


def nearest_places(engine: _dyadel.Engine, xy: Any) -> NearestPlaces:
    """See Delaunay.nearest."""
    return _many(engine.nearest_places, places_of(xy)[0])


def interpolation_range(engine: _dyadel.Engine, values: Any, xy: Any, count: int) -> tuple[Floats, Floats]:
    """See Delaunay.interpolation_range."""
    given, (places, shape) = np.asarray(values), places_of(xy)
    if given.dtype.kind not in 'fiu' or given.shape != (count,):
        raise ValueError(f'values must be {count} numbers, one for each point, not {given.dtype} of shape {given.shape}')
    doubles = given.astype(np.float64)
    if given.dtype.kind != 'f' and not np.array_equal(doubles.astype(given.dtype), given):
        raise ValueError('values have to be doubles; these would be rounded')
    found = _many(engine.corners, places)
    low, high = np.full((2, len(places)), np.nan)
    if found.certain.any():
        begin, of = found.offsets[:-1][found.certain], doubles[found.points]
        low[found.certain], high[found.certain] = np.minimum.reduceat(of, begin), np.maximum.reduceat(of, begin)
    return low.reshape(shape), high.reshape(shape)


def _along(places: Floats) -> Longs:
    """An order in which each place is near to the one before: column by column, up and down."""
    step = max(1, math.isqrt(len(places)))
    by_x = np.argsort(places[:, 0])
    column = np.empty(len(places), np.int32)
    column[by_x] = np.arange(len(places)) // step
    y = np.where(column % 2, -1, 1) * places[:, 1]
    order: Longs = by_x
    for begin in range(0, len(places), step):
        part = by_x[begin:begin + step]
        order[begin:begin + step] = part[np.argsort(y[part])]
    return order


def named_triangles(simplices: Ints) -> tuple[Longs, Longs]:
    """What names each triangle, ascending, and which it is: one is on the left of the way from its first corner to the next."""
    names = simplices[:, 0].astype(np.int64) << 32 | simplices[:, 1]
    order: Longs = np.argsort(names)
    return names[order], order


def triangles_at(engine: _dyadel.Engine, named: tuple[Longs, Longs], xy: Any) -> Ints:
    """See Delaunay.find_triangle; named: of named_triangles."""
    places, shape = places_of(xy)
    order = _along(places)
    found, inside = engine.locate(np.ascontiguousarray(places[order]))
    corners, truth = ints(found).reshape(-1, 3), ints(inside)
    answer = np.where(truth < 0, OUTSIDE, UNDECIDED).astype(np.int32)
    held = truth > 0
    wanted = corners[held, 0].astype(np.int64) << 32 | corners[held, 1]
    answer[held] = named[1][np.searchsorted(named[0], wanted)]
    unordered = np.empty_like(answer)
    unordered[order] = answer
    return unordered.reshape(shape)


def interpolated(points: Floats, simplices: Ints, at: Ints, values: Any, xy: Any) -> Any:
    """See Delaunay.interpolate."""
    given = np.asarray(values)
    if given.shape[:1] != (len(points),):
        raise ValueError(f'values must have one for each of the {len(points)} points, not the shape {given.shape}')
    known = at.ravel() >= 0
    corners = simplices[at.ravel()[known]]
    a, b, c = points[corners].transpose(1, 2, 0)
    z = places_of(xy)[0][known].T

    def cross(u: Any, v: Any) -> Any:
        return u[0] * v[1] - u[1] * v[0]
    whole = cross(b - a, c - a)
    share = np.array([cross(b - z, c - z), cross(c - z, a - z), cross(a - z, b - z)]) / whole
    kind = np.result_type(given.dtype, np.float64)
    result = np.full((at.size, *given.shape[1:]), np.nan, kind)
    result[known] = np.einsum('kt,tk...->t...', share, given[corners])
    hidden = np.broadcast_to(~known.reshape(-1, *[1] * (given.ndim - 1)), result.shape)
    shape = at.shape + given.shape[1:]
    masked: Any = np.ma.MaskedArray
    return masked(result.reshape(shape), hidden.reshape(shape))


def csr_of(pairs: Ints, count: int) -> tuple[Longs, Ints]:
    """Neighbours of each of `count` points: (indptr, indices)."""
    of, to = np.concatenate((pairs, pairs[:, ::-1])).T
    return offsets_of(np.bincount(of, minlength=count)), to[np.argsort(of.astype(np.int64) * count + to)]


def around(engine: _dyadel.Engine, certain: Ints, possible: Ints) -> tuple[Ints, Ints]:
    """Both counter-clockwise, by exact directions from a place within: for the certain ones that is their order for every
    choice, as their order along the hull is one for all choices."""
    ends = {i: engine.rect(i) for i in possible.tolist()}
    at = {i: (Fraction(*rect[0]), Fraction(*rect[2])) for i, rect in ends.items()}
    inner = certain.tolist() if len(certain) > 2 else possible.tolist()
    x, y = (sum((at[i][k] for i in inner), Fraction(0)) / max(len(inner), 1) for k in range(2))

    def turn(i: int) -> Fraction:
        dx, dy = at[i][0] - x, at[i][1] - y
        share = dx / size if (size := abs(dx) + abs(dy)) else Fraction(1)
        return 1 - share if dy >= 0 else 3 + share
    turns = {i: turn(i) for i in at}

    def ordered(points: Ints) -> Ints:
        listed = sorted(points.tolist(), key=turns.__getitem__)
        first = listed.index(min(listed)) if listed else 0
        return np.array(listed[first:] + listed[:first], np.int32)
    return ordered(certain), ordered(possible)


# ---- graphs ----

GRAPHS = ('nearest', 'gabriel', 'mst')


class Graph(NamedTuple):
    """Edges i, j of a graph of neighbours. certain: edges for every choice of points, with no others as good: (C, 2);
    possible: edges for some choice, or one of several that are equally good: (P, 2). Others are edges for no choice; of
    a spanning tree of rectangles, and of discs, some that are listed may be, too. outcome: 'decided', 'fixpoint', 'budget' or 'cancelled'."""

    certain: Ints
    possible: Ints
    outcome: str


def graph_of(engine: _dyadel.Engine, name: str, options: dict[str, Any], discs: bool) -> Graph:
    """See Delaunay.graph."""
    if name not in GRAPHS:
        raise ValueError(f'graph {name!r}; give one of {", ".join(map(repr, GRAPHS))}')
    found, outcome = engine.graph(GRAPHS.index(name), options, discs)
    edges = ints(found).reshape(-1, 3)
    certain = edges[:, 2] != 0
    return Graph(edges[certain, :2], edges[~certain, :2], outcome)


# ---- tables ----


class Table(Mapping[str, NDArray[Any]]):
    """Columns by name, in order: a Mapping, so that pandas.DataFrame(dict(table)) takes it."""

    def __init__(self, columns: Mapping[str, NDArray[Any]]) -> None:
        if not isinstance(columns, Mapping):
            name = type(self).__name__
            raise TypeError(f'{name} is a result: call dyadel.{ {"Convergence": "converge", "Trials": "plan"}.get(name, name.lower()) }(points)')
        self._columns = dict(columns)

    def __getitem__(self, name: str) -> NDArray[Any]:
        return self._columns[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        """How many columns."""
        return len(self._columns)

    def save(self, path: Path) -> None:
        """Writes the columns to a csv file, numbers as Python writes them."""
        if os.path.splitext(path)[1].lower() not in ('', '.csv', '.txt', '.dat'):
            raise ValueError(f'{os.fspath(path)!r}: a table is written as csv; end the name in .csv')
        with open(path, 'w', encoding='utf-8', newline='') as file:
            out = csv.writer(file, lineterminator='\n')
            out.writerow(self)
            out.writerows(row.values() for row in self.rows)

    @property
    def rows(self) -> list[dict[str, Any]]:
        """The same row by row."""
        return [dict(zip(self, values)) for values in zip(*(column.tolist() for column in self.values()))]

    def __repr__(self) -> str:
        return f'<{type(self).__name__}: {len(self.rows)} rows of {", ".join(self)}>'

    def _repr_html_(self) -> str:
        def line(cells: Any, tag: str) -> str:
            return '<tr>' + ''.join(f'<{tag}>{html.escape(str(cell))}</{tag}>' for cell in cells) + '</tr>'
        return '<table>' + line(self, 'th') + ''.join(line(row.values(), 'td') for row in self.rows[:100]) + '</table>'


def _fields(buffer: Any, form: Mapping[str, tuple[str, int]], size: int) -> Table:
    """Columns of records as C lays them out."""
    kind = np.dtype({'names': list(form), 'formats': [f for f, _ in form.values()],
                     'offsets': [at for _, at in form.values()], 'itemsize': size})
    records = np.frombuffer(buffer, kind)
    return Table({name: records[name] for name in form})


class Tolerance(Table):
    """For each pair how far all points may move at once before it is lost (death) or found (birth): columns i, j, event,
    k, l, lo, hi; the motion is in [lo, hi] (infinite: never), k and l are the points that bind (-1: none). With sigma, a
    column probability: a lower bound of the probability that the pair is an edge.

    lo, hi: up to a motion in [self.lo, self.hi] nothing changes at all. radii: (N,) how far each may be from its place so
    that nothing changes, rounded down; None unless asked for. All in units of the points.
    """

    lo: float
    hi: float
    radii: Floats | None


def tolerance_of(engine: _dyadel.Engine, up_to: Any, points: bool, sigma: float | None, metric: str) -> Tolerance:
    """See tolerance."""
    if sigma is not None and not (isinstance(sigma, (int, float, np.number)) and 0 < sigma < np.inf):
        raise ValueError(f'sigma={sigma!r}; give a standard deviation above 0, in units of the points')
    if metric not in ('euclid', 'box'):
        raise ValueError(f"metric={metric!r}; give 'euclid' or 'box'")
    rows, (lo, hi), radii, chances = engine.tolerance(up_to, points, 0, sigma or 0.0, metric == 'box')
    table = _fields(rows, {'i': ('i4', 0), 'j': ('i4', 4), 'event': ('i4', 8), 'k': ('i4', 12), 'l': ('i4', 16),
                           'lo': ('f8', 24), 'hi': ('f8', 32)}, 40)
    chance = {} if chances is None else {'probability': floats(chances)}
    made = Tolerance({**table, 'event': EVENTS[table['event']], **chance})
    made.lo, made.hi = lo, hi
    made.radii = None if radii is None else floats(radii)
    return made


class Plan(Table):
    """Which points to measure next, in order: columns i, half_width_now (rounded up), half_width_needed (rounded down),
    pairs_decided (how many more), pairs_left. If each new position is within half_width_needed of the old one, the centre of
    its rectangle, all pairs asked for are decided except for ties there.

    undecided, ties, left: pairs that were undecided, that tie at the centres, that stay undecided.
    """

    undecided: int
    ties: int
    left: int


class Trials(Table):
    """A plan tried on drawn true points, a row for each trial: columns rounds (how often it was measured and planned again),
    points (how many were measured), measurements (how many that took), pairs_left (pairs that stay undecided)."""


def trials_of(engine: _dyadel.Engine, accuracy: Any, window: Sequence[Any] | None, site: int | None, discs: bool, trials: int,
              seed: int) -> Trials:
    """See plan."""
    rows = engine.simulate(accuracy, window, site, discs, trials, seed)
    return Trials(_fields(rows, {'rounds': ('u8', 0), 'points': ('u8', 8), 'measurements': ('u8', 16), 'pairs_left': ('u8', 24)}, 40))


def plan_of(engine: _dyadel.Engine, accuracy: Any, window: Sequence[Any] | None, site: int | None, discs: bool) -> Plan:
    """See plan."""
    rows, (undecided, ties, left) = engine.plan(accuracy, window, site, discs)
    made = Plan(_fields(rows, {'i': ('u4', 0), 'half_width_now': ('f8', 8), 'half_width_needed': ('f8', 16),
                               'pairs_decided': ('u8', 24), 'pairs_left': ('u8', 32)}, 40))
    made.undecided, made.ties, made.left = undecided, ties, left
    return made


# ---- convergence ----


CONVERGE_OF = ('delaunay', 'voronoi', 'disc', 'bisector')
WORDS = ('statuses', 'orientation', 'con', 'disjoint')


class Convergence(Table):
    """A run stage by stage: widths, pairs by status, bounds (rounded up), decisions, calls; the columns of `dyadel
    converge`. outcome: how it ended; csv: the table as the command writes it; svg: its plot, which save("run.svg") writes."""

    outcome: str
    csv: str
    svg: str

    def _repr_svg_(self) -> str:
        return self.svg

    def save(self, path: Path) -> None:
        """Writes the columns to a csv file or, if the name ends in .svg, the plot."""
        if os.path.splitext(path)[1].lower() != '.svg':
            return super().save(path)
        with open(path, 'w', encoding='utf-8') as file:
            file.write(self.svg)


def _convergence(outcome: str, text: bytes, svg: bytes) -> Convergence:
    lines = [line.split(',') for line in text.decode().splitlines()]
    made = Convergence({name: np.array(cells) if name in WORDS else _column(cells) for name, *cells in zip(*lines)})
    made.outcome, made.csv, made.svg = outcome, text.decode(), svg.decode()
    return made


def _column(cells: Sequence[str]) -> NDArray[Any]:
    """Whole numbers, or doubles (nan: not known)."""
    whole = all(cell.isdigit() for cell in cells)
    return np.array([int(cell) if whole else float(cell or 'nan') for cell in cells])


@takes_options(*INPUTS)
def converge(points: Any, radius: Any = None, window: Sequence[Any] | None = None, of: str = 'delaunay',
             times: bool = True, start_bits: int | None = None, modulus: tuple[int, int] | None = None, hindsight: int = 0,
             trace: Path | None = None, resume: Path | None = None,
             **options: Any) -> Convergence:
    """Runs the refinement and notes every stage.

    of: which bounds are computed: 'delaunay', 'voronoi' (those of the diagram on the window as well, which cost most),
    'disc' (the partial disc of the first three points and Con of the others), 'bisector' (the partial bisector of the
    first two on the window); until means these. window: of the diagram or bisector; times=False omits seconds, so
    that equal runs give equal tables. start_bits: of the first stage, 4 if not given. modulus=(A, B): instead of stages a row for
    each m from A to B: the first stage with a distance (until='area:M': an area) of at most 2^-m, bits asked, and the bits
    known a priori to suffice, by steps of 1 bit from 1 on, until 2^-B is reached. hindsight=K: a column ratio of bits_total to the
    least bits by which the goal could have been reached, of few points, found with up to K triangulations. points, radius,
    trace, resume, options: as for delaunay.
    """
    if of not in CONVERGE_OF:
        raise ValueError(f'of is {of!r}; give one of {", ".join(CONVERGE_OF)}')
    engine = _dyadel.Engine()
    append_points(engine, points, radius, **split_inputs(options))
    if modulus is not None:
        if not isinstance(modulus, (tuple, list)) or len(modulus) != 2 or not all(isinstance(m, (int, np.integer)) for m in modulus):
            raise TypeError(f'modulus={modulus!r}; give two whole numbers, the lower one first, such as (0, 40)')
        if modulus[0] > modulus[1]:
            raise ValueError(f'modulus={modulus!r}; give the lower number first')
        goal, _, bits = options.get('until', 'hausdorff:').partition(':')
        options['until'] = f'{"hausdorff" if goal == "decided" else goal}:{max(int(bits or 0), modulus[1], 0)}'
        options.setdefault('step_bits', 1)
    if of == 'voronoi' and options.get('until', 'decided').startswith(('area', 'hausdorff')):
        options['until'] = 'voronoi ' + options['until']
    ready = engine_options(start_bits=start_bits or (4 if modulus is None else 1), **options)
    if resume is not None:
        engine.recall(os.fsencode(resume))
    if trace is not None:
        engine.trace_begin(os.fsencode(trace), ready, (window, CONVERGE_OF.index(of)))
    try:
        return _convergence(*engine.converge(ready, window, CONVERGE_OF.index(of), times, hindsight, modulus))
    finally:
        engine.trace_end()


def replay(trace: Path) -> Convergence:
    """The table of a run from its trace, a file, without asking a point; its rows are compared with those in the trace.

    Error with code 'parse' and the line where they differ, or the trace is not whole.
    """
    return _convergence(*_dyadel.replay(os.fsencode(trace)))


# ---- proofs ----


class Verdict(NamedTuple):
    """What an accepted certificate states. proved: and everything that it states is proved."""

    proved: bool
    outcome: str
    report: dict[str, Any]


@takes_options(*INPUTS)
def verify(certificate: bytes, points: Any = None, radius: Any = None, sphere: bool = False,
           radius_unit: str | None = None, **options: Any) -> Verdict:
    """Checks a certificate in integers, with no code of the engine; points: and that it is about these.

    sphere: the points are longitude and latitude in degrees, radius and radius_unit are as for delaunay.

    Error with code 'parse' and the line when it is rejected.
    """
    engine = None
    inputs = split_inputs(options)
    kept: tuple[str | None, str | None, str | None] = (None, None, None)
    if points is not None:
        engine = _dyadel.Engine()
        if sphere:
            from ._sphere import append_places  # which imports this module
            kept = append_places(engine, points, radius, radius_unit, **inputs)[1:]
        else:
            append_points(engine, points, radius, **inputs)
    report = _dyadel.verify(certificate, engine, sphere, *kept, engine_options(**options))
    return Verdict(report['proved'], report['outcome'], report)
