# %% [markdown]
# # 9. Where noise comes from
#
# **What this teaches.** All ways to make paths have the same mean, and each has noise of another cause: the light is 0, something is
# in between, or what is multiplied varies. You will split the variance of direct light by cause, exactly, for seven ways to look for
# it; put generators of longer paths side by side and count what they ask of the scene; write one path out as $f(x)/p(x)$; and see
# which wrong solid angle makes a picture slower and which makes it wrong.

# %%
from lesson import limit, pictures, plots, seed
from matplotlib.colors import LogNorm
import matplotlib.pyplot as plt
import numpy as np
import neumann
import scipy.integrate

rng = np.random.default_rng(seed)

# %% [markdown]
# ## A room whose surfaces are known
# To choose points on *all* surfaces one has to know them, so here is a room of rectangles: a corner and two sides each, the front being
# where $a \times b$ points. All of it is grey, so that radiance is one number. The wall at the back is glossy (Phong's lobe:
# $f_s = k \frac{n+2}{2\pi} \cos^n\alpha$ around the mirror direction), the others are diffuse. No two surfaces touch, for a reason that
# comes below.

# %%
gloss, exponent = 0.8, 40
rectangles = {
    "floor": ("white", (-0.9, 0, -0.9), (0, 0, 1.8), (1.8, 0, 0)),
    "ceiling": ("white", (-0.9, 2, -0.9), (1.8, 0, 0), (0, 0, 1.8)),
    "left": ("grey", (-1, 0.1, -0.9), (0, 1.8, 0), (0, 0, 1.8)),
    "right": ("grey", (1, 0.1, -0.9), (0, 0, 1.8), (0, 1.8, 0)),
    "back": ("glossy", (-0.9, 0.1, -1), (1.8, 0, 0), (0, 1.8, 0)),
    "lamp": ("white", (-0.3, 1.8, -0.3), (0.6, 0, 0), (0, 0, 0.6)),
}
# A block that floats: its sides, from edge to edge around it, and its ends.
side, other, up = np.array([0.5, 0, -0.2]), np.array([-0.2, 0, -0.5]), np.array([0, 0.8, 0])
near = np.array([0.1, 0.2, 0.2])
for k, (start, along) in enumerate(((near, side), (near + side, other), (near + side + other, -side), (near + other, -other))):
    rectangles[f"block {k}"] = ("white", start, along, up)
rectangles["block top"] = ("white", near + up, side, other)
rectangles["block bottom"] = ("white", near, other, side)
material, corner, a, b = (np.array(column) for column in zip(*rectangles.values()))
normal = np.cross(a, b)
area = np.linalg.norm(normal, axis=1)
normal /= area[:, None]
lamp = list(rectangles).index("lamp")
eye, fov = np.array([0, 1, 3.9]), 33


def mesh(k):
    """A rectangle as a shape of a scene."""
    shape = {
        "type": "mesh",
        "vertices": corner[k] + np.array([0 * a[k], a[k], a[k] + b[k], b[k]]),
        "faces": np.array([[0, 1, 2], [0, 2, 3]]),
        "bsdf": {"type": "ref", "id": material[k]},
    }
    return {**shape, "emitter": {"type": "area", "radiance": {"type": "rgb", "value": 10.0}}} if k == lamp else shape


def room_of(res):
    """The room, in a picture of res × res pixels."""
    film = {"type": "hdrfilm", "width": res, "height": res, "rfilter": {"type": "box"}}
    made = {
        "type": "scene",
        "sensor": {"type": "perspective", "fov": fov, "to_world": neumann.look_at(eye, [0, 1, 0]), "film": film},
        "white": {"type": "diffuse", "reflectance": {"type": "rgb", "value": 0.7}},
        "grey": {"type": "diffuse", "reflectance": {"type": "rgb", "value": 0.35}},
        "glossy": {"type": "phong", "exponent": exponent, "diffuse_reflectance": 0.0, "specular_reflectance": gloss},
    }
    return neumann.load_dict({**made, **{name.replace(" ", "-"): mesh(k) for k, name in enumerate(rectangles)}})


res, spp = 32, 512
room = room_of(res)
exact = room.render(bounces=2, spp=1024, direct="mis", sampler="independent", seed=seed, quiet=True)
pictures([exact.terms[1], exact.terms[2]], ["bounce 1", "bounce 2"], white=0.8)
plt.show()

# %% [markdown]
# The figure: light from the lamp itself, and light that has been reflected once before. The bright spot is the lamp in the glossy wall.
#
# ## Seven ways to look for the lamp
# Bounce 1 at a point $x$ is one integral in two forms, over directions and over the points $y$ of surfaces:
#
# $$\int f_s(\omega)\, L_e(\omega) \cos\theta_x\, d\omega
# = \int f_s\, L_e(y \to x)\, V(x, y)\, \frac{\cos\theta_x \cos\theta_y}{|x - y|^2}\, dA_y,
# \qquad d\omega = \frac{\cos\theta_y}{d^2}\, dA .$$
#
# $\frac{1}{d^2}$ is no attenuation. It counts how many points of a surface share a solid angle: radiance is the same all along a ray
# through empty space. So it belongs to the *form*, not to what is between the points: in fog the form over points has the same
# $\frac{1}{d^2}$, and $V$ is multiplied by the transmittance $e^{-\int \sigma_t}$, which both forms have.
#
# What a way needs: the material, as a function and as a pdf, and the queries of lesson 5.


# %%
def dot(p, q):
    return np.einsum("ij,ij->i", p, q)


def unit(v):
    return v / np.sqrt(dot(v, v))[:, None]


