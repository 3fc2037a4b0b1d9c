# SPDX-License-Identifier: LGPL-3.0-or-later
"""The Voronoi diagram of a triangulation on a window."""
from __future__ import annotations

import json
from collections.abc import Sequence
from fractions import Fraction
from typing import Any, NamedTuple, Protocol

import numpy as np

from . import _dyadel, _geometry
from ._arrays import Floats, Longs, Rect, exact


class Triangulation(Protocol):
    """Of what it is the diagram."""

    _engine: _dyadel.Engine

    @property
    def rows(self) -> Longs:
        """The row of each point."""

    def __len__(self) -> int:
        """How many points."""

    def certificate(self, diagram: bool, window: Sequence[Any] | None) -> bytes:
        """What proves it."""


class Cell(NamedTuple):
    """inner: a polygon (K, 2) that lies in the cell for every choice (K = 0: none known); outer: polygons that contain
    the cell for every choice. Their exact vertices are dyadic; here they are rounded to doubles. Of exact points
    both are the cell, its vertices rounded once. area: bounds, rounded outward."""

    inner: Floats
    outer: list[Floats]
    area: tuple[float, float]


def _polygon(vertices: Sequence[Sequence[str]]) -> Floats:
    return np.array([[float(exact(x)), float(exact(y))] for x, y in vertices], np.float64).reshape(-1, 2)


class Voronoi:
    """Cells with proved bounds, as they were when it was made. Iterate over it, or index it, for the cell of a point."""

    def __init__(self, d: Triangulation, window: Sequence[Any] | None = None, flatten_bits: int | None = None) -> None:
        if not hasattr(d, '_engine'):
            raise TypeError('Voronoi is made of a triangulation: call dyadel.delaunay(points).voronoi()')
        self._of, self._window, self._flatten = d, window, flatten_bits
        self.data: dict[str, Any] = json.loads(d._engine.write_voronoi('json', None, window, flatten_bits, 0))
        self._cell = {row['i']: row for row in self.data['cells']}  # by rows

    @property
    def window(self) -> Rect:
        """xlo, xhi, ylo, yhi."""
        (a, b), (c, d) = (map(exact, self.data['window'][axis]) for axis in 'xy')
        return a, b, c, d

    def _bound(self, name: str) -> Fraction | None:
        bound = self.data['bounds'][name]
        return None if bound is None else exact(bound['exact'])

    @property
    def area(self) -> Fraction | None:
        """Upper bound of the undecided area of the window; None: not known."""
        return self._bound('undetermined_area')

    @property
    def hausdorff(self) -> Fraction | None:
        """Upper bound of the distance of undecided points to the true diagram; None: not known."""
        return self._bound('distance_to_true_diagram')

    def __len__(self) -> int:
        return len(self._of)

    def __getitem__(self, i: int) -> Cell:
        if not 0 <= i < len(self):
            raise IndexError(f'there are {len(self)} points')
        i = int(self._of.rows[i])
        row = self._cell[i] if i in self._cell else self._cell[dict(self.data['aliases'])[i]]
        low, high = row['area']
        return Cell(_polygon(row['inner']), [_polygon(part) for part in row['outer']], (low, high))

    @property
    def edges(self) -> list[dict[str, Any]]:
        """i, j and the ends `from`, `to` of each certain edge: numbers in `vertices`, {'ray': bounds of a direction}, None: undecided."""
        edges: list[dict[str, Any]] = self.data['edges']
        return edges

    @property
    def vertices(self) -> list[dict[str, Any]]:
        """Enclosures x, y (pairs, rounded outward) of the vertices of certain triangles."""
        vertices: list[dict[str, Any]] = self.data['vertices']
        return vertices

    def write(self, format: str = 'csv', layer: str | None = None, epsg: int = 0) -> str | bytes:
        """The diagram, as the triangulation is now, in a format of the command."""
        return _geometry.text_of(format, self._of._engine.write_voronoi(format, layer, self._window, self._flatten, epsg))

    def certificate(self) -> bytes:
        """What proves triangulation and diagram, for verify()."""
        return self._of.certificate(True, self._window)

    @property
    def __geo_interface__(self) -> dict[str, Any]:
        """Cells as a FeatureCollection: polygons of the kinds 'certain' and 'possible', or 'exact'."""
        collection: dict[str, Any] = json.loads(self.write('geojson'))
        return collection

    def _repr_svg_(self) -> str | None:
        return _geometry.picture(self)

    def _repr_html_(self) -> str | None:
        return _geometry.page(self)

    def __repr__(self) -> str:
        known = (f'{name} {float(bound):.3g}' for name, bound in (('area', self.area), ('hausdorff', self.hausdorff))
                 if bound is not None)
        return f'<dyadel.Voronoi: {len(self)} cells, bounds {", ".join(known) or "not known"}>'
