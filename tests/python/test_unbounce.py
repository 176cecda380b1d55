"""neumann.unbounce(): the command's terms on arrays."""

import json
import unittest
from pathlib import Path

import neumann
import numpy as np
from support import Case, command, scene_file

CORNER = Path(scene_file("furnace")).resolve().parent.parent.parent / "notebooks" / "corner.xml"


class Unbounce(Case):
    def test_matrix(self):
        rng = np.random.default_rng(1)
        A = rng.random((6, 6))
        np.fill_diagonal(A, 0)
        A *= 0.7 / A.sum(axis=1, keepdims=True)
        direct = 1 + 0.2 * rng.random(6)  # no region is brighter under another light
        T = np.linalg.solve(np.eye(6) - A, np.diag(direct))
        found = neumann.unbounce(T, bounces=4, quiet=True)
        np.testing.assert_allclose(found.A[1], A, atol=1e-12)
        term = direct
        for n in range(4):
            np.testing.assert_allclose(found.terms[n][0, :, 2], term, rtol=1e-6)
            term = A @ term
        self.assertEqual(found.doubts, [])
        self.assertIsNone(found.terms_stderr)
        one = neumann.unbounce(T, picture=T[:, 0], bounces=1, quiet=True)
        np.testing.assert_allclose(one.terms[0][0, :, 0], direct * (np.arange(6) == 0), atol=1e-6)

    def test_as_the_command(self):
        lit = neumann.load(CORNER).under_lights((2, 2), width=8, spp=16, bounces=2, seed=3, quiet=True)
        found = lit.unbounce(seed=3, quiet=True)
        done = command("unbounce", CORNER, "--lights", "2x2", "--width", "8", "--spp", "16", "-n", "2", "--seed", "3", "-o", "out", "--quiet", folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        written = json.loads((Path(self.folder) / "out" / "unbounce.json").read_text())
        for ours, its in zip(found.bounces, written["bounces"]):
            np.testing.assert_allclose(ours.backward.mean, its["backward"]["mean"], rtol=1e-5)  # arrays are of floats
            np.testing.assert_allclose(ours.forward.mean, its["forward"]["mean"], rtol=1e-5)
        self.assertEqual(lit.pictures.shape, (4, 8, 8, 3))
        self.assertEqual(len(found.bounces), 2)
        self.assertIn("forward", found.bounces[0])

    def test_refuses(self):
        for words, arguments in (
            ("there are no pictures", {"pictures": np.zeros((0, 2, 2, 3))}),
            ("light 0 is the only picture", {"pictures": np.ones((1, 2, 2, 3))}),
            (r"lights are \(3, 1\), and there are 2 pictures", {"pictures": np.ones((2, 2, 2, 3)), "lights": (3, 1)}),
            ("use_direct: there are no direct pictures", {"pictures": np.ones((2, 2, 2, 3)), "use_direct": True}),
            ("bounces is 0, expected at least 1", {"pictures": np.ones((2, 2, 2, 3)), "bounces": 0}),
            ("regions: expected an array of shape", {"pictures": np.ones((2, 2, 2, 3)), "regions": np.zeros((3, 2))}),
        ):
            with self.assertRaisesRegex(neumann.InputError, words):
                neumann.unbounce(**arguments, quiet=True)


if __name__ == "__main__":
    unittest.main()
