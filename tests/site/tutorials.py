"""A tutorial is done as it says, in a new folder: tutorials.py REPOSITORY TUTORIAL.md

Blocks that are fenced as sh are run by bash, one after another, where ./run is the program and Python's module that were built. Of any
other block, a paragraph that ends with `NAME`: before it says which file it is. Afterwards every file of out/ and every such file that
the text names in `…` has to be there, and the outputs shown in blocks fenced as text have to be what the command before them prints, where
… stands for anything.
"""

import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

STAND_IN = """#!/bin/bash
if [[ ${1-} == python ]]; then shift; exec "$PYTHON" -B "$@"; fi
exec "$NEUMANN" "$@"
"""


def blocks(text):
    """[(language, content, the line of text before)] of fenced blocks."""
    found = []
    for match in re.finditer(r"^```(\w*)\n(.*?)^```$", text, re.MULTILINE | re.DOTALL):
        before = text[: match.start()].rstrip().rpartition("\n")[2]
        found.append((match[1], match[2], before))
    return found


def as_pattern(shown):
    """An output with … for anything, and as many blanks as one likes."""
    return r"\s+".join(".*?".join(map(re.escape, word.split("…"))) for word in shown.split())


def main():
    repository, tutorial = map(Path, sys.argv[1:3])
    text = tutorial.read_text(encoding="utf-8")
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        for name in ("scenes", "tests", "notebooks", "apps"):
            (folder / name).symlink_to(repository / name)
        (folder / "run").write_text(STAND_IN)
        (folder / "run").chmod(0o755)
        environment = os.environ | {"PYTHON": sys.executable, "XDG_CACHE_HOME": str(folder / "cache")}
        named, commands, printed = set(), 0, ""
        for language, content, before in blocks(text):
            name = re.search(r"`([\w./-]+)`:$", before)
            if language == "sh":
                commands += 1
                done = subprocess.run(["bash", "-euo", "pipefail", "-c", content], cwd=folder, env=environment, capture_output=True, text=True)
                assert done.returncode == 0, f"{content}\n{done.stdout}\n{done.stderr}"
                printed = done.stdout
                print(content, done.stdout, done.stderr, sep="\n")
            elif name:
                path = folder / name[1]
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(content, encoding="utf-8")
                named.add(name[1])
            elif language == "text":
                assert re.search(as_pattern(content), printed, re.DOTALL), f"shown:\n{content}\nprinted:\n{printed}"
            else:
                raise AssertionError(f"a block is neither sh nor text nor a file that is named: {content}")
        assert commands > 0, "no commands"
        named |= set(re.findall(r"`(out/[\w./-]+)`", re.sub(r"^```.*?^```$", "", text, flags=re.MULTILINE | re.DOTALL)))
        missing = sorted(name for name in named if not (folder / name).exists())
        assert not missing, f"not there: {missing}"
        assert any(name.startswith("out/") for name in named), "no file of out/ is named"


if __name__ == "__main__":
    main()
