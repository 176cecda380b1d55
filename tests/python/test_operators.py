"""K, T and R as SciPy's operators: products are those of the matrices, and SciPy's solvers and eigensolvers take them."""

import inspect
import unittest

import neumann
import numpy as np
import scipy.sparse.linalg
from scipy.sparse.linalg import LinearOperator
from support import Case, ball, cornell, furnace, scene_file

SIZE = {"patches": 150, "directions": 16}
# SciPy 1.12 renamed it.
RELATIVE = "rtol" if "rtol" in inspect.signature(scipy.sparse.linalg.gmres).parameters else "tol"
EPSILON = np.finfo(float).eps


def glossy():
    return neumann.load(scene_file("glossy-floor"), res=16)


def dense(A):
    return A @ np.eye(A.shape[1])


class Products(Case):
    def test_those_of_matrices(self):
        for scene in (cornell(), glossy()):
            made, operators = scene.matrices(channel="g", **SIZE), scene.operators(channel="g", **SIZE)
            for name in ("Le", "b", "measure"):
                np.testing.assert_array_equal(getattr(operators, name), getattr(made, name))
            K, n = made.K, len(made.Le)
            x = np.random.default_rng(1).standard_normal(n)
            # Sums of at most some hundreds of terms of either sign.
            close = lambda found, A, x: np.testing.assert_array_less(abs(found - A @ x), 1000 * EPSILON * (abs(A) @ abs(x)) + 1e-300)
            close(operators.K @ x, K, x)
            close(operators.K.rmatvec(x), K.T, x)
            close(operators.K @ (x + 2j * x[::-1]), K, x + 2j * x[::-1])
            close(operators.R @ (operators.T @ x), K, x)
            close(operators.T.rmatvec(operators.R.rmatvec(x)), K.T, x)
            close(operators.I_minus_K @ x, scipy.sparse.identity(n) - K, x)
            close(operators.I_minus_K.rmatvec(x), scipy.sparse.identity(n) - K.T, x)
            star = scipy.sparse.diags(1 / made.measure) @ K.T @ scipy.sparse.diags(made.measure)
            close(operators.K_star @ x, star, x)
            close(operators.K_star.rmatvec(x), star.T, x)
            for A in (operators.K, operators.T, operators.R, operators.I_minus_K):
                self.assertIsInstance(A, LinearOperator)
                self.assertEqual(A.shape, (n, n))

    def test_transport_is_the_mean_of_rays(self):
        made, operators = cornell().matrices(channel="g", **SIZE), cornell().operators(channel="g", **SIZE)
        x = np.random.default_rng(2).random(len(made.Le))
        np.testing.assert_allclose(operators.T @ x, (made.T @ x).reshape(-1, 16).mean(axis=1), rtol=100 * EPSILON)
        np.testing.assert_array_equal(operators.R @ x, made.reflectance * x)
        self.assertIsNone(glossy().operators(**SIZE).reflectance)

    def test_the_channel_that_reflects_most(self):
        # ⟨K 1, 1⟩ / ⟨1, 1⟩ of each.
        quotients = {}
        for letter in "rgb":
            made = cornell().matrices(channel=letter, **SIZE)
            quotients[made.channel] = np.average(made.K @ np.ones(len(made.Le)), weights=made.measure)
        self.assertEqual(cornell().operators(**SIZE).channel, max(quotients, key=quotients.get))

    def test_radius_when_asked_for(self):
        made = cornell().operators(channel="g", **SIZE)
        self.assertIsNone(made._radius)
        values = np.linalg.eigvals(dense(made.K))
        self.assertAlmostEqual(made.radius, np.abs(values).max(), 9)
        self.assertNotIn("radius", repr(made))

    def test_sizes(self):
        K = furnace().operators(**SIZE).K
        with self.assertRaises(ValueError):
            K @ np.ones(3)
        with self.assertRaisesRegex(neumann.InputError, r"^x has 3 values, expected \d+$"):
            K.compiled.apply(np.ones(3))


