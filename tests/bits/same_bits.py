"""Every scene of scenes/ by every method (those of lectures by the walk), small, with a fixed seed: the pixels have the bits that
hashes.json says.

    NEUMANN=… SCENES=… same_bits.py            compares; exit code 0 if all are equal, 77 where the libraries are others
    NEUMANN=… SCENES=… same_bits.py --write    writes hashes.json anew: where numbers are meant to change, and the commit says why

The hashes are those of Debian 12: another Embree, another compiler or another mathematics library may round differently.
"""

import concurrent.futures
import hashlib
import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import OpenImageIO as oiio

NEUMANN, SCENES = os.environ["NEUMANN"], Path(os.environ["SCENES"])
HASHES = Path(__file__).with_name("hashes.json")
NOT_THE_SAME_LIBRARIES = 77

PATHS = ["--spp", "8"]
FIELDS = ["--patches", "100", "--directions", "64", "--spp", "8"]
METHODS = {
    "walk": PATHS,
    "guided": [*PATHS, "--patches", "100", "--directions", "256"],
    "corrected": [*PATHS, "--patches", "100", "--directions", "16"],
    **{name: PATHS for name in ("surface", "light", "shooting", "bidirectional", "mixed", "photon", "cache", "metropolis", "classic", "pointwise")},
    **{name: FIELDS for name in ("patches", "matrix", "gather")},
}
# Of some scenes alone: its pilot takes longer than all others together.
SCENES_OF = {"mixed": ("cornell-box", "glossy-floor")}
# By the walk alone: the others would take as long again as all other scenes together, and find the same code.
LECTURE_SCENES = ("courtyard", "fixtures", "four-floors", "lid", "pool", "six-materials", "street")
# Of the Cornell box alone.
OPTIONS = {
    "walk": ["--direct mis-solid-angle --lights all", "--direct bsdf --roulette albedo", "--direct light --lights power --split 3,2",
             "--direct surfaces --roulette 0.7", "--sampler independent --plan full", "--direct mis-balance --lights contribution --tail 0.2", "--reuse --roulette 0.8", "--tree sum", "--indirect uniform", "--lights seen", "--tree place"],
    "light": ["--roulette throughput"],
    "bidirectional": ["--direct mis-balance --ways 2", "--roulette albedo"],
    "photon": ["--gather --photons 3000", "--radius 20"],
    "cache": ["--records split-sphere --directions 30", "--accuracy 0.5"],
    "patches": ["--importance"],
}
SIZE = "16"


def versions():
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([NEUMANN, "render", SCENES / "furnace" / "furnace.xml", "-D", "res=1", "--spp", "1", "-n", "0", "-o", "a", "--quiet"],
                       cwd=folder, check=True)
        embree = json.loads((Path(folder) / "a" / "run.json").read_text())["program"]["ray_caster"]
    libc = re.search(r"[\d.]+$", subprocess.run(["ldd", "--version"], capture_output=True, text=True, check=True).stdout.splitlines()[0])
    compiler = subprocess.run(["g++", "-dumpfullversion"], capture_output=True, text=True, check=True).stdout.strip()
    return {"ray caster": embree, "C library": libc[0], "g++": compiler, "OpenImageIO": oiio.VERSION_STRING}


def hash_of(folder):
    hashed = hashlib.sha256()
    for path in sorted(folder.glob("*.exr")):
        picture = oiio.ImageInput.open(str(path))
        spec = picture.spec()
        pixels = picture.read_image(oiio.FLOAT).reshape(-1, spec.nchannels)
        hashed.update(path.name.encode())
        for name, channel in sorted(zip(spec.channelnames, pixels.T)):
            hashed.update(name.encode())
            hashed.update(channel.tobytes())
    return hashed.hexdigest()[:16]


def render(scene, method, options):
    """A hash of all its files, or what the program says where the method does not take the scene."""
    with tempfile.TemporaryDirectory() as folder:
        bounces = [] if "--tail" in options else ["-n", "3"]
        done = subprocess.run([NEUMANN, "render", SCENES / scene / f"{scene}.xml", "-D", f"res={SIZE}", "--method", method, *METHODS[method],
                               *options.split(), *bounces, "--seed", "7", "-t", "1", "--files", "pictures", "-o", "a", "--quiet"],
                              cwd=folder, capture_output=True, text=True)
        if done.returncode == 2:
            return done.stderr.strip()
        if done.returncode != 0:
            raise RuntimeError(f"{scene}, {method} {options}: exit code {done.returncode}: {done.stderr}")
        return hash_of(Path(folder, "a"))


def main():
    scenes = sorted(path.parent.name for path in SCENES.glob("*/*.xml"))
    found_versions = versions()
    known = json.loads(HASHES.read_text()) if HASHES.exists() else {}
    if "--write" not in sys.argv and known["libraries"] != found_versions:
        print(f"the hashes are those of {known['libraries']}, and these are {found_versions}")
        return NOT_THE_SAME_LIBRARIES
    runs = [(scene, method, "") for scene in scenes for method in METHODS
            if scene in SCENES_OF.get(method, scenes) and (method == "walk" or scene not in LECTURE_SCENES)]
    runs += [("cornell-box", method, options) for method, all_options in OPTIONS.items() for options in all_options]
    # Processes: threads that read pictures through Python may wait for each other for ever.
    with concurrent.futures.ProcessPoolExecutor(os.cpu_count()) as pool:
        found = dict(zip((" ".join(run).strip() for run in runs), pool.map(render, *zip(*runs))))
    if "--write" in sys.argv:
        HASHES.write_text(json.dumps({"libraries": found_versions, "pictures": found}, indent=1) + "\n")
        return 0
    wrong = [name for name in known["pictures"].keys() | found.keys() if known["pictures"].get(name) != found.get(name)]
    print("\n".join(f"not the bits of hashes.json: {name}" for name in sorted(wrong)))
    print(f"{len(found) - len(wrong)} of {len(found)} the same")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
