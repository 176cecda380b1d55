# %% [markdown]
# # 7. When numbers break
#
# **What this teaches.** A renderer computes with numbers of 24 or 53 bits, and stops some time. You will see where that shows:
# sums that stand still, squares that vanish, rays that hit the surface they leave (and where each remedy fails), paths that forget
# where they were, rooms whose light dies at two speeds at once; and how to read a health report, which tells a picture that is noisy
# from one that is sick.

# %%
from lesson import pictures, plots, scene, scenes, seed
import tempfile
import warnings
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import neumann

# %% [markdown]
# ## Sums that stand still
# A furnace of albedo $\rho$: $S_n = 1 + \rho + \dots + \rho^n \to 1/(1-\rho)$. Add it up in `float`, one bounce after the other,
# until nothing changes any more. That looks like convergence.


# %%
def add_up(rho, count):
    """ρ^0 + … + ρ^count in float: all partial sums, the sum with compensation (Kahan), and the exact one for the ρ that it holds."""
    rho = np.float32(rho)
    terms = np.cumprod(np.concatenate([[np.float32(1)], np.full(count, rho, dtype=np.float32)]), dtype=np.float32)
    naive = np.cumsum(terms, dtype=np.float32)  # from left to right
    total, lost = np.float32(0), np.float32(0)
    for t in terms:
        y = t - lost
        after = total + y
        lost = (after - total) - y
        total = after
    exact = -np.expm1((count + 1) * np.log(float(rho))) / (1 - float(rho))
    return naive, total, exact


figure, axes = plt.subplots()
known = {
    0.9: (219, -4.290678287496755e-07, 138),
    0.99: (2521, -2.0980725878707618e-06, 1241),
    0.999: (27618, -2.0809070430973913e-05, 10392),
}
print("albedo   stands still at   error then   with compensation   by rounding the albedo")
for rho, (count, error, still) in known.items():
    naive, kahan, exact = add_up(rho, count)
    partial = (1 - np.float64(np.float32(rho)) ** np.arange(1, count + 2)) / (1 - np.float64(np.float32(rho)))
    axes.loglog(np.arange(1, count + 2), np.maximum(np.abs(naive / partial - 1), 1e-9), label=rf"$\rho$ = {rho}")
    stands = int(np.flatnonzero(np.diff(naive) == 0)[0])
    off = (1 - rho) / (1 - float(np.float32(rho))) - 1
    print(f"{rho:6} {stands:17d} {naive[-1] / exact - 1:12.1e} {kahan / exact - 1:19.1e} {off:24.1e}")
    assert stands == still and abs((float(naive[-1]) / exact - 1) / error - 1) < 1e-4, "as another program has it"
    u = 2.0**-24
    assert abs(float(kahan) / exact - 1) <= u * (2 + rho / (1 - rho)), "two roundings, and those of the terms"
axes.set(xlabel="bounces", ylabel="relative error of the sum in float", title="One after the other, in float")
axes.legend()
plt.show()

# %% [markdown]
# The figure: the relative error of what a float has added up so far. It grows with the number of terms, and leaps up at the end,
# when the sum stands still and the truth goes on: at $\rho = 0.999$ two of seven digits are gone.
#
# **Q1.** Why does the sum stand still at all, although the terms are not 0? **Q2.** Compensation repairs the sum, but look at the
# last column. What does no summation repair? (A2: that 0.999 is no float. Near 1 the sum depends on $1 - \rho$, of which a float
# has few digits: `0.999` in the file and `0.999` in memory are different rooms.)
#
# `neumann` adds in double, or compensated; its pictures are floats only when they are finished.
#
# ## Squares that vanish
# An error bar needs squares. In float, $(10^{-30})^2 = 0$ and $(10^{30})^2 = \infty$: starlight has no noise, and a welding arc
# has nothing else. But brightness is a choice of units: a scene that shines $2^{k}$ times as much has to have the same picture
# times $2^k$, *in every bit*.

