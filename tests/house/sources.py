#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""House rules on the source text: the top level, layers, licence lines, lengths of files and functions.

Usage: sources.py ROOT   (prints every breach; exit status 1 when there is one)
"""
import pathlib
import re
import subprocess
import sys

# What a layer may include besides itself: everything below it. layers in one bracket are side by side.
LAYERS = [['base'], ['dyadic'], ['rect', 'checker'], ['stream', 'predicate'], ['skeleton'], ['legal', 'possible'], ['delaunay'], ['tolerance', 'graph'],
          ['voronoi'], ['metric'], ['engine'], ['sphere'], ['io'], ['prove', 'picture', 'tiles'], ['format']]
# Rooms that see the library as its users do.
OUTSIDE = {'cli': 'the command', 'python': 'the Python module'}
# Rooms that may name options of a command in messages.
COMMANDS = {*OUTSIDE, 'tiles'}
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.M)
# Public headers in the order of the layers; a header may include only those before it.
PUBLIC = ['status', 'dyadic certificate', 'rect', 'stream sites', 'oracle', 'predicate delaunay', 'tolerance survey graph', 'arc', 'voronoi', 'compose', 'metric', 'engine', 'converge check sphere', 'io', 'dyadel']
# The checker of certificates uses the number layer alone.
CHECKER_MAY = ['dyadel/status.h', 'dyadel/dyadic.h', 'dyadel/certificate.h']
# Lines of a file and of a function: below src, elsewhere.
SOURCE_LINES, OTHER_LINES = (900, 40), (900, 60)
TOP = {'src', 'include', 'tests', 'proofs', 'bench', 'meson.build', 'meson_options.txt', 'README.md', 'LICENSE'}


def level(layer):
    return next((k for k, names in enumerate(LAYERS) if layer in names), None)


def public_level(name):
    return next((k for k, names in enumerate(PUBLIC) if name in names.split()), None)


def check_source_includes(path, text, root):
    layer = path.relative_to(root / 'src').parts[0]
    for kind, name in INCLUDE.findall(text):
        if kind == '<':
            if layer == 'checker' and name.startswith('dyadel/') and name not in CHECKER_MAY:
                yield f'{path}: the checker of certificates must not include <{name}>'
            continue
        parts = name.split('/')
        if layer in OUTSIDE:
            if len(parts) > 1:
                yield f'{path}: {OUTSIDE[layer]} may use public headers only, not "{name}"'
        elif len(parts) < 2 or level(parts[0]) is None:
            yield f'{path}: "{name}" is not of the form "layer/file.h"'
        elif parts[0] != layer and level(parts[0]) >= level(layer):
            yield f'{path}: layer {layer} must not include "{name}"'


def check_public_includes(path, text):
    own = public_level(path.stem)
    if own is None:
        yield f'{path}: not in the list of public headers in tests/house/sources.py'
        return
    for kind, name in INCLUDE.findall(text):
        match = re.fullmatch(r'dyadel/(\w+)\.h', name)
        if kind == '"':
            yield f'{path}: public headers include <...> only, not "{name}"'
        elif match and (public_level(match[1]) is None or public_level(match[1]) > own):
            yield f'{path}: <{name}> belongs to a higher layer'


def check_lengths(path, text):
    lines = text.splitlines()
    of_file, of_function = SOURCE_LINES if 'src' in path.parts else OTHER_LINES
    if len(lines) > of_file:
        yield f'{path}: {len(lines)} lines, {of_file} are allowed'
    start = None
    for number, line in enumerate(lines, 1):
        if re.match(r'^[A-Za-z_].*\)\s*\{$|^\{$', line):
            start = number
        elif line == '}' and start:
            if number - start - 1 > of_function:
                yield f'{path}:{start}: a function of {number - start - 1} lines, {of_function} are allowed'
            start = None


STATIC = re.compile(r'^static (?!inline)[^;=(]*?\b(\w+)\([^;]*?\)\s*\{', re.M)


def check_static_names(root):
    """A backtrace is readable when a name says which function it is: static functions share none."""
    seen = {}
    for path in sorted((root / 'src').rglob('*.c')):
        for name in STATIC.findall(path.read_text(encoding='utf-8')):
            if seen.setdefault(name, path) != path:
                yield f'{path}: the static function {name} has the name of one in {seen[name].relative_to(root)}'


TYPE = re.compile(r'^(?:typedef )?(?:struct|enum|union) (?:dyd_)?(\w+) \{', re.M)


def check_type_names(root):
    """One name means one thing: no two types differ in the prefix at most."""
    seen = {}
    for path in sorted(p for folder in ('src', 'include') for p in (root / folder).rglob('*.[ch]')):
        for name in TYPE.findall(path.read_text(encoding='utf-8')):
            if seen.setdefault(name, path) != path:
                yield f'{path}: the type {name} has the name of one in {seen[name].relative_to(root)}'


OPTION = re.compile(r'"[^"\n]*--[a-z][a-z-]+[^"\n]*"')


def check_options(path, text, layer):
    """Messages of the library name fields, `max_pairs`; the command prints its own options instead (cli/process.c)."""
    for number, line in enumerate(text.splitlines(), 1):
        if layer not in COMMANDS and OPTION.search(line):
            yield f'{path}:{number}: the library names an option of the command: {line.strip()}'


def check_top(root):
    """Files outside the rooms are leftovers; without git, build folders are skipped."""
    listed = subprocess.run(['git', '-C', root, 'ls-files', '-z'], check=False, capture_output=True, text=True).stdout
    names = {name.split('/')[0] for name in listed.split('\0')} if (root / '.git').exists() else {path.name for path in root.iterdir()}
    for name in sorted(names - TOP - {''}):
        if not name.startswith(('.', 'build')):
            yield f'{root / name}: only {", ".join(sorted(TOP))} and names with a dot are at the top'


def check_licences(root):
    """Whatever the build asks for has its licence in the table."""
    table = (root / 'src/packaging/LICENCES.md').read_text(encoding='utf-8')
    for path in sorted(root.rglob('meson.build')):
        for name in re.findall(r"(?:dependency|find_library)\('([\w-]+)'", path.read_text(encoding='utf-8')):
            if f'`{name}`' not in table:
                yield f'{path}: {name} has no licence in src/packaging/LICENCES.md'


def files(root):
    for folder in ('src', 'include', 'tests', 'bench', 'proofs'):
        for path in sorted((root / folder).rglob('*')):
            if path.suffix in ('.c', '.h', '.py', '.sh', '.v', '.cpp') or path.name == 'meson.build':
                yield path
    yield from (root / name for name in ('meson.build', '.ci/run') if (root / name).is_file())


def breaches(root):
    yield from check_top(root)
    yield from check_static_names(root)
    yield from check_type_names(root)
    yield from check_licences(root)
    for path in files(root):
        text = path.read_text(encoding='utf-8')
        if not any('SPDX-License-Identifier: LGPL-3.0-or-later' in line for line in text.splitlines()[:3]):
            yield f'{path}: no SPDX line'
        if path.suffix not in ('.c', '.h'):
            continue
        yield from check_lengths(path, text)
        if (root / 'src') in path.parents:
            yield from check_source_includes(path, text, root)
            yield from check_options(path, text, path.relative_to(root / 'src').parts[0])
        if (root / 'include') in path.parents:
            yield from check_public_includes(path, text)


def main():
    found = list(breaches(pathlib.Path(sys.argv[1]).resolve()))
    print('\n'.join(found) or 'no breach')
    return 1 if found else 0


if __name__ == '__main__':
    sys.exit(main())
