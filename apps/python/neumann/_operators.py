"""K, T and R as operators of SciPy, without making a matrix."""

from functools import cached_property
from typing import Any, Callable, Optional

import numpy as np
import scipy.sparse
from numpy.typing import ArrayLike, NDArray
from scipy.sparse.linalg import LinearOperator, aslinearoperator

from . import _neumann
from ._display import Described
from ._patched import Patched, Vector

Product = Callable[[Vector], Vector]


class PatchOperator(LinearOperator):
    """A square matrix A (unknowns, unknowns), of which only the products A x and Aᵀ x are available."""

    def __init__(self, size: int, product: Product, transposed: Product, compiled: Optional["_neumann.Operator"] = None) -> None:
        super().__init__(np.float64, (size, size))
        self._product, self._transposed = product, transposed
        self.compiled = compiled
        """If this operator is K: K as the solvers of ``neumann.solve`` take it."""

    @staticmethod
    def _apply(product: Product, x: NDArray[Any]) -> NDArray[Any]:
        x = x.ravel()
        return product(x.real) + 1j * product(x.imag) if np.iscomplexobj(x) else product(x)

    def _matvec(self, x: NDArray[Any]) -> NDArray[Any]:
        return self._apply(self._product, x)

    def _rmatvec(self, x: NDArray[Any]) -> NDArray[Any]:
        return self._apply(self._transposed, x)


def _minus(A: LinearOperator) -> LinearOperator:
    return aslinearoperator(scipy.sparse.identity(A.shape[0])) - A


def _partial_sum(A: LinearOperator, terms: int) -> LinearOperator:
    """Returns Σ_{k<terms} A^k, by Horner's rule."""
    if terms < 1:
        raise _neumann.InputError(f"terms={terms}: expected 1 or more")

    def sum_with(product: Product) -> Product:
        def apply(x: Vector) -> Vector:
            y = x
            for _ in range(terms - 1):
                y = x + product(y)
            return y

        return apply

    return PatchOperator(A.shape[0], sum_with(A.matvec), sum_with(A.rmatvec))


def _diagonal(d: Vector) -> LinearOperator:
    return aslinearoperator(scipy.sparse.diags(d))


class Symmetrised(Described):
    """K with a reciprocal T as a symmetric matrix, for ``eigsh``, ``cg`` and ``minres``; all surfaces are diffuse.

    T is its own adjoint, but rays from one side sample it, so that this holds only in the mean. T̄ = (T + T*)/2 is exactly its own
    adjoint and has the same mean. With ρ the reflectance and M the measure, K̄ = ρ T̄ has the eigenvalues of

        S = (ρ M)^½ T̄ (ρ/M)^½,  which is symmetric,

    and L = Le + K̄ L follows from (I − S) z = b, b = (ρ M)^½ T̄ Le, by L = Le + (ρ/M)^½ z. ρ may be 0.

    S, I_minus_S: (unknowns, unknowns), LinearOperator. b: (unknowns,)."""

    def __init__(self, T: "_neumann.Operator", reflectance: Vector, Le: Vector) -> None:
        self._Le = Le
        self._right = np.sqrt(reflectance / T.measure)
        left = np.sqrt(reflectance * T.measure)

        def mean(f: Vector) -> Vector:
            return 0.5 * (T.apply(f) + T.apply_adjoint(f))

        def product(z: Vector) -> Vector:
            return left * mean(self._right * z)

        self.S: LinearOperator = PatchOperator(T.size, product, product)
        self.I_minus_S: LinearOperator = _minus(self.S)
        self.b: Vector = left * mean(Le)

    def field(self, z: ArrayLike) -> Vector:
        """Returns the field L = Le + (ρ/M)^½ z."""
        return self._Le + self._right * np.asarray(z)

    def mode(self, z: ArrayLike) -> NDArray[Any]:
        """Returns the eigenvector (ρ/M)^½ z of K̄ that belongs to the eigenvector z of S."""
        return self._right * np.asarray(z)

    def __repr__(self) -> str:
        return f"<Symmetrised K, {len(self.b)} × {len(self.b)}>"

    def series(self, terms: int = 4) -> LinearOperator:
        """Returns Σ_{k<terms} S^k, a preconditioner for ``cg``: positive definite if the spectral radius of S is below 1."""
        return _partial_sum(self.S, terms)


