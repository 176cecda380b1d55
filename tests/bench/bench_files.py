#!/usr/bin/env python3
"""What the files of a render cost: the whole command beside the same command without files, in turn.

    tests/bench/bench_files.py [NEUMANN] [ROUNDS]      default build/release/apps/neumann and 9 rounds

Prints medians over the rounds. Ends with 1 if the files take over 10% more than was recorded, as a part of the method's processor time,
or if those of a walk with the default 17 bounces take more than a tenth of the 20 seconds that a render takes by default.
"""

import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from statistics import median

ROOT = Path(__file__).resolve().parents[2]
SCENE = ROOT / "scenes" / "mitsuba-cornell" / "mitsuba-cornell.xml"
MATRIX = ["-n", "8", "--method", "matrix", "--patches", "1000", "--directions", "64", "--spp", "8"]
WALK = ["-n", "16", "--spp", "16"]
ALONE = "tables"  # next to nothing
GROUPS = ["pictures,tables", "page,tables", "sheets,tables", "strips,tables"]
ALL = "pictures,tables,sheets,strips,page"
RECORDED, MARGIN = 2.36, 1.1
MOST_OF_A_WALK = 0.1 * 20


def run(neumann, options, files):
    """Seconds of the clock, of the processors, and of the method by its own account."""
    with tempfile.TemporaryDirectory() as folder:
        command = [neumann, "render", SCENE, *options, "--files", files, "-o", f"{folder}/a", "--quiet"]
        begin = time.monotonic()
        process = subprocess.Popen(command)
        _, status, used = os.wait4(process.pid, 0)
        wall = time.monotonic() - begin
        if status != 0:
            sys.exit(f"{command}: failed")
        timing = json.loads(Path(folder, "a", "run.json").read_text())["timing"]
        return wall, used.ru_utime + used.ru_stime, timing["sampling_seconds"] + timing.get("setup_seconds", 0.0)


def main():
    neumann = sys.argv[1] if len(sys.argv) > 1 else str(ROOT / "build" / "release" / "apps" / "neumann")
    rounds = int(sys.argv[2]) if len(sys.argv) > 2 else 9
    rows = [ALL, *GROUPS, ALONE]
    times = {row: [] for row in rows}
    for _ in range(rounds):
        for row in rows:
            times[row].append(run(neumann, MATRIX, row))

    def column(row, k):
        return median(t[k] for t in times[row])

    print(f"render mitsuba-cornell, 256², {' '.join(MATRIX)}\n")
    print(f"{'--files':<36}{'wall':>8}{'processor':>11}{'method':>9}{'files: wall':>13}{'processor':>11}")
    for row in rows:
        more = [column(row, k) - column(ALONE, k) for k in (0, 1)]
        print(f"{row:<36}{column(row, 0):8.2f}{column(row, 1):11.2f}{column(row, 2):9.2f}{more[0]:13.2f}{more[1]:11.2f}")
    ratio = median(all_files[1] / alone[1] - 1.0 for all_files, alone in zip(times[ALL], times[ALONE]))
    print(f"\nfiles / all else, processor: {ratio:.2f}, recorded {RECORDED:.2f}")

    walk = [(run(neumann, WALK, ALL)[0], run(neumann, WALK, ALONE)[0]) for _ in range(3)]
    files = median(all_files - alone for all_files, alone in walk)
    print(f"files of a walk, {' '.join(WALK)}: {files:.2f} s, at most {MOST_OF_A_WALK:.1f}")
    if ratio > MARGIN * RECORDED or files > MOST_OF_A_WALK:
        sys.exit("slower than recorded")


if __name__ == "__main__":
    main()
