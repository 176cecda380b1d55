"""Arrays whose rows belong together."""

from typing import Any, Mapping

from numpy.typing import NDArray

from ._display import Described


class Rows(Described):
    """Arrays with a row for each of many things, under their names."""

    def __init__(self, arrays: Mapping[str, NDArray[Any]]) -> None:
        vars(self).update(arrays)
        self._length = len(next(iter(arrays.values())))

    def __len__(self) -> int:
        """How many rows there are."""
        return self._length