# %%
with np.errstate(over="ignore", under="ignore"):
    print("squares in float:", np.square(np.float32([1e-30, 1e30])))
text = (scenes / "furnace" / "furnace.xml").read_text()
shines = '<rgb name="radiance" value="1"/>'
assert text.count(shines) == 1
with tempfile.TemporaryDirectory() as folder:
    rendered = {}
    for k in (-100, 0, 100):
        path = Path(folder) / f"furnace_{k}.xml"
        path.write_text(text.replace(shines, f'<rgb name="radiance" value="{2.0**k!r}"/>'))
        rendered[k] = neumann.load(path, res=16).render(
            bounces=3, spp=64, direct="hemisphere", sampler="independent", seed=seed, quiet=True
        )
for k in (-100, 100):
    factor = np.float64(2.0**k)
    for name in ("terms", "terms_stderr", "sums", "sums_stderr"):
        assert np.array_equal(getattr(rendered[k], name), getattr(rendered[0], name) * factor), f"{name} at 2^{k}"
for k, series in rendered.items():
    print(f"mean of bounce 3 at 2^{k}: {series.run.bounces[3].mean:.6g} ± {series.run.bounces[3].stderr:.1g}")

# %% [markdown]
# ## Rays that hit what they leave
# A hit point is rounded, so it lies a little inside or outside of the surface. From inside, the next ray hits the surface at
# once: a black speck, or a bounce too many. The usual cure is to ignore hits nearer than some $\varepsilon$, say $10^{-4}$. Try
# it on a ball of radius $r$ that is lit from all around. The ball is convex: no ray that leaves it may hit it again.

# %%
rng = np.random.default_rng(seed)


def again(radius, epsilon, count=20_000):
    """Which share of the rays that leave a ball hit it again, farther away than epsilon: in float."""
    f = np.float32
    unit = rng.normal(size=(2, count, 3))
    unit /= np.linalg.norm(unit, axis=2, keepdims=True)
    normal, toward = unit[0], unit[1]
    origin = (normal * 1.5 * radius + np.cross(normal, toward) * 0.5 * radius).astype(f)  # of a ray onto the ball
    along = (-normal).astype(f)
    b = (origin * along).sum(axis=1, dtype=f)
    c = (origin * origin).sum(axis=1, dtype=f) - f(radius) * f(radius)
    hit = origin + (-b - np.sqrt(np.maximum(b * b - c, 0)))[:, None] * along
    outward = hit / np.linalg.norm(hit, axis=1, keepdims=True)
    away = toward + outward * (1.0 + 1e-3)  # cosine-distributed around the normal
    away = (away / np.linalg.norm(away, axis=1, keepdims=True)).astype(f)
    b = (hit * away).sum(axis=1, dtype=f)
    c = (hit * hit).sum(axis=1, dtype=f) - f(radius) * f(radius)
    root = b * b - c
    far = -b + np.sqrt(np.maximum(root, 0))
    return np.mean((root > 0) & (far > f(epsilon)))


radii = 10.0 ** np.arange(-6, 7)
rules = {
    "no offset": lambda r: 0.0,
    r"$\varepsilon = 10^{-4}$": lambda r: 1e-4,
    r"$\varepsilon = 32 \cdot 2^{-24}\, r$": lambda r: 32 * 2.0**-24 * r,
}
figure, axes = plt.subplots()
shares = {name: np.array([again(r, rule(r)) for r in radii]) for name, rule in rules.items()}
for name, share in shares.items():
    axes.semilogx(radii, 100 * share, "o-", label=name)
axes.set(xlabel="radius of the ball, scene units", ylabel="rays that hit it again, %", title="A convex ball, in float: the truth is 0")
axes.legend()
plt.show()

