# SPDX-License-Identifier: LGPL-3.0-or-later
"""Choices inside regions: corners, places that touch, random ones, and ones moved towards breaking one statement.

The climb compares margins in doubles; it only proposes. What a choice refutes is decided by the oracle, exactly."""
import fractions
import math

import oracle

Q = fractions.Fraction
TURNS = [(Q(1 - t * t) / (1 + t * t), Q(2 * t) / (1 + t * t)) for t in (Q(0), Q(1, 4), Q(1, 2), Q(3, 4), Q(1), Q(2), Q(5))]
TURNS = [(s * x, u * y) for x, y in TURNS for s in (1, -1) for u in (1, -1)]


def mixed(rand, a, b):
    k = rand.choice((3, 10, 30))
    return a + (b - a) * Q(rand.randint(0, 2 ** k), 2 ** k)


def double(q):
    """About q; distances beyond doubles, or with squares beyond doubles, become 2^400."""
    return float(max(Q(-2 ** 400), min(Q(2 ** 400), q)))


def extremes(region, rand):
    """Places of a region that a statement may hang on."""
    kind = region[0]
    if kind == 'disc':
        _, x, y, r = region
        return [(x, y)] if r == 0 else [(x, y), *((x + r * c, y + r * s) for c, s in TURNS)]
    if kind == 'cap':
        _, lon, lat, a = region
        return [(lon, lat)] if a == 0 else [(lon, lat), *((lon, lat, a, Q(k, 12)) for k in range(12))]
    _, xlo, xhi, ylo, yhi = region
    if kind == 'degrees':
        ylo, yhi = max(ylo, Q(-90)), min(yhi, Q(90))
    if (xlo, ylo) == (xhi, yhi):
        return [(xlo, ylo)]
    xm, ym = (xlo + xhi) / 2, (ylo + yhi) / 2
    return list(dict.fromkeys([(xm, ym), (xlo, ylo), (xlo, yhi), (xhi, ylo), (xhi, yhi), (xm, ylo), (xm, yhi), (xlo, ym),
                               (xhi, ym)]))


def anywhere(region, rand):
    kind = region[0]
    if kind == 'disc':
        _, x, y, r = region
        c, s = rand.choice(TURNS)
        f = mixed(rand, Q(0), r)
        return x + f * c, y + f * s
    if kind == 'cap':
        _, lon, lat, a = region
        return (lon, lat) if a == 0 else (lon, lat, mixed(rand, Q(0), a), mixed(rand, Q(0), Q(1)))
    _, xlo, xhi, ylo, yhi = region
    if kind == 'degrees':
        ylo, yhi = max(ylo, Q(-90)), min(yhi, Q(90))
    return mixed(rand, xlo, xhi), mixed(rand, ylo, yhi)


def nearest_in(region, at):
    """The place of a region next to another one (of boxes), or one towards it."""
    kind = region[0]
    if kind == 'disc':
        _, x, y, r = region
        dx, dy = at[0] - x, at[1] - y
        return min(extremes(region, None), key=lambda p: oracle.far2(p, at)) if dx * dx + dy * dy > r * r else at[:2]
    if kind == 'cap':
        return region[1:3]
    _, xlo, xhi, ylo, yhi = region
    if kind == 'degrees':
        ylo, yhi = max(ylo, Q(-90)), min(yhi, Q(90))
    return max(xlo, min(xhi, at[0])), max(ylo, min(yhi, at[1]))


def choices(regions, rand, count):
    """The middle, then random choices, some of them touching."""
    spots = [extremes(r, rand) for r in regions]
    yield [s[0] for s in spots]
    if all(len(s) == 1 for s in spots):
        return
    for k in range(count - 1):
        style = k % 4
        p = [rand.choice(s) if style in (0, 2) or rand.random() < 0.3 else anywhere(r, rand) for s, r in zip(spots, regions)]
        if style == 2:  # one point goes to another one, as near as it can
            a, b = rand.randrange(len(p)), rand.randrange(len(p))
            p[a] = nearest_in(regions[a], p[b])
        yield p


# ---- the climb ----

def flat_margin(p, i, j, sites):
    """How much room on their bisector the pair has: an angle, below 0 where there is none."""
    xi, yi = p[i]
    dx, dy = p[j][0] - xi, p[j][1] - yi
    lo, hi = -math.inf, math.inf
    for k in sites:
        if k == i or k == j:
            continue
        ux, uy = p[k][0] - xi, p[k][1] - yi
        a, b = uy * dx - ux * dy, ux * (ux - dx) + uy * (uy - dy)
        if a > 0:
            hi = min(hi, b / a)
        elif a < 0:
            lo = max(lo, b / a)
        elif b < 0:
            return -4.0
    return math.atan(hi) - math.atan(lo)


