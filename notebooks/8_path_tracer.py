# %% [markdown]
# # 8. The path tracer in the lecture's order
#
# **What this teaches.** How to write a path tracer that is right at every step. You will grow one in numpy, in the order of
# CS184: emitted light, direct light by directions, direct light by points of the lamp, one bounce more, russian roulette,
# mirrors, lens and pixel. After each step it is compared with the program, bounce by bounce, and after each step a mistake that
# is often made is made on purpose, to see how it looks and what `neumann.blame` says of it.

# %%
from lesson import limit, pictures, plots, radiance_unit, scenes, seed, srgb
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection
import neumann

# %% [markdown]
# ## The room and the judge
# The room is Cornell's, with colours of three numbers. Later its back wall becomes a mirror, and the camera gets a lens.


# %%
def diffuse(*rgb):
    return {"type": "diffuse", "reflectance": {"type": "rgb", "value": rgb}}


white, red, green = diffuse(0.75, 0.75, 0.75), diffuse(0.6, 0.1, 0.1), diffuse(0.1, 0.5, 0.15)
lamp_radiance, lamp_area = np.array([18.0, 12.0, 5.0]), 130.0 * 105.0  # W·m⁻²·sr⁻¹, mm²
eye, slope = np.array([278.0, 273.0, -800.0]), 12.5 / 35  # mm; half of the film over its distance: tan(fov/2)


def cornell(pixels, back=white, **camera):
    """The Cornell box, with another back wall or another camera."""
    surfaces = {name: white for name in ("floor", "ceiling", "short_block", "tall_block", "light")}
    surfaces.update(left=red, right=green, back=back)
    meshes = {
        name: {"type": "obj", "filename": f"{scenes}/cornell-box/meshes/{name}.obj", "face_normals": True, "bsdf": material}
        for name, material in surfaces.items()
    }
    meshes["light"]["emitter"] = {"type": "area", "radiance": {"type": "rgb", "value": list(lamp_radiance)}}
    film = {"type": "hdrfilm", "width": pixels, "height": pixels, "rfilter": {"type": "box"}}
    sensor = {"type": "perspective", "fov": 2 * np.degrees(np.arctan(slope)), "film": film, **camera}
    return neumann.load_dict({"type": "scene", "sensor": {**sensor, "to_world": neumann.look_at(eye, eye + [0, 0, 1])}, **meshes})


pixels = 32
room = cornell(pixels)

# %% [markdown]
# The lecture's pseudocode begins with `EstRadianceIn(x, ω)`: what arrives at $x$ from $\omega$ is what the first point $p$ that is
# seen there emits, and what it reflects,
#
# $$L_i(x, \omega) = L_e(p, -\omega) + (\text{at least one bounce})(p, -\omega), \qquad p = \mathrm{tr}(x, \omega).$$
#
# Ours does this for many rays at once, and keeps the bounces apart: it returns the list $[L_e, K L_e, K^2 L_e, \dots]$, one
# sample of each for every ray. What is reflected is a function that grows from step to step.


# %%
def zero_bounce(p):
    """Le, from p towards where it is seen from; 0 where there is no p."""
    return p.emission


def put(where, values, n):
    """n rows, which are 0 but for some."""
    rows = np.zeros((n, 3))
    rows[where] = values
    return rows


def radiance_in(x, w, at_least_one_bounce, rng):
    """[Le, K Le, K² Le, …] that arrives at x from w."""
    p = room.intersect(x, w)
    hit = np.flatnonzero(p.hit)
    return [zero_bounce(p)] + [put(hit, L, len(p)) for L in at_least_one_bounce(p[hit], -w[hit], rng)]


def dot(a, b):
    """Of each row, as a column."""
    return np.sum(a * b, axis=1, keepdims=True)


# %% [markdown]
# The judge: two pictures of each bounce, by two seeds, go to `neumann.blame`, which renders the same bounces itself. It says
# whether they differ by more than chance explains, and tries some fifty kinds of mistakes: what would each make of this room, and
# which of them is what it sees? A suspicion is not a proof. Of right pictures it is in doubt once in 200 times.


