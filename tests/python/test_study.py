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

    def test_errors(self):
        with self.assertRaisesRegex(neumann.InputError, "^--budgets: 1 after 2; budgets have to grow$"):
            furnace().study(["walk"], budgets=[2, 1])

    def test_plan(self):
        done = command("plan", scene_file("furnace"), "-D", "albedo=0.5", "-D", "res=8", "--json", folder=self.folder)
        self.assertEqual(furnace().plan(), json.loads(done.stdout))


if __name__ == "__main__":
    unittest.main()
