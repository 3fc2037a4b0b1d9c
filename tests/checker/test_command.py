#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""dyadel delaunay --certificate and dyadel verify: every outcome, exit statuses, whole files, size.

Usage: test_command.py DYADEL DATA   (DYADEL_TEST_SCALE=10 measures the size at 10^5 sites instead of 10^4)
"""
import gzip
import os
import pathlib
import random
import subprocess
import sys
import tempfile

DYADEL, DATA = sys.argv[1], pathlib.Path(sys.argv[2])
SCALE = int(os.environ.get('DYADEL_TEST_SCALE', '1'))


def run(*args, stdin=None):
    return subprocess.run([DYADEL, *map(str, args)], input=stdin, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          text=True, check=False)


def certify(folder, points, *options, status=0):
    """The certificate of a points text; the command must end with this status."""
    (folder / 'points.txt').write_text(points)
    certificate = folder / 'certificate.txt'
    certificate.unlink(missing_ok=True)
    done = run('delaunay', '--quiet', '-o', folder / 'out.csv', '--certificate', certificate, *options,
               folder / 'points.txt')
    assert done.returncode == status, done
    return certificate


def accepted(certificate, *texts):
    done = run('verify', certificate)
    assert done.returncode == 0 and not done.stderr, done
    for text in texts:
        assert text in done.stdout, (text, done.stdout)


def rejected(certificate, line):
    done = run('verify', certificate)
    assert done.returncode == 1 and not done.stdout, done
    assert f'{certificate}:{line}: rejected: ' in done.stderr, done.stderr


def check_outcomes(folder):
    accepted(certify(folder, '0 0\n1 0\n0 1\n'), 'outcome decided', '3 legal pairs', 'not listed are illegal')
    accepted(certify(folder, '0 0\n1 0\n0 1\n1 1\n', status=3), 'outcome fixpoint', '2 ties', 'not checked: why')
    accepted(certify(folder, 'sqrt(2) 0\n0 sqrt(2)\n-sqrt(2) 0\n0 -sqrt(2)\n', '--max-bits', '100', status=4),
             'outcome budget')
    accepted(certify(folder, 'sqrt(2) 0\n0 sqrt(2)\n-sqrt(2) 0\n0 -sqrt(2)\n', '--until', 'area:30'),
             'outcome certified, goal area 30', 'bounds of area')
    accepted(certify(folder, ''), '0 legal pairs')
    accepted(certify(folder, '1/3 1/7\n1/3 1/7\n2 5\n'), 'of which 1 aliases', '1 legal pairs')


def check_airports(folder):
    certificate = folder / 'airports.txt'
    for options, status, texts in [
            ([], 0, ['10112 legal pairs', '6737 sure triangles', 'not listed are illegal']),
            (['--measured'], 3, ['10109 legal pairs', '5 indeterminate', 'not listed are illegal']),
            (['--radius', '0.01'], 3, ['8925 legal pairs', '2490 indeterminate', 'each by its chain'])]:
        done = run('delaunay', '--quiet', '--columns', 'longitude,latitude', *options, '-o', '/dev/null', '--certificate',
                   certificate, DATA / 'airports.csv')
        assert done.returncode == status, done
        accepted(certificate, *texts)
    text = certificate.read_text()
    done = run('verify', '-', stdin=text)
    assert done.returncode == 0, done
    certificate.write_text(text[:len(text) // 2])
    assert run('verify', certificate).returncode == 1
    line = text[:text.index('\nlegal ')].count('\n') + 2
    lines = text.split('\n')
    lines[line] = ' '.join(lines[line].split(' ')[:2] + ['0', '0'])
    certificate.write_text('\n'.join(lines))
    rejected(certificate, line + 1)


def check_crowds(folder):
    """Every illegal pair of crowded faces has its chain."""
    certificate = folder / 'crowd.txt'
    done = run('delaunay', '--quiet', '--columns', 'longitude,latitude', '--radius', '0.05', '-o', '/dev/null',
               '--certificate', certificate, DATA / 'airports.csv')
    assert done.returncode == 3, done
    accepted(certificate, '38570 illegal pairs within undecided faces', 'not listed are illegal')
    rng = random.Random(1)
    count, half = min(120 * SCALE, 400), 0.025 * (400 / min(120 * SCALE, 400)) ** 0.5
    middles = [(rng.random(), rng.random()) for _ in range(count)]
    points = ''.join(f'[{x - half},{x + half}] [{y - half},{y + half}]\n' for x, y in middles)
    accepted(certify(folder, points, status=3), 'each by its chain', 'not listed are illegal')


def check_diagrams(folder):
    """dyadel voronoi --certificate: goals on the diagram are checked."""
    certificate = folder / 'diagram.txt'
    circle = ''.join(f'cos(2*pi*{k}/12) sin(2*pi*{k}/12)\n' for k in range(12))
    (folder / 'circle.txt').write_text(circle)
    area, distance = 'checked: the undetermined area of the diagram', '\nchecked: the distance of undetermined points'
    for goal, bits in (('area', 20), ('hausdorff', 100)):
        done = run('voronoi', '--quiet', '--until', f'{goal}:{bits}', '-o', folder / 'out.csv', '--certificate',
                   certificate, folder / 'circle.txt')
        assert done.returncode == 0, done
        accepted(certificate, f'outcome certified, goal voronoi {goal} {bits}', area, distance, 'by 12 polygons')
        text = certificate.read_text()
        number = 'undetermined' if goal == 'area' else 'distance'
        lines = text.split('\n')
        at = next(k for k, line in enumerate(lines) if line.startswith(f'{number} '))
        lines[at] = f'{number} 1'
        certificate.write_text('\n'.join(lines))
        rejected(certificate, len(lines) - 1)  # true, but not what the goal asks
        if goal == 'hausdorff':
            certificate.write_text(text.replace(f'\n{lines[at]}', '').replace('\nend', ' unproved\nend'))
            accepted(certificate, area, 'not checked: the distance', 'not checked: the outcome')
    done = run('voronoi', '--quiet', '--columns', 'longitude,latitude', '--window', '-20,20,40,60', '-o', '/dev/null',
               '--certificate', certificate, DATA / 'airports.csv')
    assert done.returncode == 0, done
    accepted(certificate, area, distance)
    (folder / 'two.txt').write_text('[0,2] [0,2]\n[1,3] [1,3]\n')
    done = run('voronoi', '--quiet', '--certificate', certificate, '-o', '/dev/null', folder / 'two.txt')
    assert done.returncode == 0, done
    assert 'distance none\n' in certificate.read_text()
    accepted(certificate, area)
    done = run('voronoi', '--quiet', '--certificate', '/dev/full', '-o', '/dev/null', folder / 'two.txt')
    assert done.returncode == 1 and 'cannot write' in done.stderr, done


def check_files(folder):
    assert run('verify', folder / 'nothing').returncode == 1
    assert run('verify').returncode == 2
    certificate = certify(folder, '0 0\n1 0\n0 1\n')
    before = certificate.read_text()
    done = run('delaunay', '--quiet', '-o', folder / 'out.csv', '--certificate', '/dev/full', folder / 'points.txt')
    assert done.returncode == 1 and 'cannot write' in done.stderr, done
    # bad input: the former certificate stays
    (folder / 'bad.txt').write_text('0 0\nx y\n')
    assert run('delaunay', '--quiet', '--certificate', certificate, folder / 'bad.txt').returncode == 1
    assert certificate.read_text() == before
    assert sorted(p.name for p in folder.iterdir() if 'certificate' in p.name) == ['certificate.txt']
    done = run('verify', '-o', folder / 'report.txt', certificate)
    assert done.returncode == 0 and 'accepted' in (folder / 'report.txt').read_text()


def check_size(folder):
    rng = random.Random(1)
    count, half = 10**4 * SCALE, 2.0**-30

    def side():
        middle = rng.random()
        return f'[{(middle - half).hex()},{(middle + half).hex()}]'
    (folder / 'points.txt').write_text(''.join(f'{side()} {side()}\n' for _ in range(count)))
    certificate = folder / 'certificate.txt'
    done = run('delaunay', '--quiet', '-o', '/dev/null', '--certificate', certificate, folder / 'points.txt')
    assert done.returncode in (0, 3), done
    accepted(certificate)
    text = certificate.read_bytes()
    legal = int(text[text.index(b'\nlegal '):][7:30].split(b'\n')[0])
    size = len(gzip.compress(text)) / legal
    print(f'{count} boxes: {legal} legal pairs, {len(text) / legal:.1f} bytes a pair, {size:.1f} by gzip')
    assert size <= 100


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for check in (check_outcomes, check_airports, check_crowds, check_diagrams, check_files, check_size):
            check(folder)
    return 0


if __name__ == '__main__':
    sys.exit(main())
