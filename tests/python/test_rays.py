"""scene.camera_rays(), intersect(), visible() and sample_lights(): enough for a path tracer in NumPy that agrees with ours."""

import os
import re
import textwrap
import threading
import time
import unittest

import neumann
import numpy as np
from support import SCENES, Case, cornell, furnace, scene_file


def dot(a, b):
    return np.einsum("ij,ij->i", a, b)


def path_tracer(scene):
    """The one of the manual: K^i Le by walks between diffuse surfaces that ask for light at every stop."""
    manual = (SCENES.parent / "apps/manual/python.md").read_text(encoding="utf-8")
    text = re.search(r"^    def paths\(.*?^        return samples$", manual, re.MULTILINE | re.DOTALL)[0]
    names = {"np": np, "scene": scene}
    exec(textwrap.dedent(text), names)
    return names["paths"]


class Rays(Case):
    def test_unit_cube(self):
        scene = furnace(0.25)
        points = scene.intersect([[0, 0.1, 0.3], [0.5, 0.2, 0]], [[2, 0, 0], [0, 0, -1]])
        self.assertEqual(len(points), 2)
        self.assertTrue(points.hit.all())
        np.testing.assert_array_equal(points.distance, [1, 1])
        np.testing.assert_array_equal(points.position, [[1, 0.1, 0.3], [0.5, 0.2, -1]])
        np.testing.assert_array_equal(points.normal, [[-1, 0, 0], [0, 0, 1]])
        np.testing.assert_array_equal(points.emission, np.ones((2, 3)))
        np.testing.assert_array_equal(points.reflectance, np.full((2, 3), 0.25))
        np.testing.assert_array_equal(points.shape, [0, 0])
        # To the opposite walls, from the walls themselves.
        np.testing.assert_array_equal(scene.intersect(points, points.normal).distance, [2, 2])
        opposite = scene.sample_lights(points, [[0.3, 0.6], [0.4, 0.7]])
        self.assertTrue(scene.intersect(opposite, opposite.normal).hit.all())
        lights = scene.sample_lights(points, [[0.1, 0.2], [0.8, 0.9]])
        np.testing.assert_allclose(lights.density, 1 / 24)
        d = lights.position - points.position
        np.testing.assert_allclose(lights.pdf, np.sum(d**2, axis=1) / np.abs(dot(lights.normal, lights.direction)) / 24)
        np.testing.assert_allclose(lights.weight[:, 0] * lights.pdf, 1)
        np.testing.assert_array_equal(scene.visible(points, lights), [True, True])
        np.testing.assert_array_equal(scene.visible([[0, 0, 0], [0, 0, 0]], [[0.5, 0, 0], [0, 1.5, 0]]), [True, False])

    def test_choosing(self):
        scene = cornell(8)
        rays = scene.camera_rays(2, seed=3)
        points = scene.intersect(rays.origin, rays.direction, rays.length)
        self.assertEqual(len(points), 128)
        for chosen in (points.normal[:, 1] > 0.5, [5, 3, 3], slice(7, 100, 9)):
            some = points[chosen]
            np.testing.assert_array_equal(some.position, points.position[chosen])
            np.testing.assert_array_equal(some.hit, points.hit[chosen])
        self.assertEqual(len(points[[]]), 0)
        self.assertEqual(points[[]].position.shape, (0, 3))
        self.assertEqual(len(scene.intersect(points[[]], np.zeros((0, 3)))), 0)
        with self.assertRaises(ValueError):
            points.position[0, 0] = 1  # they look into the points
        with self.assertRaises(IndexError):
            points[[128]]
        self.assertRegex(repr(points), r"^<Points of 128 rays, of which \d+ hit something>$")
        self.assertIn("position", points._repr_html_())
        # Arrays outlive what they look into.
        position = scene.intersect(rays.origin, rays.direction).position
        kept = position.copy()
        scene.intersect(rays.origin, rays.direction)
        np.testing.assert_array_equal(position, kept)

    def test_nothing_hit(self):
        scene = cornell(8)
        points = scene.intersect([[278, 273, -800]] * 2, [[0, 0, -1], [0, 0, 1]])
        np.testing.assert_array_equal(points.hit, [False, True])
        self.assertEqual((points.distance[0], points.shape[0], points.primitive[0]), (np.inf, -1, -1))
        self.assertTrue(np.isnan(points.position[0]).all() and np.isnan(points.reflectance[0]).all())
        np.testing.assert_array_equal(points.emission[0], 0)
        short = scene.intersect([[278, 273, -800]] * 2, [[0, 0, 1]] * 2, [10, np.inf])
        np.testing.assert_array_equal(short.hit, [False, True])

    def test_what_is_not_diffuse(self):
        scene = neumann.load(scene_file("glass-ball"), res=16)
        rays = scene.camera_rays()
        points = scene.intersect(rays.origin, rays.direction)
        clear = np.isnan(points.reflectance[points.hit, 0])
        self.assertTrue(0 < clear.mean() < 1)

    def test_camera_rays(self):
        scene = cornell(8)
        all_, later = scene.camera_rays(4, seed=5), scene.camera_rays(2, first=2, seed=5)
        np.testing.assert_array_equal(all_.direction[128:], later.direction)
        np.testing.assert_array_equal(all_.pixel.reshape(4, 8, 8, 2)[2, 6, 1], [1, 6])
        np.testing.assert_array_equal(all_.weight, 1)
        # Bounce 0 from all rays is the lamp: as the walk has it, pixel by pixel. Both see it without noise but for its edge.
        L = scene.camera_rays(256)
        seen = scene.intersect(L.origin, L.direction, L.length).emission * L.weight[:, None]
        ours = scene.render(bounces=0, spp=1024, seed=1, quiet=True).terms[0]
        np.testing.assert_allclose(seen.reshape(256, 8, 8, 3).mean(axis=0), ours, atol=0.15 * ours.max())

    def test_path_tracer_agrees_with_the_walk(self):
        # 64 groups of 128 samples of 256 pixels, against the walk with as many. Nine comparisons of channels in three bounces, with
        # Student's t of 63 degrees of freedom: |z| ≤ 4.5 for a normal z, 4.9 here, fails once in 16 000 seeds. SE is 0.15% to 0.4%.
        import scipy.stats

        scene, bounces, groups, spp = cornell(16), 3, 64, 128
        seed = int(os.environ.get("NEUMANN_TEST_SEED", 0))
        rng, paths = np.random.default_rng(seed), path_tracer(scene)
        means = []
        for group in range(groups):
            rays = scene.camera_rays(spp, first=group * spp, seed=seed + 1000)
            means.append((paths(rays, bounces, rng) * rays.weight[:, None, None]).mean(axis=0))
        mean, error = np.mean(means, axis=0), np.std(means, axis=0, ddof=1) / np.sqrt(groups)
        ours = scene.render(bounces=bounces, spp=groups * spp, sampler="independent", seed=seed, quiet=True)
        most = scipy.stats.t.isf(scipy.stats.norm.sf(4.5), groups - 1)
        for i in range(1, bounces + 1):
            walk = ours.terms[i].astype(float).mean(axis=(0, 1))
            walk_error = np.sqrt(np.square(ours.terms_spread[i], dtype=float).sum(axis=(0, 1))) / 256
            z = (mean[i] - walk) / np.hypot(error[i], walk_error)
            self.assertTrue((np.abs(z) <= most).all(), f"bounce {i}: z = {z}")
            self.assertTrue((error[i] < 0.005 * mean[i]).all(), f"bounce {i}: {error[i] / mean[i]}")

    def test_path_tracer_in_a_study(self):
        scene = furnace(0.5)
        tracer = path_tracer(scene)
        study = scene.study([tracer, "walk:direct=light"], samples=[4, 16], repeats=4, bounces=2, reference="values:1,0.5,0.25", quiet=True)
        self.assertEqual(study.methods, ["paths()", "walk:direct=light"])
        self.assertEqual(study.curve("paths()", 0)["rmse"].max(), 0)
        # The same estimator, but for the numbers: the first bounce has the same variance. 8 × 8 pixels, 4 repeats, 3 equal channels:
        # each MSE is known to √(2/256) or so, and light samples near the receiver have wide tails.
        a, b = study.curve("paths()", 1)["rmse"], study.curve("walk:direct=light", 1)["rmse"]
        self.assertTrue((a / b > 0.3).all() and (a / b < 3).all(), (a, b))

    def test_hidden_lights(self):
        # A floor under a lamp, seen through it: bounce 0 is empty, and the path tracer has what the walk has.
        root = {
            "type": "scene",
            "integrator": {"type": "path", "hide_emitters": True},
            "sensor": {"type": "perspective", "fov": 20, "to_world": neumann.look_at([0, 0, 3], [0, 0, 0], up=[0, 1, 0]), "film": {"type": "hdrfilm", "width": 4, "height": 4}},
            "floor": {"type": "rectangle", "bsdf": {"type": "diffuse", "reflectance": {"type": "rgb", "value": 0.5}}},
            "lamp": {"type": "rectangle", "to_world": neumann.look_at([0, 0, 1], [0, 0, 0], up=[0, 1, 0]), "emitter": {"type": "area", "radiance": {"type": "rgb", "value": 3.0}}},
        }
        for hides in (True, False):
            root["integrator"]["hide_emitters"] = hides
            scene = neumann.load_dict(root)
            rays = scene.camera_rays()
            np.testing.assert_allclose(scene.intersect(rays.origin, rays.direction).position[:, 2], 1, atol=1e-6)
            np.testing.assert_allclose(scene.seen(rays).position[:, 2], 0 if hides else 1, atol=1e-6)
        scene = neumann.load_dict({**root, "integrator": {"type": "path", "hide_emitters": True}})
        rays = scene.camera_rays(16384)
        np.testing.assert_array_equal(scene.seen(rays).emission, 0)
        seed = int(os.environ.get("NEUMANN_TEST_SEED", 0))
        samples = path_tracer(scene)(rays, 1, np.random.default_rng(seed)).mean(axis=2) * rays.weight[:, None]
        np.testing.assert_array_equal(samples[:, 0], 0)
        # One comparison: |z| ≤ 4.5 fails once in 147 000 seeds. Its SE is 0.13%.
        ours = scene.render(bounces=1, spp=4096, method="walk", seed=seed, quiet=True).run.bounces
        error = samples[:, 1].std() / np.sqrt(len(samples))
        self.assertLess(abs(samples[:, 1].mean() - ours[1].mean), 4.5 * np.hypot(error, ours[1].stderr))
        self.assertLess(error, 0.002 * ours[1].mean)

    def test_other_threads_run_meanwhile(self):
        scene = cornell(64)
        rays = scene.camera_rays(64)
        ticks, done = [], threading.Event()

        def tick():
            while not done.is_set():
                ticks.append(time.perf_counter())
                time.sleep(0.001)

        thread = threading.Thread(target=tick)
        thread.start()
        for _ in range(4):
            scene.intersect(rays.origin, rays.direction)
        done.set()
        thread.join()
        self.assertGreater(len(ticks), 8)

    def test_errors(self):
        scene, other = cornell(8), furnace()
        rays = scene.camera_rays()
        points = scene.intersect(rays.origin, rays.direction)
        elsewhere = other.intersect([[0, 0, 0]], [[1, 0, 0]])
        three = np.zeros((3, 3))
        missed = scene.intersect([[278, 273, -800]], [[0, 0, -1]])
        cases = [
            (lambda: scene.intersect([1, 2, 3], [[0, 0, 1]]), "origin: an array of shape (3,), expected (n, 3)"),
            (lambda: scene.intersect(three, np.ones((3, 2))), "direction: an array of shape (3, 2), expected (n, 3)"),
            (lambda: scene.intersect(three, np.ones((2, 3))), "direction: 2 rows, expected 3, as of origin"),
            (lambda: scene.intersect(three, three), "direction: row 0 is zero"),
            (lambda: scene.intersect(three, np.full((3, 3), np.nan)), "direction: row 0 is not finite"),
            (lambda: scene.intersect([["a", "b", "c"]], [[0, 0, 1]]), "origin: an array of <U1, expected numbers, an array (n, 3)"),
            (lambda: scene.intersect(three * 1j, three), "origin: an array of complex128, expected numbers, an array (n, 3)"),
            (lambda: scene.intersect(three, np.ones((3, 3)), [1, 2]), "length: 2 rows, expected 3, as of origin"),
            (lambda: scene.intersect(three, np.ones((3, 3)), [1, 0, 2]), "length: row 1 is 0, expected more than 0"),
            (lambda: scene.intersect(points, np.ones((64, 3)), np.ones(64)), "length: expected with origins in space, and not with points on surfaces"),
            (lambda: scene.intersect(elsewhere, [[1, 0, 0]]), "origin: points of another scene"),
            (lambda: scene.intersect(missed, [[1, 0, 0]]), "origin: row 0 is a ray that has hit nothing; points[points.hit] are the others"),
            (lambda: scene.visible(three, three[:2]), "b: 2 rows, expected 3, as of a"),
            (lambda: scene.visible(three, elsewhere), "b: points of another scene"),
            (lambda: scene.sample_lights(points[:2], np.ones((2, 2))), "u: row 0 is (1, 1), expected numbers from 0 to below 1"),
            (lambda: scene.sample_lights(points[:2], np.zeros((1, 2))), "u: 1 rows, expected 2, as of points"),
            (lambda: scene.camera_rays(0), "samples 0: expected 1 to 4194304"),
            (lambda: scene.camera_rays(first=-1), "first -1: expected at least 0"),
        ]
        for call, message in cases:
            with self.assertRaises(neumann.InputError) as caught:
                call()
            self.assertEqual(str(caught.exception), message)


if __name__ == "__main__":
    unittest.main()
