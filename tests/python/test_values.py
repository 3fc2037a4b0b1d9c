#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Every kind of number becomes exactly that number, or an interval that holds it; other values are refused."""
import decimal
import importlib
import math
from decimal import Decimal
from fractions import Fraction

import harness
import numpy as np

import dyadel

RANDOM = harness.seeded('values')


def sides(*coordinates, **options):
    """The sides (lower, upper) that these coordinates became."""
    d = dyadel.delaunay([(c, k) for k, c in enumerate(coordinates)], **options)
    return [d.rect(k)[:2] for k in range(len(coordinates))]


def assert_exact(pairs):
    for (low, high), (value, wanted) in zip(sides(*(value for value, _ in pairs)), pairs):
        assert low == high == wanted, (value, wanted, low, high)


def assert_encloses(pairs, bits=60):
    for (low, high), (value, wanted) in zip(sides(*(value for value, _ in pairs), start_bits=bits), pairs):
        assert low <= wanted <= high, (value, float(low), float(high))
        assert high - low <= Fraction(1, 2**(bits - 1)), (value, float(high - low))


def root(n, bits=200):
    return Fraction(math.isqrt(n << (2 * bits)), 1 << bits)


def test_plain():
    long = RANDOM.getrandbits(20000)
    assert_exact([(3, 3), (-7, -7), (0, 0), (True, 1), (long, long), (-long, -long), (-2**63, -2**63), (2**63, 2**63),
                  (0.1, Fraction(0.1)), (-0.0, 0), (5e-324, Fraction(5e-324)), (1.7e308, Fraction(1.7e308)),
                  (Fraction(22, 7), Fraction(22, 7)), (Fraction(-1, 3**50), Fraction(-1, 3**50)),
                  (Decimal('47.61'), Fraction(4761, 100)), (Decimal('-1E-30'), Fraction(-1, 10**30)),
                  ('22/7', Fraction(22, 7)), ('0x1.8p-3', Fraction(3, 16)), (' 1e-3 ', Fraction(1, 1000))])
    with decimal.localcontext(prec=3):
        assert_exact([(Decimal('1.23456789'), Fraction(123456789, 10**8))])


def test_random_fractions():
    numbers = [Fraction(RANDOM.randint(-10**k, 10**k), RANDOM.randint(1, 10**k)) for k in range(1, 60)]
    assert_exact([(q, q) for q in numbers])


def test_numpy():
    assert_exact([(np.int32(-5), -5), (np.uint64(2**64 - 1), 2**64 - 1), (np.float32(0.1), Fraction(float(np.float32(0.1)))),
                  (np.float64(0.1), Fraction(0.1)), (np.longdouble(0.5), Fraction(1, 2))])


def test_intervals():
    assert sides((1, 2), [0.5, Fraction(3, 4)], '[1.5,1.75]', ('1/4', Decimal('0.5'))) == [
        (1, 2), (Fraction(1, 2), Fraction(3, 4)), (Fraction(3, 2), Fraction(7, 4)), (Fraction(1, 4), Fraction(1, 2))]
    low, high = sides((Fraction(1, 3), Fraction(2, 3)))[0]
    assert low == Fraction(1, 3) and high == Fraction(2, 3)


def test_texts():
    assert_encloses([('sqrt(2)', root(2)), ('sqrt(2)+sqrt(3)', root(2) + root(3)), ('root(x^2-2, 1, 2)', root(2))])
    low, high = sides('pi')[0]
    assert low < Fraction(math.pi) + Fraction(1, 2**52) and high > Fraction(math.pi)


def test_gmpy2():
    gmpy2 = found('gmpy2')
    with gmpy2.context(precision=200):
        mpfr = gmpy2.mpfr('0.1')
    assert_exact([(gmpy2.mpz(10**40), 10**40), (gmpy2.mpq(22, 7), Fraction(22, 7)),
                  (mpfr, Fraction(*map(int, mpfr.as_integer_ratio())))])


def test_mpmath():
    mpmath = found('mpmath')
    with mpmath.workprec(300):
        third, minus = mpmath.mpf(1) / 3, mpmath.mpf(-1) / 3
    exact = Fraction(third._mpf_[1]) * Fraction(2) ** third._mpf_[2]
    assert_exact([(third, exact), (minus, -exact), (mpmath.mpf(0), 0), (mpmath.mpf(-3), -3)])
    assert sides(mpmath.iv.mpf([1, 2]), mpmath.iv.mpf(3)) == [(1, 2), (3, 3)]
    assert_encloses([(mpmath.pi, Fraction(mpmath.nstr(mpmath.pi, 15)) + Fraction(323846264338, 10**26))], 40)
    harness.raised(ValueError, sides, mpmath.inf)
    harness.raised(TypeError, sides, mpmath.mpc(1, 2))
    harness.raised(TypeError, sides, mpmath.catalan)


