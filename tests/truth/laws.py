# SPDX-License-Identifier: LGPL-3.0-or-later
"""Laws: relations between statements, and between two runs.

judge_all looks at one case: its exit status, what exact points decide, what a witness of the oracle proves, and one
change that must change nothing. complete draws sets that differ from every degenerate position by a known amount."""
import itertools
import json
import math
import os
import random
import struct

import mpmath

import axes
import draws
import oracle
import stated
from axes import Q
from product import Hangs

STATUS_OF = {'decided': 0, 'certified': 0, 'fixpoint': 3, 'budget': 4, 'cancelled': 5}
CLEAR = 2 ** -2000


# ---- other ways in ----

def capi_question(case):
    """One line for capi.c: boxes, or the places of a callback, as fractions."""
    if case.kind == 'callback':
        return ' '.join(['source', str(len(case.sites)), *(str(c) for s in case.sites for c in s.place)])
    return ' '.join(['boxes', str(len(case.sites)), *(f'[{s.region[1 + k]},{s.region[2 + k]}]' for s in case.sites for k in (0, 2))])


def ask_tiles(case, product):
    """The same points in pieces: doubles, or boxes of doubles about them."""
    flat = [c for s in case.sites for c in s.region[1:]]
    boxes = [down(c) if k % 2 == 0 else -down(-c) for k, c in enumerate(flat)]
    if any(math.isinf(b) for b in boxes):
        return 2, None, 'exponent beyond doubles'
    if boxes != flat:
        case.exact = False
        for k, s in enumerate(case.sites):
            s.region = ('box', *map(Q, boxes[4 * k:4 * k + 4]))
    path = product('points.bin', struct.pack(f'<{len(boxes)}d', *boxes))
    out = product.path('parts')
    os.system('rm -rf ' + out)
    status, _, err = product.run(['delaunay', path, '--boxes', '-o', out, '--tiles', '3'], product.tiles)
    if status not in (0, 3, 4):
        return status, None, err
    _, text, err = product.run(['to-csv', '--comments', out], product.tiles)
    return status, stated.read_pairs(case, text, err, 'csv'), err


def down(c):
    """The largest double that is not above c."""
    try:
        f = float(c)
    except OverflowError:
        return math.inf if c > 0 else -math.inf
    return math.nextafter(f, -math.inf) if not math.isinf(f) and Q(f) > c else f


# ---- one case ----

def judge_all(judge, case, product, status, claims, err, last, rand, effort):
    pairs = claims.get('pairs')
    if pairs is not None:
        judge_exit(judge, case, status, claims)
        judge_decided(judge, case, claims, last)
        judge_witness(judge, case, claims, last, rand)
    if case.stated.startswith('graph') and 'edges' in claims and case.form != 'capi' and case.extra != 'accept fixpoint':
        left = sorted(e for e, word in claims['edges'].items() if word == 'possible')
        judge(status != 0 or not left, 'exit 0, but %s are only possible', left[:3])
    if claims.get('aliases') is not None:
        judge_aliases(judge, case, claims)
    extra = {'rho': judge_rho, 'plan': judge_plan, 'layer plan': judge_plan, 'tolerance': judge_motion, 'layer tolerance': judge_motion}.get(case.stated)
    if extra:
        extra(judge, case, claims, last, rand, effort)
    if judge.refuted:
        return
    try:
        {'certificate': judge_certificate, 'trace': judge_resume}.get(case.extra, lambda *a: None)(
            judge, case, product, claims)
        if pairs is not None and case.form not in (*axes.LIBRARY, 'program') and not case.softened and \
                'listed only' not in claims:
            judge_same(judge, case, product, claims, rand)
    except Hangs as e:
        judge(False, 'another run: %s', e)


def ends_with_budget(case):
    """A region may lie along the great circle of exact places: no proof is known that its pairs stay open [SET-4]."""
    return case.geometry == 'sphere' and case.row['shape'] == 'line'


def judge_exit(judge, case, status, claims):
    """0: nothing is open; 3: something is, and cannot be refined; 4: a budget was spent, which fixed points have not."""
    left = sorted(s for s in claims['pairs'].values() if s != 'legal')
    if case.extra in ('accept fixpoint', 'area', 'hausdorff') or case.extra == 'few pairs' or 'listed only' in claims:
        return
    if case.geometry == 'discs' and case.form in axes.LIBRARY:  # the outcome is that of the squares
        return
    judge(status == 0 or left or case.softened or case.geometry == 'sphere', 'exit %d, but nothing is open', status)
    judge(status != 0 or not left, 'exit 0, but %d pairs are open', len(left))
    if ends_with_budget(case):
        return
    judge(status != 4 or case.softened or case.true or case.kind == 'boxes asked for', 'exit 4, but nothing can be refined')


