"""A type checker knows the keywords: mypy finds each wrong call, and nothing in the right ones."""

import os
import re
import subprocess
import sys
import tempfile
import unittest
from importlib.util import find_spec
from pathlib import Path

import neumann

RIGHT = """
import neumann
scene = neumann.load("x.xml", res=16)
scene.render(bounces=3, direct="light", split=(2, 2), method=neumann.Walk(sampler="sobol"))
scene.matrices(patches=100, channel="r").K
scene.operators(patches=100, seed=1, quiet=True)
scene.spectrum(eigenvalues=2, directions=16)
scene.solve(error=1e-6, patches=100, threads=2)
"""
WRONG = """
scene.render(bounce=3)
scene.render(direkt="light")
scene.render(direct="lihgt")
scene.render(spp="many")
scene.matrices(pathces=100)
scene.spectrum(directions="all")
scene.solve(channel="red")
neumann.Walk(patches=50)
"""


@unittest.skipUnless(find_spec("mypy"), "mypy was not found: keywords are not checked by types")
class Types(unittest.TestCase):
    def test_mypy_finds_what_is_misspelt(self):
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "calls.py").write_text(RIGHT + WRONG)
            # The package as it stands beside the file; mypy before 1.7 asks for leave to read Unpack.
            (Path(folder) / "neumann").symlink_to(Path(neumann.__file__).parent)
            words = [sys.executable, "-m", "mypy", "--enable-incomplete-feature=Unpack", "--ignore-missing-imports", "--follow-imports=silent"]
            said = subprocess.run([*words, "calls.py"], cwd=folder, env={**os.environ, "PYTHONPATH": ""}, capture_output=True, text=True)
        found = {int(line) for line in re.findall(r"^calls\.py:(\d+): error: ", said.stdout, re.MULTILINE)}
        first = RIGHT.count("\n") + 2
        self.assertEqual(found, set(range(first, first + WRONG.count("\n") - 1)), said.stdout + said.stderr)


if __name__ == "__main__":
    unittest.main()
