"""neumann makes the bounces of light visible: the terms of L = Le + K Le + K² Le + …, their sums, and their errors.

    import neumann
    scene = neumann.load("scenes/cornell-box/cornell-box.xml")
    series = scene.render(bounces=5, spp=64)
    series.terms[1]                      # direct light: (height, width, 3), row 0 on top, W·m⁻²·sr⁻¹
    series.sums[5], series.sums_stderr[5]
    series[2], series[1:4]               # bounces, as a notebook shows them
    series.save("out/cornell-box")       # the files that ./run render writes

    T, R, Le = scene.matrices()          # scipy.sparse, scipy.sparse, numpy
    K = R @ T
    neumann.series(K, Le).verdict        # "converged"
    neumann.solve(K, Le, "gmres").applications

Bounce i is the power of K: bounce 0 is emission seen directly, bounce 1 is direct light. T carries light along straight lines to
the next surface, and R scatters the light there; operators/NOTATION.md defines all symbols.
"""

from ._blame import Blame, blame
from ._bounces import Bounce, Bounces, BounceSeries, Way, read
from ._chain import Chain
from ._compare import compare, flip
from ._dictionary import look_at
from ._functions import FieldOperator
from ._matrices import SOLVERS, Matrices, Solutions, cube, series, solve, spectrum
from ._method import Method
from ._method_options import (
    Auto,
    Bidirectional,
    Cache,
    Classic,
    Corrected,
    Gather,
    Guided,
    Light,
    Matrix,
    Metropolis,
    Mixed,
    Patches,
    Photon,
    Pointwise,
    Shooting,
    Surface,
    Walk,
)
from ._neumann import InputError, RunError
from ._neumann import version as __version__
from ._operators import Operators, Symmetrised
from ._photons import Photons
from ._rays import LightPoints, Points
from ._records import Records
from ._report import HealthWarning, NeumannWarning, Report
from ._scene import Plan, Scene, load, load_dict
from ._study import Study
from ._unbounce import LightPictures, Unbounced, unbounce

__all__ = [
    "Auto",
    "Bidirectional",
    "Blame",
    "Bounce",
    "BounceSeries",
    "Bounces",
    "Cache",
    "Chain",
    "Classic",
    "Corrected",
    "FieldOperator",
    "Gather",
    "Guided",
    "HealthWarning",
    "InputError",
    "Light",
    "LightPictures",
    "LightPoints",
    "Matrices",
    "Matrix",
    "Method",
    "Metropolis",
    "Mixed",
    "NeumannWarning",
    "Operators",
    "Patches",
    "Photon",
    "Photons",
    "Plan",
    "Points",
    "Pointwise",
    "Records",
    "Report",
    "RunError",
    "SOLVERS",
    "Scene",
    "Solutions",
    "Study",
    "Shooting",
    "Surface",
    "Symmetrised",
    "Unbounced",
    "Walk",
    "Way",
    "blame",
    "compare",
    "cube",
    "flip",
    "load",
    "load_dict",
    "look_at",
    "read",
    "series",
    "solve",
    "spectrum",
    "unbounce",
]

for _error in (InputError, RunError):
    _error.__module__ = __name__
del _error
