# SPDX-License-Identifier: LGPL-3.0-or-later
"""Readers and judges of statements: each row of STATED reads the output of a command and compares it with one choice."""
import csv
import dataclasses
import fractions
import io
import itertools
import json
import re

import mpmath

import oracle
import region

Q = fractions.Fraction
CERTAIN, POSSIBLE = ('surely', 'sure', 'certain'), ('possibly', 'possible')


class Choice:
    """One choice of points in the plane."""

    def __init__(self, points, sites):
        self.points, self.sites = points, sites
        self.p, self.scale = oracle.whole(points)
        self.kept = {}

    def edge(self, i, j):
        if (i, j) not in self.kept:
            self.kept[i, j] = oracle.edge(self.p, i, j, self.sites)
        return self.kept[i, j]

    def triangle(self, i, j, k):
        return oracle.triangle(self.p, i, j, k, self.sites)

    def nearer(self, at, k, m):
        """Below 0: k is nearer to the place than m; above 0: farther."""
        d = oracle.far2(self.points[k], at) - oracle.far2(self.points[m], at)
        return (d > 0) - (d < 0)

    def is_within(self, at, k, lo, hi):
        d = oracle.far2(self.points[k], at)
        return (lo is None or lo * lo <= d) and (hi is None or d <= hi * hi)


class Globe(oracle.Sphere):
    def edge(self, i, j):
        if (i, j) not in self.__dict__.setdefault('kept', {}):
            self.kept[i, j] = oracle.Sphere.edge(self, i, j)
        return self.kept[i, j]


class Judge:
    """Counts statements, and keeps the refuted ones."""

    def __init__(self):
        self.judged, self.refuted = 0, []

    def __call__(self, holds, text, *args):
        self.judged += 1
        if not holds:
            self.refuted.append(text % args if args else text)


def shown(q):
    """A fraction to read, whatever its size."""
    return mpmath.nstr(mpmath.mpf(q.numerator) / q.denominator, 17)


# ---- readers ----

def number(text):
    """m*2^e, m*2^e/d, p/q or a decimal as a fraction; None for nothing."""
    if text in (None, ''):
        return None
    if not isinstance(text, str):
        return text if isinstance(text, Q) else Q(text)
    m, star, e = text.partition('*2^')
    e, _, d = e.partition('/')
    return Q(m) * Q(2) ** int(e) / int(d or 1) if star else Q(text)


def parsed(text):
    return json.loads(text, parse_float=Q)


def rows(text, form):
    """The rows of a layer, by the names of the columns; 'at' holds the numbers of the geometry, if any. Also returns
    the comments."""
    if form == 'geojson':
        d = parsed(text)
        return [{**f['properties'], 'at': list(flat(f['geometry'] and f['geometry'].get('coordinates', [])))}
                for f in d['features']], {}
    notes = [l[2:] for l in text.splitlines() if l.startswith('# ')]
    out = list(csv.DictReader(io.StringIO('\n'.join(l for l in text.splitlines() if not l.startswith('#')))))
    if form == 'wkt':
        for r in out:
            r['at'] = [Q(t) for t in re.findall(r'-?\d[\d.]*(?:e[-+]?\d+)?', r.get('WKT') or '')]
    return out, notes


def flat(c):
    if isinstance(c, list):
        for x in c:
            yield from flat(x)
    elif c is not None:
        yield Q(c)


def aliases_of(notes, err):
    found = {}
    for l in [*notes, *err.splitlines()]:
        m = re.match(r'#? ?alias (\d+) (\d+)', l)
        if m:
            found[int(m[1])] = int(m[2])
    return found


def svg_pairs(text):
    return {(int(a), int(b)): s for a, b, s in re.findall(r'<title>(\d+), (\d+): (\w+)', text)}


def vtk(text):
    """The lists of points, lines and polygons, and the arrays of a legacy file."""
    out, words = {}, text.split('\n')
    k, block = 0, None
    while k < len(words):
        w = words[k].split()
        k += 1
        if not w:
            continue
        if w[0] in ('LINES', 'POLYGONS', 'POINTS', 'VERTICES'):
            n = int(w[1])
            out[w[0]] = [words[k + m].split() for m in range(n)]
            k += n
        elif w[0] in ('CELL_DATA', 'POINT_DATA'):
            block, n = w[0], int(w[1])
        elif w[0] == 'SCALARS':
            out[block, w[1]] = words[k + 1:k + 1 + n]
            k += 1 + n
        elif w[0] == 'row':  # where rows have other numbers than points
            out['row'] = words[k:k + int(w[2])]
            k += int(w[2])
    return out


# ---- pairs ----

def read_pairs(case, out, err, form):
    """Statuses by pair, aliases; of json also what else it says of the triangulation."""
    c = {'pairs': {}, 'aliases': {}}
    if form == 'json':
        d = parsed(out)
        c['pairs'] = {(p['i'], p['j']): p['status'] for p in d['pairs']}
        c['aliases'] = {a['i']: a['of'] for a in d['aliases']} if d['aliases'] and isinstance(d['aliases'][0], dict) else \
            {a: b for a, b in d['aliases']}
        c['triangles'] = [tuple(t) for t in d['triangles']]
        c['rects'] = {s['i']: [number(t) for t in (*s['x'], *s['y'])] for s in d['sites']}
        c['outcome'] = d['outcome']
        c['count'] = d['count']
        c['bits'] = d['counters']['bits_most']
        if 'hull' in d and not d['hull'].get('capped'):
            h = d['hull']
            c['corners'] = {k: 'no' for k in range(len(case.sites))}
            for name, word in (('possible', 'possible'), ('sure', 'certain'), ('certain', 'certain')):
                c['corners'].update({k: word for k in h.get(name + '_vertices', [])})
            c['hull edges'] = {(e['i'], e['j']): e['status'] for e in h['edges']}
    elif form == 'svg':
        c['pairs'] = svg_pairs(out)
        c['aliases'], c['listed only'] = None, True  # lines that would be one mass are drawn by their density
    elif form == 'vtk':
        d = vtk(out)
        names = {'1': 'tie', '2': 'indeterminate', '3': 'legal'}
        status = d.get(('CELL_DATA', 'status'), [])
        row_of = (lambda v: int(d['row'][int(v)])) if 'row' in d else int
        c['pairs'] = {tuple(sorted(map(row_of, l[1:3]))): names[s.strip()] for l, s in zip(d.get('LINES', []), status)}
        c['triangles'] = [tuple(map(row_of, l[1:])) for l in d.get('POLYGONS', [])]
        c['aliases'] = None
    elif form == 'obj':
        c['listed only'] = True
        row, rows_of = None, []  # "# row N" before a vertex whose row has another number than the vertex
        for w in (l.split() for l in out.splitlines()):
            if w[:2] == ['#', 'row']:
                row = int(w[2].rstrip(','))
            elif w and w[0] == 'v':
                rows_of.append(len(rows_of) if row is None else row)
                row = None
        item = {k: [tuple(rows_of[int(v) - 1] for v in l.split()[1:]) for l in out.splitlines() if l.startswith(k + ' ')]
                for k in 'lf'}
        c['pairs'] = {tuple(sorted(p)): 'legal' for p in item['l']}
        c['triangles'] = item['f']
        c['aliases'] = None
    else:
        r, notes = rows(out, form)
        for q in r:
            if q['j'] in (None, '') or q.get('status') == 'alias':
                c['aliases'][int(q['i'])] = int(q['of'])
                continue
            pair = int(q['i']), int(q['j'])
            c['pairs'][pair] = q['status']
            if 'at' in q and case.geometry == 'plane' and len(q['at']) == 4:
                c.setdefault('ends', {})[pair] = (q['at'], number(q.get('max_coordinate_error')))
        if form == 'csv':
            c['aliases'].update(aliases_of(notes, ''))
        elif not c['aliases']:
            c['aliases'] = None
    if case.extra == 'few pairs':
        c['listed only'] = True
    return c


