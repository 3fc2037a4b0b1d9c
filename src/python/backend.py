# SPDX-License-Identifier: LGPL-3.0-or-later
"""Builds wheels by meson-python, which expects pyproject.toml next to the top meson.build: in a folder of links."""
import contextlib
import os
import pathlib
import tempfile

import mesonpy

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]


@contextlib.contextmanager
def _staged():
    before = os.getcwd()
    with tempfile.TemporaryDirectory(prefix='dyadel-') as folder:
        for name in ('include', 'meson.build', 'meson_options.txt', 'src'):
            os.symlink(ROOT / name, os.path.join(folder, name))
        os.symlink(HERE / 'pyproject.toml', os.path.join(folder, 'pyproject.toml'))
        os.chdir(folder)
        try:
            yield
        finally:
            os.chdir(before)


def get_requires_for_build_wheel(config_settings=None):
    with _staged():
        return mesonpy.get_requires_for_build_wheel(config_settings)


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    target = os.path.abspath(wheel_directory)
    with _staged():
        return mesonpy.build_wheel(target, config_settings, metadata_directory)


def build_sdist(sdist_directory, config_settings=None):
    raise NotImplementedError('the sources of the package are those of the library: take the whole repository')
