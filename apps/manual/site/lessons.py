"""Lessons as pages and as notebooks; they have outputs if neumann, nbclient and matplotlib can be imported."""

import base64
import hashlib
import html
import importlib.util
import io
import json
import os
import re
import sys
from pathlib import Path


def files(root):
    return converter(root).lessons(root / "notebooks")


def title(path):
    return re.search(r"^# # (.+)$", path.read_text(encoding="utf-8"), re.MULTILINE)[1]


def converter(root):
    spec = importlib.util.spec_from_file_location("to_ipynb", root / "notebooks/to_ipynb.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def run_all(root, version, cache):
    """Returns notebooks with outputs by the lesson's name; an empty dictionary if a package that runs them is missing."""
    missing = [name for name in ("neumann", "nbclient", "nbformat", "ipykernel", "matplotlib", "scipy") if not importlib.util.find_spec(name)]
    if missing:
        print(f"Lessons come without outputs: this python3 has no {', '.join(missing)}.", file=sys.stderr)
        return {}
    import nbclient
    import nbformat

    os.environ["PYDEVD_DISABLE_FILE_VALIDATION"] = "1"  # silences a warning about the kernel's debugger, which is not used
    os.environ["NEUMANN_SLIDERS"] = "0"  # sliders need a kernel, which a page does not have
    done = {}
    for path in files(root):
        key = hashlib.sha256(version.encode())
        for used in [path, root / "notebooks/lesson.py", root / "notebooks/corner.xml", *sorted(root.glob("scenes/*/*.xml"))]:
            key.update(used.read_bytes())
        kept = cache / f"{path.stem}.{key.hexdigest()[:16]}.ipynb"
        if not kept.is_file():
            print(f"running {path.name}", file=sys.stderr)
            notebook = nbformat.reads(json.dumps(converter(root).notebook(path.read_text(encoding="utf-8"))), as_version=4)
            where = {"metadata": {"path": str(path.parent)}}
            nbclient.NotebookClient(notebook, timeout=600, kernel_name="python3", resources=where, record_timing=False).execute()
            cache.mkdir(parents=True, exist_ok=True)
            for old in cache.glob(f"{path.stem}.*.ipynb"):
                old.unlink()
            # The place of the repository on this machine is removed from all paths.
            kept.write_text(nbformat.writes(notebook).replace(str(root) + "/", ""), encoding="utf-8")
        done[path.stem] = json.loads(kept.read_text(encoding="utf-8"))
    return done


def output_as_html(output, keep):
    """Returns an output as HTML. keep(PNG) saves a figure beside the page, and returns its file name."""
    kind = output["output_type"]
    if kind == "stream":
        text = re.sub(r"[^\n]*\r(?!\n)", "", joined(output["text"]))
        return f"<pre>{html.escape(text)}</pre>" if text.strip() and output["name"] == "stdout" else ""
    data = output.get("data", {})
    if "image/png" in data:
        return f'<img alt="figure" src="{keep(base64.b64decode(joined(data["image/png"])))}" loading="lazy">'
    if "text/html" in data:
        return joined(data["text/html"])
    return f"<pre>{html.escape(joined(data['text/plain']))}</pre>" if "text/plain" in data else ""


def keeper(site, page):
    """Returns a function that saves a figure beside a page as lossless WebP, which has two thirds of the size of PNG."""
    count = 0

    def keep(png):
        from PIL import Image  # is installed where figures are, because matplotlib needs it

        nonlocal count
        count += 1
        name = f"{page.source.stem}_{count}.webp"
        Image.open(io.BytesIO(png)).convert("RGB").save(site.folder / "lessons" / name, lossless=True, quality=50)
        return name

    return keep


def joined(text):
    return text if isinstance(text, str) else "".join(text)


def write_lesson(site, page, notebook):
    keep = keeper(site, page)
    what = "with outputs" if notebook else "without outputs"
    if not notebook:
        notebook = converter(site.root).notebook(page.source.read_text(encoding="utf-8"))
    name = page.source.stem
    path = site.folder / f"lessons/{name}.ipynb"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(notebook, ensure_ascii=False, indent=1) + "\n", encoding="utf-8")
    source = site.relative(site.copy(page.source), page)
    out = []
    for cell in notebook["cells"]:
        text = joined(cell["source"])
        if cell["cell_type"] == "markdown":
            out.append(site.from_markdown(text, page, formulas=True)[0])
            continue
        out.append(f'<pre class="in" tabindex="0"><code>{html.escape(text)}</code></pre>')
        shown = "\n".join(filter(None, (output_as_html(output, keep) for output in cell.get("outputs", []))))
        if shown:
            out.append(f'<div class="out">{shown}</div>')
    files_line = f'<p><a href="{name}.ipynb" download>{name}.ipynb</a>, the notebook {what}; <a href="{source}" download>{name}.py</a>, the lesson as a script</p>'
    body = "\n".join(out).replace("</h1>", f"</h1>\n{files_line}", 1)
    site.write(page, body)
