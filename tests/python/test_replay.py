"""What `neumann replay` prints of a path is f(x) / p(x), written out from positions, normals and reflectances alone."""

import json
import unittest

import numpy as np
from support import Case, command, cornell, scene_file


class Replay(Case):
    def test_a_path_by_hand(self):
        # The Cornell box is diffuse and has one lamp, of area A. A path x1 … xi that asks for light at a point y of it has, per area,
        #     f = ρ1/π G(x1, x2) … ρi/π G(xi, y) Le,   p = Π_k cosθk/π cosθ'k+1 / |xk − xk+1|² · 1/A,   G = cosθ cosθ' / d²,
        # and brings f/p. The product of the printed pdfs is that of p, and the throughput that of both without y.
        options = "-D res=16 --spp 16 -n 3 --method walk --direct light --sampler independent -o made"
        made = command("render", scene_file("cornell-box"), *options.split(), folder=self.folder)
        self.assertEqual(made.returncode, 0, made.stderr)
        scene, compared = cornell(16), 0
        for pixel in ("6,9", "3,12", "11,11", "8,14"):
            for sample in range(4):
                done = command("replay", "made", "--pixel", pixel, "--sample", sample, "--json", folder=self.folder)
                self.assertEqual(done.returncode, 0, done.stderr)
                compared += self.by_hand(scene, json.loads(done.stdout)["steps"])
        self.assertGreater(compared, 5)

    def by_hand(self, scene, steps):
        """Compares the numbers of one path, and returns how many samples of light it had."""
        f, p, area, compared = np.ones(3), 1.0, 130.0 * 105.0, 0
        for step in steps:
            if step["bounce"] > 3:  # from here on walks may be ended at random
                break
            start, along = np.array(step["from"]), np.array(step["along"])
            # The scene is asked what is there: a millimetre on, because start is a position without its surface.
            met = scene.intersect((start + along)[None], along[None])
            d2 = (met.distance[0] + 1) ** 2
            if step["ray"].startswith("looks"):
                for brings in step.get("brings", []):
                    G = (normal @ along) * -(met.normal[0] @ along) / d2
                    np.testing.assert_allclose(f * rho / np.pi * G * met.emission[0] / (p / area), brings["value"], rtol=1e-6)
                    compared += 1
                continue
            if step["ray"].startswith("reflection"):
                np.testing.assert_allclose(step["pdf"], normal @ along / np.pi, rtol=1e-12)
                f, p = f * rho / np.pi * (normal @ along), p * step["pdf"]  # without cosθ'/d², which f and p share
                np.testing.assert_allclose(step["throughput"], f / p, rtol=1e-12)
            if not step["found"]:
                break
            np.testing.assert_allclose(step["meets"]["at"], start + along * np.sqrt(d2), atol=1e-6 * 560)  # of the room
            np.testing.assert_allclose(step["meets"]["normal"], met.normal[0], atol=1e-6)
            normal, rho = np.array(step["meets"]["normal"]), met.reflectance[0]
        return compared


if __name__ == "__main__":
    unittest.main()
