# %% [markdown]
# # 5. Error against run time
#
# **What this teaches.** "Method A is better than B" is a statement about error *and* time. You will learn to read a study: how
# errors fall (slopes), what a method is worth (efficiency), how to compare at equal time and at equal error, how bias shows, and
# how far such figures may be trusted. First where the truth is known, so that you can check the instrument; then in a scene where
# methods really differ.

# %%
from lesson import limit, plots, radiance_unit, scene, seed
import os
import tempfile

import matplotlib.pyplot as plt
import numpy as np
import neumann

# %% [markdown]
# ## The words
# A method that runs for $T$ seconds makes a picture $x$; the truth is $r$. Repeat it with other seeds, and the error splits into
# two parts:
#
# $$\mathrm{MSE} = E\,(x - r)^2 = \underbrace{E\,(x - E x)^2}_{V,\text{ variance}} + \underbrace{(E x - r)^2}_{\text{bias}^2},
# \qquad \mathrm{RMSE} = \sqrt{\mathrm{MSE}},$$
#
# all of them means over pixels and channels. Variance falls with samples, bias does not. For independent samples
# $V \propto 1/N \propto 1/T$, so that $\mathrm{RMSE} \propto T^{-1/2}$: a **slope** of $-\frac12$ on logarithmic axes. And
# $V \cdot T$ is a constant of the method; $1/(V T)$ is its **efficiency**: twice the efficiency is half the time to the same
# error.
#
# ## A study whose answer is known
# In a furnace of albedo $\rho$, look for light in uniform directions (`direct=hemisphere`). A sample of bounce $i$ is
# $\rho^i \cdot 2\cos\theta$, with $\cos\theta$ uniform in $[0, 1]$.
#
# **Q1.** What is its variance? (A1: $\rho^{2i} (E[4\cos^2\theta] - 1) = \rho^{2i} (\frac43 - 1) = \rho^{2i} / 3$.)
#
# So the RMSE with $N$ independent samples must be $\rho^i / \sqrt{3N}$. `study` runs each method with each number of samples, 16
# times with other seeds. The truth is given as numbers.

# %%
rho, samples, repeats = 0.5, [4, 16, 64, 256], 16
independent, sobol = "walk:direct=hemisphere:sampler=independent", "walk:direct=hemisphere:sampler=sobol"
known = scene("furnace", albedo=rho, res=8).study(
    [independent, sobol],
    samples=samples,
    repeats=repeats,
    bounces=3,
    reference="values:" + ",".join(str(rho**i) for i in range(4)),
    seed=seed,
    quiet=True,
)
figure, axes = plt.subplots()
for method, label in ((independent, "independent samples"), (sobol, "Sobol' points")):
    for i, marker in ((1, "o"), (3, "s")):
        curve = known.curve(method, i)
        axes.loglog(
            curve["samples"], curve["rmse"], marker, label=f"{label}, bounce {i}", color="C0" if method == independent else "C1"
        )
for i in (1, 3):
    axes.loglog(
        samples, rho**i / np.sqrt(3 * np.array(samples)), color="grey", label=r"$\rho^i / \sqrt{3N}$" if i == 1 else None
    )
axes.set(xlabel="samples a pixel $N$", ylabel=f"RMSE, {radiance_unit}", title="A furnace, by uniform directions")
axes.legend()
plt.show()

# %% [markdown]
# The figure: RMSE against samples, and what it must be for independent ones. Sobol' points, which avoid clumps, fall faster here,
# because the integrand is smooth.
#
# An RMSE is an estimate, too. Here a mean of squares over $n = 8 \cdot 8 \cdot 16$ pixels and repeats (the three channels are the
# same sample: all is grey) is off by about $\sqrt{2/n}$ of itself.

# %%
n = 8 * 8 * repeats
for i in (1, 2, 3):
    curve = known.curve(independent, i)
    expected = rho ** (2 * i) / (3 * curve["samples"])
    off = (curve["rmse"] ** 2 / expected - 1) / np.sqrt(2 / n)
    print(
        f"bounce {i}: MSE over what it must be", (curve["rmse"] ** 2 / expected).round(3), "off by", off.round(1), "standard errors"
    )
    assert (np.abs(off) <= limit()).all()  # twelve comparisons, not quite normal: a false alarm in some 10 000 seeds
