#!/usr/bin/env python3
"""Writes lid.ply: the paraboloid z = x² + y² − 1 inside the unit circle, whose rim lies in z = 0."""
import numpy as np

RINGS, SIDES = 24, 72

angle = np.arange(SIDES) * 2 * np.pi / SIDES
r = np.repeat(np.arange(1, RINGS + 1) / RINGS, SIDES)
xy = r[:, None] * np.tile(np.stack([np.cos(angle), np.sin(angle)], axis=1), (RINGS, 1))
vertices = np.vstack([[0, 0, -1], np.column_stack([xy, r**2 - 1])])

here = np.arange(SIDES) + 1  # the innermost ring; vertex 0 is the centre
after = np.roll(here, -1)
triangles = [np.stack([0 * here, here, after], axis=1)]
for k in range(RINGS - 1):
    a, b = here + k * SIDES, after + k * SIDES
    triangles += [np.stack([a, a + SIDES, b + SIDES], axis=1), np.stack([a, b + SIDES, b], axis=1)]
triangles = np.vstack(triangles)

faces = np.empty(len(triangles), dtype=[("count", "u1"), ("corners", "<i4", 3)])
faces["count"], faces["corners"] = 3, triangles
with open("lid.ply", "wb") as out:
    out.write(
        f"ply\nformat binary_little_endian 1.0\nelement vertex {len(vertices)}\nproperty float x\nproperty float y\nproperty float z\n"
        f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n".encode()
    )
    out.write(vertices.astype("<f4").tobytes() + faces.tobytes())
