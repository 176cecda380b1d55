"""Converts arrays of callers to numbers, without loss."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._neumann import InputError


def real(given: ArrayLike, what: str, *, finite: bool = True) -> NDArray[np.float64]:
    """Converts to doubles. Raises InputError, "what: …", for complex numbers, for values that are no numbers and, if ``finite``,
    for NaN and infinity."""
    array = np.asarray(given)
    if array.dtype.kind == "c":
        raise InputError(f"{what}: complex numbers, expected real ones")
    try:
        array = array.astype(float, copy=False)
    except (TypeError, ValueError):
        raise InputError(f"{what}: {array.dtype}, expected numbers") from None
    if finite and not np.isfinite(array).all():
        at = tuple(int(i) for i in np.argwhere(~np.isfinite(array))[0])
        raise InputError(f"{what}{list(at) or ''}: {array[at]}, expected finite numbers")
    return array


def whole(given: ArrayLike, what: str) -> NDArray[np.int64]:
    """Converts to integers. Raises InputError for fractions, and for True and False, which are a mask."""
    array = np.asarray(given)
    if array.dtype.kind == "b":
        raise InputError(f"{what}: True and False, expected whole numbers")
    if array.dtype.kind in "iu":
        return array.astype(np.int64)
    array = real(array, what)
    fractions = np.argwhere(array != np.rint(array))
    if len(fractions):
        at = tuple(int(i) for i in fractions[0])
        raise InputError(f"{what}{list(at)}: {array[at]}, expected whole numbers")
    return array.astype(np.int64)
