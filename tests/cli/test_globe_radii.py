#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""dyadel delaunay --sphere with radii in every unit, against true points drawn from the regions [SPH-1] [SPH-5] [FLT-SPH].

Few places, anywhere, about a pole, across 180 degrees, in a town, so that all kinds of eyes occur: places, wide places,
gaps. The oracle is globe.py: signs of determinants of integers, computed until they are certain. Laws: a legal pair is an
edge of every draw, an illegal one of none; a wider radius never decides more; equal radii in other units agree.

Usage: test_globe_radii.py COMMAND DATA
"""
import math
import os
import random
import signal
import subprocess
import time

import globe
import harness
from harness import cases, expect, main, run

SEED = int(os.environ.get('DYADEL_TEST_SEED', '1'))
EARTH = 6371008.8
APART = globe.Globe(80, 40)
# Degrees that one of each is; None: a distance on the ground.
UNITS = {'deg': 1, 'arcmin': 1 / 60, 'arcsec': 1 / 3600, 'm': None, 'km': None, 'mm': None, 'ft': None}
METRES = {'m': 1, 'km': 1000, 'mm': 0.001, 'ft': 0.3048}
FIVE = [(-103, -58), (11, 5), (-82, -59), (15, -18), (150, 0)]


def statuses(places, *options):
    """Statuses of all pairs, illegal ones included; None where the radius leaves no place free."""
    result = run('delaunay', '--sphere', '-q', *options, '-', stdin=''.join(f'{x} {y}\n' for x, y in places))
    if result.code == 1:
        assert 'anywhere' in result.err or 'cannot be told' in result.err, (places, options, result)
        return None
    if result.code == 2:
        assert 'larger than that of the earth' in result.err, (places, options, result)
        return None
    assert result.code in (0, 3), (places, options, result)
    found = {(i, j): 'illegal' for j in range(len(places)) for i in range(j)}
    for line in result.out.splitlines()[1:]:
        if not line.startswith('#'):
            i, j, status = line.split(',')
            found[int(i), int(j)] = status
    return found


def in_cap(place, angle, r):
    """A place at most so far away (radians), in degrees; often as far as possible."""
    lon, lat = math.radians(place[0]), math.radians(place[1])
    far, way = angle * r.choice([1, 1, math.sqrt(r.random())]) * (1 - 1e-9), r.uniform(0, 2 * math.pi)
    z = math.sin(lat) * math.cos(far) + math.cos(lat) * math.sin(far) * math.cos(way)
    east = math.sin(way) * math.sin(far) * math.cos(lat)
    return math.degrees(lon + math.atan2(east, math.cos(far) - math.sin(lat) * z)), math.degrees(math.asin(max(-1, min(1, z))))


def in_box(place, half, r):
    """Longitude and latitude each off by at most `half` degrees, often at a corner. Beyond a pole the longitude turns by 180."""
    x, y = (c + half * r.choice([-1, 1, r.uniform(-1, 1)]) for c in place)
    return (x + 180, math.copysign(180 - abs(y), y)) if abs(y) > 90 else (x, y)


def drawn(places, degrees, unit, r):
    if UNITS[unit]:
        return [in_box(p, degrees, r) for p in places]
    return [in_cap(p, math.radians(degrees), r) for p in places]


def written(degrees, unit):
    """The radius in this unit that is an angle of `degrees`."""
    return f'{degrees / UNITS[unit] if UNITS[unit] else math.radians(degrees) * EARTH / METRES[unit]:.12f}{unit}'


def some_places(r):
    kind, n = r.randrange(5), r.randrange(3, 7)
    def one():
        if kind == 0:
            return r.uniform(-180, 180), math.degrees(math.asin(r.uniform(-1, 1)))
        if kind == 1:
            return r.uniform(-180, 180), r.choice([1, 1, 1, -1]) * r.uniform(80, 90)
        if kind == 2:
            return r.choice([1, -1]) * r.uniform(172, 180), r.uniform(-8, 8)
        if kind == 3:
            return r.choice([0, 60, 119, 180]) + r.uniform(-9, 9), r.choice([-50, 0, 20, 89]) + r.uniform(-1, 1)
        return 13 + r.uniform(0, 3), 52 + r.uniform(0, 2)
    return [(round(x, 3), round(y, 3)) for x, y in (one() for _ in range(n))]


def refuted(stated, places):
    want = globe.statuses(APART, [(repr(x), repr(y)) for x, y in places])
    return [(p, s) for p, s in stated.items()
            if (s == 'legal' and want.get(p) != 'legal') or (s == 'illegal' and p in want) or s == 'tie']


def scale_of(places):
    """The least distance between two, in degrees."""
    at = [[c / 1e80 for c in APART.vector(globe.canonical(p))] for p in places]
    return math.degrees(min(math.dist(a, b) for k, a in enumerate(at) for b in at[:k]))


def test_draws():
    """No draw from the regions contradicts; nor does a wider radius decide more."""
    r = random.Random(SEED)
    stated = {'legal': 0, 'illegal': 0, 'indeterminate': 0}
    for k in range(cases(150)):
        places, unit = some_places(r), r.choice(list(UNITS))
        before, degrees = None, scale_of(places) * r.choice([1e-4, 0.02, 0.1, 0.2, 0.4])
        for step in range(4):
            got = statuses(places, '--radius', written(degrees, unit))
            if got is None:
                break
            for _ in range(4):
                draw = drawn(places, degrees, unit, r)
                assert not refuted(got, draw), (SEED, k, written(degrees, unit), places, draw, refuted(got, draw))
            for p, s in got.items():
                stated[s] += 1
                assert not before or s in ('indeterminate', before[p]), (SEED, k, step, written(degrees, unit), places, p, before, got)
            before, degrees = got, degrees * r.choice([1.3, 2, 5])
    assert min(stated.values()) > (100 if cases(150) >= 150 else cases(150) // 3), stated


def test_gap():
    """All is projected from a gap, and the radius counts."""
    near = [(-100, -58), (8, 2), (-85, -59), (18, -21), (153, 0)]
    want = globe.statuses(APART, near)
    assert want[0, 3] == 'legal' and (2, 4) not in want
    before = None
    for radius in ('0.5deg', '1deg', '2deg', '2.5deg', '3deg', '10deg', '20deg'):
        got = statuses(FIVE, '--radius', radius)
        if radius not in ('0.5deg', '1deg', '2deg', '2.5deg'):
            assert got[2, 4] == got[0, 3] == 'indeterminate', (radius, got)
        assert not before or all(s in ('indeterminate', before[p]) for p, s in got.items()), (radius, before, got)
        before = got
    assert 'legal' in statuses(FIVE, '--radius', '3deg').values()


def test_airports_differ():
    """Of 3,376 airports: the wider the radius in degrees, the fewer are legal."""
    airports = ['--columns', 'longitude,latitude', os.path.join(harness.DATA, 'airports.csv')]
    legal = []
    for radius in ('0.01deg', '0.1deg', '0.5deg'):
        rows = run('delaunay', '--sphere', '-q', '--radius', radius, *airports).out.splitlines()
        legal.append(sum(row.endswith(',legal') for row in rows))
    assert legal[0] > legal[1] > legal[2] > 0, legal


def test_equal_radii():
    """Units, and how a radius is given, make no difference where it is the same."""
    def rows(*radii):
        return [statuses(FIVE, '--radius', radius) for radius in radii]
    for same in (('3deg', '180arcmin', '10800arcsec'), ('200km', '200000m', '200000000mm', '20000000cm'), ('1000ft', '304.8m', '12000in')):
        first, *rest = rows(*same)
        assert first and all(other == first for other in rest), (same, first, rest)


def test_ends():
    """Regions about poles, wide ones, antipodes, one and two places: each ends soon, whatever is known."""
    pole = [(19, 90), (16, 89)]
    sets = [pole, [(0, 90), (0, -90)], [(0, 0), (180, 0)], [(0, 90), (10, 89.9), (77, 89.8), (200, -89.9)], [(5, 5)],
            [(0, 0), (0, 0.001), (0.001, 0)], [(k * 30, 89.9) for k in range(12)], FIVE]
    for places in sets:
        for radius in ('1m', '30km', '111km', '3000km', '6371km', '0.01deg', '1deg', '45deg', '90deg', '200deg', '1e6deg'):
            began = time.monotonic()
            got = statuses(places, '--radius', radius)
            assert time.monotonic() - began < 10, (places, radius)
            if got and places == pole:
                assert got == {(0, 1): 'legal'}, (radius, got)  # two points are neighbours wherever they are
    assert statuses(pole, '--radius', '30km') == {(0, 1): 'legal'}
    for text, code in (('sqrt(2) 0\nsqrt(8)/2 0\n5 5\n', 0), ('sqrt(2) 1\nsqrt(8)/2 1\nsqrt(3) 1\nsqrt(12)/2 1\n', 4)):
        result = run('delaunay', '--sphere', '-q', '--max-bits', '300', '-', stdin=text, timeout=10)
        expect(result, code, '0,1,legal')
        assert 'tie' not in result.out, result


def test_no_ties():
    """Of three places two may be one; each is a neighbour of the third, and none is a tie: regions are not exact.

    Nor is a pair on the hull of images a tie where no other one is open."""
    apart = [(123.628, -27.94), (168.221, 14.555), (165.58, -6.714), (-145.265, -1.229), (48.134, -77.822)]
    assert 'tie' not in statuses(apart, '--radius', '1.107859967098deg').values()
    text = 'lon,lat,a\n0,0,30km\n0.1,0,30km\n50,0,0\n'
    got = run('delaunay', '--sphere', '-q', '--columns', 'lon,lat', '--radius-column', 'a', '-', stdin=text)
    expect(got, 0, '0,1,legal\n0,2,legal\n1,2,legal')


def interval(lower, upper):
    return str(lower) if lower == upper else f'[{lower},{upper}]'


def test_exact_among_wide():
    """Wider regions decide no more where some places are exact: the place that is projected from may be another one."""
    r = random.Random(SEED)
    sets = [[(-181, -178, 31, 31), (-189, -189, 33, 35), (-188, -188, -2, -2), (-188, -188, 38, 40), (-187, -181, 0, 5), (183, 183, -16, -16)]]
    for _ in range(cases(150)):
        (lon, lat), span, share = r.choice([(0, 0), (180, 10), (30, 70)]), r.choice([10, 20, 40]), r.random()
        boxes = []
        for _ in range(r.randint(4, 9)):
            x, y = lon + r.randint(-span, span), max(-85, min(85, lat + r.randint(-span, span)))
            w, h = (0 if r.random() < share else r.choice([0.5, 1, 1.5, 3]) for _ in 'xy')
            boxes.append((x - w, x + w, max(-89, y - h), min(89, y + h)))
        sets.append(boxes)
    for boxes in sets:
        wide = []
        for w, e, s, n in boxes:
            more = r.random() < 0.7 or boxes is sets[0]
            x, y = ((e - w) / 2, (n - s) / 2) if more else (0, 0)
            wide.append((w - x, e + x, max(-90, s - y), min(90, n + y)))
        one, other = (statuses([(interval(w, e), interval(s, n)) for w, e, s, n in b]) for b in (boxes, wide))
        for pair, status in (other or {}).items() if one else ():
            assert status in ('indeterminate', 'tie', one[pair]), (SEED, boxes, wide, pair, one[pair], status)


def test_cancelled():
    """The first SIGTERM ends a long run."""
    places = ''.join(f'{k * 0.07 % 5:.4f},{k * 0.31 % 4 + 84:.4f}\n' for k in range(4000))
    p = subprocess.Popen([harness.COMMAND, 'delaunay', '--sphere', '-q', '--radius', '30km', '-'], stdin=subprocess.PIPE,
                         stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, text=True)
    p.stdin.write(places)
    p.stdin.close()
    time.sleep(1)
    began = time.monotonic()
    p.send_signal(signal.SIGTERM)
    assert p.wait(timeout=60) in (3, 5, -signal.SIGTERM) and time.monotonic() - began < 20, p.returncode


if __name__ == '__main__':
    main(globals())
