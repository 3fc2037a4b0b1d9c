#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Nothing is admitted or assumed in the theories but the standard axioms of the reals and classical logic.

Usage: assumptions.py ROOT FOLDER   (compiles in FOLDER as compile.py does; prints every breach)

Asks Coq (Print Assumptions) for every theorem in the table of proofs/README.md, and reads the sources for words that
leave a proof out.
"""
import pathlib
import re
import subprocess
import sys

sys.dont_write_bytecode = True
import compile as theories  # noqa: E402

ROW = re.compile(r'^\| [^|]* \| \[([A-Za-z0-9_]+)\.v\]\(theories/\1\.v\) \| ([^|]*) \|', re.M)
ALLOWED = {'ClassicalDedekindReals.sig_forall_dec', 'ClassicalDedekindReals.sig_not_dec',
           'FunctionalExtensionality.functional_extensionality_dep', 'Classical_Prop.classic'}
FORBIDDEN = re.compile(r'\b(Admitted|admit|give_up|Axioms?|Parameters?|Conjectures?|Hypothes[ie]s|Abort|'
                       r'Unset\s+\w+\s+Checking|bypass_check|Declare\s+Module)\b')
COMMENT = re.compile(r'\(\*(?:(?!\(\*|\*\)).)*\*\)', re.S)


def named(root):
    """[(theory, theorem)] of the table in proofs/README.md."""
    rows = ROW.findall((root / 'proofs/README.md').read_text(encoding='utf-8'))
    return [(theory, name) for theory, names in rows for name in names.split(', ')]


def code(text):
    """The text without its comments, nested ones included."""
    while True:
        shorter = COMMENT.sub(' ', text)
        if shorter == text:
            return text
        text = shorter


def words(source):
    """Words in the sources that skip a proof. Variables of a section are fine: the theorem then states them."""
    for name in theories.listed(source):
        for found in FORBIDDEN.finditer(code((source / name).read_text(encoding='utf-8'))):
            yield f'{name}: {found[0]}'


def asked(folder, names):
    """Coq's own list of axioms for each of the names: [(theorem, text)]."""
    lines = [f'From Dyadel Require {theory}.' for theory in sorted({theory for theory, _ in names})]
    for theory, name in names:
        lines += [f'Goal True. idtac "@@ {theory}.{name}". Abort.', f'Print Assumptions {theory}.{name}.']
    return answers_of(folder, lines)


def asked_at_once(folder, names):
    """The same for all together, which is much faster: one answer."""
    lines = [f'From Dyadel Require {theory}.' for theory in sorted({theory for theory, _ in names})]
    term = 'tt'
    for theory, name in names:
        term = f'(@{theory}.{name}, {term})'
    return answers_of(folder, lines + [f'Definition everything := {term}.', 'Goal True. idtac "@@ everything". Abort.',
                                       'Print Assumptions everything.'])


def answers_of(folder, lines):
    (folder / 'assumptions.v').write_text('\n'.join(lines) + '\n')
    done = subprocess.run(['coqc', '-R', 'theories', 'Dyadel', 'assumptions.v'], cwd=folder, check=False,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode != 0:
        return [('coqc', done.stdout)]
    parts = re.split(r'^@@ (\S+)$', done.stdout, flags=re.M)
    return list(zip(parts[1::2], parts[2::2]))


def judged(answers):
    """What in Coq's answers is not allowed."""
    for name, text in answers:
        if 'Closed under the global context' in text:
            continue
        if not text.lstrip().startswith('Axioms:'):
            yield f'{name}: {text.strip()}'
            continue
        axioms = re.findall(r'^(\S+)(?: :|$)', text.split('Axioms:', 1)[1], flags=re.M)
        yield from (f'{name} rests on {axiom}' for axiom in axioms if axiom not in ALLOWED)


def main():
    root, folder = (pathlib.Path(arg).resolve() for arg in sys.argv[1:3])
    found = list(words(root / 'proofs/theories'))
    names = named(root)
    try:
        theories.compile_theories(root, folder)
    except subprocess.CalledProcessError as error:
        found.append(f'failed: {" ".join(error.cmd)}')
    else:
        at_once = asked_at_once(folder, names)
        if len(at_once) != 1 or list(judged(at_once)):
            answers = asked(folder, names)
            found += judged(answers)
            if len(answers) != len(names):
                found.append(f'{len(names)} theorems are named, Coq answered for {len(answers)}')
            found += [] if found else judged(at_once)
    print('\n'.join(found) or f'{len(names)} theorems rest on nothing but the allowed axioms')
    return 1 if found else 0


if __name__ == '__main__':
    sys.exit(main())
