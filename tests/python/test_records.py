"""Records of an irradiance cache as arrays."""

import unittest

import neumann
import numpy as np
from support import Case, cornell, furnace, scene_file


class Records(Case):
    def test_irradiance_in_a_furnace(self):
        # Closed, and of one albedo: E_k = π ρ^k. Directions that look for light by chance would make it exact; light is asked for, so
        # that records have noise. Their mean has about 1%.
        records = furnace(0.5).records(bounces=3, directions=1024)
        mean = records.irradiance.mean(axis=(0, 2))
        np.testing.assert_allclose(mean, np.pi * 0.5 ** np.arange(1, 4), rtol=0.05)

    def test_rows_belong_together(self):
        records = cornell(32).records(bounces=2, directions=64)
        n = len(records)
        for name, shape in (("position", (n, 3)), ("normal", (n, 3)), ("radius", (n,)), ("seen", (n,)), ("irradiance", (n, 2, 3)), ("pixel", (n, 2))):
            self.assertEqual(getattr(records, name).shape, shape)
        np.testing.assert_allclose(np.linalg.norm(records.normal, axis=1), 1.0, atol=1e-6)
        self.assertTrue((records.radius > 0).all())
        self.assertTrue(0 < records.seen.sum() < n)
        shown = ~np.isnan(records.pixel[:, 0])
        self.assertTrue((records.pixel[shown] >= 0).all() and (records.pixel[shown] <= 32).all())
        # What the camera reads it mostly sees.
        self.assertGreater(shown[records.seen].mean(), 0.9)

    def test_options(self):
        few, many = (len(cornell(16).records(accuracy=a, directions=64)) for a in (0.5, 0.01))
        self.assertLess(few, many)
        self.assertNotEqual(len(cornell(16).records(records="split-sphere", directions=64)), len(cornell(16).records(directions=64)))

    def test_what_is_wrong(self):
        for arguments, message in (
            ({"bounces": 0}, "bounces 0: expected 1 to 1000"),
            ({"accuracy": 0.0}, "accuracy: '0.0' is not a number above 0"),
            ({"records": "octree"}, "records: octree not in {hessian,split-sphere}"),
        ):
            with self.assertRaises(neumann.InputError) as caught:
                cornell().records(**arguments)
            self.assertEqual(str(caught.exception).splitlines()[0][: len(message)], message)


if __name__ == "__main__":
    unittest.main()
