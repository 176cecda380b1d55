#!/usr/bin/env python3
"""Writes the meshes house.ply, roof.ply, crown.ply and trunk.ply, and town.xml, which places them along five streets. In metres."""
import numpy as np

STREETS, HOUSES = 5, 20  # houses of a street: ten on each side
WIDTH, DEPTH, HEIGHT = 8.0, 9.0, 9.0  # of a house, below its roof
LEAVES = 1000
random = np.random.default_rng(59)


class Mesh:
    def __init__(self):
        self.vertices, self.triangles = [], []

    def quad(self, a, b, c, d):
        n = len(self.vertices)
        self.vertices += [a, b, c, d]
        self.triangles += [(n, n + 1, n + 2), (n, n + 2, n + 3)]

    def box(self, low, high):
        """All sides but the one below."""
        (x, y, z), (u, v, w) = low, high
        self.quad((x, y, w), (u, y, w), (u, v, w), (x, v, w))
        for (a, b), (c, d) in (((x, y), (u, y)), ((u, y), (u, v)), ((u, v), (x, v)), ((x, v), (x, y))):
            self.quad((a, b, z), (c, d, z), (c, d, w), (a, b, w))

    def write(self, path):
        faces = np.empty(len(self.triangles), dtype=[("count", "u1"), ("corners", "<i4", 3)])
        faces["count"], faces["corners"] = 3, self.triangles
        with open(path, "wb") as out:
            out.write(
                f"ply\nformat binary_little_endian 1.0\nelement vertex {len(self.vertices)}\nproperty float x\nproperty float y\n"
                f"property float z\nelement face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n".encode()
            )
            out.write(np.array(self.vertices, dtype="<f4").tobytes() + faces.tobytes())


def wall_with_windows(mesh, side):
    """Three floors of four windows, each 1.1 by 1.6 and 0.25 deep above a sill, at y = side · DEPTH / 2."""

    def at(x, z, inwards=0.0):
        return (side * -x, side * (DEPTH / 2 - inwards), z)

    for column in range(4):
        for floor in range(3):
            left, below = column * WIDTH / 4 - WIDTH / 2, floor * HEIGHT / 3
            xs, zs = (left, left + 0.45, left + 1.55, left + 2.0), (below, below + 0.8, below + 2.4, below + 3.0)
            for i in range(3):
                for j in range(3):
                    deep = 0.25 if i == j == 1 else 0.0
                    mesh.quad(at(xs[i], zs[j], deep), at(xs[i + 1], zs[j], deep), at(xs[i + 1], zs[j + 1], deep), at(xs[i], zs[j + 1], deep))
            corners = [(xs[1], zs[1]), (xs[2], zs[1]), (xs[2], zs[2]), (xs[1], zs[2])]
            for a, b in zip(corners, corners[1:] + corners[:1]):
                mesh.quad(at(*a), at(*b), at(*b, 0.25), at(*a, 0.25))
            sill = sorted([at(xs[1] - 0.1, zs[1] - 0.1, -0.12), at(xs[2] + 0.1, zs[1] - 0.1, 0.0)])
            low, high = np.minimum(*sill), np.maximum(*sill)
            mesh.box(low, (*high[:2], zs[1]))


def house():
    mesh = Mesh()
    wall_with_windows(mesh, 1)
    wall_with_windows(mesh, -1)
    for x in (-WIDTH / 2, WIDTH / 2):
        mesh.quad((x, -DEPTH / 2, 0), (x, DEPTH / 2, 0), (x, DEPTH / 2, HEIGHT), (x, -DEPTH / 2, HEIGHT))
        mesh.quad((x, -DEPTH / 2, HEIGHT), (x, DEPTH / 2, HEIGHT), (x, 0, HEIGHT + DEPTH / 2), (x, 0, HEIGHT + DEPTH / 2))
        mesh.triangles.pop()  # the gable is a triangle
    mesh.box((1.5, -1.9, HEIGHT + 1), (2.2, -1.2, HEIGHT + 5))
    return mesh


def roof():
    """Two slopes of 45° in twenty rows of tiles, each 5 cm above the next below."""
    mesh = Mesh()
    rows, over, lift = 20, 0.5, 0.05
    reach = DEPTH / 2 + over
    for side in (1, -1):
        for k in range(rows):
            y, next_y = (side * reach * (1 - i / rows) for i in (k, k + 1))
            z, next_z = (HEIGHT - over + reach * i / rows for i in (k, k + 1))
            for left in np.linspace(-WIDTH / 2, WIDTH / 2, 5)[:-1]:
                x = (side * -left, side * -(left + WIDTH / 4))
                mesh.quad((x[0], y, z + lift), (x[1], y, z + lift), (x[1], next_y, next_z), (x[0], next_y, next_z))
                mesh.quad((x[0], y, z), (x[1], y, z), (x[1], y, z + lift), (x[0], y, z + lift))
    return mesh


def crown():
    """Leaves of half a metre, evenly in an ellipsoid."""
    mesh = Mesh()
    towards = random.normal(size=(LEAVES, 3))
    towards /= np.linalg.norm(towards, axis=1, keepdims=True)
    centres = towards * random.random((LEAVES, 1)) ** (1 / 3) * (1.6, 1.6, 2.0) + (0, 0, 4.6)
    corners = centres[:, None] + random.normal(size=(LEAVES, 3, 3)) * 0.16
    mesh.vertices, mesh.triangles = corners.reshape(-1, 3), np.arange(3 * LEAVES).reshape(-1, 3)
    return mesh


def trunk():
    mesh = Mesh()
    mesh.box((-0.12, -0.12, 0), (0.12, 0.12, 4))
    return mesh


def instance(group, x, y, turn, scale):
    return (
        f'    <shape type="instance"><ref id="{group}"/><transform name="to_world"><scale value="{scale:.3g}"/>'
        f'<rotate z="1" angle="{turn:.0f}"/><translate x="{x:.2f}" y="{y:.2f}" z="0"/></transform></shape>\n'
    )


meshes = {"house": house(), "roof": roof(), "crown": crown(), "trunk": trunk()}
for name, mesh in meshes.items():
    mesh.write(f"{name}.ply")

placed = []
for street in range(STREETS):
    for number in range(HOUSES):
        side = 1 if number % 2 else -1
        x, y = 32 * (street - 2) + 11 * side, (WIDTH + 0.1) * (number // 2) - 36.5
        placed.append(instance(random.choice(["light_house", "dark_house"]), x, y, -90 * side, 1))
        placed.append(instance("tree", x - 6 * side, y + 4 * random.random(), 360 * random.random(), 0.8 + 0.4 * random.random()))
with open("town.xml", "w") as out:
    out.write(f'<?xml version="1.0" encoding="utf-8"?>\n<scene version="3.0.0">\n{"".join(placed)}</scene>\n')

of_house, of_tree = (sum(len(meshes[name].triangles) for name in names) for names in (("house", "roof"), ("crown", "trunk")))
print(f"{of_house} faces a house, {of_tree} a tree, {STREETS * HOUSES * (of_house + of_tree)} in all")
