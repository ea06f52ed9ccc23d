"""Families that only the tests have, from files as a person would write them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from scipy.interpolate import BSpline

from app.families import FAMILIES

FILES = sorted((Path(__file__).parent / "data" / "families").glob("*.py"))
OWN = ("tests_averaging", "tests_cosine_steps", "tests_gaussian", "tests_multiquadric")
"""Those of which nothing but functions of t is known, and which are no polynomials."""
EVERY = (*(family.name for family in FAMILIES), *OWN, "tests_natural_spline", "cardinal_spline")
"""The names of all families that are tried; those of files are there only while a test has them."""


def gaussian(t, parameters):
    """The functions of ``gaussian.py`` by another way: the inverse, and a row for each t."""
    width = 1.5 * (parameters[-1] - parameters[0]) / len(parameters)
    inverse = np.linalg.inv(np.exp(-(((parameters[:, None] - parameters[None]) / width) ** 2)))
    return np.array([np.exp(-(((each - parameters) / width) ** 2)) @ inverse for each in t])


def multiquadric(t, parameters):
    """The functions of ``multiquadric.py`` by another way: one system for each t, by least squares."""
    width = (parameters[-1] - parameters[0]) / len(parameters)
    system = np.hypot(1.0, (parameters[:, None] - parameters[None]) / width)
    wanted = np.hypot(1.0, (parameters[:, None] - np.asarray(t)[None]) / width)
    return np.linalg.lstsq(system, wanted, rcond=None)[0].T


def cosine_steps(t, parameters):
    """The functions of ``cosine.py`` by another way: one at a time."""
    values = []
    for i in range(len(parameters)):
        low = parameters[i - 1] if i else parameters[0] - (parameters[1] - parameters[0])
        high = parameters[i + 1] if i + 1 < len(parameters) else 2 * parameters[-1] - parameters[-2]
        here = np.interp(t, [low, parameters[i], high], [0.0, 1.0, 0.0], left=0.0, right=0.0)
        values.append(0.5 - 0.5 * np.cos(np.pi * here))
    return np.array(values).T


def averaging(t, parameters):
    """The functions of ``averaging.py`` by another way: weights before they are divided by their sum."""
    width = 0.5 * (parameters[-1] - parameters[0]) / len(parameters)
    weights = np.array([[np.exp(-(((each - p) / width) ** 2)) for p in parameters] for each in t])
    return weights / weights.sum(axis=1)[:, None]


def bezier(t, parameters):
    """The Bernstein functions: B-splines without knots inside."""
    n, ends = len(parameters), np.repeat(parameters[[0, -1]], len(parameters))
    return BSpline(ends, np.eye(n), n - 1)(t)


def b_spline(t, parameters):
    """The B-splines of a degree of at most 3, by SciPy."""
    degree = min(3, len(parameters) - 1)
    ends = np.repeat(parameters[[0, -1]], degree + 1)
    knots = np.concatenate((ends[: degree + 1], parameters[2:-2], ends[degree + 1 :]))
    return BSpline(knots, np.eye(len(parameters)), degree)(t)


TRUE_BASIS = {
    "b_spline": b_spline,
    "bezier": bezier,
    "tests_averaging": averaging,
    "tests_cosine_steps": cosine_steps,
    "tests_gaussian": gaussian,
    "tests_multiquadric": multiquadric,
}
