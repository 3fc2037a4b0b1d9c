# SPDX-License-Identifier: LGPL-3.0-or-later
"""An oracle program: boxes of a file of fractions; a place of no width is enclosed as finely as is asked, by dyadics and,
every third one, by decimals."""
import fractions
import sys

Q = fractions.Fraction
boxes = [[Q(c) for c in line.split()] for line in open(sys.argv[1], encoding='ascii')]
print('points', len(boxes), flush=True)


def outward(q, bits, up):
    """An end that is a dyadic, not always as near as could be."""
    n = (q.numerator << bits) // q.denominator if bits >= 0 else q.numerator // (q.denominator << -bits)
    n += 1 if up else 0
    return f'{n}*2^{-bits}'


def decimal(q, bits, up):
    """An end that is a decimal; of a width below 2^-bits."""
    digits = max(bits, 0) * 31 // 100 + 1
    return f'{q.numerator * 10**digits // q.denominator + up}e-{digits}'


for line in sys.stdin:
    word, i, bits = line.split()
    b = boxes[int(i)]
    if b[0] < b[1] or b[2] < b[3]:
        print(i, *(f'{c.numerator}/{c.denominator}' for c in b), 'fixed', flush=True)
    else:
        # nested: the ends of a finer grid that holds the coarser one lie inside
        end = decimal if int(i) % 3 == 1 else outward
        print(i, *(end(c, int(bits) + 1, k % 2) for k, c in enumerate(b)), flush=True)
