#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Data as people have it: separated text of every dialect, columns by name and number, radii and identifiers in columns,
missing and repeated points, packed files. The same points give the same bytes, whatever dress they come in.

Usage: test_input.py COMMAND DATA
"""
import csv
import gzip
import io
import json
import os
import re
import shutil
import subprocess
import tempfile
from fractions import Fraction

from harness import COMMAND, DATA, count, expect, main, run

AIRPORTS = os.path.join(DATA, 'airports.csv')
PLACE = ('--plane', '--columns', 'longitude,latitude')


def airports():
    with open(AIRPORTS, encoding='utf-8', newline='') as f:
        return list(csv.reader(f))


def dressed(rows, change=lambda name, text: text, **dialect):
    """The rows as bytes of a dialect, each field behind the header changed."""
    out = io.StringIO()
    writer = csv.writer(out, **dialect)
    for k, row in enumerate(rows):
        writer.writerow([change(name, text) if k else text for name, text in zip(rows[0], row)])
    return out.getvalue().encode()


def comma(name, text):
    return text.replace('.', ',') if name in ('longitude', 'latitude') else text


def packed(text):
    """Names of the installed packers, with the bytes packed by each."""
    yield 'gzip', gzip.compress(text)
    yield 'gzip in pieces', gzip.compress(text[:50000]) + gzip.compress(b'') + gzip.compress(text[50000:])
    yield 'gzip and zeros', gzip.compress(text) + bytes(5000)
    zstd = shutil.which('zstd')
    if zstd:
        def pack(piece, *options):
            return subprocess.run([zstd, '-q', '-c', *options], input=piece, stdout=subprocess.PIPE, check=True).stdout
        yield 'zstd', pack(text)
        yield 'zstd, long', pack(text, '-19', '--long=27')
        yield 'zstd in pieces', pack(text[:70000]) + b'\x5f\x2a\x4d\x18\x03\0\0\0abc' + pack(text[70000:])


def test_dialects():
    rows = airports()
    plain = run('delaunay', '-q', *PLACE, AIRPORTS)
    expect(plain, 0)
    assert len(plain.out) > 100000
    crlf = {'lineterminator': '\r\n'}
    for text, options in ((dressed(rows, delimiter=';'), ()), (dressed(rows, delimiter='\t'), ()),
                          (dressed(rows, delimiter='|', **crlf), ()), (dressed(rows, delimiter='^'), ('--delimiter', '^')),
                          (dressed(rows, delimiter='\t'), ('--delimiter', 'tab')),
                          (dressed(rows, delimiter='\t'), ('--delimiter', '\\t')),
                          (dressed(rows, comma, delimiter=';'), ('--decimal-comma',)),
                          (dressed(rows, comma, delimiter='\t'), ('--decimal-comma',)),
                          (dressed(rows, comma), ('--decimal-comma',)), (b'\xef\xbb\xbf' + dressed(rows, delimiter=';'), ())):
        assert run('delaunay', '-q', *PLACE, *options, '-', stdin=text) == plain, text[:60]
    for columns in ('LONGITUDE,Latitude', '7,6', ' longitude , 6', '"longitude",latitude'):
        assert run('delaunay', '-q', '--columns', columns, AIRPORTS) == plain, columns
    for name, text in packed(dressed(rows)):
        assert run('delaunay', '-q', *PLACE, '-', stdin=text) == plain, name
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, 'points'), 'wb') as f:
                f.write(text)
            assert run('delaunay', '-q', *PLACE, 'points', cwd=folder) == plain, name


def test_packed_points_file():
    text = ''.join(f'{k % 17}.{k} {k * k % 101} # {k}\n' for k in range(40000)).encode()
    plain = run('delaunay', '-q', '-', stdin=text)
    for name, data in packed(text):
        assert run('delaunay', '-q', '-', stdin=data) == plain, name
        for damaged in (data[:-9], data[:len(data) // 2]):
            if 'zeros' not in name:
                expect(run('delaunay', '-', stdin=damaged), 1, r'\A\Z', r'data (end early|are damaged).*; fetch or pack')
        middle = len(data) // 3
        damaged = data[:middle] + bytes(40) + data[middle + 40:]
        expect(run('delaunay', '-', stdin=damaged), 1, r'\A\Z', 'dyadel: -')
    expect(run('delaunay', '-', stdin=gzip.compress(b'0 0\n') + b'garbage'), 1, '', 'are followed by something else')
    for data, what in ((b'PK\3\4......', 'a zip archive or a spreadsheet; save it as CSV'), (b'BZh91AY', 'unpack it'),
                       (b'\xfd7zXZ\0', 'unpack it'), ('1 2\n'.encode('utf-16'), 'UTF-16; save it as UTF-8')):
        expect(run('delaunay', '-', stdin=data), 1, r'\A\Z', r'\Adyadel: -: the file is .*' + what)


# Options and text; the exit status and the message.
REFUSED = [
    ('--columns lon,lat', 'id;x;y\na;1;2\n', 1, r'-:1:1: no column is called "lon"; the header\'s names are: id, x, y; '
     r'give one of these, or its number, to --columns$'),
    ('--columns x,y --id name', 'id,x,y\n', 1, r'-:1:1: no column is called "name"; .*, to --id$'),
    ('--columns x,y --radius-column r', 'id,x,y\n', 1, r'-:1:1: no column is called "r"; .*, to --radius-column$'),
    ('--columns x,y', 'x^y\n1^2\n', 1, r'-:1:1: the header is one column, "x\^y", .*: --delimiter C$'),
    ('--columns x,y', 'X,x,y\n1,2,3\n', 0, ''),
    ('--columns X,y', 'X,x,y\n1,2,3\n', 0, ''),
    ('--columns Xx,y', 'XX,xx,y\n1,2,3\n', 1, r'-:1:4: 2 columns are called "Xx" but for capitals; write the name as'),
    ('--columns 1,4', 'a,b,c\n1,2,3\n', 1, r'-:1:1: there is no column 4; the header has 3, counted from 1$'),
    ('--columns 0,1', 'a,b,c\n1,2,3\n', 1, r'-:1:1: there is no column 0'),
    ('--columns 1,2', '0,1,2\n1,2,3\n', 1, r'-:1:3: 1 is the name of column 2: .*: --columns \'"1"\'; for column 1, give its'),
    ('--columns "1","2"', '0,1,2\n1,2,3\n', 0, ''),
    ('--columns 1,2', '4.5,5\n1,2\n', 1, r'-:1:1: the first line holds numbers, not the names of columns; where .* --no-header, '),
    ('--columns x,y', 'x;y\n47,61;8\n', 1, r'-:2:3: .*; where commas are decimal points, give --decimal-comma$'),
    ('--columns x,y', 'x;y\n1;2;3\n', 1, r'-:2:1: this record has 3 fields, the header 2; quote fields that hold semicolons$'),
    ('--columns x,y', 'x,y\n1,\n', 1, r'-:2:3: the coordinate is empty; fill it in, or .*: --skip-missing$'),
    ('--columns x,y', 'x,y\n1,2\nNA,3\n', 1, r'-:3:1: the coordinate is missing \(NA\); .*: --skip-missing$'),
    ('--columns x,y --radius-column r', 'x,y,r\n1,2,null\n', 1, r'-:2:5: the radius is missing \(null\)'),
    ('--columns x,y --radius-column r', 'x,y,r\n1,2,-1\n', 1, r"-:2:5: the radius is negative; .* --missing '-1' --skip-missing$"),
    ('--columns x,y --radius-column r', 'x,y,r\n1,2,-x\n', 1, r'-:2:5: the radius is not an exact number >= 0; give one'),
    ('--columns x,y --radius-column r --sphere', 'x,y,r\n1,2,-1.5m\n', 1, r"-:2:5: the radius is negative; .* --missing '-1.5m' --skip-missing$"),
    ('--columns x,y --radius-column r,s,t', 'x,y,r\n', 2, r'"r,s,t" is not one or two column names; give NAME or NAME,NAME$'),
    ('--columns x,y --id a,b', 'x,y,r\n', 2, r'"a,b" is not one column name; give NAME$'),
    ('--columns x,y --delimiter ;;', 'x,y,r\n', 2, r'";;" cannot be a delimiter; give one character'),
    ('--id name', '1 2\n', 2, r'--id is about columns; name those of x and y, too: --columns NAME,NAME$'),
    ('--radius-column r', '1 2\n', 2, r'--radius-column is about columns'),
    ('--delimiter ;', '1 2\n', 2, r'--delimiter is about columns'),
    ('', 'id;x;y\na;1;2\n', 1, r'-:1:1: this line is a header and no point; name the columns of x and y: --columns x,y \(it has: id, x, y\)$'),
    ('', 'id\tx\ty\na\t1\t2\n', 1, r'-:1:1: this line is a header and no point; name the columns of x and y: --columns x,y \(it has: id, x, y\)$'),
    ('', 'id,rechts,"c d"\na,1,2\n', 1, r"-:1:1: .*: --columns 'rechts,c d' "),
    ('', 'id,a,"b,c"\na,1,2\n', 1, r"""-:1:1: .*: --columns 'a,"b,c"' """),
    ('', 'stop_lat,name,stop_lon\n1,a,2\n', 1, r'-:1:1: .*: --columns stop_lon,stop_lat '),
    ('', 'id,a,b\np,q,r\n', 1, r'-:1:\d+: more than two .*: --columns X,Y \(it has: id, a, b\)$'),
    ('', 'sqrt2 pie\n1 2\n', 1, r"-:1:1: the name 'sqrt2' is unknown; .*; if this line is a header, .*: --columns sqrt2,pie "),
    ('', '1 2\nNA 3\n', 1, r'-:2:1: the coordinate is missing \(NA\)'),
]


def test_comments_before_the_header():
    """Lines of # are passed over, as in what dyadel writes; one with the columns is the header, also where one is mistyped."""
    own = run('delaunay', '--layer', 'points', '-', stdin='0 0\n0 0\n10 0\n0 10\n').out
    assert own.startswith('# alias 1 0\n# rounding: ')
    want = run('delaunay', '-', stdin='0 0\n0 0\n10 0\n0 10\n').out
    expect(run('delaunay', '--columns', 'xlo,ylo', '-', stdin=own), 0, re.escape(want))
    mark = '\ufeff# of today; in metres, east and north\r\n\r\n'
    for columns in ('e,n', '2,3'):
        for begin in ('', mark, mark + '# x\n'):
            expect(run('delaunay', '--columns', columns, '-', stdin=begin + '#id,e,n\n7,0,0\n8,1,0\n9,0,1\n'), 0, r'\A(.*\n){4}\Z')
    expect(run('delaunay', '--columns', 'e,nn', '-', stdin='# x\n#id,e,n\n7,0,0\n'), 1, r'\A\Z', r'-:2:2: no column is called "nn"; the header\'s names are: id, e, n')
    expect(run('delaunay', '--columns', 'e,nn', '-', stdin='# x\nid,e,n\n7,0,0\n'), 1, r'\A\Z', r'-:2:1: no column is called "nn"; the header\'s names are: id, e, n')
    expect(run('delaunay', '--columns', 'e,n', '-', stdin='# x\n# y\n'), 1, r'\A\Z', '-:1:1: the file has no header')
    expect(run('delaunay', '--columns', 'e,n', '-', stdin='e,n\n0,0\n#1,2\n% 3,x\n4,5\n'), 0, r'\A(.*\n){2}\Z', 'begin with # or % and may be rows: 1; ')


