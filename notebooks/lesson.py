"""What all lessons share: where the scenes are, how figures look, sliders, and how far two numbers may be apart."""

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

# Read from the last row of a lecture hall: a figure is as wide as a slide, and its letters are a fortieth of that.
width = 10  # inches, of 100 pixels
plt.rcParams.update(
    {
        "figure.figsize": (width, 0.58 * width),
        "figure.dpi": 100,
        "figure.constrained_layout.use": True,
        "font.size": 17,
        "legend.fontsize": 15,
        "lines.linewidth": 2.5,
        "lines.markersize": 8,
        "axes.grid": True,
        "grid.alpha": 0.3,
        "image.cmap": "magma",
    }
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


sliders = None
if "inline" in plt.get_backend() and os.environ.get("NEUMANN_SLIDERS") != "0":
    try:
        import ipywidgets as sliders
    except ImportError:
        pass


def scene(name, **overrides):
    """One of the scenes in scenes/, with values for the names that its file defines."""
    return neumann.load(scenes / name / f"{name}.xml", **overrides)


def srgb(radiance, white):
    """Radiance as a screen shows it; what is brighter than white is cut off on the screen, and only there."""
    x = np.clip(np.asarray(radiance, dtype=float) / white, 0.0, 1.0)
    return np.where(x <= 0.0031308, 12.92 * x, 1.055 * x ** (1 / 2.4) - 0.055)


radiance_unit = "W·m$^{-2}$·sr$^{-1}$"


def plots(rows, columns, height=0.45, **options):
    """As plt.subplots, as wide as all figures; the height of a row is in widths of the figure."""
    return plt.subplots(rows, columns, figsize=(width, height * rows * width), **options)


def pictures(shown, titles, white=None, columns=None, unit=radiance_unit):
    """Pictures side by side: (height, width, 3), or (height, width) for grey. white: what is shown as white, in the unit that stands
    below; without it each picture has its own, which stands above it."""
    columns = columns or min(len(shown), 2 if len(shown) == 4 else 3)
    rows = -(-len(shown) // columns)
    above = 0.35 if white else 0.65  # inches, for a title
    figure, axes = plt.subplots(rows, columns, figsize=(width, rows * (width / columns + above) + 0.4), squeeze=False)
    for axis in axes.flat:
        axis.axis("off")
        axis.set_anchor("S")  # what room is left is above, for the title
    for axis, picture, title in zip(axes.flat, shown, titles):
        picture = np.asarray(picture, dtype=float)
        own = white or np.percentile(picture, 99) or np.max(picture) or 1.0
        axis.imshow(srgb(picture if picture.ndim == 3 else np.repeat(picture[..., None], 3, axis=2), own))
        axis.set_title(title if white else f"{title}\nwhite: {own:.2g}", fontsize="medium", pad=4)
    figure.supxlabel(f"white: {white:.2g} {unit}" if white else f"white in {unit}", fontsize="small")
    return figure


def explore(draw, **ranges):
    """Calls draw(name=value, …), which shows a figure, with a slider for every name=(least, most, first value), in whole numbers or of
    fifty steps. Without ipywidgets, or outside of a notebook, it is called once, with the first values."""
    if sliders is None:
        draw(**{name: first for name, (_, _, first) in ranges.items()})
        return
    made = {}
    for name, (least, most, first) in ranges.items():
        whole = all(isinstance(x, int) for x in (least, most, first))
        kind, step = (sliders.IntSlider, 1) if whole else (sliders.FloatSlider, (most - least) / 50)
        made[name] = kind(min=least, max=most, step=step, value=first, description=name, continuous_update=False)
    sliders.interact(draw, **made)


def limit(degrees_of_freedom=np.inf):
    """How many standard errors an estimate may be off: 4.5 if it is normal, and for Student's t as many as happen as rarely, once
    in 150 000 times. Who compares often, and is not to cry wolf, needs such a limit: of 95% intervals one in twenty misses."""
    return scipy.stats.t.isf(scipy.stats.norm.sf(4.5), degrees_of_freedom)
