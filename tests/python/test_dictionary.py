"""Scenes as dictionaries are those of files that say the same, and edits give the scenes that they say."""

import copy
import unittest

import neumann
import numpy as np
from neumann._dictionary import TAGS
from support import SCENES, Case, furnace


def room(albedo=0.5, res=8):
    """The furnace."""
    return {
        "type": "scene",
        "integrator": {"type": "path", "max_depth": -1},
        "sensor": {
            "type": "perspective",
            "fov": 90,
            "to_world": neumann.look_at([0.3, -0.2, 0.1], [-1, 0.8, -0.9], [0, 1, 0]),
            "sampler": {"type": "ldsampler", "sample_count": 16},
            "film": {"type": "hdrfilm", "width": res, "height": res, "rfilter": {"type": "box"}},
        },
        "grey": {"type": "diffuse", "reflectance": {"type": "rgb", "value": albedo}},
        "walls": {
            "type": "cube",
            "flip_normals": True,
            "bsdf": {"type": "ref", "id": "grey"},
            "emitter": {"type": "area", "radiance": {"type": "rgb", "value": [1.0, 1.0, 1.0]}},
        },
    }


def faces_of_cube():
    """Vertices and triangles of [−1, 1]³, seen from inside."""
    vertices = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], dtype=float)
    quads = []
    for axis in range(3):
        for side in (-1, 1):
            corners = np.flatnonzero(vertices[:, axis] == side)
            a, b, c, d = corners[[0, 1, 3, 2]]
            normal = np.cross(vertices[b] - vertices[a], vertices[d] - vertices[a])
            inwards = normal[axis] * side < 0
            quads += [[a, b, c], [a, c, d]] if inwards else [[a, c, b], [a, d, c]]
    return vertices, np.array(quads)


def terms(scene, **options):
    return scene.render(**{"bounces": 3, "spp": 16, "method": "walk", "quiet": True, **options}).terms


