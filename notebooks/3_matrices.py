# %% [markdown]
# # 3. R and T as matrices you can hold
#
# **What this teaches.** Cut a scene into patches, and $T$, $R$ and $K = R\,T$ are sparse matrices, ready for everything that
# linear algebra knows. You will look at them, make pictures by multiplying, find the shapes of light that a bounce only scales
# (eigenvectors), and solve $(I - K) L = L_e$ with far fewer bounces than light itself needs.

# %%
from lesson import explore, pictures, plots, radiance_unit, scene, seed
import matplotlib.pyplot as plt
import numpy as np
import scipy.sparse.linalg
import neumann

# %% [markdown]
# ## What they look like
# `matrices` traces $T$ once: 64 rays from each patch, cosine-distributed. Row $r$ of $T$ says which patch ray $r$ meets. Row $u$
# of $R$ averages over the rays of patch $u$ and multiplies by its reflectance. One channel of colour at a time: this is red.

# %%
room = scene("cornell-box", res=256)
small = room.matrices(patches=200, directions=16, channel="r", seed=seed, quiet=True)
T, R, Le = small
K = R @ T
figure, axes = plots(1, 3, gridspec_kw={"width_ratios": [1, 1.6, 2]})
axes[0].spy(T[:400], markersize=1, aspect="auto")
axes[0].set(title="T, 400 rows", xlabel="patch", ylabel="ray")
axes[1].spy(R, markersize=0.5, aspect="auto")
axes[1].set(title="R", xlabel="ray", ylabel="patch")
axes[2].spy(K, markersize=1)
axes[2].set(title="K = R T", xlabel="from patch", ylabel="to patch")
for axis in axes:
    axis.grid(False)
    axis.locator_params("x", nbins=3)
plt.show()

# %% [markdown]
# The figure: of $T$ the first 400 rows. It has at most one entry a row (none, where the ray leaves the room), $R$ is a staircase:
# each patch has its own rays and nobody else's. Their product is full of blocks: a block is what one surface (floor, wall, side of
# a box) sees of another one.
#
# **Q1.** What would a block on the diagonal of $K$ say about a surface? Which surfaces of the Cornell box could have one?

# %%
assert T.shape == R.shape[::-1] and T.shape[1] == Le.size
assert (T.data == 1).all() and (np.diff(T.indptr) <= 1).all()
assert (R.indices == np.arange(R.nnz)).all(), "the staircase: every ray belongs to one patch"
albedo = np.asarray(R.sum(axis=1)).ravel()
assert (np.asarray(K.sum(axis=1)).ravel() <= albedo + 1e-12).all(), "a patch cannot reflect more than all its rays bring"
for shape in np.unique(small.patches["shape"]):
    own = small.patches[small.patches["shape"] == shape]
    if not 0 < np.ptp(own["ny"]) < 0.01:  # but for the left wall, whose corners are not quite in one plane
        assert K[own["unknown"]][:, own["unknown"]].nnz == 0, "flat walls and convex boxes see nothing of themselves"
print(f"{K.nnz / np.prod(K.shape):.0%} of the entries of K are not 0, and none of them is in a block on the diagonal")

# %% [markdown]
# (A1: that the surface sees itself, like the inside of a ball. Here all are flat, or convex like the boxes.)
#
# ## Bounces by multiplying
# $K^i L_e$ is $i$ products of a sparse matrix with a vector. `picture` shows a vector as the camera sees it.

# %%
M = room.matrices(patches=1500, channel="r", seed=seed, quiet=True)
K = M.K
t, shown = M.b, [M.picture(M.Le, spp=4)]  # b is K Le, for which points on the lamp were asked
for i in range(1, 6):
    shown.append(M.picture(t, spp=4))
    t = K @ t
pictures(shown, [f"$K^{i} L_e$" for i in range(6)])
plt.show()

# %% [markdown]
# The figure: bounces 0 to 5 in red light. The patches are smaller where light changes quickly, at edges and in corners. Bounce 2 is
# blotchy: a patch gathers it by 64 rays, of which few meet what the lamp has made bright; later bounces come from the whole room
# alike.
#
# **How wrong are they?** scenes/cornell-box/README.md has the means of the bounces in red, from a path tracer that knows no
# patches: 0.053612, 0.0263715, 0.0127978, 0.0058946. Two errors mix: each patch has a single value (*discretisation*), and each
# entry of $K$ is an average over 64 rays (*sampling*).

# %%
known = np.array([0.053612, 0.0263715, 0.0127978, 0.00589461])
sizes, errors = [100, 400, 1600, 6400], []
for size in sizes:
    m = room.matrices(patches=size, channel="r", seed=seed, quiet=True)
    sees = np.asarray(m.camera(spp=4).mean(axis=0)).ravel()  # the mean of the picture, as a vector
    t, means = m.b, []  # K Le, for which points on the lamp were sampled: few of a patch's rays meet so small a lamp
    for i in range(4):
        means.append(sees @ t)
        t = m.R @ (m.T @ t)
    errors.append(np.array(means) / known - 1)