def around(axis, cosine):
    """Directions at these cosines to the axis, at any angle around it."""
    across = rng.normal(size=axis.shape)
    across = unit(across - dot(across, axis)[:, None] * axis)
    return cosine[:, None] * axis + np.sqrt(1 - cosine**2)[:, None] * across


def lobe(x, wo, wi):
    """cosα of the glossy lobe, and where surfaces are glossy."""
    mirror = 2 * dot(x.normal, wo)[:, None] * x.normal - wo
    return np.maximum(dot(mirror, wi), 0), np.isnan(x.reflectance[:, 0]), mirror


def fs(x, wo, wi):
    cosine, glossy, _ = lobe(x, wo, wi)
    return np.where(glossy, gloss * (exponent + 2) / (2 * np.pi) * cosine**exponent, x.reflectance[:, 0] / np.pi)


def pdf_of_material(x, wo, wi):
    cosine, glossy, _ = lobe(x, wo, wi)
    return np.where(glossy, (exponent + 1) / (2 * np.pi) * cosine**exponent, np.maximum(dot(x.normal, wi), 0) / np.pi)


def by_material(x, wo):
    """Directions with the pdf of the material: the cosine on diffuse surfaces, the lobe on glossy ones."""
    _, glossy, mirror = lobe(x, wo, wo)
    u = rng.random(len(x))
    return around(np.where(glossy[:, None], mirror, x.normal), np.where(glossy, u ** (1 / (exponent + 1)), np.sqrt(u)))


cast = {"intersections": 0, "visibility": 0}


def trace(points, wi):
    """What rays from points hit first; counted."""
    cast["intersections"] += len(wi)
    return room.intersect(points, wi)


def visible(x, y, facing):
    """Whether x and y see each other, for pairs that face each other; only these rays are cast, and counted."""
    cast["visibility"] += facing.sum()
    seen = facing.copy()
    seen[facing] = room.visible(x[facing], y[facing])
    return seen


def on_rectangles(k, s, t):
    """Points of rectangles, s a and t b from their corners, as the scene has them: where a short ray onto them ends."""
    y = corner[k] + s[:, None] * a[k] + t[:, None] * b[k]
    return room.intersect(y + 1e-3 * normal[k], -normal[k])


# %% [markdown]
# Two of the ways need more. Uniform in the *solid angle* of the lamp: seen from a point at a distance $h$ from its plane, let $x$ and $y$
# be measured from the foot of the perpendicular. The rectangle from there to $(x, y)$ has a solid angle whose sine is
# $\frac{x}{\sqrt{x^2 + h^2}} \frac{y}{\sqrt{y^2 + h^2}}$. So with $\xi = \frac{x}{\sqrt{x^2 + h^2}}$ and
# $b_k = \frac{y_k}{\sqrt{y_k^2 + h^2}}$ the lamp from $x_0$ to $x$ has
#
# $$F(\xi) - F(\xi_0), \qquad F(\xi) = \arcsin \xi b_1 - \arcsin \xi b_0, \qquad
# F(\xi) = c \text{ where } \xi = \frac{\sin c}{\sqrt{b_0^2 + b_1^2 - 2 b_0 b_1 \cos c}},$$
#
# and along the cut at $x$ the sine of the elevation is uniform (Archimedes; the method is that of Ureña, Fajardo and King 2013).
#
# *Multiple importance sampling* (Veach and Guibas 1995): a coin decides between material and lamp, and the pdf is the mean of both,
# whichever of them was chosen.


# %%
def in_solid_angle(x, s=0.5, t=0.5):
    """The solid angle Ω of the lamp from points x, and the points of it, as shares of a and b, up to which s and t of Ω are."""
    lengths = np.linalg.norm([a[lamp], b[lamp]], axis=1)
    d = corner[lamp] - x
    h, x0, y0 = np.abs(d @ normal[lamp]), d @ a[lamp] / lengths[0], d @ b[lamp] / lengths[1]
    b0, b1 = y0 / np.hypot(y0, h), (y0 + lengths[1]) / np.hypot(y0 + lengths[1], h)

    ends = np.array([x0, x0 + lengths[0]]) / np.hypot([x0, x0 + lengths[0]], h)  # ξ there

    def F(xi):
        return np.arcsin(xi * b1) - np.arcsin(xi * b0)

    whole = F(ends[1]) - F(ends[0])
    c = F(ends[0]) + s * whole
    xi = np.clip(np.sin(c) / np.sqrt(b0**2 + b1**2 - 2 * b0 * b1 * np.cos(c)), *ends)  # rounding, where the lamp is seen edge on
    r = h / np.sqrt(1 - xi**2)  # of the cut, from the point
    sines = y0 / np.hypot(y0, r), (y0 + lengths[1]) / np.hypot(y0 + lengths[1], r)
    sine = sines[0] + t * (sines[1] - sines[0])
    shares = (xi * r - x0) / lengths[0], (r * sine / np.sqrt(1 - sine**2) - y0) / lengths[1]
    return whole, *np.clip(shares, 0, 1)


def follow(x, wo, wi, pdf):
    """Samples of bounce 1 by directions: the value, whether Le is not 0, and the same, for what a ray meets is visible."""
    met, cosine = trace(x, wi), np.maximum(dot(x.normal, wi), 0)
    lit = (met.emission[:, 0] > 0) & (cosine > 0)
    return np.divide(fs(x, wo, wi) * met.emission[:, 0] * cosine, pdf, where=lit, out=np.zeros(len(x))), lit, lit


def geometry(x, y):
    """The direction from x to y, and G without V: 0 where they do not face each other."""
    d = y.position - x.position
    wi = unit(d)
    return wi, np.maximum(dot(x.normal, wi), 0) * np.maximum(-dot(y.normal, wi), 0) / dot(d, d)