class Solving(Case):
    def test_gmres_with_preconditioners(self):
        operators = ball(self.folder, 0.9).operators(patches=20, directions=64)
        A = dense(operators.I_minus_K)
        self.assertLess(np.diag(A).min(), 0.99)
        np.testing.assert_allclose(dense(operators.jacobi()), np.diag(1 / np.diag(A)), rtol=1e-14)
        K = np.eye(len(A)) - A
        np.testing.assert_allclose(dense(operators.series(3)), np.eye(len(A)) + K + K @ K, rtol=1e-12, atol=1e-15)
        np.testing.assert_allclose(operators.series(3).rmatvec(np.arange(len(A))), (np.eye(len(A)) + K + K @ K).T @ np.arange(len(A)), rtol=1e-12)

        operators = cornell().operators(channel="r", **SIZE)
        L = np.linalg.solve(dense(operators.I_minus_K), operators.Le)
        steps = {}
        for name, M in (("none", None), ("jacobi", operators.jacobi()), ("series", operators.series(4))):
            history = []
            found, info = scipy.sparse.linalg.gmres(
                operators.I_minus_K, operators.Le, M=M, atol=0, callback=history.append, callback_type="pr_norm", **{RELATIVE: 1e-10}
            )
            self.assertEqual(info, 0, name)
            np.testing.assert_allclose(found, L, atol=1e-8 * L.max(), err_msg=name)
            steps[name] = len(history)
        # I − K times four terms is I − K⁴, a Krylov space that grows by four powers a step.
        self.assertLess(steps["series"], 0.5 * steps["none"])
        with self.assertRaisesRegex(neumann.InputError, "^terms=0: expected 1 or more$"):
            operators.series(0)

    def test_eigenvalues(self):
        operators = cornell().operators(channel="r", **SIZE)
        found = scipy.sparse.linalg.eigs(operators.K, k=3, v0=np.ones(len(operators.Le)), return_eigenvectors=False)
        expected = np.linalg.eigvals(dense(operators.K))
        np.testing.assert_allclose(np.sort(abs(found)), np.sort(abs(expected))[-3:], rtol=1e-9)

    def test_symmetrised(self):
        operators = cornell().operators(channel="r", **SIZE)
        n, m, rho, Le = len(operators.Le), operators.measure, operators.reflectance, operators.Le
        T = dense(operators.T)
        mean = 0.5 * (T + (T * m[:, None]).T / m[:, None])
        K = rho[:, None] * mean
        sym = operators.symmetrised()
        S = dense(sym.S)
        np.testing.assert_allclose(S, S.T, rtol=1e-12, atol=1e-16)
        np.testing.assert_allclose(S, np.sqrt(rho * m)[:, None] * mean * np.sqrt(rho / m), rtol=1e-12, atol=1e-16)
        # The eigenvalues of K̄, which are real.
        values, vectors = scipy.sparse.linalg.eigsh(sym.S, k=3, v0=np.ones(n))
        expected = np.linalg.eigvals(K)
        expected = expected[np.argsort(abs(expected))][-3:]
        np.testing.assert_allclose(np.sort(values), np.sort(expected.real), rtol=1e-9)
        mode = sym.mode(vectors[:, -1])
        np.testing.assert_allclose(K @ mode, values[-1] * mode, atol=1e-9 * abs(mode).max())
        # The solution.
        L = np.linalg.solve(np.eye(n) - K, Le)
        z, info = scipy.sparse.linalg.cg(sym.I_minus_S, sym.b, M=sym.series(2), atol=0, **{RELATIVE: 1e-11})
        self.assertEqual(info, 0)
        np.testing.assert_allclose(sym.field(z), L, atol=1e-8 * L.max())
        with self.assertRaisesRegex(neumann.InputError, ": expected diffuse surfaces alone; only of them K is made symmetric$"):
            glossy().operators(**SIZE).symmetrised()

    def test_symmetrised_where_black(self):
        # Albedo 0: L = Le, and nothing is divided by ρ.
        sym = furnace(0).operators(**SIZE).symmetrised()
        np.testing.assert_array_equal(sym.b, 0.0)
        np.testing.assert_array_equal(sym.field(np.zeros(len(sym.b))), 1.0)

    def test_our_solvers(self):
        operators = cornell().operators(channel="r", **SIZE)
        K = dense(operators.K)
        L = np.linalg.solve(np.eye(len(K)) - K, operators.Le)
        for found in (neumann.solve(operators.K, operators.Le, "gmres", error=1e-9).x, neumann.series(operators.K, operators.Le, error=1e-9).sum):
            np.testing.assert_allclose(found, L, atol=1e-8 * L.max())
        self.assertAlmostEqual(neumann.spectrum(operators.K, 1).spectral_radius, abs(np.linalg.eigvals(K)).max(), 9)
        for K, measure, said in (
            (operators.T, None, "K is a LinearOperator, expected the K of scene.operators(), or a matrix"),
            (operators.K, operators.measure, "measure: the K of scene.operators() has its own"),
        ):
            with self.assertRaises(neumann.InputError) as caught:
                neumann.solve(K, operators.Le, measure=measure)
            self.assertEqual(str(caught.exception), said)


if __name__ == "__main__":
    unittest.main()
