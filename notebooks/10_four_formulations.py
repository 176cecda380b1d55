# %% [markdown]
# # 10. Four formulations of one equation
#
# **What this teaches.** The rendering equation can be written about the light that leaves a point or about the light that arrives,
# as an integral over directions or over surfaces, and for radiance or for importance. You will take the operators $T$ and $R$ in
# hand as functions of functions, look up from a point at all that arrives there, run all formulations, and see that they agree: in
# matrices to rounding, in random walks within their errors.

# %%
from lesson import limit, pictures, plots, radiance_unit, scene, seed, srgb
import matplotlib.pyplot as plt
import numpy as np
import scipy.sparse
import neumann

rng = np.random.default_rng(seed)

# %% [markdown]
# ## Operators are functions of functions
# A field is a function $f(x, \omega)$ of a point and of a direction that points away from it. In Python `f(x, w)` takes $n$ points
# and $n$ directions at once, and returns $n$ colours. An operator takes a field and returns a field:
#
# $$(T f)(x, \omega) = f(\mathrm{tr}(x, \omega), -\omega), \qquad
# (R g)(x, \omega_o) = \int f_s(x, \omega_i \to \omega_o)\, g(x, \omega_i) \cos\theta_i \, d\omega_i .$$
#
# `scene.T` is the first: it traces a ray. `scene.R()` is the second: an integral, estimated by directions with the pdf
# $\cos\theta / \pi$. And `(R @ T)(f)` is `R(T(f))`.

# %%
box = scene("cornell-box", res=96)
T, R, Le = box.T, box.R(seed=rng), box.Le
K = R @ T
rays = [box.camera_rays(seed=1000 * seed + k) for k in range(16)]
eye, away = (np.concatenate([r[name] for r in rays]) for name in ("origin", "direction"))
x = box.seen(rays[0])  # Points
back = -rays[0].direction
print(f"{K} makes of Le a function whose values at {len(x)} points are an array {K(Le)(x, back).shape}")

one = lambda y, w: np.ones((len(y), 3))
assert (R(one)(x[x.hit], back[x.hit]) == x.reflectance[x.hit]).all(), "equal light from everywhere: what leaves is the reflectance"
f, g = Le, lambda y, w: w**2 + y.hit[:, None]
both = lambda y, w: 2 * f(y, w) + g(y, w)
p, w = x[x.hit], back[x.hit]
for A in (lambda: T, lambda: box.R(seed=seed), lambda: box.R(seed=seed) @ T):  # R with the same random numbers each time
    assert np.allclose(A()(both)(p, w), 2 * A()(f)(p, w) + A()(g)(p, w), rtol=0, atol=1e-12)

# %% [markdown]
# Both are linear. $K L_e$ waits for directions that meet the lamp, as in lesson 1. Points *on* the lamp do better, and that is a
# field, too: `direct` below is $K L_e$ as an integral over the lamp's surface. All that is reflected is then
# $K L_e + K (K L_e + K (K L_e + \dots))$, which in Python is as long as on paper.


# %%
def direct(y, w):
    """K Le: ρ/π ∫ Le V G dA over the lamps, by one point on them for each y."""
    L = np.zeros((len(y), 3))
    p = y[y.hit]
    z = box.sample_lights(p, rng.random((len(p), 2)))
    cosine = np.maximum(np.sum(p.normal * z.direction, axis=1), 0) * box.visible(p, z)
    L[y.hit] = p.reflectance / np.pi * z.weight * cosine[:, None]  # weight: Le over the pdf per solid angle
    return L


def plus(f, g):
    return lambda y, w: f(y, w) + g(y, w)


reflected = direct
for _ in range(4):
    reflected = plus(direct, K(reflected))  # K Le + … + K⁵ Le
pictures_of = [T(f)(eye, away).reshape(16, 96, 96, 3) for f in (Le, reflected)]
seen = sum(pictures_of).mean(axis=0)

