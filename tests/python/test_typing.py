#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""mypy --strict over the package and over a program that uses it; docstrings and stubs are whole."""
import ast
import html
import inspect
import pathlib
import re
import subprocess
import sys
import tempfile
import types

import harness

harness.need('mypy')
import dyadel
from dyadel import _dyadel

PROGRAM = '''
import pathlib
import numpy as np
import dyadel
from fractions import Fraction

def narrow(i: int, bits: int) -> tuple[int, int, Fraction, Fraction]:
    return i, i, Fraction(i * i), Fraction(i * i)

d: dyadel.Delaunay = dyadel.delaunay(np.zeros((3, 2)), radius=0.1, until="hausdorff:40")
d = dyadel.delaunay(dyadel.Source(4, narrow), timeout=60).refine(until="decided").append([("sqrt(2)", 1)])
total: int = int(d.legal[:, 0].sum()) + len(d.simplices) + d.status(0, 1).count("l")
where: np.ndarray[tuple[int, ...], np.dtype[np.int32]] = d.nearest(0, 0).points
bound: Fraction | None = d.voronoi(window=(0, 1, 0, 1)).area
rings: dyadel.Rings = d.voronoi().certain
total += len(rings.to_wkb()) + len(rings.coordinates[rings.offsets[0]:rings.offsets[1]]) + int(d.voronoi().areas[0, 1])
indptr, indices = d.vertex_neighbors
total += int(indices[indptr[0]:indptr[1]].sum() + d.find_triangle([[0, 0]])[0] + d.points[0, 0]) + dyadel.OUTSIDE
near: dyadel.NearestPlaces = d.nearest([[0, 0]])
total += int(near.single[0]) + len(d.interpolate(np.zeros(3), [[0, 0]]))
low, high = d.interpolation_range(np.zeros(3), [[0, 0]])
total += int(low[0] + high[0]) + len(d.voronoi().edges.ends) + len(d.voronoi().vertices.to_wkb()) + int(d.voronoi().regions.boxes[0, 0])
d.save(pathlib.Path("a.svg"))
d.plan(accuracy=0.1).save("plan.csv")
dyadel.check(dyadel.Source(4, narrow), reference=[(0, 0)], schedules=3)
share: Fraction | None = d.voronoi().exact_area(0)
d = dyadel.delaunay([(0, 0)], trace="run.1", resume=pathlib.Path("run.0"), sphere=False)
edges: np.ndarray[tuple[int, ...], np.dtype[np.int32]] = d.graph("mst", timeout=3).certain
globe: dyadel.Sphere = dyadel.delaunay(np.zeros((3, 2)), "30m", sphere=True).refine(timeout=3)
around: list[int | None] = globe.voronoi()[0].vertices
total += len(globe.neighbors) + len(dyadel.tolerance(np.zeros((3, 2)), sigma=0.5).rows) + len(dyadel.replay("run.1"))
either: dyadel.Delaunay | dyadel.Sphere = dyadel.delaunay([(0, 0)], sphere=total > 3)
'''
WRONG = 'import dyadel\ndyadel.delaunay([(0, 0)]).status("a", 1)\ndyadel.Source("n", None)\n' \
    'dyadel.delaunay([(0, 0)], sphere=True).append([(1, 1)])\n'


def mypy(folder, *arguments):
    done = subprocess.run([sys.executable, '-m', 'mypy', '--strict', '--no-error-summary', '--cache-dir', f'{folder}/cache',
                           *arguments], capture_output=True, text=True, check=False, cwd=folder,
                          env={'MYPYPATH': harness.PACKAGE, 'PATH': '/usr/bin:/bin'})
    return done.stdout + done.stderr


def test_mypy():
    with tempfile.TemporaryDirectory() as folder:
        assert mypy(folder, '-p', 'dyadel') == '', mypy(folder, '-p', 'dyadel')
        for name, text in (('program', PROGRAM), ('wrong', WRONG)):
            pathlib.Path(folder, f'{name}.py').write_text(text, encoding='utf-8')
        assert mypy(folder, 'program.py') == '', mypy(folder, 'program.py')
        assert mypy(folder, 'wrong.py').count('error:') == 4, mypy(folder, 'wrong.py')


def test_stub():
    """The stub has what the module has, no more and no less."""
    tree = ast.parse(pathlib.Path(harness.PACKAGE, 'dyadel', '_dyadel.pyi').read_text(encoding='utf-8'))
    functions = {node.name for node in tree.body if isinstance(node, ast.FunctionDef)}
    assert functions == {name for name in dir(_dyadel) if inspect.isbuiltin(getattr(_dyadel, name))}
    for kind in (_dyadel.Engine, _dyadel.Sphere):
        body = next(node.body for node in tree.body if isinstance(node, ast.ClassDef) and node.name == kind.__name__)
        members = {node.name for node in body if not node.name.startswith('_')}
        assert members == {name for name in dir(kind) if not name.startswith('_')}, kind


def test_docstrings():
    """All that has a public name, inherited members included, has a type and a docstring; and the reference has it."""
    sys.path.insert(0, str(pathlib.Path(harness.DATA).parents[1] / 'src/python'))
    import reference
    text = html.unescape(re.sub('<[^>]*>', '', reference.page(dyadel))).replace('\xa0', ' ')
    for name in dyadel.__all__:
        thing = getattr(dyadel, name)
        assert name in text or name == '__version__', f'{name} is not in the reference'
        assert not callable(thing) or thing.__doc__, name
        for member in dir(thing) if inspect.isclass(thing) else ():
            value = inspect.getattr_static(thing, member)
            if not member.startswith('_') and isinstance(value, (types.FunctionType, property, classmethod)):
                assert inspect.getdoc(value), f'{name}.{member}'
                assert inspect.getdoc(value).split()[0] in text and member in text, f'{name}.{member} is not in the reference'


harness.run_all(globals())