def clear(case, last, i, j):
    """The status of a pair of reals, where moving them by 2^-2000 changes nothing; 0 where it might."""
    e = oracle.edge(last.p, i, j, range(len(last.p)))
    if not case.true or e == 0:
        return e
    rand = random.Random(7)
    for _ in range(2):  # there and back: what is a tie becomes one thing on the one side, the other on the other
        step = [[CLEAR_STEP * rand.randint(-9, 9) for _ in q] for q in last.points]
        for way in 1, -1:
            p = [tuple(c + way * d for c, d in zip(q, by)) for q, by in zip(last.points, step)]
            if oracle.edge(oracle.whole(p)[0], i, j, range(len(p))) != e:
                return 0
    return e


CLEAR_STEP = Q(1, 2 ** 2000)


def judge_decided(judge, case, claims, last):
    """Exact points, and reals, are decided, but for ties of reals that are not proved."""
    if not (case.exact or case.true) or case.softened or 'listed only' in claims or not hasattr(last, 'edge'):
        return
    if case.true and case.geometry == 'sphere':
        return
    left = [p for p, s in claims['pairs'].items() if s == 'indeterminate']
    if case.true and left and any(clear(case, last, i, j) == 0 or last.p[i] == last.p[j]
                                  for i, j in itertools.combinations(range(len(case.sites)), 2)):
        return  # a tie that need not be provable, and all that hangs on it
    for i, j in left:
        if i in last.sites and j in last.sites:
            judge(case.geometry == 'sphere' and last.edge(i, j) == 0, '%d,%d is not decided', i, j)


def judge_witness(judge, case, claims, last, rand):
    """Where the oracle finds a disc that shows an edge, the pair is legal."""
    if case.geometry == 'sphere' or case.softened or case.true or case.exact or 'listed only' in claims:
        return
    regions = {k: case.sites[k].region for k in last.sites}
    if case.kind == 'real with radius':  # discs of computed points are by 2^-50 of coordinates wider [DISC-4]
        spare = max(abs(c) for r in regions.values() for c in r[1:]) / 2 ** 48
        regions = {k: (*r[:3], r[3] + spare) if r[0] == 'disc' else r for k, r in regions.items()}
    found = [p for p, s in claims['pairs'].items() if s == 'indeterminate']
    for i, j in rand.sample(found, min(3, len(found))):
        if i in regions and j in regions:
            c = draws.witness(regions, i, j, last.sites)
            judge(c is None, '%d,%d is not stated legal, but the disc about %s shows it', i, j, c and tuple(map(str, c)))


def judge_aliases(judge, case, claims):
    """An alias is one exact place; equal exact places are aliases."""
    if case.extra in ('merge', 'merge by') or case.true or case.kind in ('real with radius', 'boxes asked for'):
        return
    seen = {}
    for k, s in enumerate(case.sites):
        r = s.region
        still = r[3] == 0 if r[0] in ('disc', 'cap') else r[1] == r[2] and r[3] == r[4]
        if case.geometry == 'sphere' and r[0] not in ('disc', 'cap'):
            still = still or r[3] == r[4] and abs(r[3]) == 90  # a pole, whatever its longitude
        if not still:
            judge(k not in claims['aliases'], 'point %d has a region, but is an alias', k)
            continue
        x, y = (r[1], r[2]) if r[0] in ('disc', 'cap') else (r[1], r[3])
        if case.geometry == 'sphere':
            x = Q(0) if abs(y) == 90 else x % 360
        first = seen.setdefault((x, y), k)
        if case.softened and case.kind == 'disguised':
            continue
        judge(claims['aliases'].get(k, k) == first, 'point %d is the same as %d, not as %d', k, first, claims['aliases'].get(k, k))


