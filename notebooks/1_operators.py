# %% [markdown]
# # 1. The rendering equation as operators
#
# **What this teaches.** The rendering equation is one line, $L = L_e + K L$, once its two halves have names: $T$ carries light
# from surface to surface, $R$ scatters it there, and $K = R \circ T$ makes all light of a scene bounce once. Put the line into
# itself and the light falls apart into bounces, $L = L_e + K L_e + K^2 L_e + \dots$ You will make each of them as a picture, say
# what bounces 2 and 3 show, add them up, and see how russian roulette finds what is left out.
#
# This is the exercise of Berkeley's course CS184, whole: *render the m-th bounce for m = 0 to 5, explain bounces 2 and 3,
# accumulate, then russian roulette*. As one command it is
#
#     ./run render scenes/cornell-box/cornell-box.xml -n 5
#
# Every `assert` is a promise of the text above it. If one does not hold, the lesson stops there.

# %%
from lesson import explore, limit, pictures, scene, seed
import matplotlib.pyplot as plt
import numpy as np
import neumann

# %% [markdown]
# ## The exercise in one cell
# In Jupyter the last line shows all bounces, what is left beyond them, and the sums below, at one exposure.

# %%
series = scene("cornell-box", res=256).render(bounces=5, spp=64, method="walk", sampler="independent", seed=seed, quiet=True)
series

# %% [markdown]
# ## Two operators
# $L(p, \omega)$ is the radiance that leaves the point $p$ along $\omega$. All directions point away from the surface.
#
# **Transport** asks what *arrives*. What arrives at $p$ from $\omega$ is what left the first surface seen there,
# $\mathrm{tr}(p, \omega)$:
#
# $$(T f)(p, \omega) = f(\mathrm{tr}(p, \omega), -\omega), \text{ and 0 where nothing is seen.}$$
#
# **Reflection** asks what *leaves*. It is what arrives from all sides, scattered by the material:
#
# $$(R g)(p, \omega_o) = \int f_s(p, \omega_i \to \omega_o)\, g(p, \omega_i)\, |\cos\theta_i|\, d\omega_i.$$
#
# Both are linear, and each maps a whole function to a whole function. With $K = R \circ T$ the equation is $L = L_e + K L$.
#
# **Q1.** Which of the two has to know the walls' colours? Which of the two needs a ray tracer?
#
# **Q2.** Switch a second lamp on. What happens to $L$? (Use linearity.)
#
# Cut the surfaces into patches, give each one value, and the operators become matrices that you can hold. A row of $T$ is one
# ray: it has a single 1, at the patch that the ray meets. A row of $R$ is one patch: it averages over the patch's rays, and
# multiplies by its reflectance $\rho$.

# %%
rays = 256  # of a patch
patches = scene("cornell-box", res=256).matrices(patches=3000, directions=rays, channel="r", seed=seed, quiet=True)
T, R, Le = patches
print(patches)
assert (T.data == 1).all() and (np.diff(T.indptr) <= 1).all(), "a ray meets one patch, or none"
misses = np.diff(T.indptr) == 0
print(f"{misses.mean():.1%} of the rays leave through the open front and bring no light")
reflectance = np.asarray(R.sum(axis=1)).ravel()
print("reflectances in red light:", np.unique(reflectance.round(4)))
assert R.min() >= 0 and reflectance.max() < 0.7801  # of the lamp's own surface; see scenes/cornell-box

# %% [markdown]
# (A1: $R$ has the colours and no rays, $T$ has the rays and no colours. A2: $L$ becomes the sum of what each lamp makes alone.)
#
# ## One bounce at a time
# Now light bounces by multiplying. The loop below is all there is to it, but for its first step: the lamp is small, and so $K L_e$ is
# taken from points *on the lamp*, each patch asking which of them it sees. `patches.b` is that. From then on the whole room shines,
# and a patch's rays are enough.

# %%
light, seen = patches.b, [patches.picture(Le)]
for i in range(1, 6):
    seen.append(patches.picture(light))
    light = R @ (T @ light)  # K = R T
pictures(seen, [f"bounce {i}" for i in range(6)])
plt.show()

