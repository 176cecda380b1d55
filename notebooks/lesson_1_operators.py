# %% [markdown]
# # Lesson 1: light, one bounce at a time
#
# The light in a scene solves **L = Le + K L**. *Le* is what the lamps emit. *K = R T* makes all light bounce once: *T* carries it along
# straight lines to the next surface, *R* scatters it there. Put L into its own right-hand side, again and again, and a series appears:
#
# **L = Le + K Le + K² Le + K³ Le + …**
#
# `neumann render` makes a picture of each term. Term i, *bounce i*, is the light that was scattered exactly i times: bounce 0 is the lamp
# itself, bounce 1 direct light, bounce 2 the first indirect light. This lesson looks at the pictures and checks what the series promises.
# Every `assert` is such a promise; if one is broken, the lesson stops there.
#
# First render: `./run`. Then: `python3 notebooks/lesson_1_operators.py out/cornell-box`, or open this file in Jupyter with jupytext.

# %%
import csv
import os
import sys
from pathlib import Path

import numpy as np
import OpenImageIO as oiio

in_notebook = "ipykernel" in sys.modules
root = Path(__file__).resolve().parent.parent if "__file__" in globals() else Path.cwd().parent
argument = sys.argv[1] if len(sys.argv) > 1 and not in_notebook else os.environ.get("RENDER_DIR")
folder = Path(argument) if argument else root / "out" / "cornell-box"


def read(name):
    """A picture and its standard error, each as an array (row, column, colour); row 0 is at the top."""
    image = oiio.ImageBuf(str(folder / name))
    assert not image.has_error, image.geterror()
    pixels, channels = image.get_pixels(oiio.FLOAT).astype(float), list(image.spec().channelnames)
    return [pixels[..., [channels.index(p + c) for c in "RGB"]] for p in ("", "stderr.")]


def show(pictures, titles):
    """Draws the pictures, each as bright as it can be, in a notebook that has matplotlib; otherwise see contact-sheet.png."""
    try:
        import matplotlib.pyplot as plt
    except ImportError:
        return
    if in_notebook:
        for axis, p, title in zip(plt.subplots(1, len(pictures), figsize=(3 * len(pictures), 3))[1], pictures, titles):
            axis.imshow(np.clip(p / max(np.percentile(p, 99), 1e-30), 0, 1) ** (1 / 2.2))
            axis.set_title(title)
            axis.axis("off")


with open(folder / "series.csv") as file:
    rows = list(csv.DictReader(file))
N = len(rows) - 1
column = lambda name: np.array([float(row[name] or "nan") for row in rows])
bounces, bounce_errors = zip(*(read(f"bounce_{i:03}.exr") for i in range(N + 1)))
sums, sum_errors = zip(*(read(f"sum_{i:03}.exr") for i in range(N + 1)))
rest, rest_error = read("rest.exr")
assert N >= 3, "this lesson needs bounces 0 to 3 at least"
assert all(np.isfinite(p).all() for p in (*bounces, *bounce_errors, *sums, *sum_errors, rest, rest_error))
assert all((p >= 0).all() for p in (*bounces, *sums, rest)), "radiance cannot be negative"

# %% [markdown]
# ## The sums
# Adding the terms one by one gives the picture that a renderer shows after i bounces: **S_i = S_{i−1} + Kⁱ Le**, pixel by pixel. The files
# hold 32-bit floats, so the two sides may differ by the rounding of the three numbers, and by no more.

# %%
show(bounces[:4], [f"bounce {i}" for i in range(4)])
show(sums[:4], [f"bounces 0 to {i}" for i in range(4)])

half_ulp, tiny = 2.0**-24, 2.0**-149
assert np.array_equal(sums[0], bounces[0])
for i in range(1, N + 1):
    difference = np.abs(sums[i] - (sums[i - 1] + bounces[i]))
    assert (difference <= 1.01 * half_ulp * (sums[i] + sums[i - 1] + bounces[i]) + 2 * tiny).all(), f"sum {i} is not sum {i-1} + bounce {i}"

# %% [markdown]
# ## What do bounces 2 and 3 show?
# The question that Berkeley's course CS184 asks. Bounce 1 is black wherever the lamp cannot be seen from: in the shadows, and, in the Cornell
# box, on the whole ceiling, because the lamp lies in it. Bounce 2 reaches those places: it is light by way of one other surface, soft, and
# tinted by that surface where it is coloured. Bounce 3 has been by way of two others: dimmer, flatter, and tinted more. Count and see.

