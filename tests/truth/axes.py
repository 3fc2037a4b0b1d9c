# SPDX-License-Identifier: LGPL-3.0-or-later
"""The product as tables: each value of an axis is a row with a function.

A case is built in this order: the shape gives places, the kind of uncertainty gives each place a region and its text,
the form writes them down. A region is ('box', xlo, xhi, ylo, yhi), ('disc', x, y, r), ('degrees', lonlo, lonhi, latlo,
lathi) or ('cap', lon, lat, angle); all numbers are fractions, the angle is in radians.
"""
import dataclasses
import fractions
import gzip
import math
import random
import re

import mpmath

Q = fractions.Fraction
EARTH = Q('6371008.8')


def decimal(q):
    """A finite decimal for a fraction, m*2^e or p/q where there is no short one."""
    d, tens = q.denominator, 0
    while d % 2 == 0 or d % 5 == 0:
        d //= 2 if d % 2 == 0 else 5
        tens += 1
    if d == 1 and tens <= 40:
        places = next(k for k in range(tens + 1) if 10 ** k % q.denominator == 0)
        digits = str(abs(q.numerator) * (10 ** places // q.denominator)).rjust(places + 1, '0')
        text = digits[:-places] + '.' + digits[-places:] if places else digits
        return ('-' if q < 0 else '') + text
    if q.denominator & (q.denominator - 1) == 0:
        return f'{q.numerator}*2^-{q.denominator.bit_length() - 1}'
    return f'{q.numerator}/{q.denominator}'


@dataclasses.dataclass
class Site:
    place: tuple   # nominal, fractions
    region: tuple = None
    text: tuple = None      # of x and y
    columns: tuple = ()     # further cells of its row
    call: tuple = None      # for Python: x and y
    name: str = None        # of the point that several rows give; None: its own


@dataclasses.dataclass
class Case:
    row: dict
    seed: int
    sites: list
    unit: Q                # about the distance between neighbours
    args: list = dataclasses.field(default_factory=list)
    names: tuple = ()      # of the further columns
    exact: bool = False    # each region is one point, and the command can know it
    true: list = None      # the points that the places turn out to be (reals), near enough; None: any choice
    radius: object = None  # for Python
    dropped: tuple = ()

    def __getattr__(self, name):
        if name in self.__dict__.get('row', {}):
            return self.row[name]
        raise AttributeError(name)


# ---- shapes: places ----

def grid(rand, span, digits):
    return Q(rand.randint(-span, span), 10 ** digits)


def plane_uniform(rand, n):
    digits = rand.choice((0, 1, 3))
    return [(grid(rand, 1000, digits), grid(rand, 1000, digits)) for _ in range(n)], Q(500, 10 ** digits)


def plane_clusters(rand, n):
    at = [(grid(rand, 100, 0), grid(rand, 100, 0)) for _ in range(2)]
    return [tuple(c + grid(rand, 100, 2) for c in rand.choice(at)) for _ in range(n)], Q(1)


def plane_lattice(rand, n):
    side, step = rand.choice((2, 3, 4)), rand.choice((Q(1), Q(1, 10), Q(3, 100)))
    return [(step * rand.randint(0, side), step * rand.randint(0, side)) for _ in range(n)], step


def plane_line(rand, n):
    a, b, c, d = (rand.randint(-3, 3) for _ in range(4))
    off = rand.randrange(n + 1) if n else 0
    out = []
    for k in range(n):
        t = rand.randint(-9, 9)
        out.append((Q(a * t + c), Q(b * t + d + (k == off))))
    return out, Q(2)


def circle_points(radius):
    """Places with whole coordinates on a circle about 0."""
    out = []
    for x in range(-radius, radius + 1):
        y = math.isqrt(radius * radius - x * x)
        if x * x + y * y == radius * radius:
            out += {(x, y), (x, -y)}
    return out


CIRCLE = circle_points(65)


def plane_circle(rand, n):
    s = rand.choice((Q(1), Q(1, 10)))
    near = rand.choice((Q(0), Q(1), Q(1, 10 ** 3), Q(1, 10 ** 9)))
    return [(s * (x + near * rand.randint(-1, 1)), s * (y + near * rand.randint(-1, 1)))
            for x, y in (rand.choice(CIRCLE) for _ in range(n))], 20 * s


def plane_arc(rand, n):
    """A short arc near one circle."""
    digits = rand.choice((6, 12, 20))
    step = rand.choice((10, 100, 1000))
    return [(Q(round(math.cos(k / step) * 10 ** 12), 10 ** 12) + grid(rand, 99, digits),
             Q(round(math.sin(k / step) * 10 ** 12), 10 ** 12) + grid(rand, 99, digits)) for k in range(n)], Q(1, step)


def plane_duplicates(rand, n):
    places, unit = plane_uniform(rand, max(1, n - 2)) if n else ([], Q(1))
    return [*places, *(rand.choice(places) for _ in range(n - len(places)))], unit


def plane_offset(rand, n):
    x, y = (rand.choice((-1, 1)) * Q(10) ** rand.randint(6, 12) for _ in range(2))
    fine = rand.randint(3, 9)
    return [(x + grid(rand, 50, fine), y + grid(rand, 50, fine)) for _ in range(n)], Q(20, 10 ** fine)


def plane_tiny(rand, n):
    e = Q(1, 2 ** rand.choice((1000, 500, 80)))
    return [(e * rand.randint(-99, 99), e * rand.randint(-99, 99)) for _ in range(n)], 50 * e


def plane_huge(rand, n):
    e = Q(2) ** rand.choice((1000, 500, 80))
    return [(e * rand.randint(-99, 99), e * rand.randint(-99, 99)) for _ in range(n)], 50 * e


def plane_scales(rand, n):
    """Exponents far apart."""
    most = rand.choice((30, 200, 1000))
    return [tuple(rand.choice((-1, 1)) * Q(2) ** rand.randint(-most, most) * rand.randint(1, 9) for _ in range(2))
            for _ in range(n)], Q(2) ** -most


def plane_few(rand, n):
    return rand.choice((plane_uniform, plane_lattice))(rand, rand.randint(1, 4))


def plane_far(rand, n):
    """Near one line: centres of circles are far away."""
    e = Q(1, 10 ** rand.randint(2, 9))
    return [(Q(rand.randint(-99, 99)), e * rand.randint(-9, 9)) for _ in range(n)], Q(10)


def lonlat(lon, lat):
    return Q(lon), max(Q(-90), min(Q(90), Q(lat)))


def globe_uniform(rand, n):
    d = rand.choice((0, 1, 4))
    return [lonlat(grid(rand, 180 * 10 ** d, d), Q(round(math.degrees(math.asin(rand.uniform(-1, 1))) * 10 ** d),
                                                10 ** d)) for _ in range(n)], Q(40)


def globe_clusters(rand, n):
    at = [(rand.randint(-180, 180), rand.randint(-85, 85)) for _ in range(2)]
    out = []
    for _ in range(n):
        lon, lat = rand.choice(at)
        out.append(lonlat(lon + grid(rand, 100, 2), lat + grid(rand, 100, 2)))
    return out, Q(1)


def globe_lattice(rand, n):
    step = rand.choice((30, 45, 10))
    return [lonlat(step * rand.randint(-3, 3), step * rand.randint(-1, 1)) for _ in range(n)], Q(step)


def globe_line(rand, n):
    """On a meridian circle, or on the equator, one perhaps off it."""
    lon, equator = rand.randint(-180, 180), rand.random() < 0.5
    out = [lonlat(rand.randint(-180, 180), 0) if equator else
           lonlat(rand.choice((lon, lon + 180)), rand.randint(-90, 90)) for _ in range(n)]
    return ([lonlat(out[0][0] + 7, out[0][1] + 11), *out[1:]] if out and rand.random() < 0.5 else out), Q(20)


def globe_circle(rand, n):
    """On one parallel, or near it."""
    lat, near = rand.randint(-80, 80), rand.choice((Q(0), Q(1, 1000), Q(1, 10 ** 8)))
    return [lonlat(rand.randint(-180, 180), lat + near * rand.randint(-9, 9)) for _ in range(n)], Q(20)


def globe_arc(rand, n):
    """A short arc near one circle, by its places about a centre."""
    lon, lat = rand.randint(-180, 180), rand.randint(-60, 60)
    return [lonlat(lon + Q(round(math.cos(k / 10) * 10 ** 8), 10 ** 8) / Q(round(math.cos(math.radians(lat)) * 1000), 1000),
                   lat + Q(round(math.sin(k / 10) * 10 ** 8), 10 ** 8)) for k in range(n)], Q(1, 10)


def globe_duplicates(rand, n):
    places, unit = globe_uniform(rand, max(1, n - 2)) if n else ([], Q(1))
    return [*places, *((p[0] + 360 * rand.randint(-1, 1), p[1])
                       for p in (rand.choice(places) for _ in range(n - len(places))))], unit


def globe_offset(rand, n):
    lon, lat = rand.randint(-180, 180), rand.randint(-85, 85)
    fine = rand.randint(4, 9)
    return [lonlat(lon + grid(rand, 50, fine), lat + grid(rand, 50, fine)) for _ in range(n)], Q(20, 10 ** fine)


def globe_poles(rand, n):
    s = rand.choice((-1, 1))
    return [lonlat(rand.randint(-180, 180), s * (90 - rand.choice((0, 1, 1, 2, 5)) * Q(1, rand.choice((1, 100)))))
            for _ in range(n)], Q(1)


def globe_dateline(rand, n):
    return [lonlat(rand.choice((180, -180)) + rand.randint(-9, 9), rand.randint(-40, 40)) for _ in range(n)], Q(5)


def globe_few(rand, n):
    return rand.choice((globe_uniform, globe_lattice))(rand, rand.randint(1, 4))


SHAPES = {  # name: in the plane, on the sphere
    'uniform': (plane_uniform, globe_uniform), 'clusters': (plane_clusters, globe_clusters),
    'lattice': (plane_lattice, globe_lattice), 'line': (plane_line, globe_line),
    'circle': (plane_circle, globe_circle), 'arc': (plane_arc, globe_arc),
    'duplicates': (plane_duplicates, globe_duplicates), 'offset': (plane_offset, globe_offset),
    'few': (plane_few, globe_few), 'tiny': (plane_tiny, None), 'huge': (plane_huge, None),
    'scales': (plane_scales, None), 'far': (plane_far, None), 'poles': (None, globe_poles),
    'dateline': (None, globe_dateline)}


# ---- kinds of uncertainty: regions and texts ----

def size(case, rand):
    """A radius that leaves pairs open, and many closed: a decimal, or a power of two of the unit."""
    most = rand.choice((Q(1, 100), Q(1, 20), Q(1, 5), Q(1, 2), Q(1)))
    r = case.unit * most * Q(rand.randint(1, 8), 8)
    if case.unit > Q(10) ** 9 or case.unit < Q(1, 10 ** 12):
        return r
    digits = max(0, 3 - math.floor(math.log10(r)))
    return max(Q(math.floor(r * 10 ** digits)), Q(1)) / 10 ** digits


def around(site, rx, ry, geometry):
    x, y = site.place
    if geometry == 'discs':
        return ('disc', x, y, rx)
    return ('degrees' if geometry == 'sphere' else 'box', x - rx, x + rx, y - ry, y + ry)


def plain(case):
    for s in case.sites:
        s.text = decimal(s.place[0]), decimal(s.place[1])
        s.region = around(s, Q(0), Q(0), case.geometry)


def kind_exact(case, rand):
    plain(case)
    case.exact = True
    if rand.random() < 0.3:  # other ways to write the same number
        for s in case.sites:
            s.text = tuple(rand.choice((t, f'{c.numerator}/{c.denominator}', f'[{t},{t}]'))
                           for c, t in zip(s.place, s.text))


def sexagesimal(q, rand, letters):
    """Degrees, minutes and seconds; the decimal where there are no short ones, or an expression."""
    n = q.denominator
    for p in (2, 3, 5):
        while n % p == 0:
            n //= p
    if n != 1 or len(str(q.denominator)) > 12 or abs(q) > 10 ** 9:
        return decimal(q)
    d, m, s = math.floor(abs(q)), math.floor(abs(q) * 60) % 60, abs(q) * 3600 % 60
    s = decimal(s)
    if not re.fullmatch(r'[\d.]+', s):
        return decimal(q)
    m, s = (str(m).rjust(2, '0'), s if '.' in s else s.rjust(2, '0'))
    sign, letter = ('-', '') if q < 0 else (rand.choice(('', '+')), '')
    if letters and abs(q) <= 90 and rand.random() < 0.7:
        sign, letter = '', letters[q < 0]
    text = rand.choice((f'{d}°{m}\'{s}"', f'{d}º{m}′{s}″', f'{d}:{m}:{s}', f"{d}d{m}'{s}''"))
    if letter and rand.random() < 0.3:
        return f'{letter}{text}'
    return f'{sign}{text}{letter}'


def kind_degrees(case, rand):
    plain(case)
    case.exact = True
    for s in case.sites:
        s.text = tuple(sexagesimal(c, rand, letters if case.geometry == 'sphere' else '')
                       for c, letters in zip(s.place, ('EW', 'NS')))


def kind_interval(case, rand):
    """Of some cases all ends are on one grid, so that rectangles share them."""
    plain(case)
    step = rand.choice((None, None, Q(case.unit / 5), Q(case.unit / 6)))
    for s in case.sites:
        if rand.random() < 0.25:
            continue
        ends = []
        for c in s.place:
            a, b = (size(case, rand) if step is None else 2 * rand.randint(0, 3) * step for _ in 'ab')
            ends.append((c - a / 2, c + b / 2) if rand.random() < 0.8 else (c, c))
        if case.geometry == 'sphere':
            ends[1] = max(ends[1][0], Q(-90)), min(ends[1][1], Q(90))
        s.region = ('degrees' if case.geometry == 'sphere' else 'box', *ends[0], *ends[1])
        s.text = tuple(decimal(a) if a == b else f'[{decimal(a)},{decimal(b)}]' for a, b in ends)


def kind_plusminus(case, rand):
    plain(case)
    for s in case.sites:
        r = size(case, rand), size(case, rand)
        if case.geometry == 'sphere' and abs(s.place[1]) + r[1] > 90:
            r = r[0], Q(0)
        s.region = around(s, *r, case.geometry)
        sign = rand.choice(('+-', '±'))
        s.text = tuple(f'{t}{sign}{decimal(q)}' for t, q in zip(s.text, r))


def kind_radius(case, rand):
    plain(case)
    r = size(case, rand)
    for s in case.sites:
        s.region = around(s, r, r, case.geometry)
    case.args += ['--radius', decimal(r)]
    case.radius = decimal(r)


def cap(site, metres):
    """A little less than the radius, so that each drawn place is surely within it."""
    return ('cap', *site.place, metres / EARTH * (1 - Q(1, 2 ** 60)))


def unit_radius(unit):
    def kind(case, rand):
        plain(case)
        r = size_in(case, rand, unit)
        for s in case.sites:
            s.region = region_of_unit(s, r, unit)
        case.args += ['--radius', decimal(r) + unit]
        case.radius = decimal(r) + unit
    return kind


UNITS = {'deg': ('deg', None, Q(1)), 'm': ('m', Q(1), None), 'km': ('km', Q(1000), None),
         'cm': ('cm', Q(1, 100), None), 'mm': ('mm', Q(1, 1000), None), 'ft': ('ft', Q(3048, 10000), None),
         'in': ('in', Q(254, 10000), None), 'arcmin': ('arcmin', None, Q(1, 60)), 'arcsec': ('arcsec', None, Q(1, 3600))}


def kind_column(case, rand):
    plain(case)
    case.names = ('r',)
    case.args += ['--radius-column', 'r']
    case.radius = []
    for s in case.sites:
        r = size(case, rand) if rand.random() < 0.8 else Q(0)
        s.columns = (decimal(r),)
        s.region = around(s, r, r, case.geometry)
        case.radius.append(decimal(r))


def kind_columns(case, rand):
    plain(case)
    case.names = ('rx', 'ry')
    case.args += ['--radius-column', 'rx,ry']
    case.radius = []
    for s in case.sites:
        r = tuple(size(case, rand) if rand.random() < 0.8 else Q(0) for _ in 'xy')
        s.columns = tuple(map(decimal, r))
        s.region = around(s, *r, case.geometry)
        case.radius.append([float(c) for c in r])


def kind_column_units(case, rand):
    """Cells of one column with units, mixed."""
    plain(case)
    case.names = ('r',)
    case.args += ['--radius-column', 'r']
    for s in case.sites:
        unit = rand.choice(list(UNITS))
        r = size_in(case, rand, unit)
        s.columns, s.region = (decimal(r) + unit,), region_of_unit(s, r, unit)


def region_of_unit(site, number, unit):
    """The region of a radius in a unit, on the sphere."""
    _, metres, degrees = UNITS[unit]
    return cap(site, number * metres) if metres else around(site, number * degrees, number * degrees, 'sphere')


def size_in(case, rand, unit):
    """A radius as a number of these units."""
    _, metres, degrees = UNITS[unit]
    r = size(case, rand)
    return Q(math.ceil(r * Q(111195) / metres * 100), 100) if metres else r / degrees


def kind_unit_option(case, rand):
    """The unit in an option of its own, of --radius or of a column; or in the name of the column."""
    plain(case)
    unit = rand.choice(list(UNITS))
    way = rand.choice(('radius', 'column', 'name'))
    if case.form not in TABLES:
        way = 'radius'
    if case.form == 'headless' and way == 'name':
        way = 'column'
    if way == 'radius':
        r = size_in(case, rand, unit)
        case.args += ['--radius', decimal(r), '--radius-unit', unit]
        for s in case.sites:
            s.region = region_of_unit(s, r, unit)
        return
    named = rand.choice((f'r({unit})', f'r [{unit}]'))
    case.names = ('r' if way == 'column' else f'r({unit})' if case.form == 'blanks' else named,)
    case.args += ['--radius-column', case.names[0], *(['--radius-unit', unit] if way == 'column' else [])]
    for s in case.sites:
        r = size_in(case, rand, unit)
        s.columns, s.region = (decimal(r),), region_of_unit(s, r, unit)


def kind_scaled(case, rand):
    """A column and an option, both multiplied."""
    plain(case)
    k = rand.choice((Q(3), Q(1, 4), Q(2)))
    case.names = ('r',)
    case.args += ['--radius-column', 'r', '--radius-scale', decimal(k)]
    for s in case.sites:
        r = size(case, rand)
        s.columns, s.region = (decimal(r),), around(s, r * k, r * k, case.geometry)


def k_below(p, n):
    """Of sqrt(2 ln(n / (1 - p))), 25 places: each choice within it has to be one of the command's."""
    with mpmath.workprec(200):
        return Q(int(mpmath.floor(mpmath.sqrt(2 * mpmath.log(mpmath.mpf(n) * p.denominator / (p.denominator - p.numerator)))
                                  * 10 ** 25)), 10 ** 25) if n else Q(0)


def kind_sigma(case, rand):
    """Standard deviations and a probability: boxes or discs of k of them."""
    plain(case)
    text, p = rand.choice((('95%', Q(95, 100)), ('0.5', Q(1, 2)), ('99.9 %', Q(999, 1000)), ('1e-3', Q(1, 1000))))
    unit = rand.choice(list(UNITS)) if case.geometry == 'sphere' else None
    _, metres, degrees = UNITS.get(unit, (None, None, Q(1)))
    one = case.kind == 'sigma'
    case.names = ('s',) if one else ('sx', 'sy', 'rho')[:rand.choice((2, 3))]
    case.args += ['--sigma-column', ','.join(case.names), '--confidence', text, *(['--radius-unit', unit] if unit else [])]
    drawn = []
    for s in case.sites:
        sx, sy = (size_in(case, rand, unit) / 4 if unit else size(case, rand) / 4 for _ in 'xy')
        drawn.append((sx, sx if one else sy) if rand.random() < 0.8 else (Q(0), Q(0)))
    k = k_below(p, sum(a > 0 for a, _ in drawn))
    for s, (sx, sy) in zip(case.sites, drawn):
        rho = rand.choice((Q(0), Q(1, 2), Q(-9, 10), Q(1)))
        s.columns = tuple(map(decimal, (sx, sy, rho)[:len(case.names)]))
        round_ = max(sx, sy) if len(case.names) < 3 else longer_axis(sx, sy, rho)
        if metres:
            s.region = cap(s, k * round_ * metres)
        elif case.geometry == 'discs':
            s.region = around(s, k * round_, k * round_, case.geometry)
        else:
            s.region = around(s, k * sx * degrees, k * sy * degrees, case.geometry)


def longer_axis(sx, sy, rho):
    """Of the ellipse of one standard deviation, a little less."""
    with mpmath.workprec(200):
        a, b, c = (mpmath.mpf(q.numerator) / q.denominator for q in (sx * sx, sy * sy, rho * sx * sy))
        e = mpmath.sqrt((a + b) / 2 + mpmath.sqrt(((a - b) / 2) ** 2 + c * c)) * (1 - mpmath.mpf(2) ** -90)
        return Q(int(e.man)) * Q(2) ** int(e.exp)


def kind_columns_of_degrees(case, rand):
    """A column of longitudes and one of latitudes."""
    plain(case)
    case.names = ('rx', 'ry')
    case.args += ['--radius-column', 'rx,ry']
    for s in case.sites:
        unit = rand.choice(('deg', 'arcmin'))
        r = tuple(size_in(case, rand, unit) for _ in 'xy')
        s.columns = tuple(decimal(c) + unit for c in r)
        s.region = around(s, *(c * UNITS[unit][2] for c in r), 'sphere')


def kind_both(case, rand):
    """A radius and a column and intervals: the sum of all."""
    kind_interval(case, rand)
    r = size(case, rand) / 4
    case.names = ('r',)
    case.args += ['--radius', decimal(r), '--radius-column', 'r']
    for s in case.sites:
        q = size(case, rand) / 4
        s.columns = (decimal(q),)
        n, xlo, xhi, ylo, yhi = s.region
        s.region = n, xlo - r - q, xhi + r + q, ylo - r - q, yhi + r + q


def kind_measured(case, rand):
    case.args += ['--measured']
    digits = max(0, min(12, -math.floor(math.log10(case.unit)) + rand.randint(0, 2)))
    half = Q(1, 2 * 10 ** digits)
    for s in case.sites:
        s.place = tuple(Q(round(c * 10 ** digits), 10 ** digits) for c in s.place)
        if case.geometry == 'sphere':
            s.place = s.place[0], max(-90 + half, min(90 - half, s.place[1]))
            s.place = s.place[0], Q(math.trunc(s.place[1] * 10 ** digits), 10 ** digits)
        s.text = tuple(fixed(c, digits) for c in s.place)
        s.region = around(s, half, half, case.geometry)


def fixed(q, digits):
    n = abs(q.numerator) * 10 ** digits // q.denominator
    text = str(n).rjust(digits + 1, '0')
    return ('-' if q < 0 else '') + (text[:-digits] + '.' + text[-digits:] if digits else text)


def disguise(q, rand):
    """An expression whose value is q."""
    t, k = decimal(q), rand.randint(2, 9)
    p = f'{q.numerator}/{q.denominator}'
    return rand.choice((
        f'({p})+sqrt({k * k})-{k}', f'sqrt({k})*sqrt({k})*({p})/{k}', f'({p})*(sin({k})^2+cos({k})^2)',
        f'root(x^2-{k * k},0,{k + 1})-{k}+({p})', f'(sqrt({k})+1)*(sqrt({k})-1)*({p})/{k - 1}', t,
        f'min({p},{p})', f'abs({k})*({p})/{k}', f'({p})+pi-pi', f'cbrt({k ** 3})*({p})/{k}'))


def kind_disguised(case, rand):
    plain(case)
    case.exact = True
    for s in case.sites:
        s.text = tuple(disguise(c, rand) for c in s.place)


REALS = (('sqrt({})', lambda m, k: m.sqrt(k)), ('exp({}/20)', lambda m, k: m.exp(m.mpf(k) / 20)),
         ('log({}+1)', lambda m, k: m.log(k + 1)), ('cbrt({})', lambda m, k: m.cbrt(k)), ('sin({})', lambda m, k: m.sin(k)),
         ('cos({})', lambda m, k: m.cos(k)), ('pi*{}', lambda m, k: m.pi * k), ('e*{}', lambda m, k: m.e * k),
         ('atan({})', lambda m, k: m.atan(k)), ('sqrt({}+sqrt(2))', lambda m, k: m.sqrt(k + m.sqrt(2))))


def real(rand):
    """A computable real as text, and its value to 6000 bits: finer than any interval requested."""
    form, value = rand.choice(REALS)
    k = rand.randint(2, 30)
    with mpmath.workprec(6000):
        v = mpmath.mpf(value(mpmath, k))
        return form.format(k), (-1 if v < 0 else 1) * abs(Q(int(v.man))) * Q(2) ** int(v.exp)


def kind_real(case, rand):
    """Each coordinate plus a small computable real."""
    plain(case)
    for s in case.sites:
        place, text = [], []
        for c, t in zip(s.place, s.text):
            f, v = real(rand)
            k = case.unit / 100 * rand.randint(0, 3)
            place.append(c + v * k)
            text.append(f'({t})+({f})*({k.numerator}/{k.denominator})' if k else t)
        if case.geometry == 'sphere' and abs(place[1]) > 90:
            place[1] = Q(89)
            text[1] = '89'
        s.text, s.place = tuple(text), tuple(place)
        s.region = around(s, Q(0), Q(0), case.geometry)
    case.true = [s.place for s in case.sites]


def kind_real_radius(case, rand):
    kind_real(case, rand)
    case.true = None
    r = size(case, rand)
    case.args += ['--radius', decimal(r)]
    for s in case.sites:
        s.region = around(s, r, r, case.geometry)


def kind_callback(case, rand):
    """Points of a function or a program, whose values are the places."""
    plain(case)
    case.true = [s.place for s in case.sites]


def kind_program_boxes(case, rand):
    """A program whose boxes end at a width, which it says."""
    kind_interval(case, rand)


TABLES = ('csv', 'semicolon', 'tab', 'bar', 'numbers', 'blanks', 'headless', 'units row', 'apart')
PYTHON = ('python', 'appended')  # all points at once; some of them later, in pieces
LIBRARY = (*PYTHON, 'capi', 'tiles')
TEXTS = ('text', 'comma', 'stdin', 'gzip', *TABLES)
KINDS = {  # name: function, geometries, forms
    'exact': (kind_exact, ('plane', 'sphere', 'discs'), TEXTS + LIBRARY),
    'degrees': (kind_degrees, ('plane', 'sphere'), TEXTS),
    'interval': (kind_interval, ('plane', 'sphere'), TEXTS + LIBRARY),
    'plusminus': (kind_plusminus, ('plane', 'sphere'), TEXTS + PYTHON),
    'radius': (kind_radius, ('plane', 'discs'), TEXTS + PYTHON),
    'column': (kind_column, ('plane', 'discs'), TABLES + PYTHON),
    'columns': (kind_columns, ('plane',), TABLES),
    'scaled column': (kind_scaled, ('plane', 'discs'), TABLES),
    'sigma': (kind_sigma, ('plane', 'sphere', 'discs'), TABLES),
    'sigmas': (kind_sigma, ('plane', 'sphere', 'discs'), TABLES),
    'columns of degrees': (kind_columns_of_degrees, ('sphere',), TABLES),
    'unit apart': (kind_unit_option, ('sphere',), TEXTS),
    'both': (kind_both, ('plane',), TABLES),
    'measured': (kind_measured, ('plane', 'sphere'), TEXTS),
    'disguised': (kind_disguised, ('plane', 'sphere', 'discs'), TEXTS + PYTHON),
    'real': (kind_real, ('plane', 'sphere', 'discs'), TEXTS + PYTHON),
    'real with radius': (kind_real_radius, ('plane', 'discs'), TEXTS),
    'callback': (kind_callback, ('plane', 'discs'), ('program', 'capi')),
    'boxes asked for': (kind_program_boxes, ('plane',), ('program',)),
    'column of units': (kind_column_units, ('sphere',), TABLES)}
for _unit in UNITS:
    KINDS['radius ' + _unit] = (unit_radius(_unit), ('sphere',), TEXTS + PYTHON)


# ---- forms of input ----

def lines(case, between=' '):
    return ''.join(between.join(s.text) + '\n' for s in case.sites)


def table(case, d, names=('x', 'y'), comma=False, change=lambda t: t):
    """A table: a name, x, y, and what else the points have; unused columns between them."""
    def cell(t):
        t = t.replace('.', ',') if comma and not set('([') & set(t) else t
        return change('"' + t.replace('"', '""') + '"' if d in t or ',' in t or '"' in t else t)
    out = d.join(('name', names[0], 'cost', names[1], *case.names)) + '\n'
    for k, s in enumerate(case.sites):
        out += d.join((s.name or f'p{k}', cell(s.text[0]), str(k * 7 % 5 + 1), cell(s.text[1]), *map(cell, s.columns))) + '\n'
    if case.extra == 'missing':
        out += d.join(('p', 'NA', '1', '-', *('0' for _ in case.names))) + '\n'
    if case.extra == 'missing word':
        out += d.join(('p', '-9999.0', '1', '7', *('0' for _ in case.names))) + '\n'
    return out


def form_text(case, put):
    return [put('points.txt', lines(case))]


def form_comma(case, put):
    return [put('points.txt', '# points\n\n' + lines(case, ','))]


def form_stdin(case, put):
    put(None, lines(case))
    return ['-']


def form_gzip(case, put):
    return [put('points.gz', gzip.compress(lines(case).encode(), mtime=0))]


def form_csv(case, put):
    return ['--columns', 'x,y', put('points.csv', table(case, ','))]


def form_semicolon(case, put):
    return ['--columns', 'x,y', '--decimal-comma', put('points.csv', table(case, ';', comma=True))]


def form_tab(case, put):
    return ['--columns', 'East,North', '--delimiter', 'tab', put('points.csv', table(case, '\t', ('East', 'North')))]


def form_bar(case, put):
    return ['--columns', 'x,y', '--delimiter', '|', '--id', 'name', put('points.csv', table(case, '|'))]


def form_numbers(case, put):
    return ['--columns', '2,4', put('points.csv', table(case, ','))]


def form_blanks(case, put):
    """Runs of blanks, comments, and a header that is one of them."""
    names, *body = table(case, '   ').splitlines(keepends=True)
    return ['--columns', 'x,y', '--delimiter', 'blank',
            put('points.txt', '%% written by hand\n%  ' + names + ''.join(l + '# between\n' for l in body))]


def form_headless(case, put):
    """No header: columns by their numbers, after skipped lines."""
    number = dict(zip(case.names, '56'))
    case.args = [','.join(number.get(n, n) for n in w.split(',')) for w in case.args]
    return ['--no-header', '--columns', '2,4', '--skip-lines', '2', put('points.csv', 'two\n' + table(case, ','))]


def form_units_row(case, put):
    """As a spreadsheet of another age writes: what separates, names, units, lines that end by CR."""
    names, *body = table(case, ';').splitlines()
    units = ['', 'deg', 'EUR', 'deg', *('' for _ in case.names)]
    return ['--columns', 'x,y', '--units-row', put('points.csv', '\r'.join(['sep=;', names, ';'.join(units), *body, '']))]


def form_apart(case, put):
    """Thousands are apart."""
    def apart(t):
        m = re.fullmatch(r'([-+]?)(\d{4,})(\..*)?', t)
        return m[1] + f'{int(m[2]):,}'.replace(',', "'") + (m[3] or '') if m and m[2][0] != '0' else t
    return ['--columns', 'x,y', '--thousands', "'", put('points.csv', table(case, ',', change=apart))]


def form_program(case, put):
    """The answers of a program: places as fractions, or boxes that stay."""
    boxes = (s.region[1:] if s.region[0] != 'disc' else (s.region[1], s.region[1], s.region[2], s.region[2]) for s in case.sites)
    text = ''.join(f'{a} {b} {c} {d}\n' for a, b, c, d in boxes)
    return ['--oracle', 'exec python3 ' + put.here('points.py') + ' ' + put('answers.txt', text),
            *([] if case.row['extra'] == 'retries' else ['--oracle-timeout', '600'])]


FORMS = {'text': form_text, 'comma': form_comma, 'stdin': form_stdin, 'gzip': form_gzip, 'csv': form_csv,
         'semicolon': form_semicolon, 'tab': form_tab, 'bar': form_bar, 'numbers': form_numbers,
         'blanks': form_blanks, 'headless': form_headless, 'units row': form_units_row, 'apart': form_apart,
         'program': form_program, **dict.fromkeys(LIBRARY)}

GEOMETRIES = {'plane': [], 'sphere': ['--sphere'], 'discs': ['--discs']}


# ---- options that change nothing but the fields given ----

@dataclasses.dataclass
class Extra:
    args: list
    fits: object = None         # the form or the kind that it needs
    softens: bool = False       # more pairs may be open
    check: str = None           # a further check (laws.py)


EXTRAS = {
    'none': Extra([]), 'threads 2': Extra(['--threads', '2']), 'threads 7': Extra(['--threads', '7']),
    'quiet': Extra(['--quiet']), 'stats': Extra(['--stats']), 'timeout': Extra(['--timeout', '100']),
    'uniform': Extra(['--schedule', 'uniform']), 'adaptive': Extra(['--schedule', 'adaptive']),
    'start': Extra(['--start-bits', '9']), 'step': Extra(['--step-bits', '40']),
    'few bits': Extra(['--max-bits', '48'], softens=True), 'few pairs': Extra(['--max-pairs', '2'], softens=True),
    'bytes': Extra(['--max-bytes', '1G']),
    'policy': Extra(['--policy', 'while read w a b c; do case $w in plan) p="$a $b";; choose) echo refine $p; echo go;; esac; done']),
    'ties off': Extra(['--ties', 'off'], softens=True), 'ties prove': Extra(['--ties', 'prove']),
    'tie bits': Extra(['--tie-bits', '64'], softens=True), 'area': Extra(['--until', 'area:4'], softens=True),
    'hausdorff': Extra(['--until', 'hausdorff:4'], softens=True), 'decided': Extra(['--until', 'decided']),
    'window': Extra(['--window=-1,1,-1,1']), 'crs': Extra(['--crs', 'EPSG:32632']),
    'accept fixpoint': Extra(['--accept-fixpoint']), 'plane': Extra(['--plane']),
    'id': Extra(['--id', 'name'], fits='table'), 'carry': Extra(['--carry', 'all'], fits='table'), 'length': Extra(['--length']), 'missing': Extra(['--skip-missing'], fits='table'),
    'missing word': Extra(['--skip-missing', '--missing=-9999'], fits='table'),
    'merge': Extra(['--merge'], softens=True),
    'merge by': Extra(['--id', 'name', '--merge-by', 'id'], fits='table', softens=True), 'cost': Extra(['--cost-column', 'cost'], fits='table'),
    'certificate': Extra(['--certificate', '@certificate'], check='certificate'),
    'trace': Extra(['--trace', '@trace'], check='resume'),
    'trace synced': Extra(['--trace', '@trace', '--trace-sync', '0.5']),
    'output': Extra(['-o', '@output'], check='output'),
    'flatten': Extra(['--flatten', '3']),
    'jobs': Extra(['--oracle-jobs', '2'], fits='program'), 'batch': Extra(['--oracle-batch', '4'], fits='program'),
    'retries': Extra(['--oracle-retries', '1', '--oracle-timeout', '30'], fits='program'),
    'box metric': Extra(['--metric', 'box']), 'euclid metric': Extra(['--metric', 'euclid']),
    'births': Extra(['--up-to', '@unit']), 'accuracy': Extra(['--accuracy', '@small'], softens=True),
    'site': Extra(['--site', '0']), 'next': Extra(['--next']),
    'hindsight': Extra(['--hindsight', '900']),
    'more digits': Extra(['--relative-bits', '33'])}
