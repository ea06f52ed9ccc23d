"""NumPy's .npy files in, as tables; nothing in them is ever executed."""

from __future__ import annotations

import io
from typing import Any

import numpy as np
import numpy.typing as npt

from ..errors import ExchangeError
from .columns import numbered_titles
from .table import MAX_COLUMNS, MAX_ROWS, Table, table_of

_HEADERS = {(1, 0): np.lib.format.read_array_header_1_0, (2, 0): np.lib.format.read_array_header_2_0}
_SHAPES = (
    "rows of 2 or more numbers (n, 2), a curve for each (k, n, 2), complex numbers (n,), or a structured "
    "array with names"
)


def read_array(data: bytes) -> Table:
    """Return the numbers of an .npy file as a table.

    Raises
    ------
    ExchangeError
        If it is none, holds objects (pickles are never loaded), or has no shape that is a table.
    """
    array = _array(data)
    titles: tuple[str, ...] = ()
    if array.dtype.names is not None:
        titles = array.dtype.names
        array = _fields(array)
    elif array.dtype.kind == "c" and array.ndim == 1:
        array = np.column_stack([array.real, array.imag])
    if array.dtype.kind not in "fiub":
        raise ExchangeError(f"The array holds {array.dtype} and no real numbers.")
    blocks: tuple[int, ...] = ()
    if array.ndim == 3 and 0 not in array.shape:
        blocks = tuple(range(array.shape[1], array.shape[0] * array.shape[1], array.shape[1]))
        array = array.reshape(-1, array.shape[2])
    if array.ndim != 2 or array.shape[1] < 2:
        raise ExchangeError(f"The array has the shape {array.shape}; it can be {_SHAPES}.")
    said = ""
    if array.shape[0] in (2, 3) and array.shape[1] > array.shape[0] + 1 and not blocks:
        array, said = array.T, "The rows of the array are taken for columns."
    return table_of(array.astype(float), titles or numbered_titles(array.shape[1]), blocks=blocks, said=said)


def _array(data: bytes) -> npt.NDArray[Any]:
    """Return the array without a copy; NumPy's own reader would make room for whatever the head claims."""
    file = io.BytesIO(data)
    try:
        version = np.lib.format.read_magic(file)
        shape, is_fortran, dtype = _HEADERS[version](file)
    except KeyError:
        raise ExchangeError("The .npy file is of a version that is not read; save it anew.") from None
    except Exception:
        # The head is Python's own syntax, and whatever its parser raises, this is no array.
        raise ExchangeError("This is no .npy file, or its head is damaged.") from None
    if dtype.hasobject:
        raise ExchangeError("The array holds Python objects, which are never loaded; save it as numbers.")
    count = int(np.prod([int(each) for each in shape], dtype=object))
    if count > MAX_ROWS * MAX_COLUMNS:
        raise ExchangeError(f"The array has {count:,} numbers; {MAX_ROWS * MAX_COLUMNS:,} can be read.")
    if count * dtype.itemsize != len(data) - file.tell():
        raise ExchangeError("The .npy file is cut off, or longer than its head says.")
    flat = np.frombuffer(data, dtype, count, file.tell())
    return flat.reshape(shape, order="F" if is_fortran else "C")


def _fields(array: npt.NDArray[Any]) -> npt.NDArray[Any]:
    assert array.dtype.names is not None
    columns = [array[name] for name in array.dtype.names]
    if array.ndim != 1 or any(column.ndim != 1 or column.dtype.kind not in "fiub" for column in columns):
        raise ExchangeError("A structured array must have one number for each name and row.")
    return np.column_stack([column.astype(float) for column in columns])
