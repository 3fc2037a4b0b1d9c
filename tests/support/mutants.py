#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Which small faults in the sources do tests notice?

Usage: mutants.py ROOT BUILD --sources FILE... --tests NAME... [--count K] [--seed S] [--again OUTPUT]

ROOT is a copy of the project that may be written to, BUILD a build folder of it. Draws K places in the sources (paths from
ROOT/src), all kinds of fault alike, and for each: changes the source, builds, runs the tests named, in this order, until one
fails, and puts the source back. Prints a line for each fault and a sum; look at the faults not noticed: a
missing test, a needless check, or a change that cannot be seen. With --again, only the faults that survived according
to the output of an earlier run, with slower tests, say. Slow: not a test of the suite.
"""
import argparse
import json
import os
import pathlib
import random
import re
import signal
import subprocess
import sys

KINDS = [  # name, pattern, replacement
    ('strict', r'(?<![-<>=])([<>])(?![<>=])(?= )', r'\1='),
    ('loose', r'(?<![<>])([<>])=(?= )', r'\1'),
    ('equal', r'([!=])=(?= )', lambda m: '!=' if m[1] == '=' else '=='),
    ('and', r'&&', '||'), ('or', r'\|\|', '&&'),
    ('plus', r' \+ ', ' - '), ('minus', r' - ', ' + '), ('times', r'(?<=\w) \* (?=\w)', ' + '),
    ('not', r'!(?=[a-z(])', ''),
    ('truth', r'\b(true|false)\b', lambda m: 'false' if m[1] == 'true' else 'true'),
    ('number', r'(?<![\w.])([0-3])(?![\w.])', lambda m: str(int(m[1]) + 1)),
    ('statement', r'(?m)^( +)(?!return|if|for|else|while|do|break|continue|goto|case|const|static|struct|dyd_status |bool |size_t )'
                  r'[a-z][\w>.\[\]-]*(?:\(|(?: [-+|&]?=|\+\+|--)).*;$', r'\1;'),
    ('skip', r'\b(continue|break);', ';'),
    ('outward', r'DYD_(UP|DOWN)\b', lambda m: 'DYD_DOWN' if m[1] == 'UP' else 'DYD_UP'),
]


def places(text):
    """(kind, start, end, new text) of all faults in a source"""
    plain = re.sub(r'(?s)/\*.*?\*/|"(?:[^"\\\n]|\\.)*"|(?m:^#[^\n]*)', lambda m: re.sub(r'[^\n]', '\x01', m[0]), text)
    for kind, pattern, new in KINDS:
        for m in re.finditer(pattern, plain):
            yield kind, m.start(), m.end(), m.expand(new) if isinstance(new, str) else new(m)


def introspect(build, what):
    return json.loads(subprocess.run(['meson', 'introspect', what, build], capture_output=True, check=True).stdout)


def tests_of(build, names):
    """Each with the files that have to be built for it; they start in the build folder, as meson does it."""
    made = {t['id']: t['filename'][0] for t in introspect(build, '--targets')}
    found = {t['name']: t for t in introspect(build, '--tests')}
    return [{**found[name], 'workdir': found[name]['workdir'] or build,
             'needs': [os.path.relpath(made[t], build) for t in found[name]['depends']]} for name in names]


def fails(test, limit):
    with subprocess.Popen(test['cmd'], env={**os.environ, **test['env']}, cwd=test['workdir'], start_new_session=True,
                          stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process:
        try:
            return process.wait(limit) != 0
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            return True


def noticed(build, tests, limit):
    targets = [target for t in tests for target in t['needs']]
    if subprocess.run(['ninja', '-C', build, *targets], capture_output=True, check=False).returncode:
        return 'the compiler'
    return next((t['name'] for t in tests if fails(t, limit)), None)


def described(text, source, kind, start, end, new):
    line = text[text.rfind('\n', 0, start) + 1:text.find('\n', end)].strip()
    return (f'{source}:{text.count(chr(10), 0, start) + 1} {kind} `{text[start:end].strip()}` -> `{new.strip()}` '
            f'in `{line}`')


def arguments():
    parser = argparse.ArgumentParser()
    parser.add_argument('root', type=pathlib.Path)
    parser.add_argument('build')
    parser.add_argument('--sources', nargs='+', required=True)
    parser.add_argument('--tests', nargs='+', required=True)
    parser.add_argument('--count', type=int, default=50)
    parser.add_argument('--seed', type=int, default=1)
    parser.add_argument('--again', type=pathlib.Path, help='output of an earlier run: what survived is tried')
    parser.add_argument('--limit', type=float, default=300, help='seconds after which a test has failed')
    return parser.parse_args()


def drawn(text, seed, again=None):
    """The faults, each with its description: all kinds alike; `again`: of these descriptions only."""
    by_kind, chance = {}, random.Random(seed)
    for s in text:
        for place in places(text[s]):
            told = described(text[s], s, *place)
            if again is None or told in again:
                by_kind.setdefault(place[0], []).append((told, s, *place[1:]))
    print(f'# {sum(map(len, by_kind.values()))} places, seed {seed}', flush=True)
    while any(by_kind.values()):
        kind = chance.choice(sorted(k for k in by_kind if by_kind[k]))
        yield by_kind[kind].pop(chance.randrange(len(by_kind[kind])))


def main():
    o = arguments()
    build = os.path.abspath(o.build)
    tests = tests_of(build, o.tests)
    text = {s: (o.root / 'src' / s).read_text(encoding='utf-8') for s in o.sources}
    if noticed(build, tests, o.limit):
        sys.exit('the tests fail without a fault')
    again = o.again and {line[10:] for line in o.again.read_text().splitlines() if line.startswith('SURVIVES: ')}
    survivors = tried = 0
    for told, source, start, end, new in drawn(text, o.seed, again):
        path = o.root / 'src' / source
        path.write_text(text[source][:start] + new + text[source][end:], encoding='utf-8')
        try:
            by = noticed(build, tests, o.limit)
        finally:
            path.write_text(text[source], encoding='utf-8')
        if by == 'the compiler':
            continue
        tried += 1
        survivors += by is None
        print(f'{"noticed by " + by if by else "SURVIVES"}: {told}', flush=True)
        if tried == o.count:
            break
    print(f'{tried} faults, {tried - survivors} noticed, {survivors} survive')


if __name__ == '__main__':
    main()
