# %% [markdown]
# # 6. Importance: reading a picture from both ends
#
# **What this teaches.** A picture can be computed from the camera or from the lamp. Behind that is one line of algebra,
# $\langle W_e, K^i L_e \rangle = \langle K^{*i} W_e, L_e \rangle$: $K^*$, the *adjoint*, carries importance as $K$ carries light.
# You will check it, cut a path in the middle at every place, see what importance looks like, trace light, and use one solution to
# find the best place for a lamp. At the end the series runs backwards: the bounces are taken out of photographs.

# %%
from lesson import limit, pictures, scene, scenes, seed
import matplotlib.pyplot as plt
import numpy as np
import scipy.sparse
import neumann

# %% [markdown]
# ## The adjoint
# Two fields have the inner product
#
# $$\langle f, g \rangle = \iint f(p, \omega)\, g(p, \omega)\, |\cos\theta|\, d\omega\, dA,
# \qquad \text{on patches } \sum_u m_u f_u g_u,$$
#
# with $m_u$ the patch's area times its projected solid angle (π on a diffuse patch). The adjoint $K^*$ is what moves $K$ to the
# other side: $\langle K f, g \rangle = \langle f, K^* g \rangle$ for all $f$, $g$. For a matrix that is
# $K^* = M^{-1} K^{\mathsf T} M$ with $M = \mathrm{diag}(m)$.

# %%
room = scene("cornell-box", res=256)
patches = room.matrices(patches=1500, directions=1024, channel="g", seed=seed, quiet=True)
K, Le, m = patches.K, patches.Le, patches.measure
M, inverse = scipy.sparse.diags(m), scipy.sparse.diags(1 / m)
adjoint = (inverse @ K.T @ M).tocsr()

rng = np.random.default_rng(seed)
f, g = rng.random(Le.size), rng.random(Le.size)
inner = lambda a, b: np.sum(m * a * b)
print(f"⟨K f, g⟩ = {inner(K @ f, g):.12g}, ⟨f, K* g⟩ = {inner(f, adjoint @ g):.12g}")
assert abs(inner(K @ f, g) / inner(f, adjoint @ g) - 1) < 1e-12

# %% [markdown]
# ## What the camera measures
# A pixel, or the mean of a picture, is linear in the light, so it is an inner product, too: $\langle W_e, L \rangle$. $W_e$ is
# the *importance that the camera gives off*: by how much the mean grows for each bit of light that leaves a patch towards the
# camera.
#
# Then the mean of the picture of bounce $i$ is $\langle W_e, K^i L_e \rangle$, and by moving one $K$ after the other to the left
#
# $$\langle W_e, K^i L_e \rangle = \langle K^* W_e, K^{i-1} L_e \rangle = \dots = \langle K^{*i} W_e, L_e \rangle .$$

# %%
camera = patches.camera(spp=16, seed=seed)  # a row a pixel
We = np.asarray(camera.mean(axis=0)).ravel() / m  # ⟨We, f⟩ is the mean of the picture of f
light, importance = [Le], [We]
for i in range(6):
    light.append(K @ light[-1])
    importance.append(adjoint @ importance[-1])
print("bounce" + "".join(f"   {s} K* on We" for s in range(7)))
for i in range(7):
    cuts = [inner(importance[s], light[i - s]) for s in range(i + 1)]
    print(f"{i:6d}" + "".join(f"{cut:13.9f}" for cut in cuts))
    assert np.ptp(cuts) <= 1e-12 * cuts[0], "wherever the path is cut"
    assert np.isclose(cuts[0], (camera @ light[i]).mean(), rtol=1e-9), "the mean of its picture"

# %% [markdown]
# The table: each row is one bounce, and each entry cuts its paths at another place: $s$ bounces of importance from the camera,
# $i - s$ bounces of light from the lamp. They are the same number.
#
# **Q1.** The first column is what a path tracer's pixels add up to, and the last entry of each row is light tracing. Which entry
# is bidirectional path tracing? (A1: all of them at once, each path weighted so that the ways share it.)
#
# **Q2.** $K = R\,T$, so $K^* = T^* R^*$: which of the two acts first on importance? Since materials are reciprocal, $R^* = R$.
# What is $T^*$ in words? (A2: $R^*$: importance arrives at a surface, is scattered there exactly as light would be, and only then
# is carried on. $T^*$ carries it along the same straight lines, backwards, which is what $T$ does: $T^* = T$.)
#
# ## What importance looks like
# `render(method="patches", importance=True)` shows the bounces of importance instead of light. Think of the camera as a flash.