def test_refusals():
    for options, text, code, message in REFUSED:
        try:
            expect(run('delaunay', *options.split(), '-', stdin=text), code, '', r'\Adyadel: ' + message if message else r'\A\Z')
        except AssertionError as problem:
            raise AssertionError(f'{options} {text!r}: {problem}') from problem


def test_missing():
    """Skipped rows count in the numbers of the others."""
    rows = airports()
    gaps = {4: 'NA', 11: '', 12: 'NaN', 100: 'null', 3376: '-nan'}
    for row, text in gaps.items():
        rows[row][5 + row % 2] = text
    whole = run('delaunay', *PLACE, '--skip-missing', '-', stdin=dressed(rows))
    expect(whole, 0, '', r'\Adyadel: -: 5 of 3376 rows are skipped because .*; the others keep their numbers\n\Z')
    expect(run('delaunay', *PLACE, '--skip-missing', '-q', '-', stdin=dressed(rows)), 0, '', r'\A\Z')
    kept = [k for k in range(3376) if k + 1 not in gaps]
    less = run('delaunay', *PLACE, '-', stdin=dressed([rows[0]] + [rows[k + 1] for k in kept]))
    body = less.out.split('i,j,status\n')[1]
    numbers = re.sub(r'(?m)^(\d+),(\d+)', lambda m: f'{kept[int(m[1])]},{kept[int(m[2])]}', body)
    assert whole.out.endswith('i,j,status\n' + numbers)
    result = run('delaunay', '--skip-missing', '-', stdin='NA 0\n0 0\n1 nan\n4 0\n0 4\n')
    assert result.out == 'i,j,status\n1,3,legal\n1,4,legal\n3,4,legal\n', result.out
    expect(run('nearest', '--skip-missing', '-', '3', '0', stdin='NA 0\n0 0\n4 0\n'), 0, '^2,certain,1,1$')
    expect(run('disc', '--skip-missing', '-', stdin='0 0\nNA 0\n4 0\n0 4\n1 1\n'), 0,
           r'# orientation of 0 2 3: counter(.|\n)*^FFC,2,2,8,')
    expect(run('delaunay', '--skip-missing', '-', stdin='NA 0\n0 log(0-pi)\n'), 1, '', r'-:2:3: ')
    expect(run('delaunay', '--skip-missing', '--max-bits', '64', '-', stdin='NA 0\n0 0\n0 1/sin(pi)\n'), 1, '',
           r'-:3:4: point 2: ')