# %% [markdown]
# The figure: self-hits against the size of the scene. Without an offset a quarter to a half of all rays hit again, at any size:
# those whose starting points were rounded to the inside; the constant $\varepsilon$ helps only where it happens to be larger than
# the rounding, and in a ball of radius $10^{-6}$ it is a hundred times the ball, so that real walls closer than that would be
# invisible, too. What has to set the offset is the rounding of *this* hit.

# %%
assert shares["no offset"].max() > 0.01 and shares[r"$\varepsilon = 10^{-4}$"][-1] > 0.01
assert shares[r"$\varepsilon = 32 \cdot 2^{-24}\, r$"].max() < 0.2 * shares["no offset"].max()
ball = """<scene version="3.0.0">
    <integrator type="path"/>
    <sensor type="perspective"><float name="fov" value="30"/>
        <transform name="to_world"><lookat origin="0, {far}, 0" target="0, 0, 0" up="0, 0, 1"/></transform>
        <float name="near_clip" value="{near}"/><float name="far_clip" value="{beyond}"/>
        <film type="hdrfilm"><integer name="width" value="32"/><integer name="height" value="32"/><rfilter type="box"/></film>
    </sensor>
    <shape type="sphere"><float name="radius" value="{size}"/>
        <bsdf type="diffuse"><rgb name="reflectance" value="0.5"/></bsdf></shape>
    <emitter type="constant"><rgb name="radiance" value="1"/></emitter>
</scene>"""
with tempfile.TemporaryDirectory() as folder:
    for size in (1e-6, 1.0, 1e6):
        path = Path(folder) / "ball.xml"
        path.write_text(ball.format(size=size, far=5 * size, near=0.1 * size, beyond=100 * size))
        # plan="full": otherwise it is proven that the ball is convex, and bounce 2 is not even tried
        series = neumann.load(path).render(bounces=3, spp=32, plan="full", direct="bsdf", seed=seed, quiet=True)
        hits = series.run.health.self_hits
        print(
            f"radius {size:g}: bounce 1 up to {series.terms[1].max()}, bounce 2 up to {series.terms[2].max()}, "
            f"{hits.count} self-hits in {hits.rays} rays"
        )
        assert series.terms[2].max() == 0 and series.terms[3].max() == 0 and hits.count == 0, "a convex body has no second bounce"
        assert abs(series.terms[1].max() - 0.5) < 1e-6

# %% [markdown]
# ### Noisy shadows: four remedies, and where each fails
# CS184 has a circle, $C = (1930.420, 1973.505)$, $R = 1$, that a ray from the origin towards $C$ hits at
# $C - C / |C| = (1929.7207, 1972.7901)$ (the slide says 1929.7203, 1972.7897, which is 0.0006 off the circle, as the rounding of its centre to
# three digits allows). In float the slide's program found $(1930.4196, 1973.5054)$: the centre. The reason is the discriminant:

# %%
C, R = np.array([1930.420, 1973.505], dtype=np.float32), np.float32(1)
angles = np.arctan2(C[1], C[0]) + np.linspace(-3.4e-4, 3.4e-4, 9)
print("miss by   b² − c   in double   R² − |C − b d|²")
for angle in angles:
    d = np.array([np.cos(angle), np.sin(angle)]).astype(np.float32)
    found = []
    for real in (np.float32, np.float64):
        c_, d_ = C.astype(real), d.astype(real)
        b = (c_ * d_).sum(dtype=real) / (d_ * d_).sum(dtype=real)
        across = c_ - b * d_
        found.append(((b * b - ((c_ * c_).sum(dtype=real) - real(R))), real(R) - (across * across).sum(dtype=real)))
    print(f"{np.sqrt(max(1 - found[1][1], 0)):7.3f} {found[0][0]:8.2f} {found[1][1]:11.4f} {found[0][1]:17.4f}")
    assert found[0][0] % 0.5 == 0 and abs(found[0][1] - found[1][1]) < 2e-3

