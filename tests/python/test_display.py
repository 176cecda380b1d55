"""What a notebook and a terminal are shown."""

import base64
import contextlib
import html.parser
import io
import os
import re
import struct
import sys
import types
import unittest
from unittest import mock

import neumann
import numpy as np
from support import Case, Terminal, cornell, furnace


class Tags(html.parser.HTMLParser):
    """Every tag that is opened is closed, in order."""

    alone = {"img", "br", "input"}

    def __init__(self, text):
        super().__init__()
        self.open, self.sources, self.texts = [], [], []
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attributes):
        if tag == "img":
            self.sources.append(dict(attributes)["src"])
        if tag not in self.alone:
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag, tag

    def handle_data(self, data):
        self.texts.append(data)


def size_of_png(data):
    assert data[:8] == b"\x89PNG\r\n\x1a\n" and data[12:16] == b"IHDR"
    return struct.unpack(">II", data[16:24])


class Display(Case):
    def pictures(self, text):
        tags = Tags(text)
        self.assertEqual(tags.open, [])
        return [base64.b64decode(source.removeprefix("data:image/png;base64,"), validate=True) for source in tags.sources], tags.texts

    def test_strip(self):
        pictures, texts = self.pictures(cornell().render(bounces=2, spp=4)._repr_html_())
        self.assertEqual(texts[:7], ["bounce 0", "bounce 1", "bounce 2", "rest, beyond 2", "sum 0", "sum 0..1", "sum 0..2"])
        self.assertEqual([size_of_png(p) for p in pictures], [(160, 160)] * 7)
        # Different pictures.
        self.assertEqual(len({bytes(p) for p in pictures[:4]}), 4)

    def test_one_exposure(self):
        # All pixels of bounce 1 are half as bright as those of bounce 0, so their pictures differ.
        pictures, _ = self.pictures(furnace(0.5).render(bounces=1, spp=2)._repr_html_())
        self.assertNotEqual(pictures[0], pictures[1])
        self.assertEqual(pictures[0], pictures[3])  # bounce 0 and sum 0

    def test_from_a_folder(self):
        series = cornell().render(bounces=1, spp=4)
        series.save(self.folder / "out")
        strip = lambda text: re.sub("<div style='font-size.*", "", text)
        self.assertEqual(strip(neumann.read(self.folder / "out")._repr_html_()), strip(series._repr_html_()))

    def test_other_things(self):
        for thing in (furnace().plan(), furnace().solve(patches=50, directions=16)):
            self.assertEqual(Tags(thing._repr_html_()).open, [])
        self.assertRegex(repr(cornell()), r"^<Scene .*cornell-box\.xml, res=16: \d+ shapes, 16 × 16 pixels>$")
        self.assertRegex(repr(furnace().render(bounces=1, spp=2)), "bounces 0 to 1, 8 × 8 pixels, 2 samples a pixel, samples reached")

    def test_every_result_is_brief(self):
        # A line in a shell, a table or pictures in a notebook.
        scene, size = cornell(), {"patches": 60, "directions": 16}
        series = scene.render(method="bidirectional", bounces=2, ways=1, spp=8, quiet=True)
        operators = scene.operators(**size)
        lights = scene.under_lights((2, 2), spp=8, bounces=2, quiet=True)
        points = scene.intersect([[278, 273, -800]], [[0, 0, 1]])
        results = [
            points, scene.sample_lights(points, [[0.5, 0.5]]), scene.camera_rays(),
            scene, scene.plan(), series, series[1], series[1:], series.ways[0], series.run, neumann.compare(series[0], series[1]),
            scene.chain(1, states=50), scene.photons(500), scene.records(bounces=1, directions=16), lights, lights.unbounce(quiet=True),
            scene.matrices(**size), operators, operators.symmetrised(), scene.solve(**size), scene.spectrum(**size),
            neumann.series([[0.5]], [1.0]), neumann.solve([[0.5]], [1.0]), neumann.cube(2), scene.R() @ scene.T,
            scene.study(["walk", "light"], samples=[1, 2], repeats=2, bounces=1, reference_spp=16, quiet=True),
            neumann.blame(scene, {1: series.terms[0], 2: series.sums[1]}, spp=16, quiet=True),
        ]
        kinds = {type(result) for result in results}
        for name in neumann.__all__:
            thing = getattr(neumann, name)
            if isinstance(thing, type) and not issubclass(thing, (Exception, neumann.Method)):
                self.assertIn(thing, kinds, name)
        for result in results:
            with self.subTest(result=type(result).__name__):
                self.assertRegex(repr(result), f"^<{type(result).__name__}\\b[^\n]*>$")
                self.assertLessEqual(len(repr(result)), 250)
                tags = Tags(result._repr_html_())
                self.assertEqual(tags.open, [])
                self.assertTrue(tags.texts)

    def test_progress_in_a_terminal(self):
        for stream, shown in ((Terminal(), True), (io.StringIO(), False)):
            with contextlib.redirect_stderr(stream), mock.patch.dict(os.environ, COLUMNS="200"):
                cornell(32).render(bounces=4, time=1.0)
            self.assertEqual("bounces 0..4 and rest" in stream.getvalue(), shown)
            if shown:
                self.assertRegex(stream.getvalue(), r"%   \d+ s left")
                self.assertTrue(stream.getvalue().endswith("\r\033[K"))  # and is gone
        with contextlib.redirect_stderr(Terminal()) as stream:
            cornell(32).render(bounces=4, time=0.5, quiet=True)
        self.assertEqual(stream.getvalue(), "")

    def test_progress_in_a_notebook(self):
        shown = []

        class ZMQInteractiveShell:
            pass

        def display(thing, display_id):
            shown.append(thing)
            return types.SimpleNamespace(update=shown.append)

        ipython = types.ModuleType("IPython")
        ipython.get_ipython = ZMQInteractiveShell
        ipython.display = types.ModuleType("IPython.display")
        ipython.display.HTML, ipython.display.display = str, display
        with mock.patch.dict(sys.modules, {"IPython": ipython, "IPython.display": ipython.display}):
            cornell(32).render(bounces=4, time=1.0)
        self.assertIn("<progress", "".join(shown))
        for text in shown:
            self.assertEqual(Tags(text).open, [])
        self.assertEqual(shown[-1], "")


if __name__ == "__main__":
    unittest.main()