NAMED = 'name;x;y;r;who\na;0;0;0,25;"Anna; ""A"""\nb;NA;0;0,5;Bob\nc;8;0;1/8;Käthe\nd;8;0;0,5;\ne;0;8;0;x,y\n'
NAMES = ('--columns', 'x,y', '--radius-column', 'r', '--id', 'who', '--decimal-comma', '--skip-missing', '--merge', '-q')


def number(text):
    """"m*2^e", "p/q"."""
    m = re.fullmatch(r'(-?\d+)\*2\^(-?\d+)', text)
    return int(m[1]) * Fraction(2) ** int(m[2]) if m else Fraction(text)


def sides(text):
    """Of json: the exact rectangles, by row."""
    return {s['i']: tuple(float(number(end)) for side in 'xy' for end in s[side]) for s in json.loads(text)['sites']}


def test_radii_and_names():
    result = run('delaunay', *NAMES, '-', stdin=NAMED)
    rows = list(csv.reader(result.out.splitlines()))
    assert rows[:2] == [['# alias 3 2'], ['i', 'j', 'status', 'id_i', 'id_j']], rows
    assert rows[2:] == [['0', '2', 'legal', 'Anna; "A"', 'Käthe'], ['0', '4', 'legal', 'Anna; "A"', 'x,y'],
                        ['2', '4', 'legal', 'Käthe', 'x,y']], rows
    whole = json.loads(run('delaunay', *NAMES, '--format', 'json', '-', stdin=NAMED).out)
    assert whole['aliases'] == [[3, 2]] and [s['id'] for s in whole['sites']] == ['Anna; "A"', 'Käthe', 'x,y']
    assert sides(json.dumps(whole)) == {0: (-0.25, 0.25, -0.25, 0.25), 2: (7.875, 8.125, -0.125, 0.125), 4: (0, 0, 8, 8)}
    shapes = json.loads(run('delaunay', *NAMES, '--format', 'geojson', '-', stdin=NAMED).out)['features']
    assert [(s['properties']['id_i'], s['properties']['id_j']) for s in shapes][1] == ('Anna; "A"', 'x,y')
    table = list(csv.DictReader(io.StringIO(run('delaunay', *NAMES, '--format', 'wkt', '-', stdin=NAMED).out)))
    assert table[2]['id_i'] == 'Käthe' and table[2]['j'] == '4' and float(table[2]['max_coordinate_error']) >= 0.125
    assert '# row 2, "id": "Käthe"\nv 8 0 0' in run('delaunay', *NAMES, '--format', 'obj', '-', stdin=NAMED).out
    vtk = run('delaunay', *NAMES, '--format', 'vtk', '-', stdin=NAMED).out
    assert 'row 1 3 long\n0\n2\n4\nid 1 3 string\nAnna;%20%22A%22\nK%C3%A4the\nx,y\n' in vtk
    expect(run('nearest', *NAMES, '-', '7', '1', stdin=NAMED), 0, r'^i,status,lo,hi,id$\n^2,certain,.*,Käthe$')
    near = json.loads(run('nearest', *NAMES, '--format', 'json', '-', '7', '1', stdin=NAMED).out)
    found, = near['nearest']
    assert (found['i'], found['status'], found['id']) == (2, 'certain', 'Käthe') and near['aliases'] == [[3, 2]]
    expect(run('bisector', *NAMES, '-', stdin=NAMED), 0, 'id_far,id_near$(.|\n)*^2,0,.*,Käthe,"Anna; ""A"""$')
    cells = json.loads(run('voronoi', *NAMES, '--format', 'json', '-', stdin=NAMED).out)
    assert [(c['i'], c['id']) for c in cells['cells']] == [(0, 'Anna; "A"'), (2, 'Käthe'), (4, 'x,y')]
    for layer, ids in (('cells', ['id']), ('vertices', ['id_i', 'id_j', 'id_k']), ('edges', ['id_i', 'id_j'])):
        for form in ('csv', 'wkt'):
            text = run('voronoi', *NAMES, '--layer', layer, '--format', form, '-', stdin=NAMED).out
            table = list(csv.DictReader(line for line in text.splitlines() if not line.startswith('#')))
            names = {tuple(row[k] for k in ids) for row in table}
            if layer == 'cells':
                assert names == {('Anna; "A"',), ('Käthe',), ('x,y',)}, names
            else:
                assert ('Anna; "A"', 'Käthe', 'x,y')[:len(ids)] in names, names
    shapes = json.loads(run('voronoi', *NAMES, '--layer', 'vertices', '--format', 'geojson', '-', stdin=NAMED).out)['features']
    assert [[s['properties'][k] for k in ('i', 'j', 'k', 'id_i', 'id_j', 'id_k')] for s in shapes] == [
        [0, 2, 4, 'Anna; "A"', 'Käthe', 'x,y']]
    far = {a['far'] for c in cells['cells'] for b in c['int']['chains'] for a in b['arcs'] if 'far' in a}
    assert far == {0, 2, 4}, far
    odd = run('delaunay', '--columns', 'x,y', '--id', 'n', '--format', 'json', '-', stdin=b'x,y,n\n1,2,"a\xff""\\\x01"\n')
    assert json.loads(odd.out)['sites'][0]['id'] == 'aÿ"\\\x01'


