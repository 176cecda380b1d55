"""Where the pictures of a series come from: memory, or the folder of a render."""

from os import fsencode
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, List, Optional, Protocol, Sequence, Tuple

import numpy as np
from numpy.typing import NDArray

from . import _neumann, _report
from ._progress import run as run_job

Picture = NDArray[np.float32]
_Means = Optional[Tuple[Tuple[float, float, float], ...]]
# The mean, stderr, discretisation and spread of each pixel, and means over pixels.
Pictures = Tuple[Picture, Optional[Picture], Optional[Picture], Optional[Picture], _Means]


class Source(Protocol):
    bounces: int

    def picture(self, kind: str, bounce: int) -> Pictures: ...
    def rest(self) -> Optional[Pictures]: ...
    def table(self) -> str: ...
    def convergence(self) -> str: ...
    def run(self) -> str: ...
    def warnings(self) -> List[str]: ...
    def ways(self) -> Any: ...
    def save(self, folder: bytes, files: Optional[Sequence[str]]) -> None: ...
    def page(self) -> str: ...


class Memory:
    def __init__(self, rendering: "_neumann.Rendering") -> None:
        self.rendering = rendering
        self.bounces = rendering.bounces
        self.rest, self.table, self.convergence = rendering.rest, rendering.table, rendering.convergence

    def picture(self, kind: str, bounce: int) -> Pictures:
        return self.rendering.term(bounce) if kind == "bounce" else self.rendering.sum(bounce)

    def run(self) -> str:
        return self.rendering.run("DIR")

    def warnings(self) -> List[str]:
        return self.rendering.warnings

    def ways(self) -> Any:
        return self.rendering.ways()

    def save(self, folder: bytes, files: Optional[Sequence[str]]) -> None:
        run_job(self.rendering.save(folder) if files is None else self.rendering.save(folder, list(files)))

    def page(self) -> str:
        with TemporaryDirectory() as folder:
            self.save(fsencode(folder), ["page"])
            return (Path(folder) / "index.html").read_text(encoding="utf-8")


class Folder:
    def __init__(self, folder: Path) -> None:
        self._folder = folder
        if not (folder / "run.json").is_file():
            raise _neumann.InputError(f"{folder}: no run.json; expected the folder of a render that was finished")
        self.bounces = len(list(folder.glob("bounce_*.exr"))) - 1

    def _text(self, name: str) -> str:
        return (self._folder / name).read_text(encoding="utf-8")

    def picture(self, kind: str, bounce: int) -> Pictures:
        return _neumann.read(fsencode(self._folder / f"{kind}_{bounce:03}.exr"))

    def rest(self) -> Optional[Pictures]:
        path = self._folder / "rest.exr"
        return _neumann.read(fsencode(path)) if path.exists() else None

    def table(self) -> str:
        return self._text("series.csv")

    def convergence(self) -> str:
        return self._text("convergence.csv")

    def run(self) -> str:
        return self._text("run.json")

    def warnings(self) -> List[str]:
        return [w["text"] for w in _report.from_json(self.run())["warnings"]]

    def ways(self) -> Any:
        found = []
        for path in self._folder.glob("way_s*_t*_unweighted.exr"):
            name = path.name[: -len("_unweighted.exr")]
            s, t = (int(part[1:]) for part in name.split("_")[1:])
            found.append((s, t, _neumann.read(fsencode(self._folder / f"{name}.exr"))[0], _neumann.read(fsencode(path))[0]))
        return sorted(found, key=lambda way: way[:2]) or None

    def save(self, folder: bytes, files: Optional[Sequence[str]]) -> None:
        raise _neumann.InputError(f"{self._folder}: was read from there; copy the folder")

    def page(self) -> str:
        if not (self._folder / "index.html").is_file():
            raise _neumann.InputError(f"{self._folder}: was written without its page, which --files page adds")
        return self._text("index.html")