def join(x, wo, y, density):
    """Samples of bounce 1 by points: the value, whether Le is not 0, and whether x and y face and see each other as well."""
    wi, G = geometry(x, y)
    lit = (y.emission[:, 0] > 0) & (dot(y.normal, wi) < 0)
    seen = visible(x, y, lit & (G > 0))
    return np.where(seen, fs(x, wo, wi) * y.emission[:, 0] * G / density, 0), lit, seen


def hemisphere(x, wo):
    wi = around(x.normal, rng.random(len(x)))
    return follow(x, wo, wi, np.full(len(x), 1 / (2 * np.pi)))


def cosine(x, wo):
    wi = around(x.normal, np.sqrt(rng.random(len(x))))
    return follow(x, wo, wi, dot(x.normal, wi) / np.pi)


def by_the_material(x, wo):
    wi = by_material(x, wo)
    return follow(x, wo, wi, pdf_of_material(x, wo, wi))


def all_surfaces(x, wo):
    return join(x, wo, anywhere(len(x)), 1 / area.sum())


def lamp_area(x, wo):
    return join(x, wo, on_lamp(len(x)), 1 / area[lamp])


def lamp_solid_angle(x, wo):
    omega, s, t = in_solid_angle(x.position, rng.random(len(x)), rng.random(len(x)))
    y = on_rectangles(np.full(len(x), lamp), s, t)
    d = y.position - x.position
    return join(x, wo, y, np.abs(dot(y.normal, unit(d))) / dot(d, d) / omega)


def mis(x, wo):
    heads, y = rng.random(len(x)) < 0.5, on_lamp(len(x))
    wi = np.where(heads[:, None], by_material(x, wo), unit(y.position - x.position))
    facing = -wi @ normal[lamp]
    d2 = (dot(corner[lamp] - x.position, normal[lamp][None]) / facing) ** 2  # to the plane of the lamp
    value, _, seen = follow(x, wo, wi, (pdf_of_material(x, wo, wi) + d2 / (np.abs(facing) * area[lamp])) / 2)
    return value, seen | (~heads & (facing > 0)), seen


def anywhere(n):
    """Points uniform on all surfaces."""
    return on_rectangles(rng.choice(len(area), n, p=area / area.sum()), rng.random(n), rng.random(n))


def on_lamp(n):
    return on_rectangles(np.full(n, lamp), rng.random(n), rng.random(n))


ways = {
    "hemisphere": hemisphere,
    "cosine": cosine,
    "material": by_the_material,
    "all surfaces": all_surfaces,
    "lamp, area": lamp_area,
    "lamp, Ω": lamp_solid_angle,
    "MIS": mis,
}


def from_camera(res, spp, lamp_too):
    """Points that the camera sees, the directions towards it, and which of its rays have hit them."""
    rays = room_of(res).camera_rays(spp, seed=seed)
    x = room.seen(rays)
    able = x.hit & (lamp_too | (x.emission[:, 0] == 0))
    return x[able], -rays.direction[able], able


def by_pixels(found, able, spp):
    """Numbers of those rays as (numbers, pixels, spp), 0 for the others."""
    whole = np.zeros((len(found), len(able)))
    whole[:, able] = found
    return whole.reshape(len(found), spp, -1).transpose(0, 2, 1)


x, wo, able = from_camera(128, 4, lamp_too=False)  # the lamp does not see itself
shown = [by_pixels(way(x, wo), able, 4)[0].mean(axis=1).reshape(128, 128) for way in ways.values()]
converged = room_of(128).render(bounces=1, spp=32, seed=seed, quiet=True)
pictures([*shown, converged.terms[1]], [*ways, "render"], white=0.8, columns=4)
plt.show()

# %% [markdown]
# The figure: bounce 1, 4 samples a pixel. None of them is wrong.
#
# ## The variance, split by cause
# The value of a sample is 0 unless $L_e \ne 0$ (with probability $p$) and then $V = 1$ (with probability $q$); then it is $Y$, with mean
# $m$ and variance $s^2$. So $E = p\,q\,m$. The law of total variance, $\mathrm{Var}\,X = E[\mathrm{Var}(X|A)] + \mathrm{Var}(E[X|A])$, first
# with $A$ for "$L_e \ne 0$": $E[X|A]$ is $q m$ or 0, a coin that pays $qm$, with the variance $p(1-p)(qm)^2$. Then among the samples with
# $L_e \ne 0$ a coin that pays $m$, with $q(1-q)m^2$; and what is left varies by $s^2$:
#
# $$\mathrm{Var}\,X = \underbrace{p(1-p)\,q^2 m^2}_{L_e = 0} + \underbrace{p\,q(1-q)\,m^2}_{V = 0} + \underbrace{p\,q\,s^2}_{G,\,\cos\theta,\,f_s}
# = E^2\Bigl(\frac1p - 1\Bigr) + E^2\Bigl(\frac{1}{pq} - \frac1p\Bigr) + \Bigl(E[X^2] - \frac{E^2}{pq}\Bigr).$$
#
# The second form needs no $m$ and $s$, and its terms add up to $E[X^2] - E^2$ at sight. It holds for the samples at hand as it does for
# probabilities. $x$ is counted to the rest: it moves within its pixel.


# %%
def causes(value, *conditions):
    """The variance of each row of samples by cause: one for each condition, of which each implies the one before, and the rest."""
    E, share = value.mean(axis=1), [np.mean(met, axis=1) for met in conditions]
    inverse = [E**2] + [np.divide(E**2, s, where=s > 0, out=np.zeros(len(E))) for s in share]
    return np.array([*np.diff(inverse, axis=0), np.mean(value**2, axis=1) - inverse[-1]])


