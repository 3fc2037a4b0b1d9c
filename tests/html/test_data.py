# SPDX-License-Identifier: LGPL-3.0-or-later
"""What a page holds is what csv, json and converge say, stage by stage, for any input; and nothing of it can run."""
import base64
import collections
import csv
import fractions
import hashlib
import json
import pathlib
import re

import pages
from pages import harness


def same_as_csv(*args):
    content = pages.data(pages.page('delaunay', *args))
    assert pages.statuses(content)[-1] == pages.csv_pairs('delaunay', *args)
    return content


def test_statuses():
    for text in pages.TWELVE, pages.SLOW, '', '1 1\n', '0 0\n1 0\n2 0\n', '[0,1] [0,1]\n' * 5, '1e300 0\n-1e300 1\n0 1e-300\n':
        same_as_csv(pages.points(text))
    same_as_csv('--radius', '0.01', *pages.PLACES)
    same_as_csv(*pages.FIXES)
    same_as_csv('--discs', *pages.FIXES)


def triangles(content):
    """By rows."""
    rows, list_, first, out = [p['i'] for p in content['points']], content['triangles'], 0, []
    for a, b, c in zip(list_[::3], list_[1::3], list_[2::3]):
        first += a
        out.append([rows[first], rows[first + b], rows[first + c]])
    return out


def test_sites():
    for args in [pages.points(pages.TWELVE)], ['--radius', '0.01', *pages.PLACES]:
        content, truth = same_as_csv(*args), json.loads(harness.run('delaunay', *args, '--format', 'json', '-q').out)
        alias = {a for a, _ in truth['aliases']}
        sites = [s for s in truth['sites'] if s['i'] not in alias]
        keys = 'i', 'x', 'y', 'hull', 'id'
        assert [[p.get(k) for k in keys] for p in content['points']] == [[s.get(k) for k in keys] for s in sites]
        assert content['aliases'] == truth['aliases'] and content['outcome'] == truth['outcome']
        assert triangles(content) == truth['triangles']


def test_sphere():
    """Statuses, places and triangles of csv and json; points at poles and across the meridian of 180 degrees; a tie."""
    octahedron = '0 0\n90 0\n180 0\n270 0\n0 90\n0 -90\n360 0\n45 30\n1/3 sqrt(2)\n'
    square = '1 1\n-1 1\n1 -1\n-1 -1\n180 0\n'
    for args in [pages.points(octahedron)], [pages.points(square)], [pages.points('')], ['--radius', '300m', *pages.PLACES]:
        content = same_as_csv('--sphere', *args)
        truth = json.loads(harness.run('delaunay', '--sphere', *args, '--format', 'json', '-q').out)
        alias = {a for a, _ in truth['aliases']}
        assert [[p.get(k) for k in ('i', 'x', 'y', 'id')] for p in content['points']] == [
            [s.get(k) for k in ('i', 'x', 'y', 'id')] for s in truth['sites'] if s['i'] not in alias]
        assert triangles(content) == truth['triangles'] and content['aliases'] == truth['aliases']
        assert (content['surface'], content['layer'], len(content['stages'])) == ('sphere', 'pairs', 1)
    for layer in 'points', 'triangles':
        assert pages.data(pages.page('delaunay', '--sphere', '--layer', layer, pages.points(square)))['layer'] == layer
    harness.expect(harness.run('voronoi', '--sphere', '--format', 'html', pages.points(square)), 2,
                   err='voronoi --sphere does not write html; give csv, json')


def test_graphs():
    """Certain edges look like legal ones, possible ones like indeterminate; each once, in whichever direction it is
    nearest."""
    as_pairs = {'certain': 'legal', 'possible': 'indeterminate'}
    for graph in 'nearest', 'gabriel', 'mst':
        for args in pages.FIXES, [pages.points(pages.TWELVE)], ['--radius', '0.01', *pages.PLACES], [pages.points('')]:
            edges = {}
            for (i, j), status in pages.csv_pairs('delaunay', '--layer', 'graph:' + graph, *args).items():
                pair = min(i, j), max(i, j)
                edges[pair] = 'legal' if 'legal' in (edges.get(pair), as_pairs[status]) else 'indeterminate'
            content = pages.data(pages.page('delaunay', '--layer', 'graph:' + graph, *args, codes=(0, 3, 4)))
            assert pages.statuses(content)[-1] == edges and not content['triangles'] and 'tolerance' not in content
            assert content['graph'] in ('nearest neighbours', 'Gabriel graph', 'minimum spanning tree')


