"""Keywords as the options of the command, which checks them and says what is wrong."""

import functools
import inspect
from os import PathLike, fspath
from typing import Any, Callable, Dict, List, TypeVar

from ._method_options import HELP, MethodOptions

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
        if value is None or value is False or name in ("self", "quiet", "method_options"):
            continue
        option = "--" + name.replace("_", "-")
        if value is True:
            result.append(option)
        elif name in _short:
            result.append(_short[name] + _text(value))
        else:
            result.append(f"{option}={_text(value)}")
    return result


_Function = TypeVar("_Function", bound=Callable[..., Any])


def with_method_options(function: _Function) -> _Function:
    """Its keywords ``**method_options`` by name: in help(), for completion, and against misspellings."""
    own = inspect.signature(function)
    keywords = [p for p in own.parameters.values() if p.kind is not p.VAR_KEYWORD]
    for name, annotation in MethodOptions.__annotations__.items():
        keywords.append(inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=None, annotation=annotation))
    signature = own.replace(parameters=keywords)

    @functools.wraps(function)
    def call(*arguments: Any, **given: Any) -> Any:
        try:
            signature.bind(*arguments, **given)
        except TypeError as error:
            raise TypeError(f"{function.__name__}() {error}") from None
        return function(*arguments, **given)

    call.__signature__ = signature  # type: ignore[attr-defined]
    call.__doc__ = (function.__doc__ or "") + "\n".join(f"        {name}: {text}" for name, text in HELP.items())
    return call  # type: ignore[return-value]


def definitions(overrides: Dict[str, Any]) -> Dict[str, str]:
    """Values for the names that a scene file defines, as texts."""
    return {name: _text(value) for name, value in overrides.items()}
