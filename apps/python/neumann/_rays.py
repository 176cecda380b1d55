"""What a scene answers to many rays at once: for estimators written in Python."""

from typing import Any, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _neumann
from ._report import Report
from ._rows import Rows


class _Points(Rows):
    """Points that are chosen together."""

    def __init__(self, made: Any) -> None:
        super().__init__(made.arrays())
        self._made = made

    def __getitem__(self, chosen: Any) -> Any:
        """Some of them, by a mask, by numbers or as a slice."""
        return type(self)(self._made.take(np.atleast_1d(np.arange(len(self))[chosen])))


class Points(_Points):
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


class LightPoints(_Points):
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


def _compiled(points: AnyPoints) -> Any:
    """As the compiled part takes them."""
    return points._made if isinstance(points, _Points) else points


class RayQueries:
    """A scene that is asked about many rays at once."""

    _scene: "_neumann.Scene"

    def camera_rays(self, samples: int = 1, *, first: int = 0, seed: int = 0) -> Report:
        """Rays of the camera, of samples first … first + samples − 1 of every pixel: sample by sample, in each row by row.

        A Report of origin and direction (n, 3), unit length; length (n,), up to the far plane; pixel (n, 2), column and row; and weight
        (n,): a pixel is the mean of weight times radiance, ``(weight[:, None] * L).reshape(samples, height, width, 3).mean(axis=0)``. Raises
        InputError.
        """
        return Report(_neumann.camera_rays(self._scene, samples, first, seed))

    def intersect(self, origin: AnyPoints, direction: ArrayLike, length: Optional[ArrayLike] = None) -> Points:
        """What rays hit first, tr(x, ω).

        origin: an array (n, 3) of points in space, or Points and LightPoints, which know their surfaces. direction: (n, 3), of any length
        but 0. length: (n,), of rays from space; without it they are endless. On all processors, without Python's lock. Raises InputError.
        """
        return Points(_neumann.intersect(self._scene, _compiled(origin), direction, length))

    def seen(self, rays: Report) -> Points:
        """What the camera sees along rays of camera_rays(). Where the scene has hide_emitters it sees through lights and through the
        environment, which intersect() does not. Raises InputError."""
        return Points(_neumann.seen(self._scene, rays.origin, rays.direction, rays.length))

    def visible(self, a: AnyPoints, b: AnyPoints) -> NDArray[np.bool_]:
        """Whether points see each other, V(a, b), pair by pair: (n,). They are Points, LightPoints, or arrays (n, 3) of points in space, which
        are not to be on a surface. Raises InputError."""
        return _neumann.visible(self._scene, _compiled(a), _compiled(b))

    def sample_lights(self, points: AnyPoints, u: ArrayLike) -> LightPoints:
        """A sample of light for each of n points, by random numbers u (n, 2) from 0 to below 1. It does not look whether it is seen; ask
        ``visible(points, lights)``. Raises InputError."""
        return LightPoints(_neumann.sample_lights(self._scene, _compiled(points), u))
