#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Nothing overflows in src/dyadic and src/checker, no pointer goes astray: proved by Frama-C's WP and CVC4.

Usage: overflow.py ROOT [PART [FILE]]   (exit status 1: a goal is not proved, or a seeded fault is; 77: Frama-C, Why3 or
CVC4 is absent). PART: one of PARTS; without it, all. FILE: only this one of the part.

overflow/NAME.c has contracts for the functions of src/FOLDER/NAME.c and .h, and includes it; overflow/NAME.acsl has
the annotations of its loops: each paragraph is put before a text, where \\n means the end of a line; a line `copy
ITEM TO = FROM;`, that this assignment of a structure (TO: a type and a name, where it is declared there) is copy_ITEM,
whose parts WP knows.
overflow/gmp.h has the assumptions on GMP, overflow/math.h of the functions on doubles, other headers there
of the C library. Of each function WP proves its contract, the conditions of all that it calls, and that no operation
is undefined: signed overflow, memory that is not there, shifts, conversions of integers that lose something. An `admit`
is an assumption. Functions that are not proved are named in overflow/NAME.c, as well as goals that CVC4 does not
prove, or only where it has the machine for itself, with the reason:

    /* Without FUNCTION, FUNCTION: reason. */
    /* Unproved GOAL, GOAL: reason. */

NAME.acsl may have annotations of a function without a proof: an attempt.

All of it takes 25 minutes of a core. overflow/proved.txt has a digest for each file that was proved, of all texts that
its proof rests on; with PART alone, files with the same digest are not proved again, but for some functions of some,
which change with the digests. With FILE, or without PART, everything named is proved, and the digests are written.

