"""Every figure and question of the lectures has an answer: lectures.py REPOSITORY

Each row of the tables of apps/manual/lectures.md has a link, and what is called "lesson 4, Paths or trees" leads to the fourth lesson, which
has that heading. (That links lead to files is tested by commands, and that anchors are there by links.py.)
"""

import re
import sys
from pathlib import Path

HEADS = ("on the slide", "section", "in the article", "question", "missing")


def problems(page, text):
    found, rows = [], 0
    for line in text.splitlines():
        item, _, answer = line.removeprefix("| ").partition(" | ")
        if not line.startswith("| ") or item in HEADS or item == "---":
            continue
        rows += 1
        if "](" not in answer:
            found.append(f"no link: {item}")
    for number, section, address in re.findall(r"\[lesson (\d+)(?:, ([^\]]+))?\]\(([^)]+)\)", text):
        lesson = page.parent / address
        if not lesson.name.startswith(number + "_"):
            found.append(f"lesson {number} is not {lesson.name}")
        elif section and f"\n# ## {section}\n" not in lesson.read_text(encoding="utf-8"):
            found.append(f"{lesson.name} has no section {section}")
    return found, rows


def main():
    page = Path(sys.argv[1]) / "apps/manual/lectures.md"
    text = page.read_text(encoding="utf-8")
    found, rows = problems(page, text)
    assert not found, "\n" + "\n".join(found)
    assert rows > 150, f"{rows} rows"
    # What is broken is found.
    for row in ("figure 1 | none", "a | [lesson 2, Nothing](../../notebooks/2_series.py)", "a | [lesson 3](../../notebooks/2_series.py)"):
        assert len(problems(page, f"{text}| {row} |\n")[0]) == 1, row


if __name__ == "__main__":
    main()
