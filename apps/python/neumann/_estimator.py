"""Estimators written in Python, for a study."""

from typing import Any, Callable, Dict

import numpy as np
from numpy.typing import ArrayLike

from ._report import Report

Estimator = Callable[[Report, int, np.random.Generator], ArrayLike]
"""A function of camera rays, the last bounce and random numbers that returns samples of K^i Le, (rays, bounces, 3)."""


def name_of(estimator: Estimator) -> str:
    """Returns the name of the estimator in a study."""
    return getattr(estimator, "__name__", type(estimator).__name__) + "()"


def from_rays(estimator: Estimator) -> Any:
    """Returns the function that the compiled part calls."""

    def call(rays: Dict[str, Any], bounces: int, seed: int) -> ArrayLike:
        return estimator(Report(rays), bounces, np.random.default_rng(seed))

    return call