def judge_rho(judge, case, claims, last, rand, effort):
    """Within their radii, all at once, points change nothing."""
    place = [s.place for s in case.sites]
    nominal = stated.Choice(place, last.sites)
    if any(r is None for r in claims['rho'].values()):
        return
    regions = [('disc', *place[k], claims['rho'].get(k, Q(0))) for k in range(len(place))]
    pairs = [p for p in itertools.combinations(last.sites, 2) if nominal.edge(*p) != 0]
    moved = list(draws.choices(regions, rand, effort))
    for i, j in rand.sample(pairs, min(4, len(pairs))):
        moved.append(draws.climb(regions, last.sites, i, j, nominal.edge(i, j) < 0, rand, False))
    for p in moved:
        ch = stated.Choice(p, last.sites)
        for i, j in pairs:
            judge(ch.edge(i, j) == nominal.edge(i, j), 'within rho of all points, %d,%d changes', i, j)


def judge_motion(judge, case, claims, last, rand, effort):
    """Below its death an edge is one for each motion; before its birth a pair is none. With ties off, equal places are two
    sites, of which this oracle knows one."""
    place = [s.place for s in case.sites]
    events = [(p, e) for p, e in claims['events'].items() if e[0] != 'tie' and e[1] and set(p) <= set(last.sites)]
    for (i, j), (event, lo, _) in rand.sample(events, min(len(events), 3)):
        t = lo * (1 - Q(1, 2 ** 45))
        regions = [('box', p[0] - t, p[0] + t, p[1] - t, p[1] + t) if case.box_metric else ('disc', *p, t * s.weight)
                   for p, s in zip(place, case.sites)]
        moved = [draws.climb(regions, last.sites, i, j, event == 'birth', rand, False) for _ in range(2)]
        for p in [*moved, *itertools.islice(draws.choices(regions, rand, 4), 1, None)]:
            e = stated.Choice(p, last.sites).edge(i, j)
            judge(e == (1 if event == 'death' else -1), 'a motion below %s makes %d,%d end (%s)', stated.shown(t), i, j, event)


def measured_regions(case, half):
    """The regions, those of the points in half within so much of their middles."""
    globe, regions = case.geometry == 'sphere', []
    for k, s in enumerate(case.sites):
        h = half.get(k)
        if case.geometry == 'discs':
            regions.append(s.region if h is None else (*s.region[:3], min(s.region[3], h * (1 - Q(1, 2 ** 40)))))
            continue
        if globe and (h is not None or s.region[0] == 'cap'):
            at = s.region[1:3] if s.region[0] == 'cap' else ((s.region[1] + s.region[2]) / 2, (s.region[3] + s.region[4]) / 2)
            regions.append(s.region if h is None else ('cap', *at, h / axes.EARTH * (1 - Q(1, 2 ** 40))))
            continue
        n, xlo, xhi, ylo, yhi = s.region
        x, y = (xlo + xhi) / 2, (ylo + yhi) / 2
        h = None if h is None else h * (1 - Q(1, 2 ** 40))
        regions.append(s.region if h is None else (n, max(xlo, x - h), min(xhi, x + h), max(ylo, y - h), min(yhi, y + h)))
    return regions


def judge_plan(judge, case, claims, last, rand, effort):
    """Within the accuracies of a plan all choices have the same edges; within those of its first rows, the pairs that these decide."""
    if case.true or case.extra in ('next', 'site', 'window') or 'stay undecided' in claims['err'] or 'leave' in claims['err'] or claims['left']:
        return
    if case.extra == 'accuracy' or case.kind == 'real with radius':
        return
    globe = case.geometry == 'sphere'
    make = stated.Globe if globe else stated.Choice
    if globe and any(s.region[0] == 'degrees' and not -90 < s.region[3] <= s.region[4] < 90 for s in case.sites):
        return  # the middle of a region about a pole
    regions = measured_regions(case, claims['plan'])
    middle = make([r[1:3] if r[0] in ('disc', 'cap') else ((r[1] + r[2]) / 2, (r[3] + r[4]) / 2) for r in regions], last.sites)
    if len({(middle.places if globe else middle.points)[k] for k in last.sites}) < len(last.sites):
        return
    pairs = [p for p in itertools.combinations(last.sites, 2) if middle.edge(*p) != 0]
    if len(pairs) < len(last.sites) * (len(last.sites) - 1) // 2:
        return
    tries = [(claims['plan'], pairs)]
    if claims.get('ranks') and claims['plan']:
        first = rand.randint(1, len(claims['plan']))
        tries.append((dict(list(claims['plan'].items())[:first]), [p for p, rank in claims['ranks'].items() if rank and rank <= first]))
    for half, pairs in tries:
        regions = measured_regions(case, half)
        moved = list(draws.choices(regions, rand, effort))
        for i, j in rand.sample(pairs, min(4, len(pairs))):
            moved.append(draws.climb(regions, last.sites, i, j, middle.edge(i, j) < 0, rand, globe))
        for p in moved:
            ch = make(p, last.sites)
            for i, j in pairs:
                judge(ch.edge(i, j) in (middle.edge(i, j), 0 if globe else None), 'within what the plan asks for, %d,%d changes', i, j)