def judge_pairs(judge, case, c, ch):
    globe = case.geometry == 'sphere'
    for i, j in itertools.combinations(ch.sites, 2):
        status = c['pairs'].get((i, j), 'illegal')
        if c.get('listed only') and status == 'illegal' or status == 'indeterminate':
            continue
        e = ch.edge(i, j)
        if status == 'legal':
            judge(e == 1 or globe and e == 0, '%d,%d is stated legal, but is not in this choice', i, j)
        elif status == 'illegal':
            judge(e == -1 or globe and e == 0, '%d,%d is stated illegal, but is an edge of this choice', i, j)
        elif not case.true:
            judge(e == 0, '%d,%d is stated a tie, but is none', i, j)
    for t in c.get('triangles', ()):
        e = ch.triangle(*t)
        judge(e == 1 or globe and e == 0, 'triangle %s is not there', t)
    judge_places(judge, case, c.get('rects', {}), ch)
    if globe:
        return
    for i, (x0, x1, y0, y1) in c.get('rects', {}).items():
        x, y = ch.points[i]
        if case.geometry != 'discs':
            judge(x0 <= x <= x1 and y0 <= y <= y1, 'point %d is not in its rectangle', i)
    for (i, j), (at, error) in c.get('ends', {}).items():
        if error is not None:
            off = max(abs(a - b) for a, b in zip(at, (*ch.points[i], *ch.points[j])))
            judge(off <= error, 'an end of %d,%d is %s off, more than %s', i, j, shown(off), shown(error))
    judge_hull(judge, case, c, ch)


def judge_hull(judge, case, c, ch):
    for i, word in c.get('corners', {}).items():
        if i in ch.sites and word not in POSSIBLE:
            e = oracle.corner(ch.p, i, ch.sites)
            judge(e == (1 if word in CERTAIN else -1), 'point %d is stated %s a corner of the hull', i, word)
    if 'hull edges' not in c:
        return
    for i, j in itertools.combinations(ch.sites, 2):
        status = c['hull edges'].get((i, j), 'illegal')
        e = oracle.hull_edge(ch.p, i, j, ch.sites)
        if status == 'legal':
            judge(e == 1, 'side %d,%d of the hull is stated legal', i, j)
        elif status == 'illegal':
            judge(e == -1 or e == 0 and not case.exact and ch.p[i] == ch.p[j], 'side %d,%d of the hull is not listed', i, j)


def read_points(case, out, err, form):
    r, notes = rows(out, form)
    return {'corners': {int(q['i']): q['hull'] for q in r}, 'aliases': aliases_of(notes, '') if form == 'csv' else None,
            'boxes': {int(q['i']): [number(q[k]) for k in ('xlo', 'xhi', 'ylo', 'yhi')] for q in r}}


def judge_places(judge, case, boxes, ch):
    """The region written for a place on the sphere contains all its possible positions."""
    for i, box in boxes.items() if case.geometry == 'sphere' else ():
        judge(None not in box and ch.is_in(i, *box), 'place %d is not in its box of degrees', i)


def judge_points(judge, case, c, ch):
    judge_places(judge, case, c.get('boxes', {}), ch)
    if case.geometry == 'sphere':
        return
    judge_hull(judge, case, c, ch)
    for i, (x0, x1, y0, y1) in c['boxes'].items():
        x, y = ch.points[i]
        holds = all(a is None or a <= b for a, b in ((x0, x), (x, x1), (y0, y), (y, y1)) if a is not None and b is not None)
        judge(holds, 'point %d is not in its box', i)


def read_unlisted(case, out, err, form):
    """Pairs, where ties are not listed among them."""
    return {**read_pairs(case, out, err, form), 'listed only': True}


def read_groups(case, out, err, form):
    r, _ = rows(out, form)
    return {'groups': [(q['kind'], [int(k) for k in q['sites'].split()]) for q in r]}


def judge_groups(judge, case, c, ch):
    """Sites of a group are ties, but for neighbours, which may be edges; a chain is on a line with nothing beyond."""
    for kind, sites in c['groups']:
        judge(kind in ('circle', 'chain') and len(set(sites)) == len(sites) > 2, '%s of %s is no group', kind, sites)
        for a, b in itertools.combinations(range(len(sites)), 2):
            near = b - a == 1 or kind == 'circle' and b - a == len(sites) - 1
            e = ch.edge(sites[a], sites[b])
            judge(case.true or e == 0 or near and e == 1, '%d,%d of a %s are no tie', sites[a], sites[b], kind)
        turns = [oracle.turn(*(ch.p[k] for k in sites[:2]), ch.p[m]) for m in (sites[2:] if kind == 'circle' else ch.sites)]
        judge(case.true or all(t > 0 if kind == 'circle' else t <= 0 for t in turns), 'the %s %s is not in order', kind, sites)


def read_aliases(case, out, err, form):
    r, _ = rows(out, form)
    return {'aliases': {int(q['i']): int(q['of']) for q in r}}


def read_triangles(case, out, err, form):
    r, notes = rows(out, form)
    return {'triangles': [tuple(int(q[k]) for k in 'ijk') for q in r],
            'aliases': aliases_of(notes, '') if form == 'csv' else None}


def judge_triangles(judge, case, c, ch):
    for t in c['triangles']:
        e = ch.triangle(*t)
        judge(e == 1 or case.geometry == 'sphere' and e == 0, 'triangle %s is not there', t)
    if case.exact and not case.softened and case.geometry == 'plane':
        for t in itertools.combinations(ch.sites, 3):
            for i, j, k in (t, (t[0], t[2], t[1])):
                if ch.triangle(i, j, k) == 1:
                    judge((i, j, k) in c['triangles'], 'triangle %s is missing', (i, j, k))


# ---- interpolation ----

def read_range(case, out, err, form):
    return {'spots': [(tuple(Q(q[k]) for k in 'xy'), number(q['lo']), number(q['hi'])) for q in csv.DictReader(io.StringIO(out))]}


def height(k):
    """The value of a point."""
    return (7 * k * k + 3 * k) % 11


