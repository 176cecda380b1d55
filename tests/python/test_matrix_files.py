"""Matrices and fields as files for other programs, read as these do."""

import base64
import importlib.util
import unittest
from pathlib import Path
from xml.etree import ElementTree

import neumann
import numpy as np
import scipy.sparse
from support import Case, ball, cornell, scene_file

SIZE = {"patches": 150, "directions": 16}


def petsc_reader():
    """PETSc's own, of a Debian package or an installation."""
    for path in sorted(Path("/usr/share/petsc").glob("*/lib/petsc/bin/PetscBinaryIO.py")):
        specification = importlib.util.spec_from_file_location("PetscBinaryIO", path)
        module = importlib.util.module_from_spec(specification)
        specification.loader.exec_module(module)
        return module.PetscBinaryIO(precision="double", indices="32bit", complexscalars=False)
    return None


def read_polydata(path):
    """Corners (n, 4, 3) and the fields, by what the file says of its arrays."""
    root = ElementTree.parse(path).getroot()
    assert root.attrib["header_type"] == "UInt64" and root.attrib["byte_order"] == "LittleEndian"

    def array(element):
        data = base64.b64decode(element.text, validate=True)
        assert int.from_bytes(data[:8], "little") == len(data) - 8
        kinds = {"Float64": "<f8", "Int64": "<i8", "UInt64": "<u8"}
        return np.frombuffer(data[8:], dtype=kinds[element.attrib["type"]])

    named = {element.attrib["Name"]: array(element) for element in root.iter("DataArray")}
    points = named.pop("Points").reshape(-1, 3)
    ends = named.pop("offsets")
    assert (np.diff(ends, prepend=0) == 4).all()
    return points[named.pop("connectivity")].reshape(-1, 4, 3), named


