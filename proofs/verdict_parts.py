# SPDX-License-Identifier: LGPL-3.0-or-later
"""Certificates for verdicts.py beyond points and boxes of the plane: discs, their cells, graphs, places of queries, a
sphere. Sets, changes and oracles are those of tests/checker/test_parts.py and test_globe.py."""
import importlib.util
import pathlib
import re
import sys
import tempfile


def module(root, name, *args):
    """A test as a module; its arguments are those of a command."""
    spec = importlib.util.spec_from_file_location(name, root / f'tests/checker/{name}.py')
    made, before = importlib.util.module_from_spec(spec), sys.argv
    sys.argv = [name, *map(str, args)]
    try:
        spec.loader.exec_module(made)
    finally:
        sys.argv = before
    return made


CSV = ['--columns', 'x,y', '--radius-column', 'r']
PLANE = [['delaunay', '--discs'], ['delaunay', '--layer', 'graph:nearest'], ['delaunay', '--layer', 'graph:gabriel'],
         ['delaunay', '--layer', 'graph:mst'], ['nearest'], ['nearest', '--discs'], ['voronoi', '--discs']]
SPHERE = [['delaunay', '--sphere'], ['voronoi', '--sphere'], ['nearest', '--sphere']]


class Parts:
    def __init__(self, root, dyadel):
        self.parts = module(root, 'test_parts', dyadel)
        self.globe = module(root, 'test_globe', dyadel, '')
        self.commands = PLANE + SPHERE

    def certificate(self, rng, command):
        """One that is written: of places that may be anywhere none is."""
        while True:
            with tempfile.TemporaryDirectory() as name:
                folder = pathlib.Path(name)
                text = self.written(rng, command, folder)
                if text:
                    return text

    def written(self, rng, command, folder):
        queries, path = folder / 'queries', folder / 'certificate'
        if '--sphere' in command:
            places, options = self.globe.degrees(rng, rng.randrange(8)), rng.choice(self.globe.RADII)
            given = [*options, *self.globe.points_file(folder, rng, places, options)]
            asked = self.globe.asked_about(rng, places)
        else:
            (folder / 'points').write_text(self.parts.points_case(rng))
            given, asked = [*CSV, folder / 'points'], [(rng.randrange(-4, 20), f'{rng.randrange(20)}/3') for _ in range(3)]
        queries.write_text(''.join(f'{x} {y}\n' for x, y in asked))
        about = ['--queries', queries] if command[0] == 'nearest' else []
        done = self.globe.run(*command, *about, '-q', '-o', folder / 'out', '--certificate', path, *given)
        assert done.returncode in (0, 3, 4) or not path.exists(), done
        return path.read_text() if path.exists() else None

    def changed(self, rng, text):
        """The text with one change."""
        while True:
            if '\nsphere\n' in text:
                lines = text.splitlines()
                if '\nplaces 0\nneighbours' in text or '\nplaces 0\nnearest' in text:
                    lines[1] = 'outcome ' + rng.choice(['decided', 'fixpoint', 'certified'])
                elif '\nnearest ' in text:
                    lines = self.globe.forge_near(rng, lines)[1]
                else:
                    lines = self.globe.forge(rng, lines)[1]
                other = '\n'.join(lines) + '\n'
                if other != text or 'places 0' in text:
                    return other
            else:
                for other in self.parts.mutants(text, rng, 8):
                    return other

    def judge(self, rng, text, answer):
        """Returns a statement about discs, graphs, queries or places that verify took for proved and that is false."""
        gaps = ''.join(re.findall('not proved: .*', answer.stdout))
        if '\nsphere\n' not in text:
            return self.parts.judge(text, rng, 'without a row' not in gaps and 'do not list' not in gaps)
        lines = text.splitlines()
        if '\nnearest ' in text:
            return None if 'do not list them' in gaps else self.globe.false_near(rng, lines, 20)
        return None if re.search(self.globe.UNPROVED, gaps) else self.globe.outside(rng, lines, 60)
