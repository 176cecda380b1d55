"""Figures with names, as the commands print them in JSON and CSV."""

import csv
import io
import json
import warnings
from typing import Any, Container, Iterable, List, Optional, Type

import numpy as np
from numpy.typing import NDArray

from ._display import as_facts

_most = 8  # names in a repr, at most


class NeumannWarning(UserWarning):
    """A warning of the command: something that is accepted, although it is odd."""


class HealthWarning(NeumannWarning):
    """A complaint of the command about a sick render: samples that are no numbers, fireflies, missing energy."""


class Report(dict):
    """A dict whose entries can also be read as attributes: ``report.norms["inf"]``, ``report.spectral_radius``."""

    def __getattr__(self, name: str) -> Any:
        try:
            return self[name]
        except KeyError:
            raise AttributeError(f"there is no {name!r} here; there are {', '.join(map(str, self))}") from None

    def __repr__(self) -> str:
        names = list(map(str, self))
        more = f", … ({len(names)} in all)" if len(names) > _most else ""
        return f"<Report of {', '.join(names[:_most])}{more}>"

    def _repr_html_(self) -> str:
        return as_facts(self, "")

    def __dir__(self) -> List[str]:
        return [*super().__dir__(), *(key for key in self if isinstance(key, str) and key.isidentifier())]


def from_json(text: str) -> Any:
    return json.loads(text, object_hook=Report)


def _column(texts: List[str], may_be_counts: bool) -> NDArray[Any]:
    if may_be_counts and all(text.isdigit() for text in texts):
        numbers = [int(text) for text in texts]
        return np.array(numbers, dtype=np.uint64 if max(numbers, default=0) >= 1 << 63 else np.int64)
    try:
        return np.array([float(text) if text else np.nan for text in texts])
    except ValueError:
        return np.array(texts)


def table(text: str, counts: Optional[Container[str]] = None) -> NDArray[Any]:
    """Returns a CSV file as a structured array, with a row for each line: a column is of numbers if all its fields are, with nan
    for empty ones. counts: the columns of integers; by default those that hold nothing else."""
    head, *lines = csv.reader(io.StringIO(text))
    columns = [_column([line[i] for line in lines], counts is None or name in counts) for i, name in enumerate(head)]
    result = np.empty(len(lines), dtype=[(name, column.dtype) for name, column in zip(head, columns)])
    for name, column in zip(head, columns):
        result[name] = column
    return result


def rows(values: NDArray[np.float64], names: Iterable[str]) -> NDArray[Any]:
    """Returns a structured array of one whose columns have these names."""
    return np.array([tuple(row) for row in values], dtype=[(name, np.float64) for name in names])


def warn(texts: Iterable[str], category: Type[Warning] = NeumannWarning, level: int = 3) -> None:
    """Warns the caller of the function that calls this one."""
    for text in texts:
        warnings.warn(text, category, stacklevel=level)
