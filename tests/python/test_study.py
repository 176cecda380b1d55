"""scene.study() and scene.plan() give what the commands give."""

import json
import unittest

import neumann
import numpy as np
from support import Case, command, furnace, scene_file

BOUNCES = "values:1,0.5,0.25"


class Study(Case):
    def test_figures(self):
        study = furnace().study(
            ["walk:plan=full", "light"], samples=[1, 4], repeats=4, bounces=2, reference=BOUNCES, output=self.folder / "s"
        )
        self.assertTrue(study.complete)
        self.assertEqual(study.methods, ["walk:plan=full", "light"])
        self.assertEqual(len(study.table), 2 * 2 * 4 * 4)  # methods, budgets, repeats, bounces 0 to 2 and the sum
        self.assertEqual(study.data, json.loads((self.folder / "s" / "study.json").read_text()))
        self.assertTrue((self.folder / "s" / "index.html").exists())
        curve = study.curve("light", 1)
        np.testing.assert_array_equal(curve["samples"], [1, 4])
        # The error that the table has, repeat by repeat.
        rows = study.table[(study.table["method"] == "light") & (study.table["bounce"] == "1") & (study.table["budget"] == 4)]
        self.assertEqual(len(rows), 4)
        self.assertAlmostEqual(curve["rmse"][1], np.sqrt(rows["mse"].mean()), 5)
        self.assertTrue((curve["rays"] > 0).all() and (curve["seconds"] > 0).all())
        self.assertIn("<table>", study._repr_html_())
        self.assertRegex(repr(study), "^<Study of .*furnace.xml: walk:plan=full, light; bounces 0 to 2, 4 repeats>$")
        with self.assertRaises(KeyError):
            study.curve("light", 7)

    def test_verdict_and_interval(self):
        study = furnace().study(["walk:direct=bsdf", "light"], samples=[4], interval=0.5, bounces=1, reference=BOUNCES, crop=[1, 2, 3, 4], output=self.folder / "v")
        self.assertGreaterEqual(study.data.repeats, 2)
        self.assertEqual(study.data.interval, 0.5)
        self.assertEqual(study.data.pictures[-1].verdict.best, "walk:direct=bsdf")  # by directions of the material a furnace has no variance
        self.assertTrue(study.data.verdict.startswith("In the sum of bounces 0 to 1 "))
        self.assertEqual(study.data.verdict, study.data.pictures[-1].verdict.text)
        first = study.data.crops[0]
        self.assertEqual([first.x, first.y, first.width, first.height, first.given], [1, 2, 3, 4, True])

    def test_own_estimator(self):
        # In the furnace K^i Le = albedo^i along every ray. Samples albedo^i (1 ± 1), each as likely, have the variance albedo^2i.
        seen, albedo = [], 0.5

        def coin(rays, bounces, rng):
            seen.append((rays, bounces))
            exact = albedo ** np.arange(bounces + 1)[None, :, None]
            return 2 * exact * rng.integers(0, 2, (len(rays.origin), 1, 1)) * np.ones(3)

        def exact(rays, bounces, rng):
            return np.broadcast_to(albedo ** np.arange(bounces + 1)[:, None], (len(rays.origin), bounces + 1, 3))

        samples, repeats = [4, 16, 64], 32
        study = furnace(albedo).study(["walk", coin, exact], samples=samples, repeats=repeats, bounces=2, reference=BOUNCES, quiet=True)
        self.assertEqual(study.methods, ["walk", "coin()", "exact()"])
        rays, bounces = seen[-1]
        self.assertEqual(bounces, 2)
        self.assertEqual(len(rays.origin), 64 * 64)  # 8 × 8 pixels, 64 samples
        np.testing.assert_allclose(np.linalg.norm(rays.direction, axis=1), 1.0, rtol=1e-12)
        # They go through the eye, and begin at the near plane.
        from_eye = rays.origin - [0.3, -0.2, 0.1]
        np.testing.assert_allclose(np.cross(from_eye, rays.direction), 0.0, atol=1e-7)
        self.assertTrue((np.einsum("ij,ij->i", from_eye, rays.direction) > 0).all())
        self.assertEqual(sorted(map(tuple, rays.pixel[:64])), [(x, y) for x in range(8) for y in range(8)])
        for i in range(3):
            self.assertEqual(study.curve("exact()", i)["rmse"].max(), 0.0)
            curve = study.curve("coin()", i)
            # MSE albedo^2i / samples; over 64 pixels and 32 repeats its estimate is off by √(2/2048) = 3%, and z is below 4.5 thrice.
            np.testing.assert_allclose(curve["rmse"] ** 2, albedo ** (2 * i) / np.array(samples), rtol=4.5 * 0.035)
            np.testing.assert_array_equal(curve["rays"] > 0, i == 0)
        coin_json = study.data.methods[1]
        self.assertNotIn("repeat_the_first_run", coin_json)
        self.assertIn("repeat_the_first_run", study.data.methods[0])

    def test_own_estimators_that_are_wrong(self):
        def broken(rays, bounces, rng):
            raise ZeroDivisionError("mine")

        def flat(rays, bounces, rng):
            return np.ones((len(rays.origin), 3))

        def infinite(rays, bounces, rng):
            return np.full((len(rays.origin), bounces + 1, 3), np.inf)

        study = lambda own: furnace().study([own, "walk"], samples=[1, 2], repeats=2, bounces=1, reference="values:1,0.5", quiet=True)
        with self.assertRaisesRegex(ZeroDivisionError, "^mine$"):
            study(broken)
        with self.assertRaisesRegex(
            neumann.InputError, r"^flat\(\): returned \(64, 3\), expected an array \(64, 2, 3\): rays, bounces 0 to 1, channels$"
        ):
            study(flat)
        with self.assertRaisesRegex(neumann.InputError, r"^infinite\(\): returned a value that is not finite$"):
            study(infinite)
        with self.assertRaisesRegex(neumann.InputError, r"^methods: 'flat\(\)' is given twice$"):
            furnace().study([flat, flat], samples=[1])

    def test_errors(self):
        with self.assertRaisesRegex(neumann.InputError, "^budgets: 1 after 2; budgets have to grow$"):
            furnace().study(["walk"], budgets=[2, 1])

    def test_plan(self):
        done = command("plan", scene_file("furnace"), "-D", "albedo=0.5", "-D", "res=8", "--json", folder=self.folder)
        self.assertEqual(furnace().plan(), json.loads(done.stdout))


if __name__ == "__main__":
    unittest.main()