fit = np.polyfit(np.log(samples), np.log(known.curve(independent, 1)["rmse"]), 1)[0]
steeper = np.polyfit(np.log(samples), np.log(known.curve(sobol, 1)["rmse"]), 1)[0]
# Each log RMSE is off by √(1/2n): the slope by that over √Σ (ln N − mean)².
spread = np.log(samples) - np.mean(np.log(samples))
slope_error = np.sqrt(0.5 / n) / np.sqrt(np.sum(spread**2))
print(f"slope of bounce 1: {fit:.3f} ± {2 * slope_error:.3f} for independent samples, {steeper:.2f} for Sobol' points")
assert abs(fit + 0.5) <= limit() * slope_error and steeper < fit

# %% [markdown]
# **Q2.** The three bounces have the same slope. Which has the largest *relative* error? (A2: none: $\rho^i/\sqrt{3N}$ over
# $\rho^i$ is the same. Most scenes are not like that.)
#
# ## A study where methods differ
# `door-ajar`: the lamp is in the next room. Walks from the camera have to find the gap, `bidirectional` walks start at the lamp
# as well, and `matrix` solves for the light on patches first.
#
# A study needs a truth. Here it is a long render by another method with other seeds. Its own noise is subtracted, but a reference
# that is noisier than what is judged by it is useless: make it with many more samples.

# %%
door = scene("door-ajar", res=12)
folder = tempfile.TemporaryDirectory()
truth = door.render(bounces=3, spp=2048, method="bidirectional", sampler="independent", seed=seed + 77, quiet=True)
truth.save(os.path.join(folder.name, "truth"))
methods = ["walk:sampler=independent", "bidirectional:sampler=independent", "matrix:patches=75:directions=128"]
study = door.study(
    methods, samples=[8, 32, 128], repeats=8, bounces=3, reference=os.path.join(folder.name, "truth"), seed=seed, quiet=True
)
study

# %%
figure, axes = plots(1, 3, height=0.6, sharey=True)
for axis, i in zip(axes, (1, 2, 3)):
    for k, method in enumerate(methods):
        curve = study.curve(method, i)
        axis.errorbar(
            curve["seconds"],
            curve["rmse"],
            yerr=2 * curve["rmse_stderr"],
            fmt="o-",
            capsize=2,
            label=method.split(":")[0],
            color=f"C{k}",
        )
    t = np.array([3e-3, 0.2])
    axis.loglog(
        t,
        study.curve(methods[0], i)["rmse"][0] * np.sqrt(study.curve(methods[0], i)["seconds"][0] / t),
        ":",
        color="grey",
        label=r"slope $-\frac{1}{2}$",
    )
    axis.set(title=f"bounce {i}", xlabel="seconds", xscale="log", yscale="log")
errors = [study.curve(method, i)["rmse"] for method in methods for i in (1, 2, 3)]
axes[0].set(ylabel=f"RMSE, {radiance_unit}", ylim=(0.06 * np.nanmin(errors), 2 * np.nanmax(errors)))
axes[0].legend(loc="lower left")
plt.show()

# %% [markdown]
# The figure: error against seconds in three bounces, with 95% bars. **Equal time** is a vertical line, and **equal error** a
# horizontal one. Paths fall along the dotted slope. Patches first need their time for $K$ (the vertical line), then fall for a
# while, and then stay where they are, in bounces 2 and 3: what is left is their discretisation, a bias, and no number of samples
# changes it. In bounce 1, for which the lamp itself is sampled, there is so little of it that the error falls on.
#
# **Q3.** Read off: how long does `walk` need for the error that `matrix` has at the end, in bounce 2? Is `matrix` then "better"?
# (In the table bias² is MSE − variance, both as measured with 8 repeats: where there is no bias it is as often below 0 as above.)

# %%
print("at the largest budget        bounce   RMSE     bias²/MSE   1/(V T)   1/(MSE T)")
for i in (1, 2, 3):
    for method in methods:
        last = study.curve(method, i)[-1]
        print(
            f"{method.split(':')[0]:28s} {i:4d}   {last['rmse']:.5f}   {last['bias_squared'] / last['rmse'] ** 2:8.1%}   "
            f"{last['efficiency']:.2e}   {last['efficiency_with_bias']:.2e}"
        )

