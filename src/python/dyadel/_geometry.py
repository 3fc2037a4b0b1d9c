# SPDX-License-Identifier: LGPL-3.0-or-later
"""Pictures for notebooks, and geometries for other programs."""
from __future__ import annotations

import dataclasses
import html
import importlib
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _dyadel
from ._arrays import Floats, Ints, Longs, offsets_of

FORMATS = {name: binary for name, _, binary in _dyadel.formats()}
#: Larger results are shown in words: notebooks keep every picture in their file.
MOST_POINTS_SHOWN = 20_000


def text_of(format: str, written: bytes) -> str | bytes:
    """Text of formats that are texts, bytes of the others."""
    return written if FORMATS[format] else written.decode()


def centres(boxes: Floats) -> Floats:
    """(N, 2): the middle of each box, rounded; exact for points."""
    return boxes[:, 0::2] / 2 + boxes[:, 1::2] / 2 if boxes.size else boxes[:, :2]


def half_width(boxes: Floats) -> Floats:
    """How far the middle of each box, rounded, is from its ends at most."""
    middle = centres(boxes)
    out: Floats = np.nextafter(np.maximum(boxes[:, 1::2] - middle, middle - boxes[:, 0::2]).max(axis=1, initial=0), np.inf)
    return out


def _records(head: list[tuple[str, Any]], coordinates: Floats) -> list[bytes]:
    """Little-endian records: numbers of one byte or four, then doubles."""
    count, size = coordinates.shape
    kind = np.dtype([(f'h{k}', form) for k, (form, _) in enumerate(head)] + [('xy', '<f8', (size,))])
    record = np.empty(count, kind)
    for k, (_, value) in enumerate(head):
        record[f'h{k}'] = value
    record['xy'] = coordinates
    blob = record.tobytes()
    return [blob[k:k + kind.itemsize] for k in range(0, len(blob), kind.itemsize)]


def shapes_of(wkb: list[bytes]) -> NDArray[np.object_]:
    """An array of geometries of shapely."""
    shapely: Any = importlib.import_module('shapely')
    if hasattr(shapely, 'from_wkb'):
        shapes: NDArray[np.object_] = shapely.from_wkb(np.array(wkb, object))
        return shapes
    load = importlib.import_module('shapely.wkb').loads  # before shapely 2
    return np.fromiter(map(load, wkb), object, len(wkb))


def frame_of(columns: dict[str, Any], wkb: list[bytes], rounding: Any, crs: Any) -> Any:
    """A GeoDataFrame. rounding: a bound of the error of the coordinates."""
    geopandas: Any = importlib.import_module('geopandas')
    return geopandas.GeoDataFrame({**columns, 'max_coordinate_error': rounding}, geometry=shapes_of(wkb), crs=crs)


def wkb_points(places: Floats) -> list[bytes]:
    """Well-known binary of places (N, 2)."""
    return _records([('u1', 1), ('<u4', 1)], places)


def wkb_lines(places: Floats, pairs: Ints) -> list[bytes]:
    """Of the lines between them."""
    return _records([('u1', 1), ('<u4', 2), ('<u4', 2)], places[pairs[:, :2]].reshape(-1, 4))


def wkb_triangles(places: Floats, simplices: Ints) -> list[bytes]:
    """Of triangles among them."""
    ring = simplices[:, [0, 1, 2, 0]]
    return _records([('u1', 1), ('<u4', 3), ('<u4', 1), ('<u4', 4)], places[ring].reshape(-1, 8))