# %% [markdown]
# $b^2$ and $|C|^2$ are 7.6 million, where floats are 0.5 apart: so the discriminant, which is between 0 and 1, can only be a multiple of 0.5,
# and two roundings make it 2 or −0.5 as well. Where it comes out as 0 the hit is the foot of the perpendicular from the centre, as on the
# slide. The last column computes the same number from how far the ray passes the centre, and has three digits (Haines and others 2019).
#
# What is left is the rounding of the hit point. CS184 names four remedies: compute in **double**; **ignore** the object that was hit last;
# ignore hits nearer than an **offset** (here $10^{-4}$); **project** the hit point onto the surface before going on. Here is a ray tracer
# for balls and floors, in any kind of number, whose shadow rays follow one of these rules, and four scenes: a ball that is as far from the
# origin as CS184's circle; a bowl, which is half a ball and throws a shadow into itself; a ball of radius $10^{-5}$; and a floor that is
# there twice.


# %%
def roots(o, d, shape):
    """Where rays meet a shape, (2, n), inf where they do not."""
    if shape["kind"] == "floor":
        t = np.divide(shape["at"][1] - o[:, 1], d[:, 1], where=d[:, 1] != 0, out=np.full(len(d), np.inf, dtype=d.dtype))
        far = np.abs(o + np.where(np.isfinite(t), t, 0)[:, None] * d - shape["at"])[:, ::2].max(axis=1) > shape["size"]
        return np.array([np.where(far, np.inf, t), np.full_like(t, np.inf)])
    f = o - shape["at"]
    b, c = (f * d).sum(axis=1, dtype=d.dtype), (f * f).sum(axis=1, dtype=d.dtype) - shape["size"] ** 2
    root = np.sqrt(np.maximum(b * b - c, 0))
    t = np.array([-b - root, -b + root])
    above = f[:, 1] + t * d[:, 1] > shape["top"] * shape["size"]
    return np.where((b * b > c) & ~above, t, np.inf)


def nearest(o, d, shapes, least, ignored=None):
    """The first hit of each ray farther away than least, and its shape. ignored: for each ray a shape that it does not see."""
    found = np.array([np.where(t > least, t, np.inf).min(axis=0) for t in (roots(o, d, shape) for shape in shapes)])
    if ignored is not None:
        found[ignored, np.arange(len(o))] = np.inf
    return found.min(axis=0), found.argmin(axis=0)


def shadows(real, shift, size, shapes, rule="", least=0.0, n=120):
    """A picture: the cosine at the lamp where nothing is in between, 0 in shadows, nan where the camera sees nothing."""
    shift, size = np.array(shift, dtype=np.float32).astype(real), real(np.float32(size))
    shapes = [{"top": 2, **shape, "at": shift + size * np.array(shape["at"], dtype=real), "size": size * real(shape["size"])} for shape in shapes]
    v, u = np.mgrid[0.45 : -0.45 : n * 1j, -0.45 : 0.45 : n * 1j]
    d = np.stack([u.ravel(), v.ravel() - 0.55, np.full(n * n, -1.0)], axis=1).astype(np.float32).astype(real)
    d /= np.sqrt((d * d).sum(axis=1, dtype=real))[:, None]
    o = np.broadcast_to(shift + size * np.array([0, 3.2, 4.2], dtype=real), d.shape)
    t, which = nearest(o, d, shapes, real(0))
    seen, picture = np.isfinite(t), np.full(n * n, np.nan)
    o, d, t, which = o[seen], d[seen], t[seen], which[seen]
    p = o + t[:, None] * d
    at, radius = np.array([s["at"] for s in shapes])[which], np.array([s["size"] for s in shapes])[which][:, None]
    ball = np.array([s["kind"] == "ball" for s in shapes])[which][:, None]
    normal = np.where(ball, (p - at) / np.sqrt(((p - at) ** 2).sum(axis=1, dtype=real))[:, None], np.array([0, 1, 0], dtype=real))
    normal *= -np.sign((normal * d).sum(axis=1, dtype=real))[:, None]
    if rule in ("project", "and offset"):
        outward = (p - at) / np.sqrt(((p - at) ** 2).sum(axis=1, dtype=real))[:, None]
        p = np.where(ball, at + radius * outward, np.where([False, True, False], at, p))
    if rule == "and offset":  # a bound on how far p is off: a few roundings of its largest coordinate
        p = p + 8 * np.finfo(real).eps * np.abs(p).max(axis=1)[:, None] * normal
    toward = shift + size * np.array([2.2, 3.0, 1.5], dtype=real) - p
    toward /= np.sqrt((toward * toward).sum(axis=1, dtype=real))[:, None]
    blocked = np.isfinite(nearest(p, toward, shapes, real(least), which if rule == "ignore" else None)[0])
    picture[seen] = np.where(blocked, 0, np.maximum((normal * toward).sum(axis=1), 0))
    return picture.reshape(n, n)


