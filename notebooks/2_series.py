# %% [markdown]
# # 2. The Neumann series: terms, sums, bounds, and when to stop
#
# **What this teaches.** $L = L_e + K L$ has the solution $L = L_e + K L_e + K^2 L_e + \dots$, if that sum has an end. You will
# see how fast its terms fall and why, what can be *proven* about the terms that were never computed, which ways to stop are
# traps, and what happens when surfaces swallow less and less light.
#
# Notation: $t_n = K^n L_e$ is bounce $n$, $S_n = t_0 + \dots + t_n$ the sum so far, $\|t\|_\infty$ its largest value, $a$ the
# largest albedo (reflectance) of any surface. With finitely many patches fields are vectors and $K$ is a matrix; here that is
# done without light, rays or randomness.

# %%
from lesson import plots, scene, seed
import matplotlib.pyplot as plt
import numpy as np
import neumann

# %% [markdown]
# ## The same series as in school
# For a number $x$ with $|x| < 1$, $\frac{1}{1-x} = 1 + x + x^2 + \dots$ Replace $x$ by $K$ and 1 by the identity $I$:
#
# $$L = (I - K)^{-1} L_e = (I + K + K^2 + \dots)\, L_e .$$
#
# There is a scene in which the two are the same: the *white furnace*, a closed room in which every surface shines 1 and reflects
# $\rho$. Wherever you look there is the same light, so $K$ multiplies by $\rho$, and $K^i L_e = \rho^i$ in every pixel.

# %%
rho = 0.5
furnace = scene("furnace", albedo=rho, res=16).render(bounces=8, spp=4, direct="bsdf", seed=seed, quiet=True)
for i in range(9):
    assert np.abs(furnace.terms[i] - rho**i).max() <= 8 * i * 2.0**-24 * rho**i, f"bounce {i} is not {rho}^{i}"
assert np.allclose(furnace.sums[8], (1 - rho**9) / (1 - rho), rtol=1e-6)
print("bounces 0 to 4:", *furnace.terms[:5, 0, 0, 0], "…; their sum goes to", 1 / (1 - rho))

# %% [markdown]
# **Q1.** This picture has no noise at all, although it was made by random walks. Why? (A1: every walk meets the same radiance
# everywhere, and its weight is $\rho$ at each bounce, whatever its directions: there is nothing in it that could vary.)
#
# ## A room that is not all alike
# `neumann.cube(8)` is the inside of the unit cube with $8 \times 8$ patches a face. $F_{uv}$ is the *form factor*: the share of
# what leaves patch $u$ that arrives at $v$, computed by exact integrals. With reflectances $\rho$, $K = \mathrm{diag}(\rho)\, F$.
# The ceiling is the lamp.

# %%
cube = neumann.cube(8)
F, area, ceiling = cube.F, cube.area, cube.face == 5
Le = ceiling.astype(float)
assert np.allclose(F.sum(axis=1), 1, atol=1e-12), "the room is closed: all that leaves a patch arrives somewhere"

figure, axes = plt.subplots()
for rho in (0.5, 0.9, 0.99):
    run = neumann.series(rho * F, Le, error=0, most=60, norm=rho, measure=area, quiet=True)
    axes.plot(run.rows["bounce"], run.rows["sup"], ".-", label=rf"$\rho$ = {rho}")
    assert np.allclose(run.rows["power"], area[ceiling].sum() * rho ** run.rows["bounce"], rtol=1e-11)
axes.set(
    yscale="log",
    xlabel="bounce $n$",
    ylabel=r"$\Vert K^n L_e\Vert _\infty$",
    xlim=(0, 60),
    title="A closed cube, lit by its ceiling",
)
axes.legend()
plt.show()

# %% [markdown]
# The figure: the largest value of each term. After a handful of bounces the lines are straight: light has forgotten where it came
# from, and each bounce is $\rho$ times the one before. What the `assert` says is stronger: in a closed room of one reflectance
# the *power* $\sum_u A_u t_u$ of bounce $n$ is exactly $\rho^n$ times the lamp's, whatever the shape.
#
# ## The check of the lecture
# Is $I + K + K^2 + \dots$ really the inverse of $I - K$? Multiply, and all terms but the first and the last cancel, like the parts
# of a telescope:
#
# $$(I - K)\, S_n = (I + K + \dots + K^n)\, L_e - (K + K^2 + \dots + K^{n+1})\, L_e = L_e - K^{n+1} L_e .$$
#
# So $S_n$ solves the equation for a lamp that shines $K^{n+1} L_e$ less. The pictures are the wall beside the lamp, which shines
# nothing itself: above $S_n$, below $-(I - K)\, S_n = K^{n+1} L_e$, what it still lacks there.

