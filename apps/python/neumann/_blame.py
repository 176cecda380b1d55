"""Finds which bounce of another renderer is wrong, and in what way."""

from typing import Any, List, Mapping, Optional, Sequence, Union

from numpy.typing import ArrayLike

from . import _neumann, _report
from ._arguments import options
from ._display import as_table
from ._progress import run
from ._report import Report
from ._scene import Scene

Pictures = Union[Mapping[int, ArrayLike], Sequence[ArrayLike]]

MAPS = ("theirs", "ours", "difference", "difference_stderr", "z")


class Blame:
    """The result of ``blame()``.

    verdict: "right", "wrong", or "unclear" where the pictures differ by more than chance explains, but the reason may be that
    samples are few, or that pixels share random numbers. right: whether the verdict is "right". sentences: the verdict in words.
    counting: how depths were counted; counting_by_the_data: the counting that the pictures suggest, if it differs. noise_known:
    whether a second set of pictures gave their noise. samples: of our pictures, per pixel.

    terms: a Report for each bounce, or for bounces that are only known together, by the difference of two pictures: first and last,
    bounces; ratio of their mean to ours and ratio_stderr; p, the probability of such a difference by chance; differs; unclear;
    worst, the blocks of pixels that differ most, each with a path of ours through it; and as arrays (height, width, 3), float32,
    W·m⁻²·sr⁻¹: theirs, ours, difference = theirs − ours, its standard error difference_stderr, and z = difference /
    difference_stderr.

    suspects: possible mistakes, the likeliest first: name, words, misfit (−2 log of the likelihood). shapes: for each shape that
    the camera sees, its share of the squared difference of the first wrong term, and the ratio of their light on it to ours."""

    def __init__(self, json: str, maps: List[Any]) -> None:
        data = _report.from_json(json)
        self.verdict: str = data.verdict
        self.right: bool = data.right
        self.sentences: List[str] = data.sentences
        self.counting: str = data.counting
        self.counting_by_the_data: Optional[str] = data.get("counting_by_the_data")
        self.noise_known: bool = data.noise_known
        self.samples: int = data.samples
        self.terms: List[Report] = data.terms
        self.suspects: List[Report] = data.suspects
        self.shapes: List[Report] = data.shapes
        for term, pictures in zip(self.terms, maps):
            term.update(zip(MAPS, pictures))

    @property
    def first_wrong(self) -> Optional[Report]:
        """The first of the terms that differs, or None."""
        return next((term for term in self.terms if term.differs), None)

    def __str__(self) -> str:
        return "\n".join(self.sentences)

    def __repr__(self) -> str:
        wrong = self.first_wrong
        said = self.verdict if wrong is None else f"wrong from bounce {wrong.first} on: {self.suspects[0].name}"
        return f"<Blame of bounces 0 to {self.terms[-1].last}: {said}>"

    def _repr_html_(self) -> str:
        rows: List[List[Any]] = []
        for t in self.terms:
            bounces = str(t.first) if t.first == t.last else f"{t.first} to {t.last}"
            rows.append([bounces, t.ratio, t.ratio_stderr, t.p, "differs" if t.differs else "unclear" if t.unclear else "agrees"])
        return as_table(["bounce", "theirs / ours", "±", "by chance", ""], rows, str(self))


def _numbered(pictures: Pictures) -> Any:
    return dict(pictures) if isinstance(pictures, Mapping) else dict(enumerate(pictures))


def blame(
    scene: Scene,
    pictures: Pictures,
    *,
    again: Optional[Pictures] = None,
    counts: Optional[str] = None,
    time: Optional[float] = None,
    spp: Optional[int] = None,
    seed: Optional[int] = None,
    threads: Optional[int] = None,
    quiet: bool = False,
) -> Blame:
    """Compares pictures of another renderer with our terms of the scene, as ``neumann blame`` does, but on arrays.

    pictures: arrays (height, width, 3), linear radiance, row 0 on top, by depth limit, {1: …, 2: …}, or a list that begins with
    depth 0. Our pictures take their size. again: pictures with another seed, from which their noise is known. counts: how depths
    are counted: "mitsuba" (depth d holds bounces 0 to d − 1), "pbrt" (to d), "cycles" (to d + 1), or "bounces" (bounce d alone); by
    default the counting that fits the pictures. time: seconds for our own pictures, default 20; or spp: their samples a pixel.
    seed: of our pictures. threads: default all. quiet: no progress.

    Raises InputError if the pictures do not fit together, or do not fit the scene."""
    keywords = {"counts": counts, "time": time, "spp": spp, "seed": seed, "threads": threads}
    job = _neumann.blame(scene._scene, _numbered(pictures), {} if again is None else _numbered(again), options(keywords))
    found: Blame = run(job, quiet, lambda made: Blame(*made))
    return found
