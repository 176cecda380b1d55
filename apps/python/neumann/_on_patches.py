"""What a scene is asked as a matrix: its surfaces are cut into patches for it."""

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
    """How the surfaces are cut, and what that may cost."""

    patches: Optional[int]
    """About so many, 2000 without it."""
    directions: Optional[int]
    """Rays of each side of a patch, a power of two, 64 without it."""
    seed: Optional[int]
    memory: Optional[float]
    """GiB that may be taken."""
    threads: Optional[int]
    """All without it."""


def _asked(keywords: Dict[str, Any], function: str) -> List[Tuple[str, List[str]]]:
    """Of its locals()."""
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

        patches: about so many, 2000 without it. directions: rays of each side of a patch, a power of two, 64 without it. channel: r, g
        or b; without it the one that reflects most, of the largest ⟨K 1, 1⟩ / ⟨1, 1⟩. memory: GiB that may be taken. Raises InputError.
        """
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

        Keywords as of ``matrices()``. Raises InputError.
        """
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
        """Norms and leading eigenvalues of K, whether and how fast the series ends, rounding: what ``neumann spectrum --json`` prints.

        channel: r, g or b; without it all that differ. eigenvalues: how many, 4 without it. time: seconds to look for them, 60 without it; most: applications of K of a search, 10000.
        The others are as of ``matrices()``. Each of the Report's ``channels`` has ``spectral_radius``, ``series`` ("converges" …),
        ``norms`` ("inf" of radiance, "1" of power, with ``norm_1_standard_error`` by the rays, and "2"), ``eigenvalues`` (k,) complex, by
        falling modulus, ``eigenvectors`` (unknowns, k), on the unknowns of ``matrices()`` with the same patches, directions and seed,
        ``residuals`` (k,), ``refinement``, ``bounces_until``, ``rounding``, and ``eigenvalues_search``: its applications, its history, and
        why what it reached is not what it looked for, which is a warning, too.
        """
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
        """L = Le + K L by the series and by all other solvers, side by side: as ``neumann solve``.

        channel: r, g or b; without it the one with the largest spectral radius. error: relative, that ends a solver, 1e-6 without it.
        most: applications of K that a solver may take, 10000 without it. The others are as of ``matrices()``.

        Returns Reports by the solvers' names; each has x (unknowns,), or x = L − Le where ``about.unknown`` says so, verdict, why,
        applications, error to LU, history. Raises InputError.
        """
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
