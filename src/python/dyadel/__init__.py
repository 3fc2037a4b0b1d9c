# SPDX-License-Identifier: LGPL-3.0-or-later
"""Delaunay triangulations and Voronoi diagrams of points that need not be known exactly, without a guess.

    import dyadel, numpy
    d = dyadel.delaunay(numpy.random.rand(1000, 2), radius=1e-3)
    d.outcome, d.legal, d.indeterminate, d.ties      # what is true for every choice of points in the squares
    d.simplices, d.neighbors                         # sure triangles, as scipy.spatial.Delaunay names them
"""
from ._dyadel import version as __version__
from ._check import check, moves
from ._dyadel import formats
from ._errors import BrokenPromise, Error
from ._questions import (Convergence, Nearest, Plan, Table, Tolerance, Verdict, converge, plan, tolerance, verify)
from ._triangulation import INDETERMINATE, LEGAL, TIE, Bounds, Delaunay, Source, Text, delaunay
from ._voronoi import Cell, Voronoi

__all__ = ['INDETERMINATE', 'LEGAL', 'TIE', 'Bounds', 'BrokenPromise', 'Cell', 'Convergence', 'Delaunay', 'Error', 'Nearest',
           'Plan', 'Source', 'Table', 'Text', 'Tolerance', 'Verdict', 'Voronoi', '__version__', 'check', 'converge',
           'delaunay', 'formats', 'moves', 'plan', 'tolerance', 'verify']
