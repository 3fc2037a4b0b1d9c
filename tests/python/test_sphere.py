#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Points on a sphere: against hulls in space, what the command writes, and the limits of degrees [SPH-1]."""
import copy
import json
import os
import pathlib
import pickle
import tempfile
from fractions import Fraction

import harness
import numpy as np

import dyadel

RANDOM = np.random.default_rng(harness.seeded('sphere').randrange(2**32))
AIRPORTS = dyadel.Text.from_file(f'{harness.DATA}/airports.csv', columns='longitude,latitude')
OCTAHEDRON = [(0, 0), (90, 0), (180, 0), (-90, 0), (0, 90), (0, -90)]


def in_space(lonlat):
    lon, lat = np.radians(np.asarray(lonlat, float)).T
    return np.column_stack((np.cos(lat) * np.cos(lon), np.cos(lat) * np.sin(lon), np.sin(lat)))


def somewhere(n):
    return np.column_stack((RANDOM.uniform(-180, 180, n), np.degrees(np.arcsin(RANDOM.uniform(-1, 1, n)))))


def test_airports():
    d = dyadel.delaunay(AIRPORTS, sphere=True)
    assert (d.outcome, len(d), len(d.legal), len(d.pairs)) == ('decided', 3376, 10122, 10122)
    assert repr(d) == '<dyadel.Sphere: 3376 points, decided: 10122 legal, 0 indeterminate, 0 ties>'
    lines = d.write().splitlines()[1:]
    assert [line.split(',')[:2] for line in lines] == [[str(i), str(j)] for i, j in d.legal.tolist()]
    assert len(d.simplices) == 2 * len(d) - 4 and (d.neighbors >= 0).all()