# %%
rho, wall, shown = 0.8, cube.face == 1, (0, 1, 2, 4, 8, 16)
K, t, S = rho * F, Le, Le
figure, axes = plt.subplots(2, len(shown), figsize=(10, 4), layout="constrained")
for n in range(max(shown) + 1):
    left = S - K @ S  # (I − K) S_n
    t = K @ t  # K^{n+1} Le
    assert np.abs(left - (Le - t)).max() <= 1e-14
    if n in shown:
        for axis, picture, low, high in ((axes[0, shown.index(n)], S, 0, 1.2), (axes[1, shown.index(n)], -left, 0, 0.4)):
            axis.imshow(picture[wall].reshape(8, 8), vmin=low, vmax=high, origin="lower")
            axis.set(xticks=[], yticks=[])
        axes[0, shown.index(n)].set_title(f"$n$ = {n}")
    S = S + t
axes[0, 0].set_ylabel("$S_n$")
axes[1, 0].set_ylabel("$-(I - K)\\, S_n$")
plt.show()

# %% [markdown]
# The figure: the wall fills with light from the ceiling on, and what it lacks fades to 0. Nothing was assumed but that sums may be
# multiplied term by term; *that* it fades is what the rest of this lesson is about.
#
# ## What is proven about the rest
# What is left out after bounce $n$ is $L - S_n = t_{n+1} + t_{n+2} + \dots$ Nobody reflects more than $a$, so
# $\|K f\|_\infty \le a \|f\|_\infty$, and
#
# $$\|L - S_n\|_\infty \;\le\; \frac{a}{1-a}\, \|t_n\|_\infty \;\le\; \frac{a^{n+1}}{1-a}\, \|L_e\|_\infty .$$
#
# The right one is known before anything is computed (*a priori*), the left one after $n$ bounces (*a posteriori*). Both assume
# the worst everywhere. A third one looks at all patches: if the term after grew by at least $c_1$ and at most $c_2 < 1$ *at every
# patch*, then so do all later ones, since $K$ has no negative entries, and the solution is caught from both sides (Collatz and
# Wielandt):
#
# $$S_{n+1} + t_{n+1} \frac{c_1}{1 - c_1} \;\le\; L \;\le\; S_{n+1} + t_{n+1} \frac{c_2}{1 - c_2},
# \qquad c_1 t_n \le t_{n+1} \le c_2 t_n .$$
#
# A room whose faces reflect 0.2, 0.5, 0.8, 0.9, 0.95 and 0.7 shows the difference. `exact` is $L$ by elimination.

# %%
rho = np.array([0.2, 0.5, 0.8, 0.9, 0.95, 0.7])[cube.face]
K = rho[:, None] * F
exact = np.linalg.solve(np.eye(len(K)) - K, Le)
run = neumann.series(K, Le, error=1e-10, most=40, norm=0.95, measure=area, quiet=True)
n, t, S, tail = run.rows["bounce"], Le, Le.copy(), []
for _ in n:
    tail.append(np.abs(exact - S).max())
    t = K @ t
    S = S + t
tail, scale = np.array(tail), exact.max()
figure, axes = plt.subplots()
axes.plot(n, run.rows["a_priori"] / scale, label=r"a priori, $a^{n+1}/(1-a)\,\Vert L_e\Vert _\infty$")
axes.plot(n, run.rows["a_posteriori"] / scale, label=r"a posteriori, $a/(1-a)\,\Vert t_n\Vert _\infty$")
axes.plot(n, tail / scale, "k.", label=r"what is left, $\Vert L - S_n\Vert _\infty$")
axes.plot(n, run.rows["enclosure_width"], "--", color="C3", label="width of the enclosure")
axes.set(
    yscale="log",
    xlabel="bounce $n$",
    ylabel=r"relative to $\Vert L\Vert _\infty$",
    title="Bounds, and what they bound",
    ylim=(1e-11, 1e2),
)
axes.legend()
plt.show()

# %%
rounding = 1e-13 * scale
assert (tail <= run.rows["a_posteriori"] + rounding).all() and (run.rows["a_posteriori"] <= run.rows["a_priori"] + rounding).all()
assert (run.enclosure.low <= exact + rounding).all() and (exact <= run.enclosure.high + rounding).all(), "L is in the enclosure"
assert run.verdict == "converged" and np.abs(run.sum - exact).max() <= 1e-10 * scale
print(f"{run.verdict} after bounce {n[-1]:.0f}: {run.why}; c1 = {run.enclosure.c1:.6f}, c2 = {run.enclosure.c2:.6f}")
print(
    f"S_{n[-1]:.0f} itself is still off by {tail[-1] / scale:.1e}; "
    f"the middle of the enclosure by {np.abs(run.sum - exact).max() / scale:.1e}"
)

