# SPDX-License-Identifier: LGPL-3.0-or-later
"""Decides statements about one choice of points from the definitions, apart from the engine.

In the plane everything is exact: a choice is a list of pairs of fractions, brought to whole numbers. On the sphere a
choice is a list of places; signs of determinants come from enclosures at rising precision, and are 0 where none of
these precisions tells. Each function returns 1 (certainly), 0 (only weakly, or unknown on the sphere), -1 (certainly
not), so that a statement is refuted by a number alone.
"""
import fractions
import itertools
import math
import random

import mpmath

Q = fractions.Fraction
EARTH = Q('6371008.8')


# ---- the plane ----

def whole(points):
    """The points times the least common denominator, as whole numbers, and that denominator."""
    d = 1
    for x, y in points:
        d = math.lcm(d, x.denominator, y.denominator)
    return [(x.numerator * (d // x.denominator), y.numerator * (d // y.denominator)) for x, y in points], d


def edge(p, i, j, sites):
    """1: a strict Delaunay edge, or one place; 0: an edge of some Delaunay triangulation only; -1: none.

    Centres of discs through both are middle + t n / 2, n the normal: each other site bounds t from one side."""
    xi, yi = p[i]
    dx, dy = p[j][0] - xi, p[j][1] - yi
    if dx == dy == 0:
        return 1
    lo = hi = None
    strict, between, sides = True, False, set()
    for k in sites:
        if k == i or k == j:
            continue
        ux, uy = p[k][0] - xi, p[k][1] - yi
        a, b = uy * dx - ux * dy, ux * (ux - dx) + uy * (uy - dy)
        if a == 0:
            between |= b < 0
            strict &= b != 0
        elif a > 0:
            sides.add(1)
            if hi is None or b * hi[1] < hi[0] * a:
                hi = b, a
        else:
            sides.add(-1)
            if lo is None or b * lo[1] < lo[0] * -a:
                lo = b, -a  # t >= -b / -a
    if between:
        return 0 if len(sides) < 2 else -1
    room = 1
    if lo is not None and hi is not None:
        room = hi[0] * lo[1] + lo[0] * hi[1]
    return -1 if room < 0 else 1 if room > 0 and strict else 0


def edges(p, sites):
    return {(i, j): edge(p, i, j, sites) for i, j in itertools.combinations(sites, 2)}


def turn(a, b, c):
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def dot(a, b, c):
    return (b[0] - a[0]) * (c[0] - a[0]) + (b[1] - a[1]) * (c[1] - a[1])


def far2(a, b):
    return (a[0] - b[0]) ** 2 + (a[1] - b[1]) ** 2


def corner(p, i, sites):
    """1: a corner of the convex hull; 0: on its boundary only, or another site is at the same place; -1: inside."""
    rest = [k for k in sites if k != i]
    same = any(p[k] == p[i] for k in rest)
    rest = [k for k in rest if p[k] != p[i]]
    best = 1 if not rest else -1
    for k in rest:
        turns = [(turn(p[i], p[k], p[l]), dot(p[i], p[k], p[l])) for l in rest]
        if all(t >= 0 for t, _ in turns):
            best = max(best, 1 if all(t > 0 or d > 0 for t, d in turns) else 0)
    return min(best, 0) if same else best


def hull_edge(p, i, j, sites):
    """1: all others are strictly on one side of the line; 0: none is strictly on both sides; -1: no."""
    if p[i] == p[j]:
        return 0
    s = [turn(p[i], p[j], p[k]) for k in sites if k not in (i, j)]
    if not s or min(s) > 0 or max(s) < 0:
        return 1
    return 0 if min(s) >= 0 or max(s) <= 0 else -1


def in_circle(a, b, c, d):
    """Above 0: d is inside the circle through a, b, c, which turn left."""
    m = [(q[0] - d[0], q[1] - d[1]) for q in (a, b, c)]
    s = [x * x + y * y for x, y in m]
    return (m[0][0] * (m[1][1] * s[2] - s[1] * m[2][1]) - m[0][1] * (m[1][0] * s[2] - s[1] * m[2][0]) +
            s[0] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]))


def triangle(p, i, j, k, sites):
    """1: i, j, k turn left, and no site is in or on their circle."""
    if turn(p[i], p[j], p[k]) <= 0:
        return -1
    signs = [in_circle(p[i], p[j], p[k], p[l]) for l in sites if l not in (i, j, k)]
    return -1 if any(s > 0 for s in signs) else 0 if any(s == 0 for s in signs) else 1


def graph_nearest(p, i, j, sites):
    d = far2(p[i], p[j])
    rest = [far2(p[i], p[k]) for k in sites if k not in (i, j)]
    return 1 if all(d < r for r in rest) else 0 if all(d <= r for r in rest) else -1


def graph_gabriel(p, i, j, sites):
    rest = [dot(p[k], p[i], p[j]) for k in sites if k not in (i, j)]
    return 1 if all(r > 0 for r in rest) else 0 if all(r >= 0 for r in rest) else -1


def graph_mst(p, i, j, sites):
    """Returns -1 if shorter edges join i and j (no tree has the edge), 0 if no longer ones do (some tree lacks it),
    else 1."""
    d = far2(p[i], p[j])

    def joined(fits):
        seen, todo = {i}, [i]
        while todo:
            a = todo.pop()
            for b in sites:
                if b not in seen and {a, b} != {i, j} and fits(far2(p[a], p[b])):
                    seen.add(b)
                    todo.append(b)
        return j in seen
    if joined(lambda l: l < d):
        return -1
    return 0 if joined(lambda l: l <= d) else 1


GRAPHS = {'nearest': graph_nearest, 'gabriel': graph_gabriel, 'mst': graph_mst}


def half(poly, a, b, c):
    """The part of a convex polygon in which a x + b y <= c."""
    out, signs = [], [a * u + b * v - c for u, v in poly]
    for n, (u, fu) in enumerate(zip(poly, signs)):
        v, fv = poly[(n + 1) % len(poly)], signs[(n + 1) % len(poly)]
        if fu <= 0:
            out.append(u)
        if (fu < 0 < fv) or (fv < 0 < fu):
            t = fu / (fu - fv)
            out.append((u[0] + t * (v[0] - u[0]), u[1] + t * (v[1] - u[1])))
    return out


def cell(points, k, window, sites):
    """The polygon of places of the window (xlo, xhi, ylo, yhi) to which site k is nearest, in fractions."""
    xlo, xhi, ylo, yhi = window
    poly = [(xlo, ylo), (xhi, ylo), (xhi, yhi), (xlo, yhi)]
    px, py = points[k]
    for q in sites:
        qx, qy = points[q]
        if q == k or (qx, qy) == (px, py):
            continue
        a, b = qx - px, qy - py
        poly = half(poly, a, b, (qx * qx + qy * qy - px * px - py * py) / 2)
        if not poly:
            return []
    return poly


def common(poly, convex):
    """The part of a convex polygon in another one, which is counter-clockwise."""
    for (ux, uy), (vx, vy) in zip(convex, convex[1:] + convex[:1]):
        poly = half(poly, vy - uy, ux - vx, (vy - uy) * ux + (ux - vx) * uy) if poly else []
    return poly


def area(poly):
    return abs(sum(u[0] * v[1] - u[1] * v[0] for u, v in zip(poly, poly[1:] + poly[:1]))) / 2 if poly else Q(0)


def centre(a, b, c):
    """The centre of the circle through three points in fractions."""
    ux, uy, vx, vy = b[0] - a[0], b[1] - a[1], c[0] - a[0], c[1] - a[1]
    d = 2 * (ux * vy - uy * vx)
    if d == 0:
        return None
    u, v = ux * ux + uy * uy, vx * vx + vy * vy
    return a[0] + (vy * u - uy * v) / d, a[1] + (ux * v - vx * u) / d


def ranks(points, at, sites):
    """Squared distances of the sites from a place."""
    return {k: far2(points[k], at) for k in sites}


def root(x, up, bits=200):
    """A lower or an upper bound of the square root of a fraction, within 2^-bits of itself."""
    shift = max(0, bits - (x.numerator.bit_length() - x.denominator.bit_length()) // 2)
    n = (x.numerator << 2 * shift) // x.denominator
    r = math.isqrt(n)
    return Q(r + (1 if up else 0), 1 << shift)


def across(a, b, c, d):
    """The cross product of b - a and d - c."""
    return (b[0] - a[0]) * (d[1] - c[1]) - (b[1] - a[1]) * (d[0] - c[0])


def annulus(points, i, j, sites):
    """The largest of min |c - p_k| - |c - p_i| over the centres c on the bisector of i and j (mathematics, section 12),
    to about 100 digits: at a crossing of two such differences, at the largest value of one, or at infinity."""
    digits = max((c - d).numerator.bit_length() + (c - d).denominator.bit_length() for k in sites for c, d in zip(points[k], points[i]))
    with mpmath.workprec(400 + 4 * digits):
        def num(x):
            return mpmath.mpf(x.numerator) / x.denominator
        x0, y0 = points[i]
        p = {k: (num(points[k][0] - x0), num(points[k][1] - y0)) for k in sites}
        (dx, dy), rest = p[j], [k for k in sites if k not in (i, j)]
        if not rest:
            return mpmath.inf
        size = mpmath.hypot(dx, dy)
        mx, my, nx, ny = dx / 2, dy / 2, -dy / size, dx / size

        def lowest(t):
            cx, cy = mx + t * nx, my + t * ny
            return min(mpmath.hypot(cx - p[k][0], cy - p[k][1]) for k in rest) - mpmath.hypot(cx, cy)
        best = max(min(-s * (p[k][0] * nx + p[k][1] * ny) for k in rest) for s in (-1, 1))
        for k, l in itertools.combinations(rest, 2):
            ex, ey = p[l][0] - p[k][0], p[l][1] - p[k][1]
            along = ex * nx + ey * ny
            if across(points[k], points[l], points[i], points[j]) != 0:  # `along` itself is rounded
                hx, hy = (p[l][0] + p[k][0]) / 2 - mx, (p[l][1] + p[k][1]) / 2 - my
                best = max(best, lowest((ex * hx + ey * hy) / along))
        for k in rest:
            for q, a, b in (((mpmath.mpf(0), mpmath.mpf(0)), points[i], points[j]), ((dx, dy), points[j], points[i])):
                # where the line from p_k through p_i, or p_j, meets the bisector
                ex, ey = p[k][0] - q[0], p[k][1] - q[1]
                along = ex * dx + ey * dy
                if dot(a, points[k], b) != 0:
                    s = ((mx - q[0]) * dx + (my - q[1]) * dy) / along
                    best = max(best, lowest((q[0] + s * ex - mx) * nx + (q[1] + s * ey - my) * ny))
        return best


# ---- regions in the plane: least and largest distances ----

def near_far_box(box, c):
    """Squares of the least and of the largest distance of a box (xlo, xhi, ylo, yhi) from c: fractions."""
    xlo, xhi, ylo, yhi = box
    nx, ny = max(xlo - c[0], 0, c[0] - xhi), max(ylo - c[1], 0, c[1] - yhi)
    fx, fy = max(abs(xlo - c[0]), abs(xhi - c[0])), max(abs(ylo - c[1]), abs(yhi - c[1]))
    return nx * nx + ny * ny, fx * fx + fy * fy


def witness_holds(regions, i, j, c, sites):
    """Returns whether a disc about c holds regions i and j, and meets no other region. Exact for boxes; for discs by
    enclosures of square roots, so that True is proved."""
    if all(r[0] == 'box' for r in regions.values()):
        most = max(near_far_box(regions[k][1:], c)[1] for k in (i, j))
        return all(most < near_far_box(regions[k][1:], c)[0] for k in sites if k not in (i, j))

    def far(r):
        return root(near_far_box(r[1:], c)[1], True) if r[0] == 'box' else root(far2(r[1:3], c), True) + r[3]

    def near(r):
        return root(near_far_box(r[1:], c)[0], False) if r[0] == 'box' else root(far2(r[1:3], c), False) - r[3]
    most = max(far(regions[k]) for k in (i, j))
    return all(most < near(regions[k]) for k in sites if k not in (i, j))


# ---- the sphere ----

def exact(v):
    """A number of mpmath as a fraction."""
    return (-1 if v < 0 else 1) * abs(Q(int(v.man))) * Q(2) ** int(v.exp)


def unit(v):
    size = mpmath.sqrt(sum(x * x for x in v))
    return tuple(x / size for x in v) if size > mpmath.mpf(2) ** -60 else None


class Sphere:
    """One choice of places: each is (longitude, latitude) in degrees, or (longitude, latitude, angle, bearing): the
    place at an angle (in radians, as a fraction) from there, in the direction `bearing` (in turns)."""

    def __init__(self, places, sites):
        self.places, self.sites = places, list(sites)
        self.rung, self.known = 0, {}
        self.vectors = {0: [self.double(p) for p in places]}

    @staticmethod
    def frame(m, lon, lat):
        cl, sl, cf, sf = m.cos(lon), m.sin(lon), m.cos(lat), m.sin(lat)
        return (cf * cl, cf * sl, sf), (-sf * cl, -sf * sl, cf), (-sl, cl, 0)

    @classmethod
    def place(cls, m, number, p):
        lon, lat = (number(c) * m.pi / 180 for c in p[:2])
        up, north, east = cls.frame(m, lon, lat)
        if len(p) == 2:
            return up
        a, b = number(p[2]), number(p[3]) * 2 * m.pi
        s, c, cb, sb = m.sin(a), m.cos(a), m.cos(b), m.sin(b)
        return tuple(c * u + s * (cb * n + sb * e) for u, n, e in zip(up, north, east))

    @classmethod
    def double(cls, p):
        return cls.place(math, float, p)

    def at(self, rung):
        """Unit vectors at 200 or 1000 bits, of which 40 are taken for lost."""
        if rung not in self.vectors:
            with mpmath.workprec(PRECISIONS[rung]):
                self.vectors[rung] = [self.place(mpmath, lambda c: mpmath.mpf(c.numerator) / c.denominator, p)
                                      for p in self.places]
        return self.vectors[rung]

    def sign(self, i, j, k, l):
        """Sign of the determinant of j - i, k - i, l - i; 0 where no precision decides."""
        key = tuple(sorted((i, j, k, l)))
        if key not in self.known:
            self.known[key] = self.signed(*key)
        order, s = [i, j, k, l], self.known[key]
        for n in range(4):  # the parity of the permutation
            m = order.index(key[n])
            if m != n:
                order[n], order[m] = order[m], order[n]
                s = -s
        return s

    def signed(self, i, j, k, l):
        for rung, least in enumerate(LEAST):
            v = self.at(rung)
            with mpmath.workprec(PRECISIONS[rung]):
                a, b, c = (tuple(x - y for x, y in zip(v[q], v[i])) for q in (j, k, l))
                d = (a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
                     a[2] * (b[0] * c[1] - b[1] * c[0]))
                if abs(d) > least:
                    return 1 if d > 0 else -1
        return 0

    def triangle(self, i, j, k):
        """1: no site is beyond the plane through i, j, k, counter-clockwise from outside."""
        if len({self.places[q] for q in (i, j, k)}) < 3:
            return 0
        signs = [self.sign(i, j, k, l) for l in self.sites if l not in (i, j, k)]
        return -1 if 1 in signs else 0 if 0 in signs else 1

    def edge(self, i, j):
        """1: an edge of the hull in space, by a face about which nothing is unsure; -1: each plane through both has
        sites on both sides; 0: unknown."""
        rest = [k for k in self.sites if k not in (i, j)]
        if len(rest) < 2:
            return 1 if len(rest) == 0 or self.distinct() else 0
        best = -1
        for k in rest:
            signs = [self.sign(i, j, k, l) for l in rest if l != k]
            if 1 in signs and -1 in signs:
                continue
            if 0 not in signs:
                return 1
            best = 0
        return best

    def angle(self, rung, i, at):
        """Between place i and another one, in radians."""
        v = self.at(rung)[i]
        w = self.place(mpmath, lambda c: mpmath.mpf(c.numerator) / c.denominator, at) if rung else self.double(at)
        m = mpmath if rung else math
        less, more = (m.sqrt(sum((x + s * y) ** 2 for x, y in zip(v, w))) for s in (-1, 1))
        return 2 * m.atan2(less, more)

    def nearer(self, at, k, m):
        """Below 0: k is nearer to the place than m; above 0: farther; 0 where no precision decides."""
        for rung, least in enumerate(LEAST):
            with mpmath.workprec(PRECISIONS[rung]):
                d = self.angle(rung, k, at) - self.angle(rung, m, at)
                if abs(d) > least:
                    return 1 if d > 0 else -1
        return 0

    def is_within(self, at, k, lo, hi):
        """Returns whether the way along the ground is between these bounds, in metres."""
        with mpmath.workprec(PRECISIONS[1]):
            d, near = exact(self.angle(1, k, at)) * EARTH, Q(1, 2 ** 150)
        return (lo is None or lo <= d + near) and (hi is None or d <= hi + near)

    def is_in(self, i, xlo, xhi, ylo, yhi):
        """Returns whether place i is in these degrees, longitudes modulo 360. Places at an angle are known to 190 bits:
        those as near to an end count as inside."""
        near = 0
        lon, lat = self.places[i][:2]
        if len(self.places[i]) > 2:
            near, v = Q(1, 2 ** 180), self.at(1)[i]
            with mpmath.workprec(PRECISIONS[1]):
                lon, lat = (exact(mpmath.atan2(a, b) * 180 / mpmath.pi) for a, b in
                            ((v[1], v[0]), (v[2], mpmath.hypot(v[0], v[1]))))
        pole = 90 - abs(lat) <= Q(1, 10 ** 9)
        return ylo - near <= lat <= yhi + near and (pole or (lon - xlo + near) % 360 <= xhi - xlo + 2 * near)

    def distinct(self):
        v = self.at(1)
        with mpmath.workprec(PRECISIONS[1]):
            return all(max(abs(x - y) for x, y in zip(v[a], v[b])) > LEAST[1]
                       for a, b in itertools.combinations(self.sites, 2))

    def edges(self):
        return {(i, j): self.edge(i, j) for i, j in itertools.combinations(self.sites, 2)}

    def direction(self, i, j, k):
        """Of the vertex of three places, as a unit vector to 100 bits; None: there is none."""
        v = self.at(1)
        with mpmath.workprec(PRECISIONS[1]):
            a, b = (tuple(x - y for x, y in zip(v[q], v[i])) for q in (j, k))
            return unit((a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]))

    @staticmethod
    def between(a, b):
        with mpmath.workprec(PRECISIONS[1]):
            return unit(tuple(x + y for x, y in zip(a, b)))

    def nearer_spot(self, spot, k, m):
        """Below 0: k is nearer to the unit vector than m; above 0: farther; 0: as far, to 100 bits."""
        v = self.at(1)
        with mpmath.workprec(PRECISIONS[1]):
            d = sum(s * (y - x) for s, x, y in zip(spot, v[k], v[m]))
            return 0 if abs(d) < mpmath.mpf(2) ** -100 else 1 if d > 0 else -1

    def spots(self, i, corners, seed):
        """Unit vectors: in a cell with these corners, near its rim, and anywhere."""
        rand = random.Random(f'spots {i} {seed}')
        v = self.at(1)[i]
        with mpmath.workprec(PRECISIONS[1]):
            out = [v, tuple(mpmath.mpf(rand.gauss(0, 1)) for _ in v)]
            corners = [c for c in corners if c]  # of places on one great circle there is none
            for c in rand.sample(corners, min(3, len(corners))):
                t = mpmath.mpf(rand.choice((0.5, 0.99, 1.01, 1.5)))
                out.append(tuple(x + t * (y - x) for x, y in zip(v, c)))
            return [s for s in map(unit, out) if s]

    def inside(self, sides, i, spot):
        """1: the spot is on the side of each arc where place i is; -1: beyond one of them; 0: unknown."""
        with mpmath.workprec(PRECISIONS[1]):
            signs = []
            for a, b in sides:
                n = (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
                d, e = (sum(x * y for x, y in zip(n, q)) for q in (self.at(1)[i], spot))
                least = mpmath.mpf(2) ** -90
                signs.append(0 if abs(d) < least or abs(e) < least else 1 if (d > 0) == (e > 0) else -1)
            return -1 if -1 in signs else 0 if 0 in signs else 1

    def vertex(self, i, j, k):
        """The place farthest from the other side of the plane through i, j, k: longitude and latitude to 100 bits."""
        v = self.at(1)
        with mpmath.workprec(PRECISIONS[1]):
            a, b = (tuple(x - y for x, y in zip(v[q], v[i])) for q in (j, k))
            n = (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
            size = mpmath.sqrt(sum(x * x for x in n))
            if size == 0:
                return None
            return (mpmath.atan2(n[1], n[0]) * 180 / mpmath.pi,
                    mpmath.atan2(n[2], mpmath.hypot(n[0], n[1])) * 180 / mpmath.pi)


PRECISIONS, LEAST = (53, 240, 1100), (1e-11, mpmath.mpf(2) ** -190, mpmath.mpf(2) ** -1040)
