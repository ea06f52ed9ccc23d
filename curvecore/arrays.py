"""All validation: arguments become checked, independent float64 arrays here.

The arithmetic in the other modules assumes what these functions promise and
checks nothing again.
"""

from __future__ import annotations

import math
import operator
import sys
from collections.abc import Iterable
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from curvecore.errors import CurveError

FloatArray: TypeAlias = NDArray[np.float64]
IntArray: TypeAlias = NDArray[np.intp]
IntArray32: TypeAlias = NDArray[np.intc]  # what ldexp takes
BoolArray: TypeAlias = NDArray[np.bool_]


class Parameters(NamedTuple):
    """Parameters at which a curve is asked for.

    Attributes
    ----------
    values : ndarray, shape (m,)
        Finite values, in C order.
    shape : tuple of int
        That of the argument; () for a single number.
    """

    values: FloatArray
    shape: tuple[int, ...]

    def shaped(self, results: FloatArray) -> FloatArray:
        """Return results, (m, ...), as (*shape, ...)."""
        if len(self.shape) == 1:
            return results
        return results.reshape(self.shape + results.shape[1:])


def read_only(array: FloatArray) -> FloatArray:
    """Return `array` itself, no longer writeable."""
    array.setflags(write=False)
    return array


def extremes(array: FloatArray) -> tuple[float, float]:
    """Return the least and the greatest entry, NaN if there is one; NumPy finds their indices faster."""
    return array.item(array.argmin()), array.item(array.argmax())


def end_to_end(parts: Iterable[FloatArray]) -> FloatArray:
    """Join arrays each of which begins with the last entry of the one before it."""
    first, *others = parts
    return np.concatenate([first, *(part[1:] for part in others)])


def number_array(values: ArrayLike, name: str) -> FloatArray:
    """Check an array of any shape, whose entries may be NaN or infinite; return a C-ordered copy."""
    _check_masks(values, name)
    try:
        array: NDArray[Any] = np.asarray(values)
        # Text would be parsed and complex numbers cut down; objects may be Fractions or Decimals.
        if array.dtype.kind in "USmMVc":
            raise TypeError(array.dtype)
        return np.array(array, dtype=np.float64, order="C")
    except (TypeError, ValueError, OverflowError):
        raise CurveError(f"{name} must be a regular array of real numbers") from None


def _check_masks(values: ArrayLike, name: str) -> None:
    """Raise for the first masked entry: a hidden value would count like any other."""
    if type(values) is np.ndarray:
        return
    # Without the module, which takes long to import, there is no masked array; nor while another thread is in
    # the middle of importing it.
    masked_arrays = sys.modules.get("numpy.ma")
    if masked_arrays is None or not hasattr(masked_arrays, "MaskedArray"):
        return
    rows = values if isinstance(values, (list, tuple)) else ()
    if not isinstance(values, masked_arrays.MaskedArray) and not any(
        isinstance(row, masked_arrays.MaskedArray) for row in rows
    ):
        return
    try:
        mask = masked_arrays.getmaskarray(masked_arrays.array(values))
    except (TypeError, ValueError):
        return  # Of no regular shape, which is said elsewhere.
    if mask.any():
        where = tuple(int(k) for k in np.argwhere(mask)[0])
        raise CurveError(f"{_entry(name, where)} is masked; every value must be given", where[:1])


def _entry(name: str, where: tuple[int, ...]) -> str:
    return f"{name}[{', '.join(map(str, where))}]" if where else name


def _check_finite(array: FloatArray, name: str) -> None:
    """Raise for the first entry that is NaN or infinite."""
    if array.size == 0 or all(map(math.isfinite, extremes(array))):
        return
    where = tuple(int(k) for k in np.argwhere(~np.isfinite(array))[0])
    raise CurveError(f"{_entry(name, where)} is {array[where]}; every value must be finite", where[:1])


def data_array(values: ArrayLike, name: str, shape: tuple[int, int] | None = None) -> FloatArray:
    """Check points, velocities or accelerations, one row per joint.

    Parameters
    ----------
    values : array_like, shape (n, dim)
        n >= 2 rows of dim >= 1 finite numbers.
    name : str
        The argument's name for messages.
    shape : (int, int), optional
        The shape that the points have, which `values` must share.

    Returns
    -------
    ndarray, shape (n, dim)
        An independent copy.

    Raises
    ------
    CurveError
        For a wrong shape, or a value that is not a finite number.
    """
    array = number_array(values, name)
    if array.ndim != 2 or array.shape[1] < 1:
        raise CurveError(f"{name} must have the shape (n, dim), not {array.shape}")
    if shape is not None and array.shape != shape:
        raise CurveError(f"{name} must have the shape of the points, {shape}, not {array.shape}")
    if array.shape[0] < 2:
        raise CurveError(f"{name} must have at least 2 rows, not {array.shape[0]}")
    _check_finite(array, name)
    return array


def point_array(points: ArrayLike) -> FloatArray:
    """Check points of shape (n, dim), n >= 2; see `data_array`."""
    return data_array(points, "points")


