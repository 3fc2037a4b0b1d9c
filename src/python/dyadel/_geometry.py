# SPDX-License-Identifier: LGPL-3.0-or-later
"""Pictures for notebooks, and geometries for other programs."""
from __future__ import annotations

import html
from typing import Any

import numpy as np

from . import _dyadel
from ._arrays import Floats, Ints

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
