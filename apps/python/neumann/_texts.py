"""Values as the texts of the command's options."""

from os import PathLike, fspath
from typing import Any


def text(value: Any) -> str:
    """True as true, (8, 8) as 8,8."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, PathLike):
        return str(fspath(value))
    if isinstance(value, (list, tuple)) or (hasattr(value, "ndim") and value.ndim > 0):
        return ",".join(text(v) for v in value)
    if hasattr(value, "item"):  # NumPy's numbers
        return text(value.item())
    return str(value)
