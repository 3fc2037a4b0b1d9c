#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Rebuilds figures 2 to 6 of Khanban, Edalat, Lieutier (partial bisector, its pieces, partial disc, partial diagram).

Each figure is written as svg by the command; what the paper says of it is asserted on the exact csv of the same run,
and the picture is checked to be well-formed and to show as many parabolas, or dashed circles.

Usage: kel_figures.py COMMAND FOLDER
"""
import csv
import os
import subprocess
import sys
from fractions import Fraction

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, 'cli'))
import svg  # pylint: disable=wrong-import-position

COMMAND, FOLDER = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
NAME = {'line': 'bisector', 'parabola': 'parabola'}  # of the command, of the paper


def dyadel(what, points, *options):
    """Standard output; the exit status is 0 or 3 (fixed rectangles stay as they are)."""
    done = subprocess.run([COMMAND, what, '--quiet', *options, '-'], input=text(points).encode(), timeout=120,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False)
    assert done.returncode in (0, 3), (what, points, done)
    return done.stdout.decode()


def text(points):
    """Rectangles (xlo, xhi, ylo, yhi) as a points file."""
    return ''.join(f'[{a},{b}] [{c},{d}]\n' for a, b, c, d in points)


def rows(output):
    return list(csv.DictReader(line for line in output.splitlines() if not line.startswith('#')))


def picture(name, what, points, *options):
    """Writes the svg; its paths."""
    path = os.path.join(FOLDER, name + '.svg')
    dyadel(what, points, '--format', 'svg', '-o', path, *options)
    print('wrote', path)
    with open(path, encoding='utf-8') as f:
        return svg.paths(f.read())


def dashed_curves(paths):
    """Curved strokes drawn dashed (the legend has straight ones)."""
    return sum('stroke-dasharray' in p.look and any(c in p.look['d'] for c in 'CA') for p in paths)


def is_drawn(elements, table):
    """The picture shows as many parabolas as the table."""
    wanted = sum(r['kind'] == 'parabola' for r in table)
    assert dashed_curves(elements) == wanted, (dashed_curves(elements), table)


def curve(table, far):
    return [r for r in table if r['far'] == str(far)]


def check_pieces(table, points):
    """Section 3 of the paper: each curve is one chain of at most 7 pieces, from infinity to infinity; the far corner
    changes exactly where the curve crosses an axis of the far rectangle, the feature exactly at the other joints."""
    for far in (0, 1):
        chain, r = curve(table, far), points[far]
        centre = Fraction(r[0] + r[1]) / 2, Fraction(r[2] + r[3]) / 2
        assert 1 <= len(chain) <= 7, chain
        assert chain[0]['begin'] == chain[-1]['end'] == 'infinite'
        assert all(len(c['feature']) == (4 if c['kind'] == 'line' else 2) for c in chain), chain
        for a, b in zip(chain, chain[1:]):
            assert (a['end'], a['end_x'], a['end_y']) == (b['begin'], b['begin_x'], b['begin_y']), (a, b)
            assert a['end'] in ('axis', 'feature')
            assert (a['corner'] != b['corner']) == (a['end'] == 'axis'), (a, b)
            assert (a['feature'] != b['feature']) == (a['end'] == 'feature'), (a, b)
            if a['end'] == 'axis':
                assert any(a['end_' + k] == str(c) for k, c in zip('xy', centre)), (a, centre)


def figure_2():
    """Partial bisector of a rectangle and a point, and of two rectangles."""
    for name, points in (('figure2a', [(0, 2, 0, 1), (5, 5, 4, 4)]), ('figure2b', [(0, 2, 0, 1), (5, 7, 4, 5)])):
        table = rows(dyadel('bisector', points))
        check_pieces(table, points)
        is_drawn(picture(name, 'bisector', points), table)
        point = points[1][0] == points[1][1]
        # towards a point only lines; round a point no axis is crossed
        assert not point or all(r['kind'] == 'line' for r in curve(table, 0))
        assert not point or all('axis' not in (r['begin'], r['end']) for r in curve(table, 1))
        assert any(r['kind'] == 'parabola' for r in curve(table, 1))


def figure_3():
    """Pieces and axis switches of one curve: between switches of the far corner, pieces of one focus."""
    points = [(0, 4, 0, 2), (6, 9, 5, 7)]
    table = rows(dyadel('bisector', points))
    check_pieces(table, points)
    is_drawn(picture('figure3', 'bisector', points), table)
    chain = curve(table, 0)
    switches = [r['end_x'] == '2' for r in chain if r['end'] == 'axis']
    assert len(switches) == 2 and sorted(switches) == [False, True], chain  # one on each axis
    assert len({r['corner'] for r in chain}) == 3 and {r['kind'] for r in chain} == set(NAME)


def figure_4():
    """The generic pair: pieces in the order that the paper gives."""
    points = [(0, 1, 0, 2), (3, 5, 5, 6)]
    table = rows(dyadel('bisector', points))
    check_pieces(table, points)
    is_drawn(picture('figure4', 'bisector', points), table)
    order = [NAME[r['kind']] for r in curve(table, 0)]
    assert order == ['bisector', 'parabola', 'parabola', 'bisector', 'bisector', 'parabola', 'bisector'], order


def figure_5():
    """Partial disc of three rectangles: six critical circles, three of either kind; a fourth rectangle in each part."""
    three = [(0, 1, 0, '1/2'), (4, 6, 0, 2), (1, '5/2', 4, 5)]
    points = three + [(2, '5/2', 2, '5/2'), (8, 9, 5, 6), (-1, 0, 3, 4)]
    where = {r['i']: r['con'] for r in rows(dyadel('disc', points, '--layer', 'con'))}
    assert where == {'3': 'inside', '4': 'outside', '5': 'unknown'}
    assert [r['circle'] for r in rows(dyadel('disc', points))] == ['FCC', 'CFC', 'CCF', 'CFF', 'FCF', 'FFC']
    assert dashed_curves(picture('figure5', 'disc', points)) == 3  # the outer ones


def figure_6():
    """A small partial Delaunay triangulation and the partial Voronoi diagram of the same rectangles."""
    h = Fraction(1, 8)
    centres = [(0, 0), (4, -1), (7, 2), (6, 6), (2, 7), (-1, 4), (3, 3)]
    points = [(x - h, x + h, y - h, y + h) for x, y in centres]
    legal = {(r['i'], r['j']) for r in rows(dyadel('delaunay', points)) if r['status'] == 'legal'}
    assert {(str(i), '6') for i in range(6)} <= legal and len(legal) >= 12, legal  # a wheel
    cells = rows(dyadel('voronoi', points))
    assert len(cells) == 7 and all(0 < Fraction(r['area_lo']) < Fraction(r['area_hi']) for r in cells)
    assert len(rows(dyadel('voronoi', points, '--layer', 'vertices'))) == 6
    picture('figure6_delaunay', 'delaunay', points)
    picture('figure6_voronoi', 'voronoi', points)


def main():
    os.makedirs(FOLDER, exist_ok=True)
    for figure in (figure_2, figure_3, figure_4, figure_5, figure_6):
        figure()


main()
