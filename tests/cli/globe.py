# SPDX-License-Identifier: LGPL-3.0-or-later
"""Convex hulls of points on a sphere, given by degrees: exactly, in integers.

A determinant of vectors of whole multiples of 360/n degrees is, times 16, a sum of 192 roots of unity of order n: an
algebraic integer whose conjugates are at most 192. So it is 0 or at least 192^(1 - phi(n)): computed to more digits
than that, its sign is known. Other degrees are assumed to be in no such relation, and the assumption is checked."""
import fractions
import itertools

import mpmath

Q = fractions.Fraction


def canonical(place):
    """Longitudes modulo 360; a pole has longitude 0."""
    lon, lat = Q(place[0]), Q(place[1])
    return (Q(0), lat) if abs(lat) == 90 else ((lon + 180) % 360 - 180, lat)


class Globe:
    def __init__(self, digits, zero):
        """Digits of coordinates; determinants below 10^-zero are 0."""
        self.digits, self.least = digits, 10 ** (3 * digits - zero)
        self.known = {}

    def vector(self, place):
        if place not in self.known:
            with mpmath.workdps(self.digits + 20):
                lon, lat = (mpmath.mpf(Q(c).numerator) / Q(c).denominator * mpmath.pi / 180 for c in place)
                v = mpmath.cos(lat) * mpmath.cos(lon), mpmath.cos(lat) * mpmath.sin(lon), mpmath.sin(lat)
                self.known[place] = tuple(int(mpmath.nint(x * 10 ** self.digits)) for x in v)
        return self.known[place]

    def sign(self, a, b, c):
        d = (a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]))
        assert abs(d) < self.least // 10 ** 20 or abs(d) > self.least, 'neither 0 nor apart from it'
        return 0 if abs(d) < self.least else 1 if d > 0 else -1


def minus(a, b):
    return tuple(x - y for x, y in zip(a, b))


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def first_of_each(places):
    places = [canonical(p) for p in places]
    return places, [i for i in range(len(places)) if places.index(places[i]) == i]


def statuses(globe, places):
    """Of each pair that is an edge of the hull, perhaps of a face of more than three corners: legal or tie."""
    places, sites = first_of_each(places)
    at = {i: globe.vector(places[i]) for i in sites}
    found = {}
    for i, j in itertools.combinations(sites, 2):
        edge, rest = minus(at[j], at[i]), [k for k in sites if k not in (i, j)]
        way = {k: minus(at[k], at[i]) for k in rest}

        def same_side(k, l):
            """Of planes through the edge: are k and l on the same half?"""
            return dot(way[k], way[l]) * dot(edge, edge) > dot(way[k], edge) * dot(way[l], edge)

        if not rest:
            found[i, j] = 'legal'
        for k in rest:
            turns = {l: 0 if l == k else globe.sign(edge, way[k], way[l]) for l in rest}
            if min(turns.values()) < 0:
                continue
            strictly = all(t > 0 or same_side(k, l) for l, t in turns.items())
            found[i, j] = 'legal' if strictly or found.get((i, j)) == 'legal' else 'tie'
    return found


def triangles(globe, places):
    """Faces with three corners, counter-clockwise from outside, the lowest first."""
    places, sites = first_of_each(places)
    at = {i: globe.vector(places[i]) for i in sites}
    found = set()
    for t in itertools.combinations(sites, 3):
        for i, j, k in (t, (t[0], t[2], t[1])):
            a, b = minus(at[j], at[i]), minus(at[k], at[i])
            if all(globe.sign(a, b, minus(at[l], at[i])) < 0 for l in sites if l not in t):
                found.add((i, j, k))
    return found
