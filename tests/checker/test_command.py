#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""dyadel delaunay --certificate and dyadel verify: every outcome, exit statuses, whole files, size; statements without
a proof are named [CERT-8].

Usage: test_command.py DYADEL DATA   (DYADEL_TEST_SCALE=10 measures the size at 10^5 sites instead of 10^4)
"""
import functools
import gzip
import os
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile
import time
from fractions import Fraction

DYADEL, DATA = sys.argv[1], pathlib.Path(sys.argv[2])
SCALE = int(os.environ.get('DYADEL_TEST_SCALE', '1'))


def run(*args, stdin=None, by=DYADEL):
    return subprocess.run([by, *map(str, args)], input=stdin, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
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


def accepted(certificate, *texts, status=0, options=()):
    """Exit status 0: all is proved, and nothing in the output says otherwise; 3: each statement without a proof is
    named."""
    done = run('verify', certificate, *options)
    assert done.returncode == status and not done.stderr, done
    first = done.stdout.split('\n')[0]
    assert (first == 'accepted, all of it proved') == (status == 0), done.stdout
    assert ('not proved: ' in done.stdout) == (status == 3), done.stdout
    for text in texts:
        assert text in done.stdout, (text, done.stdout)


def rejected(certificate, line):
    done = run('verify', certificate)
    assert done.returncode == 1 and not done.stdout, done
    assert f'{certificate}:{line}: rejected: ' in done.stderr, done.stderr


def check_outcomes(folder):
    accepted(certify(folder, '0 0\n1 0\n0 1\n'), 'outcome decided', '3 legal pairs', 'not listed are illegal')
    accepted(certify(folder, '0 0\n1 0\n0 1\n1 1\n', status=3), 'outcome fixpoint', 'checked: 2 ties, on empty circles',
             'checked: the outcome fixpoint')
    accepted(certify(folder, '0 0\n1 0\n0 1\n[1,1.1] 1\n', status=3), 'not proved: the outcome fixpoint', status=3)
    square = 'sqrt(2) 0\n0 sqrt(2)\n-sqrt(2) 0\n0 -sqrt(2)\n'
    accepted(certify(folder, square, status=3), 'checked: 2 ties, on empty circles', 'checked: the outcome fixpoint')
    accepted(certify(folder, square, '--ties', 'off', '--max-bits', '100', status=4), 'not proved: the outcome budget',
             status=3)
    accepted(certify(folder, square, '--ties', 'off', '--until', 'area:30'),
             'outcome certified, goal area 30', 'bounds of area')
    accepted(certify(folder, ''), '0 legal pairs')
    accepted(certify(folder, '1/3 1/7\n1/3 1/7\n2 5\n'), 'of which 1 aliases', '1 legal pairs')


# Whatever the points are 0 1 is an edge, but while site 5 is known to 1 bit no disc about both boxes is off it: there is
# one once it is narrowed, which is in no open face.
BEYOND = """[-2.930872,82.930872] 0
40 -18.615568
40 41.083296
4.06152 -28.67108
75.93848 -28.67108
sqrt(1600.8001) -sqrt(2013.006097621)
-11.404368 5.585752
97.61944 -0.96452
40 -62.773048
"""


def check_fixpoint(folder):
    """The certificate is proved complete when no point that can be narrowed could decide an indeterminate pair."""
    points = ('--points', folder / 'points.txt')
    for bits, status in ((1, 'indeterminate'), (64, 'legal')):
        certificate = certify(folder, BEYOND, '--start-bits', bits, status=3)
        assert f'\n0,1,{status}\n' in (folder / 'out.csv').read_text(), bits
        accepted(certificate, 'not proved: the outcome fixpoint (narrower rectangles may', status=3, options=points)
    boxes = '[-2,-1] [0,1]\n[-1.5,-0.5] [0.5,1.5]\n'
    ring = ''.join(f'{x} {y}\n' for x, y in ((5, 0), (3, 4), (-2, 5), (-5, 2), (-4, -4), (1, -5)))
    around = ''.join(f'{x} {y}\n' for x, y in ((10, 2), (7, 8), (-1, 10), (-8, 7), (-10, -2), (-6, -8), (3, -9), (8, -6)))
    for far, goal, status in (('', 'decided', 0), ('sqrt(300) 1\n-sqrt(500) 9\n', 'decided', 0), ('sqrt(300) 1\n', 'area 60', 3),
                              ('', 'area 60', 0)):
        certificate = certify(folder, boxes + ring + around + far, status=3)
        certificate.write_text(certificate.read_text().replace('\ngoal decided\n', f'\ngoal {goal}\n'))
        accepted(certificate, f'{"not proved" if status else "checked"}: the outcome fixpoint', status=status, options=points)


def check_airports(folder):
    certificate = folder / 'airports.txt'
    for options, status, texts in [
            ([], 0, ['10112 legal pairs', '6737 certain triangles', 'not listed are illegal']),
            (['--measured'], 3, ['10109 legal pairs', '5 indeterminate', 'not listed are illegal']),
            (['--radius', '0.01'], 3, ['8925 legal pairs', '2490 indeterminate', 'by boxes that cover'])]:
        done = run('delaunay', '--quiet', '--columns', 'longitude,latitude', *options, '-o', '/dev/null', '--certificate',
                   certificate, DATA / 'airports.csv')
        assert done.returncode == status, done
        if status:
            accepted(certificate, *texts, 'not proved: the outcome fixpoint (--points may', status=3)
        points = ('--points', DATA / 'airports.csv', '--columns', 'longitude,latitude', *options)
        accepted(certificate, *texts, f'checked: the outcome {"fixpoint" if status else "decided"}',
                 'the points given lie in', options=points)
    text = certificate.read_text()
    done = run('verify', '-', stdin=text)
    assert done.returncode == 3, done
    certificate.write_text(text[:len(text) // 2])
    assert run('verify', certificate).returncode == 1
    line = text[:text.index('\nlegal ')].count('\n') + 2
    lines = text.split('\n')
    lines[line] = ' '.join(lines[line].split(' ')[:2] + ['0', '0'])
    certificate.write_text('\n'.join(lines))
    rejected(certificate, line + 1)


def check_crowds(folder):
    """Every illegal pair of crowded faces is proved, and certificates stay short."""
    certificate = folder / 'crowd.txt'
    done = run('delaunay', '--quiet', '--columns', 'longitude,latitude', '--radius', '0.05', '-o', '/dev/null',
               '--certificate', certificate, DATA / 'airports.csv')
    assert done.returncode == 3, done
    accepted(certificate, '38850 illegal pairs within undecided faces, by boxes', 'not listed are illegal', status=3)
    assert certificate.stat().st_size < 200 * 18167
    rng = random.Random(1)
    count, half = min(120 * SCALE, 400), 0.025 * (400 / min(120 * SCALE, 400)) ** 0.5
    middles = [(rng.random(), rng.random()) for _ in range(count)]
    points = ''.join(f'[{x - half},{x + half}] [{y - half},{y + half}]\n' for x, y in middles)
    accepted(certify(folder, points, status=3), 'by boxes that cover', 'not listed are illegal',
             options=('--points', folder / 'points.txt'))


def check_diagrams(folder):
    """dyadel voronoi --certificate: goals on the diagram are checked."""
    certificate = folder / 'diagram.txt'
    circle = ''.join(f'cos(2*pi*{k}/12) sin(2*pi*{k}/12)\n' for k in range(12))
    (folder / 'circle.txt').write_text(circle)
    area, distance = 'checked: the undecided area of the diagram', '\nchecked: the distance of undecided points'
    for goal, bits in (('area', 20), ('hausdorff', 100)):
        done = run('voronoi', '--quiet', '--ties', 'off', '--until', f'{goal}:{bits}', '-o', folder / 'out.csv', '--certificate',
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
            certificate.write_text(text.replace('\nend', ' unproved\nend'))
            accepted(certificate, area, 'not proved: the distance', 'not proved: the outcome', status=3)
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


HEAD = 'dyadel certificate 1\noutcome {}\ngoal {}\ncapped no\nsites 3\n{}\nlegal 0\nplaces 0\nbridges 0\ncorners 0\n'
TAIL = 'pairs\ntriangles 0\nunproved 3\narea {}\nhausdorff {}\nend\n'


def check_claims(folder):
    """A statement without a proof is never reported as proved."""
    certificate = folder / 'claims.txt'
    certificate.write_text((HEAD + TAIL).format('decided', 'decided', '0 0\n1 0\n0 1', 'none', 'none'))
    accepted(certificate, 'not proved: that 3 pairs', 'not proved: the outcome decided', status=3)
    wide = '0+3 0+3\n1*2^4+3 0+3\n0+3 1*2^4+3'
    certificate.write_text((HEAD + TAIL).format('certified', 'area 1000', wide, '0', 'none'))
    accepted(certificate, 'not proved: that 3 pairs', 'not proved: the bounds', 'not proved: the outcome certified',
             status=3)
    # an unknown section, one repeated, one before its time; a pair twice, a pair of one site
    good = certify(folder, '0 0\n1 0\n0 1\n1 1\n', status=3).read_text()
    for before, after in [('pairs\n', 'notes 0\npairs\n'), ('corners', 'bridges 0\ncorners'), ('pairs\n', 'pairs\npairs\n'),
                          ('bridges 0\n', ''), ('t 0 3\n', 't 0 3\nt 0 3\n'), ('t 0 3\n', 't 0 0\nt 0 3\n'),
                          ('t 0 3\n', 'o 0 1\nt 0 3\n'), ('end\n', 'end\nend\n'), ('end\n', 'hausdorff 9\nend\n')]:
        assert before in good, before
        certificate.write_text(good.replace(before, after))
        assert run('verify', certificate).returncode == 1, (before, after)
    certificate.write_text(good.replace('0 1*2^0', '0 1').replace('\n1 1\n', '\n= 0\n'))
    assert run('verify', certificate).returncode == 1  # an alias in pairs


def check_points(folder):
    """--points ties a certificate to an input."""
    text = 'sqrt(2) 0\n0 sqrt(2)\n-sqrt(2) 0\n1/3 [0.1,0.2]\n1/3 1/7\n1/3 1/7\n'
    certificate = certify(folder, text, status=3)
    points = folder / 'points.txt'
    accepted(certificate, 'checked: the points given lie', status=3, options=('--points', points))
    for changed, why in [(text + '5 5\n', 'it has 6 sites, and there are 7 points'),
                         (text.replace('sqrt(2) 0\n0', 'sqrt(3) 0\n0', 1), 'site 0 does not hold'),
                         (text.replace('-sqrt(2)', '[-2,-1]'), 'site 2 is not that of'),
                         (text.replace('0.1,0.2', '0.1,0.25'), 'site 3 is not that of'),
                         (text.replace('0.1,0.2', '0.12,0.18'), 'site 3 is not that of'),
                         (text[:text.rindex('1/3')] + '1/3 1/8\n', 'site 5 is not that of')]:
        points.write_text(changed)
        done = run('verify', certificate, '--points', points)
        assert done.returncode == 1 and not done.stdout and f'rejected: ' in done.stderr and why in done.stderr, done
    points.write_text(text)
    # where a refinable point is stated to be an exact one, nothing shows it
    exact = certificate.read_text().split('\n')
    assert exact[4] == 'sites 6', exact[:6]
    (folder / 'triangle.txt').write_text('1 0\n0 1\n-1 0\n')
    done = run('delaunay', '--quiet', '-o', '/dev/null', '--certificate', certificate, folder / 'triangle.txt')
    assert done.returncode == 0, done
    points.write_text('sin(pi/2) 0\n0 1\n-1 0\n')
    accepted(certificate, 'not proved: that 1 of the points given lie', status=3, options=('--points', points))
    points.write_text('name;x\n')
    done = run('verify', certificate, '--points', points)
    assert done.returncode == 1 and f'{points}:1:' in done.stderr, done
    for options in (('--radius', '1'), ('--columns', 'a,b'), ('--measured',)):
        done = run('verify', certificate, *options)
        assert done.returncode == 2 and 'give their file with --points' in done.stderr, done
    done = run('verify', '-', '--points', '-')
    assert done.returncode == 2 and 'cannot be both' in done.stderr, done


def value(text):
    """The two ends of a coordinate; None: it is none."""
    ends = text[1:-1].split(',') if text.startswith('[') else [text, text]
    try:
        low, high = map(Fraction, ends)
    except (ValueError, ZeroDivisionError):
        return None
    return (low, high) if low <= high else None


def points_of(text):
    return [[value(side) for side in line.split()] for line in text.splitlines()]


def altered(rng, text):
    """One step from the text: a line removed, repeated, moved; a digit changed, added, removed; a sign."""
    lines = text.splitlines(keepends=True)
    a, b, kind = rng.randrange(len(lines)), rng.randrange(len(lines)), rng.randrange(6)
    if kind == 0:
        del lines[a]
    elif kind == 1:
        lines.insert(b, lines[a])
    elif kind == 2:
        lines[a], lines[b] = lines[b], lines[a]
    else:
        line = lines[a]
        k = rng.choice([k for k, c in enumerate(line) if c.isdigit()])
        by = {3: str(rng.randrange(10)), 4: line[k] + str(rng.randrange(10)), 5: rng.choice(['', '-' + line[k]])}[kind]
        lines[a] = line[:k] + by + line[k + 1:]
    return ''.join(lines)


def check_altered_points(folder):
    """Other points are never taken for those of the certificate; 1,000 files with DYADEL_TEST_SCALE=5."""
    rng = random.Random(1)

    def side():
        low = rng.randrange(-999, 999)
        return rng.choice([f'{low / 100}', f'{low}/7', f'[{low / 100},{low / 100 + 0.25}]', f'[{low},{low + 40}]'])
    text = ''.join(f'{side()} {side()}\n' for _ in range(12))
    certificate = certify(folder, text, status=3)
    same = 0
    for _ in range(200 * SCALE):
        other = altered(rng, text)
        (folder / 'points.txt').write_text(other)
        done = run('verify', certificate, '--points', folder / 'points.txt')
        equal = points_of(other) == points_of(text)
        assert done.returncode == (0 if equal else 1), (other, done)
        same += equal
    print(f'{200 * SCALE} altered files of points, {same} of which say the same')


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


def copied(folder):
    """The command in another folder, where it finds its library."""
    folder.mkdir(parents=True)
    os.environ['LD_LIBRARY_PATH'] = str(pathlib.Path(DYADEL).resolve().parents[2])
    return shutil.copy(DYADEL, folder / 'dyadel')


def check_found(folder):
    """dyadel-proved is searched for next to the command, in libexec, in a build, and last in PATH; if it is missing,
    the message lists the places searched and the package to install."""
    certificate, path = certify(folder, '0 0\n1 0\n0 1\n'), os.environ['PATH']
    os.environ['PATH'] = str(folder / 'elsewhere')
    for own, places, remedy in (('usr/bin', ('usr/bin', 'usr/libexec'), 'omit --proved, or install dyadel-proved'),
                                ('build/src/cli', ('build/src/cli', 'build/proofs'), f'ninja -C {folder}/build)')):
        command = copied(folder / own)
        done = run('verify', '--proved', certificate, by=command)
        assert done.returncode == 1 and f'there is no dyadel-proved in {folder / places[own[0] == "b"]}/' in done.stderr, done
        assert remedy in done.stderr, done
        for place in ('elsewhere', *reversed(places)):  # each placed before the ones already tried
            (folder / place).mkdir(parents=True, exist_ok=True)
            (folder / place / 'dyadel-proved').write_text(f'#!/bin/sh\necho in {place}\nexit 3\n')
            (folder / place / 'dyadel-proved').chmod(0o755)
            done = run('verify', '--proved', certificate, by=command)
            assert (done.returncode, done.stdout, done.stderr) == (3, f'in {place}\n', ''), done
        (folder / places[0] / 'dyadel-proved').chmod(0o644)  # no program
        assert run('verify', '--proved', certificate, by=command).stdout == f'in {places[1]}\n'
        (folder / 'elsewhere' / 'dyadel-proved').unlink()
    os.environ['PATH'] = path


def check_proved(folder):
    """--proved is what dyadel-proved says: here scripts of that name in PATH (proofs/checker.py has the real one)."""
    certificate, tools, path = certify(folder, '0 0\n1 0\n0 1\n'), folder / 'tools', os.environ['PATH']
    tools.mkdir()
    program, answer = tools / 'dyadel-proved', folder / 'answer.txt'
    own = functools.partial(run, by=copied(folder / 'bin'))
    os.environ['PATH'] = str(tools)
    program.touch(0o755)
    for script, status, error in (('exit 0', 0, ''), ('exit 3', 3, ''), ('echo no >&2; exit 1', 1, 'no\n'),
                                  ('kill -9 $$', 1, f'dyadel: {certificate}: not judged: dyadel-proved was ended by signal 9\n')):
        program.write_text(f'#!/bin/sh\necho of "$@"\n{script}\n')
        done = own('verify', '--proved', certificate)
        assert (done.returncode, done.stdout, done.stderr) == (status, f'of {certificate}\n', error), done
        answer.unlink(missing_ok=True)
        done = own('verify', '--proved', '-o', answer, certificate)
        assert done.returncode == status and answer.exists() == (status != 1) and not done.stdout, done
    points, others = folder / 'points.txt', folder / 'others.txt'
    points.write_text('0 0\n1 0\n0 1\n')
    others.write_text('0 0\n1 0\n0 2\n')
    program.write_text('#!/bin/sh\necho proved\n')
    done = own('verify', '--proved', '--points', points, certificate)
    assert done.returncode == 0 and done.stdout.startswith('proved\ncompared by dyadel itself: the points'), done
    done = own('verify', '--proved', '--points', others, certificate)
    assert done.returncode == 1 and not done.stdout and 'rejected' in done.stderr, done
    done = own('verify', '--proved', '--points', points, '-')
    assert done.returncode == 2 and 'is read twice' in done.stderr, done
    program.write_text('#!/bin/sh\necho no >&2; exit 1\n')
    done = own('verify', '--proved', '--points', points, certificate)
    assert done.returncode == 1 and not done.stdout and done.stderr == 'no\n', done
    program.write_text('#!/bin/sh\nexec /bin/sleep 100\n')
    begun = time.monotonic()
    done = own('verify', '--proved', '--timeout', '0.5', certificate)
    assert done.returncode == 4 and 'time limit reached' in done.stderr, done
    assert sys.platform != 'linux' or time.monotonic() - begun < 50, 'the program goes on after its command'
    os.environ['PATH'] = path


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
    accepted(certificate, options=('--points', folder / 'points.txt'))
    text = certificate.read_bytes()
    legal = int(text[text.index(b'\nlegal '):][7:30].split(b'\n')[0])
    size = len(gzip.compress(text)) / legal
    print(f'{count} boxes: {legal} legal pairs, {len(text) / legal:.1f} bytes a pair, {size:.1f} by gzip')
    assert size <= 100


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for check in (check_outcomes, check_fixpoint, check_airports, check_crowds, check_diagrams, check_claims, check_points,
                      check_altered_points, check_files, check_found, check_proved, check_size):
            check(folder)
    return 0


if __name__ == '__main__':
    sys.exit(main())
