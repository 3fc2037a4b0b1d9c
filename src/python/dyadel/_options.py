# SPDX-License-Identifier: LGPL-3.0-or-later
"""How far a run goes: the keywords that delaunay, refine, append, converge and others share."""
from __future__ import annotations

import difflib
import functools
import inspect
import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, ParamSpec, TypeVar

import numpy as np
from numpy.typing import ArrayLike

Path = str | os.PathLike[str]
GOALS = ('decided', 'area', 'hausdorff', 'voronoi area', 'voronoi hausdorff')
SCHEDULES = ('adaptive', 'uniform')
#: What else functions take that take points.
INPUTS = ('order', 'skip_missing', 'ids', 'crs', 'sigma', 'confidence', 'carry')
AT_LEAST = {'max_bits': 1, 'max_pairs': 1, 'threads': 1, 'start_bits': -2**20, 'step_bits': 0, 'max_stages': 0,
            'max_calls': 0, 'tie_bits': 0, 'max_bytes': 0}
AT_MOST = {'threads': 2**16}
_FILE = (str, bytes, os.PathLike), 'the name of a file'
_WHOLE = (int, np.integer), 'a whole number'
#: Types of arguments that more than one function takes, and what an error tells to give.
KINDS: Mapping[str, tuple[Any, str]] = {
    'until': (str, 'a text such as "area:40"'), 'progress': (Callable, 'a function'), 'trace': _FILE, 'resume': _FILE,
    'ids': (Iterable, 'a text for each point, or the name of a column'), 'moves': (Iterable, 'a list of (stage, point, bits)'),
    'carry': (Iterable, '"all", names of columns, or a dict of arrays'), 'hindsight': _WHOLE, 'flatten': _WHOLE, 'epsg': _WHOLE,
    'format': (str, 'a name such as "csv"'), 'layer': (str, 'a name such as "points"'), 'name': (str, 'a name such as "mst"'),
}
Arguments = ParamSpec('Arguments')
Result = TypeVar('Result')


def takes_options(*more: str, runs: bool = True) -> Callable[[Callable[Arguments, Result]], Callable[Arguments, Result]]:
    """A decorator of functions with **options, those of engine_options (not if runs=False) and `more`: others are a
    TypeError that names the function and the nearest keyword."""
    def decorate(function: Callable[Arguments, Result]) -> Callable[Arguments, Result]:
        own = [name for name, p in inspect.signature(function).parameters.items() if p.kind is not p.VAR_KEYWORD]
        known = [*own, *more, *(inspect.signature(engine_options).parameters if runs else ())]
        name = function.__qualname__.removesuffix('.__init__').replace('._', '.')

        @functools.wraps(function)
        def checked(*args: Arguments.args, **options: Arguments.kwargs) -> Result:
            for option in options:
                if option not in known:
                    near = difflib.get_close_matches(option, known, 1)
                    raise TypeError(f'{name}() got an unexpected keyword argument {option!r}' +
                                    (f'; did you mean {near[0]!r}?' if near else ''))
            for option, value in (dict(zip(own, args)) | options).items():
                kind, words = KINDS.get(option, (object, ''))
                if not isinstance(value, kind) and (value is not None or option in ('until', 'format', 'name')):
                    raise TypeError(f'{option}={value!r}; give {words}')
            return function(*args, **options)
        return checked
    return decorate


def split_inputs(options: dict[str, Any]) -> dict[str, Any]:
    """Removes the options of points from options and returns them."""
    return {name: options.pop(name) for name in INPUTS if name in options}


def whole(name: str, value: Any, least: int, most: int = 2**63 - 1) -> None:
    """An error that names the option, unless value is a whole number between least and most."""
    if not isinstance(value, (int, np.integer)):
        raise TypeError(f'{name}={value!r}; give a whole number')
    if value < least:
        raise ValueError(f'{name}={value}; give at least {least}')
    if value > most:
        raise ValueError(f'{name}={value}; give at most {most}')


def time_limit(timeout: Any) -> float:
    """Seconds, above 0: 0 seconds are the shortest time."""
    try:
        seconds = float(timeout)
    except (TypeError, ValueError):
        seconds = -1.0
    if not seconds >= 0:
        raise ValueError(f'timeout={timeout!r}; give seconds, 0 or more')
    return max(seconds, 1e-9)


