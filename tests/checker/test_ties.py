#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What points are, in certificates [CERT-10]: ties and aliases proved without the engine; forgeries.

Usage: test_ties.py DYADEL
"""
import pathlib
import subprocess
import sys
import tempfile

DYADEL = sys.argv[1]
ALIAS = '{} 0\n10 10\n{} 0\n-9 4\n'
SQUARE = 'sqrt(2) 0\n0 sqrt(2)\n-sqrt(2) 0\n0 -sqrt(2)\n'


def run(*args):
    return subprocess.run([DYADEL, *map(str, args)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)


def gon(n):
    return ''.join(f'cos(2*pi*{k}/{n}) sin(2*pi*{k}/{n})\n' for k in range(n))


def grid(coordinates, c, s):
    return ''.join(f'({a})*{c}-({b})*{s} ({a})*{s}+({b})*{c}\n' for a in coordinates for b in coordinates)


ROOTS = [f'{k}+sqrt({p})' for k, p in enumerate((2, 3, 5, 7))]
ANGLES = ''.join(f'cos({k}*pi/3+1/3)*sqrt(8) sin({k}*pi/3+1/3)*sqrt(8)\n' for k in range(6))
# points; facts by identity and by bound
PROVED = [
    (SQUARE, 1, 0), (gon(5), 1, 0), (gon(12), 1, 0), (gon(97), 1, 0), (ANGLES, 1, 0),
    (grid(ROOTS, 'cos(pi/6)', 'sin(pi/6)'), 13, 0), (grid(ROOTS, '3/5', '4/5'), 13, 0),
    (grid(['0', 'sqrt(2)', '2*sqrt(2)'], 'cos(1)', 'sin(1)'), 8, 0),
    (''.join(f'sqrt({k}) 2*sqrt({k})+1\n' for k in range(2, 12)), 2, 0),
    ('sqrt((1+sqrt(2)/2)/2) sqrt((1-sqrt(2)/2)/2)\n0 1\n-1 0\n0 -1\n', 1, 0),
    ('cosh(1) 0\n0 (exp(1)+exp(-1))/2\n-(e+1/e)/2 0\n0 -cosh(1)\n', 1, 0),
    ('tan(1) 0\n0 sin(1)/cos(1)\nabs(-tan(1))*(-1) 0\n0 -max(tan(1),-3)\n', 1, 0),
    ('root(x^5-x-1,1,2) 0\n0 root(x^5-x-1,1,2)\n-root(x^5-x-1,1,2) 0\n0 -root(x^5-x-1,0,2)\n', 1, 0),
    (ALIAS.format('sqrt(8)', '2*sqrt(2)'), 1, 0), (ALIAS.format('pi+e', 'e+pi'), 1, 0),
    (ALIAS.format('cbrt(2+sqrt(5))+cbrt(2-sqrt(5))', '1'), 0, 1), (ALIAS.format('2*sin(pi/6)', '1'), 1, 0),
    (ALIAS.format('root(x^4-10*x^2+1,3,4)', 'sqrt(2)+sqrt(3)'), 0, 1),
    (ALIAS.format('root(x^5-x-1,1,2)^5', '1+root(x^5-x-1,0,2)'), 1, 0),
    (ALIAS.format('cbrt(-16)', '-2*cbrt(2)'), 1, 0), (ALIAS.format('sqrt(3/8)', 'sqrt(6)/4'), 1, 0),
    (ALIAS.format('1/(1+sqrt(2))', 'sqrt(2)-1'), 1, 0), (ALIAS.format('log(3)+1', '1+log(3)'), 1, 0),
    ('atan(3) 0\n0 atan(3)\n-atan(3) 0\n0 -atan(3)\n', 1, 0), (ALIAS.format('asin(1)*log(2)', 'log(2)*asin(1)'), 1, 0),
    (ALIAS.format('atan(-1/3)+pi-atan(1/3)', 'pi-atan(1/3)+atan(-1/3)'), 1, 0),
    (''.join(f'{r}*cos({k}) {r}*sin({k})\n' for r in ('(acos(-2/5)+log(1/7))',) for k in range(5)), 1, 0)]
# Exponents beyond 2^8 are not enclosed by the checker: it says so.
UNPROVED = [(ALIAS.format('exp(-300)+1', '1+exp(-300)'), 'aliases'),
            ('2+exp(-300) 0\n0 2+exp(-300)\n-2-exp(-300) 0\n0 -2-exp(-300)\n', 'ties')]
# points; text of the certificate; its replacement; why it is rejected
FORGERIES = [
    (SQUARE, '\n= 2\nsqrt 0\n', '\n= 3\nsqrt 0\n', 'not seen to be what the line says'),  # another relation
    (SQUARE, 'sqrt 2 x0', 'sqrt 2 -x0', 'not seen to be what'),                # the other root
    (SQUARE, 'sqrt 2 x0', 'sqrt 2 x1', 'no quotient'),                         # a leaf that is not there
    (SQUARE, 'sqrt 2 x0', 'sqrt 2 x0/0', 'denominator'),
    (SQUARE, 'sqrt 2 x0', 'sqrt 2 x0/x0-x0', 'no quotient'),
    (SQUARE, '\nneg 3\n', '\nneg 4\n', 'lie in the rectangle'),                   # a moved point
    (SQUARE, '\n= 0\n', '\n= 1/1267650600228229401496703205376\n', 'lie in the rectangle'),
    (SQUARE, '\n0 3 4\n', '\n0 4 3\n', 'lie in the rectangle'),
    (SQUARE, '\n0 3 4\n', '\n1 3 4\n', 'not in order|lie in the rectangle'),
    (SQUARE, 'circle 2 3 0 1', 'circle 2 3 0', 'wrong number of points'),
    (SQUARE, 'circle 2 3 0 1', 'circle 2 3 0 0', 'occurs twice'),
    (SQUARE, 'circle 2 3 0 1', 'circle 2 2 0 1', 'not seen to hold'),
    (SQUARE, 'circle 2 3 0 1', 'line 2 3 0 1', 'not seen to hold'),
    (SQUARE, 'circle 2 3 0 1', 'same 2 3', 'not seen to hold'),
    (SQUARE, 'circle 2 3 0 1', 'same 1 3', 'not seen to hold'),                   # of one x
    (SQUARE, 'circle 2 3 0 1', 'circle 2 3 0 9', 'not described'),
    (SQUARE, 'identity\n', 'faith\n', 'no method'),
    (SQUARE, 'algebra 6', 'algebra 5', 'no operation|is missing'),
    (SQUARE, 'sqrt 2 x0', 'sqrt 7 x0', 'too large'),
    (SQUARE, 'sqrt 0', 'log 0', 'not seen to be what'),
    (SQUARE.replace('sqrt', 'log'), 'log 2', 'atan 2', 'lie in the rectangle'),
    (SQUARE.replace('sqrt', 'log'), '= 2\nlog 2', '= -2\nlog 2', 'not seen to be defined'),
    (SQUARE, 'sqrt 0', 'callback', 'not seen to be what'),
    (gon(12), 'cycle 12', 'cycle 8', 'not seen to be defined'),
    (gon(12), 'cycle 12', 'cycle 5000', 'too large'),
    (gon(12), 'cycle 12', 'cycle 0', 'not seen to be defined'),
    (gon(12), '\npi\n* ', '\ne\n* ', 'not seen to be defined|lie in the rectangle|not seen to hold'),
    # another root of the polynomial; a bracket with three roots; a leaf shared by two roots of one polynomial
    (ALIAS.format('root(x^3-3*x+1,1,2)+1', '1+root(x^3-3*x+1,1,2)'), ' x0\n', ' x0^2-2\n', 'not seen to be what'),
    (ALIAS.format('root(x^3-3*x+1,1,2)+1', '1+root(x^3-3*x+1,1,2)'), ' 1,-3,0,1', ' 1,-3,0,2',
     'hold one root|not seen to be what'),
    (ALIAS.format('cbrt(2+sqrt(5))+cbrt(2-sqrt(5))', '1'), 'bound\n', 'identity\n', 'not seen to hold'),
    (ALIAS.format('sqrt(8)', '2*sqrt(2)'), 'sqrt 2 2*x0', 'sqrt 2 3*x0', 'not seen to be what'),
    (ALIAS.format('sqrt(8)', '2*sqrt(2)'), '= 8', '= 18', 'not seen to be what')]


def certificate_of(folder, points):
    (folder / 'points').write_text(points)
    done = run('delaunay', '--quiet', '-o', folder / 'out', '--certificate', folder / 'cert', folder / 'points')
    assert done.returncode in (0, 3), done
    return (folder / 'cert').read_text()


def verified(folder, text, *options):
    (folder / 'cert').write_text(text)
    return run('verify', folder / 'cert', *options)


def check_proved(folder):
    for points, identities, bounds in PROVED:
        text = certificate_of(folder, points)
        for options in ((), ('--points', folder / 'points')):
            done = verified(folder, text, *options)
            assert done.returncode == 0, (points, done)
            assert f'described to be: {identities} identities, {bounds} bounds\n' in done.stdout, (points, done.stdout)


def check_unproved(folder):
    for points, what in UNPROVED:
        done = verified(folder, certificate_of(folder, points))
        assert done.returncode == 3 and what in done.stdout, done


def check_forgeries(folder):
    for points, old, new, why in FORGERIES:
        text = certificate_of(folder, points)
        at = text.index('\nalgebra ')
        assert old in text[at:], (points, old)
        done = verified(folder, text[:at] + text[at:].replace(old, new, 1))
        assert done.returncode == 1 and any(w in done.stderr for w in why.split('|')), (old, new, done)


def check_left_out(folder):
    """Without the facts nothing of them is proved."""
    for points, gap in ((SQUARE, 'ties'), (ALIAS.format('sqrt(8)', '2*sqrt(2)'), 'aliases')):
        text = certificate_of(folder, points)
        at = text.index('\nfacts ')
        done = verified(folder, text[:at] + '\nfacts 0\nend\n')
        assert done.returncode == 3 and gap in done.stdout, done


def check_points(folder):
    """Other points within the same rectangles do not match the description."""
    for points, old, new, status in ((SQUARE, '-sqrt(2) 0', '-sqrt(2)-2^-300 0', 3),
                                     (SQUARE, '-sqrt(2) 0', '-sqrt(2)-2^-30 0', 1),
                                     (SQUARE, '-sqrt(2) 0', '-sqrt(2) sin(pi)', 3)):
        text = certificate_of(folder, points)
        (folder / 'points').write_text(points.replace(old, new))
        done = verified(folder, text, '--points', folder / 'points')
        assert done.returncode == status, (new, done)
        assert status != 3 or '1 of the points given are what the certificate describes' in done.stdout, done


def main():
    with tempfile.TemporaryDirectory() as name:
        for check in (check_proved, check_unproved, check_forgeries, check_left_out, check_points):
            check(pathlib.Path(name))


if __name__ == '__main__':
    main()
