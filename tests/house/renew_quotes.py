#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Writes the C bodies that proofs/theories quote anew from the sources, where check_constants.py says they differ.

Usage: renew_quotes.py ROOT

For each quotation that changed it prints what a person has to do: nothing when only names of variables changed, or the
function moved to another file; otherwise the definition that follows the quotation has to be compared with the new
text, and the theorems that use it proved anew. Places of constants follow such changes of names and files; their
values never change here. A quotation of a function that is gone, or defined twice, stays; exit status 1 then.
"""
import pathlib
import re
import sys

from check_constants import BODY, Sources, function_body, pattern, tokens, without_comments

PLACE = re.compile(r'\(\* (\[[A-Z]+-[A-Z0-9]+\]|any) ([\w/.]+): ((?:(?!\*\)\n).)*?) \*\)\n')
WORD = re.compile(r'[A-Za-z_]\w*')
REQUIRE = re.compile(r'^From Dyadel Require (?:Import|Export)\s+([\w\s]+)\.', re.M)
STATED = re.compile(r'^(?:Definition|Fixpoint|Notation|Theorem|Lemma|Corollary)\s+"?(\w+)', re.M)
SENTENCE = re.compile(r'^(Definition|Fixpoint|Theorem|Lemma|Corollary)\s+(\w+)(.*?)\.\s*$', re.M | re.S)


def without_comment_lines(body):
    """The lines of a body, without comments, and the lines that held nothing else."""
    kept = [re.sub(r'\s+$', '', line) for line in re.sub(r'[ \t]*(?:/\*.*?\*/|//[^\n]*)', '', body, flags=re.S).split('\n')]
    return '\n'.join(line for line in kept if line)


def canonical(text):
    """The tokens, every identifier replaced by the place of its first occurrence."""
    seen = {}
    return WORD.sub(lambda m: f'w{seen.setdefault(m[0], len(seen))}', tokens(without_comments(text)))


def defined(code):
    """Names of all functions that a file defines."""
    return re.findall(r'^(?!#|typedef)[A-Za-z_][\w \t*]*?\b(\w+)\([^;{}]*\)\s*\{', code, re.M)


def files(root):
    return [str(p.relative_to(root)) for folder in ('src', 'include') for p in sorted((root / folder).rglob('*.[ch]'))]


def find_home(root, sources, path, name, old):
    """(path, name) of the function quoted: where the quotation says; else the one file under src or include that defines
    it; else the one function of its file that differs in names only."""
    if function_body(sources.code(path) or '', name) is not None:
        return path, name
    homes = [(p, name) for p in files(root) if name in defined(sources.code(p))]
    if not homes and sources.code(path):
        homes = [(path, other) for other in defined(sources.code(path))
                 if canonical(function_body(sources.code(path), other) or '') == canonical(old)]
    return homes[0] if len(homes) == 1 else (None, None)


def quoted_text(root, sources, path, name):
    """The body as the source has it, without comments."""
    body = function_body(sources.code(path), name)
    raw = function_body((root / path).read_text(encoding='utf-8'), name) or ''
    return without_comment_lines(raw if tokens(without_comments(raw)) == tokens(body) else body)


def renamings(old, new):
    """{name: new name} when the texts differ in names only, used the same way throughout, and no name takes the
    place of another one; else None."""
    if canonical(old) != canonical(new):
        return None
    before, after = (WORD.findall(tokens(without_comments(text))) for text in (old, new))
    renamed = {a: b for a, b in zip(before, after) if a != b}
    return None if set(renamed.values()) & set(before) else renamed


def requiring(theory, texts):
    """A theory and the ones that require it, directly or not."""
    reached, grown = {theory}, True
    while grown:
        more = {n for n, text in texts.items() if reached & {f'{r}.v' for q in REQUIRE.findall(text) for r in q.split()}}
        grown, reached = not more <= reached, reached | more
    return reached


def resting_on(name, theory, texts):
    """Theorems whose statement names a definition of a theory, directly or through other definitions."""
    reached, grown = {name}, True
    sentences = [found for t in requiring(theory, texts) for found in SENTENCE.findall(texts[t])]
    while grown:
        more = {of for kind, of, text in sentences if kind in ('Definition', 'Fixpoint') and reached & set(WORD.findall(text))}
        grown, reached = not more <= reached, reached | more
    return sorted({of for kind, of, text in sentences if kind in ('Theorem', 'Corollary') and reached & set(WORD.findall(text))})


def advice(name, end, old, new, texts):
    """What a person has to do about a quotation in theory `name`, ending there, that changed."""
    renamed = renamings(old, new)
    if renamed is not None:
        pairs = ', '.join(f'{a} -> {b}' for a, b in renamed.items())
        return f'names only ({pairs}); nothing to prove if they mean the same' if pairs else 'the place only; nothing to prove'
    model = STATED.search(texts[name], end)
    rest = ', '.join(resting_on(model[1], name, texts)) if model else ''
    return f'the text; compare {model[1] if model else name} with it, and prove anew: {rest or "what follows it"}'


def renew_bodies(root, sources, texts, renamed):
    """Rewrites quotations in texts and collects renamings by path; yields (is a failure, what to say)."""
    for name, text in texts.items():
        out, at = [], 0
        for found in BODY.finditer(text):
            path, function, old = found.groups()
            home = find_home(root, sources, path, function, old)
            if home[0] is None:
                yield True, f'{name}: {function} of {path} is gone, or defined twice'
                continue
            new = quoted_text(root, sources, *home)
            if home == (path, function) and tokens(without_comments(old)) == tokens(without_comments(new)):
                continue
            out += [text[at:found.start()], f'(* C {home[0]} {home[1]}\n{new}\n*)']
            at = found.end()
            renamed.setdefault(path, {function: home[1]}).update(renamings(old, new) or {})
            yield False, f'{name}: {home[1]} of {home[0]}: {advice(name, at, old, new, texts)}'
        texts[name] = ''.join(out) + text[at:]


def find_place(root, sources, path, place, names):
    """(path, place) where the text of a constant's place is found once now; None when nowhere, or twice."""
    renewed = WORD.sub(lambda m: names.get(m[0], m[0]), place)
    homes = [(p, text) for p in ([path] if sources.code(path) else files(root)) for text in dict.fromkeys((place, renewed))
             if text.count('{}') == 1 and len(pattern(text).findall(sources.code(p))) == 1]
    return homes[0] if len(homes) == 1 else None