# %%
def picture(at_least_one_bounce, bounces, seed, samples=64, camera=None):
    """Bounces 0 to `bounces`, each (pixels, pixels, 3)."""
    rng, rays = np.random.default_rng(seed), room.camera_rays(samples, seed=seed)
    x, w = camera(samples, rng) if camera else (rays.origin, rays.direction)
    terms = radiance_in(x, w, at_least_one_bounce, rng)[: bounces + 1]
    return [L.reshape(samples, pixels, pixels, 3).mean(axis=0) for L in terms]


def judged(first, again):
    found = neumann.blame(room, first, again=again, counts="bounces", spp=64, seed=seed + 10**6, quiet=True)
    print("theirs / ours: " + ", ".join(f"bounce {t.first} {t.ratio:.3f} ± {t.ratio_stderr:.3f}" for t in found.terms))
    print(found, end="\n\n")
    return found


def judge(at_least_one_bounce, bounces, **options):
    return judged(*(picture(at_least_one_bounce, bounces, 2 * seed + s, **options) for s in (0, 1)))


def right(found):
    """A bounce more than limit() standard errors off happens once in 150 000 times; a mistake is hardly named by chance."""
    return found.verdict != "wrong" and all(abs(t.ratio - 1) <= limit() * t.ratio_stderr for t in found.terms)


# %% [markdown]
# ## Step 1: emitted light
# Black surfaces and a lamp: bounce 0. All that can be wrong is the camera. A film whose rows count from the bottom, read by a
# program that counts from the top, is the mistake.


# %%
def black(p, wo, rng):
    return []


found = judge(black, 0)
assert right(found)
upside_down = judged(*([L[::-1] for L in picture(black, 0, 2 * seed + s)] for s in (0, 1)))
assert "flipped_y" in [s.name for s in upside_down.suspects[:2]]
Le = found.terms[0]
pictures([Le.ours, Le.theirs, upside_down.terms[0].theirs], ["the program", "mine", "rows from the bottom"], white=12)
plt.show()

# %% [markdown]
# The figure: bounce 0. The ratio of the means cannot tell that picture from the right one; places do. Here `blame` has two names
# that fit equally well, for the lamp is symmetric: to stand on its head, and to be turned by 180°.
#
# ## Step 2: direct light by directions
# A surface of reflectance $\rho$ sends the same radiance into all directions, $f = \rho/\pi$. Direct light is the integral over the
# hemisphere
#
# $$(K L_e)(p) = \int_{H^2} f\, L_e(\mathrm{tr}(p, \omega), -\omega) \cos\theta\, d\omega
# \approx \frac{f\, L_e \cos\theta}{1 / 2\pi} \quad \text{for one direction, uniform in the hemisphere.}$$
#
# **Q1.** Seen from the middle of the floor the lamp (130 mm × 105 mm, 549 mm above it) has a solid angle of about
# $13650/549^2 = 0.045$ sr. Of how many directions does one hit it? (A1: $2\pi/0.045$, about 140: all others are black.)


# %%
def hemisphere(p, rng):
    """Directions, uniform on the side of p that is seen."""
    w = rng.normal(size=(len(p), 3))
    w *= np.sign(dot(w, p.normal))
    return w / np.linalg.norm(w, axis=1, keepdims=True)


def by_directions(p, wo, rng, cosine=dot):
    wi = hemisphere(p, rng)
    Le = zero_bounce(room.intersect(p, wi))
    return [p.reflectance / np.pi * Le * cosine(p.normal, wi) / (1 / (2 * np.pi))]


directions = judge(by_directions, 1, samples=256)
assert right(directions)
no_cosine = judge(lambda p, wo, rng: by_directions(p, wo, rng, cosine=lambda n, w: 1.0), 1, samples=256)
assert no_cosine.suspects[0].name == "no_cosine"

# %% [markdown]
# The mistake was to forget $\cos\theta$. `blame` names it, with a clause that is not true of us, "where lamps are sampled": it sees
# means, and a cosine that is missing has the same mean however light is looked for. A name leads to the formula, not to the line.

