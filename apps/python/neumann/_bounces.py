"""A rendered series: its bounces, sums and rest."""

import html
from functools import cached_property
from os import PathLike, fsencode, fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any, List, NamedTuple, Optional, Sequence, Tuple, Union, overload

import numpy as np
from numpy.typing import NDArray

from . import _neumann, _report
from ._display import as_facts, frame, large, row, show, small
from ._progress import run as run_job
from ._report import Report
from ._sources import Folder, Memory, Picture, Pictures, Source

if TYPE_CHECKING:
    import pandas
    import xarray


_shown_at_most = 12  # pictures in a row of a notebook


def _mean(figures: Any) -> str:
    if figures.get("mean") is None:
        return ""
    interval = figures.get("interval95")
    return f"mean {figures['mean']:.4g}" + (f" ± {interval:.1g}" if isinstance(interval, float) else "")


def _exposure_of(series: "BounceSeries") -> float:
    """Returns the exposure for all pictures of a series, so that their brightness can be compared."""
    importance = series.run.quantity.name.startswith("importance")
    return _neumann.exposure(series.sums[-1], series.sums[-1] if importance else series.terms[0])


def _strip(series: "BounceSeries") -> str:
    """Returns HTML that shows the bounces and sums of a series."""
    run, shown = series.run, min(series.bounces + 1, _shown_at_most)
    exposure = _exposure_of(series)
    terms = [(series.terms[i], f"bounce {i}", _mean(run.bounces[i])) for i in range(shown)]
    if series.rest is not None and shown == series.bounces + 1:
        terms.append((series.rest, f"rest, beyond {series.bounces}", _mean(run.rest)))
    sums = [(series.sums[i], "sum 0" if i == 0 else f"sum 0..{i}", "") for i in range(shown)]
    more = "" if shown > series.bounces else f" (the first {shown} of {series.bounces + 1} bounces)"
    note = f"{series.title}; exposure × {exposure:.3g}, sRGB{more}"
    return f"<div>{row(terms, exposure)}{row(sums, exposure)}<div style='font-size: 85%'>{html.escape(note)}</div></div>"


def _of_bounces(bounces: List["Bounce"], exposure: float, height: int) -> str:
    """Returns HTML that shows some bounces."""
    figures = [(b.value, f"bounce {b.bounce}", f"mean {b.mean:.4g}") for b in bounces]
    return row(figures, exposure, height)


class Way(NamedTuple):
    """One way (s, t) to make a bounce: with s vertices from the light and t from the camera."""

    s: int
    t: int
    weighted: Picture
    """The part of the picture that this way makes, with its weight; (height, width, 3)."""
    unweighted: Picture
    """The estimate of the bounce from this way alone; (height, width, 3)."""

    def __repr__(self) -> str:
        return f"<Way s={self.s}, t={self.t}: mean {self.weighted.mean():.4g}, {self.unweighted.mean():.4g} by itself>"

    def _repr_html_(self) -> str:
        return as_facts(self._asdict(), "")


class Bounce:
    """K^i Le as the camera sees it: ``series[i]``. NumPy takes a Bounce as its value.

    bounce: i. value: (height, width, 3), with stderr, spread and discretisation of the same shape, as in the series; None if they
    are not known. mean: over pixels and channels."""

    def __init__(self, bounce: int, pictures: Pictures, series: "BounceSeries") -> None:
        self.bounce = bounce
        self.value, self.stderr, self.discretisation, self.spread, _ = self._pictures = pictures
        self.mean = float(self.value.mean(dtype=np.float64))
        self._series = series

    def __array__(self, dtype: Any = None, copy: Any = None) -> NDArray[Any]:
        return np.array(self.value, dtype=dtype) if copy else np.asarray(self.value, dtype=dtype)

    def show(self) -> None:
        """Shows the bounce in a notebook, or in the browser."""
        picture = _of_bounces([self], _exposure_of(self._series), large)
        show(picture, picture)

    def __repr__(self) -> str:
        height, width, _ = self.value.shape
        return f"<Bounce {self.bounce} of {self._series.title}: {width} × {height} pixels, mean {self.mean:.4g}>"

    def _repr_html_(self) -> str:
        return _of_bounces([self], _exposure_of(self._series), small)


class Bounces(List[Bounce]):
    """Some bounces of a series: ``series[1:4]``."""

    def __repr__(self) -> str:
        return f"<Bounces {', '.join(str(b.bounce) for b in self)}>"

    def _repr_html_(self) -> str:
        return _of_bounces(self, _exposure_of(self[0]._series), small) if self else ""


