#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Blocks of certificates, which define points: dyadel-proved against `dyadel verify` [CERT-10].

Usage: blocks.py DYADEL_PROVED DYADEL [COUNT]

Certificates of points that are proved to be different, or the same, by their expressions, and of COUNT random
expressions (default 16); each line of a block changed, and the rectangles. A certificate that verify accepts is proved;
one that it refuses is refused, or not proved. Facts by bound, and numbers that are nearly right: proved by both or by
none.
Regular polygons of 3 to 24 corners, all proved; each of them with its cycle, an index, a cosine, a sine, the sign of
one changed, all refused.
"""
import pathlib
import random
import re
import sys
import tempfile

from checker import ALL, NOT_ALL, REJECTED, Checkers

SEED = 5
ALIAS = '{} 0\n10 10\n{} 0\n-9 4\n'
SQUARE = 'sqrt(2) 0\n0 sqrt(2)\n-sqrt(2) 0\n0 -sqrt(2)\n'
# points; number of described points; number of facts
KNOWN = [
    (SQUARE, 4, 1),
    (''.join(f'cos({k}+1/3)*sqrt(8) sin({k}+1/3)*sqrt(8)\n' for k in range(6)), 6, 1),
    (''.join(f'sqrt({k}) 2*sqrt({k})+1\n' for k in range(2, 12)), 10, 2),
    ('sqrt((1+sqrt(2)/2)/2) sqrt((1-sqrt(2)/2)/2)\n0 1\n-1 0\n0 -1\n', 4, 1),
    ('cosh(1) 0\n0 (exp(1)+exp(-1))/2\n-(e+1/e)/2 0\n0 -cosh(1)\n', 4, 1),
    ('tan(1) 0\n0 sin(1)/cos(1)\nabs(-tan(1))*(-1) 0\n0 -max(tan(1),-3)\n', 4, 1),
    ('root(x^5-x-1,1,2) 0\n0 root(x^5-x-1,1,2)\n-root(x^5-x-1,1,2) 0\n0 -root(x^5-x-1,0,2)\n', 4, 1),
    ('log(2) 0\n0 log(2)\n-log(2) 0\n0 -log(2)\n', 4, 1),
    ('asin(1/3)+acos(1/3) 0\n0 acos(1/3)+asin(1/3)\n-acos(1/3)-asin(1/3) 0\n0 -asin(1/3)-acos(1/3)\n', 4, 1),
    (''.join(f'atan({k}) 2*atan({k})+log(3)\n' for k in range(-5, 5)), 10, 2),
    (''.join(f'acos(-2/5)*log(1/7)*cos({k}) acos(-2/5)*log(1/7)*sin({k})\n' for k in range(1, 6)), 5, 1),
    (ALIAS.format('sqrt(8)', '2*sqrt(2)'), 2, 1), (ALIAS.format('pi+e', 'e+pi'), 2, 1),
    (ALIAS.format('root(x^5-x-1,1,2)^5', '1+root(x^5-x-1,0,2)'), 2, 1),
    (ALIAS.format('log(2)', 'log(2)'), 2, 1), (ALIAS.format('atan(-1/3)+atan(1/3)+pi', 'pi+atan(1/3)+atan(-1/3)'), 2, 1),
    (ALIAS.format('asin(1)*2', '2*asin(1)'), 2, 1), (ALIAS.format('acos(-1)', 'acos(-1)'), 2, 1),
    (ALIAS.format('log(2)', 'log(sqrt(2)^2)'), 2, 1), (ALIAS.format('atan(sqrt(8))', 'atan(2*sqrt(2))'), 2, 1),
    (ALIAS.format('asin(sqrt(3/8))', 'asin(sqrt(6)/4)'), 2, 1), (ALIAS.format('acos(sqrt(3/8))', 'acos(sqrt(6)/4)'), 2, 1),
    (ALIAS.format('log(2)/log(1024)', 'log(2)/log(1024)'), 2, 1), (ALIAS.format('atan(e^9)-1', 'atan(e^9)-1'), 2, 1),
    (ALIAS.format('log(log(3))*asin(2/3)', 'asin(2/3)*log(log(3))'), 2, 1), (ALIAS.format('log(2)-log(2)+e', 'e'), 2, 1),
    (ALIAS.format('cbrt(-16)', '-2*cbrt(2)'), 2, 1), (ALIAS.format('sqrt(3/8)', 'sqrt(6)/4'), 2, 1),
    (ALIAS.format('1/(1+sqrt(2))', 'sqrt(2)-1'), 2, 1), (ALIAS.format('tanh(2)*cosh(2)', 'sinh(2)'), 2, 1),
    (ALIAS.format('min(exp(-3),pi)*exp(3)', '1+0*pi'), 2, 1), (ALIAS.format('(pi^-2)^-3', 'pi^6'), 2, 1),
    (ALIAS.format('2*sin(pi/6)', '1'), 2, 1), (ALIAS.format('sin(pi-pi)+sqrt(2)', 'sqrt(2)'), 2, 1),
    (ALIAS.format('cos(2*pi/7)+cos(4*pi/7)+cos(6*pi/7)', '-1/2'), 2, 1), (ALIAS.format('tan(pi/7)*cos(pi/7)', 'sin(pi/7)'), 2, 1),
    (ALIAS.format('cos(pi/17)*cos(-2*pi/17)', '(cos(pi/17)+cos(3*pi/17))/2'), 2, 1),
    (ALIAS.format('cos(2*pi/1000)^2', '(1+cos(pi/250))/2'), 2, 1), (ALIAS.format('sin(19*pi/15)', '-sin(4*pi/15)'), 2, 1),
    (ALIAS.format('root(2*x^3-3*x^2-6*x+1,0,1)+pi', 'pi+root(2*x^3-3*x^2-6*x+1,0,1)'), 2, 1)]
# Of which some facts are by bound.
BOUND = [
    (ALIAS.format('cos(pi/5)', '(1+sqrt(5))/4'), 2, 1), (ALIAS.format('root(x^4-10*x^2+1,3,4)', 'sqrt(2)+sqrt(3)'), 2, 1),
    (ALIAS.format('sqrt(2)+sqrt(3)', 'sqrt(5+2*sqrt(6))'), 2, 1), (ALIAS.format('cbrt(2+sqrt(5))+cbrt(2-sqrt(5))', '1'), 2, 1),
    (ALIAS.format('1/(sqrt(2)+sqrt(3))', '1/sqrt(5+2*sqrt(6))'), 2, 1),
    (ALIAS.format('root(x^6-x^2-1,1,2)^2', 'root(x^3-x-1,1,2)'), 2, 1),
    (ALIAS.format('root(x^3-x-1,1,2)', 'cbrt(1/2+sqrt(23/108))+cbrt(1/2-sqrt(23/108))'), 2, 1),
    (ALIAS.format('sqrt(2)+sqrt(3)+sqrt(5)', 'root(x^8-40*x^6+352*x^4-960*x^2+576,5,6)'), 2, 1),
    (ALIAS.format('cos(2*pi/17)', '(-1+sqrt(17)+sqrt(34-2*sqrt(17))'
                  '+2*sqrt(17+3*sqrt(17)-sqrt(34-2*sqrt(17))-2*sqrt(34+2*sqrt(17))))/16'), 2, 1),
    ('sqrt(5+2*sqrt(6)) 0\n0 sqrt(2)+sqrt(3)\n-root(x^4-10*x^2+1,3,4) 0\n0 -sqrt(5+sqrt(24))\n', 4, 1),
    ('sqrt(2)+sqrt(3) cbrt(2)\ncbrt(2) sqrt(5+2*sqrt(6))\n-root(x^4-10*x^2+1,3,4) cbrt(2)\n-cbrt(2) -sqrt(5+sqrt(24))\n', 4, 1),
    ('0 0\nsqrt(2)+sqrt(3) sqrt(20+8*sqrt(6))\n-root(x^4-10*x^2+1,3,4) -sqrt(8)-sqrt(12)\n1 7\n', 3, 1)]
# Their ties are proved, and with them the outcome.
TIED = [KNOWN[k][0] for k in range(11)] + [BOUND[k][0] for k in (9, 10)]
TIED += [SQUARE + '[9,9.001] [7,7.001]\n', SQUARE + 'pi 5\n-7 e\n6 -4\n']
OTHER = {'+': '-', '-': '+', '*': '/', '/': '*', 'min': 'max', 'max': 'min', 'neg': 'abs', 'abs': 'neg', 'sqrt': 'cbrt',
         'cbrt': 'sqrt', 'cos': 'sin', 'sin': 'cos', 'tan': 'sin', 'log': 'atan', 'atan': 'tan', 'asin': 'acos', 'acos': 'asin', 'exp': 'cosh', 'sinh': 'cosh', 'cosh': 'sinh',
         'tanh': 'sinh', 'pi': 'e', 'e': 'pi', 'same': 'line', 'line': 'circle', 'circle': 'line'}


class OfBlocks(Checkers):
    def faults(self, text, name):
        """Where the two differ that must not."""
        here, there = self.ask(self.proved, text=text), self.ask(self.dyadel, 'verify', text=text)
        shown = here.returncode != REJECTED and not re.search('not proved: that .* (lie where|facts on points)', here.stdout)
        self.tried += 1
        self.rejected += here.returncode == REJECTED
        self.all += shown
        if here.returncode not in (ALL, NOT_ALL, REJECTED) or (here.returncode == REJECTED and ': rejected: ' not in here.stderr):
            yield f'{name}: {here}'
        elif shown and there.returncode == REJECTED:
            yield f'{name}: proved, but verify says {there.stderr}\n{text}'
        elif there.returncode != REJECTED and not shown:
            yield f'{name}: verify accepts, but: {here.stdout}{here.stderr}\n{text}'


def expression(rng, depth):
    """A random expression that is defined, and no large number."""
    if depth == 0:
        return rng.choice(['2', '3/7', '-5', 'pi', 'e', 'sqrt(2)', 'sqrt(3)', 'cbrt(5)', 'root(x^3-x-1,1,2)', '1/16', 'cos(2*pi/7)',
                           'sin(pi/6)', 'cos(-3*pi/8)'])
    a, b = expression(rng, depth - 1), expression(rng, depth - 1)
    return rng.choice([f'({a})+({b})', f'({a})-({b})', f'({a})*({b})', f'({a})/(20+({b})^2)', f'sqrt(1+({a})^2)',
                       f'cbrt({a})', f'cos(1+({a})^2)', f'sin(({a})/3)+{b}', f'exp(cos({a}+1))', f'abs({a})', f'min({a},{b})',
                       f'max({a},({b})/2)', f'log(1+({a})^2)',
                       f'atan({a})', f'asin(cos({a})/2)', f'acos(sin({a})/3)+({b})', f'({a})^{rng.randrange(-1, 4)}'.replace('^-1', '^2')])


def changed_word(rng, word):
    """Other words in its place."""
    if word in OTHER:
        yield OTHER[word]
    if re.fullmatch(r'-?[0-9]+', word):
        number = int(word)
        yield from (str(z) for z in (number + 1, number - 1, -number, 0, 2 ** 70) if z != number)
        yield from ('-4096', '4096', '4097', f'0{word}', f'+{word}', f'{word}/2')
    elif re.search('[0-9]', word):  # a quotient of polynomials, a fraction, coefficients
        places = [m for m in re.finditer('[0-9]+', word)]
        for place in rng.sample(places, min(3, len(places))):
            for digits in (str(int(place[0]) + 1), str(int(place[0]) + 2), '0', '4097'):
                yield word[:place.start()] + digits + word[place.end():]
        yield word[1:] if word.startswith('-') else f'-{word}'
        yield from (f'{word}/2', f'{word}+1', f'{word}*x0', f'{word}/x0-x0')
    elif word in ('identity', 'bound'):
        yield 'faith'


def forged_blocks(rng, text, most):
    """The text with one line of the blocks changed: a word, its place, removed, repeated."""
    lines = text.split('\n')
    first, last = lines.index(next(row for row in lines if row.startswith('algebra '))), lines.index('end')
    found = []
    for k in range(first, last):
        words = lines[k].split(' ')
        for w, word in enumerate(words):
            found += [lines[:k] + [' '.join(words[:w] + [other] + words[w + 1:])] + lines[k + 1:] for other in changed_word(rng, word)]
        found += [lines[:k] + lines[k + 1:], lines[:k] + [lines[k]] + lines[k:], lines[:k] + [f'{lines[k]} 0'] + lines[k + 1:]]
        if k > first:
            found.append(lines[:k - 1] + [lines[k], lines[k - 1]] + lines[k + 1:])
    yield from ('\n'.join(some) for some in rng.sample(found, min(most, len(found))))


def moved_sides(text):
    """The text with each side lo+w of a site in the next place, and narrowed by one unit of its width at either end."""
    lines = text.split('\n')
    first = next(k for k, line in enumerate(lines) if line.startswith('sites ')) + 1
    value = lambda word: [int(z) for z in (word + '*2^0').split('*2^')[:2]]  # noqa: E731
    for k in range(first, first + int(lines[first - 1].split(' ')[1])):
        words = lines[k].split(' ')
        for w, word in enumerate(words):
            if '+' not in word:
                continue
            (lo, e), (size, f) = (value(part) for part in word.split('+'))
            unit = min(e, f) - 8
            lo, size = lo << (e - unit), size << (f - unit)
            for at, width in ((lo + size, size), (lo - size, size), (lo - (size << 9), size)):
                yield '\n'.join(lines[:k] + [' '.join(words[:w] + [f'{spelled(at, unit)}+{spelled(width, unit)}'] + words[w + 1:])] + lines[k + 1:])


def spelled(man, exponent):
    while man and man % 2 == 0:
        man, exponent = man // 2, exponent + 1
    return f'{man << exponent}' if exponent >= 0 and not exponent else f'{man}*2^{exponent}' if man else '0'


def block_of(numbers, points, facts=(), sites=('1+1 0+1', '9 9')):
    """A certificate of two sites with a block on the first, the rectangle of which is [1,2] by [0,1]."""
    return '\n'.join(['dyadel certificate 1', 'outcome budget', 'goal decided', 'capped no', 'sites 2', *sites, 'legal 0',
                      'places 0', 'bridges 0', 'corners 0', 'pairs', 'triangles 0', 'unproved 1', 'area none', 'hausdorff none',
                      f'algebra {len(numbers)}', *numbers, f'points {len(points)}', *points, f'facts {len(facts)}', *facts, 'end', ''])


def tiny(n):
    """(sqrt(2)-1)^n, n even, about 2^(-1.27 n), in a leaf that is the root of 2; to be followed by a sign."""
    a, b = 1, 0
    for _ in range(n):
        a, b = a + 2 * b, a + b
    return f'-{b}*x0+{a}'


# numbers, the last but one and the last being the point of site 0; is it in [1,2] by [0,1]?
PLACES = [
    (['= 1', '= 0'], True), (['= 2', '= 1'], True), (['= 3/2', '= 1/2'], True), (['= 2147483649/2147483648', '= 0'], True),
    ([f'= {2**300 + 1}/{2**300}', f'= {2**300 - 1}/{2**300}'], True), ([f'= {2**300 - 1}/{2**300}', '= 0'], False),
    ([f'= {2**301 + 1}/{2**300}', '= 0'], False), (['= 1', f'= -1/{2**300}'], False), (['= 1', f'= {2**300 + 1}/{2**300}'], False),
    (['= 2147483647/2147483648', '= 0'], False), (['= 4294967297/2147483648', '= 0'], False), (['= 3/2', '= -1/2147483648'], False),
    (['= 1', '= 0', '/ 0 1', '= 0'], False), (['= 1', '= 0', '^ 1 -1', '= 0'], False), (['= 0', '^ 0 0', '= 0'], True),
    (['= -1', 'sqrt 0', '= 0'], False), (['= 2', 'sqrt 0', '= 1'], True), (['= 2', 'sqrt 0', '- 1 1', '/ 0 2', '= 0'], False),
    (['= 2', 'sqrt 0', '- 1 1', 'sqrt 2', '+ 1 3', '= 1'], True), (['= 1', 'cos 0', 'sin 0'], False), (['= 1', 'sin 0', 'cos 0'], False),
    (['= 1', 'exp 0', '= 2', '/ 1 2', '= 0'], True), (['pi', '= 2', '/ 0 1', '= 0'], True), (['pi', '= 1', '- 0 1', '= 0'], False),
    (['root 1 2 -2,0,1', '= 0'], True), (['root -2 2 -2,0,1', '= 0'], False), (['root -2 -1 -2,0,1', '= 0'], False),
    (['root 0 1 -2,0,1', '= 0'], False), (['root 2 1 -2,0,1', '= 0'], False), (['root 1 2 -2,0,1 x0', '= 0'], False),
    (['root 1 2 0,-2,0,1', '= 0'], True), (['root -1 2 0,-2,0,1', '= 0'], False), (['= 2', 'sqrt 0', 'root 1 2 -2,0,1 x0', '= 0'], True),
    (['= 2', 'sqrt 0', 'root 1 2 -2,0,1 -x0', '= 0'], False), (['= 2', '^ 0 4096', '^ 1 4096', '= 0'], False),
    (['= 3/2', '^ 0 4096', '^ 1 -1', '+ 0 2', '= 0'], True), (['= 2', 'cbrt 0', '= 1'], True), (['= -2', 'cbrt 0', '= 1'], False),
    (['= 4', 'sqrt 0 2', '= 0'], True), (['= 4', 'sqrt 0 -2', 'neg 1', '= 0'], False), (['= 4', 'sqrt 0 3', '= 0'], False),
    (['= 4', 'sqrt 0 -2', '= 1', '= 0'], False), (['= 4', 'sqrt 0 3', '= 1', '= 0'], False), (['= 8', 'cbrt 0 3', '= 1', '= 0'], False),
    (['= 8', 'cbrt 0 2', '= 1', '= 0'], True), (['= -1', 'sqrt 0', '= 1', '= 0'], False), (['= 0', '^ 0 -1', '= 1', '= 0'], False),
    (['= 1', '= 0', '/ 0 1', '= 1', '= 0'], False), (['root -3/2 2 0,-2,0,1', '= 0'], False), (['root 3 4 -2,0,1', '= 1', '= 0'], False),
    (['= 2', 'sqrt 0', 'root 1 2 -2,0,1 -x0', '= 1', '= 0'], False), (['= 2', 'sqrt 0', 'root 1 2 -2,0,1 2', '= 1', '= 0'], False),
    (['root 1 2 -2,0,1 3/2', '= 1', '= 0'], False), (['= 2', 'sqrt 0', '= x0+0', '= 0'], False),
    (['= x0', '= 1', '= 0'], False), (['= 1', '= 1/x0', '= 1', '= 0'], False),
    (['= 1', 'callback', '* 0 1', '= 0'], False),
    (['= 1', 'cosh 0', '= 1', '= 0'], False), (['= 1', 'exp 0', 'cosh 0', '= 1', '= 0'], True), (['= 1', 'tanh 0', '= 1', '= 0'], False),
    (['= 1', 'sinh 0', '= 1', '= 0'], False),
    (['cycle 5', 'root 0 1 -1,1,1 x0', '= 1', '= 0'], True), (['cycle 6', 'root 0 1 -1,1,1 x0', '= 1', '= 0'], False),
    (['cycle 10', 'root 0 1 -1,1,1 x0', '= 1', '= 0'], False), (['cycle 5', 'root 0 1 -1,1,1 x0+1', '= 1', '= 0'], False),
    (['cycle 8', '= 2', 'sqrt 1 x0', '= 1', '= 0'], True), (['cycle 8', '= 2', 'sqrt 1 -x0', '= 1', '= 0'], False),
    (['cycle 7', '= 2', 'sqrt 1 x0', '= 1', '= 0'], False), (['cycle 9', '= 2', 'sqrt 1 x0', '= 1', '= 0'], False),
    (['cycle 12', 'root 1 2 -3,0,1 x0', '= 1', '= 0'], True), (['cycle 1', '= 4', 'sqrt 1 x0', '= 1', '= 0'], True),
    (['cycle 2', '= -8', 'cbrt 1 x0', '= 1', '= 0'], True), (['cycle 3', '= -1', 'cbrt 1 x0', '= 1', '= 0'], True),
    (['cycle 4', '= 0', 'cbrt 1 x0', '= 1', '= 0'], True), (['cycle 6', '= 1', 'cbrt 1 x0', '= 1', '= 0'], True),
    (['cycle 1', '= 2', '- 0 1', 'cos 2', 'sqrt 3 1', '= 1', '= 0'], True), (['cycle 3', '= 1', '+ 0 1', 'cos 2', 'sqrt 3 1', '= 1', '= 0'], True),
    (['pi', 'cycle 12', '* 0 0', 'cos 2', 'cbrt 3 -1', '= 1', '= 0'], False),
    (['e', 'pi', 'cycle 12', '* 0 1', 'cos 3', 'cbrt 4 -1', '= 1', '= 0'], False),
    (['cycle 0', '= 1', '= 0'], False), (['cycle -5', '= 1', '= 0'], False), (['cycle 1024', '= 1', '= 0'], True),
    (['cycle 1025', '= 1', '= 0'], False), (['cycle 5', 'cycle 5', '= 1', '= 0'], False), (['cycle 5', '= 0'], False),
    (['cycle 8', '= 0'], True), (['cycle 1', '= 0'], True), (['cycle 2', 'neg 0', '= 0'], True), (['cycle 3', 'neg 0', '= 0'], False),
    (['pi', '= 2', '* 0 1', '= 1', 'cos 2'], True), (['pi', 'cycle 4', '= 2', '/ 0 2', '= 1', 'sin 3'], True),
    (['pi', 'cycle 12', '= 6', '/ 0 2', 'cos 3', '= 2', '* 4 5', 'cbrt 6 x1', '= 1', '= 0'], False),
    (['pi', 'cycle 12', '= 6', '/ 0 2', 'cos 3', '* 4 4', 'sqrt 5 x1/2', '= 1', '= 0'], True),
    (['pi', 'cycle 12', '= 3', '/ 0 2', 'cos 3', '* 4 4', 'sqrt 5 x1/2', '= 1', '= 0'], False),
    (['pi', 'cycle 12', '= 3', '/ 0 2', 'sin 3', '* 4 4', 'sqrt 5 x1/2', '= 1', '= 0'], True),
    (['pi', 'cycle 12', '= -6', '/ 0 2', 'sin 3', '= 8', '/ 4 5', 'cbrt 6 -1/2', '= 1', '= 0'], False),
    (['pi', 'cycle 12', '= -6', '/ 0 2', 'sin 3', '= 4', '/ 4 5', 'cbrt 6 -1/2', '= 1', '= 0'], True),
    (['pi', 'cycle 12', '= -6', '/ 0 2', 'sin 3', '= 4', '/ 4 5', 'cbrt 6 1/2', '= 1', '= 0'], False),
    (['pi', 'cycle 12', '= 6', '/ 0 2', 'sin 3', '= 4', '/ 4 5', 'cbrt 6 1/2', '= 1', '= 0'], True),
    (['pi', 'cycle 12', '= 6', '/ 0 2', 'sin 3', '= 4', '/ 4 5', 'cbrt 6 -1/2', '= 1', '= 0'], False),
    (['pi', 'cycle 12', '= 7', '/ 0 2', 'cos 3', '= 1', '= 0'], False), (['pi', 'cycle 7', '= 7', '/ 0 2', 'sin 3', '= 1', '= 0'], False),
    (['pi', 'cycle 14', '= 7', '/ 0 2', 'cos 3', '= 1', '= 0'], True), (['pi', 'cycle 14', '= 7', '/ 0 2', 'sin 3', '= 1', '= 0'], False),
    (['pi', 'cycle 28', '= 7', '/ 0 2', 'tan 3', '= 1', '= 0'], True), (['pi', 'cycle 28', '= 2', '/ 0 2', 'tan 3', '= 1', '= 0'], False),
    (['pi', 'cos 0', '= 1', '= 0'], False), (['pi', '= 2', '* 0 1', 'cos 2', '= 1', '= 0'], True),
    (['pi', '= 2', '* 0 1', 'sin 2', '= 1', '= 0'], False), (['= 0', 'sin 0', '= 1', '= 0'], False),
    (['= 0', 'cycle 4', 'sin 0', '= 1', '= 0'], True), (['= 0', 'cycle 6', 'sin 0', '= 1', '= 0'], False),
    (['pi', 'cycle 12', '= 1', '+ 0 2', 'cos 3', '= 1', '= 0'], True), (['pi', 'cycle 12', '* 0 0', 'cos 2', '= 1', '= 0'], True),
    (['pi', 'cycle 12', 'cos 1', '= 1', '= 0'], True), (['e', 'pi', 'cycle 5', '= 5', '/ 0 3', 'cos 4', '= 1', '= 0'], True),
    (['= 2', 'tan 0', 'abs 1', '- 0 2', '= 0'], False),
    (['= 3', 'log 0', '= 0'], True), (['= 2', 'log 0', '= 0'], False), (['= 8', 'log 0', '= 0'], False),
    (['= 2', 'atan 0', '= 0'], True), (['= 1', 'atan 0', '= 0'], False), (['= -2', 'atan 0', '= 0'], False),
    (['= 9/10', 'asin 0', '= 0'], True), (['= 1/4', 'asin 0', '= 0'], False), (['= 1/4', 'acos 0', '= 0'], True),
    (['= 9/10', 'acos 0', '= 0'], False), (['= -1/2', 'acos 0', '= 0'], False), (['= 1', 'asin 0', '= 0'], True),
    (['= -1', 'acos 0', '= 2', '/ 1 2', '= 0'], True), (['= 1', 'acos 0', '= 1', '+ 1 2', 'exp 3', '- 4 2', '= 0'], True),
    (['= -1', 'asin 0', 'abs 1', '= 0'], True), (['= 2', 'sqrt 0', '* 1 1', '/ 2 0', 'asin 3', '= 0'], True),
    (['= 2', 'sqrt 0', '* 1 1', '/ 2 0', 'neg 3', 'acos 4', '/ 5 0', '= 0'], True),
    ([f'= {2**300 - 1}/{2**300}', 'asin 0', '= 0'], True), ([f'= {2**300 + 1}/{2**300}', 'asin 0', '= 1', '= 0'], False),
    ([f'= {1 - 2**300}/{2**300}', 'acos 0', '= 2', '/ 1 2', '= 0'], True), ([f'= -{2**300 + 1}/{2**300}', 'acos 0', '= 1', '= 0'], False),
    (['= 2', 'asin 0', '= 1', '= 0'], False), (['= -2', 'acos 0', '= 1', '= 0'], False), (['= 0', 'log 0', '= 1', '= 0'], False),
    (['= -1', 'log 0', '= 1', '= 0'], False), (['callback', 'log 0', '= 1', '= 0'], False), (['callback', 'asin 0', '= 1', '= 0'], False),
    (['callback', 'atan 0', '= 1', '= 0'], True), ([f'= {2**3000}', 'log 0', '= 2000', '/ 1 2', '= 0'], True),
    ([f'= 1/{2**1500}', 'log 0', '= -1000', '/ 1 2', '= 0'], True), ([f'= {2**3000}', 'atan 0', '= 0'], True),
    ([f'= -1/{2**1500}', 'atan 0', '= 1', '- 2 1', '= 0'], True), ([f'= 1/{2**1500}', 'atan 0', '= 1', '- 2 1', '= 0'], False),
    ([f'= 1/{2**300}', '= 3', '+ 0 1', 'log 2', 'log 1', '- 3 4', f'= {2**303}', '* 5 6', '= 0'], False),
    ([f'= 1/{2**300}', '= 3', '+ 0 1', 'log 2', 'log 1', '- 3 4', f'= {2**302}', '* 5 6', '= 0'], True),
    (['= 1', 'atan 0', 'neg 0', 'atan 2', '- 1 3', '= 0'], True), (['= 1', 'atan 0', 'neg 0', 'atan 2', '+ 1 3', 'cosh 4', '= 0'], False),
    (['= 3', 'atan 0', 'log 0', '- 1 2', '= 1', '+ 3 4', '= 0'], True), (['= 1/3', 'asin 0', 'acos 0', '+ 1 2', '= 0'], True),
    (['= 1/3', 'acos 0', 'neg 0', 'acos 2', '- 3 1', '= 1', '+ 4 5', '= 0'], True),
    (['= 3', 'log 0', 'atan 0', 'asin 0', '= 1', '= 0'], False)]
# As far as the C checker looks: powers of e up to 2^8, angles up to 2^24.
for below, beyond, lines in (
        (-255, -257, ['exp 0', '= 1', '+ 1 2']), (2**24 - 9, 2**24 + 9, ['cos 0', 'abs 1', '= 1', '+ 2 3']),
        (9 - 2**24, -9 - 2**24, ['sin 0', 'abs 1', '= 1', '+ 2 3']), (255, 257, ['exp 0', 'tanh 0', 'abs 2', '= 1/2', '+ 3 4'])):
    PLACES += [([f'= {below}', *lines, '= 0'], True), ([f'= {beyond}', *lines, '= 0'], False)]
ROOT_2 = ['= 2', 'sqrt 0']
# What 2048 bits do not show, nor 4096.
PLACES += [(ROOT_2 + [f'= {tiny(1180)}', '/ 2 2', '= 1/2', '+ 3 4', '= 0'], True),
           (ROOT_2 + [f'= {tiny(3200)}', '/ 2 2', '= 1/2', '+ 3 4', '= 0'], False),
           (ROOT_2 + [f'= {tiny(4000)}', '- 0 2', '= 0'], True), (ROOT_2 + [f'= {tiny(4000)}', '+ 0 2', '= 0'], False)]

# 3 is the sum of the roots of 2 and 3, 4 the same as a root of a polynomial of degree 4, 5 is 0.
SUM = ROOT_2 + ['= 3', 'sqrt 2', '+ 1 3', 'root 3 4 1,0,-10,0,1', '= 0']
HIDDEN = SUM + ['- 4 5']
NEAR = ('3+1 0', '2+2 0')
AT_0 = ('-1+2 0', '-1+3 0')


def squared(n):
    """4 is the root of the square of 2, which is tiny(n), 6 is the opposite of that."""
    return ROOT_2 + [f'= {tiny(n)}', '* 2 2', 'sqrt 3', '= 0', 'neg 2']


def large(n):
    """4 and 10 are the same sum of roots, of numbers of about n bits."""
    return [f'= {2 << n}', 'sqrt 0', f'= {3 << n}', 'sqrt 2', '+ 1 3', f'= {24 << 2 * n}', 'sqrt 5',
            f'= {5 << n}', '+ 6 7', 'claim 8', 'sqrt 9', '= 0']


# Of the sum of the roots of 2, 3, 5 and 7.
DEGREE_16 = '46225,0,-5596840,0,13950764,0,-7453176,0,1513334,0,-141912,0,6476,0,-136,0,1'
LARGE = ('0+1*2^700 0', '0+1*2^701 0')

# numbers, the points of sites 0 and 1, a fact, sites; is it proved?
FACTS = [
    (SUM, ('4 6', '5 6'), 'same 0 1 bound', NEAR, True), (SUM, ('4 6', '5 6'), 'same 0 1 identity', NEAR, False),
    (SUM[:5] + ['root 0 1 1,0,-10,0,1', '= 0'], ('4 6', '5 6'), 'same 0 1 bound', ('3+1 0', '0+4 0'), False),
    (SUM[:5] + ['root 3 4 1,0,-10,0,1 x1+x0', '= 0'], ('4 6', '5 6'), 'same 0 1 identity', NEAR, True),
    (HIDDEN + ['cbrt 7'], ('8 6', '6 6'), 'same 0 1 bound', AT_0, True),
    (HIDDEN + ['cbrt 7', 'cbrt 8'], ('9 6', '6 6'), 'same 0 1 bound', AT_0, True),
    (HIDDEN + ['cbrt 7', 'neg 8'], ('8 6', '9 6'), 'same 0 1 bound', AT_0, True),
    (HIDDEN + ['cbrt 7', '= 1', '+ 8 9'], ('8 6', '10 6'), 'same 0 1 bound', ('-1+2 0', '-1+3 0'), False),
    (HIDDEN + ['pi', '* 7 8'], ('9 6', '6 6'), 'same 0 1 bound', AT_0, False),
    (squared(160), ('4 5', '2 5'), 'same 0 1 bound', AT_0, True), (squared(160), ('4 5', '6 5'), 'same 0 1 bound', AT_0, False),
    (squared(760), ('4 5', '2 5'), 'same 0 1 bound', AT_0, True), (squared(760), ('4 5', '6 5'), 'same 0 1 bound', AT_0, False),
    (squared(760), ('2 5', '6 5'), 'same 0 1 bound', AT_0, False),
    # expressions that verify proves, and those it gives up on: coefficients, a root to many bits
    (ROOT_2 + ['= 3', 'sqrt 2', '= 5', 'sqrt 4', '= 7', 'sqrt 6', '+ 1 3', '+ 8 5', '+ 9 7',
               f'root 2007/250 8029/1000 {DEGREE_16}', '= 0'], ('10 12', '11 12'), 'same 0 1 bound', ('8+1 0', '7+2 0'), False),
    (large(900), ('4 11', '10 11'), 'same 0 1 bound', LARGE, True),
    (large(1200), ('4 11', '10 11'), 'same 0 1 bound', LARGE, False)]
# A point that is an exact site.
FACTS += [(HIDDEN, ('7 6',), None, ('0 0', '9 9'), True), (HIDDEN + ['cbrt 7'], ('8 6',), None, ('0 0', '9 9'), True)]
# Nearly the same, and nearly in place.
for bits in (10, 100, 200, 600, 1500, 3000, 6000):
    near = HIDDEN + [f'= 1/{1 << bits}', '+ 5 8', '+ 7 8']
    FACTS += [(near, ('4 6', '9 6'), 'same 0 1 bound', NEAR, False), (near, ('10 6',), None, ('0 0', '9 9'), False)]


# A square of these points and a fifth site; ties that are stated; how many of them are not proved.
ROOT = '3260954456333195553*2^-61+1*2^-61'  # sqrt 2
MINUS = '-1630477228166597777*2^-60+1*2^-61'
RINGS = [('9 9', ['0 2', '1 3'], 0), ('0 0', ['0 2', '1 3'], 2), ('1 0', ['0 2', '1 3'], 2), ('1 1', ['0 2', '1 3'], 2),
         ('-1 -1', ['0 2', '1 3'], 2), ('1 -1', ['0 2', '1 3'], 2), ('1*2^-1 1*2^-1', ['0 2'], 1), ('1+8 0+1', ['0 2', '1 3'], 2),
         ('-9+18 9+1', ['0 2', '1 3'], 0), ('-9+18 -9+18', ['0 2'], 1), ('3+9 3+9', ['1 3'], 0), ('9 9', ['0 1', '0 2'], 1),
         ('9 9', ['0 1', '0 3', '1 2', '2 3'], 4), ('9 9', ['0 4'], 1), ('2 0', ['0 2'], 0), ('0 -2', ['1 3'], 0), ('-2 0', ['1 3'], 0),
         ('0 2', ['0 2'], 0)]


# Sites 0, 1, 2 are at (-sqrt 2, 0), (0, 0), (sqrt 2, 0), site 3 is above.
ROW = ([f'{MINUS} 0', '0 0', f'{ROOT} 0', '0 8'], ['0 2 3', '1 3 3', '2 1 3'])
ROWS = [('9 9', ['0 2'], 0), ('9 9', ['0 1', '1 2'], 2), ('9 9', ['0 1', '0 2'], 1), ('9 0', ['0 2'], 1), ('1 -1', ['0 2'], 1),
        ('-9+18 1*2^-9+1', ['0 2'], 0), ('-9+18 -1*2^-9+1', ['0 2'], 1), ('9 9', ['0 3'], 1), ('9 9', ['2 4'], 1),
        ('9 -9', ['0 2'], 1), ('1*2^-1 0', ['0 2'], 1)]
SQUARE_SITES = ([f'{ROOT} 0', f'0 {ROOT}', f'{MINUS} 0', f'0 {MINUS}'], ['0 1 3', '1 3 1', '2 2 3', '3 3 2'])

# Site 3 is somewhere; an alias of it is described to be elsewhere on the circle.
ALIASED = ([f'{ROOT} 0', '9 9', f'{MINUS} 0', '-9+18 -9+18'], ['0 1 3', '2 2 3', '3 3 1', '4 3 2'])


def ring(fifth, pairs, facts=('circle 0 1 2 3 identity',), numbers=('= 2', 'sqrt 0', 'neg 1', '= 0'), at=SQUARE_SITES):
    sites, points = at
    lines = ['dyadel certificate 1', 'outcome budget', 'goal decided', 'capped no', 'sites 5', *sites, fifth, 'legal 0', 'places 0',
             'bridges 0', 'corners 0', 'pairs', *(f't {pair}' for pair in pairs), 'triangles 0', 'unproved 9', 'area none',
             'hausdorff none', f'algebra {len(numbers)}', *numbers, f'points {len(points)}', *points, f'facts {len(facts)}',
             *facts, 'end', '']
    return '\n'.join(lines)


def try_rings(both):
    """Ties by a circle that a block shows: only when no other site is inside or on it, and the pair crosses another."""
    for fifth, pairs, left in RINGS:
        answer = both.ask(both.proved, text=ring(fifth, pairs))
        loose = re.search(r'not proved: that (\d+) pairs are ties', answer.stdout)
        if answer.returncode != NOT_ALL or int((loose or (0, 0))[1]) != left:
            yield f'a ring with {fifth}, {pairs}: {answer}'
    for fifth, pairs, left in ROWS:
        answer = both.ask(both.proved, text=ring(fifth, pairs, ['line 0 2 1 identity'], ('= 2', 'sqrt 0', 'neg 1', '= 0'), ROW))
        loose = re.search(r'not proved: that (\d+) pairs are ties', answer.stdout)
        if answer.returncode != NOT_ALL or int((loose or (0, 0))[1]) != left:
            yield f'a row with {fifth}, {pairs}: {answer}'
    for facts in ((), ('circle 0 1 2 3 bound',), ('same 0 2 identity',), ('line 0 2 1 identity',), ('circle 0 1 2 4 identity',)):
        answer = both.ask(both.proved, text=ring('9 9', ['0 2', '1 3'], facts))
        refused = facts and 'bound' not in facts[0]
        proved = facts and 'bound' in facts[0]
        if (answer.returncode == REJECTED) != bool(refused) or ('that 2 pairs are ties' in answer.stdout) == bool(refused or proved):
            yield f'a ring with {facts}: {answer}'
    answer = both.ask(both.proved, text=ring('= 3', ['0 2'], ['circle 0 2 3 4 identity'], at=ALIASED))
    if answer.returncode != NOT_ALL or 'that 1 pairs are ties' not in answer.stdout:
        yield f'a ring with an alias: {answer}'
    for points in TIED:
        answer = both.ask(both.proved, text=both.certificate(points))
        if 'checked: the outcome fixpoint' not in answer.stdout or 'pairs are ties' in answer.stdout:
            yield f'ties of {points}: {answer}'


def try_places(both):
    for numbers, inside in PLACES:
        text = block_of(numbers, [f'0 {len(numbers) - 2} {len(numbers) - 1}'])
        answer = both.ask(both.proved, text=text)
        if (answer.returncode != REJECTED and 'checked: 1 points lie where' in answer.stdout) != inside:
            yield f'{numbers}: {answer.stdout}{answer.stderr}'
        yield from both.faults(text, 'a place')


def try_facts(both):
    """Facts by bound, by both or by none."""
    for numbers, points, fact, sites, holds in FACTS:
        facts = [fact] if fact else []
        text = block_of(numbers, [f'{k} {point}' for k, point in enumerate(points)], facts, sites)
        answer, other = both.ask(both.proved, text=text), both.ask(both.dyadel, 'verify', text=text)
        said = f'checked: {len(points)} points lie where they are described to be, and {len(facts)} facts on them hold\n'
        if (answer.returncode != REJECTED and said in answer.stdout) != holds or (other.returncode != REJECTED) != holds:
            yield f'{numbers}, {points}, {fact}: {answer} {other}'


def gon(n):
    return ''.join(f'cos(2*pi*{k}/{n}) sin(2*pi*{k}/{n})\n' for k in range(n))


def forged_gons(text):
    """The block of a polygon with a false cycle, index, cosine, sine, sign, place."""
    lines = text.split('\n')
    first = next(k for k, line in enumerate(lines) if line.startswith('algebra ')) + 1
    for k in range(first, lines.index('end')):
        words = lines[k].split(' ')
        order = int(words[-1]) if words[-1].isdigit() else 0
        others = {'cycle': [f'cycle {z}' for z in (order - 1, order + 1, 0, -order)], 'sin': [f'cos {order}'],
                  'cos': [f'sin {order}'], '*': [f'- {" ".join(words[1:])}']}.get(words[0], [])
        if words[0] == '=' and k > first + 4 and order > 1:
            others = [f'= {order + 1}', f'= {order - 1}', f'= -{order}']
        if len(words) == 3 and words[0].isdigit():
            others = [f'{words[0]} {words[2]} {words[1]}']
        yield from ('\n'.join(lines[:k] + [other] + lines[k + 1:]) for other in others)


def try_gons(both):
    forged = alike = 0
    for n in range(3, 25):
        text = both.certificate(gon(n))
        answer = both.ask(both.proved, text=text)
        facts = 1 if n > 3 else 0
        if '\ncycle ' in text and f'checked: {n} points lie where they are described to be, and {facts} facts on' not in answer.stdout:
            yield f'{n} corners: {answer}'
        if answer.returncode != ALL:
            yield f'{n} corners: {answer}'
        for false in forged_gons(text) if '\ncycle ' in text else ():
            forged += 1
            answers = [both.ask(both.proved, text=false), both.ask(both.dyadel, 'verify', text=false)]
            alike += [answer.returncode for answer in answers] == [ALL, ALL]  # cos(pi/4) is sin(pi/4)
            if answers[0].returncode != answers[1].returncode:
                yield f'forged from {n} corners: {answers}\n{false}'
    print(f'{forged} forged polygons, {alike} of them true')
    if forged < 1500 or alike * 50 > forged:
        yield 'few polygons were forged, or many of them are true'


def lattice(n):
    return ''.join(f'{x}*sqrt(2) {y}*sqrt(2)\n' for x in range(n) for y in range(n))


def row(n):
    return ''.join(f'{k}*sqrt(2) {k}*sqrt(3)\n' for k in range(n))


def try_growth(both):
    """Circles, each with its sites, in many sites; pairs on one line, and on one circle, whose number is what grows."""
    for name, make, few, many, size in (('lattice', lattice, 12, 36, 9), ('row', row, 60, 240, 16), ('polygon', gon, 40, 120, 9)):
        ratio = both.seconds(make(many)) / both.seconds(make(few))
        print(f'{name}: {size} times as much, {ratio:.1f} times as long')
        if ratio > 3 * size:
            yield f'the time of a {name} grows with a higher power'


def try_known(both):
    for points, count, facts in KNOWN + BOUND:
        text = both.certificate(points)
        answer = both.ask(both.proved, text=text)
        if f'checked: {count} points lie where they are described to be, and {facts} facts on them hold\n' not in answer.stdout:
            yield f'{points}: {answer}'
        if (' bound\n' in text) != ((points, count, facts) in BOUND):
            yield f'{points}: {answer}\n{text}'
        yield from both.faults(text, points)


def try_forged(both, count):
    rng = random.Random(SEED)
    sums = []
    for _ in range(count):
        a, b = expression(rng, rng.randrange(3)), expression(rng, rng.randrange(3))
        sums.append(ALIAS.format(f'({a})+({b})', f'({b})+({a})'))
    sides = 0
    for points in [points for points, _, _ in KNOWN + BOUND] + sums:
        text = both.certificate(points)
        if '\nalgebra ' not in text:
            continue
        yield from both.faults(text, points)
        for forged in forged_blocks(rng, text, 20):
            yield from both.faults(forged, f'forged from {points}')
        for moved in moved_sides(text):
            sides += 1
            yield from both.faults(moved, f'a side moved of {points}')
    print(f'seed {SEED}: {both.tried} certificates with blocks, {sides} of moved sides: {both.rejected} refused, '
          f'{both.all} proved')
    if both.rejected * 3 < both.tried or both.all * 40 < both.tried or sides < 40:
        yield 'hardly anything is refused, or proved, or hardly any side was moved'


def main():
    with tempfile.TemporaryDirectory() as folder:
        proved, dyadel = (pathlib.Path(arg).resolve() for arg in sys.argv[1:3])
        both = OfBlocks(proved, dyadel, pathlib.Path(folder))
        found = list(try_places(both)) + list(try_known(both)) + list(try_rings(both)) + list(try_facts(both))
        found += list(try_gons(both)) + list(try_growth(both))
        found += try_forged(both, int(sys.argv[3]) if len(sys.argv) > 3 else 16)
    print('\n'.join(found) or 'no fault')
    return 1 if found else 0


if __name__ == '__main__':
    sys.exit(main())
