#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Files and streams of the command: endings that choose formats, outputs that would destroy inputs, links, terminals,
readers that go away; and the manners of any command: help, short options, exit statuses for scripts.

Usage: test_files.py COMMAND DATA
"""
import contextlib
import os
import pty
import re
import signal
import subprocess
import tempfile

from harness import COMMAND, expect, main, run

POINTS = '0 0\n4 0\n0 4\n5 5\n'
SQUARE = '0 0\n1 0\n0 1\n1 1\n'


class Folder(tempfile.TemporaryDirectory):
    """A folder with the points in in.txt; read and write by name."""

    def __enter__(self):
        self.path = super().__enter__()
        self.write('in.txt', POINTS)
        return self

    def write(self, name, text):
        with open(os.path.join(self.path, name), 'w', encoding='utf-8') as f:
            f.write(text)

    def read(self, name, size=-1):
        with open(os.path.join(self.path, name), 'rb') as f:
            return f.read(size)

    def run(self, *args, **options):
        return run(*args, cwd=self.path, **options)

    def names(self):
        return sorted(os.listdir(self.path))


BEGINNINGS = {'csv': b'i,j,status\n', 'json': b'{"format": "dyadel delaunay 1"', 'wkt': b'WKT,', 'geojson': b'{"type": "Fea',
              'obj': b'# dyadel', 'vtk': b'# vtk', 'svg': b'<?xml', 'pdf': b'%PDF', 'png': b'\x89PNG', 'PNG': b'\x89PNG',
              'txt': b'i,j,status\n'}


def test_endings():
    with Folder() as f:
        for ending, beginning in BEGINNINGS.items():
            for output in ('-o', '--output'):
                expect(f.run('delaunay', 'in.txt', output, 'x.' + ending), 0, r'\A\Z', r'\A\Z')
                assert f.read('x.' + ending).startswith(beginning), ending
                os.unlink(os.path.join(f.path, 'x.' + ending))
        for name, form, beginning in (('a.csv', 'wkt', b'WKT,'), ('a.json', 'geojson', b'{"type"'), ('a', 'svg', b'<?xml'),
                                      ('b.svg', 'svg', b'<?xml'), ('a.txt', 'json', b'{"for'), ('d.svg/a', 'csv', b'i,j')):
            os.makedirs(os.path.join(f.path, 'd.svg'), exist_ok=True)
            expect(f.run('delaunay', 'in.txt', '-o', name, '--format', form), 0)
            assert f.read(name).startswith(beginning), name
        before = f.names()
        for name, form in (('x.svg', 'csv'), ('x.csv', 'json'), ('x.wkt', 'csv'), ('x.geojson', 'json'), ('x.png', 'svg')):
            expect(f.run('delaunay', 'in.txt', '-o', name, '--format', form), 2, r'\A\Z',
                   rf'\Adyadel: -o {name} does not name a {form} file; remove --format {form}, or end the name in .{form}$')
        expect(f.run('converge', 'in.txt', '-o', 'x.svg'), 2, '', 'converge does not write svg; give csv, json, html$')
        expect(f.run('voronoi', 'in.txt', '-o', 'x.obj'), 2, '', 'voronoi does not write obj; give ')
        assert f.names() == before


def test_outputs_are_no_inputs():
    """Nothing is written, whatever way the same file is named."""
    with Folder() as f:
        os.link(os.path.join(f.path, 'in.txt'), os.path.join(f.path, 'hard.txt'))
        os.symlink('in.txt', os.path.join(f.path, 'soft.txt'))
        os.symlink('nowhere.csv', os.path.join(f.path, 'dangling.csv'))
        os.mkdir(os.path.join(f.path, 'sub'))
        before = f.names()
        absolute = os.path.join(f.path, 'in.txt')
        for name in ('in.txt', './in.txt', 'sub/../in.txt', absolute, 'hard.txt', 'soft.txt'):
            for option in ('--output', '--certificate'):
                for given in ('in.txt', 'soft.txt', absolute):
                    expect(f.run('delaunay', given, option, name), 2, r'\A\Z',
                           rf'\Adyadel: {option} {re.escape(name)} is the input file; give another name')
            expect(f.run('voronoi', 'in.txt', '--certificate', name), 2, r'\A\Z', 'is the input file')
            expect(f.run('converge', 'in.txt', '--trace', name), 2, r'\A\Z', 'is the input file')
            expect(f.run('converge', 'in.txt', '--plot', name), 2, r'\A\Z', '')
            expect(f.run('verify', 'in.txt', '-o', name), 2, r'\A\Z', 'is the input file')
        same = 'are the same file; give each result a file of its own$'
        for one, other in (('x.csv', 'x.csv'), ('x.csv', './x.csv'), ('sub/x.csv', 'sub/../sub/x.csv'),
                           ('dangling.csv', 'nowhere.csv')):
            expect(f.run('delaunay', 'in.txt', '-o', one, '--certificate', other), 2, r'\A\Z', same)
        expect(f.run('converge', 'in.txt', '-o', 'x.csv', '--trace', 'x.csv'), 2, r'\A\Z', same)
        expect(f.run('converge', 'in.txt', '--plot', 'x.svg', '--trace', './x.svg'), 2, r'\A\Z', same)
        expect(f.run('check', 'in.txt', '--replay', 'hard.txt', '-o', 'soft.txt'), 2, r'\A\Z', 'is the input file')
        for option in ('--certificate', '--trace'):
            expect(f.run('delaunay', 'in.txt', option, '-'), 2, r'\A\Z', rf'{option} -: standard output is for the result; give a name')
        assert f.run('delaunay', 'in.txt', '-o', '-', '--format', 'svg').out == f.run('delaunay', 'in.txt', '--format', 'svg').out
        assert f.names() == before and f.read('in.txt') == POINTS.encode()
        for mode, message in (('ab', 'standard output is the input file'), ('rb', None)):
            with open(absolute, mode) as out, open(absolute, 'rb') as source:
                done = subprocess.run([COMMAND, 'delaunay', '-'], stdin=source, stderr=subprocess.PIPE, check=False,
                                      stdout=out if message else subprocess.PIPE)
            assert done.returncode == (2 if message else 0) and (message or '').encode() in done.stderr, done
        with open(absolute, 'rb') as source:
            done = subprocess.run([COMMAND, 'delaunay', '-', '-o', absolute], stdin=source, stderr=subprocess.PIPE, check=False)
        assert done.returncode == 2 and f.read('in.txt') == POINTS.encode()
        expect(f.run('delaunay', 'in.txt', '-o', 'sub/in.txt', '--certificate', 'other.txt'), 0)
        expect(f.run('delaunay', 'in.txt', '-o', '/dev/null', '--certificate', '/dev/null'), 0)
        expect(f.run('delaunay', 'in.txt', '-o', '/dev/stdout', '--certificate', '/dev/stdout'), 0, 'i,j,status')


def test_dangling_link():
    with Folder() as f:
        os.mkdir(os.path.join(f.path, 'sub'))
        for link, target, name in (('a', 'b.csv', 'b.csv'), ('sub/c', 'd.csv', 'sub/d.csv'), ('e', 'sub/c2', 'sub/d2.csv'),
                                   ('g', os.path.join(f.path, 'h.csv'), 'h.csv')):
            os.symlink(target, os.path.join(f.path, link))
            if link == 'e':
                os.symlink('d2.csv', os.path.join(f.path, 'sub/c2'))
            expect(f.run('delaunay', 'in.txt', '-o', link), 0)
            assert os.path.islink(os.path.join(f.path, link)) and f.read(name).startswith(b'i,j,status'), link
        os.symlink('no/such/folder', os.path.join(f.path, 'k'))
        expect(f.run('delaunay', 'in.txt', '-o', 'k'), 1, '', r'\Adyadel: k: cannot write: No such file or directory; choose')
        os.symlink('l', os.path.join(f.path, 'l'))
        assert f.run('delaunay', 'in.txt', '-o', 'l').code in (0, 1)


def test_reader_went_away():
    """Told once; the process ends as others do, unless it was started with the signal ignored; other files are whole."""
    grid = ''.join(f'{x} {y * 1.01 ** x}\n' for x in range(120) for y in range(120)).encode()
    for ignored, quiet in ((False, False), (False, True), (True, False)):
        with Folder() as f:
            process = subprocess.Popen(
                [COMMAND, 'delaunay', '-', '--certificate', 'c'] + ['-q'] * quiet, stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                stderr=subprocess.PIPE, cwd=f.path, restore_signals=not ignored)
            process.stdin.write(grid)
            process.stdin.close()
            process.stdout.read(10)
            process.stdout.close()
            err = process.stderr.read().decode()
            process.stderr.close()
            code = process.wait(timeout=120)
            assert code == (1 if ignored else -signal.SIGPIPE), (code, err)
            assert err.count('dyadel: standard output: output closed early (broken pipe)\n') == (not quiet), err
            assert not quiet or not err, err
            expect(f.run('verify', 'c'), 0)
            assert f.names() == ['c', 'in.txt']
    for args in (('--help',), ('--version',), ('help', 'delaunay')):
        end, out = os.pipe()
        os.close(end)
        done = subprocess.run([COMMAND, *args], stdout=out, stderr=subprocess.PIPE, check=False)
        os.close(out)
        assert done.returncode == -signal.SIGPIPE and done.stderr.count(b'\n') == 1, done


def test_pictures_and_terminals():
    def on_terminal(*args):
        ours, theirs = pty.openpty()
        process = subprocess.Popen([COMMAND, *args], stdin=subprocess.PIPE, stdout=theirs, stderr=subprocess.PIPE)
        os.close(theirs)
        with contextlib.suppress(BrokenPipeError):  # it may have refused already
            process.stdin.write(SQUARE.encode())
            process.stdin.close()
        try:
            while os.read(ours, 4096):
                pass
        except OSError:  # how a terminal reports that its writers are gone
            pass
        os.close(ours)
        with process.stderr:
            return process.wait(timeout=60), process.stderr.read().decode()

    for form in ('png', 'pdf'):
        for command in (('delaunay', '-'), ('disc', '-'), ('nearest', '-', '0', '0')):
            assert on_terminal(*command, '--format', form) == (
                2, f'dyadel: {form} is nothing for a terminal; give a file: -o NAME.{form}\n')
    for form in ('svg', 'csv', 'json'):
        assert on_terminal('delaunay', '-', '-q', '--format', form) == (3, '')
    with Folder() as f:
        assert on_terminal('delaunay', '-', '-q', '-o', os.path.join(f.path, 'x.png')) == (3, '')
        assert f.read('x.png', 4) == b'\x89PNG'


def test_empty_files():
    with Folder() as f:
        f.write('empty', '')
        f.write('comments', '# nothing\n\n')
        f.write('header.csv', 'x,y\n')
        for args in (('empty',), ('comments',), ('--columns', 'x,y', 'header.csv')):
            expect(f.run('delaunay', *args), 0, r'\Ai,j,status\n\Z', rf'\Adyadel: {args[-1]}: this file has no points$')
            expect(f.run('delaunay', '-q', *args), 0, r'\Ai,j,status\n\Z', r'\A\Z')


def test_help_and_short_options():
    assert run('help') == run('--help') == run('-h')
    for command in ('delaunay', 'voronoi', 'converge', 'check', 'verify', 'disc', 'bisector', 'nearest'):
        text = run('help', command)
        expect(text, 0, rf'\AUsage: dyadel {command}', r'\A\Z')
        assert text == run(command, '--help') == run(command, '-h') == run('-h', command)
    expect(run('help', 'delauny'), 2, r'\A\Z', 'there is no command "delauny"; did you mean delaunay')
    expect(run('help', 'disc', 'x'), 2, r'\A\Z', '"x" is one argument too many; give dyadel help COMMAND$')
    assert run('-V') == run('--version') and re.fullmatch(r'dyadel \d+\.\d+\.\d+\n', run('-V').out)
    assert run('delaunay', '-q', '-', stdin=SQUARE) == run('delaunay', '--quiet', '-', stdin=SQUARE)
    expect(run('delaunay', '-q', '-', stdin=SQUARE), 3, 'tie', r'\A\Z')


def test_accepted_fixpoint():
    """3 becomes 0, and nothing else does; the result and the notes are the same."""
    for args in (('delaunay', '-'), ('voronoi', '-'), ('converge', '--no-times', '-'), ('nearest', '-', '1/2', '1/2')):
        strict, loose = run(*args, stdin=SQUARE), run(*args, '--accept-fixpoint', stdin=SQUARE)
        assert strict.code == 3 and loose.code == 0 and strict[1:] == loose[1:], args
    for command, text in (('disc', '[0,1] 0\n1 0\n0 1\n[0,1] [0,1]\n'), ('bisector', '[0,2] 0\n[1,3] 0\n')):
        assert run(command, '-', stdin=text).code == 3 and run(command, '--accept-fixpoint', '-', stdin=text).code == 0
    expect(run('delaunay', '-', '--accept-fixpoint', stdin='x y\n'), 1)
    expect(run('delaunay', '-', '--accept-fixpoint', '--max-bits', '99', stdin='0 0\n1 0\n1 1\n0 4*atan(1)/pi\n'), 4)
    expect(run('check', '-', '--accept-fixpoint', stdin=SQUARE), 2, '', 'check does not take --accept-fixpoint')


if __name__ == '__main__':
    main(globals())