class BounceSeries:
    """The terms K^i Le of a scene as its camera sees them, bounces 0 … N, with their sums and the rest, which they leave out.

    Pictures are float32, scene-linear RGB, as in the files; row 0 is on top. Radiance is in W·m⁻²·sr⁻¹, importance in m⁻²·sr⁻¹. A
    standard error is that of a pixel and channel; mean ± t · stderr is a 95% interval, with Student's t of
    ``run.samples.degrees_of_freedom``. A standard error of inf is not known, as after a single replicate. Where the mean is 0 and
    the standard error is not, no sample met any light, and t · stderr is an upper bound; where both are 0, the pixel is known to be
    dark. A pixel's stderr includes what few samples leave open, however well they agree; its spread does not, and is the one to use
    for means over pixels.

    ``series[2]`` is a Bounce, ``series[1:4]`` are some of them. ``a + b`` is the render of the samples of both, which must have the
    same scene, method and bounces, and different seeds. A notebook shows a series as two rows, bounces and sums, at one exposure.
    """

    def __init__(self, source: Any, title: str) -> None:
        self._source: Source = source
        self.title = title
        """The name of the scene or of the folder."""
        self.bounces: int = source.bounces
        """N, the last bounce with a picture of its own."""

    def _all(self, kind: str) -> List[Pictures]:
        return [self._source.picture(kind, i) for i in range(self.bounces + 1)]

    @staticmethod
    def _stack(pictures: List[Pictures]) -> Tuple[Any, ...]:
        def stacked(which: int) -> Optional[Picture]:
            found = [p[which] for p in pictures]
            return None if any(f is None for f in found) else np.stack(found)  # type: ignore[arg-type]

        return *(stacked(which) for which in range(4)), [p[4] for p in pictures]

    @cached_property
    def _terms(self) -> Tuple[Any, ...]:
        return self._stack(self._all("bounce"))

    @cached_property
    def _sums(self) -> Tuple[Any, ...]:
        return self._stack(self._all("sum"))

    @cached_property
    def _rest(self) -> Pictures:
        return self._source.rest() or (None, None, None, None, None)  # type: ignore[return-value]

    @property
    def terms(self) -> Picture:
        """K^i Le, (N + 1, height, width, 3)."""
        return self._terms[0]

    @property
    def terms_stderr(self) -> Picture:
        """The standard errors of the terms, (N + 1, height, width, 3)."""
        return self._terms[1]

    @property
    def terms_spread(self) -> Picture:
        """Standard errors of the terms from the samples' spread alone, for means over pixels, (N + 1, height, width, 3)."""
        return self._terms[3]

    @property
    def terms_discretisation(self) -> Optional[Picture]:
        """The estimated error of terms due to patches, photon maps or caches, (N + 1, height, width, 3); None without these."""
        return self._terms[2]

    @property
    def sums(self) -> Picture:
        """Σ_{k≤i} K^k Le, (N + 1, height, width, 3)."""
        return self._sums[0]

    @property
    def sums_stderr(self) -> Picture:
        """The standard errors of the sums, (N + 1, height, width, 3); not the sums of those of terms, which share walks."""
        return self._sums[1]

    @property
    def sums_spread(self) -> Picture:
        """Standard errors of the sums from the samples' spread alone, for means over pixels, (N + 1, height, width, 3)."""
        return self._sums[3]

    @property
    def sums_discretisation(self) -> Optional[Picture]:
        """The estimated error of sums due to patches, photon maps or caches, (N + 1, height, width, 3); None without these."""
        return self._sums[2]

    @property
    def rest(self) -> Optional[Picture]:
        """Σ_{k>N} K^k Le, which the pictures leave out, (height, width, 3); None if it was not measured."""
        return self._rest[0]

    @property
    def rest_stderr(self) -> Optional[Picture]:
        """The standard error of the rest, (height, width, 3)."""
        return self._rest[1]

    @property
    def rest_spread(self) -> Optional[Picture]:
        """The standard error of the rest from the samples' spread alone, for means over pixels, (height, width, 3)."""
        return self._rest[3]

    @cached_property
    def table(self) -> NDArray[Any]:
        """series.csv as a structured array with a row for each bounce: ``table["mean"]``, ``"mean_stderr"``, ``"ratio"``,
        ``"bound"`` (on the sum of later bounces, in the maximum norm; inf: there is no bound), ``"rays"``, ``"seconds"``,
        ``"interval95"`` (half of it)."""
        return _report.table(self._source.table(), counts=("bounce", "rays"))

    @cached_property
    def convergence(self) -> NDArray[Any]:
        """convergence.csv as a structured array with a row for each doubling of the samples: ``"samples"``, ``"seconds"``,
        ``"rays"``, ``"relative_stderr_000"`` … and, given a reference, ``"relative_error_000"`` …"""
        return _report.table(self._source.convergence(), counts=("samples", "rays"))

    @cached_property
    def run(self) -> Report:
        """run.json, with all that is needed to repeat and to judge the run: ``run.health``, ``run.plan``, ``run.samples`` …"""
        return _report.from_json(self._source.run())

    @property
    def warnings(self) -> List[str]:
        """The warnings of render()."""
        return self._source.warnings()

    @cached_property
    def ways(self) -> Optional[List[Way]]:
        """All ways to make bounce i, if method="bidirectional" was given ``ways=i``; otherwise None."""
        found = self._source.ways()
        return None if found is None else [Way(*way) for way in found]

    def save(self, folder: Union[str, "PathLike[str]"], files: Optional[Sequence[str]] = None) -> None:
        """Writes the files of ``neumann render -o folder``: EXR files, tables, run.json, contact sheet, and the explorer,
        index.html. files: the groups of ``--files`` that are written, such as ("pictures", "tables"); default all. ("touch",) writes
        touch.html, and raises InputError if a material is not diffuse.

        The folder is written as a whole or not at all. Raises InputError if the folder cannot be written, and RunError if a disk is
        full."""
        self._source.save(fsencode(folder), files)

    def show(self, bounce: Optional[int] = None) -> None:
        """Shows a bounce, or all bounces and sums: below the cell of a notebook, elsewhere in the browser."""
        if bounce is not None:
            self[bounce].show()
        else:
            show(_strip(self), _strip(self))

    def page(self, height: int = 800) -> None:
        """Shows the explorer, the index.html of ``save()``: below the cell of a notebook, ``height`` pixels high, or in the
        browser."""
        page = self._source.page()
        show(frame(page, height), page)

    def to_xarray(self) -> "xarray.Dataset":
        """Returns an xarray.Dataset with ``term``, ``sum`` (bounce, y, x, channel) and ``rest`` (y, x, channel), each with its
        _stderr, _spread and _discretisation if there are any."""
        import xarray

        axes = ("bounce", "y", "x", "channel")
        kinds = (("term", self._terms, axes), ("sum", self._sums, axes), ("rest", self._rest, axes[1:]))
        arrays = {
            name + suffix: (dimensions, pictures[which])
            for name, pictures, dimensions in kinds
            for which, suffix in enumerate(("", "_stderr", "_discretisation", "_spread"))
            if pictures[which] is not None
        }
        coordinates = {"bounce": np.arange(len(self)), "channel": ["r", "g", "b"]}
        return xarray.Dataset(arrays, coordinates, {"scene": self.title, "quantity": self.run.quantity.name, "units": self.run.quantity.unit})

    def to_pandas(self) -> "pandas.DataFrame":
        """Returns ``table`` as a pandas.DataFrame with a row for each bounce."""
        import pandas

        return pandas.DataFrame(self.table).set_index("bounce")

    def __len__(self) -> int:
        """The number of bounces with a picture of their own, including bounce 0."""
        return self.bounces + 1

    @overload
    def __getitem__(self, which: int) -> Bounce: ...
    @overload
    def __getitem__(self, which: slice) -> Bounces: ...
    def __getitem__(self, which: Union[int, slice]) -> Union[Bounce, Bounces]:
        """Returns bounce i, counted from the last if i is negative, or the bounces of a slice."""
        if isinstance(which, slice):
            return Bounces(self[i] for i in range(*which.indices(len(self))))
        i = which + len(self) if which < 0 else which
        if not 0 <= i < len(self):
            raise IndexError(f"bounce {which}: there are bounces 0 to {self.bounces}")
        return Bounce(i, self._source.picture("bounce", i), self)

    def __add__(self, other: "BounceSeries") -> "BounceSeries":
        """Returns the render of all samples of both, as ``neumann merge`` does. Raises InputError if they do not fit together."""
        if not isinstance(other, BounceSeries):
            return NotImplemented
        renderings = []
        for series in (self, other):
            if not isinstance(series._source, Memory):
                raise _neumann.InputError(f"{series.title}: was read from there; neumann merge puts folders together")
            renderings.append(series._source.rendering)
        return BounceSeries(Memory(run_job(_neumann.merge(*renderings))), self.title)

    def __repr__(self) -> str:
        samples = self.run.samples
        return (
            f"<BounceSeries of {self.title}: bounces 0 to {self.bounces}, {self.run.picture.width} × {self.run.picture.height} pixels, "
            f"{samples.per_pixel} samples a pixel, {samples.outcome}>"
        )

    def _repr_html_(self) -> str:
        return _strip(self)


def read(folder: Union[str, "PathLike[str]"]) -> BounceSeries:
    """Returns the series in the folder of a finished render. Raises InputError if there is none."""
    return BounceSeries(Folder(Path(folder)), fspath(folder))