# %%
shown = room.render(method="patches", importance=True, bounces=4, spp=4, patches=1500, seed=seed, quiet=True)
pictures(shown.terms, [f"$K^{{*{i}}} W_e$" if i else "$W_e$" for i in range(5)], unit="m$^{-2}$·sr$^{-1}$")
plt.show()

# %% [markdown]
# The figure: importance on the surfaces, after 0 to 4 bounces: where it is bright, a glow would add most to the picture of that
# bounce. $W_e$ is bright where a patch covers much of the picture for its size: near surfaces before far ones, and those that are
# seen face on, such as the fronts of the boxes. From one bounce on it reaches what the camera does not see, too (which a picture
# by this camera cannot show). After a few it is even, as light is: it has forgotten the camera. And it has colours: a red glow on
# the right wall is worth more than a green one, because the red wall opposite passes it on.

# %%
assert shown.run.quantity.unit == "m^-2 sr^-1"
red, green = shown.terms[1][..., 0], shown.terms[1][..., 1]
left, right = (slice(80, 176), slice(8, 24)), (slice(80, 176), slice(232, 248))  # of the red and the green wall
on_left, on_right = (red[wall].mean() / green[wall].mean() for wall in (left, right))
print(f"importance in red over that in green, bounce 1: {on_left:.2f} on the red wall, {on_right:.2f} on the green one")
assert on_left < 1 < on_right, "a glow on the red wall is passed on by others, of which the green one swallows red"

# %% [markdown]
# ## Where to put a lamp
# Light needs a solution for each lamp. Importance needs one for each camera, and then answers for *every* lamp: with
# $W = (I - K^*)^{-1} W_e = W_e + K^* W_e + \dots$ the mean of the whole picture is
#
# $$\langle W_e, L \rangle = \langle W_e, (I - K)^{-1} L_e \rangle = \langle W, L_e \rangle .$$

# %%
identity = np.eye(Le.size)
W = np.linalg.solve(identity - adjoint.toarray(), We)
direct = np.linalg.solve(identity - K.toarray(), Le)
assert np.isclose(inner(W, Le), inner(We, direct), rtol=1e-9)

ceiling = np.abs(patches.patches["ny"] + 1) < 1e-6  # normals down
table = patches.patches[ceiling & (patches.patches["y"] > 540)]
u = table["unknown"]
unseen = W[u] - We[u]  # light that the camera would see directly does not count
figure, axes = plt.subplots()
dots = axes.scatter(table["x"], table["z"], c=unseen * 1e6 * np.pi, s=np.maximum(table["area"] / 25, 6), marker="s")
axes.plot([213, 343, 343, 213, 213], [227, 227, 332, 332, 227], "k--")
axes.set(
    xlabel="x, mm",
    ylabel="z, mm (the camera is at $z = -800$)",
    title="What a lamp here brings to the picture, beside itself",
    aspect="equal",
)
figure.colorbar(dots, label=r"$10^6\,\pi\,(W - W_e)$, mm$^{-2}$")
plt.show()

# %% [markdown]
# The figure: the ceiling from below. Each patch has the colour of what a lamp there, of radiance 1, would add to the picture's
# mean, for each square millimetre, not counting that one sees the lamp itself. Dashed: where it really is.
#
# **Q3.** Would you move it? To where, and why there? Check the map with a direct computation for its brightest patch:

# %%
best = u[np.argmax(unseen)]
lamp = np.zeros(Le.size)
lamp[best] = 1.0
lit = np.linalg.solve(identity - K.toarray(), lamp)
print(
    f"best place on the ceiling: x = {table['x'][np.argmax(unseen)]:.0f}, z = {table['z'][np.argmax(unseen)]:.0f}; "
    f"mean of the picture with a lamp there {inner(We, lit):.6e}, by importance {W[best] * m[best]:.6e}"
)
assert np.isclose(inner(We, lit), W[best] * m[best], rtol=1e-9)
assert table["z"][np.argmax(unseen)] > 500, "at the back wall, which fills the picture (which patch there is chance: 1024 rays each)"

