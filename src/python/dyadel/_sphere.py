# SPDX-License-Identifier: LGPL-3.0-or-later
"""Points on a sphere, given by longitude and latitude in degrees: triangulation and diagram."""
from __future__ import annotations

import dataclasses
import fractions
import json
from typing import Any, NamedTuple

import numpy as np

from . import _dyadel, _geometry
from ._arrays import Floats, Ints, floats, ints
from ._inputs import Given
from ._options import INPUTS, engine_options, takes_options
from ._outputs import Saved, format_of
from ._points import Text, append_given, given_of
from ._statuses import STATUS, Statuses

#: Options of the plane only: runs on a sphere end when all is decided.
OF_THE_PLANE = ('until', 'window')


def append_places(engine: _dyadel.Engine, points: Any, radius: Any = None,
                  radius_unit: str | None = None, **inputs: Any) -> tuple[Given, Any, str | None, Any]:
    """As append_given, of longitudes and latitudes; then the radius that is kept apart from the points, its unit and scale."""
    scale = None
    one = radius if np.ndim(radius) == 0 and not hasattr(radius, 'iloc') and radius not in getattr(points, 'columns', ()) else None
    given = given_of(points, None if radius is one else radius, **inputs)
    points, radius = given.points, given.radius if one is None else one
    if isinstance(points, Text):
        how: dict[str, Any] = dict(points.options)
        scale = how.get('radius_scale')
        radius_unit = how.get('radius_unit') if radius_unit is None else radius_unit
        if radius is None and how.get('radius') is not None:
            radius = how.pop('radius')
            points = Text(points.text, **how)
    radius = _with_unit(radius, radius_unit)
    if radius is not None and not isinstance(radius, str):
        points, radius = _with_radii(points, radius, radius_unit), None
    if given.sigma is not None:
        points = _with_sigmas(points, given.sigma, given.confidence, radius_unit)
        given.sigma = given.confidence = None
    given.points, given.radius = points, None
    if not append_given(engine, given, degrees=True):
        given.points = None
    return given, radius, radius_unit, scale


class SphereCell(NamedTuple):
    """vertices: numbers of those around the cell, counter-clockwise from outside (rows of SphereVoronoi.vertices); None
    marks an undecided region between its neighbours. complete: all around is known."""

    vertices: list[int | None]
    complete: bool


class SphereVoronoi(Saved):
    """The Voronoi diagram of a sphere, as it was when it was made. Iterate over it, or index it, for the cell of a point."""

    def __init__(self, of: Sphere) -> None:
        self._of = of
        self.data: dict[str, Any] = json.loads(of._engine.write_voronoi('json', None, None, None, 0, False))
        self._cell = {row['i']: row for row in self.data['cells']}  # by rows
        self._alias = dict(self.data['aliases'])

    def __len__(self) -> int:
        return len(self._of)

    def __getitem__(self, i: int) -> SphereCell:
        if not 0 <= i < len(self):
            raise IndexError(f'there are {len(self)} points')
        i = int(self._of.rows[i])
        row = self._cell[self._alias.get(i, i)]
        return SphereCell(row['vertices'], row['complete'])

    @property
    def vertices(self) -> Floats:
        """(V, 4): a box of degrees that holds each vertex for every choice of points: longitude lower, upper, latitude
        lower, upper. Longitudes may reach beyond 180; near a pole they may be all."""
        return np.array([row['x'] + row['y'] for row in self.data['vertices']], np.float64).reshape(-1, 4)

    @property
    def corners(self) -> Ints:
        """(V, 3): the points of which each vertex is the centre."""
        rows = np.array([[row[name] for name in 'ijk'] for row in self.data['vertices']], np.int64).reshape(-1, 3)
        return np.searchsorted(self._of.rows, rows).astype(np.int32)

    @property
    def regions(self) -> list[dict[str, Any]]:
        """Undecided regions: `sites`, the points that may meet there, and `status`: 'tie' (one vertex of them all) or
        'indeterminate'."""
        regions: list[dict[str, Any]] = self.data['regions']
        return regions

    @takes_options(runs=False)
    def write(self, format: str = 'csv', layer: str | None = None, epsg: int = 0) -> str | bytes:
        """The diagram, as the triangulation is now, in a format of the command; layer: 'cells', 'vertices' or 'regions'."""
        return _geometry.text_of(format, self._of._engine.write_voronoi(format_of(format), layer, None, None, epsg, False))

    @property
    def __geo_interface__(self) -> dict[str, Any]:
        """Cells that are known all around as a FeatureCollection of polygons, in degrees."""
        collection: dict[str, Any] = json.loads(self.write('geojson'))
        return collection

    def _repr_svg_(self) -> str | None:
        return _geometry.picture(self)

    def __repr__(self) -> str:
        complete = sum(self[i].complete for i in range(len(self)))
        return f'<dyadel.SphereVoronoi: {len(self)} cells, {complete} known all around>'


