"""T, R and K are those that `neumann export` writes; what is exact of them is exact."""

import unittest

import neumann
import numpy as np
import scipy.io
import scipy.sparse
from support import Case, command, cornell, furnace, scene_file

SIZE = {"patches": 150, "directions": 16}
OPTIONS = ["--patches", "150", "--directions", "16"]


class Matrices(Case):
    def test_those_of_export(self):
        done = command(
            "export", scene_file("cornell-box"), "-D", "res=16", *OPTIONS, "--with-K", "-o", "m", folder=self.folder
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        read = lambda name: scipy.io.mmread(self.folder / "m" / name)
        for column, channel in enumerate("rgb"):
            made = cornell().matrices(channel=channel, **SIZE)
            T, R, Le = made
            for matrix, name in ((T, "T"), (R, f"R_{channel}"), (R @ T, f"K_{channel}"), (made.K, f"K_{channel}")):
                self.assertTrue(scipy.sparse.isspmatrix_csr(matrix), name)
                self.assertEqual((matrix != read(f"{name}.mtx").tocsr()).nnz, 0, name)
            np.testing.assert_array_equal(Le, read("Le.mtx")[:, column])
            np.testing.assert_array_equal(made.b, read("b.mtx")[:, column])
            np.testing.assert_array_equal(made.measure, read("measure.mtx")[:, 0])
            np.testing.assert_array_equal(made.ray_measure, read("ray_measure.mtx")[:, 0])
            self.assertEqual(made.channel, {"r": "red", "g": "green", "b": "blue"}[channel])
        np.testing.assert_array_equal(made.patches["unknown"][:3], [0, 1, 2])

    def test_misspelt_keywords(self):
        for name in ("matrices", "operators", "spectrum", "solve"):
            with self.assertRaisesRegex(TypeError, rf"^{name}\(\) got an unexpected keyword argument 'pathces'; did you mean 'patches'\?$"):
                getattr(furnace(), name)(pathces=50)

    def test_keywords_name_the_nearest(self):
        for call, said in (
            (lambda: cornell().render(sp=4), r"render\(\) got an unexpected keyword argument 'sp'; did you mean 'spp'\?"),
            (lambda: cornell().spectrum(patchs=4), r"spectrum\(\) got an unexpected keyword argument 'patchs'; did you mean 'patches'\?"),
            (lambda: cornell().render(res=4), r"render\(\) got an unexpected keyword argument 'res'; sizes are defined by scenes: load\(…, res=…\)"),
            (lambda: cornell().render(xyzzy=4), r"render\(\) got an unexpected keyword argument 'xyzzy'"),
        ):
            with self.assertRaisesRegex(TypeError, f"^{said}$"):
                call()

    def test_one_channel_of_the_spectrum(self):
        scene, given = cornell(), dict(patches=60, directions=8)
        every = scene.spectrum(**given).channels
        for number, letter in enumerate("rgb"):
            (one,) = scene.spectrum(channel=letter, **given).channels
            self.assertEqual(one.name, every[number].name)
            np.testing.assert_array_equal(one.eigenvalues, every[number].eigenvalues)
            np.testing.assert_array_equal(one.eigenvectors, every[number].eigenvectors)
        with self.assertRaisesRegex(neumann.InputError, "^channel: x not in {r,g,b}$"):
            scene.spectrum(channel="x", **given)

    def test_furnace(self):
        # A closed room: every ray of T meets something, and K^n 1 = albedo^n to rounding.
        made = furnace(0.5).matrices(**SIZE)
        np.testing.assert_array_equal(np.asarray(made.T.sum(axis=1)).ravel(), 1.0)
        self.assertEqual(made.channel, "grey")
        K, term = made.K, made.Le
        for n in range(1, 6):
            term = K @ term
            np.testing.assert_allclose(term, 0.5**n, rtol=8 * n * np.finfo(float).eps * 100)

    def test_dot_test(self):
        # ⟨K f, g⟩ = ⟨f, K* g⟩ with K* = M⁻¹ Kᵀ M.
        made = cornell().matrices(channel="g", **SIZE)
        K, m = made.K, made.measure
        rng = np.random.default_rng(1)
        f, g = rng.random(len(m)), rng.random(len(m))
        adjoint = (K.T @ (m * g)) / m
        left, right = np.sum(m * (K @ f) * g), np.sum(m * f * adjoint)
        self.assertLessEqual(abs(left - right), 1e-13 * abs(left))

    def test_camera(self):
        # Everything in the furnace is seen, and shines alike.
        made = furnace(0.5).matrices(**SIZE)
        picture = made.picture(made.Le, spp=4)
        with self.assertRaisesRegex(neumann.InputError, r"^x has the shape \(3,\), expected one value an unknown, \(\d+,\)$"):
            made.picture(np.ones(3))
        self.assertEqual(picture.shape, (8, 8))
        np.testing.assert_allclose(picture, 1.0, rtol=1e-14)
        # ⟨K*² We, Le⟩ is the mean of the picture of bounce 2, albedo².
        We = made.camera(4).sum(axis=0).A1 / picture.size / made.measure
        adjoint = lambda f: made.K.T @ (made.measure * f) / made.measure
        self.assertAlmostEqual(np.sum(made.measure * adjoint(adjoint(We)) * made.Le), 0.25, 13)
        # The lamp is on top.
        made = cornell().matrices(channel="g", **SIZE)
        picture = made.picture(made.Le)
        self.assertGreater(picture[:8].sum(), 0.0)
        self.assertEqual(picture[8:].sum(), 0.0)

    def test_camera_against_the_command(self):
        # `patches` shows the same fields with rays and patches of its own: means agree within what its files say they may, and what
        # 150 patches of 256 rays do; bounce 1 is 5% off at most.
        made = cornell(32).matrices(channel="g", patches=150, directions=256)
        series = cornell(32).render(method="patches", bounces=1, patches=150, directions=1024, spp=64)
        of_matrices = made.picture(made.b, spp=64).mean()
        self.assertLessEqual(abs(of_matrices - series.terms[1][..., 1].mean()), 0.05 * of_matrices)

    def test_spectrum(self):
        found = cornell().spectrum(eigenvalues=3, **SIZE)
        made = cornell().matrices(channel="r", **SIZE)
        red = found.channels[0]
        self.assertEqual(red.eigenvalues.shape, (3,))
        self.assertEqual(red.series, "converges")
        self.assertLessEqual(red.spectral_radius, red.largest_albedo * 1.1)
        for value, vector in zip(red.eigenvalues, red.eigenvectors.T):
            self.assertLessEqual(np.linalg.norm(made.K @ vector - value * vector), 1e-8)
        # SciPy finds the same radius.
        values = np.linalg.eigvals(made.K.toarray())
        self.assertAlmostEqual(np.abs(values).max(), red.spectral_radius, 10)

    def test_what_is_not_found_is_a_warning(self):
        # Light that goes round in a ball of glass has eigenvalues of modulus 1 without end.
        ball = neumann.load(scene_file("glass-ball"))
        with self.assertWarnsRegex(
            neumann.NeumannWarning, "^red: eigenvalues were not found within 40 applications of K, largest residual "
        ):
            found = ball.spectrum(patches=400, directions=16, most=40)
        for channel in found.channels:
            self.assertAlmostEqual(channel.spectral_radius, 1.0, 9)

    def test_solve(self):
        found = furnace(0.9).solve(error=1e-8, **SIZE)
        self.assertEqual(list(found)[0], "neumann")
        for name in ("neumann", "gmres", "lu"):
            self.assertEqual(found[name].verdict, "converged", found[name].why)
            np.testing.assert_allclose(found[name].x, 10.0, rtol=2e-7)
        self.assertAlmostEqual(found.about.spectral_radius, 0.9, 10)
        history = found["neumann"].history
        self.assertTrue((np.diff(history["applications"]) > 0).all())

    def test_warnings_and_errors(self):
        with self.assertRaisesRegex(neumann.InputError, "^directions: '3' is not a power of two from 1 to 1048576, such as 32 or 64$"):
            furnace().matrices(directions=3)
        with self.assertRaisesRegex(neumann.InputError, "^channel: x not in {r,g,b}$"):
            furnace().matrices(channel="x")


if __name__ == "__main__":
    unittest.main()