def test_costs():
    """Costs are of places, though one of them, the centre, has no image."""
    random = harness.seeded('sphere costs')
    spent = {0: 0.0, 50: 0.0}
    for _ in range(20):
        at = [(Fraction(90 * i), Fraction(0)) for i in (-2, -1)] + [
            (Fraction(i % 2) + Fraction(random.randrange(99), 100 * 2**random.randrange(8, 60)), Fraction(i // 2)) for i in range(4)]
        for dear in spent:
            def narrow(i, bits, dear=dear, at=at):
                spent[dear] += 50 if i == 5 else 1
                return [end + sign * Fraction(1, 2**bits) for end in at[i] for sign in (-1, 1)]
            dyadel.delaunay(dyadel.Source(6, narrow), sphere=True, start_bits=2, cost=[1, 1, 1, 1, 1, dear or 1])
    assert 0 < spent[50] < 0.95 * spent[0], spent


def test_hulls_in_space():
    """Edges and triangles are those of the hull, and neighbours share a side."""
    try:
        from scipy.spatial import ConvexHull
    except ImportError:
        print('scipy is not installed: not tried')
        return
    for n in (4, 5, 8, 40, 300):
        for lonlat in (somewhere(n), somewhere(n) * [0.01, 0.01] + [179.995, 40]):
            d, places = dyadel.delaunay(lonlat, sphere=True), in_space(lonlat)
            hull = {frozenset(t) for t in ConvexHull(places).simplices.tolist()}
            assert {frozenset(t) for t in d.simplices.tolist()} == hull
            assert {frozenset(p) for p in d.legal.tolist()} == {frozenset((a, b)) for t in hull for a in t for b in t if a != b}
            corners = places[d.simplices]
            turn = np.einsum('ij,ij->i', np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]),
                             corners[:, 0] - places.mean(0))
            assert (turn > 0).all(), 'not counter-clockwise from outside'
            for t, beyond in enumerate(d.neighbors.tolist()):
                for k, other in enumerate(beyond):
                    assert set(d.simplices[t]) - {d.simplices[t, k]} == set(d.simplices[t]) & set(d.simplices[other])


def test_few_points():
    for places, pairs, triangles in (([], 0, 0), ([(7, 8)], 0, 0), ([(7, 8), (187, -8)], 1, 0), ([(0, 0), (1, 0), (0, 1)], 3, 2)):
        d = dyadel.delaunay(places, sphere=True)
        assert (d.outcome, d.pairs.shape, d.simplices.shape, d.neighbors.shape) == (
            'decided', (pairs, 3), (triangles, 3), (triangles, 3)), places
        assert d.boxes.shape == (len(places), 4) and (d.centre is None) == (not places)
    assert d.neighbors.tolist() == [[1, 1, 1], [0, 0, 0]]


def test_statuses():
    d = dyadel.delaunay([*OCTAHEDRON, (360, 0), (5, 90)], sphere=True)
    assert d.outcome == 'decided' and d.aliases.tolist() == [[6, 0], [7, 4]] and len(d) == 8
    assert [d.status(0, j) for j in range(8)] == ['illegal', 'legal', 'illegal', 'legal', 'legal', 'legal', 'illegal', 'legal']
    assert d.status(7, 6) == 'legal' and d.status(5, 7) == 'illegal' and d.boxes[4].tolist() == [0, 0, 90, 90]
    square = dyadel.delaunay([(1, 1), (-1, 1), (1, -1), (-1, -1), (180, 0)], sphere=True)
    assert square.outcome == 'fixpoint' and square.ties.tolist() == [[0, 3], [1, 2]] and square.status(2, 1) == 'tie'
    assert (square.neighbors < 0).sum() == 4
    for i, j in (0, 8), (8, 0), (-1, 0):
        harness.raised(IndexError, d.status, i, j)
    harness.raised(IndexError, d.rect, 8)
    third = dyadel.delaunay([(Fraction(1, 3), 0), (0, 0), ('sqrt(2)', '-pi')], sphere=True)
    assert third.rect(0) == (Fraction(1, 3), Fraction(1, 3), 0, 0)
    low, high = third.rect(2)[:2]
    assert low**2 < 2 < high**2 and high - low < 1e-8


def test_radius():
    lonlat = somewhere(60)
    exact, wide = dyadel.delaunay(lonlat, sphere=True), dyadel.delaunay(lonlat, '30km', sphere=True)
    assert {tuple(p) for p in wide.legal.tolist()} <= {tuple(p) for p in exact.legal.tolist()} <= {tuple(p[:2]) for p in wide.pairs.tolist()}
    assert len(wide.indeterminate) and wide.outcome == 'fixpoint'
    degree = 30 / 6371.0088 * 180 / np.pi
    assert np.allclose(np.diff(wide.boxes[:, 2:]), 2 * degree, rtol=1e-9), 'of latitude'
    for radius, unit in (('0.01deg', None), ('0.01', 'deg'), (Fraction(1, 100), 'deg'), ('36arcsec', 'm'), (Fraction(6, 10), 'arcmin')):
        d = dyadel.delaunay([(1, 2), (3, 4)], radius, sphere=True, radius_unit=unit)
        ends = Fraction(99, 100), Fraction(101, 100), Fraction(199, 100), Fraction(201, 100)
        assert all(abs(got - end) < 2.0**-60 for got, end in zip(d.rect(0), ends)), d.rect(0)
    by_number = dyadel.delaunay(lonlat, 0.01, sphere=True, radius_unit='deg')
    assert np.array_equal(by_number.pairs, dyadel.delaunay(lonlat, [0.01] * 60, sphere=True, radius_unit='deg').pairs)
    for radii, unit in (([30] * 60, 'km'), (np.full(60, 30000.0), 'm'), (30, 'km'), (np.float64(30), 'km')):
        same = dyadel.delaunay(lonlat, radii, sphere=True, radius_unit=unit)
        assert np.array_equal(same.pairs, wide.pairs) and np.allclose(same.boxes, wide.boxes), (radii, unit)
    own = dyadel.delaunay([(0, 0), ('1/3', 10)], ['2km', 0], sphere=True)
    assert np.allclose(np.diff(own.boxes[:, 2:]).ravel(), [4 / 6371.0088 * 180 / np.pi, 0], atol=1e-12)
    table = dyadel.Text('lon,lat,s [mm]\n0,0,5\n1,1,7\n', columns='lon,lat', radius_columns='s [mm]')
    metres = dyadel.Text('lon,lat,s\n0,0,5\n1,1,7\n', columns='lon,lat', radius_columns='s', radius_unit='m', radius_scale='0.001')
    assert np.array_equal(dyadel.delaunay(table, sphere=True).boxes, dyadel.delaunay(metres, sphere=True).boxes)
    five = [(-103, -58), (11, 5), (-82, -59), (15, -18), (150, 0)]
    both = [dyadel.delaunay(five, '20deg', sphere=True), dyadel.delaunay(five, 20, sphere=True, radius_unit='deg')]
    both.append(pickle.loads(pickle.dumps(both[1])))
    for d in both:
        assert d.status(2, 4) == d.status(0, 3) == 'indeterminate' and np.array_equal(d.pairs, both[0].pairs)
    assert np.allclose(np.diff(by_number.boxes)[:, [0, 2]], 0.02, atol=1e-9)
    text = ''.join(f'{x!r} {y!r}\n' for x, y in lonlat.tolist())
    assert np.array_equal(dyadel.delaunay(dyadel.Text(text, radius='30km'), sphere=True).pairs, wide.pairs)


def test_refused():
    cases = [(dict(until='hausdorff:3'), 'about the plane'), (dict(window=(0, 1, 0, 1)), 'about the plane'),
             (dict(radius='3 parsec'), 'is not an exact number'), (dict(radius=20), "state a unit: radius_unit='m'"),
             (dict(radius='0.01'), "state a unit: radius_unit='m'"), (dict(radius=[1] * 6), "state a unit: radius_unit='m'"),
             (dict(radius=3, radius_unit='miles'), 'is not a unit of radii'), (dict(radius=[1], radius_unit='m'), 'radius has 1 values for 6 points'),
             (dict(radius=[(1, 2)] * 6, radius_unit='m'), 'one radius'),
             (dict(radius='-1m'), 'is not an exact number'), (dict(radius='7000km'), 'larger than that of the earth')]
    for options, words in cases:
        assert words in str(harness.raised(ValueError, dyadel.delaunay, OCTAHEDRON, sphere=True, **options)), options
    error = harness.raised(dyadel.Error, dyadel.delaunay, [(0, 0), (0, 91)], sphere=True)
    assert (error.code, error.point) == ('domain', 1)
    error = harness.raised(dyadel.Error, dyadel.delaunay, dyadel.Text('0 0\n0 91\n'), sphere=True)
    assert (error.line, error.column) == (2, 3)
    d = dyadel.delaunay(OCTAHEDRON, sphere=True)
    harness.raised(ValueError, d.write, 'svg', window=(0, 1, 0, 1))
    harness.raised(ValueError, d.write, 'csv', 'graph:mst')
    assert harness.raised(dyadel.Error, d.voronoi().write, 'html').code == 'argument'


def test_sources():
    """Points of functions; their exceptions, with the point's own number."""
    def narrow(i, bits):
        x, y = OCTAHEDRON[i]
        return Fraction(x), Fraction(x), y - Fraction(y > 0, 2**bits), y + Fraction(y < 0, 2**bits)
    d = dyadel.delaunay(dyadel.Source(4, narrow), sphere=True)
    assert d.outcome == 'fixpoint' and len(d.ties) == 2, 'four points on the equator'

    def drifting(i, bits):
        return 10 * i, 10 * i, i * i + (Fraction(1, 2**bits) if i == 5 and bits > 60 else 0), i * i + Fraction(1, 2**(bits + 1))
    error = harness.raised(dyadel.Error, dyadel.delaunay, dyadel.Source(6, drifting), sphere=True, start_bits=200)
    assert error.point == 5 and error.result.outcome == 'error', (error, error.point)

    def fails(i, bits):
        raise KeyError(i)
    harness.raised(KeyError, dyadel.delaunay, dyadel.Source(3, fails), sphere=True)
    harness.raised(TypeError, dyadel.tolerance, OCTAHEDRON, sphere=True)

    def again(i, bits):
        harness.raised(RuntimeError, d.refine) if i == 9 else None
        return i, i * i
    assert dyadel.delaunay(dyadel.Source(4, again), sphere=True).outcome == 'decided'


def test_open_around_the_gap():
    """Images are decided, a pair of places around the gap that all is projected from is not: the outcome is of places."""
    d = dyadel.delaunay([(-82.97, -19.2), (33.21, 66.32), (34.9, 65.43), (-81.82, -19.93)], radius='0.2deg', sphere=True)
    assert d.indeterminate.tolist() == [[0, 2]] and d.outcome == 'fixpoint', (d.outcome, d.pairs)


def answers_of(trace):
    """The lines of a trace without digests, and without answers kept from another trace."""
    lines = [json.loads(line) for line in pathlib.Path(trace).read_text().splitlines()]
    return [{name: value for name, value in line.items() if name != 'sum'} for line in lines if 'kept' not in line]


def test_traces():
    """Killed at any line: the resumed run takes those answers, and finds the same; any further requests are for the
    rectangles."""
    calls = []

    def narrow(i, bits):
        calls.append((i, bits))
        x, y = 40 * i - 170, (60 if i % 2 else -60) - Fraction(i * i, 10**9)
        return x, x, y - Fraction(1, 2**bits), y + Fraction(1, 2**bits)

    with tempfile.TemporaryDirectory() as folder:
        trace, cut, again = (os.path.join(folder, name) for name in ('trace', 'cut', 'again'))

        def run(**options):
            return dyadel.delaunay(dyadel.Source(9, narrow), sphere=True, start_bits=4, step_bits=4, **options)
        d, alone = run(trace=trace), len(calls)
        lines = pathlib.Path(trace).read_text().splitlines(keepends=True)
        answers = [k for k, line in enumerate(lines) if '"called"' in line]
        assert d.recalled == 0 and len(answers) > 9
        for kept in (1, answers[0] + 1, answers[4] + 1, len(lines) // 2, len(lines)):
            pathlib.Path(cut).write_text(''.join(lines[:kept]))
            calls.clear()
            e = run(resume=cut, trace=again)
            assert e.recalled == sum(k < kept for k in answers) and len(calls) <= alone + e.recalled, kept
            assert answers_of(again) == answers_of(trace), kept
            assert np.array_equal(e.pairs, d.pairs) and np.array_equal(e.boxes, d.boxes)
        error = harness.raised(dyadel.Error, dyadel.delaunay, OCTAHEDRON, sphere=True, resume=trace)
        assert error.code == 'parse' and error.result.outcome == 'none', error


def test_pickling():
    for d in (dyadel.delaunay(somewhere(50), '10km', sphere=True), dyadel.delaunay(OCTAHEDRON, sphere=True),
              dyadel.delaunay(AIRPORTS, sphere=True), dyadel.delaunay(somewhere(9), 0.5, sphere=True, radius_unit='deg')):
        for other in (pickle.loads(pickle.dumps(d)), copy.deepcopy(d)):
            assert np.array_equal(other.pairs, d.pairs) and other.outcome == d.outcome and np.array_equal(other.boxes, d.boxes)


def test_voronoi():
    lonlat = somewhere(100)
    d = dyadel.delaunay(lonlat, sphere=True)
    v = d.voronoi()
    assert len(v) == 100 and len(v.vertices) == len(d.simplices) == len(v.corners) and not v.regions
    assert all(cell.complete and len(cell.vertices) >= 3 for cell in v) and '100 known' in repr(v)
    places = in_space(lonlat)
    at = in_space(np.column_stack((v.vertices[:, :2].mean(1), v.vertices[:, 2:].mean(1))))
    nearest = np.sort(np.argsort(-at @ places.T)[:, :3], 1)
    assert np.array_equal(nearest, np.sort(v.corners, 1)), 'a vertex is nearest to its three points'
    for i, cell in enumerate(v):
        assert all(i in v.corners[k] for k in cell.vertices)
    cube = dyadel.delaunay([(x, y) for x in (45, 135, -45, -135) for y in (30, -30)], sphere=True).voronoi()
    assert [region['status'] for region in cube.regions] == ['tie'] * 6 and cube[0].complete and len(cube[0].vertices) == 3
    square = dyadel.delaunay([(1, 1), (-1, 1), (1, -1), (-1, -1), (180, 0)], sphere=True).voronoi()
    assert len(set(square[0].vertices) & set(square[3].vertices)) == 1 and square[0].complete and square[4].complete
    assert json.loads(v.write('json'))['cells'] and v.write(layer='vertices').startswith('i,j,k,') and '<svg' in v._repr_svg_()
    assert len(v.__geo_interface__['features']) == 100 and dyadel.delaunay([(0, 0), (360, 0), (9, 9)], sphere=True).voronoi()[1]
    harness.raised(IndexError, lambda: v[100])


def test_formats():
    d = dyadel.delaunay(AIRPORTS, sphere=True)
    assert len(d.__geo_interface__['features']) == len(d.pairs) and '<svg' in d._repr_svg_() and 'srcdoc' in d._repr_html_()
    assert d.write(layer='triangles').count('\n') == len(d.simplices) + 1
    assert dyadel.verify(d.certificate()).proved and d.counters['stages'] >= 1


harness.run_all(globals())
