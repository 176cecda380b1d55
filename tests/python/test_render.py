"""scene.render() has the same bits as the files of `neumann render`, and read() and save() agree with both."""

import filecmp
import json
import unittest

import neumann
import numpy as np
from neumann._neumann import trees_built
from support import Case, command, cornell, furnace, scene_file

OPTIONS = ["-n", "3", "--spp", "8", "--seed", "7"]


class Render(Case):
    def by_command(self, *more):
        done = command("render", scene_file("cornell-box"), "-D", "res=16", *OPTIONS, "-o", "out", *more, folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        return neumann.read(self.folder / "out")

    def expect_same(self, a, b):
        self.assertEqual(a.bounces, b.bounces)
        for name in ("terms", "terms_stderr", "sums", "sums_stderr", "rest", "rest_stderr", "terms_discretisation"):
            first, second = getattr(a, name), getattr(b, name)
            if first is None or second is None:
                self.assertIs(first, second, name)
            else:
                self.assertEqual(first.dtype, np.float32)
                np.testing.assert_array_equal(first, second, name)
        for name in ("_terms", "_sums", "_rest"):
            self.assertEqual(getattr(a, name)[-1], getattr(b, name)[-1], name)  # the means

    def test_a_scene_that_comes_along(self):
        self.assertEqual(neumann.load("furnace", res=4).path, scene_file("furnace"))
        with self.assertRaisesRegex(neumann.InputError, "^furnce: there is no such file"):
            neumann.load("furnce")

    def test_the_hemisphere_above_a_point(self):
        scene = neumann.load(scene_file("cornell-box"), res=16)
        above = scene.hemisphere(8, 13)
        self.assertEqual((above.width, above.height), (16, 16))
        series = above.render(bounces=3, spp=8, seed=7)
        self.expect_same(series, self.by_command("--hemisphere", "8,13"))
        self.assertEqual(series.terms[1][0, 0].tolist(), [0, 0, 0])
        self.assertGreater(series.terms[1].mean(), 0)
        for x, y, why in ((16, 3, "the film has x from 0 to 15"), (-1, 0, "the film has x from 0 to 15")):
            with self.assertRaisesRegex(neumann.InputError, f"^--hemisphere {x},{y}: {why}"):
                scene.hemisphere(x, y)
        with self.assertRaisesRegex(neumann.InputError, "already"):
            above.hemisphere(1, 1)

    def test_shapes(self):
        series = cornell().render(bounces=3, spp=8)
        self.assertEqual(series.terms.shape, (4, 16, 16, 3))
        self.assertEqual(series.terms_stderr.shape, (4, 16, 16, 3))
        self.assertEqual(series.sums.shape, (4, 16, 16, 3))
        self.assertEqual(series.rest.shape, (16, 16, 3))
        self.assertEqual(series.rest_stderr.shape, (16, 16, 3))
        self.assertIsNone(series.terms_discretisation)
        self.assertEqual(len(series), 4)
        self.assertEqual(len(series.table), 4)

    def test_same_bits_as_the_command(self):
        self.expect_same(cornell().render(bounces=3, spp=8, seed=7), self.by_command())
        # Deterministic on any number of threads.
        self.expect_same(cornell().render(bounces=3, spp=8, seed=7, threads=1), neumann.read(self.folder / "out"))
        # One scene renders as often as it is asked to.
        scene = cornell()
        scene.render(bounces=1, spp=2, method="light")
        self.expect_same(scene.render(bounces=3, spp=8, seed=7), neumann.read(self.folder / "out"))

    def test_a_loaded_scene_is_built_once(self):
        before = trees_built()
        scene = cornell()
        loaded = trees_built()
        self.assertGreater(loaded, before)
        few = {"patches": 100, "directions": 256}
        for method, more in (("walk", {}), ("light", {}), ("guided", few), ("corrected", few), ("photon", {}), ("cache", {}), ("metropolis", {}), ("mixed", {}), ("matrix", few), ("gather", few)):
            scene.render(bounces=1, spp=4, method=method, **more)
            scene.render(bounces=1, spp=4, method=method, **more)
        scene.plan()
        scene.matrices(**few)
        self.assertEqual(trees_built(), loaded)

    def test_other_methods(self):
        for method, more in (("bidirectional", {}), ("matrix", {"patches": 200, "directions": 32}), ("guided", {"patches": 200})):
            options = [f"--{name}={value}" for name, value in more.items()]
            self.expect_same(
                cornell().render(bounces=3, spp=8, seed=7, method=method, **more), self.by_command("--method", method, *options)
            )

    def test_row_0_is_on_top(self):
        # The lamp hangs from the ceiling.
        emission = cornell().render(bounces=0, spp=16).terms[0].sum(axis=(1, 2))
        self.assertGreater(emission[:8].sum(), 0.0)
        self.assertEqual(emission[8:].sum(), 0.0)

    def test_counts_alone_are_integers(self):
        # In a furnace means are whole numbers, too, and standard errors are 0.
        table = furnace(albedo=0.0).render(bounces=1, spp=2, quiet=True).table
        self.assertEqual({name: table[name].dtype.kind for name in ("bounce", "rays")}, {"bounce": "i", "rays": "i"})
        self.assertEqual({name: table[name].dtype.kind for name in ("mean", "mean_stderr")}, {"mean": "f", "mean_stderr": "f"})

    def test_table_and_run(self):
        here, there = cornell().render(bounces=3, spp=8, seed=7), self.by_command()
        for name in ("bounce", "mean", "mean_stderr", "ratio", "bound", "rays", "interval95"):
            np.testing.assert_array_equal(here.table[name], there.table[name], name)
        for name in ("samples", "rays", "relative_stderr_002", "relative_stderr_sum"):
            np.testing.assert_array_equal(here.convergence[name], there.convergence[name], name)
        for name in ("scene", "options", "plan", "samples", "bounces", "sum", "rest", "picture"):
            self.assertEqual(here.run[name], there.run[name], name)
        self.assertEqual({**here.run.health, "complaints": []}, {**there.run.health, "complaints": []})

    def test_command_repeats_it(self):
        series = cornell().render(bounces=2, spp=4, direct="light", split=(2, 1), roulette=0.9)
        self.assertRegex(series.run.command, r"^neumann render .*cornell-box.xml -n 2 --spp 4 --direct light .*--split 2,1 -D res=16$")
        done = command(*series.run.command.split()[1:], "-o", "again", folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.expect_same(series, neumann.read(self.folder / "again"))

    def test_save_writes_what_the_command_writes(self):
        self.by_command()
        series = cornell().render(bounces=3, spp=8, seed=7)
        series.save(self.folder / "saved")
        names = sorted(p.name for p in (self.folder / "out").iterdir())
        self.assertEqual(sorted(p.name for p in (self.folder / "saved").iterdir()), names)
        self.assertIn("index.html", names)
        for name in names:
            if name.endswith((".exr", ".png", ".gif")):
                self.assertTrue(filecmp.cmp(self.folder / "out" / name, self.folder / "saved" / name, shallow=False), name)
        self.expect_same(series, neumann.read(self.folder / "saved"))
        series.save(self.folder / "touched", files=["touch"])
        self.assertEqual({p.name for p in (self.folder / "touched").iterdir()}, {"run.json", "touch.html"})
        series.save(self.folder / "saved", files=["tables"])
        self.assertEqual({p.name for p in (self.folder / "saved").iterdir()}, {"run.json", "series.csv", "convergence.csv"})
        with self.assertRaises(neumann.InputError):
            series.save(self.folder / "saved", files=["table"])

    def test_furnace_is_exact(self):
        # K^i Le = albedo^i in every pixel: Le = 1 everywhere in a closed room of one albedo.
        series = furnace(0.5).render(bounces=4, spp=4)
        for i, term in enumerate(series.terms):
            np.testing.assert_allclose(term, 0.5**i, rtol=1e-6)
        self.assertTrue((series.terms_stderr <= 1e-6).all())

    def test_importance(self):
        series = furnace(0.5).render(bounces=2, spp=16, method="patches", importance=True, patches=100, directions=32)
        self.assertTrue(series.run.quantity.name.startswith("importance"))
        self.assertGreater(series.terms[1].mean(), 0.0)

    def test_ways(self):
        series = cornell().render(bounces=2, spp=4, method="bidirectional", ways=2)
        self.assertEqual([(way.s, way.t) for way in series.ways], [(0, 4), (1, 3), (2, 2), (3, 1)])
        self.assertEqual(series.ways[0].weighted.shape, (16, 16, 3))
        series.save(self.folder / "ways")
        for way, again in zip(series.ways, neumann.read(self.folder / "ways").ways, strict=True):
            self.assertEqual((way.s, way.t), (again.s, again.t))
            np.testing.assert_array_equal(way.weighted, again.weighted)
            np.testing.assert_array_equal(way.unweighted, again.unweighted)

    def test_true_errors_against_a_reference(self):
        self.by_command()
        series = cornell().render(bounces=3, spp=4, seed=1, reference=self.folder / "out")
        self.assertGreater(series.convergence["relative_error_001"][-1], 0.0)

    def test_compare(self):
        # Of a known difference: 1 against 2 everywhere.
        one, two = np.ones((4, 5, 3)), np.full((4, 5, 3), 2.0)
        found = neumann.compare(one, two)
        self.assertEqual(found.rmse, 1.0)
        self.assertAlmostEqual(found.rel_mse, 1.0 / (4.0 + 0.01 * 4.0), 14)
        self.assertAlmostEqual(found.mape, 1.0 / (2.0 + 0.01 * 2.0), 14)
        self.assertEqual(found.mean_difference, -1.0)
        series = self.by_command()
        table = neumann.compare(series, self.folder / "out")
        self.assertEqual(list(table["picture"][:2]), ["bounce_000", "bounce_001"])
        self.assertEqual(table["picture"][-1], "rest")
        self.assertTrue((table["rmse"] == 0.0).all())
        self.assertGreater(table["rmse_by_noise"][1], 0.0)
        # Pictures as files, which have standard errors, and against one in memory.
        files = [self.folder / "out" / f"bounce_00{i}.exr" for i in (1, 2)]
        found = neumann.compare(*files)
        self.assertEqual(found.rmse, neumann.compare(series.terms[1], str(files[1])).rmse)
        self.assertGreater(found.rmse_by_noise, 0.0)
        # The interval of a mean: the command's; of arrays none.
        by_command = json.loads(command("compare", *files, "--json", folder=self.folder).stdout)["pictures"][0]["interval"]
        self.assertAlmostEqual(found.mean_difference_interval95, (by_command[1] - by_command[0]) / 2, 12)
        again = neumann.compare(series, self.folder / "out")
        self.assertTrue((again["mean_difference_interval95"][1:4] > 0.0).all())
        self.assertIsNone(neumann.compare(one, two).mean_difference_interval95)
        with self.assertRaisesRegex(neumann.InputError, "^a series against a picture"):
            neumann.compare(series, files[0])
        with self.assertRaisesRegex(neumann.InputError, "none.exr: there is no such file"):
            neumann.compare(self.folder / "none.exr", files[0])


if __name__ == "__main__":
    unittest.main()
