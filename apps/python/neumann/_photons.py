"""Photons: what paths from the lights leave where they are reflected."""

import numpy as np
from numpy.typing import NDArray

from ._rows import Rows


class Photons(Rows):
    """Photons of a scene: ``scene.photons()``. Rows belong together, path by path.

    Photon p lies where light of bounce j − 1 arrives that leaves as K^j Le. Surfaces that are mirrors or glass alone have none.

    position: (n, 3), scene units. normal: (n, 3). wi: (n, 3), towards where it came from.
    power: (n, 3), W in red, green and blue, as a part of that of all paths: their sum over one bounce is the power that arrives.
    bounce: (n,), from 1 on. path: (n,), the number of the path from the light.
    caustic: (n,), whether the path has met mirrors and glass alone before.
    pixel: (n, 2), x and y on the film, pixel (0, 0) from 0 to 1; nan where the camera does not see it directly.
    """

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
