"""What is known without the program about the scenes that lectures show, as their READMEs state it.

Statistical comparisons pass at 4.5 standard errors: ten of them, a false alarm in 15,000 runs of all."""

import os
import unittest
import xml.etree.ElementTree as ElementTree

import neumann
import numpy as np
from support import SCENES, Case, scene_file

SEED = int(os.environ.get("NEUMANN_TEST_SEED", "59"))


def load(name, **overrides):
    return neumann.load(scene_file(name), res=8, **overrides)


def looking_at(scene, place, origin):
    """A camera at `origin` that sees a spot of a ten-thousandth of the distance at `place`."""
    return scene.edit({"sensor.to_world": neumann.look_at(origin, place, [0.3, 0.4, 1]), "sensor.fov": 0.005})


def fresnel(cosine, ior):
    """The part of light that glass or water reflects, from air, and the cosine inside."""
    inside = np.sqrt(1 - (1 - cosine**2) / ior**2)
    s, p = (cosine - ior * inside) / (cosine + ior * inside), (ior * cosine - inside) / (ior * cosine + inside)
    return (s**2 + p**2) / 2, inside


class LectureScenes(Case):
    def expect(self, value, error, known, visible):
        self.assertLessEqual(abs(value - known), 4.5 * error)
        self.assertLessEqual(error, visible * known, "what this test can see")

    def expect_power(self, photons, chosen, known, visible):
        """The power of the chosen photons: their number would be Poisson, and is less uncertain, because Sobol' points are even."""
        power = photons.power[chosen, 1]
        self.expect(power.sum(), np.sqrt((power**2).sum()), known, visible)

    def expect_bounce_1(self, scene, known, visible):
        """The mean of a picture without colours."""
        table = scene.render(bounces=1, spp=2048, method="walk", seed=SEED, quiet=True).table
        self.expect(table["mean"][1], table["mean_stderr"][1], known, visible)

    def in_the_sun(self, name, paths, **overrides):
        """Photons of the sun alone up to bounce 2, the direction towards it, and the irradiance across its light."""
        scene = load(name, **overrides).edit({"sky.sky_scale": 0.0})
        sun = scene.sample_lights([[0.0, 0.0, 9.0]], [[0.5, 0.5]])
        vector = ElementTree.parse(scene_file(name)).find("emitter/vector")
        towards = np.array([float(vector.get(axis)) for axis in "xyz"])
        return scene.photons(paths, bounces=2, seed=SEED), towards / np.linalg.norm(towards), sun.weight[0, 1]

    def test_lid(self):
        photons, sun, across = self.in_the_sun("lid", 400_000)
        # Seen along the sun's light, the lid covers as much as its rim, of 72 sides, does, however deep it is.
        on_wall = photons.caustic & (photons.position[:, 1] > 0.999)
        self.expect_power(photons, on_wall, 0.9 * across * 36 * np.sin(np.pi / 36) * 0.27**2 * sun[2], 0.03)

        # Flat, it throws its own shape onto the wall.
        photons, sun, _ = self.in_the_sun("lid", 400_000, sag=1e-6)
        x = photons.position[photons.caustic & (photons.position[:, 1] > 0.999)]
        for axis, known in ((0, 0.3 + 0.7 * sun[0] / sun[1]), (2, 0.62 - 0.7 * sun[2] / sun[1])):
            self.expect(x[:, axis].mean(), x[:, axis].std() / np.sqrt(len(x)), known, 0.01)

    def test_hoop(self):
        photons, sun, across = self.in_the_sun("lid", 400_000)
        R, height, centre = 0.3, 0.15, np.array([-0.6, -0.3])
        level = np.hypot(*sun[:2])
        # Where light goes that meets the inside at the angle φ from the sun's direction and the height z; s is the way from there.
        phi, s = np.meshgrid((np.arange(20000) + 0.5) / 20000 * np.pi - np.pi / 2, (np.arange(250) + 0.5) / 1000)
        z = s * sun[2] / level
        along, aside = R * np.cos(phi) - s * np.cos(2 * phi), R * np.sin(phi) - s * np.sin(2 * phi)
        meets = (z < height) & (height < z + 2 * R * np.cos(phi) * sun[2] / level)
        power = np.where(meets, 0.9 * across * sun[2] * R * np.cos(phi) * np.pi / 20000 / 1000, 0.0)

        def on(along, aside, nearest, farthest, width):
            return (R - farthest < along) & (along < R - nearest) & (abs(aside) < width)

        # On the axis beyond R / 2, the cusp of the caustic, it is ρ / (2 s / R − 1) times direct light.
        formula = 0.9 * across * sun[2] * 0.002 * R / 2 * np.log((0.39 / R - 1) / (0.35 / R - 1))
        self.assertAlmostEqual(power[on(along, aside, 0.175, 0.195, 0.001)].sum() / formula, 1, delta=0.01)

        away = -sun[:2] / level
        x = photons.position[:, :2] - centre
        on_ground = photons.caustic & (photons.position[:, 2] < 1e-6)
        seen = on_ground & on(x @ away, x @ [-away[1], away[0]], 0.1, 0.18, 0.06)
        self.expect_power(photons, seen, power[on(along, aside, 0.1, 0.18, 0.06)].sum(), 0.06)

    def test_pool(self):
        photons, sun, across = self.in_the_sun("pool", 300_000, waves=1e-6)
        lit = 0.1 * -sun[0] / sun[2] - 2  # from here on the water is not in the shade of the paving
        reflected, inside = fresnel(sun[2], 1.333)
        irradiance = across * sun[2] * (1 - reflected)
        through = photons.caustic & (photons.position[:, 2] < -0.1)
        self.expect_power(photons, through, irradiance * 3 * (2 - lit), 0.01)
        # By Snell's law the edge of the shade is carried to here; the sun's radius blurs it evenly.
        edge = lit + 1.2 * np.sqrt(1 - inside**2) / inside
        x = photons.position
        near = through & (x[:, 2] < -1.3 + 1e-6) & (abs(x[:, 0] - edge) < 0.1)
        self.expect_power(photons, near, irradiance * 3 * 0.1, 0.03)

    def test_four_floors(self):
        photons = load("four-floors").photons(100_000, bounces=8, seed=SEED)
        floor = np.minimum(1 + np.floor(photons.position[:, 2] / 3 + 1e-9), 4)
        self.assertLessEqual({1, 2, 3}, set(floor))
        self.assertTrue((photons.bounce >= floor).all())

    def test_courtyard(self):
        scene = load("courtyard")
        rng = np.random.default_rng(SEED)
        # The part of the sky's cosine that the opening leaves to (3, 1): that of four rectangles with a corner above the point.
        x, y, h, known = 3.0, 1.0, 7.0, 0.0
        for a in (5 - x, 5 + x):
            for b in (5 - y, 5 + y):
                p, q = np.hypot(a, h), np.hypot(b, h)
                known += (a / p * np.arctan(b / p) + b / q * np.arctan(a / q)) / (2 * np.pi)
        n = 200_000
        r, angle = np.sqrt(rng.random(n)), 2 * np.pi * rng.random(n)
        w = np.stack([r * np.cos(angle), r * np.sin(angle), np.sqrt(1 - r**2)], axis=1)
        free = ~scene.intersect(np.tile([x, y, 1e-6], (n, 1)), w).hit
        self.expect(free.mean(), np.sqrt(known * (1 - known) / n), known, 0.01)

        # The sun's centre is seen up to the shade of the east wall and of the south wall, and not from p.
        sun = np.array([0.45, -0.35, 0.82])
        east, south = 5 - 7 * 0.45 / 0.82, 7 * 0.35 / 0.82 - 5
        places = [(east - 0.001, 0, 0), (east + 0.001, 0, 0), (-2, south + 0.001, 0), (-2, south - 0.001, 0), (1.8, 7.499, 1.6)]
        lit = ~scene.intersect(np.array(places) + [0, 0, 1e-6], np.tile(sun, (5, 1))).hit
        np.testing.assert_array_equal(lit, [True, False, True, False, False])

    def test_street(self):
        instances = ElementTree.parse(SCENES / "street" / "town.xml").getroot()
        groups = {g.get("id"): g for g in ElementTree.parse(scene_file("street")).iter("shape") if g.get("type") == "shapegroup"}
        faces = 0
        for instance in instances:
            for mesh in groups[instance.find("ref").get("id")].iter("string"):
                header = (SCENES / "street" / mesh.get("value")).read_bytes().split(b"end_header")[0].split()
                faces += int(header[header.index(b"face") + 1])
        self.assertEqual(faces, 253_000)
        # Under a sky that is 1 everywhere bounce i is at most ρ^i, here of the brightest surface, and on top of all it is ρ.
        scene = load("street")
        self.assertEqual(scene.largest_albedo, (0.75, 0.7, 0.6))
        terms = np.array(scene.render(bounces=4, spp=16, method="walk", direct="bsdf", seed=SEED, quiet=True).terms)
        for i in range(5):
            self.assertTrue((terms[i] <= np.power(scene.largest_albedo, i) * (1 + 1e-6)).all(), i)
        above = looking_at(scene, [0, 53, 30], [0.3, 52, 34])
        terms = above.render(bounces=2, spp=16, method="walk", direct="bsdf", seed=SEED, quiet=True).terms
        np.testing.assert_allclose(terms[1], np.broadcast_to([0.5, 0.48, 0.42], (8, 8, 3)), rtol=1e-6)
        np.testing.assert_array_equal(terms[2], 0)

    def test_six_materials(self):
        dark = {"surroundings.radiance.value": 0.0, "lamp.emitter.radiance.value": 1.0, "matt.reflectance.value": 0.6}
        scene = load("six-materials").edit(dark)
        eye, lamp = np.array([0, -3.6, 1.9]), np.array([-1.2, -1.6, 2.6])
        # Where glass shows the middle of the lamp, its normal halves the angle between lamp and eye.
        ball = np.array([0.75, 0.9, 0.302])
        x = ball
        for _ in range(50):
            to_lamp, to_eye = ((y - x) / np.linalg.norm(y - x) for y in (lamp, eye))
            x = ball + 0.3 * (to_lamp + to_eye) / np.linalg.norm(to_lamp + to_eye)
        reflected, _ = fresnel((x - ball) @ to_eye / 0.3, 1.5)
        self.expect_bounce_1(looking_at(scene, x, eye), reflected, 0.03)

        # On top of the matt ball, Lambert's formula for the lamp.
        top = np.array([-0.75, 0, 0.602])
        forward = np.array([0, 0.4, 0.3]) - lamp
        forward /= np.linalg.norm(forward)
        left = np.cross([0, 0, 1], forward)
        left /= np.linalg.norm(left)
        up = np.cross(forward, left)
        corners = [lamp + 0.8 * a * left + 0.6 * b * up - top for a, b in ((1, 1), (-1, 1), (-1, -1), (1, -1))]
        corners = [c / np.linalg.norm(c) for c in corners]
        vector = 0
        for a, b in zip(corners, corners[1:] + corners[:1]):
            across = np.cross(a, b)
            vector = vector + np.arctan2(np.linalg.norm(across), a @ b) * across / np.linalg.norm(across) / 2
        self.expect_bounce_1(looking_at(scene, top, top + [0, -1, 3]), 0.6 / np.pi * abs(vector[2]), 0.01)

    def test_fixtures(self):
        scene = load("fixtures")
        photons = scene.photons(100_000, bounces=1, seed=SEED)

        def lit(axis, rim, radius, depth, lamp):
            """Whether a lamp of radius `lamp`, `depth` below the rim at z = 0, can be seen over the opposite part of the rim."""
            steepest = np.arctan2(radius, depth) + np.arcsin(lamp / np.hypot(radius, depth))
            away = np.hypot(*(photons.position[:, :2] - axis).T)
            return np.maximum(away - radius, 0) <= rim * np.tan(steepest) * (1 + 1e-4) + 1e-4

        z = photons.position[:, 2]
        by_cup = lit([-0.9, 1.2], np.maximum(z - 1.7, 0), 0.15, 0.12, 0.04)
        by_tube = lit([1.85, 0.8], np.maximum(abs(z - 1.65) - 0.2, 0), 0.08, 0.2, 0.03)
        self.assertTrue((by_cup | by_tube).all())
        # Above the cup its lamp is a sphere, whole: π L (r / d)².
        scene = scene.edit({"cup_lamp.emitter.radiance.value": 400.0, "white.bsdf.reflectance.value": 0.75})
        self.expect_bounce_1(looking_at(scene, [-0.9, 1.2, 2.6], [-0.5, 0.9, 1.9]), 0.75 * 400 * (0.04 / 1.02) ** 2, 0.01)


if __name__ == "__main__":
    unittest.main()
