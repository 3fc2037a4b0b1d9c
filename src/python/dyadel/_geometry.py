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
    """bytes of what is no text."""
    return written if FORMATS[format] else written.decode()


def centres(boxes: Floats) -> Floats:
    """(N, 2): the middle of each box, rounded; exact for points."""
    return boxes[:, 0::2] / 2 + boxes[:, 1::2] / 2 if boxes.size else boxes[:, :2]


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
        if not hasattr(shapely, 'from_ragged_array'):  # before shapely 2
            load = importlib.import_module('shapely.wkb').loads
            return np.fromiter((load(wkb) for wkb in self.to_wkb()), object, len(self))
        offsets, coordinates = self.closed()
        polygons: NDArray[np.object_] = shapely.from_ragged_array(
            shapely.GeometryType.POLYGON, coordinates, (offsets, np.arange(len(self) + 1)))
        return polygons

    def __repr__(self) -> str:
        return f'<dyadel.Rings: {len(self)} polygons, {len(self.coordinates)} vertices>'


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