slopes = [
    f"{method.split(':')[0]}, bounce {i}: {s.value:.2f} ± {s.interval95:.2f}"
    for method in methods[:2]
    for i in (1, 2, 3)
    if (s := study.slope(method, i)) and s.interval95
]
print("slopes against seconds, 95%:", *slopes, sep="\n   ")
share = {
    m: np.mean([study.curve(m, i)[-1]["bias_squared"] / study.curve(m, i)[-1]["rmse"] ** 2 for i in (2, 3)]) for m in methods
}
assert share[methods[2]] > 0.3 > max(share[methods[0]], share[methods[1]]), "patches are biased, paths are not"

# %% [markdown]
# ## Yours beside ours
# A study takes an estimator of your own: a function of camera rays, the last bounce $N$ and random numbers, that returns a sample of
# every $K^i L_e$ along every ray. It works on all rays at once, and asks the scene for what it needs: `seen` is
# what the camera sees, `intersect` is $\mathrm{tr}(x, \omega)$, `visible` is $V(x, y)$, and `sample_lights` is a point $y$ on a lamp with $L_e/\mathrm{pdf}$. This is a path
# tracer of diffuse scenes, whole:

# %%
box = scene("cornell-box", res=16)


def mine(rays, N, rng):
    """Walks from the camera that ask for light at every stop."""
    samples = np.zeros((len(rays.origin), N + 1, 3))
    x = box.seen(rays)
    samples[:, 0] = x.emission
    walk, beta = np.arange(len(x)), np.ones((len(x), 3))
    for i in range(1, N + 1):
        walk, beta, x = walk[x.hit], beta[x.hit] * x.reflectance[x.hit], x[x.hit]
        y = box.sample_lights(x, rng.random((len(x), 2)))
        cosine = np.maximum(np.sum(x.normal * y.direction, axis=1), 0) * box.visible(x, y)
        samples[walk, i] = beta / np.pi * y.weight * cosine[:, None]
        sphere = rng.normal(size=(len(x), 3))
        sphere /= np.linalg.norm(sphere, axis=1, keepdims=True)
        x = box.intersect(x, x.normal + sphere)  # with the pdf cosθ/π: of fs cosθ / pdf only ρ is left
    return samples


# %% [markdown]
# First: is it right? Then: what is it worth?

# %%
rays = box.camera_rays(1024, seed=seed)
groups = mine(rays, 3, np.random.default_rng(seed)).reshape(64, -1, 4, 3).mean(axis=(1, 3))  # 64 groups of samples
ours = box.render(bounces=3, spp=1024, method="walk", sampler="independent", seed=seed + 1, quiet=True).run.bounces
for i in (1, 2, 3):
    both = np.hypot(groups[:, i].std(ddof=1) / 8, ours[i].stderr)
    off = (groups[:, i].mean() - ours[i].mean) / both
    print(f"bounce {i}: mine {groups[:, i].mean():.5f}, walk {ours[i].mean:.5f}, {off:+.1f} standard errors of both")
    assert abs(off) <= limit(min(63, ours[i].degrees_of_freedom))  # three: false alarm in 50 000 seeds

truth = box.render(bounces=3, spp=8192, method="walk", sampler="independent", seed=seed + 7, quiet=True)
truth.save(os.path.join(folder.name, "box"))
both = [mine, "walk:direct=light:sampler=independent"]
against = box.study(both, samples=[4, 16, 64], repeats=8, bounces=3, reference=os.path.join(folder.name, "box"), seed=seed, quiet=True)
figure, axes = plots(1, 2, sharey=True)
for name in against.methods:
    curve = against.curve(name, 2)
    for axis, x in zip(axes, ("samples", "seconds")):
        axis.errorbar(curve[x], curve["rmse"], yerr=2 * curve["rmse_stderr"], fmt="o-", capsize=2, label=name.split(":")[0])
axes[0].set(xscale="log", yscale="log", xlabel="samples a pixel", ylabel=f"RMSE, {radiance_unit}")
axes[1].set(xscale="log", xlabel="seconds")
axes[0].legend()
plt.show()

# %% [markdown]
# The figure: RMSE of bounce 2 against samples and against time. They are the same estimator, so their errors are the
# same sample for sample; what differs is what a sample costs. **Q4.** Sample the lamp in proportion to the cosine at $x$: on which of
# the two plots must it show before it is worth anything?
#
# ## Samples that know each other
# $V \propto 1/N$ holds for independent samples. A **Markov chain** makes each path from the one before: it moves the path's random
# numbers a little, and goes there with probability $\min(1, f'/f)$, $f$ being what the path brings (Metropolis; Veach and Guibas
# 1997; Kelemen 2002). So it stays among paths that bring light once it has found one, and visits them in proportion to $f$. But its
# states are alike. With $\rho_k$ the correlation of states $k$ steps apart, $N$ states are worth
#
# $$\frac{N}{\tau}, \qquad \tau = 1 + 2 \sum_{k \ge 1} \rho_k$$
#
# independent ones: $\tau$ is the **integrated autocorrelation time**. Here is where the paths of one chain meet the film, through a
# door that is ajar, in bounce 2.

