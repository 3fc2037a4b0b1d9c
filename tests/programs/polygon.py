#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""An oracle program with mpmath: the corners of a regular polygon, one of them pushed outward a little.

Usage: polygon.py CORNERS DEPTH. Corner 0 is at the distance 1 + 2^-DEPTH, the others are at the distance 1 from the
centre. mpmath.iv computes with intervals that hold the value for sure; its ends are dyadic numbers. An interval found
with more digits need not lie inside an earlier one, but both hold the value, so their intersection does.
"""
import sys

from mpmath import iv, mp

known = {}


def narrowed(name, interval):
    """The enclosure of the number of that name, now that it is in the interval too."""
    low, high = mp.mpf(interval.a), mp.mpf(interval.b)
    if name in known:
        low, high = max(low, known[name][0]), min(high, known[name][1])
    known[name] = low, high
    return low, high


def dyadic(number):
    sign, mantissa, exponent, _ = number._mpf_
    return f'{-mantissa if sign else mantissa}*2^{exponent}'


def main():
    corners, depth = map(int, sys.argv[1:])
    print('points', corners, flush=True)
    for line in sys.stdin:
        point, bits = map(int, line.split()[1:])
        iv.prec = mp.prec = max(bits, 0) + 20
        angle = 2 * iv.pi * point / corners
        radius = 1 + (iv.mpf(2) ** -depth if point == 0 else 0)
        x, y = narrowed((point, 'x'), radius * iv.cos(angle)), narrowed((point, 'y'), radius * iv.sin(angle))
        print(point, *map(dyadic, x + y), flush=True)


main()
