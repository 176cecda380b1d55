"""The pages of the site: converts texts to HTML, resolves the links between them, and makes the navigation."""

import html
import os
import re
import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path

try:
    import markdown
except ImportError:
    raise SystemExit("This python3 has no Python-Markdown, which the site is made with: install Debian's python3-markdown.") from None

KATEX = Path("/usr/share/javascript/katex")
PICTURES = {".png", ".gif", ".jpg", ".svg"}


@dataclass
class Page:
    section: str
    source: Path | None
    output: str
    title: str
    label: str  # in the navigation


def anchor(heading, separator="-"):
    """The anchor of a heading, the same as that of websites that show the Markdown of this repository."""
    return re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", separator)


class Site:
    def __init__(self, root, folder, neumann):
        self.root, self.folder, self.neumann = root, folder, neumann
        self.pages = []
        self.has_formulas = False

    def add(self, section, source, output, title=None, label=None):
        title = title or label
        if source is not None and (title is None or source.suffix == ".md" and title == label):
            title = re.search(r"^# (.+)$", source.read_text(encoding="utf-8"), re.MULTILINE)[1].replace("`", "")
        self.pages.append(Page(section, source, output, title, label or title))

    def relative(self, target, page):
        return os.path.relpath(target, os.path.dirname(page.output) or ".").replace(os.sep, "/")

    def link(self, address, page):
        """The address in the site of a source's link: that of the page made of the file it names, or of a copy of the file."""
        if re.match(r"[a-z]+:|#", address):
            return address
        path, _, place = address.partition("#")
        target = Path(os.path.normpath(page.source.parent / path))
        if not target.exists() or not target.is_relative_to(self.root):
            raise SystemExit(f"{page.source.relative_to(self.root)} links to {address}, which is not there")
        if target.is_dir():
            target /= "README.md"
        for other in self.pages:
            if other.source == target:
                return self.relative(other.output, page) + ("#" + place if place else "")
        return self.relative(self.copy(target), page)

    def copy(self, source):
        """Copies a file of the repository into the folder files, texts with the ending .txt, which every browser shows."""
        name = f"files/{source.relative_to(self.root)}"
        if source.suffix not in PICTURES:
            name += ".txt"
        to = self.folder / name
        if not to.exists():
            to.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(source, to)
        return name

    def with_links(self, text, page):
        return re.sub(
            r'(<(?:a|img)\b[^>]*? ?(?:href|src)=")([^"]+)"',
            lambda m: m[1] + html.escape(self.link(html.unescape(m[2]), page)) + '"',
            text,
        )

    def from_markdown(self, text, page, formulas=False):
        """Returns the body and its table of contents, both as HTML. With `formulas`, $…$ and $$…$$ are LaTeX."""
        kept = []

        def keep(match):
            kept.append(match)
            return f"@@{len(kept) - 1}@@"

        if formulas:
            text = re.sub(r"\$\$(.+?)\$\$|\$(.+?)\$", keep, text, flags=re.DOTALL)
        made = markdown.Markdown(
            extensions=["tables", "fenced_code", "toc", "sane_lists"],
            extension_configs={"toc": {"slugify": anchor, "toc_depth": "2-3"}},
        )
        body = made.convert(text)
        toc = made.toc if made.toc.count("<li>") > 2 else ""
        for number, match in enumerate(kept):
            kind = "tex display" if match[1] else "tex"
            body = body.replace(f"@@{number}@@", f'<span class="{kind}">{html.escape(match[1] or match[2])}</span>')
            self.has_formulas = True
        body = body.replace("<table>", '<div class="wide" tabindex="0"><table>').replace("</table>", "</table></div>")
        body = re.sub(r"<pre>", '<pre tabindex="0">', body)
        body = re.sub(r"<p>(<img [^>]*>)</p>", r'<p class="figure">\1</p>', body)
        return self.with_links(body, page), toc

    def write_markdown(self, page):
        body, toc = self.from_markdown(page.source.read_text(encoding="utf-8"), page)
        self.write(page, body, toc)

    def write_command(self, page):
        """Writes the page of a command as the program prints it, with its options; without the program, from the text alone."""
        if self.neumann:
            topic = [] if page.title == "neumann" else [page.title]
            text = subprocess.run([self.neumann, "help", *topic], check=True, capture_output=True, text=True).stdout
            text = re.sub(r"^  ", "", text, flags=re.MULTILINE)
        else:
            text = page.source.read_text(encoding="utf-8")
        heading = page.title if page.title == "neumann" else f"neumann {page.title}"
        self.write(page, f"<h1>{heading}</h1>\n" + command_text(text))

    def navigation(self, page):
        out = []
        for section in dict.fromkeys(p.section for p in self.pages):
            links = "\n".join(
                f'<li><a href="{self.relative(p.output, page)}"{" aria-current=" + chr(34) + "page" + chr(34) if p is page else ""}>'
                f"{html.escape(p.label)}</a></li>"
                for p in self.pages
                if p.section == section
            )
            if not section:
                out.append(f"<ul>{links}</ul>")
            else:
                is_open = " open" if section in (page.section, "Tutorials") else ""
                out.append(f"<details{is_open}><summary>{section}</summary><ul>{links}</ul></details>")
        return "\n".join(out)

    def write(self, page, body, toc=""):
        up = self.relative(".", page)
        formulas = ""
        if 'class="tex' in body and KATEX.is_dir():
            formulas = (
                f'<link rel="stylesheet" href="{up}/katex/katex.min.css">\n<script defer src="{up}/katex/katex.min.js"></script>\n'
                f'<script defer src="{up}/formulas.js"></script>\n'
            )
        title = "neumann" if page.title == "neumann" and not page.section else f"{page.title} – neumann"
        text = f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{html.escape(title)}</title>