Then faults of overflow/faults.txt are put in, one at a time in a function (faults.py): another goal of it has to fail,
and none that takes CVC4 long without the fault. All of them take as long as the proofs: of a part, only the first ones
of its first file are put in; of a FILE that is named, or without PART, all.
"""
import hashlib
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
from faults import faults, with_fault  # noqa: E402

PARTS = {  # tests of some minutes; those but the first are of what reads and keeps the bytes of others
    'numbers': ['dyadic', 'sqrt_sign', 'convert', 'exact'],
    'texts': ['alloc', 'text', 'poly', 'measure'], 'lines': ['read', 'checker', 'bounds', 'witness'],
    'lists': ['by_key', 'graph', 'sites', 'chain'],
    'sets': ['parts', 'faces', 'fixpoint', 'diagram', 'pairs', 'certificate'], 'trees': ['tree', 'boxes', 'distance'],
    'values': ['number', 'quotient', 'algebra_read', 'enclosure', 'inverse'],
    'blocks': ['algebra', 'algebra_enclose', 'algebra_bound', 'bracket', 'cycle', 'ties'],
}
UNWRITTEN = {'caps', 'discs', 'graphs', 'near', 'places'}  # of src/checker, not proved: contract not written yet
# About certificates on a sphere: of fractions of GMP, lists of enclosures, and a checker within one no header says enough.
LEFT_OUT = {'around', 'cocircular', 'globe', 'globe_near', 'globe_places', 'image', 'region', 'sphere'}
# Not proved again since they, or headers that they include, were changed: skipped where a PART is given.
OUTDATED = {'parts', 'checker', 'measure', 'fixpoint', 'faces', 'certificate', 'pairs', 'diagram'}
ITEMS = {'start': 'sizes', 'first': 'sizes', 'entry': 'entries', 'term': 'terms', 'digits': 'chars', 'den': 'numbers',
         'place': 'places', 'point': 'described', 'c': 'coefficients', 'cosine': 'cosines',
         'box': 'boxes'}  # of lists, by name
ZEROED = {'spare': 'sizes', 'covered': 'pair_counts', 'times': 'indices', 'stamp': 'stamps',
          'b': 'block'}  # others: flags
EXTRA = {'alloc': ['-warn-unsigned-overflow'], 'text': ['-wp-literals'], 'poly': ['-wp-literals', '-wp-prop=-owned'],
         'quotient': ['-wp-prop=-owned'],  # the property of this name in terms.h is not proved
         **{name: ['-wp-literals'] for name in ('checker', 'pairs', 'diagram', 'certificate')},
         'read': ['-wp-literals', '-no-warn-signed-downcast']}  # a byte becomes a char
OPTIONS = ['-wp', '-wp-rte', '-warn-special-float', 'none',  # doubles are another matter
           '-warn-signed-downcast', '-warn-unsigned-downcast', '-wp-prover', 'cvc4', '-wp-status-all',
           '-rte-no-pointer-call',  # that one of the functions after `calls` is called is proved; without it, other goals fail
           '-wp-no-pruning', '-wp-no-ground',  # a sixth of the time, and nothing more proved
           '-wp-par', '2']  # one after another, half of the time is waited
AGAIN, SHARE = 16, 4  # one in AGAIN files with a known proof is proved again: one in SHARE of its functions
SOON, MOST, FEW, SLOW = 20, 150, 4, 2  # seconds for a goal, for one left over, for one with a fault; of one that is slow
FUNCTION = re.compile(r'^(?!typedef|struct|[#/\s])[\w *]*?\b(\w+)\((?:[^;{}()]|\([^()]*\))*\)\s*\{', re.M)


def goals(root, name, work, options, until=lambda name: False):
    """(goals, names of unproved ones) of a file, and the output, which ends at a goal that is not proved
    and `until` holds of. Only the current folder comes before Frama-C's own headers. A goal that a fault does
    not change is proved once."""
    here = root / 'proofs' / 'overflow'
    where = ' '.join(f'-I{f}' for f in ['.', work, root / 'src', root / 'include'])
    output = ''
    call = ['frama-c', f'-cpp-extra-args={where}', *OPTIONS, *EXTRA.get(name, []), '-wp-cache', 'update',
            '-wp-cache-dir', str(work / 'proved'), *options, f'{name}.c']
    with subprocess.Popen(call, cwd=here, env={**os.environ, 'PWD': str(here)}, stdout=subprocess.PIPE,
                          start_new_session=True, stderr=subprocess.STDOUT, encoding='utf-8', errors='replace') as run:
        for line in run.stdout:
            output += line
            failed = re.search(r'Goal typed_(\w+) : (?!Valid)', line)
            if failed and until(failed[1]):
                os.killpg(run.pid, signal.SIGKILL)
                return 1, {failed[1]}, output
    sums = re.search(r'Proved goals: +(\d+) / (\d+)', output)
    open_goals = set(re.findall(r'Goal typed_(\w+) : (?!Valid)', output))
    if not sums or run.returncode or int(sums[2]) - int(sums[1]) != len(open_goals):
        return 0, {'all'}, output
    return int(sums[2]), open_goals, output


class Source:
    """A file of src, and its contracts in overflow; `again`, where its proof is known, a share of its functions."""

    def __init__(self, root, name, again=False):
        self.root, self.name = root, name
        self.path = next(path for path in (root / 'src' / folder / (name + end) for folder, end in
                                           (('checker', '.c'), ('dyadic', '.c'), ('base', '.h'))) if path.exists())
        self.contracts = (root / 'proofs' / 'overflow' / f'{name}.c').read_text(encoding='utf-8')
        left_out = self.named('Without')
        self.functions = [f for path in {self.path, self.path.with_suffix('.h')} if path.exists()
                          for f in FUNCTION.findall(path.read_text(encoding='utf-8'))]
        for name in set(left_out) - set(self.functions):
            sys.exit(f'overflow/{self.name}.c: there is no function {name}')
        self.proved = sorted(set(self.functions) - set(left_out))
        if again:
            turn, faulty = int(digest(root, self.name), 16) // AGAIN, [f for f, _, _ in faults_of(root, self.name) if f in self.proved]
            self.proved = sorted({*self.proved[turn % SHARE::SHARE], *faulty[turn % max(1, len(faulty)):][:1]})

    def named(self, what):
        """{name: reason} of the comments of contracts."""
        found = re.findall(r'^/\* ' + what + r' ([\w,\s]+): (.+?)\.\s+\*/$', self.contracts, re.M | re.S)
        return {name: reason for names, reason in found for name in re.split(r',\s+', names)}

    def copy(self, work, change=lambda text: text):
        """A copy with loop annotations, and a fault, in a folder that comes before src."""
        folder = work / self.path.parent.name
        folder.mkdir(exist_ok=True)
        text = change(self.path.read_text(encoding='utf-8'))
        (folder / f'{self.name}.c').write_text(with_loops(self.root, self.name, text), encoding='utf-8')
        header = self.path.with_suffix('.h')
        if (self.root / 'proofs' / 'overflow' / f'{header.name}.acsl').exists():
            text = with_loops(self.root, header.name, header.read_text(encoding='utf-8'))
            (folder / header.name).write_text(text, encoding='utf-8')
        return folder


def with_loops(root, name, text):
    """The text with the annotations of its loops, in the terms of overflow/lists.h."""
    path = root / 'proofs' / 'overflow' / f'{name}.acsl'
    said = path.read_text(encoding='utf-8') if path.exists() else ''
    for what, by in re.findall(r'^before (.*)\n((?:.+\n)+)', said, re.M):
        what = what.replace('\\n', '\n')
        text = replace(path, text, what, by + what)
    text = re.sub(r'dyd_reserve\(\(void \*\*\)&([cf])->(blocker|point|member|start|shape),',
                  r'reserve_\2s(&\1->\2,', text)
    text = text.replace('(void **)', '')
    text = re.sub(r'\bmem(cpy|set)\((?=[^,]*\be,)', r'mem\1_exponents(', text)
    for what, to, of in re.findall(r'^copy (\w+) (.*) = (.*);$', said, re.M):
        name = to.split()[-1]  # of `TYPE NAME`, which is declared before
        text = replace(path, text, f' {to} = {of};', f' {to};' * (to != name) + f' copy_{what}(&{name}, &{of});')
    text = re.sub(r'(\w+) = dyd_alloc\(', lambda m: f'{m[1]} = alloc_{ITEMS.get(m[1], "indices")}(', text)
    text = re.sub(r'(\w+) = calloc\(', lambda m: f'{m[1]} = zeroed_{ZEROED.get(m[1], "flags")}(', text)
    return re.sub(r'(\w+) = malloc\((?:(\d+) \* )?(sizeof [^()]*)\)',
                  lambda m: f'{m[1]} = alloc_{ITEMS[m[1]]}({m[2] or 1}, {m[3]})', text)


def replace(path, text, what, by):
    """The text with `by` instead of `what`, which must occur."""
    if what not in text:
        sys.exit(f'{path.name}: there is no {what!r}')
    return text.replace(what, by)


def read_by(root, name):
    """{path: text} of what Frama-C reads of a file: its contracts and all that they include but the system's headers."""
    folders = [root / 'proofs' / 'overflow', root / 'src', root / 'include']
    said, left = {}, [folders[0] / f'{name}.c']
    while left:
        path = left.pop()
        if path in said:
            continue
        text = path.read_text(encoding='utf-8')
        ours = path.is_relative_to(folders[0])
        said[path] = text if ours else with_loops(root, name if path.suffix == '.c' else path.name, text)
        for include in re.findall(r'^\s*#\s*include [<"]([^>"]+)[>"]', text, re.M):
            left += [folder / include for folder in folders if (folder / include).exists()][:1]
    return said


