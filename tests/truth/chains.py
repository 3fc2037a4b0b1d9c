# SPDX-License-Identifier: LGPL-3.0-or-later
"""Scott continuity: along a chain of rectangles every map only gains statements, and what it states of the limit, the
intersection of the chain, it states from some rectangle of the chain on. So the sup of the images is the image of the sup.

A map is a row of MAPS: it returns the statements of a run as a set, with more of them for more information: a pair is
legal, or illegal; a place is inside, or outside. What says nothing for certain ("indeterminate", "possible") is no member."""
import csv
import itertools
import random

import region
from axes import Q
from product import Hangs

#: By how much each side of the limit is outside of it, along the chain; 0 comes last.
WIDER = (Q(2), Q(1, 4), Q(1, 2 ** 9), Q(1, 2 ** 40), Q(1, 2 ** 700))


def dyadic(q):
    return f'{q.numerator}*2^-{q.denominator.bit_length() - 1}'


def points_text(rects):
    return ''.join('[%s,%s] [%s,%s]\n' % tuple(map(dyadic, r)) for r in rects)


def discs_text(rects):
    """The discs about the lower left corners whose radius is the width in x: nested, as the corners stay."""
    return ''.join(f'{dyadic(r[0])}+-{dyadic(r[1] - r[0])} {dyadic(r[2])}+-{dyadic(r[1] - r[0])}\n' for r in rects)


def table(product, words, text):
    product.text = None
    status, out, err = product.run([words[0], product('chain.txt', text), *words[1:], '--quiet'])
    if status not in (0, 3):
        raise ValueError(f'exit {status}: {err.strip()[-200:]}')
    return list(csv.DictReader(out.splitlines()))


def pairs(product, rects, places, *words, text=points_text):
    rows = {(int(r['i']), int(r['j'])): r['status'] for r in table(product, ['delaunay', *words], text(rects))}
    return {(p, rows.get(p, 'illegal')) for p in itertools.combinations(range(len(rects)), 2) if rows.get(p, 'illegal') in ('legal', 'illegal')}


def pairs_of_discs(product, rects, places):
    return pairs(product, rects, places, '--discs', text=discs_text)


def triangles(product, rects, places):
    return {tuple(r[k] for k in 'ijk') for r in table(product, ['delaunay', '--layer', 'triangles'], points_text(rects))}


def corners(product, rects, places):
    return {(r['i'], r['hull']) for r in table(product, ['delaunay', '--layer', 'points'], points_text(rects)) if r['hull'] != 'possible'}


def graph(name):
    def edges(product, rects, places):
        rows = {(int(r['i']), int(r['j'])): r['status'] for r in table(product, ['delaunay', '--layer', 'graph:' + name], points_text(rects))}
        return {(p, rows.get(p, 'no')) for p in itertools.permutations(range(len(rects)), 2) if rows.get(p) != 'possible' and (
            name == 'nearest' or p[0] < p[1])}
    return edges


def exterior(product, rects, places):
    """Places that are certainly on no edge."""
    rings = [[tuple(map(Q, z.split())) for z in r['corners'].split(';')]
             for r in table(product, ['delaunay', '--layer', 'exterior'], points_text(rects))]
    return {z for z in places if region.in_exterior(z, rings)}


def discs(product, rects, places):
    """Con of the other points and of the places: known of none unless the three are oriented."""
    all_ = [*rects, *((x, x, y, y) for x, y in places)]
    return {(r['i'], r['con']) for r in table(product, ['disc', '--layer', 'con'], points_text(all_)) if r['con'] != 'unknown'}


def diagram(product, rects, places):
    """Int and Ext of each cell at places: the point that is certainly nearest, those that certainly are not."""
    product('places.txt', ''.join(f'{dyadic(x)} {dyadic(y)}\n' for x, y in places))
    rows = table(product, ['nearest', '--queries', product.path('places.txt')], points_text(rects))
    near = {(r['q'], int(r['i'])): r['status'] for r in rows}
    found = {(*k, 'nearest') for k, s in near.items() if s == 'certain'}
    return found | {(str(q), i, 'not') for q in range(len(places)) for i in range(len(rects)) if (str(q), i) not in near}


def bisector(product, rects, places):
    """The same of the first two points alone, by the sides of their curves: of two points the diagram is the bisector."""
    meet = table(product, ['bisector'], points_text(rects[:2]))
    return diagram(product, rects[:2], places) | ({'disjoint'} if meet else set())


MAPS = {'Delaunay': pairs, 'Delaunay of discs': pairs_of_discs, 'triangles': triangles, 'hull': corners, 'nearest neighbours': graph('nearest'),
        'Gabriel graph': graph('gabriel'), 'exterior': exterior, 'disc and Con': discs, 'Int and Ext': diagram, 'bisector': bisector}


def chain(rand):
    """Nested lists of rectangles; the last is the limit, some of whose sides are points."""
    limit = []
    for _ in range(rand.randrange(3, 7)):
        x, y = rand.randrange(-24, 25), rand.randrange(-24, 25)
        w, h = (rand.choice((0, 0, 0, 1, 3, 8)) for _ in range(2))
        limit.append((Q(x, 8), Q(x + w, 8), Q(y, 8), Q(y + h, 8)))
    grow = [[rand.choice((0, 1, 1, 2, 3)) for _ in range(4)] for _ in limit]
    for d in (*WIDER, 0):
        yield [(a - d * g[0], b + d * g[1], c - d * g[2], e + d * g[3]) for (a, b, c, e), g in zip(limit, grow)]


def chain_of_discs(steps):
    """The same with lower left corners that stay."""
    return [[(a[0], max(a[0] + b[1] - b[0], a[1]), a[2], a[3]) for a, b in zip(steps[-1], s)] for s in steps]


def meet_in_a_point(rects):
    """Are two of the discs one point in the end? Then they are one site."""
    ends = [(r[0], r[2]) for r in rects if r[0] == r[1]]
    return len(set(ends)) < len(ends)


def continuity(judge, product, seed, count, out):
    rand = random.Random(f'chains {seed}')
    for _ in range(count):
        steps = list(chain(rand))
        if len(set(steps[-1])) < len(steps[-1]):
            continue  # equal points are one site
        places = [(Q(rand.randrange(-60, 61), 16), Q(rand.randrange(-60, 61), 16)) for _ in range(6)]
        for name, image in MAPS.items():
            before = len(judge.refuted)
            own = chain_of_discs(steps) if image is pairs_of_discs else steps
            if image is pairs_of_discs and meet_in_a_point(own[-1]):
                continue
            try:
                images = [image(product, s, places) for s in own]
            except (Hangs, ValueError) as e:
                judge(False, '%s: %s', name, e)
                images = []
            for a, b in zip(images, images[1:]):
                judge(a <= b, '%s takes back %s', name, sorted(map(str, a - b))[:3])
            if images:
                judge(images[-2] == images[-1], '%s never states %s of the limit', name, sorted(map(str, images[-1] - images[-2]))[:3])
            if len(judge.refuted) > before:
                print(f'\n*** refuted: continuity of {name}', *(points_text(s) for s in steps), places, judge.refuted[before:][:2], sep='\n',
                      file=out, flush=True)
