#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""In a program whose locale has decimal commas, other digits' groups, or letters whose case differs (in Turkish I is not the
capital of i), all formats are the same as elsewhere, and all input is read alike: the shim sets the locale of the
command. Needs localedef and the sources of the locales (Debian: locales); else there is nothing to test with.

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
            ('tolerance', EXACT, '--layer', 'barcode'), ('plan', POINTS),
            ('delaunay', b'ID,INDEX,XI,YI,RI,HULL\nI,1,0,0.5,0.25,a\ni,2,4,INF,1,b\nj,3,4,0.5,NULL,c\nk,4,0,4,1e-3,d\nl,5,5,N/A,1,e\nm,6,7,1,0.5,f\n',
             '--columns', 'xi,yi', '--radius-column', 'ri', '--id', 'id', '--skip-missing', '--carry', 'all', '--layer', 'points'),
            ('delaunay', b'I;x;y;LEGAL\n1;0,5;1\'000,25;a\n2;2;3;b\n3;-1,5;7;c\n', '--columns', 'X,Y', '--decimal-comma', '--thousands', "'",
             '--carry', 'i,legal', '--layer', 'points'),
            ('delaunay', b'Point (1.5 2.5)\nsrid=4326;MULTIPOINT (3 4.25)\npoint(0 7)\n'),
            ('delaunay', b'id,shape\n1,Multipoint (1.5 2.5)\n2,LINESTRING (3 4.25)\n', '--columns', 'id,shape'),
            ('delaunay', b"47\xc2\xb036'18.3\"N 8\xc2\xb01'E\nn48.605 e9.1\n47.5N 7.25W\n", '--sphere', '--radius', '30.5m'),
            ('delaunay', b'lon,lat,accuracyInMeters\n8.5,47.25,3 MM\n9.5,48,2.5\n7,46,0.001KM\n9,44.5,1 IN\n', '--sphere', '--columns', 'LON,LAT',
             '--radius-column', 'ACCURACYINMETERS')]
FORMATS = {'delaunay': ('json', 'wkt', 'geojson', 'obj', 'vtk', 'svg'), 'voronoi': ('json', 'svg', 'vtk'), 'converge': ('json',),
           'nearest': ('json', 'svg'), 'tolerance': ('json', 'svg'), 'bisector': ('json', 'svg'), 'disc': ('json', 'svg'), 'plan': ('json',)}
LOCALES = ('de_DE', 'tr_TR', 'hi_IN', 'ar_SA')


def run(args, text, **env):
    done = subprocess.run([COMMAND, *args], input=text, stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False,
                          env=dict(os.environ, **env), timeout=100)
    seconds = rb'(?<=,)\d+\.\d{3}(?=\n)|(?<="seconds": )\d+\.\d{3}|(?<=milliseconds_rounded_up": )\d+'
    return done.returncode, re.sub(seconds, b'T', done.stdout), done.stderr


def make(folder, name):
    """The environment in which the command has this locale; None where it cannot be made."""
    way = dict(os.environ, LOCPATH=folder, LC_ALL=name + '.UTF-8')
    if os.path.exists('/usr/share/i18n/locales/' + name):
        subprocess.run(['localedef', '-i', name, '-f', 'UTF-8', os.path.join(folder, name + '.UTF-8')], check=False,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    if not os.path.isdir(os.path.join(folder, name + '.UTF-8')):
        return None
    subprocess.run([sys.executable, '-c', 'import locale; locale.setlocale(locale.LC_ALL, "")'], env=way, check=True)
    return {'LD_PRELOAD': SHIM, 'FAULT_LOCALE': '1', 'LOCPATH': folder, 'LC_ALL': name + '.UTF-8'}


def main():
    with tempfile.TemporaryDirectory() as folder:
        known = {name: make(folder, name) for name in LOCALES}
        if not all(known[name] for name in LOCALES[:2]):
            print('no locale with decimal commas can be made')
            sys.exit(77)
        wrong = tried = 0
        for command, text, *rest in COMMANDS:
            for form in ('csv', *(FORMATS.get(command, ()) if '--columns' not in rest and '--layer' not in rest else ())):
                args = [command, '-', *rest, '--format', form]
                plain = run(args, text)
                assert plain[0] in (0, 1, 2, 3, 4), (args, plain)
                for name, env in known.items():
                    other = env and run(args, text, **env)
                    tried += 1
                    if env and plain != other:
                        wrong += 1
                        print('FAILED', name, args, plain[0], other[0], *(f'{a[:80]} / {b[:80]}' for k in (1, 2) for a, b in zip(
                            plain[k].splitlines(), other[k].splitlines()) if a != b), sep='\n')
    print(tried, 'runs,', wrong, 'differ')
    sys.exit(1 if wrong else 0)


main()
