"""The compiled part: see the package neumann, which is what to use."""

from typing import Any, Dict, List, Optional, Tuple

import numpy as np
import scipy.sparse
from numpy.typing import NDArray

_Picture = NDArray[np.float32]
_Means = Optional[Tuple[Tuple[float, float, float], ...]]
_Pictures = Tuple[_Picture, Optional[_Picture], Optional[_Picture], Optional[_Picture], _Means]

version: str
metrics_epsilon: float
solvers: List[Tuple[str, str]]

class InputError(ValueError):
    """The scene, a file or an argument is wrong."""

class RunError(RuntimeError):
    """Something failed while running."""

class Job:
    """Work that goes on in the background."""

    def wait(self, seconds: float) -> bool: ...
    def stop(self) -> None: ...
    def progress(self) -> Tuple[str, Optional[float]]: ...
    def result(self) -> Any: ...

class Scene:
    """A scene as its files were when it was read."""

    path: str
    definitions: Dict[str, str]
    hash: str
    width: int
    height: int
    bounces: Optional[int]
    shapes: int
    largest_albedo: Tuple[float, float, float]
    warnings: List[str]
    replaced: List[str]
    def plan(self) -> Job: ...

class Rendering:
    """A finished render."""

    bounces: int
    warnings: List[str]
    def term(self, bounce: int) -> _Pictures: ...
    def sum(self, bounce: int) -> _Pictures: ...
    def rest(self) -> Optional[_Pictures]: ...
    def ways(self) -> Optional[List[Tuple[int, int, _Picture, _Picture]]]: ...
    def table(self) -> str: ...
    def convergence(self) -> str: ...
    def run(self, folder: str) -> str: ...
    def complaints(self, folder: str) -> List[str]: ...
    def save(self, folder: str, files: List[str] = ...) -> Job: ...

class Patched:
    """A channel of a scene on patches."""

    width: int
    height: int
    def matrices(self) -> Dict[str, Any]: ...
    def camera(self, samples: int, seed: int) -> Job: ...

class Operator:
    """K on finitely many unknowns."""

    size: int

def load(path: str, definitions: Dict[str, str], lenient: bool) -> Scene: ...
def trees_built() -> int: ...
def render(scene: Scene, arguments: List[str]) -> Job: ...
def matrices(scene: Scene, arguments: List[str]) -> Job: ...
def spectrum(scene: Scene, arguments: List[str]) -> Job: ...
def solve(scene: Scene, arguments: List[str]) -> Job: ...
def chain(scene: Scene, bounce: int, states: int, seed: int) -> Job: ...
def photons(scene: Scene, paths: int, bounces: int, seed: int) -> Job: ...
def study(scene: Scene, arguments: List[str]) -> Job: ...
def blame(scene: Scene, pictures: Dict[int, NDArray[Any]], again: Dict[int, NDArray[Any]], arguments: List[str]) -> Job: ...
def unbounce(
    pictures: Any,
    errors: Any,
    direct: Any,
    direct_errors: Any,
    forward: Any,
    forward_errors: Any,
    picture: Any,
    regions: Any,
    blocks: Optional[Tuple[int, int]],
    bounces: int,
    regularisation: Optional[float],
    with_direct: bool,
    seed: int,
) -> Job: ...
def under_lights(
    scene: Scene, columns: int, rows: int, width: Optional[int], bounces: int, samples: int, seed: int, threads: int
) -> Job: ...
def read(path: str) -> _Pictures: ...
def compare(
    a: NDArray[Any],
    b: NDArray[Any],
    a_stderr: Optional[NDArray[Any]] = ...,
    b_stderr: Optional[NDArray[Any]] = ...,
    a_means: _Means = ...,
    b_means: _Means = ...,
) -> Dict[str, Any]: ...
def png(picture: NDArray[Any], exposure: float, height: int) -> bytes: ...
def exposure(sum: NDArray[Any], emission: NDArray[Any]) -> float: ...
def dense(K: NDArray[np.float64], measure: NDArray[np.float64]) -> Operator: ...
def sparse(K: scipy.sparse.csr_matrix, measure: NDArray[np.float64]) -> Operator: ...
def series(K: Operator, Le: NDArray[np.float64], tolerance: float, most: int, norm: Optional[float]) -> Job: ...
def solve_one(
    name: str,
    K: Operator,
    Le: NDArray[np.float64],
    tolerance: float,
    most: int,
    radius: Optional[float],
    lowest: Optional[float],
    reflectance: Optional[NDArray[np.float64]],
    exact: Optional[NDArray[np.float64]],
) -> Job: ...
def spectrum_of(K: Operator, count: int, adjoint: bool, most: float) -> Job: ...
def cube(n: int) -> Job: ...
