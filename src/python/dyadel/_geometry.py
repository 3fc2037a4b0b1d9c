# SPDX-License-Identifier: LGPL-3.0-or-later
"""Pictures for notebooks, and geometries for other programs."""
from __future__ import annotations

import html
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from . import _dyadel

if TYPE_CHECKING:
    from ._triangulation import Delaunay

Ints = NDArray[np.int32]
Floats = NDArray[np.float64]

FORMATS = {name: binary for name, _, binary in _dyadel.formats()}
#: Larger results are shown in words: notebooks keep every picture in their file.
MOST_POINTS_SHOWN = 20_000


def ints(buffer: Any) -> Ints:
    """Memory of the library as numbers, without a copy."""
    return np.frombuffer(buffer, np.int32)


def floats(buffer: Any) -> Floats:
    """Memory of the library as numbers, without a copy."""
    return np.frombuffer(buffer, np.float64)


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


def to_wkb(d: Delaunay, layer: str) -> list[bytes]:
    """See Delaunay.to_wkb."""
    place = centres(d.boxes)
    if layer == 'points':
        return _records([('u1', 1), ('<u4', 1)], place)
    if layer == 'pairs':
        return _records([('u1', 1), ('<u4', 2), ('<u4', 2)], place[d.pairs[:, :2]].reshape(-1, 4))
    if layer == 'triangles':
        ring = d.simplices[:, [0, 1, 2, 0]]
        return _records([('u1', 1), ('<u4', 3), ('<u4', 1), ('<u4', 4)], place[ring].reshape(-1, 8))
    raise ValueError(f'layer={layer!r}; give "pairs", "triangles" or "points"')


def picture(d: Any) -> str | None:
    """svg; None where a text says more."""
    if len(d) > MOST_POINTS_SHOWN or getattr(d, 'outcome', '') == 'none':
        return None
    return str(d.write('svg'))


def page(d: Any) -> str | None:
    """html: the page that one can touch, in a frame of its own; where the library has none, the picture."""
    if len(d) > MOST_POINTS_SHOWN or getattr(d, 'outcome', '') == 'none':
        return None
    if 'html' in FORMATS:
        inner = html.escape(str(d.write('html')), quote=True)
        return f'<iframe srcdoc="{inner}" sandbox="allow-scripts" width="100%" height="600" frameborder="0"></iframe>'
    return f'<figure>{d.write("svg")}<figcaption>{html.escape(repr(d))}</figcaption></figure>'
