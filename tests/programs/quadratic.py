#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""An oracle program in plain Python: coordinates are the larger roots of random x^2 + b x + c with c < 0.

Usage: quadratic.py SEED COUNT. Whole numbers have no limit in Python, so the integer square root gives any precision.
"""
import math
import random
import sys


def enclose(b, c, bits):
    """(-b + sqrt(b^2 - 4 c)) / 2 lies between these numbers; 2^-bits is the distance of the square root's."""
    scaled = (b * b - 4 * c) << 2 * bits
    floor = math.isqrt(scaled)
    ends = floor, floor + (floor * floor < scaled)
    return [f'{(-b << bits) + end}*2^-{bits + 1}' for end in ends]


def main():
    seed, count = map(int, sys.argv[1:])
    choose = random.Random(seed)
    points = [[(choose.randint(-99, 99), -choose.randint(1, 999)) for _ in 'xy'] for _ in range(count)]
    print('points', count, flush=True)
    for line in sys.stdin:
        point, bits = map(int, line.split()[1:])
        print(point, *(end for b, c in points[point] for end in enclose(b, c, max(bits, 0))), flush=True)


main()