means = pictures_of[1].mean(axis=(1, 2, 3))
error, known = means.std(ddof=1) / 4, 0.054234
z = (means.mean() - known) / error
print(f"mean of bounces 1 to 5: {means.mean():.6f} ± {error:.6f}, known {known}, {z:+.1f} standard errors")
assert abs(z) <= limit(15) and error < 0.01 * known

# %% [markdown]
# The known mean is that of scenes/cornell-box/README.md. The same lines have made a picture: the camera is a point in space, and
# what arrives there, $T(L)(\text{eye}, \omega)$, is what it sees.
#
# ## Look up from a point
# The same function answers at any point. Take one on the floor, near the foot of the tall box, and ask what arrives from all
# directions of its hemisphere. A direction is drawn where it lies seen from above, so the hemisphere becomes a *disc*, with the
# horizon as its rim. That is more than a drawing: on the disc equal areas are equal *projected* solid angles $\cos\theta\, d\omega$
# (Nusselt), so that the light that the point reflects is
#
# $$(R g)(x, \omega_o) = \frac{\rho}{\pi} \int g \cos\theta\, d\omega = \rho \cdot \text{the mean of the disc} .$$

# %%
place = x[[84 * 96 + 30]]
n, samples = 96, 16


def cells(width, height):
    """A random point (u, v) in each cell of the unit square, v downwards, for each sample."""
    corner = np.stack(np.meshgrid(np.arange(width), np.arange(height)), axis=-1)
    return (corner + rng.random((samples, height, width, 2))) / [width, height]


def at(place, g, w):
    """g(x, ω) at one place for directions of any shape (…, 3)."""
    return g(place[np.zeros(w[..., 0].size, dtype=int)], w.reshape(-1, 3)).reshape(w.shape)


def disc(g):
    """What arrives, (n, n, 3), above is away from the camera; and the mean of the disc, once for each set of samples."""
    u = 2 * cells(n, n) - 1
    inside = np.sum(u**2, axis=-1) < 1
    w = np.stack([-u[..., 0], np.sqrt(np.maximum(1 - np.sum(u**2, axis=-1), 0)), -u[..., 1]], axis=-1)  # x runs to the left
    L = np.zeros(w.shape)
    L[inside] = at(place, g, w[inside])
    return L.mean(axis=0), L.sum(axis=(1, 2)) / inside.sum(axis=(1, 2))[:, None]


(from_lamp, lamp_mean), (from_room, room_mean) = disc(T(Le)), disc(T(reflected))
figure, axes = plots(1, 2, height=0.5)
axes[0].imshow(srgb(seen, 0.6))
axes[0].plot(30, 84, "+", color="white", markersize=22, markeredgewidth=2)
axes[1].imshow(srgb(from_lamp + from_room, 0.6))
for axis, title in zip(axes, ("what the camera sees", "what arrives at the cross")):
    axis.set_title(title, fontsize="medium")
    axis.axis("off")
figure.supxlabel(f"white: 0.6 {radiance_unit}", fontsize="small")
plt.show()

# %% [markdown]
# The figure: left the picture, made by $T(L)$ at the eye; right the hemisphere over the cross, made by $T(L)$ there. Left is left
# of the camera and above is away from it. **Q1.** What is the white patch, why has it a corner cut off, and what is the black part?
#
# The lamp is all that is bright, and all that is direct: with $L = L_e + K L$ what arrives is $T L = T L_e + T K L$.

# %%
def panorama(g):
    """What arrives, (48, 192, 3), by compass: the middle is away from the camera, the lower edge is the horizon."""
    u = cells(192, 48)
    azimuth, height = (2 * u[..., 0] - 1) * np.pi, (1 - u[..., 1]) * np.pi / 2
    w = np.stack([-np.sin(azimuth) * np.cos(height), np.sin(height), np.cos(azimuth) * np.cos(height)], axis=-1)
    return at(place, g, w).mean(axis=0)