def judge_certificate(judge, case, product, claims):
    status, out, err = product.run(['verify', product.path('certificate')])
    judge(status in (0, 3), 'verify of its own certificate: exit %d: %s', status, (out + err).strip()[-200:])
    first = out.splitlines()[0] if out else ''
    judge(status != 3 or 'accepted, all' not in first, 'verify says "%s" with exit 3', first)


def judge_resume(judge, case, product, claims):
    """From its trace, a run states the same."""
    import truth
    product.text = None
    words = truth.command_of(case, product)
    words[words.index('--trace')] = '--resume'
    status, out, err = product.run(words)
    what = stated.STATED[case.stated]
    judge(status in (0, 3, 4), 'resumed: exit %d: %s', status, err.strip()[-200:])
    if status in (0, 3, 4):
        again = what.read(case, out, err, case.format)
        same = {k: again[k] == claims[k] for k in ('pairs', 'corners', 'edges', 'near', 'con') if k in claims and claims[k] is not None}
        judge(all(same.values()), 'resumed, something else is stated')


# ---- changes that change nothing ----

def flip(r, x, y):
    """A region after (x, y) -> (x(x, y), y(x, y)), each an increasing or decreasing function of one coordinate."""
    if r[0] == 'disc':
        return ('disc', x(r[1], r[2]), y(r[1], r[2]), r[3])
    a = [(x(p, q), y(p, q)) for p in r[1:3] for q in r[3:5]]
    return (r[0], min(p for p, _ in a), max(p for p, _ in a), min(q for _, q in a), max(q for _, q in a))


def mirror(r, rand):
    return flip(r, lambda x, y: -x, lambda x, y: y)


def quarter(r, rand):
    return flip(r, lambda x, y: -y, lambda x, y: x)


def shift(r, rand):
    return flip(r, lambda x, y: x + 1024, lambda x, y: y - 4096)


def scale(r, rand):
    r = flip(r, lambda x, y: x * 2 ** 30, lambda x, y: y * 2 ** 30)
    return (*r[:3], r[3] * 2 ** 30) if r[0] == 'disc' else r


def whole(r, rand):
    """Decimals become integers: an end that is shared, or a circle that is met exactly, shows no rounding."""
    r = flip(r, lambda x, y: x * 10 ** 12, lambda x, y: y * 10 ** 12)
    return (*r[:3], r[3] * 10 ** 12) if r[0] == 'disc' else r


def itself(r, rand):
    return r


def about_axis(r, rand):
    return ('cap', r[1] + 37, *r[2:]) if r[0] == 'cap' else (r[0], r[1] + 37, r[2] + 37, *r[3:])


def full_turn(r, rand):
    k = 360 * rand.randint(-1, 1)
    return ('cap', r[1] + k, *r[2:]) if r[0] == 'cap' else (r[0], r[1] + k, r[2] + k, *r[3:])


def south(r, rand):
    return ('cap', r[1], -r[2], r[3]) if r[0] == 'cap' else (*r[:3], -r[4], -r[3])


def west(r, rand):
    return ('cap', -r[1], *r[2:]) if r[0] == 'cap' else (r[0], -r[2], -r[1], *r[3:])


def wider(r, rand):
    if r[0] in ('disc', 'cap'):
        return (*r[:3], r[3] * 2)
    w, h = (r[2] - r[1]) / 2, (r[4] - r[3]) / 2
    return r[0], r[1] - w, r[2] + w, r[3] - h, r[4] + h


SAME = {'plane': {'order': itself, 'mirror': mirror, 'quarter turn': quarter, 'shift': shift, 'scale': scale, 'whole': whole,
                  'as intervals': itself, 'wider': wider},
        'sphere': {'order': itself, 'about the axis': about_axis, 'a full turn': full_turn, 'north for south': south,
                   'mirror': west, 'as intervals': itself, 'wider': wider}}
