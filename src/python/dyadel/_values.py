# SPDX-License-Identifier: LGPL-3.0-or-later
"""Numbers of other packages as numbers that the library takes: exactly, or not at all.

None of these packages is imported here: a number of theirs brings its own.
"""
from __future__ import annotations

from fractions import Fraction
from typing import Any

Simple = int | Fraction | str | tuple[Fraction, Fraction]

#: Constants of mpmath: numbers with any number of digits.
MPMATH_CONSTANTS = {'pi': 'pi', 'e': 'e', 'phi': '(1+sqrt(5))/2', 'ln2': 'log(2)', 'ln10': 'log(10)', '1 deg': 'pi/180'}
SYMPY_CONSTANTS = {'Pi': 'pi', 'Exp1': 'e', 'GoldenRatio': '((1+sqrt(5))/2)'}
SYMPY_FUNCTIONS = {name: name.lower() for name in (
    'exp', 'log', 'sin', 'cos', 'tan', 'asin', 'acos', 'atan', 'sinh', 'cosh', 'tanh', 'Abs', 'Min', 'Max')}


def simplify(value: Any) -> Simple:
    """An int, a Fraction, a text of the points file, or (lower, upper): the same number. TypeError for others."""
    home = type(value).__module__.partition('.')[0]
    if home == 'mpmath':
        return _mpmath(value)
    if home == 'sympy':
        return _sympy(value)
    if home == 'flint':
        return _flint(value)
    raise TypeError(f'{value!r} of type {type(value).__name__} is no coordinate; give an int, float, Fraction, Decimal, '
                    'a text such as "sqrt(2)" or "[1,2]", a pair of ends, or a number of gmpy2, mpmath, sympy or '
                    'python-flint')


def _dyadic(mantissa: Any, exponent: Any) -> Fraction:
    return Fraction(int(mantissa)) * Fraction(2) ** int(exponent)


# ---- mpmath ----


def _mpf(parts: Any, value: Any) -> Fraction:
    sign, mantissa, exponent, _ = parts
    if not mantissa and exponent:
        raise ValueError(f'{value!r} is no coordinate; coordinates are finite numbers')
    return _dyadic(-mantissa if sign else mantissa, exponent)


def _mpmath(value: Any) -> Simple:
    if hasattr(value, '_mpi_'):
        lower, upper = value._mpi_
        return _mpf(lower, value), _mpf(upper, value)
    name = getattr(value, 'name', None)
    if name in MPMATH_CONSTANTS:
        return MPMATH_CONSTANTS[name]
    if name is None and hasattr(value, '_mpf_'):
        return _mpf(value._mpf_, value)
    raise TypeError(f'{value!r} has no exact real value; give mpf, iv.mpf, or an enclosure by a Source')


# ---- sympy: expressions as texts ----


def _sympy(value: Any) -> str:
    if value.is_extended_real is False or value.is_finite is False or value.free_symbols:
        raise TypeError(f'{value} is no finite real number')
    return _sympy_text(value)


def _sympy_text(e: Any) -> str:
    kind = type(e).__name__
    if e.is_Rational:
        return f'({e.p}/{e.q})'
    if e.is_Float:
        exact = _mpf(e._mpf_, e)
        return f'({exact.numerator}/{exact.denominator})'
    if kind in SYMPY_CONSTANTS:
        return SYMPY_CONSTANTS[kind]
    if e.is_Add or e.is_Mul:
        return '(' + ('+' if e.is_Add else '*').join(map(_sympy_text, e.args)) + ')'
    if e.is_Pow:
        return _sympy_power(*e.args)
    if kind in SYMPY_FUNCTIONS:
        return f'{SYMPY_FUNCTIONS[kind]}({",".join(map(_sympy_text, e.args))})'
    if kind == 'ComplexRootOf':
        return _sympy_root(e)
    raise TypeError(f'{kind} in {e} is not known to the library; serve the point by a Source')


def _sympy_power(base: Any, exponent: Any) -> str:
    below, roots = _sympy_text(base), {1: '{}', 2: 'sqrt({})', 3: 'cbrt({})'}
    if not exponent.is_Rational or exponent.q not in roots:
        return f'exp(({_sympy_text(exponent)})*log({below}))'
    root = roots[exponent.q].format(below)
    power = f'({root})^{abs(exponent.p)}' if abs(exponent.p) != 1 else root
    return power if exponent.p > 0 else f'(1/{power})'


def _sympy_root(e: Any) -> str:
    degree = e.poly.degree()
    terms = '+'.join(f'({c.p}/{c.q})*x^{degree - k}' if degree > k else f'({c.p}/{c.q})'
                     for k, c in enumerate(e.poly.all_coeffs()))
    interval = e._get_interval()
    return f'root({terms},{interval.a},{interval.b})'


# ---- python-flint ----


def _flint(value: Any) -> Simple:
    kind = type(value).__name__
    if kind == 'fmpz':
        return int(value)
    if kind == 'fmpq':
        return Fraction(int(value.p), int(value.q))
    if kind == 'arf' and value.is_finite():
        return _dyadic(*value.man_exp())
    if kind == 'arb' and value.is_finite():
        middle, radius = (_dyadic(*part.man_exp()) for part in (value.mid(), value.rad()))
        return middle - radius, middle + radius
    raise TypeError(f'{value!r} has no exact finite real value')
