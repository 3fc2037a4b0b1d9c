#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The truth harness: draws cases from the product of all axes and compares each statement with the oracle.

    truth.py COMMAND [--seed S] [--cases N] [--python DIR] [--capi PROGRAM] [--tiles PROGRAM] [--table] [--case K]

Each run covers all pairs of values of the axes once, then draws further cases at random until there are N. A case is
its seed and its number; what fails is shrunk to the fewest points and options, and printed as a command to type."""
import argparse
import collections
import itertools
import json
import math
import os
import random
import re
import shlex
import struct
import sys

import axes
import chains
import draws
import laws
import oracle
import stated
from axes import Q
from product import Hangs, Product, offers

AXES = {'geometry': tuple(axes.GEOMETRIES), 'kind': tuple(axes.KINDS), 'form': tuple(axes.FORMS),
        'shape': tuple(axes.SHAPES), 'stated': tuple(stated.STATED), 'extra': tuple(axes.EXTRAS),
        'format': ('csv', 'json', 'wkt', 'geojson', 'vtk', 'svg', 'obj')}
ORDER = tuple(AXES)
PYTHON_ROWS = ('graph nearest', 'graph gabriel', 'graph mst', 'vertices', 'edges', 'regions')  # what serve.py answers as rows


class Space:
    """Which values of the axes go together: by the tables, and by what the command itself offers."""

    def __init__(self, command, python, capi, tiles):
        self.offers = offers(command)
        self.without = {'python': not python, 'appended': not python, 'capi': not capi, 'tiles': not tiles}
        self.known = {}

    def fits(self, row):
        key = tuple(row.get(a) for a in ORDER)
        if key not in self.known:
            self.known[key] = self.check(row)
        return self.known[key]

    def check(self, row):
        """Returns whether a partial row can be part of a case."""
        g, kind, form, shape, what, extra, fmt = (row.get(a) for a in ORDER)
        s, e = stated.STATED.get(what), axes.EXTRAS.get(extra)
        options = self.offers['options'].get(s.command, []) if s else []
        if form and self.without.get(form):
            return False
        if kind and (g and g not in axes.KINDS[kind][1] or form and form not in axes.KINDS[kind][2]):
            return False
        if shape and g and axes.SHAPES[shape][g == 'sphere'] is None:
            return False
        if s:
            if g and (g not in s.geometries or any(o not in options for o in axes.GEOMETRIES[g])):
                return False
            if kind and not self.kind_fits(s, kind, options):
                return False
            if fmt and (fmt not in s.formats or fmt not in self.offers['formats'][s.command]):
                return False
            if s.layer and s.layer not in self.offers['layers'][s.command]:
                return False
            if form == 'program' and '--oracle' not in options:
                return False
            if s.python and form and form not in axes.PYTHON:
                return False
            if form in axes.LIBRARY and not self.library_fits(form, s, g, fmt, extra, what):
                return False
            if extra and any(w.split('=')[0] not in options for w in e.args if w.startswith('-') and w != '-o'):
                return False
        if form == 'appended' and g == 'sphere':
            return False
        if form in axes.LIBRARY and (fmt not in (None, 'csv') or extra not in (None, 'none')):
            return False
        return self.extra_fits(row, e)

    @staticmethod
    def kind_fits(s, kind, options):
        if s.command == 'tolerance':
            return kind in (s.kinds or stated.FIRM)
        if kind in ('sigma', 'sigmas'):
            return '--confidence' in options
        if kind == 'scaled column':
            return '--radius-scale' in options
        if kind in ('radius', 'both', 'real with radius', 'unit apart') or kind.startswith('radius '):
            return '--radius' in options
        return kind != 'measured' or '--measured' in options

    @staticmethod
    def library_fits(form, s, g, fmt, extra, what):
        if form == 'tiles':
            return what == 'pairs' and g in (None, 'plane')
        if form == 'capi':
            return what == 'pairs' and g in (None, 'plane')
        return what in ('pairs', 'triangles') or (s.python or what in PYTHON_ROWS) and g in (None, 'plane')

    def extra_fits(self, row, e):
        g, kind, form, shape, what, extra, fmt = (row.get(a) for a in ORDER)
        if e is None:
            return True
        if e.fits == 'table' and form and form not in axes.TABLES or extra == 'id' and form == 'bar' \
                or extra in ('id', 'cost') and form == 'headless':
            return False
        if e.fits == 'program' and form and form != 'program':
            return False
        if extra == 'window' and g == 'sphere' and what and stated.STATED[what].command == 'plan' or extra == 'next' and what == 'trials':
            return False
        if extra == 'crs' and (fmt and fmt not in ('geojson', 'json') or g == 'sphere'):
            return False
        if extra == 'plane' and g == 'sphere' or extra == 'window' and what and stated.STATED[what].command == 'voronoi':
            return False
        if extra in ('euclid metric', 'box metric') and (kind in ('column', 'scaled column') or what == 'barcode'):
            return False
        if extra == 'few pairs' and (fmt in ('obj', 'svg') or g == 'sphere'):
            return False
        if extra == 'merge' and kind in ('both', 'interval', 'plusminus', 'columns', 'column of units', 'sigmas'):
            return False
        if extra == 'merge by' and (kind and kind.startswith(('sigma', 'real', 'disguised')) or g == 'sphere' and kind in NOT_NESTED
                                    or form in ('bar', 'headless')):
            return False
        return not (extra in ('trace', 'trace synced') and what in ('check', 'converge', 'converge of voronoi', 'converge of delaunay', 'converge of disc', 'converge of bisector'))

    def complete(self, row, rand, wanted=None):
        """Fills the other axes, so that as many pairs as can be that are wanted are covered; None: nothing fits."""
        row, rest = dict(row), [a for a in ORDER if a not in row]
        rand.shuffle(rest)
        return self.fill(row, rest, rand, wanted, [200])

    def fill(self, row, rest, rand, wanted, budget):
        if not rest:
            return row
        axis, values = rest[0], list(AXES[rest[0]])
        rand.shuffle(values)
        if wanted is not None:
            values.sort(key=lambda v: -sum(((a, row[a]), (axis, v)) in wanted or ((axis, v), (a, row[a])) in wanted for a in row))
        elif axis == 'extra' and rand.random() < 0.5:
            values.insert(0, 'none')
        for v in values:
            budget[0] -= 1
            if budget[0] < 0:
                return None
            row[axis] = v
            if self.fits(row):
                got = self.fill(row, rest[1:], rand, wanted, budget)
                if got:
                    return got
            del row[axis]
        return None


def pairs_design(space, seed):
    """Rows that cover all pairs of values that go together; and the pairs that never do."""
    rand = random.Random(f'pairs {seed}')
    wanted, never, design = {}, [], []
    for a, b in itertools.combinations(ORDER, 2):
        for v, w in itertools.product(AXES[a], AXES[b]):
            if space.fits({a: v, b: w}):
                wanted[(a, v), (b, w)] = True
    while wanted:
        (a, v), (b, w) = first = next(iter(wanted))
        row = next((r for r in (space.complete({a: v, b: w}, rand, wanted if k == 0 else None) for k in range(4)) if r), None)
        if row is None:
            never.append(first)
            del wanted[first]
            continue
        design.append(row)
        for p in itertools.combinations([(a, row[a]) for a in ORDER], 2):
            wanted.pop(p, None)
    return design, never


def random_rows(space, seed):
    rand = random.Random(f'rows {seed}')
    while True:
        axis = rand.choice(ORDER)
        row = space.complete({axis: rand.choice(AXES[axis])}, rand)
        if row:
            yield row


def count_triples(space, rows):
    """How many triples of values the rows hold, and how many go together."""
    met = set()
    for row in rows:
        met.update(itertools.combinations([(a, row[a]) for a in ORDER], 3))
    fit = 0
    for triple in itertools.combinations(ORDER, 3):
        fit += sum(space.fits(dict(zip(triple, v))) for v in itertools.product(*(AXES[a] for a in triple)))
    return len(met), fit


# ---- one case ----

def build(row, seed):
    """The case of a row: places, regions and texts, from its seed alone."""
    rand = random.Random(f'case {seed}')
    what = stated.STATED[row['stated']]
    n = rand.choice((4, 5, 5, 6, 6, 7, 8, 9))
    places, unit = axes.SHAPES[row['shape']][row['geometry'] == 'sphere'](rand, n)
    while len(places) < what.least:
        places.append((Q(len(places) * 7 + 1), Q(len(places) * 5 + 2)))
    case = axes.Case(row, seed, [axes.Site(p) for p in places], unit)
    case.places_drawn = places
    axes.KINDS[row['kind']][0](case, rand)
    extra = axes.EXTRAS[row['extra']]
    if row['extra'] == 'merge':
        merge(case)
    if row['extra'] == 'merge by':
        merge_by(case, rand, what)
    case.softened, case.weights, case.up_to = extra.softens, row['kind'] in ('column', 'scaled column'), None
    case.box_metric = row['extra'] == 'box metric'
    case.tail, case.spots = [], []
    case.pieces = pieces(rand, len(case.sites))
    xs, ys = ([s.place[k] for s in case.sites] for k in (0, 1))
    if row['geometry'] != 'sphere':
        case.window = round_out(min(xs) - unit / 2, max(xs) + unit / 2) + round_out(min(ys) - unit / 2, max(ys) + unit / 2)
        a, b = rand.choice(case.sites).place, rand.choice(case.sites).place
        case.at = tuple(Q((c + d) / 2) + unit * Q(rand.randint(-4, 4), 8) for c, d in zip(a, b))
        case.area = area_of(case.window, random.Random(f'area {seed}'))
        if row['kind'].startswith('real'):
            case.at = tuple(round_out(c, c)[0] for c in case.at)
        case.queries = [case.at, *(s.place for s in case.sites[:2] if not row['kind'].startswith('real'))]
        case.spots = spots(case, rand, unit)
    elif case.sites:
        a, b = rand.choice(case.sites).place, rand.choice(case.sites).place
        at = tuple(Q((c + d) / 2) + unit * Q(rand.randint(-4, 4), 8) for c, d in zip(a, b))
        case.queries = [tuple(round_out(c, c)[0] if row['kind'].startswith('real') else c for c in axes.lonlat(*p))
                        for p in (at, (at[0] + 180, -at[1]), (at[0], Q(90)), a)]
        case.at = case.queries[rand.choice((0, 0, 1, 2, 3))]
    if what.command == 'tolerance':
        up = unit * Q(rand.randint(1, 8), 8) if row['extra'] == 'births' else None
        case.up_to = up
        case.exact = True
        for s in case.sites:
            s.weight = (s.region[2] - s.region[1]) / 2 if case.weights else Q(1)
            s.region = ('disc', *s.place, Q(0))
    return case


def area_of(window, rand):
    """A polygon with a hole and an island in it, about the window: convex parts with signs, ends in sixteenths of its sides."""
    def part(half, cut):
        ring = ((half, 0), (0, half), (-half, 0), (0, -half)) if cut else ((-half, -half), (half, -half), (half, half), (-half, half))
        return [(window[0] + (window[1] - window[0]) * (8 + u) / 16, window[2] + (window[3] - window[2]) * (8 + v + shift) / 16)
                for u, v in ring]
    shift, far = Q(rand.randint(-3, 3)), rand.choice((7, 8, 9, 12))
    small, middle = sorted(rand.sample(range(1, (far + 1) // 2), 2))
    parts = [(1, part(Q(far), rand.random() < 0.5)), (-1, part(Q(middle), rand.random() < 0.5)), (1, part(Q(small), True))]
    return parts[:rand.choice((1, 2, 3))]


def area_text(area):
    rings = ['(' + ', '.join(f'{float(x)!r} {float(y)!r}' for x, y in part + part[:1]) + ')' for _, part in area]
    return 'MULTIPOLYGON ((' + ', '.join(rings[:2]) + ')' + ''.join(f', ({r})' for r in rings[2:]) + ')'


def pieces(rand, n):
    """How many points come first, and after one another."""
    counts = []
    while sum(counts) < n:
        counts.append(rand.randint(1, n - sum(counts)))
    return counts


def spots(case, rand, unit):
    """Places of doubles: of points, between them, anywhere."""
    def near(q):
        return float(q) if abs(q) < Q(2) ** 1000 else 0.0
    at = [s.place for s in case.sites]
    middles = [tuple((a + b) / 2 for a, b in zip(rand.choice(at), rand.choice(at))) for _ in range(6)]
    around = [tuple(c + unit * Q(rand.randint(-8, 8), 8) for c in rand.choice(at)) for _ in range(4)]
    return [tuple(map(near, p)) for p in (*at[:4], *middles, *around)]


def merge(case):
    """Equal places are one point, with the smallest of their regions."""
    def size(s):
        return s.region[3] if s.region[0] in ('disc', 'cap') else s.region[2] - s.region[1]
    for s in case.sites:
        s.region = min((t for t in case.sites if t.place == s.place), key=size).region
    case.merged = {k: [t.place for t in case.sites].index(s.place) for k, s in enumerate(case.sites)}


NOT_NESTED = 'interval', 'plusminus', 'columns', 'columns of degrees', 'column of units'


def merge_by(case, rand, what):
    """Names of rows: those of equal places, or whose boxes meet, may be one point, in the boxes' intersection; of discs in the
    smallest."""
    groups = []
    for s in case.sites:
        for g in groups:
            boxes = [s.region, *(t.region for t in g)]
            meet = boxes[0] if any(b[0] != 'box' for b in boxes) else ('box', *(f(b[k] for b in boxes) for k, f in ((1, max), (2, min), (3, max), (4, min))))
            if (g[0].place == s.place if what.command == 'tolerance' or meet[0] != 'box' else meet[1] <= meet[2] and meet[3] <= meet[4]) and rand.random() < 0.7:
                g.append(s)
                break
        else:
            groups.append([s])
    for k, g in enumerate(groups):
        boxes = [s.region for s in g]
        if boxes[0][0] == 'box' and what.command != 'tolerance':
            region = ('box', *(f(b[k] for b in boxes) for k, f in ((1, max), (2, min), (3, max), (4, min))))
        else:
            region = min(boxes, key=lambda r: r[3] if r[0] in ('disc', 'cap') else r[2] - r[1])
        for s in g:
            s.name, s.region = f'q{k}', region


def round_out(a, b):
    """Dyadics a little beyond both."""
    size = max(abs(a), abs(b), b - a, Q(1, 2 ** 1050))
    e = size.numerator.bit_length() - size.denominator.bit_length() - 40
    step = Q(2) ** e
    return [math.floor(a / step) * step, (math.floor(b / step) + 1) * step]


def command_of(case, product, keep=None):
    """The words of the command, its files written."""
    what, extra = stated.STATED[case.stated], axes.EXTRAS[case.extra]
    words = [what.command, *axes.GEOMETRIES[case.geometry], *axes.FORMS[case.form](case, product), *case.args,
             *(product('area.wkt', area_text(case.area)) if w == '@area' else w for w in what.words())]
    if '--comments' in case.space.offers['options'][what.command]:
        words.append('--comments')
    if case.format != 'csv':
        words += ['--format', case.format]
    if what.command == 'voronoi' and case.geometry != 'sphere':
        words.append('--window=' + ','.join(axes.decimal(c) for c in case.window))
    if what.command == 'nearest':
        places = [(axes.decimal(x), axes.decimal(y)) for x, y in case.queries]
        if case.stated == 'nearest':
            words += [axes.decimal(c) for c in case.at]
        elif case.stated == 'queries':
            words += ['--queries', product('places.txt', ''.join(f'{x} {y}\n' for x, y in places))]
        else:
            words += ['--query-columns', 'east,north', '--query-id', 'who', '--queries', product(
                'places.csv', 'north;who;east\n' + ''.join(f'{y};place {k};{x}\n' for k, (x, y) in enumerate(places)))]
    for w in extra.args:
        words.append({'@unit': axes.decimal(case.up_to or case.unit),
                      '@small': axes.decimal(case.unit / 100 if case.geometry != 'sphere' else case.unit * 1000) + 'm' * (case.geometry == 'sphere'),
                      '@certificate': product.path('certificate'), '@trace': product.path('trace'),
                      '@output': product.path('out.' + case.format)}.get(w, w))
    return words


def ask(case, product):
    """What the product states of the case: exit status, claims, messages."""
    if case.form in (*axes.PYTHON, 'capi'):
        q = {'points': [s.text for s in case.sites], 'radius': case.radius, 'geometry': case.geometry,
             'stated': case.stated, 'boxes': [[str(c) for c in s.region[1:]] for s in case.sites],
             'callback': case.kind == 'callback', 'window': [str(c) for c in getattr(case, 'window', ())],
             'spots': case.spots, 'pieces': case.pieces if case.form == 'appended' else [len(case.sites)]}
        if case.form == 'capi':
            q = laws.capi_question(case)
        a = product.serve('capi' if case.form == 'capi' else 'python', q if isinstance(q, str) else json.dumps(q))
        if 'error' in a:
            return 1, None, a['error']
        if 'csv' in a:
            claims = stated.STATED[case.stated].read(case, a['csv'], '', 'csv')
            return laws.STATUS_OF[a['outcome']], {**claims, 'aliases': {a: b for a, b in a['aliases']}}, a['outcome']
        return laws.STATUS_OF[a['outcome']], {
            'pairs': {(i, j): s for i, j, s in a['pairs']}, 'aliases': {a: b for a, b in a['aliases']},
            **({'triangles': [tuple(t) for t in a['triangles']]} if 'triangles' in a else {})}, a['outcome']
    if case.form == 'tiles':
        return laws.ask_tiles(case, product)
    product.text = None
    words = command_of(case, product)
    status, out, err = product.run(words)
    if case.extra == 'output' and status not in (1, 2):
        with open(product.path('out.' + case.format), encoding='utf-8') as file:
            out = file.read()
    if status in (1, 2) or status < 0 or not out.strip() and 'no diagram is written' in err:
        return status, None, err
    what = stated.STATED[case.stated]
    return status, what.read(case, out, err, case.format), err


REFUSALS = {  # part of a message: why the command refuses
    'leave no place of the sphere free': 'regions cover the sphere',
    'delaunay --discs does not write': 'not offered', 'is about the plane': 'not offered',
    'on a sphere --window is the part that a picture shows': 'not offered',
    'so that nothing is known of any': 'regions cover the sphere',
    'take more points or digits than can be held': 'polygons beyond what is held',
    'below 2^400': 'weights beyond what is held', 'raise --max-pairs': 'a cap that was asked for',
    'check reads the points once for each schedule': 'not offered', '--merge is for points files': 'not offered',
    'doubles': 'pictures and windows are of doubles',
    'give a larger one': 'a window too small beside the points for a picture'}


def regions_of(case):
    return [s.region for s in case.sites]


def draw(case, claims, rand, effort):
    """The choices that a case is judged by."""
    n, globe = len(case.sites), case.geometry == 'sphere'
    aliases = claims.get('aliases')
    sites = [k for k in range(n) if k not in (aliases or {})]
    if aliases is None or case.extra in ('merge', 'merge by'):
        sites = first_of_equal(case)
    make = stated.Globe if globe else stated.Choice
    if case.true:
        yield make([s.place for s in case.sites], sites)
        if claims.get('rects') and set(claims['rects']) >= set(sites):
            boxes = [('box', *claims['rects'].get(k, claims['rects'][sites[0]])) for k in range(n)]
            for p in draws.choices(boxes, rand, 4) if not globe else ():
                yield make(p, sites)
        return
    regions = regions_of(case)
    for p in draws.choices(regions, rand, effort):
        yield make(p, sites)
    if 'pairs' in claims and len(sites) > 2 and any(len(draws.extremes(r, rand)) > 1 for r in regions):
        pairs = list(itertools.combinations(sites, 2))
        for i, j in rand.sample(pairs, min(len(pairs), max(2, effort // 3))):
            status = claims['pairs'].get((i, j), 'illegal')
            if status in ('legal', 'illegal'):
                yield make(draws.climb(regions, sites, i, j, status == 'illegal', rand, globe), sites)


def first_of_equal(case):
    """Sites by the places themselves, where the format does not tell aliases."""
    seen, out = {}, []
    if case.extra == 'merge':
        return sorted(set(case.merged.values()))
    if case.form == 'program' or case.kind == 'callback':  # equality of two of them is not known
        return list(range(len(case.sites)))
    for k, s in enumerate(case.sites):
        r = s.region
        if r[0] == 'degrees' and r[1] == r[2] and r[3] == r[4]:
            r = ('degrees', Q(0), Q(0), r[3], r[4]) if abs(r[3]) == 90 else ('degrees', r[1] % 360, r[1] % 360, r[3], r[4])
        still = r[0] == 'box' and r[1] == r[2] and r[3] == r[4] or r[0] == 'degrees' and r[1] == r[2] and r[3] == r[4] or \
            r[0] in ('disc', 'cap') and r[3] == 0
        if still and r in seen or s.name and s.name in (t.name for t in case.sites[:k]):
            continue
        if still:
            seen[r] = k
        out.append(k)
    return out


def judge_case(case, product, effort, seed=0):
    """Runs a case and compares all that it states. The judge, and why it was refused if so."""
    judge, rand = stated.Judge(), random.Random(f'draw {case.seed} {seed}')
    try:
        status, claims, err = ask(case, product)
    except Hangs as e:
        judge(False, str(e))
        return judge, None
    except (ValueError, KeyError, IndexError, TypeError, AttributeError, StopIteration) as e:
        judge(False, 'the output cannot be read: %s: %s' % (type(e).__name__, e))
        return judge, None
    if claims is None and status in (1, 2, 4):
        why = next((r for t, r in REFUSALS.items() if t in err), None)
        if 'points are needed, here are' in err and len(first_of_equal(case)) < stated.STATED[case.stated].least:
            why = 'fewer points than rows'
        judge(why is not None or status == 2, 'exit %d: %s', status, err.strip()[-300:])
        return judge, why or err.strip().splitlines()[-1][:150]
    judge(status in (0, 3, 4), 'exit %d: %s', status, err.strip()[-300:])
    if claims is None:
        return judge, None
    what, last = stated.STATED[case.stated], None
    for ch in draw(case, claims, rand, effort):
        before, last = len(judge.refuted), ch
        if what.judge:
            what.judge(judge, case, claims, ch)
        if len(judge.refuted) > before:
            judge.choice = [tuple(str(c) if c.denominator < 10 ** 9 else stated.shown(c) for c in p) for p in
                            (ch.points if isinstance(ch, stated.Choice) else ch.places)]
            return judge, None
    laws.judge_all(judge, case, product, status, claims, err, last, rand, effort)
    return judge, None


# ---- shrinking ----

def without(case, k):
    """The same case without site k."""
    c = axes.Case(case.row, case.seed, [s for m, s in enumerate(case.sites) if m != k], case.unit)
    for name, value in case.__dict__.items():
        if name not in ('row', 'seed', 'sites', 'unit'):
            c.__dict__[name] = value
    if isinstance(case.radius, list):
        c.radius = [r for m, r in enumerate(case.radius) if m != k]
    if case.true:
        c.true = [t for m, t in enumerate(case.true) if m != k]
    return c


def like(case, **changes):
    c = without(case, -1)
    c.row = {**case.row, **changes}
    extra = axes.EXTRAS[c.row['extra']]
    c.softened = extra.softens
    if c.row['extra'] != case.row['extra']:
        c.up_to = None
    return c


def shrink(case, space, product, effort):
    """The fewest points and options that still fail in the same way."""
    def fails(c):
        for seed in range(3):
            j, _ = judge_case(c, product, effort * 3, seed)
            if j.refuted:
                return j
        return None
    best = fails(case)
    if best is None:
        return case, None
    for change in ({'extra': 'none'}, {'format': 'csv'}, {'form': 'text'}):
        if all(case.row[a] == v for a, v in change.items()) or not space.fits({**case.row, **change}):
            continue
        c = like(case, **change)
        j = fails(c)
        if j:
            case, best = c, j
    k = 0
    while k < len(case.sites) and len(case.sites) > stated.STATED[case.stated].least:
        c = without(case, k)
        j = fails(c)
        if j:
            case, best = c, j
        else:
            k += 1
    return case, best


def described(case, product):
    """A command to type, with its file."""
    if case.form in axes.LIBRARY:
        return f'{case.form}: points {[s.text for s in case.sites]} radius {case.radius}'
    product.text = None
    words = command_of(case, product)
    shown = ' '.join(shlex.quote(os.path.basename(w) if w.startswith(product.folder) else w) for w in words)
    files = ''
    for w in words:
        if w.startswith(product.folder) and os.path.exists(w) and w.rpartition('/')[2].startswith(('points', 'answers')):
            with open(w, 'rb') as file:
                text = file.read()
            text = axes.lines(case) if w.endswith('.gz') else text.decode()
            files += f'cat > {os.path.basename(w)} <<END\n{text}END\n'
    if product.text:
        files += f'cat > points.txt <<END\n{product.text.decode()}END\n'
        shown += ' < points.txt'
    return files + 'dyadel ' + shown


class Run:
    """Cases, counts and findings of a run."""

    def __init__(self, space, product, seed, effort, out, against=None):
        self.against = against
        self.space, self.product, self.seed, self.effort, self.out = space, product, seed, effort, out
        self.cases, self.judged, self.refused = 0, 0, collections.Counter()
        self.table = collections.Counter()
        self.findings = []

    def case(self, row, number):
        case = build(row, f'{self.seed}:{number}')
        case.space = self.space
        return case

    def one(self, row, number):
        case = self.case(row, number)
        judge, refused = judge_case(case, self.product, self.effort)
        self.cases += 1
        if judge.refuted and self.against:  # refutations of this one, too, are not counted
            judge.refuted = [] if judge_case(case, self.against, self.effort)[0].refuted else judge.refuted
        self.judged += judge.judged
        for axis in ORDER:
            self.table[axis, row[axis], 'cases'] += 1
            self.table[axis, row[axis], 'judged'] += judge.judged
            self.table[axis, row[axis], 'refuted'] += bool(judge.refuted)
        if refused:
            self.refused[row['stated'], refused] += 1
        if judge.refuted:
            self.report(case, judge, number)

    def report(self, case, judge, number):
        key = case.stated, case.geometry, re.sub(r'\d[\d.e+-]*', '#', judge.refuted[0])[:60]
        self.findings.append(key)
        if self.against:
            print(f'noticed by case {number}, the {self.cases}th: {judge.refuted[0]} ({case.row})', file=self.out)
        if self.findings.count(key) > 2 or self.against:
            return
        try:
            small, j = shrink(case, self.space, self.product, self.effort)
        except Exception as e:  # the case as it is says more than the end of a soak
            small, j = case, None
            print(f'not shrunk: {e!r}', file=self.out)
        j = j or judge
        print(f'\n*** refuted: case {number} of seed {self.seed} ({", ".join(f"{a} {v}" for a, v in case.row.items())})',
              described(small, self.product), '; '.join(j.refuted[:3]),
              f'choice: {getattr(j, "choice", None)}', sep='\n', file=self.out, flush=True)

    def print_table(self):
        print('| axis | value | cases | statements judged | cases refuted |\n|---|---|---|---|---|', file=self.out)
        for axis in ORDER:
            for v in AXES[axis]:
                n = [self.table[axis, v, c] for c in ('cases', 'judged', 'refuted')]
                if n[0]:
                    print(f'| {axis} | {v} | {n[0]:,} | {n[1]:,} | {n[2]} |', file=self.out)


def main():
    sys.set_int_max_str_digits(0)  # corners of exteriors have thousands
    p = argparse.ArgumentParser()
    p.add_argument('command')
    p.add_argument('--seed', type=int, default=1)
    p.add_argument('--cases', type=int, default=0, help='0: the pairs alone')
    p.add_argument('--only', type=int, help='one case of this run')
    p.add_argument('--effort', type=int, default=9, help='choices of each case')
    p.add_argument('--shard', default='0/1', help='K/N: every Nth case, from the Kth on')
    p.add_argument('--where', action='append', default=[], help='AXIS=VALUE: only these rows')
    p.add_argument('--stop', type=int, default=10 ** 9, help='end after so many findings')
    p.add_argument('--against', help='only what is not refuted of this command as well counts')
    p.add_argument('--python')
    p.add_argument('--capi')
    p.add_argument('--tiles')
    p.add_argument('--limit', type=float, default=90)
    p.add_argument('--table', action='store_true')
    p.add_argument('--triples', action='store_true', help='only count the triples of values that the cases cover')
    a = p.parse_args()
    python = a.python and os.path.isdir(a.python) and a.python
    space = Space(a.command, python, a.capi, a.tiles)
    design, never = pairs_design(space, a.seed)
    rows = itertools.chain(design, random_rows(space, a.seed)) if a.cases else design
    if a.triples:
        print('triples of values: %d of %d that go together' % count_triples(space, itertools.islice(rows, a.cases or None)))
        return 0
    product = Product(a.command, python, a.capi, a.tiles, a.limit)
    against = Product(a.against, python, a.capi, a.tiles, a.limit) if a.against else None
    run = Run(space, product, a.seed, a.effort, sys.stdout, against)
    want = dict(w.split('=') for w in a.where)
    k, n = map(int, a.shard.split('/'))
    try:
        for number, row in enumerate(rows):
            if a.cases and number >= a.cases or len(run.findings) >= a.stop:
                break
            if number % n != k or any(row[x] != v for x, v in want.items()) or a.only not in (None, number):
                continue
            run.one(row, number)
        laws_judge = stated.Judge()
        if a.only is None and not want:
            laws.complete(laws_judge, product, a.seed, max(6, a.cases // 200) // n, run.out)
            chains.continuity(laws_judge, product, f'{a.seed} {a.shard}', max(6, a.cases // 200) // n, run.out)
            run.judged += laws_judge.judged
    finally:
        product.close()
    if a.table:
        run.print_table()
        for (what, why), count in sorted(run.refused.items()):
            print(f'refused {count}: {what}: {why}')
    if against:
        against.close()
    bad = len(run.findings) + len(laws_judge.refuted)
    print(f'seed {a.seed}: {run.cases:,} cases ({len(design)} rows for all pairs, {len(never)} pairs that never meet), '
          f'{product.runs:,} runs, {run.judged:,} statements judged, {bad} refuted')
    return bad > 0


if __name__ == '__main__':
    sys.exit(main())