# %% [markdown]
# The figure: $L_e$, and $K$ applied to it up to five times, as the camera sees 3000 patches in red light. Each picture is as bright
# as it can be; the radiance that is shown as white stands above it. Patches look like tiles, and shadows have steps: a patch has one
# value. That is an error, the *discretisation*, and lesson 3 is about it.
#
# ## Why the lamp was asked
# $R\,(T L_e)$ is bounce 1 as well, by the same matrices as all others. It waits for rays to meet the lamp.

# %%
by_chance = R @ (T @ Le)
pictures([patches.picture(by_chance), patches.picture(patches.b)], ["rays that meet the lamp", "points on the lamp"], white=0.3)
plt.show()

# %% [markdown]
# The figure: bounce 1 twice, from 256 rays of each patch, and from points on the lamp. On the left it is confetti. That is not the
# discretisation, for the patches are the same. A ray of a patch meets the lamp with some probability $p$, the share of the patch's
# view, weighted by the cosine, that the lamp fills. The number of rays that do is 0 or 1 or 2, and each brings all of the lamp's
# radiance. Of $n$ independent rays that is a mean with the relative standard error $\sqrt{(1 - p)/(n\,p)}$: large, because $p$ is
# small. It is *noise*: both pictures have the same expected value. Count it:

# %%
p = patches.b / (reflectance * Le.max())  # K Le = ρ p Le
sees = p > 1e-4
met = by_chance / (reflectance * Le.max()) * rays  # rays that met the lamp
assert np.allclose(met, met.round(), atol=1e-6)
met, expected = met[sees], rays * p[sees]
relative = np.sqrt(np.mean((met / expected - 1) ** 2))
print(f"the lamp fills {p[sees].mean():.2%} of a view: of {rays} rays {expected.mean():.1f} meet it; of {np.mean(met == 0):.0%} of the patches, none")
print(f"relative error of a patch: {relative:.0%}; independent rays would have {np.sqrt(np.mean((1 - p[sees]) / expected)):.0%}")
assert np.mean((met - expected) ** 2 / (expected * (1 - p[sees]))) < 1, "rays that are spread evenly do better than independent ones"
# In the mean both are right: the sum over all patches is within the noise of independent rays.
assert abs(np.sum(met - expected)) <= limit() * np.sqrt(np.sum(expected * (1 - p[sees])))

# %% [markdown]
# **Q3.** Linearity, tried: is $K(2f + g) = 2Kf + Kg$?

# %%
K = R @ T
rng = np.random.default_rng(seed)
f, g = rng.random(Le.size), rng.random(Le.size)
assert np.allclose(K @ (2 * f + g), 2 * (K @ f) + K @ g, rtol=1e-12, atol=0)

# %% [markdown]
# ## The same without patches
# `render` needs no patches. It follows light backwards, by random walks from the camera, and each walk scores in every bounce at
# once. The price is noise, so every pixel has a standard error. The first cell did that; these are its terms $K^i L_e$.

# %%
white = np.percentile(series.sums[5], 99)
pictures(series.terms, [f"bounce {i}" for i in range(6)])
plt.show()

# %% [markdown]
# The figure: bounces 0 to 5 with all three colours. Each has its own exposure, without which bounce 5 would be black.
#
# **Q4.** Why is the ceiling black in bounce 1? **Q5.** What do bounces 2 and 3 show?
#
# (A4: the lamp lies in the ceiling and shines down; no ray from a point of the ceiling to a point of the lamp has
# $\cos\theta > 0$. A5: *Bounce 2* is the first indirect light: it has been by way of one other surface. It reaches what the lamp
# does not, the ceiling and the shadows; it has no sharp shadows of its own, for now the whole lit room is the lamp; and it is
# tinted by the surface it came from: see the ceiling beside the red and the green wall. *Bounce 3* has been by way of two others:
# dimmer, flatter, and redder: the lamp is reddish already, and of the coloured walls the red one gives back most, 49% of the red
# that meets it, while the green one gives back 40% of the green, and neither much of the blue. The ceiling is brighter than the
# floor in bounce 2, when the floor sends it what it had from the lamp; in bounce 3 it is the other way round.)
#
# Count instead of looking:

# %%
lit = series.terms.sum(axis=3) > 0
ceiling = np.zeros(lit[0].shape, dtype=bool)
ceiling[12:24, 64:192] = True  # these rows show nothing else
assert not lit[1][ceiling].any() and lit[2][ceiling].all()
new = lit[2] & ~lit[0] & ~lit[1]
print(
    f"the lamp itself or its direct light: {(lit[0] | lit[1]).mean():.1%} of the pixels; "
    f"for the first time in bounce 2: {new.mean():.1%}"
)
floor = np.zeros_like(ceiling)
floor[232:244, 64:192] = True
above = [series.terms[i][ceiling].mean() / series.terms[i][floor].mean() for i in range(1, 6)]
print("ceiling over floor, bounces 1 to 5:", *(f"{x:.2f}" for x in above))
assert above[0] == 0 and above[1] > 1 > above[2]
colour = series.terms.mean(axis=(1, 2))
for i in range(6):
    print(
        f"bounce {i}: "
        + ", ".join(f"{share:.1%} {name}" for share, name in zip(colour[i] / colour[i].sum(), ("red", "green", "blue")))
    )
redness = colour[:, 0] / colour.sum(axis=1)
assert redness[1] < redness[2] < redness[3], "bounces 2 and 3 are redder than the one before; later ones too, but for their noise"

# %% [markdown]
# **Is it right?** scenes/cornell-box/README.md has the mean of each bounce from another program, a path tracer with
# $6 \cdot 10^7$ samples, and bounce 0 from geometry: 0.005893481 times the lamp's radiance. Two estimates agree if their
# difference is small against its standard error. `limit` is 4.5 such errors, and more where the error itself is known from few
# samples: a correct program misses it once in 150 000 comparisons.

# %%
known = np.array(
    [
        0.005893481 * (20.7113 + 10.8546 + 2.77115) / 3,
        *np.mean(
            [
                (0.053612, 0.0270904, 0.00584339),
                (0.0263715, 0.0132278, 0.00256801),
                (0.0127978, 0.00623517, 0.00106614),
                (0.00589461, 0.00286773, 0.000414496),
                (0.00304699, 0.00147398, 0.000192508),
            ],
            axis=1,
        ),
    ]
)
known_error = np.array([0, 9.8e-6, 8.9e-6, 5.6e-6, 3.1e-6, 1.8e-6])  # at most: that of red
for i, bounce in enumerate(series.run.bounces):
    error = np.hypot(bounce.stderr, known_error[i])
    print(
        f"bounce {i}: {bounce.mean:.6f} ± {bounce.stderr:.6f}, known {known[i]:.6f}, "
        f"{(bounce.mean - known[i]) / error:+.1f} standard errors"
    )
    assert abs(bounce.mean - known[i]) <= limit(bounce.degrees_of_freedom) * error  # six comparisons: a false alarm in 25 000 seeds

# %% [markdown]
# ## Accumulate
# The partial sums $S_n = \sum_{k \le n} K^k L_e$ are what a renderer shows that stops after $n$ bounces:
# $S_n = S_{n-1} + K^n L_e$, pixel by pixel.

# %%
pictures(series.sums, [f"bounces 0 to {i}" for i in range(6)], white=white)
plt.show()

# %% [markdown]
# The figure: $S_0$ to $S_5$, at one exposure. After bounce 2 the eye finds little to add; the numbers below say how much is still
# missing. Where ipywidgets is installed, sliders take you through bounces and exposures:


# %%
def show(bounce, stops):
    """A bounce and the sum up to it, brighter by 2^stops."""
    shown = [series.terms[bounce], series.sums[bounce]]
    pictures(shown, [f"bounce {bounce}", f"bounces 0 to {bounce}"], white=white / 2**stops)
    plt.show()


explore(show, bounce=(0, 5, 3), stops=(-3, 6, 3))

# %% [markdown]
# The figure: bounce 3 and $S_3$, eight times as bright as above. What the eye did not find is a picture, too.

# %%
sums, terms = series.sums.astype(float), series.terms.astype(float)
off = np.abs(sums[1:] - (sums[:-1] + terms[1:]))
rounding = 2.0**-24 * (sums[1:] + sums[:-1] + terms[1:])
assert (off <= rounding + 2.0**-148).all(), "pictures hold 32-bit floats: the three numbers are rounded, and nothing else is lost"

# %% [markdown]
# ## How fast they fall, and what is left out
# Each bounce loses what the surfaces absorb and what leaves through the open front, so after a while each is the same fraction of
# the one before.