def judge_range(judge, case, c, ch):
    """Bounds of a place hold the value of some triangulation of the choice, and its hull the place."""
    near = Q(1, 2 ** 900) if case.true else 0  # how far the points of `true` may be from the true ones
    pairs = list(itertools.combinations(ch.sites, 2))
    for z, lo, hi in c['spots']:
        if lo is None:
            judge(case.kind != 'exact' or not any(ch.triangle(*t) == 1 and min(turns_at(ch, t, z)) > 0 for t in itertools.permutations(ch.sites, 3)),
                  'of %s nothing is stated, and it is in a triangle of exact points', z)
            continue
        out = [(i, j) for i, j in pairs for a, b in ((i, j), (j, i)) if oracle.turn(ch.points[a], ch.points[b], z) < -near and
               all(oracle.turn(ch.points[a], ch.points[b], ch.points[k]) >= near for k in ch.sites if k not in (i, j))]
        judge(not out, '%s is outside of the hull, beyond %s', z, out[:1])
        found = {}
        for t in itertools.combinations(ch.sites, 3):
            for way in (t, (t[0], t[2], t[1])):
                e = ch.triangle(*way)
                u = turns_at(ch, way, z) if e >= 0 else [-1]
                if min(u) >= 0:
                    found[way] = e, sum(Q(a) * height(k) for a, k in zip(u, way)) / sum(u)
        fit = [lo - near <= v <= hi + near for e, v in found.values()]
        judge(not found or any(fit) and (all(fit) or any(e == 0 for e, v in found.values())), 'at %s the value is in %s, not in [%s, %s]', z, found, lo, hi)


def turns_at(ch, t, z):
    """The place against the sides of a triangle, opposite to each corner."""
    a, b, c = (ch.points[k] for k in t)
    return oracle.turn(b, c, z), oracle.turn(c, a, z), oracle.turn(a, b, z)


# ---- hulls and the exterior ----

def ring_of(text):
    return [tuple(map(Q, z.split())) for z in text.split(';')]


def read_hulls(case, out, err, form):
    return (out.strip() or None) and {'hulls': {tuple(int(q[k]) for k in 'ijk' if q[k] not in (None, '')): ring_of(q['corners']) for q in rows(out, form)[0]}}


def read_exterior(case, out, err, form):
    return (out.strip() or None) and {'exterior': [ring_of(q['corners']) for q in rows(out, form)[0]]}


def read_graph(case, out, err, form):
    if form in ('svg', 'html') or not out.strip():  # a graph that is not known is not written: exit status 4
        return None
    r, notes = rows(out, form)
    return {'edges': {(int(q['i']), int(q['j'])): q['status'] for q in r},
            'aliases': aliases_of(notes, '') if form == 'csv' else None}


def judge_graph(name):
    test = oracle.GRAPHS[name]

    def judge_it(judge, case, c, ch):
        for i, j in itertools.permutations(ch.sites, 2):
            if i > j and name != 'nearest':
                continue
            word = c['edges'].get((i, j))
            if word in POSSIBLE and not case.exact:
                continue
            e = test(ch.p, i, j, ch.sites)
            if word is None:
                judge(e == -1, '%d,%d is not listed, but may be an edge of graph:' + name, i, j)
            elif word in CERTAIN:
                judge(e == 1, '%d,%d is stated certain in graph:' + name, i, j)
            elif not case.softened:
                judge(e == 0, '%d,%d of exact points is only possible in graph:' + name, i, j)
    return judge_it


# ---- the diagram ----

def window_of(c):
    return c['window']


def read_cells(case, out, err, form):
    if form == 'json':
        return read_diagram(case, out)
    r, notes = rows(out, form)
    c = {'aliases': aliases_of(notes, '') if form == 'csv' else None, 'window': case.window, 'cells': {}}
    for q in r:
        if q.get('area_lo') is not None or 'area_lo' in q:
            c['cells'][int(q['i'])] = [number(q[k]) for k in ('area_lo', 'area_hi', 'xlo', 'xhi', 'ylo', 'yhi')]
    for note in notes:
        name, _, value = note.partition(',')
        if name in ('undetermined_area', 'distance_to_true_diagram'):
            c[name] = number(value)
    return c


def read_diagram(case, out):
    d = parsed(out)
    c = {'aliases': None, 'cells': {}, 'inner': {}, 'outer': {}, 'rounded': {}, 'vertices': [], 'regions': []}
    c['window'] = [number(t) for t in (*d['window']['x'], *d['window']['y'])]
    for q in d['cells']:
        if 'area' in q:
            c['cells'][q['i']] = [None if t is None else Q(t) for t in (*q['area'], *(q['x'] or (None, None)), *(q['y'] or (None, None)))]
            c['inner'][q['i']] = [[tuple(number(t) for t in v) for v in q['inner']]]
            c['outer'][q['i']] = [[tuple(number(t) for t in v) for v in p] for p in q['outer']]
            c['rounded'][q['i']] = number(str(q.get('vertex_error', 0)))
    c['vertices'] = [(v['sites'], [number(t) for t in (*v['x_exact'], *v['y_exact'])]) for v in d['vertices'] if 'x_exact' in v]
    for name, b in d['bounds'].items():
        c[name] = number(b['exact'] if isinstance(b, dict) else b)
    return c


def judge_cells(judge, case, c, ch):
    window, polys = c['window'], {}
    for k in ch.sites:
        polys[k] = oracle.cell(ch.points, k, window, ch.sites)
    same = len({ch.points[k] for k in ch.sites}) < len(ch.sites)
    for k, q in c['cells'].items():
        if k not in ch.sites:
            continue
        a = oracle.area(polys[k])
        if not same:
            judge(q[0] is None or q[0] <= a, 'cell %d has area %s, below its bound', k, shown(a))
        judge(q[1] is None or a <= q[1], 'cell %d has area %s, above its bound', k, shown(a))
        for x, y in polys[k]:
            holds = all(a is None or b is None or a <= b for a, b in ((q[2], x), (x, q[3]), (q[4], y), (y, q[5])))
            judge(holds, 'cell %d is not in its box', k)
    for k, e in c.get('rounded', {}).items():
        if e:
            judge_rounded(judge, k, e, c['inner'][k], c['outer'][k], polys.get(k, []))
    exact = {k for k, e in c.get('rounded', {}).items() if e == 0}
    for k, ps in c.get('inner', {}).items():
        for at in itertools.chain(*ps) if k in exact else ():
            d = oracle.ranks(ch.points, at, ch.sites) if k in ch.sites else {}
            judge(all(d[k] < d[m] for m in d if m != k), 'a corner of the inner polygon of %d is nearer to another', k)
    for k, ps in c.get('outer', {}).items():
        for at in polys.get(k, ()) if k in exact else ():
            judge(any(holds_point(p, at) for p in ps), 'cell %d is not in its outer polygons', k)
    for t, box in c.get('vertices', ()):
        if len(t) == 3:
            judge_vertex(judge, case, t, box, ch)
    judge_between(judge, c, ch, polys)


