#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Rows of the Python package: bench_python.py PACKAGE [ROW ...] [--n POINTS] [--runs R] [--csv FILE]

Times are user time, medians of runs in turns; with --csv the columns of report.c. Peers are left out where they are not
installed."""
import argparse
import csv
import functools
import importlib.util
import itertools
import os
import platform
import re
import resource
import statistics
import subprocess
import sys


def user(function):
    begun = resource.getrusage(resource.RUSAGE_SELF).ru_utime
    function()
    return resource.getrusage(resource.RUSAGE_SELF).ru_utime - begun


def in_turns(runs, *functions):
    """The median of each, and all runs."""
    took = [[user(f) for f in functions] for _ in range(runs)]
    return [statistics.median(times) for times in zip(*took)]


def points_of(n, seed=1):
    return np.random.default_rng(seed).random((n, 2))


def row_cells(a, n=100_000):
    """Cells as arrays, against the rows that the command's voronoi writes, which have no polygons."""
    d = dyadel.delaunay(points_of(n))
    ours, rows = in_turns(a.runs, lambda: d.voronoi().certain, lambda: d._engine.write_voronoi('csv', None, None, None, 0, False))
    return {'n': n, 'ours': ours, 'peer': "the command's voronoi", 'theirs': rows, 'ratio_goal': 1.5}


def shapes_of_scipy(points):
    v = spatial.Voronoi(points)
    return [geometry.Polygon(v.vertices[v.regions[r]]) for r in v.point_region if v.regions[r] and -1 not in v.regions[r]]


def row_shapely(a, n=100_000):
    """From points to polygons of shapely."""
    points = points_of(n)
    ours, theirs = in_turns(a.runs, lambda: dyadel.delaunay(points).voronoi().certain.to_shapely(), lambda: shapes_of_scipy(points))
    return {'n': n, 'ours': ours, 'peer': 'scipy + shapely', 'theirs': theirs, 'ratio_goal': 0.5}


def row_tiles(a, n=100_000):
    """From points to polygons that cover the window: arrays, against the collection that GEOS makes."""
    points = points_of(n)
    ours, theirs = in_turns(a.runs, lambda: dyadel.delaunay(points).voronoi().tiles,
                            lambda: ops.voronoi_diagram(geometry.MultiPoint(points)))
    return {'n': n, 'ours': ours, 'peer': 'GEOS', 'theirs': theirs, 'ratio_goal': 0.5}


def row_nearest(a, n=1_000_000):
    """As many places as points."""
    d, places = dyadel.delaunay(points_of(n)), points_of(n, 2)
    found, = in_turns(a.runs, lambda: d.nearest(places))
    return {'n': n, 'ours': found, 'measure': 'us a place', 'figure': found / n * 1e6, 'figure_goal': 1}


def row_append(a, count, radius, n=1_000_000):
    """Points put into a result, and the run after them."""
    random = np.random.default_rng(3)
    d = dyadel.delaunay(points_of(n), radius=radius)
    took, = in_turns(2 * a.runs + 1, lambda: d.append(random.random((count, 2)), radius=radius))
    return {'n': n, 'ours': took, 'measure': 'ms', 'figure': 1e3 * took, 'figure_goal': 10 if count == 1 else 100}


def row_remeasure(a, n=1_000_000):
    points = points_of(n)
    d, todo = dyadel.delaunay(points, radius=1e-5), itertools.count(0, 7919)

    def once():
        i = next(todo) % n
        x, y = points[i]
        d.remeasure(i, (x - 5e-6, x + 5e-6, y - 5e-6, y + 5e-6))
    took, = in_turns(2 * a.runs + 1, once)
    return {'n': n, 'ours': took, 'measure': 'ms', 'figure': 1e3 * took, 'figure_goal': 10}


def peak_resident():
    with open('/proc/self/status', encoding='ascii') as file:
        return 1024 * next(int(line.split()[1]) for line in file if line.startswith('VmHWM'))


def row_memory(a, n=1_000_000):
    """Peak of the process with triangulation and cells, beyond the points."""
    points = points_of(n)
    with open('/proc/self/clear_refs', 'w', encoding='ascii') as file:
        file.write('5')  # the peak begins here
    before = peak_resident()
    took = user(lambda: dyadel.delaunay(points).voronoi().certain)
    peak = peak_resident() - before
    return {'n': n, 'ours': took, 'ours_bytes': peak, 'measure': 'MiB', 'figure': peak / 2**20, 'figure_goal': 1024}


ROWS = {'py-memory': row_memory, 'py-cells': row_cells, 'py-shapely': row_shapely, 'py-tiles': row_tiles, 'py-nearest': row_nearest,
        **{f'py-append-{count}{name}': functools.partial(row_append, count=count, radius=radius)
           for count in (1, 1000) for name, radius in (('', None), ('-boxes', 1e-7), ('-wide', 1e-5))},
        'py-remeasure': row_remeasure}


def machine():
    with open('/proc/cpuinfo', encoding='utf-8') as file:
        found = re.search(r'^model name\s*: (.*)', file.read(), re.M)
    return found[1] if found else platform.machine()


def report(out, name, r):
    n, ratio = r['n'], r['ours'] / r['theirs'] if 'theirs' in r else None
    words = [f'{name:20} {n:8} points {r["ours"]:9.4f} s']
    if ratio is not None:
        words.append(f'{ratio:.3f} of {r["peer"]} (goal {r["ratio_goal"]}{", NOT MET" * (ratio > r["ratio_goal"])})')
    if 'figure' in r:
        words.append(f'{r["figure"]:.4g} {r["measure"]} (goal {r["figure_goal"]}{", NOT MET" * (r["figure"] > r["figure_goal"])})')
    print(', '.join(words), flush=True)
    if out:
        commit = subprocess.run(['git', 'describe', '--always', '--dirty', '--exclude=*'], capture_output=True, text=True, check=False,
                                cwd=os.path.dirname(os.path.abspath(__file__))).stdout.strip()
        csv.writer(out, lineterminator='\n').writerow(
            [name, n, f'{1e9 * r["ours"] / n:.4g}', r.get('peer'), f'{1e9 * r["theirs"] / n:.4g}' if ratio is not None else None,
             ratio and f'{ratio:.4g}', r.get('ratio_goal'), r.get('ours_bytes', 0) // n or None, None, r.get('measure'),
             f'{r["figure"]:.4g}' if 'figure' in r else None, r.get('figure_goal'),
             f'Python {platform.python_version()}; numpy {np.__version__}', commit, machine()])


if __name__ == '__main__':
    parser = argparse.ArgumentParser()
    parser.add_argument('package')
    parser.add_argument('row', nargs='*')
    parser.add_argument('--n', type=int)
    parser.add_argument('--runs', type=int, default=3)
    parser.add_argument('--csv', type=argparse.FileType('a'))
    given = parser.parse_args()
    sys.path.insert(0, given.package)
    import numpy as np

    import dyadel
    peers = all(map(importlib.util.find_spec, ('scipy', 'shapely')))
    if peers:
        from scipy import spatial
        from shapely import geometry, ops
    for wanted in given.row or ROWS:
        if wanted not in ('py-shapely', 'py-tiles') or peers:
            report(given.csv, wanted, ROWS[wanted](given, **({'n': given.n} if given.n else {})))
