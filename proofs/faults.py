# SPDX-License-Identifier: LGPL-3.0-or-later
"""Faults that are put into functions in C, one at a time, to see that a test notices them.

A line of a file of faults: FUNCTION | file below src | text | its replacement | reason, for a fault not noticed.
The text occurs once in the function, or else in the file; \\n in it means the end of a line.
"""
import pathlib
import re


def faults(path):
    """(function, file, text, replacement, reason or None) of each line."""
    for line in pathlib.Path(path).read_text(encoding='utf-8').split('\n'):
        if line and not line.startswith('#'):
            parts = [part.strip().replace('\\n', '\n') for part in re.split(r' \|(?: |$)', line)]
            yield *parts[:4], parts[4] if len(parts) > 4 else None


def with_fault(code, function, text, replacement):
    """The file with the fault, in the body of the function if the text is there. Raises ValueError when it is not there
    once."""
    found = list(re.finditer(r'\b' + function + r'\((?:[^;{}()]|\([^;{}()]*\))*\)\s*\{', code))
    if found:
        start = found[0].end()
        end = code.index('\n}', start)
        if code.count(text, start, end) == 1:
            return code[:start] + code[start:end].replace(text, replacement) + code[end:]
    if code.count(text) != 1:
        raise ValueError(f'{function}: "{text}" is found {code.count(text)} times')
    return code.replace(text, replacement)
