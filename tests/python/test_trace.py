#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Traces: a run that ended early continues without repeating a request; replays; graphs of neighbours;
probabilities."""
import errno
import json
import math
import os
import pathlib
import tempfile
from fractions import Fraction

import harness
import numpy as np

import dyadel

RANDOM = np.random.default_rng(harness.seeded('trace').randrange(2**32))
FOLDER = tempfile.TemporaryDirectory()
TRACE, OTHER = (pathlib.Path(FOLDER.name, name) for name in ('trace', 'other'))
NEAR = Fraction(1, 10**9)


class Instrument:
    """Four points that nearly are the corners of a square, and some others; fails at the call given."""

    def __init__(self, fails=None):
        self.calls, self.fails = [], fails

    def __call__(self, i, bits):
        if len(self.calls) == self.fails:
            raise InterruptedError(errno.EINTR, 'switched off')
        self.calls.append((i, bits))
        x, y = (i % 2, i // 2 + NEAR * (i == 3)) if i < 4 else (i, i * i + 3)
        width = Fraction(1, 2**bits) / 3
        return x, x, y - width, y + width


def run(instrument, **options):
    return dyadel.delaunay(dyadel.Source(8, instrument), start_bits=4, step_bits=5, **options)


def test_resume():
    """Killed at any answer: the two runs together ask what an undisturbed one asks, and find the same."""
    whole = Instrument()
    d = run(whole, trace=TRACE)
    lines = [json.loads(line) for line in TRACE.read_text().splitlines()]
    assert d.outcome == 'decided' and d.recalled == 0 and len(whole.calls) > 20
    assert lines[0]['points'] == 8 and lines[-1]['outcome'] == 'decided'
    assert [(line['point'], line['bits']) for line in lines if line.get('called')] == whole.calls
    for fails in (0, 1, 7, 8, len(whole.calls) // 2, len(whole.calls) - 1):
        first = Instrument(fails)
        error = harness.raised(InterruptedError, run, first, trace=str(TRACE))
        assert first.calls == whole.calls[:fails] and error.errno == errno.EINTR
        second = Instrument()
        e = run(second, resume=TRACE, trace=OTHER)
        assert first.calls + second.calls == whole.calls, fails
        assert OTHER.read_text().count('{"kept":true,') == fails and not OTHER.with_name('other.new').exists()
        assert e.recalled == fails and np.array_equal(e.pairs, d.pairs) and np.array_equal(e.boxes, d.boxes)
        third = Instrument()
        assert run(third, resume=OTHER).recalled == len(whole.calls) and not third.calls


def test_cut_short():
    """A line that was being written when the power failed is ignored."""
    run(Instrument(), trace=TRACE)
    text = TRACE.read_bytes()
    OTHER.write_bytes(text[:len(text) // 2])
    again = Instrument()
    assert run(again, resume=os.fspath(OTHER)).recalled > 0 and again.calls


def test_wrong_traces():
    run(Instrument(), trace=TRACE)
    error = harness.raised(dyadel.Error, dyadel.delaunay, dyadel.Source(5, Instrument()), resume=TRACE)
    assert error.code == 'parse' and 'trace of 8 points' in str(error)
    OTHER.write_text('{}\n')
    assert harness.raised(dyadel.Error, run, Instrument(), resume=OTHER).line == 1
    assert harness.raised(FileNotFoundError, run, Instrument(), resume=TRACE.with_name('none')).filename.endswith('none')
    harness.raised(FileNotFoundError, run, Instrument(), trace=TRACE.with_name('none') / 'x')
    if os.path.exists('/dev/full'):
        assert harness.raised(dyadel.Error, run, Instrument(), trace='/dev/full').code == 'io'

    def moved(i, bits):
        return i, i * i + 50
    error = harness.raised(dyadel.Error, dyadel.delaunay, dyadel.Source(8, moved), resume=_half(), start_bits=4, step_bits=5)
    assert error.code in ('contradiction', 'nesting')


def _half():
    """The trace as far as it went before the last stage."""
    lines = TRACE.read_text().splitlines(keepends=True)
    done = [k for k, line in enumerate(lines) if '"done"' in line]
    OTHER.write_text(''.join(lines[:done[-2] + 1]))
    return OTHER


def test_goals_and_progress():
    """A window that has to be found first, and a function of progress, beside a trace."""
    seen = []
    d = dyadel.delaunay([(f'sqrt({k})', f'cbrt({k * k})') for k in range(2, 12)], trace=TRACE, progress=seen.append,
                        until='voronoi area:100', start_bits=8)
    stages = [line for line in map(json.loads, TRACE.read_text().splitlines()) if line.get('done')]
    assert d.outcome == 'certified' and len(stages) > len(seen) > 0, 'the first stage finds the window'


def test_replay():
    for options in (dict(), dict(of='voronoi'), dict(of='voronoi', window=(0, 8, 0, 80))):
        c = dyadel.converge(dyadel.Source(8, Instrument()), trace=TRACE, times=False, step_bits=5, **options)
        again = dyadel.replay(TRACE)
        assert c.outcome == again.outcome == 'decided' and len(c.rows) > 3
        for name in c:
            if name not in ('calls', 'filter', 'integer', 'exact'):
                assert np.array_equal(c[name], again[name], equal_nan=c[name].dtype.kind == 'f'), name
    asked = Instrument()
    assert dyadel.converge(dyadel.Source(8, asked), resume=TRACE, times=False, step_bits=5, window=(0, 8, 0, 80)).outcome == 'decided'
    assert not asked.calls
    TRACE.write_text(TRACE.read_text().replace('"outcome"', '"outcom"'))
    assert harness.raised(dyadel.Error, dyadel.replay, TRACE).code == 'parse'
    harness.raised(FileNotFoundError, dyadel.replay, 'no such trace')


def test_graphs():
    """Exact points against their distances; boxes between all and nothing."""
    points = RANDOM.integers(0, 1000, (60, 2)).astype(float) + RANDOM.random((60, 2))
    away = np.hypot(*(points[:, None] - points[None]).transpose(2, 0, 1))
    np.fill_diagonal(away, np.inf)
    d = dyadel.delaunay(points)
    nearest, gabriel, tree = (d.graph(name) for name in ('nearest', 'gabriel', 'mst'))
    assert nearest.certain.tolist() == list(map(list, enumerate(away.argmin(1).tolist()))) and not len(nearest.possible)
    middle = (points[:, None] + points[None]) / 2
    inside = np.hypot(*(middle[:, :, None] - points[None, None]).transpose(3, 0, 1, 2)) < away[:, :, None] / 2 * (1 - 1e-12)
    empty = inside.sum(2) == 0
    assert gabriel.certain.tolist() == [[i, j] for i in range(60) for j in range(i + 1, 60) if empty[i, j]]
    assert len(tree.certain) == 59 and math.isclose(away[tuple(tree.certain.T)].sum(), spanning_length(away))
    assert {tuple(p) for p in tree.certain.tolist()} <= {tuple(p) for p in gabriel.certain.tolist()} <= {tuple(p) for p in d.legal.tolist()}
    wide = dyadel.delaunay(points, radius=15.0)
    for name, exact in (('nearest', nearest), ('gabriel', gabriel), ('mst', tree)):
        graph = wide.graph(name)
        sure, possible = ({tuple(p) for p in edges.tolist()} for edges in graph[:2])
        assert graph.outcome == 'fixpoint'
        round_ = wide.graph(name, discs=True)  # discs are in the squares
        assert sure <= {tuple(p) for p in round_.certain.tolist()} and round_.outcome == 'fixpoint'
        assert {tuple(p) for edges in round_[:2] for p in edges.tolist()} <= sure | possible
        assert sure <= {tuple(p) for p in exact.certain.tolist()} <= sure | possible and possible and not sure & possible
    lines = wide.write(layer='graph:mst').splitlines()[1:]
    assert [line.rsplit(',', 1)[1] for line in lines].count('certain') == len(wide.graph('mst').certain)
    asked = dyadel.delaunay([(f'sqrt({k + 2})', f'sin({k * k})') for k in range(12)], max_stages=1, start_bits=2)
    assert asked.outcome == 'budget' and asked.graph('mst', max_bits=4).outcome == 'budget'
    for name in ('nearest', 'gabriel', 'mst'):
        found = asked.graph(name, max_stages=100)
        assert found.outcome == 'decided' and not len(found.possible), 'refined until certain'
    lazy = dyadel.delaunay([(f'sqrt({k + 2})', f'sin({k * k})') for k in range(12)], start_bits=2)
    assert 'possible' not in lazy.write(layer='graph:mst')
    assert 'gabriel' in str(harness.raised(ValueError, d.graph, 'star'))
    harness.raised(RuntimeError, dyadel.Delaunay().graph, 'mst')


def spanning_length(away):
    """Prim."""
    inside, total = {0}, 0.0
    while len(inside) < len(away):
        rest = [k for k in range(len(away)) if k not in inside]
        block = away[np.ix_(sorted(inside), rest)]
        total += block.min()
        inside.add(rest[block.min(0).argmin()])
    return total


def test_sigma():
    """Lower bounds of probabilities: of edges that hardly anything loses 1, and less the wider errors are."""
    points = np.array([[0, 0], [10, 0], [5, 8], [5, -9], [5, 0.5]])
    small, large = (dyadel.tolerance(points, sigma=sigma) for sigma in (1e-3, 2.0))
    assert 'probability' not in dyadel.tolerance(points) and (small['probability'] <= 1).all()
    assert (small['probability'] > 0.999).all() and (large['probability'] < small['probability']).all()
    lost = np.zeros(len(large['i']))
    tries = 400
    for _ in range(tries):
        edges = {tuple(p) for p in dyadel.delaunay(points + RANDOM.normal(0, 2.0, points.shape)).legal.tolist()}
        lost += [(i, j) not in edges for i, j in zip(large['i'].tolist(), large['j'].tolist())]
    assert (1 - lost / tries >= large['probability'] - 0.12).all(), 'five standard deviations of the count'
    for wrong in (0, -1.0, float('inf'), float('nan')):
        harness.raised(ValueError, dyadel.tolerance, points, sigma=wrong)


harness.run_all(globals())