def engine_options(*, until: str = 'decided', timeout: float | None = None, max_bits: int = 4096,
                   max_pairs: int | None = None, threads: int = 1, schedule: str = 'adaptive',
                   start_bits: int | None = None, step_bits: int | None = None, max_stages: int | None = None,
                   max_calls: int | None = None, window: Sequence[Any] | None = None, ties: bool = True,
                   tie_bits: int | None = None, max_bytes: int | None = None, cost: ArrayLike | None = None,
                   progress: Callable[[dict[str, Any]], object] | None = None,
                   policy: Callable[[list[tuple[int, int]], dict[int, int]], dict[int, int] | None] | str | None = None
                   ) -> dict[str, Any]:
    """What Engine.run takes.

    until       'decided', 'area:M', 'hausdorff:M', 'voronoi area:M' or 'voronoi hausdorff:M': stop when the bound is at
                most 2^-M (of areas and distances in the units of the points; the last two: of the diagram in window)
    timeout     seconds for this run
    max_bits    the finest request is for rectangles of width 2^-max_bits
    max_pairs   cap on stored pairs (default 4 million + 16 a point)
    threads     for the triangulation; results do not depend on it
    schedule    'adaptive': refine points of undecided pairs; 'uniform': all points
    start_bits, step_bits  precision of the first stage; steps of this many bits instead of geometric growth
    max_stages, max_calls  of this run
    window      (xlo, xhi, ylo, yhi), for bounds of the diagram
    ties        prove that expressions and roots are the same, on one line or circle, with at most tie_bits bits for each
    max_bytes   memory that the engine may hold, by its own estimate: MemoryError before it asks for more; points and
                results stay
    cost        cost of asking each point again, above 0: the schedule prefers cheap ones. One for each point
    progress    called after each stage with a dict: stage, bits, points, legal, indeterminate, ties, undecided_faces,
                seconds; an exception in it ends the run
    policy      a function policy(pairs, plan) called with the undecided pairs and the plan of each stage, a dict of bits by
                points: a dict that it returns replaces the plan, None leaves it. Or a command, as --policy. Statements do
                not depend on it
    """
    goal, _, bits = until.partition(':')
    if goal not in GOALS or (goal == 'decided') == bool(bits) or bits and not bits.isdecimal():
        raise ValueError(f'until={until.removeprefix("voronoi ")!r}; give "decided", "area:M" or "hausdorff:M" with a number of bits, '
                         'such as "hausdorff:40"')
    if schedule not in SCHEDULES:
        raise ValueError(f'schedule={schedule!r}; give "adaptive" or "uniform"')
    for name, value in (('max_bits', max_bits), ('max_pairs', max_pairs), ('threads', threads), ('start_bits', start_bits),
                        ('step_bits', step_bits), ('max_stages', max_stages), ('max_calls', max_calls),
                        ('tie_bits', tie_bits), ('max_bytes', max_bytes)):
        if value is not None:
            whole(name, value, AT_LEAST[name], AT_MOST.get(name, 2**63 - 1))
    if policy is not None and not callable(policy) and not isinstance(policy, str):
        raise TypeError(f'policy={policy!r}; give a function policy(pairs, plan), or a command')
    try:
        costs = None if cost is None else np.ascontiguousarray(cost, dtype=np.float64)
    except (TypeError, ValueError):
        raise TypeError(f'cost={cost!r}; give a number for each point') from None
    given = {'goal': GOALS.index(goal), 'goal_bits': int(bits or 0), 'schedule': SCHEDULES.index(schedule),
             'seconds': None if timeout is None else time_limit(timeout), 'max_bits': max_bits,
             'max_pairs': max_pairs, 'threads': threads, 'start_bits': start_bits, 'step_bits': step_bits,
             'max_stages': max_stages, 'max_calls': max_calls, 'window': window, 'no_ties': not ties,
             'tie_bits': tie_bits, 'max_bytes': max_bytes, 'progress': progress, 'policy': policy,
             'cost': costs}
    return {name: value for name, value in given.items() if value is not None}