def globe_margin(v, i, j, sites):
    """The half-planes through the pair: the largest gap between the others, less half a turn."""
    a, b = v[i], v[j]
    e = (b[0] - a[0], b[1] - a[1], b[2] - a[2])
    m = (a[0] + b[0], a[1] + b[1], a[2] + b[2])
    f = (e[1] * m[2] - e[2] * m[1], e[2] * m[0] - e[0] * m[2], e[0] * m[1] - e[1] * m[0])
    sm, sf = math.hypot(*m) or 1.0, math.hypot(*f) or 1.0
    at = []
    for k in sites:
        if k == i or k == j:
            continue
        u = (v[k][0] - a[0], v[k][1] - a[1], v[k][2] - a[2])
        at.append(math.atan2(sum(x * y for x, y in zip(u, f)) / sf, sum(x * y for x, y in zip(u, m)) / sm))
    if len(at) < 2:
        return 4.0
    at.sort()
    return max([y - x for x, y in zip(at, at[1:])] + [at[0] + 2 * math.pi - at[-1]]) - math.pi


def climb(regions, sites, i, j, up, rand, globe):
    """A choice for which the pair is an edge by as much as can be found (up), or no edge."""
    spots = {k: extremes(regions[k], rand) + ([anywhere(regions[k], rand) for _ in range(3)] if len(
        extremes(regions[k], rand)) > 1 else []) for k in sites}
    if globe:
        at = {k: [oracle.Sphere.double(p) for p in s] for k, s in spots.items()}
        margin = globe_margin
    else:
        x0, y0 = spots[i][0]
        scale = max([abs(c - o) for s in spots.values() for p in s for c, o in zip(p, (x0, y0))] + [Q(1, 2 ** 1050)]) or 1
        at = {k: [(double((p[0] - x0) / scale), double((p[1] - y0) / scale)) for p in s] for k, s in spots.items()}
        margin = flat_margin
    sign = 1 if up else -1
    pick = {k: rand.randrange(len(s)) for k, s in spots.items()}
    now = {k: at[k][pick[k]] for k in sites}
    best = sign * margin(now, i, j, sites)
    moving = [k for k in sites if len(spots[k]) > 1]
    for _ in range(2):
        before = best
        for k in moving:
            for m, place in enumerate(at[k]):
                old, now[k] = now[k], place
                got = sign * margin(now, i, j, sites)
                if got > best:
                    best, pick[k] = got, m
                else:
                    now[k] = old
        if best == before:
            break
    return [spots[k][pick[k]] if k in spots else extremes(regions[k], rand)[0] for k in range(len(regions))]


# ---- witnesses ----

def witness(regions, i, j, sites):
    """A centre whose disc holds i and j and meets no other region, if a search in doubles finds one that is true."""
    mid = {k: ((r[1] + r[2]) / 2, (r[3] + r[4]) / 2) if r[0] == 'box' else r[1:3] for k, r in regions.items()}
    x0, y0 = mid[i]
    scale = max([abs(c - o) for k in sites for c, o in zip(mid[k], (x0, y0))] + [Q(1, 2 ** 1050)])
    boxes = {}
    for k in sites:
        r = regions[k]
        boxes[k] = ('b', *(double((c - o) / scale) for c, o in zip(r[1:], (x0, x0, y0, y0)))) if r[0] == 'box' else \
            ('d', double((r[1] - x0) / scale), double((r[2] - y0) / scale), double(r[3] / scale))

    def room(cx, cy):
        far, near = 0.0, math.inf
        for k in sites:
            b = boxes[k]
            if b[0] == 'b':
                if k == i or k == j:
                    far = max(far, math.hypot(max(cx - b[1], b[2] - cx), max(cy - b[3], b[4] - cy)))
                else:
                    near = min(near, math.hypot(max(b[1] - cx, 0, cx - b[2]), max(b[3] - cy, 0, cy - b[4])))
            else:
                d = math.hypot(cx - b[1], cy - b[2])
                if k == i or k == j:
                    far = max(far, d + b[3])
                else:
                    near = min(near, d - b[3])
        return near - far
    ax, ay = (double((c - o) / scale) for c, o in zip(mid[i], (x0, y0)))
    bx, by = (double((c - o) / scale) for c, o in zip(mid[j], (x0, y0)))
    nx, ny = ay - by, bx - ax
    starts = [0.0] + [s * 2.0 ** e for e in range(-6, 14, 2) for s in (1, -1)]
    c = max((((ax + bx) / 2 + t * nx, (ay + by) / 2 + t * ny) for t in starts), key=lambda q: room(*q))
    best, step = room(*c), 0.25 * (math.hypot(c[0], c[1]) + math.hypot(nx, ny))
    for _ in range(400):
        if step < 1e-14:
            break
        for dx, dy in ((1, 0), (-1, 0), (0, 1), (0, -1), (nx, ny), (-nx, -ny)):
            q = c[0] + step * dx, c[1] + step * dy
            got = room(*q)
            if got > best:
                best, c = got, q
                break
        else:
            step /= 2
    if best <= 0:
        return None
    centre = x0 + Q(c[0]) * scale, y0 + Q(c[1]) * scale
    return centre if oracle.witness_holds(regions, i, j, centre, sites) else None
