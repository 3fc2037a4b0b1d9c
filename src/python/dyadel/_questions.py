# SPDX-License-Identifier: LGPL-3.0-or-later
"""What is asked of a triangulation besides its statuses: nearest points, tolerances, plans, convergence, proofs."""
from __future__ import annotations

import html
from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from . import _dyadel
from ._options import engine_options
from ._geometry import Floats, Ints, floats, ints
from ._triangulation import Delaunay, append_points, delaunay

EVENTS = np.array(['death', 'birth', 'tie'])


class Nearest(NamedTuple):
    """points: those possibly nearest, ascending; sure: there is one, and it is surely nearest; outcome: 'decided',
    'fixpoint', 'budget' or 'cancelled'; lo, hi: bounds of the distance of each, rounded outward; tied: all of them are
    equally far, so that no refinement makes one sure."""

    points: Ints
    sure: bool
    outcome: str
    lo: Floats
    hi: Floats
    tied: bool


def _distances(boxes: Floats, at: Sequence[float]) -> tuple[Floats, Floats]:
    """Of a place in the box `at` from each box: below and above, each of the few operations rounded outward."""
    below, above = -np.inf, np.inf
    gaps, spans = [], []
    for k in (0, 2):
        apart = np.maximum(boxes[:, k] - at[k + 1], at[k] - boxes[:, k + 1])
        gaps.append(np.maximum(np.nextafter(apart, below), 0))
        spans.append(np.nextafter(np.maximum(boxes[:, k + 1] - at[k], at[k + 1] - boxes[:, k]), above))
    lo, hi = np.hypot(*gaps), np.hypot(*spans)
    for _ in range(3):  # hypot is within an ulp or two
        lo, hi = np.nextafter(lo, below), np.nextafter(hi, above)
    return np.maximum(lo, 0), hi


def nearest(d: Delaunay, x: Any, y: Any, options: Mapping[str, Any]) -> Nearest:
    """See Delaunay.nearest."""
    found, sure, tied, outcome, ends = d._engine.nearest((x, y), engine_options(**options))
    d._cache = {}
    points = ints(found)
    at = [float(np.nextafter(float(Fraction(*end)), np.inf if k % 2 else -np.inf)) for k, end in enumerate(ends)]
    return Nearest(points, sure, outcome, *_distances(d.boxes[points], at), tied)


# ---- tables ----