# %%
mean, error = series.table["mean"], series.table["mean_stderr"]
rest, rest_error = series.run.rest.mean, series.run.rest.stderr
figure, axes = plt.subplots()
axes.errorbar(range(6), mean, yerr=limit() * error, fmt="o", capsize=3, label="bounce $i$")
axes.errorbar([6], [rest], yerr=limit() * rest_error, fmt="s", capsize=3, color="C3", label="rest: all bounces beyond 5")
ratio = mean[5] / mean[4]
axes.plot([3, 7], mean[4] * ratio ** np.array([-1.0, 3]), "--", color="grey", label=f"× {ratio:.2f} a bounce")
axes.set(
    yscale="log",
    xlabel="bounce $i$",
    ylabel="mean radiance, W·m$^{-2}$·sr$^{-1}$",
    title="Cornell box: mean of $K^i L_e$ over the picture",
)
axes.legend()
plt.show()

# %% [markdown]
# The figure: means of the bounces on a logarithmic axis, where a geometric series is a straight line. Error bars of 4.5 standard
# errors are drawn, and are smaller than the dots.
#
# **Q6.** If every later bounce were $r$ times the one before, what would be left beyond bounce 5? (A6:
# $b_5 (r + r^2 + \dots) = b_5\, r / (1 - r)$.)
#
# That is a guess. **Russian roulette** measures it. A walk that goes on for ever cannot be computed; a walk that stops after 5
# bounces never sees the rest, however many of them you take, and is wrong by it: it is *biased*. So let a walk go on with
# probability $q$, and if it does, divide what it brings by $q$:
#
# $$X_{rr} = \begin{cases} X / q & \text{with probability } q \\ 0 & \text{otherwise} \end{cases}
# \qquad E[X_{rr}] = q \cdot \frac{E[X]}{q} = E[X].$$
#
# It ends, and its mean is right. `render` does so beyond the last picture, and calls what it finds the rest.

# %%
guess = mean[5] * ratio / (1 - ratio)
print(f"rest: measured {rest:.5f} ± {rest_error:.5f}, guessed {guess:.5f}, bounded by {series.table['bound'][5]:.3g}")
print(f"bounces 0 to 5 hold {mean.sum() / (mean.sum() + rest):.1%} of the light in the picture")
assert 0 < rest - limit(series.run.rest.degrees_of_freedom) * rest_error, "something is left out"
assert rest <= series.table["bound"][5]

# %% [markdown]
# Roulette may begin earlier, too: `roulette=0.6` lets a walk go on with $q = 0.6$ after every bounce. It takes fewer rays, and
# the late bounces, which fewer walks reach, are noisier. The means stay what they were. (Of 64² pixels, which the mean does not
# mind.)

# %%
small = scene("cornell-box", res=64)
late = small.render(bounces=5, spp=64, method="walk", sampler="independent", seed=seed, quiet=True)
early = small.render(bounces=5, spp=64, sampler="independent", roulette=0.6, seed=seed + 1000, quiet=True)
print(f"rays: {early.run.timing.rays / late.run.timing.rays:.0%} of those without roulette")
for i in range(1, 6):
    a, b = early.run.bounces[i], late.run.bounces[i]
    both = np.hypot(a.stderr, b.stderr)
    print(
        f"bounce {i}: standard error {a.stderr / b.stderr:.1f} times as large, "
        f"difference {(a.mean - b.mean) / both:+.1f} of both together"
    )
    assert (
        abs(a.mean - b.mean) <= limit(min(a.degrees_of_freedom, b.degrees_of_freedom)) * both
    )  # five: false alarm in 30 000 seeds
assert early.run.timing.rays < late.run.timing.rays and early.run.bounces[5].stderr > late.run.bounces[5].stderr

# %% [markdown]
# ## Exercises
# 1. Render `scene("furnace", albedo=0.5)`, where every surface shines and reflects alike. Explain the value of each bounce
#    without a computer.
# 2. In the Cornell box, which of the bounces has most light on the *ceiling*? Predict, then measure with the mask above.
# 3. How many bounces does a picture need that is right to 1%? Use `render(tail=0.01)`, and compare with your estimate from the
#    ratio.
# 4. Change the order: what would $T \circ R$ mean, and on which light would it act? Compute it from the matrices, and show that
#    $R\,(T R)^n T L_e = K^{n+1} L_e$.
# 5. Give roulette $q = 0.3$. How many rays does it save, and how many samples would you need to have the noise of bounce 5 that
#    you had before?