# %% [markdown]
# ## Light tracing
# `method="light"` walks the adjoint: it starts at the lamp, chooses directions, and at every point asks whether the camera sees
# it. Its bounces are those of `walk`, with noise of another kind.

# %%
walk = room.render(bounces=3, spp=16, method="walk", sampler="independent", seed=seed, quiet=True)
traced = room.render(bounces=3, spp=16, sampler="independent", method="light", seed=seed + 1, quiet=True)
both = room.render(bounces=3, spp=4, sampler="independent", method="bidirectional", ways=2, seed=seed + 2, quiet=True)
white = 2 * np.percentile(walk.terms[2], 90)
pictures(
    [walk.terms[2], traced.terms[2], both.terms[2]],
    ["camera, 16 samples", "lamp, 16 samples", "both ends, 4 samples"],
    white=white,
)
plt.show()

# %%
# Paths from the lamp are shared by all pixels, so their errors go together, and means are judged by whole pictures: few pixels,
# and 64 groups of samples.
coarse = scene("cornell-box", res=8)
means = {
    name: coarse.render(bounces=3, spp=2048, sampler="independent", method=name, seed=seed + k, quiet=True).run.bounces
    for k, name in enumerate(("walk", "light", "bidirectional"))
}
for i in (1, 2, 3):
    for name in ("light", "bidirectional"):
        a, b = means["walk"][i], means[name][i]
        error = np.hypot(a.stderr, b.stderr)
        assert error < 0.02 * a.mean
        print(f"bounce {i}: walk {a.mean:.6f}, {name} {b.mean:.6f}, {(b.mean - a.mean) / error:+.1f} standard errors")
        assert (
            abs(a.mean - b.mean) <= limit(min(a.degrees_of_freedom, b.degrees_of_freedom)) * error
        )  # six comparisons: 1 in 25 000

# %% [markdown]
# The figure: bounce 2 three times, at one exposure. From the camera each pixel has noise of its own, more where the light is
# found by chance. From the lamp the noise follows the *light*: many paths where it is bright, few in the dark corners, where
# single paths count for much.
#
# ## Every way to make bounce 2
# A path of bounce 2 has four vertices: lamp, surface, surface, lens. `ways=2` shows what each way $(s, t)$ makes of it: $s$
# vertices walked from the lamp, $t$ from the camera, $s + t = 4$.

# %%
ways = both.ways
pictures(
    [w.unweighted for w in ways] + [w.weighted for w in ways],
    [f"({w.s}, {w.t}) by itself" for w in ways] + ["with its weight"] * len(ways),
    white=white,
    columns=len(ways),
)
plt.show()
assert np.allclose(
    sum(w.weighted for w in ways), both.terms[2], rtol=1e-4, atol=1e-6 * both.terms[2].max()
), "the weighted ways are the picture"

# %% [markdown]
# The figure: above, each way alone, which is an estimate of the same picture, but for what it cannot make; below, what the
# weights leave of it. Each way is given the paths that it is good at.
#
# **Q4.** One way looks as if its picture were empty or a few dots. Which, and why can it not be better? (A4: a way with $s = 0$
# has to hit the lamp by chance.)
#
# ## What light tracing cannot see
# A point in a mirror sends light in one direction only, and it is never that of the camera. `facing-mirrors` loses all images
# that way. The program says so:

# %%
mirrors = scene("facing-mirrors", res=256)
seen, lost = (mirrors.render(bounces=2, spp=16, method=method, seed=seed, quiet=True) for method in ("walk", "light"))
pictures(
    [seen.terms[1], lost.terms[1], seen.terms[2], lost.terms[2]],
    ["bounce 1, walk", "bounce 1, light", "bounce 2, walk", "bounce 2, light"],
    white=1.5,
)
plt.show()
print("light:", lost.run.paths)
assert lost.run.paths != "all" and seen.run.paths == "all"
floor = slice(200, 240), slice(60, 200)
noise = [np.mean(np.square(s.terms_spread[2][floor], dtype=float)) for s in (seen, lost)]
print(f"variance of bounce 2 on the floor: {noise[0] / noise[1]:.0f} times as large by the walk")
assert noise[0] > 2 * noise[1]
assert np.all(lost.terms[1].mean(axis=(0, 1)) < seen.terms[1].mean(axis=(0, 1)))

# %% [markdown]
# The figure: what the mirrors throw on the floor in bounce 2 has far less noise by light tracing than by the walk, which has to
# hit the lamp by way of a mirror by chance; and of what one sees *in* the mirrors it has nothing. Walks from the camera are good at
# just the other half.

# %% [markdown]
# ## The series backwards
# So far we knew the scene, and computed $L_e + K L_e + K^2 L_e + \dots$ Somebody who has only *photographs* can take the same terms out
# of them. Put a projector in the place of the camera, cut its picture into blocks, and take a picture $T_j$ under each block alone.
# What block $j$ shines on is *region* $j$ of what is seen. The means of the regions are the columns of a matrix $T$; the direct light
# alone, $T^1$, is diagonal. All other light has left some region before: $T = T^1 + A\,T$, where $A$ takes the light from all
# regions to all regions once more. So
#
# $$T = (I - A)^{-1}\, T^1 \qquad\Longrightarrow\qquad C^1 = T^1\, T^{-1} = I - A \quad\text{and}\quad C^n = A^{n-1}\, C^1 .$$
#
# $C^n$ leaves of *any* picture of this scene what has bounced $n$ times (Seitz, Matsushita and Kutulakos, 2005). Nobody has to say
# what stands in the scene. And $T^1$ comes out of $T$ itself: no light goes from a region to itself, so $A_{rr} = 0$, and
# $T^{-1} = (T^1)^{-1} (I - A)$ has $1 / T^1_{rr}$ on its diagonal.

# %%
corner = neumann.load(scenes.parent / "notebooks" / "corner.xml", res=64)
lit = corner.under_lights((8, 8), spp=32, bounces=4, seed=seed, quiet=True)
flooded = lit.pictures.sum(axis=0)
found = lit.unbounce(quiet=True)
bright = np.percentile(flooded, 99)
block = 36  # in the fifth row
pictures(
    [flooded, lit.pictures[block], 20 * (lit.pictures[block] - lit.direct[block])],
    ["all 64 blocks", f"block {block} alone", "20 × its bounces 2, 3, …"],
    white=bright,
)
plt.show()

# %% [markdown]
# The figure: a corner of three sheets of paper, lit from where the camera is. In the middle one block is on, and what it hits lights
# all the rest of the corner; on the right that rest alone, made visible by a factor.
#
# Now the Neumann series and its inverse on one page: above, $C^n L$, taken out of the 64 pictures; below, $K^n L_e$, computed from the
# scene, with other random numbers.

# %%
gains = [1, 2, 8, 32]
pictures(
    [g * t for g, t in zip(gains, found.terms)] + [g * t for g, t in zip(gains, lit.forward)],
    [f"{g} × $C^{n} L$" for n, g in enumerate(gains, 1)] + [f"{g} × $K^{n} L_e$" for n, g in enumerate(gains, 1)],
    white=bright,
    columns=len(gains),
)
plt.show()
print("bounce   backward ± noise    regions   forward ± noise")
for b in found.bounces:
    back, forth = b.backward, b.forward
    print(
        f"{b.bounce:6d} {back.mean:9.5f} ± {back.stderr:.5f} {back.discretisation:9.5f} {forth.mean:9.5f} ± {forth.stderr:.5f}"
        f"   {abs(b.difference.in_errors):.1f} errors apart"
    )
    assert abs(b.difference.in_errors) < 4.5
assert not [d for d in found.doubts if d.kind in ("gain", "singular", "foreign light")], str(found)

