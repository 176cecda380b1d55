#!/usr/bin/env python3
"""Cost follows the light, not the triangles: a smooth body of 10³ to 10⁶ triangles in a room, ten of them, and a cave.

    tests/bench/bench_mesh.py [NEUMANN] [--seconds 12] [--only room,cave,ten,box] [--sizes 1000,30000,1000000] [--seeds 1]

Makes its meshes itself. For each scene and method, in turn: seconds to load, and of set-up; memory beyond that of the walk; seconds a sample;
noise of bounces 1 to 4 in a pixel (standard error over mean) after --time; and the mean of its squares in that of the walk: the gain. Of several seeds, the means of the squares:
the error of shared points hangs on the seed by a factor of two. Ends
with 1 if the set-up of `corrected` at 10⁶ takes more than twice that at 10⁴ and half a second, if it takes more than 300 MB beyond the walk, or
if its gain on a mesh is less than 0.8 of that in the box.
"""

import argparse
import csv
import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
WIDTH = 128
METHODS = ["walk", "corrected", "auto"]

SENSOR = """<sensor type="perspective"><float name="fov" value="{fov}"/>
<transform name="to_world"><lookat origin="{origin}" target="{target}" up="0,1,0"/></transform>
<film type="hdrfilm"><integer name="width" value="{width}"/><integer name="height" value="{width}"/></film></sensor>"""
WALLS = """<shape type="cube"><transform name="to_world"><scale value="1,1,4"/></transform>
<bsdf type="twosided"><bsdf type="diffuse"><rgb name="reflectance" value="0.7"/></bsdf></bsdf></shape>"""
LAMP = """<shape type="rectangle"><transform name="to_world"><scale value="{size}"/><rotate x="1" angle="90"/><translate y="{height}"/></transform>
<bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf><emitter type="area"><rgb name="radiance" value="10"/></emitter></shape>"""
BOX = ROOT / "scenes" / "cornell-box" / "cornell-box.xml"
BODY = '<bsdf type="twosided"><bsdf type="diffuse"><rgb name="reflectance" value="0.6, 0.4, 0.3"/></bsdf></bsdf>'


def bumpy_sphere(triangles):
    """Vertices (n, 3), their normals, and triangles (n, 3): a sphere of radius 1/2 with five waves of 1 to 5%, from the faces of a cube."""
    cells = max(1, round((triangles / 12) ** 0.5))
    t = np.linspace(-1, 1, cells + 1)
    u, v = np.meshgrid(np.tan(t * np.pi / 4), np.tan(t * np.pi / 4), indexing="ij")
    corner = np.arange((cells + 1) ** 2).reshape(cells + 1, cells + 1)
    a, b, c, d = corner[:-1, :-1], corner[1:, :-1], corner[1:, 1:], corner[:-1, 1:]
    square = np.concatenate([np.stack([a, b, c], -1).reshape(-1, 3), np.stack([a, c, d], -1).reshape(-1, 3)])
    sides, faces = [], []
    for axis in range(3):
        for sign in (1, -1):
            p = np.empty((*u.shape, 3))
            p[..., axis] = sign
            p[..., (axis + 1) % 3], p[..., (axis + 2) % 3] = u, sign * v
            faces.append(square + len(sides) * u.size)
            sides.append(p.reshape(-1, 3))

    def put(directions):
        n = directions / np.linalg.norm(directions, axis=1, keepdims=True)
        waves = [(0.05, 3, 0), (0.03, 5, 1), (0.02, 7, 2), (0.02, 9, 0), (0.01, 11, 1)]
        r = 1 + sum(size * np.sin(k * n[:, i] + i) * np.cos(k * n[:, (i + 1) % 3]) for size, k, i in waves)
        return 0.5 * n * r[:, None]

    directions, triangles = np.concatenate(sides), np.concatenate(faces)
    points = put(directions)
    # Normals by differences along two directions of the sphere.
    n = directions / np.linalg.norm(directions, axis=1, keepdims=True)
    one = np.cross(n, np.where(np.abs(n[:, :1]) > 0.5, [[0.0, 1.0, 0.0]], [[1.0, 0.0, 0.0]]))
    other = np.cross(n, one)
    normals = np.cross(put(n + 1e-4 * one) - put(n - 1e-4 * one), put(n + 1e-4 * other) - put(n - 1e-4 * other))
    normals *= np.sign(np.sum(normals * n, axis=1, keepdims=True)) / np.linalg.norm(normals, axis=1, keepdims=True)
    return points, normals, triangles


