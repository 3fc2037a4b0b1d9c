# SPDX-License-Identifier: LGPL-3.0-or-later
"""Inputs for dyadel-tiles, as rows of two or four doubles, and the results of one process."""
import array
import json
import math
import os
import pathlib
import random
import struct
import subprocess

SCALE = int(os.environ.get('DYADEL_TEST_SCALE', '1'))
SEED = int(os.environ.get('DYADEL_TEST_SEED', '1'))
print(f'DYADEL_TEST_SEED={SEED}')


def uniform(n, r):
    return [(r.random(), r.random()) for _ in range(n)]


def clusters(n, r, count=60):
    middles = uniform(count, r)
    return [tuple(c + r.gauss(0, 0.002) for c in r.choice(middles)) for _ in range(n)]


def ring_and_square(n, r):
    """A ring of some width inside of the border of a square, whose points are exactly on lines."""
    points = []
    for k in range(n):
        a, t = r.uniform(0, 2 * math.pi), r.uniform(-2, 2)
        points.append((math.cos(a) * r.uniform(0.99, 1), math.sin(a) * r.uniform(0.99, 1)) if k % 20 else
                      r.choice([(t, -2.0), (t, 2.0), (-2.0, t), (2.0, t)]))
    return points


def circle(n, r):
    return [(math.cos(a), math.sin(a)) for a in (r.uniform(0, 2 * math.pi) for _ in range(n))]


def grid(n, r):
    side = math.isqrt(n)
    points = [(float(k % side), float(k // side)) for k in range(side * side)]
    r.shuffle(points)
    return points


def line(n, r):
    return [(float(x), 2.0 * x) for x in r.sample(range(10 * n), n)]


def parabola(n, r, height):
    """So flat that circles are far larger than distances. (-a, -b, b, a) are on one circle, and for neighbours a, b the
    circle is empty: ties across the middle, that end on the rims of large discs."""
    points = [(float(k), height * k * k) for k in range(-n // 2, n // 2 + 1) if k]
    r.shuffle(points)
    return points


def equal(n, r):
    return [(0.5, 0.25)] * n


def repeated(n, r):
    """Every point about three times."""
    places = uniform(n // 3 + 1, r)
    return [r.choice(places) for _ in range(n)]


def boxed(points, half, r, exact=0):
    rows = []
    for x, y in points:
        h = 0 if r.random() < exact else half
        rows.append((x - h, x + h, y - h, y + h))
    return rows


def boxes(n, r, factor=0.03):
    return boxed(uniform(n, r), factor / math.sqrt(n or 1), r)


def long_boxes(n, r):
    """Of all shapes, some of them far longer than distances are."""
    rows = []
    for x, y in uniform(n, r):
        w, h = (r.choice([0, 0.1, 0.3, 3]) / math.sqrt(n or 1) * r.random() for _ in range(2))
        rows.append((x - w, x + w, y - h, y + h))
    return rows


def mixed(n, r):
    """Exact points of a grid, many of them tied, and a few rectangles that take part."""
    side = math.isqrt(n)
    half = 0.2
    return [(x - h, x + h, y - h, y + h) for x, y in grid(n, r) for h in [half if r.random() < 0.02 else 0.0]
            if side]


HIDDEN = (2.95, 0.0)


def hidden_witness(n, r, cut):
    """A segment 0, a point 1, and exact points about every disc that holds both, but for HIDDEN, inside of it: this one is far
    from all that the pairs of the segment depend on, and in the other of two tiles, which meet at x = cut. So 0,1 is a legal
    pair for the first tile, and not for both. Where 1 belongs to the other tile, too, nothing but the witness tells."""
    half, middle, side = 0.25, 1.55, 16
    radius = 1.002 * math.hypot(middle, half)
    least, most = math.asin(half / radius) + 0.12, math.pi - 1
    points = [(-1.02 * (math.hypot(middle, half) - middle), 0.0)] + [(-1.0, 0.4 * k) for k in range(-5, 6)]
    for k in range(side):
        a = least + (most - least) * k / (side - 1)
        points += [(middle - radius * math.cos(a), s * radius * math.sin(a)) for s in (1, -1)]
    points += [HIDDEN, (2.9, 30.0), (2.9, -30.0)]
    left, right = ([p for p in points if (p[0] < cut) == first] for first in (True, False))
    first, second = (2, 0) if cut > 1.5 else (1, 1)  # of the segment and point 1
    left += [(middle - 0.9 * radius + 0.01 * r.random(), -0.9 * radius + 0.01 * r.random())
             for _ in range(n // 2 - first - len(left))]
    right += [(100 + 0.01 * r.random(), 0.01 * r.random()) for _ in range(n // 2 - second - len(right))]
    return [(0.0, 0.0, -half, half)] + [(x, x, y, y) for x, y in [(1.5, 0.0)] + left + right]


def write(path, rows):
    path.write_bytes(array.array('d', [c for row in rows for c in row]).tobytes())


def text_of(rows):
    def place(row):
        if len(row) == 2:
            return f'{row[0].hex()} {row[1].hex()}'
        return ' '.join(a.hex() if a == b else f'[{a.hex()},{b.hex()}]' for a, b in (row[:2], row[2:]))
    return '\n'.join(map(place, rows)) + '\n'


def expected(dyadel, rows, *more):
    """The csv of one process, and its exit status."""
    done = subprocess.run([dyadel, 'delaunay', '--quiet', '--comments', *more, '-'], input=text_of(rows).encode(), capture_output=True)
    assert done.returncode in (0, 3, 4), done.stderr
    return done.stdout, done.returncode


def header_of(part):
    return json.loads(part.read_bytes().split(b'\n', 1)[0])


def records_of(part):
    line, body = part.read_bytes().split(b'\n', 1)
    header = json.loads(line)
    assert len(body) == 20 * (header['pairs'] + header['aliases']) + 8
    records = list(struct.iter_unpack('<QQI', body[:-8]))
    return records[:header['pairs']], records[header['pairs']:]


def parts_of(folder):
    manifest = json.loads((pathlib.Path(folder) / 'manifest.json').read_text())
    return [pathlib.Path(folder) / name for name in manifest['parts']]
