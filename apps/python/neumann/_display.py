"""Shows results: a notebook shows pictures at one exposure, tables and the contents of a result; elsewhere the browser does."""

import base64
import html
import sys
import tempfile
import webbrowser
from pathlib import Path
from typing import Any, Callable, List, Mapping, Tuple

import numpy as np

from . import _neumann
from ._progress import in_notebook

small, large = 160, 480  # heights of pictures in pixels


def _figure(picture: Any, exposure: float, label: str, title: str, height: int) -> str:
    data = base64.b64encode(_neumann.png(picture, exposure, height)).decode()
    return (
        f'<figure style="display: inline-block; margin: 0 8px 8px 0; text-align: center" title="{html.escape(title)}">'
        f'<img src="data:image/png;base64,{data}" alt="{html.escape(label)}" style="image-rendering: pixelated; height: {height}px">'
        f'<figcaption style="font-size: 85%">{html.escape(label)}</figcaption></figure>'
    )


def row(pictures: List[Tuple[Any, str, str]], exposure: float, height: int = small) -> str:
    """Returns HTML of pictures beside each other, each with its label and its title, which the pointer shows."""
    figures = "".join(_figure(picture, exposure, label, title, height) for picture, label, title in pictures)
    return f'<div style="white-space: nowrap; overflow-x: auto">{figures}</div>'


def as_table(names: List[str], rows: List[List[Any]], caption: str = "") -> str:
    """Returns an HTML table of texts and numbers."""

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
    """Returns an HTML table of names and values; of arrays it shows shape and range."""
    return as_table(["", ""], [[name, _brief(value)] for name, value in facts.items()], caption)


class Described:
    """A result whose contents a notebook shows."""

    def _repr_html_(self) -> str:
        return as_facts({name: value for name, value in vars(self).items() if not name.startswith("_")}, repr(self))


def show(shown: str, alone: str) -> None:
    """Shows ``shown`` below the cell of a notebook; elsewhere opens the page ``alone`` in the browser. Both are HTML."""
    if in_notebook():
        from IPython.display import HTML, display

        display(HTML(shown))
        return
    with tempfile.NamedTemporaryFile("w", prefix="neumann-", suffix=".html", delete=False, encoding="utf-8") as file:
        file.write(alone)
    webbrowser.open(Path(file.name).as_uri())


class Live:
    """The page of a render that is under way: below the cell of a notebook until the finished page replaces it, or in the browser.
    """

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

    def finish(self, page: Callable[[], str]) -> None:
        if self._handle is not None:
            from IPython.display import HTML

            self._handle.update(HTML(frame(page(), self.height)))


def frame(page: str, height: int) -> str:
    """Returns HTML that shows a page inside of another, ``height`` pixels high."""
    return f'<iframe srcdoc="{html.escape(page)}" style="width: 100%; height: {height}px; border: 0"></iframe>'
