# SPDX-License-Identifier: LGPL-3.0-or-later
"""Cases for the Python package, one json line each, answered by one."""
import json
import sys

import dyadel

NAMES = {0: 'illegal', 1: 'tie', 2: 'indeterminate', 3: 'legal'}


def answer(q):
    points = [tuple(p) for p in q['points']]
    d = dyadel.delaunay(points, q['radius'], **({'sphere': True} if q['geometry'] == 'sphere' else {}))
    out = {'outcome': d.outcome, 'aliases': [[int(a), int(b)] for a, b in d.aliases],
           'pairs': [[int(i), int(j), NAMES[int(s)]] for i, j, s in d.discs()] if q['geometry'] == 'discs' else
           [[int(i), int(j), NAMES[int(s)]] for i, j, s in d.pairs]}
    if q['stated'] == 'triangles':
        out['triangles'] = [[int(c) for c in t] for t in d.simplices]
    return out


for line in sys.stdin:
    try:
        print(json.dumps(answer(json.loads(line))), flush=True)
    except Exception as e:  # what the package refuses is for the harness to judge
        print(json.dumps({'error': f'{type(e).__name__}: {e}'}), flush=True)
