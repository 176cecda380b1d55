"""What a scene answers to many rays at once: for estimators written in Python."""

from typing import Any, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _neumann
from ._display import Described


class _Rows(Described):
    """Rows that are chosen together."""

    def __init__(self, made: Any) -> None:
        self._made = made
        vars(self).update(made.arrays())

    def __len__(self) -> int:
        """How many there are."""
        return len(self._made)

    def __getitem__(self, chosen: Any) -> Any:
        """Some of them, by a mask, by numbers or as a slice."""
        return type(self)(self._made.take(np.atleast_1d(np.arange(len(self))[chosen])))


class Points(_Rows):
    """What rays hit first: ``scene.intersect(origin, direction)``. ``points[points.hit]`` are those that hit something; they are origins of
    further rays, which start on the right side of their surface however it is rounded.

    hit: (n,). distance: (n,), scene units; inf where nothing is hit. position: (n, 3); nan where nothing is hit.
    normal: (n, 3), unit length, on the side that is hit, with interpolated and bumpy normals as the material has them.
    emission: (n, 3), Le towards where the ray came from, that of the environment where nothing is hit; W·m⁻²·sr⁻¹.
    reflectance: (n, 3), ρ = π fs of that side: 0 where it absorbs all, nan where it is not diffuse.
    shape, primitive: (n,), the shape's number in the scene, and the triangle's in the shape; −1 where nothing is hit.
    """

    hit: NDArray[np.bool_]
    distance: NDArray[np.float64]
    position: NDArray[np.float64]
    normal: NDArray[np.float64]
    emission: NDArray[np.float64]
    reflectance: NDArray[np.float64]
    shape: NDArray[np.int32]
    primitive: NDArray[np.int32]

    def __repr__(self) -> str:
        return f"<Points of {len(self)} rays, of which {np.count_nonzero(self.hit)} hit something>"


class LightPoints(_Rows):
    """Samples of light for points: ``scene.sample_lights(points, u)``. Lights are chosen half by power and half evenly, and points on them
    by area, so they do not depend on the point that they are for.

    weight: (n, 3), Le towards the point over the pdf; of a light without extent the irradiance on a surface that faces it. pdf: (n,), of
    the direction, per solid angle at the point, sr⁻¹; 0 where the light faces away, inf if it has no extent. density: (n,), the same
    sample's per area of the light, in scene units; nan where light comes from no surface.
    direction: (n, 3), towards it. position, normal: (n, 3), of the light; if it is infinitely far away, a point beyond the scene.
    """

    weight: NDArray[np.float64]
    pdf: NDArray[np.float64]
    density: NDArray[np.float64]
    direction: NDArray[np.float64]
    position: NDArray[np.float64]
    normal: NDArray[np.float64]

    def __repr__(self) -> str:
        return f"<LightPoints: {len(self)} samples>"


AnyPoints = Union[Points, LightPoints, ArrayLike]
"""Points on surfaces, or an array (n, 3) of points in space."""


def compiled(points: AnyPoints) -> Any:
    """As the compiled part takes them."""
    return points._made if isinstance(points, _Rows) else points
