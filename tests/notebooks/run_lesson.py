"""Runs a lesson as a script, from another folder: run_lesson.py LESSON.py"""

import os
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

lesson = Path(sys.argv[1]).resolve()
with tempfile.TemporaryDirectory() as folder:
    figures, elsewhere = Path(folder) / "figures", Path(folder) / "elsewhere"
    (elsewhere / "home").mkdir(parents=True)
    environment = {
        **os.environ,
        "MPLBACKEND": "Agg",
        "NEUMANN_FIGURES": str(figures),
        "HOME": str(elsewhere / "home"),
        "XDG_CACHE_HOME": str(elsewhere / "home"),
    }
    done = subprocess.run(
        [sys.executable, "-W", "error::UserWarning", "-W", "error::RuntimeWarning", lesson], cwd=elsewhere, env=environment
    )
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = used.ru_utime + used.ru_stime
    print(f"{lesson.name}: {seconds:.1f} seconds of a processor")
    assert done.returncode == 0, f"exit code {done.returncode}"
    expected = lesson.read_text(encoding="utf-8").count("plt.show()")
    assert 0 < expected == len(list(figures.glob("*.png"))), f"expected {expected} figures in {sorted(figures.iterdir())}"
    assert [p.name for p in elsewhere.rglob("*")] == ["home"], f"wrote {list(elsewhere.rglob('*'))}"
    assert seconds <= 40  # 20 seconds on two processors; others may be at work
