"""Curves that several tests make, and what they measure these by."""

from fractions import Fraction
from importlib import import_module
from itertools import pairwise
from pkgutil import iter_modules

import numpy as np
from hypothesis import assume
from hypothesis import strategies as st

from curvecore import (
    HermiteCurve,
    LagrangeCurve,
    ParametricCurve,
    QuinticHermiteCurve,
    families,
    natural_spline_accelerations,
    natural_spline_velocities,
)

numbers = st.floats(-1e6, 1e6, allow_subnormal=False)


@st.composite
def curves_of(draw, coordinates, most, least_gap):
    """Curves of at most so many points, whose coordinates are all of one of these kinds."""
    n = draw(st.integers(2, most))
    coordinate = draw(st.sampled_from(coordinates))
    rows = [draw(st.lists(coordinate, min_size=2 * n, max_size=2 * n)) for _ in range(3)]
    data = [np.array(row).reshape(n, 2) for row in rows]
    gaps = np.array(draw(st.lists(st.floats(least_gap, 1e3), min_size=n - 1, max_size=n - 1)))
    parameters = draw(st.floats(-1e3, 1e3)) + np.concatenate(([0.0], np.cumsum(gaps)))
    assume((np.diff(parameters) > 0.0).all())
    kind = draw(st.sampled_from([LagrangeCurve, HermiteCurve, QuinticHermiteCurve]))
    return kind(*data[: kind.derivatives + 1], parameters)


def family(name, points, parameters):
    """The curve of a family, with the derivatives of the natural spline."""
    if name == "lagrange":
        return LagrangeCurve(points, parameters)
    velocities = natural_spline_velocities(points, parameters)
    if name == "hermite":
        return HermiteCurve(points, velocities, parameters)
    accelerations = natural_spline_accelerations(points, parameters)
    return QuinticHermiteCurve(points, velocities, accelerations, parameters)


def core_families():
    """The core's families, by name."""
    modules = [import_module(f"curvecore.families.{each.name}") for each in iter_modules(families.__path__)]
    found = {each for module in modules for each in vars(module).values() if isinstance(each, type)}
    curves = (each for each in found if issubclass(each, ParametricCurve))
    return sorted(
        (each for each in curves if isinstance(vars(each).get("name"), str)), key=lambda each: each.name
    )


def hats(t, parameters):
    return np.stack([np.interp(t, parameters, unit) for unit in np.eye(len(parameters))], axis=1)


def de_casteljau(controls, s):
    level = [[Fraction(float(x)) for x in point] for point in controls]
    while len(level) > 1:
        level = [[(1 - s) * a + s * b for a, b in zip(p, q, strict=True)] for p, q in pairwise(level)]
    return np.array([float(x) for x in level[0]])
