"""Photons: the light that paths from the lights deposit where they are reflected."""

import numpy as np
from numpy.typing import NDArray

from ._rows import Rows


class Photons(Rows):
    """The photons of a scene: ``scene.photons()``. Rows belong together; photons of a path follow each other.

    A photon lies at a point where light of bounce j − 1 arrives, which leaves as K^j Le. Surfaces that are only mirrors or glass
    have none.

    position: (n, 3), scene units. normal: (n, 3). wi: (n, 3), the direction to where the light came from.
    power: (n, 3), W in red, green and blue, divided by the number of paths: the sum over one bounce is the power that arrives.
    bounce: (n,), from 1 on. path: (n,), the number of the path from the light.
    caustic: (n,), whether the path met only mirrors and glass before.
    pixel: (n, 2), x and y on the film; pixel (0, 0) is from 0 to 1; nan if the camera does not see the photon directly."""

    position: NDArray[np.float64]
    normal: NDArray[np.float64]
    wi: NDArray[np.float64]
    power: NDArray[np.float64]
    bounce: NDArray[np.int32]
    path: NDArray[np.int32]
    caustic: NDArray[np.bool_]
    pixel: NDArray[np.float64]

    def __repr__(self) -> str:
        return f"<Photons: {len(self)} of bounces 1 to {self.bounce.max(initial=0)}>"
