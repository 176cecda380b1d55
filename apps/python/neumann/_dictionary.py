"""Turns scenes as Mitsuba's dictionaries into the elements of the scene file with the same meaning."""

import difflib
from typing import Any, Callable, Dict, List, Mapping, NamedTuple, Sequence, Tuple

import numpy as np
from numpy.typing import NDArray

from ._neumann import InputError
from ._numbers import real, whole

_plugins = {
    "shape": "obj ply serialized rectangle cube disk sphere cylinder linearcurve bsplinecurve shapegroup instance merge",
    "bsdf": "diffuse conductor roughconductor plastic roughplastic dielectric thindielectric roughdielectric principled principledthin "
    "null twosided mask blendbsdf normalmap bumpmap phong ward coating mixturebsdf retroreflector",
    "texture": "bitmap checkerboard mesh_attribute rawconstant scale",
    "emitter": "area directionalarea constant directional envmap point projector spot sunsky",
    "sensor": "perspective thinlens orthographic radiancemeter irradiancemeter distant batch hemisphere",
    "film": "hdrfilm",
    "rfilter": "box tent gaussian mitchell catmullrom lanczos",
    "sampler": "independent ldsampler stratified multijitter orthogonal",
    "integrator": "path ptracer volpath volpathmis direct aov moment",
    "spectrum": "regular irregular uniform d65 blackbody",
}
TAGS = {name: tag for tag, names in _plugins.items() for name in names.split()}
"""The tag of each plugin, by its name."""

Element = Tuple[str, List[Tuple[str, str]], List[Any], str]  # tag, attributes, children, key path


class Parsed(NamedTuple):
    """A dictionary as elements, and the meshes that it holds as arrays, by the names that the elements have for them."""

    root: Element
    meshes: Dict[str, Tuple[NDArray[Any], ...]]


def _numbers(values: NDArray[np.float64]) -> str:
    return ", ".join(repr(float(x)) for x in values.ravel())


def _matrix(m: NDArray[np.float64]) -> NDArray[np.float64]:
    if m.shape == (3, 3):  # a transform of texture coordinates
        m = np.block([[m[:2, :2], np.zeros((2, 1)), m[:2, 2:]], [0, 0, 1, 0], [m[2:, :2], 0, m[2:, 2:]]])
    return m


def value_of(value: Any, where: str, triple: str) -> Tuple[str, str]:
    """Returns the tag and the text of a parameter. ``triple``: the tag of three numbers."""
    if isinstance(value, (bool, np.bool_)):
        return "boolean", "true" if value else "false"
    if isinstance(value, (int, np.integer)):
        return "integer", str(int(value))
    if isinstance(value, (float, np.floating)):
        return "float", repr(float(value))
    if isinstance(value, str):
        return "string", value
    if isinstance(value, Mapping) and value.get("type") == "rgb":
        if set(value) - {"type", "id"} != {"value"}:
            raise InputError(f"{where}: expected {{'type': 'rgb', 'value': …}} with nothing else")
        colour = real(value["value"], where)
        if colour.size not in (1, 3):
            raise InputError(f"{where}: a colour of {colour.size} numbers, expected one or three")
        return "rgb", _numbers(colour)
    try:
        array = np.asarray(getattr(value, "matrix", value))  # Mitsuba's transforms have a matrix
    except ValueError:  # rows of different lengths
        array = np.array(None)
    if array.shape == (3,):
        return triple, _numbers(real(array, where))
    if array.shape in ((3, 3), (4, 4)):
        return "transform", _numbers(_matrix(real(array, where)))
    raise InputError(
        f"{where}: {type(value).__name__}, expected a number, a text, True or False, three numbers, a 4 × 4 matrix or a dictionary with 'type'"
    )


