"""Scenes, and the commands on them."""

import tempfile
from hashlib import sha256
from os import PathLike, fsencode
from typing import Any, Dict, List, Mapping, Optional, Sequence, Tuple, Union, Unpack

from . import _neumann, _report
from ._arguments import definitions, method_options, options, with_method_options
from ._bounces import BounceSeries
from ._chain import Chain
from ._dictionary import edits_of, parse
from ._display import Live, as_facts, as_table
from ._estimator import Estimator, from_rays, name_of
from ._functions import OnFunctions
from ._method import Method
from ._method_options import MethodOptions
from ._on_patches import OnPatches
from ._photons import Photons
from ._progress import run
from ._records import Records
from ._report import HealthWarning, Report, warn
from ._sources import Memory
from ._study import Study
from ._unbounce import LightPictures

Path = Union[str, "PathLike[str]"]


class Plan(List[Report]):
    """The parts of the program, each a Report of part, kept, reason and, if it is left out, saves."""

    def __repr__(self) -> str:
        kept = sum(part.kept for part in self)
        return f"<Plan: {kept} parts kept, {len(self) - kept} left out>"

    def _repr_html_(self) -> str:
        return as_table(
            ["part", "", "why", "saves"],
            [[p.part, "kept" if p.kept else "left out", p.reason, p.get("saves", "")] for p in self],
        )


