"""K = R T as a matrix: of a scene, or anyone's."""

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
"""The names that solve() takes, and what they stand for."""

STEPS = ("applications", "estimate", "error", "seconds")
_bounds = ("bounce", "power", "l2", "sup", "ratio", "a_priori", "a_posteriori", "estimate", "enclosure_width")


class Matrices(Patched):
    """T, R and Le of one channel of a scene on patches: ``T, R, Le = scene.matrices()``.

    Fields on patches are vectors of one value an unknown, basic radiance in W·m⁻²·sr⁻¹: a diffuse side of a patch is one unknown,
    others have one for each cell of their directions.

    T: transport, (rays, unknowns): a row is 1 where its ray meets an unknown.
    R: reflection, (unknowns, rays): what the rays bring to what the unknowns send.
    Le: emitted radiance, (unknowns,).
    b: K Le, (unknowns,); sampled on the lights where the rays hardly meet them.
    measure: n² times area times projected solid angle of an unknown, (unknowns,), m²·sr: ⟨f, g⟩ = Σ measure · f · g.
    ray_measure: the same of a ray, (rays,).
    reflectance: of each unknown, (unknowns,); None where a side is not diffuse.
    patches: a row for each side of a patch: its first ``unknown``, how many ``directions``, ``patch``, ``side``, ``shape``, the middle
    ``x, y, z`` and the normal ``nx, ny, nz`` in scene units, ``area``.
    channel: "grey", "red", "green" or "blue".
    """

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

        "npz": T.npz, R.npz and K.npz, which scipy.sparse.load_npz reads, and vectors.npz for np.load, with Le, b, measure, ray_measure and
        patches. "petsc": T.petsc, R.petsc and K.petsc for PETSc's MatLoad, and Le.petsc, b.petsc, measure.petsc and ray_measure.petsc for
        VecLoad, in PETSc's binary format with real numbers of 64 and indices of 32 bits. Raises InputError for another format.
        """
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
    """L = Le + K Le + K² Le + … until it is known to be close enough, or known not to get there.

    K: (n, n), of scipy.sparse or dense, or the K of ``scene.operators()``. Le: (n,). error: of the sum, relative to its largest value. most: bounces. norm: a ≥ ‖K‖∞, as
    the largest albedo; it makes the bounds. measure: (n,), of each unknown; 1 without it.

    Returns a Report of
    sum (n,), which is the middle of the enclosure where that ended it;
    verdict, "converged", "rounding" (all that is left, and error is less), "limit" or "diverging", and why;
    warnings;
    rows, a structured array with a row a bounce: bounce, power Σ m|t|, l2, sup of the term t = K^n Le, ratio of powers, and bounds on
    ‖L − S_n‖∞: a_priori, a_posteriori (inf: there is none), estimate (no bound), enclosure_width, relative;
    rate, the ratio of the last terms;
    enclosure: exists, why not, low and high (n,), between which L lies, width, c1, c2 (Collatz and Wielandt's quotients).
    """
    operator = _operator(K, measure)
    made = run(_neumann.series(operator, real(Le, "Le"), error, most, norm), quiet)
    if not quiet:
        _report.warn(made["warnings"])
    made["rows"] = _report.rows(made["rows"], _bounds)
    made["enclosure"] = Report(made["enclosure"])
    return Report(made)


class Solutions(dict):
    """What solvers found, by their names; each is a Report as of solve().

    In a notebook it shows itself as a table.
    """

    def __init__(self, found: Dict[str, Report], about: Report) -> None:
        super().__init__(found)
        self.about = about
        """What was solved: the scene, the channel, its spectral radius."""

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
    """L = Le + K L by one of SOLVERS, or by several of them, or by "all".

    K: (n, n), of scipy.sparse or dense, or the K of ``scene.operators()``. Le: (n,). error: estimated, relative to ‖L‖∞, that ends a solver. most: applications of K.
    radius: spectral radius of K or a bound on it, which chebyshev needs, and which turns residuals into errors where ‖(I − K)⁻¹‖∞, for
    K ≥ 0, is not bounded by a few applications. lowest: the lowest
    eigenvalue where all are real; −radius without it. reflectance: (n,), ρ where K = diag(ρ) F with F reciprocal, for cg. exact: (n,), L
    where it is known, to see true errors. measure: (n,), of each unknown; 1 without it.

    Returns a Report of x (n,), verdict ("converged", "rounding", "limit", "diverging", "broke down", "refused"), why, applications
    of K, setup_applications of these, seconds, and history, a structured array: applications, estimate, error (nan where L is not known),
    seconds. Of several solvers: Solutions, these by name, and with "lu" among them the error of each to it. Raises InputError for an unknown solver.
    """
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
    """Norms and leading eigenvalues of K (n, n), of K* where adjoint is set.

    most: applications of K that the search may take; it ends sooner where it is foretold to take more. What is not found is a warning.

    Returns a Report of norms ("1", "2", "inf"; they belong to Σ m|f|, (Σ m f²)^½ and max |f|, m the measure, 1 without it: norm
    "1" is of power if K comes from a scene and m is its matrices().measure), spectral_radius, nan where it was not found, series ("converges" …), eigenvalues (count,) by falling modulus, eigenvectors (n, count), residuals, what was reached where not
    all were found, eigenvalues_converged, applications of K, why they were not found, and history, a structured array: applications,
    residual, the largest of all that are wanted, relative.
    """
    operator = _operator(K, measure)
    made = run(_neumann.spectrum_of(operator, count, adjoint, most), quiet)
    made["history"] = _report.rows(made["history"], ("applications", "residual"))
    if made["why"] and not quiet:
        _report.warn([f"eigenvalues were {made['why']}"])
    made["norms"] = Report(made["norms"])
    return Report(made)


def cube(n: int = 16) -> Report:
    """The inside of the unit cube with n × n patches a face, by exact form factors: ``K = albedo * cube(16).F``.

    Returns a Report of F (6n², 6n²), area (6n²,), face (6n²,): 0 and 1 for x = 0, 1; 2 and 3 for y; 4 the floor and 5 the ceiling.
    """
    F, area, face = run(_neumann.cube(n))
    return Report(F=F, area=area, face=np.array(face))
