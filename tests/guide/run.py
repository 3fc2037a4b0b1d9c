#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Runs the commands of a guide and compares what they print: run.py COMMAND GUIDE... [--renew]

A block ```console has lines "$ COMMAND", each followed by its output, standard output first; further lines of a command begin
with "> ", or follow a backslash. A line "..." means any lines, at the end of a line any text; a command "$ echo $?" prints the exit
status of the one before. A block ```python runs in one session for the guide; ```c is compiled against the library (environment: GUIDE_CC) and has to run. A block ```text after one of these two is what
it prints. A block of none of these is not run. Commands run in a folder with a copy of tests/data and tests/programs; a
picture that they write and that stands beside the guide has to be the same (--renew: it is copied there)."""
import contextlib
import io
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
BLOCK = re.compile(r'^```(\w+)\n(.*?)^```$', re.M | re.S)


def agrees(printed, stated):
    """The same lines, where "..." is any number of them."""
    if stated and stated[0] == '...':
        return any(agrees(printed[k:], stated[1:]) for k in range(len(printed) + 1))
    if not stated or not printed:
        return not stated and not printed
    said = stated[0].rstrip()
    same = printed[0].startswith(said[:-3]) if said.endswith('...') else printed[0].rstrip() == said
    return same and agrees(printed[1:], stated[1:])


class Guide:
    def __init__(self, path, command, folder):
        self.path, self.folder, self.status, self.names, self.faults = path, folder, 0, {}, []
        self.env = {**os.environ, 'PATH': f'{pathlib.Path(command).resolve().parent}:{pathlib.Path(sys.executable).parent}:{os.environ["PATH"]}', 'LC_ALL': 'C.UTF-8'}

    def compare(self, what, printed, stated):
        if not agrees(printed.splitlines(), stated.splitlines()):
            self.faults.append(f'{self.path.name}: {what}\nprints\n{printed}\nand not\n{stated}')

    def shell(self, command):
        if command == 'echo $?':
            return f'{self.status}\n'
        done = subprocess.run(['bash', '-c', command], cwd=self.folder, env=self.env, capture_output=True, text=True, check=False, timeout=120)
        self.status = done.returncode
        return done.stdout + done.stderr

    def console(self, text):
        for part in re.split(r'^\$ ', text, flags=re.M)[1:]:
            command, _, stated = part.partition('\n')
            while command.endswith('\\') or stated.startswith('>'):
                more, _, stated = stated.partition('\n')
                command = command[:-1] + more if command.endswith('\\') else f'{command}\n{more[2:]}'
            self.compare('$ ' + command, self.shell(command), stated)

    def python(self, text):
        printed, here = io.StringIO(), os.getcwd()
        os.chdir(self.folder)
        try:
            with contextlib.redirect_stdout(printed):
                exec(compile(text, str(self.path), 'exec'), self.names)  # pylint: disable=exec-used
        finally:
            os.chdir(here)
        return printed.getvalue()

    def compiled(self, text):
        (self.folder / 'example.c').write_text(text, encoding='utf-8')
        return self.shell(os.environ['GUIDE_CC'] + ' -Wall -Wextra -Werror example.c $GUIDE_LIBS -o example && ./example')

    def run(self):
        printed = None
        for kind, text in BLOCK.findall(self.path.read_text(encoding='utf-8')):
            if kind == 'console':
                self.console(text)
            elif kind in ('python', 'c'):
                printed = self.python(text) if kind == 'python' else self.compiled(text)
            elif kind == 'text' and printed is not None:
                self.compare('the example', printed, text)
                printed = None

    def pictures(self, renew):
        for name in re.findall(r'\]\((\w+\.svg)\)', self.path.read_text(encoding='utf-8')):
            made, kept = self.folder / name, self.path.parent / name
            if not made.exists():
                self.faults.append(f'{self.path.name}: no command writes {name}')
            elif renew:
                shutil.copy(made, kept)
            elif not kept.exists() or made.read_bytes() != kept.read_bytes():
                self.faults.append(f'{self.path.name}: {name} is out of date')


def main():
    assert agrees(['a', 'b', 'c'], ['a', '...', 'c']) and agrees([], ['...']) and not agrees(['a', 'b'], ['a']) and not agrees(['a'], ['b']) and agrees(['ab'], ['a...'])
    renew = '--renew' in sys.argv
    command, *guides = [a for a in sys.argv[1:] if a != '--renew']
    faults = []
    for path in map(pathlib.Path, guides):
        with tempfile.TemporaryDirectory(prefix='guide-') as name:
            folder = pathlib.Path(name)
            for kind in ('data', 'programs'):
                for file in (HERE.parent / kind).iterdir():
                    shutil.copy(file, folder)
            guide = Guide(path, command, folder)
            guide.run()
            guide.pictures(renew)
            faults += guide.faults
    print(*faults, sep='\n\n')
    sys.exit(bool(faults))


if __name__ == '__main__':
    main()