errors = np.array(errors)
figure, axes = plt.subplots()
axes.loglog(sizes, np.abs(errors), "o-", label=[f"bounce {i}" for i in range(1, 5)])
axes.set(xlabel="patches, about", ylabel="relative error of the picture's mean", title="Discretisation and sampling of K")
axes.legend()
plt.show()

# %%
print("patches   bounce 1   bounce 2   bounce 3   bounce 4")
for size, row in zip(sizes, errors):
    print(f"{size:7d}", *(f"{e:10.2%}" for e in row))
assert np.abs(errors[-1]).max() < np.abs(errors[0]).max()

# %% [markdown]
# The figure: more patches, smaller errors, down to where it is the rays' chance that decides.
#
# ## The shapes of light
# An eigenvector of $K$ is a distribution of light that a bounce scales and does not change: $K v = \lambda v$. Since no entry of
# $K$ is negative, the leading one can be chosen positive everywhere (Perron and Frobenius), so it is a possible light in the
# room; the others have dark sides and can only be differences of lights.

# %%
found = neumann.spectrum(K, 4, measure=M.measure, quiet=True)
values, vectors = found.eigenvalues, found.eigenvectors
print("eigenvalues:", values.round(4), " norms:", {name: round(size, 3) for name, size in found.norms.items()})
again = scipy.sparse.linalg.eigs(K, k=4, v0=np.ones(len(M.Le)), return_eigenvectors=False)
assert np.allclose(np.sort(np.abs(again)), np.sort(np.abs(values)), rtol=1e-6), "ARPACK, a second program, finds the same"
assert (
    np.isclose(found.spectral_radius, M.radius, rtol=1e-6)
    and found.spectral_radius <= found.norms["inf"] <= max(room.largest_albedo) + 1e-9
)
modes = [np.real(v / v[np.argmax(np.abs(v))]) for v in vectors.T]
assert modes[0].min() >= -1e-9, "the leading one has one sign"
figure, axes = plots(2, 2)
for axis, mode, value in zip(axes.flat, modes, values):
    image = axis.imshow(M.picture(mode, spp=4), cmap="RdBu", vmin=-1, vmax=1)
    axis.set_title(rf"$\lambda$ = {value.real:.3f}" + (f" + {value.imag:.3f}i" if abs(value.imag) > 1e-9 else ""))
    axis.axis("off")
figure.colorbar(image, ax=axes, label="over the largest value", shrink=0.6)
plt.show()

# %% [markdown]
# The figure: the leading eigenvectors as the camera sees them, blue positive and red negative. The first is the light that is left
# when all others have died: strongest deep between the tall box and the left wall, where surfaces are close and little escapes, weak
# at the open front and on the green wall, which is dark in red light. The others have both signs.
#
# **Q2.** What does bounce 50 of the Cornell box look like? And with the lamp on the floor?

# %%
t, angles, ratios = M.Le, [], []
weighted = np.sqrt(M.measure)
leading = modes[0] * weighted / np.linalg.norm(modes[0] * weighted)
for i in range(25):
    unit = t * weighted / np.linalg.norm(t * weighted)
    angles.append(np.sqrt(max(1 - (unit @ leading) ** 2, 0)))
    after = K @ t
    ratios.append((M.measure @ after) / (M.measure @ t))
    t = after
figure, axes = plots(1, 2)
axes[0].semilogy(angles, ".-", label="$K^n L_e$")
axes[0].semilogy(
    range(5, 25), angles[5] * np.abs(values[1] / values[0]) ** np.arange(20), "--", color="grey", label=r"$|\lambda_2 / \lambda_1|^n$"
)
axes[0].set(ylabel="sine of the angle to $v_1$")
axes[1].plot(ratios, ".-", label="$K^n L_e$")
axes[1].axhline(values[0].real, color="grey", ls="--", label=r"$\lambda_1$")
axes[1].set(ylabel="power of bounce $n + 1$ over $n$")
for axis in axes:
    axis.set_xlabel("bounce $n$")
    axis.legend()
plt.show()


# %%
def show(bounce):
    """A bounce beside the leading eigenvector."""
    t = M.Le
    for _ in range(bounce):
        t = K @ t
    pictures([M.picture(t, spp=4), M.picture(modes[0], spp=4)], [f"bounce {bounce}", "$v_1$"], unit=f"{radiance_unit}; $v_1$ has no unit")
    plt.show()


explore(show, bounce=(0, 24, 8))

# %%
assert abs(ratios[-1] / values[0].real - 1) < 1e-3 and angles[-1] < 0.05
print(f"ratio of bounce 25 to bounce 24: {ratios[-1]:.5f}; λ₁ = {values[0].real:.5f}")

