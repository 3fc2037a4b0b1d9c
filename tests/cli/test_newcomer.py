#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A newcomer's mistakes: every command on input that is empty, strange or wrong, and output to places that cannot be
written. The right exit status, a message with place and remedy, never a crash.

Usage: test_newcomer.py COMMAND DATA
"""
import os
import re
import subprocess
import tempfile

from harness import COMMAND, DATA, expect, main, run

FORMATS = {'delaunay': 'csv json wkt geojson obj vtk svg pdf png', 'voronoi': 'csv json wkt geojson vtk svg pdf png',
           'converge': 'csv json', 'check': 'csv json', 'disc': 'csv json svg pdf png',
           'bisector': 'csv json svg pdf png', 'nearest': 'csv json svg pdf png'}
NEEDED = {'disc': 3, 'bisector': 2}

# Bytes of a file; what every command that reads points says: LINE:COLUMN and message, or None where it is good input.
INPUTS = {
    'empty': (b'', None),
    'comments': (b'# nothing\n\n   \n', None),
    'one': (b'1 2\n', None),
    'two': (b'1 2\n3 4\n', None),
    'equal': (b'1 2\n1.0,2\n2/2 2e0\n', None),
    'line': (b'0 0\n1 1\n2 2\n3 3\n', None),
    'crlf': (b'0 0\r\n1 0\r\n0 1\r\n3 3\r\n', None),
    'bom': (b'\xef\xbb\xbf0 0\n1 0\n0 1\n', None),
    'no final newline': (b'0 0\n1 0\n0 1', None),
    'large': (b'1e300 0\n0 -1e300\n-1e300 1e-300\n', None),
    'long but good': (b'-' * 100000 + b'1 2\n3 4\n0 9\n', None),
    'nan': (b'0 0\nnan 1\n', "2:1: the coordinate is missing .nan.; fill it in, or leave such rows out: --skip-missing"),
    'inf': (b'0 inf\n', '1:3: coordinates are finite, and this is infinite'),
    'Infinity': (b'0 -Infinity\n', '1:4: coordinates are finite, and this is infinite'),
    'inf of an interval': (b'0 [1,INF]\n', '1:6: coordinates are finite, and this is infinite'),
    'info': (b'0 info\n', "1:3: the name 'info' is unknown"),
    'too large': (b'1e999999 0\n', '1:1: the number is too large .*; scale the input'),
    'too fine': (b'0 1e-999999\n', '1:3: the number is too large or too fine.*; scale the input'),
    'absurd exponent': (b'1e99999999999999999999 0\n', '1:1: the number is too large .*; scale the input'),
    'absurd power': (b'0 0\n2^2^2^2^2^2 2\n', '2:2: .* scale the input'),
    'long line': (b'1' * 10000000 + b' 2\n', '1:1: this line is longer than .*; give one point per line'),
    'deep': (b'(' * 100000 + b'1 2\n', '1:[0-9]+: '),
    'half a point': (b'0 0\n1\n', '2:2: the line has one coordinate only; give two'),
    'semicolon': (b'0 0\n1;2\n', '2:4: the line has one coordinate only; give two, separated by a blank or a comma'),
    'three': (b'1 2 3\n', '1:5: more than two coordinates'),
    'header': (b'x,y\n1,2\n', '1:1: .*; if this line is a header, name the columns of x and y: --columns x,y '),
    'quoted header': (b'"name","x","y"\na,1,2\n', '1:2: this line is a header and no point; .*--columns x,y '),
    'no text': (b'0 0\n\xff\xfe 1\n', '2:1: '),
    'nul': (b'0 0\n1 0\0\n', '2:4: a NUL byte; give plain text'),
    'reversed': (b'0 0\n1 0\n0 [2,1]\n', '3:4: the lower end of the interval is above the upper end; exchange them'),
    'division by 0': (b'0 1/0\n', '1:5: the denominator is 0'),
}


def arguments(command, file):
    extra = {'nearest': ('0', '0'), 'check': ('--schedules', '1')}.get(command, ())
    return (command, '--timeout', '20', '--max-bits', '128', file, *extra)


def test_inputs():
    with tempfile.TemporaryDirectory() as folder:
        for name, (content, message) in INPUTS.items():
            with open(os.path.join(folder, 'points'), 'wb') as f:
                f.write(content)
            for command in FORMATS:
                result = run(*arguments(command, 'points'), cwd=folder)
                try:
                    if message:
                        expect(result, 1, r'\A\Z', r'\Adyadel: points:' + message)
                    elif command in NEEDED and 'points are needed' in result.err:
                        expect(result, 1, r'\A\Z', f'points: {NEEDED[command]} points are needed, here are .; give more')
                    else:
                        assert result.code in (0, 3), result
                except AssertionError as problem:
                    raise AssertionError(f'{name}, {command}: {problem}') from problem


def test_formats_of_little():
    """Every format of every command, of none to four points: all bytes are written, and no message."""
    little = ('', '1 2\n', '1 2\n3 4\n', '1 2\n1 2\n1 2\n', '0 0\n4 0\n[0,1] 4\n4 4\n')
    for command, formats in FORMATS.items():
        for form in formats.split():
            for text in little:
                if command == 'check' or text.count('\n') < NEEDED.get(command, 0):
                    continue
                result = run(*arguments(command, '-'), '--quiet', '--format', form, stdin=text, binary=True)
                expect(result, result.code, '', r'\A\Z')
                assert result.code in (0, 3) and result.out, (command, form, text, result)


def test_places():
    for command in FORMATS:
        expect(run(*arguments(command, 'nowhere')), 1, r'\A\Z', r'\Adyadel: nowhere: cannot open: .*; check the name')
        expect(run(*arguments(command, '.')), 1, r'\A\Z', r'\Adyadel: \.: is a directory; give the name of a points file')
        if command == 'check':
            continue
        done = subprocess.run([COMMAND, *arguments(command, '-')], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              timeout=60, check=False, preexec_fn=lambda: os.close(0))
        assert done.returncode == 1 and done.stderr.startswith(b'dyadel: -: cannot read: '), done
    expect(run('verify', 'nowhere'), 1, r'\A\Z', r'nowhere: cannot open: .*; check the name of the certificate')
    expect(run('verify', '-', stdin='x\n'), 1, r'\A\Z', '-:1: rejected')


def test_outputs_that_fail():
    points = '0 0\n3 0\n0 4\n3 4.5\n'
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, 'points'), 'w', encoding='ascii') as f:
            f.write(points)
        for command, formats in FORMATS.items():
            for form in formats.split():
                for place, why in (('/dev/full', 'No space left'), ('nowhere/x', 'No such file'), ('.', 'Is a directory')):
                    result = run(*arguments(command, 'points'), '--format', form, '-o', place, cwd=folder)
                    expect(result, 1, r'\A\Z', f'^dyadel: {re.escape(place)}: cannot write: {why}.*; choose another place')
                with open('/dev/full', 'wb') as full:
                    done = subprocess.run([COMMAND, *arguments(command, 'points'), '--format', form], stdout=full,
                                          stderr=subprocess.PIPE, cwd=folder, timeout=60, check=False)
                assert done.returncode == 1 and b'standard output: cannot write: No space left' in done.stderr, done
        assert os.listdir(folder) == ['points']


def test_polygons_too_fine():
    for text, bits in (('[0,1] 0\n[4,5] [0,1]\n0 [4,5]\n', '60'), ('[0,1] 0\n[4,5] [0,1]\n0 [4,5]\n', '1000000')):
        expect(run('voronoi', '--quiet', '--flatten', bits, '-', stdin=text), 1, r'\A\Z',
               r'polygons within 2\^-' + bits + ' of their cells .*; give a smaller M by --flatten')


def test_airports_without_columns():
    expect(run('delaunay', os.path.join(DATA, 'airports.csv')), 1, r'\A\Z', 'airports.csv:1:.*--columns')


main(globals())