# %% [markdown]
# ## Step 3: direct light by points of the lamp
# Where the lamp is, is known, so why look for it? Take the integral over the lamp in place of the hemisphere. A piece $dA$ of it
# at $y$, at the distance $d = |y - x|$ from $x$, is seen at an angle: across the view it has the area $\cos\theta_y\, dA$. The
# part of the sphere of radius $d$ around $x$ that it covers has just this area, and the unit sphere is $d^2$ times smaller:
#
# $$d\omega = \frac{\cos\theta_y}{d^2}\, dA .$$
#
# And a direction hits this piece of the lamp only if nothing is in the way, $V(x, y) = 1$; tracing the ray had said that without
# being asked. So
#
# $$(K L_e)(x) = \int_{\text{lamp}} f\; G(x, y)\; V(x, y)\; L_e(y)\; dA(y), \qquad
# G(x, y) = \frac{\cos\theta_x \cos\theta_y}{|x - y|^2},$$
#
# which is the **area form**. Cosines below 0 count as 0: there $x$ or the lamp faces away.
#
# The change of measure by itself: the solid angle of the lamp from 548.8 mm below its middle, by directions, by points, and by the
# formula for a rectangle, $4 \arcsin(a b / \sqrt{(a^2 + h^2)(b^2 + h^2)})$ with half sides $a$, $b$.

# %%
rng, n = np.random.default_rng(seed), 400_000
a, b, h = 65.0, 52.5, 548.8
w = rng.normal(size=(n, 3))
hits = (np.abs(w[:, :2]) * h < np.abs(w[:, 2:]) * [a, b]).all(axis=1)  # of the rectangle above, and of one below
d2 = h**2 + np.sum((rng.uniform(-1, 1, (n, 2)) * [a, b]) ** 2, axis=1)
solid_angle = {"directions": 2 * np.pi * hits, "points": 4 * a * b * (h / np.sqrt(d2)) / d2}
exact = 4 * np.arcsin(a * b / np.sqrt((a**2 + h**2) * (b**2 + h**2)))
for name, values in solid_angle.items():
    error = values.std() / np.sqrt(n)
    print(f"solid angle by {name:10s} {values.mean():.6f} ± {error:.6f} sr, exact {exact:.6f}")
    assert abs(values.mean() - exact) <= limit() * error  # two: false alarm in 75 000 seeds


# %%
def G(x, y):
    d = y.position - x.position
    return np.maximum(dot(x.normal, d), 0) * np.maximum(-dot(y.normal, d), 0) / dot(d, d) ** 2  # each cosine has 1/|d|


def V(x, y):
    return room.visible(x, y)[:, None]


def one_bounce(x, rng, G=G, V=V):
    y = room.sample_lights(x, rng.random((len(x), 2)))  # of one lamp: points uniform on its area
    return x.reflectance / np.pi * lamp_radiance * G(x, y) * V(x, y) / (1 / lamp_area)


def by_points(p, wo, rng, **factors):
    return [one_bounce(p, rng, **factors)]


points = judge(by_points, 1)
assert right(points)
noise = [np.sqrt(np.mean(np.square(f.terms[1].difference_stderr, dtype=float))) for f in (directions, points)]
print(f"standard error of a pixel of the difference: {noise[0]:.3f} by directions, {noise[1]:.3f} by points")
pictures(
    [points.terms[1].ours, directions.terms[1].theirs, points.terms[1].theirs],
    ["the program", "by directions", "by points"],
    white=0.5,
)
plt.show()

# %% [markdown]
# The figure: bounce 1, by directions with 512 samples a pixel, by points with 128. They agree in the mean; by points the noise is
# that of the shadow's edge and of $G$, while by directions it is that of finding the lamp at all.
#
# **Q2.** $1/d^2$ has no bound. Why are there no white dots along the edge of the lamp, where the ceiling touches it? (A2: the
# ceiling lies in the lamp's plane: both cosines are 0. A wall that touched a lamp would have $d \to 0$ with cosines that stay.)
#
# The cosine at $x$ was forgotten in step 2. These are the other factors.


# %%
def distance2(x, y):
    return dot(y.position - x.position, y.position - x.position)


def cosine_at_lamp(x, y):
    return np.maximum(-dot(y.normal, y.position - x.position), 1e-9) / np.sqrt(distance2(x, y))


forgotten = {
    "1/d²": dict(G=lambda x, y: G(x, y) * distance2(x, y)),
    "cosθ at lamp": dict(G=lambda x, y: G(x, y) / cosine_at_lamp(x, y)),
    "V": dict(V=lambda x, y: 1.0),
}
verdicts = {}
for what, factors in forgotten.items():
    print(f"Without {what}:")
    verdicts[what] = judge(lambda p, wo, rng: by_points(p, wo, rng, **factors), 1)
