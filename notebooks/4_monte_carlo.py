# %% [markdown]
# # 4. Monte Carlo: the same terms by random walks
#
# **What this teaches.** $K^i L_e$ is an integral over all paths with $i$ bounces, and an average over random walks estimates it.
# You will see why points are random, build such a walk on a matrix, where the truth is known, predict its variance before running
# it, and then compare the ways in which `neumann` makes paths: where they start, how they look for light, when they stop (russian
# roulette), and whether they branch (paths or trees).

# %%
from lesson import explore, limit, pictures, plots, scene, seed
import warnings

import matplotlib.pyplot as plt
import numpy as np
import neumann
import scipy.stats

rng = np.random.default_rng(seed)

# %% [markdown]
# ## Why at random at all
# A direction is two numbers, so bounce $i$ is an integral over $2i$ dimensions, and two more each for the place in the pixel and on the lens.
# A grid of $n$ points an axis has $N = n^d$ of them, and only how $n = N^{1/d}$ grows helps it. The error of four rules, by what is known of
# the integrand (for the last two the root of its mean square):
#
# | rule | points | smooth | a jump across an axis |
# | --- | --- | --- | --- |
# | left Riemann sum | a corner of each cell | $N^{-1/d}$ | $N^{-1/d}$ |
# | midpoints | the middle of each cell | $N^{-2/d}$ | $N^{-1/d}$ |
# | jittered | a random one in each cell | $N^{-1/2 - 1/d}$ | $N^{-1/2 - 1/(2d)}$ |
# | Monte Carlo | any | $N^{-1/2}$ | $N^{-1/2}$ |
#
# Take $f = \prod_k e^{x_k} / (e-1)$, and a jump at $x_1 = c$, with $c$ uniform in $[0, 1]$: for both all errors are known, not only how they
# fall. For the product, for instance, the midpoints give $(\frac{h/2}{\sinh h/2})^d$, $h = \frac1n$, where 1 is right; a jump is misjudged by at
# most half a cell, which is $h / \sqrt{12}$ on the average. A third integrand has a tilted jump, as edges of shadows are: for it only the
# worst case is known, and the measured error is what it is.


# %%
def points(rule, n, d):
    cells = np.stack(np.meshgrid(*[np.arange(n)] * d, indexing="ij"), axis=-1).reshape(-1, d)
    inside = {"left": 0.0, "middle": 0.5, "jittered": rng.random(cells.shape), "random": None}[rule]
    return rng.random(cells.shape) if inside is None else (cells + inside) / n


def known_error(rule, n, d, smooth):
    h, N = 1 / n, n**d
    if not smooth:
        return {"left": h / 3**0.5, "middle": h / 12**0.5, "jittered": (n ** (d - 1) / 6) ** 0.5 / N, "random": (6 * N) ** -0.5}[rule]
    square = (np.e**2 - 1) / 2 / (np.e - 1) ** 2  # ∫f² along an axis, and of the cells' means of f
    square_of_means = (np.e**2 - 1) / (n * np.expm1(2 * h)) * (np.expm1(h) / h / (np.e - 1)) ** 2
    return {
        "left": 1 - (h / np.expm1(h)) ** d,
        "middle": 1 - (h / 2 / np.sinh(h / 2)) ** d,
        "jittered": ((square**d - square_of_means**d) / N) ** 0.5,
        "random": ((square**d - 1) / N) ** 0.5,
    }[rule]