class Sphere(Statuses):
    """Which pairs of points on a sphere are neighbours: edges of their convex hull in space. Made by delaunay(sphere=True).

    As Delaunay, but that places are degrees: boxes and rectangles are longitude lower, upper, latitude lower, upper, the
    radius included; triangles are counter-clockwise from outside (of three points both sides). The earth is taken for a
    sphere. Points cannot be added.
    """

    _engine: _dyadel.Sphere

    @takes_options(*INPUTS)
    def __init__(self, points: Any, radius: Any = None, radius_unit: str | None = None, **inputs: Any) -> None:
        super().__init__()
        self._named = self._places = _dyadel.Engine()
        given, radius, unit, scale = append_places(self._places, points, radius, radius_unit, **inputs)
        self._given, self._log, self.crs = (given, radius, unit), [given], given.crs
        given.added = self._places.count()
        self._engine = _dyadel.Sphere(self._places, radius, None if radius is None else unit, scale)

    @takes_options()
    def refine(self, **options: Any) -> Sphere:
        """Runs until all is decided, or nothing more can be; options are those of delaunay. Returns itself."""
        merged = {**self._options, **options}
        for name in OF_THE_PLANE:
            if merged.get(name) not in (None, 'decided'):
                raise ValueError(f'{name}={merged[name]!r} is about the plane; remove it, or sphere=True')
        ready = engine_options(**merged)
        self._options = {name: value for name, value in merged.items() if name != 'timeout'}
        self._cache, self._outcome = {}, None
        self._engine.run(ready)
        return self

    def status(self, i: int, j: int) -> str:
        """'legal', 'indeterminate', 'tie' or 'illegal'."""
        n, alias = len(self), ints(self._engine.aliases())
        for k in (i, j):
            if not 0 <= k < n:
                raise IndexError(f'there is no point {k}; there are {n}, counted from 0')
        codes = self._once('codes', lambda: self.pairs[:, 0].astype(np.int64) * n + self.pairs[:, 1])
        code = int(min(alias[i], alias[j])) * n + int(max(alias[i], alias[j]))
        at = int(np.searchsorted(codes, code))
        return STATUS[self.pairs[at, 2]] if at < len(codes) and codes[at] == code else STATUS[0]

    def _triangles(self) -> tuple[Ints, Ints]:
        corners, _ = super()._triangles()
        return corners, self._once('neighbors', lambda: beyond_sides(corners, len(self)))

    @property
    def centre(self) -> int | None:
        """The point that the others were projected from."""
        return self._engine.centre()

    def voronoi(self) -> SphereVoronoi:
        """The Voronoi diagram."""
        return SphereVoronoi(self)

    def certificate(self) -> bytes:
        """What proves the statuses, for verify()."""
        return self._engine.certificate(False, None, False)

    def __reduce__(self) -> tuple[Any, ...]:
        """The points given: a copy is triangulated anew."""
        options = {name: value for name, value in self._options.items() if name != 'progress'}
        given, radius, unit = self._given
        if given.points is None:
            given = dataclasses.replace(given, points=floats(self._places.boxes()).reshape(-1, 4).copy())
        return _restore_sphere, ((given, radius, unit), options, self.outcome)


def beyond_sides(corners: Ints, n: int) -> Ints:
    """As Statuses.neighbors: the triangle that has the side of corner k the other way round."""
    begin, end = np.roll(corners, -1, 1).astype(np.int64).ravel(), np.roll(corners, -2, 1).astype(np.int64).ravel()
    side, turned = begin * n + end, end * n + begin
    order = np.argsort(side)
    at = np.searchsorted(side, turned, sorter=order).clip(max=max(len(side) - 1, 0))
    found = order[at] if len(side) else order
    return np.where(side[found] == turned, found // 3, -1).astype(np.int32).reshape(-1, 3)


def _with_unit(radius: Any, unit: str | None) -> Any:
    """A radius of all points as a text; others as they are. Without a unit it is refused."""
    if radius is None:
        return None
    one = isinstance(radius, str) or not (isinstance(radius, (list, tuple)) or np.ndim(radius))
    bare = [r for r in ([radius] if one else radius) if not (isinstance(r, str) and r[-1:].isalpha()) and not (np.ndim(r) == 0 and r in (0, '0'))]
    if unit is None and bare:
        raise ValueError(f"the radius {radius!r:.60} has no unit; state a unit: radius_unit='m' (m, mm, cm, km, ft, in, deg, "
                         'arcmin or arcsec)')
    if not one or isinstance(radius, str):
        return radius
    return str(fractions.Fraction(radius.item() if isinstance(radius, np.generic) else radius))


def _as_text(value: Any) -> str:
    """A number as a points file has it, exactly."""
    return value if isinstance(value, str) else str(fractions.Fraction(value.item() if isinstance(value, np.generic) else value))


def _with_radii(points: Any, radii: Any, unit: str | None) -> Text:
    """A table of points with a radius each."""
    rows, radii = list(points), list(radii)
    if len(rows) != len(radii):
        raise ValueError(f'radius has {len(radii)} values for {len(rows)} points')
    if any(np.ndim(r) for r in radii):
        raise ValueError('on the globe a point has one radius, not one for x and one for y')
    text = ''.join(f'"{_as_text(x)}","{_as_text(y)}","{_as_text(r)}"\n' for (x, y), r in zip(rows, radii))
    return Text('x,y,r\n' + text, columns='x,y', radius_columns='r', radius_unit=unit)


def _with_sigmas(points: Any, sigma: Floats, confidence: str | None, unit: str | None) -> Text:
    """A table of points with their standard deviations and correlation."""
    text = ''.join(f'"{_as_text(x)}","{_as_text(y)}",{",".join(map(_as_text, s))}\n' for (x, y), s in zip(points, sigma))
    return Text('x,y,sx,sy,rho\n' + text, columns='x,y', sigma_column='sx,sy,rho', confidence=confidence,
                radius_unit=unit)


def _restore_sphere(made: tuple[Given, Any, Any], options: dict[str, Any], outcome: str) -> Sphere:
    d = Sphere(*made)
    if outcome not in ('none', 'error'):
        d.refine(**options)
    d._options, d._outcome = options, outcome
    return d
