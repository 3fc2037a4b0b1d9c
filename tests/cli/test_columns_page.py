#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Pages that list things: each table that the command writes is on the page about columns, with its columns in their order;
each row of the page about notions is run, in C, in Python and as a command, and names a test that is there.

Usage: test_columns_page.py COMMAND DATA
"""
import pathlib
import re
import tempfile

from harness import main, run

PAGE = pathlib.Path(__file__).resolve().parents[1] / 'guide' / 'columns.md'
POINTS = 'x,y,name,note\n' + ''.join(f'{x},{y},n{x},some\n' for x, y in ((0, 0), (5, 1), (1, 6), (7, 7), (9, 0)))
SAME = {'graph:nearest': 'graph:gabriel', 'graph:mst': 'graph:gabriel'}


def tables():
    """Command line: columns."""
    parts = re.split(r'^## `(.*)`\n', PAGE.read_text(encoding='utf-8'), flags=re.M)[1:]
    return {line: re.findall(r'`(\w+)`', '\n'.join(re.findall(r'^\| (`.*?) \|', text, re.M))) for line, text in zip(parts[::2], parts[1::2])}


def header(line):
    command, *words = line.split()
    carried = command in ('delaunay', 'voronoi', 'tolerance', 'plan', 'nearest', 'disc')
    named = [] if command in ('converge', 'check') else ['--id', 'name', *(['--carry', 'note'] if carried else [])]
    radius = ['--radius', '0.1'] if command == 'plan' else []
    place = words if command == 'nearest' else []
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder, 'points.csv')
        file.write_text(POINTS, encoding='utf-8')
        result = run(command, str(file), *(place or words), '--columns', 'x,y', *named, *radius, '--quiet', comments=False)
    assert result.code in (0, 3), (line, result.err)
    return result.out.splitlines()[0].split(',')


def test_columns():
    for line, columns in tables().items():
        assert header(line) == columns, (line, header(line), columns)


def test_every_table_is_on_the_page():
    """The layers that the completion offers, and the commands."""
    known = tables()
    text = run('--help=bash').out
    layers = dict(re.findall(r"      (\w+)\) words='([^']*)' ;;", text.split('--layer)')[1].split('esac')[0]))
    assert {'delaunay', 'voronoi', 'tolerance'} <= set(layers), layers
    for command, names in layers.items():
        for k, layer in enumerate(names.split()):
            layer = SAME.get(layer, layer)
            assert any(re.match(rf'{command} .*--layer {layer}( |$)', line) for line in known) or k == 0 or (command, layer) == ('voronoi', 'aliases'), (command, layer)
    for command in ('delaunay', 'voronoi', 'tolerance', 'plan', 'nearest', 'disc', 'bisector', 'converge', 'check'):
        assert any(line.split()[0] == command for line in known), command


def test_notions():
    root = PAGE.parents[2]
    page = (PAGE.parent / 'notions.md').read_text(encoding='utf-8')
    blocks = {kind: ''.join(re.findall(rf'^```{kind}\n(.*?)^```', page, re.M | re.S)) for kind in ('console', 'c', 'python')}
    in_c = blocks['c'] + ''.join(f.read_text(encoding='utf-8') for f in (root / 'tests').glob('*/*.c'))
    in_python = blocks['python'] + ''.join(f.read_text(encoding='utf-8') for f in (root / 'tests' / 'python').glob('*.py'))
    rows = [[c.strip() for c in line.strip('|').split('|')] for line in page.splitlines() if line.startswith('| ')][1:]
    assert len(rows) == 13
    for notion, command, c, python, test in rows:
        for name in re.findall(r'`(\w+)', c):
            assert name in in_c, (notion, name)
        for name in re.findall(r'`(?:dyadel|d|v)(\.\w+)`|`(\w+)`', python):
            assert (name[0] or name[1]) in in_python, (notion, name)
        for words in re.findall(r'`((?:delaunay|voronoi|bisector|disc|nearest|converge|check)[^`]*)`', command):
            assert re.search(rf'dyadel {words.split()[0]} .*{" ".join(words.split()[1:2])}', blocks['console']), (notion, words)
        assert (root / test).exists(), (notion, test)


main(globals())
