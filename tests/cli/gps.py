# SPDX-License-Identifier: LGPL-3.0-or-later
"""Points as a receiver of satellites logs them: tracks with rests, repeats of a place, and accuracies from 1 to 15 metres.

Coordinates are metres in a square of 10 km; every point is a rectangle, its accuracy to each side. Seeded.
"""
import math
import random


def fixes(count=2000, seed=1, length=100):
    """Places x, y and half-widths, in metres with one decimal."""
    rand = random.Random(seed)
    out = []
    while len(out) < count:
        x, y, heading = rand.uniform(0, 10000), rand.uniform(0, 10000), rand.uniform(0, 2 * math.pi)
        stride, accuracy = rand.choice((20, 50, 120)), rand.choice((1, 3, 5, 8, 15))
        for _ in range(min(length, count - len(out))):
            if rand.random() < 0.05 and out:  # at rest: the same place again
                out.append(out[-1])
                continue
            heading += rand.gauss(0, 0.3)
            x += stride * math.cos(heading) + rand.gauss(0, 2)
            y += stride * math.sin(heading) + rand.gauss(0, 2)
            out.append((round(x, 1), round(y, 1), accuracy if rand.random() < 0.8 else 2 * accuracy))
    return out


def points(count=2000, seed=1):
    """A points file."""
    return ''.join(f'{x}+-{r} {y}+-{r}\n' for x, y, r in fixes(count, seed))