def test_radii_apart():
    text = 'x y rx ry\n0 1 1/4 0\n8 1 0 2\n'
    options = ('--columns', 'x,y', '--radius-column', 'rx,ry', '--delimiter', ' ', '--format', 'json', '-')
    assert sides(run('delaunay', *options, stdin=text).out) == {0: (-0.25, 0.25, 1, 1), 1: (8, 8, -1, 3)}
    both = sides(run('delaunay', '--radius', '1/2', *options, stdin=text).out)
    assert both == {0: (-0.75, 0.75, 0.5, 1.5), 1: (7.5, 8.5, -1.5, 3.5)}
    # The same radius for all is what --radius gives.
    rows = [row + (['r'] if not k else ['0.01']) for k, row in enumerate(airports())]
    assert (run('delaunay', *PLACE, '--radius-column', 'r', '-q', '-', stdin=dressed(rows)).out ==
            run('delaunay', *PLACE, '--radius', '0.01', '-q', AIRPORTS).out)


def test_measured_with_radius():
    """A radius that is written says more than the digits, with either sign for it."""
    stated = sides(run('delaunay', '--measured', '-', '--format', 'json', stdin='1.250+-0.1 -3.0+-1/8\n1.250±0.1 -3.0±0.125\n').out)
    assert stated[0] == stated[1] == sides(run('delaunay', '-', '--format', 'json', stdin='1.250+-0.1 -3.0+-1/8\n').out)[0], stated


