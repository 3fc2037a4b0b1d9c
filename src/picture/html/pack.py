# SPDX-License-Identifier: LGPL-3.0-or-later
"""Makes a page of its parts, as C: the text before the data, and the text after them.

Usage: pack.py OUT.c COLOURS.h PAGE.html STYLE.css SCRIPT.js...

In the page {style} and {script} are replaced by the parts, scripts in the order given, {style-digest} and
{script-digest} for their digests as a Content-Security-Policy names them, {data} for where data go. In the page and the
style {tie-area} is the colour that COLOURS.h defines as DYD_RGB_TIE_AREA: pages and pictures have the same.
"""
import base64
import hashlib
import pathlib
import re
import sys

LICENCE = re.compile(r'(/\*|<!--|//) SPDX-License-Identifier: [\w.-]+ ?(\*/|-->)?\n')


def read(path):
    """A part without its licence line: the page has one."""
    return LICENCE.sub('', pathlib.Path(path).read_text(encoding='utf-8'), count=1)


COLOUR = re.compile(r'#define DYD_RGB_(\w+) 0x([0-9a-f]{6})\b')


def fill(text, parts):
    return re.sub(r'\{([a-z][a-z0-9-]*)\}', lambda match: parts[match[1]], text)


def digest(text):
    return 'sha256-' + base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()


def array(name, text):
    data = text.encode()
    rows = (','.join(map(str, data[k:k + 30])) for k in range(0, len(data), 30))
    return (f'const unsigned char {name}[] = {{\n' + ',\n'.join(rows) + '};\n' +
            f'const size_t {name}_size = sizeof {name};\n')


def main():
    out, colours, page, style, *scripts = sys.argv[1:]
    parts = {name.lower().replace('_', '-'): rgb for name, rgb in COLOUR.findall(pathlib.Path(colours).read_text(encoding='utf-8'))}
    texts = {'style': '\n' + fill(read(style), parts), 'script': '\n"use strict";\n(() => {\n' + ''.join(map(read, scripts)) + '})();\n'}
    parts.update(texts, **{f'{name}-digest': digest(text) for name, text in texts.items()})
    before, after = (fill(text, parts) for text in pathlib.Path(page).read_text(encoding='utf-8').split('{data}'))
    names = 'dyd_html_before', 'dyd_html_after'
    declared = ''.join(f'extern const unsigned char {name}[];\nextern const size_t {name}_size;\n' for name in names)
    pathlib.Path(out).write_text('/* Made by pack.py. */\n#include <stddef.h>\n' + declared +
                                 ''.join(map(array, names, (before, after))), encoding='utf-8')


if __name__ == '__main__':
    main()
