"""Everything public says what it is: docstrings, types, and stubs that agree with what is compiled."""

import ast
import inspect
import os
import unittest
from pathlib import Path

import neumann
from neumann import _neumann

STUBS = Path(os.environ["STUBS"])


def public(names):
    return {name for name in names if not name.startswith("_")}


class Stubs(unittest.TestCase):
    def test_compiled_part(self):
        stub = ast.parse((STUBS / "_neumann.pyi").read_text())
        named, members = {}, {}
        for node in stub.body:
            if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
                named[node.name] = node
            elif isinstance(node, ast.AnnAssign):
                named[node.target.id] = node
            if isinstance(node, ast.ClassDef):
                members[node.name] = {n.name if isinstance(n, ast.FunctionDef) else n.target.id for n in node.body[1:]}
        self.assertEqual(public(named), public(dir(_neumann)))
        for name, expected in members.items():
            if not issubclass(getattr(_neumann, name), Exception):
                self.assertEqual(public(expected), public(dir(getattr(_neumann, name))), name)
        for name, node in named.items():
            if isinstance(node, ast.FunctionDef):
                signature = getattr(_neumann, name).__doc__.splitlines()[0]  # as pybind11 writes it
                for argument in node.args.args:
                    self.assertIn(f"{argument.arg}: ", signature, name)

    def test_package(self):
        self.assertTrue((Path(neumann.__file__).parent / "py.typed").exists())
        for name in neumann.__all__:
            thing = getattr(neumann, name)
            if name != "SOLVERS":
                self.assertTrue(thing.__doc__, name)
            if inspect.isfunction(thing):
                self.expect_typed(thing)
            if inspect.isclass(thing) and not issubclass(thing, Exception):
                own = [base for base in inspect.getmro(thing) if base.__module__.startswith("neumann")]
                for member, value in (pair for base in own for pair in vars(base).items()):
                    function = value.fget if isinstance(value, property) else getattr(value, "func", value)
                    if member.startswith("_") or not inspect.isfunction(function):
                        continue
                    self.expect_typed(function)

    def expect_typed(self, function):
        name = function.__qualname__
        self.assertTrue(function.__doc__, name)
        signature = inspect.signature(function)
        self.assertIsNot(signature.return_annotation, inspect.Signature.empty, name)
        for parameter in signature.parameters.values():
            if parameter.name != "self":
                self.assertIsNot(parameter.annotation, inspect.Parameter.empty, f"{name}: {parameter.name}")

    def test_keywords_are_options(self):
        # Every option of the command has its keyword, but for those that say where things go, and what is on disk meanwhile.
        import subprocess

        known = {"o": None, "part": None, "checkpoint": None, "keep": None, "resume": None, "channels": None, "files": None, "paths": None, "theme": None, "touch": None, "hemisphere": None, "tev": None, "n": "bounces", "t": "threads", "D": None, "lenient": None, "json": None, "quiet": "quiet", "help": None, "h": None}
        for command, function in (("render", neumann.Scene.render), ("study", neumann.Scene.study), ("spectrum", neumann.Scene.spectrum), ("blame", neumann.blame)):
            text = subprocess.run([os.environ["NEUMANN"], command, "--help"], capture_output=True, text=True).stdout
            options = {word.split(",")[0].lstrip("-") for line in text.splitlines() if line.startswith("  -") for word in line.split()[:1]}
            for option in options:
                name = known.get(option, option.replace("-", "_"))
                if name not in (None, "csv", "petsc"):
                    self.assertIn(name, inspect.signature(function).parameters, command)


if __name__ == "__main__":
    unittest.main()
