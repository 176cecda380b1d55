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
    "errors of a study that are a fifth too large": (
        "5_error_and_time.py",
        "c = neumann.Study.curve; neumann.Study.curve = lambda *a: larger(c(*a).copy(), 'rmse', 1.2)",
    ),
    "light that counts for more from the lamp": ("6_importance.py", "neumann.Scene.render = brighter('light', 1.05)"),
    "a picture that does not scale with the light": (
        "7_when_numbers_break.py",
        "B.sums = property(lambda s, f=B.sums.fget: f(s) + np.float32(1e-7))",
    ),
    "points of a lamp that are not uniform": (
        "8_path_tracer.py",
        "l = neumann.Scene.sample_lights; neumann.Scene.sample_lights = lambda s, x, u: l(s, x, u**3)",
    ),
    "walls that cast no shadow": (
        "9_where_noise_comes_from.py",
        "neumann.Scene.visible = lambda s, x, y: np.ones(len(x), bool)",
    ),
    "a reflection that gains light": (
        "10_four_formulations.py",
        "R = neumann.Scene.R; neumann.Scene.R = lambda *a, **k: gaining(R(*a, **k), 1.02)",
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
def larger(table, name, by):
    table[name] *= by
    return table
def brighter(method, by):
    render = neumann.Scene.render
    def brighter(scene, **options):
        found = render(scene, **options)
        for bounce in found.run.bounces if options.get("method") == method else []:
            bounce["mean"] *= by
        return found
    return brighter
def gaining(A, by):
    return neumann.FieldOperator(str(A), lambda f: lambda x, w: by * A(f)(x, w))
"""
for what, (lesson, change) in broken.items():
    path = os.path.join(sys.argv[1], lesson)
    run = f"sys.path.insert(0, {sys.argv[1]!r})\nsys.argv = [{path!r}]\nrunpy.run_path({path!r}, run_name='__main__')"
    program = f"{before}\n{change}\n{run}"
    done = subprocess.run([sys.executable, "-c", program], env={**os.environ, "MPLBACKEND": "Agg"}, capture_output=True, text=True)
    last = (done.stderr.strip().splitlines() or ["no error"])[-1]
    print(f"{what}, {lesson}: {last}")
    assert done.returncode != 0 and "AssertionError" in done.stderr, f"{lesson} did not notice {what}\n{done.stderr}"