def tile_rows(out, form):
    """As rows(); those of json as those of wkt are."""
    if form != 'json':
        return rows(out, form)
    d = parsed(out)
    return [{'i': q['i'], 'area': q['tile_area'], 'area_lo': q['area'][0], 'area_hi': q['area'][1], 'rings': q['rings'],
             'at': list(flat([ring + ring[:1] for ring in q['rings']])), 'max_coordinate_error': d['vertex_error']} for q in d['tiles']], {}


def read_tiles(case, out, err, form):
    """Tiles as cells without boxes; in formats with a geometry also the rings, in doubles as programs read them."""
    r, notes = tile_rows(out, form)
    c = {'aliases': aliases_of(notes, '') if form == 'csv' else None, 'window': case.window, 'cells': {}, 'rings': []}
    for q in r:
        c['cells'][int(q['i'])] = [number(q[k]) for k in ('area_lo', 'area_hi')] + [None] * 4
        if 'at' in q:
            at = [Q(float(t)) for t in q['at']]
            c['rings'].append((list(zip(at[::2], at[1::2])), number(q['area'])))
    return c


def judge_tiles(judge, case, c, ch):
    """The cell of every choice is within the bounds; the areas of the rings make up the window."""
    judge_cells(judge, case, c, ch)
    if not c['rings'] or 'summed' in c:
        return
    sums = [sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(ring, ring[1:])) for ring, _ in c['rings']]
    for s, (ring, area) in zip(sums, c['rings']):
        judge(0 < s and (area is None or s <= 2 * area) and ring[0] == ring[-1], 'a tile has area %s, not %s', shown(s / 2), area and shown(area))
    xlo, xhi, ylo, yhi = c['window']
    judge(sum(sums) == 2 * (xhi - xlo) * (yhi - ylo), 'the areas of tiles are not that of the window')
    c['summed'] = True


def read_cut(case, out, err, form):
    """Rows of tiles that are cut: bounds, areas, and with a geometry all rings of each, holes clockwise."""
    r, notes = tile_rows(out, form)
    c = {'aliases': aliases_of(notes, '') if form == 'csv' else None, 'cells': [], 'shapes': []}
    shapes = ([[ring + ring[:1] for ring in q['rings']] for q in r] if form == 'json' else
              [[[flat(z) for z in ring] for part in f['geometry']['coordinates'] for ring in part] for f in parsed(out)['features']]
              if form == 'geojson' else
              [[[map(Q, z.split()) for z in ring.split(',')] for ring in re.findall(r'\(([^()]+)\)', q.get('WKT', ''))] for q in r])
    for q, shape in zip(r, shapes):
        c['cells'].append([int(q['i']), *(number(q[k]) for k in ('area_lo', 'area_hi', 'area'))])
        if form != 'csv':
            c['shapes'].append(([[tuple(Q(float(t)) for t in z) for z in ring] for ring in shape], number(q['max_coordinate_error'])))
    return c


def judge_cut(judge, case, c, ch):
    """The cell of every choice has a part in the area within the bounds; the areas of the tiles make up the area."""
    same = len({ch.points[k] for k in ch.sites}) < len(ch.sites)
    for k, lo, hi, _ in c['cells']:
        if k in ch.sites:
            cell = oracle.cell(ch.points, k, case.window, ch.sites)
            a = sum(s * oracle.area(oracle.common(cell, part)) for s, part in case.area)
            judge(same or lo is None or lo <= a, 'the tile of %d has area %s in the polygon, below its bound', k, shown(a))
            judge(hi is None or a <= hi, 'the tile of %d has area %s in the polygon, above its bound', k, shown(a))
    if 'summed' in c:
        return
    c['summed'] = True
    xlo, xhi, ylo, yhi = case.window
    whole = oracle.cell([(xlo, ylo)], 0, case.window, [0])
    size = sum(s * oracle.area(oracle.common(whole, part)) for s, part in case.area)
    if any(q[3] is None for q in c['cells']):
        return  # beyond doubles
    found = sum(q[3] for q in c['cells'])
    judge(found <= size * (1 + Q(1, 2 ** 50)), 'the areas of tiles are %s, above that of the polygon', shown(found))
    lost = 0
    for (k, *_, area), (rings, e) in zip(c['cells'], c['shapes']):
        twice = sum(a[0] * b[1] - b[0] * a[1] for ring in rings for a, b in zip(ring, ring[1:]))
        off = sum(abs(a[n] - b[n]) + 4 * e for ring in rings for a, b in zip(ring, ring[1:]) for n in (0, 1)) * e
        judge(all(ring[0] == ring[-1] for ring in rings) and abs(twice / 2 - area) <= off + area / 2 ** 50,
              'the polygon of tile %d has area %s, not %s', k, shown(twice / 2), shown(area))
        lost = max(lost, 64 * e * (xhi - xlo + yhi - ylo) * (len(case.sites) + 1))
    judge(not c['shapes'] or found >= size - lost, 'the areas of tiles are %s, below that of the polygon', shown(found))


def judge_rounded(judge, k, e, inner, outer, poly):
    """The polygon of an exact cell: each corner is near one of the cell, and each of the cell near one of it."""
    judge([inner[0]] == outer or not inner[0], 'the inner and the outer polygon of the exact cell %d differ', k)
    corners = list(itertools.chain(*outer))
    if not corners:  # it is too narrow for its rounded vertices to hold an area
        sides = list(zip(poly, poly[1:] + poly[:1]))
        twice, around = abs(sum(a[0] * b[1] - b[0] * a[1] for a, b in sides)), sum(abs(a[k] - b[k]) for a, b in sides for k in (0, 1))
        judge(twice <= 4 * e * around, 'the exact cell %d has an area, but no polygon', k)
        return
    for a, b, what in ((corners, poly, 'a corner of the polygon'), (poly, corners, 'a corner')):
        for x, y in a:
            judge(any(abs(x - u) <= e and abs(y - v) <= e for u, v in b), '%s of cell %d is not where it is stated', what, k)


def judge_between(judge, c, ch, polys):
    """What differs between two choices is undetermined: its area, and how far it is from either diagram."""
    before, apart = c.get('before'), len({ch.points[k] for k in ch.sites}) == len(ch.sites)
    c['before'] = apart, {k: oracle.area(p) for k, p in polys.items()}, polys
    if before is None or c.get('undetermined_area') is None:
        return
    if apart and before[0]:  # cells of sites that meet overlap
        moved = sum(abs(oracle.area(p) - before[1].get(k, 0)) for k, p in polys.items())
        judge(moved <= 2 * c['undetermined_area'], 'more area changes hands than is stated to be undetermined')
    d = c.get('distance_to_true_diagram')
    if d is None:
        return
    xlo, xhi, ylo, yhi = c['window']
    for k, p in before[2].items():
        for v in p:
            if not (xlo < v[0] < xhi and ylo < v[1] < yhi):
                continue
            ranks = oracle.ranks(ch.points, v, ch.sites)
            m = min(ranks, key=ranks.get)
            near = [(ranks[q] - ranks[m]) ** 2 <= 4 * d * d * oracle.far2(ch.points[q], ch.points[m])
                    for q in ch.sites if q != m]
            judge(any(near), 'a vertex of one choice is farther than stated from the diagram of another one')


