#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The wheel, built without a network and imported in a fresh environment, where nothing of this checkout is seen."""
import pathlib
import site
import subprocess
import sys
import tempfile
import venv
import zipfile

import harness

harness.need('mesonpy', 'pip', 'ensurepip')

PROGRAM = '''
import dyadel, pathlib, sys
assert pathlib.Path(dyadel.__file__).is_relative_to(sys.prefix), dyadel.__file__
assert dyadel.delaunay([(0, 0), ("sqrt(2)", 0), (0, "pi")]).outcome == "decided"
assert pathlib.Path(dyadel.__file__).with_name("py.typed").exists()
print(dyadel.__version__)
'''


def call(*command, **options):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False, **options)
    assert done.returncode == 0, done.stdout
    return done.stdout


def test_wheel():
    source = pathlib.Path(harness.DATA).parents[1] / 'src' / 'python'
    with tempfile.TemporaryDirectory() as folder:
        call(sys.executable, '-m', 'pip', 'wheel', '--no-build-isolation', '--no-deps', '--no-index', '-w', folder,
             '--config-settings=setup-args=-Doptimization=0', source)  # its code has tests of its own
        wheel, = pathlib.Path(folder).glob('*.whl')
        print(wheel.name)
        assert '-abi3-' in wheel.name
        names = zipfile.ZipFile(wheel).namelist()
        assert 'dyadel/_dyadel.abi3.so' in names and 'dyadel/_dyadel.pyi' in names
        assert all(name.startswith(('dyadel/', 'dyadel-')) for name in names), names
        venv.create(f'{folder}/new', system_site_packages=True, with_pip=True)
        python = f'{folder}/new/bin/python'
        call(python, '-m', 'pip', 'install', '--no-index', '--no-deps', wheel)
        assert call(python, '-c', PROGRAM, cwd=folder).strip()


def test_installed():
    """What `ninja install` puts in place is found by this Python, and works with nothing else of the checkout in sight."""
    build = pathlib.Path(harness.PACKAGE).parents[1]
    with tempfile.TemporaryDirectory() as folder:
        call('meson', 'install', '-C', build, '--no-rebuild', '--destdir', folder, '--tags', 'runtime,python-runtime')
        package, = pathlib.Path(folder).glob('**/dyadel/__init__.py')
        place = package.parents[1]
        assert sys.prefix != '/usr' or f'/{place.relative_to(folder)}' in site.getsitepackages(), place
        libraries = ':'.join(str(path.parent) for path in pathlib.Path(folder).glob('**/libdyadel.so*'))
        program = PROGRAM.replace('is_relative_to(sys.prefix)', f'is_relative_to({folder!r})')
        assert call(sys.executable, '-c', program, cwd=folder,
                    env={'PATH': '/usr/bin:/bin', 'PYTHONPATH': str(place), 'LD_LIBRARY_PATH': libraries}).strip()


if __name__ == '__main__':
    harness.run_all(globals())
