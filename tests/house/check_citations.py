#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Citations resolve: sections of proofs/mathematics.md, entries of its bibliography, names of files, links.

Usage: check_citations.py ROOT   (prints every breach; exit status 1 when there is one)

In comments of src, include, tests, bench, the theories, and in the claims:
    mathematics: sections 2, 5       each is a heading "## N. ..." of proofs/mathematics.md
    section 6, step 3; case 4        and the section has an item "3. ..."
    KEL sections 2, 3; KEL figure 4  KEL is an entry of the bibliography, whose last sentence lists the parts "Cited:"
    Guibas and Stolfi (1985)         a capitalised word before a year: an entry has both
In comments of src and include also
    section 4                        of nothing named is a breach
    tree_filter.c, legal/witness.h   a name with a folder is a path from the root, src or include; a bare one is a file of
                                     the same folder, one that the file includes, or a public header
In the guides in Markdown, paths and names of functions between backquotes exist (exercises apart, which name files to
be written), and links lead to files, to headings that exist, and from claims to where they are stated.
"""
import pathlib
import re
import sys

THEORY = 'proofs/mathematics.md'
GUIDES = ('README.md', 'src/*.md', 'proofs/*.md', 'proofs/claims/*.md', 'bench/*.md')
HEADING = re.compile(r'^#+ (.*)$', re.M)
SECTION = re.compile(r'^## (\d+)\. .*$', re.M)
ENTRY = re.compile(r'^\* \*\*([^*]+)\*\*(.*?)(?=^\* \*\*|^#|\Z)', re.M | re.S)
NUMBERS = r'(\d+(?:(?:, | and | to )\d+)*)'
PART = r'(section|figure)s? ' + NUMBERS
CITE = re.compile(r'\b(mathematics)(?:\.md)?[:,]? ' + PART + r'(?:, (?:step|case) (\d+))?')
OF = re.compile(r'\b' + PART + r' of the mathematics\b')
YEAR = re.compile(r'\b([A-Z][A-Za-z-]{2,})(?: et al\.)?,? \(?((?:19|20)\d\d)\b')
BARE = re.compile(r'\b[Ss]ections? \d+')
FILE = re.compile(r'(?<![\w./<-])((?:[\w-]+/)*[a-z][\w-]+\.(?:c|h|v|py|md|sh|cpp|build))\b(?![\w/])')
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', re.M)
NAME = re.compile(r'\b(?:dyd|cli)_\w+')
LINK = re.compile(r'\]\(([^)\s]+)\)')
CLAIM_LINK = re.compile(r'^\[([A-Z]{2,}-[A-Z0-9]+)\]: (\S+)$', re.M)
QUOTED_FILE = re.compile(r'`((?:src|include|tests|bench|proofs)/[a-z][\w./-]*)`')
QUOTED_NAME = re.compile(r'`((?:dyd|cli)_\w+)`')
COMMENT = {'.c': r'/\*.*?\*/|//[^\n]*', '.h': r'/\*.*?\*/|//[^\n]*', '.v': r'\(\*.*?\*\)', '.md': r'.*'}


def expand(numbers):
    """'2, 4 to 6' -> 2 4 5 6"""
    found = [int(n) for n in re.findall(r'\d+', numbers)]
    return range(found[0], found[-1] + 1) if ' to ' in numbers else found


class Theory:
    """The targets of citations: sections with their items, and the bibliography."""

    def __init__(self, text):
        marks = list(SECTION.finditer(text))
        ends = [m.start() for m in marks[1:]] + [text.find('\n## Bibliography')]
        self.items = {int(m[1]): set(re.findall(r'^(\d+)\. ', text[m.end():end], re.M)) for m, end in zip(marks, ends)}
        self.double = len(marks) - len(self.items)
        self.entry = {m[1]: ' '.join(m[2].split()) for m in ENTRY.finditer(text[ends[-1]:])} if marks else {}

    def has(self, key, kind, number):
        """Returns whether that section or figure of an entry is listed as cited."""
        cited = self.entry[key].rpartition('Cited: ')[2]
        return any(kind == k and number in expand(n) for k, n in re.findall(PART, cited))


def comments(path, text):
    """The comments of a file, each as one line."""
    for found in re.finditer(COMMENT[path.suffix], text, re.S):
        yield re.sub(r'\s*\n[ \t]*\*?[ \t]*', ' ', found[0])


def check_theory(theory, text):
    """Sections, entries and years that a comment cites."""
    named = [(m[2], m[3], m[4]) for m in CITE.finditer(text)] + [(m[1], m[2], None) for m in OF.finditer(text)]
    for kind, numbers, item in named:
        for number in expand(numbers):
            if kind != 'section' or number not in theory.items:
                yield f'there is no {kind} {number} in {THEORY}'
            elif item and item not in theory.items[number]:
                yield f'there is no item {item} in section {number} of {THEORY}'
    for key in theory.entry:
        for kind, numbers in re.findall(r'\b' + re.escape(key) + r',? ' + PART, text):
            for number in expand(numbers):
                if not theory.has(key, kind, number):
                    yield f'{kind} {number} of {key} is not among those cited in the bibliography of {THEORY}'
    for word, year in YEAR.findall(text):
        if not any(re.search(rf'\b{word}\b.*\b{year}\b', entry) for entry in theory.entry.values()):
            yield f'"{word} {year}" is in no entry of the bibliography of {THEORY}'
    if re.search(r'\bKEL\b', text) and 'KEL' not in theory.entry:
        yield f'KEL is no entry of the bibliography of {THEORY}'


def check_bare(theory, text):
    """Sections of nothing that is named."""
    rest = OF.sub('', CITE.sub('', text))
    for key in theory.entry:
        rest = re.sub(r'\b' + re.escape(key) + r',? ' + PART, '', rest)
    for found in BARE.findall(rest):
        yield f'"{found}": of what? Say "mathematics: {found.lower()}", or an entry of the bibliography'


def check_files(root, path, text, included):
    """Names of files in a comment of src or include."""
    for name in FILE.findall(text):
        bases = [root, root / 'src', root / 'include', root / 'include/dyadel']
        bare = '/' not in name
        if not any((base / name).is_file() for base in ([path.parent, root, root / 'include/dyadel'] if bare else bases)):
            if not (bare and name in included):
                yield f'there is no {name}' + (' in this folder; say which folder' if bare else '')


def slugs(text):
    """Anchors of headings, as hosts of Markdown make them."""
    plain = re.sub(r'```.*?```', '', text, flags=re.S)
    return {re.sub(r'[^\w\- ]', '', h.strip().lower()).replace(' ', '-') for h in HEADING.findall(plain)}


def check_links(path, text):
    for target in LINK.findall(re.sub(r'```.*?```', '', text, flags=re.S)):
        if re.match(r'\w+:', target):
            continue
        name, _, anchor = target.partition('#')
        file = path.parent / name if name else path
        if not file.exists():
            yield f'the link to {target} leads nowhere'
        elif anchor and anchor not in slugs(file.read_text(encoding='utf-8')):
            yield f'the link to {target}: there is no such heading'
    for name, target in CLAIM_LINK.findall(text):
        file = path.parent / target
        if not file.is_file() or f'\n## [{name}]' not in file.read_text(encoding='utf-8'):
            yield f'[{name}] is not stated in {target}'


def check_quoted(root, text, code):
    """Paths and functions that a guide names."""
    text = re.sub(r'```.*?```', '', text.partition('\n## Exercises')[0], flags=re.S)
    for name in QUOTED_FILE.findall(text):
        if 'NAME' not in name and not (root / name).exists():
            yield f'there is no {name}'
    for name in QUOTED_NAME.findall(text):
        if name not in code and 'NAME' not in name:
            yield f'there is no {name} under src or include'


def check_source(root, theory, path):
    text = path.read_text(encoding='utf-8')
    ours = path.relative_to(root).parts[0] in ('src', 'include')
    included = {pathlib.PurePath(name).name for name in INCLUDE.findall(text)}
    for comment in comments(path, text):
        yield from check_theory(theory, comment)
        if ours and path.suffix != '.md':
            yield from check_bare(theory, comment)
            yield from check_files(root, path, comment, included)


def files(root):
    for folder in ('src', 'include', 'tests', 'bench', 'proofs/theories', 'proofs/claims'):
        yield from (p for p in sorted((root / folder).rglob('*')) if p.suffix in COMMENT and p.is_file())


def breaches(root):
    file = root / THEORY
    if not file.is_file():
        yield f'there is no {THEORY}'
        return
    theory = Theory(file.read_text(encoding='utf-8'))
    if theory.double:
        yield f'{THEORY}: a number of a section is used twice'
    for path in files(root):
        yield from (f'{path.relative_to(root)}: {found}' for found in check_source(root, theory, path))
    code = {w for folder in ('src', 'include') for p in (root / folder).rglob('*.[ch]') for w in NAME.findall(p.read_text(encoding='utf-8'))}
    for path in (p for pattern in GUIDES for p in sorted(root.glob(pattern))):
        text = path.read_text(encoding='utf-8')
        for found in [*check_links(path, text), *check_quoted(root, text, code)]:
            yield f'{path.relative_to(root)}: {found}'


def main():
    found = list(dict.fromkeys(breaches(pathlib.Path(sys.argv[1]).resolve())))
    print('\n'.join(found) or 'no breach')
    return 1 if found else 0


if __name__ == '__main__':
    sys.exit(main())
