# SPDX-License-Identifier: LGPL-3.0-or-later
"""T as a region: hulls of rectangles, and the exterior of all possible edges [EXT-1]."""
import itertools

import oracle


def inside(z, ring):
    """1 inside of a polygon, 0 on it, -1 outside, exactly."""
    odd = False
    for a, b in zip(ring, ring[1:] + ring[:1]):
        t = oracle.turn(a, b, z)
        if t == 0 and min(a, b) <= z <= max(a, b):
            return 0
        odd ^= (a[1] <= z[1]) != (b[1] <= z[1]) and (t > 0) == (b[1] > a[1])
    return 1 if odd else -1


def in_exterior(z, rings):
    """Of the rings of --layer exterior: outside of the first, or inside of another one."""
    return not rings or inside(z, rings[0]) < 0 or any(inside(z, r) > 0 for r in rings[1:])


def judge_hulls(judge, case, c, ch):
    """Each edge of this choice is in the hull of its pair, each triangle stated in its own."""
    for i, j in itertools.combinations(ch.sites, 2):
        if ch.edge(i, j) >= 0:
            judge((i, j) in c['hulls'], 'the edge %d,%d has no hull', i, j)
    for sites, ring in c['hulls'].items():
        for k in sites:
            judge(inside(ch.points[k], ring) >= 0, 'point %d is not in the hull of %s', k, sites)
        judge(len(sites) < 3 or ch.triangle(*sites) == 1, 'triangle %s is not there', sites)


def judge_exterior(judge, case, c, ch):
    """No place of an edge of this choice is in the exterior."""
    for i, j in itertools.combinations(ch.sites, 2):
        if ch.edge(i, j) >= 0:
            for k in range(9):
                z = tuple(a + (b - a) * k / 8 for a, b in zip(ch.points[i], ch.points[j]))
                judge(not in_exterior(z, c['exterior']), 'the edge %d,%d is in the exterior', i, j)
