"""Photons as arrays."""

import unittest

import neumann
import numpy as np
from support import Case, cornell, furnace, scene_file


class Photons(Case):
    def test_power_in_a_furnace(self):
        # Closed, and of one albedo: of what arrives half goes on.
        photons = furnace(0.5).photons(2000, bounces=4)
        power = np.array([photons.power[photons.bounce == j].sum(axis=0) for j in (1, 2, 3, 4)])
        np.testing.assert_allclose(power[1:], 0.5 * power[:-1], rtol=1e-5)
        self.assertEqual(len(photons), 4 * 2000)
        self.assertFalse(photons.caustic.any())
        np.testing.assert_array_equal(np.bincount(photons.path), np.full(2000, 4))

    def test_rows_belong_together(self):
        photons = cornell(32).photons(5000, bounces=3)
        n = len(photons)
        for name, shape in (("position", (n, 3)), ("normal", (n, 3)), ("wi", (n, 3)), ("power", (n, 3)), ("pixel", (n, 2)), ("path", (n,))):
            self.assertEqual(getattr(photons, name).shape, shape)
        np.testing.assert_allclose(np.linalg.norm(photons.wi, axis=1), 1.0, atol=1e-6)
        # Of one path, from one vertex to the next.
        for path in photons.path[photons.bounce == 3][:50]:
            x = photons.position[photons.path == path]
            back = photons.wi[photons.path == path]
            for j in (1, 2):
                w = (x[j - 1] - x[j]) / np.linalg.norm(x[j - 1] - x[j])
                self.assertGreater(np.dot(w, back[j]), 1 - 1e-5)
        # What is seen is on the film, and something is hidden behind the boxes or the camera.
        seen = ~np.isnan(photons.pixel[:, 0])
        self.assertTrue(0.2 < seen.mean() < 0.95)
        self.assertTrue((photons.pixel[seen] >= 0).all() and (photons.pixel[seen] <= 32).all())

    def test_caustics(self):
        photons = neumann.load(scene_file("glass-ball"), res=16).photons(20000, bounces=3)
        self.assertFalse(photons.caustic[photons.bounce == 1].any())
        self.assertTrue(photons.caustic[photons.bounce == 3].any())

    def test_what_is_wrong(self):
        for arguments, message in (({"paths": 0}, "paths 0: expected 1 to 268435456"), ({"bounces": 0}, "bounces 0: expected at least 1")):
            with self.assertRaises(neumann.InputError) as caught:
                cornell().photons(**arguments)
            self.assertEqual(str(caught.exception), message)


if __name__ == "__main__":
    unittest.main()
