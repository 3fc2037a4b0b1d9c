#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The constants and expressions of the C filters are the ones in proofs/theories.

Usage: check_constants.py ROOT   (prints every breach; exit status 1 when there is one)

In the theories,
    (* [ID] path: text with {} for the constant *)   before   Definition c_x : const := (m, e)%Z.  or  Notation z_x := n%Z.
says that the constant at that place of the C file (which must occur once, comments and white space aside) is exactly
m * 2^e (or n). Constant expressions are evaluated in doubles, as the compiler does. And
    (* C path function
      body
    *)
says that this is the whole body of that function, comments and white space aside; so the order of the operations is
compared as well. In a C file that has such constants, every floating-point literal must be one of them, or
    (* any path: text with {} for the constant *)
says that the theorems hold whatever its value. No double is written in a theory in another way. The definition beside a
body that is quoted is run against the function by proofs/definitions.py, or SOUNDNESS.md says why not.
"""
import ast
import fractions
import operator
import pathlib
import re
import sys

PLACE = r'\(\* \[([A-Z]+-[A-Z0-9]+)\] ([\w/.]+): ((?:(?!\*\)\n).)*?) \*\)\n'
CONSTANT = re.compile(r'((?:' + PLACE + r')+)(?:Definition (c_\w+) : const := \((-?\d+), (-?\d+)\)%Z\.|'
                      r'Notation (z_\w+) := \(?(-?\d+)\)?%Z\.)')
ANY = re.compile(r'\(\* any ([\w/.]+): ((?:(?!\*\)\n).)*?) \*\)\n')
DEFINED = re.compile(r'^(?:Definition (c_\w+) : const|Notation (z_\w+) :=)', re.M)
BODY = re.compile(r'\(\* C ([\w/.]+) (\w+)\n(.*?)\n\*\)', re.S)
LITERAL = re.compile(r'(?<![\w.])(?:0[xX][0-9a-fA-F]+(?:\.[0-9a-fA-F]*)?[pP][-+]?\d+|\d+\.\d*(?:[eE][-+]?\d+)?|\d+[eE][-+]?\d+)')
VALUE = r'((?:[-+*/ ().\da-fA-FxXpP]|DBL_MAX)+?)'
INLINE = re.compile(r'\blit\s*\(\s*\(?\s*-?\d+\)?(?:%Z)?\s*,\s*\(?-?\d|B754_finite\s+(?:\w+\s+){3}\(?-?\d|\bb64_of_bits\s+\(?\d|#\[.*float')
OPERATORS = {ast.Add: operator.add, ast.Sub: operator.sub, ast.Mult: operator.mul, ast.Div: operator.truediv}


def without_comments(text):
    """C without comments; each becomes one blank."""
    return re.sub(r'/\*.*?\*/|//[^\n]*', ' ', text, flags=re.S)


def tokens(text):
    """The text with white space where it matters only."""
    return re.sub(r'(?<![A-Za-z0-9_]) | (?![A-Za-z0-9_])', '', ' '.join(text.split()))


def evaluate(expression):
    """The value of a constant expression in doubles."""
    text = re.sub(r'0[xX][0-9a-fA-F.]+[pP][-+]?\d+', lambda m: repr(float.fromhex(m[0])), expression)
    text = text.replace('DBL_MAX', repr(sys.float_info.max))

    def walk(node):
        if isinstance(node, ast.Constant):
            return float(node.value)
        if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
            return -walk(node.operand)
        return OPERATORS[type(node.op)](walk(node.left), walk(node.right))
    return fractions.Fraction(walk(ast.parse(text.strip(), mode='eval').body))


def pattern(place):
    """A regular expression for a place, blind to white space."""
    parts = place.split('{}')
    escaped = [r'\s*'.join(re.escape(t) for t in re.findall(r'\w+|[^\w\s]', part)) for part in parts]
    return re.compile(escaped[0] + r'\s*' + VALUE + r'\s*' + (escaped[1] if parts[1].strip() else r'(?=\n)'))


def function_body(code, name):
    """Text between the braces of the definition of name; None when there is not exactly one."""
    found = list(re.finditer(r'\b' + name + r'\((?:[^;{}()]|\([^;{}()]*\))*\)\s*\{', code))
    if len(found) != 1:
        return None
    depth, start = 1, found[0].end()
    for at in range(start, len(code)):
        depth += {'{': 1, '}': -1}.get(code[at], 0)
        if depth == 0:
            return code[start:at]
    return None


class Sources:
    """C files without comments, read once; and which literals of them are accounted for."""

    def __init__(self, root):
        self.root, self.text, self.known = root, {}, {}

    def code(self, path):
        if path not in self.text:
            file = self.root / path
            self.text[path] = without_comments(file.read_text(encoding='utf-8')) if file.is_file() else None
        return self.text[path]


def check_place(sources, where, path, place, value=None):
    """The constant at a place; its value does not matter when there is none to compare with."""
    code = sources.code(path)
    if code is None:
        yield f'{where}: there is no {path}'
        return
    if place.count('{}') != 1:
        yield f'{where}: one {{}} is needed in "{place}"'
        return
    found = list(pattern(place).finditer(code))
    if len(found) != 1:
        yield f'{where}: "{place}" is found {len(found)} times in {path}; once is needed'
        return
    sources.known.setdefault(path, []).append(found[0].span(1))
    actual = evaluate(found[0][1])
    if value is not None and actual != value:
        yield f'{where}: {value} in the theory, {actual} ({found[0][1].strip()}) in {path}'


def check_constants(sources, name, text):
    """Constants of one theory."""
    seen = set()
    for found in CONSTANT.finditer(text):
        constant = found[5] or found[8]
        seen.add(constant)
        value = fractions.Fraction(int(found[6])) * fractions.Fraction(2) ** int(found[7]) if found[5] else fractions.Fraction(int(found[9]))
        for _, path, place in re.findall(PLACE, found[1]):
            yield from check_place(sources, f'{name}: {constant}', path, place, value)
    for path, place in ANY.findall(text):
        yield from check_place(sources, f'{name}: any', path, place)
    for found in DEFINED.finditer(text):
        if (found[1] or found[2]) not in seen:
            yield f'{name}: {found[1] or found[2]} is tied to no place in the C source'


def check_bodies(sources, name, text):
    """Functions quoted in one theory."""
    for path, function, quoted in BODY.findall(text):
        code = sources.code(path)
        actual = function_body(code, function) if code is not None else None
        if actual is None:
            yield f'{name}: {path} does not define {function} once'
        elif tokens(without_comments(quoted)) != tokens(actual):
            yield f'{name}: {function} in {path} is no longer what the theory is about'


def check_literals(sources):
    """Every floating-point literal of a file with proved constants is one of them."""
    for path, spans in sorted(sources.known.items()):
        for found in LITERAL.finditer(sources.code(path)):
            if re.search(r'_filter\.[ch]$', path) and not any(a <= found.start() and found.end() <= b for a, b in spans):
                yield f'{path}: {found[0]} is in no theory'


def check_use(texts):
    """A constant that no theorem uses proves nothing."""
    for name, text in texts.items():
        for found in DEFINED.finditer(text):
            constant = found[1] or found[2]
            uses = sum(len(re.findall(r'\b' + constant + r'\b', other)) for other in texts.values())
            if uses < 2:
                yield f'{name}: {constant} is not used'


def check_inline(name, text):
    """A double that is written in a theory is tied to nothing."""
    code = re.sub(r'\(\*.*?\*\)', lambda m: '\n' * m[0].count('\n'), text, flags=re.S)
    for found in INLINE.finditer(code):
        yield f'{name}:{code.count(chr(10), 0, found.start()) + 1}: "{found[0]}" is a double of its own, without a place in the C source'


def all_theories(root):
    return {p.name: p.read_text(encoding='utf-8') for p in sorted((root / 'proofs/theories').glob('*.v'))}


def sections(root, title):
    """The part of SOUNDNESS.md under a heading of the third level."""
    text = (root / 'proofs/SOUNDNESS.md').read_text(encoding='utf-8')
    return re.split(r'\n##', text.split(f'### {title}\n')[-1])[0]


def not_run(root):
    """Functions that SOUNDNESS.md lists as quoted, but not run."""
    return set(re.findall(r'^\* `(\w+)`: .', sections(root, 'Definitions, run'), re.M))


def run_functions(root):
    """(path, function) of all that are quoted and not listed."""
    listed = not_run(root)
    return sorted({(path, name) for text in all_theories(root).values() for path, name, _ in BODY.findall(text)
                   if name not in listed})


def check_run(root, texts):
    """Each quotation has vectors, and a definition that takes them; proofs/definitions.py counts them."""
    quoted = {name for text in texts.values() for _, name, _ in BODY.findall(text)}
    folder = root / 'proofs/definitions'
    asked = {name for p in folder.glob('*.c') for name in re.findall(r'^ .*?\{"(\w+)", ', p.read_text(encoding='utf-8'), re.M)}
    asked |= {name for p in folder.glob('*.c') for name in re.findall(r'= \{\{?"(\w+)", ', p.read_text(encoding='utf-8'))}
    for name in sorted(quoted - asked - not_run(root)):
        yield f'{name}: quoted in a theory, but neither run by proofs/definitions nor listed in SOUNDNESS.md as not run'
    for name in sorted(not_run(root) & asked):
        yield f'{name}: run by proofs/definitions, and listed in SOUNDNESS.md as not run'
    for name in sorted((asked | not_run(root)) - quoted):
        yield f'{name}: run by proofs/definitions or listed in SOUNDNESS.md, but no theory quotes it'


def check_filters(root, texts):
    """Each filter is tied to a theory, or SOUNDNESS.md lists it as one that is not."""
    tied = {path.removesuffix(path[-2:]) for text in texts.values() for path in re.findall(r'\(\* (?:C|any|\[[\w-]+\]) (src/[\w/]+\.[ch])', text)}
    section = sections(root, 'Filters, by file')
    listed = set(re.findall(r'`([\w/]+)`', ''.join(re.findall(r'^\* .*', section, re.M))))
    for path in sorted({p.with_suffix('').relative_to(root).as_posix() for p in root.glob('src/**/*_filter.[ch]')}):
        if (path in tied) == (path.removeprefix('src/') in listed):
            yield f'{path}: tied to a theory, or in the list of SOUNDNESS.md, but not both'


def breaches(root):
    texts = all_theories(root)
    sources, count = Sources(root), 0
    for name, text in texts.items():
        yield from check_constants(sources, name, text)
        yield from check_bodies(sources, name, text)
        yield from check_inline(name, text)
        count += len(CONSTANT.findall(text)) + len(BODY.findall(text))
    yield from check_literals(sources)
    yield from check_use(texts)
    yield from check_filters(root, texts)
    yield from check_run(root, texts)
    if not count:
        yield 'proofs/theories: no constant and no function is tied to the C source'


def main():
    found = list(breaches(pathlib.Path(sys.argv[1]).resolve()))
    print('\n'.join(found) or 'no breach')
    return 1 if found else 0


if __name__ == '__main__':
    sys.exit(main())
