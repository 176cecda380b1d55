"""A method of rendering with its options as one value; the classes of methods are generated from the options of the command."""

from dataclasses import fields
from typing import Any, ClassVar, Dict

from ._texts import text


class Method:
    """A method and its own options: ``neumann.Walk(direct="light")``, for ``render(method=…)`` and ``study([…])``. Its text is that
    of the command, "walk:direct=light". An option that is None has the default of the method."""

    name: ClassVar[str]

    def given(self) -> Dict[str, Any]:
        """Returns the options that are given, by name."""
        values = {field.name: getattr(self, field.name) for field in fields(self)}  # type: ignore[arg-type]
        return {name: value for name, value in values.items() if value is not None and value is not False}

    def __str__(self) -> str:
        return ":".join([self.name, *(f"{name.replace('_', '-')}={text(value)}" for name, value in self.given().items())])

    def __repr__(self) -> str:
        return f"{type(self).__name__}({', '.join(f'{name}={value!r}' for name, value in self.given().items())})"
