"""Lessons notice when what they are given is wrong: tampering.py NOTEBOOKS"""

import os
import subprocess
import sys

# What is done to the module before a lesson, and the lesson that has to stop there.
broken = {
    "a bounce that is missing from the sums": (
        "1_operators.py",
        "B.terms = property(lambda s, f=B.terms.fget: f(s) * np.float32(1.001))",
    ),
    "form factors of a room that loses light": ("2_series.py", "c = neumann.cube; neumann.cube = lambda n: r(c(n), 'F', 0.999)"),
    "a solver that stops too early": (
        "3_matrices.py",
        "s = neumann.solve; neumann.solve = lambda *a, **k: r(s(*a, **k), 'history', slice(0, 3))",
    ),
    "an error bar that is too small": (
        "4_monte_carlo.py",
        "B.terms_spread = property(lambda s, f=B.terms_spread.fget: np.zeros_like(f(s)))",
    ),
}
before = """
import runpy, sys
import numpy as np
import neumann
B = neumann.BounceSeries
def r(report, name, by):
    report[name] = report[name][by] if isinstance(by, slice) else report[name] * by
    return report
"""
for what, (lesson, change) in broken.items():
    path = os.path.join(sys.argv[1], lesson)
    run = f"sys.path.insert(0, {sys.argv[1]!r})\nsys.argv = [{path!r}]\nrunpy.run_path({path!r}, run_name='__main__')"
    program = f"{before}\n{change}\n{run}"
    done = subprocess.run([sys.executable, "-c", program], env={**os.environ, "MPLBACKEND": "Agg"}, capture_output=True, text=True)
    last = (done.stderr.strip().splitlines() or ["no error"])[-1]
    print(f"{what}, {lesson}: {last}")
    assert done.returncode != 0 and "AssertionError" in done.stderr, f"{lesson} did not notice {what}\n{done.stderr}"
