"""Records of an irradiance cache: points with known irradiance, which is interpolated nearby."""

import numpy as np
from numpy.typing import NDArray

from ._rows import Rows


class Records(Rows):
    """The records of an irradiance cache: ``scene.records()``. Rows belong together, in the order of placement.

    position: (n, 3), scene units. normal: (n, 3), on the side that reflects.
    radius: (n,), the distance up to which the record is used, scene units.
    seen: (n,), whether the camera uses the record; the others are only used by records.
    irradiance: (n, bounces, 3), W/m², red, green and blue: column k − 1 is E_k, of light that has been reflected k times before.
    pixel: (n, 2), x and y on the film; pixel (0, 0) is from 0 to 1; nan if the camera does not see the record directly."""

    position: NDArray[np.float64]
    normal: NDArray[np.float64]
    radius: NDArray[np.float64]
    seen: NDArray[np.bool_]
    irradiance: NDArray[np.float64]
    pixel: NDArray[np.float64]

    def __repr__(self) -> str:
        return f"<Records: {len(self)} of bounces 1 to {self.irradiance.shape[1]}, of which the camera reads {self.seen.sum()}>"