class Scene(OnFunctions, OnPatches):
    """A scene, as its files were when load() read them.

    Methods do the same as the commands of the same names; their keywords are the options of the command, which checks them. While
    they work, other threads of Python run, a line shows their progress, and Ctrl-C ends them early: KeyboardInterrupt is then
    raised, and its ``result`` is the result until then, if there is any (in a shell or a notebook: ``sys.last_value.result``)."""

    def __init__(self, scene: "_neumann.Scene") -> None:
        self._scene = scene

    @property
    def path(self) -> str:
        """The path of the scene file."""
        return self._scene.path

    @property
    def definitions(self) -> Dict[str, str]:
        """The values for names of the scene file that load() was given."""
        return self._scene.definitions

    @property
    def hash(self) -> str:
        """A hash of all files of the scene."""
        return self._scene.hash

    @property
    def replaced(self) -> List[str]:
        """What load(…, lenient=True) replaced or left out, each with its place; empty without ``lenient``."""
        return self._scene.replaced

    @property
    def edits(self) -> Dict[str, str]:
        """The changes of edit(), by name, with values as a scene file has them."""
        return dict(self._scene.edits)

    def edit(self, changes: Mapping[str, Any]) -> "Scene":
        """Returns a scene with other values of parameters, by names like those of Mitsuba's traverse(); this one stays as it is.

            brighter = scene.edit({"lamp.emitter.radiance.value": [20.0, 20.0, 18.0], "white.reflectance.value": 0.8})
            moved = scene.edit({"sensor.to_world": neumann.look_at([0, 0, 4], [0, 0, 0])})

        The first part of a name is the id of an object, in a dictionary its key, or for the only object of a kind without an id
        that kind, such as "sensor"; the last is a parameter, and those between are objects inside. "value" at the end may be left
        out; a missing parameter is then added. Values: numbers, texts, True and False, three numbers for a colour, a point or a
        vector, {"type": "rgb", …}, and 4 × 4 matrices. Raises InputError. Files of the scene are read again."""
        changed = Scene(self._scene.edited(edits_of(changes)))
        warn(changed._scene.warnings)
        return changed

    def hemisphere(self, x: int, y: int) -> "Scene":
        """Returns the scene seen from the point that the pixel in column x and row y of the film sees, as by ``--hemisphere``.

        Its pictures are T K^i Le, what arrives there from all directions: the disc under the hemisphere, onto which directions are
        projected straight down, so that ``4 * picture.mean()`` is the irradiance. Raises InputError for a pixel that is not of the
        film, or that sees no surface."""
        return Scene(self._scene.hemisphere(x, y))

    @property
    def width(self) -> int:
        """The width of pictures, in pixels."""
        return self._scene.width

    @property
    def height(self) -> int:
        """The height of pictures, in pixels."""
        return self._scene.height

    @property
    def largest_albedo(self) -> Tuple[float, float, float]:
        """The largest albedo of any material, by channel: a bound on ‖R‖, and so on how slowly the series falls."""
        return self._scene.largest_albedo

    @with_method_options
    def render(
        self,
        *,
        bounces: Optional[int] = None,
        tail: Optional[float] = None,
        spp: Optional[int] = None,
        time: Optional[float] = None,
        error: Optional[float] = None,
        memory: Optional[float] = None,
        reference: Optional[Path] = None,
        seed: Optional[int] = None,
        threads: Optional[int] = None,
        quiet: bool = False,
        live: bool = False,
        **of_method: Unpack[MethodOptions],
    ) -> BounceSeries:
        """Renders the bounces K^i Le, their sums, and the rest, as ``neumann render`` does, with the same bits for the same seed.

        bounces: the last bounce with a picture of its own; or tail: as many bounces as make the rest smaller than this part of the
        sum. spp: samples a pixel; time: seconds; error: relative standard error of every bounce. The render ends at the first of
        these that is reached; without any, at 2% error or after 20 seconds; with error alone, after ten minutes at most. memory:
        GiB that may be taken, default half of the machine's. reference: the folder of an earlier render, for true errors in
        ``convergence``. seed: of the samples. threads: default all. quiet: neither progress nor warnings. live: shows the explorer
        at once, which is updated during the render: below the cell of a notebook on the same machine, where the finished page
        replaces it; elsewhere in the browser.

        Raises InputError for a wrong argument, with the command's own words, and RunError. What the command prints as a warning is
        a NeumannWarning, and what it calls sick is a HealthWarning.

        The other keywords are the options of the methods:
        """
        keywords = options({**locals(), **method_options(of_method)})
        page = Live() if live else None
        job = _neumann.render(self._scene, keywords, page.server if page else None)
        series: BounceSeries = run(job, quiet, lambda made: BounceSeries(Memory(made), self.path))
        if page:
            page.finish(series._source.page)
        if not quiet:
            warn(series.warnings)
            warn(series.run.health.complaints, HealthWarning)
        return series

    def plan(self) -> Plan:
        """Returns which parts of the program this scene needs, which are left out, and why, as ``neumann plan`` does."""
        return Plan(_report.from_json(run(self._scene.plan())))

    def chain(self, bounce: int, *, states: int = 1000, seed: int = 0) -> Chain:
        """One Markov chain of a bounce ≥ 1; method="metropolis" has many of them. Raises InputError."""
        return Chain(run(_neumann.chain(self._scene, bounce, states, seed)), bounce)

    def photons(self, paths: int = 100_000, *, bounces: int = 8, seed: int = 0) -> Photons:
        """Photons of bounces 1 … bounces from this number of paths from the lights, for inspection. Raises InputError."""
        return Photons(run(_neumann.photons(self._scene, paths, bounces, seed)))

    def records(
        self,
        *,
        bounces: int = 4,
        records: Optional[str] = None,
        accuracy: Optional[float] = None,
        directions: Optional[int] = None,
        seed: int = 0,
    ) -> Records:
        """The records of ``method="cache"``, filled once with E_1 … E_bounces, for inspection. Raises InputError."""
        given = {"records": records, "accuracy": accuracy, "directions": directions}
        options = [(name, str(value)) for name, value in given.items() if value is not None]
        return Records(run(_neumann.records(self._scene, bounces, options, seed)))

    def under_lights(
        self,
        lights: Tuple[int, int] = (8, 8),
        *,
        width: Optional[int] = None,
        spp: int = 256,
        bounces: int = 6,
        seed: int = 0,
        threads: Optional[int] = None,
        quiet: bool = False,
    ) -> LightPictures:
        """Renders the scene under each block of a projector at the camera, instead of the scene's own lights, and the forward
        series under all blocks, as ``neumann unbounce`` does.

        lights: (columns, rows) of blocks. width: of the pictures, in pixels; default that of the film. spp: samples a pixel, for
        all lights together. Raises InputError."""
        columns, rows = lights
        job = _neumann.under_lights(self._scene, columns, rows, width, bounces, spp, seed, threads or 0)
        made: LightPictures = run(job, quiet, lambda result: LightPictures((columns, rows), result))
        return made

    def study(
        self,
        methods: Optional[Sequence[Union[str, Method, Estimator]]] = None,
        *,
        budgets: Optional[Sequence[float]] = None,
        samples: Optional[Sequence[int]] = None,
        repeats: Optional[int] = None,
        interval: Optional[float] = None,
        bounces: Optional[Union[int, str]] = None,
        error: Optional[float] = None,
        crop: Optional[Sequence[int]] = None,
        reference: Optional[Path] = None,
        reference_spp: Optional[int] = None,
        seed: Optional[int] = None,
        threads: Optional[int] = None,
        output: Optional[Path] = None,
        quiet: bool = False,
    ) -> Study:
        """Compares methods by their error against time, bounce by bounce, as ``neumann study`` does.

        methods: such as ["walk", "walk:direct=light:sampler=independent", "matrix"], or neumann.Walk(direct="light"); default all
        that can render the scene. An estimator of your own is one, too, called "its_name()": a function of camera rays, with
        ``origin`` (n, 3), ``direction`` (n, 3), ``length`` (n,) and ``pixel`` (n, 2), of the last bounce N, and of a
        numpy.random.Generator, which returns samples of K^i Le along each ray, (n, N + 1, 3) in W·m⁻²·sr⁻¹. It may call ``seen()``,
        ``intersect()``, ``visible()`` and ``sample_lights()``, and must not start other work of this package. budgets: seconds of a
        run; or samples: samples a pixel of a run; both growing. repeats: runs of each method at each budget, default 16; or
        interval: as many as make the 95% interval of the sum's RMSE at most ± this part of it. bounces: the last that is compared, or
        "1-4", on which the verdict then is. error: the relative RMSE to which the time is given. crop: x, y, width and height of a
        part that the page shows for every method. reference: the folder of a render, "values:1,0.5,…", or a method that makes one, with reference_spp samples a pixel.
        output: the folder for tables and page; by default nothing is kept."""
        own = {name_of(method): from_rays(method) for method in methods or () if callable(method)}
        if methods is not None:
            methods = [name_of(method) if callable(method) else method for method in methods]
        keywords = options({name: value for name, value in locals().items() if name != "own"})
        with tempfile.TemporaryDirectory() as folder:
            if output is None:
                keywords += options({"output": folder})
            study: Study = run(_neumann.study(self._scene, keywords, own), quiet, lambda made: Study(*made))
        if not quiet:
            warn(study.warnings)
        return study

    def __repr__(self) -> str:
        given = "".join(f", {name}={value}" for name, value in self.definitions.items()) + (", lenient" if self.replaced else "")
        given += f", {len(self.edits)} edits" if self.edits else ""
        return f"<Scene {self.path}{given}: {self._scene.shapes} shapes, {self.width} × {self.height} pixels>"

    def _repr_html_(self) -> str:
        facts = {"file": self.path, **self.definitions, "shapes": self._scene.shapes, "pixels": f"{self.width} × {self.height}"}
        facts["largest albedo"] = ", ".join(f"{a:.3g}" for a in self.largest_albedo)
        return as_facts({**facts, **self.edits, "replaced": len(self.replaced)}, "")