class Operators(Patched):
    """T, R, K = R T and I − K of one channel of a scene on patches: ``scene.operators()``. No matrix is made: products are computed
    by the compiled operators, on all processors, and take little more memory than the rays of T, four bytes each.

    All are LinearOperators (unknowns, unknowns), with ``rmatvec`` and ``.T``. The result of T has a value for each unknown, too:
    the mean incident radiance over the rays in its cell of directions. (In ``matrices()``, T has a row for each ray.)

    K, T, R, I_minus_K: the operators.
    Le, b: emitted radiance and K Le, (unknowns,), b sampled on the lights where the rays hardly meet them.
    measure: n² times area times projected solid angle of an unknown, (unknowns,), m²·sr: ⟨f, g⟩ = Σ measure · f · g.
    reflectance: ρ with K = diag(ρ) T, (unknowns,); None if a side is not diffuse.
    patches: as in ``matrices()``. channel: "grey", "red", "green" or "blue"."""

    def _transposed(self, adjoint: Product) -> Product:
        """Returns the product with Aᵀ = M A* M⁻¹."""
        return lambda x: self.measure * adjoint(x / self.measure)

    def _of(self, A: "_neumann.Operator", is_K: bool) -> PatchOperator:
        return PatchOperator(A.size, A.apply, self._transposed(A.apply_adjoint), A if is_K else None)

    @cached_property
    def _transport(self) -> "_neumann.Operator":
        return self._patched.T()

    @cached_property
    def K(self) -> LinearOperator:
        """R T, which is one bounce. ``neumann.solve(operators.K, operators.Le)``, ``series`` and ``spectrum`` take it, too."""
        return self._of(self._patched.K(), True)

    @cached_property
    def K_star(self) -> LinearOperator:
        """K* = M⁻¹ Kᵀ M, one bounce of importance: ⟨K f, g⟩ = ⟨f, K* g⟩."""
        K = self.K
        return PatchOperator(
            len(self.Le), lambda x: K.rmatvec(self.measure * x) / self.measure, lambda x: self.measure * K.matvec(x / self.measure)
        )

    @cached_property
    def T(self) -> LinearOperator:
        """Maps exitant radiance to incident radiance."""
        return self._of(self._transport, False)

    @cached_property
    def R(self) -> LinearOperator:
        """Maps incident radiance to exitant radiance; R* has the entries of R."""
        reflect = self._patched.reflect
        return PatchOperator(len(self.Le), reflect, self._transposed(reflect))

    @cached_property
    def I_minus_K(self) -> LinearOperator:
        """I − K, for solvers of SciPy: ``gmres(operators.I_minus_K, operators.Le, M=operators.series())``."""
        return _minus(self.K)

    def series(self, terms: int = 4) -> LinearOperator:
        """Returns Σ_{k<terms} K^k, the truncated series, as a preconditioner for I − K: ``M=`` of SciPy's solvers."""
        return _partial_sum(self.K, terms)

    def jacobi(self) -> LinearOperator:
        """Returns diag(1 / (1 − K_uu)), a preconditioner for I − K that helps if surfaces see themselves."""
        return _diagonal(1.0 / (1.0 - self.K.compiled.diagonal()))

    def symmetrised(self) -> Symmetrised:
        """Returns K as a symmetric matrix. Raises InputError if a surface is not diffuse."""
        if self.reflectance is None:
            raise _neumann.InputError(f"{self.title}: expected diffuse surfaces alone; only of them K is made symmetric")
        return Symmetrised(self._transport, self.reflectance, self.Le)

    def __repr__(self) -> str:
        return f"<Operators of {self.title}, {self.channel}: {len(self.Le)} × {len(self.Le)}>"
