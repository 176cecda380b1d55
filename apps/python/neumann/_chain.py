"""A Markov chain among the paths of one bounce."""

from typing import Any, Dict

import numpy as np
from numpy.typing import NDArray

from ._rows import Rows


class Chain(Rows):
    """The states of a Markov chain, one after the other: ``scene.chain(bounce)``.

    A state is a path from both ends: s vertices from the light, bounce + 2 − s from the camera, made from random numbers. The chain
    visits states in proportion to their size.

    position: (n, 2), x and y on the film; pixel (0, 0) is from 0 to 1. s: (n,). size: (n,), the mean over channels of the path's
    contribution to a pixel's radiance, times the number of pixels. accepted: (n,), False where the step was rejected and the state
    is the previous one again. large: (n,), True where the step drew all random numbers anew, False where it moved them a little."""

    position: NDArray[np.float64]
    s: NDArray[np.int32]
    size: NDArray[np.float64]
    accepted: NDArray[np.bool_]
    large: NDArray[np.bool_]

    def __init__(self, made: Dict[str, Any], bounce: int) -> None:
        super().__init__(made)
        self.bounce = bounce

    def __repr__(self) -> str:
        return f"<Chain of {len(self)} states of bounce {self.bounce}, {self.accepted[1:].mean() if len(self) > 1 else 1.0:.0%} of steps accepted>"
