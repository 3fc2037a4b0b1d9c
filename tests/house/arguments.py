#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The order of arguments that include/dyadel/dyadel.h states, in all functions and callbacks of the public headers.

Usage: arguments.py ROOT   (prints every breach; exit status 1 when there is one)
"""
import pathlib
import re
import sys

COMMENT = re.compile(r'/\*.*?\*/', re.S)
FUNCTION = re.compile(r'(?:DYD_API|typedef)?[\w *]*?(?:\b(\w+)|\(\*(\w+)\))\s*\(([^()]*)\)\s*;')
CALLBACK = re.compile(r'\bdyd_\w+_fn\b')


def rank(argument):
    """0: changed by the call (output, in-out, user of a callback); 1: only read; 2: the error record."""
    if re.search(r'\bdyd_error \*', argument):
        return 2
    pointer = '*' in argument or '[' in argument or re.search(r'\bmp[zq]_t\b', argument)
    return 0 if pointer and not re.match(r'const\b', argument) else 1


def breach(arguments):
    seen, after_callback = 0, False
    for k, argument in enumerate(arguments):
        if CALLBACK.search(argument) or (after_callback and argument == 'void *user'):
            after_callback = True
            continue
        if argument == 'size_t n' or (k == 0 and argument == 'dyd_error *err'):  # of the arrays that follow; an output
            continue
        kind = rank(argument)
        if kind < seen:
            return argument
        seen = kind
    return None


def main():
    status = count = 0
    for path in sorted((pathlib.Path(sys.argv[1]) / 'include/dyadel').glob('*.h')):
        for plain, pointer, text in FUNCTION.findall(COMMENT.sub('', path.read_text(encoding='utf-8'))):
            if not pointer and not plain.startswith('dyd_'):
                continue
            arguments = [' '.join(a.split()) for a in text.split(',')]
            count += 1
            wrong = breach(arguments)
            if wrong:
                print(f'{path}: {plain or pointer}: "{wrong}" stands behind what is only read')
                status = 1
    print(f'{count} prototypes')
    return status if count > 150 else 1


if __name__ == '__main__':
    sys.exit(main())