def holds_point(poly, at):
    """Returns whether a place is in a closed polygon. Exact."""
    x, y = at
    inside = False
    for (ax, ay), (bx, by) in zip(poly, poly[1:] + poly[:1]):
        t = (bx - ax) * (y - ay) - (by - ay) * (x - ax)
        if t == 0 and min(ax, bx) <= x <= max(ax, bx) and min(ay, by) <= y <= max(ay, by):
            return True
        if (ay > y) != (by > y) and (t > 0) == (by > ay):
            inside = not inside
    return inside


def judge_vertex(judge, case, t, box, ch):
    c = oracle.centre(*(ch.points[k] for k in t))
    judge(c is not None and all(a is None or b is None or a <= b for a, b in
                                ((box[0], c[0]), (c[0], box[1]), (box[2], c[1]), (c[1], box[3]))),
          'the vertex of %s is not in its box', t)
    judge(max(ch.triangle(*t), ch.triangle(t[0], t[2], t[1])) >= 0, '%s is no vertex', t)


def read_vertices(case, out, err, form):
    r, notes = rows(out, form)
    return {'aliases': aliases_of(notes, '') if form == 'csv' else None,
            'vertices': [([int(q[k]) for k in 'ijk'], [number(q[k]) for k in ('xlo', 'xhi', 'ylo', 'yhi')]) for q in r]}


def judge_vertices(judge, case, c, ch):
    for t, box in c['vertices']:
        if case.geometry == 'sphere':
            judge_globe_vertex(judge, t, box, ch)
        elif not (case.true and ch.triangle(*t) == -1):
            judge_vertex(judge, case, t, box, ch)


def judge_globe_vertex(judge, t, box, ch):
    e = ch.triangle(*t)
    judge(e >= 0, '%s is no vertex', t)
    v = ch.vertex(*t) if e == 1 else None
    if v is None or any(b is None for b in box):
        return
    slack = mpmath.mpf(10) ** -40
    with mpmath.workprec(400):
        x0, x1, y0, y1 = (mpmath.mpf(b.numerator) / b.denominator for b in box)
        lon, lat = v
        turn = mpmath.floor((x1 + slack - lon) / 360) * 360
        judge(y0 - slack <= lat <= y1 + slack, 'the latitude of vertex %s is not in its box', t)
        judge(x0 - slack <= lon + turn or abs(abs(lat) - 90) < slack, 'the longitude of vertex %s is not in its box', t)


def read_edges(case, out, err, form):
    r, notes = rows(out, form)
    return {'aliases': aliases_of(notes, '') if form == 'csv' else None,
            'edges': [(int(q['i']), int(q['j']), str(q['left']), str(q['right'])) for q in r]}


def judge_edges(judge, case, c, ch):
    for i, j, left, right in c['edges']:
        judge(ch.edge(i, j) == 1, '%d,%d has a side between its cells, but is no edge', i, j)
        for k, (a, b) in ((left, (i, j)), (right, (j, i))):
            if k.isdigit():
                judge(ch.triangle(a, b, int(k)) == 1, 'triangle %d,%d,%s is not there', a, b, k)
            elif k == 'ray' and ch.points[i] != ch.points[j]:
                beyond = [oracle.turn(ch.p[a], ch.p[b], ch.p[m]) for m in ch.sites if m not in (a, b)]
                judge(all(t <= 0 for t in beyond), '%d,%d has a ray, but is not on the hull', i, j)


def read_regions(case, out, err, form):
    r, notes = rows(out, form)
    return {'aliases': aliases_of(notes, '') if form == 'csv' else None,
            'regions': [([int(t) for t in str(q['sites']).split()], [number(q.get(k)) for k in ('xlo', 'xhi', 'ylo', 'yhi')])
                        for q in r]}


def judge_regions(judge, case, c, ch):
    """All sites of a region that has no sure triangle inside: a triangle of these sites has its vertex in the box."""
    for sites, box in c['regions']:
        for t in itertools.combinations([k for k in sites if k in ch.sites], 3):
            for i, j, k in (t, (t[0], t[2], t[1])):
                if case.geometry == 'plane' and len(sites) == 3 and ch.triangle(i, j, k) == 1 and None not in box:
                    x, y = oracle.centre(*(ch.points[m] for m in (i, j, k)))
                    xlo, xhi, ylo, yhi = case.window
                    if xlo < x < xhi and ylo < y < yhi:
                        judge(box[0] <= x <= box[1] and box[2] <= y <= box[3], 'vertex %s is not in its region', t)


def read_globe_cells(case, out, err, form):
    d = parsed(out)
    return {'aliases': {a: b for a, b in d['aliases']}, 'nodes': [(v['i'], v['j'], v['k']) for v in d['vertices']],
            'cells': {q['i']: (q['complete'], q['vertices']) for q in d['cells']}}


def judge_globe_cells(judge, case, c, ch):
    """Of each cell the vertices, for this choice: the sides between them bound it, and a complete one holds the spots to which
    its site is nearest, and no others."""
    for i, (complete, nodes) in c['cells'].items():
        if i not in ch.sites:
            continue
        at = [n if n is None else ch.direction(*c['nodes'][n]) for n in nodes]
        sides = [(a, b) for n, (a, b) in enumerate(zip(at, at[1:] + at[:1])) if a and b and (complete or n + 1 < len(at))]
        if len(at) < 2 or len(at) == 2 and complete:
            sides = []
        for a, b in sides:
            spot = ch.between(a, b)
            if spot:
                judge(all(ch.nearer_spot(spot, i, m) < 1 for m in ch.sites if m != i), 'the side of cell %d is not nearest to it', i)
        if complete and len(sides) > 2:
            for spot in ch.spots(i, at, case.seed):
                first = [ch.nearer_spot(spot, i, m) for m in ch.sites if m != i]
                inside = ch.inside(sides, i, spot)
                judge(inside < 1 or all(s < 1 for s in first), 'a spot of cell %d is not nearest to it', i)
                judge(inside > -1 or not all(s < 0 for s in first), 'a spot nearest to %d is not in its cell', i)


# ---- the nearest site ----

def read_nearest(case, out, err, form):
    if form == 'json':
        d = parsed(out)
        r = [{'i': q['i'], 'status': q['status'], 'lo': q['distance'][0], 'hi': q['distance'][1]} for q in d['nearest']]
        notes = []
    else:
        r, notes = rows(out, form)
    return {'aliases': aliases_of(notes, '') if form == 'csv' else None,
            'near': {int(q['i']): (q['status'], number(q['lo']), number(q['hi'])) for q in r}}


def judge_nearest(judge, case, c, ch):
    judge_near(judge, case, case.at, c['near'], ch)


