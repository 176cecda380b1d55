"""What the tests share: scenes, the command, and an empty folder for each."""

import io
import os
import subprocess
import tempfile
import unittest
import warnings
from pathlib import Path

import neumann

SCENES = Path(os.environ["SCENES"])


def scene_file(name):
    return str(SCENES / name / f"{name}.xml")


def cornell(res=16):
    return neumann.load(scene_file("cornell-box"), res=res)


def furnace(albedo=0.5, res=8):
    return neumann.load(scene_file("furnace"), albedo=albedo, res=res)


def ball(folder, albedo):
    """A sphere of radius 2 that shines inwards: every point sees all others, and a patch itself."""
    path = folder / "ball.xml"
    path.write_text(
        '<scene version="3.0.0"><shape type="sphere"><float name="radius" value="2"/><boolean name="flip_normals" value="true"/>'
        f'<bsdf type="diffuse"><rgb name="reflectance" value="{albedo}"/></bsdf>'
        '<emitter type="area"><rgb name="radiance" value="1"/></emitter></shape><sensor type="perspective"><film type="hdrfilm">'
        '<integer name="width" value="8"/><integer name="height" value="8"/></film></sensor></scene>'
    )
    return neumann.load(path)


def command(*arguments, folder):
    return subprocess.run([os.environ["NEUMANN"], *map(str, arguments)], cwd=folder, capture_output=True, text=True)


class Terminal(io.StringIO):
    """What a terminal was shown, in place of stderr."""

    def isatty(self):
        return True


class Case(unittest.TestCase):
    def setUp(self):
        self._folder = tempfile.TemporaryDirectory()
        self.addCleanup(self._folder.cleanup)
        self.folder = Path(self._folder.name)
        # In a test, everything is said.
        context = warnings.catch_warnings(record=True)
        self.warned = context.__enter__()
        self.addCleanup(context.__exit__, None, None, None)
        warnings.simplefilter("always")