<link rel="stylesheet" href="{up}/style.css">
{formulas}</head>
<body>
<header><a class="name" href="{up}/index.html">neumann</a> <a href="{up}/gallery.html">Gallery</a>
<a class="to_contents" href="#all_pages">All pages</a></header>
<div class="columns">
<main>
{'<details class="contents"><summary>On this page</summary>' + toc + '</details>' if toc else ''}
{body}
</main>
<nav id="all_pages" aria-label="All pages">
{self.navigation(page)}
</nav>
</div>
</body>
</html>
"""
        path = self.folder / page.output
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    def finish(self):
        here = Path(__file__).resolve().parent
        style = (self.root / "apps/output/pages/page.css").read_text() + (here / "site.css").read_text()
        (self.folder / "style.css").write_text(style)
        if self.has_formulas and KATEX.is_dir():
            to = self.folder / "katex"
            to.mkdir()
            for name in ("katex.min.css", "katex.min.js"):
                shutil.copyfile(KATEX / name, to / name)
            shutil.copytree(KATEX / "fonts", to / "fonts", ignore=lambda _, names: [n for n in names if not n.startswith("KaTeX")])
            shutil.copyfile(here / "formulas.js", self.folder / "formulas.js")


def command_text(text):
    """Converts a manual page to HTML: its headings are in capitals, and the texts of its items are indented."""
    out, paragraph, items = [], [], []

    def flush():
        if items:
            out.append("<dl>" + "".join(f"<dt><code>{html.escape(t)}</code></dt><dd>{html.escape(d)}</dd>" for t, d in items) + "</dl>")
            items.clear()
        if paragraph:
            words = html.escape(" ".join(paragraph))
            out.append(f"<p><code>{words}</code></p>" if out and out[-1] == '<h2 id="synopsis">Synopsis</h2>' else f"<p>{words}</p>")
            paragraph.clear()

    lines = text.splitlines()
    for number, line in enumerate(lines):
        following = lines[number + 1] if number + 1 < len(lines) else ""
        if not line.strip():
            if paragraph or not following.strip() or not following.startswith(" "):
                flush()
        elif re.fullmatch(r"[A-Z][A-Z ]+", line) and (number == 0 or not lines[number - 1].strip()):
            flush()
            out.append(f'<h2 id="{anchor(line)}">{line.capitalize()}</h2>')
        elif line.startswith(" "):
            term, description = items.pop()
            items.append((term, f"{description} {line.strip()}".strip()))
        elif following.startswith(" "):
            if paragraph:
                flush()
            items.append((line, ""))
        else:
            if items:
                flush()
            paragraph.append(line)
    flush()
    return "\n".join(out)