SAME['discs'] = {k: v for k, v in SAME['plane'].items() if k != 'as intervals'}


def write_regions(regions, geometry, product):
    """The words that state these regions: intervals, or a column of radii."""
    if geometry == 'discs' or any(r[0] == 'cap' for r in regions):
        lines = ['x,y,r']
        for r in regions:
            if r[0] in ('disc', 'cap'):
                at = r[1:3]
                radius = axes.decimal(r[3]) if r[0] == 'disc' else axes.decimal(r[3] * axes.EARTH / (1 - Q(1, 2 ** 60))) + 'm'
            else:
                at, radius = ((r[1] + r[2]) / 2, (r[3] + r[4]) / 2), axes.decimal((r[2] - r[1]) / 2) + ('deg' if r[0] == 'degrees' else '')
                if r[2] - r[1] != r[4] - r[3]:
                    return None
            lines.append(','.join((*map(axes.decimal, at), radius)))
        return ['--columns', 'x,y', '--radius-column', 'r', product('changed.csv', '\n'.join(lines) + '\n')]
    return [product('changed.txt', ''.join(' '.join(
        axes.decimal(a) if a == b else f'[{axes.decimal(a)},{axes.decimal(b)}]' for a, b in (r[1:3], r[3:5])) + '\n' for r in regions))]


def judge_same(judge, case, product, claims, rand):
    """Applies one change: the statements of the changed points are the same; wider regions decide no more."""
    if case.true or case.kind in ('disguised', 'real with radius') or case.extra in ('merge', 'merge by', 'missing', 'missing word') or not case.sites:
        return
    name, change = rand.choice(list(SAME[case.geometry].items()))
    regions = [change(s.region, rand) for s in case.sites]
    if case.geometry == 'sphere' and any(r[0] == 'degrees' and (r[3] < -90 or r[4] > 90) for r in regions):
        return
    order = list(range(len(regions)))
    if name == 'order':
        rand.shuffle(order)
    product.text = None
    words = write_regions([regions[k] for k in order], case.geometry, product)
    if words is None:
        return
    status, out, err = product.run(['delaunay', *axes.GEOMETRIES[case.geometry], *words, *product_comments(case)])
    if status not in (0, 3) and not (status == 4 and ends_with_budget(case)):
        if name == 'wider' and ('free' in err or 'nothing is known of any' in err) or 'exponent' in err or 'earth' in err:
            return
        judge(False, 'after the change "%s": exit %d: %s', name, status, err.strip()[-200:])
        return
    other = stated.read_pairs(case, out, err, 'csv')
    back = {}
    for (i, j), s in other['pairs'].items():
        back[tuple(sorted((order[i], order[j])))] = s
    rep, one = sites_of(claims, len(order)), {}
    for p in itertools.combinations(rep, 2):
        one[p] = claims['pairs'].get(p, 'illegal'), back.get(p, 'illegal')
    if name == 'order':
        if other['aliases']:
            return  # another one of equal points may be the first
    dyadic = all(c.denominator & (c.denominator - 1) == 0 for s in case.sites for c in s.region[1:])
    exact = case.exact or case.geometry == 'plane' and (dyadic or case.form in axes.TEXTS and 'sigma' not in case.kind)
    for p, (a, b) in one.items():
        if name == 'wider':
            judge(b in ('indeterminate', 'tie') or a == b or len(other['aliases'] or ()) != len(claims['aliases'] or ()),
                  'pair %s is %s, but %s with regions twice as wide', p, a, b)
        elif exact:
            judge(a == b, 'pair %s is %s, after the change "%s" %s', p, a, name, b)
        else:
            judge({a, b} != {'legal', 'illegal'}, 'pair %s is %s, after the change "%s" %s', p, a, name, b)


def product_comments(case):
    return ['--comments'] if '--comments' in case.space.offers['options']['delaunay'] else []


def sites_of(claims, n):
    return [k for k in range(n) if k not in (claims.get('aliases') or {})]


# ---- completeness ----

def near_circle(rand, s):
    """Near the unit circle on a short arc, off by multiples of 2^-s."""
    n, step = rand.randint(4, 6), rand.choice((10, 100, 1000))
    return [tuple(f'{f}({k}/{step})*(1+{rand.randint(1, 99)}*2^-{s})' for f in ('cos', 'sin')) for k in range(n)]