repeats, fails = 32, scipy.stats.norm.sf(4.5)
figure, axes = plots(2, 3, height=0.42, sharey="row")
for (above, below), d, sizes in zip(axes.T, (2, 4, 8), ((3, 6, 12, 25, 50), (2, 3, 4, 6, 8), (2, 3))):
    N, tilted = np.array(sizes, dtype=float) ** d, []
    for color, rule in enumerate(("left", "middle", "jittered", "random")):
        smooth, jump, tilt = (np.zeros((len(sizes), repeats)) for _ in range(3))
        for k, n in enumerate(sizes):
            for r in range(repeats):
                x, c = points(rule, n, d), rng.random()
                smooth[k, r] = np.exp(x.sum(axis=1)).mean() / (np.e - 1) ** d - 1
                jump[k, r] = np.mean(x[:, 0] < c) - c
                slopes, c = rng.uniform(-1, 1, d - 1), rng.uniform(0.25, 0.75)
                slopes /= max(2 * np.abs(slopes).sum(), 1)  # c ± 1/4 stays in the cube, so that the volume is c
                tilt[k, r] = np.mean(x[:, 0] < c + (x[:, 1:] - 0.5) @ slopes) - c
        for axis, errors, is_smooth in ((above, smooth, True), (below, jump, False)):
            axis.loglog(N, np.sqrt(np.mean(errors**2, axis=1)), "o", ms=5, color=f"C{color}")
            axis.loglog(N, [known_error(rule, n, d, is_smooth) for n in sizes], color=f"C{color}", label=rule)
        if rule in ("left", "middle"):
            np.testing.assert_allclose(np.abs(smooth), np.array([[known_error(rule, n, d, True)] for n in sizes]) * np.ones(repeats), rtol=1e-8)
            # The points of a column misjudge it by less than a cell; a tilt changes by half a cell within the column.
            assert (np.abs(jump) * np.array(sizes)[:, None] <= 1 + 1e-12).all() and (np.abs(tilt) * np.array(sizes)[:, None] <= 1.5).all()
        else:
            share = np.sum(smooth[-1] ** 2) / known_error(rule, sizes[-1], d, True) ** 2  # χ² of 32 degrees of freedom; six in all
            assert scipy.stats.chi2.isf(1 - fails, repeats) < share < scipy.stats.chi2.isf(fails, repeats)  # a false alarm in 20 000 seeds
        tilted.append(np.sqrt(np.mean(tilt[-1] ** 2)))
        below.loglog(N, np.sqrt(np.mean(tilt**2, axis=1)), "x", color=f"C{color}")
    print(f"{d} dimensions, {N[-1]:.0f} points, tilted jump:", *(f"{r} {e:.5f}" for r, e in zip(("left", "middle", "jittered", "random"), tilted)))
    above.set_title(f"{d} dimensions: smooth", fontsize="small")
    below.set_title(f"{d} dimensions: a jump", fontsize="small")
    below.set_xlabel("points $N$", fontsize="small")
axes[0, 0].legend(fontsize="x-small")
for axis in axes[:, 0]:
    axis.set_ylabel("error", fontsize="small")
plt.show()

# %% [markdown]
# The figure: lines are what is known, dots the rules at work; crosses are tilted jumps. Midpoints win where all is smooth and
# $\frac2d > \frac12$: below 4 dimensions. With jumps they win below 2. Light has jumps, at every edge of a shadow, and bounce 2 has four
# dimensions without the pixel's. But two things are less grim than "grids are useless". A tilted jump cuts each column of cells elsewhere, and
# most of the misjudgements cancel: the bound $N^{-1/d}$ is the worst case, and holds for jumps along the axes. And *jittered* points are
# never worse than random ones with as many samples; what they cost is that $N$ has to be $n^d$. Sobol' points (lesson 5) lift that.
#
# ## A walk on a matrix
# In the cube of lesson 2, $F_{uv}$ is the share of what leaves $u$ that arrives at $v$. It is also a *probability*: the rows sum
# to 1. Read it backwards in time: to know what leaves patch $u$, choose a patch $v$ with probability $F_{uv}$, and look there.
# That is one bounce, $K = \rho F$, with a single sample:
#
# $$(K f)_u = \rho \sum_v F_{uv} f_v = \rho\, E[f_v],
# \qquad (K^i L_e)_u = \rho^i\, E[\,L_e(v_i)\,] \text{ for a walk } u \to v_1 \to v_2 \to \dots \to v_i .$$
#
# One walk serves all bounces: look at $L_e$ at every stop.

