"""What all lessons share: where the scenes are, a row of pictures, and how far two numbers may be apart."""

import os
import sys
from pathlib import Path

try:
    import matplotlib.pyplot as plt
except ImportError:
    sys.exit(
        "The lessons draw with matplotlib, which this python3 does not have: "
        "install Debian's python3-matplotlib, and use /usr/bin/python3."
    )
try:
    import neumann
except ImportError:
    sys.exit(
        "This python3 cannot import neumann: run lessons as './run python notebooks/1_operators.py', or see notebooks/README.md."
    )
import numpy as np
import scipy.stats

scenes = Path(__file__).resolve().parent.parent / "scenes"
# The lessons hold for any seed; the tests try others.
seed = int(os.environ.get("NEUMANN_TEST_SEED", 0))

plt.rcParams.update(
    {"figure.dpi": 100, "axes.grid": True, "grid.alpha": 0.3, "figure.constrained_layout.use": True, "image.cmap": "magma"}
)
folder = os.environ.get("NEUMANN_FIGURES")
if not folder and plt.get_backend().lower() == "agg":
    folder = scenes.parent / "out" / "lessons"  # there is no screen
if folder:
    # Figures become files, NAME_1.png and so on.
    def save():
        Path(folder).mkdir(parents=True, exist_ok=True)
        for number in plt.get_fignums():
            save.count += 1
            file = Path(folder) / f"{Path(sys.argv[0]).stem}_{save.count}.png"
            plt.figure(number).savefig(file)
            print("figure:", file)
        plt.close("all")

    save.count = 0
    plt.show = save


def scene(name, **overrides):
    """One of the scenes in scenes/, with values for the names that its file defines."""
    return neumann.load(scenes / name / f"{name}.xml", **overrides)


def srgb(radiance, white):
    """Radiance as a screen shows it; what is brighter than white is cut off on the screen, and only there."""
    x = np.clip(np.asarray(radiance, dtype=float) / white, 0.0, 1.0)
    return np.where(x <= 0.0031308, 12.92 * x, 1.055 * x ** (1 / 2.4) - 0.055)


def pictures(shown, titles, white=None, columns=None, size=2.1):
    """Pictures side by side: (height, width, 3), or (height, width) for grey. white: the radiance that is shown as white; without it
    each picture has its own, which stands above it."""
    columns = columns or len(shown)
    rows = -(-len(shown) // columns)
    figure, axes = plt.subplots(rows, columns, figsize=(size * columns, (size + 0.45) * rows), squeeze=False)
    for axis in axes.flat:
        axis.axis("off")
    for axis, picture, title in zip(axes.flat, shown, titles):
        picture = np.asarray(picture, dtype=float)
        own = white or max(np.percentile(picture, 99), np.max(picture) * 1e-3, 1e-300)
        axis.imshow(srgb(picture if picture.ndim == 3 else np.repeat(picture[..., None], 3, axis=2), own), interpolation="nearest")
        axis.set_title(title if white else f"{title}\nwhite: {own:.2g}", fontsize=9, pad=4)
    return figure


def limit(degrees_of_freedom=np.inf):
    """How many standard errors an estimate may be off: 4.5 if it is normal, and for Student's t as many as happen as rarely, once
    in 150 000 times. Who compares often, and is not to cry wolf, needs such a limit: of 95% intervals one in twenty misses."""
    return scipy.stats.t.isf(scipy.stats.norm.sf(4.5), degrees_of_freedom)
