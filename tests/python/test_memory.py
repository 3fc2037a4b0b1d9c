#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Memory is flat over 100 runs of everything, failing runs included."""
import gc
import pickle
import sys

import harness
import numpy as np

import dyadel

RANDOM = np.random.default_rng(5)
POINTS = RANDOM.random((3000, 2))
MIXED = [('sqrt(2)', 1), (0.5, (1, 2)), ('[0,1]', '22/7'), (3, 'pi'), (5, 5)]


def fails(i, bits):
    if i == 2:
        raise ValueError
    return i, i


def once():
    d = dyadel.delaunay(POINTS, radius=1e-4)
    d.simplices, d.neighbors, d.legal, d.boxes, d.hull, d.aliases, d.rects(), d.bounds
    d.vertex_neighbors, d.points, d.find_triangle(POINTS[:50]), d.interpolate(POINTS[:, 0], POINTS[:50]), d.nearest(POINTS[:50])
    d.append(MIXED).nearest(0.5, 0.5)
    small = dyadel.delaunay(MIXED)
    v = small.voronoi()
    v.tiles, v.certain, v.possible, v.data, v.exact_area(4), list(v)
    harness.raised(dyadel.Error, dyadel.delaunay, [('1/0', 0)])
    small.write('json'), small.plan(), pickle.loads(pickle.dumps(small))
    dyadel.verify(small.certificate(), MIXED)
    dyadel.tolerance(POINTS[:50], radii=True)
    dyadel.converge(MIXED)
    dyadel.delaunay(dyadel.Source(5, lambda i, bits: (i, i * i)), progress=len)
    dyadel.check(dyadel.Source(4, lambda i, bits: (i, i * i)), schedules=1)
    for wrong in (dyadel.Source(5, fails), [(1, 2), ('x', 3)], np.array([[np.nan, 0]])):
        harness.raised(ValueError, dyadel.delaunay, wrong)


def test_bound():
    """A request for too much memory is refused before it is allocated, with its purpose; a result stays, and can be
    refined on."""
    error = harness.raised(MemoryError, dyadel.delaunay, POINTS, max_bytes=100000)
    assert 'max_bytes' in str(error) and 'the triangulation' in str(error), error
    d = dyadel.delaunay(POINTS, max_bytes=10**8)
    before = d.legal.tolist()
    harness.raised(MemoryError, d.append, POINTS + 2, max_bytes=100000)
    assert 'the polygons of the cells' in str(harness.raised(MemoryError, dyadel.delaunay(POINTS, max_bytes=500000).voronoi))
    assert d.refine(max_bytes=10**8).outcome == 'decided' and len(d.legal) > len(before)


def resident():
    gc.collect()
    with open('/proc/self/statm', encoding='ascii') as file:
        return int(file.read().split()[1]) * 4096


def test_flat():
    for _ in range(100):
        once()
    before, blocks = resident(), sys.getallocatedblocks()
    for _ in range(100):
        once()
    grown, more = resident() - before, sys.getallocatedblocks() - blocks
    print(f'{grown} bytes, {more} blocks of Python after 100 runs')
    assert grown < 2_000_000 and more < 500


harness.run_all(globals())