# %% [markdown]
# The figure: with each bounce 0.66 of what is left is left. Of the a-priori bound it is $a = 0.95$, that of the whitest face, as if
# the whole room were white; the a-posteriori bound falls like the terms, at a fixed distance. The enclosure shrinks faster than the
# terms themselves: it does not wait for the rest to vanish, it *knows* the rest, because the terms have become proportional to
# each other.
#
# **Q2.** Why is there no bound of the first kind for a room with one wall of albedo 1? Is there an enclosure? (A2: $1/(1-a)$ is
# infinite, although the other walls absorb. The enclosure looks at the terms themselves, which shrink, and it exists.)
#
# ## Traps
# "Stop when a bounce is small." "Stop when the ratio of two bounces has settled." Both are what many renderers do. Four small
# rooms where that goes wrong:


# %%
def terms(K, Le, n):
    found = [np.asarray(Le, dtype=float)]
    while len(found) <= n:
        found.append(K @ found[-1])
    return np.array(found)


# Twelve rooms in a row, each open to its neighbours by a tenth; the lamp is in the last one. We sit in the first.
rooms = 12
chain = np.zeros((rooms, rooms))
for u in range(rooms):
    for v in (u - 1, u + 1):
        chain[u, v if 0 <= v < rooms else u] += 0.099
        chain[u, u] += 0.99 * 0.4
last = np.eye(rooms)[-1]
# Two plates that face each other closely, one of which is the lamp (concentric spheres of radius 0.99 and 1).
plates, inner = 0.9 * np.array([[0, 1], [0.9801, 0.0199]]), np.array([1.0, 0])
# Two rooms that do not see each other: a bright one of albedo 0.5, and a dim one of albedo 0.99. We see the sum of both.
apart, both = np.diag([0.5, 0.99]), np.array([1, 1e-6])
# Three mirrors that pass light round.
ring, first = 0.9 * np.roll(np.eye(3), 1, axis=0), np.array([1.0, 0, 0])

figure, axes = plots(2, 2)
series = [
    (terms(chain, last, 400)[:, 0], "behind eleven doors"),
    (terms(plates, inner, 30)[:, 1], "near-parallel plates"),
    (terms(apart, both, 60).sum(axis=1), "a bright room and a slow one"),
    (terms(ring, first, 30)[:, 0], "three mirrors"),
]
for axis, (seen, title) in zip(axes.flat, series):
    axis.plot(np.arange(len(seen))[seen > 0], seen[seen > 0], ".")
    axis.set(yscale="log", title=title, xlabel="bounce $n$", ylabel="$t_n$ where we look")
plt.show()

# %% [markdown]
# The figure: terms as one observer sees them; where a dot is missing the term is exactly 0.
#
# - *Behind eleven doors* it is dark for eleven bounces, and then every bounce is brighter than the one before, for a long time.
#   Whoever stops at the first small bounce stops at 0.
# - *Near-parallel plates*: light goes to and fro, and the ratio of neighbours jumps between 0.018 and 44.
# - *A bright room and a slow one*: for 15 bounces the ratio is 0.50, as settled as can be. It predicts a rest that is far too
#   small.
# - *Three mirrors*: two of three terms are zero, and the third is not.

# %%
seen = series[0][0]
print(f"doors: the first light is in bounce {np.argmax(seen > 0)}, the brightest bounce is {np.argmax(seen)}")
assert np.argmax(seen > 0) == 11 and np.argmax(seen) > 55
early = neumann.series(chain, last, error=1e-2, most=10, norm=0.99, quiet=True)
assert early.verdict == "limit", "'stopped' is not 'converged'"
print(f"the series, stopped after 10 bounces, says: {early.verdict}, {early.why}")

seen = series[2][0]
ratio = seen[20] / seen[19]
guess, truth = seen[20] * ratio / (1 - ratio), 0.5**20 + 1e-4 * 0.99**21
print(
    f"slow room, after bounce 20: the ratio {ratio:.3f} predicts {guess:.2e}, "
    f"what is left is {truth:.2e}, {truth / guess:.0f} times as much"
)
assert 25.0 < truth / guess < 25.2  # 25.11, by hand

for K_, Le_, a in ((chain, last, 0.99), (plates, inner, 0.9), (apart, both, 0.99), (ring, first, 0.9)):
    found = neumann.series(K_, Le_, error=1e-8, norm=a, quiet=True)
    L = np.linalg.solve(np.eye(len(K_)) - K_, Le_)
    assert found.verdict == "converged" and np.abs(found.sum - L).max() <= 1e-8 * L.max()
    print(f"{found.verdict} after bounce {len(found.rows) - 1}: {found.why}")