x, wo, able = from_camera(res, spp, lamp_too=False)
reached = exact.terms[1][..., 0].ravel() > 0  # where bounce 1 is not 0
glossy = by_pixels([np.isnan(x.reflectance[:, 0])], able, spp)[0].mean(axis=1) > 0.5
split, truth = {}, exact.run.bounces[1]
print("                                               diffuse: variance by    glossy: variance by")
print("               rays   Le = 0   V = 0 of others   Le      V    rest        Le      V   rest     mean, off by standard errors")
for name, way in ways.items():
    before = sum(cast.values())
    value, lit, unhidden = by_pixels(way(x, wo), able, spp)
    split[name], variance = causes(value, lit, unhidden), value.var(axis=1)
    np.testing.assert_allclose(split[name].sum(axis=0), variance, rtol=1e-11, atol=1e-12 * variance.max())
    off = (value.mean() - truth.mean) / np.hypot(np.sqrt(variance.mean() / value.size), truth.stderr)
    print(
        f"{name:12s} {(sum(cast.values()) - before) / len(x):6.3f} "
        f"{1 - lit[reached].mean():8.1%} {1 - unhidden.sum() / lit.sum():12.1%}     "
        + "".join(f"{abs(part):8.4f}" for part in split[name][:, ~glossy & reached].mean(axis=1))
        + "   "
        + "".join(f"{abs(part):7.3f}" for part in split[name][:, glossy & reached].mean(axis=1))
        + f"   {value.mean():.5f} {off:+.1f}"
    )
    assert abs(off) <= limit(truth.degrees_of_freedom), name  # seven, not quite normal: a false alarm in some 10 000 seeds
print(f"render{truth.mean:96.5f} ± {truth.stderr:.5f}")

# %%
figure, axes = plots(1, 2, sharey=True)
for axis, of, title in ((axes[0], ~glossy & reached, "diffuse surfaces"), (axes[1], glossy & reached, "the glossy wall")):
    parts = np.array([split[way][:, of].mean(axis=1) for way in ways])
    total, left = parts.sum(axis=1), np.zeros(len(ways))
    for part, name in zip(parts.T, ("$L_e = 0$", "$V = 0$", "the rest")):
        axis.barh(list(ways), 100 * part / total, left=left, label=name)
        left += 100 * part / total
    for k, V in enumerate(total):
        axis.text(98, k, f"{V:.2g}", ha="right", va="center", fontsize="small", color="white")
    axis.set(title=title, xlabel="share of the variance, %", xlim=(0, 100))
axes[0].invert_yaxis()
figure.suptitle(" \n ", fontsize="medium")  # room for the legend
figure.legend(*axes[0].get_legend_handles_labels(), loc="upper center", ncols=3)
plt.show()

figure, axes = plt.subplots(3, len(ways), figsize=(10, 4.9))
for column, way in zip(axes.T, ways):
    column[0].set_title(way, fontsize="small")
    for axis, part in zip(column, split[way]):
        shown = axis.imshow(np.sqrt(np.maximum(part, 1e-12)).reshape(res, res), norm=LogNorm(0.01, 10))
        axis.set(xticks=[], yticks=[])
for axis, name in zip(axes[:, 0], ("$L_e = 0$", "$V = 0$", "the rest")):
    axis.set_ylabel(name)
figure.colorbar(shown, ax=axes, label="root of the variance", fraction=0.03)
plt.show()

# %% [markdown]
# The figures: whose noise has which cause (white: the variance of a sample), and where it is (black: none). What Dutré's slides say of the
# three basic ways can be read off. Directions have no $V$ in them, and their noise is $L_e = 0$: 98 of 100 samples. Points of the lamp
# have no $L_e = 0$ (what is left of it are pixels of which a part sees the lamp from behind), and their noise on diffuse surfaces is $V$, in
# the half-shadow, and a little $G$; on the glossy wall it is $f_s$. Points of all surfaces have both. But *rays* say something else than
# samples: a sample whose $L_e$ is 0 costs no ray, so all surfaces cast one ray where the hemisphere casts more than fifty.
#
# **Q1.** Why does the solid angle have less noise than the area where both see the lamp whole? (A1: of $G$ it leaves $\cos\theta_x$ only.)
# **Q2.** On the glossy wall the material has next to no noise but $L_e = 0$. Why? And what would a perfect mirror have?
# **Q3.** In this room MIS is behind the lamp's two ways on both kinds of surface. What is it good for? (A3: the mean pdf is at least half of
# each, so $E[X^2]$ is at most twice that of *either* half, everywhere; of the halves alone, each has no such bound. Exercise 2.)
#
# ## Three generators, side by side
# Bounce 2 needs one more point: camera, $x$, $z$, $y$ on the lamp. It can be made from the *receiver* (a direction at $x$ leads to $z$, which
# asks the lamp; or goes on in a direction, and looks whether it meets the lamp), from the *source* (a ray from the lamp leads to $z$, which
# is joined to $x$), or from *surfaces* (any $z$, joined to both). And a path from the lamp can make both $z$ and $x$ and be joined to the
# lens: then it is the path that chooses the pixel. Each returns samples, and a code for what made a sample 0.

# %%
codes = ("brings light", "left the room", "Le = 0", "V = 0", "not on the film")
flux = 10 * np.pi * area[lamp]  # of the lamp: ∫∫ Le cosθ dω dA


def outcome(n, hit, lit, seen):
    """Codes for n samples, of which some have hit something, some of these meet Le, and some of these are seen."""
    code = np.ones(n, dtype=int)
    code[hit] = np.where(~lit, 2, np.where(~seen, 3, 0))
    return code