def judge_near(judge, case, at, near, ch):
    """On the sphere a comparison that no precision decides (0) refutes nothing."""
    plane = isinstance(ch, Choice)
    for k in ch.sites:
        word, lo, hi = near.get(k, (None, None, None))
        signs = [ch.nearer(at, k, m) for m in ch.sites if m != k]
        if word is None:
            judge(any(s > 0 for s in signs) or not plane and 0 in signs, '%d is nearest, but not listed', k)
        else:
            if word in CERTAIN:
                judge(all(s < (0 if plane else 1) for s in signs), '%d is stated to be nearest for certain', k)
            judge(ch.is_within(at, k, lo, hi), 'the distance of %d is not in its bounds', k)
        if case.exact and not case.softened and all(s < 0 for s in signs):
            judge(any(q[0] in CERTAIN for q in near.values()), 'of exact points the nearest one is not certain')


def read_queries(case, out, err, form):
    if form == 'json':
        return None
    r, notes = rows(out, form)
    c = {'aliases': aliases_of(notes, '') if form == 'csv' else None, 'places': [{} for _ in case.queries]}
    for q in r:
        c['places'][int(q['q'])][int(q['i'])] = q['status'], number(q['lo']), number(q['hi'])
    return c


def judge_queries(judge, case, c, ch):
    for at, near in zip(case.queries, c['places']):
        judge_near(judge, case, at, near, ch)


# ---- tolerance ----

def read_tolerance(case, out, err, form):
    if form == 'json':
        d = parsed(out)
        r = [{**q, 'lo': q['bounds'][0], 'hi': q['bounds'][1], 'k': q['k'], 'l': q['l']} for q in d['pairs']]
        notes = []
    else:
        r, notes = rows(out, form)
    c = {'aliases': aliases_of(notes, '') if form == 'csv' else None,
         'events': {(int(q['i']), int(q['j'])): (q['event'], number(q['lo']), number(q['hi'])) for q in r}}
    for q in r:
        if q.get('plus') is not None:
            c.setdefault('forms', {})[int(q['i']), int(q['j'])] = number(q['plus']), number(q['minus'])
    return c


def judge_tolerance(judge, case, c, ch):
    """Of the places themselves: each event is where the largest annulus says."""
    for i, j in itertools.combinations(ch.sites, 2):
        event, lo, hi = c['events'].get((i, j), (None, None, None))
        e = ch.edge(i, j)
        unknown = case.kind == 'callback' and (e == 0 or any(list(ch.points).count(ch.points[k]) > 1 for k in (i, j)))
        if event is None and (case.softened or unknown) or ch.points[i] == ch.points[j]:
            continue  # that callbacks have equal places, or a tie, is not known
        judge((event == 'death') == (e == 1) and (event == 'tie') == (e == 0), '%d,%d: the event is %s', i, j, event)
        if event is None and case.up_to is None or e == 0 or case.weights or case.box_metric:
            continue
        with mpmath.workprec(400 if case.shape not in ('scales', 'tiny', 'huge') else 8192):
            w = oracle.annulus(ch.points, i, j, ch.sites) * e / 2
            if event is None:
                u = mpmath.mpf(case.up_to.numerator) / case.up_to.denominator
                judge(w >= u * (1 - mpmath.mpf(2) ** -90), '%d,%d is born at %s, but not listed', i, j, w)
                continue
            bound = [None if b is None else mpmath.mpf(b.numerator) / b.denominator for b in (lo, hi)]
            slack = mpmath.mpf(2) ** -90
            judge((bound[0] is None or bound[0] <= w * (1 + slack)) and (bound[1] is None or w * (1 - slack) <= bound[1]),
                  'the event of %d,%d is at %s, not in %s', i, j, w, bound)
            if (i, j) in c.get('forms', {}) and w != mpmath.inf:
                a, b = (mpmath.sqrt(mpmath.mpf(q.numerator) / q.denominator) for q in c['forms'][i, j])
                judge(abs(abs(a - b) / 2 - w) <= w * mpmath.mpf(2) ** -60, 'the exact event of %d,%d is another one', i, j)


def read_rho(case, out, err, form):
    r, notes = rows(out, form)
    return {'aliases': aliases_of(notes, '') if form == 'csv' else None, 'rho': {int(q['i']): number(q['rho']) for q in r}}


def read_barcode(case, out, err, form):
    r, notes = rows(out, form)
    return {'aliases': aliases_of(notes, ''), 'bars': [(Q(q['accuracy']), int(q['certain']), int(q['open'])) for q in r]}


def judge_barcode(judge, case, c, ch):
    if case.weights:
        return
    deaths = [oracle.annulus(ch.points, i, j, ch.sites) / 2 for i, j in itertools.combinations(ch.sites, 2) if ch.edge(i, j) == 1]
    for accuracy, certain, rest in c['bars']:
        a = mpmath.mpf(accuracy.numerator) / accuracy.denominator
        judge(certain <= sum(w >= a * (1 - 1e-9) for w in deaths), 'at %s fewer than %d edges are certain', accuracy, certain)
        judge(certain >= sum(w > a * (1 + 1e-9) for w in deaths), 'at %s more than %d edges are certain', accuracy, certain)


# ---- what to measure ----

def read_plan(case, out, err, form):
    d = parsed(out) if form == 'json' else {}
    r, notes = (d['points'], {}) if d else rows(out, form)
    return {'aliases': aliases_of(notes, '') if form == 'csv' else None, 'err': err, 'left': r and int(r[-1]['pairs_left']),
            'plan': {int(q['i']): number(q['half_width_needed']) for q in r if q.get('half_width_needed') not in (None, '')},
            'ranks': {(q['i'], q['j']): q['rank'] for q in d.get('pairs', [])}}


def read_decided(case, out, err, form):
    r, notes = rows(out, form)
    return {'aliases': aliases_of(notes, '') if form == 'csv' else None,
            'decided': [(int(q['i']), int(q['j']), int(q['rank'] or 0)) for q in r]}


def judge_decided_by(judge, case, c, ch):
    for i, j, rank in c['decided']:
        judge(i < j and rank >= 0 and {i, j} <= set(ch.sites), 'pair %d,%d of a plan, rank %d', i, j, rank)


def read_trials(case, out, err, form):
    r = parsed(out)['trials'] if form == 'json' else rows(out, form)[0]
    return {'trials': [tuple(int(q[k]) for k in ('trial', 'rounds', 'points', 'measurements', 'pairs_left')) for q in r]}


def judge_trials(judge, case, c, ch):
    """What any plan comes to; exact points are not measured."""
    judge([t[0] for t in c['trials']] == [0, 1, 2], 'trials are %s', c['trials'])
    for k, rounds, points, measured, left in c['trials']:
        judge((rounds > 0) == (points > 0) and points <= min(measured, len(ch.sites)) and rounds <= measured <= rounds * points,
              'trial %d: %d rounds, %d points, %d measurements', k, rounds, points, measured)
        judge(not case.exact or not rounds, 'exact points are measured')


# ---- counts ----

def read_converge(case, out, err, form):
    if form == 'json':
        d = parsed(out)
        last = d['stages'][-1]
    elif form == 'csv':
        r, _ = rows(out, 'csv')
        last = r[-1]
    else:
        return None
    return {'aliases': None, 'count': {k: int(last[k]) for k in ('legal', 'indeterminate', 'tie')}}


