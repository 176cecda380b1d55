"""Every link, anchor and picture of the site leads somewhere, and nothing comes from a network: links.py REPOSITORY [SITE]

Without SITE one is made, without renders. Explorers are pages of `neumann render` and tested elsewhere: here they only have to be there.
"""

import re
import subprocess
import sys
import tempfile
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote


class Links(HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.links, self.parts, self.names, self.paragraphs = [], [], [], []
        self.inside = False
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        if "id" in values:
            self.names.append(values["id"])
        if tag == "a" and "href" in values:
            self.links.append(values["href"])
        elif tag in ("img", "script", "iframe") and "src" in values:
            self.parts.append(values["src"])
        elif tag == "link":
            self.parts.append(values["href"])
        if tag == "img" and not values.get("alt"):
            self.parts.append("a picture without a text")
        if tag == "p":
            self.inside = True
            self.paragraphs.append("")

    def handle_endtag(self, tag):
        if tag == "p":
            self.inside = False

    def handle_data(self, text):
        if self.inside:
            self.paragraphs[-1] += text


def problems(site):
    pages = {path: Links(path.read_text(encoding="utf-8")) for path in site.rglob("*.html") if path.name != "explorer.html" or path.parent.name == "manual"}
    found, followed = [], 0
    for path, page in pages.items():
        where = path.relative_to(site)
        for name in {n for n in page.names if page.names.count(n) > 1}:
            found.append(f"{where}: two places are called {name}")
        for link in page.links + page.parts:
            if re.match(r"data:image/", link) or (link in page.links and re.match(r"https://", link)):
                continue
            followed += 1
            if re.match(r"[a-z]+:|/", link):
                found.append(f"{where}: {link} is not in the site")
                continue
            file, _, name = link.partition("#")
            target = (path.parent / unquote(file)).resolve() if file else path
            if not target.is_file() or not target.is_relative_to(site.resolve()):
                found.append(f"{where}: {link} is not there")
            elif name and name not in pages[target].names:
                found.append(f"{where}: {link}: no place there is called {name}")
        # What Python-Markdown takes for a part of a paragraph, and GitHub for a list, a table or a heading.
        for paragraph in page.paragraphs:
            if re.search(r"^(- |\d+\. |\| |#+ |```)", paragraph, re.MULTILINE):
                found.append(f"{where}: a list, a table or a heading is in a paragraph: {paragraph[:60]}")
    return found, len(pages), followed


def main():
    repository = Path(sys.argv[1])
    version = re.search(r"project\(neumann VERSION (\S+)", (repository / "CMakeLists.txt").read_text())[1]
    assert f"\nversion: {version}\n" in (repository / "CITATION.cff").read_text(), "CITATION.cff has another version"
    with tempfile.TemporaryDirectory() as folder:
        given = len(sys.argv) > 2
        site = Path(sys.argv[2]) if given else Path(folder).resolve() / "site"
        if not given:
            command = [sys.executable, "-B", repository / "apps/manual/site/make_site.py", "--no-renders", "--no-lessons", "-o", site]
            subprocess.run(command, check=True)
        found, pages, followed = problems(site)
        assert not found, "\n" + "\n".join(found)
        assert pages > 50 and followed > 50 * pages, f"{pages} pages, {followed} links"
        if given:
            return
        # What is broken is found.
        (site / "manual/methods.html").unlink()
        text = (site / "index.html").read_text(encoding="utf-8")
        (site / "index.html").write_text(text + '<a href="#nowhere">a</a><img src="https://example.org/a.png" alt="a">', encoding="utf-8")
        found, _, _ = problems(site)
        for expected in ("methods.html is not there", "index.html: #nowhere", "a.png is not in the site"):
            assert any(expected in problem for problem in found), expected


if __name__ == "__main__":
    main()
