"""Turns keywords into the options of a request, which checks them and reports what is wrong."""

import difflib
import inspect
from typing import Any, Callable, Dict, List, Mapping, Tuple, TypeVar

from ._method import Method
from ._method_options import HELP, MethodOptions
from ._texts import text, texts

_of_scenes = ("res", "resolution", "size", "width", "height")
_no_options = ("self", "quiet", "live", "of_method", "of_patches")


def options(keywords: Dict[str, Any]) -> List[Tuple[str, List[str]]]:
    """Turns bounces=6, split=(2, 1) into names and texts. Leaves out None, False, and keywords that are no options of a command."""
    given = {name: value for name, value in keywords.items() if value is not None and value is not False and name not in _no_options}
    return [(name.replace("_", "-"), texts(value)) for name, value in given.items()]


# The keywords of the functions that take some as ``**Unpack[…]``, by the name of the function.
_keywords: Dict[str, List[str]] = {}

_Function = TypeVar("_Function", bound=Callable[..., Any])


def with_keywords(table: Any) -> Callable[[_Function], _Function]:
    """Makes a decorator that lists the keywords of a TypedDict, taken as ``**Unpack[…]``, in the signature of a function."""

    def named(function: _Function) -> _Function:
        own = inspect.signature(function)
        keywords = [p for p in own.parameters.values() if p.kind is not p.VAR_KEYWORD]
        for name, annotation in table.__annotations__.items():
            keywords.append(inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=None, annotation=annotation))
        function.__signature__ = own.replace(parameters=keywords)  # type: ignore[attr-defined]
        _keywords[function.__name__] = [p.name for p in keywords if p.kind is p.KEYWORD_ONLY]
        return function

    return named


def with_method_options(function: _Function) -> _Function:
    """Decorates a function with ``**of_method``: lists the options of the methods in its signature and its help."""
    function.__doc__ = (function.__doc__ or "") + "\n".join(f"        {name}: {said}" for name, said in HELP.items())
    return with_keywords(MethodOptions)(function)


def checked(given: Mapping[str, Any], table: Any, function: str) -> Dict[str, Any]:
    """Returns what is given. Raises TypeError for a name that is not in the TypedDict, and suggests the most similar keyword."""
    for name in given:
        if name in table.__annotations__:
            continue
        near = difflib.get_close_matches(name, _keywords.get(function, []), 1)
        hint = f"; did you mean '{near[0]}'?" if near else ""
        if name in _of_scenes:
            hint = f"; sizes are defined by scenes: load(…, {name}=…)"
        raise TypeError(f"{function}() got an unexpected keyword argument '{name}'{hint}")
    return dict(given)


def method_options(given: MethodOptions) -> Dict[str, Any]:
    """Returns the options in the order of HELP. Raises TypeError for a name that is unknown or given twice."""
    all_given = checked(given, MethodOptions, "render")
    chosen = all_given.get("method")
    if isinstance(chosen, Method):
        own = chosen.given()
        twice = [name for name in own if all_given.get(name) is not None]
        if twice:
            raise TypeError(f"render() got '{twice[0]}' as a keyword and in method={chosen!r}")
        all_given.update(own, method=chosen.name)
    return {name: all_given[name] for name in HELP if name in all_given}


def definitions(overrides: Dict[str, Any]) -> Dict[str, str]:
    """Returns the values for the names that a scene file defines, as texts."""
    return {name: text(value) for name, value in overrides.items()}