def whole_circle(rand, s):
    n = rand.randint(4, 7)
    return [tuple(f'{f}({k})*(1+{rand.randint(1, 99)}*2^-{s})' for f in ('cos', 'sin')) for k in range(n)]


def near_line(rand, s):
    return [(f'sqrt({k + 2})', f'sqrt({k + 2})*3+{rand.randint(1, 99)}*2^-{s}') for k in range(rand.randint(3, 6))]


def near_lattice(rand, s):
    return [(f'{a}*sqrt(2)+{rand.randint(1, 99)}*2^-{s}', f'{b}*sqrt(2)+{rand.randint(1, 99)}*2^-{s}')
            for a, b in rand.sample([(a, b) for a in range(3) for b in range(3)], rand.randint(4, 7))]


def far_centre(rand, s):
    return [(f'{k}*sqrt(3)', f'{rand.randint(1, 99)}*2^-{s}*sqrt({k + 2})') for k in range(rand.randint(4, 6))]


NEAR = {'short arc': near_circle, 'circle': whole_circle, 'line': near_line, 'lattice': near_lattice, 'far centre': far_centre}


def value(text):
    """An expression of the sets above, to 1500 bits, as a fraction."""
    with mpmath.workprec(1500):
        names = {'sqrt': mpmath.sqrt, 'cos': mpmath.cos, 'sin': mpmath.sin, 'mpf': mpmath.mpf}
        import re
        v = mpmath.mpf(eval(re.sub(r'(\d+)', r'mpf(\1)', text.replace('^', '**')), names))
        return (-1 if v < 0 else 1) * abs(Q(int(v.man))) * Q(2) ** int(v.exp)


def needed(points):
    """Bits at which boxes about the points show all signs: from lower bounds of orientations and in-circle values, and
    how fast they change at most."""
    bits, size = 0, max(abs(c - d) for p, q in itertools.combinations(points, 2) for c, d in zip(p, q))
    for t in itertools.combinations(points, 3):
        d = abs(oracle.turn(*t))
        bits = max(bits, math.log2(float(4 * size)) - logarithm(d)) if d else math.inf
        for q in points:
            if q not in t and d:
                v = abs(oracle.in_circle(*t, q))
                bits = max(bits, math.log2(float(24 * size ** 3)) - logarithm(v)) if v else math.inf
    return bits


def logarithm(q):
    e = q.numerator.bit_length() - q.denominator.bit_length()
    return e + math.log2(float(q / Q(2) ** e))


def complete(judge, product, seed, count, out):
    """Sets that differ from a degenerate position by a known amount are decided, with few bits more than are needed."""
    rand = random.Random(f'complete {seed}')
    for number in range(count):
        name, s = rand.choice(list(NEAR)), rand.choice((20, 40, 60, 100, 150))
        texts = NEAR[name](rand, s)
        points = [tuple(map(value, t)) for t in texts]
        need = needed(points)
        if need > 800 or len(set(points)) < len(points):
            continue
        product.text = None
        path = product('near.txt', ''.join(f'{x} {y}\n' for x, y in texts))
        before = len(judge.refuted)
        try:
            status, text, err = product.run(['delaunay', path, '--format', 'json'])
        except Hangs as e:
            judge(False, str(e))
            status = None
        if status is not None:
            judge(status == 0, 'exit %d: %s', status, err.strip()[-150:])
        if status in (0, 3, 4):
            claims = json.loads(text)
            got = {(p['i'], p['j']): p['status'] for p in claims['pairs']}
            p = oracle.whole(points)[0]
            for (i, j), e in oracle.edges(p, range(len(p))).items():
                judge(got.get((i, j), 'illegal') == ('legal' if e == 1 else 'illegal'), '%d,%d is %s, but is %s', i, j,
                      got.get((i, j), 'illegal'), 'an edge' if e == 1 else 'none')
            judge(claims['counters']['bits_most'] <= need + s + 64, '%d bits asked for, where %d show all and the sets differ by '
                  '2^-%d', claims['counters']['bits_most'], math.ceil(need), s)
        if len(judge.refuted) > before:
            print(f'\n*** refuted: completeness, near {name}, 2^-{s}\ncat > points.txt <<END', *(f'{x} {y}' for x, y in texts),
                  'END\ndyadel delaunay points.txt', '; '.join(judge.refuted[before:][:3]), sep='\n', file=out, flush=True)
