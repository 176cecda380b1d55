#!/usr/bin/env python3
"""Writes waves.ply: five plane waves over a rectangle of 4 by 3 metres, whose slopes change by at most 0.9 per metre each."""
import numpy as np

COLUMNS, ROWS = 64, 48
LENGTHS = np.array([0.85, 0.7, 0.58, 0.48, 0.42])  # of the waves, in metres
TOWARDS = np.radians([20, 75, 140, 250, 310])
PHASES = np.array([0.0, 1.0, 2.5, 4.0, 5.5])
BEND = 0.9  # the largest second derivative of each wave, 1/m

x, y = np.meshgrid(np.linspace(-2, 2, COLUMNS + 1), np.linspace(-1.5, 1.5, ROWS + 1))
k = 2 * np.pi / LENGTHS
along = x[..., None] * np.cos(TOWARDS) + y[..., None] * np.sin(TOWARDS)
z = (BEND / k**2 * np.sin(k * along + PHASES)).sum(axis=-1)
vertices = np.stack([x, y, z], axis=-1).reshape(-1, 3)

a = (np.arange(ROWS)[:, None] * (COLUMNS + 1) + np.arange(COLUMNS)).ravel()
b, c, d = a + 1, a + COLUMNS + 2, a + COLUMNS + 1
faces = np.empty(2 * len(a), dtype=[("count", "u1"), ("corners", "<i4", 3)])
faces["count"], faces["corners"] = 3, np.vstack([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])
with open("waves.ply", "wb") as out:
    out.write(
        f"ply\nformat binary_little_endian 1.0\nelement vertex {len(vertices)}\nproperty float x\nproperty float y\nproperty float z\n"
        f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n".encode()
    )
    out.write(vertices.astype("<f4").tobytes() + faces.tobytes())
