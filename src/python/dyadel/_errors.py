# SPDX-License-Identifier: LGPL-3.0-or-later
"""Exceptions, with the place of the fault."""
from __future__ import annotations

from typing import Any


class Error(ValueError):
    """The library refused or failed.

    code: 'argument', 'range', 'parse', 'domain', 'nesting', 'stream', 'io', 'contradiction', 'capped' or 'cancelled'.
    point: number of the point concerned, from 0; stage: how many times it had been narrowed before; line, column: place
    in a text, from 1. None where it is not known.
    """

    result: Any = None

    def __init__(self, message: str, code: str = 'argument', point: int | None = None, stage: int | None = None,
                 line: int | None = None, column: int | None = None) -> None:
        super().__init__(message)
        self.code, self.point, self.stage, self.line, self.column = code, point, stage, line, column

    def __reduce__(self) -> tuple[type[Error], tuple[Any, ...]]:
        return type(self), (self.args[0], self.code, self.point, self.stage, self.line, self.column)

    def __str__(self) -> str:
        message = str(self.args[0])
        where = [f'{name} {number}' for name in ('point', 'stage', 'line', 'column')
                 if (number := getattr(self, name)) is not None and f'{name} {number}' not in message]
        return message + (f' ({", ".join(where)})' if where else '')


class BrokenPromise(AssertionError):
    """A stream of points, or the engine, broke a promise: see check().

    fault: 'stream', 'rate', 'retract', 'cell', 'path', 'choice' or 'reference'; moves: the shortest schedule (stage, point,
    bits) found that shows it, from which no move can be omitted; check(points, moves=...) repeats it. seed: of that schedule.
    """

    def __init__(self, message: str, fault: str, moves: list[tuple[int, int, int]], seed: int) -> None:
        super().__init__(message)
        self.fault, self.moves, self.seed = fault, moves, seed
