"""Keywords as the options of the command, which checks them and says what is wrong."""

from os import PathLike, fspath
from typing import Any, Dict, List

_short = {"bounces": "-n", "threads": "-t", "output": "-o"}


def _text(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, PathLike):
        return str(fspath(value))
    if isinstance(value, (list, tuple)) or (hasattr(value, "ndim") and value.ndim > 0):
        return ",".join(_text(v) for v in value)
    if hasattr(value, "item"):  # NumPy's numbers
        return _text(value.item())
    return str(value)


def options(keywords: Dict[str, Any]) -> List[str]:
    """bounces=6, direct="light" as -n6 --direct=light. None and False are left out, and what is no option."""
    result = []
    for name, value in keywords.items():
        if value is None or value is False or name in ("self", "quiet"):
            continue
        option = "--" + name.replace("_", "-")
        if value is True:
            result.append(option)
        elif name in _short:
            result.append(_short[name] + _text(value))
        else:
            result.append(f"{option}={_text(value)}")
    return result


def definitions(overrides: Dict[str, Any]) -> Dict[str, str]:
    """Values for the names that a scene file defines, as texts."""
    return {name: _text(value) for name, value in overrides.items()}
