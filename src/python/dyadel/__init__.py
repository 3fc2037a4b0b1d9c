# SPDX-License-Identifier: LGPL-3.0-or-later
"""Delaunay triangulations and Voronoi diagrams of points that need not be known exactly, without a guess.

    import dyadel, numpy
    d = dyadel.delaunay(numpy.random.rand(1000, 2), radius=1e-3)
    d.outcome, d.legal, d.indeterminate, d.ties      # for every choice of points in the squares
    d.simplices, d.neighbors                         # certain triangles, as scipy.spatial.Delaunay names them
"""
from ._dyadel import formats  # before NumPy, which other interpreters than the main one would damage
from ._dyadel import version as __version__
from ._calls import delaunay, plan, tolerance
from ._check import check, moves
from ._errors import BrokenPromise, Error
from ._geometry import OPEN, RAY, Edges, Enclosures, Rings
from ._notions import Arc, Bisector, Circle, PartialDisc, bisector, con, disc, hull, orientation
from ._points import Confidence, Source, Text
from ._questions import (OUTSIDE, UNDECIDED, Convergence, Graph, Nearest, NearestPlaces, Plan, Table, Tolerance, Trials, Verdict,
                         converge, replay, verify)
from ._sphere import Sphere, SphereCell, SphereVoronoi
from ._statuses import INDETERMINATE, LEGAL, TIE
from ._triangulation import Bounds, Delaunay
from ._voronoi import Cell, Voronoi

__all__ = ['Arc', 'Bisector', 'Bounds', 'BrokenPromise', 'Cell', 'Circle', 'Confidence', 'Convergence', 'Delaunay', 'Edges',
           'Enclosures', 'Error', 'Graph', 'INDETERMINATE', 'LEGAL', 'Nearest', 'NearestPlaces', 'OPEN', 'OUTSIDE',
           'PartialDisc', 'Plan', 'RAY', 'Rings',
           'Source', 'Sphere', 'SphereCell', 'SphereVoronoi', 'TIE', 'Table', 'Text', 'Tolerance', 'Trials', 'UNDECIDED',
           'Verdict', 'Voronoi', '__version__', 'bisector', 'check', 'con', 'converge', 'delaunay', 'disc', 'formats', 'hull',
           'moves', 'orientation', 'plan', 'replay', 'tolerance', 'verify']