class Files(Case):
    def test_npz(self):
        made = cornell().matrices(channel="g", **SIZE)
        made.save(self.folder / "m")
        for name in ("T", "R", "K"):
            self.assertEqual((scipy.sparse.load_npz(self.folder / "m" / f"{name}.npz") != getattr(made, name)).nnz, 0)
        with np.load(self.folder / "m" / "vectors.npz") as vectors:
            for name in ("Le", "b", "measure", "ray_measure", "patches"):
                np.testing.assert_array_equal(vectors[name], getattr(made, name))
        with self.assertRaisesRegex(neumann.InputError, "^format='mat': expected 'npz' or 'petsc'$"):
            made.save(self.folder, "mat")

    def test_petsc_by_its_format(self):
        made = cornell().matrices(channel="g", **SIZE)
        made.save(self.folder, "petsc")
        for name in ("T", "R", "K"):
            data, expected = (self.folder / f"{name}.petsc").read_bytes(), getattr(made, name)
            kind, rows, columns, entries = np.frombuffer(data, ">i4", 4)
            self.assertEqual(kind, 1211216)
            of_row = np.frombuffer(data, ">i4", rows, 16)
            column = np.frombuffer(data, ">i4", entries, 16 + 4 * rows)
            value = np.frombuffer(data, ">f8", entries, 16 + 4 * rows + 4 * entries)
            self.assertEqual(len(data), 16 + 4 * rows + 12 * entries)
            row = np.repeat(np.arange(rows), of_row)
            self.assertTrue((np.diff(row * columns.astype(np.int64) + column) > 0).all())  # sorted, each once
            read = scipy.sparse.coo_matrix((value, (row, column)), (rows, columns)).tocsr()
            self.assertEqual((read != expected).nnz, 0)
        data = (self.folder / "Le.petsc").read_bytes()
        self.assertEqual(list(np.frombuffer(data, ">i4", 2)), [1211214, len(made.Le)])
        np.testing.assert_array_equal(np.frombuffer(data, ">f8", offset=8), made.Le)

    @unittest.skipIf(petsc_reader() is None, "PETSc's PetscBinaryIO.py was not found")
    def test_petsc_by_its_reader(self):
        made = cornell().matrices(channel="g", **SIZE)
        made.save(self.folder, "petsc")
        (first,) = petsc_reader().readBinaryFile(str(self.folder / "K.petsc"))
        (rows, columns), (starts, column, value) = first
        self.assertEqual((scipy.sparse.csr_matrix((value, column, starts), (rows, columns)) != made.K).nnz, 0)
        (Le,) = petsc_reader().readBinaryFile(str(self.folder / "Le.petsc"))
        np.testing.assert_array_equal(Le, made.Le)

    def test_vtk_shape(self):
        # All of the box is flat: quadrilaterals cover it, and face where its sides do. Pieces at outlines go to one patch each.
        made = cornell().matrices(channel="g", **SIZE)
        made.save_vtk(self.folder / "box.vtp")
        corners, fields = read_polydata(self.folder / "box.vtp")
        across = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
        area = 0.5 * np.linalg.norm(across, axis=1)
        for shape in np.unique(made.patches["shape"]):
            expected = made.patches["area"][made.patches["shape"] == shape].sum()
            self.assertAlmostEqual(area[fields["shape"] == shape].sum() / expected, 1.0, 10)
        normal = np.stack([made.patches[name][fields["row"]] for name in ("nx", "ny", "nz")], axis=1)
        np.testing.assert_allclose(across / (2 * area[:, None]), normal, atol=1e-6)
        self.assertEqual(fields["back"].max(), 0)
        # A patch that nothing divides is one quadrilateral around its middle.
        whole = np.isclose(area, made.patches["area"][fields["row"]], rtol=1e-9)
        self.assertGreater(whole.sum(), 50)
        middle = np.stack([made.patches[name][fields["row"]] for name in "xyz"], axis=1)
        diagonals = np.maximum(*(np.linalg.norm(corners[:, i + 2] - corners[:, i], axis=1) for i in (0, 1)))
        inside = np.linalg.norm(corners.mean(axis=1) - middle, axis=1) < 0.5 * diagonals
        self.assertTrue(inside[whole].all())

    def test_vtk_round(self):
        made = ball(self.folder, 0.5).matrices(patches=400, directions=16)
        made.save_vtk(self.folder / "ball.vtp")
        corners, fields = read_polydata(self.folder / "ball.vtp")
        across = 0.5 * np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
        # Corners are on the sphere, and ∮ x · n dA = 3 V, inwards negative; with 6400 quadrilaterals chords take less than 1% of it.
        np.testing.assert_allclose(np.linalg.norm(corners, axis=2), 2.0, rtol=1e-6)
        volume = np.einsum("ij,ij", corners.mean(axis=1), across) / 3
        self.assertLess(abs(volume / (-4 / 3 * np.pi * 2**3) - 1), 0.01)
        np.testing.assert_array_equal(np.bincount(fields["row"]), 16)

    def test_vtk_fields(self):
        made = neumann.load(scene_file("glossy-floor"), res=16).matrices(channel="g", **SIZE)
        x = np.random.default_rng(3).random(len(made.Le))
        made.save_vtk(self.folder / "f.vtp", Le=made.Le, mode=x + 1j * x**2)
        _, fields = read_polydata(self.folder / "f.vtp")
        self.assertGreater(made.patches["directions"].max(), 1)
        for side in (0, len(made.patches) - 1):
            of = slice(made.patches["unknown"][side], made.patches["unknown"][side] + made.patches["directions"][side])
            drawn = fields["row"] == side
            np.testing.assert_allclose(fields["mode_real"][drawn], x[of].mean(), rtol=1e-13)
            np.testing.assert_allclose(fields["mode_imag"][drawn], (x[of] ** 2).mean(), rtol=1e-13)
            np.testing.assert_allclose(fields["Le"][drawn], made.Le[of].mean(), rtol=1e-13)
        for path, given, said in (
            ("f.vtk", {}, "f.vtk: expected a name that ends with .vtp, by which programs know VTK's PolyData"),
            ("f.vtp", {"L": np.ones(2)}, rf"^L has the shape \(2,\), expected one value an unknown, \({len(x)},\)$"),
            ("f.vtp", {"row": x}, "^a field called row: that name is taken; there are row, shape, back$"),
        ):
            with self.assertRaisesRegex(neumann.InputError, said):
                made.save_vtk(self.folder / path, **given)

    @unittest.skipIf(importlib.util.find_spec("vtkmodules") is None, "VTK was not found")
    def test_vtk_by_its_reader(self):
        from vtkmodules.util.numpy_support import vtk_to_numpy
        from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

        made = cornell().matrices(channel="g", **SIZE)
        made.save_vtk(self.folder / "box.vtp", Le=made.Le)
        reader = vtkXMLPolyDataReader()
        reader.SetFileName(str(self.folder / "box.vtp"))
        reader.Update()
        read = reader.GetOutput()
        corners, fields = read_polydata(self.folder / "box.vtp")
        self.assertEqual(read.GetNumberOfPolys(), len(corners))
        np.testing.assert_array_equal(vtk_to_numpy(read.GetPoints().GetData()), corners.reshape(-1, 3))
        np.testing.assert_array_equal(vtk_to_numpy(read.GetCellData().GetArray("Le")), made.Le[fields["row"]])


if __name__ == "__main__":
    unittest.main()
