# SPDX-License-Identifier: LGPL-3.0-or-later
"""One command run again and again, each time with another fault (shim.c), and the conditions that must hold all the
same.

Whatever fails: the command ends without a signal, with the status that it has without the fault or with 1 and a
message; an output is the same as without the fault, or as before the run; nothing else is in the folder.
"""
import concurrent.futures
import errno
import os
import re
import subprocess
import tempfile

OLD = b'what was there before\n'


class Case:
    """A command line; inputs and outputs are names in its folder. loose: outputs may differ (pictures, other fonts)."""

    def __init__(self, *args, inputs=None, outputs=(), loose=False, stdin=b''):
        self.args, self.inputs, self.outputs, self.loose, self.stdin = args, inputs or {}, outputs, loose, stdin
        self.references = {}  # by what may fail

    def __str__(self):
        return ' '.join(self.args)


class Folder(tempfile.TemporaryDirectory):
    def __init__(self, case):
        super().__init__()
        self.case = case
        for name, text in case.inputs.items():
            self.put(name, text)
        for name in case.outputs:
            self.put(name, OLD)

    def __enter__(self):
        super().__enter__()
        return self

    def put(self, name, text):
        with open(os.path.join(self.name, name), 'wb') as out:
            out.write(text)

    def get(self):
        """The files that are not inputs."""
        files = {}
        for name in os.listdir(self.name):
            if name not in self.case.inputs:
                with open(os.path.join(self.name, name), 'rb') as f:
                    files[name] = f.read()
        return files


class Sweep:
    """Of one command, one kind of fault (FAULT_... of shim.c). may_die: a signal may end the process, as the fault hits code
    that is not ours and that does not look; files are judged all the same."""

    def __init__(self, command, shim, case, call, inside=None, on=False, error=errno.EIO, may_die=False):
        self.command, self.shim, self.case, self.may_die = command, shim, case, may_die
        self.env = {'FAULT_CALL': call, 'FAULT_ERRNO': str(error)}
        if inside:
            self.env['FAULT_IN'] = inside
        if on:
            self.env['FAULT_ON'] = '1'
        self.name = f'{call}{" in " + inside if inside else ""}{" and all that follow" if on else ""}: {case}'

    def run(self, at, count=None):
        env = dict(os.environ, LD_PRELOAD=self.shim, FAULT_AT=str(at), **self.env)
        if count:
            env['FAULT_COUNT'] = count
        with Folder(self.case) as folder:
            done = subprocess.run([self.command, *self.case.args], input=self.case.stdin, stdout=subprocess.PIPE,
                                  stderr=subprocess.PIPE, cwd=folder.name, env=env, timeout=100, check=False)
            return done, folder.get()

    def reference(self):
        """A run without a fault, and the number of calls: the same whether those that follow fail, too."""
        key = self.env['FAULT_CALL'], self.env.get('FAULT_IN')
        if key not in self.case.references:
            with tempfile.NamedTemporaryFile('r') as count:
                done, files = self.run(0, count.name)
                self.case.references[key] = done, files, int(count.read() or 0)
        return self.case.references[key]

    def judge(self, at, reference, files_before):
        """Returns the problem of the run, or None."""
        try:
            done, files = self.run(at)
        except subprocess.TimeoutExpired:
            return 'hangs'
        err = done.stderr.decode(errors='replace')
        died = self.may_die and done.returncode < 0
        if not died and done.returncode not in (reference.returncode, 1):
            return f'ends with {done.returncode}, not {reference.returncode} or 1: {err[-300:]}'
        failed = died or (done.returncode == 1 and reference.returncode != 1)
        if failed and not died and not re.search('^dyadel: ', err, re.M):
            return f'fails without a message: {err[-300:]!r}'
        if re.search(r'^dyadel:(.*:)?\s*$', err, re.M):
            return f'an empty message: {err[-300:]!r}'
        if not failed and not self.case.loose and done.stdout != reference.stdout:
            return f'succeeds with another output: {err[-300:]!r}'
        if set(files) - set(files_before):
            return f'leaves {sorted(set(files) - set(files_before))} behind: {err[-300:]!r}'
        for name in self.case.outputs:
            kept = failed and files.get(name) == OLD
            # Results known when a later stage failed are accepted if the message says so.
            part = self.case.loose or (failed and 'this much was known before' in err)
            if not kept and not (part and files.get(name)) and files.get(name) != files_before[name]:
                return f'{name} is neither what it was nor what it is to be: {err[-300:]!r}'
        return None

    def check(self, most, workers=2):
        """Runs at most `most` faults; returns their number, and a list of problems."""
        reference, files, count = self.reference()
        assert reference.returncode in (0, 3), (self.name, reference)
        assert count or self.env.get('FAULT_IN') != 'libdyadel', f'{self.name}: the shim sees nothing'
        step = max(1, (count - most // 2) // max(1, most - most // 2))
        places = sorted({*range(1, min(count, most // 2) + 1), *range(most // 2 + 1, count + 1, step), count} - {0})
        with concurrent.futures.ThreadPoolExecutor(workers) as pool:
            verdicts = list(pool.map(lambda at: self.judge(at, reference, files), places))
        return len(places), [f'{self.name}: fault {at} of {count} {v}' for at, v in zip(places, verdicts) if v]
