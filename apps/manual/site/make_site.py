#!/usr/bin/env python3
"""Makes the site: the manual, the lessons and the gallery as pages that need no server and no network.

    ./run site [-o DIR] [--no-renders] [--no-lessons] [--fresh]

The texts of the repository become pages: its Markdown files, the manual pages of commands, and the lessons. python3-markdown
converts them. MkDocs, which is in Debian as well, is not used: MkDocs brings Bootstrap, jQuery and a search that needs a server,
and reads one folder of Markdown. Commands, lessons, scenes and links out of that folder would need extensions as long as this
program.
"""

import argparse
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

import gallery
import lessons
from site_pages import Site

ROOT = Path(__file__).resolve().parents[3]

# The pages in the order of README.md. Pages that are not named here follow.
MANUAL = """lectures methods measurements limits explorer error-bars health matrices machines python speed scenes collada gltf blender pbrt tungsten
counting building""".split()
# The methods in the order of `render --help`.
METHODS = """auto walk guided corrected surface light shooting bidirectional mixed photon cache metropolis classic pointwise matrix
gather patches""".split()
TUTORIALS = "my-first-scene lecture-figure wrong-bounce paper-figure room-from-blender k-in-scipy".split()


def in_order(paths, names):
    return sorted(paths, key=lambda p: (names.index(p.stem) if p.stem in names else len(names), p.stem))


def main():
    parser = argparse.ArgumentParser(prog="./run site", description="Makes the site of neumann.")
    parser.add_argument("-o", type=Path, default=ROOT / "out/site", metavar="DIR", help="where it goes; default out/site")
    parser.add_argument("--no-renders", action="store_true", help="without the pictures of the gallery")
    parser.add_argument("--no-lessons", action="store_true", help="lessons without their outputs")
    parser.add_argument("--fresh", action="store_true", help="renders and runs anew what was kept in build/site-cache")
    arguments = parser.parse_args()
    began = time.monotonic()
    neumann = os.environ.get("NEUMANN")
    version = ""
    if neumann:
        version = subprocess.run([neumann, "--version"], check=True, capture_output=True, text=True).stdout.strip()
    cache = ROOT / "build/site-cache"
    if arguments.fresh:
        shutil.rmtree(cache, ignore_errors=True)

    # The site is first made in a folder beside the output folder, which it replaces at the end.
    if arguments.o.exists() and any(arguments.o.iterdir()) and not (arguments.o / "style.css").is_file():
        sys.exit(f"{arguments.o} holds something that is no site: expected an empty folder, or that of an earlier ./run site")
    made = arguments.o.with_name(arguments.o.name + ".unfinished")
    shutil.rmtree(made, ignore_errors=True)
    made.mkdir(parents=True)
    site = Site(ROOT, made, neumann)

    manual = ROOT / "apps/manual"
    scenes = [p.parent for p in sorted(ROOT.glob("scenes/*/*.xml")) if p.stem == p.parent.name]
    site.add("", ROOT / "README.md", "index.html", title="neumann", label="What it is")
    site.add("", None, "gallery.html", label="Gallery")
    for path in in_order(manual.glob("tutorials/*.md"), TUTORIALS):
        if path.stem != "README":
            site.add("Tutorials", path, f"tutorials/{path.stem}.html")
    site.add("Lessons", ROOT / "notebooks/README.md", "lessons/index.html", label="All lessons")
    for path in lessons.files(ROOT):
        site.add("Lessons", path, f"lessons/{path.stem}.html", title=lessons.title(path))
    for path in in_order(manual.glob("*.md"), MANUAL):
        if path.stem != "glossary":
            site.add("Manual", path, f"manual/{path.stem}.html")
    for path in in_order(manual.glob("methods/*.md"), METHODS):
        site.add("Methods", path, f"manual/methods/{path.stem}.html", label=path.stem)
    site.add("Commands", manual / "neumann.txt", "commands/neumann.html", title="neumann")
    for path in sorted(manual.glob("*.txt")):
        if path.stem != "neumann":
            site.add("Commands", path, f"commands/{path.stem}.html", title=path.stem)
    site.add("Scenes", ROOT / "scenes/README.md", "scenes/index.html", label="All scenes")
    for folder in scenes:
        site.add("Scenes", folder / "README.md", f"scenes/{folder.name}/index.html", label=folder.name)
    site.add("Scenes", ROOT / "scenes/compare/README.md", "scenes/compare/index.html")
    site.add("Words", manual / "glossary.md", "manual/glossary.html")
    site.add("Words", ROOT / "operators/NOTATION.md", "manual/notation.html")
    site.add("Project", ROOT / "CONTRIBUTING.md", "contributing.html")
    site.add("Project", ROOT / "CHANGELOG.md", "changelog.html")

    renders = {}
    if neumann and not arguments.no_renders:
        renders = gallery.render_all(scenes, neumann, version, cache / "scenes", ROOT)
    outputs = {}
    if not arguments.no_lessons:
        outputs = lessons.run_all(ROOT, version, cache / "lessons")

    for page in site.pages:
        if page.source is None:
            gallery.write_gallery(site, page, scenes, renders)
        elif page.source.parent in scenes:
            gallery.write_scene(site, page, renders.get(page.source.parent.name))
        elif page.source.suffix == ".py":
            lessons.write_lesson(site, page, outputs.get(page.source.stem))
        elif page.source.suffix == ".txt":
            site.write_command(page)
        else:
            site.write_markdown(page)
    site.finish()

    shutil.rmtree(arguments.o, ignore_errors=True)
    made.rename(arguments.o)
    files = [p for p in arguments.o.rglob("*") if p.is_file()]
    size = sum(p.stat().st_size for p in files) / 1e6
    print(f"{len(site.pages)} pages, {size:.1f} MB, in {time.monotonic() - began:.0f} s: {arguments.o / 'index.html'}")


if __name__ == "__main__":
    main()