# %%
chain = scene("door-ajar", res=256).chain(2, states=20_000, seed=seed)
x, y = (chain.position - chain.position.mean(axis=0)).T


def correlation(x, most):
    spectrum = np.abs(np.fft.rfft(x, 2 * len(x))) ** 2
    return np.fft.irfft(spectrum)[:most] / np.fft.irfft(spectrum)[0]


figure, (film, decay) = plots(1, 2)
film.plot(*chain.position[:1500].T, lw=0.5, color="0.7")
large = chain.accepted & chain.large
film.plot(*chain.position[:1500].T, ".", ms=4)
film.plot(*chain.position[:1500][large[:1500]].T, "o", ms=7, color="C1", label="new numbers")
film.set(xlim=(0, 256), ylim=(256, 0), aspect="equal", title="1500 states on the film", xlabel="x, pixels", ylabel="y, pixels")
film.legend(loc="upper right")
for name, values in (("x", x), ("y", y)):
    decay.plot(correlation(values, 600), label=name)
decay.set(xlabel="steps k", ylabel="correlation of states k steps apart", title=r"$\rho_k$")
decay.legend()
plt.show()
rho = correlation(x, 5000)
end = np.argmax(rho < 0.05)  # beyond is noise
tau = 1 + 2 * rho[1:end].sum()
print(f"{chain}; tau is about {tau:.0f}: {len(chain)} states are worth {len(chain) / tau:.0f} independent ones")

# %% [markdown]
# The figure: small steps wander (blue), and now and then all numbers are drawn anew (orange).
#
# **Q5.** Most large steps are refused. Why does the chain need them all the same? (A5: small steps cannot leave an island of paths
# that bring light, and all others are not found without luck.)
#
# `method="metropolis"` runs thousands of such chains for each bounce, from starts that independent paths have found, and its error
# bars are from repeats of all of that. run.json has $\tau$, and a warning says where it is not much shorter than the chains.

# %% [markdown]
# ## How far to trust it
# - A time is a time *on this machine, now*: run a study on an idle one, and compare only what ran in turn. `study` takes its
#   methods in turn for that reason. Counts (rays, samples, applications of $K$) do not depend on the weather: plot against
#   `curve["rays"]` where times are doubtful.
# - An error has an error: with 8 repeats an RMSE is known to a quarter or so. Do not rank by less.
# - One number hides twenty: a method may be best in the sum and worst in bounce 4. Look at the bounces that matter to you.
# - Where the variance is infinite (lesson 4) there is no efficiency: repeats agree with each other, until one does not.

# %%
one, other = study.curve(methods[0], 2), study.curve(methods[1], 2)
gain, uncertain = (one["rmse"][-1] / other["rmse"][-1]) ** 2, 2 * np.hypot(
    one["rmse_stderr"][-1] / one["rmse"][-1], other["rmse_stderr"][-1] / other["rmse"][-1]
)
rays = one["rays"][-1] / other["rays"][-1]
print(
    f"bounce 2, bidirectional over walk: 1/V {gain:.1f} times (± {2 * uncertain:.0%}) for as many samples, "
    f"with {1 / rays:.1f} times the rays: "
    f"{gain * rays:.1f} times the efficiency by rays"
)
folder.cleanup()

# %% [markdown]
# ## Exercises
# 1. Add `"guided:sampler=independent"` to the second study. It has to think before it starts: where is that in the plot?
# 2. Give `matrix` 2000 and 8000 patches. Which part of its error falls, and how does its first run move?
# 3. Repeat the first study with `direct=light` in place of `hemisphere`. Its slope is not $-\frac12$. Why not? (Where does the
#    lamp touch what it lights?)
# 4. Write down the number of seconds after which `bidirectional` and `matrix` are equally good in bounce 3. How uncertain is it?
# 5. Use the folder of a 64-sample render of `walk` as the reference. Which figures become wrong, and which does `study` correct?