panoramas = [panorama(T(f)) for f in (Le, reflected)]
parts = [(from_lamp, panoramas[0]), (from_room, panoramas[1]), (from_lamp + from_room, sum(panoramas))]
figure, axes = plt.subplots(3, 2, figsize=(10, 8.4), gridspec_kw={"width_ratios": [1, 2.6]})
for row, (round_, long), title in zip(axes, parts, ("direct, $T L_e$", "indirect, $T K L$", "all, $T L$")):
    row[0].imshow(srgb(round_, 0.6))
    row[0].axis("off")
    row[0].set_title(title, fontsize="medium")
    row[1].imshow(srgb(long, 0.6), extent=(-180, 180, 0, 90), aspect=1.2)
    row[1].grid(False)
    row[1].set(xticks=(-180, -90, 0, 90, 180), yticks=(0, 45, 90), ylabel="height, °")
axes[2, 1].set_xlabel("azimuth, °: 0 is away from the camera, 90 to its right")
plt.show()

# %% [markdown]
# The figure: the hemisphere as a disc and as a map of latitude and longitude, its parts and their sum at one exposure. The map has
# no rim and shows the horizon best; near 90° it draws a point as a line. (A1: the lamp; the tall box stands before it; the room is
# open towards the camera.)
#
# The mean of the first disc is direct light as an integral over *directions*. `direct` is the same as an integral over the
# *surface* of the lamp.

# %%
rho = place.reflectance[0]
over_directions = (rho * lamp_mean).mean(axis=1)
over_surface = direct(place[np.zeros(20000, dtype=int)], None).mean(axis=1)
estimates = [(v.mean(), v.std(ddof=1) / np.sqrt(len(v))) for v in (over_directions, over_surface)]
for title, (mean, error) in zip(("directions", "the lamp"), estimates):
    print(f"direct light that leaves the cross, over {title}: {mean:.5f} ± {error:.5f}")
assert abs(estimates[0][0] - estimates[1][0]) <= limit(15) * np.hypot(estimates[0][1], estimates[1][1])
bright = lamp_mean[:, 0].mean() / from_lamp[..., 0].max()
share = np.mean(rho * room_mean) / estimates[1][0]
print(f"the lamp fills {bright:.1%} of the disc; all else brings {share:.0%} of what the lamp brings")

# %% [markdown]
# ## Four formulations
# So there are two choices. Write $L^{\to}$ for what leaves, exitant radiance, and $L^{\leftarrow} = T L^{\to}$ for what arrives,
# incident radiance. And $R$ is an integral over directions, or over surfaces, where $d\omega \cos\theta_x = V G\, dA$ with the
# visibility $V$ and $G = \cos\theta_x \cos\theta_y / \|x - y\|^2$:
#
# | | over directions: a ray for each | over surfaces: a test of visibility for each |
# | --- | --- | --- |
# | exitant | $L^{\to} = L_e + R\,T L^{\to}$ | the same with $\int f_s\, V\, G\, L^{\to}(y \to x)\, dA(y)$ |
# | incident | $L^{\leftarrow} = T L_e + T R\, L^{\leftarrow}$ | likewise |
#
# All four hold for *importance*, too. A detector reads $\Phi = \langle L^{\leftarrow}, W_e^{\to} \rangle$; $W_e^{\to}$ is the
# importance that it gives off. How much $\Phi$ grows with light that arrives at $x$ from $\omega$ is $W^{\to}(x, \omega)$; with
# light that leaves it, $W^{\leftarrow}$:
#
# $$W^{\to} = W_e^{\to} + R^* T^*\, W^{\to}, \qquad W^{\leftarrow} = T^* W^{\to} = T^* W_e^{\to} + T^* R^*\, W^{\leftarrow} .$$
#
# Now $(R T)^* = T^* R^*$: adjoint to *exitant* radiance is *incident* importance, and to incident radiance exitant importance. The
# detector's reading has four forms:
#
# $$\Phi = \langle L^{\to}, W_e^{\leftarrow} \rangle = \langle L_e, W^{\leftarrow} \rangle
# = \langle L^{\leftarrow}, W_e^{\to} \rangle = \langle T L_e, W^{\to} \rangle .$$
#
# **Q2.** Which of them is path tracing, which light tracing? (A2: the third, where $L^{\leftarrow}$ is found by walks from the
# detector; the second, if $W^{\leftarrow}$ is found by walks from the lamp.) **Q3.** Dutré starts from $W_e^{\leftarrow}$ and says
# $W_e^{\to} = T W_e^{\leftarrow}$. What does that need? (A3: that each ray to the detector goes on to a surface, $T T^* = I$. With
# the pinhole of the Cornell box, whose front is open, it gives 0.)
#
# ## In matrices: to rounding
# `cube` has form factors by integrals over surfaces: $T = F$ and $R = \mathrm{diag}(\rho)$. `matrices` of a furnace, which is a
# cube, has them by rays, and there what arrives has a value for each ray: $T$ and $R$ are not square. The adjoints are those of the
# measures $m$ of what leaves and $m'$ of what arrives: $T^* = m^{-1} T^{\mathsf T} m'$, $R^* = m'^{-1} R^{\mathsf T} m$. The
# ceiling is the lamp, and the detector reads the mean of what arrives at the floor.