floor, round_ = {"kind": "floor", "at": (0, 0, 0), "size": 4}, {"kind": "ball", "at": (0, 1, 0), "size": 1}
four = {
    "far away": ((1930.420, 1973.505, 0), 1, [round_, floor]),
    "a bowl": ((0, 0, 0), 1, [{**round_, "top": 0}, floor]),
    "small": ((0, 0, 0), 1e-5, [round_, floor]),
    "two floors": ((0, 0, 0), 1, [round_, floor, floor]),
}
remedies = {
    "none": (np.float32, {}),
    "double": (np.float64, {}),
    "ignore": (np.float32, {"rule": "ignore"}),
    "offset": (np.float32, {"least": 1e-4}),
    "project": (np.float32, {"rule": "project"}),
    "and offset": (np.float32, {"rule": "and offset"}),
}
figure, axes = plt.subplots(len(four), len(remedies) + 1, figsize=(10, 6.6))
wrong = {}
for row, (name, (shift, size, shapes)) in zip(axes, four.items()):
    right = shadows(np.longdouble, shift, size, shapes, least=1e-6 * size)
    row[0].imshow(right, vmin=0, vmax=1, cmap="gray")
    row[0].set_ylabel(name, fontsize="small")
    for axis, (remedy, (real, options)) in zip(row[1:], remedies.items()):
        made = shadows(real, shift, size, shapes, **options)
        wrong[name, remedy] = np.mean((made > 0) != (right > 0))
        axis.imshow(made, vmin=0, vmax=1, cmap="gray")
        axis.set_xlabel(f"{wrong[name, remedy]:.1%}", fontsize="small")
    for axis in row:
        axis.set(xticks=[], yticks=[])
for axis, title in zip(axes[0], ["the truth", *remedies]):
    axis.set_title(title, fontsize="small")
plt.show()

# %%
for name in four:
    assert min(wrong[name, "none"], wrong[name, "double"]) > 0.03 and wrong[name, "project"] > 0.03
    assert wrong[name, "and offset"] < 1e-3  # the edge of a shadow goes through some pixels
    assert (wrong[name, "ignore"] > 0.01) == (name in ("a bowl", "two floors")), name
    assert (wrong[name, "offset"] > 0.01) == (name in ("far away", "small")), name

# %% [markdown]
# The figure: shadows, and below the share of pixels in which they are wrong.
#
# - **Double** alone changes nothing: a point that is rounded to the inside is inside, were it by $10^{-16}$, and the toss of a coin decides as
#   before. What double does is to make a small offset sufficient.
# - **Ignoring the last object** is perfect where it is convex. The bowl loses its shadow in itself, and of two floors in one place the
#   other one is still there.
# - **An offset** is a length: $10^{-4}$ is less than a rounding at 1930, and ten times the small ball, which throws no shadow for it.
# - **Projection** brings the point as near as floats are dense, which is all that it can do: on a floor at $y = 0$ it is exact, on a ball it is
#   not, and far away floats are as coarse as before.
# - The last column projects *and* moves the point along the normal by a bound on what is left, 8 roundings of its largest coordinate: an
#   offset that knows its hit. `neumann` has points that carry such a bound.

