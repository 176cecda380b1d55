"""neumann.blame() finds on arrays what the command finds in files."""

import json
import unittest

import neumann
import numpy as np
from support import Case, command, scene_file


class Blame(Case):
    @classmethod
    def setUpClass(cls):
        cls.scene = neumann.load(scene_file("mitsuba-cornell"), res=24)
        series = cls.scene.render(bounces=2, method="walk", spp=64, seed=5, quiet=True)
        cls.terms = np.array(series.terms)
        cls.again = np.array(cls.scene.render(bounces=2, method="walk", spp=64, seed=6, quiet=True).terms)

    def test_right(self):
        found = neumann.blame(self.scene, list(self.terms), again=list(self.again), counts="bounces", spp=128, quiet=True)
        self.assertTrue(found.right)
        self.assertTrue(found.noise_known)
        self.assertIsNone(found.first_wrong)
        self.assertEqual(found.suspects, [])
        self.assertEqual([(t.first, t.last, t.differs, t.worst) for t in found.terms], [(i, i, False, []) for i in range(3)])
        self.assertEqual(repr(found), "<Blame of bounces 0 to 2: right>")
        self.assertEqual(str(found), "\n".join(found.sentences))
        for i, t in enumerate(found.terms):
            np.testing.assert_allclose(t.theirs, (self.terms[i] + self.again[i]) / 2, rtol=1e-6)

    def test_wrong(self):
        self.terms[2] *= 2
        self.addCleanup(self.terms.__setitem__, 2, self.terms[2] / 2)
        found = neumann.blame(self.scene, dict(enumerate(self.terms)), counts="bounces", spp=128, quiet=True)
        self.assertFalse(found.right)
        wrong = found.first_wrong
        self.assertIs(wrong, found.terms[2])
        self.assertAlmostEqual(wrong.ratio, 2, delta=4.5 * wrong.ratio_stderr)
        self.assertLess(wrong.p, wrong.threshold)
        np.testing.assert_array_equal(wrong.theirs, self.terms[2])
        self.assertEqual({wrong[name].shape for name in ("theirs", "ours", "difference", "difference_stderr", "z")}, {(24, 24, 3)})
        np.testing.assert_allclose(wrong.difference, wrong.theirs - wrong.ours, rtol=1e-5, atol=1e-6)
        np.testing.assert_allclose(wrong.z, wrong.difference / wrong.difference_stderr, rtol=1e-5)
        self.assertIn(len(wrong.worst), (1, 2, 3))  # of 3 × 3 blocks, none beside another
        for place in wrong.worst:
            block = np.s_[place.y : place.y + place.height, place.x : place.x + place.width]
            np.testing.assert_allclose(place.theirs, wrong.theirs[block].mean((0, 1)), rtol=1e-4)
            np.testing.assert_allclose(place.ours, wrong.ours[block].mean((0, 1)), rtol=1e-4)
            self.assertTrue(place.path.text.startswith("camera → "))
        self.assertRegex(repr(found), "^<Blame of bounces 0 to 2: wrong from bounce 2 on: [a-z_]+>$")
        self.assertIn("<table>", found._repr_html_())

    def test_sums(self):
        # As Mitsuba counts, max_depth 1 is bounce 0.
        sums = {i + 1: s for i, s in enumerate(np.cumsum(self.terms, axis=0))}
        found = neumann.blame(self.scene, sums, spp=128, quiet=True)
        self.assertEqual(found.counting, "mitsuba")
        self.assertTrue(found.right)
        np.testing.assert_allclose(found.terms[1].theirs, self.terms[1], atol=1e-5)

    def test_as_the_command(self):
        done = command(
            "render", scene_file("mitsuba-cornell"), "-D", "res=24", "-n", "2", "--method", "walk", "--spp", "64", "--seed", "5", "--files",
            "pictures", "--quiet", "-o", "r", folder=self.folder,
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        files = [f"r/bounce_00{i}.exr" for i in range(3)]
        done = command("blame", *files, scene_file("mitsuba-cornell"), "-D", "res=24", "--counts", "bounces", "--spp", "64", "--json", folder=self.folder)
        printed = json.loads(done.stdout)
        found = neumann.blame(self.scene, list(self.terms), counts="bounces", spp=64, quiet=True)
        self.assertEqual(found.sentences, printed["sentences"])
        self.assertEqual([t.p for t in found.terms], [t["p"] for t in printed["terms"]])

    def test_errors(self):
        def refused(words, *arguments, **keywords):
            with self.assertRaisesRegex(neumann.InputError, f"^{words}$"):
                neumann.blame(self.scene, *arguments, **keywords, quiet=True)

        picture = self.terms[0]
        refused("counts arnold: expected mitsuba, pbrt, cycles or bounces", [picture], counts="arnold")
        refused("there are no pictures to compare with", [])
        refused(r"an array of shape \(24, 24\) is no picture, which has \(height, width, 3\)", [picture[:, :, 0]])
        refused("again has no picture with the number 1", [picture, picture], again=[picture])
        refused("a picture with the depth limit 0 holds no bounce as mitsuba counts", [picture], counts="mitsuba")
        refused("the pictures have 24×12 pixels, and the scene's film has 24×24, which is another shape", [picture[:12]])
        broken = picture.copy()
        broken[3, 5, 1] = np.nan
        refused("picture 0: the pixel in column 5 and row 3 is not finite", [broken])


if __name__ == "__main__":
    unittest.main()