def write_mesh(path, triangles):
    points, normals, faces = bumpy_sphere(triangles)
    names = "".join(f"property float {name}\n" for name in ("x", "y", "z", "nx", "ny", "nz"))
    rows = np.zeros(len(faces), dtype=[("n", "u1"), ("corners", "<i4", 3)])
    rows["n"], rows["corners"] = 3, faces
    with open(path, "wb") as file:
        file.write(
            f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\n{names}element face {len(faces)}\n"
            "property list uchar int vertex_indices\nend_header\n".encode()
        )
        file.write(np.hstack([points, normals]).astype("<f4").tobytes())
        file.write(rows.tobytes())


def scene(*parts):
    return '<scene version="3.0.0">' + "\n".join(parts) + "</scene>"


def room(folder, triangles):
    write_mesh(folder / f"{triangles}.ply", triangles)
    body = f'<shape type="ply"><string name="filename" value="{triangles}.ply"/>{BODY}</shape>'
    sensor = SENSOR.format(fov=40, origin="0, 0, 3.8", target="0, 0, 0", width=WIDTH)
    return scene(sensor, WALLS, LAMP.format(size=0.3, height=0.99), body)


def ten(folder, triangles):
    write_mesh(folder / f"{triangles}.ply", triangles)
    parts = [f'<shape type="shapegroup" id="body"><shape type="ply"><string name="filename" value="{triangles}.ply"/>{BODY}</shape></shape>']
    for i in range(10):
        place = f'<scale value="0.6"/><rotate y="1" angle="{37 * i}"/><translate x="{(i % 3 - 1) * 0.6}" y="{(i // 3 - 1) * 0.5 - 0.2}" z="{-0.4 * (i % 4)}"/>'
        parts.append(f'<shape type="instance"><ref id="body"/><transform name="to_world">{place}</transform></shape>')
    sensor = SENSOR.format(fov=40, origin="0, 0, 3.8", target="0, 0, 0", width=WIDTH)
    return scene(sensor, WALLS, LAMP.format(size=0.3, height=0.99), *parts)


def cave(folder, triangles):
    """Seen from within, with the lamp in it: all that reflects is mesh."""
    write_mesh(folder / f"{triangles}.ply", triangles)
    body = f'<shape type="ply"><string name="filename" value="{triangles}.ply"/><transform name="to_world"><scale value="3"/></transform>{BODY}</shape>'
    sensor = SENSOR.format(fov=70, origin="0, 0, 1.2", target="0, 0, 0", width=WIDTH)
    return scene(sensor, LAMP.format(size=0.3, height=0.9), body)


class Run:
    def __init__(self, neumann, path, folder, method, seconds, seed):
        options = ["-D", f"res={WIDTH}"] if path == BOX else []
        begin = time.monotonic()
        process = subprocess.Popen(
            [neumann, "render", path, *options, "--method", method, "--time", str(seconds), "--files", "tables", "--seed", str(seed), "-o", folder, "--quiet"]
        )
        _, status, used = os.wait4(process.pid, 0)
        self.wall = time.monotonic() - begin
        if status != 0:
            sys.exit(f"{path.stem}, {method}: failed")
        run = json.loads((folder / "run.json").read_text())
        timing = run["timing"]
        self.method = run["choice"]["method"] if "choice" in run else method
        self.setup = timing.get("setup_seconds", 0.0)
        self.samples = run["samples"]["per_pixel"]
        self.each = timing["sampling_seconds"] / self.samples
        self.memory = used.ru_maxrss / 1024
        with open(folder / "convergence.csv") as rows:
            last = list(csv.DictReader(rows))[-1]
        self.squares = [float(last[f"relative_stderr_{i:03}"]) ** 2 for i in range(1, 5)]