assert verdicts["1/d²"].suspects[0].name == "no_inverse_square"
assert verdicts["cosθ at lamp"].suspects[0].name == "no_light_cosine"
assert verdicts["V"].verdict != "right"
pictures(
    [f.terms[1].theirs / f.terms[1].ratio for f in verdicts.values()],
    [f"no {what}: ÷ {f.terms[1].ratio:.3g}" for what, f in verdicts.items()],
    white=0.5,
)
plt.show()

# %% [markdown]
# The figure: bounce 1 with one factor missing, each divided by its ratio to the right mean. Without $1/d^2$ the unit of length
# matters, and a room in millimetres is two hundred thousand times too bright. Without $V$ nothing casts a shadow, and the whole
# has 12% more light: a picture that many would pass. `blame` names the first two; of the third it is in doubt in some runs, because
# a mean that is off by less than 20% is a weak sign, and then says so.
#
# ## Step 4: one bounce more
# Light of more bounces comes to $p$ from other surfaces. For that there is no lamp to aim at: the direction is a random one, and
# what arrives from there is `radiance_in` once more. The lecture splits it so: **one bounce** by points of the lamp, not
# recursive; **more bounces** by a direction, recursive.
#
# $$\text{(at least one bounce)} = \text{one bounce} + \frac{f \cos\theta}{1/2\pi}\; \big(\text{what arrives, \emph{without} its }
# L_e\big)$$
#
# **Q3.** Why without? (A3: light that $q$ emits and $p$ reflects is bounce 1, which the points of the lamp have brought already.)


# %%
def at_least_one_bounce(p, wo, rng, bounces=3, counted=0.0):
    if bounces == 0:
        return []
    wi = hemisphere(p, rng)
    arrives = radiance_in(p, wi, lambda *point: at_least_one_bounce(*point, bounces - 1, counted), rng)
    reflected = [p.reflectance / np.pi * dot(p.normal, wi) / (1 / (2 * np.pi)) * L for L in arrives]
    return [one_bounce(p, rng) + counted * reflected[0]] + reflected[1:]


found = judge(at_least_one_bounce, 3)
assert right(found)
twice = judge(lambda *p: at_least_one_bounce(*p, counted=1.0), 3)
assert {s.name for s in twice.suspects[:2]} == {"twice_light", "light_twice"}
pictures(
    [found.terms[i].theirs for i in (1, 2, 3)] + [twice.terms[i].theirs for i in (1, 2, 3)],
    [f"bounce {i}" for i in (1, 2, 3)] + [f"bounce {i}, Le twice" for i in (1, 2, 3)],
    white=0.5,
)
plt.show()

# %% [markdown]
# The figure: bounces 1 to 3, and below them the mistake: to take all that arrives. Then light that is found by chance counts
# beside light that was aimed at, and every bounce but 0 has twice its light. `blame` cannot tell this from lamp samples that
# count double, which have the same mean, and says both. Look yourself: the upper and lower noise differ, for half of the lower
# light came by luck.
#
# What has been summed so far are paths. Here are some of one camera ray.

# %%
view = cornell(160).render(bounces=3, spp=16, seed=seed, quiet=True).sums[3]


def in_picture(position):
    """Column and row, in 160 pixels: x runs to the left, y up."""
    depth = (position[:, 2:] - eye[2]) * slope
    return 80 - 80 * (position[:, :2] - eye[:2]) / depth


rng, many = np.random.default_rng(seed), 150
target = np.array([420.0, 0.0, 120.0])  # on the floor
x = room.intersect(np.tile(eye, (many, 1)), np.tile(target - eye, (many, 1)))
stops, figure, axes = [x], *plots(2, 3, height=0.335)
for i in (1, 2, 3):
    y = room.sample_lights(x, rng.random((len(x), 2)))
    brings = (G(x, y) * V(x, y))[:, 0] > 0
    paths = np.stack([in_picture(p.position) for p in (*stops, y)], axis=1)[brings]
    for axis, shown in zip(axes[:, i - 1], (paths[:1], paths)):
        axis.imshow(0.6 * srgb(view, 1.0))
        axis.add_collection(LineCollection(shown[:, :-1], colors="white", linewidths=1.5, alpha=0.8 if len(shown) == 1 else 0.3))
        axis.add_collection(LineCollection(shown[:, -2:], colors="gold", linewidths=1.5, alpha=1 if len(shown) == 1 else 0.3))
        axis.plot(*in_picture(target[None]).T, "o", color="C0")
        axis.axis("off")
    axes[0, i - 1].set_title(f"{i} bounce{'s' * (i > 1)}, one path")
    axes[1, i - 1].set_title(f"{len(paths)} of {many} paths")
    x = room.intersect(x, hemisphere(x, rng))
    stops = [p[x.hit] for p in (*stops, x)]  # the others have left by the open front
    x = stops[-1]
