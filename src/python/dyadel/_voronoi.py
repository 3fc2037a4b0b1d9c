# SPDX-License-Identifier: LGPL-3.0-or-later
"""The Voronoi diagram of a triangulation on a window."""
from __future__ import annotations

import functools
import json
from collections.abc import Iterator, Sequence
from fractions import Fraction
from typing import Any, NamedTuple, Protocol

import numpy as np

from . import _dyadel, _geometry
from ._arrays import Floats, Ints, Longs, Rect, floats, ints, longs, records, rect_of
from ._inputs import epsg_of
from ._geometry import OPEN, Edges, Enclosures, Rings
from ._options import takes_options
from ._outputs import COLOURS, Saved, format_of, plot_polygons


#: Columns, well-known binary, and how far coordinates were rounded.
LayerRows = tuple[dict[str, Any], list[bytes], Floats]


def box_columns(boxes: Floats) -> dict[str, Floats]:
    """As the command names them."""
    return dict(zip(('xlo', 'xhi', 'ylo', 'yhi'), boxes.T))


class Triangulation(Protocol):
    """The triangulation of a diagram."""

    crs: Any
    _engine: _dyadel.Engine
    _cache: dict[str, Any]

    @property
    def rows(self) -> Longs:
        """The row of each point."""

    @property
    def ids(self) -> list[str] | None:
        """The identifier of each point."""

    @property
    def carried(self) -> dict[str, Any]:
        """Columns given as `carry`."""

    @property
    def aliases(self) -> Ints:
        """Points that are the same place as others."""

    def named(self, **points: Ints) -> dict[str, Any]:
        """Columns that name points."""

    def certificate(self, diagram: bool, window: Sequence[Any] | None, discs: bool) -> bytes:
        """What proves it."""


class Cell(NamedTuple):
    """inner: a polygon (K, 2) that lies in the cell for every choice (K = 0: none known); outer: polygons that contain
    the cell for every choice. Their exact vertices are dyadic; here they are rounded to doubles. Of exact points
    both are the cell, its vertices rounded once. area: bounds, rounded outward."""

    inner: Floats
    outer: list[Floats]
    area: tuple[float, float]


KINDS = np.array(['', 'certain', 'possible', 'exact'])
EDGE = np.dtype([('i', np.uint32), ('j', np.uint32), ('end', np.int64, 2)])
RAYS = np.dtype([('direction', np.float64, 4), ('box', np.float64, 4)])
RING = np.dtype([('point', np.int32), ('kind', np.uint32), ('end', np.int64), ('rounding', np.float64)])