# %% [markdown]
# ## Paths that forget
# Two convex mirrors of radius 1 face each other, a gap of 1 between them. A ray between them is thrown to the side more and more,
# and with it its error, by $1 + \ell + \sqrt{(1+\ell)^2 - 1} = 3.73$ a bounce, with $\ell = 1$ the gap over the radius: each
# bounce costs nearly two bits.


# %%
def bounce(real, start, slope, count):
    """Heights at which a ray between two circular mirrors, centred at x = 0 and 3, hits them; in this kind of number."""
    real_one, centres = real(1), (real(0), real(3))
    p, d = np.array([real(1.5), real(start)], dtype=real), np.array([real(1), real(slope)], dtype=real)
    d /= np.sqrt((d * d).sum())
    heights = []
    for i in range(count):
        q = p - np.array([centres[(i + 1) % 2], real(0)], dtype=real)
        b, c = (q * d).sum(), (q * q).sum() - real_one
        root = b * b - c
        if root < 0:
            break  # past the mirror
        q = q + (-b - np.sqrt(root)) * d
        d = d - 2 * (d * q).sum() * q
        d /= np.sqrt((d * d).sum())
        p = q + np.array([centres[(i + 1) % 2], real(0)], dtype=real)
        heights.append(float(p[1]))
    return np.array(heights)


# The direction that stays between the mirrors longest, by bisection: the ray is thrown up or down.
low, high = np.longdouble(-0.1), np.longdouble(0.1)
for _ in range(62):
    middle = (low + high) / 2
    low, high = (middle, high) if bounce(np.longdouble, 0.01, middle, 60)[-1] < 0 else (low, middle)
truth, double, single = (bounce(real, 0.01, low, 40) for real in (np.longdouble, np.float64, np.float32))
figure, axes = plt.subplots()
growth = 2 + np.sqrt(3)
for heights, label in ((single, "float"), (double, "double")):
    n = min(len(heights), len(truth))
    axes.semilogy(range(1, n + 1), np.maximum(np.abs(heights[:n] - truth[:n]), 1e-20), "o-", label=label)
n = np.arange(1, 30)
axes.semilogy(n, 1e-9 * growth**n, "--", color="grey", label=r"$\times\, 3.73$ a bounce")
axes.set(xlabel="bounce", ylabel="error of the hit point, in radii", ylim=(1e-18, 3), title="A ray between two convex mirrors")
axes.legend()
plt.show()

# %%
seen = np.abs(single[: len(truth)] - truth[: len(single)])
rate = np.polyfit(np.arange(3, 11), np.log(seen[3:11]), 1)[0]
print(f"the error of floats grows by {np.exp(rate):.2f} a bounce, between bounces 4 and 11")
assert 3.3 < np.exp(rate) < 4.1

# %% [markdown]
# The figure: after a dozen bounces the path in floats has nothing to do with the true one. **Q3.** Is the picture wrong then?
# (A3: no. The path is another path, as likely as the true one. The *mean* over all paths is right, and only a test that compares
# two programs path by path would fail. Which is why this project compares means.)
#
# ## Light trapped above a lamp
# `mitsuba-cornell` is the Cornell box as Mitsuba ships it: the lamp is a square that hangs 0.5 mm below the ceiling. Light that
# gets into that gap cannot easily leave. Take its $K$ apart, in red:

# %%
room = scene("mitsuba-cornell", res=48)
M = room.matrices(patches=1000, channel="r", seed=seed, quiet=True)
K, m, table = M.K, M.measure, M.patches
found = neumann.spectrum(K, 4, measure=m, quiet=True)
print("eigenvalues of K, red:", found.eigenvalues.real.round(4))
above = (table["x"] > 213) & (table["x"] < 343) & (table["z"] > 227) & (table["z"] < 332) & (table["y"] > 548)
in_gap = np.zeros(M.Le.size, dtype=bool)
inside = above & np.where(table["y"] > 548.6, table["ny"] < 0, table["ny"] > 0)  # the ceiling there, and the back of the lamp
for first, count in zip(table["unknown"][inside], table["directions"][inside]):
    in_gap[first : first + count] = True