# %%
def four(T, R, Le, We, m, arriving, bounces=6):
    """⟨L→, We←⟩, ⟨Le, W←⟩, ⟨L←, We→⟩ and ⟨Le←, W→⟩ of each bounce, and the sums of the four fields."""
    T_star = scipy.sparse.diags(1 / m) @ T.T @ scipy.sparse.diags(arriving)
    R_star = scipy.sparse.diags(1 / arriving) @ R.T @ scipy.sparse.diags(m)
    first = {"L→": Le, "W←": T_star @ We, "L←": T @ Le, "W→": We}
    step = {
        "L→": lambda f: R @ (T @ f),
        "W←": lambda f: T_star @ (R_star @ f),
        "L←": lambda f: T @ (R @ f),
        "W→": lambda f: R_star @ (T_star @ f),
    }
    term, readings, sums = dict(first), [], dict.fromkeys(first, 0.0)
    for _ in range(bounces):
        pairs = ("L→", "W←", m), ("W←", "L→", m), ("L←", "W→", arriving), ("W→", "L←", arriving)
        readings.append([np.sum(measure * term[one] * first[other]) for one, other, measure in pairs])
        sums = {name: sums[name] + term[name] for name in first}
        term = {name: step[name](term[name]) for name in first}
    return np.array(readings), sums


cube = neumann.cube(8)
by_face = np.array([0.5, 0.5, 0.8, 0.3, 0.6, 0.7])  # reflectances of x = 0, 1; y = 0, 1; floor, ceiling
detector = cube.face == 4
F, rho = scipy.sparse.csr_matrix(cube.F), scipy.sparse.diags(by_face[cube.face])
surfaces, fields = four(F, rho, (cube.face == 5) * 1.0, detector / cube.area[detector].sum(), cube.area, cube.area)


def by_rays(seed):
    made = scene("furnace", albedo=0.5).matrices(patches=384, directions=64, seed=seed, quiet=True)
    normal = made.patches
    face = np.stack([normal["nx"], -normal["nx"], normal["ny"], -normal["ny"], normal["nz"], -normal["nz"]]).argmax(axis=0)
    detector = np.repeat(face == 4, 64)  # by the ray
    rho = scipy.sparse.diags(by_face[face] / 0.5)
    We = detector / made.ray_measure[detector].sum()
    return four(made.T, rho @ made.R, (face == 5) * 1.0, We, made.measure, made.ray_measure)[0]


