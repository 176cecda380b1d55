"""The page of a render that is under way, in the browser and below the cell of a notebook."""

import contextlib
import io
import re
import sys
import threading
import time
import types
import unittest
import urllib.request
from unittest import mock

import numpy as np
from support import Case, cornell

SAMPLES = 1 << 14


class Visitor:
    """Loads the page again and again until its server is gone."""

    def __init__(self):
        self.pages = []

    def visit(self, address):
        self.thread = threading.Thread(target=self._look, args=(address,), daemon=True)
        self.thread.start()

    def _look(self, address):
        with contextlib.suppress(OSError):
            while True:
                self.pages.append(urllib.request.urlopen(address, timeout=5).read().decode())
                time.sleep(0.05)


class Live(Case):
    def expect_filled(self, pages):
        samples = [int(n) for page in pages for n in re.findall(r'"per_pixel":\s*(\d+)', page)]
        self.assertTrue(any(0 < n < SAMPLES for n in samples), samples)
        self.assertEqual(samples, sorted(samples))

    def test_opens_in_the_browser_and_changes_nothing(self):
        visitor = Visitor()
        with mock.patch("webbrowser.open", visitor.visit), contextlib.redirect_stderr(io.StringIO()) as said:
            series = cornell(res=24).render(method="walk", bounces=2, spp=SAMPLES, seed=3, live=True, quiet=True)
        visitor.thread.join(10)
        self.assertFalse(visitor.thread.is_alive(), "the server ends with the render")
        self.assertRegex(said.getvalue(), r"http://127\.0\.0\.1:\d+/")
        self.expect_filled(visitor.pages)
        alone = cornell(res=24).render(method="walk", bounces=2, spp=SAMPLES, seed=3, quiet=True)
        np.testing.assert_array_equal(series.terms, alone.terms)
        np.testing.assert_array_equal(series.terms_stderr, alone.terms_stderr)

    def test_becomes_the_finished_page_of_a_notebook(self):
        visitor, shown = Visitor(), []

        class Handle:
            def update(self, what):
                shown.append(what)

        def display(what, display_id=False):
            shown.append(what)
            visitor.visit(re.search(r'src="(http://127\.0\.0\.1:\d+/)"', what)[1])
            return Handle()

        ipython = types.ModuleType("IPython.display")
        ipython.HTML, ipython.display = str, display
        with mock.patch.dict(sys.modules, {"IPython.display": ipython}), mock.patch("neumann._display.in_notebook", lambda: True):
            series = cornell(res=24).render(method="walk", bounces=2, spp=SAMPLES, live=True, quiet=True)
        visitor.thread.join(10)
        self.expect_filled(visitor.pages)
        self.assertEqual(len(shown), 2)
        self.assertIn("srcdoc=", shown[1])
        self.assertNotIn("127.0.0.1", shown[1])
        self.assertIn(f"{series.run.samples.per_pixel}", shown[1])


if __name__ == "__main__":
    unittest.main()