leading = np.real(found.eigenvectors[:, 0]) ** 2 * m
print(
    f"the leading eigenvector has {leading[in_gap].sum() / leading.sum():.4%} of itself in the gap, "
    f"which has {m[in_gap].sum() / m.sum():.2%} of the surfaces"
)
assert leading[in_gap].sum() > 0.99 * leading.sum()
assert abs(found.eigenvalues[0] + found.eigenvalues[1]) < 1e-5 * found.spectral_radius, "a pair ±λ, but for what leaks out: to and fro"
assert (
    found.spectral_radius <= np.sqrt(0.936461 * 0.885809) + 0.01
), "no more than the lamp's back and the ceiling reflect, and the chance of T's rays"

rest = K[~in_gap][:, ~in_gap]
without = abs(neumann.spectrum(rest, 1, measure=m[~in_gap], quiet=True).eigenvalues[0])
t, power, share = M.Le, [], []
for i in range(61):
    power.append(m @ t)
    share.append(m[in_gap] @ t[in_gap] / power[-1])
    t = K @ t
power = np.array(power)
figure, axes = plots(1, 2)
axes[0].semilogy(power / power[0], label="bounce $n$")
n = np.arange(61)
axes[0].semilogy(
    n, power[12] / power[0] * without ** (n - 12), "--", color="grey", label=f"{without:.3f}$^n$"
)
axes[0].semilogy(
    n,
    power[60] / power[0] * found.spectral_radius ** (n - 60),
    ":",
    color="grey",
    label=f"{found.spectral_radius:.3f}$^n$",
)
axes[0].set(xlabel="bounce $n$", ylabel="power over that of bounce 0")
axes[0].legend()
axes[1].plot(n, 100 * np.array(share))
axes[1].set(xlabel="bounce $n$", ylabel="of it in the gap, %")
plt.show()

# %% [markdown]
# The figure: a *stiff* room. Dashed is the rate of the room without the gap, dotted $\lambda_1$. For fifteen bounces light falls
# as if there were no gap; then what is left is what crept in at its edges, of which 0.91 are left with each bounce.
#
# **Q4.** The ratio of bounce 12 to bounce 11 is as settled as can be. What does it promise for bounce 40? **Q5.** Two eigenvalues
# $\pm\lambda$: what does the light in the gap do from bounce to bounce?

# %%
ratio, promised = power[12] / power[11], power[12] * (power[12] / power[11]) ** 28
print(f"ratio {ratio:.3f}: promises {promised / power[0]:.1e} of the lamp's power for bounce 40; it is {power[40] / power[0]:.1e}")
assert power[40] > 1000 * promised
print(
    f"in the gap: {share[2]:.3%} of bounce 2, {share[12]:.0%} of bounce 12, "
    f"{share[20]:.0%} of bounce 20, {share[60]:.0%} of bounce 60"
)
assert share[2] < 0.001 and share[60] > 0.95 and abs(power[60] / power[58] / found.spectral_radius**2 - 1) < 1e-3

# %% [markdown]
# Nobody sees $10^{-7}$ of a picture. But an iterative solver that goes on until its residual is small does; so does a bound from
# $\lambda_1$, and roulette, whose walks in the gap are long and rare. And who raises the albedos sees it with the naked eye.
#
# ## The health report
# A glass ball under a small lamp. What the ball throws on the floor, the caustic, is found by chance: a direction of the floor
# that goes through the ball to the lamp. 16 samples a pixel are too few. `render` warns, and says where.

# %%
with warnings.catch_warnings(record=True) as caught:
    warnings.simplefilter("always")
    sick = scene("glass-ball", res=256).render(bounces=4, spp=16, method="walk", seed=seed)
