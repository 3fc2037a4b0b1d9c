# SPDX-License-Identifier: LGPL-3.0-or-later
"""Writes the reference of the package, a page made of its docstrings. Usage: reference.py OUT.html FOLDER-OF-THE-PACKAGE"""
import pathlib
import pydoc
import sys


def page(module):
    return pydoc.html.page(f'{module.__name__} {module.__version__}', pydoc.html.document(module, module.__name__))


if __name__ == '__main__':
    out, folder = sys.argv[1:]
    sys.path.insert(0, folder)
    import dyadel
    pathlib.Path(out).write_text(page(dyadel), encoding='utf-8')