def test_merge():
    """However a number is written it is the same; the smaller radius wins in each coordinate; the lowest row stays."""
    text = '1.5 0+-1\n3/2 0.00+-1/2\n9 9\n15e-1+-0.25 [-2,2]\n0x1.8p0 0\n[1,2] -0\nsqrt(2) 4\nsqrt(2) 4.0\n'
    result = run('delaunay', '--merge', '-', '--format', 'json', stdin=text)
    assert json.loads(result.out)['aliases'] == [[1, 0], [3, 0], [4, 0], [5, 0], [7, 6]]
    assert sides(result.out)[0] == (1.5, 1.5, 0, 0), sides(result.out)
    expect(result, 0, '', r'\Adyadel: -: 5 rows are merged with earlier ones of equal coordinates$')
    apart = sides(run('delaunay', '--merge', '-', '--format', 'json', stdin='0+-1 0+-4\n0+-2 0+-1\n').out)
    assert apart == {0: (-1, 1, -1, 1)}, apart
    assert len(sides(run('delaunay', '--merge', '-', '--format', 'json', stdin='0 1\n1 0\n0 1.0000000000000000000001\n').out)) == 3


def test_note_on_shared_places():
    text = ''.join(f'{x} {y}\n' for x in range(5) for y in range(5)) + '2 2.0\n4/2 2\n1 1\n'
    note = r'\Adyadel: -: 5 rectangles have the centre of another one, .*(.if equal coordinates are one point: --merge.)\n'
    shared = run('delaunay', '--radius', '1/64', '-', stdin=text)
    expect(shared, 3, '', note)
    merged = run('delaunay', '--radius', '1/64', '--merge', '-', stdin=text)
    expect(merged, 3, r'\A# alias 25 12\n# alias 26 12\n# alias 27 6\n', 'give|3 rows are merged')
    assert 'are one point: --merge' not in merged.err
    assert count(merged.out)['indeterminate'] < count(shared.out)['indeterminate']
    expect(run('delaunay', '-', stdin=text), 3, '# alias 25 12', r'\Adyadel: [0-9]+ legal, ')
    expect(run('delaunay', '--radius', '1/64', '-q', '-', stdin=text), 3, '', r'\A\Z')
    expect(run('check', '--radius', '1/64', '--schedules', '3', '/dev/stdin', stdin='0 0\n9 0\n'), 0, '')
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, 'points'), 'w', encoding='utf-8') as f:
            f.write('0 0\n9 0\n9 0\n0 9\n')
        checked = run('check', '--radius', '1/64', '--schedules', '3', 'points', cwd=folder)
        assert checked.code == 0 and checked.err.count('are one point: --merge') == 1, checked