plt.show()

# %% [markdown]
# The figure: above one path each, below all of 150 that bring light, drawn over what hides them. Blue is the point that
# the camera ray sees, gold the last piece, to the lamp. The paths of one bounce fill a pyramid; those of two come from everywhere.
#
# ## Step 5: russian roulette
# With `bounces=3` the picture lacks all light of more bounces: it is *biased*, however many samples it takes. So let a path end
# by chance: it goes on with probability $q$, and what it brings is divided by $q$, so that the mean stays. The lecture's advice
# is to end where little is reflected: $q$ is the largest of the three reflectances here.
#
# **Q4.** How many bounces has a path in a closed room of $q = 0.75$ on average? (A4: $1 + q + q^2 + \dots = 1/(1-q) = 4$. Some
# have 20.)


# %%
def at_least_one_bounce(p, wo, rng, weighted=True):
    q = p.reflectance.max(axis=1)
    alive = np.flatnonzero(rng.random(len(p)) < q)
    reflected = []
    if alive.size:
        on = p[alive]
        wi = hemisphere(on, rng)
        weight = on.reflectance / np.pi * dot(on.normal, wi) / (1 / (2 * np.pi)) / (q[alive, None] if weighted else 1)
        arrives = radiance_in(on, wi, lambda *point: at_least_one_bounce(*point, weighted), rng)
        reflected = [put(alive, weight * L, len(p)) for L in arrives[1:]]
    return [one_bounce(p, rng)] + reflected


found = judge(at_least_one_bounce, 3)
assert right(found)
unweighted = judge(lambda *p: at_least_one_bounce(*p, weighted=False), 3)
assert unweighted.first_wrong.first == 2 and unweighted.suspects[0].name == "no_roulette_weight"

# %% [markdown]
# The mistake is to forget the division. `blame` names it. Bounces 0 and 1 are right in both, for roulette begins after bounce 1:
# the whole picture looks a little dark, and nothing else. Bounce by bounce it cannot be missed.

# %%
ours = room.render(bounces=7, spp=256, sampler="independent", seed=seed + 10**6, quiet=True)
n = 256
rays, means = room.camera_rays(n, seed=seed), {}
for name, weighted in (("divided by $q$", True), ("not divided", False)):
    bounce = lambda *p: at_least_one_bounce(*p, weighted)
    terms = radiance_in(rays.origin, rays.direction, bounce, np.random.default_rng(seed))
    means[name] = np.array([L.reshape(n, -1).mean(axis=1) for L in terms])  # of n groups of samples
rest = means["divided by $q$"][8:].sum(axis=0)
both = np.hypot(rest.std(ddof=1) / np.sqrt(n), ours.run.rest.stderr)
figure, axes = plt.subplots()
axes.semilogy(range(8), [b.mean for b in ours.run.bounces], "k-", label="the program")
for (name, groups), marker in zip(means.items(), "os"):
    mean, error = groups[:8].mean(axis=1), groups[:8].std(axis=1, ddof=1) / np.sqrt(n)
    axes.errorbar(range(8), mean, yerr=2 * error, fmt=marker, capsize=3, label=name)
axes.set(xlabel="bounce", ylabel=f"mean of the picture, {radiance_unit}", yscale="log", title="Russian roulette")
axes.legend()
plt.show()
print(f"longest path: {len(terms) - 1} bounces; beyond bounce 7 the program has {ours.run.rest.mean:.5f}, I {rest.mean():.5f}")
# A false alarm in 150 000 seeds.
assert abs(rest.mean() - ours.run.rest.mean) <= limit(min(n - 1, ours.run.rest.degrees_of_freedom)) * both

