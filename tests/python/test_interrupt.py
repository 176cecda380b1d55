"""Ctrl-C ends work early and keeps what there is; meanwhile other threads of Python run."""

import contextlib
import os
import re
import signal
import threading
import time
import unittest

import neumann
import numpy as np
from support import Case, Terminal, cornell, furnace


class Interrupt(Case):
    def interrupted(self, work, after=0.0, when=lambda: True):
        """Sends the signal after so many seconds, and when that holds. The exception, and the seconds from the signal to it."""
        sent = []

        def send():
            while not when():
                time.sleep(0.05)
            sent.append(time.monotonic())
            os.kill(os.getpid(), signal.SIGINT)

        timer = threading.Timer(after, send)
        timer.start()
        try:
            with self.assertRaises(KeyboardInterrupt) as caught:
                work()
        finally:
            timer.join()
        return caught.exception, time.monotonic() - sent[0]

    def test_render(self):
        # Before the first samples, while methods are tried, there would be nothing to keep.
        with contextlib.redirect_stderr(Terminal()) as shown:
            stop, seconds = self.interrupted(
                lambda: cornell(32).render(bounces=4, time=60),
                when=lambda: re.search(r"\b[1-9]\d* samples a pixel", shown.getvalue()),
            )
        self.assertLess(seconds, 2.0)
        self.assertEqual(stop.result.run.samples.outcome, "interrupted")
        self.assertEqual(stop.result.terms.shape, (5, 32, 32, 3))
        self.assertGreater(stop.result.run.samples.per_pixel, 0)
        # And nothing is left of it.
        self.assertEqual(furnace().render(bounces=1, spp=4).run.samples.outcome, "samples reached")

    def test_fields(self):
        stop, seconds = self.interrupted(lambda: cornell(32).render(bounces=4, method="matrix", error=1e-9), 1.0)
        self.assertLess(seconds, 4.0)

    def test_series(self):
        # Mirrors that send light round and lose little: hundreds of millions of bounces, and no enclosure.
        K = 0.9999999 * np.roll(np.eye(3), 1, axis=0)
        stop, seconds = self.interrupted(lambda: neumann.series(K, [1.0, 0.0, 0.0], error=1e-14, most=10**9), 0.5)
        self.assertLess(seconds, 2.0)

    def test_matrices(self):
        # Minutes of rays.
        stop, seconds = self.interrupted(lambda: cornell(32).matrices(patches=20000, directions=16384), 2.0)
        self.assertLess(seconds, 2.0)

    def test_solve(self):
        # All solvers at an albedo where the series needs a million applications of K.
        stop, seconds = self.interrupted(lambda: furnace(0.99999).solve(patches=1000, error=1e-9, most=10**9), 6.0)
        self.assertLess(seconds, 2.0)

    def test_study(self):
        journal = self.folder / "s" / "study.journal"
        # A line for what is studied, and one for each run: two repeats of both methods.
        stop, seconds = self.interrupted(
            lambda: furnace().study(
                ["walk", "light"], samples=[1], repeats=100000, bounces=1, reference="values:1,0.5", output=self.folder / "s"
            ),
            when=lambda: journal.exists() and journal.read_text().count("\n") >= 5,
        )
        self.assertLess(seconds, 4.0)
        self.assertFalse(stop.result.complete)
        self.assertGreater(len(stop.result.table), 0)

    def test_other_threads_run(self):
        counted = [0]
        done = threading.Event()

        def count():
            while not done.is_set():
                counted[0] += 1
                time.sleep(0.001)

        thread = threading.Thread(target=count)
        thread.start()
        try:
            cornell(32).render(bounces=4, time=1.0, quiet=True)
        finally:
            done.set()
            thread.join()
        self.assertGreater(counted[0], 50)

    def test_from_threads(self):
        # One after the other, with the same bits.
        found = [None] * 3

        def work(i):
            found[i] = cornell().render(bounces=2, spp=4, quiet=True)

        threads = [threading.Thread(target=work, args=(i,)) for i in range(3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for series in found[1:]:
            np.testing.assert_array_equal(series.terms, found[0].terms)


if __name__ == "__main__":
    unittest.main()