# %%
cube, rho, bounces, walks = neumann.cube(6), 0.9, 6, 100_000
n = 6
start = int(np.flatnonzero(cube.face == 4)[n * (n // 2) + n // 2])  # a patch of the floor beside its middle
Le = (cube.face == 5).astype(float)
cumulative = np.cumsum(cube.F, axis=1)
cumulative /= cumulative[:, -1:]


def step(at):
    """The next stop of each walk: v with probability F_uv. All walks that are at u are sorted in together."""
    random, following = rng.random(at.size), np.empty_like(at)
    order = np.argsort(at, kind="stable")
    for group in np.split(order, np.flatnonzero(np.diff(at[order])) + 1):
        following[group] = np.searchsorted(cumulative[at[group[0]]], random[group])
    return following


at, scores = np.full(walks, start), []
for i in range(1, bounces + 1):
    at = step(at)
    scores.append(rho**i * Le[at])
scores = np.array(scores)
exact, t = [], Le
for i in range(bounces):
    t = rho * cube.F @ t
    exact.append(t[start])
exact = np.array(exact)
mean, error = scores.mean(axis=1), scores.std(axis=1, ddof=1) / np.sqrt(walks)
print("bounce      exact       walks   standard error   off by")
for i in range(bounces):
    print(f"{i + 1:6d} {exact[i]:10.6f} {mean[i]:11.6f} {error[i]:14.6f} {(mean[i] - exact[i]) / error[i]:+9.1f}")
assert (np.abs(mean - exact) <= limit() * error).all()  # six: false alarm in 25 000 seeds

# %% [markdown]
# **Q1.** The score of bounce $i$ is $\rho^i$ with probability $p_i$ and else 0. So what is its variance? (A1:
# $\rho^{2i}\, p_i (1 - p_i)$ with $p_i = (K^i L_e)_u / \rho^i$.)
#
# A variance that is known in advance is the sharpest test of a random walk, for bugs like to hide in the noise.

# %%
p = exact / rho ** np.arange(1, bounces + 1)
predicted, measured = rho ** (2 * np.arange(1, bounces + 1)) * p * (1 - p), scores.var(axis=1, ddof=1)
# The estimated variance of a coin: its own standard error is |1 − 2p| √(p(1−p)/N) ρ^2i.
deviation = np.abs(1 - 2 * p) * np.sqrt(p * (1 - p) / walks) * rho ** (2 * np.arange(1, bounces + 1))
assert (np.abs(measured - predicted) <= limit() * deviation + 2 / walks * predicted).all()  # six: as above

sizes = 2 ** np.arange(4, 13)
figure, axes = plt.subplots()
for i in (0, 1, 4):
    spread = [scores[i][: walks // size * size].reshape(-1, size).mean(axis=1) - exact[i] for size in sizes]
    axes.loglog(sizes, [np.sqrt(np.mean(s**2)) for s in spread], "o", label=f"bounce {i + 1}")
    axes.loglog(sizes, np.sqrt(predicted[i] / sizes), "-", color="grey")
axes.set(xlabel="walks $N$", ylabel="root of the mean squared error", title=r"Error of a mean of $N$ walks; lines: $\sqrt{V/N}$")
axes.legend()
plt.show()

# %% [markdown]
# The figure: errors of means of $N$ walks against what the predicted variance says. Four times the walks, half the error: a slope
# of $-\frac12$.
#
# ## Ways to look for light
# In a scene, directions of a walk hit the lamp by chance. It is better to *ask* for light at every stop: choose a point on the
# lamp, see whether it is visible, and weigh it by $1/\mathrm{pdf}$. `direct=` chooses how bounce 1 (and the last step of every
# other bounce) is found: directions uniform over the hemisphere, by the cosine, or by the material; points on the lamp; or both,
# by multiple importance sampling (`mis`).

# %%
room, spp = scene("cornell-box", res=256), 8
strategies = ("hemisphere", "cosine", "light", "mis")
direct = {how: room.render(bounces=3, spp=spp, direct=how, sampler="independent", seed=seed, quiet=True) for how in strategies}
pictures([direct[how].terms[1] for how in strategies], strategies, white=0.35)
plt.show()

# %%
print("variance of one sample, mean over pixels and channels, and rays a sample")
variance = {}
for how in strategies:
    variance[how] = [spp * np.mean(np.square(direct[how].terms_spread[i], dtype=float)) for i in (1, 2, 3)]
    rays = direct[how].run.timing.rays / (256 * 256 * spp)
    print(f"{how:12s}" + "".join(f"   bounce {i}: {v:9.2e}" for i, v in zip((1, 2, 3), variance[how])) + f"   {rays:.1f} rays")
assert variance["mis"][0] < 0.1 * variance["cosine"][0] < variance["hemisphere"][0]
for i in (1, 2, 3):
    truth = direct["mis"].run.bounces[i]
    for how in ("hemisphere", "cosine"):
        b = direct[how].run.bounces[i]
        both = np.hypot(b.stderr, truth.stderr)
        assert abs(b.mean - truth.mean) <= limit(min(b.degrees_of_freedom, truth.degrees_of_freedom)) * both  # six comparisons

# %% [markdown]
# The figure: bounce 1 by four strategies with 8 samples a pixel, at one exposure. The mean is the same, the noise is not.
#
# How noisy a pixel is, a render says itself: each has a standard error, estimated from its own samples. Where ipywidgets is installed,
# a slider doubles them.


# %%
def show(doublings):
    """Bounce 2 of 2^doublings samples a pixel, and its standard error."""
    made = room.render(bounces=2, spp=2**doublings, method="walk", sampler="independent", seed=seed, quiet=True)
    pictures([made.terms[2], made.terms_stderr[2]], [f"bounce 2, {2**doublings} samples", "standard error"], white=0.15)
    plt.show()


explore(show, doublings=(1, 7, 4))

# %% [markdown]
# The figure: bounce 2, and how far each of its pixels may be off. The error is not the same everywhere: it follows the light. Four
# times the samples, and it is half.
#
# **Q2.** The lamp covers a small part of what a point of the floor sees, say $p$. By which factor does asking the lamp reduce the
# variance of bounce 1, roughly? **Q3.** When would directions do better than points on lamps? (A3: a lamp that touches the wall,
# seen from right beside it, and narrow highlights of large lamps; `scene("glossy-floor")` has both.)
#
# ## Path generators
# Where does a path begin? At the camera (`walk`), at the lamp (`light`, the walk of the adjoint $K^*$), at both
# (`bidirectional`), or anywhere, by points on surfaces that have to see each other (`surface`). `pointwise` computes each bounce
# from nested functions $T$ and $R$, exactly as on a lecture's slide. All estimate the same integral.

# %%
panels = scene("floating-panels", res=256)
methods = ("walk", "pointwise", "surface", "light", "bidirectional")
made = {
    m: panels.render(bounces=3, spp=spp, method=m, sampler="independent", seed=seed + 10 * k, quiet=True)
    for k, m in enumerate(methods)
}
pictures([made[m].terms[2] for m in methods], methods, white=np.percentile(made["walk"].terms[2], 99))
plt.show()

# %%
# The mean of a picture does not depend on its pixels: few of them, and many samples in each, which are 64 independent groups.
coarse = scene("floating-panels", res=8)
means = {
    m: coarse.render(bounces=3, spp=2048, method=m, sampler="independent", seed=seed + k, quiet=True).run.bounces
    for k, m in enumerate(methods)
}
for i in (1, 2, 3):
    print(
        f"bounce {i}: "
        + "   ".join(
            f"{m} {means[m][i].mean:.5f}" + (f" ± {means[m][i].stderr:.5f}" if "stderr" in means[m][i] else " (no interval)")
            for m in methods
        )
    )
    for m in methods[1:]:
        a, b = means[m][i], means["walk"][i]
        if "stderr" not in a:
            continue  # its samples look as if their variance were infinite: see below
        both = np.hypot(a.stderr, b.stderr)
        assert (
            abs(a.mean - b.mean) <= limit(min(a.degrees_of_freedom, b.degrees_of_freedom)) * both
        ), f"{m}, bounce {i}"  # twelve: 1 in 12 000
        assert m == "pointwise" or both < 0.05 * b.mean, "an agreement within large errors would say nothing"

print("\n1 / (variance of a pixel × rays), over that of the walk")
efficiency = {
    m: [1 / (np.mean(np.square(made[m].terms_spread[i], dtype=float)) * made[m].run.timing.rays) for i in (1, 2, 3)]
    for m in methods
}
for m in methods:
    print(f"{m:14s}" + "".join(f"{e / w:8.2f}" for e, w in zip(efficiency[m], efficiency["walk"])))

# %% [markdown]
# The figure: bounce 2 of the floating panels by five generators, with 8 samples a pixel. The table counts what the noise costs
# in rays.
#
# **Q4.** In bounce 1 the noise of `light` costs some twenty times as many rays as that of `walk`, in bounce 3 hardly more,
# although it is the same walk from the other end. Which of its rays are of no use to bounce 1? And in what does its noise differ,
# to the eye?
#
# ## Photons: paths that are kept
# A path from the lamp need not be joined to the camera at once. Let it leave a *photon* wherever it is reflected: the power
# $\Phi_p$ that arrives there, from where, and the number $j$ of the bounce by which it leaves. One such map serves all bounces
# and all pixels (Jensen 1996). In a radius $r$ around the point $x$ that a camera ray hits, the photons of bounce $j$ say how
# much light arrives, and
#
# $$(K^j L_e)(x, \omega_o) \approx \sum_p f_s(\omega_p \to \omega_o)\, \Phi_p\, k(|x_p - x|),
# \qquad k(d) = \frac{2}{\pi r^2}\Bigl(1 - \frac{d^2}{r^2}\Bigr).$$

# %%
ball = scene("glass-ball", res=256)
photons = ball.photons(100_000, bounces=3, seed=seed)
figure, axes = plots(1, 3)
for axis, j in zip(axes, (1, 2, 3)):
    of = photons.bounce == j
    seen = of & ~np.isnan(photons.pixel[:, 0])
    for caustic, color in ((False, "C0"), (True, "C1")):
        points = photons.pixel[seen & (photons.caustic == caustic)]
        axis.plot(points[:, 0], points[:, 1], ",", color=color)
    axis.set(xlim=(0, 256), ylim=(256, 0), xticks=[], yticks=[], aspect="equal", title=f"bounce {j}: {of.sum()}")
plt.show()
power = [photons.power[photons.bounce == j].sum(axis=0).mean() for j in (1, 2, 3)]
print("power that arrives, W:", *(f"bounce {j}: {w:.3f}" for j, w in zip((1, 2, 3), power)))

# %% [markdown]
# The figure: what the camera sees of 100 000 paths' photons, and how many there are in all; orange ones came by way of the glass
# alone. In bounce 3 they crowd in the focus: a walk from the camera would have to meet the small lamp through the glass by chance.
#
# **Q5.** The glass ball itself has no photons. Why not? And why are there fewer of them with every bounce, although no path has
# been ended by roulette?
#
# `method="photon"` does this in passes of shrinking radius. What it does not know is of two kinds: noise, which is in the
# standard error, and the blur of its radius, a *bias*, which no number of samples with that radius removes. It reads every map
# with two radii, and tells from the difference how far the blur goes: the channel `discretisation`.

# %%
small = scene("glass-ball", res=32)
by_photons = small.render(bounces=3, spp=256, method="photon", seed=seed, quiet=True)
by_walks = small.render(bounces=3, spp=1024, method="bidirectional", seed=seed + 1, quiet=True)
for i in (1, 2, 3):
    a, b = by_photons.run.bounces[i], by_walks.run.bounces[i]
    if "stderr" not in a or "stderr" not in b:
        continue
    blur = np.mean(by_photons.terms_discretisation[i])
    print(f"bounce {i}: photons {a.mean:.5f} ± {a.stderr:.5f}, blur up to {blur:.5f}; from both ends {b.mean:.5f} ± {b.stderr:.5f}")
    both = np.hypot(a.stderr, b.stderr)
    assert abs(a.mean - b.mean) <= limit(min(a.degrees_of_freedom, b.degrees_of_freedom)) * both + blur  # three: 1 in 12 000

# %% [markdown]
# ## Records: irradiance that is kept
# Light that has been reflected before changes slowly along a diffuse surface. So let few points know it well, and read it nearby: an
# *irradiance cache* (Ward 1988). A record holds $E_k = \int (T K^k L_e) \cos\theta\, d\omega$ for every $k \ge 1$, from one hemisphere
# of rays, and $K^{k+1} L_e = \frac{\rho}{\pi} E_k$. Where a ray ends, it reads $E_{k-1}$ of the records there: $K^i L_e = K\,(K^{i-1}
# L_e)$. The same rays tell how $E_k$ changes along the surface, and how fast that change changes, which says how far apart records
# may stand.

# %%
cornell = scene("cornell-box", res=256)
records = cornell.records(bounces=2, seed=seed)
shown = records.seen & ~np.isnan(records.pixel[:, 0])
figure, axes = plots(1, 2)
for axis, k in zip(axes, (1, 2)):
    E = records.irradiance[shown, k - 1]
    axis.scatter(*records.pixel[shown].T, s=9, c=np.clip(E / np.quantile(E, 0.98), 0, 1) ** (1 / 2.2), edgecolors="black", linewidths=0.2)
    axis.set(xlim=(0, 256), ylim=(256, 0), xticks=[], yticks=[], aspect="equal", facecolor="0.5", title=f"$E_{k}$ of {shown.sum()} records")
plt.show()
print(records)
print("radius: least {:.3g}, median {:.3g}, largest {:.3g}".format(*np.quantile(records.radius, (0, 0.5, 1))))

# %% [markdown]
# The figure: where records stand, in the colour of their irradiance. They crowd where walls meet and at the edges of the boxes.
#
# **Q6.** Why there? And why does the light of the lamp itself, $E_0$, not belong into a record? (A6: near an edge the light that a point
# receives from the other wall changes over the distance to it. $E_0$ has sharp shadows, over which no record reaches.)
#
# `method="cache"` fills the records anew in every pass. What it gets wrong, besides noise, is what it reads between its records. It
# reads all with two radii, and tells from the difference how large that error is: again `discretisation`. But here no number of samples
# makes it smaller, only records that stand closer (`accuracy=`).

# %%
small = scene("cornell-box", res=32)
by_records = small.render(bounces=3, spp=256, method="cache", seed=seed, quiet=True)
by_walks = small.render(bounces=3, spp=256, method="walk", seed=seed + 1, quiet=True)
for i in (2, 3):
    a, b = by_records.run.bounces[i], by_walks.run.bounces[i]
    wrong = np.mean(by_records.terms_discretisation[i])
    noise = [np.mean(np.square(x.terms_spread[i], dtype=float)) ** 0.5 for x in (by_records, by_walks)]
    print(f"bounce {i}: records {a.mean:.5f} ± {a.stderr:.5f}, wrong by up to {wrong:.5f}; walks {b.mean:.5f} ± {b.stderr:.5f}")
    print(f"          noise of a pixel: {noise[0]:.5f}, walks {noise[1]:.5f}")
    both = np.hypot(a.stderr, b.stderr)
    assert abs(a.mean - b.mean) <= limit(min(a.degrees_of_freedom, b.degrees_of_freedom)) * both + wrong  # two: 1 in 18 000

# %% [markdown]
# ## Russian roulette
# A walk in a furnace of albedo $\rho$ that goes on with probability $q$ and is weighted by $1/q$ has the score
# $X = \sum_{k \le N} (\rho/q)^k$ with $P(N \ge k) = q^k$. Its mean is $1/(1-\rho)$ for any $q$. Its second moment is, with
# $w = \rho/q$,
#
# $$E[X^2] = \frac{1 + w q}{(1 - w q)(1 - w^2 q)} \text{ where } w^2 q = \rho^2/q < 1, \text{ and } \infty \text{ otherwise.}$$
#
# **Q7.** So $q$ may be smaller than $\rho$, but not than $\rho^2$. What is the variance at $q = \rho$? (A7: every score is
# $N + 1$: $q/(1-q)^2$.)

# %%
rho, count = 0.9, 200_000
figure, axes = plt.subplots()
for q in (0.95, 0.9, 0.85, 0.7):
    weight = rho / q
    length = rng.geometric(1 - q, size=count) - 1  # P(N ≥ k) = q^k
    score = (1 - weight ** (length + 1)) / (1 - weight) if weight != 1 else length + 1.0
    second = (1 + rho) / (1 - rho) / (1 - weight**2 * q) if weight ** 2 * q < 1 else np.inf
    V = second - 1 / (1 - rho) ** 2
    running = np.cumsum(score) / np.arange(1, count + 1)
    axes.semilogx(np.arange(1, count + 1)[99:], running[99:], label=f"q = {q}: {length.mean() + 1:.1f} stops, variance {V:.1f}")
    assert abs(length.mean() + 1 - 1 / (1 - q)) <= limit() * np.sqrt(q / count) / (1 - q)
    if np.isfinite(V):
        assert abs(score.mean() - 10) <= limit() * np.sqrt(V / count), q  # seven comparisons with the lengths: 1 in 20 000 seeds
    else:
        print(
            f"q = {q}: variance infinite; the sample shows {score.var():.0f}, "
            f"its largest score {score.max():.3g}, the mean is off by {score.mean() - 10:+.2f}"
        )
axes.axhline(10, color="black")
axes.set(xlabel="walks", ylabel="mean so far", ylim=(8, 12), title=r"Roulette in a furnace of albedo 0.9; truth $1/(1-\rho) = 10$")
axes.legend()
plt.show()

# %% [markdown]
# The figure: running means. Three of them settle at 10; the one with $q = 0.7 < \rho^2$ does not: it drifts below the truth,
# until a rare long walk brings a huge weight and it jumps. It is unbiased all the same. *No* error bar holds for it: the scatter
# that it shows is smaller than the scatter that it has.
#
# `neumann` says what `roulette=` does to walks, for the scene's largest albedo, and warns where the variance is infinite:

# %%
for q in ("albedo", 0.7):
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        white = scene("furnace", albedo=rho, res=8).render(bounces=2, spp=16, roulette=q, sampler="independent", seed=seed)
    known = white.run.samples.walks_in_a_furnace[0]
    print(f"roulette {q}: {known.expected_vertices:.1f} stops, second moment {known.second_moment_of_sum}")
    infinite = [w.message for w in caught if "infinite" in str(w.message)]
    for message in infinite:
        print("   warns:", message)
    assert bool(infinite) == (q == 0.7)

# %% [markdown]
# ## Paths or trees
# Should a walk branch? After a camera ray has hit the first surface, `split=(4, 4)` asks for light four times there, and lets
# four walks go on. A sample costs more rays and has less noise; what counts is noise at equal *rays*.

# %%
splits = {(1, 1): 64, (4, 1): 32, (1, 4): 20, (4, 4): 16, (16, 16): 4}
few = scene("cornell-box", res=48)
trees = {s: few.render(bounces=3, spp=n, split=s, sampler="independent", seed=seed, quiet=True) for s, n in splits.items()}
figure, axes = plt.subplots()
for s, tree in trees.items():
    rays = tree.run.timing.rays / (48 * 48)
    noise = [np.mean(np.square(tree.terms_spread[i], dtype=float)) * rays for i in (1, 2, 3)]
    axes.semilogy((1, 2, 3), noise, "o-", label=f"{s[0]} light samples, {s[1]} walks: {rays / splits[s]:.0f} rays a sample")
axes.set(xlabel="bounce", ylabel="variance of a pixel × rays", xticks=(1, 2, 3), title="Cornell box: less is better")
axes.legend()
plt.show()

# %% [markdown]
# The figure: cost of each bounce's noise for a path and for four trees. Asking the lamp four times makes bounce 1 cheaper by a
# third and the others dearer by a quarter; four walks make the others cheaper by a quarter, and bounce 1 three times as dear. The
# largest tree costs bounce 1 five times as much and wins nothing over four walks, for its sixteen start at the same point. Would
# you have guessed?
#
# **Q8.** A tree that branches at *every* stop has $C^i$ walks in bounce $i$. Where does its effort go, and where is the light?
#
# ## Exercises
# 1. Start the walk on the matrix in the middle of the ceiling. Predict its variances first.
# 2. Give the walk on the matrix next-event estimation: at every stop add $\rho^{i+1} F_{u,\text{lamp}}$ (all of it, it is known)
#    in place of looking whether the walk hits the lamp. What is the variance of bounce 1 now?
# 3. Which of the five generators can make what `scene("facing-mirrors")` shows in bounce 1? Try, and read `series.run.paths`.
# 4. For $\rho = 0.99$: which $q$ makes variance × stops smallest? Plot the formula.
# 5. Compare `method="guided"` with `walk` in `scene("door-ajar", res=48)`: from which bounce on does it gain, per ray and per
#    second?
