#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Which sources see DYD_ARMED, themselves or in a header that they include? Only these are compiled again for the tests.

Usage: armed.py ROOT SOURCE...                       prints for each source "armed" or "plain"
       armed.py ROOT --compare ARMED... -- PLAIN...  exit status 1: they are others by now, so configure again
"""
import functools
import os
import re
import sys

INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.M)


@functools.lru_cache(maxsize=None)
def sees(root, name):
    """The text names it, or that of a header which it includes; headers do not include each other in a circle."""
    with open(os.path.join(root, name), encoding='utf-8') as file:
        text = file.read()
    return 'DYD_ARMED' in text or any(sees(root, 'src/' + h) for h in INCLUDE.findall(text))


def main():
    root, *names = sys.argv[1:]
    if names[0] == '--compare':
        end = names.index('--')
        wrong = [n for n in names[1:end] if not sees(root, n)] + [n for n in names[end + 1:] if sees(root, n)]
        if wrong:
            print('configure again (meson setup --reconfigure BUILD): what is compiled for the tests has changed:', *wrong)
        sys.exit(bool(wrong))
    print(*('armed' if sees(root, n) else 'plain' for n in names), sep='\n')


if __name__ == '__main__':
    main()
