"""K = R T as a matrix, of a scene or of any other problem."""

from os import PathLike
from pathlib import Path
from typing import Any, Dict, Iterator, Optional, Sequence, Union

import numpy as np
import scipy.sparse
from numpy.typing import ArrayLike
from scipy.sparse.linalg import LinearOperator

from . import _neumann, _report
from ._display import as_table
from ._numbers import real
from ._patched import Patched, Vector
from ._petsc import write_matrix, write_vector
from ._progress import run
from ._report import Report

Matrix = Union[scipy.sparse.spmatrix, LinearOperator, ArrayLike]

SOLVERS: Dict[str, str] = dict(_neumann.solvers)
"""The solvers of solve(): name and description."""

STEPS = ("applications", "estimate", "error", "seconds")
_bounds = ("bounce", "power", "l2", "sup", "ratio", "a_priori", "a_posteriori", "estimate", "enclosure_width")


class Matrices(Patched):
    """T, R and Le of one channel of a scene on patches: ``T, R, Le = scene.matrices()``.

    Fields on patches are vectors of basic radiance in W·m⁻²·sr⁻¹ with one value for each unknown: a diffuse side of a patch is one
    unknown, other sides have one for each cell of their directions.

    T: transport, (rays, unknowns): a row is 1 where its ray meets an unknown.
    R: reflection, (unknowns, rays): how much each ray contributes to the radiance of each unknown.
    Le: emitted radiance, (unknowns,).
    b: K Le, (unknowns,); sampled on the lights where the rays hardly meet them.
    measure: n² times area times projected solid angle of an unknown, (unknowns,), m²·sr: ⟨f, g⟩ = Σ measure · f · g.
    ray_measure: the same for each ray, (rays,).
    reflectance: of each unknown, (unknowns,); None if a side is not diffuse.
    patches: a row for each side of a patch: its first ``unknown``, its number of ``directions``, ``patch``, ``side``, ``shape``,
    its centre ``x, y, z`` and normal ``nx, ny, nz`` in scene units, ``area``.
    channel: "grey", "red", "green" or "blue"."""

    T: scipy.sparse.csr_matrix
    R: scipy.sparse.csr_matrix
    ray_measure: Vector

    def __init__(self, patched: "_neumann.Patched") -> None:
        super().__init__(patched)
        made = patched.matrices()
        self.T, self.R, self.ray_measure = made["T"], made["R"], made["ray_measure"]

    def __iter__(self) -> Iterator[Any]:
        return iter((self.T, self.R, self.Le))

    @property
    def K(self) -> scipy.sparse.csr_matrix:
        """R @ T, (unknowns, unknowns): one bounce."""
        return (self.R @ self.T).tocsr()

    def save(self, folder: Union[str, "PathLike[str]"], format: str = "npz") -> None:
        """Writes T, R, K and the vectors into a folder, for other programs.

        "npz": T.npz, R.npz and K.npz, which scipy.sparse.load_npz reads, and vectors.npz for np.load, with Le, b, measure,
        ray_measure and patches. "petsc": T.petsc, R.petsc and K.petsc for PETSc's MatLoad, and Le.petsc, b.petsc, measure.petsc and
        ray_measure.petsc for VecLoad, in PETSc's binary format with real numbers of 64 and indices of 32 bits. Raises InputError
        for another format."""
        if format not in ("npz", "petsc"):
            raise _neumann.InputError(f"format={format!r}: expected 'npz' or 'petsc'")
        folder = Path(folder)
        folder.mkdir(parents=True, exist_ok=True)
        matrices = {"T": self.T, "R": self.R, "K": self.K}
        vectors = {"Le": self.Le, "b": self.b, "measure": self.measure, "ray_measure": self.ray_measure}
        if format == "npz":
            for name, matrix in matrices.items():
                scipy.sparse.save_npz(folder / f"{name}.npz", matrix)
            np.savez_compressed(folder / "vectors.npz", patches=self.patches, **vectors)
            return
        for name, matrix in matrices.items():
            write_matrix(folder / f"{name}.petsc", matrix)
        for name, vector in vectors.items():
            write_vector(folder / f"{name}.petsc", vector)

    def __repr__(self) -> str:
        return f"<Matrices of {self.title}, {self.channel}: T {self.T.shape}, R {self.R.shape}>"


