# SPDX-License-Identifier: LGPL-3.0-or-later
"""The notions of KEL (Khanban, Edalat, Lieutier: Delaunay Triangulation and Voronoi Diagram with Imprecise Input Data) about a
few partial points: orientation, partial disc, Con, partial bisector, partial edge and triangle. "Section N" is that of
proofs/mathematics.md, which defines them as they are built."""
from __future__ import annotations

import json
from fractions import Fraction
from typing import Any, NamedTuple

from . import _dyadel
from ._options import INPUTS, engine_options, split_inputs, takes_options
from ._points import append_points

Corner = tuple[Fraction, Fraction]
DISC, BISECTOR = 2, 3  # dyd_converge_of


class Circle(NamedTuple):
    """A critical circle (KEL, figure 5; section 4). labels: for each of the three rectangles F, the circle holds it and goes
    through its farthest point, or C, it touches it from outside. x, y, radius_squared: texts, exact, of the form
    (A + B*sqrt(C))/D; centre: (xlo, xhi, ylo, yhi) and radius: (lo, hi), rounded outward."""

    labels: str
    x: str
    y: str
    radius_squared: str
    centre: tuple[float, ...]
    radius: tuple[float, ...]


class PartialDisc(NamedTuple):
    """The partial disc (I, E) of three partial points (KEL, figure 5; section 4): I is the interior of the intersection of the
    discs of the first three circles, E the complement of the union of the others. orientation: as orientation() says; if
    'unknown', circles is empty, and so are I and E. con: Con of each further point. outcome: how refining ended."""

    orientation: str
    circles: list[Circle]
    con: list[str]
    outcome: str


class Arc(NamedTuple):
    """A piece of a curve of a partial bisector (KEL, sections 2, 3): 'line' or 'parabola'. corner: of the rectangle `far`, the
    focus, 'x0y1'; feature: of the rectangle `near`, the corner or side that is closest. begin, end: (xlo, xhi, ylo, yhi),
    rounded outward; None: at infinity."""

    kind: str
    far: int
    corner: str
    near: int
    feature: str
    begin: tuple[float, ...] | None
    end: tuple[float, ...] | None


class Bisector(NamedTuple):
    """The partial bisector of two partial points (KEL, sections 2, 3, figures 2 to 4; section 2). curves[k]: the arcs that
    bound the places certainly nearer to point k, which are on their left; none while the rectangles meet. outcome: how
    refining ended."""

    curves: tuple[list[Arc], list[Arc]]
    outcome: str


def _engine(points: Any, radius: Any, options: dict[str, Any]) -> tuple[_dyadel.Engine, dict[str, Any]]:
    engine = _dyadel.Engine()
    append_points(engine, points, radius, **split_inputs(options))
    return engine, engine_options(**options)


def _piece(points: Any, radius: Any, of: int, options: dict[str, Any]) -> dict[str, Any]:
    engine, ready = _engine(points, radius, options)
    outcome = engine.converge(ready, None, of, False, 0, None)[0]
    found: dict[str, Any] = json.loads(engine.piece('disc' if of == DISC else 'bisector'))
    return {**found, 'outcome': outcome}


@takes_options(*INPUTS)
def disc(points: Any, radius: Any = None, **options: Any) -> PartialDisc:
    """The partial disc of the first three points, and Con of the others (KEL, figure 5; section 4), as `dyadel disc`.

    Computable points are refined until the three are oriented and Con of all others is known; until='hausdorff:M' or
    'area:M': until the bounds of the disc are 2^-M. points, radius, options: as for delaunay.
    """
    found = _piece(points, radius, DISC, options)
    circles = [Circle(c['labels'], c['x'], c['y'], c['radius_squared'], (*c['x_decimal'], *c['y_decimal']), tuple(c['radius_decimal']))
               for c in found.get('circles') or []]
    return PartialDisc(found['orientation'], circles, [c['con'] for c in found['con']], found['outcome'])


def con(point: Any, a: Any, b: Any, c: Any, **options: Any) -> str:
    """Con(point; a, b, c) (KEL, figure 5; section 4): 'inside' or 'outside' of every circle through points of a, b and c;
    'unknown' where some circle meets all four, or some line meets a, b and c."""
    return disc([a, b, c, point], **options).con[0]


def orientation(a: Any, b: Any, c: Any, **options: Any) -> str:
    """Of three partial points (section 4): 'counter-clockwise' or 'clockwise' for every choice; 'unknown' where some line meets
    all three. Computable points are refined until it is known."""
    return disc([a, b, c], **options).orientation


@takes_options(*INPUTS)
def bisector(points: Any, radius: Any = None, **options: Any) -> Bisector:
    """The partial perpendicular bisector of the first two points (KEL, sections 2, 3, figures 2 to 4; section 2), as `dyadel
    bisector`. Computable points are refined until their rectangles are disjoint. points, radius, options: as for delaunay."""
    found = _piece(points, radius, BISECTOR, options)

    def end(e: dict[str, Any]) -> tuple[float, ...] | None:
        return (*e['at']['x_decimal'], *e['at']['y_decimal']) if 'at' in e else None

    def arcs(curve: dict[str, Any]) -> list[Arc]:
        return [Arc(a['kind'], a['far'], a['corner'], a['near'], a['feature'], end(a['begin']), end(a['end']))
                for chain in curve['boundary']['chains'] for a in chain['arcs']]
    return Bisector((arcs(found['curves'][0]), arcs(found['curves'][1])), found['outcome'])


@takes_options(*INPUTS)
def hull(points: Any, radius: Any = None, **options: Any) -> list[Corner]:
    """The convex hull of one to three partial points (section 3): of two the partial edge Ed(a, b), of three the partial
    triangle. Vertices counter-clockwise, exact. The points have to be rectangles; d.rect(i) gives the one that a run reached."""
    engine = _engine(points, radius, options)[0]
    if not 1 <= engine.count() <= 3:
        raise ValueError(f'give one to three points, not {engine.count()}')
    return corners_of(engine.piece('hull').decode(), '\n')


def corners_of(text: str, between: str) -> list[Corner]:
    """Vertices as the command writes them."""
    return [(Fraction(x), Fraction(y)) for x, y in (z.split() for z in text.split(between) if z)]
