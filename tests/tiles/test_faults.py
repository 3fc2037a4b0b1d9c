#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Faults of dyadel-tiles are reported clearly, and --restart completes the job.

Usage: test_faults.py TILES DYADEL [MPIRUN]
"""
import os
import pathlib
import random
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest

import tiles_cases as cases

TILES, DYADEL = sys.argv[1:3]
MPIRUN = sys.argv[3:4]
# 4,096 bytes by its size, of which a few can be read.
UNREADABLE = pathlib.Path('/sys/devices/system/cpu/online')
# Rank 1 (in one process: all) may write files of this many blocks only.
SMALL_DISK = ('if [ "${OMPI_COMM_WORLD_RANK:-1}" = 1 ]; then trap "" XFSZ; ulimit -f 8; fi; exec "$0" "$@"')


def command(ranks, *words, before=()):
    if MPIRUN:
        return [*MPIRUN, '--oversubscribe', '--allow-run-as-root', '-n', str(ranks), *before, TILES, *words]
    return [*before, TILES, *words, '--tiles', str(ranks)]


def tiles(ranks, *words, before=()):
    return subprocess.run(command(ranks, *words, before=before), capture_output=True, text=True, timeout=600)


class Faults(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.at = pathlib.Path(folder.name)
        self.file, self.out = str(self.at / 'in.bin'), str(self.at / 'out')
        self.rows = cases.repeated(20000, random.Random(cases.SEED))
        cases.write(self.at / 'in.bin', self.rows)

    def complete(self, ranks):
        """--restart finishes, and the union is right."""
        done = tiles(ranks, 'delaunay', self.file, '-o', self.out, '--restart')
        want, status = cases.expected(DYADEL, self.rows)
        self.assertEqual(done.returncode, status, done.stderr)
        joined = subprocess.run([TILES, 'to-csv', '--comments', self.out, '-o', str(self.at / 'all.csv')], capture_output=True)
        self.assertEqual(joined.returncode, 0, joined.stderr)
        self.assertTrue((self.at / 'all.csv').read_bytes() == want)

    def test_missing_part(self):
        """Only missing parts are computed again; parts of another job count as missing."""
        self.assertEqual(tiles(4, 'delaunay', self.file, '-o', self.out).returncode, 0)
        parts = cases.parts_of(self.out)
        before = {p: p.stat().st_mtime_ns for p in parts}
        parts[2].unlink()
        (self.at / 'out' / 'manifest.json').unlink()
        joined = subprocess.run([TILES, 'to-csv', '--comments', self.out], capture_output=True, text=True)
        self.assertEqual(joined.returncode, 1)
        self.assertIn('--restart', joined.stderr)
        self.complete(4)
        self.assertEqual({p for p in parts if p.stat().st_mtime_ns != before[p]}, {parts[2]})
        parts[1].write_bytes(parts[1].read_bytes()[:-20])
        self.rows[0] = (0.123, 0.456)
        cases.write(self.at / 'in.bin', self.rows)
        self.complete(4)
        self.complete(3)

    def test_flipped_bits(self):
        """One bit of a part or of the manifest is another one: to-csv says so, or the csv is the same; --restart mends it."""
        cases.write(self.at / 'in.bin', cases.repeated(300, random.Random(cases.SEED)))
        self.assertEqual(tiles(3, 'delaunay', self.file, '-o', self.out).returncode, 0)
        want = subprocess.run([TILES, 'to-csv', '--comments', self.out], capture_output=True).stdout
        r = random.Random(cases.SEED)
        for path in (*cases.parts_of(self.out), self.at / 'out' / 'manifest.json'):
            whole = path.read_bytes()
            for _ in range(40):
                bit = r.randrange(8 * len(whole))
                flipped = bytearray(whole)
                flipped[bit // 8] ^= 1 << bit % 8
                path.write_bytes(flipped)
                joined = subprocess.run([TILES, 'to-csv', '--comments', self.out], capture_output=True)
                if path.name.startswith('part') or joined.returncode or joined.stdout != want:
                    self.assertEqual((joined.returncode, joined.stdout), (1, b''), f'{path.name} bit {bit}')
                    self.assertIn(b'--restart', joined.stderr)
            self.assertIn(tiles(3, 'delaunay', self.file, '-o', self.out, '--restart').returncode, (0, 3))
            self.assertEqual(path.read_bytes(), whole)
            self.assertEqual(subprocess.run([TILES, 'to-csv', '--comments', self.out], capture_output=True).stdout, want)

    def test_changed_input(self):
        """Two points of one rank change places: parts of its neighbours name them, and are not of the same job any more."""
        self.assertEqual(tiles(4, 'delaunay', self.file, '-o', self.out).returncode, 0)
        cut = cases.parts_of(self.out)[1]
        cut.write_bytes(cut.read_bytes()[:-20])
        self.complete(4)
        records = [cases.records_of(part)[0] for part in cases.parts_of(self.out)]
        own = {i for i, _, _ in records[0]}
        one, two = sorted({j for _, j, _ in records[1] + records[2] if j in own})[:2]
        self.rows[one], self.rows[two] = self.rows[two], self.rows[one]
        cases.write(self.at / 'in.bin', self.rows)
        self.complete(4)

    def test_found_parts(self):
        """What the manifest says does not depend on which parts were there; a cap is another job."""
        cases.write(self.at / 'in.bin', cases.line(300, random.Random(1)))
        name = ('delaunay', self.file, '-o', self.out)
        for words, status in ((('--max-pairs', '10'), 3), ((), 3)):
            told = []
            for restart in ((), ('--restart',)):
                again = (*words, '--restart') if words == () else (*words, *restart)
                self.assertEqual(tiles(2, *name, *again).returncode, status)
                told.append((self.at / 'out' / 'manifest.json').read_text())
            self.assertEqual(*told)

    def test_killed(self):
        """One rank is killed at any moment."""
        for wait in (0.05, 0.3, 0.6):
            job = subprocess.Popen(command(3, 'delaunay', self.file, '-o', self.out), stdout=subprocess.DEVNULL,
                                   stderr=subprocess.PIPE, text=True)
            time.sleep(wait)
            found = subprocess.run(['ps', '-o', 'pid=', '--ppid', str(job.pid)], capture_output=True, text=True).stdout.split()
            victim = int(found[1]) if MPIRUN and len(found) > 1 else job.pid
            try:
                os.kill(victim, signal.SIGKILL)
            except ProcessLookupError:
                pass
            told = job.communicate(timeout=100)[1]
            if job.returncode != 0 and MPIRUN and len(found) > 1:
                self.assertIn('signal 9', told)
            if (self.at / 'out' / 'manifest.json').exists():  # it was killed after its work
                self.assertEqual(subprocess.run([TILES, 'to-csv', '--comments', self.out], stdout=subprocess.DEVNULL).returncode, 0)
            self.complete(3)
            shutil.rmtree(self.out)

    def test_full_disk(self):
        done = tiles(3, 'delaunay', self.file, '-o', self.out, before=['sh', '-c', SMALL_DISK])
        self.assertEqual(done.returncode, 1)
        self.assertIn('cannot write', done.stderr)
        self.assertIn('--restart', done.stderr)
        self.assertFalse((self.at / 'out' / 'manifest.json').exists())
        self.complete(3)

    def refused(self, status, text, *words):
        done = tiles(3, *words)
        self.assertEqual(done.returncode, status, done.stderr)
        self.assertIn(text, done.stderr)
        self.assertFalse((self.at / 'out' / 'manifest.json').exists())

    def test_bad_input(self):
        name = ('delaunay', self.file, '-o', self.out)
        body = bytearray((self.at / 'in.bin').read_bytes())
        body[16 * 12345 + 8:16 * 12345 + 16] = struct.pack('<d', float('nan'))
        (self.at / 'in.bin').write_bytes(body)
        self.refused(1, f'{self.file}: point 12345 (byte {16 * 12345 + 8}): not a finite number', *name)
        cases.write(self.at / 'in.bin', [(0.0, 1.0, 3.0, 2.0)])
        self.refused(1, 'point 0 (byte 0): the lower end is above the upper one', *name, '--boxes')
        (self.at / 'in.bin').write_bytes(b'1 2\n3 4\n')
        self.refused(1, '8 bytes are no whole number of points of 16 bytes', *name)
        (self.at / 'in.bin').unlink()
        self.refused(1, 'No such file', *name)
        self.refused(1, 'not a file', 'delaunay', str(self.at), '-o', self.out)

    @unittest.skipUnless(UNREADABLE.is_file(), f'there is no {UNREADABLE}')
    def test_hostile(self):
        """Bytes of strangers, changed at random: a job ends by itself, with what one process says of the same file, and without a
        manifest where it fails."""
        rand, tried = random.Random(cases.SEED), 0
        text = b'x,y\n' + b''.join(b'%d,%d\n' % (k * k % 97, 7 * k % 89) for k in range(60))
        odd = [float('nan'), float('inf'), -float('inf'), 1e308, -1e308, 5e-324, -0.0]
        whole = struct.pack('<120d', *(rand.random() for _ in range(120)))
        for turn in range(12 * int(os.environ.get('DYADEL_TEST_SCALE', '1'))):
            name, data, boxes = ('h.csv', bytearray(text), ()) if turn % 2 else ('h.bin', bytearray(whole), ('--boxes',) * (turn % 4 == 0))
            for _ in range(rand.randint(1, 4)):
                at = rand.randrange(len(data))
                if name == 'h.bin' and rand.random() < 0.5:
                    data[at // 8 * 8:at // 8 * 8 + 8] = struct.pack('<d', rand.choice(odd))
                else:
                    data[at:at + rand.randint(0, 9)] = bytes(rand.choice([rand.randrange(256), 10, 0, 44, 57]) for _ in range(rand.randint(0, 9)))
            (self.at / name).write_bytes(data)
            shutil.rmtree(self.out, ignore_errors=True)
            done = tiles(3, 'delaunay', *boxes, str(self.at / name), '-o', self.out)
            alone = subprocess.run([TILES, 'delaunay', *boxes, str(self.at / name), '-o', str(self.at / f'alone{turn}'), '--tiles', '1'],
                                   capture_output=True, text=True, timeout=600)
            tried += 1
            self.assertEqual(done.returncode, alone.returncode, (bytes(data), done.stderr, alone.stderr))
            self.assertIn(done.returncode, (0, 1, 2, 3, 4))
            self.assertEqual(os.path.exists(self.out + '/manifest.json'), done.returncode in (0, 3, 4))
            if done.returncode in (1, 2):
                self.assertTrue(any(line.startswith('dyadel-tiles: ') and len(line) > 30 for line in done.stderr.splitlines()), done.stderr)
                said = next(line for line in alone.stderr.splitlines() if line.startswith('dyadel-tiles: '))
                self.assertIn(said, done.stderr)
            else:
                joined = [subprocess.run([TILES, 'to-csv', folder], capture_output=True).stdout for folder in (self.out, str(self.at / f'alone{turn}'))]
                self.assertEqual(*joined)
        self.assertGreaterEqual(tried, 12)

    def test_unreadable_slice(self):
        """A file that ends before its size: the rank that meets the end reports which points, and all end."""
        self.refused(1, f'{UNREADABLE}: cannot read points ', 'delaunay', str(UNREADABLE), '-o', self.out)

    def test_words(self):
        self.refused(2, 'unknown option', 'delaunay', self.file, '-o', self.out, '--box')
        self.refused(2, "the command is 'delaunay' or 'to-csv'", 'voronoi', self.file)
        self.refused(2, 'give it with -o', 'delaunay', self.file)
        self.refused(2, 'needs a number', 'delaunay', self.file, '-o', self.out, '--max-pairs', '0')
        told = subprocess.run([TILES, '--help'], capture_output=True, text=True).stdout
        for word in ('--boxes', '--tiles', '--restart', '--max-pairs', '--accept-fixpoint', '--stats'):
            self.assertIn(word, told)
        self.assertIn('0.', subprocess.run([TILES, '--version'], capture_output=True, text=True).stdout)

    def test_options(self):
        """A cap on pairs ends in outcome budget; ties, which it does not count, in fixpoint, which may be accepted."""
        cases.write(self.at / 'in.bin', [(k, k + 30, k, k + 30) for k in range(20)])
        done = tiles(2, 'delaunay', self.file, '--boxes', '-o', self.out, '--max-pairs', '10')
        self.assertEqual(done.returncode, 4, done.stderr)
        self.assertIn('"outcome":"budget"', (self.at / 'out' / 'manifest.json').read_text())
        cases.write(self.at / 'in.bin', cases.line(300, random.Random(1)))
        for words, status, outcome in ((('--max-pairs', '10'), 3, 'fixpoint'), ((), 3, 'fixpoint'),
                                       (('--accept-fixpoint', '--stats'), 0, 'fixpoint')):
            done = tiles(2, 'delaunay', self.file, '-o', self.out, *words)
            self.assertEqual(done.returncode, status, done.stderr)
            self.assertIn(f'"outcome":"{outcome}"', (self.at / 'out' / 'manifest.json').read_text())
        self.assertIn('ghosts', done.stderr)


if __name__ == '__main__':
    unittest.main(argv=sys.argv[:1], verbosity=2)