directions = np.array([by_rays(16 * seed + k) for k in range(16)])
print("bounce   ⟨L→, We←⟩        ⟨Le, W←⟩         ⟨L←, We→⟩        ⟨Le←, W→⟩")
for what, rows in (("over surfaces", surfaces), ("over directions, of 16 seeds the first", directions[0])):
    print(what)
    for i, row in enumerate(rows):
        print(f"{i:6d}  " + "".join(f"{value:17.13f}" for value in row))
        assert np.ptp(row) <= 1e-13 * row.max()
mean, error = directions[:, :, 0].mean(axis=0), directions[:, :, 0].std(axis=0, ddof=1) / 4
print("over directions, all:", *(f"{m:.6f} ± {e:.6f}" for m, e in zip(mean, error)))
assert np.isclose(surfaces[0, 0], 0.1998249, rtol=0, atol=1e-7), "the form factor of opposite faces of a cube"
assert abs(mean[0] - surfaces[0, 0]) <= limit(15) * error[0] and error[0] < 0.01 * mean[0]

# %%
figure, axes = plots(1, 4, height=0.3)
for axis, name in zip(axes, ("L→", "L←", "W→", "W←")):
    wall = fields[name][cube.face == 3].reshape(8, 8).T  # the ceiling is above
    axis.imshow(wall, origin="lower", vmin=0)
    axis.set(xticks=[], yticks=[])
    axis.set_title(f"{name}, up to {wall.max():.2g}", fontsize="medium")
    axis.grid(False)
plt.show()

# %% [markdown]
# The table: each row is one bounce. In a row the four agree to rounding, for they are one product of matrices with its brackets set
# in four ways. The two halves agree within the errors of the rays where the form factor is all there is to know, in bounce 0; later
# bounces differ by the size of the patches, too.
#
# The figure: the four fields on a wall, summed up over six bounces. What arrives there comes from the ceiling; importance comes
# from the floor. What leaves is the wall's 0.3 of what arrives, for radiance and for importance: $L^{\to} = \rho L^{\leftarrow}$
# where nothing is given off. **Q4.** Which of them tells what a lamp on this wall would bring to the detector? (A4:
# $W^{\leftarrow}$, times its $L_e$.)
#
# ## In walks: within errors
# Now as functions. Panels float free of each other, with a large lamp above them, and the front of the floor is the detector: it
# reads its irradiance in W·m⁻². (Where panels touch, $G$ grows without bound, and the form over surfaces has infinite variance.)

# %%
panels = {  # centre, a point straight before it, half width, half height, reflectance
    "floor": ((0, 0, 0), (0, 0, 1), 1.2, 1.2, (0.75, 0.75, 0.75)),
    "back": ((0, 1.6, 0.9), (0, 0, 0.9), 0.7, 0.6, (0.75, 0.75, 0.75)),
    "left": ((-1.6, 0, 0.9), (0, 0, 0.9), 0.7, 0.6, (0.65, 0.15, 0.1)),
    "table": ((0.2, -0.1, 0.5), (0.3, -0.2, 1.5), 0.4, 0.4, (0.15, 0.3, 0.65)),
    "lamp": ((0, 0, 1.6), (0, 0, 0), 1.2, 1.2, (0.5, 0.5, 0.5)),
}
frames, shapes = {}, {}
for name, (centre, before, a, b, reflectance) in panels.items():
    frames[name] = neumann.look_at(centre, before, up=(0.1, 1, 0.2)) @ np.diag([a, b, 1, 1])
    white = {"type": "diffuse", "reflectance": {"type": "rgb", "value": reflectance}}
    shapes[name] = {"type": "rectangle", "to_world": frames[name], "bsdf": {"type": "twosided", "bsdf": white}}
shapes["lamp"]["emitter"] = {"type": "area", "radiance": {"type": "rgb", "value": (4, 4, 3)}}
film = {"type": "hdrfilm", "width": 1, "height": 1, "rfilter": {"type": "box"}}
shapes["floor"]["meter"] = {"type": "irradiancemeter", "film": film}
room = neumann.load_dict({"type": "scene", **shapes})
truth = room.render(bounces=2, spp=262144, method="walk", sampler="independent", seed=seed, quiet=True).run.bounces
print("irradiance of the floor by render:", *(f"{b.mean:.5f} ± {b.stderr:.5f}" for b in truth))

