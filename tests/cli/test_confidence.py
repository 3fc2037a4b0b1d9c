#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""--sigma-column with --confidence, by simulation [CNF-1]: truths drawn from the normal errors of a file; a run is false
if one of its statements is.

Usage: test_confidence.py COMMAND DATA

Seeds are fixed. With DRAWS truths, a share of false runs of exactly 1 - P would exceed the limit of `most_false` with a
chance below 3e-7 (five standard deviations of the count); more truths would bring the limit nearer to 1 - P."""
import csv
import io
import itertools
import json
import math
import random
import tempfile

from harness import cases, expect, main, nearer_part, run

DRAWS = cases(2000)
N = 12
EARTH = 6371008.8


def most_false(p):
    return DRAWS * (1 - p) + 5 * math.sqrt(DRAWS * p * (1 - p))


def some_file(seed, sigmas, unit='', most=1.2):
    """(x, y, sx, sy, rho) of each row, and the text. sigmas: one, two or three columns."""
    rand = random.Random(seed)
    rows = []
    for _ in range(N):
        sx, sy = (round(rand.uniform(0.05, most), 3) for _ in 'xy')
        rows.append((round(rand.uniform(0, 40), 2), round(rand.uniform(0, 40), 2), sx, sx if sigmas == 1 else sy,
                     rand.choice((-1, -0.8, 0, 0.5, 0.9)) if sigmas == 3 else 0))
    cells = [[r[0], r[1], *(f'{s}{unit}' for s in r[2:4]), r[4]][:2 + sigmas] for r in rows]
    return rows, 'x,y,a,b,c\n' + ''.join(','.join(map(str, (c + [0, 0])[:5])) + '\n' for c in cells)


def columns(sigmas):
    return ['--columns', 'x,y', '--sigma-column', 'a,b,c'[:2 * sigmas - 1]]


def truths(rows, seed):
    rand = random.Random(f'truths {seed}')
    for _ in range(DRAWS):
        out = []
        for x, y, sx, sy, rho in rows:
            e, f = rand.gauss(0, 1), rand.gauss(0, 1)
            out.append((x + sx * e, y + sy * (rho * e + math.sqrt(1 - rho * rho) * f)))
        yield out


def is_edge(p, i, j):
    """By the empty circles through i and j: their centres are an interval of the bisector."""
    (xi, yi), (xj, yj) = p[i], p[j]
    dx, dy, lo, hi = xj - xi, yj - yi, -math.inf, math.inf
    for k, (xk, yk) in enumerate(p):
        if k in (i, j):
            continue
        ux, uy = xk - xi, yk - yi
        a, b = uy * dx - ux * dy, ux * (ux - dx) + uy * (uy - dy)
        if a > 0:
            hi = min(hi, b / a)
        else:
            lo = max(lo, b / a)
    return lo <= hi


def table_of(result):
    return list(csv.DictReader(line for line in io.StringIO(result.out) if line[0] != '#'))


def pairs_of(result):
    expect(result, 3, r'i,j,status')
    return {(int(r['i']), int(r['j'])): r['status'] for r in table_of(result)}


def pairs_are_false(pairs, p, edge=is_edge):
    return any((pairs.get(ij) == 'legal' and not edge(p, *ij)) or (ij not in pairs and edge(p, *ij))
               for ij in itertools.combinations(range(N), 2) if pairs.get(ij) != 'indeterminate')


def test_pairs():
    for sigmas, how in ((1, []), (2, []), (3, []), (1, ['--discs']), (3, ['--discs'])):
        for p, text in ((0.5, '50%'), (0.95, '0.95')):
            rows, file = some_file(f'{sigmas} {how}', sigmas)
            pairs = pairs_of(run('delaunay', *columns(sigmas), '--confidence', text, *how, '-', stdin=file))
            assert 'legal' in pairs.values(), 'nothing is stated'
            false = sum(pairs_are_false(pairs, t) for t in truths(rows, sigmas))
            assert false <= most_false(p), (sigmas, how, p, false)


def test_means():
    """Points of several rows with independent errors, by --merge-by: truths from the mean of the rows' errors, whose weights are
    the inverse variances."""
    for sigmas, how in ((1, []), (2, []), (3, ['--discs'])):
        rand = random.Random(f'means {sigmas}')
        rows = some_file(f'means {sigmas}', sigmas)[0]
        points = []
        for k, (x, y, *s) in enumerate(rows):
            points.append([(round(x + rand.gauss(0, f * s[0]), 3), round(y + rand.gauss(0, f * s[1]), 3), f * s[0], f * s[1], s[2])
                           for f in (1, 2, 0.5)[:1 + k % 3]])
        lines = [f'p{k},' + ','.join(map(str, r)) + '\n' for k, of in enumerate(points) for r in of]
        rand.shuffle(lines)
        said = run('delaunay', *columns(sigmas), *how, '--confidence', '50%', '--id', 'id', '--merge-by', 'id', '-', stdin='id,x,y,a,b,c\n' + ''.join(lines))
        assert f'all {N} points with errors' in said.err, said.err
        pairs = {tuple(sorted(int(r['id_' + e][1:]) for e in 'ij')): r['status'] for r in table_of(said)}
        assert 'legal' in pairs.values(), 'nothing is stated'
        flat, false = [r for of in points for r in of], 0
        for t in truths([(0, 0, *r[2:]) for r in flat], sigmas):
            errors, truth = iter(t), []
            for of in points:
                weights = [[1 / (longest(r) if how else r[2 + a]) ** 2 for a in (0, 1)] for r in of]
                own = [next(errors) for _ in of]
                truth.append(tuple(sum(w[a] * (r[a] + e[a]) for w, r, e in zip(weights, of, own)) / sum(w[a] for w in weights) for a in (0, 1)))
            false += pairs_are_false(pairs, truth)
        assert false <= most_false(0.5), (sigmas, how, false)


def longest(row):
    """The longer half-axis of the ellipse of one standard deviation."""
    sx, sy, rho = row[2:]
    return math.sqrt((sx * sx + sy * sy) / 2 + math.hypot((sx * sx - sy * sy) / 2, rho * sx * sy))


def test_one_sigma_is_no_bound():
    """The same test of standard deviations that are taken for bounds finds them false."""
    rows, file = some_file('z2', 1, most=1.5)
    pairs = pairs_of(run('delaunay', '--columns', 'x,y', '--radius-column', 'a', '-', stdin=file))
    false = sum(pairs_are_false(pairs, t) for t in truths(rows, 0))
    assert false > most_false(0.95), false


def test_regions():
    """All points are in their regions with the probability stated; of discs of circular errors it is known."""
    for sigmas, how in ((1, []), (2, []), (3, []), (1, ['--discs']), (3, ['--discs'])):
        for p in (0.5, 0.95):
            rows, file = some_file(f'regions {sigmas}', sigmas)
            out = run('delaunay', *columns(sigmas), '--confidence', str(p), *how, '--layer', 'points', '-', stdin=file)
            expect(out, 3, 'i,xlo,xhi,ylo,yhi')
            half = [[(float(s[a + 'hi']) - float(s[a + 'lo'])) / 2 for a in 'xy'] for s in table_of(out)]
            outside = 0
            for t in truths(rows, p):
                off = [(abs(q[0] - r[0]), abs(q[1] - r[1])) for q, r in zip(t, rows)]
                outside += any(math.hypot(*o) > h[0] if how else o[0] > h[0] or o[1] > h[1] for o, h in zip(off, half))
            assert outside <= most_false(p), (sigmas, how, p, outside)
            if how and sigmas == 1:
                share = 1 - (1 - (1 - p) / N) ** N
                assert abs(outside - DRAWS * share) <= 5 * math.sqrt(DRAWS * share * (1 - share)), (outside, share)


def test_json():
    file = some_file('json', 2)[1]
    for p in (0.5, 0.95, 0.999):
        d = json.loads(run('delaunay', *columns(2), '--confidence', str(p), '--format', 'json', '-', stdin=file).out)
        k = math.sqrt(2 * math.log(N / (1 - p)))
        assert d['confidence'] == p and d['n'] == N and k <= d['k'] * (1 + 1e-15) <= k * (1 + 1e-12), d['k']


def test_nearest_and_graph():
    rows, file = some_file('nearest', 2)
    places = [(7.5 * a, 7.5 * b) for a in range(6) for b in range(6)]
    with tempfile.NamedTemporaryFile('w', encoding='utf-8') as out:
        out.write(''.join(f'{x} {y}\n' for x, y in places))
        out.flush()
        said = run('nearest', *columns(2), '--confidence', '50%', '--queries', out.name, '-', stdin=file)
    expect(said, 3, r'q,i,status,lo,hi')
    answers = table_of(said)
    graph = table_of(run('delaunay', '--layer', 'graph:nearest', *columns(2), '--confidence', '50%', '-', stdin=file))
    listed = {(int(r['i']), int(r['j'])): r['status'] for r in graph}
    assert any(s.startswith(('sure', 'certain')) for s in listed.values())
    found = [{int(a['i']) for a in answers if int(a['q']) == q} for q in range(len(places))]
    false = 0
    for t in truths(rows, 'nearest'):
        near = [min(range(N), key=lambda i: math.dist(t[i], q)) for q in places]
        links = {(i, min((j for j in range(N) if j != i), key=lambda j: math.dist(t[i], t[j]))) for i in range(N)}
        false += (any(n not in f for n, f in zip(near, found)) or not links <= set(listed)
                  or any(s.startswith(('sure', 'certain')) and p not in links for p, s in listed.items())
                  or any(not float(a['lo']) <= math.dist(t[int(a['i'])], places[int(a['q'])]) <= float(a['hi']) for a in answers))
    assert false <= most_false(0.5), false


def area(polygon):
    return abs(sum(x * v - u * y for (x, y), (u, v) in zip(polygon, polygon[1:] + polygon[:1]))) / 2


def test_voronoi():
    """Areas of cells on a window."""
    rows, file = some_file('cells', 1)
    said = run('voronoi', *columns(1), '--confidence', '0.5', '--window=0,40,0,40', '-', stdin=file)
    expect(said, 3, r'i,xlo')
    cells = {int(r['i']): (float(r['area_lo']), float(r['area_hi'])) for r in table_of(said)}
    false = 0
    for t in truths(rows, 'cells'):
        for i in range(N):
            polygon = [(0, 0), (40, 0), (40, 40), (0, 40)]
            for j in range(N):
                if j != i and polygon:
                    polygon = nearer_part(polygon, t[i], t[j])
            lo, hi = cells.get(i, (0, 0))
            if not lo - 1e-9 <= area(polygon) <= hi + 1e-9:
                false += 1
                break
    assert false <= most_false(0.5), false


def globe_edge(v, i, j):
    """The half-planes through the chord: the others leave a gap of half a turn."""
    a, b = v[i], v[j]
    e, m = [y - x for x, y in zip(a, b)], [x + y for x, y in zip(a, b)]
    f = e[1] * m[2] - e[2] * m[1], e[2] * m[0] - e[0] * m[2], e[0] * m[1] - e[1] * m[0]
    sm, sf = math.hypot(*m), math.hypot(*f)
    at = sorted(math.atan2(sum((x - y) * z for x, y, z in zip(p, a, f)) / sf, sum((x - y) * z for x, y, z in zip(p, a, m)) / sm)
                for k, p in enumerate(v) if k not in (i, j))
    return max([y - x for x, y in zip(at, at[1:])] + [at[0] + 2 * math.pi - at[-1]]) >= math.pi


def test_globe():
    """Errors on the ground, in metres; the points are within a degree of each other."""
    rows, file = some_file('globe', 3, 'km')
    rows = [(10 + r[0] / 20, 50 + r[1] / 20, *(1000 * s for s in r[2:4]), r[4]) for r in rows]
    file = 'x,y,a,b,c\n' + ''.join(f'{x},{y},{sx / 1000}km,{sy}m,{rho}\n' for x, y, sx, sy, rho in rows)
    pairs = pairs_of(run('delaunay', '--sphere', *columns(3), '--confidence', '50%', '-', stdin=file))
    assert 'legal' in pairs.values(), 'nothing is stated'
    false = 0
    for t in truths([(0, 0, *r[2:]) for r in rows], 'globe'):
        places = []
        for (x, y, *_), (east, north) in zip(rows, t):
            far, way = math.hypot(east, north) / EARTH, math.atan2(east, north)
            lat, lon = math.radians(y), math.radians(x)
            s = math.asin(math.sin(lat) * math.cos(far) + math.cos(lat) * math.sin(far) * math.cos(way))
            lon += math.atan2(math.sin(way) * math.sin(far) * math.cos(lat), math.cos(far) - math.sin(lat) * math.sin(s))
            places.append((math.cos(s) * math.cos(lon), math.cos(s) * math.sin(lon), math.sin(s)))
        false += pairs_are_false(pairs, places, globe_edge)
    assert false <= most_false(0.5), false


def test_messages():
    table = 'x,y,s,t\n0,0,1,0.5\n9,1,2,-2\n4,8,0,0\n'
    good = ['--columns', 'x,y', '--sigma-column', 's']
    note = r'-: with probability at least {} % everything stated here holds: then all 2 points with errors are within k = '
    for text, shown in (('95%', '95'), ('0.95', '95'), ('99.90 %', '99.9'), ('.5', '50'), ('1e-3', '0.1')):
        result = run('delaunay', *good, '--confidence', text, '-', stdin=table)
        expect(result, result.code, r'i,j,status', note.format(shown.replace('.', r'\.')))
    for wrong in ('1', '100%', '95', '0', '-0.5', 'x', '1/2', '%'):
        expect(run('delaunay', *good, f'--confidence={wrong}', '-', stdin=table), 2, r'\A\Z', 'is not a decimal above 0 and below 1; give one such as 95% or 0.95')
    expect(run('delaunay', *good, '-', stdin=table), 2, r'\A\Z', '--confidence 95%')
    expect(run('delaunay', '--columns', 'x,y', '--confidence', '0.9', '-', stdin=table), 2, r'\A\Z', 'name the column of their standard deviations: --sigma-column')
    expect(run('delaunay', '--columns', 'x,y', '--sigma-column', 's,s,s,s', '--confidence', '0.9', '-', stdin=table), 2, r'\A\Z', 'give S or SX,SY or SX,SY,RHO')
    expect(run('delaunay', '--columns', 'x,y', '--sigma-column', 't', '--confidence', '0.9', '-', stdin=table), 1, r'\A\Z', r"-:3:7: the standard deviation is negative; .* --missing '-2' --skip-missing")
    expect(run('delaunay', '--columns', 'x,y', '--sigma-column', 's,s,t', '--confidence', '0.9', '-', stdin=table), 1, r'\A\Z', '-:3:7: the correlation is not an exact number from -1 to 1')
    expect(run('delaunay', '--sphere', *good, '--confidence', '0.9', '-', stdin=table), 2, r'\A\Z', 'the standard deviation 1 has no unit; state a unit: --radius-unit m')
    expect(run('delaunay', '--columns', 'x,y', '--sigma-column', 's', '--confidence', '0.9', '-', stdin='x,y,s\n0,0,1e308\n1,1,1e308\n'), 1, r'\A\Z', 'above the range of doubles')
    expect(run('tolerance', '--columns', 'x,y', '--sigma-column', 's,s', '-', stdin=table), 2, r'\A\Z', 'is not one column name')


def test_units_and_scale():
    """A scale, a unit in the column's name, as with radii; equal points are one, by --merge."""
    def sides(text, *words):
        return json.loads(run('delaunay', *words, '--confidence', '0.9', '--format', 'json', '-', stdin=text).out)['sites']
    table = 'x,y,s\n0,0,0.5\n100,0,2\n0,100,1\n'
    assert sides(table, '--columns', 'x,y', '--sigma-column', 's', '--radius-scale', '2') == sides(
        table.replace(',0.5', ',1').replace(',2', ',4').replace(',1\n', ',2\n', 2).replace('0,0,2\n', '0,0,1\n'), '--columns', 'x,y', '--sigma-column', 's')
    globe = 'x,y,s(m)\n0,0,1500\n20,0,2000\n0,20,1000\n'
    assert sides(globe, '--sphere', '--columns', 'x,y', '--sigma-column', 's(m)') == sides(
        globe.replace('(m)', ''), '--sphere', '--columns', 'x,y', '--sigma-column', 's', '--radius-unit', 'm')
    twice = sides('x,y,s\n0,0,3\n50,50,1\n0,0,1\n', '--columns', 'x,y', '--sigma-column', 's', '--merge')
    k = math.sqrt(2 * math.log(3 / 0.1))
    assert len(twice) == 2 and abs(twice[0]['x_decimal'][1] - k) < 1e-9, twice


main(globals())