def converge_rows(*args):
    text = harness.run('converge', *args, '--no-times', '-q').out
    return list(csv.DictReader(line for line in text.splitlines() if not line.startswith('#')))


def counts(stages):
    return [[collections.Counter(stage.values())[s] for s in ('legal', 'indeterminate', 'tie')] for stage in stages]


def test_stages():
    file = pages.points(pages.SLOW)
    content = same_as_csv(file, *pages.STEPS)
    stages, rows = pages.statuses(content), converge_rows(file, *pages.STEPS)
    assert len(rows) > 5 and counts(stages) == [[int(r[s]) for s in ('legal', 'indeterminate', 'tie')] for r in rows]
    for before, after in zip(stages, stages[1:]):  # nothing is taken back
        assert after.keys() <= before.keys()
        assert all(before[pair] in ('indeterminate', status) for pair, status in after.items())


def boxes(content):
    """Of each point after each stage: x lower, x upper, y lower, y upper; None: as in the end."""
    now, out = [None] * len(content['points']), []
    for stage in content['stages']:
        for k in range(0, len(stage['boxes']), 5):
            now[stage['boxes'][k]] = stage['boxes'][k + 1:k + 5]
        for k in stage['final']:
            now[k] = None
        out.append(list(now))
    return out


def exact(text):
    man, _, exp = text.partition('*2^')
    return fractions.Fraction(man) * fractions.Fraction(2) ** int(exp or 0)


def test_boxes():
    """Boxes shrink, hold those after them, and are what the trace says."""
    file = pages.points(pages.SLOW)
    content = pages.data(pages.page('delaunay', file, *pages.STEPS))
    trace = pathlib.Path(file).with_name('trace')
    harness.run('converge', file, *pages.STEPS, '-q', '--trace', str(trace))
    told, found = [], {}
    for line in map(json.loads, trace.read_text(encoding='utf-8').splitlines()):
        if 'point' in line:
            found[line['point']] = [exact(t) for t in line['x'] + line['y']]
        if line.get('done'):
            told.append(dict(found))
    stages = boxes(content)
    assert len(stages) == len(told) and any(b for stage in stages[:-1] for b in stage)
    last = [[exact(t) for t in p['x'] + p['y']] for p in content['points']]
    for stage, truth in zip(stages, told):
        for k, box in enumerate(stage):
            box = last[k] if box is None else [fractions.Fraction(v) for v in box]
            for e in range(4):
                off = box[e] - truth[k][e] if e & 1 else truth[k][e] - box[e]
                assert 0 <= off <= abs(truth[k][e]) * fractions.Fraction(1, 10 ** 15), (k, e)
    assert not any(stages[-1])


def test_converge():
    """The table of json is in the page, and the stages are its rows."""
    file = pages.points(pages.SLOW)
    for more in [], ['--window', '0,1,0,2'], ['--of', 'voronoi', '--until', 'hausdorff:8']:
        args = ['converge', file, *pages.STEPS, '--no-times', *more]
        content = pages.data(pages.page(*args))
        assert content['convergence'] == json.loads(harness.run(*args, '--format', 'json', '-q').out)
        if '--window' not in more:
            rows = content['convergence']['stages']
            assert counts(pages.statuses(content)) == [[r[s] for s in ('legal', 'indeterminate', 'tie')] for r in rows]
    trace = pathlib.Path(file).with_name('trace')
    harness.run('converge', file, *pages.STEPS, '-q', '--trace', str(trace))
    harness.expect(harness.run('converge', '--replay', str(trace), '--format', 'html'), 2, err='run converge on them')


def places(content, steps):
    at, out = [0, 0], []
    for k, step in enumerate(steps):
        at[k & 1] += step
        out.append(fractions.Fraction(content['origin'][k & 1]) + at[k & 1] * fractions.Fraction(2) ** content['unit'])
    return out