def digest(root, name):
    """Of all that the proof of a file rests on."""
    whole = hashlib.sha256(repr((OPTIONS, EXTRA.get(name))).encode())
    for path, text in sorted(read_by(root, name).items()):
        whole.update(f'\n{path.relative_to(root)} {len(text)}\n{text}'.encode())
    return whole.hexdigest()


def proved_before(root):
    """{file: digest} of overflow/proved.txt."""
    lines = (root / 'proofs' / 'overflow' / 'proved.txt').read_text(encoding='utf-8').split('\n')
    return dict(line.split() for line in lines if line and not line.startswith('#'))


def record(root, names):
    """Writes the digests of the proved files."""
    digests = {**proved_before(root), **{name: digest(root, name) for name in names}}
    (root / 'proofs' / 'overflow' / 'proved.txt').write_text(
        '# SPDX-License-Identifier: LGPL-3.0-or-later\n# What was proved: see ../overflow.py, which writes it.\n' +
        ''.join(f'{name} {digests[name]}\n' for name in sorted(digests)), encoding='utf-8')


def to_prove(root, names):
    """Names of files that changed since they were proved, and one in AGAIN of the others; the set of these others."""
    before, now = proved_before(root), {name: digest(root, name) for name in names}
    again = {name for name in names if before.get(name) == now[name] and int(now[name], 16) % AGAIN == 0}
    old = sorted(set(names) & OUTDATED)
    some = [name for name in names if (before.get(name) != now[name] or name in again) and name not in old]
    print('as when they were proved:', *sorted(set(names) - set(some) - set(old)), flush=True)
    if old:
        print('not proved again since they were changed:', *old, flush=True)
    return some, again