class _Parser:
    def __init__(self, name: str) -> None:
        self._name = name
        self.meshes: Dict[str, Tuple[NDArray[Any], ...]] = {}

    def _where(self, path: str) -> str:
        return f"{self._name}#{path}"

    def _tag(self, kind: Any, path: str) -> str:
        if kind in TAGS:
            return TAGS[kind]
        near = difflib.get_close_matches(str(kind), [*TAGS, "mesh"], 1)
        hint = f"; did you mean '{near[0]}'?" if near else ", expected one of those in apps/manual/scenes.md"
        raise InputError(f"{self._where(path)}/type: there is no plugin '{kind}'{hint}")

    def element(self, key: str, value: Any, path: str, is_top: bool) -> Element:
        if not isinstance(value, Mapping) or value.get("type") == "rgb":
            tag, text = value_of(value, self._where(path), "vector")
            if tag == "transform":
                return tag, [("name", key)], [("matrix", [("value", text)], [], path)], path
            return tag, [("name", key), ("value", text.replace("$", "\\$"))], [], path
        if "type" not in value:
            raise InputError(f"{self._where(path)}: a dictionary without 'type'")
        kind = value["type"]
        if kind == "ref":
            if set(value) != {"type", "id"}:
                raise InputError(f"{self._where(path)}: expected {{'type': 'ref', 'id': …}} with nothing else")
            return "ref", [("id", str(value["id"])), ("name", key)], [], path
        if kind == "spectrum":
            return self._spectrum(key, value, path)
        if kind == "mesh":
            return self._mesh(key, value, path, is_top)
        return self._object(key, value, path, is_top)

    def _object(self, key: str, value: Mapping[str, Any], path: str, is_top: bool) -> Element:
        tag = self._tag(value["type"], path)
        named = [] if is_top else [("name", key)]
        given = value.get("id", key if is_top else None)
        ids = [] if given is None or tag == "spectrum" else [("id", str(given))]
        return tag, [("type", value["type"]), *ids, *named], self._children(value, path), path

    def _children(self, value: Mapping[str, Any], path: str, is_top: bool = False) -> List[Element]:
        def below(key: str) -> str:
            return path + "/" + key.replace("~", "~0").replace("/", "~1")

        return [self.element(key, child, below(key), is_top) for key, child in value.items() if key not in ("type", "id")]

    def _spectrum(self, key: str, value: Mapping[str, Any], path: str) -> Element:
        """Returns the element of a spectrum: pairs of wavelength in nm and value, one value for all wavelengths, or a file."""
        rest = set(value) - {"type", "id"}
        if rest == {"filename"}:
            return "spectrum", [("name", key), ("filename", str(value["filename"]))], [], path
        if rest != {"value"}:
            raise InputError(f"{self._where(path)}: expected {{'type': 'spectrum'}} with 'value' or 'filename'")
        numbers = real(value["value"], f"{self._where(path)}/value")
        if numbers.ndim == 2 and numbers.shape[1] == 2:
            text = ", ".join(f"{float(nm)!r}:{float(x)!r}" for nm, x in numbers)
        elif numbers.size == 1:
            text = _numbers(numbers)
        else:
            raise InputError(f"{self._where(path)}/value: expected a number, or pairs of wavelength and value")
        return "spectrum", [("name", key), ("value", text)], [], path

    def _mesh(self, key: str, value: Mapping[str, Any], path: str, is_top: bool) -> Element:
        arrays = {name: value[name] for name in ("vertices", "faces", "normals", "uv") if name in value}

        def array(name: str, columns: int, numbers: Callable[..., NDArray[Any]] = real) -> NDArray[Any]:
            found = numbers(arrays.get(name, np.empty((0, columns))), f"{self._where(path)}/{name}")
            if found.ndim != 2 or found.shape[1] != columns:
                raise InputError(f"{self._where(path)}/{name}: an array {found.shape}, expected (n, {columns})")
            return np.ascontiguousarray(found)

        vertices, uv, normals, faces = array("vertices", 3), array("uv", 2), array("normals", 3), array("faces", 3, whole)
        if not len(vertices) or not len(faces):
            raise InputError(f"{self._where(path)}: a mesh without {'faces' if len(vertices) else 'vertices'}")
        if faces.min() < 0 or faces.max() >= len(vertices):
            raise InputError(f"{self._where(path)}/faces: numbers {faces.min()} to {faces.max()}, expected 0 to {len(vertices) - 1}")
        for name, rows in (("normals", normals), ("uv", uv)):
            if len(rows) not in (0, len(vertices)):
                raise InputError(f"{self._where(path)}/{name}: {len(rows)} rows, expected one for each of {len(vertices)} vertices")
        self.meshes[self._where(path)] = (vertices, faces.astype(np.uint32), normals, uv)
        rest = {name: x for name, x in value.items() if name not in arrays}
        return self._object(key, {**rest, "type": "ply", "filename": self._where(path)}, path, is_top)

    def scene(self, value: Any) -> Element:
        if not isinstance(value, Mapping) or value.get("type") != "scene":
            raise InputError(f"{self._name}: expected a dictionary with 'type': 'scene'")
        return "scene", [("version", "3.0.0")], self._children(value, "", True), ""


def parse(dictionary: Any, name: str) -> Parsed:
    """Parses a dictionary. Raises InputError, "name#/path/of/keys: what is wrong, what was expected"."""
    parser = _Parser(name)
    return Parsed(parser.scene(dictionary), parser.meshes)


def edits_of(changes: Mapping[str, Any]) -> List[Tuple[str, str, str]]:
    """Returns (name, tag, text) for each change."""
    return [(name, *value_of(value, name, "rgb")) for name, value in changes.items()]


def look_at(origin: Sequence[float], target: Sequence[float], up: Sequence[float] = (0.0, 1.0, 0.0)) -> NDArray[np.float64]:
    """Returns the pose of a camera or a lamp as a 4 × 4 matrix: at the origin, looking at the target, as Mitsuba's look_at does."""
    o, t = real(origin, "origin"), real(target, "target")
    forward, left = t - o, np.cross(up, t - o)
    if not np.linalg.norm(left) > 0.0:
        raise InputError("look_at: origin, target and up lie on a line, expected directions that differ")
    forward, left = forward / np.linalg.norm(forward), left / np.linalg.norm(left)
    pose = np.eye(4)
    pose[:3] = np.stack([left, np.cross(forward, left), forward, o], axis=1)
    return pose
