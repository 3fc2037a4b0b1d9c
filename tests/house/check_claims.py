#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Claims: every id like [ORI-1] is stated once under proofs/claims, cited in the code and in a test, and listed in proofs/README.md.

A claim that says it is machine-checked names theorems, as in `name`, `name` in theories/X.v; they must exist there and
be rows of the table of theorems in proofs/README.md, as must every theorem of that table.

Usage: check_claims.py ROOT   (prints every breach; exit status 1 when there is one)
"""
import collections
import pathlib
import re
import sys

ID = re.compile(r'\[([A-Z]{2,}-[A-Z0-9]+)\]')
HEADING = re.compile(r'^## \[([A-Z]{2,}-[A-Z0-9]+)\]', re.M)
STATUS = re.compile(r'^Status: .*(machine-checked: (no \(proof on paper\)|yes, theorem |in part, theorem )|tested only)', re.M)
CHECKED = re.compile(r'^Status: .*?machine-checked: (?:yes|in part).*?(?:\n\n|\Z)', re.M | re.S)
IN_THEORY = re.compile(r'((?:`\w+`(?:,| and)?\s+)+)in\s+theories/(\w+)\.v')
THEOREM_ROW = re.compile(r'^\| ([^|]*) \| \[(\w+)\.v\]\(theories/\2\.v\) \| ([^|]*) \| [^|]* \|$', re.M)
THEORY_LINK = re.compile(r'^\|.*\]\(theories/', re.M)
PROVED = re.compile(r'^\s*(?:Theorem|Lemma|Corollary)\s+(\w+)', re.M)
ROW = re.compile(r'^\| \[([A-Z]{2,}-[A-Z0-9]+)\] \| \[[^]]*\]\((claims/[^)]*)\) \| ([^|]*) \| ([^|]*) \|$', re.M)
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
                yield f'{path}: [{name}] has no status line of a known form'
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


def claimed_theorems(stated):
    """{(claim, theory, theorem)} of the claims that say they are machine-checked, wholly or in part."""
    for name, places in sorted(stated.items()):
        for status in CHECKED.findall('\n'.join(text for _, text in places)):
            named = IN_THEORY.findall(status)
            yield from ((name, theory, theorem) for names, theory in named for theorem in re.findall(r'`(\w+)`', names))
            if not named:
                yield name, '', ''


def listed_theorems(readme):
    """{(claim, theory, theorem)} of the table of theorems; the claim is '-' where there is none."""
    for claims, theory, names in THEOREM_ROW.findall(readme):
        for claim in claims.split(', '):
            yield from ((claim.strip('[]'), theory, name) for name in names.split(', '))


def check_theorems(root, stated):
    readme = (root / 'proofs/README.md').read_text(encoding='utf-8')
    proved = {path.stem: set(PROVED.findall(path.read_text(encoding='utf-8')))
              for path in (root / 'proofs/theories').glob('*.v')}
    claimed, listed = set(claimed_theorems(stated)), set(listed_theorems(readme))
    if len(THEORY_LINK.findall(readme)) != len(THEOREM_ROW.findall(readme)):
        yield 'proofs/README.md: a row of the table of theorems is not of the form | claim | [X.v](theories/X.v) | names | text |'
    for claim, theory, name in sorted(claimed | listed):
        if name not in proved.get(theory, ()):
            yield f'[{claim}]: there is no theorem {name} in theories/{theory}.v'
    for claim, theory, name in sorted(claimed - listed):
        yield f'proofs/README.md: the table of theorems lacks {name} of {theory}.v for [{claim}]'
    for claim, theory, name in sorted(listed - claimed):
        if claim != '-':
            yield f'[{claim}]: its status line does not name {name} in theories/{theory}.v'


def breaches(root):
    code = read(root, 'src', CODE) | read(root, 'include', CODE)
    stated = statements(read(root, 'proofs/claims', ('.md',)))
    in_code, in_tests = citations(code), citations(read(root, 'tests', TESTS, skip=('tests/house/',)))
    yield from check_citations(stated, in_code, in_tests, citations(read(root, 'proofs', ('.md',))))
    yield from check_statements(stated, in_code, in_tests)
    yield from check_table(root, stated, '\n'.join(code.values()), in_tests)
    yield from check_theorems(root, stated)


def main():
    found = list(breaches(pathlib.Path(sys.argv[1]).resolve()))
    print('\n'.join(found) or 'no breach')
    return 1 if found else 0


if __name__ == '__main__':
    sys.exit(main())