# %% [markdown]
# **Q3.** What did the right answers have that the traps did not? (A3: a bound that holds for all patches, seen or not. "Is it
# small where I look" is a question about the picture, "does it end" one about the scene.)
#
# ## A norm of 1 says nothing
# $\|K\| < 1$ makes the series end; textbooks stop there. But $\|K\| \ge 1$ does not make it diverge. What decides is the
# *spectral radius* $|\lambda_1|$, the factor by which light shrinks in the long run. A sphere whose upper half reflects 1.6
# (paint cannot, but a typo can) and whose lower half 0.2: $K = \frac12 \begin{pmatrix} 1.6 & 1.6 \\ 0.2 & 0.2\end{pmatrix}$.

# %%
for upper in (1.6, 2.0):
    halves = np.array([[upper, upper], [0.2, 0.2]]) / 2
    norms, found = neumann.spectrum(halves, 1).norms, neumann.series(halves, [1, 1], quiet=True)
    radius = np.abs(np.linalg.eigvals(halves)).max()
    print(f"upper half {upper}: largest row sum of K {norms['inf']:.2f}, spectral radius {radius:.2f}: {found.verdict}")
    assert found.verdict == ("converged" if radius < 1 else "diverging")
    if radius < 1:
        assert np.allclose(found.sum, [17, 3], rtol=1e-5), "17 and 3, by hand"

# %% [markdown]
# ## Albedo towards 1
# In a furnace the relative rest after bounce $n$ is $\rho^{n+1}$. To make it smaller than $\varepsilon$ takes
# $n \ge \ln\varepsilon / \ln\rho - 1 \approx \ln(1/\varepsilon)\,/\,(1-\rho)$ bounces: ten times as close to 1, ten times as
# many.

# %%
albedos = np.array([0.5, 0.9, 0.99, 0.999])
needed = []
for rho in albedos:
    K = rho / 3 * np.ones((3, 3))
    t = total = np.ones(3)
    n = 0
    while 1 - total[0] * (1 - rho) > 1e-6:  # all unknowns are alike, and L = 1 / (1 - ρ)
        t = K @ t
        total = total + t
        n += 1
    needed.append(n)
figure, axes = plt.subplots()
axes.loglog(1 - albedos, needed, "o", label="counted")
x = np.geomspace(1e-4, 0.6, 100)
axes.loglog(x, np.log(1e-6) / np.log1p(-x) - 1, "-", color="grey", label=r"$\ln\varepsilon / \ln\rho - 1$")
axes.set(
    xlabel=r"$1 - \rho$, the share that a surface absorbs", ylabel="bounces", title=r"Bounces until $10^{-6}$ of the light is left"
)
axes.legend()
plt.show()

# %% [markdown]
# The figure: 19 bounces suffice at $\rho = 0.5$, 13 808 are needed at 0.999, and every power of ten costs a factor of ten. Lesson
# 3 gets there with a dozen applications of $K$ instead.

# %%
assert needed == [19, 131, 1374, 13808]  # ceil(ln ε / ln ρ − 1)
for rho in (1.0, 1.05):
    K = rho / 3 * np.ones((3, 3))
    found = neumann.series(K, [1, 2, 3], most=500, quiet=True)
    print(f"albedo {rho}: the series is {found.verdict}, {found.why}")
    assert found.verdict != "converged"
K = 1.05 / 3 * np.ones((3, 3))
print("elimination, which does not look, gives L =", np.linalg.solve(np.eye(3) - K, np.ones(3)).round(6))
checked = neumann.solve(K, np.ones(3), "lu")
assert checked.verdict == "refused" and np.allclose(checked.x, -20)
print(f"neumann.solve(…, 'lu'): {checked.verdict}, {checked.why}")

# %% [markdown]
# **Q4.** At albedo 1.05 elimination finds $L = -20 = 1/(1 - 1.05)$. It solves $L = L_e + K L$, put it in. Why is it no light?
# (A4: light is the *sum of the bounces*, all of which are positive. The equation has a solution, the series has none.)
#
# ## Exercises
# 1. Light a *wall* of the cube in place of the ceiling. Which of the curves above change, and which do not? Say why before you
#    try.
# 2. Find the bounce at which the a-posteriori bound first promises 1%, the enclosure does, and the truth is: for the mixed cube,
#    and for `0.95 * F`.
# 3. Make the doors of the chain of rooms half as wide. How does the brightest bounce move? (Diffusion would say: its number is
#    proportional to 1/width.)
# 4. The plates alternate. Compare $t_{n+2}$ with $t_n$, as `neumann.series` does there: what are $c_1$ and $c_2$?
# 5. With `scene("door-ajar")`: which bounce is the first that is lit where you look? Which of the traps above is it?