def _operator(K: Matrix, measure: Optional[ArrayLike]) -> "_neumann.Operator":
    if isinstance(K, LinearOperator):
        if getattr(K, "compiled", None) is None:
            raise _neumann.InputError("K is a LinearOperator, expected the K of scene.operators(), or a matrix")
        if measure is not None:
            raise _neumann.InputError("measure: the K of scene.operators() has its own")
        return K.compiled
    sparse = scipy.sparse.issparse(K)
    if sparse:
        K = scipy.sparse.csr_matrix(K)
        K = scipy.sparse.csr_matrix((real(K.data, "the entries of K"), K.indices, K.indptr), shape=K.shape)
    else:
        K = np.ascontiguousarray(real(K, "K"))
    m = np.ones(K.shape[0]) if measure is None else real(measure, "measure")
    return _neumann.sparse(K, m) if sparse else _neumann.dense(K, m)


def series(
    K: Matrix,
    Le: ArrayLike,
    *,
    error: float = 1e-6,
    most: int = 10000,
    norm: Optional[float] = None,
    measure: Optional[ArrayLike] = None,
    quiet: bool = False,
) -> Report:
    """Adds up L = Le + K Le + K² Le + … until the sum is known to be close enough, or known not to converge.

    K: (n, n), of scipy.sparse or dense, or the K of ``scene.operators()``. Le: (n,). error: the error of the sum at which the
    series ends, relative to its largest value. most: the largest number of bounces. norm: a number ≥ ‖K‖∞, such as the largest
    albedo, for the bounds. measure: (n,), of each unknown; default 1.

    Returns a Report of
    sum (n,), the middle of the enclosure if that ended the series;
    verdict, "converged", "rounding" (only rounding errors are left, and they exceed ``error``), "limit" or "diverging", and why;
    warnings;
    rows, a structured array with a row for each bounce: bounce; power Σ m|t|, l2 and sup of the term t = K^n Le; ratio of powers;
    for ‖L − S_n‖∞ the bounds a_priori and a_posteriori (inf: there is none), and estimate, which is no bound; enclosure_width,
    relative;
    rate, the ratio of the last terms;
    enclosure: exists, or why not; low and high (n,), between which L lies; width; c1 and c2, the quotients of Collatz and Wielandt.
    """
    operator = _operator(K, measure)
    made = run(_neumann.series(operator, real(Le, "Le"), error, most, norm), quiet)
    if not quiet:
        _report.warn(made["warnings"])
    made["rows"] = _report.rows(made["rows"], _bounds)
    made["enclosure"] = Report(made["enclosure"])
    return Report(made)


class Solutions(dict):
    """The results of solvers, by their names; each is a Report as that of solve(). A notebook shows them as a table."""

    def __init__(self, found: Dict[str, Report], about: Report) -> None:
        super().__init__(found)
        self.about = about
        """The equation: its scene, channel and spectral radius."""

    def __repr__(self) -> str:
        converged = sum(found.verdict == "converged" for found in self.values())
        return f"<Solutions by {len(self)} solvers, of which {converged} converged>"

    def _repr_html_(self) -> str:
        names = ["solver", "applications", "seconds", "estimate", "error", "verdict", "why"]
        rows = []
        for r in self.values():
            estimate = float(r.history["estimate"][-1]) if len(r.history) else None
            cells = ["" if x is None or np.isnan(x) else x for x in (estimate, r.get("error"))]
            rows.append([r.title, r.applications, r.seconds, *cells, r.verdict, r.why if r.verdict != "converged" else ""])
        return as_table(names, rows)


