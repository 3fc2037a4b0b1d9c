# SPDX-License-Identifier: LGPL-3.0-or-later
"""The harness of monotone refinement, for tests of streams: with pytest, or with hypothesis."""
from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

from . import _dyadel
from ._arrays import rect_of
from ._errors import BrokenPromise
from ._options import INPUTS, takes_options, time_limit, whole
from ._points import Source, append_points
from ._triangulation import Delaunay

if TYPE_CHECKING:
    from hypothesis.strategies import SearchStrategy

Move = tuple[int, int, int]


@takes_options(*INPUTS, runs=False)
def check(points: Any, radius: Any = None, *, moves: Sequence[Move] | None = None, schedules: int = 100, seed: int = 1,
          stages: int = 6, base_bits: int = 8, max_bits: int = 192, slack_bits: int = 16, timeout: float | None = None,
          progress: Callable[[int, int], object] | None = None, reference: Any = None, **inputs: Any) -> dict[str, Any]:
    """Runs random refinement schedules over points (as delaunay takes them) and looks for broken promises: rectangles
    that are not nested or not as narrow as asked for, statuses that are taken back, cells that shrink.

        def test_my_stream():
            dyadel.check(dyadel.Source(12, narrow), reference=[(k, f'sqrt({k})') for k in range(12)])

    reference: the true points of a Source, in any form that delaunay takes; an answer that does not hold them (or, of points
    that are not exact, that is apart from a box far narrower than max_bits) is wrong, however consistent all answers are.

    Raises BrokenPromise (an AssertionError) with the shortest schedule found; returns the numbers of schedules, stages,
    pairs and cells tried. moves: this one schedule [(stage, point, bits), ...] instead of random ones.
    """
    for name, value, least, most in (('schedules', schedules, 1, 2**32 - 1), ('stages', stages, 1, 2**32 - 1), ('base_bits', base_bits, 1, 2**63 - 1),
                                     ('max_bits', max_bits, 1, 2**63 - 1), ('slack_bits', slack_bits, 1, 2**63 - 1), ('seed', seed, 0, 2**64 - 1)):
        whole(name, value, least, most)

    if reference is not None:
        points = _compared(points, reference, max_bits)

    def make() -> _dyadel.Engine:
        engine = _dyadel.Engine()
        append_points(engine, points, radius, **inputs)
        return engine
    given = None if moves is None else sorted((stage, point, bits) for stage, point, bits in moves)
    report = _dyadel.check(make, seed, schedules, stages, base_bits, max_bits, slack_bits, 0.0 if timeout is None else time_limit(timeout), given,
                           progress)
    if report['fault'] == 'fine':
        return report
    raise BrokenPromise(f'{report["fault"]}: {report["message"]}; moves={report["moves"]}', report['fault'],
                        report['moves'], report['seed'])


def _compared(points: Any, reference: Any, max_bits: int) -> Source:
    """The source, whose answers are compared with the true points."""
    if not isinstance(points, Source):
        raise TypeError('reference is for a Source, whose answers it is compared with')
    true = Delaunay(reference, schedule='uniform', start_bits=max_bits + 64, max_bits=max_bits + 64, max_stages=1)
    if len(true) != points.n:
        raise ValueError(f'reference has {len(true)} points, the Source {points.n}')

    def narrow(i: int, bits: int) -> Sequence[Any]:
        answer: Sequence[Any] = points.narrow(i, bits)
        read = _dyadel.Engine()
        read.append_source(1, lambda point, wanted: answer)
        read.run({'max_stages': 1})
        if read.outcome() == 'error':
            return answer
        told, place = rect_of(read.rect(0)), true.rect(i)
        if any(told[k] > place[k + 1] or told[k + 1] < place[k] for k in (0, 2)):
            raise BrokenPromise(f'point {i}, asked for {bits} bits, is not where the reference is: the answer is x in '
                                f'[{told[0]}, {told[1]}], y in [{told[2]}, {told[3]}]', 'reference', [(1, i, bits)], 0)
        return answer
    return Source(points.n, narrow)


def moves(points: int, stages: int = 6, max_bits: int = 192) -> SearchStrategy[list[Move]]:
    """A strategy of hypothesis for schedules over this number of points, some of them asked at neighbouring precisions in turn:

        @hypothesis.given(dyadel.moves(12))
        def test_my_stream(moves):
            dyadel.check(dyadel.Source(12, narrow), moves=moves)
    """
    from hypothesis import strategies
    stage, point, bits = strategies.integers(1, stages), strategies.integers(0, points - 1), strategies.integers(0, max_bits)
    one = strategies.tuples(stage, point, bits).map(lambda move: [move])
    # the same point at neighbouring precisions, one after the other: where rounding to nearest is not nested
    near = strategies.tuples(stage, point, bits, strategies.integers(1, 2)).map(
        lambda drawn: [(drawn[0], drawn[1], drawn[2]), (drawn[0] + 1, drawn[1], drawn[2] + drawn[3])])
    return strategies.lists(one | near, max_size=2 * stages).map(lambda parts: [move for part in parts for move in part])
