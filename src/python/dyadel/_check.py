# SPDX-License-Identifier: LGPL-3.0-or-later
"""The harness of monotone refinement, for tests of streams: with pytest, or with hypothesis."""
from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

from . import _dyadel
from ._errors import BrokenPromise
from ._options import INPUTS, takes_options
from ._points import append_points

if TYPE_CHECKING:
    from hypothesis.strategies import SearchStrategy

Move = tuple[int, int, int]


@takes_options(*INPUTS, runs=False)
def check(points: Any, radius: Any = None, *, moves: Sequence[Move] | None = None, schedules: int = 100, seed: int = 1,
          stages: int = 6, base_bits: int = 8, max_bits: int = 192, slack_bits: int = 16, timeout: float | None = None,
          progress: Callable[[int, int], object] | None = None, **inputs: Any) -> dict[str, Any]:
    """Runs random refinement schedules over points (as delaunay takes them) and looks for broken promises: rectangles
    that are not nested or not as narrow as asked for, statuses that are taken back, cells that shrink.

        def test_my_stream():
            dyadel.check(dyadel.Source(12, narrow))

    Raises BrokenPromise (an AssertionError) with the shortest schedule found; returns the numbers of schedules, stages,
    pairs and cells tried. moves: this one schedule [(stage, point, bits), ...] instead of random ones.
    """
    for name, value in (('schedules', schedules), ('stages', stages), ('base_bits', base_bits), ('max_bits', max_bits),
                        ('slack_bits', slack_bits)):
        if value < 1:
            raise ValueError(f'{name}={value}; give a number from 1 on')

    def make() -> _dyadel.Engine:
        engine = _dyadel.Engine()
        append_points(engine, points, radius, **inputs)
        return engine
    given = None if moves is None else sorted((stage, point, bits) for stage, point, bits in moves)
    report = _dyadel.check(make, seed, schedules, stages, base_bits, max_bits, slack_bits, timeout or 0.0, given,
                           progress)
    if report['fault'] == 'fine':
        return report
    raise BrokenPromise(f'{report["fault"]}: {report["message"]}; moves={report["moves"]}', report['fault'],
                        report['moves'], report['seed'])


def moves(points: int, stages: int = 6, max_bits: int = 192) -> SearchStrategy[list[Move]]:
    """A strategy of hypothesis for schedules over this number of points:

        @hypothesis.given(dyadel.moves(12))
        def test_my_stream(moves):
            dyadel.check(dyadel.Source(12, narrow), moves=moves)
    """
    from hypothesis import strategies
    move = strategies.tuples(strategies.integers(1, stages), strategies.integers(0, points - 1),
                             strategies.integers(0, max_bits))
    return strategies.lists(move, max_size=4 * stages)
