"""Arrays whose rows belong together."""

from typing import Any, Mapping

from numpy.typing import NDArray

from ._display import Described


class Rows(Described):
    """Arrays, as attributes, in which the same row is about the same thing."""

    def __init__(self, arrays: Mapping[str, NDArray[Any]]) -> None:
        vars(self).update(arrays)
        self._length = len(next(iter(arrays.values())))

    def __len__(self) -> int:
        """The number of rows."""
        return self._length