def test_note_on_large_radii():
    grid = ''.join(f'{x} {y}\n' for x in range(12) for y in range(12))
    large = run('delaunay', '--radius', '0.75', '-', stdin=grid)
    expect(large, 3, '', r'the radius is large for the spacing of the points: 144 of 144 rectangles meet another one')
    for options in (('--radius', '0.25'), ('--radius', '0.75', '-q'), ()):
        assert 'spacing' not in run('delaunay', *options, '-', stdin=grid).err
    table = 'x,y,r\n' + ''.join(f'{x},{y},0.6\n' for x in range(4) for y in range(4))
    expect(run('delaunay', '--columns', 'x,y', '--radius-column', 'r', '-', stdin=table), 3, '', 'spacing of the points: 16 of 16')


def test_decimal_commas_in_points():
    result = run('delaunay', '--decimal-comma', '-', '--format', 'json',
                 stdin='0,5 1,25+-0,25\n[1,5/4] max(1,2)\n')
    assert sides(result.out) == {0: (0.5, 0.5, 1, 1.5), 1: (1, 1.25, 2, 2)}


def test_oracles_have_no_columns():
    for option in ('--radius-column r', '--id r', '--delimiter ;', '--decimal-comma', '--skip-missing', '--merge'):
        expect(run('delaunay', '--oracle', 'true', *option.split()), 2, r'\A\Z',
               rf'\Adyadel: {option.split()[0]} is for points files; remove it')


