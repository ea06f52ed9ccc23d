"""Gaussian bells that are made cardinal: smooth, reaching everywhere, no polynomials.

They do not sum to one: moving all points by the same way moves the curve by less between them.
"""

import numpy as np

name = "tests_gaussian"
title = "Gaussian"


def _bells(t, parameters):
    width = 1.5 * (parameters[-1] - parameters[0]) / len(parameters)
    return np.exp(-(((t[:, None] - parameters) / width) ** 2))


def basis(t, parameters):
    """Return the cardinal functions, (m, n)."""
    return np.linalg.solve(_bells(parameters, parameters).T, _bells(t, parameters).T).T