# %% [markdown]
# Two functions make points: `on` a panel's front, and `anywhere` on both sides of all panels, by area. `over_surfaces` is the other
# $R$: a point $y$ anywhere on the side that $x$ faces, and $V G$, in place of a direction.

# %%
matrix = np.stack(list(frames.values()))
area = np.array([4 * a * b for _, _, a, b, _ in panels.values()])


def places(which):
    """Positions on panels, uniform by area, and their normals."""
    u = np.column_stack([rng.uniform(-1, 1, (len(which), 2)), np.zeros(len(which)), np.ones(len(which))])
    return np.einsum("nij,nj->ni", matrix[which], u)[:, :3], matrix[which, :3, 2]


def sides(positions, normals):
    """Points on the side of these normals: rays find them from close by."""
    return room.intersect(positions + 0.01 * normals, -normals)


def on(name, count):
    return sides(*places(np.full(count, list(panels).index(name))))


def anywhere(count):
    positions, normals = places(rng.choice(len(area), count, p=area / area.sum()))
    return sides(positions, normals * rng.choice([-1, 1], (count, 1)))


def over_surfaces(g):
    def leaving(x, w):
        L = np.zeros((len(x), 3))
        x_on, here = x[x.hit], np.flatnonzero(x.hit)
        positions, normals = places(rng.choice(len(area), len(here), p=area / area.sum()))
        apart = positions - x_on.position
        distance = np.linalg.norm(apart, axis=1)
        wi = apart / distance[:, None]
        facing = np.sum(normals * wi, axis=1)
        y = sides(positions, np.where(facing > 0, -1, 1)[:, None] * normals)
        G = np.maximum(np.sum(x_on.normal * wi, axis=1), 0) * np.abs(facing) / distance**2
        kernel = G * room.visible(x_on, y) * area.sum() / np.pi  # V G over the pdf, and fs but for ρ
        lit = kernel > 0
        L[here[lit]] = x_on.reflectance[lit] * kernel[lit, None] * g(x_on[lit], wi[lit])
        return L

    return leaving


# %% [markdown]
# The fields $L_e$ and $W_e^{\to}$, and what $R$ and $T$ make of them: in functions $T^* = T$ and $R^* = R$, since rays go both ways
# and materials are reciprocal. An inner product $\iint f\, g \cos\theta\, d\omega\, dA$ is estimated from points where one of the
# two may not be 0 and directions by their cosine: the mean of $f g$ times $\pi$ and the area.


# %%
T, Le, floor = room.T, room.Le, list(panels).index("floor")


def We(x, w):
    """The floor's front gives off 1/A: then the reading is irradiance."""
    return np.repeat(((x.shape == floor) & (x.normal[:, 2] > 0))[:, None] / area[floor], 3, axis=1)


def inner(f, g, x, total):
    """Samples of ⟨f, g⟩ from points that are spread over an area, (n, 3)."""
    sphere = rng.normal(size=(len(x), 3))
    w = x.normal + sphere / np.linalg.norm(sphere, axis=1, keepdims=True)  # pdf cosθ/π
    w /= np.linalg.norm(w, axis=1, keepdims=True)
    value = np.array(f(x, w))
    some = np.flatnonzero(value.any(axis=1))  # where the first is 0, the second is not asked
    value[some] *= g(x[some], w[some])
    return value * np.pi * total


names = "⟨L→, We←⟩", "⟨Le, W←⟩", "⟨L←, We→⟩", "⟨Le←, W→⟩"
count, estimates = 80000, []
for R in (room.R(seed=rng), over_surfaces):
    L, W = Le, We
    for i in range(3):
        samples_of = [
            inner(T(We), L, anywhere(count), 2 * area.sum()),
            inner(Le, T(W), on("lamp", count), area[-1]),
            inner(We, T(L), on("floor", count), area[floor]),
            inner(T(Le), W, anywhere(count), 2 * area.sum()),
        ]
        means = np.array([v.mean(axis=1) for v in samples_of])
        estimates.append((means.mean(axis=1), means.std(axis=1, ddof=1) / np.sqrt(count)))
        L, W = R(T(L)), R(T(W))  # one bounce more
