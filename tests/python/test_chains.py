"""The walk of a chain as arrays."""

import unittest

import neumann
import numpy as np
from support import Case, cornell, scene_file


class Chains(Case):
    def test_rows_are_states(self):
        chain = cornell(32).chain(2, states=3000, seed=3)
        n = len(chain)
        self.assertEqual(n, 3000)
        for name, shape in (("position", (n, 2)), ("s", (n,)), ("size", (n,)), ("accepted", (n,)), ("large", (n,))):
            self.assertEqual(getattr(chain, name).shape, shape)
        self.assertTrue((chain.position >= 0).all() and (chain.position <= 32).all())
        self.assertTrue((chain.size > 0).all())
        self.assertTrue(((chain.s >= 0) & (chain.s <= 3)).all())
        # A refused step repeats the state; a small one keeps the way.
        again = ~chain.accepted
        self.assertTrue(0.05 < again.mean() < 0.95)
        for values in (chain.position[:, 0], chain.size, chain.s):
            np.testing.assert_array_equal(values[1:][again[1:]], values[:-1][again[1:]])
        small = chain.accepted & ~chain.large
        np.testing.assert_array_equal(chain.s[1:][small[1:]], chain.s[:-1][small[1:]])

    def test_same_seed_same_walk(self):
        a, b, other = (neumann.load(scene_file("cornell-box"), res=16).chain(3, states=200, seed=s) for s in (1, 1, 2))
        np.testing.assert_array_equal(a.position, b.position)
        self.assertFalse(np.array_equal(a.position, other.position))

    def test_what_is_wrong(self):
        for arguments, message in (((0,), "bounce 0: expected at least 1"),):
            with self.assertRaises(neumann.InputError) as caught:
                cornell().chain(*arguments)
            self.assertEqual(str(caught.exception), message)
        with self.assertRaises(neumann.InputError) as caught:
            neumann.load(scene_file("glass-ball"), res=16).chain(1, states=0)
        self.assertEqual(str(caught.exception), "states 0: expected 1 to 16777216")


if __name__ == "__main__":
    unittest.main()
