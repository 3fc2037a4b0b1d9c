# SPDX-License-Identifier: LGPL-3.0-or-later
"""What triangulations of the plane and of a sphere say of pairs of points."""
from __future__ import annotations

import contextlib
import importlib
import json
import os
from collections.abc import Callable, Iterator
from typing import Any, TypeVar

import numpy as np

from . import _dyadel, _geometry
from ._arrays import Floats, Ints, Longs, Rect, floats, ints, longs, rect_of
from ._inputs import Given, epsg_of
from ._options import Path, engine_options, takes_options
from ._outputs import Saved, format_of
from ._points import Confidence

STATUS = ('illegal', 'tie', 'indeterminate', 'legal')
TIE, INDETERMINATE, LEGAL = 1, 2, 3
Made = TypeVar('Made')


class Statuses(Saved):
    """Statuses of pairs, certain triangles, and the rectangles for which they hold. Points are numbered from 0."""

    _engine: _dyadel.Engine | _dyadel.Sphere
    _named: _dyadel.Engine
    #: The coordinate reference system of the points, as given or as a GeoDataFrame has it; None: not known.
    crs: Any = None
    #: How many answers were taken from the trace given as `resume`: of points, or of their images in the plane.
    recalled: int = 0

    def __init__(self) -> None:
        self._options: dict[str, Any] = {}
        self._outcome: str | None = None  # of the pickled object
        self._cache: dict[str, Any] = {}

    def _once(self, name: str, make: Callable[[], Made]) -> Made:
        if name not in self._cache:
            self._cache[name] = make()
        found: Made = self._cache[name]
        return found

    def _counts(self) -> tuple[int, int, int]:
        return len(self.legal), len(self.indeterminate), len(self.ties)

    @contextlib.contextmanager
    def _traced(self, trace: Path | None, resume: Path | None, options: dict[str, Any]) -> Iterator[None]:
        """The first run resumes from one trace, and writes another."""
        if resume is not None:
            self.recalled = self._engine.recall(os.fsencode(resume))
        if trace is not None:
            self._engine.trace_begin(os.fsencode(trace), engine_options(**options), None)
        try:
            yield
        finally:
            self._engine.trace_end()

    @contextlib.contextmanager
    def _kept_with_errors(self) -> Iterator[None]:
        """Sets `result` of exceptions; those with slots cannot have it."""
        try:
            yield
        except BaseException as error:
            with contextlib.suppress(AttributeError):
                setattr(error, 'result', self)
            raise

    @property
    def confidence(self) -> Confidence | None:
        """With at least this probability everything stated holds; None where none was asked for."""
        stated = self._named.confidence(None, 0)
        return None if stated is None else Confidence(*stated)

    def cancel(self) -> None:
        """Asks a run to end soon, with outcome 'cancelled'; from any thread."""
        self._engine.cancel()

    def __len__(self) -> int:
        """How many points."""
        return self._engine.count()

    @property
    def outcome(self) -> str:
        """'decided', 'certified' (the requested bound holds), 'fixpoint' (only better measurements can decide more), 'budget',
        'cancelled', 'error', or 'none' before the first run."""
        return self._outcome or self._engine.outcome()

    @property
    def pairs(self) -> Ints:
        """All possible pairs, sorted: (M, 3) i, j, status with i < j; LEGAL, INDETERMINATE or TIE."""
        return self._once('pairs', lambda: ints(self._engine.pairs()).reshape(-1, 3))

    def _with(self, status: int) -> Ints:
        return self._once(STATUS[status], lambda: self.pairs[self.pairs[:, 2] == status, :2])

    @property
    def legal(self) -> Ints:
        """Pairs that are edges for every choice of points: (L, 2)."""
        return self._with(LEGAL)

    @property
    def indeterminate(self) -> Ints:
        """Pairs that are edges for some choice of points; narrower rectangles may decide them: (K, 2)."""
        return self._with(INDETERMINATE)

    @property
    def ties(self) -> Ints:
        """Pairs that are edges for some choice, which no refinement decides: exact or proved ties: (T, 2)."""
        return self._with(TIE)

    def _triangles(self) -> tuple[Ints, Ints]:
        corners, beyond = self._once('triangles', self._engine.triangles)
        return ints(corners).reshape(-1, 3), ints(beyond).reshape(-1, 3)

    @property
    def simplices(self) -> Ints:
        """Certain triangles, counter-clockwise, in no particular order: (T, 3)."""
        return self._triangles()[0]

    @property
    def neighbors(self) -> Ints:
        """neighbors[t, k]: the triangle beyond the side opposite to corner k of triangle t; -1 where none is certain: (T, 3)."""
        return self._triangles()[1]

    @property
    def aliases(self) -> Ints:
        """(A, 2): point k is the same place as point j < k, which represents it."""
        def make() -> Ints:
            alias = ints(self._engine.aliases())
            other = np.flatnonzero(alias != np.arange(len(alias)))
            return np.column_stack((other, alias[other])).astype(np.int32)
        return self._once('aliases', make)

    @property
    def boxes(self) -> Floats:
        """Rectangles reached, rounded outward to doubles: (N, 4) xlo, xhi, ylo, yhi."""
        return self._once('boxes', lambda: floats(self._engine.boxes()).reshape(-1, 4))

    @property
    def rows(self) -> Longs:
        """(N,): the row of each point in the input: rows[k] is k unless rows were skipped or merged."""
        return self._once('rows', lambda: longs(self._named.names()[0]))

    @property
    def ids(self) -> list[str] | None:
        """The identifier of each point, '' without one; None: no point has one."""
        return self._named.names()[1]

    def rect(self, i: int) -> Rect:
        """The rectangle reached of point i, exactly: xlo, xhi, ylo, yhi."""
        return rect_of(self._engine.rect(i))

    @property
    def counters(self) -> dict[str, Any]:
        """Counters of the run: stages, calls, bits_least, bits_most, bits_total, seconds, spent (which budget), decisions by rung."""
        return self._engine.counters()

    @takes_options(runs=False)
    def write(self, format: str = 'csv', layer: str | None = None, window: Any = None, epsg: int | None = None) -> str | bytes:
        """Returns the result as a text in a format of the command ('csv', 'json', 'geojson', 'svg', 'html', ...), bytes of binary
        formats; save() writes a file.

        layer: as `dyadel delaunay --layer`: 'pairs', 'points', 'triangles', of the plane also 'graph:nearest',
        'graph:gabriel', 'graph:mst'; window: what pictures of the plane show, (xlo, xhi, ylo, yhi); epsg: number of the
        reference system, by default that of `crs`. Rows are named by `rows`, and by `ids`.
        """
        return _geometry.text_of(format, self._engine.write(format_of(format), layer, window, epsg_of(self.crs) if epsg is None else epsg))

    _log: list[Given]  # the inputs; without points where boxes of doubles hold them

    @property
    def carried(self) -> dict[str, Any]:
        """Columns next to the points: the columns named by `Text(carry=...)`, with the text in the row of each point; and
        the columns given as `carry`, arrays with a value for each point (None for points that came without)."""
        return {**self._named.carried(), **self._arrays()}

    def _arrays(self) -> dict[str, Any]:
        def column(name: str) -> Any:
            parts = [log.carry.get(name, np.full(log.added, None)) for log in self._log]
            return np.concatenate(parts) if len(parts) > 1 else parts[0]
        return {name: column(name) for name in dict.fromkeys(name for log in self._log for name in log.carry)}

    def named(self, **points: Ints) -> dict[str, Any]:
        """Columns that name points: i=, j= ... with their `rows`, and id or id_i, id_j ... where they have `ids`."""
        ids = None if self.ids is None else np.array(self.ids, object)
        one = len(points) == 1
        return {**{name: self.rows[of] for name, of in points.items()}, **(
            {} if ids is None else {'id' if one else f'id_{name}': ids[of] for name, of in points.items()})}

    def to_geodataframe(self, layer: str | None = None, crs: Any = None) -> Any:
        """A layer ('pairs', 'points', 'triangles', 'graph:mst', ...) as a GeoDataFrame; crs: by default that of the points."""
        geopandas: Any = importlib.import_module('geopandas')
        features = json.loads(self.write('geojson', layer, epsg=0))['features']
        frame = geopandas.GeoDataFrame.from_features(features, crs=self.crs if crs is None else crs)
        if layer == 'points':
            for name, column in self._arrays().items():
                frame[name if name not in frame else f'{name}_2'] = column[np.searchsorted(self.rows, frame['i'])]
        return frame

    @property
    def __geo_interface__(self) -> dict[str, Any]:
        """Pairs as a FeatureCollection of lines with i, j, status and max_coordinate_error."""
        collection: dict[str, Any] = json.loads(self._engine.write('geojson', None, None, 0))
        return collection

    def _repr_svg_(self) -> str | None:
        return _geometry.picture(self)

    def _repr_html_(self) -> str | None:
        return _geometry.page(self)

    def __repr__(self) -> str:
        name = f'dyadel.{type(self).__name__}'
        try:
            legal, indeterminate, ties = self._counts()
        except RuntimeError as error:  # no result, or at work
            return f'<{name}: {len(self)} points, {error}>'
        return f'<{name}: {len(self)} points, {self.outcome}: {legal} legal, {indeterminate} indeterminate, {ties} ties>'