for warning in caught:
    print(f"{warning.category.__name__}: {warning.message}\n")
health = sick.run.health
worst = max(health.largest_samples, key=lambda s: s.fireflies)
sample = next(s for s in health.samples if s.number == worst.number)
x, y = sample.pixel
figure = pictures([sick.terms[worst.bounce], sick.sums[4]], [f"bounce {worst.bounce}", "sum"], white=2.0)
for axis in figure.axes:
    axis.plot(x, y, "o", ms=12, mfc="none", mec="cyan")
plt.show()
print(
    f"bounce {worst.bounce}, pixel {x},{y}: one of its 16 samples makes {worst.share_of_pixel:.1%} of it; "
    f"there are {worst.fireflies} like it"
)
assert health.sick and worst.fireflies > 0 and worst.share_of_pixel > 0.5
assert any(issubclass(w.category, neumann.HealthWarning) for w in caught)

# %% [markdown]
# The figure: bounce and sum; circled is the sample that is named. A *firefly* is no bug: it is a path of small probability and
# great weight, as roulette's in lesson 4. To clamp it would make the picture prettier and wrong: the caustic's light is in those
# dots.
#
# What would be a bug is energy that gets lost. The report keeps the books, bounce by bounce: what arrives is absorbed, leaves the
# scene or goes on.

# %%
books = health.energy_balance.from_the_camera
rows = np.array([[b[name].mean for name in ("absorbed", "left_the_scene", "went_on")] for b in books.bounces])
figure, axes = plt.subplots()
below = np.zeros(len(rows))
for column, name in enumerate(("absorbed", "left the scene", "went on")):
    axes.bar(range(1, len(rows) + 1), rows[:, column], bottom=below, label=name, width=0.6)
    below = below + rows[:, column]
arrived = [b.arrived.mean for b in books.bounces]
axes.plot(range(1, len(rows) + 1), arrived, "k_", ms=26, label="arrived")
axes.set(xlabel="bounce", ylabel="mean weight of a path", title="Where the energy goes", xticks=range(1, len(rows) + 1))
axes.legend()
plt.show()
for b in books.bounces:
    print(
        f"bounce {b.bounce}: arrived {b.arrived.mean:.4f}, missing {b.imbalance.mean:+.4f} ± {b.imbalance.interval95:.4f}"
        + ("  SICK" if b.sick else "")
    )
assert not any(b.sick for b in books.bounces)  # a false alarm in 10 000 scenes, by the report's own confidence
assert health.non_finite_samples.count == 0 and health.self_hits.count == 0

# %% [markdown]
# The figure: the columns must reach the black marks, within error bars.
#
# A sample that the report names can be traced again, ray by ray: save the render, and `./run replay DIR NUMBER` shows its path.
#
# **Q6.** Which of these is sick, which is noisy: (a) one pixel of a bounce with a relative error of 40%; (b) a pixel of which one
# sample makes 99%; (c) bounce 1 loses 0.3% ± 0.02% of its energy; (d) three samples of $10^9$ are no numbers?
#
# ## Exercises
# 1. Find the $n$ at which a *double* sum stands still for $\rho = 0.9$ and 0.99. Predict it: $\rho^n < 2^{-53} / (1-\rho)$.
# 2. Sum the terms from the smallest to the largest, in float. How good is that? Why can a renderer not do so?
# 3. Move the ball and its camera to $(10^5, 0, 0)$, with a radius of 1. Is bounce 2 still exactly 0? Why does subtracting the
#    middle of the scene before anything else help?
# 4. Lower the lamp of `mitsuba-cornell` (its file has one `translate`) to 50 mm. What happens to the pair $\pm\lambda$? What, if
#    its back were black?
# 5. Render `glass-ball` with `method="bidirectional"`. Which complaints go away, and why?
# 6. Save the sick render (`sick.save("out/sick")`), and replay the firefly. Through which surfaces does its path go?
