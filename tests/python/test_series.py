"""A series is indexed, sliced, shown, merged, and turned into what other libraries have."""

import importlib.util
import json
import os
import sys
import types
import unittest
from unittest import mock

import neumann
import numpy as np
from support import Case, command, cornell, furnace, scene_file


def render(seed=0, **options):
    return cornell().render(**{"bounces": 3, "spp": 64, "method": "walk", "seed": seed, "quiet": True, **options})


class Bounces(Case):
    def test_index(self):
        series = render()
        for i in range(4):
            np.testing.assert_array_equal(series[i].value, series.terms[i])
            np.testing.assert_array_equal(series[i].stderr, series.terms_stderr[i])
            np.testing.assert_array_equal(series[i].spread, series.terms_spread[i])
            self.assertIsNone(series[i].discretisation)
            self.assertAlmostEqual(series[i].mean, series.table["mean"][i], 6)
        np.testing.assert_array_equal(np.asarray(series[-1]), series.terms[3])
        np.testing.assert_array_equal(np.asarray(series[1], dtype=float) * 2, 2 * series.terms[1].astype(float))
        for outside in (4, -5):
            with self.assertRaisesRegex(IndexError, f"^bounce {outside}: there are bounces 0 to 3$"):
                series[outside]
        self.assertEqual([b.bounce for b in series], [0, 1, 2, 3])

    def test_slice(self):
        series = render()
        self.assertEqual([b.bounce for b in series[1:]], [1, 2, 3])
        self.assertEqual([b.bounce for b in series[::-2]], [3, 1])
        self.assertEqual(repr(series[1:3]), "<Bounces 1, 2>")
        self.assertEqual(list(series[7:]), [])

    def test_compare(self):
        a, b = render(1), render(2)
        rows = neumann.compare(a, b)
        found = neumann.compare(a[2], b[2])
        row = rows[rows["picture"] == "bounce_002"][0]
        for name in ("rmse", "rel_mse", "mean_difference", "mean_difference_interval95"):
            self.assertEqual(found[name], row[name])

    def test_names_of_bytes(self):
        folder = self.folder / os.fsdecode(b"m\xfcll")
        a = render(1)
        a.save(folder)
        there = neumann.read(folder)
        np.testing.assert_array_equal(there[1].value, a[1].value)
        self.assertEqual(neumann.compare(folder / "bounce_001.exr", a[1])["rmse"], 0)

    def test_flip(self):
        a, b = render(1), render(2)
        a.save(self.folder / "a")
        b.save(self.folder / "b")
        done = command("compare", "a", "b", "--flip", "--json", folder=self.folder)
        said = {p["name"]: p["flip"] for p in json.loads(done.stdout)["pictures"]}
        rows = neumann.compare(a, b, flip=True)
        self.assertEqual(list(rows["picture"]), list(said))
        np.testing.assert_allclose(rows["flip"], list(said.values()), rtol=1e-12)
        self.assertGreater(said["bounce_002"], 0)
        errors = neumann.flip(a[2], b[2])
        self.assertEqual((errors.shape, errors.dtype), ((16, 16), np.float32))
        self.assertAlmostEqual(errors.mean(dtype=float), said["bounce_002"], 12)
        file = self.folder / "a" / "bounce_002.exr"
        np.testing.assert_array_equal(neumann.flip(file, b.terms[2]), errors)
        self.assertEqual(neumann.compare(file, b[2], flip=True).flip, neumann.compare(a[2], b[2], flip=True).flip)
        self.assertNotIn("flip", neumann.compare(a[2], b[2]))
        # No difference, and pixels that are no numbers in one of them.
        broken = b.terms[2].copy()
        broken[3, 5] = np.nan
        self.assertEqual(neumann.flip(b[2], b[2]).max(), 0)
        self.assertEqual(neumann.flip(broken, b[2])[3, 5], 1)
        for wrong, message in (((a, b), "^a series; FLIP is of two pictures, as series.2. is one$"), ((a[2], np.zeros((16, 16))), "^an array of shape .16, 16. is no picture")):
            with self.assertRaisesRegex(neumann.InputError, message):
                neumann.flip(*wrong)
        with self.assertRaises(neumann.InputError):
            neumann.flip(a[2], np.zeros((8, 16, 3)))