@dataclasses.dataclass(frozen=True, eq=False)
class Rings:
    """Polygons as ragged arrays. The vertices of ring r, counter-clockwise and without a repeated one at the end, are
    coordinates[offsets[r]:offsets[r + 1]], which is rings[r].

    points[r]: the point whose ring it is; rounding[r]: how far each vertex is at most from its exact place in each
    coordinate.

        tiles = dyadel.delaunay(points).voronoi().tiles
        polygons, of = tiles.to_shapely(), tiles.points
        ring = tiles[0]                                   # (K, 2)
    """

    points: Ints
    offsets: Longs
    coordinates: Floats
    rounding: Floats

    def __len__(self) -> int:
        """How many rings."""
        return len(self.points)

    def __getitem__(self, r: int) -> Floats:
        if not 0 <= r < len(self):
            raise IndexError(f'there are {len(self)} rings')
        return self.coordinates[self.offsets[r]:self.offsets[r + 1]]

    def select(self, chosen: Any) -> Rings:
        """Those for which the mask (R,) is true."""
        counts = np.diff(self.offsets)
        return Rings(self.points[chosen], offsets_of(counts[chosen]), self.coordinates[np.repeat(chosen, counts)],
                     self.rounding[chosen])

    def closed(self) -> tuple[Longs, Floats]:
        """offsets and coordinates with the first vertex of each ring repeated at its end, as shapely and GeoArrow have them."""
        offsets = self.offsets + np.arange(len(self) + 1)
        place = np.arange(offsets[-1]) - np.repeat(np.arange(len(self)), np.diff(offsets))
        place[offsets[1:] - 1] = self.offsets[:-1]
        return offsets, self.coordinates[place]

    def to_wkb(self) -> list[bytes]:
        """Well-known binary of a polygon for each ring."""
        offsets, coordinates = self.closed()
        count = np.diff(offsets)
        begin = 13 * np.arange(len(self) + 1) + 16 * offsets
        head = np.zeros(len(self), np.dtype([('order', 'u1'), ('kind', '<u4'), ('rings', '<u4'), ('count', '<u4')]))
        head['order'], head['kind'], head['rings'], head['count'] = 1, 3, 1, count
        record = np.empty(begin[-1], np.uint8)
        is_head = np.repeat(np.tile([True, False], len(self)), np.column_stack((np.full_like(count, 13), 16 * count)).ravel())
        record[is_head] = head.view(np.uint8)
        record[~is_head] = coordinates.astype('<f8', copy=False).reshape(-1).view(np.uint8)
        blob, ends = record.tobytes(), begin.tolist()
        return [blob[a:b] for a, b in zip(ends, ends[1:])]

    def to_shapely(self) -> NDArray[np.object_]:
        """An array of shapely polygons, one for each ring."""
        shapely: Any = importlib.import_module('shapely')
        if not hasattr(shapely, 'from_ragged_array'):
            return shapes_of(self.to_wkb())
        offsets, coordinates = self.closed()
        polygons: NDArray[np.object_] = shapely.from_ragged_array(
            shapely.GeometryType.POLYGON, coordinates, (offsets, np.arange(len(self) + 1)))
        return polygons

    def __repr__(self) -> str:
        return f'<dyadel.Rings: {len(self)} polygons, {len(self.coordinates)} vertices>'


#: What Edges.ends has where an edge ends in an undecided region, or does not end.
OPEN, RAY = -1, -2


@dataclasses.dataclass(frozen=True, eq=False)
class Enclosures:
    """Boxes (K, 4) xlo, xhi, ylo, yhi that hold something for every choice of points, and the points about which it is: those of
    row k are points[offsets[k]:offsets[k + 1]], which is rows[k].

    Vertices: of certain triangles, then of ties; their boxes hold the vertex (infinite: not known). Regions: of undecided faces;
    their boxes hold all vertices that may be there, in the window. faces: their numbers; of vertices none.
    """

    boxes: Floats
    offsets: Longs
    points: Ints
    faces: Ints | None = None

    def __len__(self) -> int:
        """How many rows."""
        return len(self.boxes)

    def __getitem__(self, k: int) -> Ints:
        if not 0 <= k < len(self):
            raise IndexError(f'there are {len(self)} rows')
        return self.points[self.offsets[k]:self.offsets[k + 1]]

    @property
    def centres(self) -> Floats:
        """(K, 2): the middle of each box; nan where it is not finite."""
        with np.errstate(invalid='ignore'):
            middle = centres(self.boxes)
        return np.where(np.isfinite(self.boxes).all(axis=1)[:, np.newaxis], middle, np.nan)

    @property
    def corners(self) -> Ints:
        """(K, 3): the first three points of each row, which name a vertex."""
        return self.points[self.offsets[:-1, np.newaxis] + np.arange(3)]

    def to_wkb(self) -> list[bytes]:
        """Well-known binary: the centre of each vertex (empty where it is not known), the box of each region."""
        if self.faces is None:
            return wkb_points(self.centres)
        return _records([('u1', 1), ('<u4', 3), ('<u4', 1), ('<u4', 5)], self.boxes[:, [0, 2, 1, 2, 1, 3, 0, 3, 0, 2]])

    def to_shapely(self) -> NDArray[np.object_]:
        """An array of shapely points, or polygons."""
        return shapes_of(self.to_wkb())

    def __repr__(self) -> str:
        return f'<dyadel.Enclosures: {len(self)} {"vertices" if self.faces is None else "regions"}>'