def test_well_known_text():
    """Its numbers are read as others are, exactly; the vertices of lines and polygons are points, each ring's last one
    is its first."""
    want = run('delaunay', '-', stdin='0.1 0\n1/3 5\n7 2e-1\n').out
    for text in ('POINT (0.1 0)\nPOINT(1/3 5)\npoint z ( 7 2e-1 9)\n', 'SRID=4326;POINT(0.1 0)\n\nPOINT(1/3 5)\nPOINT M (7 2e-1 1)\n',
                 'MULTIPOINT ((0.1 0), (1/3 5), (7 2e-1))\n', 'MULTIPOINT (0.1 0,1/3 5,7 2e-1)\n', 'LINESTRING(0.1 0,1/3 5,7 2e-1)\n',
                 'POLYGON ((0.1 0, 1/3 5, 7 2e-1, 0.1 0))\n', 'GEOMETRYCOLLECTION (POINT (0.1 0), LINESTRING (1/3 5, 7 2e-1))\n',
                 'PointZ (0.1 0 4)\nPOINT(1/3 5), POINTZM(7 2e-1 4 5); # two\n'):
        result = run('delaunay', '-', stdin=text)
        assert (result.code, result.out) == (0, want), (text, result)
        assert ('vertices of lines and polygons' in result.err) == (text[0] in 'MLG' or 'POLYGON' in text), (text, result.err)
    two = 'MULTIPOLYGON (((0 0, 9 0, 0 9, 0 0), (1 1, 2 1, 1 2, 1 1)), ((20 0, 30 0, 20 9, 20 0)))'
    assert run('delaunay', '-', stdin=two).out == run('delaunay', '-', stdin='0 0\n9 0\n0 9\n1 1\n2 1\n1 2\n20 0\n30 0\n20 9\n').out
    expect(run('delaunay', '-', stdin='POINT (0 0)\nPOINT (1 x)\n'), 1, r'\A\Z', r'^dyadel: -:2:10: ')
    for text in ('POINT EMPTY', 'MULTIPOINT ((1 2), EMPTY)', 'GEOMETRYCOLLECTION (LINESTRING EMPTY, POINT (1 2))', 'POINT(nan nan)', 'POLYGON()'):
        expect(run('delaunay', '-', stdin=text + '\n'), 1, r'\A\Z', r'-:1:\d+: the coordinate is .*--skip-missing$')
    expect(run('delaunay', '--skip-missing', '-', stdin='POINT(0 0)\nPOINT EMPTY\nPOINT(1 2)\n'), 0, '^0,2,legal$', '1 of 3 rows are skipped')
    table = 'id;name;geometry\n17;"a; b";"POINT(0.1 0)"\n18;c;POINT (1/3 5)\n19;d;"POINT Z (7 2e-1 4)"\n'
    columns = '--columns', 'geometry,geometry', '--id', 'id'
    expect(run('delaunay', *columns, '-', stdin=table), 0, '^0,1,legal,17,18$')
    expect(run('delaunay', *columns, '-', stdin=table + '20;e;POINT EMPTY\n'), 1, '', '-:5:.*empty; .*--skip-missing')
    expect(run('delaunay', *columns, '-', stdin=table + '20;e;"LINESTRING(0 0,1 1)"\n'), 1, '', '-:5:7: this geometry is not a POINT')


if __name__ == '__main__':
    assert COMMAND
    main(globals())