def on_all(n, hit, value):
    whole = np.zeros(n)
    whole[hit] = value
    return whole


def onward(x, wo):
    """One bounce by the material: which walks hit something, the points that they hit, the directions there, and fs cosθ / pdf."""
    wi = by_material(x, wo)
    z, cosine = trace(x, wi), dot(x.normal, wi)
    hit = z.hit & (cosine > 0)
    x, wo, wi, z = x[hit], wo[hit], wi[hit], z[hit]
    return hit, x, z, wi, fs(x, wo, wi) * cosine[hit] / pdf_of_material(x, wo, wi)


def from_lamp(n):
    """Rays from the lamp, with the pdf cosθ/π: which have hit something, where they start, what they hit, and from where."""
    y = on_lamp(n)
    wi = around(y.normal, np.sqrt(rng.random(n)))
    z = trace(y, wi)
    return z.hit, y[z.hit], z[z.hit], -wi[z.hit]


def receiver_asks(x, wo):
    hit, x, z, wi, weight = onward(x, wo)
    y = on_lamp(len(z))
    value, lit, seen = join(z, -wi, y, 1 / area[lamp])
    return on_all(len(wo), hit, weight * value), outcome(len(wo), hit, lit, seen), (hit, x, z, y)


def receiver_looks(x, wo):
    hit, x, z, wi, weight = onward(x, wo)
    along = by_material(z, -wi)
    value, lit, seen = follow(z, -wi, along, pdf_of_material(z, -wi, along))
    return on_all(len(wo), hit, weight * value), outcome(len(wo), hit, lit, seen), None


def source(x, wo):
    hit, y, z, back = from_lamp(len(x))
    wi, G = geometry(x[hit], z)
    seen = visible(x[hit], z, G > 0)
    value = flux * fs(z, back, -wi) * G * fs(x[hit], wo[hit], wi) * seen
    return on_all(len(x), hit, value), outcome(len(x), hit, seen | True, seen), (hit, x[hit], z, y)


def surfaces(x, wo):
    z, y, every = anywhere(len(x)), on_lamp(len(x)), np.ones(len(x), dtype=bool)
    wi, G = geometry(x, z)
    first = visible(x, z, G > 0)
    value = np.zeros(len(x))
    value[first], lit, second = join(z[first], -wi[first], y[first], 1 / area[lamp])
    seen = first.copy()
    seen[first] = second | ~lit
    facing = ~first
    facing[first] = lit
    return value * fs(x, wo, wi) * G * area.sum(), outcome(len(x), every, facing, seen), (every, x, z, y)


def to_lens(x, wo):
    n = len(x)
    made, y, z, back = from_lamp(n)
    hit, z, x, wi, weight = onward(z, back)
    made[made] = hit
    d = eye - x.position
    r = np.sqrt(dot(d, d))
    toward = d / r[:, None]
    film = toward[:, :2] / toward[:, 2:] / np.tan(np.radians(fov / 2)) * -1  # from −1 to 1: right, up
    inside = (np.abs(film) < 1).all(axis=1)
    p = 1 / (4 * np.tan(np.radians(fov / 2)) ** 2 * toward[:, 2] ** 3)  # the pdf of camera rays, per solid angle: the film is flat
    cosine = dot(x.normal, toward)
    seen = visible(x, np.broadcast_to(eye, (len(x), 3)), inside & (cosine > 0))
    value = flux * weight * fs(x, -wi, toward) * cosine * p / r**2 * seen
    code = outcome(n, made, seen | True, seen)
    code[np.flatnonzero(made)[~inside]] = 4
    return on_all(n, made, value), code, (film[seen], value[seen])


generators = {
    "receiver, asks": receiver_asks,
    "receiver, looks": receiver_looks,
    "source": source,
    "surfaces": surfaces,
    "to the lens": to_lens,
}
fine, each = 64, 64
x, wo, able = from_camera(fine, each, lamp_too=True)
truth, shown, made = exact.run.bounces[2], {}, {}
print("a path:          intersections  visibility", *(f"{code:>15s}" for code in codes), "  E v²/(E v)²   mean, off by")
for name, generator in generators.items():
    cast.update(intersections=0, visibility=0)
    value, code, path = made[name] = generator(x, wo)
    if name == "to the lens":
        v, (film, of) = value, path
        column, row = np.clip(((film * [1, -1] + 1) / 2 * fine).astype(int).T, 0, fine - 1)
        shown[name] = np.bincount(row * fine + column, of, fine**2).reshape(fine, fine) * fine**2 / len(v)
    else:
        v = on_all(len(able), able, value)  # of the camera's rays some have hit nothing
        shown[name] = v.reshape(each, fine, fine).mean(axis=0)
    off = (v.mean() - truth.mean) / np.hypot(v.std() / np.sqrt(len(v)), truth.stderr)
    print(
        f"{name:16s} {cast['intersections'] / len(x):13.2f} {cast['visibility'] / len(x):11.2f} "
        + "".join(f"{np.mean(code == k):16.1%}" for k in range(5))
        + f" {np.mean(v**2) / v.mean() ** 2:12.1f}   {v.mean():.5f} {off:+.1f}"
    )
    assert (code[value > 0] == 0).all()
    assert abs(off) <= limit(truth.degrees_of_freedom), name  # five, not quite normal: as above
exact_bounce_2 = room_of(fine).render(bounces=2, spp=32, seed=seed, quiet=True).terms[2]
pictures([*shown.values(), exact_bounce_2], [*shown, "render"], white=0.3)
plt.show()