@dataclasses.dataclass(frozen=True, eq=False)
class Edges:
    """Certain edges of a Voronoi diagram, one for each legal pair.

    pairs (E, 2): the points i < j on its sides; ends (E, 2): the numbers of the vertices that it ends at, on the left of the way
    from i to j, and on its right; OPEN (-1): in an undecided region; RAY (-2): nowhere. coordinates (E, 2, 2): the centres of the
    enclosures of both ends, of a ray a place on it beyond the window; nan: not known. rounding (E,): how far they are at most
    from there in each coordinate. rays (R, 2): edge and end of each ray; directions (R, 4): bounds dxlo, dxhi, dylo, dyhi of
    a vector along it.
    """

    pairs: Ints
    ends: Longs
    coordinates: Floats
    rounding: Floats
    rays: Longs
    directions: Floats

    @classmethod
    def of(cls, edges: Any, rays: Any, vertices: Floats) -> Edges:
        """From records of the library, and the boxes of the vertices."""
        ends = edges['end']
        drawn = np.vstack((vertices, rays['box'], np.full((1, 4), np.nan)))
        at = np.where(ends >= 0, ends, np.where(ends == OPEN, len(drawn) - 1, len(vertices) + RAY - ends))
        boxes = drawn[at].reshape(-1, 4)
        boxes[~np.isfinite(boxes).all(axis=1)] = np.nan
        kind = np.where(ends > OPEN, ends, np.maximum(ends, RAY))
        where = np.argwhere(ends <= RAY)
        return cls(np.column_stack((edges['i'], edges['j'])).astype(np.int32), kind, centres(boxes).reshape(-1, 2, 2),
                   half_width(boxes).reshape(-1, 2).max(axis=1), where, rays['direction'][RAY - ends[tuple(where.T)]])

    def __len__(self) -> int:
        """How many edges."""
        return len(self.pairs)

    @property
    def drawn(self) -> NDArray[np.bool_]:
        """(E,): both ends are known."""
        known: NDArray[np.bool_] = np.isfinite(self.coordinates).all(axis=(1, 2))
        return known

    def to_wkb(self) -> list[bytes]:
        """Well-known binary of a line for each edge; empty where an end is not known."""
        lines = _records([('u1', 1), ('<u4', 2), ('<u4', 2)], self.coordinates.reshape(-1, 4))
        return [line if known else b'\1\2' + bytes(7) for line, known in zip(lines, self.drawn.tolist())]

    def to_shapely(self) -> NDArray[np.object_]:
        """An array of shapely lines."""
        return shapes_of(self.to_wkb())

    def __repr__(self) -> str:
        return f'<dyadel.Edges: {len(self)} edges, {int(self.drawn.sum())} with two known ends>'


def _is_shown(d: Any) -> bool:
    return len(d) <= MOST_POINTS_SHOWN and getattr(d, 'outcome', '') != 'none'


def picture(d: Any) -> str | None:
    """svg; None where a text says more."""
    return str(d.write('svg')) if _is_shown(d) else None


def page(d: Any) -> str | None:
    """html: the page that one can touch, in a frame of its own."""
    if not _is_shown(d):
        return None
    inner = html.escape(str(d.write('html')), quote=True)
    return f'<iframe srcdoc="{inner}" sandbox="allow-scripts" width="100%" height="600" frameborder="0"></iframe>'
