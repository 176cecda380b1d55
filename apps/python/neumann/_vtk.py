"""Writes VTK's XML PolyData, which ParaView opens (VTK File Formats, https://docs.vtk.org/en/latest/vtk_file_formats)."""

import base64
from pathlib import Path
from typing import Any, Dict
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray

_types = {"f": "Float", "i": "Int", "u": "UInt"}


def _add(parent: ElementTree.Element, name: str, values: NDArray[Any], components: int = 1) -> None:
    values = np.ascontiguousarray(values, dtype=values.dtype.newbyteorder("<"))
    kind = f"{_types[values.dtype.kind]}{8 * values.dtype.itemsize}"
    array = ElementTree.SubElement(parent, "DataArray", type=kind, Name=name, NumberOfComponents=str(components), format="binary")
    array.text = base64.b64encode(values.nbytes.to_bytes(8, "little") + values.tobytes()).decode()


def write_quadrilaterals(path: Path, corners: NDArray[np.float64], of_each: Dict[str, NDArray[Any]]) -> None:
    """Writes quadrilaterals. corners: (n, 4, 3). of_each: values (n,) by their names."""
    n = len(corners)
    file = ElementTree.Element("VTKFile", type="PolyData", version="1.0", byte_order="LittleEndian", header_type="UInt64")
    piece = ElementTree.SubElement(
        ElementTree.SubElement(file, "PolyData"), "Piece", NumberOfPoints=str(4 * n), NumberOfPolys=str(n)
    )
    _add(ElementTree.SubElement(piece, "Points"), "Points", corners, components=3)
    polygons = ElementTree.SubElement(piece, "Polys")
    _add(polygons, "connectivity", np.arange(4 * n))
    _add(polygons, "offsets", np.arange(4, 4 * n + 1, 4))
    data = ElementTree.SubElement(piece, "CellData")
    for name, values in of_each.items():
        _add(data, name, values)
    ElementTree.ElementTree(file).write(path, encoding="utf-8", xml_declaration=True)