def test_sympy():
    sympy = found('sympy')
    r, half = sympy.sqrt(2), sympy.Rational(1, 2)
    golden = (1 + root(5)) / 2
    assert_exact([(sympy.Integer(7), 7), (sympy.Rational(22, 7), Fraction(22, 7)), (half + 1, Fraction(3, 2)),
                  (sympy.Float('0.5'), Fraction(1, 2))])
    assert_encloses([(r, root(2)), (1 / r, root(2) / 2), (r * sympy.sqrt(3) - 1, root(6) - 1), (r**3, 2 * root(2)),
                     (sympy.GoldenRatio, golden), (sympy.Abs(1 - r), root(2) - 1), (sympy.Max(r, 1), root(2)),
                     (sympy.cos(sympy.pi / 7)**2 + sympy.sin(sympy.pi / 7)**2, 1), (sympy.exp(sympy.log(3)) * r, 3 * root(2)),
                     (sympy.Integer(2)**sympy.Rational(1, 4) * sympy.Integer(2)**sympy.Rational(1, 4), root(2)),
                     (sympy.CRootOf(sympy.Symbol('x')**2 - 2, 1), root(2)), (sympy.CRootOf(sympy.Symbol('x')**5 - 2, 0)**5, 2)])
    for wrong in (sympy.I, sympy.Symbol('t'), sympy.oo, sympy.nan, sympy.gamma(r)):
        harness.raised(TypeError, sides, wrong)


def test_flint():
    flint = found('flint')
    ball = flint.arb(2).sqrt()
    assert_exact([(flint.fmpz(10**40), 10**40), (flint.fmpq(22, 7), Fraction(22, 7))])
    low, high = sides(ball)[0]
    assert low <= root(2) and root(2) <= high + Fraction(1, 2**190)


def found(name):
    """The package; where it is not installed the rest of the test is skipped, with a note."""
    try:
        return importlib.import_module(name)
    except ImportError as error:
        raise Absent(name) from error


class Absent(Exception):
    pass


def test_refused():
    for value, kind in ((float('nan'), ValueError), (float('inf'), ValueError), (Decimal('NaN'), ValueError), (None, TypeError),
                        (1j, TypeError), ('sqrt(2', dyadel.Error), ('', dyadel.Error), (object(), TypeError), ((2, 1), ValueError),
                        ((1, 2, 3), TypeError), (b'1', TypeError)):
        error = harness.raised(kind, dyadel.delaunay, [(0, 0), (value, 1)])
        assert error.point == 1, (value, error)
    for point in ((1,), (1, 2, 3), 'ab', 5, None):
        assert harness.raised(ValueError, dyadel.delaunay, [(0, 0), (1, 1), point]).point == 2
    error = harness.raised(dyadel.Error, dyadel.delaunay, [('1+', 0)])
    assert error.code == 'parse' and error.column == 3, (error, error.column)


def test_nothing_is_added_on_failure():
    d = dyadel.delaunay([(0, 0), (1, 0), (0, 1)])
    harness.raised(ValueError, d.append, [(5, 5), (float('nan'), 1)])
    assert len(d) == 3 and d.refine().outcome == 'decided'


def test_radius():
    box = (Fraction(99, 100), Fraction(101, 100), Fraction(199, 100), Fraction(201, 100))
    for radius in ('0.01', Decimal('0.01'), Fraction(1, 100), ['0.01'], [('0.01', '1/100')]):
        low, high, bottom, top = dyadel.delaunay([(1, 2)], radius=radius).rect(0)
        for end, wanted, side in ((low, box[0], -1), (high, box[1], 1), (bottom, box[2], -1), (top, box[3], 1)):
            assert 0 <= side * (end - wanted) < Fraction(1, 2**60), (radius, end)
    xy = np.array([[0.1, 0.2], [3.0, 1e300], [0.5, -0.25]])
    for radius in (0.25, [0.25] * 3, np.full((3, 2), 0.25), np.array([0.25, 0.1, 5e-324])):
        d = dyadel.delaunay(xy, radius=np.asarray(radius))
        for i in range(3):
            by = Fraction(float(np.broadcast_to(np.asarray(radius), 3)[i] if np.ndim(radius) < 2 else radius[i][0]))
            for end, side, at in zip(d.rect(i), (-1, 1, -1, 1), (0, 0, 1, 1)):
                wanted = Fraction(xy[i, at]) + side * by
                assert side * (end - wanted) >= 0, 'not outward'
                inner = Fraction(float(np.nextafter(float(end), -side * np.inf)))
                assert end == wanted or side * (inner - wanted) < 0, 'not the next double'
    assert harness.raised(dyadel.Error, dyadel.delaunay, xy, radius=-1.0).point == 0
    assert harness.raised(dyadel.Error, dyadel.delaunay, xy, radius=np.array([1, np.inf, 1])).point == 1
    harness.raised(ValueError, dyadel.delaunay, [(1, 2)], radius='-1')
    harness.raised(ValueError, dyadel.delaunay, xy, radius=[1.0, 2.0])


def test_mixed_list():
    d = dyadel.delaunay([('sqrt(2)', Fraction(1, 3)), (0.1, (1, Fraction(9, 8))), (Decimal('3.5'), 0), (-2, 'pi')])
    assert d.outcome == 'decided' and d.legal.tolist() == [[0, 1], [0, 2], [1, 2], [1, 3], [2, 3]], d.pairs


def main():
    for name, test in list(globals().items()):
        if name.startswith('test_'):
            try:
                test()
                print(f'{name}: fine')
            except Absent as absent:
                print(f'{name}: skipped, {absent} is not installed')


main()