def judge_count(judge, case, c, ch):
    """Certain edges are edges of each choice; of exact points the numbers are those of the choice."""
    n = sum(ch.edge(i, j) == 1 for i, j in itertools.combinations(ch.sites, 2))
    weak = sum(ch.edge(i, j) == 0 for i, j in itertools.combinations(ch.sites, 2))
    count = c['count']
    if case.geometry == 'sphere':  # 0: not known; rows count what the first eye sees
        judge(count['legal'] <= n + weak, '%d pairs are counted as legal, but a choice has %d edges', count['legal'], n + weak)
        judge(n <= count['legal'] + count['indeterminate'] + count['tie'], 'a choice has more edges than are possible')
        return
    judge(count['legal'] <= n, '%d pairs are counted as legal, but a choice has %d edges', count['legal'], n)
    judge(case.extra == 'few pairs' or n + weak <= count['legal'] + count['indeterminate'] + count['tie'], 'a choice has more edges than are possible')
    if case.exact and not case.softened:
        judge((count['legal'], count['tie']) == (n, weak), '%s of exact points with %d edges and %d ties', count, n, weak)


def read_check(case, out, err, form):
    return {'aliases': None, 'fine': 'fine' in out}


def judge_check(judge, case, c, ch):
    judge(c['fine'], 'check finds a fault')


def read_disc(case, out, err, form):
    if form == 'json':
        d = parsed(out)
        key = next((k for k in ('con', 'points', 'others') if k in d), None)
        con = {q['i']: q['con'] for q in d[key]} if key else {}
        circles = [{a + e: c[a + '_decimal'][k] for a in 'xy' for k, e in enumerate(('lo', 'hi'))} for c in d['circles']]
        return {'aliases': None, 'con': con, 'turn': d['orientation'], 'circles': circles}
    r, notes = rows(out, 'csv')
    turn = next((n.rpartition(': ')[2] for n in notes if n.startswith('orientation')), None)
    return {'aliases': None, 'con': {int(q['i']): q['con'] for q in r if 'con' in q}, 'turn': turn,
            'circles': [q for q in r if 'circle' in q]}


def rows_of_points(case):
    """The rows that are points of their own: of those merged the first."""
    names = list(case.merged.values()) if case.extra == 'merge' else [s.name for s in case.sites] if case.extra == 'merge by' else None
    return [k for k in range(len(case.sites)) if not names or names.index(names[k]) == k]


def judge_disc(judge, case, c, ch):
    kept = rows_of_points(case)
    p = [ch.p[k] for k in kept]
    if len(p) < 3:
        return
    t = oracle.turn(*p[:3])
    if c['turn'] in ('counter-clockwise', 'clockwise'):
        judge((t > 0) == (c['turn'] == 'counter-clockwise') and t != 0, 'the orientation is stated %s', c['turn'])
    for a in range(2 if c.get('circles') and t != 0 else 0):  # the box of the six centres holds that of every choice
        lo, hi = ([number(q['xy'[a] + end]) for q in c['circles']] for end in ('lo', 'hi'))
        at = oracle.centre(*(ch.points[k] for k in kept[:3]))[a]
        judge(None in lo + hi or min(lo) <= at <= max(hi), 'a centre is outside the box of the circles')
    for k, word in c['con'].items():
        if word in ('inside', 'outside') and t != 0:
            s = oracle.in_circle(*p[:3], ch.p[k]) * (1 if t > 0 else -1)
            judge(s > 0 if word == 'inside' else s < 0, 'point %d is stated %s', k, word)


def read_stages(case, out, err, form):
    """The rows of a table of a disc or bisector."""
    return {'aliases': None, 'stages': parsed(out)['stages'] if form == 'json' else rows(out, 'csv')[0], 'before': []}


def bound_of(row, name):
    value = row[name]['exact'] if isinstance(row[name], dict) else row[name]
    return None if value in (None, '') else real(number(value))


def real(x):
    return mpmath.mpf(x.numerator) / x.denominator if isinstance(x, Q) else mpmath.mpf(x)


ROUNDING = mpmath.mpf(10) ** -1500  # of numbers of 2,000 digits, which hold no thirds


def judge_disc_stages(judge, case, c, ch):
    """Con and orientation of each stage; the discs of two choices lie between the same I and E."""
    kept = rows_of_points(case)
    turn = oracle.turn(*(ch.p[k] for k in kept[:3])) if len(kept) >= 3 else 0
    for row in c['stages']:
        con = row['con'] if isinstance(row['con'], list) else [word.split(':')[1] for word in row['con'].split()]
        judge_disc(judge, case, {'con': dict(zip(kept[3:], con)), 'turn': row['orientation']}, ch)
    if turn == 0:
        return
    with mpmath.workdps(2000):
        x, y = (real(z) for z in oracle.centre(*(ch.points[k] for k in kept[:3])))
        r = mpmath.hypot(x - real(ch.points[kept[0]][0]), y - real(ch.points[kept[0]][1]))
        for u, v, s in c['before']:
            for row in c['stages']:
                area, far = bound_of(row, 'area'), bound_of(row, 'hausdorff')
                judge(far is None or mpmath.hypot(x - u, y - v) + abs(r - s) <= far + ROUNDING,
                      'discs of two choices are farther apart than %s', far)
                judge(area is None or mpmath.pi * abs(r * r - s * s) <= area + ROUNDING,
                      'areas of the discs of two choices differ by more than %s', area)
        c['before'].append((x, y, r))


def judge_bisector_stages(judge, case, c, ch):
    """The middle of two points of one choice is near the bisector of those of another one."""
    with mpmath.workdps(2000):
        a, b = ([real(z) for z in ch.points[k]] for k in rows_of_points(case)[:2])
        length = mpmath.hypot(a[0] - b[0], a[1] - b[1])
        for row in c['stages']:
            judge(row['disjoint'] == 'no' or length > 0, 'points that may coincide are stated to be apart')
            far = bound_of(row, 'hausdorff')
            for x, y in c['before']:
                off = abs((a[0] - x) ** 2 + (a[1] - y) ** 2 - (b[0] - x) ** 2 - (b[1] - y) ** 2)
                judge(far is None or off <= 2 * length * far + ROUNDING, 'a point of a bisector is farther than %s from another one', far)
        middle = [(u + v) / 2 for u, v in zip(a, b)]
        if case.extra != 'window' or max(map(abs, middle)) <= 1:
            c['before'].append(middle)


def read_bisector(case, out, err, form):
    """The ends of arcs with rational coordinates: (far, near, x, y)."""
    ends = []
    if form == 'json':
        for a in (a for c in parsed(out)['curves'] for n in c['boundary']['chains'] for a in n['arcs']):
            for e in (a['begin'].get('at'), a['end'].get('at')):
                if e and number(e['x']['b']) == number(e['y']['b']) == 0:
                    d = number(e['d'])
                    ends.append((a['far'], a['near'], number(e['x']['a']) / d, number(e['y']['a']) / d))
    else:
        for q in rows(out, 'csv')[0]:
            for e in ('begin', 'end'):
                if re.fullmatch(r'-?\d+(/\d+)?', q[e + '_x'] or '') and re.fullmatch(r'-?\d+(/\d+)?', q[e + '_y'] or ''):
                    ends.append((int(q['far']), int(q['near']), Q(q[e + '_x']), Q(q[e + '_y'])))
    return {'aliases': None, 'ends': ends}


