#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Has coqchk, which shares only the kernel with coqc, check compiled theories again.

Usage: recheck.py ROOT FOLDER [--renew]   (compiles in FOLDER as compile.py does)

The libraries that they use are taken as compiled by their package. All of it takes some minutes of a core:
proofs/rechecked.txt has a digest of each theory that was checked, of its text, of the texts that it requires and of the
version of Coq. Those with another digest are checked, and one in AGAIN of the rest, which changes with the digests.
--renew checks all, and writes the digests.
"""
import hashlib
import pathlib
import re
import subprocess
import sys

sys.dont_write_bytecode = True
import compile as theories  # noqa: E402

AGAIN = 8  # one in AGAIN theories that were checked is checked again
REQUIRED = re.compile(r'^From Dyadel Require (?:Import |Export )?([\w\s]+)\.$', re.M)


def digests(source):
    """{theory: digest} of what coqchk's verdict rests on."""
    version = subprocess.run(['coqchk', '--version'], stdout=subprocess.PIPE, text=True, check=True).stdout
    found = {}

    def digest(name):
        if name not in found:
            text = (source / f'{name}.v').read_text(encoding='utf-8')
            of = sorted({word for words in REQUIRED.findall(text) for word in words.split()})
            found[name] = hashlib.sha256(repr((version, text, [(word, digest(word)) for word in of])).encode()).hexdigest()
        return found[name]
    return {name[:-2]: digest(name[:-2]) for name in theories.listed(source)}


def checked_before(path):
    """{theory: digest} of proofs/rechecked.txt."""
    return dict(line.split() for line in path.read_text(encoding='utf-8').splitlines() if not line.startswith('#'))


def main():
    root, folder = (pathlib.Path(arg).resolve() for arg in sys.argv[1:3])
    target, record, renew = theories.compile_theories(root, folder), root / 'proofs/rechecked.txt', '--renew' in sys.argv
    now, before = digests(root / 'proofs/theories'), checked_before(record)
    names = [name for name, digest in now.items() if renew or before.get(name) != digest or int(digest, 16) % AGAIN == 0]
    status = subprocess.run(['coqchk', '-silent', '-R', '.', 'Dyadel', *(word for name in names for word in ('-norec', f'Dyadel.{name}'))],
                            cwd=target, check=False).returncode if names else 0
    print(f'{len(names)} of {len(now)} theories: ' + ('a fault' if status else 'no fault'))
    if renew and not status:
        lines = ['# SPDX-License-Identifier: LGPL-3.0-or-later', '# What was checked again: see recheck.py, which writes it.']
        record.write_text('\n'.join(lines + [f'{name} {now[name]}' for name in sorted(now)]) + '\n', encoding='utf-8')
    return status


if __name__ == '__main__':
    sys.exit(main())
