"""What a notebook shows: pictures at one exposure, tables, and what a result holds; elsewhere a browser shows it."""

import base64
import html
import sys
import tempfile
import webbrowser
from pathlib import Path
from typing import TYPE_CHECKING, Any, List, Mapping, Tuple

import numpy as np

from . import _neumann
from ._progress import in_notebook

if TYPE_CHECKING:
    from ._bounces import Bounce, BounceSeries

small, large = 160, 480  # heights of pictures
_most = 12  # pictures in a row: the others are in the arrays


def _figure(picture: Any, exposure: float, label: str, title: str, height: int) -> str:
    data = base64.b64encode(_neumann.png(picture, exposure, height)).decode()
    return (
        f'<figure style="display: inline-block; margin: 0 8px 8px 0; text-align: center" title="{html.escape(title)}">'
        f'<img src="data:image/png;base64,{data}" alt="{html.escape(label)}" style="image-rendering: pixelated; height: {height}px">'
        f'<figcaption style="font-size: 85%">{html.escape(label)}</figcaption></figure>'
    )


def _row(pictures: List[Tuple[Any, str, str]], exposure: float, height: int = small) -> str:
    figures = "".join(_figure(picture, exposure, label, title, height) for picture, label, title in pictures)
    return f'<div style="white-space: nowrap; overflow-x: auto">{figures}</div>'


def _mean(figures: Any) -> str:
    if figures.get("mean") is None:
        return ""
    interval = figures.get("interval95")
    return f"mean {figures['mean']:.4g}" + (f" ± {interval:.1g}" if isinstance(interval, float) else "")


def exposure_of(series: "BounceSeries") -> float:
    """For all pictures of a series, so that their brightness can be compared."""
    importance = series.run.quantity.name.startswith("importance")
    return _neumann.exposure(series.sums[-1], series.sums[-1] if importance else series.terms[0])


def strip(series: "BounceSeries") -> str:
    """HTML of a series."""
    run, shown = series.run, min(series.bounces + 1, _most)
    exposure = exposure_of(series)
    terms = [(series.terms[i], f"bounce {i}", _mean(run.bounces[i])) for i in range(shown)]
    if series.rest is not None and shown == series.bounces + 1:
        terms.append((series.rest, f"rest, beyond {series.bounces}", _mean(run.rest)))
    sums = [(series.sums[i], "sum 0" if i == 0 else f"sum 0..{i}", "") for i in range(shown)]
    more = "" if shown > series.bounces else f" (the first {shown} of {series.bounces + 1} bounces)"
    note = f"{series.title}; exposure × {exposure:.3g}, sRGB{more}"
    return f"<div>{_row(terms, exposure)}{_row(sums, exposure)}<div style='font-size: 85%'>{html.escape(note)}</div></div>"


def of_bounces(bounces: List["Bounce"], exposure: float, height: int) -> str:
    """HTML of some of its bounces."""
    figures = [(b.value, f"bounce {b.bounce}", f"mean {b.mean:.4g}") for b in bounces]
    return _row(figures, exposure, height)


def as_table(names: List[str], rows: List[List[Any]], caption: str = "") -> str:
    """An HTML table of texts and numbers."""

    def cell(value: Any) -> str:
        text = f"{value:.4g}" if isinstance(value, float) else str(value)
        side = "right" if isinstance(value, (int, float)) else "left"
        return f'<td style="text-align: {side}">{html.escape(text)}</td>'

    head = "".join(f"<th>{html.escape(name)}</th>" for name in names)
    body = "".join("<tr>" + "".join(cell(value) for value in row) + "</tr>" for row in rows)
    return f"<table><caption>{html.escape(caption)}</caption><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"


def _brief(value: Any) -> str:
    if hasattr(value, "nnz"):
        return f"sparse {value.shape}, {value.nnz} entries"
    if isinstance(value, np.ndarray):
        numbers = value.size > 0 and value.dtype.kind in "fiu"
        return f"{value.dtype} {value.shape}" + (f", {value.min():.4g} to {value.max():.4g}" if numbers else "")
    if isinstance(value, Mapping):
        return ", ".join(map(str, value))
    if isinstance(value, (list, tuple)) and len(value) > 4:
        return f"{len(value)} entries"
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def as_facts(facts: Mapping[str, Any], caption: str) -> str:
    """An HTML table of names and what they hold: of arrays shape and range."""
    return as_table(["", ""], [[name, _brief(value)] for name, value in facts.items()], caption)


class Described:
    """A result that shows in a notebook what it holds."""

    def _repr_html_(self) -> str:
        return as_facts({name: value for name, value in vars(self).items() if not name.startswith("_")}, repr(self))


def show(shown: str, alone: str) -> None:
    """HTML below the cell of a notebook; elsewhere a whole page opens in the browser."""
    if in_notebook():
        from IPython.display import HTML, display

        display(HTML(shown))
        return
    with tempfile.NamedTemporaryFile("w", prefix="neumann-", suffix=".html", delete=False, encoding="utf-8") as file:
        file.write(alone)
    webbrowser.open(Path(file.name).as_uri())


class Live:
    """The page of a render that is under way: below the cell of a notebook, where it becomes the finished page; elsewhere in the browser."""

    height = 800

    def __init__(self) -> None:
        self.server = _neumann.LivePage()
        self._handle: Any = None
        address = self.server.address
        if in_notebook():
            from IPython.display import HTML, display

            frame_of_server = f'<iframe src="{address}" style="width: 100%; height: {self.height}px; border: 0"></iframe>'
            self._handle = display(HTML(frame_of_server), display_id=True)
        else:
            print(f"The page of this render, which fills meanwhile: {address}", file=sys.stderr)
            if webbrowser.open(address):
                self.server.expect()

    def finish(self, series: "BounceSeries") -> None:
        if self._handle is not None:
            from IPython.display import HTML

            self._handle.update(HTML(frame(series._source.page(), self.height)))


def frame(page: str, height: int) -> str:
    """A page inside of another."""
    return f'<iframe srcdoc="{html.escape(page)}" style="width: 100%; height: {height}px; border: 0"></iframe>'