def solve(
    K: Matrix,
    Le: ArrayLike,
    solver: Union[str, Sequence[str]] = "gmres",
    *,
    error: float = 1e-6,
    most: int = 10000,
    radius: Optional[float] = None,
    lowest: Optional[float] = None,
    reflectance: Optional[ArrayLike] = None,
    exact: Optional[ArrayLike] = None,
    measure: Optional[ArrayLike] = None,
    quiet: bool = False,
) -> Any:
    """Solves L = Le + K L by one of SOLVERS, by a list of them, or by "all".

    K: (n, n), of scipy.sparse or dense, or the K of ``scene.operators()``. Le: (n,). error: the estimated error, relative to ‖L‖∞,
    at which a solver ends. most: the largest number of applications of K. radius: the spectral radius of K or a bound on it.
    chebyshev needs it; it also turns residuals into errors where, for K ≥ 0, a few applications of K give no bound on ‖(I − K)⁻¹‖∞.
    lowest: the lowest eigenvalue if all are real; default −radius. reflectance: (n,), ρ if K = diag(ρ) F with F reciprocal, for cg.
    exact: (n,), L if it is known, to get true errors. measure: (n,), of each unknown; default 1.

    Returns a Report of x (n,), verdict ("converged", "rounding", "limit", "diverging", "broke down", "refused"), why, applications
    of K, setup_applications, which are included in these, seconds, and history, a structured array: applications, estimate, error
    (nan if L is not known), seconds. Of several solvers returns Solutions, which hold these by name and, if "lu" is among them, the
    error of each relative to the x of "lu". Raises InputError for an unknown solver."""
    operator = _operator(K, measure)
    light = real(Le, "Le")
    rho = None if reflectance is None else real(reflectance, "reflectance")
    L = None if exact is None else real(exact, "exact")

    def one(name: str) -> Report:
        job = _neumann.solve_one(name, operator, light, error, most, radius, lowest, rho, L)
        made = run(job, quiet)
        made["history"] = _report.rows(made["history"], STEPS)
        return Report(made)

    if isinstance(solver, str) and solver != "all":
        return one(solver)
    names = list(SOLVERS) if solver == "all" else list(solver)
    found = {name: one(name) for name in names}
    if "lu" in found and found["lu"].verdict == "converged":
        answer = found["lu"].x
        for report in found.values():
            report["error"] = float(np.abs(report.x - answer).max() / np.abs(answer).max()) if np.any(answer) else 0.0
    return Solutions(found, Report(unknowns=operator.size))


def spectrum(
    K: Matrix,
    count: int = 4,
    *,
    most: int = 10000,
    measure: Optional[ArrayLike] = None,
    adjoint: bool = False,
    quiet: bool = False,
) -> Report:
    """Returns norms and leading eigenvalues of K (n, n), or of K* if adjoint is set.

    most: the largest number of applications of K for the search, which ends sooner if it is expected to take more. Eigenvalues that
    were not found are told by a warning.

    The Report holds norms ("1", "2" and "inf"; they belong to Σ m|f|, (Σ m f²)^½ and max |f|, where m is the measure, default 1:
    norm "1" is that of power if K comes from a scene and m is its matrices().measure), spectral_radius (nan if it was not found),
    series ("converges" …), eigenvalues (count,) by falling modulus, eigenvectors (n, count), residuals (those reached if not all
    were found), eigenvalues_converged, applications of K, why not all were found, and history, a structured array: applications,
    and residual, the largest of all eigenvalues that are sought, relative."""
    operator = _operator(K, measure)
    made = run(_neumann.spectrum_of(operator, count, adjoint, most), quiet)
    made["history"] = _report.rows(made["history"], ("applications", "residual"))
    if made["why"] and not quiet:
        _report.warn([f"eigenvalues were {made['why']}"])
    made["norms"] = Report(made["norms"])
    return Report(made)


def cube(n: int = 16) -> Report:
    """The inside of the unit cube with n × n patches on each face, by exact form factors: ``K = albedo * cube(16).F``.

    Returns a Report of F (6n², 6n²), area (6n²,), face (6n²,): 0 and 1 for x = 0 and 1; 2 and 3 for y; the floor
    is 4, and the ceiling is 5."""
    F, area, face = run(_neumann.cube(n))
    return Report(F=F, area=area, face=np.array(face))