estimates = np.array(estimates).reshape(2, 3, 2, 4)  # R, bounce, mean or error, form
known, known_error = (np.array([b[name] for b in truth])[None, :, None] for name in ("mean", "stderr"))
z = (estimates[:, :, 0] - known) / np.hypot(estimates[:, :, 1], known_error)
for k, title in enumerate(("directions", "surfaces")):
    for i in range(3):
        row = "   ".join(f"{name} {mean:.4f} ± {error:.4f}" for name, mean, error in zip(names, *estimates[k, i]))
        print(f"bounce {i}, R over {title:10s}  {row}   errors apart: {np.abs(z[k, i]).max():.1f}")
assert np.abs(z).max() <= limit()
# Over surfaces there is no such promise: where two of them meet, 1/d² has infinite variance, and an error bar may jump.
assert (estimates[0, :, 1] < 0.12 * known[0]).all()

figure, axes = plt.subplots()
place_of = np.arange(4)
for k, (title, marker) in enumerate((("directions", "o"), ("surfaces", "s"))):
    for i in range(3):
        axes.errorbar(
            place_of + 0.13 * (2 * i + k - 2.5),
            estimates[k, i, 0] / truth[i].mean,
            yerr=estimates[k, i, 1] / truth[i].mean,
            fmt=marker,
            color=f"C{i}",
            markerfacecolor="white" if k else f"C{i}",
            capsize=3,
            label=f"bounce {i}, {title}",
        )
axes.axhline(1, color="black", linewidth=1)
axes.set_xticks(place_of, [rf"$\langle {left}, {right} \rangle$" for left, right in (
    (r"L^{\to}", r"W_e^{\leftarrow}"), ("L_e", r"W^{\leftarrow}"), (r"L^{\leftarrow}", r"W_e^{\to}"), ("T L_e", r"W^{\to}"))])
axes.set(ylabel="reading, over render's", ylim=(0.6, 1.5), title="One number, eight ways, three bounces")
axes.legend(ncol=3, fontsize="x-small", loc="upper center")
plt.show()

# %% [markdown]
# The figure: bounces 0 to 2 of the detector's reading in four forms and with both $R$, one standard error each, over what `render`
# finds for an irradiance meter. All agree. What differs is the noise: where a factor has to be met by chance twice, at both ends,
# errors are largest. (24 comparisons here, and 3 above: a correct program breaks one of them in some thousand seeds.)
#
# **Q5.** Bounce 0 has no $R$ in it. Why are its points not the same for both? (A5: other random numbers.)
#
# Exitant and incident forms are the same walk, cut one ray later. In functions that is exact: with the same random numbers
# $(T R)\,T L_e = T\,(R T) L_e$ bit by bit.

# %%
x = on("floor", 1000)
one, other = (room.R(seed=seed) for _ in range(2))
assert ((T @ one)(T(Le))(x, x.normal) == T((other @ T)(Le))(x, x.normal)).all()

# %% [markdown]
# ## Exercises
# 1. Look up from the floor in the shadow of the tall box. What is direct there, and what fills the shadow?
# 2. Draw the disc for each bounce alone: `T(Le)`, `T(direct)`, `T(K(direct))`. Which of them could you guess from the one before?
# 3. Draw *importance* at the cross: what does `T(We)` look like for a detector on the red wall, and `T(K(We))`?
# 4. Let the table sink to the floor in small steps, and watch the errors of the form over surfaces. Which bounce suffers first?
# 5. Write `over_lamps`: the operator that makes of $L_e$ alone what `direct` does, for a scene given as an argument. Why can it not
#    be applied to any $g$?