def judge_bisector(judge, case, c, ch):
    """On the curve that bounds where `far` is certainly nearer, no choice has `near` nearer."""
    for far, near, x, y in c['ends']:
        judge(oracle.far2(ch.points[far], (x, y)) <= oracle.far2(ch.points[near], (x, y)),
              'an end of an arc of %d and %d is nearer to %d', far, near, near)


@dataclasses.dataclass
class Stated:
    command: str
    read: object
    judge: object
    args: list = dataclasses.field(default_factory=list)
    formats: tuple = ('csv',)
    geometries: tuple = ('plane',)
    kinds: object = None        # a test of the kind's name
    least: int = 1              # points
    layer: str = None
    python: bool = False        # of the Python package only

    def words(self):
        return [*(['--layer', self.layer] if self.layer else []), *self.args]


ROWS = ('csv', 'wkt', 'geojson')
ALL = ('plane', 'sphere', 'discs')
FIRM = ('exact', 'column', 'scaled column')
TRUE = FIRM + ('disguised', 'real', 'callback')  # points that have a place, given or computed
STATED = {
    'pairs': Stated('delaunay', read_pairs, judge_pairs, formats=('csv', 'json', 'wkt', 'geojson', 'vtk', 'svg', 'obj'),
                    geometries=ALL),
    'pairs with ties': Stated('delaunay', read_pairs, judge_pairs, args=['--list-ties', 'pairs'], formats=ROWS),
    'pairs without ties': Stated('delaunay', read_unlisted, judge_pairs, args=['--list-ties', 'none'], formats=ROWS),
    'groups': Stated('delaunay', read_groups, judge_groups, args=['--list-ties', 'groups']),
    'layer ties': Stated('delaunay', read_groups, judge_groups, layer='ties'),
    'aliases': Stated('delaunay', read_aliases, None, layer='aliases', formats=ROWS),
    'aliases of cells': Stated('voronoi', read_aliases, None, layer='aliases', formats=ROWS, geometries=('plane', 'discs')),
    'layer pairs': Stated('delaunay', read_pairs, judge_pairs, layer='pairs', formats=ROWS, geometries=ALL),
    'hull': Stated('delaunay', read_points, judge_points, layer='points', formats=ROWS, geometries=ALL),
    'triangles': Stated('delaunay', read_triangles, judge_triangles, layer='triangles', formats=ROWS,
                        geometries=ALL),
    **{'graph ' + g: Stated('delaunay', read_graph, judge_graph(g), layer='graph:' + g, formats=ROWS, geometries=('plane', 'discs'))
       for g in oracle.GRAPHS},
    'interpolation range': Stated('delaunay', read_range, judge_range, python=True),
    'cells': Stated('voronoi', read_cells, judge_cells, formats=('csv', 'json', 'wkt', 'geojson'), layer=None, geometries=('plane', 'discs')),
    'layer cells': Stated('voronoi', read_cells, judge_cells, formats=ROWS, layer='cells', geometries=('plane', 'discs')),
    'tiles': Stated('voronoi', read_tiles, judge_tiles, layer='tiles', formats=(*ROWS, 'json'), geometries=('plane', 'discs')),
    'tiles in an area': Stated('voronoi', read_cut, judge_cut, args=['--clip-to', '@area'], layer='tiles', formats=(*ROWS, 'json'),
                               geometries=('plane', 'discs')),
    'vertices': Stated('voronoi', read_vertices, judge_vertices, layer='vertices', formats=ROWS,
                       geometries=ALL, least=3),
    'edges': Stated('voronoi', read_edges, judge_edges, layer='edges', formats=('csv',), geometries=('plane', 'discs')),
    'regions': Stated('voronoi', read_regions, judge_regions, layer='regions', formats=ROWS, geometries=('plane', 'discs')),
    'cells of the globe': Stated('voronoi', read_globe_cells, judge_globe_cells, formats=('json',), geometries=('sphere',)),
    'nearest': Stated('nearest', read_nearest, judge_nearest, formats=('csv', 'json'), geometries=ALL),
    'queries': Stated('nearest', read_queries, judge_queries, formats=('csv',), geometries=ALL),
    'queries of a table': Stated('nearest', read_queries, judge_queries, formats=('csv',), geometries=ALL),
    'tolerance': Stated('tolerance', read_tolerance, judge_tolerance, formats=('csv', 'json', 'wkt', 'geojson'),
                        kinds=TRUE, least=2),
    'layer tolerance': Stated('tolerance', read_tolerance, judge_tolerance, layer='pairs', formats=ROWS, kinds=TRUE,
                              least=2),
    'rho': Stated('tolerance', read_rho, None, layer='points', formats=ROWS, kinds=TRUE, least=2),
    'barcode': Stated('tolerance', read_barcode, judge_barcode, layer='barcode', kinds=FIRM, least=2),
    'plan': Stated('plan', read_plan, None, formats=(*ROWS, 'json'), geometries=ALL, least=2),
    'layer plan': Stated('plan', read_plan, None, layer='points', formats=ROWS, geometries=ALL, least=2),
    'pairs of a plan': Stated('plan', read_decided, judge_decided_by, layer='pairs', formats=ROWS, geometries=ALL, least=2),
    'trials': Stated('plan', read_trials, judge_trials, args=['--simulate', '3', '--seed', '5'], formats=('csv', 'json'), geometries=ALL,
                     least=2),
    'converge': Stated('converge', read_converge, judge_count, args=['--no-times'], formats=('csv', 'json'), geometries=ALL),
    'converge of voronoi': Stated('converge', read_converge, judge_count, args=['--of', 'voronoi', '--label', 'a=b'], geometries=('plane', 'discs')),
    'converge of delaunay': Stated('converge', read_converge, judge_count, args=['--of', 'delaunay'], geometries=('plane', 'discs')),
    'converge of disc': Stated('converge', read_stages, judge_disc_stages, args=['--of', 'disc'], formats=('csv', 'json'), least=3),
    'converge of bisector': Stated('converge', read_stages, judge_bisector_stages, args=['--of', 'bisector'],
                                   formats=('csv', 'json'), least=2),
    'check': Stated('check', read_check, judge_check, args=['--schedules', '3', '--seed', '5'], formats=('csv', 'json')),
    'disc': Stated('disc', read_disc, judge_disc, formats=('csv', 'json'), least=3),
    'circles': Stated('disc', read_disc, judge_disc, layer='circles', least=3),
    'con': Stated('disc', read_disc, judge_disc, layer='con', least=3),
    'bisector': Stated('bisector', read_bisector, judge_bisector, formats=('csv', 'json'), least=2),
    'hulls': Stated('delaunay', read_hulls, region.judge_hulls, layer='hulls', formats=ROWS, least=2),
    'exterior': Stated('delaunay', read_exterior, region.judge_exterior, layer='exterior', formats=ROWS)}