def renew_places(root, sources, texts, renamed):
    for name, text in texts.items():
        for kind, path, place in dict.fromkeys(PLACE.findall(text)):
            home = find_place(root, sources, path, place, renamed.get(path, {}))
            if home is None:
                yield True, f'{name}: "{place}" of {path} is gone, or found twice'
            elif home != (path, place):
                texts[name] = texts[name].replace(f'(* {kind} {path}: {place} *)', f'(* {kind} {home[0]}: {home[1]} *)')
                yield False, f'{name}: "{home[1]}" of {home[0]}: the place of a constant; nothing to prove'


def renew_vectors(root, changed):
    """Functions that are run against their definitions follow their names: {name: new name}."""
    for path in sorted((root / 'proofs/definitions').glob('*')):
        text = path.read_text(encoding='utf-8')
        for old, new in changed.items():
            text = re.sub(rf'"{old}"|^{old}(?= \|)' + (rf'|\b{old}(?=\()' if path.suffix == '.c' else ''),
                          lambda m, old=old, new=new: m[0].replace(old, new), text, flags=re.M)
        if text != path.read_text(encoding='utf-8'):
            path.write_text(text, encoding='utf-8')


def renew(root):
    """Rewrites the theories and the extracted code; [(is a failure, what to say)]."""
    theories = sorted((root / 'proofs/theories').glob('*.v'))
    before = {p.name: p.read_text(encoding='utf-8') for p in theories}
    sources, texts, renamed = Sources(root), dict(before), {}
    said = list(renew_bodies(root, sources, texts, renamed)) + list(renew_places(root, sources, texts, renamed))
    quoted = {function for text in before.values() for _, function, _ in BODY.findall(text)}
    renew_vectors(root, {a: b for names in renamed.values() for a, b in names.items() if a in quoted and a != b})
    for path in theories:
        if texts[path.name] != before[path.name]:
            path.write_text(texts[path.name], encoding='utf-8')
    return said


def main():
    said = renew(pathlib.Path(sys.argv[1]).resolve())
    print('\n'.join(text for _, text in said) or 'nothing to renew')
    return 1 if any(failed for failed, _ in said) else 0


if __name__ == '__main__':
    sys.exit(main())
