"""The gallery: all scenes, bounce by bounce. Renders are kept until the scene, the version or the pages change."""

import hashlib
import html
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

# With 112² pixels and bounces 0 to 8 a page has 0.3 to 1.5 MB. The number of samples is fixed, and not the time, so that the site
# has the same bits on every machine.
OPTIONS = "-D res=112 -n 8 --spp 128".split()
FILES = ["index.html", "strip-terms.png", "strip-sums.png"]
BUDGET = 2_000_000  # the largest size of an explorer, in bytes


def key_of(folder, version, root):
    """A hash of all that the pictures depend on, except changes of the program that keep its version: after these, use --fresh."""
    key = hashlib.sha256(repr((version, OPTIONS, FILES)).encode())
    for path in sorted(p for p in [*folder.rglob("*"), *(root / "apps/output/pages").iterdir()] if p.is_file()):
        if path.suffix not in (".md", ".png", ".gif"):
            key.update(str(path.relative_to(root)).encode() + b"\0" + path.read_bytes())
    return key.hexdigest()


def render_all(scenes, neumann, version, cache, root):
    """Renders the scenes that are not in the cache. Returns the folder of the files of each scene by its name."""
    done = {}
    for number, folder in enumerate(scenes):
        kept, key = cache / folder.name, key_of(folder, version, root)
        if not (kept / "key").is_file() or (kept / "key").read_text() != key:
            print(f"rendering {folder.name}, {number + 1} of {len(scenes)}", file=sys.stderr)
            new = cache / (folder.name + ".new")
            shutil.rmtree(new, ignore_errors=True)
            new.mkdir(parents=True)
            # The paths are relative to the repository, because pages contain the command.
            command = [neumann, "render", f"scenes/{folder.name}/{folder.name}.xml", *OPTIONS, "--files", "page,strips", "--quiet"]
            subprocess.run([*command, "-o", os.path.relpath(new, root)], check=True, cwd=root)
            for path in new.iterdir():
                if path.name not in FILES:
                    path.unlink()
            size = (new / "index.html").stat().st_size
            if size > BUDGET:
                raise SystemExit(f"the explorer of {folder.name} has {size} bytes, more than {BUDGET}: lower OPTIONS in apps/manual/site/gallery.py")
            (new / "key").write_text(key)
            shutil.rmtree(kept, ignore_errors=True)
            new.rename(kept)
        done[folder.name] = kept
    return done


def strip(site, page, name, file, what):
    """HTML of a strip of pictures that links to the explorer. On a narrow screen the strip can be scrolled."""
    there = f"scenes/{name}/"
    return (
        f'<a class="strip" href="{site.relative(there + "explorer.html", page)}">'
        f'<img src="{site.relative(there + file, page)}" alt="{html.escape(what)}" loading="lazy"></a>'
    )


def summary_of(site, page, folder):
    """The title of a scene's README.md and its first sentence, in HTML."""
    text = (folder / "README.md").read_text(encoding="utf-8")
    title, first = re.match(r"# (.+)\n+((?:.+\n)+)", text).groups()
    sentence = re.match(r".+?\.(?=\s)", first, re.DOTALL)[0]
    return title, site.from_markdown(sentence, page)[0]


def write_gallery(site, page, scenes, renders):
    out = [
        "<h1>Gallery</h1>",
        "<p>All scenes that come along, each taken apart into the light that was scattered not at all, once, twice, up to six times. "
        "The upper row of a strip has all bounces at one exposure; below, each is brightened by the power of two that makes it visible. "
        "The explorer of a scene has bounces 0 to 8 and the rest, with the value and the 95% interval of every pixel.</p>",
    ]
    if renders:
        out.append(f"<p>Every scene is rendered by <code>neumann render NAME.xml {' '.join(OPTIONS)}</code>.</p>")
    else:
        out.append("<p>This site was made without renders: <code>./run site</code> makes one with pictures.</p>")
    for folder in scenes:
        name = folder.name
        # The links of the paragraph are removed, because they are relative to the page of the scene.
        title, text = summary_of(site, next(p for p in site.pages if p.source == folder / "README.md"), folder)
        text = re.sub(r"<a [^>]*>|</a>", "", text)
        out.append(f'<section class="scene"><h2 id="{name}">{html.escape(title)}</h2>')
        if name in renders:
            out.append(strip(site, page, name, "strip-terms.png", f"Bounces 0 to 6 of {name}"))
            out.append(f'{text}<p><a class="button" href="scenes/{name}/explorer.html">Explorer</a> &nbsp; ')
        else:
            out.append(f"{text}<p>")
        out.append(f'<a href="scenes/{name}/index.html">About the scene</a></p></section>')
    site.write(page, "\n".join(out))


def write_scene(site, page, render):
    body, toc = site.from_markdown(page.source.read_text(encoding="utf-8"), page)
    name = page.source.parent.name
    scene = site.copy(page.source.parent / f"{name}.xml")
    more = f'<p><a href="{site.relative(scene, page)}">{name}.xml</a></p>'
    if render:
        for file in FILES:
            to = site.folder / f"scenes/{name}" / ("explorer.html" if file == "index.html" else file)
            to.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(Path(render) / file, to)
        more = (
            strip(site, page, name, "strip-terms.png", f"Bounces 0 to 6 of {name}")
            + strip(site, page, name, "strip-sums.png", f"The sums of bounces 0 to 0, 1, … 6 of {name}")
            + f'<p><a class="button" href="explorer.html">Explorer</a> &nbsp; <a href="{site.relative(scene, page)}">{name}.xml</a></p>'
        )
    body = body.replace("</h1>", "</h1>\n" + more, 1)
    site.write(page, body, toc)
