"""Compares pictures and series with others."""

from os import PathLike, fsencode
from pathlib import Path
from typing import Any, Optional, Union

import numpy as np
from numpy.typing import NDArray

from . import _neumann
from ._bounces import Bounce, BounceSeries, read
from ._numbers import real
from ._report import Report
from ._sources import Pictures


def _picture(x: "Comparable") -> Optional[Pictures]:
    """Returns a picture with its errors, from memory or a file; None for a series."""
    if isinstance(x, (str, PathLike)):
        return None if Path(x).is_dir() else _neumann.read(fsencode(x))
    if isinstance(x, Bounce):
        return x._pictures
    return None if isinstance(x, BounceSeries) else (real(x, "a picture", finite=False), None, None, None, None)


AnyPicture = Union[Bounce, NDArray[Any], str, "PathLike[str]"]
Comparable = Union[BounceSeries, AnyPicture]


def flip(a: AnyPicture, b: AnyPicture) -> NDArray[np.float32]:
    """HDR-FLIP of a picture a against the reference b (Andersson et al. 2021): how different they look to somebody who alternates
    between them on a 4K monitor, in each pixel from 0 to 1, (height, width). Its mean is the FLIP of ``neumann compare --flip``.

    Each is a bounce, an array (height, width, 3) or a file, taken as linear. Raises InputError if their sizes differ."""
    pictures = [_picture(x) for x in (a, b)]
    if not all(pictures):
        raise _neumann.InputError("a series; FLIP is of two pictures, as series[2] is one")
    return _neumann.flip(*(picture[0] for picture in pictures if picture))


def compare(a: Comparable, b: Comparable, *, flip: bool = False) -> Any:
    """Returns how far a is from the reference b, as ``neumann compare`` does.

    Two pictures, each a bounce, an array (height, width, 3) or a file, taken as linear, give a Report: rmse, rel_mse, mape, smape,
    max_error, mean, reference_mean, mean_difference and mean_difference_interval95, half of the interval of the latter: None if a
    file does not hold it; an array counts as exact. Means are over pixels and channels, fractions and not percent, with ε = 0.01:
    RMSE² (a−b)², relMSE (a−b)²/(b²+ε·mean(b)²), MAPE |a−b|/(|b|+ε·mean|b|), SMAPE 2|a−b|/(|a|+|b|+ε·(mean|a|+mean|b|)).

    Two series, or folders of renders, give a structured array with a row for each picture that both have ("bounce_000" …,
    "sum_000" …, and "rest" if they end at the same bounce). ``rmse_by_noise`` is the RMSE that standard errors alone explain. With
    flip, ``flip`` is the mean of ``neumann.flip``, which takes about a second for a picture of 512 × 512 pixels. Raises InputError
    if sizes differ."""

    def errors_of(x: Any, y: Any) -> Any:
        figures = _neumann.compare(x[0], y[0], x[3], y[3], x[4], y[4])
        return {**figures, "flip": float(_neumann.flip(x[0], y[0]).mean(dtype=np.float64))} if flip else figures

    pictures = [_picture(x) for x in (a, b)]
    if all(pictures):
        return Report(errors_of(*pictures))
    if any(pictures):
        raise _neumann.InputError("a series against a picture; compare a picture with a picture, as series[2] is one")
    a, b = (x if isinstance(x, BounceSeries) else read(x) for x in (a, b))
    both, rows = range(min(len(a), len(b))), []

    def of(series: BounceSeries, kind: str, i: int) -> Any:
        return tuple(None if pictures is None else pictures[i] for pictures in getattr(series, kind))

    for name, kind in (("bounce", "_terms"), ("sum", "_sums")):
        for i in both:
            rows.append((f"{name}_{i:03}", errors_of(of(a, kind, i), of(b, kind, i))))
    if a.rest is not None and b.rest is not None and len(a) == len(b):
        rows.append(("rest", errors_of(a._rest, b._rest)))
    columns = [name for name in rows[0][1] if name not in ("pixels", "not_finite")]
    result = np.empty(len(rows), dtype=[("picture", "U12")] + [(name, np.float64) for name in columns])
    for row, (name, figures) in zip(result, rows):
        row["picture"] = name
        for column in columns:
            row[column] = np.nan if figures[column] is None else figures[column]
    return result