# %% [markdown]
# The figures: bounces turn towards the leading eigenvector, whatever the lamp was like (A2: the same both times, but for
# brightness; bounce 8 looks like it already), and the ratio of their powers goes to $\lambda_1$. That is why the lines of lesson 2
# became straight. How fast they turn is a matter of $|\lambda_2/\lambda_1|$, and that is a delicate number: where surfaces meet in
# an edge, $K$ has a whole continuum of light going to and fro in the corner, so $\lambda_2$ belongs to the mesh as much as to the
# scene.
#
# ## Solvers against the plain series
# The cube of lesson 2, $16 \times 16$ patches a face, albedo 0.99, the ceiling shines. The plain series needs 682 bounces to be
# right to $10^{-3}$: $0.99^{n+1}$ falls slowly. But a solver may use the same products $K x$ more cleverly:
#
# - *one ratio for the tail*: stop early, and add the geometric series that the last two terms promise;
# - *Chebyshev*: the polynomial in $K$ that is smallest on the whole interval $[\lambda_\text{lowest}, \lambda_1]$, rather than
#   best at 0;
# - *GMRES*: the best of all combinations of the terms so far, in the sense of the smallest residual;
# - *conjugate gradients*: likewise, where $K$ is $\mathrm{diag}(\rho)$ times something symmetric, as light's is, by reciprocity.

# %%
cube = neumann.cube(16)
Le = (cube.face == 5).astype(float)
assert np.allclose(cube.F, cube.F.T, atol=1e-13), "equal patches: what goes from u to v goes from v to u"
spectrum = np.linalg.eigvalsh((cube.F + cube.F.T) / 2)
goals, names = (1e-3, 1e-6), ("neumann", "ratio-tail", "chebyshev", "gmres", "cg")
L = np.linalg.solve(np.eye(len(Le)) - 0.99 * cube.F, Le)


def applications(history, goal):
    """How often K was applied when the error was within the goal for the first time; nan if it never was."""
    reached = history["error"] <= goal
    return history["applications"][np.argmax(reached)] if reached.any() else np.nan


histories = {}
for name in names:
    result = neumann.solve(
        0.99 * cube.F,
        Le,
        name,
        error=1e-6,
        most=1500,
        radius=0.99 * spectrum[-1],
        lowest=0.99 * spectrum[0],
        reflectance=np.full(len(Le), 0.99),
        exact=L,
        measure=cube.area,
        quiet=True,
    )
    histories[name] = result.history[result.history["applications"] >= result.setup_applications]
counts = {name: [applications(h, goal) for goal in goals] for name, h in histories.items()}
figure, axes = plt.subplots()
for name, history in histories.items():
    axes.loglog(np.maximum(history["applications"], 1), history["error"], label=f"{neumann.SOLVERS[name]}: {counts[name][0]:.0f}")
axes.axhline(1e-3, color="grey")
axes.set(
    xlabel="applications of $K$",
    ylabel=r"$\Vert x - L\Vert _\infty / \Vert L\Vert _\infty$",
    title="Cube, albedo 0.99",
    ylim=(1e-15, 2),
)
axes.legend(title="applications until $10^{-3}$")
plt.show()

# %% [markdown]
# The figure: true errors of five solvers against how often they apply $K$, on logarithmic axes; the grey line is $10^{-3}$. The
# counts agree with those that independent programs of the same methods gave for this matrix, up to 2 or 10%: where a method
# starts counting, and how it rounds, differ.

# %%
elsewhere = {"neumann": (682, 1369), "ratio-tail": (12, 23), "chebyshev": (44, 85), "gmres": (8, 11), "cg": (8, 11)}
print("solver                            to 1e-3   to 1e-6")
for name in names:
    print(f"{neumann.SOLVERS[name]:32s}", *(f"{count:9.0f}" for count in counts[name]))
    for count, expected in zip(counts[name], elsewhere[name]):
        assert abs(count - expected) <= max(2, 0.1 * expected), f"{name}: {count}, elsewhere {expected}"

# %% [markdown]
# **Q3.** Why does Chebyshev need about $1/\sqrt{1-\rho}$ applications where the series needs $1/(1-\rho)$? Why does GMRES hardly
# notice albedo at all? (A3: a polynomial of degree $m$ that is 1 at 1 can be small on $[\lambda_\text{lowest}, \rho]$ once
# $m^2 (1-\rho)$ is large. GMRES sees that only *one* eigenvalue is near 1 and puts a zero of its polynomial there; the others are
# below 0.6.)
#
# So why does anyone render by bounces? Because a solver that needs fewer products needs *exact* ones: the extrapolations of
# lesson 2 amplify noise. And because the terms of the series are light, and the iterates of GMRES are not: they may be negative.
#
# ## Exercises
# 1. Repeat the table for albedo 0.9 and 0.999. Fit how each count grows with $1/(1-\rho)$.
# 2. Add relative noise of $10^{-3}$ to every product $K x$ (a function that multiplies and then perturbs; write the series and
#    the ratio tail yourself). Which of the two still reaches $10^{-3}$?
# 3. Plot `spectrum` above as a histogram. Which eigenvalues belong to edges and corners? Repeat for `cube(8)`: which of them
#    stay?
# 4. Compute $v_1$ for `channel="g"` and `channel="b"`. Why is $\lambda_1$ smaller in blue?
# 5. What is $\lambda_1$ of `scene("sphere-segment")`? Its README has it in closed form, from a 2 × 2 matrix.