def same_polygon(content, steps, truth):
    """Within half a unit, and what doubles are off."""
    ends = [exact(text) for point in truth for text in point]
    near = [abs(a - b) for a, b in zip(places(content, steps), ends)]
    assert len(steps) == len(ends) and max(near, default=0) <= fractions.Fraction(2) ** content['unit'] * fractions.Fraction(501, 1000)


def test_diagram():
    for args in [pages.points(pages.TWELVE)], pages.FIXES, ['--window', '100,200,50,150', *pages.FIXES], [pages.points(pages.SLOW), *pages.STEPS]:
        content = pages.data(pages.page('voronoi', *args))
        truth = json.loads(harness.run('voronoi', *args, '--format', 'json', '-q').out)
        cells = [c for c in truth['cells'] if c['x'] is not None]
        assert [c['i'] for c in content['cells']] == [c['i'] for c in cells] and cells
        for found, cell in zip(content['cells'], cells):
            assert (found['area'], found['undetermined']) == (cell['area'], cell['undetermined'])
            same_polygon(content, found['inner'], cell['inner'])
            for one, other in zip(found['outer'], cell['outer'], strict=True):
                same_polygon(content, one, other)
        wide = max(exact(content['window'][k + 1]) - exact(content['window'][k]) for k in (0, 2))
        assert fractions.Fraction(2) ** content['unit'] <= max(fractions.Fraction(2) ** (-content['flatten_bits'] - 2), wide / 2 ** 43)
        bounds = truth['bounds']
        assert all(content[k] == bounds[k] for k in ('undetermined_area', 'distance_to_true_diagram'))
        assert content['regions'] == [r for r in truth['regions'] if r['x'] is not None]
        assert {tuple(v['sites']) for v in content['vertices']} <= {tuple(v['sites']) for v in truth['vertices']}
        assert content['outcome'] == truth['outcome'] and len(content['edges']) % 4 == 0


def test_tiles():
    """The rings of json."""
    area = pages.points('POLYGON ((1 1, 9 1, 9 9, 1 9, 1 1), (4 4, 4.1 5, 5 4, 4 4))', 'area.wkt')
    for more in [], ['--clip-to', area]:
        args = [pages.points(pages.TWELVE), '--layer', 'tiles', *more]
        content = pages.data(pages.page('voronoi', *args))
        truth = json.loads(harness.run('voronoi', *args, '--format', 'json', '-q').out)['tiles']
        assert content['layer'] == 'tiles' and [c['i'] for c in content['cells']] == [c['i'] for c in truth] and truth
        for found, tile in zip(content['cells'], truth):
            assert (found['area'], found['tile_area'], found['inner']) == (tile['area'], tile['tile_area'], [])
            for steps, ring in zip(found['outer'], tile['rings'], strict=True):
                same_polygon(content, steps, [[str(v) for v in z] for z in ring])


def test_window():
    """As many lines as the picture of that window counts."""
    for window in '-80,-70,38,44', '-100,-99,30,30.5':
        args = ['--radius', '0.01', '--window', window, *pages.PLACES]
        content = pages.data(pages.page('delaunay', *args))
        picture = harness.run('delaunay', *args, '--format', 'svg', '-q').out
        for status, count in counts_of(content).items():
            assert f'{status}: {count}<' in picture, (status, count)
        assert 0 < len(content['points']) < content['sites'] == 3376


def counts_of(content):
    return collections.Counter(pages.statuses(content)[-1].values())


def test_limit():
    side = 330  # a lattice: 4 pairs a point, half of them ties
    file = pages.points(''.join(f'{x} {y}\n' for x in range(side) for y in range(side)))
    harness.expect(harness.run('delaunay', file, '--format', 'html', '-q'), 1, err=r'at most 300000 pairs.*--window XLO')
    harness.expect(harness.run('delaunay', file, '--format', 'html', '-q', '--window', '-1,329,-1,329'), 1, err='a smaller --window')
    content = pages.data(pages.page('delaunay', file, '--window', '10.5,20.5,10.5,20.5'))
    assert counts_of(content)['tie'] == 2 * 11 * 11 and content['sites'] == side * side


def test_layers():
    file = pages.points(pages.TWELVE)
    for command, layers in ('delaunay', ('pairs', 'points', 'triangles')), ('voronoi', ('cells', 'vertices', 'regions', 'edges', 'tiles')):
        for layer in layers:
            assert pages.data(pages.page(command, file, '--layer', layer))['layer'] == layer