def load(path: Path, *, lenient: bool = False, **overrides: Any) -> Scene:
    """Reads a scene file, or by its name a scene that comes with the program; ``overrides`` are values for the names that it
    defines: ``load("furnace.xml", albedo=0.9)``, ``load("cornell-box", res=64)``.

    Raises InputError, 'file:line:column: what is wrong, what was expected', for what is not supported, unknown, misspelt or never
    used. With ``lenient``, unknown parts are no errors: materials become grey and diffuse; lights, shapes and parameters are left
    out; each is named in a warning and in ``replaced``, and pictures are marked."""
    scene = _neumann.load(fsencode(path), definitions(overrides), lenient)
    warn(scene.warnings)
    return Scene(scene)


def load_dict(dictionary: Mapping[str, Any], *, name: str = "dict", lenient: bool = False) -> Scene:
    """Takes a scene as a dictionary, as Mitsuba's load_dict does: {"type": "scene", "white": {"type": "diffuse", …}, …}.

    Values are numbers, texts, True and False, three numbers, 4 × 4 matrices or Mitsuba's transforms, {"type": "rgb", "value": …},
    {"type": "spectrum", …}, {"type": "ref", "id": …} and other objects. A shape {"type": "mesh", "vertices": (n, 3), "faces":
    (m, 3)}, with "normals" (n, 3), "uv" (n, 2) and the parameters of a ply, is made of arrays. File names are relative to the
    current folder.

    name: of the scene, in messages and in run.json. Raises InputError, "dict#/path/of/keys: what is wrong, what was expected"."""
    parsed = parse(dictionary, name)
    text = repr(parsed.root) + "".join(file + sha256(b"".join(a.tobytes() for a in arrays)).hexdigest() for file, arrays in parsed.meshes.items())
    scene = _neumann.load_elements(name, parsed.root, parsed.meshes, text, lenient)
    warn(scene.warnings)
    return Scene(scene)
