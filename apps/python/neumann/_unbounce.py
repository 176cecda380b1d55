"""The Neumann series backwards: separates pictures of a scene under single lights into bounces."""

from typing import Any, List, Optional, Tuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _neumann, _report
from ._display import Described, as_table
from ._numbers import real
from ._progress import run
from ._report import Report

Lights = Tuple[int, int]


class Unbounced:
    """The result of ``unbounce()``.

    terms: Cⁿ L for n = 1, 2, …: arrays (height, width, 3), float32; the light of terms[0] has bounced once. terms_stderr: their
    standard errors, None if those of the pictures are not known. terms_discretisation: their errors because regions are large,
    estimated from regions four times as large; None without ``lights``. rest: the picture minus its terms.

    bounces: for each term a Report of backward (mean, stderr, discretisation); with forward pictures also forward, difference
    (mean, stderr, in_errors) and regions (relative_difference, by_noise); with rendered pictures also by_way_of_unseen
    (mean, stderr): the part of the difference due to light that comes by way of surfaces that are not seen. channels: for r, g and
    b condition, smallest_singular_value, noise, singular, regularisation, and inverse_series_radius, below 1 if the series of T⁻¹
    converges. doubts: reasons not to trust the result, each with kind and words.

    T, inverse, direct, A: for each channel the matrices of the regions: T (regions × lights), T⁻¹, T¹, and A = (T − T¹) T⁻¹ with
    errors A_stderr; lights: those that the matrices include."""

    def __init__(self, json: str, terms: List[Any], rest: NDArray[np.float32], channels: List[Any]) -> None:
        data = _report.from_json(json)
        self.terms: List[NDArray[np.float32]] = [term[0] for term in terms]
        self.terms_stderr: Optional[List[NDArray[np.float32]]] = None if terms[0][1] is None else [term[1] for term in terms]
        self.terms_discretisation: Optional[List[NDArray[np.float32]]] = None if terms[0][2] is None else [term[2] for term in terms]
        self.rest: NDArray[np.float32] = rest
        self.bounces: List[Report] = data.bounces
        self.channels: List[Report] = data.channels
        self.doubts: List[Report] = data.doubts
        self.lights: List[List[int]] = [c[0] for c in channels]
        self.T: List[NDArray[np.float64]] = [c[1] for c in channels]
        self.inverse: List[NDArray[np.float64]] = [c[2] for c in channels]
        self.direct: List[NDArray[np.float64]] = [c[3] for c in channels]
        self.A: List[NDArray[np.float64]] = [c[4] for c in channels]
        self.A_stderr: List[NDArray[np.float64]] = [c[5] for c in channels]

    def __str__(self) -> str:
        return "\n".join(doubt.words for doubt in self.doubts) or "no reason for doubt was found"

    def __repr__(self) -> str:
        return f"<Unbounced, bounces 1 to {len(self.terms)}: {', '.join(d.kind for d in self.doubts) or 'no doubts'}>"

    def _repr_html_(self) -> str:
        rows: List[List[Any]] = []
        for b in self.bounces:
            forward = [b.forward.mean, b.forward.stderr, b.difference.in_errors] if "forward" in b else ["", "", ""]
            rows.append([b.bounce, b.backward.mean, b.backward.stderr, b.backward.get("discretisation", ""), *forward])
        return as_table(["bounce", "backward", "±", "discretisation", "forward", "±", "apart, in errors"], rows, str(self))


def unbounce(
    pictures: ArrayLike,
    *,
    stderr: Optional[ArrayLike] = None,
    direct: Optional[ArrayLike] = None,
    direct_stderr: Optional[ArrayLike] = None,
    forward: Optional[ArrayLike] = None,
    forward_stderr: Optional[ArrayLike] = None,
    picture: Optional[ArrayLike] = None,
    regions: Optional[ArrayLike] = None,
    lights: Optional[Lights] = None,
    bounces: int = 6,
    regularisation: Optional[float] = None,
    use_direct: bool = False,
    seed: int = 0,
    quiet: bool = False,
) -> Unbounced:
    """Separates pictures of a scene under single lights into bounces, as ``neumann unbounce`` does, but on arrays.

    pictures: (lights, height, width, 3), linear radiance; or a matrix T (regions, lights) with a column for each light, whose
    region r is that of light r. stderr: their standard errors. direct: the direct light in them; use_direct: take T¹ from it
    instead of from T⁻¹. forward: K^i Le of all lights together, i = 1, 2, …, for comparison. picture: the one to separate; default
    the sum of all.

    regions: (height, width), the number of the light, from 0, to which a pixel belongs, or −1; lights: (columns, rows), for regions
    that are blocks of the picture; by default a pixel belongs to the light under which it is brightest. regularisation: Tikhonov's
    parameter. seed: of the repeats from which errors are estimated. Raises InputError."""

    def stack(given: Optional[ArrayLike], what: str) -> Optional[NDArray[np.float64]]:
        if given is None:
            return None
        array = real(given, what, finite=False)
        return np.repeat(array.T[:, None, :, None], 3, axis=3) if array.ndim == 2 else array

    T = real(pictures, "pictures", finite=False)
    if T.ndim == 2 and regions is None:
        regions = np.arange(T.shape[0])[None, :]
    job = _neumann.unbounce(
        stack(pictures, "pictures"),
        stack(stderr, "stderr"),
        stack(direct, "direct"),
        stack(direct_stderr, "direct_stderr"),
        forward,
        forward_stderr,
        None if picture is None else np.repeat(real(picture, "picture", finite=False)[None, :, None], 3, axis=2) if T.ndim == 2 else picture,
        regions,
        lights,
        bounces,
        regularisation,
        use_direct,
        seed,
        None,
    )
    found: Unbounced = run(job, quiet, lambda made: Unbounced(*made))
    return found


class LightPictures(Described):
    """A scene under each light of a projector at the place of the camera, as ``Scene.under_lights()`` renders it.

    pictures and direct: (lights, height, width, 3), all bounces and bounce 1 alone; forward: (bounces, height, width, 3), K^i Le of
    all lights together; each with standard errors of the same shape. lights: (columns, rows)."""

    def __init__(self, lights: Lights, made: Any) -> None:
        self.lights = lights
        self.pictures: NDArray[np.float32]
        (self.pictures, self.stderr, self.direct, self.direct_stderr, self.forward, self.forward_stderr, self.warnings, self._besides) = made

    def __repr__(self) -> str:
        columns, rows = self.lights
        return f"<LightPictures under {columns} × {rows} lights, {self.pictures.shape[2]} × {self.pictures.shape[1]} pixels>"

    def unbounce(self, *, bounces: Optional[int] = None, use_direct: bool = False, seed: int = 0, quiet: bool = False) -> Unbounced:
        """Returns ``neumann.unbounce()`` of these pictures, compared with the forward terms."""
        pictures = (self.pictures, self.stderr, self.direct, self.direct_stderr, self.forward, self.forward_stderr)
        job = _neumann.unbounce(*pictures, None, None, self.lights, bounces or len(self.forward), None, use_direct, seed, self._besides)
        found: Unbounced = run(job, quiet, lambda made: Unbounced(*made))
        return found
