#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Every refusal of the checker, by a certificate that is wrong in exactly that point [CERT-1] [CERT-2] [CERT-3] [CERT-4]
[CERT-5] [CERT-6] [CERT-7] [CERT-9] [CERT-10] [CERT-14].

Usage: test_refusals.py DYADEL ROOT

Each case replaces one text of a certificate that is accepted; it is rejected at the first line that differs, unless another
is named, for the reason given. Every reason in src/checker must occur.
"""
import concurrent.futures
import pathlib
import re
import subprocess
import sys
import tempfile

DYADEL, ROOT = sys.argv[1], pathlib.Path(sys.argv[2])
HEAD = 'dyadel certificate 1\noutcome fixpoint\ngoal decided\ncapped no\n'
# A square, with its diagram.
SQUARE = HEAD + '''sites 4
0 0
1*2^2 0
1*2^2 1*2^2
0 1*2^2
legal 4
0 1 1*2^1 0
0 3 0 1*2^1
1 2 1*2^2 1*2^1
2 3 1*2^1 1*2^2
places 0
bridges 0
corners 4
0 -1*2^2 -1*2^2
1 1*2^2 -1*2^2
2 1*2^2 1*2^2
3 -1*2^2 1*2^2
pairs
t 0 2
t 1 3
triangles 0
unproved 0
area 0
hausdorff 13043817825332782213*2^-62
window -1 5 -1 5
polygons
0 -1 -1 1 -1 1 1 -1 1
2 3 3 5 3 5 5 3 5
undetermined 7*2^2
distance 1*2^-50 unproved
end
'''
# Two triangles: every pair is decided.
DECIDED = HEAD.replace('fixpoint', 'decided') + '''sites 4
0 0
1*2^2 0
0 1*2^2
5 5
legal 5
0 1 1*2^1 0
0 2 0 1*2^1
1 2 9*2^-2 9*2^-2
1 3 1*2^3 1*2^1
2 3 1*2^1 1*2^3
places 0
bridges 0
corners 4
0 -1*2^2 -1*2^2
1 5 -5
2 -5 5
3 3*2^1 3*2^1
pairs
triangles 2
unproved 0
area none
hausdorff none
end
'''
# The same without the edge between them, a chain in its place.
CHAINED = DECIDED.replace('outcome decided', 'outcome fixpoint').replace('legal 5', 'legal 4').replace(
    '1 2 9*2^-2 9*2^-2\n', '').replace('pairs\n', 'pairs\nn 0 3 1 -1 1 17*2^-3 17*2^-3 2 -1 1\nl 1 2\n').replace(
    'triangles 2', 'triangles 0')
# Rectangles, places, a bridge between two of them; an exact point that is not dyadic, and its alias.
BRIDGED = HEAD + '''sites 4
0+1*2^2 0
1*2^1+1*2^2 1
1/3 1*2^5
= 2
legal 0
places 2
0 1 0
1 1*2^1 1
bridges 2
0 1 3*2^-1 1*2^-1
1 2 1*2^6 5*2^2
corners 0
pairs
o 0 1
o 0 2
o 1 2
triangles 0
unproved 0
area none
hausdorff none
end
'''
CAPPED = HEAD.replace('fixpoint', 'budget').replace('no', 'yes') + '''sites 3
0 0
1 0
1*2^1 0
legal 2
0 1 1*2^-1 0
1 2 3*2^-1 0
places 0
bridges 0
corners 2
0 -1*2^3 0
2 1*2^3 0
pairs
triangles 0
unproved 2
area none
hausdorff none
end
'''
# A square whose corners are described by expressions.
DESCRIBED = HEAD + '''sites 4
45*2^-5+1*2^-5 0
0 45*2^-5+1*2^-5
-23*2^-4+1*2^-5 0
0 -23*2^-4+1*2^-5
legal 4
0 1 5*2^1 5*2^1
0 3 5*2^1 -5*2^1
1 2 -5*2^1 5*2^1
2 3 -5*2^1 -5*2^1
places 0
bridges 0
corners 4
0 1 0
1 0 1
2 -1 0
3 0 -1
pairs
t 0 2
t 1 3
triangles 0
unproved 0
area none
hausdorff none
algebra 6
= 0
= 2
sqrt 1
neg 2
root 1 2 -2,0,1 x0
^ 2 2
points 4
0 2 0
1 0 4
2 3 0
3 0 3
facts 1
circle 0 1 2 3 identity
end
'''
# Accepted, with what exit status: bounds as a goal, a cap that nothing meets, one bound with pairs that are not proved.
GOOD = ((SQUARE, 3), (DECIDED, 0), (CHAINED, 3), (BRIDGED, 3), (CAPPED, 3), (DESCRIBED, 0),
        (SQUARE.replace('goal decided', 'goal area 1'), 3), (BRIDGED.replace('goal decided', 'goal area 1'), 3),
        (DECIDED.replace('outcome decided', 'outcome budget').replace('capped no', 'capped yes'), 3),
        (CHAINED.replace('n 0 3 1 -1 1 17*2^-3 17*2^-3 2 -1 1\n', '').replace('unproved 0', 'unproved 1').replace(
            'hausdorff none', 'hausdorff 1*2^3'), 3))

SHORT, LONG, BLANKS = 'the line is too short', 'the line goes on with "y"', 'two blanks, or a blank at the end or the beginning'
NUMBER, COUNT, INTEGER = 'is not a number m or m*2^e', 'is not a number of a site or of lines', 'is no integer'
LARGE, WORD = 'is too large', 'is no word that may stand here'
NO_DENOMINATOR, NOT_LOWEST, NO_WIDTH = '" is no denominator', 'is no denominator in lowest terms', 'is not a width'


# Five places on a sphere, the last one the first again.
SPHERE = '''dyadel certificate 1
outcome decided
goal decided
capped no
sites 3
-6706799550877399*2^-53+141*2^-53 3138186047629653*2^-54+249*2^-54
-1385510300907327*2^-52+9*2^-50 -232478893885975*2^-51+943*2^-56
-6902851726705479*2^-55+1*2^-48 715400431414223*2^-51+153*2^-54
legal 3
0 1 -3*2^-2 -1*2^-2
0 2 -1*2^-1 3*2^-2
1 2 0 0
places 0
bridges 0
corners 3
0 -11 3
1 5 -11
2 3*2^1 1*2^3
pairs
triangles 1
unproved 0
area 3308525148028615321*2^-107
hausdorff 13553964483723401363*2^-109
sphere
eye 2
radius none
places 5
5*2^1 5*2^2
-5*2^3 15*2^1
25*2^2 -25*2^1
0 35*2^1
185*2^1 5*2^2 = 0
neighbours 3
l 0
l 1
l 2
outcome decided
end
'''


def missing(word):
    return f'"{word}" is missing'


def of_lines():
    """Lines that are malformed for their kind: the line, its replacement, the reason."""
    for line, name, behind in (('outcome fixpoint', 'outcome', WORD), ('goal decided', 'goal', WORD),
                               ('capped no', 'capped', WORD),
                               ('sites 4', 'sites', COUNT), ('legal 4', 'legal', COUNT), ('places 0', 'places', COUNT),
                               ('bridges 0', 'bridges', COUNT), ('corners 4', 'corners', COUNT),
                               ('triangles 0', 'triangles', INTEGER),
                               ('unproved 0', 'unproved', INTEGER), ('area 0', 'area', NUMBER),
                               ('undetermined 7*2^2', 'undetermined', NUMBER),
                               ('hausdorff 13043817825332782213*2^-62', 'hausdorff', NUMBER)):
        yield from ((line, f'{name}', SHORT), (line, f'{name}z 0', missing(name)), (line, f'{name} y', behind),
                    (line, f'{line} y', LONG), (line, f'{line} ', 'the line goes on with ""'), (line, f' {line}', BLANKS))
    for line, name in (('pairs', 'pairs'), ('polygons', 'polygons'), ('end', 'end')):
        yield from ((line, f'{name}z', missing(name)), (line, f'{name} y', LONG), (line, '', BLANKS))
    for goal, why in (('area', SHORT), ('area y', INTEGER), ('area 1234567890123456789', INTEGER), ('area 01', INTEGER),
                      ('area 1 y', LONG),
                      ('hausdorff --1', INTEGER), ('voronoi', SHORT), ('voronoi y', WORD), ('voronoi area', SHORT)):
        yield 'goal decided', f'goal {goal}', why
    for window, why in (('window -1 5 -1', SHORT), ('window y 5 -1 5', NUMBER), ('window -1 5 -1 5 y', LONG),
                        ('windowy -1 5 -1 5', missing('window')),
                        ('window 5 -1 -1 5', 'the window has no area'), ('window -1 5 5 5', 'the window has no area')):
        yield 'window -1 5 -1 5', window, why
    for name, why in (('distance', SHORT), ('distance y', NUMBER), ('distance none y', NUMBER),
                      ('distance 1*2^-50 y', missing('unproved')),
                      ('distancey none', missing('distance')), ('distance 1*2^-50 unproved y', LONG),
                      ('distance -1', 'boxes do not prove the bound of the distance')):
        yield 'distance 1*2^-50 unproved', name, why


def of_sites():
    for site, why in (('0', SHORT), ('0 0 y', LONG), ('y 0', NUMBER), ('0 y', NUMBER), ('1*2^0 0', NUMBER),
                      ('2*2^3 0', NUMBER),
                      ('01 0', NUMBER), ('-0 0', NUMBER), ('1*3^2 0', NUMBER), ('1*2^y 0', NUMBER), ('1*2^2y 0', NUMBER),
                      ('1*2^1048577 0', NUMBER), ('1*2^-1048577 0', NUMBER), ('3*2^1048575 0', NUMBER), ('1+ 0', NO_WIDTH),
                      ('1+0 0', NO_WIDTH), ('1+-1 0', NO_WIDTH), ('1+y 0', NO_WIDTH), ('1+1/3 0', NO_WIDTH),
                      ('1/y 0', NO_DENOMINATOR),
                      ('1/3y 0', NO_DENOMINATOR), ('1/ 0', NO_DENOMINATOR), ('1/1 0', NOT_LOWEST), ('1/-3 0', NOT_LOWEST),
                      ('1/2 0', NOT_LOWEST), ('3/9 0', NOT_LOWEST), ('1/0 0', NOT_LOWEST), ('= 0', 'there is no site'),
                      ('=0', missing('='))):
        yield 'sites 4\n0 0\n', f'sites 4\n{site}\n', why
    for site, why in (('=', SHORT), ('= 1', LARGE), ('= y', COUNT), ('= -1', COUNT), ('= 0 y', LONG),
                      ('= 1234567890123456789', COUNT)):
        yield '\n0 0\n1*2^2 0\n', f'\n0 0\n{site}\n', why


def of_lists():
    for line, why in (('0', SHORT), ('0 1', SHORT), ('0 1 1*2^1', SHORT), ('y 1 0 0', COUNT), ('0 y 0 0', COUNT),
                      ('0 1 y 0', NUMBER),
                      ('0 1 0 y', NUMBER), ('0 1 1*2^1 0 y', LONG), ('0 4 0 0', LARGE),
                      ('0 0 0 0', 'the second site must have the larger'),
                      ('1 0 0 0', 'the second site must have the larger'),
                      ('0 1 1*2^1 1*2^1', 'the point is no witness of 0 1: site'),
                      ('0 1 0 0', 'the point is no witness of 0 1: site'),
                      ('0 2 1*2^1 1*2^1', 'the point is no witness of 0 2: site')):
        yield SQUARE, '\n0 1 1*2^1 0\n', f'\n{line}\n', why
    for line in ('0 1 0 1*2^1', '0 2 0 1*2^1'):
        yield SQUARE, '\n0 3 0 1*2^1\n1 2 1*2^2 1*2^1\n', f'\n1 2 1*2^2 1*2^1\n{line}\n', 'pairs are not in order', 1
    yield SQUARE, '\n0 3 0 1*2^1\n', '\n0 1 1*2^1 0\n', 'pairs are not in order'
    yield SQUARE, 'places 0', 'places 5', LARGE
    yield SQUARE, 'corners 4', 'corners 5', LARGE
    yield SQUARE, 'sites 4', 'sites 268435457', LARGE
    yield BRIDGED, 'legal 0\n', 'legal 1\n2 3 0 0\n', 'site 3 is an alias', 1
    yield BRIDGED, '\n= 2\n', '\n= 3\n', LARGE
    yield (BRIDGED, 'sites 4\n0+1*2^2 0\n1*2^1+1*2^2 1\n1/3 1*2^5\n', 'sites 4\n0+1*2^2 0\n1*2^1+1*2^2 1\n= 0\n',
           'site 2 is an alias', 1)
    for line, why in (('0 5 0', 'not in the rectangle of site 0'), ('0 -1 0', 'not in the rectangle of site 0'),
                      ('0 1', SHORT),
                      ('0 1 1', 'not in the rectangle of site 0'), ('y 1 0', COUNT), ('0 1 0 y', LONG),
                      ('3 1 0', 'site 3 is an alias'),
                      ('2 1 0', 'not in the rectangle of site 2')):
        yield BRIDGED, '\n0 1 0\n', f'\n{line}\n', why
    yield BRIDGED, '\n1 1*2^1 1\n', '\n0 1 0\n', 'places are not in order'
    yield BRIDGED, '0 1 3*2^-1 1*2^-1', '0 1 1*2^4 1*2^10', 'the point is no witness of 0 1: site 2'
    yield BRIDGED, 'bridges 2\n', 'bridges 3\n', COUNT, 3
    yield SQUARE, 'bridges 0\n', 'bridges 1\n0 1 1*2^1 0\n', 'a bridge joins sites that are connected without it', 6
    for line, why in (('y 0 0', COUNT), ('0 0', SHORT), ('0 0 0 y', LONG)):
        yield SQUARE, '\n0 -1*2^2 -1*2^2\n', f'\n{line}\n', why
    yield SQUARE, '\n1 1*2^2 -1*2^2\n', '\n0 1*2^2 -1*2^2\n', 'corners are not in order'
    yield SQUARE, '\n0 -1*2^2 -1*2^2\n', '\n0 1 1\n', 'site 0 is not proved to be a corner', 3
    yield (BRIDGED, 'bridges 2\n0 1 3*2^-1 1*2^-1\n1 2 1*2^6 5*2^2\ncorners 0\n', 'bridges 0\ncorners 1\n0 1 0\n',
           'site 0 is not proved to be a corner', 2)


def of_pairs():
    for line, why in (('y 0 2', WORD), ('t', SHORT), ('t 0', SHORT), ('t 0 y', COUNT), ('t 2 0', 'the second site must'),
                      ('t 0 2 y', LONG),
                      ('t 0 1', 'the pair is legal already'), ('n 0 2', SHORT), ('n 0 2 1', SHORT), ('n 0 2 1 -1', SHORT),
                      ('n 0 2 1 -1 1', SHORT),
                      ('n 0 2 1 -1 y 0 0', COUNT), ('n 0 2 1 -1 1 y 0', NUMBER),
                      ('n 0 2 1 -1 1 1 -1', 'the chain does not prove that 0 2 is illegal')):
        yield SQUARE, '\nt 0 2\n', f'\n{line}\n', why
    yield SQUARE, '\nt 0 2\nt 1 3\n', '\nt 1 3\nt 0 2\n', 'pairs are not in order', 1
    yield SQUARE, '\nt 1 3\n', '\nt 0 2\n', 'pairs are not in order'
    yield DECIDED, '\npairs\n', '\npairs\no 0 3\n', 'the pair is in no open set, so it is illegal'
    yield DECIDED, '\npairs\n', '\npairs\nn 0 3 1 -1 1 17*2^-3 17*2^-3 2 -1 1\n', 'the chain is for a pair of no open set'
    # the first point, the second one, either direction, the side on which the chain passes
    for chain in ('1 -1 1 0 0 2 -1 1', '-1 1 1 17*2^-3 17*2^-3 2 -1 1', '1 -1 1 17*2^-3 17*2^-3 2 1 -1',
                  '1 -1 1 5 -1 1 1 -1',
                  '1 -1 1 17*2^-3 17*2^-3 1 1 -1', '1 -1 1 17*2^-3 17*2^-3 2 -1 0'):
        yield CHAINED, '1 -1 1 17*2^-3 17*2^-3 2 -1 1', chain, 'the chain does not prove that 0 3 is illegal'
    for line, why in (('boxes', SHORT), ('boxes y', INTEGER), ('boxes 0 y', LONG), ('boxesy 0', missing('boxes')),
                      ('boxes 1', 'boxes prove 0 pairs'),
                      ('boxes -1', 'boxes prove 0 pairs')):
        yield SQUARE, '\ntriangles 0\n', f'\n{line}\ntriangles 0\n', why
    yield CAPPED, '\ntriangles 0\n', '\nboxes 0\ntriangles 0\n', 'a capped result states nothing that boxes prove'
    yield SQUARE, 'triangles 0', 'triangles 1', 'there are 0 sure triangles'
    yield DECIDED, 'triangles 2', 'triangles -2', 'there are 2 sure triangles'
    yield SQUARE, 'unproved 0', 'unproved 1', 'of the pairs that are not listed, 0 are not proved'
    yield CAPPED, 'area none', 'area 0', 'a capped result has no bounds', 1
    yield CAPPED, 'hausdorff none', 'hausdorff 0', 'a capped result has no bounds'
    yield SQUARE, 'area 0', 'area -1', 'the hulls of the pairs have a greater area', 1
    yield (SQUARE, 'hausdorff 13043817825332782213*2^-62', 'hausdorff 13043817825332782211*2^-62',
           "a pair's term is greater than the Hausdorff")
    yield DECIDED, 'hausdorff none', 'hausdorff -1', "a pair's term is greater than the Hausdorff"


def of_ends():
    end = SQUARE.count('\n')
    yield SQUARE, 'outcome fixpoint', 'outcome decided', 'the outcome is not decided: pairs are open', end - 2
    yield CAPPED, 'outcome budget', 'outcome decided', 'the outcome is not decided: pairs are open', CAPPED.count('\n') - 2
    yield SQUARE, 'outcome fixpoint', 'outcome certified', 'the outcome is not certified: no bound reaches the goal', end - 2
    yield (SQUARE, 'fixpoint\ngoal decided', 'certified\ngoal voronoi area -2', 'the outcome is not certified: no bound',
           end - 2)
    yield SQUARE, 'dyadel certificate 1', 'dyadel certificate 2', 'this is no "dyadel certificate 1"'
    yield SQUARE, '\nend\n', '\nend\ny', 'something follows the line "end"'
    yield SQUARE, '\nend\n', '\nend', 'the line does not end'
    yield SQUARE, '\nend\n', '\n', 'the certificate ends before the line "end"'
    yield SQUARE, 'outcome fixpoint', 'outcome\0fixpoint', 'a zero byte'
    for line, why in (('0', SHORT), ('y 0 0', COUNT), ('0 0', SHORT), ('0 -1 -1 1 -1', 'the polygon is not strictly convex'),
                      ('0 -1 -1 1 -1 0 -1', 'the polygon is not strictly convex'),
                      ('0 -1 -1 1 1 1 -1', 'the polygon is not strictly convex'),
                      ('0 -1 -1 1 -1 1 1 -1 1 -1 -1 1 -1 1 1 -1 1', 'the polygon is not strictly convex'),
                      ('0 -1 -1 1 -1 1 y', NUMBER),
                      ('0 -3*2^-1 -1 1 -1 1 1', 'vertex 0 lies outside of the window'),
                      ('0 -1 -1 1 -3*2^-1 1 1', 'vertex 1 lies outside of the window'),
                      ('0 -1 -1 1*2^1 -1 1 1', 'vertex 1 may be as near to site 1 as to 0'), ('4 -1 -1 1 -1 1 1', LARGE),
                      ('2 -1 -1 1 -1 1 1', 'vertex 0 may be as near to site')):
        yield SQUARE, '\n0 -1 -1 1 -1 1 1 -1 1\n', f'\n{line}\n', why
    yield SQUARE, '\n2 3 3 5 3 5 5 3 5\n', '\n0 -1 -1 1 -1 1 1\n', 'polygons are not in order'
    yield SQUARE, 'undetermined 7*2^2', 'undetermined 27', 'the polygons leave a greater area'


NO_QUOTIENT, NOT_DEFINED = 'is no quotient of polynomials in leaves before', 'not seen to be defined'
NOT_SO = 'not seen to be what the line says'


def of_descriptions():
    for line, name in (('algebra 6', 'algebra'), ('points 4', 'points'), ('facts 1', 'facts')):
        yield from ((line, name, SHORT), (line, f'{name} y', COUNT), (line, f'{line} y', LONG),
                    (line, f'{name}y 4', missing(name)),
                    (line, f'{name} 4194305', LARGE), (line, '', BLANKS))
    for line, why in (('neg 0', 'there is no number before'), ('y', 'is no operation'), ('= y', NO_QUOTIENT),
                      ('= 0 y', LONG), ('=', SHORT), ('', BLANKS)):
        yield 'algebra 6\n= 0\n', f'algebra 6\n{line}\n', why
    for line, why in (('sqrt', SHORT), ('sqrt 2', LARGE), ('sqrt 1 5', NOT_SO), ('sqrt 1 x0', NO_QUOTIENT),
                      ('log 1 1', 'the line goes on with "1"'), ('cycle', SHORT),
                      ('sqrt 1 1/0', 'a denominator is not seen not to be 0'), ('/ 1 0', NOT_DEFINED), ('^ 1 4097', LARGE)):
        yield '\nsqrt 1\n', f'\n{line}\n', why
    for line, why in (('root 1 2', SHORT), ('root 1', SHORT), ('root', SHORT), ('root 1 2 2', 'is no end of a bracket'),
                      ('root 1 2 -2,0,1 x1', NO_QUOTIENT),
                      ('root 1 2 -2,0,1 -x0', NOT_SO), ('root 2 3 -2,0,1 x0', 'is not seen to hold one root')):
        yield '\nroot 1 2 -2,0,1 x0\n', f'\n{line}\n', why
    for line, why in (('0', SHORT), ('0 2', SHORT), ('0 2 0 y', LONG), ('0 6 0', LARGE), ('0 2 6', LARGE),
                      ('4 2 0', LARGE), ('y 2 0', COUNT)):
        yield '\n0 2 0\n', f'\n{line}\n', why
    yield 'points 4\n0 2 0\n', 'points 4\n1 2 0\n', 'points are not in order', 1
    yield '\n2 3 0\n', '\n2 2 0\n', 'not seen to lie in the rectangle of site 2', 1
    yield '\n2 3 0\n', '\n2 3 3\n', 'not seen to lie in the rectangle of site 2', 1
    yield '\n1 0 4\n', '\n1 0 5\n', 'not seen to lie in the rectangle of site 1', 2
    yield '6\n= 0\n= 2\nsqrt 1\nneg 2\nroot 1 2 -2,0,1 x0\n^ 2 2\npoints', '0\npoints', 'there are no numbers', 1
    for line, why in (('', BLANKS), ('circle', SHORT), ('sphere 0 1 2 3 identity', 'is no fact'),
                      ('circle 0 1 2 y identity', COUNT),
                      ('circle 0 1 2 4 identity', 'site 4 is not described'),
                      ('circle 0 1 2 3 faith', '"faith" is no method'),
                      ('circle 0 1 2 identity', 'the fact has a wrong number of points'),
                      ('line 0 1 identity', 'the fact has a wrong number of points'),
                      ('same 0 1 2 identity', 'the fact has a wrong number of points'),
                      ('same 0 identity', 'the fact has a wrong number of points'),
                      ('line 0 1 2 identity', 'the fact is not seen to hold'),
                      ('line 0 1 2 bound', 'the fact is not seen to hold'),
                      ('line 0 0 1 identity', 'the fact is not seen to hold'),
                      ('same 0 1 identity', 'the fact is not seen to hold'),
                      ('same 0 2 identity', 'the fact is not seen to hold'),
                      ('same 0 1 bound', 'the fact is not seen to hold'),
                      ('circle 0 1 1 3 identity', 'the fact is not seen to hold'),
                      ('circle 0 1 2 2 identity', 'a point occurs twice'),
                      ('same 0 0 identity', 'a point occurs twice'), ('circle 0 1 2 3', '"3" is no method')):
        yield '\ncircle 0 1 2 3 identity\n', f'\n{line}\n', why


def of_words():
    """In a certificate with everything: each word that is none, each line with a word too many, each without its last."""
    for good in (DESCRIBED, BRIDGED):
        lines = good.split('\n')[:-1]
        for k, line in enumerate(lines):
            words = line.split(' ')
            for by in {' '.join(words[:-1]), f'{line} ?', *(' '.join([*words[:q], '?',
                                                                      *words[q + 1:]]) for q in range(len(words)))}:
                if not (line.startswith('root') and by == line.rpartition(' ')[0]):
                    yield '\n'.join([*lines[:k], by, *lines[k + 1:], '']), k + 1


def first_difference(a, b):
    return next((k for k, (x, y) in enumerate(zip(a.split('\n'), b.split('\n')), 1) if x != y), b.count('\n') + 1)


def of_sphere():
    """Sections on a sphere [CERT-14]; line numbers in messages count from the first line that differs."""
    sphere = [(SPHERE, *c) for c in (
        ('eye 2\n', 'eye 7\n', 'there is no place 7 that is the eye', 7), ('eye 2\n', 'eye 4\n', 'there is no place 4', 7),
        ('eye 2\n', 'eye gap 0 91\n', 'the eye is no place'), ('eye 2\n', 'eye gap 0+1 0\n', 'the eye is no place'),
        ('eye 2\n', 'eye gap 0 0\n', 'there are 3 sites, and 4 places that have an image', 7),
        ('radius none', 'radius metres 0', 'this is no radius'), ('radius none', 'radius degrees 1+1', 'this is no radius'),
        ('radius none', 'radius feet 1', WORD),
        ('25*2^2 -25*2^1', '25*2^2 -91', 'the eye is no place with a radius on the sphere', 2),
        ('\n5*2^1 5*2^2\n', '\n5*2^1 5*2^2 0\n', 'this is no radius'),
        ('0 35*2^1\n', '0 91\n', 'place 3 is no place with a radius', 1),
        ('0 35*2^1\n', '1 35*2^1\n', 'the rectangle of site 2 does not hold the image of place 3', 1),
        ('5*2^2 = 0', '5*2^2 = 4', 'place 4 is an alias'), ('5*2^2 = 0', '5*2^2 = 1', 'it is not seen to be the same place as 1'),
        ('l 0\nl 1\n', 'l 1\nl 0\n', 'neighbours are not in order', 1),
        ('l 0\n', 't 0\n', 'the pair is legal, and no tie'), ('l 0\n', 'l 0 1 0\n', 'image 0 is not seen to be a corner'),
        ('neighbours 3\nl 0\n', 'neighbours 2\n', 'site 0 is a corner of the hull, and no neighbour', 2),
        )]
    yield from sphere
    gap = 'sphere\neye gap 0 0\nradius none\nplaces 0\nneighbours 0\noutcome decided\nend\n'
    none = HEAD.replace('fixpoint', 'decided') + 'sites 0\nlegal 0\nplaces 0\nbridges 0\ncorners 0\npairs\ntriangles 0\nunproved 0\n' \
        'area none\nhausdorff none\n'
    yield SPHERE, 'l 2\noutcome decided\n', 'l 2\nalso\n' + none + 'end\n', 'the second certificate is not about a sphere', 15
    yield none + gap, 'neighbours 0\n', 'neighbours 0\nalso\n', 'a second eye is for places that are seen from one of them'
    one = (none + gap).replace('sites 0\n', 'sites 1\n0 0\n').replace('gap 0 0', 'gap 45*2^2 0').replace(
        'places 0\nneighbours 0', 'places 1\n0 0\nneighbours 1\no 0')
    yield one, 'o 0\n', 'l 0\n', 'the eye is no place, and has no pairs'
    yield none + gap, '\nsphere\n', '\nwindow 0 1 0 1\npolygons\nundetermined 1\ndistance none\nsphere\n', 'are about a plane', 4


def cases():
    """The text, the line, why."""
    for good, old, new, why, *line in [*((SQUARE, *c) for c in (*of_lines(), *of_sites())), *of_lists(), *of_sphere(), *of_pairs(),
                                       *of_ends(),
                                       *((DESCRIBED, *c) for c in of_descriptions())]:
        old, new = (old, new) if old[0] == '\n' or '\n' in old else (f'{old}\n', f'{new}\n')
        assert good.count(old) == 1, (old, good.count(old))
        text = good.replace(old, new)
        at = first_difference(good, text)
        yield text, at + line[0] if line else at, why
    for text, line in of_words():
        yield text, line, ''


def verdict(folder, number, text):
    path = folder / f'{number}'
    path.write_text(text)
    done = subprocess.run([DYADEL, 'verify', path], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)
    found = re.search(r':(\d+): rejected: (.*)\n$', done.stderr, re.S)
    return (done.returncode, int(found[1]), found[2]) if found else (done.returncode, None, done.stderr)


def calls(text, name):
    """The text between the parentheses of each call."""
    for at in (m.end() for m in re.finditer(re.escape(name) + r'\(', text)):
        end, depth = at, 1
        while depth:
            depth += {'(': 1, ')': -1}.get(text[end], 0)
            end += 1
        yield text[at:end]


def reasons():
    """As patterns."""
    for path in sorted((ROOT / 'src/checker').glob('*.c')):
        for call in calls(path.read_text(), 'dyd_cert_reject'):
            for reason in re.findall(r'"((?:[^"\\]|\\.)*)"', call):
                yield path.name, re.sub(r'%(\\\.\d+|l+|z)*[sdu]', '.*', re.escape(reason.replace('\\"', '"')))


def forged_parts():
    """Certificates of discs, graphs and places whose verdicts are in test_seeded.py; this table has the reasons of
    rejection."""
    found = re.findall(r'(.*?)---- (.*?)\n', (ROOT / 'tests/checker/forgeries_parts.txt').read_text(), re.S)
    return [text for text, said in found if said == 'rejected']


def main():
    wrong, seen = [], set()
    with tempfile.TemporaryDirectory() as name, concurrent.futures.ThreadPoolExecutor(2) as pool:
        folder = pathlib.Path(name)
        for text, status in GOOD:
            code, _, why = verdict(folder, 'good', text)
            if code != status:
                wrong.append(f'{code}, not {status}: {why}\n{text}')
        listed = list(cases())
        verdicts = pool.map(lambda case: verdict(folder, case[0], case[1][0]), enumerate(listed))
        for (text, line, why), (code, at, found) in zip(listed, verdicts):
            seen.add(found)
            if code != 1 or at != line or why not in found:
                wrong.append(f'{code}, line {at}: {found}, not line {line}: {why}\n{text}')
        seen |= {verdict(folder, 'part', text)[2] for text in forged_parts()}
    for source, pattern in reasons():
        if not any(re.fullmatch(pattern, text, re.S) for text in seen):
            wrong.append(f'{source}: no certificate here is rejected for this: {pattern}')
    print(f'{len(listed)} certificates')
    print(*wrong, sep='\n')
    return wrong != []


if __name__ == '__main__':
    sys.exit(main())