class Dictionaries(Case):
    def test_as_the_file(self):
        scene = neumann.load_dict(room())
        np.testing.assert_array_equal(terms(scene), terms(furnace()))
        self.assertEqual(scene.path, "dict")
        self.assertRegex(repr(scene), "^<Scene dict: 1 shapes, 8 × 8 pixels>$")

    def test_all_kinds_of_values(self):
        # Against a file of Mitsuba that says the same.
        given = {
            "type": "scene",
            "sensor": {
                "type": "thinlens", "fov": 40.0, "aperture_radius": np.float32(0.125), "focus_distance": 4, "fov_axis": "smaller",
                "to_world": np.diag([-1.0, 1, -1, 1]) + 4 * np.eye(4, k=1) * [[0], [0], [1], [0]],
                "film": {"type": "hdrfilm", "width": np.int64(12), "height": 10},
            },
            "paint": {"type": "twosided", "inside": {"type": "diffuse", "reflectance": {
                "type": "checkerboard", "color0": {"type": "rgb", "value": [0.1, 0.2, 0.3]}, "color1": 0.5,
                "to_uv": [[4, 0, 0.5], [0, 2, 0], [0, 0, 1]]}}},
            "mixed": {"type": "blendbsdf", "weight": 0.25, "bsdf_0": {"type": "ref", "id": "paint"}, "bsdf_1": {"type": "twosided", "b": {"type": "diffuse"}}},
            "ball": {"type": "sphere", "center": [0.5, 0, 0], "radius": 1, "bsdf": {"type": "conductor", "material": "Au"}},
            "back": {"type": "rectangle", "to_world": np.array([[3.0, 0, 0, 0], [0, 3, 0, 0], [0, 0, 3, -2], [0, 0, 0, 1]]), "bsdf": {"type": "ref", "id": "mixed"}},
            "sky": {"type": "constant", "radiance": {"type": "spectrum", "value": [(400, 0.5), (700, 1.0)]}},
            "lamp": {"type": "point", "position": [0, 3, 1], "intensity": {"type": "spectrum", "value": 2.0}},
        }  # fmt: skip
        path = self.folder / "same.xml"
        path.write_text("""<scene version="3.0.0">
            <sensor type="thinlens"><float name="fov" value="40"/><float name="aperture_radius" value="0.125"/>
                <float name="focus_distance" value="4"/><string name="fov_axis" value="smaller"/>
                <transform name="to_world"><matrix value="-1 0 0 0  0 1 0 0  0 0 -1 4  0 0 0 1"/></transform>
                <film type="hdrfilm"><integer name="width" value="12"/><integer name="height" value="10"/></film></sensor>
            <bsdf type="twosided" id="paint"><bsdf type="diffuse"><texture type="checkerboard" name="reflectance">
                <rgb name="color0" value="0.1, 0.2, 0.3"/><float name="color1" value="0.5"/>
                <transform name="to_uv"><matrix value="4 0 0 0.5  0 2 0 0  0 0 1 0  0 0 0 1"/></transform></texture></bsdf></bsdf>
            <bsdf type="blendbsdf" id="mixed"><float name="weight" value="0.25"/><ref id="paint"/><bsdf type="twosided"><bsdf type="diffuse"/></bsdf></bsdf>
            <shape type="sphere"><point name="center" x="0.5" y="0" z="0"/><float name="radius" value="1"/>
                <bsdf type="conductor"><string name="material" value="Au"/></bsdf></shape>
            <shape type="rectangle"><transform name="to_world"><scale value="3"/><translate z="-2"/></transform><ref id="mixed"/></shape>
            <emitter type="constant"><spectrum name="radiance" value="400:0.5, 700:1"/></emitter>
            <emitter type="point"><point name="position" x="0" y="3" z="1"/><spectrum name="intensity" value="2"/></emitter>
        </scene>""")
        np.testing.assert_array_equal(terms(neumann.load_dict(given)), terms(neumann.load(path)))

    def test_look_at(self):
        # Columns are left, up, forward and origin, as x, y and z of Mitsuba's cameras.
        pose = neumann.look_at([1, 2, 3], [1, 2, 8], [0, 1, 0])
        np.testing.assert_allclose(pose, [[1, 0, 0, 1], [0, 1, 0, 2], [0, 0, 1, 3], [0, 0, 0, 1]])
        pose = neumann.look_at([0.3, -0.2, 0.1], [-1, 0.8, -0.9], [0.1, 1, 0])
        np.testing.assert_allclose(pose[:3, :3].T @ pose[:3, :3], np.eye(3), atol=1e-15)
        self.assertAlmostEqual(np.linalg.det(pose), 1.0, 14)
        with self.assertRaisesRegex(neumann.InputError, "^look_at: origin, target and up lie on a line"):
            neumann.look_at([0, 0, 0], [0, 1, 0], [0, 2, 0])

    def test_mesh(self):
        vertices, faces = faces_of_cube()
        given = room(0.25)
        given["walls"] = {"type": "mesh", "vertices": vertices, "faces": faces, "face_normals": True, **{k: given["walls"][k] for k in ("bsdf", "emitter")}}
        scene = neumann.load_dict(given)
        found = terms(scene)
        for i in range(4):
            np.testing.assert_allclose(found[i], 0.25**i, rtol=1e-6)
        self.assertNotEqual(scene.hash, neumann.load_dict({**given, "walls": {**given["walls"], "vertices": 2 * vertices}}).hash)
        self.assertEqual(scene.hash, neumann.load_dict(given).hash)
        # Twice as large, and moved back by to_world.
        half = np.diag([0.5, 0.5, 0.5, 1.0])
        moved = neumann.load_dict({**given, "walls": {**given["walls"], "vertices": 2 * vertices, "to_world": half}})
        np.testing.assert_array_equal(terms(moved), found)

    def test_whole_numbers_may_be_floats(self):
        given = {**room(), "x": {"type": "mesh", "vertices": np.eye(3), "faces": [[0.0, 1.0, 2.0]]}}
        self.assertEqual(neumann.load_dict(given).hash, neumann.load_dict({**given, "x": {**given["x"], "faces": [[0, 1, 2]]}}).hash)

    def test_mesh_with_normals_and_uv(self):
        square = {
            "type": "mesh",
            "vertices": [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]],
            "faces": [[0, 1, 2], [0, 2, 3]],
            "uv": [[0, 0], [1, 0], [1, 1], [0, 1]],
            "normals": [[0, 0, 1]] * 4,
            "bsdf": {"type": "diffuse", "reflectance": {"type": "checkerboard", "to_uv": np.diag([2.0, 2.0, 1.0])}},
        }
        given = {
            "type": "scene", "square": square, "sky": {"type": "constant", "radiance": 1.0},
            "sensor": {"type": "orthographic", "to_world": neumann.look_at([0, 0, 2], [0, 0, 0]), "film": {"type": "hdrfilm", "width": 16, "height": 16, "rfilter": {"type": "box"}}},
        }  # fmt: skip
        flat = copy.deepcopy(given)
        flat["square"] = {"type": "rectangle", "bsdf": square["bsdf"]}
        of_mesh, of_rectangle = terms(neumann.load_dict(given), bounces=1), terms(neumann.load_dict(flat), bounces=1)
        np.testing.assert_allclose(of_mesh, of_rectangle, rtol=1e-5)
        self.assertEqual(len(np.unique(of_mesh[1].round(3))), 2)  # the two squares of a checkerboard

    def test_errors_name_the_keys(self):
        def changed(**changes):
            return {**room(), **changes}

        triangle = {"type": "mesh", "vertices": np.zeros((3, 3)), "faces": [[0, 1, 2]]}
        for given, said in (
            ({"type": "diffuse"}, "dict: expected a dictionary with 'type': 'scene'"),
            (changed(grey={"type": "difuse"}), "dict#/grey/type: there is no plugin 'difuse'; did you mean 'diffuse'?"),
            (changed(grey={"type": "xyzzy"}), "dict#/grey/type: there is no plugin 'xyzzy', expected one of those in apps/manual/scenes.md"),
            (changed(grey={"reflectance": 0.5}), "dict#/grey: a dictionary without 'type'"),
            (changed(grey={"type": "diffuse", "reflectance": {"type": "rgb", "value": [1, 2]}}), "dict#/grey/reflectance: a colour of 2 numbers, expected one or three"),
            (changed(**{"a/b~c": {"type": "sphere", "radius": [1, 2]}}),
             "dict#/a~1b~0c/radius: list, expected a number, a text, True or False, three numbers, a 4 × 4 matrix or a dictionary with 'type'"),
            (changed(x={"type": "ref", "id": "grey", "name": "y"}), "dict#/x: expected {'type': 'ref', 'id': …} with nothing else"),
            (changed(x={"type": "constant", "radiance": {"type": "spectrum", "value": [1, 2, 3]}}), "dict#/x/radiance/value: expected a number, or pairs of wavelength and value"),
            (changed(x={**triangle, "faces": [[0, 1, 3]]}), "dict#/x/faces: numbers 0 to 3, expected 0 to 2"),
            (changed(x={**triangle, "faces": [[0, 1.5, 2]]}), "dict#/x/faces[0, 1]: 1.5, expected whole numbers"),
            (changed(x={**triangle, "faces": np.ones((1, 3), dtype=bool)}), "dict#/x/faces: True and False, expected whole numbers"),
            (changed(x={**triangle, "faces": [[0, 1j, 2]]}), "dict#/x/faces: complex numbers, expected real ones"),
            (changed(x={**triangle, "faces": [["0", "1", "b"]]}), "dict#/x/faces: <U1, expected numbers"),
            (changed(x={**triangle, "vertices": np.zeros((3, 3)) + 1j}), "dict#/x/vertices: complex numbers, expected real ones"),
            (changed(x={**triangle, "vertices": [[0, 0, 0], [1, np.nan, 0], [0, 1, 0]]}), "dict#/x/vertices[1, 1]: nan, expected finite numbers"),
            (changed(x={"type": "point", "position": np.array([0, 1j, 0])}), "dict#/x/position: complex numbers, expected real ones"),
            (changed(x={**triangle, "vertices": [0, 1]}), "dict#/x/vertices: an array (2,), expected (n, 3)"),
            (changed(x={**triangle, "uv": np.zeros((2, 2))}), "dict#/x/uv: 2 rows, expected one for each of 3 vertices"),
            (changed(x={"type": "mesh", "faces": [[0, 1, 2]]}), "dict#/x: a mesh without vertices"),
        ):  # fmt: skip
            with self.assertRaises(neumann.InputError) as caught:
                neumann.load_dict(given)
            self.assertEqual(str(caught.exception), said)
        # What the reader says has the same places.
        with self.assertRaisesRegex(neumann.InputError, "^mine#/grey/reflectanse: .*reflectanse"):
            neumann.load_dict(changed(grey={"type": "diffuse", "reflectanse": 0.5}), name="mine")
        with self.assertRaisesRegex(neumann.InputError, "^dict#/walls/bsdf: reference to 'gray', which is not defined"):
            neumann.load_dict(changed(walls={"type": "cube", "bsdf": {"type": "ref", "id": "gray"}}))

    def test_no_parameters_in_texts(self):
        # A $ is one.
        given = room()
        given["grey"]["reflectance"] = {"type": "bitmap", "filename": "no $file.png"}
        with self.assertRaisesRegex(neumann.InputError, r"^dict#/grey/reflectance.*no \$file\.png"):
            neumann.load_dict(given)

    def test_plugins_are_those_of_the_manual(self):
        rows = {}
        for line in (SCENES.parent / "apps/manual/scenes.md").read_text().splitlines():
            cells = [cell.strip() for cell in line.split("|")]
            if len(cells) == 4 and "`" in cells[2]:
                rows[cells[1]] = set(cells[2].split("`")[1::2])
        for row, tags in (("shapes", ["shape"]), ("materials", ["bsdf"]), ("textures", ["texture"]), ("emitters", ["emitter"]), ("sensors", ["sensor", "film", "rfilter"])):
            self.assertEqual({name for name, tag in TAGS.items() if tag in tags}, rows[row], row)
        self.assertEqual({name for name, tag in TAGS.items() if tag == "integrator"}, rows["integrators"] - {"max_depth", "hide_emitters"})

    def test_everything_takes_it(self):
        scene = neumann.load_dict(room(0.9))
        series = scene.render(bounces=1, spp=4, quiet=True)
        series.save(self.folder / "out")
        self.assertEqual(neumann.read(self.folder / "out").run.scene.hash, scene.hash)
        self.assertAlmostEqual(scene.spectrum(patches=50, directions=16).channels[0].spectral_radius, 0.9, 9)
        self.assertAlmostEqual(scene.operators(patches=50, directions=16).radius, 0.9, 9)
        self.assertGreater(len(scene.plan()), 0)
        study = scene.study(["walk"], samples=[1, 2], repeats=2, bounces=1, reference="values:1,0.9", quiet=True)
        self.assertEqual(study.methods, ["walk"])
        self.assertEqual(len(scene.chain(1, states=10)), 10)


