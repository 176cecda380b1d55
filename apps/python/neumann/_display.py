"""A series as a notebook shows it: its bounces in a row, and its sums below, at one exposure."""

import base64
import html
from typing import TYPE_CHECKING, Any, List, Tuple

from . import _neumann

if TYPE_CHECKING:
    from ._bounces import BounceSeries

_height = 160
_most = 12  # pictures in a row: the others are in the arrays


def _figure(picture: Any, exposure: float, label: str, title: str) -> str:
    data = base64.b64encode(_neumann.png(picture, exposure, _height)).decode()
    return (
        f'<figure style="display: inline-block; margin: 0 8px 8px 0; text-align: center" title="{html.escape(title)}">'
        f'<img src="data:image/png;base64,{data}" alt="{html.escape(label)}" style="image-rendering: pixelated; height: {_height}px">'
        f'<figcaption style="font-size: 85%">{html.escape(label)}</figcaption></figure>'
    )


def _row(pictures: List[Tuple[Any, str, str]], exposure: float) -> str:
    figures = "".join(_figure(picture, exposure, label, title) for picture, label, title in pictures)
    return f'<div style="white-space: nowrap; overflow-x: auto">{figures}</div>'


def _mean(figures: Any) -> str:
    if figures.get("mean") is None:
        return ""
    interval = figures.get("interval95")
    return f"mean {figures['mean']:.4g}" + (f" ± {interval:.1g}" if isinstance(interval, float) else "")


def strip(series: "BounceSeries") -> str:
    """HTML of a series. All pictures have the same exposure, so that their brightness can be compared."""
    run, shown = series.run, min(series.bounces + 1, _most)
    importance = run.quantity.name.startswith("importance")
    exposure = _neumann.exposure(series.sums[-1], series.sums[-1] if importance else series.terms[0])
    terms = [(series.terms[i], f"bounce {i}", _mean(run.bounces[i])) for i in range(shown)]
    if series.rest is not None and shown == series.bounces + 1:
        terms.append((series.rest, f"rest, beyond {series.bounces}", _mean(run.rest)))
    sums = [(series.sums[i], "sum 0" if i == 0 else f"sum 0..{i}", "") for i in range(shown)]
    more = "" if shown > series.bounces else f" (the first {shown} of {series.bounces + 1} bounces)"
    note = f"{series.title}; exposure × {exposure:.3g}, sRGB{more}"
    return f"<div>{_row(terms, exposure)}{_row(sums, exposure)}<div style='font-size: 85%'>{html.escape(note)}</div></div>"


def as_table(names: List[str], rows: List[List[Any]], caption: str = "") -> str:
    """An HTML table of texts and numbers."""

    def cell(value: Any) -> str:
        text = f"{value:.4g}" if isinstance(value, float) else str(value)
        side = "right" if isinstance(value, (int, float)) else "left"
        return f'<td style="text-align: {side}">{html.escape(text)}</td>'

    head = "".join(f"<th>{html.escape(name)}</th>" for name in names)
    body = "".join("<tr>" + "".join(cell(value) for value in row) + "</tr>" for row in rows)
    return f"<table><caption>{html.escape(caption)}</caption><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"
