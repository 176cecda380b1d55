"""What files include tells who knows whom: rooms in reading order, no arrow up, no circle of folders, and counts that may only fall.

    layers.py ROOT [--show]

A room knows its own and those before it in the lists below. --show prints who knows whom.
"""

import re
import sys
from pathlib import Path

# Of each folder its rooms, in the order in which to read them.
ROOMS = {
    ".": "core operators apps",
    "core": "base image sampling geometry material emitter sensor scene reader",
    "core/reader": "meshes xml plugins formats",
    "operators": "algebra pointwise solvers statistics fields paths render experiments",
    "operators/fields": "patches matrix shared",
    "operators/render": "plan from_paths from_fields report methods",
    "apps": "manual requests output live processes commands command_line python",
    "apps/output": "sheets figures files pages study",
}

# What no file of the first pattern reaches, by whatever it includes; the third is reached, or nothing was looked at.
UNKNOWN = [
    # T needs no materials, and R no rays.
    (r"operators/pointwise/transport\.h", r"core/material/", "core/geometry/geometry.h"),
    (r"operators/fields/matrix/transport_matrix\.", r"core/material/|reflection", "operators/fields/matrix/ray_table.h"),
    (r"operators/pointwise/reflection\.h", r"core/geometry/geometry|ray_caster|transport", "core/material/materials.h"),
    (r"operators/fields/matrix/reflection_matrix\.", r"ray_table|facet_rays|transport_matrix", "core/material/materials.h"),
]

# Who raises one says why in the commit. The methods: files that name one from outside of its folder.
LIMITS = {
    "rooms of operators": 8,
    "floors of operators": 6,
    "metropolis": 8,
    "bidirectional": 36,
    "photon": 19,
    "lines of core, operators and apps": 104050,
    "lines of tests": 47322,
}


def folder(file):
    return file.rpartition("/")[0]


def room(file, house):
    """The room of a house in which the file is; None if it is elsewhere, or in none of them."""
    inside = file if house == "." else file[len(house) + 1 :] if file.startswith(house + "/") else ""
    return inside.partition("/")[0] if "/" in inside else None


def graph(includes, name):
    """Who knows whom: {a: {b: [(file of a, file of b), …]}}."""
    arrows = {}
    for file, included in includes.items():
        for other in included:
            a, b = name(file), name(other)
            if a and b and a != b:
                arrows.setdefault(a, {}).setdefault(b, []).append((file, other))
    return arrows


def reached(includes, file):
    seen, waiting = set(), [file]
    while waiting:
        file = waiting.pop()
        if file not in seen:
            seen.add(file)
            waiting += includes.get(file, [])
    return seen


def circle(arrows):
    """Some folders that know each other in a circle; empty if there are none."""
    done, way = set(), []

    def go(a):
        if a in way:
            return way[way.index(a) :]
        if a in done:
            return []
        way.append(a)
        for b in arrows.get(a, {}):
            if found := go(b):
                return found
        way.pop()
        done.add(a)
        return []

    for a in arrows:
        if found := go(a):
            return found
    return []


def floors(arrows, rooms):
    heights = {}

    def height(a):
        if a not in heights:
            heights[a] = 1 + max((height(b) for b in arrows.get(a, {})), default=0)
        return heights[a]

    return max(map(height, rooms))


def faults(root, show):
    paths = [p for top in ("core", "operators", "apps", "tests") for p in sorted((root / top).rglob("*")) if p.suffix in (".h", ".cpp")]
    texts = {str(p.relative_to(root)): p.read_text(encoding="utf-8", errors="replace") for p in paths}
    ours = [file for file in texts if not file.startswith("tests/")]
    includes = {file: [i for i in re.findall(r'^#include "([^"]+)"', texts[file], re.M) if i in texts] for file in ours}

    for house, names in ROOMS.items():
        order = names.split()
        here = {room(file, house) for file in ours} - {None}
        if missing := here - set(order) - ({"tests"} if house == "." else set()):
            yield f"{house}: {', '.join(sorted(missing))} has no place in the order of tests/types/layers.py"
        for a, known in graph(includes, lambda file: room(file, house)).items():
            if show:
                print(f"{house}: {a} knows {', '.join(sorted(known))}")
            for b, files in known.items():
                if a in order and b in order and order.index(a) < order.index(b):
                    yield f"{house}: {a} is read before {b}, but " + "; ".join(f"{x} knows {y}" for x, y in files[:3])

    if found := circle(graph(includes, folder)):
        yield f"folders know each other in a circle: {' → '.join([*found, found[0]])}"
    modules = {p.stem: p.read_text(encoding="utf-8") for p in (root / "apps/python/neumann").glob("_*.py")}
    known = {m: re.findall(r"\b_\w+", " ".join(re.findall(r"^\s*from (\.\w+(?= import)|\. import .*)", text, re.M))) for m, text in modules.items()}
    if found := circle({m: {i: [] for i in names if i in modules} for m, names in known.items() if m != "__init__"}):
        yield f"modules of Python know each other in a circle: {' → '.join([*found, found[0]])}"

    for pattern, unknown, known in UNKNOWN:
        everything = set()
        for file in ours:
            if re.match(pattern, file):
                files = reached(includes, file)
                everything |= files
                if wrong := sorted(f for f in files if re.search(unknown, f) and f != file):
                    yield f"{file} knows {', '.join(wrong)}"
        if known not in everything:
            yield f"nothing in {pattern} knows {known}"

    operators = graph(includes, lambda file: room(file, "operators"))
    rooms = {room(file, "operators") for file in ours} - {None}
    counts = {"rooms of operators": len(rooms), "floors of operators": 0 if circle(operators) else floors(operators, rooms)}
    for method in ("metropolis", "bidirectional", "photon"):
        counts[method] = sum(f"/{method}" not in f and re.search(rf"\b{method}", texts[f], re.I) is not None for f in ours)
    counts["lines of core, operators and apps"] = sum(texts[f].count("\n") for f in ours)
    counts["lines of tests"] = sum(text.count("\n") for f, text in texts.items() if f.startswith("tests/"))
    for what, limit in LIMITS.items():
        if show:
            print(f"{what}: {counts[what]}, at most {limit}")
        if counts[what] > limit:
            yield f"{what}: {counts[what]}, where there were at most {limit}"


if __name__ == "__main__":
    found = list(faults(Path(sys.argv[1]), "--show" in sys.argv))
    print("\n".join(found))
    sys.exit(1 if found else 0)
