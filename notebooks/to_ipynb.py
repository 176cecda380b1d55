#!/usr/bin/env python3
"""Turns lessons into Jupyter notebooks, all of them and beside themselves without arguments:

    python3 notebooks/to_ipynb.py [-o DIR] [LESSON.py …]

Reads jupytext's percent format as far as the lessons use it: "# %%" begins a cell of code, "# %% [markdown]" one of text in
comments. Needs nothing but Python.
"""

import argparse
import json
import re
from pathlib import Path


def lessons(folder):
    """The lessons of a folder in their order: 10_… comes after 9_…"""
    return sorted(folder.glob("[1-9]*_*.py"), key=lambda path: int(path.stem.partition("_")[0]))


def cells(source):
    """[(kind, text)] of a file in percent format."""
    found = []
    for part in re.split(r"^# %%", source, flags=re.MULTILINE)[1:]:
        mark, _, body = part.partition("\n")
        kind = "markdown" if mark.strip() == "[markdown]" else "code"
        if kind == "code" and mark.strip():
            raise SystemExit(f"a cell begins with '# %%{mark}': expected '# %%' or '# %% [markdown]'")
        if kind == "markdown":
            body = re.sub(r"^# ?", "", body, flags=re.MULTILINE)
        found.append((kind, body.strip("\n")))
    return found


def notebook(source):
    """The notebook as a dict, nbformat 4.5, without outputs."""
    result = []
    for number, (kind, text) in enumerate(cells(source)):
        cell = {"cell_type": kind, "id": f"cell-{number}", "metadata": {}, "source": text.splitlines(keepends=True)}
        if kind == "code":
            cell.update(execution_count=None, outputs=[])
        result.append(cell)
    kernel = {"display_name": "Python 3", "language": "python", "name": "python3"}
    return {
        "cells": result,
        "metadata": {"kernelspec": kernel, "language_info": {"name": "python"}},
        "nbformat": 4,
        "nbformat_minor": 5,
    }


def main():
    here = Path(__file__).resolve().parent
    parser = argparse.ArgumentParser(description="Turns lessons into Jupyter notebooks.")
    parser.add_argument("lessons", nargs="*", type=Path, metavar="LESSON.py")
    parser.add_argument("-o", type=Path, default=here, metavar="DIR", help="where they go; beside the lessons without it")
    arguments = parser.parse_args()
    arguments.o.mkdir(parents=True, exist_ok=True)
    for lesson in arguments.lessons or lessons(here):
        path = arguments.o / f"{lesson.stem}.ipynb"
        text = json.dumps(notebook(lesson.read_text(encoding="utf-8")), ensure_ascii=False, indent=1) + "\n"
        path.write_text(text, encoding="utf-8")
        print(path)


if __name__ == "__main__":
    main()
