#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""--window of delaunay: pictures show that part of the plane and nothing else, other formats do not change.

Usage: test_window.py COMMAND DATA
"""
import os
import re
import tempfile

import svg
from harness import DATA, count, expect, main, run

AIRPORTS = (os.path.join(DATA, 'airports.csv'), '--columns', 'longitude,latitude', '--radius', '0.05')
EAST = '--window=-76,-73,39,42'
POINTS = '0 0\n10 0\n[4.9,5.1] [7,8]\n5 -30\n'


def picture(text, *options, command='delaunay', code=(0, 3)):
    result = run(command, '-', '--format', 'svg', '--quiet', *options, stdin=text)
    assert result.code in code, result
    svg.elements(result.out)
    assert 'nan' not in result.out and 'inf' not in result.out
    return result.out


def shapes(text):
    """The shapes drawn, without clips, as lists of numbers."""
    return [svg.numbers(path) for path in svg.paths(text)]


def near(a, b):
    return all(abs(s - t) <= 0.02 for s, t in zip(a, b)) and len(a) == len(b)


def test_text_does_not_change():
    for name in ('csv', 'json', 'wkt', 'geojson', 'obj', 'vtk'):
        whole, part = (run('delaunay', '-', '--format', name, *window, stdin=POINTS)
                       for window in ((), ('--window', '4,6,-1,1')))
        assert part.code == whole.code and part.err == whole.err
        # Counters report memory and time, the call has the window.
        drop = re.compile(r'^.*(seconds|bytes|memory|command_line).*$', re.M)
        assert drop.sub('', part.out) == drop.sub('', whole.out), name
    assert count(run('delaunay', '-', '--window', '100,101,100,101', stdin=POINTS).out)


def test_certificate_does_not_change():
    with tempfile.TemporaryDirectory() as folder:
        name = os.path.join(folder, 'c.txt')
        for window in ((), ('--window', '4,6,-1,1')):
            run('delaunay', '-', '--certificate', name, *window, stdin=POINTS)
            expect(run('verify', name), 0, 'accepted|checked|holds|.')
            with open(name, encoding='utf-8') as f:
                text = f.read()
            if not window:
                whole = text
        assert text == whole


def test_frame_is_the_window():
    # Two units are 1000 points: the x axis is the middle line, cut a little outside of the frame.
    part = picture(POINTS, '--window', '4,6,-1,1')
    assert near(svg.frame(part), (90, 1090, 30, 1030)), svg.frame(part)
    ends = [s for s in shapes(part) if len(s) == 4 and near(s[1::2], (530, 530)) and s[2] - s[0] > 500]
    assert ends and all(s[0] <= 90 and s[2] >= 1090 for s in ends), shapes(part)
    assert shapes(part) != shapes(picture(POINTS))
    # Half as high as wide: the page is lower, the frame too.
    assert near(svg.frame(picture(POINTS, '--window', '4,6,-1/2,1/2')), (90, 1090, 30, 530))
    # Narrow: in the middle of a page that has room for the legend.
    assert near(svg.frame(picture(POINTS, '--window', '4.9,5.1,-1,1')), (360, 460, 30, 1030))


def test_rectangle_is_where_it_should_be():
    # [4.9,5.1] x [7,8] on a window of 2 x 2 about (5,7.5): 100 x 500 points.
    part = picture(POINTS, '--window', '4,6,6.5,8.5')
    boxes = [(min(s[::2]), max(s[::2]), min(s[1::2]), max(s[1::2])) for s in shapes(part) if len(s) >= 8]
    assert any(near(box, (540, 640, 280, 780)) for box in boxes), boxes


def test_nothing_is_drawn_far_outside():
    # Numbers of cairo end at 2^23 pixels: points farther off would appear on the other side.
    text = POINTS + '[20000,20001] [-20000,20000]\n1e5 1e5\n'
    windows = ['4,6,-1,1', '4.999,5.001,-0.001,0.001', '5,5+2e-5,0,2e-5', '4.9,4.9+2e-5,7,7+2e-5', '99999,100001,99999,100001']
    for window in windows:
        for shape in shapes(picture(text, '--window', window)):
            assert all(-120 <= t <= 1200 for t in shape), (window, shape)
    part = picture('1/2 1/2\n[9000,9001] [-20000,20000]\n', '--window', '0,1,0,1', command='voronoi', code=(0, 3, 4))
    assert all(-120 <= t <= 1200 for shape in shapes(part) for t in shape)


def test_empty_place_and_no_points():
    for text in ('', '1 1\n', '0 0\n1 0\n', POINTS):
        picture(text, '--window', '100,101,100,101')
    whole = run('delaunay', '-', '--format', 'svg', stdin=POINTS)
    assert shapes(whole.out)


def test_windows_too_small_for_doubles():
    for window in ('5,5+1e-14,0,1', '5,5+1e-14,0,1e-14', '0,1e-320,0,1e-320', '1e300,1e300+1,0,1', '0,1e400,0,1'):
        result = run('delaunay', '-', '--format', 'svg', '--window', window, stdin=POINTS)
        assert result.code in (0, 1, 3), result
        if result.code == 1:
            expect(result, 1, r'\A\Z', 'too small|too far apart or too close')
    expect(run('delaunay', '-', '--format', 'svg', '--window', '5,5+1e-14,0,1e-14', stdin=POINTS), 1, r'\A\Z',
           'the window is too small for a picture of these points; give a larger one')
    assert run('delaunay', '-', '--window', '5,5+1e-14,0,1e-14', stdin=POINTS).code in (0, 3)


def test_wrong_windows():
    for window, message in (('1,0,0,1', 'wrong order'), ('0,0,0,1', 'no area'), ('0,1', 'four exact numbers'),
                            ('0,1,0,nan', 'four exact numbers'), ('', 'four exact numbers')):
        for name in ('csv', 'svg'):
            expect(run('delaunay', '-', '--format', name, '--window', window, stdin=POINTS), 2, r'\A\Z',
                   f'^dyadel: --window .*{message}')


def test_crowded_airports():
    whole = run('delaunay', *AIRPORTS, '--format', 'svg', '--quiet')
    part = run('delaunay', *AIRPORTS, '--format', 'svg', '--quiet', EAST)
    expect(part, 3)
    assert 1000 < len(part.out) < len(whole.out) / 4, (len(part.out), len(whole.out))
    assert all(-120 <= t <= 1200 for shape in shapes(part.out) for t in shape)
    for kind, magic in (('pdf', b'%PDF'), ('png', b'\x89PNG')):
        with tempfile.TemporaryDirectory() as folder:
            name = os.path.join(folder, 'x.' + kind)
            expect(run('delaunay', *AIRPORTS, '--quiet', '--format', kind, '-o', name, EAST), 3)
            with open(name, 'rb') as f:
                assert f.read(4) == magic


main(globals())
