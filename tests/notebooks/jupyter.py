"""Lessons become notebooks that Jupyter can open, and the first of them runs there: jupyter.py NOTEBOOKS"""

import os
import subprocess
import sys
import tempfile
from pathlib import Path

import nbclient
import nbformat

source = Path(sys.argv[1])
with tempfile.TemporaryDirectory() as folder:
    made = subprocess.run(
        [sys.executable, source / "to_ipynb.py", "-o", folder], check=True, capture_output=True, text=True
    ).stdout.split()
    lessons = sorted(source.glob("[1-9]*_*.py"), key=lambda path: int(path.stem.partition("_")[0]))
    assert [Path(p).stem for p in made] == [p.stem for p in lessons]
    notebooks = {}
    for path, lesson in zip(made, lessons):
        notebook = notebooks[lesson.stem] = nbformat.read(path, as_version=4)
        nbformat.validate(notebook)
        kinds = [cell.cell_type for cell in notebook.cells]
        assert kinds[0] == "markdown" and notebook.cells[0].source.startswith(f"# {lesson.stem.partition('_')[0]}. "), "begins with its title"
        assert "**What this teaches.**" in notebook.cells[0].source
        assert kinds[-1] == "markdown" and "## Exercises" in notebook.cells[-1].source, "ends with exercises"
        lines = [line for line in lesson.read_text(encoding="utf-8").splitlines() if not line.startswith("# %%")]
        # Of a lesson, text and comments begin with "#"; of a notebook, comments alone.
        text = [
            (line if cell.cell_type == "markdown" else line.removeprefix("#")).strip()
            for cell in notebook.cells
            for line in cell.source.splitlines()
            if line.strip(" #")
        ]
        assert [line.removeprefix("#").strip() for line in lines if line.strip(" #")] == text

    os.environ["NEUMANN_SLIDERS"] = "0"  # figures and not widgets, as in the site
    notebook = notebooks["1_operators"]
    nbclient.NotebookClient(notebook, timeout=100, kernel_name="python3", resources={"metadata": {"path": str(source)}}).execute()
    outputs = [output for cell in notebook.cells if cell.cell_type == "code" for output in cell.outputs]
    drawn = sum("image/png" in output.get("data", {}) for output in outputs)
    expected = sum(cell.source.count("plt.show()") for cell in notebook.cells if cell.cell_type == "code")
    assert drawn == expected, f"{drawn} figures, expected {expected}"
    strips = [output.data["text/html"] for output in outputs if "bounce 5" in output.get("data", {}).get("text/html", "")]
    assert len(strips) == 1 and strips[0].count("<img") == 13, "CS184's exercise: six bounces, the rest, and six sums"
