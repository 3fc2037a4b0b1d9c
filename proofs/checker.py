#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The checker of certificates that is proved in Coq accepts what the command writes, and rejects mutants.

Usage: checker.py ROOT FOLDER DYADEL [COUNT]

Compiles the theories in FOLDER as compile.py does, and the extracted checker; runs it on certificates of the airports and
of COUNT random inputs (default 100), and on mutants of these. On every mutant it is compared with `dyadel verify`, which
checks more: what the extracted checker rejects, verify must reject too.
"""
import pathlib
import random
import shutil
import subprocess
import sys

sys.dont_write_bytecode = True
import compile as theories  # noqa: E402

SEED = 1


def build(root, folder):
    """The program."""
    built = theories.compile_theories(root, folder)
    target = folder / 'checker'
    target.mkdir(exist_ok=True)
    for name in ('checker.ml', 'checker.mli'):
        shutil.copy(built / name, target / name)
    shutil.copy(root / 'proofs/extraction/reader.ml', target / 'reader.ml')
    subprocess.run(['ocamlopt', '-w', '-a', '-unsafe', '-inline', '100', '-o', 'checker', 'checker.mli', 'checker.ml',
                    'reader.ml'], cwd=target, check=True)
    return target / 'checker'


def certify(dyadel, points, certificate, *options):
    """Writes a certificate; every outcome with a result has one."""
    done = subprocess.run([dyadel, 'delaunay', '--quiet', '-o', '/dev/null', '--certificate', certificate, *options,
                           points], check=False)
    assert done.returncode in (0, 3, 4), done


def certify_diagram(dyadel, points, certificate):
    """The same with a section on the Voronoi diagram."""
    done = subprocess.run([dyadel, 'voronoi', '--quiet', '-o', '/dev/null', '--certificate', certificate, points],
                          check=False)
    assert done.returncode in (0, 3, 4), done


def accepts(program, *files):
    """Which of the certificates the program accepts."""
    return [subprocess.run([*program, file], check=False, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            .returncode == 0 for file in files]


def coordinate(rng, kind):
    number = rng.randrange(-40, 41) if kind % 2 else rng.randrange(-10**6, 10**6) / 1024
    if kind == 2:
        return f'[{number},{number + rng.randrange(200)}]'
    if kind == 3:
        return f'{number}/{rng.choice((1, 3, 7, 10))}'
    if kind == 4:
        return f'{number}+-0.001'
    return f'sqrt({abs(number)})' if kind == 5 else f'{number}'


def points(rng):
    """A points file: exact, tied, rational, boxes, reals, mixed."""
    kind = rng.randrange(7)
    count = rng.randrange(1, 40)
    return ''.join(f'{coordinate(rng, kind if kind < 6 else rng.randrange(6))} '
                   f'{coordinate(rng, kind if kind < 6 else rng.randrange(6))}\n' for _ in range(count))


def mutants(rng, text):
    """Texts with one number of a site or of a legal pair changed, or two lines exchanged."""
    lines = text.split('\n')
    first = next(k for k, line in enumerate(lines) if line.startswith('sites ')) + 1
    last = next(k for k, line in enumerate(lines) if line.startswith('places '))
    for _ in range(6):
        if last - first < 3:
            return
        changed, k = list(lines), rng.randrange(first, last)
        words = changed[k].split(' ')
        w = rng.randrange(len(words))
        if rng.randrange(3) == 0:
            other = rng.randrange(first, last)
            changed[k], changed[other] = changed[other], changed[k]
        else:
            words[w] = rng.choice(('0', '1', '-3*2^1', words[-1], words[0], words[w] + '1', '7*2^40'))
            changed[k] = ' '.join(words)
        if changed != lines:
            yield '\n'.join(changed)


def try_random(program, dyadel, folder, count):
    """What goes wrong; counts in the last line."""
    rng = random.Random(SEED)
    tried = rejected = complete = 0
    for number in range(count):
        source, certificate = folder / 'points.txt', folder / 'certificate.txt'
        source.write_text(points(rng))
        certify(dyadel, source, certificate, '--max-bits', '200')
        text = certificate.read_text()
        answer = subprocess.run([program, certificate], check=False, stdout=subprocess.PIPE, text=True)
        complete += answer.stdout.endswith(', complete\n')
        if answer.returncode != 0:
            yield f'rejected, input {number}:\n{source.read_text()}'
        elif answer.stdout.endswith(', complete\n') and 'outcome decided\n' not in text:
            yield f'complete, but not decided, input {number}:\n{source.read_text()}'
        for mutant in mutants(rng, text):
            certificate.write_text(mutant)
            tried += 1
            if not accepts([program], certificate)[0]:
                rejected += 1
                if accepts([dyadel, 'verify'], certificate)[0]:
                    yield f'a mutant that only verify accepts, input {number}:\n{mutant}'
    print(f'seed {SEED}: {count} certificates accepted, {complete} of them proved complete; '
          f'{tried} mutants, {rejected} of them rejected')
    if rejected * 3 < tried:
        yield 'most mutants are accepted'


def main():
    root, folder = (pathlib.Path(arg).resolve() for arg in sys.argv[1:3])
    dyadel, count = sys.argv[3], int(sys.argv[4]) if len(sys.argv) > 4 else 100
    program = build(root, folder)
    airports = folder / 'checker/airports.txt'
    certify(dyadel, root / 'tests/data/airports.csv', airports, '--columns', 'longitude,latitude')
    found = list(try_random(program, dyadel, folder / 'checker', count))
    answer = subprocess.run([program, airports], check=False, stdout=subprocess.PIPE, text=True).stdout
    print(answer, end='')
    if ': accepted, 3376 sites, 10112 legal pairs' not in answer or not answer.endswith(', complete\n'):
        found.append('the certificate of the airports is rejected, or not proved to be complete')
    square, diagram = folder / 'checker/square.txt', folder / 'checker/diagram.txt'
    square.write_text('0 0\n5 0\n0 4\n6 [5,6]\n')
    certify_diagram(dyadel, square, diagram)
    answer = subprocess.run([program, diagram], check=False, stdout=subprocess.PIPE, text=True).stdout
    print(answer, end='')
    if ': accepted, 4 sites' not in answer or ', diagram not checked, ' not in answer:
        found.append('the certificate with a diagram is rejected, or its diagram is said to be checked')
    print('\n'.join(found) or 'no fault')
    return 1 if found else 0


if __name__ == '__main__':
    sys.exit(main())
