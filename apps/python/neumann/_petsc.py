"""Writes PETSc's binary files for MatLoad and VecLoad: big-endian, indices of 32 bits (PETSc manual, MatLoad)."""

from pathlib import Path

import numpy as np
import scipy.sparse
from numpy.typing import NDArray

from ._neumann import InputError

_matrix, _vector = 1211216, 1211214


def _integers(values: object) -> bytes:
    return np.asarray(values).astype(">i4").tobytes()


def write_matrix(path: Path, matrix: scipy.sparse.csr_matrix) -> None:
    """Writes class, rows, columns and number of entries, the number of entries in each row, their columns, and their values."""
    if matrix.nnz > np.iinfo(np.int32).max:
        raise InputError(f"{path}: {matrix.nnz} entries, expected at most {np.iinfo(np.int32).max}, which PETSc's files can number")
    sorted_rows = matrix.sorted_indices()
    head = _integers([_matrix, *matrix.shape, matrix.nnz]) + _integers(np.diff(sorted_rows.indptr))
    path.write_bytes(head + _integers(sorted_rows.indices) + sorted_rows.data.astype(">f8").tobytes())


def write_vector(path: Path, vector: NDArray[np.float64]) -> None:
    """Writes class, length and values."""
    path.write_bytes(_integers([_vector, len(vector)]) + vector.astype(">f8").tobytes())
