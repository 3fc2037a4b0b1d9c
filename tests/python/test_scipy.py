#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Sets in general position against scipy.spatial.Delaunay: triangles, neighbours, hull. On integers the cases where scipy
and its rounding differ are none: each of its triangles is checked in integers first."""
import harness

harness.need('scipy')
import numpy as np
from scipy.interpolate import LinearNDInterpolator
from scipy.spatial import ConvexHull, Delaunay, cKDTree
from scipy.spatial import Voronoi as Diagram

import dyadel


def turned(triangles):
    """Each with its lowest number first."""
    lowest = np.argmin(triangles, axis=1)
    return np.array([np.roll(t, -k) for t, k in zip(triangles, lowest)]).reshape(-1, 3)


def edges(triangles):
    both = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    return np.unique(both, axis=0)


def beyond(triangles, neighbors):
    """{(triangle, corner): triangle beyond}, by corners."""
    names = [tuple(sorted(t)) for t in triangles.tolist()]
    return {(names[t], triangles[t, k]): names[n] if n >= 0 else None
            for t in range(len(names)) for k, n in enumerate(neighbors[t])}


def compare(points):
    ours, theirs = dyadel.delaunay(points), Delaunay(points)
    assert ours.outcome == 'decided' and len(ours.ties) == 0
    assert ours.simplices.dtype == ours.neighbors.dtype == np.int32
    a, b = (sorted(map(tuple, turned(d.simplices).tolist())) for d in (ours, theirs))
    assert a == b, (set(a) ^ set(b))
    assert beyond(ours.simplices, ours.neighbors) == beyond(theirs.simplices, theirs.neighbors)
    assert np.array_equal(ours.legal, edges(theirs.simplices))
    assert set(ours.hull[0]) == set(theirs.convex_hull.ravel()) == set(ours.hull[1])
    x, y = points[ours.simplices].transpose(2, 0, 1)
    assert ((x[:, 1] - x[:, 0]) * (y[:, 2] - y[:, 0]) > (x[:, 2] - x[:, 0]) * (y[:, 1] - y[:, 0])).all()


def compare_queries(points, random):
    ours, theirs = dyadel.delaunay(points), Delaunay(points)
    indptr, indices = ours.vertex_neighbors
    their_ptr, their_indices = theirs.vertex_neighbor_vertices
    assert np.array_equal(indptr, their_ptr)
    assert all(set(a) == set(b) for a, b in zip(np.split(indices, indptr[1:-1]), np.split(their_indices, their_ptr[1:-1])))
    ring = ConvexHull(points).vertices
    assert np.array_equal(ours.hull[0], np.roll(ring, -np.argmin(ring))) and np.array_equal(ours.points, points)
    places = points.mean(axis=0) + (random.random((500, 2)) - 0.5) * 1.5 * np.ptp(points, axis=0)
    a, b = ours.find_triangle(places), theirs.find_simplex(places)
    assert np.array_equal(a >= 0, b >= 0) and (a[a < 0] == dyadel.OUTSIDE).all()
    assert np.array_equal(np.sort(ours.simplices[a[a >= 0]]), np.sort(theirs.simplices[b[b >= 0]]))
    values = random.random(len(points))
    mine, want = ours.interpolate(values, places), LinearNDInterpolator(theirs, values)(places)
    assert np.array_equal(mine.mask, np.isnan(want)) and np.allclose(mine.data, want, rtol=1e-9, atol=1e-9, equal_nan=True)
    assert np.array_equal(ours.nearest(places).single, cKDTree(points).query(places)[1])


def test_queries():
    random = np.random.default_rng(harness.seeded('queries').randrange(2**32))
    for n in (4, 30, 400, 3000):
        compare_queries(random.random((n, 2)), random)


def test_random_sets():
    random = np.random.default_rng(harness.seeded('scipy').randrange(2**32))
    for k in range(200):
        n = int(random.integers(4, 400))
        points = random.random((n, 2)) if k % 2 else random.normal(size=(n, 2)) * 2.0 ** random.integers(-20, 20)
        compare(points)


def shoelace(ring):
    x, y = (ring - ring[0]).T
    return abs(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2


def test_cells():
    """Bounded cells have the area of those of scipy, which rounds."""
    random = np.random.default_rng(harness.seeded('cells').randrange(2**32))
    for n in (10, 300):
        points = random.random((n, 2))
        theirs, v = Diagram(points), dyadel.delaunay(points).voronoi(window=(-1000, 1000, -1000, 1000))
        bounded = 0
        for i in range(n):
            corners = theirs.regions[theirs.point_region[i]]
            if -1 in corners or np.abs(theirs.vertices[corners]).max() > 50:
                continue
            bounded += 1
            for ring in (v[i].inner, v.tiles[i]):
                assert len(ring) == len(corners) and np.isclose(shoelace(ring), shoelace(theirs.vertices[corners]), rtol=1e-6)
        assert bounded > n // 10


def test_strides():
    random = np.random.default_rng(7)
    table = random.random((500, 5))
    plain = dyadel.delaunay(table[:, 1:3].copy())
    for view in (table[:, 1:3], np.asfortranarray(table[:, 1:3]), table[:, 2:0:-1][:, ::-1], table.T[1:3].T):
        assert np.array_equal(dyadel.delaunay(view).pairs, plain.pairs)
    backwards = dyadel.delaunay(table[::-1, 1:3])
    assert np.array_equal(np.unique(np.sort(499 - backwards.legal, axis=1), axis=0), plain.legal)
    swapped = dyadel.delaunay(table[:, 1:3].astype('>f8'))
    assert np.array_equal(swapped.pairs, plain.pairs)


def test_other_numbers():
    whole = np.array([[0, 0], [5, 1], [2, 7], [9, 9]])
    plain = dyadel.delaunay(whole.astype(float))
    for kind in (np.int8, np.uint16, np.int64, np.float32, np.float16, object):
        assert np.array_equal(dyadel.delaunay(whole.astype(kind)).pairs, plain.pairs), kind
    big = np.array([[2**60 + 1, 0], [2**60, 1], [2**60 - 1, 0]])
    assert dyadel.delaunay(big).rect(0)[0] == 2**60 + 1


def test_shapes():
    for shape in ((4, 3), (5,), (2, 2, 2), (0,)):
        error = harness.raised(ValueError, dyadel.delaunay, np.zeros(shape))
        assert '(N, 2)' in str(error), error
    assert len(dyadel.delaunay(np.zeros((0, 2)))) == 0
    one = dyadel.delaunay(np.zeros((1, 2)))
    assert one.outcome == 'decided' and one.pairs.shape == (0, 3) and one.simplices.shape == (0, 3)
    error = harness.raised(dyadel.Error, dyadel.delaunay, np.array([[0, 0], [1, np.nan]]))
    assert error.code == 'argument' and error.point == 1 and 'finite' in str(error)


harness.run_all(globals())
