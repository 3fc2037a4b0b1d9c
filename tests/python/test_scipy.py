#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Sets in general position against scipy.spatial.Delaunay: triangles, neighbours, hull. On integers the cases where scipy
and its rounding differ are none: each of its triangles is checked in integers first."""
import importlib
import pathlib
import re
import tempfile

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


def interpolate_choice(points, values, places):
    """By scipy; None where two points are the same or all are on one line."""
    if len(np.unique(points, axis=0)) < len(points) or np.linalg.matrix_rank(points - points[0]) < 2:
        return None
    return LinearNDInterpolator(points, values)(places)


def test_interpolation_range():
    """No choice of points in their squares leaves the bounds, corners of the squares included [LOC-6]; places on points and edges."""
    random = np.random.default_rng(harness.seeded('range').randrange(2**32))
    held = wide = 0
    for case in range(40):
        n = int(random.integers(4, 25))
        points = random.integers(0, 6, (n, 2)) + random.random((n, 2)) * (case % 2)
        radius = random.choice([0, 0.05, 0.3, 1.0]) * (random.random(n) < 0.7)
        d, values = dyadel.delaunay(points, radius), random.random(n)
        places = np.vstack((random.random((60, 2)) * 7 - 0.5, points, (points[1:] + points[:-1]) / 2))
        low, high = d.interpolation_range(values, places)
        known = ~np.isnan(low)
        assert np.array_equal(known, ~np.isnan(high)) and (low[known] <= high[known]).all()
        for trial in range(8):
            way = random.integers(0, 2, (n, 2)) * 2 - 1 if trial % 2 else random.random((n, 2)) * 2 - 1
            moved = points + way * radius[:, np.newaxis]
            found = interpolate_choice(moved, values, places)
            if found is None:
                continue
            inside = known & ~np.isnan(found)
            assert ((low - 1e-9 <= found) & (found <= high + 1e-9))[inside].all()
            outside = places[known & np.isnan(found)].T  # on the hull, where scipy rounds
            sides = ConvexHull(moved).equations
            assert not outside.size or (sides[:, :2] @ outside + sides[:, 2:]).max() < 1e-9
            held += inside.sum()
        certain = d.interpolate(values, places)
        assert known[~certain.mask].all() and ((low <= certain.data + 1e-9) & (certain.data <= high + 1e-9))[~certain.mask].all()
        wide += (known & certain.mask).sum()
    assert held > 1000 and wide > 100
    one = dyadel.delaunay([(0, 0)]).interpolation_range([1], [[0, 0]])
    assert np.isnan(one).all()
    for wrong in ([1, 2], ['a'], [2**60 + 1]):
        harness.raised(ValueError, dyadel.delaunay([(0, 0)]).interpolation_range, wrong, [[0, 0]])


def own_triangles(d, theirs):
    return sorted(map(tuple, turned(d.simplices).tolist())) == sorted(map(tuple, turned(theirs.simplices).tolist()))


def own_rows(ours, theirs):
    """The same offsets, and the same points in each row."""
    return np.array_equal(ours[0], theirs[0]) and all(
        sorted(a) == sorted(b) for a, b in zip(*(np.split(indices, indptr[1:-1]) for indptr, indices in (ours, theirs))))


def own_places(d, theirs, xy):
    """The same triangle holds each place."""
    a, b = d.find_triangle(xy), theirs.find_simplex(xy)
    return np.array_equal(a >= 0, b >= 0) and np.array_equal(np.sort(d.simplices[a[a >= 0]]), np.sort(theirs.simplices[b[b >= 0]]))


def own_cells(v, theirs):
    """Cells that end within the window have the corners of those of scipy."""
    window, seen = np.array([float(end) for end in v.window]), 0
    for point, polygon in zip(v.tiles.points, v.tiles.to_shapely()):
        region = theirs.regions[theirs.point_region[point]]
        corners = theirs.vertices[region]
        if -1 in region or not ((window[::2] < corners) & (corners < window[1::2])).all():
            continue
        seen += 1
        ring = np.array(polygon.exterior.coords)[:-1]
        if not polygon.is_valid or len(ring) != len(corners) or \
                not np.allclose(sorted(map(tuple, ring)), sorted(map(tuple, corners)), rtol=1e-9, atol=1e-9):
            return False
    return seen > 10


def own_edges(v, theirs):
    """The same pairs, and vertices at the same places."""
    ours = {tuple(pair): sorted(map(tuple, v.vertices.centres[ends[ends >= 0]].round(6).tolist()))
            for pair, ends in zip(v.edges.pairs.tolist(), v.edges.ends)}
    return ours == {tuple(sorted(pair)): sorted(map(tuple, theirs.vertices[[k for k in ends if k >= 0]].round(6).tolist()))
                    for pair, ends in zip(theirs.ridge_points.tolist(), theirs.ridge_vertices)}


def own_frame(v, X):
    geopandas = importlib.import_module('geopandas')
    frame = v.to_geodataframe('cells', crs=2056)
    inside = [cell.contains(at) for cell, at in zip(frame.geometry, geopandas.points_from_xy(*X[frame.i].T))]
    return frame.crs.to_epsg() == 2056 and all(inside) and len(v.to_geodataframe('tiles')) == len(X)


def own_file(v):
    geopandas = importlib.import_module('geopandas')
    with tempfile.TemporaryDirectory() as folder:
        v.save(f'{folder}/cells.gpkg')
        return len(geopandas.read_file(f'{folder}/cells.gpkg')) == len(v.certain)


def own_plots(d, v):
    importlib.import_module('matplotlib').use('Agg')
    return len(d.plot().collections[0].get_segments()) == len(d.legal) and v.plot().collections


def test_table():
    """Each row of the table of names in the tutorial."""
    random = np.random.default_rng(harness.seeded('table').randrange(2**32))
    X, xy, values = random.random((50, 2)), random.random((200, 2)), random.random(50)
    d, theirs, diagram = dyadel.delaunay(X), Delaunay(X, incremental=True), Diagram(X)
    v = d.voronoi()
    more = random.random((5, 2))

    def added():
        theirs.add_points(more)
        return own_triangles(d.append(more), theirs)
    rows = {
        'Delaunay(X)': lambda: own_triangles(dyadel.Delaunay(X), theirs),
        '.points': lambda: np.array_equal(d.points, X) and beyond(d.simplices, d.neighbors) == beyond(theirs.simplices, theirs.neighbors),
        '.vertex_neighbor_vertices': lambda: own_rows(d.vertex_neighbors, theirs.vertex_neighbor_vertices),
        '.convex_hull': lambda: set(d.hull[0].tolist()) == set(ConvexHull(X).vertices.tolist()),
        '.find_simplex(xy)': lambda: own_places(d, theirs, xy),
        'LinearNDInterpolator(X, values)(xy)': lambda: np.allclose(
            d.interpolate(values, xy).filled(np.nan), LinearNDInterpolator(X, values)(xy), rtol=1e-12, atol=1e-12, equal_nan=True),
        'cKDTree(X).query(xy)': lambda: np.array_equal(d.nearest(xy).single, cKDTree(X).query(xy)[1]),
        'Voronoi(X)': lambda: np.allclose(sorted(map(tuple, v.vertices.centres)), sorted(map(tuple, diagram.vertices)), rtol=1e-9),
        'Voronoi(X).ridge_points': lambda: own_edges(v, diagram),
        'shapely.voronoi_polygons': lambda: own_cells(v, diagram) and len(v.tiles.to_wkb()) == len(X),
        'GeoDataFrame(geometry=cells)': lambda: own_frame(v, X),
        'gdf.to_file("cells.gpkg")': lambda: own_file(v),
        'delaunay_plot_2d': lambda: own_plots(d, v),
        '.add_points(X)': added}
    text = pathlib.Path(__file__).with_name('tutorial.md').read_text(encoding='utf-8')
    table = re.findall(r'^\| `([^`]+)`.*\|$', text.partition('| there | here |')[2].partition('\n\n')[0], re.M)
    assert sorted(table) == sorted(rows), set(table) ^ set(rows)
    for name, compared in rows.items():
        try:
            assert compared(), name
        except ModuleNotFoundError as missing:
            print(f'{name}: not tried, {missing}')


def test_append():
    """Point by point, and in heaps, against all at once."""
    random = np.random.default_rng(harness.seeded('append').randrange(2**32))
    for points in (random.random((300, 2)), random.integers(0, 12, (300, 2)).astype(float)):
        d = dyadel.delaunay(points[:40])
        for begin in range(40, 300, 13):
            d.append(points[begin:begin + 13])
            all_at_once = dyadel.delaunay(points[:begin + 13])
            assert d.pairs.tobytes() == all_at_once.pairs.tobytes() and np.array_equal(d.aliases, all_at_once.aliases)
            for layer in ('pairs', 'points', 'triangles', 'aliases'):
                assert d.write(layer=layer) == all_at_once.write(layer=layer)
            a, b = (sorted(map(tuple, turned(e.simplices).tolist())) for e in (d, all_at_once))
            assert a == b


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
