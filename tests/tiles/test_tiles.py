#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""dyadel-tiles against one process: the union of the parts is the same, byte for byte [REACH-1] [TILE-1].

Usage: test_tiles.py TILES DYADEL [MPIRUN]   (MPIRUN: ranks are processes; else one process is all of them)
"""
import math
import pathlib
import random
import subprocess
import sys
import tempfile
import unittest

import tiles_cases as cases

TILES, DYADEL = sys.argv[1:3]
MPIRUN = sys.argv[3:4]
# Processes only carry messages: their contents are tested in one process, and with several at a larger scale.
RANKS = (3,) if MPIRUN and cases.SCALE == 1 else (1, 2, 4, 9)


def command(ranks, *words):
    if MPIRUN:
        return [*MPIRUN, '--oversubscribe', '--allow-run-as-root', '-n', str(ranks), TILES, 'delaunay', *words]
    return [TILES, 'delaunay', *words, '--tiles', str(ranks)]


class Union(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.at = pathlib.Path(self.folder.name)
        self.random = random.Random(cases.SEED)
        self.addCleanup(self.folder.cleanup)

    def run_tiles(self, ranks, *words):
        return subprocess.run(command(ranks, *words), capture_output=True, text=True, timeout=1200)

    def compare(self, rows, ranks=RANKS, more=()):
        file, want = self.at / 'in.bin', cases.expected(DYADEL, rows)
        cases.write(file, rows)
        more = [*more, *(['--boxes'] if rows and len(rows[0]) == 4 else [])]
        for count in ranks:
            out = self.at / f'out{count}'
            done = self.run_tiles(count, str(file), '-o', str(out), *more)
            self.assertEqual(done.returncode, want[1], done.stderr)
            joined = subprocess.run([TILES, 'to-csv', '--comments', str(out)], capture_output=True)
            self.assertEqual((joined.returncode, joined.stderr), (0, b''))
            self.assertTrue(joined.stdout == want[0], f'{count} ranks differ')
            self.check_parts(out, count, len(rows))
        return out

    def check_parts(self, out, ranks, points):
        parts, own, seen = cases.parts_of(out), 0, set()
        self.assertEqual(len(parts), ranks)
        for rank, part in enumerate(parts):
            header, (pairs, aliases) = cases.header_of(part), cases.records_of(part)
            self.assertEqual(header['rank'], rank)
            self.assertEqual([r[:2] for r in pairs], sorted({r[:2] for r in pairs}))
            self.assertTrue(all(i < j and status in (1, 2, 3) for i, j, status in pairs))
            self.assertTrue(all(i > j and status == 0 for i, j, status in aliases))
            own += header['own']
            self.assertFalse(seen & {r[0] for r in pairs})
            seen |= {r[0] for r in pairs}
        self.assertEqual(own, points)

    def test_uniform(self):
        """Ghosts grow as borders do: of 250,000 own points they are 4 % at most."""
        self.compare(cases.uniform(10 ** 5 if cases.SCALE == 1 else 10 ** 6, self.random))
        for count in RANKS:
            for header in map(cases.header_of, cases.parts_of(self.at / f'out{count}')):
                self.assertLessEqual(header['ghosts'], 0.04 * math.sqrt(250000 * header['own']))

    def test_clusters(self):
        self.compare(cases.clusters(30000 if cases.SCALE == 1 else 400000, self.random))

    def test_ring_and_square(self):
        self.compare(cases.ring_and_square(20000 * cases.SCALE, self.random))

    def test_circle(self):
        self.compare(cases.circle(2000, self.random))

    def test_grid(self):
        self.compare(cases.grid(10000 if cases.SCALE == 1 else 100000, self.random))

    def test_line(self):
        self.compare(cases.line(300, self.random))

    def test_parabola(self):
        """Discs of 10^6 distances with exact points on their rims; half-planes."""
        for height in (2.0 ** -20, 2.0 ** -30):
            self.compare(cases.parabola(80, self.random, height), RANKS[:2])

    def test_equal(self):
        self.compare(cases.equal(5000, self.random))

    def test_repeated(self):
        self.compare(cases.repeated(5000, self.random))

    def test_boxes(self):
        self.compare(cases.boxes(3000 * cases.SCALE, self.random))

    def test_small_boxes(self):
        self.compare(cases.boxes(20000 * cases.SCALE, self.random, 1e-6))

    @unittest.skipIf(MPIRUN, 'the same in one process')
    def test_boxes_send_little(self):
        """Cells along the hull end far out, and it is known at whose boxes: no rank requests the whole plane."""
        parts = cases.parts_of(self.compare(cases.boxes(20000, self.random), (4,)))
        for header in map(cases.header_of, parts):
            self.assertLess(header['ghosts'], 0.2 * header['own'])
            self.assertLess(header['rounds'], 8)

    def test_long_boxes(self):
        self.compare(cases.long_boxes(500, self.random), (2, 4))

    @unittest.skipIf(MPIRUN, 'the same in one process')
    def test_hidden_witness(self):
        """The possible pairs of one end do not show a witness; where the other end is a ghost, no rank's pairs do."""
        for n, cut in ((4000, 2.85), (90, 1.4)):
            rows = cases.hidden_witness(n, self.random, cut)
            others = [row for row in rows if row[0] != cases.HIDDEN[0]]
            without, both = (cases.expected(DYADEL, some)[0].splitlines() for some in (others, rows))
            self.assertTrue(b'0,1,legal' in without and b'0,1,indeterminate' in both)
            self.compare(rows, (2,))
            self.compare([rows[1], rows[0], *rows[2:]], (2,))

    def test_mixed(self):
        """Ties of exact points, of faces that may reach over a border and touch a rectangle."""
        self.compare(cases.mixed(1000, self.random))

    def test_few_points(self):
        for count in (0, 2, 5) if MPIRUN else range(7):
            for rows in (cases.uniform(count, self.random), cases.grid(count, self.random), cases.line(count, self.random),
                         cases.boxes(count, self.random, 0.2)):
                self.compare(rows, (3,) if MPIRUN else (1, 2, 3, 9))

    def test_small_grids(self):
        """All pairs tie, and every site is at a border."""
        for _ in range(3 if MPIRUN else 30 * cases.SCALE):
            places = [(float(self.random.randrange(5)), float(self.random.randrange(5))) for _ in range(30)]
            halves = [self.random.choice([0, 0, 0.25, 0.5, 1]) for _ in places]
            self.compare(places, (4,))
            self.compare([(x - h, x + h, y - h, y + h) for (x, y), h in zip(places, halves)], (4,))

    def one_process(self, name):
        done = subprocess.run([DYADEL, 'delaunay', str(self.at / name), '-q', '--comments'], capture_output=True)
        self.assertIn(done.returncode, (0, 3))
        return done.stdout

    def test_text(self):
        """Decimals, with ties, are exact; the longest ones are between doubles, and decided all the same."""
        r, some = self.random, 2000 * cases.SCALE
        short = [f'{r.randrange(300) / 10} {r.randrange(-200, 100) / 10:+}' for _ in range(some)]
        forms = [f'{m}e-{k} {r.choice(["", "+", "-"])}0{r.randrange(40)}.{r.randrange(10)}0E1' for k in range(4) for m in range(some // 16)]
        for rows in (short, forms, [f'{r.random()!r} {r.random()!r}' for _ in range(some)], short[:3], short[:1], []):
            (self.at / 'in.txt').write_text('\n'.join(rows))
            (self.at / 'in.csv').write_text('x,y\n' + ''.join(f'{row.replace(" ", ",")}\n# a remark\n\n' for row in rows))
            want = self.one_process('in.txt')
            for name in ('in.txt', 'in.csv'):
                for count in RANKS:
                    out = self.at / f'out{name}{count}'
                    done = self.run_tiles(count, str(self.at / name), '-o', str(out), '--accept-fixpoint')
                    self.assertEqual(done.returncode, 0, done.stderr)
                    joined = subprocess.run([TILES, 'to-csv', '--comments', str(out)], capture_output=True)
                    self.assertTrue(joined.stdout == want, f'{name} of {len(rows)}: {count} ranks differ')
                    self.check_parts(out, count, len(rows))

    def test_text_with_a_mark(self):
        """A byte order mark does not belong to the first point; names may follow it."""
        rows = '0 0\n3 1\n1 4\n2 2\n'
        (self.at / 'in.txt').write_text(rows)
        for k, text in enumerate(('\ufeff' + rows, '\ufeff"lon";"lat"\n' + rows, rows.replace('\n', '\r\n'), rows[:-1], '% of today\n' + rows, rows.replace('\n', '\r'))):
            (self.at / 'marked.txt').write_bytes(text.encode())
            for count in RANKS:
                out = self.at / f'out{k}of{count}'
                self.run_tiles(count, str(self.at / 'marked.txt'), '-o', str(out))
                joined = subprocess.run([TILES, 'to-csv', '--comments', str(out)], capture_output=True)
                self.assertEqual(joined.stdout, self.one_process('in.txt'))

    def test_text_of_boxes(self):
        ends = [(x := self.random.randrange(1000), x + self.random.randrange(3), y := self.random.randrange(1000),
                 y + self.random.randrange(3)) for _ in range(500)]
        (self.at / 'boxes.csv').write_text(''.join(','.join(f'{e / 100}' for e in row) + '\n' for row in ends))
        (self.at / 'in.txt').write_text(''.join('[{},{}] [{},{}]\n'.format(*(e / 100 for e in row)) for row in ends))
        self.run_tiles(4, str(self.at / 'boxes.csv'), '-o', str(self.at / 'out'), '--boxes')
        joined = subprocess.run([TILES, 'to-csv', '--comments', str(self.at / 'out')], capture_output=True)
        self.assertTrue(joined.stdout == self.one_process('in.txt'))

    def test_wrong_text(self):
        """File, line and column are named, whichever rank finds it."""
        fine = '0.5 1\n' * 300
        for line, column, words in (('1 2 3', 5, 'as a point has'), ('1', 2, 'as a point has'), ('1 sqrt(2)', 3, 'decimal'),
                                    ('1 0x1p3', 3, 'decimal'), ('. 1', 1, 'decimal'), ('1 2e', 3, 'decimal'),
                                    ('1e400 2', 1, 'beyond doubles'), ('1 2\0', 4, 'NUL byte'), ('x y', 1, 'decimal'),
                                    ('1 ' + '2' * (1 << 20), 1, 'longer than 1048576 bytes')):
            (self.at / 'in.txt').write_text(f'{fine}{line}\n{fine}')
            done = self.run_tiles(4, str(self.at / 'in.txt'), '-o', str(self.at / 'out'))
            self.assertEqual(done.returncode, 1, line)
            self.assertIn(f'in.txt:301:{column}: ', done.stderr)
            self.assertIn(words, done.stderr)
            self.assertFalse((self.at / 'out/manifest.json').exists())
        # A word that does not name a column is not skipped in the first line either.
        for line, column in (('nan 0', 1), ('[0,1] 0', 7), ('0 nan', 3), ('x 0', 1), ('NaN NA', 1), ('pi e', 1), ('sqrt(2) 1', 1)):
            (self.at / 'in.csv').write_text(f'# points\n{line}\n{fine}')
            done = self.run_tiles(2, str(self.at / 'in.csv'), '-o', str(self.at / 'out'))
            self.assertEqual(done.returncode, 1, line)
            self.assertRegex(done.stderr, f'in.csv:2:{column}: (not a decimal number|not as many)')
        (self.at / 'in.txt').write_text('0 1 1 2\n3 2 1 1\n')
        done = self.run_tiles(1, str(self.at / 'in.txt'), '-o', str(self.at / 'out'), '--boxes')
        self.assertIn('in.txt:2:1: the lower end is above the upper one', done.stderr)


if __name__ == '__main__':
    unittest.main(argv=sys.argv[:1], verbosity=2)
