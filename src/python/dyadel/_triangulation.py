# SPDX-License-Identifier: LGPL-3.0-or-later
"""Points in the plane in, statuses out: the triangulation and questions to it."""
from __future__ import annotations

import dataclasses
from collections.abc import Iterable, Sequence
from fractions import Fraction
from typing import Any, NamedTuple, overload

import numpy as np

from . import _dyadel, _geometry
from ._arrays import Floats, Ints, Longs, Rect, ints, rect_of
from ._inputs import Given, expect_same
from ._notions import Corner, corners_of
from ._options import INPUTS, Path, engine_options, split_inputs, takes_options
from ._outputs import COLOURS, plot_lines, plot_polygons
from ._points import append_given, given_of
from ._questions import (GRAPHS, Graph, Nearest, NearestPlaces, Plan, Tolerance, Trials, around, csr_of, graph_of, interpolated,
                         interpolation_range, named_triangles, nearest_places, nearest_to, plan_of, tolerance_of, trials_of,
                         triangles_at)
from ._statuses import STATUS, Statuses
from ._voronoi import Voronoi

STATUSES = np.array(STATUS, object)


class Bounds(NamedTuple):
    """Certified upper bounds: area of the region where edges may be, and its distance from the true triangulation."""

    area: Fraction
    hausdorff: Fraction