class Table(Mapping[str, NDArray[Any]]):
    """Columns by name, in order: a Mapping, so that pandas.DataFrame(dict(table)) takes it."""

    def __init__(self, columns: Mapping[str, NDArray[Any]]) -> None:
        self._columns = dict(columns)

    def __getitem__(self, name: str) -> NDArray[Any]:
        return self._columns[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        """How many columns."""
        return len(self._columns)

    @property
    def rows(self) -> list[dict[str, Any]]:
        """The same row by row."""
        return [dict(zip(self, values)) for values in zip(*(column.tolist() for column in self.values()))]

    def __repr__(self) -> str:
        return f'<{type(self).__name__}: {len(self.rows)} rows of {", ".join(self)}>'

    def _repr_html_(self) -> str:
        def line(cells: Any, tag: str) -> str:
            return '<tr>' + ''.join(f'<{tag}>{html.escape(str(cell))}</{tag}>' for cell in cells) + '</tr>'
        return '<table>' + line(self, 'th') + ''.join(line(row.values(), 'td') for row in self.rows[:100]) + '</table>'


def _fields(buffer: Any, form: Mapping[str, tuple[str, int]], size: int) -> Table:
    """Columns of records as C lays them out."""
    kind = np.dtype({'names': list(form), 'formats': [f for f, _ in form.values()],
                     'offsets': [at for _, at in form.values()], 'itemsize': size})
    records = np.frombuffer(buffer, kind)
    return Table({name: records[name] for name in form})


class Tolerance(Table):
    """For each pair how far all points may move at once before it is lost (death) or found (birth): columns i, j, event,
    k, l, lo, hi; the motion is in [lo, hi] (infinite: never), k and l are the points that bind (-1: none).

    lo, hi: up to a motion in [self.lo, self.hi] nothing changes at all. radii: (N,) how far each may be from its place so
    that nothing changes, rounded down; None unless asked for.
    """

    lo: float
    hi: float
    radii: Floats | None

    @classmethod
    def _of(cls, d: Delaunay, up_to: Any, points: bool) -> Tolerance:
        rows, (lo, hi), radii = d._engine.tolerance(up_to, points, 0)
        table = _fields(rows, {'i': ('i4', 0), 'j': ('i4', 4), 'event': ('i4', 8), 'k': ('i4', 12), 'l': ('i4', 16),
                               'lo': ('f8', 24), 'hi': ('f8', 32)}, 40)
        made = cls({**table, 'event': EVENTS[table['event']]})
        made.lo, made.hi = lo, hi
        made.radii = None if radii is None else floats(radii)
        return made


def tolerance(points: Any, up_to: Any = None, radii: bool = False, **options: Any) -> Tolerance:
    """How far exact points (as delaunay takes them) may move: for every edge, every point, the whole.

    up_to: also births, pairs that may become edges when points move by at most so much (an exact number, in units of the
    points); radii: also how far each point may be from its place; options: those of delaunay.
    """
    return Tolerance._of(delaunay(points, **options), up_to, radii)


class Plan(Table):
    """Which points to measure next, in order: columns site, now (half-width, rounded up), needed (rounded down), decided
    (how many more pairs), left. If they turn out within `needed` of the centres of their rectangles, no pair asked for is
    open, but for those that tie there.

    open, ties, left: pairs that were open, that tie at the centres, that stay open.
    """

    open: int
    ties: int
    left: int

    @classmethod
    def _of(cls, d: Delaunay, accuracy: Any, window: Sequence[Any] | None, site: int | None) -> Plan:
        rows, (open_pairs, ties, left) = d._engine.plan(accuracy, window, site)
        made = cls(_fields(rows, {'site': ('u4', 0), 'now': ('f8', 8), 'needed': ('f8', 16), 'decided': ('u8', 24),
                                  'left': ('u8', 32)}, 40))
        made.open, made.ties, made.left = open_pairs, ties, left
        return made


def plan(points: Any, radius: Any = None, accuracy: Any = None, window: Sequence[Any] | None = None,
         site: int | None = None, **options: Any) -> Plan:
    """Which points to measure next, and how accurately, so that all is decided.

    accuracy: what a measurement gives at best, in units of the points; window, site: only pairs that reach into
    (xlo, xhi, ylo, yhi), or that end at this point; points, radius, options: as for delaunay.
    """
    return Plan._of(delaunay(points, radius, **options), accuracy, window, site)


# ---- convergence ----


class Convergence(Table):
    """A run stage by stage: widths, pairs by status, bounds (rounded up), decisions, calls; the columns of `dyadel
    converge`. outcome: how it ended; csv: the table as the command writes it; svg: its plot."""

    outcome: str
    csv: str
    svg: str

    @classmethod
    def _of(cls, outcome: str, csv: bytes, svg: bytes) -> Convergence:
        lines = [line.split(',') for line in csv.decode().splitlines() if not line.startswith('#')]
        made = cls({name: np.array(cells) if name == 'statuses' else _column(cells) for name, *cells in zip(*lines)})
        made.outcome, made.csv, made.svg = outcome, csv.decode(), svg.decode()
        return made

    def _repr_svg_(self) -> str:
        return self.svg


def _column(cells: Sequence[str]) -> NDArray[Any]:
    """Whole numbers, or doubles (nan: not known)."""
    whole = all(cell.isdigit() for cell in cells)
    return np.array([int(cell) if whole else float(cell or 'nan') for cell in cells])


def converge(points: Any, radius: Any = None, window: Sequence[Any] | None = None, diagram: bool = True,
             times: bool = True, start_bits: int = 4, **options: Any) -> Convergence:
    """Runs the refinement and notes every stage.

    window: of the bounds of the Voronoi diagram; diagram=False leaves these out (they cost most); times=False leaves out
    seconds, so that equal runs give equal tables; points, radius, options: as for delaunay.
    """
    engine = _dyadel.Engine()
    append_points(engine, points, radius)
    ready = engine_options(start_bits=start_bits, **options)
    return Convergence._of(*engine.converge(ready, window, not diagram, times))


# ---- proofs ----


class Verdict(NamedTuple):
    """What an accepted certificate states. proved: and everything that it states is proved."""

    proved: bool
    outcome: str
    report: dict[str, Any]


def verify(certificate: bytes, points: Any = None, radius: Any = None, **options: Any) -> Verdict:
    """Checks a certificate in integers, with no code of the engine; points: and that it is about these.

    Error with code 'parse' and the line when it is rejected.
    """
    engine = None
    if points is not None:
        engine = _dyadel.Engine()
        append_points(engine, points, radius)
    report = _dyadel.verify(certificate, engine, engine_options(**options))
    return Verdict(report['proved'], report['outcome'], report)