class Runs:
    """Means over seeds."""

    def __init__(self, seeds, *arguments):
        runs = [Run(*arguments, seed) for seed in range(1, seeds + 1)]

        def mean(what):
            return sum(what(run) for run in runs) / seeds

        self.method = " or ".join(sorted({run.method for run in runs}))
        self.wall, self.setup, self.each = (mean(lambda run, k=k: getattr(run, k)) for k in ("wall", "setup", "each"))
        self.memory = max(run.memory for run in runs)
        squares = [mean(lambda run, i=i: run.squares[i]) for i in range(4)]
        self.noise = [x**0.5 for x in squares]
        self.error = sum(squares) / len(squares)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("neumann", nargs="?", default=str(ROOT / "build" / "release" / "apps" / "neumann"))
    parser.add_argument("--seconds", type=float, default=12)
    parser.add_argument("--only", default="box,room,cave,ten")
    parser.add_argument("--sizes", default="1000,10000,30000,100000,1000000")
    parser.add_argument("--seeds", type=int, default=1)
    asked = parser.parse_args()
    sizes = [int(n) for n in asked.sizes.split(",")]
    print(f"{WIDTH}², --time {asked.seconds:g}; noise of bounces 1 to 4; gain: mean squared noise of the walk in that of the method\n")
    print(f"{'scene':<16}{'method':<24}{'load':>6}{'set-up':>8}{'MB':>6}{'s/sample':>10}{'noise 1':>9}{'2':>7}{'3':>7}{'4':>7}{'gain':>7}{'wall':>7}")
    gains, setups, memory = {}, {}, {}
    for name, make in {"box": None, "room": room, "cave": cave, "ten": ten}.items():
        if name not in asked.only.split(","):
            continue
        for n in [0] if name == "box" else sizes[-1:] if name == "ten" else sizes:
            with tempfile.TemporaryDirectory() as temporary:
                folder = Path(temporary)
                path = folder / f"{name}.xml" if make else BOX
                if make:
                    path.write_text(make(folder, n))
                load = ["--spp", "1", "-n", "0", "--files", "tables", "--method", "walk", "--quiet", "-o", folder / "load"]
                begin = time.monotonic()
                subprocess.run([asked.neumann, "render", path, *load], check=True)
                load = time.monotonic() - begin
                runs = {method: Runs(asked.seeds, asked.neumann, path, folder / method, method, asked.seconds) for method in METHODS}
            for method, run in runs.items():
                gains[name, n, method] = runs["walk"].error / run.error
                setups[name, n, method] = run.setup
                memory[name, n, method] = run.memory - runs["walk"].memory
                noise = "".join(f"{100 * x:{w}.1f}%" for x, w in zip(run.noise, (8, 6, 6, 6)))
                title = method if method == run.method else f"{method}: {run.method}"
                print(
                    f"{name if n == 0 else f'{name} {n}':<16}{title:<24}{load:6.2f}{run.setup:8.2f}{run.memory:6.0f}{run.each:10.4f}{noise}"
                    f"{gains[name, n, method]:7.1f}{run.wall:7.1f}",
                    flush=True,
                )
    wrong = []
    for (name, n, method), gain in gains.items():
        if method != "corrected" or n == 0:
            continue
        if gain < 0.8 * gains.get(("box", 0, method), 0.0):
            wrong.append(f"{name} {n}: the gain of {method} is {gain:.1f}, in the box {gains['box', 0, method]:.1f}")
        if memory[name, n, method] > 300:
            wrong.append(f"{name} {n}: {method} takes {memory[name, n, method]:.0f} MB beyond the walk")
    for name in ("room", "cave"):
        small, large = setups.get((name, 10000, "corrected")), setups.get((name, 1000000, "corrected"))
        if small and large and large > 2 * small + 0.5:
            wrong.append(f"{name}: set-up {large:.2f} s at 10⁶, {small:.2f} at 10⁴")
    if wrong:
        sys.exit("\n" + "\n".join(wrong))


if __name__ == "__main__":
    main()
