"""The series and its solvers on matrices that are known: the unit cube, and small ones."""

import unittest

import neumann
import numpy as np
import scipy.sparse
from support import Case


class Series(Case):
    def test_known_limit(self):
        # L = 1 + 0.9 L, and L = 1 + 0.5 L.
        found = neumann.series(np.diag([0.9, 0.5]), [1.0, 1.0], error=1e-9, norm=0.9)
        self.assertEqual(found.verdict, "converged")
        np.testing.assert_allclose(found.sum, [10.0, 2.0], rtol=1e-8)
        np.testing.assert_allclose(found.rows["sup"][:4], 0.9 ** np.arange(4), rtol=1e-14)
        # The bound a^{n+1}/(1−a) ‖Le‖∞ is what is left, here.
        np.testing.assert_allclose(found.rows["a_priori"][:4], 0.9 ** np.arange(1, 5) / 0.1, rtol=1e-12)

    def test_enclosure_holds(self):
        room = neumann.cube(4)
        K = 0.9 * room.F
        Le = (room.face == 5).astype(float)
        found = neumann.series(K, Le, error=1e-3, measure=room.area)
        L = np.linalg.solve(np.eye(len(Le)) - K, Le)
        self.assertTrue(found.enclosure.exists, found.enclosure.why)
        self.assertTrue((found.enclosure.low <= L * (1 + 1e-12)).all())
        self.assertTrue((found.enclosure.high >= L * (1 - 1e-12)).all())
        self.assertLessEqual(np.abs(found.sum - L).max(), 1e-3 * L.max())

    def test_verdicts(self):
        self.assertEqual(neumann.series([[1.02]], [1.0]).verdict, "diverging")
        self.assertEqual(neumann.series(np.diag([0.999, 0.5]), [1.0, 1.0], most=10).verdict, "limit")
        self.assertEqual(neumann.series(scipy.sparse.csr_matrix((3, 3)), np.ones(3)).verdict, "converged")

    def test_sparse_and_dense_are_alike(self):
        K = neumann.cube(2).F * 0.7
        Le = np.arange(len(K), dtype=float)
        dense, sparse = (neumann.series(x, Le, norm=0.7, error=1e-12) for x in (K, scipy.sparse.coo_matrix(K)))
        np.testing.assert_allclose(dense.sum, sparse.sum, rtol=1e-13)

    def test_sizes_are_checked(self):
        with self.assertRaisesRegex(neumann.InputError, "^Le has 2 values, expected 3, one for each unknown of K$"):
            neumann.series(np.zeros((3, 3)), [1.0, 2.0])
        with self.assertRaises(ValueError):
            neumann.series(np.zeros((3, 2)), [1.0, 2.0])

    def test_what_is_no_number_is_refused(self):
        K, Le = np.full((3, 3), 0.1), np.ones(3)
        nan = np.where(np.eye(3), np.nan, K)
        with_nan = scipy.sparse.csr_matrix(nan)
        for call, said in (
            (lambda: neumann.series(nan, Le), r"K\[0, 0\]: nan, expected finite numbers"),
            (lambda: neumann.solve(with_nan, Le), r"the entries of K\[0\]: nan, expected finite numbers"),
            (lambda: neumann.spectrum(nan), r"K\[0, 0\]: nan, expected finite numbers"),
            (lambda: neumann.spectrum(K * 1j), "K: complex numbers, expected real ones"),
            (lambda: neumann.series(scipy.sparse.csr_matrix(K * 1j), Le), "the entries of K: complex numbers, expected real ones"),
            (lambda: neumann.series(K, [1.0, np.inf, 1.0]), r"Le\[1\]: inf, expected finite numbers"),
            (lambda: neumann.solve(K, [1.0, np.nan, 1.0], "lu"), r"Le\[1\]: nan, expected finite numbers"),
            (lambda: neumann.solve(K, Le, exact=Le * 1j), "exact: complex numbers, expected real ones"),
            (lambda: neumann.solve(K, Le, reflectance=[0.1, np.nan, 0.1]), r"reflectance\[1\]: nan, expected finite numbers"),
            (lambda: neumann.series(K, Le, measure=[1.0, np.nan, 1.0]), r"measure\[1\]: nan, expected finite numbers"),
        ):
            with self.assertRaisesRegex(neumann.InputError, f"^{said}$"):
                call()


class Solvers(Case):
    def test_cube_at_0_99(self):
        # Applications of K until the error is 1e-3 at albedo 0.99, as other programs count them; see operators/experiments/known/acceleration.cpp.
        # Theirs may differ by 2, or by 10%.
        room = neumann.cube(16)
        K, rho = 0.99 * room.F, np.full(len(room.area), 0.99)
        Le = (room.face == 5).astype(float)
        L = np.linalg.solve(np.eye(len(Le)) - K, Le)
        about = dict(measure=room.area, reflectance=rho, exact=L, error=1e-9, radius=0.99)
        for name, expected in (("neumann", 682), ("ratio-tail", 12), ("chebyshev", 53), ("gmres", 8), ("cg", 8)):
            found = neumann.solve(K, Le, name, most=1000, **about)
            first = found.history["applications"][found.history["error"] <= 1e-3][0] - found.setup_applications
            self.assertLessEqual(abs(first - expected), max(2, 0.1 * expected), name)
        # With the lowest eigenvalue known, too.
        found = neumann.solve(K, Le, "chebyshev", most=1000, lowest=-0.3829539879, **about)
        first = found.history["applications"][found.history["error"] <= 1e-3][0] - found.setup_applications
        self.assertLessEqual(abs(first - 44), 4.4)

    def test_all_agree(self):
        room = neumann.cube(2)
        K = 0.6 * room.F
        Le = (room.face == 5).astype(float)
        L = np.linalg.solve(np.eye(len(Le)) - K, Le)
        found = neumann.solve(K, Le, "all", measure=room.area, reflectance=np.full(24, 0.6), radius=0.6, error=1e-8)
        self.assertEqual(list(found), list(neumann.SOLVERS))
        for name, one in found.items():
            if one.verdict == "converged":
                np.testing.assert_allclose(one.x, L, atol=1e-6, err_msg=name)
        self.assertGreaterEqual(sum(one.verdict == "converged" for one in found.values()), 14)
        self.assertIn("<table>", found._repr_html_())

    def test_unknown_solver(self):
        with self.assertRaisesRegex(neumann.InputError, "^no solver is called 'newton'; there are neumann, ratio-tail, aitken, .*lu$"):
            neumann.solve(np.zeros((1, 1)), [1.0], "newton")

    def test_spectrum(self):
        # λ = 0.9 and −0.88209, of concentric spheres.
        K = np.array([[0.0, 0.9], [0.9 * 0.9801, 0.9 * 0.0199]])
        found = neumann.spectrum(K, 2, measure=[0.9801, 1.0])
        np.testing.assert_allclose(found.eigenvalues, [0.9, -0.88209], rtol=1e-12)
        self.assertAlmostEqual(found.norms["inf"], 0.9, 14)
        self.assertEqual(found.series, "converges")


if __name__ == "__main__":
    unittest.main()