def try_file(root, work, name, again):
    """The names of goals that are slow or unproved for a reason; None when another is not proved."""
    source = Source(root, name, again)
    copy = source.copy(work)
    unproved, slow = set(source.named('Unproved')), set()
    for limit in SOON, MOST:  # the second time, unproved goals are tried again; the others are in the cache
        count, left, output = goals(root, name, work, ['-wp-timeout', str(limit), '-wp-fct', ','.join(source.proved)])
        slow |= {goal for goal, seconds in re.findall(r'Goal typed_(\w+) : Valid .*\(([0-9.]+)s\)', output)
                 if float(seconds) > SLOW}
        if left <= unproved:
            break
    shutil.rmtree(copy)
    print(f'{name}: {count - len(left)} of {count} goals proved,', len(source.proved), 'of', len(source.functions),
          'functions', *left and ['but', *sorted(left)], flush=True)
    if count and left <= unproved:
        return slow | unproved
    print(output)
    return None


def faults_of(root, name):
    """[(function, text, its replacement)] of a file."""
    return [(function, old, new) for function, path, old, new, _ in faults(root / 'proofs' / 'overflow' / 'faults.txt')
            if pathlib.Path(path).stem == name]


def rounds(root, name, again):
    """The faults of a file, those of different functions together: each function is proved separately."""
    left = [fault for fault in faults_of(root, name) if fault[0] in Source(root, name, again).proved or not again]
    while left:
        first = {function: (function, old, new) for function, old, new in reversed(left)}
        yield list(first.values())
        left = [fault for fault in left if fault not in first.values()]


def try_faults(root, work, slow, name, some):
    """Puts the faults in; is each noticed?"""
    noticed = {}

    def change(text):
        for fault in some:
            text = with_fault(text, *fault)
        return text

    def all_noticed(goal):
        of = max((fault[0] for fault in some if goal.startswith(fault[0] + '_')), key=len, default=None)
        if of and goal not in ignored:
            noticed.setdefault(of, goal)
        return len(noticed) == len(some)
    copy = Source(root, name).copy(work, change)
    # Where all that fails is slow without the fault, as on a busy machine, it has the time that it has without.
    for limit, ignored in (FEW, slow), (MOST, set(Source(root, name).named('Unproved'))):
        left = ','.join(fault[0] for fault in some if fault[0] not in noticed)
        if left:
            output = goals(root, name, work, ['-wp-timeout', str(limit), '-wp-fct', left], all_noticed)[2]
    shutil.rmtree(copy)
    for function, old, _ in some:
        seen = f'not proved {noticed[function]}' if function in noticed else output
        print(f'fault in {function}, {old!r}:', seen, flush=True)
    return len(noticed) == len(some)


def main():
    if not all(shutil.which(tool) for tool in ('frama-c', 'why3', 'cvc4')):
        print('needs frama-c, why3 and cvc4 (packages frama-c-base, cvc4)')
        sys.exit(77)
    root = pathlib.Path(sys.argv[1]).resolve()
    every = sum(PARTS.values(), [])
    there = {path.stem for folder in ('checker', 'dyadic') for path in (root / 'src' / folder).glob('*.c')}
    if there - set(every) - UNWRITTEN - LEFT_OUT:
        sys.exit(f'in no part: {sorted(there - set(every) - UNWRITTEN - LEFT_OUT)}')
    names, again = sys.argv[3:] or PARTS[sys.argv[2]] if len(sys.argv) > 2 else every, set()
    if len(sys.argv) == 3:
        names, again = to_prove(root, names)
    with tempfile.TemporaryDirectory() as work:
        os.environ['WHY3CONFIG'] = os.path.join(work, 'why3.conf')
        os.mkdir(os.path.join(work, 'proved'))
        subprocess.run(['why3', 'config', 'detect'], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=True)
        slow = {name: try_file(root, pathlib.Path(work), name, name in again) for name in names}
        some = [(name, together) for name in names for together in rounds(root, name, name in again)]
        good = [try_faults(root, pathlib.Path(work), slow[name] or set(), name, together)
                for name, together in (some[:1] if len(sys.argv) == 3 else some)]
    if len(sys.argv) != 3:
        record(root, [name for name in names if slow[name] is not None])
    sys.exit(None in slow.values() or not all(good))


main()
