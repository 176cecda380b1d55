"""What is wrong is an exception, with the text that the command prints."""

import os
import re
import unittest
from pathlib import Path

import neumann
from support import Case, command, cornell, furnace, scene_file


class Errors(Case):
    def expect_as_command(self, function, *arguments):
        done = command(*arguments, folder=self.folder)
        self.assertEqual(done.returncode, 2)
        with self.assertRaises(neumann.InputError) as caught:
            function()
        # The command adds a hint to what its options say, and has another name for what is lenient.
        said = done.stderr.replace("Run with --help for more information.\n", "").replace("\n--lenient takes", "\nlenient=True takes")
        # Each begins with the option as it was spelled.
        said = re.sub(r"^--([\w-]+)|^-n", lambda m: (m[1] or "bounces").replace("-", "_"), said)
        self.assertEqual(str(caught.exception), said.rstrip("\n"))
        self.assertEqual(done.stdout, "")

    def test_scenes(self):
        path = self.folder / "wrong.xml"
        path.write_text('<scene version="3.0.0">\n  <sensor type="perspective"/>\n  <shape type="sphre"/>\n</scene>\n')
        self.expect_as_command(lambda: neumann.load(path), "render", path)
        with self.assertRaisesRegex(neumann.InputError, r"wrong\.xml:3:\d+: "):
            neumann.load(path)
        with self.assertRaisesRegex(neumann.InputError, r"sphere'\?\nlenient=True takes the scene without what is not known$"):
            neumann.load(path)
        self.expect_as_command(lambda: neumann.load(self.folder / "none.xml"), "render", self.folder / "none.xml")
        box = scene_file("cornell-box")
        self.expect_as_command(lambda: neumann.load(box, colour="red"), "render", box, "-D", "colour=red")

    def test_names_of_bytes(self):
        # Names of files are bytes: what is said of them, while it runs too, holds them as os.fsdecode makes them.
        name = os.fsdecode(b"m\xfcll.xml")
        path = self.folder / name
        with self.assertRaisesRegex(neumann.InputError, name):
            neumann.load(path)
        path.write_text('<scene version="3.0.0"><shape type="sphre"/></scene>')
        with self.assertRaisesRegex(neumann.InputError, name + r":1:31: shape type 'sphre'"):
            neumann.load(path)
        with self.assertRaisesRegex(neumann.InputError, "-D x=\udcfc: nothing"):
            neumann.load(scene_file("cornell-box"), x=os.fsdecode(b"\xfc"))
        path.write_text(Path(scene_file("furnace")).read_text())
        scene = neumann.load(path, res=8)
        self.assertIn(name, repr(scene.matrices(patches=6)))
        folder = self.folder / os.fsdecode(b"f\xfcr")
        job = scene.render(spp=1, quiet=True)._source.rendering.save(os.fsencode(folder))
        while not job.wait(0.1):
            pass
        self.assertIn(folder.name, job.progress()[0])

    def test_lenient(self):
        path = self.folder / "odd.xml"
        path.write_text(
            '<scene version="3.0.0">\n<shape type="sphere"><bsdf type="cloth"/></shape><emitter type="constant"/>\n'
            '<sensor type="perspective"><film type="hdrfilm"><integer name="width" value="8"/>'
            '<integer name="height" value="6"/></film></sensor></scene>\n'
        )
        scene = neumann.load(path, lenient=True)
        replaced = f"{path}:2:28: bsdf type 'cloth' is not supported; taken as 'diffuse' of reflectance 0.5"
        self.assertEqual(scene.replaced, [replaced])
        self.assertEqual([str(w.message) for w in self.warned], [replaced])
        self.assertIn("lenient", repr(scene))
        series = scene.render(bounces=1, spp=4, quiet=True)
        self.assertEqual(series.run["scene"]["replaced"], [replaced])
        self.assertTrue(series.run["command"].endswith(" --lenient"), series.run["command"])
        self.assertEqual(cornell().replaced, [])

    def test_arguments(self):
        box = scene_file("cornell-box")
        for keywords, options in (
            ({"bounces": 1.5}, ["-n", "1.5"]),
            ({"spp": 0}, ["--spp", "0"]),
            ({"spp": "many"}, ["--spp", "many"]),
            ({"seed": 2**64}, ["--seed", str(2**64)]),
            ({"seed": 2**70}, ["--seed", str(2**70)]),
            ({"method": "photons"}, ["--method", "photons"]),
            ({"roulette": 2}, ["--roulette", "2"]),
            ({"method": "matrix", "sampler": "sobol"}, ["--method", "matrix", "--sampler", "sobol"]),
            ({"method": "light", "direct": "mis"}, ["--method", "light", "--direct", "mis"]),
            ({"importance": True}, ["--importance"]),
            ({"reference": "nowhere", "spp": 1}, ["--reference", "nowhere", "--spp", "1"]),
        ):
            with self.subTest(**keywords):
                self.expect_as_command(lambda: cornell().render(**keywords), "render", box, "-D", "res=16", *options)
        with self.assertRaisesRegex(neumann.InputError, "^bounces: '-1' is not a whole number from 0 to 100000$"):
            cornell().render(bounces=-1)
        with self.assertRaisesRegex(neumann.InputError, "^tail excludes bounces$"):
            cornell().render(bounces=3, tail=0.1)
        with self.assertRaises(TypeError):
            cornell().render(samples=4)

    def test_kinds(self):
        self.assertTrue(issubclass(neumann.InputError, ValueError))
        self.assertTrue(issubclass(neumann.RunError, RuntimeError))
        self.assertEqual(neumann.InputError.__module__, "neumann")

    def test_run_error(self):
        # Albedo 1 in a closed room: no number of bounces leaves little.
        with self.assertRaisesRegex(neumann.RunError, "^tail 0.1: the series does not converge: "):
            furnace(1).render(tail=0.1)

    def test_saving(self):
        series = furnace().render(bounces=1, spp=1, quiet=True)
        (self.folder / "file").write_text("")
        with self.assertRaisesRegex(neumann.InputError, "file: cannot be written: Not a directory"):
            series.save(self.folder / "file")
        with self.assertRaisesRegex(neumann.InputError, "no run.json; expected the folder of a render that was finished"):
            neumann.read(self.folder)

    def test_warnings(self):
        furnace().render(bounces=1, spp=1)
        texts = [str(w.message) for w in self.warned if issubclass(w.category, neumann.NeumannWarning)]
        self.assertEqual(texts, ["a single replicate was sampled: the standard errors are unknown"])
        self.assertEqual(self.warned[0].filename, __file__)
        self.warned.clear()
        furnace().render(bounces=1, spp=1, quiet=True)
        self.assertEqual(self.warned, [])


if __name__ == "__main__":
    unittest.main()