# %% [markdown]
# The figure: bounce 2, 64 paths a pixel. In the table, $E\,v^2 / (E\,v)^2$ is the noise: $E\,v^2$ less the mean square of the picture is the
# variance of a sample of a pixel, for all five (a path to the lens is 0 in all pixels but one). Rays are those that were cast, without the
# camera's own: where a sample is known to be 0, $V$ is not asked. The lecture's table is right about what can be 0, and leaves out two
# things. Every ray can leave the room, if it is open. And two visibility terms are fewer rays than an intersection and a visibility: half of
# what surfaces propose is known to be 0 before the second is cast.
#
# **Q4.** The source has noise near edges, where $z$ is near $x$: $\frac{1}{d^2}$ has no bound there. If the walls touched, its variance would be
# infinite, as that of surfaces. Whose would not be? (A4: those that find $z$ and $x$ along a ray: the rays' pdf has the same $\frac{1}{d^2}$.)
#
# ## One path, as f(x)/p(x)
# In path space all generators are one: $\int f(\bar x)\, d\mu(\bar x) \approx f(\bar x) / p(\bar x)$ (Spanier and Gelbard; Veach). What a path
# $\bar x = (x, z, y)$ carries does not ask how it was made, and its pdf per area is a product over its points:
#
# $$f = f_s(x)\, G(x, z)\, f_s(z)\, G(z, y)\, L_e, \qquad
# p = \begin{cases}
# p_\omega(x \to z) \frac{\cos\theta_z}{|x-z|^2} \cdot \frac{1}{A_\text{lamp}} & \text{receiver, asks} \\
# p_\omega(x \to z) \frac{\cos\theta_z}{|x-z|^2} \cdot p_\omega(z \to y) \frac{\cos\theta_y}{|z-y|^2} & \text{receiver, looks} \\
# \frac{1}{A_\text{lamp}} \cdot \frac{\cos\theta_y}{\pi} \frac{\cos\theta_z}{|y-z|^2} & \text{source} \\
# \frac{1}{A} \cdot \frac{1}{A_\text{lamp}} & \text{surfaces}
# \end{cases}$$
#
# Here is a path that three of them made, from its positions, normals and materials alone, beside what the generator said.


# %%
def by_hand(position, normals, to_camera, of):
    """f of one path x, z, y, and its pdf in the four ways, in plain numbers; of: the material of x and z, None where it is glossy, else ρ."""
    steps = [position[k + 1] - position[k] for k in (0, 1)]
    d2 = [step @ step for step in steps]
    w = [to_camera] + [step / np.sqrt(r) for step, r in zip(steps, d2)]  # towards the camera, from x to z, from z to y
    leaves = [normals[k] @ w[k + 1] for k in (0, 1)]  # cosines at x and z, and where the steps end
    meets = [-normals[k + 1] @ w[k + 1] for k in (0, 1)]
    reflected, p_omega = [], []
    for k, wo in ((0, w[0]), (1, -w[1])):
        alpha = max((2 * (normals[k] @ wo) * normals[k] - wo) @ w[k + 1], 0)
        reflected.append(of[k] / np.pi if of[k] is not None else gloss * (exponent + 2) / (2 * np.pi) * alpha**exponent)
        p_omega.append(leaves[k] / np.pi if of[k] is not None else (exponent + 1) / (2 * np.pi) * alpha**exponent)
    G = [leaves[k] * meets[k] / d2[k] for k in (0, 1)]
    p = [p_omega[k] * meets[k] / d2[k] for k in (0, 1)]
    pdfs = {
        "receiver, asks": p[0] / area[lamp],
        "receiver, looks": p[0] * p[1],
        "source": 1 / area[lamp] * meets[1] / np.pi * leaves[1] / d2[1],
        "surfaces": 1 / area.sum() / area[lamp],
    }
    return reflected[0] * G[0] * reflected[1] * G[1] * 10, pdfs


print("made by                   f           p         f / p   the generator, over that    what the others would have as p")
for name in ("receiver, asks", "source", "surfaces"):
    value, code, (hit, *points) = made[name]
    number = np.flatnonzero(value > 0.001)[0]
    k = np.count_nonzero(hit[:number])
    rho = [float(q.reflectance[k, 0]) for q in points[:2]]
    f, pdfs = by_hand([q.position[k] for q in points], [q.normal[k] for q in points], wo[number], [None if np.isnan(r) else r for r in rho])
    print(
        f"{name:16s} {f:12.5g} {pdfs[name]:11.5g} {f / pdfs[name]:13.6g}   1 {value[number] * pdfs[name] / f - 1:+.0e}"
        + "        "
        + ", ".join(f"{other}: {p:.3g}" for other, p in pdfs.items() if other != name)
    )
    assert abs(value[number] * pdfs[name] / f - 1) < 1e-9

# %% [markdown]
# $f$ and $p$ alone mean little: they have units, and change with the scale of the room. $f/p$ is radiance. As $f$ is the same for all, a path
# that one way made can be weighted by the pdfs of all others, $w_i = p_i / \sum_j p_j$: then $\sum_i w_i \frac{f}{p_i}$, one sample of each
# way, has the right mean, because the $w_i$ of a path add up to 1. That is all of bidirectional path tracing (lesson 6 shows its ways).
# `neumann replay DIR --pixel X,Y --sample S` prints the same numbers for any path of a render.