class Voronoi(Saved):
    """Cells with proved bounds, as they were when it was made. Iterate over it, or index it, for the cell of a point.

        v = dyadel.delaunay(points, radius=0.1).voronoi()
        v.certain.to_shapely(), v.certain.points          # polygons inside the cells, and whose they are
        v.areas                                           # bounds of the areas
    """

    def __init__(self, d: Triangulation, window: Sequence[Any] | None = None, flatten_bits: int | None = None,
                 discs: bool = False) -> None:
        if not hasattr(d, '_engine'):
            raise TypeError('Voronoi is made of a triangulation: call dyadel.delaunay(points).voronoi()')
        self._of, self._window, self._flatten, self._made, self._discs = d, window, flatten_bits, d._cache, discs
        rings, xy, areas, self._bits, area, hausdorff, ends = d._engine.cells(window, flatten_bits, discs)
        ring = records(rings, RING)
        self._rings = Rings(ring['point'], np.concatenate((np.zeros(1, np.int64), ring['end'])), floats(xy).reshape(-1, 2),
                            ring['rounding'])
        self._kind, self._areas = ring['kind'], floats(areas).reshape(-1, 2)
        self._ends, self._bounds = rect_of(ends), (Fraction(*area), None if hausdorff is None else Fraction(*hausdorff))

    @property
    def window(self) -> Rect:
        """xlo, xhi, ylo, yhi."""
        return self._ends

    @property
    def area(self) -> Fraction:
        """Upper bound of the undecided area of the window."""
        return self._bounds[0]

    @property
    def hausdorff(self) -> Fraction | None:
        """Upper bound of the distance of undecided points to the true diagram; None: not known."""
        return self._bounds[1]

    # ---- cells ----

    def _with(self, kind: int) -> Rings:
        chosen = self._kind & kind != 0
        return self._rings if chosen.all() else self._rings.select(chosen)

    @functools.cached_property
    def certain(self) -> Rings:
        """Polygons that lie in the cells for every choice of points, at most one for each point. Of exact points the cells."""
        return self._with(1)

    @functools.cached_property
    def possible(self) -> Rings:
        """Polygons outside of which the cells are for no choice; a point may have several. Of exact points the cells."""
        return self._with(2)

    @property
    def areas(self) -> Floats:
        """(N, 2): bounds of the area of each cell on the window, for every choice, rounded outward."""
        return self._areas

    def exact_area(self, i: int) -> Fraction | None:
        """The area of the cell of point i on the window; None where it depends on points that are not exact."""
        self._expect_unchanged()
        area = self._of._engine.exact_area(i, self._ends)
        return None if area is None else Fraction(*area)

    @functools.cached_property
    def _tiles(self) -> tuple[Rings, Floats, Floats]:
        self._expect_unchanged()
        points, offsets, xy, areas, bounds, rounding = self._of._engine.tiles(self._ends, self._bits)
        rings = Rings(ints(points), longs(offsets) if len(ints(points)) else np.zeros(1, np.int64),
                      floats(xy).reshape(-1, 2), np.full(len(ints(points)), rounding))
        return rings, floats(areas), floats(bounds).reshape(-1, 2)

    @property
    def tiles(self) -> Rings:
        """A partition of the window: the diagram of the centres of the rectangles. Its polygons share their vertices bit by
        bit, and their areas have that of the window as their sum.
        """
        return self._tiles[0]

    def _expect_unchanged(self) -> None:
        """Raises RuntimeError once the triangulation has changed: a later answer would belong to another diagram."""
        if self._of._cache is not self._made:
            raise RuntimeError('the triangulation has changed since this diagram was made; call voronoi() again')

    @functools.cached_property
    def _starts(self) -> list[int]:
        """Where the rings of each point begin, and where the last ones end."""
        starts: list[int] = np.searchsorted(self._rings.points, np.arange(len(self._areas) + 1)).tolist()
        return starts

    @functools.cached_property
    def _alias(self) -> dict[int, int]:
        return {int(k): int(j) for k, j in self._of.aliases}

    def __len__(self) -> int:
        return len(self._areas)

    def __getitem__(self, i: int) -> Cell:
        if not 0 <= i < len(self):
            raise IndexError(f'there are {len(self)} points')
        of = self._alias.get(i, i)
        rings = [(self._kind[r], self._rings[r]) for r in range(self._starts[of], self._starts[of + 1])]
        inner = [ring for kind, ring in rings if kind & 1]
        low, high = self._areas[i].tolist()
        return Cell(inner[0] if inner else np.empty((0, 2)), [ring for kind, ring in rings if kind & 2], (low, high))

    def __iter__(self) -> Iterator[Cell]:
        return (self[i] for i in range(len(self)))

    @functools.cached_property
    def data(self) -> dict[str, Any]:
        """What the command writes as json."""
        self._expect_unchanged()
        found: dict[str, Any] = json.loads(self._of._engine.write_voronoi('json', None, self._window, self._flatten, 0, self._discs))
        return found

    @functools.cached_property
    def _frame(self) -> tuple[Enclosures, Enclosures, Edges]:
        self._expect_unchanged()
        count, found, ends, sites, faces, edges, rays = self._of._engine.frame(self._ends, self._bits, self._discs)
        boxes, points, offsets = floats(found).reshape(-1, 4), ints(sites), np.append(0, longs(ends))
        behind = offsets[count]
        return (Enclosures(boxes[:count], offsets[:count + 1], points[:behind]),
                Enclosures(boxes[count:], offsets[count:] - behind, points[behind:], ints(faces)),
                Edges.of(records(edges, EDGE), records(rays, RAYS), boxes[:count]))

    @property
    def vertices(self) -> Enclosures:
        """Enclosures of the vertices of certain triangles and of ties, inside the window and outside."""
        return self._frame[0]

    @property
    def regions(self) -> Enclosures:
        """Boxes of the undecided regions that reach into the window."""
        return self._frame[1]

    @property
    def edges(self) -> Edges:
        """Certain edges, between `vertices`."""
        return self._frame[2]

    @takes_options(runs=False)
    def write(self, format: str = 'csv', layer: str | None = None, epsg: int | None = None) -> str | bytes:
        """Returns the diagram, as the triangulation is now, as a text in a format of the command (bytes of binary formats);
        save() writes a file. epsg: number of the reference system; None: that of the points, if it has one."""
        number = epsg_of(self._of.crs) if epsg is None else epsg
        return _geometry.text_of(format, self._of._engine.write_voronoi(format_of(format), layer, self._window, self._flatten, number,
                                                                               self._discs))

    def certificate(self) -> bytes:
        """What proves triangulation and diagram, for verify()."""
        return self._of.certificate(True, self._window, self._discs)

    def to_geodataframe(self, layer: str = 'cells', crs: Any = None) -> Any:
        """A layer of the command ('cells', 'tiles', 'vertices', 'edges', 'regions') as a GeoDataFrame.

        crs: by default that of the points. Rows are named by `i`, as `rows` of the triangulation, and by `id`; columns carried are texts.
        """
        layers = {'cells': self._cell_rows, 'tiles': self._tile_rows, 'vertices': self._vertex_rows, 'edges': self._edge_rows,
                  'regions': self._region_rows}
        if layer not in layers:
            raise ValueError(f'there is no layer {layer!r}; give one of {", ".join(map(repr, layers))}')
        return _geometry.frame_of(*layers[layer](), self._of.crs if crs is None else crs)

    def _named(self, points: Ints) -> dict[str, Any]:
        """Rows, identifiers and carried columns of points."""
        columns = self._of.named(i=points)
        for name, column in self._of.carried.items():
            taken = name in columns or name in ('kind', 'area', 'area_lo', 'area_hi', 'geometry')
            columns[name + '_2' * taken] = np.asarray(column, object if isinstance(column, list) else None)[points]
        return columns

    def _cell_rows(self) -> LayerRows:
        rings, area = self._rings, self._areas[self._rings.points].T
        columns = {'kind': KINDS[self._kind], **self._named(rings.points), 'area_lo': area[0], 'area_hi': area[1]}
        return columns, rings.to_wkb(), rings.rounding

    def _tile_rows(self) -> LayerRows:
        rings, area, bounds = self._tiles
        columns = {**self._named(rings.points), 'area': area, 'area_lo': bounds[:, 0], 'area_hi': bounds[:, 1]}
        return columns, rings.to_wkb(), rings.rounding

    def _vertex_rows(self) -> LayerRows:
        v, window = self.vertices, np.array([float(end) for end in self._ends])
        b = v.boxes
        chosen = np.isfinite(b).all(axis=1) & (b[:, ::2] <= window[1::2]).all(axis=1) & (window[::2] <= b[:, 1::2]).all(axis=1)
        i, j, k = v.corners[chosen].T
        return ({**self._of.named(i=i, j=j, k=k), **box_columns(b[chosen])}, _geometry.wkb_points(v.centres[chosen]),
                _geometry.half_width(b[chosen]))

    def _edge_rows(self) -> LayerRows:
        e, v, rows = self.edges, self.vertices, self._of.rows
        drawn = np.flatnonzero(e.drawn)
        i, j = e.pairs[drawn].T
        ends, lines = {}, e.to_wkb()
        sums = np.add.reduceat(v.points, v.offsets[:-1], dtype=np.int64) if len(v) else np.zeros(0, np.int64)
        for at, side in zip(e.ends[drawn].T, ('left', 'right')):
            few = (at > OPEN) & (np.diff(v.offsets, append=0)[at] == 3)
            ends[side] = np.where(at == OPEN, 'open', 'ray').astype(object)
            ends[side][few] = rows[sums[at[few]] - i[few] - j[few]].astype(str)
            for k in np.flatnonzero((at > OPEN) & ~few).tolist():
                ends[side][k] = ' '.join(map(str, rows[v[int(at[k])][:3]].tolist()))
        return {**self._of.named(i=i, j=j), **ends}, [lines[k] for k in drawn.tolist()], e.rounding[drawn]

    def _region_rows(self) -> LayerRows:
        r = self.regions
        sites = [' '.join(map(str, self._of.rows[r[k]].tolist())) for k in range(len(r))]
        return {'face': r.faces, **box_columns(r.boxes), 'sites': sites}, r.to_wkb(), np.zeros(len(r))

    def plot(self, layer: str = 'cells', ax: Any = None, values: Any = None, **options: Any) -> Any:
        """Draws 'cells' (possible ones behind certain ones) or 'tiles' with matplotlib, on its axes `ax` or new ones, which it
        returns. values: a number for each point, shown by colour; options: of PolyCollection.
        """
        if layer not in ('cells', 'tiles'):
            raise ValueError(f'layer={layer!r}; give "cells" or "tiles"')
        kinds = [('exact', self.tiles)] if layer == 'tiles' else [('possible', self.possible), ('certain', self.certain)]
        for kind, rings in kinds:
            shown = None if values is None else np.asarray(values)[rings.points]
            ax = plot_polygons(ax, [rings[r] for r in range(len(rings))], COLOURS[kind], shown, **options)
        return ax

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
