"""Queries about many rays at once, for estimators written in Python."""

from typing import Any, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _neumann
from ._report import Report
from ._rows import Rows


class _Points(Rows):
    """Points that are selected together."""

    def __init__(self, made: Any) -> None:
        super().__init__(made.arrays())
        self._made = made

    def __getitem__(self, chosen: Any) -> Any:
        """Returns some of the points, by a mask, by numbers or as a slice."""
        return type(self)(self._made.take(np.atleast_1d(np.arange(len(self))[chosen])))


class Points(_Points):
    """The first hits of rays: ``scene.intersect(origin, direction)``. ``points[points.hit]`` are those of rays that hit something;
    they can be origins of further rays, which start on the right side of their surface, whatever the rounding.

    hit: (n,). distance: (n,), scene units; inf if nothing is hit. position: (n, 3); nan if nothing is hit.
    normal: (n, 3), unit length, on the side that is hit, with interpolated and bumpy normals as the material has them.
    emission: (n, 3), Le towards the origin of the ray, or that of the environment if nothing is hit; W·m⁻²·sr⁻¹.
    reflectance: (n, 3), ρ = π fs of that side: 0 if it absorbs all light, nan if it is not diffuse.
    shape, primitive: (n,), the number of the shape in the scene, and of the triangle in the shape; −1 if nothing is hit."""

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


class LightPoints(_Points):
    """Samples of light for points: ``scene.sample_lights(points, u)``. The probability of a light is one half by its power, and one
    half equal for all lights. Points on a light are chosen by area, so that they do not depend on the point that they are for.

    weight: (n, 3), Le towards the point, divided by the pdf; for a light without extent, the irradiance on a surface that faces it.
    pdf: (n,), of the direction, per solid angle at the point, sr⁻¹; 0 if the light faces away, inf if it has no extent.
    density: (n,), the pdf of the same sample per area of the light, in scene units; nan if the light comes from no surface.
    direction: (n, 3), towards the light. position, normal: (n, 3), of the light.
    If the light is infinitely far away, position is a point beyond the scene."""

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


def _compiled(points: AnyPoints) -> Any:
    """Converts points for the compiled part."""
    return points._made if isinstance(points, _Points) else points


class RayQueries:
    """A scene that answers queries about many rays at once."""

    _scene: "_neumann.Scene"

    def camera_rays(self, samples: int = 1, *, first: int = 0, seed: int = 0) -> Report:
        """Returns rays of the camera for samples first … first + samples − 1 of every pixel, ordered by sample, then row by row.

        The Report holds origin and direction (n, 3), unit length; length (n,), up to the far plane; pixel (n, 2), column and row;
        and weight (n,): a pixel is the mean of weight times radiance,
        ``(weight[:, None] * L).reshape(samples, height, width, 3).mean(axis=0)``. Raises InputError."""
        return Report(_neumann.camera_rays(self._scene, samples, first, seed))

    def intersect(self, origin: AnyPoints, direction: ArrayLike, length: Optional[ArrayLike] = None) -> Points:
        """Returns the first hits of rays, tr(x, ω).

        origin: an array (n, 3) of points in space, or Points or LightPoints, which know their surfaces. direction: (n, 3), of any
        length but 0. length: (n,), of rays from points in space; default infinite. Runs on all processors, without Python's lock.
        Raises InputError."""
        return Points(_neumann.intersect(self._scene, _compiled(origin), direction, length))

    def seen(self, rays: Report) -> Points:
        """Returns what the camera sees along rays of camera_rays(). If the scene has hide_emitters, the camera sees through lights
        and the environment, and intersect() does not. Raises InputError."""
        return Points(_neumann.seen(self._scene, rays.origin, rays.direction, rays.length))

    def visible(self, a: AnyPoints, b: AnyPoints) -> NDArray[np.bool_]:
        """Returns whether the points of each pair see each other, V(a, b), (n,). Points are Points, LightPoints, or arrays (n, 3)
        of points in space, which must not be on a surface. Raises InputError."""
        return _neumann.visible(self._scene, _compiled(a), _compiled(b))

    def sample_lights(self, points: AnyPoints, u: ArrayLike) -> LightPoints:
        """Returns a sample of light for each of n points, from random numbers u (n, 2) in [0, 1). Visibility is not tested; for
        that use ``visible(points, lights)``. Raises InputError."""
        return LightPoints(_neumann.sample_lights(self._scene, _compiled(points), u))
