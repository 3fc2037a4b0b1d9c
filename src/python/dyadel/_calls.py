# SPDX-License-Identifier: LGPL-3.0-or-later
"""What users call first: points in, and an answer out."""
from __future__ import annotations

import contextlib
from collections.abc import Iterator, Sequence
from typing import Any, Literal, overload

from ._options import Path, engine_options
from ._questions import Plan, Tolerance
from ._sphere import Sphere
from ._statuses import Statuses
from ._triangulation import Delaunay


@overload
def delaunay(points: Any, radius: Any = None, *, sphere: Literal[False] = False, trace: Path | None = None,
             resume: Path | None = None, **options: Any) -> Delaunay: ...


@overload
def delaunay(points: Any, radius: Any = None, *, sphere: Literal[True], radius_unit: str | None = None,
             trace: Path | None = None, resume: Path | None = None, **options: Any) -> Sphere: ...


@overload
def delaunay(points: Any, radius: Any = None, *, sphere: bool, **options: Any) -> Delaunay | Sphere: ...


def delaunay(points: Any, radius: Any = None, *, sphere: bool = False, radius_unit: str | None = None,
             trace: Path | None = None, resume: Path | None = None, **options: Any) -> Delaunay | Sphere:
    """Triangulates points that need not be known exactly.

    points   array (N, 2) of floats, taken exactly as they are, without a copy; array (N, 4) of boxes xlo, xhi, ylo, yhi;
             a list of pairs of coordinates: int, float, Fraction, Decimal, a text such as 'sqrt(2)' or '[1.2,1.3]', a
             pair of ends, numbers of numpy, gmpy2, mpmath (mpf, iv.mpf), sympy and python-flint, mixed as need be;
             a Source; a Text
    radius   half-width of the square around each point: a number, N of them, or (N, 2) for x and y; with an array of
             floats the box is rounded outward to doubles, other numbers ('0.01', Fraction, Decimal) are exact, and slow
    sphere   points are longitude and latitude in degrees, neighbours those on the globe; the result is a Sphere. Radii have
             a unit: a text such as '30m', '2km' (on the ground), '0.01deg', or numbers and
    radius_unit  'm', 'mm', 'cm', 'km', 'ft', 'in', 'deg', 'arcmin' or 'arcsec'
    trace    name of a file that receives each answer of a point as it comes, and what each stage states; a run that ended
             early, however it did, goes on from there with
    resume   name of such a file: its answers are taken in place of asking again. Points and options have to be the same
    options  until, timeout, max_bits, max_pairs, threads, schedule, start_bits, step_bits, max_stages, max_calls, window,
             ties, tie_bits, progress: see below

    What a callback raises comes through unchanged; what fails in the library is an Error with point and stage. Either
    has an attribute `result`: the Delaunay object with all that was known before. So has KeyboardInterrupt: Ctrl-C ends
    a run.

    """
    if not sphere:
        if radius_unit is not None:
            raise ValueError('in the plane radii are in the unit of the coordinates; give sphere=True, or leave radius_unit out')
        return _in_plane(points, radius, trace, resume, **options)
    globe = Sphere(points, radius, radius_unit)
    with _kept_with_errors(globe), globe._traced(trace, resume, options):
        return globe.refine(**options)


delaunay.__doc__ = f'{delaunay.__doc__}{engine_options.__doc__}'.replace('What Engine.run takes.', 'Options:')


def _in_plane(points: Any, radius: Any = None, trace: Path | None = None, resume: Path | None = None,
              **options: Any) -> Delaunay:
    d = Delaunay()
    with _kept_with_errors(d):
        d._append(points, radius)
        with d._traced(trace, resume, options):
            return d.refine(**options)


@contextlib.contextmanager
def _kept_with_errors(d: Statuses) -> Iterator[None]:
    """As `result` of what is raised; exceptions with slots have no room for it."""
    try:
        yield
    except BaseException as error:
        with contextlib.suppress(AttributeError):
            setattr(error, 'result', d)
        raise


def tolerance(points: Any, up_to: Any = None, radii: bool = False, sigma: float | None = None,
              metric: str = 'euclid', **options: Any) -> Tolerance:
    """How far exact points (as delaunay takes them) may move: for every edge, every point, the whole.

    up_to: also births, pairs that may become edges when points move by at most so much (an exact number, in units of the
    points); radii: also how far each point may be from its place; sigma: also the probability of each edge when every
    coordinate has an independent normal error of this standard deviation (a float, in units of the points; without it
    that of the sigma_column of a Text); metric: 'euclid', points move in discs, or 'box', in squares: x and y each by as
    much (lo and hi are 2^-20 of themselves apart); options: those of delaunay. With a Text that has radius_columns and
    keep_radii=True each point moves in proportion to its radius.
    """
    return _in_plane(points, **options).tolerance(up_to, radii, sigma, metric)


def plan(points: Any, radius: Any = None, accuracy: Any = None, window: Sequence[Any] | None = None,
         site: int | None = None, **options: Any) -> Plan:
    """Which points to measure next, and how accurately, so that all is decided.

    accuracy: what a measurement gives at best, in units of the points; window, site: only pairs that reach into
    (xlo, xhi, ylo, yhi), or that end at this point; points, radius, options: as for delaunay.
    """
    return _in_plane(points, radius, **options).plan(accuracy, window, site)