# %% [markdown]
# ## One of several parts, of unequal size
# With several lamps one is chosen, and its sample is divided by the probability of that choice. Why is this right, whatever the lamps are
# like? Cut the domain of any integral into parts $D_i$, choose part $i$ with probability $p_i$, and a point in it uniformly. The sample is
# $X = f(x)\, |D_i| / p_i$, and
#
# $$E[X] = \sum_i p_i \int_{D_i} \frac{1}{|D_i|}\, f(x)\, \frac{|D_i|}{p_i}\, dx = \sum_i \int_{D_i} f(x)\, dx,
# \qquad E[X^2] = \sum_i \frac{|D_i|}{p_i} \int_{D_i} f(x)^2\, dx .$$
#
# $|D_i|$ and $p_i$ cancel one by one: neither has to be the same for all. Bikker cuts $[-2.5, 2.5]$ at 1, with $p = \frac12$ for both: samples
# count $3.5 \cdot 2$ or $1.5 \cdot 2$ times, and for $f = 1$ the mean is 5. But $f = 1$ is a weak check: who takes $2.5 \cdot 2$ for both,
# as if the parts were halves, gets 5 as well. The least variance has $p_i \propto \sqrt{|D_i| \int_{D_i} f^2}$.


# %%
def f(x):
    return 0.1 + np.exp(-2 * (x - 1.5) ** 2)


def moments(low, high):
    """∫f and ∫f² of a part."""
    return [scipy.integrate.quad(lambda x: f(x) ** k, low, high, epsabs=1e-12)[0] for k in (1, 2)]


count, whole = 20_000, moments(-2.5, 2.5)[0]
print(f"∫f = {whole:.5f}; {count} samples")
for name, cuts, p in (
    ("one part", [-2.5, 2.5], [1]),
    ("halves", [-2.5, 0, 2.5], [0.5, 0.5]),
    ("cut at 1", [-2.5, 1, 2.5], [0.5, 0.5]),
    ("cut at 1, by size", [-2.5, 1, 2.5], [0.7, 0.3]),
    ("cut at 1, best", [-2.5, 1, 2.5], None),
):
    sizes, squares = np.diff(cuts), np.array([moments(*part)[1] for part in zip(cuts, cuts[1:])])
    p = np.sqrt(sizes * squares) / np.sqrt(sizes * squares).sum() if p is None else np.array(p)
    part = rng.choice(len(p), count, p=p)
    samples = f(np.array(cuts)[part] + sizes[part] * rng.random(count)) * sizes[part] / p[part]
    variance = np.sum(sizes * squares / p) - whole**2
    off = (samples.mean() - whole) / np.sqrt(variance / count)
    as_halves = np.sum(0.5 * np.array([moments(*c)[0] for c in zip(cuts, cuts[1:])]) / sizes * 5)
    print(
        f"{name:18s} p = {', '.join(f'{q:.2f}' for q in p):10s}  mean {samples.mean():.4f} ({off:+.1f})  variance {variance:6.3f}"
        + (f"   as if the parts were halves: {as_halves:.4f}" if name == "cut at 1" else "")
    )
    assert abs(off) <= limit(), name  # five: a false alarm in 30 000 seeds

# %% [markdown]
# ## The solid angle, and what stands for it
# "The pdf is $1/\Omega$" is often written with $\Omega \approx A \cos\theta_y / d^2$, $\theta_y$ and $d$ being those of the lamp's middle.
# Is that wrong, or slower? It depends on where it stands. As a **probability**, of choosing this lamp and not another, it may be anything
# that is not 0 where there is light: the sample is divided by it, and it cancels (the section above). As a **value** it does not cancel.
# Four ways to the irradiance $\int \cos\theta_x\, d\omega$ of a lamp of radiance 1:
#
# | $y$ is uniform in | what is averaged | |
# | --- | --- | --- |
# | area | $\cos\theta_x \cdot A \cos\theta_y / d^2$ at the sampled $y$ | right: this *is* the form over points, no approximation |
# | solid angle | $\cos\theta_x \cdot \Omega$ | right |
# | area | $\cos\theta_x \cdot \Omega$ | biased: the directions are not uniform in $\Omega$ |
# | area | $\cos\theta_x \cdot A \cos\theta_y / d^2$ of the middle | biased |
#
# What the last two tend to is known: the mean of $\cos\theta_x$ over the lamp, times a constant.

# %%
heights, n, side = np.geomspace(0.06, 4, 10), 20_000, np.linalg.norm(a[lamp])
grid = (np.arange(300) + 0.5) / 300
s, t = (g.ravel() for g in np.meshgrid(grid, grid))


def seen_from(x, s, t):
    """cosθx and A cosθy / d² for points of the lamp, from a floor at x."""
    d = corner[lamp] + np.multiply.outer(s, a[lamp]) + np.multiply.outer(t, b[lamp]) - x
    up = d[..., 1] / np.sqrt((d**2).sum(axis=-1))  # the lamp is horizontal: both cosines
    return up, area[lamp] * up / (d**2).sum(axis=-1)


names = ("area, $A\\cos\\theta_y/d^2$ of $y$", "solid angle, $\\Omega$", "area, $\\Omega$", "area, $A\\cos\\theta_y/d^2$ of the middle")
expected, measured, errors, inverted, truths = [], [], [], [], []
for h in heights:
    x = corner[lamp] + 0.6 * a[lamp] + 0.7 * b[lamp] - [0, h, 0]
    omega = in_solid_angle(x[None])[0][0]
    up, angle = seen_from(x, s, t)
    middle = seen_from(x, 0.5, 0.5)[1]
    truths.append(np.mean(up * angle))
    assert abs(np.mean(angle) / omega - 1) < 1e-3  # two ways to the solid angle: midpoints, and the arc sines
    expected.append(np.array([truths[-1], truths[-1], up.mean() * omega, up.mean() * middle]))
    inverted.append(up.mean() / middle)
    up, angle = seen_from(x, rng.random(n), rng.random(n))
    up_in_omega = seen_from(x, *in_solid_angle(np.broadcast_to(x, (n, 3)), rng.random(n), rng.random(n))[1:])[0]
    values = np.array([up * angle, up_in_omega * omega, up * omega, up * middle])
    measured.append(values.mean(axis=1))
    errors.append(values.std(axis=1, ddof=1) / np.sqrt(n))
