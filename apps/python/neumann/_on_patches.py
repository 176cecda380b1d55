"""Functions of a scene as a matrix, for which its surfaces are cut into patches."""

from typing import Any, Dict, List, Literal, Optional, Tuple, TypedDict, Unpack

import numpy as np

from . import _neumann, _report
from ._arguments import checked, options, with_keywords
from ._matrices import STEPS, Matrices, Solutions
from ._operators import Operators
from ._progress import run
from ._report import Report, warn

Channel = Literal["r", "g", "b"]


class PatchOptions(TypedDict, total=False):
    """How the surfaces are cut, and which resources that may take."""

    patches: Optional[int]
    """Their approximate number, default 2000."""
    directions: Optional[int]
    """Rays of each side of a patch, a power of two, default 64."""
    seed: Optional[int]
    memory: Optional[float]
    """GiB that may be taken."""
    threads: Optional[int]
    """Default all."""


def _asked(keywords: Dict[str, Any], function: str) -> List[Tuple[str, List[str]]]:
    """Returns the options of a function, from its locals()."""
    return options({**keywords, **checked(keywords["of_patches"], PatchOptions, function)})


class OnPatches:
    """A scene whose T, R and K are matrices, with their spectrum and solutions."""

    _scene: "_neumann.Scene"

    @with_keywords(PatchOptions)
    def matrices(
        self,
        *,
        channel: Optional[Channel] = None,
        quiet: bool = False,
        **of_patches: Unpack[PatchOptions],
    ) -> Matrices:
        """T, R and Le on patches: ``T, R, Le = scene.matrices()``; then ``K = R @ T``, and ``L = Le + K @ Le + K @ K @ Le + …``.

        patches: their approximate number, default 2000. directions: rays of each side of a patch, a power of two, default 64.
        channel: r, g or b; default the one that reflects most, with the largest ⟨K 1, 1⟩ / ⟨1, 1⟩. memory: GiB that may be taken.
        Raises InputError."""
        return Matrices(run(_neumann.patched(self._scene, _asked(locals(), "matrices")), quiet))

    @with_keywords(PatchOptions)
    def operators(
        self,
        *,
        channel: Optional[Channel] = None,
        quiet: bool = False,
        **of_patches: Unpack[PatchOptions],
    ) -> Operators:
        """T, R, K and I − K as SciPy's LinearOperators, with the same rays as ``matrices()`` and without making a matrix.

        Keywords are those of ``matrices()``. Raises InputError."""
        return Operators(run(_neumann.patched(self._scene, _asked(locals(), "operators")), quiet))

    @with_keywords(PatchOptions)
    def spectrum(
        self,
        *,
        channel: Optional[Channel] = None,
        eigenvalues: Optional[int] = None,
        time: Optional[float] = None,
        most: Optional[int] = None,
        quiet: bool = False,
        **of_patches: Unpack[PatchOptions],
    ) -> Report:
        """Norms and leading eigenvalues of K, whether and how fast the series converges, and rounding: the contents of
        ``neumann spectrum --json``.

        channel: r, g or b; default all that differ. eigenvalues: their number, default 4. time: seconds of the search for them,
        default 60; most: applications of K in a search, default 10000. The other keywords are those of ``matrices()``. Each of the
        Report's ``channels`` has ``spectral_radius``, ``series`` ("converges" …), ``norms`` ("inf" of radiance, "1" of power, with
        ``norm_1_standard_error`` due to the rays, and "2"), ``eigenvalues`` (k,) complex, by falling modulus, ``eigenvectors``
        (unknowns, k), on the unknowns of ``matrices()`` with the same patches, directions and seed, ``residuals`` (k,),
        ``refinement``, ``bounces_until``, ``rounding``, and ``eigenvalues_search``: its applications, its history, and why it did
        not find all eigenvalues, which is also a warning."""
        text, vectors = run(_neumann.spectrum(self._scene, _asked(locals(), "spectrum")), quiet)
        report = _report.from_json(text)
        for channel, columns in zip(report.channels, vectors):
            pairs = channel.eigenvalues
            channel["eigenvalues"] = np.array([complex(p.real, p.imaginary) for p in pairs])
            channel["residuals"] = np.array([p.residual for p in pairs])
            channel["eigenvectors"] = columns
        if not quiet:
            warn(report.warnings)
        return report

    @with_keywords(PatchOptions)
    def solve(
        self,
        *,
        channel: Optional[Channel] = None,
        error: Optional[float] = None,
        most: Optional[int] = None,
        quiet: bool = False,
        **of_patches: Unpack[PatchOptions],
    ) -> Solutions:
        """Solves L = Le + K L by the series and by all other solvers, to compare them, as ``neumann solve`` does.

        channel: r, g or b; default the one with the largest spectral radius. error: the relative error at which a solver ends,
        default 1e-6. most: the largest number of applications of K, default 10000. The other keywords are those of ``matrices()``.

        Returns Reports by the solvers' names; each has x (unknowns,), or x = L − Le if ``about.unknown`` says so, verdict, why,
        applications, error relative to LU, history. Raises InputError."""
        text, x, warnings = run(_neumann.solve(self._scene, _asked(locals(), "solve")), quiet)
        about = _report.from_json(text)
        rows = about.pop("solvers")
        for row, vector in zip(rows, x):
            row["x"] = vector
            steps = [[np.nan if step[name] is None else step[name] for name in STEPS] for step in row.history]
            row["history"] = _report.rows(np.array(steps, dtype=float).reshape(-1, len(STEPS)), STEPS)
        if not quiet:
            warn(warnings)
        return Solutions({row.name: row for row in rows}, about)