# %%
lit = [p.sum(2) > 0 for p in bounces]
print(f"lit by the lamp directly (bounces 0 and 1): {(lit[0] | lit[1]).mean():.1%} of the pixels")
print(f"lit by bounce 2 for the first time: {(lit[2] & ~lit[0] & ~lit[1]).mean():.1%}, by bounce 3: {(lit[3] & ~lit[0] & ~lit[1] & ~lit[2]).mean():.1%}")
for i in range(min(N, 5) + 1):
    red, green, blue = bounces[i].mean((0, 1)) / max(bounces[i].mean((0, 1)).sum(), 1e-300)
    print(f"bounce {i}: {red:.0%} red, {green:.0%} green, {blue:.0%} blue")

# %% [markdown]
# ## How fast the bounces fall
# The mean of each term and its ratio to the term before stand in `series.csv`. Every bounce multiplies the light by what the surfaces reflect
# and loses what leaves the scene, so after a few bounces the ratio hardly changes: whatever the lamp was like, K shrinks the light by the
# same factor each time. (That factor is K's largest eigenvalue. A coloured scene has one for each colour; in the mean the largest wins.)

# %%
mean, mean_error, ratio, bound = column("mean"), column("mean_stderr"), column("ratio"), column("bound")
for i in range(N + 1):
    print(f"bounce {i}: mean {mean[i]:.6f} ± {mean_error[i]:.6f}   ratio {ratio[i]:.3f}   bound on all that follows {bound[i]:.4g}")
assert np.allclose(mean, [p.mean() for p in bounces], rtol=1e-5, atol=0), "series.csv disagrees with the pictures"
assert np.allclose(ratio[1:], mean[1:] / mean[:-1], rtol=1e-5, atol=0), "the ratio is not that of the means"
for i in range(4, N):
    guess, error = ratio[i] * mean[i], 2 * ratio[i] * mean_error[i] + mean_error[i + 1]
    assert abs(mean[i + 1] - guess) <= 0.25 * guess + 4 * error, f"bounce {i + 1} is far from ratio × bounce {i}"

# %% [markdown]
# ## What is left out
# After bounce N the terms go on. Three answers to "how much is missing?":
# 1. **Measured**: `rest.exr`, the sum of all later terms, sampled by walks that end at random without changing the average.
# 2. **Guessed** from the observed ratio r: b r + b r² + … = b r/(1−r), where b is the mean of bounce N. Good if the ratio has settled.
# 3. **Bounded** before anything is rendered: no surface reflects more than a share a, so the tail is at most a^{N+1}/(1−a) times the brightest
#    lamp. Always true, and often far too large. Where a is 1 or more there is no bound, and the column is empty or infinite.

# %%
r = ratio[N]
guess = mean[N] * r / (1 - r) if r < 1 else float("inf")
norm = lambda p: np.sqrt((p**2).sum())
rest_mean, rest_mean_error = rest.mean(), norm(rest_error.mean(2)) / rest[..., 0].size  # pixels err independently, colours together
print(f"rest: measured {rest_mean:.3g} ± {rest_mean_error:.1g}, guessed {guess:.3g}, bounded by {bound[N]:.3g}")
print(f"bounces 0 to {N} hold {sums[N].mean() / (sums[N].mean() + rest_mean):.2%} of the light in the picture")
assert 0.5 * guess - 4 * rest_mean_error <= rest_mean <= 2 * guess + 4 * rest_mean_error, "rest and ratio tell different stories"
if np.isfinite(bound).all():
    a = bound[1:] / bound[:-1]
    assert (a < 1).all(), "the bound must fall, by the largest albedo, bounce by bounce"
    for i in range(N + 1):  # all that follows bounce i: the later bounces and the rest
        tail, tail_error = mean[i + 1 :].sum() + rest_mean, mean_error[i + 1 :].sum() + rest_mean_error
        assert tail <= bound[i] * (1 + 1e-5) + 4 * tail_error, f"more light after bounce {i} than the bound allows"

# %% [markdown]
# ## Error bars
# A pixel is an average over random walks, so it comes with a standard error: the truth is within two of them about 19 times in 20. One walk
# gives a sample of every bounce, so the bounces of a pixel err together, and the error of a sum lies between two extremes. If all err the
# same way, the errors add up; they can never do worse. If they were independent, the squares would add up.

# %%
together, independent = np.sum(bounce_errors, axis=0), np.sqrt(np.sum(np.square(bounce_errors), axis=0))
assert (sum_errors[N] <= together * (1 + 1e-5) + sums[N] * 1e-12).all(), "a sum errs more than all its terms together"
print(f"relative error of a pixel of the sum: {norm(sum_errors[N]) / max(norm(sums[N]), 1e-300):.2%}")
print(f"that error is {norm(sum_errors[N]) / max(norm(independent), 1e-300):.2f} of the independent case", end=" ")
print(f"and {norm(sum_errors[N]) / max(norm(together), 1e-300):.2f} of the worst case")
print("lesson 1: all promises kept")