def test_tolerance():
    """Of exact points only; rounded down."""
    file = pages.points('0 0\n3 0\n1 2\n4 4\n')
    content = pages.data(pages.page('delaunay', file))
    lines = harness.run('tolerance', file, '--layer', 'points').out.splitlines()
    truth = [float(line.split(',')[1]) for line in lines if line[0].isdigit()]
    for point, rho in zip(content['points'], truth):
        assert rho * (1 - 1e-5) <= point['rho'] <= rho
    assert len(truth) == 4 and content['tolerance'][0] > 0
    assert 'rho' not in pages.data(pages.page('delaunay', pages.points(pages.TWELVE)))['points'][0]


def test_plan():
    """The page of a plan has what json has, and the statuses of delaunay; on the globe, too."""
    globe = ['--sphere', '--radius', '60km', pages.points('10 50\n11 51\n13 50.3\n11.2 49\n12 52\n14.1 51.2\n9 51\n', 'globe.txt')]
    for args in pages.FIXES, ['--discs', *pages.FIXES], ['--accuracy', '3', *pages.FIXES], globe:
        page, whole = pages.data(pages.page('plan', *args)), json.loads(harness.run('plan', '--format', 'json', '--quiet', *args).out)
        assert page['kind'] == 'plan' and page['plan']['finished'] is True
        assert page['plan']['pairs'] == [[p['i'], p['j'], p['rank'] or 0] for p in whole['pairs']]
        assert page['plan']['points'] == [[p[k] for k in ('i', 'half_width_now', 'half_width_needed', 'pairs_decided', 'pairs_left')] for p in whole['points']]
        assert pages.statuses(page)[-1] == pages.csv_pairs('delaunay', *(a for a in args if a not in ('--accuracy', '3')))


def test_names_do_not_run():
    """A name cannot leave the data, whatever is in it."""
    names = ['</script><script>seize()</script>', '<img src=x onerror=seize()>', '&amp;"\'', 'Zürich']
    file = pages.points('id,x,y\n' + ''.join('"%s",%d,%d\n' % (n.replace('"', '""'), k, k * k) for k, n in enumerate(names)), 'a.csv')
    path = pages.page('delaunay', '--columns', 'x,y', '--id', 'id', file)
    assert [p['id'] for p in pages.data(path)['points']] == names
    assert 'seize()' not in pathlib.Path(path).read_text(encoding='utf-8')


def test_policy():
    """The policy allows this script and this style, and no request."""
    text = pathlib.Path(pages.page('delaunay', pages.points('0 0\n'))).read_text(encoding='utf-8')
    policy, = re.findall(r'http-equiv="Content-Security-Policy" content="([^"]*)"', text)
    parts = dict(part.strip().split(' ', 1) for part in policy.split(';'))
    for tag, what in ('script', 'script-src'), ('style', 'style-src'):
        body, = re.findall(f'<{tag}>(.*?)</{tag}>', text, re.S)
        digest = base64.b64encode(hashlib.sha256(body.encode()).digest()).decode()
        assert parts.pop(what) == f"'sha256-{digest}'"
    assert parts == {'default-src': "'none'", 'img-src': 'data:', 'base-uri': "'none'", 'form-action': "'none'"}
    assert not re.findall(r'(?:src|href)="(?!data:)|url\(|@import|https?://(?!www\.w3\.org)', text)


def test_size():
    size = pathlib.Path(pages.page('delaunay', '--radius', '0.01', *pages.PLACES)).stat().st_size
    print(f'airports, --radius 0.01, with names: {size} bytes')
    assert size <= 400_000


def test_refusals():
    file = pages.points('1e400 0\n0 1\n1 1\n')
    harness.expect(harness.run('delaunay', file, '--format', 'html', '-q'), 1, err='beyond the largest double')
    harness.expect(harness.run('nearest', file, '0', '0', '--format', 'html'), 2, err='does not write html')
    harness.expect(harness.run('delaunay', file, '--format', 'svg', '-o', 'a.html'), 2, err='html')


if __name__ == '__main__':
    harness.main(globals())
