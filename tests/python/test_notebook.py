#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The tutorial as a notebook, executed by nbclient, cell by cell; and what a notebook shows of results."""
import doctest
import os
import pathlib

import harness

harness.need('nbclient', 'nbformat', 'ipykernel')
import nbclient
import nbformat

SHOWN = [  # source of a cell, kinds of output that it has
    ('%matplotlib inline\nimport dyadel, numpy as np\nd = dyadel.delaunay(np.random.default_rng(1).random((30, 2)), radius=0.01)\nd',
     {'text/html', 'image/svg+xml', 'text/plain'}),
    ('d.voronoi()', {'text/html', 'image/svg+xml', 'text/plain'}),
    ('d.plan()', {'text/html', 'text/plain'}),
    ('dyadel.tolerance(d.points)', {'text/html', 'text/plain'}),
    ('dyadel.converge([("sqrt(2)", 0), (0, "pi"), (1, 1)])', {'text/html', 'image/svg+xml', 'text/plain'}),
    ('dyadel.delaunay(np.zeros((1, 2)), sphere=True)', {'text/plain'}),
    ('d.plot();', {'image/png'}), ('d.voronoi().plot();', {'image/png'})]


def executed(sources):
    """The outputs of each cell, by the kernel of this Python."""
    book = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(source) for source in sources])
    root = str(pathlib.Path(harness.DATA).parents[1])
    os.environ['PYTHONPATH'] = harness.PACKAGE
    nbclient.NotebookClient(book, timeout=600, kernel_name='python3', resources={'metadata': {'path': root}}).execute()
    return [cell.outputs for cell in book.cells]


def test_tutorial():
    text = pathlib.Path(__file__).with_name('tutorial.md').read_text(encoding='utf-8')
    examples = doctest.DocTestParser().get_examples(text)
    for example, outputs in zip(examples, executed([example.source for example in examples])):
        printed = ''.join(o.text if o.output_type == 'stream' else o.data['text/plain'] for o in outputs).strip()
        flat, want = (' '.join(t.split()).replace('[ ', '[').replace('( ', '(') for t in (printed, example.want))
        assert flat == want, (example.source, printed)
    print(f'{len(examples)} cells')


def test_shown():
    """Where matplotlib is not installed, its pictures are not tried."""
    cells = SHOWN
    try:
        import matplotlib.pyplot  # noqa: F401
    except ImportError:
        cells = [(source.replace('%matplotlib inline\n', ''), kinds) for source, kinds in SHOWN if 'image/png' not in kinds]
    for (source, kinds), outputs in zip(cells, executed([source for source, _ in cells])):
        found = set().union(*(o.data for o in outputs if o.output_type != 'stream'))
        assert found >= kinds, (source, found)


harness.run_all(globals())
