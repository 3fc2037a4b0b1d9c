#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""In a program whose locale has decimal commas all formats are what they are elsewhere: the shim sets the locale of the
command. Needs localedef and the sources of de_DE (Debian: locales); else there is nothing to test with.

Usage: test_locale.py COMMAND SHIM
"""
import os
import re
import subprocess
import sys
import tempfile

COMMAND, SHIM = (os.path.abspath(path) for path in sys.argv[1:3])
POINTS = b'sqrt(2) 0\n4 [0.5,0.75]\n0 4\n5+-0.01 5\n2.5 1.25\n1e-3 7\n'
EXACT = b'0 0\n4 0.5\n0 4\n5 5.25\n7 1\n2 2.125\n'
COMMANDS = [('delaunay', POINTS), ('voronoi', POINTS, '--window', '-9.5,9.5,-9,9'), ('converge', POINTS),
            ('nearest', POINTS, '0.5', '1.5'), ('bisector', POINTS), ('disc', POINTS), ('tolerance', EXACT, '--up-to', '0.5'),
            ('tolerance', EXACT, '--layer', 'barcode'), ('plan', POINTS)]
FORMATS = {'delaunay': ('json', 'wkt', 'geojson', 'obj', 'vtk', 'svg'), 'voronoi': ('json', 'svg', 'vtk'), 'converge': ('json',),
           'nearest': ('json', 'svg')}


def run(args, text, **env):
    done = subprocess.run([COMMAND, *args], input=text, stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False,
                          env=dict(os.environ, **env), timeout=100)
    seconds = rb'(?<=,)\d+\.\d{3}(?=\n)|(?<="seconds": )\d+\.\d{3}|(?<=milliseconds_rounded_up": )\d+'
    return done.returncode, re.sub(seconds, b'T', done.stdout), done.stderr


def main():
    with tempfile.TemporaryDirectory() as folder:
        made = subprocess.run(['localedef', '-i', 'de_DE', '-f', 'UTF-8', os.path.join(folder, 'de_DE.UTF-8')], check=False,
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) if os.path.exists(
                                  '/usr/share/i18n/locales/de_DE') else None
        env = {'LD_PRELOAD': SHIM, 'FAULT_LOCALE': '1', 'LOCPATH': folder, 'LC_ALL': 'de_DE.UTF-8'}
        if not made or not os.path.isdir(os.path.join(folder, 'de_DE.UTF-8')):
            print('no locale with decimal commas can be made')
            sys.exit(77)
        shown = subprocess.run([sys.executable, '-c', 'import locale; locale.setlocale(locale.LC_ALL, ""); '
                                'print(locale.localeconv()["decimal_point"])'], env=dict(os.environ, LOCPATH=folder,
                                LC_ALL='de_DE.UTF-8'), stdout=subprocess.PIPE, check=True).stdout
        assert shown == b',\n', shown
        wrong = 0
        for command, text, *rest in COMMANDS:
            for form in ('csv', *FORMATS.get(command, ())):
                args = [command, '-', *rest, '--format', form]
                plain, comma = run(args, text), run(args, text, **env)
                assert plain[0] in (0, 3, 4), (args, plain)
                if plain != comma:
                    wrong += 1
                    print('FAILED', args, *(f'{a[:80]} / {b[:80]}' for k in (1, 2) for a, b in zip(
                        plain[k].splitlines(), comma[k].splitlines()) if a != b), sep='\n')
    print(wrong, 'differ')
    sys.exit(1 if wrong else 0)


main()
