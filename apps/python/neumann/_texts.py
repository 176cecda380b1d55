"""Converts values to the texts of options."""

from os import PathLike, fspath
from typing import Any, List


def texts(value: Any) -> List[str]:
    """Converts (8, 8) to "8" and "8", and any other value to a single text."""
    several = isinstance(value, (list, tuple)) or (hasattr(value, "ndim") and value.ndim > 0)
    return [text(v) for v in value] if several else [text(value)]


def text(value: Any) -> str:
    """Converts True to "true", (8, 8) to "8,8"."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, PathLike):
        return str(fspath(value))
    if isinstance(value, (list, tuple)) or (hasattr(value, "ndim") and value.ndim > 0):
        return ",".join(text(v) for v in value)
    if hasattr(value, "item"):  # NumPy's numbers
        return text(value.item())
    return str(value)
