# SPDX-License-Identifier: LGPL-3.0-or-later
"""Results as files, and as pictures of matplotlib."""
from __future__ import annotations

import gzip
import importlib
import os
from typing import Any

import numpy as np

from ._geometry import FORMATS
from ._options import Path

#: Endings that geopandas writes.
GEOGRAPHIC = ('.gpkg', '.shp', '.fgb', '.parquet')
#: As in pictures of the command: legal or certain, indeterminate or possible, tie.
COLOURS = {'legal': '#1b3a5c', 'indeterminate': '#d98032', 'tie': '#7a5ba8', 'certain': '#8fb3d9', 'possible': '#f0dcc0',
           'exact': '#8fb3d9'}


def format_of(format: str) -> str:
    """The format; ValueError for the name of a file."""
    if format not in FORMATS and '.' in format:
        raise ValueError(f'write returns the text in a format, such as write("svg"); save({format!r}) writes a file')
    return format


class Saved:
    """A result that can be written in formats of the command, or as a table of geopandas."""

    def save(self, path: Path, layer: str | None = None, **options: Any) -> None:
        """Writes a file in the format of its ending, whole or not at all: those of dyadel.formats(), also with .gz behind;
        with geopandas .gpkg, .shp, .fgb and .parquet. layer, options: as for write() and to_geodataframe().
        The reference system is stated by delaunay(points, crs=25832), or here: epsg=25832 for formats of the command, crs=25832
        for those of geopandas.

            d.save('edges.csv'); d.save('picture.svg'); d.save('sites.gpkg', layer='points')
        """
        name = os.fspath(path)
        base = name.removesuffix('.gz')
        ending = os.path.splitext(base)[1].lower()
        beside = os.path.join(os.path.dirname(name), f'.{os.getpid()}.{os.path.basename(name)}')
        of: Any = self
        try:
            if ending in GEOGRAPHIC and base == name and hasattr(self, 'to_geodataframe'):
                beside += ending
                frame = of.to_geodataframe(**({} if layer is None else {'layer': layer}), **options)
                if ending == '.shp':  # several files
                    frame.to_file(name)
                    return
                if ending == '.parquet':
                    frame.to_parquet(beside)
                else:
                    title = os.path.splitext(os.path.basename(name))[0]
                    frame.to_file(beside, driver={'.gpkg': 'GPKG', '.fgb': 'FlatGeobuf'}[ending], layer=title)
            elif ending[1:] in FORMATS:
                text = of.write(ending[1:], **({} if layer is None else {'layer': layer}), **options)
                blob = text if isinstance(text, bytes) else text.encode()
                with open(beside, 'wb') as file:
                    file.write(blob if base == name else gzip.compress(blob, mtime=0))
            else:
                raise ValueError(f'{name}: no format has the ending {ending!r}; give one of .{", .".join(FORMATS)}, '
                                 f'{", ".join(GEOGRAPHIC)}')
            os.replace(beside, name)
        finally:
            if os.path.exists(beside):
                os.remove(beside)


def _axes(ax: Any) -> Any:
    if ax is None:
        ax = importlib.import_module('matplotlib.pyplot').subplots()[1]
        ax.set_aspect('equal')
    return ax


def plot_lines(ax: Any, lines: Any, colours: Any, values: Any = None, **options: Any) -> Any:
    """Draws lines (M, 2, 2) in colours, or by values; returns the axes."""
    ax = _axes(ax)
    collections: Any = importlib.import_module('matplotlib.collections')
    drawn = collections.LineCollection(lines, **{'colors': colours if values is None else None, 'linewidths': 0.8, **options})
    if values is not None:
        drawn.set_array(np.asarray(values))
    ax.add_collection(drawn)
    ax.autoscale_view()
    return ax


def plot_polygons(ax: Any, polygons: Any, colours: Any, values: Any = None, **options: Any) -> Any:
    """The same of polygons, each (K, 2)."""
    ax = _axes(ax)
    collections: Any = importlib.import_module('matplotlib.collections')
    drawn = collections.PolyCollection(polygons, **{'facecolors': colours if values is None else None, 'edgecolors': 'white',
                                                    'linewidths': 0.5, **options})
    if values is not None:
        drawn.set_array(np.asarray(values))
    ax.add_collection(drawn)
    ax.autoscale_view()
    return ax