# %% [markdown]
# The figure: mean of each bounce, with 95% bars. What is not divided falls faster, by $q$ a bounce. What roulette finds beyond
# bounce 7 is what the program calls the rest: nothing is missing.
#
# ## Step 6: what the material reflects
# So far every direction was uniform. On a diffuse surface the density $\cos\theta/\pi$ is better: $f \cos\theta$ over it is
# $\rho$, a number that does not vary. Such a direction is a point of the unit sphere around the tip of the normal. A mirror
# reflects into one direction, which no other density finds, and $f\cos\theta$ over the density is its reflectance.
#
# A point of the lamp that is drawn lies in that direction with probability 0. So `one_bounce` brings nothing from a mirror, and the
# lamp that is seen in it has to be counted when it is hit. This is the line of step 4 with a condition: **emission counts at the
# camera and after a mirror, and nowhere else**.

# %%
shine = 0.9
mirror = {"type": "conductor", "material": "none", "specular_reflectance": {"type": "rgb", "value": shine}}


def reflect(p, wo, rng):
    """Directions by the material, and f cosθ over their density."""
    is_mirror = np.isnan(p.reflectance[:, :1])
    sphere = rng.normal(size=(len(p), 3))
    sphere /= np.linalg.norm(sphere, axis=1, keepdims=True)
    wi = np.where(is_mirror, 2 * dot(p.normal, wo) * p.normal - wo, p.normal + sphere)
    return wi, np.where(is_mirror, shine, p.reflectance)


def at_least_one_bounce(p, wo, rng, after_mirror=1.0, reflect=reflect):
    is_mirror = np.isnan(p.reflectance[:, :1])
    wi, weight = reflect(p, wo, rng)
    q = np.minimum(weight.max(axis=1), 1)
    alive = np.flatnonzero(rng.random(len(p)) < q)
    bounces = [np.where(is_mirror, 0, one_bounce(p, rng))]
    if alive.size:
        arrives = radiance_in(p[alive], wi[alive], lambda *point: at_least_one_bounce(*point, after_mirror, reflect), rng)
        reflected = [put(alive, weight[alive] / q[alive, None] * L, len(p)) for L in arrives]
        bounces[0] += after_mirror * is_mirror * reflected[0]
        bounces += reflected[1:]
    return bounces


def wrong_density(p, wo, rng):
    wi, weight = reflect(p, wo, rng)
    cosine = dot(p.normal, wi) / np.linalg.norm(wi, axis=1, keepdims=True)
    return wi, np.where(np.isnan(p.reflectance[:, :1]), weight, weight * 2 * cosine)


print("Directions by cosθ/π, divided by 1/2π:")
density = judge(lambda *p: at_least_one_bounce(*p, reflect=wrong_density), 3)
assert density.first_wrong.first == 2 and density.suspects[0].name == "cosine_as_uniform"

room = cornell(pixels, mirror)
found = judge(at_least_one_bounce, 3)
assert right(found)
print("The lamp is not counted after the mirror:")
no_lamp = judge(lambda *p: at_least_one_bounce(*p, after_mirror=0.0), 3)
assert no_lamp.terms[1].ours.max() > 2 * no_lamp.terms[1].theirs.max(), "the mirror shows the lamp"
pictures(
    [sum(t.theirs for t in f.terms) for f in (density, found, no_lamp)],
    ["wrong density", "back wall: a mirror", "no lamp after it"],
    white=1.5,
)
plt.show()

# %% [markdown]
# The figure: the sum of bounces 0 to 3. On the left directions by $\cos\theta/\pi$ were divided by $1/2\pi$, in the room without
# a mirror. Bounce 1 is right, so what is wrong lies between two surfaces; from there each bounce has about a third more light than
# it should, and `blame` names it. Roulette needs its `np.minimum` now: what was divided by the wrong density reflects more than 1.
#
# On the right the lamp does not count after the mirror: the wall does not show it, and the light that the wall throws into the
# room is missing. You see that at once, and `blame` does not: what is missing in bounce 1 is in a handful of pixels, which weigh
# little in its test, and in bounces 2 and 3 it is few bright samples. So it may find bounce 1 right, and take the mistake for
# clamping. Look at the maps that it returns, too: `no_lamp.terms[1].difference`.
#
# **Q5.** After a mirror *and* a diffuse surface: does a lamp count that is hit? (A5: no. The points of the lamp have brought it at
# the diffuse surface. What matters is the last surface before the lamp.)
#
# ## Step 7: pixel and lens
# A pixel is a mean over its area, and with a lens also over the aperture. Both are two more dimensions of the same integral: draw
# a point in the pixel and a point on the lens for every sample, and the rest of the program stays as it is. All rays of a point
# of the film meet in the plane in focus.

