#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Claims: every id like [ORI-1] is stated once under proofs/claims, cited in the code and in a test, and listed in proofs/README.md.

Usage: check_claims.py ROOT   (prints every breach; exit status 1 when there is one)
"""
import collections
import pathlib
import re
import sys

ID = re.compile(r'\[([A-Z]{2,}-[A-Z0-9]+)\]')
HEADING = re.compile(r'^## \[([A-Z]{2,}-[A-Z0-9]+)\]', re.M)
STATUS = re.compile(r'^Status: .*(machine-checked: no \(proof on paper\)|tested only)', re.M)
ROW = re.compile(r'^\| \[([A-Z]{2,}-[A-Z0-9]+)\] \| \[[^]]*\]\(([^)]*)\) \| ([^|]*) \| ([^|]*) \|$', re.M)
CODE = ('.c', '.h')
TESTS = ('.c', '.h', '.py', '.sh')


def read(root, folder, suffixes, skip=()):
    """{path relative to root: text} of the files under root/folder."""
    files = sorted(p for p in (root / folder).rglob('*') if p.suffix in suffixes)
    return {str(p.relative_to(root)): p.read_text(encoding='utf-8') for p in files
            if not any(str(p.relative_to(root)).startswith(s) for s in skip)}


def citations(texts):
    """{id: [paths]}"""
    cited = collections.defaultdict(list)
    for path, text in texts.items():
        for name in sorted(set(ID.findall(text))):
            cited[name].append(path)
    return cited


def statements(texts):
    """{id: [(path, the claim's text)]}"""
    stated = collections.defaultdict(list)
    for path, text in texts.items():
        marks = list(HEADING.finditer(text))
        for mark, following in zip(marks, marks[1:] + [None]):
            stated[mark[1]].append((path, text[mark.start():following.start() if following else len(text)]))
    return stated


def check_statements(stated, code, tests):
    for name, places in sorted(stated.items()):
        if len(places) > 1:
            yield f'[{name}] is stated {len(places)} times: {", ".join(path for path, _ in places)}'
        for path, text in places:
            if not STATUS.search(text):
                yield f'{path}: [{name}] has no status line that says "proof on paper" or "tested only"'
        if name not in code:
            yield f'[{name}] is stated in {places[0][0]}, but nothing under src or include cites it'
        if name not in tests:
            yield f'[{name}] is stated in {places[0][0]}, but no test cites it'


def check_citations(stated, *cited):
    for places in cited:
        for name, paths in sorted(places.items()):
            if name not in stated:
                yield f'[{name}] is cited in {", ".join(paths)}, but not stated under proofs/claims'


def check_row(row, root, stated, code_text, tests):
    name, link, functions, files = row
    if not any(path == 'proofs/' + link for path, _ in stated.get(name, [])):
        yield f'proofs/README.md: [{name}] is not stated in {link}'
    for function in functions.split(', '):
        if not re.search(r'\b' + re.escape(function) + r'\b', code_text):
            yield f'proofs/README.md: [{name}]: there is no {function} under src or include'
    for test in files.split(', '):
        if not (root / test).is_file():
            yield f'proofs/README.md: [{name}]: there is no file {test}'
        elif test not in tests.get(name, []):
            yield f'proofs/README.md: {test} does not cite [{name}]'


def check_table(root, stated, code_text, tests):
    rows = ROW.findall((root / 'proofs/README.md').read_text(encoding='utf-8'))
    count = collections.Counter(row[0] for row in rows)
    for name in sorted(set(stated) | set(count)):
        if count[name] != 1:
            yield f'proofs/README.md: [{name}] has {count[name]} rows in the table; one is needed'
    for row in rows:
        yield from check_row(row, root, stated, code_text, tests)


def breaches(root):
    code = read(root, 'src', CODE) | read(root, 'include', CODE)
    stated = statements(read(root, 'proofs/claims', ('.md',)))
    in_code, in_tests = citations(code), citations(read(root, 'tests', TESTS, skip=('tests/house/',)))
    yield from check_citations(stated, in_code, in_tests, citations(read(root, 'proofs', ('.md',))))
    yield from check_statements(stated, in_code, in_tests)
    yield from check_table(root, stated, '\n'.join(code.values()), in_tests)


def main():
    found = list(breaches(pathlib.Path(sys.argv[1]).resolve()))
    print('\n'.join(found) or 'no breach')
    return 1 if found else 0


if __name__ == '__main__':
    sys.exit(main())