# %% [markdown]
# The table: what the backward terms are off is more than noise. 8 × 8 regions are large, and one that lies across an edge of the
# corner *does* light itself. The column "regions" estimates that from 4 × 4 regions.
#
# The algebra is three lines. And the inverse has a Neumann series of its own (Bai and others, 2010): with $F$ the diagonal of $T$ and
# $T = (I + R) F$
#
# $$(I - A)^{-1} = I + A + A^2 + \dots \qquad\text{and}\qquad (I + R)^{-1} = I - R + R^2 - \dots$$

# %%
T = found.T[1]  # green
inverse = np.linalg.inv(T)
T1 = np.diag(1 / np.diag(inverse))
C1 = T1 @ inverse
identity = np.eye(len(T))
A = identity - C1
assert np.allclose(A, found.A[1], atol=1e-9 * np.abs(A).max()) and np.allclose(C1 @ T.sum(axis=1), np.diag(T1))

R = T / np.diag(T) - identity
forward_radius, backward_radius = (np.abs(np.linalg.eigvals(M)).max() for M in (A, R))
figure, axes = plt.subplots()
for name, M, exact, color in (
    (r"$I + A + A^2 + \dots$", A, np.linalg.inv(identity - A), "C0"),
    (r"$I - R + R^2 - \dots$", -R, np.linalg.inv(identity + R), "C3"),
):
    power, total, errors = identity, 0.0, []
    for k in range(12):
        total = total + power
        power = power @ M
        errors.append((total - exact).sum() / exact.sum())
    errors = np.array(errors)
    axes.semilogy(np.abs(errors), color=color, alpha=0.4)
    for above in (True, False):
        where = np.flatnonzero((errors > 0) == above)
        if where.size:
            label = f"{name}, {'too much' if above else 'too little'}"
            axes.semilogy(where, np.abs(errors[where]), "^" if above else "v", color=color, label=label)
axes.set(xlabel="last power", ylabel="relative error of the sum", title="Forward and backward, term by term")
axes.legend()
plt.show()
print(f"spectral radius of A {forward_radius:.3f}, of R {backward_radius:.3f}; λ/(1 − λ) = {forward_radius / (1 - forward_radius):.3f}")
assert forward_radius < backward_radius < 1 and abs(found.channels[1].inverse_series_radius / backward_radius - 1) < 1e-3

# %% [markdown]
# The figure: both fall like powers. Forward, the sum comes from below: each term adds light. Backward, each term takes away one bounce
# too much or gives it back, so the sums jump from above to below. And it is slower: where $A$ has the eigenvalue $\lambda$, $R$ has about
# $\lambda / (1 - \lambda)$, which is 1 for $\lambda = 1/2$.
#
# **Q5.** In a white room with $\lambda = 0.8$, the forward series converges. Bai's diverges. Is the inverse lost? (A5: no. $T$ can
# still be inverted, by elimination; it is only this series for it that fails.)
#
# **Q6.** What would $C^1$ take for direct light if one sheet were a mirror, or if light reached the camera by way of a wall that it does
# not see? (A6: a region in a mirror is bright under another region's block, and $T$ is no longer of the form above: `found.doubts` says
# so. What is not seen is in no region: light that goes by way of it counts as one bounce where the forward series counts two. Of a scene
# `found.bounces[1].by_way_of_unseen` tells how much that is. Try `corner.xml` with `left="mirror"`, with `fov=15`, and the Cornell box.)
#
# ## Exercises
# 1. Put the camera's importance on *one pixel* (a row of `patches.camera()`), and show $K^{*i} W_e$ as pictures. Where would you
#    put white paint for that pixel?
# 2. `inner(importance[s], light[i - s])` costs $i$ products of $K$ or $K^*$ for one bounce. How many products give bounces 0 to
#    12, if both lists are as long as six?
# 3. Compute the mean of the picture with lamps of radiance 1 on *all* of the floor, without solving again.
# 4. Which eigenvalues does $K^*$ have? And which eigenvectors? (`neumann.spectrum(K, 2, measure=m, adjoint=True)`)
# 5. Glass makes radiance $n^2$ times as large within it. Show with $\langle f, g \rangle$ why fields on patches are then
#    $L / n^2$, the *basic radiance* (operators/NOTATION.md).