truths, expected, measured, errors = np.array(truths), np.array(expected), np.array(measured), np.array(errors)
assert (np.abs(measured - expected) <= limit() * errors + 1e-3 * expected).all()  # forty: a false alarm in 3000 seeds; the midpoints' error
figure, axes = plots(1, 2, height=0.62)
for k, name in enumerate(names):
    axes[0].errorbar(heights / side, measured[:, k] / truths, 2 * errors[:, k] / truths, fmt="o", ms=5, capsize=2, label=name, color=f"C{k}")
    axes[0].plot(heights / side, expected[:, k] / truths, color=f"C{k}", lw=1.5)
axes[0].set(xscale="log", xlabel="height of the lamp over its side", title="mean over the truth")
axes[0].legend(fontsize="x-small")
axes[1].loglog(heights / side, truths, label="irradiance")
axes[1].loglog(heights / side, expected[:, 3], "--", label="$\\Omega$ of the middle")
axes[1].loglog(heights / side, inverted, ":", label="$1/\\Omega$ for $\\Omega$")
axes[1].set(xlabel="height of the lamp over its side", title="irradiance under the lamp")
axes[1].legend(fontsize="x-small")
plt.show()
off = expected[:, 3] / truths - 1
print("solid angle of the middle for Ω:", *(f"{h / side:.2g} sides away {o:+.1%}" for h, o in zip(heights, off)), sep="\n   ")
assert off.max() > 0.5 and off[0] < -0.3 and abs(off[-1]) < 0.01
assert (np.diff(truths[heights > side]) < 0).all() and (np.diff(inverted)[heights[1:] > side] > 0).all()

# %% [markdown]
# The figures: lines are expectations, points are 20 000 samples with 95% bars. Four sides away the two wrong values are off by a per cent or
# so. At half a side the middle's solid angle is half too large, at a tenth of a side it is a third too small (and straight under the middle
# $A / d^2$ has no bound). More samples do not help: it is a bias. Right: who multiplies by $1/\Omega$ where $\Omega$ belongs (a sample is
# *divided* by the pdf $1/\Omega$) has light that grows with distance, which is how one notices.
#
# Now the same approximation as a probability, for two lamps: one close above a point, near its corner, so that the guess is too small by
# far, and one farther off that is bright. Points on them are uniform in solid angle; what is left to choose is the lamp.

# %%
near_one = corner[lamp] + 0.9 * a[lamp] + 0.9 * b[lamp] - [0, 0.05, 0]
lamps, radiance = np.array([near_one, near_one - [0.9, 1.1, 0.6]]), np.array([1, 30])  # where the point is, as the lamps see it
up, angle = (np.array(of) for of in zip(*(seen_from(at, s, t) for at in lamps)))
omega, contribution = in_solid_angle(lamps)[0], radiance * np.mean(up * angle, axis=1)
second = radiance**2 * omega * np.mean(up**2 * angle, axis=1)  # ∫f² times the size of the part, as above
guess = radiance * [seen_from(at, 0.5, 0.5)[1] for at in lamps]
print(f"irradiances {contribution.round(3)}; radiance × solid angle {(radiance * omega).round(3)}, by that of the middle {guess.round(3)}")
for name, weight in (
    ("each alike", [1, 1]),
    ("by the middle's solid angle", guess),
    ("by the solid angle", radiance * omega),
    ("by the irradiance", contribution),
    ("best", np.sqrt(second)),
):
    p = np.array(weight) / np.sum(weight)
    chosen = rng.choice(2, n, p=p)
    size, *at = in_solid_angle(lamps[chosen], rng.random(n), rng.random(n))
    values = radiance[chosen] / p[chosen] * size * seen_from(lamps[chosen], *at)[0]
    variance = np.sum(second / p) - contribution.sum() ** 2
    off = (values.mean() - contribution.sum()) / np.hypot(np.sqrt(variance / n), 1e-3 * contribution.sum())
    print(f"{name:28s} p = {p.round(3)}   mean {values.mean():.4f} ({off:+.1f})   variance {variance:8.3f}")
    assert abs(off) <= limit(), name  # five, of which the midpoints' error is a part: a false alarm in 30 000 seeds

# %% [markdown]
# The mean stays, the variance does not: as a probability a wrong solid angle is slower, never wrong. One thing it must not be: 0 where light
# comes from. $\cos\theta_y$ of a flat lamp is safe, for all its points face $x$ or none. But whoever puts $\cos\theta_x$ of the middle into
# the weight has a lamp whose middle is below the horizon never chosen, though half of it shines on $x$; and that is biased again.
#
# ## Exercises
# 1. Predict the share of $L_e \ne 0$ of the hemisphere for a point of the floor from the lamp's solid angle there. Check it.
# 2. Set `exponent` to 2000. Which way is best on the glossy wall now, and what is left of "lamp, area" there? (Some ways now need more
#    samples than there are for their error bars to be worth anything: which?)
# 3. Let the walls touch: set all 0.9 to 1, and move left, right and back to 1. Repeat "source" with ten seeds. What does its standard
#    error do, and does the mean stay within it?
# 4. Give MIS a coin that shows heads in one of ten. Split its variance by cause: which part grows, which falls?
# 5. Write the generator that makes $z$ from the lamp *and* $x$ from the camera, weighted with "receiver, asks" by $p_i / \sum_j p_j$. Where in
#    the picture is it better than both?
