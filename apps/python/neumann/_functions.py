"""T and R of functions written in Python, as on a lecture's slide: an operator takes a function of points and directions and
returns another one."""

from typing import Any, Callable, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _neumann
from ._numbers import real
from ._rays import AnyPoints, Points, RayQueries

Field = Callable[[Any, Any], ArrayLike]
"""A function f(x, ω) of n points and of n directions (n, 3) of unit length, which point away from the surface: (n, 3), by channel."""


def _rows(given: ArrayLike, count: int, what: str) -> NDArray[np.float64]:
    array = real(given, what)
    if array.shape != (count, 3):
        raise _neumann.InputError(f"{what}: an array of shape {array.shape}, expected ({count}, 3)")
    return array


class FieldOperator:
    """A linear operator on functions: ``g = T(f)`` is a function, too, and ``(R @ T)(f)`` is ``R(T(f))``."""

    def __init__(self, name: str, apply: Callable[[Field], Field]) -> None:
        self._name, self._apply = name, apply

    def __call__(self, f: Field) -> Field:
        """Returns the function that this operator makes of f. Raises InputError."""
        if not callable(f):
            raise _neumann.InputError(f"{self._name}: {f!r}, expected a function of points and directions")
        return self._apply(f)

    def __matmul__(self, other: "FieldOperator") -> "FieldOperator":
        """Returns the operator that applies the other one first."""
        return FieldOperator(f"{self._name} @ {other._name}", lambda f: self(other(f)))

    def __repr__(self) -> str:
        return f"<FieldOperator {self._name}>"

    def _repr_html_(self) -> str:
        return f"<p>{self._name}, an operator on functions of points and directions</p>"


class OnFunctions(RayQueries):
    """A scene whose Le is a function, and whose T and R make functions of functions."""

    def Le(self, x: Points, w: ArrayLike) -> NDArray[np.float64]:
        """Returns the emitted radiance, (n, 3), W·m⁻²·sr⁻¹: a Field.

        x: Points. w: (n, 3), back along the rays that found the points; T and R call a field with these. Where nothing is hit, it
        is the light from afar."""
        return x.emission

    @property
    def T(self) -> FieldOperator:
        """Transport, (T f)(x, ω) = f(tr(x, ω), −ω): a function of what leaves becomes one of what arrives.

        x may be Points or an array (n, 3) of points in space. Where nothing is seen, f is called with ``hit`` False and a position
        of nan, and returns what arrives from afar, such as 0. ``T(f)(x, w)`` raises InputError if x and w are not what intersect()
        takes, or if the values of f are not finite numbers, (n, 3)."""

        def transported(f: Field) -> Field:
            def arriving(x: AnyPoints, w: ArrayLike) -> NDArray[np.float64]:
                y = self.intersect(x, w)
                return _rows(f(y, -np.asarray(w, dtype=float)), len(y), "f")

            return arriving

        return FieldOperator("T", transported)

    def R(self, samples: int = 1, *, seed: Union[int, np.random.Generator] = 0) -> FieldOperator:
        """Reflection, (R g)(x, ωo) = ∫ fs(x, ωi → ωo) g(x, ωi) cos θi dωi, of diffuse surfaces: a function of what arrives becomes
        one of what leaves. Each of its values is an unbiased estimate.

        samples: directions for each value, with the pdf cos θi / π. In ``R(T(R(T(f))))`` their numbers multiply. seed: of their
        random numbers, or a numpy.random.Generator; numbers are never used twice, so no value is repeated.

        ``R(g)(x, w)`` is 0 where x is nothing or w is behind x.normal. It raises InputError if x are not Points, for their
        reflectance, or not all diffuse, and for values as T does. Lights without extent are met by no direction: for them add
        what sample_lights() gives."""
        if samples < 1:
            raise _neumann.InputError(f"samples={samples}: expected 1 or more")
        random = np.random.default_rng(seed)

        def reflected(g: Field) -> Field:
            def leaving(x: Points, w: ArrayLike) -> NDArray[np.float64]:
                if not isinstance(x, Points):
                    raise _neumann.InputError(f"x: {type(x).__name__}, expected Points, which know their reflectance")
                leaves = np.einsum("ij,ij->i", x.normal, _rows(w, len(x), "w")) > 0
                rows = np.flatnonzero(x.hit & leaves)
                unknown = np.isnan(x.reflectance[rows]).any(axis=1)
                if unknown.any():
                    row = rows[unknown][0]
                    raise _neumann.InputError(f"x: row {row} is on a surface that is not diffuse, expected a reflectance")
                at = x[np.repeat(rows, samples)]
                sphere = random.normal(size=(len(at), 3))
                wi = at.normal + sphere / np.linalg.norm(sphere, axis=1, keepdims=True)
                g_i = _rows(g(at, wi / np.linalg.norm(wi, axis=1, keepdims=True)), len(at), "g")
                result = np.zeros((len(x), 3))
                result[rows] = x.reflectance[rows] * g_i.reshape(len(rows), samples, 3).mean(axis=1)  # fs cos θ / pdf = ρ
                return result

            return leaving

        return FieldOperator("R", reflected)
