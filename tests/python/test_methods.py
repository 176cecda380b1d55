"""Methods as values: their options are those that the command takes for them, and they render the same bits."""

import dataclasses
import os
import subprocess
import typing
import unittest

import neumann
import numpy as np
from neumann._method import Method
from neumann._method_options import HELP
from support import Case, cornell, furnace

METHODS = {kind.name: kind for kind in Method.__subclasses__()}
# A legal value of each option.
LEGAL = {
    "direct": "mis", "lights": "power", "roulette": 0.9, "split": (2, 2), "sampler": "independent", "indirect": "cosine", "tree": "sum", "reuse": True, "adaptive": "sum", "bias_allowed": True, "plan": "full",
    "patches": 50, "directions": 16, "photons": 100, "radius": 0.5, "gather": True, "records": "hessian", "accuracy": 0.1, "chain": 64, "ways": 1,
    "importance": True,
}  # fmt: skip


class Methods(Case):
    def test_all_are_there(self):
        # The command names them where it is given another.
        done = subprocess.run([os.environ["NEUMANN"], "render", "x.xml", "--method", "xyzzy"], capture_output=True, text=True)
        named = done.stderr.partition("{")[2].partition("}")[0].split(",")
        self.assertEqual(list(METHODS), named)
        for name, kind in METHODS.items():
            self.assertIs(getattr(neumann, kind.__name__), kind)
            self.assertEqual(kind.__name__.lower(), name)
            self.assertTrue(kind.__doc__)
        self.assertEqual(set(LEGAL) | {"method"}, set(HELP))

    def test_options_are_those_of_the_command(self):
        # A method that has not an option is told by the command which have it; none is of both surface and patches.
        for option, value in LEGAL.items():
            named = set()
            for other in ("surface", "patches"):
                words = [os.environ["NEUMANN"], "render", "x.xml", "--method", other, f"--{option.replace('_', '-')}"]
                words += [] if value is True else [",".join(map(str, np.ravel(value)))]
                said = subprocess.run(words, capture_output=True, text=True).stderr
                if " belongs to " in said:
                    named |= set(said.partition(" belongs to ")[2].partition(", not to")[0].replace(" and ", ", ").split(", "))
            self.assertTrue(named, option)
            self.assertEqual({name for name, kind in METHODS.items() if option in {f.name for f in dataclasses.fields(kind)}}, named, option)
        with self.assertRaises(TypeError):
            neumann.Walk(patches=50)

    def test_words_complete(self):
        hints = typing.get_type_hints(neumann.Walk)
        (words, none) = typing.get_args(hints["direct"])
        self.assertIs(none, type(None))
        for word in typing.get_args(words):
            furnace().render(method=neumann.Walk(direct=word, plan="full"), bounces=1, spp=1, quiet=True)
        with self.assertRaisesRegex(neumann.InputError, "^direct: lihgt not in {" + ",".join(typing.get_args(words)) + "}"):
            furnace().render(method=neumann.Walk(direct="lihgt"), quiet=True)

    def test_same_bits(self):
        given = dict(bounces=2, spp=8, quiet=True)
        by_value = cornell().render(method=neumann.Walk(direct="light", roulette=0.75, split=(2, 2)), **given)
        by_words = cornell().render(method="walk", direct="light", roulette=0.75, split=(2, 2), **given)
        np.testing.assert_array_equal(by_value.terms, by_words.terms)
        self.assertEqual(by_value.run.command, by_words.run.command)

    def test_as_a_value(self):
        walk = neumann.Walk(direct="light", split=(8, 8))
        self.assertEqual(str(walk), "walk:direct=light:split=8,8")
        self.assertEqual(repr(walk), "Walk(direct='light', split=(8, 8))")
        self.assertEqual(walk, neumann.Walk(direct="light", split=(8, 8)))
        self.assertNotEqual(walk, neumann.Walk(direct="light"))
        self.assertEqual(str(neumann.Photon(gather=True)), "photon:gather=true")
        self.assertEqual(str(neumann.Auto(bias_allowed=True)), "auto:bias-allowed=true")
        with self.assertRaises(dataclasses.FrozenInstanceError):
            walk.direct = "mis"
        with self.assertRaisesRegex(TypeError, r"^render\(\) got 'direct' as a keyword and in method=Walk\(direct='light'\)$"):
            furnace().render(method=neumann.Walk(direct="light"), direct="mis")

    def test_study(self):
        study = furnace().study(
            [neumann.Walk(direct="light"), neumann.Light()], samples=[1, 2], repeats=2, bounces=1, reference="values:1,0.5", quiet=True
        )
        self.assertEqual(study.methods, ["walk:direct=light", "light"])


if __name__ == "__main__":
    unittest.main()
