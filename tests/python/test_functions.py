"""scene.T, scene.R() and scene.Le: T(f) and R(g) of Python functions are functions, linear, and make the bounces of render()."""

import os
import unittest

import neumann
import numpy as np
import scipy.stats
from support import Case, furnace, scene_file

SEED = int(os.environ.get("NEUMANN_TEST_SEED", 0))


def panels():
    return neumann.load(scene_file("floating-panels"), res=16)


def somewhere(scene, samples=16):
    """Points that the camera sees, and the directions back to it."""
    rays = scene.camera_rays(samples, seed=SEED)
    points = scene.intersect(rays.origin, rays.direction)
    return points[points.hit], -rays.direction[points.hit]


class Functions(Case):
    def test_transport_takes_what_left_the_point_that_is_seen(self):
        # In a cube from −1 to 1: straight to the next wall, from space and back from a wall.
        scene = furnace()
        T = scene.T
        x, w = [[0, 0.1, 0.3], [0.5, 0.2, 0]], [[2, 0, 0], [0, 0, -1]]
        place, way = T(lambda y, w: y.position), T(lambda y, w: w)
        np.testing.assert_array_equal(place(x, w), [[1, 0.1, 0.3], [0.5, 0.2, -1]])
        np.testing.assert_array_equal(way(x, w), [[-2, 0, 0], [0, 0, 1]])
        walls = scene.intersect(x, w)
        np.testing.assert_array_equal(place(walls, walls.normal), [[-1, 0.1, 0.3], [0.5, 0.2, 1]])
        # There and back again is the identity where all rays end on a surface.
        x, w = somewhere(scene)
        np.testing.assert_allclose(T(T(lambda y, w: y.position))(x, w), x.position, atol=1e-6)

    def test_nothing_seen(self):
        scene = panels()
        away = np.array([[0.0, 0, 9]]), np.array([[0.0, 0, 1]])
        np.testing.assert_array_equal(scene.T(scene.Le)(*away), [[0, 0, 0]])
        np.testing.assert_array_equal(scene.T(lambda y, w: y.hit[:, None] * np.ones(3))(*away), [[0, 0, 0]])
        np.testing.assert_array_equal(scene.R()(lambda y, w: np.ones((len(y), 3)))(scene.intersect(*away), -away[1]), [[0, 0, 0]])

    def test_furnace(self):
        # Everything shines 1 and reflects 1/2: K^i Le = 2^−i, whatever the random numbers, and without rounding.
        scene = furnace(0.5)
        x, w = somewhere(scene)
        K, f = scene.R(2, seed=SEED) @ scene.T, scene.Le
        for i in range(4):
            np.testing.assert_array_equal(f(x, w), np.full((len(x), 3), 0.5**i))
            f = K(f)
        # Behind the surface nothing leaves.
        np.testing.assert_array_equal(K(scene.Le)(x, -x.normal), 0)

    def test_reflection_of_a_cosine(self):
        # R cos θ = ρ/π ∫ cos² θ dω = 2ρ/3. With the pdf cos θ/π the cosine has the variance 1/2 − 4/9 = 1/18.
        # One comparison: |z| ≤ 4.5 fails once in 147 000 seeds. SE is 0.09%.
        scene = furnace(0.5)
        x, w = somewhere(scene)
        samples = 160_000 // len(x)
        found = scene.R(samples, seed=SEED)(lambda x, w: np.repeat(np.sum(x.normal * w, axis=1, keepdims=True), 3, axis=1))(x, w)
        error = 0.5 * np.sqrt(1 / 18 / (samples * len(x)))
        self.assertLess(abs(found[:, 0].mean() - 1 / 3), 4.5 * error)

    def test_linear(self):
        scene = panels()
        x, w = somewhere(scene)
        f, g = scene.Le, lambda y, w: np.where(y.hit[:, None], np.cos(np.nan_to_num(y.position)) + w, 0)
        both = lambda y, w: 2 * f(y, w) + g(y, w)
        for operator in (lambda: scene.T, lambda: scene.R(4, seed=SEED), lambda: scene.R(4, seed=SEED) @ scene.T):
            apart = 2 * operator()(f)(x, w) + operator()(g)(x, w)
            np.testing.assert_allclose(operator()(both)(x, w), apart, atol=1e-13 * np.abs(apart).max())

    def test_composition(self):
        scene = panels()
        x, w = somewhere(scene)
        K, R, T = scene.R(3, seed=SEED) @ scene.T, scene.R(3, seed=SEED), scene.T
        np.testing.assert_array_equal((K @ K)(scene.Le)(x, w), R(T(R(T(scene.Le))))(x, w))
        K = scene.R(3, seed=np.random.default_rng(SEED)) @ scene.T
        first = K(scene.Le)(x, w)
        np.testing.assert_array_equal(first, (scene.R(3, seed=SEED) @ scene.T)(scene.Le)(x, w))
        self.assertTrue((K(scene.Le)(x, w) != first).any(), "numbers are not used again")
        self.assertEqual([repr(A) for A in (T, R @ T)], ["<FieldOperator T>", "<FieldOperator R @ T>"])

    def test_bounces_are_those_of_render(self):
        # 64 groups of 16 samples of 256 pixels, under a lamp so large that rays meet it. Nine comparisons of channels in three
        # bounces, with Student's t of 63 degrees of freedom: |z| ≤ 4.5 for a normal z, 4.9 here, fails once in 16 000 seeds.
        # SE is at most 2%; small errors of weights and directions are what the furnace and the cosine above find.
        scene, groups = panels().edit({"lamp.to_world": neumann.look_at([0, 0, 2.2], [0, 0, 0], up=[0, 1, 0])}), 64
        K = scene.R(2, seed=SEED) @ scene.T
        bounces, means = [K(scene.Le), K(K(scene.Le)), (K @ K @ K)(scene.Le)], []
        for group in range(groups):
            rays = scene.camera_rays(16, first=16 * group, seed=SEED + 1000)
            x = scene.intersect(rays.origin, rays.direction)
            means.append([bounce(x, -rays.direction).mean(axis=0) for bounce in bounces])
        mean, error = np.mean(means, axis=0), np.std(means, axis=0, ddof=1) / np.sqrt(groups)
        ours = scene.render(bounces=3, spp=4096, method="walk", sampler="independent", seed=SEED, quiet=True)
        most = scipy.stats.t.isf(scipy.stats.norm.sf(4.5), groups - 1)
        for i in range(3):
            walk = ours.terms[i + 1].astype(float).mean(axis=(0, 1))
            walk_error = np.sqrt(np.square(ours.terms_spread[i + 1], dtype=float).sum(axis=(0, 1))) / 256
            z = (mean[i] - walk) / np.hypot(error[i], walk_error)
            self.assertTrue((np.abs(z) <= most).all(), f"bounce {i + 1}: z = {z}")
            self.assertLess(error[i].max(), 0.02 * mean[i].max(), f"bounce {i + 1}")

    def test_errors(self):
        scene = furnace()
        glass = neumann.load(scene_file("glass-ball"), res=16)
        one = lambda x, w: np.ones((len(x), 3))
        x, w = somewhere(scene, 1)
        seen, back = somewhere(glass)
        first = np.flatnonzero(np.isnan(seen.reflectance[:, 0]) & (np.sum(seen.normal * back, axis=1) > 0))[0]
        count = len(x)
        cases = [
            (lambda: scene.T(3), "T: 3, expected a function of points and directions"),
            (lambda: (scene.R() @ scene.T)(None), "R @ T: None, expected a function of points and directions"),
            (lambda: scene.R(0), "samples=0: expected 1 or more"),
            (lambda: scene.T(one)(x, w[:2]), f"direction: 2 rows, expected {count}, as of origin"),
            (lambda: scene.T(lambda x, w: 1.0)(x, w), f"f: an array of shape (), expected ({count}, 3)"),
            (lambda: scene.T(lambda x, w: x.distance)(x, w), f"f: an array of shape ({count},), expected ({count}, 3)"),
            (lambda: panels().T(lambda x, w: x.position)([[0, 0, 9]], [[0, 0, 1]]), "f[0, 0]: nan, expected finite numbers"),
            (lambda: scene.R()(lambda x, w: 1j * w)(x, w), "g: complex numbers, expected real ones"),
            (lambda: scene.R()(one)(x, w[:2]), f"w: an array of shape (2, 3), expected ({count}, 3)"),
            (lambda: scene.R()(one)(x.position, w), "x: ndarray, expected Points, which know their reflectance"),
            (lambda: glass.R()(one)(seen, back), f"x: row {first} is on a surface that is not diffuse, expected a reflectance"),
        ]
        for call, message in cases:
            with self.assertRaises(neumann.InputError) as caught:
                call()
            self.assertEqual(str(caught.exception), message)


if __name__ == "__main__":
    unittest.main()