def rows_or_nan(values: ArrayLike, name: str, shape: tuple[int, ...]) -> FloatArray:
    """Check rows of numbers, (n, dim), each of which is finite, or NaN throughout where nothing is given."""
    array = number_array(values, name)
    if array.shape != shape:
        raise CurveError(f"{name} must have the shape {shape}, not {array.shape}")
    missing = np.isnan(array)
    if (missing != missing[:, :1]).any() or np.isinf(array).any():
        i = int(np.argmax(((missing != missing[:, :1]) | np.isinf(array)).any(axis=1)))
        raise CurveError(f"{name}[{i}] must be finite, or NaN throughout, not {array[i].tolist()}", (i,))
    return array


def stacked_jets(points: ArrayLike, **derivatives: ArrayLike) -> FloatArray:
    """Check points and derivatives by their names, each (n, dim); return them as jets, (n, R, dim)."""
    position = point_array(points)
    rest = [data_array(values, name, position.shape) for name, values in derivatives.items()]
    return np.stack((position, *rest), axis=1)


def require_plane(points: FloatArray, purpose: str) -> None:
    """Raise unless the points of a curve, (n, dim), have dim 2, which it needs for the purpose."""
    if points.shape[1] != 2:
        raise CurveError(f"curve must be plane (dim 2) to {purpose}, not of dim {points.shape[1]}")


def jet_array(jets: ArrayLike, shape: tuple[int, int]) -> FloatArray:
    """Check jets that replace those of a curve.

    Parameters
    ----------
    jets : array_like, shape (n, R, dim)
        Finite numbers; any dim >= 1.
    shape : (int, int)
        The required (n, R).

    Returns
    -------
    ndarray, shape (n, R, dim)
        An independent copy.
    """
    array = number_array(jets, "jets")
    if array.ndim != 3 or array.shape[:2] != shape or array.shape[2] < 1:
        raise CurveError(f"jets must have the shape ({shape[0]}, {shape[1]}, dim), not {array.shape}")
    _check_finite(array, "jets")
    return array


def parameter_array(parameters: ArrayLike, count: int) -> FloatArray:
    """Check the parameters t_i of `count` points.

    Parameters
    ----------
    parameters : array_like, shape (count,)
        Finite and strictly increasing; t_(n-1) - t_0 must be finite too.
    count : int
        The number of points.

    Returns
    -------
    ndarray, shape (count,)
        An independent copy.

    Raises
    ------
    CurveError
        For a wrong shape, a value that is not finite, or two neighbours
        that do not increase; `indices` then holds both.
    """
    array = number_array(parameters, "parameters")
    if array.shape != (count,):
        raise CurveError(f"parameters must have the shape ({count},), one per point, not {array.shape}")
    _check_finite(array, "parameters")
    increasing = array[1:] > array[:-1]
    if not increasing.all():
        i = int(np.argmin(increasing))
        raise CurveError(
            f"parameters must be strictly increasing, but parameters[{i + 1}] = {array[i + 1]} "
            f"does not exceed parameters[{i}] = {array[i]}",
            (i, i + 1),
        )
    if not math.isfinite(float(array[-1]) - float(array[0])):
        raise CurveError("parameters must span an interval of finite length")
    return array


def parameter_values(t: ArrayLike) -> Parameters:
    """Check the parameters of an evaluation: finite, of any shape."""
    array = number_array(t, "t")
    _check_finite(array, "t")
    return Parameters(array.reshape(-1), array.shape)


def parameter_row(t: ArrayLike) -> FloatArray:
    """Check parameters of which one counts as m = 1: a finite scalar or shape (m,), returned as (m,)."""
    at = parameter_values(t)
    if len(at.shape) > 1:
        raise CurveError(f"t must be a number or have the shape (m,), not {at.shape}")
    return at.values


def integer(value: object, name: str, least: int) -> int:
    """Check an integer that is at least `least`."""
    try:
        number = operator.index(value)  # type: ignore[arg-type]
    except TypeError:
        raise CurveError(f"{name} must be an integer, not {value!r}") from None
    if number < least:
        raise CurveError(f"{name} must be at least {least}, not {number}")
    return number


def finite_number(value: float, name: str) -> float:
    """Check a single finite real number."""
    array = number_array(value, name)
    if array.ndim != 0:
        raise CurveError(f"{name} must be a single number")
    _check_finite(array, name)
    return float(array)


def tolerance_value(tolerance: float, name: str = "tolerance") -> float:
    """Check a distance, as an approximation may deviate: finite, above zero."""
    value = finite_number(tolerance, name)
    if not value > 0.0:
        raise CurveError(f"{name} must be greater than 0, not {value}")
    return value


def box_edges(box: ArrayLike) -> FloatArray:
    """Check a box (xmin, ymin, xmax, ymax), each minimum at most its maximum."""
    edges = number_array(box, "box")
    if edges.shape != (4,):
        raise CurveError(f"box must be (xmin, ymin, xmax, ymax), not an array of shape {edges.shape}")
    _check_finite(edges, "box")
    if edges[0] > edges[2] or edges[1] > edges[3]:
        raise CurveError("box must have xmin <= xmax and ymin <= ymax")
    return edges
