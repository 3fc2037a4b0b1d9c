#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Certificates on a sphere: random sets are accepted, their statements equal the output of delaunay, and no forgery is
accepted [CERT-14].

Usage: test_globe.py DYADEL AIRPORTS [COUNT]

So are certificates of the places nearest to a place [CERT-12].

Images are computed here by mpmath, from vectors, by no formula of the checker. Prints its seed (DYADEL_TEST_SEED).
"""
import collections
import os
import pathlib
import random
import re
import subprocess
import sys
import tempfile
from fractions import Fraction as Q

import mpmath

DYADEL, AIRPORTS = sys.argv[1], sys.argv[2]
SEED = int(os.environ.get('DYADEL_TEST_SEED', '1'))
COUNT = int(sys.argv[3]) if len(sys.argv) > 3 else 16 if os.environ.get('DYADEL_TEST_SANITIZED') else 60
EARTH = Q('6371008.8')
UNPROVED = 'not proved: that \\d+ rectangles hold the images'
mpmath.mp.dps = 60


def run(*args):
    return subprocess.run([DYADEL, *map(str, args)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)


# ---- sets of places ----

def degrees(r, kind):
    """Some places."""
    n = r.randrange(0, 14)
    if kind == 0:
        return [(r.randrange(-180, 361), r.randrange(-90, 91)) for _ in range(n)]
    if kind == 1:
        return [(r.randrange(-12, 24) * 30, r.choice([-90, -60, -45, -30, 0, 30, 45, 60, 90])) for _ in range(n)]
    if kind == 2:
        return [(r.randrange(0, 6) * 60, r.randrange(85, 91) * r.choice([1, 1, 1, -1])) for _ in range(n)]
    if kind == 3:
        return [(round(r.uniform(176, 184), 3) - 360 * r.randrange(2), round(r.uniform(-4, 4), 3)) for _ in range(n)]
    if kind == 4:
        lon, lat, size = r.uniform(-180, 180), r.uniform(-85, 85), 10 ** r.uniform(-9, 0)
        return [(f'{lon + size * r.uniform(-1, 1):.15f}', f'{lat + size * r.uniform(-1, 1):.15f}') for _ in range(n)]
    if kind == 5:
        rows, columns = r.randrange(1, 4), r.randrange(1, 5)
        step, lon, lat = r.choice([1, 5, 10, Q(1, 10)]), r.randrange(-180, 180), r.randrange(-40, 40)
        return [(float(lon + k * step), float(lat + l * step)) for k in range(columns) for l in range(rows)]
    if kind == 6:
        return [(r.choice(['sqrt(2)', 'pi/7', '1/3', '100', 'e^3', '-17.25']), r.choice(['sqrt(3)', '-40', '2/7', 'pi^2', '60']))
                for _ in range(n)]
    return [(round(r.uniform(-180, 180), 7), round(r.uniform(-89, 89), 7)) for _ in range(n)]


RADII = [[], [], [], ['--radius', '0.01deg'], ['--radius', '2deg'], ['--radius', '5arcmin'], ['--radius', '3', '--radius-unit', 'ft'], ['--radius', '30m'], ['--radius', '2km'], ['--radius', '200km'],
         ['--measured'], ['--radius-column', 'r'], ['--radius-column', 'r', '--radius', '1km']]


def points_file(folder, r, places, options):
    path = folder / 'points'
    if '--radius-column' not in options:
        path.write_text(''.join(f'{x} {y}\n' for x, y in places))
        return [path]
    units = ['30m', '2km', '150km', '0', '0.5deg', '1deg']
    path.write_text('x,y,r\n' + ''.join(f'"{x}","{y}",{r.choice(units)}\n' for x, y in places))
    return ['--columns', 'x,y', path]


# ---- what a certificate states ----

def value(text):
    m, _, e = text.partition('*2^')
    return Q(int(m)) * Q(2) ** int(e or 0)


def side(text):
    if '/' in text:
        lo, den = text.split('/')
        return (value(lo) / int(den),) * 2
    lo, _, width = text.partition('+')
    return value(lo), value(lo) + (value(width) if width else 0)


Section = collections.namedtuple('Section', 'eye radius places neighbours outcome')


def views(lines):
    """The certificate, or both of them, the second with the places of the first."""
    if 'also' not in lines:
        return [lines]
    at, cut = lines.index('sphere'), lines.index('also')
    again = lines[cut + 1:-2]
    k = again.index('sphere') + 2
    return [lines[:cut] + lines[-2:], again[:k] + lines[at + 2:at + 4 + int(lines[at + 3].split()[1])] + again[k:]]


def section(lines):
    at = lines.index('sphere')
    n = int(lines[at + 3].split()[1])
    m = int(lines[at + 4 + n].split()[1])
    return Section(lines[at + 1].split()[1:], lines[at + 2].split()[1:], [l.split() for l in lines[at + 4:at + 4 + n]],
                   [l.split() for l in lines[at + 5 + n:at + 5 + n + m]], lines[-2].split()[1])


def images_of(s):
    """The places that the sites are images of."""
    return [i for i, p in enumerate(s.places) if '=' not in p and (s.eye[0] == 'gap' or i != int(s.eye[0]))]


def statuses(lines):
    """Of pairs of places, by the certificate's statements: a pair that is open from one eye has the status seen from
    the other eye."""
    first, *other = [statuses_seen(view) for view in views(lines)]
    for more in other:
        first = {p: more[p] if s == 'indeterminate' else s for p, s in first.items() if s != 'indeterminate' or p in more}
    return first


def statuses_seen(lines):
    s, found = section(lines), {}
    of = images_of(s)
    legal = lines.index(next(l for l in lines if re.match(r'legal \d+$', l)))
    for line in lines[legal + 1:legal + 1 + int(lines[legal].split()[1])]:
        i, j = map(int, line.split()[:2])
        found[of[i], of[j]] = 'legal'
    for line in lines[lines.index('pairs') + 1:]:
        if line[0] not in 'otln' or line[1] != ' ':
            break
        kind, i, j = line.split()[:3]
        if kind != 'n':
            found[of[int(i)], of[int(j)]] = {'o': 'indeterminate', 't': 'tie', 'l': 'legal'}[kind]
    if s.eye[0] == 'gap':
        around = [of[int(k)] for _, k in s.neighbours]
        return {(i, j): 'indeterminate' for i in around for j in around if i < j} | found
    eye = int(s.eye[0])
    for kind, k, *_ in s.neighbours:
        i = of[int(k)]
        found[min(i, eye), max(i, eye)] = {'o': 'indeterminate', 't': 'tie', 'l': 'legal'}[kind]
    return found


# ---- images, from vectors ----

def number(q):
    return mpmath.mpf(q.numerator) / q.denominator


def cos_sin(q):
    a = number(q) * mpmath.pi / 180
    return mpmath.cos(a), mpmath.sin(a)


def vector(lon, lat):
    (cl, sl), (cf, sf) = cos_sin(lon), cos_sin(lat)
    return cf * cl, cf * sl, sf


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def region(s, i):
    """Degrees from, to; degrees that are added; angle in radians."""
    p = s.places[i]
    metres = value(p[2]) if len(p) == 3 else Q(0)
    radius = side(s.radius[1])[0] if len(s.radius) == 2 else Q(0)
    if s.radius[0] == 'metres':
        metres += radius
    return side(p[0]), side(p[1]), radius if s.radius[0] == 'degrees' else Q(0), metres / EARTH


def choice(r, s, i):
    """A point of the region: longitude and latitude in degrees, and a vector; often at its border."""
    lon, lat, more, angle = region(s, i)
    def within(lo, hi):
        t = Q(r.choice([0, 1, 1, 0, r.random()]))
        return lo - more + t * (hi - lo + 2 * more)
    x, y = within(*lon), min(Q(90), max(Q(-90), within(*lat)))
    v = vector(x, y)
    if angle:
        (cl, sl), (cf, sf) = cos_sin(x), cos_sin(y)
        way = r.choice([0, 90, 180, 270, r.uniform(0, 360)])
        c, d = cos_sin(Q(way))
        t = tuple(c * e + d * n for e, n in zip((-sl, cl, 0), (-sf * cl, -sf * sl, cf)))
        a = number(angle) * r.choice([1, 1, r.random()])
        v = tuple(mpmath.cos(a) * p + mpmath.sin(a) * q for p, q in zip(v, t))
    return v


def image(v, eye):
    """Stereographic, from the vector `eye` on the plane through the middle: east and north there."""
    flat = mpmath.hypot(eye[0], eye[1])
    cl, sl = (eye[0] / flat, eye[1] / flat) if flat > 1e-50 else (mpmath.mpf(1), mpmath.mpf(0))
    east, north = (-sl, cl, 0), (-eye[2] * cl, -eye[2] * sl, flat)
    away = 1 - dot(v, eye)
    return dot(v, east) / away, dot(v, north) / away


def outside(r, lines, tries):
    """Some image that is not in its rectangle; None: none was found."""
    lines = r.choice(views(lines))
    s = section(lines)
    at = next(k for k, l in enumerate(lines) if re.match(r'sites \d+$', l))
    of = images_of(s)
    for _ in range(tries if of else 0):
        eye = vector(*(side(x)[0] for x in s.eye[1:])) if s.eye[0] == 'gap' else choice(r, s, int(s.eye[0]))
        k = r.randrange(len(of))
        if lines[at + 1 + k][0] == '=':
            continue
        rect = [side(x) for x in lines[at + 1 + k].split()]
        v = choice(r, s, of[k])
        if dot([a - b for a, b in zip(v, eye)], [a - b for a, b in zip(v, eye)]) < mpmath.mpf(10) ** -50:
            return k, 'the eye'
        for z, (lo, hi) in zip(image(v, eye), rect):
            slack = mpmath.mpf(10) ** -45 * (1 + abs(z) ** 2)
            if z < number(lo) - slack or z > number(hi) + slack:
                return k, z, rect
    return None


# ---- checks ----

def write(folder, places, options, r):
    path = folder / 'certificate'
    path.unlink(missing_ok=True)
    given = points_file(folder, r, places, options)
    done = run('delaunay', '--sphere', '--quiet', *options, *given, '--certificate', path)
    return (path.read_text().splitlines() if path.exists() else None), done, given


def verified(folder, lines, *options):
    path = folder / 'checked'
    path.write_text(''.join(l + '\n' for l in lines))
    return run('verify', path, *options)


def check_random(folder, r, k, met):
    places, options = degrees(r, k % 8), RADII[r.randrange(len(RADII))]
    lines, done, given = write(folder, places, options, r)
    if lines is None:  # points that may be anywhere
        assert done.returncode in (1, 2, 4), (SEED, k, places, options, done)
        met['none'] += 1
        return
    about = (SEED, k, places, options)
    rows = [l.split(',') for l in done.stdout.splitlines() if l[0] not in '#i']
    stated, shown = statuses(lines), {(int(i), int(j)): s for i, j, s in rows}
    for p in stated.keys() | shown.keys():  # what only a second gap shows is open in the certificate
        assert stated.get(p, 'illegal') in (shown.get(p, 'illegal'), 'indeterminate'), (about, p)
    plain = verified(folder, lines)
    assert plain.returncode in (0, 3), (about, plain)
    bound = verified(folder, lines, '--sphere', '--points', given[-1], *given[:-1], *options)
    assert bound.returncode in (0, 3), (about, bound)
    for said in (plain, bound):
        assert not re.search(UNPROVED, said.stdout), (about, said)
        met.update(re.sub(r'\d+', 'N', l) for l in said.stdout.splitlines() if l.startswith('not proved'))
    met['all of it', bound.returncode == 0] += 1
    met['two eyes' if 'also' in lines else 'gap' if section(lines).eye[0] == 'gap' else 'place'] += 1
    assert not outside(r, lines, 40), (about, outside(r, lines, 40))
    if section(lines).places:
        check_forged(folder, r, lines, about, met)


def nudged(r, text, by):
    """The coordinate, moved by a dyadic; kept in the form of the certificate."""
    if '/' in text:
        return str(r.randrange(-80, 80))
    lo, plus, width = text.partition('+')
    q = value(lo) + by
    e = q.denominator.bit_length() - 1
    m = q.numerator
    while m and m % 2 == 0 and e == 0:
        m, e = m // 2, e - 1
    while m and m % 2 == 0:
        m //= 2
        e -= 1
    return (f'{m}*2^{-e}' if e and m else str(m)) + plus + width


def forge(r, lines):
    """One change of the statements about places, of the eye, of a rectangle, of neighbours."""
    at, out = lines.index('sphere'), list(lines)
    n = int(lines[at + 3].split()[1])
    first = at + 4
    site = next(k for k, l in enumerate(lines) if re.match(r'sites \d+$', l)) + 1
    count = int(lines[site - 1].split()[1])
    what = r.randrange(9)
    if 'also' in lines and r.randrange(2):  # of the second eye
        cut = lines.index('also')
        again = lines[cut:]
        head, eye = again.index(next(l for l in again if l.startswith('neighbours'))), again.index('sphere') + 1
        k = r.randrange(head + 1, len(again) - 4)
        if r.randrange(2):
            again[k] = r.choice('lt') + again[k][1:]
            return 10, lines[:cut] + again
        words = again[eye].split()
        a = r.randrange(2, 4)
        words[a] = nudged(r, words[a], r.choice([1, -1]) * Q(2) ** r.randrange(-60, 8))
        again[eye] = ' '.join(words)
        return 9, lines[:cut] + again
    if what == 0:  # a place is moved
        k = first + r.randrange(n)
        words = out[k].split()
        a = r.randrange(2)
        words[a] = nudged(r, words[a], r.choice([1, -1]) * Q(2) ** r.randrange(-60, 8))
        out[k] = ' '.join(words)
    elif what == 1:  # another radius, a wider one most of the time
        words = out[at + 2].split()
        if len(words) == 3:
            out[at + 2] = ' '.join(words[:2] + [nudged(r, words[2], r.choice([1, 1, -1]) * value(words[2].split('/')[0]) / 2 ** r.randrange(1, 40))])
        else:
            out[at + 2] = r.choice(['radius degrees 1*2^-10', 'radius metres 1', 'radius metres 1*2^-20'])
    elif what == 2:  # another unit
        out[at + 2] = out[at + 2].replace('metres', '?').replace('degrees', 'metres').replace('?', 'degrees')
    elif what == 3:  # another eye
        words = out[at + 1].split()
        if words[1] == 'gap':
            a = r.randrange(2, 4)
            words[a] = nudged(r, words[a], r.choice([1, -1]) * Q(2) ** r.randrange(-60, 8))
            out[at + 1] = ' '.join(words)
        else:
            out[at + 1] = r.choice([f'eye {r.randrange(n)}', 'eye gap 0 0', 'eye ' + str(n)])
    elif what == 4 and count:  # a rectangle that is smaller, or moved
        k = site + r.randrange(count)
        words = out[k].split()
        a = r.randrange(2)
        if '+' in words[a]:
            lo, width = words[a].split('+')
            by = value(width) / 2 ** r.randrange(1, 12)
            words[a] = nudged(r, lo, r.choice([0, by])) + '+' + nudged(r, width, -by)
        out[k] = ' '.join(words)
    elif what == 5 and n:  # a radius of its own
        k = first + r.randrange(n)
        words = out[k].split()
        if len(words) == 2:
            out[k] += ' ' + r.choice(['1', '1*2^-30', '125*2^3'])
        elif len(words) == 3:
            out[k] = ' '.join(words[:2] + [nudged(r, words[2], value(words[2]))])
    elif what == 6 and n > 1:  # two places changed, or one an alias
        i, j = sorted(r.sample(range(n), 2))
        if r.randrange(2):
            out[first + i], out[first + j] = out[first + j], out[first + i]
        else:
            out[first + j] = ' '.join(out[first + j].split()[:2]) + f' = {i}'
    elif what == 7:  # a neighbour removed, or of another kind
        head = first + n
        m = int(out[head].split()[1])
        if m:
            k = head + 1 + r.randrange(m)
            if r.randrange(2):
                out[head] = f'neighbours {m - 1}'
                del out[k]
            else:
                out[k] = r.choice('lto') + out[k][1:]
    else:
        out[-2] = 'outcome ' + r.choice(['decided', 'fixpoint', 'certified'])
    return what, out


def weaker(old, new):
    """Returns whether `new` states nothing that is not in `old`."""
    return all(new.get(p, 'illegal') in (s, 'indeterminate') for p, s in old.items()) and all(
        s == 'indeterminate' for p, s in new.items() if p not in old)


def check_forged(folder, r, lines, about, met):
    """An accepted certificate has rectangles that contain the images of their places, and states only what the places
    show."""
    for _ in range(4):
        what, forged = forge(r, lines)
        if forged == lines:
            continue
        done = verified(folder, forged)
        assert done.returncode in (0, 1, 3), (about, what, done)
        met['forged', what, done.returncode] += 1
        if done.returncode == 1 or re.search(UNPROVED, done.stdout):
            continue
        found = outside(r, forged, 200)
        assert not found, (about, what, forged, found)
        if what == 7:
            named = re.search('not proved: that (\\d+ (images that|pairs without)|no refinement)', done.stdout)
            assert named or weaker(statuses(lines), statuses(forged)), (about, forged, done)


def check_airports(folder):
    """Exact, and within two kilometres: all of it is proved."""
    for options in ([], ['--radius', '2km'], ['--radius', '0.5km'], ['--measured'])[::3 if os.environ.get('DYADEL_TEST_SANITIZED') else 1]:
        path = folder / 'airports'
        read = ['--columns', 'longitude,latitude', *options]
        assert run('delaunay', '-q', '--sphere', *read, AIRPORTS, '-o', folder / 'pairs', '--certificate', path).returncode in (0, 3)
        for given in ([], ['--sphere', '--points', AIRPORTS, *read]):
            done = run('verify', path, *given)
            assert done.returncode == 0 and 'accepted, all of it proved' in done.stdout, (options, given, done)
    wrong = run('verify', path, '--points', AIRPORTS, *read)
    assert wrong.returncode == 1 and wrong.stderr.endswith('give --sphere\n'), wrong
    wrong = run('verify', path, '--points', AIRPORTS, *read, '--sphere', '--radius', '1m')
    assert wrong.returncode == 1 and 'the radius of the points' in wrong.stderr, wrong


def check_plane(folder):
    """--sphere with a certificate on a plane."""
    (folder / 'points').write_text('0 0\n1 0\n0 1\n')
    run('delaunay', folder / 'points', '--certificate', folder / 'plane', '-o', folder / 'pairs')
    wrong = run('verify', folder / 'plane', '--sphere', '--points', folder / 'points')
    assert wrong.returncode == 1 and wrong.stderr.endswith('remove --sphere\n'), wrong


def check_cells(folder):
    """Cells are not stated: the command says so."""
    (folder / 'points').write_text('0 0\n90 10\n180 -20\n-80 40\n')
    for command in ('voronoi', 'delaunay'):
        done = run(command, '--sphere', folder / 'points', '--certificate', folder / 'sphere', '-o', folder / 'out')
        assert done.returncode == 0 and ('not the cells' in done.stderr) == (command == 'voronoi'), done


# ---- nearest places ----

Near = collections.namedtuple('Near', 'radius places rows')


def near_section(lines):
    at = lines.index('sphere')
    n = int(lines[at + 2].split()[1])
    rows = lines[at + 4 + n:-1]
    assert lines[at + 3 + n] == f'nearest {len(rows)}' and lines[-1] == 'end', lines
    return Near(lines[at + 1].split()[1:], [l.split() for l in lines[at + 3:at + 3 + n]], [l.split() for l in rows])


def angle(a, b):
    return 2 * mpmath.asin(min(mpmath.mpf(1), mpmath.sqrt(sum((x - y) ** 2 for x, y in zip(a, b))) / 2))


def false_near(r, lines, tries):
    """A statement that is false for some choice of the places; None: none was found."""
    s, slack = near_section(lines), mpmath.mpf(10) ** -45
    for x, y, kind, *rest in s.rows if s.places else []:
        asked = Near(['none'], [[x, y]], [])
        listed = {int(i): (value(lo), None if hi == 'none' else value(hi)) for i, lo, hi in zip(rest[::3], rest[1::3], rest[2::3])}
        for _ in range(tries):
            z = choice(r, asked, 0)
            far = [angle(z, choice(r, s, i)) for i in range(len(s.places))]
            first = min(range(len(far)), key=far.__getitem__)
            if any(kind == 'c' and far[k] <= far[int(rest[0])] - slack for k in range(len(far)) if k not in listed):
                return x, y, 'not certain'
            if first not in listed and '=' not in s.places[first] and far[first] < min(far[k] for k in listed) - slack:
                return x, y, first, 'is nearest'
            for i, (lo, hi) in listed.items():
                metres = far[i] * number(EARTH)
                if metres < number(lo) - slack * 10**8 or (hi is not None and metres > number(hi) + slack * 10**8):
                    return x, y, i, metres, 'is out of bounds'
    return None


def forge_near(r, lines):
    """One change: of a place, a radius, a row."""
    out, at = list(lines), lines.index('sphere')
    n = int(lines[at + 2].split()[1])
    what, row = r.randrange(6), at + 4 + n + r.randrange(len(lines) - at - 5 - n)
    words = out[row].split()
    def by(text):
        return r.choice([1, -1]) * (Q(2) ** r.randrange(-60, 8) if r.randrange(2) else abs(value(text)) / 2 ** r.randrange(30))
    if what == 0 and n:  # a place is moved, or has another radius
        k = at + 3 + r.randrange(n)
        place = out[k].split()
        a = r.randrange(len(place)) if '=' not in place else 0
        place[a] = nudged(r, place[a], by('1'))
        out[k] = ' '.join(place)
    elif what == 1:
        out[at + 1] = r.choice(['radius none', 'radius degrees 1', 'radius metres 125*2^4', 'radius metres 125*2^14'])
    elif what == 2:  # another place is asked about
        a = r.randrange(2)
        words[a] = nudged(r, words[a], by('1'))
    elif what == 3:  # one less is listed
        if len(words) > 6:
            k = 3 * r.randrange(1, len(words) // 3)
            del words[k:k + 3]
        if len(words) == 6 and r.randrange(2):
            words[2] = 'c'
    elif what == 4:  # one more, or another one
        k = 3 * r.randrange(1, len(words) // 3) if len(words) > 3 else 3
        words[k:k + r.choice([0, 3])] = [str(r.randrange(max(n, 1))), '0', 'none']
    elif len(words) > 5:  # a bound
        k = r.choice([q for q in range(4, len(words)) if q % 3])
        words[k] = nudged(r, words[k], by(words[k])) if words[k] != 'none' else '1*2^10'
    out[row] = ' '.join(words) if what > 1 else out[row]
    return what, out


def asked_about(r, places):
    """Places of queries: near the others, between two, any, boxes."""
    for _ in range(3):
        x, y = r.choice(places or [(0, 0)])
        kind = r.randrange(5)
        if kind == 0 and len(places) > 1 and all(isinstance(v, (int, float)) for p in places for v in p):
            (a, b), (c, d) = r.sample(places, 2)
            x, y = (a + c) / 2, (b + d) / 2
        elif kind > 1:
            x, y = round(r.uniform(-180, 180), 2), round(r.uniform(-90, 90), 2)
        if kind == 2:
            x, y = f'[{x},{x + r.choice([0.01, 1, 40])}]', f'[{max(y - 3, -90)},{y}]'
        yield x, y


def check_nearest(folder, r, k, met):
    places, options = degrees(r, k % 8), RADII[r.randrange(len(RADII))]
    path, queries = folder / 'certificate', folder / 'queries'
    path.unlink(missing_ok=True)
    queries.write_text(''.join(f'{x} {y}\n' for x, y in asked_about(r, places)))
    given = points_file(folder, r, places, options)
    done = run('nearest', '--sphere', '--quiet', *options, *given, '--queries', queries, '--certificate', path)
    about = (SEED, k, places, options, queries.read_text())
    if not path.exists():
        assert done.returncode in (1, 2), (about, done)
        met['nearest', 'none'] += 1
        return
    lines = path.read_text().splitlines()
    kinds = [row[2] for row in near_section(lines).rows]
    rows = [l.split(',') for l in done.stdout.splitlines() if l[0] not in '#q']
    for q, row in enumerate(near_section(lines).rows):  # what the command says
        assert {int(i) for i in row[3::3]} == {int(v[1]) for v in rows if v[0] == str(q)}, (about, q)
        assert (row[2] == 'c') == all(v[2] == 'certain' for v in rows if v[0] == str(q)) or not rows, (about, q)
    for said in (verified(folder, lines), verified(folder, lines, '--sphere', '--points', given[-1], *given[:-1], *options)):
        gaps = [l for l in said.stdout.splitlines() if l.startswith('not proved')]
        assert said.returncode in (0, 3) and all('the outcome' in l for l in gaps), (about, said)
    met['nearest', 'certain', kinds.count('c') == len(kinds), said.returncode] += 1
    assert not false_near(r, lines, 20), (about, false_near(r, lines, 20))
    for _ in range(8):
        what, forged = forge_near(r, lines)
        done = verified(folder, forged)
        assert done.returncode in (0, 1, 3), (about, what, done)
        met['nearest', 'forged', what, done.returncode] += forged != lines
        if done.returncode != 1 and 'do not list them' not in done.stdout:
            found = false_near(r, forged, 60)
            assert not found, (about, what, forged, found)


def main():
    r, met = random.Random(SEED), collections.Counter()
    print('seed', SEED)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        check_airports(folder)
        check_plane(folder)
        check_cells(folder)
        for k in range(COUNT):
            check_random(folder, r, k, met)
            if k % 3 == 0:
                check_nearest(folder, r, k, met)
    for what, count in sorted(met.items(), key=str):
        print(count, what)


if __name__ == '__main__':
    main()