class Merging(Case):
    def test_as_all_replicates(self):
        a, b = render(1), render(2)
        both = a + b
        n = a.run.samples.replicates
        self.assertEqual(both.run.samples.replicates, 2 * n)
        self.assertEqual(both.run.samples.per_pixel, 128)
        for name in ("terms", "sums"):
            x, y = (getattr(s, name).astype(float) for s in (a, b))
            np.testing.assert_allclose(getattr(both, name), (x + y) / 2, rtol=1e-5, atol=1e-7)
            # Of replicates r: Σ (r − mean)² = N (N − 1) spread², and that of both is the sum of those of each and n/2 (x − y)².
            u, v, w = (getattr(s, name + "_spread").astype(float) for s in (a, b, both))
            expected = np.sqrt((n * (n - 1) * (u**2 + v**2) + n / 2 * (x - y) ** 2) / (2 * n * (2 * n - 1)))
            np.testing.assert_allclose(w, expected, rtol=1e-4, atol=1e-7)
        self.assertEqual(both.title, a.title)
        three = both + render(3)
        self.assertEqual(three.run.samples.per_pixel, 192)
        np.testing.assert_allclose(three.terms, (a.terms + b.terms + render(3).terms) / 3, rtol=1e-5, atol=1e-6)
        three.save(self.folder / "out")
        np.testing.assert_array_equal(neumann.read(self.folder / "out").terms, three.terms)

    def test_what_does_not_go_together(self):
        a = render(1)
        a.save(self.folder / "a")
        fields = cornell().render(method="matrix", bounces=3, patches=100, directions=16, spp=4, quiet=True)
        for other, said in (
            (a, "the first series and the second series have the same samples, of seed 1; merged, these would count twice"),
            (render(2, bounces=2), "the first series and the second series cannot be merged: one has bounces 0 to 3, and the other 0 to 2; give both the same number"),
            (render(2, method="light"), "the first series and the second series cannot be merged: one is by walk, and the other by light"),
            (
                furnace().render(bounces=3, spp=64, seed=2, method="walk", quiet=True),
                "the first series and the second series cannot be merged: their scenes are not the same",
            ),
            (fields, "the second series was rendered from fields on patches, and has no samples that could be put together"),
            (neumann.read(self.folder / "a"), f"{self.folder / 'a'}: was read from there; neumann merge puts folders together"),
        ):
            with self.assertRaises(neumann.InputError) as caught:
                a + other
            self.assertEqual(str(caught.exception), said)
        with self.assertRaises(TypeError):
            a + 1


class Showing(Case):
    def notebook(self):
        class ZMQInteractiveShell:
            pass

        shown = []

        def display(thing, display_id=False):
            # What has an id is the bar of something that takes a while, as on a busy machine.
            if display_id:
                return mock.Mock()
            shown.append(thing)

        ipython = types.ModuleType("IPython")
        ipython.get_ipython = ZMQInteractiveShell
        ipython.display = types.ModuleType("IPython.display")
        ipython.display.HTML, ipython.display.display = str, display
        patch = mock.patch.dict(sys.modules, {"IPython": ipython, "IPython.display": ipython.display})
        patch.start()
        self.addCleanup(patch.stop)
        return shown

    def test_in_a_notebook(self):
        series = render()
        shown = self.notebook()
        series.show(2)
        series[2].show()
        self.assertEqual(shown[0], shown[1])
        self.assertIn("bounce 2", shown[0])
        self.assertEqual(shown[0].count("<img"), 1)
        series.show()
        self.assertEqual(shown[2], series._repr_html_())

    def test_alone(self):
        series = render()
        with mock.patch("webbrowser.open") as opened, mock.patch("tempfile.tempdir", str(self.folder)):
            series.show(1)
            series.show()
        pages = [self.folder / call.args[0].rpartition("/")[2] for call in opened.call_args_list]
        self.assertIn("bounce 1", pages[0].read_text())
        self.assertEqual(pages[1].read_text(), series._repr_html_())

    def test_page(self):
        series = render()
        series.save(self.folder / "out")
        explorer = (self.folder / "out" / "index.html").read_text()
        shown = self.notebook()
        neumann.read(self.folder / "out").page(height=500)
        frame = __import__("html").unescape(shown[0])
        self.assertIn(explorer, frame)
        self.assertIn("height: 500px", frame)
        series.page()
        # The same, but for what tells folder and time.
        self.assertAlmostEqual(len(shown[1]) / len(shown[0]), 1.0, 2)
        series.save(self.folder / "pictures", files=["pictures", "tables"])
        with self.assertRaisesRegex(neumann.InputError, "pictures: was written without its page, which --files page adds$"):
            neumann.read(self.folder / "pictures").page()


class Elsewhere(Case):
    @unittest.skipIf(importlib.util.find_spec("xarray") is None, "xarray was not found")
    def test_xarray(self):
        series = render()
        data = series.to_xarray()
        self.assertEqual(dict(data.sizes), {"bounce": 4, "y": 16, "x": 16, "channel": 3})
        np.testing.assert_array_equal(data.term.sel(bounce=2, channel="g"), series.terms[2, ..., 1])
        np.testing.assert_array_equal(data.sum_stderr, series.sums_stderr)
        np.testing.assert_array_equal(data.rest, series.rest)
        np.testing.assert_array_equal(data.rest_spread, series.rest_spread)
        self.assertNotIn("term_discretisation", data)
        self.assertEqual(data.attrs["units"], "W m^-2 sr^-1")

    @unittest.skipIf(importlib.util.find_spec("pandas") is None, "pandas was not found")
    def test_pandas(self):
        series = render()
        frame = series.to_pandas()
        self.assertEqual(list(frame.index), [0, 1, 2, 3])
        self.assertEqual(frame.loc[2, "mean"], series.table["mean"][2])


if __name__ == "__main__":
    unittest.main()
