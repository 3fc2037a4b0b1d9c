# SPDX-License-Identifier: LGPL-3.0-or-later
"""What users call first: points in, and an answer out."""
from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Literal, overload

from ._inputs import is_geographic
from ._options import INPUTS, Path, engine_options, split_inputs, takes_options
from ._questions import Plan, Tolerance
from ._sphere import Sphere
from ._triangulation import Delaunay


@overload
def delaunay(points: Any, radius: Any = None, *, sphere: Literal[False] | None = None, trace: Path | None = None,
             resume: Path | None = None, order: str | None = None, skip_missing: bool = False, ids: Any = None, crs: Any = None,
             sigma: Any = None, confidence: float | str | None = None, carry: Any = None, **options: Any) -> Delaunay: ...


@overload
def delaunay(points: Any, radius: Any = None, *, sphere: Literal[True], radius_unit: str | None = None,
             trace: Path | None = None, resume: Path | None = None, order: str | None = None, skip_missing: bool = False,
             ids: Any = None, crs: Any = None, sigma: Any = None, confidence: float | str | None = None, carry: Any = None,
             **options: Any) -> Sphere: ...


@overload
def delaunay(points: Any, radius: Any = None, *, sphere: bool, **options: Any) -> Delaunay | Sphere: ...


@takes_options(*INPUTS)
def delaunay(points: Any, radius: Any = None, *, sphere: bool | None = None, radius_unit: str | None = None,
             trace: Path | None = None, resume: Path | None = None, **options: Any) -> Delaunay | Sphere:
    """Triangulates points that need not be known exactly.

    points   array (N, 2) of floats, taken exactly as they are, without a copy; array (N, 4) of boxes xlo, xhi, ylo, yhi;
             a DataFrame of two columns (or of four: minx, miny, maxx, maxy), a GeoDataFrame, a GeoSeries, points of shapely;
             a list of pairs of coordinates: int, float, Fraction, Decimal, a text such as 'sqrt(2)' or '[1.2,1.3]', a
             pair of ends, numbers of numpy, gmpy2, mpmath (mpf, iv.mpf), sympy and python-flint, mixed as need be;
             a Source; a Text
    radius   half-width of the square around each point: a number, N of them, (N, 2) for x and y, or the name of a column
             of the DataFrame; with an array of floats the box is rounded outward to doubles, other numbers ('0.01', Fraction, Decimal) are exact, and slow
    sphere   points are longitude and latitude in degrees, neighbours those on the globe; the result is a Sphere. Radii have
             a unit: a text such as '30m', '2km' (on the ground), '0.01deg', or numbers and
    radius_unit  'm', 'mm', 'cm', 'km', 'ft', 'in', 'deg', 'arcmin' or 'arcsec'
    order    of boxes: 'xxyy' as above, or 'xyxy': minx, miny, maxx, maxy, as gdf.bounds has them
    skip_missing  skip masked rows and rows with nan, None or a text such as NA; otherwise they are an error. Points are
             numbered without them: d.rows[k] is the row of point k
    ids      a name for each row, or the name of a column: `ids` of the result, and columns of its output
    carry    columns to repeat in tables of points and cells: 'all' or names of columns of the DataFrame, or a DataFrame or a dict
             of arrays; d.carried has them
    crs      reference system of the points; by default that of a GeoDataFrame. Degrees need sphere=True or sphere=False
    sigma    standard deviations of normal errors: a number, N of them, (N, 2) for x and y, (N, 3) with their correlation, or
             names of columns of the DataFrame; receivers that state a radius of 95 % state 2.45 of them, of 50 % (CEP) 1.18
    confidence  0.95 or '95%': each point is widened by k of its standard deviations, so that with at least this
             probability everything stated holds, all together; see Delaunay.confidence
    trace    name of a file that receives each answer of a point at once, and the statements of each stage; a run that ended
             early continues from there with
    resume   name of such a file: its answers are used instead of asking again. Points and options have to be the same
    options  until, timeout, max_bits, max_pairs, threads, schedule, start_bits, step_bits, max_stages, max_calls, window,
             ties, tie_bits, progress: see below

    Exceptions of callbacks come through unchanged; failures of the library are an Error with point and stage. Either
    has an attribute `result`: the Delaunay object with all that was known before. So has KeyboardInterrupt: Ctrl-C ends
    a run.

    """
    crs: Any = options.get('crs') or getattr(points, 'crs', None)
    if sphere and getattr(crs, 'is_projected', False):
        raise ValueError(f'the coordinates are not degrees, as their crs says ({crs.name}); pass points.to_crs(4326), or remove sphere=True')
    if sphere is None and is_geographic(crs):
        raise ValueError('the coordinates are degrees, as their crs says; give sphere=True for distances on the globe, or '
                         'sphere=False to take degrees for a plane')
    if not sphere:
        if radius_unit is not None:
            raise ValueError('in the plane radii are in the unit of the coordinates; give sphere=True, or remove radius_unit')
        return Delaunay(points, radius, trace=trace, resume=resume, **options)
    globe = Sphere(points, radius, radius_unit, **split_inputs(options))
    with globe._kept_with_errors(), globe._traced(trace, resume, options):
        return globe.refine(**options)


delaunay.__doc__ = f'{delaunay.__doc__}{engine_options.__doc__}'.replace('What Engine.run takes.', 'Options:')


@takes_options(*INPUTS, 'radius', 'trace', 'resume')
def tolerance(points: Any, up_to: Any = None, radii: bool = False, sigma: float | None = None,
              metric: str = 'euclid', **options: Any) -> Tolerance:
    """How far exact points (as delaunay takes them) may move: for every edge, every point, the whole.

    up_to: also births, pairs that may become edges when points move by at most this much (an exact number, in units of the
    points); radii: also how far each point may be from its place; sigma: also the probability of each edge when every
    coordinate has an independent normal error of this standard deviation (a float, in units of the points; without it
    that of the sigma_column of a Text); metric: 'euclid', points move in discs, or 'box', in squares: x and y each by as
    much (lo and hi are 2^-20 of themselves apart); options: those of delaunay. With a Text that has radius_columns and
    keep_radii=True each point moves in proportion to its radius.
    """
    return Delaunay(points, **options).tolerance(up_to, radii, sigma, metric)


@takes_options(*INPUTS, 'trace', 'resume')
def plan(points: Any, radius: Any = None, accuracy: Any = None, window: Sequence[Any] | None = None,
         site: int | None = None, discs: bool = False, **options: Any) -> Plan:
    """Which points to measure next, and how accurately, so that all is decided. Delaunay.simulate tries that on drawn points.

    accuracy: what a measurement gives at best, in units of the points; window, site: only pairs that reach into
    (xlo, xhi, ylo, yhi), or that end at this point; discs: only pairs that discs leave undecided; points, radius,
    options: as for delaunay.
    """
    return Delaunay(points, radius, **options).plan(accuracy, window, site, discs)
