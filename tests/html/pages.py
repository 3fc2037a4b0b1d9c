# SPDX-License-Identifier: LGPL-3.0-or-later
"""Examples written as pages, and the data of a page. Imports the harness of tests/cli."""
import base64
import json
import pathlib
import re
import sys
import tempfile
import zlib

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / 'cli'))
import harness  # noqa: E402

FOLDER = tempfile.TemporaryDirectory()
AIRPORTS = str(pathlib.Path(harness.DATA) / 'airports.csv')
PLACES = ['--columns', 'longitude,latitude', '--id', 'iata', AIRPORTS]
FIXES = ['--columns', 'east,north', '--radius-column', 'accuracy', '--id', 'name', str(pathlib.Path(harness.DATA) / 'gps.csv')]
# Exact numbers, a tie, measured ones, computable ones; 12 and 4 are the same place.
TWELVE = '0 0\n4 0\n4 4\n0 4\n2 2\nsqrt(2)+5 pi\n[6,6.6] [1,1.5]\n7.5+-0.2 4+-0.3\nsqrt(50) sqrt(2)\n1 6\n5/3 22/7\n-2 1\n2 2\n'
# Decided stage by stage.
SLOW = 'sqrt(2) pi\n1/3 0\ncos(1) e\nsqrt(3) sqrt(5)\nexp(1) 1\n0.5 2.5\nsin(2) 1.1\nsqrt(2)+1e-9 pi\n'
STEPS = ['--start-bits', '2', '--step-bits', '3']


def points(text, name='points.txt'):
    """The name of a new file with this text."""
    path = pathlib.Path(tempfile.mkdtemp(dir=FOLDER.name), name)
    path.write_text(text, encoding='utf-8')
    return str(path)


def page(*args, codes=(0, 3)):
    """The name of the page that a command wrote."""
    path = str(pathlib.Path(tempfile.mkdtemp(dir=FOLDER.name), 'page.html'))
    result = harness.run(*args, '-q', '-o', path)
    assert result.code in codes, f'exit {result.code}: {result.err}'
    return path


def data(path):
    """The data of a page."""
    text = pathlib.Path(path).read_text(encoding='utf-8')
    packed, = re.findall(r'<script id="data" type="text/plain">\n([A-Za-z0-9+/=\n]*)</script>', text)
    return json.loads(zlib.decompress(base64.b64decode(packed)))


def statuses(content):
    """{(row, row): status} after each stage, as the page works them out."""
    rows, now, out = [p['i'] for p in content['points']], {}, []
    for stage in content['stages']:
        for status in 'illegal', 'tie', 'indeterminate', 'legal':
            i, numbers = 0, stage[status]
            for di, step in zip(numbers[::2], numbers[1::2]):
                i += di
                pair = rows[i], rows[i + step]
                if status == 'illegal':
                    del now[pair]
                else:
                    now[pair] = status
        out.append(dict(now))
    return out


def csv_pairs(*args):
    """{(i, j): status} as csv has them."""
    lines = [line for line in harness.run(*args, '-q').out.splitlines() if not line.startswith('#')][1:]
    return {(int(i), int(j)): status for i, j, status, *_ in (line.split(',') for line in lines)}
