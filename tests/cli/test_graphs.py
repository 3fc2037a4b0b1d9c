#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Graphs of neighbours, delaunay --layer graph:nearest|gabriel|mst, against exact oracles: [NNG-1] [GAB-1] [MST-1]
[GRP-1].

Usage: test_graphs.py COMMAND DATA
"""
import itertools
import json
import os
import random
import xml.etree.ElementTree
from fractions import Fraction as F

from harness import DATA, cases, expect, main, run

AIRPORTS = ['--plane', '--columns', 'longitude,latitude', os.path.join(DATA, 'airports.csv')]
GPS = ['--columns', 'east,north', '--radius-column', 'accuracy', os.path.join(DATA, 'gps.csv')]
GRAPHS = ('nearest', 'gabriel', 'mst')
SEED = int(os.environ.get('DYADEL_TEST_SEED', '1'))
SCALE = int(os.environ.get('DYADEL_TEST_SCALE', '1'))


def edges(graph, boxes, *options):
    """{(i, j): 'certain' or 'possible'}; None where two points are one."""
    text = ''.join(f'[{a},{b}] [{c},{d}]\n' if a < b or c < d else f'{a} {c}\n' for a, b, c, d in boxes)
    result = run('delaunay', '--quiet', '--accept-fixpoint', '--layer', 'graph:' + graph, *options, '-', stdin=text)
    expect(result, 0, r'^i,j,status\n')
    if '# alias' in result.out:
        return None
    rows = [line.split(',') for line in result.out.splitlines()[1:]]
    assert [(int(i), int(j)) for i, j, _ in rows] == sorted({(int(i), int(j)) for i, j, _ in rows}), 'not sorted'
    return {(int(i), int(j)): status for i, j, status in rows}


def random_boxes(rng, most, third=True):
    n, size, wide = rng.randint(0, most), rng.choice([3, 6, 20]), rng.choice([0, 1, 2, 4])
    boxes = []
    for _ in range(n):
        x, y = rng.randint(0, size), rng.randint(0, size)
        w, h = (rng.randint(0, wide), rng.randint(0, wide)) if rng.random() < 0.8 else (0, 0)
        part = F(rng.choice([1, 1, 3])) if third else F(1)
        boxes.append((x / part, x / part + w, F(y), F(y + h)))
    return boxes


# ---- one choice of points ----

def squared(a, b):
    return (a[0] - b[0]) ** 2 + (a[1] - b[1]) ** 2


def joined(p, i, j, allowed):
    seen, stack = {i}, [i]
    while stack:
        a = stack.pop()
        for b in range(len(p)):
            if b not in seen and {a, b} != {i, j} and allowed(squared(p[a], p[b])):
                seen.add(b)
                stack.append(b)
    return j in seen


def of_points(p):
    """By the definitions: (weak edges, strict edges) of each graph."""
    n, weak, strict = len(p), {g: set() for g in GRAPHS}, {g: set() for g in GRAPHS}
    for i, j in itertools.permutations(range(n), 2):
        own, others = squared(p[i], p[j]), [squared(p[i], p[k]) for k in range(n) if k not in (i, j)]
        if all(own <= d for d in others):
            weak['nearest'].add((i, j))
        if all(own < d for d in others):
            strict['nearest'].add((i, j))
        if i > j:
            continue
        turns = [sum((p[k][a] - p[i][a]) * (p[k][a] - p[j][a]) for a in (0, 1)) for k in range(n) if k not in (i, j)]
        if all(t >= 0 for t in turns):
            weak['gabriel'].add((i, j))
        if all(t > 0 for t in turns):
            strict['gabriel'].add((i, j))
        if not joined(p, i, j, lambda d: d < own):
            weak['mst'].add((i, j))
        if not joined(p, i, j, lambda d: d <= own):
            strict['mst'].add((i, j))
    return weak, strict


def is_bridge(graph, edge):
    """Returns whether no other edges join its ends."""
    seen, stack = {edge[0]}, [edge[0]]
    while stack:
        a = stack.pop()
        for e in graph:
            for b in set(e) - seen if a in e and e != edge else ():
                seen.add(b)
                stack.append(b)
    return edge[1] not in seen


def test_bridges_are_sure():
    """What alone joins two parts of all that may be in the tree is in it."""
    rng = random.Random(SEED)
    bridges = 0
    for _ in range(10 * SCALE):
        points = [(F(rng.randint(0, 400)), F(rng.randint(0, 400)), rng.randint(0, 5)) for _ in range(60)]
        found = edges('mst', [(x - r, x + r, y - r, y + r) for x, y, r in points]) or {}
        joining = {e for e in found if is_bridge(found, e)}
        assert all(found[e] == 'certain' for e in joining), (joining, points)
        bridges += len(joining)
    assert bridges > 50, bridges


def test_choices_never_refute():
    rng = random.Random(SEED)
    print('seed', SEED)
    open_edges = seen_both = 0
    for _ in range(50 * SCALE):
        boxes = random_boxes(rng, 6)
        found = {g: edges(g, boxes) for g in GRAPHS}
        if None in found.values():
            continue
        ever, lost = {g: set() for g in GRAPHS}, {g: set() for g in GRAPHS}
        for _ in range(80):
            corner = rng.random() < 0.6
            p = [tuple(lo + (hi - lo) * (rng.randint(0, 1) if corner else F(rng.randint(0, 8), 8)) for lo, hi in ((a, b), (c, d)))
                 for a, b, c, d in boxes]
            weak, strict = of_points(p)
            for g in GRAPHS:
                assert weak[g] <= set(found[g]), (g, weak[g] - set(found[g]), boxes, p)
                ever[g] |= weak[g]
                lost[g] |= {e for e in found[g] if e not in strict[g]}
        for g in GRAPHS:
            assert not lost[g] & {e for e in found[g] if found[g][e] == 'certain'}, (g, boxes)
            possible = {e for e in found[g] if found[g][e] == 'possible'}
            open_edges += len(possible)
            seen_both += len(possible & ever[g] & lost[g])
    assert open_edges > 200 and seen_both > 0.9 * open_edges, (open_edges, seen_both)


def of_discs(graph, discs, *options):
    text = 'x,y,r\n' + ''.join(f'{x},{y},{float(r)}\n' for x, y, r in discs)
    result = run('delaunay', '--quiet', '--accept-fixpoint', '--columns', 'x,y', '--radius-column', 'r', '--layer', 'graph:' + graph, *options, '-',
                 stdin=text)
    expect(result, 0, r'^i,j,status\n')
    return {(int(i), int(j)): status for i, j, status in (line.split(',') for line in result.out.splitlines()[1:])}


def place_in(rng, x, y, r):
    """A rational place in the disc, most often on its circle."""
    t = F(rng.randint(-12, 12), rng.randint(1, 6))
    share = rng.choice([1, 1, 1, 0, F(rng.randint(0, 8), 8)]) * r * rng.choice([1, -1])
    return x + share * (1 - t * t) / (1 + t * t), y + share * 2 * t / (1 + t * t)


def test_choices_in_discs_never_refute():
    """[GRD-1]: no choice is refuted, squares say no more than discs, and smaller discs lose nothing that is certain."""
    rng = random.Random(SEED)
    sharper = {'certain': 0, 'no edge': 0}
    for _ in range(25 * SCALE):
        size = rng.choice([6, 20])
        discs = [(x, y, F(rng.randint(0, 6), rng.choice([2, 4]))) for x, y in
                 {(rng.randint(0, size), rng.randint(0, size)) for _ in range(rng.randint(0, 7))}]
        found = {g: of_discs(g, discs, '--discs') for g in GRAPHS}
        for g in GRAPHS:
            squares, inner = of_discs(g, discs), of_discs(g, [(x, y, r / 2) for x, y, r in discs], '--discs')
            for more, less in ((found[g], squares), (inner, found[g])):
                assert set(more) <= set(less), (g, set(more) - set(less), discs)
                assert all(more.get(e) == 'certain' for e in less if less[e] == 'certain'), (g, discs)
            sharper['certain'] += sum(found[g].get(e) == 'certain' != squares[e] for e in squares)
            sharper['no edge'] += len(squares) - len(found[g])
        for _ in range(60):
            p = [place_in(rng, *d) for d in discs]
            if len(set(p)) < len(p):
                continue
            weak, strict = of_points(p)
            for g in GRAPHS:
                assert weak[g] <= set(found[g]), (g, weak[g] - set(found[g]), discs, p)
                assert {e for e in found[g] if found[g][e] == 'certain'} <= strict[g], (g, discs, p)
    assert all(sharper.values()), sharper
    computed = run('delaunay', '--discs', '--radius', '0.2', '--layer', 'graph:mst', '-',
                   stdin='sqrt(2) 0\n0 sqrt(3)\n2 2\nsqrt(5) e\n1/3 pi/7\n')
    expect(computed, 3, r'^i,j,status\n', r'\d+ edges of the graph are certain')


def test_exact_points():
    """All three graphs as they are defined; ties are possible, not certain."""
    rng = random.Random(SEED)
    for _ in range(cases(30 * SCALE)):
        p = list(dict.fromkeys((F(rng.randint(0, 5), rng.choice([1, 3])), F(rng.randint(0, 5))) for _ in range(rng.randint(0, 9))))
        weak, strict = of_points(p)
        for g in GRAPHS:
            found = edges(g, [(x, x, y, y) for x, y in p])
            assert found == {e: 'certain' if e in strict[g] else 'possible' for e in weak[g]}, (g, p, found)


# ---- exactness: the largest value is at a corner of an arrangement of lines ----

def far2(m, box):
    return sum(max(abs(m[a] - box[2 * a]), abs(m[a] - box[2 * a + 1])) ** 2 for a in (0, 1))


def near1(t, lo, hi):
    return max(lo - t, 0, t - hi)


def corners(box):
    return [(x, y) for x in box[:2] for y in box[2:]]


def arrangement(domain, cuts, others):
    """Lines (a, b, c): a x + b y = c: cuts, middles and bisectors of corners."""
    lines = {(F(1), F(0), x) for x in domain[:2]} | {(F(0), F(1), y) for y in domain[2:]}
    lines |= {(F(1), F(0), x) for x in cuts[0]} | {(F(0), F(1), y) for y in cuts[1]}
    points = set()
    for k in others:
        lines |= {(F(1), F(0), (k[0] + k[1]) / 2), (F(0), F(1), (k[2] + k[3]) / 2)}
        points |= set(corners(k))
    for p, q in itertools.combinations(points, 2):
        lines.add((2 * (q[0] - p[0]), 2 * (q[1] - p[1]), q[0] ** 2 + q[1] ** 2 - p[0] ** 2 - p[1] ** 2))
    return lines


def reaches(domain, cuts, level2, others):
    for (a, b, c), (d, e, f) in itertools.combinations(arrangement(domain, cuts, others), 2):
        det = a * e - b * d
        if not det:
            continue
        m = ((c * e - b * f) / det, (a * f - c * d) / det)
        if domain[0] <= m[0] <= domain[1] and domain[2] <= m[1] <= domain[3] and all(far2(m, k) >= level2(m) for k in others):
            return True
    return not others


def may_be_nearest(i, j, others):
    def level2(m):
        return near1(m[0], *j[:2]) ** 2 + near1(m[1], *j[2:]) ** 2
    return reaches(i, (j[:2], j[2:]), level2, others)


def may_be_gabriel(i, j, others):
    def level2(m):
        return sum(max(near1(m[a], *i[2 * a:2 * a + 2]), near1(m[a], *j[2 * a:2 * a + 2])) ** 2 for a in (0, 1))
    cuts = [list(i[2 * a:2 * a + 2] + j[2 * a:2 * a + 2]) + [(i[2 * a] + j[2 * a + 1]) / 2, (i[2 * a + 1] + j[2 * a]) / 2] for a in (0, 1)]
    return reaches(tuple((s + t) / 2 for s, t in zip(i, j)), cuts, level2, others)


def gate(rng):
    """Two sides, and blockers before one of them: a free pair, if any, is free between their middles only."""
    far, small = rng.randint(4, 12), rng.randint(0, 1)
    y = rng.randint(2, 18)
    second = (far, far, 0, 20) if rng.random() < 0.5 else (far, far + small, y, y)
    if rng.random() < 0.2:  # one above the other: nearest where both are equally far
        x, y = rng.randint(1, 4), rng.randint(6, 10)
        return [(0, 0, 0, 6), (0, small, 10, 16), (x, x, y, y + small)]
    boxes = [(0, rng.randint(0, 1), 0, 20), second]
    for low, high in ((0, 7), (12, 20)):
        x, y = rng.randint(1, far - 1), rng.randint(low, high)
        boxes.append((x, x + rng.randint(0, small), y, y + rng.randint(0, 1)))
    return boxes


def test_possible_is_exact():
    """Against all corners of the arrangement, and three or four rectangles, which may touch or overlap."""
    rng = random.Random(SEED)
    seen = {'nearest': [0, 0], 'gabriel': [0, 0]}
    for case in range(60 * SCALE):
        boxes = [tuple(F(v) for v in b) for b in (gate(rng) if case % 2 else random_boxes(rng, 3, third=False))]
        for g, may, pairs in (('nearest', may_be_nearest, itertools.permutations), ('gabriel', may_be_gabriel, itertools.combinations)):
            found = edges(g, boxes)
            for i, j in pairs(range(len(boxes)), 2) if found is not None else ():
                wanted = may(boxes[i], boxes[j], [b for k, b in enumerate(boxes) if k not in (i, j)])
                assert wanted == ((i, j) in found), (g, i, j, wanted, boxes)
                seen[g][wanted] += 1
    assert all(min(s) > 10 for s in seen.values()), seen


def test_monotone():
    """Narrower rectangles: certain edges stay certain, and no new edge is listed."""
    rng = random.Random(SEED)
    for _ in range(cases(20 * SCALE)):
        boxes = random_boxes(rng, 9, third=False)
        before = {g: edges(g, boxes) for g in GRAPHS}
        for _ in range(3):
            boxes = [tuple(lo + (hi - lo) * F(rng.choice(s), 4) for lo, hi in ((a, b), (c, d)) for s in ((0, 0, 1, 2), (2, 3, 4, 4)))
                     for a, b, c, d in boxes]
            after = {g: edges(g, boxes) for g in GRAPHS}
            if None in after.values() or None in before.values():
                break
            for g in GRAPHS:
                assert set(after[g]) <= set(before[g]), (g, boxes, set(after[g]) - set(before[g]))
                assert all(after[g].get(e) == 'certain' for e in before[g] if before[g][e] == 'certain'), (g, boxes)
            before = after


def test_refined():
    """Points are refined until edges of the graph are certain, not only pairs; the exit status shows whether any is
    left."""
    near = 'sqrt(2) 0\n0 0\n-sqrt(2)*3/5 -sqrt(2)*4/5+2^-%d\n'
    for bits in (40, 140, 700):
        result = run('delaunay', '--layer', 'graph:nearest', '-', stdin=near % bits)
        assert result.code == 0 and 'possible' not in result.out and '1,2,' in result.out, result
    result = run('delaunay', '--layer', 'graph:nearest', '--max-bits', '200', '-', stdin=near % 700)
    expect(result, 4, r'(?s).*1,0,possible\n1,2,possible', 'budget: 2 edges of the graph are certain, 2 possible')
    expect(run('delaunay', '--layer', 'graph:nearest', '-', stdin='0 0\n1 0\n0.5 3\n'), 3, r'(?s).*2,0,possible',
           'fixpoint: 2 edges of the graph are certain, 2 possible')
    expect(run('delaunay', '--layer', 'graph:mst', '--radius', '0.3', '-', stdin='sqrt(2) 0\n0 0\n0 sqrt(2)\n'), 3, '(?s).*')


def test_few_points():
    for g in GRAPHS:
        assert edges(g, []) == edges(g, [(1, 1, 2, 2)]) == {}
        both = {(0, 1): 'certain', (1, 0): 'certain'} if g == 'nearest' else {(0, 1): 'certain'}
        assert edges(g, [(0, 0, 0, 0), (3, 4, 0, 1)]) == both
    same = run('delaunay', '--layer', 'graph:mst', '-', stdin='0 0\n1 0\n0 0\n')
    expect(same, 0, r'\A# alias 2 0\ni,j,status\n0,1,certain\n\Z')


def test_airports():
    """Inclusions, one nearest for each, a tree; narrower is more."""
    found = {}
    for radius in ('0.01', '0'):
        wide, found = found, {}
        for g in GRAPHS:
            result = run('delaunay', '--quiet', '--accept-fixpoint', '--layer', 'graph:' + g, '--radius', radius, *AIRPORTS)
            expect(result, 0)
            found[g] = {tuple(map(int, r.split(',')[:2])): r.split(',')[2] for r in result.out.splitlines()[1:] if r[0] != '#'}
        sure = {g: {e for e in found[g] if found[g][e] == 'certain'} for g in GRAPHS}
        assert {(min(e), max(e)) for e in sure['nearest']} <= sure['mst'] <= sure['gabriel']
        assert set(found['mst']) <= set(found['gabriel'])
        for g in wide:
            assert {e for e in wide[g] if wide[g][e] == 'certain'} <= sure[g] and set(found[g]) <= set(wide[g])
    assert [len(found[g]) for g in GRAPHS] == [3376, 7062, 3375], {g: len(found[g]) for g in GRAPHS}
    assert all(s == 'certain' for g in GRAPHS for s in found[g].values())


def test_formats():
    rows = run('delaunay', '-q', '--accept-fixpoint', '--layer', 'graph:nearest', '--id', 'name', *GPS).out.splitlines()
    assert rows[0] == 'i,j,status,id_i,id_j' and rows[1].count(',') == 4, rows[:2]
    wkt = run('delaunay', '-q', '--accept-fixpoint', '--layer', 'graph:mst', '--format', 'wkt', *GPS).out.splitlines()
    assert wkt[0] == 'WKT,i,j,status,max_coordinate_error' and wkt[1].startswith('"LINESTRING ('), wkt[:2]
    answer = json.loads(run('delaunay', '-q', '--accept-fixpoint', '--layer', 'graph:gabriel', '--format', 'geojson', *GPS).out)
    assert {f['properties']['status'] for f in answer['features']} == {'certain', 'possible'}
    for g, title in (('nearest', 'nearest neighbours'), ('gabriel', 'Gabriel graph'), ('mst', 'minimum spanning tree')):
        csv = run('delaunay', '-q', '--accept-fixpoint', '--layer', 'graph:' + g, *GPS).out.splitlines()[1:]
        drawn = run('delaunay', '-q', '--accept-fixpoint', '--layer', 'graph:' + g, '--format', 'svg', *GPS).out
        tree = xml.etree.ElementTree.fromstring(drawn)
        lines = [e.get('id') for e in tree.iter() if (e.get('id') or '').startswith('pair-')]
        pairs = {tuple(sorted(map(int, r.split(',')[:2]))) for r in csv}
        assert len(lines) == len(set(lines)) == len(pairs) and title in drawn, (g, len(lines), len(pairs))
        assert f'possible: {sum("possible" in (e.text or "") and "," in (e.text or "") for e in tree.iter() if e.tag.endswith("title"))}' in drawn
    expect(run('delaunay', '--layer', 'graph:mst', '--format', 'json', *GPS), 2, r'\A\Z', 'graph:mst does not write json')
    expect(run('delaunay', '--layer', 'graph:tree', *GPS), 2, r'\A\Z', 'graph:mst')
    expect(run('delaunay', '--sphere', '--layer', 'graph:mst', *AIRPORTS[1:]), 2, r'\A\Z', 'delaunay --sphere has no layer "graph:mst"; give pairs')
    expect(run('voronoi', '--layer', 'graph:mst', *GPS), 2, r'\A\Z', 'has no layer "graph:mst"')
    expect(run('delaunay', '-q', '--max-pairs', '1', '--radius', '9', '--layer', 'graph:mst', *GPS), 4, r'\A\Z', '--max-pairs')


main(globals())