class Delaunay(Statuses):
    """Which pairs of points are edges of the Delaunay triangulation: certain, possible, tied. Made by delaunay().

    Every statement holds for all choices of points in the rectangles reached. Points are numbered from 0. Calls from
    several threads, and from callbacks, are refused while one is at work (RuntimeError), but for cancel().
    Delaunay(points, radius, **options) is delaunay(points, radius, **options) in the plane.
    """

    _engine: _dyadel.Engine

    @takes_options(*INPUTS)
    def __init__(self, points: Any = None, radius: Any = None, *, trace: Path | None = None, resume: Path | None = None,
                 **options: Any) -> None:
        super().__init__()
        self._named = self._engine = _dyadel.Engine()
        self._log: list[Given] = []
        self._measured: set[int] = set()
        if points is not None:
            with self._kept_with_errors():
                self._append(points, radius, **split_inputs(options))
                with self._traced(trace, resume, options):
                    self.refine(**options)

    # ---- runs ----

    @takes_options()
    def refine(self, **options: Any) -> Delaunay:
        """Runs until a goal is reached; options are those of delaunay, others stay as they were. Returns itself.

        No statement is taken back. After Ctrl-C or an exception of a callback all earlier statements are kept.
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
        return rect_of(self._engine.window())

    @takes_options(*INPUTS)
    def append(self, points: Any, radius: Any = None, **options: Any) -> Delaunay:
        """Adds points, numbered on, of any kind that delaunay takes and in the same reference system, and refines. Returns itself.

        Among more points a legal pair may become illegal. Only the faces around the points are worked on: one point to 10^6
        takes a millisecond, up to a sixteenth of the points at once, where no uncertain point comes to exact ones only.
        """
        self._append(points, radius, **split_inputs(options))
        return self.refine(**options)

    @takes_options()
    def remeasure(self, i: int, point: Sequence[Any], **options: Any) -> Delaunay:
        """Point i has been measured again: it also lies in (xlo, xhi, ylo, yhi), or in two intervals. Refines.

        Error with code 'contradiction' when both measurements have nothing in common; then nothing changes. Only the undecided
        faces at the point are worked on.
        """
        self._engine.remeasure(i, point)
        self._measured.add(i)
        return self.refine(**options)

    def _append(self, points: Any, radius: Any = None, **inputs: Any) -> None:
        given = given_of(points, radius, **inputs)
        given.before = sum(log.count for log in self._log) if any(log.rows is not None for log in self._log) else 0
        self._add(given)

    def _add(self, given: Given) -> None:
        expect_same(self.crs, given.crs)
        before = self._engine.count()
        self._cache = {}
        kept = append_given(self._engine, given)
        if not kept:
            given.points = given.radius = None
        given.added = self._engine.count() - before
        self.crs = self.crs or given.crs
        self._log.append(given)

    # ---- statuses ----

    def _counts(self) -> tuple[int, int, int]:
        return self._engine.counts()

    def status(self, i: int, j: int) -> str:
        """'legal', 'indeterminate', 'tie' or 'illegal'."""
        return STATUS[self._engine.pair_status(i, j)]

    def discs(self) -> Ints:
        """Pairs, as `pairs`, when each point lies in the disc inside its square: more are decided than for squares."""
        return ints(self._engine.discs()).reshape(-1, 3)

    @property
    def points(self) -> Floats:
        """(N, 2): the centre of each rectangle, rounded to doubles; points of doubles as they are."""
        return self._once('points', lambda: _geometry.centres(self.boxes))

    @property
    def vertex_neighbors(self) -> tuple[Longs, Ints]:
        """(indptr, indices): the points in legal pairs with point k are indices[indptr[k]:indptr[k + 1]], ascending.

            indptr, indices = d.vertex_neighbors
            around = indices[indptr[5]:indptr[6]]
        """
        return self._once('vertex_neighbors', lambda: csr_of(self.legal, len(self)))

    @property
    def hull(self) -> tuple[Ints, Ints]:
        """Certain corners of the convex hull, and points that may lie on its boundary (possible), counter-clockwise.

        The order of the certain ones holds for every choice; others are in that of their lower left corners, seen from within.

            certain, possible = d.hull
            ring = d.points[certain]
        """
        certain, possible = self._once('hull', lambda: around(self._engine, *map(ints, self._engine.hull())))
        return certain, possible

    @property
    def exterior(self) -> list[list[Corner]]:
        """E of T (KEL, figure 6; section 3): where no choice has an edge, the complement of the partial edges of all possible
        pairs. A ring for each component, with the component on its left, of exact vertices: the first is that of the
        unbounded one, clockwise around all partial edges, the others are polygons, counter-clockwise."""
        def found() -> list[list[Corner]]:
            text = self._engine.write('csv', 'exterior', None, 0).decode()
            return [corners_of(line.rsplit(',', 1)[0], ';') for line in text.splitlines()[1:]]
        return [list(ring) for ring in self._once('exterior', found)]

    def find_triangle(self, xy: Any) -> Ints:
        """The certain triangle that holds each place (M, 2), as a row of `simplices`: it does for every choice, or the place is
        on a side between exact points. OUTSIDE (-1): the place is outside of the hull for every choice. UNDECIDED (-2): neither
        is known, as in a region without certain triangles.

            t = d.find_triangle([[0.5, 0.5], [9, 9]])
            corners = d.simplices[t[t >= 0]]
        """
        return triangles_at(self._engine, self._once('named', lambda: named_triangles(self.simplices)), xy)

    def interpolate(self, values: Any, xy: Any) -> Any:
        """Values (N,) or (N, ...) of the points, linear on the certain triangles between their centres, at places (M, 2): a
        masked array, nan and masked where no triangle certainly holds the place.

            z = d.interpolate(heights, [[0.5, 0.5], [9, 9]])
            z.mask, z.filled(0)
        """
        return interpolated(self.points, self.simplices, self.find_triangle(xy), values, xy)

    def interpolation_range(self, values: Any, xy: Any) -> tuple[Floats, Floats]:
        """Bounds lo, hi at places (M, 2) of what linear interpolation of the values (N,) gives there, for every choice of points:
        the least and the largest value of the points that may be corners of the triangle around the place. nan: for some
        choice the place is outside of the hull.

            lo, hi = d.interpolation_range(heights, xy)
        """
        return interpolation_range(self._engine, values, xy, len(self))

    @takes_options()
    def graph(self, name: str, discs: bool = False, **options: Any) -> Graph:
        """Edges of a graph of neighbours: 'nearest' (j is nearest to i), 'gabriel' or 'mst' (minimum spanning tree). Refines
        until its edges are certain, as `dyadel delaunay --layer graph:NAME`; discs: points are in the discs in their squares;
        options: budgets of delaunay.
        """
        self._cache = {}
        return graph_of(self._engine, name, engine_options(**{**self._options, **options}), discs)

    @takes_options(runs=False)
    def write(self, format: str = 'csv', layer: str | None = None, window: Any = None, epsg: int | None = None) -> str | bytes:
        """See Statuses.write; graphs are refined first, see graph()."""
        if layer is not None and layer.startswith('graph:') and layer[6:] in GRAPHS:
            self.graph(layer[6:])
        return super().write(format, layer, window, epsg)

    def to_geodataframe(self, layer: str | None = None, crs: Any = None) -> Any:
        """A layer ('pairs', 'points', 'triangles', 'graph:mst', ...) as a GeoDataFrame; crs: by default that of the points."""
        if layer not in (None, 'pairs', 'triangles') or not np.isfinite(self.boxes).all():
            return super().to_geodataframe(layer, crs)
        of = self.simplices if layer == 'triangles' else self.pairs
        columns = self.named(**dict(zip('ijk', (of if layer == 'triangles' else of[:, :2]).T)))
        if layer != 'triangles':
            columns['status'] = STATUSES[of[:, 2]]
        rounding = _geometry.half_width(self.boxes)[of if layer == 'triangles' else of[:, :2]].max(axis=1, initial=0)
        return _geometry.frame_of(columns, self.to_wkb(layer or 'pairs'), rounding, self.crs if crs is None else crs)

    def plot(self, layer: str = 'pairs', ax: Any = None, values: Any = None, **options: Any) -> Any:
        """Draws 'pairs' by status, 'triangles', or 'tolerance' (pairs of exact points by how far all points may move) between the
        centres of the rectangles with matplotlib, on its axes `ax` or new ones, which it returns. values: a number for each
        row, shown by colour; options: of LineCollection or PolyCollection.
        """
        places = self.points
        if layer == 'triangles':
            return plot_polygons(ax, places[self.simplices], COLOURS['certain'], values, **options)
        if layer not in ('pairs', 'tolerance'):
            raise ValueError(f'layer={layer!r}; give "pairs", "triangles" or "tolerance"')
        pairs = self.pairs
        if layer == 'tolerance':
            found = self.tolerance()
            lost = found['event'] == 'death'
            pairs, values = np.column_stack((found['i'], found['j'], found['i']))[lost], found['lo'][lost]
        colours = [COLOURS.get(status, 'black') for status in STATUSES[pairs[:, 2]]] if values is None else None
        return plot_lines(ax, places[pairs[:, :2]], colours, values, **options)

    def rects(self) -> list[str]:
        """All rectangles reached, exactly: texts "XLO XHI YLO YHI", such as "1/3 1/3 5*2^-4 3*2^-3"."""
        return self._engine.rects().decode().splitlines()

    @property
    def bounds(self) -> Bounds:
        """Certified upper bounds of the undecided part (Fractions; squared units and units of the points)."""
        area, hausdorff = self._engine.bounds()
        return Bounds(Fraction(*area), Fraction(*hausdorff))

    # ---- questions ----

    @overload
    def nearest(self, x: Any) -> NearestPlaces: ...

    @overload
    def nearest(self, x: Any, y: Any, **options: Any) -> Nearest: ...

    def nearest(self, x: Any, y: Any = None, **options: Any) -> Nearest | NearestPlaces:
        """Points that may be nearest to the place (x, y), any coordinates; refines until one certainly is. Of an array of
        places (M, 2), doubles, the points that may be nearest to each, for the rectangles as they are: nothing is refined.

        options: budgets of delaunay: max_bits, max_calls, timeout.

            found = d.nearest(xy)
            known = found.single[found.certain]
        """
        if y is None:
            if options:
                raise TypeError(f'nearest() of an array refines nothing and takes no options: {", ".join(options)}')
            return nearest_places(self._engine, x)
        return self._nearest(x, y, **options)

    @takes_options()
    def _nearest(self, x: Any, y: Any, **options: Any) -> Nearest:
        self._cache = {}
        return nearest_to(self._engine, x, y, engine_options(**options))

    @takes_options()
    def voronoi(self, window: Sequence[Any] | None = None, until: str | None = None, flatten: int | None = None,
                discs: bool = False, **options: Any) -> Voronoi:
        """The Voronoi diagram on a window (xlo, xhi, ylo, yhi); default: the box of the points enlarged by half.

        discs: of points in discs, whose squares the rectangles are; without, of points in rectangles.
        flatten: polygons are within 2^-flatten of their cells (default: what suits the mean size of cells);
        until='area:M' or 'hausdorff:M' refines first, until the bound of the diagram is at most 2^-M; options are those of
        delaunay.
        """
        if until is not None:
            usual = self._options
            self.refine(until=until if until == 'decided' else f'voronoi {until}', window=window, **options)
            self._options = usual
        return Voronoi(self, window, flatten, discs)

    def tolerance(self, up_to: Any = None, points: bool = False, sigma: float | None = None,
                  metric: str = 'euclid') -> Tolerance:
        """How far the points, which have to be exact, may move: see dyadel.tolerance."""
        return tolerance_of(self._engine, up_to, points, sigma, metric)

    def plan(self, accuracy: Any = None, window: Sequence[Any] | None = None, site: int | None = None, discs: bool = False) -> Plan:
        """Which points to measure next, and how accurately: see dyadel.plan."""
        return plan_of(self._engine, accuracy, window, site, discs)

    def simulate(self, trials: int, seed: int = 1, accuracy: Any = None, window: Sequence[Any] | None = None, site: int | None = None,
                 discs: bool = False) -> Trials:
        """Tries the plan on true points that the seed draws, one in each rectangle (disc), evenly, as often as `trials` says:
        each point of the plan is measured, and planned again, until no measurement is left that decides a pair."""
        return trials_of(self._engine, accuracy, window, site, discs, trials, seed)

    def certificate(self, diagram: bool = False, window: Sequence[Any] | None = None, discs: bool = False) -> bytes:
        """What proves the result, for verify(); diagram: and its Voronoi diagram on the window; discs: of points in the
        discs that the boxes hold."""
        return self._engine.certificate(diagram or window is not None, window, discs)

    def to_wkb(self, layer: str = 'pairs') -> list[bytes]:
        """Well-known binary, one for each row of `pairs`, `simplices` ('triangles') or point ('points').

        A point is drawn at the centre of its rectangle, rounded to doubles; `boxes` holds it.
        """
        places = _geometry.centres(self.boxes)
        if layer == 'points':
            return _geometry.wkb_points(places)
        if layer == 'pairs':
            return _geometry.wkb_lines(places, self.pairs)
        if layer == 'triangles':
            return _geometry.wkb_triangles(places, self.simplices)
        raise ValueError(f'layer={layer!r}; give "pairs", "triangles" or "points"')

    # ---- pickling ----

    def __reduce__(self) -> tuple[Any, ...]:
        """The input and the rectangles reached: a copy triangulates these, and refines from there."""
        boxes, rects, first = self.boxes, self.rects(), 0
        log: list[Given] = []
        narrowed: dict[int, str] = {}
        for given in self._log:
            own = range(first, first + given.added)
            narrowed.update((i, rects[i]) for i in own if given.points is not None or i in self._measured)
            log.append(given if given.points is not None else dataclasses.replace(given, points=boxes[own.start:own.stop].copy()))
            first += given.added
        options = {name: value for name, value in self._options.items() if name != 'progress'}
        return _restore, (log, narrowed, options, self.outcome)


def _restore(log: Iterable[Given], narrowed: dict[int, str], options: dict[str, Any], outcome: str) -> Delaunay:
    d = Delaunay()
    for given in log:
        d._add(given)
    for i, rect in narrowed.items():
        d._engine.remeasure(i, rect.split())
    if outcome not in ('none', 'error'):
        d.refine(**{**options, 'max_stages': 1})
    d._options, d._outcome = options, outcome
    return d
