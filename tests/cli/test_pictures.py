#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Pictures: names of shapes, text as text, numbers where they fit, coordinates, honest legends.

Usage: test_pictures.py COMMAND DATA
"""
import csv
import math
import os
import pathlib
import random
import re
import shutil
import subprocess
import tempfile

import svg
from harness import DATA, expect, main, run

TWELVE = ''.join(f'{500000 + 17 * k * k % 211}+-{1 + k % 3} {5400000 + 31 * k % 197}+-{1 + k % 2}\n' for k in range(12))
ALL = [('delaunay', ()), ('voronoi', ()), ('disc', ()), ('bisector', ()), ('nearest', ('500100', '5400100')), ('plan', ())]
FIXES = '--columns', 'east,north', '--radius-column', 'accuracy', '--id', 'name', f'{DATA}/gps.csv'
NUMBER = re.compile(r'-?\d+(\.\d+)?(e-?\d+)?\Z')


def picture(command, points, *options, place=()):
    result = run(command, '--quiet', '--format', 'svg', *options, '-', *place, stdin=points)
    assert result.code in (0, 3, 4), result.err
    return result.out


def box_of(path):
    n = svg.numbers(path)
    return min(n[::2]), max(n[::2]), min(n[1::2]), max(n[1::2])


def texts(text, size):
    return [e for e in svg.elements(text) if e.tag == 'text' and e.look['font-size'] == size]


def label_box(e):
    """About where a number stands: digits are hardly wider than 0.66 of their size."""
    size, x, y = (float(e.look[k]) for k in ('font-size', 'x', 'y'))
    return x, x + 0.64 * size * len(e.text), y - 0.74 * size, y


def overlap(a, b):
    return a[0] < b[1] - 0.5 and b[0] < a[1] - 0.5 and a[2] < b[3] - 0.5 and b[2] < a[3] - 0.5


def test_text_is_text():
    """No glyphs as paths: every word is found; the page has a title."""
    for command, place in ALL:
        text = picture(command, TWELVE, place=place)
        assert '<glyph' not in text and '<use' not in text and svg.words(text), command
        assert [e for e in svg.elements(text) if e.tag == 'title'][0].text, command
        assert any('units of the coordinates' in w for w in svg.words(text)), command


def test_everything_has_a_name():
    """Each shape of a pair, a triangle or a point has an id and a title, and their number is right."""
    text = picture('delaunay', TWELVE)
    ids = {p.look['id']: p.title for p in svg.paths(text) if 'id' in p.look}
    table = run('delaunay', '--quiet', '-', stdin=TWELVE).out.split('status\n')[1].split()
    for line in table:
        i, j, status = line.split(',')
        assert ids[f'pair-{i}-{j}'] == f'{i}, {j}: {status}', line
    triangles = run('delaunay', '--quiet', '--layer', 'triangles', '-', stdin=TWELVE).out.split('k\n')[1].split()
    for line in triangles:
        assert 'certain triangle' in ids['triangle-' + line.replace(',', '-')], line
    for k in range(12):
        assert ids[f'point-{k}'].startswith(f'point {k}: x in ['), ids[f'point-{k}']
    assert len(ids) == len(table) + len(triangles) + 12
    cells = {p.look['id'] for p in svg.paths(picture('voronoi', TWELVE)) if p.look.get('id', '').startswith('cell-')}
    rows = [r for r in run('voronoi', '--quiet', '-', stdin=TWELVE).out.split('undetermined\n')[1].split()]
    assert cells == {'cell-' + r.split(',')[0] for r in rows if float(r.split(',')[5]) > 0}, cells
    for command, place in ALL:
        assert sum(p.title is not None for p in svg.paths(picture(command, TWELVE, place=place))) >= 2, command


def check_numbers(text, size, count):
    """Inside of the frame, on no rectangle, on no other number."""
    labels = [e for e in texts(text, size) if NUMBER.match(e.text) and 'paint-order' in e.look]
    assert len({e.text for e in labels}) == len(labels) >= count, [e.text for e in labels]
    left, right, top, bottom = svg.frame(text)
    sites = [box_of(p) for p in svg.paths(text) if p.look.get('id', '').startswith('point-')]
    boxes = [label_box(e) for e in labels]
    for k, b in enumerate(boxes):
        assert left < b[0] and b[1] < right + 1 and top < b[2] and b[3] < bottom, labels[k]
        assert not any(overlap(b, s) for s in sites), labels[k].text
        assert not any(overlap(b, o) for o in boxes[:k]), labels[k].text


def test_numbers():
    check_numbers(picture('delaunay', TWELVE), '13', 11)
    check_numbers(picture('voronoi', TWELVE), '13', 11)
    check_numbers(picture('bisector', TWELVE), '18', 2)
    check_numbers(picture('nearest', TWELVE, place=('500100', '5400100')), '14', 5)
    close = ''.join(f'{x / 8} {y / 8}\n' for x in range(40) for y in range(40))
    assert not texts(picture('delaunay', close), '13'), 'there is no room for 1600 numbers'


NAMED = 'name,x,y,r\n<a>&b,0,0,0.1\nÄgypten,4,0,0.1\n"longer than there is room for",2,3,0.2\n,5,4,0.1\n'


def test_identifiers():
    """Points are called by their identifiers where these are short and not empty, else by their numbers."""
    for command, place, titles in (('delaunay', (), True), ('voronoi', (), True), ('nearest', ('2', '1'), True),
                                   ('disc', (), False), ('bisector', (), False)):
        text = picture(command, NAMED, '--columns', 'x,y', '--radius-column', 'r', '--id', 'name', place=place)
        found = svg.words(text)
        for label in ('<a>&b', 'Ägypten', '2', '3')[:2 if command == 'bisector' else 3 if not titles else 4]:
            assert label in found, (command, label, found)
        if titles:
            title = {e.look['id']: e.title for e in svg.elements(text) if e.look.get('id', '').startswith('point-')}
            assert title['point-0'].startswith('point 0 (<a>&b): x '), title
            assert title['point-2'].startswith('point 2: x ') and title['point-3'].startswith('point 3: x '), title
    for kind in ('png', 'pdf'):
        odd = run('delaunay', '--quiet', '--format', kind, '--columns', 'x,y', '--id', 'name', '-', binary=True,
                  stdin=b'name,x,y\nb\xff\xfe,0,0\na\x1b,4,0\nc,2,3\n')
        assert odd.code == 0 and len(odd.out) > 1000, (kind, odd.err)


def test_coordinates():
    """Ticks are where their numbers say, on both sides of the frame."""
    for points, wide in (('0 0\n7 3\n', 7), (TWELVE, 200), ('1e-9 2e-9\n3e-9 1e-9\n', 2e-9), ('-1e12 0\n1e12 5e11\n', 2e12)):
        text = picture('delaunay', points)
        ticks = texts(text, '12')
        along = sorted((float(e.look['x']), float(e.text)) for e in ticks if e.look.get('text-anchor') == 'middle')
        up = sorted((float(e.look['y']), float(e.text)) for e in ticks if e.look.get('text-anchor') == 'end')
        assert len(along) >= 2 and len(up) >= 2, points
        scales = [(b[1] - a[1]) / (b[0] - a[0]) for a, b in zip(along, along[1:])] + [
            (a[1] - b[1]) / (b[0] - a[0]) for a, b in zip(up, up[1:])]
        assert max(scales) / min(scales) < 1.001 and 0.5 < scales[0] * 1000 / wide < 2, (points, scales)
    far = [e.text for e in texts(picture('delaunay', '1e15 1e15\n1e15+8 1e15+4\n'), '12')]
    assert any(t.startswith('+') for t in far), far  # too long: by how much they differ from the first


def test_legend_is_honest():
    """The selected layers and nothing else: points alone, ties, rectangles."""
    def legend(points, *options):
        return ' | '.join(svg.words(picture('delaunay', points, *options)))
    plain = legend('0 0\n4 0\n1 3\n')
    assert 'legal: 3' in plain and 'certain triangle' in plain and 'point' in plain
    for absent in ('indeterminate', 'tie', 'rectangle of a point', 'where', '--window'):
        assert absent not in plain, (absent, plain)
    square = legend('0 0\n4 0\n4 4\n0 4\n')
    assert 'tie: 2' in square and 'indeterminate' not in square and 'certain triangle' not in square, square
    wide = legend(TWELVE)
    for present in ('indeterminate: ', 'rectangle of a point', 'where a legal edge is', 'where an indeterminate edge may be'):
        assert present in wide, wide
    assert 'of a pixel' in wide and ' point; ' not in wide
    assert 'possibly' not in ' '.join(svg.words(picture('nearest', '0 0\n9 0\n', place=('1', '1'))))
    alone = ' | '.join(svg.words(picture('disc', '0 0\n4 0\n1 3\n')))
    assert 'point certainly' not in alone and 'point of which' not in alone, alone
    exact = ' | '.join(svg.words(picture('voronoi', '0 0\n4 0\n1 3\n')))
    assert 'box: undecided' not in exact and 'rectangle of' not in exact, exact


def test_outliers():
    """A hint when most points are in a small part, and it shows them; none otherwise."""
    chance = random.Random(4)
    crowd = ''.join(f'{chance.random():.4f} {chance.random():.4f}\n' for _ in range(100))
    for command in ('delaunay', 'voronoi'):
        assert 'small part' not in ' '.join(svg.words(picture(command, crowd)))
        words = ' '.join(svg.words(picture(command, crowd + '500 300\n')))
        hint = re.search(r'(\d+) of these 101 points are in a small part of the picture: window (\S+) shows it', words)
        assert hint and int(hint[1]) >= 64, words
        near = picture(command, crowd + '500 300\n', '--window=' + hint[2])
        drawn = [p for p in svg.paths(near) if p.look.get('id', '').startswith('point-')]
        assert len(drawn) >= int(hint[1]) and 'small part' not in ' '.join(svg.words(near)), len(drawn)
        half = ' '.join(svg.words(picture(command, crowd + '500 300\n', '--window=0.2,501,-1,301')))  # the hint goes beyond it
        hint = re.search(r'(\d+) of these (\d+) points are in a small part', half)
        assert hint and int(hint[1]) < int(hint[2]) < 90, half


def test_crowds_show_density():
    """Of a mass of lines their number in each square; of some lines the lines."""
    airports = ('--columns', 'longitude,latitude', '--radius', '0.3')
    with open(os.path.join(DATA, 'airports.csv'), encoding='utf-8') as f:
        points = f.read()
    text = picture('delaunay', points, *airports)
    words = ' | '.join(svg.words(text))
    assert 'of 113350 indeterminate pairs across a square | 2-3 | 4-9 | 10-29 | 30-99 | more' in words, words
    assert 'rectangle of a point' not in words and len(text) < 3e6, (words, len(text))
    assert not any(p.look.get('id', '').startswith('pair-') and p.look['stroke'] == '#d55e00' for p in svg.paths(text))
    assert 'across a square' not in ' '.join(svg.words(picture('delaunay', TWELVE)))
    for radius, window, dots in (('0.3', '-125,-66,24,50', True), ('0.05', '-112,-104,38,44', False)):  # rectangles that hide all
        words = svg.words(picture('delaunay', points, '--columns', 'longitude,latitude', '--radius', radius, f'--window={window}'))
        assert ('point, or the middle of its rectangle' in words, 'rectangle of a point' in words) == (dots, not dots), words


def crossed(frame, lines):
    """How many lines cross each square of 4 pixels."""
    count = {}
    for (x0, y0), (x1, y1) in lines:
        steps = int(((x1 - x0)**2 + (y1 - y0)**2)**0.5 / (4 / 3)) + 1
        way = [(int((x0 + k / steps * (x1 - x0) - frame[0]) / 4), int((y0 + k / steps * (y1 - y0) - frame[2]) / 4))
               for k in range(steps + 1)]
        for k, square in enumerate(way):
            if k == 0 or square != way[k - 1]:
                count[square] = count.get(square, 0) + 1
    return count


def covered(frame, full, z):
    """Returns whether the box around these places is in full squares."""
    n = [[int((v - frame[2 * a]) / 4) for v in c] for a, c in enumerate(zip(*z))]
    return all((x, y) in full for x in range(min(n[0]), max(n[0]) + 1) for y in range(min(n[1]), max(n[1]) + 1))


def test_full_squares():
    """Of lines that are too many to be named full squares are drawn, and nothing that they hide; all else is there."""
    chance = random.Random(8)
    places = [(chance.gauss(0, 1), chance.gauss(0, 1)) for _ in range(9000)]
    places += [(40 * chance.random() - 20, 40 * chance.random() - 20) for _ in range(60)]
    points = ''.join(f'{x:.6f} {y:.6f}\n' for x, y in places)
    text = picture('delaunay', points)
    pairs = [tuple(map(int, r.split(',')[:2])) for r in run('delaunay', '--quiet', '-', stdin=points).out.split()[1:]]
    words = ' | '.join(svg.words(text))
    assert f'legal: {len(pairs)} | 10-29 of {len(pairs)} legal pairs across a square | 30-99 | ' in words, words
    assert 'squares of legal pairs and ties hide the lines, triangles and points' in words and len(text) < 400000, words
    frame, low, high = svg.frame(text), [min(c) for c in zip(*places)], [max(c) for c in zip(*places)]
    rim = 0.04 * max(high[0] - low[0], high[1] - low[1])
    scale = (frame[1] - frame[0]) / (high[0] - low[0] + 2 * rim)
    page = [(frame[0] + (x - low[0] + rim) * scale, frame[2] + (high[1] + rim - y) * scale) for x, y in places]
    lines = [(page[i], page[j]) for i, j in pairs]
    count, drawn = crossed(frame, lines), {}
    for colour, least in (('#9cc8e2', 10), ('#5aa5d0', 30), ('#0072b2', 100), ('#004f7d', 300), ('#002c46', 1000)):
        for path in svg.paths(text):
            n = svg.numbers(path)
            if path.look.get('fill') == colour and 'stroke' not in path.look:
                for k in range(0, len(n), 8):
                    for x in range(round((n[k] - frame[0]) / 4), round((n[k + 2] - frame[0]) / 4)):
                        drawn[x, round((n[k + 1] - frame[2]) / 4)] = least
    full = {s: [e for e in (10, 30, 100, 300, 1000) if e <= n][-1] for s, n in count.items() if n >= 10}
    assert len(set(full.items()) ^ set(drawn.items())) <= len(full) / 50 and len(full) > 100, (len(full), len(drawn))
    ends = {tuple(round(v) for v in n[k:k + 4]) for p in svg.paths(text) if p.look.get('stroke') == '#0072b2'
            for n in [svg.numbers(p)] if len(n) > 4 for k in range(0, len(n), 4)}
    hidden = [covered(frame, drawn, z) for z in lines]
    for z, is_hidden in zip(lines, hidden):
        assert is_hidden or tuple(round(v) for p in z for v in p) in ends or any(
            abs(v % 1 - 0.5) < 0.02 for p in z for v in p), z
    shown = sum(p.look['d'].count('M') for p in svg.paths(text) if p.look.get('stroke') == '#0072b2' and 'id' not in p.look)
    assert abs(shown - 1 - hidden.count(False)) < 20 and hidden.count(True) > len(lines) / 2, (shown, hidden.count(False))
    ids = {p.look['id'] for p in svg.paths(text) if p.look.get('id', '').startswith('point-')}
    away = [f'point-{k}' for k, z in enumerate(page) if not covered(frame, drawn, [z])]
    assert set(away) <= ids and len(ids) < 2 * len(away) < 9000, (len(ids), len(away))


def test_few_open_lines_are_all_drawn():
    """However short they are."""
    chance = random.Random(5)
    points = ''.join(f'{chance.uniform(0, 60):.2f}+-0.02 {chance.uniform(0, 60):.2f}+-0.02\n' for _ in range(3000))
    ids = {p.look['id'] for p in svg.paths(picture('delaunay', points)) if p.look.get('id', '').startswith('pair-')}
    rows = run('delaunay', '--quiet', '-', stdin=points).out.split()[1:]
    assert ids == {'pair-{}-{}'.format(*r.split(',')) for r in rows} and sum('indet' in r for r in rows) > 200


def test_plan():
    """A line for each pair, named by the point that decides it; a label for each point, rank first, where there is room."""
    gps, globe = [*FIXES], ['--sphere', '--radius', '60km', '--columns', 'longitude,latitude', 'some.csv']
    with tempfile.TemporaryDirectory() as folder, open(f'{DATA}/airports.csv', encoding='utf-8') as f:
        pathlib.Path(folder, 'some.csv').write_text(''.join(list(f)[:40]), encoding='utf-8')
        for more in (gps, ['--discs', *gps], ['--accuracy', '3', *gps], globe):
            text = run('plan', '--quiet', '--format', 'svg', *more, cwd=folder).out
            pairs = list(csv.DictReader(run('plan', '--quiet', '--layer', 'pairs', *more, cwd=folder, comments=False).out.splitlines()))
            plan = list(csv.DictReader(run('plan', '--quiet', *more, cwd=folder, comments=False).out.splitlines()))
            said = {e.look['id'][5:]: e.title.split(': ')[1] for e in svg.elements(text) if e.look.get('id', '').startswith('pair-')}
            want = {f"{p['i']}-{p['j']}": f"decided by point {p['rank']} of the plan" if p['rank'] else 'not decided by the plan' for p in pairs}
            assert want and {k: v for k, v in said.items() if v != 'legal'} == want, more
            names = {f"{r['rank']}: {r.get('id', r['i'])}" for r in plan}
            labels = {w for w in svg.words(text) if re.fullmatch(r'\d+: \S+', w)}
            assert labels <= names and len(labels) > len(names) / 3 and (more is globe or f"1: {plan[0].get('id', plan[0]['i'])}" in labels), (labels, names)
            assert any(w.startswith(f'labels: rank: point; {len(plan)} points to measure, ') for w in svg.words(text))
    assert run('plan', '--quiet', '--format', 'svg', '-', stdin='0 0\n1 0\n0 1\n').code == 0
    expect(run('plan', '--format', 'svg', '--layer', 'pairs', '-', stdin='0 0\n1 0\n'), 2, r'\A\Z', 'does not write svg')


def test_legend_counts_once():
    """A page of a given width is laid out twice; its legend counts what is drawn once, all pairs together."""
    for points in (FIXES, ('--sphere', '--radius', '20km', '-')):
        places = ''.join(f'{k * 7 % 10} {k * 3 % 10}\n' for k in range(10))
        said = [sorted(w for w in svg.words(run('plan', '--quiet', '--format', 'svg', *size, *points, stdin=places).out) if re.search('decide|already', w))
                for size in ((), ('--width', '120mm'), ('--font-size', '20'))]
        assert said[0] == said[1] == said[2] and len(said[0]) > 2, said


def test_layers_keep_their_lines():
    """Lines without names that are all out of sight are no part of what is drawn next, such as the frame."""
    chance = random.Random(3)
    points = ''.join(f'{chance.uniform(-180, 180):.3f} {math.degrees(math.asin(chance.uniform(-1, 1))):.3f}\n' for _ in range(13500))
    text = picture('delaunay', points, '--sphere', '--window=10.001,10.002,20.001,20.002')
    assert 'legal: ' not in ' '.join(svg.words(text))
    assert max(len(svg.numbers(p)) for p in svg.paths(text) if p.look.get('stroke') == '#222222') == 8


def test_kinds_agree():
    """pdf and png of everything that svg shows."""
    for command, place in ALL:
        for kind, magic in (('pdf', r'\A%PDF'), ('png', r'\A.PNG')):
            result = run(command, '--quiet', '--format', kind, '-', *place, stdin=TWELVE, binary=True)
            assert result.code in (0, 3) and re.match(magic, result.out) and len(result.out) > 3000, (command, kind)


def lengths_of(path):
    """The ends, inner points, radii of a path of svg, and of one of TikZ, in turn."""
    arcs = re.sub(r'A(\S+) \S+ 0 [01] [01] \S+ [^A-Z]*', r'R\1 ', path)
    if 'R' in arcs:  # a circle: two arcs, of which TikZ writes one
        return [float(t) for t in re.findall(r'-?[\d.]+', re.sub(r'(R\S+ )(?=R)', '', arcs))]
    return [float(t) for t in re.findall(r'-?[\d.]+', arcs)]


def tikz(command, points, *options, place=()):
    result = run(command, '--quiet', '--format', 'tikz', *options, '-', *place, stdin=points)
    assert result.code in (0, 3), result.err
    return result.out


def test_tikz_has_the_shapes_of_svg():
    """Each path with the same numbers, in the same order, in the same colours; each text; scopes end."""
    for command, place in ALL:
        if command == 'bisector':
            continue  # its curves go far: below
        text, other = tikz(command, TWELVE, place=place), picture(command, TWELVE, place=place)
        drawn = [lengths_of(re.sub(r'arc\[start angle=\S+?,end angle=\S+?,radius=(\S+?)\]', r' \1 ', line))
                 for line in re.findall(r'^\\(?:fill|draw|filldraw) (.*);$', text, re.M)]
        shown = [lengths_of(p.look['d']) for p in svg.paths(other)]
        assert drawn == shown and len(drawn) > 20, (command, [x for x in zip(drawn, shown) if x[0] != x[1]][:2])
        assert text.count(r'\begin{scope}') == text.count(r'\end{scope}') > 2
        assert re.findall(r'\] at \(.*?\) \{(.*)\};$', text, re.M) == [re.sub(r'([\\{}$&#_%])', r'\\\1', w) for w in svg.words(other)]
        colours = {p.look['stroke'] for p in svg.paths(other) if 'stroke' in p.look} - {'none'}
        assert {'#%02x%02x%02x' % tuple(map(int, c)) for c in re.findall(r'draw=\{rgb,255:red,(\d+);green,(\d+);blue,(\d+)\}', text)} == colours


def test_tikz_is_within_the_lengths_of_tex():
    """Whatever is far, all is within 16000 points, and what a page shows of it is the same."""
    for points in ('[0,2] [0,1]\n[5,7] [4,5]\n', '0 0\n1 1e-9\n2 0\n3 5\n', '0 0\n1 1e-4\n2 0\n3 5\n', '[0,1] 0\n[1e7,2e7] 1\n0 3\n'):
        for command in ('bisector', 'voronoi', 'disc')[:3 if points.count('\n') > 2 else 2]:
            text = tikz(command, points, '--width', '12cm')
            assert max(abs(float(t)) for z in re.findall(r'\((-?[\d.]+),(-?[\d.]+)\)|radius=([\d.]+)', text) for t in z if t) < 16000, (command, points)
    cubic = picture('bisector', '[0,2] [0,1]\n[5,7] [4,5]\n')
    left, right, top, bottom = svg.frame(cubic)
    ends = {tuple(n[k:k + 2]) for p in svg.paths(cubic) if p.look.get('id', '').startswith('arc-') for n in [svg.numbers(p)] for k in (0, len(n) - 2)}
    found = {(float(x), float(y)) for x, y in re.findall(r'\((\S+?),(\S+?)\)', tikz('bisector', '[0,2] [0,1]\n[5,7] [4,5]\n'))}
    near = {e for e in ends if left <= e[0] <= right and top <= e[1] <= bottom}
    assert len(near) >= 10 and near <= found, near - found


def test_tikz_escapes():
    points = 'x,y,n\n0,0,50% & $1_a^2~#{\\\n9,0,<b>\n0,9,c\n'
    text = tikz('delaunay', points, '--columns', 'x,y', '--id', 'n')
    assert r'{50\% \& \$1\_a\textasciicircum{}2\textasciitilde{}\#\{\textbackslash{}};' in text and r'{\textless{}b\textgreater{}};' in text


def test_sizes():
    """--width is that of all, --font-size of texts, in points; --bare leaves the frame alone."""
    for command, place in ALL:
        for options, width, size in ((('--width', '4in'), 288, 7), (('--width', '72.5mm'), 205.51, 7), (('--width', '1600'), 1600, 20), (('--width', '254mm', '--font-size', '12'), 720, 12),
                                     (('--font-size', '7'), None, 7), (('--font-size', '21pt'), None, 21)):
            text = picture(command, TWELVE, *options, place=place)
            head = re.search(r'width="([\d.]+)(pt)?" height="([\d.]+)(pt)?" viewBox="(\S+) (\S+) (\S+) (\S+)"', text)
            scale = float(head[1]) / float(head[7])
            assert width is None or (head[2] and abs(float(head[1]) - width) < 0.02), (command, options, head[0])
            legend = [e for e in svg.elements(text) if e.tag == 'text' and 'units of' in (e.text or '')][0]
            assert abs(float(legend.look['font-size']) * scale - size) < 0.06 or (size == 20 and scale > 1), (command, options)
            low, high = float(head[6]), float(head[6]) + float(head[8])
            assert all(low < float(e.look['y']) < high for e in svg.elements(text) if e.tag == 'text'), (command, options)
            big, end = float(legend.look['font-size']), float(legend.look['x']) - 0.45 * float(legend.look['font-size']) * len(legend.text)
            assert not any(e.text != legend.text and e.look['font-size'] == legend.look['font-size'] and abs(float(e.look['y']) - float(legend.look['y'])) < 0.7 * big
                           and float(e.look['x']) + 0.45 * big * len(e.text) > end for e in svg.elements(text) if e.tag == 'text'), (command, options)
            assert all(float(e.look['x']) >= float(head[5]) for e in svg.elements(text) if e.tag == 'text')
        bare = picture(command, TWELVE, '--bare', '--width', '85mm', place=place)
        left, right, top, bottom = svg.frame(bare)
        view = [float(v) for v in re.search(r'viewBox="(.*?)"', bare)[1].split()]
        assert view == [left, top, right - left, bottom - top] and all(NUMBER.match(re.sub(r'\A\d+: ', '', w) if command == 'plan' else w) for w in svg.words(bare)), command
    expect(run('delaunay', '--format', 'svg', '--width', '40', '-', stdin=TWELVE), 1, r'\A\Z', 'no room beside texts')
    expect(run('delaunay', '--width', '40mm', '-', stdin=TWELVE), 2, r'\A\Z', 'about pictures; give -o')
    text = picture('delaunay', TWELVE, '--font', 'A "b" <c>')
    assert 'font-family="A &quot;b&quot; &lt;c&gt;"' in text and svg.words(text)
    assert r'\fontfamily{phv}\selectfont' in tikz('delaunay', TWELVE, '--font', 'phv')


def test_pgf_has_the_bounds_of_the_table():
    points = 'sqrt(2) 0\n0 sqrt(3)\n2 2\nsqrt(5) e\n'
    for of, names in (('delaunay', 'area hausdorff width_largest width_median'), ('voronoi', 'area hausdorff v_area v_hausdorff width_largest width_median'),
                      ('disc', 'area hausdorff width_largest width_median')):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, 'run.pgf')
            table = run('converge', '-', '--of', of, '--step-bits', '5', '--until', 'area:20', '--quiet', '--pgf', str(file), '--plot', str(file) + '.pgf', stdin=points, comments=False)
            text = file.read_text(encoding='utf-8')
            assert text == pathlib.Path(str(file) + '.pgf').read_text(encoding='utf-8')
        rows = list(csv.DictReader(table.out.splitlines()))
        curves = re.findall(r'addplot coordinates \{(.*)\};\n\\addlegendentry', text)
        assert len(curves) == len(names.split()) and len(rows) > 3
        for name, curve in zip(names.split(), curves):
            assert re.findall(r'\((\d+),(\S+?)\)', curve) == [(r['bits_most'], r[name]) for r in rows if r[name] not in ('', '0')], (of, name)


def test_latex():
    """A document with every picture is set without an error, where there is LaTeX."""
    if not shutil.which('pdflatex'):
        return
    with tempfile.TemporaryDirectory() as folder:
        parts = []
        for command, place in ALL:
            parts.append(f'{command}.tikz')
            pathlib.Path(folder, parts[-1]).write_text(tikz(command, TWELVE, '--width', '8cm', place=place), encoding='utf-8')
        body = '\n\n'.join(f'\\input{{{p}}}' for p in parts)
        pathlib.Path(folder, 'all.tex').write_text(f'\\documentclass{{article}}\\usepackage{{tikz}}\\begin{{document}}\n{body}\n\\end{{document}}\n', encoding='utf-8')
        done = subprocess.run(['pdflatex', '-interaction=nonstopmode', '-halt-on-error', 'all.tex'], cwd=folder, stdout=subprocess.PIPE, check=False)
        assert done.returncode == 0, done.stdout[-2000:]


main(globals())