# %%
aperture, focus = 30.0, 900.0  # mm: radius of the lens, distance of the plane in focus
room = cornell(pixels, mirror, type="thinlens", aperture_radius=aperture, focus_distance=focus)


def lens(samples, rng, right=-1.0):
    """Origins and directions, sample by sample, in each row by row."""
    row, column = np.divmod(np.tile(np.arange(pixels**2), samples), pixels)
    u = rng.random((4, len(row)))
    x, y = right * (2 * (column + u[0]) / pixels - 1), 1 - 2 * (row + u[1]) / pixels
    radius, angle = aperture * np.sqrt(u[2]), 2 * np.pi * u[3]
    on_lens = np.stack([radius * np.cos(angle), radius * np.sin(angle), 0 * angle], axis=1)
    sharp = focus * np.stack([slope * x, slope * y, 0 * x + 1], axis=1)
    return eye + on_lens, sharp - on_lens


found = judge(at_least_one_bounce, 3, camera=lens)
assert right(found)
mirrored = judge(at_least_one_bounce, 3, camera=lambda *p: lens(*p, right=1.0))
assert mirrored.suspects[0].name == "flipped_x"

# %% [markdown]
# The camera looks along $z$ with $y$ up, so that $x$ runs to the left in the picture. The mistake is to let it run to the right,
# and `blame` names it: left and right walls have other colours.
#
# The whole, all bounces, with more and more samples:

# %%
pixels = 64
room = cornell(pixels, mirror, type="thinlens", aperture_radius=aperture, focus_distance=focus)
counts = (1, 8, 64)
pictures(
    [sum(picture(at_least_one_bounce, 1000, seed, n, lens)) for n in counts],
    [f"{n} sample{'s' * (n > 1)} a pixel" for n in counts],
    white=1.5,
)
plt.show()

# %% [markdown]
# The figure: the complete path tracer. Eight times the samples make the noise $\sqrt 8 \approx 2.8$ times smaller.
#
# **Q6.** The bright dots in the last picture are on diffuse surfaces. Which paths bring them? (A6: from a diffuse surface by
# chance to the mirror and from there to the lamp. Points of the lamp cannot be joined through a mirror; that light is found by
# directions alone, as in step 2.)
#
# ## What can be chosen
# Dutré ends with the parameters of the full algorithm. Each is an option here, of the command and of `render()`:
#
# | parameter | in this lesson | option |
# | --- | --- | --- |
# | viewing rays of a pixel | 64 | `--spp`, `--time`, `--error`; more where it is needed: `--adaptive` |
# | shadow rays of a point | 1 | `--split L,C` (at the first point) |
# | which lamp they go to | there is one | `--lights` |
# | where on the lamp | uniform on its area | `--direct light`, `solid-angle`, `projected`; with directions, weighted: `mis` |
# | indirect rays of a point | 1 | `--split L,C`, `--tree` |
# | their directions | uniform, then by the material | by the material; by an approximate solution: `--method guided` |
# | when a path ends | largest reflectance | `--roulette` |
#
# None changes the mean of a picture, and all change its noise and its price: lessons 4 and 5 measure that. The comparison by
# `blame` is the test that they leave the mean alone.
#
# ## Exercises
# 1. Square the reflectance in `one_bounce` and in `reflect`. What does `blame` say, and of which bounce? Then square it in
#    `reflect` alone.
# 2. Draw the point on the lens with `radius = aperture * u[2]`. What is wrong with it, and how many samples does `blame` need to
#    see it?
# 3. Send all rays through the corners of their pixels, without `u[0]` and `u[1]`: the picture is shifted by half a pixel. Does
#    `blame` see it with 32 pixels and 64 samples? With how many?
# 4. Give the judge a tracer that takes the same random numbers in all pixels. It is right. Why may the verdict not be?
# 5. Divide by `lamp_area` where the area form multiplies by it. Does a picture with a white point of its own show that? Does
#    `blame` name it?
# 6. Let paths go on with $q = \frac12$ everywhere. Is the mean still right? Measure the variance of bounce 5 against the time.
# 7. Sample two points of the lamp at each stop and one direction. Which of the bounces gain?
