# SPDX-License-Identifier: LGPL-3.0-or-later
"""No option without its place in the truth harness: coverage.py COMMAND [--python DIR] [--capi PROGRAM] [--tiles PROGRAM]

The command prints its own table (--help=bash): commands, and of each the options, formats, layers and words. Each of
these has to be typed by a row of the pairs of seed 1, or to have a reason here why not. A reason for an entry that is
gone, or is typed, fails, too."""
import os
import pathlib
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import axes
import faults as seeded
import stated
import truth
from product import Product

VERIFY = 'certificates: laws.judge_certificate runs verify on what rows write, tests/checker tries forgeries'
LOOK = 'how a picture looks: tests/cli/test_pictures.py'
PICTURE = 'says nothing that can be read back: the geometry drawn is that of csv and svg'
REASONS = {  # (command or *, option, format:F, layer:L or OPTION=word): why no row types it
    ('verify', '*'): VERIFY,
    ('voronoi', '--max-arc'): 'about the polygons of cells on the sphere, which tests/cli/test_sphere_cells.py looks at',
    ('voronoi', '--clip'): 'where edges are drawn: tests/cli/test_columns.py compares with cut segments, exactly',
    ('*', '--in-layer'): 'a layer of a file that GDAL reads: tests/cli/test_gdal.py compares such files with tables',
    ('*', '--help'): 'says nothing about points', ('*', '--version'): 'says nothing about points',
    ('*', '--resume'): 'laws.judge_resume gives it what --trace wrote',
    ('converge', '--trace-sync'): 'as --trace', ('converge', '--trace'): 'a trace of stages says what its table does', ('converge', '--resume'): 'as --trace',
    ('converge', '--modulus'): 'judged against true errors in 60 digits by tests/cli/test_modulus.py',
    ('check', '--trace'): 'writes the schedule of a fault, and none is expected', ('check', '--replay'): 'as --trace',
    ('converge', '--replay'): 'as --trace', ('converge', '--plot'): PICTURE,
    ('converge', '--rows-only'): 'leaves the header out, and says nothing else',
    ('*', 'format:pdf'): PICTURE, ('*', 'format:png'): PICTURE, ('*', 'format:tikz'): 'the shapes of svg: tests/cli/test_pictures.py compares',
    ('*', '--bare'): LOOK, ('*', '--width'): LOOK, ('*', '--font-size'): LOOK, ('*', '--font'): LOOK,
    ('converge', '--pgf'): 'bounds of the table: tests/cli/test_pictures.py compares',
    ('*', 'format:html'): 'a page holds the data of json: tests/html compares both',
    ('voronoi', 'format:svg'): PICTURE, ('voronoi', 'format:vtk'): 'holds what json does: tests/cli/test_voronoi.py compares',
    ('disc', 'format:svg'): PICTURE, ('bisector', 'format:svg'): PICTURE, ('nearest', 'format:svg'): PICTURE,
    ('tolerance', 'format:svg'): PICTURE, ('plan', 'format:svg'): PICTURE, ('tolerance', '--sigma'): 'probabilities: tests/tolerance/test_chance.c',
    ('tolerance', '--sigma-column'): 'probabilities: tests/tolerance/test_chance.c',
    ('plan', '--pairs'): 'as --site: a part of the pairs', ('*', 'help=man'): 'says nothing about points',
    ('*', 'help=bash'): 'says nothing about points', ('*', 'help=zsh'): 'says nothing about points'}


def typed(space, product):
    """What the rows of the pairs of seed 1 type, as keys of REASONS."""
    found = set()
    design, _ = truth.pairs_design(space, 1)
    for number, row in enumerate(design):
        what = stated.STATED[row['stated']]
        found.add((what.command, 'format:' + row['format']))
        if what.layer:
            found.add((what.command, 'layer:' + what.layer))
        if row['form'] in axes.LIBRARY:
            continue
        case = truth.build(row, f'1:{number}')
        case.space = space
        words = truth.command_of(case, product)
        for k, w in enumerate(words):
            if w.startswith('-') and len(w) > 1 and not w[1].isdigit() and w[1] != '.':
                name, _, value = w.partition('=')
                name = '--output' if name == '-o' else name
                value = value or (words[k + 1] if k + 1 < len(words) else '')
                found |= {(what.command, name), (what.command, name[2:] + '=' + value.partition(':')[0])}
    return found


def offered(offers):
    for c in offers['commands']:
        yield from ((c, o) for o in offers['options'][c])
        yield from ((c, 'format:' + f) for f in offers['formats'][c])
        yield from ((c, 'layer:' + l) for l in offers['layers'][c])
        for option, words in offers['words'].items():
            if '--' + option in offers['options'][c]:
                yield from ((c, f'{option}={w.rstrip(":")}') for w in words)


def holds_once(name, text):
    path = pathlib.Path(__file__).resolve().parents[2] / 'src' / name
    return path.exists() and path.read_text(encoding='utf-8').count(text) == 1


def main():
    a = sys.argv[1:]
    given = {k[2:]: v for k, v in zip(a[1::2], a[2::2])}
    space = truth.Space(a[0], given.get('python'), given.get('capi'), given.get('tiles'))
    product = Product(a[0])
    try:
        found, used, faults = typed(space, product), set(), []
    finally:
        product.close()
    for key in offered(space.offers):
        reasons = [r for r in (key, (key[0], '*'), ('*', key[1])) if r in REASONS]
        used.update(reasons)
        word = f'{key[0]} {key[1]}'
        if key not in found and not reasons:
            faults.append(f'{word}: no row of tests/truth types it; give it one (axes.py, stated.py), or a reason in coverage.py')
        if key in found and key in reasons:
            faults.append(f'{word}: a row types it; its reason in coverage.py can go')
    faults += [f'{" ".join(r)}: the command offers no such thing; its reason in coverage.py can go' for r in REASONS if r not in used]
    faults += [f'faults.py: src/{name} does not hold once the text that fault {k} replaces: {old}'
               for k, (_, name, old, _) in enumerate(seeded.FAULTS) if not holds_once(name, old)]
    print(*faults, sep='\n')
    print(f'{len(list(offered(space.offers)))} things offered, {len(faults)} faults')
    return bool(faults)


if __name__ == '__main__':
    sys.exit(main())
