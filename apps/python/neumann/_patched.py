"""One channel of a scene on patches: the part that its matrices and its operators share."""

from os import PathLike
from pathlib import Path
from typing import Any, Dict, Optional, Tuple, Union

import numpy as np
import scipy.sparse
from numpy.typing import ArrayLike, NDArray

from . import _neumann, _report
from ._display import Described
from ._progress import run
from ._vtk import write_quadrilaterals

Vector = NDArray[np.float64]


class Patched(Described):
    """Fields on patches are vectors of basic radiance in W·m⁻²·sr⁻¹ with one value for each unknown: a diffuse side of a patch is
    one unknown, other sides have one for each cell of their directions."""

    Le: Vector
    b: Vector
    measure: Vector
    reflectance: Optional[Vector]
    patches: NDArray[Any]
    channel: str

    def __init__(self, patched: "_neumann.Patched") -> None:
        self._patched = patched
        made = patched.vectors()
        self.Le, self.b, self.measure, self.reflectance = made["Le"], made["b"], made["measure"], made["reflectance"]
        self.patches = _report.table(made["patches"])
        self.channel, self.title = made["channel"], made["title"]
        self._cameras: Dict[Tuple[int, int], Any] = {}
        self._radius: Optional[float] = None

    @property
    def radius(self) -> float:
        """The spectral radius of K, computed when it is first needed; nan, with a warning, if it was not found."""
        if self._radius is None:
            self._radius, why = run(self._patched.radius())
            if why:
                _report.warn([f"the spectral radius was {why}"])
        return self._radius

    def _field(self, x: ArrayLike, name: str = "x") -> NDArray[Any]:
        x = np.asarray(x)
        if x.shape != self.Le.shape:
            raise _neumann.InputError(f"{name} has the shape {x.shape}, expected one value an unknown, {self.Le.shape}")
        return x

    def camera(self, spp: int = 16, seed: int = 0) -> scipy.sparse.csr_matrix:
        """Returns the camera as a matrix, (height · width, unknowns): ``(camera @ x).reshape(height, width)`` is the picture of a
        field x.

        spp: camera rays of a pixel, a power of two. The sum of a row is the fraction of them that meets an unknown."""
        if spp < 1 or spp & (spp - 1):
            raise _neumann.InputError(f"spp={spp}: expected a power of two, such as 16")
        if (spp, seed) not in self._cameras:
            self._cameras[spp, seed] = run(self._patched.camera(spp, seed))
        return self._cameras[spp, seed]

    def picture(self, x: ArrayLike, spp: int = 16) -> Vector:
        """Returns the picture of a field x (unknowns,) that is constant on each patch: (height, width), row 0 on top."""
        x = self._field(x)
        return (self.camera(spp) @ x).reshape(self._patched.height, self._patched.width)

    def save_vtk(self, path: Union[str, "PathLike[str]"], **fields: ArrayLike) -> None:
        """Writes the patches as VTK's PolyData with fields on them, for ParaView:
        ``save_vtk("room.vtp", L=L, first=vectors[:, 0])``.

        A field (unknowns,) becomes a number for each polygon, the mean over its directions, named by the keyword; a complex field
        becomes two, with _real and _imag. ``row`` is the row of ``patches``, whose ``shape`` is written, too, and ``back`` is 1 if
        the polygon is the back of its shape. A round patch has 16 quadrilaterals, and a patch cut off by an outline has many."""
        path = Path(path)
        if path.suffix != ".vtp":
            raise _neumann.InputError(f"{path}: expected a name that ends with .vtp, by which programs know VTK's PolyData")
        corners, row = self._patched.quadrilaterals()
        of_side = {"row": np.arange(len(self.patches)), "shape": self.patches["shape"], "back": (self.patches["side"] == "back").astype(int)}
        for name, x in fields.items():
            x = self._field(x, name)
            mean = np.add.reduceat(x, self.patches["unknown"]) / self.patches["directions"]
            parts = {name + "_real": mean.real, name + "_imag": mean.imag} if np.iscomplexobj(x) else {name: mean}
            for part, values in parts.items():
                if part in of_side:
                    raise _neumann.InputError(f"a field called {part}: that name is taken; there are {', '.join(of_side)}")
                of_side[part] = values
        write_quadrilaterals(path, corners, {name: values[row] for name, values in of_side.items()})