class Edits(Case):
    def test_colour(self):
        scene, darker = neumann.load_dict(room(0.5)), terms(furnace(0.25))
        for name, value in (
            ("grey.reflectance.value", 0.25),
            ("grey.reflectance", {"type": "rgb", "value": 0.25}),
            ("walls.bsdf.reflectance.value", [0.25, 0.25, 0.25]),
        ):
            np.testing.assert_array_equal(terms(scene.edit({name: value})), darker)
        # The old one stays, edits add up, and each has a hash of its own.
        brighter = scene.edit({"grey.reflectance.value": 0.25}).edit({"walls.emitter.radiance.value": 2})
        np.testing.assert_allclose(terms(brighter), 2 * darker, rtol=1e-6)
        np.testing.assert_array_equal(terms(scene), terms(furnace(0.5)))
        self.assertEqual(brighter.edits, {"grey.reflectance.value": "0.25", "walls.emitter.radiance.value": "2"})
        self.assertEqual(len({scene.hash, brighter.hash, scene.edit({"grey.reflectance.value": 0.25}).hash}), 3)
        self.assertIn("2 edits", repr(brighter))
        again = brighter.edit({"grey.reflectance.value": 0.5, "walls.emitter.radiance.value": 1})
        np.testing.assert_array_equal(terms(again), terms(scene))
        self.assertIn("edited: grey.reflectance.value = 0.5", again.render(bounces=1, spp=1, quiet=True).run.command)

    def test_of_a_file(self):
        # -D albedo and an edit are the same; so is the pose of the only sensor, which has no id.
        path = self.folder / "s.xml"
        path.write_text(
            '<scene version="3.0.0"><default name="x" value="0"/><bsdf type="diffuse" id="a.b"><rgb name="reflectance" value="0.5"/></bsdf>'
            '<sensor type="perspective"><film type="hdrfilm"><integer name="width" value="8"/><integer name="height" value="6"/></film>'
            '<transform name="to_world"><translate x="$x" z="-4"/><scale x="-1"/></transform></sensor>'
            '<shape type="sphere" id="ball"><point name="center" x="0.3" y="0" z="0"/><ref id="a.b"/></shape><emitter type="constant" id="sky"/></scene>'
        )
        scene = neumann.load(path)
        pose = np.array([[-1.0, 0, 0, -0.5], [0, 1, 0, 0], [0, 0, 1, -4], [0, 0, 0, 1]])
        np.testing.assert_array_equal(terms(scene.edit({"sensor.to_world": pose})), terms(neumann.load(path, x=0.5)))
        self.assertEqual(scene.edit({"sensor.film.width": 12}).width, 12)
        moved = path.read_text().replace('x="0.3" y="0"', 'x="0.3" y="0.2"').replace('value="0.5"', 'value="0.9, 0.5, 0.1"')
        (self.folder / "moved.xml").write_text(moved)
        edited = scene.edit({"ball.center": [0.3, 0.2, 0], "a.b.reflectance.value": [0.9, 0.5, 0.1]})
        np.testing.assert_array_equal(terms(edited), terms(neumann.load(self.folder / "moved.xml")))
        # What is missing is added.
        np.testing.assert_allclose(terms(scene.edit({"sky.radiance": 3.0})), 3 * terms(scene), rtol=1e-6)

    def test_errors(self):
        scene = neumann.load_dict(room())
        for name, value, said in (
            ("gray.reflectance.value", 0.5, "gray.reflectance.value: nothing has the id 'gray'; allowed: integrator, sensor, grey, walls; did you mean 'grey'?"),
            ("grey", 0.5, "grey: expected an object and a parameter, as in white.reflectance.value"),
            ("grey.reflectanse.value", 0.5, "grey.reflectanse.value: grey has no 'reflectanse'; to add it leave out .value"),
            ("walls.lamp.radiance.value", 0.5, "walls.lamp.radiance.value: walls has no 'lamp' inside"),
            ("walls.emitter.value", 0.5, "walls.emitter.value: that is <emitter> and no value; to replace it leave out .value"),
            ("grey.reflectance.value", [1, 2], "grey.reflectance.value: list, expected a number, a text, True or False, three numbers, a 4 × 4 matrix or a dictionary with 'type'"),
        ):
            with self.assertRaises(neumann.InputError) as caught:
                scene.edit({name: value})
            self.assertEqual(str(caught.exception), said)
        with self.assertRaisesRegex(neumann.InputError, "^dict#/grey.*reflectance.*string"):
            scene.edit({"grey.reflectance.value": "red"})

    def test_sweep(self):
        # Bounce i of the furnace is albedo^i.
        scene = neumann.load_dict(room())
        for albedo in np.linspace(0, 0.75, 4):
            found = terms(scene.edit({"grey.reflectance.value": albedo}))
            for i in range(4):
                np.testing.assert_allclose(found[i], albedo**i, rtol=1e-6)


if __name__ == "__main__":
    unittest.main()
